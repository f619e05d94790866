//! `moreau problems list`: a line per problem.

use super::super::near::suggestion;
use super::super::output::print;
use super::super::{Answer, Format, section};
use crate::files::write_together;
use crate::problems::{ALL, Known, Record};
use crate::report::json::pretty;
use crate::report::problems::{BEGIN, END, HARD, Line, list, markdown};
use crate::{Error, Result};
use std::path::PathBuf;

/// List the problems, all of them or those that fit every filter.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// Those of this family.
    #[arg(long, value_name = "NAME")]
    group: Option<String>,
    /// Those under this law: frictionless, coulomb, associated, polyhedral-coulomb, polyhedral-associated.
    #[arg(long, value_name = "LAW")]
    law: Option<String>,
    /// Those with this word about their velocity: unique, several, none, unknown.
    #[arg(long, value_name = "WORD")]
    velocity: Option<String>,
    /// Those with at least so many contacts.
    #[arg(long, value_name = "NUMBER")]
    from: Option<usize>,
    /// Those with at most so many contacts.
    #[arg(long, value_name = "NUMBER")]
    to: Option<usize>,
    /// Those at which three or more solvers fail.
    #[arg(long)]
    hard: bool,
    /// Replace the section between `<!-- problems -->` and `<!-- /problems -->` of this file; docs/problems.md is where the table stands.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["group", "law", "velocity", "from", "to", "hard"])]
    readme: Option<PathBuf>,
    /// How to write the list.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  moreau problems list
  moreau problems list --law coulomb --from 100 --hard
  moreau problems list --velocity several --format json
  moreau problems list --readme docs/problems.md";

const MARKERS: [&str; 2] = [BEGIN, END];

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    let records: Vec<Record> = ALL.iter().map(|stored| stored.record()).collect::<Result<_>>()?;
    known("--group", arguments.group.as_deref(), records.iter().map(|record| record.group.as_str()))?;
    known("--law", arguments.law.as_deref(), records.iter().map(|record| record.law.as_str()))?;
    let words = [Known::Unique, Known::Several, Known::None, Known::Unknown].map(Known::name);
    known("--velocity", arguments.velocity.as_deref(), words.into_iter())?;
    let is = |given: &Option<String>, own: &str| given.as_deref().is_none_or(|given| given == own);
    let fits = |record: &&Record| {
        is(&arguments.group, &record.group)
            && is(&arguments.law, &record.law)
            && is(&arguments.velocity, record.uniqueness.velocity.name())
            && arguments.from.is_none_or(|least| record.contacts >= least)
            && arguments.to.is_none_or(|most| record.contacts <= most)
            && (!arguments.hard || record.failures() >= HARD)
    };
    let lines: Vec<Line> = records.iter().filter(fits).map(Line::new).collect();
    if let Some(file) = &arguments.readme {
        let text = section::replaced(file, MARKERS, &markdown(&lines))?;
        write_together(&[(file.as_path(), text.as_bytes())])?;
    }
    print(&match arguments.format {
        Format::Text => list(&lines),
        Format::Json => pretty(&lines)?,
    })?;
    Ok(Answer::Yes)
}

/// Refuses a filter that fits nothing because it is misspelt.
fn known<'a>(option: &str, given: Option<&str>, names: impl Iterator<Item = &'a str>) -> Result<()> {
    let Some(given) = given else { return Ok(()) };
    let mut names: Vec<&str> = names.collect();
    names.sort_unstable();
    names.dedup();
    if names.contains(&given) {
        return Ok(());
    }
    let fallback = format!("use one of {}", names.join(", "));
    Err(Error::invalid(option, format!("is `{given}`"), suggestion(given, names.iter().copied(), &fallback)))
}
