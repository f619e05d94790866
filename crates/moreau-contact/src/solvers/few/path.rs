//! Lemke's path of a few rows, in one tableau that is pivoted as a whole.
//!
//! ```text
//!     w − M′ z − 1 z₀ = q′ ,      M′ = S M S ,  q′ = S q/max|S q| ,  S = diag(M)^(−½)
//! ```
//! Ties are broken lexicographically on the rows of (q, B⁻¹), as [`lemke`](super::super::lemke) does with bounds of every error. Here there
//! are none: only the support at the end counts, and what it leads to is judged.

use super::parts::MOST;
use super::rows::{Rows, Support, bit};
use crate::tolerance::complementarity::negligible;
use crate::tolerance::solvers::lemke_pivot_limit;

/// Columns of w, of z, of z₀ and of q.
const WIDTH: usize = 2 * MOST + 2;

struct Tableau {
    size: usize,
    rows: [[f64; WIDTH]; MOST],
    /// The variable that is basic in each row.
    basis: [usize; MOST],
}

/// The rows of z that are basic at the end of the path, and the number of pivots; `None` on a ray or after too many.
pub(super) fn follow(normals: &Rows) -> Option<(Support, usize)> {
    let mut tableau = Tableau::new(normals);
    let n = tableau.size;
    let (mut entering, mut row) = (2 * n, tableau.first());
    for pivots in 1..=lemke_pivot_limit::<f64>(n) {
        let leaving = tableau.pivot(row, entering);
        if leaving == 2 * n {
            return Some((tableau.support(), pivots));
        }
        entering = if leaving < n { leaving + n } else { leaving - n };
        row = tableau.smallest_ratio(entering)?;
    }
    None
}

impl Tableau {
    fn new(normals: &Rows) -> Tableau {
        let n = normals.size;
        let mut scale = [1.0; MOST];
        for (i, scale) in scale[..n].iter_mut().enumerate().filter(|(i, _)| normals.matrix[*i][*i] > 0.0) {
            *scale = 1.0 / normals.matrix[i][i].sqrt();
        }
        let largest = (0..n).map(|i| (scale[i] * normals.vector[i]).abs()).fold(0.0, f64::max);
        let unit = if largest > 0.0 { 1.0 / largest } else { 1.0 };
        let mut rows = [[0.0; WIDTH]; MOST];
        for (i, row) in rows[..n].iter_mut().enumerate() {
            row[i] = 1.0;
            (0..n).for_each(|j| row[n + j] = -scale[i] * normals.matrix[i][j] * scale[j]);
            row[2 * n] = -1.0;
            row[2 * n + 1] = scale[i] * normals.vector[i] * unit;
        }
        Tableau { size: n, rows, basis: std::array::from_fn(|row| row) }
    }

    /// The row whose w leaves when z₀ enters: the least q, of several the last, which comes first in the lexicographic order.
    fn first(&self) -> usize {
        let q = |row: usize| self.rows[row][2 * self.size + 1];
        (1..self.size).fold(0, |least, row| if q(row) <= q(least) { row } else { least })
    }

    /// Brings a variable into the basis in place of the one in this row, and names that one.
    fn pivot(&mut self, row: usize, entering: usize) -> usize {
        let (n, width) = (self.size, 2 * self.size + 2);
        let inverse = 1.0 / self.rows[row][entering];
        self.rows[row][..width].iter_mut().for_each(|entry| *entry *= inverse);
        let pivot = self.rows[row];
        for (_, other) in self.rows[..n].iter_mut().enumerate().filter(|(i, other)| *i != row && other[entering] != 0.0) {
            let factor = other[entering];
            other[..width].iter_mut().zip(&pivot).for_each(|(entry, above)| *entry -= factor * above);
        }
        std::mem::replace(&mut self.basis[row], entering)
    }

    /// The row of the lexicographically smallest ratio to the positive entries of a column; z₀ leaves as soon as it may.
    fn smallest_ratio(&self, column: usize) -> Option<usize> {
        let (n, nothing) = (self.size, negligible::<f64>(self.size));
        let mut best: Option<usize> = None;
        for row in (0..n).filter(|row| self.rows[*row][column] > nothing) {
            if best.is_none_or(|best| self.comes_before(row, best, column, nothing)) {
                best = Some(row);
            }
        }
        best
    }

    fn comes_before(&self, row: usize, best: usize, column: usize, nothing: f64) -> bool {
        let (n, [one, other]) = (self.size, [row, best].map(|row| (&self.rows[row], self.rows[row][column])));
        let difference = |place: usize| one.0[place] / one.1 - other.0[place] / other.1;
        let first = difference(2 * n + 1);
        if first.abs() > nothing {
            return first < 0.0;
        }
        if self.basis[row] == 2 * n || self.basis[best] == 2 * n {
            return self.basis[row] == 2 * n;
        }
        (0..n).map(difference).find(|difference| difference.abs() > nothing).is_some_and(|difference| difference < 0.0)
    }

    fn support(&self) -> Support {
        let basic = self.basis[..self.size].iter().filter(|variable| **variable >= self.size);
        basic.fold(0, |support, variable| support | bit(*variable - self.size))
    }
}
