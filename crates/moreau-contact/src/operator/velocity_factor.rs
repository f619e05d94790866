//! W = Y Yᵀ with as many columns as there are velocities, by contacts and groups of velocities, in one piece of memory.
//!
//! ```text
//!     W_jk = Σ_b Y_jb Y_kbᵀ ,     Y_kb = H_kb L_b⁻ᵀ D_b^(−½)        b over the bodies of both contacts, M_b = L_b D_b L_bᵀ
//! ```
//! Where bodies are not known, [`velocity_recovery`](super::velocity_recovery) finds them in the blocks of W.

use super::MatrixFree;
use super::of_mechanism::{LARGEST, body_width};
use crate::contact::{Inertia, Jacobian, Rows};
use crate::memory::spare::{self, Lent};
use crate::tolerance::velocities::PAYS;

/// Rows that every part of Y is padded to.
const PADDED: usize = 3;

/// Y by contacts and groups of velocities.
#[derive(Clone, Debug, Default)]
pub(crate) struct VelocityFactor {
    /// Columns of every group.
    pub columns: Lent<Vec<usize>>,
    rows_per_contact: usize,
    /// The parts of contact k are numbers starts[k] .. starts[k + 1].
    starts: Lent<Vec<usize>>,
    /// The group of every part, and where its entries begin.
    parts: Lent<Vec<(usize, usize)>>,
    /// Three rows of every part, row after row; those that the contact does not have are zero.
    pub entries: Lent<Vec<f64>>,
}

fn pays(velocities: usize, rows: usize) -> bool {
    velocities as f64 <= PAYS * rows as f64
}

impl VelocityFactor {
    /// No contact yet, of so many rows each, with room for so many of two groups of so many columns.
    pub(super) fn with_capacity(columns: Vec<usize>, rows_per_contact: usize, contacts: usize, width: usize) -> Self {
        let mut starts = spare::vector(contacts + 1);
        starts.push(0);
        let (parts, entries) = (spare::vector(2 * contacts).into(), spare::vector(2 * PADDED * contacts * width).into());
        VelocityFactor { columns: columns.into(), rows_per_contact, starts: starts.into(), parts, entries }
    }

    /// Appends a part of the contact that is not complete yet, given row by row.
    pub(super) fn push(&mut self, group: usize, rows: impl IntoIterator<Item = f64>) {
        let first = self.entries.len();
        self.parts.push((group, first));
        self.entries.extend(rows);
        self.entries.resize(first + PADDED * self.columns[group], 0.0);
    }

    /// Completes a contact.
    pub(super) fn end(&mut self) {
        self.starts.push(self.parts.len());
    }

    /// How many contacts there are.
    pub fn contacts(&self) -> usize {
        self.starts.len() - 1
    }

    /// Rows of each contact.
    pub fn rows_per_contact(&self) -> usize {
        self.rows_per_contact
    }

    /// Of a contact its groups, and where the entries of each begin.
    pub fn parts(&self, contact: usize) -> &[(usize, usize)] {
        &self.parts[self.starts[contact]..self.starts[contact + 1]]
    }

    /// Becomes a copy of another one, in its own memory.
    pub fn copy_from(&mut self, other: &VelocityFactor) {
        self.rows_per_contact = other.rows_per_contact;
        self.columns.clone_from(&other.columns);
        self.starts.clone_from(&other.starts);
        self.parts.clone_from(&other.parts);
        self.entries.clone_from(&other.entries);
    }

    /// How many velocities there are.
    pub fn velocities(&self) -> usize {
        self.columns.iter().sum()
    }

    /// Whether there are so much fewer velocities than rows that elimination in them pays.
    pub fn pays(&self) -> bool {
        let contacts = (0..self.contacts()).filter(|k| !self.parts(*k).is_empty()).count();
        pays(self.velocities(), self.rows_per_contact * contacts)
    }

    /// Of a mechanism that consists of bodies of one size; none where it does not, or its velocities are too many to pay.
    pub fn of_mechanism(inertia: &Inertia, jacobian: &Jacobian) -> Option<Self> {
        let width = body_width(jacobian).filter(|width| inertia.is_made_of(*width))?;
        let parts = jacobian.contacts().iter().flat_map(Rows::parts);
        let mut bodies = Lent::from(spare::collected(2 * jacobian.contacts().len(), parts.map(|part| part.first / width)));
        bodies.sort_unstable();
        bodies.dedup();
        if !pays(bodies.len() * width, jacobian.nrows()) {
            return None;
        }
        let (factor, contacts) = (inertia.factor(), jacobian.contacts());
        let mut made =
            VelocityFactor::with_capacity(spare::repeated(bodies.len(), width), jacobian.rows_per_contact(), contacts.len(), width);
        for contact in contacts {
            for part in contact.parts() {
                let (mut entries, pivots) = ([0.0; LARGEST], &factor.pivots()[part.first..part.first + width]);
                let entries = &mut entries[..part.entries.len()];
                entries.copy_from_slice(part.entries);
                for row in entries.chunks_exact_mut(width) {
                    factor.forward_within(part.first, row);
                    row.iter_mut().zip(pivots).for_each(|(y, pivot)| *y /= pivot.sqrt());
                }
                let group = bodies.binary_search(&(part.first / width)).expect("a body of a contact is one of all");
                made.push(group, entries.iter().copied());
            }
            made.end();
        }
        Some(made)
    }

    /// Of bodies that are known, in coordinates in which every mass is one; none where a mass is not symmetric.
    pub fn of_bodies(free: &MatrixFree) -> Option<Self> {
        if !free.is_symmetric() {
            return None;
        }
        let (jacobian, d) = (free.jacobian(), free.rows_per_contact());
        let columns: Vec<usize> = (0..jacobian.body_count()).map(|body| jacobian.velocities(body).len()).collect();
        let mut made = VelocityFactor::with_capacity(columns, d, free.contacts(), 0);
        for k in 0..free.contacts() {
            for (block, body) in jacobian.blocks(k).zip(jacobian.bodies(k).iter().map(|body| *body as usize)) {
                let scale = &free.inverse()[jacobian.velocities(body)];
                let entries = free.left()[jacobian.place(block)].iter().enumerate();
                made.push(body, entries.map(|(place, y)| y * scale[place % scale.len()].sqrt()));
            }
            made.end();
        }
        Some(made)
    }
}
