//! The radius of the friction set in Newton's equations, one of two:
//!
//! ```text
//!     Alart and Curnier    R = μ max(r_n − ρ_n w, 0)      ∂R = μ (∂r_n − ρ_n ∂w)
//!     Jean and Moreau      R = μ max(r_n, 0)              ∂R = μ ∂r_n
//! ```
//! with w the velocity that is complementary to r_n. Where r_n = max(r_n − ρ_n w, 0) they are the same number, so that both have the same
//! solutions; on the way there they are not. The first lets a contact that is about to open lose its friction at once, the second keeps
//! what its impulse allows and leaves the rows of friction without the velocity of the normal.

/// Which equations of Coulomb's law Newton's method solves; both have the same solutions.
///
/// # Source
/// Alart and Curnier, *A mixed formulation for frictional contact problems prone to Newton like solution methods*, Comput. Methods Appl.
/// Mech. Eng. 92 (1991). Jean and Moreau, *Dynamics in the presence of unilateral contacts and dry friction: a numerical approach*, in
/// *Unilateral Problems in Structural Analysis 2*, CISM Courses 304 (1987).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FrictionEquations {
    /// R = μ max(r_n − ρ_n w, 0) \[N·s\].
    #[default]
    AlartCurnier,
    /// R = μ max(r_n, 0) \[N·s\].
    JeanMoreau,
}

impl FrictionEquations {
    /// R \[N·s\] of r_n and r_n − ρ_n w.
    pub(super) fn radius(self, mu: f64, [normal, moved]: [f64; 2]) -> f64 {
        let bound = match self {
            FrictionEquations::AlartCurnier => moved,
            FrictionEquations::JeanMoreau => normal,
        };
        mu * bound.max(0.0)
    }

    /// −∂R/∂(ρ_n w) of an R that is not zero.
    pub(super) fn falls(self, mu: f64) -> f64 {
        match self {
            FrictionEquations::AlartCurnier => mu,
            FrictionEquations::JeanMoreau => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::problem::{ContactProblem, Law};
    use crate::solvers::test_problems::{four_corners, point};
    use crate::solvers::{AlternatingDirections, ContactSolver, LemkePivoting, NonsmoothNewton, ProjectedGaussSeidel, Solution};
    use crate::tolerance::certificate::CERTIFY;
    use crate::tolerance::solvers as tolerance;
    use nalgebra::{DVector, dvector};

    fn solve(problem: &ContactProblem, start: Option<&DVector<f64>>) -> Solution {
        let solution = NonsmoothNewton::jean_moreau().solve(problem, start).unwrap();
        assert_eq!(solution.solver, "jean-moreau");
        assert!(residuals(problem, &solution).unwrap().is_solution(tolerance::ENOUGH), "{}", problem.name());
        solution
    }

    #[test]
    fn a_point_opens_sticks_and_slides_as_the_closed_forms_say() {
        for law in [Law::Coulomb, Law::Associated] {
            for (free, impulse) in crate::solvers::test_problems::of_a_point(law) {
                let solution = solve(&point(law, 0.5, free.clone()), None);
                assert!((&solution.impulse - &impulse).amax() <= tolerance::ENOUGH, "{law:?} {free:?}: {}", solution.impulse);
            }
        }
    }

    #[test]
    fn both_radii_are_one_at_a_solution_and_two_elsewhere() {
        let radii = |normal: f64, moved: f64| {
            [FrictionEquations::AlartCurnier, FrictionEquations::JeanMoreau].map(|e| e.radius(0.5, [normal, moved]))
        };
        assert_eq!(radii(2.0, 2.0), [1.0, 1.0]);
        assert_eq!(radii(0.0, -1.0), [0.0, 0.0]);
        assert_eq!(radii(2.0, -1.0), [0.0, 1.0]);
    }

    #[test]
    fn redundant_contacts_end_where_other_algorithms_end() {
        for law in [Law::Frictionless, Law::Coulomb, Law::Associated, Law::PolyhedralAssociated { directions: 4 }] {
            for (sideways, turning) in [(0.1, 0.0), (2.0, 0.0), (0.5, 1.0), (0.3, -3.0)] {
                let problem = four_corners(law, sideways, turning);
                let round = if law.directions().is_some() { Law::Associated } else { law };
                let begun = ProjectedGaussSeidel { sweeps: 20, ..Default::default() };
                let begun = begun.solve(&problem.clone().into_builder().law(round).build().unwrap(), None).unwrap();
                let solution = solve(&problem, Some(&begun.impulse));
                let other = match law {
                    // its velocity need not be unique
                    Law::Coulomb => continue,
                    Law::PolyhedralAssociated { .. } => LemkePivoting.solve(&problem, None).unwrap(),
                    _ => AlternatingDirections::default().solve(&problem, None).unwrap(),
                };
                assert!((&other.velocity - &solution.velocity).amax() <= CERTIFY, "{law:?} {sideways} {turning}");
            }
        }
    }

    #[test]
    fn it_starts_where_it_is_told_and_stops_there_if_that_is_a_solution() {
        let problem = point(Law::Coulomb, 0.5, dvector![-1.0, 2.0, 0.0]);
        assert_eq!(solve(&problem, Some(&dvector![1.0, -0.5, 0.0])).iterations, 0);
    }
}
