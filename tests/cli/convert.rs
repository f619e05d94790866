//! `moreau convert`.

use super::bench::{DAT, spatial};
use super::{Folder, PROBLEM, moreau};
use moreau::nalgebra::dvector;
use moreau::problem::{ContactProblem, Solution, StoredAnswers};
use moreau::solvers::{Auto, ContactSolver};
use std::path::Path;

#[test]
fn a_converted_problem_is_the_same_number_for_number() {
    let folder = Folder::new("convert");
    let dat = folder.file("b.dat", DAT);
    let [json, hdf5, back] = ["b.json", "b.hdf5", "back.json"].map(|name| folder.path(name));
    for (from, to) in [(&dat, &json), (&json, &hdf5), (&hdf5, &back)] {
        assert_eq!(moreau(&["convert", from, "--out", to]).code, 0, "{from} to {to}");
    }
    let [first, last] = [&json, &back].map(|file| ContactProblem::read(std::path::Path::new(file)).unwrap());
    assert_eq!((first.dense(), first.free_velocity(), first.friction()), (last.dense(), last.free_velocity(), last.friction()));
    assert_eq!(moreau(&["convert", &dat]).json()["law"], "coulomb");
    assert_eq!(moreau(&["convert", &dat, "--law", "associated"]).json()["law"], "associated");
    moreau(&["convert", &dat, "--out", &folder.path("b.xml")]).is_refused(&["--out", ".json"]);
    moreau(&["convert", &dat, "--out", &dat]).is_refused(&["--out"]);
}

/// The spatial block in an HDF5 file with a solution and two guesses, whose velocities are not those of the impulses.
fn with_answers(folder: &Folder, name: &str) -> (String, StoredAnswers) {
    let (problem, file) = (spatial(), folder.path(name));
    let pair = |r: f64, u: f64| Solution::new("stored", dvector![r, 1.0 / 3.0, -0.0], dvector![u, f64::from_bits(1), 7.0], 0);
    let mut answers = StoredAnswers::default();
    answers.solution = Some(pair(0.1, 0.2));
    answers.guesses = vec![pair(0.3, 0.4), pair(0.5, 0.6)];
    std::fs::write(&file, problem.to_fclib_with(&answers).expect("well formed")).expect("a writable folder");
    (file, answers)
}

#[test]
fn from_hdf5_to_hdf5_the_solution_and_the_guesses_are_kept_bit_for_bit() {
    let folder = Folder::new("convert-answers");
    let (file, answers) = with_answers(&folder, "from.hdf5");
    let to = folder.path("to.h5");
    let run = moreau(&["convert", &file, "--out", &to]);
    assert_eq!((run.code, run.output.as_str(), run.message.as_str()), (0, "", ""));
    let kept = StoredAnswers::read(Path::new(&to)).expect("well formed");
    assert_eq!((kept.solution, kept.guesses, kept.left_out), (answers.solution, answers.guesses, answers.left_out));
    // what is cut off is named, and nothing is written
    let bytes = std::fs::read(&file).expect("written");
    let mut tried = 0;
    for end in (bytes.len() / 2..bytes.len()).step_by(211) {
        std::fs::write(folder.path("cut.hdf5"), &bytes[..end]).expect("a writable folder");
        if StoredAnswers::read(Path::new(&folder.path("cut.hdf5"))).is_err() {
            moreau(&["convert", &folder.path("cut.hdf5"), "--out", &folder.path("no.hdf5")]).is_refused(&["cut.hdf5"]);
            tried += 1;
        }
    }
    assert!(tried > 0 && !folder.names().contains(&"no.hdf5".into()), "{tried}");
}

#[test]
fn an_answer_is_written_with_its_problem() {
    let folder = Folder::new("convert-solution");
    let problem = spatial();
    let json = folder.file("block.json", &problem.to_json());
    let answer = Auto.solve(&problem, None).expect("it slides");
    let file = folder.file("answer.json", &answer.to_json(None, None));
    let to = folder.path("block.hdf5");
    let run = moreau(&["convert", &json, "--solution", &file, "--out", &to]);
    assert_eq!((run.code, run.message.as_str()), (0, ""));
    let stored = StoredAnswers::read(Path::new(&to)).expect("well formed").solution.expect("it was given");
    assert_eq!((&stored.impulse, &stored.velocity), (&answer.impulse, &answer.velocity));
    assert_eq!(moreau(&["certify", &to]).code, 0);
    // it takes the place of a stored one, and guesses are kept
    let (from, answers) = with_answers(&folder, "from.hdf5");
    let run = moreau(&["convert", &from, "--solution", &file, "--out", &to]);
    assert!(run.code == 0 && run.message.contains("stored solution, which the given one replaces"), "{}", run.message);
    let again = StoredAnswers::read(Path::new(&to)).expect("well formed");
    assert_eq!((again.solution.expect("it was given").impulse, again.guesses), (answer.impulse, answers.guesses));
}

#[test]
fn an_answer_that_does_not_fit_is_refused_and_one_that_is_no_solution_is_told() {
    let folder = Folder::new("convert-misfit");
    let json = folder.file("block.json", &spatial().into_builder().name("block").build().expect("sizes fit").to_json());
    let out = folder.path("block.hdf5");
    let convert = |text: &str| moreau(&["convert", &json, "--solution", &folder.file("answer.json", text), "--out", &out]);
    convert(r#"{"schema": "solution/1", "impulse": [1, 0]}"#).is_refused(&["answer.json", "has size 2; give size 3"]);
    let misfit = r#"{"schema": "solution/1", "impulse": [1, 0, 0], "velocity": [1, 0]}"#;
    convert(misfit).is_refused(&["answer.json", "has size 2"]);
    let other = r#"{"schema": "solution/1", "problem": "wheel", "impulse": [1, 0, 0]}"#;
    convert(other).is_refused(&["answer.json", "“wheel”", "“block”"]);
    convert(PROBLEM).is_refused(&["SOLUTION", "a problem and no answer", "--solution SOLUTION"]);
    assert!(!folder.names().contains(&"block.hdf5".into()));
    let run = convert(r#"{"schema": "solution/1", "impulse": [3, 0, 0]}"#);
    assert!(run.code == 0 && run.message.contains("answer.json: is no solution"), "{}", run.message);
    let answer = folder.file("answer.json", r#"{"schema": "solution/1", "impulse": [1, -0.5, 0]}"#);
    moreau(&["convert", &json, "--solution", &answer]).is_refused(&["--solution", "no place for an answer", ".hdf5"]);
    moreau(&["convert", &json, "--solution", &answer, "--out", &folder.path("b.json")]).is_refused(&["--solution", ".hdf5"]);
    std::fs::copy(&out, folder.path("stored.hdf5")).expect("written");
    moreau(&["convert", &json, "--solution", &folder.path("stored.hdf5"), "--out", &folder.path("stored.hdf5")])
        .is_refused(&["--out", "input"]);
}

/// The remark on the name says what is done with it: it stands in the title, is not read as the name, and a copy keeps the title.
#[test]
fn the_name_is_kept_as_the_title_and_read_from_the_file() {
    let folder = Folder::new("convert-name");
    let spatial = PROBLEM.replace("\"dimension\": 2", "\"dimension\": 3").replace("[-1, 2]", "[-1, 2, 0]");
    let spatial =
        spatial.replace(r#"{"shape": [2, 2], "rows": [[1, 0], [0, 1]]}"#, r#"{"shape": [3, 3], "rows": [[1,0,0],[0,1,0],[0,0,1]]}"#);
    let json = folder.file("from.json", &spatial);
    let [other, again] = ["other.hdf5", "again.h5"].map(|name| folder.path(name));
    let run = moreau(&["convert", &json, "--out", &other]);
    assert!(run.code == 0 && run.message.contains("`block` as the name (it is kept as `info/title`"), "{}", run.message);
    assert_eq!(moreau(&["convert", &other, "--out", &again]).message, "");
    for file in [&other, &again] {
        let info = StoredAnswers::read(Path::new(file)).expect("well formed").info;
        assert!(info.iter().any(|(name, text)| name == "title" && text == "block"), "{info:?}");
    }
    let back = moreau(&["convert", &other]);
    assert_eq!(back.json()["name"], "other");
    assert!(back.message.contains("`info/title` (“block”)"), "{}", back.message);
    // under its own name nothing is lost
    let own = folder.path("block.hdf5");
    assert_eq!(moreau(&["convert", &json, "--out", &own]).message, "");
    let back = moreau(&["convert", &own]);
    assert_eq!((back.json()["name"].as_str(), back.message.as_str()), (Some("block"), ""));
}

#[test]
fn what_is_not_kept_is_told_in_a_line() {
    let folder = Folder::new("convert-dropped");
    let rich = r#"{"schema": "contact-problem/1", "name": "block", "dimension": 3, "law": "coulomb",
      "friction": [0.5], "bodies": [[0, null]],
      "keys": [{"bodies": [0, null], "features": [0, 0]}], "free_velocity": [-1, 2, 0], "provenance": {"by": "hand"},
      "mass": {"shape": [3, 3], "rows": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]},
      "jacobian": {"shape": [3, 3], "rows": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}}"#;
    let json = folder.file("rich.json", rich);
    let said = |run: super::Run, form: &str| {
        assert_eq!((run.code, run.message.lines().count()), (0, 1), "{}", run.message);
        let start = format!(" not kept in {form}: ");
        run.message.split_once(&start).unwrap_or_else(|| panic!("{}", run.message)).1.trim_end().to_string()
    };
    let fields = "`mass`, `jacobian` (W, which follows, is kept), `bodies`, `keys`, `provenance`";
    let other = moreau(&["convert", &json, "--out", &folder.path("other.hdf5")]);
    assert_eq!(
        said(other, "FCLIB's local form"),
        format!("{fields}, `block` as the name (it is kept as `info/title`; the name of the file is read)")
    );
    assert_eq!(said(moreau(&["convert", &json, "--out", &folder.path("block.hdf5")]), "FCLIB's local form"), fields);
    let again = moreau(&["convert", &json]);
    assert!(again.json()["mass"].is_object() && again.json()["keys"].is_array());
    assert_eq!(said(again, "contact-problem/1"), "`provenance`");
    let (from, _) = with_answers(&folder, "from.hdf5");
    assert_eq!(said(moreau(&["convert", &from]), "contact-problem/1"), "the stored solution, the stored guesses (2)");
    let plain = folder.file("plain.dat", DAT);
    assert_eq!(moreau(&["convert", &plain, "--out", &folder.path("plain.hdf5")]).message, "");
}

#[test]
fn what_fclib_has_no_place_for_names_the_file_and_the_cure() {
    let folder = Folder::new("convert-fclib");
    let text = spatial().to_json();
    let shifted = text.replace("\"shift\":[0.0,0.0,0.0]", "\"shift\":[0.5,0,0]");
    let soft = text.replacen('{', r#"{"compliance": {"coordinates": "contact", "diagonal": [1, 1, 1]}, "#, 1);
    let cases = [
        ("shift.json", shifted, ["a shift", "leave `shift` out"]),
        ("soft.json", soft, ["a compliance", "leave `compliance` out"]),
        ("convex.json", text.replace("coulomb", "associated"), ["laws other", "--law coulomb"]),
        ("limits.json", super::joints::BOB.into(), ["limits or bilateral", "`moreau solve`"]),
    ];
    let out = folder.path("out.hdf5");
    for (name, problem, words) in cases {
        let file = folder.file(name, &problem);
        moreau(&["convert", &file, "--out", &out]).is_refused(&[&[name][..], &words].concat());
    }
    let convex = folder.path("convex.json");
    assert_eq!(moreau(&["convert", &convex, "--law", "coulomb", "--out", &out]).code, 0, "the cure helps");
    let text = moreau(&["convert", &folder.path("shift.json"), "--out", &folder.path("kept.json")]);
    assert_eq!((text.code, text.message.as_str()), (0, ""), "contact-problem/1 has a place for it");
}

#[test]
fn what_describes_a_problem_is_kept_in_hdf5_and_told_elsewhere() {
    let folder = Folder::new("convert-info");
    let mut answers = StoredAnswers::default();
    answers.info = vec![("description".into(), "boxes on a table, step 122".into()), ("math_info".into(), "H full rank".into())];
    let [from, to] = ["from.hdf5", "to.hdf5"].map(|name| folder.path(name));
    std::fs::write(&from, spatial().to_fclib_with(&answers).expect("well formed")).expect("a writable folder");
    let run = moreau(&["convert", &from, "--out", &to]);
    assert_eq!((run.code, run.message.as_str()), (0, ""));
    let kept = StoredAnswers::read(Path::new(&to)).expect("well formed").info;
    assert!(answers.info.iter().all(|text| kept.contains(text)), "{kept:?}");
    let run = moreau(&["convert", &from]);
    assert!(run.message.contains("`info/description` (“boxes on a table, step 122”), `info/math_info`"), "{}", run.message);
}

#[test]
fn a_stored_answer_with_a_number_that_is_none_is_one_error() {
    let folder = Folder::new("convert-nan");
    let problem = spatial();
    for value in [f64::NAN, f64::INFINITY] {
        let mut answers = StoredAnswers::default();
        answers.solution = Some(Solution::new("", dvector![1.0, value, 0.0], dvector![0.0, 0.0, 0.0], 0));
        let file = folder.path("from.hdf5");
        std::fs::write(&file, problem.to_fclib_with(&answers).expect("well formed")).expect("a writable folder");
        let words = ["from.hdf5", "`solution/r[1]`", &format!("is {value}"), "use a finite number"];
        moreau(&["certify", &file]).is_refused(&words);
        moreau(&["convert", &file, "--out", &folder.path("to.hdf5")]).is_refused(&words);
        let json = folder.file("problem.json", &problem.to_json());
        moreau(&["certify", &json, &file]).is_refused(&words);
        moreau(&["solve", &json, "--start", &file]).is_refused(&words);
    }
}
