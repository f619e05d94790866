//! `moreau certify`.

use super::{Folder, PROBLEM, moreau};

/// The answer to [`PROBLEM`] with a normal impulse off by `error`; its velocity follows from it.
fn solution(error: f64) -> String {
    format!(r#"{{"schema": "solution/1", "impulse": [{:?}, -0.5], "velocity": [{:?}, 1.5]}}"#, 1.0 + error, error)
}

#[test]
fn residuals_have_units_and_a_solution_is_called_one() {
    let folder = Folder::new("certify");
    let problem = folder.file("problem.json", PROBLEM);
    let run = moreau(&["certify", &problem, &folder.file("solution.json", &solution(0.0))]);
    assert_eq!((run.code, run.message.as_str()), (0, ""));
    for (name, unit) in [("primal", "N·s"), ("dual", "m/s"), ("complementarity", "J"), ("natural_map", "N·s")] {
        let line = run.output.lines().find(|line| line.trim_start().starts_with(name));
        assert!(line.is_some_and(|line| line.contains(unit)), "{name} in {unit}: {}", run.output);
    }
}

#[test]
fn both_sides_of_the_tolerance() {
    // r_n = 1 + δ with u_n = δ: the largest relative residual is that of the natural map, of size δ/‖q‖ = δ/√5
    let folder = Folder::new("certify-sides");
    let problem = folder.file("problem.json", PROBLEM);
    let code = |error: f64, tolerance: &str| {
        let file = folder.file("solution.json", &solution(error));
        moreau(&["certify", &problem, &file, "--tolerance", tolerance, "--format", "json"])
    };
    for (error, tolerance, expected) in [(1e-6, "1e-4", 0), (1e-6, "1e-8", 1), (1e-10, "1e-8", 0), (1e-7, "1e-8", 1), (-1e-7, "1e-8", 1)] {
        let run = code(error, tolerance);
        assert_eq!(run.code, expected, "error {error} at {tolerance}: {}", run.output);
        assert_eq!(run.json()["solution"], expected == 0);
    }
    let default = |error: f64| moreau(&["certify", &problem, &folder.file("solution.json", &solution(error))]).code;
    assert_eq!((default(1e-10), default(1e-7)), (0, 1), "the default tolerance is 1e-8");
}

#[test]
fn a_stored_residual_is_not_believed_and_a_wrong_velocity_is_seen() {
    let folder = Folder::new("certify-lies");
    let problem = folder.file("problem.json", PROBLEM);
    let boast = solution(0.5).replace("}", r#", "residuals": {"primal": 0}}"#);
    let run = moreau(&["certify", &problem, &folder.file("boast.json", &boast)]);
    assert_eq!(run.code, 1, "{}{}", run.output, run.message);
    let velocity = solution(0.0).replace("1.5", "1.25");
    assert_eq!(moreau(&["certify", &problem, &folder.file("velocity.json", &velocity)]).code, 1);
}

#[test]
fn files_that_do_not_fit_or_cannot_be_read_are_refused() {
    let folder = Folder::new("certify-bad");
    let problem = folder.file("problem.json", PROBLEM);
    let good = folder.file("good.json", &solution(0.0));
    let short = folder.file("short.json", &solution(0.0).replace(", -0.5", ""));
    moreau(&["certify", &problem, &short]).is_refused(&["short.json", "impulse"]);
    moreau(&["certify", &problem, &folder.file("nan.json", &solution(0.0).replace("-0.5", "NaN"))]).is_refused(&["nan.json", "impulse"]);
    moreau(&["certify", &problem, &problem]).is_refused(&["problem.json", "schema"]);
    moreau(&["certify", &problem, &folder.path("missing.json")]).is_refused(&["missing.json", "cannot read"]);
    for tolerance in ["NaN", "-1", "inf"] {
        moreau(&["certify", &problem, &good, "--tolerance", tolerance]).is_refused(&["--tolerance"]);
    }
}

#[test]
fn an_answer_to_a_problem_of_another_name_is_refused() {
    let folder = Folder::new("certify-names");
    let answers = |name: &str| solution(0.0).replacen('{', &format!(r#"{{"problem": "{name}", "#), 1);
    let problem = folder.file("problem.json", PROBLEM);
    assert_eq!(moreau(&["certify", &problem, &folder.file("same.json", &answers("block"))]).code, 0);
    assert_eq!(moreau(&["certify", &problem, &folder.file("none.json", &solution(0.0))]).code, 0);
    moreau(&["certify", &problem, &folder.file("other.json", &answers("wheel"))]).is_refused(&["other.json", "problem", "wheel", "block"]);
}

#[test]
fn a_proof_names_a_radius_and_whether_the_velocities_are_unique() {
    let folder = Folder::new("certify-prove");
    let problem = folder.file("problem.json", PROBLEM);
    let file = folder.file("solution.json", &solution(1e-10));
    let run = moreau(&["certify", &problem, &file, "--prove"]);
    assert_eq!(run.code, 0, "{}{}", run.output, run.message);
    for part in ["proved by intervals", "at most one solution", "all 4 patterns tried, the solutions have exactly 1 velocity"] {
        assert!(run.output.contains(part), "{part}: {}", run.output);
    }
    let json = moreau(&["certify", &problem, &file, "--prove", "--format", "json"]).json();
    let bound = json["forward"]["radius"]["velocity"].as_f64().expect("a number");
    assert!((1e-10..1.01e-10).contains(&bound), "{bound}");
    assert_eq!((&json["solutions"]["unique"], &json["solutions"]["all"]["velocities"]), (&"solution".into(), &1.into()));
}

#[test]
fn a_problem_without_solution_is_refuted_with_a_witness() {
    let folder = Folder::new("certify-none");
    let walls = r#"{"schema": "contact-problem/1", "name": "walls", "dimension": 1, "law": "frictionless", "friction": [0, 0],
        "free_velocity": [-1, -0.5], "delassus": {"shape": [2, 2], "rows": [[1, -1], [-1, 1]]}}"#;
    let problem = folder.file("problem.json", walls);
    let answer = folder.file("answer.json", r#"{"schema": "solution/1", "impulse": [1, 0], "velocity": [0, -1.5]}"#);
    let run = moreau(&["certify", &problem, &answer, "--prove"]);
    assert_eq!(run.code, 1, "{}{}", run.output, run.message);
    for part in ["there is no solution; impulses p", "all 4 patterns tried, there is no solution", "not proved that the problem itself"] {
        assert!(run.output.contains(part), "{part}: {}", run.output);
    }
    let solved = moreau(&["solve", &problem]);
    assert!(solved.code == 1 && solved.message.contains("the problem has no solution"), "{}{}", solved.output, solved.message);
}
