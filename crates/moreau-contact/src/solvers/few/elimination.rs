//! A x = b of a few rows on the stack, by Gaussian elimination with partial pivoting.

/// Columns that the processor takes at once; M is a multiple of it.
const GROUP: usize = 4;

/// How the rows were exchanged, for another right side; the factors stand in the matrix they were made of.
pub(super) struct Eliminated<const M: usize> {
    exchanged: [usize; M],
    /// The least pivot, by its size.
    pub least: f64,
}

/// Replaces b by the x with A x = b, of the first `size` rows and columns, and A by its factors; `None` if a pivot is zero or no number.
/// Rows are exchanged, and zeros passed over. A group of columns is taken whole: in the first of them the row above is zero up to its
/// pivot, so that the multipliers stay, which take the place of what they eliminate.
pub(super) fn eliminate<const M: usize>(matrix: &mut [[f64; M]; M], x: &mut [f64; M], size: usize) -> Option<Eliminated<M>> {
    const { assert!(M.is_multiple_of(GROUP), "the last columns would be left out") };
    let mut found = Eliminated { exchanged: [0; M], least: f64::INFINITY };
    for k in 0..size {
        let larger = |best: usize, row: usize| if matrix[row][k].abs() > matrix[best][k].abs() { row } else { best };
        let pivot = (k + 1..size).fold(k, larger);
        found.exchanged[k] = pivot;
        if pivot != k {
            matrix.swap(k, pivot);
            x.swap(k, pivot);
        }
        let (above, below) = matrix.split_at_mut(k + 1);
        let row = &above[k];
        if !(row[k] != 0.0 && row[k].is_finite()) {
            return None;
        }
        found.least = found.least.min(row[k].abs());
        let (inverse, top, first) = (1.0 / row[k], x[k], (k + 1) / GROUP);
        let (mut begun, groups) = (*row, first..size.div_ceil(GROUP));
        begun[first * GROUP..(k + 1).max(first * GROUP)].fill(0.0);
        let row = begun.as_chunks::<GROUP>().0.get(groups.clone()).unwrap_or_default();
        for (other, right) in below[..size - k - 1].iter_mut().zip(&mut x[k + 1..size]).filter(|(other, _)| other[k] != 0.0) {
            let factor = other[k] * inverse;
            other[k] = factor;
            for (entries, above) in other.as_chunks_mut::<GROUP>().0[groups.clone()].iter_mut().zip(row) {
                *entries = std::array::from_fn(|place| entries[place] - factor * above[place]);
            }
            *right -= factor * top;
        }
    }
    for k in (0..size).rev() {
        let row = &matrix[k];
        let known: f64 = row[k + 1..size].iter().zip(&x[k + 1..size]).map(|(entry, x)| entry * x).sum();
        x[k] = (x[k] - known) / row[k];
    }
    Some(found)
}

impl<const M: usize> Eliminated<M> {
    /// Replaces another b by its x, given the factors that [`eliminate`] left.
    pub(super) fn solve(&self, factors: &[[f64; M]; M], x: &mut [f64; M], size: usize) {
        for (k, pivot) in self.exchanged[..size].iter().enumerate() {
            x.swap(k, *pivot);
        }
        for k in 1..size {
            x[k] -= product(&factors[k][..k], &x[..k]);
        }
        for k in (0..size).rev() {
            x[k] = (x[k] - product(&factors[k][k + 1..size], &x[k + 1..size])) / factors[k][k];
        }
    }
}

/// aᵀ b, summed in groups so that no term waits for the one before.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let ((grouped_a, rest_a), (grouped_b, rest_b)) = (a.as_chunks::<GROUP>(), b.as_chunks::<GROUP>());
    let mut sums = [0.0; GROUP];
    for (a, b) in grouped_a.iter().zip(grouped_b) {
        (0..GROUP).for_each(|place| sums[place] += a[place] * b[place]);
    }
    let rest: f64 = rest_a.iter().zip(rest_b).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}
