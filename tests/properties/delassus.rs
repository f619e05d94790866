//! Property family `delassus`: random mechanisms with 1–12 velocities, 1–8 contacts and mass ratios to 10⁶.

use crate::cases;
use moreau::checks::Finding;
use moreau::checks::delassus::{Library, check, smallest_rayleigh_quotient};
use moreau::contact::delassus::{MassFactor, delassus};
use moreau::mechanics::planar::{PlanarBody, Shape};
use moreau::mechanics::{Mechanism, PlanarBodies, Plane};
use moreau::scalar::{Rational, ratio};
use moreau::tolerance::checks::delassus::column;
use nalgebra::{DMatrix, DVector, dvector};
use proptest::prelude::*;

/// M = L D Lᵀ with L in half-integers and D in powers of two up to ratio 2²⁰, both exact in `f64`.
fn masses(size: usize) -> impl Strategy<Value = DMatrix<Rational>> {
    let lower = prop::collection::vec(-2i64..=2, size * size);
    let exponents = prop::collection::vec(-10i32..=10, size);
    (lower, exponents).prop_map(move |(lower, exponents)| {
        let l = DMatrix::from_fn(size, size, |i, j| match i.cmp(&j) {
            std::cmp::Ordering::Greater => ratio(lower[i * size + j], 2),
            std::cmp::Ordering::Equal => ratio(1, 1),
            std::cmp::Ordering::Less => ratio(0, 1),
        });
        let power = |e: i32| if e < 0 { ratio(1, 1 << -e) } else { ratio(1 << e, 1) };
        let d = DMatrix::from_fn(size, size, |i, j| if i == j { power(exponents[i]) } else { ratio(0, 1) });
        &l * d * l.transpose()
    })
}

/// H in small integers; a third of the rows repeat or add up earlier ones, so redundant contacts are frequent.
fn jacobians(rows: usize, size: usize) -> impl Strategy<Value = DMatrix<Rational>> {
    let entries = prop::collection::vec(prop_oneof![2 => Just(0i64), 3 => -3i64..=3], rows * size);
    let copies = prop::collection::vec((0..3u8, any::<prop::sample::Index>(), any::<prop::sample::Index>()), rows);
    (entries, copies).prop_map(move |(entries, copies)| {
        let mut h = DMatrix::from_row_slice(rows, size, &entries.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>());
        for (row, (kind, first, second)) in copies.into_iter().enumerate().skip(1) {
            if kind == 0 {
                let sum = h.row(first.index(row)) + h.row(second.index(row));
                h.set_row(row, &sum);
            }
        }
        h
    })
}

fn systems() -> impl Strategy<Value = (DMatrix<Rational>, DMatrix<Rational>)> {
    let sizes = (1usize..=12, 1usize..=8, 1usize..=3);
    sizes.prop_flat_map(|(size, contacts, rows)| (masses(size), jacobians(contacts * rows, size)))
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn w_is_symmetric_semidefinite_and_definite_iff_the_rows_are_independent((mass, jacobian) in systems()) {
        let findings = check(&Library, &mass, &jacobian).unwrap();
        let failed: Vec<String> = findings.iter().filter(|finding| !finding.holds()).map(Finding::to_string).collect();
        prop_assert!(failed.is_empty(), "{failed:?}\nM = {mass}\nH = {jacobian}");
    }

    #[test]
    fn planar_bodies_answer_unit_impulses_with_the_columns_of_w((mechanism, position) in heaps()) {
        let contacts = mechanism.contacts(&position);
        let jacobian = DMatrix::from_fn(2 * contacts.len(), position.len(), |i, j| contacts[i / 2].jacobian[(i % 2, j)]);
        let mass = mechanism.mass_matrix(&position);
        let w = delassus(&mass, &jacobian).unwrap();
        prop_assert_eq!(&w, &w.transpose());
        let finding = smallest_rayleigh_quotient(&w, position.len());
        prop_assert!(finding.holds(), "{}", finding);
        let factor = MassFactor::new(&mass).unwrap();
        for j in 0..w.ncols() {
            let response = &jacobian * factor.solve(&jacobian.row(j).transpose());
            for i in 0..w.nrows() {
                let bound = column(position.len(), (w[(i, i)] * w[(j, j)]).sqrt());
                prop_assert!((response[i] - w[(i, j)]).abs() <= bound, "entry ({}, {}): {} and {}", i, j, response[i], w[(i, j)]);
            }
        }
    }
}

/// One to four disks and boxes of masses 10⁻³ to 10³ kg anywhere above, in or under a sloping ground line.
fn heaps() -> impl Strategy<Value = (PlanarBodies, DVector<f64>)> {
    let body = (any::<bool>(), 0.05f64..0.5, 0.05f64..0.5, -3.0f64..3.0, (-1.0f64..1.0, -0.5f64..2.0, -3.0f64..3.0));
    (prop::collection::vec(body, 1..=4), -1.0f64..1.0).prop_map(|(drawn, slope)| {
        let bodies = drawn.iter().enumerate().map(|(k, &(round, a, b, exponent, _))| {
            let shape = if round { Shape::Disk { radius: a } } else { Shape::Box { half_extents: [a, b] } };
            PlanarBody::solid(format!("body{k}"), shape, 10f64.powf(exponent)).unwrap()
        });
        let places = drawn.iter().flat_map(|&(.., (x, z, angle))| [x, z, angle]);
        let ground = Plane::new(dvector![slope.sin(), slope.cos()], 0.0, 0.5, 0.0).unwrap();
        let position = DVector::from_iterator(3 * drawn.len(), places);
        (PlanarBodies::new("heap", bodies.collect(), [0.0, -9.81], ground).unwrap(), position)
    })
}

#[test]
fn four_corners_of_a_box_on_the_floor_are_redundant() {
    let third = ratio(1, 3);
    let mass = DMatrix::from_fn(3, 3, |i, j| {
        if i != j {
            ratio(0, 1)
        } else if i == 2 {
            third.clone()
        } else {
            ratio(1, 1)
        }
    });
    let rows = [[0, 1, -1], [1, 0, 1], [0, 1, 1], [1, 0, 1]].concat();
    let jacobian = DMatrix::from_row_slice(4, 3, &rows.into_iter().map(|x| ratio(x, 1)).collect::<Vec<_>>());
    for finding in check(&Library, &mass, &jacobian).unwrap() {
        assert!(finding.holds(), "{finding}");
    }
}
