//! A problem with joints row by row: contacts and limits as they are, and every bilateral row a constraint of its own.
//!
//! ```text
//!     W̄ = P W Pᵀ + D ,   q̄ = P q          P puts a row of all to its place,  D > 0 at the rows beside limits and bilateral rows alone
//! ```
//! All constraints have as many rows then, as proofs count them. The rows that were added move nothing else and have no velocity and no
//! impulse. The operator of a [`ContactProblem`] holds it; its law holds at the contacts and limits, and at a bilateral row y = 0 stands in
//! its place: what is proved must ask [`is_joined`](ByRows::is_joined).

use super::{ConstraintKind, JointedProblem};
use crate::memory;
use crate::problem::{ContactProblem, Dynamics};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// Square matrices that are alive while something is proved.
const MATRICES: u128 = 4;

/// The constraints of a problem with joints, with equally many rows each.
#[derive(Clone, Debug)]
pub(crate) struct ByRows {
    contacts: ContactProblem,
    /// Of every contact whether it is a bilateral row, and the constraint that it is of.
    of: Vec<(bool, usize)>,
    /// Row of all, row of `contacts`.
    places: Vec<(usize, usize)>,
    rows: usize,
}

impl ByRows {
    /// Takes a problem apart.
    ///
    /// # Errors
    /// [`Error::Invalid`](moreau_exact::Error::Invalid) where the rows that are added take more memory than is allowed.
    pub fn new(problem: &JointedProblem) -> Result<Self> {
        let mut units: Vec<(usize, Range<usize>)> = Vec::new();
        for (k, kind) in problem.kinds().iter().enumerate() {
            match kind {
                ConstraintKind::Bilateral { .. } => units.extend(problem.rows_of(k).map(|row| (k, row..row + 1))),
                ConstraintKind::Contact | ConstraintKind::Limit => units.push((k, problem.rows_of(k))),
            }
        }
        let size = units.len() * problem.rows_per_contact();
        memory::require("proving what holds of this problem with joints", memory::matrix(size, size).saturating_mul(MATRICES))?;
        let made = problem.of_units(&units, problem.delassus(), problem.free_velocity()).build()?;
        let places = problem.places(&units);
        let contacts = match problem.dynamics() {
            None => made,
            Some(dynamics) => {
                let spread = spread(dynamics, &places, made.dense());
                made.into_builder().dynamics(spread).build()?
            }
        };
        let is_joined = |k: usize| matches!(problem.kinds()[k], ConstraintKind::Bilateral { .. });
        Ok(ByRows { contacts, of: units.iter().map(|(k, _)| (is_joined(*k), *k)).collect(), places, rows: problem.rows() })
    }

    /// W̄ and q̄, with the law of contacts and limits.
    pub fn contacts(&self) -> &ContactProblem {
        &self.contacts
    }

    /// Whether contact i is a bilateral row.
    pub fn is_joined(&self, i: usize) -> bool {
        self.of[i].0
    }

    /// The constraint that contact i is of, by its place in the `kinds`.
    pub fn constraint(&self, i: usize) -> usize {
        self.of[i].1
    }

    /// The contacts that are constraint k.
    pub fn parts(&self, k: usize) -> impl Iterator<Item = usize> {
        (0..self.of.len()).filter(move |i| self.of[*i].1 == k)
    }

    /// Numbers of all rows as those of the contacts, 0 at the rows that were added.
    pub fn spread(&self, all: &DVector<f64>) -> DVector<f64> {
        let mut spread = DVector::zeros(self.contacts.rows());
        self.places.iter().for_each(|(from, to)| spread[*to] = all[*from]);
        spread
    }

    /// The row of all that a row of the contacts is; none of those that were added.
    pub fn row(&self, of_contacts: usize) -> Option<usize> {
        self.places.iter().find(|(_, to)| *to == of_contacts).map(|(from, _)| *from)
    }

    /// Numbers of the contacts, row by row of all.
    pub fn gather<T: Clone>(&self, spread: &[T]) -> Vec<T> {
        let mut places = self.places.clone();
        places.sort_unstable();
        debug_assert_eq!(places.len(), self.rows);
        places.into_iter().map(|(_, from)| spread[from].clone()).collect()
    }
}

/// M̂ and H with a velocity of its own for each row that was added, of the mass that gives it its entry of W̄.
fn spread(Dynamics { mass, jacobian }: &Dynamics, places: &[(usize, usize)], w: &DMatrix<f64>) -> Dynamics {
    let velocities = mass.nrows();
    let mut from = vec![None; w.nrows()];
    places.iter().for_each(|(row, place)| from[*place] = Some(*row));
    let added: Vec<usize> = (0..from.len()).filter(|place| from[*place].is_none()).collect();
    let size = velocities + added.len();
    let mut made = Dynamics { mass: DMatrix::zeros(size, size), jacobian: DMatrix::zeros(from.len(), size) };
    made.mass.view_mut((0, 0), (velocities, velocities)).copy_from(mass);
    for (place, row) in from.iter().enumerate().filter_map(|(place, row)| row.map(|row| (place, row))) {
        made.jacobian.view_mut((place, 0), (1, velocities)).copy_from(&jacobian.row(row));
    }
    for (own, place) in added.into_iter().enumerate() {
        made.mass[(velocities + own, velocities + own)] = 1.0 / w[(place, place)];
        made.jacobian[(place, velocities + own)] = 1.0;
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Law;
    use nalgebra::{DMatrix, dvector};

    #[test]
    fn every_row_keeps_its_numbers_and_the_added_ones_move_nothing() {
        let w = DMatrix::from_fn(6, 6, |i, j| (7 * i + j) as f64);
        let kinds = vec![ConstraintKind::Limit, ConstraintKind::Bilateral { rows: 3 }, ConstraintKind::Contact];
        let free = dvector![1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let problem = JointedProblem::new(2, kinds, w.clone(), free.clone()).unwrap();
        let problem = problem.law(Law::Coulomb, vec![0.0, 0.0, 0.5]).unwrap().softness(dvector![0.0, 0.5, 0.0, 0.0, 0.25, 0.0]).unwrap();
        let rows = ByRows::new(&problem).unwrap();
        let contacts = rows.contacts();
        assert_eq!((contacts.contacts(), contacts.friction()), (5, &[0.0, 0.0, 0.0, 0.0, 0.5][..]));
        assert_eq!(
            (0..5).map(|i| (rows.is_joined(i), rows.constraint(i))).collect::<Vec<_>>(),
            [(false, 0), (true, 1), (true, 1), (true, 1), (false, 2)]
        );
        assert_eq!(rows.parts(1).collect::<Vec<_>>(), [1, 2, 3]);
        let of: Vec<Option<usize>> = (0..10).map(|row| rows.row(row)).collect();
        assert_eq!(of, [Some(0), None, Some(1), None, Some(2), None, Some(3), None, Some(4), Some(5)]);
        for (row, own) in of.iter().enumerate() {
            for (column, other) in of.iter().enumerate() {
                let entry = contacts.entry(row, column);
                match (own, other) {
                    (Some(i), Some(j)) => assert_eq!(entry, w[(*i, *j)]),
                    _ => assert!(if row == column { entry > 0.0 } else { entry == 0.0 }, "{row} {column}"),
                }
            }
            assert_eq!(contacts.free_velocity()[row], own.map_or(0.0, |i| free[i]));
            assert_eq!(contacts.row_compliance(row), own.map_or(0.0, |i| problem.softnesses()[i]));
        }
        assert_eq!(rows.gather(rows.spread(&free).as_slice()), free.as_slice());
    }
}
