//! Checks of a solver: its answer is certified, from any start and in any order of the contacts.

use super::accepts::accepts;
use super::posed::{self, Posed};
use crate::finding::Finding;
use moreau_contact::problem::{Compliance, ContactProblem, Solution};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// A solver: an answer to a problem, begun from given impulses.
pub type Answers = fn(&ContactProblem, &DVector<f64>) -> Result<Solution>;

/// The problems with a law on second-order cones, which every solver of the friction law is asked.
fn problems() -> Result<Vec<Posed>> {
    Ok(posed::all()?.into_iter().filter(|one| one.problem.law().directions().is_none()).collect())
}

/// The answer begun from zero is certified: one finding per problem.
///
/// # Errors
/// Those of the solver.
pub fn certified(subject: &Answers) -> Result<Vec<Finding>> {
    from(subject, |posed| posed.impulse.map(|_| 0.0))
}

/// The answer begun from impulses of another step is certified as well: one finding per problem.
///
/// # Errors
/// Those of the solver.
pub fn forgets_its_start(subject: &Answers) -> Result<Vec<Finding>> {
    from(subject, |posed| {
        let rows = posed.problem.rows_per_contact();
        DVector::from_fn(posed.problem.rows(), |i, _| if i % rows == 0 { 3.0 } else { -0.25 })
    })
}

fn from(subject: &Answers, start: impl Fn(&Posed) -> DVector<f64>) -> Result<Vec<Finding>> {
    let one = |posed: &Posed| {
        let answer = subject(&posed.problem, &start(posed))?;
        Ok(Finding::decision(posed.name, accepts(&posed.problem, &answer)?, true))
    };
    problems()?.iter().map(one).collect()
}

/// The answer to the problem with its contacts in reverse order, numbered back, is certified: one finding per problem.
///
/// # Errors
/// Those of the solver.
pub fn in_any_order(subject: &Answers) -> Result<Vec<Finding>> {
    let one = |posed: &Posed| {
        let problem = &posed.problem;
        let answer = subject(&reversed(problem)?, &DVector::zeros(problem.rows()))?;
        let back = |vector: &DVector<f64>| permuted(problem, vector);
        let answer = Solution::new(answer.solver.clone(), back(&answer.impulse), back(&answer.velocity), answer.iterations);
        Ok(Finding::decision(posed.name, accepts(problem, &answer)?, true))
    };
    problems()?.iter().map(one).collect()
}

/// Row i of the reversed problem is this row of the given one.
fn row(problem: &ContactProblem, i: usize) -> usize {
    let rows = problem.rows_per_contact();
    (problem.contacts() - 1 - i / rows) * rows + i % rows
}

fn permuted(problem: &ContactProblem, vector: &DVector<f64>) -> DVector<f64> {
    DVector::from_fn(vector.len(), |i, _| vector[row(problem, i)])
}

/// The problem with its contacts in reverse order.
fn reversed(problem: &ContactProblem) -> Result<ContactProblem> {
    let delassus = DMatrix::from_fn(problem.rows(), problem.rows(), |i, j| problem.entry(row(problem, i), row(problem, j)));
    let softness = DVector::from_fn(problem.rows(), |i, _| problem.row_compliance(row(problem, i)));
    let compliance = problem.compliance().map(|soft| Compliance { diagonal: softness, ..soft.clone() });
    ContactProblem::new(delassus, permuted(problem, problem.free_velocity()))
        .name(problem.name())
        .law(problem.law())
        .rows_per_contact(problem.rows_per_contact())
        .friction(problem.friction().iter().rev().copied().collect())
        .shift(permuted(problem, problem.shift()))
        .compliance(compliance)
        .build()
}
