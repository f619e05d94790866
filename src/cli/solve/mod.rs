//! `moreau solve`: solves a contact problem and certifies its own answer.

mod arguments;
mod folder;
mod one;
mod start;

pub use arguments::Arguments;

use super::kind::read_problem;
use super::output::{keep_input, no_answer, print, print_aside, style};
use super::outputs::{self, JSON};
use super::remarks::remark;
use super::{Answer, Format, progress};
use crate::Result;
use crate::files::write_atomically;
use crate::report::json::pretty;
use one::{Answered, Outcome, solved};

const USAGE: &str = "moreau solve PROBLEM";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    arguments.tolerance.check()?;
    arguments.common.apply()?;
    let solver = arguments.tolerance.solver(&arguments.solver, arguments.iterations)?;
    if arguments.problem.is_dir() {
        return folder::run(arguments, &*solver);
    }
    keep_input(&arguments.problem, "--out", arguments.out.as_deref())?;
    outputs::require("--out", arguments.out.as_deref(), JSON)?;
    let problem = arguments.law.pose(read_problem(&arguments.problem, USAGE)?)?;
    remark(&arguments.problem, &problem, arguments.common.format);
    let start = arguments.start.as_deref().map(|file| start::read(arguments, &*solver, file, &problem)).transpose()?;
    let solve = || solved(arguments, &*solver, &arguments.problem, problem, start.as_ref());
    match progress::shown(&progress::word("solving"), solve)? {
        Outcome::Answer(answered) => written(arguments, &answered),
        Outcome::None { error, proof, interrupted } => {
            if arguments.common.format == Format::Json {
                return no_answer(error, |failure| failure.with_proof(proof).ended_by_time(interrupted), arguments.out.is_none());
            }
            if interrupted {
                print_aside("ended by the time limit: another run may find an answer\n");
            }
            if let Some(proof) = proof {
                print_aside(&proof);
            }
            Err(error)
        }
    }
}

/// The answer and its certificate, each where it belongs.
fn written(arguments: &Arguments, answered: &Answered) -> Result<Answer> {
    let certificate = answered.certificate(arguments.tolerance.accepted());
    let report = match arguments.common.format {
        Format::Text => style().fitted(&certificate.text()),
        Format::Json => pretty(&certificate)?,
    };
    let answer = answered.written()?;
    match &arguments.out {
        Some(file) => {
            write_atomically(file, answer.as_bytes())?;
            print(&report)?;
        }
        None => {
            print(&answer)?;
            print_aside(&report);
        }
    }
    Ok(certificate.accepts().into())
}
