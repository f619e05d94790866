//! `--time-limit`: how long a command may compute, or an engine may take for one reply.

use crate::number::significant;
use crate::solvers::watch::Interrupt;
use crate::tolerance::cli::{LONGEST_SECONDS, SHORTEST_SECONDS};
use crate::{Error, Result};
use std::sync::mpsc;
use std::time::Duration;

/// Refuses what is no time \[s\].
///
/// # Errors
/// [`Error::Invalid`] names the option.
pub fn check(limit: Option<f64>) -> Result<()> {
    limit.map_or(Ok(()), |seconds| require("--time-limit", seconds, ", or leave it out for no limit"))
}

/// How long an engine may take for one reply, or for its first one.
///
/// # Errors
/// [`Error::Invalid`] names the option.
pub fn of_reply(option: &str, seconds: f64) -> Result<Duration> {
    require(option, seconds, "")?;
    // what is less than a nanosecond would be no limit at all
    Ok(Duration::from_secs_f64(seconds).max(Duration::from_nanos(1)))
}

/// Refuses what is no time \[s\], with the numbers that are, and with what else there is to do.
fn require(option: &str, seconds: f64, or: &str) -> Result<()> {
    if seconds > 0.0 && seconds <= LONGEST_SECONDS {
        return Ok(());
    }
    let cure = format!("give a time above 0 and up to {LONGEST_SECONDS:e} seconds{or}");
    Err(Error::invalid(option, format!("is {}", significant(seconds)), cure))
}

/// Runs `work`, whose interrupt is given when the time \[s\] is over; before it begins where that is no time at all.
pub fn within<T>(limit: Option<f64>, work: impl FnOnce(&Interrupt) -> T) -> T {
    let interrupt = Interrupt::default();
    let Some(limit) = limit else { return work(&interrupt) };
    if limit <= SHORTEST_SECONDS {
        interrupt.now();
        return work(&interrupt);
    }
    std::thread::scope(|scope| {
        let (done, ended) = mpsc::channel::<()>();
        let clock = interrupt.clone();
        scope.spawn(move || {
            if ended.recv_timeout(Duration::from_secs_f64(limit)) == Err(mpsc::RecvTimeoutError::Timeout) {
                clock.now();
            }
        });
        let result = work(&interrupt);
        drop(done);
        result
    })
}
