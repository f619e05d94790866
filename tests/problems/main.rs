//! The collection of contact problems with certified answers: its records hold, no solver succeeds falsely on it, and what should not
//! matter does not.

mod collection;
mod extremes;
mod larger;
mod metamorphic;
mod piles;
mod solvers;
mod transform;

use moreau::ContactProblem;
use moreau::problems::{ALL, Record, Stored};

/// Every problem that is stored, with its record, of at most so many contacts.
fn stored(most: usize) -> impl Iterator<Item = (&'static Stored, ContactProblem, Record)> {
    ALL.iter().filter(|stored| stored.problem.is_some()).filter_map(move |stored| {
        let record = stored.record().unwrap_or_else(|error| panic!("{}: {error}", stored.name));
        (record.contacts <= most).then(|| (stored, stored.problem().unwrap_or_else(|error| panic!("{}: {error}", stored.name)), record))
    })
}

/// Whether the deep campaign is asked for.
fn is_campaign() -> bool {
    std::env::var_os("MOREAU_CAMPAIGN").is_some()
}
