//! H of several contacts, contact below contact.
//!
//! ```text
//!     u = H v ,   p = Hᵀ r
//! ```
//! Both cost as much as there are contacts, not as much as there are bodies.

use super::rows::Rows;
use crate::memory::spare::{self, Lent};
use nalgebra::{DMatrix, DVector};
use std::ops::Mul;

/// H of contacts with as many rows each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Jacobian {
    rows_per_contact: usize,
    columns: usize,
    contacts: Lent<Vec<Rows>>,
}

impl Jacobian {
    /// H of contacts of so many rows each, in a mechanism of so many velocities.
    ///
    /// # Panics
    /// If a contact has another shape.
    pub fn new(rows_per_contact: usize, columns: usize, contacts: Vec<Rows>) -> Self {
        assert!(
            contacts.iter().all(|contact| contact.shape() == (rows_per_contact, columns)),
            "every contact has the rows and columns of H"
        );
        Jacobian { rows_per_contact, columns, contacts: contacts.into() }
    }

    /// A dense H, cut into contacts of so many rows.
    ///
    /// # Panics
    /// If its rows are no whole number of contacts.
    pub fn from_dense(dense: &DMatrix<f64>, rows_per_contact: usize) -> Self {
        assert!(dense.nrows().is_multiple_of(rows_per_contact), "H consists of whole contacts");
        let contact = |k: usize| dense.rows(k * rows_per_contact, rows_per_contact).into_owned().into();
        Jacobian::new(rows_per_contact, dense.ncols(), (0..dense.nrows() / rows_per_contact).map(contact).collect())
    }

    /// The contacts.
    pub fn contacts(&self) -> &[Rows] {
        &self.contacts
    }

    /// H of some of the contacts.
    pub(crate) fn of(&self, members: &[usize]) -> Self {
        let contacts = spare::collected(members.len(), members.iter().map(|k| self.contacts[*k].clone())).into();
        Jacobian { rows_per_contact: self.rows_per_contact, columns: self.columns, contacts }
    }

    /// How many rows each contact has.
    pub fn rows_per_contact(&self) -> usize {
        self.rows_per_contact
    }

    /// How many rows all contacts have.
    pub fn nrows(&self) -> usize {
        self.rows_per_contact * self.contacts.len()
    }

    /// How many velocities the mechanism has.
    pub fn ncols(&self) -> usize {
        self.columns
    }

    /// Hᵀ r, the generalised impulse of r \[N·s\].
    ///
    /// # Panics
    /// If there are not as many impulses as rows.
    pub fn tr_mul(&self, impulse: &DVector<f64>) -> DVector<f64> {
        assert_eq!(impulse.len(), self.nrows(), "one impulse per row");
        let mut pushed = spare::zeros(self.columns);
        for (contact, r) in self.contacts.iter().zip(impulse.as_slice().chunks_exact(self.rows_per_contact.max(1))) {
            contact.add_transposed(r, pushed.as_mut_slice());
        }
        pushed
    }

    /// H with its zeros.
    pub fn to_dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.nrows(), self.columns);
        for (k, contact) in self.contacts.iter().enumerate() {
            dense.rows_mut(k * self.rows_per_contact, self.rows_per_contact).copy_from(&contact.to_dense());
        }
        dense
    }
}

impl Mul<&DVector<f64>> for &Jacobian {
    type Output = DVector<f64>;

    /// H v \[m/s\].
    fn mul(self, velocities: &DVector<f64>) -> DVector<f64> {
        let mut velocity = spare::zeros(self.nrows());
        for (contact, u) in self.contacts.iter().zip(velocity.as_mut_slice().chunks_exact_mut(self.rows_per_contact.max(1))) {
            contact.add_product(velocities.as_slice(), u);
        }
        velocity
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_multiplies_as_the_dense_matrix() {
        let entry = |seed: usize| ((seed * 7919 + 13) % 101) as f64 - 50.0;
        let block = |seed: usize| [[entry(seed), entry(seed + 1), entry(seed + 2)], [entry(seed + 3), entry(seed + 4), entry(seed + 5)]];
        let contact = |k: usize| Rows::zeros(2, 15).with(3 * k, block(11 * k)).with(3 * k - 3, block(11 * k + 6));
        let jacobian = Jacobian::new(2, 15, (1..5).map(contact).collect());
        let (v, r) = (DVector::from_fn(15, |i, _| i as f64 - 4.0), DVector::from_fn(8, |i, _| 3.0 - i as f64));
        let dense = jacobian.to_dense();
        assert_eq!((&jacobian * &v, jacobian.tr_mul(&r)), (&dense * &v, dense.tr_mul(&r)), "small integers are exact");
        assert_eq!(Jacobian::from_dense(&dense, 2), jacobian);
    }
}
