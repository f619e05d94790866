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

/// Elements with the number of parts that they must have.
const PARTS: [(&str, usize); 8] =
    [("msup", 2), ("msub", 2), ("msubsup", 3), ("munder", 2), ("mover", 2), ("munderover", 3), ("mfrac", 2), ("mroot", 2)];

/// Whether the tags of a page are balanced, and every script has its base and as many parts as its name says.
fn is_well_formed(page: &str) -> bool {
    let mut reader = Reader::from_str(page);
    let mut open: Vec<usize> = vec![0];
    loop {
        match reader.read_event() {
            Ok(Event::Eof) => return true,
            Ok(Event::Start(_)) => {
                open.iter_mut().last().into_iter().for_each(|parts| *parts += 1);
                open.push(0);
            }
            Ok(Event::Empty(_)) => open.iter_mut().last().into_iter().for_each(|parts| *parts += 1),
            Ok(Event::End(tag)) => {
                let parts = open.pop();
                if PARTS.iter().any(|(name, count)| name.as_bytes() == tag.name().as_ref() && parts != Some(*count)) {
                    return false;
                }
            }
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
    assert!(!is_well_formed("<msup><mspace/><mi>cos</mi><mn>2</mn></msup>") && is_well_formed("<msup><mi>x</mi><mn>2</mn></msup>"));
}

#[test]
fn no_formula_stands_where_nothing_reads_it() {
    let read: usize = texts().iter().map(|(_, text)| formulas(text).expect("every text can be read").len()).sum();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/claims");
    let marks: usize = sources(&root)
        .iter()
        .filter(|path| path.parent() != Some(&root) || path.ends_with("titles.toml"))
        .map(|path| std::fs::read_to_string(path).expect("a text"))
        .filter(|text| text.contains("correct_statement:") || text.starts_with("# A short title"))
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
