//! `moreau simulate --html`: the page's numbers are those of the recording, its text is escaped, and it needs nothing else.

use super::{Folder, moreau};
use moreau::number::significant;
use moreau::trajectory::Trajectory;
use serde_json::{Value, json};
use std::path::Path;

/// A body of every shape over the ground, one that stands still and one that is driven.
fn shapes() -> Value {
    let body =
        |name: &str, shape: &str, size: Value, position: [f64; 3]| json!({"name": name, shape: size, "mass": 1, "position": position});
    let mut bodies = vec![
        body("ball", "sphere", json!({"radius": 0.1}), [0.0, 0.0, 0.5]),
        body("brick", "box", json!({"half_extents": [0.1, 0.15, 0.05]}), [0.5, 0.1, 0.3]),
        body("pill", "capsule", json!({"radius": 0.05, "half_height": 0.1}), [-0.5, 0.0, 0.4]),
        body("post", "box", json!({"half_extents": [0.1, 0.1, 0.1]}), [0.0, 0.05, 0.2]),
        body("belt", "box", json!({"half_extents": [0.3, 0.2, 0.02]}), [0.5, 0.0, 0.1]),
    ];
    for (k, (field, value)) in [(3, ("static", json!(true))), (4, ("prescribed", json!({"velocity": [0.5, 0, 0]})))] {
        let body = bodies[k].as_object_mut().expect("a body");
        body.remove("mass");
        body.insert(field.into(), value);
    }
    json!({"schema": "scene/1", "name": "shapes", "gravity": [0, 0, -9.81], "ground": {"normal": [0, 0, 1], "offset": 0},
        "bodies": bodies, "material": {"friction": 0.5, "restitution": 0.2}, "duration": 0.5})
}

/// The data of a page, as its own program reads them.
#[track_caller]
fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("<script type=\"application/json\" id=\"data\">").expect("the data");
    let (text, _) = rest.split_once("</script>").expect("an end");
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// What a number of the recording is in the page.
fn shown(value: f64) -> f64 {
    significant(value).parse().expect("a number")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The page and the trajectory of a scene.
#[track_caller]
fn written(folder: &Folder, scene: &Value, options: &[&str]) -> (String, Trajectory, super::Run) {
    let scene = folder.file("scene.json", &scene.to_string());
    let (html, out) = (folder.path("motion.html"), folder.path("motion.json"));
    let run = moreau(&[&["simulate", "--scene", &scene, "--html", &html, "--out", &out, "--format", "json"], options].concat());
    let said = if run.code == 1 { "the certificate rejects steps of this motion" } else { "" };
    assert!(run.message.starts_with(said) && run.message.is_empty() == said.is_empty(), "{}", run.message);
    let page = std::fs::read_to_string(&html).expect("written");
    (page, Trajectory::read(Path::new(&out)).expect("written"), run)
}

#[test]
fn the_page_holds_the_recording_to_six_digits() {
    let folder = Folder::new("page-numbers");
    let (page, trajectory, _) = written(&folder, &shapes(), &["--step", "0.005"]);
    let data = data(&page);
    let times: Vec<f64> = data["times"].as_array().expect("times").iter().map(number).collect();
    assert_eq!(times, trajectory.times.iter().copied().map(shown).collect::<Vec<_>>());
    assert_eq!((data["every"].as_u64(), data["steps"].as_u64(), times.len()), (Some(1), Some(100), 101));
    for (k, track) in trajectory.bodies.iter().enumerate() {
        for sample in 0..times.len() {
            let place = track.position[sample].into_iter().chain(track.orientation[sample]).map(shown);
            let found = data["places"][sample].as_array().expect("places")[7 * k..7 * k + 7].iter().map(number);
            assert_eq!(found.collect::<Vec<_>>(), place.collect::<Vec<_>>(), "{} at sample {sample}", track.name);
        }
    }
    let kinds: Vec<_> =
        data["bodies"].as_array().expect("bodies").iter().map(|body| json!([body["kind"], body["shape"], body["size"]])).collect();
    let expected = [
        json!(["free", "sphere", [0.1]]),
        json!(["free", "box", [0.1, 0.15, 0.05]]),
        json!(["free", "capsule", [0.05, 0.1]]),
        json!(["static", "box", [0.1, 0.1, 0.1]]),
        json!(["prescribed", "box", [0.3, 0.2, 0.02]]),
    ];
    assert_eq!(kinds, expected);
    assert_eq!(data["ground"], json!([[0, 0, 1], 0]));
    // a cylinder has no contact with a box
    let mut scene = shapes();
    scene["bodies"] = json!([{"name": "tin", "cylinder": {"radius": 0.1, "half_height": 0.2}, "mass": 1, "position": [0, 0, 0.3]}]);
    scene["ground"] = Value::Null;
    let page = written(&folder, &scene, &["--step", "0.01"]).0;
    let alone = self::data(&page);
    assert_eq!((&alone["bodies"][0]["shape"], &alone["bodies"][0]["size"]), (&json!("cylinder"), &json!([0.1, 0.2])));
    assert_eq!(alone["ground"], Value::Null);
}

#[test]
fn the_impulses_of_a_pair_add_up_to_those_of_the_trajectory() {
    let folder = Folder::new("page-impulses");
    let (page, trajectory, _) = written(&folder, &shapes(), &["--step", "0.005"]);
    let data = data(&page);
    let index = |name: &str| trajectory.bodies.iter().position(|track| track.name == name).map_or(-1, |k| k as i64);
    let mut compared = 0;
    for contact in &trajectory.contacts {
        let pair = [index(&contact.bodies[0]), index(&contact.bodies[1])];
        let mut sum = [0.0; 3];
        for one in data["contacts"][contact.sample].as_array().expect("contacts") {
            let own = [&one[0], &one[1]].map(|body| body.as_i64().expect("a body"));
            // the trajectory names the pair by the alphabet
            let sign = if own == pair {
                1.0
            } else if own == [pair[1], pair[0]] {
                -1.0
            } else {
                continue;
            };
            (0..3).for_each(|axis| sum[axis] += sign * number(&one[3][axis]));
        }
        let size = contact.impulse.iter().fold(0.0f64, |size, part| size.max(part.abs()));
        // up to sixteen numbers of six digits
        let off = (0..3).map(|axis| (sum[axis] - contact.impulse[axis]).abs()).fold(0.0, f64::max);
        assert!(off <= 16.0 * 1e-5 * size, "{contact:?}: {sum:?}");
        compared += 1;
    }
    assert!(compared > 50, "{compared} pairs are no motion with contacts");
    let all = data["contacts"].as_array().expect("contacts").iter().flat_map(|all| all.as_array().expect("a list"));
    for one in all.filter(|one| one[1] == json!(-1)) {
        let height = number(&one[2][2]);
        assert!(height.abs() < 0.01, "a contact with the ground is on it: {one}");
        let impulse: f64 = (0..3).map(|axis| number(&one[3][axis]).powi(2)).sum::<f64>().sqrt();
        assert!((number(&one[4]).hypot(number(&one[5])) - impulse).abs() <= 1e-5 * impulse, "{one}");
    }
}

#[test]
fn the_certificate_of_every_step_stands_beside_its_time() {
    let folder = Folder::new("page-certificate");
    let strict = ["--step", "0.005", "--solver", "pgs", "--certify-tolerance", "0"];
    let (page, trajectory, run) = written(&folder, &shapes(), &strict);
    let data = data(&page);
    let steps = trajectory.steps.expect("certified");
    let certificates = data["certificates"].as_array().expect("certificates");
    assert_eq!((certificates.len(), &certificates[0]), (steps.relative.len() + 1, &Value::Null));
    for (step, (relative, accepted)) in steps.relative.iter().zip(&steps.accepted).enumerate() {
        let told = &certificates[step + 1];
        let Some(relative) = relative else {
            assert_eq!(told, &Value::Null, "nothing was solved");
            continue;
        };
        assert_eq!((told[0].as_u64() == Some(0), number(&told[2]), told[5].as_u64()), (*accepted, shown(*relative), Some(step as u64 + 1)));
        assert!(data["residuals"][told[4].as_u64().expect("an index") as usize].is_string());
    }
    let rejected: u64 = certificates.iter().filter_map(|told| told[0].as_u64()).sum();
    assert_eq!((Some(rejected), run.code), (run.json()["steps"]["rejected"].as_u64(), 1));
    assert!(rejected > 0 && page.contains("<p class=\"steps fail\">steps the certificate rejects: "), "said before any picture");
    let (page, _, _) = written(&folder, &shapes(), &["--step", "0.005", "--scheme", "xpbd"]);
    assert!(page.contains("<p class=\"steps difference\">steps unconverged by declaration: "));
}

#[test]
fn a_long_run_is_thinned_to_what_the_page_says() {
    let folder = Folder::new("page-long");
    let html = folder.path("ball.html");
    let run = moreau(&["simulate", "--scene", "bouncing-ball", "--duration", "2.5005", "--step", "0.0005", "--html", &html]);
    assert_eq!(run.code, 0, "{}", run.message);
    let page = std::fs::read_to_string(&html).expect("written");
    let data = data(&page);
    let ends: Vec<u64> = data["ends"].as_array().expect("ends").iter().filter_map(Value::as_u64).collect();
    assert_eq!((ends[1], ends.len(), ends.last()), (5, 1002, Some(&5001)));
    for part in ["times", "energies", "places", "contacts", "certificates"] {
        assert_eq!(data[part].as_array().map(Vec::len), Some(ends.len()), "{part}");
    }
    assert!(page.contains("Of 5001 steps every 5th is shown, and the last one, for a page has at most 1200 samples"));
    // the ball of 1 kg arrives at √(2 g) and leaves at half of it: no impulse is lost between two samples
    let first = data["contacts"].as_array().expect("contacts").iter().find_map(|all| all.get(0)).expect("an impact");
    let expected = 1.5 * (2.0f64 * 9.81).sqrt();
    assert!((number(&first[4]) - expected).abs() < 0.02 * expected, "{first}");
    let short = data_of_few_steps(&folder);
    assert_eq!(short["every"], json!(1));
}

fn data_of_few_steps(folder: &Folder) -> Value {
    let html = folder.path("few.html");
    assert_eq!(moreau(&["simulate", "--scene", "ball-drop", "--step", "0.01", "--html", &html]).code, 0);
    let page = std::fs::read_to_string(&html).expect("written");
    assert!(page.contains("Every step is shown."));
    data(&page)
}

#[test]
fn names_that_look_like_markup_stay_text() {
    let folder = Folder::new("page-escape");
    let evil = "</script><b>&amp;\"'<!-- \u{2028}";
    let mut scene = shapes();
    scene["name"] = json!(evil);
    scene["description"] = json!(format!("{evil}<script>alert(1)</script>"));
    scene["bodies"][0]["name"] = json!(evil);
    let (page, _, _) = written(&folder, &scene, &["--step", "0.01"]);
    let count = |text: &str| page.matches(text).count();
    assert_eq!((count("<script"), count("</script>"), count("<b>"), count("<!--")), (2, 2, 0, 0));
    assert!(page.contains("<h1>&lt;/script&gt;&lt;b&gt;&amp;amp;&quot;"), "the name is shown as it is written");
    assert_eq!(data(&page)["bodies"][0]["name"], json!(evil));
}

#[test]
fn the_page_needs_nothing_else_and_fits_a_telephone() {
    let folder = Folder::new("page-alone");
    let arguments = |file: &str| {
        let html = folder.path(file);
        assert_eq!(moreau(&["simulate", "--scene", "box-stack", "--step", "0.01", "--html", &html]).code, 0);
        std::fs::read_to_string(&html).expect("written")
    };
    let page = arguments("a.html");
    for word in ["http", "src=", "url(", "@import", "import(", "fetch(", "XMLHttp", "type=\"module\"", "WebAssembly", "<link", "eval("] {
        assert!(!page.contains(word), "{word} asks for something else");
    }
    for word in ["<!DOCTYPE html>", "<html lang=\"en\">", "<meta charset=\"utf-8\">", "name=\"viewport\"", "<title>box-stack, "] {
        assert!(page.contains(word), "{word}");
    }
    for word in ["prefers-color-scheme:dark", "prefers-reduced-motion", "min-height:44px", "aria-label=", "<noscript>"] {
        assert!(page.contains(word), "{word}");
    }
    for id in ids_that_the_program_asks_for() {
        assert!(page.contains(&format!("id=\"{id}\"")), "the program asks for {id}");
    }
    assert!(page.len() < 400_000, "{} bytes", page.len());
    assert_eq!(page, arguments("b.html"), "the same input gives the same page");
}

/// What stands in `$("…")`.
fn ids_that_the_program_asks_for() -> Vec<&'static str> {
    let program = include_str!("../../src/report/motion_page/player.js");
    let ids: Vec<_> = program.split("$(\"").skip(1).filter_map(|rest| rest.split_once("\")")).map(|(id, _)| id).collect();
    assert!(ids.len() > 10 && program.lines().count() < 400);
    ids
}

#[test]
fn the_page_is_written_whole_or_not_at_all_and_over_nothing() {
    let folder = Folder::new("page-files");
    let scene = folder.file("scene.json", &shapes().to_string());
    let (html, out, nowhere) = (folder.path("page.html"), folder.path("out.json"), folder.path("nowhere/page.html"));
    let simulate = |more: &[&str]| moreau(&[&["simulate", "--scene", &scene, "--step", "0.01"], more].concat());
    simulate(&["--out", &out, "--html", &nowhere]).is_refused(&["nowhere", "there is no folder", "make the folder"]);
    simulate(&["--html", &html, "--out", &folder.path("nowhere/out.json")]).is_refused(&[
        "nowhere",
        "there is no folder",
        "make the folder",
    ]);
    simulate(&["--html", &scene]).is_refused(&["`--html`", "input file"]);
    simulate(&["--html", &html, "--out", &folder.path("./page.html")]).is_refused(&["`--html`", "--out"]);
    simulate(&["--html", &folder.path("a.svg"), "--plot", &folder.path("a.svg")]).is_refused(&["`--html`", "--plot"]);
    moreau(&["simulate", "--scene", "double-pendulum", "--html", &html]).is_refused(&["`--html`", "double-pendulum", "--plot"]);
    assert_eq!(folder.names(), ["scene.json"]);
    assert_eq!(std::fs::read_to_string(&scene).expect("kept"), shapes().to_string());
}
