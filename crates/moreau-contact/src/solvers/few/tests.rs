//! Answers on the stack against the certificate, against other algorithms and against what is known.

use super::super::{AlternatingDirections, Auto, ContactSolver, Murty, PrincipalOutcome, on_support};
use super::*;
use crate::certificate::Judge;
use crate::cones::second_order::tangential_norm;
use crate::operator::{BlockSparse, Sparse};
use crate::problem::Lcp;
use crate::solvers::test_problems::{by_blocks, four_corners, of_a_point, point};
use crate::tolerance::certificate::CERTIFY;
use crate::tolerance::cones::{DIFFERENCE_STEP, difference_error};
use crate::tolerance::solvers::{ENOUGH, STOP};
use moreau_exact::tolerance::rounding;
use nalgebra::{DMatrix, dmatrix, dvector};

/// Numbers of no pattern in [−1, 1].
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % 2001) as f64 / 1000.0 - 1.0
    }

    /// A Aᵀ + ½ + skew (B − Bᵀ): positive definite, symmetric without skew.
    fn definite(&mut self, n: usize, skew: f64) -> DMatrix<f64> {
        let root = DMatrix::from_fn(n, n, |_, _| self.next());
        let other = DMatrix::from_fn(n, n, |_, _| skew * self.next());
        &root * root.transpose() + DMatrix::identity(n, n) * 0.5 + &other - other.transpose()
    }
}

fn lcp(matrix: DMatrix<f64>, vector: DVector<f64>) -> ContactProblem {
    ContactProblem::new(matrix, vector).law(Law::Frictionless).rows_per_contact(1).build().expect("sizes that fit")
}

fn solved(problem: &ContactProblem) -> Option<Solution> {
    solve(problem, None, STOP, ENOUGH)
}

#[test]
fn a_definite_problem_without_friction_has_the_answer_of_principal_pivoting_and_no_residual() {
    let mut numbers = Numbers(1);
    for trial in 0..400 {
        let n = 1 + trial % MOST;
        let (matrix, vector) = (numbers.definite(n, 0.5), DVector::from_fn(n, |_, _| numbers.next()));
        let problem = lcp(matrix.clone(), vector.clone());
        let found = solved(&problem).expect("a P-matrix");
        let expected = pivoted(&Lcp::new(matrix, vector));
        assert!((&found.impulse - expected).amax() <= CERTIFY, "{trial}");
        assert_eq!(Judge::default().look(&problem, &found).expect("sizes fit").relative(), 0.0, "{trial}: what is not asked is 0");
        let blocks = BlockSparse::from_sparse(&Sparse::of(problem.dense()), 1).expect("one row each");
        let stored = problem.clone().into_builder().delassus(blocks).build().expect("the same numbers");
        assert_eq!(solved(&stored).expect("the same numbers").impulse, found.impulse, "{trial}");
        for law in [Law::Coulomb, Law::Associated] {
            let rubs_nowhere = problem.clone().into_builder().law(law).friction(vec![0.0; n]).build().expect("valid");
            assert_eq!(solved(&rubs_nowhere).expect("the same law").impulse, found.impulse, "{trial}");
        }
    }
}

#[test]
fn contacts_that_nothing_rubs_are_answered_alike_under_every_round_law() {
    let mut numbers = Numbers(7);
    for contacts in [1, 3, MOST, MOST + 1] {
        let (matrix, free) = (numbers.definite(3 * contacts, 0.0), DVector::from_fn(3 * contacts, |_, _| numbers.next()));
        let [without, coulomb, associated] = [Law::Frictionless, Law::Coulomb, Law::Associated].map(|law| {
            let problem = ContactProblem::new(matrix.clone(), free.clone()).law(law).friction(vec![0.0; contacts]).build().expect("valid");
            Auto.solve(&problem, None).expect("positive definite").impulse
        });
        // more are swept first, under each law in its own way
        let apart = if contacts <= MOST { 0.0 } else { CERTIFY };
        assert!([coulomb, associated].iter().all(|found| (found - &without).amax() <= apart), "{contacts}");
        let matrix = matrix.map(|entry| 0.125 * entry);
        let mut rubbing = vec![0.0; contacts];
        rubbing[contacts - 1] = 0.5;
        let problem = ContactProblem::new(matrix, free).law(Law::Associated).friction(rubbing).build().expect("valid");
        assert!(!problem.is_frictionless(), "one contact rubs");
    }
}

/// The solution of a problem with a P-matrix, by Murty's least index.
fn pivoted(lcp: &Lcp<f64>) -> DVector<f64> {
    match Murty::default().basis(lcp).expect("a P-matrix") {
        PrincipalOutcome::Basis(support, _) => on_support(lcp, &support).expect("a P-matrix"),
        PrincipalOutcome::Infeasible(row) => panic!("row {row} of a P-matrix"),
    }
}

#[test]
fn problems_that_newton_min_does_not_end_are_ended_by_the_path() {
    for (matrix, vector) in [
        // no entry on the diagonal; a singular block; the P-matrix on which plain Newton-min goes round in a circle
        (dmatrix![0.0, 2.0, -1.0; -1.0, 0.0, 1.0; 2.0, -2.0, 0.0], dvector![-3.0, 6.0, -1.0]),
        (dmatrix![1.0, 1.0; 1.0, 1.0], dvector![-1.0, -1.0]),
        (dmatrix![1.0, 0.0, -2.0; 2.0, 1.0, -4.0; 0.0, 2.0, 1.0], dvector![-1.0, -1.0, 1.0]),
    ] {
        let problem = lcp(matrix, vector);
        let found = solved(&problem).expect("Lemke's path ends at a solution");
        assert_eq!((found.solver.as_str(), Judge::default().look(&problem, &found).expect("sizes fit").relative()), ("lemke", 0.0));
    }
    // on a ray there is nothing, and the longer chain begins
    assert_eq!(solved(&lcp(dmatrix![0.0, -1.0; 1.0, 0.0], dvector![-1.0, -1.0])), None);
}

#[test]
fn an_answer_in_which_rounding_hides_the_data_is_not_taken_for_exact() {
    // z = (10¹², 10¹² − ½): w₂ is the difference of two such numbers, of which rounding leaves more than 10⁻⁵ of the data
    let problem = lcp(dmatrix![1.0 / 1e12, 0.0; -1.0, 1.0], dvector![-1.0, 0.5]);
    let found = solved(&problem).map(|found| Judge::default().look(&problem, &found).expect("sizes fit").relative());
    assert!(found.is_none_or(|relative| relative <= ENOUGH), "{found:?}");
}

#[test]
fn a_shift_that_cancels_the_free_velocity_is_left_to_the_certificate() {
    // q = −1 is the difference of two numbers of 10¹⁰, of which rounding leaves more than 10⁻⁵
    let builder = lcp(dmatrix![1.0], dvector![1e10]).into_builder().shift(dvector![-1e10 - 1.0]);
    let problem = builder.build().expect("sizes fit");
    let found = solved(&problem).map(|found| Judge::default().look(&problem, &found).expect("sizes fit").relative());
    assert!(found.is_none_or(|relative| relative <= ENOUGH), "{found:?}");
}

#[test]
fn one_contact_has_its_closed_form_in_one_sweep() {
    for (free, impulse) in of_a_point(Law::Coulomb) {
        let found = solved(&point(Law::Coulomb, 0.5, free)).expect("one contact");
        assert!((&found.impulse - impulse).amax() <= STOP && found.iterations == 1, "{found:?}");
    }
}

#[test]
fn friction_is_solved_to_the_same_velocity_as_by_alternating_directions() {
    let mut numbers = Numbers(7);
    let (mut answered, mut by_newton) = (0, 0);
    for trial in 0..120 {
        let (rows, contacts) = (2 + trial % 2, 1 + trial % MOST);
        let n = rows * contacts;
        // nearly diagonal, so that Coulomb's law has one answer
        let w = DMatrix::identity(n, n) + numbers.definite(n, 0.0) * (0.25 / n as f64);
        let free = DVector::from_fn(n, |row, _| numbers.next() - if row % rows == 0 { 0.4 } else { 0.0 });
        let problem = ContactProblem::new(w, free).rows_per_contact(rows).friction(vec![0.3; contacts]).build().expect("sizes fit");
        let Some(found) = solved(&problem) else { continue };
        answered += 1;
        by_newton += usize::from(found.solver == "nonsmooth-newton");
        let relative = Judge::default().look(&problem, &found).expect("sizes fit").relative();
        assert!(relative <= ENOUGH, "{trial}: {relative}");
        let other = AlternatingDirections::default().solve(&problem, None).expect("symmetric");
        assert!((&other.velocity - &found.velocity).amax() <= CERTIFY, "{trial}");
        for r in found.impulse.as_slice().chunks_exact(rows) {
            assert!(tangential_norm(r) <= 0.3 * r[0] + rounding(4, r[0]), "{trial}: beyond the cone by more than its own rounding");
        }
        let again = solve(&problem, Some(&found.impulse), STOP, ENOUGH).expect("it is one already");
        assert!((&again.velocity - &found.velocity).amax() <= CERTIFY, "{trial}: from the answer");
        let stored = by_blocks(&problem);
        assert!((solved(&stored).expect("the same numbers").velocity - &found.velocity).amax() <= CERTIFY, "{trial}: by blocks");
    }
    assert!(answered >= 110 && by_newton >= 50, "{answered} answered, {by_newton} by Newton's method");
}

#[test]
fn redundant_contacts_and_other_laws_are_answered_rightly_or_left_to_the_chain() {
    for law in [Law::Frictionless, Law::Coulomb, Law::Associated, Law::PolyhedralCoulomb { directions: 4 }] {
        for (sideways, turning) in [(0.1, 0.0), (2.0, 0.0), (0.5, 1.0), (0.3, -3.0)] {
            let problem = four_corners(law, sideways, turning);
            let found = solved(&problem);
            assert!(found.is_none() || matches!(law, Law::Frictionless | Law::Coulomb), "{law:?}");
            for answer in found.iter().chain(&Auto.solve(&problem, None)) {
                let relative = Judge::default().look(&problem, answer).expect("sizes fit").relative();
                assert!(relative <= ENOUGH, "{law:?} {sideways} {turning}: {relative}");
            }
        }
    }
}

#[test]
fn the_rows_of_a_sliding_contact_are_the_derivative_of_their_right_side() {
    // y = W r + q is (0, ½, −¼) at r = (1, −0.3, 0.1): it slides, and its normal equation holds
    let (w, impulse) = (dmatrix![1.0, 0.2, 0.1; 0.2, 1.5, -0.3; 0.1, -0.3, 1.2], dvector![1.0, -0.3, 0.1]);
    let problem = ContactProblem::new(w.clone(), dvector![0.0, 0.5, -0.25] - &w * &impulse).friction(vec![0.4]).build().expect("sizes fit");
    let linearised = |impulse: &DVector<f64>| {
        let mut contacts = contacts::Contacts::<3>::new(&problem, Some(impulse));
        contacts.begin(&problem).expect("it can be solved alone");
        let (mut rows, mut right) = ([[0.0; 4]; 3], [0.0; 3]);
        (0..9).for_each(|place| rows[place / 3][place % 3] = w[(place / 3, place % 3)]);
        contacts.linearise(0, 0.0, &mut rows, &mut right, 0);
        (rows, right)
    };
    let rows = linearised(&impulse).0;
    let right_of = |column: usize, change: f64| {
        let mut moved = impulse.clone();
        moved[column] += change;
        linearised(&moved).1
    };
    // z = (−0.67, 0.29) moves no faster than r; the numbers that are summed are below 2
    let allowed = difference_error(0.7, 2.0);
    for column in 0..3 {
        let (behind, ahead) = (right_of(column, -DIFFERENCE_STEP), right_of(column, DIFFERENCE_STEP));
        for (row, linearised_row) in rows.iter().enumerate() {
            let slope = (behind[row] - ahead[row]) / (2.0 * DIFFERENCE_STEP);
            assert!((slope - linearised_row[column]).abs() <= allowed, "{row} {column}: {slope} {}", linearised_row[column]);
        }
    }
}

#[test]
fn contacts_that_all_stick_are_ended_by_one_step_where_one_impulse_gives_their_velocity() {
    let mut numbers = Numbers(11);
    for trial in 0..60 {
        let contacts = 2 + trial % (MOST - 1);
        let n = 3 * contacts;
        // impulses deep in the cone stop every contact, whatever W is: r = −W⁻¹ u_free is the answer
        let w = DMatrix::identity(n, n) + numbers.definite(n, 0.25) * (0.5 / n as f64);
        let held = DVector::from_fn(n, |row, _| if row % 3 == 0 { 1.5 + numbers.next() / 4.0 } else { numbers.next() / 16.0 });
        let problem = ContactProblem::new(w.clone(), -&w * &held).friction(vec![1.0; contacts]).build().expect("sizes fit");
        let found = solved(&problem).expect("all stick");
        assert!((&found.impulse - &held).amax() <= CERTIFY, "{trial}");
        assert!(found.solver == "nonsmooth-newton" && found.iterations == 3, "{trial}: two sweeps and a step, {}", found.iterations);
    }
}

#[test]
fn the_factors_that_are_left_solve_for_another_right_side() {
    let mut numbers = Numbers(3);
    for size in 1..=13 {
        // a zero in the first place makes rows change places
        let whole = DMatrix::from_fn(size, size, |row, column| if row + column == 0 && size > 1 { 0.0 } else { numbers.next() });
        let [expected, other] = [(); 2].map(|()| DVector::from_fn(size, |_, _| numbers.next()));
        let mut matrix = [[0.0; 16]; 16];
        (0..size * size).for_each(|at| matrix[at / size][at % size] = whole[(at / size, at % size)]);
        let right = |x: &DVector<f64>| {
            let (mut right, b) = ([0.0; 16], &whole * x);
            right[..size].copy_from_slice(b.as_slice());
            right
        };
        let mut first = right(&expected);
        let found = elimination::eliminate(&mut matrix, &mut first, size).expect("regular");
        let mut second = right(&other);
        found.solve(&matrix, &mut second, size);
        // partial pivoting: 2ⁿ⁻¹ is the most that entries grow by, and the condition the most that x loses
        let inverse = whole.clone().try_inverse().expect("regular");
        let lost = rounding(3 * size, 2f64.powi(size as i32 - 1)) * whole.norm() * inverse.norm() * size as f64;
        for (x, expected) in [(first, expected), (second, other)] {
            (0..size).for_each(|row| assert!((x[row] - expected[row]).abs() <= lost, "{size}: {} {}", x[row], expected[row]));
        }
    }
}
