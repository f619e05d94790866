//! A sparse matrix as a list of its entries.

use nalgebra::DMatrix;

/// A sparse matrix, entry by entry (row, column, value), each place at most once.
#[derive(Clone, Debug, PartialEq)]
pub struct Sparse {
    /// Numbers of rows and columns.
    pub shape: [usize; 2],
    /// Its entries that are not zero.
    pub entries: Vec<(usize, usize, f64)>,
}

impl Sparse {
    /// The entries of a dense matrix that are not zero.
    pub fn of(dense: &DMatrix<f64>) -> Self {
        let places = (0..dense.ncols()).flat_map(|j| (0..dense.nrows()).map(move |i| (i, j)));
        let entries = places.map(|(i, j)| (i, j, dense[(i, j)])).filter(|(.., value)| *value != 0.0).collect();
        Sparse { shape: [dense.nrows(), dense.ncols()], entries }
    }

    /// The matrix with all its zeros.
    pub(crate) fn to_dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.shape[0], self.shape[1]);
        self.entries.iter().for_each(|(i, j, value)| dense[(*i, *j)] = *value);
        dense
    }

    /// Rows and columns exchanged.
    pub fn transposed(self) -> Self {
        let entries = self.entries.into_iter().map(|(i, j, value)| (j, i, value)).collect();
        Sparse { shape: [self.shape[1], self.shape[0]], entries }
    }
}
