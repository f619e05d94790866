//! How deep bodies that are set down without speed may sink under a declared law.
//!
//! ```text
//!     rest depth δ(f)  of one contact that carries f        MuJoCo: k d² δ = (1 − d) Â f,  SAP: δ = (h + τ) R_n h f,  spring: δ = f/k,
//!                                                            rigid: allowance or margin;
//!                                                            on springs of a frequency allowance + f/(m (2πf)²)
//!     set down at the surface: at most 2 δ                  an undamped spring swings to twice its rest depth
//! ```
//! Several contacts share the load and sink less, so one that carries all of it is a bound.

use crate::model::compression::LoadedPoint;
use crate::model::{Model, RigidLimits};

/// A bound on the sum of the depths \[m\] of all levels at any time; `None` if the law predicts the same as Coulomb–Signorini.
/// The load of a level is the weight above it, its inverse mass 1/m_a + 1/m_b of the two bodies that touch, the ground's being 0.
pub fn sink(model: &Model, levels: &[LoadedPoint], h: f64) -> Option<f64> {
    let depths: Option<Vec<f64>> = levels.iter().map(|level| depth(model, *level, h)).collect();
    depths.map(|depths| depths.iter().sum())
}

fn depth(model: &Model, level: LoadedPoint, h: f64) -> Option<f64> {
    let LoadedPoint { load, inverse_mass, .. } = level;
    match *model {
        Model::Coulomb(limits) => {
            let RigidLimits { penetration_allowance, contact_margin, .. } = limits;
            // The inverse mass at the corner of a cube is at most 4 (1/m_a + 1/m_b), and four corners share the load.
            // So the compression is at most that of a contact in the middle.
            let either = penetration_allowance.max(contact_margin) + 2.0 * limits.compression(&level);
            (either > 0.0).then_some(either)
        }
        Model::Mujoco(parameters) => parameters.rest_depth(h, inverse_mass, load).ok().map(|depth| 2.0 * depth),
        Model::DrakeSap { stiffness, relaxation_time } => {
            // w, the mean diagonal of a contact's rows, is at most 4 (1/m_a + 1/m_b) at the corner of a cube: 1/m + 2 a²/(2 m a²/3).
            let near_rigid = (h + relaxation_time) * h * load * 4.0 * inverse_mass / (4.0 * std::f64::consts::PI.powi(2));
            Some(2.0 * near_rigid.max(load / stiffness))
        }
        Model::DrakeRegularised { stiffness, .. } | Model::SpringDamper { stiffness, .. } => Some(2.0 * load / stiffness),
        Model::Anitescu | Model::StewartTrinkle { .. } | Model::Unknown => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    const LEVELS: [LoadedPoint; 2] =
        [LoadedPoint { load: 20.0, inverse_mass: 1.0, on_ground: true }, LoadedPoint { load: 10.0, inverse_mass: 2.0, on_ground: false }];

    #[test]
    fn springs_sink_by_twice_their_rest_depth_and_levels_add_up() {
        let model = Model::SpringDamper { stiffness: 1000.0, damping: 1.0, substep: None };
        assert_eq!(sink(&model, &LEVELS, 1e-3), Some(0.06));
    }

    #[test]
    fn rigid_bodies_sink_by_what_is_declared_or_not_at_all() {
        assert_eq!(sink(&Model::Coulomb(RigidLimits::default()), &LEVELS, 1e-3), None);
        let slop = RigidLimits { penetration_allowance: 0.25, ..Default::default() };
        assert_eq!(sink(&Model::Coulomb(slop), &LEVELS, 1e-3), Some(0.5));
        assert_eq!(sink(&Model::Anitescu, &LEVELS, 1e-3), None);
        let sprung = RigidLimits { contact_frequency: 1.0 / TAU, ground_contact_frequency: 2.0 / TAU, ..slop };
        assert_eq!(sink(&Model::Coulomb(sprung), &LEVELS, 1e-3), Some(0.25 + 2.0 * 20.0 / 4.0 + 0.25 + 2.0 * 20.0));
    }

    #[test]
    fn an_unloaded_level_has_no_prediction_of_mujoco() {
        let model = Model::Mujoco(Default::default());
        assert!(sink(&model, &LEVELS, 1e-3).is_some_and(|depth| depth > 0.0));
        assert_eq!(sink(&model, &[LoadedPoint { load: 0.0, ..LEVELS[0] }], 1e-3), None);
    }
}
