//! A matrix in a file: row by row, or its entries that are not zero.

use crate::tolerance::problem::DENSE_ENTRIES;
use moreau_exact::{Error, Result};
use nalgebra::DMatrix;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A matrix: all its rows, or its entries that are not zero.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Matrix", extend("oneOf" = [{"required": ["rows"]}, {"required": ["triplets"]}]))]
pub(super) struct MatrixFile {
    /// Numbers of rows and columns.
    pub(super) shape: [usize; 2],
    /// Row by row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    rows: Option<Vec<Vec<f64>>>,
    /// Entry by entry, each place at most once.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) triplets: Option<Triplets>,
}

/// Places, counted from 0, and values.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Triplets {
    /// Rows of the entries.
    row: Vec<usize>,
    /// Their columns.
    column: Vec<usize>,
    /// The entries.
    pub(super) value: Vec<f64>,
}

impl MatrixFile {
    pub(super) fn dense(matrix: &DMatrix<f64>) -> Self {
        let rows = matrix.row_iter().map(|row| row.iter().copied().collect()).collect();
        MatrixFile { shape: [matrix.nrows(), matrix.ncols()], rows: Some(rows), triplets: None }
    }

    pub(super) fn read(self, field: &str) -> Result<DMatrix<f64>> {
        let [nrows, ncols] = self.shape;
        match (self.rows, self.triplets) {
            (Some(rows), None) => {
                if rows.len() != nrows {
                    return Err(Error::invalid(
                        format!("{field}.rows"),
                        format!("has {} rows", rows.len()),
                        format!("give {nrows} rows, as `shape` says"),
                    ));
                }
                if let Some(k) = rows.iter().position(|row| row.len() != ncols) {
                    let problem = format!("has {} entries", rows[k].len());
                    return Err(Error::invalid(format!("{field}.rows[{k}]"), problem, format!("give {ncols} entries, as `shape` says")));
                }
                Ok(DMatrix::from_row_iterator(nrows, ncols, rows.into_iter().flatten()))
            }
            (None, Some(triplets)) => triplets.read(field, nrows, ncols),
            _ => Err(Error::invalid(field, "has both or neither of `rows` and `triplets`", "give one of the two")),
        }
    }
}

impl Triplets {
    fn read(self, field: &str, nrows: usize, ncols: usize) -> Result<DMatrix<f64>> {
        let count = self.value.len();
        if self.row.len() != count || self.column.len() != count {
            let problem = format!("has {} rows, {} columns and {count} values", self.row.len(), self.column.len());
            return Err(Error::invalid(format!("{field}.triplets"), problem, "give three lists of one length"));
        }
        if nrows.saturating_mul(ncols) > DENSE_ENTRIES {
            let problem = format!("has shape {nrows}×{ncols}");
            return Err(Error::invalid(field, problem, format!("use at most {DENSE_ENTRIES} entries: a matrix is stored dense")));
        }
        let mut seen = std::collections::HashSet::with_capacity(count);
        let mut matrix = DMatrix::zeros(nrows, ncols);
        for (k, ((&i, &j), &value)) in self.row.iter().zip(&self.column).zip(&self.value).enumerate() {
            for (name, index, size) in [("row", i, nrows), ("column", j, ncols)] {
                if index >= size {
                    let cure = format!("use an index below {size}, as `shape` says; indices count from 0");
                    return Err(Error::invalid(format!("{field}.triplets.{name}[{k}]"), format!("is {index}"), cure));
                }
            }
            if !seen.insert((i, j)) {
                let problem = format!("repeats the place ({i}, {j})");
                return Err(Error::invalid(format!("{field}.triplets"), problem, "add the values up and give the place once"));
            }
            matrix[(i, j)] = value;
        }
        Ok(matrix)
    }
}
