//! Tolerances of [`crate::certificate`]: rounding, and the part of an impulse that decides.

use moreau_exact::tolerance::EPSILON;

/// γ = mε/(1 − mε), the relative rounding error of m operations (Higham, *Accuracy and Stability*, §3.1); infinite where m ε reaches 1.
///
/// ε is the spacing at 1, twice the unit roundoff, so that data which are themselves rounded are covered too.
pub fn gamma(operations: usize) -> f64 {
    let part = operations as f64 * EPSILON;
    if part < 1.0 { part / (1.0 - part) } else { f64::INFINITY }
}

/// Rounding of a radial projection onto a disk, relative to its radius: a norm of two components, a quotient and two products, eight
/// operations with the radius μ r_n.
pub const PROJECTED: f64 = 8.0 * EPSILON;

/// Most that an impulse may exceed what the velocities of its problem ask of its own contact and still widen a limit, 10⁶, the largest mass
/// ratio that is promised: a body between two that are so much heavier is held against its real load, and what is accepted at 10⁻⁸ is
/// within a hundredth of those velocities however hard contacts press.
pub const JAMMED: f64 = 1e6;

/// Part of the largest velocity in the data that rounding may hide, that hundredth.
pub const HIDDEN: f64 = 1e-2;

/// Size of an entry of W between two contacts, relative to those on the diagonal, from which it couples them: √ε, below which the product
/// of two impulses' motions is rounding.
pub const COUPLED: f64 = 1.0 / 67_108_864.0;

/// Default of `certify --tolerance`, relative to the scale of each residual's unit.
///
/// Energies are quadratic in velocities, so a relative error of √ε = 1.5e-8 in the velocities is what rounding of an
/// energy cannot tell from zero; 1e-8 is the next power of ten below it.
pub const CERTIFY: f64 = 1e-8;
