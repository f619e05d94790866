//! Every problem of a folder: judged with its answer as a file alone is.

use super::super::remarks::remark;
use super::super::{Answer, posed, progress, several};
use super::arguments::Arguments;
use super::reading::{holds_answer, read_answer};
use crate::problem::Posed;
use crate::report::answers::{AnswerLine, Answers};
use crate::{Error, Result};
use indicatif::ProgressBar;
use std::path::{Path, PathBuf};

/// Judges the answers to the problems of the folder that is asked for.
///
/// # Errors
/// What is wrong with the arguments or the folders; what is wrong with a problem or its answer is its line.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    let folder = &arguments.problem;
    if arguments.prove {
        let problem = format!("is for one problem, and {} is a folder", folder.display());
        return Err(Error::invalid("--prove", problem, "leave it out, or give a file in it"));
    }
    let answers = arguments.solution.as_deref().unwrap_or(folder);
    if !answers.is_dir() {
        let problem = format!("is {}, which is no folder, and {} is a folder of problems", answers.display(), folder.display());
        return Err(Error::invalid("SOLUTION", problem, "give the folder of their answers NAME.solution.json"));
    }
    let problems = several::in_folder(folder, "PROBLEM")?;
    let bar = progress::parts(problems.len(), "problems");
    let one = |problem: &PathBuf| line(arguments, problem, answers, &bar);
    let problems = progress::shown(&bar, || problems.iter().map(one).collect());
    several::show(&Answers { tolerance: arguments.tolerance, problems }, arguments.common.format)
}

/// One problem with its answer.
fn line(arguments: &Arguments, file: &Path, answers: &Path, bar: &ProgressBar) -> AnswerLine {
    let name = several::name(file);
    bar.set_message(format!(", {name}"));
    let line = match Posed::read(file) {
        Ok(problem) => {
            bar.suspend(|| remark(file, &problem, arguments.common.format));
            let contacts = posed::constraints(&problem);
            let judged = judged(arguments, file, &several::answer_in(answers, file), &problem);
            judged.unwrap_or_else(|reason| AnswerLine::bad_input(name, Some(contacts), reason))
        }
        Err(error) => AnswerLine::bad_input(name, None, several::reason(&error)),
    };
    bar.inc(1);
    line
}

/// The certificate of the answer in a line, or what is wrong with the answer.
fn judged(arguments: &Arguments, file: &Path, answer: &Path, problem: &Posed) -> std::result::Result<AnswerLine, String> {
    let own = answer.is_file().then_some(answer);
    if own.is_none() && (arguments.solution.is_some() || !holds_answer(file)) {
        return Ok(without_answer(file, answer, problem));
    }
    let named = |error: Error| own.map_or(String::new(), |own| format!("{}: ", several::name(own))) + &several::reason(&error);
    let (_, solution) = read_answer(file, own, problem).map_err(named)?;
    let residuals = posed::judge(problem, &solution).map_err(named)?;
    let certificate = posed::doubted(posed::certificate(problem, &solution, residuals, arguments.tolerance), problem, &residuals);
    let line = AnswerLine::answered(several::name(file), posed::constraints(problem), &certificate, residuals.relative());
    Ok(AnswerLine { answer: own.map(several::name), ..line })
}

/// The line of a problem whose answer is not there: how to make it, unless it is proved that there is none.
fn without_answer(file: &Path, answer: &Path, problem: &Posed) -> AnswerLine {
    let (name, contacts) = (several::name(file), posed::constraints(problem));
    if let Some(proof) = posed::refuted(problem) {
        return AnswerLine::infeasible(name, contacts, proof);
    }
    let (answer, file) = (answer.display(), file.display());
    AnswerLine::missing(name, contacts, format!("has no answer: there is no {answer}; `moreau solve {file} --out {answer}` looks for it"))
}
