//! `moreau simulate`.

use super::{Folder, Run, moreau};
use moreau::scenes::{LINKAGES, NAMES, named};
use moreau::trajectory::Trajectory;
use serde_json::Value;

#[track_caller]
fn quantity(run: &Run, name: &str) -> Option<f64> {
    let summary = run.json();
    let quantities = summary["quantities"].as_array().expect("an array");
    let found = quantities.iter().find(|quantity| quantity["name"] == name);
    found.unwrap_or_else(|| panic!("no quantity {name}"))["value"].as_f64()
}

#[test]
fn scenes_schemes_and_solvers_are_listed() {
    let run = moreau(&["simulate", "--list"]);
    assert_eq!(run.code, 0);
    let names = NAMES.into_iter().chain(moreau::schemes::NAMES).chain(moreau::solvers::ALL.names());
    names.for_each(|name| assert!(run.output.contains(name), "{name}"));
    assert_eq!(
        moreau(&["simulate", "--list", "--format", "json"]).json()["scenes"].as_array().map(Vec::len),
        Some(NAMES.len() + LINKAGES.len())
    );
}

#[test]
fn a_bouncing_ball_leaves_a_summary_a_trajectory_and_a_picture() {
    let folder = Folder::new("simulate-ball");
    let (out, plot) = (folder.path("ball.json"), folder.path("ball.svg"));
    let arguments = ["simulate", "--scene", "bouncing-ball", "--step", "0.01", "--out", &out, "--plot", &plot, "--format", "json"];
    let run = moreau(&arguments);
    assert_eq!((run.code, run.message.as_str()), (0, ""));
    let restitution = quantity(&run, "effective restitution of the first impact").expect("one contact");
    assert!((restitution - 0.5).abs() < 1e-12, "{restitution}");
    // the ball of e = ½ rests from T∞ = 3 t₁ = 1.35 s on; the scheme may absorb the last bounces a few steps early
    let settled = quantity(&run, "settling time").expect("it rests");
    assert!((1.0..1.4).contains(&settled), "{settled}");
    assert_eq!(folder.names(), ["ball.json", "ball.svg"]);
    let trajectory = Trajectory::read(std::path::Path::new(&out)).expect("what was written can be read");
    assert_eq!((trajectory.times.len(), trajectory.bodies.len(), trajectory.time_step), (201, 1, 0.01));
    let picture = std::fs::read_to_string(&plot).expect("written");
    for words in ["<svg", "position [m]", "velocity [m/s]", "energy [J]", "time [s]", "closed form", "</svg>"] {
        assert!(picture.contains(words), "{words}");
    }
    let bytes = |name: &str| std::fs::read(folder.0.join(name)).expect("written");
    let first = (bytes("ball.json"), bytes("ball.svg"), run.output);
    let again = moreau(&arguments);
    assert!(first == (bytes("ball.json"), bytes("ball.svg"), again.output), "the same input gives the same output, byte for byte");
}

#[test]
fn the_softness_of_mujoco_is_that_of_its_options() {
    let depth = |options: &[&str]| {
        let arguments = ["simulate", "--scene", "incline-stick", "--scheme", "mujoco", "--step", "0.002", "--format", "json"];
        quantity(&moreau(&[&arguments[..], options].concat()), "deepest penetration").expect("soft")
    };
    let soft = depth(&["--cone", "elliptic"]);
    assert!(soft > 0.0 && depth(&["--cone", "elliptic", "--solref=-1000,-50"]) > soft, "2500 and 100 by default");
    assert!(depth(&["--cone", "elliptic", "--solimp", "0.99,0.99,0.001,0.5,2"]) < soft);
    let refused = |options: &[&str], words: &[&str]| moreau(&[&["simulate", "--scene", "ball-drop"], options].concat()).is_refused(words);
    refused(&["--cone", "elliptic"], &["--cone", "use it with mujoco, bullet"]);
    refused(&["--scheme", "mujoco", "--cone", "round"], &["--cone", "pyramidal or elliptic"]);
    refused(&["--scheme", "mujoco", "--solref", "0.02"], &["--solref", "give 2"]);
    refused(&["--scheme", "mujoco", "--solref", "0.02,0"], &["solref", "positive"]);
    refused(&["--scheme", "mujoco", "--solimp", "2,0.9,0.001,0.5,2"], &["solimp"]);
    refused(&["--scheme", "mujoco", "--impratio", "0"], &["impratio"]);
    refused(&["--integrator", "rk4"], &["--integrator", "use it with mujoco"]);
    refused(&["--scheme", "mujoco", "--integrator", "heun"], &["--integrator", "implicitfast"]);
    refused(&["--scheme", "mujoco", "--rolling", "0.01"], &["--rolling", "both"]);
}

#[test]
fn options_of_a_scheme_change_the_motion() {
    let restitution = |options: &[&str]| {
        let arguments = [&["simulate", "--scene", "bouncing-ball", "--step", "0.01", "--format", "json"][..], options].concat();
        quantity(&moreau(&arguments), "effective restitution of the first impact")
    };
    assert!(restitution(&["--restitution", "0.75"]).is_some_and(|e| (e - 0.75).abs() < 1e-12));
    for rule in ["A", "D", "gap", "half-step-forecast"] {
        assert!(restitution(&["--activation", rule, "--theta", "1"]).is_some_and(|e| (e - 0.5).abs() < 1e-12), "rule {rule}");
    }
}

#[test]
fn the_other_schemes_are_plastic_and_say_so() {
    for scheme in ["stewart-trinkle", "anitescu"] {
        let run = moreau(&["simulate", "--scene", "bouncing-ball", "--scheme", scheme, "--duration", "1"]);
        assert_eq!(run.code, 0, "{}", run.message);
        assert!(run.output.contains("no restitution") && run.output.contains("deepest penetration"), "{}", run.output);
    }
    // an impulse that its certificate accepts leaves at most 1e-8 of the velocity g h = 0.00981 m/s of one step
    let run = moreau(&["simulate", "--scene", "incline-stick", "--scheme", "anitescu", "--format", "json"]);
    assert!(quantity(&run, "creep speed at rest").is_some_and(|speed| speed <= 1e-8 * 0.00981), "hard Anitescu sticks without creep");
}

#[test]
fn a_linkage_is_simulated_and_drawn_but_has_no_file() {
    let folder = Folder::new("simulate-linkage");
    let plot = folder.path("pendulum.svg");
    let run = moreau(&["simulate", "--scene", "double-pendulum", "--step", "0.005", "--plot", &plot, "--format", "json"]);
    assert_eq!((run.code, run.message.as_str()), (0, ""));
    assert!(quantity(&run, "energy change").is_some_and(|change| change < -1.0), "the wall takes energy: {}", run.output);
    assert!(std::fs::read_to_string(&plot).expect("written").contains("rod2 x"));
    let out = folder.path("pendulum.json");
    moreau(&["simulate", "--scene", "double-pendulum", "--out", &out]).is_refused(&["--out", "double-pendulum", "hinges"]);
    moreau(&["simulate", "--scene", "slider-crank", "--restitution", "1"]).is_refused(&["--restitution", "slider-crank"]);
    moreau(&["simulate", "--scene", "double-pendulun"]).is_refused(&["did you mean `double-pendulum`"]);
    assert_eq!(folder.names(), ["pendulum.svg"]);
}

#[test]
fn a_scene_comes_from_a_file_too() {
    let folder = Folder::new("simulate-file");
    let text = named("ball-drop").and_then(|scene| scene.to_json()).expect("built in");
    let file = folder.file("drop.json", &text);
    let run = moreau(&["simulate", "--scene", &file, "--step", "0.01"]);
    assert_eq!(run.code, 0, "{}", run.message);
    for (name, from, to, field) in [
        ("mass.json", "\"mass\": 1.0", "\"mass\": -1.0", "bodies[0].mass"),
        ("friction.json", "\"friction\": 0.5", "\"friction\": -0.5", "material.friction"),
        ("nan.json", "\"mass\": 1.0", "\"mass\": NaN", "mass"),
        ("broken.json", "\"duration\"", "", "JSON"),
    ] {
        assert!(text.contains(from));
        let file = folder.file(name, &text.replace(from, to));
        moreau(&["simulate", "--scene", &file, "--out", &folder.path("out")]).is_refused(&[name, field]);
    }
    moreau(&["simulate", "--scene", &folder.path("missing.json")]).is_refused(&["missing.json", "cannot read"]);
    assert!(folder.names().iter().all(|name| name.ends_with(".json")));
}

#[test]
fn the_options_of_the_position_based_and_event_driven_schemes_reach_them() {
    let asked = |scene: &str, scheme: &str, options: &[&str], name: &str| {
        let arguments = ["simulate", "--scene", scene, "--scheme", scheme, "--step", "0.01", "--format", "json"];
        quantity(&moreau(&[&arguments[..], options].concat()), name).expect("a number")
    };
    // a ball of 1 kg rests at the depth m g α, and comes deeper where it lands
    let depth = |alpha: &str| asked("ball-drop", "xpbd", &["--compliance", alpha, "--duration", "3"], "deepest penetration");
    assert!(depth("0") < 1e-12 && depth("1e-4") > 9.81e-4 && depth("1e-3") > 9.81e-3);
    let sunk = |options: &[&str]| asked("ball-drop", "pbd", options, "deepest penetration");
    assert!(sunk(&["--share", "1"]) < sunk(&["--share", "0.1", "--sweeps", "1"]));
    // with e = ½ and t₁ = 0.45 s flights last 0.45, 0.23 and 0.11 s; without the rule there are infinitely many
    let rebounds = |options: &[&str]| asked("bouncing-ball", "event-driven", options, "settling time");
    assert!(rebounds(&["--shortest-flight", "0.2"]) < rebounds(&["--shortest-flight", "0.01"]));
    let every = ["simulate", "--scene", "bouncing-ball", "--scheme", "event-driven", "--shortest-flight", "0"];
    let run = moreau(&every);
    assert!(run.code == 1 && run.message.contains("events before t"), "{}", run.message);
}

#[test]
fn a_variational_step_is_for_elastic_impacts() {
    let run = moreau(&["simulate", "--scene", "elastic-ball", "--scheme", "variational", "--step", "0.01", "--format", "json"]);
    assert!(quantity(&run, "deepest penetration").expect("a number") <= 1e-12);
    moreau(&["simulate", "--scene", "bouncing-ball", "--scheme", "variational"]).is_refused(&["e = 1", "e = 0.5"]);
    let run = moreau(&["simulate", "--scene", "bouncing-ball", "--scheme", "variational", "--restitution", "1"]);
    assert!(run.output.contains("variational"));
}

#[test]
fn bad_options_are_refused_by_name_and_nothing_is_written() {
    let folder = Folder::new("simulate-bad");
    let cases: [(&[&str], &[&str]); 27] = [
        (&["--scheme", "generalised-alpha", "--spectral-radius", "2"], &["--spectral-radius", "2"]),
        (&["--spectral-radius", "0.5"], &["--spectral-radius", "use it with generalised-alpha"]),
        (&["--scheme", "xpbd", "--compliance", "-1"], &["--compliance", "-1"]),
        (&["--scheme", "pbd", "--share", "1.5"], &["--share", "1.5"]),
        (&["--scheme", "pbd", "--sweeps", "0"], &["--sweeps", "from 1 to"]),
        (&["--scheme", "pbd", "--compliance", "0.1"], &["--compliance", "use it with xpbd"]),
        (&["--scheme", "event-driven", "--shortest-flight", "-1"], &["--shortest-flight", "-1"]),
        (&["--scheme", "mujoco", "--restitution", "0.5"], &["--restitution", "use it with moreau-jean, ", "event-driven"]),
        (&["--step", "0"], &["--step", "0"]),
        (&["--step", "-0.01"], &["--step", "-0.01"]),
        (&["--step", "NaN"], &["--step", "NaN"]),
        (&["--step", "inf"], &["--step"]),
        (&["--step", "1e-300"], &["--step", "1e-300 s, 2e300 steps"]),
        (&["--step", "1e-12"], &["--step", "1000000"]),
        (&["--step", "100"], &["--step", "2 s"]),
        (&["--duration", "0"], &["--duration"]),
        (&["--theta", "1.5"], &["--theta", "1.5"]),
        (&["--theta", "-0.1"], &["--theta"]),
        (&["--theta", "NaN"], &["--theta"]),
        (&["--restitution", "1.01"], &["--restitution", "1.01"]),
        (&["--restitution", "-0.5"], &["--restitution"]),
        (&["--scheme", "moreau-jeans"], &["--scheme", "did you mean `moreau-jean`"]),
        (&["--solver", "magic"], &["--solver", "magic"]),
        (&["--activation", "C"], &["--activation", "sinks"]),
        (&["--restitution-rule", "poisson"], &["--restitution-rule", "normal-only"]),
        (&["--scheme", "anitescu", "--theta", "0.5"], &["--theta", "use it with moreau-jean"]),
        (&["--scheme", "stewart-trinkle", "--friction-directions", "1"], &["--friction-directions"]),
    ];
    for (options, words) in cases {
        let (out, plot) = (folder.path("out.json"), folder.path("out.svg"));
        let arguments = [&["simulate", "--scene", "ball-drop", "--out", &out, "--plot", &plot][..], options].concat();
        moreau(&arguments).is_refused(words);
    }
    moreau(&["simulate", "--scene", "bouncing-bal"]).is_refused(&["--scene", "did you mean `bouncing-ball`"]);
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

#[test]
fn trajectory_and_picture_are_written_together_or_not_at_all() {
    let folder = Folder::new("simulate-together");
    let (out, nowhere) = (folder.path("out.json"), folder.path("nowhere/out.svg"));
    let run = moreau(&["simulate", "--scene", "ball-drop", "--step", "0.01", "--out", &out, "--plot", &nowhere]);
    run.is_refused(&["nowhere", "there is no folder", "make the folder"]);
    moreau(&["simulate", "--scene", "ball-drop", "--step", "0.01", "--out", &out, "--plot", &out]).is_refused(&["--plot", "--out"]);
    let again = folder.path("./out.json");
    moreau(&["simulate", "--scene", "ball-drop", "--out", &out, "--plot", &again]).is_refused(&["--plot", "--out"]);
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

#[test]
fn drakes_schemes_take_their_material_and_refuse_what_does_nothing() {
    let slide = ["simulate", "--scene", "incline-slide", "--step", "0.01"];
    for scheme in ["drake-sap", "drake-similar", "drake-lagged", "drake-tamsi"] {
        let run = moreau(&[&slide[..], &["--scheme", scheme, "--stiffness", "2000"]].concat());
        assert_eq!((run.code, run.message.as_str()), (0, ""), "{scheme}");
    }
    let refused = |scheme, option, value| moreau(&[&slide[..], &["--scheme", scheme, option, value]].concat());
    for (scheme, option, value, owner) in [
        ("drake-lagged", "--relaxation-time", "0.005", "drake-sap"),
        ("drake-sap", "--dissipation", "10", "drake-tamsi"),
        ("anitescu", "--stiffness", "1", "drake-lagged"),
        ("drake-sap", "--stiffness", "0", "positive"),
    ] {
        let run = refused(scheme, option, value);
        assert!(run.code == 2 && run.message.contains(option) && run.message.contains(owner), "{scheme} {option}: {}", run.message);
    }
}

#[test]
fn what_would_do_nothing_is_refused() {
    let folder = Folder::new("simulate-nothing");
    let simulate = |more: &[&str]| moreau(&[&["simulate", "--scene", "ball-drop", "--step", "0.01"], more].concat());
    let picture = folder.path("ball.png");
    simulate(&["--plot", &picture]).is_refused(&["`--plot`", "ball.png", "end the name in .svg"]);
    moreau(&["compare", "ball-drop", "--plot", &picture]).is_refused(&["`--plot`", "ball.png"]);
    for scheme in ["xpbd", "pbd"] {
        let out = folder.path("motion.json");
        simulate(&["--scheme", scheme, "--solver", "lemke", "--out", &out]).is_refused(&["`--solver`", scheme, "leave it out"]);
        assert_eq!(simulate(&["--scheme", scheme]).code, 0, "{scheme}");
    }
    assert_eq!(simulate(&["--solver", "lemke"]).code, 0, "a scheme that asks its solver");
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

#[test]
fn a_motion_that_the_time_limit_ends_keeps_its_steps_and_says_where_it_ended() {
    let folder = Folder::new("simulate-time");
    let [out, page, picture, step] = ["out.json", "page.html", "picture.svg", "step.json"].map(|name| folder.path(name));
    let asked = ["simulate", "--scene", "bouncing-ball", "--step", "1e-5", "--duration", "10", "--accept-rejected"];
    for limit in ["1e-9", "0.1"] {
        let files = ["--out", &out, "--html", &page, "--plot", &picture, "--dump-step", "1000000", &step];
        let run = moreau(&[&asked[..], &["--time-limit", limit, "--format", "json"], &files].concat());
        let json = run.json();
        assert_eq!((run.code, &json["reproducible"], &json["cut"]["of"]), (1, &false.into(), &1_000_000.into()), "{}", run.message);
        let cut = json["cut"]["step"].as_u64().expect("a number");
        assert_eq!(json["steps"]["steps"], cut - 1);
        assert!(run.message.contains(&format!("ended the motion in step {cut}: exit code 1")), "{}", run.message);
        assert!(run.message.contains("--dump-step 1000000 wrote nothing"), "{}", run.message);
        let written: Value = serde_json::from_str(&std::fs::read_to_string(&out).expect("written")).expect("JSON");
        assert_eq!(written["times"].as_array().expect("a list").len() as u64, cut);
        assert_eq!((&written["engine"]["options"]["reproducible"], &written["engine"]["options"]["cut"]), (&false.into(), &json["cut"]));
        let told = format!("ended by the time limit in step {cut} of 1000000");
        assert!(std::fs::read_to_string(&page).expect("written").contains(&told));
        assert_eq!(folder.names(), ["out.json", "page.html", "picture.svg"]);
    }
    let run = moreau(&[&asked[..], &["--time-limit", "1e-9"]].concat());
    // lines may be broken anywhere
    let told = run.output.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(run.code == 1 && told.contains("another run need not end there"), "{}", run.output);
    // time enough changes nothing
    let short = |more: &[&str]| moreau(&[&["simulate", "--scene", "bouncing-ball", "--step", "0.01", "--format", "json"], more].concat());
    let (free, limited) = (short(&[]), short(&["--time-limit", "1e5"]));
    assert_eq!((limited.code, &limited.output), (0, &free.output));
    assert!(free.json()["reproducible"] == true && free.json().get("cut").is_none(), "{}", free.output);
    short(&["--time-limit", "0"]).is_refused(&["--time-limit", "above 0"]);
}

#[test]
fn a_motion_of_which_a_step_cannot_be_made_keeps_those_before() {
    let folder = Folder::new("simulate-broken");
    let [scene, out, page, picture] = ["scene.json", "out.json", "page.html", "picture.svg"].map(|name| folder.path(name));
    // v² is above the largest double, 1.798e308, from 1.341e154 m/s: in the 135th step of 1e152 m/s each
    let thrown = r#"{"schema": "scene/1", "name": "thrown", "duration": 300, "gravity": [0, 0, 1e152], "ground": {"normal": [0, 0, 1],
        "offset": 0}, "material": {"friction": 0, "restitution": 0},
        "bodies": [{"name": "ball", "mass": 1, "sphere": {"radius": 1}, "position": [0, 0, 2]}]}"#;
    std::fs::write(&scene, thrown).expect("writes");
    let asked = ["simulate", "--scene", &scene, "--step", "1"];
    let run = moreau(&[&asked[..], &["--out", &out, "--html", &page, "--plot", &picture]].concat());
    assert_eq!(run.code, 1, "{}", run.message);
    let written: Value = serde_json::from_str(&std::fs::read_to_string(&out).expect("written")).expect("JSON");
    let (made, cut) = (written["times"].as_array().expect("a list").len() as u64, &written["engine"]["options"]["cut"]);
    assert!(made == 135 && cut["step"] == made && cut["of"] == 300, "{made} {cut}");
    assert_eq!(written["engine"]["options"]["reproducible"], true);
    let cause = cut["cause"].as_str().expect("told");
    assert!(
        run.message.contains(&format!("{} steps made before are written", made - 1)) && run.message.contains("finite"),
        "{}",
        run.message
    );
    let shown = std::fs::read_to_string(&page).expect("written");
    assert!(shown.contains(&format!("in step {made} of 300")) && cause.contains("finite"), "{cause}");
    assert_eq!(folder.names(), ["out.json", "page.html", "picture.svg", "scene.json"]);
    // as JSON the failure is what is printed, as before
    let run = moreau(&[&asked[..], &["--format", "json"]].concat());
    assert!(run.code == 1 && run.json().get("steps").is_none() && !run.message.contains("are written"), "{}", run.output);
    // where the first step cannot be made there is nothing to keep
    std::fs::write(&scene, thrown.replace("1e152", "1e156")).expect("writes");
    std::fs::remove_file(&out).expect("there");
    assert!(moreau(&[&asked[..], &["--out", &out]].concat()).code != 0 && !std::path::Path::new(&out).exists());
}

#[test]
fn a_time_step_may_be_a_fraction() {
    let run = |step: &str| moreau(&["simulate", "--scene", "ball-drop", "--step", step, "--format", "json"]);
    assert_eq!(run("1/250").output, run("0.004").output);
    for wrong in ["1/0", "-1/60", "0/3"] {
        assert_eq!(run(wrong).code, 2, "{wrong}");
    }
    assert!(run("1/x").message.contains("1/240"));
}

#[test]
fn the_help_groups_the_options_by_scheme() {
    let help = moreau(&["simulate", "--help"]).output;
    let group = |option: &str| {
        let start = help.find(&format!("--{option} ")).unwrap_or_else(|| panic!("{option} in {help}"));
        let heading = help[..start].lines().rev().find(|line| !line.starts_with(' ') && line.ends_with(':'));
        heading.expect("a heading").to_string()
    };
    assert_eq!(group("theta"), "Options of moreau-jean and moreau-jean-projection:");
    assert_eq!(group("sweeps"), "Options of xpbd and pbd:");
    assert!(group("solref").starts_with("Options of mujoco") && group("stiffness").starts_with("Options of drake-sap"));
    assert_eq!([group("restitution"), group("step"), group("plot")], ["Options:", "Options:", "Options:"]);
}

#[test]
fn a_deep_penetration_is_remarked_on_and_a_shallow_one_is_not() {
    let ball = ["simulate", "--scene", "ball-drop", "--step"];
    let deep = moreau(&[&ball[..], &["0.05"]].concat());
    assert!(deep.code == 0 && deep.message.starts_with("remark: ball and ground overlap by "), "{}", deep.message);
    assert!(!deep.output.contains("overlap"), "{}", deep.output);
    let json = moreau(&[&ball[..], &["0.05", "--format", "json"]].concat());
    assert_eq!(json.message, "");
    assert!(json.json()["remarks"][0].as_str().is_some_and(|remark| remark.contains("half extent of ball")), "{}", json.output);
    let shallow = moreau(&[&ball[..], &["0.001", "--format", "json"]].concat());
    assert!(shallow.message.is_empty() && shallow.json().get("remarks").is_none(), "{}", shallow.output);
}

#[test]
fn rounding_is_shown_as_such() {
    let elastic = ["simulate", "--scene", "elastic-ball", "--step", "0.01"];
    let text = moreau(&elastic).output;
    let line = |name: &str| text.lines().find(|line| line.trim_start().starts_with(name)).unwrap_or_default().to_string();
    assert!(line("energy change").contains(" 0 J"), "{text}");
    let json = moreau(&[&elastic[..], &["--format", "json"]].concat()).json();
    let change =
        json["quantities"].as_array().expect("a list").iter().find(|one| one["name"] == "energy change").expect("a change").clone();
    let [value, bound] = [&change["value"], &change["rounding"]].map(|number| number.as_f64().expect("a number"));
    assert!(value.abs() <= bound && bound < 1e-9, "{change}");
    let fallen = moreau(&["simulate", "--scene", "ball-drop", "--step", "0.01"]).output;
    assert!(fallen.lines().any(|line| line.contains("energy change") && !line.contains("rounding") && line.contains("-9.")), "{fallen}");
}

#[test]
fn a_picture_of_many_bodies_names_every_curve_and_what_is_left_out() {
    let folder = Folder::new("simulate-many");
    let mut scene = named("ball-drop").expect("built in");
    let ball = scene.bodies[0].clone();
    scene.bodies =
        (0..19).map(|k| moreau::scenes::Body { name: format!("ball{k}"), position: [f64::from(k), 0.0, 1.1], ..ball.clone() }).collect();
    scene.bodies[18].linear_velocity = [0.01, 0.0, 0.0];
    let file = folder.file("many.json", &scene.to_json().expect("valid"));
    let plot = folder.path("many.svg");
    let run = moreau(&["simulate", "--scene", &file, "--step", "0.01", "--duration", "0.4", "--plot", &plot]);
    assert_eq!(run.code, 0, "{}", run.message);
    let picture = std::fs::read_to_string(&plot).expect("drawn");
    assert!((0..19).all(|k| picture.matches(&format!("ball{k} z\n")).count() == 2), "the legends of positions and velocities");
    assert!(picture.contains("not drawn, for they move less than a twentieth of what moves farthest: ball18 x"), "what is left out");
}

#[test]
fn a_duration_that_is_no_whole_number_of_steps_is_remarked_on_and_one_shorter_than_a_step_is_refused() {
    let run = |step: &str, duration: &str, more: &[&str]| {
        moreau(&[&["simulate", "--scene", "bouncing-ball", "--step", step, "--duration", duration][..], more].concat())
    };
    let words = ["a duration of 1 s", "steps of 0.3 s", "3 steps are made", "ends after 0.9 s"];
    let text = run("0.3", "1", &[]);
    assert!(text.code == 0 && words.iter().all(|word| text.message.contains(word)), "{}", text.message);
    let json = run("0.3", "1", &["--format", "json"]);
    let remarks = json.json()["remarks"].to_string();
    assert!(json.message.is_empty() && words.iter().all(|word| remarks.contains(word)), "{remarks}");
    for (step, duration) in [("0.25", "1"), ("1/240", "0.5"), ("0.1", "0.3")] {
        let whole = run(step, duration, &[]);
        assert!(whole.code == 0 && !whole.message.contains("whole number of steps"), "{}", whole.message);
    }
    for duration in ["1", "1.9"] {
        run("2", duration, &[]).is_refused(&["`--step`", "is 2 s", &format!("lasts {duration} s"), "less than a step", "--duration"]);
    }
    // a scene's own duration is held against the step, too
    moreau(&["simulate", "--scene", "bouncing-ball", "--step", "3"]).is_refused(&["`--step`", "is 3 s", "lasts 2 s"]);
}
