//! MuJoCo's row of the table of simulators.

use crate::claims::experiments::mujoco::facts;
use crate::claims::experiments::repositories::{MUJOCO, MUJOCO_SOLVERS};
use crate::claims::experiments::soft::default_contact;
use crate::claims::experiments::soft_stack::{self, STEP};
use crate::claims::prelude::*;
use crate::closed_forms::mujoco_contact::ContactParameters;
use crate::problem::Law;
use crate::schemes::mujoco::Cone;
use crate::tolerance::claims::soft::{AT_TOUCH, TOUCH, inside_contact};

pub const CLAIMS: &[Claim] = &[ROW, PATH];

const PATH: Claim = Claim {
    id: "S10.path-mujoco",
    statement: "MuJoCo: src/engine/engine_solver.c with mj_solPGS, mj_solCG and mj_solNewton, src/engine/engine_core_constraint.c; MJX: \
        mjx/_src/solver.py.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Path,
    severity: Some(Severity::Misprint),
    evidence: Evidence::Cited,
    correct_statement: "The two C files are right. In the repository MJX's file is mjx/mujoco/mjx/_src/solver.py; what the chapter gives \
        is its path in the Python package mujoco, while the paths beside it start at the root of the repository.",
    argument: "The library of the pinned release names the C files that it was compiled from, as the compiler left them. Paths, functions \
        and MJX's file: tree of the repository at commit a725507 of August 2026.",
    controls: &["The root of the package in place of that of the repository."],
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
    correct_statement: "As stated, with implicit and discrete added to the integrators, and differentiable only where no contact touches \
        or lets go within the step (S6.mjx-gradients).",
    argument: "Integrators, solvers and the default h = 2 ms are the pinned release's. A step with pyramids has one-sided rows only, a \
        quadratic program; with elliptic cones it is a second-order cone program. A ball that falls at 1 m/s, 10⁻¹² m above and below \
        touch: v⁺ jumps by d₀ h (g + b v) = 0.207 m/s; 1 mm deep it does not.",
    controls: &["A ball without weight that rests at touch, where nothing jumps."],
    sources: &["chapter §10, table", "MuJoCo 3.17.0, answers in references/facts/mujoco.json"],
    check: row,
};

pub(in crate::claims) fn paths(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let compiled = |name: &str| Finding::decision(format!("compiled from {name}"), facts.lists(&["stated", "sources"], name), true);
    let root = reading.pick("", "mjx/mujoco/");
    let mjx = "mjx/_src/solver.py";
    Ok(vec![
        compiled("engine_solver.c"),
        compiled("engine_core_constraint.c"),
        Finding::count(
            "MuJoCo at a725507: printed paths of C files",
            MUJOCO.count(&["src/engine/engine_solver.c", "src/engine/engine_core_constraint.c"]),
            2,
        ),
        Finding::decision(
            "mj_solPGS, mj_solCG and mj_solNewton",
            ["mj_solPGS", "mj_solCG", "mj_solNewton"].iter().all(|name| MUJOCO_SOLVERS.contains(name)),
            true,
        ),
        Finding::decision("MJX's printed path from the package", MUJOCO.has_below("mjx/mujoco/", mjx), true),
        Finding::decision("MJX's printed path from the repository", MUJOCO.has_below(root, mjx), false)
            .says(true)
            .violating("a path that starts at the Python package"),
    ])
}

/// By how much v⁺ \[m/s\] of a ball at this depth \[m\] changes as the depth passes through it, from 10⁻¹² m less to as much more.
pub(in crate::claims) fn change_of_step(depth: f64, velocity: f64, gravity: f64) -> f64 {
    let contact = default_contact(STEP);
    let [near, _] = TOUCH;
    contact.impulse(depth + near, velocity, -gravity) - contact.impulse(depth - near, velocity, -gravity)
}

/// Whether the step has a derivative, where the chapter says so: inside a contact it has, and at touch v⁺ jumps.
pub(in crate::claims) fn differentiable(reading: Reading) -> Vec<Finding> {
    let (velocity, gravity) = reading.pick((-1.0, 9.81), (0.0, 0.0));
    let (stiffness, damping) = ContactParameters::default().stiffness_and_damping(STEP);
    let jump = 0.9 * STEP * (9.81 + damping);
    vec![
        Finding::equal(
            "change of v⁺ over 2·10⁻¹² m of depth, 1 mm deep",
            change_of_step(0.001, velocity, gravity),
            0.0,
            inside_contact(STEP, stiffness, damping),
            "m/s",
        ),
        Finding::equal(
            "change of v⁺ over 2·10⁻¹² m of depth, at touch",
            change_of_step(0.0, velocity, gravity),
            jump,
            AT_TOUCH * jump,
            "m/s",
        )
        .says(0.0)
        .violating("no contact touches or lets go within the step"),
    ]
}

fn row(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let all = |path: &str, names: &[&str]| names.iter().all(|name| facts.has(&["stated", path], name));
    let h = facts.number(&["stated", "defaults", "timestep"])?;
    let law = |cone: Cone| soft_stack::ball(cone).map(|problem| problem.law());
    let mut findings = vec![
        Finding::decision("a quadratic program with pyramids", law(Cone::Pyramidal)? == Law::PolyhedralAssociated { directions: 4 }, true),
        Finding::decision("a second-order cone program with elliptic cones", law(Cone::Elliptic)? == Law::Associated, true),
        Finding::decision("the three integrators", all("integrators", &["EULER", "IMPLICITFAST", "RK4"]), true),
        Finding::decision("the three solvers", all("solvers", &["PGS", "CG", "NEWTON"]), true),
        Finding::decision("the default step is between 1 and 10 ms", (0.001..=0.01).contains(&h), true),
    ];
    findings.extend(differentiable(reading));
    Ok(findings)
}
