//! Keys of contacts: in problems, in answers, and as the way of a start into a changed list.

use super::{Folder, moreau};

/// Balls of 1 kg on the ground by their numbers, pressed down at these speeds \[m/s\], each with a key.
fn balls(name: &str, balls: &[(usize, f64)]) -> String {
    let list = |one: &dyn Fn(&(usize, f64)) -> String| balls.iter().map(one).collect::<Vec<_>>().join(",");
    let n = balls.len();
    let places = (0..n).map(|k| k.to_string()).collect::<Vec<_>>().join(",");
    format!(
        r#"{{"schema": "contact-problem/1", "name": "{name}", "dimension": 1, "law": "frictionless", "friction": [{}],
          "free_velocity": [{}], "keys": [{}],
          "delassus": {{"shape": [{n}, {n}], "triplets": {{"row": [{places}], "column": [{places}], "value": [{}]}}}}}}"#,
        list(&|_| "0".into()),
        list(&|(_, speed)| format!("-{speed}")),
        list(&|(ball, _)| format!(r#"{{"bodies": [{ball}, null], "features": [0, 0]}}"#)),
        list(&|_| "1".into()),
    )
}

#[test]
fn an_answer_carries_the_keys_of_its_problem_and_starts_another_list_by_them() {
    let folder = Folder::new("keys-start");
    let before = folder.file("before.json", &balls("before", &[(5, 1.0), (7, 2.0), (8, 3.0)]));
    let after = folder.file("after.json", &balls("after", &[(8, 3.0), (9, 4.0), (5, 1.0)]));
    let answer = folder.path("answer.json");
    assert_eq!(moreau(&["solve", &before, "--solver", "pgs", "--out", &answer]).code, 0);
    let stored: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&answer).expect("written")).expect("JSON");
    assert_eq!(stored["keys"][1], serde_json::json!({"bodies": [7, null], "features": [0, 0]}));
    assert_eq!(moreau(&["certify", &before, &answer]).code, 0);
    let said = |problem: &str, options: &[&str]| {
        let run = moreau(&[&["solve", problem, "--solver", "pgs", "--start", &answer], options].concat());
        assert_eq!(run.code, 0, "{}", run.message);
        run
    };
    let run = said(&after, &[]);
    assert!(run.message.contains("answer.json: start by keys: 2 of 3 contacts matched, 1 begin at zero"), "{}", run.message);
    let permuted = said(&folder.file("permuted.json", &balls("permuted", &[(8, 3.0), (5, 1.0), (7, 2.0)])), &[]).json();
    let cold = moreau(&["solve", &folder.path("permuted.json"), "--solver", "pgs"]).json();
    assert!(permuted["iterations"].is_null() && cold["iterations"].is_u64(), "each contact begins at its own impulse: {permuted}");
    // where standard error holds JSON there is nothing else on it
    let json = said(&after, &["--format", "json"]);
    assert!(serde_json::from_str::<serde_json::Value>(&json.message).is_ok(), "{}", json.message);
    // by position it is an answer to another problem
    let bare = folder.file("bare.json", &balls("after", &[(8, 3.0)]).replace("\"keys\"", "\"provenance\""));
    moreau(&["solve", &bare, "--start", &answer]).is_refused(&["answer.json", "“before”", "“after”"]);
    moreau(&["certify", &folder.file("same.json", &balls("", &[(8, 3.0), (9, 4.0), (5, 1.0)])), &answer]).is_refused(&[
        "answer.json",
        "keys[0]",
        "another contact",
        "--start",
    ]);
}

#[test]
fn a_start_by_position_of_another_size_and_keys_that_do_not_count_its_impulses_are_refused() {
    let folder = Folder::new("keys-size");
    let problem = folder.file("problem.json", &balls("", &[(5, 1.0), (7, 2.0)]));
    let start = |keys: &str| folder.file("start.json", &format!(r#"{{"schema": "solution/1", "impulse": [1, 2, 3]{keys}}}"#));
    moreau(&["solve", &problem, "--start", &start("")]).is_refused(&["start.json", "`impulse`: has size 3; give size 2"]);
    let key = |ball: usize| format!(r#"{{"bodies": [{ball}, null], "features": [0, 0]}}"#);
    let keys = |balls: &[usize]| format!(r#", "keys": [{}]"#, balls.iter().map(|ball| key(*ball)).collect::<Vec<_>>().join(","));
    moreau(&["solve", &problem, "--start", &start(&keys(&[5, 7]))]).is_refused(&["start.json", "has size 3; give size 2, for 2 keys"]);
    moreau(&["solve", &problem, "--start", &start(&keys(&[5, 7, 5]))]).is_refused(&["start.json", "keys[2]", "keys[0]"]);
}

#[test]
fn steps_that_are_dumped_carry_keys_by_which_one_starts_the_next() {
    let folder = Folder::new("keys-dumped");
    for step in ["60", "61"] {
        let file = folder.path(&format!("{step}.json"));
        assert_eq!(moreau(&["simulate", "--scene", "box-stack", "--step", "0.005", "--dump-step", step, &file]).code, 0);
    }
    let run = moreau(&["solve", &folder.path("61.json"), "--solver", "pgs", "--start", &folder.path("60-solution.json")]);
    assert_eq!(run.code, 0, "{}", run.message);
    let matched = run.message.split("start by keys: ").nth(1).and_then(|rest| rest.split(' ').next()).and_then(|count| count.parse().ok());
    assert!(matched.is_some_and(|matched: usize| matched > 4), "{}", run.message);
    assert_eq!(moreau(&["certify", &folder.path("60.json"), &folder.path("60-solution.json")]).code, 0);
}
