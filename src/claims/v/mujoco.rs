//! MuJoCo's version and defaults, as the pinned release states them.

use crate::claims::experiments::spring_damper::{SEMI_IMPLICIT, is_stable, matrix};
use crate::claims::experiments::touch::differentiable;
use crate::claims::lookups;
use crate::claims::prelude::*;
use crate::closed_forms::mujoco_contact::ContactParameters;
use crate::integrators::SpringDamper;
use crate::integrators::stability::invariants;

const STORED: &str = "MuJoCo 3.17.0, asked by scripts/generate_references.py, answers in references/facts/mujoco.json";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "V.mujoco",
        statement: "As of 2026, the repository prevails: MuJoCo is at 3.x, open source; MJX supports differentiation.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Path,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Cited,
        correct_statement: "The version is a matter of date: 3.x is what this repository pins (3.17.0), 4.0.0 appeared in November 2026. \
            The step that MJX differentiates has a derivative where no contact touches or lets go within it (S6.mjx-gradients).",
        argument: r"The pinned package calls itself 3.17.0. Of 4.0.0 only the package index was consulted, in November 2026. MJX itself
            was not run: the step is that of MuJoCo's default contact, $h = 2$ ms, whose velocity after a step jumps where a ball touches
            and not where it is 1 mm deep.",
        controls: &[
            "A ball without weight that rests at touch, where nothing jumps.",
            "A ball at touch in place of one 1 mm deep.",
            "Pinocchio's release in place of MuJoCo's.",
        ],
        sources: &["chapter, table of versions", STORED],
        check: check!(version),
    },
    Claim {
        id: "V.defaults",
        statement: r"MuJoCo's defaults: solref $(0.02, 1)$, solimp $(0.9, 0.95, 0.001, 0.5, 2)$, Newton, semi-implicit Euler. Empirical
            bounds of stability: timeconst $\ge 2h$, $h \le 2/\omega_0 = 2\sqrt{m/k}$.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Cited,
        correct_statement: r"The defaults are right. The bound on $h$ is that of the undamped spring; with an explicit damper $c$ it is
            $h^2k + 2hc \le 4m$, and smaller.",
        argument: r"Asked of the pinned release. A semi-implicit step on $k = m = 1$ at $h = 3/2 < 2$, decided in rationals: stable
            without damper, and not with $c = 1$, where 1 + trace + det $= -5/4 < 0$: an eigenvalue below −1.",
        controls: &[
            r"$c = 0$.",
            r"$h = 5/2$, beyond the bound.",
            r"Other names asked for (solref and solimp exchanged, CG, RK4), and a time constant above $2h$.",
        ],
        sources: &["chapter, table of defaults", STORED],
        check: check!(defaults),
    },
];

fn version(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = lookups::check("V.mujoco", reading)?;
    findings.extend(differentiable(reading));
    Ok(findings)
}

fn defaults(reading: Reading) -> Result<Vec<Finding>> {
    let ours = ContactParameters::default();
    let counts_as = |time_constant: f64| ContactParameters { reference: [time_constant, 1.0], ..ours }.stiffness_and_damping(0.01);
    // k = m = 1: c = 1 is ζ = 1/2
    let damping_ratio = reading.only(0).pick(ratio(1, 2), ratio(0, 1));
    let h = reading.only(1).pick(ratio(3, 2), ratio(5, 2));
    let mut findings = vec![
        Finding::decision("stable at h = 3/2 without damper, k = m = 1", is_stable(&SEMI_IMPLICIT, &ratio(0, 1), &h), true),
        Finding::decision("stable at h = 3/2 with c = 1", is_stable(&SEMI_IMPLICIT, &damping_ratio, &h), false)
            .says(true)
            .violating("no damper"),
    ];
    findings.extend(lookups::check("V.defaults", reading)?);
    findings.extend([
        Finding::decision(
            "timeconst counts as 2h where it is shorter",
            counts_as(reading.only(2).pick(0.001, 0.03)) == counts_as(0.02),
            true,
        ),
        Finding::exact(
            "1 + trace + det at h = 3/2 with c = 1",
            &beyond(&SpringDamper::of_ratio(ratio(1, 2)), &ratio(3, 2)),
            &ratio(-5, 4),
            "1",
        )
        .context(),
    ]);
    Ok(findings)
}

/// 1 + trace + det of a semi-implicit step h: negative where an eigenvalue is below −1.
fn beyond(spring: &SpringDamper, h: &Rational) -> Rational {
    let [trace, determinant] = invariants(&matrix(&SEMI_IMPLICIT, spring, h));
    ratio(1, 1) + trace + determinant
}
