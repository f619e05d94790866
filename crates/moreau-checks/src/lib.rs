//! Checks: functions that take a subject (our reference, a planted defect, a claim's reading) and return [`Finding`]s.
//!
//! A check derives its expected value from a closed form, exact arithmetic or a proven bound – never from the subject. Every family has
//! planted
//! [`defects`]: references with one textbook mistake each, which its checks must catch.

pub mod answers;
mod bearing;
pub mod cone_projection;
pub mod convergence;
pub mod decisions;
pub mod defects;
pub mod delassus;
pub mod energy;
mod expectation;
mod finding;
pub mod forms;
pub mod formula;
pub mod planted;
pub mod plot;
pub mod readers;
mod relation;
mod says;
pub mod stewart_trinkle;
pub mod text;
pub mod tolerance;
pub mod zeno;

pub use bearing::{Bearing, FindingOrigin, Stated, Value, Voice};
pub use expectation::Expectation;
pub use finding::Finding;
pub use relation::Relation;
