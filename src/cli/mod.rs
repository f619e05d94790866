//! The command line: one file per subcommand.
//!
//! Exit codes: 0 the answer is yes, 1 the answer is no, 2 the question could not be understood (and nothing was written).

mod near;
mod output;
mod verify;

use crate::{Error, Result};
use clap::{Parser, Subcommand, ValueEnum};
use std::io::Write;
use std::process::ExitCode;

/// Proofs-as-tests for contact time-stepping.
///
/// Verifies the claims of a textbook chapter on nonsmooth contact dynamics.
#[derive(Parser)]
#[command(name = "moreau", version, after_help = EXAMPLES, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  moreau verify                              every claim, with verdict and decisive number
  moreau verify --explain S4.copos-plus      one claim: witness, corrected theorem, sources

Exit codes:
  0  the answer is yes: every verdict is supported
  1  the answer is no
  2  bad input: one message names the file and the field, and nothing is written";

#[derive(Subcommand)]
enum Command {
    Verify(verify::Arguments),
}

/// How to write the result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For reading.
    #[default]
    Text,
    /// For programs.
    Json,
}

/// The answer of a subcommand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Answer {
    /// Exit code 0.
    Yes,
    /// Exit code 1.
    No,
}

impl From<bool> for Answer {
    fn from(yes: bool) -> Self {
        if yes { Answer::Yes } else { Answer::No }
    }
}

/// Runs the command line and returns its exit code.
pub fn run() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(message) => {
            // Help and usage errors print themselves; a reader that has gone away changes nothing.
            let _ = message.print();
            return ExitCode::from(if message.use_stderr() { 2 } else { 0 });
        }
    };
    let answer = match arguments.command {
        Command::Verify(arguments) => verify::run(&arguments),
    };
    exit_code(answer)
}

fn exit_code(answer: Result<Answer>) -> ExitCode {
    match answer {
        Ok(Answer::Yes) => ExitCode::SUCCESS,
        Ok(Answer::No) => ExitCode::from(1),
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "error: {error}");
            ExitCode::from(if matches!(error, Error::Solver { .. }) { 1 } else { 2 })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        Arguments::command().debug_assert();
    }
}
