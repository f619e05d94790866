//! What Drake's laws share in a step: the contacts that touch, w, and an answer with its measure.

use moreau_contact::certificate::StepResidual;
use moreau_contact::contact::Rows;
use moreau_contact::problem::Solution;
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_dynamics::schemes::waist::{Parts, step_in_parts};
use moreau_dynamics::schemes::{OwnAnswer, Start, Step, StepContext, StepProblem, assembly};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// w = ‖J diag(M)⁻¹ Jᵀ‖/3 \[1/kg\] of the contact whose rows of H are J, of the diagonal of M.
pub(super) fn response(diagonal: &DVector<f64>, rows: &Rows) -> f64 {
    let mut product = DMatrix::zeros(rows.nrows(), rows.nrows());
    for part in rows.parts() {
        let masses = &diagonal.as_slice()[part.first..part.first + part.width];
        let row = |k: usize| part.entries[k * part.width..(k + 1) * part.width].iter();
        let entry = |i: usize, j: usize| row(i).zip(row(j)).zip(masses).map(|((h, other), mass)| h / mass * other).sum::<f64>();
        product += DMatrix::from_fn(rows.nrows(), rows.nrows(), entry);
    }
    product.norm() / 3.0
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
