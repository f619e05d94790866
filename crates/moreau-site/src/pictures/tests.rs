//! What every picture has to be.

use super::PICTURES;
use crate::picture::{Creep, CreepStep, Given, Work};
use crate::words::Language;
use std::collections::BTreeSet;

/// The largest picture [bytes].
const LARGEST: usize = 150_000;

/// Something to draw where a picture shows what others measured.
fn given() -> Given {
    let step = |time_step| CreepStep { time_step, speed: 0.001, allowed: 0.01 * time_step };
    let creep = Creep { engine: "engine".into(), program: "program".into(), steps: vec![step(0.01), step(0.001)], trend: None };
    let work = Work { laws: "laws".into(), problems: 4, profiles: vec![("solver".into(), vec![[1.0, 0.25], [10.0, 0.75]])] };
    Given { creep: vec![creep], work: vec![work] }
}

/// The names of elements in order, each opened and closed as XML asks for.
fn assert_well_formed(id: &str, text: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        let between = &rest[..start];
        assert!(!between.contains('>'), "{id}: a `>` outside of a tag in {between:?}");
        for (place, _) in between.match_indices('&') {
            assert!(
                ["&amp;", "&lt;", "&gt;", "&quot;", "&#"].iter().any(|entity| between[place..].starts_with(entity)),
                "{id}: a bare `&`"
            );
        }
        let end = start + rest[start..].find('>').unwrap_or_else(|| panic!("{id}: a tag that does not end"));
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        assert_eq!(tag.matches('"').count() % 2, 0, "{id}: quotes of <{tag}>");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "{id}: </{name}> closes something else");
        } else if !tag.ends_with('/') && !tag.starts_with('?') && !tag.starts_with('!') {
            open.push(tag.split_whitespace().next().expect("a tag has a name"));
        }
    }
    assert!(open.is_empty(), "{id}: {open:?} stay open");
}

/// Texts of the picture that end with a unit in brackets.
fn units(text: &str) -> usize {
    text.lines().map(str::trim).filter(|line| line.ends_with(']') && line.contains(" [")).count()
}

#[test]
fn there_are_at_least_twenty_and_each_has_an_id_of_its_own() {
    assert!(PICTURES.len() >= 20, "{}", PICTURES.len());
    let ids: BTreeSet<_> = PICTURES.iter().map(|picture| picture.id).collect();
    assert_eq!(ids.len(), PICTURES.len());
    assert!(ids.iter().all(|id| id.chars().all(|c| c.is_ascii_lowercase() || c == '-')), "{ids:?}");
}

#[test]
fn every_picture_asks_a_question_and_says_how_it_was_answered_in_both_languages() {
    for picture in PICTURES {
        let id = picture.id;
        assert!(picture.question.en.ends_with('?') && picture.question.zh.ends_with('？'), "{id}");
        for text in [picture.caption, picture.obtained] {
            assert!(
                text.en.ends_with('.') && text.zh.ends_with('。') && !text.en.contains("  ") && !text.zh.contains("  "),
                "{id}: {text:?}"
            );
        }
        assert!(picture.command.starts_with("moreau ") && !picture.claims.is_empty(), "{id}");
        let shaped = |claim: &str| claim.split_once('.').is_some_and(|(section, name)| !section.is_empty() && !name.is_empty());
        assert!(picture.claims.iter().all(|claim| shaped(claim) || claim.starts_with('R')), "{id}: {:?}", picture.claims);
    }
}

#[test]
fn every_picture_is_drawn_well_formed_small_labelled_and_the_same_twice() {
    for picture in PICTURES {
        let id = picture.id;
        let text = (picture.draw)(&given()).unwrap_or_else(|error| panic!("{id}: {error}"));
        assert_well_formed(id, &text);
        assert!(text.len() <= LARGEST, "{id} has {} bytes", text.len());
        assert!(units(&text) >= 2, "{id} has no axis with a unit");
        assert!(!text.contains("NaN") && !text.contains("inf"), "{id}");
        assert_eq!(text, (picture.draw)(&given()).expect("drawn before"), "{id}");
        if let Some(folder) = std::env::var_os("MOREAU_PICTURES") {
            std::fs::write(std::path::Path::new(&folder).join(format!("{id}.svg")), &text).expect("a folder for pictures");
        }
    }
}

#[test]
fn a_picture_in_a_page_has_its_question_and_caption_for_a_screen_reader() {
    let picture = PICTURES[0];
    for language in Language::ALL {
        let text = picture.svg(&given(), language).expect("drawn");
        assert_well_formed(picture.id, &text);
        assert!(text.contains(&format!("<title id=\"{}-title\">{}</title>", picture.id, picture.question.of(language))));
        assert_eq!(text.matches("<desc ").count(), 1);
        assert!(text.contains(&format!("aria-labelledby=\"{0}-title {0}-desc\"", picture.id)));
        let ids: Vec<_> = text.match_indices(" id=\"").collect();
        assert_eq!(ids.len(), 2, "no other id that a second picture could have as well");
    }
}
