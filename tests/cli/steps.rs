//! Steps that the certificate rejects: exit codes, files, and what the summary says.

use super::{Folder, Run, moreau};

/// A box that lands tilted on the ground and tumbles; e = 0.2, μ = 0.8.
const TUMBLING: &str = r#"{"schema": "scene/1", "name": "tumbling", "gravity": [0, 0, -9.81], "duration": 0.4,
    "bodies": [{"name": "box", "mass": 1, "box": {"half_extents": [0.12, 0.08, 0.1]}, "position": [0, 0, 0.25],
                "orientation": [0.8, 0.36, 0.48, 0], "linear_velocity": [0.7, -0.3, -0.5], "angular_velocity": [3, -2, 4]}],
    "material": {"friction": 0.8, "restitution": 0.2}, "ground": {"normal": [0, 0, 1], "offset": 0}}"#;

fn simulate(folder: &Folder, options: &[&str]) -> Run {
    let scene = folder.path("tumbling.json");
    std::fs::write(&scene, TUMBLING).expect("written");
    moreau(&[&["simulate", "--scene", &scene, "--step", "0.005"], options].concat())
}

#[test]
fn every_step_is_certified_and_the_summary_names_the_worst() {
    let folder = Folder::new("steps-accepted");
    let run = simulate(&folder, &[]);
    assert_eq!((run.code, run.message.as_str()), (0, ""));
    let told = &run.output[run.output.find("steps the certificate rejects: 0 of 80, worst").expect("it is told")..];
    let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(told.contains("contact box/ground") && told.contains("t = "), "{told}");
    let steps = &simulate(&folder, &["--format", "json"]).json()["steps"];
    assert_eq!((steps["rejected"].as_u64(), steps["steps"].as_u64()), (Some(0), Some(80)));
    assert!(steps["worst"]["relative"].as_f64().expect("a number") <= 1e-8);
}

#[test]
fn a_rejected_step_ends_with_1_and_with_0_and_a_warning_where_that_is_accepted() {
    let folder = Folder::new("steps-rejected");
    // only what is rounding is no more than nothing
    let strict = ["--solver", "pgs", "--certify-tolerance", "0"];
    let refused = simulate(&folder, &strict);
    assert!(refused.code == 1 && !refused.output.contains("rejects: 0 of"), "{}", refused.output);
    let let_pass = simulate(&folder, &[&strict[..], &["--accept-rejected"]].concat());
    assert!(let_pass.code == 0 && let_pass.message.contains("warning"), "{}", let_pass.message);
    assert_eq!(let_pass.output, refused.output);
    let wrong = simulate(&folder, &["--certify-tolerance=-1"]);
    assert!(wrong.code == 2 && wrong.message.contains("--certify-tolerance"), "{}", wrong.message);
}

#[test]
fn a_larger_tolerance_is_asked_of_the_solver_too_and_a_smaller_one_is_not() {
    let folder = Folder::new("steps-rougher");
    let worst = |tolerance: &str| {
        let run = simulate(&folder, &["--solver", "pgs", "--certify-tolerance", tolerance, "--accept-rejected", "--format", "json"]);
        let steps = run.json()["steps"].clone();
        (steps["rejected"].as_u64(), steps["worst"]["relative"].as_f64().expect("a number"))
    };
    let (rough, usual, strict) = (worst("1e-3"), worst("1e-8"), worst("1e-13"));
    assert!(rough.0 == Some(0) && rough.1 > usual.1 && usual.1 == strict.1, "{rough:?} {usual:?} {strict:?}");
}

#[test]
fn declared_sweeps_are_certified_and_counted_as_unconverged() {
    let folder = Folder::new("steps-declared");
    for options in [["--scheme", "xpbd"], ["--solver", "sequential-impulses"]] {
        let run = simulate(&folder, &options);
        assert_eq!((run.code, run.message.as_str()), (0, ""));
        assert!(run.output.contains("steps unconverged by declaration: ") && run.output.contains(" of 80, worst"), "{}", run.output);
    }
}

#[test]
fn a_step_is_written_as_problem_and_answer_that_certify_takes() {
    let folder = Folder::new("steps-dumped");
    let (problem, rejected) = (folder.path("step.json"), folder.path("rejected"));
    let run = simulate(&folder, &["--dump-step", "60", &problem]);
    assert_eq!((run.code, run.message.as_str()), (0, ""));
    assert_eq!(moreau(&["certify", &problem, &folder.path("step-solution.json")]).code, 0);
    let run = simulate(&folder, &["--solver", "pgs", "--certify-tolerance", "0", "--dump-rejected", &rejected]);
    assert_eq!(run.code, 1);
    let count = std::fs::read_dir(&rejected).expect("made").count() as u64;
    let told = simulate(&folder, &["--solver", "pgs", "--certify-tolerance", "0", "--format", "json"]).json()["steps"]["rejected"].as_u64();
    assert_eq!(Some(count), told.map(|rejected| 2 * rejected));
    let again = simulate(&folder, &["--dump-rejected", &rejected]);
    assert!(again.code == 2 && again.message.contains("of an earlier run"), "{}", again.message);
    for (step, words) in [("0", "from 1 to 80"), ("81", "from 1 to 80"), ("x", "from 1 to 80"), ("1", "no contact problem")] {
        let run = simulate(&folder, &["--dump-step", step, &folder.path("other.json")]);
        assert!(run.code == 2 && run.message.contains(words), "{step}: {}", run.message);
    }
}

#[test]
fn a_trajectory_holds_the_residual_of_every_step() {
    let folder = Folder::new("steps-trajectory");
    let out = folder.path("motion.json");
    assert_eq!(simulate(&folder, &["--out", &out]).code, 0);
    let trajectory = moreau::trajectory::Trajectory::read(std::path::Path::new(&out)).expect("what was written can be read");
    let steps = trajectory.steps.expect("our own steps are certified");
    assert_eq!((steps.relative.len(), steps.accepted.len(), steps.limit), (80, 80, 1e-8));
    assert!(steps.accepted.iter().all(|accepted| *accepted));
    // nothing to solve in flight, something on the ground
    assert!(steps.relative[0].is_none() && steps.relative.iter().flatten().count() > 20);
}

#[test]
fn compare_names_the_schemes_whose_steps_are_rejected() {
    let folder = Folder::new("steps-compared");
    let scene = folder.path("tumbling.json");
    std::fs::write(&scene, TUMBLING).expect("written");
    let compare =
        |options: &[&str]| moreau(&[&["compare", &scene, "--schemes", "moreau-jean,anitescu", "--step", "0.005"], options].concat());
    assert_eq!(compare(&[]).code, 0);
    let strict = compare(&["--certify-tolerance", "0"]);
    assert!(strict.code == 1 && strict.output.contains("moreau-jean: steps the certificate rejects: "), "{}", strict.output);
    assert_eq!(compare(&["--certify-tolerance", "0", "--accept-rejected"]).code, 0);
}
