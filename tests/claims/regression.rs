//! What was measured when `references/regression.json` was stored, and how far it may have moved since.
//!
//! A derived bound that is far above what is measured misses small mistakes. The regression bound sees them, and each is shown to: a
//! mistake of twice the bound is planted and must be refused, although the derived bound holds.

use moreau::checks::{Expectation, Relation};
use moreau::tolerance::regression::share;
use serde_json::Value;
use std::collections::BTreeMap;

/// Names with how much of their bounds was used, in the order in which they are found, by the id of a claim or the name of a system.
pub type Stored = BTreeMap<String, Vec<(String, f64)>>;

/// The stored numbers of `claims` or `systems`.
pub fn stored(part: &str) -> Stored {
    let document: Value = serde_json::from_str(include_str!("../../references/regression.json")).expect("the stored numbers");
    serde_json::from_value(document[part].clone()).expect("names and numbers")
}

/// A measured number with its name and what is expected of it.
pub struct Number {
    /// What was measured.
    pub name: String,
    /// The measured value.
    pub measured: f64,
    /// What is expected of it by derivation.
    pub expectation: Expectation,
}

const CURE: &str = "if that is on purpose, run `python3 scripts/measure_regression.py`";

/// What is wrong with numbers that use a bound each: others than those stored, one beyond its regression bound, or a planted mistake of
/// twice that bound that is not caught.
pub fn complaints(stored: &[(String, f64)], numbers: &[Number]) -> Vec<String> {
    let names: Vec<_> = numbers.iter().map(|number| number.name.as_str()).collect();
    let known: Vec<_> = stored.iter().map(|(name, _)| name.as_str()).collect();
    if names != known {
        return vec![format!("found are {names:?}, stored are {known:?}: {CURE}")];
    }
    let pairs = stored.iter().zip(numbers);
    pairs.flat_map(|((_, stored), number)| [moved(number, number.measured, *stored), blind(number, *stored)]).flatten().collect()
}

/// That the measured number is beyond its regression bound.
fn moved(number: &Number, measured: f64, stored: f64) -> Option<String> {
    let (bound, used) = (share(&number.expectation, stored)?, number.expectation.used(measured)?);
    let told = format!(
        "{}: {measured:e} uses {used:.1e} of the derived bound, which holds; stored is {stored:.1e}, allowed {bound:.1e}: {CURE}",
        number.name
    );
    (used > bound).then_some(told)
}

/// That a mistake of twice the regression bound is not caught, or needs no regression bound to be.
fn blind(number: &Number, stored: f64) -> Option<String> {
    let wrong = planted(&number.expectation, 2.0 * share(&number.expectation, stored)?);
    let caught = number.expectation.holds(wrong) && moved(number, wrong, stored).is_some();
    (!caught).then(|| format!("{}: {wrong:e}, twice the regression bound, is not caught by it alone", number.name))
}

/// The number that uses this share of the bound.
fn planted(expectation: &Expectation, share: f64) -> f64 {
    let one_sided = |limit: f64| if limit > 0.0 { share * limit } else { limit / share };
    match expectation.relation {
        Relation::Equal => expectation.value + share * expectation.tolerance,
        Relation::AtMost => one_sided(expectation.value + expectation.tolerance),
        Relation::AtLeast => -one_sided(expectation.tolerance - expectation.value),
    }
}
