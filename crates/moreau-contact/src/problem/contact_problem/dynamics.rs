//! The mass and Jacobian of a contact problem, W = H M̂⁻¹ Hᵀ.

use crate::operator::Sparse;
use nalgebra::DMatrix;

/// The mass and Jacobian a Delassus operator came from, where known.
#[derive(Clone, Debug, PartialEq)]
pub struct Dynamics {
    /// Effective mass M̂, symmetric positive definite, nv × nv.
    pub mass: DMatrix<f64>,
    /// Contact Jacobian H, (rows_per_contact · contacts) × nv.
    pub jacobian: DMatrix<f64>,
}

impl Dynamics {
    /// Of M̂ and H as lists of their entries.
    pub(in crate::problem) fn of([mass, jacobian]: [Sparse; 2]) -> Self {
        Dynamics { mass: mass.to_dense(), jacobian: jacobian.to_dense() }
    }
}
