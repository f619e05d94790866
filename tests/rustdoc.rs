//! Runnable examples in the documentation of every crate: counted here, run by `cargo test` as documentation tests; and the pages of
//! equations, made from TeX: `MOREAU_EQUATIONS=write cargo test --test rustdoc equations` writes them.

use moreau_checks::formula::{html, unicode};
use std::path::{Path, PathBuf};

/// The crates, each with the least number of examples that `cargo test` runs and that assert something.
const LEAST: [(&str, usize); 8] = [
    ("moreau-exact", 10),
    ("moreau-forms", 20),
    ("moreau-contact", 40),
    ("moreau-dynamics", 15),
    ("moreau-checks", 6),
    ("moreau-replicas", 6),
    ("moreau-gate", 8),
    ("moreau", 8),
];

/// The folder of sources of a crate.
fn sources(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    if name == "moreau" { root.join("src") } else { root.join("crates").join(name).join("src") }
}

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

/// The examples of a file that are run and assert something.
fn examples(source: &str) -> usize {
    let (mut count, mut block): (usize, Option<(bool, bool)>) = (0, None);
    for line in source.lines() {
        let Some(text) = line.trim_start().strip_prefix("///").or_else(|| line.trim_start().strip_prefix("//!")) else { continue };
        let text = text.trim();
        match (text.strip_prefix("```"), &mut block) {
            (Some(language), None) => block = Some((["", "rust"].contains(&language), false)),
            (Some(_), Some((runs, asserts))) => {
                count += usize::from(*runs && *asserts);
                block = None;
            }
            (None, Some((_, asserts))) => *asserts |= text.contains("assert"),
            (None, None) => {}
        }
    }
    count
}

fn of_crate(name: &str) -> usize {
    let mut files = Vec::new();
    rust_files(&sources(name), &mut files);
    files.iter().map(|file| examples(&std::fs::read_to_string(file).expect("UTF-8"))).sum()
}

#[test]
fn every_crate_shows_its_entry_points_in_examples_that_are_run() {
    let counts = LEAST.map(|(name, least)| (name, of_crate(name), least));
    let few: Vec<_> = counts.iter().filter(|(_, count, least)| count < least).collect();
    assert!(few.is_empty(), "(crate, examples, least): {few:?}");
    assert!(counts.iter().map(|(_, count, _)| count).sum::<usize>() >= 60);
}

#[test]
fn what_is_not_run_or_asserts_nothing_is_not_counted() {
    let one = "/// ```\n/// assert!(sum(1, 1) == 2);\n/// ```\n";
    assert_eq!(examples(one), 1);
    for other in
        [one.replacen("```", "```text", 1), one.replacen("```", "```no_run", 1), one.replace("assert!", "drop"), one.replace("///", "//")]
    {
        assert_eq!(examples(&other), 0, "{other}");
    }
    assert_eq!(examples(&format!("{one}\n//! ```text\n//! assert\n//! ```\n{one}")), 2);
}

/// The crates with a page of equations.
const WITH_EQUATIONS: [&str; 3] = ["moreau-contact", "moreau-dynamics", "moreau-replicas"];

/// A text with its formulas as MathML: a line that is nothing else stands by itself. rustdoc reads Markdown, in which MathML is taken as
/// it is.
fn page(source: &str) -> String {
    let note = "<!-- Made from source.md by `MOREAU_EQUATIONS=write cargo test --test rustdoc equations`. -->\n\n";
    let mut text = String::from(note);
    for line in source.lines() {
        let alone = line.strip_prefix('$').and_then(|rest| rest.strip_suffix('$')).filter(|rest| !rest.contains('$'));
        match alone {
            // a block of a known element is not read as Markdown
            Some(tex) => {
                text += &format!(
                    "<div style=\"margin:0.7em 0;overflow-x:auto\">{}</div>",
                    mathml(tex).replacen("display=\"inline\"", "display=\"block\"", 1)
                )
            }
            None => {
                let parts = line.split('$').enumerate().map(|(k, part)| if k % 2 == 0 { part.into() } else { inline(&mathml(part)) });
                text.extend(parts.collect::<Vec<String>>());
            }
        }
        text.push('\n');
    }
    text
}

fn mathml(tex: &str) -> String {
    html(&format!("${tex}$")).unwrap_or_else(|error| panic!("{tex}: {error}")).into_string()
}

/// MathML within a paragraph, where Markdown would read marks of its own between the tags.
fn inline(mathml: &str) -> String {
    let marks = [("*", "&#42;"), ("_", "&#95;"), ("[", "&#91;"), ("]", "&#93;"), ("|", "&#124;"), ("~", "&#126;")];
    marks.iter().fold(mathml.to_string(), |text, (mark, written)| text.replace(mark, written))
}

#[test]
fn pages_of_equations_are_what_their_source_says() {
    for name in WITH_EQUATIONS {
        let folder = sources(name).join("equations");
        let source = std::fs::read_to_string(folder.join("source.md")).expect("a source");
        let made = page(&source);
        if std::env::var_os("MOREAU_EQUATIONS").is_some_and(|what| what == "write") {
            std::fs::write(folder.join("page.md"), &made).expect("writable");
        }
        let stored = std::fs::read_to_string(folder.join("page.md")).expect("a page");
        assert!(stored == made, "{name}: its page is not what source.md says; write it with MOREAU_EQUATIONS=write");
        assert!(source.matches('$').count().is_multiple_of(2) && made.matches("<math").count() == made.matches("</math>").count());
    }
}

/// The equations that a reader looks for, each by how it reads on a terminal.
#[test]
fn the_pages_have_the_main_equations() {
    let read = |name: &str| {
        let source = std::fs::read_to_string(sources(name).join("equations/source.md")).expect("a source");
        let formulas = source.split('$').skip(1).step_by(2).map(|tex| unicode(&format!("${tex}$")).unwrap_or_else(|_| tex.into()));
        formulas.collect::<Vec<String>>().join("\n").replace(' ', "")
    };
    let [contact, dynamics, replicas] = WITH_EQUATIONS.map(read);
    for equation in ["W=HM̂⁻¹Hᵀ", "0≤r_n⟂φ≥0", "‖r_t‖≤μr_n", "ŷ=y+μ‖y_t‖n", "r−P_{K_μ}(r−ρ", "0≤z⟂Mz+q≥0", "η<η"]
    {
        assert!(contact.contains(equation), "{equation} is not in\n{contact}");
    }
    for equation in ["M(v⁺−v)=hF_θ", "0≤r_n⟂φ/h", "q⁺=q+hv⁺", "θv⁺+(1−θ)v", "½rᵀWr"] {
        assert!(dynamics.contains(equation), "{equation} is not in\n{dynamics}");
    }
    for equation in ["R_t=σw", "a₀=M⁻¹F(q,v)", "v⁺=v+ha"] {
        assert!(replicas.contains(equation), "{equation} is not in\n{replicas}");
    }
}

#[test]
fn a_page_that_is_cut_or_not_made_again_is_seen() {
    let source = "The gap $x_1$ and\n\n$\\frac{a}{b}$\n";
    let made = page(source);
    assert!(made.contains("The gap <math") && made.contains("><math display=\"block\"><mfrac"), "{made}");
    assert_ne!(made, page(&source.replace('b', "c")));
    assert!(!inline("<mo>*</mo><mo>[</mo>").contains(['*', '[']));
}
