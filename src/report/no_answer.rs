//! What JSON says where a solver gave no answer: the same as the message, in parts.

use crate::Error;
use schemars::JsonSchema;
use serde::Serialize;

/// A solver that ended without an answer.
#[derive(Debug, PartialEq, Serialize, JsonSchema)]
pub struct NoAnswer<'a> {
    /// How it ended.
    #[schemars(extend("enum" = ["refused", "breakdown", "ray", "limit", "infeasible"]))]
    status: &'static str,
    /// Its name.
    solver: &'a str,
    /// Why there is no answer, in words.
    reason: &'a str,
    /// Why the problem has no solution, where that is proved.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_solution: Option<String>,
    /// False where the time limit ended it, for another run may give an answer; absent elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    reproducible: Option<bool>,
}

impl<'a> NoAnswer<'a> {
    /// The solver's failure in an error, or in the error of a file; `None` for any other error.
    pub fn of(error: &'a Error) -> Option<Self> {
        match error {
            Error::Solver { solver, failure, reason } => {
                Some(NoAnswer { status: failure.name(), solver, reason, no_solution: None, reproducible: None })
            }
            Error::InFile { inner, .. } => NoAnswer::of(inner),
            _ => None,
        }
    }

    /// How it ended.
    pub fn status(&self) -> &'static str {
        self.status
    }

    /// The name of the solver.
    pub fn solver(&self) -> &'a str {
        self.solver
    }

    /// Whether the same command ends so again, where somebody knows that it need not.
    pub fn reproducible(&self) -> Option<bool> {
        self.reproducible
    }

    /// The same, of a solver that the time limit ended or did not.
    pub fn ended_by_time(self, ended: bool) -> Self {
        NoAnswer { reproducible: ended.then_some(false), ..self }
    }

    /// The same with a proof that the problem has no solution.
    pub fn with_proof(self, no_solution: Option<String>) -> Self {
        let status = if no_solution.is_some() { "infeasible" } else { self.status };
        NoAnswer { status, no_solution, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn only_a_solver_s_failure_is_an_answer_that_there_is_none() {
        let ray = Error::ray("lemke", "ended").in_file(Path::new("p.json"));
        let told = NoAnswer { status: "ray", solver: "lemke", reason: "ended", no_solution: None, reproducible: None };
        assert_eq!(NoAnswer::of(&ray), Some(told));
        assert_eq!(NoAnswer::of(&Error::invalid("mass", "is negative", "use a positive number")), None);
    }
}
