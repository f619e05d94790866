//! `moreau problems show`: one problem with its answers.

use super::super::output::{print, table};
use super::super::{Answer, Format};
use super::named::named;
use crate::Result;
use crate::report::json::pretty;
use crate::report::problems::show;

/// Show a problem's answers with what is proved of them, and what every solver did.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The problem's name.
    name: String,
    /// How to write it; JSON is the whole record, answered-problem/1.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  moreau problems show box-rough
  moreau problems show box-rough --format json > box-rough.answered.json";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    let record = named(&arguments.name)?.record()?;
    print(&match arguments.format {
        Format::Text => table(show(&record)),
        Format::Json => pretty(&record)?,
    })?;
    Ok(Answer::Yes)
}
