//! `--start`: the impulses of an earlier answer, by the keys of the contacts where both have them.

use super::super::Format;
use super::super::output::print_aside;
use super::arguments::Arguments;
use crate::number::counted;
use crate::problem::{Posed, WarmStart};
use crate::solvers::ContactSolver;
use crate::{Error, Result};
use nalgebra::DVector;
use std::path::Path;

/// The impulses to begin from; how many contacts have one by their keys is told on standard error, unless that holds JSON.
///
/// # Errors
/// If the solver takes no start, and those of [`WarmStart::read`].
pub fn read(arguments: &Arguments, solver: &dyn ContactSolver, file: &Path, problem: &Posed) -> Result<DVector<f64>> {
    if !solver.takes_start() {
        let problem = format!("does nothing with `{}`, which has a start of its own", solver.name());
        return Err(Error::invalid("--start", problem, "leave it out, or ask `auto`, which takes one"));
    }
    let start = WarmStart::read(file, problem)?;
    let is_json = arguments.common.format == Format::Json && arguments.out.is_none();
    if let (Some(matched), Posed::Contacts(contacts), false) = (start.matched, problem, is_json) {
        let all = contacts.contacts();
        let file = file.display();
        print_aside(&format!(
            "remark: {file}: start by keys: {matched} of {} matched, {} begin at zero\n",
            counted(all, "contact"),
            all - matched
        ));
    }
    Ok(start.impulse)
}
