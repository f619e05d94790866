//! How problems are answered for the record ([`answered`](crate) of the feature `files`).

/// Multiplications by entries of W that an iterative solver may make for a problem: a second or a few.
/// Set.
pub const WORK: usize = 1_000_000_000;

/// Iterations that it may make in any case.
/// Set.
pub const FEW_ITERATIONS: usize = 200;

/// Most rows of a problem that Lemke's method is asked for: its pivots are dense.
/// Set.
pub const LARGEST_PIVOTED: usize = 300;

/// Difference of two velocities, relative to the largest velocity, up to which two accepted answers count as one. Answers at 1e-8 of an
/// ill-conditioned problem differ by up to the root of it.
/// Set.
pub const DIFFERENT: f64 = 1e-4;

/// Residual up to which an answer shows that there is another velocity: an answer that is barely accepted shows none.
/// Set.
pub const FIRM: f64 = 1e-10;

/// Most rows of a problem whose solvers are asked from several starts: each of them takes the time of one solution.
/// Set.
pub const STARTED_ROWS: usize = 120;

/// Contacts, from the first one, whose impulse alone is changed for a start.
/// Set.
pub const STARTED_CONTACTS: usize = 20;

/// Most rows of a problem for which a proof begins from impulses of least norm and of interior points as well: both factor dense matrices.
/// Set.
pub const NEAR_ROWS: usize = 600;

/// Difference of two velocities, relative to the largest velocity, up to which a proof of a solution near an answer begins from impulses
/// with the other one. It decides whether there is a proof, never what is proved.
/// Set.
pub const SAME_VELOCITY: f64 = 1e-6;
