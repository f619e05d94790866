//! What docs/tolerances.md says of the code's tolerances is so.

use moreau::number::significant;
use moreau::tolerance::{certificate, gate, references};
use std::path::Path;

/// The constants that the page works out, as they are in the code.
const CONSTANTS: [(&str, f64); 6] = [
    ("PROJECTED", certificate::PROJECTED),
    ("COUPLED", certificate::COUPLED),
    ("CERTIFY", certificate::CERTIFY),
    ("SOLVED", gate::SOLVED),
    ("CREEP_GEOMETRY", references::CREEP_GEOMETRY),
    ("STEP", gate::conformance::STEP),
];

/// The text of a file of a crate.
fn source(path: &str) -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// The last line of documentation of a constant.
fn last_word<'a>(text: &'a str, name: &str) -> &'a str {
    let (before, _) = text.split_once(&format!("pub const {name}:")).unwrap_or_else(|| panic!("no constant {name}"));
    before.lines().rev().find_map(|line| line.trim().strip_prefix("/// ")).expect("documented")
}

#[test]
fn the_constants_of_the_page_have_the_word_and_the_value_that_it_says() {
    let page = include_str!("../../docs/tolerances.md");
    let rows: Vec<Vec<&str>> = page.lines().map(|line| line.split('|').map(|cell| cell.trim().trim_matches('`')).collect()).collect();
    for (name, value) in CONSTANTS {
        let row = rows.iter().find(|row| row.get(2) == Some(&name)).unwrap_or_else(|| panic!("the page has no row {name}"));
        assert_eq!(row[3], significant(value), "{name}");
        let word = last_word(&source(row[4]), name).to_string();
        assert!(word.starts_with(row[1]), "{name} is {word}");
    }
    assert_eq!(page.matches(".rs` |\n").count(), CONSTANTS.len(), "a row that nothing looks at");
}

#[test]
fn the_allowance_of_restitution_is_the_one_that_the_page_works_out() {
    let page = include_str!("../../docs/tolerances.md");
    let speed = f64::sqrt(2.0 * 9.81 * 5.0);
    let digits = |value: f64| significant(format!("{value:.2e}").parse().expect("a number"));
    let [coarse, middle, fine] = [1.0 / 60.0, 1.0 / 240.0, 0.001].map(|h| digits(gate::ball::restitution(0.5, speed, 9.81, h, h)));
    assert!(page.contains(&format!("allows {coarse}, {middle} and {fine} at")), "{coarse}, {middle} and {fine}");
}
