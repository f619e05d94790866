//! Tests of the residuals: both sides of every condition, units, and an error a single relative number hides.

use super::super::judged::Worst;
use super::*;
use crate::certificate::Part;
use crate::problem::{Compliance, Coordinates, Dynamics};
use crate::solvers::{Auto, ContactSolver};

/// Decoupled planar contacts of unit mass with μ = ½.
pub(super) fn planar(law: Law, free_velocity: &[f64]) -> ContactProblem {
    let rows = free_velocity.len();
    ContactProblem::new(DMatrix::identity(rows, rows), DVector::from_row_slice(free_velocity))
        .name("planar")
        .law(law)
        .rows_per_contact(2)
        .friction(vec![0.5; rows / 2])
        .build()
        .unwrap()
}

pub(super) fn answer(problem: &ContactProblem, impulse: &[f64]) -> Solution {
    let impulse = DVector::from_row_slice(impulse);
    let velocity = problem.velocity(&impulse);
    Solution::new("hand", impulse, velocity, 0)
}

fn judged(problem: &ContactProblem, impulse: &[f64]) -> Residuals {
    residuals(problem, &answer(problem, impulse)).unwrap()
}

/// u_free = (−1, 2), μ = ½. Coulomb: r = (1, −½). Associated: r = r_n(1, −½) with r·u = 0, r_n = 8/5.
pub(super) const SLIDING: [f64; 2] = [-1.0, 2.0];

#[test]
fn the_exact_answer_has_no_residual_and_each_mistake_shows_in_its_own_unit() {
    let problem = planar(Law::Coulomb, &SLIDING);
    let exact = judged(&problem, &[1.0, -0.5]);
    assert_eq!((exact.primal, exact.dual, exact.complementarity, exact.natural_map), (0.0, 0.0, 0.0, 0.0));
    assert!(exact.is_solution(0.0));
    // outside the cone: distance (0.6 − 0.5)/√1.25
    let outside = judged(&problem, &[1.0, -0.6]);
    assert!((outside.primal - 0.1 / 1.25f64.sqrt()).abs() <= f64::EPSILON && !outside.is_solution(1e-8));
    // penetrating: y_n = −½, ŷ = y + μ‖y_t‖n is ½ below the dual cone, at distance ½/√1.25
    let penetrating = judged(&problem, &[0.5, -0.25]);
    assert!((penetrating.dual - 0.5 / 1.25f64.sqrt()).abs() <= 2.0 * f64::EPSILON && !penetrating.is_solution(1e-8));
    // friction too weak: r·ŷ = μ‖y_t‖ r_n − 0.4·1.6 = 0.16 J
    let weak = judged(&problem, &[1.0, -0.4]);
    assert!((weak.complementarity - 0.16).abs() <= 4.0 * f64::EPSILON && !weak.is_solution(1e-8));
}

#[test]
fn the_two_laws_do_not_accept_each_others_sliding() {
    let associated = planar(Law::Associated, &SLIDING);
    assert!(judged(&associated, &[1.6, -0.8]).is_solution(4.0 * f64::EPSILON));
    assert!(!judged(&associated, &[1.0, -0.5]).is_solution(1e-2));
    assert!(!judged(&planar(Law::Coulomb, &SLIDING), &[1.6, -0.8]).is_solution(1e-2));
}

#[test]
fn a_stored_velocity_that_does_not_belong_to_the_impulse_is_refused() {
    let problem = planar(Law::Coulomb, &SLIDING);
    let mut solution = answer(&problem, &[1.0, -0.5]);
    solution.velocity[1] += 1e-3;
    let found = residuals(&problem, &solution).unwrap();
    assert!((found.velocity - 1e-3).abs() <= 2.0 * f64::EPSILON && !found.is_solution(1e-8));
}

#[test]
fn one_relative_number_hides_an_error_that_the_components_show() {
    // contact 0 separates at 1e13 m/s, contact 1 should carry 1 N·s and carries 1e-4 less
    let problem = planar(Law::Coulomb, &[1e13, 0.0, -1.0, 0.0]);
    let found = judged(&problem, &[0.0, 0.0, 1.0 - 1e-4, 0.0]);
    assert!(found.one_kilogram.siconos < 1e-16);
    assert!(found.complementarity > 0.9e-4 && found.natural_map > 0.9e-4);
    assert!(!found.is_solution(1e-8));
    assert!(judged(&problem, &[0.0, 0.0, 1.0, 0.0]).is_solution(1e-15));
}

#[test]
fn the_natural_map_does_not_depend_on_the_units() {
    // m → mm and kg → g: velocities ×10³, W ×10⁻³, impulses ×10⁶
    let si = planar(Law::Coulomb, &SLIDING);
    let small = si.clone().into_builder().free_velocity(si.free_velocity() * 1e3).delassus(si.dense() * 1e-3).build().unwrap();
    let (a, b) = (judged(&si, &[1.0, -0.4]), judged(&small, &[1e6, -0.4e6]));
    let relative = |r: &Residuals| r.natural_map / r.natural_map_scale;
    assert!((relative(&a) - relative(&b)).abs() <= 16.0 * f64::EPSILON * relative(&a));
    assert!((a.one_kilogram.siconos - b.one_kilogram.siconos).abs() > 0.1 * a.one_kilogram.siconos, "Siconos's number does depend on them");
}

#[test]
fn stewart_trinkle_is_judged_through_its_pairs_given_or_recovered() {
    let problem = planar(Law::PolyhedralCoulomb { directions: 2 }, &SLIDING);
    assert!(judged(&problem, &[1.0, -0.5]).is_solution(0.0));
    let mut given = answer(&problem, &[1.0, -0.5]);
    given.beta = Some(DVector::from_vec(vec![0.0, 0.5]));
    given.sigma = Some(DVector::from_vec(vec![1.5]));
    assert!(residuals(&problem, &given).unwrap().is_solution(0.0));
    given.sigma = Some(DVector::from_vec(vec![1.0]));
    assert_eq!(residuals(&problem, &given).unwrap().dual, 0.5);
    given.beta = Some(DVector::from_vec(vec![0.25, 0.5]));
    assert!(residuals(&problem, &given).unwrap().primal >= 0.25);
    assert!(!judged(&problem, &[1.0, -0.4]).is_solution(1e-2), "friction that is too weak");
    assert!(!judged(&problem, &[1.0, -0.6]).is_solution(1e-2), "friction that is too strong");
}

#[test]
fn edge_impulses_follow_from_the_impulse_unless_their_compliance_is_asked_for() {
    let softened = |problem: ContactProblem| {
        let edges = problem.law().directions().unwrap();
        let compliance = Compliance { coordinates: Coordinates::Edge, diagonal: DVector::from_element(edges, 0.35) };
        problem.into_builder().compliance(compliance).build().unwrap()
    };
    let hard = planar(Law::PolyhedralAssociated { directions: 2 }, &SLIDING);
    assert!(judged(&hard, &[1.6, -0.8]).is_solution(4.0 * f64::EPSILON));
    assert!(!judged(&hard, &[1.0, -0.5]).is_solution(1e-2));
    // edge 1 alone carries: f(1.25 + R) = 2 with R = 0.35
    assert!(judged(&softened(hard), &[1.25, -0.625]).is_solution(4.0 * f64::EPSILON));
    let spatial = ContactProblem::new(DMatrix::identity(3, 3), DVector::from_vec(vec![-1.0, 2.0, 0.0]));
    let spatial = spatial.law(Law::PolyhedralAssociated { directions: 4 }).friction(vec![0.5]).build().unwrap();
    let soft = softened(spatial.clone());
    let message = residuals(&soft, &answer(&soft, &[1.25, -0.625, 0.0])).unwrap_err().to_string();
    assert!(message.contains("beta"), "{message}");
    assert!(judged(&spatial, &[1.6, -0.8, 0.0]).is_solution(8.0 * f64::EPSILON));
}

#[test]
fn sizes_are_checked_and_nan_is_no_solution() {
    let problem = planar(Law::Coulomb, &SLIDING);
    let mut solution = answer(&problem, &[1.0, -0.5]);
    solution.impulse[0] = f64::NAN;
    assert!(!residuals(&problem, &solution).unwrap().is_solution(f64::INFINITY));
    solution.impulse = DVector::zeros(3);
    assert!(residuals(&problem, &solution).unwrap_err().to_string().contains("impulse"));
}

#[cfg(feature = "files")]
#[test]
fn residuals_are_written_with_units() {
    let found = judged(&planar(Law::Coulomb, &SLIDING), &[1.0, -0.5]);
    let json = serde_json::to_value(found).unwrap();
    assert_eq!((&json["dual"]["value"], &json["dual"]["unit"]), (&serde_json::json!(0.0), &serde_json::json!("m/s")));
    assert_eq!(json["siconos"], serde_json::json!({"value": 0.0, "unit": "1"}));
    assert_eq!(json["complementarity"]["unit"], "J");
}

#[test]
fn momentum_sees_a_missing_impulse() {
    let one = DMatrix::identity(1, 1);
    let v = |x: f64| DVector::from_element(1, x);
    assert_eq!(momentum(&(one.clone() * 2.0), &v(1.5), &v(-1.0), &one, &v(4.0)), 0.0);
    assert_eq!(momentum(&(one.clone() * 2.0), &v(1.5), &v(-1.0), &one, &v(3.0)), 1.0);
}

#[test]
fn every_residual_alone_decides_on_both_sides_of_its_limit() {
    let none = judged(&planar(Law::Coulomb, &SLIDING), &[1.0, -0.5]);
    assert!(none.is_solution(0.125));
    type Field = fn(&mut Judged) -> &mut Worst;
    let fields: [Field; 6] = [
        |judged| &mut judged.primal,
        |judged| &mut judged.dual,
        |judged| &mut judged.complementarity,
        |judged| &mut judged.normal,
        |judged| &mut judged.tangential,
        |judged| &mut judged.velocity,
    ];
    for (index, field) in fields.into_iter().enumerate() {
        for (value, accepted) in [(0.25, true), (0.25f64.next_up(), false), (f64::NAN, false)] {
            let mut found = none;
            field(&mut found.judged).part = Part { value, scale: 2.0, floor: 0.0 };
            assert_eq!(found.is_solution(0.125), accepted, "residual {index} at {value}");
        }
    }
}

#[test]
fn nan_is_passed_on_by_every_law() {
    let laws = [Law::Frictionless, Law::Coulomb, Law::Associated];
    for law in laws.into_iter().chain([Law::PolyhedralCoulomb { directions: 2 }, Law::PolyhedralAssociated { directions: 2 }]) {
        for place in 0..2 {
            let problem = planar(law, &SLIDING);
            let mut solution = answer(&problem, &[1.0, -0.5]);
            solution.impulse[place] = f64::NAN;
            let found = residuals(&problem, &solution).unwrap();
            assert!(found.complementarity.is_nan() && found.natural_map.is_nan() && found.velocity.is_nan(), "{law:?}: {found:?}");
        }
    }
}

#[test]
fn an_answer_whose_residuals_overflow_is_no_solution() {
    let problem = planar(Law::Coulomb, &[-1.5e308, 1.5e308]);
    // twice the friction the cone allows, but both scales are infinite, and everything is at most infinity
    let found = judged(&problem, &[1.5e308, -1.5e308]);
    assert!(found.impulse_scale.is_infinite() && found.velocity_scale.is_infinite());
    assert!(!found.is_solution(1e-8) && found.no_number().is_some());
    // contacts that open as fast have a solution, in units in which the norm is a number although no square is one
    let open = |fast: f64| judged(&planar(Law::Coulomb, &[fast, 0.0, fast, 0.0]), &[0.0; 4]);
    assert!(open(1e200).is_solution(0.0) && open(1e308).is_solution(0.0));
    assert!(!open(1.5e308).is_solution(1.0) && open(1.5e308).no_number() == Some("velocity_scale"));
    // the same motion in units in which the squares are numbers is refused for its own sake, and its solution accepted
    let problem = planar(Law::Coulomb, &[-1e100, 1e100]);
    assert!(!judged(&problem, &[1e100, -1e100]).is_solution(1e-8));
    assert!(judged(&problem, &[1e100, -0.5e100]).is_solution(1e-8));
}

/// Contacts of 10⁸ kg and 1 kg that meet nothing in common close at 1 m/s, frictionless; the light one gets 0.01 N·s too little.
fn light_beside_heavy(name_one_pair: bool, coupling: f64, dynamics: Option<Dynamics>) -> bool {
    let mut delassus = DMatrix::from_diagonal(&DVector::from_row_slice(&[1e-8, 1e-8, 1.0, 1.0]));
    (delassus[(0, 2)], delassus[(2, 0)]) = (coupling, coupling);
    let problem = planar(Law::Frictionless, &[-1.0 - coupling * 0.99, 0.0, -1.0 - coupling * 1e8, 0.0]).into_builder();
    let problem = problem.delassus(delassus).dynamics(dynamics).bodies(name_one_pair.then(|| vec![[Some(0), None]; 2])).build().unwrap();
    judged(&problem, &[1e8, 0.0, 0.99, 0.0]).is_solution(1e-8)
}

#[test]
fn a_name_joins_no_contacts_that_nothing_couples() {
    let separate =
        || Dynamics { mass: DMatrix::from_diagonal(&DVector::from_row_slice(&[1e8, 1e8, 1.0, 1.0])), jacobian: DMatrix::identity(4, 4) };
    assert!(!light_beside_heavy(false, 0.0, None), "nothing is known: each contact stands alone");
    assert!(!light_beside_heavy(true, 0.0, None), "one pair by name, but W couples nothing");
    assert!(!light_beside_heavy(true, 1e-13, None), "one pair by name, but W couples no more than rounding");
    assert!(light_beside_heavy(true, 1e-5, None), "one pair by name, and W couples it: one size for both");
    assert!(!light_beside_heavy(true, 1e-5, Some(separate())), "one pair by name, but H says that it is two");
    assert!(!light_beside_heavy(false, 1e-5, None), "W couples two pairs");
}

#[test]
fn a_residual_of_zero_has_the_limit_of_its_contact() {
    let problem = planar(Law::Coulomb, &[-1.0, 2.0]);
    let found = judged(&problem, &[1.0, -0.5]);
    for (name, worst, _) in found.judged.entries() {
        assert_eq!(worst.part.value, 0.0, "{name}");
        assert!(worst.part.limit(1e-8) > 0.0, "{name}: {:?}", worst.part);
    }
}

#[test]
fn coordinates_that_mix_two_bodies_join_no_contacts_that_nothing_couples() {
    // 10⁶ kg and 1 kg in sum and difference coordinates: every row of H touches both columns
    let (heavy, light) = (0.25e6, 0.25);
    let mass = DMatrix::from_row_slice(2, 2, &[heavy + light, heavy - light, heavy - light, heavy + light]);
    let jacobian = DMatrix::from_row_slice(2, 2, &[0.5, 0.5, 0.5, -0.5]);
    let problem = ContactProblem::from_dynamics(mass, jacobian, &DVector::from_row_slice(&[-2.0, 0.0]));
    let problem = problem.law(Law::Frictionless).rows_per_contact(1).build().unwrap();
    assert!(judged(&problem, &[1e6, 1.0]).is_solution(1e-8));
    assert!(!judged(&problem, &[1e6, 0.992]).is_solution(1e-8), "the light one goes into the floor");
}

/// Contacts of one body of 1 kg and 1 kg·m² along a line, at these places, frictionless; the body falls at 1 m/s and turns at ½ rad/s.
fn along(places: &[f64]) -> ContactProblem {
    let jacobian = DMatrix::from_fn(places.len(), 2, |k, column| if column == 0 { 1.0 } else { places[k] });
    let problem = ContactProblem::from_dynamics(DMatrix::identity(2, 2), jacobian, &DVector::from_row_slice(&[-1.0, 0.5]));
    problem.law(Law::Frictionless).rows_per_contact(1).build().unwrap()
}

#[test]
fn contacts_of_one_body_that_do_not_move_each_other_are_joined_through_a_third_in_any_order() {
    // at ±1, the radius of gyration, a push at one point leaves the other at rest: W = 1 + x x'
    let scale = |places: &[f64], at: f64| {
        let problem = along(places);
        let mut scales = super::super::scales::Scales::default();
        scales.prepare(&problem);
        let zero = vec![0.0; places.len()];
        let pushed: Vec<f64> = places.iter().map(|x| if *x == 1.0 { 1e2 } else { 0.0 }).collect();
        scales.set_sizes(&problem, &pushed, &zero);
        scales.at(places.iter().position(|x| *x == at).unwrap())[1]
    };
    assert!(scale(&[1.0, -1.0], -1.0) < 10.0, "nothing joins them");
    for places in [[1.0, -1.0, 0.25], [1.0, 0.25, -1.0], [0.25, -1.0, 1.0], [-1.0, 1.0, 0.25]] {
        assert!(scale(&places, -1.0) > 50.0, "{places:?}: the third moves with both");
    }
}

#[test]
fn a_name_joins_a_contact_only_to_those_that_it_moves_itself() {
    // W couples the first with the second, the second with the third, and not the first with the third
    let problem = planar(Law::Frictionless, &[-1e6, 0.0, -5e5, 0.0, -1.0, 0.0]);
    let mut delassus = problem.dense().clone();
    (delassus[(0, 2)], delassus[(2, 0)]) = (0.5, 0.5);
    (delassus[(2, 4)], delassus[(4, 2)]) = (0.5, 0.5);
    let problem = problem.into_builder().delassus(delassus).bodies(vec![[Some(0), None]; 3]).build().unwrap();
    assert!(judged(&problem, &[1e6, 0.0, 0.0, 0.0, 1.0, 0.0]).is_solution(1e-8));
    assert!(!judged(&problem, &[1e6, 0.0, 0.0, 0.0, 1.001, 0.0]).is_solution(1e-8), "the third is not held against the first");
}

#[test]
fn a_jaw_that_closes_has_no_solution_however_hard_it_is_pressed() {
    // one mass of 1 kg between two walls that both come nearer by 1 m/s: W = (1, −1; −1, 1)
    let mut delassus = DMatrix::zeros(4, 4);
    for (row, column, sign) in [(0, 0, 1.0), (0, 2, -1.0), (2, 0, -1.0), (2, 2, 1.0)] {
        delassus[(row, column)] = sign;
    }
    let problem = planar(Law::Frictionless, &[-1.0, 0.0, -1.0, 0.0]).into_builder().delassus(delassus).build().unwrap();
    // from 1e16 N·s on the velocities of the walls are lost in the rounding of W r, and y is 0
    for pressed in [1.0, 1e8, 1e12, 1e15, 1e16, 1e18, 1e100] {
        assert!(!judged(&problem, &[pressed, 0.0, pressed, 0.0]).is_solution(1e-8), "{pressed} N·s");
    }
    // walls that stand hold it with any pressure
    let problem = problem.into_builder().free_velocity(DVector::zeros(4)).build().unwrap();
    assert!([0.0, 1.0, 1e12].iter().all(|&pressed| judged(&problem, &[pressed, 0.0, pressed, 0.0]).is_solution(1e-8)));
}

#[test]
fn a_stored_tangential_velocity_is_held_against_the_tangential_mass() {
    // W = diag(1, 100): ρ_t = 1/100 kg, and the sliding contact has s_t = max(‖r‖, ρ_t |(W r)_t|, ρ_t |q_t|) = √5/2 N·s
    let sliding = planar(Law::Coulomb, &SLIDING);
    let light = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 100.0]));
    let problem = sliding.into_builder().delassus(light).free_velocity(DVector::from_vec(vec![-1.0, 100.0])).build().unwrap();
    let accepted = |error: f64| {
        let mut solution = answer(&problem, &[1.0, -0.5]);
        solution.velocity[1] += error;
        residuals(&problem, &solution).unwrap().is_solution(1e-3)
    };
    let scale = 100.0 * 1.25f64.sqrt();
    assert!(accepted(0.99e-3 * scale) && !accepted(1.01e-3 * scale));
}

/// Rows (0 1 −1; −1 0 0; −1 0 0) and q = (0, −1, 1): w₂ = −z₁ − 1 < 0, so that no z ≥ 0 is even feasible.
#[test]
fn an_impulse_that_does_not_move_its_own_contact_excuses_no_velocity() {
    let w = DMatrix::from_row_slice(3, 3, &[0.0, 1.0, -1.0, -1.0, 0.0, 0.0, -1.0, 0.0, 0.0]);
    let problem = ContactProblem::new(w, DVector::from_row_slice(&[0.0, -1.0, 1.0])).rows_per_contact(1).build().unwrap();
    for size in [1.0, 2f64.powi(28), 2f64.powi(60)] {
        let impulse = DVector::from_row_slice(&[0.0, size, 0.0]);
        let answer = Solution::new("along a ray", impulse.clone(), problem.velocity(&impulse), 0);
        assert!(!residuals(&problem, &answer).unwrap().is_solution(0.1), "{size}");
    }
}

/// −4·10⁹ z − 1 ≥ 0 asks for z < 0: a pull of 2.5·10⁻¹⁰ N·s is small beside the kilograms of other contacts, and a pull all the same.
#[test]
fn a_pull_at_a_contact_that_does_not_move_itself_is_held_against_impulses() {
    for (w, q, pull) in [
        (DMatrix::from_element(1, 1, -4e9), [-1.0].as_slice(), [-2.5e-10].as_slice()),
        (DMatrix::from_row_slice(2, 2, &[1e-6, 0.0, 0.0, -1e3]), &[-1.0; 2], &[1e6, -1e-3]),
    ] {
        let problem = ContactProblem::new(w, DVector::from_row_slice(q)).rows_per_contact(1).build().unwrap();
        let impulse = DVector::from_row_slice(pull);
        let answer = Solution::new("a pull", impulse.clone(), problem.velocity(&impulse), 0);
        assert!(!residuals(&problem, &answer).unwrap().is_solution(0.1), "{pull:?}");
    }
}

/// A problem in space with these blocks of W on its diagonal, contacts that do not meet.
fn apart(law: Law, blocks: &[[[f64; 3]; 3]], free: &[f64], mu: f64) -> ContactProblem {
    let n = blocks.len();
    let w = DMatrix::from_fn(3 * n, 3 * n, |i, j| if i / 3 == j / 3 { blocks[i / 3][i % 3][j % 3] } else { 0.0 });
    ContactProblem::new(w, DVector::from_row_slice(free)).law(law).friction(vec![mu; n]).build().unwrap()
}

#[test]
fn friction_on_an_open_contact_is_refused_however_heavy_it_is_along_its_normal() {
    for law in [
        Law::Coulomb,
        Law::Associated,
        Law::PolyhedralCoulomb { directions: 4 },
        Law::PolyhedralCoulomb { directions: 8 },
        Law::PolyhedralAssociated { directions: 4 },
    ] {
        for normal in [1.0, 1e-3, 1e-6, 1e-9, 1e-12] {
            let problem = apart(law, &[[[normal, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]], &[1.0, 0.0, 0.0], 0.5);
            assert!(judged(&problem, &[0.0; 3]).is_solution(0.0), "{law:?} {normal}");
            assert!(!judged(&problem, &[0.0, 1e-4, 0.0]).is_solution(1e-8), "{law:?} {normal}: it slips at 10⁻⁴ of what is given");
        }
    }
}

#[test]
fn friction_that_pushes_along_the_slip_is_refused_however_large_mu_is() {
    // both rows stick but for a normal impulse of about 2/μ: u_n = −1 + r_n + ½ r₁ = 0, u₁ = −4 + ½ r_n + r₁, u₂ = 1 + r₂
    let block = [[1.0, 0.5, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for mu in [1e1, 1e2, 1e4, 1e6, 1e8] {
        for law in [Law::Coulomb, Law::PolyhedralCoulomb { directions: 4 }] {
            let problem = apart(law, &[block], &[-1.0, -4.0, 1.0], mu);
            let answer = Auto.solve(&problem, None).unwrap();
            assert!(residuals(&problem, &answer).unwrap().is_solution(1e-8), "{mu} {law:?}");
        }
        let problem = apart(Law::Coulomb, &[block], &[-1.0, -4.0, 1.0], mu);
        let right = Auto.solve(&problem, None).unwrap().impulse;
        let along = [right[0], right[1], -right[2]];
        assert!(right[2] < -1e-3 && !judged(&problem, &along).is_solution(1e-8), "{mu}: {right}");
        for off in [1e-6, 1e-3] {
            assert!(!judged(&problem, &[right[0], right[1], right[2] + off]).is_solution(1e-8), "{mu}: {off}");
        }
    }
}

#[test]
fn an_impulse_that_does_not_move_its_contact_is_judged_by_itself_in_every_unit_and_beside_any_mass() {
    // W_nn = 0: friction alone stops the closing at 1 m/s, and the normal impulse moves the contact along its tangent
    let block = |unit: f64| [[0.0, -unit, 0.0], [unit, -unit, 0.0], [0.0, 0.0, -unit]];
    for unit in [1e-12, 1e-3, 1.0, 1e3, 1e12] {
        let alone = apart(Law::Coulomb, &[block(unit)], &[-1.0, 0.0, 0.0], 1.0);
        let heavy = [[1e-9, 0.0, 0.0], [0.0, 1e-9, 0.0], [0.0, 0.0, 1e-9]];
        let beside = apart(Law::Coulomb, &[block(unit), heavy], &[-1.0, 0.0, 0.0, 1.0, 0.0, 0.0], 1.0);
        let is_solution = |pressed: f64| {
            let r = [pressed / unit, -1.0 / unit, 0.0, 0.0, 0.0, 0.0];
            [judged(&alone, &r[..3]).is_solution(1e-8), judged(&beside, &r).is_solution(1e-8)]
        };
        assert_eq!(is_solution(1.0), [true; 2], "{unit}");
        for wrong in [1.0 + 1e-5, 1.5, 1e3] {
            assert_eq!(is_solution(wrong), [false; 2], "{unit}: {wrong}");
        }
    }
}

#[test]
fn a_fast_island_excuses_nothing_in_a_slow_one() {
    // a jaw that closes at 10⁻⁷ m/s from both sides, and a ball that leaves at 10⁶ m/s
    let w = DMatrix::from_row_slice(3, 3, &[1.0, -1.0, 0.0, -1.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    let with = |last: f64| {
        let problem = ContactProblem::new(w.clone(), DVector::from_row_slice(&[-1e-7, last, 1e6]));
        problem.rows_per_contact(1).law(Law::Frictionless).build().unwrap()
    };
    for pressed in [1e-7, 1.0, 1e5, 1e12] {
        assert!(!judged(&with(-1e-7), &[pressed, pressed, 0.0]).is_solution(1e-8), "{pressed}: both sides close");
    }
    assert!(judged(&with(1e-7), &[1e-7, 0.0, 0.0]).is_solution(1e-8), "carried along");
    assert!(judged(&with(1e-7), &[1.0, 1.0, 0.0]).judged.loaded > 1e6);
}

#[test]
fn a_product_is_no_stricter_than_the_velocity_in_it() {
    // 1 kg carried along between two walls at 1 m/s: any squeeze solves it, and 10³ of what is given excuses 10⁻⁵ of the velocity
    let w = DMatrix::from_row_slice(2, 2, &[1.0, -1.0, -1.0, 1.0]);
    let problem = ContactProblem::new(w, DVector::from_row_slice(&[-1.0, 1.0])).rows_per_contact(1).law(Law::Frictionless).build().unwrap();
    let squeezed = |off: f64| judged(&problem, &[1e5 + 1.0 + off, 1e5]);
    for (off, accepted) in [(0.0, true), (9e-6, true), (1.1e-5, false)] {
        assert_eq!(squeezed(off).is_solution(1e-8), accepted, "{off}");
    }
}

#[test]
fn an_impulse_that_moves_nothing_excuses_no_velocity_however_large_it_is() {
    let laws = [Law::Coulomb, Law::Associated, Law::PolyhedralCoulomb { directions: 4 }, Law::PolyhedralAssociated { directions: 4 }];
    // two bodies that nothing moves, and W of one that is not symmetric: no normal impulse opens it
    let [still, skew] = [[[0.0; 3]; 3], [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]];
    for (law, size) in laws.into_iter().flat_map(|law| [1.0, 1e3, 1e8, 1e12, 1e18].map(|size| (law, size))) {
        for (block, q, mu) in
            [(still, [-1.0, 0.0, 0.0], 0.5), (still, [-1.0, 1.0, 0.0], 0.5), (still, [0.5, 2.0, 0.0], 3.0), (skew, [-1.0, 1.0, 0.0], 0.5)]
        {
            let problem = apart(law, &[block], &q, mu);
            for impulse in [[size, 0.0, 0.0], [size, -mu * size, 0.0], [size, -0.5 * mu * size, 0.0]] {
                assert!(!judged(&problem, &impulse).is_solution(1e-8), "{law:?} {q:?} {impulse:?}");
            }
        }
        let sliding = apart(law, &[still], &[0.0, 2.0, 0.0], 0.5);
        assert!(!judged(&sliding, &[size, 0.5 * size, 0.0]).is_solution(1e-8), "{law:?}: friction that pushes along the slip");
        let open = apart(law, &[still], &[3.0, 2.0, 0.0], 0.5);
        assert!(judged(&open, &[0.0; 3]).is_solution(1e-8) && !judged(&open, &[size, 0.0, 0.0]).is_solution(1e-8), "{law:?}");
    }
}
