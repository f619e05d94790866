//! Where planar bodies touch with a gap of at most a reach, in the order of the candidates.
//!
//! ```text
//!     φ ≥ d/√2        d the distance of two bodies, ‖c_i − c_j‖ − R_i − R_j ≤ d
//! ```
//! For a gap is the distance of a vertex from the line of a face: a point of the face itself is opposite to the vertex, along the normal of
//! the other box's face, and the two normals differ by at most 45°.

use super::PlanarBodies;
use super::features::{ground_touches, pair_touches};
use super::shape::{Pose, Shape};
use super::touch::Touch;
use crate::mechanics::neighbours::largest;
use crate::tolerance::mechanics::PARALLEL_FACES;
use nalgebra::{DVector, Vector3};
use std::f64::consts::SQRT_2;

impl Shape {
    /// R, of the circle about the centre that holds the body \[m\].
    fn radius(&self) -> f64 {
        match *self {
            Shape::Disk { radius } => radius,
            Shape::Box { half_extents: [a, b] } => a.hypot(b),
        }
    }
}

impl PlanarBodies {
    /// Shows first body, second body, touch, and the place of the touch among those of its pair.
    pub(super) fn touches(&self, poses: &[Pose], reach: f64, mut show: impl FnMut(usize, Option<usize>, &Touch, usize)) {
        let mut keep = |first: usize, second: Option<usize>, touches: Vec<Touch>| {
            touches.iter().enumerate().filter(|(_, touch)| touch.gap <= reach).for_each(|(k, touch)| show(first, second, touch, k));
        };
        if let Some(ground) = &self.ground {
            for (first, body) in self.bodies.iter().enumerate() {
                keep(first, None, ground_touches(body.shape(), &poses[first], ground));
            }
        }
        let centres: Vec<Vector3<f64>> = poses.iter().map(|pose| Vector3::new(pose.centre[0], 0.0, pose.centre[1])).collect();
        let radius = |body: usize| self.bodies[body].shape().radius();
        let apart = SQRT_2 * reach.max(0.0);
        self.neighbours.near(&centres, radius, apart, |first, second| {
            if (centres[first] - centres[second]).norm() - radius(first) - radius(second) <= apart {
                let shapes = (self.bodies[first].shape(), self.bodies[second].shape());
                keep(first, Some(second), pair_touches(shapes.0, &poses[first], shapes.1, &poses[second]));
            }
        });
    }

    /// A bound of h(|u_n| + μ‖u_t‖) at every candidate. Its rows see a point within the radius R_k of body k, or outside it: beside a face
    /// by at most the gap φ, as above; halfway between parallel faces by φ/2; levelled over the ground by half the diameter times the tilt
    /// θ₀. With s = Σ(‖ẋ_k‖ + |ω_k| R_k (1 + θ₀)) and w = Σ|ω_k| over the two fastest bodies, h(|u_n| + μ‖u_t‖) ≤ h(1 + μ)(s + w φ), which
    /// is below φ for every φ above h(1 + μ) s/(1 − h(1 + μ) w).
    pub(super) fn reached(&self, velocity: &DVector<f64>, h: f64) -> f64 {
        let (mut speeds, mut turns) = ([0.0; 2], [0.0; 2]);
        for (k, body) in self.bodies.iter().enumerate() {
            let turn = velocity[3 * k + 2].abs();
            let rim = turn * body.shape().radius() * (1.0 + PARALLEL_FACES);
            largest(&mut speeds, velocity[3 * k].hypot(velocity[3 * k + 1]) + rim);
            largest(&mut turns, turn);
        }
        let factor = h * (1.0 + self.materials.largest_friction());
        let left = 1.0 - factor * (turns[0] + turns[1]);
        if left > 0.0 { factor * (speeds[0] + speeds[1]) / left } else { f64::INFINITY }
    }
}
