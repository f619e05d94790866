//! How much may be asked for: sizes of files and memory, and iterations.
//!
//! A limit is no tolerance: no result depends on it. What lies beyond it is refused before it is begun, with the size and the cure.

/// Largest file that is read, except for contact problems \[bytes\]: 256 MB. A trajectory of ten bodies over 10⁵ steps has this size.
/// Set.
pub const FILE_BYTES: u64 = 256_000_000;

/// Memory that a run may take by default \[bytes\]: 4 GiB, half the memory of a small machine.
/// Set.
pub const MEMORY_BYTES: u64 = 1 << 32;

/// Most iterations a solver may be allowed: a thousand times the largest default.
/// Set.
pub const ITERATIONS: usize = 100_000_000;
