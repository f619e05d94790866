//! What is stored of the grid, and what the page asks for.

use super::texts::{ACTS, TEXTS};
use super::view::FILES;
use super::*;
use crate::words::Language;
use moreau_contact::solvers::Auto;
use moreau_dynamics::schemes::simulate;
use moreau_replicas::staging::for_scheme;

fn choice(scene: &'static str, scheme: &'static str, friction: f64, restitution: f64) -> Choice {
    let theta = (scheme == "moreau-jean").then_some(0.5);
    Choice { scene, scheme, step: "1/60", theta, friction, restitution }
}

/// The run and its channels.
fn read(choice: &Choice) -> (Run, Vec<Vec<i64>>) {
    let run = compute(choice, &posed(choice).expect("on the grid").0).expect("the scheme takes it");
    let channels = decode(&run.data, run.steps + 1).expect("what is written can be read");
    (run, channels)
}

/// The channels of contact k behind those of so many bodies.
fn contact(channels: &[Vec<i64>], bodies: usize, k: usize) -> &[Vec<i64>] {
    let from = WIDTHS[0] * bodies + WIDTHS[1] + WIDTHS[2] * k;
    &channels[from..from + WIDTHS[2]]
}

#[test]
fn a_stored_run_is_the_recording_of_the_library_to_six_decimals() {
    for scheme in &SCHEMES {
        let choice = choice("stack", scheme.id, 0.3, 0.0);
        let (run, channels) = read(&choice);
        let staged = for_scheme(&posed(&choice).expect("on the grid").0, choice.scheme).expect("a scene");
        let made = choice.scheme().expect("a scheme");
        let mechanism = staged.mechanism.as_ref();
        let recording = simulate(made.as_ref(), &Auto, mechanism, staged.start, 1.0 / 60.0, 60).expect("it runs");
        assert_eq!((run.steps, channels.len()), (60, 3 * WIDTHS[0] + WIDTHS[1] + WIDTHS[2] * run.contacts.len()), "{}", scheme.id);
        for (k, state) in recording.samples.iter().enumerate() {
            assert_eq!(channels[3 * WIDTHS[0]][k], fixed(mechanism.energy(state)), "{} at {k}", scheme.id);
            for (one, body) in mechanism.bodies(&state.position, &state.velocity).iter().enumerate() {
                let ([x, y, z], [v_x, _, v_z]) = (body.position, body.linear_velocity);
                let kept = [0, 1, 3, 4, 6].map(|part| channels[WIDTHS[0] * one + part][k]);
                assert_eq!(kept, [x, z, v_x, v_z, y].map(fixed), "{} of {} at {k}", body.name, scheme.id);
            }
        }
    }
}

#[test]
fn impulse_and_law_velocity_lie_in_the_cones_and_at_right_angles() {
    let mu = 0.3;
    for scheme in &SCHEMES {
        let (run, channels) = read(&choice("incline", scheme.id, mu, 0.0));
        let (mut active, mut sliding) = (0, 0);
        for slot in 0..run.contacts.len() {
            let parts = contact(&channels, 1, slot);
            for k in (1..=run.steps).filter(|k| parts[0][*k] == 1) {
                let [r_n, r_t, u_t, y_n, y_t] = [1, 2, 5, 7, 8].map(|part| parts[part][k] as f64 / fixed(1.0) as f64);
                // one digit of every number
                let off = 4.0 / fixed(1.0) as f64;
                assert!(r_t.abs() <= mu * r_n + off && mu * y_t.abs() <= y_n + off, "{} at {k}", scheme.id);
                assert!((r_n * y_n + r_t * y_t).abs() <= off, "{} at {k}: ({r_n}, {r_t}) ({y_n}, {y_t})", scheme.id);
                active += 1;
                sliding += usize::from(u_t.abs() > 0.1 && r_n > off);
            }
        }
        assert!(active > 30 && sliding > 10, "{}: {active} {sliding}", scheme.id);
    }
}

#[test]
fn what_a_scheme_refuses_is_stored_as_its_words() {
    let choice = Choice { theta: Some(2.0), ..choice("ball", "moreau-jean", 0.5, 0.0) };
    let scene = SCENES[0].with(0.5, 0.0).expect("a scene");
    let Stored::Refused { refused } = stored(&choice, &scene) else { panic!("θ = 2 is no scheme") };
    assert!(refused.contains("theta") && refused.contains('2'), "{refused}");
    assert_eq!(serde_json::to_value(stored(&choice, &scene)).expect("JSON")["refused"], refused);
}

#[test]
fn an_angle_goes_on_over_whole_turns() {
    let turned = |angle: f64| [(angle / 2.0).cos(), 0.0, (angle / 2.0).sin(), 0.0];
    let mut before = 0.0;
    for k in 0..400 {
        let angle = 0.1 * f64::from(k);
        before = unwound(turned(angle), before);
        assert_eq!(fixed(before), fixed(angle), "{k}");
    }
}

/// What stands between two words in a text, every time.
fn between<'a>(text: &'a str, before: &'a str, after: &'a str) -> Vec<&'a str> {
    text.split(before).skip(1).filter_map(|rest| rest.split_once(after)).map(|(found, _)| found).collect()
}

#[test]
fn the_page_has_what_its_program_asks_for_in_both_languages() {
    let program = FILES.iter().find(|(name, _)| *name == "explorer.js").expect("it is listed").1;
    let ids: Vec<_> = between(program, "$(\"", "\")");
    assert!(ids.len() > 20);
    let parts: Vec<_> = between(program, "$(`${panel}-", "`)").into_iter().filter(|part| !part.contains('$')).collect();
    assert!(parts.len() > 8);
    for language in Language::ALL {
        let page = page(language, "explorer/");
        for id in &ids {
            assert!(page.contains(&format!("id=\"explorer-{id}\"")), "the program asks for {id}");
        }
        for part in &parts {
            for panel in ["coulomb", "anitescu", "sap", "mujoco"] {
                assert!(page.contains(&format!("id=\"explorer-{panel}-{part}\"")), "{panel}: {part}");
            }
        }
        let table = between(&page, "id=\"explorer-table\">", "</script>")[0];
        let table: serde_json::Value = serde_json::from_str(table).expect("JSON");
        for name in between(program, "texts.", " ").into_iter().map(|rest| rest.split(|c: char| !c.is_alphanumeric()).next().unwrap_or(""))
        {
            assert!(table["texts"][name].is_string(), "the program says {name}");
        }
        assert_eq!((table["scenes"].as_array().map(Vec::len), table["schemes"].as_array().map(Vec::len)), (Some(5), Some(5)));
        assert!(page.starts_with(&format!("<!DOCTYPE html><html lang=\"{}\">", language.tag())));
        for (name, _) in FILES {
            assert!(page.contains(&format!("=\"explorer/{name}\">")), "{name}");
        }
    }
}

#[test]
fn page_and_program_ask_for_nothing_from_elsewhere() {
    let texts = FILES.iter().map(|(_, text)| text.to_string()).chain(Language::ALL.map(|language| page(language, "explorer/")));
    for text in texts {
        let text = text.replace("http://www.w3.org/2000/svg", "");
        for word in ["http", "url(", "@import", "import(", "fetch(", "XMLHttp", "type=\"module\"", "WebAssembly", "eval("] {
            assert!(!text.contains(word), "{word} asks for something else");
        }
    }
}

#[test]
fn every_text_is_there_in_both_languages_and_every_line_of_a_program_is_short() {
    for (name, words) in TEXTS.iter().chain(&ACTS) {
        assert!(!words.zh.is_empty() && (!words.en.is_empty() || *name == "stepEnd"), "{name}");
    }
    for (name, text) in FILES {
        assert!(text.lines().count() < 400 && text.lines().all(|line| line.chars().count() <= 140), "{name}");
    }
}
