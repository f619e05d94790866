//! A second bound beside a derived one that is far above what is measured: how much of the derived bound a number may use before its change
//! must be told.
//!
//! ```text
//!     regression bound   max(10 · stored, 64 ε max(1, |value|) / size)        shares of the derived bound, see `Expectation::used`
//! ```
//! It exists where a mistake of twice that is within the derived bound, which then does not see it. The stored shares are in
//! `references/regression.json`.

use super::rounding;
use moreau_checks::Expectation;

/// How many times what is stored a number may be.
///
/// A change of the program that moves a number by more is told, on purpose or not.
/// Required: of every number that uses a bound, by the next one to change the program.
pub const TIMES: f64 = 10.0;

/// The regression bound where `stored` is the stored share, as a share of the derived bound; `None` if a mistake of twice that
/// breaks the derived bound too.
///
/// The floor is the rounding of 32 operations on numbers of the size of what is compared: even a distance of 0 is not 0 on a processor
/// that rounds elementary functions or fused products otherwise.
/// Measured: scripts/measure_regression.py, which stores the shares.
pub fn share(expectation: &Expectation, stored: f64) -> Option<f64> {
    let floor = rounding(32, expectation.value.abs().max(1.0)) / expectation.size();
    Some((TIMES * stored).max(floor)).filter(|share| 2.0 * share < 1.0)
}
