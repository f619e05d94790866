//! How much may be asked for: sizes of files and memory, and iterations.
//!
//! A limit is no tolerance: no result depends on it. What lies beyond it is refused before it is begun, with the size and the cure.

/// Largest file that is read, except for contact problems \[bytes\]: 256 MB. A trajectory of ten bodies over 10⁵ steps has this size.
/// Set.
pub const FILE_BYTES: u64 = 256_000_000;

/// Smallest contact problem that is parsed while it is read, in place of a text that stands in the memory whole \[bytes\]: that takes a
/// fifth to a third longer, which small ones need not.
/// Set.
pub const STREAMED_BYTES: u64 = 8_000_000;

/// Bytes of a file that are read at once.
/// Set.
pub const FILE_PART: usize = 1 << 16;

/// Memory that a run may take by default \[bytes\]: 4 GiB, half the memory of a small machine.
/// Set.
pub const MEMORY_BYTES: u64 = 1 << 32;

/// Most spare vectors of a kind that a thread keeps for its next step: twenty steps that are mixed have three each, and a problem and its
/// solvers some dozens.
/// Set.
pub const SPARE_VECTORS: usize = 256;

/// Memory of the spare vectors of a kind that a thread keeps at most \[bytes\]: 8 MB, what a step of some thousand contacts needs.
/// Set.
pub const SPARE_BYTES: usize = 8_000_000;

/// Most iterations a solver may be allowed: a thousand times the largest default.
/// Set.
pub const ITERATIONS: usize = 100_000_000;

/// How many times the room that is asked for, as a power of two, a spare vector has at most: islands of a heap differ by about as much from
/// step to step, and a kept answer holds no more.
/// Set.
pub const SPARE_ROOM: usize = 16;

/// Rows of a dense matrix from which elimination looks between its pivots whether the caller ends it; of fewer all are gone through in
/// microseconds.
/// Set.
pub const WATCHED: usize = 64;
