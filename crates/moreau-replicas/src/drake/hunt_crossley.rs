//! Hunt and Crossley's normal impulse in one step, and what the state before the step gives to regularised friction.
//!
//! ```text
//!     n(z) = h k (δ − h z)₊ (1 − d z)₊ ,       z = u_n for the contact itself
//!     n₀ = h k δ (1 − d u_n(v))₊ ,             v_ε = max(v_s, μ σ w n₀) ,       t(u) = u_t/√(‖u_t‖² + v_ε²)
//! ```
//! δ = −φ > 0 is the depth at the start of the step. n falls with z from its value at z = 0 to zero at min(δ/h, 1/d), and is zero beyond.

use super::primal_newton::{Potential, minimise};
use crate::drake::touching::{own_answer, response, step_touching};
use crate::drake::{Material, SIGMA};
use moreau_contact::contact::Contact;
use moreau_contact::problem::Solution;
use moreau_dynamics::mechanics::State;
use moreau_dynamics::schemes::{OwnAnswer, Start, Step, StepContext, StepProblem};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// One touching contact as the laws see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// h \[s\].
    pub time_step: f64,
    /// k, d and v_s.
    pub material: Material,
    /// δ \[m\].
    pub depth: f64,
    /// μ.
    pub friction: f64,
    /// n₀ \[N·s\].
    pub explicit: f64,
    /// v_ε \[m/s\].
    pub slip_scale: f64,
}

impl Touch {
    /// The contact at the start of a step of size h from `state`, of the diagonal of M.
    pub(super) fn new(material: Material, contact: &Contact, mass: &DVector<f64>, state: &State, h: f64) -> Self {
        let depth = -contact.gap;
        let opening = (&contact.jacobian * &state.velocity)[0];
        let explicit = h * material.stiffness * depth.max(0.0) * (1.0 - material.dissipation * opening).max(0.0);
        let widened = contact.friction * SIGMA * response(mass, &contact.jacobian) * explicit;
        let slip_scale = material.stiction_tolerance.max(widened);
        Touch { time_step: h, material, depth, friction: contact.friction, explicit, slip_scale }
    }

    /// n(z) \[N·s\] and n'(z) \[kg\].
    pub fn normal(&self, z: f64) -> (f64, f64) {
        let Material { stiffness, dissipation, .. } = self.material;
        let h = self.time_step;
        let (spring, damper) = (h * stiffness * (self.depth - h * z), 1.0 - dissipation * z);
        if spring <= 0.0 || damper <= 0.0 {
            return (0.0, 0.0);
        }
        (spring * damper, -h * h * stiffness * damper - dissipation * spring)
    }

    /// The regularised direction of slip t(u) = u_t/√(‖u_t‖² + v_ε²), and that root \[m/s\].
    pub fn direction(&self, velocity: &[f64]) -> (DVector<f64>, f64) {
        let tangential = DVector::from_row_slice(&velocity[1..]);
        let length = tangential.norm().hypot(self.slip_scale);
        (tangential / length, length)
    }
}

/// The touching contacts of an assembled step.
///
/// # Errors
/// [`moreau_exact::Error::Invalid`] if nothing moves one of the bodies: these laws compute with M itself.
pub(super) fn touches(material: Material, at: &StepContext, assembled: &StepProblem) -> Result<Vec<Touch>> {
    let mass = assembled.effective_mass.finite_mass()?.diagonal();
    Ok(assembled.active.iter().map(|&k| Touch::new(material, &at.contacts()[k], &mass, at.state(), at.h())).collect())
}

/// The step of a convex law of the touching contacts.
pub(super) fn step<P: Potential>(name: &str, material: Material, start: &Start, law: fn(Vec<Touch>) -> P) -> Result<Step> {
    step_touching(start, &|at, assembled| answer(name, assembled, &law(touches(material, at, assembled)?)))
}

/// The minimum of a convex law's step; none without contact.
fn answer(name: &str, assembled: &StepProblem, potential: &dyn Potential) -> Result<Option<OwnAnswer>> {
    if assembled.active.is_empty() {
        return Ok(None);
    }
    let StepProblem { effective_mass, jacobian, free_velocity, .. } = assembled;
    let free_velocity = &**jacobian * free_velocity;
    let minimum = minimise(name, effective_mass, jacobian, &free_velocity, potential, DVector::zeros(effective_mass.size()))?;
    let velocity = free_velocity + &**jacobian * &minimum.change;
    let solution = Solution::new(name, minimum.impulse, velocity, minimum.iterations);
    Ok(Some(own_answer(solution, minimum.relative)))
}

/// (n, r_t) as one vector.
pub(super) fn stacked(normal: f64, tangential: DVector<f64>) -> DVector<f64> {
    tangential.insert_row(0, normal)
}

/// The matrix of blocks (nn, nt; tn, tt).
pub(super) fn blocks(normal: f64, mixed: &DVector<f64>, tangential: DMatrix<f64>) -> DMatrix<f64> {
    let size = mixed.len() + 1;
    DMatrix::from_fn(size, size, |i, j| match (i, j) {
        (0, 0) => normal,
        (0, j) => mixed[j - 1],
        (i, 0) => mixed[i - 1],
        (i, j) => tangential[(i - 1, j - 1)],
    })
}

#[cfg(test)]
pub(super) mod testing {
    use super::*;
    use moreau_contact::tolerance::cones::difference_error;

    /// A touching contact whose numbers are of size one.
    pub fn touch() -> Touch {
        let material = Material { stiffness: 40.0, dissipation: 0.25, stiction_tolerance: 0.5, relaxation_time: 0.0 };
        Touch { time_step: 0.25, material, depth: 0.5, friction: 0.75, explicit: 3.0, slip_scale: 0.5 }
    }

    /// The curvature is minus the derivative of the impulse, symmetric and positive semidefinite, at points that touch and points that do
    /// not.
    pub fn is_convex_with_its_own_gradient(potential: &dyn Potential) {
        let step = 1.0 / 1024.0;
        for velocity in [[-1.0, 0.5, -0.25], [0.25, 2.0, 1.0], [-0.5, 0.0, 0.0], [1.5, 0.25, 0.5], [9.0, 1.0, 0.0]] {
            let curvature = potential.curvature(0, &velocity);
            let shifted = |column: usize, by: f64| {
                let mut point = velocity;
                point[column] += by;
                potential.impulse(0, &point)
            };
            for column in 0..3 {
                let slope = (shifted(column, -step) - shifted(column, step)) / (2.0 * step);
                // third derivatives of the impulse are below 2⁶ for the numbers of `touch`
                let bound = 64.0 * step * step + difference_error(1.0, 16.0);
                assert!((curvature.column(column) - slope).amax() <= bound, "{velocity:?}: {curvature}");
            }
            assert!((&curvature - curvature.transpose()).amax() == 0.0);
            assert!(curvature.symmetric_eigenvalues().min() >= -moreau_exact::tolerance::rounding(32, 16.0));
        }
    }

    #[test]
    fn the_normal_impulse_is_the_closed_forms_and_its_derivative_its_own() {
        let touch = touch();
        for z in [-2.0, -0.5, 0.0, 0.5, 1.75] {
            let (value, slope) = touch.normal(z);
            let law = 0.25 * 40.0 * (0.5f64 - 0.25 * z).max(0.0) * (1.0 - 0.25 * z).max(0.0);
            assert_eq!(value, law);
            let step = 1.0 / 1024.0;
            let difference = (touch.normal(z + step).0 - touch.normal(z - step).0) / (2.0 * step);
            // quadratic in z: the central difference is exact
            assert!((slope - difference).abs() <= moreau_exact::tolerance::rounding(64, 16.0 / step), "{z}");
        }
        assert_eq!(touch.normal(2.0), (0.0, 0.0));
        let damped = Touch { material: Material { dissipation: 4.0, ..touch.material }, ..touch };
        assert_eq!(damped.normal(0.25), (0.0, 0.0));
    }

    #[test]
    fn bodies_one_by_one_move_as_by_matrices_of_all_velocities() {
        use crate::drake::touching::testing::{apart, both, heap};
        let (mechanism, state) = heap();
        let at = StepContext::new(mechanism.as_ref(), &state, 0.01).expect("a step");
        type Law = fn(Vec<Touch>) -> Box<dyn Potential>;
        let laws: [Law; 2] = [crate::drake::lagged::tests::law, crate::drake::similar::tests::law];
        for law in laws {
            let [free, linked] = both(&at).map(|assembled| {
                let touches = touches(Material::default(), &at, &assembled).expect("finite");
                answer("test", &assembled, law(touches).as_ref()).expect("a minimum").expect("contacts").solution.velocity
            });
            assert!((&free - &linked).amax() <= apart(&linked), "{free} {linked}");
        }
    }
}
