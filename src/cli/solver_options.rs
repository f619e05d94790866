//! How a solver is asked: its name, its limit of iterations, the residual at which it stops, and the time it may take.

use super::limits::check_tolerance;
use super::solver_table::check_name;
use super::{number, time_limit};
use crate::solvers::watch::Interrupt;
use crate::solvers::{self, ContactSolver};
use crate::tolerance::cli::{ASKED_SHARE, CERTIFY};
use crate::{Error, Result};

/// The residual that is asked for, and that the certificate accepts.
#[derive(clap::Args)]
pub struct ToleranceOption {
    /// Largest residual accepted, relative to the scale of its contact [default: 1e-8]. Where it is given, iterations stop at half of it,
    /// or where only rounding is left.
    #[arg(long, value_parser = number::real, value_name = "NUMBER", allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// End a solve after this time with the best answer so far, which the next run need not find again: it is marked as not reproducible.
    /// Iterations look between their steps, sweeps between their contacts, eliminations between their fronts, pivoting methods between
    /// their pivots; Clarabel looks between its iterations, whose factorisations it ends no sooner. Of an answer that is refused, a proof
    /// that there is no solution is looked for after that.
    #[arg(long, value_parser = number::seconds, value_name = "SECONDS", allow_hyphen_values = true)]
    time_limit: Option<f64>,
}

impl ToleranceOption {
    /// What the certificate accepts.
    pub fn accepted(&self) -> f64 {
        self.tolerance.unwrap_or(CERTIFY)
    }

    /// Refuses numbers that are no tolerance or no time.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the option.
    pub fn check(&self) -> Result<()> {
        check_tolerance("--tolerance", self.accepted())?;
        time_limit::check(self.time_limit)
    }

    /// The solver of this name, with the limit of iterations and the tolerance that were asked for.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where there is no such solver, or it has no such limit.
    pub fn solver(&self, name: &str, iterations: Option<usize>) -> Result<Box<dyn ContactSolver>> {
        check_name(name)?;
        let solver = solvers::ALL.with_iterations(name, iterations).map_err(|error| match error {
            Error::Invalid { problem, cure, .. } => Error::invalid("--iterations", problem, cure),
            other => other,
        })?;
        let exact = self.tolerance.and_then(|tolerance| solver.with_tolerance(ASKED_SHARE * tolerance));
        Ok(exact.unwrap_or(solver))
    }

    /// Whether a solve may be ended early.
    pub fn has_time_limit(&self) -> bool {
        self.time_limit.is_some()
    }

    /// Runs `solve`, whose interrupt is given when the time is over.
    pub fn within_time<T>(&self, solve: impl FnOnce(&Interrupt) -> T) -> T {
        time_limit::within(self.time_limit, solve)
    }
}
