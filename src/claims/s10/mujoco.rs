//! MuJoCo's row of the table of simulators.

use crate::Result;
use crate::checks::Finding;
use crate::claims::experiments::mujoco::facts;
use crate::claims::experiments::soft_stack;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::problem::Law;
use crate::schemes::mujoco::Cone;

pub const CLAIMS: &[Claim] = &[ROW, PATH];

const PATH: Claim = Claim {
    id: "S10.path-mujoco",
    statement: "MuJoCo: src/engine/engine_solver.c with mj_solPGS, mj_solCG and mj_solNewton, engine_core_constraint.c; MJX: \
        mujoco/mjx/_src/solver.py.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Cited,
    correct_statement: "The two C files are right. In the repository MJX's file is mjx/mujoco/mjx/_src/solver.py; what the chapter gives \
        is its path in the package.",
    argument: "The library of the pinned release names the C files that it was compiled from, as the compiler left them. The functions and \
        MJX's file: repository at commit a725507 of August 2026, not asked of a package.",
    control: "engine_pgs.c in place of engine_solver.c.",
    sources: &["chapter §10, source files", "MuJoCo 3.17.0, answers in references/facts/mujoco.json", "MuJoCo's repository at a725507"],
    check: paths,
};

const ROW: Claim = Claim {
    id: "S10.mujoco-row",
    statement: "MuJoCo: semi-implicit Euler, implicitfast, RK4; PGS, CG, Newton; a quadratic or second-order cone program; no explicit \
        impact law; h from 1 to 10 ms; differentiable.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Measured,
    correct_statement: "As stated, with implicit and discrete added to the integrators and without “differentiable” (S6.mjx-gradients).",
    argument: "Integrators, solvers and the default h = 2 ms are the pinned release's. A step with pyramids has one-sided rows only, a \
        quadratic program; with elliptic cones it is a second-order cone program.",
    control: "One cone in place of the two.",
    sources: &["chapter §10, table", "MuJoCo 3.17.0, answers in references/facts/mujoco.json"],
    check: row,
};

pub(in crate::claims) fn paths(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let compiled = |name: &str| Finding::decision(format!("compiled from {name}"), facts.lists(&["stated", "sources"], name), true);
    Ok(vec![compiled(reading.pick("engine_solver.c", "engine_pgs.c")), compiled("engine_core_constraint.c")])
}

fn row(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let all = |path: &str, names: &[&str]| names.iter().all(|name| facts.has(&["stated", path], name));
    let h = facts.number(&["stated", "defaults", "timestep"])?;
    let law = |cone: Cone| soft_stack::ball(cone).map(|problem| problem.law());
    Ok(vec![
        Finding::decision(
            "a quadratic program with pyramids",
            law(reading.pick(Cone::Pyramidal, Cone::Elliptic))? == Law::PolyhedralAssociated { directions: 4 },
            true,
        ),
        Finding::decision("a second-order cone program with elliptic cones", law(Cone::Elliptic)? == Law::Associated, true),
        Finding::decision("the five integrators", all("integrators", &["EULER", "IMPLICIT", "IMPLICITFAST", "RK4", "DISCRETE"]), true),
        Finding::decision("the three solvers", all("solvers", &["PGS", "CG", "NEWTON"]), true),
        Finding::decision("the default step is between 1 and 10 ms", (0.001..=0.01).contains(&h), true),
    ])
}
