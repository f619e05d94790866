//! Principal pivoting on classes it is for, and on others.

use super::*;
use crate::certificate::complementary_cones::{all_solutions, infeasible};
use crate::certificate::lcp::residuals;
use moreau_exact::elimination::{principal, solve};
use moreau_exact::error::Failure;
use moreau_exact::scalar::{Rational, ratio};
use nalgebra::{DMatrix, dmatrix, dvector};
use proptest::prelude::*;

fn rationals(size: usize, entries: &[i64], vector: &[i64]) -> Lcp<Rational> {
    let numbers = |slice: &[i64]| slice.iter().map(|x| ratio(*x, 1)).collect::<Vec<_>>();
    Lcp::new(DMatrix::from_row_slice(size, size, &numbers(entries)), DVector::from_vec(numbers(vector)))
}

/// z of a support.
fn of_support(lcp: &Lcp<Rational>, support: &[bool]) -> DVector<Rational> {
    let members: Vec<usize> = (0..lcp.size()).filter(|&i| support[i]).collect();
    let right = DVector::from_fn(members.len(), |i, _| -lcp.vector[members[i]].clone());
    let values = solve(&principal(&lcp.matrix, &members), &right).expect("a basis is regular");
    let mut z = DVector::from_element(lcp.size(), Rational::ZERO);
    members.iter().zip(values.iter()).for_each(|(&i, value)| z[i] = value.clone());
    z
}

/// Murty's example: M lower triangular with 1 and 2, q = −1, in the order in which the least index comes last.
fn exponential(size: usize) -> Lcp<Rational> {
    let matrix = DMatrix::from_fn(size, size, |i, j| ratio(if i == j { 1 } else { 2 * i64::from(i < j) }, 1));
    Lcp::new(matrix, DVector::from_element(size, ratio(-1, 1)))
}

#[test]
fn murtys_example_takes_two_to_the_n_less_one_pivots() {
    for size in 1..8 {
        let PrincipalOutcome::Basis(support, pivots) = Murty::default().basis(&exponential(size)).unwrap() else { panic!("a P-matrix") };
        assert!(residuals(&exponential(size), &of_support(&exponential(size), &support)).vanish());
        assert_eq!(pivots, (1 << size) - 1);
    }
    let few = Murty { pivots: 100 }.basis(&exponential(7)).unwrap_err();
    assert!(matches!(few, Error::Solver { failure: Failure::Limit, .. }), "{few}");
}

#[test]
fn other_matrices_are_refused_with_the_row() {
    let row = |outcome: Result<PrincipalOutcome>| match outcome {
        Err(Error::Solver { failure: Failure::Refused, reason, .. }) => reason,
        other => panic!("{other:?}"),
    };
    assert!(row(Murty::default().basis(&rationals(2, &[1, 0, 0, 0], &[1, -1]))).contains("row 1"));
    assert!(row(ParametricPivoting::default().basis(&rationals(2, &[1, 0, 0, -1], &[1, -1]))).contains("row 1"));
}

#[test]
fn contacts_without_friction_are_solved_by_each_and_friction_is_refused() {
    let wheel =
        ContactProblem::new(dmatrix![2.0, 1.0; 1.0, 2.0], dvector![-1.0, -3.0]).law(Law::Frictionless).rows_per_contact(1).build().unwrap();
    for solver in [&Murty::default() as &dyn ContactSolver, &ParametricPivoting::default()] {
        let answer = solver.solve(&wheel, None).unwrap();
        assert_eq!(answer.impulse, dvector![0.0, 1.5]);
        let rough =
            ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build().unwrap();
        assert!(solver.solve(&rough, None).unwrap_err().to_string().contains("`coulomb`"));
    }
}

/// With d = 1 the pivots on this positive semidefinite matrix of rank one and its skew part go round: three numbers vanish at once.
#[test]
fn pivots_that_go_round_in_a_circle_begin_anew_with_other_numbers() {
    let entries = [1, 2, 0, 1, 0, 1, -2, 1, 0, 2, 0, -1, -1, -1, 1, 0];
    let lcp = rationals(4, &entries, &[-3, -1, -1, 1]);
    match (ParametricPivoting { pivots: 200 }).basis(&lcp).unwrap() {
        PrincipalOutcome::Basis(support, pivots) => {
            assert!(residuals(&lcp, &of_support(&lcp, &support)).vanish());
            assert!(pivots > 16, "{pivots}: it did not go round");
        }
        PrincipalOutcome::Infeasible(_) => assert!(infeasible(&lcp).is_some()),
    }
}

proptest! {
    #[test]
    fn both_end_at_the_solution_of_a_p_matrix(
        entries in proptest::collection::vec(-4i64..5, 25),
        q in proptest::collection::vec(-5i64..6, 5),
        size in 1usize..6,
    ) {
        let matrix = DMatrix::from_fn(size, size, |i, j| ratio(entries[5 * i + j] + if i == j { 20 } else { 0 }, 1));
        let lcp = Lcp::new(matrix, DVector::from_fn(size, |i, _| ratio(q[i], 1)));
        for outcome in [Murty::default().basis(&lcp).unwrap(), ParametricPivoting::default().basis(&lcp).unwrap()] {
            let PrincipalOutcome::Basis(support, _) = outcome else { return Err(TestCaseError::fail("a P-matrix has a solution")) };
            prop_assert!(residuals(&lcp, &of_support(&lcp, &support)).vanish());
        }
    }

    #[test]
    fn a_semidefinite_matrix_is_solved_or_infeasible(
        factor in proptest::collection::vec(-2i64..3, 15),
        skew in proptest::collection::vec(-2i64..3, 25),
        q in proptest::collection::vec(-3i64..4, 5),
        size in 1usize..6, rank in 1usize..4,
    ) {
        let factor = DMatrix::from_fn(rank, size, |i, j| ratio(factor[5 * i + j], 1));
        let skew = DMatrix::from_fn(size, size, |i, j| ratio(skew[5 * i + j], 1));
        let lcp = Lcp::new(factor.tr_mul(&factor) + &skew - skew.transpose(), DVector::from_fn(size, |i, _| ratio(q[i], 1)));
        match ParametricPivoting::default().basis(&lcp).unwrap() {
            PrincipalOutcome::Basis(support, _) => prop_assert!(residuals(&lcp, &of_support(&lcp, &support)).vanish()),
            PrincipalOutcome::Infeasible(_) => prop_assert!(infeasible(&lcp).is_some() && all_solutions(&lcp).unwrap().is_empty()),
        }
    }
}
