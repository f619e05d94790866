//! Enumeration as a solver: a solution of a small LCP, or the proof that there is none.
//!
//! ```text
//!     0 ≤ z ⟂ M z + q ≥ 0 ,   r = G z      among complementary cones, in whole numbers
//! ```

pub use crate::certificate::complementary_cones::{Family, LARGEST, SolutionSet, all_solutions};

use super::ContactSolver;
use super::linear_form::Form;
use crate::certificate::complementary_cones::{infeasible, some_solution};
use crate::problem::{ContactProblem, Law, Lcp, Solution};
use crate::tolerance::complementarity::SEARCHED_ROWS;
use moreau_exact::scalar::{Rational, Scalar};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// The search among complementary cones, for laws that are LCPs of few unknowns, whatever their matrix.
///
/// M and q are those of the problem without any rounding, W being H M̂⁻¹ Hᵀ where mass and Jacobian are known. That there is no solution is
/// told by the failure `infeasible`, with its proof.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Enumeration;

const NAME: &str = "enumeration";

impl Enumeration {
    /// Whether the problem is an LCP of few unknowns.
    pub fn fits(problem: &ContactProblem) -> bool {
        Form::of(problem, NAME).is_ok_and(|form| form.unknowns(problem) <= SEARCHED_ROWS)
    }
}

impl ContactSolver for Enumeration {
    fn name(&self) -> &'static str {
        NAME
    }

    fn takes_start(&self) -> bool {
        false
    }

    fn takes(&self, law: Law, rows: usize, _symmetric: bool) -> bool {
        rows <= 2 || !matches!(law, Law::Coulomb | Law::Associated)
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let form = Form::of(problem, NAME)?;
        super::start_of_use(problem, warm_start)?;
        let unknowns = form.unknowns(problem);
        if unknowns > SEARCHED_ROWS {
            return Err(Error::refused(NAME, format!("is for up to {SEARCHED_ROWS} unknowns, this LCP has {unknowns}")));
        }
        let whole = form.exact_lcp(problem)?;
        match some_solution(&whole)? {
            Some(z) => super::finite(form.solution(problem, &z.map(|z| Scalar::to_f64(&z)), NAME, 0)),
            None => Err(Error::infeasible(NAME, reason(&whole))),
        }
    }
}

/// Why there is no solution.
pub(super) fn reason(lcp: &Lcp<Rational>) -> String {
    let Some(y) = infeasible(lcp) else {
        return "no solution exists: no complementary cone holds q, although some z ≥ 0 has M z + q ≥ 0".into();
    };
    let entries = y.iter().enumerate().filter(|(_, y)| !y.is_zero()).map(|(row, y)| format!("{row}: {y}")).collect::<Vec<_>>();
    format!("no solution exists: y ≥ 0 has Mᵀy ≤ 0 and qᵀy < 0, with y by rows {{{}}} and 0 elsewhere", entries.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use moreau_exact::error::Failure;
    use nalgebra::{DMatrix, dmatrix, dvector};

    fn problem(matrix: DMatrix<f64>, vector: DVector<f64>) -> ContactProblem {
        ContactProblem::new(matrix, vector).law(Law::Frictionless).rows_per_contact(1).build().unwrap()
    }

    #[test]
    fn a_solution_is_one_and_that_there_is_none_is_told_with_its_witness() {
        let two = problem(dmatrix![-1.0], dvector![1.0]);
        assert!(residuals(&two, &Enumeration.solve(&two, None).unwrap()).unwrap().is_solution(1e-8));
        for (matrix, vector, said) in [
            (dmatrix![0.0, 0.0; 0.0, 1.0], dvector![-1.0, 1.0], "{0: 1}"),
            (dmatrix![0.0, 1.0; 0.0, 0.0], dvector![-1.0, 1.0], "no complementary cone"),
        ] {
            let Err(Error::Solver { failure, reason, .. }) = Enumeration.solve(&problem(matrix, vector), None) else { panic!("none") };
            assert!(failure == Failure::Infeasible && reason.contains(said), "{reason}");
        }
    }

    #[test]
    fn the_problem_is_that_of_mass_and_jacobian_and_not_of_a_rounded_w() {
        // two feet of a body of 10 kg, one twice as far along: W = h hᵀ/10 is of rank one, which no stored one is
        let feet = |q: f64| {
            let made = ContactProblem::from_dynamics(dmatrix![10.0], dmatrix![1.0; -3.0], &dvector![0.0]).rows_per_contact(1);
            made.law(Law::Frictionless).free_velocity(dvector![-1.0, q]).friction(vec![0.0; 2]).build().unwrap()
        };
        // v ≥ 1 and −3 v ≥ −q: there is one for q = 3, and none for anything less
        let answer = Enumeration.solve(&feet(3.0), None).unwrap();
        assert!(residuals(&feet(3.0), &answer).unwrap().is_solution(1e-8));
        let Err(Error::Solver { failure, .. }) = Enumeration.solve(&feet(3.0_f64.next_down()), None) else { panic!("none") };
        assert_eq!(failure, Failure::Infeasible);
    }

    #[test]
    fn planar_friction_is_enumerated_and_many_unknowns_are_refused() {
        let point =
            ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build().unwrap();
        assert_eq!(Enumeration.solve(&point, None).unwrap().impulse, dvector![1.0, -0.5]);
        let many = problem(DMatrix::identity(41, 41), DVector::from_element(41, -1.0));
        assert!(!Enumeration::fits(&many) && Enumeration.solve(&many, None).unwrap_err().to_string().contains("41"));
    }
}
