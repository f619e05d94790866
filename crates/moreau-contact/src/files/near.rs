//! Names near a misspelt one.

/// The similarity of Jaro and Winkler, from 0 to 1, from which a name is near. The misspellings and abbreviations of the test below have
/// 0.825 and more, words that share nothing but their kind less than 0.7.
const NEAR: f64 = 0.82;

/// What the similarity to a part of a name counts in place of that to the whole.
const PART: f64 = 0.9;

/// Names that are less similar than the nearest one by more than this are not meant.
const BESIDE: f64 = 0.05;

/// Names that are shown at most.
const SHOWN: usize = 3;

/// The candidates nearest to `name`, at most three, none that is far from it. Parts of a candidate between hyphens and underscores count,
/// too: `velocity` is near `free_velocity`.
/// ```
/// use moreau_contact::files::near;
///
/// assert_eq!(near("velocity", ["friction", "free_velocity"]), ["free_velocity"]);
/// assert!(near("matrix", ["mass", "friction"]).is_empty());
/// ```
pub fn near<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let wanted = name.to_lowercase();
    let similarity = |candidate: &str| {
        let candidate = candidate.to_lowercase();
        let parts = candidate.split(['-', '_']).map(|part| PART * strsim::jaro_winkler(&wanted, part));
        parts.fold(strsim::jaro_winkler(&wanted, &candidate), f64::max)
    };
    let mut ranked: Vec<(f64, &str)> = candidates.into_iter().map(|candidate| (similarity(candidate), candidate)).collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    ranked.dedup();
    let least = ranked.first().map_or(NEAR, |(best, _)| NEAR.max(best - BESIDE));
    ranked.into_iter().take_while(|(similarity, _)| *similarity >= least).take(SHOWN).map(|(_, candidate)| candidate).collect()
}

/// `did you mean `a` or `b`?`; nothing where nothing is near.
pub fn did_you_mean<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let names: Vec<String> = near(name, candidates).iter().map(|name| format!("`{name}`")).collect();
    (!names.is_empty()).then(|| format!("did you mean {}?", names.join(" or ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn misspelt_and_shortened_names_find_their_neighbours_and_nonsense_finds_nothing() {
        let names = [
            ("bounce", "bouncing-ball"),
            ("velocity", "free_velocity"),
            ("freevelocity", "free_velocity"),
            ("s4.coposplus", "S4.copos-plus"),
            ("lemk", "lemke"),
            ("psgs", "pgs"),
            ("dim", "dimension"),
            ("Interior_Point", "interior-point"),
            ("mas", "mass"),
            ("ravity", "gravity"),
            ("moreau", "moreau-jean"),
            ("positon", "position"),
            ("secnd", "second"),
        ];
        let all: Vec<&str> = names.iter().map(|(_, name)| *name).collect();
        for (wrong, right) in names {
            assert_eq!(near(wrong, all.iter().copied()).first(), Some(&right), "{wrong}");
            assert!(did_you_mean(wrong, all.iter().copied()).is_some_and(|said| said.starts_with(&format!("did you mean `{right}`"))));
        }
        for far in ["xyzzyxyzzy", "third", "q", ""] {
            assert_eq!(did_you_mean(far, all.iter().copied()), None, "{far}");
        }
        assert_eq!(near("ball", ["ball-drop", "two-ball-impact", "box-stack", "bouncing-ball", "elastic-ball"]).len(), SHOWN);
        assert_eq!(near("ball", ["ball-drop", "ball", "ball"]), ["ball"]);
        assert_eq!(near("row", ["shape", "rows", "sparse_rows"]), ["rows"]);
    }
}
