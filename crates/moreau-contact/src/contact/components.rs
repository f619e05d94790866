//! The few numbers of one contact, one per row, kept in place.

use std::ops::{Deref, DerefMut};

/// Rows of a contact at most: normal, two tangents, spinning, two of rolling.
const MOST: usize = 6;

/// One number per row of a contact, a slice of up to six.
/// ```
/// use moreau_contact::contact::Components;
///
/// let mut impulse = Components::from([1.0, -0.5].as_slice());
/// impulse[0] += 1.0;
/// assert_eq!((impulse, impulse.len()), (Components::from(vec![2.0, -0.5]), 2));
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Components {
    values: [f64; MOST],
    count: usize,
}

impl Components {
    /// So many zeros.
    ///
    /// # Panics
    /// If they are more than six.
    pub fn zeros(count: usize) -> Self {
        assert!(count <= MOST, "a contact has up to {MOST} rows");
        Components { values: [0.0; MOST], count }
    }
}

impl Deref for Components {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.values[..self.count]
    }
}

impl DerefMut for Components {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.values[..self.count]
    }
}

impl From<&[f64]> for Components {
    /// # Panics
    /// If there are more than six.
    fn from(values: &[f64]) -> Self {
        let mut made = Components::zeros(values.len());
        made.copy_from_slice(values);
        made
    }
}

impl<const N: usize> From<[f64; N]> for Components {
    fn from(values: [f64; N]) -> Self {
        values.as_slice().into()
    }
}

impl From<Vec<f64>> for Components {
    fn from(values: Vec<f64>) -> Self {
        values.as_slice().into()
    }
}

impl FromIterator<f64> for Components {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        let mut made = Components::default();
        for value in values {
            made.values[made.count] = value;
            made.count += 1;
        }
        made
    }
}

impl PartialEq for Components {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}
