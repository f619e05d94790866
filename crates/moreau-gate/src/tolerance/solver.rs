//! When an answer to a contact problem counts as a solution ([`crate::checks::solver`]).

use moreau_contact::tolerance::solvers::agreement;

/// Allowed residuals, relative to the scale of their unit: √ε. A solver that minimises an energy known to a part ε knows impulses and
/// velocities to √ε. In double precision this is 1.5e-8, close to the certificate's own default.
/// Derived.
pub fn residual(epsilon: f64) -> f64 {
    epsilon.sqrt()
}

/// How far the velocity of an answer with residuals of [`residual`] may be from the known one, relative to the velocity scale, for one
/// contact on a point mass: [`agreement`] with ‖W‖ = ρ = 1, a residual of √ε against the exact answer's 0, and impulses apart by at most
/// twice their scale.
/// Derived.
pub fn known_velocity(epsilon: f64) -> f64 {
    agreement(1.0, residual(epsilon), 2.0, 1.0)
}

/// Rounding of W r + u_free \[m/s\] for an answer r of any size, with the largest row sum `row` of |W|: reading and n products of r.
/// Derived.
pub fn product(epsilon: f64, rows: usize, row: f64, impulse: f64) -> f64 {
    2.0 * (rows + 2) as f64 * epsilon * row * impulse
}
