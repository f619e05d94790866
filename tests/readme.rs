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
    let files = ["mujoco", "drake"].map(|engine| std::fs::read_dir(root.join(engine)).expect("the folder is packed").count());
    let expected = format!("({} stored runs, one named test each)", files[0] + files[1]);
    assert!(README.contains(&expected), "README.md should say: {expected}");
}

#[test]
fn every_claim_named_in_the_readme_exists() {
    let named = README.split('`').skip(1).step_by(2).filter(|word| word.starts_with('S') && word.contains('.'));
    for id in named {
        assert!(claims::find(id).is_some(), "README.md names `{id}`, which is not registered");
    }
}
