//! W as the square matrix of all its entries.

use super::ContactOperator;
use nalgebra::DMatrix;

/// A column as it lies in memory: an iterator of the matrix's own takes the processor several times as long.
#[inline(always)]
fn entries(matrix: &DMatrix<f64>, column: usize) -> &[f64] {
    let size = matrix.nrows();
    &matrix.as_slice()[column * size..(column + 1) * size]
}

impl ContactOperator for DMatrix<f64> {
    fn diagonal_block(&self, contact: usize, block: &mut [f64]) {
        let rows = block.len().isqrt();
        for (column, own) in block.chunks_exact_mut(rows.max(1)).enumerate() {
            own.copy_from_slice(&entries(self, contact * rows + column)[contact * rows..(contact + 1) * rows]);
        }
    }

    fn add_product(&self, impulse: &[f64], velocity: &mut [f64]) {
        self.add_contact(0, impulse, velocity);
    }

    fn add_magnitudes(&self, impulse: &[f64], sums: &mut [f64]) {
        for (column, r) in impulse.iter().enumerate().filter(|(_, r)| **r != 0.0) {
            sums.iter_mut().zip(entries(self, column)).for_each(|(sum, w)| *sum += w.abs() * r.abs());
        }
    }

    fn add_contact(&self, contact: usize, impulse: &[f64], velocity: &mut [f64]) {
        for (column, r) in (contact * impulse.len()..).zip(impulse).filter(|(_, r)| **r != 0.0) {
            velocity.iter_mut().zip(entries(self, column)).for_each(|(u, w)| *u += r * w);
        }
    }

    fn bodies(&self, _contact: usize) -> Option<&[u32]> {
        None
    }

    fn write_terms(&self, terms: &mut [usize]) {
        let rows = self.nrows() / terms.len().max(1);
        terms.fill(rows);
        for k in 0..terms.len() {
            let columns = || (k * rows..(k + 1) * rows).map(|column| entries(self, column));
            let joined = |j: usize| columns().any(|column| column[j * rows..(j + 1) * rows].iter().any(|w| *w != 0.0));
            terms.iter_mut().enumerate().filter(|(j, _)| *j != k && joined(*j)).for_each(|(_, terms)| *terms += rows);
        }
    }
}
