//! Siconos in the comparison of simulators: its row, its school, its files.

use crate::Result;
use crate::checks::Finding;
use crate::claims::experiments::siconos::{Facts, slide};
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::tolerance::references::SICONOS_PER_STEP;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S10.siconos-row",
        statement: "Siconos: Moreau–Jean θ, Schatzman–Paoli, event-driven, nonsmooth generalised-α; NSGS, AC/FB/NM nonsmooth Newton, \
            proximal, VI extragradient, interior point; Newton, Moreau and Frémond laws built in.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Cited,
        correct_statement: "In release 4.4.0 all but two: there is no Frémond law (FremondImpactFrictionNSL is in the development version \
            only), and its generalised-α, NewMarkAlphaOSI, is a Newmark-α integrator for constrained smooth motion, used with event \
            handling, not the nonsmooth scheme of Chen, Acary and Brüls. From Python neither NewMarkAlphaOSI nor SchatzmanPaoliOSI can be \
            reached.",
        argument: "Headers and solver identifiers of Debian's packages 4.4.0+dfsg-2. MoreauJeanOSI activates φ + ½h u_n ≤ 0 with the \
            present velocity: our scheme with that rule reproduces its stored steps to 1e-12, the other two rules do not.",
        control: "A Frémond law in 4.4.0.",
        sources: &["chapter §10, table of simulators", "Siconos 4.4.0 in Debian; github.com/siconos/siconos at 6070f0f6"],
        check: row,
    },
    Claim {
        id: "S10.siconos-not-avoid",
        statement: "Siconos is the school that faces the NCP or SOCCP: it does not evade nonsmoothness, and is mathematically the most \
            rigorous, with the most complete set of solvers.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "Rigour and completeness are matters of taste. What can be checked: its steps solve Coulomb's law, not the \
            convex relaxation; a sliding block does not lift off.",
        argument: "Stored steps of a block that slides under Siconos's Moreau–Jean, e = 1/2: u_n⁺ + e u_n = 0 and r_t = −μ r_n to rounding \
            while u_t⁺ ≥ 0.33 m/s. The relaxation would have u_n⁺ + e u_n = μ u_t⁺ ≥ 0.1 m/s.",
        control: "The relaxation's u_n⁺ + e u_n = μ|u_t⁺|.",
        sources: &["chapter §10, three schools"],
        check: school,
    },
    Claim {
        id: "S10.path-siconos",
        statement: "In Siconos look at numerics/src/FrictionContact/fc3d_nsgs.c, fc3d_nonsmooth_Newton_AlartCurnier.c and gfc3d_ipm.c, and \
            at kernel/src/simulationTools/MoreauJeanOSI.cpp.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Cited,
        correct_statement: "All four for the releases up to 4.4.0. In the development version of August 2026 two have moved: \
            MoreauJeanOSI.cpp to kernel/src/simulation/, and the Alart–Curnier file to FrictionContact/nsn_formulation/.",
        argument: "The names of three are in Debian's libraries 4.4.0+dfsg-2 as the compiler left them, the fourth by its functions; all \
            four are in the tag 4.4.0, and two at commit 6070f0f6.",
        control: "The path of the development version, looked for in 4.4.0.",
        sources: &[
            "chapter §10, where to look in the sources",
            "Siconos 4.4.0 in Debian; github.com/siconos/siconos, tag 4.4.0 and 6070f0f6",
        ],
        check: paths,
    },
];

fn row(reading: Reading) -> Result<Vec<Finding>> {
    let facts = Facts::stored()?;
    let mut findings = vec![Finding::decision("a Frémond law in 4.4.0", facts.has("FremondImpactFrictionNSL"), reading.pick(false, true))];
    for class in
        ["MoreauJeanOSI", "SchatzmanPaoliOSI", "LsodarOSI", "EventDriven", "NewMarkAlphaOSI", "NewtonImpactNSL", "NewtonImpactFrictionNSL"]
    {
        findings.push(Finding::decision(format!("has {class}"), facts.has(class), true));
    }
    for solver in ["NSGS", "NSN_AC", "NSN_FB", "NSN_NM", "PROX", "VI_EG"] {
        findings.push(Finding::decision(format!("has the solver {solver}"), facts.solves_with(&format!("FRICTION_3D_{solver}")), true));
    }
    findings.push(Finding::decision("has an interior-point solver", facts.solves_with("GLOBAL_FRICTION_3D_IPM"), true));
    for class in ["SchatzmanPaoliOSI", "NewMarkAlphaOSI"] {
        findings.push(Finding::decision(format!("Python shows {class}"), facts.python.iter().any(|name| name == class), false));
    }
    Ok(findings)
}

fn school(reading: Reading) -> Result<Vec<Finding>> {
    let [normal, tangential, cone] = slide()?;
    let lift = reading.pick(0.0, 0.3 * tangential);
    Ok(vec![
        Finding::equal("largest |u_n⁺ + e u_n| of a sliding block", normal, lift, SICONOS_PER_STEP, "m/s"),
        Finding::at_least("smallest u_t⁺", tangential, 0.33, "m/s"),
        Finding::equal("largest |r_t/r_n + μ|", cone, 0.0, SICONOS_PER_STEP, "1"),
    ])
}

pub(in crate::claims) fn paths(reading: Reading) -> Result<Vec<Finding>> {
    let facts = Facts::stored()?;
    let folder = reading.pick("simulationTools", "simulation");
    let contact = "numerics/src/FrictionContact";
    Ok(vec![
        Finding::decision("MoreauJeanOSI.cpp", facts.compiled(&format!("kernel/src/{folder}/MoreauJeanOSI.cpp")), true),
        Finding::decision("fc3d_nsgs.c", facts.compiled(&format!("{contact}/fc3d_nsgs.c")), true),
        Finding::decision("the Alart–Curnier file", facts.compiled(&format!("{contact}/fc3d_nonsmooth_Newton_AlartCurnier.c")), true),
        Finding::decision("functions of gfc3d_ipm.c", facts.functions.iter().any(|name| name == "gfc3d_ipm_set_default"), true),
    ])
}
