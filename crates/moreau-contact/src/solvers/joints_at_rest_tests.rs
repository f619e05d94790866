//! Contacts at rest beside loaded joints: what elimination rounds is no velocity.

use super::*;
use crate::problem::{ConstraintKind, Law};
use crate::solvers::Solvers;
use nalgebra::{dmatrix, dvector};

const JOINT: ConstraintKind = ConstraintKind::Bilateral { rows: 2 };

/// A contact without velocity of its own, beside a joint that carries 7 N·s: r = (0, 0, 7) where q₀ is 0.
fn beside_a_joint(q: f64) -> JointedProblem {
    let w = dmatrix![3.0, 1.0, 0.0; 1.0, 5.0, 1.0; 0.0, 1.0, 6.0];
    let problem = JointedProblem::new(1, vec![ConstraintKind::Contact, JOINT], w, dvector![q, -7.0, -42.0]).unwrap();
    problem.law(Law::Frictionless, vec![0.0; 2]).unwrap()
}

/// A body on a hinge that comes to rest on the floor; W has lost what makes its last row depend on the others.
fn on_a_hinge() -> JointedProblem {
    let w = dmatrix![
        10.422854833816253, -2.6313572515671355, -7.288027854697315, 11.640090060301606;
        -2.6313572515671355, 19.222860551849102, 12.846435867680233, -8.334363306665264;
        -7.288027854697315, 12.846435867680233, 12.45843961344558, -7.649333234272927;
        11.640090060301606, -8.334363306665264, -7.649333234272927, 30.877895995940204
    ];
    let free = dvector![-10.440705537635026, -21.949994935127517, -7.280599617358953, -4.511945556757896];
    let problem = JointedProblem::new(2, vec![JOINT, ConstraintKind::Contact], w, free).unwrap();
    problem.law(Law::Coulomb, vec![0.0, 0.3]).unwrap()
}

#[test]
fn what_elimination_rounds_keeps_no_solver_from_the_answer() {
    let all = Solvers::own();
    for (problem, most) in [(beside_a_joint(0.0), 12), (beside_a_joint(-1e-9), 12), (on_a_hinge(), 6)] {
        let left = WithoutJoints::new(&problem).unwrap();
        let mut solved = 0;
        for name in all.names() {
            let solver = all.by_name(name).unwrap();
            let answer = solve_jointed(&problem, &*solver, None);
            solved += usize::from(answer.as_ref().is_ok_and(|answer| is_accepted(&problem, answer)));
            let is_refused = |error: &Error| matches!(error, Error::Solver { failure: Failure::Refused, .. });
            if name == "auto" {
                assert!(answer.as_ref().is_ok_and(|answer| is_accepted(&problem, answer)), "{name}: {answer:?}");
            } else if let Err(error) = answer {
                assert!(is_refused(&error) || left.at_rest(&problem).is_some(), "{name}: {error}");
            }
        }
        assert!(solved >= most, "{solved}");
    }
}

#[test]
fn fractions_leave_what_rounding_does_not() {
    let problem = beside_a_joint(-1e-9);
    let left = WithoutJoints::new(&problem).unwrap();
    let exact = exactly::left_of_contacts(&problem, &left.contacts).unwrap();
    // (0 1)(5 1; 1 6)⁻¹ of the joint's rows: q̂ = −10⁻⁹ exactly, Ŵ = 3 − 6/29
    assert_eq!((exact.free_velocity()[0], exact.entry(0, 0)), (-1e-9, 81.0 / 29.0));
    assert_ne!(left.contacts.free_velocity()[0], -1e-9, "what is planted");
    let softer = beside_a_joint(0.0);
    let at_rest = WithoutJoints::new(&softer).unwrap().at_rest(&softer).unwrap();
    assert_eq!(at_rest.contacts.free_velocity()[0], 0.0);
    // a velocity that is more than rounding stays
    assert!(WithoutJoints::new(&beside_a_joint(-1e-3)).unwrap().at_rest(&problem).is_none());
}

#[test]
fn a_problem_without_solution_is_told_as_before() {
    // the contact would have to be pulled: its impulse moves it the wrong way, joints or not
    let w = dmatrix![-3.0, 1.0, 0.0; 1.0, 5.0, 1.0; 0.0, 1.0, 6.0];
    let problem = JointedProblem::new(1, vec![ConstraintKind::Contact, JOINT], w, dvector![-1.0, -7.0, -42.0]).unwrap();
    let problem = problem.law(Law::Frictionless, vec![0.0; 2]).unwrap();
    let error = solve_jointed(&problem, &crate::solvers::Auto, None).unwrap_err();
    assert!(matches!(error, Error::Solver { failure: Failure::Infeasible, .. }), "{error}");
}
