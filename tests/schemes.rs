//! Every scheme runs every scene it can describe, and says why where it cannot.

use moreau::scenes::{LINKAGES, NAMES, Staged, named};
use moreau::schemes::{self, SchemeParameters, simulate};
use moreau::solvers::Auto;

/// h \[s\] small enough for the crank, which turns by 0.075 rad in it.
const TIME_STEP: f64 = 0.0005;
const STEPS: usize = 5;

fn scenes() -> Vec<Staged> {
    let bodies = NAMES.into_iter().map(|name| named(name).and_then(|scene| scene.staged()).expect("built in"));
    bodies.chain(LINKAGES.iter().map(|linkage| linkage.staged().expect("built in"))).collect()
}

/// Who refuses which scenes, and the words that say why. Whatever else is refused is a failure, and so is what is refused no longer.
const REFUSED: [(&str, &[&str], &str); 3] = [
    ("variational", &["incline-stick", "incline-slide", "box-stack"], "one contact at a time"),
    ("variational", &["rolling-disk", "rolling-sphere"], "e = 1 and no friction"),
    ("variational", &["double-pendulum", "slider-crank", "five-link-chain"], "one mass matrix for all positions"),
];

#[test]
fn every_scheme_runs_every_scene_or_says_why_not() {
    for scene in scenes() {
        for name in schemes::NAMES {
            let scheme = schemes::by_name(name, SchemeParameters::default()).expect("listed");
            let reason = REFUSED.iter().find(|(who, scenes, _)| *who == name && scenes.contains(&scene.name.as_str())).map(|(.., why)| why);
            match simulate(scheme.as_ref(), &Auto, scene.mechanism.as_ref(), scene.start.clone(), TIME_STEP, STEPS) {
                Err(told) => {
                    let expected = reason.is_some_and(|why| told.to_string().contains(why));
                    assert!(expected, "{name} refuses {}: {told}", scene.name);
                }
                Ok(run) => {
                    assert_eq!(reason, None, "{name} runs {}, which it is said to refuse", scene.name);
                    let numbers = run.samples.iter().flat_map(|state| state.position.iter().chain(&state.velocity));
                    assert!(numbers.into_iter().all(|x| x.is_finite()), "{name} loses {}", scene.name);
                    assert_eq!(run.samples.len(), STEPS + 1);
                }
            }
        }
    }
}

/// A linkage that hits its obstacle loses energy and stays on its side of it, under the schemes whose impulses act at the step's end.
#[test]
fn linkages_hit_their_obstacles_and_stay_outside() {
    for scene in LINKAGES.iter().map(|linkage| linkage.staged().expect("built in")) {
        // the slider hits its guide within a twelfth of a turn of the crank
        let (h, steps) = if scene.name == "slider-crank" { (0.0001, 200) } else { (0.004, (scene.duration / 0.004) as usize) };
        for name in ["moreau-jean", "stewart-trinkle", "anitescu"] {
            let scheme = schemes::by_name(name, SchemeParameters::default()).expect("listed");
            let run = simulate(scheme.as_ref(), &Auto, scene.mechanism.as_ref(), scene.start.clone(), h, steps).expect("solvable");
            assert!(run.impulses.iter().any(|impulses| impulses.iter().any(|one| one.impulse[0] > 0.0)), "{name}: {} touches", scene.name);
            let (mut deepest, mut fastest) = (0.0f64, 0.0f64);
            for state in &run.samples {
                for contact in scene.mechanism.contacts(&state.position) {
                    deepest = deepest.max(-contact.gap);
                    fastest = fastest.max((&contact.jacobian * &state.velocity).amax());
                }
            }
            // a contact is seen at the latest one step after it closed, and curvature adds as much again
            assert!(deepest <= 2.0 * h * fastest, "{name}: {} is {deepest} m inside at {fastest} m/s", scene.name);
            let energy = |k: usize| scene.mechanism.energy(&run.samples[k]);
            assert!(energy(steps) < energy(0), "{name}: {}", scene.name);
        }
    }
}

#[test]
fn the_page_on_the_waist_says_which_schemes_pass() {
    let page = include_str!("../docs/waist.md");
    let rows = page.lines().filter_map(|line| line.strip_prefix("| `")?.split_once("` | "));
    let told: Vec<(&str, &str)> = rows.map(|(name, rest)| (name, rest.split(' ').next().unwrap_or(""))).collect();
    let measured = schemes::NAMES.map(|name| {
        let scheme = schemes::by_name(name, SchemeParameters::default()).expect("listed");
        (name, if scheme.waist().is_some() { "yes" } else { "no" })
    });
    assert_eq!(told, measured);
}
