//! Limits on the command line: memory, and counts that have a largest value.

use super::{Format, number};
use crate::memory::{self, size};
use crate::number::significant;
use crate::solvers::threads;
use crate::tolerance::cli::CERTIFY;
use crate::tolerance::limits::MEMORY_BYTES;
use crate::{Error, Result};
use std::num::NonZeroUsize;
use std::sync::LazyLock;

/// How much memory a subcommand may take.
#[derive(clap::Args)]
pub struct MemoryOption {
    /// Memory that may be taken, a number of bytes or with kB, MB, GB, TB, KiB, MiB, GiB or TiB [default: 4GiB]. What needs more is refused
    /// before it is begun, with the size it needs. A contact problem may take a quarter of it as text; other files have at most 256 MB.
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true)]
    max_memory: Option<String>,
}

impl MemoryOption {
    /// Sets the limit of this process.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the size is none.
    pub fn apply(&self) -> Result<()> {
        memory::set_limit_of_command(self.max_memory.as_deref().map_or(Ok(MEMORY_BYTES), bytes)?);
        Ok(())
    }
}

/// What every subcommand takes that solves contact problems.
#[derive(clap::Args)]
pub struct CommonOptions {
    #[command(flatten)]
    memory: MemoryOption,
    /// Threads of one solver, which gives the same answer bit for bit with any number. Sweeps over very many contacts (`pgs`, problems by
    /// bodies, in the plane by blocks) use them; smaller ones are faster with one [default: as many as the machine has].
    #[arg(long, value_parser = number::count, value_name = "N", allow_negative_numbers = true)]
    threads: Option<usize>,
    /// How to write the result.
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

impl CommonOptions {
    /// Sets the limits of this process.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the size of the memory is none, or the number of threads is 0.
    pub fn apply(&self) -> Result<()> {
        if let Some(threads) = self.threads {
            let none = || Error::invalid("--threads", "is 0", "give a whole number, at least 1");
            threads::set_limit(NonZeroUsize::new(threads).ok_or_else(none)?);
        }
        self.memory.apply()
    }
}

/// A number of bytes.
fn bytes(text: &str) -> Result<u64> {
    const UNITS: [(&str, u64); 9] = [
        ("", 1),
        ("kB", 1000),
        ("MB", 1_000_000),
        ("GB", 1_000_000_000),
        ("TB", 1_000_000_000_000),
        ("KiB", 1 << 10),
        ("MiB", 1 << 20),
        ("GiB", 1 << 30),
        ("TiB", 1 << 40),
    ];
    let number: String = text.chars().take_while(char::is_ascii_digit).collect();
    let unit = UNITS.iter().find(|(name, _)| *name == text[number.len()..].trim());
    let bytes = unit.and_then(|(_, unit)| number.parse::<u64>().ok()?.checked_mul(*unit));
    match bytes {
        Some(bytes) if bytes > 0 => Ok(bytes),
        _ => {
            let cure = format!("use a whole number of bytes above 0, or with a unit, as 4GiB; the largest is {}", size(u64::MAX.into()));
            Err(Error::invalid("--max-memory", format!("is `{text}`"), cure))
        }
    }
}

/// A count from 1 to `most`, given with an option.
///
/// # Errors
/// [`Error::Invalid`] names the option and the limit.
pub fn count(option: &str, value: usize, most: usize) -> Result<usize> {
    if (1..=most).contains(&value) {
        Ok(value)
    } else {
        Err(Error::invalid(option, format!("is {value}"), format!("use a whole number from 1 to {most}")))
    }
}

/// What is accepted where nobody says otherwise, as `1e-8`.
pub fn default_tolerance() -> &'static str {
    static TEXT: LazyLock<String> = LazyLock::new(|| significant(CERTIFY));
    &TEXT
}

/// Refuses a tolerance that is negative, no number, or so large that impulses of zero would do.
pub fn check_tolerance(option: &str, tolerance: f64) -> Result<()> {
    if (0.0..1.0).contains(&tolerance) {
        return Ok(());
    }
    let cure = "use a number from 0 to below 1, a part of the size of each contact's impulse and velocity: with 1 every answer would do";
    Err(Error::invalid(option, format!("is {}", significant(tolerance)), cure))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_whole_numbers_with_units() {
        let known = [("1", 1), ("20kB", 20_000), ("3MB", 3_000_000), ("4GiB", 1 << 32), ("2 GB", 2_000_000_000), ("1TiB", 1 << 40)];
        for (text, expected) in known {
            assert_eq!(bytes(text).expect("a size"), expected, "{text}");
        }
        for text in ["", "0", "-1", "GB", "1.5GB", "1gb", "4GiBs", "nan", "99999999999999999999", "99999999TiB"] {
            assert!(bytes(text).expect_err("no size").to_string().contains("--max-memory"), "{text}");
        }
    }

    #[test]
    fn the_default_tolerance_is_written_short_and_read_back_to_the_last_bit() {
        assert_eq!(default_tolerance(), "1e-8");
        assert_eq!(default_tolerance().parse::<f64>().expect("a number"), CERTIFY);
    }

    #[test]
    fn tolerances_are_parts_of_one() {
        for tolerance in [0.0, 1e-300, 0.999] {
            assert!(check_tolerance("--tolerance", tolerance).is_ok(), "{tolerance}");
        }
        for tolerance in [-1e-300, 1.0, f64::INFINITY, f64::NAN] {
            assert!(check_tolerance("--tolerance", tolerance).expect_err("no part of one").to_string().contains("below 1"), "{tolerance}");
        }
    }

    #[test]
    fn counts_are_held_on_both_sides() {
        assert_eq!([1, 7].map(|value| count("--sweeps", value, 7).expect("within")), [1, 7]);
        for value in [0, 8] {
            assert!(count("--sweeps", value, 7).expect_err("outside").to_string().contains("from 1 to 7"));
        }
    }
}
