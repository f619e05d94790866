//! A planted mistake and what catches it.

use super::repeats::original;
use super::sources::Source;
use crate::Result;
use crate::checks::planted::{Catch, Kind, Trial};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;

/// A planted mistake and the checks that catch it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// `family/mistake`.
    pub name: &'static str,
    /// The mistake in one sentence.
    pub mistake: &'static str,
    /// What it is a mistake of.
    pub kind: Kind,
    /// The row with the same line of reasoning, if this one differs from it in a constant or in its place only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repeats: Option<&'static str>,
    /// The checks that catch it, in the order in which they were asked.
    pub caught_by: Vec<String>,
    /// The time steps \[s\] at which checks of the gate catch it, by check.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub time_steps: BTreeMap<String, Vec<f64>>,
}

impl Row {
    fn new(trial: &Trial) -> Self {
        let repeats = original(trial.name);
        Row { name: trial.name, mistake: trial.mistake, kind: trial.kind, repeats, caught_by: Vec::new(), time_steps: BTreeMap::new() }
    }

    fn add(&mut self, catches: Vec<Catch>) {
        for Catch { check, time_steps } in catches {
            if !time_steps.is_empty() {
                self.time_steps.insert(check.clone(), time_steps);
            }
            if !self.caught_by.contains(&check) {
                self.caught_by.push(check);
            }
        }
    }
}

/// The rows of all sources, in parallel: mistakes of one name are one row.
///
/// # Errors
/// If a check cannot be computed on a planted subject.
pub fn rows(sources: &[Source], progress: &(dyn Fn() + Sync)) -> Result<Vec<Row>> {
    let trials: Vec<&Trial> = sources.iter().flat_map(|source| &source.trials).collect();
    // one after the other from the front, so that a long one is not begun last
    let judged = trials.iter().enumerate().par_bridge().map(|(place, trial)| Ok((place, (trial.caught_by)()?)));
    let mut caught = judged.inspect(|_| progress()).collect::<Result<Vec<_>>>()?;
    caught.sort_by_key(|(place, _)| *place);
    let mut rows: Vec<Row> = Vec::new();
    for (trial, (_, catches)) in trials.into_iter().zip(caught) {
        let place = rows.iter().position(|row| row.name == trial.name).unwrap_or_else(|| {
            rows.push(Row::new(trial));
            rows.len() - 1
        });
        rows[place].add(catches);
    }
    rows.sort_by_key(|row| row.kind);
    Ok(rows)
}
