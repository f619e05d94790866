//! The alternating direction method of multipliers (ADMM) with a proximal term, for convex and for Coulomb's law
//!
//! ```text
//!     p ← P_K(x − z/ρ) ,                                                    impulse in the cone
//!     x ← argmin ½xᵀA x + (q + s)ᵀx − zᵀ(x − p) + ½ρ‖x − p‖² + ½η‖x − x₋‖² ,   impulse of the dynamics
//!     z ← z − ρ (x − p) ,                                                   velocity: at the solution z = A x + q + s
//! ```
//! with A = W + R and q = u_free + shift. The middle line is one system with the matrix A + (ρ + η)I, which is definite whatever A is. For
//! Coulomb's law s = μ‖z_t‖n is de Saxcé's correction of the last z, contact by contact; for the convex laws s = 0. The answer is p.
//!
//! **ρ by itself.** With the primal residual ‖x − p‖ \[N·s\] and the dual one max(ρ, η)‖x − x₋‖ \[m/s\], ρ is multiplied by √(primal/dual)
//! as soon as one exceeds ten times the other. Everything is measured in units in which the mean diagonal entry of A is 1 and so is the
//! largest entry of q, so that a change of units changes nothing. For a convex law and ρ held fixed the method converges from anywhere; to
//! that end ρ is held longer and longer, the n-th value for n iterations. For Coulomb's law nothing is promised: the certificate decides.
//!
//! `DIFFERENCE` Pinocchio 4.1.0 writes τρ for ρ (τ = ½), may change ρ in every iteration, and has no units: its η = 10⁻⁶ and the bounds of
//! ρ are numbers. Project Chrono has the same iteration with the proximal term on p and ρ balanced every six iterations.

use super::ContactSolver;
use super::stopping::Stopping;
use crate::certificate::natural_map;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::solvers as tolerance;
use moreau_exact::{Error, Result};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Alternating directions for the frictionless, associated and Coulomb laws; W must be symmetric.
///
/// # Source
/// Carpentier, Le Lidec, Montaut, *From compliant to rigid contact simulation: a unified and efficient approach* (2024); Pinocchio 4.1.0,
/// `ADMMConstraintSolver`; for the convex law Boyd and others, *Distributed optimization and statistical learning via ADMM* (2011).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlternatingDirections {
    /// Iteration limit.
    pub iterations: usize,
    /// Relative natural map at which it stops.
    pub tolerance: f64,
}

impl Default for AlternatingDirections {
    fn default() -> Self {
        AlternatingDirections { iterations: tolerance::ALTERNATIONS, tolerance: tolerance::STOP }
    }
}

const NAME: &str = "admm";

/// The problem in its own units, and the factorised matrix A + (ρ + η)I.
struct Scaled<'a> {
    problem: &'a ContactProblem,
    operator: DMatrix<f64>,
    free: DVector<f64>,
    penalty: f64,
    factor: Cholesky<f64, Dyn>,
}

impl ContactSolver for AlternatingDirections {
    fn name(&self) -> &'static str {
        NAME
    }

    fn takes(&self, law: Law, _rows: usize, symmetric: bool) -> bool {
        symmetric && law.directions().is_none()
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        if problem.law().directions().is_some() {
            return Err(Error::refused(NAME, format!("does not solve the law `{}`; use `lemke`", problem.law().name())));
        }
        super::require_symmetry(NAME, problem)?;
        let start = super::start(problem, warm_start)?;
        let data = problem.law_velocity(&DVector::zeros(problem.rows()));
        let operator = problem.law_delassus()?;
        let mass = if operator.trace() > 0.0 { problem.rows() as f64 / operator.trace() } else { 1.0 };
        let speed = if data.amax() > 0.0 { data.amax() } else { 1.0 };
        let unit = mass * speed;
        let mut stopping = Stopping::new(problem, self.tolerance);
        let mut scaled = Scaled::new(problem, operator * mass, data / speed)?;
        let mut x = start / unit;
        let mut z = scaled.corrected(&(&scaled.operator * &x + &scaled.free));
        let mut cone = x.clone();
        super::project(problem, &mut cone);
        let (mut done, mut held, mut changes) = (0, 0, 0);
        loop {
            if done == self.iterations || done % tolerance::LOOK == 0 {
                let impulse = &cone * unit;
                if done == self.iterations || stopping.holds(&impulse, &problem.law_velocity(&impulse)) {
                    let velocity = problem.velocity(&impulse);
                    return super::finite(Solution::new(NAME, impulse, velocity, done));
                }
            }
            let before = x.clone();
            (cone, x) = scaled.alternate(&x, &z);
            z -= (&x - &cone) * scaled.penalty;
            (done, held) = (done + 1, held + 1);
            let residuals = ((&x - &cone).amax(), scaled.penalty.max(tolerance::ADMM_PROXIMAL) * (&x - before).amax());
            if held > changes && scaled.balance(residuals)? {
                (held, changes) = (0, changes + 1);
            }
        }
    }
}

impl<'a> Scaled<'a> {
    fn new(problem: &'a ContactProblem, operator: DMatrix<f64>, free: DVector<f64>) -> Result<Self> {
        let factor = factorise(&operator, 1.0)?;
        Ok(Scaled { problem, operator, free, penalty: 1.0, factor })
    }

    /// p and x of the module's equations.
    fn alternate(&self, x: &DVector<f64>, z: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let mut cone = x - z / self.penalty;
        super::project(self.problem, &mut cone);
        // −(q + s) + z + ρ p + η x₋, where s = corrected − z
        let right = z * 2.0 - &self.free - self.corrected(z) + &cone * self.penalty + x * tolerance::ADMM_PROXIMAL;
        let next = self.factor.solve(&right);
        (cone, next)
    }

    /// z + μ‖z_t‖n for Coulomb's law, z otherwise.
    fn corrected(&self, z: &DVector<f64>) -> DVector<f64> {
        let mut corrected = z.clone();
        for (k, part) in corrected.as_mut_slice().chunks_exact_mut(self.problem.rows_per_contact()).enumerate() {
            natural_map::correct(self.problem.law(), self.problem.friction()[k], part);
        }
        corrected
    }

    /// Changes ρ where the residuals ask for it; returns whether it did.
    fn balance(&mut self, (primal, dual): (f64, f64)) -> Result<bool> {
        if primal <= tolerance::BALANCE * dual && dual <= tolerance::BALANCE * primal {
            return Ok(false);
        }
        let penalty = (self.penalty * (primal / dual).sqrt()).clamp(tolerance::PENALTIES.0, tolerance::PENALTIES.1);
        if !penalty.is_finite() || penalty == self.penalty {
            return Ok(false);
        }
        self.factor = factorise(&self.operator, penalty)?;
        self.penalty = penalty;
        Ok(true)
    }
}

fn factorise(operator: &DMatrix<f64>, penalty: f64) -> Result<Cholesky<f64, Dyn>> {
    let mut damped = operator.clone();
    (0..damped.nrows()).for_each(|k| damped[(k, k)] += penalty + tolerance::ADMM_PROXIMAL);
    Cholesky::new(damped).ok_or_else(|| Error::refused(NAME, "needs a positive semidefinite W + R; use `pgs`"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Law;

    fn block(law: Law) -> ContactProblem {
        ContactProblem::new(DMatrix::identity(2, 2), DVector::from_vec(vec![-0.8, 0.6]))
            .name("block")
            .law(law)
            .rows_per_contact(2)
            .friction(vec![0.5])
            .build()
            .unwrap()
    }

    #[test]
    fn one_switch_tells_coulomb_s_slide_from_the_associated_hop() {
        // 3-4-5 slope, μ = ½: Coulomb u = (0, 0.6 − ½·0.8); associated r = 0.88(1, −½), u = (0.08, 0.16)
        for (law, expected) in [(Law::Coulomb, [0.0, 0.2]), (Law::Associated, [0.08, 0.16])] {
            let answer = AlternatingDirections::default().solve(&block(law), None).unwrap();
            assert!((answer.velocity - DVector::from_row_slice(&expected)).amax() <= 2.0 * tolerance::STOP, "{law:?}");
        }
    }

    #[test]
    fn units_of_mass_and_time_change_nothing() {
        let problem = block(Law::Coulomb);
        let (delassus, free_velocity) = (problem.dense() * 2f64.powi(60), problem.free_velocity() * 2f64.powi(-40));
        let other = problem.clone().into_builder().delassus(delassus).free_velocity(free_velocity).build().unwrap();
        let [one, two] = [&problem, &other].map(|problem| AlternatingDirections::default().solve(problem, None).unwrap());
        // powers of two: the same numbers, bit for bit
        assert_eq!(one.iterations, two.iterations);
        assert_eq!(one.impulse * 2f64.powi(-100), two.impulse);
    }

    #[test]
    fn an_indefinite_operator_is_refused_by_name() {
        let indefinite = DMatrix::from_row_slice(2, 2, &[1.0, 100.0, 100.0, 1.0]);
        let problem = block(Law::Associated).into_builder().delassus(indefinite).build().unwrap();
        let message = AlternatingDirections::default().solve(&problem, None).unwrap_err().to_string();
        assert!(message.contains("`admm`") && message.contains("semidefinite"), "{message}");
    }
}
