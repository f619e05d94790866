//! Bounds of rounding in proofs: what is added to a rounded number so that it is a bound.

use moreau_exact::tolerance::EPSILON;

/// A bound from above of a sum of so many non-negative terms, each the rounded result of at most four operations, from the rounded sum:
/// γ_{n+4} ≤ 2 (n + 4) ε, a last rounding, and n times the smallest normal number for products that underflow.
/// Derived.
pub fn enlarged(sum: f64, terms: usize) -> f64 {
    let terms = (terms + 4) as f64;
    (sum * (1.0 + 2.0 * terms * EPSILON) + terms * f64::MIN_POSITIVE).next_up()
}

/// The error of a sum of n products whose absolute values sum to `magnitude`, when the errors of all products and sums are summed
/// apart and added at the end: with the unit roundoff u = ε/2 they sum to at most (n + 2) u times the magnitude, 2n sums of them err by at
/// most 2.1 n u times that, and the rounded magnitude is too small by at most γ_n; 4 n (n + 2) u² bounds it for n < 2²⁰. Each product may
/// lose a number below the smallest normal one besides.
///
/// Source: T. Ogita, S. M. Rump, S. Oishi, *Accurate sum and dot product*, SIAM J. Sci. Comput. 26 (2005), §5, with larger constants.
/// Derived.
pub fn compensated(terms: usize, magnitude: f64) -> f64 {
    let n = terms as f64;
    enlarged(n * (n + 2.0) * EPSILON * EPSILON * magnitude, terms)
}

/// |fl(C J) − C J| ≤ γ_n |C| |J| entry by entry, in whatever order and with or without fused operations (Higham, §3.5): this γ_n, n the
/// inner size, with ε in place of u = ε/2.
/// Derived.
pub fn product(inner: usize) -> f64 {
    super::certificate::gamma(inner + 2)
}

/// An entry of the Jacobian D_r + D_y A is a sum of four products of rounded numbers: 8 u relative to the sum of their sizes.
/// Derived.
pub const ENTRY: f64 = 4.0 * EPSILON;

/// How much larger than what is needed a box begins, and how much it grows when it was too small: a box that is twice as large needs a
/// contraction of one half.
/// Set.
pub const INFLATION: f64 = 2.0;

/// Part of an impulse that a box is never smaller than, 2⁻⁵⁰: four times the spacing of its numbers.
/// Set.
pub const SMALLEST_BOX: f64 = 4.0 * EPSILON;

/// Boxes that are tried. Their size doubles at most, so that the last is 2¹² times the first.
/// Set.
pub const BOXES: usize = 12;

/// Corrections by Newton's method from the answer. It doubles the digits of an answer; a stored one has eight or more.
/// Set.
pub const CORRECTIONS: usize = 6;

/// How often the pattern of open, sticking and sliding contacts is read off again.
/// Set.
pub const PATTERNS: usize = 4;

/// Most rows with an impulse: their matrices are dense, three of 3000² take 216 MB and a second or two.
/// Set.
pub const ROWS: usize = 3000;

/// ε times the rows: below this part of the largest a pivot is rounding.
/// Derived.
pub fn dependent_pivot(rows: usize) -> f64 {
    (rows as f64 + 8.0) * EPSILON
}

/// Most multiplications for deciding a rank, a few seconds.
/// Set.
pub const RANK_STEPS: f64 = 2e9;

/// Most rows of a matrix whose definiteness is decided in fractions: a second at most.
/// Set.
pub const EXACT_ROWS: usize = 40;

/// Weights α of the condition for uniqueness, relative to √(W_nn W_tt) of the contact. They only decide which of the problems that have one
/// solution are seen to.
/// Set.
pub const WEIGHTS: [f64; 7] = [1.0, 0.5, 2.0, 0.25, 4.0, 0.125, 8.0];

/// Most contacts of a problem for which a witness is searched by a linear program in fractions, which finds one if there is one: seconds at
/// most. Of more contacts it is looked for among impulses that move nothing ([`WITNESS_ENTRIES`]).
/// Set.
pub const WITNESS_CONTACTS: usize = 12;

/// Most contacts of the associated law whose witness is searched among all impulses of their cones: the fractions of eight unknowns at each
/// of eight contacts take more than a minute. Beyond, it is searched among normal impulses.
/// Set.
pub const WITNESS_ROUND: usize = 3;

/// Most entries of the matrix in whose kernel a witness is looked for where there are more contacts: rows times generators, as of 290
/// contacts in space; its least squares take seconds.
/// Set.
pub const WITNESS_ENTRIES: usize = 1 << 18;

/// Most generators that may be brought in for such a witness: a cycle of more bodies than this is not found.
/// Set.
pub const WITNESS_STEPS: usize = 160;

/// Part of the largest weight of such a witness, in rounded numbers, up to which a generator is taken for one that takes no part, 2⁻⁴⁰.
/// Set.
pub const TAKES_PART: f64 = 1.0 / (1_u64 << 40) as f64;

/// How often generators with a negative weight are left out and the weights of the others are looked for again.
/// Set.
pub const WITNESS_DROPS: usize = 8;

/// Most Σ n³ over islands of n contacts among which a witness is searched: as much work as eight islands of the largest size.
/// Set.
pub const WITNESS_WORK: usize = 8 * WITNESS_CONTACTS.pow(3);

/// Impulses of so many times what the fastest given velocity asks of their contact are looked at twice: such an answer is believed only if
/// no witness is found that there is none. In a problem without solution impulses grow until a residual v is τ times as large, so that at a
/// part v/V > 4 τ of the largest velocity V they reach this.
/// Derived.
pub const LOADED: f64 = 4.0;

/// Most contacts in the plane all of whose patterns are tried, 4⁶ = 4 096 linear systems in fractions.
/// Set.
pub const PATTERN_CONTACTS: usize = 6;

/// Difference of two velocities, relative to the largest one, up to which an answer is not tried a second time. An answer that could be
/// proved to be another one all the same is missed.
/// Set.
pub const AGAIN: f64 = 1e-9;

/// Most rows of a problem of which a segment of solutions is looked for: six contacts in space. The numbers of its linear programs in
/// fractions grow with every pivot, so that twenty contacts take many minutes.
/// Set.
pub const SEGMENT_ROWS: usize = 18;

/// How near the tangent of half of a slip's angle is to a small fraction that is tried in its place, and the part of the largest velocity
/// that is taken for none where a segment is looked for. What is found is checked in fractions.
/// Set.
pub const DIRECTION: f64 = 1e-9;

/// Largest denominator of such a fraction.
/// Set.
pub const LARGEST_DENOMINATOR: i64 = 64;

/// Most contacts in space all of whose directions of slip are tried: three angles at most.
/// Set.
pub const SPATIAL_CONTACTS: usize = 3;

/// Most pieces into which one pattern of contacts in space is cut: half a second where a piece takes 0.13 ms.
/// Set.
pub const PIECES: usize = 4_000;

/// Pieces that the parts of a problem are looked at in together, from which on no further part is: those of sixteen patterns that are cut
/// as far as they may be, some ten seconds.
/// Set.
pub const PARTS_WORK: usize = 16 * PIECES;

/// Pieces that a set of complementary cones counts as: 0.3 ms where a piece takes 0.13 ms.
/// Set.
pub const SET_WORK: usize = 3;

/// Pieces that a pattern of so many rows counts as in fractions: 3 ms of twelve rows whose numbers have all their digits, and no more than
/// a piece of three.
/// Set.
pub const fn pattern_work(rows: usize) -> usize {
    1 + rows.pow(3) / 64
}

/// The shortest arc that is halved, in the tangent of half of its angle, 2⁻¹⁶: a solution that is not seen to be one or none in an arc as
/// short as this is on a border between two cases, or nearly so.
/// Set.
pub const NARROWEST: f64 = 1.0 / (1_u64 << 16) as f64;

/// Part of an arc by which it reaches beyond a candidate, so that the candidate is inside.
/// Set.
pub const BEYOND: f64 = 0.25;

/// Below this κ a matrix of intervals is taken for regular: any number below one would do, and bounds grow as 1/(1 − κ).
/// Set.
pub const CONTRACTION: f64 = 0.9;

/// Steps towards the weights for which κ is smallest. They only decide how often a regular matrix is seen to be regular.
/// Set.
pub const WEIGHT_STEPS: usize = 4;

/// Part of the last weights that is kept in such a step, so that none becomes zero.
/// Set.
pub const SHARE: f64 = 0.1;

/// Facets around a round cone when a separating vector is proposed; the proof is of the round cone.
/// Set.
pub const FACETS: usize = 24;

/// Part of its length by which every generator moves towards the residual when a separating vector is proposed, 2⁻³⁰: above the rounding of
/// the intervals that decide, and small beside what separates.
/// Set.
pub const MARGIN: f64 = 1.0 / (1_u64 << 30) as f64;

/// Part of the free velocity above which a residual may separate, 2⁻²⁰: far above what [`MARGIN`] changes.
/// Set.
pub const SEPARATED: f64 = 1.0 / (1_u64 << 20) as f64;

/// Steps of the nearest point of a cone with some dozen generators: each enters a few times at most.
/// Set.
pub const LEAST_STEPS: usize = 60;

/// The cosine below which a generator is taken for orthogonal to the residual, 2⁻⁴⁰.
/// Set.
pub const SMALLEST_GAIN: f64 = 1.0 / (1_u64 << 40) as f64;

/// Part of the largest entry below which a singular value of W is taken for zero where impulses are guessed, 2⁻³⁰; the proof follows.
/// Set.
pub const UNDETERMINED: f64 = 1.0 / (1_u64 << 30) as f64;

/// Most rows of a problem whose W of mass and Jacobian is made in fractions.
/// Set.
pub const MADE_ROWS: usize = 300;

/// Most velocities that a mass couples of which the inverse is taken in fractions.
/// Set.
pub const COUPLED_VELOCITIES: usize = 24;
