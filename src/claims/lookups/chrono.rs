//! What is looked up of Chrono: its repository.

use super::query::Query;
use super::release::CHRONO_2026;
use super::row::{Instead, LookUp, Says, Wanted};

/// The rows.
pub const ROWS: &[LookUp] = &[
    LookUp::new(
        "S10.chrono-row",
        "sources of the four solvers",
        CHRONO_2026,
        Query::Files(&[
            "src/chrono/solver/ChSolverPSOR.cpp",
            "src/chrono/solver/ChSolverBB.cpp",
            "src/chrono/solver/ChSolverAPGD.cpp",
            "src/chrono/solver/ChSolverADMM.cpp",
        ]),
        Wanted::Count(4),
    )
    .controls(&[Instead::Under(
        1,
        CHRONO_2026,
        Query::Files(&[
            "src/chrono_multicore/solver/ChSolverPSOR.cpp",
            "src/chrono_multicore/solver/ChSolverBB.cpp",
            "src/chrono_multicore/solver/ChSolverAPGD.cpp",
            "src/chrono_multicore/solver/ChSolverADMM.cpp",
        ]),
    )]),
    LookUp::new(
        "S10.chrono-granular",
        "sources for GPUs in the package",
        CHRONO_2026,
        Query::CountEnding(&["src/"], ".cu"),
        Wanted::Count(2),
    )
    .says(Says::AtLeast(1))
    .reading("of Chrono")
    .controls(&[Instead::Under(1, CHRONO_2026, Query::CountEnding(&["src/"], ".cl"))]),
    LookUp::new(
        "S10.chrono-granular",
        "sources for GPUs where NSC is",
        CHRONO_2026,
        Query::CountEnding(&["src/chrono/", "src/chrono_multicore/"], ".cu"),
        Wanted::Count(0),
    )
    .says(Says::AtLeast(1))
    .reading("of NSC")
    .controls(&[Instead::Under(0, CHRONO_2026, Query::CountEnding(&["src/chrono_dem/"], ".cu"))]),
    LookUp::new(
        "S10.table-instances",
        "Chrono has APGD",
        CHRONO_2026,
        Query::Files(&["src/chrono/solver/ChSolverAPGD.cpp"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, CHRONO_2026, Query::Below("src/chrono_multicore/solver/", "src/chrono/solver/ChSolverAPGD.cpp"))]),
    LookUp::new(
        "S10.path-chrono",
        "Chrono at 7689fbc: ChSolverAPGD.cpp",
        CHRONO_2026,
        Query::Files(&["src/chrono/solver/ChSolverAPGD.cpp"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Always(CHRONO_2026, Query::Files(&["src/chrono_multicore/solver/ChSolverAPGD.cpp"]))]),
    LookUp::new(
        "S10.path-chrono",
        "Chrono at 7689fbc: ChSolverADMM.cpp",
        CHRONO_2026,
        Query::Files(&["src/chrono/solver/ChSolverADMM.cpp"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Always(CHRONO_2026, Query::Files(&["src/chrono_multicore/solver/ChSolverADMM.cpp"]))]),
    LookUp::new(
        "S10.path-chrono",
        "Chrono at 7689fbc: ChSolverPSOR.cpp",
        CHRONO_2026,
        Query::Files(&["src/chrono/solver/ChSolverPSOR.cpp"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Always(CHRONO_2026, Query::Files(&["src/chrono_multicore/solver/ChSolverPSOR.cpp"]))]),
];
