//! `moreau defects`: the planted mistakes and the checks that catch them.

use super::output::print;
use super::{Answer, Format, progress};
use crate::Result;
use crate::gate::checks;
use crate::matrix::Matrix;
use crate::report::json::pretty;
use crate::report::matrix::text;

/// Run every check on every planted mistake, and print which check catches which.
///
/// A planted mistake is a reference – an assembly, a projection, a solver, a certificate, a scheme, a closed form, a
/// reader or a report – with one realistic error. A check that catches none of them would show nothing, and a mistake
/// that no check catches would go unnoticed: both are answered with exit code 1. The gate's checks run the quick sweep
/// of time steps; every claim is put to its controls. It takes five minutes on two idle cores; a bar on a terminal shows how far it is.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// How to write the matrix: as text, or as {"defects": [{name, mistake, kind, repeats, caught_by: [check]}],
    /// "controls": [{claim, controls, caught, why}], "checks_that_catch_nothing": [check]}.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  moreau defects
  moreau defects --format json > caught.json";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    let checks: Vec<_> = checks::all().collect();
    let bar = progress::parts(Matrix::size(&checks), "planted mistakes and claims");
    let matrix = progress::shown(&bar, || Matrix::new(&checks, &|| bar.inc(1)))?;
    print(&match arguments.format {
        Format::Text => text(&matrix),
        Format::Json => pretty(&matrix)?,
    })?;
    Ok(matrix.is_complete().into())
}
