//! What is looked up of Siconos: Debian's packages, the literature that its headers cite, and its repository.

use super::query::Query;
use super::release::{BULLET, SICONOS, SICONOS_440, SICONOS_450, SICONOS_2026};
use super::row::{Instead, LookUp, Says, Wanted};

/// A class of the row of simulators, by the name of its header.
const fn class(finding: &'static str, name: &'static [&'static str]) -> LookUp {
    LookUp::new("S10.siconos-row", finding, SICONOS, Query::Lists(&["headers"], name), Wanted::Decision(true))
}

/// A solver of the row of simulators, by its identifier.
const fn solver(finding: &'static str, name: &'static [&'static str]) -> LookUp {
    LookUp::new("S10.siconos-row", finding, SICONOS, Query::Lists(&["solvers"], name), Wanted::Decision(true))
}

/// Words that a bibliography in the headers has.
const fn cited(claim: &'static str, finding: &'static str, words: &'static str) -> LookUp {
    LookUp::new(claim, finding, SICONOS, Query::Words(&["cited"], words), Wanted::Decision(true))
}

/// A source that a library was compiled from.
const fn compiled(claim: &'static str, finding: &'static str, source: &'static [&'static str]) -> LookUp {
    LookUp::new(claim, finding, SICONOS, Query::Lists(&["sources"], source), Wanted::Decision(true))
}

/// The files of Siconos that the chapter names.
const PRINTED: Query = Query::Files(&[
    "numerics/src/FrictionContact/fc3d_nsgs.c",
    "numerics/src/FrictionContact/fc3d_nonsmooth_Newton_AlartCurnier.c",
    "numerics/src/FrictionContact/gfc3d_ipm.c",
    "kernel/src/simulationTools/MoreauJeanOSI.cpp",
]);

/// The same with the folder of other problems, and a folder that came later.
const ELSEWHERE: Query = Query::Files(&[
    "numerics/src/LCP/fc3d_nsgs.c",
    "numerics/src/LCP/fc3d_nonsmooth_Newton_AlartCurnier.c",
    "numerics/src/LCP/gfc3d_ipm.c",
    "kernel/src/simulation/MoreauJeanOSI.cpp",
]);

const FREMOND: Query = Query::Named(&["FremondImpactFrictionNSL.cpp"]);
const PRINTED_CLASS: Query = Query::Lists(&["headers"], &["CombinedProjectedMoreauJeanOSI"]);
const PROJECTING_CLASS: Query = Query::Lists(&["headers"], &["MoreauJeanCombinedProjectionOSI"]);
const FOUNDING: &str = "which papers found the analysis of convergence";

/// The rows.
pub const ROWS: &[LookUp] = &[
    LookUp::new(
        "S1.all-ts",
        "Siconos has both",
        SICONOS,
        Query::Lists(&["headers"], &["TimeStepping", "EventDriven"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, SICONOS, Query::Lists(&["headers"], &["TimeStepping", "EventTracking"]))]),
    LookUp::new("S3.siconos-path", "4.4.0 has a class of the printed name", SICONOS, PRINTED_CLASS, Wanted::Decision(false))
        .says(Says::Is(1))
        .controls(&[Instead::Under(0, SICONOS, PROJECTING_CLASS)]),
    compiled("S3.siconos-path", "compiled from the printed path", &["kernel/src/simulationTools/MoreauJeanOSI.cpp"])
        .controls(&[Instead::Under(1, SICONOS, Query::Lists(&["sources"], &["kernel/src/simulation/MoreauJeanOSI.cpp"]))]),
    cited(
        "S3.cmame",
        "Moreau wrote of numerical aspects of the sweeping process",
        "J.J. Moreau. Numerical aspects of the sweeping process.",
    )
    .opinion(FOUNDING)
    .controls(&[Instead::Always(SICONOS, Query::Words(&["cited"], "J.J. Moreau. Convergence of the sweeping process."))]),
    cited("S3.cmame", "Jean wrote of the contact dynamics method", "M. Jean. The non smooth contact dynamics method.")
        .opinion(FOUNDING)
        .controls(&[Instead::Always(SICONOS, Query::Words(&["cited"], "M. Jean. Convergence of the contact dynamics method."))]),
    cited("S3.cmame", "pages 329–349 of volume 177, 1999, are cited", "177:329–349, 1999")
        .controls(&[Instead::Always(SICONOS, Query::Words(&["cited"], "167:329–349, 1999"))]),
    cited("S3.cmame", "pages 235–257 of volume 177, 1999, are cited", "177:235–257, 1999")
        .controls(&[Instead::Always(SICONOS, Query::Words(&["cited"], "167:235–257, 1999"))]),
    cited("S3.ab-chapters", "Siconos cites volume 35 of the series", "volume 35 of Lecture Notes")
        .opinion("what is an encyclopaedia")
        .controls(&[Instead::Always(SICONOS, Query::Words(&["cited"], "volume 53 of Lecture Notes"))]),
    LookUp::new(
        "S5.who-uses",
        "Siconos solves over second-order cones",
        SICONOS,
        Query::Lists(&["solvers"], &["FRICTION_3D_SOCLCP"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, SICONOS, Query::Lists(&["solvers"], &["mjCONE_ELLIPTIC"]))]),
    LookUp::new(
        "S5.who-uses",
        "Siconos solves over polyhedral cones",
        SICONOS,
        Query::Lists(&["solvers"], &["FRICTION_3D_GAMS_LCP_PATH"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, SICONOS, Query::Lists(&["solvers"], &["mjCONE_PYRAMIDAL"]))]),
    LookUp::new("S7.fremond-2024", "files of a Frémond law in Siconos 4.5.0", SICONOS_450, FREMOND, Wanted::Count(1))
        .controls(&[Instead::Under(1, SICONOS_440, FREMOND)]),
    LookUp::new("S9.siconos-class", "4.4.0 has a class of the printed name", SICONOS, PRINTED_CLASS, Wanted::Decision(false))
        .says(Says::Is(1))
        .controls(&[Instead::Under(0, SICONOS, PROJECTING_CLASS)]),
    cited("S9.refs", "CMAME 256:224–250, 2013 is cited by Siconos", "256:224 – 250, 2013").controls(&[Instead::Under(
        1,
        SICONOS,
        Query::Words(&["cited"], "265:224 – 250, 2013"),
    )]),
    cited("S9.refs", "as projected event-capturing schemes", "Projected event-capturing time-stepping").controls(&[Instead::Under(
        1,
        SICONOS,
        Query::Words(&["cited"], "Projected event-driven time-stepping"),
    )]),
    LookUp::new("S9.refs", "with Runge and Kutta in its title", SICONOS, Query::Words(&["cited"], "Runge"), Wanted::Decision(false))
        .opinion("what the papers, which were not read, hold")
        .controls(&[Instead::Under(1, SICONOS, Query::Words(&["cited"], "nonsmooth mechanical systems"))]),
    LookUp::new("S10.siconos-row", "a Frémond law in 4.5.0", SICONOS_450, FREMOND, Wanted::Decision(true)).controls(&[Instead::Under(
        1,
        SICONOS_440,
        FREMOND,
    )]),
    LookUp::new("S10.siconos-row", "a Frémond law in 4.4.0", SICONOS_440, FREMOND, Wanted::Decision(false))
        .says(Says::Is(1))
        .violating("release 4.5.0 or later")
        .controls(&[Instead::Under(0, SICONOS_450, FREMOND)]),
    class("has MoreauJeanOSI", &["MoreauJeanOSI"]).controls(&[Instead::Under(1, BULLET, Query::PathsEnding(&["MoreauJeanOSI"]))]),
    class("has SchatzmanPaoliOSI", &["SchatzmanPaoliOSI"]).controls(&[Instead::Under(
        1,
        BULLET,
        Query::PathsEnding(&["SchatzmanPaoliOSI"]),
    )]),
    class("has LsodarOSI", &["LsodarOSI"]).controls(&[Instead::Under(1, BULLET, Query::PathsEnding(&["LsodarOSI"]))]),
    class("has EventDriven", &["EventDriven"]).controls(&[Instead::Under(1, BULLET, Query::PathsEnding(&["EventDriven"]))]),
    class("has NewMarkAlphaOSI", &["NewMarkAlphaOSI"]).controls(&[Instead::Under(1, BULLET, Query::PathsEnding(&["NewMarkAlphaOSI"]))]),
    class("has NewtonImpactNSL", &["NewtonImpactNSL"]).controls(&[Instead::Under(1, BULLET, Query::PathsEnding(&["NewtonImpactNSL"]))]),
    class("has NewtonImpactFrictionNSL", &["NewtonImpactFrictionNSL"]).controls(&[Instead::Under(
        1,
        BULLET,
        Query::PathsEnding(&["NewtonImpactFrictionNSL"]),
    )]),
    solver("has the solver NSGS", &["FRICTION_3D_NSGS"]).controls(&[Instead::Under(1, BULLET, Query::PathsEnding(&["FRICTION_3D_NSGS"]))]),
    solver("has the solver NSN_AC", &["FRICTION_3D_NSN_AC"]).controls(&[Instead::Under(
        1,
        BULLET,
        Query::PathsEnding(&["FRICTION_3D_NSN_AC"]),
    )]),
    solver("has the solver NSN_FB", &["FRICTION_3D_NSN_FB"]).controls(&[Instead::Under(
        1,
        BULLET,
        Query::PathsEnding(&["FRICTION_3D_NSN_FB"]),
    )]),
    solver("has the solver NSN_NM", &["FRICTION_3D_NSN_NM"]).controls(&[Instead::Under(
        1,
        BULLET,
        Query::PathsEnding(&["FRICTION_3D_NSN_NM"]),
    )]),
    solver("has the solver PROX", &["FRICTION_3D_PROX"]).controls(&[Instead::Under(1, BULLET, Query::PathsEnding(&["FRICTION_3D_PROX"]))]),
    solver("has the solver VI_EG", &["FRICTION_3D_VI_EG"]).controls(&[Instead::Under(
        1,
        BULLET,
        Query::PathsEnding(&["FRICTION_3D_VI_EG"]),
    )]),
    solver("has an interior-point solver", &["GLOBAL_FRICTION_3D_IPM"]).controls(&[Instead::Under(
        1,
        BULLET,
        Query::PathsEnding(&["GLOBAL_FRICTION_3D_IPM"]),
    )]),
    LookUp::new(
        "S10.siconos-row",
        "of SchatzmanPaoliOSI and NewMarkAlphaOSI, those that Python shows",
        SICONOS,
        Query::Lists(&["python"], &["SchatzmanPaoliOSI", "NewMarkAlphaOSI"]),
        Wanted::Count(0),
    )
    .context(),
    LookUp::new(
        "S10.table-instances",
        "Siconos has a Moreau–Jean step",
        SICONOS,
        Query::Lists(&["headers"], &["MoreauJeanOSI"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, BULLET, Query::PathsEnding(&["MoreauJeanOSI"]))]),
    compiled("S10.path-siconos", "4.4.0: MoreauJeanOSI.cpp", &["kernel/src/simulationTools/MoreauJeanOSI.cpp"])
        .controls(&[Instead::Under(1, SICONOS, Query::Lists(&["sources"], &["kernel/src/simulation/MoreauJeanOSI.cpp"]))]),
    compiled("S10.path-siconos", "4.4.0: fc3d_nsgs.c", &["numerics/src/FrictionContact/fc3d_nsgs.c"]).controls(&[Instead::Under(
        1,
        SICONOS,
        Query::Lists(&["sources"], &["numerics/src/LCP/fc3d_nsgs.c"]),
    )]),
    compiled("S10.path-siconos", "4.4.0: the Alart–Curnier file", &["numerics/src/FrictionContact/fc3d_nonsmooth_Newton_AlartCurnier.c"])
        .controls(&[Instead::Under(1, SICONOS, Query::Lists(&["sources"], &["numerics/src/LCP/fc3d_nonsmooth_Newton_AlartCurnier.c"]))]),
    LookUp::new(
        "S10.path-siconos",
        "4.4.0: functions of gfc3d_ipm.c",
        SICONOS,
        Query::Lists(&["functions"], &["gfc3d_ipm_set_default"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, SICONOS, Query::Lists(&["functions"], &["fc3d_ipm_set_default"]))]),
    LookUp::new("S10.path-siconos", "Siconos 4.5.0: printed paths", SICONOS_450, PRINTED, Wanted::Count(4)).controls(&[Instead::Under(
        1,
        SICONOS_450,
        ELSEWHERE,
    )]),
    LookUp::new("S10.path-siconos", "Siconos at 6070f0f6: printed paths", SICONOS_2026, PRINTED, Wanted::Count(2))
        .says(Says::Is(4))
        .violating("a release up to 4.5.0")
        .controls(&[Instead::Under(0, SICONOS_450, PRINTED), Instead::Under(1, SICONOS_2026, ELSEWHERE)]),
];
