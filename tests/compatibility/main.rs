//! Files that earlier versions wrote are read: names in files are promises.

use moreau::gate::baseline::Baseline;
use moreau::gate::scoreboard::Standing;
use moreau::gate::{CheckOutcome, Verdict};
use moreau::scenes::Scene;
use moreau::trajectory::Trajectory;
use moreau::{ContactProblem, Law, Solution};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/compatibility/0.1").join(name)
}

#[test]
fn problems_and_solutions_of_0_1_are_read() {
    let problem = ContactProblem::read(&file("problem.json")).expect("contact-problem/1");
    assert_eq!((problem.law(), problem.contacts(), problem.friction()[0]), (Law::Coulomb, 1, 0.5));
    let solution = Solution::read(&file("solution.json"), &problem).expect("solution/1");
    assert_eq!(solution.impulse.as_slice(), [1.0, -0.5]);
    let residuals = moreau::certificate::residuals(&problem, &solution).expect("finite");
    assert!(residuals.is_solution(moreau::tolerance::cli::CERTIFY), "{residuals:?}");
}

#[test]
fn scenes_and_trajectories_of_0_1_are_read() {
    let scene = Scene::read(&file("scene.json")).expect("scene/1");
    let trajectory = Trajectory::read(&file("trajectory.json")).expect("trajectory/1");
    assert_eq!((scene.name.as_str(), trajectory.scene.name.as_str()), ("ball_bounce", "ball_bounce"));
    assert_eq!((trajectory.times.len(), trajectory.time_step), (5, 0.05));
}

#[test]
fn baselines_and_results_of_the_scoreboard_of_0_1_are_read() {
    let baseline = Baseline::read(&file("baseline.toml")).expect("gate-baseline/1");
    assert_eq!((baseline.engine.as_str(), baseline.sweep.len()), ("moreau-jean", 3));
    let standing = Standing::read(&file("scoreboard.json")).expect("a standing");
    let report = standing.report.expect("it was run");
    let checks: Vec<&CheckOutcome> = report.checks.iter().collect();
    assert_eq!((standing.entry.name.as_str(), checks.len(), checks[0].verdict), ("anitescu", 1, Verdict::Pass));
}

#[test]
fn every_file_of_0_1_is_read_by_a_test_above() {
    let stored: BTreeSet<String> = std::fs::read_dir(file(""))
        .expect("the folder is packed")
        .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
        .collect();
    let source = include_str!("main.rs");
    let unread: Vec<&String> = stored.iter().filter(|name| !source.contains(&format!("file(\"{name}\")"))).collect();
    assert!(!stored.is_empty() && unread.is_empty(), "{unread:?}");
}
