//! Random scenes: no panic, no number that is not finite, the energy balance of every scheme at every step, and no body beyond the reach of
//! its energy.
//!
//! `cargo test --test random_scenes -- --nocapture` shows the table of the default run; the campaign is in `campaign.rs`.

mod campaign;
mod motion;
mod numbers;
mod report;
mod scenario;

use campaign::Shard;
use motion::{CAUGHT, runs};
use rayon::prelude::*;
use report::Report;
use scenario::{Length, Scenario};

/// Scenes of the default run.
const SCENES: u64 = 300;

/// Panics that are caught are told by the report alone.
fn quiet() {
    let loud = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        if !CAUGHT.get() {
            loud(info);
        }
    }));
}

fn assert_nothing_failed(report: &Report) {
    println!("{report}");
    let failures = report.failures();
    assert!(failures.is_empty(), "{} of the runs failed:\n{}", failures.len(), failures.join("\n"));
}

#[test]
fn random_scenes_keep_their_energy_balance_under_every_scheme() {
    quiet();
    let scenarios = (0..SCENES).into_par_iter().map(|seed| Scenario::new(seed, Length::Short));
    let runs: Vec<_> = scenarios.map(|scenario| (scenario.json(""), runs(&scenario))).collect();
    let mut report = Report::default();
    for (mut scene, outcomes) in runs {
        for (name, outcome) in outcomes {
            report.add(name, scene["seed"].as_u64().expect("a seed"), &outcome);
            if outcome.failure.is_some() {
                scene["scheme"] = name.into();
                println!("to run again: {scene}");
            }
        }
    }
    assert_nothing_failed(&report);
}

#[test]
fn the_campaign_of_twenty_thousand_scenes_keeps_its_energy_balance() {
    if std::env::var("MOREAU_CAMPAIGN").is_ok_and(|value| value == "1") {
        quiet();
        assert_nothing_failed(&Shard::of_environment().run());
    }
}

#[test]
fn a_seed_is_a_scene_and_every_kind_of_scene_has_one() {
    let scenes: Vec<Scenario> = (0..SCENES).map(|seed| Scenario::new(seed, Length::Full)).collect();
    for scenario in &scenes {
        assert_eq!(scenario.json("").to_string(), Scenario::new(scenario.seed, Length::Full).json("").to_string());
        assert!((1e-4..=1.0 / 30.0).contains(&scenario.h) && scenario.steps as f64 <= scenario::STEPS);
        let staged = scenario.staged();
        let touching = staged.mechanism.contacts(&staged.start.position).iter().map(|contact| contact.gap).fold(f64::INFINITY, f64::min);
        assert!(touching >= -moreau::tolerance::rounding(1024, 4.0), "seed {}: bodies start {touching} m inside each other", scenario.seed);
    }
    let ratio = |scenario: &Scenario| {
        let masses = scenario.staged().masses;
        masses.iter().copied().fold(0.0, f64::max) / masses.iter().copied().fold(f64::INFINITY, f64::min)
    };
    assert!(scenes.iter().map(ratio).fold(0.0, f64::max) > 1e4);
}

/// The posed problem's contacts and the step's are in one order, whatever the last look at the candidates lists first.
#[test]
fn contacts_that_are_no_candidates_any_more_keep_their_place_in_the_projection() {
    for seed in [5041, 10967] {
        let outcome = motion::run("moreau-jean-projection", &Scenario::new(seed, Length::Full));
        assert!(outcome.steps > 0 && outcome.failure.is_none() && outcome.ended.is_none(), "seed {seed}: {outcome:?}");
    }
}

/// hω = 2.25: the explicit step of a spring is unstable.
#[test]
fn a_spring_that_leaves_the_numbers_ends_with_an_error() {
    let outcome = motion::run("drake-tamsi", &Scenario::new(13767, Length::Full));
    assert!(outcome.failure.is_none() && outcome.ended.as_ref().is_some_and(|why| why.contains("the energy is not finite")), "{outcome:?}");
}
