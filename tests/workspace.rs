//! What the README's `cargo test` runs: every crate, every test program, every example in the documentation.

use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// `cargo metadata` of the workspace this package belongs to, asked at its root, where `cargo test` is run.
fn metadata() -> Value {
    let root = metadata_at(env!("CARGO_MANIFEST_DIR"))["workspace_root"].as_str().expect("a folder").to_string();
    metadata_at(&root)
}

fn metadata_at(folder: &str) -> Value {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
    let arguments = ["metadata", "--no-deps", "--offline", "--format-version", "1"];
    let run = Command::new(cargo).args(arguments).current_dir(folder).output().expect("cargo runs the tests and is there");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    serde_json::from_slice(&run.stdout).expect("JSON")
}

fn texts<'a>(value: &'a Value, key: &str) -> BTreeSet<&'a str> {
    value[key].as_array().expect("a list").iter().map(|text| text.as_str().expect("a text")).collect()
}

/// The programs that `cargo test` runs for a package, as `package: kind name`; those that it leaves out are the second list.
fn targets(package: &Value) -> (Vec<String>, Vec<String>) {
    let name = package["name"].as_str().expect("a name");
    let (mut run, mut left) = (Vec::new(), Vec::new());
    for target in package["targets"].as_array().expect("a list") {
        let kind = target["kind"][0].as_str().expect("a kind");
        let line = format!("{name}: {kind} {}", target["name"].as_str().expect("a name"));
        assert!(target.get("required-features").is_none(), "{line} is left out where its features are");
        if target["test"] == true {
            run.push(line.clone())
        } else {
            left.push(line.clone())
        }
        if kind == "lib" {
            let documentation = format!("{name}: documentation");
            if target["doctest"] == true { run.push(documentation) } else { left.push(documentation) }
        }
    }
    (run, left)
}

#[test]
fn every_crate_test_program_and_documentation_is_run_by_cargo_test() {
    let metadata = metadata();
    // Python loads moreau-python, and its tests are Python's; it is not packed either
    let tested = texts(&metadata, "workspace_default_members");
    let mut left: Vec<&str> = texts(&metadata, "workspace_members").difference(&tested).copied().collect();
    left.retain(|member| !member.contains("moreau-python"));
    assert_eq!(left, Vec::<&str>::new(), "`cargo test` would leave out a crate");
    let packages = metadata["packages"].as_array().expect("a list").iter().filter(|package| package["name"] != "moreau-python");
    let packages: Vec<_> = packages.collect();
    let names: BTreeSet<&str> = packages.iter().map(|package| package["name"].as_str().expect("a name")).collect();
    let expected = [
        "moreau",
        "moreau-checks",
        "moreau-contact",
        "moreau-dynamics",
        "moreau-exact",
        "moreau-forms",
        "moreau-gate",
        "moreau-replicas",
        "moreau-site",
    ];
    assert_eq!(names, BTreeSet::from(expected));
    let (run, left): (Vec<_>, Vec<_>) = packages.iter().map(|package| targets(package)).unzip();
    let (run, left) = (run.concat(), left.concat());
    println!("{}", run.join("\n"));
    // every file of tests/ is a program of its own, and all of them run
    let programs = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests")).expect("the folder is packed");
    for program in programs {
        let path = program.expect("readable").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        assert!(run.contains(&format!("moreau: test {name}")), "{} is not run", path.display());
    }
    assert!(expected.iter().all(|name| run.contains(&format!(
        "{name}: \
        documentation"
    )) && run.iter().any(|line| line.starts_with(&format!("{name}: lib")))));
    // the examples are run by tests/examples.rs, the benches measure times, and every build runs build.rs
    let elsewhere = ["example adapter", "example gate_engine", "example own_solver", "example simulate", "example solve_and_certify"];
    let elsewhere = elsewhere.into_iter().chain(["custom-build build-script-build"]).map(|target| format!("moreau: {target}"));
    let benches = ["moreau-contact: bench sweeps", "moreau-dynamics: bench certifying", "moreau-dynamics: bench simulating"];
    let elsewhere: Vec<String> = elsewhere.chain(benches.map(String::from)).collect();
    assert_eq!(left, elsewhere, "left out, with a reason");
}
