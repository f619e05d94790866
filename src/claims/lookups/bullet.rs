//! What is looked up of Bullet: the source distribution of PyBullet.

use super::query::Query;
use super::release::{BULLET, PINOCCHIO, SICONOS};
use super::row::{Instead, LookUp, Wanted};

/// Where Bullet sets the error reduction of contacts by default.
pub const ERP: Query = Query::Decimal("btContactSolverInfo.h", "m_erp2 = btScalar(");
/// Where PyBullet's server sets it.
pub const SERVER_ERP: Query = Query::Decimal("PhysicsServerCommandProcessor.cpp", "m_data->m_dynamicsWorld->getSolverInfo().m_erp2 = ");
const PIVOTING: Query = Query::PathsEnding(&["/btLemkeSolver.h", "/btDantzigSolver.h"]);

/// The rows.
pub const ROWS: &[LookUp] = &[
    LookUp::new("S9.bullet-erp", "Bullet's m_erp2", BULLET, ERP, Wanted::Fraction(1, 5)).controls(&[Instead::Under(1, BULLET, SERVER_ERP)]),
    LookUp::new(
        "S10.h-ranges",
        "1/60 s is Bullet's default",
        BULLET,
        Query::Line("/btContactSolverInfo.h", "m_timeStep = btScalar(1.f / 60.f);"),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, BULLET, Query::Line("/PhysicsServerCommandProcessor.cpp", "m_timeStep = btScalar(1.f / 60.f);"))]),
    LookUp::new("S10.bullet-row", "the solvers' files", BULLET, PIVOTING, Wanted::Decision(true))
        .controls(&[Instead::Always(PINOCCHIO, PIVOTING)]),
    LookUp::new(
        "S10.bullet-row",
        "h = 1/60 s unless set",
        BULLET,
        Query::Line("/btContactSolverInfo.h", "m_timeStep = btScalar(1.f / 60.f);"),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Always(PINOCCHIO, Query::Line("/btContactSolverInfo.h", "m_timeStep = btScalar(1.f / 60.f);"))]),
    LookUp::new("S10.table-instances", "Bullet has solvers of LCPs", BULLET, PIVOTING, Wanted::Decision(true)).controls(&[Instead::Under(
        1,
        SICONOS,
        Query::Lists(&["headers"], &["/btLemkeSolver.h", "/btDantzigSolver.h"]),
    )]),
    LookUp::new(
        "S10.table-instances",
        "Bullet has sequential impulses",
        BULLET,
        Query::PathsEnding(&["/btSequentialImpulseConstraintSolver.cpp"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, SICONOS, Query::Lists(&["headers"], &["/btSequentialImpulseConstraintSolver.cpp"]))]),
    LookUp::new(
        "S10.path-bullet",
        "src/BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.cpp",
        BULLET,
        Query::PathsEnding(&["src/BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.cpp"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Always(BULLET, Query::PathsEnding(&["src/BulletDynamics/MLCPSolvers/btSequentialImpulseConstraintSolver.cpp"]))]),
    LookUp::new(
        "S10.path-bullet",
        "src/BulletDynamics/Featherstone/btMultiBodyConstraintSolver.cpp",
        BULLET,
        Query::PathsEnding(&["src/BulletDynamics/Featherstone/btMultiBodyConstraintSolver.cpp"]),
        Wanted::Decision(true),
    )
    .context(),
];
