//! The gap in the complementarity: braking, pushing out, drift, and the comparison with Moreau–Jean.

use crate::checks::stewart_trinkle::{reference, wedge};
use crate::claims::prelude::*;
use crate::exact_particle::{Ball, BallState, BallStep};
use crate::mechanics::{BeadInCircle, Mechanism, PointMass, State};
use crate::schemes::{self, Activation, MoreauJean, RestitutionRule, StewartTrinkle, Waist};
use crate::solvers::LemkePivoting;
use crate::solvers::enumeration::all_solutions;
use crate::tolerance::claims::lcp as tolerance;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S4.linearised",
        statement: r"In practice the non-linear gap is linearised: $\varphi + h\nabla\varphi^Tv^+ \ge 0$; against the velocity level of
            Moreau–Jean this adds the term $\varphi/h$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"$\varphi/h + \nabla\varphi^Tv^+ \ge 0$, with a residual of $O(h^2)$ per step, $-\tfrac12h^2v^2/R$ on a circle
            of radius $R$.",
        argument: r"A bead $h/4$ inside the unit circle that moves at 1 m/s along it and at 1 m/s towards it: the linearised constraint is
            met with 0 and the gap after the step is $1 - \sqrt{1 + h^2} \in (-\tfrac12h^2, -\tfrac12h^2 + h^4/8)$. A contact at
            $\varphi = 1/4$ with $h = 1/64$ enters the law with the shift $\varphi/h = 16$.",
        controls: &[r"Moreau–Jean, whose shift $e\cdot u_n$ does not contain the gap."],
        sources: &["chapter §4, step 1 of the construction"],
        check: check!(linearised),
    },
    Claim {
        id: "S4.nonpen",
        statement: "Stewart–Trinkle is strictly non-penetrating (after linearisation approximately) and does not drift.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated, with the position extrapolated by the new velocity, $q^+ = q + hv^+$, as the constraint is
            written: on a floor the gap stays $\ge 0$, on a curved contact $\ge -\tfrac12h^2$·max $v^2/R$, and nothing accumulates. (A
            trapezoidal update in its place would make the plastic ball rebound for every $h$.)",
        argument: r"The constraint gives $|q| + h\,\hat q\cdot v \le R$, so $|q + hv| \le \sqrt{R^2 + h^2v^2} \le R + h^2v^2/2R$, whatever
            happened before. Bead, $R = 1$, $v = 1$, $h = 1/100$, 200 steps: gap $\ge -\tfrac12h^2v^2$. A plastic ball that falls on a
            floor: the least gap of 50 exact steps is 0.",
        controls: &[r"Moreau–Jean on the same circle, which drifts out by $\sqrt{1 + nh^2v^2} - 1$."],
        sources: &["chapter §4, table Stewart–Trinkle versus Moreau–Jean"],
        check: check!(no_drift),
    },
    Claim {
        id: "S4.brake",
        statement: r"Because of $\varphi/h$ Stewart–Trinkle can brake before contact; Moreau–Jean waits until $\varphi = 0$.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"A ball that would pass the floor within the step gets $v^+ = -\varphi/h$; the impact is spread over two
            steps, with the total impulse $m|v|$. Moreau–Jean waits if it is activated by $\varphi \le 0$; with the forecast
            $\varphi + h\,v_\text{free}$ of §12 it brakes as early, and to $v^+ = 0$.",
        argument: r"$m = 1$, $v = -1$, $h = 1/10$, $\varphi = 3/100$, no gravity: $v^+ = -3/10$ with impulse 7/10, then $v^+ = 0$ with
            impulse 3/10. Moreau–Jean in the same step: $v^+ = -1$ activated by the gap, 0 activated by the forecast.",
        controls: &[
            r"Moreau–Jean with activation $\varphi \le 0$ in place of Stewart–Trinkle: nothing brakes.",
            r"A ball at $\varphi = 3/10$, too far to touch in two steps.",
            r"A ball that touches already, $\varphi = 0$.",
        ],
        sources: &["chapter §4, end of the comparison with Moreau–Jean"],
        check: check!(brake),
    },
    Claim {
        id: "S4.pushout",
        statement: r"For $\varphi < 0$ the term $\varphi/h$ actively pushes the body out, so Stewart–Trinkle needs no Baumgarte
            stabilisation.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"It corrects penetration within one step, $v^+ = |\varphi|/h$, where the step has a solution; with penetration
            the LCP may have none, as in a wedge whose friction cone is not pointed. The push injects the kinetic energy
            $\tfrac12m(\varphi/h)^2$, unbounded as $h \to 0$ for a given penetration: penetrations must be $O(h^2)$, as the scheme's own
            are.",
        argument: r"Penetration 1 mm, $m = 1$: $v^+ = 1/10$, 1, 10 m/s at $h = 10^{-2}$, $10^{-3}$, $10^{-4}$; the last is 50 J. In the
            wedge of S4.solvable both walls are penetrated: with $\mu = 7/10$ the step pushes the point out, with $\mu = 3/4$ there is no
            step.",
        controls: &["Moreau–Jean, which leaves the body where it is.", "The two coefficients of the wedge exchanged."],
        sources: &["chapter §4, pitfall “position level versus velocity level”"],
        check: check!(push_out),
    },
    Claim {
        id: "S4.mj-vs-st",
        statement: "Both are equivalent in persistent contact; they differ where contact is about to be made (table above it: Moreau–Jean \
            needs position projection against drift, Stewart–Trinkle does not drift).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated, with the drift that the table names: they produce the same iterates in persistent contact if
            $\varphi$ is linear, $e\cdot u_n = 0$, and both update $q^+ = q + hv^+$. On a curved constraint Moreau–Jean drifts and
            Stewart–Trinkle does not.",
        argument: r"Block on a 20° incline, $\mu = 0.3$ (slides) and 0.5 (sticks), 50 steps: the same to rounding. Bead on the unit
            circle, $h = 1/100$, 2 s: Moreau–Jean ends outside by $\sqrt{1 + nh^2v^2} - 1$ with $v$ between $1 - nh^2/2$ and 1, about
            9.9e-3 m; Stewart–Trinkle by at most $\tfrac12h^2v^2 = \text{5e-5}$ m.",
        controls: &["The bead on the circle in place of the block on the incline.", "The two schemes exchanged on the circle."],
        sources: &["chapter §4, end of the comparison with Moreau–Jean; §2, table of the two levels"],
        check: check!(persistent_contact),
    },
    Claim {
        id: "S4.conv-chain",
        statement: r"Skeleton of the convergence proof ($M \succ 0$ Lipschitz, $F$ continuous, $\mu$ bounded): a uniform bound on the
            variation of $v_h$, Helly's selection theorem, weak* compactness of a subsequence of the impulses, and the limit satisfies the
            measure differential inclusion.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Its first link needs starting positions that do not penetrate (or only by $O(h)$) and a pointed friction cone
            (S11.bv); what the closed graph still lacks at the end is in S11.step4. Only the first link is tested here.",
        argument: r"Plastic ball from height 1, $T = 1$: impulses are $\ge 0$ and $v \le 0$, so $\operatorname{TV}(v_h) \le gT + \sum r/m
            = 2gT + v_N - v_0 \le 2gT = 19.62$ for every $h = 2^{-4}$ … $2^{-12}$. From a penetration of 1/64 the first step alone makes
            TV $\ge 1/(64h)$.",
        controls: &["A start 1/64 m above the floor in place of one as far inside.", "A ball thrown down at 20 m/s."],
        sources: &["chapter §4, convergence; §11, four steps", "Stewart 1998 (not read)"],
        check: check!(bounded_variation),
    },
];

/// A bead on the unit circle, without gravity and friction, with unit tangential speed.
fn bead() -> Result<(BeadInCircle, State)> {
    let state = State { time: 0.0, position: dvector![1.0, 0.0], velocity: dvector![0.0, 1.0] };
    Ok((BeadInCircle::new(1.0, 1.0, 0.0, 0.0, 0.0)?, state))
}

fn moreau_jean() -> MoreauJean {
    MoreauJean { theta: 1.0, activation: Activation::FreeVelocityForecast, restitution: RestitutionRule::NormalOnly }
}

fn scheme(reading: Reading) -> Box<dyn Waist> {
    reading.pick(Box::new(StewartTrinkle::default()) as Box<dyn Waist>, Box::new(moreau_jean()))
}

fn linearised(reading: Reading) -> Result<Vec<Finding>> {
    let (bead, _) = bead()?;
    let mut findings = Vec::new();
    let approaching = State { time: 0.0, position: dvector![0.75, 0.0], velocity: dvector![64.0, 0.0] };
    let assembled = schemes::assembled(scheme(reading).as_ref(), &bead, &approaching, 1.0 / 64.0)?;
    let shift = assembled.problem.map_or(0.0, |problem| problem.shift()[0]);
    findings.push(Finding::equal("shift of a contact at φ = 1/4, h = 1/64", shift, 16.0, 0.0, "m/s"));
    for h in [1.0 / 16.0, 1.0 / 64.0, 1.0 / 256.0] {
        let start = State { time: 0.0, position: dvector![1.0 - 0.25 * h, 0.0], velocity: dvector![1.0, 1.0] };
        let end = schemes::step(&*scheme(reading), &LemkePivoting, &bead, &start, h)?.state;
        let gap = bead.contacts(&end.position)[0].gap;
        findings.push(Finding::equal(format!("φ⁺/h² at h = {h}"), gap / (h * h), -0.5, tolerance::circle_residual(h), "1/m"));
    }
    Ok(findings)
}

/// Least gap over 200 steps of 1/100 along the circle.
fn circle_track(scheme: &dyn Waist) -> Result<(f64, f64)> {
    let (bead, start) = bead()?;
    let recording = schemes::simulate(scheme, &LemkePivoting, &bead, start, CIRCLE_STEP, CIRCLE_STEPS)?;
    let gaps = recording.samples.iter().map(|state| bead.contacts(&state.position)[0].gap);
    let speed = recording.samples.iter().map(|state| state.velocity.norm()).fold(0.0, f64::max);
    Ok((gaps.fold(f64::INFINITY, f64::min), speed))
}

const CIRCLE_STEP: f64 = 0.01;
const CIRCLE_STEPS: usize = 200;

fn no_drift(reading: Reading) -> Result<Vec<Finding>> {
    let (gap, speed) = circle_track(&*scheme(reading))?;
    let bound = -0.5 * (CIRCLE_STEP * speed).powi(2) - tolerance::LINEARISED_GAP;
    let height = least_gap_of_a_fall(reading);
    Ok(vec![
        Finding::at_least("least gap along the circle in 200 steps, −½h²v²/R or more", gap, bound, "m"),
        Finding::exact("least gap of a ball that falls on a floor", &height, &ratio(0, 1), "m"),
    ])
}

/// Least gap \[m\] in 50 steps of 1/100 s of a ball that falls on the floor from 1/20 m.
fn least_gap_of_a_fall(reading: Reading) -> Rational {
    let mut now = BallState { position: ratio(1, 20), velocity: ratio(0, 1) };
    let mut least = now.position.clone();
    for _ in 0..50 {
        now = particle_step(reading, &plastic_ball(ratio(10, 1)), &now, &ratio(1, 100)).motion;
        least = least.min(now.position.clone());
    }
    least
}

fn plastic_ball(gravity: Rational) -> Ball<Rational> {
    Ball { mass: ratio(1, 1), gravity, restitution: ratio(0, 1) }
}

/// One exact step of Stewart–Trinkle, or, for a first control, of Moreau–Jean with activation φ ≤ 0.
fn particle_step(reading: Reading, ball: &Ball<Rational>, now: &BallState<Rational>, h: &Rational) -> BallStep<Rational> {
    match reading.only(0) {
        Reading::Recorded => ball.stewart_trinkle(now, h),
        Reading::Control(_) => ball.moreau_jean(now, &ratio(1, 1), Activation::Gap, h),
    }
}

fn brake(reading: Reading) -> Result<Vec<Finding>> {
    let h = ratio(1, 10);
    let ball = plastic_ball(ratio(0, 1));
    let position = reading.only(2).pick(reading.only(1).pick(ratio(3, 100), ratio(3, 10)), ratio(0, 1));
    let start = BallState { position, velocity: ratio(-1, 1) };
    let first = particle_step(reading, &ball, &start, &h);
    let second = particle_step(reading, &ball, &first.motion, &h);
    let moreau_jean = |activation| ball.moreau_jean(&start, &ratio(1, 1), activation, &h).motion.velocity;
    let (by_gap, by_forecast) = (moreau_jean(Activation::Gap), moreau_jean(Activation::FreeVelocityForecast));
    Ok(vec![
        Finding::exact("v⁺ before touching, −φ/h", &first.motion.velocity, &ratio(-3, 10), "m/s"),
        Finding::exact("impulse of that step", &first.impulse, &ratio(7, 10), "N·s"),
        Finding::exact("velocity one step later", &second.motion.velocity, &ratio(0, 1), "m/s"),
        Finding::exact("total impulse", &(first.impulse + second.impulse), &ratio(1, 1), "N·s"),
        Finding::exact("v⁺ of Moreau–Jean activated by φ ≤ 0", &by_gap, &ratio(-1, 1), "m/s"),
        Finding::exact("v⁺ of Moreau–Jean activated by the forecast of §12", &by_forecast, &ratio(0, 1), "m/s")
            .says(ratio(-1, 1))
            .violating("activation by φ ≤ 0"),
    ])
}

fn push_out(reading: Reading) -> Result<Vec<Finding>> {
    let resting = BallState { position: ratio(-1, 1000), velocity: ratio(0, 1) };
    let cases = [(10_000, ratio(10, 1)), (1000, ratio(1, 1)), (100, ratio(1, 10))];
    let ball = plastic_ball(ratio(0, 1));
    let leaving = |denominator: i64| particle_step(reading, &ball, &resting, &ratio(1, denominator)).motion.velocity;
    let mut findings = Vec::new();
    for (denominator, speed) in cases {
        findings.push(Finding::exact(format!("v⁺ from 1 mm of penetration, h = 1/{denominator}"), &leaving(denominator), &speed, "m/s"));
    }
    let energy = leaving(10_000).pow(2) / ratio(2, 1);
    findings.push(Finding::exact("kinetic energy injected, h = 1/10000", &energy, &ratio(50, 1), "J").context());
    let pushed = |friction: Rational| -> Result<bool> { Ok(!all_solutions(&reference(&wedge(friction))?)?.is_empty()) };
    let [low, high] = reading.only(1).pick([ratio(7, 10), ratio(3, 4)], [ratio(3, 4), ratio(7, 10)]);
    findings.push(Finding::decision("a point 1 h deep in a wedge is pushed out, μ = 7/10", pushed(low)?, true));
    findings.push(
        Finding::decision("a point 1 h deep in a wedge is pushed out, μ = 3/4", pushed(high)?, false)
            .says(true)
            .violating("a pointed friction cone"),
    );
    Ok(findings)
}

fn persistent_contact(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    let steps = 50;
    for friction in [0.3, 0.5] {
        let block = PointMass::block_on_incline(1.0, 9.81, 20f64.to_radians(), friction, 0.0);
        let at_rest = State { time: 0.0, position: dvector![0.0, 0.0], velocity: dvector![0.0, 0.0] };
        let (bead, on_circle) = bead()?;
        let (mechanism, start): (&dyn Mechanism, State) = reading.only(0).pick((&block, at_rest), (&bead, on_circle));
        let run = |scheme: &dyn Waist| schemes::simulate(scheme, &LemkePivoting, mechanism, start.clone(), CIRCLE_STEP, steps);
        let (ours, theirs) = (run(&StewartTrinkle::default())?, run(&moreau_jean())?);
        let pairs = ours.samples.iter().zip(&theirs.samples);
        let largest = |difference: fn(&State, &State) -> f64| pairs.clone().map(|(a, b)| difference(a, b)).fold(0.0, f64::max);
        let bound = tolerance::repeated_steps(steps);
        let speed = largest(|a, b| (&a.velocity - &b.velocity).amax());
        let place = largest(|a, b| (&a.position - &b.position).amax());
        findings.push(Finding::equal(
            format!("largest difference in velocity between the schemes, μ = {friction}"),
            speed,
            0.0,
            bound,
            "m/s",
        ));
        findings.push(Finding::equal(format!("largest difference in position, μ = {friction}"), place, 0.0, bound, "m"));
    }
    let (velocity_level, position_level) = (moreau_jean(), StewartTrinkle::default());
    let schemes: [&dyn Waist; 2] = [&velocity_level, &position_level];
    let [drifting, staying] = reading.only(1).pick(schemes, [schemes[1], schemes[0]]);
    let (drifted, _) = circle_track(drifting)?;
    let (stayed, _) = circle_track(staying)?;
    let angle_squared = CIRCLE_STEPS as f64 * CIRCLE_STEP * CIRCLE_STEP;
    let slowest = 1.0 - 0.5 * angle_squared;
    let drift = (1.0 + angle_squared * slowest * slowest).sqrt() - 1.0;
    let least = -0.5 * CIRCLE_STEP * CIRCLE_STEP - tolerance::LINEARISED_GAP;
    findings.push(Finding::at_most("gap of Moreau–Jean after 2 s on the circle", drifted, -drift, "m"));
    findings.push(Finding::at_least("least gap of Stewart–Trinkle in 2 s on the circle", stayed, least, "m"));
    Ok(findings)
}

/// ∫|dv_h| of a plastic ball from this height and velocity over one second in 2^exponent steps \[m/s\].
fn variation(height: f64, velocity: f64, exponent: u32) -> f64 {
    let ball = Ball { mass: 1.0, gravity: 9.81, restitution: 0.0 };
    let steps = 1usize << exponent;
    let mut now = BallState { position: height, velocity };
    let mut variation = 0.0;
    for _ in 0..steps {
        let next = ball.stewart_trinkle(&now, &(1.0 / steps as f64)).motion;
        variation += (next.velocity - now.velocity).abs();
        now = next;
    }
    variation
}

fn bounded_variation(reading: Reading) -> Result<Vec<Finding>> {
    let bound = |exponent: u32| 2.0 * 9.81 + tolerance::repeated_steps(1 << exponent);
    let thrown = reading.only(1).pick(0.0, -20.0);
    let largest = [12, 10, 8, 6, 4].map(|exponent| variation(1.0, thrown, exponent)).into_iter().fold(0.0, f64::max);
    let mut findings = vec![Finding::at_most("largest variation of v_h, h = 2^-12 … 2^-4", largest, bound(12), "m/s")];
    for exponent in [12, 10] {
        // the first step alone leaves the floor by 1/64 m
        let (start, least) = (reading.only(0).pick(-1.0 / 64.0, 1.0 / 64.0), f64::from(1u32 << exponent) / 64.0);
        let name = format!("variation from 1/64 m inside, h = 2^-{exponent}");
        let found = Finding::at_least(name, variation(start, 0.0, exponent), least, "m/s");
        findings.push(found.says_at_most(bound(exponent)).violating("a start that does not penetrate"));
    }
    Ok(findings)
}
