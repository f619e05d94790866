//! Where a body touches the floor z = 0: its lowest point, or the declared spheres at its corners.

use crate::Bench;
use crate::checks::motion::Sample;
use crate::model::regularised::Foot;
use crate::model::solid::box_moments;
use moreau_forms::drake_sap::diagonal_mean;
use nalgebra::{Matrix3, Vector3};

/// Spheres fixed to a body.
pub(super) struct Feet {
    /// Centres in the body frame \[m\].
    centres: Vec<Vector3<f64>>,
    /// Radius of the spheres \[m\].
    radius: f64,
    mass: f64,
    /// Principal moments \[kg·m²\].
    moments: Vector3<f64>,
}

impl Feet {
    /// The feet of a solid sphere.
    pub(super) fn of_sphere(mass: f64, radius: f64) -> Self {
        Feet { centres: vec![Vector3::zeros()], radius, mass, moments: Vector3::repeat(0.4 * mass * radius * radius) }
    }

    /// The feet of a solid box, with the spheres that the engine declares at its corners.
    pub(super) fn of_box(bench: &Bench, mass: f64, half_extents: [f64; 3]) -> Self {
        let radius = bench.description().contact_model.number("corner_radius").unwrap_or(0.0);
        let half = Vector3::from(half_extents);
        let centre = |k: u8| {
            let sign = |bit: u8| if k & bit == 0 { 1.0 } else { -1.0 };
            (half - Vector3::repeat(radius)).component_mul(&Vector3::new(sign(1), sign(2), sign(4)))
        };
        Feet { centres: (0..8).map(centre).collect(), radius, mass, moments: box_moments(mass, half) }
    }

    /// The contacts of the step between two samples: those that are closed before it. Bodies of equal stiffness touch in the middle of the
    /// overlap.
    pub(super) fn between(&self, before: &Sample, after: &Sample) -> Vec<Foot> {
        let turn = before.rotation.to_rotation_matrix();
        let inertia = turn.matrix() * Matrix3::from_diagonal(&self.moments) * turn.matrix().transpose();
        let foot = |centre: &Vector3<f64>| {
            let mut lever = before.rotation * centre;
            let depth = self.radius - (before.position.z + lever.z);
            lever.z = -0.5 * depth - before.position.z;
            (depth > 0.0).then(|| Foot {
                depth,
                opening: before.velocity_at(lever).z,
                slip: after.velocity_at(lever).xy(),
                diagonal_mean: diagonal_mean(self.mass, inertia.diagonal(), lever),
            })
        };
        self.centres.iter().filter_map(foot).collect()
    }
}
