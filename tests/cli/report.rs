//! `moreau report`: what it refuses before it computes anything. The written report is looked at by `scripts/check_report.py`.

use super::{Folder, moreau};

#[test]
fn a_folder_with_something_else_is_refused_and_left_as_it_is() {
    let folder = Folder::new("report-other");
    let thesis = folder.file("thesis.tex", "text");
    let out = std::path::Path::new(&thesis).parent().expect("a folder").to_string_lossy().into_owned();
    moreau(&["report", "--out", &out]).is_refused(&["--out", "thesis.tex", "name a new or an empty folder"]);
    assert_eq!(std::fs::read_to_string(&thesis).expect("still there"), "text");
    moreau(&["report", "--out", &thesis]).is_refused(&["--out", "no folder"]);
    moreau(&["report", "--out", &folder.path("none/report")]).is_refused(&["--out", "make that folder first"]);
}

#[test]
fn the_help_says_what_to_open_and_what_the_exit_code_means() {
    let run = moreau(&["report", "--help"]);
    assert_eq!(run.code, 0);
    for words in ["index.html", "report/zh/index.html", "whole or not at all", "Exit code 0", "without network"] {
        assert!(run.output.split_whitespace().collect::<Vec<_>>().join(" ").contains(words), "{words} in {}", run.output);
    }
}
