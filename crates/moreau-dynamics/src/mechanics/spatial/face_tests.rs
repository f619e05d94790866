//! Contacts of parallel faces: dependent rows, attainable velocities, gap rates, continuity, exchange. The planted mistake is always
//! the same manifold with the features' own normals and points.

use super::boxes;
use super::faces::Faces;
use super::tests::{Numbers, cuboid, pair};
use super::*;
use crate::tolerance::mechanics::{DIFFERENCE_STEP, PARALLEL, central_difference};
use moreau_contact::contact::delassus::delassus;
use moreau_exact::tolerance::rounding;

const UPPER: [f64; 3] = [0.5, 0.4, 0.3];
const LOWER: [f64; 3] = [0.45, 0.6, 0.35];

fn boxes() -> SpatialBodies {
    pair(cuboid("upper", UPPER), cuboid("lower", LOWER))
}

/// A box on a box at any place, turned in any way: the upper one by the yaw and tilted by the angle, with gaps up to a thousandth.
fn stacked(numbers: &mut Numbers, yaw: f64, tilt: f64) -> DVector<f64> {
    let mut vector = |size: f64| Vector3::from_fn(|_, _| numbers.next() * size);
    let (place, world, shift) = (vector(1.0), UnitQuaternion::from_scaled_axis(vector(2.0)), vector(0.1));
    let axis = (vector(1.0).xy()).normalize().push(0.0);
    let above = Vector3::new(shift[0], shift[1], UPPER[2] + LOWER[2] + 0.01 * shift[2]);
    let turned = world * UnitQuaternion::from_scaled_axis(axis * tilt) * UnitQuaternion::from_scaled_axis(Vector3::z() * yaw);
    let pose = |centre: Vector3<f64>, turn: UnitQuaternion<f64>| [centre[0], centre[1], centre[2], turn.w, turn.i, turn.j, turn.k];
    DVector::from_iterator(14, [pose(place + world * above, turned), pose(place, world)].into_iter().flatten())
}

/// A slope, and a box with a face on it as [`stacked`] puts one box on another.
fn on_ground(numbers: &mut Numbers, yaw: f64, tilt: f64) -> (SpatialBodies, DVector<f64>) {
    let both = stacked(numbers, yaw, tilt);
    let lower = Pose::of(1, &both);
    let normal = lower.rotation.column(2).normalize();
    let offset = normal.dot(&lower.centre) + LOWER[2];
    let ground = Plane::new(DVector::from_column_slice(normal.as_slice()), offset, 0.5, 0.0).expect("a unit normal");
    let body = SpatialBodies::new("box", vec![cuboid("box", UPPER)], [0.0, 0.0, -9.81], ground).expect("valid");
    (body, both.rows(0, 7).into_owned())
}

/// The candidates of two boxes.
fn manifold(
    half_extents: [[f64; 3]; 2],
    poses: [&Pose; 2],
    share: impl Fn(&Vector3<f64>, &Vector3<f64>) -> Option<Faces> + Copy,
) -> Vec<Touch> {
    let mut found = Touches::default();
    boxes::manifold(half_extents, poses, share, &mut found);
    // memory that served for another pair, and touches that stand before, change nothing
    let mut again = Touches::default();
    boxes::box_box([1.0, 0.2, 0.3], poses[1], [0.1, 0.4, 0.2], poses[0], &mut again);
    let begin = again.list.len();
    boxes::manifold(half_extents, poses, share, &mut again);
    assert_eq!(again.list[begin..], found.list);
    found.list
}

fn box_box(half_extents: [f64; 3], first: &Pose, other: [f64; 3], second: &Pose) -> Vec<Touch> {
    manifold([half_extents, other], [first, second], Faces::new)
}

/// The candidates of the two boxes, with shared normals and with their own.
fn touches(q: &DVector<f64>) -> [Vec<Touch>; 2] {
    let (first, second) = (Pose::of(0, q), Pose::of(1, q));
    [box_box(UPPER, &first, LOWER, &second), manifold([UPPER, LOWER], [&first, &second], |_, _| None)]
}

/// The four lowest corners of the box, levelled and as they are.
fn corners(bodies: &SpatialBodies, q: &DVector<f64>) -> [Vec<Touch>; 2] {
    let ground = bodies.ground.as_ref().expect("there is a ground");
    let mut touches = Vec::new();
    ground_touches(bodies.bodies[0].shape(), &Pose::of(0, q), ground, &mut touches);
    touches.retain(|touch| touch.gap < UPPER[2]);
    [touches.clone(), touches.into_iter().map(|touch| Touch { seen: touch.points, ..touch }).collect()]
}

/// The rows n, t₁, t₂ of every candidate, one block each.
fn blocks(bodies: &SpatialBodies, q: &DVector<f64>, touches: &[Touch]) -> [DMatrix<f64>; 3] {
    let poses: Vec<Pose> = bodies.poses(q).collect();
    let second = (poses.len() > 1).then_some(1);
    let two = [&poses[0], &poses[poses.len() - 1]];
    let rows: Vec<DMatrix<f64>> = touches
        .iter()
        .map(|touch| bodies.contact((0, second), touch, frame_of(&touch.normal), touch.seen, two).jacobian.to_dense())
        .collect();
    [0, 1, 2].map(|row| DMatrix::from_fn(rows.len(), rows[0].ncols(), |k, column| rows[k][(row, column)]))
}

fn stack(blocks: &[DMatrix<f64>]) -> DMatrix<f64> {
    let rows: Vec<_> = blocks.iter().flat_map(|block| block.row_iter()).collect();
    DMatrix::from_rows(&rows)
}

/// Singular values of H M^(−½), the largest first: their squares are the eigenvalues of the Delassus operator.
fn singular_values(bodies: &SpatialBodies, q: &DVector<f64>, rows: &DMatrix<f64>) -> Vec<f64> {
    let mass = bodies.mass_matrix(q);
    let scaled = DMatrix::from_fn(rows.nrows(), rows.ncols(), |row, column| rows[(row, column)] / mass[(column, column)].sqrt());
    let mut values: Vec<f64> = scaled.singular_values().iter().copied().collect();
    values.sort_by(|one, other| other.total_cmp(one));
    values
}

/// Rounding of the rows: a lever is a difference of places up to 4 m, and lengths √m^(−1) and √J^(−1) of up to 5 scale it.
fn rows_are_rounded(rows: usize) -> f64 {
    5.0 * rounding(16, 4.0) * (rows as f64).sqrt()
}

fn tilts() -> impl Iterator<Item = f64> {
    (0..=24).map(|k| 10f64.powf(-12.0 + 0.25 * f64::from(k)))
}

/// How much the largest redundant direction is above its place: 6 of all rows, 3 of the normal and 3 of the tangential ones.
fn excess(bodies: &SpatialBodies, q: &DVector<f64>, touches: &[Touch]) -> f64 {
    let [normal, first, second] = blocks(bodies, q, touches);
    let mut worst = 0.0f64;
    for (rows, rank) in [(stack(&[normal.clone(), first.clone(), second.clone()]), 6), (normal, 3), (stack(&[first, second]), 3)] {
        let values = singular_values(bodies, q, &rows);
        assert!(values[rank - 1] > 0.1, "rank below {rank}: {values:?}");
        let beyond = values.get(rank).copied().unwrap_or(0.0);
        worst = worst.max(beyond / rows_are_rounded(rows.nrows()));
    }
    worst
}

#[test]
fn redundant_rows_of_a_face_on_a_face_are_dependent_to_rounding_and_those_with_own_normals_are_not() {
    let mut numbers = Numbers(11);
    for tilt in tilts() {
        for _ in 0..20 {
            let yaw = 3.0 * numbers.next();
            let q = stacked(&mut numbers, yaw, tilt);
            let (bodies, [shared, own]) = (boxes(), touches(&q));
            assert!(shared.len() >= 4 && shared.len() == own.len(), "{} candidates", shared.len());
            assert!(shared.iter().all(|touch| touch.normal == shared[0].normal && touch.seen[0] == touch.seen[1]));
            assert!(excess(&bodies, &q, &shared) <= 1.0, "tilt {tilt:e}: {}", excess(&bodies, &q, &shared));
            let planted = excess(&bodies, &q, &own);
            assert!(tilt < 1e-10 || planted > 1.0, "tilt {tilt:e}: {planted}");
        }
    }
}

#[test]
fn redundant_rows_of_a_face_on_the_ground_are_dependent_to_rounding_and_those_of_its_bare_corners_are_not() {
    let mut numbers = Numbers(12);
    for tilt in tilts() {
        for _ in 0..20 {
            let yaw = 3.0 * numbers.next();
            let (body, q) = on_ground(&mut numbers, yaw, tilt);
            let [level, bare] = corners(&body, &q);
            assert_eq!(level.len(), 4);
            assert!(excess(&body, &q, &level) <= 1.0, "tilt {tilt:e}: {}", excess(&body, &q, &level));
            let planted = excess(&body, &q, &bare);
            assert!(tilt < 1e-10 || planted > 1.0, "tilt {tilt:e}: {planted}");
        }
    }
}

#[test]
fn the_delassus_operator_of_four_face_points_has_six_eigenvalues_and_rounding() {
    let mut numbers = Numbers(13);
    let (mut planted, mut cases) = (0, 0);
    for tilt in tilts().chain([2e-6, 4e-6, 8e-6, 16e-6, 32e-6]) {
        let q = stacked(&mut numbers, 0.0, tilt);
        let (bodies, [shared, own]) = (boxes(), touches(&q));
        let eigenvalues = |touches: &[Touch]| {
            let w = delassus(&bodies.mass_matrix(&q), &stack(&blocks(&bodies, &q, touches))).expect("SPD");
            let mut values: Vec<f64> = w.symmetric_eigenvalues().iter().copied().collect();
            values.sort_by(|one, other| other.total_cmp(one));
            assert_eq!(values.len(), 12);
            values
        };
        let bound = |largest: f64| rounding(12, largest);
        let (found, before) = (eigenvalues(&shared), eigenvalues(&own));
        assert!(found[5] > 0.01 && found[6..].iter().all(|value| value.abs() <= bound(found[0])), "tilt {tilt:e}: {found:?}");
        // θ² is above rounding for tilts above √ε
        planted += usize::from(before[6] > bound(before[0]));
        cases += usize::from(tilt > 4.0 * bound(before[0]).sqrt());
    }
    assert!(cases >= 4 && planted >= cases, "{planted} of {cases}");
}

/// What is left of (u_n, 0, 0) when bodies that move at order one have done their best to get these velocities at the candidates.
fn unattainable(bodies: &SpatialBodies, q: &DVector<f64>, touches: &[Touch], velocity: &DVector<f64>) -> f64 {
    let rows = blocks(bodies, q, touches);
    let mut wanted = DVector::zeros(3 * touches.len());
    wanted.rows_mut(0, touches.len()).copy_from(&(&rows[0] * velocity));
    let rows = stack(&rows);
    let squares = (rows.transpose() * &rows).symmetric_eigen();
    let inverse = DMatrix::from_diagonal(&squares.eigenvalues.map(|square| if square > PARALLEL { 1.0 / square } else { 0.0 }));
    let fit = &squares.eigenvectors * inverse * squares.eigenvectors.transpose() * rows.transpose();
    // the second fit takes away the rounding of the first
    let left = &wanted - &rows * (&fit * &wanted);
    (&left - &rows * (&fit * &left)).amax()
}

#[test]
fn faces_can_close_at_any_rate_without_sliding_and_with_own_normals_they_slide_by_the_tilt() {
    let mut numbers = Numbers(14);
    for tilt in [1e-9, 1e-8, 1e-7, 1e-6, 1e-5] {
        for _ in 0..20 {
            let yaw = 0.8 + 0.5 * numbers.next();
            let q = stacked(&mut numbers, yaw, tilt);
            let (body, place) = on_ground(&mut numbers, yaw, tilt);
            let velocity = DVector::from_fn(12, |_, _| 1.0 + 0.5 * numbers.next());
            let bound = rows_are_rounded(24) * 16.0;
            let ([shared, own], [level, bare]) = (touches(&q), corners(&body, &place));
            let left = |touches: &[Touch]| unattainable(&boxes(), &q, touches, &velocity);
            let lone = |touches: &[Touch]| unattainable(&body, &place, touches, &velocity.rows(0, 6).into_owned());
            assert!(left(&shared) <= bound && lone(&level) <= bound, "tilt {tilt:e}: {:e}, {:e}", left(&shared), lone(&level));
            assert!(left(&own) > 1e-3 * tilt && lone(&bare) > 1e-3 * tilt, "tilt {tilt:e}: {:e}, {:e}", left(&own), lone(&bare));
        }
    }
}

#[test]
fn gaps_of_parallel_faces_change_at_the_rate_of_their_rows_up_to_the_angle_between_the_normals() {
    let (mut numbers, h) = (Numbers(15), DIFFERENCE_STEP);
    let (mut compared, mut sharpest) = (0, 0.0f64);
    for part in [0.5, 0.9, 1.25, 1.5, 1.75, 2.5] {
        for _ in 0..100 {
            let yaw = 0.8 + 0.5 * numbers.next();
            let q = stacked(&mut numbers, yaw, part * PARALLEL_FACES);
            let v = DVector::from_fn(12, |_, _| 0.5 * numbers.next());
            let bodies = boxes();
            let [[now, own], [after, _], [before, _]] = [0.0, h, -h].map(|time| touches(&bodies.integrate(&q, &v, time)));
            let poses: Vec<Pose> = bodies.poses(&q).collect();
            for (touch, own) in now.iter().zip(&own) {
                let same = |list: &[Touch]| list.iter().find(|other| other.features == touch.features).copied();
                let (Some(after), Some(before)) = (same(&after), same(&before)) else { continue };
                let (measured, turning) = ((after.gap - before.gap) / (2.0 * h), (after.normal - before.normal).norm() / (2.0 * h));
                let rates = &bodies.contact((0, Some(1)), touch, frame_of(&touch.normal), touch.seen, [&poses[0], &poses[1]]).jacobian * &v;
                // v_t at the two points that touch and at the one that is seen differ by the gap times a spin
                let slip = rates[1].hypot(rates[2]) + touch.gap.abs() * (turning + spin(0, &v).norm() + spin(1, &v).norm());
                let angle = touch.normal.cross(&own.normal).norm() / touch.normal.dot(&own.normal);
                let bound = angle * slip;
                let error = (measured - rates[0]).abs();
                assert!(error <= bound + central_difference(2.0, 2.0), "{part} θ₀: {error:e} above {bound:e}");
                sharpest = sharpest.max(error / (bound + central_difference(2.0, 2.0)));
                compared += 1;
            }
        }
    }
    assert!(compared > 3000 && sharpest > 0.9, "{compared} compared, the bound is reached to {sharpest}");
}

/// The largest change of normals, gaps and seen points between two lists of the same candidates.
fn change(one: &[Touch], other: &[Touch]) -> f64 {
    assert_eq!(one.len(), other.len());
    let between = |(a, b): (&Touch, &Touch)| {
        let seen = [0, 1].map(|body| (a.seen[body] - b.seen[body]).amax());
        assert_eq!(a.features, b.features);
        (a.normal - b.normal).amax().max((a.gap - b.gap).abs()).max(seen[0]).max(seen[1])
    };
    one.iter().zip(other).map(between).fold(0.0, f64::max)
}

#[test]
fn everything_changes_continuously_as_faces_tilt_and_a_switch_would_show() {
    let at = |tilt: f64| touches(&stacked(&mut Numbers(16), 0.7, tilt));
    let step = PARALLEL_FACES / 64.0;
    for k in 0..192 {
        let [[one, _], [other, _]] = [k, k + 1].map(|k| at(f64::from(k) * step));
        // a box of a metre moves by less than 2 m per radian, the weight changes by 1/θ₀ per radian and moves points by half a gap
        let gap = one.iter().map(|touch| touch.gap.abs()).fold(0.0, f64::max);
        let bound = (4.0 + 2.0 * gap / PARALLEL_FACES) * step;
        assert!(change(&one, &other) <= bound, "{k}: {:e} above {bound:e}", change(&one, &other));
        if k == 64 {
            let [shared, own] = at(f64::from(k) * step);
            assert!(change(&shared, &own) > 4.0 * bound, "a switch at θ₀ would jump by {:e}", change(&shared, &own));
        }
    }
    let [beyond, own] = at(2.0 * PARALLEL_FACES * 1.01);
    assert_eq!(beyond, own, "nothing is shared beyond twice the angle");
}

#[test]
fn exchanging_the_bodies_mirrors_a_face_contact() {
    let mut numbers = Numbers(17);
    for part in [0.0, 1e-6, 1e-3, 0.5, 1.0, 1.5] {
        for _ in 0..20 {
            let yaw = 0.8 + 0.5 * numbers.next();
            let q = stacked(&mut numbers, yaw, part * PARALLEL_FACES);
            let (first, second) = (Pose::of(0, &q), Pose::of(1, &q));
            let (one, other) = (box_box(UPPER, &first, LOWER, &second), box_box(LOWER, &second, UPPER, &first));
            assert_eq!(one.len(), other.len());
            for touch in &one {
                let mirrored = other.iter().copied().map(Touch::swapped).find(|other| other.features == touch.features).expect("mirrored");
                // edges that cross at ψ > 0.2 find their crossing to rounding/ψ
                assert!(change(&[*touch], &[mirrored]) <= rounding(256, 4.0), "{touch:?} against {mirrored:?}");
            }
        }
    }
}

/// A box rolled about y whose lowest edge is over a face of a box as wide as it, up to a factor, anywhere: the candidates at that edge.
fn edge_over_a_face(numbers: &mut Numbers, wider: f64) -> usize {
    let (upper, lower) = ([0.3, 0.4, 0.2], [0.9, 0.4 * wider, 0.35]);
    let mut vector = |size: f64| Vector3::from_fn(|_, _| numbers.next() * size);
    let (place, world, shift) = (vector(1.0), UnitQuaternion::from_scaled_axis(vector(2.0)), vector(0.4));
    let angle: f64 = 0.2 + shift[1].abs();
    let height = upper[2] * angle.cos() + upper[0] * angle.sin() + lower[2];
    let gap = 1e-3 * shift[2];
    let turned = world * UnitQuaternion::from_scaled_axis(Vector3::y() * angle);
    let pose = |centre: Vector3<f64>, turn: UnitQuaternion<f64>| [centre[0], centre[1], centre[2], turn.w, turn.i, turn.j, turn.k];
    let above = place + world * Vector3::new(shift[0], 0.0, height + gap);
    let q = DVector::from_iterator(14, [pose(above, turned), pose(place, world)].into_iter().flatten());
    let found = box_box(upper, &Pose::of(0, &q), lower, &Pose::of(1, &q));
    found.iter().filter(|touch| (touch.gap - gap).abs() <= rounding(256, 4.0)).count()
}

#[test]
fn an_edge_over_a_face_that_ends_where_it_does_touches_at_both_ends() {
    let mut numbers = Numbers(31);
    for wider in [1.0, 1.0 - f64::EPSILON, 1.0 + f64::EPSILON, 2.0, 0.5] {
        let found: Vec<usize> = (0..400).map(|_| edge_over_a_face(&mut numbers, wider)).collect();
        let wrong = found.iter().filter(|count| **count != 2).count();
        assert_eq!(wrong, 0, "of {} edges at width {wider}", found.len());
    }
}

/// A box over a box as wide in y, tilted about y and yawed, so that their edges along x cross at x = ⅕; the candidates.
fn tilted_and_yawed(tilt: f64, yaw: f64, gap: f64) -> Vec<Touch> {
    let (upper, lower) = ([0.4, 0.3, 0.1], [0.9, 0.3, 0.35]);
    let turn = UnitQuaternion::from_scaled_axis(Vector3::z() * yaw) * UnitQuaternion::from_scaled_axis(Vector3::y() * tilt);
    let height = lower[2] + upper[2] * tilt.cos() + upper[0] * tilt.abs().sin() + gap;
    let q = [0.0, -0.2 * yaw, height, turn.w, turn.i, turn.j, turn.k, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let q = DVector::from_row_slice(&q);
    box_box(upper, &Pose::of(0, &q), lower, &Pose::of(1, &q))
}

#[test]
fn edges_that_nearly_lie_over_each_other_never_push_sideways() {
    for tilt in [2e-3, 1e-2, -5e-3] {
        for yaw in [1e-5, 1e-4, 1e-3, -1e-3] {
            for gap in [1e-6, -1e-6, -1e-4] {
                let found = tilted_and_yawed(tilt, yaw, gap);
                assert!(found.iter().any(|touch| touch.gap <= gap.abs() * (1.0 + BESIDE)), "{tilt} {yaw} {gap}: {found:?}");
                for touch in found {
                    // no part of a normal points out of a side that the other box is not beside
                    assert!(touch.normal.z > 0.9, "{tilt} {yaw} {gap}: {touch:?}");
                }
            }
        }
    }
}

#[test]
fn an_edge_that_leaves_a_face_across_its_rim_touches_at_both_ends_of_the_way() {
    // the lowest edge of the upper box, along y, is over the rim x = 0.4 of the lower one in its middle, at a small angle
    let (upper, lower) = ([0.2, 0.3, 0.1], [0.4, 0.5, 0.35]);
    for yaw in [5e-4, 9e-4, 1.2e-3, 1e-2] {
        let roll: f64 = -0.3;
        let turn = UnitQuaternion::from_scaled_axis(Vector3::z() * yaw) * UnitQuaternion::from_scaled_axis(Vector3::y() * roll);
        let lowest = turn * Vector3::new(-upper[0], 0.0, -upper[2]);
        let centre = Vector3::new(0.4, 0.0, lower[2] + 1e-7) - lowest;
        let q = [centre.x, centre.y, centre.z, turn.w, turn.i, turn.j, turn.k, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        let q = DVector::from_row_slice(&q);
        let near: Vec<f64> =
            box_box(upper, &Pose::of(0, &q), lower, &Pose::of(1, &q)).iter().filter(|t| t.gap < 2e-7).map(|t| t.points[0].y).collect();
        let (low, high) = near.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (y.min(low), y.max(high)));
        assert!(high - low > 0.29, "{yaw}: {near:?}");
    }
}
