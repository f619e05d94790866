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

use crate::memory;
use crate::operator::Lists;
use crate::tolerance::fronts::{NARROW, VAIN};
use crate::watch;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// One front.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    /// How many of its groups are pivots.
    pub pivot_groups: usize,
    /// How many rows are pivots.
    pub pivots: usize,
    /// How many rows there are.
    pub size: usize,
    /// Where its columns begin in the stored factor.
    pub offset: usize,
}

/// The fronts, children before parents; their memory is used again for another matrix.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    pub nodes: Vec<Node>,
    /// Of every node the groups of its rows: pivots first, in the order of elimination.
    groups: Lists,
    children: Lists,
    /// Of every node where the rows after the pivots stand in the parent's front; the roots have none.
    into_parent: Lists,
    /// The first row of every group in the matrix, and the number of rows.
    pub starts: Vec<usize>,
    /// The node that eliminates each group.
    pub node_of: Vec<usize>,
    /// Entries of the stored factor.
    pub storage: usize,
    /// Whether there is none: its factor takes more memory or work than is allowed, or whoever watches the solver ended it.
    pub is_given_up: bool,
    order: Order,
}

/// The order of elimination, and what it is found with.
#[derive(Clone, Debug, Default)]
struct Order {
    /// The matrix it belongs to: rows of the groups, and the groups that each meets.
    of: (Vec<usize>, Lists),
    /// Whether the tree is that of this matrix.
    is_planned: bool,
    order: Vec<usize>,
    /// Members of lists that may be merged before it is given up, and squares of the lists, if that is limited.
    most: Option<usize>,
    /// By group, the groups that it meets when it is eliminated, growing in number.
    later: Vec<Vec<usize>>,
    /// Of every group its place in the order.
    place: Vec<usize>,
    /// The pivots of every group's node, none where another node took it in.
    pivots: Vec<Vec<usize>>,
    /// The children of every node, in the order of elimination.
    children: Vec<Vec<usize>>,
    met: Vec<Vec<usize>>,
    degrees: Vec<usize>,
    waiting: BinaryHeap<Reverse<(usize, usize)>>,
    done: Vec<bool>,
    zeros: Vec<usize>,
    /// Of every group the number of its node.
    number: Vec<usize>,
    /// Lists that are being made.
    merged: Vec<usize>,
    taken: Vec<usize>,
    open: Vec<(usize, usize)>,
}

impl Tree {
    /// One that is given up where finding its order merges lists whose squares and members are more than that together.
    pub(crate) fn within(most: usize) -> Self {
        Tree { order: Order { most: Some(most), ..Order::default() }, ..Tree::default() }
    }

    /// The tree of groups with so many rows each, and the other groups that each meets, growing, in both directions. Where they are those
    /// of the last matrix it stays what it is.
    pub(crate) fn plan(&mut self, rows: &[usize], neighbours: &Lists) {
        if self.order.is_planned && self.order.is_of(rows, neighbours) {
            return;
        }
        if !self.order.find(rows, neighbours) {
            self.begin(rows);
            (self.order.is_planned, self.is_given_up) = (false, true);
            return;
        }
        self.order.amalgamate(rows);
        self.begin(rows);
        let Tree { nodes, groups, children, node_of, storage, order, .. } = self;
        let (mut open, mut next) = (std::mem::take(&mut order.open), 0);
        order.number.clear();
        order.number.resize(rows.len(), 0);
        for at in 0..rows.len() {
            let root = order.order[at];
            if !order.later[root].is_empty() {
                continue;
            }
            open.push((root, 0));
            while let Some((k, child)) = open.pop() {
                if let Some(&below) = order.children[k].get(child) {
                    open.extend([(k, child + 1), (below, 0)]);
                    continue;
                }
                order.number[k] = nodes.len();
                let (pivots, later) = (&order.pivots[k], &order.later[k]);
                for &group in pivots {
                    (order.place[group], node_of[group]) = (next, nodes.len());
                    next += 1;
                    groups.push(group);
                }
                let (wide, size) = (width(rows, pivots), width(rows, pivots) + width(rows, later));
                nodes.push(Node { pivot_groups: pivots.len(), pivots: wide, size, offset: *storage });
                *storage += wide * size;
                later.iter().for_each(|group| groups.push(*group));
                groups.end();
                order.children[k].iter().for_each(|child| children.push(order.number[*child]));
                children.end();
            }
        }
        (order.open, order.is_planned) = (open, true);
        for (id, node) in nodes.iter().enumerate() {
            groups.list_mut(id)[node.pivot_groups..].sort_unstable_by_key(|group| order.place[*group]);
        }
        self.map_children();
    }

    /// The tree of few groups, which are not worth an order: all in one front.
    pub(crate) fn plan_one_front(&mut self, rows: &[usize]) {
        self.order.is_planned = false;
        self.begin(rows);
        let (count, size) = (rows.len(), self.starts[rows.len()]);
        (0..count).for_each(|group| self.groups.push(group));
        [&mut self.groups, &mut self.children, &mut self.into_parent].into_iter().for_each(Lists::end);
        self.nodes.push(Node { pivot_groups: count, pivots: size, size, offset: 0 });
        self.storage = size * size;
    }

    /// No front yet, of groups with so many rows each.
    fn begin(&mut self, rows: &[usize]) {
        self.nodes.clear();
        [&mut self.groups, &mut self.children, &mut self.into_parent].into_iter().for_each(Lists::clear);
        self.starts.clear();
        self.starts.push(0);
        rows.iter().for_each(|count| self.starts.push(self.starts[self.starts.len() - 1] + count));
        self.node_of.clear();
        self.node_of.resize(rows.len(), 0);
        (self.storage, self.is_given_up) = (0, false);
    }

    /// The groups of a front.
    pub(crate) fn groups(&self, node: usize) -> &[usize] {
        &self.groups[node]
    }

    /// The nodes whose rest is added to this one's front.
    pub(crate) fn children(&self, node: usize) -> &[usize] {
        &self.children[node]
    }

    /// Where the rows after the pivots of this node stand in its parent's front.
    pub(crate) fn rows_in_parent(&self, node: usize) -> &[usize] {
        &self.into_parent[node]
    }

    fn map_children(&mut self) {
        // of every node its parent, and of every group the row in the front of the parent that was looked at last
        let (mut parents, mut local) = (std::mem::take(&mut self.order.taken), std::mem::take(&mut self.order.merged));
        parents.clear();
        parents.resize(self.nodes.len(), usize::MAX);
        self.children.iter().enumerate().for_each(|(id, children)| children.iter().for_each(|child| parents[*child] = id));
        local.clear();
        local.resize(self.node_of.len(), 0);
        let mut placed = usize::MAX;
        for (id, &parent) in parents.iter().enumerate() {
            if parent != usize::MAX {
                if parent != placed {
                    self.place_rows(parent, &mut local);
                    placed = parent;
                }
                for &group in &self.groups[id][self.nodes[id].pivot_groups..] {
                    let rows = self.starts[group + 1] - self.starts[group];
                    (local[group]..local[group] + rows).for_each(|row| self.into_parent.push(row));
                }
            }
            self.into_parent.end();
        }
        (self.order.taken, self.order.merged) = (parents, local);
    }

    /// Writes down where each group of a front has its first row.
    pub(crate) fn place_rows(&self, node: usize, local: &mut [usize]) {
        let mut at = 0;
        for &group in &self.groups[node] {
            local[group] = at;
            at += self.starts[group + 1] - self.starts[group];
        }
    }
}

fn width(rows: &[usize], groups: &[usize]) -> usize {
    groups.iter().map(|group| rows[*group]).sum()
}

/// What most groups of a heap meet: a list has room for as many from the start.
const ROOM: usize = 16;

/// As many lists, all of them empty.
fn emptied(lists: &mut Vec<Vec<usize>>, count: usize) {
    lists.iter_mut().for_each(Vec::clear);
    if lists.len() < count {
        lists.resize_with(count, || Vec::with_capacity(ROOM));
    }
}

impl Order {
    fn is_of(&self, rows: &[usize], neighbours: &Lists) -> bool {
        self.of.0 == rows && self.of.1 == *neighbours
    }

    /// Fewest rows first, the first of several; false where the columns that they leave are more than memory holds, or the solver was
    /// ended.
    fn find(&mut self, rows: &[usize], neighbours: &Lists) -> bool {
        self.of.0.clear();
        self.of.0.extend_from_slice(rows);
        self.of.1.copy_from(neighbours);
        let Order { order, later, met, degrees, waiting, done, merged, most, .. } = self;
        emptied(met, rows.len());
        emptied(later, rows.len());
        met.iter_mut().zip(neighbours.iter()).for_each(|(met, list)| met.extend_from_slice(list));
        order.clear();
        done.clear();
        done.resize(rows.len(), false);
        degrees.clear();
        degrees.extend(neighbours.iter().map(|list| width(rows, list)));
        waiting.clear();
        waiting.extend(degrees.iter().enumerate().map(|(k, degree)| Reverse((*degree, k))));
        let (mut stored, mut work) = (0, 0);
        while let Some(Reverse((degree_then, k))) = waiting.pop() {
            if done[k] || degree_then != degrees[k] {
                continue;
            }
            stored += rows[k] as u128 * (rows[k] + degree_then) as u128;
            if watch::is_over() || memory::require("an order of elimination", 8 * stored).is_err() {
                return false;
            }
            work += met[k].len() * met[k].len();
            if most.is_some_and(|most| work > most) {
                return false;
            }
            done[k] = true;
            order.push(k);
            std::mem::swap(&mut later[k], &mut met[k]);
            let list = &later[k];
            for &j in list {
                merge(&met[j], list, [j, k], merged);
                // a copy: room for a long list is not left behind with a short one
                met[j].clone_from(merged);
                work += merged.len();
                degrees[j] = width(rows, &met[j]);
                waiting.push(Reverse((degrees[j], j)));
            }
        }
        true
    }

    /// Puts groups together whose fronts are nearly the same.
    fn amalgamate(&mut self, rows: &[usize]) {
        let Order { order, later, place, pivots, children, zeros, merged: kept, taken, .. } = self;
        place.clear();
        place.resize(rows.len(), 0);
        order.iter().enumerate().for_each(|(at, k)| place[*k] = at);
        emptied(children, rows.len());
        for &k in order.iter() {
            if let Some(parent) = later[k].iter().copied().min_by_key(|j| place[*j]) {
                children[parent].push(k);
            }
        }
        emptied(pivots, rows.len());
        pivots.iter_mut().take(rows.len()).enumerate().for_each(|(k, own)| own.push(k));
        zeros.clear();
        zeros.resize(rows.len(), 0);
        for &parent in order.iter() {
            let below = width(rows, &later[parent]);
            kept.clear();
            std::mem::swap(taken, &mut children[parent]);
            taken.sort_unstable_by_key(|child| (Reverse(width(rows, &later[*child])), place[*child]));
            for &child in taken.iter() {
                let (own, wide) = (width(rows, &pivots[child]), width(rows, &pivots[parent]));
                // the child's columns grow to the front of the parent
                let vain = zeros[child] + zeros[parent] + own * (wide + below - width(rows, &later[child]));
                let stored = (own + wide) * (own + wide + below);
                if vain * VAIN <= stored || (own + wide <= NARROW.1 && vain * NARROW.0 <= stored) {
                    let mut joined = std::mem::take(&mut pivots[child]);
                    joined.append(&mut pivots[parent]);
                    pivots[child] = std::mem::replace(&mut pivots[parent], joined);
                    zeros[parent] = vain;
                    kept.append(&mut children[child]);
                } else {
                    kept.push(child);
                }
            }
            std::mem::swap(taken, &mut children[parent]);
            children[parent].clear();
            children[parent].extend_from_slice(kept);
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn lists(neighbours: &[Vec<usize>]) -> Lists {
        let mut lists = Lists::default();
        for list in neighbours {
            list.iter().for_each(|member| lists.push(*member));
            lists.end();
        }
        lists
    }

    fn tree(neighbours: &[Vec<usize>]) -> Tree {
        let mut tree = Tree::default();
        tree.plan(&vec![3; neighbours.len()], &lists(neighbours));
        tree
    }

    fn is_same(one: &Tree, other: &Tree) {
        assert_eq!((&one.nodes, &one.starts, &one.node_of, one.storage), (&other.nodes, &other.starts, &other.node_of, other.storage));
        assert_eq!([&one.groups, &one.children, &one.into_parent], [&other.groups, &other.children, &other.into_parent]);
    }

    /// Every group is a pivot once, children come first, and what a child leaves is in its parent's front.
    fn is_sound(tree: &Tree, neighbours: &[Vec<usize>]) {
        let mut seen = vec![0; neighbours.len()];
        for (id, node) in tree.nodes.iter().enumerate() {
            let groups = tree.groups(id);
            let own = &groups[..node.pivot_groups];
            own.iter().for_each(|group| seen[*group] += 1);
            assert!(tree.children(id).iter().all(|child| *child < id));
            assert_eq!(node.size, 3 * groups.len());
            for group in own {
                // what it meets is eliminated before, in this front or after it
                assert!(neighbours[*group].iter().all(|other| tree.node_of[*other] < id || groups.contains(other)));
            }
            for &below in tree.children(id) {
                let (child, rows) = (&tree.nodes[below], tree.rows_in_parent(below));
                assert!(tree.groups(below)[child.pivot_groups..].iter().all(|group| groups.contains(group)));
                assert_eq!(rows.len(), child.size - child.pivots);
                assert!(rows.windows(2).all(|pair| pair[0] < pair[1]), "rows keep their order");
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
        let mut kept = Tree::default();
        for neighbours in [chain, star, grid, vec![Vec::new(); 7], Vec::new()] {
            is_sound(&tree(&neighbours), &neighbours);
            // memory that served for another matrix, or for one front, or for this very matrix, changes nothing
            for _ in 0..2 {
                kept.plan(&vec![3; neighbours.len()], &lists(&neighbours));
                is_same(&kept, &tree(&neighbours));
            }
            kept.plan_one_front(&vec![3; neighbours.len()]);
            kept.plan(&vec![3; neighbours.len()], &lists(&neighbours));
            is_same(&kept, &tree(&neighbours));
        }
    }

    #[test]
    fn one_group_that_meets_all_of_a_chain_takes_room_once_and_its_lists_count_as_work() {
        const LENGTH: usize = 1000;
        let beside =
            |k: usize| [0, k - 1, (k + 1) % LENGTH].into_iter().filter(move |j| *j != k).collect::<std::collections::BTreeSet<_>>();
        let mut neighbours: Vec<Vec<usize>> = vec![(1..LENGTH).collect()];
        neighbours.extend((1..LENGTH).map(|k| beside(k).into_iter().collect()));
        let (neighbours, rows) = (lists(&neighbours), vec![1; LENGTH]);
        let mut tree = Tree::default();
        tree.plan(&rows, &neighbours);
        let room: usize = tree.order.met.iter().chain(&tree.order.later).map(Vec::capacity).sum();
        assert!(!tree.is_given_up && room <= 4 * ROOM * LENGTH, "{room}");
        for (most, is_given_up) in [(LENGTH * LENGTH / 4, true), (LENGTH * LENGTH, false)] {
            let mut limited = Tree::within(most);
            limited.plan(&rows, &neighbours);
            assert_eq!(limited.is_given_up, is_given_up, "{most}");
        }
    }

    #[test]
    fn an_order_is_given_up_where_the_solver_was_ended() {
        let neighbours: Vec<Vec<usize>> = (0..9usize).map(|k| (0..9).filter(|j| *j != k).collect()).collect();
        let interrupt = watch::Interrupt::default();
        interrupt.now();
        let (mut ended, seen) = watch::watched(&interrupt, || tree(&neighbours));
        assert!(ended.is_given_up && ended.nodes.is_empty() && seen.interrupted);
        ended.plan(&[3; 9], &lists(&neighbours));
        is_same(&ended, &tree(&neighbours));
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
