//! J x = b for a sparse J by dense fronts, one per node of the elimination tree.
//!
//! ```text
//!     F_node = entries of J in the pivots' rows and columns + Σ_children S_child ;     F_node → L, U, S_node ;     S_node → parent
//! ```
//! With W = Y Yᵀ in place of a J over contacts the groups are bodies; over contacts they are contacts. The fronts hold what is given and
//! nothing else: who assembles them decides.
//!
//! # Source
//! Duff and Reid, *The multifrontal solution of indefinite sparse symmetric linear equations*, ACM Trans. Math. Softw. 9 (1983).

use super::front;
use super::tree::{Node, Tree};
use crate::memory;
use crate::tolerance::fronts::KEPT;
use crate::watch;

/// A front that is being assembled.
pub(crate) struct Front<'a> {
    pub entries: &'a mut [f64],
    /// Length of a column.
    pub size: usize,
    /// Where each group of the front has its first row.
    pub local: &'a [usize],
}

/// L and U, node by node.
#[derive(Clone, Debug, Default)]
pub(crate) struct Factor {
    is_symmetric: bool,
    /// The pivot columns of every node.
    lower: Vec<f64>,
    /// Where J is not symmetric the pivot rows of every node, column after column.
    upper: Vec<f64>,
    /// The exchanges of every node's pivot rows, one after the other, where J is not symmetric.
    exchanged: Vec<usize>,
    /// Whether the last one was left for want of memory or time, and says nothing of its pivots.
    pub was_left: bool,
}

/// Memory that factoring and solving use again.
#[derive(Clone, Debug, Default)]
pub(crate) struct Work {
    front: Vec<f64>,
    /// What nodes left for their parents, until these have it.
    updates: Vec<Vec<f64>>,
    /// Memory of updates that parents had.
    free: Vec<Vec<f64>>,
    local: Vec<usize>,
    own: front::Memory,
    part: Vec<f64>,
}

impl Factor {
    /// Factors what `assemble` puts into the front of every node; of a symmetric J the lower triangle. False where a pivot is missing, the
    /// fronts take more memory than is allowed, or whoever watches the solver ended it.
    pub(crate) fn compute(
        &mut self,
        tree: &Tree,
        is_symmetric: bool,
        work: &mut Work,
        mut assemble: impl FnMut(usize, &mut Front),
    ) -> bool {
        let need = tree.need();
        let is_allowed = memory::require("eliminating by fronts", need.bytes(is_symmetric)).is_ok();
        self.was_left = tree.is_given_up || !is_allowed;
        if self.was_left {
            return false;
        }
        let keeps = need.left <= KEPT;
        self.is_symmetric = is_symmetric;
        self.lower.resize(tree.storage, 0.0);
        self.upper.resize(if is_symmetric { 0 } else { tree.storage }, 0.0);
        self.exchanged.resize(if is_symmetric { 0 } else { tree.starts[tree.starts.len() - 1] }, 0);
        // those that a matrix left which was not regular
        work.free.extend(work.updates.drain(..).filter(|update| update.capacity() > 0));
        work.updates.resize_with(tree.nodes.len(), Vec::new);
        work.local.resize(tree.node_of.len(), 0);
        let mut exchanges = 0;
        for (id, node) in tree.nodes.iter().enumerate() {
            let size = node.size;
            work.front.clear();
            work.front.resize(size * size, 0.0);
            tree.place_rows(id, &mut work.local);
            assemble(id, &mut Front { entries: &mut work.front, size, local: &work.local });
            for &child in tree.children(id) {
                add_child(&mut work.front, size, tree.rows_in_parent(child), &work.updates[child], is_symmetric);
                let had = std::mem::take(&mut work.updates[child]);
                if keeps {
                    work.free.push(had);
                }
            }
            let exchanged = if is_symmetric { &mut [] } else { &mut self.exchanged[exchanges..exchanges + node.pivots] };
            exchanges += node.pivots;
            let is_regular = match is_symmetric {
                true => front::cholesky(&mut work.front, size, node.pivots, &mut work.own),
                false => front::lu(&mut work.front, size, node.pivots, exchanged, &mut work.own),
            };
            self.was_left = watch::is_over();
            if !is_regular || self.was_left {
                return false;
            }
            self.store(node, &work.front);
            if size > node.pivots {
                let mut left = work.free.pop().unwrap_or_default();
                left.clear();
                left.reserve((size - node.pivots).pow(2));
                work.front.chunks_exact(size).skip(node.pivots).for_each(|column| left.extend_from_slice(&column[node.pivots..]));
                work.updates[id] = left;
            }
        }
        true
    }

    fn store(&mut self, node: &Node, front: &[f64]) {
        let range = node.offset..node.offset + node.size * node.pivots;
        self.lower[range.clone()].copy_from_slice(&front[..node.size * node.pivots]);
        if !self.is_symmetric {
            let upper = self.upper[range].chunks_exact_mut(node.pivots.max(1));
            upper.zip(front.chunks_exact(node.size.max(1))).for_each(|(kept, column)| kept.copy_from_slice(&column[..node.pivots]));
        }
    }

    /// x ← J⁻¹ x.
    ///
    /// # Panics
    /// If x has another size than J.
    pub(crate) fn solve(&self, tree: &Tree, x: &mut [f64], work: &mut Work) {
        assert_eq!(x.len(), tree.starts[tree.starts.len() - 1], "the right side has one entry per row");
        let part = &mut work.part;
        let mut exchanges = 0;
        for (id, node) in tree.nodes.iter().enumerate() {
            gather(tree, id, x, part);
            if !self.is_symmetric {
                let rows = &self.exchanged[exchanges..exchanges + node.pivots];
                rows.iter().enumerate().for_each(|(j, pivot)| part.swap(j, *pivot));
                exchanges += node.pivots;
            }
            for (j, column) in self.lower[node.offset..].chunks_exact(node.size.max(1)).take(node.pivots).enumerate() {
                if self.is_symmetric {
                    part[j] /= column[j];
                }
                let known = part[j];
                part[j + 1..].iter_mut().zip(&column[j + 1..]).for_each(|(rest, l)| *rest -= l * known);
            }
            scatter(tree, id, x, part);
        }
        for (id, node) in tree.nodes.iter().enumerate().rev() {
            gather(tree, id, x, part);
            if self.is_symmetric {
                self.backward_transposed(node, part);
            } else {
                self.backward(node, part);
            }
            scatter(tree, id, x, part);
        }
    }

    /// U x = b at the pivots of a node, by the rows of U = Lᵀ.
    fn backward_transposed(&self, node: &Node, part: &mut [f64]) {
        for j in (0..node.pivots).rev() {
            let row = &self.lower[node.offset + j * node.size..node.offset + (j + 1) * node.size];
            let known: f64 = row[j + 1..].iter().zip(&part[j + 1..]).map(|(u, x)| u * x).sum();
            part[j] = (part[j] - known) / row[j];
        }
    }

    /// U x = b at the pivots of a node, by columns.
    fn backward(&self, node: &Node, part: &mut [f64]) {
        let upper = &self.upper[node.offset..node.offset + node.size * node.pivots];
        let column = |j: usize| &upper[j * node.pivots..(j + 1) * node.pivots];
        let (own, known) = part.split_at_mut(node.pivots);
        for (place, x) in known.iter().enumerate() {
            own.iter_mut().zip(column(node.pivots + place)).for_each(|(own, u)| *own -= u * x);
        }
        for j in (0..node.pivots).rev() {
            let column = column(j);
            own[j] /= column[j];
            let x = own[j];
            own[..j].iter_mut().zip(column).for_each(|(own, u)| *own -= u * x);
        }
    }
}

/// Adds what a child left over.
fn add_child(front: &mut [f64], size: usize, into_parent: &[usize], left: &[f64], is_symmetric: bool) {
    for (j, column) in left.chunks_exact(into_parent.len().max(1)).enumerate() {
        let target = &mut front[into_parent[j] * size..(into_parent[j] + 1) * size];
        let from = if is_symmetric { j } else { 0 };
        column[from..].iter().zip(&into_parent[from..]).for_each(|(entry, row)| target[*row] += entry);
    }
}

fn gather(tree: &Tree, node: usize, x: &[f64], part: &mut Vec<f64>) {
    part.clear();
    tree.groups(node).iter().for_each(|&group| part.extend_from_slice(&x[tree.starts[group]..tree.starts[group + 1]]));
}

fn scatter(tree: &Tree, node: usize, x: &mut [f64], part: &[f64]) {
    let mut at = 0;
    for &group in tree.groups(node) {
        let target = &mut x[tree.starts[group]..tree.starts[group + 1]];
        target.copy_from_slice(&part[at..at + target.len()]);
        at += target.len();
    }
}
