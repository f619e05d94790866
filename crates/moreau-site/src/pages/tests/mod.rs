//! The written pages: every link leads somewhere, what comes from claims, engines and files is escaped, and no fixed text is in the other
//! language.

mod reading;

use super::axes::{Evidence, Kind, Role, Severity, Verdict};
use super::data::*;
use super::file::File;
use super::without_runs;
use crate::words::{Language, Words};
use moreau_gate::cause::{Cause, Component};
use moreau_gate::scoreboard::Standing;
use moreau_gate::trend::Origin;
use moreau_replicas::systems::{AgreementReport, Cone, ConstraintLevel, ContactLaw, SystemReport};
use std::collections::{BTreeMap, BTreeSet};

/// What the reports of these tests borrow.
struct Parts {
    systems: moreau_replicas::systems::Report,
    standings: Vec<Standing>,
    causes: Vec<Cause>,
    defects: Vec<DefectEntry>,
}

impl Parts {
    fn new(text: &str) -> Self {
        Parts {
            systems: moreau_replicas::systems::Report { systems: vec![system(text)] },
            standings: vec![standing(text)],
            causes: vec![cause(text)],
            defects: vec![defect(text, true), defect(text, false)],
        }
    }
}

/// A report in which every text is made of this one.
fn report<'a>(text: &str, parts: &'a Parts) -> Report<'a> {
    let sections = vec![section("S4"), section("R")];
    let mut claims: Vec<ClaimEntry> = Vec::new();
    for (k, verdict) in
        [Verdict::True, Verdict::Conditional, Verdict::False, Verdict::Inconsistent, Verdict::Ambiguous].into_iter().enumerate()
    {
        claims.push(claim(&format!("S4.{k}"), "S4", verdict, text));
        claims.push(claim(&format!("R{k}"), "R", verdict, text));
    }
    claims[1].repeats = Some("S4.0".into());
    claims[2].alarm = Some(text.into());
    Report {
        version: "0".into(),
        day: "2026".into(),
        chapter: text.into(),
        sections,
        claims,
        figures: FigureCounts { deciding: 3, moved: 2, controls: 1 },
        systems: &parts.systems,
        standings: &parts.standings,
        causes: &parts.causes,
        defects: &parts.defects,
        problems: vec![problem(text)],
        given: given(text),
    }
}

fn given(text: &str) -> Given {
    let step = |time_step, speed| CreepStep { time_step, speed, allowed: 0.001 };
    let trend = |origin| CreepTrend { order: 1.0, origin };
    let creep = [None, Some(Origin::Model), Some(Origin::Discretisation), Some(Origin::Irregular)].map(|origin| Creep {
        engine: text.into(),
        program: text.into(),
        steps: vec![step(0.01, 0.02), step(0.001, -0.01)],
        trend: origin.map(trend),
    });
    let work = Work { laws: text.into(), problems: 2, profiles: vec![(text.into(), vec![[1.0, 0.5], [10.0, 1.0]])] };
    Given { creep: creep.into(), work: vec![work] }
}

fn section(group: &str) -> Section {
    Section { group: group.into(), title: Words { en: "Title", zh: "标题" } }
}

fn claim(id: &str, group: &str, verdict: Verdict, text: &str) -> ClaimEntry {
    let voices = [Voice::Passage(text.into()), Voice::Reading(text.into()), Voice::Opinion(text.into())];
    ClaimEntry {
        id: id.into(),
        group: group.into(),
        title: text.into(),
        statement: text.into(),
        plain: [text.into(), text.into()],
        verdict,
        kind: Kind::Assertion,
        severity: verdict.needs_correction().then_some(Severity::BrokenTheorem),
        evidence: Evidence::Exact,
        repeats: None,
        alarm: None,
        deciding: Some(finding(text, None)),
        findings: voices.into_iter().map(|voice| finding(text, Some(voice))).collect(),
        argument: text.into(),
        correct: text.into(),
        controls: vec![
            ControlEntry { subject: text.into(), verdict: Some(Verdict::True), findings: vec![finding(text, None)] },
            ControlEntry { subject: text.into(), verdict: None, findings: Vec::new() },
        ],
        places: vec![PlaceEntry { section: "§4".into(), heading: text.into(), paragraph: 1, line: 2, percent: 3, words: text.into() }],
        absent: Some(text.into()),
        sources: vec![text.into()],
        check: text.into(),
        erratum: Some(Erratum { says: text.into(), wrong: text.into(), reads: text.into() }),
    }
}

fn finding(text: &str, voice: Option<Voice>) -> FindingEntry {
    FindingEntry {
        role: Role::Refutes,
        name: text.into(),
        found: text.into(),
        expected: text.into(),
        stated: voice.is_some().then(|| text.into()),
        voice,
        violated: Some(text.into()),
        used: Some("0.5".into()),
    }
}

fn system(text: &str) -> SystemReport {
    let agreement = |holds, difference| AgreementReport {
        against: text.into(),
        quantity: text.into(),
        unit: "m".into(),
        difference,
        tolerance: 1.0,
        holds,
        used: difference,
    };
    SystemReport {
        name: text.into(),
        level: ConstraintLevel::Velocity,
        cone: Cone::SecondOrder,
        law: ContactLaw::Associated,
        algorithm: text.into(),
        restitution: text.into(),
        position_update: text.into(),
        schemes: vec![text.into()],
        held_against: vec![agreement(true, Some(0.5)), agreement(false, None)],
    }
}

/// An engine that was never run; [`a_stored_standing_is_shown`] looks at one that was.
fn standing(text: &str) -> Standing {
    let entry = serde_json::from_value(serde_json::json!({"name": text, "command": [text], "install": text})).expect("an entry");
    Standing { entry, report: None, not_run: Some(text.into()) }
}

fn cause(text: &str) -> Cause {
    let all = || vec![text.to_string()];
    Cause { engines: all(), checks: all(), error: Component::Model, cause: text.into(), evidence: text.into() }
}

fn defect(text: &str, caught: bool) -> DefectEntry {
    DefectEntry {
        name: text.into(),
        mistake: text.into(),
        kind: moreau_checks::planted::Kind::Solver,
        repeats: Some(text.into()),
        caught: caught.then(|| text.into()).into_iter().collect(),
        named: caught.then(|| text.into()).into_iter().collect(),
    }
}

fn problem(text: &str) -> ProblemEntry {
    ProblemEntry {
        name: text.into(),
        group: text.into(),
        about: text.into(),
        contacts: 1,
        dimension: 2,
        law: text.into(),
        friction: "0.5".into(),
        uniqueness: Uniqueness::Several,
        answers: 2,
        backward: "–".into(),
        forward: "0".into(),
        failures: 0,
        script: text.into(),
    }
}

fn written(text: &str) -> Vec<File> {
    without_runs(&report(text, &Parts::new(text)), &|| ()).expect("every picture can be drawn")
}

fn pages(files: &[File]) -> impl Iterator<Item = &File> {
    files.iter().filter(|file| file.path.ends_with(".html"))
}

/// The values of an attribute in a page.
fn attribute<'a>(page: &'a str, name: &str) -> Vec<&'a str> {
    let mark = format!(" {name}=\"");
    page.split(&mark).skip(1).map(|rest| rest.split('"').next().expect("an attribute ends")).collect()
}

/// The path that a link leads to from a page, and its anchor.
fn target<'a>(page: &str, link: &'a str) -> (String, &'a str) {
    let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
    let mut at: Vec<&str> = page.split('/').collect();
    if !file.is_empty() {
        at.pop();
        for part in file.split('/') {
            if part == ".." { at.pop().map_or((), |_| ()) } else { at.push(part) }
        }
    }
    (at.join("/"), anchor)
}

/// Links of all pages that lead nowhere. An anchor `#name=value` is a choice of filters.
fn lost(files: &[File]) -> Vec<String> {
    let ids: BTreeMap<&str, BTreeSet<&str>> =
        files.iter().map(|file| (file.path.as_str(), attribute(&file.text, "id").into_iter().collect())).collect();
    let mut lost = Vec::new();
    for page in pages(files) {
        for link in ["href", "src"].iter().flat_map(|name| attribute(&page.text, name)) {
            let (file, anchor) = target(&page.path, link);
            let leads = ids.get(file.as_str()).is_some_and(|ids| anchor.is_empty() || anchor.contains('=') || ids.contains(anchor));
            // what the program adds: its document, and the runs of the explorer
            if !leads && file != "report.json" && !file.starts_with("explorer/") {
                lost.push(format!("{}: {link}", page.path));
            }
        }
    }
    lost
}

#[test]
fn every_link_and_every_anchor_leads_somewhere() {
    let mut files = written("a `b` text");
    assert_eq!(lost(&files), Vec::<String>::new());
    assert!(pages(&files).count() >= 24);
    let front = files.iter_mut().find(|file| file.path == "zh/index.html").expect("the Chinese front page");
    front.text =
        front.text.replace(" href=\"claims.html#verdict=true\"", " href=\"claim.html\"").replace("section-R.html", "section-Q.html");
    assert_eq!(lost(&files), ["zh/index.html: claim.html", "zh/index.html: section-Q.html"], "the test sees links that lead nowhere");
}

#[test]
fn an_id_stands_once_on_a_page() {
    for page in pages(&written("text")) {
        let ids = attribute(&page.text, "id");
        // the names of this report's only engine and its check are one text
        let twice: Vec<_> = ids.iter().filter(|id| ids.iter().filter(|other| other == id).count() > 1).collect();
        assert_eq!(twice, Vec::<&&str>::new(), "{}", page.path);
    }
}

#[test]
fn each_page_has_its_twin_and_says_its_language() {
    let files = written("text");
    for page in pages(&files) {
        let is_chinese = page.path.starts_with("zh/");
        let tag = if is_chinese { Language::Chinese } else { Language::English }.tag();
        assert!(page.text.contains(&format!("<html lang=\"{tag}\">")), "{}", page.path);
        let twin = page.path.strip_prefix("zh/").map_or_else(|| format!("zh/{}", page.path), String::from);
        assert!(files.iter().any(|file| file.path == twin), "{twin}");
    }
}

/// Markup that would run, close a tag or leave an attribute.
const HOSTILE: &str = "</p><script>alert(1)</script><img src=x onerror='alert(2)'>\" onclick=\"alert(3) & ' `</code><b>`";

#[test]
fn markup_in_every_text_stays_text() {
    for page in pages(&written(HOSTILE)) {
        for tag in ["<script>alert", "<img src=x", " onclick=\"", "</code><b>"] {
            assert!(!page.text.contains(tag), "{} has {tag}", page.path);
        }
        assert!(page.text.contains("&lt;script&gt;alert(1)") || !page.text.contains("alert(1)"), "{}", page.path);
    }
    let all: String = written(HOSTILE).into_iter().map(|file| file.text).collect();
    assert!(all.contains("&lt;script&gt;alert(1)"), "the test looks at nothing");
}

/// What a reader of a page sees or hears in the page's own language: no tags, nothing that is marked as of another language, no code.
fn heard(page: &str, other: &str) -> String {
    let mut text = String::new();
    let mut silent: Vec<String> = Vec::new();
    let (_, body) = page.split_once("<body>").expect("a body");
    for part in body.split('<').skip(1) {
        let (tag, rest) = part.split_once('>').expect("a tag ends");
        let name = tag.trim_start_matches('/').split([' ', '/']).next().expect("a name").to_string();
        let void = ["br", "img", "input", "link", "meta"].contains(&name.as_str());
        if tag.starts_with('/') {
            if silent.last() == Some(&name) {
                silent.pop();
            }
        } else if !void
            && (!silent.is_empty() && silent.last() == Some(&name) || tag.contains(&format!("lang=\"{other}\"")) || name == "code")
        {
            silent.push(name);
        }
        if silent.is_empty() {
            for name in ["alt", "aria-label", "title", "placeholder"] {
                text.extend(attribute(&format!(" {tag}"), name));
            }
            text.push_str(rest);
            text.push('\n');
        }
    }
    text
}

/// Names that are the same in every language.
const NAMES: [&str; 12] =
    ["Python", "moreau", "Coulomb", "Signorini", "JavaScript", "English", "report", "json", "defects", "cargo", "test", "free"];

/// English words that a Chinese page says in its own name.
fn english_words(page: &str) -> Vec<String> {
    let heard = heard(page, "en");
    let words = heard.split(|letter: char| !letter.is_ascii_alphabetic()).filter(|word| word.len() > 2);
    words.filter(|word| !NAMES.contains(word)).map(String::from).collect()
}

#[test]
fn a_chinese_page_says_nothing_in_english() {
    // every text of the report is of signs, so that what is left are the fixed texts
    // pictures and explorer have texts of their own, with names and formulas, under their own tests
    let own = ["zh/pictures.html", "zh/explorer.html"];
    for page in pages(&written("…")).filter(|page| page.path.starts_with("zh/") && !own.contains(&page.path.as_str())) {
        let checks: BTreeSet<&str> = moreau_gate::checks::all().flat_map(|check| check.name.split(['/', '-'])).collect();
        let found: Vec<_> = english_words(&page.text).into_iter().filter(|word| !checks.contains(word.as_str())).collect();
        assert_eq!(found, Vec::<String>::new(), "{}", page.path);
    }
    assert_eq!(
        english_words("<body><p>这里 some words</p><span lang=\"en\">not <b>this</b></span><i aria-label=\"that\"></i>"),
        ["some", "words", "that"]
    );
}

#[test]
fn an_english_page_says_nothing_in_chinese() {
    let chinese = |text: &str| text.chars().filter(|letter| ('\u{3000}'..'\u{a000}').contains(letter)).collect::<String>();
    for page in pages(&written("…")).filter(|page| !page.path.starts_with("zh/")) {
        assert_eq!(chinese(&heard(&page.text, "zh-Hans")), "", "{}", page.path);
    }
}

#[test]
fn a_contradicted_claim_is_told_on_the_front_page_and_at_the_claim() {
    let files = written("why it is so");
    let page = |path: &str| &files.iter().find(|file| file.path == path).expect("written").text;
    assert!(page("index.html").contains("1 claims are not supported") && page("section-S4.html").contains("NOT SUPPORTED"));
    assert!(page("zh/index.html").contains("1 条论断的结论与所得结果不符"));
    let parts = Parts::new("text");
    let mut sound = report("text", &parts);
    sound.claims.iter_mut().for_each(|claim| claim.alarm = None);
    let files = without_runs(&sound, &|| ()).expect("drawn");
    assert!(files.iter().any(|file| file.path == "index.html" && file.text.contains("No claim is contradicted")));
}

#[test]
fn a_page_needs_nothing_from_elsewhere() {
    for file in written("text") {
        for word in ["http://", "https://", "fetch(", "import ", "type=\"module\"", "url(", "@import", "XMLHttpRequest"] {
            // the namespaces of pictures and formulas are names, not addresses
            let names = ["http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink", "http://www.w3.org/1998/Math/MathML"];
            let text = names.iter().fold(file.text.clone(), |text, name| text.replace(name, ""));
            assert!(!text.contains(word), "{} has {word}", file.path);
        }
    }
}
