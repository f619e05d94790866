//! Which rows depend exactly on others, decided in whole numbers.
//!
//! ```text
//!     y_D = C y_B        if      [H_D, b_D] = C [H_B, b_B]        (M̂ and H known) ,      [A_D, b_D] = C [A_B, b_B]        (W alone)
//! ```
//! Where the rows B of the pattern's linear equations y = 0 are independent and the others depend on them, with their free velocities, the
//! equations of D follow from those of B. Compliant rows are independent of all others: in M̂ and H each has a column of its own.

use super::case::Case;
use super::pattern::{Contact, pressed_rows};
use super::reason::Reason;
use crate::certificate::planted::{Plant, planted};
use crate::certificate::rank::{Entry, rank, surely_independent};
use crate::problem::ContactProblem;
use crate::tolerance::proof::dependent_pivot;

/// Rows to leave out so that the others are independent and the equations of those left out follow from theirs.
pub(super) fn dependent_rows(
    problem: &ContactProblem,
    contacts: &[Contact],
    cases: &[Case],
    name: &dyn Fn(usize) -> String,
) -> Result<Vec<usize>, Reason> {
    let linear: Vec<usize> =
        (0..contacts.len()).flat_map(|k| k * contacts[k].rows..k * contacts[k].rows + contacts[k].linear_rows(cases[k])).collect();
    let rows = entries(problem, &linear, &pressed_rows(contacts, cases));
    let refused = |text: String, row: Option<usize>| Reason { text, contact: row.map(|row| row / problem.rows_per_contact()) };
    let too_long = || refused("deciding which of the rows depend exactly on others takes too long".into(), None);
    let independent = rank(&rows).ok_or_else(too_long)?;
    if independent == rows.len() {
        return Ok(Vec::new());
    }
    let order = pivots(&rows);
    let (kept, left) = order.split_at(independent);
    if !surely_independent(&kept.iter().map(|place| &rows[*place]).collect::<Vec<_>>()) {
        return Err(refused("no well conditioned choice of independent rows was found".into(), left.first().map(|place| linear[*place])));
    }
    let with_free: Vec<Vec<Entry>> = rows.iter().zip(&linear).map(|(row, at)| [row.as_slice(), &[free(problem, *at)]].concat()).collect();
    if rank(&with_free).ok_or_else(too_long)? != independent && !planted(Plant::Rank) {
        let row = linear[left[0]];
        let place = name(row / problem.rows_per_contact());
        return Err(refused(format!("rows that depend exactly on others have free velocities that do not ({place})"), Some(row)));
    }
    let mut dependent: Vec<usize> = left.iter().map(|place| linear[*place]).collect();
    dependent.sort_unstable();
    Ok(dependent)
}

/// Of these rows of W, independent ones on which the columns of the others depend exactly; none where that is not decided.
pub(in crate::certificate) fn independent_rows(problem: &ContactProblem, rows: &[usize]) -> Option<Vec<usize>> {
    let column = |row: usize| (0..problem.rows()).map(|other| [problem.entry(other, row), 0.0]).collect();
    let columns: Vec<Vec<Entry>> = match problem.dynamics() {
        Some(dynamics) => rows.iter().map(|row| dynamics.jacobian.row(*row).iter().map(|entry| [*entry, 0.0]).collect()).collect(),
        None => rows.iter().map(|row| column(*row)).collect(),
    };
    let (order, independent) = (pivots(&columns), rank(&columns)?);
    let mut kept = order[..independent].to_vec();
    kept.sort_unstable();
    surely_independent(&kept.iter().map(|place| &columns[*place]).collect::<Vec<_>>())
        .then(|| kept.into_iter().map(|place| rows[place]).collect())
}

fn free(problem: &ContactProblem, row: usize) -> Entry {
    [problem.free_velocity()[row], problem.shift()[row]]
}

/// The rows whose dependence is asked for: of H with a column for the compliance, or of A at the columns that have an impulse.
fn entries(problem: &ContactProblem, linear: &[usize], pressed: &[usize]) -> Vec<Vec<Entry>> {
    if let Some(dynamics) = problem.dynamics() {
        let soft: Vec<usize> = linear.iter().copied().filter(|row| problem.row_compliance(*row) > 0.0).collect();
        let used: Vec<usize> =
            (0..dynamics.jacobian.ncols()).filter(|j| linear.iter().any(|row| dynamics.jacobian[(*row, *j)] != 0.0)).collect();
        let own = |row: usize| soft.iter().map(move |other| [f64::from(u8::from(*other == row)), 0.0]);
        return linear.iter().map(|row| used.iter().map(|j| [dynamics.jacobian[(*row, *j)], 0.0]).chain(own(*row)).collect()).collect();
    }
    let soft = |row: usize, column: usize| if row == column { problem.row_compliance(row) } else { 0.0 };
    linear.iter().map(|row| pressed.iter().map(|column| [problem.entry(*row, *column), soft(*row, *column)]).collect()).collect()
}

/// The rows in the order in which they add most of their own length to those before (Gram and Schmidt), in rounded numbers.
fn pivots(rows: &[Vec<Entry>]) -> Vec<usize> {
    let mut left: Vec<(usize, Vec<f64>, f64)> = Vec::new();
    for (place, row) in rows.iter().enumerate() {
        let numbers: Vec<f64> = row.iter().map(|[one, other]| one + other).collect();
        let length = dot(&numbers, &numbers).sqrt();
        left.push((place, numbers, if length > 0.0 { length } else { 1.0 }));
    }
    let mut order = Vec::new();
    while !left.is_empty() {
        let part = |(_, row, length): &(usize, Vec<f64>, f64)| dot(row, row).sqrt() / length;
        let best = (0..left.len()).reduce(|best, i| if part(&left[i]) > part(&left[best]) { i } else { best }).expect("it is not empty");
        let (place, row, length) = left.swap_remove(best);
        order.push(place);
        let square = dot(&row, &row);
        if square.sqrt() <= dependent_pivot(rows.len()) * length {
            continue; // nothing but rounding is left of it
        }
        for (_, other, _) in &mut left {
            let factor = dot(&row, other) / square;
            other.iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
        }
    }
    order
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
