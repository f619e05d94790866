//! The one clock of the gate: how long an engine may still take, and how long a check took. No result of an engine that answers depends on
//! it.

use std::time::{Duration, Instant};

/// The end of a time limit that starts now. A limit beyond the range of the clock never ends.
pub(super) struct Deadline(Option<Instant>);

impl Deadline {
    /// The end of a time limit that starts now; a limit beyond the clock's range never ends.
    pub(super) fn after(limit: Duration) -> Self {
        Deadline(Instant::now().checked_add(limit))
    }

    /// The time left, zero when it is over.
    pub(super) fn remaining(&self) -> Duration {
        self.0.map_or(Duration::MAX, |end| end.saturating_duration_since(Instant::now()))
    }
}

/// What a computation gives, and how long it took.
pub(crate) fn timed<T>(compute: impl FnOnce() -> T) -> (T, Duration) {
    let begin = Instant::now();
    let value = compute();
    (value, begin.elapsed())
}

/// Asks `ready` again and again, at growing intervals of up to 10 ms, until it answers or the limit is over.
pub(super) fn poll<T>(limit: Duration, mut ready: impl FnMut() -> Option<T>) -> Option<T> {
    let deadline = Deadline::after(limit);
    let mut pause = Duration::from_micros(100);
    loop {
        if let Some(answer) = ready() {
            return Some(answer);
        }
        let remaining = deadline.remaining();
        if remaining.is_zero() {
            return None;
        }
        std::thread::sleep(pause.min(remaining));
        pause = (2 * pause).min(Duration::from_millis(10));
    }
}
