//! A x = b of a few rows on the stack, by Gaussian elimination with partial pivoting.

/// Columns that the processor takes at once; M is a multiple of it.
const GROUP: usize = 4;

/// Replaces b by the x with A x = b, of the first `size` rows and columns; `None` if a pivot is zero or no number. Rows are exchanged, and
/// zeros passed over. A group of columns is taken whole: what stands left of the pivot in it is not read any more.
pub(super) fn eliminate<const M: usize>(matrix: &mut [[f64; M]; M], x: &mut [f64; M], size: usize) -> Option<()> {
    const { assert!(M.is_multiple_of(GROUP), "the last columns would be left out") };
    for k in 0..size {
        let larger = |best: usize, row: usize| if matrix[row][k].abs() > matrix[best][k].abs() { row } else { best };
        let pivot = (k + 1..size).fold(k, larger);
        if pivot != k {
            matrix.swap(k, pivot);
            x.swap(k, pivot);
        }
        let (above, below) = matrix.split_at_mut(k + 1);
        let row = &above[k];
        if !(row[k] != 0.0 && row[k].is_finite()) {
            return None;
        }
        let (inverse, top, groups) = (1.0 / row[k], x[k], (k + 1) / GROUP..size.div_ceil(GROUP));
        let row = row.as_chunks::<GROUP>().0.get(groups.clone()).unwrap_or_default();
        for (other, right) in below[..size - k - 1].iter_mut().zip(&mut x[k + 1..size]).filter(|(other, _)| other[k] != 0.0) {
            let factor = other[k] * inverse;
            for (entries, above) in other.as_chunks_mut::<GROUP>().0[groups.clone()].iter_mut().zip(row) {
                (0..GROUP).for_each(|place| entries[place] -= factor * above[place]);
            }
            *right -= factor * top;
        }
    }
    for k in (0..size).rev() {
        let row = &matrix[k];
        let known: f64 = row[k + 1..size].iter().zip(&x[k + 1..size]).map(|(entry, x)| entry * x).sum();
        x[k] = (x[k] - known) / row[k];
    }
    Some(())
}
