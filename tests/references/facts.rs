//! Facts about an engine (`facts/1`) are those of the pinned version; what they say is judged by the claims.

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
