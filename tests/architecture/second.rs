//! A second derivation shares no line with what it checks.

use super::folder;
use super::strip::strip;
use std::collections::BTreeSet;

/// Code lines that say something: no imports, no names of cases, and long enough not to be the same by chance.
fn lines(code: &str) -> BTreeSet<String> {
    const SPEAKING: usize = 40;
    let lines = strip(code).lines().map(|line| line.trim().to_string()).collect::<Vec<_>>();
    let says = |line: &String| !line.starts_with("use ") && !line.starts_with("fn ") && !line.ends_with("=> {");
    lines.into_iter().filter(|line| line.len() >= SPEAKING && says(line)).collect()
}

fn shared(one: &str, other: &str) -> Vec<String> {
    lines(one).intersection(&lines(other)).cloned().collect()
}

/// The pairs of ARCHITECTURE.md: a derivation, and a file that it checks.
fn pairs() -> Vec<(String, String)> {
    let text = include_str!("../../ARCHITECTURE.md");
    let (_, rest) = text.split_once("## Second derivations").expect("the section");
    let rows = rest.split("\n## ").next().unwrap_or("").lines().filter(|line| line.starts_with("| `"));
    let named = |cell: &str| cell.split('`').skip(1).step_by(2).map(String::from).collect::<Vec<_>>();
    let pairs = rows.flat_map(|row| {
        let cells: Vec<_> = row.split('|').collect();
        let [second, first] = [named(cells[1]), named(cells[2])];
        first.into_iter().map(move |checked| (second[0].clone(), checked))
    });
    pairs.collect()
}

#[test]
fn a_second_derivation_shares_no_line_with_what_it_checks() {
    let read = |path: &str| {
        std::fs::read_to_string(folder("moreau").join(path)).unwrap_or_else(|error| panic!("ARCHITECTURE.md names {path}: {error}"))
    };
    let pairs = pairs();
    assert!(pairs.len() >= 10, "the table is read");
    for (second, first) in pairs {
        assert_eq!(shared(&read(&second), &read(&first)), Vec::<String>::new(), "{second} and {first} share lines");
    }
}

#[test]
fn a_copied_line_is_found() {
    let line = "let impulse = (target - speed) / weight(contact, first_row);";
    assert_eq!(shared(&format!("fn a() {{\n    {line}\n}}"), &format!("// other\n{line}\n")), [line]);
    assert!(shared(line, "let impulse = 0.0;").is_empty());
}
