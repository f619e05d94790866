//! `moreau compare`.

use super::{Folder, Run, moreau};
use moreau::schemes::NAMES;

fn value(run: &Run, scheme: &str, quantity: &str) -> Option<f64> {
    let json = run.json();
    let schemes = json["schemes"].as_array().expect("an array");
    let scheme = schemes.iter().find(|entry| entry["name"] == scheme).expect("a scheme that was asked for");
    let quantities = scheme["quantities"].as_array().expect("an array");
    quantities.iter().find(|entry| entry["name"] == quantity).expect("a quantity of every scheme")["value"].as_f64()
}

#[test]
fn schemes_that_bounce_and_schemes_that_do_not_are_told_apart() {
    let folder = Folder::new("compare-ball");
    let plot = folder.path("ball.svg");
    let schemes = "moreau-jean,anitescu,runge-kutta-flip";
    let arguments = ["compare", "bouncing-ball", "--schemes", schemes, "--step", "0.01", "--plot", &plot, "--format", "json"];
    let run = moreau(&arguments);
    assert_eq!((run.code, run.message.as_str()), (0, ""));
    let restitution = |scheme| value(&run, scheme, "effective restitution of the first impact").expect("one contact");
    assert!((restitution("moreau-jean") - 0.5).abs() < 1e-12 && restitution("anitescu").abs() < 1e-12);
    // the flip leaves the ball below the floor, and at rest it sinks by ½ g h² a step
    assert!(value(&run, "runge-kutta-flip", "deepest penetration") > value(&run, "moreau-jean", "deepest penetration"));
    let picture = std::fs::read_to_string(&plot).expect("written");
    for words in ["moreau-jean", "anitescu", "runge-kutta-flip", "closed form", "energy [J]"] {
        assert!(picture.contains(words), "{words}");
    }
    assert_eq!((moreau(&arguments).output, std::fs::read_to_string(&plot).expect("written")), (run.output, picture), "byte for byte");
}

#[test]
fn without_names_every_scheme_runs_and_the_table_has_a_row_for_each() {
    let run = moreau(&["compare", "incline-stick", "--step", "0.02", "--duration", "0.2"]);
    assert_eq!(run.code, 0, "{}", run.message);
    for name in NAMES {
        assert!(run.output.lines().any(|line| line.starts_with(name)), "{name}: {}", run.output);
    }
}

#[test]
fn a_block_that_creeps_does_not_settle_and_one_that_sticks_does() {
    let arguments = ["compare", "incline-stick", "--schemes", "moreau-jean,mujoco", "--step", "0.01"];
    let table = moreau(&arguments);
    let row = |scheme: &str| table.output.lines().find(|line| line.starts_with(scheme)).expect("a row").to_string();
    assert!(row("mujoco").contains("does not settle"), "{}", table.output);
    assert!(!row("moreau-jean").contains("does not settle"), "{}", table.output);
    let run = moreau(&[&arguments[..], &["--format", "json"]].concat());
    assert_eq!([value(&run, "moreau-jean", "settling time"), value(&run, "mujoco", "settling time")], [Some(0.0), None]);
    assert!(value(&run, "mujoco", "creep speed at rest").expect("it is slow") > 0.0);
}

#[test]
fn a_scheme_that_fails_is_reported_and_the_others_go_on() {
    // the projected gradient is for the convex laws: Coulomb's is refused, Anitescu's is solved
    let arguments = ["compare", "incline-slide", "--schemes", "moreau-jean,anitescu", "--solver", "apgd", "--step", "0.01"];
    let run = moreau(&arguments);
    assert_eq!(run.code, 0);
    assert!(run.output.contains("moreau-jean: unsupported: solver `apgd`"), "{}", run.output);
    assert!(run.output.lines().any(|line| line.starts_with("anitescu ")), "{}", run.output);
    let none = moreau(&["compare", "incline-slide", "--schemes", "moreau-jean", "--solver", "apgd", "--step", "0.01"]);
    assert_eq!(none.code, 1);
    assert!(none.output.contains("moreau-jean: unsupported"), "{}", none.output);
}

#[test]
fn what_cannot_be_meant_is_refused_by_name() {
    moreau(&["compare", "bouncing-ball", "--schemes", "moreau-jeans"]).is_refused(&["--schemes", "did you mean `moreau-jean`"]);
    moreau(&["compare", "bouncing-ball", "--schemes", "anitescu,anitescu"]).is_refused(&["--schemes", "twice"]);
    moreau(&["compare", "bouncing-bell"]).is_refused(&["SCENE", "did you mean `bouncing-ball`"]);
    moreau(&["compare", "bouncing-ball", "--step", "0"]).is_refused(&["--step"]);
    moreau(&["compare", "bouncing-ball", "--duration", "-1"]).is_refused(&["--duration"]);
    moreau(&["compare", "bouncing-ball", "--solver", "magic"]).is_refused(&["--solver", "magic"]);
}

#[test]
fn another_time_than_the_one_asked_for_is_told_and_stands_in_json() {
    let arguments = ["compare", "bouncing-ball", "--schemes", "moreau-jean", "--step", "0.3", "--duration", "1", "--format", "json"];
    let run = moreau(&arguments);
    assert!(run.message.contains("a duration of 1 s") && run.message.contains("ends after 0.9 s"), "{}", run.message);
    assert!((run.json()["duration"].as_f64().expect("a number") - 0.9).abs() < 1e-12);
    moreau(&["compare", "bouncing-ball", "--step", "3"]).is_refused(&["`--step`", "is 3 s", "less than a step"]);
}
