//! Tolerances of [`crate::certificate`]: rounding, and the part of an impulse that decides.

use moreau_exact::tolerance::EPSILON;
use nalgebra::DMatrix;

/// γ = mε/(1 − mε), the relative rounding error of m operations (Higham, *Accuracy and Stability*, §3.1). It is infinite if m ε reaches 1.
///
/// ε is the spacing at 1, twice the unit roundoff, so that the bound also covers data that are rounded themselves.
/// Derived.
pub fn gamma(operations: usize) -> f64 {
    let part = operations as f64 * EPSILON;
    if part < 1.0 { part / (1.0 - part) } else { f64::INFINITY }
}

/// γ of a row y_i = Σ_j W_ij r_j + q_i, relative to Σ_j |W_ij||r_j| + |u_free| + |shift| + R_i|r_i|, of `terms` products: those of the
/// contacts that W joins with this one. Each is rounded, and so is each sum; what W does not join adds zeros, which round nothing, so that
/// a contact is judged alone as beside any number that it never meets. u_free, shift and R r take four more, and as many halves of ε again
/// are left to data that are rounded themselves: m = 2 terms + 8 spacings in all.
///
/// Where W acts through bodies, relative to |Yᵀ|D⁻¹|Y||r|, an impulse is one of at most `terms` that push a body, whose velocity is divided
/// by its mass and is one of those of the bodies of a contact: at most terms + 12 + 6 halves of ε for the [`VELOCITIES`] of two bodies in
/// space, of the 4 terms + 16 that there are; each four further ones count as a term.
/// Derived.
pub fn row_rounding(terms: usize) -> f64 {
    gamma(terms.saturating_mul(2).saturating_add(8))
}

/// A bound of ‖A⁻¹‖, A = S M S with ones on its diagonal, by the pivots of M = L D Lᵀ: the least eigenvalue of A is at least
/// 1/(e Π M_jj/D_j), for Π D_j/M_jj is the product of all, and the others sum to less than n.
/// Derived.
pub fn lost_of_pivots(mass: &DMatrix<f64>, pivots: &[f64]) -> f64 {
    3.0 * pivots.iter().enumerate().map(|(v, pivot)| mass[(v, v)] / pivot).product::<f64>()
}

/// 48: a mass whose scaled inverse is at most this large, by a bound of it, loses digits that are among the halves of ε which
/// [`row_rounding`] leaves to data: bodies that lie askew have such masses.
/// Set.
pub const KEPT_BY_MASS: f64 = 48.0;

/// Velocities of two bodies in space: see [`row_rounding`].
/// Derived.
pub const VELOCITIES: usize = 12;

/// Rounding of a radial projection onto a disk, relative to the radius μ r_n. It takes eight operations: a norm of two components, a
/// quotient and two products, and the radius.
/// Derived.
pub const PROJECTED: f64 = 8.0 * EPSILON;

/// 10³: the scale of an impulse is at most this many times the impulse that the largest velocity of the problem asks of the contact. So the
/// lowest of a thousand equal bodies is judged by its real load; a light body between heavier ones, and impulses that only push against
/// each other, excuse no more. An answer that is accepted at 10⁻⁸ misses its law by at most 10⁻⁵ of those velocities, however hard contacts
/// press; where W is nearly singular velocities may be off by more, as the root of that, and `certify --prove` says how far. Double
/// precision reaches it, for the rounding of a load 10⁶ times larger is 10⁻¹⁰ of them times the number of terms.
/// Required: of every answer that is accepted, by the users of the certificate.
pub const JAMMED: f64 = 1e3;

/// Part of the largest velocity in the data that rounding may hide: 10⁻⁵, as for [`JAMMED`] at 10⁻⁸.
/// Required: of every answer that is accepted, by the users of the certificate.
pub const HIDDEN: f64 = 1e-5;

/// Part of the largest velocity in the data by which a W that was formed may be off before y is computed from what it was formed of: what
/// an answer is held to by default, [`CERTIFY`].
/// Derived.
pub const OFF_BY_FORMING: f64 = CERTIFY;

/// √ε. Two contacts are coupled if an entry of W between them is larger than this, relative to the entries on the diagonal. Below it the
/// product of the motions of two impulses is rounding.
/// Derived.
pub const COUPLED: f64 = 1.0 / 67_108_864.0;

/// Default of `certify --tolerance`, relative to the scale of each residual's unit.
///
/// Energies are quadratic in velocities, so a relative error of √ε = 1.5e-8 in the velocities is what rounding of an
/// energy cannot tell from zero; 1e-8 is the next power of ten below it.
/// Required: of every answer that is accepted, by the users of `moreau certify`.
pub const CERTIFY: f64 = 1e-8;

/// How far a W given alone may be from a positive semidefinite one, in parts of its diagonal: rounding, half the digits of a double,
/// six digits, four. An impulse that counts as none is held against what it moves, times this part: nothing is asked of bodies, all of a
/// matrix that is none, and of one that was written with few digits what those may hide.
/// Set.
pub const LEVELS: [f64; 4] = [0.0, 1.0 / (1 << 26) as f64, 1.0 / (1 << 20) as f64, 1.0 / (1 << 13) as f64];

/// Rows that are eliminated in one front to see whether W is positive semidefinite, where no order leaves zeros: a second or two.
/// Set.
pub const LARGEST_FRONT: usize = 4096;

/// Members and squares of lists that are merged to find an order for the same, 2²⁸: a second or two; a lattice of 5 464 spheres takes half
/// of it. What takes more is not looked at as a whole.
/// Set.
pub const MOST_MERGED: usize = 1 << 28;

/// Four times. An entry of W that is larger than this, relative to √(W_ii W_jj), is none of bodies, whose most is 1: rounding and asymmetry
/// of spinning bodies stay far below it. It decides only whether an impulse that is small at its own contact is asked what it moves
/// elsewhere; what it may move does not depend on it.
/// Required: of every stored W of bodies, that nothing more is asked of its answers, by the users of the certificate.
pub const OVERREACHING: f64 = 4.0;
