//! The chain as a whole: what opens by itself, islands, and an accuracy that is asked for.

use super::*;
use crate::certificate::residuals;
use crate::problem::Compliance;
use crate::solvers::test_problems::tower;
use nalgebra::{DMatrix, dvector};

#[test]
fn contacts_that_open_by_themselves_are_answered_without_an_algorithm() {
    for (law, opens, closes) in [
        (Law::Coulomb, dvector![0.0, 2.0, 0.0], dvector![-f64::MIN_POSITIVE, 2.0, 0.0]),
        (Law::Associated, dvector![1.0, 2.0, 0.0], dvector![0.99, 2.0, 0.0]),
        (Law::PolyhedralAssociated { directions: 4 }, dvector![1.0, 2.0, 0.0], dvector![0.99, 2.0, 0.0]),
    ] {
        let problem = |free| ContactProblem::new(DMatrix::identity(3, 3), free).law(law).friction(vec![0.5]).build().expect("valid");
        let answer = Auto.solve(&problem(opens.clone()), None).expect("it has an answer");
        assert_eq!((answer.impulse.amax(), answer.iterations), (0.0, 0), "{law:?}");
        assert_eq!(residuals(&problem(opens), &answer).expect("sizes fit").judged.relative(), 0.0, "{law:?}");
        assert!(!opens_everywhere(&problem(closes)), "{law:?}");
    }
}

/// Pushes along the tangent move the contact away, or as much along the normal as along it: no other algorithm comes to an end.
#[test]
fn one_contact_that_jams_on_its_edges_is_enumerated() {
    let law = Law::PolyhedralAssociated { directions: 2 };
    let problem = |w: [f64; 4], free: [f64; 2]| {
        let problem = ContactProblem::new(DMatrix::from_row_slice(2, 2, &w), DVector::from_row_slice(&free)).rows_per_contact(2);
        problem.law(law).friction(vec![8.0]).build().expect("valid")
    };
    let solved = problem([0.0, 1.0, 2.0, -2.0], [3.0, -1.0]);
    let answer = Auto.solve(&solved, None).expect("it has an answer");
    assert!(residuals(&solved, &answer).expect("sizes fit").is_solution(ENOUGH), "{}", answer.solver);
    // p = (1, −1) is in the cone, moves nothing, and p·q = −2
    assert!(is_infeasible(&Auto.solve(&problem([1.0; 4], [0.0, 2.0]), None).expect_err("none")));
}

#[test]
fn no_answer_is_worse_than_the_one_that_was_given() {
    let block = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 0.25, 0.0]).friction(vec![0.5]).build().expect("valid");
    let (mut judge, answer) = (Judge::default(), |normal: f64| dvector![normal, -0.25, 0.0]);
    judge.prepare(&block);
    let mut of = |given: f64, best: Option<f64>| {
        let best = best.map(|normal| Solution::new("best", answer(normal), block.velocity(&answer(normal)), 7));
        let best = best.map(|best| (judge.judge_prepared(&block, &best).expect("sizes fit").relative(), best));
        or_as_given(&block, &mut judge, &answer(given), best).map(|(_, answer)| answer.solver)
    };
    assert_eq!(of(1.0, Some(0.5)).as_deref(), Some(NAME));
    assert_eq!(of(0.5, Some(1.0)).as_deref(), Some("best"));
    assert_eq!(of(0.5, Some(0.5)).as_deref(), Some("best"), "as good as the start");
    assert_eq!(of(0.5, None).as_deref(), Some(NAME));
    assert_eq!(of(f64::MAX, None), None, "what overflows is no answer");
}

/// Impulses alone are no answer where a compliance acts on edges.
#[test]
fn a_start_that_cannot_be_judged_takes_no_answer_away() {
    let law = Law::PolyhedralAssociated { directions: 4 };
    let soft = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 0.5, 0.25]).law(law).friction(vec![0.5]);
    let compliance = Compliance { coordinates: Coordinates::Edge, diagonal: dvector![0.25, 0.25, 0.25, 0.25] };
    let soft = soft.compliance(compliance).build().expect("valid");
    let (mut judge, answer) = (Judge::default(), Auto.solve(&soft, None).expect("it has an answer"));
    judge.prepare(&soft);
    let given = answer.impulse.clone();
    let best = or_as_given(&soft, &mut judge, &given, Some((0.5, answer)));
    assert!(best.is_some_and(|(relative, answer)| relative == 0.5 && answer.beta.is_some()));
    assert!(or_as_given(&soft, &mut judge, &given, None).is_none());
    // no accuracy is enough for this goal, so that every stage is tried and the start is looked at
    let goal = Goal { stop: 0.0, enough: -1.0, acceptable: -1.0 };
    assert!(stages_in_turn(&soft, Some(&dvector![1.0, 0.0, 0.0]), goal).is_ok_and(|(relative, _)| relative <= ENOUGH));
}

/// `count` chains of five rows each that meet no other chain, and as many rows alone, mixed: the chains are ever harder.
fn chains(count: usize) -> ContactProblem {
    let n = 6 * count;
    let w = DMatrix::from_fn(n, n, |i, j| match (i / count, j / count) {
        _ if i % count != j % count => 0.0,
        (a, b) if a == b => 2.0 + 0.01 * (i % count) as f64,
        (a, b) if a.abs_diff(b) == 1 && a.max(b) < 5 => -1.0,
        _ => 0.0,
    });
    let free = DVector::from_fn(n, |i, _| if i % 7 == 3 { 0.3 } else { -1.0 - 0.1 * (i % 5) as f64 });
    let blocks = crate::operator::BlockSparse::from_sparse(&crate::operator::Sparse::of(&w), 1).expect("blocks of these rows");
    ContactProblem::new(blocks, free).rows_per_contact(1).friction(vec![0.0; n]).build().expect("valid")
}

#[test]
fn islands_are_answered_by_themselves_and_together_solve_the_whole() {
    let problem = chains(8);
    let goal = Goal { stop: STOP, enough: ENOUGH, acceptable: ACCEPTABLE };
    let by_islands = islands(&problem, None, goal).expect("nine islands, one of them of eight rows alone");
    let whole = stages_in_turn(&problem, None, goal).expect("it has an answer").1;
    for answer in [&by_islands, &whole, &Auto.solve(&problem, None).expect("it has an answer")] {
        assert!(residuals(&problem, answer).expect("sizes fit").is_solution(STOP), "{}", answer.solver);
    }
    assert!((&by_islands.velocity - &whole.velocity).amax() <= CERTIFY, "W is positive definite: one velocity");
    let dense = problem.clone().into_builder().delassus(problem.dense().clone()).build().expect("valid");
    assert_eq!(islands(&dense, None, goal).expect("several islands").impulse, by_islands.impulse, "the same numbers in a square matrix");
    let one = chains(1).into_builder().delassus(DMatrix::identity(6, 6)).build().expect("valid");
    let joined = one.clone().into_builder().delassus(DMatrix::identity(6, 6) + DMatrix::from_element(6, 6, 1.0)).build().expect("valid");
    assert!(islands(&one, None, goal).is_some() && islands(&joined, None, goal).is_none());
}

/// Contacts of 1 kg each that meet no other and close at 1 m/s; what no impulse moves closes or opens at this speed.
fn beside_massless(n: usize, speed: f64) -> ContactProblem {
    let w = DMatrix::from_fn(3 * n, 3 * n, |i, j| f64::from(i == j && i / 3 != 1));
    let free = DVector::from_fn(3 * n, |i, _| match (i / 3, i % 3) {
        (1, 0) => speed,
        (_, 0) => -1.0,
        (_, other) => 0.4 * other as f64,
    });
    ContactProblem::new(w, free).friction(vec![0.5; n]).build().expect("valid")
}

#[test]
fn a_contact_that_nothing_moves_leaves_the_others_their_answers() {
    for n in [3, 40] {
        let opens = beside_massless(n, 0.25);
        let answer = Auto.solve(&opens, None).expect("it has an answer");
        assert!(residuals(&opens, &answer).expect("sizes fit").is_solution(CERTIFY), "{n}: {}", answer.solver);
        let closes = beside_massless(n, -0.25);
        let answer = Auto.solve(&closes, None).expect("it has an answer");
        let judged = residuals(&closes, &answer).expect("sizes fit").judged;
        assert!(!judged.accepts(CERTIFY) && judged.dual.contact == 1);
        for k in (0..n).filter(|k| *k != 1) {
            assert_eq!(answer.impulse[3 * k], 1.0, "{n}: contact {k}");
        }
    }
}

#[test]
fn an_island_is_the_problem_of_its_contacts() {
    let problem = chains(4);
    let islands = problem.islands();
    assert_eq!(islands.members.iter().map(<[usize]>::len).collect::<Vec<_>>(), [5, 5, 5, 5, 4]);
    for members in islands.members.iter() {
        let island = problem.island(islands, members);
        let (known, found) = (island.islands(), Islands::of(island.delassus(), members.len()));
        assert_eq!((&known.members, &known.first, known.last_is_of_lone), (&found.members, &found.first, found.last_is_of_lone));
        for (place, k) in members.iter().enumerate() {
            assert_eq!((island.free_velocity()[place], island.friction()[place]), (problem.free_velocity()[*k], problem.friction()[*k]));
            for (other, j) in members.iter().enumerate() {
                assert_eq!(island.entry(place, other), problem.entry(*k, *j));
            }
        }
    }
}

#[test]
fn open_contacts_with_a_compliance_on_edges_are_answered_with_the_impulses_of_the_edges() {
    let law = Law::PolyhedralAssociated { directions: 4 };
    let compliance = Compliance { coordinates: Coordinates::Edge, diagonal: DVector::from_element(4, 1.0) };
    let problem = ContactProblem::new(DMatrix::identity(3, 3), dvector![1.0, 0.0, 0.0]).law(law).friction(vec![0.5]);
    let problem = problem.compliance(compliance).build().expect("valid");
    let answer = Auto.solve(&problem, None).expect("it has an answer");
    assert!(residuals(&problem, &answer).expect("sizes fit").is_solution(0.0), "{answer:?}");
}

#[test]
fn an_accuracy_that_is_asked_for_is_reached_and_no_more() {
    let n = 40;
    let chain = DMatrix::from_fn(n, n, |i, j| {
        if i == j {
            2.0
        } else if i.abs_diff(j) == 1 {
            -1.0
        } else {
            0.0
        }
    });
    let problem = ContactProblem::new(chain, DVector::from_element(n, -1.0)).rows_per_contact(1).build().expect("valid");
    let rough = AutoWithin { tolerance: 0.5 }.solve(&problem, None).expect("it has an answer");
    let fine = AutoWithin { tolerance: STOP }.solve(&problem, None).expect("it has an answer");
    let relative = |answer| residuals(&problem, answer).expect("sizes fit").judged.relative();
    assert!(relative(&rough) <= 0.5 && relative(&fine) <= STOP && rough.iterations < fine.iterations);
}

#[test]
fn what_the_normal_rows_alone_have_is_had_with_tangential_rows_that_nothing_rubs() {
    // 0 ≤ r ⟂ (1 − r₁, r₁ − 1) ≥ 0 is solved by r₁ = 1 and any r₂ ≥ 0; and 0 · r − 1 ≥ 0 by nothing
    let several = DMatrix::from_row_slice(2, 2, &[-1.0, 0.0, 1.0, 0.0]);
    for law in [Law::Frictionless, Law::Coulomb, Law::Associated] {
        for rows in [2, 3] {
            let with_tangents = |normals: &DMatrix<f64>| {
                let n = normals.nrows() * rows;
                DMatrix::from_fn(n, n, |i, j| match (i % rows, j % rows) {
                    (0, 0) => normals[(i / rows, j / rows)],
                    _ => f64::from(i == j) + if j % rows == 0 { 0.25 } else { 0.0 },
                })
            };
            let made = |normals: &DMatrix<f64>, closing: &[f64]| {
                let free = DVector::from_fn(normals.nrows() * rows, |i, _| if i % rows == 0 { closing[i / rows] } else { 0.5 });
                let friction = vec![0.0; normals.nrows()];
                ContactProblem::new(with_tangents(normals), free).rows_per_contact(rows).law(law).friction(friction).build().expect("valid")
            };
            let problem = made(&several, &[1.0, -1.0]);
            let blocks = crate::operator::BlockSparse::from_sparse(&crate::operator::Sparse::of(problem.dense()), rows)
                .expect("blocks of these rows");
            let stored = problem.clone().into_builder().delassus(blocks).build().expect("valid");
            for problem in [problem, stored] {
                let answer = Auto.solve(&problem, None).expect("it has an answer");
                assert!(residuals(&problem, &answer).expect("sizes fit").is_solution(CERTIFY), "{law:?} {rows}: {answer:?}");
                assert!((answer.impulse[0] - 1.0).abs() <= CERTIFY, "{law:?} {rows}: {answer:?}");
            }
            let none = Auto.solve(&made(&DMatrix::zeros(1, 1), &[-1.0]), None);
            assert!(none.as_ref().is_err_and(is_infeasible), "{law:?} {rows}: {none:?}");
        }
    }
}

/// Contacts under friction along four directions, by W, u_free and μ.
fn squares(w: &[f64], free: &[f64], mu: f64) -> ContactProblem {
    let made = ContactProblem::new(DMatrix::from_row_slice(free.len(), free.len(), w), DVector::from_row_slice(free));
    made.law(Law::PolyhedralCoulomb { directions: 4 }).friction(vec![mu; free.len() / 3]).build().expect("valid")
}

#[test]
fn where_polyhedral_friction_jams_every_cone_is_looked_at_before_it_is_given_up() {
    // W is semidefinite and some impulse is feasible, yet none of ten patterns – open, sticking, four edges, four sides – holds
    let none = squares(&[2.5, 2.75, 4.0, 2.75, 4.25, 3.0, 4.0, 3.0, 8.0], &[-2.0, 1.0, -0.5], 2.0);
    let Err(Error::Solver { failure, reason, .. }) = Auto.solve(&none, None) else { panic!("there is none") };
    assert!(failure == Failure::Infeasible && reason.contains("no complementary cone"), "{reason}");
    // three solutions, which pivots and sweeps miss
    let rows = [
        [0.25, -0.25, 0.25, 2.0, 1.5, 0.5],
        [-0.25, -0.25, -1.5, -0.25, -1.25, 2.0],
        [0.25, -1.5, 0.75, -0.75, 1.5, 1.25],
        [2.0, -0.25, -0.75, 1.25, 0.25, -0.5],
        [1.5, -1.25, 1.5, 0.25, 2.0, 0.0],
        [0.5, 2.0, 1.25, -0.5, 0.0, 0.5],
    ];
    let hard = squares(&rows.concat(), &[-1.25, -0.25, -1.25, -0.5, -2.0, -0.5], 0.5);
    let answer = Auto.solve(&hard, None).expect("it has some");
    assert!(residuals(&hard, &answer).expect("sizes fit").is_solution(ENOUGH), "{}", answer.solver);
}

#[test]
fn a_square_w_of_which_most_is_zero_is_solved_by_its_blocks() {
    for (cubes, is_stored) in [(7, false), (8, true), (12, true)] {
        let square = tower(cubes, Law::Coulomb, 0.05);
        let stored = by_blocks::stored(&square);
        assert_eq!(stored.is_some(), is_stored, "{} rows", square.rows());
        let Some(stored) = stored else { continue };
        assert_eq!(stored.dense(), square.dense(), "the same numbers");
        let [answer, own] = [&square, &stored].map(|problem| Auto.solve(problem, None).expect("it has an answer"));
        assert_eq!((&answer.impulse, answer.velocity == square.velocity(&answer.impulse)), (&own.impulse, true));
        assert!(residuals(&square, &answer).expect("sizes fit").is_solution(CERTIFY));
    }
    // where most contacts meet, and where a soft contact needs the mass, W stays as it is
    let full = ContactProblem::new(DMatrix::from_element(96, 96, 1.0), DVector::from_element(96, -1.0)).friction(vec![0.5; 32]);
    let soft = Compliance { coordinates: Coordinates::Contact, diagonal: DVector::from_element(96, 0.1) };
    let soft = tower(8, Law::Coulomb, 0.0).into_builder().compliance(soft);
    for problem in [full, soft] {
        assert!(by_blocks::stored(&problem.build().expect("valid")).is_none());
    }
}
