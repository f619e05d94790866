//! Keeping a bilateral constraint g(q) = 0 that a velocity-level step keeps in its derivative only.
//!
//! ```text
//!     M (v⁺ − v) = h F(q) + Gᵀ λ ,   G v⁺ = b ,   G = ∂g/∂q ,   λ = W⁻¹ (b − G v_free) ,   W = G M⁻¹ Gᵀ ,
//!     q⁺ = q + h v⁺ .
//! ```
//! W is the Delassus operator and λ the impulse \[N·s\], as at a contact, but no law: the constraint holds in both directions. The methods
//! differ in G and b, and in what they do after the step:
//!
//! | method | G at | b | afterwards |
//! |---|---|---|---|
//! | [`VelocityLevel`] | q | 0 | – |
//! | [`Baumgarte`] | q | (1 − 2αh) G v − h β² g | – |
//! | [`GearGuptaLeimkuhler`] | q⁺ | 0 | q⁺ + M⁻¹Gᵀμ with g(q⁺) = 0, μ unknown of the same step |
//! | [`PositionProjection`] | q | 0 | q onto g = 0 along M⁻¹Gᵀ |
//! | [`CoordinateProjection`] | q | 0 | q onto g = 0, then v onto G v = 0 |
//!
//! If F depends on q alone, position and coordinate projection give the same positions: the velocity step is v⁺ = P v + h P M⁻¹F with the
//! projection P at q, and P (P v) = P v, so what coordinate projection takes from v is taken anyway. Only the velocities shown differ.

use crate::mechanics::State;
use moreau_contact::contact::delassus::{MassFactor, delassus};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

mod baumgarte;
mod gear_gupta_leimkuhler;
mod pendulum;
mod projection;
#[cfg(test)]
mod tests;
mod velocity_level;

pub use baumgarte::{Baumgarte, ViolationStep};
pub use gear_gupta_leimkuhler::GearGuptaLeimkuhler;
pub use pendulum::Pendulum;
pub use projection::{CoordinateProjection, PositionProjection};
pub use velocity_level::VelocityLevel;

/// A mechanical system with constant mass, forces that depend on q, and bilateral constraints g(q) = 0.
pub trait Constrained {
    /// M, symmetric positive definite, nv × nv.
    fn mass_matrix(&self) -> DMatrix<f64>;
    /// F(q) \[N\].
    fn force(&self, position: &DVector<f64>) -> DVector<f64>;
    /// g(q) \[m\], one entry per constraint.
    fn violation(&self, position: &DVector<f64>) -> DVector<f64>;
    /// G = ∂g/∂q, one row per constraint, of full rank.
    fn jacobian(&self, position: &DVector<f64>) -> DMatrix<f64>;
    /// V(q) \[J\].
    fn potential_energy(&self, position: &DVector<f64>) -> f64;
    /// ½ vᵀM v + V(q) \[J\].
    fn energy(&self, state: &State) -> f64 {
        0.5 * state.velocity.dot(&(self.mass_matrix() * &state.velocity)) + self.potential_energy(&state.position)
    }
}

/// One way to step a constrained system.
pub trait Stabilisation {
    /// The method's name.
    fn name(&self) -> String;
    /// The state after a step of size h \[s\].
    ///
    /// # Errors
    /// If M or W is not positive definite, or an iteration onto the constraint does not end.
    fn step(&self, system: &dyn Constrained, state: &State, h: f64) -> Result<State>;
}

/// The state after `steps` steps of size h.
///
/// # Errors
/// Those of [`Stabilisation::step`].
pub fn run(method: &dyn Stabilisation, system: &dyn Constrained, start: &State, h: f64, steps: usize) -> Result<State> {
    (0..steps).try_fold(start.clone(), |state, _| method.step(system, &state, h))
}

/// v + M⁻¹Gᵀ W⁻¹ (b − G v): the velocity nearest to v in the norm of M with G v = b.
pub(crate) fn constrain(
    system: &dyn Constrained,
    jacobian: &DMatrix<f64>,
    velocity: &DVector<f64>,
    rate: &DVector<f64>,
) -> Result<DVector<f64>> {
    Ok(velocity + along(system, jacobian, &(rate - jacobian * velocity))?)
}

/// M⁻¹Gᵀ W⁻¹ x: the smallest change in the norm of M that G maps to x.
pub(crate) fn along(system: &dyn Constrained, jacobian: &DMatrix<f64>, wanted: &DVector<f64>) -> Result<DVector<f64>> {
    let mass = system.mass_matrix();
    let multipliers = MassFactor::new(&delassus(&mass, jacobian)?)?.solve(wanted);
    Ok(MassFactor::new(&mass)?.solve(&jacobian.tr_mul(&multipliers)))
}

/// v + h M⁻¹F(q).
pub(crate) fn free_velocity(system: &dyn Constrained, state: &State, h: f64) -> Result<DVector<f64>> {
    Ok(&state.velocity + MassFactor::new(&system.mass_matrix())?.solve(&system.force(&state.position)) * h)
}

/// Iterations after which a method gives up: Newton's needs some five, a fixed point with the factor O(h) some tens.
pub(crate) const ITERATIONS: usize = 200;

pub(crate) fn not_converged(method: &str) -> Error {
    Error::limit(method, format!("did not reach the constraint in {ITERATIONS} iterations; use a smaller step"))
}
