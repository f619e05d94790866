//! MuJoCo's version and defaults, as the pinned release states them.

use crate::claims::experiments::mujoco::facts;
use crate::claims::experiments::touch::differentiable;
use crate::claims::prelude::*;
use crate::closed_forms::mujoco_contact::ContactParameters;

const STORED: &str = "MuJoCo 3.17.0, asked by scripts/generate_references.py, answers in references/facts/mujoco.json";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "V.mujoco",
        statement: "MuJoCo 3.x, open source; MJX is differentiable.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Path,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "The version is a matter of date: 3.x is what this repository pins (3.17.0), 4.0.0 appeared in November 2026. \
            The step that MJX differentiates has a derivative where no contact touches or lets go within it (S6.mjx-gradients).",
        argument: "The pinned package calls itself 3.17.0. Of 4.0.0 only the package index was consulted, on 2026-11-21. Of the step: \
            S10.mujoco-row; MJX itself was not run.",
        controls: &["A ball without weight that rests at touch, where nothing jumps."],
        sources: &["chapter, table of versions", STORED],
        check: version,
    },
    Claim {
        id: "V.defaults",
        statement: "MuJoCo's defaults: solref (0.02, 1), solimp (0.9, 0.95, 0.001, 0.5, 2), Newton, semi-implicit Euler; timeconst ≥ 2h; a \
            spring needs h ≤ 2√(m/k).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "The defaults are right. The bound on h is that of the undamped spring; with an explicit damper c it is h²k + \
            2hc ≤ 4m, and smaller.",
        argument: "Asked of the pinned release. Semi-implicit step on k = m = 1, c = 1 at h = 3/2 < 2: det = −1/2, trace = −7/4, and 1 + \
            trace + det = −5/4 < 0: an eigenvalue below −1.",
        controls: &["c = 0."],
        sources: &["chapter, table of defaults", STORED],
        check: defaults,
    },
];

fn version(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = vec![Finding::decision("the pinned release is 3.x", facts()?.text(&["version"]).starts_with("3."), true)];
    findings.extend(differentiable(reading));
    Ok(findings)
}

/// 1 + trace + det of the semi-implicit step with an explicit damper, k = m = 1: negative where an eigenvalue is below −1.
fn below(step: &Rational, damping: &Rational) -> Rational {
    // v⁺ = (1 − hc) v − h x, x⁺ = x + h v⁺
    let (one, pull) = (ratio(1, 1), ratio(1, 1) - step * damping);
    let trace = (&one - step * step) + &pull;
    one + trace + pull
}

fn defaults(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let number = |key: &str| facts.number(&["stated", "defaults", key]);
    let ours = ContactParameters::default();
    let list = |key: &str| facts.numbers(&["stated", "defaults", key]);
    let shortest = ContactParameters { reference: [0.001, 1.0], ..ours }.stiffness_and_damping(0.01);
    let two_steps = ContactParameters { reference: [0.02, 1.0], ..ours }.stiffness_and_damping(0.01);
    let damping = reading.pick(ratio(1, 1), ratio(0, 1));
    Ok(vec![
        Finding::exact("1 + trace + det at h = 3/2 without damper", &below(&ratio(3, 2), &ratio(0, 1)), &ratio(7, 4), "1")
            .says_at_least(ratio(0, 1)),
        Finding::exact("1 + trace + det at h = 3/2", &below(&ratio(3, 2), &damping), &ratio(-5, 4), "1")
            .says_at_least(ratio(0, 1))
            .violating("no damper"),
        Finding::decision(
            "solref and solimp",
            list("solref")?.as_slice() == ours.reference && list("solimp")?.as_slice() == ours.impedance,
            true,
        ),
        Finding::decision(
            "Newton and Euler",
            number("solver")? == facts.number(&["stated", "solvers", "NEWTON"])? && number("integrator")? == 0.0,
            true,
        ),
        Finding::decision("timeconst counts as 2h where it is shorter", shortest == two_steps, true),
    ])
}
