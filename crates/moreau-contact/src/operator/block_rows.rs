//! H by contacts and bodies: of every contact only the blocks H_kb of the bodies it touches.
//!
//! ```text
//!     u_k = Σ_b H_kb v_b                                                                               [m/s]
//! ```

use crate::memory;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};

/// The rows of H, contact after contact, as blocks of the bodies that each touches.
#[derive(Clone, Debug, PartialEq)]
pub struct BlockRows {
    rows_per_contact: usize,
    /// The velocities of body b are numbers first[b] .. first[b + 1].
    first: Vec<usize>,
    /// The blocks of contact k are numbers starts[k] .. starts[k + 1].
    starts: Vec<u32>,
    /// The body of every block, growing within a contact.
    bodies: Vec<u32>,
    /// The entries of block t are numbers places[t] .. places[t + 1], row by row; not kept where every body has equally many velocities.
    places: Vec<usize>,
    /// Of every body as many velocities as this, if they are equally many.
    equal: Option<usize>,
    values: Vec<f64>,
}

impl BlockRows {
    /// No contact yet, of so many rows each, between bodies of so many velocities.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a contact has no row or more than six.
    pub fn new(rows_per_contact: usize, velocities: impl IntoIterator<Item = usize>) -> Result<Self> {
        if !(1..=6).contains(&rows_per_contact) {
            return Err(Error::invalid("dimension", format!("is {rows_per_contact}"), "use 1 to 6 rows per contact"));
        }
        let mut first = vec![0];
        first.extend(velocities.into_iter().scan(0, |sum, size| {
            *sum += size;
            Some(*sum)
        }));
        let size = first.get(1).copied().unwrap_or(0);
        let equal = first.windows(2).all(|pair| pair[1] - pair[0] == size).then_some(size);
        Ok(BlockRows { rows_per_contact, first, starts: vec![0], bodies: Vec::new(), places: vec![0], equal, values: Vec::new() })
    }

    /// Makes room for so many contacts of two bodies each.
    ///
    /// # Errors
    /// [`Error::Invalid`] if they would take more memory than is allowed.
    pub fn reserve(&mut self, contacts: usize) -> Result<()> {
        let largest = self.first.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap_or(0);
        let entries = 2 * (self.rows_per_contact as u128) * largest as u128;
        memory::require("the contact Jacobian by blocks", (contacts as u128).saturating_mul(8 * entries + 28))?;
        self.starts.reserve(contacts);
        self.bodies.reserve(2 * contacts);
        self.values.reserve(contacts * entries as usize);
        Ok(())
    }

    /// Appends a contact: the bodies it touches, growing, each with H_kb row by row. A block of zeros alone is left out.
    ///
    /// # Errors
    /// [`Error::Invalid`] if a body is unknown or out of order, or its block has another size.
    pub fn push(&mut self, contact: &[(usize, &[f64])]) -> Result<()> {
        let at = format!("jacobian, contact {}", self.contacts());
        let mut last = None;
        for (body, block) in contact {
            if *body >= self.body_count() || last.is_some_and(|last| last >= *body) {
                let cure = format!("give each body once, growing, below {}", self.body_count());
                return Err(Error::invalid(at, format!("names the body {body}"), cure));
            }
            last = Some(*body);
            let size = self.rows_per_contact * self.velocities(*body).len();
            if block.len() != size {
                let problem = format!("has {} at body {body}", counted(block.len(), "entry"));
                return Err(Error::invalid(at, problem, format!("give {size}, its rows times the velocities of the body")));
            }
        }
        for (body, block) in contact.iter().filter(|(_, block)| block.iter().any(|entry| *entry != 0.0)) {
            self.bodies.push(*body as u32);
            self.values.extend_from_slice(block);
            if self.equal.is_none() {
                self.places.push(self.values.len());
            }
        }
        self.starts.push(self.bodies.len() as u32);
        Ok(())
    }

    /// Rows of each contact.
    pub fn rows_per_contact(&self) -> usize {
        self.rows_per_contact
    }

    /// Number of contacts.
    pub fn contacts(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of bodies.
    pub fn body_count(&self) -> usize {
        self.first.len() - 1
    }

    /// Number of velocities of all bodies.
    pub fn velocity_count(&self) -> usize {
        self.first[self.body_count()]
    }

    /// Which velocities belong to a body.
    ///
    /// # Panics
    /// If there is no such body.
    pub fn velocities(&self, body: usize) -> std::ops::Range<usize> {
        self.first[body]..self.first[body + 1]
    }

    /// As many velocities as every body has, if they are equally many.
    pub fn equal_velocities(&self) -> Option<usize> {
        self.equal
    }

    /// Which blocks belong to a contact.
    pub(crate) fn blocks(&self, contact: usize) -> std::ops::Range<usize> {
        self.starts[contact] as usize..self.starts[contact + 1] as usize
    }

    /// The bodies a contact touches, growing.
    ///
    /// # Panics
    /// If there is no such contact.
    #[inline]
    pub fn bodies(&self, contact: usize) -> &[u32] {
        &self.bodies[self.blocks(contact)]
    }

    /// The entries of a block.
    #[inline]
    pub(crate) fn place(&self, block: usize) -> std::ops::Range<usize> {
        match self.equal {
            Some(size) => {
                let entries = size * self.rows_per_contact;
                block * entries..(block + 1) * entries
            }
            None => self.places[block]..self.places[block + 1],
        }
    }

    /// The bodies a contact touches, each with H_kb row by row.
    ///
    /// # Panics
    /// If there is no such contact.
    pub fn contact(&self, contact: usize) -> impl Iterator<Item = (usize, &[f64])> {
        self.blocks(contact).map(|block| (self.bodies[block] as usize, &self.values[self.place(block)]))
    }

    /// All entries, block after block.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// H v \[m/s\].
    ///
    /// # Panics
    /// If there are not as many velocities as the bodies have.
    pub fn contact_velocity(&self, velocity: &[f64]) -> Vec<f64> {
        assert_eq!(velocity.len(), self.velocity_count(), "as many velocities as the bodies have");
        let mut found = vec![0.0; self.rows_per_contact * self.contacts()];
        for (k, u) in found.chunks_exact_mut(self.rows_per_contact).enumerate() {
            for (body, block) in self.contact(k) {
                let own = &velocity[self.velocities(body)];
                for (u, row) in u.iter_mut().zip(block.chunks_exact(own.len())) {
                    *u += row.iter().zip(own).map(|(h, v)| h * v).sum::<f64>();
                }
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_of_unequal_bodies_multiply_velocities() {
        let mut rows = BlockRows::new(2, [1, 2]).unwrap();
        rows.push(&[(0, &[2.0, 0.0]), (1, &[0.0, 1.0, 1.0, -1.0])]).unwrap();
        rows.push(&[(0, &[0.0; 2]), (1, &[0.0, 0.0, 3.0, 0.0])]).unwrap();
        rows.push(&[]).unwrap();
        assert_eq!(rows.contact_velocity(&[1.0, 10.0, 100.0]), [102.0, -90.0, 0.0, 30.0, 0.0, 0.0]);
        assert_eq!([rows.bodies(0), rows.bodies(1), rows.bodies(2)], [&[0, 1][..], &[1], &[]], "a block of zeros is none");
        assert_eq!((rows.velocity_count(), rows.equal_velocities()), (3, None));
        assert_eq!(BlockRows::new(1, [6, 6]).unwrap().equal_velocities(), Some(6));
    }

    #[test]
    fn unknown_bodies_and_wrong_sizes_are_refused() {
        let mut rows = BlockRows::new(1, [1, 1]).unwrap();
        let mut refused = |contact: &[(usize, &[f64])]| rows.push(contact).unwrap_err().to_string();
        assert!(refused(&[(2, &[1.0])]).contains("body 2"));
        assert!(refused(&[(1, &[1.0]), (0, &[1.0])]).contains("body 0"));
        assert!(refused(&[(1, &[1.0, 2.0])]).contains("2 entries"));
        assert_eq!(rows.contacts(), 0, "nothing is kept of what is refused");
        assert!(BlockRows::new(7, [1]).is_err() && BlockRows::new(0, [1]).is_err());
        assert!(rows.reserve(usize::MAX / 8).unwrap_err().to_string().contains("memory::set_limit"));
    }
}
