//! The ends of what can be asked: no contacts, contacts that do not meet, numbers that are none, a hundred thousand contacts.

use moreau::certificate::residuals;
use moreau::solvers::{Auto, ContactSolver, ProjectedGaussSeidel};
use moreau::tolerance::certificate::CERTIFY;
use moreau::{ContactProblem, Law, Solution};
use moreau_contact::operator::BlockSparse;
use nalgebra::{DMatrix, DVector};

/// n points of 1 kg that do not meet, each arriving at 1 m/s and sliding.
fn isolated(n: usize) -> ContactProblem {
    let block = DMatrix::identity(3, 3);
    let blocks = BlockSparse::new(3, n, (0..n).map(|k| (k, k, block.clone())).collect()).expect("one block each");
    let free = DVector::from_fn(3 * n, |row, _| [-1.0, 0.25 * ((row / 3) % 7) as f64, 0.5][row % 3]);
    ContactProblem::new(blocks, free).name("isolated").friction(vec![0.5; n]).build().expect("a valid problem")
}

fn is_solution(problem: &ContactProblem, answer: &Solution) -> bool {
    residuals(problem, answer).expect("an answer that fits").is_solution(CERTIFY)
}

#[test]
fn a_problem_without_contacts_is_solved_by_nothing() {
    for law in [Law::Frictionless, Law::Coulomb, Law::Associated, Law::PolyhedralCoulomb { directions: 4 }] {
        let empty =
            ContactProblem::new(DMatrix::zeros(0, 0), DVector::zeros(0)).law(law).friction(Vec::new()).build().expect("no contacts");
        let answer = Auto.solve(&empty, None).expect("nothing to solve");
        assert!(answer.impulse.is_empty() && is_solution(&empty, &answer));
    }
}

#[test]
fn contacts_that_do_not_meet_are_answered_as_if_they_were_alone() {
    let together = Auto.solve(&isolated(5), None).expect("separate contacts").impulse;
    for k in 0..5 {
        let free = isolated(5).free_velocity().rows(3 * k, 3).into_owned();
        let alone = isolated(1).into_builder().free_velocity(free).build().expect("one contact");
        let answer = Auto.solve(&alone, None).expect("one contact");
        assert!((answer.impulse - together.rows(3 * k, 3)).amax() <= 1e-12);
    }
}

#[test]
fn numbers_that_are_none_are_refused_with_their_place() {
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut free = isolated(2).free_velocity().clone();
        free[4] = wrong;
        let message = isolated(2).into_builder().free_velocity(free).build().expect_err("no number").to_string();
        assert!(message.contains("free_velocity[4]"), "{message}");
        let mut w = DMatrix::identity(6, 6);
        w[(1, 2)] = wrong;
        assert!(isolated(2).into_builder().delassus(w).build().is_err());
        assert!(isolated(2).into_builder().friction(vec![0.5, wrong]).build().is_err());
        let answer = Solution::new("mine", DVector::from_element(6, wrong), DVector::zeros(6), 0);
        assert!(!residuals(&isolated(2), &answer).is_ok_and(|judged| judged.is_solution(1.0)), "{wrong} solves nothing");
    }
}

#[test]
fn a_hundred_thousand_contacts_are_swept_and_certified_and_a_square_matrix_of_them_is_refused() {
    let problem = isolated(100_000);
    let answer = ProjectedGaussSeidel::default().solve(&problem, None).expect("separate contacts");
    assert!(answer.iterations <= 2 && is_solution(&problem, &answer));
    // 720 GB: refused before it is taken
    let message = problem.law_delassus().expect_err("too large").to_string();
    assert!(message.contains("memory::set_limit"), "{message}");
}
