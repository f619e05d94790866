//! The verdict on a claim, computed from what its findings say.
//!
//! ```text
//!     inconsistent    two passages state different things of one instance
//!     ambiguous       two readings have different outcomes, or the claim is an opinion on a named point and nothing else is refuted
//!     false           a finding refutes the sentence where every printed condition is met
//!     conditional     findings support it where the omitted condition is met, and one refutes it where it is violated
//!     true            all findings support it
//! ```
//! Findings told as context decide nothing.

use super::ClaimVerdict;
use crate::checks::{Finding, Voice};
use std::collections::BTreeMap;

/// The verdict that follows from the findings.
///
/// # Errors
/// In words, if no finding decides, or if the sentence is refuted under a violated condition and nowhere supported.
///
/// ```
/// use moreau::checks::Finding;
/// use moreau::claims::{ClaimVerdict, derive};
///
/// let energy = Finding::equal("energy after the impact", 1.0, 1.0, 0.0, "J");
/// assert_eq!(derive(&[energy.clone()]), Ok(ClaimVerdict::True));
/// assert_eq!(derive(&[energy.says(2.0)]), Ok(ClaimVerdict::False)); // the sentence says 2 J
/// assert!(derive(&[]).is_err()); // nothing found is no verdict
/// ```
pub fn derive(findings: &[Finding]) -> Result<ClaimVerdict, &'static str> {
    let deciding: Vec<&Finding> = findings.iter().filter(|finding| !finding.bearing.context).collect();
    if deciding.is_empty() {
        return Err("no finding decides");
    }
    if passages_differ(&deciding) {
        return Ok(ClaimVerdict::Inconsistent);
    }
    if readings_differ(&deciding) {
        return Ok(ClaimVerdict::Ambiguous);
    }
    let (opinions, deciding): (Vec<_>, Vec<_>) = deciding.into_iter().partition(|one| matches!(one.bearing.voice, Voice::Opinion(_)));
    let refutes = |violated: bool| deciding.iter().any(|finding| !finding.supports() && finding.bearing.violated.is_some() == violated);
    if !opinions.is_empty() && !refutes(false) {
        return Ok(ClaimVerdict::Ambiguous);
    }
    let supported = deciding.iter().any(|finding| finding.supports() && finding.bearing.violated.is_none());
    match (refutes(false), refutes(true)) {
        (true, _) => Ok(ClaimVerdict::False),
        (false, true) if supported => Ok(ClaimVerdict::Conditional),
        (false, true) => Err("refuted where a condition is violated, and supported nowhere"),
        (false, false) => Ok(ClaimVerdict::True),
    }
}

/// Whether two passages state different things under one name, of one instance.
fn passages_differ(findings: &[&Finding]) -> bool {
    let mut stated = BTreeMap::new();
    findings.iter().filter(|finding| matches!(finding.bearing.voice, Voice::Passage(_))).any(|finding| {
        let first = stated.entry(finding.name.as_str()).or_insert_with(|| finding.stated());
        *first != finding.stated()
    })
}

/// Whether one reading is supported throughout and another is not.
fn readings_differ(findings: &[&Finding]) -> bool {
    let mut outcomes: BTreeMap<&str, bool> = BTreeMap::new();
    for finding in findings {
        if let Voice::Reading(reading) = finding.bearing.voice {
            *outcomes.entry(reading).or_insert(true) &= finding.supports();
        }
    }
    outcomes.values().any(|supported| *supported) && outcomes.values().any(|supported| !supported)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(name: &str, value: usize) -> Finding {
        Finding::count(name, value, value)
    }

    #[test]
    fn what_all_findings_support_is_true() {
        assert_eq!(derive(&[found("a", 1), found("b", 2).says(2), found("c", 3).says(4).context()]), Ok(ClaimVerdict::True));
    }

    #[test]
    fn what_one_finding_refutes_is_false() {
        assert_eq!(derive(&[found("a", 1), found("b", 2).says(3)]), Ok(ClaimVerdict::False));
        assert_eq!(derive(&[found("a", 1).says(2), found("b", 2).says(3).violating("c")]), Ok(ClaimVerdict::False));
    }

    #[test]
    fn what_fails_only_where_the_omitted_condition_is_violated_is_conditional() {
        assert_eq!(derive(&[found("a", 1), found("b", 2).says(3).violating("c")]), Ok(ClaimVerdict::Conditional));
        assert_eq!(derive(&[found("a", 1), found("b", 2).says(2).violating("c")]), Ok(ClaimVerdict::True));
        assert!(derive(&[found("b", 2).says(3).violating("c")]).is_err());
    }

    #[test]
    fn passages_are_inconsistent_if_they_state_different_things_of_one_instance() {
        let passages = |one: usize, other: usize| [found("a", 1).says(one).passage("§1"), found("a", 1).says(other).passage("§2")];
        assert_eq!(derive(&passages(1, 2)), Ok(ClaimVerdict::Inconsistent));
        assert_eq!(derive(&passages(1, 1)), Ok(ClaimVerdict::True));
        assert_eq!(derive(&[found("a", 1).passage("§1"), found("b", 2).passage("§2")]), Ok(ClaimVerdict::True));
    }

    #[test]
    fn readings_with_different_outcomes_and_opinions_are_ambiguous() {
        let readings = |one: usize, other: usize| [found("a", 1).says(one).reading("as O"), found("b", 1).says(other).reading("as Θ")];
        assert_eq!(derive(&readings(1, 2)), Ok(ClaimVerdict::Ambiguous));
        assert_eq!(derive(&readings(1, 1)), Ok(ClaimVerdict::True));
        assert_eq!(derive(&readings(2, 2)), Ok(ClaimVerdict::False));
        assert_eq!(derive(&[found("a", 1).opinion("what is elegant")]), Ok(ClaimVerdict::Ambiguous));
        assert_eq!(derive(&[found("a", 1).opinion("what is elegant"), found("b", 1).says(2)]), Ok(ClaimVerdict::False));
    }

    #[test]
    fn context_alone_decides_nothing() {
        assert!(derive(&[found("a", 1).context()]).is_err());
        assert!(derive(&[]).is_err());
    }
}
