//! Every example runs to its end, so that none can rot.

#[path = "../examples/gate_engine.rs"]
mod gate_engine;
#[path = "../examples/own_solver.rs"]
mod own_solver;
#[path = "../examples/simulate.rs"]
mod simulate;
#[path = "../examples/solve_and_certify.rs"]
mod solve_and_certify;

#[test]
fn solve_and_certify_runs() {
    solve_and_certify::main().expect("certified");
}

#[test]
fn own_solver_runs() {
    own_solver::main().expect("certified");
}

#[test]
fn simulate_runs() {
    simulate::main().expect("drawn");
}

#[test]
fn gate_engine_runs() {
    gate_engine::main();
}

#[test]
fn every_example_in_rust_is_run_here() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let entries = std::fs::read_dir(folder).expect("there are examples").map(|entry| entry.expect("readable").path());
    let mut names: Vec<_> = entries.filter(|path| path.extension().is_some_and(|ending| ending == "rs")).collect();
    names.sort();
    let names: Vec<_> = names.iter().map(|path| path.file_stem().expect("a name").to_string_lossy().into_owned()).collect();
    assert_eq!(names, ["gate_engine", "own_solver", "simulate", "solve_and_certify"]);
}
