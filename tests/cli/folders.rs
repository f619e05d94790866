//! `moreau solve FOLDER` and `moreau certify FOLDER`.

use super::bench::{DAT, LCP, spatial};
use super::joints::contradicting;
use super::{Folder, PROBLEM, Run, moreau};
use moreau::solvers::{Auto, ContactSolver};

/// The line of a problem in a text.
fn line<'a>(run: &'a Run, problem: &str) -> &'a str {
    run.output.lines().find(|line| line.split_whitespace().next() == Some(problem)).unwrap_or_else(|| panic!("{problem}: {}", run.output))
}

/// The block, the point of Siconos and a linear complementarity problem in the folder `problems`, and the way to it.
fn problems(folder: &Folder) -> String {
    std::fs::create_dir_all(folder.path("problems")).expect("a writable folder");
    for (name, text) in [("a.json", PROBLEM), ("b.dat", DAT), ("c.json", LCP), ("readme.txt", "no problem")] {
        folder.file(&format!("problems/{name}"), text);
    }
    folder.path("problems")
}

fn names(folder: &str) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut names: Vec<_> = entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn every_problem_of_a_folder_is_solved_and_certified_as_a_file_alone_is() {
    let folder = Folder::new("folder-solve");
    let (place, answers) = (problems(&folder), folder.path("new/answers"));
    let run = moreau(&["solve", &place, "--out", &answers]);
    assert_eq!((run.code, run.message.as_str()), (0, ""), "{}", run.output);
    assert_eq!(names(&answers), ["a.solution.json", "b.solution.json", "c.solution.json"]);
    assert_eq!(run.output.lines().count(), 5, "a heading, three problems, a sum: {}", run.output);
    let words: Vec<&str> = line(&run, "a.json").split_whitespace().collect();
    assert!(words[1] == "1" && words[3].parse::<f64>().expect("a residual") <= 1e-8 && words[4] == "solved", "{words:?}");
    assert!(run.output.ends_with("3 of 3 solved\n"), "{}", run.output);
    for (problem, answer) in [("a.json", "a"), ("b.dat", "b"), ("c.json", "c")] {
        let (problem, own, alone) = (format!("{place}/{problem}"), format!("{answers}/{answer}.solution.json"), folder.path("alone.json"));
        assert_eq!(moreau(&["solve", &problem, "--out", &alone]).code, 0);
        let read = |file: &str| std::fs::read_to_string(file).expect("an answer");
        assert_eq!(read(&own), read(&alone), "{problem}");
    }
    let run = moreau(&["certify", &place, &answers]);
    assert_eq!((run.code, run.message.as_str()), (0, ""), "{}", run.output);
    assert!(run.output.ends_with("3 of 3 solved\n") && line(&run, "c.json").ends_with("  solved"), "{}", run.output);
    // answers beside their problems are no problems, and are found there
    assert_eq!(moreau(&["solve", &place, "--out", &place]).code, 0);
    assert_eq!(moreau(&["solve", &place, "--out", &place]).output.lines().count(), 5);
    assert_eq!(moreau(&["certify", &place]).code, 0);
}

#[test]
fn a_broken_file_does_not_lose_the_others_and_the_code_is_the_worst() {
    let folder = Folder::new("folder-broken");
    let (place, answers) = (problems(&folder), folder.path("answers"));
    // the block that another solver takes: 1, no answer
    let lemke = moreau(&["solve", &place, "--out", &answers, "--solver", "lemke"]);
    assert_eq!(lemke.code, 1, "{}", lemke.output);
    assert!(line(&lemke, "b.dat").contains("not solved") && line(&lemke, "a.json").ends_with("solved"), "{}", lemke.output);
    assert_eq!(names(&answers), ["a.solution.json", "c.solution.json"]);
    folder.file("problems/d.dat", &DAT[..20]);
    folder.file("problems/e.json", &contradicting());
    let run = moreau(&["solve", &place, "--out", &answers]);
    assert_eq!(run.code, 2, "{}", run.output);
    assert!(run.message.starts_with("error: 2 of 5 problems") && run.message.lines().count() == 1, "{}", run.message);
    assert!(line(&run, "d.dat").contains("W, line") && line(&run, "e.json").contains("contradicts"), "{}", run.output);
    assert!(run.output.ends_with("3 of 5 solved, 2 cannot be used\n"), "{}", run.output);
    assert_eq!(names(&answers), ["a.solution.json", "b.solution.json", "c.solution.json"]);
    let json = moreau(&["solve", &place, "--out", &answers, "--solver", "lemke", "--format", "json"]);
    assert_eq!(json.code, 2);
    let report = json.json();
    super::schema::is_as("answers", &report, "/problems/0/status", "perhaps".into());
    let field = |name: &str| -> Vec<String> {
        let lines = report["problems"].as_array().expect("a list").iter();
        lines.map(|line| line[name].as_str().unwrap_or("-").to_string()).collect()
    };
    assert_eq!(field("problem"), ["a.json", "b.dat", "c.json", "d.dat", "e.json"]);
    assert_eq!(field("status"), ["solved", "refused", "solved", "bad-input", "bad-input"]);
    assert_eq!(field("answer"), ["a.solution.json", "-", "c.solution.json", "-", "-"]);
    assert!(field("reason")[1].contains("lemke") && field("reason")[3].contains("W, line"), "{report}");
}

#[test]
fn an_answer_that_is_rejected_is_written_and_one_that_cannot_be_is_told_as_infeasible() {
    let folder = Folder::new("folder-rejected");
    std::fs::create_dir_all(folder.path("problems")).expect("a writable folder");
    let coupled = |rows: &str| PROBLEM.replace("[[1, 0], [0, 1]]", rows);
    folder.file("problems/coupled.json", &coupled("[[1, 0.9], [0.9, 1]]"));
    folder.file("problems/empty.json", &coupled("[[0, 0], [0, 0]]"));
    let (place, answers) = (folder.path("problems"), folder.path("answers"));
    let run = moreau(&["solve", &place, "--out", &answers, "--solver", "psor", "--iterations", "1", "--format", "json"]);
    assert_eq!(run.code, 1, "{}", run.output);
    let report = run.json();
    assert_eq!((&report["problems"][0]["status"], &report["problems"][0]["solution"]), (&"limit".into(), &false.into()));
    assert_eq!(report["problems"][1]["status"], "infeasible", "{report}");
    assert!(report["problems"][1]["reason"].is_string());
    assert!(names(&answers).contains(&"coupled.solution.json".into()), "a rejected answer is written all the same");
    let text = moreau(&["certify", &place, &answers]);
    assert!(text.code > 0 && line(&text, "coupled.json").contains("not solved: rejected"), "{}", text.output);
}

#[test]
fn answers_that_are_missing_or_do_not_fit_are_named() {
    let folder = Folder::new("folder-certify");
    let (place, answers) = (problems(&folder), folder.path("answers"));
    assert_eq!(moreau(&["solve", &place, "--out", &answers]).code, 0);
    std::fs::remove_file(format!("{answers}/a.solution.json")).expect("it was written");
    folder.file("answers/b.solution.json", r#"{"schema": "solution/1", "impulse": [1]}"#);
    folder.file("answers/c.solution.json", r#"{"schema": "solution/1", "impulse": [2, 0]}"#);
    let run = moreau(&["certify", &place, &answers]);
    assert_eq!(run.code, 2, "{}", run.output);
    let told = ["error: 1 of 3 problems have no answer", "error: 1 of 3 problems cannot be used"];
    assert!(
        run.message.lines().zip(told).all(|(line, told)| line.starts_with(told)) && run.message.lines().count() == 2,
        "{}",
        run.message
    );
    assert!(run.output.ends_with("0 of 3 solved, 1 without answer, 1 cannot be used\n"), "{}", run.output);
    let missing = line(&run, "a.json");
    assert!(
        missing.contains("there is no") && missing.contains("answers/a.solution.json") && missing.contains("moreau solve"),
        "{missing}"
    );
    assert!(line(&run, "b.dat").contains("b.solution.json: field `impulse`: has size 1; give size 3"), "{}", run.output);
    assert!(line(&run, "c.json").contains("not solved: rejected"), "{}", run.output);
    // with answers to all of them, the code is that of the rejected one
    folder.file("answers/a.solution.json", r#"{"schema": "solution/1", "impulse": [1, -0.5]}"#);
    folder.file("answers/b.solution.json", r#"{"schema": "solution/1", "impulse": [0.5, -0.125, 0]}"#);
    let run = moreau(&["certify", &place, &answers, "--format", "json"]);
    assert_eq!((run.code, run.message.as_str()), (1, ""), "{}", run.output);
    super::schema::is_as("answers", &run.json(), "/problems/0/contacts", "one".into());
}

#[test]
fn a_solution_in_the_hdf5_of_its_problem_is_its_answer() {
    let folder = Folder::new("folder-hdf5");
    let (problem, place) = (spatial(), folder.path(""));
    let answer = Auto.solve(&problem, None).expect("it slides");
    std::fs::write(folder.path("with.hdf5"), problem.to_fclib(Some(&answer), None).expect("well formed")).expect("a writable folder");
    let run = moreau(&["certify", &place]);
    assert!(run.code == 0 && line(&run, "with.hdf5").contains("stored"), "{}{}", run.output, run.message);
    std::fs::write(folder.path("without.hdf5"), problem.to_fclib(None, None).expect("well formed")).expect("a writable folder");
    let run = moreau(&["certify", &place]);
    assert!(run.code == 2 && line(&run, "without.hdf5").contains("has no answer"), "{}", run.output);
    assert!(line(&run, "with.hdf5").ends_with("solved"), "{}", run.output);
    // where a folder of answers is named no other answer counts
    std::fs::create_dir_all(folder.path("nothing")).expect("a writable folder");
    let run = moreau(&["certify", &place, &folder.path("nothing")]);
    assert!(run.code == 2 && line(&run, "with.hdf5").contains("has no answer"), "{}", run.output);
    // a file of its own goes before the stored one
    folder.file("with.solution.json", r#"{"schema": "solution/1", "impulse": [3, 0, 0]}"#);
    assert!(line(&moreau(&["certify", &place]), "with.hdf5").contains("rejected"));
}

#[test]
fn what_a_folder_cannot_be_asked_is_refused_and_nothing_is_written() {
    let folder = Folder::new("folder-refused");
    let (place, file) = (problems(&folder), folder.file("there.json", "kept"));
    let before = folder.names();
    moreau(&["solve", &place]).is_refused(&["`--out`", "problems is a folder of problems", "--out answers/"]);
    moreau(&["solve", &place, "--out", &file]).is_refused(&["`--out`", "there.json, which is a file", "a folder"]);
    let answers = folder.path("answers");
    moreau(&["solve", &place, "--out", &answers, "--start", &file]).is_refused(&["`--start`", "one problem"]);
    moreau(&["solve", &place, "--out", &answers, "--history"]).is_refused(&["`--history`", "one problem"]);
    moreau(&["certify", &place, "--prove"]).is_refused(&["`--prove`", "one problem"]);
    moreau(&["certify", &place, &file]).is_refused(&["SOLUTION", "there.json, which is no folder"]);
    std::fs::create_dir_all(folder.path("nothing")).expect("a writable folder");
    moreau(&["solve", &folder.path("nothing"), "--out", &answers]).is_refused(&["PROBLEM", "json, dat"]);
    moreau(&["certify", &folder.path("nothing")]).is_refused(&["PROBLEM", "json, dat"]);
    // two problems with one name of an answer, and a problem named as an answer
    folder.file("problems/a.dat", DAT);
    moreau(&["solve", &place, "--out", &answers]).is_refused(&["a.dat and a.json", "a.solution.json", "rename"]);
    std::fs::remove_file(folder.path("problems/a.dat")).expect("it was written");
    folder.file("problems/a.solution.json", PROBLEM);
    moreau(&["solve", &place, "--out", &place]).is_refused(&["a.solution.json", "a.json", "written"]);
    std::fs::remove_dir(folder.path("nothing")).expect("it was made");
    assert_eq!(folder.names(), before);
    assert_eq!(std::fs::read_to_string(&file).expect("kept"), "kept");
}

#[test]
fn a_problem_without_solution_is_not_told_to_be_solved() {
    let folder = Folder::new("folder-infeasible");
    assert_eq!(moreau(&["problems", "export", "rail-deep", &folder.path("problems")]).code, 0);
    let run = moreau(&["certify", &folder.path("problems")]);
    let said = line(&run, "rail-deep.json");
    assert!(run.code == 1 && said.contains("no solution, as is proved") && !said.contains("moreau solve"), "{}", run.output);
    assert_eq!(moreau(&["certify", &folder.path("problems"), "--format", "json"]).json()["problems"][0]["status"], "infeasible");
    // the file alone is told the same, with proofs or without
    let file = folder.path("problems/rail-deep.json");
    for more in [&[][..], &["--prove"]] {
        let run = moreau(&[&["certify", &file], more].concat());
        assert!(run.code == 1 && run.output.contains("the problem has no solution") && run.message.is_empty(), "{}", run.output);
        let json = moreau(&[&["certify", &file, "--format", "json"], more].concat()).json();
        assert!(json["status"] == "infeasible" && json["reason"].as_str().is_some_and(|reason| !reason.ends_with('\n')), "{json}");
    }
}
