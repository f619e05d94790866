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

/// Most entries of M̂ and H together, zeros included, up to which a mass and a Jacobian that a file lists are written out as matrices for
/// who asks for them: 256 MiB of numbers, more than any problem has that is not too large for a proof.
/// Set.
pub const WRITTEN_OUT: u128 = 1 << 25;

/// Largest slip at a start, 10¹⁰⁰ m/s: products of three numbers of this size are numbers.
/// Derived.
pub const LARGEST: f64 = 1e100;

/// Contacts up to which W of contacts that nearly all meet is stored: what is dense costs less there than what acts through bodies.
/// Set.
pub const STORED_CONTACTS: usize = 240;

/// Numbers that an entry with its place takes in a file: a matrix of more rows than [`DENSE_ROWS`] with fewer entries is written by them.
/// Derived.
pub const NUMBERS_OF_AN_ENTRY: usize = 3;
