//! The cure of arguments that stand in another form than their command takes them: a name without its option, an option that is a place.

use super::unused::named;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, Error};

/// What a name without an option is to commands that take none.
const NAMELESS: [(&str, &str); 5] =
    [("simulate", "--scene"), ("report", "--out"), ("verify", "--explain"), ("engine", "--scheme"), ("scoreboard", "--only")];

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
    let (mut command, mut written) = (program, String::from("moreau"));
    for word in &words[1..] {
        let Some(below) = command.find_subcommand(word) else { break };
        (command, written) = (below, format!("{written} {word}"));
    }
    let Some(option) = given.strip_prefix("--") else {
        let last = command.get_positionals().find(|place| place.is_last_set());
        let is_given = |option: &str| words.iter().any(|word| word.split('=').next() == Some(option));
        let nameless = NAMELESS.iter().find(|(name, option)| *name == command.get_name() && !is_given(option));
        return match (last, nameless) {
            (Some(_), _) => Some(format!("{written} -- {given}")),
            (None, Some((_, option))) => Some(format!("{written} {option} {given}")),
            (None, None) => None,
        };
    };
    let place = command.get_positionals().map(named).find(|place| place.eq_ignore_ascii_case(option))?;
    Some(format!("{written} {place}"))
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
            ("moreau gate --quick ./engine", "moreau gate -- ./engine"),
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
        ] {
            let message = said(words);
            assert!(!message.contains("use `moreau") && message.contains(tip), "{words}: {message}");
        }
    }

    #[test]
    fn commands_that_are_advised_have_the_option_and_no_place() {
        let program = Arguments::command();
        for (name, option) in NAMELESS {
            let command = program.find_subcommand(name).unwrap_or_else(|| panic!("{name}"));
            assert!(command.get_arguments().any(|argument| named(argument) == option) && command.get_positionals().count() == 0, "{name}");
        }
    }
}
