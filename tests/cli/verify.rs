//! `moreau verify`.

use super::{command, moreau};
use moreau::claims;
use std::process::Stdio;

/// A claim whose check takes no time.
const CLAIM: &str = "S12.step";

#[test]
fn a_full_run_reports_every_claim_counts_them_last_and_repeats_itself() {
    let run = moreau(&["verify"]);
    assert_eq!((run.code, run.message.as_str()), (0, ""), "{}", run.output);
    for claim in claims::all() {
        let line = run.output.lines().find(|line| line.split_whitespace().next() == Some(claim.id));
        let line = line.unwrap_or_else(|| panic!("{} has no line", claim.id));
        assert!(line.contains(claim.verdict.words()) && line.contains(claim.evidence.word()), "{line}");
    }
    let count = |words: &str| claims::all().filter(|claim| claim.verdict.words() == words).count();
    let words = ["true", "conditional", "false as stated", "inconsistent", "ambiguous"];
    let counts = words.map(|words| format!("{} {words}", count(words))).join(", ");
    assert_eq!(run.output.lines().last(), Some(format!("{} claims: {counts}; 0 contradicted", claims::all().count()).as_str()));
    assert_eq!(run.output, moreau(&["verify"]).output);
    assert!(!run.output.contains('\u{1b}'), "no colours in a pipe");
}

#[test]
fn json_is_an_array_in_the_order_of_the_registry() {
    let outcomes = moreau(&["verify", "--format", "json"]).json();
    let outcomes = outcomes.as_array().expect("an array");
    let ids: Vec<_> = outcomes.iter().map(|outcome| outcome["id"].as_str().expect("a text")).collect();
    assert_eq!(ids, claims::all().map(|claim| claim.id).collect::<Vec<_>>());
    let (mut context, mut all) = (0, 0);
    for outcome in outcomes {
        for field in ["section", "statement", "verdict", "evidence", "correct_statement", "status"] {
            assert!(outcome[field].is_string(), "{}.{field}", outcome["id"]);
        }
        assert_eq!(outcome["status"], "supported");
        assert!(outcome["seconds"].is_number());
        let findings = outcome["findings"].as_array().expect("an array");
        assert!(!findings.is_empty());
        for finding in findings {
            assert!(finding["name"].is_string() && finding["unit"].is_string(), "{finding}");
            for number in ["measured", "expected", "tolerance"] {
                assert!(finding[number].is_number(), "{}: {finding}", outcome["id"]);
            }
            assert!(finding["role"] == "context" || finding["moved"] == true, "{}: no control moves {finding}", outcome["id"]);
            context += usize::from(finding["role"] == "context");
            all += 1;
        }
    }
    assert!(100 * context <= 15 * all, "{context} of {all} findings are context, more than 15 %");
}

#[test]
fn findings_say_what_they_decide_and_the_figures_count_them() {
    for outcome in moreau(&["verify", "--format", "json", "--section", "12"]).json().as_array().expect("an array") {
        let findings = outcome["findings"].as_array().expect("an array");
        let count = |role: &str| findings.iter().filter(|finding| finding["role"] == role).count();
        assert!(findings.iter().all(|finding| finding["stated"].is_string()), "{outcome}");
        assert_eq!(outcome["figures"]["deciding"], count("supports") + count("refutes"), "{}", outcome["id"]);
        assert_eq!(outcome["figures"]["context"], count("context"));
        assert!(outcome["figures"]["moved"].as_u64() > Some(0), "{}: no finding is moved by the control", outcome["id"]);
        assert!(outcome["verdict"] != "TRUE" || count("refutes") == 0, "{}", outcome["id"]);
    }
}

fn listed(filters: &[&str]) -> Vec<serde_json::Value> {
    let list = moreau(&[&["verify", "--list", "--format", "json"], filters].concat()).json();
    list.as_array().expect("an array").clone()
}

#[test]
fn claims_are_found_by_section_verdict_severity_and_kind() {
    let found = listed(&["--verdict", "false", "--severity", "statement", "--kind", "assertion", "--section", "4"]);
    let meets = |claim: &serde_json::Value| {
        claim["verdict"] == "FALSE AS STATED"
            && claim["severity"] == "wrong-statement"
            && claim["kind"] == "assertion"
            && claim["section"] == "S4"
    };
    assert_eq!(found, listed(&[]).into_iter().filter(meets).collect::<Vec<_>>());
    let sum = |option: &str, names: &[&str]| names.iter().map(|name| listed(&[option, name]).len()).sum::<usize>();
    assert_eq!(sum("--verdict", &["true", "conditional", "false", "inconsistent", "ambiguous"]), claims::all().count());
    moreau(&["verify", "--list", "--section", "44"]).is_refused(&["--section 44", "0 to 12"]);
    assert_eq!(listed(&["--section", "S4"]), listed(&["--section", "4"]));
    assert_eq!(moreau(&["verify", "--list", "--section", "four"]).code, 2);
    moreau(&["verify", "--list", "--verdict", "true", "--severity", "theorem"]).is_refused(&["no claim meets all of the filters"]);
    for usage in [&["verify", "--verdict", "right"][..], &["verify", "--explain", CLAIM, "--kind", "advice"]] {
        assert_eq!(moreau(usage).code, 2, "{usage:?}");
    }
}

#[test]
fn a_filter_takes_whole_parts_of_the_id() {
    let ids = |filter: &str| {
        let list = moreau(&["verify", "--list", "--format", "json", "--filter", filter]).json();
        list.as_array().expect("an array").iter().map(|claim| claim["id"].as_str().expect("a text").to_string()).collect::<Vec<_>>()
    };
    assert!(ids("S12").iter().all(|id| id.starts_with("S12.")));
    assert_eq!(ids(CLAIM), [CLAIM]);
    let run = moreau(&["verify", "--filter", CLAIM]);
    assert_eq!(run.code, 0);
    assert!(run.output.ends_with("1 claim: 1 true, 0 conditional, 0 false as stated, 0 inconsistent, 0 ambiguous; 0 contradicted\n"));
}

#[test]
fn unknown_groups_and_ids_are_answered_with_near_ones() {
    moreau(&["verify", "--filter", "S44"]).is_refused(&["--filter", "S44", "did you mean `S4`"]);
    moreau(&["verify", "--filter", "S1.ste"]).is_refused(&["S1.ste"]);
    moreau(&["verify", "--explain", "S12.stp"]).is_refused(&["S12.stp", "did you mean `S12.step`"]);
    moreau(&["verify", "--explain", "S4"]).is_refused(&["S4", "--filter S4"]);
    moreau(&["verify", "--explain", "zzzzzzzzzzzz"]).is_refused(&["--list"]);
}

#[test]
fn a_list_runs_nothing_and_names_every_claim() {
    let run = moreau(&["verify", "--list"]);
    assert_eq!(run.code, 0);
    assert!(claims::all().all(|claim| run.output.contains(claim.id)));
    let list = moreau(&["verify", "--list", "--format", "json"]).json();
    assert_eq!(list.as_array().map(Vec::len), Some(claims::all().count()));
    assert!(list[0]["statement"].is_string() && list[0].get("status").is_none());
}

#[test]
fn an_explanation_holds_argument_findings_correction_control_and_sources() {
    let claim = claims::find("S4.copos-plus").expect("registered");
    let run = moreau(&["verify", "--explain", claim.id]);
    assert_eq!(run.code, 0);
    let squeezed = run.output.split_whitespace().collect::<Vec<_>>().join(" ");
    for text in [claim.statement(), claim.argument(), claim.correct_statement(), claim.controls().remove(0), claim.sources[0].into()] {
        assert!(squeezed.contains(&text), "{text:?} is missing in {}", run.output);
    }
    for words in ["[supports]", "[refutes ]", "with this control the verdict is another one, as it must be: true"] {
        assert!(run.output.contains(words), "{words}");
    }
    let explanation = moreau(&["verify", "--explain", claim.id, "--format", "json"]).json();
    assert_eq!((&explanation["id"], &explanation["argument"]), (&claim.id.into(), &claim.argument().into()));
    assert!(explanation["controls"][0]["findings"].as_array().expect("an array").iter().any(|finding| finding["holds"] == false));
}

#[test]
fn a_reader_that_stops_early_changes_neither_the_verdict_nor_the_peace() {
    for arguments in [&["verify", "--list"][..], &["verify", "--filter", CLAIM], &["verify", "--help"]] {
        let mut child = command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the built command starts");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("it ends");
        assert_eq!((output.status.code(), String::from_utf8_lossy(&output.stderr).as_ref()), (Some(0), ""), "{arguments:?}");
    }
}

#[test]
fn claims_are_found_by_words_and_ids_in_any_case() {
    let list = |arguments: &[&str]| moreau(&[&["verify", "--list"], arguments].concat());
    let found = list(&["--search", "Zeno"]);
    assert_eq!(found.code, 0, "{}", found.message);
    assert!(found.output.contains("Zeno") && found.output.lines().count() < claims::all().count() / 4, "{}", found.output);
    assert_eq!(found.output, list(&["--search", "zeno"]).output);
    let both = list(&["--search", "zeno step"]);
    assert!(both.code == 0 && both.output.lines().count() < found.output.lines().count(), "{}", both.output);
    list(&["--search", " "]).is_refused(&["--search", "has no word"]);
    list(&["--search", "complementaritty"]).is_refused(&["--search complementaritty", "did you mean `complementarity`"]);
    assert_eq!(list(&["--filter", "s4"]).output, list(&["--filter", "S4"]).output);
    assert_eq!(moreau(&["verify", "--explain", "s12.STEP"]).output, moreau(&["verify", "--explain", "S12.step"]).output);
}
