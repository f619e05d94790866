//! MuJoCo's row of the table of simulators.

use crate::Result;
use crate::checks::Finding;
use crate::claims::experiments::mujoco::facts;
use crate::claims::experiments::soft_stack;
use crate::claims::{Claim, Evidence, Reading, Verdict};
use crate::problem::Law;
use crate::schemes::mujoco::Cone;

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S10.mujoco-row",
    statement: "MuJoCo: semi-implicit Euler, implicitfast, RK4; PGS, CG, Newton; a quadratic or second-order cone program; no explicit impact law; h from 1 to 10 ms; differentiable.",
    verdict: Verdict::Conditional,
    evidence: Evidence::Measured,
    correct_statement: "As stated, with implicit and discrete added to the integrators and without “differentiable” (S6.mjx-gradients).",
    argument: "Integrators, solvers and the default h = 2 ms are the pinned release's. A step with pyramids has one-sided rows only, a quadratic program; with elliptic cones it is a second-order cone program.",
    control: "One cone in place of the two.",
    sources: &["chapter §10, table", "MuJoCo 3.17.0, answers in references/facts/mujoco.json"],
    check: row,
}];

fn row(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let all = |path: &str, names: &[&str]| names.iter().all(|name| facts.has(&["stated", path], name));
    let h = facts.number(&["stated", "defaults", "timestep"])?;
    let law = |cone: Cone| soft_stack::ball(cone).map(|problem| problem.law);
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
