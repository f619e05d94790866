//! What tests of the proofs demand: how sharp a proved radius is, and by how much answers are moved before they are judged.

use moreau_exact::tolerance::EPSILON;

/// So many roundings of numbers of size one.
/// Derived.
pub fn roundings(count: f64) -> f64 {
    count * EPSILON
}

/// A few sums of three terms: entries of one contact.
/// Derived.
pub const FEW: f64 = 45.0;

/// Sums over the rows of some contacts.
/// Derived.
pub const SOME: f64 = 10.0 * FEW;

/// Sums over the rows of up to seven contacts, of products of up to a hundred.
/// Derived.
pub const MANY: f64 = 100.0 * FEW;

/// How much wider than the distance from the solution a radius may be, relative to ‖r‖ ‖W‖: the box is at most 2¹² times what Newton's last
/// correction leaves, which is rounding.
/// Required: of every radius that is proved, by the tests of the proofs.
pub const EXCESS: f64 = 1e-9;

/// Accuracy at which the certificate must take every answer that is counted as a solution.
/// Required: of every answer that counts as a solution, by the tests of the proofs.
pub const COUNTED: f64 = 1e-9;

/// By how much answers are moved: not at all, within rounding, within what a solver leaves.
/// Set.
pub const NEAR: [f64; 3] = [0.0, 1e-12, 1e-7];

/// By how much answers are moved that must not get a small radius.
/// Set.
pub const FAR: [f64; 4] = [1e-9, 1e-4, 0.25, 16.0];

/// By how much impulses of redundant contacts are moved.
/// Set.
pub const REDUNDANT: [f64; 5] = [0.0, 1e-7, 1e-2, 1.0, 8.0];
