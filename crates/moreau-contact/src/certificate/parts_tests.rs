//! Tests of what an answer gives beside its impulses: β and σ, and edge impulses.

use super::tests::{SLIDING, answer, planar};
use super::*;
use nalgebra::{DMatrix, DVector};

#[test]
fn parts_that_do_not_add_up_to_the_impulse_are_primal_residuals() {
    // Pressed and at rest: every pair is complementary, but Σ Dⱼβⱼ = −0.2 is not r_t = 0.
    let mut stuck = answer(&planar(Law::PolyhedralCoulomb { directions: 2 }, &[-1.0, 0.0]), &[1.0, 0.0]);
    stuck.beta = Some(DVector::from_vec(vec![0.0, 0.2]));
    assert_eq!(residuals(&planar(Law::PolyhedralCoulomb { directions: 2 }, &[-1.0, 0.0]), &stuck).unwrap().primal, 0.2);
    // f = (0.4, 2) has μ Σ Dⱼfⱼ = −0.8 = r_t but Σ fⱼ = 2.4 is not r_n = 1.6.
    let problem = planar(Law::PolyhedralAssociated { directions: 2 }, &SLIDING);
    let mut edges = answer(&problem, &[1.6, -0.8]);
    edges.beta = Some(DVector::from_vec(vec![0.4, 2.0]));
    assert!((residuals(&problem, &edges).unwrap().primal - 0.8).abs() <= 4.0 * f64::EPSILON);
}

#[test]
fn what_an_answer_in_the_plane_gives_of_its_parts_is_judged_under_round_cones_too() {
    let vector = |numbers: &[f64]| Some(DVector::from_row_slice(numbers));
    // one contact slides, the other opens
    let (free, impulse) = ([-1.0, 2.0, 1.0, 2.0], |r: [f64; 2]| [r[0], r[1], 0.0, 0.0]);
    let coulomb = planar(Law::Coulomb, &free);
    let accepts = |beta: Option<&[f64]>, sigma: Option<&[f64]>| {
        let mut given = answer(&coulomb, &impulse([1.0, -0.5]));
        (given.beta, given.sigma) = (beta.and_then(vector), sigma.and_then(vector));
        residuals(&coulomb, &given).unwrap().is_solution(1e-8)
    };
    assert!(accepts(None, None) && accepts(Some(&[0.0, 0.5, 0.0, 0.0]), Some(&[1.5, 2.0])));
    for wrong in [[0.0, 0.4, 0.0, 0.0], [0.1, 0.6, 0.0, 0.0], [0.0, 0.5, 0.0, 0.2], [0.0, 0.5, f64::NAN, 0.0]] {
        assert!(!accepts(Some(&wrong), None), "{wrong:?}");
    }
    for wrong in [[1.0, 2.0], [2.0, 2.0], [1.5, -2.0], [1.5, f64::NAN]] {
        assert!(!accepts(None, Some(&wrong)), "{wrong:?}");
    }
    let associated = planar(Law::Associated, &free);
    let mut edges = answer(&associated, &impulse([1.6, -0.8]));
    for (beta, right) in [([0.0, 1.6, 0.0, 0.0], true), ([0.4, 2.0, 0.0, 0.0], false), ([0.0, 1.6, 0.1, 0.1], false)] {
        edges.beta = vector(&beta);
        assert_eq!(residuals(&associated, &edges).unwrap().is_solution(1e-8), right, "{beta:?}");
    }
    edges.sigma = vector(&[0.0, 0.0]);
    let told = residuals(&associated, &edges).unwrap_err().to_string();
    assert!(told.contains("sigma") && told.contains("`associated`"), "{told}");
    let space = ContactProblem::new(DMatrix::identity(3, 3), DVector::from_vec(vec![-1.0, 0.0, 0.0])).friction(vec![0.5]).build().unwrap();
    for problem in [space, planar(Law::Frictionless, &[-1.0, 0.0])] {
        for field in ["beta", "sigma"] {
            let mut given = answer(&problem, problem.free_velocity().map(|q| -q).as_slice());
            *(if field == "beta" { &mut given.beta } else { &mut given.sigma }) = vector(&[0.0]);
            let told = residuals(&problem, &given).unwrap_err().to_string();
            assert!(told.contains(field) && told.contains(problem.law().name()), "{told}");
        }
    }
}
