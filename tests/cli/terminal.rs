//! What a reader at a terminal sees: lines of its width, colours, counts, the way to more.

use super::{Run, command, moreau};

/// A run in a terminal of so many columns.
fn within(columns: usize, arguments: &[&str]) -> Run {
    run(arguments, &[("COLUMNS", &columns.to_string())])
}

fn run(arguments: &[&str], variables: &[(&str, &str)]) -> Run {
    let mut command = command(arguments);
    command.envs(variables.iter().copied()).env_remove("NO_COLOR");
    variables.iter().for_each(|(name, value)| {
        command.env(name, value);
    });
    let output = command.output().expect("the built command starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("output is UTF-8");
    Run { code: output.status.code().expect("not killed"), output: text(output.stdout), message: text(output.stderr) }
}

/// Columns of a line: a mark over a letter takes none.
fn columns_of(line: &str) -> usize {
    line.chars().filter(|letter| !('\u{300}'..='\u{36f}').contains(letter)).count()
}

#[track_caller]
fn fits(run: &Run, columns: usize) {
    assert!(run.code < 2 && !run.output.is_empty(), "{}", run.message);
    // a path or a name is not broken
    let is_word = |line: &str| !line.trim().contains(' ');
    let wide: Vec<_> = run.output.lines().filter(|line| columns_of(line) > columns && !is_word(line)).collect();
    assert_eq!(wide, Vec::<&str>::new());
}

#[test]
fn lists_and_reports_fit_into_80_100_and_120_columns() {
    let engine = ["--", env!("CARGO_BIN_EXE_moreau"), "engine"];
    let gate = [&["gate", "--only", "flight/", "--steps", "1/60"], &engine[..]].concat();
    let listings: [&[&str]; 10] = [
        &["verify", "--list"],
        &["verify", "--section", "12"],
        &["verify", "--explain", "S4.copos-plus"],
        &["gate", "--list"],
        &["gate", "--explain", "ball/energy"],
        &gate,
        &["protocol-check", "--", env!("CARGO_BIN_EXE_moreau"), "engine"],
        &["simulate", "--list"],
        &["simulate", "--scene", "bouncing-ball", "--step", "0.01"],
        &["compare", "ball-drop", "--step", "0.05"],
    ];
    for columns in [80, 100, 120] {
        listings.iter().for_each(|arguments| fits(&within(columns, arguments), columns));
    }
    assert!(within(80, &["verify", "--list"]).output.lines().count() > within(120, &["verify", "--list"]).output.lines().count());
}

#[test]
fn tables_fit_into_a_narrow_terminal_and_are_a_line_per_row_elsewhere() {
    let folder = super::Folder::new("terminal-tables");
    let place = folder.path("problems");
    for name in ["single-slide", "painleve-leaves"] {
        assert_eq!(moreau(&["problems", "export", name, &place]).code, 0);
    }
    let problem = folder.path("problems/single-slide.json");
    let (answers, answer) = (folder.path("answers"), folder.path("answer.json"));
    let listings: [&[&str]; 9] = [
        &["problems", "list", "--to", "2"],
        &["problems", "show", "single-slide"],
        &["problems", "measure", &problem],
        &["bench", &place],
        &["bench", &problem, "--solver", "auto", "--solver", "lemke"],
        &["solve", &problem, "--out", &answer],
        &["certify", &problem, &answer, "--prove"],
        &["solve", &place, "--out", &answers],
        &["certify", &place, &answers],
    ];
    for columns in [60, 80] {
        listings.iter().for_each(|arguments| fits(&within(columns, arguments), columns));
    }
    fits(&within(60, &["verify", "--list"]), 60);
    let list = moreau(&["problems", "list", "--to", "2"]).output;
    assert!(list.lines().all(|line| !line.starts_with(' ')), "{list}");
}

#[test]
fn every_help_fits_into_80_columns() {
    let commands = moreau(&["--help"]).output;
    let names = commands.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let names = names.filter_map(|line| line.strip_prefix("  ").filter(|line| !line.starts_with(' ')));
    let names: Vec<_> = names.filter_map(|line| line.split_whitespace().next()).filter(|name| *name != "help").collect();
    assert!(names.len() > 15, "{names:?}");
    for name in names {
        fits(&within(80, &[name, "--help"]), 80);
    }
    fits(&within(80, &["--help"]), 80);
}

#[test]
fn a_pipe_gets_lines_of_120_columns_and_no_colours() {
    let piped = moreau(&["verify", "--list"]);
    fits(&piped, 120);
    assert_eq!(piped.output, within(120, &["verify", "--list"]).output);
    assert!(!piped.output.contains('\u{1b}'));
}

#[test]
fn verdicts_are_coloured_where_that_is_asked_for_and_not_where_it_is_refused() {
    let arguments = ["verify", "--section", "12"];
    let coloured = run(&arguments, &[("CLICOLOR_FORCE", "1")]);
    assert!(coloured.output.contains("\u{1b}[32mtrue") && coloured.output.contains("\u{1b}[33mconditional"), "{}", coloured.output);
    assert!(!run(&arguments, &[("NO_COLOR", "1")]).output.contains('\u{1b}'));
}

#[test]
fn every_list_says_how_to_learn_more() {
    for (arguments, way) in [
        (&["verify", "--list"][..], "moreau verify --explain ID"),
        (&["verify", "--section", "12"], "moreau verify --explain ID"),
        (&["gate", "--list"], "moreau gate --explain CHECK"),
        (&["scoreboard", "--stored"], "moreau gate --explain CHECK"),
        (&["simulate", "--list"], "moreau systems"),
    ] {
        let text = within(120, arguments).output.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(way), "{arguments:?}: {way}");
    }
}

#[test]
fn the_chapter_and_its_claims_are_named() {
    let run = moreau(&["verify", "--list", "--search", "zeno"]);
    for words in ["Contact mechanics, topic 3.0", "时步法与数值积分", "Time-stepping is robust against Zeno"] {
        assert!(run.output.contains(words), "{words} in {}", run.output);
    }
    let json = moreau(&["verify", "--list", "--format", "json", "--filter", "M.zeno"]).json();
    assert_eq!(json[0]["title"], "Time-stepping is robust against Zeno");
}

#[test]
fn the_version_tells_the_commit_of_a_checkout() {
    let version = moreau(&["--version"]).output;
    assert!(version.starts_with(&format!("moreau {}", env!("CARGO_PKG_VERSION"))) && version.lines().count() == 1, "{version}");
    let top = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    // a packed crate has the commit of its archive, and none is told outside of a repository
    if !top.join(".git").exists() {
        return;
    }
    let commit = version.trim_end().split_once(" (commit ").and_then(|(_, rest)| rest.strip_suffix(')')).expect("a commit");
    assert_eq!(commit.len(), 12, "{version}");
    let known = std::process::Command::new("git").args(["cat-file", "-e", commit]).current_dir(top).status();
    assert!(known.expect("git made the checkout").success(), "{commit} is a commit of this repository");
}
