//! Counts by law, kind of answer and verdict, and the list of mistakes.

use crate::family::Member;
use std::collections::BTreeMap;

/// What came of one answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// A solution by the rule, and accepted.
    Accepted,
    /// A near miss by the rule, and refused.
    Refused,
    /// Between half and twice the limit, or on a branch that rounding decides: either verdict is right.
    Between,
    /// No change of this kind comes to the residual that was aimed at.
    OutOfReach,
    /// A near miss that was accepted.
    WronglyAccepted,
    /// A solution that was refused.
    WronglyRefused,
}

const VERDICTS: [Verdict; 6] =
    [Verdict::Accepted, Verdict::Refused, Verdict::Between, Verdict::OutOfReach, Verdict::WronglyAccepted, Verdict::WronglyRefused];

#[derive(Clone, Debug, Default)]
pub struct Tally {
    counts: BTreeMap<(String, String, Verdict), usize>,
    /// Answers put to a planted rule, and those on which it errs.
    planted: BTreeMap<&'static str, [usize; 2]>,
    pub mistakes: Vec<String>,
}

impl Tally {
    pub fn add(&mut self, member: &Member, kind: &str, place: &str, verdict: Verdict) {
        *self.counts.entry((member.spec.law.name().into(), format!("{kind} {place}"), verdict)).or_default() += 1;
    }

    pub fn plant(&mut self, rule: &'static str, errs: bool) {
        let [asked, wrong] = self.planted.entry(rule).or_default();
        *asked += 1;
        *wrong += usize::from(errs);
    }

    /// (asked, wrong) of a planted rule.
    pub fn planted(&self, rule: &str) -> [usize; 2] {
        self.planted.get(rule).copied().unwrap_or_default()
    }

    pub fn mistake(&mut self, text: String) {
        self.mistakes.push(text);
    }

    pub fn merge(mut self, other: Tally) -> Tally {
        other.counts.into_iter().for_each(|(key, count)| *self.counts.entry(key).or_default() += count);
        for (rule, [asked, wrong]) in other.planted {
            let sum = self.planted.entry(rule).or_default();
            *sum = [sum[0] + asked, sum[1] + wrong];
        }
        self.mistakes.extend(other.mistakes);
        self
    }

    /// The number of answers whose law, kind and verdict pass.
    pub fn count(&self, passes: impl Fn(&str, &str, Verdict) -> bool) -> usize {
        self.counts.iter().filter(|((law, kind, verdict), _)| passes(law, kind, *verdict)).map(|(_, count)| count).sum()
    }

    /// A table: one row per law or kind, one column per verdict.
    pub fn table(&self) -> String {
        let mut rows: Vec<(bool, String)> = Vec::new();
        for (law, kind, _) in self.counts.keys() {
            rows.extend([(false, law.clone()), (true, kind.clone())]);
        }
        rows.sort();
        rows.dedup();
        let heads: String = VERDICTS.iter().map(|verdict| format!("{:>17}", format!("{verdict:?}"))).collect();
        let mut table = format!("{:<32}{heads}\n", "");
        for (by_kind, name) in rows {
            let cells: String = VERDICTS
                .iter()
                .map(|&verdict| format!("{:>17}", self.count(|law, kind, v| v == verdict && name == if by_kind { kind } else { law })))
                .collect();
            table += &format!("{name:<32}{cells}\n");
        }
        for (rule, [asked, wrong]) in &self.planted {
            table += &format!("planted: {rule}: errs on {wrong} of {asked}\n");
        }
        table
    }
}
