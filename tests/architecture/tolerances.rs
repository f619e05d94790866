//! Every number in a tolerance module says in the last line of its documentation what kind of number it is.

use std::path::Path;

/// The words, and what follows the last three.
const WORDS: [&str; 4] = ["Derived", "Set", "Required", "Measured"];

/// What is wrong with the public constants and functions of a file: no word, two of them, a promise without whose it is, a measurement
/// without a script that exists below `root`.
pub fn complaints(text: &str, root: &Path) -> Vec<String> {
    let mut complaints = Vec::new();
    let mut documentation: Vec<&str> = Vec::new();
    let code = text.split("#[cfg(test)]").next().unwrap_or(text);
    for line in code.lines().map(str::trim) {
        if let Some(said) = line.strip_prefix("///") {
            documentation.push(said.trim());
        } else if !line.starts_with("#[") {
            let item = ["pub const fn ", "pub const ", "pub fn "].iter().find_map(|start| line.strip_prefix(start));
            let name = item.map(|rest| rest.split(|letter: char| !letter.is_alphanumeric() && letter != '_').next().unwrap_or(rest));
            complaints.extend(name.and_then(|name| Some(format!("{name}: {}", complaint(&documentation, root)?))));
            documentation.clear();
        }
    }
    complaints
}

fn complaint(documentation: &[&str], root: &Path) -> Option<String> {
    let told = |line: &&&str| WORDS.iter().any(|word| line.strip_prefix(word).is_some_and(|rest| rest.starts_with(['.', ':'])));
    let words: Vec<_> = documentation.iter().filter(told).collect();
    let [word] = words[..] else { return Some(format!("has {} of the words {WORDS:?}, not one", words.len())) };
    let (kind, reason) = word.split_once([':', '.']).unwrap_or((word, ""));
    match kind {
        _ if documentation.last() != Some(word) => Some(format!("“{word}” is not the last line")),
        "Required" if !(reason.contains(" of ") && reason.contains(" by ")) => {
            Some("does not say of what and by whom it is required".into())
        }
        "Measured" => {
            let script = reason.split([' ', ',']).find(|part| part.starts_with("scripts/"));
            let exists = script.is_some_and(|path| root.join(path.trim_end_matches('.')).is_file());
            (!exists).then(|| "names no script that exists".into())
        }
        "Derived" | "Set" if !reason.is_empty() => Some(format!("says more than “{kind}.”; the derivation stands before it")),
        _ => None,
    }
}

#[test]
fn what_has_no_word_or_a_hollow_one_is_told() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let of = |documentation: &str| complaints(&format!("{documentation}\npub const X: f64 = 1.0;"), root);
    for fine in [
        "/// A bound.\n/// Derived.",
        "/// A step.\n/// Set.",
        "/// A promise.\n/// Required: of an engine, by the gate.",
        "/// A spread.\n/// Measured: scripts/measure_references.py, 4e-5.",
    ] {
        assert_eq!(of(fine), Vec::<String>::new(), "{fine}");
    }
    for hollow in [
        "/// A bound.",
        "/// Derived.\n/// A bound.",
        "/// A bound.\n/// Set.\n/// Derived.",
        "/// A promise.\n/// Required.",
        "/// A spread.\n/// Measured: scripts/none.py.",
        "/// A spread.\n/// Measured: by hand.",
    ] {
        assert_eq!(of(hollow).len(), 1, "{hollow}");
    }
}
