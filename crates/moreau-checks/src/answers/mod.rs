//! Checks of certificates and of solvers on contact problems whose answers are known exactly.
//!
//! A certificate accepts every exact answer and refuses every one that is changed at one contact. A solver's answer is accepted by the
//! certificate, does not depend on the impulses it starts from, and follows the contacts when they are renumbered.

mod accepts;
pub mod near;
pub mod posed;
mod solving;

pub use accepts::{Accepts, accepts};
pub use solving::{Answers, certified, forgets_its_start, in_any_order};

use crate::finding::Finding;
use moreau_exact::Result;
use near::{CHANGES, Change, SIZES, changed, exact};
use posed::Posed;

/// Every exact answer is accepted: one finding per problem.
///
/// # Errors
/// Those of the certificate.
pub fn exact_answers(subject: &Accepts) -> Result<Vec<Finding>> {
    let posed = posed::all()?;
    posed.iter().map(|one| Ok(Finding::decision(one.name, subject(&one.problem, &exact(one))?, true))).collect()
}

/// No changed answer is accepted: one finding per kind of change, a count of those that are.
///
/// # Errors
/// Those of the certificate.
pub fn near_misses(subject: &Accepts) -> Result<Vec<Finding>> {
    let posed = posed::all()?;
    CHANGES.iter().map(|change| Ok(Finding::count(format!("{change:?}, accepted"), missed(subject, &posed, *change)?, 0))).collect()
}

/// How many answers with this change are accepted.
fn missed(subject: &Accepts, posed: &[Posed], change: Change) -> Result<usize> {
    let mut missed = 0;
    for one in posed {
        for (k, delta) in (0..one.problem.contacts()).flat_map(|k| SIZES.map(|delta| (k, delta))) {
            if let Some(answer) = changed(one, change, k, delta) {
                missed += usize::from(subject(&one.problem, &answer)?);
            }
        }
    }
    Ok(missed)
}
