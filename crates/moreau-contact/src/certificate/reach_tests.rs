//! Tests of the reach: both sides of its limit under every law, and what an accepted answer is worth where entries of W are of any size.

use super::strangeness;
use crate::certificate::draw::Draw;
use crate::certificate::{by_contact, residuals};
use crate::problem::{ContactProblem, Law, Lcp, Solution};
use crate::solvers::{ContactSolver, LemkePivoting};
use crate::tolerance::certificate::{CERTIFY, gamma};
use moreau_exact::scalar::{Rational, Scalar, exact};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

const LAWS: [Law; 5] = [
    Law::Frictionless,
    Law::Coulomb,
    Law::Associated,
    Law::PolyhedralCoulomb { directions: 2 },
    Law::PolyhedralAssociated { directions: 2 },
];

fn by_hand(problem: &ContactProblem, impulse: DVector<f64>) -> Solution {
    let velocity = problem.velocity(&impulse);
    Solution::new("by hand", impulse, velocity, 0)
}

/// Two contacts of 1 kg in the plane, μ = ½: the first opens and slides at 1 m/s, the second closes at 1 m/s. What row `row` of the first
/// carries moves the second along its normal `times` as fast.
fn carried(law: Law, row: usize, times: f64) -> ContactProblem {
    let mut w = DMatrix::identity(4, 4);
    w[(2, row)] = times;
    ContactProblem::new(w, dvector![1.0, 1.0, -1.0, 0.0]).law(law).rows_per_contact(2).friction(vec![0.5; 2]).build().unwrap()
}

#[test]
fn an_impulse_that_counts_as_none_may_move_others_by_what_they_are_judged_by_and_no_more() {
    for (law, row) in LAWS.into_iter().flat_map(|law| [(law, 0), (law, 1)]) {
        for times in [1e12, 1e20, 1e60] {
            let problem = carried(law, row, times);
            let found = |moved: f64| {
                let mut impulse = dvector![0.0, 0.0, 1.0 - moved, 0.0];
                impulse[row] = moved / times;
                let solution = by_hand(&problem, impulse);
                (residuals(&problem, &solution).unwrap(), by_contact(&problem, &solution).unwrap())
            };
            // friction under edges is the difference of two, each of which moves half as much
            assert!(found(0.49 * CERTIFY).0.is_solution(CERTIFY), "{law:?} {row} {times}");
            for moved in [2.1 * CERTIFY, 1e-3, 0.5] {
                let (whole, contacts) = found(moved);
                assert!(!whole.is_solution(CERTIFY), "{law:?} {row} {times}: {moved}");
                assert!(!contacts[0].accepts(CERTIFY) && contacts[1].accepts(CERTIFY), "{law:?} {row} {times}: {contacts:?}");
                let worst = contacts.iter().flat_map(|contact| contact.parts.map(|part| part.relative())).fold(0.0, f64::max);
                assert_eq!((worst, whole.judged.worst().1.contact), (whole.judged.relative(), 0), "{law:?} {row}");
            }
        }
    }
}

#[test]
fn a_contact_that_opens_anyway_may_be_moved_by_a_part_of_its_own_velocity() {
    // z₁ = 1 throws the third row open at 10⁸, whose own data are 1; z₀ moves it by 0.9 beside that
    let lcp = |z: f64| {
        let m = dmatrix![0.0, 0.0, 0.0; 0.0, 1.0, 0.0; 0.9 / z, 1e8, 0.0];
        let problem = ContactProblem::new(m, dvector![1.0, -1.0, 1.0]).rows_per_contact(1).build().unwrap();
        residuals(&problem, &by_hand(&problem, dvector![z, 1.0, 0.0])).unwrap().is_solution(CERTIFY)
    };
    assert!(lcp(1e-20) && !lcp(1e-2), "that is no rounding of 1");
}

#[test]
fn a_pull_that_counts_as_none_holds_its_own_contact_no_less_than_others() {
    // 1 − 4·10²⁰ z ≥ 2 asks for z < 0, which is nothing beside the impulse of the row that it meets
    let problem = ContactProblem::new(dmatrix![1.0, 0.0; 1.0, -4e20], dvector![-1.0, -2.0]).rows_per_contact(1).build().unwrap();
    assert!(!residuals(&problem, &by_hand(&problem, dvector![1.0, -0.25e-20])).unwrap().is_solution(0.1));
}

#[test]
fn only_where_w_is_not_shown_to_be_one_of_bodies_is_it_asked() {
    // one contact of two rows
    let stored = |w: DMatrix<f64>| ContactProblem::new(w, DVector::zeros(2)).rows_per_contact(2).friction(vec![0.0]).build().unwrap();
    let asked = |w: DMatrix<f64>| strangeness(&stored(w)) == 1.0;
    assert!(!asked(dmatrix![1e-20, 0.5; 0.5, 1e20]) && !asked(dmatrix![1e-20, 1.0; 1.0, 1e20]), "a light contact beside a heavy one");
    assert!(asked(dmatrix![1e-20, 2.0; 2.0, 1e20]), "with the entries of bodies it is none");
    assert!(asked(dmatrix![1.0, 8.0; -8.0, 1.0]) && !asked(dmatrix![1.0, 2.0; -2.0, 1.0]), "spinning bodies are asymmetric");
    assert!(asked(dmatrix![1.0, 1.0; 0.0, 0.0]) && asked(-DMatrix::identity(2, 2)));
    let any = stored(DMatrix::identity(2, 2)).into_builder().of_any_matrix().build().unwrap();
    assert!(strangeness(&any) == 1.0 && strangeness(&any.into_builder().build().unwrap()) == 1.0, "what is said of it stays");
    // of mass and Jacobian nothing is looked at
    let made = ContactProblem::from_dynamics(dmatrix![2.0], dmatrix![1.0; -1.0], &dvector![0.0]).rows_per_contact(1).build().unwrap();
    assert!(made.known_overreach() == Some(false) && stored(DMatrix::identity(2, 2)).known_overreach().is_none());
    assert!(made.clone().into_builder().build().unwrap().known_overreach() == Some(false));
    let replaced = made.into_builder().delassus(dmatrix![0.0, 1.0; 1.0, 0.0]).build().unwrap();
    assert_eq!(strangeness(&replaced), 1.0);
}

#[test]
fn contacts_whose_matrix_is_none_of_bodies_are_judged_as_any_matrix() {
    // entries of bodies, but not semidefinite: of two contacts that push each other and one that opens fast and holds both
    let w = dmatrix![1.0, -1.0, 1.0; -1.0, 1.0, 1.0; 1.0, 1.0, 2.0];
    let problem = |w: &DMatrix<f64>, q: [f64; 3]| {
        ContactProblem::new(w.clone(), DVector::from_row_slice(&q)).rows_per_contact(1).law(Law::Frictionless).build().unwrap()
    };
    let is_accepted = |problem: &ContactProblem, r: [f64; 3]| {
        residuals(problem, &by_hand(problem, DVector::from_row_slice(&r))).unwrap().is_solution(CERTIFY)
    };
    assert!(!is_accepted(&problem(&w, [-1e-3, -1e-3, 1e6]), [0.0, 0.0, 1e-3]), "there is no solution");
    assert!(is_accepted(&problem(&w, [-1e-3, 1.0, 1e6]), [1e-3, 0.0, 0.0]));
}

#[test]
fn what_an_impulse_moves_counts_with_how_far_the_matrix_is_from_one_of_bodies() {
    // the third contact opens fast and moves the first; the last two rows are redundant but for ε
    let judged = |epsilon: f64, moved: f64| {
        let mut w = DMatrix::identity(4, 4);
        (w[(0, 1)], w[(1, 0)]) = (0.5, 0.5);
        (w[(2, 3)], w[(3, 2)]) = (1.0 + epsilon, 1.0 + epsilon);
        let problem = ContactProblem::new(w, dvector![-1e-3, 1e6, 1.0, 1.0]).rows_per_contact(1).build().unwrap();
        residuals(&problem, &by_hand(&problem, dvector![1e-3 - 0.5 * moved, moved, 0.0, 0.0])).unwrap().is_solution(CERTIFY)
    };
    // half of the impulse is what it moves, beside τ times the 10⁻³ m/s at which the other closes
    for (epsilon, share) in [(1.0 / 8192.0, 1.0 / 8192.0), (0.5, 1.0)] {
        let most = 2.0 * CERTIFY * 1e-3 / share;
        assert!(judged(epsilon, 0.9 * most) && !judged(epsilon, 1.1 * most), "{epsilon}");
    }
    assert!(judged(0.0, 1e-3), "of bodies nothing is asked");
}

#[test]
fn a_problem_of_any_matrix_is_asked_whatever_its_entries_are() {
    // entries of bodies, or none larger than four times that: what opens holds the others alone
    let none = [
        (dmatrix![1.0, -4.0, 4.0; -4.0, 1.0, 4.0; 0.0, 0.0, 1.0], dvector![-1.0, -1.0, 1e9], dvector![0.0, 0.0, 0.25]),
        (dmatrix![1.0, -1.0, 1e-10; -1.0, 1.0, 1e-10; 1e-10, 1e-10, 1e-20], dvector![-1.0, -1.0, 1.0], dvector![0.0, 0.0, 1e10]),
        (dmatrix![1.0, -1.0, 1.0; -1.0, 1.0, 1.0; 1.0, 1.0, 2.0], dvector![-1e-3, -1e-3, 1e6], dvector![0.0, 0.0, 1e-3]),
        (dmatrix![1e-20, 1.0; 1.0, 2e20], dvector![1.0, -1.0], dvector![1.0, 0.0]),
        (dmatrix![1.0, 1.0; 1.0, 2.0], dvector![1.0, -1e-9], dvector![1e-9, 0.0]),
        (dmatrix![1e-10, 0.0; 4.0, 1e10], dvector![1.0, -1.0], dvector![0.25, 0.0]),
    ];
    for (matrix, vector, impulse) in none {
        let problem = ContactProblem::new(matrix, vector).rows_per_contact(1).of_any_matrix().build().unwrap();
        assert!(!residuals(&problem, &by_hand(&problem, impulse)).unwrap().is_solution(CERTIFY), "{:?}", problem.dense());
        if let Ok(right) = LemkePivoting.solve(&problem, None) {
            assert!(residuals(&problem, &right).unwrap().is_solution(CERTIFY), "{:?}", problem.dense());
        }
    }
}

/// 0 in some places, else ±2^k with |k| ≤ 40.
fn entry(draw: &mut Draw) -> f64 {
    match draw.whole(4) {
        -1..=1 => 0.0,
        of => f64::from(2 * i32::from(of > 0) - 1) * 2f64.powi(draw.whole(40) as i32),
    }
}

/// The least over all supports among z > 0 of the largest change of a row of q, relative to its largest term, by which z, with the entries
/// outside of the support taken away, is an exact solution.
fn change(lcp: &Lcp<f64>, z: &DVector<f64>) -> f64 {
    let size = z.len();
    let of = |support: usize| {
        let left = DVector::from_fn(size, |i, _| if support >> i & 1 == 1 { z[i] } else { 0.0 });
        let row = |i: usize| {
            let products = (0..size).map(|j| exact(lcp.matrix[(i, j)]) * exact(left[j]));
            let slack = products.fold(exact(lcp.vector[i]), |sum: Rational, product| sum + product);
            let off = if left[i] > 0.0 { slack.magnitude() } else { (-slack).max(Rational::ZERO) };
            let largest = (0..size).map(|j| (lcp.matrix[(i, j)] * left[j]).abs()).fold(lcp.vector[i].abs(), f64::max);
            if off.is_zero() { 0.0 } else { off.to_f64().value() / largest }
        };
        (0..size).map(row).fold(0.0, f64::max)
    };
    let is_pushing = |support: &usize| (0..size).all(|i| support >> i & 1 == 0 || z[i] > 0.0);
    (0..1 << size).filter(is_pushing).map(of).fold(f64::INFINITY, f64::min)
}

/// Of n rows each part that is taken away changes a row by at most τ of its scale, and so does a velocity that is not quite zero; a scale
/// is a sum of at most n + 1 terms. Pivoting proposes, and what it leaves at zero is made small instead.
#[test]
fn an_accepted_answer_solves_a_problem_near_whatever_the_entries_are() {
    let (mut draw, mut accepted) = (Draw(7), 0);
    for trial in 0..300 {
        let size = 2 + draw.whole(1).unsigned_abs() as usize + draw.whole(1).unsigned_abs() as usize;
        let matrix = DMatrix::from_fn(size, size, |i, j| if i == j && trial % 2 == 0 { entry(&mut draw).abs() } else { entry(&mut draw) });
        let lcp = Lcp::new(matrix, DVector::from_fn(size, |_, _| entry(&mut draw)));
        let problem = ContactProblem::new(lcp.matrix.clone(), lcp.vector.clone()).rows_per_contact(1).build().unwrap();
        if let Ok(answer) = LemkePivoting.solve(&problem, None) {
            let little = answer.impulse.amax() * 2f64.powi(-30 - draw.whole(60).abs() as i32);
            let spoilt = answer.impulse.map(|z| if z == 0.0 && draw.whole(1) != 0 { little } else { z });
            for impulse in [answer.impulse, spoilt] {
                let solution = by_hand(&problem, impulse);
                if residuals(&problem, &solution).unwrap().is_solution(CERTIFY) {
                    accepted += 1;
                    let most = ((size + 1) * (size + 1)) as f64 * (CERTIFY + gamma(2 * size + 8));
                    let changed = change(&lcp, &solution.impulse);
                    assert!(changed <= most, "{trial}: {changed:e} {lcp:?} {}", solution.impulse);
                }
            }
        }
    }
    assert!(accepted > 150, "{accepted}");
}
