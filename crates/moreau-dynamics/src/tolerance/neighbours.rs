//! How the pairs of bodies near each other are kept. No answer depends on these numbers.

/// How much farther than it is asked for the list of near pairs reaches, relative to the mean radius of the bodies: a pile at rest is then
/// looked through once, and a body that falls at 1 m/s with steps of 2 ms and a radius of 0.1 m every tenth step.
/// Set.
pub const MARGIN: f64 = 0.5;

/// Bodies with a radius above so many mean radii are compared with all others, so that they do not widen the cells of the grid.
/// Set.
pub const LARGE: f64 = 2.0;

/// Most cells from the origin to a body: their numbers are whole numbers that a float holds with room to spare.
/// Set.
pub const MOST_CELLS: f64 = 1e12;
