//! J x = b over contacts, eliminated in velocities:
//!
//! ```text
//!     J = B W + A ,  W = Y Yᵀ ,  D = A⁻¹B :        (I + Yᵀ D Y) v = Yᵀ A⁻¹ b ,     x = A⁻¹ (b − B Y v)
//! ```
//! A and B have one block per contact. There are as many unknowns as velocities, however many contacts share them, and bodies meet fewer
//! bodies than contacts meet contacts. Each contact is added to the front in which the first of its groups is eliminated. x loses as many
//! digits as D has more than 1/W; they are won back by solving for what J leaves of b. W x is Y (Yᵀ x), for Y is much smaller than W.

use super::block_elimination::Slopes;
use super::parts::copy;
use crate::fronts::{Factor, Front, Tree, Work};
use crate::memory::spare::Spare;
use crate::operator::{Lists, VelocityFactor};
use crate::tolerance::velocities::{REFINED, REFINEMENTS, TRUSTED};
use nalgebra::{DVector, Matrix3, Vector3};

/// J, factored; all memory is kept for another one, and the order of the groups for another one with the same Y.
#[derive(Debug, Default)]
pub(super) struct VelocityElimination {
    y: VelocityFactor,
    /// Of every group the others that it meets.
    met: Lists,
    tree: Tree,
    /// The contacts that each node adds.
    contacts: Lists,
    /// A_k⁻¹, B_k and A_k.
    slopes: Vec<[Matrix3<f64>; 3]>,
    factor: Factor,
    work: Work,
    /// v, and A_k⁻¹ b of every contact.
    velocities: Vec<f64>,
    pushed: Vec<Vector3<f64>>,
    best: Attempt,
    tried: Attempt,
}

/// An x with what it leaves.
#[derive(Debug, Default)]
struct Attempt {
    x: DVector<f64>,
    /// W x.
    moved: DVector<f64>,
    /// b − J x.
    left: DVector<f64>,
}

impl VelocityElimination {
    /// Prepares for systems with the W of this factor.
    pub(super) fn prepare(&mut self, factor: &VelocityFactor) {
        let VelocityElimination { y, met, tree, contacts, .. } = self;
        y.copy_from(factor);
        met.collect(y.columns.len(), |show| {
            for parts in (0..y.contacts()).map(|k| y.parts(k)) {
                for (group, _) in parts {
                    parts.iter().filter(|(other, _)| other != group).for_each(|(other, _)| show(*group, *other));
                }
            }
        });
        met.sort_each();
        tree.plan(&y.columns, met);
        contacts.collect(tree.nodes.len(), |show| {
            for k in (0..y.contacts()).filter(|_| !tree.is_given_up) {
                if let Some(node) = y.parts(k).iter().map(|(group, _)| tree.node_of[*group]).min() {
                    show(node, k);
                }
            }
        });
    }

    /// False where an A_k or the sum is singular. Where D is symmetric the sum must be definite.
    pub(super) fn factor(&mut self, slopes: &[Slopes], is_symmetric: bool) -> bool {
        let d = self.y.rows_per_contact();
        self.slopes.clear();
        for Slopes { own, through, inverse } in slopes {
            let padded = Matrix3::from_fn(|i, j| if i < d && j < d { own[(i, j)] } else { f64::from(i == j) });
            let Some(inverse) = inverse.or_else(|| padded.try_inverse()) else { return false };
            self.slopes.push([inverse, *through, padded]);
        }
        let VelocityElimination { y, tree, contacts, slopes, factor, work, .. } = self;
        factor.compute(tree, is_symmetric, work, |node, front| {
            let groups = &tree.nodes[node];
            (0..groups.pivots).for_each(|i| front.entries[i * front.size + i] = 1.0);
            for &k in &contacts[node] {
                let [inverse, through, _] = &slopes[k];
                add_contact(tree, y.parts(k), &y.entries, &(inverse * through), is_symmetric, front);
            }
        })
    }

    /// The x with J x = b, of the last J that was factored; none where too many digits are lost.
    pub(super) fn solve(&mut self, right_side: &DVector<f64>) -> Option<DVector<f64>> {
        let [mut best, mut tried] = [&mut self.best, &mut self.tried].map(std::mem::take);
        copy(right_side, &mut best.x);
        self.once(right_side, &mut best.x);
        self.leave(right_side, &mut best);
        for _ in 0..REFINEMENTS {
            if best.left.amax() <= REFINED * right_side.amax() {
                break;
            }
            copy(&best.left, &mut tried.x);
            self.once(&best.left, &mut tried.x);
            tried.x += &best.x;
            self.leave(right_side, &mut tried);
            if tried.left.amax().is_nan() || tried.left.amax() >= best.left.amax() {
                break;
            }
            std::mem::swap(&mut best, &mut tried);
        }
        let is_trusted = best.left.amax() <= TRUSTED * right_side.amax();
        let found = is_trusted.then(|| best.x.copied());
        (self.best, self.tried) = (best, tried);
        found
    }

    /// W x of the last x.
    pub(super) fn moved(&self) -> &DVector<f64> {
        &self.best.moved
    }

    /// A_k and B_k of contact k of the last J.
    pub(super) fn slopes(&self) -> impl Iterator<Item = Slopes> {
        self.slopes.iter().map(|[inverse, through, own]| Slopes { own: *own, through: *through, inverse: Some(*inverse) })
    }

    /// Overwrites W x and b − J x.
    fn leave(&mut self, right_side: &DVector<f64>, Attempt { x, moved, left }: &mut Attempt) {
        let VelocityElimination { y, tree, slopes, velocities: v, .. } = self;
        let d = y.rows_per_contact();
        copy(x, moved);
        copy(x, left);
        v.clear();
        v.resize(tree.starts[tree.starts.len() - 1], 0.0);
        let padded = |of: &DVector<f64>, k: usize| Vector3::from_fn(|i, _| if i < d { of[k * d + i] } else { 0.0 });
        (0..slopes.len()).for_each(|k| push(y, tree, k, &padded(x, k), v));
        for (k, [_, through, own]) in slopes.iter().enumerate() {
            let u = pull(y, tree, k, v);
            let row = through * u + own * padded(x, k);
            (0..d).for_each(|i| (moved[k * d + i], left[k * d + i]) = (u[i], right_side[k * d + i] - row[i]));
        }
    }

    /// Overwrites x with the one that the factor has.
    fn once(&mut self, right_side: &DVector<f64>, x: &mut DVector<f64>) {
        let VelocityElimination { y, tree, slopes, factor, work, velocities: v, pushed, .. } = self;
        let d = y.rows_per_contact();
        v.clear();
        v.resize(tree.starts[tree.starts.len() - 1], 0.0);
        pushed.clear();
        for (k, [inverse, ..]) in slopes.iter().enumerate() {
            let own = inverse * Vector3::from_fn(|i, _| if i < d { right_side[k * d + i] } else { 0.0 });
            push(y, tree, k, &own, v);
            pushed.push(own);
        }
        factor.solve(tree, v, work);
        for (k, [inverse, through, _]) in slopes.iter().enumerate() {
            let own = pushed[k] - inverse * (through * pull(y, tree, k, v));
            (0..d).for_each(|i| x[k * d + i] = own[i]);
        }
    }
}

/// v += Y_kᵀ x.
fn push(of: &VelocityFactor, tree: &Tree, contact: usize, x: &Vector3<f64>, v: &mut [f64]) {
    for &(group, at) in of.parts(contact) {
        let range = tree.starts[group]..tree.starts[group + 1];
        let n = range.len();
        let (target, y) = (&mut v[range], &of.entries[at..at + 3 * n]);
        if let (Ok(target), [y0, y1, y2]) = (<&mut [f64; SPATIAL]>::try_from(&mut *target), y.as_chunks().0) {
            add_rows(target, [y0, y1, y2], [x[0], x[1], x[2]]);
            continue;
        }
        target.iter_mut().enumerate().for_each(|(j, v)| *v += y[j] * x[0] + y[n + j] * x[1] + y[2 * n + j] * x[2]);
    }
}

/// Velocities of a body in space, which nearly all are.
const SPATIAL: usize = 6;

/// Adds three rows, each times its factor: as one by one, bit for bit.
#[inline(always)]
fn add_rows(target: &mut [f64; SPATIAL], rows: [&[f64; SPATIAL]; 3], factors: [f64; 3]) {
    for i in 0..SPATIAL {
        target[i] += rows[0][i] * factors[0] + rows[1][i] * factors[1] + rows[2][i] * factors[2];
    }
}

/// Y_k v.
fn pull(of: &VelocityFactor, tree: &Tree, contact: usize, v: &[f64]) -> Vector3<f64> {
    let mut moved = Vector3::zeros();
    for &(group, at) in of.parts(contact) {
        let v = &v[tree.starts[group]..tree.starts[group + 1]];
        if let (Some(v), Some(rows)) = (v.as_array::<SPATIAL>(), of.entries[at..].as_chunks::<SPATIAL>().0.first_chunk::<3>()) {
            let dot = |row: &[f64; SPATIAL]| row.iter().zip(v).map(|(y, v)| y * v).sum::<f64>();
            (0..3).for_each(|i| moved[i] += dot(&rows[i]));
            continue;
        }
        for (i, row) in of.entries[at..at + 3 * v.len()].chunks_exact(v.len().max(1)).enumerate() {
            moved[i] += row.iter().zip(v).map(|(y, v)| y * v).sum::<f64>();
        }
    }
    moved
}

/// Adds Y_kᵀ D_k Y_k; of a symmetric one the lower triangle.
fn add_contact(tree: &Tree, parts: &[(usize, usize)], y: &[f64], d: &Matrix3<f64>, is_symmetric: bool, front: &mut Front) {
    if d.iter().all(|entry| *entry == 0.0) {
        return;
    }
    let columns = |group: usize| tree.starts[group + 1] - tree.starts[group];
    for &(one, at) in parts {
        let (n, first) = (columns(one), front.local[one]);
        for j in 0..n {
            let column = d * Vector3::new(y[at + j], y[at + n + j], y[at + 2 * n + j]);
            for &(other, begin) in parts {
                let (m, row) = (columns(other), front.local[other]);
                if is_symmetric && row < first {
                    continue;
                }
                let from = if is_symmetric && row == first { j } else { 0 };
                let place = (first + j) * front.size + row;
                let (target, y) = (&mut front.entries[place..place + m], &y[begin..begin + 3 * m]);
                if let (0, Ok(target), [y0, y1, y2]) = (from, <&mut [f64; SPATIAL]>::try_from(&mut *target), y.as_chunks().0) {
                    add_rows(target, [y0, y1, y2], [column[0], column[1], column[2]]);
                    continue;
                }
                for i in from..m {
                    target[i] += y[i] * column[0] + y[m + i] * column[1] + y[2 * m + i] * column[2];
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operator::wall;
    use crate::solvers::block_elimination::BlockElimination;
    use moreau_exact::tolerance::rounding;

    /// Elimination over contacts is the independent derivation; half of the contacts are open, every fifth is stiff.
    #[test]
    fn both_eliminations_have_the_same_answer() {
        let w = wall(4, 3, 1.0);
        let factor = VelocityFactor::recover(&w).expect("bricks");
        let mut velocities = VelocityElimination::default();
        for is_symmetric in [true, false] {
            let slopes: Vec<Slopes> = (0..w.contacts())
                .map(|k| {
                    let turned = Matrix3::from_fn(|i, j| 0.1 * ((k + 2 * i + 3 * j) % 5) as f64);
                    let own = Matrix3::identity() * if k % 5 == 0 { 0.01 } else { 1.0 };
                    let own = if is_symmetric { own } else { own + turned };
                    let open = !is_symmetric && k % 2 == 0;
                    Slopes { own, through: if open { Matrix3::zeros() } else { Matrix3::identity() }, inverse: None }
                })
                .collect();
            let right = DVector::from_fn(3 * w.contacts(), |i, _| (i % 7) as f64 - 3.0);
            velocities.prepare(&factor);
            let mut contacts = BlockElimination::default();
            assert!(velocities.factor(&slopes, is_symmetric) && contacts.factor(&w, &slopes, is_symmetric));
            let (one, other) = (velocities.solve(&right).expect("well conditioned"), contacts.solve(&w, &right));
            assert!((&one - &other).amax() <= rounding(1 << 12, other.amax()), "{}", (&one - &other).amax());
        }
    }

    #[test]
    fn an_answer_that_lost_its_digits_is_not_given() {
        let w = wall(3, 2, 1.0);
        let factor = VelocityFactor::recover(&w).expect("bricks");
        let mut velocities = VelocityElimination::default();
        velocities.prepare(&factor);
        let right = DVector::from_element(3 * w.contacts(), 1.0);
        let slopes = |own: f64| vec![Slopes { own: Matrix3::identity() * own, through: Matrix3::identity(), inverse: None }; w.contacts()];
        assert!(velocities.factor(&slopes(1e-3), true) && velocities.solve(&right).is_some());
        // what is planted: an inverse that belongs to another A
        let wrong = slopes(1.0).into_iter().map(|slopes| Slopes { inverse: Some(Matrix3::identity() * 3.0), ..slopes }).collect::<Vec<_>>();
        assert!(velocities.factor(&wrong, true) && velocities.solve(&right).is_none());
        assert!(!velocities.factor(&slopes(0.0), true), "A is singular");
    }
}
