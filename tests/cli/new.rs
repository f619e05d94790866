//! `moreau new`: every file to begin with is taken as it is by the command that it is for.

use super::joints::BOB;
use super::{Folder, Run, moreau};
use std::process::Command;

/// A file to begin with, written into the folder.
#[track_caller]
fn written(folder: &Folder, what: &[&str], name: &str) -> String {
    let file = folder.path(name);
    let run = moreau(&[&["new"], what, &["--out", &file]].concat());
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.message);
    assert!(run.message.contains(&file), "what to do with it: {}", run.message);
    file
}

/// The program of another language, unless it is missing here.
fn program(name: &str) -> Option<&str> {
    let found = Command::new(name).arg("--version").output().is_ok_and(|run| run.status.success());
    if !found {
        println!("skipped: {name} is not installed, so that its engine cannot be run");
    }
    found.then_some(name)
}

#[test]
fn a_new_problem_is_solved_and_the_answer_certified() {
    let folder = Folder::new("new-problem");
    let (problem, answer) = (written(&folder, &["problem"], "problem.json"), folder.path("answer.json"));
    assert_eq!(moreau(&["solve", &problem, "--out", &answer]).code, 0);
    assert_eq!(moreau(&["certify", &problem, &answer]).code, 0);
}

#[test]
fn a_new_solution_has_the_size_of_its_problem_and_is_judged() {
    let folder = Folder::new("new-solution");
    let lcp = r#"{"schema": "lcp/1", "matrix": {"shape": [2, 2], "rows": [[2, 0], [0, 2]]}, "vector": [-1, 1]}"#;
    for (name, text, rows) in [("block.json", super::PROBLEM, 2), ("lcp.json", lcp, 2), ("bob.json", BOB, 2)] {
        let problem = folder.file(name, text);
        let solution = written(&folder, &["solution", &problem], &format!("zero-{name}"));
        let text = std::fs::read_to_string(&solution).expect("written");
        let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(json["impulse"].as_array().map(Vec::len), Some(rows), "{text}");
        let run = moreau(&["certify", &problem, &solution]);
        assert_eq!(run.code, 1, "no impulse is no solution: {}{}", run.output, run.message);
    }
    moreau(&["new", "solution", &folder.path("absent.json")]).is_refused(&["absent.json"]);
}

#[test]
fn a_new_scene_is_simulated_and_compared() {
    let folder = Folder::new("new-scene");
    let scene = written(&folder, &["scene"], "scene.json");
    let run = moreau(&["simulate", "--scene", &scene, "--step", "0.005"]);
    assert_eq!((run.code, run.message.as_str()), (0, ""), "{}", run.output);
    let run = moreau(&["compare", &scene, "--schemes", "moreau-jean,stewart-trinkle,anitescu", "--step", "0.01"]);
    assert!(run.code == 0 && !run.output.contains("unsupported"), "{}{}", run.output, run.message);
}

/// The engine passes the probes of its adapter and gets verdicts, none of them bad.
fn gets_verdicts(command: &[&str]) {
    let check = moreau(&[&["protocol-check", "--"], command].concat());
    assert!(check.code == 0 && check.output.contains(" 0 problems"), "{}{}", check.output, check.message);
    let run = moreau(&[&["gate", "--quick", "--only", "ball/,flight/", "--format", "json", "--"], command].concat());
    let count = |run: &Run, word: &str| {
        let json = run.json();
        let checks = json["report"]["checks"].as_array().expect("a list").clone();
        checks.iter().filter(|check| check["verdict"] == word).count()
    };
    assert_eq!(run.code, 0, "{}{}", run.output, run.message);
    assert!(count(&run, "pass") >= 4, "{}", run.output);
    assert_eq!(count(&run, "fail") + count(&run, "errored"), 0, "{}", run.output);
}

#[test]
fn the_engine_in_python_gets_verdicts() {
    let folder = Folder::new("new-python");
    let file = written(&folder, &["engine", "--language", "python"], "my_engine.py");
    program("python3").into_iter().for_each(|python| gets_verdicts(&[python, &file]));
}

#[test]
fn the_engine_in_javascript_gets_verdicts() {
    let folder = Folder::new("new-javascript");
    let file = written(&folder, &["engine", "--language", "javascript"], "my_engine.js");
    program("node").into_iter().for_each(|node| gets_verdicts(&[node, &file]));
}

#[test]
fn the_engine_in_rust_is_the_example_that_is_compiled_here() {
    let run = moreau(&["new", "engine", "--language", "rust"]);
    assert_eq!((run.code, run.output.as_str()), (0, include_str!("../../examples/adapter.rs")));
    assert!(run.message.contains("cargo add --path"), "{}", run.message);
}

#[test]
fn nothing_is_written_over() {
    let folder = Folder::new("new-over");
    let file = folder.file("mine.json", "mine");
    for what in [&["problem"][..], &["scene"], &["engine", "--language", "rust"]] {
        moreau(&[&["new"], what, &["--out", &file]].concat()).is_refused(&["--out", "mine.json", "there already"]);
    }
    assert_eq!(std::fs::read_to_string(&file).expect("still there"), "mine");
    assert_eq!(moreau(&["new"]).code, 2);
    assert_eq!(moreau(&["new", "engine", "--language", "fortran"]).code, 2);
}

#[test]
fn without_a_file_it_goes_to_standard_output_and_the_advice_beside_it() {
    let run = moreau(&["new", "problem"]);
    assert_eq!((run.code, run.json()["schema"].as_str()), (0, Some("contact-problem/1")));
    assert!(run.message.contains("moreau solve FILE"), "{}", run.message);
}
