//! `claims` and `verify`: the sentences of the chapter as records, as JSON that Python reads.

use crate::away::enter;
use crate::errors::IntoPython;
use crate::interrupt;
use moreau::claims::{self as registry, Claim};
use moreau::report::json::{ClaimEntry, ExplanationEntry, pretty};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// The claims that have all of these words, as they are recorded, a JSON list.
#[pyfunction]
pub fn claims(py: Python<'_>, words: &str) -> PyResult<String> {
    pretty(&registry::all().filter(|claim| registry::has_words(claim, words)).map(ClaimEntry::from).collect::<Vec<_>>()).python(py)
}

/// These claims judged now, a JSON list; ids or groups.
#[pyfunction]
pub fn verify(py: Python<'_>, names: Vec<String>) -> PyResult<String> {
    let _here = enter()?;
    let mut asked: Vec<&'static Claim> = Vec::new();
    for name in &names {
        let found: Vec<_> = match registry::find(name) {
            Some(claim) => vec![claim],
            None => registry::all().filter(|claim| registry::matches_group(claim.id, name)).collect(),
        };
        if found.is_empty() {
            let error = moreau::Error::invalid(
                "ids",
                format!("`{name}` is no claim and no group"),
                "`claims()` has every id, `claims(\"zeno\")` those with a word",
            );
            return Err(error).python(py);
        }
        asked.extend(found);
    }
    let stopped = AtomicBool::new(false);
    let judged = || asked.iter().take_while(|_| !stopped.load(Ordering::Relaxed)).map(|claim| registry::judge(claim)).collect::<Vec<_>>();
    let judged = interrupt::watched(py, judged, || stopped.store(true, Ordering::Relaxed))?;
    pretty(&judged.iter().map(ExplanationEntry::from).collect::<Vec<_>>()).python(py)
}
