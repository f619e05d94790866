//! Long work beside a Python that stays awake: other threads run, and Ctrl-C ends it.

use crate::away::{away, is_closing};
use pyo3::exceptions::PySystemExit;
use pyo3::prelude::*;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// How often Python is asked for signals.
const LOOK: Duration = Duration::from_millis(50);

/// What ends the work: Ctrl-C, or the end of the interpreter.
fn signals() -> PyResult<()> {
    if is_closing() { Err(PySystemExit::new_err(())) } else { Python::attach(|py| py.check_signals()) }
}

/// Does `work` in a thread of its own, which knows nothing of Python; at Ctrl-C `stop` is called and `KeyboardInterrupt` raised at once.
/// The work is not awaited: it ends at its next look, and nobody hears it.
///
/// # Errors
/// What Python raises while it waits.
///
/// # Panics
/// As the work.
pub fn abandoned<T: Send + 'static>(py: Python<'_>, work: impl FnOnce() -> T + Send + 'static, stop: impl Fn() + Sync) -> PyResult<T> {
    away(py, || {
        let (done, ended) = channel();
        let worker = std::thread::spawn(move || {
            let result = work();
            let _ = done.send(());
            result
        });
        while let Err(RecvTimeoutError::Timeout) = ended.recv_timeout(LOOK) {
            if let Err(raised) = signals() {
                stop();
                return Err(raised);
            }
        }
        worker.join().map_or_else(|panic| std::panic::resume_unwind(panic), Ok)
    })?
}

/// Does `work` in a thread of its own, without the lock of the interpreter; at Ctrl-C `stop` is called, the work is awaited, and
/// `KeyboardInterrupt` raised.
///
/// # Errors
/// What Python raises while it waits.
///
/// # Panics
/// As the work.
pub fn watched<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send, stop: impl Fn() + Sync) -> PyResult<T> {
    away(py, || {
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
                    raised = signals();
                }
                // again and again: what is just being begun is told as well
                if raised.is_err() {
                    stop();
                }
            }
            let result = worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            raised.map(|()| result)
        })
    })?
}
