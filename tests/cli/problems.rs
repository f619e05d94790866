//! `moreau problems`: the collection of contact problems with certified answers.

use super::{Folder, moreau};

#[test]
fn problems_are_listed_and_filtered() {
    let all = moreau(&["problems", "list", "--format", "json"]).json();
    let lines = all.as_array().expect("a list");
    assert!(lines.len() >= 100);
    let hard = moreau(&["problems", "list", "--hard", "--format", "json"]).json();
    assert!(hard.as_array().expect("a list").iter().all(|line| line["failures"].as_u64() >= Some(3)));
    let small = moreau(&["problems", "list", "--to", "1", "--law", "coulomb"]);
    assert!(small.code == 0 && small.output.contains("single-slide") && !small.output.contains("tower"), "{}", small.output);
    moreau(&["problems", "list", "--group", "sphere"]).is_refused(&["--group", "`spheres`"]);
    moreau(&["problems", "list", "--from", "10", "--to", "5"]).is_refused(&["`--from`: is 10", "--to is 5"]);
    assert_eq!(moreau(&["problems", "list", "--from", "5", "--to", "5"]).code, 0);
    moreau(&["problems", "list", "--velocity", "two"]).is_refused(&["--velocity", "unique"]);
}

#[test]
fn a_problem_is_shown_with_its_proofs_and_a_misspelt_one_with_its_neighbours() {
    let shown = moreau(&["problems", "show", "painleve-leaves"]);
    assert!(shown.code == 0 && shown.output.contains("velocity several") && shown.output.contains("answer 3"), "{}", shown.output);
    let record = moreau(&["problems", "show", "painleve-leaves", "--format", "json"]).json();
    assert_eq!((record["schema"].as_str(), record["uniqueness"]["count"].as_u64()), (Some("answered-problem/1"), Some(3)));
    moreau(&["problems", "show", "painleve-leave"]).is_refused(&["painleve-leaves"]);
}

#[test]
fn exported_problems_are_certified_in_both_formats_and_what_has_no_place_is_refused() {
    let folder = Folder::new("problems");
    let place = folder.path(".");
    assert_eq!(moreau(&["problems", "export", "single-slide", &place]).code, 0);
    assert_eq!(moreau(&["certify", &folder.path("single-slide.json"), &folder.path("single-slide.solution.json")]).code, 0);
    assert_eq!(moreau(&["problems", "export", "single-slide", &place, "--to", "fclib"]).code, 0);
    assert_eq!(moreau(&["certify", &folder.path("single-slide.hdf5")]).code, 0);
    moreau(&["problems", "export", "single-associated", &place, "--to", "fclib"]).is_refused(&["FCLIB", "contact-problem/1"]);
    moreau(&["problems", "export", "single-slide"]).is_refused(&["FOLDER"]);
    // the same again is nothing new; what was changed is kept
    assert_eq!(moreau(&["problems", "export", "single-slide", &place]).code, 0);
    let changed = folder.path("single-slide.json");
    std::fs::write(&changed, "mine").expect("can be written");
    moreau(&["problems", "export", "single-slide", &place]).is_refused(&[
        "`FOLDER`: has",
        "single-slide.json",
        "not what would be written",
    ]);
    assert_eq!(std::fs::read_to_string(&changed).expect("is there"), "mine");
    moreau(&["problems", "export", "--all"]).is_refused(&["`FOLDER`: is missing", "--all FOLDER"]);
    moreau(&["problems", "export"]).is_refused(&["`NAME`: is missing", "--all"]);
    moreau(&["problems", "export", "single-slide", &place, "--all"]).is_refused(&["--all"]);
}

#[test]
fn what_is_listed_and_not_exported_is_named_by_both_commands() {
    let folder = Folder::new("problems-all");
    let listed = moreau(&["problems", "list", "--format", "json"]).json();
    let listed = listed.as_array().expect("a list");
    let missing: Vec<&str> = listed.iter().filter(|line| line["stored"] == false).filter_map(|line| line["name"].as_str()).collect();
    assert!(missing.contains(&"tower-570"), "{missing:?}");
    let run = moreau(&["problems", "export", "--all", &folder.path("all")]);
    let (count, left) = (listed.len() - missing.len(), missing.len());
    assert!(run.code == 0 && run.output.starts_with(&format!("{count} problems in ")), "{}", run.output);
    let words =
        format!("{left} of them are listed and not exported, too large to be stored: {}; `moreau problems show", missing.join(", "));
    assert!(run.message.contains(&words) && run.message.lines().count() == 1, "{}", run.message);
    let text = moreau(&["problems", "list"]).output;
    assert!(text.contains(&words) && text.contains(&format!("{} problems of ", listed.len())), "{text}");
    // a list without them does not speak of them
    assert!(!moreau(&["problems", "list", "--to", "2"]).output.contains("too large"));
}

#[test]
fn a_problem_is_measured_and_one_without_solution_is_answered_no() {
    let folder = Folder::new("problems-measured");
    for name in ["single-slide", "rail-deep"] {
        assert_eq!(moreau(&["problems", "export", name, &folder.path(".")]).code, 0);
    }
    let measured = moreau(&["problems", "measure", &folder.path("single-slide.json"), "--format", "json"]);
    assert_eq!((measured.code, measured.json()["difficulty"]["sweeps"].as_u64()), (0, Some(1)));
    let given = folder.path("single-slide.solution.json");
    let with = moreau(&["problems", "measure", &folder.path("single-slide.json"), "--given", &given, "--format", "json"]);
    assert_eq!(with.json()["answers"].as_array().map(Vec::len), Some(1));
    let text = moreau(&["problems", "measure", &folder.path("single-slide.json")]).output;
    let head = text.lines().next().unwrap_or_default();
    assert!(["solver", "ended", "residual", "iterations", "[m/s]"].iter().all(|column| head.contains(column)), "{text}");
    let none = moreau(&["problems", "measure", &folder.path("rail-deep.json")]);
    assert!(none.code == 1 && none.output.contains("answers with different velocities: 0"), "{}", none.output);
}

#[test]
fn a_measurement_that_a_time_limit_ended_is_marked() {
    let folder = Folder::new("problems-measured-in-time");
    assert_eq!(moreau(&["problems", "export", "box-25-points", &folder.path("")]).code, 0);
    let problem = folder.path("box-25-points.json");
    let ask = |limit: &str| moreau(&["problems", "measure", &problem, "--time-limit", limit, "--format", "json"]);
    let (ended, whole) = (ask("1e-9").json(), ask("1e5").json());
    assert_eq!((&ended["reproducible"], whole.get("reproducible")), (&false.into(), None));
    let told = |json: &serde_json::Value| json.to_string().matches("ended by the time limit").count();
    assert!(told(&ended) > 3 && told(&whole) == 0, "{ended}");
    assert!(moreau(&["problems", "measure", &problem, "--time-limit", "1e-9"]).output.contains("another run need not find the same"));
    moreau(&["problems", "measure", &problem, "--time-limit", "0"]).is_refused(&["--time-limit", "above 0"]);
}

#[test]
fn every_solver_is_measured_and_shown_or_said_to_be_left_out() {
    let folder = Folder::new("problems-left-out");
    assert_eq!(moreau(&["problems", "export", "single-slide", &folder.path("")]).code, 0);
    let measured = moreau(&["problems", "measure", &folder.path("single-slide.json")]).output;
    let shown = moreau(&["problems", "show", "single-slide"]).output;
    for text in [&measured, &shown] {
        for name in moreau::solvers::ALL.names() {
            let is_line = |line: &str| line.split_whitespace().next() == Some(name);
            let is_left_out = |line: &str| line.starts_with("not asked: ") && line.split([' ', ',']).any(|word| word == name);
            assert_eq!(text.lines().filter(|line| is_line(line) || is_left_out(line)).count(), 1, "{name}: {text}");
        }
    }
    assert!(measured.contains("not asked: cg, gauss-pgs, sap, sequential-impulses (the engines' own iterations"), "{measured}");
}

#[test]
fn what_an_export_does_not_keep_is_told_and_a_file_in_the_place_of_its_folder_is_named() {
    let folder = Folder::new("problems-kept");
    let place = folder.path("out");
    let run = moreau(&["problems", "export", "painleve-leaves", &place, "--to", "fclib"]);
    assert_eq!(run.code, 0, "{}", run.message);
    assert!(
        run.message.contains("painleve-leaves: not kept in FCLIB's local form: ") && run.message.contains("all answers but the first (2)"),
        "{}",
        run.message
    );
    assert_eq!(moreau(&["problems", "export", "painleve-leaves", &place]).message, "", "contact-problem/1 keeps everything");
    let convex = moreau(&["problems", "export", "single-associated", &place, "--to", "fclib"]);
    assert!(convex.code == 2 && !convex.message.contains("--law"), "there is no such option: {}", convex.message);
    let file = folder.file("there", "kept");
    moreau(&["problems", "export", "single-slide", &file]).is_refused(&["`FOLDER`", "there, which is a file", "name a folder"]);
}
