//! Files and folders that are not there, of the other kind, or named as what they do not hold: told with the path and a cure, before
//! anything is computed.

use super::{Folder, PROBLEM, moreau};

/// One line that names the path and a cure, without the number that the system gives it.
#[track_caller]
fn is_told(arguments: &[&str], path: &str, code: i32) -> String {
    let run = moreau(arguments);
    assert_eq!((run.code, run.output.as_str()), (code, ""), "{arguments:?}: {}", run.message);
    assert_eq!(run.message.trim_end().lines().count(), 1, "{arguments:?}: {}", run.message);
    assert!(run.message.contains(path) && run.message.contains("; "), "{arguments:?}: {}", run.message);
    assert!(!run.message.contains("os error"), "{arguments:?}: {}", run.message);
    run.message
}

#[test]
fn what_is_to_be_read_and_is_not_there_or_a_folder_is_told_with_a_cure() {
    let folder = Folder::new("paths-read");
    let (problem, place) = (folder.file("p.json", PROBLEM), folder.path("dir"));
    std::fs::create_dir_all(&place).expect("a writable folder");
    let answer = folder.path("a.json");
    assert_eq!(moreau(&["solve", &problem, "--out", &answer]).code, 0);
    let (none, within) = (folder.path("none.json"), folder.path("p.json/in.json"));
    for (path, words) in [(&none, "there is no such file; look at"), (&within, "is a file and no folder"), (&place, "a folder")] {
        let cases: [&[&str]; 15] = [
            &["solve", path],
            &["solve", &problem, "--start", path],
            &["certify", path, &answer],
            &["certify", &problem, path],
            &["bench", path],
            &["convert", path],
            &["convert", &problem, "--solution", path, "--out", &folder.path("x.hdf5")],
            &["simulate", "--scene", path],
            &["compare", path],
            &["gate", "--trajectory", path],
            &["gate", "--baseline", path, "--", "none"],
            &["scoreboard", "--engines", path],
            &["problems", "measure", path],
            &["new", "solution", path],
            &["problems", "list", "--readme", path],
        ];
        for arguments in cases {
            let said = is_told(arguments, path, 2);
            let is_folder_of_problems = path == &place && ["solve", "bench"].contains(&arguments[0]) && arguments[1] == path;
            assert!(is_folder_of_problems || said.contains(words) || said.contains("as a whole") || said.contains("FCLIB"), "{said}");
        }
    }
    // one of several is a line of the table, with the same words
    let run = moreau(&["bench", &problem, &none, "--solves", "1"]);
    assert!(run.code == 2 && run.output.contains("cannot be read: there is no such file; look at"), "{}", run.output);
}

#[test]
fn what_is_to_be_written_where_nothing_can_be_is_told_before_anything_is_computed() {
    let folder = Folder::new("paths-written");
    let (problem, place) = (folder.file("p.json", PROBLEM), folder.path("dir"));
    std::fs::create_dir_all(&place).expect("a writable folder");
    let scene = ["simulate", "--scene", "bouncing-ball", "--step", "0.01"];
    let ends = |end: &str| [folder.path(&format!("none/x.{end}")), folder.path(&format!("p.json/x.{end}")), place.clone()];
    for [json, svg, html, toml, xml] in {
        let [json, svg, html, toml, xml] = ["json", "svg", "html", "toml", "xml"].map(ends);
        (0..3).map(move |k| [&json, &svg, &html, &toml, &xml].map(|paths| paths[k].clone()))
    } {
        let cases: [(&[&str], &str); 11] = [
            (&["solve", &problem, "--out", &json], &json),
            (&[&scene[..], &["--out", &json]].concat(), &json),
            (&[&scene[..], &["--plot", &svg]].concat(), &svg),
            (&[&scene[..], &["--html", &html]].concat(), &html),
            (&["compare", "bouncing-ball", "--plot", &svg], &svg),
            (&["gate", "--out", &json, "--", "none"], &json),
            (&["gate", "--html", &html, "--", "none"], &html),
            (&["gate", "--junit", &xml, "--", "none"], &xml),
            (&["gate", "--save-baseline", &toml, "--", "none"], &toml),
            (&["verify", "--filter", "S4", "--export", &json], &json),
            (&["scoreboard", "--stored", "--html", &html], &html),
        ];
        for (arguments, path) in cases {
            if arguments[0] == "solve" && path == place {
                continue; // of one problem a folder is told below
            }
            is_told(arguments, path, 2);
        }
    }
    // a file in the place of a folder
    for arguments in [
        &["man", &problem][..],
        &["schema", "--write", &problem],
        &["gate", "--write-scenes", &problem],
        &["bench", &problem, "--answers", &problem],
        &["problems", "export", "single-slide", &problem],
        &[&scene[..], &["--dump-rejected", &problem]].concat(),
    ] {
        let said = is_told(arguments, &problem, 2);
        assert!(said.contains("which is a file; name a folder"), "{said}");
    }
    assert_eq!(folder.names(), ["dir", "p.json"]);
}

#[test]
fn results_are_not_written_into_files_that_are_named_as_another_kind() {
    let folder = Folder::new("paths-kinds");
    let problem = folder.file("p.json", PROBLEM);
    let scene = ["simulate", "--scene", "bouncing-ball", "--step", "0.01"];
    let [png, csv, html, json, svg] = ["x.png", "x.CSV", "x.html", "x.json", "x.svg"].map(|name| folder.path(name));
    let cases: [(&[&str], &str, &str); 15] = [
        (&[&scene[..], &["--html", &png]].concat(), "--html", ".html"),
        (&[&scene[..], &["--html", &json]].concat(), "--html", ".html"),
        (&[&scene[..], &["--out", &csv]].concat(), "--out", ".json"),
        (&[&scene[..], &["--plot", &png]].concat(), "--plot", ".svg"),
        (&[&scene[..], &["--dump-step", "40", &html]].concat(), "--dump-step", ".json"),
        (&["compare", "bouncing-ball", "--plot", &html], "--plot", ".svg"),
        (&["solve", &problem, "--out", &csv], "--out", ".json"),
        (&["convert", &problem, "--out", &csv], "--out", ".json"),
        (&["gate", "--html", &svg, "--", "none"], "--html", ".html"),
        (&["gate", "--junit", &json, "--", "none"], "--junit", ".xml"),
        (&["gate", "--out", &html, "--", "none"], "--out", ".json"),
        (&["gate", "--save-baseline", &json, "--", "none"], "--save-baseline", ".toml"),
        (&["verify", "--filter", "S4", "--export", &html], "--export", ".json"),
        (&["scoreboard", "--stored", "--html", &png], "--html", ".html"),
        (&["new", "engine", "--language", "python", "--out", &json], "--out", ".py"),
    ];
    for (arguments, option, end) in cases {
        let file = arguments.iter().find(|argument| argument.contains("/x.")).expect("the file");
        let said = is_told(arguments, file, 2);
        assert!(said.contains(&format!("`{option}`")) && said.contains("end ") && said.contains(end), "{said}");
    }
    assert_eq!(folder.names(), ["p.json"]);
    // a name that says nothing is taken
    assert_eq!(moreau(&["solve", &problem, "--out", &folder.path("answer")]).code, 0);
}

#[test]
fn an_engine_that_cannot_be_started_is_named_with_a_cure() {
    let folder = Folder::new("paths-engines");
    let text = folder.file("engine.py", "print()");
    for command in ["gate", "protocol-check"] {
        for (program, cure) in [
            (folder.path("none"), "look at its path"),
            ("no-such-engine".into(), "give its path"),
            (folder.path(""), "name a program in it"),
            (text.clone(), "as `python3 "),
        ] {
            let said = is_told(&[command, "--", &program], &program, 3);
            assert!(said.contains(cure) && said.contains("cannot be started"), "{said}");
        }
    }
}
