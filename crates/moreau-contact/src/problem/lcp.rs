//! The linear complementarity problem 0 ≤ z ⟂ M z + q ≥ 0.

use moreau_exact::scalar::Scalar;
use nalgebra::{DMatrix, DVector};

/// Find z with 0 ≤ z ⟂ w = M z + q ≥ 0, over `f64` or exact rationals.
#[derive(Clone, Debug, PartialEq)]
pub struct Lcp<T: Scalar> {
    /// M, n × n.
    pub matrix: DMatrix<T>,
    /// q, length n.
    pub vector: DVector<T>,
}

impl<T: Scalar> Lcp<T> {
    /// The problem of size n.
    ///
    /// # Panics
    /// If M is not square or q has another size.
    pub fn new(matrix: DMatrix<T>, vector: DVector<T>) -> Self {
        assert!(matrix.is_square() && matrix.nrows() == vector.len(), "an LCP needs a square matrix and a vector of its size");
        Lcp { matrix, vector }
    }

    /// n.
    pub fn size(&self) -> usize {
        self.vector.len()
    }

    /// w = M z + q.
    pub fn slack(&self, z: &DVector<T>) -> DVector<T> {
        &self.matrix * z + &self.vector
    }
}
