//! A contact problem as a Stewart–Trinkle LCP, where its law is one.
//!
//! ```text
//!     0 ≤ z ⟂ M z + q ≥ 0 ,   r = G (λ, β) ,   z = (λ, β, σ)      from W + R and u_free + shift
//! ```

use super::{Compliance, ContactProblem, Coordinates};
use crate::cones::polyhedral;
use crate::memory;
use crate::problem::stewart_trinkle::generators;
use crate::problem::{Law, Lcp, PlanarProblem};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// A solver that asks for the square matrix keeps it, its own copy, a factor and what it works on.
const MATRICES: u128 = 4;

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
        let problem = PlanarProblem::new(self.law_delassus()?, self.free_velocity() + self.shift());
        Ok(problem.polyhedral(self.friction(), &directions_of(directions))?.lcp)
    }

    /// W + R as a square matrix, with which y = (W + R) r + u_free + shift; R only where it acts on contact components.
    ///
    /// # Errors
    /// [`Error::Invalid`] where W is stored by blocks and its square matrix would take more memory than is allowed.
    pub fn law_delassus(&self) -> Result<DMatrix<f64>> {
        let dense = self.afforded_dense()?;
        Ok(match self.compliance() {
            Some(Compliance { coordinates: Coordinates::Contact, diagonal }) => dense + DMatrix::from_diagonal(diagonal),
            _ => dense.clone(),
        })
    }

    /// [`dense`](Self::dense), with what a solver makes of it.
    ///
    /// # Errors
    /// [`Error::Invalid`] where W is not stored so and its square matrix would take more memory than is allowed.
    pub(crate) fn afforded_dense(&self) -> Result<&DMatrix<f64>> {
        if !self.delassus().is_dense() {
            let matrices = memory::matrix(self.rows(), self.rows()).saturating_mul(MATRICES);
            memory::require("the square Delassus matrix of this problem", matrices)?;
        }
        Ok(self.dense())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
