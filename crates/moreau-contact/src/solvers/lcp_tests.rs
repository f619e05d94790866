//! Known families of linear complementarity problems: every solver gives a certified answer or says honestly why not, and `auto` solves
//! what has a solution.

use super::*;
use crate::certificate::lcp_proof::{Answer, Count, count, lcp_of, prove};
use crate::certificate::residuals;
use crate::problem::ContactProblem;
use moreau_exact::Error;
use moreau_exact::error::Failure;
use nalgebra::{DMatrix, dmatrix, dvector};

fn problem(name: &str, matrix: DMatrix<f64>, vector: DVector<f64>) -> ContactProblem {
    ContactProblem::new(matrix, vector).name(name).law(Law::Frictionless).rows_per_contact(1).build().expect("a problem")
}

/// 1 on the diagonal and c above it.
fn triangle(size: usize, c: f64) -> DMatrix<f64> {
    DMatrix::from_fn(size, size, |i, j| match i.cmp(&j) {
        std::cmp::Ordering::Equal => 1.0,
        std::cmp::Ordering::Less => c,
        std::cmp::Ordering::Greater => 0.0,
    })
}

/// Problems with solutions, by name.
fn solvable() -> Vec<ContactProblem> {
    let minus = |size: usize| DVector::from_element(size, -1.0);
    let murty = |size: usize| triangle(size, 2.0);
    let cyclic = |a: f64| dmatrix![1.0, a, 0.0; 0.0, 1.0, a; a, 0.0, 1.0];
    vec![
        problem("trivial", DMatrix::from_diagonal(&dvector![1.0, 2.0, 3.0]), dvector![1.0, 0.0, 2.0]),
        problem("murty", murty(8), minus(8)),
        problem("murty transposed", murty(8).transpose(), minus(8)),
        problem("fathi", murty(8) * murty(8).transpose(), minus(8)),
        problem("chandrasekaran", triangle(8, -2.0), DVector::from_fn(8, |i, _| if i % 2 == 0 { -1.0 } else { 2.0 })),
        problem("kostreva", cyclic(2.0), minus(3)),
        problem("ben gharbia gilbert", dmatrix![1.0, 0.0, -2.0; 2.0, 1.0, -4.0; 0.0, 2.0, 1.0], dvector![-1.0, -1.0, 1.0]),
        problem(
            "bimatrix game",
            dmatrix![0.0, 0.0, 10.0, 20.0; 0.0, 0.0, 30.0, 15.0; 10.0, 20.0, 0.0, 0.0; 30.0, 15.0, 0.0, 0.0],
            minus(4),
        ),
        problem("a segment of solutions", DMatrix::from_element(3, 3, 1.0), minus(3)),
        problem("a ray of solutions", dmatrix![0.0, 0.0; 0.0, 1.0], dvector![0.0, -1.0]),
        problem("p zero", dmatrix![0.0, 1.0; -1.0, 0.0], dvector![-1.0, 1.0]),
        problem("copositive", dmatrix![1.0, 5.0; 5.0, 1.0], minus(2)),
        problem("negative", dmatrix![-1.0, 0.0; 0.0, -2.0], dvector![1.0, 3.0]),
        problem("not symmetric", dmatrix![3.0, -1.0, 0.0; 1.0, 2.0, 1.0; -1.0, 1.0, 2.0], dvector![-2.0, 1.0, -1.0]),
        problem("degenerate", DMatrix::from_fn(6, 6, |i, j| if i == j { 2.0 } else { 1.0 }), dvector![-1.0, -1.0, 0.0, 0.0, -1.0, -1.0]),
        problem("hidden behind rays", dmatrix![0.0, -1.0, 1.0; 1.0, 0.0, -1.0; -2.0, 0.0, 0.0], dvector![-1.0, 2.0, 3.0]),
    ]
}

const LCP_SOLVERS: [&str; 6] = ["auto", "lemke", "murty", "parametric-pivoting", "newton-min", "enumeration"];

#[test]
fn auto_solves_what_has_a_solution_and_all_agree_where_there_is_one() {
    let (mut solved, mut refused) = (0, 0);
    for problem in solvable() {
        let lcp = lcp_of(&problem).expect("an LCP");
        let count = count(&lcp).unwrap();
        assert_eq!(count.is_solvable(), Some(true), "{}", problem.name());
        let mut first: Option<DVector<f64>> = None;
        for name in LCP_SOLVERS {
            let label = format!("{name} on {}", problem.name());
            let solution = match Solvers::own().by_name(name).unwrap().solve(&problem, None) {
                Ok(solution) => solution,
                Err(Error::Solver { failure, reason, .. }) => {
                    assert!(!["auto", "enumeration"].contains(&name) && failure != Failure::Infeasible, "{label}: {reason}");
                    refused += 1;
                    continue;
                }
                Err(other) => panic!("{label}: {other}"),
            };
            assert!(residuals(&problem, &solution).unwrap().is_solution(1e-8), "{label}: {}", solution.impulse);
            solved += 1;
            let Answer::Near(near) = prove(&lcp, &solution.impulse).unwrap() else { panic!("{label}: not proved") };
            assert!(near.exact && near.distance <= 1e-7 * (1.0 + solution.impulse.amax()), "{label}: {near:?}");
            if matches!(count, Count::One(_)) {
                let difference = (first.get_or_insert_with(|| solution.impulse.clone()).clone() - &solution.impulse).amax();
                assert!(difference <= 1e-7 * (1.0 + solution.impulse.amax()), "{label}: {difference}");
            }
        }
    }
    assert!(solved > 70 && refused > 4, "{solved} solved, {refused} not");
}

#[test]
fn what_has_no_solution_is_told_with_its_proof() {
    let feasible = problem("feasible", dmatrix![0.0, 1.0; 0.0, 0.0], dvector![-1.0, 1.0]);
    let infeasible = problem("infeasible", dmatrix![1.0, -2.0; -2.0, 1.0], dvector![-1.0, -1.0]);
    for (problem, said) in [(feasible, "no complementary cone"), (infeasible, "Mᵀy ≤ 0")] {
        for name in LCP_SOLVERS {
            let Err(Error::Solver { failure, reason, .. }) = Solvers::own().by_name(name).unwrap().solve(&problem, None) else {
                panic!("{name} on {}", problem.name())
            };
            if ["auto", "enumeration"].contains(&name) {
                assert!(failure == Failure::Infeasible && reason.contains(said), "{name}: {reason}");
            }
        }
    }
}
