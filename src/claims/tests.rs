//! Every formula of every claim and title, for the terminal and for a page.

use super::{all, title_in_tex};
use crate::checks::formula::{formulas, html, unicode};
use quick_xml::{Reader, events::Event};
use std::path::{Path, PathBuf};

/// The texts of the claims that may hold formulas, each with the id of its claim.
fn texts() -> Vec<(&'static str, &'static str)> {
    let of = |claim: &'static super::Claim| {
        let main = [title_in_tex(claim.id), claim.statement, claim.correct_statement, claim.argument];
        main.into_iter().chain(claim.controls.iter().copied()).map(|text| (claim.id, text))
    };
    all().flat_map(of).collect()
}

/// Whether the tags of a page are balanced.
fn is_well_formed(page: &str) -> bool {
    let mut reader = Reader::from_str(page);
    loop {
        match reader.read_event() {
            Ok(Event::Eof) => return true,
            Ok(_) => {}
            Err(_) => return false,
        }
    }
}

#[test]
fn every_formula_is_written_for_the_terminal_and_for_a_page() {
    for (id, text) in texts() {
        let terminal = unicode(text).unwrap_or_else(|error| panic!("{id}: {error}"));
        assert!(!terminal.contains(['$', '\\']), "{id}: {terminal}");
        let page = html(text).unwrap_or_else(|error| panic!("{id}: {error}")).into_string();
        assert!(is_well_formed(&page) && !page.contains(['$', '\\']), "{id}: {page}");
        let count = formulas(text).expect("read above").len();
        assert_eq!((page.matches("<math").count(), page.matches("merror").count()), (count, 0), "{id}: {page}");
    }
    assert!(!is_well_formed("<math><mi>x</math>"));
}

#[test]
fn no_formula_stands_where_nothing_reads_it() {
    let read: usize = texts().iter().map(|(_, text)| formulas(text).expect("every text can be read").len()).sum();
    let marks: usize = sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src/claims"))
        .iter()
        .map(|path| std::fs::read_to_string(path).expect("a text"))
        .filter(|text| text.contains("pub const CLAIMS: &[Claim]") || text.starts_with("# A short title"))
        .map(|text| text.matches('$').count())
        .sum();
    assert_eq!(2 * read, marks, "a dollar sign of src/claims is in no text of a claim");
    assert!(read > texts().len(), "more formulas than texts: {read}");
}

/// The files below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("readable").path());
    entries.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}
