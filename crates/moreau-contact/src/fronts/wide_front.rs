//! The first columns of a wide dense matrix eliminated, as [`front`](super::front) does it, by the kernels of faer.
//!
//! ```text
//!     ⎡P Q⎤   ⎡L₁₁  ⎤ ⎡U₁₁ U₁₂⎤
//!     ⎣R S⎦ = ⎣L₂₁ 1⎦ ⎣     S'⎦ ,     as many pivots at a time as pass between two looks at the watch
//! ```
//! What is stored, where rows are exchanged and what is refused are the same; numbers differ by rounding, for products are summed in
//! another order.

use crate::tolerance::fronts::BETWEEN_LOOKS;
use crate::watch;
use faer::dyn_stack::{MemStack, StackReq};
use faer::linalg::cholesky::llt;
use faer::linalg::lu::partial_pivoting;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::{matmul, triangular_solve};
use faer::reborrow::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, Par, Spec};
use std::mem::MaybeUninit;

/// Memory that is used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    bytes: Vec<MaybeUninit<u8>>,
    /// Of the rows of pivots, which row comes to each place, and the place to which each comes.
    order: Vec<usize>,
    places: Vec<usize>,
    /// The row at each place, and the place of each row, after some of the exchanges.
    rows: Vec<usize>,
    found: Vec<usize>,
}

fn stack(bytes: &mut Vec<MaybeUninit<u8>>, need: StackReq) -> &mut MemStack {
    bytes.resize(bytes.len().max(need.unaligned_bytes_required()), MaybeUninit::uninit());
    MemStack::new(bytes)
}

/// Rows and columns of a front from `first` on.
fn rest(front: &mut [f64], size: usize, first: usize) -> MatMut<'_, f64> {
    MatMut::from_column_major_slice_with_stride_mut(&mut front[first * size + first..], size - first, size - first, size)
}

/// As [`front::cholesky`](super::front::cholesky).
pub(super) fn cholesky(front: &mut [f64], size: usize, pivots: usize, memory: &mut Memory) -> bool {
    for first in (0..pivots).step_by(BETWEEN_LOOKS) {
        if watch::is_over() {
            return false;
        }
        let count = BETWEEN_LOOKS.min(pivots - first);
        let (mut own, _, mut below, left) = rest(front, size, first).split_at_mut(count, count);
        let stack = stack(&mut memory.bytes, llt::factor::cholesky_in_place_scratch::<f64>(count, Par::Seq, Spec::default()));
        let is_definite = llt::factor::cholesky_in_place(own.rb_mut(), Default::default(), Par::Seq, stack, Spec::default()).is_ok();
        if !is_definite || !(0..count).all(|j| own[(j, j)] > 0.0 && own[(j, j)].is_finite()) {
            return false;
        }
        triangular_solve::solve_lower_triangular_in_place(own.rb(), below.rb_mut().transpose_mut(), Par::Seq);
        let (lower, whole) = (BlockStructure::TriangularLower, BlockStructure::Rectangular);
        triangular::matmul(left, lower, Accum::Add, below.rb(), whole, below.rb().transpose(), whole, -1.0, Par::Seq);
    }
    true
}

/// As [`front::lu`](super::front::lu).
pub(super) fn lu(front: &mut [f64], size: usize, pivots: usize, exchanged: &mut [usize], memory: &mut Memory) -> bool {
    for first in (0..pivots).step_by(BETWEEN_LOOKS) {
        if watch::is_over() {
            return false;
        }
        let (count, rows) = (BETWEEN_LOOKS.min(pivots - first), pivots - first);
        let columns = first..first + count;
        let exchanged = &mut exchanged[columns.clone()];
        if !memory.factor(rest(front, size, first).submatrix_mut(0, 0, rows, count), exchanged) {
            return false;
        }
        for (_, entries) in front.chunks_exact_mut(size).enumerate().filter(|(j, _)| !columns.contains(j)) {
            exchanged.iter().enumerate().for_each(|(j, row)| entries.swap(first + j, first + row));
        }
        exchanged.iter_mut().for_each(|row| *row += first);
        let (own, mut right, mut below, left) = rest(front, size, first).split_at_mut(count, count);
        triangular_solve::solve_unit_lower_triangular_in_place(own.rb(), right.rb_mut(), Par::Seq);
        // the rows of later pivots have their L
        let lowest = below.rb_mut().split_at_row_mut(rows - count).1;
        triangular_solve::solve_lower_triangular_in_place(own.rb().transpose(), lowest.transpose_mut(), Par::Seq);
        matmul::matmul(left, Accum::Add, below.rb(), right.rb(), -1.0, Par::Seq);
    }
    true
}

impl Memory {
    /// L and U of columns with at least as many rows; which row took the place of each.
    fn factor(&mut self, mut columns: MatMut<'_, f64>, exchanged: &mut [usize]) -> bool {
        let (rows, count) = columns.shape();
        [&mut self.order, &mut self.places].into_iter().for_each(|list| list.resize(rows, 0));
        let need = partial_pivoting::factor::lu_in_place_scratch::<usize, f64>(rows, count, Par::Seq, Spec::default());
        let (stack, order, places) = (stack(&mut self.bytes, need), &mut self.order, &mut self.places);
        partial_pivoting::factor::lu_in_place(columns.rb_mut(), order, places, Par::Seq, stack, Spec::default());
        self.read_exchanges(rows, exchanged);
        (0..count).all(|j| columns[(j, j)] != 0.0 && columns[(j, j)].is_finite())
    }

    /// The exchanges, one after the other, that bring rows into this order.
    fn read_exchanges(&mut self, rows: usize, exchanged: &mut [usize]) {
        for list in [&mut self.rows, &mut self.found] {
            list.clear();
            list.extend(0..rows);
        }
        for (j, exchanged) in exchanged.iter_mut().enumerate() {
            *exchanged = self.found[self.order[j]];
            self.rows.swap(j, *exchanged);
            (self.found[self.rows[*exchanged]], self.found[self.rows[j]]) = (*exchanged, j);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fronts::front::{self, own_cholesky, own_lu, tests::matrix};
    use nalgebra::DMatrix;

    /// Sizes and pivots, around what passes between two looks.
    const FRONTS: [(usize, usize); 7] = [(48, 6), (130, 127), (130, 128), (140, 129), (260, 257), (300, 140), (300, 300)];

    #[test]
    fn factors_and_what_is_left_are_those_of_our_own_elimination() {
        for (size, pivots) in FRONTS {
            let general = matrix(size, size as u64);
            let definite = &general * general.transpose() + DMatrix::identity(size, size);
            let bound = |scale: f64| moreau_exact::tolerance::rounding(8 * size, scale);
            let limit = bound(size as f64 * definite.amax());
            let [mut own, mut wide] = [(); 2].map(|()| definite.as_slice().to_vec());
            assert!(own_cholesky(&mut own, size, pivots) && cholesky(&mut wide, size, pivots, &mut Memory::default()));
            for j in 0..size {
                for i in j..size {
                    let off = (own[j * size + i] - wide[j * size + i]).abs();
                    assert!(off <= limit, "{size} {pivots}: {i} {j} {off:e}");
                }
            }
            let [mut own, mut wide] = [(); 2].map(|()| general.as_slice().to_vec());
            let [mut of_own, mut of_wide] = [(); 2].map(|()| vec![0; pivots]);
            assert!(own_lu(&mut own, size, pivots, &mut of_own, &mut front::Memory::default()));
            assert!(lu(&mut wide, size, pivots, &mut of_wide, &mut Memory::default()));
            assert_eq!(of_own, of_wide, "{size} {pivots}");
            let growth = general.view((0, 0), (pivots, pivots)).into_owned().try_inverse().expect("regular").amax().max(1.0);
            let off = own.iter().zip(&wide).map(|(own, wide)| (own - wide).abs()).fold(0.0, f64::max);
            assert!(off <= bound(growth * size as f64), "{size} {pivots}: {off:e}");
        }
    }

    #[test]
    fn a_wide_front_without_pivot_is_told_and_one_is_left_where_the_solver_was_ended() {
        for (size, pivots) in FRONTS {
            for bad in [0, 5, pivots - 1] {
                for entry in [0.0, -1.0, f64::NAN] {
                    let mut diagonal = DMatrix::<f64>::identity(size, size);
                    diagonal[(bad, bad)] = entry;
                    let [mut definite, mut general] = [(); 2].map(|()| diagonal.as_slice().to_vec());
                    assert!(!cholesky(&mut definite, size, pivots, &mut Memory::default()), "{size} {pivots} {bad} {entry}");
                    let is_regular = lu(&mut general, size, pivots, &mut vec![0; pivots], &mut Memory::default());
                    assert_eq!(is_regular, entry == -1.0, "{size} {pivots} {bad} {entry}");
                }
            }
        }
        let interrupt = watch::Interrupt::default();
        interrupt.now();
        let mut one = DMatrix::<f64>::identity(50, 50);
        let mut memory = Memory::default();
        let mut both = || (cholesky(one.as_mut_slice(), 50, 50, &mut memory), lu(one.as_mut_slice(), 50, 50, &mut [0; 50], &mut memory));
        assert_eq!(both(), (true, true));
        assert_eq!(watch::watched(&interrupt, &mut both).0, (false, false));
    }
}
