//! Facts about an engine (`facts/1`) are those of the pinned version, facts about a repository (`repositories/1`)
//! those of one commit, and a record of literature (`literature/1`) says where it was read; what they say is judged by the claims.

use crate::document::{Document, VERSIONS};
use crate::siconos;
use libtest_mimic::Failed;
use moreau::checks::Finding;

/// Every finding about one stored file.
pub fn check(document: &Document) -> Result<Vec<Finding>, Failed> {
    let text = |key: &str| document.value[key].as_str().ok_or_else(|| format!("facts have a {key}"));
    let (program, version) = (text("program")?, text("version")?);
    let pinned = VERSIONS.contains(&(program, version)) || (program, version) == ("siconos", siconos::VERSION);
    let stated = document.value["stated"].as_object().ok_or("facts state something")?;
    let empty = |key: &str| stated.get(key).and_then(|list| list.as_array()).is_some_and(Vec::is_empty);
    Ok(vec![
        Finding::decision("the version is the pinned one", pinned, true),
        Finding::decision("something is stated", stated.is_empty(), false),
        Finding::decision("the files that were looked for are there", empty("files"), false),
    ])
}

/// The entries of a list of the document, each with its name for messages.
fn entries<'a>(document: &'a Document, list: &str, name: &str) -> Result<Vec<(&'a str, &'a serde_json::Value)>, Failed> {
    let all = document.value[list].as_array().filter(|all| !all.is_empty()).ok_or_else(|| format!("there are {list}"))?;
    all.iter().map(|entry| Ok((entry[name].as_str().ok_or_else(|| format!("an entry has a {name}"))?, entry))).collect()
}

/// Every finding about the stored repositories.
pub fn repositories(document: &Document) -> Result<Vec<Finding>, Failed> {
    let mut findings = Vec::new();
    for (name, tree) in entries(document, "trees", "repository")? {
        let revision = tree["revision"].as_str().ok_or("a tree has a revision")?;
        let commit = tree["commit"].as_str().unwrap_or_default();
        let whole = commit.len() == 40 && commit.bytes().all(|digit| digit.is_ascii_hexdigit());
        let named_by_it = !revision.bytes().all(|digit| digit.is_ascii_hexdigit()) || commit.starts_with(revision);
        let sought = tree["sought"].as_array().is_some_and(|names| !names.is_empty());
        findings.extend([
            Finding::decision(format!("{name} {revision}: a whole commit"), whole, true),
            Finding::decision(format!("{name} {revision}: the commit is the revision's"), named_by_it, true),
            Finding::decision(format!("{name} {revision}: something was sought"), sought, true),
            Finding::decision(format!("{name} {revision}: files are listed"), tree["stated"]["files"].is_array(), true),
        ]);
    }
    Ok(findings)
}

/// Every finding about the stored records of literature.
pub fn literature(document: &Document) -> Result<Vec<Finding>, Failed> {
    let mut findings = Vec::new();
    for (name, record) in entries(document, "records", "id")? {
        let told = |key: &str| record[key].as_str().is_some_and(|text| !text.is_empty());
        let stated = record["stated"].as_object().is_some_and(|facts| !facts.is_empty());
        let read = record["read"].as_array().is_some_and(|places| !places.is_empty());
        findings.extend([
            Finding::decision(format!("{name}: an identifier"), told("identifier"), true),
            Finding::decision(format!("{name}: where it was read"), read, true),
            Finding::decision(format!("{name}: how it came here, and when"), told("transcribed") && told("entered"), true),
            Finding::decision(format!("{name}: something is stated"), stated, true),
        ]);
    }
    Ok(findings)
}
