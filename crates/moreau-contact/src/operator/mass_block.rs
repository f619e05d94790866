//! The mass of one body or linkage, factored: M_b = L D Lᵀ, or P L U where it is not symmetric.

use crate::contact::delassus::MassFactor;
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector, Dyn, LU};

/// A factored mass of one group: symmetric and definite, or – an iteration matrix of large rotations or of joints – any that is regular.
#[derive(Clone, Debug)]
pub(super) enum Factor {
    Symmetric(MassFactor<f64>),
    Any(LU<f64, Dyn, Dyn>),
}

impl Factor {
    pub(super) fn new(mass: &DMatrix<f64>) -> Result<Self> {
        if *mass == mass.transpose() {
            return MassFactor::new(mass).map(Factor::Symmetric);
        }
        let symmetric = (mass + mass.transpose()) * 0.5;
        MassFactor::new(&symmetric)?; // a definite symmetric part makes the mass regular, and keeps every impulse from gaining energy
        Ok(Factor::Any(mass.clone().lu()))
    }

    pub(super) fn solve(&self, impulse: &DVector<f64>) -> DVector<f64> {
        match self {
            Factor::Symmetric(factor) => factor.solve(impulse),
            Factor::Any(factor) => factor.solve(impulse).expect("it is regular"),
        }
    }

    pub(super) fn is_symmetric(&self) -> bool {
        matches!(self, Factor::Symmetric(_))
    }

    /// D, ones where the mass is not symmetric.
    pub(super) fn pivots(&self) -> &[f64] {
        match self {
            Factor::Symmetric(factor) => factor.pivots(),
            Factor::Any(_) => &[],
        }
    }

    /// L⁻¹ times the columns; they stay where the mass is not symmetric.
    pub(super) fn forward_columns(&self, columns: &mut DMatrix<f64>) {
        if let Factor::Symmetric(factor) = self {
            columns.column_iter_mut().for_each(|mut column| factor.forward(column.as_mut_slice()));
        }
    }

    /// M⁻¹ times the columns.
    pub(super) fn solve_columns(&self, columns: &mut DMatrix<f64>) {
        for mut column in columns.column_iter_mut() {
            let solved = self.solve(&column.clone_owned());
            column.copy_from(&solved);
        }
    }

    /// What a contact's H is multiplied with from the left and from the right: L⁻¹Hᵀ and D⁻¹L⁻¹Hᵀ, or Hᵀ and M⁻¹Hᵀ.
    pub(super) fn halves(&self, jacobian: &DMatrix<f64>) -> Halves {
        let mut left = jacobian.transpose();
        match self {
            Factor::Symmetric(factor) => {
                left.column_iter_mut().for_each(|mut column| factor.forward(column.as_mut_slice()));
                Halves { right: left.clone(), left, pivots: factor.pivots().to_vec() }
            }
            Factor::Any(factor) => Halves { right: factor.solve(&left).expect("it is regular"), pivots: vec![1.0; left.nrows()], left },
        }
    }
}

/// The two halves of W at one contact and one group: a block is Σ left right / pivot.
pub(super) struct Halves {
    pub(super) left: DMatrix<f64>,
    pub(super) right: DMatrix<f64>,
    pub(super) pivots: Vec<f64>,
}
