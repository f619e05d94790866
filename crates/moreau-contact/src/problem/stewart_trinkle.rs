//! The Stewart–Trinkle LCP of a polyhedral Coulomb problem,
//!
//! ```text
//!         ⎡ W̃    B ⎤        W̃ = Gᵀ(W + R)G ,   B = (0; E) ,   C = (μ, −Eᵀ)
//!     M = ⎣ C    0 ⎦ ,  q = (Gᵀ(u_free + shift), 0) ,   z = (λ, β, σ) .
//! ```
//!
//! With k contacts and d directions each: λ (k normal impulses), β (k·d, contact by contact), σ (k slip speeds).
//! G maps (λ, β) to the contact impulses, r_n = λ and r_t = Σ Dⱼβⱼ; E couples the d directions of a contact to its σ.

use super::Lcp;
use moreau_exact::scalar::Scalar;
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
/// If W̃ is not square, if there is no contact, or if its size is not a multiple of their number.
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
    assert!(velocity.len() == reduced.nrows(), "one velocity per row of W̃");
    let matrix = matrix(reduced, friction);
    let vector = DVector::from_fn(matrix.nrows(), |i, _| if i < velocity.len() { velocity[i].clone() } else { T::zero() });
    Lcp::new(matrix, vector)
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
}
