//! How good an answer to a contact problem is: residuals with units, and whether they are small enough.

use crate::certificate::{Residuals, Worst};
use crate::number::{significant, with_unit};
use crate::problem::{ContactProblem, Solution};
use serde::Serialize;
use std::fmt::Write;

/// The certificate of one answer.
#[derive(Serialize)]
pub struct Certificate<'a> {
    /// `solved` or `rejected`.
    status: &'static str,
    problem: &'a str,
    law: &'static str,
    contacts: usize,
    solver: &'a str,
    iterations: usize,
    residuals: &'a Residuals,
    tolerance: f64,
    solution: bool,
}

impl<'a> Certificate<'a> {
    /// Holds the residuals against a tolerance relative to the scales of their units.
    pub fn new(problem: &'a ContactProblem, solution: &'a Solution, residuals: &'a Residuals, tolerance: f64) -> Self {
        let solution_found = residuals.is_solution(tolerance);
        Certificate {
            status: if solution_found { "solved" } else { "rejected" },
            problem: problem.name(),
            law: problem.law().name(),
            contacts: problem.contacts(),
            solver: &solution.solver,
            iterations: solution.iterations,
            residuals,
            tolerance,
            solution: solution_found,
        }
    }

    /// Whether the answer is a solution.
    pub fn accepts(&self) -> bool {
        self.solution
    }

    /// The certificate for readers.
    pub fn text(&self) -> String {
        let solver = if self.solver.is_empty() { "not named" } else { self.solver };
        let mut text = format!("problem `{}`, law {}, contacts: {}\n", self.problem, self.law, self.contacts);
        let mut line = |content: String| writeln!(text, "{content}").expect("writing to a String cannot fail");
        line(format!("solver {solver}, iterations: {}", self.iterations));
        for (name, Worst { part, contact, .. }, unit) in self.residuals.judged.entries() {
            let [relative, limit] = [part.relative(), part.limit(self.tolerance)].map(significant);
            let value = with_unit(&significant(part.value), unit);
            line(format!("  {name:18} {value:16} relative {relative:10} limit {:16} contact {contact}", with_unit(&limit, unit)));
        }
        line("norms over all contacts, shown for comparison only:".into());
        for (name, value, unit) in self.residuals.norms() {
            line(format!("  {name:18} {}", with_unit(&significant(value), unit)));
        }
        let verdict = if self.solution { "a solution" } else { "NOT a solution" };
        line(format!("{verdict} to the relative tolerance {}", significant(self.tolerance)));
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::problem::Law;
    use nalgebra::{dmatrix, dvector};

    /// A mass of 1 kg that arrives at 1 m/s; the impulse 1 N·s stops it.
    fn certificate(impulse: f64) -> (String, bool) {
        let problem =
            ContactProblem::new(dmatrix![1.0], dvector![-1.0]).name("stop").law(Law::Frictionless).rows_per_contact(1).build().unwrap();
        let impulse = dvector![impulse];
        let velocity = problem.velocity(&impulse);
        let solution = Solution::new("", impulse, velocity, 0);
        let residuals = residuals(&problem, &solution).expect("sizes fit");
        let certificate = Certificate::new(&problem, &solution, &residuals, 0.25);
        (certificate.text(), certificate.accepts())
    }

    #[test]
    fn residuals_carry_units_and_the_verdict_is_the_last_line() {
        let (text, accepted) = certificate(1.0);
        assert!(accepted && text.ends_with("\na solution to the relative tolerance 0.25\n"), "{text}");
        assert!(text.contains("primal             0 N·s") && text.contains("complementarity    0 J"), "{text}");
    }

    #[test]
    fn a_pull_is_no_solution() {
        let (text, accepted) = certificate(-1.0);
        assert!(!accepted && text.ends_with("NOT a solution to the relative tolerance 0.25\n"), "{text}");
    }
}
