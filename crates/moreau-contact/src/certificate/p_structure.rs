//! P-matrices by their structure, of any size.
//!
//! ```text
//!     M is P            ⇔   every irreducible block M_ββ is P            (in some order M is block triangular, and
//!                                                                         det M_αα = Π_β det M_{α∩β, α∩β} for every α)
//!     M_ββ is P         if  m_ii d_i > Σ_{j≠i} |m_ij| d_j for all i, with d > 0      (its diagonal dominates; M-matrices, for one)
//!                       or  M_ββ + M_ββᵀ ≻ 0
//!                       or  all its principal minors are positive, which is tried up to [`LARGEST`] rows.
//! ```
//! Source: A. Berman, R. J. Plemmons, *Nonnegative Matrices in the Mathematical Sciences*, SIAM (1994), chapter 6: where ⟨M⟩d > 0, M D is
//! strictly diagonally dominant, and every principal minor of it positive (Gershgorin).

use super::complementary_cones::LARGEST;
use super::p_matrix::p_matrix;
use super::verified_cholesky::is_positive_definite;
use crate::tolerance::proof::{ROWS, enlarged};
use moreau_exact::scalar::exact;
use nalgebra::{DMatrix, DVector};

/// Why all principal minors of M are positive, if its structure shows it; `None` decides nothing.
///
/// ```
/// use moreau_contact::certificate::p_structure::surely_p;
/// use moreau_contact::nalgebra::DMatrix;
///
/// let murty = DMatrix::from_fn(50, 50, |i, j| if i == j { 1.0 } else if i > j { 2.0 } else { 0.0 });
/// assert!(surely_p(&murty).expect("triangular").contains("triangular"));
/// assert!(surely_p(&DMatrix::from_element(50, 50, 1.0)).is_none());
/// ```
///
/// # Panics
/// If M is not square.
pub fn surely_p(matrix: &DMatrix<f64>) -> Option<&'static str> {
    let size = matrix.nrows();
    if size > ROWS || matrix.diagonal().iter().any(|diagonal| *diagonal <= 0.0 || diagonal.is_nan()) {
        return None;
    }
    let blocks = irreducible(matrix);
    let of = |block: &Vec<usize>| DMatrix::from_fn(block.len(), block.len(), |i, j| matrix[(block[i], block[j])]);
    if blocks.iter().all(|block| block.len() == 1) {
        return Some("all principal minors of M are positive: in some order it is triangular, with a positive diagonal");
    }
    if blocks.len() == 1 {
        return dominates(matrix).then_some("all principal minors of M are positive: its diagonal dominates, columns weighted");
    }
    let holds = |block: &Vec<usize>| {
        let part = of(block);
        dominates(&part) || is_positive_definite(&part) || (part.nrows() <= LARGEST && p_matrix(&part.map(exact)).is_ok_and(|p| p.holds()))
    };
    blocks.iter().all(holds).then_some("all principal minors of M are positive: those of every irreducible block are")
}

/// Whether m_ii d_i > Σ_{j≠i} |m_ij| d_j for some d > 0, which solves ⟨M⟩d = 1 about.
fn dominates(matrix: &DMatrix<f64>) -> bool {
    let size = matrix.nrows();
    let comparison = DMatrix::from_fn(size, size, |i, j| if i == j { matrix[(i, j)] } else { -matrix[(i, j)].abs() });
    let Some(weights) = comparison.lu().solve(&DVector::from_element(size, 1.0)) else { return false };
    weights.iter().all(|d| *d > 0.0 && d.is_finite()) && dominates_with(matrix, &weights)
}

/// Whether m_ii d_i > Σ_{j≠i} |m_ij| d_j for all i.
fn dominates_with(matrix: &DMatrix<f64>, weights: &DVector<f64>) -> bool {
    (0..matrix.nrows()).all(|i| {
        let others = (0..matrix.nrows()).filter(|j| *j != i && matrix[(i, *j)] != 0.0);
        let (count, sum) = others.fold((0, 0.0), |(count, sum), j| (count + 1, sum + matrix[(i, j)].abs() * weights[j]));
        let above = if count == 0 { 0.0 } else { enlarged(sum, count) };
        (matrix[(i, i)] * weights[i]).next_down() > above
    })
}

/// The irreducible blocks: rows that are connected by entries that are not zero, there and back.
fn irreducible(matrix: &DMatrix<f64>) -> Vec<Vec<usize>> {
    let size = matrix.nrows();
    // Kosaraju: rows in the order in which a search along the entries leaves them, then back from the last one
    let mut order = Vec::with_capacity(size);
    let mut seen = vec![false; size];
    (0..size).for_each(|start| visit(&|i, j| matrix[(i, j)] != 0.0, start, &mut seen, &mut order));
    let (mut blocks, mut seen) = (Vec::new(), vec![false; size]);
    for start in order.into_iter().rev() {
        let mut block = Vec::new();
        visit(&|i, j| matrix[(j, i)] != 0.0, start, &mut seen, &mut block);
        if !block.is_empty() {
            block.sort_unstable();
            blocks.push(block);
        }
    }
    blocks
}

/// Depth first from a row that was not seen, along what is linked; rows are added to `order` when they are left.
fn visit(linked: &impl Fn(usize, usize) -> bool, start: usize, seen: &mut [bool], order: &mut Vec<usize>) {
    if std::mem::replace(&mut seen[start], true) {
        return;
    }
    let mut path = vec![(start, 0)];
    while let Some((row, from)) = path.last_mut() {
        match (*from..seen.len()).find(|j| !seen[*j] && linked(*row, *j)) {
            Some(next) => {
                *from = next + 1;
                seen[next] = true;
                path.push((next, 0));
            }
            None => {
                order.push(*row);
                path.pop();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn triangular_in_some_order_is_seen_at_any_size_and_one_more_entry_undoes_it() {
        for size in [1, 2, 30, 400] {
            let place = |i: usize| (7 * i + 3) % size; // 7 divides none of the sizes
            let mut matrix = DMatrix::zeros(size, size);
            for (i, j) in (0..size).flat_map(|i| (0..=i).map(move |j| (i, j))) {
                matrix[(place(i), place(j))] = if i == j { 0.5 } else { 3.0 };
            }
            assert!(surely_p(&matrix).unwrap().contains("triangular"), "{size}");
            if size > 1 {
                matrix[(place(0), place(size - 1))] = 1.0;
                assert_eq!(surely_p(&matrix), None, "{size}: [[½, 1], [3, ½]] has the minor −2¾");
            }
        }
    }

    #[test]
    fn dominance_is_strict_and_weighted() {
        // the discrete Laplacian, an M-matrix whose plain dominance is not strict
        let laplacian = |size: usize, diagonal: f64| {
            DMatrix::from_fn(size, size, |i, j| match i.abs_diff(j) {
                0 => diagonal,
                1 => {
                    if i > j {
                        -1.0
                    } else {
                        1.0
                    }
                }
                _ => 0.0,
            })
        };
        assert!(surely_p(&laplacian(200, 2.0)).unwrap().contains("dominates"));
        assert_eq!(surely_p(&laplacian(200, 1.9)), None);
        // a cycle whose comparison matrix is singular: on the border, whichever way rounding falls
        let cycle = DMatrix::from_fn(30, 30, |i, j| {
            if i == j {
                1.0
            } else if (i + 1) % 30 == j {
                -1.0
            } else {
                0.0
            }
        });
        assert_eq!(surely_p(&cycle), None);
    }

    #[test]
    fn a_diagonal_that_is_not_positive_and_a_planted_weight_are_refused() {
        assert_eq!(surely_p(&DMatrix::from_element(1, 1, 0.0)), None);
        assert_eq!(surely_p(&DMatrix::from_element(1, 1, f64::NAN)), None);
        let matrix = DMatrix::from_row_slice(2, 2, &[1.0, 3.0, 0.25, 1.0]);
        assert!(dominates(&matrix) && dominates_with(&matrix, &DVector::from_row_slice(&[3.5, 1.0])));
        for wrong in [[1.0, 1.0], [3.0, 1.0], [4.0, 1.0]] {
            assert!(!dominates_with(&matrix, &DVector::from_row_slice(&wrong)), "{wrong:?}");
        }
    }

    proptest! {
        #[test]
        fn what_is_said_to_be_p_has_positive_minors_and_blocks_are_the_strong_components(
            entries in proptest::collection::vec(-3i32..4, 49), size in 1usize..8, zeros in 0i32..4, lift in 0i32..6,
        ) {
            let matrix = DMatrix::from_fn(size, size, |i, j| {
                let entry = entries[7 * i + j];
                f64::from(if i == j { entry.abs() + lift } else if entry.abs() < zeros { 0 } else { entry })
            });
            if surely_p(&matrix).is_some() {
                prop_assert!(p_matrix(&matrix.map(exact)).unwrap().holds(), "{}", matrix);
            }
            // (I + |M|)^n: which rows reach which
            let mut reach = DMatrix::from_fn(size, size, |i, j| i == j || matrix[(i, j)] != 0.0);
            for k in 0..size {
                reach = DMatrix::from_fn(size, size, |i, j| reach[(i, j)] || (reach[(i, k)] && reach[(k, j)]));
            }
            let blocks = irreducible(&matrix);
            let block_of = |i: usize| blocks.iter().position(|block| block.contains(&i));
            prop_assert_eq!(blocks.iter().map(Vec::len).sum::<usize>(), size);
            for (i, j) in (0..size).flat_map(|i| (0..size).map(move |j| (i, j))) {
                prop_assert_eq!(block_of(i) == block_of(j), reach[(i, j)] && reach[(j, i)]);
            }
        }
    }
}
