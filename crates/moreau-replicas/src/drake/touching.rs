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

#[cfg(test)]
pub(super) mod testing {
    use super::*;
    use moreau_contact::contact::{Inertia, Jacobian};
    use moreau_dynamics::mechanics::{Mechanism, State};
    use moreau_dynamics::scenes::Scene;
    use std::sync::Arc;

    /// A ball on another one that rolls, a box that slides with a ball on it, a ball beside them and one in the air.
    const HEAP: &str = r#"{"schema": "scene/1", "name": "heap", "duration": 1, "gravity": [0, 0, -9.81],
        "material": {"friction": 0.5, "restitution": 0}, "ground": {"normal": [0, 0, 1], "offset": 0}, "bodies": [
        {"name": "under", "mass": 2, "position": [0, 0, 0.0995], "sphere": {"radius": 0.1}, "linear_velocity": [0.3, 0, 0]},
        {"name": "over", "mass": 1, "position": [0.06, 0, 0.259], "sphere": {"radius": 0.1}, "angular_velocity": [0, 2, 1]},
        {"name": "air", "mass": 1, "position": [0, 0, 1], "sphere": {"radius": 0.1}, "linear_velocity": [0, 1, 0]},
        {"name": "box", "mass": 3, "position": [1, 0, 0.0998], "box": {"half_extents": [0.2, 0.15, 0.1]}, "linear_velocity": [1, 0.5, 0]},
        {"name": "rider", "mass": 0.5, "position": [1.05, 0.02, 0.299], "sphere": {"radius": 0.1}, "linear_velocity": [0, 0, -0.1]},
        {"name": "lone", "mass": 1, "position": [2, 0, 0.099], "sphere": {"radius": 0.1}, "linear_velocity": [0, 0.01, -1]}]}"#;

    /// The heap, moving.
    pub fn heap() -> (Box<dyn Mechanism>, State) {
        Scene::from_json(HEAP).and_then(|scene| scene.spatial_mechanism()).expect("six bodies")
    }

    /// The step of a heap as it is assembled, and as that of a linkage: with M and H as matrices of all velocities.
    pub fn both(at: &StepContext) -> [StepProblem; 2] {
        let assembled = || assembly::held(at, 0.0, |candidate| candidate.contact.gap < 0.0).expect("finite").0;
        let (free, mut linked) = (assembled(), assembled());
        assert_eq!(free.active.len(), 8, "four corners and four balls");
        linked.effective_mass = Arc::new(Inertia::new(free.effective_mass.matrix().clone()).expect("definite"));
        linked.jacobian = Arc::new(Jacobian::from_dense(&free.jacobian.to_dense(), 3));
        [free, linked]
    }

    /// How far two velocities of contacts may be from each other where both are known to the relative residual at which Newton's method
    /// stops, in the norm of M: the lightest body has ½ kg and the longest lever 1/4 m.
    pub fn apart(velocity: &DVector<f64>) -> f64 {
        1e3 * moreau_contact::tolerance::solvers::STOP * velocity.norm()
    }
}
