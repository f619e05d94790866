//! Options that a command would pass over: an option that asks for something else than the command's work leaves nothing for the others.

use crate::{Error, Result};
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Command};

/// What a command does in place of its work, or on something else.
struct Mode {
    command: &'static str,
    /// The argument that asks for it.
    asked: &'static str,
    /// The arguments that count then; all others are refused.
    counting: &'static [&'static str],
}

/// Of each command the first one that is given counts.
const MODES: [Mode; 7] = [
    Mode { command: "gate", asked: "explain", counting: &["format"] },
    Mode { command: "gate", asked: "failures", counting: &[] },
    Mode { command: "gate", asked: "list", counting: &["trajectory", "solver", "projection", "only", "skip", "format"] },
    Mode { command: "gate", asked: "write_scenes", counting: &["description", "solver", "projection", "only", "skip", "quick", "steps"] },
    Mode {
        command: "gate",
        asked: "trajectory",
        counting: &[
            "description",
            "quick",
            "steps",
            "only",
            "skip",
            "jobs",
            "require",
            "baseline",
            "save_baseline",
            "junit",
            "html",
            "out",
            "format",
        ],
    },
    Mode { command: "simulate", asked: "list", counting: &["format"] },
    Mode { command: "scoreboard", asked: "stored", counting: &["engines", "only", "folder", "html", "readme", "format"] },
];

/// Refuses an argument that its command would pass over.
///
/// # Errors
/// [`Error::Invalid`] names it, and the option beside which it does nothing.
pub fn refuse(program: &Command, matches: &ArgMatches) -> Result<()> {
    let Some((name, given)) = matches.subcommand() else { return Ok(()) };
    let is_given = |id: &str| given.value_source(id) == Some(ValueSource::CommandLine);
    let Some(mode) = MODES.iter().find(|mode| mode.command == name && is_given(mode.asked)) else { return Ok(()) };
    let counts = |argument: &&Arg| mode.asked == argument.get_id().as_str() || mode.counting.contains(&argument.get_id().as_str());
    let all = || program.find_subcommand(name).into_iter().flat_map(Command::get_arguments);
    let Some(unused) = all().find(|argument| is_given(argument.get_id().as_str()) && !counts(argument)) else { return Ok(()) };
    let asked = all().find(|argument| argument.get_id() == mode.asked).map(named).unwrap_or_default();
    Err(Error::invalid(named(unused), format!("does nothing beside {asked}"), "leave one of them out"))
}

/// How an argument is written: an option with its hyphens, another one in capitals.
pub fn named(argument: &Arg) -> String {
    match argument.get_long() {
        Some(long) => format!("--{long}"),
        None => {
            argument.get_value_names().and_then(|names| names.first()).map_or_else(|| argument.get_id().to_string(), ToString::to_string)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Arguments;
    use clap::CommandFactory;

    #[test]
    fn every_argument_of_a_mode_is_one_of_its_command() {
        let program = Arguments::command();
        for Mode { command, asked, counting } in &MODES {
            let own = program.find_subcommand(command).unwrap_or_else(|| panic!("{command}"));
            for id in counting.iter().chain([asked]) {
                assert!(own.get_arguments().any(|argument| argument.get_id() == id), "{command} {id}");
            }
        }
    }

    /// What is said of these words; nothing where they are taken.
    fn said(words: &str) -> Option<String> {
        let program = Arguments::command();
        let matches = program.clone().try_get_matches_from(words.split(' ')).unwrap_or_else(|error| panic!("{words}: {error}"));
        refuse(&program, &matches).err().map(|error| error.to_string())
    }

    #[test]
    fn what_a_mode_passes_over_is_refused_by_name_and_what_counts_is_taken() {
        for (words, unused, asked) in [
            ("moreau gate --list --html x.html", "--html", "--list"),
            ("moreau gate --list -- engine", "COMMAND", "--list"),
            ("moreau gate --explain ball/energy --only ball", "--only", "--explain"),
            ("moreau gate --write-scenes f --jobs 2", "--jobs", "--write-scenes"),
            ("moreau gate --trajectory a.json --time-limit 3", "--time-limit", "--trajectory"),
            ("moreau gate --trajectory a.json --option x=1", "--option", "--trajectory"),
            ("moreau gate --failures f.md --format json", "--format", "--failures"),
            ("moreau simulate --list --step 0.1", "--step", "--list"),
            ("moreau simulate --list --dump-rejected f", "--dump-rejected", "--list"),
            ("moreau scoreboard --stored --full", "--full", "--stored"),
        ] {
            let message = said(words).unwrap_or_else(|| panic!("{words}: is taken"));
            assert!(message.contains(&format!("`{unused}`: does nothing beside {asked}; leave ")), "{words}: {message}");
        }
        for words in [
            "moreau gate --list --only ball --format json",
            "moreau gate --quick --html x.html -- engine",
            "moreau gate --trajectory a.json --description d.json --steps 0.1 --out x.json",
            "moreau gate --write-scenes f --steps 0.1",
            "moreau simulate --list --format json",
            "moreau simulate --scene ball --step 0.1",
            "moreau verify --explain S4.copos-plus --format json",
            "moreau problems list --hard",
        ] {
            assert_eq!(said(words), None, "{words}");
        }
    }
}
