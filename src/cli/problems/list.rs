//! `moreau problems list`: a line per problem.

use super::super::near::suggestion;
use super::super::output::{print, table};
use super::super::{Answer, Format, number, section};
use super::named::not_stored;
use crate::files::write_together;
use crate::problems::{ALL, Known, Record};
use crate::report::json::pretty;
use crate::report::problems::{BEGIN, END, HARD, Line, list, markdown};
use crate::{Error, Result};
use std::path::PathBuf;

/// List the problems, all of them or those that fit every filter.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{COLUMNS}\n\n{}", groups()))]
pub struct Arguments {
    /// Those of this family.
    #[arg(long, value_name = "NAME")]
    group: Option<String>,
    /// Those under this law: frictionless, coulomb, associated, polyhedral-coulomb, polyhedral-associated.
    #[arg(long, value_name = "LAW")]
    law: Option<String>,
    /// Those with this word about their velocity: unique, at-most-one, several, none, unknown.
    #[arg(long, value_name = "WORD")]
    velocity: Option<String>,
    /// Those with at least so many contacts.
    #[arg(long, value_parser = number::whole, value_name = "NUMBER", allow_negative_numbers = true)]
    from: Option<usize>,
    /// Those with at most so many contacts.
    #[arg(long, value_parser = number::whole, value_name = "NUMBER", allow_negative_numbers = true)]
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

const COLUMNS: &str = "\
Columns:
  problem   its name, for `moreau problems show` and `export`
  contacts  how many
  law       frictionless, coulomb, associated, or a polyhedral one
  μ         the coefficient of friction, or the least and the largest
  velocity  whether all solutions have one velocity u: unique, several and none (no solution) are proved, unknown is not;
            at-most-one where no solution is known
  δ         [m/s] the first answer solves exactly a problem whose free velocity is this near at every contact, proved in fractions
  radius    [m/s] the problem itself has a solution whose u is this near, proved by intervals; – where that is not proved
  sweeps    plain Gauss–Seidel sweeps until the certificate accepts 1e-8; – where they do not get there
  failed    how many solvers gave up, or answered what the certificate rejects; a solver of other laws does not fail";

/// The families of problems, for `--group`.
const GROUPS: [(&str, &str); 18] = [
    ("single", "one point or ball under every law: sticking, sliding, on borders, open"),
    ("painleve", "rods on the ground with Painlevé's paradox: several velocities at large μ"),
    ("plane", "in the plane: beams on 2 to 60 points, and others"),
    ("boxes", "a box that rests, lands, slides or turns on 4 to 100 points"),
    ("towers", "boxes on each other, at rest and sliding"),
    ("walls", "bricks in bond, at rest and pushed"),
    ("arches", "arches of 3 to 31 stones that stand by friction"),
    ("spheres", "piles and pyramids of spheres"),
    ("capsules", "heaps and chains of capsules"),
    ("jammed", "bodies in wedges, slots and crates that they fill"),
    ("redundant", "tables on more legs than they need: impulses are not unique"),
    ("mass-ratio", "piles and pyramids whose masses differ by up to 1e6"),
    ("uneven", "boxes that slide on points which are all but in a plane"),
    ("landed", "plates that have landed on each other, between whose points the load wanders"),
    ("hard", "towers, pyramids and crates on which at least three of our solvers were expected to fail"),
    ("convex", "the same data under frictionless, associated and polyhedral laws"),
    ("no-solution", "proved to have none, some of them feasible"),
    ("steps", "steps of MuJoCo, Drake, Siconos and Bullet"),
];

fn groups() -> String {
    let lines: Vec<String> = GROUPS.iter().map(|(name, what)| format!("  {name:12}{what}")).collect();
    format!("Groups, for --group:\n{}", lines.join("\n"))
}

const MARKERS: [&str; 2] = [BEGIN, END];

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    if let (Some(least), Some(most)) = (arguments.from, arguments.to)
        && least > most
    {
        let cure = format!("give a number of contacts of at most {most}, or a larger --to");
        return Err(Error::invalid("--from", format!("is {least}, and --to is {most}: no number is between them"), cure));
    }
    let records: Vec<Record> = ALL.iter().map(|stored| stored.record()).collect::<Result<_>>()?;
    known("--group", arguments.group.as_deref(), records.iter().map(|record| record.group.as_str()))?;
    known("--law", arguments.law.as_deref(), records.iter().map(|record| record.law.as_str()))?;
    let words = [Known::Unique, Known::AtMostOne, Known::Several, Known::None, Known::Unknown].map(Known::name);
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
        Format::Text => table(list(&lines) + &not_stored(lines.iter().filter(|line| !line.stored).map(|line| line.name.as_str()))),
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_group_of_the_collection_is_explained_and_no_other() {
        let records = ALL.iter().map(|stored| stored.record().expect("a record").group);
        assert_eq!(records.collect::<BTreeSet<_>>(), GROUPS.iter().map(|(name, _)| name.to_string()).collect());
    }
}
