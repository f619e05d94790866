//! Which claims a run of `moreau verify` is about: a group, a section, a verdict, a severity, a kind.

use super::near::suggestion;
use crate::claims::{self, Claim, ClaimVerdict, Kind, Severity, matches_group};
use crate::{Error, Result};
use clap::ValueEnum;

/// Options that choose claims; a claim has to meet all that are given.
#[derive(clap::Args)]
pub struct Filters {
    /// Only this group or claim; groups are whole parts of the id, so S1 is not S12, and R is R1 to R8.
    #[arg(long, value_name = "GROUP")]
    filter: Option<String>,
    /// Only this section of the chapter, by its number.
    #[arg(long, value_name = "NUMBER", conflicts_with = "filter")]
    section: Option<usize>,
    /// Only claims with this verdict.
    #[arg(long, value_enum, value_name = "VERDICT")]
    verdict: Option<VerdictName>,
    /// Only claims in which this is wrong.
    #[arg(long, value_enum, value_name = "SEVERITY")]
    severity: Option<SeverityName>,
    /// Only sentences of this kind.
    #[arg(long, value_enum, value_name = "KIND")]
    kind: Option<KindName>,
}

#[derive(Clone, Copy, ValueEnum)]
enum VerdictName {
    True,
    Conditional,
    False,
    Inconsistent,
    Ambiguous,
}

#[derive(Clone, Copy, ValueEnum)]
enum SeverityName {
    /// A slip that a reader corrects at sight.
    Misprint,
    /// What is said holds for another reason.
    Reason,
    /// It holds under a condition that is not printed.
    Hypothesis,
    /// It does not hold.
    Statement,
    /// It is offered or used as a theorem and does not hold.
    Theorem,
}

#[derive(Clone, Copy, ValueEnum)]
enum KindName {
    Assertion,
    Exercise,
    Definition,
    Citation,
    Path,
    Advice,
    Opinion,
}

impl From<VerdictName> for ClaimVerdict {
    fn from(name: VerdictName) -> Self {
        match name {
            VerdictName::True => ClaimVerdict::True,
            VerdictName::Conditional => ClaimVerdict::Conditional,
            VerdictName::False => ClaimVerdict::False,
            VerdictName::Inconsistent => ClaimVerdict::Inconsistent,
            VerdictName::Ambiguous => ClaimVerdict::Ambiguous,
        }
    }
}

impl From<SeverityName> for Severity {
    fn from(name: SeverityName) -> Self {
        match name {
            SeverityName::Misprint => Severity::Misprint,
            SeverityName::Reason => Severity::WrongReason,
            SeverityName::Hypothesis => Severity::MissingHypothesis,
            SeverityName::Statement => Severity::WrongStatement,
            SeverityName::Theorem => Severity::BrokenTheorem,
        }
    }
}

impl From<KindName> for Kind {
    fn from(name: KindName) -> Self {
        match name {
            KindName::Assertion => Kind::Assertion,
            KindName::Exercise => Kind::Exercise,
            KindName::Definition => Kind::Definition,
            KindName::Citation => Kind::Citation,
            KindName::Path => Kind::Path,
            KindName::Advice => Kind::Advice,
            KindName::Opinion => Kind::Opinion,
        }
    }
}

impl Filters {
    /// The claims that meet all filters, in the registry's order.
    ///
    /// # Errors
    /// An unknown group, with the nearest known one, and filters that leave no claim.
    pub fn select(&self) -> Result<Vec<&'static Claim>> {
        let group = self.filter.clone().or_else(|| self.section.map(|number| format!("S{number}")));
        let in_group: Vec<_> = claims::all().filter(|claim| group.as_ref().is_none_or(|group| matches_group(claim.id, group))).collect();
        if let (Some(group), true) = (&group, in_group.is_empty()) {
            let names = claims::all().flat_map(|claim| [claim.section(), claim.id]);
            let cure = suggestion(group, names, "`moreau verify --list` shows every id");
            let option =
                if self.filter.is_some() { format!("--filter {group}") } else { format!("--section {}", group.trim_start_matches('S')) };
            return Err(Error::Unsupported(format!("{option}: no claim in this group; {cure}")));
        }
        let chosen: Vec<_> = in_group.into_iter().filter(|claim| self.is_met(claim)).collect();
        if chosen.is_empty() {
            return Err(Error::Unsupported("no claim meets all of the filters; leave one out".into()));
        }
        Ok(chosen)
    }

    fn is_met(&self, claim: &Claim) -> bool {
        self.verdict.is_none_or(|name| claim.verdict == name.into())
            && self.severity.is_none_or(|name| claim.severity == Some(name.into()))
            && self.kind.is_none_or(|name| claim.kind == name.into())
    }
}
