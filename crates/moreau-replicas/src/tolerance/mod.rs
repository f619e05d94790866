//! Tolerances of engines made again, each with the reason it has the value it has: rounding, an engine's stopping rule carried through the
//! step, a proven bound.

pub mod energy_balance;
pub mod references;
pub mod solvers;
pub mod systems;
