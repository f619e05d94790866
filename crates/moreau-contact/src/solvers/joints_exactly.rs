//! Whether a problem with joints has a solution, decided of its own numbers: what floating-point elimination leaves of it is rounded.
//!
//! ```text
//!     Ŵ = W_uu − W_ub A⁻¹ W_bu ,   q̂ = q_u − W_ub A⁻¹ q_b ,   A = W_bb + R_bb        in fractions, W = H M̂⁻¹ Hᵀ where they are known
//! ```
//! Where the law makes of Ŵ and q̂ a small linear complementarity problem, all of its complementary cones are looked at. Otherwise a
//! witness is looked for that refutes all impulses, those of the joints among them.

use super::enumeration::reason;
use super::linear_form::Form;
use crate::certificate::complementary_cones::some_solution;
use crate::certificate::jointed_proof::infeasible_jointed;
use crate::certificate::true_operator::operator;
use crate::problem::{ByRows, ContactProblem, JointedProblem, Lcp};
use crate::tolerance::complementarity::SEARCHED_ROWS;
use crate::tolerance::joints::EXACT_ROWS;
use moreau_exact::elimination::solve;
use moreau_exact::scalar::{Rational, Scalar, exact};
use nalgebra::{DMatrix, DVector};

/// What is proved of a problem.
pub(super) enum Decided {
    /// There is no solution, and why.
    None(String),
    /// There is one.
    Some,
    Nothing,
}

/// What is proved of a problem whose contacts are these once its joints are eliminated.
pub(super) fn decided(problem: &JointedProblem, contacts: &ContactProblem) -> Decided {
    if let Some(lcp) = lcp(problem, contacts) {
        match some_solution(&lcp) {
            Ok(None) => return Decided::None(reason(&lcp)),
            Ok(Some(_)) => return Decided::Some,
            Err(_) => {}
        }
    }
    match infeasible_jointed(problem) {
        Ok(Some(found)) => {
            let entries = found.witness.iter().enumerate().filter(|(_, p)| !p.is_zero()).map(|(row, p)| format!("{row}: {p}"));
            let entries = entries.collect::<Vec<_>>().join(", ");
            Decided::None(format!("no solution exists: impulses p refute all others, with p by rows {{{entries}}} and 0 elsewhere"))
        }
        _ => Decided::Nothing,
    }
}

/// The contacts as a linear complementarity problem in fractions; `None` where they are none, are many, or no elimination leaves them.
fn lcp(problem: &JointedProblem, contacts: &ContactProblem) -> Option<Lcp<Rational>> {
    let form = Form::of(contacts, "").ok().filter(|form| form.unknowns(contacts) <= SEARCHED_ROWS)?;
    let (w, given) = left(problem)?;
    let mut all = contacts.dense().map(exact);
    // rows beside limits move nothing else, and stay
    let own = places(problem);
    let mut velocity = DVector::from_element(contacts.rows(), Rational::ZERO);
    for (at, row) in &own {
        velocity[*at] = given[*row].clone();
        own.iter().for_each(|(beside, column)| all[(*at, *beside)] = w[(*row, *column)].clone());
    }
    Some(form.exact_lcp_of(contacts, all, &velocity))
}

/// The contacts that are left, Ŵ and q̂ rounded once; `None` where they are many, or no elimination leaves them.
pub(super) fn left_of_contacts(problem: &JointedProblem, contacts: &ContactProblem) -> Option<ContactProblem> {
    let (w, given) = left(problem)?;
    // rows beside limits move nothing else, and stay
    let own = places(problem);
    let mut matrix = contacts.dense().clone();
    let mut free = contacts.free_velocity().clone();
    for (at, row) in &own {
        free[*at] = Scalar::to_f64(&(&given[*row] - exact(contacts.shift()[*at])));
        own.iter().for_each(|(beside, column)| matrix[(*at, *beside)] = Scalar::to_f64(&w[(*row, *column)]));
    }
    contacts.clone().into_builder().delassus(matrix).free_velocity(free).build().ok()
}

/// The contacts that elimination in fractions leaves, rounded once; `None` where there are many rows, or it leaves none.
pub(super) fn contacts(problem: &JointedProblem) -> Option<ContactProblem> {
    let (w, q) = left(problem)?;
    let own = |row: usize| Scalar::to_f64(&(&q[row] - exact(problem.shifts()[row])));
    problem.unilateral(&w.map(|entry| Scalar::to_f64(&entry)), &DVector::from_fn(problem.rows(), |row, _| own(row))).ok()
}

/// The same impulses with those of the joints that the contacts ask for, rounded once, and 0 where others do as well; `None` where the
/// problem is large.
pub(super) fn completed(problem: &JointedProblem, impulse: &DVector<f64>) -> Option<DVector<f64>> {
    let w = whole(problem)?;
    let joined: Vec<usize> = problem.bilateral().into_iter().flat_map(|k| problem.rows_of(k)).collect();
    let given = |row: usize| exact(problem.free_velocity()[row]) + exact(problem.shifts()[row]);
    let free = |row: usize| {
        let others = (0..problem.rows()).filter(|other| !joined.contains(other));
        others.fold(given(row), |sum, other| sum + &w[(row, other)] * exact(impulse[other]))
    };
    let own = |i: usize, j: usize| {
        let soft = if i == j { exact(problem.softnesses()[joined[i]]) } else { Rational::ZERO };
        &w[(joined[i], joined[j])] + soft
    };
    let (rows, columns) = independent(DMatrix::from_fn(joined.len(), joined.len(), own));
    let right = DVector::from_iterator(rows.len(), rows.iter().map(|i| -free(joined[*i])));
    let found = solve(&DMatrix::from_fn(rows.len(), rows.len(), |i, j| own(rows[i], columns[j])), &right)?;
    let mut all = impulse.clone();
    joined.iter().for_each(|row| all[*row] = 0.0);
    columns.iter().zip(found.iter()).for_each(|(j, r)| all[joined[*j]] = Scalar::to_f64(r));
    Some(all)
}

/// As many rows and columns as the rank, whose entries are a regular matrix.
fn independent(mut matrix: DMatrix<Rational>) -> (Vec<usize>, Vec<usize>) {
    let mut rows: Vec<usize> = (0..matrix.nrows()).collect();
    let (mut columns, mut found) = (rows.clone(), (Vec::new(), Vec::new()));
    while let Some((row, column)) = pivot(&matrix, &rows, &columns) {
        rows.retain(|other| *other != row);
        columns.retain(|other| *other != column);
        for below in rows.iter().copied() {
            let factor = &matrix[(below, column)] / &matrix[(row, column)];
            columns.iter().for_each(|beside| matrix[(below, *beside)] = &matrix[(below, *beside)] - &factor * &matrix[(row, *beside)]);
        }
        found.0.push(row);
        found.1.push(column);
    }
    found
}

/// The row of every row of the contacts that are left, where it has one.
fn places(problem: &JointedProblem) -> Vec<(usize, usize)> {
    let place = problem.spread(&DVector::from_fn(problem.rows(), |row, _| row as f64 + 1.0)).map(|row| row as usize);
    place.iter().enumerate().filter(|(_, row)| **row > 0).map(|(at, row)| (at, row - 1)).collect()
}

/// W and q of all rows once the bilateral ones are eliminated, whose own mean nothing then; `None` where some of them depend on others and
/// yet ask something of the contacts, or some of their impulses are free and move them.
fn left(problem: &JointedProblem) -> Option<(DMatrix<Rational>, DVector<Rational>)> {
    let size = problem.rows();
    let mut w = whole(problem)?;
    let mut q = problem.free_velocity().map(exact) + problem.shifts().map(exact);
    let mut rows: Vec<usize> = problem.bilateral().into_iter().flat_map(|k| problem.rows_of(k)).collect();
    let (mut columns, mut standing): (Vec<usize>, Vec<usize>) = (rows.clone(), (0..size).collect());
    rows.iter().for_each(|row| w[(*row, *row)] += exact(problem.softnesses()[*row]));
    while let Some((row, column)) = pivot(&w, &rows, &columns) {
        [&mut rows, &mut standing].into_iter().for_each(|list| list.retain(|other| *other != row));
        columns.retain(|other| *other != column);
        let beside: Vec<usize> = (0..size).filter(|other| !w[(row, *other)].is_zero()).collect();
        for below in standing.iter().copied() {
            let factor = &w[(below, column)] / &w[(row, column)];
            if !factor.is_zero() {
                beside.iter().for_each(|other| w[(below, *other)] = &w[(below, *other)] - &factor * &w[(row, *other)]);
                q[below] = &q[below] - &factor * &q[row];
            }
        }
    }
    let asks = |row: &usize| !q[*row].is_zero() || w.row(*row).iter().any(|entry| !entry.is_zero());
    let moves = |column: &usize| standing.iter().any(|row| !w[(*row, *column)].is_zero());
    (!rows.iter().any(asks) && !columns.iter().any(moves)).then_some((w, q))
}

/// The first entry of these rows and columns that is not zero.
fn pivot(w: &DMatrix<Rational>, rows: &[usize], columns: &[usize]) -> Option<(usize, usize)> {
    rows.iter().flat_map(|row| columns.iter().map(|column| (*row, *column))).find(|place| !w[*place].is_zero())
}

/// W of all rows, of mass and Jacobian where they are known.
fn whole(problem: &JointedProblem) -> Option<DMatrix<Rational>> {
    if problem.rows() > EXACT_ROWS {
        return None;
    }
    let rows = ByRows::new(problem).ok()?;
    let all = operator(rows.contacts()).ok()?;
    let own: Vec<(usize, usize)> = (0..all.nrows()).filter_map(|at| Some((rows.row(at)?, at))).collect();
    let mut w = DMatrix::from_element(problem.rows(), problem.rows(), Rational::ZERO);
    for (row, at) in &own {
        own.iter().for_each(|(column, beside)| w[(*row, *column)] = all[(*at, *beside)].clone());
    }
    Some(w)
}

#[cfg(test)]
#[path = "joints_exactly_tests.rs"]
mod tests;
