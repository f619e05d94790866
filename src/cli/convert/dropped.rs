//! What a conversion does not keep, told in a line.

use super::super::kind::Kind;
use super::super::output::print_aside;
use super::super::posed;
use crate::problem::{ContactProblem, Posed, StoredAnswers};
use serde::de::IgnoredAny;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Fields of contact-problem/1 and lcp/1 that another file may have no place for, each as it is named.
const FIELDS: [(&str, &str); 5] = [
    ("mass", "`mass`"),
    ("jacobian", "`jacobian` (W, which follows, is kept)"),
    ("bodies", "`bodies`"),
    ("keys", "`keys`"),
    ("provenance", "`provenance`"),
];

/// What FCLIB's local form does not keep of a file; `replaced` tells whether another solution takes the place of the stored one.
pub fn by_fclib(file: &Path, problem: &ContactProblem, out: Option<&Path>, stored: &StoredAnswers, replaced: bool) -> Vec<String> {
    let text = text_of(file);
    let (fields, mut dropped) = (fields(&text), fields_without_place(&text));
    let is_named = fields.contains("name") && !problem.name().is_empty();
    if is_named && out.and_then(Path::file_stem).is_some_and(|stem| stem.to_string_lossy() != problem.name()) {
        dropped.push(format!("`{}` as the name (it is kept as `info/title`; the name of the file is read)", problem.name()));
    }
    if replaced && stored.solution.is_some() {
        dropped.push("the stored solution, which the given one replaces".into());
    }
    if is_text(file) && problem.knows_rows() {
        dropped.push(ROWS.into());
    }
    dropped.extend(stored.left_out.iter().map(|path| format!("`{path}`")));
    dropped
}

/// The fields of a contact-problem/1 that FCLIB's local form has no place for.
pub fn fields_without_place(text: &str) -> Vec<String> {
    let fields = fields(text);
    FIELDS.iter().filter(|(field, _)| fields.contains(*field)).map(|(_, named)| named.to_string()).collect()
}

/// The beginning of a text, on one line.
fn begun(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let shown: String = line.chars().take(SHOWN).collect();
    if shown.len() < line.len() { shown + "…" } else { shown }
}

/// So many letters of a text are shown.
const SHOWN: usize = 40;

/// What a global problem loses where W alone is written.
const ROWS: &str = "M and H (W, which follows, is kept)";

/// Whether a file is named as one of Siconos's.
fn is_text(file: &Path) -> bool {
    file.extension().is_some_and(|end| end == "dat")
}

/// What the text of a contact-problem/1 does not keep of a file.
pub fn by_json(file: &Path, posed: &Posed, text: &str) -> Vec<String> {
    let (before, after) = (fields(&text_of(file)), fields(text));
    let is_lost = |field: &str| before.contains(field) && !after.contains(field);
    let keeps_rows = after.contains("mass") && after.contains("jacobian");
    let mut dropped: Vec<String> = FIELDS.iter().filter(|(field, _)| is_lost(field)).map(|(_, named)| named.to_string()).collect();
    match StoredAnswers::read(file) {
        Ok(stored) => {
            dropped.extend(stored.solution.as_ref().map(|_| "the stored solution".to_string()));
            dropped.extend((!stored.guesses.is_empty()).then(|| format!("the stored guesses ({})", stored.guesses.len())));
            let named = posed::name(posed);
            let said = stored.info.iter().filter(|(name, text)| name != "title" || text != named);
            dropped.extend(said.map(|(name, text)| format!("`info/{name}` (“{}”)", begun(text))));
            let is_kept = |path: &str| keeps_rows && ["fclib_global/M", "fclib_global/H"].contains(&path);
            dropped.extend(stored.left_out.iter().filter(|path| !is_kept(path)).map(|path| format!("`{path}`")));
        }
        // the problem is whole all the same
        Err(error) => dropped.push(format!("the stored answers, which cannot be read ({error})")),
    }
    if !keeps_rows && is_text(file) && matches!(posed, Posed::Contacts(problem) if problem.knows_rows()) {
        dropped.push(ROWS.into());
    }
    dropped
}

/// Tells what is not kept, where there is something.
pub fn tell(file: &Path, form: &str, dropped: &[String]) {
    if !dropped.is_empty() {
        print_aside(&format!("remark: {}: not kept in {form}: {}\n", file.display(), dropped.join(", ")));
    }
}

/// The text of a file that is JSON; no other has fields, and what is read once only has none either.
fn text_of(file: &Path) -> String {
    match Kind::of(file) {
        Kind::Json(_) => std::fs::read_to_string(file).unwrap_or_default(),
        _ => String::new(),
    }
}

/// The names of the fields of an object that are there and not null.
fn fields(text: &str) -> BTreeSet<String> {
    let all: BTreeMap<String, Option<IgnoredAny>> = serde_json::from_str(text).unwrap_or_default();
    all.into_iter().filter(|(_, value)| value.is_some()).map(|(name, _)| name).collect()
}
