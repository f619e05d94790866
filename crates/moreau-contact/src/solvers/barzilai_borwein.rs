//! The projected gradient method with step lengths of Barzilai and Borwein (BB) on the convex step problem
//!
//! ```text
//!     min f(r) = ½ rᵀA r + qᵀr   over r ∈ K ,      A = W + R ,  q = u_free + shift ,  g = A r + q ,
//!     d = P_K(r − α g) − r ,   r⁺ = r + λ d ,
//!     α⁺ = sᵀs/sᵀy  and  sᵀy/yᵀy  in turn ,        s = r⁺ − r ,  y = g⁺ − g = A s .
//! ```
//! α guesses the curvature along the last change; f need not fall in every step. λ = 1 as long as f stays below the largest of its last
//! values, less a share of the predicted fall,
//! ```text
//!     f(r + d) ≤ max(f, f₋₁, …, f₋₉) + γ gᵀd ;      otherwise λ = −gᵀd / dᵀA d ,
//! ```
//! the exact minimum along d, which always falls by ½ λ |gᵀd| and meets the condition since γ < ½. Every limit point is a solution.
//!
//! Only products A r are formed, dense or by blocks. Where W is asymmetric by a little, g is no gradient of f, and the search along d is a
//! guide without a promise: the certificate says whether the end is a solution. A direction along which f does not fall is left with the
//! step length 1/L.

use super::ContactSolver;
use super::stopping::Stopping;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::solvers as tolerance;
use moreau_exact::Result;
use nalgebra::DVector;

/// The spectral projected gradient method for the frictionless and associated laws; W must be symmetric, or nearly so.
///
/// # Source
/// Barzilai, Borwein (1988); Birgin, Martínez, Raydan, *Nonmonotone spectral projected gradient methods on convex sets* (2000).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarzilaiBorwein {
    /// Iteration limit.
    pub iterations: usize,
    /// Relative natural map at which it stops.
    pub tolerance: f64,
}

impl Default for BarzilaiBorwein {
    fn default() -> Self {
        BarzilaiBorwein { iterations: tolerance::GRADIENT_STEPS, tolerance: tolerance::STOP }
    }
}

const NAME: &str = "bb";

/// The iterate and its gradient.
struct Iterate {
    impulse: DVector<f64>,
    gradient: DVector<f64>,
}

impl ContactSolver for BarzilaiBorwein {
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
        super::parts::require_nearly_convex(NAME, problem)?;
        let mut stopping = Stopping::new(problem, self.tolerance);
        let mut impulse = super::start_of_use(problem, warm_start)?;
        super::project(problem, &mut impulse);
        let mut now = Iterate { gradient: problem.law_velocity(&impulse), impulse };
        let mut values = vec![value(problem, &now)];
        let plain = super::accelerated_projected_gradient::step_length(problem);
        let mut alpha = plain;
        let mut done = 0;
        while done < self.iterations && !stopping.holds(&now.impulse, &now.gradient) {
            let next = advance(problem, &now, alpha, &values);
            let (s, y) = (&next.impulse - &now.impulse, &next.gradient - &now.gradient);
            if s.amax() == 0.0 {
                if alpha == plain {
                    break;
                }
                alpha = plain;
                continue;
            }
            let long = done % 2 == 0;
            let guess = if long { s.norm_squared() / s.dot(&y) } else { s.dot(&y) / y.norm_squared() };
            // a change along which A has no curvature says nothing about the step length
            alpha = if guess.is_finite() && guess > 0.0 { guess } else { alpha };
            values.insert(0, value(problem, &next));
            values.truncate(tolerance::PAST_VALUES);
            now = next;
            done += 1;
        }
        let velocity = problem.velocity(&now.impulse);
        super::finite(Solution::new(NAME, now.impulse, velocity, done))
    }
}

/// r + λ d with its gradient, computed afresh from the data.
fn advance(problem: &ContactProblem, now: &Iterate, alpha: f64, values: &[f64]) -> Iterate {
    let mut direction = &now.impulse - &now.gradient * alpha;
    super::project(problem, &mut direction);
    direction -= &now.impulse;
    let slope = now.gradient.dot(&direction);
    let allowed = values.iter().copied().fold(f64::NEG_INFINITY, f64::max) + tolerance::ARMIJO * slope;
    let full = at(problem, &now.impulse + &direction);
    // what f loses in its sum says nothing: without this allowance the last digits are searched for one by one
    let terms = full.impulse.iter().zip(&full.gradient).map(|(r, g)| (r * g).abs()).sum::<f64>();
    let rounding = moreau_exact::tolerance::rounding(problem.rows(), terms.max(allowed.abs()));
    if value(problem, &full) <= allowed + rounding {
        return full;
    }
    // dᵀA d from the gradients at both ends
    let curvature = direction.dot(&(&full.gradient - &now.gradient));
    let lambda = if curvature > 0.0 { (-slope / curvature).clamp(0.0, 1.0) } else { 1.0 };
    at(problem, &now.impulse + direction * lambda)
}

fn at(problem: &ContactProblem, impulse: DVector<f64>) -> Iterate {
    Iterate { gradient: problem.law_velocity(&impulse), impulse }
}

/// f(r) = ½ r·(g + q) \[J\].
fn value(problem: &ContactProblem, iterate: &Iterate) -> f64 {
    0.5 * iterate.impulse.dot(&(&iterate.gradient + problem.free_velocity() + problem.shift()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use nalgebra::DMatrix;

    /// Two unit masses that arrive at 1 m/s, W = diag(1, 1/κ).
    fn two_masses(kappa: f64) -> ContactProblem {
        ContactProblem::new(DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 1.0 / kappa])), DVector::from_element(2, -1.0))
            .name("two masses")
            .law(Law::Frictionless)
            .rows_per_contact(1)
            .build()
            .unwrap()
    }

    #[test]
    fn two_curvatures_are_found_in_a_few_steps_where_the_plain_gradient_needs_thousands() {
        // the plain step 1/L leaves (1 − 1/κ)ᵏ of the error: 28 κ steps to STOP = e⁻²⁸
        let kappa = 1024.0;
        let problem = two_masses(kappa);
        let solution = BarzilaiBorwein::default().solve(&problem, None).unwrap();
        assert!(residuals(&problem, &solution).unwrap().is_solution(tolerance::STOP));
        assert!(28 * solution.iterations < kappa as usize, "{} steps", solution.iterations);
    }

    #[test]
    fn an_uphill_guess_is_shortened_to_the_minimum_along_its_direction() {
        let problem = two_masses(4.0);
        let now = at(&problem, DVector::zeros(2));
        let values = [value(&problem, &now)];
        // α = 8 proposes r = (8, 8), where f = 32 + 8 − 16 > 0; along d = (8, 8): λ = 16/80
        let next = advance(&problem, &now, 8.0, &values);
        assert!((next.impulse - DVector::from_element(2, 1.6)).amax() <= moreau_exact::tolerance::rounding(8, 2.0));
        // α = 1/2 falls and is taken whole
        let next = advance(&problem, &now, 0.5, &values);
        assert_eq!(next.impulse, DVector::from_element(2, 0.5));
    }
}
