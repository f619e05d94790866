//! The first columns of a dense matrix eliminated, column by column in memory.
//!
//! ```text
//!     F = ⎡P Q⎤ = ⎡L₁₁  ⎤ ⎡U₁₁ U₁₂⎤ ,     S ← S − R P⁻¹ Q ;     symmetric: U = Lᵀ, and only the lower triangle is touched
//!         ⎣R S⎦   ⎣L₂₁ 1⎦ ⎣     S'⎦
//! ```
//! Panels of columns are eliminated one after the other, within them a few columns at a time, and the rest of the front is updated by a
//! matrix product. Rows are exchanged for
//! the largest pivot among the pivot rows only: what lies below belongs to other fronts. Where faer is compiled in, its kernels do the
//! same to wide fronts: `wide_front.rs`.

#[cfg(feature = "faer")]
use super::wide_front;
#[cfg(feature = "faer")]
use crate::tolerance::fronts::WIDE;
use crate::tolerance::fronts::{COLUMNS, PANEL, SMALL_PRODUCT, STRIP};
use crate::watch;
use nalgebra::{DMatrixView, DMatrixViewMut};

/// What eliminating uses again.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    copied: Vec<f64>,
    #[cfg(feature = "faer")]
    wide: wide_front::Memory,
}

/// C ← C − A B of m × n entries with k terms; A and C have columns of length `size`, B any strides.
fn subtract(c: &mut [f64], [m, n, k]: [usize; 3], size: usize, a: &[f64], b: &[f64], strides: [usize; 2]) {
    if m == 0 || n == 0 || k == 0 {
        return;
    }
    if k >= SMALL_PRODUCT.0 && m * n >= SMALL_PRODUCT.1 {
        let a = DMatrixView::from_slice_with_strides(a, m, k, 1, size);
        let b = DMatrixView::from_slice_with_strides(b, k, n, strides[0], strides[1]);
        DMatrixViewMut::from_slice_with_strides_mut(c, m, n, 1, size).gemm(-1.0, &a, &b, 1.0);
        return;
    }
    const { assert!(COLUMNS == 4, "some numbers of terms would be left out") };
    for p in (0..k).step_by(COLUMNS) {
        let (a, b) = (&a[p * size..], |q: usize, j: usize| b[(p + q) * strides[0] + j * strides[1]]);
        match k - p {
            1 => subtract_terms::<1>(c, [m, n], size, a, b),
            2 => subtract_terms::<2>(c, [m, n], size, a, b),
            3 => subtract_terms::<3>(c, [m, n], size, a, b),
            _ => subtract_terms::<COLUMNS>(c, [m, n], size, a, b),
        }
    }
}

/// [`subtract`] of N terms: [`COLUMNS`] of them are added up before, fewer are subtracted one after the other.
#[inline]
fn subtract_terms<const N: usize>(c: &mut [f64], [m, n]: [usize; 2], size: usize, a: &[f64], b: impl Fn(usize, usize) -> f64) {
    let mut columns = [&a[..m]; N];
    (1..N).for_each(|q| columns[q] = &a[q * size..q * size + m]);
    for j in 0..n {
        let mut factors = [0.0; N];
        (0..N).for_each(|q| factors[q] = b(q, j));
        for (i, entry) in c[j * size..j * size + m].iter_mut().enumerate() {
            if N == COLUMNS {
                let first = columns[0][i] * factors[0];
                *entry -= (1..N).fold(first, |sum, q| sum + columns[q][i] * factors[q]);
            } else {
                *entry = (0..N).fold(*entry, |left, q| left - columns[q][i] * factors[q]);
            }
        }
    }
}

/// L of the first `pivots` columns of a symmetric front of which the lower triangle is given; false where a pivot is not positive, or
/// whoever watches the solver ended it.
pub(super) fn cholesky(front: &mut [f64], size: usize, pivots: usize, memory: &mut Memory) -> bool {
    #[cfg(feature = "faer")]
    if size >= WIDE {
        return wide_front::cholesky(front, size, pivots, &mut memory.wide);
    }
    let _ = memory;
    own_cholesky(front, size, pivots)
}

/// [`cholesky`] of any front by our own products.
pub(super) fn own_cholesky(front: &mut [f64], size: usize, pivots: usize) -> bool {
    let mut first = 0;
    while first < pivots {
        if watch::is_over() {
            return false;
        }
        let end = (first + PANEL).min(pivots);
        for j in first..end {
            let (left, right) = front.split_at_mut((j + 1) * size);
            let column = &mut left[j * size..];
            if column[j] <= 0.0 || !column[j].is_finite() {
                return false;
            }
            let inverse = 1.0 / column[j].sqrt();
            column[j..].iter_mut().for_each(|entry| *entry *= inverse);
            for (other, target) in right.chunks_exact_mut(size).take(end - j - 1).enumerate() {
                let (from, factor) = (j + 1 + other, column[j + 1 + other]);
                target[from..].iter_mut().zip(&column[from..]).for_each(|(entry, above)| *entry -= above * factor);
            }
        }
        let (left, right) = front.split_at_mut(end * size);
        for strip in (end..size).step_by(STRIP) {
            let (a, wide) = (&left[first * size + strip..], STRIP.min(size - strip));
            let target = &mut right[(strip - end) * size + strip..];
            subtract(target, [size - strip, wide, end - first], size, a, a, [size, 1]);
        }
        first = end;
    }
    true
}

/// L (unit diagonal) and U of the first `pivots` columns; `exchanged[j]` is the row that took the place of row j. False where no pivot is
/// left that is a number other than zero, or whoever watches the solver ended it.
pub(super) fn lu(front: &mut [f64], size: usize, pivots: usize, exchanged: &mut [usize], memory: &mut Memory) -> bool {
    #[cfg(feature = "faer")]
    if size >= WIDE {
        return wide_front::lu(front, size, pivots, exchanged, &mut memory.wide);
    }
    own_lu(front, size, pivots, exchanged, memory)
}

/// [`lu`] of any front by our own products.
pub(super) fn own_lu(front: &mut [f64], size: usize, pivots: usize, exchanged: &mut [usize], memory: &mut Memory) -> bool {
    let (mut first, copied) = (0, &mut memory.copied);
    while first < pivots {
        if watch::is_over() {
            return false;
        }
        let end = (first + PANEL).min(pivots);
        for begin in (first..end).step_by(COLUMNS) {
            let last = (begin + COLUMNS).min(end);
            for j in begin..last {
                let entry = |i: usize| front[j * size + i].abs();
                let pivot = (j + 1..pivots).fold(j, |best, i| if entry(i) > entry(best) { i } else { best });
                exchanged[j] = pivot;
                if pivot != j {
                    front.chunks_exact_mut(size).for_each(|column| column.swap(j, pivot));
                }
                let (left, right) = front.split_at_mut((j + 1) * size);
                let column = &mut left[j * size..];
                if column[j] == 0.0 || !column[j].is_finite() {
                    return false;
                }
                let inverse = 1.0 / column[j];
                column[j + 1..].iter_mut().for_each(|entry| *entry *= inverse);
                for target in right.chunks_exact_mut(size).take(last - j - 1) {
                    let factor = target[j];
                    target[j + 1..].iter_mut().zip(&column[j + 1..]).for_each(|(entry, l)| *entry -= l * factor);
                }
            }
            update(front, size, [begin, last, end], copied);
        }
        update(front, size, [first, end, size], copied);
        first = end;
    }
    true
}

/// Subtracts from the columns end .. limit what the eliminated columns first .. end do to them.
fn update(front: &mut [f64], size: usize, [first, end, limit]: [usize; 3], copied: &mut Vec<f64>) {
    let (left, right) = front.split_at_mut(end * size);
    copied.clear();
    for target in right.chunks_exact_mut(size).take(limit - end) {
        forward(left, size, [first, end], target);
        copied.extend_from_slice(&target[first..end]);
    }
    if limit > end {
        let sizes = [size - end, limit - end, end - first];
        subtract(&mut right[end..], sizes, size, &left[first * size + end..], copied, [1, end - first]);
    }
}

/// Solves with the unit lower triangle of the columns first .. end in place, a few of them at a time.
#[inline]
fn forward(lower: &[f64], size: usize, [first, end]: [usize; 2], x: &mut [f64]) {
    let mut begin = first;
    while begin < end {
        let last = (begin + COLUMNS).min(end);
        match last - begin {
            2 => forward_within::<2>(lower, size, begin, x),
            3 => forward_within::<3>(lower, size, begin, x),
            COLUMNS => forward_within::<COLUMNS>(lower, size, begin, x),
            _ => {}
        }
        if last < end {
            let (known, rest) = x.split_at_mut(last);
            subtract(&mut rest[..end - last], [end - last, 1, last - begin], size, &lower[begin * size + last..], &known[begin..], [1, 0]);
        }
        begin = last;
    }
}

/// The same with N columns that follow each other.
#[inline]
fn forward_within<const N: usize>(lower: &[f64], size: usize, begin: usize, x: &mut [f64]) {
    let x: &mut [f64; N] = x[begin..].first_chunk_mut().expect("as many entries as columns");
    for j in 0..N - 1 {
        let column: &[f64; N] = lower[(begin + j) * size + begin..].first_chunk().expect("as many entries as columns");
        let known = x[j];
        (j + 1..N).for_each(|i| x[i] -= column[i] * known);
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use nalgebra::DMatrix;

    pub(in crate::fronts) fn matrix(size: usize, seed: u64) -> DMatrix<f64> {
        let mut state = seed;
        DMatrix::from_fn(size, size, |_, _| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / (1u64 << 30) as f64 - 1.0
        })
    }

    /// S − R P⁻¹ Q by nalgebra's LU.
    fn complement(matrix: &DMatrix<f64>, pivots: usize) -> DMatrix<f64> {
        let rest = matrix.nrows() - pivots;
        let part = |i: usize, j: usize, m: usize, n: usize| matrix.view((i, j), (m, n)).into_owned();
        let solved = part(0, 0, pivots, pivots).lu().solve(&part(0, pivots, pivots, rest)).expect("regular");
        part(pivots, pivots, rest, rest) - part(pivots, 0, rest, pivots) * solved
    }

    #[test]
    fn what_is_left_is_the_schur_complement() {
        for (size, pivots) in [(1, 1), (3, 1), (7, 4), (60, 30), (130, 70), (131, 131)] {
            let general = matrix(size, size as u64);
            let definite = &general * general.transpose() + DMatrix::identity(size, size);
            let (mut front, mut exchanged, mut memory) = (general.as_slice().to_vec(), vec![0; pivots], Memory::default());
            assert!(lu(&mut front, size, pivots, &mut exchanged, &mut memory));
            let rest = |front: &[f64]| {
                DMatrix::from_column_slice(size, size, front).view((pivots, pivots), (size - pivots, size - pivots)).into_owned()
            };
            let expected = complement(&general, pivots);
            let growth = general.view((0, 0), (pivots, pivots)).into_owned().try_inverse().expect("regular").amax().max(1.0);
            let bound = |scale: f64| moreau_exact::tolerance::rounding(8 * size, scale);
            assert!((rest(&front) - &expected).amax() <= bound(growth * size as f64), "{size} {pivots}");
            let mut front = definite.as_slice().to_vec();
            assert!(cholesky(&mut front, size, pivots, &mut memory));
            let expected = complement(&definite, pivots);
            let found = rest(&front);
            for j in 0..size - pivots {
                for i in j..size - pivots {
                    assert!((found[(i, j)] - expected[(i, j)]).abs() <= bound(definite.amax() * size as f64), "{size} {pivots}");
                }
            }
        }
    }

    #[test]
    fn a_front_is_left_where_the_solver_was_ended() {
        let interrupt = watch::Interrupt::default();
        let (mut exchanged, mut memory) = (vec![0; 2], Memory::default());
        let mut both =
            || (cholesky(&mut [2.0, 1.0, 1.0, 2.0], 2, 2, &mut memory), lu(&mut [2.0, 1.0, 1.0, 2.0], 2, 2, &mut exchanged, &mut memory));
        assert_eq!(watch::watched(&interrupt, &mut both).0, (true, true));
        interrupt.now();
        let (ended, seen) = watch::watched(&interrupt, &mut both);
        assert!(ended == (false, false) && seen.interrupted);
    }

    #[test]
    fn a_front_without_pivot_is_told() {
        let (mut exchanged, mut memory) = (vec![0; 2], Memory::default());
        assert!(!lu(&mut [1.0, 2.0, 2.0, 4.0], 2, 2, &mut exchanged, &mut memory), "singular");
        assert!(lu(&mut [0.0, 2.0, 4.0, 0.0], 2, 2, &mut exchanged, &mut memory), "an exchange of rows");
        assert!(!lu(&mut [f64::NAN; 4], 2, 2, &mut exchanged, &mut memory));
        assert!(!cholesky(&mut [1.0, 2.0, 2.0, 1.0], 2, 2, &mut memory), "indefinite");
        assert!(!cholesky(&mut [f64::NAN; 4], 2, 2, &mut memory));
    }
}
