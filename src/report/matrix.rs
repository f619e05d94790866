//! The matrix of planted mistakes as text: the mistakes by kind, what each check catches, and the counts.

use crate::checks::planted::KINDS;
use crate::matrix::{Matrix, Row};
use std::collections::BTreeMap;

/// The whole matrix.
pub fn text(matrix: &Matrix) -> String {
    let kinds = KINDS.map(|kind| {
        let rows: Vec<&Row> = matrix.defects.iter().filter(|row| row.kind == kind).collect();
        let shown: String = rows.iter().map(|row| mistake(row)).collect();
        format!("{}: {}\n\n{shown}\n", kind.plural(), counted(&rows))
    });
    format!("{}{}{}", kinds.concat(), catches(matrix), summary(matrix))
}

fn mistake(row: &Row) -> String {
    let caught = if row.caught_by.is_empty() { "NOBODY".into() } else { row.caught_by.join("; ") };
    let repeats = row.repeats.map_or(String::new(), |original| format!("    repeats {original}\n"));
    format!("  {}\n    {}\n{repeats}    caught by {caught}\n", row.name, row.mistake)
}

fn counted(rows: &[&Row]) -> String {
    let distinct = rows.iter().filter(|row| row.repeats.is_none()).count();
    let missed = rows.iter().filter(|row| row.caught_by.is_empty()).count();
    format!("{} planted mistakes, {distinct} lines of reasoning, {missed} that no check catches", rows.len())
}

/// Every check with the number of mistakes that it catches, the busiest first.
fn catches(matrix: &Matrix) -> String {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for check in matrix.defects.iter().flat_map(|row| &row.caught_by) {
        *counts.entry(check).or_default() += 1;
    }
    let mut counts: Vec<_> = counts.into_iter().collect();
    counts.sort_by_key(|(name, count)| (std::cmp::Reverse(*count), *name));
    let lines: String = counts.iter().map(|(name, count)| format!("{count:>5}  {name}\n")).collect();
    format!("mistakes that each of {} checks catches\n\n{lines}\n", counts.len())
}

fn summary(matrix: &Matrix) -> String {
    let controls: usize = matrix.controls.iter().map(|control| control.controls.len()).sum();
    let passed = matrix.controls.iter().filter(|control| !control.caught).count();
    let rows: Vec<&Row> = matrix.defects.iter().collect();
    let mut text = format!("in all: {}\n", counted(&rows));
    text += &format!("controls: {controls} of {} claims, {passed} claims that do not tell theirs\n", matrix.controls.len());
    match matrix.checks_that_catch_nothing.as_slice() {
        [] => text + "every check and every claim catches one\n",
        idle => text + &format!("catch nothing: {}\n", idle.join("; ")),
    }
}
