//! Projected successive over-relaxation (PSOR): contact after contact one projected gradient step,
//!
//! ```text
//!     r_k ← P_K( r_k − (ω/λ_k) ŷ_k ) ,      ŷ_k = y_k, or y_k + μ‖y_kt‖n for Coulomb's law,   λ_k = λ_max(A_kk),   A = W + R ,
//! ```
//! with the newest r in y = A r + u_free + shift. For symmetric A and a convex law every step lowers ½rᵀAr + (u_free+shift)ᵀr by at least
//! λ_k(1/ω − ½)‖Δr_k‖², so that it converges for 0 < ω < 2; beyond, a single contact already overshoots for ever. Block Gauss–Seidel
//! ([`super::ProjectedGaussSeidel`]) solves each contact instead of stepping once.
//!
//! `DIFFERENCE` Project Chrono divides by the mean of the diagonal of A_kk, not by λ_k. The two are the same where A_kk is a multiple of
//! the identity; where λ_k exceeds twice the mean, as in diag(1, 1/10, 1/10), Chrono's step with its default ω = 1 is beyond 2 and swings.

use super::stopping::Stopping;
use super::{ContactSolver, watch};
use crate::certificate::natural_map;
use crate::cones::second_order;
use crate::operator::passes;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::solvers as tolerance;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Projected over-relaxation for the frictionless, Coulomb and associated laws.
///
/// # Source
/// Tasora, Anitescu, *A matrix-free cone complementarity approach for solving large-scale, nonsmooth, rigid body dynamics* (2011).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProjectedOverRelaxation {
    /// ω, between 0 and 2.
    pub relaxation: f64,
    /// Sweep limit.
    pub sweeps: usize,
    /// Relative natural map at which it stops.
    pub tolerance: f64,
}

impl Default for ProjectedOverRelaxation {
    fn default() -> Self {
        ProjectedOverRelaxation { relaxation: 1.0, sweeps: tolerance::SWEEPS, tolerance: tolerance::STOP }
    }
}

const NAME: &str = "psor";

impl ContactSolver for ProjectedOverRelaxation {
    fn name(&self) -> &'static str {
        NAME
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        Some(Box::new(Self { tolerance: relative, ..*self }))
    }

    fn iteration_limit(&self) -> Option<usize> {
        Some(self.sweeps)
    }

    fn takes(&self, law: Law, _rows: usize, _symmetric: bool) -> bool {
        law.directions().is_none()
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        if problem.law().directions().is_some() {
            return Err(Error::refused(NAME, format!("does not solve the law `{}`", problem.law().name())));
        }
        let rows = problem.rows_per_contact();
        let steps = step_lengths(problem, self.relaxation)?;
        let mut stopping = Stopping::new(problem, self.tolerance);
        let mut impulse = super::start_of_use(problem, warm_start)?;
        let mut done = 0;
        loop {
            // afresh in every sweep: column updates collect rounding
            let mut law_velocity = problem.law_velocity(&impulse);
            if done == self.sweeps || stopping.holds(&impulse, &law_velocity) {
                break;
            }
            for (k, &step) in steps.iter().enumerate().take_while(|_| !watch::is_over()) {
                let range = k * rows..(k + 1) * rows;
                let mut corrected = law_velocity.as_slice()[range.clone()].to_vec();
                natural_map::correct(problem.law(), problem.friction()[k], &mut corrected);
                let mut new: Vec<f64> = range.clone().zip(&corrected).map(|(row, y)| impulse[row] - step * y).collect();
                second_order::project(&mut new, super::cone_friction(problem, k));
                for (row, value) in range.zip(new) {
                    let change = value - impulse[row];
                    problem.add_column(row, change, law_velocity.as_mut_slice());
                    law_velocity[row] += super::compliance(problem, row) * change;
                    impulse[row] = value;
                }
            }
            passes::note();
            done += 1;
        }
        let velocity = problem.velocity(&impulse);
        super::finite(Solution::new(NAME, impulse, velocity, done))
    }
}

/// ω/λ_max(A_kk) of every contact \[kg\]; without friction only the normal row counts.
fn step_lengths(problem: &ContactProblem, relaxation: f64) -> Result<Vec<f64>> {
    let rows = problem.rows_per_contact();
    let size = if problem.law() == Law::Frictionless { 1 } else { rows };
    let step = |k: usize| {
        let mut block = problem.diagonal_block(k).resize(size, size, 0.0);
        (0..size).for_each(|row| block[(row, row)] += super::compliance(problem, k * rows + row));
        let largest = ((&block + block.transpose()) * 0.5).symmetric_eigenvalues().max();
        let reason =
            || format!("contact {k} moves nothing: its block W_kk + R_kk has no positive eigenvalue; remove it or give it compliance");
        if largest > 0.0 { Ok(relaxation / largest) } else { Err(Error::refused(NAME, reason())) }
    };
    (0..problem.contacts()).map(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use nalgebra::DMatrix;

    /// One contact that arrives at 1 m/s with W = diag(1, 1/10, 1/10).
    fn slender() -> ContactProblem {
        ContactProblem::new(DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 0.1, 0.1])), DVector::from_vec(vec![-1.0, 0.0, 0.0]))
            .name("slender")
            .law(Law::Associated)
            .friction(vec![0.5])
            .build()
            .unwrap()
    }

    #[test]
    fn it_converges_below_two_and_swings_with_the_mean_of_the_diagonal_as_chrono_takes_it() {
        let problem = slender();
        let passes = |relaxation: f64| {
            let solver = ProjectedOverRelaxation { relaxation, sweeps: 10_000, ..Default::default() };
            let solution = solver.solve(&problem, None).unwrap();
            residuals(&problem, &solution).unwrap().is_solution(tolerance::STOP)
        };
        assert!([0.1, 1.0, 1.9].into_iter().all(passes));
        // ω = 1 over the mean 2/5 is ω = 5/2 over λ_max = 1: r jumps between 0 and 5/2 around the answer 1
        assert!(!passes(2.5));
    }
}
