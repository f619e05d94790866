//! A contact problem with its answers: what every solver does with it, and the record `answered-problem/1` of what is known.
//!
//! ```text
//!     answers   r with different u, each certified at 1e-8, with δ of the nearest problem it solves exactly and who else found it
//! ```

mod measure;
mod near;
mod record;
mod starts;

pub use measure::{Found, Measured, Within, measure, measure_within};
pub use near::near;
pub use record::{Answered, Bound, Difficulty, Ended, Known, OtherAnswer, Outcome, RECORD_SCHEMA, Record, Uniqueness};
pub use starts::from_several_starts;
