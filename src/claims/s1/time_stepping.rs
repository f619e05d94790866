//! Time-stepping: what its limit is, how it takes an impact, and its order between impacts.

use crate::checks::convergence::{Stop, plastic_ball};
use crate::claims::experiments::painleve::answers;
use crate::claims::experiments::wall::{Stepping, approach};
use crate::claims::prelude::*;
use crate::claims::s11::compactness::{mass_apart, weakly};
use crate::exact_particle::{Ball, BallState};
use crate::mechanics::{OscillatorWithStop, State};
use crate::schemes::{Activation, MoreauJean, RestitutionRule, RungeKuttaFlip, Scheme, StewartTrinkle, simulate};
use crate::solvers::Auto;
use crate::tolerance::claims::ORDER_GAP;
use crate::trajectory::{Refinement, fit_order};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S1.ts-unique",
        statement: "In Zeno and Painlevé situations, where event-driven methods are undefined, time-stepping gives the unique correct \
            limit.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: "A limit of a subsequence. For the ball that falls under gravity the limit is unique; where two sliding forces \
            exist a step itself has three answers at every h, which tend to two different motions, \
            and the solver's pivoting decides between them. The chapter's §4 says so: existence is not uniqueness.",
        argument: "Rod at cos = 3/5, μ = 3/2 > 13/9, upward normal free acceleration b = 5 m/s²: P_n = 0, 125h/2 or 9/25 − 73h/20 for h \
            = 10⁻³ … 10⁻⁶, exactly three answers. The first two vanish with h, the third tends to the impact (9/25, 13/25) N·s, so the \
            answers do not come together.",
        controls: &["μ = 1 < μ_P: one answer."],
        sources: &["chapter §1, history; the pitfall in the same section; §4, existence and uniqueness"],
        check: several_limits,
    },
    Claim {
        id: "S1.stewart98",
        statement: "Stewart (1998) proves that the limit h → 0 of the scheme is a solution of the measure differential inclusion.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Citation,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: "A limit of a subsequence, of plastic impacts (e = 0), under conditions on the friction cone that the chapter \
            does not name. The paper was not read; what it concludes is checked on one motion, and why a subsequence is needed is shown.",
        argument: "Stewart–Trinkle on a plastic ball: sup|q|, ∫|v| and the graphs converge with order 1 within derived constants. On \
            Painlevé's rod with two sliding forces, μ = 3/2, the step has the answers P_n = 0 and 9/25 − 73h/20, each with its limit; \
            taken in turn they stay 9/25 N·s apart: the sequence has two limits, each of which is a solution.",
        controls: &["The smallest answer at every h: a subsequence."],
        sources: &[
            "chapter §1, pitfalls; §4",
            "Stewart, Convergence of a time-stepping scheme for rigid-body dynamics and resolution of Painlevé's problem (1998), not read",
        ],
        check: convergence,
    },
    Claim {
        id: "S1.weakstar",
        statement: "At impacts time-stepping is accurate in a robust sense: it converges weakly* to the solution of the measure \
            differential inclusion.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "For subsequences, where the limit is a solution (S1.stewart98). Weakly* is said of the impulses; velocities \
            converge in the mean and, away from the impacts, pointwise. Neither converges in a stronger sense: not the mass of the \
            difference, not the largest error of v.",
        argument: "Moreau–Jean, e = ½, on a wall hit at ⅓ s, h = 2⁻⁴ … 2⁻⁸ in rationals: ∫g dP_h → (3/2) g(⅓) for three functions with \
            errors ≤ 6h; the mass of P_h − (3/2) δ_⅓ is 3 and v_h(⅓ + h/3) = −1, not ½, at every h. Painlevé's rod, μ = 3/2: answers \
            taken in turn stay 9/25 N·s apart.",
        controls: &["The smallest answer at every h on the rod: a subsequence."],
        sources: &["chapter §1, table"],
        check: robust,
    },
    Claim {
        id: "S1.implicit-impact",
        statement: "Not detecting events does not mean ignoring impacts: the impact is the atom in the impulse of a step's complementarity \
            problem, with no event detection.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated. P = m(1+e)|v| + m g h in the step of the impact, m g h in a step at rest, 0 in flight: the first \
            stays as h → 0, the second is the weight times h.",
        argument: "Moreau–Jean on a ball of 3/2 kg, e = 1/2, v = −2 m/s at the floor, h = 10⁻¹ … 10⁻⁴ in rationals: P − m g h = 9/2 N·s at \
            every h.",
        controls: &["A ball that touches the floor at rest."],
        sources: &["chapter §1, pitfalls"],
        check: atom,
    },
    Claim {
        id: "S1.order12",
        statement: "Between impacts time-stepping is of order 1 to 2 (θ method, semi-implicit Euler).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: "As stated: order 2 for θ = ½ and linear forces, 1 for other θ and for Stewart–Trinkle.",
        argument: "q̈ = −4q, stop out of reach, error of q at 2 s for h = 2⁻⁶ … 2⁻⁹ s.",
        controls: &["The classical Runge–Kutta method in place of θ = ½."],
        sources: &["chapter §1, table"],
        check: order,
    },
];

fn several_limits(reading: Reading) -> Result<Vec<Finding>> {
    let friction = reading.pick(ratio(3, 2), ratio(1, 1));
    let mut findings = Vec::new();
    for exponent in [3, 4, 5, 6] {
        let h = ratio(1, 10i64.pow(exponent));
        let found = answers(&friction, &(ratio(5, 1) * &h))?;
        findings.push(Finding::count(format!("different answers of the step at h = 1e-{exponent} s"), found.len(), 3).says(1usize));
        let apart = &found[found.len() - 1] - &found[0];
        let expected = ratio(9, 25) - ratio(73, 20) * &h;
        findings.push(
            Finding::exact(format!("largest P_n less the smallest, h = 1e-{exponent} s"), &apart, &expected, "N·s").says(ratio(0, 1)),
        );
    }
    Ok(findings)
}

fn convergence(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = plastic_ball(&StewartTrinkle::default(), Stop::On)?;
    findings.push(answers_taken_in_turn(reading)?);
    Ok(findings)
}

/// How far the answers at h = 10⁻⁵ and 10⁻⁶ are apart on Painlevé's rod: the smallest and then the largest, or the smallest both times.
fn answers_taken_in_turn(reading: Reading) -> Result<Finding> {
    let at = |exponent: u32| answers(&ratio(3, 2), &ratio(5, 10i64.pow(exponent)));
    let (first, second) = (at(5)?, at(6)?);
    let next = &second[reading.pick(second.len() - 1, 0)];
    let expected = ratio(9, 25) - ratio(73, 20) / ratio(1_000_000, 1);
    let name = "P_n of the answer at h = 1e-6 s less that at h = 1e-5 s, taken in turn";
    // of a sequence that converges like its answers do, 73h/20 each
    let together = ratio(73, 20) * (ratio(1, 100_000) + ratio(1, 1_000_000));
    Ok(Finding::exact(name, &(next - &first[0]), &expected, "N·s").says_at_most(together).violating("a subsequence is taken"))
}

fn robust(reading: Reading) -> Result<Vec<Finding>> {
    let mass = ratio(3, 2);
    let mut findings = Vec::new();
    for k in 4..=8u32 {
        findings.extend(weakly(&approach(Stepping::MoreauJean, k), &mass, &format!("h = 2^-{k}")));
    }
    findings.push(answers_taken_in_turn(reading)?);
    let motion = approach(Stepping::MoreauJean, 8);
    findings.push(Finding::exact("mass of P_h − (3/2) δ, h = 2^-8", &mass_apart(&motion, &mass), &ratio(3, 1), "N·s").context());
    let late = motion.velocity_at(&(ratio(1, 3) + &motion.step * ratio(1, 3)));
    findings.push(Finding::exact("v_h(1/3 + h/3), h = 2^-8", &late, &ratio(-1, 1), "m/s").context());
    Ok(findings)
}

fn atom(reading: Reading) -> Result<Vec<Finding>> {
    let ball = Ball { mass: ratio(3, 2), gravity: ratio(981, 100), restitution: ratio(1, 2) };
    let half = ratio(1, 2);
    let mut findings = Vec::new();
    for exponent in 1..=4u32 {
        let h = ratio(1, 10i64.pow(exponent));
        let weight = &ball.mass * &ball.gravity * &h;
        let step = |position: Rational, velocity: Rational| {
            ball.moreau_jean(&BallState { position, velocity }, &half, Activation::Gap, &h).impulse
        };
        let arriving = reading.pick(ratio(-2, 1), ratio(0, 1));
        let impact = step(ratio(0, 1), arriving) - &weight;
        findings.push(Finding::exact(format!("P − m g h of the impact, h = 1e-{exponent} s"), &impact, &ratio(9, 2), "N·s"));
        findings.push(Finding::exact(format!("P at rest, h = 1e-{exponent} s"), &step(ratio(0, 1), ratio(0, 1)), &weight, "N·s"));
        findings.push(Finding::exact(format!("P in flight, h = 1e-{exponent} s"), &step(ratio(1, 1), ratio(-2, 1)), &ratio(0, 1), "N·s"));
    }
    Ok(findings)
}

/// Order of a scheme in q at 2 s on q̈ = −4q.
fn smooth_order(scheme: &dyn Scheme) -> Result<f64> {
    let spring = OscillatorWithStop::new(1.0, 4.0, 0.0, -100.0, 0.0)?;
    let level = |exponent: i32| -> Result<Refinement> {
        let steps = 1usize << (exponent + 1);
        let time_step = 2.0 / steps as f64;
        let start = State { time: 0.0, position: dvector![1.0], velocity: dvector![0.0] };
        let end = simulate(scheme, &Auto, &spring, start, time_step, steps)?.last().position[0];
        Ok(Refinement { time_step, error: (end - 4f64.cos()).abs() })
    };
    Ok(fit_order((6..=9).map(level).collect::<Result<_>>()?)?.slope)
}

fn order(reading: Reading) -> Result<Vec<Finding>> {
    let theta = |theta| MoreauJean { theta, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
    let (midpoint, implicit, fourth) = (theta(0.5), theta(1.0), RungeKuttaFlip);
    let subject: &dyn Scheme = reading.pick(&midpoint, &fourth);
    let cases: [(&str, &dyn Scheme, f64); 3] = [
        ("Moreau–Jean, θ = ½", subject, 2.0),
        ("Moreau–Jean, θ = 1", &implicit, 1.0),
        ("Stewart–Trinkle", &StewartTrinkle::default(), 1.0),
    ];
    let finding = |(name, scheme, expected): (&str, &dyn Scheme, f64)| -> Result<Finding> {
        Ok(Finding::equal(format!("order of {name}"), smooth_order(scheme)?, expected, ORDER_GAP, "1"))
    };
    cases.into_iter().map(finding).collect()
}
