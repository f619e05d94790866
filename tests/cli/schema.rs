//! `moreau schema`.

use super::{Folder, PROBLEM, moreau};

#[test]
fn the_formats_are_listed_and_each_is_printed_as_stored() {
    let list = moreau(&["schema", "--format", "json"]).json();
    let names: Vec<_> = list.as_array().expect("a list").iter().map(|entry| entry["name"].as_str().expect("a name").to_string()).collect();
    assert!(names.contains(&"trajectory".to_string()) && names.contains(&"request".to_string()), "{names:?}");
    let folder = Folder::new("schema");
    assert_eq!(moreau(&["schema", "--write", &folder.path("")]).code, 0);
    for name in names {
        let printed = moreau(&["schema", &name]);
        assert_eq!(printed.code, 0);
        let written = std::fs::read_to_string(folder.path(&format!("{name}.schema.json"))).expect("written");
        assert_eq!(printed.output, written);
    }
}

#[test]
fn an_unknown_format_is_refused_with_the_nearest() {
    moreau(&["schema", "trajectry"]).is_refused(&["`trajectry`", "trajectory"]);
    moreau(&["schema", "--write", "/nowhere/at/all"]).is_refused(&["/nowhere/at/all"]);
}

#[test]
fn what_verify_writes_is_as_its_schema_says() {
    let runs: [(&str, &[&str]); 3] = [
        ("verify", &["verify", "--filter", "S12"]),
        ("verify-list", &["verify", "--list"]),
        ("verify-explain", &["verify", "--explain", "S3.drift"]),
    ];
    for (name, command) in runs {
        let schema = moreau(&["schema", name]).json();
        let validator = jsonschema::validator_for(&schema).expect("a schema");
        let written = moreau(&[command, &["--format", "json"]].concat()).json();
        let errors: Vec<String> = validator.iter_errors(&written).map(|error| format!("{}: {error}", error.instance_path())).collect();
        assert!(errors.is_empty(), "{name}: {errors:?}");
        // a verdict that there is none of
        let mut other = written.clone();
        let claim = if other.is_array() { &mut other[0] } else { &mut other };
        claim["verdict"] = "PERHAPS".into();
        assert!(!validator.is_valid(&other), "{name}");
    }
}

#[test]
fn what_verify_exports_is_as_its_schema_says() {
    let folder = Folder::new("witnesses");
    let file = folder.path("witnesses.json");
    assert_eq!(moreau(&["verify", "--filter", "S4", "--export", &file]).code, 0);
    let written: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&file).expect("written")).expect("JSON");
    let validator = jsonschema::validator_for(&moreau(&["schema", "witnesses"]).json()).expect("a schema");
    let errors: Vec<String> = validator.iter_errors(&written).map(|error| format!("{}: {error}", error.instance_path())).collect();
    assert!(errors.is_empty(), "{errors:?}");
    for (place, wrong) in [("/schema", "witnesses/2"), ("/claims/0/witnesses/0/kind", "7"), ("/claims/0/findings/0/relation", "nearly")] {
        let mut other = written.clone();
        *other.pointer_mut(place).expect("it is there") = if wrong == "7" { 7.into() } else { wrong.into() };
        assert!(!validator.is_valid(&other), "{place}");
    }
    let length = written["claims"].as_array().expect("a list").len() as u64;
    assert_eq!(written["selected"]["group"], "S4");
    assert!(written["of"].as_u64().expect("a number") > length && written["counts"]["claims"] == length);
    moreau(&["verify", "--filter", "S4", "--export", "-"]).is_refused(&["--export", "file"]);
}

/// That the output of a command is as a schema says, and that it is not once the value at a place is another one.
#[track_caller]
pub fn is_as(name: &str, written: &serde_json::Value, place: &str, wrong: serde_json::Value) {
    let validator = jsonschema::validator_for(&moreau(&["schema", name]).json()).expect("a schema");
    let errors: Vec<String> = validator.iter_errors(written).map(|error| format!("{}: {error}", error.instance_path())).collect();
    assert!(errors.is_empty(), "{name}: {errors:?}");
    let mut other = written.clone();
    *other.pointer_mut(place).unwrap_or_else(|| panic!("{name} has {place}: {written}")) = wrong;
    assert!(!validator.is_valid(&other), "{name}: {place}");
}

const LCP: &str = r#"{"schema": "lcp/1", "name": "two", "matrix": {"shape": [2, 2], "rows": [[1, 2], [2, 1]]}, "vector": [-1, -1]}"#;

#[test]
fn what_solve_and_certify_write_is_as_their_schemas_say() {
    let folder = Folder::new("schema-solve");
    let (problem, lcp, answer) = (folder.file("p.json", PROBLEM), folder.file("l.json", LCP), folder.path("answer.json"));
    for file in [&problem, &lcp] {
        let solved = moreau(&["solve", file, "--out", &answer, "--history", "--format", "json"]);
        assert_eq!(solved.code, 0, "{}", solved.message);
        is_as("certificate", &solved.json(), "/status", "perhaps".into());
        is_as("certificate", &solved.json(), "/residuals/dual/unit", 7.into());
        let written: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&answer).expect("written")).expect("JSON");
        is_as("solution", &written, "/impulse/0", "much".into());
        is_as("certificate", &moreau(&["certify", file, &answer, "--format", "json"]).json(), "/solution", 1.into());
        let proved = moreau(&["certify", file, &answer, "--prove", "--format", "json"]).json();
        is_as("certificate", &proved, "/backward/velocity", "small".into());
        if file == &lcp {
            is_as("certificate", &proved, "/lcp/solutions", "many".into());
        } else {
            is_as("certificate", &proved, "/forward/proved", "yes".into());
        }
    }
    let bob = folder.file("bob.json", super::joints::BOB);
    let jointed = moreau(&["solve", &bob, "--out", &answer, "--format", "json"]);
    is_as("certificate", &jointed.json(), "/residuals/bilateral/unit", 7.into());
    let posed: serde_json::Value = serde_json::from_str(super::joints::BOB).expect("JSON");
    is_as("contact-problem", &posed, "/kinds/1/bilateral", 7.into());
    is_as("lcp-count", &moreau(&["certify", &lcp, "--prove", "--format", "json"]).json(), "/status", "perhaps".into());
    let refused = moreau(&["solve", &problem, "--solver", "apgd", "--out", &answer, "--format", "json"]);
    assert_eq!(refused.code, 1);
    is_as("no-answer", &refused.json(), "/status", "perhaps".into());
}

#[test]
fn a_rejected_answer_and_one_that_is_no_number_are_as_the_schema_says() {
    let folder = Folder::new("schema-rejected");
    let problem = folder.file("p.json", &PROBLEM.replace("[-1, 2]", "[-1, 1e300]"));
    let answer = folder.file("a.json", r#"{"schema": "solution/1", "problem": "block", "impulse": [1e300, 1e300], "velocity": [0, 0]}"#);
    let run = moreau(&["certify", &problem, &answer, "--format", "json"]);
    assert_eq!(run.code, 1);
    let written = run.json();
    is_as("certificate", &written, "/tolerance", "small".into());
    assert!(run.output.contains("null"), "an overflow is null: {}", run.output);
}

#[test]
fn what_simulate_measure_and_bench_write_is_as_their_schemas_say() {
    let folder = Folder::new("schema-more");
    let problem = folder.file("p.json", PROBLEM);
    let simulated = moreau(&["simulate", "--scene", "bouncing-ball", "--step", "0.01", "--format", "json"]).json();
    is_as("simulation", &simulated, "/quantities/0/unit", 7.into());
    is_as("simulation", &simulated, "/steps/rejected", "none".into());
    let measured = moreau(&["problems", "measure", &problem, "--format", "json"]).json();
    is_as("measured-problem", &measured, "/solvers/0/ended", "well".into());
    let bench = moreau(&["bench", &problem, "--solver", "auto", "--solver", "apgd", "--repeat", "0", "--format", "json"]).json();
    is_as("bench", &bench, "/runs/0/seconds", "few".into());
    let listed = moreau(&["problems", "list", "--group", "painleve", "--format", "json"]).json();
    is_as("problems", &listed, "/0/uniqueness", "perhaps".into());
    is_as("answered-problem", &moreau(&["problems", "show", "single-slide", "--format", "json"]).json(), "/contacts", "one".into());
}

#[test]
fn the_stored_report_on_peers_is_as_its_schema_says() {
    let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/benchmarks/peers.json");
    let written: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(file).expect("stored")).expect("JSON");
    is_as("peers", &written, "/problems/0/results/0/reached", "yes".into());
    is_as("peers", &written, "/schema", "peers/2".into());
    let mut with_more = written.clone();
    with_more["summary"][0]["guess"] = 1.into();
    assert!(!jsonschema::validator_for(&moreau(&["schema", "peers"]).json()).expect("a schema").is_valid(&with_more));
}
