//! The matrix of planted mistakes as text: the mistakes by kind, what each check catches, and the counts.

use crate::checks::planted::KINDS;
use crate::matrix::{Alone, Matrix, Row};
use moreau_exact::number::significant;
use std::collections::BTreeMap;

/// The whole matrix.
pub fn text(matrix: &Matrix) -> String {
    let kinds = KINDS.map(|kind| {
        let rows: Vec<&Row> = matrix.defects.iter().filter(|row| row.kind == kind).collect();
        let shown: String = rows.iter().map(|row| mistake(row)).collect();
        format!("{}: {}\n\n{shown}\n", kind.plural(), counted(&rows))
    });
    format!("{}{}{}{}", kinds.concat(), catches(matrix), alone(matrix), summary(matrix))
}

fn mistake(row: &Row) -> String {
    let caught = if row.caught_by.is_empty() {
        "NOBODY".into()
    } else {
        row.caught_by.iter().map(|check| at(row, check)).collect::<Vec<_>>().join("; ")
    };
    let repeats = row.repeats.map_or(String::new(), |original| format!("    repeats {original}\n"));
    format!("  {}\n    {}\n{repeats}    caught by {caught}\n", row.name, row.mistake)
}

/// A check with the time steps at which it catches this mistake.
fn at(row: &Row, check: &str) -> String {
    match row.time_steps.get(check) {
        Some(steps) => format!("{check} at {} s", steps.iter().map(|h| significant(*h)).collect::<Vec<_>>().join(", ")),
        None => check.into(),
    }
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

/// What each check of the gate catches alone.
fn alone(matrix: &Matrix) -> String {
    let line = |alone: &Alone| {
        let told = match (alone.catches.as_slice(), alone.stands) {
            ([], Some(why)) => format!("stands because {why}"),
            ([], None) => "NOTHING, and no reason is given why it stands".into(),
            (catches, None) => catches.join(", "),
            (catches, Some(_)) => format!("{}, BUT A REASON IS GIVEN WHY IT STANDS WITHOUT", catches.join(", ")),
        };
        format!("  {}: {told}\n", alone.check)
    };
    format!("what each check of the gate catches that no other one does\n\n{}\n", matrix.alone.iter().map(line).collect::<String>())
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
