//! Proofs against solutions known by construction, enumeration, planted mistakes and problems without a solution.

use super::super::planted::Plant;
use super::*;
use crate::certificate::complementary_cones::all_solutions;
use crate::certificate::lcp::residuals;
use crate::certificate::planted::with;
use nalgebra::{DMatrix, dmatrix, dvector};
use proptest::prelude::*;

/// Numbers in eighths, in [−1, 1], of a linear congruence.
fn eighths(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) % 17) as f64 / 8.0 - 1.0
    }
}

/// An LCP with a matrix that dominates its diagonal, and the only solution of it, in eighths; w = M z + q without rounding.
fn constructed(size: usize, seed: u64, degenerate: bool) -> (Lcp<f64>, DVector<f64>) {
    let mut next = eighths(seed);
    let mut matrix = DMatrix::from_fn(size, size, |_, _| next());
    matrix.fill_diagonal(size as f64 + 1.0);
    let z = DVector::from_fn(size, |i, _| if i % 2 == 0 { 1.0 + next().abs() } else { 0.0 });
    let w = DVector::from_fn(size, |i, _| if i % 2 == 0 || (degenerate && i % 3 == 0) { 0.0 } else { 0.125 + next().abs() });
    (Lcp::new(matrix.clone(), w - matrix * &z), z)
}

fn near(lcp: &Lcp<f64>, z: &DVector<f64>) -> Near {
    match prove(lcp, z).expect("finite") {
        Answer::Near(near) => near,
        Answer::NotProved { row, reason } => panic!("{row:?} {reason}"),
    }
}

#[test]
fn a_known_solution_is_proved_and_an_answer_moved_by_d_has_no_smaller_distance() {
    for (size, seed) in [(1, 1), (4, 2), (19, 3), (60, 4), (EXACT_ROWS, 5), (EXACT_ROWS + 1, 6), (150, 7)] {
        for degenerate in [false, size <= EXACT_ROWS] {
            let (lcp, z) = constructed(size, seed, degenerate);
            let at = near(&lcp, &z);
            assert_eq!(at.exact, size <= EXACT_ROWS);
            assert!(if at.exact { at.distance == 0.0 && at.slack_distance == 0.0 } else { at.distance < 1e-12 }, "{size}: {at:?}");
            assert_eq!(at.support, (0..size).step_by(2).collect::<Vec<_>>());
            assert_eq!(at.degenerate.is_empty(), !degenerate || size < 4, "{at:?}");
            for d in [1e-12, 1e-6, 0.25, 3.0] {
                for row in [0, size / 2, size - 1] {
                    let mut moved = z.clone();
                    moved[row] += d;
                    let d = moved[row] - z[row];
                    match prove(&lcp, &moved).expect("finite") {
                        Answer::Near(near) => {
                            assert!(near.distance >= d - at.distance, "{size} rows, {d}: {near:?}");
                            assert!(near.distance <= d * (1.0 + 1e-9) + 2.0 * at.distance, "{size} rows, {d}: {near:?}");
                        }
                        Answer::NotProved { row, .. } => assert!(row.is_some() && d > 0.1),
                    }
                }
            }
        }
    }
}

#[test]
fn a_distance_is_rounded_up() {
    let lcp = Lcp::new(dmatrix![3.0], dvector![-1.0]);
    let z = 1.0 / 3.0;
    let found = near(&lcp, &dvector![z]);
    let apart = (exact(z) - Rational::ONE / exact(3.0)).magnitude();
    assert!(exact(found.distance) >= apart && exact(found.distance.next_down()) < apart, "{found:?}");
    assert_eq!(found.slack_distance, { at_most((exact(3.0) * exact(z) - Rational::ONE).magnitude()) });
}

#[test]
fn what_is_not_a_solution_names_its_row() {
    // w₂ = −1 whatever z is
    let none = Lcp::new(dmatrix![1.0, 0.0; 0.0, 0.0], dvector![-1.0, -1.0]);
    let Answer::NotProved { row, reason } = prove(&none, &dvector![1.0, 0.0]).unwrap() else { panic!("no solution") };
    assert!(row == Some(1) && reason.contains("w of the row is -1"), "{reason}");
    let mut large = constructed(EXACT_ROWS + 4, 9, false).0;
    large.matrix.row_mut(3).fill(0.0);
    large.vector[3] = -1.0;
    let Answer::NotProved { row, .. } = prove(&large, &DVector::from_element(EXACT_ROWS + 4, 0.0)).unwrap() else { panic!("no solution") };
    assert!(row.is_some());
    assert!(prove(&none, &dvector![1.0]).is_err() && prove(&none, &dvector![1.0, f64::NAN]).is_err());
    assert!(prove(&Lcp::new(dmatrix![f64::NAN], dvector![1.0]), &dvector![0.0]).is_err());
}

#[test]
fn a_row_that_intervals_leave_open_is_decided_in_fractions_or_named() {
    // w of row 1 is z₁ − z₃ = 0 of two equal thirds: its enclosure holds both signs
    for size in [EXACT_ROWS + 2, OPEN_ROWS + 1] {
        let mut matrix = DMatrix::identity(size, size) * 3.0;
        (matrix[(1, 0)], matrix[(1, 2)], matrix[(1, 1)]) = (1.0, -1.0, 0.0);
        let lcp = Lcp::new(matrix, DVector::from_fn(size, |i, _| if i == 1 { 0.0 } else { -1.0 }));
        let z = DVector::from_fn(size, |i, _| if i == 1 { 0.0 } else { 1.0 / 3.0 });
        match prove(&lcp, &z).unwrap() {
            Answer::Near(near) => assert!(size <= OPEN_ROWS && near.exact && near.degenerate == [1], "{near:?}"),
            Answer::NotProved { row, reason } => assert!(size > OPEN_ROWS && row == Some(1) && reason.contains('±'), "{reason}"),
        }
    }
}

/// How often a solution is said to be near from which the only one, known by construction, is farther away; in fractions and by intervals.
fn contradicted() -> [usize; 2] {
    let mut found = [0; 2];
    for (seed, size) in (0..12).flat_map(|seed| [(seed, 8), (seed, EXACT_ROWS + 8)]) {
        let (lcp, z) = constructed(size, seed, false);
        // rows that press are taken for open
        let answer = DVector::from_fn(size, |i, _| if i % 4 == 0 { z[i] } else { 0.0 });
        let Answer::Near(near) = prove(&lcp, &answer).expect("finite") else { continue };
        let apart = (0..size).map(|i| (exact(answer[i]) - exact(z[i])).magnitude()).max().expect("it has rows");
        found[usize::from(size > EXACT_ROWS)] += usize::from(exact(near.distance) < apart);
    }
    found
}

#[test]
fn a_wrong_sign_that_is_taken_for_right_is_contradicted_by_the_known_solution() {
    assert_eq!(with(None, contradicted), [0, 0]);
    assert!(with(Some(Plant::Decided), contradicted).iter().all(|count| *count > 5));
}

#[test]
fn counts_of_known_problems() {
    let of = |matrix: DMatrix<f64>, vector: DVector<f64>| count(&Lcp::new(matrix, vector)).expect("finite");
    assert!(matches!(of(dmatrix![1.0, 4.0; 0.0, 1.0], dvector![-1.0, -1.0]), Count::One(why) if why.contains("minors")));
    assert!(matches!(of(dmatrix![1.0, 2.0; 2.0, 1.0], dvector![-1.0, -1.0]), Count::Exactly(points) if points.len() == 3));
    assert!(matches!(of(dmatrix![1.0, 2.0; 2.0, 1.0], dvector![1.0, 1.0]), Count::One(why) if why.contains("cone")));
    let Count::Continuum(ends) = of(dmatrix![1.0, 1.0; 1.0, 1.0], dvector![-1.0, -1.0]) else { panic!("a segment") };
    let lcp = Lcp::new(dmatrix![1.0, 1.0; 1.0, 1.0].map(exact), dvector![-1.0, -1.0].map(exact));
    assert!(ends[0] != ends[1] && ends.iter().all(|end| residuals(&lcp, end).vanish()));
    // feasible, z₁ ≥ 1 and z₂ ≥ 1, but no complementary cone holds q
    assert_eq!(of(dmatrix![0.0, 1.0; 1.0, 0.0].map(|x: f64| x), dvector![-1.0, -1.0]).is_solvable(), Some(true));
    assert_eq!(of(dmatrix![-1.0, 0.0; 1.0, 1.0], dvector![-1.0, 0.0]).is_solvable(), Some(false));
    let feasible = of(dmatrix![0.0, 1.0; 0.0, 0.0], dvector![-1.0, 1.0]);
    assert!(matches!(feasible, Count::NoCone), "z₂ ≥ 1 presses although w₂ = 1: {feasible:?}");
    let size = FEASIBLE_ROWS + 1;
    assert!(matches!(of(DMatrix::identity(size, size), DVector::from_element(size, -1.0)), Count::One(_)));
    assert_eq!(of(DMatrix::zeros(size, size), DVector::from_element(size, 1.0)).is_solvable(), None);
    let mut empty = DMatrix::zeros(30, 30);
    empty[(0, 1)] = 1.0;
    let mut q = DVector::from_element(30, 1.0);
    q[0] = -1.0;
    assert!(matches!(of(empty.clone(), q.clone()), Count::NoCone));
    q[2] = -1.0;
    let Count::Infeasible(y) = of(empty.clone(), q.clone()) else { panic!("w₃ = −1") };
    assert!(complementary_cones::is_infeasible_by(&whole(&Lcp::new(empty, q)), &y));
}

#[test]
fn large_matrices_whose_structure_shows_it_have_one_solution_and_monotone_ones_one_or_many() {
    let of = |matrix: &DMatrix<f64>, vector: DVector<f64>| count(&Lcp::new(matrix.clone(), vector)).expect("finite");
    let triangular = DMatrix::from_fn(200, 200, |i, j| {
        if i == j {
            0.5
        } else if i > j {
            -3.0
        } else {
            0.0
        }
    });
    assert!(matches!(of(&triangular, DVector::from_element(200, -1.0)), Count::One(why) if why.contains("triangular")));
    // rows twice: M + Mᵀ is singular, and impulses of a pair are determined as a sum only
    let pairs = DMatrix::from_fn(24, 24, |i, j| if i / 2 == j / 2 { 1.0 } else { 0.0 });
    let Count::Continuum(ends) = of(&pairs, DVector::from_element(24, -1.0)) else { panic!("sums") };
    assert!(
        ends[0] != ends[1]
            && ends.iter().all(|end| residuals(&whole(&Lcp::new(pairs.clone(), DVector::from_element(24, -1.0))), end).vanish())
    );
    let apart = DVector::from_fn(24, |i, _| if i % 2 == 0 { -1.0 } else { -0.5 });
    assert!(matches!(of(&pairs, apart), Count::One(why) if why.contains("nothing leads")));
    // M + Mᵀ = 0 has solutions where something is feasible
    let skew = DMatrix::from_fn(24, 24, |i, j| f64::from(i as i32 - j as i32).signum());
    assert_eq!(of(&skew, DVector::from_element(24, 0.0)).is_solvable(), Some(true));
}

#[test]
fn what_is_not_decided_says_where_it_stopped_and_counts_what_it_found() {
    let size = 21;
    let lcp = Lcp::new(-DMatrix::identity(size, size), DVector::from_element(size, 1.0));
    let Count::AtLeast(found, why) = count(&lcp).unwrap() else { panic!("2²¹ solutions are too many") };
    assert!(
        found == crate::tolerance::complementarity::CONE_SOLUTIONS && why.contains("not decided: complete enumeration stopped at"),
        "{why}"
    );
}

proptest! {
    #[test]
    fn proofs_agree_with_enumeration(entries in proptest::collection::vec(-3i32..4, 30), size in 1usize..6, seed in 0u64..1000) {
        let matrix = DMatrix::from_fn(size, size, |i, j| f64::from(entries[i * size + j]));
        let lcp = Lcp::new(matrix, DVector::from_fn(size, |i, _| f64::from(entries[29 - i])));
        let set = all_solutions(&whole(&lcp)).unwrap();
        let counted = count(&lcp).unwrap();
        prop_assert_eq!(counted.is_solvable(), Some(!set.is_empty()));
        prop_assert_eq!(matches!(counted, Count::One(_)), set.is_unique());
        let mut next = eighths(seed);
        let anywhere = DVector::from_fn(size, |_, _| 2.0 * next().abs());
        let nearest = set.points.iter().map(|z| z.map(|z| Scalar::to_f64(&z))).collect::<Vec<_>>();
        match prove(&lcp, &anywhere).unwrap() {
            // a problem without solution gets no proof, and none is nearer than the solutions there are
            Answer::Near(near) if set.families.is_empty() => {
                let least = nearest.iter().map(|z| (z - &anywhere).amax()).fold(f64::INFINITY, f64::min);
                prop_assert!(near.distance >= least * (1.0 - 1e-12), "{} < {least}", near.distance);
            }
            Answer::Near(_) => prop_assert!(!set.is_empty()),
            Answer::NotProved { row, .. } => prop_assert!(row.is_some()),
        }
        for z in nearest.iter().filter(|_| set.families.is_empty()) {
            let Answer::Near(near) = prove(&lcp, z).unwrap() else { return Err(TestCaseError::fail(format!("{z} is a solution"))) };
            prop_assert!(near.distance <= 1e-13 * (1.0 + z.amax()), "{near:?}");
        }
    }

    #[test]
    fn order_and_units_of_rows_change_no_verdict(
        size in 2usize..8,
        seed in 0u64..1000,
        shift in 1usize..8,
        powers in proptest::collection::vec(-20i32..21, 8),
    ) {
        let (lcp, z) = constructed(size, seed, true);
        let place = |i: usize| (i + shift) % size;
        let moved = z.map(|z| z * 1.001);
        let found = near(&lcp, &moved);
        let permuted = Lcp::new(
            DMatrix::from_fn(size, size, |i, j| lcp.matrix[(place(i), place(j))]), DVector::from_fn(size, |i, _| lcp.vector[place(i)]));
        let again = near(&permuted, &DVector::from_fn(size, |i, _| moved[place(i)]));
        prop_assert_eq!((again.distance, again.slack_distance), (found.distance, found.slack_distance));
        let mut back: Vec<usize> = again.degenerate.iter().map(|i| place(*i)).collect();
        back.sort_unstable();
        prop_assert_eq!(&back, &found.degenerate);
        let unit = |i: usize| 2f64.powi(powers[i]);
        let matrix = DMatrix::from_fn(size, size, |i, j| unit(i) * lcp.matrix[(i, j)]);
        let scaled = Lcp::new(matrix, DVector::from_fn(size, |i, _| unit(i) * lcp.vector[i]));
        let again = near(&scaled, &moved);
        prop_assert_eq!((again.distance, again.support, again.degenerate), (found.distance, found.support, found.degenerate));
        prop_assert!(matches!(count(&scaled).unwrap(), Count::One(_)));
    }
}
