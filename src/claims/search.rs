//! Claims by the words that they have.

use super::{Claim, PLACES, title};
use crate::checks::text::folded;

/// Whether a claim has all of these words, as a keyboard types them: in its id, its title, its statement, its correction, its
/// sources, or the words of the chapter that make it and the headings above them.
pub fn has_words(claim: &Claim, words: &str) -> bool {
    let (statement, correct) = (claim.statement(), claim.correct_statement());
    let mut text = vec![claim.id, title(claim.id), &statement, &correct];
    text.extend(claim.sources);
    text.extend(PLACES.of(claim.id).iter().flat_map(|place| [place.heading.as_str(), place.words.as_str()]));
    let text = folded(&text.join(" "));
    folded(words).split_whitespace().all(|word| text.contains(word))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::all;

    fn found(words: &str) -> Vec<&'static str> {
        all().filter(|claim| has_words(claim, words)).map(|claim| claim.id).collect()
    }

    #[test]
    fn words_are_looked_for_in_titles_and_sources_in_any_case_and_all_of_them_are_asked() {
        assert!(found("zeno").contains(&"S0.tinf") && found("ZENO").contains(&"S0.tinf"));
        assert!(found("stewart-trinkle").contains(&"S4.copos-plus") && found("Painleve") == found("Painlevé"));
        assert!(found("天然鲁棒").contains(&"M.zeno") && found("球早已静止") == ["S0.zeno-absorb"], "the words of the chapter");
        assert!(found("exercise stone").is_empty() && found("cottle pang").contains(&"S4.cps-thm"));
    }
}
