//! The mass of a step together with what its contacts add to it, eliminated over bodies.
//!
//! ```text
//!     (M + Σ_k H_kᵀ G_k H_k) d = b ,      G_k over the rows of contact k
//! ```
//! Velocities are in one group where M couples them or they are of one part of a contact's H_k: each free body is one, and a linkage whose
//! mass is dense. Two groups meet where a contact touches both. Memory and time grow with the bodies that meet, not with the square of all
//! velocities. At a body without contact M stays alone, and its factor is known.
//!
//! # Source
//! Davis, *Direct methods for sparse linear systems*, SIAM 2006, chapters 4 and 6.

use crate::contact::{BodyRows, Inertia, Mass, Rows};
use crate::fronts::{Factor, Front, Tree, Work};
use crate::memory;
use crate::operator::Lists;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// M + Σ_k H_kᵀ G_k H_k \[kg\], whose order of elimination is found once for all G_k.
#[derive(Debug)]
pub struct AugmentedMass<'a> {
    inertia: &'a Inertia,
    contacts: &'a [Rows],
    /// The velocities of every group that a contact touches, growing.
    groups: Vec<Range<usize>>,
    /// M of every group.
    masses: Vec<DMatrix<f64>>,
    tree: Tree,
    /// The contacts that each front adds.
    added: Lists,
    factor: Factor,
    work: Work,
}

impl<'a> AugmentedMass<'a> {
    /// Of M and of the rows of contacts, each of which may have another number of them.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a velocity has the inertia +∞, or a contact another number of velocities than M.
    /// ```
    /// use moreau_contact::augmented_mass::AugmentedMass;
    /// use moreau_contact::contact::{Inertia, Mass, Rows};
    /// use moreau_contact::nalgebra::{dmatrix, dvector};
    ///
    /// // two masses of 2 kg on a line, with a damper of 3 N·s/m in between for a step of 1 s
    /// let inertia = Inertia::of(Mass::Diagonal(dvector![2.0, 2.0]))?;
    /// let between = [Rows::zeros(1, 2).with(0, [[-1.0]]).with(1, [[1.0]])];
    /// let moved = AugmentedMass::new(&inertia, &between)?.solve_definite("example", &[dmatrix![3.0]], &dvector![4.0, 0.0])?;
    /// assert!((moved - dvector![1.25, 0.75]).amax() < 1e-15);
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn new(inertia: &'a Inertia, contacts: &'a [Rows]) -> Result<Self> {
        let (mass, size) = (inertia.finite_mass()?, inertia.size());
        if let Some(other) = contacts.iter().find(|contact| contact.ncols() != size) {
            let problem = format!("has {} columns", other.ncols());
            return Err(Error::invalid("jacobian", problem, format!("use {size}, as many as M has velocities")));
        }
        let groups = touched_groups(mass, contacts);
        let masses = masses_of(mass, &groups);
        let (mut met, mut tree, mut added) = (Lists::default(), Tree::default(), Lists::default());
        let touched = |contact: &Rows| contact.parts().map(|part| group_of(&groups, part.first)).collect::<Vec<_>>();
        met.collect(groups.len(), |show| {
            for own in contacts.iter().map(touched) {
                own.iter().for_each(|one| own.iter().filter(|other| *other != one).for_each(|other| show(*one, *other)));
            }
        });
        met.sort_each();
        tree.plan(&groups.iter().map(Range::len).collect::<Vec<_>>(), &met);
        added.collect(tree.nodes.len(), |show| {
            for (k, contact) in contacts.iter().enumerate().filter(|_| !tree.is_given_up) {
                if let Some(node) = touched(contact).into_iter().map(|group| tree.node_of[group]).min() {
                    show(node, k);
                }
            }
        });
        Ok(AugmentedMass { inertia, contacts, groups, masses, tree, added, factor: Factor::default(), work: Work::default() })
    }

    /// d for the symmetric parts of G_k, which make the sum positive definite.
    ///
    /// # Errors
    /// [`Error::Solver`] in the name of `solver` if the sum is not positive definite or who watches ends it; [`Error::Invalid`] if its
    /// factor takes more memory than is allowed.
    ///
    /// # Panics
    /// If there is not one G_k of its size for every contact, or b has another size than M.
    pub fn solve_definite(&mut self, solver: &str, slopes: &[DMatrix<f64>], right: &DVector<f64>) -> Result<DVector<f64>> {
        let symmetric: Vec<DMatrix<f64>> = slopes.iter().map(|slope| (slope + slope.transpose()) * 0.5).collect();
        self.solve_with(solver, &symmetric, true, right)
    }

    /// d for any G_k. Rows are exchanged within the bodies of a front only, so that d loses digits where a body by itself is nearly
    /// singular.
    ///
    /// # Errors
    /// [`Error::Solver`] in the name of `solver` if a front has no pivot or who watches ends it; [`Error::Invalid`] if its factor takes
    /// more memory than is allowed.
    ///
    /// # Panics
    /// As [`AugmentedMass::solve_definite`].
    pub fn solve(&mut self, solver: &str, slopes: &[DMatrix<f64>], right: &DVector<f64>) -> Result<DVector<f64>> {
        self.solve_with(solver, slopes, false, right)
    }

    fn solve_with(&mut self, solver: &str, slopes: &[DMatrix<f64>], is_symmetric: bool, right: &DVector<f64>) -> Result<DVector<f64>> {
        assert_eq!(slopes.len(), self.contacts.len(), "one G for every contact");
        self.eliminate(solver, slopes, is_symmetric)?;
        // alone where no contact acts
        let mut solved = self.inertia.solve(right);
        let mut own: Vec<f64> = self.groups.iter().flat_map(|group| &right.as_slice()[group.clone()]).copied().collect();
        self.factor.solve(&self.tree, &mut own, &mut self.work);
        let mut rest = own.as_slice();
        for group in &self.groups {
            let (here, after) = rest.split_at(group.len());
            solved.as_mut_slice()[group.clone()].copy_from_slice(here);
            rest = after;
        }
        Ok(solved)
    }

    fn eliminate(&mut self, solver: &str, slopes: &[DMatrix<f64>], is_symmetric: bool) -> Result<()> {
        let AugmentedMass { contacts, groups, masses, tree, added, factor, work, .. } = self;
        let is_regular = factor.compute(tree, is_symmetric, work, |node, front| {
            for &group in &tree.groups(node)[..tree.nodes[node].pivot_groups] {
                add_mass(&masses[group], front.local[group], is_symmetric, front);
            }
            for &k in &added[node] {
                let place = |part: BodyRows<'a>| {
                    let group = group_of(groups, part.first);
                    (front.local[group] + part.first - groups[group].start, part)
                };
                let parts: Vec<_> = contacts[k].parts().map(place).collect();
                add_contact(&parts, &slopes[k], is_symmetric, front);
            }
        });
        match (is_regular, factor.was_left) {
            (true, _) => Ok(()),
            (false, true) => {
                memory::require("eliminating the velocities of bodies that meet", tree.need().bytes(is_symmetric))?;
                Err(Error::limit(solver, "had no room or no time to eliminate the velocities"))
            }
            (false, false) if is_symmetric => Err(Error::breakdown(solver, "met a matrix of the velocities that is not positive definite")),
            (false, false) => Err(Error::breakdown(solver, "met a singular matrix of the velocities")),
        }
    }
}

/// The velocities that M or a part of a contact couples, of each group that a contact touches.
fn touched_groups(mass: &Mass, contacts: &[Rows]) -> Vec<Range<usize>> {
    let size = mass.size();
    let (mut goes_on, mut is_touched) = (vec![false; size], vec![false; size]);
    let mut join = |range: Range<usize>| range.skip(1).for_each(|v| goes_on[v] = true);
    for part in contacts.iter().flat_map(Rows::parts) {
        join(part.first..part.first + part.width);
        is_touched[part.first..part.first + part.width].fill(true);
    }
    match mass {
        Mass::Diagonal(_) => {}
        Mass::Blocks(blocks) => {
            let mut first = 0;
            for block in blocks {
                join(first..first + block.nrows());
                first += block.nrows();
            }
        }
        Mass::Dense(_) => join(0..size),
    }
    let (mut groups, mut first) = (Vec::new(), 0);
    while first < size {
        let end = (first + 1..size).find(|v| !goes_on[*v]).unwrap_or(size);
        if is_touched[first..end].contains(&true) {
            groups.push(first..end);
        }
        first = end;
    }
    groups
}

/// The group of a velocity that a contact touches.
fn group_of(groups: &[Range<usize>], velocity: usize) -> usize {
    groups.partition_point(|group| group.end <= velocity)
}

/// M of every group.
fn masses_of(mass: &Mass, groups: &[Range<usize>]) -> Vec<DMatrix<f64>> {
    let square = |group: &Range<usize>| DMatrix::zeros(group.len(), group.len());
    match mass {
        Mass::Diagonal(diagonal) => {
            let of = |group: &Range<usize>| DMatrix::from_diagonal(&diagonal.rows_range(group.clone()));
            groups.iter().map(of).collect()
        }
        Mass::Blocks(blocks) => {
            let (mut masses, mut first): (Vec<_>, _) = (groups.iter().map(square).collect(), 0);
            for block in blocks.iter().filter(|block| block.nrows() > 0) {
                let group = group_of(groups, first);
                if let Some(own) = groups.get(group).filter(|own| own.contains(&first)) {
                    let place = first - own.start;
                    masses[group].view_mut((place, place), block.shape()).copy_from(block);
                }
                first += block.nrows();
            }
            masses
        }
        Mass::Dense(dense) => {
            groups.iter().map(|group| dense.view((group.start, group.start), (group.len(), group.len())).into()).collect()
        }
    }
}

/// Adds M of a group whose first row of the front is `first`; of a symmetric sum the lower triangle.
fn add_mass(mass: &DMatrix<f64>, first: usize, is_symmetric: bool, front: &mut Front) {
    for (j, column) in mass.column_iter().enumerate() {
        let from = if is_symmetric { j } else { 0 };
        let place = (first + j) * front.size + first;
        let target = &mut front.entries[place + from..place + column.len()];
        target.iter_mut().zip(column.iter().skip(from)).for_each(|(entry, m)| *entry += m);
    }
}

/// Adds HᵀGH of a contact, of whose parts the first row of the front is given; of a symmetric sum the lower triangle.
fn add_contact(parts: &[(usize, BodyRows)], slope: &DMatrix<f64>, is_symmetric: bool, front: &mut Front) {
    if slope.iter().all(|entry| *entry == 0.0) {
        return;
    }
    let mut weighted = DVector::zeros(slope.nrows());
    for (first, own) in parts {
        for axis in 0..own.width {
            weighted.fill(0.0);
            let entries = own.entries[axis..].iter().step_by(own.width);
            entries.zip(slope.column_iter()).for_each(|(h, column)| weighted.axpy(*h, &column, 1.0));
            let column = first + axis;
            for (from, other) in parts {
                let row = |i: usize| other.entries[i..].iter().step_by(other.width);
                for i in (0..other.width).filter(|i| !is_symmetric || from + i >= column) {
                    front.entries[column * front.size + from + i] += row(i).zip(&weighted).map(|(h, g)| h * g).sum::<f64>();
                }
            }
        }
    }
}

#[cfg(test)]
#[path = "augmented_mass_tests.rs"]
mod tests;
