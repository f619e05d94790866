//! Checks: functions that take a subject (our reference, a planted defect, a claim's reading) and return [`Finding`]s.
//!
//! A check derives its expected value from a closed form, exact arithmetic or a proven bound – never from the subject.

pub use moreau_checks::{
    Bearing, Expectation, Finding, FindingOrigin, Relation, Stated, Value, Voice, answers, cone_projection, convergence, decisions,
    delassus, energy, forms, formula, planted, readers, stewart_trinkle, text, zeno,
};
pub use moreau_replicas::bullet::steps as bullet_steps;
pub use moreau_replicas::drake::replay as drake_replay;
pub use moreau_replicas::energy_balance;
pub use moreau_replicas::siconos::{alpha as siconos_alpha, events as siconos_events, steps as siconos_steps};
