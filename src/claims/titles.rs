//! A short title of every claim, for lists: `titles.toml`.

use crate::checks::formula::unicode;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Formulas in TeX between dollar signs.
static TEX: LazyLock<BTreeMap<String, String>> =
    LazyLock::new(|| toml::from_str(include_str!("titles.toml")).expect("a test reads the embedded file"));

static TITLES: LazyLock<BTreeMap<&str, String>> =
    LazyLock::new(|| TEX.iter().map(|(id, title)| (id.as_str(), unicode(title).expect("a test reads every title"))).collect());

/// The title of the claim with this id, its formulas in Unicode; empty where there is no such claim.
pub fn title(id: &str) -> &'static str {
    TITLES.get(id).map_or("", String::as_str)
}

/// The same with its formulas in TeX, for a page.
pub fn title_in_tex(id: &str) -> &'static str {
    TEX.get(id).map_or("", String::as_str)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::all;
    use std::collections::BTreeSet;

    /// Characters of a title, so that it stands beside id and verdict in 120 columns.
    const LONGEST: usize = 52;

    #[test]
    fn every_claim_has_a_short_title_of_its_own_and_no_other_id_has_one() {
        let ids: BTreeSet<&str> = all().map(|claim| claim.id).collect();
        assert_eq!(TITLES.keys().copied().collect::<BTreeSet<_>>(), ids);
        let long: Vec<_> =
            TITLES.values().filter(|title| !(4..=LONGEST).contains(&title.chars().count()) || title.ends_with('.')).collect();
        assert_eq!(long, Vec::<&String>::new());
        let mut seen = BTreeSet::new();
        let twice: Vec<_> = TITLES.values().filter(|title| !seen.insert(*title)).collect();
        assert_eq!(twice, Vec::<&String>::new());
    }

    #[test]
    fn what_is_no_claim_has_no_title() {
        assert_eq!((title("S4.example"), title_in_tex("S4.example")), ("", ""));
    }
}
