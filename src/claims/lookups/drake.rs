//! What is looked up of Drake: its Python package and the documentation in it, and its repository.

use super::query::{Holds, Query};
use super::release::{DRAKE, DRAKE_2026, EICH, MUJOCO};
use super::row::{Instead, LookUp, Says, Wanted};

/// The rows.
pub const ROWS: &[LookUp] = &[
    LookUp::new(
        "S1.all-ts",
        "Drake locates zeros of witness functions",
        DRAKE,
        Query::Holds(&[Holds::True(&["locates_events"])]),
        Wanted::Decision(true),
    )
    .says(Says::Is(0))
    .controls(&[Instead::Under(0, MUJOCO, Query::Lists(&[], &["locates_events"]))]),
    LookUp::new(
        "S1.all-ts",
        "Drake's continuous plant is integrated by a Runge–Kutta method under error control",
        DRAKE,
        Query::Holds(&[
            Holds::True(&["continuous_integrator", "controls_error"]),
            Holds::Text(&["continuous_integrator", "name"], "RungeKutta3Integrator"),
        ]),
        Wanted::Decision(true),
    )
    .says(Says::Is(0))
    .controls(&[Instead::Under(0, MUJOCO, Query::Lists(&[], &["continuous_integrator"]))]),
    LookUp::new(
        "S4.drake-name",
        "mentions of the name in the present documentation",
        DRAKE,
        Query::Count(&["mentions", "timesteppingrigidbodyplant"]),
        Wanted::Count(0),
    )
    .controls(&[Instead::Under(0, DRAKE, Query::Count(&["mentions", "multibodyplant"]))]),
    LookUp::new(
        "S9.drake-projection",
        "mentions of “coordinate projection”",
        DRAKE,
        Query::Count(&["mentions", "coordinate projection"]),
        Wanted::Count(0),
    )
    .says(Says::AtLeast(1))
    .controls(&[Instead::Under(0, EICH, Query::Mentions(&["cited_as"], "coordinate projection"))]),
    LookUp::new(
        "S10.drake-tamsi-row",
        "documented as non-convex, and able to fail",
        DRAKE,
        Query::Holds(&[Holds::Text(&["may_fail"], "kTamsi")]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, DRAKE, Query::Holds(&[Holds::Text(&["may_fail"], "kLagged")]))]),
    LookUp::new(
        "S10.drake-tamsi-row",
        "announced for removal from 2026-09-01 on",
        DRAKE,
        Query::Holds(&[Holds::Text(&["tamsi_removed_from"], "2026-09-01")]),
        Wanted::Decision(true),
    )
    .context(),
    LookUp::new(
        "S10.drake-sap-row",
        "mentions of a midpoint in the plant's documentation",
        DRAKE,
        Query::Count(&["mentions", "midpoint"]),
        Wanted::Count(0),
    )
    .says(Says::AtLeast(1))
    .violating("SAP as published, not as a plant steps")
    .controls(&[Instead::Under(1, DRAKE, Query::Count(&["mentions", "contact"]))]),
    LookUp::new(
        "S10.drake-sap-row",
        "dissipation of kSap is Kelvin–Voigt",
        DRAKE,
        Query::Holds(&[Holds::Text(&["dissipation_of_sap"], "Kelvin–Voigt")]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, DRAKE, Query::Holds(&[Holds::Text(&["dissipation_of_sap"], "Hunt–Crossley")]))]),
    LookUp::new(
        "S10.drake-sap-row",
        "the default approximation is kLagged",
        DRAKE,
        Query::Holds(&[Holds::Text(&["default_approximation"], "kLagged")]),
        Wanted::Decision(true),
    )
    .context(),
    LookUp::new(
        "S10.all-delassus",
        "kSap and kLagged take one solver",
        DRAKE,
        Query::Holds(&[Holds::Same(&["solvers", "kSap"], &["solvers", "kLagged"])]),
        Wanted::Decision(true),
    )
    .context(),
    LookUp::new(
        "S10.drake-default-sap",
        "the default is kSap",
        DRAKE,
        Query::Holds(&[Holds::Text(&["default_solver"], "kSap")]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Always(DRAKE, Query::Holds(&[Holds::Text(&["default_approximation"], "kSap")]))]),
    LookUp::new(
        "S10.drake-default-sap",
        "every approximation but TAMSI takes the solver kSap",
        DRAKE,
        Query::Holds(&[
            Holds::Text(&["solvers", "kSap"], "kSap"),
            Holds::Text(&["solvers", "kSimilar"], "kSap"),
            Holds::Text(&["solvers", "kLagged"], "kSap"),
        ]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Always(
        DRAKE,
        Query::Holds(&[
            Holds::Text(&["solvers", "kSap"], "kSap"),
            Holds::Text(&["solvers", "kSimilar"], "kSap"),
            Holds::Text(&["solvers", "kLagged"], "kSap"),
            Holds::Text(&["solvers", "kTamsi"], "kSap"),
        ]),
    )]),
    LookUp::new(
        "S10.path-drake",
        "Drake at be259df7: printed paths",
        DRAKE_2026,
        Query::Files(&["multibody/plant/tamsi_solver.cc", "multibody/contact_solvers/sap/sap_solver.cc"]),
        Wanted::Count(2),
    )
    .controls(&[Instead::Under(
        1,
        DRAKE_2026,
        Query::Files(&["multibody/contact_solvers/sap/tamsi_solver.cc", "multibody/plant/sap_solver.cc"]),
    )]),
    LookUp::new("S10.path-drake", "contact solvers that day", DRAKE, solvers_left("2026-08-20"), Wanted::Count(2))
        .controls(&[Instead::Under(0, DRAKE, solvers_left("2026-11-21"))]),
    LookUp::new("S10.path-drake", "contact solvers later", DRAKE, solvers_left("2026-11-21"), Wanted::Count(1)).context(),
];

/// How many contact solvers are left of those that the package offers, if TAMSI goes as announced.
const fn solvers_left(day: &'static str) -> Query {
    Query::LeftOn { among: &["solvers"], leaves: "kTamsi", from: &["tamsi_removed_from"], day }
}
