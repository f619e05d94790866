//! The gate on our own engines: every scheme has the verdict that theory demands, every check can pass and can fail.
//!
//! By default over the quick sweep; `MOREAU_CAMPAIGN=1` takes the whole one, all nine time steps.

mod sweep;

use moreau::gate::checks::EXPECTED;
use moreau::gate::runner::{QUICK, SWEEP, run};
use moreau::gate::{Check, CheckOutcome, Engine, Options, Plan, Verdict, checks, own, planted};

/// The schemes the expected verdicts speak of.
const SCHEMES: [&str; 3] = ["moreau-jean", "stewart-trinkle", "anitescu"];

/// Every time step there is in a campaign, the quick sweep otherwise.
fn time_steps() -> Vec<f64> {
    let deeper = std::env::var("MOREAU_CAMPAIGN").is_ok_and(|value| value == "1");
    if deeper { SWEEP.to_vec() } else { QUICK.to_vec() }
}

/// Some checks on an engine.
fn judge(make: &(dyn Fn() -> Box<dyn Engine> + Sync), checks: Vec<&'static Check>) -> Vec<CheckOutcome> {
    let plan = Plan { checks, sweep: time_steps(), options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
    run(make, &plan).expect("it describes itself").checks
}

/// The checks of a family.
fn family(name: &str) -> Vec<&'static Check> {
    let checks: Vec<_> = checks::all().filter(|check| check.family() == name).collect();
    assert!(!checks.is_empty(), "no family `{name}`");
    checks
}

/// What was measured, one line per number that is not a pass.
fn details(outcome: &CheckOutcome) -> String {
    let mut lines = format!("{} is {}: {}\n", outcome.check, outcome.verdict.word(), outcome.reason.as_deref().unwrap_or(""));
    for step in &outcome.steps {
        for one in step.measurements.iter().filter(|one| one.verdict() != Verdict::Pass) {
            let model =
                one.model.as_ref().map_or(String::new(), |law| format!(", law {:e} ± {:e} ({})", law.value, law.tolerance, law.why));
            let h = step.time_step.unwrap_or(0.0);
            let verdict = one.verdict().word();
            lines += &format!(
                "  h = {h:.6}: {} = {:e} {}: {verdict}; ideal {:e} ± {:e}{model}\n",
                one.quantity, one.value, one.unit, one.ideal.value, one.ideal.tolerance
            );
        }
    }
    lines
}

/// Every scheme has its derived verdict on every check of a family.
fn schemes_have_their_derived_verdicts(name: &str) {
    let mut wrong = String::new();
    for scheme in SCHEMES {
        let make = || -> Box<dyn Engine> { Box::new(own::by_name(scheme).expect("a listed scheme")) };
        for outcome in judge(&make, family(name)) {
            let expected = EXPECTED.iter().copied().flatten().find(|one| one.scheme == scheme && one.check == outcome.check);
            let verdict = expected.map_or(Verdict::Pass, |one| one.verdict);
            if outcome.verdict != verdict {
                wrong += &format!("{scheme}, expected {}: {}", verdict.word(), details(&outcome));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// The control of every check of a family: one scheme passes, one planted mistake does not.
fn controls_pass_and_fail(name: &str) {
    for check in family(name) {
        let passes = own::by_name(check.control.passes).expect("a listed scheme");
        let make = || -> Box<dyn Engine> { Box::new(passes.clone()) };
        let outcome = &judge(&make, vec![check])[0];
        assert_eq!(outcome.verdict, Verdict::Pass, "{}", details(outcome));
        let mistake =
            planted::find(check.control.fails).unwrap_or_else(|| panic!("{}: nothing planted as `{}`", check.name, check.control.fails));
        let outcome = &judge(&mistake.subject.engine, vec![check])[0];
        assert_eq!(outcome.verdict, Verdict::Fail, "{} does not catch {}: {}", check.name, mistake.name, details(outcome));
    }
}

macro_rules! families {
    ($($family:ident)*) => {
        $(mod $family {
            #[test]
            fn every_scheme_has_its_derived_verdict() {
                super::schemes_have_their_derived_verdicts(stringify!($family));
            }

            #[test]
            fn every_check_can_pass_and_fail() {
                super::controls_pass_and_fail(stringify!($family));
            }
        })*

        #[test]
        fn no_family_is_forgotten() {
            let mut families: Vec<&str> = checks::all().map(Check::family).collect();
            families.dedup();
            assert_eq!(families, [$(stringify!($family)),*]);
        }
    };
}

families! {
    flight ball impact rest stack determinism metamorphic solver projection incline rolling isotropy contact energy rocking painleve
    tumbling spin limits bounce pair fixed conveyor round
}
