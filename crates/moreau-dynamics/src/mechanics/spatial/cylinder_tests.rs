//! Cylinders at boxes, cylinders and capsules, and capsules at boxes: gaps, points and normals where they are known in closed form, on both
//! sides of every boundary and turned in every way; faces.

use super::tests::Numbers;
use super::*;
use crate::tolerance::mechanics::SAME_POINT;
use moreau_exact::tolerance::rounding;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4};

/// Place and rotation vector of a body.
pub(super) type Place = ([f64; 3], [f64; 3]);

/// A rod of radius 0.3 m and half height 0.5 m.
pub(super) const ROD: Shape = Shape::Cylinder { radius: 0.3, half_height: 0.5 };
pub(super) const SMALL: Shape = Shape::Cylinder { radius: 0.2, half_height: 0.4 };
/// Wide and low.
pub(super) const FLAT: Shape = Shape::Cylinder { radius: 0.6, half_height: 0.1 };
pub(super) const PILL: Shape = Shape::Capsule { radius: 0.2, half_height: 0.4 };
/// Its upper face is at z = 0.2 m.
pub(super) const SLAB: Shape = Shape::Box { half_extents: [0.4, 0.6, 0.2] };
/// An edge along x is uppermost when it is turned about x by π/4, at √2 times 0.2 m.
pub(super) const BEAM: Shape = Shape::Box { half_extents: [0.4, 0.2, 0.2] };
const RIDGE: f64 = 0.2 * std::f64::consts::SQRT_2;
const UPRIGHT: [f64; 3] = [0.0; 3];
const ALONG_X: [f64; 3] = [0.0, FRAC_PI_2, 0.0];
const ALONG_Y: [f64; 3] = [FRAC_PI_2, 0.0, 0.0];
/// Gaps on both sides of touching \[m\].
const SIDES: [f64; 2] = [-1.0 / 1024.0, 1.0 / 1024.0];

pub(super) fn pose((place, turn): Place, world: &Pose) -> Pose {
    let quaternion = world.quaternion * UnitQuaternion::from_scaled_axis(Vector3::from(turn));
    Pose { centre: world.world(place.into()), quaternion, rotation: *quaternion.to_rotation_matrix().matrix() }
}

/// Where nothing is turned, and five other ways to look at it.
pub(super) fn worlds() -> Vec<Pose> {
    let mut numbers = Numbers(21);
    let mut vector = |size: f64| Vector3::from_fn(|_, _| numbers.next() * size);
    let other: Vec<_> = (0..5).map(|_| (vector(1.0), UnitQuaternion::from_scaled_axis(vector(3.0)))).collect();
    let all = std::iter::once((Vector3::zeros(), UnitQuaternion::identity())).chain(other);
    all.map(|(centre, quaternion)| Pose { centre, quaternion, rotation: *quaternion.to_rotation_matrix().matrix() }).collect()
}

pub(super) fn touches([own, other]: [Shape; 2], [first, second]: [Place; 2], world: &Pose) -> Vec<Touch> {
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
fn a_capsule_touches_a_box_with_its_ends_and_beside_edges_and_corners() {
    let at = |first: Place, turn: [f64; 3], expected: &[[f64; 2]]| lands([PILL, SLAB], [first, ([0.0; 3], turn)], expected);
    at(([0.1, 0.05, 0.8], UPRIGHT), UPRIGHT, &[[0.1, 0.05]]);
    at(([0.1, 0.05, 0.4], ALONG_Y), UPRIGHT, &[[0.1, -0.35], [0.1, 0.45]]);
    at(([0.0, 0.3, 0.4], ALONG_Y), UPRIGHT, &[[0.0, -0.1], [0.0, 0.6]]);
    // along an edge that is as far out as the axis
    at(([0.4, 0.05, 0.4], ALONG_Y), UPRIGHT, &[[0.4, -0.35], [0.4, 0.45]]);
    // across a box that is narrower than it is long
    let narrow = Shape::Box { half_extents: [0.3, 0.6, 0.2] };
    lands([PILL, narrow], [([0.0, 0.1, 0.4], ALONG_X), ([0.0; 3], UPRIGHT)], &[[0.3, 0.1], [-0.3, 0.1]]);
    // on a ridge, across it and along it
    let on_ridge = |place: [f64; 3], turn: [f64; 3], expected: &[[f64; 2]]| {
        lands([PILL, BEAM], [(place, turn), ([0.0; 3], [FRAC_PI_4, 0.0, 0.0])], expected);
    };
    on_ridge([0.05, 0.0, RIDGE + 0.2], ALONG_Y, &[[0.05, 0.0]]);
    on_ridge([0.1, 0.0, RIDGE + 0.2], ALONG_X, &[[-0.3, 0.0], [0.4, 0.0]]);
    // on a corner: the diagonal of a cube points up
    let up = UnitQuaternion::rotation_between(&Vector3::new(1.0, 1.0, 1.0), &Vector3::z()).expect("not opposite").scaled_axis();
    let cube = Shape::Box { half_extents: [0.2; 3] };
    lands([PILL, cube], [([0.1, 0.0, 0.2 * 3f64.sqrt() + 0.2], ALONG_X), ([0.0; 3], up.into())], &[[0.0, 0.0]]);
}

#[test]
fn a_capsule_whose_segment_is_in_a_box_leaves_by_the_edges_that_it_passes() {
    // the axis along the face, 0.05 m under it, on it and over it, beyond both sides of the box
    let narrow = Shape::Box { half_extents: [0.3, 0.6, 0.2] };
    for (height, gap) in [(-0.05, -0.25), (0.0, -0.2), (0.05, -0.15)] {
        let found = touches([PILL, narrow], [([0.0, 0.1, 0.2 + height], ALONG_X), ([0.0; 3], UPRIGHT)], &worlds()[0]);
        let slack = rounding(64, 1.0);
        let upward = |touch: &Touch| (touch.normal - Vector3::z()).norm() <= slack && (touch.gap - gap).abs() <= slack;
        assert!(found.len() == 2 && found.iter().all(upward), "{height}: {found:?}");
    }
    // through an upper edge, both ends outside: of the other edges that it passes within the box none is deep
    let block = Shape::Box { half_extents: [0.25, 0.6, 0.5] };
    let (deep, across) = (0.1, [0.0, -FRAC_PI_4, 0.0]);
    let place = [0.25 - deep * FRAC_1_SQRT_2, 0.0, 0.5 - deep * FRAC_1_SQRT_2];
    let found = touches([PILL, block], [(place, across), ([0.0; 3], UPRIGHT)], &worlds()[0]);
    let outward = Vector3::new(FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2);
    let slack = rounding(64, 1.0);
    let passed = |touch: &Touch| (touch.normal - outward).norm() <= slack && (touch.gap + 0.2 + deep).abs() <= slack;
    let deepest: Vec<_> = found.iter().filter(|touch| touch.gap < 0.0).collect();
    assert!(deepest.len() == 1 && passed(deepest[0]), "{found:?}");
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
