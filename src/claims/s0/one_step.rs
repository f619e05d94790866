//! §0, one step across an impact: a Runge–Kutta step, and a velocity flipped after penetration.

use crate::claims::experiments::motion_step::{flight, under_gravity};
use crate::claims::prelude::*;
use crate::exact_particle::{Ball, BallState};
use moreau_exact::witness::decided;

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S0.rk4-local",
        statement: r"If the impact lies within a step, the local truncation error of RK4 collapses from $O(h^5)$ to $O(h)$ or even
            $O(1)$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: with the velocity reversed at the end of the step, position and velocity are wrong by $O(h)$; with
            the impact ignored in the step, the position by $O(h)$ and the velocity by $O(1)$.",
        argument: r"Impact with speed $u$, a time $\tau$ before the end of the step. Free flight is a parabola, which RK4 integrates
            exactly. Reversed at the end: $v$ is wrong by $(1 + e)g\tau$, $q$ by $-(1 + e)u\tau$. Ignored: $v$ is wrong by $-(1 + e)u$,
            −7.974 m/s for $e = 0.8$, $u = 4.43$ m/s.",
        controls: &["An impact one step later: the step does not straddle it and the error formulas must fail."],
        sources: &["chapter §0, the thought experiment with RK4"],
        check: check!(runge_kutta),
    },
    Claim {
        id: "S0.flip-inconsistent",
        statement: "Checking each step for penetration and flipping the velocity is a bad version of event detection: it fails \
                    completely when the ball settles, and every flip breaks the consistency of momentum and energy.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"For $e < 1$ every flip costs $(1 - e^2)\,m\,g\,|q|$ of energy too much, which is $O(h)$ and vanishes with the
            step; for $e = 1$ it costs nothing. The failure at the accumulation point is qualitative: the ball sinks through the floor at
            $g\,h\,(1 - e)/(2(1 + e))$, even if only approaching velocities are flipped.",
        argument: r"Exact flight to depth $|q|$ has $v^2 = V^2 + 2g|q|$. After $v \to -e\,v$ the energy is
            $\tfrac12e^2V^2 - (1 - e^2)\,g\,|q|$ per unit mass, instead of $\tfrac12e^2V^2$; with steps that end on the floor and one
            more, $|q| = h(V + \tfrac12\,g\,h)$. Resting below the floor, each step does $v \to -e(v - g\,h)$, with the fixed point
            $v = e\,g\,h/(1 + e)$, and moves by $h(v - \tfrac12\,g\,h) = -(1 - e)\,g\,h^2/(2(1 + e))$.",
        controls: &[r"$e = 1/2$ in the place of the elastic ball.", "A ball thrown down at 1 m/s without gravity: no flip costs anything."],
        sources: &["chapter §0, common pitfall"],
        check: check!(flipping),
    },
];

/// One step of the classical Runge–Kutta method for q̇ = v, v̇ = −g.
fn runge_kutta_step(now: &BallState<Rational>, gravity: &Rational, h: &Rational) -> BallState<Rational> {
    let slope = |motion: &BallState<Rational>| BallState { position: motion.velocity.clone(), velocity: -gravity.clone() };
    let ahead = |slope: &BallState<Rational>, share: Rational| BallState {
        position: now.position.clone() + share.clone() * h * &slope.position,
        velocity: now.velocity.clone() + share * h * &slope.velocity,
    };
    let first = slope(now);
    let second = slope(&ahead(&first, ratio(1, 2)));
    let third = slope(&ahead(&second, ratio(1, 2)));
    let fourth = slope(&ahead(&third, ratio(1, 1)));
    let mean = |component: fn(&BallState<Rational>) -> &Rational| {
        let middle = component(&second).clone() + component(&third);
        (component(&first).clone() + ratio(2, 1) * middle + component(&fourth)) / ratio(6, 1)
    };
    let slope = BallState { position: mean(|motion| &motion.position), velocity: mean(|motion| &motion.velocity) };
    ahead(&slope, ratio(1, 1))
}

fn runge_kutta(reading: Reading) -> Result<Vec<Finding>> {
    let (g, e, u) = (ratio(981, 100), ratio(4, 5), ratio(443, 100));
    let mut findings = Vec::new();
    for inverse in [100, 1000] {
        let h = ratio(1, inverse);
        let tau = ratio(1, 4) * &h;
        // Back in time from the impact: 3/4 of the step, or 3/4 and another whole one for the control.
        let before = ratio(3, 4) * &h + reading.pick(ratio(0, 1), h.clone());
        let impact = BallState { position: ratio(0, 1), velocity: -u.clone() };
        let start = flight(&impact, &g, &-before.clone());
        let end = if before < h {
            flight(&BallState { velocity: e.clone() * &u, ..impact }, &g, &(h.clone() - before))
        } else {
            flight(&start, &g, &h)
        };
        let step = || runge_kutta_step(&start, &g, &h);
        let ignored = decided(step, |after| Some(under_gravity("runge-kutta-4", &g, &h, &start, after)));
        let flipped = if ignored.position < ratio(0, 1) { -e.clone() * &ignored.velocity } else { ignored.velocity.clone() };
        let sum = ratio(1, 1) + &e;
        let named = |what: &str| format!("{what}, h = 1/{inverse}");
        findings.push(Finding::exact(named("velocity error, ignored"), &(ignored.velocity - &end.velocity), &(-sum.clone() * &u), "m/s"));
        findings.push(Finding::exact(named("velocity error, flipped"), &(flipped - &end.velocity), &(sum.clone() * &g * &tau), "m/s"));
        findings.push(Finding::exact(named("position error"), &(ignored.position - &end.position), &(-sum * &u * &tau), "m"));
    }
    Ok(findings)
}

/// Exact flight for one step; a ball found below the floor and approaching has its velocity reversed by e.
fn flip_step(ball: &Ball<Rational>, now: &BallState<Rational>, h: &Rational) -> (BallState<Rational>, bool) {
    let flown = flight(now, &ball.gravity, h);
    let flips = flown.position < ratio(0, 1) && flown.velocity < ratio(0, 1);
    let velocity = if flips { -ball.restitution.clone() * &flown.velocity } else { flown.velocity };
    (BallState { position: flown.position, velocity }, flips)
}

/// What the first flip makes of the energy e²E that an impact at q = 0 leaves \[J\], and how deep the ball is then \[m\].
fn first_flip(ball: &Ball<Rational>, start: &BallState<Rational>, h: &Rational) -> (Rational, Rational) {
    let (mut now, mut flipped) = flip_step(ball, start, h);
    while !flipped {
        (now, flipped) = flip_step(ball, &now, h);
    }
    let left = ball.restitution.clone() * &ball.restitution * ball.energy(start);
    (ball.energy(&now) - left, -now.position)
}

fn flipping(reading: Reading) -> Result<Vec<Finding>> {
    let e = ratio(1, 2);
    let (gravity, velocity) = reading.only(1).pick((ratio(10, 1), ratio(0, 1)), (ratio(0, 1), ratio(-1, 1)));
    let ball = Ball { mass: ratio(1, 1), gravity, restitution: e.clone() };
    let elastic = Ball { restitution: reading.only(0).pick(ratio(1, 1), ratio(1, 2)), ..ball.clone() };
    // V² = 2 g q₀ = 1, and t₁ = 1/10 s is a number of whole steps.
    let start = BallState { position: ratio(1, 20), velocity };
    let lost = ratio(1, 1) - e.clone() * &e;
    let mut findings = Vec::new();
    for inverse in [7000, 700, 70] {
        let h = ratio(1, inverse);
        let (defect, depth) = first_flip(&ball, &start, &h);
        let named = |what: &str| format!("{what}, h = 1/{inverse}");
        let conserved = first_flip(&elastic, &start, &h).0 == ratio(0, 1);
        findings.push(Finding::decision(named("the flip changes the energy, e = 1"), !conserved, false).says(true).violating("e < 1"));
        findings.push(Finding::decision(named("the flip changes the energy"), defect != ratio(0, 1), true));
        let deep = h.clone() * (ratio(1, 1) + ratio(5, 1) * &h);
        findings.push(Finding::exact(named("depth of the flip"), &depth, &deep, "m"));
        findings.push(Finding::exact(named("its defect"), &defect, &(-lost.clone() * ratio(10, 1) * deep), "J"));
    }
    let h = ratio(1, 70);
    let steps = 200;
    let before = (0..steps).fold(start, |now, _| flip_step(&ball, &now, &h).0);
    let after = flip_step(&ball, &flip_step(&ball, &before, &h).0, &h).0;
    let sinking = (before.position.clone() - after.position) / (ratio(20, 1) * &h * &h);
    let predicted = (ratio(1, 1) - &e) / (ratio(2, 1) * (ratio(1, 1) + &e));
    // The velocity approaches its fixed point by the factor e per step, from at most V + g h = 8 g h.
    let settled = crate::tolerance::zeno::contraction(e.to_f64().value(), steps, 8.0);
    findings.push(Finding::decision("the ball ends below the floor", before.position < ratio(0, 1), true));
    findings.push(Finding::equal("sinking speed", sinking.to_f64().value(), predicted.to_f64().value(), settled, "g h"));
    Ok(findings)
}
