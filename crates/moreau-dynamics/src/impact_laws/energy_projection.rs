//! Energy-consistent projection: the velocities nearest to those of another law that neither penetrate nor gain energy.
//!
//! ```text
//!     U⁺ = argmin (U − U*)ᵀW⁻¹(U − U*)   over   U ≥ 0 ,   UᵀW⁻¹U ≤ U⁻ᵀW⁻¹U⁻
//!        = min(1, √(E⁻/E_K)) U_K ,       U_K = U* + W λ ,   0 ≤ U_K ⟂ λ ≥ 0 ,   E = UᵀW⁻¹U
//! ```
//! The projection on a convex cone and a ball around its apex is that on the cone followed by that on the ball. W⁻¹ is the metric of
//! the kinetic energy in the space of the contact velocities, so momentum is kept: P = W⁻¹(U⁺ − U⁻). Nothing makes P ≥ 0.

use super::impact::unilateral;
use moreau_contact::problem::{PlanarProblem, Response};
use moreau_exact::scalar::Scalar;
use moreau_exact::{Error, Result, elimination};
use nalgebra::DVector;

/// The direction U_K and the square of the factor on it. Both are rational if the data are.
#[derive(Clone, Debug, PartialEq)]
pub struct Projection<T: Scalar> {
    /// U_K \[m/s\].
    pub direction: DVector<T>,
    /// min(1, E⁻/E_K).
    pub factor_squared: T,
}

/// The projection of a candidate U*, without friction.
///
/// # Errors
/// [`Error::Unsupported`] if W is singular; [`Error::Solver`] if the complementarity problem is not solved.
pub fn project<T: Scalar>(impact: &PlanarProblem<T>, candidate: &DVector<T>) -> Result<Projection<T>> {
    let zero = DVector::from_element(candidate.len(), T::zero());
    let landing = PlanarProblem::new(impact.delassus.clone(), candidate.clone());
    let direction = landing.response(unilateral(&landing, &zero)?).after;
    let (allowed, present) = (energy(impact, &impact.velocity)?, energy(impact, &direction)?);
    let factor_squared = if present > allowed { allowed / present } else { T::one() };
    Ok(Projection { direction, factor_squared })
}

impl Projection<f64> {
    /// U⁺ and the impulses that lead there.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if W is singular.
    pub fn outcome(&self, impact: &PlanarProblem<f64>) -> Result<Response<f64>> {
        let after = &self.direction * self.factor_squared.sqrt();
        Ok(Response { impulse: impulse_of(impact, &(&after - &impact.velocity))?, after })
    }
}

/// UᵀW⁻¹U, twice the kinetic energy that contact impulses can change \[J\].
///
/// # Errors
/// [`Error::Unsupported`] if W is singular.
///
/// ```
/// use moreau_contact::problem::PlanarProblem;
/// use moreau_dynamics::impact_laws::energy_projection::energy;
/// use nalgebra::{dmatrix, dvector};
///
/// let two_kilograms = PlanarProblem::new(dmatrix![0.5], dvector![-3.0]);
/// assert_eq!(energy(&two_kilograms, &two_kilograms.velocity)?, 18.0); // m v², twice ½ m v²
/// # Ok::<(), moreau_exact::Error>(())
/// ```
pub fn energy<T: Scalar>(impact: &PlanarProblem<T>, velocity: &DVector<T>) -> Result<T> {
    Ok(velocity.dot(&impulse_of(impact, velocity)?))
}

/// W⁻¹ ΔU.
fn impulse_of<T: Scalar>(impact: &PlanarProblem<T>, change: &DVector<T>) -> Result<DVector<T>> {
    let singular = || Error::Unsupported("the projection measures velocities by W⁻¹, which needs a nonsingular W".into());
    elimination::solve(&impact.delassus, change).ok_or_else(singular)
}
