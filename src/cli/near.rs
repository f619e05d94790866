//! Names near a misspelt one.

/// The candidates nearest to `name` in edit distance, at most three, none that differs in more than half of its letters.
pub fn near<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let wanted = name.to_lowercase();
    let mut ranked: Vec<_> =
        candidates.into_iter().map(|candidate| (edit_distance(&wanted, &candidate.to_lowercase()), candidate)).collect();
    ranked.retain(|(distance, candidate)| 2 * distance <= candidate.chars().count().max(wanted.chars().count()));
    ranked.sort();
    ranked.dedup();
    ranked.into_iter().take(3).map(|(_, candidate)| candidate).collect()
}

/// `did you mean …?`, or the fallback where nothing is near.
pub fn suggestion<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>, fallback: &str) -> String {
    match near(name, candidates).as_slice() {
        [] => fallback.into(),
        near => format!("did you mean {}?", near.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(" or ")),
    }
}

/// Levenshtein distance: insertions, deletions and replacements that turn one word into the other.
fn edit_distance(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (i, letter) in from.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, other) in to.iter().enumerate() {
            let replaced = diagonal + usize::from(letter != *other);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[to.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edit_distance_of_textbook_pairs() {
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("same", "same"), 0);
    }

    #[test]
    fn a_misspelt_id_finds_its_neighbour_and_nonsense_finds_nothing() {
        let ids = ["S4.copos", "S4.copos-plus", "S12.step"];
        assert_eq!(near("s4.coposplus", ids)[0], "S4.copos-plus");
        assert!(near("xyzzyxyzzy", ids).is_empty());
        assert_eq!(suggestion("xyzzyxyzzy", ids, "see the list"), "see the list");
    }
}
