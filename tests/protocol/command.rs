//! The built command with engines of its own: exit codes, output, and what an interrupt leaves behind.

use crate::cases::this_program;
use crate::processes::{File, assert_gone, runs};
use libtest_mimic::Trial;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

/// Every test.
pub fn all() -> Vec<Trial> {
    let tests: [(&str, fn()); 7] = [
        ("a_sound_adapter_exits_0_and_a_faulty_one_1", exit_codes),
        ("an_adapter_that_cannot_be_started_exits_3_and_a_wrong_usage_2", cannot_be_started),
        ("the_outcome_is_json_on_request", the_outcome_is_json_on_request),
        ("an_engine_that_keeps_silent_is_waited_for_once", waited_for_once),
        ("an_interrupt_ends_the_engine_and_exits_130", || interrupted("INT")),
        ("a_termination_ends_the_engine_and_exits_130", || interrupted("TERM")),
        ("a_gate_that_is_killed_leaves_no_engine_behind", || interrupted("KILL")),
    ];
    let trial = |(name, test): (&'static str, fn())| {
        Trial::test(name, move || {
            test();
            Ok(())
        })
    };
    tests.into_iter().map(trial).collect()
}

fn protocol_check(options: &[&str], engine: &[String]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_moreau"));
    command.arg("protocol-check").args(options).arg("--").args(engine).stdin(Stdio::null());
    command
}

fn outcome(options: &[&str], engine: &[String]) -> Output {
    protocol_check(options, engine).output().expect("the built command starts")
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).expect("UTF-8")
}

fn exit_codes() {
    let sound = outcome(&[], &this_program(&["--adapter", "sound"]));
    assert_eq!(sound.status.code(), Some(0), "{}", text(&sound.stdout));
    // all of its bodies are free: nothing can be asked of others
    assert!(text(&sound.stdout).starts_with("one body 0.1\n") && text(&sound.stdout).contains(" 0 problems, 1 skipped"));
    assert!(text(&sound.stdout).contains("skipped   simulate/unmoved"));
    let faulty = outcome(&[], &this_program(&["--adapter", "forces"]));
    assert_eq!(faulty.status.code(), Some(1));
    assert!(text(&faulty.stdout).contains("cure: the reported numbers are forces; multiply"));
}

fn cannot_be_started() {
    for engine in [vec!["/nowhere/engine".to_string()], this_program(&["--misbehave", "crash-at-start"])] {
        let missing = outcome(&[], &engine);
        assert_eq!((missing.status.code(), text(&missing.stdout)), (Some(3), ""));
        assert!(text(&missing.stderr).starts_with("error: the adapter could not be run: "), "{}", text(&missing.stderr));
    }
    assert_eq!(outcome(&[], &[]).status.code(), Some(2));
    let limit = outcome(&["--time-limit", "-1"], &["x".to_string()]);
    assert_eq!(limit.status.code(), Some(2), "{}", text(&limit.stderr));
}

fn the_outcome_is_json_on_request() {
    let output = outcome(&["--format", "json"], &this_program(&["--adapter", "clamps"]));
    let value: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(value["engine"]["name"], "one body");
    let probes = value["probes"].as_array().expect("a list");
    let wrong: Vec<_> = probes.iter().filter(|probe| probe["outcome"] == "problem").collect();
    assert_eq!(wrong.len(), 1);
    assert_eq!(wrong[0]["probe"], "project/conventions");
    assert!(wrong[0]["why"].is_string() && wrong[0]["cure"].is_string() && wrong[0]["demand"].is_string());
}

/// Nobody starts it again to hear the same silence.
fn waited_for_once() {
    for (command, code) in [(&["gate", "--quick", "--only", "ball/energy"][..], 3), (&["protocol-check"], 1)] {
        let file = File::new(command[0]);
        let engine = ["sh", "-c", "echo started >> \"$0\"; exec sleep 600", file.path()];
        let mut gate = Command::new(env!("CARGO_BIN_EXE_moreau"));
        gate.args(command).args(["--time-limit", "2", "--"]).args(engine).stdin(Stdio::null());
        let output = gate.output().expect("the built command starts");
        let said = format!("{}{}", text(&output.stdout), text(&output.stderr));
        assert!(output.status.code() == Some(code) && said.contains("no reply within 2s"), "{command:?}: {said}");
        assert_eq!(std::fs::read_to_string(file.path()).expect("it has been started").lines().count(), 1, "{command:?}: {said}");
    }
}

fn interrupted(signal: &str) {
    let file = File::new(signal);
    let engine = this_program(&["--misbehave", "hang-at-start", file.path()]);
    let mut gate = protocol_check(&[], &engine).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the built command starts");
    let process = started(&file, &mut gate);
    assert!(runs(process));
    let sent = Command::new("kill").args([&format!("-{signal}"), &gate.id().to_string()]).status().expect("kill runs");
    assert!(sent.success());
    // a gate that is killed has no code, and cannot end its engine itself
    let code = if signal == "KILL" { None } else { Some(130) };
    assert_eq!(gate.wait().expect("it ends").code(), code);
    assert_gone(process);
}

/// The number that the engine has written.
fn started(file: &File, gate: &mut Child) -> u32 {
    for _ in 0..600 {
        if let Some(number) = file.number() {
            return number;
        }
        assert_eq!(gate.try_wait().expect("ours"), None, "the command has ended before its engine started");
        std::thread::sleep(Duration::from_millis(50));
    }
    panic!("the engine has not started");
}
