//! Constant forces and masses, under which the total energy has a bound.

use crate::energy_balance::Taken;
use crate::energy_balance::position::Position;
use crate::energy_balance::waist::WaistLaw;
use moreau_contact::contact::delassus::MassFactor;
use nalgebra::{DMatrix, DVector};

/// The constant force and mass of a mechanism, as far as one step shows them.
pub(super) struct Constant {
    /// F(q, 0).
    pub force: DVector<f64>,
    /// M.
    pub mass: DMatrix<f64>,
}

impl Constant {
    /// F and M of the step, if they are the same at both ends; `None` where the bounds do not apply.
    pub fn of(taken: &Taken, waist: &WaistLaw) -> Option<Self> {
        let mechanism = taken.mechanism;
        let (from, to) = (&taken.before.position, &taken.step.state.position);
        let mass = mechanism.mass_matrix(from);
        let at_rest = DVector::zeros(taken.before.velocity.len());
        let force = mechanism.force(from, &at_rest);
        let same = mechanism.linear_force().is_none() && mechanism.mass_matrix(to) == mass && mechanism.force(to, &at_rest) == force;
        let slopes = || mechanism.gyroscopic_slope(from, &at_rest.map(|_| 1.0));
        let spins = || slopes().is_some_and(|slopes| slopes.iter().any(|slope| slope.amax() > 0.0));
        let smooth = matches!(waist.position, Position::Theta(_) | Position::Corrected) || !spins();
        (same && smooth).then_some(Constant { force, mass })
    }

    /// h²FᵀM⁻¹F \[J\].
    pub fn fall(&self, h: f64) -> Option<f64> {
        let factor = MassFactor::new(&self.mass).ok()?;
        Some(h * h * self.force.dot(&factor.solve(&self.force)))
    }
}
