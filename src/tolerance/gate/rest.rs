//! Bodies at rest: what rounding and an iterative solver may move.

/// Distance \[m\] from the place of rest after n steps of a stable map that starts there: n steps leave 16 roundings each of a velocity g h
/// times h, and of the coordinate \[m\]; a solver that minimises an energy to rounding gives each velocity to √ε of g h.
pub fn settled(steps: usize, size: f64, gravity: f64, h: f64, epsilon: f64) -> f64 {
    let steps = steps as f64;
    steps * h * epsilon.sqrt() * gravity * h + 16.0 * steps * epsilon * size
}

/// Speed at rest \[m/s\]: √ε of g h, of each of four components or contacts.
pub fn velocity(gravity: f64, h: f64, epsilon: f64) -> f64 {
    4.0 * epsilon.sqrt() * gravity * h
}

/// Where a body at rest may be \[m\]: a step's fall, for an engine that acts on a contact one step after it closes.
pub fn gap(gravity: f64, h: f64) -> f64 {
    gravity * h * h
}

/// Error of a depth at rest \[m\]: relative 1e-6 of the force (the loosest documented stopping rule), and a coordinate of 0.1 m.
pub fn rest_depth(depth: f64, epsilon: f64) -> f64 {
    crate::tolerance::references::SAP_RELATIVE.max(epsilon.sqrt()) * depth + 64.0 * epsilon * 0.1
}
