//! Depth at rest of a rigid contact that its engine documents as soft: penetration allowance and spring.
//!
//! ```text
//!     depth = penetration_allowance + N/(m_p (2πf)²) ,
//!     f = ground_contact_frequency against the ground, contact_frequency between bodies .
//! ```

use crate::model::{Model, RigidLimits};
use moreau_forms::soft_rigid_contact::SoftContact;

/// The point at which a contact is loaded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadedPoint {
    /// N \[N\].
    pub load: f64,
    /// 1/m_p \[1/kg\], see [`inverse_mass_at`](moreau_forms::soft_rigid_contact::inverse_mass_at).
    pub inverse_mass: f64,
    /// Whether the ground carries it.
    pub on_ground: bool,
}

impl RigidLimits {
    /// Compression \[m\] of a point by its declared spring, without the penetration allowance; 0 if no spring is declared.
    pub fn compression(&self, point: &LoadedPoint) -> f64 {
        let frequency = if point.on_ground { self.ground_contact_frequency } else { self.contact_frequency };
        SoftContact { frequency, inverse_mass: point.inverse_mass }.compression(point.load)
    }
}

impl Model {
    /// Depth at rest \[m\] of a rigid law that declares a spring. It is the exact depth, not a bound.
    pub fn sprung_depth(&self, point: &LoadedPoint) -> Option<f64> {
        match self {
            Model::Coulomb(limits) => {
                let compression = limits.compression(point);
                (compression > 0.0).then_some(limits.penetration_allowance + compression)
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    const ONE_KILOGRAM: LoadedPoint = LoadedPoint { load: 10.0, inverse_mass: 1.0, on_ground: true };

    fn model(penetration_allowance: f64, ground_contact_frequency: f64) -> Model {
        Model::Coulomb(RigidLimits {
            penetration_allowance,
            ground_contact_frequency,
            contact_frequency: 1.0 / TAU,
            ..RigidLimits::default()
        })
    }

    #[test]
    fn allowance_and_spring_add_up_and_the_ground_has_its_own_spring() {
        assert_eq!(model(0.5, 2.0 / TAU).sprung_depth(&ONE_KILOGRAM), Some(3.0));
        assert_eq!(model(0.5, 2.0 / TAU).sprung_depth(&LoadedPoint { on_ground: false, ..ONE_KILOGRAM }), Some(10.5));
    }

    #[test]
    fn a_law_without_spring_says_no_depth() {
        assert_eq!(model(0.5, 0.0).sprung_depth(&ONE_KILOGRAM), None);
        assert_eq!(Model::Anitescu.sprung_depth(&ONE_KILOGRAM), None);
    }
}
