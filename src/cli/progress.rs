//! Progress on a terminal: nothing for what is done at once, a bar where the parts are counted, and the time where they are not.
//!
//! ```text
//!     ━━━━━━━━╸        12/23 solvers, lemke  8s          solving  8s
//! ```
//! Where standard error is no terminal, nothing is drawn.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// What is done sooner shows nothing.
const PATIENCE: Duration = Duration::from_secs(2);
/// How often the time is drawn again.
const TICK: Duration = Duration::from_millis(200);

/// A bar over so many parts, named by `of`; its message stands beside them.
pub fn parts(count: usize, of: &str) -> ProgressBar {
    styled(
        ProgressBar::with_draw_target(Some(count as u64), ProgressDrawTarget::hidden()),
        &format!("{{bar:40}} {{pos}}/{{len}} {of}{{msg}}"),
    )
}

/// A word for work whose parts are not known.
pub fn word(what: &'static str) -> ProgressBar {
    styled(ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden()), "{spinner} {msg}").with_message(what)
}

fn styled(bar: ProgressBar, template: &str) -> ProgressBar {
    if let Ok(style) = ProgressStyle::with_template(&format!("{template}  {{elapsed}}")) {
        bar.set_style(style);
    }
    bar
}

/// Does the work on this thread, and shows the bar once it takes long.
pub fn shown<T>(bar: &ProgressBar, work: impl FnOnce() -> T) -> T {
    shown_after(PATIENCE, bar, work)
}

fn shown_after<T>(patience: Duration, bar: &ProgressBar, work: impl FnOnce() -> T) -> T {
    let result = thread::scope(|scope| {
        let (done, ended) = mpsc::channel::<()>();
        scope.spawn(move || {
            if ended.recv_timeout(patience) == Err(RecvTimeoutError::Timeout) {
                bar.set_draw_target(ProgressDrawTarget::stderr());
                bar.enable_steady_tick(TICK);
            }
        });
        let result = work();
        drop(done);
        result
    });
    bar.finish_and_clear();
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_work_s_result_comes_back_from_this_thread_and_the_bar_is_gone() {
        for patience in [Duration::ZERO, PATIENCE] {
            let (bar, here) = (parts(3, "parts"), thread::current().id());
            let there = shown_after(patience, &bar, || {
                bar.inc(1);
                thread::current().id()
            });
            assert!(there == here && bar.is_finished() && bar.length() == Some(3), "{patience:?}");
        }
    }

    #[test]
    fn work_that_panics_ends_the_wait() {
        let begun = std::time::Instant::now();
        let panicked = std::panic::catch_unwind(|| shown_after(Duration::from_secs(60), &word("working"), || panic!("planted")));
        assert!(panicked.is_err() && begun.elapsed() < Duration::from_secs(30));
    }
}
