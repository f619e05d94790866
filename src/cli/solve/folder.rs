//! Every problem of a folder: solved as a file alone is, with the answers in another folder.

use super::super::Answer;
use super::super::posed;
use super::super::progress;
use super::super::remarks::remark;
use super::super::several;
use super::arguments::Arguments;
use super::one::{Outcome, solved};
use crate::files::{is_same_file, write_atomically};
use crate::problem::Posed;
use crate::report::answers::{AnswerLine, Answers};
use crate::report::no_answer::NoAnswer;
use crate::solvers::ContactSolver;
use crate::{Error, Result};
use indicatif::ProgressBar;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Solves the problems of the folder that is asked for.
///
/// # Errors
/// What is wrong with the arguments or the folders; what is wrong with a problem, or with writing its answer, is its line.
pub fn run(arguments: &Arguments, solver: &dyn ContactSolver) -> Result<Answer> {
    let out = folder_of_answers(arguments)?;
    let problems = several::in_folder(&arguments.problem, "PROBLEM")?;
    keep_apart(arguments, out, &problems)?;
    several::make_folder("--out", out)?;
    let bar = progress::parts(problems.len(), "problems");
    let one = |problem: &PathBuf| line(arguments, solver, [problem, &several::answer_in(out, problem)], &bar);
    let problems = progress::shown(&bar, || problems.iter().map(one).collect::<Result<_>>())?;
    several::show(&Answers { tolerance: arguments.tolerance.accepted(), problems }, arguments.common.format)
}

/// The folder that --out names, once nothing is asked that is for one problem.
fn folder_of_answers(arguments: &Arguments) -> Result<&Path> {
    let folder = arguments.problem.display();
    for (option, given) in [("--start", arguments.start.is_some()), ("--history", arguments.history)] {
        if given {
            return Err(Error::invalid(
                option,
                format!("is for one problem, and {folder} is a folder"),
                "leave it out, or give a file in it",
            ));
        }
    }
    arguments.out.as_deref().ok_or_else(|| {
        let problem = format!("is missing, and {folder} is a folder of problems");
        Error::invalid("--out", problem, format!("name a folder for the answers: moreau solve {folder} --out answers/"))
    })
}

/// Refuses answers that would be written over each other or over a problem.
fn keep_apart(arguments: &Arguments, out: &Path, problems: &[PathBuf]) -> Result<()> {
    let refused = |problem: String, cure: &str| Err(Error::invalid("PROBLEM", problem, cure));
    let among_problems = is_same_file(&arguments.problem, out);
    let names: BTreeSet<String> = problems.iter().map(|problem| several::name(problem)).collect();
    let mut owners: BTreeMap<String, String> = BTreeMap::new();
    for own in problems {
        let (own, answer) = (several::name(own), several::name(&several::answer_in(out, own)));
        if among_problems && names.contains(&answer) {
            let problem = format!("holds {answer}, over which the answer of {own} would be written");
            return refused(problem, "rename one of the files, or name another folder for --out");
        }
        if let Some(other) = owners.insert(answer.clone(), own.clone()) {
            return refused(format!("holds {other} and {own}, whose answers would both be {answer}"), "rename one of the files");
        }
    }
    Ok(())
}

/// One problem: its answer is written.
fn line(arguments: &Arguments, solver: &dyn ContactSolver, [file, answer]: [&Path; 2], bar: &ProgressBar) -> Result<AnswerLine> {
    let name = several::name(file);
    bar.set_message(format!(", {name}"));
    let found = match Posed::read(file).and_then(|posed| arguments.law.pose(posed)) {
        Ok(problem) => {
            bar.suspend(|| remark(file, &problem, arguments.common.format));
            let contacts = posed::constraints(&problem);
            told(solved(arguments, solver, file, problem, None), (name, contacts), arguments, answer)
        }
        Err(error) => Ok(AnswerLine::bad_input(name, None, several::reason(&error))),
    };
    bar.inc(1);
    found
}

/// What became of it.
fn told(outcome: Result<Outcome>, (name, contacts): (String, usize), arguments: &Arguments, file: &Path) -> Result<AnswerLine> {
    match outcome {
        Ok(Outcome::Answer(answered)) => {
            let certificate = answered.certificate(arguments.tolerance.accepted());
            if let Err(error) = write_atomically(file, answered.written()?.as_bytes()) {
                return Ok(AnswerLine::bad_input(name, Some(contacts), several::reason(&error)));
            }
            let line = AnswerLine::answered(name, contacts, &certificate, answered.relative());
            Ok(AnswerLine { answer: Some(several::name(file)), ..line })
        }
        Ok(Outcome::None { error, proof, interrupted }) => Ok(match NoAnswer::of(&error) {
            Some(failure) => {
                let reason = proof.clone().unwrap_or_else(|| several::reason(&error));
                AnswerLine::without_answer(name, contacts, &failure.with_proof(proof).ended_by_time(interrupted), reason)
            }
            None => AnswerLine::bad_input(name, Some(contacts), several::reason(&error)),
        }),
        Err(error) => Ok(AnswerLine::bad_input(name, Some(contacts), several::reason(&error))),
    }
}
