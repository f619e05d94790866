//! Semi-analytic primal: the associated law with compliance R > 0 solved in velocities, without constraints.
//!
//! ```text
//!     K ∋ r ⟂ y = u + shift + R r ∈ K*   ⇔   r = argmin_{K} ½ ‖r − ŷ‖²_R ,   ŷ = −R⁻¹ (u + shift) ,
//!     ℓ(u) = ½ ‖r(u)‖²_R ,   min ½ ‖v − v_free‖²_M + Σ ℓ_i(u_i) .
//! ```
//! The projection is analytic because R_t is the same for both tangents. With z = R^½ ŷ it is the Euclidean one on K with μ̃ = μ
//! √(R_t/R_n), so that
//! ```text
//!     ‖ŷ_t‖ ≤ μ ŷ_n                 sticks      r = ŷ
//!     ŷ_n ≤ −μ̂ ‖ŷ_t‖               opens       r = 0                                             μ̂ = μ R_t/R_n
//!     otherwise                     slips       r_n = (ŷ_n + μ̂ ‖ŷ_t‖)/(1 + μ̃²) ,  r_t = μ r_n ŷ_t/‖ŷ_t‖ .
//! ```
//! # Source
//! Castro, Permenter and Han, *An unconstrained convex formulation of compliant contact* (2022), §III and §IV; Drake's `SapSolver`.

use super::primal_newton::{Potential, minimise};
use moreau_contact::cones::{projection_jacobian, second_order};
use moreau_contact::contact::{Inertia, Jacobian, Mass};
use moreau_contact::problem::{Compliance, ContactProblem, Coordinates, Dynamics, Law, Solution};
use moreau_contact::solvers::{ContactSolver, SolverEntry, parts};
use moreau_exact::tolerance::rounding;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Newton's method on the primal of a compliant convex step, with exact line search.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SemiAnalyticPrimal;

const NAME: &str = "sap";

/// Its line in a table of solvers.
pub const SOLVER: SolverEntry = SolverEntry { name: NAME, default: || Box::new(SemiAnalyticPrimal), limited: None };

impl ContactSolver for SemiAnalyticPrimal {
    fn name(&self) -> &'static str {
        NAME
    }

    fn takes(&self, law: Law, _rows: usize, symmetric: bool) -> bool {
        parts::takes_convex(law, symmetric)
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        parts::require_convex(NAME, problem)?;
        let potential = Projection::of(problem)?;
        let (mass, jacobian) = mass_and_rows(problem);
        let start = parts::start(problem, warm_start)?;
        let inertia = Inertia::of(mass).map_err(|_| Error::refused(NAME, "needs a positive definite mass matrix"))?;
        let start = inertia.solve(&jacobian.tr_mul(&start));
        let minimum = minimise(NAME, &inertia, &jacobian, problem.free_velocity(), &potential, start)?;
        let velocity = problem.velocity(&minimum.impulse);
        parts::finite(Solution::new(NAME, minimum.impulse, velocity, minimum.iterations))
    }
}

/// M and H of the problem, as one body; without them 1 and W^½, which give the same W.
fn mass_and_rows(problem: &ContactProblem) -> (Mass, Jacobian) {
    let rows = problem.rows_per_contact();
    if let Some(Dynamics { mass, jacobian }) = problem.dynamics() {
        return (Mass::Dense(mass.clone()), Jacobian::from_dense(jacobian, rows));
    }
    let eigen = ((problem.dense() + problem.dense().transpose()) * 0.5).symmetric_eigen();
    let root = DMatrix::from_diagonal(&eigen.eigenvalues.map(|value| value.max(0.0).sqrt()));
    (Mass::Diagonal(DVector::from_element(problem.rows(), 1.0)), Jacobian::from_dense(&(eigen.eigenvectors * root), rows))
}

/// ℓ of every contact, by its scaled cone.
struct Projection<'a> {
    problem: &'a ContactProblem,
    /// (√R_n, √R_t, μ̃) per contact.
    scaled: Vec<[f64; 3]>,
}

impl<'a> Projection<'a> {
    fn of(problem: &'a ContactProblem) -> Result<Self> {
        let Some(Compliance { coordinates: Coordinates::Contact, diagonal }) = problem.compliance() else {
            return Err(Error::refused(NAME, "needs a compliance R > 0 in contact coordinates"));
        };
        let scaled = |(contact, part): (usize, &[f64])| {
            let friction = if problem.law() == Law::Frictionless { 0.0 } else { problem.friction()[contact] };
            // without friction no tangential row carries an impulse
            let tangential = if friction > 0.0 { part[1] } else { part[0] };
            if part[0] <= 0.0 || tangential <= 0.0 {
                return Err(Error::refused(NAME, format!("needs R > 0, and contact {contact} has R = {part:?}")));
            }
            if friction > 0.0 && part[1..].iter().any(|other| (other - tangential).abs() > rounding(4, tangential)) {
                return Err(Error::refused(NAME, format!("needs one R_t for both tangents, and contact {contact} has R = {part:?}")));
            }
            Ok([part[0].sqrt(), tangential.sqrt(), friction * (tangential / part[0]).sqrt()])
        };
        let scaled = diagonal.as_slice().chunks(problem.rows_per_contact()).enumerate().map(scaled).collect::<Result<Vec<_>>>()?;
        Ok(Projection { problem, scaled })
    }

    /// √R of a row of the contact.
    fn root(&self, contact: usize, row: usize) -> f64 {
        self.scaled[contact][usize::from(row > 0)]
    }

    /// z = −R^{−½} (u + shift).
    fn point(&self, contact: usize, velocity: &[f64]) -> Vec<f64> {
        let first = contact * self.problem.rows_per_contact();
        let entry = |(row, u): (usize, &f64)| -(u + self.problem.shift()[first + row]) / self.root(contact, row);
        velocity.iter().enumerate().map(entry).collect()
    }
}

impl Potential for Projection<'_> {
    fn impulse(&self, contact: usize, velocity: &[f64]) -> DVector<f64> {
        let mut point = self.point(contact, velocity);
        second_order::project(&mut point, self.scaled[contact][2]);
        DVector::from_fn(point.len(), |row, _| point[row] / self.root(contact, row))
    }

    fn curvature(&self, contact: usize, velocity: &[f64]) -> DMatrix<f64> {
        let jacobian = projection_jacobian(&self.point(contact, velocity), self.scaled[contact][2]);
        DMatrix::from_fn(velocity.len(), velocity.len(), |i, j| jacobian[(i, j)] / (self.root(contact, i) * self.root(contact, j)))
    }
}

#[cfg(test)]
#[path = "semi_analytic_primal_tests.rs"]
mod tests;
