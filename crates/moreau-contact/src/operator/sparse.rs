//! A sparse matrix as a list of its entries.

/// A sparse matrix, entry by entry (row, column, value), each place at most once.
#[derive(Clone, Debug, PartialEq)]
pub struct Sparse {
    /// Numbers of rows and columns.
    pub shape: [usize; 2],
    /// Its entries that are not zero.
    pub entries: Vec<(usize, usize, f64)>,
}

impl Sparse {
    /// Rows and columns exchanged.
    pub fn transposed(self) -> Self {
        let entries = self.entries.into_iter().map(|(i, j, value)| (j, i, value)).collect();
        Sparse { shape: [self.shape[1], self.shape[0]], entries }
    }
}
