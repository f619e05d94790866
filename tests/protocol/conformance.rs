//! Each mistake of an adapter is found by the probe that looks for it, with a cure that names it; a sound adapter passes them all.

use crate::cases::this_program;
use libtest_mimic::Trial;
use moreau::gate::Options;
use moreau::gate::conformance::{Conformance, ProbeOutcome, conformance, conformance_heard, misreported};
use moreau::gate::process::{Fate, Limits, ProcessEngine};
use std::cell::RefCell;
use std::time::Duration;

/// Mistakes with the probes that must find them – no others may complain – and words of their report.
const MISTAKES: &[(&str, &[&str], &str)] = &[
    ("sound", &[], ""),
    ("ground-first", &[], ""),
    ("no-version-check", &["line/version"], "compare `protocol`"),
    ("dies-of-garbage", &["line/garbage"], "exit status: 1"),
    ("silent-about-garbage", &["line/garbage"], "no reply"),
    ("error-for-unknown", &["line/unknown-request"], "unsupported"),
    ("ignores-options", &["describe/unknown-option", "simulate/unknown-option"], "silently ignored"),
    ("refuses-its-options", &["describe/known-options"], "no option iterations"),
    ("counts", &["line/same-twice", "describe/known-options"], "differ"),
    ("stays-after-bye", &["end/bye"], "does not end"),
    ("stays-after-end", &["end/input"], "leave the loop"),
    ("millimetres", &["describe/units"], "`mm` is not understood"),
    ("other-unit", &["describe/units"], "in `m/s`: convert it"),
    ("own-law", &["describe/law"], "`bouncy`"),
    ("shape-twice", &["describe/scenes"], "name each once"),
    ("no-free-bodies", &["describe/scenes"], "does not name `free`"),
    ("slab-falls", &["simulate/unmoved"], "whatever touches it"),
    ("no-first-sample", &["simulate/answers"], "`times`: does not start at 0"),
    ("samples-after-step", &["simulate/initial-state", "simulate/gravity", "simulate/orientation"], "before the first step"),
    ("samples-all", &["simulate/sample-every"], "every `sample_every`-th"),
    ("milliseconds", &["simulate/samples", "simulate/sample-every"], "k·sample_every·time_step"),
    ("own-gravity", &["simulate/gravity"], "all three components"),
    ("w-last-out", &["simulate/initial-state", "simulate/orientation", "simulate/angular-velocity"], "put w first"),
    ("w-last", &["simulate/angular-velocity"], "w first going out, and last coming in"),
    ("conjugate", &["simulate/angular-velocity"], "conjugate them"),
    ("body-frame", &["simulate/angular-velocity"], "in the body frame"),
    ("body-frame-out", &["simulate/orientation", "simulate/angular-velocity"], "angular_velocity[0]"),
    ("long-quaternion", &["simulate/answers"], "has length 1.01"),
    ("no-contacts", &["contacts/normal", "contacts/impulse"], "`contacts` is empty"),
    ("downward-normal", &["contacts/normal"], "turn the normal round"),
    ("on-ground", &["contacts/normal", "contacts/impulse"], "acts on the first body"),
    ("exchanged", &["contacts/normal", "contacts/impulse"], "acts on the first body"),
    ("forces", &["contacts/impulse"], "are forces"),
    ("mean-forces", &["contacts/impulse"], "mean forces"),
    ("last-step", &["contacts/impulse"], "add up the impulses of all steps"),
    ("late-contacts", &["contacts/impulse"], "one sample late"),
    ("early-contacts", &["contacts/impulse"], "one sample early"),
    ("no-restitution", &["simulate/restitution"], "pair value"),
    ("mixed-restitution", &["simulate/restitution"], "mixing rule"),
    ("undeclared-restitution", &["simulate/restitution"], "never simulate something else"),
    ("remembers", &["simulate/same-twice"], "anew for every request"),
    ("tangents-first", &["solve/conventions"], "normal first"),
    ("shifted-velocity", &["solve/conventions"], "without `shift`"),
    ("clamps", &["project/conventions"], "Euclidean metric"),
];

/// Mistakes after which there is no description, with words of the report.
const WITHOUT_DESCRIPTION: &[(&str, &str)] = &[
    ("prints", "step 1 of 12"),
    ("text-id", "`id` is \"5000000001\" instead of 5000000001"),
    ("small-id", "instead of 5000000001"),
    ("no-id", "no `id`"),
    ("extra-field", "field `colour`: unknown"),
    ("unknown-level", "`dance`"),
];

/// Every test.
pub fn all() -> Vec<Trial> {
    let mut trials = Vec::new();
    for (mistake, probes, words) in MISTAKES {
        trials.push(Trial::test(format!("probes_find_{mistake}"), move || {
            let outcome = probed(mistake);
            assert!(outcome.engine.is_some());
            let found = problems(&outcome);
            assert_eq!(found.iter().map(|(name, _)| *name).collect::<Vec<_>>(), *probes, "{found:#?}");
            assert!(probes.is_empty() || found.iter().any(|(_, text)| text.contains(words)), "{words} is not said: {found:#?}");
            Ok(())
        }));
    }
    for (mistake, words) in WITHOUT_DESCRIPTION {
        trials.push(Trial::test(format!("probes_find_{mistake}"), move || {
            let outcome = probed(mistake);
            let found = problems(&outcome);
            assert!(found[0].0 == "describe/answers" && found[0].1.contains(words), "{words} is not said: {found:#?}");
            Ok(())
        }));
    }
    trials.push(Trial::test("probes_find_prints-late", || {
        let outcome = probed("prints-late");
        let found = problems(&outcome);
        assert!(found.iter().any(|(name, text)| *name == "line/nothing-else" && text.contains("`done`")), "{found:#?}");
        Ok(())
    }));
    trials.push(Trial::test("an_adapter_that_does_not_start_has_no_outcome", || {
        let fault = conformance(&["/nowhere/engine".into()], LIMITS).expect_err("nobody answers");
        assert!(matches!(fault.cause, Fate::NotStarted(_)));
        let fault = conformance(&this_program(&["--misbehave", "crash-at-start"]), LIMITS).expect_err("nobody answers");
        assert!(fault.to_string().contains("No module named 'simulator'"), "{fault}");
        Ok(())
    }));
    trials.push(Trial::test("the_gate_tells_what_is_wrong_with_description_and_motion_before_any_check", || {
        for (mistake, expected) in [("sound", &[][..]), ("own-law", &["describe/law"]), ("forces", &["contacts/impulse"])] {
            let mut engine = ProcessEngine::new(this_program(&["--adapter", mistake]), LIMITS);
            let found: Vec<_> =
                misreported(&mut engine, &Options::new()).expect("it describes itself").into_iter().map(|probe| probe.probe).collect();
            assert_eq!(found, expected, "{mistake}");
        }
        Ok(())
    }));
    trials.push(Trial::test("an_adapter_that_keeps_silent_is_asked_no_more", || {
        let short = Limits { reply: Duration::from_secs(2), start: Duration::from_secs(2), ..LIMITS };
        for (engine, silent) in [
            (["--misbehave", "never-read"], &["describe/answers"][..]),
            (["--adapter", "falls-silent"], &["line/same-twice", "line/unknown-request"]),
        ] {
            let heard = RefCell::new(Vec::new());
            let outcome = conformance_heard(&this_program(&engine), short, &|name| heard.borrow_mut().push(name.to_string()));
            let outcome = outcome.expect("it starts");
            let found = problems(&outcome);
            assert_eq!(found.iter().map(|(name, _)| *name).collect::<Vec<_>>(), silent, "{found:#?}");
            assert!(found.iter().all(|(_, text)| text.contains("no reply within 2s")), "{found:#?}");
            let skipped = |name: &str| outcome.probes.iter().any(|probe| probe.probe == name && is_skipped(&probe.outcome));
            assert!(["line/garbage", "line/nothing-else", "end/bye", "end/input"].into_iter().all(skipped), "{outcome:#?}");
            let heard = heard.into_inner();
            assert!(heard[0] == "describe/answers" && silent.iter().all(|name| heard.contains(&name.to_string())), "{heard:?}");
        }
        Ok(())
    }));
    trials
}

fn is_skipped(outcome: &ProbeOutcome) -> bool {
    matches!(outcome, ProbeOutcome::Skipped { why } if why.contains("nothing more is asked"))
}

const LIMITS: Limits =
    Limits { reply: Duration::from_secs(5), start: Duration::from_secs(5), line: 1 << 20, farewell: Duration::from_secs(1) };

fn probed(mistake: &str) -> Conformance {
    conformance(&this_program(&["--adapter", mistake]), LIMITS).expect("it starts and answers")
}

fn problems(outcome: &Conformance) -> Vec<(&str, String)> {
    let problem = |outcome: &ProbeOutcome| match outcome {
        ProbeOutcome::Problem { why, cure } => Some(format!("{why} / {cure}")),
        _ => None,
    };
    outcome.probes.iter().filter_map(|probe| problem(&probe.outcome).map(|text| (probe.probe.as_str(), text))).collect()
}
