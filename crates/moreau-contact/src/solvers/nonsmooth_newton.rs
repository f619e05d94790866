//! Nonsmooth Newton on Alart and Curnier's equations, which are the certificate's natural map in two parts, or on Jean and Moreau's, which
//! have another radius R (`friction_equations.rs`):
//!
//! ```text
//!     a = r_n − ρ_n w ,   z = r_t − ρ_t y_t ,   R = μ max(a, 0) ,   y = A r + q ,   A = W + compliance
//!     F_n = r_n − max(a, 0) ,      F_t = r_t − P_R(z) ,      J d = −F ,   r ← r + s d
//!     w = y_n ,   or y_n − μ max { s·(−y_t) : s ∈ S } for the associated laws
//! ```
//! with P_R the projection on R·S, S the disk or the polygon of the law (`friction_set.rs`). With a polygon F is piecewise linear, and the
//! right piece ends it.
//!
//! Where contacts do not change between open, sticking and sliding the error squares in every step; far from a solution nothing is
//! promised. So it goes on from what sweeps have found, and ends problems on which they creep: a box on four corners, whose W has rank six
//! of twelve.
//!
//! **Rank.** Several impulses give one velocity, and J is singular along them. η on the diagonal of the rows that ask for a velocity makes
//! it regular, holds back the step along the null space, and leaves the zeros of F alone. A large η keeps contacts from changing their
//! state for nothing, a small one squares the error at the end; they are tried in turn, each with steps s = 1, ½, ¼, …, until ‖F‖ is
//! halved; else the least ‖F‖ is taken, even a larger one: a cycle is left by a jump. Which cycle an iteration ends in depends on η: other
//! ones start again. The best iterate, by the certificate's residual, is returned.
//!
//! # Source
//! Alart and Curnier, *A mixed formulation for frictional contact problems prone to Newton like solution methods*, Comput. Methods Appl.
//! Mech. Eng. 92 (1991).

use super::ContactSolver;
use super::contact_systems::ContactSystems;
use super::friction_equations::FrictionEquations;
use super::nonsmooth_equations::Equations;
use super::stopping::Stopping;
use super::workspace;
use crate::memory::spare::{self, Lent};
use crate::problem::{ContactProblem, Coordinates, Law, Solution};
use crate::tolerance::solvers as tolerance;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Nonsmooth Newton for every law, compliance on edges excepted; W may be asymmetric and rank deficient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NonsmoothNewton {
    /// Step limit of each start.
    pub steps: usize,
    /// Relative residual at which it stops.
    pub tolerance: f64,
    /// How many of the starts with different η it may make.
    pub starts: usize,
    /// Which radius friction has.
    pub equations: FrictionEquations,
    /// How many steps in a row may have the factor of an earlier J, where W is stored by blocks and they leave little of F; 0 is Newton's
    /// method. With more, an iterate at which much of F is left is not judged.
    pub reuses: usize,
}

impl Default for NonsmoothNewton {
    fn default() -> Self {
        NonsmoothNewton {
            steps: tolerance::NONSMOOTH_STEPS,
            tolerance: tolerance::STOP,
            starts: tolerance::NONSMOOTH_PROXIMALS.len(),
            equations: FrictionEquations::AlartCurnier,
            reuses: 0,
        }
    }
}

impl ContactSolver for NonsmoothNewton {
    fn name(&self) -> &'static str {
        match self.equations {
            FrictionEquations::AlartCurnier => "nonsmooth-newton",
            FrictionEquations::JeanMoreau => "jean-moreau",
        }
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        Some(Box::new(Self { tolerance: relative, ..*self }))
    }

    fn iteration_limit(&self) -> Option<usize> {
        Some(self.steps)
    }

    fn takes(&self, _law: Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        if !NonsmoothNewton::fits(problem) {
            return Err(Error::refused(self.name(), "does not solve a compliance on edges, of which the impulse is not a function"));
        }
        let mut memory = workspace::borrow(problem);
        let systems = problem.delassus().blocks().map(|w| {
            memory.systems.prepare(problem, w);
            &mut memory.systems
        });
        self.solve_with(problem, warm_start, systems)
    }
}

impl NonsmoothNewton {
    /// With Jean and Moreau's equations.
    pub fn jean_moreau() -> Self {
        NonsmoothNewton { equations: FrictionEquations::JeanMoreau, ..Default::default() }
    }

    /// Whether the law of this problem is a function of impulse and velocity.
    pub fn fits(problem: &ContactProblem) -> bool {
        problem.compliance().is_none_or(|compliance| compliance.coordinates == Coordinates::Contact)
    }

    /// What solves with J where W is stored by blocks; it serves for every problem with this W.
    pub(super) fn systems(problem: &ContactProblem) -> Option<ContactSystems> {
        problem.delassus().blocks().map(|w| ContactSystems::new(problem, w))
    }

    /// As [`ContactSolver::solve`] on a problem that [`fits`](Self::fits), with the systems of its W.
    pub(super) fn solve_with(
        &self,
        problem: &ContactProblem,
        warm_start: Option<&DVector<f64>>,
        systems: Option<&mut ContactSystems>,
    ) -> Result<Solution> {
        let mut equations = Equations::new(problem, self.equations, self.reuses, systems)?;
        let mut stopping = Stopping::new(problem, self.tolerance);
        let start = Lent::from(super::start_of_use(problem, warm_start)?);
        let (mut best, mut law_velocity) = ((f64::INFINITY, start.clone()), Lent::from(spare::zeros(start.len())));
        let mut steps = 0;
        for proximals in tolerance::NONSMOOTH_PROXIMALS.into_iter().take(self.starts) {
            let (mut impulse, mut least, mut mark, mut since) = (start.clone(), f64::INFINITY, f64::INFINITY, 0);
            for taken in 0..=self.steps {
                problem.write_law_velocity(impulse.as_slice(), law_velocity.as_mut_slice());
                let is_judged = taken == self.steps || !equations.is_far(&impulse);
                let relative = if is_judged { stopping.relative(&impulse, &law_velocity) } else { f64::INFINITY };
                since += 1;
                least = least.min(relative);
                if least < 0.5 * mark {
                    (mark, since) = (least, 0);
                }
                if relative < best.0 {
                    best.0 = relative;
                    best.1.copy_from(&impulse);
                }
                let patience = if least <= tolerance::ACCEPTABLE { tolerance::NONSMOOTH_ENDED } else { tolerance::NONSMOOTH_STALLED };
                if relative <= self.tolerance || since >= patience || taken == self.steps || super::watch::is_over() {
                    break;
                }
                let again = equations.step_again(&impulse);
                let Some(next) = again.or_else(|| equations.step(&impulse, &law_velocity, proximals)) else { break };
                impulse = next;
                steps += 1;
            }
            if best.0 <= self.tolerance.max(tolerance::ACCEPTABLE) || super::watch::is_over() {
                break;
            }
        }
        let impulse = best.1.into_inner();
        let velocity = problem.velocity(&impulse);
        super::finite(Solution::new(spare::text(self.name()), impulse, velocity, steps))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::problem::Compliance;
    use crate::solvers::test_problems::{by_blocks, four_corners};
    use crate::solvers::{AlternatingDirections, LemkePivoting, ProjectedGaussSeidel};
    use crate::tolerance::certificate::CERTIFY;

    #[test]
    fn it_finishes_what_sweeps_began_where_the_impulses_are_not_unique() {
        for law in [Law::Frictionless, Law::Coulomb, Law::Associated, Law::PolyhedralCoulomb { directions: 6 }] {
            for (sideways, turning) in [(0.1, 0.0), (2.0, 0.0), (0.5, 1.0), (0.3, -3.0)] {
                let problem = four_corners(law, sideways, turning);
                let begun = ProjectedGaussSeidel { sweeps: 20, ..Default::default() }.solve(&problem, None).unwrap();
                let solution = NonsmoothNewton::default().solve(&problem, Some(&begun.impulse)).unwrap();
                assert!(residuals(&problem, &solution).unwrap().is_solution(tolerance::ENOUGH), "{law:?} {sideways} {turning}");
                if matches!(law, Law::Frictionless | Law::Associated) {
                    // several impulses, one velocity; Coulomb's law may have several of these too
                    let other = AlternatingDirections::default().solve(&problem, None).unwrap();
                    assert!((&other.velocity - &solution.velocity).amax() <= CERTIFY, "{law:?} {sideways} {turning}");
                }
            }
        }
    }

    const BOTH: [FrictionEquations; 2] = [FrictionEquations::AlartCurnier, FrictionEquations::JeanMoreau];

    #[test]
    fn blocks_and_a_square_matrix_give_the_same_step() {
        let impulse = DVector::from_vec(vec![0.4, -0.05, 0.02, 0.3, -0.1, -0.1, -0.8, 0.0, 0.0, 0.1, 0.3, 0.2]);
        for law in [Law::Frictionless, Law::Coulomb, Law::Associated, Law::PolyhedralCoulomb { directions: 5 }] {
            let soft = Compliance { coordinates: Coordinates::Contact, diagonal: DVector::from_fn(12, |i, _| i as f64 / 8.0) };
            for compliance in [None, Some(soft)] {
                let problem = four_corners(law, 0.7, 0.9).into_builder().compliance(compliance).build().unwrap();
                let stored = by_blocks(&problem);
                let velocity = problem.law_velocity(&impulse);
                let [dense, blocks] = [&problem, &stored].map(|problem| {
                    let mut systems = NonsmoothNewton::systems(problem);
                    let mut equations = Equations::new(problem, FrictionEquations::AlartCurnier, 0, systems.as_mut()).unwrap();
                    let (residual, slopes) = equations.linearise(&impulse, &velocity, 1e-3);
                    equations.direction(&slopes, &-&*residual).unwrap()
                });
                // condition of J up to 1/η times the norm of W
                let rounding = moreau_exact::tolerance::rounding(12, 1e3 * problem.dense().norm()) * dense.amax();
                assert!((&dense - &blocks).amax() <= rounding, "{law:?}");
            }
        }
    }

    /// Near the answer a factor serves again and leaves a part of F; far from it, or with none to serve, it does not.
    #[test]
    fn a_factor_serves_again_only_where_the_step_before_left_little() {
        let problem = by_blocks(&four_corners(Law::Coulomb, 0.5, 1.0));
        let answer = NonsmoothNewton::default().solve(&problem, None).unwrap().impulse;
        let norm_at = |impulse: &DVector<f64>| {
            let mut residual = DVector::zeros(12);
            let equations = Equations::new(&problem, FrictionEquations::AlartCurnier, 0, None).unwrap();
            equations.write_residual(impulse, &problem.law_velocity(impulse), &mut residual);
            residual.norm()
        };
        let (mut served, mut left) = (0, 0);
        for from in (0..8).map(|k| &answer * (1.0 + 10f64.powi(-k))).chain([DVector::zeros(12), -&answer]) {
            let mut systems = NonsmoothNewton::systems(&problem);
            for reuses in [0, 1] {
                let mut equations = Equations::new(&problem, FrictionEquations::AlartCurnier, reuses, systems.as_mut()).unwrap();
                assert!(equations.step_again(&from).is_none(), "there is no factor yet");
                let first = equations.step(&from, &problem.law_velocity(&from), tolerance::NONSMOOTH_PROXIMALS[0]).unwrap();
                let (is_near, again) = (norm_at(&first) <= norm_at(&from) / 64.0, equations.step_again(&first));
                assert!(again.is_none() || (reuses == 1 && is_near && norm_at(again.as_ref().unwrap()) <= norm_at(&first) / 8.0));
                served += usize::from(again.is_some());
                left += usize::from(!is_near);
                assert!(equations.step_again(&first).is_none(), "one reuse at most");
            }
        }
        assert!(served > 3 && left > 1, "{served} {left}");
    }

    /// The largest difference of the Jacobian of one from the differences of F of the other, and what rounding and curvature leave.
    fn difference(problem: &ContactProblem, slopes_of: FrictionEquations, values_of: FrictionEquations) -> [f64; 2] {
        let (step, eta) = (crate::tolerance::cones::DIFFERENCE_STEP, tolerance::NONSMOOTH_PROXIMALS[0][1]);
        let [slopes_of, values_of] = [slopes_of, values_of].map(|radius| Equations::new(problem, radius, 0, None).unwrap());
        // one contact presses and sticks or slides, one is open
        let impulse = DVector::from_vec(vec![0.4, -0.05, 0.02, 0.3, -0.1, -0.1, -0.8, 0.0, 0.0, 0.1, 0.3, 0.2]);
        let slopes = slopes_of.linearise(&impulse, &problem.law_velocity(&impulse), eta).1;
        let jacobian = slopes_of.jacobian(slopes_of.operator.as_ref().expect("stored densely"), &slopes);
        let column = |column: usize| {
            let shifted = |by: f64| {
                let mut moved = impulse.clone();
                moved[column] += by;
                let mut residual = DVector::zeros(12);
                values_of.write_residual(&moved, &problem.law_velocity(&moved), &mut residual);
                residual
            };
            (jacobian.column(column) - (shifted(step) - shifted(-step)) / (2.0 * step)).amax()
        };
        [(0..12).map(column).fold(0.0, f64::max), eta + crate::tolerance::cones::difference_error(0.05, 4.0)]
    }

    #[test]
    fn the_jacobian_is_the_derivative_of_its_own_equations_alone() {
        let polygons = [Law::PolyhedralCoulomb { directions: 5 }, Law::PolyhedralAssociated { directions: 8 }];
        for law in [Law::Frictionless, Law::Coulomb, Law::Associated].into_iter().chain(polygons) {
            let problem = four_corners(law, 0.7, 0.9);
            for (slopes_of, values_of) in BOTH.into_iter().flat_map(|one| BOTH.map(|other| (one, other))) {
                let [found, bound] = difference(&problem, slopes_of, values_of);
                let same = slopes_of == values_of || law == Law::Frictionless;
                assert_eq!(found <= bound, same, "{law:?} {slopes_of:?} {values_of:?}: {found:e}");
            }
        }
    }

    #[test]
    fn polyhedral_laws_end_where_lemke_ends() {
        for law in [Law::PolyhedralCoulomb { directions: 8 }, Law::PolyhedralAssociated { directions: 4 }] {
            for (sideways, turning) in [(0.1, 0.0), (2.0, 0.0), (0.5, 1.0), (0.3, -3.0)] {
                let problem = four_corners(law, sideways, turning);
                let round = if matches!(law, Law::PolyhedralCoulomb { .. }) { Law::Coulomb } else { Law::Associated };
                let begun = ProjectedGaussSeidel { sweeps: 20, ..Default::default() };
                let begun = begun.solve(&problem.clone().into_builder().law(round).build().unwrap(), None).unwrap();
                let solution = NonsmoothNewton::default().solve(&problem, Some(&begun.impulse)).unwrap();
                assert!(residuals(&problem, &solution).unwrap().is_solution(tolerance::ENOUGH), "{law:?} {sideways} {turning}");
                let lemke = LemkePivoting.solve(&problem, None).unwrap();
                if law == (Law::PolyhedralAssociated { directions: 4 }) {
                    assert!((&lemke.velocity - &solution.velocity).amax() <= CERTIFY, "{law:?} {sideways} {turning}");
                }
            }
        }
    }

    #[test]
    fn compliance_on_edges_is_refused_by_name() {
        let compliance = Compliance { coordinates: Coordinates::Edge, diagonal: DVector::from_element(16, 1.0) };
        let hard = four_corners(Law::PolyhedralAssociated { directions: 4 }, 0.1, 0.0);
        let problem = hard.into_builder().compliance(compliance).build().unwrap();
        assert!(NonsmoothNewton::default().solve(&problem, None).unwrap_err().to_string().contains("compliance on edges"));
    }
}
