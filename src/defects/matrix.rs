//! Which check catches which planted mistake.

use crate::Result;
use crate::defects;
use crate::gate::Check;
pub use crate::gate::planted::judge;
use crate::gate::planted::{self, Planted};
use rayon::prelude::*;
use serde::Serialize;

/// A planted mistake and the checks that catch it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Row {
    /// `family/mistake`.
    pub name: &'static str,
    /// The mistake in one sentence.
    pub mistake: &'static str,
    /// The checks that catch it, in the order of the registry.
    pub caught_by: Vec<String>,
}

/// Runs the checks on every planted engine, and every family of property checks on its defects, in parallel.
///
/// # Errors
/// If a planted engine does not describe itself, or a defect cannot be computed.
pub fn matrix(checks: &[&'static Check], progress: &(dyn Fn() + Sync)) -> Result<Vec<Row>> {
    let planted: Vec<&'static Planted> = planted::all().collect();
    let rows = planted.par_iter().map(|planted| engine_row(planted, checks)).inspect(|_| progress());
    let mut rows = rows.collect::<Result<Vec<_>>>()?;
    let others: Vec<&'static defects::Defect> = defects::all().collect();
    rows.extend(others.par_iter().map(|defect| property_row(defect)).inspect(|_| progress()).collect::<Result<Vec<_>>>()?);
    Ok(rows)
}

/// How many rows the matrix has.
pub fn size() -> usize {
    planted::all().count() + defects::all().count()
}

fn engine_row(planted: &Planted, checks: &[&'static Check]) -> Result<Row> {
    let report = judge(planted, checks)?;
    let caught_by = report.checks.iter().filter(|check| check.verdict.is_bad()).map(|check| check.check.clone()).collect();
    Ok(Row { name: planted.name, mistake: planted.mistake, caught_by })
}

/// A defect of a family of property checks is caught by its family, whose name is the first part of its own.
fn property_row(defect: &defects::Defect) -> Result<Row> {
    let caught = !(defect.defective)()?.iter().all(crate::checks::Finding::holds);
    let family = defect.name.split('/').next().unwrap_or(defect.name);
    let caught_by = if caught { vec![format!("properties/{family}")] } else { Vec::new() };
    Ok(Row { name: defect.name, mistake: defect.mistake, caught_by })
}
