//! Every system agrees with what it is held against, every agreement catches the mistakes planted in it, and docs/systems.md shows what is
//! measured.

#[path = "claims/regression.rs"]
mod regression;

use moreau::checks::Expectation;
use moreau::checks::planted::{Kind, Planted};
use moreau::report::systems::{BEGIN, END, markdown};
use moreau::schemes::NAMES;
use moreau::stored::{Folder, RUNS, StoredRuns};
use moreau::systems::{ALL, Agreement, Cone, ConstraintLevel, ContactLaw, Measure, Measured, Report, System, SystemReport};
use rayon::prelude::*;
use regression::{Number, complaints, stored};
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex};

/// The embedded runs, and the paths that were asked for.
#[derive(Default)]
struct Asked(Mutex<BTreeSet<String>>);

impl StoredRuns for Asked {
    fn text(&self, path: &str) -> moreau::Result<Cow<'_, str>> {
        self.0.lock().expect("no panic while it is held").insert(path.into());
        RUNS.text(path)
    }
}

/// Everything measured once, and the stored runs that it took.
static MEASURED: LazyLock<(Report, BTreeSet<String>)> = LazyLock::new(|| {
    let asked = Asked::default();
    let report = Report::measure(&asked, || {}).expect("everything can be measured");
    (report, asked.0.into_inner().expect("no panic while it is held"))
});

#[test]
fn every_agreement_holds_and_the_page_shows_it() {
    let (report, _) = &*MEASURED;
    for (system, agreement) in report.systems.iter().flat_map(|system| system.held_against.iter().map(move |one| (system, one))) {
        assert!(agreement.holds, "{}: {agreement:?}", system.name);
    }
    let page = include_str!("../docs/systems.md");
    let section = page.split_once(BEGIN).and_then(|(_, rest)| rest.split_once(END)).expect("both markers").0;
    assert_eq!(section.trim(), markdown(report).trim(), "run `moreau systems --readme docs/systems.md`");
}

#[test]
fn no_agreement_has_moved_beyond_ten_times_what_is_stored() {
    let (known, mut told) = (stored("systems"), Vec::new());
    for system in &MEASURED.0.systems {
        let used = system.held_against.iter().filter(|agreement| agreement.used.is_some());
        let numbers: Vec<_> = used
            .map(|agreement| Number {
                name: format!("{}: {}", agreement.against, agreement.quantity),
                measured: agreement.difference.expect("what uses a bound is a number"),
                expectation: Expectation::equal(0.0, agreement.tolerance, ""),
            })
            .collect();
        let known = known.get(&system.name).map(Vec::as_slice).unwrap_or_default();
        told.extend(complaints(known, &numbers).into_iter().map(|complaint| format!("{}, {complaint}", system.name)));
    }
    assert_eq!(told, Vec::<String>::new());
    let names: BTreeSet<_> = ALL.iter().map(|system| system.name).collect();
    assert!(known.keys().all(|name| names.contains(name.as_str())), "a system is stored that is none");
}

#[test]
fn a_number_that_moved_is_told_with_the_cure_and_so_is_one_that_is_new() {
    let number = |measured: f64| [Number { name: "error".into(), measured, expectation: Expectation::equal(1.0, 0.1, "") }];
    let stored = [("error".to_string(), 1e-3)];
    assert_eq!(complaints(&stored, &number(1.000_99)), Vec::<String>::new(), "ten times what is stored");
    let told = complaints(&stored, &number(1.001_01)).concat();
    assert!(told.contains("which holds") && told.contains("measure_regression.py"), "{told}");
    assert_eq!(complaints(&[("error".to_string(), 0.06)], &number(1.0999)), Vec::<String>::new(), "the derived bound is sharp enough");
    assert!(complaints(&[], &number(1.0)).concat().contains("measure_regression.py"));
}

/// The stored files that the claims' sources name by their whole path, below a folder of theirs. What a claim reads by such a name it finds
/// embedded or not at all, and a name that nothing reads is dead code to the compiler.
fn named_by_claims(folder: &Path, references: &Path) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder).expect("a folder of sources").map(|entry| entry.expect("readable").path());
    let named = |path: PathBuf| {
        if path.is_dir() {
            return named_by_claims(&path, references);
        }
        let source = std::fs::read_to_string(path).expect("a source file");
        source.split('"').filter(|part| part.ends_with(".json") && references.join(part).is_file()).map(String::from).collect()
    };
    entries.flat_map(named).collect()
}

#[test]
fn what_is_embedded_is_what_agreements_and_claims_ask_for_as_it_is_stored() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = Folder(root.join("references"));
    let claimed = named_by_claims(&root.join("src/claims"), &folder.0);
    assert!(claimed.contains("facts/drake.json") && !claimed.contains("drake/ball_rest__tamsi__h0.001.json"), "{claimed:?}");
    let asked: BTreeSet<_> = MEASURED.1.union(&claimed).cloned().collect();
    let embedded: BTreeSet<_> = RUNS.0.iter().map(|(path, _)| path.to_string()).collect();
    assert_eq!((&embedded, embedded.len()), (&asked, RUNS.0.len()), "src/stored.rs embeds others, or one twice");
    for (path, text) in RUNS.0 {
        assert_eq!(folder.text(path).expect("stored"), *text, "{path}");
    }
}

/// What is wrong with the planted mistakes of a system: agreements that have none, and mistakes that are not caught.
fn missed(system: &System) -> Vec<String> {
    let of_agreement = |agreement: &Agreement| {
        let place = format!("{}, {}", system.name, agreement.quantity);
        let mut found = if agreement.planted.is_empty() { vec![format!("{place}: nothing is planted")] } else { vec![] };
        found.extend(agreement.planted.iter().filter_map(|planted| {
            let measured = (planted.subject)(&RUNS).expect("the mistake changes numbers only");
            measured.holds().then(|| format!("{place}: {}: {measured:?}", planted.mistake))
        }));
        found
    };
    system.held_against.par_iter().flat_map(of_agreement).collect()
}

#[test]
fn every_mistake_puts_its_agreement_out_of_its_tolerance() {
    let missed: Vec<_> = ALL.par_iter().flat_map(|system| missed(system)).collect();
    assert_eq!(missed, Vec::<String>::new());
}

#[test]
fn every_system_has_a_scheme_and_an_agreement_and_every_scheme_has_a_system() {
    let mut named = BTreeSet::new();
    for system in ALL {
        assert!(!system.schemes.is_empty() && !system.held_against.is_empty(), "{}", system.name);
        named.extend(system.schemes.iter().copied());
    }
    assert_eq!(named, BTreeSet::from(NAMES), "the systems and the schemes of moreau-replicas name different schemes");
    let names: BTreeSet<_> = ALL.iter().map(|system| system.name).collect();
    assert_eq!(names.len(), ALL.len(), "one name, one system");
}

const fn planted(mistake: &'static str, subject: Measure) -> Planted<Measure> {
    Planted { name: "wrong", mistake, kind: Kind::Scheme, subject }
}

static WRONG: System = System {
    name: "wrong",
    level: ConstraintLevel::Velocity,
    cone: Cone::SecondOrder,
    law: ContactLaw::Coulomb,
    algorithm: "none",
    restitution: "none",
    position_update: "q",
    schemes: &["wrong"],
    held_against: &[
        Agreement { against: "the truth", quantity: "error", unit: "m", measure: |_| Ok(Measured::within(2.0, 1.0)), planted: &[] },
        Agreement {
            against: "the truth",
            quantity: "lost",
            unit: "m",
            measure: |_| Ok(Measured::within(f64::NAN, 1.0)),
            planted: &[planted("large", |_| Ok(Measured::within(2.0, 1.0))), planted("small", |_| Ok(Measured::within(0.5, 1.0)))],
        },
    ],
};

#[test]
fn an_agreement_without_a_mistake_and_a_mistake_that_is_not_caught_are_told() {
    let missed = missed(&WRONG);
    assert!(
        missed.len() == 2 && missed[0] == "wrong, error: nothing is planted" && missed[1].starts_with("wrong, lost: small"),
        "{missed:?}"
    );
}

#[test]
fn an_agreement_outside_its_tolerance_or_not_a_number_is_told() {
    let report = Report { systems: vec![SystemReport::measure(&WRONG, &RUNS, || {}).expect("measurable")] };
    assert!(!report.holds());
    let table = markdown(&report);
    assert!(
        table.contains("**outside** the truth: error 2 m (1; 2)") && table.contains("**outside** the truth: lost not a number m"),
        "{table}"
    );
    assert!(moreau::report::systems::text(&report, moreau::checks::text::Style::PLAIN).contains("2 agreements, 2 outside the tolerance"));
}
