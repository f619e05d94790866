//! The command line: one file per subcommand.
//!
//! Exit codes: 0 the answer is yes, 1 the answer is no, 2 the question could not be understood (and nothing was written; of
//! several files the others are answered), 3 the engine to be judged could not be run, 130 a command with engines was interrupted.

mod answer;
mod asked;
mod bench;
mod certificate_options;
mod certify;
mod claim_filters;
mod compare;
mod completions;
mod convert;
mod defects;
mod drake_options;
mod dump_options;
mod engine;
mod folder;
mod gate;
mod kind;
mod limits;
mod man;
mod misplaced;
pub mod motion;
mod mujoco_options;
mod near;
mod new;
mod number;
mod output;
mod outputs;
mod owned;
pub mod posed;
mod problem_law;
mod problems;
pub mod progress;
mod protocol_check;
pub mod remarks;
mod report;
mod residual_names;
mod scene;
mod schema;
mod scheme_options;
mod scoreboard;
mod section;
mod several;
mod simulate;
mod solve;
mod solver_options;
mod solver_table;
mod systems;
mod time_limit;
mod unused;
mod verify;

use crate::{Error, Result};
use answer::{Answer, Format};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use std::ffi::OsString;
use std::process::ExitCode;

/// Proofs-as-tests for contact time-stepping.
///
/// Verifies the claims of a textbook chapter on nonsmooth contact dynamics, solves and certifies contact problems, and
/// simulates scenes with Moreau–Jean, Stewart–Trinkle and Anitescu time-stepping.
#[derive(Parser)]
#[command(name = "moreau", version = env!("MOREAU_VERSION"), after_help = EXAMPLES, arg_required_else_help = true, max_term_width = 120)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
What do you want to do?
  Know whether a sentence of the book is true
    moreau verify --list --search zeno            the claims that speak of it
    moreau verify --explain S4.copos-plus         one claim: witness, corrected theorem, sources
    moreau report --out report                    everything as pages: open report/index.html
  Solve a contact problem, or know whether an answer is one
    moreau new problem --out problem.json         a file to begin with
    moreau solve problem.json --out answer.json
    moreau certify problem.json answer.json       residuals with units: is it a solution?
    moreau solve problems/ --out answers/         every problem of a folder; certify takes the two folders
  See how a scene moves under a scheme, and under others beside it
    moreau simulate --scene bouncing-ball --step 0.01 --plot ball.svg
    moreau compare bouncing-ball --step 0.01 --plot schemes.svg
  Judge a simulator, and stop the build when its physics changes
    moreau new engine --language python --out my_engine.py
    moreau protocol-check -- python3 my_engine.py what is wrong with an adapter
    moreau gate --quick -- python3 my_engine.py   every check
  Choose a solver, or a simulator
    moreau bench problems/                        times of solvers, each beside its certified residual
    moreau systems                                every simulator on four axes, with measured agreement

Exit codes:
  0  the answer is yes: every verdict is supported, the answer is a solution
  1  the answer is no
  2  bad input: one message names the file and the field, and nothing is written;
     of several files the others are answered all the same
  3  the engine to be judged could not be run
  130  `gate`, `protocol-check` and `scoreboard` were interrupted, by Ctrl-C, SIGTERM or SIGHUP: they end the
     engines first; other commands end as the signal ends them";

#[derive(Subcommand)]
enum Command {
    Verify(verify::Arguments),
    Report(report::Arguments),
    Solve(solve::Arguments),
    Certify(certify::Arguments),
    Bench(bench::Arguments),
    Problems(problems::Arguments),
    Convert(convert::Arguments),
    New(new::Arguments),
    Simulate(Box<simulate::Arguments>),
    Compare(compare::Arguments),
    Gate(Box<gate::Arguments>),
    Defects(defects::Arguments),
    Engine(engine::Arguments),
    ProtocolCheck(protocol_check::Arguments),
    Schema(schema::Arguments),
    Scoreboard(scoreboard::Arguments),
    Systems(systems::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

/// Runs the command line of this process and returns its exit code.
pub fn run() -> ExitCode {
    ExitCode::from(run_with(std::env::args_os()))
}

/// Runs a command line, which begins with the name of the command, and returns the exit code.
pub fn run_with<T: Into<OsString> + Clone>(arguments: impl IntoIterator<Item = T>) -> u8 {
    let words: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
    let arguments = match parsed(&words) {
        Ok(Ok(arguments)) => arguments,
        Ok(Err(error)) => return exit_code(Err(error)),
        Err(message) => {
            // Help and usage errors print themselves; a reader that has gone away changes nothing.
            let _ = message.print();
            return if message.use_stderr() { 2 } else { 0 };
        }
    };
    let answer = match arguments.command {
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Report(arguments) => report::run(&arguments),
        Command::Solve(arguments) => solve::run(&arguments),
        Command::Certify(arguments) => certify::run(&arguments),
        Command::Bench(arguments) => bench::run(&arguments),
        Command::Problems(arguments) => problems::run(&arguments),
        Command::Convert(arguments) => convert::run(&arguments),
        Command::New(arguments) => new::run(&arguments),
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Gate(arguments) => gate::run(&arguments),
        Command::Defects(arguments) => defects::run(&arguments),
        Command::Engine(arguments) => engine::run(&arguments),
        Command::ProtocolCheck(arguments) => protocol_check::run(&arguments),
        Command::Schema(arguments) => schema::run(&arguments),
        Command::Scoreboard(arguments) => scoreboard::run(&arguments),
        Command::Systems(arguments) => systems::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments, Arguments::command()),
        Command::Man(arguments) => man::run(&arguments, Arguments::command()),
    };
    exit_code(answer)
}

/// The arguments, unless one of them is unknown, or would be passed over.
fn parsed(words: &[OsString]) -> std::result::Result<Result<Arguments>, clap::Error> {
    let mut program = Arguments::command();
    let matches = program.try_get_matches_from_mut(words).map_err(|error| {
        let words: Vec<String> = words.iter().map(|word| word.to_string_lossy().into_owned()).collect();
        misplaced::advise(error, &program, &words)
    })?;
    let arguments = Arguments::from_arg_matches(&matches)?;
    Ok(unused::refuse(&program, &matches).map(|()| arguments))
}

fn exit_code(answer: Result<Answer>) -> u8 {
    match answer {
        Ok(Answer::Yes) => 0,
        Ok(Answer::No) => 1,
        Ok(Answer::BadInput) => 2,
        Ok(Answer::CannotRun) => gate::CANNOT_RUN,
        Err(error) => {
            let advice = kind::advice(&error).map_or(String::new(), |advice| format!("; {advice}"));
            output::print_aside(&format!("error: {error}{advice}\n"));
            if is_no_answer(&error) { 1 } else { 2 }
        }
    }
}

/// Whether a solver gave no answer to a question that was well posed.
fn is_no_answer(error: &Error) -> bool {
    match error {
        Error::Solver { .. } => true,
        Error::InFile { inner, .. } => is_no_answer(inner),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::any::TypeId;
    use std::num::NonZeroUsize;

    #[test]
    fn the_arguments_are_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn the_commands_that_are_advised_for_files_are_commands_with_these_options() {
        let top = Arguments::command();
        for (schema, done) in kind::DONE {
            let Some(words) = done.strip_prefix("`moreau ").and_then(|rest| rest.split('`').next()) else { continue };
            let mut words = words.split(' ');
            let command = words.next().and_then(|name| top.find_subcommand(name)).unwrap_or_else(|| panic!("{schema}: {done}"));
            for option in words.filter_map(|word| word.strip_prefix("--")).filter(|option| !option.is_empty()) {
                assert!(command.get_arguments().any(|argument| argument.get_long() == Some(option)), "{schema}: --{option}");
            }
        }
    }

    /// Every option whose value is a number, of a command and those below it: the words to it, and its own.
    fn numbers(command: &clap::Command, words: &[String], found: &mut Vec<Vec<String>>) {
        let kinds = [TypeId::of::<usize>(), TypeId::of::<u64>(), TypeId::of::<u32>(), TypeId::of::<f64>(), TypeId::of::<NonZeroUsize>()];
        for argument in command.get_arguments() {
            let kind = argument.get_value_parser().type_id();
            if let Some(long) = argument.get_long().filter(|_| kinds.iter().any(|known| kind == *known)) {
                found.push(words.iter().cloned().chain([format!("--{long}")]).collect());
            }
        }
        for below in command.get_subcommands() {
            let words: Vec<String> = words.iter().cloned().chain([below.get_name().to_string()]).collect();
            numbers(below, &words, found);
        }
    }

    #[test]
    fn what_is_no_number_is_told_in_plain_words_whatever_the_option() {
        let mut options = Vec::new();
        numbers(&Arguments::command(), &["moreau".into()], &mut options);
        assert!(options.len() > 40, "{options:?}");
        for words in options {
            let said = |value: &str| {
                let words = words.iter().cloned().chain([value.to_string()]);
                Arguments::command().try_get_matches_from(words).map_or_else(|error| error.to_string(), |_| String::new())
            };
            let (text, huge, negative) = (said("x"), said(&"9".repeat(400)), said("-1"));
            assert!(text.contains("invalid value 'x'") && text.contains("': give "), "{words:?}: {text}");
            for message in [text, huge, negative] {
                let ours =
                    ["digit", "literal", "type", "parse", "target", "unexpected", "use '--"].iter().find(|word| message.contains(**word));
                assert_eq!(ours, None, "{words:?}: {message}");
            }
        }
    }
}
