//! `moreau scoreboard` from outside.

use super::{Folder, moreau};

/// A list of engines, a README with the two markers, and a folder for the results.
fn scoreboard(folder: &Folder, engines: &str, more: &[&str]) -> super::Run {
    let engines = folder.file("engines.json", engines);
    let (results, readme) = (folder.path("results"), folder.path("README.md"));
    moreau(&[&["scoreboard", "--engines", &engines, "--folder", &results, "--readme", &readme], more].concat())
}

fn entry(name: &str, command: &[&str]) -> String {
    serde_json::json!({"name": name, "command": command, "options": {}, "install": "make the engine"}).to_string()
}

fn list(entries: &[String]) -> String {
    format!("{{\"engines\": [{}]}}", entries.join(","))
}

const README: &str = "before\n<!-- scoreboard -->\nold\n<!-- /scoreboard -->\nafter\n";

#[test]
fn an_engine_is_judged_stored_and_rendered_and_a_missing_one_is_not_run() {
    let folder = Folder::new("scoreboard");
    let readme = folder.file("README.md", README);
    let engines =
        list(&[entry("ours", &[env!("CARGO_BIN_EXE_moreau"), "engine", "--scheme", "anitescu"]), entry("gone", &["/no/such/engine"])]);
    let run = scoreboard(&folder, &engines, &["--format", "json"]);
    assert_eq!(run.code, 0, "{}", run.message);
    let json = run.json();
    assert_eq!(json["engines"][0]["report"]["engine"]["name"], "anitescu");
    let reason = json["engines"][1]["not_run"].as_str().expect("a reason");
    assert!(reason.contains("/no/such/engine") && reason.contains("make the engine"), "{reason}");
    assert!(json["engines"][1]["report"].is_null(), "never passed");
    let text = std::fs::read_to_string(&readme).expect("README");
    assert!(text.starts_with("before\n<!-- scoreboard -->\n| engine |") && text.ends_with("<!-- /scoreboard -->\nafter\n"), "{text}");
    assert!(text.contains("| ours (anitescu ") && text.contains("| gone | not run: /no/such/engine"), "{text}");

    // an engine that is no longer there keeps its stored result
    let engines = list(&[entry("ours", &["/no/such/engine"])]);
    let html = folder.path("page.html");
    let run = scoreboard(&folder, &engines, &["--format", "json", "--html", &html]);
    let page = std::fs::read_to_string(&html).expect("the page");
    assert!(page.contains(&format!("Written by moreau {} on 20", env!("CARGO_PKG_VERSION"))) && page.contains("id=\"engine:ours\""));
    assert!(run.message.contains("the stored result stays"), "{}", run.message);
    assert_eq!(run.json()["engines"][0]["report"]["engine"]["name"], "anitescu");
}

#[test]
fn a_cause_without_a_failing_check_is_named_and_an_unknown_check_refused() {
    let folder = Folder::new("scoreboard-causes");
    folder.file("README.md", README);
    std::fs::create_dir_all(folder.path("results/causes")).expect("a folder");
    let cause = |check: &str| {
        format!("[[cause]]\nengines = [\"gone\"]\nchecks = [\"{check}\"]\nerror = \"solver\"\ncause = \"it stops\"\nevidence = \"seen\"\n")
    };
    let engines = list(&[entry("gone", &["/no/such/engine"])]);
    folder.file("results/causes/gone.toml", &cause("ball/zeno"));
    let run = scoreboard(&folder, &engines, &[]);
    assert_eq!(run.code, 0);
    assert!(run.message.contains("gone: ball/zeno has a stored cause but does not fail"), "{}", run.message);
    folder.file("results/causes/gone.toml", &cause("ball/zemo"));
    scoreboard(&folder, &engines, &[]).is_refused(&["gone.toml", "ball/zemo", "moreau gate --list"]);
}

#[test]
fn a_readme_without_markers_and_a_list_without_the_engine_are_refused() {
    let folder = Folder::new("scoreboard-usage");
    folder.file("README.md", "nothing here\n");
    let engines = list(&[entry("gone", &["/no/such/engine"])]);
    scoreboard(&folder, &engines, &[]).is_refused(&["README.md", "<!-- scoreboard -->"]);
    scoreboard(&folder, &engines, &["--only", "mujoco"]).is_refused(&["--only", "gone"]);
}

/// A run in a folder that is no checkout.
fn elsewhere(folder: &Folder, arguments: &[&str]) -> super::Run {
    let output = super::command(arguments).current_dir(&folder.0).env("COLUMNS", "80").output().expect("the built command starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("output is UTF-8");
    super::Run { code: output.status.code().expect("not killed"), output: text(output.stdout), message: text(output.stderr) }
}

#[test]
fn the_stored_results_are_shown_outside_of_a_checkout() {
    let folder = Folder::new("scoreboard-elsewhere");
    let run = elsewhere(&folder, &["scoreboard", "--stored"]);
    assert_eq!((run.code, run.message.as_str()), (0, ""));
    for words in ["mujoco-elliptic (", "siconos (", "bullet (", "not passed: ", "moreau gate --explain CHECK"] {
        assert!(run.output.contains(words), "{words} in {}", run.output);
    }
    assert!(run.output.lines().all(|line| line.chars().count() <= 80), "{}", run.output);
    let one = elsewhere(&folder, &["scoreboard", "--stored", "--only", "siconos-orthonormal", "--format", "json"]).json();
    assert_eq!(one["engines"].as_array().map(Vec::len), Some(1));
    let html = folder.path("board.html");
    assert_eq!(elsewhere(&folder, &["scoreboard", "--stored", "--html", &html]).code, 0);
    assert_eq!(folder.names(), ["board.html"], "nothing else is written");
    elsewhere(&folder, &["scoreboard", "--stored", "--only", "godot"]).is_refused(&["--only", "mujoco"]);
    elsewhere(&folder, &["scoreboard"]).is_refused(&["--engines", "checkout", "scoreboard --stored"]);
    assert_eq!(folder.names(), ["board.html"], "not even the folder of the results");
}
