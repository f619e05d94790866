//! Cylinders at boxes, cylinders and capsules: gaps, points and normals where they are known in closed form, on both sides of every
//! boundary and turned in every way; distances and overlaps found by others; gap rates; faces; exchange.

use super::tests::Numbers;
use super::*;
use crate::tolerance::mechanics::{DIFFERENCE_STEP, FACING, SAME_POINT, central_difference};
use moreau_exact::tolerance::rounding;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4};

/// Place and rotation vector of a body.
type Place = ([f64; 3], [f64; 3]);

/// A rod of radius 0.3 m and half height 0.5 m.
const ROD: Shape = Shape::Cylinder { radius: 0.3, half_height: 0.5 };
const SMALL: Shape = Shape::Cylinder { radius: 0.2, half_height: 0.4 };
/// Wide and low.
const FLAT: Shape = Shape::Cylinder { radius: 0.6, half_height: 0.1 };
const PILL: Shape = Shape::Capsule { radius: 0.2, half_height: 0.4 };
/// Its upper face is at z = 0.2 m.
const SLAB: Shape = Shape::Box { half_extents: [0.4, 0.6, 0.2] };
/// An edge along x is uppermost when it is turned about x by π/4, at √2 times 0.2 m.
const BEAM: Shape = Shape::Box { half_extents: [0.4, 0.2, 0.2] };
const RIDGE: f64 = 0.2 * std::f64::consts::SQRT_2;
const UPRIGHT: [f64; 3] = [0.0; 3];
const ALONG_X: [f64; 3] = [0.0, FRAC_PI_2, 0.0];
const ALONG_Y: [f64; 3] = [FRAC_PI_2, 0.0, 0.0];
/// Gaps on both sides of touching \[m\].
const SIDES: [f64; 2] = [-1.0 / 1024.0, 1.0 / 1024.0];

fn pose((place, turn): Place, world: &Pose) -> Pose {
    let quaternion = world.quaternion * UnitQuaternion::from_scaled_axis(Vector3::from(turn));
    Pose { centre: world.world(place.into()), quaternion, rotation: *quaternion.to_rotation_matrix().matrix() }
}

/// Where nothing is turned, and five other ways to look at it.
fn worlds() -> Vec<Pose> {
    let mut numbers = Numbers(21);
    let mut vector = |size: f64| Vector3::from_fn(|_, _| numbers.next() * size);
    let other: Vec<_> = (0..5).map(|_| (vector(1.0), UnitQuaternion::from_scaled_axis(vector(3.0)))).collect();
    let all = std::iter::once((Vector3::zeros(), UnitQuaternion::identity())).chain(other);
    all.map(|(centre, quaternion)| Pose { centre, quaternion, rotation: *quaternion.to_rotation_matrix().matrix() }).collect()
}

fn touches([own, other]: [Shape; 2], [first, second]: [Place; 2], world: &Pose) -> Vec<Touch> {
    let mut found = Touches::default();
    pair_touches(&own, &pose(first, world), &other, &pose(second, world), &mut found);
    found.list
}

/// The candidates whose gap is this one; none is less.
fn with_gap(found: Vec<Touch>, gap: f64) -> Vec<Touch> {
    let slack = rounding(256, 4.0);
    assert!(found.iter().all(|touch| touch.gap >= gap - slack), "{gap}: {found:?}");
    found.into_iter().filter(|touch| touch.gap <= gap + slack).collect()
}

/// What the first body touches the second with when it comes down on it along z, its place for no gap given: the points of the second body
/// in x and y, on both sides of touching, in every view.
fn lands(shapes: [Shape; 2], [first, second]: [Place; 2], expected: &[[f64; 2]]) {
    for gap in SIDES {
        for world in worlds() {
            let ([x, y, z], turn) = first;
            let found = with_gap(touches(shapes, [([x, y, z + gap], turn), second], &world), gap);
            let places: Vec<Vector3<f64>> = found.iter().map(|touch| world.body(touch.points[1])).collect();
            let near = |[x, y]: &[f64; 2], place: &Vector3<f64>| (place.x - x).hypot(place.y - y) <= 0.5 * SAME_POINT;
            let all = expected.iter().all(|one| places.iter().any(|place| near(one, place)));
            assert!(all && places.len() == expected.len(), "{shapes:?} at {first:?}, gap {gap}: {places:?} instead of {expected:?}");
            let normal = world.rotation.column(2);
            assert!(found.iter().all(|touch| (touch.normal - normal).norm() <= rounding(1024, 1.0)), "{found:?}");
            let between = |touch: &Touch| (touch.points[0] - touch.points[1] - touch.normal * touch.gap).norm();
            assert!(found.iter().all(|touch| between(touch) <= rounding(1024, 4.0)), "{found:?}");
        }
    }
}

#[test]
fn a_cylinder_that_stands_on_a_box_touches_with_what_is_common_to_both_faces() {
    let on = |[x, y]: [f64; 2], expected: &[[f64; 2]]| lands([ROD, SLAB], [([x, y, 0.7], UPRIGHT), ([0.0; 3], UPRIGHT)], expected);
    on([0.05, 0.1], &[[0.35, 0.1], [0.05, 0.4], [-0.25, 0.1], [0.05, -0.2]]);
    // beyond the edge x = 0.4: its crossings with the rim, what is left of the four points, and the point farthest from the edge
    let half = 0.08f64.sqrt();
    on([0.3, 0.0], &[[0.4, half], [0.4, -half], [0.3, 0.3], [0.3, -0.3], [0.0, 0.0]]);
    // beyond a corner, which is on the face
    let half = 0.0875f64.sqrt();
    on([0.35, 0.55], &[[0.4, 0.6], [0.4, 0.55 - half], [0.35 - half, 0.6], [0.05, 0.55], [0.35, 0.25]]);
    // a box smaller than the face touches with its corners, and one a little larger with the edges beyond the rim
    let small = |a: f64| Shape::Box { half_extents: [a, a, 0.2] };
    let corners = |a: f64| [[a, a], [a, -a], [-a, a], [-a, -a]];
    lands([ROD, small(0.2)], [([0.0, 0.0, 0.7], UPRIGHT), ([0.0; 3], UPRIGHT)], &corners(0.2));
    let (a, b) = (0.24, 0.18);
    let crossings = [[a, b], [a, -b], [-a, b], [-a, -b], [b, a], [b, -a], [-b, a], [-b, -a]];
    lands([ROD, small(a)], [([0.0, 0.0, 0.7], UPRIGHT), ([0.0; 3], UPRIGHT)], &crossings);
}

#[test]
fn a_cylinder_that_lies_on_a_box_touches_with_the_ends_of_the_common_line() {
    let on = |place: [f64; 3], turn: [f64; 3], expected: &[[f64; 2]]| lands([ROD, SLAB], [(place, turn), ([0.0; 3], UPRIGHT)], expected);
    on([0.1, 0.05, 0.5], ALONG_Y, &[[0.1, -0.45], [0.1, 0.55]]);
    on([0.1, 0.2, 0.5], ALONG_Y, &[[0.1, -0.3], [0.1, 0.6]]);
    on([0.0, 0.1, 0.5], ALONG_X, &[[-0.4, 0.1], [0.4, 0.1]]);
    // beside the box: from the lower rim to the upper edge
    lands([ROD, SLAB], [([0.4, 0.0, 0.7], ALONG_X), ([0.0; 3], ALONG_X)], &[[-0.1, 0.0], [0.2, 0.0]]);
}

#[test]
fn a_leaning_cylinder_touches_a_face_with_the_lowest_point_of_its_rim() {
    for angle in [1.0 / 1024.0, 0.05, 0.07, 0.5, 1.2, 1.5] {
        let (sine, cosine) = f64::sin_cos(angle);
        let place = [0.1, 0.05, 0.2 + 0.5 * cosine + 0.3 * sine];
        // towards (1, −1)/√2, halfway between two points that turn with the rim
        let (turn, along) = (angle * FRAC_1_SQRT_2, (0.3 * cosine - 0.5 * sine) * FRAC_1_SQRT_2);
        let lowest = [0.1 + along, 0.05 - along];
        for under in [SLAB, Shape::Cylinder { radius: 0.7, half_height: 0.2 }] {
            lands([ROD, under], [(place, [turn, turn, 0.0]), ([0.0; 3], UPRIGHT)], &[lowest]);
        }
    }
}

#[test]
fn edges_and_corners_of_a_box_touch_face_side_and_rim_of_a_cylinder() {
    let ridge = ([0.0; 3], [FRAC_PI_4, 0.0, 0.0]);
    let on_ridge = |shape: Shape, height: f64, turn: [f64; 3], expected: &[[f64; 2]]| {
        lands([shape, BEAM], [([0.0, 0.0, RIDGE + height], turn), ridge], expected);
    };
    // the face: the edge ends at the rim, or in its corners
    on_ridge(ROD, 0.5, UPRIGHT, &[[0.3, 0.0], [-0.3, 0.0]]);
    on_ridge(Shape::Cylinder { radius: 0.41, half_height: 0.5 }, 0.5, UPRIGHT, &[[0.4, 0.0], [-0.4, 0.0]]);
    // the side: across the edge, and along it up to the rims or the corners
    on_ridge(ROD, 0.3, ALONG_Y, &[[0.0, 0.0]]);
    on_ridge(ROD, 0.3, ALONG_X, &[[0.4, 0.0], [-0.4, 0.0]]);
    on_ridge(Shape::Cylinder { radius: 0.3, half_height: 0.39 }, 0.3, ALONG_X, &[[0.39, 0.0], [-0.39, 0.0]]);
    // the rim
    let (sine, cosine) = 0.5f64.sin_cos();
    let lean = [0.0, 0.5, 0.0];
    on_ridge(ROD, 0.5 * cosine + 0.3 * sine, lean, &[[0.3 * cosine - 0.5 * sine, 0.0]]);
    // a corner: the diagonal of a cube points up, half of it is 0.2 √3
    let up = UnitQuaternion::rotation_between(&Vector3::new(1.0, 1.0, 1.0), &Vector3::z()).expect("not opposite").scaled_axis();
    let cube = Shape::Box { half_extents: [0.2; 3] };
    let top = 0.2 * 3f64.sqrt();
    let on_corner =
        |height: f64, turn: [f64; 3]| lands([ROD, cube], [([0.05, 0.1, top + height], turn), ([0.0; 3], up.into())], &[[0.0, 0.0]]);
    on_corner(0.5, UPRIGHT);
    lands([ROD, cube], [([0.1, 0.0, top + 0.3], ALONG_X), ([0.0; 3], up.into())], &[[0.0, 0.0]]);
}

#[test]
fn two_cylinders_touch_with_faces_sides_and_rims() {
    let at = |shapes: [Shape; 2], first: Place, turn: [f64; 3], expected: &[[f64; 2]]| lands(shapes, [first, ([0.0; 3], turn)], expected);
    // face on face: the smaller one in the larger, equal ones, and two that overlap
    let four = |r: f64| [[r, 0.0], [0.0, r], [-r, 0.0], [0.0, -r]];
    at([ROD, SMALL], ([0.0, 0.0, 0.9], UPRIGHT), UPRIGHT, &four(0.2));
    at([SMALL, ROD], ([0.05, 0.0, 0.9], UPRIGHT), UPRIGHT, &[[0.25, 0.0], [0.05, 0.2], [-0.15, 0.0], [0.05, -0.2]]);
    at([ROD, ROD], ([0.0, 0.0, 1.0], UPRIGHT), UPRIGHT, &four(0.3));
    let half = 0.3 * FRAC_PI_4.cos();
    let eight = [four(0.3), [[half, half], [half, -half], [-half, half], [-half, -half]]].concat();
    at([ROD, ROD], ([0.0, 0.0, 1.0], [0.0, 0.0, FRAC_PI_4]), UPRIGHT, &eight);
    let aside = (0.09f64 - 0.225 * 0.225).sqrt();
    at([ROD, SMALL], ([0.25, 0.0, 0.9], UPRIGHT), UPRIGHT, &[[0.025, aside], [0.025, -aside], [-0.05, 0.0], [0.2, 0.0]]);
    let diagonal = 0.2 * FRAC_1_SQRT_2;
    let turned = [[0.025, aside], [0.025, -aside], [-0.05, 0.0], [0.2, 0.0], [diagonal, diagonal], [diagonal, -diagonal]];
    at([ROD, SMALL], ([0.25, 0.0, 0.9], [0.0, 0.0, FRAC_PI_4]), [0.0, 0.0, FRAC_PI_4], &turned);
    // sides: along each other, staggered, across each other
    at([ROD, SMALL], ([0.1, 0.0, 0.5], ALONG_X), ALONG_X, &[[0.4, 0.0], [-0.4, 0.0]]);
    at([ROD, SMALL], ([0.6, 0.0, 0.5], ALONG_X), ALONG_X, &[[0.1, 0.0], [0.4, 0.0]]);
    at([ROD, SMALL], ([0.3, 0.2, 0.5], ALONG_X), ALONG_Y, &[[0.0, 0.2]]);
    at([ROD, SMALL], ([0.0, 0.0, 0.5], ALONG_X), [FRAC_PI_2, 0.0, 0.0], &[[0.0, 0.0]]);
    // a rim on a side, along and across its axis, and on a rim
    let (sine, cosine) = 0.5f64.sin_cos();
    let (height, lowest, lean) = (0.5 * cosine + 0.3 * sine, 0.3 * cosine - 0.5 * sine, [0.0, 0.5, 0.0]);
    at([ROD, SMALL], ([0.0, 0.0, 0.2 + height], lean), ALONG_X, &[[lowest, 0.0]]);
    at([ROD, SMALL], ([-lowest, 0.0, 0.2 + height], lean), ALONG_Y, &[[0.0, 0.0]]);
    let (other, highest) = (0.4 * cosine + 0.2 * sine, 0.2 * cosine - 0.4 * sine);
    at([ROD, SMALL], ([-lowest, highest, other + height], lean), [0.5, 0.0, 0.0], &[[0.0, highest]]);
}

#[test]
fn a_capsule_touches_a_cylinder_with_its_ends_and_beside_side_and_rims() {
    let at = |first: Place, turn: [f64; 3], expected: &[[f64; 2]]| lands([PILL, ROD], [first, ([0.0; 3], turn)], expected);
    at(([0.0, 0.1, 0.5], ALONG_X), ALONG_Y, &[[0.0, 0.1]]);
    at(([0.0, 0.1, 1.1], UPRIGHT), UPRIGHT, &[[0.0, 0.1]]);
    at(([0.2, 0.0, 0.5], ALONG_X), ALONG_X, &[[-0.2, 0.0], [0.5, 0.0]]);
    at(([0.0, 0.1, 0.7], ALONG_X), UPRIGHT, &[[0.08f64.sqrt(), 0.1], [-0.08f64.sqrt(), 0.1]]);
    let wide = Shape::Cylinder { radius: 0.6, half_height: 0.5 };
    lands([PILL, wide], [([0.1, 0.1, 0.7], ALONG_X), ([0.0; 3], UPRIGHT)], &[[0.5, 0.1], [-0.3, 0.1]]);
}

#[test]
fn a_capsule_whose_segment_is_in_a_cylinder_leaves_by_the_rim_that_it_passes() {
    for (depth, gap) in [(0.05, -0.25), (-0.05, -0.15)] {
        let found = touches([PILL, ROD], [([0.0, 0.1, 0.5 - depth], ALONG_X), ([0.0; 3], UPRIGHT)], &worlds()[0]);
        let rims: Vec<_> = found.iter().filter(|touch| (touch.normal - Vector3::z()).norm() <= rounding(1024, 1.0)).collect();
        assert!(rims.len() == 2 && rims.iter().all(|touch| (touch.gap - gap).abs() <= rounding(64, 1.0)), "{depth}: {found:?}");
    }
}

#[test]
fn bodies_diagonally_apart_are_as_far_as_their_nearest_points() {
    for world in worlds() {
        let nearest = |shapes: [Shape; 2], first: Place, second: Place| {
            touches(shapes, [first, second], &world).iter().map(|touch| touch.gap).fold(f64::INFINITY, f64::min)
        };
        // rim and corner: (0.18, 0.24, 0.4) apart; two rims: 0.3 and 0.4
        let corner = nearest([ROD, SLAB], ([0.76, 1.08, 1.1], UPRIGHT), ([0.0; 3], UPRIGHT));
        assert!((corner - 0.5).abs() <= rounding(64, 2.0), "{corner}");
        let rims = nearest([ROD, SMALL], ([0.64, 0.48, 1.3], UPRIGHT), ([0.0; 3], UPRIGHT));
        assert!((rims - 0.5).abs() <= rounding(64, 2.0), "{rims}");
        let edge = nearest([ROD, SLAB], ([0.0, 1.2, 1.1], ALONG_X), ([0.0; 3], UPRIGHT));
        assert!((edge - (0.6f64.hypot(0.9) - 0.3)).abs() <= rounding(64, 2.0), "{edge}");
    }
}

/// The pairs that are met at random.
const PAIRS: [[Shape; 2]; 6] = [[ROD, SLAB], [ROD, SMALL], [SMALL, FLAT], [SMALL, BEAM], [PILL, ROD], [PILL, FLAT]];

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
    for shapes in [PAIRS[0], PAIRS[1], PAIRS[2], [PILL, ROD], [SLAB, ROD], [ROD, PILL]] {
        let [compared, wrong] = wrong_rates(shapes, |touch| touch.seen);
        assert!(compared > 300 && wrong == 0, "{shapes:?}: {wrong} of {compared}");
        let aside = |touch: &Touch| touch.points.map(|point| point + Vector3::new(0.01, 0.02, 0.03));
        let [compared, wrong] = wrong_rates(shapes, aside);
        assert!(2 * wrong > compared, "{shapes:?}: {wrong} of {compared}");
    }
}

#[test]
fn parallel_faces_share_one_normal_and_one_plane_and_others_do_not() {
    let mut numbers = Numbers(24);
    for (shapes, height) in [([ROD, SLAB], 0.7), ([ROD, SMALL], 0.9), ([SLAB, ROD], 0.7)] {
        for world in worlds() {
            for (part, shared) in [(0.01, true), (0.99, true), (2.01, false)] {
                let [a, b] = [0, 1].map(|_| numbers.next());
                let axis = Vector3::new(a, b, 0.0).normalize() * (part * PARALLEL_FACES);
                let found = touches(shapes, [([0.25, 0.1, height + 1.0 / 64.0], axis.into()), ([0.0; 3], UPRIGHT)], &world);
                let first = found[0].normal;
                let same = found.len() >= 4 && found.iter().all(|touch| touch.normal == first && touch.seen[0] == touch.seen[1]);
                assert_eq!(same, shared, "{shapes:?}, {part} θ₀: {found:?}");
            }
        }
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

#[test]
fn cans_on_each_other_and_one_that_lies_on_a_box_stay_where_they_are() {
    use crate::scenes::{Body, named};
    use crate::schemes::{MoreauJean, simulate};
    use moreau_contact::solvers::Auto;
    let mut scene = named("box-stack").expect("built in");
    // so deep that rounding opens nothing
    let deep = 1.0 / f64::from(1 << 20);
    let can = |name: &str, x: f64, floor: f64| Body::cylinder(name, 1.0, 0.25, 0.25, [x, 0.0, 0.25 + floor * (0.5 - deep) - deep]);
    let lying = Body { orientation: [FRAC_PI_4.cos(), FRAC_PI_4.sin(), 0.0, 0.0], ..can("lying", 4.0, 1.0) };
    let slab = Body::cuboid("slab", 4.0, [0.5, 0.5, 0.25], [4.0, 0.0, 0.25 - deep]);
    scene.bodies = vec![can("lower", 0.0, 0.0), can("middle", 0.0625, 1.0), can("upper", 0.0, 2.0), slab, lying];
    let (mechanism, start) = scene.spatial_mechanism().expect("valid");
    let before = mechanism.bodies(&start.position, &start.velocity);
    let motion = simulate(&MoreauJean::default(), &Auto, mechanism.as_ref(), start, 1.0 / 128.0, 64).expect("it rests");
    let last = motion.samples.last().expect("samples");
    for (body, start) in mechanism.bodies(&last.position, &last.velocity).iter().zip(&before) {
        let moved = Vector3::from(body.position) - Vector3::from(start.position);
        assert!(moved.norm() <= SAME_POINT, "{} moved by {moved}", body.name);
    }
}
