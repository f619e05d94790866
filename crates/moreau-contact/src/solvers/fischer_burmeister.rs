//! Newton's method on Fischer and Burmeister's equations of second-order cones, with a line search:
//!
//! ```text
//!     φ_τ(x, z) = x + z − (x∘x + z∘z + 2τ² e)^½ = 0     at every contact (`fischer_burmeister_equations.rs`)
//!     J d = −φ_τ ,     r ← r + s d ,  s = 1, ½, ¼, …
//! ```
//! until ‖φ_τ‖² has fallen by 2·10⁻⁴ s of itself. With τ = 0 the zeros are the solutions. x ∘ z = τ² e is the path that interior points
//! follow; here x and z may leave the cone, so that the iteration starts anywhere, and the nearer to a solution that is, the smaller τ is
//! at first. τ falls once ‖φ_τ‖ has become a tenth of it, and is zero in the end. For the convex laws, W ⪰ 0, ‖φ_τ‖ has no other minima
//! than zeros. With the lift of Coulomb's law it may have some, and then the iteration ends in one, with the best iterate by the
//! certificate's residual.
//!
//! **Rank.** Several impulses give one velocity, and J is singular along them as τ vanishes. η makes contacts softer in J alone: the zeros
//! stay. It grows where no step lowers ‖φ_τ‖, and falls while whole steps do. What is judged and returned is r with x ← P(x − z), the
//! projection on the cone: as near as r, and exactly zero where a contact is open.
//!
//! # Source
//! Fischer, *A special Newton-type optimization method*, Optimization 24 (1992); Fukushima, Luo and Tseng, SIAM J. Optim. 12 (2002);
//! Hayashi, Yamashita and Fukushima, *A combined smoothing and regularization method for monotone second-order cone complementarity
//! problems*, SIAM J. Optim. 15 (2005).

use super::ContactSolver;
use super::block_elimination::Slopes;
use super::fischer_burmeister_equations::ConeEquations;
use super::stopping::Stopping;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::{newton as tolerance, solvers::STOP};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Newton's method on Fischer and Burmeister's equations, for laws with round cones; a compliance may act on contact rows, and W may be
/// asymmetric and rank deficient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FischerBurmeister {
    /// Step limit.
    pub steps: usize,
    /// Relative residual at which it stops.
    pub tolerance: f64,
}

impl Default for FischerBurmeister {
    fn default() -> Self {
        FischerBurmeister { steps: tolerance::SMOOTHED_STEPS, tolerance: STOP }
    }
}

const NAME: &str = "fischer-burmeister";

impl ContactSolver for FischerBurmeister {
    fn name(&self) -> &'static str {
        NAME
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        Some(Box::new(Self { tolerance: relative, ..*self }))
    }

    fn iteration_limit(&self) -> Option<usize> {
        Some(self.steps)
    }

    fn takes(&self, law: Law, _rows: usize, _symmetric: bool) -> bool {
        law.directions().is_none()
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        self.solve_observed(problem, warm_start, |_, _| ())
    }
}

impl FischerBurmeister {
    /// As [`ContactSolver::solve`]; `observe` is given ‖φ_τ‖ before and after every step, with one τ \[√J\].
    fn solve_observed(
        &self,
        problem: &ContactProblem,
        warm_start: Option<&DVector<f64>>,
        mut observe: impl FnMut(f64, f64),
    ) -> Result<Solution> {
        if !self.takes(problem.law(), problem.rows_per_contact(), true) {
            return Err(Error::refused(NAME, format!("does not solve the law `{}`", problem.law().name())));
        }
        let mut impulse = super::start_of_use(problem, warm_start)?;
        let mut equations = ConeEquations::new(problem)?;
        let mut stopping = Stopping::new(problem, self.tolerance);
        let mut best = (f64::INFINITY, impulse.clone());
        let (mut mark, mut marked, mut steps) = (f64::INFINITY, 0, 0);
        let mut control = None;
        loop {
            let velocity = problem.law_velocity(&impulse);
            let answer = if steps == 0 { impulse.clone() } else { equations.projected(&impulse, &velocity) };
            let relative = stopping.relative(&answer, &problem.law_velocity(&answer));
            if relative < best.0 {
                best = (relative, answer);
            }
            let control = control.get_or_insert_with(|| Control::first(equations.mean(&impulse, &velocity, 0.0)));
            if best.0 < 0.5 * mark || control.is_new {
                (mark, marked, control.is_new) = (best.0.min(mark), steps, false);
            }
            let has_stalled = steps - marked > tolerance::SMOOTHED_PATIENCE;
            if relative <= self.tolerance || steps >= self.steps || has_stalled || super::watch::is_over() {
                break;
            }
            let Some((next, [before, after])) = step(&mut equations, &impulse, &velocity, control) else { break };
            observe(before, after);
            impulse = next;
            steps += 1;
        }
        let velocity = problem.velocity(&best.1);
        super::finite(Solution::new(NAME, best.1, velocity, steps))
    }
}

/// τ and η.
#[derive(Clone, Copy, Debug)]
struct Control {
    /// τ \[√J\].
    smoothing: f64,
    /// The first τ \[√J\].
    first: f64,
    /// η.
    softness: f64,
    /// Whether τ has just been changed.
    is_new: bool,
}

impl Control {
    fn first(mean: f64) -> Self {
        Control { smoothing: mean, first: mean, softness: tolerance::FIRST_SOFTNESS, is_new: true }
    }

    /// After a step of length `length` to an iterate with this mean ‖φ_τ‖.
    fn follow(&mut self, mean: f64, length: f64) {
        if length == 1.0 {
            self.softness = (tolerance::SOFTNESS_FALLS * self.softness).max(tolerance::LEAST_SOFTNESS);
        }
        if self.smoothing > 0.0 && mean <= tolerance::ON_PATH * self.smoothing {
            let next = mean / tolerance::ON_PATH * tolerance::SMOOTHING_FALLS;
            let next = next.max(tolerance::SMOOTHING_LEAST_LEFT * self.smoothing);
            self.smoothing = if next <= tolerance::LEAST_SMOOTHING * self.first { 0.0 } else { next };
            self.is_new = true;
        }
    }

    /// Whether there is a larger η to try.
    fn soften(&mut self) -> bool {
        self.softness *= tolerance::SOFTNESS_GROWS;
        self.softness <= tolerance::MOST_SOFTNESS
    }
}

/// The next impulses and ‖φ_τ‖ before and after; none where no step lowers it.
fn step(
    equations: &mut ConeEquations,
    from: &DVector<f64>,
    law_velocity: &DVector<f64>,
    control: &mut Control,
) -> Option<(DVector<f64>, [f64; 2])> {
    let residual = equations.residual(from, law_velocity, control.smoothing);
    let before = residual.norm();
    loop {
        let slopes: Vec<Slopes> = (0..equations.problem.contacts())
            .map(|k| equations.slopes(k, [from, law_velocity], [control.smoothing, control.softness]))
            .collect();
        let direction = equations.direction(&slopes, &-&residual).filter(|d| d.iter().all(|x| x.is_finite()));
        let found = direction.and_then(|d| search(equations, from, law_velocity, &d, control.smoothing, before));
        if let Some((next, length, after)) = found {
            control.follow(after / (equations.problem.contacts() as f64).sqrt(), length);
            return Some((next, [before, after]));
        }
        if !control.soften() {
            return None;
        }
    }
}

/// r + s d with the first s that lowers ‖φ_τ‖ enough, s, and the new ‖φ_τ‖.
fn search(
    equations: &ConeEquations,
    from: &DVector<f64>,
    law_velocity: &DVector<f64>,
    direction: &DVector<f64>,
    smoothing: f64,
    before: f64,
) -> Option<(DVector<f64>, f64, f64)> {
    let moved = super::parts::law_product(equations.problem, direction);
    (0..tolerance::SMOOTHED_HALVINGS).map(|halvings| 0.5f64.powi(halvings)).find_map(|length| {
        let next = from + direction * length;
        let after = equations.residual(&next, &(law_velocity + &moved * length), smoothing).norm();
        (after <= (1.0 - crate::tolerance::solvers::ARMIJO * length) * before).then_some((next, length, after))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::problem::{Compliance, Coordinates};
    use crate::solvers::test_problems::{by_blocks, four_corners, of_a_point, point};
    use crate::solvers::{AlternatingDirections, ProjectedGaussSeidel};
    use crate::tolerance::certificate::CERTIFY;
    use crate::tolerance::solvers::ENOUGH;
    use nalgebra::{DMatrix, dvector};

    const LAWS: [Law; 3] = [Law::Frictionless, Law::Coulomb, Law::Associated];
    const PUSHES: [(f64, f64); 4] = [(0.1, 0.0), (2.0, 0.0), (0.5, 1.0), (0.3, -3.0)];

    /// The answer, accepted, and no step of it has raised ‖φ_τ‖.
    fn solve(problem: &ContactProblem, start: Option<&DVector<f64>>) -> Solution {
        let falls = |before: f64, after: f64| assert!(after < before, "{}: from {before:e} to {after:e}", problem.name());
        let solution = FischerBurmeister::default().solve_observed(problem, start, falls).unwrap();
        let found = residuals(problem, &solution).unwrap();
        assert!(found.is_solution(ENOUGH), "{} {:?}: {found:?}", problem.name(), problem.law());
        solution
    }

    #[test]
    fn a_point_opens_sticks_and_slides_as_the_closed_forms_say() {
        for law in [Law::Coulomb, Law::Associated] {
            for (free, impulse) in of_a_point(law) {
                let solution = solve(&point(law, 0.5, free.clone()), None);
                assert!((&solution.impulse - &impulse).amax() <= ENOUGH, "{law:?} {free:?}: {}", solution.impulse);
            }
        }
        // without friction, by its law or its μ
        for (law, mu) in [(Law::Frictionless, 0.5), (Law::Coulomb, 0.0)] {
            let solution = solve(&point(law, mu, dvector![-1.0, 2.0, 0.5]), None);
            assert!((&solution.impulse - dvector![1.0, 0.0, 0.0]).amax() <= ENOUGH, "{law:?}");
        }
    }

    #[test]
    fn redundant_contacts_end_where_other_algorithms_end_cold_and_warm() {
        for law in LAWS {
            for (sideways, turning) in PUSHES {
                let problem = four_corners(law, sideways, turning);
                let cold = solve(&problem, None);
                let begun = ProjectedGaussSeidel { sweeps: 20, ..Default::default() }.solve(&problem, None).unwrap();
                let warm = solve(&by_blocks(&problem), Some(&begun.impulse));
                if law != Law::Coulomb {
                    let other = AlternatingDirections::default().solve(&problem, None).unwrap();
                    for velocity in [&cold.velocity, &warm.velocity] {
                        assert!((&other.velocity - velocity).amax() <= CERTIFY, "{law:?} {sideways} {turning}");
                    }
                }
                let again = solve(&problem, Some(&cold.impulse));
                assert!(again.iterations <= cold.iterations, "{law:?} {sideways} {turning}");
            }
        }
    }

    #[test]
    fn a_compliance_makes_the_impulse_unique_and_an_asymmetric_w_is_taken_as_it_is() {
        let soft = Compliance { coordinates: Coordinates::Contact, diagonal: DVector::from_element(12, 0.25) };
        let problem = four_corners(Law::Associated, 2.0, 1.0).into_builder().compliance(soft).build().unwrap();
        let other = AlternatingDirections::default().solve(&problem, None).unwrap();
        assert!((solve(&problem, None).impulse - other.impulse).amax() <= CERTIFY);
        // r_n = 1, and friction opposes a slip of 2 m/s that W_tn r_n makes 1.5 m/s: r_t = −½, u_t = 1.5 − ½
        let w = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, -0.5, 1.0]);
        let skew = ContactProblem::new(w, dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build().unwrap();
        let solution = solve(&skew, None);
        assert!((solution.velocity - dvector![0.0, 1.0]).amax() <= ENOUGH);
    }

    #[test]
    fn edges_are_refused_with_who_takes_them() {
        let polyhedral = four_corners(Law::PolyhedralAssociated { directions: 4 }, 0.1, 0.0);
        let compliance = Compliance { coordinates: Coordinates::Edge, diagonal: DVector::from_element(16, 1.0) };
        let soft = polyhedral.clone().into_builder().compliance(compliance).build().unwrap();
        let solvers = crate::solvers::Solvers::own();
        for problem in [polyhedral, soft] {
            let refused = solvers.with_cure(FischerBurmeister::default().solve(&problem, None).unwrap_err(), &problem).to_string();
            assert!(refused.contains(NAME) && refused.contains("polyhedral-associated") && refused.contains("use `"), "{refused}");
        }
    }

    #[test]
    fn a_limit_of_steps_is_kept_and_a_tolerance_asked_for_ends_it_sooner() {
        let problem = four_corners(Law::Coulomb, 0.5, 1.0);
        let steps = |solver: &dyn ContactSolver| solver.solve(&problem, None).unwrap().iterations;
        let whole = steps(&FischerBurmeister::default());
        assert_eq!(steps(&FischerBurmeister { steps: 2, ..Default::default() }), 2);
        assert!(steps(&*FischerBurmeister::default().with_tolerance(0.1).unwrap()) < whole);
    }
}
