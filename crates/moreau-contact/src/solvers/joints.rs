//! Joints: their rows are eliminated, any solver solves what is left of the contacts, and the impulses of the joints follow.
//!
//! ```text
//!     y_b = W_bb r_b + W_bu r_u + q_b = 0   ⟹   r_b = −W_bb⁻¹ (W_bu r_u + q_b)
//!     Ŵ = W_uu − W_ub W_bb⁻¹ W_bu ,      q̂ = q_u − W_ub W_bb⁻¹ q_b
//! ```
//! with R in W_bb and the shift in q_b. Rows are eliminated one by one, each time the one that keeps the largest part of its W_ii; a
//! symmetric W stays symmetric to the last bit. A row of which nothing is left repeats others: its impulse is 0 if its velocity agrees with
//! theirs. A row of which nearly nothing is left is refused, for nobody can tell whether it repeats them.

use super::ContactSolver;
use super::joints_exactly::{self as exactly, Decided};
use crate::certificate::joints::jointed_residuals;
use crate::problem::{ContactProblem, JointedProblem, MOST_ROWS, Solution};
use crate::tolerance::certificate::CERTIFY;
use crate::tolerance::joints::{AGREES, DEPENDENT, INDEPENDENT};
use moreau_exact::error::Failure;
use moreau_exact::number::significant;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// A row that was eliminated: r_row = −(velocity + Σ coefficient_j r_j)/pivot over the rows that stood beside it.
#[derive(Clone, Debug, PartialEq)]
struct Eliminated {
    row: usize,
    pivot: f64,
    velocity: f64,
    coefficients: Vec<(usize, f64)>,
}

/// What is left of a problem once its joints are eliminated.
#[derive(Clone, Debug, PartialEq)]
pub struct WithoutJoints {
    contacts: ContactProblem,
    eliminated: Vec<Eliminated>,
    dependent: Vec<usize>,
    /// What the velocity of every row was summed from, without signs.
    terms: DVector<f64>,
}

impl WithoutJoints {
    /// Eliminates the bilateral rows.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the constraint whose rows contradict others, nearly depend on others, or have no positive definite W.
    pub fn new(problem: &JointedProblem) -> Result<Self> {
        let mut system = System::new(problem);
        let mut eliminated = Vec::new();
        while let Some(row) = system.next() {
            system.require_independent(row)?;
            eliminated.push(system.eliminate(row));
        }
        let dependent = std::mem::take(&mut system.left);
        dependent.iter().try_for_each(|row| system.require_agreement(*row))?;
        system.clear_fixed();
        let contacts = problem.unilateral(&system.matrix, &(&system.velocity - problem.shifts()))?;
        Ok(WithoutJoints { contacts, eliminated, dependent, terms: system.terms })
    }

    /// The same where velocities are zero that are rounding beside their terms; none where there are none.
    fn at_rest(&self, problem: &JointedProblem) -> Option<Self> {
        let terms = problem.spread(&self.terms);
        let given = self.contacts.free_velocity() + self.contacts.shift();
        let is_rounding = |row: usize| given[row] != 0.0 && given[row].abs() <= DEPENDENT * terms[row];
        if !(0..given.len()).any(is_rounding) {
            return None;
        }
        let own = |row: usize| if is_rounding(row) { -self.contacts.shift()[row] } else { self.contacts.free_velocity()[row] };
        let contacts = with_velocity(&self.contacts, DVector::from_fn(given.len(), |row, _| own(row)))?;
        Some(WithoutJoints { contacts, ..self.clone() })
    }

    /// The contacts and limits: Ŵ, and q̂ without the shift.
    pub fn contacts(&self) -> &ContactProblem {
        &self.contacts
    }

    /// The rows that repeat others; their impulses are 0.
    pub fn dependent(&self) -> &[usize] {
        &self.dependent
    }

    /// Completes impulses \[N·s\] whose contacts and limits are known.
    pub fn complete(&self, impulse: &mut DVector<f64>) {
        self.dependent.iter().for_each(|row| impulse[*row] = 0.0);
        for Eliminated { row, pivot, velocity, coefficients } in self.eliminated.iter().rev() {
            let sum: f64 = coefficients.iter().map(|(other, coefficient)| coefficient * impulse[*other]).sum();
            impulse[*row] = -(velocity + sum) / pivot;
        }
    }
}

/// W and q while rows are eliminated.
struct System<'a> {
    problem: &'a JointedProblem,
    matrix: DMatrix<f64>,
    velocity: DVector<f64>,
    /// W_ii + R_ii as it was given.
    given: DVector<f64>,
    /// What each velocity was summed from, without signs.
    terms: DVector<f64>,
    /// The bilateral rows that are not eliminated.
    left: Vec<usize>,
    /// All rows that are not eliminated.
    standing: Vec<usize>,
}

impl<'a> System<'a> {
    fn new(problem: &'a JointedProblem) -> Self {
        let mut matrix = problem.delassus().clone();
        let left: Vec<usize> = problem.bilateral().into_iter().flat_map(|k| problem.rows_of(k)).collect();
        left.iter().for_each(|row| matrix[(*row, *row)] += problem.softnesses()[*row]);
        let velocity = problem.free_velocity() + problem.shifts();
        let (given, terms) = (matrix.diagonal(), problem.free_velocity().abs() + problem.shifts().abs());
        System { problem, matrix, velocity, given, terms, left, standing: (0..problem.rows()).collect() }
    }

    /// The part of W_ii that is left of a row.
    fn kept(&self, row: usize) -> f64 {
        if self.given[row] > 0.0 { self.matrix[(row, row)] / self.given[row] } else { 0.0 }
    }

    /// The row to eliminate next; none where every other one depends on those before.
    fn next(&self) -> Option<usize> {
        let best = self.left.iter().copied().reduce(|best, row| if self.kept(row) > self.kept(best) { row } else { best })?;
        (self.kept(best) > DEPENDENT).then_some(best)
    }

    fn require_independent(&self, row: usize) -> Result<()> {
        if self.kept(row) >= INDEPENDENT {
            return Ok(());
        }
        let problem = format!("nearly depends on other bilateral rows: {:.1e} of its W_ii is left, which may be rounding", self.kept(row));
        Err(self.invalid(row, problem, "leave the constraint out, or make it differ from the others"))
    }

    /// A row of which no diagonal entry is left moves nothing, and its velocity is that of the others.
    fn require_agreement(&self, row: usize) -> Result<()> {
        if self.moves_something(row) {
            let problem = "moves other rows although nothing is left of its W_ii, by rounded numbers".to_string();
            return Err(self.invalid(row, problem, "make W positive semidefinite; or, where masses differ by 2⁴⁰ and more, by less"));
        }
        if self.velocity[row].abs() <= AGREES * self.terms[row] {
            return Ok(());
        }
        let size = significant(self.velocity[row].abs());
        if self.given[row] == 0.0 {
            let asked = format!("no impulse of its own moves, and that has the velocity {size} m/s");
            return Err(self.invalid(row, asked, "leave the constraint out, or let something move in its direction"));
        }
        let asked = format!("depends on other bilateral rows and contradicts them by {size} m/s, both by rounded numbers");
        let cure =
            "leave one of the constraints out, or make `free_velocity` and `shift` agree; where masses differ by 2⁴⁰ and more, by less";
        Err(self.invalid(row, asked, cure))
    }

    /// Whether what is left of a row or column is more than rounding.
    fn moves_something(&self, row: usize) -> bool {
        let size = |other: usize| AGREES * (self.given[row] * self.given[other]).abs().sqrt();
        let entry = |other: usize| self.matrix[(row, other)].abs().max(self.matrix[(other, row)].abs());
        self.kept(row) < -DEPENDENT || self.standing.iter().any(|other| entry(*other) > size(*other))
    }

    fn invalid(&self, row: usize, problem: String, cure: &str) -> Error {
        let starts = (0..self.problem.kinds().len()).map(|k| self.problem.rows_of(k));
        let k = starts.enumerate().find(|(_, rows)| rows.contains(&row)).map_or(0, |(k, _)| k);
        let rows = self.problem.rows_of(k);
        let which = match ORDINALS.get(row - rows.start) {
            Some(ordinal) if rows.len() > 1 => format!("has a row, the {ordinal} of its {},", rows.len()),
            _ => "has a row".into(),
        };
        Error::invalid(format!("kinds[{k}]"), format!("{which} that {problem}"), cure)
    }

    /// Takes a row out of the system.
    fn eliminate(&mut self, row: usize) -> Eliminated {
        self.left.retain(|other| *other != row);
        self.standing.retain(|other| *other != row);
        let (pivot, own) = (self.matrix[(row, row)], self.velocity[row]);
        let [coefficients, column] = [true, false].map(|is_row| {
            let entry = |other: &usize| (*other, if is_row { self.matrix[(row, *other)] } else { self.matrix[(*other, row)] });
            self.standing.iter().map(entry).filter(|(_, w)| *w != 0.0).collect::<Vec<_>>()
        });
        for (i, below) in &column {
            // the product first: of a symmetric W both halves get the same number
            coefficients.iter().for_each(|(j, beside)| self.matrix[(*i, *j)] -= below * beside / pivot);
            let taken = below * own / pivot;
            self.velocity[*i] -= taken;
            self.terms[*i] += taken.abs() + (below / pivot).abs() * self.terms[row];
        }
        Eliminated { row, pivot, velocity: own, coefficients }
    }

    /// A contact or limit that the joints hold fast does not move: what rounding left of its row is cleared.
    fn clear_fixed(&mut self) {
        let pushing: Vec<usize> = self.problem.pushing().into_iter().flat_map(|k| self.problem.rows_of(k)).collect();
        self.standing = pushing.clone();
        let fixed: Vec<usize> =
            pushing.into_iter().filter(|row| self.kept(*row).abs() <= DEPENDENT && !self.moves_something(*row)).collect();
        for row in fixed {
            self.matrix.row_mut(row).fill(0.0);
            self.matrix.column_mut(row).fill(0.0);
            if self.velocity[row].abs() <= DEPENDENT * self.terms[row] {
                self.velocity[row] = 0.0;
            }
        }
    }
}

/// Which row of a constraint, of as many as it may have.
const ORDINALS: [&str; MOST_ROWS] = ["first", "second", "third", "fourth", "fifth", "sixth"];

/// The same W with another u_free.
fn with_velocity(contacts: &ContactProblem, free: DVector<f64>) -> Option<ContactProblem> {
    contacts.clone().into_builder().free_velocity(free).build().ok()
}

/// A refusal says what was asked: a solver that needs mass and Jacobian would otherwise ask for those that the file has.
fn without_mechanism(error: Error) -> Error {
    match error {
        Error::Solver { solver, failure: Failure::Refused, reason } => {
            let asked = "of what is left of the contacts once the joints are eliminated, W alone without mass and Jacobian";
            Error::refused(solver, format!("{reason} (it was asked {asked})"))
        }
        other => other,
    }
}

/// That there is no solution a solver tells of Ŵ and q̂, which are rounded: the word stays where it is proved of the problem itself.
fn of_all_rows(problem: &JointedProblem, left: &WithoutJoints, error: Error) -> Error {
    let Error::Solver { solver, failure: Failure::Infeasible, .. } = error else { return error };
    let found = "once the joints are eliminated, which rounds, what is left of the contacts has no solution";
    match exactly::decided(problem, left.contacts()) {
        Decided::None(reason) => Error::infeasible(solver, reason),
        Decided::Some => Error::breakdown(solver, format!("{found}, but the problem itself has one, as elimination in fractions shows")),
        Decided::Nothing => Error::breakdown(solver, format!("{found}: of the problem itself that proves nothing")),
    }
}

/// Solves a problem with joints by a solver for contacts, from the impulses of all rows `warm_start` if given.
///
/// Where the certificate refuses its answer, or there is none, what elimination leaves is taken once more without what it rounds: from
/// fractions, and with the velocities at rest that are rounding beside what they were summed from.
///
/// # Errors
/// Those of [`WithoutJoints::new`], of which elimination in fractions takes what it can, and of the solver; [`Error::Invalid`] if the warm
/// start has another size. The failure `infeasible` is
/// told where it is proved of the problem, not of what elimination in floating-point numbers left of it.
pub fn solve_jointed(problem: &JointedProblem, solver: &dyn ContactSolver, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
    if let Some(warm) = warm_start {
        problem.require_rows("warm_start", warm.len())?;
    }
    let start = warm_start.map(|all| problem.spread(all));
    let left = match WithoutJoints::new(problem) {
        Ok(left) => left,
        Err(error) => return in_fractions(problem, solver, start.as_ref(), error),
    };
    let first = answered(problem, &left, solver, start.as_ref());
    if solver.is_truncated() || left.contacts.contacts() == 0 || first.as_ref().is_ok_and(|answer| is_accepted(problem, answer)) {
        return first.map_err(|error| of_all_rows(problem, &left, error));
    }
    let exactly = || exactly::left_of_contacts(problem, &left.contacts).map(|contacts| WithoutJoints { contacts, ..left.clone() });
    let again: [&dyn Fn() -> Option<WithoutJoints>; 2] = [&exactly, &|| left.at_rest(problem)];
    for left in again.into_iter().filter_map(|make| make()) {
        let Ok(answer) = answered(problem, &left, solver, start.as_ref()) else { continue };
        if let Some(answer) = accepted(problem, answer) {
            return Ok(answer);
        }
    }
    first.map_err(|error| of_all_rows(problem, &left, error))
}

/// What elimination in fractions leaves of joints that elimination in floating-point numbers refuses: an answer that the certificate
/// accepts, and the refusal otherwise.
fn in_fractions(problem: &JointedProblem, solver: &dyn ContactSolver, start: Option<&DVector<f64>>, refusal: Error) -> Result<Solution> {
    let Some(contacts) = exactly::contacts(problem) else { return Err(refusal) };
    let left = WithoutJoints { contacts, eliminated: Vec::new(), dependent: Vec::new(), terms: DVector::zeros(problem.rows()) };
    accepted(problem, answered(problem, &left, solver, start)?).ok_or(refusal)
}

/// The answer with the impulses of joints in fractions, or as it is, if the certificate accepts it.
fn accepted(problem: &JointedProblem, answer: Solution) -> Option<Solution> {
    let completed = exactly::completed(problem, &answer.impulse);
    let completed = completed.map(|impulse| Solution { velocity: problem.velocity(&impulse), impulse, ..answer.clone() });
    completed.into_iter().chain([answer]).find(|answer| is_accepted(problem, answer))
}

fn is_accepted(problem: &JointedProblem, answer: &Solution) -> bool {
    jointed_residuals(problem, answer).is_ok_and(|residuals| residuals.relative() <= CERTIFY)
}

/// The answer of the contacts that are left, with the impulses of the joints.
fn answered(problem: &JointedProblem, left: &WithoutJoints, solver: &dyn ContactSolver, start: Option<&DVector<f64>>) -> Result<Solution> {
    let found = match left.contacts.contacts() {
        0 => Solution::new(solver.name(), DVector::zeros(0), DVector::zeros(0), 0),
        _ => solver.solve(&left.contacts, start).map_err(without_mechanism)?,
    };
    let mut impulse = DVector::zeros(problem.rows());
    problem.gather(&found.impulse, &mut impulse);
    left.complete(&mut impulse);
    let velocity = problem.velocity(&impulse);
    super::finite(Solution::new(found.solver, impulse, velocity, found.iterations))
}

#[cfg(test)]
#[path = "joints_tests.rs"]
mod tests;

#[cfg(test)]
#[path = "joints_at_rest_tests.rs"]
mod at_rest_tests;
