//! What is looked up of MuJoCo: its Python package, which tells its defaults and the files that it was compiled from, and its repository.

use super::query::{Holds, Query};
use super::release::{MUJOCO, MUJOCO_2026, PINOCCHIO};
use super::row::{Instead, LookUp, Says, Wanted};

const INTEGRATOR: &[&str] = &["defaults", "integrator"];
const SOLVER: &[&str] = &["defaults", "solver"];
const SOLREF: &[&str] = &["defaults", "solref"];
const SOLIMP: &[&str] = &["defaults", "solimp"];
const TIME_CONSTANT: &[&str] = &["defaults", "solref", "0"];
const DAMPING_RATIO: &[&str] = &["defaults", "solref", "1"];
/// The five numbers of the default impedance, as the chapter prints them.
const FIVE: &[f64] = &[0.9, 0.95, 0.001, 0.5, 2.0];

/// The rows.
pub const ROWS: &[LookUp] = &[
    LookUp::new(
        "S1.mujoco-euler",
        "number of the integrator, against the default",
        MUJOCO,
        Query::Times(&["integrators", "EULER"], 1.0),
        Wanted::At(INTEGRATOR),
    )
    .controls(&[Instead::Always(MUJOCO, Query::Times(&["integrators", "RK4"], 1.0))]),
    LookUp::new(
        "S6.euler-default",
        "the default is the main integrator of the sentence",
        MUJOCO,
        Query::Holds(&[Holds::Same(INTEGRATOR, &["integrators", "EULER"])]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(0, MUJOCO, Query::Holds(&[Holds::Same(INTEGRATOR, &["integrators", "RK4"])]))]),
    LookUp::new(
        "S6.euler-default",
        "implicitfast and RK4 exist",
        MUJOCO,
        Query::Lists(&["integrators"], &["IMPLICITFAST", "RK4"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, MUJOCO, Query::Lists(&["integrators"], &["IMPLICIT_EULER", "RUNGE_KUTTA3"]))]),
    LookUp::new(
        "S6.newton-desc",
        "the default solver is the one of the sentence",
        MUJOCO,
        Query::Holds(&[Holds::Same(SOLVER, &["solvers", "NEWTON"])]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Always(MUJOCO, Query::Holds(&[Holds::Same(SOLVER, &["solvers", "CG"])]))]),
    LookUp::new(
        "S6.solimp-default",
        "the five numbers are those of MuJoCo 3.17.0",
        MUJOCO,
        Query::Holds(&[Holds::Numbers(SOLIMP, FIVE)]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Always(MUJOCO, Query::Holds(&[Holds::Numbers(SOLIMP, &[0.9, 0.95, 0.001, 0.5, 1.0])]))]),
    LookUp::new(
        "S10.mujoco-row",
        "the three integrators",
        MUJOCO,
        Query::Lists(&["integrators"], &["EULER", "IMPLICITFAST", "RK4"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, MUJOCO, Query::Lists(&["integrators"], &["EULER", "MIDPOINT", "HHT"]))]),
    LookUp::new(
        "S10.mujoco-row",
        "the three solvers",
        MUJOCO,
        Query::Lists(&["solvers"], &["PGS", "CG", "NEWTON"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, MUJOCO, Query::Lists(&["solvers"], &["NSGS", "ADMM", "LEMKE"]))]),
    LookUp::new(
        "S10.mujoco-row",
        "the default step is between 1 and 10 ms",
        MUJOCO,
        Query::Within(&["defaults", "timestep"], [0.001, 0.01]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, MUJOCO, Query::Within(TIME_CONSTANT, [0.001, 0.01]))]),
    LookUp::new(
        "S10.h-ranges",
        "timeconst/2 of MuJoCo's default contact",
        MUJOCO,
        Query::Times(TIME_CONSTANT, 0.5),
        Wanted::Number(0.01, "s"),
    )
    .controls(&[Instead::Under(1, MUJOCO, Query::Times(DAMPING_RATIO, 0.5))]),
    LookUp::new(
        "S10.h-ranges",
        "MuJoCo's default lies in its range",
        MUJOCO,
        Query::Within(&["defaults", "timestep"], [0.001, 0.01]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, MUJOCO, Query::Within(TIME_CONSTANT, [0.001, 0.01]))]),
    LookUp::new(
        "S10.path-mujoco",
        "compiled from engine_solver.c",
        MUJOCO,
        Query::Lists(&["sources"], &["engine_solver.c"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, MUJOCO, Query::Lists(&["sources"], &["solver.c"]))]),
    LookUp::new(
        "S10.path-mujoco",
        "compiled from engine_core_constraint.c",
        MUJOCO,
        Query::Lists(&["sources"], &["engine_core_constraint.c"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, MUJOCO, Query::Lists(&["sources"], &["core_constraint.c"]))]),
    LookUp::new(
        "S10.path-mujoco",
        "MuJoCo at a725507: printed paths of C files",
        MUJOCO_2026,
        Query::Files(&["src/engine/engine_solver.c", "src/engine/engine_core_constraint.c"]),
        Wanted::Count(2),
    )
    .controls(&[Instead::Under(1, MUJOCO_2026, Query::Files(&["src/engine/solver.c", "src/engine/core_constraint.c"]))]),
    LookUp::new(
        "S10.path-mujoco",
        "mj_solPGS, mj_solCG and mj_solNewton",
        MUJOCO_2026,
        Query::Lists(&["functions"], &["mj_solPGS", "mj_solCG", "mj_solNewton"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, MUJOCO_2026, Query::Lists(&["functions"], &["solPGS", "solCG", "solNewton"]))]),
    LookUp::new(
        "S10.path-mujoco",
        "MJX's printed path from the package",
        MUJOCO_2026,
        Query::Below("mjx/mujoco/", "mjx/_src/solver.py"),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, MUJOCO_2026, Query::Below("mjx/mujoco/", "_src/solver.py"))]),
    LookUp::new(
        "S10.path-mujoco",
        "MJX's printed path from the repository",
        MUJOCO_2026,
        Query::Below("", "mjx/_src/solver.py"),
        Wanted::Decision(false),
    )
    .says(Says::Is(1))
    .violating("a path that starts at the Python package")
    .controls(&[Instead::Under(0, MUJOCO_2026, Query::Below("mjx/mujoco/", "mjx/_src/solver.py"))]),
    LookUp::new("V.mujoco", "the pinned release is 3.x", MUJOCO, Query::Version("3."), Wanted::Decision(true)).controls(&[Instead::Under(
        2,
        PINOCCHIO,
        Query::Version("3."),
    )]),
    LookUp::new(
        "V.defaults",
        "solref and solimp",
        MUJOCO,
        Query::Holds(&[Holds::Numbers(SOLREF, &[0.02, 1.0]), Holds::Numbers(SOLIMP, FIVE)]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(2, MUJOCO, Query::Holds(&[Holds::Numbers(SOLIMP, &[0.02, 1.0]), Holds::Numbers(SOLREF, FIVE)]))]),
    LookUp::new(
        "V.defaults",
        "Newton and Euler",
        MUJOCO,
        Query::Holds(&[Holds::Same(SOLVER, &["solvers", "NEWTON"]), Holds::Same(INTEGRATOR, &["integrators", "EULER"])]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(
        2,
        MUJOCO,
        Query::Holds(&[Holds::Same(SOLVER, &["solvers", "CG"]), Holds::Same(INTEGRATOR, &["integrators", "RK4"])]),
    )]),
];
