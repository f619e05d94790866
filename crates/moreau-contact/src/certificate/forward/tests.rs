//! Proofs on problems whose solution is known in fractions, and attempts to obtain a wrong one.

use super::*;
use crate::certificate::backward::backward;
use crate::certificate::draw::Draw;
use crate::certificate::planted::with;
use crate::problem::{Compliance, Law};
use crate::tolerance::sharpness::{EXCESS, FAR, FEW, MANY, NEAR, REDUNDANT, SOME, roundings};
use moreau_exact::scalar::{Rational, exact};
use nalgebra::{DVector, dvector};

/// Of all contacts below.
const MU: f64 = 0.75;
/// Of length five: what is made of them is whole, or half, or three quarters.
const DIRECTIONS: [[i64; 2]; 4] = [[4, 3], [-3, 4], [-4, -3], [3, -4]];

/// A problem of so many contacts with a solution (r, u) that is exact in numbers, its pattern drawn.
///
/// W = G Gᵀ + I with whole G. A sliding contact has r_n = 20 c, r_t = −3 c (4, 3) of length 15 c = ¾ r_n, and y_t = ½ (4, 3).
fn known(law: Law, contacts: usize, seed: u64) -> (ContactProblem, Solution, Vec<ContactState>) {
    let mut draw = Draw(seed);
    let n = 3 * contacts;
    let factor = DMatrix::from_fn(n, n, |_, _| draw.whole(2) as f64);
    let w = &factor * factor.transpose() + DMatrix::identity(n, n);
    let (mut r, mut y, mut states) = (DVector::zeros(n), DVector::zeros(n), Vec::new());
    for k in 0..contacts {
        let [along, across] = DIRECTIONS[draw.whole(20).unsigned_abs() as usize % 4];
        let size = 1.0 + draw.whole(3).abs() as f64;
        let state = [ContactState::Open, ContactState::Sticking, ContactState::Sliding][draw.whole(30).unsigned_abs() as usize % 3];
        let sliding = |r: &mut DVector<f64>, y: &mut DVector<f64>| {
            // ‖r_t‖ = 15 size = ¾ · 20 size, along (4, 3)/5
            r.rows_mut(3 * k, 3).copy_from_slice(&[20.0 * size, -3.0 * size * along as f64, -3.0 * size * across as f64]);
            y.rows_mut(3 * k + 1, 2).copy_from_slice(&[0.5 * along as f64, 0.5 * across as f64]);
            if law == Law::Associated {
                y[3 * k] = MU * 2.5;
            }
        };
        match (law, state) {
            (_, ContactState::Open) => y.rows_mut(3 * k, 3).copy_from_slice(&[8.0 * size, along as f64, across as f64]),
            (Law::Frictionless, _) => {
                r[3 * k] = size;
                y.rows_mut(3 * k + 1, 2).copy_from_slice(&[along as f64, across as f64]);
            }
            (_, ContactState::Sticking) => r.rows_mut(3 * k, 3).copy_from_slice(&[10.0 * size, along as f64, across as f64]),
            _ => sliding(&mut r, &mut y),
        }
        states.push(if law == Law::Frictionless && state != ContactState::Open { ContactState::Pressing } else { state });
    }
    let free = &y - &w * &r; // exact: all of it is whole or half, and small
    let problem = ContactProblem::new(w, free).law(law).friction(vec![MU; contacts]).build().expect("sizes fit");
    let velocity = y.clone();
    (problem, Solution::new("by construction", r, velocity, 0), states)
}

pub(super) fn is_exact(problem: &ContactProblem, solution: &Solution) -> bool {
    (0..problem.rows()).all(|row| {
        let terms = (0..problem.rows()).map(|j| exact(problem.entry(row, j)) * exact(solution.impulse[j]));
        terms.fold(exact(problem.free_velocity()[row]), |sum: Rational, term| sum + term) == exact(solution.velocity[row])
    })
}

pub(super) fn contact_norm(difference: &DVector<f64>, k: usize) -> f64 {
    difference.rows(3 * k, 3).norm()
}

#[test]
fn a_solution_that_is_known_in_fractions_is_within_every_radius() {
    for law in [Law::Frictionless, Law::Coulomb, Law::Associated] {
        let mut proved = 0;
        for seed in 0..60 {
            let contacts = 1 + seed as usize % 7;
            let (problem, solution, states) = known(law, contacts, seed);
            assert!(is_exact(&problem, &solution), "u = W r + q in fractions");
            assert!(
                backward(&problem, &solution.impulse).expect("finite numbers").velocity.iter().all(|delta| *delta <= roundings(MANY)),
                "it is a solution"
            );
            for size in NEAR {
                let mut draw = Draw(seed + 1000);
                let mut answer = solution.clone();
                answer.impulse.iter_mut().filter(|r| **r != 0.0).for_each(|r| *r += size * draw.whole(100) as f64 / 100.0);
                answer.velocity = problem.velocity(&answer.impulse);
                let Forward::Proved(radius) = forward(&problem, &answer).expect("finite numbers") else { continue };
                proved += 1;
                assert_eq!(radius.states, states, "{law:?} {seed}");
                let [velocity, impulse] = [&answer.velocity - &solution.velocity, &answer.impulse - &solution.impulse];
                for k in 0..contacts {
                    // both sides are rounded in the last place
                    let spacing = 1.0 - 8.0 * f64::EPSILON;
                    assert!(radius.velocity[k] >= spacing * contact_norm(&velocity, k), "{law:?} {seed} {size}: {radius:?}");
                    assert!(radius.impulse[k] >= spacing * contact_norm(&impulse, k), "{law:?} {seed} {size}: {radius:?}");
                    let scale = solution.impulse.amax() * problem.dense().amax();
                    assert!(radius.velocity[k] <= contact_norm(&velocity, k) + EXCESS * scale, "{law:?} {seed} {size}: {radius:?}");
                }
            }
        }
        assert!(proved >= 170, "{law:?}: {proved} of 180");
    }
}

#[test]
fn an_answer_that_was_moved_gets_no_proof_or_a_radius_that_says_so() {
    for law in [Law::Coulomb, Law::Associated] {
        for seed in 0..20 {
            let (problem, solution, _) = known(law, 3, seed);
            let Forward::Proved(exact) = forward(&problem, &solution).expect("finite numbers") else { continue };
            for distance in FAR {
                for row in 0..problem.rows() {
                    let mut answer = solution.clone();
                    answer.velocity[row] += distance;
                    if let Forward::Proved(radius) = forward(&problem, &answer).expect("finite numbers") {
                        assert!(
                            radius.velocity[row / 3] >= distance - exact.velocity[row / 3] - roundings(FEW),
                            "{law:?} {seed} {distance} {row}"
                        );
                    }
                    answer.impulse[row] += distance;
                    answer.velocity = problem.velocity(&answer.impulse);
                    if let Forward::Proved(radius) = forward(&problem, &answer).expect("finite numbers") {
                        // every one of these problems has one solution: W ⪰ I, and the pattern is strict
                        let moved = radius.impulse[row / 3].max(radius.velocity.iter().copied().fold(0.0, f64::max));
                        assert!(moved >= distance * 0.999, "{law:?} {seed} {distance} {row}: {radius:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn problems_without_solution_are_never_proved() {
    // Painlevé: W_nn < μ W_nt, the block slides and every normal impulse pushes it deeper
    let painleve = ContactProblem::new(DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 5.0]), dvector![-1.0, 1.0]);
    let painleve = painleve.rows_per_contact(2).friction(vec![1.0]).build().expect("sizes fit");
    // between two walls that approach each other
    let jammed = ContactProblem::new(DMatrix::from_row_slice(2, 2, &[1.0, -1.0, -1.0, 1.0]), dvector![-1.0, -1.0]);
    let jammed = jammed.rows_per_contact(1).law(Law::Frictionless).build().expect("sizes fit");
    let mut draw = Draw(5);
    for _ in 0..400 {
        let impulse = dvector![draw.whole(400) as f64 / 100.0, draw.whole(400) as f64 / 100.0];
        for (problem, name) in [(&jammed, "jammed"), (&painleve, "Painlevé")] {
            let answer = Solution::new("guessed", impulse.clone(), problem.velocity(&impulse), 0);
            if let Forward::Proved(radius) = forward(problem, &answer).expect("finite numbers") {
                // Painlevé's block has one: it sticks, far away
                assert!(name != "jammed", "{impulse:?} {radius:?}");
                assert!([ContactState::Sticking, ContactState::Undecided].contains(&radius.states[0]));
                let stuck = dvector![7.0, -3.0];
                assert!(radius.impulse[0] >= (impulse.clone() - stuck).norm() * 0.999);
            }
        }
    }
}

#[test]
fn a_grazing_contact_is_proved_by_the_law_itself() {
    // y = 0 without impulse at the second contact: neither open nor pressing is strict
    let w = DMatrix::from_row_slice(
        6,
        6,
        &[
            2.0, 0.0, 0.0, 0.25, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.25, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.25, 0.25, 0.0, 0.0, 2.0, 0.0, 0.0,
            0.0, 0.25, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.25, 0.0, 0.0, 2.0,
        ],
    );
    let r = dvector![1.0, 0.125, 0.0, 0.0, 0.0, 0.0];
    let problem = ContactProblem::new(w.clone(), -&w * &r).friction(vec![0.5, 0.5]).build().expect("sizes fit");
    let answer = Solution::new("by construction", r, DVector::zeros(6), 0);
    let radius = forward(&problem, &answer).expect("finite numbers").proved().expect("weakly coupled");
    assert!(radius.states.contains(&ContactState::Undecided) || radius.states[1] == ContactState::Open, "{radius:?}");
    assert!(radius.velocity.iter().all(|bound| *bound <= roundings(SOME)), "{radius:?}");
}

#[test]
fn a_compliance_on_edges_and_numbers_that_are_none_are_refused_by_name() {
    let (problem, solution, _) = known(Law::Coulomb, 1, 1);
    let soft = Compliance { coordinates: Coordinates::Edge, diagonal: DVector::from_element(4, 1.0) };
    let law = Law::PolyhedralAssociated { directions: 4 };
    let pyramid = problem.clone().into_builder().law(law).compliance(Some(soft)).build().expect("sizes fit");
    let Forward::NotProved(reason) = forward(&pyramid, &solution).expect("finite numbers") else { panic!("not a law of r and y") };
    assert!(reason.text.contains("compliance on edges"));
    let wrong = Solution::new("", dvector![1.0], dvector![0.0], 0);
    assert!(forward(&problem, &wrong).is_err());
    let mut nan = solution.clone();
    nan.velocity[0] = f64::NAN;
    let Forward::NotProved(reason) = forward(&problem, &nan).expect("sizes fit") else { panic!("no distance from no number") };
    assert_eq!(reason.text, TOO_FAST);
    nan.impulse[0] = f64::NAN;
    assert!(forward(&problem, &nan).is_err());
}

#[test]
fn the_planar_law_is_linear_and_its_solution_is_enclosed_to_rounding() {
    let w = DMatrix::from_row_slice(2, 2, &[1.0, 0.25, 0.25, 1.0]);
    for (r, y) in
        [(dvector![3.0, -1.5], dvector![0.0, 2.0]), (dvector![3.0, 1.5], dvector![0.0, -2.0]), (dvector![3.0, 0.1], dvector![0.0, 0.0])]
    {
        let free = &y - &w * &r;
        let problem = ContactProblem::new(w.clone(), free).rows_per_contact(2).friction(vec![0.5]).build().expect("sizes fit");
        let radius = forward(&problem, &Solution::new("", r, y, 0)).expect("finite numbers").proved().expect("a strict pattern");
        assert!(radius.velocity[0] <= roundings(FEW) && radius.impulse[0] <= roundings(FEW), "{radius:?}");
    }
}

/// A table of 1 kg that stands on four feet, all numbers binary, on a floor that it slides over, sticks to, or both.
pub(super) fn table(friction: f64, free: [f64; 6], shift: f64) -> ContactProblem {
    let feet = [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]];
    // velocities of the centre and of rotation; a foot at (x, y, −½)
    let mut jacobian = DMatrix::zeros(12, 6);
    for (k, [x, y]) in feet.into_iter().enumerate() {
        for (i, row) in [[0.0, 0.0, 1.0, y, -x, 0.0], [1.0, 0.0, 0.0, 0.0, -0.5, -y], [0.0, 1.0, 0.0, 0.5, 0.0, x]].into_iter().enumerate()
        {
            jacobian.row_mut(3 * k + i).copy_from_slice(&row);
        }
    }
    let mut moved = DVector::zeros(12);
    moved[3] = shift;
    let mass = DMatrix::from_diagonal(&dvector![1.0, 1.0, 1.0, 0.5, 0.5, 1.0]);
    let free = DVector::from_row_slice(&free);
    ContactProblem::from_dynamics(mass, jacobian, &free).friction(vec![friction; 4]).shift(moved).build().expect("sizes fit")
}

#[test]
fn the_feet_of_a_table_depend_on_each_other_and_their_velocities_are_proved_all_the_same() {
    let sliding = table(0.5, [2.0, 0.0, -1.0, 0.0, 0.0, 0.0], 0.0);
    let sticking = table(0.5, [0.25, 0.0, -1.0, 0.0, 0.0, 0.0], 0.0);
    // of four normals n and n_k, the moments about both axes vanish: Σ x n = ¼ Σ n where it slides, ½ Σ x n = ⅛ where it sticks
    let impulses =
        |normal: [f64; 4], tangent: &dyn Fn(f64) -> f64| DVector::from_iterator(12, normal.into_iter().flat_map(|n| [n, tangent(n), 0.0]));
    for spread in [0.0, 0.0625] {
        let impulse = impulses([0.3125 + spread, 0.3125 - spread, 0.1875 + spread, 0.1875 - spread], &|n| -0.5 * n);
        let velocity = sliding.velocity(&impulse);
        assert_eq!(velocity, DVector::from_iterator(12, [0.0, 1.5, 0.0].into_iter().cycle().take(12)), "it slows down and stays level");
        let radius = forward(&sliding, &Solution::new("by construction", impulse, velocity, 0))
            .expect("finite numbers")
            .proved()
            .expect("it slides");
        assert_eq!((radius.dependent.len(), radius.states), (1, vec![ContactState::Sliding; 4]), "four normals, three motions");
        assert!(radius.velocity.iter().all(|bound| *bound <= roundings(SOME)), "{:?}", radius.velocity);
    }
    let impulse = impulses([0.28125, 0.28125, 0.21875, 0.21875], &|_| -0.0625);
    let velocity = sticking.velocity(&impulse);
    assert_eq!(velocity.amax(), 0.0);
    let radius =
        forward(&sticking, &Solution::new("", impulse.clone(), velocity.clone(), 0)).expect("finite numbers").proved().expect("it sticks");
    assert_eq!((radius.dependent.len(), radius.states), (6, vec![ContactState::Sticking; 4]), "twelve rows, six motions");
    assert!(radius.velocity.iter().all(|bound| *bound == 0.0), "all velocities are zero: {:?}", radius.velocity);
    // a foot that stands a little higher has another free velocity: its row depends on the others, its velocity does not
    let uneven = table(0.5, [0.25, 0.0, -1.0, 0.0, 0.0, 0.0], 2.0_f64.powi(-40));
    let Forward::NotProved(reason) = forward(&uneven, &Solution::new("", impulse, velocity, 0)).expect("finite numbers") else {
        panic!("inconsistent")
    };
    assert!(reason.text.contains("free velocities"), "{reason:?}");
}

/// Proofs that a known solution contradicts: the only one of a problem in fractions is not within the radius of an answer to it, or a
/// problem that has none has a proof.
fn contradicted() -> usize {
    let mut found = 0;
    for law in [Law::Frictionless, Law::Coulomb, Law::Associated] {
        for seed in 0..30 {
            let (problem, solution, _) = known(law, 1 + seed as usize % 5, seed);
            let mut draw = Draw(seed + 77);
            for size in REDUNDANT {
                let mut answer = solution.clone();
                answer.impulse.iter_mut().for_each(|r| *r += size * draw.whole(100) as f64 / 100.0);
                answer.velocity = problem.velocity(&answer.impulse);
                let Forward::Proved(radius) = forward(&problem, &answer).expect("finite numbers") else { continue };
                let [velocity, impulse] = [&answer.velocity - &solution.velocity, &answer.impulse - &solution.impulse];
                let spacing = 1.0 - 8.0 * f64::EPSILON;
                let rounding = 4.0 * f64::EPSILON * (problem.dense().amax() * answer.impulse.amax() + answer.velocity.amax());
                let misses = |k: usize| {
                    radius.velocity[k] + rounding < spacing * contact_norm(&velocity, k)
                        || radius.impulse[k] < spacing * contact_norm(&impulse, k)
                };
                found += usize::from((0..problem.contacts()).any(misses));
            }
        }
    }
    let uneven = table(0.5, [0.25, 0.0, -1.0, 0.0, 0.0, 0.0], 2.0_f64.powi(-40));
    let normals = [0.28125, 0.28125, 0.21875, 0.21875];
    let impulse = DVector::from_iterator(12, normals.into_iter().flat_map(|n| [n, -0.0625, 0.0]));
    let velocity = uneven.velocity(&impulse);
    found + usize::from(matches!(forward(&uneven, &Solution::new("", impulse, velocity, 0)).expect("finite numbers"), Forward::Proved(_)))
}

#[test]
fn every_mistake_planted_in_the_proof_is_contradicted_by_known_solutions_and_the_proof_is_not() {
    assert_eq!(with(None, contradicted), 0);
    for plant in [Plant::Residual, Plant::Image, Plant::Preconditioner, Plant::Signs, Plant::Radius, Plant::Rank] {
        let caught = with(Some(plant), contradicted);
        assert!(caught > 0, "{plant:?}");
    }
}
