//! A control feeds another subject through the check: it changes no expectation, no tolerance and nothing that the sentence says.

use super::folder;
use super::strip::strip;
use std::path::{Path, PathBuf};

fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            rust_files(&path, files);
        } else if path.extension().is_some_and(|end| end == "rs") {
            files.push(path);
        }
    }
}

/// The arguments of the call whose opening parenthesis ends `before`, split at commas that stand in no bracket.
fn arguments(code: &str) -> Vec<&str> {
    let (mut depth, mut start, mut found) = (0usize, 0, Vec::new());
    for (at, letter) in code.char_indices() {
        match letter {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' if depth == 0 => {
                found.push(&code[start..at]);
                return found;
            }
            ')' | ']' | '}' => depth -= 1,
            ',' if depth == 0 => {
                found.push(&code[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    found
}

/// Arguments beside the measured one in which the reading stands.
fn changed_expectations(source: &str) -> Vec<String> {
    let code = strip(source);
    let reads = |argument: &&str| argument.contains("reading") || argument.contains("Reading::");
    let mut found = Vec::new();
    for call in ["equal", "at_most", "at_most_within", "at_least", "exact", "count", "decision"] {
        for (_, rest) in code.match_indices(&format!("Finding::{call}(")).map(|(at, name)| (at, &code[at + name.len()..])) {
            found.extend(arguments(rest).into_iter().skip(2).filter(reads).map(|argument| argument.trim().to_string()));
        }
    }
    for said in [".says(", ".says_at_most(", ".says_at_least("] {
        for (at, _) in code.match_indices(said) {
            found.extend(arguments(&code[at + said.len()..]).into_iter().filter(reads).map(|argument| argument.trim().to_string()));
        }
    }
    found
}

#[test]
fn no_control_changes_what_is_expected_or_said() {
    let mut files = Vec::new();
    rust_files(&folder("moreau").join("src/claims"), &mut files);
    assert!(files.len() > 100, "the claims are read");
    for file in files {
        let text = std::fs::read_to_string(&file).expect("readable");
        assert_eq!(changed_expectations(&text), Vec::<String>::new(), "{}", file.display());
    }
}

#[test]
fn a_changed_expectation_is_found() {
    let wrong = r#"Finding::exact("x", &measured, &reading.pick(a, b), "m")"#;
    assert_eq!(changed_expectations(wrong), ["&reading.pick(a, b)"]);
    assert_eq!(changed_expectations(r#"Finding::count("x", count(reading), 1).says(reading.pick(1, 2))"#), ["reading.pick(1, 2)"]);
    assert!(changed_expectations(r#"Finding::equal("x, reading", run(reading.pick(1, 2)), 1.0, bound(3), "m")"#).is_empty());
}
