//! How far the regular polygon with d vertices is from the circle.

use crate::cones::polyhedral::direction;

/// d^order times the measured defect of strength, and d times the measured direction and force-vector errors.
///
/// They are measured on the vertices and the middle of a side, where support function and chord are extreme.
pub fn scaled_errors(order: i32, d: usize) -> [f64; 3] {
    let ([x, y], [a, b]) = (direction(0, d), direction(1, 2 * d));
    let reach = x * a + y * b;
    let count = d as f64;
    [count.powi(order) * (1.0 - reach), count * reach.acos(), count * (x - a).hypot(y - b)]
}
