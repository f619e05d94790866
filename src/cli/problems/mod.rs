//! `moreau problems`: the collection of contact problems with certified answers.

mod export;
mod list;
mod measure;
mod named;
mod show;

use super::Answer;
use crate::Result;
use clap::Subcommand;

/// Contact problems with certified answers: list them, show one, write them as files, measure one of your own.
///
/// Each, but for those that have no solution or of which none was found, has one or more answers with different velocities u, certified at
/// 1e-8 without knowing who found them; δ, a proved bound on how far
/// the nearest problem is that the answer solves exactly; the proved distance from a solution in u, or the reason why there is none;
/// whether u is the only velocity; and how many plain Gauss–Seidel sweeps it takes. references/problems/README.md specifies all of it.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES, arg_required_else_help = true)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  moreau problems list --group towers
  moreau problems show box-rough                 answers, proofs, what every solver did
  moreau problems export box-rough .             box-rough.json and box-rough.solution.json
  moreau problems export --all problems          then: moreau bench problems
  moreau problems measure problem.json           what every solver does with a problem of your own

A solver that fails at a problem answers something that the certificate rejects, or gives up; a solver that is not made for the law, or
is not asked because the problem is too large for it, does not fail.";

#[derive(Subcommand)]
enum Command {
    List(list::Arguments),
    Show(show::Arguments),
    Export(export::Arguments),
    Measure(measure::Arguments),
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    match &arguments.command {
        Command::List(arguments) => list::run(arguments),
        Command::Show(arguments) => show::run(arguments),
        Command::Export(arguments) => export::run(arguments),
        Command::Measure(arguments) => measure::run(arguments),
    }
}
