//! `moreau certify`: judges an answer to a contact problem without knowing where it came from.

mod arguments;
mod folder;
mod one;
mod reading;

pub use arguments::Arguments;

use super::kind::read_problem;
use super::limits::check_tolerance;
use super::output::print;
use super::remarks::remark;
use super::{Answer, progress};
use crate::Result;
use arguments::USAGE;
use one::judged;

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    arguments.common.apply()?;
    check_tolerance("--tolerance", arguments.tolerance)?;
    if arguments.problem.is_dir() {
        return folder::run(arguments);
    }
    let posed = read_problem(&arguments.problem, USAGE)?;
    remark(&arguments.problem, &posed, arguments.common.format);
    let bar = progress::word(if arguments.prove { "proving" } else { "judging" });
    let (text, accepted) = progress::shown(&bar, || judged(arguments, &posed))?;
    print(&text)?;
    Ok(accepted.into())
}
