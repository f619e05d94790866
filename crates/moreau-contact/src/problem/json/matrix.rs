//! A matrix in a file: row by row, its entries that are not zero, or – W alone – its blocks that are not zero. A mass and a Jacobian by
//! bodies are blocks on the diagonal and sparse rows.

use super::sparse_rows::SparseRows;
use crate::operator::{BlockSparse, Operator, Sparse};
use crate::tolerance::problem::{DENSE_ENTRIES, DENSE_ROWS, NUMBERS_OF_AN_ENTRY};
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::DMatrix;
use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::marker::PhantomData;

/// A matrix: all its rows, its entries that are not zero, blocks of contacts that meet (W) or of bodies (M̂), or sparse rows (H).
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Matrix", extend("oneOf" = [{"required": ["rows"]}, {"required": ["triplets"]},
    {"required": ["blocks"]}, {"required": ["diagonal_blocks"]}, {"required": ["sparse_rows"]}]))]
pub(super) struct MatrixFile {
    /// Numbers of rows and columns.
    pub(super) shape: [usize; 2],
    /// Row by row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) rows: Option<Vec<Vec<f64>>>,
    /// Entry by entry, each place at most once.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) triplets: Option<Triplets>,
    /// Block by block, of W only, each place at most once.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) blocks: Option<BlocksFile>,
    /// Of the mass only: the blocks M_b \[kg\] of all bodies, each symmetric, one after the other along the diagonal, row by row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) diagonal_blocks: Option<Vec<Vec<f64>>>,
    /// Of the Jacobian only, with a mass of diagonal blocks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) sparse_rows: Option<SparseRows>,
}

/// A matrix that is stored whole: all its rows, or its entries that are not zero.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{"required": ["rows"]}, {"required": ["triplets"]}]))]
pub(super) struct PlainMatrix {
    /// Numbers of rows and columns.
    pub(super) shape: [usize; 2],
    /// Row by row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    rows: Option<Vec<Vec<f64>>>,
    /// Entry by entry, each place at most once.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    triplets: Option<Triplets>,
}

impl PlainMatrix {
    pub(super) fn read(self, field: &str) -> Result<DMatrix<f64>> {
        if self.rows.is_some() == self.triplets.is_some() {
            return Err(Error::invalid(field, "has none of its forms, or both", "give one of `rows` and `triplets`"));
        }
        MatrixFile { rows: self.rows, triplets: self.triplets, ..MatrixFile::empty(self.shape) }.read(field)
    }
}

/// Reads a matrix by the names of its parts. Without this a list would be taken for them in their order, and a list of rows refused by what
/// its first number is not.
pub(super) fn named<'de, D: Deserializer<'de>, T: Deserialize<'de>>(input: D) -> std::result::Result<Option<T>, D::Error> {
    struct Parts<T>(PhantomData<T>);
    impl<'de, T: Deserialize<'de>> Visitor<'de> for Parts<T> {
        type Value = Option<T>;

        fn expecting(&self, text: &mut std::fmt::Formatter) -> std::fmt::Result {
            text.write_str(r#"a matrix as {"shape": [2, 2], "rows": [[1, 0], [0, 1]]}"#)
        }

        fn visit_unit<E>(self) -> std::result::Result<Self::Value, E> {
            Ok(None)
        }

        fn visit_map<A: MapAccess<'de>>(self, parts: A) -> std::result::Result<Self::Value, A::Error> {
            T::deserialize(MapAccessDeserializer::new(parts)).map(Some)
        }
    }
    input.deserialize_any(Parts(PhantomData))
}

/// The same of a matrix that is not optional.
pub(super) fn given<'de, D: Deserializer<'de>, T: Deserialize<'de>>(input: D) -> std::result::Result<T, D::Error> {
    named(input)?.ok_or_else(|| D::Error::custom("is null instead of a matrix"))
}

/// Contacts, counted from 0, and the blocks W_jk between them.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Blocks")]
pub(super) struct BlocksFile {
    /// The contacts j that the blocks move.
    row: Vec<usize>,
    /// The contacts k that push.
    column: Vec<usize>,
    /// W_jk \[1/kg\], `dimension` × `dimension` numbers row by row, block after block.
    value: Vec<f64>,
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
    /// No form yet.
    pub(super) fn empty(shape: [usize; 2]) -> Self {
        MatrixFile { shape, rows: None, triplets: None, blocks: None, diagonal_blocks: None, sparse_rows: None }
    }

    /// How many forms are given.
    pub(super) fn forms(&self) -> usize {
        let by_bodies = [self.diagonal_blocks.is_some(), self.sparse_rows.is_some()];
        [self.rows.is_some(), self.triplets.is_some(), self.blocks.is_some()].into_iter().chain(by_bodies).filter(|given| *given).count()
    }

    pub(super) fn dense(matrix: &DMatrix<f64>) -> Self {
        let rows = matrix.row_iter().map(|row| row.iter().copied().collect()).collect();
        MatrixFile { rows: Some(rows), ..MatrixFile::empty([matrix.nrows(), matrix.ncols()]) }
    }

    /// Entry by entry where that is shorter, for few entries of a large matrix are not zero; row by row otherwise.
    pub(super) fn shorter(matrix: &DMatrix<f64>) -> Self {
        // −0 is an entry, too
        let places = || matrix.row_iter().enumerate().flat_map(|(i, row)| (0..row.len()).map(move |j| (i, j)));
        let given = || places().filter(|place| matrix[*place].to_bits() != 0);
        if matrix.len() <= DENSE_ROWS * DENSE_ROWS || NUMBERS_OF_AN_ENTRY * given().count() >= matrix.len() {
            return Self::dense(matrix);
        }
        Self::sparse(Sparse { shape: [matrix.nrows(), matrix.ncols()], entries: given().map(|(i, j)| (i, j, matrix[(i, j)])).collect() })
    }

    /// Entry by entry.
    pub(super) fn sparse(Sparse { shape, entries }: Sparse) -> Self {
        let (places, value): (Vec<_>, Vec<_>) = entries.into_iter().map(|(i, j, value)| ((i, j), value)).unzip();
        let (row, column) = places.into_iter().unzip();
        MatrixFile { triplets: Some(Triplets { row, column, value }), ..MatrixFile::empty(shape) }
    }

    /// W as it is stored.
    pub(super) fn operator(operator: &Operator) -> Self {
        let Some(blocks) = operator.blocks() else { return Self::shorter(operator.dense()) };
        let mut file = BlocksFile { row: Vec::new(), column: Vec::new(), value: Vec::with_capacity(blocks.entries().len()) };
        let d = blocks.rows_per_contact();
        for column in 0..blocks.contacts() {
            for (row, block) in blocks.column(column) {
                file.row.push(row);
                file.column.push(column);
                file.value.extend((0..d * d).map(|place| block[place % d * d + place / d]));
            }
        }
        MatrixFile { blocks: Some(file), ..MatrixFile::empty(operator.shape()) }
    }

    /// Whether its blocks are given.
    pub(super) fn has_blocks(&self) -> bool {
        self.blocks.is_some()
    }

    /// W with so many rows per contact.
    pub(super) fn read_operator(mut self, field: &str, rows_per_contact: usize) -> Result<Operator> {
        match self.blocks.take() {
            None => Ok(self.read(field)?.into()),
            Some(_) if self.forms() > 0 => Err(one_form(field)),
            Some(blocks) => Ok(blocks.read(field, rows_per_contact, self.shape[0] / rows_per_contact)?.into()),
        }
    }

    /// Its entries, where it is given by them alone.
    pub(super) fn read_sparse(self, field: &str) -> Result<Sparse> {
        match (self.rows, self.triplets) {
            (None, Some(triplets)) => Ok(Sparse { shape: self.shape, entries: triplets.entries(field, self.shape)? }),
            _ => Err(one_form(field)),
        }
    }

    pub(super) fn read(self, field: &str) -> Result<DMatrix<f64>> {
        let [nrows, ncols] = self.shape;
        if self.forms() != 1 {
            return Err(one_form(field));
        }
        match (self.rows, self.triplets) {
            (Some(rows), None) => {
                if rows.len() != nrows {
                    return Err(Error::invalid(
                        format!("{field}.rows"),
                        format!("has {}", counted(rows.len(), "row")),
                        format!("give {}, as `shape` says", counted(nrows, "row")),
                    ));
                }
                if let Some(k) = rows.iter().position(|row| row.len() != ncols) {
                    let problem = format!("has {}", counted(rows[k].len(), "entry"));
                    return Err(Error::invalid(
                        format!("{field}.rows[{k}]"),
                        problem,
                        format!("give {}, as `shape` says", counted(ncols, "entry")),
                    ));
                }
                Ok(DMatrix::from_row_iterator(nrows, ncols, rows.into_iter().flatten()))
            }
            (None, Some(triplets)) => triplets.read(field, nrows, ncols),
            _ => Err(one_form(field)),
        }
    }
}

pub(super) fn one_form(field: &str) -> Error {
    let cure = "give one of `rows` and `triplets`; W may have `blocks` instead, a mass `diagonal_blocks` and its Jacobian `sparse_rows`";
    Error::invalid(field, "has none of its forms, more than one, or `blocks` that are not of W", cure)
}

impl BlocksFile {
    fn read(self, field: &str, d: usize, contacts: usize) -> Result<BlockSparse> {
        let count = self.row.len();
        if self.column.len() != count || self.value.len() != count * d * d {
            let problem = format!(
                "has {count}, {} and {}",
                counted(self.column.len(), "column"),
                counted(self.value.len(), "value"),
                count = counted(count, "row")
            );
            let cure = format!("give a row, a column and {} for each block", counted(d * d, "value"));
            return Err(Error::invalid(format!("{field}.blocks"), problem, cure));
        }
        let places = self.row.into_iter().zip(self.column).zip(self.value.chunks_exact(d * d));
        let blocks = places.map(|((row, column), value)| (row, column, DMatrix::from_row_slice(d, d, value)));
        BlockSparse::new(d, contacts, blocks.collect())
    }
}

impl Triplets {
    fn read(self, field: &str, nrows: usize, ncols: usize) -> Result<DMatrix<f64>> {
        if nrows.saturating_mul(ncols) > DENSE_ENTRIES {
            let problem = format!("has shape {nrows}×{ncols}");
            return Err(Error::invalid(field, problem, format!("use at most {DENSE_ENTRIES} entries: a matrix is stored dense")));
        }
        let mut matrix = DMatrix::zeros(nrows, ncols);
        self.entries(field, [nrows, ncols])?.into_iter().for_each(|(i, j, value)| matrix[(i, j)] = value);
        Ok(matrix)
    }

    /// Its entries, each within the shape and at a place of its own.
    fn entries(self, field: &str, [nrows, ncols]: [usize; 2]) -> Result<Vec<(usize, usize, f64)>> {
        let count = self.value.len();
        if self.row.len() != count || self.column.len() != count {
            let problem = format!(
                "has {}, {} and {count}",
                counted(self.row.len(), "row"),
                counted(self.column.len(), "column"),
                count = counted(count, "value")
            );
            return Err(Error::invalid(format!("{field}.triplets"), problem, "give three lists of one length"));
        }
        let mut seen = std::collections::HashSet::with_capacity(count);
        let mut entries = Vec::with_capacity(count);
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
            entries.push((i, j, value));
        }
        Ok(entries)
    }
}
