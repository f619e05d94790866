//! How much memory elimination by fronts takes, told by the tree alone.
//!
//! ```text
//!     factors + the largest front + max over the nodes of what waits for a parent          [entries]
//! ```

use super::tree::{Node, Tree};

/// Numbers that factoring along a tree holds at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Need {
    /// Entries of a factor, L or U.
    pub storage: usize,
    /// Entries of the largest front.
    pub front: usize,
    /// Entries that all children leave to their parents.
    pub left: usize,
    /// Most of them that wait for a parent at once.
    pub waiting: usize,
}

impl Need {
    /// In bytes; of a symmetric matrix L alone is stored.
    pub fn bytes(&self, is_symmetric: bool) -> u128 {
        let factors = if is_symmetric { 1 } else { 2 };
        8 * (factors * self.storage as u128 + self.front as u128 + self.waiting as u128)
    }
}

impl Tree {
    /// What factoring along it holds.
    pub(crate) fn need(&self) -> Need {
        let mut need = Need { storage: self.storage, front: 0, left: 0, waiting: 0 };
        let left = |node: &Node| (node.size - node.pivots).pow(2);
        let mut waiting = 0;
        for (id, node) in self.nodes.iter().enumerate() {
            need.front = need.front.max(node.size.pow(2));
            need.left += left(node);
            // while a front is added up its children wait still
            waiting += left(node);
            need.waiting = need.waiting.max(waiting);
            waiting -= self.children(id).iter().map(|child| left(&self.nodes[*child])).sum::<usize>();
        }
        need
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operator::Lists;

    fn tree(neighbours: &[&[usize]]) -> Tree {
        let mut lists = Lists::default();
        for list in neighbours {
            list.iter().for_each(|member| lists.push(*member));
            lists.end();
        }
        let mut tree = Tree::default();
        tree.plan(&vec![30; neighbours.len()], &lists);
        tree
    }

    #[test]
    fn an_end_of_a_chain_waits_for_the_front_of_the_others() {
        // 30 pivots in a front of 60 rows, which leave 30 rows to the front of the other two, of 60 pivots
        let need = tree(&[&[1], &[0, 2], &[1]]).need();
        assert_eq!(need, Need { storage: 30 * 60 + 60 * 60, front: 60 * 60, left: 30 * 30, waiting: 30 * 30 });
        assert_eq!((need.bytes(true), need.bytes(false)), (8 * (5400 + 3600 + 900), 8 * (10_800 + 3600 + 900)));
    }

    #[test]
    fn what_a_parent_has_taken_waits_no_more() {
        // five bodies in a row: what a link leaves is taken before the next one leaves its own
        let need = tree(&[&[1], &[0, 2], &[1, 3], &[2, 4], &[3]]).need();
        assert!(need.waiting < need.left, "{need:?}");
    }
}
