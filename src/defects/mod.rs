//! Planted defects: each is a reference with one textbook mistake, and the check that exists to catch it.
//!
//! A check that no defect can fail is not a check. `tests/defects.rs` shows every defect caught and its reference passed.

pub mod matrix;

pub use moreau_checks::defects::{Defect, cone_projection, convergence, delassus, energy, stewart_trinkle, zeno};
pub use moreau_replicas::energy_balance::defects as energy_balance;

/// Every planted defect, family by family.
pub fn all() -> impl Iterator<Item = &'static Defect> {
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
