//! The registry of claims: ids belong to sections, and sections stand in the chapter's order.

use moreau::claims::{self, SECTIONS};
use std::collections::HashSet;

#[test]
fn every_id_is_a_group_of_the_chapter_and_a_name() {
    for claim in claims::all() {
        let group = claim.section();
        let name = claim.id.strip_prefix(group).expect("the group is a prefix").trim_start_matches('.');
        assert!(claims::order(group).is_some(), "{}: no section `{group}`", claim.id);
        let plain = |letter: char| letter.is_ascii_alphanumeric() || letter == '-';
        assert!(!name.is_empty() && name.chars().all(plain), "{}: the name is not letters, digits and hyphens", claim.id);
    }
}

#[test]
fn claims_are_registered_in_the_order_of_the_chapter() {
    let places: Vec<_> = claims::all().map(|claim| (claims::order(claim.section()), claim.id)).collect();
    for pair in places.windows(2) {
        assert!(pair[0].0 <= pair[1].0, "{} is registered before {}", pair[0].1, pair[1].1);
    }
}

#[test]
fn sections_have_distinct_groups_and_titles() {
    let groups: HashSet<_> = SECTIONS.iter().map(|section| section.group).collect();
    let titles: HashSet<_> = SECTIONS.iter().map(|section| section.title).collect();
    assert_eq!((groups.len(), titles.len()), (SECTIONS.len(), SECTIONS.len()));
}
