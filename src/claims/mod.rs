//! The claims of the textbook chapter: statement, verdict, evidence, and a check that can fail.
//!
//! Formulas in the texts are TeX between dollar signs (`checks::formula`).
//!
//! The same registry serves `moreau verify` and `tests/claims.rs`.

mod claim;
pub mod errata;
pub(crate) mod experiments;
mod figures;
pub mod front;
mod grade;
mod lookups;
pub mod manual;
mod moved;
mod places;
mod prelude;
mod registry;
mod repeats;
pub mod s0;
pub mod s1;
pub mod s10;
pub mod s11;
pub mod s12;
pub mod s2;
pub mod s3;
pub mod s4;
pub mod s5;
pub mod s6;
pub mod s7;
pub mod s8;
pub mod s9;
mod search;
mod section;
#[cfg(test)]
mod tests;
mod titles;
pub mod v;
mod verdict;

pub(crate) use claim::check;
pub use claim::{CheckFunction, Claim, ClaimVerdict, Evidence, Kind, Reading, Severity, group_of};
pub use figures::Figures;
pub use grade::grade;
pub use moved::{counterpart, is_moved};
pub use places::{PLACES, Place, Places};
pub use registry::{JudgedClaim, Status, all, conclude, find, judge, judge_with_witnesses, matches_group};
pub use repeats::{REPEATS, original};
pub use search::has_words;
pub use section::{CHAPTER, SECTIONS, Section, order};
pub use titles::{title, title_in_tex};
pub use verdict::derive;
