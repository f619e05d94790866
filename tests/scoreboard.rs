//! The stored scoreboard: docs/scoreboard.md shows what it renders, every check that is not passed has a cause, and the highlights
//! are true.

use moreau::gate::baseline::{Change, ChangeKind};
use moreau::gate::scoreboard::{Engines, Standing};
use moreau::gate::{Report, cause, checks};
use moreau::number::significant;
use moreau::report::gate::{page, scoreboard, scoreboard_page};
use std::path::{Path, PathBuf};

fn here(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// Every listed engine with what is stored of it.
fn standings() -> Vec<Standing> {
    let engines = Engines::read(&here("scripts/engines/engines.json")).expect("the list of engines").engines;
    let read = |name: &str| Standing::read(&Standing::file(&here("references/scoreboard"), name)).expect("run `moreau scoreboard`");
    engines.into_iter().map(|entry| Standing { entry: entry.clone(), ..read(&entry.name) }).collect()
}

fn causes() -> Vec<cause::Cause> {
    cause::read(&here("references/scoreboard/causes")).expect("readable causes")
}

/// The values of a quantity over the time steps, largest step first.
fn values(standings: &[Standing], engine: &str, check: &str, quantity: &str) -> Vec<f64> {
    let standing = standings.iter().find(|standing| standing.entry.name == engine).unwrap_or_else(|| panic!("no engine {engine}"));
    let report: &Report = standing.report.as_ref().unwrap_or_else(|| panic!("{engine} was not run"));
    let outcome = report.checks.iter().find(|outcome| outcome.check == check).unwrap_or_else(|| panic!("no check {check}"));
    let of_step = |step: &moreau::gate::StepOutcome| {
        let one = step.measurements.iter().find(|one| one.quantity == quantity);
        one.unwrap_or_else(|| panic!("{engine}: {check} has no {quantity} at {:?}", step.time_step)).value
    };
    outcome.steps.iter().map(of_step).collect()
}

#[test]
fn the_page_shows_what_is_stored() {
    let page = std::fs::read_to_string(here("docs/scoreboard.md")).expect("docs/scoreboard.md");
    let section = page.split_once(scoreboard::BEGIN).and_then(|(_, rest)| rest.split_once(scoreboard::END)).expect("both markers").0;
    let made = scoreboard::section(&standings(), &causes());
    assert_eq!(section.trim(), made.trim(), "run `moreau scoreboard --stored --readme docs/scoreboard.md`");
}

#[test]
fn every_result_has_every_check_and_no_engine_is_missing() {
    let names: Vec<&str> = checks::all().map(|check| check.name).collect();
    for standing in standings() {
        let report = standing.report.unwrap_or_else(|| panic!("{} was not run: {:?}", standing.entry.name, standing.not_run));
        let stored: Vec<&str> = report.checks.iter().map(|outcome| outcome.check.as_str()).collect();
        assert_eq!(stored, names, "{}", standing.entry.name);
    }
}

#[test]
fn every_check_that_is_not_passed_has_one_cause_and_no_other_has() {
    let misfits = cause::misfits(&causes(), &standings());
    assert!(misfits.is_empty(), "{}", misfits.join("\n"));
}

/// A day that no clock tells.
fn day() -> jiff::civil::Date {
    jiff::civil::date(2026, 2, 28)
}

/// What every page of results has, whatever it shows: it says when it was made and by what, needs no other file, and hides nothing from
/// fingers.
fn is_a_page(page: &str) {
    for words in ["name=\"viewport\"", "prefers-color-scheme:dark", "min-height:44px", "position:sticky", "2026-02-28", "role=\"region\""] {
        assert!(page.contains(words), "{words}");
    }
    assert!(page.contains(&format!("moreau {} on 2026-02-28", env!("CARGO_PKG_VERSION"))));
    for words in [" title=\"", "<script", "src=", "<link", "@import", "url("] {
        assert!(!page.contains(words), "{words}");
    }
    let ids: Vec<&str> = page.split(" id=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    let links: Vec<&str> = page.split(" href=\"#").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    assert!(!links.is_empty(), "a page without a link: the test looks at nothing");
    let known: std::collections::BTreeSet<&str> = ids.iter().copied().collect();
    assert_eq!(known.len(), ids.len(), "two places of one name");
    links.iter().for_each(|link| assert!(known.contains(link), "nothing is called {link}"));
}

#[test]
fn the_html_of_the_scoreboard_counts_first_and_leads_from_every_mark_to_its_number_and_cause() {
    let (standings, causes) = (standings(), causes());
    let page = scoreboard_page::html(&standings, &causes, day());
    is_a_page(&page);
    let at = |words: &str| page.find(words).unwrap_or_else(|| panic!("no {words}"));
    let order = ["<h2>The engines", "<h2>What it shows", "<h2>Every check", "<h2>Every number", "<h2>Why checks", "<h2>The checks"].map(at);
    assert!(order.is_sorted(), "{order:?}");
    for standing in &standings {
        let (name, report) = (&standing.entry.name, standing.report.as_ref().expect("every engine was run"));
        let fails = report.checks.iter().filter(|outcome| outcome.verdict.is_bad()).count();
        let (_, own) = page.split_once(&format!("<p id=\"engine:{name}\">")).expect("its numbers");
        let own = own.split("<p id=\"engine:").next().expect("up to the next engine");
        assert_eq!(own.matches("<details open>").count(), fails, "{name}: what is bad is open");
        assert_eq!(own.matches("<a href=\"#cause:").count(), fails, "{name}: and says why");
        if fails > 0 {
            let first = own.find("<details").expect("a check");
            assert_eq!(own.find("<details open>"), Some(first), "{name}: and stands first");
        }
    }
    assert!(page.contains("<code>refsafe</code>"), "code is shown as code");
}

#[test]
fn an_engine_that_was_not_run_says_so_and_no_name_becomes_markup() {
    let mut standings = standings();
    standings.truncate(1);
    standings[0].report = None;
    standings[0].entry.name = "<b>x</b>".into();
    standings[0].not_run = Some("`a<b>` is not there".into());
    let page = scoreboard_page::html(&standings, &[], day());
    is_a_page(&page);
    assert!(!page.contains("<b>x") && page.contains("&lt;b&gt;x") && page.contains("not run: <code>a&lt;b&gt;</code> is not there"));
}

#[test]
fn the_html_of_the_gate_says_first_what_is_bad_and_escapes_what_an_engine_says_of_itself() {
    let standing = standings().into_iter().find(|standing| standing.entry.name == "mujoco-pgs").expect("stored");
    let mut report = standing.report.expect("run");
    report.engine.version = "</title><i>".into();
    let change = |check: &str| Change { check: check.into(), kind: ChangeKind::Regression, what: "`worse` <i>".into() };
    let changes = [change("ball/zeno"), change("ball/forgotten")];
    let page = page::html(&report, Some(&changes), day()).expect("pictures");
    is_a_page(&page);
    assert!(!page.contains("<i></") && !page.contains("</title><i>") && page.contains("<code>worse</code> &lt;i&gt;"));
    let bad: Vec<_> = report.checks.iter().filter(|outcome| outcome.verdict.is_bad()).map(|outcome| &outcome.check).collect();
    assert!(!bad.is_empty(), "an engine without a mistake shows nothing here");
    assert!(
        page.contains("<li class=\"\"><b>0</b> errored</li>")
            && page.contains(&format!("<li class=\"fail\"><b>{}</b> fail</li>", bad.len()))
    );
    let (summary, every) = page.split_once("<h2>Every check</h2>").expect("a summary before the checks");
    for check in &bad {
        assert!(summary.contains(&format!("<a href=\"#{check}\"><span class=\"verdict ")), "{check} is named first");
    }
    let order: Vec<&str> = every.split("<details id=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    assert_eq!((order.len(), order[..bad.len()].to_vec()), (report.checks.len(), bad.iter().map(|name| name.as_str()).collect()));
    assert_eq!(every.matches(" open>").count(), bad.len());
    report.checks.retain(|outcome| !outcome.verdict.is_bad());
    let page = page::html(&report, None, day()).expect("pictures");
    assert!(page.contains("No check fails or errs.") && !page.contains("Against the baseline"));
}

const SLIDE: &str = "(v_t + μ v_n)/T, less the initial speed";

#[test]
fn rapiers_coulomb_friction_is_lost_along_its_tangents_since_0_35() {
    let standings = standings();
    let exact = 9.81 * (20f64.to_radians().sin() - 0.3 * 20f64.to_radians().cos());
    let excess = |engine: &str| values(&standings, engine, "incline/slide", SLIDE).into_iter().map(move |a| a / exact - 1.0);
    assert!(excess("rapier-0.36-coulomb").all(|part| (0.46..0.48).contains(&part)));
    assert!(excess("rapier-0.34-coulomb").chain(excess("rapier-0.36")).all(|part| part.abs() < 1e-3));
}

#[test]
fn mujocos_creep_is_inverse_to_impratio_and_the_same_at_every_step_that_refsafe_leaves_alone() {
    let standings = standings();
    let creep = |engine: &str| values(&standings, engine, "incline/stick", "creep speed")[1..].to_vec();
    for (engine, impratio) in [("mujoco-elliptic", 1.0), ("mujoco-elliptic-impratio10", 10.0), ("mujoco-elliptic-impratio100", 100.0)] {
        for speed in creep(engine) {
            let part = speed * impratio / creep("mujoco-elliptic")[0];
            assert!((part - 1.0).abs() < 1e-3, "{engine}: {part}");
        }
    }
}

#[test]
fn saps_creep_is_proportional_to_the_step_and_laggeds_and_tamsis_is_constant() {
    let standings = standings();
    let ratio = |engine: &str| {
        let creep = values(&standings, engine, "incline/stick", "creep speed");
        creep[0] / creep[2]
    };
    let steps = 1000.0 / 60.0;
    assert!((ratio("drake-sap") / steps - 1.0).abs() < 0.01, "{}", ratio("drake-sap"));
    assert!((ratio("drake-lagged") - 1.0).abs() < 1e-3 && (ratio("drake-tamsi") - 1.0).abs() < 1e-3);
}

#[test]
fn bullets_effective_restitution_falls_with_the_step_from_above_e_to_below_it() {
    let e = values(&standings(), "bullet", "ball/restitution", "e = 0.5 from 5 m, impact 1: v+/v-");
    assert!(e[0] > 0.55 && e[1] < e[0] && e[2] < e[1] && e[2] < 0.45, "{e:?}");
}

#[test]
fn sweeps_that_end_early_let_stacks_wander() {
    let standings = standings();
    let drift = |engine: &str| values(&standings, engine, "stack/ten", "largest horizontal displacement while standing");
    let worst = |engine: &str| drift(engine).into_iter().fold(0.0, f64::max);
    assert!(drift("dart-ode-nsgs")[0] > 0.1 && drift("bullet")[0] > 0.01 && drift("sapien")[0] > 5e-4);
    assert!(drift("rapier-0.34")[0] > 1e-3 && drift("rapier-0.36")[1] > 3e-4);
    for engine in ["mujoco", "mujoco-pgs", "dart-ode", "siconos"] {
        assert!(worst(engine) < 2e-6, "{engine}");
    }
}

#[test]
fn the_lost_restitution_of_rapier_0_35_beta_is_seen_by_the_sweep_and_missed_by_its_smallest_step() {
    let standings = standings();
    let first =
        |engine: &str, height: u32| values(&standings, engine, "ball/restitution", &format!("e = 0.5 from {height} m, impact 1: v+/v-"));
    let kept = |engine: &str, height: u32| first(engine, height).into_iter().map(|e| e > 0.45).collect::<Vec<_>>();
    assert_eq!(kept("rapier-0.35-beta-box-ground", 2), [false, false, true]);
    assert_eq!(kept("rapier-0.35-beta", 2), [false, false, false]);
    assert_eq!(kept("rapier-0.35-beta", 5), [true, false, false]);
    for engine in ["rapier-0.34", "rapier-0.36"] {
        assert!(kept(engine, 2).into_iter().chain(kept(engine, 5)).all(|kept| kept), "{engine}");
    }
}

#[test]
fn the_numbers_that_the_readme_tells_of_engines_are_the_stored_ones() {
    let (standings, readme) = (standings(), std::fs::read_to_string(here("README.md")).expect("README.md"));
    let creep = values(&standings, "mujoco-elliptic", "incline/stick", "creep speed");
    let slide = |engine: &str| values(&standings, engine, "incline/slide", SLIDE).into_iter().map(|a| format!("{a:.3} m/s²"));
    let told = creep[1..].iter().map(|speed| format!("{} m/s", significant(format!("{speed:.4e}").parse().expect("a number"))));
    for number in told.chain(slide("rapier-0.34-coulomb")).chain(slide("rapier-0.36-coulomb")) {
        assert!(readme.contains(&number), "README.md should say: {number}");
    }
}
