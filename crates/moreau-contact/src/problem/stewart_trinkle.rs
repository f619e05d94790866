//! The Stewart–Trinkle LCP of a polyhedral Coulomb problem,
//!
//! ```text
//!         ⎡ W̃    B ⎤        W̃ = Gᵀ(W + R)G ,   B = (0; E) ,   C = (μ, −Eᵀ)
//!     M = ⎣ C    0 ⎦ ,  q = (Gᵀ(u_free + shift), 0) ,   z = (λ, β, σ) .
//! ```
//!
//! With k contacts and d directions each: λ (k normal impulses), β (k·d, contact by contact), σ (k slip speeds).
//! G maps (λ, β) to the contact impulses, r_n = λ and r_t = Σ Dⱼβⱼ; E couples the d directions of a contact to its σ.

use super::{Compliance, ContactProblem, Coordinates, Law, Lcp, PlanarProblem};
use crate::cones::polyhedral;
use moreau_exact::scalar::Scalar;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// G: (λ, β) ↦ r for contacts with rows (n, t₁) or (n, t₁, t₂), (rows · k) × k(1 + d).
///
/// In planar contacts only the first component of a direction counts.
pub fn generators<T: Scalar>(contacts: usize, rows_per_contact: usize, directions: &[[T; 2]]) -> DMatrix<T> {
    let d = directions.len();
    let mut generators = DMatrix::from_element(rows_per_contact * contacts, contacts * (1 + d), T::zero());
    for contact in 0..contacts {
        let normal = rows_per_contact * contact;
        generators[(normal, contact)] = T::one();
        for (j, direction) in directions.iter().enumerate() {
            for tangent in 1..rows_per_contact {
                generators[(normal + tangent, contacts + d * contact + j)] = direction[tangent - 1].clone();
            }
        }
    }
    generators
}

/// M of the LCP from W̃ (k(1 + d) square) and one friction coefficient per contact.
///
/// # Panics
/// If the size of W̃ is not a multiple of the number of contacts.
///
/// # Source
/// Chapter §4, step 4 of the construction of the Stewart–Trinkle LCP.
pub fn matrix<T: Scalar>(reduced: &DMatrix<T>, friction: &[T]) -> DMatrix<T> {
    let contacts = friction.len();
    let impulses = reduced.nrows();
    assert!(reduced.is_square() && contacts > 0 && impulses.is_multiple_of(contacts), "W̃ has k(1 + d) rows and columns");
    let d = impulses / contacts - 1;
    let mut matrix = DMatrix::from_element(impulses + contacts, impulses + contacts, T::zero());
    matrix.view_mut((0, 0), (impulses, impulses)).copy_from(reduced);
    for (contact, mu) in friction.iter().enumerate() {
        let sigma = impulses + contact;
        matrix[(sigma, contact)] = mu.clone();
        for beta in contacts + d * contact..contacts + d * (contact + 1) {
            matrix[(beta, sigma)] = T::one();
            matrix[(sigma, beta)] = -T::one();
        }
    }
    matrix
}

/// The LCP from W̃, μ and the velocities Gᵀ(u_free + shift) along normals and directions.
///
/// # Panics
/// If the sizes do not fit.
pub fn lcp<T: Scalar>(reduced: &DMatrix<T>, friction: &[T], velocity: &DVector<T>) -> Lcp<T> {
    let matrix = matrix(reduced, friction);
    let vector = DVector::from_fn(matrix.nrows(), |i, _| if i < velocity.len() { velocity[i].clone() } else { T::zero() });
    Lcp::new(matrix, vector)
}

fn directions_of(count: usize) -> Vec<[f64; 2]> {
    (0..count).map(|j| polyhedral::direction(j, count)).collect()
}

impl ContactProblem {
    /// The number of directions with which this problem is a Stewart–Trinkle LCP exactly: its own for the polyhedral
    /// law, 2 for Coulomb's law in the plane, where ±tangent₁ spans the whole cone.
    pub fn stewart_trinkle_directions(&self) -> Option<usize> {
        match self.law() {
            Law::PolyhedralCoulomb { directions } => Some(directions),
            Law::Coulomb if self.rows_per_contact() == 2 => Some(2),
            _ => None,
        }
    }

    /// G of this problem for d directions at angles 2πj/d.
    pub fn stewart_trinkle_generators(&self, directions: usize) -> DMatrix<f64> {
        generators(self.contacts(), self.rows_per_contact(), &directions_of(directions))
    }

    /// The LCP in (λ, β, σ), compliance in contact coordinates included in W̃.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if the law is not a Stewart–Trinkle LCP.
    pub fn stewart_trinkle_lcp(&self) -> Result<Lcp<f64>> {
        let Some(directions) = self.stewart_trinkle_directions() else {
            return Err(Error::Unsupported(format!("the law `{}` is not a Stewart–Trinkle LCP", self.law().name())));
        };
        if self.contacts() == 0 {
            return Ok(Lcp::new(DMatrix::zeros(0, 0), DVector::zeros(0)));
        }
        let problem = PlanarProblem::new(self.law_delassus(), self.free_velocity() + self.shift());
        Ok(problem.polyhedral(self.friction(), &directions_of(directions))?.lcp)
    }

    /// W + R, with which y = (W + R) r + u_free + shift; R only where it acts on contact components.
    pub fn law_delassus(&self) -> DMatrix<f64> {
        match self.compliance() {
            Some(Compliance { coordinates: Coordinates::Contact, diagonal }) => self.dense() + DMatrix::from_diagonal(diagonal),
            _ => self.dense().clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::ratio;

    /// The chapter's point contact: M = 1, d₁ = (1, 0), d₂ = (−1, 0), μ = 1/2.
    #[test]
    fn the_chapters_matrix_is_reproduced_entry_by_entry() {
        let directions = [[ratio(1, 1), ratio(0, 1)], [ratio(-1, 1), ratio(0, 1)]];
        let generators = generators(1, 2, &directions);
        let reduced = generators.transpose() * &generators;
        let expected = [2, 0, 0, 0, 0, 2, -2, 2, 0, -2, 2, 2, 1, -2, -2, 0].map(|x| ratio(x, 2));
        assert_eq!(matrix(&reduced, &[ratio(1, 2)]), DMatrix::from_row_slice(4, 4, &expected));
    }

    #[test]
    fn unknowns_come_normals_first_then_directions_then_slip_speeds() {
        let generators = generators(2, 3, &[[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]]);
        assert_eq!((generators.nrows(), generators.ncols()), (6, 8));
        assert_eq!(generators[(3, 1)], 1.0);
        assert_eq!(generators[(5, 2 + 3 + 1)], 1.0);
        let matrix = matrix(&DMatrix::zeros(8, 8), &[0.25, 0.75]);
        assert_eq!((matrix[(8, 0)], matrix[(9, 1)], matrix[(9, 0)]), (0.25, 0.75, 0.0));
        assert_eq!((matrix[(5, 9)], matrix[(9, 5)], matrix[(4, 9)]), (1.0, -1.0, 0.0));
    }

    #[test]
    fn compliance_is_added_to_w_and_the_shift_to_the_free_velocity() {
        let problem = ContactProblem::new(DMatrix::from_row_slice(2, 2, &[1.0, 0.5, 0.5, 2.0]), DVector::from_vec(vec![-1.0, 2.0]))
            .name("soft")
            .law(Law::Coulomb)
            .rows_per_contact(2)
            .friction(vec![0.5])
            .shift(DVector::from_vec(vec![0.25, -0.5]))
            .compliance(Compliance { coordinates: Coordinates::Contact, diagonal: DVector::from_vec(vec![0.125, 4.0]) })
            .build()
            .unwrap();
        let lcp = problem.stewart_trinkle_lcp().expect("planar Coulomb");
        let expected = [1.125, 0.5, -0.5, 0.0, 0.5, 6.0, -6.0, 1.0, -0.5, -6.0, 6.0, 1.0, 0.5, -1.0, -1.0, 0.0];
        assert_eq!(lcp.matrix, DMatrix::from_row_slice(4, 4, &expected));
        assert_eq!(lcp.vector, DVector::from_vec(vec![-0.75, 1.5, -1.5, 0.0]));
    }
}
