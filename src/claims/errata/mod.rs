//! The errata in Chinese, for the authors and readers of the chapter: `errata.zh.toml`, an entry for every claim that does
//! not hold as printed.

use super::PLACES;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// What is wrong with one sentence of the chapter, in Chinese; formulas in TeX between `$`.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Erratum {
    /// What the chapter says.
    pub says: String,
    /// What is wrong with it and why, with the numbers of the counterexample.
    pub wrong: String,
    /// How it should read.
    pub correct: String,
}

#[derive(Deserialize)]
struct Errata {
    sections: BTreeMap<String, String>,
    #[serde(flatten)]
    entries: BTreeMap<String, Erratum>,
}

static ERRATA: LazyLock<Errata> =
    LazyLock::new(|| toml::from_str(include_str!("../errata.zh.toml")).expect("a test reads the embedded file"));

/// The erratum of the claim with this id; none where the claim is true or ambiguous.
pub fn chinese(id: &str) -> Option<&'static Erratum> {
    ERRATA.entries.get(id)
}

/// The Chinese title of a section, by the group that its claim ids start with: of §0 to §12 the chapter's own heading.
pub fn chinese_section(group: &str) -> Option<&'static str> {
    let number = group.strip_prefix('S').unwrap_or(group);
    let heading = PLACES.headings.iter().find(|heading| heading.section.strip_prefix('§') == Some(number));
    let own = heading.map(|heading| heading.title.trim_end_matches('⭐').trim_end());
    own.or_else(|| ERRATA.sections.get(group).map(String::as_str))
}

#[cfg(test)]
mod tests;
