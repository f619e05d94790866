//! What is looked up of Pinocchio: its wheel, and its repository.

use super::query::{Holds, Query};
use super::release::{BULLET, PINOCCHIO, PINOCCHIO_2, PINOCCHIO_3};
use super::row::{Instead, LookUp, Says, Wanted};

/// The files that the chapter names; the second is printed without the folder that it shares with the first.
const PRINTED: &[&str] = &["include/pinocchio/algorithm/admm-solver.hxx", "include/pinocchio/algorithm/contact-cholesky.hpp"];
const NAMED: Query = Query::Named(&["admm-solver.hxx", "contact-cholesky.hpp"]);
/// What switches ADMM from Coulomb's law to the convex problem.
const SWITCH: Query = Query::Lists(&["settings"], &["solve_ncp"]);

/// The rows.
pub const ROWS: &[LookUp] = &[
    LookUp::new(
        "S10.pinocchio-row",
        "3.7.0: proximal term, power of ρ, compliance",
        PINOCCHIO_3,
        Query::Lists(&["admm_takes"], &["mu_prox", "rho_power", "R"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, PINOCCHIO_3, Query::Lists(&["admm_takes"], &["mu_prox", "admm_update_rule", "R"]))]),
    LookUp::new(
        "S10.pinocchio-row",
        "4.1.0: projected Gauss–Seidel",
        PINOCCHIO,
        Query::PathsEnding(&["/pgs-solver.hpp"]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, BULLET, Query::PathsEnding(&["/pgs-solver.hpp"]))]),
    LookUp::new("S10.pinocchio-row", "4.1.0: ADMM solves the CCP as well", PINOCCHIO, SWITCH, Wanted::Decision(true))
        .controls(&[Instead::Under(1, BULLET, SWITCH)]),
    LookUp::new(
        "S10.pinocchio-row",
        "3.7.0: ADMM solves the CCP as well",
        PINOCCHIO_3,
        Query::Lists(&["admm_takes"], &["solve_ncp"]),
        Wanted::Decision(false),
    )
    .says(Says::Is(1))
    .violating("release 4")
    .controls(&[Instead::Under(0, PINOCCHIO, SWITCH)]),
    LookUp::new(
        "S10.route-pinocchio",
        "the switch to the NCP is on unless set",
        PINOCCHIO,
        Query::Holds(&[Holds::True(&["settings", "solve_ncp"])]),
        Wanted::Decision(true),
    )
    .controls(&[Instead::Under(1, PINOCCHIO, Query::Holds(&[Holds::True(&["settings", "mu_prox"])]))]),
    LookUp::new("S10.path-pinocchio", "Pinocchio 3.7.0: printed paths", PINOCCHIO_3, Query::Files(PRINTED), Wanted::Count(2))
        .controls(&[Instead::Always(PINOCCHIO, Query::PathsEnding(PRINTED))]),
    LookUp::new("S10.path-pinocchio", "Pinocchio 4.1.0: printed paths", PINOCCHIO, Query::PathsEnding(PRINTED), Wanted::Count(0)).context(),
    LookUp::new(
        "S10.path-pinocchio",
        "4.1.0: the new places",
        PINOCCHIO,
        Query::PathsEnding(&["include/pinocchio/algorithm/solvers/admm-solver.hpp", "deprecated/pinocchio/algorithm/contact-cholesky.hpp"]),
        Wanted::Decision(true),
    )
    .context(),
    LookUp::new("V.pinocchio", "files of the printed names", PINOCCHIO_3, NAMED, Wanted::Count(2))
        .controls(&[Instead::Always(PINOCCHIO_2, NAMED)]),
    LookUp::new("V.pinocchio", "ADMM takes mu_prox", PINOCCHIO_3, Query::Lists(&["admm_takes"], &["mu_prox"]), Wanted::Decision(true))
        .controls(&[Instead::Always(PINOCCHIO_2, Query::Lists(&["admm_takes"], &["mu_prox"]))]),
    LookUp::new("V.pinocchio", "ADMM takes R", PINOCCHIO_3, Query::Lists(&["admm_takes"], &["R"]), Wanted::Decision(true))
        .controls(&[Instead::Always(PINOCCHIO_2, Query::Lists(&["admm_takes"], &["R"]))]),
];
