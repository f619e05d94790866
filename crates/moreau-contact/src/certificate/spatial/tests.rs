//! The list of all velocities against lists in fractions, closed forms, and lists from which something was taken away.

use super::*;
use crate::certificate::patterns::solutions;
use crate::certificate::residuals;
use crate::tolerance::sharpness::{COUNTED, FEW, MANY, roundings};
use moreau_exact::scalar::Scalar;
use nalgebra::{DMatrix, DVector, dvector};

/// Numbers between −1 and 1, from a linear congruence.
struct Draws(u64);

impl Draws {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 40) as f64 / f64::from(1 << 16) / 128.0) - 1.0
    }

    /// Contacts that share few velocities, so that normal and tangential rows are coupled.
    fn delassus(&mut self, rows: usize, velocities: usize) -> DMatrix<f64> {
        let h = DMatrix::from_fn(rows, velocities, |_, _| self.next());
        &h * h.transpose()
    }
}

/// A problem in the plane, and the same in space: nothing pushes across the plane, whose tangents are turned by these angles.
fn lifted(w: &DMatrix<f64>, free: &DVector<f64>, mu: f64, angles: &[f64]) -> [ContactProblem; 2] {
    let k = free.len() / 2;
    let plane = ContactProblem::new(w.clone(), free.clone()).rows_per_contact(2).friction(vec![mu; k]).build().expect("sizes fit");
    let turn = DMatrix::from_fn(3 * k, 3 * k, |row, column| match (row / 3 == column / 3, row % 3, column % 3) {
        (true, 0, 0) => 1.0,
        (true, 1, 1) | (true, 2, 2) => angles[row / 3].cos(),
        (true, 1, 2) => -angles[row / 3].sin(),
        (true, 2, 1) => angles[row / 3].sin(),
        _ => 0.0,
    });
    let wide = DMatrix::from_fn(3 * k, 3 * k, |i, j| match (i % 3, j % 3) {
        (2, 2) => {
            if i == j {
                1.5
            } else {
                0.25
            }
        }
        (2, _) | (_, 2) => 0.0,
        (a, b) => w[(2 * (i / 3) + a, 2 * (j / 3) + b)],
    });
    let wide_free = DVector::from_fn(3 * k, |i, _| if i % 3 == 2 { 0.0 } else { free[2 * (i / 3) + i % 3] });
    let (w, free) = (&turn * wide * turn.transpose(), turn * wide_free);
    [plane, ContactProblem::new(w, free).friction(vec![mu; k]).build().expect("sizes fit")]
}

/// ‖u‖ at every contact, which no turn changes.
fn speeds(velocity: &[f64], rows: usize) -> Vec<f64> {
    velocity.chunks(rows).map(|u| u.iter().fold(0.0_f64, |sum, u| sum.hypot(*u))).collect()
}

fn rods(free: [f64; 2], contacts: usize) -> (DMatrix<f64>, DVector<f64>) {
    let mut w = DMatrix::zeros(2 * contacts, 2 * contacts);
    for k in 0..contacts {
        w.view_mut((2 * k, 2 * k), (2, 2)).copy_from(&DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 5.0]));
        for other in (0..contacts).filter(|other| *other != k) {
            w[(2 * k, 2 * other)] = 1.0 / 16.0;
        }
    }
    (w, DVector::from_fn(2 * contacts, |row, _| free[row % 2]))
}

fn assert_same_list(plane: &ContactProblem, space: &ContactProblem) -> usize {
    let (expected, found) = (solutions(plane).expect("finite numbers"), velocities(space).expect("finite numbers"));
    assert!(expected.continuum.is_none());
    assert_eq!(found.exactly(), Some(expected.found.len()), "{found:?}");
    let expected: Vec<Vec<f64>> = expected.found.iter().map(|one| speeds(one.velocity.map(|u| Scalar::to_f64(&u)).as_slice(), 2)).collect();
    for (answer, radius) in &found.found {
        let mine = speeds(answer.velocity.as_slice(), 3);
        let near = |other: &&Vec<f64>| (0..mine.len()).all(|k| (mine[k] - other[k]).abs() <= radius.velocity[k] + roundings(MANY));
        assert!(expected.iter().any(|other| near(&other)), "{mine:?} {expected:?}");
        assert!(residuals(space, answer).expect("finite numbers").is_solution(COUNTED));
    }
    found.found.len()
}

#[test]
fn problems_in_a_turned_plane_have_as_many_velocities_as_in_fractions() {
    for contacts in 1..=2 {
        for free in [[1.0, 4.0], [-1.0, 1.0], [1.0, 1.0], [-1.0, -3.0]] {
            let (w, free) = rods(free, contacts);
            let [plane, space] = lifted(&w, &free, 1.0, &[0.0, 0.0, 0.0]);
            let straight = assert_same_list(&plane, &space);
            let [plane, space] = lifted(&w, &free, 1.0, &[0.7, -2.1, 1.3]);
            assert_eq!(assert_same_list(&plane, &space), straight);
        }
    }
}

#[test]
fn what_is_taken_away_from_the_search_is_missed() {
    // the rod turned so that it slides along the first quarter: without that quarter, or without sliding at all, a velocity is lost
    let (w, free) = rods([1.0, 4.0], 1);
    let [plane, space] = lifted(&w, &free, 1.0, &[0.7]);
    assert_eq!(assert_same_list(&plane, &space), 3);
    let count = |patterns, arcs: &[Arc]| searched(&space, patterns, arcs).expect("finite numbers").exactly();
    assert_eq!(count(patterns(&space), &Arc::QUARTERS), Some(3));
    let lost: Vec<Option<usize>> = (0..4)
        .map(|left_out| {
            let arcs: Vec<Arc> = (0..4).filter(|arc| *arc != left_out).map(|arc| Arc::QUARTERS[arc]).collect();
            count(patterns(&space), &arcs)
        })
        .collect();
    assert_eq!(lost.iter().filter(|count| **count == Some(2)).count(), 1, "{lost:?}");
    for left_out in 0..3 {
        let mut fewer = patterns(&space);
        fewer.remove(left_out);
        assert_eq!(count(fewer, &Arc::QUARTERS), Some(2), "each pattern has a solution");
    }
}

#[test]
fn a_vector_that_does_not_separate_proves_nothing() {
    let (w, free) = rods([1.0, 4.0], 1);
    let [_, space] = lifted(&w, &free, 1.0, &[0.7]);
    let data = Data::new(&space);
    let mut draws = Draws(5);
    for piece in patterns(&space).iter().flat_map(|pattern| cut(pattern, &Arc::QUARTERS)) {
        let solved = velocities(&space).expect("finite numbers").found.iter().any(|(answer, radius)| {
            Search { data: &data, all: velocities(&space).expect("finite numbers") }.is_inside(&piece, answer, radius)
        });
        let proved = (0..200).any(|_| separation::proves(&data, &piece, &[draws.next(), draws.next(), draws.next()]));
        assert!(!(solved && (proved || separation::separated(&data, &piece))), "{piece:?}");
    }
    // a piece without a solution is separated by its vector and not by the opposite one
    let open = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 0.0, 0.0]).friction(vec![0.5]).build().expect("sizes fit");
    let data = Data::new(&open);
    assert!(separation::proves(&data, &[Doing::Open], &[-1.0, 0.0, 0.0]) && !separation::proves(&data, &[Doing::Open], &[1.0, 0.0, 0.0]));
    assert!(!separation::proves(&data, &[Doing::Open], &[-1.0, 0.5, 0.0]), "the tangential velocity is free");
    assert!(!separation::proves(&data, &[Doing::Sticking], &[-1.0, 0.0, 0.0]), "it sticks");
}

#[test]
fn one_contact_is_that_of_the_closed_form() {
    // W = diag(1, 2, 2): it sticks if ‖q_t‖/2 ≤ −μ q_n, and else slides against q_t with r_n = −q_n
    let mut draws = Draws(11);
    let mut seen = [0; 3];
    for _ in 0..60 {
        let free = dvector![draws.next(), 2.0 * draws.next(), 2.0 * draws.next()];
        let w = DMatrix::from_diagonal(&dvector![1.0, 2.0, 2.0]);
        let all =
            velocities(&ContactProblem::new(w, free.clone()).friction(vec![0.75]).build().expect("sizes fit")).expect("finite numbers");
        assert_eq!(all.exactly(), Some(1), "{free} {all:?}");
        let (normal, slip) = (free[0], free[1].hypot(free[2]));
        let (case, left) = match (normal > 0.0, slip <= -1.5 * normal) {
            (true, _) => (0, slip),
            (_, true) => (1, 0.0),
            _ => (2, slip + 1.5 * normal),
        };
        seen[case] += 1;
        let (answer, radius) = &all.found[0];
        assert!((answer.velocity[1].hypot(answer.velocity[2]) - left).abs() <= radius.velocity[0] + roundings(FEW));
    }
    assert!(seen.iter().all(|count| *count >= 5), "{seen:?}");
}

#[test]
fn three_contacts_on_random_bodies_are_decided_and_no_answer_is_outside_of_the_list() {
    let mut draws = Draws(7);
    let (mut decided, mut several) = (0, 0);
    for (contacts, case) in (1..=3).flat_map(|contacts| (0..8).map(move |case| (contacts, case))) {
        let w = draws.delassus(3 * contacts, 3 * contacts + 1);
        let free = DVector::from_fn(3 * contacts, |_, _| 2.0 * draws.next());
        let problem = ContactProblem::new(w, free).friction(vec![[0.3, 0.7, 1.5, 3.0][case % 4]; contacts]).build().expect("sizes fit");
        let all = velocities(&problem).expect("finite numbers");
        decided += usize::from(all.exactly().is_some());
        several += usize::from(all.found.len() > 1);
        assert_ne!(all.exactly(), Some(0), "a definite W has a solution");
        assert!(all.found.iter().all(|(answer, _)| residuals(&problem, answer).expect("finite numbers").is_solution(COUNTED)));
    }
    assert!(decided >= 23 && several >= 1, "{decided} {several}");
}

#[test]
fn a_problem_without_solution_has_none_by_all_pieces() {
    // W is not semidefinite: an impulse pulls it in; and Painlevé's rod that arrives has none where sticking needs more than friction gives
    let inward = DMatrix::from_diagonal(&dvector![-1.0, 1.0, 1.0]);
    let problem = ContactProblem::new(inward, dvector![-1.0, 0.5, 0.25]).friction(vec![0.5]).build().expect("sizes fit");
    let all = velocities(&problem).expect("finite numbers");
    assert_eq!(all.exactly(), Some(0), "{all:?}");
}

#[test]
fn other_laws_the_plane_and_more_contacts_are_refused_and_an_undecided_border_is_named() {
    let space = |contacts: usize| {
        let w = DMatrix::identity(3 * contacts, 3 * contacts);
        ContactProblem::new(w, DVector::from_fn(3 * contacts, |row, _| if row % 3 == 0 { -1.0 } else { 0.0 })).friction(vec![0.5; contacts])
    };
    assert!(velocities(&space(4).build().expect("sizes fit")).is_err());
    assert!(velocities(&space(1).law(Law::Associated).build().expect("sizes fit")).is_err());
    assert!(velocities(&lifted(&rods([1.0, 4.0], 1).0, &dvector![1.0, 4.0], 1.0, &[0.0])[0]).is_err());
    assert_eq!(velocities(&space(2).build().expect("sizes fit")).expect("finite numbers").exactly(), Some(1));
    // exactly on the border of its cone: r = (1, 0.5, 0)
    let border = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, -0.5, 0.0]).friction(vec![0.5]).build().expect("sizes fit");
    let all = velocities(&border).expect("finite numbers");
    assert!(all.exactly().is_none() && all.undecided.iter().any(|reason| reason.contact == Some(0)), "{all:?}");
}
