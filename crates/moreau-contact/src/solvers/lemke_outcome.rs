//! How Lemke's method ends.

use moreau_exact::scalar::Scalar;
use nalgebra::DVector;

/// How the path of Lemke's method ended.
#[derive(Clone, Debug, PartialEq)]
pub enum LemkeOutcome<T: Scalar> {
    /// 0 ≤ z ⟂ M z + q ≥ 0.
    Solution {
        /// z.
        z: DVector<T>,
        /// Number of pivots.
        pivots: usize,
    },
    /// A secondary ray: (z, z₀) + t (ẑ, ẑ₀) stays on the path for all t ≥ 0. For a matrix without suitable structure
    /// this says nothing about solvability.
    Ray {
        /// z at the start of the ray.
        point: DVector<T>,
        /// z₀ at the start of the ray, positive.
        artificial: T,
        /// ẑ ≥ 0.
        direction: DVector<T>,
        /// ẑ₀ ≥ 0.
        artificial_direction: T,
        /// Number of pivots.
        pivots: usize,
    },
}
