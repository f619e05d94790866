//! J x = b over contacts, where J has blocks of the contacts that meet:
//!
//! ```text
//!     J_jk = B_j W_jk + δ_jk A_j
//! ```
//! A contact that is open has B = 0: its rows give its own unknowns at once. The others are eliminated by fronts (`fronts/`). From
//! one J to the next a few contacts open and close: the order is kept while all that are closed are in it, and most in it are closed.
//! Rows are exchanged inside of a front, between fronts they are not: for Newton's method J is a shifted, row-scaled positive semidefinite
//! W, and what rounding spoils costs a step, not the answer.

use crate::fronts::{Factor, Front, Tree, Work};
use crate::memory::spare::{Spare, spare_entries};
use crate::operator::{BlockSparse, Lists};
use crate::tolerance::fronts::ONE_FRONT;
use nalgebra::{DVector, Matrix3, Vector3};

/// A_j and B_j of one contact, padded to three rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slopes {
    /// A_j.
    pub own: Matrix3<f64>,
    /// B_j.
    pub through: Matrix3<f64>,
    /// A_j⁻¹ where it is known better than from A_j.
    pub inverse: Option<Matrix3<f64>>,
}

spare_entries![Slopes];

impl Slopes {
    fn is_open(&self) -> bool {
        self.through.iter().all(|entry| *entry == 0.0)
    }
}

/// J, factored; the order is kept for the next one with the same open contacts, and the memory for every other one.
#[derive(Debug, Default)]
pub(super) struct BlockElimination {
    plan: Plan,
    factor: Factor,
    work: Work,
    /// Which contacts are open, and the unknowns of those that are not left out.
    is_open: Vec<bool>,
    unknowns: Vec<f64>,
    /// B_j, and A_j⁻¹ of the open contacts.
    through: Vec<Matrix3<f64>>,
    open: Vec<(usize, Matrix3<f64>)>,
}

/// Which contacts are eliminated by fronts, and how.
#[derive(Debug, Default)]
struct Plan {
    /// Whether it was made for this W.
    is_made: bool,
    /// Whether a contact is left out because it is open.
    is_left_out: Vec<bool>,
    /// The others; some of them may be open, too.
    closed: Vec<usize>,
    /// Of every closed contact the others it meets, numbered among the closed ones, growing.
    neighbours: Lists,
    tree: Tree,
    /// The number of every contact among the closed ones, and the rows of these.
    number: Vec<usize>,
    rows: Vec<usize>,
}

impl Plan {
    /// Plans a J with these open contacts.
    fn make(&mut self, w: &BlockSparse, is_open: &[bool]) {
        let Plan { is_made, is_left_out, closed, neighbours, tree, number, rows } = self;
        *is_made = true;
        is_left_out.clear();
        is_left_out.extend_from_slice(is_open);
        closed.clear();
        closed.extend((0..is_open.len()).filter(|&k| !is_open[k]));
        number.clear();
        number.resize(is_open.len(), usize::MAX);
        closed.iter().enumerate().for_each(|(place, &k)| number[k] = place);
        neighbours.collect(closed.len(), |show| {
            for (column, &k) in closed.iter().enumerate() {
                for (j, _) in w.column(k).filter(|(j, _)| *j != k && number[*j] != usize::MAX) {
                    show(column, number[j]);
                    show(number[j], column);
                }
            }
        });
        neighbours.sort_each();
        rows.clear();
        rows.resize(closed.len(), w.rows_per_contact());
        if closed.len() <= ONE_FRONT { tree.plan_one_front(rows) } else { tree.plan(rows, neighbours) }
    }

    /// Whether it serves for a J with these open contacts.
    fn serves(&self, is_open: &[bool]) -> bool {
        let still_open = self.is_made && self.is_left_out.iter().zip(is_open).all(|(left_out, open)| !left_out || *open);
        still_open && 2 * is_open.iter().filter(|open| !**open).count() >= self.closed.len()
    }
}

impl BlockElimination {
    /// Forgets the order, for another W.
    pub(super) fn forget(&mut self) {
        self.plan.is_made = false;
    }

    /// False where a block that should be eliminated is singular. A J that is symmetric must be definite.
    ///
    /// # Panics
    /// If W has not 1, 2 or 3 rows per contact.
    pub(super) fn factor(&mut self, w: &BlockSparse, slopes: &[Slopes], is_symmetric: bool) -> bool {
        let d = w.rows_per_contact();
        assert!((1..=3).contains(&d), "contacts have 1, 2 or 3 rows, not {d}");
        self.is_open.clear();
        self.is_open.extend(slopes.iter().map(Slopes::is_open));
        if !self.plan.serves(&self.is_open) {
            self.plan.make(w, &self.is_open);
        }
        let plan = &self.plan;
        self.open.clear();
        for (k, slopes) in slopes.iter().enumerate().filter(|(k, _)| plan.is_left_out[*k]) {
            let Some(inverse) = padded(&slopes.own, d).try_inverse() else { return false };
            self.open.push((k, inverse));
        }
        self.through.clear();
        self.through.extend(slopes.iter().map(|slopes| slopes.through));
        self.factor.compute(&plan.tree, is_symmetric, &mut self.work, |node, front| assemble(w, slopes, plan, node, is_symmetric, front))
    }

    /// Whether the last J was not factored for want of memory or time, and may be regular.
    pub(super) fn was_left(&self) -> bool {
        self.factor.was_left
    }

    /// The x with J x = b, of the last J that was factored and the same W.
    ///
    /// # Panics
    /// If none was, or b has another size.
    pub(super) fn solve(&mut self, w: &BlockSparse, right_side: &DVector<f64>) -> DVector<f64> {
        let (d, plan) = (w.rows_per_contact(), &self.plan);
        assert!(plan.is_made, "J was factored");
        assert_eq!(right_side.len(), w.contacts() * d, "the right side has one entry per row");
        let mut found = right_side.copied();
        for (k, inverse) in &self.open {
            let own = inverse * part(&found, d, *k);
            (0..d).for_each(|i| found[k * d + i] = own[i]);
            for (j, block) in w.column(*k).filter(|(j, _)| !plan.is_left_out[*j]) {
                let moved = Vector3::from_fn(|i, _| if i < d { (0..d).map(|c| block[c * d + i] * own[c]).sum() } else { 0.0 });
                let pushed = self.through[j] * moved;
                (0..d).for_each(|i| found[j * d + i] -= pushed[i]);
            }
        }
        let x = &mut self.unknowns;
        x.clear();
        plan.closed.iter().for_each(|k| x.extend_from_slice(&found.as_slice()[k * d..(k + 1) * d]));
        self.factor.solve(&plan.tree, x, &mut self.work);
        plan.closed.iter().enumerate().for_each(|(place, k)| (0..d).for_each(|i| found[k * d + i] = x[place * d + i]));
        found
    }
}

/// What rows beyond `d` have in a padded matrix: those of the identity.
fn padded(matrix: &Matrix3<f64>, d: usize) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| if i < d && j < d { matrix[(i, j)] } else { f64::from(i == j) })
}

fn part(of: &DVector<f64>, d: usize, k: usize) -> Vector3<f64> {
    Vector3::from_fn(|i, _| if i < d { of[k * d + i] } else { 0.0 })
}

/// The entries of J in the rows and columns of the pivots of one front.
fn assemble(w: &BlockSparse, slopes: &[Slopes], plan: &Plan, node: usize, is_symmetric: bool, front: &mut Front) {
    match w.rows_per_contact() {
        1 => assemble_rows::<1>(w, slopes, plan, node, is_symmetric, front),
        2 => assemble_rows::<2>(w, slopes, plan, node, is_symmetric, front),
        _ => assemble_rows::<3>(w, slopes, plan, node, is_symmetric, front),
    }
}

fn assemble_rows<const D: usize>(w: &BlockSparse, slopes: &[Slopes], plan: &Plan, node: usize, is_symmetric: bool, front: &mut Front) {
    let pivots = plan.tree.nodes[node].pivot_groups;
    let Front { entries, size, local } = front;
    let mut add = |row: usize, column: usize, block: &[f64], through: &Matrix3<f64>| {
        let (first, last) = (local[row], local[column]);
        for (c, block) in block.as_chunks::<D>().0.iter().enumerate() {
            let target = &mut entries[(last + c) * *size + first..][..D];
            for (i, entry) in target.iter_mut().enumerate() {
                *entry += (0..D).map(|term| through[(i, term)] * block[term]).sum::<f64>();
            }
        }
    };
    for &column in &plan.tree.groups(node)[..pivots] {
        let k = plan.closed[column];
        if let Some(block) = w.block(k, k) {
            add(column, column, block, &slopes[k].through);
        }
        for &other in plan.neighbours[column].iter().filter(|other| plan.tree.node_of[**other] >= node) {
            let (j, same) = (plan.closed[other], plan.tree.node_of[other] == node);
            if !is_symmetric || local[other] > local[column] {
                w.block(j, k).iter().for_each(|block| add(other, column, block, &slopes[j].through));
            }
            if !is_symmetric && !same {
                w.block(k, j).iter().for_each(|block| add(column, other, block, &slopes[k].through));
            }
        }
    }
    for &column in &plan.tree.groups(node)[..pivots] {
        let (first, own) = (local[column], &slopes[plan.closed[column]].own);
        (0..D * D).for_each(|place| entries[(first + place / D) * *size + first + place % D] += own[(place % D, place / D)]);
    }
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
            slopes.push(Slopes { own: Matrix3::identity() + Matrix3::from_fn(|_, _| 0.1 * next()), through, inverse: None });
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
        let mut kept = BlockElimination::default();
        for (d, side, seed) in [(1, 1, 1), (1, 7, 2), (2, 5, 3), (3, 6, 4), (3, 2, 5), (2, 6, 6)] {
            let (w, slopes, right) = problem(d, side, seed);
            kept.forget();
            assert!(kept.factor(&w, &slopes, false), "dominated by its diagonal");
            let x = kept.solve(&w, &right);
            let mut elimination = BlockElimination::default();
            assert!(elimination.factor(&w, &slopes, false));
            assert_eq!(elimination.solve(&w, &right), x, "the memory of other systems changes no bit");
            let matrix = dense(&w, &slopes);
            let rounding = moreau_exact::tolerance::rounding(64, matrix.amax() * x.amax());
            assert!((matrix * x - right).amax() <= rounding, "{d} rows, {side} contacts in a row");
        }
    }

    #[test]
    fn a_singular_block_has_no_answer() {
        let (w, mut slopes, _) = problem(2, 2, 5);
        slopes[0] = Slopes { own: Matrix3::zeros(), through: Matrix3::zeros(), inverse: None };
        assert!(!BlockElimination::default().factor(&w, &slopes, false));
    }
}
