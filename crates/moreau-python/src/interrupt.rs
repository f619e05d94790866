//! Long work beside a Python that stays awake: other threads run, and Ctrl-C ends it.

use pyo3::prelude::*;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// How often Python is asked for signals.
const LOOK: Duration = Duration::from_millis(50);

/// Does `work` in a thread of its own, without the lock of the interpreter; at Ctrl-C `stop` is called, the work is awaited, and
/// `KeyboardInterrupt` raised.
///
/// # Errors
/// What Python raises while it waits.
///
/// # Panics
/// As the work.
pub fn watched<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send, stop: impl Fn() + Sync) -> PyResult<T> {
    py.detach(|| {
        std::thread::scope(|scope| {
            let (done, ended) = channel();
            let worker = scope.spawn(move || {
                let result = work();
                // nobody listens any more after Ctrl-C
                let _ = done.send(());
                result
            });
            let mut raised = Ok(());
            while let Err(RecvTimeoutError::Timeout) = ended.recv_timeout(LOOK) {
                if raised.is_ok() {
                    raised = Python::attach(|py| py.check_signals());
                    if raised.is_err() {
                        stop();
                    }
                }
            }
            let result = worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            raised.map(|()| result)
        })
    })
}
