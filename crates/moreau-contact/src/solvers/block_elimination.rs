//! J x = b by elimination contact by contact, where J has blocks of the contacts that meet:
//!
//! ```text
//!     J_jk = B_j W_jk + δ_jk A_j ,      J = L U ,   U_kk the block that is left of contact k when it is eliminated
//! ```
//! A contact that is open has B = 0: its rows give its own unknowns at once. The others are eliminated in an order of least degree: next
//! comes the contact that meets the fewest of those that are left, for what it meets will meet each other. Inside of a block the rows are
//! exchanged for the largest pivot, between blocks they are not: for Newton's method J is a shifted, row-scaled positive semidefinite W,
//! and what rounding spoils costs a step, not the answer.
//!
//! # Source
//! Davis, *Direct methods for sparse linear systems*, SIAM 2006, chapters 6 and 7.

use crate::operator::BlockSparse;
use nalgebra::{DVector, Matrix3, SMatrix, SVector};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A_j and B_j of one contact, padded to three rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slopes {
    /// A_j.
    pub own: Matrix3<f64>,
    /// B_j.
    pub through: Matrix3<f64>,
}

/// J, factored.
pub(super) struct Factored(Size);

enum Size {
    One(Factor<1>),
    Two(Factor<2>),
    Three(Factor<3>),
}

/// The x with J x = b; `None` where a block that should be eliminated is singular.
pub(super) fn solve(w: &BlockSparse, slopes: &[Slopes], right_side: &DVector<f64>) -> Option<DVector<f64>> {
    Some(Factored::new(w, slopes)?.solve(w, right_side))
}

impl Factored {
    /// `None` where a block that should be eliminated is singular.
    ///
    /// # Panics
    /// If W has not 1, 2 or 3 rows per contact.
    pub(super) fn new(w: &BlockSparse, slopes: &[Slopes]) -> Option<Self> {
        Some(Factored(match w.rows_per_contact() {
            1 => Size::One(Factor::new(w, slopes)?),
            2 => Size::Two(Factor::new(w, slopes)?),
            3 => Size::Three(Factor::new(w, slopes)?),
            other => panic!("contacts have 1, 2 or 3 rows, not {other}"),
        }))
    }

    /// The x with J x = b, of the same W.
    ///
    /// # Panics
    /// If b has another size.
    pub(super) fn solve(&self, w: &BlockSparse, right_side: &DVector<f64>) -> DVector<f64> {
        assert_eq!(right_side.len(), w.contacts() * w.rows_per_contact(), "the right side has one entry per row");
        match &self.0 {
            Size::One(factor) => factor.solve(w, right_side),
            Size::Two(factor) => factor.solve(w, right_side),
            Size::Three(factor) => factor.solve(w, right_side),
        }
    }
}

/// L and U of the closed contacts, and what the open ones need.
struct Factor<const D: usize> {
    through: Vec<SMatrix<f64, D, D>>,
    /// A⁻¹ of the open contacts.
    open: Vec<(usize, SMatrix<f64, D, D>)>,
    is_open: Vec<bool>,
    /// The closed contacts in the order of elimination.
    order: Vec<usize>,
    pattern: Pattern,
    /// By place, L_ik at the places of `pattern.lower`.
    lower: Vec<Vec<SMatrix<f64, D, D>>>,
    /// By place, U_ij at the places of `pattern.upper`.
    upper: Vec<Vec<SMatrix<f64, D, D>>>,
    /// U_ii⁻¹.
    inverses: Vec<SMatrix<f64, D, D>>,
}

impl<const D: usize> Factor<D> {
    fn new(w: &BlockSparse, slopes: &[Slopes]) -> Option<Self> {
        let [own, through] = [|slopes: &Slopes| slopes.own, |slopes: &Slopes| slopes.through].map(|part| {
            slopes.iter().map(|slopes| part(slopes).fixed_view::<D, D>(0, 0).into_owned()).collect::<Vec<SMatrix<f64, D, D>>>()
        });
        let is_open: Vec<bool> = through.iter().map(|through| through.iter().all(|entry| *entry == 0.0)).collect();
        let open = (0..own.len()).filter(|&k| is_open[k]).map(|k| Some((k, inverse(own[k])?))).collect::<Option<_>>()?;
        let closed: Vec<usize> = (0..own.len()).filter(|&k| !is_open[k]).collect();
        let mut number = vec![usize::MAX; own.len()];
        closed.iter().enumerate().for_each(|(place, &k)| number[k] = place);
        let pattern = Pattern::new(&neighbours(w, &closed, &number));
        let mut rows: Vec<Vec<(usize, SMatrix<f64, D, D>)>> = vec![Vec::new(); closed.len()];
        for (column, &k) in closed.iter().enumerate() {
            for (j, block) in w.column(k).filter(|(j, _)| !is_open[*j]) {
                rows[pattern.place[number[j]]].push((pattern.place[column], through[j] * SMatrix::<f64, D, D>::from_column_slice(block)));
            }
            rows[pattern.place[column]].push((pattern.place[column], own[k]));
        }
        let order: Vec<usize> = pattern.order.iter().map(|&place| closed[place]).collect();
        let (lower, upper, inverses) = eliminate(&pattern, rows)?;
        Some(Factor { through, open, is_open, order, pattern, lower, upper, inverses })
    }

    fn solve(&self, w: &BlockSparse, right_side: &DVector<f64>) -> DVector<f64> {
        let mut found: Vec<SVector<f64, D>> = right_side.as_slice().chunks_exact(D).map(SVector::from_column_slice).collect();
        for (k, inverse) in &self.open {
            found[*k] = inverse * found[*k];
            for (j, block) in w.column(*k).filter(|(j, _)| !self.is_open[*j]) {
                let pushed = self.through[j] * (SMatrix::<f64, D, D>::from_column_slice(block) * found[*k]);
                found[j] -= pushed;
            }
        }
        let mut x: Vec<SVector<f64, D>> = self.order.iter().map(|&k| found[k]).collect();
        for i in 0..x.len() {
            x[i] = self.pattern.lower[i].iter().zip(&self.lower[i]).fold(x[i], |rest, (&k, factor)| rest - factor * x[k]);
        }
        for i in (0..x.len()).rev() {
            let known = self.pattern.upper[i].iter().zip(&self.upper[i]).fold(x[i], |rest, (&j, block)| rest - block * x[j]);
            x[i] = self.inverses[i] * known;
        }
        self.order.iter().zip(x).for_each(|(&k, x)| found[k] = x);
        DVector::from_iterator(right_side.len(), found.iter().flat_map(|part| part.iter().copied()))
    }
}

/// Of every closed contact the others it meets, numbered among the closed ones, growing.
fn neighbours(w: &BlockSparse, closed: &[usize], number: &[usize]) -> Vec<Vec<usize>> {
    let mut met = vec![Vec::new(); closed.len()];
    for (column, &k) in closed.iter().enumerate() {
        for (j, _) in w.column(k).filter(|(j, _)| *j != k && number[*j] != usize::MAX) {
            met[column].push(number[j]);
            met[number[j]].push(column);
        }
    }
    for list in &mut met {
        list.sort_unstable();
        list.dedup();
    }
    met
}

/// An order of elimination with the places that fill.
struct Pattern {
    /// The contacts in the order in which they are eliminated.
    order: Vec<usize>,
    /// Where in the order each contact is.
    place: Vec<usize>,
    /// By place, the later places that a contact meets when it is eliminated, growing.
    upper: Vec<Vec<usize>>,
    /// By place, the earlier places that meet it, growing.
    lower: Vec<Vec<usize>>,
}

impl Pattern {
    /// Least degree first, the first of several.
    fn new(neighbours: &[Vec<usize>]) -> Self {
        let count = neighbours.len();
        let mut met = neighbours.to_vec();
        let mut waiting: BinaryHeap<Reverse<(usize, usize)>> = met.iter().enumerate().map(|(k, list)| Reverse((list.len(), k))).collect();
        let (mut order, mut place) = (Vec::with_capacity(count), vec![usize::MAX; count]);
        let mut upper: Vec<Vec<usize>> = Vec::with_capacity(count);
        let mut merged = Vec::new();
        while let Some(Reverse((degree, k))) = waiting.pop() {
            if place[k] != usize::MAX || degree != met[k].len() {
                continue;
            }
            place[k] = order.len();
            order.push(k);
            let list = std::mem::take(&mut met[k]);
            for &j in &list {
                merge(&met[j], &list, [j, k], &mut merged);
                std::mem::swap(&mut met[j], &mut merged);
                waiting.push(Reverse((met[j].len(), j)));
            }
            upper.push(list);
        }
        let mut lower = vec![Vec::new(); count];
        for (at, list) in upper.iter_mut().enumerate() {
            list.iter_mut().for_each(|k| *k = place[*k]);
            list.sort_unstable();
            list.iter().for_each(|&later| lower[later].push(at));
        }
        Pattern { order, place, upper, lower }
    }
}

/// The union of two growing lists without two of its members.
fn merge(one: &[usize], other: &[usize], without: [usize; 2], merged: &mut Vec<usize>) {
    merged.clear();
    let (mut i, mut j) = (0, 0);
    while i < one.len() || j < other.len() {
        let next = match (one.get(i), other.get(j)) {
            (Some(a), Some(b)) => *a.min(b),
            (Some(a), None) => *a,
            (None, Some(b)) => *b,
            (None, None) => break,
        };
        i += usize::from(one.get(i) == Some(&next));
        j += usize::from(other.get(j) == Some(&next));
        if !without.contains(&next) {
            merged.push(next);
        }
    }
}

/// L, U and U_ii⁻¹, row after row of blocks: L_ik = J_ik U_kk⁻¹, and row i less L_ik times row k of U.
type Triangles<const D: usize> = (Vec<Vec<SMatrix<f64, D, D>>>, Vec<Vec<SMatrix<f64, D, D>>>, Vec<SMatrix<f64, D, D>>);

fn eliminate<const D: usize>(pattern: &Pattern, rows: Vec<Vec<(usize, SMatrix<f64, D, D>)>>) -> Option<Triangles<D>> {
    let count = rows.len();
    let mut work = vec![SMatrix::<f64, D, D>::zeros(); count];
    let [mut lower, mut upper]: [Vec<Vec<SMatrix<f64, D, D>>>; 2] = [Vec::with_capacity(count), Vec::with_capacity(count)];
    let mut inverses: Vec<SMatrix<f64, D, D>> = Vec::with_capacity(count);
    for (i, row) in rows.into_iter().enumerate() {
        row.into_iter().for_each(|(j, block)| work[j] += block);
        let mut factors = Vec::with_capacity(pattern.lower[i].len());
        for &k in &pattern.lower[i] {
            let factor = std::mem::replace(&mut work[k], SMatrix::zeros()) * inverses[k];
            for (&j, block) in pattern.upper[k].iter().zip(&upper[k]) {
                work[j] -= factor * block;
            }
            factors.push(factor);
        }
        lower.push(factors);
        inverses.push(inverse(std::mem::replace(&mut work[i], SMatrix::zeros()))?);
        upper.push(pattern.upper[i].iter().map(|&j| std::mem::replace(&mut work[j], SMatrix::zeros())).collect());
    }
    Some((lower, upper, inverses))
}

/// A⁻¹ of one block by Gauss's and Jordan's steps with the largest pivot of each column; none if one is zero.
fn inverse<const D: usize>(mut block: SMatrix<f64, D, D>) -> Option<SMatrix<f64, D, D>> {
    let mut inverse = SMatrix::<f64, D, D>::identity();
    for k in 0..D {
        let pivot = (k + 1..D).fold(k, |best, i| if block[(i, k)].abs() > block[(best, k)].abs() { i } else { best });
        block.swap_rows(k, pivot);
        inverse.swap_rows(k, pivot);
        let scale = block[(k, k)];
        if scale == 0.0 {
            return None;
        }
        for j in 0..D {
            block[(k, j)] /= scale;
            inverse[(k, j)] /= scale;
        }
        for i in (0..D).filter(|i| *i != k) {
            let factor = block[(i, k)];
            for j in 0..D {
                block[(i, j)] -= factor * block[(k, j)];
                inverse[(i, j)] -= factor * inverse[(k, j)];
            }
        }
    }
    Some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    /// W of contacts on a grid that meet their neighbours, dominated by its diagonal, and slopes of which every third is open.
    fn problem(d: usize, side: usize, seed: u64) -> (BlockSparse, Vec<Slopes>, DVector<f64>) {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / (1u64 << 30) as f64 - 1.0
        };
        let count = side * side;
        let mut blocks = Vec::new();
        for j in 0..count {
            for k in 0..count {
                let far = (j / side).abs_diff(k / side) + (j % side).abs_diff(k % side);
                if far <= 1 {
                    let entry = DMatrix::from_fn(d, d, |a, b| next() + if far == 0 && a == b { 9.0 * d as f64 } else { 0.0 });
                    blocks.push((j, k, entry));
                }
            }
        }
        let mut slopes = Vec::new();
        for k in 0..count {
            let through = if k % 3 == 0 { Matrix3::zeros() } else { Matrix3::identity() + Matrix3::from_fn(|_, _| 0.1 * next()) };
            slopes.push(Slopes { own: Matrix3::identity() + Matrix3::from_fn(|_, _| 0.1 * next()), through });
        }
        let right = DVector::from_fn(d * count, |_, _| next());
        (BlockSparse::new(d, count, blocks).unwrap(), slopes, right)
    }

    fn dense(w: &BlockSparse, slopes: &[Slopes]) -> DMatrix<f64> {
        let d = w.rows_per_contact();
        let mut jacobian = w.to_dense();
        for (k, slopes) in slopes.iter().enumerate() {
            let rows = slopes.through.view((0, 0), (d, d)) * jacobian.rows(k * d, d);
            jacobian.rows_mut(k * d, d).copy_from(&rows);
            let mut own = jacobian.view_mut((k * d, k * d), (d, d));
            own += slopes.own.view((0, 0), (d, d));
        }
        jacobian
    }

    #[test]
    fn the_answer_solves_the_dense_system() {
        for (d, side, seed) in [(1, 1, 1), (1, 7, 2), (2, 5, 3), (3, 6, 4)] {
            let (w, slopes, right) = problem(d, side, seed);
            let x = solve(&w, &slopes, &right).expect("dominated by its diagonal");
            let matrix = dense(&w, &slopes);
            let rounding = moreau_exact::tolerance::rounding(64, matrix.amax() * x.amax());
            assert!((matrix * x - right).amax() <= rounding, "{d} rows, {side} contacts in a row");
        }
    }

    #[test]
    fn a_chain_does_not_fill_and_a_star_is_begun_at_its_ends() {
        let chain: Vec<Vec<usize>> =
            (0..50usize).map(|k| [k.checked_sub(1), (k < 49).then_some(k + 1)].into_iter().flatten().collect()).collect();
        assert!(Pattern::new(&chain).upper.iter().all(|later| later.len() <= 1));
        let mut star = vec![vec![0]; 20];
        star[0] = (1..20).collect();
        let pattern = Pattern::new(&star);
        assert!(pattern.place[0] >= 18 && pattern.upper.iter().all(|later| later.len() <= 1));
    }

    #[test]
    fn a_singular_block_has_no_answer() {
        let (w, mut slopes, right) = problem(2, 2, 5);
        slopes[0] = Slopes { own: Matrix3::zeros(), through: Matrix3::zeros() };
        assert_eq!(solve(&w, &slopes, &right), None);
    }
}
