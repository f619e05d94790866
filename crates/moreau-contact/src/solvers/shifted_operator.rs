//! A = W + R and the systems (A + δ I) x = b, where W is stored densely or by blocks:
//!
//! ```text
//!     symmetric W, dense     A + δI = L Lᵀ         refused where it is not definite
//!     asymmetric W, dense    A + δI = P L U        regular where W + Wᵀ + 2R ⪰ 0, for then x·(A + δI)x ≥ δ‖x‖²
//!     blocks                 A + δI = L U          contact by contact, in an order of least degree
//! ```
//! No dense matrix is made of blocks.

use super::block_elimination::{BlockElimination, Slopes};
use super::{definite, watch};
use crate::operator::BlockSparse;
use crate::problem::ContactProblem;
use crate::tolerance::solvers::SYMMETRY;
use moreau_exact::{Error, Result};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn, LU, Matrix3};

/// A of a problem, every entry times one mass.
pub(super) struct ShiftedOperator<'a> {
    problem: &'a ContactProblem,
    mass: f64,
    stored: Stored<'a>,
}

enum Stored<'a> {
    /// All entries of A, in units of the mass, and whether they are symmetric.
    Dense(DMatrix<f64>, bool),
    /// The blocks, and whether they are symmetric to the last bit.
    Blocks(&'a BlockSparse, bool),
}

/// A + δI, factored.
pub(super) enum Shifted {
    Symmetric(Cholesky<f64, Dyn>),
    Any(LU<f64, Dyn, Dyn>),
    Blocks(Box<BlockElimination>),
}

impl<'a> ShiftedOperator<'a> {
    /// A of the problem times its own mass, the reciprocal of its mean diagonal entry \[kg\].
    ///
    /// # Errors
    /// Where W is dense and there is no room for another one.
    pub(super) fn new(problem: &'a ContactProblem) -> Result<Self> {
        let trace: f64 = (0..problem.rows()).map(|row| problem.entry(row, row) + super::compliance(problem, row)).sum();
        let mass = if trace > 0.0 { problem.rows() as f64 / trace } else { 1.0 };
        let stored = match problem.delassus().blocks() {
            Some(blocks) => Stored::Blocks(blocks, problem.asymmetry() == 0.0),
            None => Stored::Dense(problem.law_delassus()? * mass, problem.asymmetry() <= SYMMETRY),
        };
        Ok(ShiftedOperator { problem, mass, stored })
    }

    /// What every entry was multiplied with \[kg\].
    pub(super) fn mass(&self) -> f64 {
        self.mass
    }

    /// A x.
    pub(super) fn apply(&self, x: &DVector<f64>) -> DVector<f64> {
        match &self.stored {
            Stored::Dense(matrix, _) => matrix * x,
            Stored::Blocks(..) => super::parts::law_product(self.problem, x) * self.mass,
        }
    }

    /// A + δI, factored in the name of a solver.
    ///
    /// # Errors
    /// [`Error::Solver`] where a symmetric W is not semidefinite, or a system is singular.
    pub(super) fn shifted(&self, solver: &str, shift: f64) -> Result<Shifted> {
        match &self.stored {
            Stored::Dense(matrix, symmetric) => {
                let mut shifted = matrix.clone();
                (0..shifted.nrows()).for_each(|k| shifted[(k, k)] += shift);
                if *symmetric {
                    let factor = definite::factor(shifted);
                    return factor.map(Shifted::Symmetric).ok_or_else(|| if watch::was_over() { left(solver) } else { indefinite(solver) });
                }
                let factor = shifted.lu();
                if factor.is_invertible() { Ok(Shifted::Any(factor)) } else { Err(indefinite(solver)) }
            }
            Stored::Blocks(blocks, symmetric) => {
                let mut factor = BlockElimination::default();
                if factor.factor(blocks, &self.slopes(shift), *symmetric) {
                    Ok(Shifted::Blocks(Box::new(factor)))
                } else if factor.was_left() {
                    Err(left(solver))
                } else {
                    Err(indefinite(solver))
                }
            }
        }
    }

    /// The x with (A + δI) x = b.
    pub(super) fn solve(&self, factor: &mut Shifted, right_side: &DVector<f64>) -> DVector<f64> {
        match (factor, &self.stored) {
            (Shifted::Symmetric(factor), _) => factor.solve(right_side),
            (Shifted::Any(factor), _) => factor.solve(right_side).expect("it was found to be invertible"),
            (Shifted::Blocks(factor), Stored::Blocks(blocks, _)) => factor.solve(blocks, right_side),
            (Shifted::Blocks(_), Stored::Dense(..)) => unreachable!("blocks are factored where W is stored so"),
        }
    }

    /// B = mass and A_k = mass R_k + δ of every contact.
    fn slopes(&self, shift: f64) -> Vec<Slopes> {
        let rows = self.problem.rows_per_contact();
        let own = |k: usize| {
            let softness = |i: usize| if i < rows { super::compliance(self.problem, k * rows + i) } else { 0.0 };
            Matrix3::from_fn(|i, j| if i == j { self.mass * softness(i) + shift } else { 0.0 })
        };
        (0..self.problem.contacts()).map(|k| Slopes { own: own(k), through: Matrix3::identity() * self.mass, inverse: None }).collect()
    }
}

fn left(solver: &str) -> Error {
    Error::limit(solver, "left a system unfactored for want of memory or time; allow more, or use pgs")
}

fn indefinite(solver: &str) -> Error {
    Error::refused(solver, "needs a positive semidefinite W + R")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operator::Sparse;
    use crate::problem::{Compliance, Coordinates};

    /// Three contacts in a row, of which neighbours meet, with a compliance; asymmetric where asked.
    fn dense(asymmetry: f64) -> ContactProblem {
        let near = |i: usize, j: usize| (i / 3).abs_diff(j / 3) <= 1;
        let mut w = DMatrix::from_fn(9, 9, |i, j| {
            if i == j {
                4.0
            } else if near(i, j) {
                ((i + j) % 3) as f64 / 8.0
            } else {
                0.0
            }
        });
        w[(0, 3)] += asymmetry;
        let diagonal = DVector::from_fn(9, |k, _| k as f64 / 16.0);
        ContactProblem::new(w, DVector::from_element(9, -1.0))
            .friction(vec![0.5; 3])
            .compliance(Compliance { coordinates: Coordinates::Contact, diagonal })
            .build()
            .unwrap()
    }

    #[test]
    fn dense_and_blocks_solve_the_same_system_symmetric_or_not() {
        let right = DVector::from_fn(9, |k, _| k as f64 - 4.0);
        for asymmetry in [0.0, 0.25] {
            let one = dense(asymmetry);
            let blocks = BlockSparse::from_sparse(&Sparse::of(one.dense()), 3).unwrap();
            let other = one.clone().into_builder().delassus(blocks).build().unwrap();
            for problem in [&one, &other] {
                let operator = ShiftedOperator::new(problem).unwrap();
                let x = operator.solve(&mut operator.shifted("test", 0.5).unwrap(), &right);
                let left = operator.apply(&x) + &x * 0.5;
                assert!((left - &right).amax() <= moreau_exact::tolerance::rounding(64, 8.0), "asymmetry {asymmetry}");
                let full = problem.law_velocity(&x) - problem.free_velocity();
                assert!((operator.apply(&x) - full * operator.mass()).amax() <= moreau_exact::tolerance::rounding(64, 8.0));
            }
        }
    }

    #[test]
    fn an_indefinite_symmetric_operator_is_refused() {
        let indefinite = DMatrix::from_row_slice(2, 2, &[1.0, 100.0, 100.0, 1.0]);
        let problem = ContactProblem::new(indefinite, DVector::zeros(2)).rows_per_contact(2).friction(vec![0.5]).build().unwrap();
        assert!(ShiftedOperator::new(&problem).unwrap().shifted("test", 1.0).is_err());
    }
}
