//! `moreau solve`.

use super::{Folder, PROBLEM, moreau};
use serde_json::Value;

#[test]
fn the_solution_goes_to_standard_output_and_its_certificate_beside_it() {
    let folder = Folder::new("solve-stdout");
    let run = moreau(&["solve", &folder.file("problem.json", PROBLEM)]);
    assert_eq!(run.code, 0, "{}", run.message);
    let solution = run.json();
    assert_eq!((&solution["schema"], &solution["problem"]), (&"solution/1".into(), &"block".into()));
    for (field, expected) in [("impulse", [1.0, -0.5]), ("velocity", [0.0, 1.5])] {
        for (k, value) in expected.into_iter().enumerate() {
            assert!((solution[field][k].as_f64().expect("a number") - value).abs() <= 1e-12, "{field}: {}", solution[field]);
        }
    }
    assert_eq!(solution["residuals"]["natural_map"]["unit"], "N·s");
    assert!(run.message.contains("N·s") && run.message.contains("m/s") && run.message.contains("a solution"), "{}", run.message);
}

#[test]
fn a_file_gets_the_solution_and_standard_output_the_certificate() {
    let folder = Folder::new("solve-out");
    let problem = folder.file("problem.json", PROBLEM);
    let run = moreau(&["solve", &problem, "--solver", "pgs", "--out", &folder.path("answer.json"), "--format", "json"]);
    assert_eq!((run.code, run.message.as_str()), (0, ""));
    let certificate = run.json();
    assert_eq!((&certificate["solution"], &certificate["solver"]), (&Value::Bool(true), &"pgs".into()));
    assert_eq!(certificate["status"], "solved");
    assert_eq!(folder.names(), ["answer.json", "problem.json"]);
    assert_eq!(moreau(&["certify", &problem, &folder.path("answer.json")]).code, 0);
}

#[test]
fn every_solver_that_answers_passes_its_certificate_and_one_outside_its_scope_says_so() {
    let folder = Folder::new("solve-all");
    let problem = folder.file("problem.json", PROBLEM);
    for solver in moreau::solvers::ALL.names() {
        let run = moreau(&["solve", &problem, "--solver", solver]);
        match run.code {
            0 => assert_eq!(run.json()["schema"], "solution/1"),
            1 => assert!(run.output.is_empty() && run.message.starts_with("error: ") && run.message.contains(solver), "{}", run.message),
            code => panic!("{solver}: exit code {code}: {}", run.message),
        }
    }
    // Coulomb's law is not convex: a solver for convex problems refuses it
    for solver in ["apgd", "clarabel"] {
        let run = moreau(&["solve", &problem, "--solver", solver]);
        assert!(run.code == 1 && run.message.contains("`coulomb`; use `auto`, `"), "{}", run.message);
    }
}

#[test]
fn the_status_in_json_tells_how_a_solver_ended() {
    let folder = Folder::new("solve-status");
    let answer = folder.path("answer.json");
    let status = |problem: &str, solver: &str, more: &[&str]| {
        let run = moreau(&[&["solve", problem, "--solver", solver, "--out", &answer, "--format", "json"], more].concat());
        assert_eq!((run.code, run.message.as_str()), (1, ""), "{solver}");
        run.json()["status"].clone()
    };
    let empty = folder.file("empty.json", &PROBLEM.replace("[[1, 0], [0, 1]]", "[[0, 0], [0, 0]]"));
    assert_eq!(status(&empty, "lemke", &[]), "infeasible", "nothing stops what W = 0 does not move, and that is proved");
    let problem = folder.file("problem.json", PROBLEM);
    assert_eq!(status(&problem, "clarabel", &[]), "refused");
    let heavy = folder.file("heavy.json", &PROBLEM.replace("[[1, 0], [0, 1]]", "[[1e-320, 0], [0, 1e-320]]"));
    assert_eq!(status(&heavy, "pgs", &[]), "breakdown");
    // one sweep is not enough where the contact's rows depend on each other
    let coupled = folder.file("coupled.json", &PROBLEM.replace("[[1, 0], [0, 1]]", "[[1, 0.9], [0.9, 1]]"));
    assert_eq!(status(&coupled, "apgd", &[]), "refused");
    assert_eq!(status(&coupled, "psor", &["--iterations", "1"]), "limit");
    assert_eq!(status(&empty, "admm", &["--iterations", "20"]), "infeasible");
    assert!(folder.names().contains(&"answer.json".into()), "a rejected answer is written");
    // without a file the answer would be on standard output, where nothing else may be
    let run = moreau(&["solve", &problem, "--solver", "clarabel", "--format", "json"]);
    assert!(run.output.is_empty() && run.message.contains("\"status\": \"refused\""), "{}", run.message);
}

#[test]
fn a_problem_without_a_solution_has_none_and_nothing_is_written() {
    let folder = Folder::new("solve-none");
    // W = 0 cannot stop what arrives
    let problem = folder.file("problem.json", &PROBLEM.replace("[[1, 0], [0, 1]]", "[[0, 0], [0, 0]]"));
    for solver in ["lemke", "pgs"] {
        let run = moreau(&["solve", &problem, "--solver", solver, "--out", &folder.path("answer.json")]);
        assert_eq!(run.code, 1, "{solver}: {}{}", run.output, run.message);
    }
}

#[test]
fn bad_problems_are_refused_by_file_and_field_and_nothing_is_written() {
    let folder = Folder::new("solve-bad");
    let changes = [
        ("negative.json", "[0.5]", "[-0.5]", "friction[0]"),
        ("nan.json", "[-1, 2]", "[-1, NaN]", "free_velocity"),
        ("infinite.json", "[-1, 2]", "[-1, 1e999]", "free_velocity"),
        ("size.json", "[-1, 2]", "[-1, 2, 3]", "free_velocity"),
        ("shape.json", "\"shape\": [2, 2]", "\"shape\": [3, 3]", "delassus"),
        ("ragged.json", "[[1, 0], [0, 1]]", "[[1, 0], [0]]", "delassus.rows[1]"),
        ("law.json", "coulomb", "newton", "law"),
        ("schema.json", "contact-problem/1", "contact-problem/7", "schema"),
        ("misspelt.json", "\"friction\"", "\"fricton\"", "fricton"),
        ("broken.json", "]}}", "", "JSON"),
        ("junk.json", "]}}", "]}} }", "not valid JSON"),
        ("list.json", PROBLEM, "[1, 2]", "not a JSON object"),
        ("extra.json", "]}}", "]}, \"colour\": 1}", "field `colour`"),
        ("twice.json", "]}}", "]}, \"law\": \"coulomb\"}", "field `law`"),
        ("lacking.json", "\"friction\": [0.5],", "", "field `friction`"),
    ];
    for (name, from, to, field) in changes {
        assert!(PROBLEM.contains(from), "{from}");
        let file = folder.file(name, &PROBLEM.replace(from, to));
        moreau(&["solve", &file, "--out", &folder.path("answer.out")]).is_refused(&[name, field]);
    }
    let mass = r#""mass": {"shape": [2, 2], "rows": [[-1, 0], [0, 1]]}, "jacobian": {"shape": [2, 2], "rows": [[1, 0], [0, 1]]}"#;
    let file = folder.file("mass.json", &PROBLEM.replace(r#""delassus": {"shape": [2, 2], "rows": [[1, 0], [0, 1]]}"#, mass));
    moreau(&["solve", &file, "--out", &folder.path("answer.out")]).is_refused(&["mass.json", "mass"]);
    let operator = r#""delassus": {"shape": [2, 2], "rows": [[1, 0], [0, 1]]}"#;
    let one = r#"{"shape": [2, 2], "rows": [[1, 0], [0, 1]]}"#;
    for (name, given, missing) in [
        ("no-jacobian.json", format!("\"mass\": {one}"), ["`jacobian`", "is missing"]),
        ("no-mass.json", format!("\"jacobian\": {one}"), ["`mass`", "is missing"]),
        ("no-operator.json", "\"shift\": [0, 0]".into(), ["`delassus`", "is missing"]),
        ("both.json", format!("{operator}, \"mass\": {one}"), ["`delassus`", "stands beside"]),
    ] {
        let file = folder.file(name, &PROBLEM.replace(operator, &given));
        moreau(&["solve", &file, "--out", &folder.path("answer.out")]).is_refused(&[&[name], &missing[..]].concat());
    }
    moreau(&["solve", &folder.path("missing.json")]).is_refused(&["missing.json", "cannot read"]);
    let good = folder.file("good.json", PROBLEM);
    moreau(&["solve", &good, "--solver", "magic"]).is_refused(&["--solver", "magic", "pgs"]);
    moreau(&["solve", &good, "--out", &folder.path("nowhere/answer.out")]).is_refused(&[
        "nowhere",
        "there is no folder",
        "make the folder",
    ]);
    moreau(&["solve", &good, "--out", &folder.path("./good.json")]).is_refused(&["--out", "good.json", "another file"]);
    assert_eq!(std::fs::read_to_string(&good).expect("still there"), PROBLEM);
    assert!(folder.names().iter().all(|name| name.ends_with(".json")), "{:?}", folder.names());
}

#[test]
fn a_pipe_gets_the_answer_and_an_answer_that_is_no_number_goes_nowhere() {
    let folder = Folder::new("solve-pipe");
    let problem = folder.file("problem.json", PROBLEM);
    if cfg!(unix) {
        // standard output is a pipe here: it receives the solution, then the certificate
        let run = moreau(&["solve", &problem, "--out", "/dev/stdout"]);
        assert_eq!(run.code, 0, "{}", run.message);
        assert!(run.output.starts_with("{\"schema\":\"solution/1\"") && run.output.contains("a solution to"), "{}", run.output);
    }
    let heavy = folder.file("heavy.json", &PROBLEM.replace("[[1, 0], [0, 1]]", "[[1e-320, 0], [0, 1e-320]]"));
    for solver in ["pgs", "lemke"] {
        let run = moreau(&["solve", &heavy, "--solver", solver, "--out", &folder.path("answer.json")]);
        assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.message);
    }
    assert_eq!(folder.names(), ["heavy.json", "problem.json"]);
}

#[test]
fn a_problem_too_large_for_memory_is_refused_before_it_is_built() {
    let folder = Folder::new("solve-large");
    let spatial = PROBLEM.replace("[-1, 2]", "[-1, 2, 0]").replace(r#""dimension": 2"#, r#""dimension": 3"#);
    let spatial = spatial.replace("[2, 2], \"rows\": [[1, 0], [0, 1]]", "[3, 3], \"rows\": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]");
    for (directions, refused) in [(8, false), (8191, true), (1_000_000_000, true), (usize::MAX, true)] {
        let law = format!(r#""law": "polyhedral-coulomb", "directions": {directions}"#);
        let file = folder.file("large.json", &spatial.replace(r#""law": "coulomb""#, &law));
        let run = moreau(&["solve", &file]);
        if refused {
            run.is_refused(&["large.json", if directions == 8191 { "directions" } else { "--max-memory" }]);
        } else {
            assert_eq!(run.code, 0, "{}", run.message);
        }
    }
    // a unit mass matrix with 12000 rows is a small file and 144 million numbers
    let places = (0..12_000).map(|k: usize| k.to_string()).collect::<Vec<_>>().join(",");
    let ones = vec!["1"; 12_000].join(",");
    let mass = format!(r#"{{"shape": [12000, 12000], "triplets": {{"row": [{places}], "column": [{places}], "value": [{ones}]}}}}"#);
    let jacobian = r#"{"shape": [2, 12000], "triplets": {"row": [0, 1], "column": [0, 1], "value": [1, 1]}}"#;
    let fields = format!(r#""mass": {mass}, "jacobian": {jacobian}"#);
    let text = PROBLEM.replace(r#""delassus": {"shape": [2, 2], "rows": [[1, 0], [0, 1]]}"#, &fields);
    moreau(&["solve", &folder.file("mass.json", &text)]).is_refused(&["mass.json", "field `mass`", "dense"]);
}

#[test]
fn a_start_the_history_and_the_tolerance_that_was_asked_for() {
    let folder = Folder::new("solve-start");
    let problem = folder.file("problem.json", &PROBLEM.replace("[[1, 0], [0, 1]]", "[[1, 0.9], [0.9, 1]]"));
    let [answer, again] = ["answer.json", "again.json"].map(|name| folder.path(name));
    let solve = |more: &[&str]| {
        let run = moreau(&[&["solve", &problem, "--solver", "admm", "--history", "--format", "json"], more].concat());
        assert_eq!(run.code, 0, "{}{}", run.output, run.message);
        let json = run.json();
        let history: Vec<f64> = json["history"].as_array().unwrap().iter().map(|entry| entry.as_f64().unwrap()).collect();
        (json, history)
    };
    let (cold, history) = solve(&["--tolerance", "1e-10", "--out", &answer]);
    assert!(history.len() > 1 && history[0] > 1e-10 && *history.last().unwrap() <= 0.5e-10, "{history:?}");
    assert_eq!((&cold["status"], &cold["reproducible"]), (&"solved".into(), &true.into()));
    let (coarse, short) = solve(&["--tolerance", "0.01", "--out", &again]);
    assert!(short.len() < history.len(), "what is asked for is less work: {short:?}");
    assert!(coarse["iterations"].as_u64() < cold["iterations"].as_u64());
    let (warm, none) = solve(&["--tolerance", "1e-9", "--start", &answer, "--out", &again]);
    assert!(none.len() <= history.len() && warm["iterations"].as_u64() < cold["iterations"].as_u64(), "{none:?}");
    let short = folder.file("short.json", r#"{"schema": "solution/1", "impulse": [1], "velocity": [0]}"#);
    moreau(&["solve", &problem, "--start", &short]).is_refused(&["short.json", "has size 1"]);
}

#[test]
fn numbers_too_large_to_be_squared_are_told_in_words_and_the_answer_is_rejected() {
    let folder = Folder::new("solve-huge");
    let answer = folder.path("answer.json");
    for (fast, mass) in [("1e308", "1"), ("1.7e308", "1"), ("1e308", "1e-308"), ("1", "1e-308")] {
        let huge =
            PROBLEM.replace("[-1, 2]", &format!("[-{fast}, {fast}]")).replace("[[1, 0], [0, 1]]", &format!("[[{mass}, 0], [0, {mass}]]"));
        let problem = folder.file("huge.json", &huge);
        for solver in ["auto", "pgs", "psor"] {
            let run = moreau(&["solve", &problem, "--solver", solver, "--out", &answer, "--history"]);
            let said = format!("{}{}", run.output, run.message);
            assert!(run.code == 1 && !said.contains("NaN"), "{fast} {mass} {solver}: {said}");
            assert!(said.contains("is no number, so that nothing is shown") || said.contains("too large for a number"), "{said}");
            if let Ok(written) = std::fs::read_to_string(&answer) {
                assert!(!written.contains("NaN") && !written.contains("\"impulse\":[null"), "{written}");
                std::fs::remove_file(&answer).expect("removable");
            }
        }
    }
}

#[test]
fn an_answer_of_a_time_limit_is_marked() {
    let folder = Folder::new("solve-time");
    // W = 0: no impulse stops the block, and the iteration would go on
    let empty = folder.file("empty.json", &PROBLEM.replace("[[1, 0], [0, 1]]", "[[0, 0], [0, 0]]"));
    let answer = folder.path("answer.json");
    let words = ["solve", &empty, "--solver", "admm", "--iterations", "1000000", "--out", &answer, "--time-limit", "0.01"];
    let run = moreau(&[&words[..], &["--format", "json"]].concat());
    assert_eq!(
        (run.code, &run.json()["status"], &run.json()["reproducible"]),
        (1, &"infeasible".into(), &false.into()),
        "the proof takes no time limit"
    );
    let run = moreau(&words);
    assert!(run.output.contains("another run need not find"), "{}", run.output);
    // so does the file, and who judges it hears of it
    let written = std::fs::read_to_string(&answer).expect("written");
    assert!(written.contains(r#""reproducible":false"#), "{written}");
    let judged = moreau(&["certify", &empty, &answer]);
    assert!(judged.output.contains("another run need not find"), "{}", judged.output);
    // an answer of no limit has no mark, nor need it have one
    let block = folder.file("block.json", PROBLEM);
    assert_eq!(moreau(&["solve", &block, "--out", &answer, "--time-limit", "1e5"]).code, 0);
    assert!(!std::fs::read_to_string(&answer).expect("written").contains("reproducible"));
    assert!(!moreau(&["certify", &block, &answer]).output.contains("another run"));
    for (option, value) in [("--time-limit", "0"), ("--time-limit", "nan"), ("--tolerance", "-1")] {
        moreau(&["solve", &empty, option, value]).is_refused(&[option]);
    }
    for long in ["1e300", "inf"] {
        moreau(&["solve", &empty, "--time-limit", long]).is_refused(&[
            &format!("`--time-limit`: is {long};"),
            "up to 1e9 seconds",
            "leave it out",
        ]);
    }
}

#[test]
fn a_solver_that_the_time_limit_leaves_without_an_answer_is_marked_too() {
    let folder = Folder::new("solve-time-none");
    let problem = folder.file("plate.json", &super::limits::plate(512));
    let (answers, answer) = (folder.path("answers"), folder.path("answer.json"));
    let words = ["--solver", "admm", "--time-limit", "1e-9", "--format", "json"];
    let alone = moreau(&[&["solve", &problem, "--out", &answer], &words[..]].concat());
    let several = moreau(&[&["solve", &folder.path(""), "--out", &answers], &words[..]].concat());
    let line = &several.json()["problems"][0];
    for (run, json) in [(&alone, &alone.json()), (&several, line)] {
        assert_eq!((run.code, &json["status"], &json["reproducible"]), (1, &"limit".into(), &false.into()), "{}", run.message);
    }
    let run = moreau(&["solve", &problem, "--solver", "admm", "--time-limit", "1e-9"]);
    assert!(run.code == 1 && run.message.contains("ended by the time limit"), "{}", run.message);
    // what is refused, with or without a limit, is refused again
    let run = moreau(&["solve", &problem, "--solver", "apgd", "--time-limit", "1e5", "--format", "json", "--out", &answer]);
    assert!(run.json()["status"] == "refused" && run.json().get("reproducible").is_none(), "{}", run.output);
}

#[test]
fn of_the_impulses_that_give_one_velocity_those_of_least_norm_are_chosen_on_request() {
    let folder = Folder::new("solve-least-norm");
    let twice = r#"{"schema": "contact-problem/1", "name": "twice", "dimension": 1, "law": "frictionless", "friction": [0, 0],
        "free_velocity": [-1, -1], "delassus": {"shape": [2, 2], "rows": [[1, 1], [1, 1]]}}"#;
    let one =
        r#"{"schema": "solution/1", "problem": "twice", "solver": "by hand", "impulse": [1, 0], "velocity": [0, 0], "iterations": 0}"#;
    let (problem, start) = (folder.file("problem.json", twice), folder.file("start.json", one));
    let impulses = |extra: &[&str]| {
        let run = moreau(&[&["solve", &problem, "--start", &start], extra].concat());
        assert_eq!(run.code, 0, "{}", run.message);
        run.json()["impulse"].as_array().expect("a list").iter().map(|r| r.as_f64().expect("a number")).collect::<Vec<f64>>()
    };
    assert_eq!(impulses(&[]), [1.0, 0.0]);
    assert!(impulses(&["--least-norm"]).iter().all(|r| (r - 0.5).abs() <= 1e-12));
}

/// A box that slides on four corners, answered to 1e-8 only: that is too rough for the impulses of least norm, and a solution all the same.
#[test]
fn an_answer_whose_impulses_of_least_norm_are_not_found_is_kept_and_says_so() {
    let folder = Folder::new("solve-least-norm-rough");
    let rows = "[1, -1, 0, 2], [0, 2, 1, 0], [1, 2, -2, -1]";
    let sliding = format!(
        r#"{{"schema": "contact-problem/1", "name": "sliding", "dimension": 3, "law": "associated", "friction": [0.75, 0.75, 0.75, 0.75],
            "free_velocity": [-946.25, 120, 369.5, -946.25, 120, 370, -946.25, 119.5, 370, -946.25, 119.5, 369.5],
            "shift": [0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0.5, 0.5],
            "mass": {{"shape": [4, 4], "rows": [[1, 0, 0, 0], [0, 5, 0, 0], [0, 0, 5, 0], [0, 0, 0, 0.5]]}},
            "jacobian": {{"shape": [12, 4], "rows": [{rows}, {rows}, {rows}, {rows}]}}}}"#
    );
    let (problem, out) = (folder.file("problem.json", &sliding), folder.path("answer.json"));
    let words = ["solve", &problem, "--solver", "admm", "--tolerance", "1e-8", "--least-norm", "--out", &out];
    let (text, json) = (moreau(&words), moreau(&[&words[..], &["--format", "json"]].concat()));
    assert_eq!((text.code, json.code), (0, 0), "{}", text.message);
    assert!(text.output.contains("the impulses are the solver's, not those of least norm: "), "{}", text.output);
    assert!(json.json()["not_least_norm"].as_str().expect("the reason").contains("nearly dependent"));
    assert!(moreau(&[&words[..6], &words[7..], &["--format", "json"]].concat()).json()["not_least_norm"].is_null());
}

#[test]
fn the_history_is_shown_in_both_formats_and_an_indefinite_lcp_is_named_so() {
    let folder = Folder::new("solve-history");
    let coupled = folder.file("coupled.json", &PROBLEM.replace("[[1, 0], [0, 1]]", "[[1, 0.9], [0.9, 1]]"));
    let words = ["solve", &coupled, "--solver", "psor", "--out", &folder.path("answer.json"), "--history"];
    let (text, json) = (moreau(&words).output, moreau(&[&words[..], &["--format", "json"]].concat()).json());
    let looks = json["history"].as_array().expect("a list");
    let (_, shown) = text.split_once("look by look of the solver:\n").expect("a history");
    let shown: Vec<f64> =
        shown.lines().take_while(|line| line.starts_with("  ")).flat_map(str::split_whitespace).flat_map(str::parse).collect();
    assert!(!looks.is_empty() && shown.len() == looks.len(), "{text}");
    assert!(shown.iter().zip(looks).all(|(one, other)| (one - other.as_f64().unwrap()).abs() <= 0.06 * one), "{text}");
    assert!(!moreau(&words[..6]).output.contains("look by look"));
    let falling = r#"{"schema": "lcp/1", "matrix": {"shape": [2, 2], "rows": [[-1, 0], [0, -1]]}, "vector": [-1, -2]}"#;
    let run = moreau(&["solve", &folder.file("falling.json", falling), "--solver", "admm"]);
    assert!(run.code == 1 && run.message.contains("positive semidefinite") && !run.message.contains("too large"), "{}", run.message);
}

#[test]
fn an_operator_that_is_none_of_contacts_is_remarked_upon_and_a_matrix_of_an_lcp_is_not() {
    let folder = Folder::new("solve-remarks");
    let of = |rows: &str| folder.file("problem.json", &PROBLEM.replace("[[1, 0], [0, 1]]", rows));
    let out = folder.path("answer.json");
    let remarks = |file: &str, more: &[&str]| moreau(&[&["solve", file, "--out", &out], more].concat()).message;
    assert_eq!(remarks(&of("[[1, 0], [0, 1]]"), &[]), "");
    let skewed = of("[[1, 0.5], [0, 1]]");
    let said = remarks(&skewed, &[]);
    assert!(
        said.starts_with("remark: ") && said.contains("problem.json") && said.contains("not symmetric, max |W − Wᵀ| is 5.0e-1"),
        "{said}"
    );
    assert_eq!(remarks(&skewed, &["--format", "json"]), "", "standard error may be for programs");
    assert!(moreau(&["certify", &skewed, &out]).message.contains("not symmetric"));
    let falling = remarks(&of("[[-1, 0], [0, 1]]"), &[]);
    assert!(falling.contains("W_ii < 0 in row 0") && !falling.contains("symmetric"), "{falling}");
    let lcp = r#"{"schema": "lcp/1", "matrix": {"shape": [2, 2], "rows": [[2, 1], [0, -1]]}, "vector": [-1, 2]}"#;
    assert!(!remarks(&folder.file("lcp.json", lcp), &[]).contains("remark"));
}

#[test]
fn a_start_is_refused_where_the_solver_has_one_of_its_own() {
    let folder = Folder::new("solve-start-refused");
    let (problem, answer) = (folder.file("problem.json", PROBLEM), folder.path("answer.json"));
    assert_eq!(moreau(&["solve", &problem, "--out", &answer]).code, 0);
    for solver in moreau::solvers::ALL.names() {
        let run = moreau(&["solve", &problem, "--solver", solver, "--start", &answer]);
        if moreau::solvers::ALL.by_name(solver).expect("listed").takes_start() {
            assert!(run.code < 2, "{solver}: {}", run.message);
        } else {
            run.is_refused(&["field `--start`", solver, "leave it out"]);
        }
    }
}

#[test]
fn without_contacts_no_contact_is_named() {
    let folder = Folder::new("solve-none");
    let text = r#"{"schema": "contact-problem/1", "name": "free", "dimension": 3, "law": "coulomb", "friction": [],
      "free_velocity": [], "delassus": {"shape": [0, 0], "rows": []}}"#;
    let (problem, answer) = (folder.file("free.json", text), folder.path("answer.json"));
    for run in [moreau(&["solve", &problem, "--out", &answer]), moreau(&["certify", &problem, &answer])] {
        assert_eq!((run.code, run.output.matches("no contact\n").count()), (0, 6), "{}", run.output);
        assert!(!run.output.contains("contact 0"), "{}", run.output);
    }
    let one = moreau(&["solve", &folder.file("p.json", PROBLEM), "--out", &answer]).output;
    assert!(one.contains("contact 0") && !one.contains("no contact"), "{one}");
}

#[test]
fn a_failure_is_told_in_the_name_of_the_solver_that_was_asked_for() {
    let folder = Folder::new("solve-asked");
    let huge = PROBLEM.replace("[-1, 2]", "[-1e308, 1e308]").replace("[[1, 0], [0, 1]]", "[[1e-300, 0], [0, 1e-300]]");
    let problem = folder.file("huge.json", &huge);
    for solver in ["auto", "pgs"] {
        let run = moreau(&["solve", &problem, "--solver", solver]);
        assert_eq!(run.code, 1, "{}", run.message);
        assert!(run.message.contains(&format!("solver `{solver}` (")) && run.message.contains("rescale the units"), "{}", run.message);
        let json = moreau(&["solve", &problem, "--solver", solver, "--format", "json", "--out", &folder.path("a.json")]).json();
        assert_eq!(json["solver"], solver);
    }
}
