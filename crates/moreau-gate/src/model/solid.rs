//! The inertia of a solid box.

use nalgebra::Vector3;

/// Principal moments ⅓ m (b² + c²) of a box with half extents a, b, c \[kg·m²\].
pub fn box_moments(mass: f64, half_extents: Vector3<f64>) -> Vector3<f64> {
    let square = half_extents.component_mul(&half_extents);
    Vector3::new(square.y + square.z, square.z + square.x, square.x + square.y) * (mass / 3.0)
}

/// m (r²/4 + l²/3), the same and m r²/2 of a solid cylinder of the height 2l about z \[kg·m²\].
pub fn cylinder_moments(mass: f64, [radius, half_height]: [f64; 2]) -> Vector3<f64> {
    let across = mass * (radius * radius / 4.0 + half_height * half_height / 3.0);
    Vector3::new(across, across, 0.5 * mass * radius * radius)
}

/// Those of a cylinder and two half balls of the same density at its ends: of the balls ⅖ m r² about z, and ⅖ r² + l² + ¾ l r times their
/// mass across it, since the centre of mass of a half ball is 3r/8 from its face.
pub fn capsule_moments(mass: f64, [radius, half_height]: [f64; 2]) -> Vector3<f64> {
    let balls = mass * 2.0 * radius / (3.0 * half_height + 2.0 * radius);
    let round = 0.4 * radius * radius;
    let across = round + half_height * (half_height + 0.75 * radius);
    cylinder_moments(mass - balls, [radius, half_height]) + Vector3::new(across, across, round) * balls
}
