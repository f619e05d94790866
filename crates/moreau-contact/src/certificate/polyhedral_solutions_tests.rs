//! The velocities under polyhedral friction against closed forms, and against all patterns in the plane.

use super::*;
use crate::certificate::draw::Draw;
use crate::certificate::lcp::residuals;
use crate::certificate::patterns::{Solutions, solutions};
use crate::certificate::planted::with;
use crate::problem::{Compliance, Coordinates};
use moreau_exact::scalar::{Scalar, ratio};
use nalgebra::dvector;

const PLANE: Law = Law::PolyhedralCoulomb { directions: 2 };

fn polyhedral(w: DMatrix<f64>, free: &[f64], mu: f64, rows: usize, law: Law) -> ContactProblem {
    let problem = ContactProblem::new(w, DVector::from_row_slice(free)).rows_per_contact(rows).law(law);
    problem.friction(vec![mu; free.len() / rows]).build().unwrap()
}

fn rounded(of: &DVector<Rational>) -> Vec<f64> {
    of.iter().map(Scalar::to_f64).collect()
}

#[test]
fn one_contact_on_the_identity_has_one_solution_whether_it_flies_slides_or_sticks() {
    for directions in [3, 4, 8] {
        for (free, velocity) in [
            ([1.0, 2.0, 0.5], [1.0, 2.0, 0.5]),
            ([-1.0, 2.0, 0.0], [0.0, 1.5, 0.0]),
            ([-1.0, 0.0, 0.0], [0.0; 3]),
            ([-1.0, 0.125, 0.0625], [0.0; 3]),
            ([0.0, 1.0, 0.0], [0.0, 1.0, 0.0]),
        ] {
            let problem = polyhedral(DMatrix::identity(3, 3), &free, 0.5, 3, Law::PolyhedralCoulomb { directions });
            let all = polyhedral_solutions(&problem).unwrap();
            let what = format!("{directions} {free:?}: {all:?}");
            assert!(all.found.len() == 1 && all.same_impulse && all.continuum.is_none() && all.stopped.is_none(), "{what}");
            // three directions have none opposite to 0°: the nearest two, at ±120°, share the friction and slow it down by half as much
            let slides_between = directions == 3 && free == [-1.0, 2.0, 0.0];
            let velocity = if slides_between { [0.0, 1.75, 0.0] } else { velocity };
            let found = rounded(&all.found[0].velocity);
            assert!(found.iter().zip(velocity).all(|(u, known)| (u - known).abs() < 1e-12), "{what}");
        }
    }
}

#[test]
fn without_mobility_the_velocity_is_the_free_one_or_there_is_no_solution() {
    let of = |free: [f64; 3]| {
        let law = Law::PolyhedralCoulomb { directions: 4 };
        polyhedral_solutions(&polyhedral(DMatrix::zeros(3, 3), &free, 0.5, 3, law)).unwrap()
    };
    let flies = of([1.0, 2.0, 0.0]);
    assert!(flies.found.len() == 1 && flies.same_impulse && flies.continuum.is_none(), "{flies:?}");
    // it slides: pressed as hard as one likes
    let slides = of([0.0, 2.0, 0.0]);
    assert!(slides.found.len() == 1 && !slides.same_impulse && slides.continuum.is_none() && slides.stopped.is_none(), "{slides:?}");
    assert!(of([-1.0, 2.0, 0.0]).found.is_empty());
}

/// What can be compared: the velocities in some order, or that they are a continuum.
fn velocities(found: &[Exact], continuum: bool) -> Option<Vec<Vec<Rational>>> {
    let mut velocities: Vec<Vec<Rational>> = found.iter().map(|one| one.velocity.as_slice().to_vec()).collect();
    velocities.sort();
    (!continuum).then_some(velocities)
}

fn same(planar: &Solutions, all: &PolyhedralSolutions) -> bool {
    velocities(&planar.found, planar.continuum.is_some()) == velocities(&all.found, all.continuum.is_some())
}

/// A problem in the plane with small numbers, often singular, asymmetric or of Painlevé's kind.
fn drawn(draw: &mut Draw) -> ContactProblem {
    let n = if draw.whole(1) == 0 { 2 } else { 4 };
    let kind = draw.whole(2);
    let mut whole = |most: i64| draw.whole(most) as f64;
    let w = match kind {
        // any matrix, and a symmetric one
        -2 => DMatrix::from_fn(n, n, |_, _| whole(2)),
        -1 => {
            let half = DMatrix::from_fn(n, n, |_, _| whole(1));
            &half + half.transpose()
        }
        // rods that a normal impulse pushes along
        0 => {
            let mut w = DMatrix::from_fn(n, n, |i, j| if i / 2 == j / 2 { [[1.0, 2.0], [2.0, 5.0]][i % 2][j % 2] } else { 0.0 });
            if n > 2 {
                (w[(0, 2)], w[(2, 0)]) = (whole(1) / 16.0, whole(1) / 16.0);
            }
            w
        }
        // fewer dimensions than rows
        _ => {
            let h = DMatrix::from_fn(n, n - 1, |_, _| whole(1));
            &h * h.transpose()
        }
    };
    let free: Vec<f64> = (0..n).map(|_| whole(2)).collect();
    polyhedral(w, &free, [0.5, 1.0, 2.0][(whole(1) + 1.0) as usize], 2, PLANE)
}

#[test]
fn in_the_plane_there_are_as_many_velocities_as_all_patterns_find() {
    let (mut draw, mut counts, mut caught) = (Draw(7), [0; 5], 0);
    for number in 0..400 {
        let problem = drawn(&mut draw);
        let all = polyhedral_solutions(&problem).unwrap();
        let planar = solutions(&problem.clone().into_builder().law(Law::Coulomb).build().unwrap()).unwrap();
        assert!(same(&planar, &all) && all.stopped.is_none(), "{number}: {problem:?}\n{planar:?}\n{all:?}");
        let one_impulse = all.found.iter().all(|one| one.impulse == all.found[0].impulse);
        assert!(!all.same_impulse || (one_impulse && all.found.len() < 2), "{number}");
        counts[if all.continuum.is_some() { 4 } else { all.found.len().min(3) }] += 1;
        // planted: what shares a cone is taken for one velocity
        let still = with(Some(Plant::Still), || polyhedral_solutions(&problem).unwrap());
        caught += usize::from(!same(&planar, &still));
        assert_eq!(still.continuum, None);
    }
    assert!(counts.iter().all(|count| *count > 5), "none, one, two, more, a continuum: {counts:?}");
    assert!(caught > 5 && caught == counts[4], "{caught} of {counts:?}");
}

#[test]
fn every_mean_of_the_two_ends_is_a_solution() {
    let (mut draw, mut seen) = (Draw(3), 0);
    for _ in 0..200 {
        let problem = drawn(&mut draw);
        let Some([one, other]) = polyhedral_solutions(&problem).unwrap().continuum else { continue };
        assert_ne!(one.velocity, other.velocity);
        let data = Data::new(&problem, problem.dense().map(exact), 2);
        let planar = |r: &DVector<Rational>| {
            let contacts = problem.contacts();
            let y = &data.free + problem.dense().map(exact) * r;
            // (λ, β, σ) of r in the plane
            let part = |x: &Rational| if *x > Rational::ZERO { x.clone() } else { Rational::ZERO };
            let normal = (0..contacts).map(|k| r[2 * k].clone());
            let sides = (0..contacts).flat_map(|k| [part(&r[2 * k + 1]), part(&-r[2 * k + 1].clone())]);
            let slip = (0..contacts).map(|k| y[2 * k + 1].clone().magnitude());
            DVector::from_iterator(4 * contacts, normal.chain(sides).chain(slip))
        };
        for part in [ratio(0, 1), ratio(1, 3), ratio(1, 1)] {
            let mean = &one.impulse * (Rational::ONE - &part) + &other.impulse * part;
            assert!(residuals(&data.lcp, &planar(&mean)).vanish(), "{problem:?} {one:?} {other:?}");
        }
        seen += 1;
    }
    assert!(seen > 10, "{seen}");
}

#[test]
fn painleve_s_rod_in_space_is_told_as_in_the_plane_and_its_shift_and_compliance_count() {
    let w = |entry: f64| DMatrix::from_row_slice(3, 3, &[1.0, 2.0, 0.0, 2.0, 5.0, 0.0, 0.0, 0.0, entry]);
    for directions in [4, 8] {
        let law = Law::PolyhedralCoulomb { directions };
        for (free, count) in [([-1.0, 1.0, 0.0], 1), ([1.0, 4.0, 0.0], 3), ([1.0, 1.0, 0.0], 1)] {
            let all = polyhedral_solutions(&polyhedral(w(1.0), &free, 1.0, 3, law)).unwrap();
            assert!(all.found.len() == count && all.continuum.is_none() && all.stopped.is_none(), "{directions} {free:?}: {all:?}");
        }
    }
    let shifted = polyhedral(w(1.0), &[2.0, 4.0, 0.0], 1.0, 3, Law::PolyhedralCoulomb { directions: 4 });
    let count = |problem: ContactProblem| polyhedral_solutions(&problem).unwrap().found.len();
    assert_eq!(count(shifted.clone()), 1, "it flies off too fast to be jammed");
    let back = shifted.clone().into_builder().shift(dvector![-1.0, 0.0, 0.0]).build().unwrap();
    assert_eq!(count(back.clone()), 3);
    let diagonal = dvector![4.0, 0.0, 0.0];
    let soft = back.into_builder().compliance(Compliance { coordinates: Coordinates::Contact, diagonal }).build().unwrap();
    assert_eq!(count(soft), 1, "a soft contact does not jam");
}

#[test]
fn two_hexagons_that_stick_and_two_octagons_that_slide_are_decided_and_twenty_one_unknowns_and_other_laws_are_refused() {
    for (directions, slip) in [(6, 0.125), (8, 2.0)] {
        let law = Law::PolyhedralCoulomb { directions };
        let free = [-1.0, slip, 0.0625, -1.0, 0.0, slip];
        let mut w = DMatrix::identity(6, 6);
        (w[(0, 3)], w[(3, 0)]) = (0.25, 0.25);
        let all = polyhedral_solutions(&polyhedral(w, &free, 0.5, 3, law)).unwrap();
        assert!(
            all.unknowns == 4 + 2 * directions && all.found.len() == 1 && all.continuum.is_none() && all.stopped.is_none(),
            "{slip}: {all:?}"
        );
        assert!(all.sets < 8_000, "{}", all.sets);
    }
    let large = polyhedral(DMatrix::identity(3, 3), &[-1.0; 3], 0.5, 3, Law::PolyhedralCoulomb { directions: 19 });
    assert!(polyhedral_solutions(&large).unwrap_err().to_string().contains("21 unknowns"));
    let cone = polyhedral(DMatrix::identity(3, 3), &[-1.0; 3], 0.5, 3, Law::Coulomb);
    assert!(polyhedral_solutions(&cone).is_err());
    let none = polyhedral(DMatrix::zeros(0, 0), &[], 0.5, 3, Law::PolyhedralCoulomb { directions: 4 });
    assert_eq!(polyhedral_solutions(&none).unwrap().found.len(), 1, "nothing touches, in one way");
}
