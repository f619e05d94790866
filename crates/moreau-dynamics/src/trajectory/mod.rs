//! Recorded motions: samples, metrics, convergence, files.

mod file;
mod graph;
pub mod metrics;
pub mod order;
mod recorder;
mod recording;
mod segment_tree;
mod validation;

pub use file::{BodyTrack, ContactRecord, Producer, SCHEMA, StepResiduals, Trajectory};
pub use graph::Graph;
pub use order::{OrderEstimate, Refinement, estimate_order, fit_order, shifted_steps};
pub use recorder::Recorder;
pub use recording::{LocatedImpact, Recording};
