//! How far W is from a positive semidefinite one, as the Delassus operator of bodies is.
//!
//! ```text
//!     the least ε of 0, 2⁻²⁶, 2⁻²⁰, 2⁻¹³ and 1 for which ½(W + Wᵀ) + (ε + c) diag W = L Lᵀ runs to its end ,     c = n γ_{2n+8}
//! ```
//! with n rows. With D = diag W the rounding of an entry is γ √(W_ii W_jj), and so is what Cholesky's factorisation adds to it: the
//! eigenvalues of D^(−½) W D^(−½) move by no more than n γ, whatever the sizes of the rows are. So ε = 0 for a W of bodies with all of its
//! digits, and more for one that was written with few. An island is looked at with the others: its fronts meet no other's.

use crate::fronts::{Factor, Front, Tree, Work};
use crate::operator::{BlockSparse, Lists, Operator};
use crate::tolerance::certificate::{LARGEST_FRONT, LEVELS, MOST_MERGED, gamma};
use crate::watch;

/// ε, or nothing where W is too large to tell, by its rows, its order or the memory that is allowed. Nobody's word ends it early.
pub(super) fn indefiniteness(w: &Operator, rows_per_contact: usize) -> Option<f64> {
    let rows = w.shape()[0];
    let groups = vec![rows_per_contact; rows / rows_per_contact.max(1)];
    let sparse = if let Operator::Dense(dense) = w { BlockSparse::of_dense(dense, rows_per_contact) } else { None };
    let mut tree = Tree::within(MOST_MERGED);
    watch::unwatched(|| {
        let blocks = sparse.as_ref().or_else(|| w.blocks());
        blocks.into_iter().for_each(|blocks| tree.plan(&groups, &neighbours(blocks)));
        if blocks.is_none() || tree.is_given_up {
            if rows > LARGEST_FRONT {
                return None;
            }
            tree.plan_one_front(&groups);
        }
        let (mut factor, mut work) = (Factor::default(), Work::default());
        for level in LEVELS {
            let lift = level + rows as f64 * gamma(2 * rows + 8);
            if factor.compute(&tree, true, &mut work, |node, front| assemble(w, lift, &tree, node, front)) {
                return Some(level);
            }
            if factor.was_left {
                return None;
            }
        }
        Some(1.0)
    })
}

/// The lower triangle of the pivots' columns, in the order of the front. On a diagonal of zero stands the least number, beside which
/// every other entry of the row is too large.
fn assemble(w: &Operator, lift: f64, tree: &Tree, node: usize, front: &mut Front) {
    let Front { entries, size, local } = front;
    let rows = |group: usize| (tree.starts[group]..tree.starts[group + 1]).zip(local[group]..);
    let groups = tree.groups(node);
    for (j, column) in groups[..tree.nodes[node].pivot_groups].iter().flat_map(|group| rows(*group)) {
        for (i, row) in groups.iter().flat_map(|group| rows(*group)).filter(|(_, row)| *row >= column) {
            let mean = 0.5 * w.entry(i, j) + 0.5 * w.entry(j, i);
            entries[column * *size + row] = match (i == j, mean == 0.0) {
                (true, true) => f64::MIN_POSITIVE,
                (true, false) => mean + lift * mean,
                _ => mean,
            };
        }
    }
}

/// Of every contact the others that it meets, in either direction.
fn neighbours(blocks: &BlockSparse) -> Lists {
    let mut lists = Lists::default();
    lists.collect(blocks.contacts(), |show| {
        for k in 0..blocks.contacts() {
            for j in blocks.met(k).iter().copied().filter(|j| *j != k) {
                show(k, j);
                show(j, k);
            }
        }
    });
    lists.sort_each();
    lists
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    /// H M⁻¹ Hᵀ of `contacts` contacts of three rows in a chain, each between a body of three velocities and the next, of masses
    /// 10⁻ˢ, 1, 10ˢ, 1, …; twice as many rows as velocities where each stands twice.
    fn chain(contacts: usize, s: i32) -> DMatrix<f64> {
        let mass = |body: usize| 10f64.powi(s * ((body % 4) as i32 - 1).min(1));
        let jacobian = DMatrix::from_fn(6 * contacts, 3 * (contacts + 1), |i, v| match (v / 3).wrapping_sub(i / 6) {
            0 => f64::from(u8::from(v % 3 == i % 3)) + 0.3,
            1 => -f64::from(u8::from(v % 3 == i % 3)) - 0.1 * (i % 3) as f64,
            _ => 0.0,
        });
        let scaled = DMatrix::from_fn(jacobian.nrows(), jacobian.ncols(), |i, v| jacobian[(i, v)] / mass(v / 3));
        scaled * jacobian.transpose()
    }

    fn stored(w: &DMatrix<f64>, by_blocks: bool) -> Operator {
        let blocks = || BlockSparse::of_dense(w, 3).expect("a chain is mostly zeros");
        if by_blocks { blocks().into() } else { w.clone().into() }
    }

    #[test]
    fn redundant_contacts_of_light_and_heavy_bodies_are_semidefinite_and_a_little_less_is_told() {
        for (contacts, s) in [(1, 0), (2, 6), (5, 6), (40, 8)] {
            let w = chain(contacts, s);
            let n = w.nrows();
            for by_blocks in if contacts > 5 { vec![false, true] } else { vec![false] } {
                assert_eq!(indefiniteness(&stored(&w, by_blocks), 3), Some(0.0), "{contacts} {s} {by_blocks}");
                for row in [0, n / 2, n - 1] {
                    let mut less = w.clone();
                    less[(row, row)] *= 1.0 - LEVELS[1] / 2.0;
                    assert_eq!(indefiniteness(&stored(&less, by_blocks), 3), Some(LEVELS[1]), "{contacts} {s} {by_blocks} {row}");
                }
            }
        }
    }

    #[test]
    fn rows_without_entries_are_left_out_and_only_the_symmetric_part_counts() {
        let of = |entries: &[f64], rows: usize| indefiniteness(&Operator::Dense(DMatrix::from_row_slice(2, 2, entries)), rows);
        assert_eq!([of(&[0.0, 0.0, 0.0, 1.0], 1), of(&[0.0; 4], 2), of(&[1.0, 3.0, -3.0, 1.0], 1)], [Some(0.0); 3]);
        for none in [[1.0, 3.0, 3.0, 1.0], [0.0, 1.0, 1.0, 1.0], [-1.0, 0.0, 0.0, 1.0]] {
            assert_eq!(of(&none, 1), Some(1.0), "{none:?}");
        }
    }

    #[test]
    fn every_level_has_two_sides() {
        for (below, above) in LEVELS.into_iter().zip(LEVELS.into_iter().skip(1).chain([1.0])) {
            let of = |e: f64| indefiniteness(&Operator::Dense(DMatrix::from_row_slice(2, 2, &[1e-9, 1.0 + e, 1.0 + e, 1e9])), 1);
            assert_eq!([of(below), of(below * 1.01 + 1e-13)], [Some(below), Some(above)]);
        }
    }

    #[test]
    fn what_is_too_large_is_not_told() {
        // every contact meets every third one: no order leaves zeros
        let n = LARGEST_FRONT + 3;
        let mut blocks = BlockSparse::with_capacity(1, n, n);
        for k in 0..n {
            blocks.begin(k);
            (0..n).filter(|j| j % 3 == k % 3).for_each(|j| blocks.push(j, k, &[if j == k { n as f64 } else { 1.0 }]).unwrap());
        }
        blocks.finish(n);
        assert_eq!(indefiniteness(&blocks.into(), 1), None);
    }
}
