//! Pairs with cylinders and capsules at random: distances and overlaps found by others, gap rates, exchange, number of candidates.

use super::cylinder_tests::{BEAM, FLAT, PILL, Place, ROD, SLAB, SMALL, pose, touches, worlds};
use super::tests::Numbers;
use super::*;
use crate::tolerance::mechanics::{DIFFERENCE_STEP, FACING, SAME_POINT, central_difference};
use moreau_exact::tolerance::rounding;
use std::f64::consts::FRAC_PI_2;

/// The pairs that are met at random.
const PAIRS: [[Shape; 2]; 8] =
    [[ROD, SLAB], [ROD, SMALL], [SMALL, FLAT], [SMALL, BEAM], [PILL, ROD], [PILL, FLAT], [PILL, SLAB], [PILL, BEAM]];

fn anywhere(numbers: &mut Numbers, distance: f64) -> Place {
    let mut vector = |size: f64| std::array::from_fn(|_| numbers.next() * size);
    (vector(distance), vector(3.0))
}

fn library(shape: Shape, (place, turn): Place) -> (Box<dyn parry3d_f64::shape::Shape>, parry3d_f64::math::Pose) {
    use parry3d_f64::math::{Pose as Isometry, Rotation, Vector};
    use parry3d_f64::shape::{Capsule, Cuboid, Cylinder};
    let turn = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
    // the library's cylinders are along y, and so is this capsule
    let upright = UnitQuaternion::from_scaled_axis(Vector3::x() * FRAC_PI_2);
    let (shape, turn): (Box<dyn parry3d_f64::shape::Shape>, _) = match shape {
        Shape::Cylinder { radius, half_height } => (Box::new(Cylinder::new(half_height, radius)), turn * upright),
        Shape::Capsule { radius, half_height } => (Box::new(Capsule::new_y(half_height, radius)), turn * upright),
        Shape::Box { half_extents: [a, b, c] } => (Box::new(Cuboid::new(Vector::new(a, b, c))), turn),
        other => panic!("{other:?}"),
    };
    let rotation = Rotation::from_xyzw(turn.i, turn.j, turn.k, turn.w).normalize();
    (shape, Isometry::from_parts(Vector::new(place[0], place[1], place[2]), rotation))
}

/// max n·y over the body about its centre, from the points of a rim or of an end, and from the corners.
fn reaches(shape: Shape, rotation: &Matrix3<f64>, normal: &Vector3<f64>) -> f64 {
    let own = rotation.tr_mul(normal);
    match shape {
        Shape::Cylinder { radius, half_height } => radius * own.x.hypot(own.y) + half_height * own.z.abs(),
        Shape::Capsule { radius, half_height } => radius + half_height * own.z.abs(),
        Shape::Box { half_extents: [a, b, c] } => a * own.x.abs() + b * own.y.abs() + c * own.z.abs(),
        other => panic!("{other:?}"),
    }
}

/// The largest s(n), looked for by trying ever smaller changes of the best of many directions.
fn least_overlap(shapes: [Shape; 2], places: [Place; 2], numbers: &mut Numbers) -> f64 {
    let poses = places.map(|place| pose(place, &worlds()[0]));
    let apart = poses[0].centre - poses[1].centre;
    let separation = |n: &Vector3<f64>| {
        let n = n.normalize();
        n.dot(&apart).abs() - (0..2).map(|body| reaches(shapes[body], &poses[body].rotation, &n)).sum::<f64>()
    };
    let mut vector = |size: f64| Vector3::from_fn(|_, _| numbers.next() * size);
    let mut starts: Vec<Vector3<f64>> = (0..400).map(|_| vector(1.0)).collect();
    starts.sort_by(|one, other| separation(other).total_cmp(&separation(one)));
    let climb = |start: &Vector3<f64>, vector: &mut dyn FnMut(f64) -> Vector3<f64>| {
        let (mut best, mut size) = (start.normalize(), 0.2);
        while size > SAME_POINT {
            let better = (0..24).map(|_| (best + vector(size)).normalize()).find(|n| separation(n) > separation(&best));
            match better {
                Some(n) => best = n,
                None => size *= 0.5,
            }
        }
        separation(&best)
    };
    starts[..6].iter().map(|start| climb(start, &mut vector)).fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn the_nearest_candidate_is_the_distance_of_bodies_apart_and_the_least_overlap_of_others() {
    let mut numbers = Numbers(22);
    let (mut apart, mut together) = (0, 0);
    for shapes in PAIRS {
        for _ in 0..80 {
            let places = [anywhere(&mut numbers, 0.6), anywhere(&mut numbers, 0.2)];
            let found = touches(shapes, places, &worlds()[0]);
            let nearest = found.iter().map(|touch| touch.gap).fold(f64::INFINITY, f64::min);
            let [one, other] = [0, 1].map(|body| library(shapes[body], places[body]));
            let distance = parry3d_f64::query::distance(&one.1, one.0.as_ref(), &other.1, other.0.as_ref()).expect("supported").distance;
            let told = format!("{shapes:?} at {places:?}");
            // the library's iteration ends at about √ε of the size
            let slack = f64::EPSILON.sqrt();
            if distance > slack {
                assert!(nearest >= distance * (1.0 - BESIDE) - slack, "{nearest} at distance {distance}: {told}");
                assert!(nearest <= distance * (1.0 + BESIDE) + slack, "{nearest} at distance {distance}: {told}");
                apart += 1;
            } else {
                let overlap = least_overlap(shapes, places, &mut numbers);
                let climbed = 64.0 * SAME_POINT;
                assert!(nearest <= overlap * (1.0 - BESIDE) + climbed, "{nearest} although they overlap by {overlap}: {told}");
                assert!(nearest >= overlap / FACING - climbed, "{nearest} although they overlap by {overlap} only: {told}");
                together += 1;
            }
        }
    }
    assert!(apart > 80 && together > 80, "{apart} apart, {together} together");
}

fn bodies(shapes: [Shape; 2]) -> SpatialBodies {
    let [first, second] = [("a", shapes[0]), ("b", shapes[1])].map(|(name, shape)| SpatialBody::solid(name, shape, 2.0).expect("valid"));
    SpatialBodies::without_ground("pair", vec![first, second], [0.0; 3], Materials::new(0.5, 0.0).expect("valid")).expect("valid")
}

/// How many candidates keep their features, and how many have another rate than their rows say; `seen` chooses the points of the rows.
fn wrong_rates(shapes: [Shape; 2], seen: impl Fn(&Touch) -> [Vector3<f64>; 2]) -> [usize; 2] {
    let (mechanism, mut numbers, h) = (bodies(shapes), Numbers(23), DIFFERENCE_STEP);
    let (mut compared, mut wrong) = (0, 0);
    for _ in 0..300 {
        let places = [anywhere(&mut numbers, 0.6), anywhere(&mut numbers, 0.2)];
        let part = |(place, turn): Place| {
            let turn = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
            [place[0], place[1], place[2], turn.w, turn.i, turn.j, turn.k]
        };
        let q = DVector::from_iterator(14, places.into_iter().flat_map(part));
        let v = DVector::from_fn(12, |_, _| numbers.next());
        let [now, after, before] = [0.0, h, -h].map(|h| mechanism.candidates(&mechanism.integrate(&q, &v, h), f64::INFINITY, &seen));
        for contact in now {
            let place = contact.place.expect("bodies have places");
            let same = |list: &[Contact]| {
                let found = list.iter().find(|other| other.place.is_some_and(|other| other.is_same(&place)));
                found.map(|found| (found.gap, (&found.jacobian * &v)[0]))
            };
            let (Some(after), Some(before)) = (same(&after), same(&before)) else { continue };
            // a gap has a kink where a nearest feature changes, and bends sharply where edges cross at a small angle
            let bend = (after.1 - before.1).abs();
            if bend > 1024.0 * h {
                continue;
            }
            let measured = (after.0 - before.0) / (2.0 * h);
            compared += 1;
            wrong += usize::from((measured - (&contact.jacobian * &v)[0]).abs() > bend + central_difference(v.norm(), 2.0));
        }
    }
    [compared, wrong]
}

#[test]
fn gaps_change_as_the_rows_say_and_not_as_rows_at_other_points_say() {
    for shapes in [PAIRS[0], PAIRS[1], PAIRS[2], [PILL, ROD], [SLAB, ROD], [ROD, PILL], [PILL, SLAB], [BEAM, PILL]] {
        let [compared, wrong] = wrong_rates(shapes, |touch| touch.seen);
        assert!(compared > 300 && wrong == 0, "{shapes:?}: {wrong} of {compared}");
        let aside = |touch: &Touch| touch.points.map(|point| point + Vector3::new(0.01, 0.02, 0.03));
        let [compared, wrong] = wrong_rates(shapes, aside);
        assert!(2 * wrong > compared, "{shapes:?}: {wrong} of {compared}");
    }
}

#[test]
fn exchanging_two_cylinders_turns_the_normals_round() {
    let mut numbers = Numbers(25);
    for _ in 0..200 {
        let places = [anywhere(&mut numbers, 0.6), anywhere(&mut numbers, 0.2)];
        let nearest = |shapes: [Shape; 2], places: [Place; 2]| {
            let found = touches(shapes, places, &worlds()[0]);
            found.into_iter().min_by(|one, other| one.gap.total_cmp(&other.gap)).expect("a candidate")
        };
        let (one, other) = (nearest([ROD, SMALL], places), nearest([SMALL, ROD], [places[1], places[0]]));
        let bound = rounding(1024, 2.0) / crate::tolerance::mechanics::PARALLEL;
        assert!((one.gap - other.gap).abs() <= bound && (one.normal + other.normal).norm() <= bound.sqrt(), "{one:?} against {other:?}");
    }
}

#[test]
fn there_are_never_more_candidates_than_room_is_made_for() {
    let mut numbers = Numbers(26);
    for shapes in PAIRS.into_iter().chain([[PILL, PILL]]) {
        let most = bodies(shapes).most_candidates().expect("known");
        for _ in 0..200 {
            let found = touches(shapes, [anywhere(&mut numbers, 0.6), anywhere(&mut numbers, 0.2)], &worlds()[0]);
            assert!(found.len() <= most && !found.is_empty(), "{} of {most}: {shapes:?}", found.len());
        }
    }
}
