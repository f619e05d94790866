//! Tolerances of [`moreau_contact::contact`] and [`crate::mechanics`].

use moreau_exact::tolerance::{EPSILON, rounding};

/// Step of a central difference \[s\], ε^⅓ rounded to a power of two (2⁻¹⁷): it balances truncation h²/6·f‴
/// against rounding ε f/h.
/// Set.
pub const DIFFERENCE_STEP: f64 = 1.0 / 131_072.0;

/// Error of a central difference of a function of size `size` along a velocity of size `speed`: truncation
/// h²/6·|f‴| with |f‴| ≤ 6·size·(1 + speed)³, and 8 rounding errors of size ε·size over 2h.
///
/// The bound on f‴ covers compositions of distances and rotations at unit length scale, which is what the
/// mechanisms' gaps and potentials are.
/// Derived.
pub fn central_difference(speed: f64, size: f64) -> f64 {
    let h = DIFFERENCE_STEP;
    size * (h * h * (1.0 + speed).powi(3) + 4.0 * EPSILON / h)
}

/// The largest energy error of a Runge–Kutta run with half the step of one whose error is `coarse`: of order four it is a sixteenth to
/// leading order, of order three an eighth; the next order of h is left as much again.
/// Derived.
pub fn runge_kutta_energy(coarse: f64) -> f64 {
    coarse / 12.0
}

/// Newton steps for the midpoint spin: the contraction constant is at most √½·½ < 0.36, so the first error is below 0.6 of the
/// size, and each step more than squares it; six reach ε from there.
/// Set.
pub const NEWTON_STEPS: usize = 6;

/// Sine of the angle below which crossing edges of two boxes count as parallel. What it leaves out is at most a thousandth of the tilt
/// of the faces. A normal that is kept loses at most a factor of a thousand in accuracy.
/// Set.
pub const PARALLEL: f64 = 1.0 / 1024.0;

/// How far a corner may lie beside the face from which its gap is measured, relative to that gap. Faces tilted against each other by up to
/// 1/16 need this much. The gap from the plane then differs from the distance to the face by at most 1/512 of it.
/// Set.
pub const BESIDE: f64 = 1.0 / 16.0;

/// Angle θ₀ \[rad\] up to which two faces count as parallel and share one normal, their bisector: [`PARALLEL`] times [`BESIDE`], 2⁻¹⁴.
///
/// The rows of a contact then have the gap's rate up to tan α (‖v_t‖ + |φ|‖dn/dt‖), α the angle between the shared normal and the contact's
/// own:
/// - α = θ/2 ≤ 2⁻¹⁵ for a corner over a face. While it slides by s its gap changes unseen by at most 2⁻¹⁵ s, 31 µm per metre;
/// - tan α ≤ 2 sin(θ/2)/sin ψ ≤ θ₀/[`PARALLEL`] = [`BESIDE`] for edges that cross at the angle ψ. Their crossing stays within the outline
///   of the overlap, of diameter D, and the gap of two planes differs by at most θ D over it, so no slide changes it unseen by more than θ₀
///   D.
///
/// Both are errors of one step: the next one measures the gaps anew. Gaps measured along the two normals differ by a factor cos α,
/// 1 − 2⁻³¹ for corners and at least 1 − 2⁻⁹ for edges. In exchange, normals that differ by less do not occur. Rows that are dependent but
/// for a tilt θ have an operator W with eigenvalues of θ² beside those of order one, and sweeps need 1/θ² rounds to see the difference.
/// Set.
pub const PARALLEL_FACES: f64 = PARALLEL * BESIDE;

/// How far two faces are parallel, w = 2 − c/θ₀ cut off at 0 and 1, for outward normals whose sum has the length c = 2 sin(θ/2): 1 up to
/// [`PARALLEL_FACES`], 0 from twice that angle.
///
/// Between the two w θ/2, the angle by which a normal turns, is at most θ₀/2: the bound above holds there, too.
/// Set.
pub fn faces_are_parallel(sum: f64) -> f64 {
    (2.0 - sum / PARALLEL_FACES).clamp(0.0, 1.0)
}

/// Sine of the angle between the axis of a cylinder and the normal of the ground below which it stands on points of its rims that turn with
/// it, besides the lowest ones. A cylinder of radius r that leans so much has its highest point of a rim r/8 above the lowest.
/// Set.
pub const STANDING: f64 = 1.0 / 16.0;

/// Cosine of the angle up to which a face or a pair of features looks along the direction in which two bodies are farthest apart or overlap
/// least, 45°: of two faces of a body at right angles at most one does. A candidate that does and whose points are on both bodies is deeper
/// than they overlap by the inverse at most.
/// Set.
pub const FACING: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Arcs of a circle on which the places nearest to another circle are looked for, one on each at most. Of two such places on one arc, with
/// the farthest one between them, one is lost.
/// Set.
pub const ARCS: usize = 32;

/// Steps in which a root on an arc is found to rounding: a bracket that only halves needs 54.
/// Set.
pub const ROOT_STEPS: usize = 64;

/// How far a corner may lie outside of a face, relative to the size of the boxes, and still be over its rim: 4096 ε. Places of bodies whose
/// centres are up to a hundred times their size from the origin are rounded by less; the gap of such a corner is negative by no more than
/// this where the boxes are apart.
/// Set.
pub const ON_RIM: f64 = 4096.0 * f64::EPSILON;

/// Sine of the angle by which the normal of two edges may point into a face beside one of them, 1/16 or 3.6°. Edges of bodies that turn
/// by as much in a step may touch there at its end, and without them a scheme of linear gaps lets them pass; what points into a face by
/// more pushes a body that lies on another one aside.
/// Set.
pub const LEANING: f64 = 1.0 / 16.0;

/// Contact points of two boxes nearer than this, relative to their size, are one: √ε, far above the rounding with which
/// clipping finds the same corner twice, far below any lever arm that matters.
/// Set.
pub const SAME_POINT: f64 = 1.0 / 67_108_864.0;

/// Gap \[m\] of candidates that tests look at without touch: 2⁻¹⁰, nothing beside levers of a tenth of a metre.
/// Set.
pub const NEAR: f64 = 1.0 / 1024.0;

/// Tilt \[rad\] from which points with normals of their own must show more velocities than rounding does: a tilt turns one row of two
/// points, whose levers and distances are above a tenth, so that the singular value beyond those of the face is above a thousandth of it.
/// Derived.
pub fn tilt_shown(bound: f64) -> f64 {
    1024.0 * bound
}

/// 1 − |n·a| of a normal that is a box's own axis: a rotation of a unit vector and a product of three terms, below 64 roundings.
/// Derived.
pub fn own_axis() -> f64 {
    rounding(64, 1.0)
}

/// |n·d| of a normal n = d × e/|d × e| and its edge d: that rounding over the sine |d × e|, at least [`PARALLEL`].
/// Derived.
pub fn own_edge() -> f64 {
    own_axis() / PARALLEL
}
