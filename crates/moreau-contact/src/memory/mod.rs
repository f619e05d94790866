//! Memory is checked before it is taken: the need of a computation is estimated from its sizes and compared with one limit.
//!
//! The limit belongs to the process, as its memory does; the command line sets it once, before anything else. No result depends on it: a
//! computation within the limit gives the same answer under every limit. Memory that was taken may be used again ([`spare`]).

pub mod spare;

use crate::tolerance::limits::MEMORY_BYTES;
use moreau_exact::{Error, Result};
use std::fmt::Display;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};

static LIMIT: AtomicU64 = AtomicU64::new(MEMORY_BYTES);

/// Whether the limit is that of an option of the command line, which its messages then name in place of the function.
static IS_OPTION: AtomicBool = AtomicBool::new(false);

/// The limit \[bytes\].
pub fn limit() -> u64 {
    LIMIT.load(Relaxed)
}

/// Sets the limit \[bytes\] of this process.
pub fn set_limit(bytes: u64) {
    LIMIT.store(bytes, Relaxed);
    IS_OPTION.store(false, Relaxed);
}

/// [`set_limit`] for a command, whose option `--max-memory` is named where the limit is too low.
pub fn set_limit_of_command(bytes: u64) {
    set_limit(bytes);
    IS_OPTION.store(true, Relaxed);
}

/// What raises the limit, as a message names it.
#[cfg(feature = "files")]
pub(crate) fn raised_by() -> &'static str {
    if IS_OPTION.load(Relaxed) { OPTION } else { "`memory::set_limit`" }
}

/// The option of the command line.
const OPTION: &str = "--max-memory";

/// Refuses a computation that needs more than the limit.
///
/// # Errors
/// [`Error::Invalid`] with the size needed and the cure.
pub fn require(what: impl Display, bytes: u128) -> Result<()> {
    require_within(limit(), IS_OPTION.load(Relaxed), what, bytes)
}

fn require_within(limit: u64, is_option: bool, what: impl Display, bytes: u128) -> Result<()> {
    if bytes <= u128::from(limit) {
        return Ok(());
    }
    let problem = format!("is {}, but {what} needs about {}", size(u128::from(limit)), size(bytes));
    // the next whole number of MB, as the command line takes it
    let megabytes = bytes.div_ceil(1_000_000);
    let (field, cure) = match is_option {
        true => (OPTION, format!("pass {OPTION} {megabytes}MB")),
        false => ("memory::limit", format!("call `memory::set_limit({megabytes}_000_000)`")),
    };
    Err(Error::invalid(field, problem, format!("take fewer bodies or contacts, or {cure}")))
}

/// Bytes of a dense matrix, without overflow.
pub fn matrix(rows: usize, columns: usize) -> u128 {
    (rows as u128).saturating_mul(columns as u128).saturating_mul(8)
}

/// Bytes for reading, with a unit.
pub fn size(bytes: u128) -> String {
    const UNITS: [(&str, u128); 5] = [("TB", 1_000_000_000_000), ("GB", 1_000_000_000), ("MB", 1_000_000), ("kB", 1000), ("B", 1)];
    let (unit, one) = UNITS.into_iter().find(|(_, one)| bytes >= *one).unwrap_or(("B", 1));
    if one == 1 { format!("{bytes} B") } else { format!("{:.1} {unit}", bytes as f64 / one as f64) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_much_as_the_limit_is_granted_and_a_byte_more_is_not() {
        assert!(require_within(1000, false, "a test", 1000).is_ok());
        let message = |is_option| require_within(1000, is_option, "a test", 1_000_001).expect_err("too much").to_string();
        let [library, command] = [false, true].map(message);
        for said in [&library, &command] {
            assert!(said.contains("is 1.0 kB, but a test needs about 1.0 MB"), "{said}");
        }
        assert!(library.contains("`memory::set_limit(2_000_000)`") && !library.contains("--"), "{library}");
        assert!(command.contains("`--max-memory`") && command.contains("pass --max-memory 2MB") && !command.contains("::"), "{command}");
    }

    #[test]
    fn sizes_have_units_and_do_not_overflow() {
        assert_eq!([size(999), size(1500), size(23_400_000_000)], ["999 B", "1.5 kB", "23.4 GB"]);
        assert!(require("a matrix", matrix(usize::MAX, usize::MAX)).is_err());
    }
}
