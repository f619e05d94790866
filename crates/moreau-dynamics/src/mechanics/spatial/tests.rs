//! Bodies in space: candidates, gaps, gap rates and energies of every pair of shapes.

use super::super::testing::assert_consistent;
use super::*;
use crate::tolerance::mechanics;
use moreau_exact::tolerance::rounding;
use nalgebra::dvector;

pub(super) fn cuboid(name: &str, half_extents: [f64; 3]) -> SpatialBody {
    SpatialBody::solid(name, Shape::Box { half_extents }, 1.5).expect("valid")
}

fn ball(name: &str, radius: f64) -> SpatialBody {
    SpatialBody::solid(name, Shape::Sphere { radius }, 2.0).expect("valid")
}

fn slope() -> Plane {
    Plane::new(dvector![0.36, 0.48, 0.8], 0.1, 0.5, 0.0).expect("a unit normal")
}

pub(super) fn pair(first: SpatialBody, second: SpatialBody) -> SpatialBodies {
    SpatialBodies::new("pair", vec![first, second], [0.3, -0.2, -9.81], slope()).expect("valid")
}

/// (x, y, z) and the rotation vector of each body as a configuration.
pub(super) fn configuration(places: &[[f64; 6]]) -> DVector<f64> {
    let part = |[x, y, z, a, b, c]: &[f64; 6]| {
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(*a, *b, *c));
        [*x, *y, *z, turn.w, turn.i, turn.j, turn.k]
    };
    DVector::from_iterator(7 * places.len(), places.iter().flat_map(part))
}

/// The candidates between the bodies, without those of the ground.
pub(super) fn between(mechanism: &SpatialBodies, q: &DVector<f64>) -> Vec<Contact> {
    let bodies = |contact: &Contact| contact.place.expect("bodies have places").bodies;
    mechanism.contacts(q).into_iter().filter(|contact| bodies(contact).1.is_some()).collect()
}

fn cubes(places: &[[f64; 6]; 2]) -> Vec<Contact> {
    between(&pair(cuboid("a", [0.5; 3]), cuboid("b", [0.5; 3])), &configuration(places))
}

#[test]
fn every_pair_of_shapes_has_gap_rates_equal_to_its_jacobian() {
    let (a, b) = ([0.3, 0.2, 0.25], [0.5, 0.1, 0.3]);
    let pairs = [
        pair(cuboid("a", a), cuboid("b", b)),
        pair(ball("a", 0.3), cuboid("b", b)),
        pair(cuboid("a", a), ball("b", 0.3)),
        pair(ball("a", 0.2), ball("b", 0.3)),
    ];
    let places = [
        [[0.05, 0.02, 0.83, 0.21, 0.1, -0.3], [0.0, 0.0, 0.4, -0.1, 0.02, 0.05]],
        [[0.35, 0.11, 0.61, 0.02, 0.4, 0.8], [0.0, 0.0, 0.4, 0.01, 0.02, -0.05]],
        [[0.9, 0.45, 0.4, 0.3, 0.2, 1.4], [0.0, 0.0, 0.4, -0.3, 0.5, 0.2]],
        [[-0.83, 0.1, 0.89, 0.7, 0.3, 0.1], [0.0, 0.0, 0.4, 0.3, -0.7, 0.0]],
        [[0.1, 0.03, 0.47, 0.1, 0.0, 0.2], [0.0, 0.0, 0.4, 0.05, 0.1, 0.0]],
        [[0.1, 0.25, 1.1, 0.785, 0.0, 0.0], [0.0, 0.0, 0.4, 0.0, 0.0, 0.9]],
    ];
    let velocity = dvector![0.3, -0.8, 0.6, -0.2, 0.1, -0.9, 0.5, 0.7, -0.4, 1.1, 0.2, -0.6];
    for mechanism in &pairs {
        for place in places {
            assert_consistent(mechanism, &configuration(&place), &velocity);
        }
    }
}

/// Uniform numbers in \[−1, 1) from a fixed seed (SplitMix64).
pub(super) struct Numbers(pub u64);

impl Numbers {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) as f64 / 2f64.powi(63) - 1.0
    }

    fn place(&mut self, distance: f64, angle: f64) -> [f64; 6] {
        std::array::from_fn(|k| self.next() * if k < 3 { distance } else { angle })
    }
}

#[test]
fn gap_rates_of_boxes_equal_their_jacobian_wherever_the_features_stay_the_same() {
    let mechanism = pair(cuboid("a", [0.5, 0.3, 0.4]), cuboid("b", [0.4, 0.6, 0.2]));
    let mut numbers = Numbers(1);
    let (mut compared, h) = (0, mechanics::DIFFERENCE_STEP);
    for _ in 0..500 {
        let q = configuration(&[numbers.place(0.8, 3.0), numbers.place(0.3, 3.0)]);
        let v = DVector::from_fn(12, |_, _| numbers.next());
        let [after, before] = [h, -h].map(|h| between(&mechanism, &mechanism.integrate(&q, &v, h)));
        for contact in between(&mechanism, &q) {
            let place = contact.place.expect("bodies have places");
            let same =
                |list: &[Contact]| list.iter().find(|other| other.place.is_some_and(|other| other.is_same(&place))).map(|found| found.gap);
            let (Some(after), Some(before)) = (same(&after), same(&before)) else { continue };
            let (measured, rate) = ((after - before) / (2.0 * h), (&contact.jacobian * &v)[0]);
            // Edges that cross at the angle ψ turn their common normal 1/sin ψ times as fast as the boxes turn.
            let bound = mechanics::central_difference(v.norm(), 2.0) / mechanics::PARALLEL.powi(2).max(sine(&q, &place).powi(3));
            assert!((measured - rate).abs() <= bound, "{}: dφ/dt = {measured}, H_n v = {rate}", contact.label());
            compared += 1;
        }
    }
    assert!(compared > 1000, "only {compared} candidates kept their features");
}

/// |d × e| of the two edges of a candidate, 1 for a corner on a face: the sine by which its normal is defined.
fn sine(q: &DVector<f64>, place: &Place) -> f64 {
    let poses = [Pose::of(0, q), Pose::of(1, q)];
    let normal = Vector3::from(place.frame[0]);
    let along = |body: usize| (0..3).map(move |axis| (body, axis));
    let flat = |(body, axis): (usize, usize)| normal.dot(&poses[body].rotation.column(axis)).abs();
    let is_face = along(0).chain(along(1)).any(|axis| flat(axis) > 1.0 - mechanics::own_axis());
    if is_face {
        return 1.0;
    }
    let pairs = along(0).flat_map(|own| along(1).map(move |other| (own, other)));
    let level = pairs.filter(|(own, other)| flat(*own) < mechanics::own_edge() && flat(*other) < mechanics::own_edge());
    let sines = level.map(|((_, own), (_, other))| poses[0].rotation.column(own).cross(&poses[1].rotation.column(other)).norm());
    sines.fold(1.0, f64::min)
}

#[test]
fn no_gap_is_negative_while_the_boxes_are_apart_and_some_gap_is_when_they_overlap() {
    // The library's iterative distance is another algorithm than its separating axes, good to about √ε of the size.
    let accuracy = f64::EPSILON.sqrt();
    let (a, b) = ([0.5, 0.3, 0.4], [0.4, 0.6, 0.2]);
    let mechanism = pair(cuboid("a", a), cuboid("b", b));
    let mut numbers = Numbers(2);
    let (mut apart, mut together) = (0, 0);
    for _ in 0..2000 {
        let q = configuration(&[numbers.place(1.0, 3.0), numbers.place(0.3, 3.0)]);
        let nearest = between(&mechanism, &q).iter().map(|contact| contact.gap).fold(f64::INFINITY, f64::min);
        let distance = library_distance([a, b], &q);
        if distance > accuracy {
            assert!(nearest > 0.0, "{nearest} at distance {distance}");
            assert!(nearest <= distance * (1.0 + mechanics::BESIDE) + accuracy, "{nearest} at distance {distance}");
            apart += 1;
        } else if nearest >= 0.0 {
            assert!(nearest <= accuracy, "a gap of {nearest} although the boxes overlap");
        } else {
            together += 1;
        }
    }
    assert!(apart > 300 && together > 300, "{apart} apart, {together} together");
}

fn library_distance(half_extents: [[f64; 3]; 2], q: &DVector<f64>) -> f64 {
    use parry3d_f64::math::{Pose as Isometry, Rotation, Vector};
    let vector = |x: [f64; 3]| Vector::new(x[0], x[1], x[2]);
    let pose = |body: usize| {
        let part = |k: usize| q[7 * body + k];
        let turn = Rotation::from_xyzw(part(4), part(5), part(6), part(3)).normalize();
        Isometry::from_parts(vector([part(0), part(1), part(2)]), turn)
    };
    let cuboid = |body: usize| parry3d_f64::shape::Cuboid::new(vector(half_extents[body]));
    parry3d_f64::query::distance(&pose(0), &cuboid(0), &pose(1), &cuboid(1)).expect("boxes are supported").distance
}

#[test]
fn exchanging_the_bodies_turns_the_normals_round() {
    let (a, b) = ([0.5, 0.3, 0.4], [0.4, 0.6, 0.2]);
    let (one, other) = (pair(cuboid("a", a), cuboid("b", b)), pair(cuboid("b", b), cuboid("a", a)));
    let mut numbers = Numbers(3);
    for _ in 0..100 {
        let places = [numbers.place(0.8, 3.0), numbers.place(0.3, 3.0)];
        let smallest = |mechanism: &SpatialBodies, q: DVector<f64>| {
            let contacts = between(mechanism, &q);
            let nearest = contacts.into_iter().min_by(|one, other| one.gap.total_cmp(&other.gap)).expect("a candidate");
            (nearest.gap, Vector3::from(nearest.place.expect("bodies").frame[0]))
        };
        let (gap, normal) = smallest(&one, configuration(&places));
        let (swapped, turned) = smallest(&other, configuration(&[places[1], places[0]]));
        let bound = rounding(256, 2.0);
        assert!((gap - swapped).abs() <= bound, "{gap} against {swapped}");
        assert!((normal + turned).norm() <= bound / mechanics::PARALLEL || (gap - swapped).abs() <= bound, "{normal} against {turned}");
    }
}

#[test]
fn cubes_face_to_face_touch_at_the_corners_of_their_common_area() {
    for (shift, yaw, expected) in [(0.0, 0.0, 4), (0.25, 0.0, 4), (0.0, std::f64::consts::FRAC_PI_4, 8)] {
        let contacts = cubes(&[[shift, shift, 1.25, 0.0, 0.0, yaw], [0.0; 6]]);
        assert_eq!(contacts.len(), expected, "shift {shift}, yaw {yaw}: {:?}", contacts.iter().map(|c| c.label()).collect::<Vec<_>>());
        for contact in contacts {
            assert!((contact.gap - 0.25).abs() <= rounding(32, 1.0), "{}", contact.gap);
            let [n, _, _] = contact.place.expect("bodies").frame;
            assert!((Vector3::from(n) - Vector3::z()).norm() <= rounding(32, 1.0), "the normal points to the first body");
        }
    }
}

#[test]
fn crossed_edges_touch_at_one_point_along_their_common_normal() {
    // Both cubes stand on an edge, the upper one along x, the lower one along y.
    let quarter = std::f64::consts::FRAC_PI_4;
    for height in [1.5, 1.4] {
        let contacts = cubes(&[[0.1, 0.2, height, quarter, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0, quarter, 0.0]]);
        let nearest = contacts.iter().map(|contact| contact.gap).fold(f64::INFINITY, f64::min);
        assert!((nearest - (height - 2f64.sqrt())).abs() <= rounding(64, 2.0), "{nearest}");
        let contact = contacts.iter().find(|contact| contact.gap == nearest).expect("just found");
        assert!((Vector3::from(contact.place.expect("bodies").frame[0]) - Vector3::z()).norm() <= rounding(64, 1.0));
    }
}

#[test]
fn boxes_diagonally_apart_are_as_far_as_their_nearest_corners() {
    let corner = cubes(&[[1.25, 1.5, 2.0, 0.0, 0.0, 0.0], [0.0; 6]]);
    let expected = Vector3::<f64>::new(0.25, 0.5, 1.0).norm();
    assert!(corner.len() == 1 && (corner[0].gap - expected).abs() <= rounding(32, expected), "{corner:?}");
    let edge = cubes(&[[1.25, 0.1, 1.5, 0.0, 0.0, 0.0], [0.0; 6]]);
    let expected = 0.25f64.hypot(0.5);
    assert!(edge.iter().all(|contact| (contact.gap - expected).abs() <= rounding(32, expected)), "{edge:?}");
}

#[test]
fn a_sphere_whose_centre_is_inside_a_box_leaves_by_the_nearest_face() {
    let mechanism = pair(ball("ball", 0.25), cuboid("box", [1.0, 2.0, 3.0]));
    for (place, gap, normal) in [
        ([0.75, 0.5, 1.0], -0.5, Vector3::x()),
        ([-0.75, 0.5, 1.0], -0.5, -Vector3::x()),
        ([0.0, 1.5, 0.0], -0.75, Vector3::y()),
        ([0.0, 0.0, -2.75], -0.5, -Vector3::z()),
        ([0.0, 0.0, 3.5], 0.25, Vector3::z()),
    ] {
        let [x, y, z] = place;
        let [contact] = &between(&mechanism, &configuration(&[[x, y, z, 0.0, 0.0, 0.0], [0.0; 6]]))[..] else { panic!("one candidate") };
        assert_eq!((contact.gap, Vector3::from(contact.place.expect("bodies").frame[0])), (gap, normal), "at {place:?}");
    }
}

#[test]
fn only_candidates_within_reach_are_listed_and_none_of_them_is_missing() {
    let mechanism = pair(cuboid("a", [0.5, 0.3, 0.4]), ball("b", 0.2));
    let mut numbers = Numbers(4);
    for _ in 0..100 {
        let q = configuration(&[numbers.place(0.8, 3.0), numbers.place(0.8, 3.0)]);
        for reach in [-0.1, 0.0, 0.1, 0.5] {
            let expected: Vec<Contact> = mechanism.contacts(&q).into_iter().filter(|contact| contact.gap <= reach).collect();
            assert_eq!(mechanism.contacts_within(&q, reach), expected);
        }
    }
}

#[test]
fn a_contact_beyond_the_reach_does_not_close_in_the_step() {
    let mechanism = pair(cuboid("a", [0.5, 0.3, 0.4]), cuboid("b", [0.2; 3]));
    let (mut numbers, mut beyond) = (Numbers(5), 0);
    for _ in 0..500 {
        let q = configuration(&[numbers.place(1.5, 3.0), numbers.place(0.3, 3.0)]);
        let v = DVector::from_fn(12, |_, _| numbers.next());
        for h in [0.03, 0.1, 0.3] {
            let reach = mechanism.reach(&v, h);
            for contact in mechanism.contacts(&q).iter().filter(|contact| contact.gap > reach) {
                let u = &contact.jacobian * &v;
                assert!(h * (u[0].abs() + 0.5 * u[1].hypot(u[2])) < contact.gap, "{}", contact.label());
                beyond += 1;
            }
        }
    }
    assert!(beyond > 1000 && mechanism.reach(&DVector::from_element(12, 1e3), 1.0) == f64::INFINITY);
}

#[test]
fn halfway_rows_are_those_of_the_point_between_the_two_that_touch() {
    // A ball of radius 1/2 whose centre is 1/4 above the floor: it touches 1/4 below, halfway is 1/8 below, 3/8 under its centre.
    let ball = SpatialBody::solid("ball", Shape::Sphere { radius: 0.5 }, 2.0).expect("valid");
    let ground = Plane::new(dvector![0.0, 0.0, 1.0], 0.0, 0.5, 0.0).expect("a unit normal");
    let bodies = SpatialBodies::new("ball", vec![ball], [0.0, 0.0, -9.81], ground).expect("valid");
    let position = dvector![0.0, 0.0, 0.25, 1.0, 0.0, 0.0, 0.0];
    let [material, halfway] = [bodies.contacts(&position).remove(0), bodies.contacts_halfway(&position, 0.0).remove(0)];
    assert_eq!((material.gap, halfway.gap), (-0.25, -0.25));
    // t₁ = x: a spin about y moves the lowest point by −0.5 and the point halfway by −0.375.
    assert_eq!((material.jacobian[(1, 4)], halfway.jacobian[(1, 4)]), (-0.5, -0.375));
    assert_eq!(bodies.inverse_mass(&halfway), Some(0.5));
    assert!(bodies.contacts_halfway(&position, -0.5).is_empty());
}

#[test]
fn the_gyroscopic_slope_is_the_derivative_of_the_force() {
    let bodies = pair(cuboid("a", [0.1, 0.2, 0.4]), cuboid("b", [0.3, 0.1, 0.2]));
    let q = configuration(&[[0.0, 0.0, 3.0, 0.3, -0.2, 0.5], [4.0, 0.0, 3.0, 0.0, 1.0, 0.0]]);
    let v = DVector::from_fn(12, |row, _| 1.5 - 0.7 * row as f64);
    let slope = Mass::Blocks(bodies.gyroscopic_slope(&q, &v).expect("free bodies")).to_dense();
    for column in 0..12 {
        // the torque is quadratic in v: its central difference over ±1 is exact
        let moved = |by: f64| bodies.force(&q, &(&v + DVector::from_fn(12, |row, _| if row == column { by } else { 0.0 })));
        let difference = (moved(1.0) - moved(-1.0)) * 0.5;
        assert!((difference - slope.column(column)).amax() <= rounding(32, 64.0), "{column}");
    }
}

#[test]
fn the_rotation_of_a_contact_is_the_relative_spin_in_its_frame() {
    let bodies = pair(ball("a", 0.5), ball("b", 0.25));
    let q = configuration(&[[0.0, 0.0, 3.0, 0.3, -0.2, 0.5], [0.4, 0.5, 3.0, 0.0, 1.0, 0.0]]);
    let v = DVector::from_fn(12, |row, _| 1.5 - 0.7 * row as f64);
    for contact in bodies.contacts(&q) {
        let place = contact.place.expect("bodies have places");
        let states = bodies.bodies(&q, &v);
        let spin = |body: usize| Vector3::from(states[body].angular_velocity);
        let relative = spin(place.bodies.0) - place.bodies.1.map_or(Vector3::zeros(), spin);
        let found = &bodies.contact_rotation(&q, &contact).expect("free bodies") * &v;
        for (row, direction) in place.frame.into_iter().enumerate() {
            assert!((found[row] - relative.dot(&Vector3::from(direction))).abs() <= rounding(32, 8.0), "{} {row}", contact.label());
        }
    }
}
