//! The README and the pages of `docs/`: their numbers are those of the registry and of the stored files, their commands work as they stand,
//! their links lead somewhere.

use moreau::claims::{self, ClaimVerdict, Severity};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

const README: &str = include_str!("../README.md");
const RESULTS: &str = include_str!("../docs/results.md");

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The Markdown files of the top crate: those beside its manifest, those of the stored runs and all of `docs/`.
fn pages() -> Vec<PathBuf> {
    let named = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "references/README.md"];
    let mut pages = named.map(|page| root().join(page)).to_vec();
    markdown(&root().join("docs"), &mut pages);
    pages
}

fn markdown(folder: &Path, pages: &mut Vec<PathBuf>) {
    let mut entries: Vec<_> = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("readable").path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            markdown(&path, pages);
        } else if path.extension().is_some_and(|ending| ending == "md") {
            pages.push(path);
        }
    }
}

/// The lines outside blocks of code.
fn prose(text: &str) -> impl Iterator<Item = &str> {
    let mut code = false;
    text.lines().filter(move |line| {
        let fence = line.starts_with("```");
        code ^= fence;
        !code && !fence
    })
}

/// The blocks of code, each with its language.
fn blocks(text: &str) -> Vec<(&str, &str)> {
    let parts = text.split("\n```").collect::<Vec<_>>();
    parts.iter().skip(1).step_by(2).map(|part| part.split_once('\n').expect("a block has a first line")).collect()
}

#[test]
fn the_readme_has_at_most_8_kib() {
    assert!(README.len() <= 8192, "{} bytes", README.len());
}

#[test]
fn the_readme_states_the_verdict_counts_of_the_registry() {
    let count = |verdict| claims::all().filter(|claim| claim.verdict == verdict).count();
    let expected = format!(
        "{} claims: {} true, {} conditional, {} false as stated, {} inconsistent, {} ambiguous; 0 contradicted",
        claims::all().count(),
        count(ClaimVerdict::True),
        count(ClaimVerdict::Conditional),
        count(ClaimVerdict::False),
        count(ClaimVerdict::Inconsistent),
        count(ClaimVerdict::Ambiguous)
    );
    assert!(README.lines().any(|line| line == expected), "README.md should say: {expected}");
    let total = format!("verifies the {} claims", claims::all().count());
    assert!(README.contains(&total), "README.md should say: {total}");
}

#[test]
fn the_results_state_the_number_of_stored_runs() {
    let engines = ["mujoco", "drake", "siconos", "bullet", "pinocchio", "dart", "rapier"];
    let files = engines.map(|engine| std::fs::read_dir(root().join("references").join(engine)).expect("the folder is packed").count());
    let expected = format!("({} stored runs, single steps and answers, one named test each)", files.iter().sum::<usize>());
    assert!(RESULTS.contains(&expected), "docs/results.md should say: {expected}");
}

#[test]
fn every_claim_named_in_the_readme_exists() {
    for (page, text) in [("README.md", README), ("docs/results.md", RESULTS)] {
        let named: Vec<_> = text.split('`').skip(1).step_by(2).filter(|word| word.starts_with('S') && word.contains('.')).collect();
        assert!(!named.is_empty(), "{page} names no claim: the test looks at nothing");
        for id in named {
            assert!(claims::find(id).is_some(), "{page} names `{id}`, which is not registered");
        }
    }
}

/// The ids that a page names between backticks.
fn named(page: &str) -> Vec<&str> {
    let id = |word: &&str| word.starts_with(|letter: char| letter.is_ascii_uppercase()) && word.contains('.') && !word.contains(['/', ' ']);
    page.split('`').skip(1).step_by(2).filter(id).collect()
}

/// Ids on a page of errata that are no claims, and the statements that do not hold and are missing there.
fn wrong_errata(page: &str) -> (Vec<&str>, Vec<&'static str>) {
    let named = named(page);
    let must = claims::all().filter(|claim| {
        let grave = matches!(claim.severity, Some(Severity::BrokenTheorem | Severity::WrongStatement));
        grave && matches!(claim.verdict, ClaimVerdict::False | ClaimVerdict::Inconsistent)
    });
    let missing = must.map(|claim| claim.id).filter(|id| !named.contains(id)).collect();
    (named.iter().copied().filter(|id| claims::find(id).is_none()).collect(), missing)
}

#[test]
fn the_errata_name_every_wrong_statement_and_no_id_that_is_none() {
    let [english, chinese] = ["docs/errata.md", "docs/errata.zh.md"].map(|page| read(&root().join(page)));
    for page in [&english, &chinese] {
        assert_eq!(wrong_errata(page), (vec![], vec![]));
    }
    let (there, both): (BTreeSet<_>, BTreeSet<_>) = (named(&english).into_iter().collect(), named(&chinese).into_iter().collect());
    assert_eq!(there, both);
    let planted = english.replace("`S4.copos-plus`", "`S4.copositive-plus`");
    assert_eq!(wrong_errata(&planted), (vec!["S4.copositive-plus"], vec!["S4.copos-plus"]));
}

#[test]
fn the_errata_state_the_verdict_counts_of_the_registry() {
    let count = |verdict| claims::all().filter(|claim| claim.verdict == verdict).count();
    let counts = [ClaimVerdict::False, ClaimVerdict::Inconsistent, ClaimVerdict::Conditional].map(count);
    let numbers = [claims::all().count(), counts[0], counts[1], counts[2], counts.iter().sum()];
    for page in ["docs/errata.md", "docs/errata.zh.md"] {
        let text = read(&root().join(page));
        let head = text.split("\n## ").next().expect("what stands before the first theme");
        let digits = |letter: char| !letter.is_ascii_digit();
        let stated: Vec<usize> = head.split(digits).filter_map(|number| number.parse().ok()).collect();
        assert!(numbers.iter().all(|number| stated.contains(number)), "{page} should state {numbers:?}, states {stated:?}");
    }
}

/// Whether two texts are the same but for whole numbers that differ by one: coordinates of a picture, rounded on another processor.
fn same_picture(one: &str, other: &str) -> bool {
    let digits = |text: &str| -> Vec<String> {
        let mut parts = vec![String::new()];
        for letter in text.chars() {
            let last = parts.last_mut().expect("never empty");
            let number = last.chars().last().map(|before| before.is_ascii_digit());
            if number.is_none() || number == Some(letter.is_ascii_digit()) { last.push(letter) } else { parts.push(letter.into()) }
        }
        parts
    };
    let (one, other) = (digits(one), digits(other));
    let near = |(a, b): (&String, &String)| a == b || matches!((a.parse::<u64>(), b.parse::<u64>()), (Ok(a), Ok(b)) if a.abs_diff(b) == 1);
    one.len() == other.len() && one.iter().zip(&other).all(near)
}

#[test]
fn the_readme_s_commands_work_as_they_stand_and_print_and_draw_what_it_shows() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("readme-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("docs/pictures")).expect("the target directory is writable");
    let moreau = Path::new(env!("CARGO_BIN_EXE_moreau"));
    let path = std::env::join_paths([moreau.parent().expect("a folder").to_path_buf()]).expect("no colon in the folder's name");
    let (mut commands, mut shown, mut printed) = (0, 0, String::new());
    for (language, text) in blocks(README) {
        match language {
            "json" => std::fs::write(folder.join("problem.json"), text).expect("a writable folder"),
            "sh" if text.starts_with("moreau ") => {
                printed.clear();
                for command in text.lines() {
                    let arguments = command.strip_prefix("moreau ").expect("commands of moreau only").split_whitespace();
                    // the engine after `--` is `moreau` again, found in this folder alone: nothing else is needed
                    let run = Command::new(moreau).args(arguments).current_dir(&folder).env("PATH", &path).output();
                    let run = run.expect("the built command starts");
                    assert!(run.status.success(), "{command}: {}", String::from_utf8_lossy(&run.stderr));
                    printed += std::str::from_utf8(&run.stdout).expect("output is UTF-8");
                    commands += 1;
                }
            }
            "sh" => assert!(["cargo test", "cargo run --release -- verify"].contains(&text), "not run: {text}"),
            "text" => {
                for line in text.lines() {
                    assert!(printed.lines().any(|one| one == line), "not printed: {line}\n{printed}");
                    shown += 1;
                }
            }
            _ => panic!("a block in `{language}` that nothing looks at"),
        }
    }
    assert_eq!((commands, shown), (5, 8), "commands run and lines compared");
    assert!(read(&folder.join("answer.json")).contains("\"impulse\":[1.0,-0.5]"));
    let picture = "docs/pictures/ball.svg";
    assert!(README.contains(&format!("]({picture})")));
    assert!(same_picture(&read(&folder.join(picture)), &read(&root().join(picture))), "run the README's command for {picture} again");
    std::fs::remove_dir_all(&folder).expect("nobody else uses it");
}

#[test]
fn a_picture_differs_when_a_coordinate_a_word_or_a_curve_does() {
    let picture = "<line x1=\"999\" x2=\"1003\"/> h = 0.01 s";
    assert!(same_picture(picture, picture) && same_picture(picture, &picture.replace("999", "1000")));
    for (old, new) in [("999", "1001"), ("line", "lime"), ("x2=\"1003\"", "x2=\"1003\" x3=\"4\"")] {
        assert!(!same_picture(picture, &picture.replace(old, new)), "{new}");
    }
}

/// What is wrong with the links of a page: files that do not exist, headings that the file does not have.
fn broken(page: &Path, text: &str) -> Vec<String> {
    let targets = prose(text).flat_map(|line| line.split("](").skip(1)).map(|rest| rest.split(')').next().expect("a part"));
    let wrong = targets.filter(|target| !target.contains("://")).filter(|target| {
        let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
        let file = if file.is_empty() { page.to_path_buf() } else { page.parent().expect("a folder").join(file) };
        !file.exists() || !anchor.is_empty() && !anchors(&read(&file)).any(|heading| heading == anchor)
    });
    wrong.map(|target| format!("{}: {target}", page.display())).collect()
}

/// The headings of a page as the links that lead to them.
fn anchors(text: &str) -> impl Iterator<Item = String> {
    let headings = prose(text).filter(|line| line.starts_with('#'));
    headings.map(|line| {
        let plain = line.trim_start_matches('#').trim().to_lowercase();
        plain.chars().filter(|c| c.is_alphanumeric() || "-_ ".contains(*c)).map(|c| if c == ' ' { '-' } else { c }).collect()
    })
}

#[test]
fn every_link_leads_to_a_file_and_a_heading() {
    let of_crates = root().join("crates/moreau-contact/README.md");
    let found: Vec<_> = pages().iter().chain([&of_crates]).flat_map(|page| broken(page, &read(page))).collect();
    assert_eq!(found, Vec::<String>::new(), "broken links");
    let planted = "[a](docs/gate.md#verdicts) [b](docs/gate.md#nowhere) [c](nowhere.md)\n```text\n[d](code.md)\n```\n\
        [e](#two-commands) [f](#f) [g](https://g)";
    assert_eq!(broken(Path::new("README.md"), planted), ["README.md: docs/gate.md#nowhere", "README.md: nowhere.md", "README.md: #f"]);
}

#[test]
fn every_page_of_docs_is_in_the_index() {
    let index = read(&root().join("docs/README.md"));
    for entry in std::fs::read_dir(root().join("docs")).expect("a folder") {
        let name = entry.expect("readable").file_name().into_string().expect("UTF-8");
        let listed = ["README.md", "pictures"].contains(&name.as_str())
            || index.contains(&format!("({name})"))
            || index.contains(&format!("({name}/)"));
        assert!(listed, "docs/README.md does not name {name}");
    }
}

#[test]
fn every_example_in_rust_is_a_documentation_test() {
    let source = include_str!("../src/lib.rs");
    let mut examples = 0;
    for page in &pages() {
        let name = page.strip_prefix(root()).expect("below the root").display().to_string();
        if blocks(&read(page)).iter().any(|(language, _)| language.starts_with("rust")) {
            assert!(source.contains(&format!("include_str!(\"../{name}\")")), "src/lib.rs does not test the examples of {name}");
            examples += 1;
        }
    }
    assert!(examples > 0, "no page has an example: the test looks at nothing");
}

/// The folders of sources of all crates.
fn rooms() -> Vec<PathBuf> {
    let crates = ["exact", "forms", "contact", "dynamics", "checks", "replicas", "gate"];
    let libraries = crates.map(|name| root().join(format!("crates/moreau-{name}/src/lib.rs")));
    let folder = |library: &PathBuf| library.parent().expect("a folder").to_path_buf();
    libraries.iter().map(folder).chain([root().join("src")]).collect()
}

/// The Rust files of a folder and of those below it.
fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            rust_files(&path, files);
        } else if path.extension().is_some_and(|end| end == "rs") {
            files.push(path);
        }
    }
}

/// What is wrong with a piece of evidence: paths that do not exist, names that the file before them does not have.
fn unfounded(evidence: &str) -> Vec<String> {
    let (mut text, mut wrong) = (None, Vec::new());
    for word in evidence.split('`').skip(1).step_by(2) {
        if word.contains('/') && !word.contains(' ') {
            text = std::fs::read_to_string(root().join(word)).ok();
        }
        if !text.as_ref().is_some_and(|text: &String| word.contains('/') || text.contains(word)) {
            wrong.push(word.to_string());
        }
    }
    wrong
}

#[test]
fn the_evidence_of_every_decision_exists() {
    let text = read(&root().join("docs/decisions.md"));
    let decisions: Vec<_> = text.split("\n### ").skip(1).collect();
    assert!(decisions.len() > 30, "{} decisions", decisions.len());
    for decision in decisions {
        let question = decision.lines().next().expect("a question");
        let (_, evidence) = decision.split_once("*Evidence:*").unwrap_or_else(|| panic!("no evidence: {question}"));
        assert!(question.ends_with('?') && evidence.contains('`'), "{question}");
        assert_eq!(unfounded(evidence.split("\n## ").next().expect("a part")), Vec::<String>::new(), "{question}");
    }
    assert_eq!(unfounded("`docs/README.md`: `Documentation`, `no_such_test`; `tests/nowhere.rs`"), ["no_such_test", "tests/nowhere.rs"]);
}

#[test]
fn every_term_of_the_glossary_names_a_type_that_its_file_defines() {
    let text = read(&root().join("docs/glossary.md"));
    let defines = |line: &str, name: &str| {
        let defined = ["struct", "enum", "trait", "fn", "type", "mod"].map(|kind| format!("pub {kind} {name}"));
        defined.iter().any(|start| {
            line.trim()
                .strip_prefix(start.as_str())
                .is_some_and(|rest| !rest.starts_with(|next: char| next.is_alphanumeric() || next == '_'))
        })
    };
    let mut files = Vec::new();
    rooms().iter().for_each(|room| rust_files(room, &mut files));
    let sources: Vec<_> = files.into_iter().map(|file| (read(&file), file)).collect();
    let mut types = Vec::new();
    for row in text.lines().filter(|line| line.starts_with("| ") && line.contains(".rs`: `")) {
        let (place, name) = row.rsplit_once("`: `").expect("a file and a type");
        let (file, name) = (place.rsplit('`').next().expect("a file"), name.trim_end_matches("` |"));
        let source = read(&root().join(file));
        assert!(source.lines().any(|line| defines(line, name)), "docs/glossary.md: {file} does not define {name}");
        if name.starts_with(char::is_uppercase) {
            let places = sources.iter().filter(|(text, _)| text.lines().any(|line| defines(line, name))).map(|(_, file)| file);
            assert_eq!(places.collect::<Vec<_>>().len(), 1, "docs/glossary.md: {name} is the name of another public type as well");
        }
        types.push(name.to_string());
    }
    assert!(types.len() > 20, "{types:?}");
}

#[test]
fn the_citation_names_this_version() {
    let citation = read(&root().join("CITATION.cff"));
    let version = format!("version: {}", env!("CARGO_PKG_VERSION"));
    assert!(citation.lines().any(|line| line == version), "CITATION.cff should say: {version}");
    let named = format!("version {}", env!("CARGO_PKG_VERSION"));
    assert!(README.contains(&named), "README.md should say: {named}");
}
