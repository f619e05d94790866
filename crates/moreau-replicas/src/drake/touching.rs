//! What Drake's laws share in a step: the contacts that touch, w, and an answer with its measure.

use moreau_contact::certificate::StepResidual;
use moreau_contact::problem::{Law, Solution};
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::schemes::assembly::{Candidate, Rules};
use moreau_dynamics::schemes::{OwnAnswer, StepProblem, assembly};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// w \[1/kg\] of the contact with these rows of H.
pub(super) fn response(mass: &DMatrix<f64>, rows: &DMatrix<f64>) -> f64 {
    let inverse = DMatrix::from_diagonal(&mass.diagonal().map(|m| 1.0 / m));
    (rows * inverse * rows.transpose()).norm() / 3.0
}

/// An answer with Drake's measure of it, ‖D(M(v⁺ − v_free) − Hᵀr)‖ relative to its larger term, D = diag(M)^(−½).
pub(super) fn own_answer(solution: Solution, relative: f64) -> OwnAnswer {
    let residual =
        StepResidual { rule: "step of the regularised law", residual: "momentum", relative, limit: CERTIFY, contact: None, pair: None };
    OwnAnswer { solution, residual }
}

/// What the laws outside the waist share: contacts with φ < 0, explicit forces, and no contact problem.
struct Touching;

impl Rules for Touching {
    fn theta(&self) -> f64 {
        0.0
    }

    fn is_active(&self, candidate: &Candidate, _h: f64) -> bool {
        candidate.contact.gap < 0.0
    }

    fn shift(&self, candidate: &Candidate, _h: f64) -> DVector<f64> {
        DVector::zeros(candidate.velocity.len())
    }

    fn law(&self, rows_per_contact: usize) -> Law {
        if rows_per_contact == 1 { Law::Frictionless } else { Law::Coulomb }
    }
}

/// The step of a law that is no relation K ∋ r ⟂ y ∈ K*: contacts, M, v_free and H without a problem for a solver.
pub(super) fn assemble_touching(name: &str, mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<StepProblem> {
    Ok(StepProblem { problem: None, ..assembly::assemble(name, &Touching, mechanism, state, h)? })
}
