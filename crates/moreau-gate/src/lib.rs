//! The gate: any simulator, in any language, judged by one set of checks against its own model and against Coulomb–Signorini.
//!
//! ```text
//! Engine ──► Bench ──► Check at every time step of the sweep ──► Measurement ──► Verdict ──► Report, Baseline
//! ```
//! An [`Engine`] is a Rust type, a program that speaks `moreau-engine/1`, a folder of stored trajectories or one of our own schemes:
//! the checks cannot tell. A check measures; what it measures is held against the ideal (Coulomb–Signorini, with the discretisation
//! error derived for this h) and against what the engine's own declared law predicts.

#[cfg(test)]
mod absurd_tests;
mod accounted;
mod any_answer;
pub mod audit;
pub mod baseline;
pub mod bench;
pub mod cause;
pub mod check;
pub mod checks;
pub mod conformance;
pub mod description;
pub mod engine;
#[cfg(test)]
pub(crate) mod exact;
mod guarded;
pub mod library;
pub mod measurement;
pub mod model;
mod moved;
pub mod outcome;
pub mod own;
pub mod planted;
pub mod process;
pub mod report;
pub mod runner;
pub mod rust_engine;
pub mod scoreboard;
pub mod serve;
mod step_outcome;
pub mod tolerance;
pub mod trend;
pub mod unit;

pub use bench::Bench;
pub use check::{Check, Level, Run};
pub use description::{ContactModel, Description, Kind, Parameter};
pub use engine::{Engine, Options, Refusal, Reply};
pub use measurement::{Expectation, Measurement, Verdict};
pub use outcome::{CheckOutcome, Report, StepOutcome};
pub use own::OwnEngine;
pub use runner::Plan;
