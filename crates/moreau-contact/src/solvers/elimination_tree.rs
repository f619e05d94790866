//! In which order the groups of a sparse matrix are eliminated, and which are eliminated together in one dense front.
//!
//! ```text
//!     J = L U by groups ;   front of a node = its pivots and the groups they meet when they are eliminated ;   parent: the first of them
//! ```
//! Next comes the group that meets the fewest unknowns of those that are left, for what it meets will meet each other. A node takes in its
//! child where the two have nearly the same front: few zeros are stored, and dense kernels have longer loops.
//!
//! # Source
//! Davis, *Direct methods for sparse linear systems*, SIAM 2006, chapters 4, 6 and 7.

use crate::tolerance::fronts::{NARROW, VAIN};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// One front.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// The groups of its rows: pivots first, in the order of elimination.
    pub groups: Vec<usize>,
    /// How many of the groups are pivots.
    pub pivot_groups: usize,
    /// How many rows are pivots.
    pub pivots: usize,
    /// How many rows there are.
    pub size: usize,
    pub children: Vec<usize>,
    /// Where the rows after the pivots stand in the parent's front.
    pub into_parent: Vec<usize>,
    /// Where its columns begin in the stored factor.
    pub offset: usize,
}

/// The fronts, children before parents.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    pub nodes: Vec<Node>,
    /// The first row of every group in the matrix, and the number of rows.
    pub starts: Vec<usize>,
    /// The node that eliminates each group.
    pub node_of: Vec<usize>,
    /// Entries of the stored factor.
    pub storage: usize,
}

impl Tree {
    /// Of groups with so many rows each, and the other groups that each meets, growing, in both directions.
    pub(super) fn new(rows: &[usize], neighbours: Vec<Vec<usize>>) -> Self {
        let Ordered { order, later } = Ordered::new(rows, neighbours);
        let (mut pivots, children) = amalgamated(rows, &order, &later);
        let mut starts = vec![0];
        rows.iter().for_each(|count| starts.push(starts[starts.len() - 1] + count));
        let mut tree = Tree { nodes: Vec::new(), starts, node_of: vec![0; rows.len()], storage: 0 };
        let mut place = vec![0; rows.len()];
        let (mut number, mut next) = (vec![0; rows.len()], 0);
        for k in postorder(&order, &later, &children) {
            number[k] = tree.nodes.len();
            let groups = std::mem::take(&mut pivots[k]);
            for &group in &groups {
                (place[group], tree.node_of[group]) = (next, number[k]);
                next += 1;
            }
            let wide = width(rows, &groups);
            let children = children[k].iter().map(|child| number[*child]).collect();
            let (pivot_groups, size, offset) = (groups.len(), wide + width(rows, &later[k]), tree.storage);
            tree.storage += wide * size;
            let groups = groups.into_iter().chain(later[k].iter().copied()).collect();
            tree.nodes.push(Node { groups, pivot_groups, pivots: wide, size, children, into_parent: Vec::new(), offset });
        }
        for node in &mut tree.nodes {
            node.groups[node.pivot_groups..].sort_unstable_by_key(|group| place[*group]);
        }
        tree.map_children(rows);
        tree
    }

    /// Of few groups, which are not worth an order: all in one front.
    pub(super) fn of_one_front(rows: &[usize]) -> Self {
        let mut starts = vec![0];
        rows.iter().for_each(|count| starts.push(starts[starts.len() - 1] + count));
        let (count, size) = (rows.len(), starts[rows.len()]);
        let groups = (0..count).collect();
        let node = Node { groups, pivot_groups: count, pivots: size, size, children: Vec::new(), into_parent: Vec::new(), offset: 0 };
        Tree { nodes: vec![node], starts, node_of: vec![0; count], storage: size * size }
    }

    fn map_children(&mut self, rows: &[usize]) {
        let mut local = vec![0; rows.len()];
        for id in 0..self.nodes.len() {
            self.place_rows(id, &mut local);
            for child in self.nodes[id].children.clone() {
                let node = &self.nodes[child];
                let below = node.groups[node.pivot_groups..].iter();
                let map = below.flat_map(|&group| local[group]..local[group] + rows[group]).collect();
                self.nodes[child].into_parent = map;
            }
        }
    }

    /// Writes down where each group of a front has its first row.
    pub(super) fn place_rows(&self, node: usize, local: &mut [usize]) {
        let mut at = 0;
        for &group in &self.nodes[node].groups {
            local[group] = at;
            at += self.starts[group + 1] - self.starts[group];
        }
    }
}

fn width(rows: &[usize], groups: &[usize]) -> usize {
    groups.iter().map(|group| rows[*group]).sum()
}

/// An order of elimination with the groups that each meets when it is eliminated.
struct Ordered {
    order: Vec<usize>,
    /// By group, growing in number.
    later: Vec<Vec<usize>>,
}

impl Ordered {
    /// Fewest rows first, the first of several.
    fn new(rows: &[usize], mut met: Vec<Vec<usize>>) -> Self {
        let degree = |list: &[usize]| width(rows, list);
        let (mut order, mut done) = (Vec::with_capacity(rows.len()), vec![false; rows.len()]);
        let mut degrees: Vec<usize> = met.iter().map(|list| degree(list)).collect();
        let mut waiting: BinaryHeap<_> = degrees.iter().enumerate().map(|(k, degree)| Reverse((*degree, k))).collect();
        let mut later = vec![Vec::new(); rows.len()];
        let mut merged = Vec::new();
        while let Some(Reverse((degree_then, k))) = waiting.pop() {
            if done[k] || degree_then != degrees[k] {
                continue;
            }
            done[k] = true;
            order.push(k);
            let list = std::mem::take(&mut met[k]);
            for &j in &list {
                merge(&met[j], &list, [j, k], &mut merged);
                std::mem::swap(&mut met[j], &mut merged);
                degrees[j] = degree(&met[j]);
                waiting.push(Reverse((degrees[j], j)));
            }
            later[k] = list;
        }
        Ordered { order, later }
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

/// The pivots of every group's node, none where another node took it in, and the children of every node, in the order of elimination.
fn amalgamated(rows: &[usize], order: &[usize], later: &[Vec<usize>]) -> (Vec<Vec<usize>>, Vec<Vec<usize>>) {
    let mut place = vec![0; rows.len()];
    order.iter().enumerate().for_each(|(at, k)| place[*k] = at);
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); rows.len()];
    for &k in order {
        if let Some(parent) = later[k].iter().copied().min_by_key(|j| place[*j]) {
            children[parent].push(k);
        }
    }
    let mut pivots: Vec<Vec<usize>> = (0..rows.len()).map(|k| vec![k]).collect();
    let mut zeros = vec![0; rows.len()];
    for &parent in order {
        let below = width(rows, &later[parent]);
        let mut kept = Vec::new();
        let mut list = std::mem::take(&mut children[parent]);
        list.sort_by_key(|child| (Reverse(width(rows, &later[*child])), place[*child]));
        for child in list {
            let (own, wide) = (width(rows, &pivots[child]), width(rows, &pivots[parent]));
            // the child's columns grow to the front of the parent
            let vain = zeros[child] + zeros[parent] + own * (wide + below - width(rows, &later[child]));
            let stored = (own + wide) * (own + wide + below);
            if vain * VAIN <= stored || (own + wide <= NARROW.1 && vain * NARROW.0 <= stored) {
                let mut joined = std::mem::take(&mut pivots[child]);
                joined.append(&mut pivots[parent]);
                (pivots[parent], zeros[parent]) = (joined, vain);
                kept.append(&mut children[child]);
            } else {
                kept.push(child);
            }
        }
        children[parent] = kept;
    }
    (pivots, children)
}

/// The nodes that are left, children before parents.
fn postorder(order: &[usize], later: &[Vec<usize>], children: &[Vec<usize>]) -> Vec<usize> {
    let mut found = Vec::new();
    for &root in order.iter().filter(|k| later[**k].is_empty()) {
        let mut open = vec![(root, 0)];
        while let Some((k, at)) = open.pop() {
            match children[k].get(at) {
                Some(&child) => open.extend([(k, at + 1), (child, 0)]),
                None => found.push(k),
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tree(neighbours: &[Vec<usize>]) -> Tree {
        Tree::new(&vec![3; neighbours.len()], neighbours.to_vec())
    }

    /// Every group is a pivot once, children come first, and what a child leaves is in its parent's front.
    fn is_sound(tree: &Tree, neighbours: &[Vec<usize>]) {
        let mut seen = vec![0; neighbours.len()];
        for (id, node) in tree.nodes.iter().enumerate() {
            let own = &node.groups[..node.pivot_groups];
            own.iter().for_each(|group| seen[*group] += 1);
            assert!(node.children.iter().all(|child| *child < id));
            assert_eq!(node.size, 3 * node.groups.len());
            for group in own {
                // what it meets is eliminated before, in this front or after it
                assert!(neighbours[*group].iter().all(|other| tree.node_of[*other] < id || node.groups.contains(other)));
            }
            for child in &node.children {
                let child = &tree.nodes[*child];
                assert!(child.groups[child.pivot_groups..].iter().all(|group| node.groups.contains(group)));
                assert_eq!(child.into_parent.len(), child.size - child.pivots);
                assert!(child.into_parent.windows(2).all(|pair| pair[0] < pair[1]), "rows keep their order");
            }
        }
        assert!(seen.iter().all(|times| *times == 1));
    }

    #[test]
    fn a_chain_a_star_a_grid_and_parts_that_do_not_meet_have_sound_trees() {
        let chain: Vec<Vec<usize>> =
            (0..50usize).map(|k| [k.checked_sub(1), (k < 49).then_some(k + 1)].into_iter().flatten().collect()).collect();
        let mut star = vec![vec![0]; 20];
        star[0] = (1..20).collect();
        let side = 9usize;
        let grid: Vec<Vec<usize>> = (0..side * side)
            .map(|k| {
                let near = |j: &usize| (j / side).abs_diff(k / side) + (j % side).abs_diff(k % side) == 1;
                (0..side * side).filter(near).collect()
            })
            .collect();
        for neighbours in [chain, star, grid, vec![Vec::new(); 7], Vec::new()] {
            is_sound(&tree(&neighbours), &neighbours);
        }
    }

    #[test]
    fn a_chain_does_not_fill_and_a_star_is_begun_at_its_ends() {
        let chain: Vec<Vec<usize>> =
            (0..500usize).map(|k| [k.checked_sub(1), (k < 499).then_some(k + 1)].into_iter().flatten().collect()).collect();
        assert!(tree(&chain).storage <= 500 * 9 * 2 * 3 / 2 * 3, "{}", tree(&chain).storage);
        let mut star = vec![vec![0]; 200];
        star[0] = (1..200).collect();
        assert_eq!(tree(&star).node_of[0], tree(&star).nodes.len() - 1);
        assert!(tree(&star).storage <= 200 * 9 * 4, "{}", tree(&star).storage);
    }
}
