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
    moreau(&["certify", &problem, &problem]).is_refused(&["problem.json", "SOLUTION"]);
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

/// An lcp/1 of two rows.
fn lcp(matrix: [[f64; 2]; 2], vector: [f64; 2]) -> String {
    format!(r#"{{"schema": "lcp/1", "name": "two", "matrix": {{"shape": [2, 2], "rows": {matrix:?}}}, "vector": {vector:?}}}"#)
}

#[test]
fn a_linear_complementarity_problem_is_proved_in_fractions() {
    let folder = Folder::new("certify-lcp");
    let problem = folder.file("lcp.json", &lcp([[2.0, 1.0], [1.0, 2.0]], [-1.0, -1.0]));
    let answer = |name: &str, z: [f64; 2]| {
        let velocity = [2.0 * z[0] + z[1] - 1.0, z[0] + 2.0 * z[1] - 1.0];
        folder.file(name, &format!(r#"{{"schema": "solution/1", "problem": "two", "impulse": {z:?}, "velocity": {velocity:?}}}"#))
    };
    let proved = |file: &str| moreau(&["certify", &problem, file, "--prove", "--format", "json"]);
    let third = 1.0 / 3.0;
    let run = proved(&answer("good.json", [third, third]));
    assert_eq!((run.code, &run.json()["lcp"]["near"]["in"]), (0, &"fractions".into()), "{}", run.output);
    let distance = run.json()["lcp"]["near"]["distance"].as_f64().unwrap();
    assert!(distance > 0.0 && distance < 1e-16, "{distance}");
    assert_eq!(run.json()["lcp"]["solutions"], "one");
    let run = proved(&answer("moved.json", [third + 0.125, third]));
    assert_eq!(run.code, 1, "{}", run.output);
    assert!(run.json()["lcp"]["near"]["distance"].as_f64().unwrap() >= 0.125 - f64::EPSILON, "third + ⅛ and third are rounded");
    let run = moreau(&["certify", &problem, &answer("again.json", [third, third]), "--prove"]);
    assert!(run.output.contains("proved in fractions: a solution z") && run.output.contains("exactly one solution"), "{}", run.output);
}

#[test]
fn how_many_solutions_there_are_is_proved_without_an_answer() {
    let folder = Folder::new("certify-count");
    let count = |name: &str, matrix, vector| {
        let file = folder.file(name, &lcp(matrix, vector));
        let text = moreau(&["certify", &file, "--prove"]);
        let json = moreau(&["certify", &file, "--prove", "--format", "json"]);
        assert_eq!(text.code, json.code);
        (json.code, json.json(), text.output)
    };
    let (code, json, _) = count("three.json", [[1.0, 2.0], [2.0, 1.0]], [-1.0, -1.0]);
    assert_eq!((code, &json["status"], json["lcp"]["points"].as_array().unwrap().len()), (0, &"solvable".into(), 3));
    let (code, json, text) = count("segment.json", [[1.0, 1.0], [1.0, 1.0]], [-1.0, -1.0]);
    assert_eq!((code, &json["lcp"]["solutions"]), (0, &"continuum".into()));
    assert!(text.contains("infinitely many"), "{text}");
    let (code, json, text) = count("none.json", [[0.0, 1.0], [0.0, 0.0]], [-1.0, 1.0]);
    assert_eq!((code, &json["status"]), (1, &"infeasible".into()));
    assert!(text.contains("NO solution"), "{text}");
    let (code, json, _) = count("empty.json", [[0.0, 0.0], [0.0, 1.0]], [-1.0, 1.0]);
    assert_eq!((code, &json["lcp"]["witness"]), (1, &serde_json::json!(["1", "0"])));
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
fn in_space_the_velocities_of_few_contacts_and_the_impulses_of_a_velocity_are_counted() {
    let folder = Folder::new("certify-space");
    // Painlevé's rod: it lifts off, slides, or is jammed
    let rod = r#"{"schema": "contact-problem/1", "name": "rod", "dimension": 3, "law": "coulomb", "friction": [1],
        "free_velocity": [1, 4, 0], "delassus": {"shape": [3, 3], "rows": [[1, 2, 0], [2, 5, 0], [0, 0, 1]]}}"#;
    let answer = r#"{"schema": "solution/1", "impulse": [3, -2, 0], "velocity": [0, 0, 0]}"#;
    let files = [folder.file("rod.json", rod), folder.file("jammed.json", answer)];
    let run = moreau(&["certify", &files[0], &files[1], "--prove"]);
    assert_eq!(run.code, 0, "{}{}", run.output, run.message);
    for part in ["all 3 patterns tried in", "the solutions have exactly 3 velocities", "no other impulses give this velocity"] {
        assert!(run.output.contains(part), "{part}: {}", run.output);
    }
    // exactly on the border between sticking and sliding nothing is counted, and the reason is told
    let border = r#"{"schema": "contact-problem/1", "name": "border", "dimension": 3, "law": "coulomb", "friction": [3],
        "free_velocity": [-1, -3, 0], "delassus": {"shape": [3, 3], "rows": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}}"#;
    let stuck = r#"{"schema": "solution/1", "impulse": [1, 3, 0], "velocity": [0, 0, 0]}"#;
    let files = [folder.file("border.json", border), folder.file("stuck.json", stuck)];
    let json = moreau(&["certify", &files[0], &files[1], "--prove", "--format", "json"]).json();
    assert!(json["solutions"].get("all").is_none() && json["solutions"]["undecided"].is_array(), "{json}");
    // two contacts at one place share the weight in any way
    let twice = r#"{"schema": "contact-problem/1", "name": "twice", "dimension": 2, "law": "coulomb", "friction": [0, 0],
        "free_velocity": [-1, 0, -1, 0],
        "delassus": {"shape": [4, 4], "rows": [[1, 0, 1, 0], [0, 1, 0, 1], [1, 0, 1, 0], [0, 1, 0, 1]]}}"#;
    let shared = r#"{"schema": "solution/1", "impulse": [0.5, 0, 0.5, 0], "velocity": [0, 0, 0, 0]}"#;
    let files = [folder.file("twice.json", twice), folder.file("shared.json", shared)];
    let json = moreau(&["certify", &files[0], &files[1], "--prove", "--format", "json"]).json();
    assert_eq!(json["forward"]["impulse_set"], serde_json::json!({"at_least": 1, "at_most": 1}), "{json}");
}

#[test]
fn a_problem_without_solution_is_refuted_with_a_witness() {
    let folder = Folder::new("certify-none");
    // a body that slides along two walls, which close in
    let walls = r#"{"schema": "contact-problem/1", "name": "walls", "dimension": 2, "law": "coulomb", "friction": [0.5, 0.5],
        "free_velocity": [-1, 2, -0.5, 2],
        "delassus": {"shape": [4, 4], "rows": [[1, 0, -1, 0], [0, 1, 0, 1], [-1, 0, 1, 0], [0, 1, 0, 1]]}}"#;
    let problem = folder.file("problem.json", walls);
    let answer = folder.file("answer.json", r#"{"schema": "solution/1", "impulse": [1, -0.5, 0, 0], "velocity": [0, 1.5, -1.5, 1.5]}"#);
    let run = moreau(&["certify", &problem, &answer, "--prove"]);
    assert_eq!(run.code, 1, "{}{}", run.output, run.message);
    for part in ["there is no solution; impulses p", "all 16 patterns tried, there is no solution", "not proved that the problem itself"] {
        assert!(run.output.contains(part), "{part}: {}", run.output);
    }
    let solved = moreau(&["solve", &problem]);
    assert!(solved.code == 1 && solved.message.contains("the problem has no solution"), "{}{}", solved.output, solved.message);
}

#[test]
fn polyhedral_laws_have_the_ordinary_verdict_and_the_proof_of_their_complementarity_problem() {
    let folder = Folder::new("certify-polyhedral");
    let of = |law: &str| {
        let rows = r#"{"shape": [3, 3], "rows": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}"#;
        let name = format!("{law}.json");
        let text = format!(
            r#"{{"schema": "contact-problem/1", "name": "block", "dimension": 3, "law": "{law}", "directions": 4,
                "friction": [0.5], "free_velocity": [-1, 2, 0], "delassus": {rows}}}"#
        );
        folder.file(&name, &text)
    };
    let answer = |r_t: f64| {
        let text = format!(r#"{{"schema": "solution/1", "impulse": [1, {r_t}, 0], "velocity": [0, {}, 0]}}"#, 2.0 + r_t);
        folder.file(&format!("answer{r_t}.json"), &text)
    };
    let problem = of("polyhedral-coulomb");
    let run = moreau(&["certify", &problem, &answer(-0.5), "--prove"]);
    assert_eq!(run.code, 0, "{}{}", run.output, run.message);
    for part in
        ["proved in fractions: impulses that differ by at most 0 N·s", "a solution (λ, β, σ)", "a solution to the relative tolerance"]
    {
        assert!(run.output.contains(part), "{part}: {}", run.output);
    }
    let run = moreau(&["certify", &problem, &answer(-0.25), "--prove", "--format", "json"]);
    assert_eq!((run.code, &run.json()["lcp"]["near"]["distance"]), (1, &0.25.into()), "{}", run.output);
    let run = moreau(&["certify", &of("polyhedral-associated"), &answer(0.25), "--prove", "--format", "json"]);
    // the solution is r = (1.6, −0.8, 0)
    let radius = &run.json()["forward"]["radius"];
    let far = 0.6f64.hypot(1.05);
    assert_eq!((run.code, &run.json()["forward"]["proved"]), (1, &true.into()), "{}{}", run.output, run.message);
    assert!(radius["impulse"].as_f64().is_some_and(|moved| moved >= far && moved <= 1.001 * far), "{radius}");
}

#[test]
fn an_lcp_has_no_units_and_a_problem_may_have_no_name() {
    let folder = Folder::new("certify-units");
    let lcp = folder.file("lcp.json", r#"{"schema": "lcp/1", "matrix": {"shape": [2, 2], "rows": [[2, 1], [0, 1]]}, "vector": [-1, 2]}"#);
    let answer = folder.file("answer.json", r#"{"schema": "solution/1", "impulse": [0.5, 0]}"#);
    for more in [&[][..], &["--prove"]] {
        let run = moreau(&[&["certify", &lcp, &answer], more].concat());
        assert!(run.code == 0 && run.output.starts_with("linear complementarity problem without a name, rows: 2; "), "{}", run.output);
        assert!(!["N·s", "m/s", " J "].iter().any(|unit| run.output.contains(unit)), "{}", run.output);
    }
    let solved = moreau(&["solve", &lcp]);
    assert!(solved.code == 0 && !solved.message.contains("N·s") && !solved.message.contains("``"), "{}", solved.message);
    let unnamed = folder.file("unnamed.json", &PROBLEM.replace("\"block\"", "\"\""));
    let solved = moreau(&["solve", &unnamed]);
    assert!(solved.message.starts_with("problem without a name, law coulomb") && solved.message.contains("N·s"), "{}", solved.message);
}

#[test]
fn the_example_in_the_help_parses_and_is_a_solution() {
    let folder = Folder::new("certify-help");
    let help = moreau(&["certify", "--help"]).output;
    let starts: Vec<usize> = help.match_indices("{\"schema\"").map(|(start, _)| start).collect();
    let parsed = |start: &usize| serde_json::Deserializer::from_str(&help[*start..]).into_iter::<serde_json::Value>().next();
    let texts = starts.iter().filter_map(|start| Some(parsed(start)?.ok()?.to_string()));
    let [problem, solution]: [String; 2] = texts.collect::<Vec<_>>().try_into().expect("a problem and a solution");
    assert!(solution.contains("solution/1"), "{solution}");
    let (problem, solution) = (folder.file("problem.json", &problem), folder.file("solution.json", &solution));
    let run = moreau(&["certify", &problem, &solution]);
    assert_eq!(run.code, 0, "{}{}", run.output, run.message);
    // it is the problem that `moreau new problem` writes
    let written = moreau(&["new", "problem"]).json();
    assert_eq!(serde_json::from_str::<serde_json::Value>(&std::fs::read_to_string(&problem).expect("written")).expect("JSON"), written);
}

#[test]
fn an_answer_too_large_for_proofs_is_none_with_proofs_as_without() {
    let folder = Folder::new("certify-large");
    let lcp = r#"{"schema": "lcp/1", "matrix": {"shape": [1, 1], "rows": [[1]]}, "vector": [-1]}"#;
    let joined = r#"{"schema": "contact-problem/1", "name": "rod", "dimension": 1, "law": "frictionless", "friction": [0, 0],
        "kinds": ["contact", {"bilateral": 1}], "free_velocity": [-3, -1.5],
        "delassus": {"shape": [2, 2], "rows": [[1, 0.5], [0.5, 1]]}}"#;
    for (k, (problem, rows)) in [(PROBLEM, 2), (lcp, 1), (joined, 2)].into_iter().enumerate() {
        let problem = folder.file(&format!("{k}.json"), problem);
        for (size, told) in [("1e308", true), ("1e150", false)] {
            let answer = format!(r#"{{"schema": "solution/1", "impulse": [{}]}}"#, vec![size; rows].join(","));
            let answer = folder.file("answer.json", &answer);
            for more in [&[][..], &["--prove"]] {
                let run = moreau(&[&["certify", &problem, &answer], more].concat());
                assert_eq!(run.code, 1, "{problem} {size} {more:?}: {}{}", run.output, run.message);
                let is_told = run.output.contains("no backward error is proved: the impulses move contacts faster than numbers tell");
                assert_eq!(is_told, told && !more.is_empty(), "{}", run.output);
            }
        }
    }
}

/// z₀ is nothing by its own size and carries row 1: no W of bodies has such entries (docs/decisions.md).
#[test]
fn an_impulse_that_is_nothing_by_its_size_and_carries_another_row_is_refused_at_its_own() {
    let folder = Folder::new("certify-no-bodies");
    let rows = "[[0, 0, 0], [1e20, 0, 0], [1, 0, 1]]";
    let lcp = format!(r#"{{"schema": "lcp/1", "matrix": {{"shape": [3, 3], "rows": {rows}}}, "vector": [1, -1, -1]}}"#);
    let problem = folder.file("lcp.json", &lcp);
    let answer = folder.file("answer.json", r#"{"schema": "solution/1", "impulse": [1e-20, 0, 1]}"#);
    let run = moreau(&["certify", &problem, &answer]);
    let marked = |line: &&str| line.starts_with('✗');
    let marked: Vec<&str> = run.output.lines().filter(marked).collect();
    assert!(run.code == 1 && matches!(marked[..], [line] if line.starts_with("✗ normal") && line.ends_with(" 0")), "{}", run.output);
    let run = moreau(&["certify", &problem, &answer, "--prove"]);
    assert!(run.code == 1 && run.output.contains("NO solution"), "{}", run.output);
}

#[test]
fn a_norm_that_is_no_number_is_told_where_it_refuses_an_answer() {
    let folder = Folder::new("certify-no-number");
    let answer = folder.file("answer.json", r#"{"schema": "solution/1", "impulse": [0, 0]}"#);
    let of = |fast: &str| {
        let rows = r#"{"shape": [2, 2], "rows": [[1, 0], [0, 1]]}"#;
        folder.file("lcp.json", &format!(r#"{{"schema": "lcp/1", "matrix": {rows}, "vector": [{fast}, {fast}]}}"#))
    };
    assert_eq!(moreau(&["certify", &of("1e200"), &answer]).code, 0);
    let run = moreau(&["certify", &of("1.5e308"), &answer]);
    assert!(run.code == 1 && run.output.contains("velocity_scale is no number"), "{}", run.output);
    let run = moreau(&["certify", &of("1.5e308"), &answer, "--format", "json"]);
    assert!(run.code == 1 && run.json()["no_number"] == "velocity_scale", "{}", run.output);
}

/// W of three rows was formed in doubles of two velocities: p = (0.58, 1, 0.30) moves all but nothing, and p·q is a last digit.
#[test]
fn what_only_rounding_made_unsolvable_is_accepted_and_what_closes_is_not() {
    let folder = Folder::new("certify-rounded");
    let posed = |first: f64| {
        let w = "[[2.6806097203857906, -1.6443686372074238, 0.30607464058927375], [-1.6443686372074238, 1.0402492740068874, \
                 -0.2943839427055549], [0.30607464058927375, -0.2943839427055549, 0.3953971060099041]]";
        let name = format!("rounded-{first:e}.json");
        let text = format!(
            r#"{{"schema": "contact-problem/1", "name": "rounded", "dimension": 1, "law": "frictionless", "friction": [0, 0, 0],
                "delassus": {{"shape": [3, 3], "rows": {w}}}, "free_velocity": [{first:?}, -0.268637167154688, 0.32275739045707313]}}"#
        );
        folder.file(&name, &text)
    };
    // 300 p more than one that has r₃ = 0
    let given = r#"{"schema": "solution/1", "impulse": [175.44526846356695, 302.707051141774, 88.74619917040204]}"#;
    let given = folder.file("given.json", given);
    let rounded = posed(0.2987281051999135);
    for arguments in [vec!["certify", &rounded, &given], vec!["solve", &rounded], vec!["solve", &rounded, "--solver", "newton-min"]] {
        let run = moreau(&arguments);
        assert_eq!(run.code, 0, "{arguments:?}: {}{}", run.output, run.message);
    }
    let proved = moreau(&["certify", &rounded, &given, "--prove"]);
    assert!(proved.code == 1 && proved.output.contains("NO solution"), "the exact truth: {}", proved.output);
    // 10⁻⁷ m/s of closing are within the tolerance of such impulses, and are no rounding
    let closing = posed(0.2987281051999135 - 1e-7);
    let run = moreau(&["certify", &closing, &given]);
    assert!(run.code == 1 && run.output.contains("the problem has no solution"), "{}", run.output);
}

#[test]
fn what_rounding_made_unsolvable_hides_nothing_that_closes() {
    let folder = Folder::new("certify-hidden");
    let posed = |name: &str, w: &[&[f64]], free: &[f64], impulse: &[f64]| {
        let (n, zeros) = (free.len(), vec![0.0; free.len()]);
        let text = format!(
            r#"{{"schema": "contact-problem/1", "name": "{name}", "dimension": 1, "law": "frictionless", "friction": {zeros:?},
                "delassus": {{"shape": [{n}, {n}], "rows": {w:?}}}, "free_velocity": {free:?}}}"#
        );
        let problem = folder.file(&format!("{name}.json"), &text);
        let answer = folder.file(&format!("{name}-answer.json"), &format!(r#"{{"schema": "solution/1", "impulse": {impulse:?}}}"#));
        [moreau(&["certify", &problem, &answer]), moreau(&["solve", &problem])]
    };
    // a jaw that closes at 10⁻⁶ of what its third contact stops, alone and beside two walls that agree but for a last digit
    let last = 1.0 - 0.5f64.powi(52);
    let jaw: [&[f64]; 5] = [
        &[1.0, -1.0, 0.25, 0.0, 0.0],
        &[-1.0, 1.0, -0.25, 0.0, 0.0],
        &[0.25, -0.25, 2.0, 0.0, 0.0],
        &[0.0, 0.0, 0.0, 1.0, -1.0],
        &[0.0, 0.0, 0.0, -1.0, 1.0],
    ];
    let (free, impulse) = ([-1e-4, -1e-4, -100.0, -1.0, last], [2e4, 2e4 + 12.903225806451612, 51.61290322580645, 1.0, 0.0]);
    let alone: Vec<&[f64]> = jaw[..3].iter().map(|row| &row[..3]).collect();
    for run in posed("jaw", &alone, &free[..3], &impulse[..3]).into_iter().chain(posed("beside", &jaw, &free, &impulse)) {
        let told = run.output + &run.message;
        assert!(run.code == 1 && told.contains("the problem has no solution"), "{told}");
    }
    // y₃ = r₃ + 1 > 0, so that r₃ = 0 and y₁ + y₂ = −δ: the rounding of such impulses hides it, and no pattern is a solution
    let w: [&[f64]; 3] = [&[1.0, -1.0, 0.0], &[-1.0, 1.0, 1.0], &[0.0, 0.0, 1.0]];
    for (delta, push) in [(5e-6, 1e9), (1e-8, 1e7), (1e-9, 1e7)] {
        let [certified, _] = posed(&format!("hidden-{delta:e}"), &w, &[-1.0, 1.0 - delta, 1.0], &[push + 1.0, push, 0.0]);
        assert!(certified.code == 1, "{delta:e}: {}", certified.output);
    }
}
