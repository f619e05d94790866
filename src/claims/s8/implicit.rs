//! Implicit Euler and the θ method: stability at every step, what it costs, and where semi-implicit Euler stands.

use super::spring::{SEMI_IMPLICIT, energy, matrix, powers_at, theta, undamped};
use crate::claims::experiments::theta_energy::elastic_invariant;
use crate::claims::experiments::theta_step::{LinearSystem, phase};
use crate::claims::prelude::*;
use crate::closed_forms::spring_damper::theta_energy_ratio;
use crate::exact_particle::{Ball, BallState};
use crate::integrators::stability::{Powers, invariants, spectral_radius};
use crate::integrators::{Method, Phase, SpringDamper, Theta};
use crate::schemes::Activation;
use crate::tolerance::claims::integrators::HALVED;
use crate::tolerance::rounding;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S8.implicit-AL",
        statement: "Fully implicit integration (θ = 1) is the most stable, A-stable and L-stable; it allows large steps and needs a \
            nonlinear system solved per step.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated; a system that is nonlinear where the forces are, with contact in it in any case. θ = 1/2 is \
            A-stable, not L-stable.",
        argument: "R(z) = 1/(1 − z): |R| < 1 in the left half plane, and R → 0. In rationals: every s from 1/1000 to 10⁶ decays at ζ = \
            1/1000, 1 and 50, for θ = 1 and 1/2; a damper with h c/m = 10⁹ keeps 1/(1 + 10⁹) of its velocity under θ = 1 and −(10⁹ − \
            2)/(10⁹ + 2) under θ = 1/2.",
        controls: &["θ = 1/2 in place of 1."],
        sources: &["chapter §8, three levels", "Hairer and Wanner, Solving Ordinary Differential Equations II, IV.3"],
        check: stiff,
    },
    Claim {
        id: "S8.backward-uncond",
        statement: "Implicit Euler is unconditionally stable on the spring, |G| < 1 for every h; the price is an O(h²) dissipation that \
            wipes out the contact's oscillation at large steps.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated; |G|² = 1/(1 + s²), per step (over a fixed time the loss is O(h), S8.implicit-diss).",
        argument: "Determinant 1/(1 + s²) and decay at s = 1/1000, 1, 2, 10⁶ in rationals, without damping; |G| = 1/√(1 + s²) in floating \
            point.",
        controls: &["θ = 1/2, for which |G| = 1."],
        sources: &["chapter §8, example on stability bounds"],
        check: backward,
    },
    Claim {
        id: "S8.implicit-diss",
        statement: "The price of θ = 1 is numerical dissipation O(h²).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "Per step: E⁺/E = 1/(1 + h²ω²). Over a fixed time t it is O(h), E(t) = E₀ (1 + h²ω²)^(−t/h) ≈ E₀ e^(−ω²ht).",
        argument: "ω = 1, t = 1, in rationals: the energy lost with h = 1/32 over that with h = 1/64 lies within 1/16 of 2, not of 4; the \
            loss of one step over that of half a step within 1/16 of 4.",
        controls: &["The loss of one step in the place of that over a fixed time."],
        sources: &["chapter §8, three levels and table"],
        check: dissipation,
    },
    Claim {
        id: "S8.implicit-not-always",
        statement: "Fully implicit integration is not always best: each step is dearer, and its dissipation takes the motion away where \
            details or energy matter.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated.",
        argument: "Undamped spring, 20 steps of s = 1: θ = 1 leaves 2⁻²⁰ of the energy, θ = 1/2 all of it, and semi-implicit Euler returns \
            to its start after six steps, without solving anything.",
        controls: &["θ = 1/2 in place of 1."],
        sources: &["chapter §8, pitfall: fully implicit is always best"],
        check: not_always,
    },
    Claim {
        id: "S8.theta-spectrum",
        statement: "The θ scheme parametrises the spectrum: θ = 0 explicit, θ = 1 fully implicit, θ = 1/2 trapezoidal, close to a \
            symplectic method's neutrality in energy.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated; on linear forces θ = 1/2 is symplectic and keeps the energy exactly: E⁺/E = (1 + (1−θ)²s²)/(1 + \
            θ²s²), determinant the same number.",
        argument: "hω = 3/10 in rationals, θ = 0, 1/4, 1/2, 3/4, 1, by two implementations: energy ratio and determinant are the formula, \
            and 1 at θ = 1/2.",
        controls: &["θ = 2/5 in the place of 1/2."],
        sources: &["chapter §8, bridge to §3"],
        check: spectrum,
    },
    Claim {
        id: "S8.semi-on-spectrum",
        statement: "Semi-implicit Euler is a particular splitting (velocity implicit, position semi-implicit); it, the θ scheme of Siconos \
            and Drake's are points of the same spectrum.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "Of the spectrum from explicit to implicit, yes; no value of θ gives it unless the force is constant. It takes \
            the force at the old position, θ_v = 0, and the velocity at the new one, θ_q = 1.",
        argument: "Its determinant is 1, which on the θ family only θ = 1/2 has, where the trace is 2(4 − s²)/(4 + s²) ≠ 2 − s². At s = 1: \
            6/5 against 1. Under a constant force θ = 1 is the same step.",
        controls: &["The step of θ = 1/2 in place of that of semi-implicit Euler."],
        sources: &["chapter §8, bridge to §3"],
        check: no_theta,
    },
    Claim {
        id: "S8.backwards-theta-energy",
        statement: "θ = 1/2 is neutral in energy, θ = 1 dissipates.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "On forces that depend on the state. Under gravity alone θ = 1 loses ½ m g²h² per step of free flight, and an \
            elastic impact gives it back: E − (θ − ½) m g h v is conserved through flights and impacts, for every θ.",
        argument: "Elastic ball from 1 m, h = 1/100 s, 2000 steps with θ = 1 in rationals: (E − ½ m g h v)/E₀ = 1. One step of flight \
            loses ½ g²h² per kilogram. A spring with hω = 3/10 keeps 100/109 of its energy in a step with θ = 1, and all of it with θ = \
            1/2.",
        controls: &["The spring in the place of the ball."],
        sources: &["chapter §8, bridge to §3", "S3.energy-runs-down"],
        check: under_gravity,
    },
];

/// What one step with h c/m = 10⁹ leaves of the velocity of a mass on a damper.
pub(super) fn stiff_damper(method: &impl Method) -> Rational {
    let damper = SpringDamper { stiffness_per_mass: ratio(0, 1), damping_per_mass: ratio(1_000_000_000, 1) };
    matrix(method, &damper, &ratio(1, 1))[(1, 1)].clone()
}

fn stiff(reading: Reading) -> Result<Vec<Finding>> {
    let kept = stiff_damper(&reading.pick(theta(1, 1), theta(1, 2)));
    let mut findings = vec![
        Finding::exact("R(−10⁹) of θ = 1", &kept, &ratio(1, 1_000_000_001), "1"),
        Finding::exact("R(−10⁹) of θ = 1/2", &stiff_damper(&theta(1, 2)), &ratio(-999_999_998, 1_000_000_002), "1"),
    ];
    for (name, method) in [("1", theta(1, 1)), ("1/2", theta(1, 2))] {
        for zeta in [ratio(1, 1000), ratio(1, 1), ratio(50, 1)] {
            let decays = |s: &Rational| powers_at(&method, &zeta, s) == Powers::Decay;
            let steps = [ratio(1, 1000), ratio(1, 1), ratio(1_000_000, 1)];
            findings.push(Finding::decision(format!("θ = {name}, ζ = {zeta}: every step decays"), steps.iter().all(decays), true));
        }
    }
    Ok(findings)
}

fn backward(reading: Reading) -> Result<Vec<Finding>> {
    let method = reading.pick(theta(1, 1), theta(1, 2));
    let mut findings = Vec::new();
    for s in [ratio(1, 1000), ratio(1, 1), ratio(2, 1), ratio(1_000_000, 1)] {
        let step = matrix(&method, &SpringDamper::of_ratio(ratio(0, 1)), &s);
        let [_, determinant] = invariants(&step);
        let square = ratio(1, 1) / (ratio(1, 1) + &s * &s);
        findings.push(Finding::exact(format!("|G|² at s = {s}"), &determinant, &square, "1"));
        let decays = powers_at(&method, &ratio(0, 1), &s) == Powers::Decay;
        findings.push(Finding::decision(format!("decays at s = {s}"), decays, true));
        let radius = spectral_radius(&step.map(|entry| Scalar::to_f64(&entry)));
        let size = 1.0 / (1.0 + Scalar::to_f64(&s).powi(2)).sqrt();
        findings.push(Finding::equal(format!("|G| in floating point at s = {s}"), radius, size, rounding(16, size), "1"));
    }
    Ok(findings)
}

/// The share of its energy that an undamped spring with ω = 1 loses in a number of steps h with θ = 1.
fn loss(h: &Rational, steps: usize) -> f64 {
    let spring = SpringDamper::of_ratio(ratio(0, 1));
    let start = Phase::of_one(ratio(1, 1), ratio(0, 1));
    let end = (0..steps).fold(start.clone(), |now, _| theta(1, 1).step(&spring, &now, h));
    Scalar::to_f64(&(ratio(1, 1) - energy(&spring, &end) / energy(&spring, &start)))
}

fn dissipation(reading: Reading) -> Result<Vec<Finding>> {
    let (coarse, fine) = (ratio(1, 32), ratio(1, 64));
    let one_step = loss(&coarse, 1) / loss(&fine, 1);
    let fixed_time = reading.pick(loss(&coarse, 32) / loss(&fine, 64), one_step);
    Ok(vec![
        Finding::equal("loss over t = 1, h = 1/32 over h = 1/64", fixed_time, 2.0, HALVED, "1")
            .says(4.0)
            .violating("the loss is that of one step"),
        Finding::equal("loss of a step, h = 1/32 over h = 1/64", one_step, 4.0, HALVED, "1"),
        Finding::equal("E⁺/E at h = 1/32", 1.0 - loss(&coarse, 1), theta_energy_ratio(1.0, 1.0 / 32.0), rounding(4, 1.0), "1"),
    ])
}

fn not_always(reading: Reading) -> Result<Vec<Finding>> {
    let spring = SpringDamper::of_ratio(ratio(0, 1));
    let start = Phase::of_one(ratio(1, 1), ratio(1, 3));
    let kept = |method: &Theta| {
        let end = (0..20).fold(start.clone(), |now, _| method.step(&spring, &now, &ratio(1, 1)));
        energy(&spring, &end) / energy(&spring, &start)
    };
    let returned = (0..6).fold(start.clone(), |now, _| SEMI_IMPLICIT.step(&spring, &now, &ratio(1, 1)));
    Ok(vec![
        Finding::exact(
            "energy left by θ = 1 after 20 steps of s = 1",
            &kept(&reading.pick(theta(1, 1), theta(1, 2))),
            &ratio(1, 1 << 20),
            "1",
        ),
        Finding::exact("energy left by θ = 1/2", &kept(&theta(1, 2)), &ratio(1, 1), "1"),
        Finding::decision("semi-implicit Euler is back after six steps of s = 1", returned == start, true),
    ])
}

fn spectrum(reading: Reading) -> Result<Vec<Finding>> {
    let (spring, start) = undamped();
    let other = LinearSystem::scalar(ratio(1, 1), ratio(4, 1), ratio(0, 1));
    let h = ratio(3, 20);
    let middle = reading.pick(theta(1, 2), theta(2, 5));
    let [_, neutral] = invariants(&matrix(&middle, &spring, &h));
    let mut findings = vec![Finding::exact("determinant of the neutral member", &neutral, &ratio(1, 1), "1")];
    for (n, d) in [(0, 1), (1, 4), (1, 2), (3, 4), (1, 1)] {
        let method = theta(n, d);
        let (share, rest) = (ratio(n, d), ratio(d - n, d));
        let square = ratio(9, 100);
        let formula = (ratio(1, 1) + &rest * &rest * &square) / (ratio(1, 1) + &share * &share * &square);
        let next = method.step(&spring, &start, &h);
        let grown = energy(&spring, &next) / energy(&spring, &start);
        let [_, determinant] = invariants(&matrix(&method, &spring, &h));
        let twin = other.step(&phase(ratio(1, 1), ratio(1, 3)), &share, &h).0;
        findings.push(Finding::exact(format!("E⁺/E, θ = {share}"), &grown, &formula, "1"));
        findings.push(Finding::exact(format!("determinant, θ = {share}"), &determinant, &formula, "1"));
        let same = twin.position == next.position && twin.velocity == next.velocity;
        findings.push(Finding::decision(format!("the implementation of §3 takes the same step, θ = {share}"), same, true));
    }
    Ok(findings)
}

fn no_theta(reading: Reading) -> Result<Vec<Finding>> {
    let s = ratio(1, 1);
    let spring = SpringDamper::of_ratio(ratio(0, 1));
    let semi = matrix(&SEMI_IMPLICIT, &spring, &s);
    let half = matrix(&theta(1, 2), &spring, &s);
    let ([trace, determinant], [other, neutral]) = (invariants(&reading.pick(semi, half.clone())), invariants(&half));
    // a point of the spectrum with this determinant is θ = ½, as (1 + (1−θ)²s²)/(1 + θ²s²) falls with θ: the sentence gives it that trace
    let mut findings = vec![
        Finding::exact("determinant less that of θ = 1/2", &(determinant - neutral), &ratio(0, 1), "1"),
        Finding::exact("trace of semi-implicit Euler at s = 1", &trace, &ratio(1, 1), "1").says(&other).violating("a constant force"),
        Finding::exact("trace of θ = 1/2 at s = 1", &other, &ratio(6, 5), "1").context(),
    ];
    let determinants = [(0, 1), (1, 4), (1, 2), (3, 4), (1, 1)].map(|(n, d)| invariants(&matrix(&theta(n, d), &spring, &s))[1].clone());
    findings.push(Finding::decision("the determinant falls with θ", determinants.windows(2).all(|pair| pair[0] > pair[1]), true).context());
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(10, 1), restitution: ratio(0, 1) };
    let (start, h) = (BallState { position: ratio(5, 1), velocity: ratio(1, 1) }, ratio(1, 10));
    let after = ball.moreau_jean(&start, &ratio(1, 1), Activation::Gap, &h).motion;
    let constant = BallState { velocity: ratio(0, 1), position: ratio(5, 1) };
    findings.push(Finding::decision("under a constant force θ = 1 is semi-implicit Euler", after == constant, true));
    Ok(findings)
}

fn under_gravity(reading: Reading) -> Result<Vec<Finding>> {
    let (spring, start) = undamped();
    let left = |method: Theta| energy(&spring, &method.step(&spring, &start, &ratio(3, 20))) / energy(&spring, &start);
    let (kept, neutral) = (left(theta(1, 1)), left(theta(1, 2)));
    let dissipated = reading.pick(elastic_invariant(), kept.clone()) < ratio(1, 1);
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(981, 100), restitution: ratio(1, 1) };
    let (flying, h) = (BallState { position: ratio(1, 1), velocity: ratio(1, 2) }, ratio(1, 100));
    let flown = ball.moreau_jean(&flying, &ratio(1, 1), Activation::Gap, &h).motion;
    let lost = ball.energy(&flying) - ball.energy(&flown);
    let fall = &h * ratio(981, 100);
    Ok(vec![
        Finding::decision("2000 steps with θ = 1 have taken from E − ½ m g h v of an elastic ball", dissipated, false)
            .says(true)
            .violating("forces that depend on the state"),
        Finding::exact("energy lost in a step of free flight, θ = 1", &lost, &(&fall * &fall / ratio(2, 1)), "J"),
        Finding::exact("E⁺/E of a spring, θ = 1, hω = 3/10", &kept, &ratio(100, 109), "1"),
        Finding::exact("E⁺/E of a spring, θ = 1/2, hω = 3/10", &neutral, &ratio(1, 1), "1"),
    ])
}
