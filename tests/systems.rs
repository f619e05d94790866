//! Every system agrees with what it is held against, and docs/systems.md shows what is measured.

use moreau::report::systems::{BEGIN, END, markdown};
use moreau::schemes::NAMES;
use moreau::systems::{ALL, Agreement, Cone, ContactLaw, Level, Measured, Report, System, SystemReport};
use std::collections::BTreeSet;

#[test]
fn every_agreement_holds_and_the_page_shows_it() {
    let report = Report::measure(|| {}).expect("everything can be measured");
    for (system, agreement) in report.systems.iter().flat_map(|system| system.held_against.iter().map(move |one| (system, one))) {
        assert!(agreement.holds, "{}: {agreement:?}", system.name);
    }
    let page = include_str!("../docs/systems.md");
    let section = page.split_once(BEGIN).and_then(|(_, rest)| rest.split_once(END)).expect("both markers").0;
    assert_eq!(section.trim(), markdown(&report).trim(), "run `moreau systems --readme docs/systems.md`");
}

#[test]
fn every_system_has_a_scheme_and_an_agreement_and_every_scheme_has_a_system() {
    let mut named = BTreeSet::new();
    for system in ALL {
        assert!(!system.schemes.is_empty() && !system.held_against.is_empty(), "{}", system.name);
        named.extend(system.schemes.iter().copied());
    }
    assert_eq!(named, BTreeSet::from(NAMES), "src/systems/ and the schemes of moreau-replicas name different schemes");
    let names: BTreeSet<_> = ALL.iter().map(|system| system.name).collect();
    assert_eq!(names.len(), ALL.len(), "one name, one system");
}

static WRONG: System = System {
    name: "wrong",
    level: Level::Velocity,
    cone: Cone::SecondOrder,
    law: ContactLaw::Coulomb,
    algorithm: "none",
    restitution: "none",
    position_update: "q",
    schemes: &["wrong"],
    held_against: &[
        Agreement { against: "the truth", quantity: "error", unit: "m", measure: || Ok(Measured { difference: 2.0, tolerance: 1.0 }) },
        Agreement { against: "the truth", quantity: "lost", unit: "m", measure: || Ok(Measured { difference: f64::NAN, tolerance: 1.0 }) },
    ],
};

#[test]
fn an_agreement_outside_its_tolerance_or_not_a_number_is_told() {
    let report = Report { systems: vec![SystemReport::measure(&WRONG, || {}).expect("measurable")] };
    assert!(!report.holds());
    let table = markdown(&report);
    assert!(
        table.contains("**outside** the truth: error 2 m (1)") && table.contains("**outside** the truth: lost not a number m"),
        "{table}"
    );
    assert!(moreau::report::systems::text(&report).contains("2 agreements, 2 outside the tolerance"));
}
