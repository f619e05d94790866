//! What Drake's laws share in a step: the contacts that touch, w, and an answer with its measure.

use moreau_contact::certificate::StepResidual;
use moreau_contact::problem::Solution;
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_dynamics::schemes::waist::{Parts, step_in_parts};
use moreau_dynamics::schemes::{OwnAnswer, Start, Step, StepContext, StepProblem, assembly};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// w = ‖J diag(M)⁻¹ Jᵀ‖/3 \[1/kg\] of the contact whose rows of H are J.
pub(super) fn response(mass: &DMatrix<f64>, rows: &DMatrix<f64>) -> f64 {
    let inverse = DMatrix::from_diagonal(&mass.diagonal().map(|m| 1.0 / m));
    (rows * inverse * rows.transpose()).norm() / 3.0
}

/// An answer with Drake's measure of it, ‖D(M(v⁺ − v_free) − Hᵀr)‖ relative to its larger term, D = diag(M)^(−½).
pub(super) fn own_answer(solution: Solution, relative: f64) -> OwnAnswer {
    let residual =
        StepResidual { rule: "step of the regularised law", residual: "momentum", relative, limit: CERTIFY, contact: None, pair: None };
    OwnAnswer { solution, residual: Some(residual) }
}

/// The step of a law that is no relation K ∋ r ⟂ y ∈ K*: explicit forces, the contacts with φ < 0, and the law's own `answer`.
pub(super) fn step_touching(start: &Start, answer: &dyn Fn(&StepContext, &StepProblem) -> Result<Option<OwnAnswer>>) -> Result<Step> {
    let assemble = |at: &StepContext| Ok(assembly::held(at, 0.0, |candidate| candidate.contact.gap < 0.0)?.0);
    let advance =
        |at: &StepContext, _: &StepProblem, velocity: &DVector<f64>| Ok(at.mechanism().integrate(&at.state().position, velocity, at.h()));
    step_in_parts(start, &Parts { assemble: &assemble, answer, discard: &|| (), advance: &advance })
}
