//! `moreau problems measure`: what every solver does with a problem, as the records of the collection say it.

use super::super::limits::CommonOptions;
use super::super::output::{print, table};
use super::super::{Answer, Format, number, progress, time_limit};
use crate::Result;
use crate::problem::{ContactProblem, Solution};
use crate::problems::{Measured, measure_within};
use crate::report::json::pretty;
use crate::report::problems::left_out;
use crate::report::quantity::short;
use crate::solvers::Solvers;
use crate::solvers::watch::watched;
use std::fmt::Write;
use std::path::PathBuf;

/// Ask every solver of moreau-contact for an answer, judge each, and compare their velocities.
///
/// The engines' own iterations – cg, gauss-pgs, sap, sequential-impulses – are left out, as in the records of the collection;
/// `moreau solve --solver NAME` asks them. Iterative solvers may make as many iterations as a fixed number of multiplications by W
/// allows, so that the same problem gives the same answer on every machine.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The problem: contact-problem/1, lcp/1, .dat of Siconos, or HDF5 of FCLIB.
    problem: PathBuf,
    /// An answer from elsewhere, a file solution/1, that is judged and compared with the others; may be given several times.
    #[arg(long, value_name = "FILE")]
    given: Vec<PathBuf>,
    /// End each solver after this time with the best answer so far, as `--time-limit` of `moreau bench` does, and the plain sweeps: another
    /// run need not find the same, and the result is marked as not reproducible.
    #[arg(long, value_parser = number::seconds, value_name = "SECONDS", allow_hyphen_values = true)]
    time_limit: Option<f64>,
    #[command(flatten)]
    common: CommonOptions,
}

const EXAMPLES: &str = "\
Examples:
  moreau problems measure problem.json
  moreau problems measure problem.json --given mine.json --format json

Exit code 0: some answer is accepted; 1: none is.";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    arguments.common.apply()?;
    time_limit::check(arguments.time_limit)?;
    let problem = ContactProblem::read(&arguments.problem)?;
    let given: Vec<Solution> = arguments.given.iter().map(|file| Solution::read(file, &problem)).collect::<Result<_>>()?;
    let own = Solvers::own();
    let bar = progress::parts(own.names().count(), "solvers");
    let asked = |name: &str| {
        bar.set_message(format!(", {name}"));
        bar.inc(1);
    };
    let within = |work: &mut dyn FnMut()| time_limit::within(arguments.time_limit, |over| watched(over, work).1.interrupted);
    let measured = progress::shown(&bar, || measure_within(&problem, &given, &own, &asked, &within))?;
    print(&match arguments.common.format {
        Format::Text => table(text(&measured) + &left_out(measured.solvers.iter().map(|outcome| outcome.solver.as_str()))),
        Format::Json => pretty(&measured)?,
    })?;
    Ok((!measured.answers.is_empty()).into())
}

fn text(measured: &Measured) -> String {
    let mut text = format!("{:19} {:9} {:>8} {:>10} {:>8} why\n", "solver", "ended", "residual", "iterations", "Δu [m/s]");
    for outcome in &measured.solvers {
        let number = |value: Option<f64>| value.map_or("–".into(), short);
        let [relative, difference] = [outcome.relative, outcome.difference].map(number);
        let iterations = outcome.iterations.map_or("–".into(), |iterations| iterations.to_string());
        let reason = outcome.reason.as_deref().unwrap_or_default();
        let _ = writeln!(text, "{:19} {:9} {relative:>8} {iterations:>10} {difference:>8} {reason}", outcome.solver, outcome.ended.name());
    }
    let sweeps =
        measured.difficulty.sweeps.map_or_else(|| measured.difficulty.reason.clone().unwrap_or_default(), |sweeps| sweeps.to_string());
    let _ = writeln!(text, "answers with different velocities: {}; plain sweeps to 1e-8: {sweeps}", measured.answers.len());
    if measured.reproducible == Some(false) {
        text += "the time limit ended some of them: another run need not find the same\n";
    }
    text
}
