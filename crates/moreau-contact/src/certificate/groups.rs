//! Which contacts lie between the same two bodies: they share the size that residuals are held against.
//!
//! Two contacts do if their rows of H touch the same velocities and W joins them, directly or through others of that kind: coordinates
//! that mix bodies give the rows of two bodies the same columns. Without H, if the file names the same pair and W couples each of them
//! with each. A name alone joins nothing: it could hide a light contact behind a heavy one that it never meets.

use crate::memory::spare::{self, Lent};
use crate::problem::ContactProblem;
use crate::tolerance::certificate::COUPLED;

/// Columns of a contact of two free bodies in space: room that nearly always is enough.
const FEW_COLUMNS: usize = 12;

/// The first contact of the same two bodies, for every contact.
pub(super) fn find(problem: &ContactProblem) -> Lent<Vec<usize>> {
    let all = || Lent::from(spare::collected(problem.contacts(), 0..problem.contacts()));
    let mut found: Lent<Vec<usize>> = all();
    let knows_rows = problem.knows_rows();
    if problem.bodies().is_none() && !knows_rows {
        return found;
    }
    let pair = |k: usize| problem.bodies().map_or([None; 2], |bodies| sorted(bodies[k]));
    let mut order = all();
    order.sort_unstable_by_key(|k| (pair(*k), *k));
    let mut touching = Touching::default();
    for named in order.chunk_by(|one, other| pair(*one) == pair(*other)).filter(|named| named.len() > 1) {
        if !knows_rows {
            join_all_coupled(problem, named, &mut found);
            continue;
        }
        touching.set(problem, named);
        let Touching { columns, order } = &mut touching;
        let of = |(_, [first, last]): &(usize, [usize; 2])| &columns[*first..*last];
        for same in order.chunk_by_mut(|one, other| of(one) == of(other)) {
            join_connected(problem, same, &mut found);
        }
    }
    found
}

fn sorted([first, second]: [Option<usize>; 2]) -> [Option<usize>; 2] {
    if first <= second { [first, second] } else { [second, first] }
}

/// Contacts in the order of the columns of H that they touch, and these columns; the memory is used for one pair of bodies after another.
#[derive(Default)]
struct Touching {
    columns: Lent<Vec<usize>>,
    /// Each contact with its part of `columns`.
    order: Lent<Vec<(usize, [usize; 2])>>,
}

impl Touching {
    fn set(&mut self, problem: &ContactProblem, contacts: &[usize]) {
        let Touching { columns, order } = self;
        columns.make_room(FEW_COLUMNS * contacts.len());
        order.make_room(contacts.len());
        for &k in contacts {
            let first = columns.len();
            problem.push_touched(k, columns);
            order.push((k, [first, columns.len()]));
        }
        let of = |[first, last]: [usize; 2]| &columns[first..last];
        // nearly always all touch the same ones, and their numbers grow
        if !order.windows(2).all(|two| of(two[0].1) == of(two[1].1)) {
            order.sort_unstable_by_key(|(k, own)| (of(*own), *k));
        }
    }
}

/// Joins what W couples directly or through others: what was come to stands before what was not, and grows.
fn join_connected(problem: &ContactProblem, members: &mut [(usize, [usize; 2])], found: &mut [usize]) {
    let mut start = 0;
    while start < members.len() {
        let first = members[start].0;
        let (mut next, mut end) = (start, start + 1);
        while next < end {
            let (own, mut kept) = (Coupled::new(problem, members[next].0), end);
            for other in end..members.len() {
                if own.with(members[other].0) {
                    // the rest keeps its order
                    members[kept..=other].rotate_right(1);
                    kept += 1;
                }
            }
            (next, end) = (next + 1, kept);
        }
        members[start..end].iter().for_each(|(k, _)| found[*k] = first);
        start = end;
    }
}

/// Joins a contact to the first group of which W couples it with every member.
fn join_all_coupled(problem: &ContactProblem, members: &[usize], found: &mut [usize]) {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for &k in members {
        match groups.iter_mut().find(|group| group.iter().all(|&j| Coupled::new(problem, j).with(k))) {
            Some(group) => {
                found[k] = group[0];
                group.push(k);
            }
            None => groups.push(vec![k]),
        }
    }
}

/// What an impulse at one contact moves: another one, if an entry of W between them is more than rounding, compared with the diagonal.
struct Coupled<'a> {
    problem: &'a ContactProblem,
    contact: usize,
    /// √ε times the root of the largest entry of its diagonal.
    seen: f64,
}

impl<'a> Coupled<'a> {
    fn new(problem: &'a ContactProblem, contact: usize) -> Self {
        Coupled { problem, contact, seen: COUPLED * largest(problem, contact).sqrt() }
    }

    fn with(&self, other: usize) -> bool {
        let Coupled { problem, contact, .. } = *self;
        let (rows, seen) = (problem.rows_per_contact(), || self.seen * largest(problem, other).sqrt());
        if let Some(blocks) = problem.delassus().stored_blocks() {
            return blocks.block(contact, other).is_some_and(|block| {
                let seen = seen();
                block.iter().any(|w| w.abs() > seen)
            });
        }
        let seen = seen();
        (0..rows * rows).any(|place| problem.entry(contact * rows + place / rows, other * rows + place % rows).abs() > seen)
    }
}

/// The largest entry on the diagonal of W at a contact, at least 0.
fn largest(problem: &ContactProblem, contact: usize) -> f64 {
    let rows = problem.rows_per_contact();
    match problem.delassus().stored_blocks() {
        Some(blocks) => blocks.block(contact, contact).map_or(0.0, |block| block.iter().step_by(rows + 1).copied().fold(0.0, f64::max)),
        None => (contact * rows..(contact + 1) * rows).map(|row| problem.entry(row, row)).fold(0.0, f64::max),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operator::{Sparse, SparseDynamics};
    use nalgebra::{DMatrix, DVector, dmatrix};

    fn one_row(delassus: DMatrix<f64>, bodies: Vec<[Option<usize>; 2]>) -> ContactProblem {
        let free = DVector::from_element(delassus.nrows(), -1.0);
        ContactProblem::new(delassus, free).rows_per_contact(1).bodies(bodies).build().unwrap()
    }

    #[test]
    fn named_contacts_share_a_group_where_every_two_are_coupled() {
        let pair = [Some(0), Some(1)];
        let chain = dmatrix![1.0, 0.5, 0.0; 0.5, 1.0, 0.5; 0.0, 0.5, 1.0];
        assert_eq!(**find(&one_row(chain.clone(), vec![pair; 3])), [0, 0, 2], "the third never meets the first");
        assert_eq!(**find(&one_row(chain.clone(), vec![pair, [Some(1), Some(0)], [Some(2), None]])), [0, 0, 2], "in either order");
        let unnamed = one_row(chain, vec![pair; 3]).into_builder().bodies(None).build().unwrap();
        assert_eq!(**find(&unnamed), [0, 1, 2]);
    }

    #[test]
    fn contacts_with_the_same_columns_share_a_group_where_w_connects_them() {
        let jacobian = dmatrix![1.0, 1.0; 1.0, -1.0; 1.0, 0.5; 0.0, 1.0];
        let free = DVector::zeros(2);
        let problem = ContactProblem::from_dynamics(DMatrix::identity(2, 2), jacobian, &free).rows_per_contact(1).build().unwrap();
        assert_eq!(**find(&problem), [0, 0, 0, 3], "the first two meet through the third; the last touches other velocities");
        let apart = dmatrix![1.0, 1.0; 1.0, -1.0; 2.0, 2.0];
        let apart = ContactProblem::from_dynamics(DMatrix::identity(2, 2), apart, &free).rows_per_contact(1).build().unwrap();
        assert_eq!(**find(&apart), [0, 1, 0], "the one between the two meets neither");
        let rows = &problem.dynamics().unwrap().jacobian;
        let (mass, rows) = (Sparse::of(&DMatrix::identity(2, 2)), Sparse::of(rows));
        let by_bodies = SparseDynamics::new(&mass, &rows, 1).unwrap();
        let by_bodies = ContactProblem::from_sparse_dynamics(&by_bodies, &free).friction(vec![0.0; 4]).build().unwrap();
        assert_eq!(**find(&by_bodies), [0, 0, 0, 3]);
    }
}
