//! The closed form of a bob on a rod, and answers with one mistake each.

use super::*;
use crate::problem::{ConstraintKind, Law};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

/// A bob of 1 kg at (−3, 1) m/s on a rod along (3, 4)/5 hits a wall with normal (1, 0); (3.75, −1.25) N·s stop it.
fn bob() -> JointedProblem {
    let kinds = vec![ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }];
    let problem = JointedProblem::new(1, kinds, dmatrix![1.0, 0.6; 0.6, 1.0], dvector![-3.0, -1.0]).unwrap();
    problem.law(Law::Frictionless, vec![0.0; 2]).unwrap()
}

fn judged(problem: &JointedProblem, impulse: DVector<f64>) -> JointedResiduals {
    let velocity = problem.velocity(&impulse);
    jointed_residuals(problem, &Solution::new("by hand", impulse, velocity, 0)).unwrap()
}

#[test]
fn the_closed_form_is_accepted_to_rounding() {
    let found = judged(&bob(), dvector![3.75, -1.25]);
    assert!(found.is_solution(0.0) && found.relative() == 0.0, "{found:?}");
    assert_eq!(found.bilateral.unwrap().contact, 1);
}

#[test]
fn a_wrong_sign_a_missing_joint_and_a_small_error_are_rejected_at_the_joint() {
    for impulse in [dvector![3.75, 1.25], dvector![3.0, 0.0], dvector![3.75, -1.25 + 1e-6]] {
        let found = judged(&bob(), impulse.clone());
        let worst = found.bilateral.expect("a joint");
        assert!(!found.is_solution(1e-8) && worst.part.relative() > 1e-7 && worst.contact == 1, "{impulse}: {found:?}");
    }
    // without the joint the contact alone would be satisfied: this is what leaving its row out of the certificate would accept
    assert!(judged(&bob(), dvector![3.0, 0.0]).contacts.is_solution(1e-8));
    assert!((judged(&bob(), dvector![3.0, 0.0]).bilateral.unwrap().part.value - 0.8).abs() < 1e-15);
}

#[test]
fn a_contact_that_is_wrong_is_told_by_its_number_among_the_kinds() {
    let kinds = vec![ConstraintKind::Bilateral { rows: 1 }, ConstraintKind::Contact];
    let problem = JointedProblem::new(1, kinds, dmatrix![1.0, 0.6; 0.6, 1.0], dvector![-1.0, -3.0]).unwrap();
    let found = judged(&problem, dvector![1.0, 0.0]);
    assert_eq!(found.contacts.judged.worst().1.contact, 1);
    assert!(!found.contacts.is_solution(1e-8));
}

#[test]
fn a_stored_velocity_of_a_joint_is_held_against_its_impulses() {
    let impulse = dvector![3.75, -1.25];
    let answer = |moved: f64| Solution::new("by hand", impulse.clone(), bob().velocity(&impulse) + dvector![0.0, moved], 0);
    assert!(jointed_residuals(&bob(), &answer(0.0)).unwrap().is_solution(1e-8));
    let found = jointed_residuals(&bob(), &answer(1e-6)).unwrap();
    assert!(!found.is_solution(1e-8) && found.contacts.judged.velocity.contact == 1 && found.bilateral.unwrap().part.relative() == 0.0);
}

#[test]
fn joints_that_push_against_each_other_excuse_no_velocity() {
    // the rod twice: impulses (t, −t) of the two move nothing
    let kinds = vec![ConstraintKind::Bilateral { rows: 1 }; 2];
    let problem = JointedProblem::new(1, kinds, DMatrix::from_element(2, 2, 1.0), dvector![-1.0, -1.0]).unwrap();
    assert!(judged(&problem, dvector![1.0, 0.0]).is_solution(0.0));
    assert!(judged(&problem, dvector![1024.0, -1023.0]).is_solution(1e-8), "a solution stays one");
    let moving = judged(&problem, dvector![1.0 - 1e-4 + 1024.0, -1024.0]);
    assert!(!moving.is_solution(1e-8) && moving.bilateral.unwrap().part.relative() > 0.9e-4, "{moving:?}");
    // where rounding hides everything, it is a residual itself
    assert!(!judged(&problem, dvector![1e15, -1e15]).is_solution(1e-8));
}

#[test]
fn what_a_jaw_never_meets_and_what_leaves_excuses_nothing_there() {
    // a jaw closes at 10⁻⁴ m/s, with impulses that push against each other; beside it a joint, and a point at 100 m/s on the joint's body
    let [contact, joint] = [ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }];
    let judged = |coupled: f64, point: f64, order: [usize; 4]| {
        let w = dmatrix![1.0, -1.0, coupled, 0.0; -1.0, 1.0, -coupled, 0.0; coupled, -coupled, 2.0, 1.0; 0.0, 0.0, 1.0, 1.0];
        // 2 r_b + r_n = 0 and r_b + r_n = 100
        let [held, pressed] = if point < 0.0 { [point, -2.0 * point] } else { [0.0, 0.0] };
        let (free, impulse, kinds) = ([-1e-4, -1e-4, 0.0, point], [1e5, 1e5, held, pressed], [contact, contact, joint, contact]);
        let w = DMatrix::from_fn(4, 4, |i, j| w[(order[i], order[j])]);
        let [free, impulse] = [free, impulse].map(|all| DVector::from_fn(4, |i, _| all[order[i]]));
        let problem = JointedProblem::new(1, order.map(|k| kinds[k]).to_vec(), w, free).unwrap();
        judged(&problem.law(Law::Frictionless, vec![0.0; 4]).unwrap(), impulse)
    };
    for order in [[0, 1, 2, 3], [3, 2, 1, 0], [2, 0, 3, 1]] {
        for (coupled, point) in [(0.0, -100.0), (0.0, 100.0), (1e-300, 100.0)] {
            let found = judged(coupled, point, order);
            assert!(!found.is_solution(1e-8) && found.contacts.judged.loaded > 1e8, "{order:?}: {found:?}");
        }
        // joined with a point that closes so fast, 10⁻⁵ of its velocity pass, for its impulse might be what loads the jaw
        let joined = judged(1e-300, -100.0, order);
        assert!(joined.is_solution(1e-8) && joined.contacts.judged.loaded == 1e3, "{order:?}: {joined:?}");
    }
}

#[test]
fn a_contact_that_joints_hold_fast_is_judged_by_what_it_would_do_without_them() {
    // two rods hold the bob; what is left at the wall is rounding, and is no residual
    let rows = dmatrix![1.0, 0.0; 0.6, 0.8; -0.3, 0.7];
    let kinds = [ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }, ConstraintKind::Bilateral { rows: 1 }];
    let free = &rows * dvector![-0.3, 0.1];
    let problem = JointedProblem::new(1, kinds.to_vec(), &rows * rows.transpose(), free).unwrap();
    // r_1 (0.6, 0.8) + r_2 (−0.3, 0.7) = (0.3, −0.1) by Cramer's rule
    let held = dvector![0.0, (0.3 * 0.7 - 0.1 * 0.3) / 0.66, (-0.1 * 0.6 - 0.3 * 0.8) / 0.66];
    assert!(judged(&problem, held.clone()).is_solution(1e-12), "{:?}", judged(&problem, held.clone()));
    for (row, moved) in [(0, -1e-6), (1, 1e-6), (2, -1e-6)] {
        let mut other = held.clone();
        other[row] += moved;
        assert!(!judged(&problem, other).is_solution(1e-8), "{row}");
    }
}

#[test]
fn softness_and_shift_belong_to_the_velocity_of_a_joint() {
    let kinds = vec![ConstraintKind::Bilateral { rows: 1 }];
    let problem = JointedProblem::new(1, kinds, dmatrix![1.0], dvector![-1.0]).unwrap();
    let problem = problem.shift(dvector![0.25]).unwrap().softness(dvector![0.5]).unwrap();
    assert!(judged(&problem, dvector![0.5]).is_solution(0.0));
    assert!(!judged(&problem, dvector![0.75]).is_solution(1e-8) && !judged(&problem, dvector![1.0]).is_solution(1e-8));
}

#[test]
fn answers_of_another_size_and_what_is_no_number_are_no_solutions() {
    let short = Solution::new("", dvector![1.0], dvector![1.0, 2.0], 0);
    assert!(jointed_residuals(&bob(), &short).expect_err("one row").to_string().contains("`impulse`"));
    for impulse in [dvector![f64::NAN, 0.0], dvector![3.75, f64::NAN], dvector![3.75, f64::INFINITY], dvector![1e308, 1e308]] {
        let answer = Solution::new("", impulse.clone(), dvector![0.0, 0.0], 0);
        let message = jointed_residuals(&bob(), &answer).map(|found| found.is_solution(1e-8));
        assert!(message.is_err() || message.is_ok_and(|accepted| !accepted), "{impulse}");
    }
    let nan = Solution::new("", dvector![3.75, -1.25], dvector![f64::NAN, f64::NAN], 0);
    assert!(!jointed_residuals(&bob(), &nan).unwrap().is_solution(1e-8));
}

/// Three contacts and a joint, in the order `order` of (contact 1, 2, 3, joint): the first opens at 10⁶ m/s, and what it pushes reaches the
/// others through the joint alone. Beside it the joint moves at `joint` m/s, the two others at `others`.
fn through_a_joint(w_23: f64, joint: f64, others: f64, order: [usize; 4]) -> JointedProblem {
    let w_12 = if w_23 < 0.0 { 0.0 } else { -1e-3 };
    let w = dmatrix![1e-6, w_12, w_12, 1e-3; w_12, 1.0, w_23, -1.0; w_12, w_23, 1.0, -1.0; 1e-3, -1.0, -1.0, 1.0];
    let q = [1e6, others, others, joint];
    let kinds = order.map(|i| if i == 3 { ConstraintKind::Bilateral { rows: 1 } } else { ConstraintKind::Contact });
    let w = DMatrix::from_fn(4, 4, |i, j| w[(order[i], order[j])]);
    let problem = JointedProblem::new(1, kinds.to_vec(), w, DVector::from_fn(4, |i, _| q[order[i]])).unwrap();
    problem.law(Law::Frictionless, vec![0.0; 4]).unwrap()
}

const ORDERS: [[usize; 4]; 3] = [[0, 1, 2, 3], [3, 0, 1, 2], [2, 3, 1, 0]];

#[test]
fn an_impulse_that_counts_as_none_carries_no_contact_through_a_joint() {
    // Without the joint's impulse W is [0, 1, 1; 1, 0, −2500; 1, −2500, 0]/1000: the last two rows ask for 1000 N·s of the first contact,
    // which opens, and there is no solution.
    for order in ORDERS {
        let problem = through_a_joint(-1.5, 0.0, -1.0, order);
        let impulse = DVector::from_fn(4, |i, _| [1e3, 0.0, 0.0, -1.0][order[i]]);
        let found = judged(&problem, impulse);
        let (name, worst) = found.contacts.judged.worst();
        assert!(!found.is_solution(0.5) && found.bilateral.unwrap().part.relative() == 0.0, "{found:?}");
        assert_eq!((name, order[worst.contact]), ("normal", 0));
    }
}

#[test]
fn an_impulse_that_counts_as_none_may_move_a_joint_by_what_it_is_judged_by_where_w_is_none_of_bodies_and_no_more() {
    for order in ORDERS {
        let problem = through_a_joint(-1.5, 1.0, 1.0, order);
        let found = |moved: f64| {
            let impulse = DVector::from_fn(4, |i, _| [moved * 1e3, 0.0, 0.0, -1.0 - moved][order[i]]);
            judged(&problem, impulse).is_solution(1e-8)
        };
        assert!(found(0.0) && found(0.9e-8));
        assert!(!found(1.1e-8) && !found(1e-3) && !found(1.0));
        // of bodies, rows (10⁻³), (−1), (−1), (1) of one of 1 kg, nothing is asked
        let bodies = through_a_joint(1.0, 1.0, 1.0, order);
        let impulse = DVector::from_fn(4, |i, _| [1.0, 0.0, 0.0, -1.0 - 1e-3][order[i]]);
        assert!(judged(&bodies, impulse).is_solution(1e-8));
    }
}

#[test]
fn what_the_impulses_of_joints_move_excuses_no_velocity_of_a_contact() {
    // Three bodies of 1 kg, a contact with μ = 2 and a joint: r_b = −(r_n − 4 r_t)/3 holds the joint, and of the contact are left
    // 3 y = [32, 16; 16, 8] r + (−3, 3), whose second row is half of the first but for q: no impulse stops it where the law asks for it.
    let w = dmatrix![11.0, 4.0, 1.0; 4.0, 8.0, -4.0; 1.0, -4.0, 3.0];
    let kinds = vec![ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }];
    let problem = JointedProblem::new(2, kinds, w, dvector![-1.0, 1.0, 0.0]).unwrap().law(Law::Coulomb, vec![2.0, 0.0]).unwrap();
    for pushed in [1e2, 1e4, 1e8] {
        // the contact and the joint push against each other: (1, −2, −3) moves nothing
        let found = judged(&problem, dvector![1.0, -2.0, -3.0] * pushed);
        assert!(!found.is_solution(1e-8), "{pushed}: {found:?}");
        assert!(found.contacts.judged.relative() >= 0.5e-3, "{pushed}: V is 1 m/s, and y_n −1 of it");
    }
}

#[test]
fn a_joint_whose_free_velocity_and_shift_cancel_is_judged_by_what_is_left() {
    for q in [4.0 * f64::EPSILON, -2f64.powi(-42), 2f64.powi(-30)] {
        // a joint alone, and one beside a contact that it moves half as much and that closes or opens as it would
        let kinds = [ConstraintKind::Bilateral { rows: 1 }, ConstraintKind::Contact];
        let of = |rows: usize| {
            let w = DMatrix::from_fn(rows, rows, |i, j| if i == j { 1.0 } else { 0.5 });
            let problem = JointedProblem::new(1, kinds[..rows].to_vec(), w, DVector::from_element(rows, -2.0)).unwrap();
            problem.shift(DVector::from_element(rows, 2.0 + q)).unwrap().law(Law::Frictionless, vec![0.0; rows]).unwrap()
        };
        assert!(judged(&of(1), dvector![-q]).is_solution(1e-8), "{q:e}");
        assert!(!judged(&of(1), dvector![-1.001 * q]).is_solution(1e-8) && !judged(&of(1), dvector![0.0]).is_solution(1e-8), "{q:e}");
        // without the joint's impulse the contact has q, and with it q/2; together −(2/3) q each
        let beside = if q > 0.0 { dvector![-q, 0.0] } else { dvector![-q, -q] / 1.5 };
        assert!(!judged(&of(2), &beside * 1.001).is_solution(1e-8), "{q:e}");
        // what the joint moves is added to −2 m/s, which rounds
        assert!(q.abs() < 1e-10 || judged(&of(2), beside).is_solution(1e-8), "{q:e}");
    }
}
