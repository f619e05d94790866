//! H of one contact: the few velocities its rows touch, body by body.
//!
//! ```text
//!     u = H v = Σ_b H_b v_b        b over the bodies of the contact, H_b rows × 6 in space and rows × 3 in the plane
//! ```
//! A contact of two free bodies keeps two such parts in place; a contact of a linkage keeps one part, which is as wide as the linkage has
//! velocities.

use nalgebra::{DMatrix, DVector, RowDVector};
use std::ops::{Index, Mul};

/// Entries of a part that is kept in place: three rows of six velocities.
const FEW: usize = 18;

/// Velocities of a free body in space, which nearly all are.
const SPATIAL: usize = 6;

/// H of one contact, rows (n), (n, t₁) or (n, t₁, t₂), times all velocities of the mechanism.
#[derive(Debug)]
pub struct Rows {
    rows: usize,
    columns: usize,
    /// The parts by growing columns; they do not overlap.
    parts: [Option<Part>; 2],
}

#[derive(Clone, Debug)]
struct Part {
    first: usize,
    width: usize,
    entries: Entries,
}

/// The entries of a part, row after row.
#[derive(Clone, Debug)]
enum Entries {
    Few([f64; FEW]),
    Many(Vec<f64>),
}

/// The rows of one contact at the velocities of one body: `entries[row * width + axis]` stands in column `first + axis`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyRows<'a> {
    /// The first column.
    pub first: usize,
    /// How many columns.
    pub width: usize,
    /// The entries, row after row.
    pub entries: &'a [f64],
}

impl Rows {
    /// Zeros: a contact that touches no velocity yet.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Rows { rows, columns, parts: [None, None] }
    }

    /// The same rows with the part of one more body, N velocities from column `first` on.
    ///
    /// # Panics
    /// If there are two parts already, the number of rows is another one, a part is too large to be kept in place, or two parts overlap.
    /// ```
    /// use moreau_contact::contact::Rows;
    /// use moreau_contact::nalgebra::dvector;
    ///
    /// // two masses on a line, of which the first lies on the second
    /// let rows = Rows::zeros(1, 3).with(2, [[1.0]]).with(0, [[-1.0]]);
    /// assert_eq!(&rows * &dvector![0.5, 7.0, 2.0], dvector![1.5]);
    /// assert_eq!(rows.parts().map(|part| part.first).collect::<Vec<_>>(), [0, 2]);
    /// ```
    #[must_use]
    pub fn with<const R: usize, const N: usize>(mut self, first: usize, block: [[f64; N]; R]) -> Self {
        self.push(first, &block);
        self
    }

    /// Adds the part of one more body, in place.
    ///
    /// # Panics
    /// As [`Rows::with`].
    #[inline]
    pub fn push<const R: usize, const N: usize>(&mut self, first: usize, block: &[[f64; N]; R]) {
        assert!(R == self.rows && R * N <= FEW && first + N <= self.columns, "a part fits the rows it is added to");
        let place = match &self.parts {
            [None, _] => 0,
            [Some(known), None] if known.first + known.width <= first || first + N <= known.first => 1,
            _ => panic!("a contact touches two bodies, and each once"),
        };
        let mut entries = [0.0; FEW];
        entries[..R * N].copy_from_slice(block.as_flattened());
        self.parts[place] = Some(Part { first, width: N, entries: Entries::Few(entries) });
        if let [Some(one), Some(other)] = &self.parts
            && other.first < one.first
        {
            self.parts.swap(0, 1);
        }
    }

    /// The rows Σ_j a_ij H_j: one for each list of weights, for example of tangents in other directions.
    ///
    /// # Panics
    /// If a list has not as many weights as there are rows.
    /// ```
    /// use moreau_contact::contact::Rows;
    /// use moreau_contact::nalgebra::dmatrix;
    ///
    /// // the normal alone of a point in the plane, and its normal beside the other sense of the tangent
    /// let rows = Rows::zeros(2, 4).with(2, [[0.0, 1.0], [1.0, 0.0]]);
    /// assert_eq!(rows.combined(&[&[1.0, 0.0]]).to_dense(), dmatrix![0.0, 0.0, 0.0, 1.0]);
    /// assert_eq!(rows.combined(&[&[1.0, 0.0], &[0.0, -1.0]]).row(1), dmatrix![0.0, 0.0, -1.0, 0.0]);
    /// ```
    #[must_use]
    pub fn combined(&self, weights: &[&[f64]]) -> Self {
        assert!(weights.iter().all(|weights| weights.len() == self.rows), "one weight for each row");
        let entry = |part: &BodyRows, weights: &[f64], axis: usize| {
            let own = part.entries[axis..].iter().step_by(part.width);
            weights.iter().zip(own).map(|(weight, h)| weight * h).sum::<f64>()
        };
        let mut made = Rows::zeros(weights.len(), self.columns);
        for (place, part) in made.parts.iter_mut().zip(self.parts()) {
            let entries = weights.iter().flat_map(|weights| (0..part.width).map(|axis| entry(&part, weights, axis))).collect();
            *place = Some(Part { first: part.first, width: part.width, entries: Entries::Many(entries) });
        }
        made
    }

    /// These rows, and below them other ones of the same bodies.
    ///
    /// # Panics
    /// If they belong to another number of velocities, or to more than two bodies together.
    /// ```
    /// use moreau_contact::contact::Rows;
    /// use moreau_contact::nalgebra::dmatrix;
    ///
    /// // a normal at one body, and below it a turn of both
    /// let normal = Rows::zeros(1, 4).with(0, [[1.0, 0.0]]);
    /// let turn = Rows::zeros(1, 4).with(0, [[0.0, 1.0]]).with(2, [[0.0, -1.0]]);
    /// assert_eq!(normal.above(&turn).to_dense(), dmatrix![1.0, 0.0, 0.0, 0.0; 0.0, 1.0, 0.0, -1.0]);
    /// ```
    #[must_use]
    pub fn above(&self, other: &Self) -> Self {
        assert_eq!(self.columns, other.columns, "both belong to the same velocities");
        let mut places: Vec<(usize, usize)> = self.parts().chain(other.parts()).map(|part| (part.first, part.width)).collect();
        places.sort_unstable();
        places.dedup();
        let apart = places.windows(2).all(|pair| pair[0].0 + pair[0].1 <= pair[1].0);
        assert!(places.len() <= 2 && apart, "a contact touches two bodies, and each once");
        let mut made = Rows::zeros(self.rows + other.rows, self.columns);
        for (place, (first, width)) in made.parts.iter_mut().zip(places) {
            let entries = [self, other].into_iter().flat_map(|rows| {
                let own = rows.parts().find(|part| part.first == first);
                own.map_or_else(|| vec![0.0; rows.rows * width], |part| part.entries.to_vec())
            });
            *place = Some(Part { first, width, entries: Entries::Many(entries.collect()) });
        }
        made
    }

    /// How many rows.
    pub fn nrows(&self) -> usize {
        self.rows
    }

    /// How many velocities the mechanism has.
    pub fn ncols(&self) -> usize {
        self.columns
    }

    /// Rows and columns.
    pub fn shape(&self) -> (usize, usize) {
        (self.rows, self.columns)
    }

    /// The parts of the bodies, columns growing.
    #[inline]
    pub fn parts(&self) -> impl Iterator<Item = BodyRows<'_>> {
        self.parts.iter().flatten().map(|Part { first, width, entries }| {
            let entries = match entries {
                Entries::Few(entries) => &entries[..self.rows * width],
                Entries::Many(entries) => entries,
            };
            BodyRows { first: *first, width: *width, entries }
        })
    }

    /// Adds H v to `velocity` \[m/s\].
    ///
    /// # Panics
    /// If a size does not fit.
    #[inline]
    pub fn add_product(&self, velocities: &[f64], velocity: &mut [f64]) {
        assert_eq!((velocities.len(), velocity.len()), (self.columns, self.rows), "sizes fit");
        for BodyRows { first, width, entries } in self.parts() {
            let moved = &velocities[first..first + width];
            let in_space = (moved.as_array::<SPATIAL>(), entries.as_chunks::<SPATIAL>().0.as_array::<3>(), velocity.as_mut_array::<3>());
            if let (Some(moved), Some(rows), Some(u)) = in_space {
                (0..3).for_each(|row| (0..SPATIAL).for_each(|axis| u[row] += rows[row][axis] * moved[axis]));
            } else {
                let rows = velocity.iter_mut().zip(entries.chunks_exact(width.max(1)));
                rows.for_each(|(u, row)| row.iter().zip(moved).for_each(|(h, v)| *u += h * v));
            }
        }
    }

    /// [`Rows::add_product`] of two velocities in one pass, with the same bits.
    ///
    /// # Panics
    /// As [`Rows::add_product`].
    #[inline]
    pub fn add_products(&self, velocities: [&[f64]; 2], found: [&mut [f64]; 2]) {
        let [one, other] = found;
        let sizes = [velocities[0].len(), velocities[1].len(), one.len(), other.len()];
        assert_eq!(sizes, [self.columns, self.columns, self.rows, self.rows], "sizes fit");
        for BodyRows { first, width, entries } in self.parts() {
            let moved = velocities.map(|velocities| &velocities[first..first + width]);
            let in_space = (moved.map(<[f64]>::as_array::<SPATIAL>), entries.as_chunks::<SPATIAL>().0.as_array::<3>());
            if let (([Some(v), Some(w)], Some(rows)), Some(u), Some(x)) = (in_space, one.as_mut_array::<3>(), other.as_mut_array::<3>()) {
                for (row, entries) in rows.iter().enumerate() {
                    for (axis, h) in entries.iter().enumerate() {
                        (u[row], x[row]) = (u[row] + h * v[axis], x[row] + h * w[axis]);
                    }
                }
            } else {
                for (moved, found) in moved.iter().zip([&mut *one, &mut *other]) {
                    let rows = found.iter_mut().zip(entries.chunks_exact(width.max(1)));
                    rows.for_each(|(u, row)| row.iter().zip(*moved).for_each(|(h, v)| *u += h * v));
                }
            }
        }
    }

    /// Adds Hᵀ r to `impulse`, the generalised impulse of r \[N·s\].
    ///
    /// # Panics
    /// If a size does not fit.
    #[inline]
    pub fn add_transposed(&self, contact: &[f64], impulse: &mut [f64]) {
        assert_eq!((contact.len(), impulse.len()), (self.rows, self.columns), "sizes fit");
        for BodyRows { first, width, entries } in self.parts() {
            let pushed = &mut impulse[first..first + width];
            match pushed.as_mut_array::<SPATIAL>() {
                Some(pushed) => {
                    let mut sums = *pushed;
                    for (r, row) in contact.iter().zip(entries.as_chunks::<SPATIAL>().0) {
                        (0..SPATIAL).for_each(|axis| sums[axis] += row[axis] * r);
                    }
                    *pushed = sums;
                }
                None => {
                    for (r, row) in contact.iter().zip(entries.chunks_exact(width.max(1))) {
                        row.iter().zip(pushed.iter_mut()).for_each(|(h, p)| *p += h * r);
                    }
                }
            }
        }
    }

    /// One row, with its zeros.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn row(&self, row: usize) -> RowDVector<f64> {
        assert!(row < self.rows, "there is no such row");
        let mut found = RowDVector::zeros(self.columns);
        for BodyRows { first, width, entries } in self.parts() {
            found.as_mut_slice()[first..first + width].copy_from_slice(&entries[row * width..(row + 1) * width]);
        }
        found
    }

    /// H with its zeros, rows × velocities.
    pub fn to_dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.rows, self.columns);
        for BodyRows { first, width, entries } in self.parts() {
            dense
                .view_mut((0, first), (self.rows, width))
                .copy_from(&nalgebra::DMatrixView::from_slice(entries, width, self.rows).transpose());
        }
        dense
    }

    /// The columns in which an entry is not zero, growing.
    pub fn touched(&self) -> impl Iterator<Item = usize> {
        self.parts().flat_map(|part| (0..part.width).filter(move |axis| part.touches(*axis)).map(move |axis| part.first + axis))
    }

    /// Appends [`Rows::touched`].
    pub(crate) fn push_touched(&self, columns: &mut Vec<usize>) {
        for part in self.parts() {
            match part.entries.as_chunks::<SPATIAL>().0.as_array::<3>().filter(|_| part.width == SPATIAL) {
                Some([n, t1, t2]) => {
                    let is_touched = |axis: &usize| (n[*axis] != 0.0) | (t1[*axis] != 0.0) | (t2[*axis] != 0.0);
                    (0..SPATIAL).filter(is_touched).for_each(|axis| columns.push(part.first + axis));
                }
                None => (0..part.width).filter(|axis| part.touches(*axis)).for_each(|axis| columns.push(part.first + axis)),
            }
        }
    }
}

impl BodyRows<'_> {
    /// Whether an entry of a column is not zero.
    fn touches(&self, axis: usize) -> bool {
        self.entries[axis..].iter().step_by(self.width).any(|entry| *entry != 0.0)
    }
}

impl From<DMatrix<f64>> for Rows {
    /// One part with all entries.
    fn from(dense: DMatrix<f64>) -> Self {
        let (rows, columns) = dense.shape();
        let part = Part { first: 0, width: columns, entries: Entries::Many(dense.transpose().as_slice().to_vec()) };
        Rows { rows, columns, parts: [(columns > 0).then_some(part), None] }
    }
}

impl Clone for Rows {
    // part by part, which costs half of what a copy of an array of them does
    fn clone(&self) -> Self {
        let [one, other] = &self.parts;
        Rows { rows: self.rows, columns: self.columns, parts: [one.clone(), other.clone()] }
    }
}

impl PartialEq for Rows {
    /// Whether all entries are the same, however they are kept.
    fn eq(&self, other: &Self) -> bool {
        self.shape() == other.shape() && self.to_dense() == other.to_dense()
    }
}

impl Mul<&DVector<f64>> for &Rows {
    type Output = DVector<f64>;

    /// H v \[m/s\].
    fn mul(self, velocities: &DVector<f64>) -> DVector<f64> {
        let mut velocity = DVector::zeros(self.rows);
        self.add_product(velocities.as_slice(), velocity.as_mut_slice());
        velocity
    }
}

impl Index<(usize, usize)> for Rows {
    type Output = f64;

    /// H_ij.
    ///
    /// # Panics
    /// If there is no such row or column.
    fn index(&self, (row, column): (usize, usize)) -> &f64 {
        assert!(row < self.rows && column < self.columns, "there is no such entry");
        let part = self.parts().find(|part| (part.first..part.first + part.width).contains(&column));
        part.map_or(&0.0, |part| &part.entries[row * part.width + column - part.first])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dvector;

    #[test]
    fn parts_act_as_the_dense_matrix() {
        let rows = Rows::zeros(2, 7).with(4, [[1.0, -2.0, 3.0], [0.0, 5.0, 6.0]]).with(0, [[7.0, 0.0, 9.0], [4.0, 0.0, 2.0]]);
        let dense = rows.to_dense();
        let (v, r) = (dvector![1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0], [2.0, -1.0]);
        assert_eq!(&rows * &v, &dense * &v, "small integers are exact");
        let mut pushed = DVector::zeros(7);
        rows.add_transposed(&r, pushed.as_mut_slice());
        assert_eq!(pushed, dense.tr_mul(&dvector![2.0, -1.0]));
        assert!((0..2).all(|i| rows.row(i) == dense.row(i).into_owned() && (0..7).all(|j| rows[(i, j)] == dense[(i, j)])));
        assert_eq!(Rows::from(dense), rows);
        assert_eq!(rows.touched().collect::<Vec<_>>(), [0, 2, 4, 5, 6]);
    }

    #[test]
    fn rows_above_others_are_those_of_both() {
        let one = Rows::zeros(1, 7).with(4, [[1.0, -2.0, 3.0]]);
        let other = Rows::zeros(2, 7).with(4, [[0.5, 0.0, 1.0], [2.0, 4.0, 8.0]]).with(0, [[7.0, 9.0], [4.0, 2.0]]);
        for (upper, lower) in [(&one, &other), (&other, &one), (&one, &one), (&Rows::zeros(1, 7), &other)] {
            let (both, rows) = (upper.above(lower).to_dense(), upper.nrows());
            assert_eq!(
                (both.rows(0, rows).into_owned(), both.rows(rows, lower.nrows()).into_owned()),
                (upper.to_dense(), lower.to_dense())
            );
        }
    }

    /// In the plane and in space, where the rows are gone through in another way.
    #[test]
    fn two_velocities_in_one_pass_move_as_each_alone_to_the_last_bit() {
        let entry = |seed: usize| ((seed * 7919 + 13) % 101) as f64 / 37.0 - 1.0;
        let spatial: [[f64; 6]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| if j == 4 { 0.0 } else { entry(7 * i + j) }));
        let planar = Rows::zeros(2, 6).with(3, [[entry(1), entry(2), entry(3)], [0.0, entry(5), 0.0]]);
        for rows in [Rows::zeros(3, 18).with(12, spatial).with(0, spatial.map(|row| row.map(|h| 0.1 - h))), planar] {
            let [v, w] = [3, 50].map(|seed| DVector::from_fn(rows.ncols(), |i, _| entry(seed + i)));
            let [mut one, mut other] = [vec![0.5; rows.nrows()], vec![-0.25; rows.nrows()]];
            let (mut first, mut second) = (one.clone(), other.clone());
            rows.add_product(v.as_slice(), &mut first);
            rows.add_product(w.as_slice(), &mut second);
            rows.add_products([v.as_slice(), w.as_slice()], [&mut one, &mut other]);
            assert_eq!((one, other), (first, second));
            let mut touched = Vec::new();
            rows.push_touched(&mut touched);
            assert_eq!(touched, rows.touched().collect::<Vec<_>>());
        }
    }

    #[test]
    #[should_panic(expected = "two bodies")]
    fn parts_that_overlap_are_refused() {
        let _ = Rows::zeros(1, 4).with(0, [[1.0, 1.0]]).with(1, [[1.0, 1.0]]);
    }
}
