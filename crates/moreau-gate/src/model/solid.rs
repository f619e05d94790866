//! The inertia of a solid box.

use nalgebra::Vector3;

/// Principal moments ⅓ m (b² + c²) of a box with half extents a, b, c \[kg·m²\].
pub fn box_moments(mass: f64, half_extents: Vector3<f64>) -> Vector3<f64> {
    let square = half_extents.component_mul(&half_extents);
    Vector3::new(square.y + square.z, square.z + square.x, square.x + square.y) * (mass / 3.0)
}
