//! Checks: functions that take a subject (our reference, a planted defect, a claim's reading) and return [`Finding`]s.
//!
//! A check derives its expected value from a closed form, exact arithmetic or a proven bound – never from the subject.

pub mod bullet_steps;
pub mod energy_balance;
pub mod replay;
pub mod siconos_alpha;
pub mod siconos_events;
pub mod siconos_steps;

pub use moreau_checks::{Finding, Relation, cone_projection, convergence, delassus, energy, stewart_trinkle, text, zeno};
