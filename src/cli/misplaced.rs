//! The cure of arguments that stand in another form than their command takes them: a name without its option, an option that is a place.

use super::unused::named;
use crate::gate::checks;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, Error};
use std::path::Path;

/// What a name without an option is to commands that take none.
const NAMELESS: [(&str, &str); 6] = [
    ("moreau simulate", "--scene"),
    ("moreau report", "--out"),
    ("moreau verify", "--explain"),
    ("moreau engine", "--scheme"),
    ("moreau new engine", "--language"),
    ("moreau scoreboard", "--only"),
];

/// Adds the right form to the message of an unexpected argument, where there is one.
pub fn advise(mut error: Error, program: &Command, words: &[String]) -> Error {
    if let Some(form) = right_form(&error, program, words) {
        // what merely looks alike is no other advice
        error.remove(ContextKind::SuggestedArg);
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![format!("use `{form}`").into()]));
    }
    error
}

/// The command line that is meant.
fn right_form(error: &Error, program: &Command, words: &[String]) -> Option<String> {
    let (ErrorKind::UnknownArgument, Some(ContextValue::String(given))) = (error.kind(), error.get(ContextKind::InvalidArg)) else {
        return None;
    };
    // `problems show` is a command of two words
    let (mut command, mut written, mut begin) = (program, String::from("moreau"), 1);
    for word in &words[1..] {
        let Some(below) = command.find_subcommand(word) else { break };
        (command, written, begin) = (below, format!("{written} {word}"), begin + 1);
    }
    let Some(option) = given.strip_prefix("--") else {
        let last = command.get_positionals().find(|place| place.is_last_set());
        let is_given = |option: &str| words.iter().any(|word| word.split('=').next() == Some(option));
        let nameless = NAMELESS.iter().find(|(name, option)| *name == written && !is_given(option));
        return match (last, nameless) {
            (Some(_), _) if is_given("--list") => Some(format!("{written} --list --only {given}")),
            (Some(_), _) if is_check(given) => Some(format!("{written} --only {given}")),
            // where the program stands behind its mark, the word is none of it
            (Some(_), _) if words.iter().any(|word| word == "--") => None,
            // the program with its own options, behind those of the command
            (Some(_), _) => {
                let place = begin + words[begin..].iter().position(|word| word == given)?;
                Some(format!("moreau {} -- {}", words[1..place].join(" "), words[place..].join(" ")))
            }
            (None, Some(("moreau verify", _))) if !given.contains('.') => Some(format!("{written} --search {given}")),
            (None, Some((_, option))) => Some(format!("{written} {option} {given}")),
            (None, None) => None,
        };
    };
    let places: Vec<String> = command.get_positionals().map(named).collect();
    places.iter().any(|place| place.eq_ignore_ascii_case(option)).then(|| format!("{written} {}", places.join(" ")))
}

/// Whether it is named as a check of the gate is, or a group of them, and is no file.
fn is_check(given: &str) -> bool {
    let group = |name: &str| name.split('/').next() == given.split('/').next();
    given.contains('/') && !Path::new(given).exists() && checks::all().any(|check| group(check.name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Arguments;
    use clap::CommandFactory;

    fn said(words: &str) -> String {
        let program = Arguments::command();
        let words: Vec<String> = words.split(' ').map(String::from).collect();
        let error = program.clone().try_get_matches_from(&words).err().unwrap_or_else(|| panic!("{words:?}: is taken"));
        advise(error, &program, &words).to_string()
    }

    #[test]
    fn what_stands_in_another_form_is_told_with_the_right_one() {
        for (words, form) in [
            ("moreau simulate bouncing-ball", "moreau simulate --scene bouncing-ball"),
            ("moreau compare --scene bouncing-ball", "moreau compare SCENE"),
            ("moreau compare --scene=bouncing-ball", "moreau compare SCENE"),
            ("moreau report out", "moreau report --out out"),
            ("moreau verify S4.copos-plus", "moreau verify --explain S4.copos-plus"),
            ("moreau engine anitescu", "moreau engine --scheme anitescu"),
            ("moreau gate ./engine", "moreau gate -- ./engine"),
            ("moreau gate --quick ./engine --own", "moreau gate --quick -- ./engine --own"),
            ("moreau gate moreau engine", "moreau gate -- moreau engine"),
            ("moreau protocol-check moreau engine", "moreau protocol-check -- moreau engine"),
            ("moreau gate --list incline", "moreau gate --list --only incline"),
            ("moreau gate ball/energy", "moreau gate --only ball/energy"),
            ("moreau verify zeno", "moreau verify --search zeno"),
            ("moreau new engine python", "moreau new engine --language python"),
            ("moreau certify p.json --solution s.json", "moreau certify PROBLEM SOLUTION"),
            ("moreau protocol-check ./engine", "moreau protocol-check -- ./engine"),
            ("moreau solve --problem p.json", "moreau solve PROBLEM"),
            ("moreau problems show --name block", "moreau problems show NAME"),
            ("moreau man --folder man", "moreau man FOLDER"),
        ] {
            let message = said(words);
            assert!(message.contains(&format!("tip: use `{form}`")), "{words}: {message}");
        }
        for (words, tip) in [
            ("moreau solve p.json --solvr pgs", "--solver"),
            ("moreau simulate --scene x --nonsense", ""),
            ("moreau simulate --scene=x y", ""),
            ("moreau gate --only a b -- moreau engine", ""),
        ] {
            let message = said(words);
            assert!(!message.contains("use `moreau") && message.contains(tip), "{words}: {message}");
        }
    }

    #[test]
    fn commands_that_are_advised_have_the_option_and_no_place() {
        let program = Arguments::command();
        for (name, option) in NAMELESS {
            let below = |command: &'_ Command, word: &str| command.find_subcommand(word).cloned().unwrap_or_else(|| panic!("{name}"));
            let command = name.split(' ').skip(1).fold(program.clone(), |command, word| below(&command, word));
            assert!(command.get_arguments().any(|argument| named(argument) == option) && command.get_positionals().count() == 0, "{name}");
        }
    }
}
