//! `moreau systems`.

use super::{Folder, moreau};

#[test]
fn the_systems_are_told_in_text_and_json_and_written_into_a_readme() {
    let folder = Folder::new("systems");
    let readme = folder.file("README.md", "before\n<!-- systems -->\nold\n<!-- /systems -->\nafter\n");
    let run = moreau(&["systems", "--readme", &readme]);
    assert_eq!((run.code, run.message.as_str()), (0, ""));
    assert!(
        run.output.contains("Stewart–Trinkle   --scheme stewart-trinkle\n  level position, cone polyhedral, law Coulomb"),
        "{}",
        run.output
    );
    assert!(run.output.trim_end().ends_with(" 0 outside the tolerance"), "{}", run.output);
    let text = std::fs::read_to_string(&readme).expect("README");
    assert!(text.starts_with("before\n<!-- systems -->\n| system |") && text.ends_with("|\n<!-- /systems -->\nafter\n"), "{text}");

    let json = moreau(&["systems", "--format", "json"]).json();
    let anitescu = json["systems"].as_array().and_then(|all| all.iter().find(|system| system["name"] == "Anitescu")).expect("listed");
    assert_eq!((&anitescu["level"], &anitescu["law"]), (&"position".into(), &"associated".into()));
    let agreement = &anitescu["held_against"][0];
    let [difference, tolerance] = ["difference", "tolerance"].map(|field| agreement[field].as_f64().expect("a number"));
    assert!(difference <= tolerance && agreement["holds"] == true, "{agreement}");
}

#[test]
fn a_readme_without_the_markers_is_refused() {
    let folder = Folder::new("systems-markers");
    let readme = folder.file("README.md", "nothing\n");
    moreau(&["systems", "--readme", &readme]).is_refused(&["README.md", "--readme", "<!-- systems -->"]);
    assert_eq!(std::fs::read_to_string(&readme).expect("README"), "nothing\n");
}
