//! The search among complementary cones against looking at every one, and known solution sets.

use super::*;
use crate::certificate::draw::Draw;
use crate::certificate::lcp::residuals;
use crate::certificate::planted::with;
use moreau_exact::elimination::{principal, solve};
use proptest::prelude::*;

fn lcp(size: usize, matrix: &[i64], vector: &[i64]) -> Lcp<Rational> {
    let numbers = |slice: &[i64]| slice.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>();
    Lcp::new(DMatrix::from_row_slice(size, size, &numbers(matrix)), DVector::from_vec(numbers(vector)))
}

#[test]
fn a_p_matrix_has_one_solution_for_every_q() {
    for q in [[-1, -1], [1, -1], [-1, 1], [1, 1], [0, -3]] {
        let problem = lcp(2, &[2, -1, 1, 1], &q);
        let set = all_solutions(&problem).unwrap();
        assert!(set.is_unique(), "{q:?}: {set:?}");
        assert!(residuals(&problem, &set.points[0]).vanish());
    }
}

#[test]
fn three_solutions_are_all_found() {
    // M = [[1, 2], [2, 1]], q = (−1, −1): supports {1}, {2} and both.
    let set = all_solutions(&lcp(2, &[1, 2, 2, 1], &[-1, -1])).unwrap();
    assert_eq!(set.points.len(), 3);
    assert!(set.families.is_empty());
}

#[test]
fn a_singular_basis_yields_its_whole_family() {
    // 0 ≤ z ⟂ z₁ + z₂ − 1 ≥ 0 twice: the segment z₁ + z₂ = 1.
    let problem = lcp(2, &[1, 1, 1, 1], &[-1, -1]);
    let set = all_solutions(&problem).unwrap();
    let family = set.families.first().expect("the segment");
    let inside = &family.point + &family.direction * ratio(1, 100);
    assert!(residuals(&problem, &inside).vanish() && inside != family.point);
}

#[test]
fn a_solution_hidden_in_a_singular_basis_is_not_missed() {
    // M = 0, q = 0: every z ≥ 0; M = [[0, 0], [1, 0]], q = (0, −1): z₁ ≥ 1 with z₂ = 0, or z₁ = 1.
    let set = all_solutions(&lcp(2, &[0, 0, 1, 0], &[0, -1])).unwrap();
    assert!(!set.is_empty() && !set.families.is_empty());
}

#[test]
fn no_solution_is_proved() {
    assert!(all_solutions(&lcp(2, &[0, 0, 0, 0], &[-1, 0])).unwrap().is_empty());
    assert!(all_solutions(&lcp(2, &[1, -1, -1, 1], &[-2, 1])).unwrap().is_empty());
}

#[test]
fn twenty_one_unknowns_are_refused() {
    assert!(all_solutions(&Lcp::new(DMatrix::identity(21, 21), DVector::from_element(21, ratio(1, 1)))).is_err());
}

#[test]
fn a_search_that_is_stopped_says_so_keeps_what_it_found_and_stops_at_the_same_place_again() {
    // −z + 1 ≥ 0 ⟂ z ≥ 0 in every row: 2⁸ solutions
    let problem = lcp(8, (-DMatrix::<i64>::identity(8, 8)).as_slice(), &[1; 8]);
    let whole = looked_for(&problem, Until::End, u64::MAX, 256);
    assert_eq!((whole.stopped, whole.set.points.len(), whole.cones), (false, 256, 511));
    for (work, most) in [(1 << 12, 256), (1 << 16, 256), (u64::MAX, 255), (u64::MAX, 1), (0, 256)] {
        let [part, again] = [(); 2].map(|()| looked_for(&problem, Until::End, work, most));
        assert!(part.stopped && part.cones <= whole.cones && part.set.points.len() < 256, "{work} {most}");
        assert!(part.set.points.iter().all(|z| residuals(&problem, z).vanish()));
        assert_eq!((again.cones, &again.set), (part.cones, &part.set));
        assert!(part.stop().contains(&part.cones.to_string()) && part.everywhere().is_err());
    }
    // M = 0 and q = 0 has a direction at once
    let zero = lcp(8, &[0; 64], &[0; 8]);
    let family = looked_for(&zero, Until::Family, 1 << 20, 256);
    assert!(!family.stopped && family.set.families.len() == 1 && family.cones < 20);
}

/// Cone by cone: the solution of every regular M_αα that is one, and whether any cone with a singular M_αα holds q.
fn one_by_one(lcp: &Lcp<Rational>) -> (Vec<DVector<Rational>>, bool) {
    let (size, mut points, mut singular) = (lcp.size(), Vec::new(), false);
    for mask in 0..1usize << size {
        let support: Vec<usize> = (0..size).filter(|j| mask >> j & 1 == 1).collect();
        let right_side = DVector::from_fn(support.len(), |i, _| -lcp.vector[support[i]].clone());
        match solve(&principal(&lcp.matrix, &support), &right_side) {
            Some(values) => {
                let mut z = DVector::from_element(size, Rational::ZERO);
                support.iter().zip(values.iter()).for_each(|(&j, value)| z[j] = value.clone());
                if residuals(lcp, &z).vanish() && !points.contains(&z) {
                    points.push(z);
                }
            }
            None => {
                let inside: Vec<bool> = (0..size).map(|j| support.contains(&j)).collect();
                singular |= nonnegative_solution(&complementary_matrix(lcp, &inside), &lcp.vector).point().is_some();
            }
        }
    }
    (points, singular)
}

proptest! {
    #[test]
    fn the_search_finds_what_looking_at_every_cone_finds(
        entries in proptest::collection::vec(-3i64..4, 30), size in 1usize..6, zeros in 0i64..3,
    ) {
        let kept = |x: i64| if x.abs() <= zeros { 0 } else { x };
        let problem = lcp(size, &entries.iter().map(|x| kept(*x)).cycle().take(size * size).collect::<Vec<_>>(), &entries[30 - size..]);
        let set = all_solutions(&problem).unwrap();
        let (points, singular) = one_by_one(&problem);
        for z in &set.points {
            prop_assert!(residuals(&problem, z).vanish());
        }
        for z in &points {
            let within = set.families.iter().any(|family| family.point == *z) || set.points.contains(z);
            prop_assert!(within || singular, "{z} is missing in {set:?}");
        }
        prop_assert!(singular || set.points.len() == points.len(), "{set:?} {points:?}");
        prop_assert_eq!(set.is_empty(), points.is_empty() && !singular);
        prop_assert_eq!(some_solution(&problem).unwrap().is_none(), set.is_empty());
        for family in &set.families {
            let end = family.other_end(&problem);
            let middle = (&family.point + &end) * ratio(1, 2);
            prop_assert!(end != family.point && residuals(&problem, &end).vanish() && residuals(&problem, &middle).vanish());
        }
        if let Some(y) = infeasible(&problem) {
            prop_assert!(set.is_empty() && is_infeasible_by(&problem, &y));
            prop_assert!(!is_infeasible_by(&problem, &(-&y)));
        }
    }
}

#[test]
fn a_wrong_witness_of_infeasibility_is_seen() {
    let problem = lcp(2, &[0, 0, 0, 0], &[-1, 0]);
    let y = infeasible(&problem).expect("w₁ = −1");
    assert!(is_infeasible_by(&problem, &y));
    let other = |entries: [i64; 2]| DVector::from_row_slice(&entries.map(|x| ratio(x, 1)));
    for wrong in [[0, 0], [0, 1], [1, -1]] {
        assert!(!is_infeasible_by(&problem, &other(wrong)), "{wrong:?}");
    }
    assert_eq!(infeasible(&lcp(1, &[-1], &[1])), None);
    assert!(!is_infeasible_by(&lcp(1, &[1], &[-1]), &DVector::from_element(1, ratio(1, 1))), "Mᵀy = 1");
}

/// Whether a solution is one of these points or on one of these polyhedra.
fn covers(lcp: &Lcp<Rational>, cover: &Looked, z: &DVector<Rational>) -> bool {
    let w = lcp.slack(z);
    let on = |support: &[bool]| support.iter().enumerate().all(|(j, inside)| if *inside { w[j].is_zero() } else { z[j].is_zero() });
    cover.set.points.contains(z) || cover.wide.iter().any(|(support, _)| on(support))
}

proptest! {
    #[test]
    fn cones_that_are_passed_over_hold_nothing_that_the_others_do_not(
        entries in proptest::collection::vec(-2i64..3, 30), size in 1usize..6, zeros in 0i64..3,
    ) {
        let kept = |x: i64| if x.abs() <= zeros { 0 } else { x };
        let problem = lcp(size, &entries.iter().map(|x| kept(*x)).cycle().take(size * size).collect::<Vec<_>>(), &entries[30 - size..]);
        let [whole, cover] = [Until::End, Until::Cover].map(|until| looked(&problem, until));
        prop_assert!(cover.set.points.iter().all(|z| residuals(&problem, z).vanish()));
        let ends = whole.wide.iter().flat_map(|(_, family)| {
            let end = family.other_end(&problem);
            [(&family.point + &end) * ratio(1, 2), end]
        });
        for z in whole.set.points.iter().cloned().chain(ends) {
            prop_assert!(covers(&problem, &cover, &z), "{}", z);
        }
        prop_assert_eq!(whole.set.families.is_empty(), cover.set.families.is_empty());
    }
}

/// Solutions of drawn problems that are in none of the cones that are kept.
fn lost() -> usize {
    let (mut draw, mut lost) = (Draw(5), 0);
    for _ in 0..200 {
        let mut whole = |count: usize| (0..count).map(|_| draw.whole(1)).collect::<Vec<_>>();
        let problem = lcp(4, &whole(16), &whole(4));
        let [all, cover] = [Until::End, Until::Cover].map(|until| looked(&problem, until));
        let ends = all.wide.iter().map(|(_, family)| family.other_end(&problem));
        lost += all.set.points.iter().cloned().chain(ends).filter(|z| !covers(&problem, &cover, z)).count();
    }
    lost
}

#[test]
fn a_branch_that_is_cut_off_where_it_holds_a_solution_is_missed() {
    assert_eq!(with(None, lost), 0);
    assert!(with(Some(Plant::Pruned), lost) > 20);
}

#[test]
fn the_zero_problem_is_covered_by_one_cone() {
    // every z ≥ 0: all of w vanishes everywhere, and none of the cones is lost
    let cover = looked(&lcp(6, &[0; 36], &[0; 6]), Until::Cover);
    assert_eq!((cover.wide.len(), cover.cones), (1, 7));
    assert!(cover.wide[0].0.iter().all(|inside| *inside));
}
