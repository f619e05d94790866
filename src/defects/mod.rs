//! Planted mistakes: each is a subject with one line of reasoning wrong, and the checks that exist to catch it.
//!
//! A check that no planted mistake can fail is not a check. `tests/defects.rs` shows every mistake caught and every reference passed.

pub use moreau_checks::defects::{
    certificates, cone_projection, convergence, decisions, delassus, energy, readers, schemes, solvers, stewart_trinkle, zeno,
};
pub use moreau_checks::planted::{Beside, Family, Kind, Planted, Trial};
pub use moreau_replicas::energy_balance::defects as energy_balance;

/// Every mistake that stands beside its own reference.
pub fn beside() -> impl Iterator<Item = &'static Planted<Beside>> {
    let families = [
        delassus::DEFECTS,
        stewart_trinkle::DEFECTS,
        cone_projection::DEFECTS,
        zeno::DEFECTS,
        energy::DEFECTS,
        energy_balance::DEFECTS,
        convergence::DEFECTS,
    ];
    families.into_iter().flatten()
}
