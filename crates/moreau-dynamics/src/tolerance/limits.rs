//! How much may be asked for: sizes of files and memory, and counts given on the command line.
//!
//! A limit is no tolerance: no result depends on it. What lies beyond it is refused before it is begun, with the size and the cure.

/// Most sweeps over the contacts in one step of position-based dynamics: hundreds of times those of its authors.
/// Set.
pub const SWEEPS: usize = 10_000;

/// Most friction directions of a spatial contact. The pyramid of d directions is inside the cone up to 1 − cos(π/d): with 1024 that is
/// 5·10⁻⁶.
/// Set.
pub const DIRECTIONS: usize = 1024;

/// Most parts into which a step is divided for the torque-free rotation of a body: each turns by at most half a radian, so that a step
/// turns by at most 512 rad. Beyond it, a step is hundreds of turns long and says nothing about the motion, and its work would grow with
/// the spin.
/// Set.
pub const PRECESSION_PARTS: usize = 1024;
