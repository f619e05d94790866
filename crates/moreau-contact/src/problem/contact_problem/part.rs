//! The problem of some of the contacts, which W joins with no other, of some of the rows, and with W stored in another way.

use super::number::Number;
use super::once::Once;
use super::{Compliance, ContactProblem, Coordinates, Law};
use crate::memory::spare;
use crate::operator::{BlockSparse, Islands, Operator};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

impl ContactProblem {
    /// The problem of one island, or of one contact that meets no other.
    pub(crate) fn island(&self, islands: &Islands, members: &[usize]) -> ContactProblem {
        let rows = self.rows_per_contact;
        let part = |whole: &DVector<f64>| island_rows(whole, members, rows).into();
        let each = |numbers: &mut dyn Iterator<Item = usize>| spare::collected(members.len(), numbers).into();
        let known = self.dynamics.as_ref().and_then(|known| known.of(members));
        // the first of an island of several is not the last of them
        let are_lone = members.last().is_some_and(|k| islands.first[*k] == *k);
        let is_stored = self.delassus.is_dense() || self.delassus.blocks().is_some();
        let own = is_stored.then(|| Islands::found(members.len(), are_lone));
        // contacts of one group are joined by W
        let groups = self.groups.get().map(|groups| each(&mut members.iter().map(|k| islands.place_among(members, groups[*k]))));
        ContactProblem {
            name: self.name.clone(),
            rows_per_contact: rows,
            law: self.law,
            friction: spare::collected(members.len(), members.iter().map(|k| self.friction[*k])).into(),
            free_velocity: part(&self.free_velocity),
            shift: part(&self.shift),
            delassus: self.delassus_of(islands, members),
            compliance: self.compliance.as_ref().map(|Compliance { coordinates, diagonal }| Compliance {
                coordinates: *coordinates,
                diagonal: island_rows(diagonal, members, diagonal.len() / self.contacts()),
            }),
            dynamics: known,
            bodies: self.bodies.as_ref().map(|bodies| spare::collected(members.len(), members.iter().map(|k| bodies[*k])).into()),
            keys: None,
            groups: groups.map_or_else(Once::default, Once::known),
            weights: Once::default(),
            islands: own.map_or_else(Once::default, Once::known),
            rounding: Once::default(),
            // it is asked of all bodies at once, not of all for each island
            loses_digits: if self.loses_digits() { Once::default() } else { Once::known(false) },
            unformed: Once::default(),
            overreaches: self.known_overreach().map_or_else(Once::default, Once::known),
            indefiniteness: if self.known_overreach() == Some(false) { Once::known(0.0) } else { Once::default() },
            velocity_factor: Once::default(),
            written_out: Once::default(),
            number: Number::default(),
        }
    }

    /// The same problem with this W in place of a dense one of the same entries: what was found of its contacts stays, mass and Jacobian
    /// are left out.
    pub(crate) fn stored_as(&self, blocks: BlockSparse) -> ContactProblem {
        ContactProblem {
            name: self.name.clone(),
            rows_per_contact: self.rows_per_contact,
            law: self.law,
            friction: self.friction.clone(),
            free_velocity: self.free_velocity.clone(),
            shift: self.shift.clone(),
            delassus: blocks.into(),
            compliance: self.compliance.clone(),
            dynamics: None,
            bodies: self.bodies.clone(),
            keys: None,
            groups: self.groups.clone(),
            weights: self.weights.clone(),
            islands: self.islands.clone(),
            rounding: self.rounding.clone(),
            loses_digits: Once::default(),
            unformed: Once::default(),
            overreaches: self.overreaches.clone(),
            indefiniteness: self.indefiniteness.clone(),
            velocity_factor: Once::default(),
            written_out: Once::default(),
            number: Number::default(),
        }
    }

    /// The normal rows alone, where nothing rubs; `None` where W is not stored.
    ///
    /// # Errors
    /// As of any problem.
    pub(crate) fn normal_rows(&self) -> Result<Option<ContactProblem>> {
        let (rows, contacts) = (self.rows_per_contact, self.contacts());
        let operator: Operator = match (&self.delassus, self.delassus.blocks()) {
            (_, Some(blocks)) => {
                let mut normals = BlockSparse::with_capacity(1, contacts, blocks.block_count());
                for k in 0..contacts {
                    normals.begin(k);
                    blocks.column(k).try_for_each(|(j, block)| normals.push(j, k, &block[..1]))?;
                }
                normals.finish(contacts);
                normals.into()
            }
            (Operator::Dense(dense), None) => DMatrix::from_fn(contacts, contacts, |j, k| dense[(j * rows, k * rows)]).into(),
            _ => return Ok(None),
        };
        let normal = |whole: &DVector<f64>| DVector::from_fn(contacts, |k, _| whole[k * rows]);
        let mut problem = ContactProblem::new(operator, normal(&self.free_velocity)).overreaching(self.known_overreach());
        problem = problem.name(self.name()).rows_per_contact(1);
        problem = problem.law(Law::Frictionless).friction(vec![0.0; contacts]).shift(normal(&self.shift));
        if let Some(Compliance { diagonal, .. }) = &self.compliance {
            problem = problem.compliance(Compliance { coordinates: Coordinates::Contact, diagonal: normal(diagonal) });
        }
        problem.build().map(Some)
    }

    /// W between these contacts, stored as that of the whole.
    fn delassus_of(&self, islands: &Islands, members: &[usize]) -> Operator {
        if let Some(blocks) = self.delassus.blocks() {
            return blocks.of(members, |k| islands.place_among(members, k)).into();
        }
        let d = self.rows_per_contact;
        let whole = |row: usize| members[row / d] * d + row % d;
        DMatrix::from_fn(members.len() * d, members.len() * d, |i, j| self.entry(whole(i), whole(j))).into()
    }
}

/// The rows of these contacts.
pub(crate) fn island_rows(whole: &DVector<f64>, members: &[usize], rows: usize) -> DVector<f64> {
    let mut part = spare::vector(members.len() * rows);
    members.iter().for_each(|k| part.extend_from_slice(&whole.as_slice()[k * rows..(k + 1) * rows]));
    DVector::from_vec(part)
}
