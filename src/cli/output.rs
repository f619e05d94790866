//! Writing results: standard output that survives a closed pipe, notes on standard error, colours.

use super::{Answer, outputs};
use crate::files::is_same_file;
use crate::report::json::pretty;
use crate::report::no_answer::NoAnswer;
use crate::report::text::Style;
use crate::{Error, Result};
use anstream::{AutoStream, ColorChoice};
use std::io::{ErrorKind, Write};
use std::path::Path;

/// Refuses to write a result over the file it comes from.
///
/// # Errors
/// [`Error::Invalid`] names the option.
pub fn keep_input(input: &Path, option: &str, output: Option<&Path>) -> Result<()> {
    match output {
        Some(output) if input.is_file() && is_same_file(input, output) => {
            let problem = format!("is {}, which is also the input file", output.display());
            Err(Error::invalid(option, problem, "write the result to another file"))
        }
        _ => Ok(()),
    }
}

/// Refuses results that would be written over an input or over each other; an output comes with its option.
///
/// # Errors
/// [`Error::Invalid`] names the option.
pub fn keep_files(inputs: &[&Path], outputs: &[(&'static str, &Path)]) -> Result<()> {
    for (k, (option, file)) in outputs.iter().enumerate() {
        inputs.iter().try_for_each(|input| keep_input(input, option, Some(file)))?;
        if let Some((other, _)) = outputs[..k].iter().find(|(_, other)| is_same_file(other, file) || other == file) {
            return Err(Error::invalid(*option, format!("is the same file as {other}"), "give each its own file"));
        }
    }
    Ok(())
}

/// Refuses to draw an SVG picture into a file that is named as something else.
///
/// # Errors
/// [`Error::Invalid`] names the option.
pub fn require_svg(option: &str, file: Option<&Path>) -> Result<()> {
    match file.and_then(|file| Some((file, file.extension()?))) {
        Some((file, end)) if !end.eq_ignore_ascii_case("svg") => {
            let problem = format!("is {}, and the picture is SVG", file.display());
            Err(Error::invalid(option, problem, "end the name in .svg"))
        }
        _ => outputs::require(option, file, outputs::SVG),
    }
}

/// Writes to standard output. A reader that stops early (`| head`) is not an error.
///
/// # Errors
/// [`Error::Write`] for any other failure, such as a full disk.
pub fn print(text: &str) -> Result<()> {
    let mut output = std::io::stdout().lock();
    match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
        Err(source) if source.kind() != ErrorKind::BrokenPipe => Err(Error::Write { file: Path::new("standard output").into(), source }),
        _ => Ok(()),
    }
}

/// Writes a note to standard error, beside the result on standard output. A closed standard error is no failure.
pub fn print_aside(text: &str) {
    let _ = std::io::stderr().write_all(text.as_bytes());
}

/// The answer of a command in JSON where a solver gave none: its failure, with what else is known of its end, on standard output, or
/// beside it on standard error.
///
/// # Errors
/// Any other error, as it is.
pub fn no_answer(error: Error, ending: impl FnOnce(NoAnswer) -> NoAnswer, aside: bool) -> Result<Answer> {
    let Some(failure) = NoAnswer::of(&error) else { return Err(error) };
    let text = pretty(&ending(failure))?;
    if aside {
        print_aside(&text)
    } else {
        print(&text)?
    }
    Ok(Answer::No)
}

/// Colours for a terminal unless `NO_COLOR` is set to anything, elsewhere where `CLICOLOR_FORCE` asks for them; lines as wide as the
/// terminal, elsewhere as `COLUMNS` says or as [`Style::PLAIN`] has them.
pub fn style() -> Style {
    let colour = AutoStream::choice(&std::io::stdout()) != ColorChoice::Never;
    Style { colour, width: columns().unwrap_or(Style::PLAIN.width) }
}

/// The columns of the terminal that standard output is, or of `COLUMNS`; lines that are too long to follow and too short to hold a word
/// are not made.
fn columns() -> Option<usize> {
    asked_columns().map(|width| width.min(Style::PLAIN.width))
}

/// The columns that there are, where somebody says so.
fn asked_columns() -> Option<usize> {
    let terminal = terminal_size::terminal_size_of(std::io::stdout()).map(|(width, _)| usize::from(width.0));
    let asked = || std::env::var("COLUMNS").ok()?.parse().ok();
    terminal.or_else(asked).filter(|width| *width > 0).map(|width: usize| width.max(NARROWEST))
}

/// A table: rows that are wider than the terminal, or than `COLUMNS`, go on in another line, four columns farther in. Where neither says
/// how wide lines may be, as for `grep`, a row is a line.
pub fn table(text: String) -> String {
    match asked_columns() {
        Some(width) => Style { colour: false, width }.fitted(&text),
        None => text,
    }
}

/// Columns below which lines are not made shorter.
const NARROWEST: usize = 40;
