//! Several problems in one command: the files of a folder, and what becomes of those that cannot be read.

use super::kind::advice;
use super::output::{print, print_aside, table};
use super::{Answer, Format};
use crate::number::counted;
use crate::report::answers::Answers;
use crate::report::json::pretty;
use crate::{Error, Result};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The ends of files that hold problems.
const ENDS: [&str; 4] = ["json", "dat", "hdf5", "h5"];

/// The files given, and those of problems in the folders given, in order.
///
/// # Errors
/// [`Error::Read`] of a folder, and [`Error::Invalid`] of one without problems.
pub fn files(given: &[PathBuf]) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for path in given {
        if path.is_dir() {
            found.extend(in_folder(path, "PROBLEMS")?);
        } else {
            found.push(path.clone());
        }
    }
    Ok(found)
}

/// The files of problems in a folder, in order; `argument` is what named the folder.
///
/// # Errors
/// [`Error::Read`], and [`Error::Invalid`] where there are none.
pub fn in_folder(folder: &Path, argument: &str) -> Result<Vec<PathBuf>> {
    let failed = |source| Error::Read { file: folder.into(), source };
    let entries: Vec<PathBuf> = std::fs::read_dir(folder)
        .map_err(failed)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<std::io::Result<_>>()
        .map_err(failed)?;
    let ends = |file: &Path| file.extension().is_some_and(|end| ENDS.iter().any(|known| end == *known));
    // pipes and folders are no files of problems; a link that leads nowhere is told as one that cannot be read
    let is_one = |file: &Path| std::fs::metadata(file).map_or(true, |found| found.is_file());
    let mut problems: Vec<PathBuf> = entries.into_iter().filter(|file| ends(file) && is_one(file) && !is_answer(file)).collect();
    if problems.is_empty() {
        let cure = format!("give a folder with files that end in {}", ENDS.join(", "));
        return Err(Error::invalid(argument, format!("has none in the folder {}", folder.display()), cure));
    }
    problems.sort();
    Ok(problems)
}

/// Whether a file of a folder is an answer, as `moreau problems export` puts beside its problem.
fn is_answer(file: &Path) -> bool {
    #[derive(serde::Deserialize)]
    struct Head {
        schema: Option<String>,
    }
    let text = || std::fs::read_to_string(file).ok();
    let head = || serde_json::from_str::<Head>(&text()?).ok();
    file.extension().is_some_and(|end| end == "json") && head().is_some_and(|head| head.schema.as_deref() == Some("solution/1"))
}

/// Two of these files that have one name in different folders; what is named by them would be written twice.
pub fn twice(files: &[PathBuf]) -> Option<[&PathBuf; 2]> {
    let mut owners = BTreeMap::new();
    files.iter().find_map(|file| owners.insert(name(file), file).map(|other| [other, file]))
}

/// The name of a file without its folder.
pub fn name(file: &Path) -> String {
    file.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// The file of a problem's answer in a folder of answers: NAME.solution.json for NAME.json, NAME.dat, NAME.hdf5 or NAME.h5.
pub fn answer_in(folder: &Path, problem: &Path) -> PathBuf {
    folder.join(format!("{}.solution.json", problem.file_stem().unwrap_or_default().to_string_lossy()))
}

/// Makes the folder that answers are written into, where it is not there.
///
/// # Errors
/// [`Error::Invalid`] names the option where a file stands in its place, [`Error::Write`] tells any other failure.
pub fn make_folder(option: &str, folder: &Path) -> Result<()> {
    refuse_file(option, folder)?;
    std::fs::create_dir_all(folder).map_err(|source| Error::Write { file: folder.into(), source })
}

/// Refuses a folder that cannot be made, for a file stands in its place or in that of a folder around it.
///
/// # Errors
/// [`Error::Invalid`] names the option.
pub fn refuse_file(option: &str, folder: &Path) -> Result<()> {
    let cure = "name a folder, which is made if it is not there";
    match folder.ancestors().find(|place| place.exists()) {
        Some(file) if !file.is_dir() && file == folder => {
            Err(Error::invalid(option, format!("is {}, which is a file", folder.display()), cure))
        }
        Some(file) if !file.is_dir() => {
            Err(Error::invalid(option, format!("is {}, and {} is a file", folder.display(), file.display()), cure))
        }
        _ => Ok(()),
    }
}

/// Refuses a folder that is not there, of a command that makes none.
///
/// # Errors
/// [`Error::Invalid`] names the option.
pub fn require_folder(option: &str, folder: &Path) -> Result<()> {
    let (found, cure) = match (folder.is_dir(), folder.exists()) {
        (true, _) => return Ok(()),
        (false, true) => ("which is a file", "name a folder"),
        (false, false) => ("which is not there", "make the folder, or name another one"),
    };
    Err(Error::invalid(option, format!("is {}, {found}", folder.display()), cure))
}

/// What an error says where its file is named beside it, and which command takes that file, if it is of another kind.
pub fn reason(error: &Error) -> String {
    without_file(error) + &advice(error).map_or(String::new(), |advice| format!("; {advice}"))
}

fn without_file(error: &Error) -> String {
    match error {
        Error::InFile { inner, .. } => without_file(inner),
        Error::Read { .. } => format!("cannot be read: {}", error.cause().unwrap_or_default()),
        other => other.to_string(),
    }
}

/// Tells on standard error that some of the problems are bad input.
pub fn tell_refused(refused: usize, problems: usize) {
    let problems = counted(problems, "problem");
    print_aside(&format!("error: {refused} of {problems} cannot be used; the result says why of each, and has the others\n"));
}

/// Prints the answers of a folder; the code is the worst of its problems.
///
/// # Errors
/// [`Error::Write`].
pub fn show(answers: &Answers, format: Format) -> Result<Answer> {
    print(&match format {
        Format::Text => table(answers.text()),
        Format::Json => pretty(answers)?,
    })?;
    if answers.missing() > 0 {
        print_aside(&format!(
            "error: {} of {} have no answer; the result says where it is looked for\n",
            answers.missing(),
            counted(answers.problems.len(), "problem")
        ));
    }
    if answers.refused() > 0 {
        tell_refused(answers.refused(), answers.problems.len());
    }
    if answers.missing() + answers.refused() > 0 {
        return Ok(Answer::BadInput);
    }
    Ok(answers.all_solved().into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reason_does_not_name_the_file_again() {
        let file = Path::new("folder/p.json");
        let invalid = || Error::invalid("mass", "is negative", "use a positive number");
        assert_eq!(reason(&invalid().in_file(file)), invalid().to_string());
        let source = std::io::ErrorKind::NotFound.into();
        let text = reason(&Error::Read { file: file.into(), source });
        assert!(text.starts_with("cannot be read: ") && !text.contains("p.json"), "{text}");
    }
}
