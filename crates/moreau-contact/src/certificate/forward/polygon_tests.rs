//! Proofs under polyhedral laws in space: solutions that are known by construction, and those of the complementarity problem in fractions.

use super::tests::{contact_norm, is_exact, table};
use super::*;
use crate::certificate::draw::Draw;
use crate::certificate::lcp_exact::{exact_near, support};
use crate::certificate::planted::with;
use crate::cones::polyhedral::{along_neighbours, direction};
use crate::problem::{Law, Lcp};
use crate::solvers::{Auto, ContactSolver};
use crate::tolerance::sharpness::{EXCESS, FAR, NEAR, REDUNDANT, SOME, roundings};
use moreau_exact::scalar::{Rational, Scalar, exact};
use nalgebra::{DVector, dvector};

const MU: f64 = 0.75;
const SQUARE: [Law; 2] = [Law::PolyhedralCoulomb { directions: 4 }, Law::PolyhedralAssociated { directions: 4 }];

/// A problem of so many contacts under a law of four directions with a solution that is exact in numbers, its pattern drawn.
///
/// On edge j μ r_n = 3 s with r_n = 4 s, r_t = 3 s D_j and y_t = −2 D_j + D_{j+1}; on side j r_n = 8 s, r_t = 3 s (D_j + D_{j+1}) and
/// y_t = −D_j − D_{j+1}.
fn known(law: Law, contacts: usize, seed: u64) -> (ContactProblem, Solution, Vec<Case>) {
    let (mut draw, n) = (Draw(seed), 3 * contacts);
    let factor = DMatrix::from_fn(n, n, |_, _| draw.whole(2) as f64);
    let w = &factor * factor.transpose() + DMatrix::identity(n, n);
    let (mut r, mut y, mut cases) = (DVector::zeros(n), DVector::zeros(n), Vec::new());
    for k in 0..contacts {
        let j = draw.whole(20).unsigned_abs() as usize % 4;
        let ([a, b], [c, d]) = (direction(j, 4), direction(j + 1, 4));
        let size = 1.0 + draw.whole(3).abs() as f64;
        let associated = matches!(law, Law::PolyhedralAssociated { .. });
        let lift = |along: f64| if associated { MU * along } else { 0.0 };
        let case = [Case::Is(ContactState::Open), Case::Is(ContactState::Sticking), Case::Edge(j), Case::Side(j)]
            [draw.whole(40).unsigned_abs() as usize % 4];
        let [impulse, velocity] = match case {
            Case::Edge(_) => [[4.0 * size, 3.0 * size * a, 3.0 * size * b], [lift(2.0), c - 2.0 * a, d - 2.0 * b]],
            Case::Side(_) => [[8.0 * size, 3.0 * size * (a + c), 3.0 * size * (b + d)], [lift(1.0), -a - c, -b - d]],
            Case::Is(ContactState::Open) => [[0.0; 3], [8.0 * size, 4.0 * a, 3.0 + b]],
            Case::Is(_) | Case::Forth(_) => [[10.0 * size, 2.0 * a + c, 2.0 * b + d], [0.0; 3]],
        };
        r.rows_mut(3 * k, 3).copy_from_slice(&impulse);
        y.rows_mut(3 * k, 3).copy_from_slice(&velocity);
        cases.push(case);
    }
    let free = &y - &w * &r; // exact: quarters, and small
    let problem = ContactProblem::new(w, free).law(law).friction(vec![MU; contacts]).build().expect("sizes fit");
    (problem, Solution::new("by construction", r, y, 0), cases)
}

/// How many proofs there are of answers near the known solutions, and how many of these do not hold it.
fn compared(law: Law, sizes: &[f64]) -> [usize; 2] {
    let (mut proved, mut missed) = (0, 0);
    for seed in 0..60 {
        let contacts = 1 + seed as usize % 6;
        let (problem, solution, cases) = known(law, contacts, seed);
        assert!(is_exact(&problem, &solution), "u = W r + q in fractions");
        for &size in sizes {
            let (mut draw, mut answer) = (Draw(seed + 1000), solution.clone());
            answer.impulse.iter_mut().for_each(|r| *r += size * draw.whole(100) as f64 / 100.0);
            answer.velocity = problem.velocity(&answer.impulse);
            let Forward::Proved(radius) = forward(&problem, &answer).expect("finite numbers") else { continue };
            proved += 1;
            let told: Vec<ContactState> = cases.iter().map(|case| case.state()).collect();
            let [velocity, impulse] = [&answer.velocity - &solution.velocity, &answer.impulse - &solution.impulse];
            // both sides are rounded in the last place
            let (spacing, scale) = (1.0 - 8.0 * f64::EPSILON, solution.velocity.amax() + solution.impulse.amax() * problem.dense().amax());
            let holds = |k: usize| {
                radius.velocity[k] >= spacing * contact_norm(&velocity, k)
                    && radius.impulse[k] >= spacing * contact_norm(&impulse, k)
                    && radius.velocity[k] <= contact_norm(&velocity, k) + EXCESS * scale
            };
            missed += usize::from(radius.states != told || !(0..contacts).all(holds));
        }
    }
    [proved, missed]
}

#[test]
fn a_solution_that_is_known_in_fractions_is_within_every_radius() {
    for law in SQUARE {
        let [proved, missed] = compared(law, &NEAR);
        assert!(proved >= 170 && missed == 0, "{law:?}: {proved} of 180, {missed} missed");
    }
}

#[test]
fn half_a_radius_does_not_hold_the_known_solutions() {
    for law in SQUARE {
        let missed = with(Some(Plant::Radius), || compared(law, &NEAR))[1];
        assert!(missed > 0, "{law:?}");
    }
}

/// An answer to one contact of W = I under a law of four directions, and whether it is a solution.
fn of_one(law: Law, impulse: [f64; 3], velocity: [f64; 3]) -> bool {
    let [impulse, velocity] = [impulse, velocity].map(|all| DVector::from_row_slice(&all));
    let problem = ContactProblem::new(DMatrix::identity(3, 3), &velocity - &impulse).law(law).friction(vec![MU]);
    let answer = Solution::new("guessed", impulse, velocity, 0);
    let radius = forward(&problem.build().expect("sizes fit"), &answer).expect("finite numbers").proved();
    radius.is_some_and(|radius| radius.velocity[0] <= roundings(SOME) && radius.impulse[0] <= roundings(SOME))
}

#[test]
fn every_inequality_is_looked_at_on_both_sides() {
    let [coulomb, associated] = SQUARE;
    for (law, lift) in [(coulomb, 0.0), (associated, 1.0)] {
        let slow = 2.0_f64.powi(-20);
        for sign in [1.0, -1.0] {
            let is_right = sign > 0.0;
            // edge 0: the next edge would dissipate more
            assert_eq!(of_one(law, [4.0, 3.0, 0.0], [lift * MU, -1.0, -1.0 + sign * slow]), is_right, "{law:?} edge");
            // side 0: its end is passed; the velocity turns
            assert_eq!(of_one(law, [4.0, 3.0 - sign * slow, sign * slow], [lift * MU, -1.0, -1.0]), is_right, "{law:?} end");
            let turned = sign * lift * MU * slow;
            assert_eq!(of_one(law, [8.0, 3.0, 3.0], [turned, -sign * slow, -sign * slow]), is_right, "{law:?} turned");
            // inside
            assert_eq!(of_one(law, [8.0, 3.0 - sign * slow, 3.0], [0.0; 3]), is_right, "{law:?} inside");
            // open, along the edge that gives way first
            assert_eq!(of_one(law, [0.0; 3], [lift * MU + sign * slow, -1.0, 0.5]), is_right, "{law:?} open");
        }
    }
}

#[test]
fn without_the_inequalities_wrong_patterns_would_be_proved() {
    // under the associated law these problems have one solution, W ⪰ I
    let law = SQUARE[1];
    assert_eq!(compared(law, &REDUNDANT)[1], 0);
    assert!(with(Some(Plant::Signs), || compared(law, &REDUNDANT))[1] > 0);
}

#[test]
fn a_contact_that_closes_without_an_impulse_is_followed_and_a_border_is_called_one() {
    for law in SQUARE {
        let problem = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).law(law).friction(vec![0.5]);
        let problem = problem.build().expect("sizes fit");
        let nothing = Solution::new("", DVector::zeros(3), problem.free_velocity().clone(), 0);
        let radius = forward(&problem, &nothing).expect("finite numbers").proved().expect("it slides");
        // r = (1, −½, 0), and of the associated law (8/5, −4/5, 0)
        let far = if law == SQUARE[0] { 1.25f64.sqrt() } else { 3.2f64.sqrt() };
        assert!(radius.impulse[0] >= far && radius.impulse[0] <= 1.001 * far, "{law:?}: {radius:?}");
        // both the edge and the side dissipate most
        let tied = dvector![if law == SQUARE[0] { 0.0 } else { MU }, 1.0, 1.0];
        let impulse = dvector![4.0, -3.0, 0.0];
        let tie = ContactProblem::new(DMatrix::identity(3, 3), &tied - &impulse).law(law).friction(vec![MU]).build().expect("sizes fit");
        match forward(&tie, &Solution::new("", impulse, tied, 0)).expect("finite numbers") {
            Forward::Proved(radius) => assert!(radius.impulse[0] <= roundings(SOME), "{radius:?}"),
            Forward::NotProved(reason) => assert!(reason.text.contains("edge or side of its cone"), "{reason:?}"),
        }
    }
}

#[test]
fn an_answer_that_was_moved_gets_no_proof_or_a_radius_that_says_so() {
    for law in SQUARE {
        for seed in 0..20 {
            let (problem, solution, _) = known(law, 3, seed);
            for (distance, row) in FAR.into_iter().flat_map(|distance| (0..9).map(move |row| (distance, row))) {
                let mut answer = solution.clone();
                answer.impulse[row] += distance;
                answer.velocity = problem.velocity(&answer.impulse);
                let Forward::Proved(radius) = forward(&problem, &answer).expect("finite numbers") else { continue };
                let moved = radius.impulse[row / 3].max(radius.velocity.iter().copied().fold(0.0, f64::max));
                assert!(moved >= distance * 0.999, "{law:?} {seed} {distance} {row}: {radius:?}");
            }
        }
    }
}

/// Solutions in fractions of the complementarity problem, another way to the same answer: r = (λ, Σ D_j β_j).
fn in_fractions(problem: &ContactProblem, answer: &Solution, directions: usize) -> Option<Vec<Rational>> {
    let contacts = problem.contacts();
    let lcp = problem.stewart_trinkle_lcp().expect("Stewart and Trinkle's");
    let y = problem.law_velocity(&answer.impulse);
    let mut z = vec![0.0; contacts * (2 + directions)];
    for k in 0..contacts {
        z[k] = answer.impulse[3 * k];
        let mut beta = Vec::new();
        along_neighbours([answer.impulse[3 * k + 1], answer.impulse[3 * k + 2]], directions, &mut beta);
        z[contacts + k * directions..contacts + (k + 1) * directions].copy_from_slice(&beta);
        let against = |j: usize| -(0..2).map(|i| direction(j, directions)[i] * y[3 * k + 1 + i]).sum::<f64>();
        z[contacts * (1 + directions) + k] = (0..directions).map(against).fold(0.0, f64::max);
    }
    let z = DVector::from_vec(z);
    let whole = Lcp::new(lcp.matrix.map(exact), lcp.vector.map(exact));
    let found = exact_near(&whole, &z, support(&lcp, &z)).ok()?;
    let mut impulse = Vec::new();
    for k in 0..contacts {
        let beta = |j: usize| found.z[contacts + k * directions + j].clone();
        let along = |i: usize| (0..directions).fold(Rational::ZERO, |sum, j| sum + exact(direction(j, directions)[i]) * beta(j));
        impulse.extend([found.z[k].clone(), along(0), along(1)]);
    }
    Some(impulse)
}

#[test]
fn what_solvers_find_for_any_number_of_directions_is_proved_and_holds_the_solution_in_fractions() {
    let mut held = 0;
    for directions in [3, 5, 6, 8] {
        for seed in 0..12 {
            let mut draw = Draw(seed + 31 * directions as u64);
            let contacts = 1 + seed as usize % 3;
            let n = 3 * contacts;
            let factor = DMatrix::from_fn(n, n, |_, _| draw.whole(20) as f64 / 16.0);
            let w = &factor * factor.transpose() + DMatrix::identity(n, n);
            let free = DVector::from_fn(n, |row, _| if row % 3 == 0 { -1.0 } else { draw.whole(30) as f64 / 8.0 });
            let law = Law::PolyhedralCoulomb { directions };
            let problem = ContactProblem::new(w, free).law(law).friction(vec![0.375; contacts]).build().expect("sizes fit");
            let answer = Auto.solve(&problem, None).expect("W is positive definite");
            let Forward::Proved(radius) = forward(&problem, &answer).expect("finite numbers") else { continue };
            let Some(known) = in_fractions(&problem, &answer, directions) else { continue };
            held += 1;
            for k in 0..contacts {
                let square = (0..3).fold(Rational::ZERO, |sum, i| {
                    let apart = known[3 * k + i].clone() - exact(answer.impulse[3 * k + i]);
                    sum + apart.clone() * apart
                });
                assert!(exact(radius.impulse[k]) * exact(radius.impulse[k]) >= square, "{directions} {seed} {k}");
                assert!(radius.impulse[k] <= roundings(SOME) * (1.0 + answer.impulse.amax()), "{directions} {seed}: {radius:?}");
                assert!(Scalar::to_f64(&square).is_finite());
            }
        }
    }
    assert!(held >= 40, "{held} of 48");
}

#[test]
fn the_feet_of_a_table_that_slides_along_an_edge_depend_on_each_other() {
    for law in SQUARE {
        let free = [2.0, 0.0, -1.0, 0.0, 0.0, 0.0];
        let problem = table(0.5, free, 0.0).into_builder().law(law).build().expect("sizes fit");
        let normals = [0.3125, 0.3125, 0.1875, 0.1875];
        let impulse = DVector::from_iterator(12, normals.into_iter().flat_map(|n| [n, -0.5 * n, 0.0]));
        let answer = Solution::new("by construction", impulse.clone(), problem.velocity(&impulse), 0);
        let near = forward(&problem, &answer).expect("finite numbers");
        if law == SQUARE[0] {
            let radius = near.proved().expect("it slides");
            assert_eq!((radius.dependent.len(), radius.states), (1, vec![ContactState::Sliding; 4]), "four normals, three motions");
        } else {
            // it rises under the associated law: v = (6/5, 0, 3/5) in place of (3/2, 0, 0)
            let (radius, far) = (near.proved().expect("it rises"), 0.45f64.sqrt());
            assert_eq!((radius.dependent.len(), radius.states), (1, vec![ContactState::Sliding; 4]));
            assert!(radius.velocity.iter().all(|bound| *bound >= far && *bound <= 1.001 * far), "{:?}", radius.velocity);
        }
    }
    let grazing = ContactProblem::new(DMatrix::identity(3, 3), dvector![-4.0, -3.0, 0.0]).law(SQUARE[0]).friction(vec![MU]);
    let answer = Solution::new("", dvector![4.0, 3.0, 0.0], dvector![0.0, 0.0, 0.0], 0);
    // r on the edge and y = 0: every closed inequality holds, and the proof may say so or not, but names the contact
    if let Forward::NotProved(reason) = forward(&grazing.build().expect("sizes fit"), &answer).expect("finite numbers") {
        assert_eq!(reason.contact, Some(0), "{reason:?}");
    }
}
