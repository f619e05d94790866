//! Accelerated projected gradient descent (APGD) on the convex step problem
//!
//! ```text
//!     min f(r) = ½ rᵀA r + qᵀr   over r ∈ K ,      A = W + R ,  q = u_free + shift ,
//!     r⁺ = P_K(p − ∇f(p)/L) ,   p⁺ = r⁺ + β (r⁺ − r) ,   L ≥ λ_max(A) .
//! ```
//! β = 0 is the projected gradient method. Nesterov's β gives the faster bound. With R = ‖r₀ − r*‖,
//! ```text
//!     plain      f(r_k) − f* ≤ L R² / (2k)
//!     Nesterov   f(r_k) − f* ≤ 2 L R² / (k + 1)²
//! ```
//! for every solution r*. These are bounds, not slopes: most problems converge much faster. Restarting the momentum when it points
//! uphill keeps the descent of strongly convex problems linear; it is the default for solving.
//!
//! Only products A p are formed, dense or by blocks. Where W is asymmetric by a little, as in files that hold few digits, A p + q is no
//! gradient: the iteration r⁺ = P_K(r − (A r + q)/L) has the right fixed points all the same, and whether it got to one is for the
//! certificate to say. The bounds hold for a symmetric W alone.

use super::ContactSolver;
use super::stopping::Stopping;
use super::watch;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::solvers as tolerance;
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// What is done with the last change r⁺ − r.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Momentum {
    /// Nothing: the projected gradient method.
    Plain,
    /// Nesterov's momentum β = (t − 1)/t⁺, t⁺ = (1 + √(1 + 4t²))/2.
    Nesterov,
    /// Nesterov's momentum that restarts with t = 1 whenever it points uphill, (p − r⁺)·(r⁺ − r) > 0.
    Restarted,
}

/// Projected gradient descent for the frictionless and associated laws, with or without momentum; W must be symmetric, or nearly so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AcceleratedProjectedGradient {
    /// The momentum.
    pub momentum: Momentum,
    /// Iteration limit.
    pub iterations: usize,
    /// Relative natural map at which it stops.
    pub tolerance: f64,
}

impl Default for AcceleratedProjectedGradient {
    fn default() -> Self {
        AcceleratedProjectedGradient { momentum: Momentum::Restarted, iterations: tolerance::GRADIENT_STEPS, tolerance: tolerance::STOP }
    }
}

const NAME: &str = "apgd";

impl ContactSolver for AcceleratedProjectedGradient {
    fn name(&self) -> &'static str {
        NAME
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        Some(Box::new(Self { tolerance: relative, ..*self }))
    }

    fn iteration_limit(&self) -> Option<usize> {
        Some(self.iterations)
    }

    fn takes(&self, law: Law, _rows: usize, symmetric: bool) -> bool {
        super::parts::takes_convex(law, symmetric)
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        self.solve_observed(problem, warm_start, |_, _| {})
    }
}

impl AcceleratedProjectedGradient {
    /// Like [`ContactSolver::solve`], showing every iterate: `observe(k, r_k)` for k = 1, 2, ….
    ///
    /// # Errors
    /// [`moreau_exact::Error::Solver`] for another law or a W that is far from symmetric.
    pub fn solve_observed(
        &self,
        problem: &ContactProblem,
        warm_start: Option<&DVector<f64>>,
        mut observe: impl FnMut(usize, &DVector<f64>),
    ) -> Result<Solution> {
        super::parts::require_nearly_convex(NAME, problem)?;
        let q = problem.free_velocity() + problem.shift();
        let product_of = |impulse: &DVector<f64>| super::parts::law_product(problem, impulse);
        let step = step_length(problem);
        let mut stopping = Stopping::new(problem, self.tolerance);

        let mut impulse = super::start_of_use(problem, warm_start)?;
        let mut product = product_of(&impulse);
        let (mut point, mut point_product) = (impulse.clone(), product.clone());
        let mut next = impulse.clone();
        let mut t: f64 = 1.0;
        let mut done = 0;
        while done < self.iterations && !stopping.holds(&impulse, &(&product + &q)) {
            next.copy_from(&point);
            next.axpy(-step, &point_product, 1.0);
            next.axpy(-step, &q, 1.0);
            super::project(problem, &mut next);
            let mut next_product = product_of(&next);
            let uphill = (0..next.len()).map(|k| (point[k] - next[k]) * (next[k] - impulse[k])).sum::<f64>() > 0.0;
            let beta = match self.momentum {
                Momentum::Plain => 0.0,
                Momentum::Restarted if uphill => {
                    t = 1.0;
                    0.0
                }
                Momentum::Nesterov | Momentum::Restarted => {
                    let longer = 0.5 * (1.0 + (1.0 + 4.0 * t * t).sqrt());
                    let beta = (t - 1.0) / longer;
                    t = longer;
                    beta
                }
            };
            extrapolate(&mut point, &next, &impulse, beta);
            extrapolate(&mut point_product, &next_product, &product, beta);
            std::mem::swap(&mut impulse, &mut next);
            std::mem::swap(&mut product, &mut next_product);
            done += 1;
            observe(done, &impulse);
        }
        let velocity = problem.velocity(&impulse);
        super::finite(Solution::new(NAME, impulse, velocity, done))
    }
}

/// f(r) = ½ rᵀ(W + R)r + (u_free + shift)ᵀr \[J\], what the frictionless and associated laws minimise over K.
pub fn objective(problem: &ContactProblem, impulse: &DVector<f64>) -> f64 {
    let data = problem.free_velocity() + problem.shift();
    0.5 * impulse.dot(&(problem.law_velocity(impulse) + data))
}

/// An upper bound of λ_max(A) for symmetric A: the smaller of the Frobenius norm and the largest absolute row sum \[1/kg\].
pub fn largest_eigenvalue_bound(operator: &DMatrix<f64>) -> f64 {
    let rows = operator.row_iter().map(|row| row.lp_norm(1)).fold(0.0, f64::max);
    rows.min(operator.norm())
}

/// 1/L \[kg\]: L is the smaller of the Frobenius norm and the largest absolute column sum of A, which bound ‖A‖₂ where A is symmetric.
/// Where many contacts share a body the columns take longer than all iterations: who is ended meanwhile makes no step with what was found.
pub(super) fn step_length(problem: &ContactProblem) -> f64 {
    let (mut largest, mut squares) = (0.0_f64, 0.0);
    for column in (0..problem.rows()).take_while(|_| !watch::is_over()) {
        let (mut sum, mut diagonal) = (0.0, super::compliance(problem, column));
        problem.delassus().for_each_in_column(column, |row, w| {
            let entry = if row == column { w + std::mem::take(&mut diagonal) } else { w };
            sum += entry.abs();
            squares += entry * entry;
        });
        largest = largest.max(sum + diagonal);
        squares += diagonal * diagonal;
    }
    let bound = largest.min(squares.sqrt());
    if bound > 0.0 { 1.0 / bound } else { 1.0 }
}

/// point ← new + β (new − old).
fn extrapolate(point: &mut DVector<f64>, new: &DVector<f64>, old: &DVector<f64>, beta: f64) {
    point.copy_from(new);
    point.axpy(beta, new, 1.0);
    point.axpy(-beta, old, 1.0);
}
