//! H in a file, row by row, of every row only the entries that are not zero.

use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Rows of a sparse matrix, one after the other.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "SparseRows")]
pub(super) struct SparseRows {
    /// Row i has the entries starts\[i\] up to starts\[i + 1\]: one number more than there are rows.
    pub(super) starts: Vec<usize>,
    /// Their columns, counted from 0, each at most once in a row.
    pub(super) column: Vec<usize>,
    /// The entries.
    pub(super) value: Vec<f64>,
}

impl SparseRows {
    pub(super) fn entries(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row]..self.starts[row + 1]
    }

    pub(super) fn check(&self, rows: usize, columns: usize) -> Result<()> {
        let invalid =
            |field: &str, problem: String, cure: String| Err(Error::invalid(format!("jacobian.sparse_rows{field}"), problem, cure));
        let count = self.value.len();
        if self.column.len() != count || self.starts.len() != rows + 1 {
            let problem = format!(
                "has {}, {} and {count}",
                counted(self.starts.len(), "start"),
                counted(self.column.len(), "column"),
                count = counted(count, "value")
            );
            return invalid("", problem, format!("give {}, and a column for each value", counted(rows + 1, "start")));
        }
        if self.starts[0] != 0 || self.starts[rows] != count || self.starts.windows(2).any(|pair| pair[0] > pair[1]) {
            return invalid(
                ".starts",
                "do not grow from 0 to the number of values".into(),
                "give where each row begins, and the end".into(),
            );
        }
        if let Some(place) = self.column.iter().position(|column| *column >= columns) {
            let problem = format!("is {}", self.column[place]);
            return invalid(&format!(".column[{place}]"), problem, format!("use an index below {columns}; indices count from 0"));
        }
        let mut seen = vec![usize::MAX; columns];
        for row in 0..rows {
            for column in &self.column[self.entries(row)] {
                if std::mem::replace(&mut seen[*column], row) == row {
                    return invalid("", format!("repeats the place ({row}, {column})"), "add the values up and give it once".into());
                }
            }
        }
        Ok(())
    }
}
