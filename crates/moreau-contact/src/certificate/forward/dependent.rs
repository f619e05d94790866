//! Which rows depend exactly on others, decided in whole numbers.
//!
//! ```text
//!     L y = 0 ,      (L y)_D = C (L y)_B      if      [(L H)_D, (L b)_D] = C [(L H)_B, (L b)_B]      (M̂ and H known) ,
//!                                                     [(L A)_D, (L b)_D] = C [(L A)_B, (L b)_B]      (W alone)
//! ```
//! L has a row for each linear equation of the pattern: y = 0, y_n = μ y_t, or e·y_t = 0 on the side of a polygon, with the numbers that μ
//! and the directions are stored as. Where the rows B are independent and the others depend on them, with their free velocities, the
//! equations of D follow from those of B. Compliance has a column of its own for each of its rows.

use super::case::{Case, Linear};
use super::pattern::{Contact, pressed_rows};
use super::reason::Reason;
use crate::certificate::planted::{Plant, planted};
use crate::certificate::rank::{Entry, Row, independent, rank};
use crate::problem::ContactProblem;
use crate::tolerance::proof::dependent_pivot;

/// An equation that follows from others, and the impulse that is given in its place, by their rows.
pub(super) struct LeftOut {
    pub equation: usize,
    pub given: usize,
}

/// Equations to leave out so that the others are independent and those left out follow from them.
pub(super) fn dependent_rows(
    problem: &ContactProblem,
    contacts: &[Contact],
    cases: &[Case],
    name: &dyn Fn(usize) -> String,
) -> Result<Vec<LeftOut>, Reason> {
    let of = |k: usize| contacts[k].linear(cases[k]).into_iter().map(move |linear| (k * contacts[k].rows, linear));
    let linear: Vec<(usize, Linear)> = (0..contacts.len()).flat_map(of).collect();
    let base = Base::new(problem, &linear, &pressed_rows(contacts, cases));
    let rows: Vec<Row> = linear.iter().map(|(at, linear)| base.row(*at, linear)).collect();
    let contact = |place: usize| linear[place].0 / problem.rows_per_contact();
    let refused = |text: String, contact: Option<usize>| Reason { text, contact };
    let too_long = || refused("deciding which of the rows depend exactly on others takes too long".into(), None);
    let rank_of_all = rank(&rows).ok_or_else(too_long)?;
    if rank_of_all == rows.len() {
        return Ok(Vec::new());
    }
    let order = pivots(linear.iter().map(|(at, linear)| base.rounded(*at, linear)));
    let kept = independent(&rows, &order);
    let left: Vec<usize> = order.into_iter().filter(|place| !kept.contains(place)).collect();
    if kept.len() != rank_of_all {
        return Err(refused("no choice of independent rows was found".into(), left.first().copied().map(contact)));
    }
    let with_free = base.with_free(problem);
    let all: Vec<Row> = linear.iter().map(|(at, linear)| with_free.row(*at, linear)).collect();
    if rank(&all).ok_or_else(too_long)? != rank_of_all && !planted(Plant::Rank) {
        let k = contact(left[0]);
        return Err(refused(format!("rows that depend exactly on others have free velocities that do not ({})", name(k)), Some(k)));
    }
    let left_out = |place: &usize| {
        let (at, linear) = &linear[*place];
        LeftOut { equation: at + linear.equation, given: at + linear.given }
    };
    Ok(left.iter().map(left_out).collect())
}

/// Of these rows of W, independent ones on which the columns of the others depend exactly; none where that is not decided.
pub(in crate::certificate) fn independent_rows(problem: &ContactProblem, rows: &[usize]) -> Option<Vec<usize>> {
    let column = |row: usize| (0..problem.rows()).map(|other| [problem.entry(other, row), 0.0]).collect();
    let entries: Vec<Vec<Entry>> = match problem.dynamics() {
        Some(dynamics) => rows.iter().map(|row| dynamics.jacobian.row(*row).iter().map(|entry| [*entry, 0.0]).collect()).collect(),
        None => rows.iter().map(|row| column(*row)).collect(),
    };
    let columns: Vec<Row> = entries.iter().map(|row| Row::new(row)).collect();
    let order = pivots(entries.iter().map(|row| row.iter().map(|[one, other]| one + other).collect()));
    let mut kept = independent(&columns, &order);
    kept.sort_unstable();
    (kept.len() == rank(&columns)?).then(|| kept.into_iter().map(|place| rows[place]).collect())
}

/// The rows of which equations are made: of H with a column for the compliance, or of A at the columns that have an impulse.
struct Base(Vec<Vec<Entry>>);

impl Base {
    /// The rows that the equations name; the others are empty.
    fn new(problem: &ContactProblem, linear: &[(usize, Linear)], pressed: &[usize]) -> Self {
        let mut named: Vec<usize> = linear.iter().flat_map(|(at, linear)| linear.terms.iter().map(move |(_, row)| at + row)).collect();
        named.sort_unstable();
        named.dedup();
        let mut rows = vec![Vec::new(); problem.rows()];
        if let Some(dynamics) = problem.dynamics() {
            let soft: Vec<usize> = named.iter().copied().filter(|row| problem.row_compliance(*row) > 0.0).collect();
            let is_used = |j: &usize| named.iter().any(|row| dynamics.jacobian[(*row, *j)] != 0.0);
            let used: Vec<usize> = (0..dynamics.jacobian.ncols()).filter(is_used).collect();
            for row in named {
                let own = soft.iter().map(|other| [f64::from(u8::from(*other == row)), 0.0]);
                rows[row] = used.iter().map(|j| [dynamics.jacobian[(row, *j)], 0.0]).chain(own).collect();
            }
            return Base(rows);
        }
        let soft = |row: usize, column: usize| if row == column { problem.row_compliance(row) } else { 0.0 };
        for row in named {
            rows[row] = pressed.iter().map(|column| [problem.entry(row, *column), soft(row, *column)]).collect();
        }
        Base(rows)
    }

    /// The same with b in a last column.
    fn with_free(self, problem: &ContactProblem) -> Self {
        let named = self.0.into_iter().enumerate().map(|(row, mut entries)| {
            entries.push([problem.free_velocity()[row], problem.shift()[row]]);
            entries
        });
        Base(named.collect())
    }

    /// The equation of a contact whose first row this is.
    fn row(&self, at: usize, linear: &Linear) -> Row {
        let terms: Vec<_> = linear.terms.iter().map(|(factor, row)| (*factor, self.0[at + row].as_slice())).collect();
        Row::sum(&terms)
    }

    /// The same in rounded numbers.
    fn rounded(&self, at: usize, linear: &Linear) -> Vec<f64> {
        let mut sum = vec![0.0; linear.terms.first().map_or(0, |(_, row)| self.0[at + row].len())];
        for ([one, other], row) in &linear.terms {
            let terms = sum.iter_mut().zip(&self.0[at + row]);
            terms.for_each(|(sum, [entry, rest])| *sum += one * other * (entry + rest));
        }
        sum
    }
}

/// The rows in the order in which they add most of their own length to those before (Gram and Schmidt), in rounded numbers.
fn pivots(rows: impl Iterator<Item = Vec<f64>>) -> Vec<usize> {
    let mut left: Vec<(usize, Vec<f64>, f64)> = Vec::new();
    for (place, row) in rows.enumerate() {
        let length = dot(&row, &row).sqrt();
        left.push((place, row, if length > 0.0 { length } else { 1.0 }));
    }
    let (mut order, all) = (Vec::new(), left.len());
    while !left.is_empty() {
        let part = |(_, row, length): &(usize, Vec<f64>, f64)| dot(row, row).sqrt() / length;
        let best = (0..left.len()).reduce(|best, i| if part(&left[i]) > part(&left[best]) { i } else { best }).expect("it is not empty");
        let (place, row, length) = left.swap_remove(best);
        order.push(place);
        let square = dot(&row, &row);
        if square.sqrt() <= dependent_pivot(all) * length {
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
