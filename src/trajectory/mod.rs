//! Recorded motions: samples, metrics, convergence, files.

mod recording;

pub use recording::Recording;
