//! Which claims a run of `moreau verify` is about: a group, a section, a verdict, a severity, a kind.

use super::near::suggestion;
use crate::claims::{self, Claim, ClaimVerdict, Kind, Severity, matches_group};
use crate::report::witnesses::Selection;
use crate::{Error, Result};
use clap::builder::{PossibleValuesParser, TypedValueParser};

/// Options that choose claims; a claim has to meet all that are given.
#[derive(clap::Args)]
pub struct Filters {
    /// Only this group or claim; groups are whole parts of the id, so S1 is not S12, and R is R1 to R8.
    #[arg(long, value_name = "GROUP")]
    filter: Option<String>,
    /// Only this section of the chapter, by its number, 0 to 12; what stands before and after the sections is in the groups P, M, T, R, Pr
    /// and V, which --filter takes.
    #[arg(long, value_name = "NUMBER", value_parser = section_number, conflicts_with = "filter", allow_negative_numbers = true)]
    section: Option<usize>,
    /// Only claims that have all of these words in id, title, statement, correction or source, in any case; part of a word will do.
    #[arg(long, value_name = "WORDS", conflicts_with = "export")]
    search: Option<String>,
    /// Only claims with this verdict.
    #[arg(long, value_parser = one_of(VERDICTS), value_name = "VERDICT")]
    verdict: Option<ClaimVerdict>,
    /// Only claims in which this is wrong.
    #[arg(long, value_parser = one_of(SEVERITIES), value_name = "SEVERITY")]
    severity: Option<Severity>,
    /// Only sentences of this kind.
    #[arg(long, value_parser = one_of(KINDS), value_name = "KIND")]
    kind: Option<Kind>,
}

const VERDICTS: [(&str, ClaimVerdict); 5] = [
    ("true", ClaimVerdict::True),
    ("conditional", ClaimVerdict::Conditional),
    ("false", ClaimVerdict::False),
    ("inconsistent", ClaimVerdict::Inconsistent),
    ("ambiguous", ClaimVerdict::Ambiguous),
];

const SEVERITIES: [(&str, Severity); 5] = [
    ("misprint", Severity::Misprint),
    ("reason", Severity::WrongReason),
    ("hypothesis", Severity::MissingHypothesis),
    ("statement", Severity::WrongStatement),
    ("theorem", Severity::BrokenTheorem),
];

const KINDS: [(&str, Kind); 7] = [
    ("assertion", Kind::Assertion),
    ("exercise", Kind::Exercise),
    ("definition", Kind::Definition),
    ("citation", Kind::Citation),
    ("path", Kind::Path),
    ("advice", Kind::Advice),
    ("opinion", Kind::Opinion),
];

/// One of these names, read as what stands beside it.
fn one_of<T: Copy + Send + Sync + 'static, const N: usize>(table: [(&'static str, T); N]) -> impl TypedValueParser<Value = T> {
    let named = move |name: String| table.iter().find(|(known, _)| *known == name).map(|(_, value)| *value).ok_or("an unknown name");
    PossibleValuesParser::new(table.map(|(name, _)| name)).try_map(named)
}

/// The number of a section, with or without the S of its claims.
fn section_number(text: &str) -> std::result::Result<usize, &'static str> {
    text.trim_start_matches(['S', 's', '§']).parse().map_err(|_| "give the number of a section, 0 to 12")
}

impl Filters {
    /// The claims that meet all filters, in the registry's order.
    ///
    /// # Errors
    /// An unknown group, with the nearest known one, and filters that leave no claim.
    pub fn select(&self) -> Result<Vec<&'static Claim>> {
        let group = self.group();
        let in_group: Vec<_> = claims::all().filter(|claim| group.as_ref().is_none_or(|group| matches_group(claim.id, group))).collect();
        if let (Some(group), true) = (&group, in_group.is_empty()) {
            let names = claims::all().flat_map(|claim| [claim.section(), claim.id]);
            let cure = suggestion(group, names, "`moreau verify --list` shows every id");
            return Err(Error::Unsupported(match self.section {
                Some(number) => format!("--section {number}: there is no such section; give a number from 0 to 12"),
                None => format!("--filter {group}: no claim in this group; {cure}"),
            }));
        }
        if self.search.as_ref().is_some_and(|words| words.trim().is_empty()) {
            return Err(Error::Unsupported("--search: has no word; give one, or leave it out".into()));
        }
        let chosen: Vec<_> = in_group.into_iter().filter(|claim| self.is_met(claim)).collect();
        if let (true, Some(words)) = (chosen.is_empty(), &self.search) {
            let statements: Vec<String> = claims::all().map(Claim::statement).collect();
            let all = statements.iter().flat_map(|statement| statement.split(|letter: char| !letter.is_alphanumeric()));
            let cure = suggestion(words, all, "try a part of a word, or fewer words");
            return Err(Error::Unsupported(format!("--search {words}: no claim has these words; {cure}")));
        }
        if chosen.is_empty() {
            return Err(Error::Unsupported("no claim meets all of the filters; leave one out".into()));
        }
        Ok(chosen)
    }

    /// What was asked for, for a document that holds a part; `None` if everything was.
    pub fn selection(&self) -> Option<Selection> {
        let Filters { verdict, severity, kind, .. } = *self;
        let selection = Selection { group: self.group(), verdict, severity, kind };
        (selection != Selection::default()).then_some(selection)
    }

    fn group(&self) -> Option<String> {
        self.filter.clone().or_else(|| self.section.map(|number| format!("S{number}")))
    }

    fn is_met(&self, claim: &Claim) -> bool {
        self.verdict.is_none_or(|verdict| claim.verdict == verdict)
            && self.severity.is_none_or(|severity| claim.severity == Some(severity))
            && self.kind.is_none_or(|kind| claim.kind == kind)
            && self.search.as_ref().is_none_or(|words| claims::has_words(claim, words))
    }
}
