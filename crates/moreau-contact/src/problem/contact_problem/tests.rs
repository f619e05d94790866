//! Tests of the builder: what is not said, and what is refused.

use super::*;
use crate::problem::ContactKey;
use moreau_exact::Result;
use nalgebra::{dmatrix, dvector};

fn point() -> ContactProblemBuilder {
    ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).friction(vec![0.0])
}

#[test]
fn what_is_not_said_is_hard_and_spatial() {
    let problem = point().build().expect("sizes fit");
    assert_eq!((problem.rows_per_contact(), problem.contacts(), problem.law(), problem.name()), (3, 1, Law::Coulomb, ""));
    assert_eq!((problem.friction(), problem.shift()), (&[0.0][..], &DVector::zeros(3)));
    assert!(problem.compliance().is_none() && problem.dynamics().is_none() && problem.bodies().is_none());
    assert_eq!(problem.clone().into_builder().build().expect("sizes fit"), problem);
}

#[test]
fn w_and_the_free_velocity_follow_from_mass_jacobian_and_free_motion() {
    let (mass, jacobian) = (dmatrix![2.0, 0.0; 0.0, 4.0], dmatrix![1.0, 1.0; 0.0, 2.0]);
    let problem = ContactProblem::from_dynamics(mass.clone(), jacobian.clone(), &dvector![-1.0, 3.0]);
    let problem = problem.rows_per_contact(2).friction(vec![0.5]).build().expect("sizes fit");
    assert_eq!((problem.dense(), problem.free_velocity()), (&dmatrix![0.75, 0.5; 0.5, 1.0], &dvector![2.0, 6.0]));
    assert_eq!(problem.dynamics(), Some(&Dynamics { mass, jacobian }));
}

#[test]
fn the_operator_is_the_same_by_entry_block_column_and_effect() {
    let w = DMatrix::from_fn(4, 4, |i, j| (1 + 4 * i + j) as f64);
    let problem = ContactProblem::new(w.clone(), DVector::zeros(4)).rows_per_contact(2).friction(vec![0.5; 2]).build().expect("sizes fit");
    let impulse = dvector![1.0, -2.0, 0.5, 0.0];
    let mut columns = vec![0.0; 4];
    impulse.iter().enumerate().for_each(|(j, r)| problem.add_column(j, *r, &mut columns));
    assert_eq!((problem.apply(&impulse).as_slice(), problem.entry(2, 3)), (&columns[..], 12.0));
    assert_eq!((problem.diagonal_block(1), problem.dense()), (w.view((2, 2), (2, 2)).into_owned(), &w));
}

#[test]
fn no_problem_is_built_that_cannot_be_meant() {
    let refused = |problem: Result<ContactProblem>, field: &str| {
        let message = problem.expect_err(field).to_string();
        assert!(message.contains(&format!("`{field}`")), "{message}");
    };
    let diagonal = |entries: &[f64]| Compliance { coordinates: Coordinates::Contact, diagonal: DVector::from_row_slice(entries) };
    refused(point().rows_per_contact(0).build(), "dimension");
    refused(point().rows_per_contact(2).build(), "free_velocity");
    refused(point().friction(vec![0.5; 2]).build(), "friction");
    refused(ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).build(), "friction");
    assert!(ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).law(Law::Frictionless).build().is_ok());
    refused(point().shift(DVector::zeros(2)).build(), "shift");
    refused(point().delassus(DMatrix::zeros(3, 2)).build(), "delassus");
    let one_wrong = DMatrix::from_fn(3, 3, |row, column| if (row, column) == (1, 2) { f64::NAN } else { 1.0 });
    refused(point().delassus(one_wrong).build(), "delassus[1, 2]");
    refused(point().free_velocity(dvector![0.0, f64::INFINITY, 0.0]).build(), "free_velocity[1]");
    refused(point().friction(vec![-0.5]).build(), "friction[0]");
    refused(point().rows_per_contact(1).friction(vec![0.0, 0.5, 0.0]).build(), "friction");
    refused(point().law(Law::PolyhedralCoulomb { directions: 2 }).build(), "directions");
    refused(point().compliance(diagonal(&[1.0])).build(), "compliance.diagonal");
    refused(point().compliance(diagonal(&[1.0, -1.0, 0.0])).build(), "compliance.diagonal[1]");
    refused(point().bodies(vec![[Some(1), Some(1)]]).build(), "bodies[0]");
    for bodies in [[Some(1), Some(1)], [None, None]] {
        refused(point().keys(vec![ContactKey { bodies, features: [0, 0] }]).build(), "keys[0]");
    }
    refused(point().dynamics(Dynamics { mass: dmatrix![1.0], jacobian: dmatrix![1.0] }).build(), "jacobian");
    refused(ContactProblem::from_dynamics(dmatrix![1.0], dmatrix![1.0; 0.0; 0.0], &dvector![1.0, 2.0]).build(), "free_motion");
    refused(ContactProblem::from_dynamics(dmatrix![-1.0], dmatrix![1.0; 0.0; 0.0], &dvector![1.0]).build(), "mass");
}
