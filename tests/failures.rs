//! docs/failures.md shows what the planted mistakes and the causes of the scoreboard say, check by check.

use moreau::board;
use moreau::gate::{checks, planted};
use moreau::report::failures::{BEGIN, END, section};

fn made() -> String {
    let (standings, causes) = board::stored().expect("embedded");
    section(&standings, &causes)
}

/// The part of a check.
fn part<'a>(section: &'a str, check: &str) -> &'a str {
    let (_, rest) = section.split_once(&format!("### {check}\n")).unwrap_or_else(|| panic!("no part on {check}"));
    rest.split("\n### ").next().expect("a part")
}

#[test]
fn the_page_shows_what_is_known() {
    let page = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/failures.md")).expect("docs/failures.md");
    let shown = page.split_once(BEGIN).and_then(|(_, rest)| rest.split_once(END)).expect("both markers").0;
    assert_eq!(shown.trim(), made().trim(), "run `moreau gate --failures docs/failures.md`");
}

#[test]
fn every_check_has_its_question_and_at_least_one_cause_and_no_mistake_is_left_out() {
    let section = made();
    for check in checks::all() {
        let part = part(&section, check.name);
        assert!(part.contains(check.question) && part.contains("\n1. "), "{}", check.name);
    }
    for mistake in planted::all() {
        for check in mistake.subject.caught_by {
            assert!(part(&section, check).contains(mistake.mistake), "{check}: {}", mistake.name);
        }
    }
}

#[test]
fn causes_of_engines_stand_first_the_most_frequent_before_the_others() {
    let (standings, mut causes) = board::stored().expect("embedded");
    causes.retain(|cause| cause.checks.iter().any(|check| check == "stack/ten"));
    assert!(causes.len() >= 2, "a check that several causes fail");
    let section = section(&standings, &causes);
    let part = part(&section, "stack/ten");
    let at = |words: &str| part.find(words).unwrap_or_else(|| panic!("no {words}"));
    let places: Vec<(usize, usize)> = causes.iter().map(|cause| (cause.engines.len(), at(&cause.cause))).collect();
    let first_planted = at("planted, ");
    for (count, place) in &places {
        assert!(*place < first_planted && places.iter().all(|(other, later)| other <= count || later < place));
    }
}
