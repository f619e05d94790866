//! The mass and Jacobian by which a W acts that is never formed, entry by entry: M̂ = diag(M₁, M₂, …) and H, for who asks for matrices.

use super::{MatrixFree, Sparse};

impl MatrixFree {
    /// Number of entries of M̂ and H, zeros included.
    pub(crate) fn entries(&self) -> u128 {
        let velocities = self.jacobian().velocity_count();
        (velocities as u128).saturating_mul((velocities + self.rows_per_contact() * self.contacts()) as u128)
    }

    /// M̂ and H, entry by entry.
    pub(crate) fn triplets(&self) -> [Sparse; 2] {
        let (velocities, d) = (self.jacobian().velocity_count(), self.rows_per_contact());
        let mut mass = Sparse { shape: [velocities; 2], entries: Vec::new() };
        for body in 0..self.jacobian().body_count() {
            let first = self.jacobian().velocities(body).start;
            let own = Sparse::of(&self.mass(body).into_owned()).entries.into_iter();
            mass.entries.extend(own.map(|(i, j, value)| (first + i, first + j, value)));
        }
        let mut jacobian = Sparse { shape: [d * self.contacts(), velocities], entries: Vec::new() };
        for (k, (body, block)) in (0..self.contacts()).flat_map(|k| self.jacobian().contact(k).map(move |part| (k, part))) {
            let range = self.jacobian().velocities(body);
            let own =
                block.iter().enumerate().map(|(place, value)| (k * d + place / range.len(), range.start + place % range.len(), *value));
            jacobian.entries.extend(own);
        }
        [mass, jacobian]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operator::BlockRows;
    use nalgebra::dmatrix;

    #[test]
    fn bodies_and_rows_stand_where_they_belong() {
        let mut jacobian = BlockRows::new(2, [2, 1]).unwrap();
        jacobian.push(&[(0, &[1.0, 2.0, 3.0, 4.0])]).unwrap();
        jacobian.push(&[(0, &[5.0, 0.0, 0.0, 6.0]), (1, &[7.0, 8.0])]).unwrap();
        let free = MatrixFree::new(&[dmatrix![2.0, 0.5; 0.25, 1.0], dmatrix![4.0]], jacobian).unwrap();
        let [mass, rows] = free.triplets().map(|triplets| triplets.to_dense());
        assert_eq!(mass, dmatrix![2.0, 0.5, 0.0; 0.25, 1.0, 0.0; 0.0, 0.0, 4.0]);
        assert_eq!(rows, dmatrix![1.0, 2.0, 0.0; 3.0, 4.0, 0.0; 5.0, 0.0, 7.0; 0.0, 6.0, 8.0]);
        assert_eq!(free.entries(), 3 * (3 + 4));
    }
}
