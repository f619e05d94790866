//! How large a problem may be: everything is stored dense.

/// Most entries of one matrix, 1 GiB of numbers.
/// Set.
pub const DENSE_ENTRIES: usize = 1 << 27;

/// Most unknowns (2 + d) n of a polyhedral law with n contacts: matrix, scaled matrix and a tableau twice as wide and its
/// copy hold 6·8192² numbers, 3 GiB.
/// Set.
pub const POLYHEDRAL_UNKNOWNS: usize = 1 << 13;

/// Rows of a problem up to which a sparse mass and Jacobian make a dense W: its algorithms cost less there than those on blocks.
/// Set.
pub const DENSE_ROWS: usize = 240;

/// Largest slip at a start, 10¹⁰⁰ m/s: products of three numbers of this size are numbers.
/// Derived.
pub const LARGEST: f64 = 1e100;
