//! How many threads a sweep over a large problem may use.
//!
//! The number belongs to the process, as its processors do; the command line sets it once, before anything else. No result depends on it:
//! threads share out contacts that touch nothing in common, and what they add up is added in the order of the contacts.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Zero: as many as the machine has for this process.
static LIMIT: AtomicUsize = AtomicUsize::new(0);

/// Most threads of one solver; as many as the machine has for this process, unless [`set_limit`] said otherwise.
pub fn limit() -> NonZeroUsize {
    let available = || std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    NonZeroUsize::new(LIMIT.load(Relaxed)).unwrap_or_else(available)
}

/// Sets the most threads of one solver in this process.
/// ```
/// use moreau_contact::solvers::threads;
/// use std::num::NonZeroUsize;
///
/// threads::set_limit(NonZeroUsize::MIN);
/// assert_eq!(threads::limit().get(), 1);
/// ```
pub fn set_limit(threads: NonZeroUsize) {
    LIMIT.store(threads.get(), Relaxed);
}
