//! What holds instead of a sentence, under a label that says whether anything is to be corrected.

use super::axes::Verdict;
use super::data::ClaimEntry;
use crate::words::Words;

const READS: Words = Words { en: "How it should read", zh: "应当表述为" };
const PRECISELY: Words = Words { en: "More precisely", zh: "更确切的表述" };
const HOLDS: Words = Words { en: "What holds", zh: "成立的表述" };
/// The label of what holds as it is.
pub const AS_STATED: Words = Words { en: "Holds as stated", zh: "如文所述，成立" };
/// How a correction begins that says no more than the sentence does.
const SAME: &str = "As stated";

/// What stands before the correction of a claim.
pub fn label(claim: &ClaimEntry) -> Words {
    match claim.verdict {
        Verdict::True if claim.correct.starts_with(SAME) => AS_STATED,
        Verdict::True => PRECISELY,
        Verdict::Ambiguous => HOLDS,
        Verdict::Conditional | Verdict::False | Verdict::Inconsistent => READS,
    }
}

/// What a correction says after “As stated”; of another one all.
pub fn beyond(correct: &str) -> &str {
    correct.strip_prefix(SAME).map_or(correct, |rest| rest.trim_start_matches([',', ';', ':', '.', ' ']))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_holds_as_stated_is_not_said_twice() {
        assert_eq!(beyond("Not so."), "Not so.");
        assert_eq!(beyond("As stated."), "");
        assert_eq!(beyond("As stated: $x$ is so."), "$x$ is so.");
        assert_eq!(beyond("As stated for small steps."), "for small steps.");
    }
}
