//! Stored runs that were spoilt, and schemes that are not the engine's: the replays refuse or tell them apart.

use moreau::checks::bullet_steps::BulletSteps;
use moreau::checks::siconos_events::SiconosEvents;
use moreau::checks::siconos_steps::SiconosSteps;
use moreau::event_driven::EventDriven;
use moreau::event_driven::flight::{Control, Location};
use moreau::scenes::Scene;
use moreau::schemes::{Activation, MoreauJean};

const STEPS: &str = include_str!("../references/siconos/ball__moreau-jean__h0.01.json");
const EVENTS: &str = include_str!("../references/siconos/ball__event-driven__h0.1.json");
const BULLET: &str = include_str!("../references/bullet/block_landing__box__h0.01.steps.json");

#[test]
fn another_activation_rule_is_not_siconos_s() {
    let run = SiconosSteps::from_json(STEPS).expect("stored");
    for (activation, same) in [(Activation::HalfStepForecast, true), (Activation::Gap, false), (Activation::FreeVelocityForecast, false)] {
        let scheme = MoreauJean { activation, ..MoreauJean::default() };
        let used = run.deviations(&scheme).expect("steps").map(|apart| apart / run.tolerance());
        println!("{activation:?}: position, velocity and impulse use {used:?} of the bound");
        assert_eq!(used.iter().all(|one| *one <= 1.0), same, "{activation:?}: {used:?} of the bound");
    }
}

#[test]
fn a_siconos_run_without_steps_is_refused() {
    let text = STEPS.replacen("\"impulses\":", "\"other\":[],\"impulses\":[],\"rest\":", 1);
    assert!(SiconosSteps::from_json(&text).is_err() && SiconosSteps::from_json("{}").is_err());
}

#[test]
fn an_event_noticed_late_is_not_siconos_s() {
    let run = SiconosEvents::from_json(EVENTS).expect("stored");
    let late = EventDriven { control: Control::Fixed(1e-3), location: Location::EndOfStep, ..EventDriven::default() };
    let apart = run.apart(&late).expect("a motion");
    assert!(apart.instant > 1e6 * run.tolerance(), "{apart:?}");
}

#[test]
fn a_siconos_run_whose_lists_differ_in_length_is_refused() {
    let text = EVENTS.replacen("\"times\":[0.0,", "\"times\":[", 1);
    assert_ne!(text, EVENTS);
    assert!(SiconosEvents::from_json(&text).is_err() && SiconosEvents::from_json("{}").is_err());
}

#[test]
fn a_bullet_run_whose_lists_differ_in_length_is_refused() {
    assert!(BulletSteps::from_json(BULLET).is_ok());
    assert!(BulletSteps::from_json(&BULLET.replacen("\"distance\":[", "\"distance\":[0.0,", 1)).is_err());
}

#[test]
fn the_page_on_energy_is_the_table_of_the_schemes() {
    let page = moreau::checks::energy_balance::table::page();
    assert!(include_str!("../docs/energy.md") == page, "docs/energy.md is not the table's page:\n{page}");
}

#[test]
fn stored_scenes_are_read_and_become_mechanisms() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("references/scenes");
    let files: Vec<_> = std::fs::read_dir(&folder).expect("the stored scenes").map(|entry| entry.expect("readable").path()).collect();
    assert!(!files.is_empty(), "{} is empty", folder.display());
    for file in files {
        let scene = Scene::read(&file).unwrap_or_else(|error| panic!("{error}"));
        let planar = scene.mechanism().or_else(|_| scene.spatial_mechanism());
        let (mechanism, state) = planar.unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        // Open or sunk on purpose: at φ = 0 rounding would choose.
        assert!(mechanism.contacts(&state.position).iter().all(|contact| contact.gap != 0.0), "{}: starts in touch", file.display());
    }
}
