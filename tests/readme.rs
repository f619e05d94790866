//! The README's numbers are those of the registry and of the stored files.

use moreau::claims::{self, Verdict};
use std::path::Path;

const README: &str = include_str!("../README.md");

#[test]
fn the_readme_states_the_verdict_counts_of_the_registry() {
    let count = |verdict| claims::all().filter(|claim| claim.verdict == verdict).count();
    let expected = format!(
        "{} claims: {} true, {} conditional, {} false as stated, {} inconsistent, {} ambiguous; 0 contradicted",
        claims::all().count(),
        count(Verdict::True),
        count(Verdict::Conditional),
        count(Verdict::False),
        count(Verdict::Inconsistent),
        count(Verdict::Ambiguous)
    );
    assert!(README.lines().any(|line| line == expected), "README.md should say: {expected}");
}

#[test]
fn the_readme_states_the_number_of_stored_runs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("references");
    let engines = ["mujoco", "drake", "siconos", "bullet", "pinocchio", "dart", "rapier"];
    let files = engines.map(|engine| std::fs::read_dir(root.join(engine)).expect("the folder is packed").count());
    let expected = format!("({} stored runs, single steps and answers, one named test each)", files.iter().sum::<usize>());
    assert!(README.contains(&expected), "README.md should say: {expected}");
}

#[test]
fn every_claim_named_in_the_readme_exists() {
    let named = README.split('`').skip(1).step_by(2).filter(|word| word.starts_with('S') && word.contains('.'));
    for id in named {
        assert!(claims::find(id).is_some(), "README.md names `{id}`, which is not registered");
    }
}

/// The contents of the first block of the README that starts with this fence.
fn block(fence: &str) -> &'static str {
    let (_, rest) = README.split_once(fence).expect("the README has such a block");
    rest.split_once("\n```").expect("the block ends").0.trim()
}

#[test]
fn the_readme_s_commands_work_as_they_stand() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("readme-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("the target directory is writable");
    std::fs::write(folder.join("problem.json"), block("```json\n")).expect("a writable folder");
    let commands = block("```sh\nmoreau ");
    assert_eq!(commands.lines().count(), 4, "{commands}");
    for command in commands.lines() {
        let arguments = command.trim_start_matches("moreau ").split_whitespace();
        let run = std::process::Command::new(env!("CARGO_BIN_EXE_moreau")).args(arguments).current_dir(&folder).output();
        let run = run.expect("the built command starts");
        assert!(run.status.success(), "{command}: {}", String::from_utf8_lossy(&run.stderr));
    }
    let answer = std::fs::read_to_string(folder.join("answer.json")).expect("written by the second command");
    assert!(answer.contains("\"impulse\":[1.0,-0.5]") && folder.join("ball.svg").exists(), "{answer}");
    std::fs::remove_dir_all(&folder).expect("nobody else uses it");
}
