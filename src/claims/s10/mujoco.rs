//! MuJoCo's row of the table of simulators.

use crate::claims::experiments::soft_stack;
use crate::claims::experiments::touch::differentiable;
use crate::claims::lookups::{self, looked_up};
use crate::claims::prelude::*;
use crate::problem::Law;
use crate::schemes::mujoco::Cone;

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
    controls: &[
        "The root of the package in place of that of the repository.",
        "The names without their prefixes, `engine_`, `mj_` and `mjx/`.",
    ],
    sources: &["chapter §10, source files", "MuJoCo 3.17.0, answers in references/facts/mujoco.json", "MuJoCo's repository at a725507"],
    check: looked_up!("S10.path-mujoco"),
};

const ROW: Claim = Claim {
    id: "S10.mujoco-row",
    statement: r"MuJoCo: semi-implicit Euler, implicitfast, RK4; PGS, CG, Newton; a quadratic or second-order cone program; no explicit
        impact law; $h$ from 1 to 10 ms; differentiable.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Cited,
    correct_statement: "As stated, with implicit and discrete added to the integrators, and differentiable only where no contact touches \
        or lets go within the step (S6.mjx-gradients).",
    argument: r"Integrators, solvers and the default $h = 2$ ms are the pinned release's. A step with pyramids has one-sided rows only, a
        quadratic program; with elliptic cones it is a second-order cone program. A ball that falls at 1 m/s, $10^{-12}$ m above and below
        touch: $v^+$ jumps by $d_0\,h\,(g + b\,v) = 0.207$ m/s; 1 mm deep it does not.",
    controls: &[
        "A ball without weight that rests at touch, where nothing jumps.",
        "The cones exchanged, other engines' integrators and solvers, timeconst in place of the step, a ball at touch in place of one 1 \
            mm deep.",
    ],
    sources: &["chapter §10, table", "MuJoCo 3.17.0, answers in references/facts/mujoco.json"],
    check: check!(row),
};

fn row(reading: Reading) -> Result<Vec<Finding>> {
    let [pyramids, elliptic] = reading.only(1).pick([Cone::Pyramidal, Cone::Elliptic], [Cone::Elliptic, Cone::Pyramidal]);
    let law = |cone: Cone| soft_stack::ball(cone).map(|problem| problem.law());
    let mut findings = vec![
        Finding::decision("a quadratic program with pyramids", law(pyramids)? == Law::PolyhedralAssociated { directions: 4 }, true),
        Finding::decision("a second-order cone program with elliptic cones", law(elliptic)? == Law::Associated, true),
    ];
    findings.extend(lookups::check("S10.mujoco-row", reading)?);
    findings.extend(differentiable(reading));
    Ok(findings)
}
