//! Recorded motions: samples, metrics, convergence, files.

pub mod order;
mod recording;

pub use order::{OrderEstimate, estimate_order, fit_order, shifted_steps};
pub use recording::Recording;
