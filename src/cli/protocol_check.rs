//! `moreau protocol-check`: tells the author of an adapter what is wrong with it.

use super::output::{print, print_aside, style};
use super::time_limit::of_reply;
use super::{Answer, Format, number, progress};
use crate::Result;
use crate::gate::conformance::conformance_heard;
use crate::gate::process::{Limits, end_engines_on_interrupt};
use crate::number::significant;
use crate::report::gate::conformance::text;
use crate::report::json::pretty;

/// Check an adapter: does it speak moreau-engine/1, and does it report what the protocol means?
///
/// Starts COMMAND, talks to it, and lets it simulate a thrown ball, a tumbling brick and a landing ball for a few steps. Every probe that
/// finds a mistake says what was seen and how to cure it. Whether the engine simulates well is the question of `moreau gate`.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The adapter: a command with its arguments.
    #[arg(last = true, value_name = "COMMAND", required = true)]
    command: Vec<String>,
    /// Seconds the adapter may take for one request. Where it takes longer when it is asked to describe itself, or twice in a row later,
    /// nothing more is asked, and the probes left are skipped.
    #[arg(long, value_parser = number::seconds, value_name = "SECONDS", default_value_t = 60.0, allow_negative_numbers = true)]
    time_limit: f64,
    /// Seconds the adapter may take from its start to its first reply, for one that has much to load; --time-limit unless given.
    #[arg(long, value_parser = number::seconds, value_name = "SECONDS", allow_negative_numbers = true)]
    start_limit: Option<f64>,
    /// How to write the result.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  moreau protocol-check -- python3 my_engine.py
  moreau protocol-check --format json -- ./my-engine --stdio

Exit codes: 0 no probe found a problem; 1 one did; 2 usage; 3 the adapter could not be started;
130 interrupted, by Ctrl-C, SIGTERM or SIGHUP, after the adapter was ended.";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    end_engines_on_interrupt()?;
    let reply = of_reply("--time-limit", arguments.time_limit)?;
    let start = arguments.start_limit.map_or(Ok(reply), |limit| of_reply("--start-limit", limit))?;
    let limits = Limits { reply, start, ..Limits::default() };
    let bar = progress::word("");
    let asked =
        |name: &str| bar.set_message(format!("{name} waits for the adapter, {} s at most for a reply", significant(arguments.time_limit)));
    match progress::shown(&bar, || conformance_heard(&arguments.command, limits, &asked)) {
        Ok(outcome) => {
            print(&match arguments.format {
                Format::Text => text(&outcome, style()),
                Format::Json => pretty(&outcome)?,
            })?;
            Ok(outcome.is_sound().into())
        }
        Err(fault) => {
            print_aside(&format!("error: the adapter could not be run: {fault}\n"));
            Ok(Answer::CannotRun)
        }
    }
}
