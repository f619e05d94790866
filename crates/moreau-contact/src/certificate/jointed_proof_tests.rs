//! Proofs beside joints on problems whose solution is known in numbers, and on answers that were moved.

use super::*;
use crate::certificate::draw::Draw;
use crate::certificate::planted::{Plant, with};
use crate::contact::delassus::delassus;
use crate::problem::{ConstraintKind, Dynamics, Law};
use crate::tolerance::sharpness::{EXCESS, FAR, FEW, MANY, NEAR, roundings};
use moreau_exact::scalar::{Rational, exact};
use nalgebra::{DMatrix, dmatrix, dvector};

const MU: f64 = 0.75;

/// A pin of two rows, a stop, two contacts in space and a rod, W = G Gᵀ + I with whole G, and a solution in whole numbers, halves and
/// quarters: a sliding contact has r = c (20, −12, −9), y_t = (2, 3/2) and y_n = 0 or, associated, ¾ · 5/2; joints pull and push.
fn known(law: Law, seed: u64) -> (JointedProblem, Solution) {
    let kinds = [
        ConstraintKind::Bilateral { rows: 2 },
        ConstraintKind::Limit,
        ConstraintKind::Contact,
        ConstraintKind::Bilateral { rows: 1 },
        ConstraintKind::Contact,
    ];
    let (mut draw, n) = (Draw(seed), 10);
    let factor = DMatrix::from_fn(n, n, |_, _| draw.whole(2) as f64);
    let w = &factor * factor.transpose() + DMatrix::identity(n, n);
    let (mut r, mut y) = (DVector::zeros(n), DVector::zeros(n));
    [0, 1, 6].into_iter().for_each(|row| r[row] = draw.whole(9) as f64);
    let opens = draw.whole(10) > 0;
    if opens {
        y[2] = 3.0
    } else {
        r[2] = 2.0
    }
    for first in [3, 7] {
        let size = 1.0 + draw.whole(3).abs() as f64;
        match draw.whole(30).unsigned_abs() % 3 {
            0 => y.rows_mut(first, 3).copy_from_slice(&[8.0 * size, 3.0, -1.0]),
            1 => r.rows_mut(first, 3).copy_from_slice(&[10.0 * size, 3.0, 4.0]),
            _ => {
                r.rows_mut(first, 3).copy_from_slice(&[20.0 * size, -12.0 * size, -9.0 * size]);
                y.rows_mut(first, 3).copy_from_slice(&[if law == Law::Associated { MU * 2.5 } else { 0.0 }, 2.0, 1.5]);
            }
        }
        if law == Law::Frictionless && r[first] > 0.0 {
            r.rows_mut(first + 1, 2).fill(0.0);
            y[first] = 0.0;
        }
    }
    let free = &y - &w * &r;
    let friction = vec![0.0, 0.0, MU, 0.0, MU];
    let problem = JointedProblem::new(3, kinds.to_vec(), w, free).unwrap().law(law, friction).unwrap();
    (problem, Solution::new("by construction", r, y, 0))
}

fn norm(problem: &JointedProblem, difference: &DVector<f64>, k: usize) -> f64 {
    let rows = problem.rows_of(k);
    difference.rows(rows.start, rows.len()).norm()
}

#[test]
fn a_solution_that_is_known_is_proved_as_it_stands_and_is_within_every_radius() {
    for law in [Law::Frictionless, Law::Coulomb, Law::Associated] {
        let mut proved = 0;
        for seed in 0..30 {
            let (problem, solution) = known(law, seed);
            let backward = backward_jointed(&problem, &solution.impulse).unwrap();
            assert!(backward.velocity.iter().chain(&backward.impulse).all(|size| *size <= roundings(MANY)), "{law:?} {seed} {backward:?}");
            assert_eq!((backward.states[0], backward.states[3]), (HeldAs::Joined, HeldAs::Joined));
            for size in NEAR {
                let mut draw = Draw(seed + 1000);
                let mut answer = solution.clone();
                answer.impulse.iter_mut().filter(|r| **r != 0.0).for_each(|r| *r += size * draw.whole(100) as f64 / 100.0);
                answer.velocity = problem.velocity(&answer.impulse);
                let Forward::Proved(radius) = forward_jointed(&problem, &answer).unwrap().near else { continue };
                proved += 1;
                let scale = solution.impulse.amax() * problem.delassus().amax();
                let [velocity, impulse] = [&answer.velocity - &solution.velocity, &answer.impulse - &solution.impulse];
                for k in 0..problem.kinds().len() {
                    let spacing = 1.0 - 8.0 * f64::EPSILON;
                    assert!(radius.velocity[k] >= spacing * norm(&problem, &velocity, k), "{law:?} {seed} {size} {k}: {radius:?}");
                    assert!(radius.impulse[k] >= spacing * norm(&problem, &impulse, k), "{law:?} {seed} {size} {k}: {radius:?}");
                    assert!(radius.velocity[k] <= norm(&problem, &velocity, k) + EXCESS * scale, "{law:?} {seed} {size}: {radius:?}");
                }
            }
        }
        assert!(proved >= 80, "{law:?}: {proved} of 90");
    }
}

/// Proofs that say less than what an answer was moved by. Under the associated law W ⪰ I leaves impulses that solve the problem with q + δ
/// within ‖δ‖ of the only solution; a limit in place of a joint is seen where the joint opens.
fn contradicted() -> usize {
    let mut found = 0;
    for seed in 0..12 {
        let (problem, solution) = known(Law::Associated, seed);
        for distance in FAR {
            for row in 0..problem.rows() {
                let mut answer = solution.clone();
                answer.impulse[row] += distance;
                answer.velocity = problem.velocity(&answer.impulse);
                let proof = backward_jointed(&problem, &answer.impulse).unwrap();
                let size = |of: &[f64]| of.iter().map(|x| x * x).sum::<f64>().sqrt();
                found += usize::from(size(&proof.velocity) + size(&proof.impulse) < distance - roundings(MANY));
                if let Forward::Proved(radius) = forward_jointed(&problem, &answer).unwrap().near {
                    let moved = size(&radius.impulse).max(size(&radius.velocity));
                    found += usize::from(moved < 0.999 * distance);
                }
            }
        }
    }
    // the rod pulls in both, and no answer without its impulse is near a solution
    found += usize::from(takes_a_pull());
    let rod = JointedProblem::new(1, vec![ConstraintKind::Bilateral { rows: 1 }], dmatrix![1.0], dvector![1.0]).unwrap();
    let loose = Solution::new("", dvector![0.0], dvector![1.0], 0);
    let proof = backward_jointed(&rod, &loose.impulse).unwrap();
    found += usize::from(proof.velocity[0] + proof.impulse[0] < 1.0);
    if let Forward::Proved(radius) = forward_jointed(&rod, &loose).unwrap().near {
        found += usize::from(radius.velocity[0] < 1.0);
    }
    found
}

/// Whether it is believed that a rod stops 3 N·s while a limit pulls 4 N·s, which moves it by 2 m/s: the limit does not pull, and r = (0,
/// 1) is the only solution, W ⪰ ½.
fn takes_a_pull() -> bool {
    let kinds = vec![ConstraintKind::Limit, ConstraintKind::Bilateral { rows: 1 }];
    let problem = JointedProblem::new(1, kinds, dmatrix![1.0, 0.5; 0.5, 1.0], dvector![2.5, -1.0]).unwrap();
    let proof = backward_jointed(&problem, &dvector![-4.0, 3.0]).unwrap();
    proof.impulse[1] + 2.0 * proof.velocity.iter().map(|x| x * x).sum::<f64>().sqrt() < 2.0
}

#[test]
fn every_mistake_planted_beside_joints_is_contradicted_by_known_solutions_and_the_proofs_are_not() {
    assert_eq!(with(None, contradicted), 0);
    for plant in [Plant::Joined, Plant::Moved, Plant::Radius] {
        assert!(with(Some(plant), contradicted) > 0, "{plant:?}");
    }
}

/// One rod so many times, with these velocities along it.
fn rods(velocities: &[f64]) -> JointedProblem {
    let n = velocities.len();
    let kinds = vec![ConstraintKind::Bilateral { rows: 1 }; n];
    JointedProblem::new(1, kinds, DMatrix::from_element(n, n, 1.0), DVector::from_row_slice(velocities)).unwrap()
}

#[test]
fn a_rod_that_is_there_twice_is_proved_in_velocity_and_leaves_one_dimension_of_impulses() {
    let problem = rods(&[-1.0, -1.0]);
    for shared in [0.5, 3.0, -2.0] {
        let answer = Solution::new("", dvector![shared, 1.0 - shared], dvector![0.0, 0.0], 0);
        let found = forward_jointed(&problem, &answer).unwrap();
        let radius = found.near.proved().expect("it is a solution");
        assert_eq!((radius.dependent.len(), &radius.states[..]), (1, &[ContactState::Joined; 2][..]));
        assert!(radius.velocity.iter().all(|bound| *bound == 0.0));
        assert_eq!(found.impulses, Some(ImpulseSet { at_least: 1, at_most: 1 }));
    }
}

#[test]
fn rods_that_contradict_each_other_are_never_proved_to_have_a_solution_and_the_constraint_is_named() {
    let problem = rods(&[-1.0, -1.0, -1.5]);
    let mut draw = Draw(5);
    for _ in 0..200 {
        let impulse = DVector::from_fn(3, |_, _| draw.whole(400) as f64 / 100.0);
        let answer = Solution::new("guessed", impulse.clone(), problem.velocity(&impulse), 0);
        let Forward::NotProved(reason) = forward_jointed(&problem, &answer).unwrap().near else { panic!("there is none") };
        assert!(reason.text.contains("free velocities that do not (constraint "), "{reason:?}");
        let proof = backward_jointed(&problem, &impulse).unwrap();
        assert!(proof.velocity.iter().sum::<f64>() >= 0.5, "{proof:?}");
    }
}

#[test]
fn a_soft_joint_has_the_velocity_that_its_impulse_leaves() {
    let problem = JointedProblem::new(1, vec![ConstraintKind::Bilateral { rows: 1 }], dmatrix![1.0], dvector![-1.0]).unwrap();
    let problem = problem.shift(dvector![0.25]).unwrap().softness(dvector![0.5]).unwrap();
    let answer = |r: f64| Solution::new("", dvector![r], problem.velocity(&dvector![r]), 0);
    let radius = forward_jointed(&problem, &answer(0.5)).unwrap().near.proved().expect("a solution");
    assert!(radius.velocity[0] <= roundings(MANY) && radius.impulse[0] <= roundings(MANY), "{radius:?}");
    assert_eq!(backward_jointed(&problem, &dvector![0.5]).unwrap().velocity, [0.0]);
    let radius = forward_jointed(&problem, &answer(0.75)).unwrap().near.proved().expect("a solution is near");
    assert!(radius.impulse[0] >= 0.25 && radius.velocity[0] >= 0.25, "{radius:?}");
    assert_eq!(backward_jointed(&problem, &dvector![0.75]).unwrap().velocity, [0.375]);
}

#[test]
fn polyhedral_contacts_beside_joints_are_proved_backward_and_forward() {
    let kinds = vec![ConstraintKind::Bilateral { rows: 1 }, ConstraintKind::Contact];
    let problem = JointedProblem::new(3, kinds, DMatrix::identity(4, 4), dvector![1.0, -1.0, 2.0, 0.0]).unwrap();
    let problem = problem.law(Law::PolyhedralCoulomb { directions: 4 }, vec![0.0, 0.5]).unwrap();
    let impulse = dvector![-1.0, 1.0, -0.5, 0.0];
    let proof = backward_jointed(&problem, &impulse).unwrap();
    assert_eq!((proof.velocity, proof.states), (vec![0.0; 2], vec![HeldAs::Joined, HeldAs::Sliding]));
    let answer = Solution::new("", impulse.clone(), problem.velocity(&impulse), 0);
    let NearJointed { near, impulses } = forward_jointed(&problem, &answer).unwrap();
    let radius = near.proved().expect("it slides along an edge");
    assert_eq!(radius.states, [ContactState::Joined, ContactState::Sliding]);
    assert!(radius.velocity.iter().chain(&radius.impulse).all(|bound| *bound <= roundings(FEW)), "{radius:?}");
    // W is the identity, so that one impulse gives the velocity; of polygons it is bounded by the rank of all rows
    assert_eq!(impulses, Some(ImpulseSet { at_least: 0, at_most: 0 }));
    let moved = &impulse + dvector![0.25, 0.0, 0.0, 0.0];
    let answer = Solution::new("", moved.clone(), problem.velocity(&moved), 0);
    let radius = forward_jointed(&problem, &answer).unwrap().near.proved().expect("the same solution");
    for bounds in [&radius.velocity, &radius.impulse] {
        assert!(bounds[0] >= 0.25 && bounds[0] <= 0.25 + roundings(FEW) && bounds[1] <= roundings(FEW), "{radius:?}");
    }
}

#[test]
fn two_solutions_with_different_velocities_are_never_called_unique() {
    // beside an indefinite W a rod may hold with any impulse of the wall: r_n = 0 or 1
    let kinds = vec![ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }];
    let problem = JointedProblem::new(1, kinds.clone(), dmatrix![1.0, 2.0; 2.0, 1.0], dvector![3.0, 0.0]).unwrap();
    let problem = problem.law(Law::Frictionless, vec![0.0; 2]).unwrap();
    // y_n = 3 + r_n + 2 r_b, r_b = −2 r_n: y_n = 3 − 3 r_n
    for normal in [0.0, 1.0] {
        let impulse = dvector![normal, -2.0 * normal];
        let answer = Solution::new("", impulse.clone(), problem.velocity(&impulse), 0);
        assert!(matches!(forward_jointed(&problem, &answer).unwrap().near, Forward::Proved(_)), "{normal}");
    }
    assert!(matches!(uniqueness_jointed(&problem).unwrap(), Uniqueness::Unknown(_)));
    let tame = JointedProblem::new(1, kinds, dmatrix![2.0, 1.0; 1.0, 2.0], dvector![3.0, 0.0]).unwrap();
    assert!(matches!(uniqueness_jointed(&tame.law(Law::Frictionless, vec![0.0; 2]).unwrap()).unwrap(), Uniqueness::Solution(_)));
}

/// A witness of a problem with joints, held against W and q themselves.
fn refuted(problem: &JointedProblem) -> bool {
    let Some(found) = infeasible_jointed(problem).unwrap() else { return false };
    let p = &found.witness;
    let sum = |terms: &dyn Fn(usize) -> Rational| (0..problem.rows()).fold(Rational::ZERO, |sum, row| sum + &p[row] * terms(row));
    assert_eq!(p.len(), problem.rows());
    assert!(sum(&|row| exact(problem.free_velocity()[row]) + exact(problem.shifts()[row])) < Rational::ZERO);
    for k in 0..problem.kinds().len() {
        let rows = problem.rows_of(k);
        let moved = |column: usize| sum(&|row| exact(problem.delassus()[(row, column)])) + exact(problem.softnesses()[column]) * &p[column];
        match problem.kinds()[k] {
            ConstraintKind::Bilateral { .. } => assert!(rows.into_iter().all(|row| moved(row).is_zero())),
            _ => {
                assert!(p[rows.start] >= Rational::ZERO && moved(rows.start) <= Rational::ZERO);
                assert!(rows.skip(1).all(|row| p[row].is_zero()));
            }
        }
    }
    true
}

#[test]
fn what_has_a_solution_is_never_refuted_and_what_contradicts_itself_is() {
    for law in [Law::Frictionless, Law::Coulomb, Law::Associated] {
        assert!((0..10).all(|seed| !refuted(&known(law, seed).0)), "{law:?}");
    }
    for count in [2, 5, 30] {
        let mut velocities = vec![-1.0; count];
        assert!(!refuted(&rods(&velocities)));
        // rounded numbers propose the witness of many
        velocities[count - 1] = -1.0 - if count > 12 { 2.0_f64.powi(-20) } else { f64::EPSILON };
        assert!(refuted(&rods(&velocities)), "{count} rods");
        let soft = rods(&velocities).softness(DVector::from_element(count, 0.5)).unwrap();
        assert!(!refuted(&soft), "soft ones give way");
    }
    // a rod along the normal of a wall holds the body where the wall is: a limit in its place would let it go
    let held = |kind: ConstraintKind, speed: f64| {
        let kinds = vec![ConstraintKind::Contact, kind];
        JointedProblem::new(1, kinds, dmatrix![1.0, 1.0; 1.0, 1.0], dvector![speed, 0.0]).unwrap()
    };
    let rod = ConstraintKind::Bilateral { rows: 1 };
    assert!(refuted(&held(rod, -1.0)) && !refuted(&held(rod, 1.0)) && !refuted(&held(ConstraintKind::Limit, -1.0)));
}

#[test]
fn wrong_sizes_and_what_is_no_number_are_refused() {
    let problem = rods(&[-1.0, -1.0]);
    assert!(backward_jointed(&problem, &dvector![1.0]).is_err() && backward_jointed(&problem, &dvector![f64::NAN, 0.0]).is_err());
    for (impulse, velocity) in [(dvector![1.0], dvector![0.0, 0.0]), (dvector![f64::INFINITY, 0.0], dvector![0.0, 0.0])] {
        assert!(forward_jointed(&problem, &Solution::new("", impulse, velocity, 0)).is_err());
    }
    let overflown = Solution::new("", dvector![1.0, 0.0], dvector![f64::INFINITY, 0.0], 0);
    assert!(matches!(forward_jointed(&problem, &overflown).unwrap().near, Forward::NotProved(_)));
}

/// Rows a, b and a + b of one body of 7 kg along one axis and 3 kg along another: of H they are dependent, of the rounded W they are not.
#[test]
fn rows_that_repeat_others_are_told_by_mass_and_rows_and_not_by_a_rounded_w() {
    let rows = dmatrix![0.0, 0.0, 1.0; 3.0, 1.0, 0.0; 1.0, -2.0, 0.0; 4.0, -1.0, 0.0];
    let dynamics = Dynamics { mass: DMatrix::from_diagonal(&dvector![7.0, 3.0, 7.0]), jacobian: rows.clone() };
    let w = delassus(&dynamics.mass, &rows).unwrap();
    let kinds = [vec![ConstraintKind::Contact], vec![ConstraintKind::Bilateral { rows: 1 }; 3]].concat();
    let free = dvector![-1.0, 0.5, -0.25, 0.25];
    let alone = JointedProblem::new(1, kinds, w.clone(), free.clone()).unwrap().law(Law::Frictionless, vec![0.0; 4]).unwrap();
    let known = alone.clone().made_of(Some(dynamics)).unwrap();
    let joints = w.view((1, 1), (2, 2)).into_owned().lu().solve(&-free.rows(1, 2).into_owned()).unwrap();
    let impulse = dvector![7.0, joints[0], joints[1], 0.0];
    let answer = Solution::new("by elimination", impulse.clone(), alone.velocity(&impulse), 0);
    assert!(matches!(forward_jointed(&alone, &answer).unwrap().near, Forward::NotProved(_)));
    let near = forward_jointed(&known, &answer).unwrap().near.proved().expect("its rows depend exactly on each other");
    assert!(near.worst().unwrap().1 <= roundings(MANY) && near.dependent.len() == 1, "{near:?}");
    assert_eq!(near.bodies.map(|bodies| bodies.len()), Some(3), "velocities of the body, none of rows that were added");
}
