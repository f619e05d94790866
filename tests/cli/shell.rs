//! `moreau completions` and `moreau man`.

use super::{Folder, moreau};

#[test]
fn every_shell_gets_a_script_with_subcommands_and_options() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let run = moreau(&["completions", shell]);
        assert_eq!((run.code, run.message.as_str()), (0, ""), "{shell}");
        for word in ["protocol-check", "certify", "tolerance", "scoreboard"] {
            assert!(run.output.contains(word), "{shell}: {word}");
        }
    }
    assert_eq!(moreau(&["completions", "csh"]).code, 2);
}

#[test]
fn manual_pages_are_written_together_or_not_at_all() {
    let folder = Folder::new("man");
    let run = moreau(&["man", &folder.path("")]);
    assert_eq!((run.code, run.message.as_str()), (0, ""));
    let names = folder.names();
    assert!(["moreau.1", "moreau-gate.1", "moreau-verify.1"].iter().all(|page| names.contains(&page.to_string())), "{names:?}");
    assert!(run.output.starts_with(&format!("{} manual pages", names.len())), "{}", run.output);
    let page = std::fs::read_to_string(folder.path("moreau-gate.1")).expect("written");
    for word in [".TH moreau-gate 1", "baseline", "Examples:"] {
        assert!(page.contains(word), "{word} in {page}");
    }
    moreau(&["man", &folder.path("absent")]).is_refused(&["absent"]);
}
