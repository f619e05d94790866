//! Work without the lock of the interpreter, and the end of the interpreter while some of it goes on in other threads.
//!
//! A thread that comes back to an interpreter which is ending is ended in the middle of its calls, and those of Rust do not bear that. So
//! Python's `atexit` waits for what goes on, and nothing begins any more.

use pyo3::exceptions::PySystemExit;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

static CLOSING: AtomicBool = AtomicBool::new(false);
static RUNNING: AtomicUsize = AtomicUsize::new(0);

/// How often the end looks whether all work is done.
const LOOK: Duration = Duration::from_millis(1);

/// One more that is in a call, until it is dropped.
pub struct Away;

/// A call begins; it goes on as long as what is returned lives.
///
/// # Errors
/// `SystemExit` where the interpreter ends, which ends a thread and is told nowhere.
pub fn enter() -> PyResult<Away> {
    RUNNING.fetch_add(1, Ordering::SeqCst);
    let counted = Away;
    if is_closing() { Err(PySystemExit::new_err(())) } else { Ok(counted) }
}

impl Drop for Away {
    fn drop(&mut self) {
        RUNNING.fetch_sub(1, Ordering::SeqCst);
    }
}

/// Does `work` without the lock of the interpreter.
///
/// # Errors
/// Those of [`enter`].
pub fn away<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    // counted until the lock is held again
    let _here = enter()?;
    Ok(py.detach(work))
}

/// Whether the interpreter ends: long work is to end as well.
pub fn is_closing() -> bool {
    CLOSING.load(Ordering::SeqCst)
}

/// From now on nothing begins; returns when nothing goes on. Python calls it when it ends.
#[pyfunction]
pub fn close(py: Python<'_>) {
    CLOSING.store(true, Ordering::SeqCst);
    while RUNNING.load(Ordering::SeqCst) > 0 {
        py.detach(|| std::thread::sleep(LOOK));
    }
}
