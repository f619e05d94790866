//! What `moreau solve FOLDER` and `moreau certify FOLDER` found: a line per problem of the folder.

use super::certificate::Certificate;
use super::no_answer::NoAnswer;
use super::quantity::short;
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write;

/// The answers to the problems of a folder.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Answers {
    /// The largest relative residual that is accepted.
    pub tolerance: f64,
    /// One line per problem.
    pub problems: Vec<AnswerLine>,
}

/// One problem and its answer.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct AnswerLine {
    /// The file.
    pub problem: String,
    /// How it ended: that of the certificate; without an answer that of the solver; `bad-input` where a file cannot be used, `no-answer`
    /// where there is no file of an answer.
    #[schemars(extend("enum" =
        ["solved", "rejected", "stalled", "limit", "infeasible", "refused", "breakdown", "ray", "bad-input", "no-answer"]))]
    pub status: &'static str,
    /// Number of contacts, limits and bilateral constraints; absent where the problem cannot be read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contacts: Option<usize>,
    /// Who proposed the answer, or gave none; absent where nobody is named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solver: Option<String>,
    /// The largest residual relative to the scale of its contact; absent where there is no answer, null where it is no number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative: Option<f64>,
    /// Whether the certificate accepts the answer.
    pub solution: bool,
    /// The file of the answer in its folder; absent where there is none, or where it stands in the file of the problem.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub answer: Option<String>,
    /// Whether the same command ends so again; absent where nobody knows, as of an answer in a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reproducible: Option<bool>,
    /// Why there is no answer, what is wrong with a file, or why the problem has no solution.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The status of a problem whose file, or whose answer's file, cannot be used.
const BAD_INPUT: &str = "bad-input";
/// The status of a problem whose answer is not there.
const NO_ANSWER: &str = "no-answer";
/// The status of a problem without solution.
const INFEASIBLE: &str = "infeasible";
/// Columns of the text for the name of a solver.
const WIDEST: usize = 24;

impl AnswerLine {
    /// A problem whose answer is not there.
    pub fn missing(problem: String, contacts: usize, reason: String) -> Self {
        AnswerLine { problem, status: NO_ANSWER, contacts: Some(contacts), reason: Some(reason), ..AnswerLine::default() }
    }

    /// A problem whose answer is not there, because it has no solution, as is proved.
    pub fn infeasible(problem: String, contacts: usize, proof: String) -> Self {
        AnswerLine { problem, status: INFEASIBLE, contacts: Some(contacts), reason: Some(proof), ..AnswerLine::default() }
    }

    /// A problem that cannot be read, or an answer that does not fit it.
    pub fn bad_input(problem: String, contacts: Option<usize>, reason: String) -> Self {
        AnswerLine { problem, status: BAD_INPUT, contacts, reason: Some(reason), ..AnswerLine::default() }
    }

    /// A problem to which a solver gave no answer, for this reason.
    pub fn without_answer(problem: String, contacts: usize, failure: &NoAnswer, reason: String) -> Self {
        let solver = Some(failure.solver().into());
        let (status, reproducible) = (failure.status(), failure.reproducible());
        AnswerLine { problem, status, contacts: Some(contacts), solver, reproducible, reason: Some(reason), ..AnswerLine::default() }
    }

    /// A problem with the certificate of its answer.
    pub fn answered(problem: String, contacts: usize, certificate: &Certificate, relative: f64) -> Self {
        let solver = Some(certificate.solver().to_string()).filter(|solver| !solver.is_empty());
        AnswerLine {
            problem,
            status: certificate.status(),
            contacts: Some(contacts),
            solver,
            relative: Some(relative),
            solution: certificate.accepts(),
            answer: None,
            reproducible: certificate.reproducible(),
            reason: certificate.no_solution().map(str::to_string),
        }
    }

    /// Who proposed the answer, in the column of the text: an answer by hand may name a whole sentence.
    fn shown_solver(&self) -> String {
        match self.solver.as_deref().unwrap_or("-") {
            long if long.chars().count() > WIDEST => long.chars().take(WIDEST - 1).chain(['…']).collect(),
            short => short.into(),
        }
    }

    /// The end of its line.
    fn end(&self) -> String {
        match (self.solution, self.status, &self.reason) {
            (true, ..) => "solved".into(),
            (false, INFEASIBLE, _) => "not solved: no solution, as is proved".into(),
            (false, BAD_INPUT | NO_ANSWER, Some(reason)) => reason.clone(),
            (false, status, None) => format!("not solved: {status}"),
            (false, _, Some(reason)) => format!("not solved: {reason}"),
        }
    }
}

impl Answers {
    /// How many problems cannot be used.
    pub fn refused(&self) -> usize {
        self.count(BAD_INPUT)
    }

    /// How many answers are not there.
    pub fn missing(&self) -> usize {
        self.count(NO_ANSWER)
    }

    fn count(&self, status: &str) -> usize {
        self.problems.iter().filter(|line| line.status == status).count()
    }

    /// Whether every answer is accepted.
    pub fn all_solved(&self) -> bool {
        self.problems.iter().all(|line| line.solution)
    }

    /// For reading.
    pub fn text(&self) -> String {
        let longest = |heading: &str, of: fn(&AnswerLine) -> String| {
            self.problems.iter().map(|line| of(line).chars().count()).chain([heading.len()]).max().unwrap_or(0)
        };
        let width = longest("problem", |line| line.problem.clone());
        let solvers = longest("solver", AnswerLine::shown_solver);
        let mut text = format!("{:width$} {:>8} {:solvers$} {:>10}\n", "problem", "contacts", "solver", "residual");
        for line in &self.problems {
            let contacts = line.contacts.map_or("-".into(), |contacts| contacts.to_string());
            let relative = line.relative.map_or("-".into(), short);
            let (problem, solver, end) = (&line.problem, line.shown_solver(), line.end());
            let _ = writeln!(text, "{problem:width$} {contacts:>8} {solver:solvers$} {relative:>10}  {end}");
        }
        let solved = self.problems.iter().filter(|line| line.solution).count();
        let _ = write!(text, "{solved} of {} solved", self.problems.len());
        for (count, what) in [(self.missing(), "without answer"), (self.refused(), "cannot be used")] {
            let _ = if count > 0 { write!(text, ", {count} {what}") } else { Ok(()) };
        }
        text.push('\n');
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;

    #[test]
    fn every_problem_has_its_line_and_the_last_one_counts() {
        let solved = AnswerLine { problem: "a.json".into(), status: "solved", contacts: Some(3), solution: true, ..Default::default() };
        let solved = AnswerLine { solver: Some("auto".into()), relative: Some(1.5e-9), ..solved };
        let ray = Error::ray("lemke", "ended on a ray");
        let none = AnswerLine::without_answer("long.json".into(), 2, &NoAnswer::of(&ray).unwrap(), "ended on a ray".into());
        let bad = AnswerLine::bad_input("c.dat".into(), None, "cannot be read: no such file".into());
        let answers = Answers { tolerance: 1e-8, problems: vec![solved.clone(), none, bad] };
        let lines = [
            "problem   contacts solver   residual",
            "a.json           3 auto       1.5e-9  solved",
            "long.json        2 lemke           -  not solved: ended on a ray",
            "c.dat            - -               -  cannot be read: no such file",
            "1 of 3 solved, 1 cannot be used",
        ];
        assert_eq!(answers.text().lines().collect::<Vec<_>>(), lines);
        assert!(!answers.all_solved() && answers.refused() == 1);
        let by_hand = AnswerLine { solver: Some("written down by hand, µ times it".into()), ..solved.clone() };
        assert!(Answers { tolerance: 1e-8, problems: vec![by_hand] }.text().contains(" written down by hand, µ…     1.5e-9  solved"));
        let alone = Answers { tolerance: 1e-8, problems: vec![solved] };
        assert!(alone.all_solved() && alone.refused() == 0 && alone.text().ends_with("1 of 1 solved\n"));
    }
}
