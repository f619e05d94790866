//! `moreau bench`, and the formats of problems that all three of `solve`, `certify` and `bench` read.

use super::{Folder, PROBLEM, moreau};
use moreau::nalgebra::{DMatrix, dvector};
use moreau::problem::ContactProblem;
use moreau::solvers::{Auto, ContactSolver};

/// One spatial contact of Siconos's kind, W dense: it sticks.
pub const DAT: &str = "3\n1\n0\n3\n3\n3\t3\n2 0 0\n0 1 0\n0 0 1\n-1 0.125 0\n0.5\n";
pub const LCP: &str = r#"{"schema": "lcp/1", "name": "two", "matrix": {"shape": [2, 2], "rows": [[2, 1], [0, 1]]}, "vector": [-1, 2]}"#;

pub fn spatial() -> ContactProblem {
    ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).friction(vec![0.5]).build().unwrap()
}

#[test]
fn an_answer_in_a_folder_of_problems_is_passed_over() {
    let folder = Folder::new("bench-exported");
    let place = folder.path("");
    assert_eq!(moreau(&["problems", "export", "single-slide", &place]).code, 0);
    let run = moreau(&["bench", &place, "--repeat", "0"]);
    assert!(run.code == 0 && run.output.contains("1 of 1 solved"), "{}{}", run.output, run.message);
}

#[test]
fn two_files_of_one_name_are_refused_before_anything_is_timed() {
    let folder = Folder::new("bench-twice");
    for place in ["one", "other"] {
        std::fs::create_dir_all(folder.path(place)).expect("a writable folder");
        folder.file(&format!("{place}/p.json"), PROBLEM);
    }
    moreau(&["bench", &folder.path("one"), &folder.path("other")]).is_refused(&["PROBLEMS", "one/p.json", "other/p.json", "rename"]);
}

#[test]
fn a_folder_of_problems_is_timed_and_certified() {
    let folder = Folder::new("bench");
    folder.file("a.json", PROBLEM);
    folder.file("b.dat", DAT);
    folder.file("c.json", LCP);
    folder.file("not a problem.txt", "");
    let run = moreau(&["bench", &folder.path("."), "--repeat", "0", "--solver", "auto", "--solver", "lemke", "--format", "json"]);
    // Lemke refuses b, which auto solves
    assert_eq!(run.code, 0, "{}{}", run.output, run.message);
    let json = run.json();
    let runs = json["runs"].as_array().unwrap();
    assert_eq!(runs.len(), 6);
    assert!(
        runs.iter().filter(|run| run["solver"] == "auto").all(|run| run["solved"] == true && run["relative"].as_f64().unwrap() <= 1e-8)
    );
    let refused: Vec<_> = runs.iter().filter(|run| run["failure"].is_string()).map(|run| run["problem"].as_str().unwrap()).collect();
    assert_eq!(refused, ["b.dat"]);
    assert_eq!(json["solvers"][0]["solved"], 3);
    let alone = moreau(&["bench", &folder.path("b.dat"), "--repeat", "0", "--solver", "lemke"]);
    assert_eq!(alone.code, 1, "nobody solved it: {}", alone.output);
}

#[test]
fn what_cannot_be_timed_is_refused() {
    let folder = Folder::new("bench-bad");
    moreau(&["bench", &folder.path(".")]).is_refused(&["PROBLEMS", "json, dat"]);
    let problem = folder.file("a.json", PROBLEM);
    moreau(&["bench", &problem, "--solver", "gauss"]).is_refused(&["--solver", "gauss"]);
    for time in ["-1", "1e300", "inf"] {
        moreau(&["bench", &problem, "--repeat", time]).is_refused(&["--repeat"]);
    }
    moreau(&["bench", &problem, "--tolerance", "nan"]).is_refused(&["--tolerance"]);
    moreau(&["bench", &folder.file("cut.dat", &DAT[..20])]).is_refused(&["cut.dat", "W, line"]);
}

#[test]
fn every_format_is_solved_and_certified() {
    let folder = Folder::new("formats");
    let hdf5 = folder.path("d.hdf5");
    std::fs::write(&hdf5, spatial().to_fclib(None, None).unwrap()).unwrap();
    for problem in [folder.file("b.dat", DAT), folder.file("c.json", LCP), hdf5] {
        let answer = folder.path("answer.json");
        assert_eq!(moreau(&["solve", &problem, "--out", &answer]).code, 0, "{problem}");
        let run = moreau(&["certify", &problem, &answer, "--prove", "--format", "json"]);
        assert_eq!(run.code, 0, "{problem} {}{}", run.output, run.message);
        let bound = run.json()["backward"]["velocity"].as_f64().unwrap();
        assert!(bound <= moreau::tolerance::rounding(16, 8.0), "{problem}: {bound}");
    }
}

#[test]
fn the_solution_that_an_fclib_file_stores_is_judged() {
    let folder = Folder::new("fclib-stored");
    let (problem, file) = (spatial(), folder.path("stored.hdf5"));
    let answer = Auto.solve(&problem, None).unwrap();
    std::fs::write(&file, problem.to_fclib(Some(&answer), None).unwrap()).unwrap();
    assert_eq!(moreau(&["certify", &file]).code, 0);
    let mut nothing = answer.clone();
    nothing.impulse.fill(0.0);
    nothing.velocity = problem.free_velocity().clone();
    std::fs::write(&file, problem.to_fclib(Some(&nothing), None).unwrap()).unwrap();
    assert_eq!(moreau(&["certify", &file]).code, 1, "a stored r = 0 is no solution");
    std::fs::write(&file, problem.to_fclib(None, None).unwrap()).unwrap();
    moreau(&["certify", &file]).is_refused(&["stored.hdf5", "solution/r"]);
}

#[test]
fn a_proof_tells_how_far_the_problem_is_that_a_wrong_answer_solves() {
    let folder = Folder::new("prove");
    let problem = folder.file("problem.json", PROBLEM);
    let wrong = folder.file("wrong.json", r#"{"schema": "solution/1", "impulse": [1.25, -0.5], "velocity": [0.25, 1.5]}"#);
    let run = moreau(&["certify", &problem, &wrong, "--prove"]);
    assert_eq!(run.code, 1);
    assert!(run.output.contains("proved in fractions") && run.output.contains("m/s at a contact (contact 0)"), "{}", run.output);
    let polyhedral = folder.file("polyhedral.json", &PROBLEM.replace(r#""coulomb""#, r#""polyhedral-coulomb", "directions": 2"#));
    let run = moreau(&["certify", &polyhedral, &wrong, "--prove"]);
    assert_eq!(run.code, 1, "{}", run.output);
    for said in ["NOT a solution", "proved in fractions: impulses", "complementarity problem differs by at most 2.500e-1"] {
        assert!(run.output.contains(said), "{said}: {}", run.output);
    }
}

#[test]
fn answers_are_kept_counts_are_kept_and_the_law_can_be_another() {
    let folder = Folder::new("bench-answers");
    let (problem, answers) = (folder.file("b.dat", DAT), folder.path("answers"));
    let words =
        ["bench", &problem, "--solves", "3", "--answers", &answers, "--law", "associated", "--tolerance", "1e-12", "--format", "json"];
    let run = moreau(&words);
    assert_eq!(run.code, 0, "{}{}", run.output, run.message);
    let line = &run.json()["runs"][0];
    assert_eq!((line["repeats"].as_u64(), line["answer"].as_str()), (Some(3), Some("b.dat.auto.json")));
    assert!(line["certifying"].as_f64().unwrap() > 0.0 && line["natural_map_one"].as_f64().unwrap() <= 1e-12, "{line}");
    let convex = folder.path("convex.json");
    assert_eq!(moreau(&["convert", &problem, "--law", "associated", "--out", &convex]).code, 0);
    assert_eq!(moreau(&["certify", &convex, &format!("{answers}/b.dat.auto.json")]).code, 0);
}

#[test]
fn a_problem_without_solution_is_answered_by_saying_so() {
    let folder = Folder::new("bench-none");
    let names = ["wedge-jammed", "walls-overlapping-line", "walls-overlapping-plane", "rail-deep", "rail-restitution", "single-slide"];
    for name in names {
        assert_eq!(moreau(&["problems", "export", name, &folder.path("")]).code, 0, "{name}");
    }
    let run = moreau(&["bench", &folder.path(""), "--repeat", "0"]);
    assert!(run.code == 0 && run.output.contains("1 of 1 solved, 5 without solution"), "{}", run.output);
    assert_eq!(run.output.matches("no solution, as is proved").count(), 5, "{}", run.output);
    let json = moreau(&["bench", &folder.path(""), "--repeat", "0", "--format", "json"]).json();
    assert_eq!((&json["solvers"][0]["without_solution"], &json["solvers"][0]["problems"]), (&5.into(), &1.into()));
    // the same data with a solution that nobody finds is not answered
    let unsolved = moreau(&["bench", &folder.path("single-slide.json"), "--repeat", "0", "--solver", "murty"]);
    assert!(unsolved.code == 1 && !unsolved.output.contains("no solution"), "{}", unsolved.output);
}

#[test]
fn a_bench_of_nothing_and_a_solver_twice_are_refused() {
    let folder = Folder::new("bench-nothing");
    let problem = folder.file("a.json", PROBLEM);
    moreau(&["bench", &problem, "--solves", "0"]).is_refused(&["`--solves`: is 0", "from 1"]);
    moreau(&["bench", &problem, "--solver", "pgs", "--solver", "auto", "--solver", "pgs"]).is_refused(&["`--solver`", "`pgs` twice"]);
}

#[test]
fn a_file_that_cannot_be_read_and_one_that_errs_do_not_lose_the_others() {
    let folder = Folder::new("bench-broken");
    folder.file("a.json", PROBLEM);
    folder.file("b.dat", &DAT[..20]);
    folder.file("c.json", LCP);
    // read, but its joints contradict each other, which is told when it is solved
    folder.file("d.json", &super::joints::contradicting());
    let words = ["bench", &folder.path("."), "--repeat", "0", "--solver", "auto", "--solver", "pgs"];
    let run = moreau(&words);
    assert_eq!(run.code, 2, "{}{}", run.output, run.message);
    assert!(run.message.starts_with("error: 2 of 4 problems") && run.message.lines().count() == 1, "{}", run.message);
    let line = |start: &str| run.output.lines().find(|line| line.starts_with(start)).unwrap_or_default();
    assert!(line("b.dat").contains("W, line") && !line("b.dat").contains(&folder.path("")), "{}", run.output);
    assert!(line("d.json").contains("auto") && line("d.json").contains("contradicts"), "{}", run.output);
    assert!(line("auto:").contains("2 of 2 solved") && line("a.json").split_whitespace().nth(2) == Some("auto"), "{}", run.output);
    let json = moreau(&[&words[..], &["--format", "json"]].concat());
    assert_eq!(json.code, 2);
    let report = json.json();
    let named = |list: &str| -> Vec<String> {
        let lines = report[list].as_array().expect("a list").iter();
        lines.map(|line| format!("{} {}", line["problem"].as_str().expect("a name"), line["solver"].as_str().unwrap_or("-"))).collect()
    };
    assert_eq!(named("runs"), ["a.json auto", "a.json pgs", "c.json auto", "c.json pgs"]);
    assert_eq!(named("refused"), ["b.dat -", "d.json auto", "d.json pgs"]);
    super::schema::is_as("bench", &report, "/refused/0/reason", 7.into());
    // without them the code is that of the others, and nothing is said of refusals
    for name in ["b.dat", "d.json"] {
        std::fs::remove_file(folder.path(name)).expect("it is there");
    }
    let sound = moreau(&[&words[..], &["--format", "json"]].concat());
    assert_eq!((sound.code, sound.message.as_str(), sound.json().get("refused")), (0, "", None));
}

#[test]
fn answers_go_into_a_folder_and_a_file_in_its_place_is_named_before_anything_is_timed() {
    let folder = Folder::new("bench-answers-file");
    let (problem, file) = (folder.file("a.json", PROBLEM), folder.file("there.txt", "kept"));
    moreau(&["bench", &problem, "--repeat", "0", "--answers", &file]).is_refused(&[
        "`--answers`",
        "there.txt, which is a file",
        "a folder",
    ]);
    assert_eq!(std::fs::read_to_string(&file).expect("a file"), "kept");
    assert_eq!(moreau(&["bench", &problem, "--repeat", "0", "--answers", &folder.path("new/one")]).code, 0);
    assert!(std::path::Path::new(&folder.path("new/one/a.json.auto.json")).is_file());
}
