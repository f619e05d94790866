//! The one-step contact problem: u = W r + u_free, y = u + shift + R r, (r, y) in the law.

use super::{ContactKey, Law};
use crate::memory::spare::{self, Lent};
#[cfg(feature = "files")]
use crate::operator::Sparse;
use crate::operator::{ContactOperator, Islands, MatrixFree, Operator, VelocityFactor};
use crate::tolerance::certificate::row_rounding;
use crate::tolerance::problem::WRITTEN_OUT;
use nalgebra::{DMatrix, DVector};

mod builder;
mod dynamics;
mod known;
mod number;
mod once;
mod part;
mod polyhedral;
mod softened;
#[cfg(test)]
mod tests;
mod validation;

pub use builder::ContactProblemBuilder;
pub use dynamics::Dynamics;
pub(in crate::problem) use known::Known;
use known::push_columns_of;
use number::Number;
use once::Once;
pub(crate) use part::island_rows;
#[cfg(feature = "files")]
pub(super) use validation::ROWS;
pub(super) use validation::{finite, finite_matrix, not_negative, validate_dynamics};

/// In which coordinates a diagonal compliance R acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinates {
    /// One entry per contact row (n, t₁, t₂).
    Contact,
    /// One entry per edge of a polyhedral associated law.
    Edge,
}

/// Diagonal softness R \[1/kg\] of a contact law.
#[derive(Clone, Debug, PartialEq)]
pub struct Compliance {
    /// Where the entries act.
    pub coordinates: Coordinates,
    /// The diagonal, all entries ≥ 0.
    pub diagonal: DVector<f64>,
}

/// What an impulse of each contact moves at the contact itself, normal and tangential.
#[derive(Clone, Debug, Default)]
pub(crate) struct Weights {
    /// ρ_n and ρ_t \[kg\].
    pub weights: Lent<Vec<[f64; 2]>>,
    /// Whether it moves anything.
    pub moves_itself: Lent<Vec<[bool; 2]>>,
}

/// One step's contact problem, valid since it was built.
///
/// Find r with u = W r + u_free, y = u + shift + R r and (r, y) in the law, contact by contact. How W is stored is the affair of
/// [`Operator`]. An algorithm asks for its effect ([`apply`](Self::apply), [`add_contact`](Self::add_contact)), for an
/// [`entry`](Self::entry) or for a [`diagonal_block`](Self::diagonal_block). Only an algorithm that needs all of W asks for a
/// [`dense`](Self::dense) matrix.
///
/// [`ContactProblem::new`] or [`ContactProblem::from_dynamics`] begins one; [`ContactProblem::into_builder`] changes one.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactProblem {
    name: Lent<String>,
    rows_per_contact: usize,
    law: Law,
    friction: Lent<Vec<f64>>,
    free_velocity: Lent<DVector<f64>>,
    shift: Lent<DVector<f64>>,
    delassus: Operator,
    compliance: Option<Compliance>,
    dynamics: Option<Known>,
    bodies: Option<Lent<Vec<[Option<usize>; 2]>>>,
    keys: Option<Vec<ContactKey>>,
    groups: Once<Lent<Vec<usize>>>,
    weights: Once<Weights>,
    islands: Once<Islands>,
    rounding: Once<Lent<Vec<f64>>>,
    loses_digits: Once<bool>,
    unformed: Once<Option<MatrixFree>>,
    overreaches: Once<bool>,
    indefiniteness: Once<f64>,
    velocity_factor: Once<Option<VelocityFactor>>,
    written_out: Once<Option<Dynamics>>,
    number: Number,
}

impl ContactProblem {
    /// A name for messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What no other problem of this process has but its copies.
    pub(crate) fn number(&self) -> u64 {
        self.number.get()
    }

    /// The contact law.
    pub fn law(&self) -> Law {
        self.law
    }

    /// Rows per contact: 1 (normal only), 2 (planar) or 3.
    pub fn rows_per_contact(&self) -> usize {
        self.rows_per_contact
    }

    /// Number of contacts.
    pub fn contacts(&self) -> usize {
        self.friction.len()
    }

    /// Number of contact rows, rows_per_contact · contacts.
    pub fn rows(&self) -> usize {
        self.rows_per_contact * self.contacts()
    }

    /// Friction coefficient μ ≥ 0 per contact.
    pub fn friction(&self) -> &[f64] {
        &self.friction
    }

    /// Whether nothing rubs: the law without friction, or a round cone with μ = 0 at every contact. Then it is a linear complementarity
    /// problem of the normal rows.
    pub fn is_frictionless(&self) -> bool {
        match self.law {
            Law::Frictionless => true,
            Law::Coulomb | Law::Associated => self.friction.iter().all(|mu| *mu == 0.0),
            Law::PolyhedralCoulomb { .. } | Law::PolyhedralAssociated { .. } => false,
        }
    }

    /// u_free = H v_free \[m/s\].
    pub fn free_velocity(&self) -> &DVector<f64> {
        &self.free_velocity
    }

    /// What the scheme adds for the law: restitution, φ/h, reference acceleration \[m/s\].
    pub fn shift(&self) -> &DVector<f64> {
        &self.shift
    }

    /// R, if the contact is soft.
    pub fn compliance(&self) -> Option<&Compliance> {
        self.compliance.as_ref()
    }

    /// R of one contact row \[1/kg\], zero if the problem is hard or its compliance acts on edges.
    pub fn row_compliance(&self, row: usize) -> f64 {
        self.row_compliances().map_or(0.0, |diagonal| diagonal[row])
    }

    /// R of all contact rows \[1/kg\]; none where all are zero.
    pub(crate) fn row_compliances(&self) -> Option<&[f64]> {
        match &self.compliance {
            Some(Compliance { coordinates: Coordinates::Contact, diagonal }) => Some(diagonal.as_slice()),
            _ => None,
        }
    }

    /// M̂ and H, where known, as matrices with all their zeros. What is kept by bodies or as lists is written out, once; of a file only if
    /// it is not too large for that.
    pub fn dynamics(&self) -> Option<&Dynamics> {
        match (&self.dynamics, self.delassus.matrix_free()) {
            (None, Some(free)) => {
                let is_small = || free.entries() <= WRITTEN_OUT;
                self.written_out.get_or(|| is_small().then(|| Dynamics::of(free.triplets()))).as_ref()
            }
            (known, _) => known.as_ref().filter(|known| known.is_finite()).and_then(Known::dense),
        }
    }

    /// M̂ and H entry by entry, where they are not kept as matrices.
    #[cfg(feature = "files")]
    pub(in crate::problem) fn triplets(&self) -> Option<[Sparse; 2]> {
        self.dynamics.as_ref().filter(|known| known.is_finite()).and_then(|known| known.triplets(self.rows_per_contact))
    }

    /// What `find` says of the contacts, which the certificate asks for every answer: it is found once.
    pub(crate) fn groups(&self, find: impl FnOnce(&Self) -> Lent<Vec<usize>>) -> &[usize] {
        self.groups.get_or(|| find(self))
    }

    /// What `find` says of each contact alone, which every judge and every step of Newton's method asks for: it is found once.
    pub(crate) fn weights(&self, find: impl FnOnce(&Self) -> Weights) -> &Weights {
        self.weights.get_or(|| find(self))
    }

    /// The contacts that W joins, found once.
    pub(crate) fn islands(&self) -> &Islands {
        self.islands.get_or(|| Islands::of(&self.delassus, self.contacts()))
    }

    /// γ of every row of y, relative to its terms, found once.
    pub(crate) fn rounding(&self) -> &[f64] {
        self.rounding.get_or(|| {
            let mut terms = Lent::from(spare::repeated(self.contacts(), usize::MAX));
            if let Some(operator) = self.rounded_as() {
                operator.write_terms(&mut terms);
            }
            let rows = self.rows_per_contact;
            let of_rows = terms.iter().flat_map(|terms| std::iter::repeat_n(row_rounding(*terms), rows));
            spare::collected(self.rows(), of_rows).into()
        })
    }

    /// The W by whose terms rounding is bounded: as it is kept, or where forming it of a nearly singular mass lost digits as it was made;
    /// `None` if there is no room for that.
    pub(crate) fn rounded_as(&self) -> Option<&dyn ContactOperator> {
        let kept = self.delassus.of_contacts();
        if self.loses_digits() { self.unformed().map(|free| free as &dyn ContactOperator) } else { Some(kept) }
    }

    /// Whether W was formed of a mass so nearly singular that it lost digits, or there is no room to see; found once.
    fn loses_digits(&self) -> bool {
        let look = |known: &Known| known.loses_digits(self.rows_per_contact).unwrap_or(true);
        *self.loses_digits.get_or(|| self.dynamics.as_ref().is_some_and(look))
    }

    /// W as mass and Jacobian make it, where what is kept was formed of them; `None` if they are not known or take more memory than is
    /// allowed. Found once.
    pub(crate) fn unformed(&self) -> Option<&MatrixFree> {
        let make = || self.dynamics.as_ref().and_then(|known| known.unformed(self.rows_per_contact).ok());
        self.unformed.get_or(make).as_ref()
    }

    /// Whether some entry of W is larger than those of bodies, or it is said to be any matrix; found once.
    pub(crate) fn overreaches(&self) -> bool {
        *self.overreaches.get_or(|| self.delassus.overreaches(self.rows_per_contact))
    }

    /// How far W is from one of bodies as `find` says, which is asked once; 0 where W is made of mass and Jacobian.
    pub(crate) fn indefiniteness(&self, find: impl FnOnce(&Self) -> f64) -> f64 {
        *self.indefiniteness.get_or(|| find(self))
    }

    /// Whether an impulse that is small at its own contact may move another one far, where that is known: no, of bodies.
    pub(crate) fn known_overreach(&self) -> Option<bool> {
        match (self.overreaches.get(), self.indefiniteness.get()) {
            (Some(true), _) => Some(true),
            (Some(false), Some(0.0)) => Some(false),
            _ => None,
        }
    }

    /// W = Y Yᵀ by bodies, found once: from the mechanism or the bodies where they are known, else from the blocks of W; `None` where they
    /// do not tell, or there are too many velocities for elimination in them to pay.
    pub(crate) fn velocity_factor(&self) -> Option<&VelocityFactor> {
        let by_bodies = || self.dynamics.as_ref().and_then(Known::by_bodies);
        let find = || match (self.delassus.matrix_free(), by_bodies()) {
            (Some(free), _) => VelocityFactor::of_bodies(free).filter(VelocityFactor::pays),
            (None, Some((inertia, jacobian))) => VelocityFactor::of_mechanism(inertia, &jacobian),
            _ => self.delassus.blocks().and_then(VelocityFactor::recover).filter(VelocityFactor::pays),
        };
        self.velocity_factor.get_or(find).as_ref()
    }

    /// Whether H is known, as a matrix or by bodies.
    pub fn knows_rows(&self) -> bool {
        self.dynamics.is_some() || self.delassus.matrix_free().is_some()
    }

    /// Appends the columns of H that the rows of a contact touch, growing; nothing where H is not known.
    pub(crate) fn push_touched(&self, contact: usize, columns: &mut Vec<usize>) {
        match (self.delassus.matrix_free(), &self.dynamics) {
            (Some(free), _) => push_columns_of(free.jacobian(), contact, columns),
            (None, Some(known)) => known.push_touched(contact, self.rows_per_contact, columns),
            (None, None) => {}
        }
    }

    /// The two bodies of each contact by number, the ground as `None`, where known: contacts of one pair are judged by one size.
    pub fn bodies(&self) -> Option<&[[Option<usize>; 2]]> {
        self.bodies.as_ref().map(|bodies| bodies.as_slice())
    }

    /// What tells each contact from the others in any list, where known; by it [`carried`](super::carried) takes impulses to a changed
    /// list.
    pub fn keys(&self) -> Option<&[ContactKey]> {
        self.keys.as_deref()
    }

    /// W_ij \[1/kg\].
    ///
    /// # Panics
    /// If the problem has no such row or column.
    pub fn entry(&self, row: usize, column: usize) -> f64 {
        self.delassus.entry(row, column)
    }

    /// W_kk, the block of contact k \[1/kg\], as large as the contact has rows.
    ///
    /// # Panics
    /// If the problem has no such contact.
    pub fn diagonal_block(&self, contact: usize) -> DMatrix<f64> {
        let mut block = DMatrix::zeros(self.rows_per_contact, self.rows_per_contact);
        self.delassus.of_contacts().diagonal_block(contact, block.as_mut_slice());
        block
    }

    /// W r \[m/s\] for impulses r \[N·s\].
    ///
    /// # Panics
    /// If there are not as many impulses as rows.
    pub fn apply(&self, impulse: &DVector<f64>) -> DVector<f64> {
        self.delassus.apply(impulse)
    }

    /// Adds W e_j r to `velocity` \[m/s\]: what the impulse r \[N·s\] at row j alone changes. A sweep lives on it.
    ///
    /// # Panics
    /// If the problem has no row j.
    pub fn add_column(&self, j: usize, impulse: f64, velocity: &mut [f64]) {
        self.delassus.add_column(j, impulse, velocity);
    }

    /// Adds (W + R) e_k r to `law_velocity` \[m/s\]: what the change r \[N·s\] of contact k's impulse does to every y.
    ///
    /// # Panics
    /// If the problem has no such contact.
    #[inline]
    pub fn add_contact(&self, contact: usize, change: &[f64], law_velocity: &mut [f64]) {
        let first = contact * self.rows_per_contact;
        match &self.delassus {
            Operator::Dense(dense) => dense.add_contact(contact, change, law_velocity),
            other => other.of_contacts().add_contact(contact, change, law_velocity),
        }
        let softness = self.row_compliances();
        let soft = |row: usize| softness.map_or(0.0, |softness| softness[row]);
        let rows = law_velocity[first..].iter_mut().zip(change).enumerate();
        rows.for_each(|(at, (y, change))| *y += soft(first + at) * change);
    }

    /// W, however it is stored.
    pub fn delassus(&self) -> &Operator {
        &self.delassus
    }

    /// W = H M̂⁻¹ Hᵀ \[1/kg\] as a square matrix, for algorithms that factor it; blocks are written out, once. Files may hold an
    /// asymmetric one. [`law_delassus`](Self::law_delassus) is refused where there is no room for it.
    pub fn dense(&self) -> &DMatrix<f64> {
        self.delassus.dense()
    }

    /// u = W r + u_free \[m/s\] for impulses r \[N·s\].
    pub fn velocity(&self, impulse: &DVector<f64>) -> DVector<f64> {
        self.apply(impulse) + &*self.free_velocity
    }

    /// Overwrites `velocity` with [`ContactProblem::velocity`].
    pub(crate) fn write_velocity(&self, impulse: &[f64], velocity: &mut [f64]) {
        self.delassus.write_product(impulse, velocity);
        velocity.iter_mut().zip(&*self.free_velocity).for_each(|(u, free)| *u += free);
    }

    /// y = u + shift + R r \[m/s\]; an edge compliance is not part of it, because it acts on edge impulses.
    pub fn law_velocity(&self, impulse: &DVector<f64>) -> DVector<f64> {
        let mut y = DVector::zeros(impulse.len());
        self.write_law_velocity(impulse.as_slice(), y.as_mut_slice());
        y
    }

    /// Overwrites `law_velocity` with [`ContactProblem::law_velocity`].
    pub(crate) fn write_law_velocity(&self, impulse: &[f64], law_velocity: &mut [f64]) {
        self.delassus.write_product(impulse, law_velocity);
        for (row, y) in law_velocity.iter_mut().enumerate() {
            *y = *y + self.free_velocity[row] + self.shift[row];
        }
        if let Some(Compliance { coordinates: Coordinates::Contact, diagonal }) = &self.compliance {
            law_velocity.iter_mut().zip(diagonal.iter().zip(impulse)).for_each(|(y, (softness, r))| *y += softness * r);
        }
    }

    /// max |W − Wᵀ| / max |W|, zero for a symmetric Delassus operator.
    pub fn asymmetry(&self) -> f64 {
        self.delassus.asymmetry()
    }
}
