//! Names near a misspelt one.

/// The similarity of Jaro and Winkler, from 0 to 1, from which a name is near. The misspellings and abbreviations of the test below have
/// 0.89 and more, `colour` and `column` 0.84.
const NEAR: f64 = 0.85;

/// Names that are shown at most.
const SHOWN: usize = 3;

/// The candidates nearest to `name`, at most three, none that is far from it. A part of a candidate between hyphens and underscores counts as
/// much as the whole: `velocity` is near `free_velocity`.
/// ```
/// use moreau_contact::files::near;
///
/// assert_eq!(near("velocity", ["friction", "free_velocity"]), ["free_velocity"]);
/// assert!(near("colour", ["row", "column"]).is_empty());
/// ```
pub fn near<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let wanted = name.to_lowercase();
    let similarity = |candidate: &str| {
        let candidate = candidate.to_lowercase();
        let like = |text: &str| strsim::jaro_winkler(&wanted, text);
        // of two parts that are equally near the one of the nearer whole comes first
        (candidate.split(['-', '_']).map(like).fold(like(&candidate), f64::max), like(&candidate))
    };
    let mut ranked: Vec<((f64, f64), &str)> = candidates.into_iter().map(|candidate| (similarity(candidate), candidate)).collect();
    ranked.retain(|((best, _), _)| *best >= NEAR);
    ranked.sort_by(|a, b| b.0.0.total_cmp(&a.0.0).then(b.0.1.total_cmp(&a.0.1)).then(a.1.cmp(b.1)));
    ranked.dedup();
    ranked.into_iter().take(SHOWN).map(|(_, candidate)| candidate).collect()
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
        assert_eq!(near("ball", ["ball-drop", "two-ball-impact", "box-stack", "ball", "bouncing-ball", "ball"]).len(), 3);
        assert_eq!(near("ball", ["ball-drop", "ball", "ball"]), ["ball", "ball-drop"]);
    }
}
