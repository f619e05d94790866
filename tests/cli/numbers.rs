//! What is no number, and numbers in files that are none, told in plain words.

use super::{Folder, PROBLEM, moreau};

/// Words of the program and not of its users.
const OWN: [&str; 13] = [
    "usize",
    "u64",
    "u32",
    "f64",
    "struct",
    "sequence",
    "expected",
    "digit",
    "literal",
    "non-zero",
    "target type",
    "use '--",
    "invalid type",
];

#[test]
fn options_with_a_number_say_which_they_take() {
    let folder = Folder::new("numbers");
    let problem = folder.file("p.json", PROBLEM);
    let scene = ["simulate", "--scene", "bouncing-ball"];
    let refused = |arguments: &[&str], words: &[&str]| {
        let run = moreau(arguments);
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{arguments:?}");
        for word in words {
            assert!(run.message.contains(word), "{word}: {}", run.message);
        }
        assert_eq!(OWN.iter().find(|word| run.message.contains(**word)), None, "{}", run.message);
    };
    let large = "9".repeat(30);
    for (value, cure) in [("-1", "give a whole number, at least 1"), ("x", "a whole number, at least 1"), (&large, "give a smaller number")]
    {
        refused(&["solve", &problem, "--iterations", value], &["--iterations", value, cure]);
        refused(&["solve", &problem, "--threads", value], &["--threads", value, cure]);
        refused(&["bench", &problem, "--solves", value], &["--solves", value, cure]);
        refused(&[&scene[..], &["--scheme", "pbd", "--sweeps", value]].concat(), &["--sweeps", value, cure]);
        refused(&["gate", "--jobs", value, "--", "none"], &["--jobs", value, cure]);
    }
    refused(&["solve", &problem, "--threads", "0"], &["`--threads`: is 0; give a whole number, at least 1"]);
    refused(&["problems", "list", "--from", "-1"], &["--from", "give a whole number, 0 or more"]);
    refused(&["verify", "--section", "-1"], &["--section", "0 to 12"]);
    refused(&[&scene[..], &["--dump-step", "-1", &folder.path("s.json")]].concat(), &["--dump-step", "`-1`", "from 1 to"]);
    refused(&[&scene[..], &["--theta", "x"]].concat(), &["--theta", "give a number, such as"]);
    refused(&[&scene[..], &["--solimp", "-1,x"]].concat(), &["--solimp", "give a number, such as"]);
    refused(&["solve", &problem, "--time-limit", "soon"], &["--time-limit", "give seconds, such as"]);
    refused(&["gate", "--require", "all", "--", "none"], &["--require", "give a number"]);
}

#[test]
fn a_value_of_a_file_that_is_none_is_told_in_words_of_json_with_its_place() {
    let folder = Folder::new("numbers-in-files");
    let matrix = r#"{"shape": [2, 2], "rows": [[1, 0], [0, 1]]}"#;
    let [mass, rows] = [format!(r#""mass": {matrix}, "jacobian": {matrix}"#), format!(r#""delassus": {matrix}"#)];
    let by_mass = PROBLEM.replace(&rows, &mass);
    assert_ne!(by_mass, PROBLEM);
    let last = |text: &str, row: &str| {
        let at = text.rfind("[0, 1]").expect("the last row");
        format!("{}{row}{}", &text[..at], &text[at + "[0, 1]".len()..])
    };
    let cases = [
        (PROBLEM.replace(": 2,", ": \"2\","), "field `dimension`: is the text \"2\"", "give a whole number, 0 or more"),
        (PROBLEM.replace(": 2,", ": 2.5,"), "field `dimension`: is 2.5", "give a whole number"),
        (PROBLEM.replace("[0.5]", "0.5"), "field `friction`: is 0.5", "give a list in square brackets"),
        (PROBLEM.replace("[0.5]", "[null]"), "field `friction[0]`: is null", "give a number"),
        (PROBLEM.replace("\"block\"", "7"), "field `name`: is 7", "give a text in quotation marks"),
        (PROBLEM.replace("[2, 2]", "[2]"), "field `delassus.shape`: has 1 entry", "give a list of 2 entries"),
        (PROBLEM.replace(&rows, &format!("{rows}, \"compliance\": 5")), "field `compliance`: is 5", "give an object in braces"),
        (PROBLEM.replace(&rows, &format!("{rows}, \"bodies\": [[0, -1]]")), "field `bodies[0][1]`: is -1", "a whole number, 0 or more"),
        (last(PROBLEM, "[0, \"x\"]"), "field `delassus.rows[1][1]`: is the text \"x\"", "give a number"),
        (last(&by_mass, "[0, [1]]"), "field `jacobian.rows[1][1]`: is a list", "give a number"),
        (last(&by_mass, "[0, 1e999]"), "field `jacobian.rows[1][1]`: number out of range", "use a finite number"),
        (last(&by_mass, "[0]"), "field `jacobian.rows[1]`: has 1 entry", "give 2 entries, as `shape` says"),
        (last(&by_mass, "5"), "field `jacobian.rows[1]`: is 5", "give a list in square brackets"),
    ];
    for (text, place, cure) in cases {
        let run = moreau(&["solve", &folder.file("p.json", &text)]);
        run.is_refused(&["p.json", place, cure]);
        assert_eq!(OWN.iter().find(|word| run.message.contains(**word)), None, "{}", run.message);
    }
    let scene = std::fs::read_to_string({
        let file = folder.path("scene.json");
        assert_eq!(moreau(&["new", "scene", "--out", &file]).code, 0);
        file
    });
    let wrong = scene.expect("written").replacen("\"gravity\": [", "\"gravity\": [\"x\", ", 1);
    let run = moreau(&["simulate", "--scene", &folder.file("wrong.json", &wrong)]);
    run.is_refused(&["wrong.json", "`gravity[0]`: is the text \"x\"", "give a number"]);
    // a stored trajectory has the same words
    let run = moreau(&["gate", "--trajectory", &folder.file("t.json", r#"{"schema": "trajectory/1", "scene": 5}"#)]);
    run.is_refused(&["t.json", "`scene`: is 5", "give an object in braces"]);
}
