//! Witnesses checked by other means, problems without one, and what is no witness.

use super::*;
use crate::certificate::planted::with;
use nalgebra::dvector;

/// A body between two walls, normals (0, ±1) with tangents along the walls, that close in at these speeds.
fn between(law: Law, dimension: usize, speeds: [f64; 2]) -> ContactProblem {
    let jacobian = DMatrix::from_fn(2 * dimension, dimension, |row, column| {
        let (wall, i) = (row / dimension, row % dimension);
        let sign = if wall == 1 && i == 0 { -1.0 } else { 1.0 };
        if i == column { sign } else { 0.0 }
    });
    let w = &jacobian * jacobian.transpose();
    let mut free = DVector::zeros(2 * dimension);
    (free[0], free[dimension]) = (-speeds[0], -speeds[1]);
    if dimension > 1 {
        (free[1], free[dimension + 1]) = (2.0, 2.0);
    }
    ContactProblem::new(w, free)
        .law(law)
        .rows_per_contact(dimension)
        .friction(vec![if dimension > 1 { 0.5 } else { 0.0 }; 2])
        .build()
        .unwrap()
}

#[test]
fn walls_that_close_in_have_a_witness_and_walls_that_do_not_have_none() {
    let round = [Law::Frictionless, Law::Coulomb, Law::Associated].map(|law| (law, 1..=3));
    let polyhedral = [Law::PolyhedralCoulomb { directions: 4 }, Law::PolyhedralAssociated { directions: 5 }].map(|law| (law, 3..=3));
    for (law, dimensions) in round.into_iter().chain(polyhedral) {
        for dimension in dimensions {
            let crushed = between(law, dimension, [1.0, 2.0_f64.powi(-40) - 1.0]);
            let found = infeasible(&crushed).unwrap_or_else(|| panic!("{law:?} {dimension}"));
            assert!(found.product < RBig::ZERO && check(&crushed, &found.witness) == Some(found.product.clone()));
            assert!(infeasible(&between(law, dimension, [1.0, -1.0])).is_none(), "{law:?} {dimension}: carried along");
        }
    }
}

/// Contacts that meet no other, normal rows alone, with these diagonal entries of W and free velocities.
fn lone(entries: &[[f64; 2]]) -> ContactProblem {
    let diagonal = DVector::from_iterator(entries.len(), entries.iter().map(|[w, _]| *w));
    let free = DVector::from_iterator(entries.len(), entries.iter().map(|[_, q]| *q));
    ContactProblem::new(DMatrix::from_diagonal(&diagonal), free).law(Law::Frictionless).rows_per_contact(1).build().unwrap()
}

#[test]
fn one_contact_that_nothing_moves_refutes_any_number_of_others() {
    let mut entries = vec![[1.0, -1.0]; 40];
    assert!(infeasible(&lone(&entries)).is_none());
    entries[17] = [0.0, 2.0_f64.powi(-60)];
    assert!(infeasible(&lone(&entries)).is_none(), "it opens");
    entries[17] = [0.0, -(2.0_f64.powi(-60))];
    let found = infeasible(&lone(&entries)).expect("contact 17 closes, and no impulse moves it");
    assert_eq!(found.witness.iter().enumerate().filter(|(_, p)| !p.is_zero()).map(|(k, _)| k).collect::<Vec<_>>(), [17]);
    let crushed = between(Law::Coulomb, 3, [1.0, 0.5]);
    // twenty such jaws, of which the last is carried along like the others, or closes
    let w = DMatrix::from_fn(120, 120, |i, j| if i / 6 == j / 6 { crushed.dense()[(i % 6, j % 6)] } else { 0.0 });
    let many = |last: f64| {
        let free = |i: usize, _| match (i, i % 6) {
            (117, _) => last,
            (_, 0) => -1.0,
            (_, 3) => 1.0,
            _ => 2.0,
        };
        ContactProblem::new(w.clone(), DVector::from_fn(120, free)).friction(vec![0.5; 40]).build().unwrap()
    };
    assert!(infeasible(&many(1.0)).is_none() && infeasible(&many(1.0 - 2.0_f64.powi(-50))).is_some());
}

#[test]
fn a_witness_that_is_none_is_not_believed() {
    let crushed = between(Law::Coulomb, 2, [1.0, 0.5]);
    let right = infeasible(&crushed).unwrap().witness;
    let mut pulled = right.clone();
    pulled[0] = -RBig::ONE;
    let mut lopsided = right.clone();
    lopsided[0] += ratio(1, 1 << 50);
    let mut rubbed = right.clone();
    rubbed[1] = ratio(1, 1 << 50);
    for wrong in [pulled, lopsided, rubbed, DVector::from_element(4, RBig::ZERO), DVector::from_element(3, RBig::ONE)] {
        assert_eq!(check(&crushed, &wrong), None, "{wrong:?}");
    }
    assert!(check(&crushed, &(right * ratio(1, 3))).is_some(), "its length does not matter");
}

#[test]
fn painleve_s_block_is_feasible_and_has_no_witness() {
    let w = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 5.0]);
    let problem = ContactProblem::new(w, dvector![-1.0, 1.0]).rows_per_contact(2).friction(vec![1.0]).build().unwrap();
    assert!(infeasible(&problem).is_none());
}

/// Bodies of these masses in a row between two walls that come nearer: neighbours touch, every contact closes at 1 m/s but the last one.
fn row(masses: &[f64], last: f64, law: Law, dimension: usize) -> ContactProblem {
    let (bodies, contacts) = (masses.len(), masses.len() + 1);
    let jacobian = DMatrix::from_fn(contacts * dimension, bodies * dimension, |row, column| {
        let (k, body, same) = (row / dimension, column / dimension, row % dimension == column % dimension);
        let sign = if k == body { 1.0 } else { -1.0 };
        if same && (k == body || k == body + 1) { sign } else { 0.0 }
    });
    let mass = DMatrix::from_fn(bodies * dimension, bodies * dimension, |i, j| if i == j { masses[i / dimension] } else { 0.0 });
    let shift = DVector::from_fn(contacts * dimension, |row, _| match (row / dimension, row % dimension) {
        (k, 0) if k + 1 == contacts => last,
        (_, 0) => -1.0,
        // under the associated law slip opens
        _ => {
            if law == Law::Associated {
                0.0
            } else {
                0.25
            }
        }
    });
    let free = DVector::zeros(bodies * dimension);
    let problem = ContactProblem::from_dynamics(mass, jacobian, &free).law(law).rows_per_contact(dimension).shift(shift);
    problem.friction(vec![if dimension > 1 { 0.5 } else { 0.0 }; contacts]).build().unwrap()
}

#[test]
fn a_row_of_many_bodies_that_is_crushed_has_a_witness_and_one_that_is_carried_along_has_none() {
    for (law, dimension) in [(Law::Frictionless, 1), (Law::Coulomb, 3), (Law::Associated, 2)] {
        for bodies in [15, 40] {
            let masses: Vec<f64> = (0..bodies).map(|i| [1.0, 2.0, 0.25][i % 3]).collect();
            let parts = |last: f64| {
                let known = row(&masses, last, law, dimension);
                // W alone, of binary numbers: nothing is known of M̂ and H
                let w = ContactProblem::new(known.dense().clone(), known.free_velocity().clone()).law(law).rows_per_contact(dimension);
                w.shift(known.shift().clone()).friction(known.friction().to_vec()).build().unwrap()
            };
            let crushed = parts(bodies as f64 - 2.0_f64.powi(-20));
            let found = infeasible(&crushed).unwrap_or_else(|| panic!("{law:?} {bodies}"));
            assert!(found.product < RBig::ZERO && !found.of_mechanism && check(&crushed, &found.witness) == Some(found.product));
            for row in 0..crushed.rows() {
                let moved = (0..crushed.rows()).fold(RBig::ZERO, |sum, j| sum + exact(crushed.entry(j, row)) * &found.witness[j]);
                assert!(moved.is_zero(), "it moves nothing");
            }
            assert!(found.relative > 0.0 && found.relative < 1e-6, "how little it is is told: {}", found.relative);
            assert!(infeasible(&parts(bodies as f64)).is_none() && infeasible(&parts(bodies as f64 + 1.0)).is_none());
        }
    }
}

#[test]
fn masses_whose_w_is_rounded_are_refuted_by_their_rows() {
    let masses: Vec<f64> = (0..20).map(|i| 0.3 + 0.7 * f64::from(i % 7)).collect();
    for dimension in [1, 3] {
        let crushed = row(&masses, 19.5, Law::Coulomb, dimension);
        let found = infeasible(&crushed).expect("crushed");
        assert!(found.of_mechanism && found.relative > 1e-3, "{found:?}");
        assert_eq!(check(&crushed, &found.witness), None, "the stored W moves: it is rounded");
        assert!(infeasible(&row(&masses, 20.0, Law::Coulomb, dimension)).is_none());
    }
}

#[test]
fn a_witness_that_moves_a_joint_is_not_believed() {
    // a wall, and a rod from the other side, both along the normal: p = (1, 1) moves nothing
    let w = DMatrix::from_row_slice(2, 2, &[1.0, -1.0, -1.0, 1.0]);
    let problem = ContactProblem::new(w, dvector![-1.0, 0.0]).law(Law::Frictionless).rows_per_contact(1).build().unwrap();
    let joined = [false, true];
    let sought = Sought { problem: &problem, joined: &joined, made: None };
    let both = DVector::from_element(2, RBig::ONE);
    assert_eq!(sought.check(&both), Some(-RBig::ONE), "the rod holds the body where it is, and it goes on into the wall");
    let other = DVector::from_vec(vec![RBig::ONE, ratio(3, 2)]);
    assert_eq!(sought.check(&other), None);
    let believed = |joined: [bool; 2], p: [i64; 2]| {
        let problem = ContactProblem::new(DMatrix::from_row_slice(2, 2, &[0.0, -1.0, -1.0, 1.0]), dvector![-1.0, 0.0]);
        let problem = problem.law(Law::Frictionless).rows_per_contact(1).build().unwrap();
        Sought { problem: &problem, joined: &joined, made: None }.check(&DVector::from_vec(p.map(|x| ratio(x, 1)).to_vec())).is_some()
    };
    // the rod is pushed by the wall's impulse and gives way: only a limit would not
    assert!(!believed([false, true], [1, 0]) && believed([false, false], [1, 0]));
    assert!(with(Some(Plant::Held), || believed([false, true], [1, 0])), "this is what the mistake would believe");
}

#[test]
fn soft_contacts_have_a_witness_only_where_hard_ones_are_crushed() {
    let between = |diagonal: DVector<f64>| {
        let w = DMatrix::from_row_slice(2, 2, &[1.0, -1.0, -1.0, 1.0]);
        let compliance = crate::problem::Compliance { coordinates: Coordinates::Contact, diagonal };
        let problem = ContactProblem::new(w, dvector![-1.0, -0.5]).law(Law::Frictionless).rows_per_contact(1);
        infeasible(&problem.compliance(compliance).build().unwrap())
    };
    assert!(between(dvector![0.0, 0.0]).is_some());
    assert!(between(dvector![0.5, 0.0]).is_none() && between(dvector![0.5, 0.5]).is_none(), "the soft wall gives way");
}
