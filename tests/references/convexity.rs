//! A soft convex step problem in the coordinates of its generators: min ½xᵀAx + bᵀx over a cone, A = EᵀWE + R.
//!
//! E = 1 for second-order cones (x = r); its columns are the edges n + μDⱼ for pyramids (x = f, r = E f).
//!
//! # How far an answer can be from the solution
//! With a preconditioner P = diag(ρ) that is constant on each cone, the natural map F(x) = x − Π(x − P(Ax + b)) of a strongly monotone
//! problem bounds the error in the norm of P⁻¹ (Facchinei and Pang, Proposition 6.3.1):
//! ```text
//!     ‖x − x*‖ ≤ (1 + L)/m · ‖F(x)‖ ,      m, L = smallest and largest eigenvalue of P^½ A P^½ .
//! ```

use moreau::certificate::natural_map;
use moreau::cones::polyhedral::edge;
use moreau::problem::{ContactProblem, Law, Solution};
use nalgebra::{DMatrix, DVector};

/// The problem in generator coordinates, with what its error bound needs.
pub struct Generators {
    /// E, rows × generators.
    pub generators: DMatrix<f64>,
    /// ρ of the contact a generator belongs to \[kg\].
    rho: DVector<f64>,
    /// (1 + L)/m.
    pub condition: f64,
}

impl Generators {
    /// The generators of a problem with compliance; `None` for a hard problem, whose solution need not be unique.
    pub fn of(problem: &ContactProblem) -> Option<Self> {
        let compliance = problem.compliance()?.diagonal.clone();
        let generators = match problem.law() {
            Law::PolyhedralAssociated { directions } => edges(problem, directions),
            _ => DMatrix::identity(problem.rows(), problem.rows()),
        };
        let per_contact = generators.ncols() / problem.contacts();
        let scales = natural_map::scales(problem);
        let rho = DVector::from_fn(generators.ncols(), |j, _| scales[j / per_contact]);
        let operator = generators.tr_mul(problem.dense()) * &generators + DMatrix::from_diagonal(&compliance);
        let root = DMatrix::from_diagonal(&rho.map(f64::sqrt));
        let scaled = &root * operator * &root;
        let eigenvalues = ((&scaled + scaled.transpose()) * 0.5).symmetric_eigenvalues();
        let condition = (1.0 + eigenvalues.max()) / eigenvalues.min();
        Some(Generators { generators, rho, condition })
    }

    /// x of an answer: its edge impulses for pyramids, its impulses otherwise.
    pub fn coordinates(&self, answer: &Solution) -> DVector<f64> {
        answer.beta.clone().unwrap_or_else(|| answer.impulse.clone())
    }

    /// ‖x − x'‖ in the norm of P⁻¹, in kg^½·m/s.
    pub fn distance(&self, one: &Solution, other: &Solution) -> f64 {
        let difference = self.coordinates(one) - self.coordinates(other);
        difference.iter().zip(self.rho.iter()).map(|(x, rho)| x * x / rho).sum::<f64>().sqrt()
    }

    /// A natural map measured in N·s, at most this much in the norm of P⁻¹.
    pub fn weigh(&self, natural_map: f64) -> f64 {
        natural_map / self.rho.min().sqrt()
    }

    /// max ρ \[kg\].
    pub fn largest_scale(&self) -> f64 {
        self.rho.max()
    }
}

fn edges(problem: &ContactProblem, directions: usize) -> DMatrix<f64> {
    let mut generators = DMatrix::zeros(problem.rows(), directions * problem.contacts());
    for contact in 0..problem.contacts() {
        for j in 0..directions {
            let column = edge(j, directions, problem.friction()[contact]);
            (0..problem.rows_per_contact())
                .for_each(|row| generators[(problem.rows_per_contact() * contact + row, directions * contact + j)] = column[row]);
        }
    }
    generators
}
