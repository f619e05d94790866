//! J x = b over contacts, eliminated in velocities:
//!
//! ```text
//!     J = B W + A ,  W = Y Yᵀ ,  D = A⁻¹B :        (I + Yᵀ D Y) v = Yᵀ A⁻¹ b ,     x = A⁻¹ (b − B Y v)
//! ```
//! A and B have one block per contact. There are as many unknowns as velocities, however many contacts share them, and bodies meet fewer
//! bodies than contacts meet contacts. Each contact is added to the front in which the first of its groups is eliminated. x loses as many
//! digits as D has more than 1/W; they are won back by solving for what J with W itself leaves of b.

use super::block_elimination::Slopes;
use super::elimination_tree::Tree;
use super::multifrontal::{Factor, Front, Work};
use crate::operator::{BlockSparse, ContactOperator, VelocityFactor};
use crate::tolerance::velocities::{REFINED, REFINEMENTS, TRUSTED};
use nalgebra::{DVector, Matrix3, Vector3};

/// J, factored; the order of the groups and all memory are kept.
#[derive(Debug)]
pub(super) struct VelocityElimination {
    rows_per_contact: usize,
    tree: Tree,
    /// Of every contact its groups, and where its part of Y begins, row after row of three.
    parts: Vec<Vec<(usize, usize)>>,
    y: Vec<f64>,
    /// The contacts that each node adds.
    contacts: Vec<Vec<usize>>,
    /// A_k⁻¹, B_k and A_k.
    slopes: Vec<[Matrix3<f64>; 3]>,
    factor: Factor,
    work: Work,
}

impl VelocityElimination {
    pub(super) fn new(factor: &VelocityFactor, rows_per_contact: usize) -> Self {
        let mut met = vec![Vec::new(); factor.columns.len()];
        let (mut y, mut parts) = (Vec::new(), Vec::with_capacity(factor.parts.len()));
        for contact in &factor.parts {
            for (group, _) in contact {
                met[*group].extend(contact.iter().map(|(other, _)| *other).filter(|other| other != group));
            }
            let place = |(group, block): &(usize, nalgebra::DMatrix<f64>)| {
                let at = y.len();
                y.extend(
                    (0..3)
                        .flat_map(|i| (0..block.ncols()).map(move |j| (i, j)))
                        .map(|(i, j)| if i < block.nrows() { block[(i, j)] } else { 0.0 }),
                );
                (*group, at)
            };
            parts.push(contact.iter().map(place).collect::<Vec<_>>());
        }
        for list in &mut met {
            list.sort_unstable();
            list.dedup();
        }
        let tree = Tree::new(&factor.columns, met);
        let mut contacts = vec![Vec::new(); tree.nodes.len()];
        for (k, groups) in parts.iter().enumerate() {
            if let Some(node) = groups.iter().map(|(group, _)| tree.node_of[*group]).min() {
                contacts[node].push(k);
            }
        }
        let (factor, work) = Default::default();
        VelocityElimination { rows_per_contact, tree, parts, y, contacts, slopes: Vec::new(), factor, work }
    }

    /// False where an A_k or the sum is singular. Where D is symmetric the sum must be definite.
    pub(super) fn factor(&mut self, slopes: &[Slopes], is_symmetric: bool) -> bool {
        let d = self.rows_per_contact;
        self.slopes.clear();
        for Slopes { own, through, inverse } in slopes {
            let padded = Matrix3::from_fn(|i, j| if i < d && j < d { own[(i, j)] } else { f64::from(i == j) });
            let Some(inverse) = inverse.or_else(|| padded.try_inverse()) else { return false };
            self.slopes.push([inverse, *through, padded]);
        }
        let VelocityElimination { tree, parts, y, contacts, slopes, factor, work, .. } = self;
        factor.compute(tree, is_symmetric, work, |node, front| {
            let groups = &tree.nodes[node];
            (0..groups.pivots).for_each(|i| front.entries[i * front.size + i] = 1.0);
            for &k in &contacts[node] {
                let [inverse, through, _] = &slopes[k];
                add_contact(tree, &parts[k], y, &(inverse * through), is_symmetric, front);
            }
        })
    }

    /// The x with J x = b, of the last J that was factored and the W of which Y is a factor; none where too many digits are lost.
    pub(super) fn solve(&mut self, w: &BlockSparse, right_side: &DVector<f64>) -> Option<DVector<f64>> {
        let mut best = self.once(right_side);
        let mut left = right_side - self.apply(w, &best);
        for _ in 0..REFINEMENTS {
            if left.amax() <= REFINED * right_side.amax() {
                break;
            }
            let tried = &best + self.once(&left);
            let rest = right_side - self.apply(w, &tried);
            if rest.amax().is_nan() || rest.amax() >= left.amax() {
                break;
            }
            (best, left) = (tried, rest);
        }
        (left.amax() <= TRUSTED * right_side.amax()).then_some(best)
    }

    /// J x.
    fn apply(&self, w: &BlockSparse, x: &DVector<f64>) -> DVector<f64> {
        let (d, mut found) = (self.rows_per_contact, DVector::zeros(x.len()));
        w.add_product(x.as_slice(), found.as_mut_slice());
        for (k, [_, through, own]) in self.slopes.iter().enumerate() {
            let padded = |of: &DVector<f64>| Vector3::from_fn(|i, _| if i < d { of[k * d + i] } else { 0.0 });
            let row = through * padded(&found) + own * padded(x);
            (0..d).for_each(|i| found[k * d + i] = row[i]);
        }
        found
    }

    /// The x as the factor has it.
    fn once(&mut self, right_side: &DVector<f64>) -> DVector<f64> {
        let (d, tree) = (self.rows_per_contact, &self.tree);
        let mut v = DVector::zeros(tree.starts[tree.starts.len() - 1]);
        let mut pushed = Vec::with_capacity(self.slopes.len());
        for (k, [inverse, ..]) in self.slopes.iter().enumerate() {
            let own = inverse * Vector3::from_fn(|i, _| if i < d { right_side[k * d + i] } else { 0.0 });
            for &(group, at) in &self.parts[k] {
                let range = tree.starts[group]..tree.starts[group + 1];
                let n = range.len();
                let (target, y) = (&mut v.as_mut_slice()[range], &self.y[at..at + 3 * n]);
                target.iter_mut().enumerate().for_each(|(j, v)| *v += y[j] * own[0] + y[n + j] * own[1] + y[2 * n + j] * own[2]);
            }
            pushed.push(own);
        }
        self.factor.solve(tree, &mut v, &mut self.work);
        let mut x = right_side.clone();
        for (k, [inverse, through, _]) in self.slopes.iter().enumerate() {
            let mut moved = Vector3::zeros();
            for &(group, at) in &self.parts[k] {
                let v = &v.as_slice()[tree.starts[group]..tree.starts[group + 1]];
                for (i, row) in self.y[at..at + 3 * v.len()].chunks_exact(v.len().max(1)).enumerate() {
                    moved[i] += row.iter().zip(v).map(|(y, v)| y * v).sum::<f64>();
                }
            }
            let own = pushed[k] - inverse * (through * moved);
            (0..d).for_each(|i| x[k * d + i] = own[i]);
        }
        x
    }
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
            let mut velocities = VelocityElimination::new(&factor, 3);
            let mut contacts = BlockElimination::default();
            assert!(velocities.factor(&slopes, is_symmetric) && contacts.factor(&w, &slopes, is_symmetric));
            let (one, other) = (velocities.solve(&w, &right).expect("well conditioned"), contacts.solve(&w, &right));
            assert!((&one - &other).amax() <= rounding(1 << 12, other.amax()), "{}", (&one - &other).amax());
        }
    }

    #[test]
    fn an_answer_that_lost_its_digits_is_not_given() {
        let w = wall(3, 2, 1.0);
        let factor = VelocityFactor::recover(&w).expect("bricks");
        let mut velocities = VelocityElimination::new(&factor, 3);
        let right = DVector::from_element(3 * w.contacts(), 1.0);
        let slopes = |own: f64| vec![Slopes { own: Matrix3::identity() * own, through: Matrix3::identity(), inverse: None }; w.contacts()];
        assert!(velocities.factor(&slopes(1e-3), true) && velocities.solve(&w, &right).is_some());
        // what is planted: an inverse that belongs to another A
        let wrong = slopes(1.0).into_iter().map(|slopes| Slopes { inverse: Some(Matrix3::identity() * 3.0), ..slopes }).collect::<Vec<_>>();
        assert!(velocities.factor(&wrong, true) && velocities.solve(&w, &right).is_none());
        assert!(!velocities.factor(&slopes(0.0), true), "A is singular");
    }
}
