//! Planted mistakes, family by family, each beside the right subject or under checks that the right one passes.

pub mod certificates;
pub mod cone_projection;
pub mod convergence;
pub mod decisions;
pub mod delassus;
pub mod energy;
pub mod readers;
pub mod schemes;
pub mod solvers;
pub mod stewart_trinkle;
pub mod zeno;
