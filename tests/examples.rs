//! Every example runs to its end, so that none can rot.

#[path = "../examples/adapter.rs"]
mod adapter;
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
fn the_adapter_answers_requests_and_gets_verdicts() {
    use moreau::gate::{Plan, Verdict, checks, runner, serve::serve};

    let chosen = checks::all().filter(|check| ["ball", "flight"].contains(&check.family())).collect();
    let plan = Plan { checks: chosen, sweep: vec![1.0 / 240.0], options: Default::default(), jobs: 1, repeats: 1, progress: &|| {} };
    let report = runner::run(&|| Box::new(adapter::MyEngine), &plan).expect("it describes itself");
    assert!(report.count(Verdict::Pass) >= 4 && !report.is_bad(), "{report:?}");

    let requests = b"{\"protocol\": \"moreau-engine/1\", \"id\": 1, \"request\": \"describe\"}\n";
    let mut replies = Vec::new();
    serve(&mut adapter::MyEngine, &requests[..], &mut replies, 1 << 20).expect("nothing to fail");
    assert!(String::from_utf8_lossy(&replies).contains("\"my-engine\""));
    let _main: fn() -> std::io::Result<()> = adapter::main; // which waits for requests on standard input
}

#[test]
fn every_example_in_rust_is_run_here() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let entries = std::fs::read_dir(folder).expect("there are examples").map(|entry| entry.expect("readable").path());
    let mut names: Vec<_> = entries.filter(|path| path.extension().is_some_and(|ending| ending == "rs")).collect();
    names.sort();
    let names: Vec<_> = names.iter().map(|path| path.file_stem().expect("a name").to_string_lossy().into_owned()).collect();
    assert_eq!(names, ["adapter", "gate_engine", "own_solver", "simulate", "solve_and_certify"]);
}
