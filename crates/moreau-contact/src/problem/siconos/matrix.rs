//! A matrix in one of the three forms that Siconos prints: dense, sparse by blocks, sparse as CSparse prints it.

use super::tokens::Tokens;
use crate::memory;
use crate::operator::{BlockSparse, Operator, Sparse};
use moreau_exact::{Error, Result};
use nalgebra::DMatrix;

/// A matrix as it was read.
pub(super) enum Matrix {
    Dense(DMatrix<f64>),
    Sparse(Sparse),
}

impl Matrix {
    /// The storage, the sizes and the entries.
    pub(super) fn read(tokens: &mut Tokens, what: &str) -> Result<Self> {
        let storage = tokens.whole(what)?;
        let shape = [tokens.whole(what)?, tokens.whole(what)?];
        match storage {
            0 => dense(tokens, what, shape),
            1 => blocks(tokens, what, shape),
            2 => csparse(tokens, what, shape),
            other => Err(tokens.error(what, format!("has the storage {other}"), "use 0 (dense), 1 (blocks) or 2 (CSparse)")),
        }
    }

    pub(super) fn shape(&self) -> [usize; 2] {
        match self {
            Matrix::Dense(dense) => [dense.nrows(), dense.ncols()],
            Matrix::Sparse(sparse) => sparse.shape,
        }
    }

    /// W of contacts with so many rows: what was dense stays dense, unless less than half of its blocks are not zero.
    pub(super) fn into_operator(self, rows_per_contact: usize) -> Result<Operator> {
        match self {
            Matrix::Dense(dense) => {
                let contacts = dense.nrows() / rows_per_contact;
                let blocks = BlockSparse::from_sparse(&Sparse::of(&dense), rows_per_contact)?;
                Ok(if 2 * blocks.block_count() < contacts * contacts { blocks.into() } else { dense.into() })
            }
            Matrix::Sparse(sparse) => Ok(BlockSparse::from_sparse(&sparse, rows_per_contact)?.into()),
        }
    }

    pub(super) fn into_sparse(self) -> Sparse {
        match self {
            Matrix::Sparse(sparse) => sparse,
            Matrix::Dense(dense) => Sparse::of(&dense),
        }
    }

    pub(super) fn into_dense(self) -> Result<DMatrix<f64>> {
        match self {
            Matrix::Dense(dense) => Ok(dense),
            Matrix::Sparse(sparse) => {
                memory::require("the matrix of this problem", memory::matrix(sparse.shape[0], sparse.shape[1]))?;
                let mut dense = DMatrix::zeros(sparse.shape[0], sparse.shape[1]);
                sparse.entries.iter().for_each(|(i, j, value)| dense[(*i, *j)] += value);
                Ok(dense)
            }
        }
    }
}

/// Sizes again, and column after column, as Siconos's `NM_new_from_filename` takes them (Siconos 4.4.0: `1 2 3 4` is [1 3; 2 4]).
fn dense(tokens: &mut Tokens, what: &str, shape: [usize; 2]) -> Result<Matrix> {
    let again = [tokens.whole(what)?, tokens.whole(what)?];
    if again != shape {
        return Err(tokens.error(what, format!("has the sizes {again:?} after {shape:?}"), "give the same sizes twice"));
    }
    let numbers = tokens.vector(what, shape[0].saturating_mul(shape[1]))?;
    Ok(Matrix::Dense(DMatrix::from_column_slice(shape[0], shape[1], &numbers)))
}

/// Where the blocks of rows and columns end, and where in the lists of places each row of blocks begins.
struct Places {
    rows: Vec<usize>,
    columns: Vec<usize>,
    starts: Vec<usize>,
    column_of: Vec<usize>,
}

/// Block rows, block columns, where they end, the compressed rows, and each block column by column after its number.
fn blocks(tokens: &mut Tokens, what: &str, shape: [usize; 2]) -> Result<Matrix> {
    let [count, block_rows, block_columns] = [tokens.whole(what)?, tokens.whole(what)?, tokens.whole(what)?];
    let ends = [tokens.indices(what, block_rows)?, tokens.indices(what, block_columns)?];
    let [filled_rows, filled] = [tokens.whole(what)?, tokens.whole(what)?];
    let [starts, column_of] = [tokens.indices(what, filled_rows)?, tokens.indices(what, filled)?];
    let [rows, columns] = ends;
    let grows = |list: &[usize]| list.windows(2).all(|pair| pair[0] <= pair[1]);
    let fits = [(&rows, shape[0]), (&columns, shape[1])].iter().all(|(ends, size)| grows(ends) && ends.last().unwrap_or(&0) == size);
    let lists_fit = filled_rows == block_rows + 1 && grows(&starts) && starts[block_rows] == count && filled >= count;
    if !fits || !lists_fit || starts[0] != 0 || column_of[..count].iter().any(|column| *column >= block_columns) {
        return Err(tokens.error(
            what,
            "has block sizes or places that do not fit together".into(),
            "give the blocks as Siconos prints them",
        ));
    }
    read_blocks(tokens, what, shape, &Places { rows, columns, starts, column_of })
}

fn read_blocks(tokens: &mut Tokens, what: &str, shape: [usize; 2], places: &Places) -> Result<Matrix> {
    let range = |ends: &[usize], k: usize| (if k == 0 { 0 } else { ends[k - 1] })..ends[k];
    let mut entries = Vec::new();
    for row in 0..places.rows.len() {
        for place in places.starts[row]..places.starts[row + 1] {
            let number = tokens.whole(what)?;
            if number != place {
                return Err(tokens.error(
                    what,
                    format!("has block {number} where {place} follows"),
                    "give the blocks in order, each after its number",
                ));
            }
            for j in range(&places.columns, places.column_of[place]) {
                for i in range(&places.rows, row) {
                    entries.push((i, j, tokens.number(what)?));
                }
            }
        }
    }
    Ok(Matrix::Sparse(Sparse { shape, entries }))
}

/// A mark of its origin, a line with the version, a line with the sizes, and `i j : value`, or `col j : …` and `i : value`.
fn csparse(tokens: &mut Tokens, what: &str, shape: [usize; 2]) -> Result<Matrix> {
    let missing = |tokens: &Tokens| {
        tokens.error(what, "does not begin as CSparse prints it".into(), "give the lines `CSparse Version …` and `m-by-n, …`")
    };
    tokens.whole(what)?;
    if tokens.next() != Some("CSparse") {
        return Err(missing(tokens));
    }
    tokens.skip_line();
    let mut count = None;
    let mut word = tokens.next();
    let is_triplet = word == Some("triplet:");
    while word.is_some_and(|word| word != "nnz:") {
        word = tokens.next();
    }
    if word.is_some() {
        count = tokens.next().and_then(|word| word.trim_end_matches(',').parse::<usize>().ok());
    }
    let count = count.ok_or_else(|| missing(tokens))?;
    tokens.skip_line();
    let (mut entries, mut column) = (Vec::new(), 0);
    while entries.len() < count {
        let first = tokens.clone().next();
        if !is_triplet && first == Some("col") {
            tokens.next();
            column = tokens.whole(what)?;
            tokens.skip_line();
            continue;
        }
        let row = tokens.whole(what)?;
        if is_triplet {
            column = tokens.whole(what)?;
        }
        tokens.next();
        entries.push((row, column, tokens.number(what)?));
        if row >= shape[0] || column >= shape[1] {
            return Err(tokens.error(what, format!("has an entry at ({row}, {column})"), &format!("use places below {shape:?}")));
        }
    }
    let mut places: Vec<(usize, usize)> = entries.iter().map(|(i, j, _)| (*i, *j)).collect();
    places.sort_unstable();
    match places.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(Error::invalid(what, format!("repeats the place {:?}", pair[0]), "add the values up and give the place once")),
        None => {
            // the last columns may be empty
            while !is_triplet && tokens.clone().next() == Some("col") {
                tokens.skip_line();
            }
            Ok(Matrix::Sparse(Sparse { shape, entries }))
        }
    }
}
