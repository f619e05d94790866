//! A mass matrix with its factor.

use super::delassus::{MassFactor, delassus_factored};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// A mass matrix M̂ with its factorisation, so that it is factored only once.
#[derive(Clone, Debug)]
pub struct Inertia {
    matrix: DMatrix<f64>,
    factor: MassFactor<f64>,
}

impl Inertia {
    /// Factors M̂.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] if it is not symmetric positive definite.
    pub fn new(matrix: DMatrix<f64>) -> Result<Self> {
        let factor = MassFactor::new(&matrix)?;
        Ok(Inertia { matrix, factor })
    }

    /// M̂ itself.
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// Its factor.
    pub fn factor(&self) -> &MassFactor<f64> {
        &self.factor
    }

    /// M̂⁻¹ p.
    pub fn solve(&self, impulse: &DVector<f64>) -> DVector<f64> {
        self.factor.solve(impulse)
    }

    /// W = H M̂⁻¹ Hᵀ \[1/kg\].
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] if H does not fit or is not finite.
    pub fn delassus(&self, jacobian: &DMatrix<f64>) -> Result<DMatrix<f64>> {
        delassus_factored(&self.factor, jacobian)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn it_solves_and_makes_w_as_the_matrix_does() {
        let inertia = Inertia::new(dmatrix![2.0, 0.5; 0.5, 1.0]).expect("definite");
        let moved = inertia.solve(&dvector![1.0, -1.0]);
        assert!((inertia.matrix() * &moved - dvector![1.0, -1.0]).amax() <= moreau_exact::tolerance::rounding(8, 2.0));
        let jacobian = dmatrix![1.0, 0.0; 1.0, 1.0];
        let w = super::super::delassus::delassus(inertia.matrix(), &jacobian).expect("definite");
        assert_eq!(inertia.delassus(&jacobian).expect("it fits"), w);
        assert!(Inertia::new(dmatrix![0.0]).is_err() && inertia.delassus(&dmatrix![1.0]).is_err());
    }
}
