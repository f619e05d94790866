//! How much may be asked for: sizes of files and memory, and counts given on the command line.
//!
//! A limit is no tolerance: no result depends on it. What lies beyond it is refused before it is begun, with the size and the cure.

pub use moreau_contact::tolerance::limits::{FILE_BYTES, ITERATIONS, MEMORY_BYTES};
pub use moreau_dynamics::tolerance::limits::{DIRECTIONS, PRECESSION_PARTS, SWEEPS};
