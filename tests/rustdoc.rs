//! Runnable examples in the documentation of every crate: counted here, run by `cargo test` as documentation tests.

use std::path::{Path, PathBuf};

/// The crates, each with the least number of examples that `cargo test` runs and that assert something.
const LEAST: [(&str, usize); 8] = [
    ("moreau-exact", 10),
    ("moreau-forms", 20),
    ("moreau-contact", 40),
    ("moreau-dynamics", 15),
    ("moreau-checks", 6),
    ("moreau-replicas", 6),
    ("moreau-gate", 8),
    ("moreau", 8),
];

/// The folder of sources of a crate, in a checkout or beside the unpacked archive of the top one.
fn sources(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = match name {
        "moreau" => root.to_path_buf(),
        _ if root.join("crates").exists() => root.join("crates").join(name),
        _ => root.join("..").join(format!("{name}-{}", env!("CARGO_PKG_VERSION"))),
    };
    folder.join("src")
}

fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            rust_files(&path, files);
        } else if path.extension().is_some_and(|end| end == "rs") {
            files.push(path);
        }
    }
}

/// The examples of a file that are run and assert something.
fn examples(source: &str) -> usize {
    let (mut count, mut block): (usize, Option<(bool, bool)>) = (0, None);
    for line in source.lines() {
        let Some(text) = line.trim_start().strip_prefix("///").or_else(|| line.trim_start().strip_prefix("//!")) else { continue };
        let text = text.trim();
        match (text.strip_prefix("```"), &mut block) {
            (Some(language), None) => block = Some((["", "rust"].contains(&language), false)),
            (Some(_), Some((runs, asserts))) => {
                count += usize::from(*runs && *asserts);
                block = None;
            }
            (None, Some((_, asserts))) => *asserts |= text.contains("assert"),
            (None, None) => {}
        }
    }
    count
}

fn of_crate(name: &str) -> usize {
    let mut files = Vec::new();
    rust_files(&sources(name), &mut files);
    files.iter().map(|file| examples(&std::fs::read_to_string(file).expect("UTF-8"))).sum()
}

#[test]
fn every_crate_shows_its_entry_points_in_examples_that_are_run() {
    let counts = LEAST.map(|(name, least)| (name, of_crate(name), least));
    let few: Vec<_> = counts.iter().filter(|(_, count, least)| count < least).collect();
    assert!(few.is_empty(), "(crate, examples, least): {few:?}");
    assert!(counts.iter().map(|(_, count, _)| count).sum::<usize>() >= 60);
}

#[test]
fn what_is_not_run_or_asserts_nothing_is_not_counted() {
    let one = "/// ```\n/// assert!(sum(1, 1) == 2);\n/// ```\n";
    assert_eq!(examples(one), 1);
    for other in
        [one.replacen("```", "```text", 1), one.replacen("```", "```no_run", 1), one.replace("assert!", "drop"), one.replace("///", "//")]
    {
        assert_eq!(examples(&other), 0, "{other}");
    }
    assert_eq!(examples(&format!("{one}\n//! ```text\n//! assert\n//! ```\n{one}")), 2);
}
