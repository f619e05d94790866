//! What the command says where something is mistaken for something else, and that its advice leads somewhere.

use super::{Folder, PROBLEM, moreau};

/// The block in space.
const SPATIAL: &str = r#"{"schema": "contact-problem/1", "name": "block", "dimension": 3, "law": "coulomb", "friction": [0.5],
  "free_velocity": [-1, 2, 0], "delassus": {"shape": [3, 3], "rows": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}}"#;

/// The names between backquotes after `use`.
fn advised(message: &str) -> Vec<String> {
    let (_, cure) = message.split_once("; use ").unwrap_or_else(|| panic!("no advice in {message}"));
    cure.split('`').skip(1).step_by(2).map(str::to_string).collect()
}

#[test]
fn a_refusal_names_solvers_that_solve_this_problem() {
    let folder = Folder::new("advice");
    let soft = SPATIAL.replace("\"friction\"", "\"compliance\": {\"coordinates\": \"contact\", \"diagonal\": [1, 1, 1]}, \"friction\"");
    let asymmetric = SPATIAL.replace("[0, 1, 0]", "[0.5, 1, 0]").replace("coulomb", "associated");
    let problems = [
        ("spatial", SPATIAL.to_string()),
        ("planar", PROBLEM.to_string()),
        ("frictionless", PROBLEM.replace("coulomb", "frictionless").replace("[0.5]", "[0]")),
        ("octagon", SPATIAL.replace("\"coulomb\"", "\"polyhedral-coulomb\", \"directions\": 8")),
        ("soft", soft),
        ("asymmetric", asymmetric),
    ];
    let mut refusals = 0;
    for (name, text) in problems {
        let problem = folder.file(&format!("{name}.json"), &text);
        for solver in moreau::solvers::ALL.names() {
            let run = moreau(&["solve", &problem, "--solver", solver]);
            if !run.message.contains("(refused)") {
                continue;
            }
            refusals += 1;
            let names = advised(&run.message);
            assert!(!names.is_empty() && !names.contains(&solver.to_string()), "{}", run.message);
            for name in names {
                let next = moreau(&["solve", &problem, "--solver", &name]);
                assert_eq!(next.code, 0, "{solver} advises {name}, which says {}", next.message);
            }
        }
    }
    assert!(refusals > 20, "{refusals} refusals");
}

#[test]
fn a_refusal_in_a_benchmark_names_them_too() {
    let folder = Folder::new("advice-bench");
    let problem = folder.file("spatial.json", SPATIAL);
    let run = moreau(&["bench", &problem, "--solver", "murty", "--repeat", "0"]);
    assert!(run.code == 1 && run.output.contains("`auto`") && !run.output.contains("`lemke`"), "{}", run.output);
}

#[test]
fn a_misspelt_solver_gets_its_neighbour() {
    let folder = Folder::new("advice-name");
    let problem = folder.file("problem.json", PROBLEM);
    moreau(&["solve", &problem, "--solver", "lemk"]).is_refused(&["--solver", "`lemk`", "did you mean `lemke`"]);
    moreau(&["bench", &problem, "--solver", "interiorpoint"]).is_refused(&["--solver", "did you mean `interior-point`"]);
    moreau(&["simulate", "--scene", "bouncing-ball", "--solver", "aut"]).is_refused(&["--solver", "did you mean `auto`"]);
    moreau(&["compare", "bouncing-ball", "--solver", "psgs"]).is_refused(&["--solver", "`pgs`"]);
}

#[test]
fn a_problem_without_an_answer_and_files_in_the_wrong_order_are_told() {
    let folder = Folder::new("advice-order");
    let (problem, answer) = (folder.file("problem.json", PROBLEM), folder.path("answer.json"));
    assert_eq!(moreau(&["solve", &problem, "--out", &answer]).code, 0);
    let wanted = ["SOLUTION", "problem.json is a contact-problem/1, which holds no answer", "--out answer.json"];
    moreau(&["certify", &problem]).is_refused(&wanted);
    let swapped = ["PROBLEM", "answer.json, which is a solution/1", "moreau certify PROBLEM SOLUTION"];
    moreau(&["certify", &answer, &problem]).is_refused(&swapped);
    moreau(&["certify", &problem, &problem]).is_refused(&["SOLUTION", "problem.json, which is a contact-problem/1", "no answer"]);
    moreau(&["solve", &answer]).is_refused(&["PROBLEM", "answer.json, which is a solution/1", "moreau solve PROBLEM"]);
    let numbers = folder.file("point.dat", "3\n1\n0\n3\n3\n3\t3\n2 0 0\n0 1 0\n0 0 1\n-1 0.125 0\n0.5\n");
    moreau(&["certify", &numbers]).is_refused(&["SOLUTION", "point.dat is a problem in the .dat of Siconos"]);
    assert_eq!(moreau(&["certify", &problem, &answer]).code, 0, "in the right order they are read");
}

#[test]
fn a_file_that_is_cut_off_is_told_with_its_line() {
    let folder = Folder::new("advice-cut");
    let cut = folder.file("cut.json", &PROBLEM[..PROBLEM.find("[-1").expect("u_free") + 3]);
    moreau(&["solve", &cut]).is_refused(&["cut.json", "`free_velocity`", "ends early, at line 2", "whole"]);
    let answer = folder.file("answer.json", "{\"schema\": \"solution/1\",\n \"impulse\": [1,\n");
    let problem = folder.file("problem.json", PROBLEM);
    moreau(&["certify", &problem, &answer]).is_refused(&["answer.json", "`impulse`", "ends early, at line 3"]);
}

#[test]
fn one_mistake_of_size_has_one_message() {
    let folder = Folder::new("advice-size");
    let problem = folder.file("problem.json", PROBLEM);
    let answer = r#"{"schema": "solution/1", "problem": "block", "impulse": [1, -0.5, 0], "velocity": [0, 1.5, 0]}"#;
    let answer = folder.file("answer.json", answer);
    let same = ["has size 3; give size 2, for 1 contact with 2 rows each"];
    moreau(&["certify", &problem, &answer]).is_refused(&same);
    moreau(&["solve", &problem, "--start", &answer]).is_refused(&same);
    moreau(&["problems", "measure", &problem, "--given", &answer]).is_refused(&same);
    moreau(&["solve", &folder.file("long.json", &PROBLEM.replace("[-1, 2]", "[-1, 2, 0]"))]).is_refused(&same);
    let square = PROBLEM.replace("[2, 2]", "[3, 3]");
    moreau(&["solve", &folder.file("square.json", &square)]).is_refused(&["use the shape 2×2, for 1 contact with 2 rows each"]);
}

#[test]
fn keys_are_held_to_the_same_in_every_form_of_the_operator() {
    let folder = Folder::new("advice-keys");
    let by_bodies = r#""mass": {"shape": [2, 2], "diagonal_blocks": [[1, 0, 0, 1]]},
      "jacobian": {"shape": [2, 2], "sparse_rows": {"starts": [0, 1, 2], "column": [0, 1], "value": [1, 1]}}"#;
    let dense = r#""delassus": {"shape": [2, 2], "rows": [[1, 0], [0, 1]]}"#;
    for (form, operator) in [("dense", dense), ("bodies", by_bodies)] {
        let text = |keys: &str| PROBLEM.replace(dense, &format!("{operator}, \"keys\": [{keys}]"));
        let run = |keys: &str| moreau(&["solve", &folder.file(&format!("{form}.json"), &text(keys))]);
        assert_eq!(run(r#"{"bodies": [0, null], "features": [0, 0]}"#).code, 0, "{form}");
        run(r#"{"bodies": [0, 0], "features": [0, 0]}"#).is_refused(&["keys[0]", "same body twice"]);
        run(r#"{"bodies": [null, null], "features": [0, 0]}"#).is_refused(&["keys[0]", "same body twice"]);
    }
}

#[test]
fn an_exported_answer_has_the_iterations_of_its_solver_or_none() {
    let folder = Folder::new("advice-iterations");
    let (mut with, mut without) = (0, 0);
    for stored in moreau::problems::ALL.iter().filter(|stored| stored.problem.is_some()).take(60) {
        let record = stored.record().expect("a record");
        let Some(first) = record.answers.first() else { continue };
        let problem = stored.problem().expect("stored");
        let text = moreau::problems::solution(&problem, &record, first).to_json(None, None);
        let written: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        match record.solvers.iter().find(|outcome| outcome.solver == first.by).and_then(|outcome| outcome.iterations) {
            Some(iterations) if iterations > 0 => {
                assert_eq!(written["iterations"], iterations, "{}", stored.name);
                with += 1;
            }
            _ => {
                assert_eq!(written.get("iterations"), None, "{}", stored.name);
                without += 1;
            }
        }
    }
    assert!(with > 5 && without > 0, "{with} with, {without} without");
    let place = folder.path("");
    assert_eq!(moreau(&["problems", "export", "single-slide", &place]).code, 0);
    assert!(!std::fs::read_to_string(folder.path("single-slide.solution.json")).expect("written").contains("\"iterations\":0"));
}

#[test]
fn what_is_no_problem_is_told_by_what_it_is() {
    let folder = Folder::new("advice-kinds");
    let solve = |name: &str, text: &str| moreau(&["solve", &folder.file(name, text)]);
    for schema in ["lcp", "contact-problem/2", "scene/1"] {
        let read = [&format!("is \"{schema}\"")[..], "\"contact-problem/1\" or \"lcp/1\""];
        solve("schema.json", &PROBLEM.replace("contact-problem/1", schema)).is_refused(&read);
    }
    solve("marked.json", &format!("\u{feff}{PROBLEM}")).is_refused(&["marked.json", "`schema`", "byte-order mark", "save"]);
    solve("broken.dat", "garbage").is_refused(&["broken.dat", "`sizes`", "`garbage`", "Siconos's text"]);
    solve("broken.hdf5", "garbage").is_refused(&["broken.hdf5", "`HDF5`", "FCLIB"]);
    solve("two.json", &PROBLEM.replace("[0.5]", "[0.5, 0.5]")).is_refused(&["`friction`: has size 2; give 1"]);
    let place = folder.path("");
    moreau(&["solve", &place]).is_refused(&["--out", "a folder"]);
    moreau(&["certify", &place, "answer.json"]).is_refused(&["SOLUTION", "no folder"]);
    moreau(&["certify", &folder.file("problem.json", PROBLEM), &place]).is_refused(&["a folder", "give a file in it"]);
    moreau(&["problems", "measure", &place]).is_refused(&["a folder", "give a file in it"]);
    for solver in ["auto", "pgs"] {
        let run = moreau(&["solve", &folder.path("problem.json"), "--solver", solver, "--iterations", "0"]);
        run.is_refused(&["field `--iterations`: is 0", "from 1"]);
    }
    moreau(&["solve", &folder.path("problem.json"), "--solver", "lemke", "--iterations", "5"])
        .is_refused(&["`--iterations`", "leave it out"]);
}

#[test]
fn impulses_alone_are_an_answer() {
    let folder = Folder::new("advice-impulses");
    let problem = folder.file("problem.json", PROBLEM);
    for (impulse, code) in [("[1, -0.5]", 0), ("[0, 0]", 1), ("[1, -0.25]", 1)] {
        let answer = folder.file("answer.json", &format!(r#"{{"schema": "solution/1", "impulse": {impulse}}}"#));
        assert_eq!(moreau(&["certify", &problem, &answer]).code, code, "{impulse}");
    }
    let wrong = folder.file("wrong.json", r#"{"schema": "solution/1", "impulse": [1, -0.5], "velocity": [1, 1.5]}"#);
    assert_eq!(moreau(&["certify", &problem, &wrong]).code, 1, "a velocity that is given is still compared");
    let short = folder.file("short.json", r#"{"schema": "solution/1", "impulse": [1]}"#);
    moreau(&["certify", &problem, &short]).is_refused(&["short.json", "`impulse`: has size 1; give size 2"]);
}

#[test]
fn a_misspelt_field_is_told_with_the_one_that_is_meant() {
    let folder = Folder::new("advice-meant");
    let refused = |from: &str, to: &str, words: &[&str]| {
        moreau(&["solve", &folder.file("problem.json", &PROBLEM.replace(from, to))]).is_refused(words);
    };
    refused("delassus", "delasus", &["`delasus`: unknown field", "did you mean `delassus`? see the schema contact-problem/1"]);
    refused("rows", "row", &["`delassus.row`", "did you mean `rows`?"]);
    let far = moreau(&["solve", &folder.file("problem.json", &PROBLEM.replace("delassus", "matrix"))]);
    assert!(far.code == 2 && !far.message.contains("did you mean"), "{}", far.message);
}
