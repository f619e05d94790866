//! Whether W is positive semidefinite to rounding, as the Delassus operator of bodies is.
//!
//! ```text
//!     ½(W + Wᵀ) + c diag W = L Lᵀ  runs to its end ,     c = n γ_{2n+8}          n rows
//! ```
//! With D = diag W the rounding of an entry is γ √(W_ii W_jj), and so is what Cholesky's factorisation adds to it: the eigenvalues of
//! D^(−½) W D^(−½) move by no more than n γ, whatever the sizes of the rows are. A W of bodies that was rounded passes, and one with an
//! eigenvalue below −2c does not. An island is looked at with the others: its fronts meet no other's.

use crate::fronts::{Factor, Front, Tree, Work};
use crate::operator::{BlockSparse, Lists, Operator};
use crate::tolerance::certificate::{LARGEST_ASKED, gamma};
use crate::watch;

/// Whether that is shown; of more rows than [`LARGEST_ASKED`], and where the factor takes more memory than is allowed, it is not. Nobody's
/// word ends it early.
pub(super) fn is_semidefinite(w: &Operator, rows_per_contact: usize) -> bool {
    let rows = w.shape()[0];
    if rows > LARGEST_ASKED {
        return false;
    }
    let groups = vec![rows_per_contact; rows / rows_per_contact.max(1)];
    let lift = rows as f64 * gamma(2 * rows + 8);
    let sparse = if let Operator::Dense(dense) = w { BlockSparse::of_dense(dense, rows_per_contact) } else { None };
    let mut tree = Tree::default();
    watch::unwatched(|| {
        match sparse.as_ref().or_else(|| w.blocks()) {
            Some(blocks) => tree.plan(&groups, &neighbours(blocks)),
            None => tree.plan_one_front(&groups),
        }
        Factor::default().compute(&tree, true, &mut Work::default(), |node, front| assemble(w, lift, &tree, node, front))
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
    fn w_of_redundant_contacts_of_light_and_heavy_bodies_is_and_one_whose_least_eigenvalue_is_below_rounding_is_not() {
        for (contacts, s) in [(1, 0), (2, 6), (5, 6), (40, 8)] {
            let w = chain(contacts, s);
            let n = w.nrows();
            for by_blocks in if contacts > 5 { vec![false, true] } else { vec![false] } {
                assert!(is_semidefinite(&stored(&w, by_blocks), 3), "{contacts} {s} {by_blocks}");
                for row in [0, n / 2, n - 1] {
                    let mut less = w.clone();
                    less[(row, row)] *= 1.0 - 4.0 * n as f64 * n as f64 * gamma(2 * n + 8);
                    assert!(!is_semidefinite(&stored(&less, by_blocks), 3), "{contacts} {s} {by_blocks} {row}");
                }
            }
        }
    }

    #[test]
    fn rows_without_entries_are_left_out_and_only_the_symmetric_part_counts() {
        let of = |entries: &[f64]| Operator::Dense(DMatrix::from_row_slice(2, 2, entries).into());
        assert!(is_semidefinite(&of(&[0.0, 0.0, 0.0, 1.0]), 1) && is_semidefinite(&of(&[0.0; 4]), 2));
        assert!(is_semidefinite(&of(&[1.0, 3.0, -3.0, 1.0]), 1) && !is_semidefinite(&of(&[1.0, 3.0, 3.0, 1.0]), 1));
        assert!(!is_semidefinite(&of(&[0.0, 1.0, 1.0, 1.0]), 1) && !is_semidefinite(&of(&[-1.0, 0.0, 0.0, 1.0]), 1));
    }
}
