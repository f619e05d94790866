//! W as the square matrix of all its entries.

use super::ContactOperator;
use nalgebra::DMatrix;

impl ContactOperator for DMatrix<f64> {
    fn diagonal_block(&self, contact: usize, block: &mut [f64]) {
        let (rows, size) = (block.len().isqrt(), self.nrows());
        for (column, entries) in block.chunks_exact_mut(rows.max(1)).enumerate() {
            let first = (contact * rows + column) * size + contact * rows;
            entries.copy_from_slice(&self.as_slice()[first..first + rows]);
        }
    }

    fn add_product(&self, impulse: &[f64], velocity: &mut [f64]) {
        self.add_contact(0, impulse, velocity);
    }

    fn add_magnitudes(&self, impulse: &[f64], sums: &mut [f64]) {
        for (column, r) in impulse.iter().enumerate().filter(|(_, r)| **r != 0.0) {
            sums.iter_mut().zip(self.column(column).iter()).for_each(|(sum, w)| *sum += w.abs() * r.abs());
        }
    }

    fn add_contact(&self, contact: usize, impulse: &[f64], velocity: &mut [f64]) {
        for (column, r) in (contact * impulse.len()..).zip(impulse).filter(|(_, r)| **r != 0.0) {
            velocity.iter_mut().zip(self.column(column).iter()).for_each(|(u, w)| *u += r * w);
        }
    }

    fn bodies(&self, _contact: usize) -> Option<&[u32]> {
        None
    }

    fn terms(&self) -> usize {
        self.ncols()
    }
}
