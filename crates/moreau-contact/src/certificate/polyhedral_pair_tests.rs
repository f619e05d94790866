//! Pairs held against the complementarity problem of the law, solved problems in fractions, and answers that were moved.

use super::*;
use crate::certificate::backward::{Backward, HeldAs, backward};
use crate::certificate::draw::Draw;
use crate::certificate::planted::with;
use crate::problem::{Compliance, ContactProblem, Coordinates, Law};
use crate::tolerance::sharpness::{FAR, FEW, MANY, roundings};
use nalgebra::{DMatrix, DVector, dvector};

const MU: f64 = 0.5;

/// The law as a complementarity problem 0 ≤ z ⟂ w ≥ 0 of (λ, β, σ), or of f, in fractions: another way to say it than that of the proof.
fn obeys(associated: bool, mu: f64, softness: Option<&[f64]>, pair: &Pair) -> bool {
    let d = pair.parts.len();
    let directions: Vec<[Rational; 2]> = (0..d).map(|j| direction(j, d).map(exact)).collect();
    let y = |i: usize| pair.velocity.get(i).cloned().unwrap_or(Rational::ZERO);
    let along: Vec<Rational> = directions.iter().map(|[a, b]| a * y(1) + b * y(2)).collect();
    let sum = pair.parts.iter().fold(Rational::ZERO, |sum, part| sum + part);
    let complementary =
        |pairs: Vec<(Rational, Rational)>| pairs.into_iter().all(|(z, w)| z >= Rational::ZERO && w >= Rational::ZERO && (z * w).is_zero());
    if associated {
        let soft = |j: usize| softness.map_or(Rational::ZERO, |softness| exact(softness[j]));
        let w = |j: usize| y(0) + exact(mu) * &along[j] + soft(j) * &pair.parts[j];
        return complementary((0..d).map(|j| (pair.parts[j].clone(), w(j))).collect());
    }
    let slip = along.iter().fold(Rational::ZERO, |most, x| if -x > most { -x } else { most });
    let beta: Vec<Rational> = pair.parts.iter().map(|part| part * exact(mu)).collect();
    let left = exact(mu) * &sum - beta.iter().fold(Rational::ZERO, |sum, part| sum + part);
    let mut pairs: Vec<(Rational, Rational)> = beta.into_iter().zip(&along).map(|(beta, along)| (beta, along + &slip)).collect();
    pairs.extend([(sum, y(0)), (left, slip)]);
    complementary(pairs)
}

#[test]
fn every_pair_solves_the_complementarity_problem_of_its_law_and_is_near() {
    let mut draw = Draw(3);
    for d in [2, 3, 4, 5, 8, 16] {
        let (polygon, rows) = (Polygon::new(d), if d == 2 { 2 } else { 3 });
        for case in 0..120 {
            let soft: Vec<f64> = (0..d).map(|_| 0.5 + draw.part().abs()).collect();
            let associated = case % 2 == 0;
            let softness = (case % 6 == 0).then_some(soft.as_slice());
            let mu = [MU, 0.0, 3.0, 1e-3][case / 2 % 4];
            let contact = Faceted { polygon: &polygon, associated, friction: mu, rho: 0.5, softness };
            let sized = |draw: &mut Draw, size: f64| (0..rows).map(|_| size * draw.part()).collect::<Vec<f64>>();
            let (r, y) = (sized(&mut draw, [1.0, 8.0, 1e-9][case % 3]), sized(&mut draw, 1.0));
            let pair = contact.near(&r, &y).expect("all edges are soft, or none");
            assert!(obeys(associated, mu, softness, &pair), "{d} {mu} {associated} {r:?} {y:?}");
            // no impulse, and y lifted: that far away there is always one
            let slip = y[1..].iter().fold(0.0_f64, |sum, y| sum.hypot(*y));
            let open = r.iter().map(|r| r * r).sum::<f64>() + 0.25 * (2.0 + mu * slip).powi(2);
            assert!(softness.is_some() || contact.distance(&pair, &r, &y) <= open, "{d} {mu} {r:?} {y:?}");
        }
    }
}

/// W = G Gᵀ + I with whole G, and pairs drawn face by face that obey the law in numbers: a problem with a known solution.
fn known(associated: bool, directions: usize, contacts: usize, seed: u64) -> (ContactProblem, DVector<f64>) {
    let mut draw = Draw(seed);
    let n = 3 * contacts;
    let factor = DMatrix::from_fn(n, n, |_, _| draw.whole(2) as f64);
    let coupled = if associated { &factor * factor.transpose() } else { DMatrix::zeros(n, n) };
    let (w, mut r, mut y) = (coupled + DMatrix::identity(n, n), DVector::zeros(n), DVector::zeros(n));
    for k in 0..contacts {
        let size = 1.0 + draw.whole(3).abs() as f64;
        let j = draw.whole(50).unsigned_abs() as usize % directions;
        let [first, second] = direction(j, directions);
        let lift = if associated { MU } else { 0.0 };
        match draw.whole(30).unsigned_abs() % 3 {
            0 => y.rows_mut(3 * k, 3).copy_from_slice(&[2.0 + lift, first, second]),
            1 => r.rows_mut(3 * k, 3).copy_from_slice(&[size, 0.25 * first, 0.125 * second]),
            _ => {
                r.rows_mut(3 * k, 3).copy_from_slice(&[size, MU * size * first, MU * size * second]);
                y.rows_mut(3 * k, 3).copy_from_slice(&[lift, -first, -second]);
            }
        }
    }
    let free = &y - &w * &r;
    let law = if associated { Law::PolyhedralAssociated { directions } } else { Law::PolyhedralCoulomb { directions } };
    (ContactProblem::new(w, free).law(law).friction(vec![MU; contacts]).build().unwrap(), r)
}

fn all(proof: &Backward) -> f64 {
    proof.velocity.iter().chain(&proof.impulse).map(|size| size * size).sum::<f64>().sqrt()
}

#[test]
fn a_solution_of_binary_numbers_is_proved_as_it_stands_and_any_other_to_rounding() {
    for associated in [false, true] {
        for seed in 0..40 {
            let (problem, solution) = known(associated, 4, 1 + seed as usize % 4, seed);
            let proof = backward(&problem, &solution).unwrap();
            assert_eq!(all(&proof), 0.0, "{associated} {seed} {proof:?}");
            let (problem, solution) = known(associated, 8, 1 + seed as usize % 4, seed);
            let proof = backward(&problem, &solution).unwrap();
            assert!(all(&proof) <= roundings(MANY), "{associated} {seed} {proof:?}");
        }
    }
}

/// Proofs that say less than what an answer was moved by. With W ⪰ I and a law that is monotone – with a W that is I also the other one –
/// impulses that solve the problem with q + δ are within 3 ‖δ‖ of the solution: (1 + μ) for what friction makes of an error of the normal.
fn contradicted() -> usize {
    let mut found = 0;
    for (associated, directions) in [(false, 4), (true, 4), (false, 8), (true, 8)] {
        for seed in 0..12 {
            let (problem, solution) = known(associated, directions, 2, seed);
            for distance in FAR {
                for row in 0..problem.rows() {
                    let mut moved = solution.clone();
                    moved[row] += distance;
                    let proof = backward(&problem, &moved).unwrap();
                    let [delta, beside] = [&proof.velocity, &proof.impulse].map(|of| of.iter().map(|x| x * x).sum::<f64>().sqrt());
                    found += usize::from(3.0 * delta + beside < distance - roundings(MANY));
                }
            }
        }
    }
    found + [rounds_inward(), rubs_across(), takes_a_pull()].into_iter().filter(|wrong| *wrong).count()
}

/// Whether it is believed that a block that slides along one direction of a square is rubbed along another one.
fn rubs_across() -> bool {
    let block = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).friction(vec![0.5]);
    let block = block.law(Law::PolyhedralCoulomb { directions: 4 }).build().unwrap();
    // (1, −½, 0) is the only solution
    let proof = backward(&block, &dvector![1.0, 0.0, -0.5]).unwrap();
    3.0 * proof.velocity[0] + proof.impulse[0] < 0.5_f64.sqrt() - roundings(MANY)
}

/// Whether it is believed that one contact stops 3 N·s while the other one pulls 4 N·s, which moves the first by 2 m/s: r = (0, 1) is the
/// only solution, W ⪰ ½.
fn takes_a_pull() -> bool {
    let w = DMatrix::from_fn(4, 4, |i, j| {
        if i == j {
            1.0
        } else if i % 2 == 0 && j % 2 == 0 {
            0.5
        } else {
            0.0
        }
    });
    let problem = ContactProblem::new(w, dvector![2.5, 0.0, -1.0, 0.0]).law(Law::PolyhedralAssociated { directions: 2 });
    let problem = problem.rows_per_contact(2).friction(vec![MU; 2]).build().unwrap();
    let proof = backward(&problem, &dvector![-4.0, 0.0, 3.0, 0.0]).unwrap();
    proof.impulse[1] + 2.0 * proof.velocity.iter().map(|x| x * x).sum::<f64>().sqrt() < 2.0
}

/// Whether a size that is no number is rounded inward: without impulse two velocities of a contact add up to what is missing.
fn rounds_inward() -> bool {
    let law = Law::PolyhedralCoulomb { directions: 4 };
    let inward = |other: f64| {
        let problem = ContactProblem::new(DMatrix::zeros(3, 3), dvector![-0.1, 0.0, 0.0]).law(law).friction(vec![MU]);
        let problem = problem.shift(dvector![-other, 0.0, 0.0]).build().unwrap();
        exact(backward(&problem, &dvector![0.0, 0.0, 0.0]).unwrap().velocity[0]) < exact(0.1) + exact(other)
    };
    (1..20).any(|i| inward(f64::from(i) / 7.0))
}

#[test]
fn every_mistake_planted_in_the_pairs_is_contradicted_by_answers_that_were_moved_and_the_proof_is_not() {
    assert_eq!(with(None, contradicted), 0);
    for plant in [Plant::Law, Plant::Moved, Plant::Inward] {
        assert!(with(Some(plant), contradicted) > 0, "{plant:?}");
    }
}

#[test]
fn friction_along_the_wrong_direction_and_along_the_slip_is_told() {
    let block = |directions: usize| {
        let problem = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).friction(vec![0.5]);
        problem.law(Law::PolyhedralCoulomb { directions }).build().unwrap()
    };
    for directions in [3, 4, 6, 8] {
        for (impulse, least) in [([1.0, 0.0, -0.5], 0.25), ([1.0, 0.5, 0.0], 0.5), ([1.0, 0.0, 0.0], 0.125), ([2.0, -1.0, 0.0], 0.5)] {
            let proof = backward(&block(directions), &DVector::from_row_slice(&impulse)).unwrap();
            assert!(proof.velocity[0] + proof.impulse[0] >= least, "{directions} {impulse:?} {proof:?}");
        }
    }
    let right = backward(&block(4), &dvector![1.0, -0.5, 0.0]).unwrap();
    assert_eq!((right.states[0], all(&right)), (HeldAs::Sliding, 0.0));
}

#[test]
fn a_jaw_that_closes_has_no_small_backward_error() {
    // r presses both walls equally and leaves them closing at 1 and ½ m/s: p = (1, 1) asks for p·δ ≥ 1.5
    let w = DMatrix::from_fn(6, 6, |i, j| if i % 3 == j % 3 { if i == j || i % 3 > 0 { 1.0 } else { -1.0 } } else { 0.0 });
    for law in [Law::PolyhedralCoulomb { directions: 4 }, Law::PolyhedralAssociated { directions: 5 }] {
        let problem = ContactProblem::new(w.clone(), dvector![-1.0, 0.0, 0.0, -0.5, 0.0, 0.0]).law(law).friction(vec![0.5; 2]);
        let problem = problem.build().unwrap();
        let mut draw = Draw(9);
        for _ in 0..60 {
            let impulse = DVector::from_fn(6, |_, _| 4.0 * draw.part());
            let proof = backward(&problem, &impulse).unwrap();
            assert!(proof.velocity.iter().sum::<f64>() >= 1.5, "{law:?} {impulse} {proof:?}");
        }
    }
}

#[test]
fn soft_edges_are_proved_where_all_of_a_contact_are_soft_and_refused_by_name_where_some_are_hard() {
    // MuJoCo's pyramid: f_j = (−w_j)⁺/R_j
    let of = |diagonal: DVector<f64>| {
        let problem = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 0.25, 0.0]).friction(vec![0.5]);
        let compliance = Compliance { coordinates: Coordinates::Edge, diagonal };
        problem.law(Law::PolyhedralAssociated { directions: 4 }).compliance(compliance).build().unwrap()
    };
    // all edges press alike but for the tangent: Σf = r_n, μ(f_0 − f_2) = r_1, −R f_j = y_n ± μ y_1
    let problem = of(DVector::from_element(4, 0.5));
    // y_n = −1 + r_n = −R r_n/4 and y_1 = ¼ + r_1 = −R r_1/(2 μ²)
    let (normal, along) = (1.0 / 1.125, -0.25 / 2.0);
    let proof = backward(&problem, &dvector![normal, along, 0.0]).unwrap();
    assert!(all(&proof) <= roundings(FEW), "{proof:?}");
    let moved = backward(&problem, &dvector![normal + 0.25, along, 0.0]).unwrap();
    assert!(moved.velocity[0] + moved.impulse[0] >= 0.125, "{moved:?}");
    let refused = backward(&of(dvector![0.5, 0.0, 0.5, 0.5]), &dvector![normal, along, 0.0]).unwrap_err();
    assert!(refused.to_string().contains("contact 0 has edges without compliance"), "{refused}");
    let hard = backward(&of(DVector::zeros(4)), &dvector![1.0, -0.25, 0.0]).unwrap();
    assert_eq!(all(&hard), 0.0, "R = 0 everywhere is no compliance");
}

#[test]
fn extreme_coefficients_are_survived() {
    for mu in [f64::from_bits(1), f64::MIN_POSITIVE, 1.0 / f64::MIN_POSITIVE] {
        for law in [Law::PolyhedralCoulomb { directions: 4 }, Law::PolyhedralAssociated { directions: 5 }] {
            let problem = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, -1.0]).law(law).friction(vec![mu]);
            let problem = problem.build().unwrap();
            for impulse in [dvector![1.0, 5.0, 0.0], dvector![0.5, -2.0, 1.0], dvector![0.0, 0.0, 0.0]] {
                assert!(backward(&problem, &impulse).unwrap().velocity[0] >= 0.0, "{law:?} {mu}");
            }
        }
    }
}
