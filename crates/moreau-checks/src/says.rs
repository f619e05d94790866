//! How a finding is told what the sentence says of its instance, and whether it supports the sentence.

use crate::bearing::{FindingOrigin, Stated, Value, Voice};
use crate::expectation::Expectation;
use crate::finding::Finding;
use crate::relation::Relation;

impl Finding {
    /// The sentence says that the found number is this one, or that the decision comes out so.
    pub fn says(self, value: impl Into<Value>) -> Self {
        self.stating(Relation::Equal, value.into())
    }

    /// The sentence says that the found number is at most this one.
    pub fn says_at_most(self, value: impl Into<Value>) -> Self {
        self.stating(Relation::AtMost, value.into())
    }

    /// The sentence says that the found number is at least this one.
    pub fn says_at_least(self, value: impl Into<Value>) -> Self {
        self.stating(Relation::AtLeast, value.into())
    }

    fn stating(mut self, relation: Relation, value: Value) -> Self {
        self.bearing.stated = Some(Stated { relation, value });
        self
    }

    /// Whether what was found is held against fractions or decisions alone: what is expected and what the sentence says.
    pub fn is_held_exactly(&self) -> bool {
        let rounded = |stated: &Stated| matches!(stated.value, Value::Rounded(_));
        self.exact.is_some() && !self.bearing.stated.as_ref().is_some_and(rounded)
    }

    /// In this instance the condition that the sentence omits is violated.
    pub fn violating(mut self, condition: &'static str) -> Self {
        self.bearing.violated = Some(condition);
        self
    }

    /// What is stated is stated by this passage; another passage speaks of the same instance, under the same name.
    pub fn passage(mut self, passage: &'static str) -> Self {
        self.bearing.voice = Voice::Passage(passage);
        self
    }

    /// What is stated is stated in this reading of the sentence.
    pub fn reading(mut self, reading: &'static str) -> Self {
        self.bearing.voice = Voice::Reading(reading);
        self
    }

    /// The sentence is an opinion on this point.
    pub fn opinion(mut self, point: &'static str) -> Self {
        self.bearing.voice = Voice::Opinion(point);
        self
    }

    /// The finding is told beside the sentence and decides nothing.
    pub fn context(mut self) -> Self {
        self.bearing.context = true;
        self
    }

    /// The found number is the outcome of an experiment.
    pub fn experiment(mut self) -> Self {
        self.bearing.origin = FindingOrigin::Experiment;
        self
    }

    /// The found number was looked up.
    pub fn looked_up(mut self) -> Self {
        self.bearing.origin = FindingOrigin::LookUp;
        self
    }

    /// Whether what was found agrees with what the sentence says.
    pub fn supports(&self) -> bool {
        let Some(Stated { relation, value }) = &self.bearing.stated else { return self.holds() };
        match (value, &self.rational) {
            (Value::Exact(stated), Some(found)) => match relation {
                Relation::Equal => found == stated,
                Relation::AtMost => found <= stated,
                Relation::AtLeast => found >= stated,
            },
            _ => Expectation { value: value.rounded(), relation: *relation, ..self.expectation.clone() }.holds(self.measured),
        }
    }

    /// What the sentence says, in short.
    pub fn stated(&self) -> String {
        let Some(Stated { relation, value }) = &self.bearing.stated else {
            return match &self.exact {
                Some([_, expected]) => expected.clone(),
                None if self.expectation.relation == Relation::Equal => self.expectation.value.to_string(),
                None => format!("{} {}", self.expectation.relation.sign(), self.expectation.value),
            };
        };
        let sign = if *relation == Relation::Equal { String::new() } else { format!("{} ", relation.sign()) };
        match value {
            Value::Exact(number) if self.is_decision() => format!("{sign}{}", !number.is_zero()),
            Value::Exact(number) => format!("{sign}{number}"),
            Value::Rounded(number) => format!("{sign}{number}"),
        }
    }

    /// The finding with what another one found in place of what it found: held against what this one expects and states.
    #[must_use]
    pub fn with_measured(&self, other: &Finding) -> Self {
        let mut finding = self.clone();
        (finding.measured, finding.rational) = (other.measured, other.rational.clone());
        finding.exact = self.exact.as_ref().zip(other.exact.as_ref()).map(|([_, expected], [found, _])| [found.clone(), expected.clone()]);
        finding.judged_again()
    }

    /// The finding with what the sentence says in place of what was found.
    #[must_use]
    pub fn as_stated(&self) -> Self {
        let mut finding = self.clone();
        match &self.bearing.stated {
            Some(Stated { value, .. }) => {
                finding.measured = value.rounded();
                finding.rational = self.rational.as_ref().and(match value {
                    Value::Exact(number) => Some(number.clone()),
                    Value::Rounded(_) => None,
                });
            }
            None => {
                finding.measured = self.expectation.value;
                finding.exact = self.exact.as_ref().map(|[_, expected]| [expected.clone(), expected.clone()]);
            }
        }
        finding.judged_again()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::ratio;

    #[test]
    fn another_number_is_held_against_what_was_expected_and_stated() {
        let recorded = Finding::count("k", 3, 3).says_at_most(4usize);
        let held = |found: usize| recorded.with_measured(&Finding::count("k", found, found).says(0usize));
        assert!(held(3).holds() && held(3).supports());
        assert!(!held(4).holds() && held(4).supports());
        assert!(!held(5).holds() && !held(5).supports());
        let rounded = Finding::equal("x", 1.0, 1.0, 0.5, "m").with_measured(&Finding::equal("x", 2.0, 2.0, 0.5, "m"));
        assert!(!rounded.holds() && rounded.measured == 2.0);
        let third = ratio(1, 3);
        let close = ratio(1, 3) + ratio(1, 1_000_000_000_000_000_000);
        let exact = Finding::exact("y", &third, &third, "1").with_measured(&Finding::exact("y", &close, &close, "1"));
        assert!(!exact.holds(), "below the spacing of floats");
    }

    #[test]
    fn without_a_word_the_sentence_says_what_is_expected() {
        assert!(Finding::count("k", 3, 3).supports());
        assert!(!Finding::count("k", 4, 3).supports());
    }

    #[test]
    fn what_the_sentence_says_is_held_against_what_was_found() {
        let found = Finding::decision("unique", false, false);
        assert!(found.holds() && !found.clone().says(true).supports() && found.says(false).supports());
        let number = Finding::equal("x", 1.25, 1.0, 0.5, "m");
        assert!(number.clone().says(1.75).supports() && !number.clone().says(1.8).supports());
        assert!(number.clone().says_at_most(0.75).supports() && !number.clone().says_at_most(0.7).supports());
        assert!(number.clone().says_at_least(1.75).supports() && !number.says_at_least(1.8).supports());
    }

    #[test]
    fn rationals_are_held_exactly_against_rationals() {
        let tiny = ratio(1, 1_000_000_000_000_000_000) / ratio(1_000_000_000, 1);
        let found = Finding::exact("x", &(ratio(1, 1) + &tiny), &(ratio(1, 1) + tiny), "1");
        assert!(found.holds() && !found.clone().says(ratio(1, 1)).supports());
        assert!(found.says_at_least(ratio(1, 1)).supports());
    }

    #[test]
    fn nan_supports_nothing() {
        assert!(!Finding::equal("x", f64::NAN, 1.0, 1.0, "m").says(1.0).supports());
        assert!(!Finding::equal("x", 1.0, 1.0, 1.0, "m").says(f64::NAN).supports());
    }

    #[test]
    fn with_found_as_stated_every_finding_supports() {
        let findings = [
            Finding::decision("a", false, false).says(true),
            Finding::exact("b", &ratio(1, 2), &ratio(1, 2), "m").says(ratio(2, 3)),
            Finding::equal("c", 1.0, 1.0, 0.1, "m").says_at_most(0.5),
            Finding::count("d", 7, 2),
        ];
        for finding in findings {
            assert!(!finding.supports() && finding.as_stated().supports(), "{finding}");
        }
    }

    #[test]
    fn what_is_stated_reads_as_the_sentence_says_it() {
        assert_eq!(Finding::decision("a", false, false).says(true).stated(), "true");
        assert_eq!(Finding::exact("b", &ratio(1, 2), &ratio(1, 2), "m").says_at_most(ratio(2, 3)).stated(), "≤ 2/3");
        assert_eq!(Finding::count("d", 2, 2).stated(), "2");
    }
}
