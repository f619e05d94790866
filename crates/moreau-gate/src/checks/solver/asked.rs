//! What an engine is asked, and how far its velocities are from its impulses.

use crate::checks::scenery::worst;
use crate::checks::solver::problems;
use crate::{Bench, Refusal, Reply};
use moreau_contact::problem::{ContactProblem, Law, Solution};

/// The laws among [`problems::LAWS`] that the engine lists.
pub(super) fn laws(bench: &Bench) -> Reply<Vec<Law>> {
    let listed: Vec<Law> =
        problems::LAWS.into_iter().filter(|law| bench.description().laws.iter().any(|name| name == law.name())).collect();
    if listed.is_empty() {
        return Err(Refusal::unsupported("the engine lists none of the laws frictionless, coulomb and associated"));
    }
    Ok(listed)
}

/// max |u − (W r + u_free)| \[m/s\] of an answer.
pub(super) fn discrepancy(problem: &ContactProblem, solution: &Solution) -> f64 {
    (problem.velocity(&solution.impulse) - &solution.velocity).iter().fold(0.0, |largest, x| worst(largest, x.abs()))
}
