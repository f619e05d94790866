//! What solvers and certificates ask of W, however it is stored.
//!
//! ```text
//!     W_kk ,     velocity += W r ,     sums += |W||r| or more ,     velocity += W e_k r_k ,     the bodies that contact k touches
//! ```

/// W as an operator over contacts of equally many rows; impulses in N·s, velocities in m/s.
pub trait ContactOperator {
    /// Writes W_kk \[1/kg\] column by column into `block`, whose size is the square of the rows of a contact.
    ///
    /// # Panics
    /// If there is no such contact.
    fn diagonal_block(&self, contact: usize, block: &mut [f64]);

    /// Adds W r.
    ///
    /// # Panics
    /// If there are not as many impulses and velocities as rows.
    fn add_product(&self, impulse: &[f64], velocity: &mut [f64]);

    /// Adds an upper bound of |W||r|, for bounds of rounding: |W||r| itself where W is stored, |Yᵀ||Y||r| ≥ |W||r| where it is the product
    /// of factors, in which its rounding is made.
    ///
    /// # Panics
    /// If there are not as many impulses and sums as rows.
    fn add_magnitudes(&self, impulse: &[f64], sums: &mut [f64]);

    /// Adds W e_k r_k: what the impulse of contact k, of as many rows as it has, changes at all contacts.
    ///
    /// # Panics
    /// If there is no such contact.
    fn add_contact(&self, contact: usize, impulse: &[f64], velocity: &mut [f64]);

    /// The bodies that contact k touches; `None` where W does not tell.
    ///
    /// # Panics
    /// If there is no such contact.
    fn bodies(&self, contact: usize) -> Option<&[u32]>;

    /// Writes for every contact how many products are summed for one row of its W r, which is what the rounding of that row grows with: as
    /// many as the contacts have rows that W joins with it, itself among them. What W does not join with it counts nothing.
    fn write_terms(&self, terms: &mut [usize]);
}
