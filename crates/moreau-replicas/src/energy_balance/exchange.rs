//! The impulses of one step and what they do to the kinetic energy of its effective mass.
//!
//! ```text
//!     x = M̂⁻¹Hᵀr ,    v⁺ = v_free + x ,    T̂(v⁺) − T̂(v_free) = r·u⁺ − ½ rᵀŴ r ,    Ŵ = H M̂⁻¹Hᵀ ,  u⁺ = H v⁺ ,  T̂(v) = ½ vᵀM̂ v .
//! ```
//! The identity holds for every r: it fails only if the velocity after the step is not the one that the reported impulses make.
//!
//! **Rounding.** Every number below is a sum of products. With N(v) = Σ √M̂_ii |v_i| the factorisation of M̂ errs by γ N(v) N(x) in vᵀM̂x,
//! since (|L||D||Lᵀ|)_ij ≤ √(M̂_ii M̂_jj), and Hᵀr by γ |H|ᵀ|r|. `size` sums what these errors multiply.

use crate::energy_balance::Taken;
use moreau_contact::contact::delassus::MassFactor;
use moreau_dynamics::mechanics::State;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// The impulses of a step, and the velocities before and after them at its contacts.
pub(super) struct Exchange {
    /// r \[N·s\], contact by contact.
    pub impulse: DVector<f64>,
    /// H v \[m/s\].
    pub before: DVector<f64>,
    /// H v_free \[m/s\].
    pub free: DVector<f64>,
    /// H v⁺ \[m/s\].
    pub after: DVector<f64>,
    /// rᵀŴr \[J\].
    pub square: f64,
    /// T̂(v⁺) − T̂(v_free) \[J\].
    pub gained: f64,
    /// Sum of the absolute values of what these energies are made of \[J\].
    pub size: f64,
}

impl Exchange {
    /// Reads a step that assembled its M̂ and H.
    pub fn new(taken: &Taken) -> Result<Self> {
        let assembled = &taken.step.assembled;
        let (mass, jacobian, free_velocity) = (assembled.effective_mass.matrix(), assembled.jacobian.to_dense(), &assembled.free_velocity);
        let impulse = DVector::from_iterator(
            taken.step.impulses.iter().map(|one| one.impulse.len()).sum(),
            taken.step.impulses.iter().flat_map(|one| one.impulse.iter().copied()),
        );
        if impulse.len() != jacobian.nrows() {
            let problem = format!("has {} entries for {} contact rows", impulse.len(), jacobian.nrows());
            return Err(Error::invalid("impulses", problem, "report the impulses of all contacts that the step assembled"));
        }
        let State { velocity, .. } = &taken.step.state;
        let thrown = MassFactor::new(mass)?.solve(&jacobian.tr_mul(&impulse));
        let of = |velocity: &DVector<f64>| &jacobian * velocity;
        let speeds = velocity.abs() + free_velocity.abs() + thrown.abs() + taken.before.velocity.abs();
        let weighted = norm(mass, &speeds);
        Ok(Exchange {
            square: impulse.dot(&of(&thrown)),
            gained: kinetic(mass, velocity) - kinetic(mass, free_velocity),
            size: weighted * weighted + impulse.abs().dot(&(jacobian.abs() * speeds)),
            before: of(&taken.before.velocity),
            free: of(free_velocity),
            after: of(velocity),
            impulse,
        })
    }
}

/// ½ vᵀM v \[J\].
pub(super) fn kinetic(mass: &DMatrix<f64>, velocity: &DVector<f64>) -> f64 {
    0.5 * velocity.dot(&(mass * velocity))
}

/// N(v) of the module's equation, at least ‖v‖_M.
pub(super) fn norm(mass: &DMatrix<f64>, velocity: &DVector<f64>) -> f64 {
    velocity.iter().enumerate().map(|(i, v)| mass[(i, i)].sqrt() * v.abs()).sum()
}
