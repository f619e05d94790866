//! W by blocks over the contact graph: W_jk is kept only where an impulse at contact k moves contact j.
//!
//! ```text
//!     (W r)_j = Σ_{k coupled with j} W_jk r_k
//! ```
//! Contacts of a pile meet some ten others, however large it is: memory and a sweep grow with the number of contacts, not with its square.

use super::slot::{self, Slot};
use super::{ContactOperator, Sparse};
use crate::memory::spare::{self, Lent};
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::DMatrix;

/// W as blocks of one size, column of contacts after column. A block that is not kept is zero.
#[derive(Clone, Debug, PartialEq)]
pub struct BlockSparse {
    rows_per_contact: usize,
    /// The blocks of column k are numbers starts[k] .. starts[k + 1].
    starts: Lent<Vec<usize>>,
    /// The contact j of every block W_jk, growing within a column.
    coupled: Lent<Vec<usize>>,
    /// The entries, block after block, each column by column \[1/kg\].
    entries: Lent<Vec<f64>>,
}

impl BlockSparse {
    /// W from blocks (j, k, W_jk), in any order, each place at most once; diagonal blocks that are left out are zero.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a block has another shape than `rows_per_contact` squared, stands outside, or stands twice.
    /// ```
    /// use moreau_contact::nalgebra::{dmatrix, dvector};
    /// use moreau_contact::operator::BlockSparse;
    ///
    /// // three contacts in a row, of which only neighbours meet
    /// let w = |entry| dmatrix![entry];
    /// let mut blocks = vec![(0, 0, w(1.0)), (1, 1, w(2.0)), (2, 2, w(1.0))];
    /// blocks.extend([(0, 1), (1, 0), (2, 1), (1, 2)].map(|(j, k)| (j, k, w(-1.0))));
    /// let chain = BlockSparse::new(1, 3, blocks)?;
    /// assert_eq!((chain.block_count(), chain.entry(0, 2), chain.entry(2, 1)), (7, 0.0, -1.0));
    /// assert!(BlockSparse::new(1, 3, vec![(3, 0, w(1.0))]).is_err());
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn new(rows_per_contact: usize, contacts: usize, mut blocks: Vec<(usize, usize, DMatrix<f64>)>) -> Result<Self> {
        blocks.sort_by_key(|(row, column, _)| (*column, *row));
        let mut made = BlockSparse::with_capacity(rows_per_contact, contacts, blocks.len());
        for (row, column, block) in &blocks {
            if *row >= contacts || *column >= contacts {
                let cure = format!("use contacts below {contacts}; they count from 0");
                return Err(Error::invalid("delassus", format!("has a block at ({row}, {column})"), cure));
            }
            if block.shape() != (rows_per_contact, rows_per_contact) {
                let problem = format!("has a block of {}×{} at ({row}, {column})", block.nrows(), block.ncols());
                return Err(Error::invalid(
                    "delassus",
                    problem,
                    format!("use {rows_per_contact}×{rows_per_contact}, the rows per contact"),
                ));
            }
            made.push(*row, *column, block.as_slice())?;
        }
        made.finish(contacts);
        Ok(made)
    }

    /// The blocks of a sparse matrix of so many rows per contact; entries of one place are added.
    ///
    /// # Errors
    /// [`Error::Invalid`] if its shape is not square or no multiple of the rows per contact.
    pub fn from_sparse(sparse: &Sparse, rows_per_contact: usize) -> Result<Self> {
        let (d, [rows, columns]) = (rows_per_contact, sparse.shape);
        if rows != columns || !rows.is_multiple_of(d) {
            let cure = format!("give a square matrix of {} per contact", counted(d, "row"));
            return Err(Error::invalid("delassus", format!("has shape {rows}×{columns}"), cure));
        }
        let mut sorted: Vec<&(usize, usize, f64)> = sparse.entries.iter().collect();
        sorted.sort_by_key(|(i, j, _)| (j / d, i / d));
        let mut made = BlockSparse::with_capacity(d, rows / d, sorted.len() / (d * d));
        let mut block = vec![0.0; d * d];
        for entries in sorted.chunk_by(|one, other| (one.1 / d, one.0 / d) == (other.1 / d, other.0 / d)) {
            block.fill(0.0);
            entries.iter().for_each(|(i, j, value)| block[j % d * d + i % d] += value);
            made.push(entries[0].0 / d, entries[0].1 / d, &block)?;
        }
        made.finish(rows / d);
        Ok(made)
    }

    /// The blocks of a dense W, each bit as it is, if at least half of them are zero; those on the diagonal are kept in any case.
    pub(crate) fn of_dense(dense: &DMatrix<f64>, rows_per_contact: usize) -> Option<Self> {
        let (d, contacts) = (rows_per_contact, dense.nrows() / rows_per_contact);
        let mut made = BlockSparse::with_capacity(d, contacts, 0);
        let mut is_kept = vec![false; contacts];
        for k in 0..contacts {
            is_kept.fill(false);
            is_kept[k] = true;
            for column in k * d..(k + 1) * d {
                let parts = dense.as_slice()[column * contacts * d..(column + 1) * contacts * d].chunks_exact(d);
                is_kept.iter_mut().zip(parts).for_each(|(is_kept, part)| *is_kept |= part.iter().any(|entry| *entry != 0.0));
            }
            made.append_column(|coupled| coupled.extend((0..contacts).filter(|j| is_kept[*j])));
            if 2 * made.coupled.len() > contacts * contacts {
                return None;
            }
        }
        for k in 0..contacts {
            for at in made.starts[k]..made.starts[k + 1] {
                made.entries.extend(dense.view((made.coupled[at] * d, k * d), (d, d)).iter());
            }
        }
        Some(made)
    }

    /// No blocks yet, with room for so many.
    pub(crate) fn with_capacity(rows_per_contact: usize, contacts: usize, blocks: usize) -> Self {
        let entries = spare::vector(blocks * rows_per_contact * rows_per_contact).into();
        BlockSparse { entries, ..BlockSparse::without_entries(rows_per_contact, contacts, blocks) }
    }

    /// The same without room for entries.
    pub(super) fn without_entries(rows_per_contact: usize, contacts: usize, blocks: usize) -> Self {
        let mut starts = spare::vector(contacts + 1);
        starts.push(0);
        let entries = Lent::default();
        BlockSparse { rows_per_contact, starts: starts.into(), coupled: spare::vector(blocks).into(), entries }
    }

    /// Makes room for the entries of all blocks.
    pub(super) fn make_room(&mut self) {
        let size = self.rows_per_contact * self.rows_per_contact;
        self.entries.make_room(self.coupled.len() * size);
    }

    /// Begins a column, by which those before are complete.
    pub(crate) fn begin(&mut self, column: usize) {
        while self.starts.len() <= column {
            self.starts.push(self.coupled.len());
        }
    }

    /// Appends W_jk, given column by column; columns and rows must grow.
    pub(crate) fn push(&mut self, row: usize, column: usize, block: &[f64]) -> Result<()> {
        self.begin(column);
        let first = self.starts[column];
        if self.coupled[first..].last().is_some_and(|last| *last >= row) {
            let problem = format!("repeats the block ({row}, {column}), or has it out of order");
            return Err(Error::invalid("delassus", problem, "add the blocks of a place up and give it once"));
        }
        self.coupled.push(row);
        self.entries.extend_from_slice(block);
        Ok(())
    }

    /// Appends a column of the contacts that `append` appends, growing; its blocks have no entries yet.
    #[inline]
    pub(super) fn append_column(&mut self, append: impl FnOnce(&mut Vec<usize>)) {
        append(&mut self.coupled);
        self.starts.push(self.coupled.len());
    }

    /// Where the blocks of every column begin, their contacts, and their entries as far as they are there.
    pub(super) fn parts_mut(&mut self) -> (&[usize], &[usize], &mut Vec<f64>) {
        (&self.starts, &self.coupled, &mut self.entries)
    }

    /// Closes the last columns.
    pub(crate) fn finish(&mut self, contacts: usize) {
        self.starts.resize(contacts + 1, self.coupled.len());
    }

    /// Rows of each contact.
    pub fn rows_per_contact(&self) -> usize {
        self.rows_per_contact
    }

    /// Number of contacts.
    pub fn contacts(&self) -> usize {
        self.starts.len() - 1
    }

    /// How many blocks are kept.
    pub fn block_count(&self) -> usize {
        self.coupled.len()
    }

    /// All entries that are kept \[1/kg\].
    pub fn entries(&self) -> &[f64] {
        &self.entries
    }

    /// The contacts j that an impulse at contact k moves with W_jk, column by column.
    ///
    /// # Panics
    /// If there is no such contact.
    pub fn column(&self, contact: usize) -> impl Iterator<Item = (usize, &[f64])> {
        let (d, range) = (self.rows_per_contact, self.starts[contact]..self.starts[contact + 1]);
        let size = d * d;
        self.coupled[range.clone()].iter().copied().zip(self.entries[range.start * size..range.end * size].chunks_exact(size.max(1)))
    }

    /// The contacts j of [`BlockSparse::column`].
    #[inline]
    pub(crate) fn met(&self, contact: usize) -> &[usize] {
        &self.coupled[self.starts[contact]..self.starts[contact + 1]]
    }

    /// W_jk, column by column; `None` where none is kept.
    pub fn block(&self, row: usize, column: usize) -> Option<&[f64]> {
        let (size, first) = (self.rows_per_contact * self.rows_per_contact, self.starts[column]);
        let place = self.coupled[first..self.starts[column + 1]].binary_search(&row).ok()? + first;
        Some(&self.entries[place * size..(place + 1) * size])
    }

    /// W_ij of two rows \[1/kg\].
    ///
    /// # Panics
    /// If there is no such row or column.
    pub fn entry(&self, row: usize, column: usize) -> f64 {
        let d = self.rows_per_contact;
        assert!(row < d * self.contacts(), "there is no such row");
        self.block(row / d, column / d).map_or(0.0, |block| block[column % d * d + row % d])
    }

    /// W of these contacts, growing, which meet no other; `place` is the place of each among them.
    pub(crate) fn of(&self, members: &[usize], place: impl Fn(usize) -> usize) -> Self {
        let (d, count) = (self.rows_per_contact, members.iter().map(|k| self.starts[k + 1] - self.starts[*k]).sum());
        let mut made = BlockSparse::with_capacity(d, members.len(), count);
        for k in members {
            let range = self.starts[*k]..self.starts[k + 1];
            made.coupled.extend(self.coupled[range.clone()].iter().map(|j| place(*j)));
            made.entries.extend_from_slice(&self.entries[range.start * d * d..range.end * d * d]);
            made.starts.push(made.coupled.len());
        }
        made
    }

    fn add_rows(&self, contact: usize, impulse: &[f64], velocity: &mut [f64]) {
        let d = self.rows_per_contact;
        for (j, block) in self.column(contact) {
            let u = &mut velocity[d * j..d * j + d];
            for (column, r) in block.chunks_exact(d).zip(impulse) {
                u.iter_mut().zip(column).for_each(|(u, w)| *u += *w * r);
            }
        }
    }

    /// Adds W e_k r_k, as [`ContactOperator::add_contact`] does, for contacts of D rows, whoever has the velocities.
    #[inline(always)]
    pub(crate) fn push_contact<const D: usize>(&self, contact: usize, impulse: &[f64; D], velocity: &[impl Slot]) {
        let (first, last) = (self.starts[contact], self.starts[contact + 1]);
        let blocks = self.entries.as_chunks::<D>().0[first * D..last * D].as_chunks::<D>().0;
        for (j, block) in self.coupled[first..last].iter().zip(blocks) {
            let mut added = [0.0; D];
            for (column, r) in block.iter().zip(impulse) {
                (0..D).for_each(|row| added[row] += column[row] * r);
            }
            slot::add(&velocity.as_chunks::<D>().0[*j], &added);
        }
    }

    /// W as a square matrix.
    pub fn to_dense(&self) -> DMatrix<f64> {
        let (d, n) = (self.rows_per_contact, self.contacts());
        let mut dense = DMatrix::zeros(d * n, d * n);
        for k in 0..n {
            for (j, block) in self.column(k) {
                dense.view_mut((d * j, d * k), (d, d)).copy_from_slice(block);
            }
        }
        dense
    }

    /// max |W_ij − W_ji| and max |W_ij| over the rows.
    pub(crate) fn asymmetry(&self) -> [f64; 2] {
        let d = self.rows_per_contact;
        let mut largest = [0.0_f64; 2];
        for k in 0..self.contacts() {
            for (j, block) in self.column(k) {
                let opposite = self.block(k, j);
                for (place, w) in block.iter().enumerate() {
                    let mirrored = opposite.map_or(0.0, |block| block[place % d * d + place / d]);
                    largest = [largest[0].max((w - mirrored).abs()), largest[1].max(w.abs())];
                }
            }
        }
        largest
    }
}

impl ContactOperator for BlockSparse {
    fn diagonal_block(&self, contact: usize, block: &mut [f64]) {
        match (self.block(contact, contact), block.as_mut_array::<9>()) {
            (None, _) => block.fill(0.0),
            // a copy of a known size costs a tenth
            (Some(found), Some(block)) if found.len() == 9 => *block = *found.first_chunk().expect("nine entries"),
            (Some(found), _) => block.copy_from_slice(found),
        }
    }

    fn add_product(&self, impulse: &[f64], velocity: &mut [f64]) {
        for (k, r) in impulse.chunks_exact(self.rows_per_contact.max(1)).enumerate().filter(|(_, r)| r.iter().any(|r| *r != 0.0)) {
            self.add_contact(k, r, velocity);
        }
    }

    fn add_magnitudes(&self, impulse: &[f64], sums: &mut [f64]) {
        let d = self.rows_per_contact;
        for (k, r) in impulse.chunks_exact(d.max(1)).enumerate().filter(|(_, r)| r.iter().any(|r| *r != 0.0)) {
            if let &[x, y, z] = r {
                let ([x, y, z], sums) = ([x.abs(), y.abs(), z.abs()], sums.as_chunks_mut::<3>().0);
                let range = self.starts[k]..self.starts[k + 1];
                let blocks = self.entries[9 * range.start..9 * range.end].as_chunks::<9>().0;
                for (j, w) in self.coupled[range].iter().zip(blocks) {
                    for (i, u) in sums[*j].iter_mut().enumerate() {
                        *u += w[i].abs() * x + w[3 + i].abs() * y + w[6 + i].abs() * z;
                    }
                }
                continue;
            }
            for (j, block) in self.column(k) {
                let u = &mut sums[d * j..d * j + d];
                for (column, r) in block.chunks_exact(d).zip(r) {
                    u.iter_mut().zip(column).for_each(|(u, w)| *u += w.abs() * r.abs());
                }
            }
        }
    }

    #[inline]
    fn add_contact(&self, contact: usize, impulse: &[f64], velocity: &mut [f64]) {
        let (first, last) = (self.starts[contact], self.starts[contact + 1]);
        match *impulse {
            [x, y, z] => {
                let (blocks, velocity) = (&self.entries.as_chunks::<9>().0[first..last], velocity.as_chunks_mut::<3>().0);
                for (j, w) in self.coupled[first..last].iter().zip(blocks) {
                    let u = &mut velocity[*j];
                    u[0] += w[0] * x + w[3] * y + w[6] * z;
                    u[1] += w[1] * x + w[4] * y + w[7] * z;
                    u[2] += w[2] * x + w[5] * y + w[8] * z;
                }
            }
            _ => self.add_rows(contact, impulse, velocity),
        }
    }

    fn bodies(&self, _contact: usize) -> Option<&[u32]> {
        None
    }

    fn write_terms(&self, terms: &mut [usize]) {
        let d = self.rows_per_contact;
        terms.fill(d);
        for k in 0..self.contacts() {
            self.met(k).iter().filter(|j| **j != k).for_each(|j| terms[*j] += d);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DVector;

    /// Three contacts of d rows; the first and the last do not meet, and W is not symmetric.
    fn chain(d: usize) -> (BlockSparse, DMatrix<f64>) {
        let block = |seed: usize| DMatrix::from_fn(d, d, |i, j| 1.0 + (seed * 7 + i * 3 + j * 5) as f64 % 11.0);
        let places = [(0, 0), (1, 0), (0, 1), (1, 1), (2, 1), (1, 2), (2, 2)];
        let blocks: Vec<_> = places.iter().enumerate().map(|(seed, (j, k))| (*j, *k, block(seed))).rev().collect();
        let mut dense = DMatrix::zeros(3 * d, 3 * d);
        blocks.iter().for_each(|(j, k, block)| dense.view_mut((d * j, d * k), (d, d)).copy_from(block));
        (BlockSparse::new(d, 3, blocks).unwrap(), dense)
    }

    #[test]
    fn a_dense_matrix_is_its_blocks_where_at_least_half_of_them_are_zero() {
        // four contacts, of which those are coupled: eight blocks are half of sixteen
        let w = |coupled: &[(usize, usize)], entry: f64| {
            let mut dense = DMatrix::zeros(8, 8);
            coupled.iter().for_each(|(j, k)| dense[(2 * j + 1, 2 * k)] = entry);
            dense
        };
        let half = [(0, 0), (1, 1), (0, 1), (3, 0), (2, 3), (1, 0)];
        for entry in [1.0, -0.25, f64::MIN_POSITIVE] {
            let dense = w(&half, entry);
            let blocks = BlockSparse::of_dense(&dense, 2).expect("eight blocks, two of them zeros on the diagonal");
            assert_eq!((blocks.to_dense(), blocks.block_count()), (dense, 8));
            let more: Vec<_> = half.into_iter().chain([(0, 3)]).collect();
            assert!(BlockSparse::of_dense(&w(&more, entry), 2).is_none());
        }
        assert_eq!(BlockSparse::of_dense(&chain(2).1, 2), None, "seven blocks of nine");
    }

    #[test]
    fn acts_as_the_dense_matrix_for_every_number_of_rows() {
        for d in 1..=6 {
            let (blocks, dense) = chain(d);
            assert_eq!(blocks.to_dense(), dense);
            let impulse = DVector::from_fn(3 * d, |i, _| i as f64 - 2.0);
            let [mut velocity, mut sums] = [vec![0.0; 3 * d], vec![0.0; 3 * d]];
            blocks.add_product(impulse.as_slice(), &mut velocity);
            blocks.add_magnitudes(impulse.as_slice(), &mut sums);
            assert_eq!(velocity, (&dense * &impulse).as_slice(), "small integers are exact");
            assert_eq!(sums, (dense.abs() * impulse.abs()).as_slice());
            assert_eq!(blocks.asymmetry(), [(&dense - dense.transpose()).amax(), dense.amax()]);
            assert!((0..3 * d).all(|i| (0..3 * d).all(|j| blocks.entry(i, j) == dense[(i, j)])));
        }
    }

    #[test]
    fn blocks_outside_of_another_size_or_twice_are_refused() {
        let one = DMatrix::from_element(1, 1, 1.0);
        let refused = |blocks: Vec<(usize, usize, DMatrix<f64>)>| BlockSparse::new(1, 2, blocks).unwrap_err().to_string();
        assert!(refused(vec![(2, 0, one.clone())]).contains("(2, 0)"));
        assert!(refused(vec![(0, 2, one.clone())]).contains("(0, 2)"));
        assert!(refused(vec![(0, 1, DMatrix::zeros(2, 1))]).contains("2×1"));
        assert!(refused(vec![(0, 1, one.clone()), (0, 1, one)]).contains("repeats"));
        assert_eq!(BlockSparse::new(1, 2, Vec::new()).unwrap().to_dense(), DMatrix::zeros(2, 2));
    }
}
