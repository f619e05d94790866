//! Problems with limits and bilateral constraints: read, solved, certified, timed, and refused by name where they are not taken.

use super::{Folder, PROBLEM, moreau};

/// A bob of 2 kg at (−3, 1) m/s on a rod along (3, 4)/5 hits a wall with normal (1, 0): r = (7.5, −2.5) N·s stop it.
pub const BOB: &str = r#"{"schema": "contact-problem/1", "name": "bob", "dimension": 1, "law": "frictionless", "friction": [0, 0],
  "kinds": ["contact", {"bilateral": 1}], "free_velocity": [-3, -1],
  "mass": {"shape": [2, 2], "rows": [[2, 0], [0, 2]]}, "jacobian": {"shape": [2, 2], "rows": [[1, 0], [0.6, 0.8]]}}"#;

/// The block in space beside a slider of 3 kg that reaches its stop at 2 m/s, and two pins that hold one body, the second of them twice.
const SLIDER: &str = r#"{"schema": "contact-problem/1", "name": "slider", "dimension": 3, "law": "coulomb", "friction": [0, 0.5, 0, 0],
  "kinds": ["limit", "contact", {"bilateral": 2}, {"bilateral": 1}], "free_velocity": [-2, -1, 2, 0, 1, 2, 2],
  "mass": {"shape": [6, 6], "diagonal_blocks": [[3], [1, 0, 0, 0, 1, 0, 0, 0, 1], [4, 0, 0, 4]]},
  "jacobian": {"shape": [7, 6], "sparse_rows": {"starts": [0, 1, 2, 3, 4, 5, 6, 7], "column": [0, 1, 2, 3, 4, 5, 5],
    "value": [1, 1, 1, 1, 1, 1, 1]}}}"#;

/// The slider with pins that contradict each other: it is read, and refused when it is solved.
pub fn contradicting() -> String {
    SLIDER.replace("1, 2, 2]", "1, 2, 3]")
}

fn numbers(value: &serde_json::Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|number| number.as_f64().expect("a number")).collect()
}

#[test]
fn joints_are_solved_certified_and_timed_by_every_solver_that_takes_the_contacts() {
    let folder = Folder::new("joints");
    let cases = [("bob", BOB, vec![7.5, -2.5]), ("slider", SLIDER, vec![6.0, 1.0, -0.5, 0.0, -4.0, -8.0, 0.0])];
    for (name, text, expected) in cases {
        let (problem, answer) = (folder.file(&format!("{name}.json"), text), folder.path("answer.json"));
        for solver in ["auto", "pgs", "nonsmooth-newton", "interior-point"] {
            let run = moreau(&["solve", &problem, "--solver", solver, "--out", &answer]);
            assert_eq!(run.code, 0, "{name}, {solver}: {}{}", run.output, run.message);
            assert!(run.output.contains("bilateral constraints: ") && run.output.contains("  bilateral  "), "{}", run.output);
            let written: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&answer).expect("written")).expect("JSON");
            let found = numbers(&written["impulse"]);
            assert!(found.iter().zip(&expected).all(|(one, other)| (one - other).abs() < 1e-7), "{name}, {solver}: {found:?}");
            let certified = moreau(&["certify", &problem, &answer, "--format", "json"]);
            assert_eq!(certified.code, 0, "{}", certified.output);
            assert!(certified.json()["residuals"]["bilateral"]["unit"] == "m/s" && certified.json()["bilateral"].is_u64());
        }
        let bench = moreau(&["bench", &problem, "--repeat", "0", "--format", "json"]);
        assert!(bench.code == 0 && bench.json()["runs"][0]["relative"].as_f64().expect("judged") <= 1e-8);
        let again = moreau(&["solve", &problem, "--start", &answer, "--law", "frictionless"]);
        assert_eq!(again.code, 0, "{}", again.message);
    }
}

#[test]
fn an_answer_with_the_wrong_sign_of_a_joint_is_rejected_there() {
    let folder = Folder::new("joints-sign");
    let problem = folder.file("bob.json", BOB);
    let answer = |impulse: &str, velocity: &str| {
        let text = format!(r#"{{"schema": "solution/1", "problem": "bob", "impulse": {impulse}, "velocity": {velocity}}}"#);
        let file = folder.file("answer.json", &text);
        moreau(&["certify", &problem, &file, "--format", "json"])
    };
    assert_eq!(answer("[7.5, -2.5]", "[0, 0]").code, 0);
    for (impulse, velocity) in [("[7.5, 2.5]", "[1.5, 2.5]"), ("[6, 0]", "[0, 0.8]")] {
        let run = answer(impulse, velocity);
        assert!(run.code == 1 && run.json()["residuals"]["bilateral"]["relative"].as_f64().expect("a number") > 0.1, "{}", run.output);
    }
}

#[test]
fn joints_are_converted_to_json_and_read_again() {
    let folder = Folder::new("joints-converted");
    let (bob, again) = (folder.file("bob.json", BOB), folder.path("again.json"));
    assert_eq!(moreau(&["convert", &bob, "--out", &again]).code, 0);
    let answers = [&bob, &again].map(|problem| moreau(&["solve", problem]).output);
    assert_eq!(answers[0], answers[1]);
}

#[test]
fn what_is_not_done_with_joints_is_refused_by_name() {
    let folder = Folder::new("joints-refused");
    let (bob, block) = (folder.file("bob.json", BOB), folder.file("block.json", PROBLEM));
    let answer = folder.path("answer.json");
    assert_eq!(moreau(&["solve", &bob, "--out", &answer]).code, 0);
    let newton = moreau(&["solve", &bob, "--solver", "newton"]);
    assert!(newton.code == 1 && newton.message.contains("once the joints are eliminated"), "{}", newton.message);
    moreau(&["convert", &bob, "--out", &folder.path("bob.hdf5")]).is_refused(&["bob.json", "kinds", "moreau solve"]);
    moreau(&["problems", "measure", &bob]).is_refused(&["bob.json", "kinds"]);
    moreau(&["certify", &block, &answer]).is_refused(&["answer.json", "problem"]);
    let rolling = PROBLEM.replace("\"dimension\": 2", "\"dimension\": 4");
    moreau(&["solve", &folder.file("rolling.json", &rolling)]).is_refused(&["dimension", "rolling and drilling", "bilateral"]);
    moreau(&["solve", &folder.file("contradicting.json", &contradicting())]).is_refused(&["kinds[", "contradicts"]);
    let refused = moreau(&["solve", &folder.file("slider.json", SLIDER), "--solver", "lemke"]);
    assert!(refused.code == 1 && refused.message.contains("use `auto`, `pgs`"), "{}", refused.message);
}

/// One rod twice, with these velocities along it.
fn rods(velocities: &str) -> String {
    format!(
        r#"{{"schema": "contact-problem/1", "name": "rods", "dimension": 1, "law": "frictionless", "friction": [0, 0],
            "kinds": [{{"bilateral": 1}}, {{"bilateral": 1}}], "free_velocity": {velocities},
            "delassus": {{"shape": [2, 2], "rows": [[1, 1], [1, 1]]}}}}"#
    )
}

#[test]
fn answers_with_joints_are_proved_and_a_moved_one_is_as_far_as_it_was_moved() {
    let folder = Folder::new("joints-proved");
    for (name, text) in [("bob", BOB), ("slider", SLIDER)] {
        let (problem, answer) = (folder.file(&format!("{name}.json"), text), folder.path("answer.json"));
        assert_eq!(moreau(&["solve", &problem, "--out", &answer]).code, 0);
        let run = moreau(&["certify", &problem, &answer, "--prove"]);
        assert_eq!(run.code, 0, "{}{}", run.output, run.message);
        for said in ["proved in fractions: impulses", "proved by intervals: the problem has a solution", "at a constraint"] {
            assert!(run.output.contains(said), "{said}: {}", run.output);
        }
        let json = moreau(&["certify", &problem, &answer, "--prove", "--format", "json"]).json();
        let held = json["forward"]["radius"]["states"].as_array().expect("a list").iter().filter(|state| *state == "held").count();
        assert_eq!(json["bilateral"].as_u64(), Some(held as u64), "{json}");
        assert!(json["backward"]["velocity"].as_f64().expect("a number") < 1e-12, "{json}");
    }
    let bob = folder.file("bob.json", BOB);
    let moved = folder.file("moved.json", r#"{"schema": "solution/1", "problem": "bob", "impulse": [7.5, -2.25]}"#);
    let run = moreau(&["certify", &bob, &moved, "--prove", "--format", "json"]);
    let [velocity, impulse] = ["velocity", "impulse"].map(|name| run.json()["forward"]["radius"][name].as_f64().expect("proved"));
    assert!(run.code == 1 && velocity >= 0.124 && (0.25..0.251).contains(&impulse), "{}", run.output);
    assert!(run.json()["backward"]["velocity"].as_f64().expect("proved") >= 0.124, "{}", run.output);
}

#[test]
fn joints_that_contradict_each_other_are_refuted_and_those_that_agree_to_rounding_are_not_denied() {
    let folder = Folder::new("joints-refuted");
    let answer = folder.file("answer.json", r#"{"schema": "solution/1", "problem": "rods", "impulse": [0.5, 0.5], "velocity": [0, 0]}"#);
    let run = |velocities: &str, more: &[&str]| {
        let problem = folder.file("rods.json", &rods(velocities));
        moreau(&[&["certify", &problem, &answer, "--prove"], more].concat())
    };
    let same = run("[-1, -1]", &[]);
    assert!(
        same.code == 0 && same.output.contains("a set of exactly 1 dimension") && !same.output.contains("there is no"),
        "{}",
        same.output
    );
    let other = run("[-1, -1.5]", &["--format", "json"]);
    assert_eq!((other.code, &other.json()["status"]), (1, &"infeasible".into()), "{}", other.output);
    assert_eq!(other.json()["solutions"]["infeasible"]["witness"].as_array().map(Vec::len), Some(2));
    assert!(other.json()["forward"]["reason"].as_str().expect("none near").contains("constraint "), "{}", other.output);
    let nearly = run("[-1, -1.0000000000000002]", &[]);
    assert!(nearly.code == 0 && nearly.output.contains("agree up to rounding"), "{}", nearly.output);
}
