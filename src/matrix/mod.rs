//! Which check catches which planted mistake: every kind of subject and every kind of check in one matrix.
//!
//! ```text
//!     rows      planted assemblies, projections, solvers, certificates, schemes, closed forms, readers and reports
//!     columns   checks of the gate, agreements with stored runs and closed forms, energy balances, families of properties, certificates
//! ```
//! A mistake that is met in several subjects is one row: a scheme is asked by the gate, by its energy balance and by the agreements of its
//! system. The controls of the claims are planted subjects too, each under its own claim; they are counted apart.

mod alone;
mod controls;
mod judges;
mod repeats;
mod row;
mod sources;

pub use alone::{Alone, STANDS, alone};
pub use controls::{Control, controls};
pub use judges::JUDGES;
pub use repeats::REPEATS;
pub use row::{Row, rows};
pub use sources::{Source, sources};

use crate::Result;
use crate::gate::Check;
use serde::Serialize;

/// The whole matrix.
#[derive(Clone, Debug, Serialize)]
pub struct Matrix {
    /// One row per planted mistake.
    pub defects: Vec<Row>,
    /// The controls of the claims.
    pub controls: Vec<Control>,
    /// What each check of the gate catches that no other one does.
    pub alone: Vec<Alone>,
    /// Checks and claims that catch nothing, with the reason where there is one.
    pub checks_that_catch_nothing: Vec<String>,
}

impl Matrix {
    /// Runs everything, in parallel.
    ///
    /// # Errors
    /// If a planted engine does not describe itself, or a check cannot be computed on a planted subject.
    pub fn new(checks: &[&'static Check], progress: &(dyn Fn() + Sync)) -> Result<Self> {
        let sources = sources(checks);
        let defects = rows(&sources, progress)?;
        let controls = controls(progress);
        let caught = |check: &String| defects.iter().any(|row| row.caught_by.contains(check));
        let mut idle: Vec<String> = sources.iter().flat_map(|source| &source.checks).filter(|check| !caught(check)).cloned().collect();
        idle.extend(controls.iter().filter(|control| !control.caught).map(|control| format!("{}: {}", control.claim, control.why)));
        let alone = alone(checks.iter().map(|check| check.name), &defects);
        Ok(Matrix { defects, controls, alone, checks_that_catch_nothing: idle })
    }

    /// How often `progress` is called.
    pub fn size(checks: &[&'static Check]) -> usize {
        sources(checks).iter().map(|source| source.trials.len()).sum::<usize>() + crate::claims::all().count()
    }

    /// Whether every mistake is caught, every check catches one, and every check of the gate catches one alone or says why it stands.
    pub fn is_complete(&self) -> bool {
        self.checks_that_catch_nothing.is_empty()
            && self.alone.iter().all(Alone::is_justified)
            && self.defects.iter().all(|row| !row.caught_by.is_empty())
    }

    /// Rows whose line of reasoning no other row has.
    pub fn distinct(&self) -> usize {
        self.defects.iter().filter(|row| row.repeats.is_none()).count()
    }
}
