//! Drake's TAMSI: Hunt and Crossley's contact with regularised Coulomb friction, coupled fully and implicitly.
//!
//! ```text
//!     M (v⁺ − v_free) = Hᵀ r(H v⁺) ,
//!     r_n = n(u_n) ,     r_t = −μ c(x) n(u_n) u_t/s ,     s = √(‖u_t‖² + ε²) ,   x = s/v_s ,   ε = v_s/100 ,
//!     c(x) = x (2 − x) for x < 1, else 1
//! ```
//! n as in [`hunt_crossley`](crate::drake::Touch). Friction grows with the normal impulse of the same step but not the other way round:
//! ∂r/∂u is not symmetric, so the step minimises nothing, and Newton's method has no convex function to descend. Here it descends the
//! residual ‖D (M(v − v_free) − Hᵀr)‖, D = diag(M)^{−½}; Drake limits how far the slip may turn in an iteration. Where both converge they
//! meet the same equation.
//!
//! # Energy
//! ```text
//!     T(v⁺) ≤ T(v_free) − Σ (r_n φ/h + r_n²/(h²k)) − ½ rᵀW r ,      ΔẼ ≤ −Σ (r_n φ/h + r_n²/(h²k)) + h²FᵀM⁻¹F/8 ,   Ẽ = E + ½ h F·v
//! ```
//! Friction takes energy, and r·u ≤ r_n z with z = (δ − r_n/(h k))/h; with d > 0, r_n z ≤ max(0, …). A depth gives back at most k φ²/4
//! ([`crate::energy_balance`]).
//!
//! # Source
//! Castro et al., *A transition-aware method for the simulation of compliant contact with regularized friction* (2020); Drake's
//! `TamsiSolver`.

use crate::drake::hunt_crossley::{stacked, touches};
use crate::drake::touching::{own_answer, step_touching};
use crate::drake::{Material, Touch};
use crate::tolerance::solvers::{LINE_STEPS, NEAR_MINIMUM};
use moreau_contact::augmented_mass::AugmentedMass;
use moreau_contact::problem::Solution;
use moreau_contact::solvers::watch::is_over;
use moreau_contact::tolerance::solvers::{NEWTON_STEPS, STOP};
use moreau_dynamics::schemes::{Certified, OwnAnswer, Scheme, Start, Step, StepContext, StepProblem};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// ε/v_s, Drake's `relative_tolerance`.
const SOFT: f64 = 0.01;

const NAME: &str = "drake-tamsi";

/// Drake's `kTamsi`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DrakeTamsi {
    /// k, d and v_s.
    pub material: Material,
}

/// r \[N·s\] of a contact with velocity u \[m/s\], and ∂r/∂u \[kg\].
pub fn law(touch: &Touch, velocity: &[f64]) -> (DVector<f64>, DMatrix<f64>) {
    let scale = touch.material.stiction_tolerance;
    let tangential = DVector::from_row_slice(&velocity[1..]);
    let length = tangential.norm().hypot(SOFT * scale);
    let (slip, direction) = (length / scale, tangential / length);
    let (strength, growth) = if slip < 1.0 { (slip * (2.0 - slip), 2.0 * (1.0 - slip) / scale) } else { (1.0, 0.0) };
    let (normal, slope) = touch.normal(velocity[0]);
    let along = &direction * direction.transpose();
    let across = DMatrix::identity(along.nrows(), along.nrows()) - &along;
    let tangent = (across * (strength / length) + along * growth) * (-touch.friction * normal);
    let friction = direction * (-touch.friction * strength);
    let size = velocity.len();
    let derivative = DMatrix::from_fn(size, size, |i, j| match (i, j) {
        (0, 0) => slope,
        (0, _) => 0.0,
        (i, 0) => friction[i - 1] * slope,
        (i, j) => tangent[(i - 1, j - 1)],
    });
    (stacked(normal, friction * normal), derivative)
}

/// The equation of one step.
struct Equation<'a> {
    assembled: &'a StepProblem,
    touches: &'a [Touch],
    rows: usize,
    scale: DVector<f64>,
}

/// The equation at one velocity.
struct Residual {
    impulse: DVector<f64>,
    residual: DVector<f64>,
    /// −∂r/∂u of every contact \[kg\].
    slopes: Vec<DMatrix<f64>>,
    /// ‖D residual‖ and the size of its larger term.
    size: f64,
    terms: f64,
}

impl<'a> Equation<'a> {
    fn of(assembled: &'a StepProblem, touches: &'a [Touch]) -> Self {
        let scale = assembled.effective_mass.mass().diagonal().map(|m| 1.0 / m.sqrt());
        Equation { assembled, touches, rows: assembled.jacobian.rows_per_contact(), scale }
    }

    fn at(&self, velocity: &DVector<f64>) -> Residual {
        let StepProblem { effective_mass, free_velocity, jacobian, .. } = self.assembled;
        let contact_velocity = &**jacobian * velocity;
        let mut impulse = DVector::zeros(contact_velocity.len());
        let mut slopes = Vec::with_capacity(self.touches.len());
        for (k, touch) in self.touches.iter().enumerate() {
            let first = k * self.rows;
            let (part, derivative) = law(touch, &contact_velocity.as_slice()[first..first + self.rows]);
            impulse.rows_mut(first, self.rows).copy_from(&part);
            slopes.push(-derivative);
        }
        let momentum = effective_mass.mass().times(&(velocity - free_velocity));
        let received = jacobian.tr_mul(&impulse);
        let size = |vector: &DVector<f64>| self.scale.component_mul(vector).norm();
        let residual = &momentum - &received;
        Residual { size: size(&residual), terms: size(&momentum).max(size(&received)), impulse, residual, slopes }
    }

    /// Newton's method from the velocity before the step, by elimination over bodies; each step is halved until the residual falls.
    fn solve(&self, start: &DVector<f64>) -> Result<(DVector<f64>, Residual, usize)> {
        let mut augmented = AugmentedMass::new(&self.assembled.effective_mass, self.assembled.jacobian.contacts())?;
        let mut velocity = start.clone();
        let mut now = self.at(&velocity);
        for iterations in 0..NEWTON_STEPS {
            if now.size <= STOP * now.terms {
                return Ok((velocity, now, iterations));
            }
            let direction = match augmented.solve(NAME, &now.slopes, &-&now.residual) {
                Ok(direction) => direction,
                Err(_) if is_over() => return Ok((velocity, now, iterations)),
                Err(reason) => return Err(reason),
            };
            let tried = (0..LINE_STEPS).map(|halvings| &velocity + &direction * 0.5f64.powi(halvings as i32));
            let better = tried.map(|next| (self.at(&next), next)).find(|(there, _)| there.size < now.size);
            match better {
                Some((there, next)) => (velocity, now) = (next, there),
                None if now.size <= NEAR_MINIMUM * now.terms => return Ok((velocity, now, iterations)),
                None => return Err(Error::breakdown(NAME, "found no velocity with a smaller residual")),
            }
        }
        Ok((velocity, now, NEWTON_STEPS))
    }
}

impl Scheme for DrakeTamsi {
    fn name(&self) -> String {
        NAME.into()
    }

    fn has_restitution(&self) -> bool {
        false
    }

    fn step(&self, _solver: &Certified, start: &Start) -> Result<Step> {
        step_touching(start, &|at, assembled| self.answer(at, assembled))
    }
}

impl DrakeTamsi {
    fn answer(&self, at: &StepContext, assembled: &StepProblem) -> Result<Option<OwnAnswer>> {
        if assembled.active.is_empty() {
            return Ok(None);
        }
        let touches = touches(self.material, at, assembled)?;
        let equation = Equation::of(assembled, &touches);
        let (velocity, Residual { impulse, size, terms, .. }, iterations) = equation.solve(&at.state().velocity)?;
        let velocity = &*assembled.jacobian * &velocity;
        let relative = if terms > 0.0 { size / terms } else { 0.0 };
        let solution = Solution::new(NAME, impulse, velocity, iterations);
        Ok(Some(own_answer(solution, relative)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drake::hunt_crossley::testing::touch;
    use moreau_forms::regularised_friction::FrictionCurve;

    #[test]
    fn the_derivative_is_that_of_the_impulse_and_not_symmetric() {
        let step = 1.0 / 65_536.0;
        for velocity in [[-1.0, 0.25, -0.125], [0.25, 2.0, 1.0], [9.0, 1.0, 0.0]] {
            let (_, derivative) = law(&touch(), &velocity);
            for column in 0..3 {
                let shifted = |by: f64| {
                    let mut point = velocity;
                    point[column] += by;
                    law(&touch(), &point).0
                };
                let slope = (shifted(step) - shifted(-step)) / (2.0 * step);
                // third derivatives are below 2¹⁰ away from the kink; the rounding of the impulses is divided by the step
                let bound = 1024.0 * step * step + moreau_exact::tolerance::rounding(64, 16.0) / step;
                assert!((derivative.column(column) - slope).amax() <= bound, "{velocity:?}");
            }
        }
        let (_, derivative) = law(&touch(), &[-1.0, 0.25, -0.125]);
        assert!((&derivative - derivative.transpose()).amax() > 1.0);
    }

    #[test]
    fn bodies_one_by_one_move_as_by_matrices_of_all_velocities() {
        use crate::drake::touching::testing::{apart, both, heap};
        let (mechanism, state) = heap();
        let at = StepContext::new(mechanism.as_ref(), &state, 0.01).expect("a step");
        let [free, linked] = both(&at).map(|assembled| {
            let touches = touches(Material::default(), &at, &assembled).expect("finite");
            let (velocity, ..) = Equation::of(&assembled, &touches).solve(&state.velocity).expect("a velocity");
            &*assembled.jacobian * &velocity
        });
        assert!((&free - &linked).amax() <= apart(&linked), "{free} {linked}");
    }

    #[test]
    fn friction_is_the_parabola_of_the_softened_slip() {
        let curve = FrictionCurve::Parabola;
        for slip in [0.125, 0.25, 0.5, 1.0] {
            let (impulse, _) = law(&touch(), &[0.0, slip, 0.0]);
            let softened = slip.hypot(SOFT * 0.5);
            let expected = -0.75 * impulse[0] * curve.strength(softened / 0.5) * slip / softened;
            assert!((impulse[1] - expected).abs() <= moreau_exact::tolerance::rounding(16, impulse[0]));
        }
    }
}
