//! Siconos in the comparison of simulators: its row, its school, its files.

use crate::claims::experiments::siconos::{alpha_impact, slide};
use crate::claims::lookups::{self, looked_up};
use crate::claims::prelude::*;
use crate::mechanics::{PointMass, State};
use crate::problem::Law;
use crate::schemes::{GeneralisedAlpha, step};
use crate::solvers::LemkePivoting;
use crate::tolerance::references::SICONOS_PER_STEP;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S10.siconos-row",
        statement: r"Siconos: Moreau–Jean $\theta$, Schatzman–Paoli, event-driven, nonsmooth generalised-α; NSGS, AC/FB/NM nonsmooth
            Newton, proximal, VI extragradient, interior point; Newton, Moreau and Frémond laws built in.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Cited,
        correct_statement: "As of 4.5.0 of March 2024, which brought FremondImpactFrictionNSL. Its generalised-α, NewMarkAlphaOSI, is the \
            smooth method within the event-driven strategy, not the scheme of Chen, Acary, Virlez and Brüls. From the Python of 4.4.0 \
            neither NewMarkAlphaOSI nor SchatzmanPaoliOSI can be reached.",
        argument: r"Headers and solver identifiers of Debian's packages 4.4.0+dfsg-2; the trees of 4.4.0 and 4.5.0. A stored fall under
            NewMarkAlphaOSI, $e = \tfrac12$: the ball arrives downwards and leaves at +95.8 m/s, by the factor
            $1 - (1 - \alpha_m)/((1 - \alpha_f)\gamma)\,h$'/$h^2$ of 4.4.0's formula; under the nonsmooth scheme $v^+ = -e\,v^-$.",
        controls: &[
            "The tree of 4.5.0 in place of that of 4.4.0.",
            "Bullet's package in the place of Siconos's, and 4.4.0 in the place of 4.5.0.",
        ],
        sources: &[
            "chapter §10, table of simulators",
            "Siconos 4.4.0 in Debian; github.com/siconos/siconos, tags 4.4.0 and 4.5.0, and 6070f0f6",
        ],
        check: check!(row),
    },
    Claim {
        id: "S10.siconos-not-avoid",
        statement: "Siconos is the school that faces the NCP or SOCCP: it does not evade nonsmoothness, and is mathematically the most \
            rigorous, with the most complete set of solvers.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Opinion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "Rigour and completeness are matters of taste. What can be checked: its steps solve Coulomb's law, not the \
            convex relaxation; a sliding block does not lift off.",
        argument: r"Stored steps of a block that slides under Siconos's Moreau–Jean, $e = 1/2$: $u_n^+ + e\,u_n = 0$ and $r_t = -\mu\,r_n$
            to rounding while $u_t^+$ is above the 0.3 m/s of the start. The relaxation would have $u_n^+ + e\,u_n = \mu\,u_t^+$.",
        controls: &["The same steps made again under the relaxed law.", "A block that sticks."],
        sources: &["chapter §10, three schools"],
        check: check!(school),
    },
    Claim {
        id: "S10.path-siconos",
        statement: "In Siconos look at numerics/src/FrictionContact/fc3d_nsgs.c, fc3d_nonsmooth_Newton_AlartCurnier.c and gfc3d_ipm.c, \
            and at kernel/src/simulationTools/MoreauJeanOSI.cpp; such paths really exist on the main branch, though files may move a \
            little from version to version.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Path,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Cited,
        correct_statement: "All four for the releases up to 4.5.0 of March 2024. On the main branch of August 2026 two have moved: \
            MoreauJeanOSI.cpp to kernel/src/simulation/, and the Alart–Curnier file to FrictionContact/nsn_formulation/.",
        argument: "The names of three are in Debian's libraries 4.4.0+dfsg-2 as the compiler left them, the fourth by its functions; all \
            four are in the tree of the tag 4.5.0, and two in that of August 2026.",
        controls: &[
            "The tree of 4.5.0 in place of that of August 2026.",
            "Other folders: that of the LCPs, and simulation/ for simulationTools/; fc3d_ipm for gfc3d_ipm.",
        ],
        sources: &[
            "chapter §10, where to look in the sources",
            "Siconos 4.4.0 in Debian; github.com/siconos/siconos, tag 4.5.0 and 6070f0f6",
        ],
        check: looked_up!("S10.path-siconos"),
    },
];

/// |v⁺ + e v⁻| \[m/s\] of a ball that falls on the floor, in the step of our nonsmooth generalised-α in which it arrives.
fn nonsmooth_impact() -> Result<f64> {
    let (scheme, ball) = (GeneralisedAlpha::default(), PointMass::ball_on_floor(2.0, 9.81, 0.5));
    let arriving = State { time: 0.0, position: dvector![-0.001], velocity: dvector![-4.5] };
    let taken = step(&scheme, &LemkePivoting, &ball, &arriving, 0.05)?;
    Ok((taken.state.velocity[0] + 0.5 * arriving.velocity[0]).abs())
}

fn row(reading: Reading) -> Result<Vec<Finding>> {
    let impact = alpha_impact()?;
    let mut findings = lookups::check("S10.siconos-row", reading)?;
    // what Python shows is told last, after what the classes do
    let shown = findings.pop();
    findings.extend([
        Finding::equal("v⁺ of an impact under NewMarkAlphaOSI", impact.leaving, impact.predicted, impact.rounding, "m/s")
            .experiment()
            .context(),
        Finding::equal("|v⁺ + e v⁻| under our nonsmooth generalised-α", nonsmooth_impact()?, 0.0, impact.rounding, "m/s").context(),
    ]);
    findings.extend(shown);
    Ok(findings)
}

fn school(reading: Reading) -> Result<Vec<Finding>> {
    let found = slide(reading.only(1).pick(false, true), reading.only(0).pick(None, Some(Law::Associated)))?;
    let [slip, start] = found.tangential;
    let rigour = "rigour and completeness";
    Ok(vec![
        Finding::equal("largest |u_n⁺ + e u_n| of a sliding block", found.normal, 0.0, SICONOS_PER_STEP, "m/s")
            .opinion(rigour)
            .experiment(),
        Finding::at_least("smallest u_t⁺ of the steps, that of the start being 0.3 m/s", slip, start, "m/s").experiment(),
        Finding::equal("largest |r_t/r_n + μ|", found.cone, 0.0, SICONOS_PER_STEP, "1").experiment(),
    ])
}
