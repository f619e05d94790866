//! Planar bodies: candidates, gaps, gap rates and energies of every pair of shapes.

use super::super::testing::assert_consistent;
use super::*;
use crate::tolerance::mechanics;
use moreau_contact::contact::delassus::delassus;
use moreau_exact::tolerance::rounding;
use nalgebra::dvector;

fn level(friction: f64) -> Plane {
    Plane::new(dvector![0.0, 1.0], 0.0, friction, 0.0).expect("unit normal")
}

fn cuboid(name: &str, half_extents: [f64; 2]) -> PlanarBody {
    PlanarBody::solid(name, Shape::Box { half_extents }, 1.5).expect("valid")
}

fn disk(name: &str, radius: f64) -> PlanarBody {
    PlanarBody::solid(name, Shape::Disk { radius }, 2.0).expect("valid")
}

fn pair(first: PlanarBody, second: PlanarBody) -> PlanarBodies {
    PlanarBodies::new("pair", vec![first, second], [0.0, -9.81], level(0.5)).expect("valid")
}

/// The candidates between the bodies, without those of the ground.
fn between(mechanism: &PlanarBodies, q: &DVector<f64>) -> Vec<Contact> {
    mechanism.contacts(q).into_iter().filter(|contact| contact.place.is_some_and(|place| place.bodies.1.is_some())).collect()
}

#[test]
fn every_pair_of_shapes_has_gap_rates_equal_to_its_jacobian() {
    let shapes = [(cuboid("a", [0.3, 0.2]), cuboid("b", [0.5, 0.1])), (disk("a", 0.3), cuboid("b", [0.5, 0.1]))];
    let more = [(cuboid("a", [0.3, 0.2]), disk("b", 0.3)), (disk("a", 0.2), disk("b", 0.3))];
    let places = [
        dvector![0.05, 0.73, 0.21, 0.0, 0.4, -0.1],
        dvector![0.35, 0.61, 0.02, 0.0, 0.4, 0.01],
        dvector![0.9, 0.45, 0.4, 0.0, 0.4, -0.3],
        dvector![-0.83, 0.89, 0.7, 0.0, 0.4, 0.3],
        dvector![0.1, 0.47, 0.1, 0.0, 0.4, 0.05],
    ];
    for (first, second) in shapes.into_iter().chain(more) {
        let mechanism = pair(first, second);
        for q in &places {
            assert_consistent(&mechanism, q, &dvector![0.3, -0.8, 0.6, -0.2, 0.1, -0.9]);
        }
    }
}

#[test]
fn a_box_on_an_incline_touches_with_two_corners_and_its_tangent_points_down() {
    let angle = 0.35f64;
    let slope = Plane::new(dvector![angle.sin(), angle.cos()], 0.0, 0.5, 0.0).expect("unit normal");
    let block = PlanarBodies::new("block", vec![cuboid("block", [0.1, 0.05])], [0.0, -9.81], slope).expect("valid");
    let q = dvector![0.05 * angle.sin(), 0.05 * angle.cos(), angle];
    let contacts = block.contacts(&q);
    let gaps: Vec<bool> = contacts.iter().map(|contact| contact.gap.abs() <= rounding(6, 0.2)).collect();
    assert_eq!(gaps, [true, true, false, false], "the lower corners come first");
    let pull = (&contacts[0].jacobian * &block.force(&q, &DVector::zeros(3)))[1];
    assert!((pull - 1.5 * 9.81 * angle.sin()).abs() <= rounding(8, 20.0), "m g sin α down the slope, not {pull}");
    assert_consistent(&block, &q, &dvector![0.2, -0.1, 0.4]);
}

#[test]
fn a_stacked_box_rests_on_the_ends_of_the_overlap() {
    let tower = pair(cuboid("low", [0.1, 0.1]), cuboid("top", [0.1, 0.1]));
    let contacts = between(&tower, &dvector![0.0, 0.1, 0.0, 0.05, 0.3, 0.0]);
    assert_eq!(contacts.len(), 2);
    let arms: Vec<f64> = contacts.iter().map(|contact| contact.jacobian[(0, 2)].abs()).collect();
    for contact in &contacts {
        assert!(contact.gap.abs() <= rounding(6, 0.5), "touching, not {}", contact.gap);
        assert!((contact.jacobian[(0, 1)] + 1.0).abs() <= rounding(4, 1.0), "the normal points to the body named first");
    }
    assert!(arms.iter().any(|arm| (arm - 0.05).abs() <= rounding(6, 0.5)), "overlap starts at x = −0.05: {arms:?}");
    assert!(arms.iter().any(|arm| (arm - 0.1).abs() <= rounding(6, 0.5)), "overlap ends at x = 0.1: {arms:?}");
}

#[test]
fn a_corner_poking_a_face_has_its_depth_as_gap() {
    let poke = pair(cuboid("wedge", [0.1, 0.1]), cuboid("base", [1.0, 0.1]));
    let half_diagonal = 0.1 * std::f64::consts::SQRT_2;
    let height = 0.2 + half_diagonal - 0.01;
    let contacts = between(&poke, &dvector![0.0, height, std::f64::consts::FRAC_PI_4, 0.0, 0.1, 0.0]);
    let deepest = contacts.iter().map(|contact| contact.gap).fold(f64::INFINITY, f64::min);
    assert!((deepest + 0.01).abs() <= rounding(8, 0.5), "depth 0.01, not {deepest}");
}

#[test]
fn boxes_beside_each_other_diagonally_are_apart_by_the_distance_of_their_corners() {
    let apart = pair(cuboid("a", [0.1, 0.1]), cuboid("b", [0.1, 0.1]));
    let contacts = between(&apart, &dvector![0.0, 1.0, 0.0, 0.5, 1.6, 0.0]);
    for contact in contacts {
        assert!((contact.gap - 0.5).abs() <= rounding(8, 1.0), "√(0.3² + 0.4²), not {}", contact.gap);
    }
}

#[test]
fn a_disk_inside_a_box_is_pushed_to_the_nearest_face() {
    let inside = pair(disk("disk", 0.1), cuboid("box", [0.5, 0.2]));
    let contact = &between(&inside, &dvector![0.1, 1.15, 0.0, 0.0, 1.0, 0.0])[0];
    assert!((contact.gap + 0.15).abs() <= rounding(8, 1.0), "depth 0.05 + radius 0.1");
    assert_eq!(contact.jacobian[(0, 1)], 1.0, "upwards");
}

#[test]
fn concentric_disks_have_a_finite_frame() {
    let both = pair(disk("a", 0.1), disk("b", 0.2));
    let contact = &between(&both, &dvector![0.0, 1.0, 0.0, 0.0, 1.0, 0.0])[0];
    assert!(contact.jacobian.to_dense().iter().all(|x| x.is_finite()) && contact.gap < 0.0);
}

#[test]
fn delassus_operator_of_a_rolling_disk_shows_its_inertia() {
    let wheel = PlanarBodies::new("wheel", vec![disk("wheel", 0.4)], [0.0, -9.81], level(0.5)).expect("valid");
    let q = dvector![0.0, 0.4, 0.0];
    let w = delassus(&wheel.mass_matrix(&q), &wheel.contacts(&q)[0].jacobian.to_dense()).expect("SPD");
    assert!((w[(0, 0)] - 0.5).abs() + w[(0, 1)].abs() + (w[(1, 1)] - 1.5).abs() <= rounding(8, 2.0), "1/m, 0, 1/m + r²/I: {w}");
}

/// The singular values of the n and t rows of the candidates, the largest first.
fn singular_values(bodies: &PlanarBodies, q: &DVector<f64>, touches: &[Touch], rows: std::ops::Range<usize>) -> Vec<f64> {
    let poses = bodies.poses(q);
    let second = (poses.len() > 1).then_some(1);
    let blocks =
        touches.iter().map(|touch| bodies.contact(0, second, touch, &poses, 0).jacobian.to_dense().rows_range(rows.clone()).into_owned());
    let all: Vec<_> = blocks.flat_map(|block| block.row_iter().map(|row| row.into_owned()).collect::<Vec<_>>()).collect();
    let mut values: Vec<f64> = DMatrix::from_rows(&all).singular_values().iter().copied().collect();
    values.sort_by(|one, other| other.total_cmp(one));
    values
}

#[test]
fn two_points_of_a_face_have_three_velocities_and_one_tangential_one_and_with_own_normals_more() {
    let (low, top) = ([0.5, 0.1], [0.3, 0.2]);
    let tower = pair(cuboid("top", top), cuboid("low", low));
    // one row for each of the two velocities of 2 points, of size 1 and levers below 1
    let bound = rounding(16, 4.0);
    for (tilt, turn) in (0..=24).flat_map(|k| [-1.0, 0.3, 2.0].map(|turn| (10f64.powf(-12.0 + 0.25 * f64::from(k)), turn))) {
        let ([sine, cosine], height) = ([f64::sin(turn), f64::cos(turn)], low[1] + top[1] + mechanics::NEAR);
        // the upper box hangs over the end of the lower one: one corner of each lies over a face of the other
        let centre = [0.1 + 0.3 * cosine + height * sine, 0.2 + height * cosine - 0.3 * sine];
        let q = dvector![centre[0], centre[1], turn + tilt, 0.1, 0.2, turn];
        let poses = tower.poses(&q);
        let shared = boxes::box_box(top, &poses[0], low, &poses[1]);
        let own = boxes::manifold([top, low], [&poses[0], &poses[1]], |_, _| None);
        let beyond = |touches: &[Touch]| {
            let (all, tangential) = (singular_values(&tower, &q, touches, 0..2), singular_values(&tower, &q, touches, 1..2));
            assert!(all.len() == 4 && all[2] > 0.1 && tangential[0] > 0.1);
            all[3].max(tangential[1])
        };
        assert!(shared[0].normal == shared[1].normal && beyond(&shared) <= bound, "tilt {tilt:e}: {:e}", beyond(&shared));
        assert!(tilt < mechanics::tilt_shown(bound) || beyond(&own) > bound, "tilt {tilt:e}: {:e}", beyond(&own));
    }
}

#[test]
fn two_corners_of_a_face_on_the_ground_slide_alike_and_bare_ones_by_the_tilt_apart() {
    let bound = rounding(16, 4.0);
    for tilt in (0..=24).map(|k| 10f64.powf(-12.0 + 0.25 * f64::from(k))) {
        let block = PlanarBodies::new("block", vec![cuboid("block", [0.5, 0.2])], [0.0, -9.81], level(0.5)).expect("valid");
        let q = dvector![0.3, 0.2, std::f64::consts::FRAC_PI_2 * 2.0 + tilt];
        let touches = ground_touches(block.bodies[0].shape(), &block.poses(&q)[0], &level(0.5));
        let mut lowest: Vec<Touch> = touches.into_iter().filter(|touch| touch.gap < 0.2).collect();
        let apart = |touches: &[Touch]| singular_values(&block, &q, touches, 1..2)[1];
        assert!(lowest.len() == 2 && apart(&lowest) <= bound, "tilt {tilt:e}: {:e}", apart(&lowest));
        let [left, right] = [0, 1].map(|k| block.contacts(&q)[[2, 3][k]].jacobian.row(1).into_owned());
        assert!((left - right).amax() <= bound, "the mechanism lists the levelled corners");
        let corners = shape::corners([0.5, 0.2]).map(|corner| block.poses(&q)[0].world(corner));
        for (touch, corner) in lowest.iter_mut().zip([corners[2], corners[3]]) {
            touch.points = [corner; 2];
        }
        assert!(tilt < mechanics::tilt_shown(bound) || apart(&lowest) > bound, "tilt {tilt:e}: {:e}", apart(&lowest));
    }
}

#[test]
fn gaps_of_parallel_faces_in_the_plane_change_at_the_rate_of_their_rows_up_to_the_tilt() {
    let (low, top) = ([0.5, 0.1], [0.3, 0.2]);
    let tower = pair(cuboid("top", top), cuboid("low", low));
    let h = mechanics::DIFFERENCE_STEP;
    for part in [0.5, 0.9, 1.5, 2.5] {
        let q = dvector![0.4, 0.5, 0.02 + part * mechanics::PARALLEL_FACES, 0.1, 0.2, 0.02];
        let v = dvector![0.7, -0.3, 0.2, -0.4, 0.1, -0.3];
        let [now, after, before] = [0.0, h, -h].map(|time| between(&tower, &(&q + &v * time)));
        for (k, contact) in now.iter().enumerate() {
            let (measured, rates) = ((after[k].gap - before[k].gap) / (2.0 * h), &contact.jacobian * &v);
            let slip = rates[1].abs() + contact.gap.abs();
            let angle = if part < 2.0 { 0.5 * mechanics::PARALLEL_FACES } else { 0.0 };
            let (error, bound) = ((measured - rates[0]).abs(), angle * slip + mechanics::central_difference(1.0, 2.0));
            assert!(error <= bound, "{part}: {error:e} above {bound:e}");
            assert!(part != 0.9 || error > 0.5 * bound, "the bound is not void: {error:e}");
        }
    }
}

#[test]
fn a_pair_may_have_its_own_material() {
    let own = PairMaterial { bodies: (1, Some(0)), friction: 0.9, restitution: 0.25 };
    let tower = pair(disk("a", 0.1), disk("b", 0.1)).with_pairs(vec![own]).expect("valid");
    let contacts = tower.contacts(&dvector![0.0, 0.1, 0.0, 0.0, 0.3, 0.0]);
    let materials: Vec<(f64, f64)> = contacts.iter().map(|contact| (contact.friction, contact.restitution)).collect();
    assert_eq!(materials, [(0.5, 0.0), (0.5, 0.0), (0.9, 0.25)]);
}

#[test]
fn nonsense_is_refused() {
    assert!(PlanarBody::solid("x", Shape::Disk { radius: -1.0 }, 1.0).is_err());
    assert!(PlanarBody::solid("x", Shape::Box { half_extents: [1.0, f64::NAN] }, 1.0).is_err());
    assert!(PlanarBody::new("x", Shape::Disk { radius: 1.0 }, 1.0, 0.0).is_err());
    assert!(PlanarBodies::new("x", vec![], [0.0, 0.0], level(0.0)).is_err());
    let stray = PairMaterial { bodies: (0, Some(7)), friction: 0.0, restitution: 0.0 };
    assert!(pair(disk("a", 0.1), disk("b", 0.1)).with_pairs(vec![stray]).is_err());
}

#[test]
fn solid_shapes_have_their_moments_of_inertia() {
    // A box of sides 2a = 2 and 2b = 6: m (4 + 36)/12 = m (1 + 9)/3; a disk: m r²/2.
    let cuboid = PlanarBody::solid("box", Shape::Box { half_extents: [1.0, 3.0] }, 1.5).expect("valid");
    assert_eq!(cuboid.inertia(), 1.5 * 40.0 / 12.0);
    assert_eq!(PlanarBody::solid("disk", Shape::Disk { radius: 2.0 }, 1.5).expect("valid").inertia(), 3.0);
}

/// Bodies of both shapes at random places about each other, and random velocities.
fn scattered(seed: u64, spread: f64) -> (PlanarBodies, DVector<f64>, DVector<f64>) {
    let number = |k: u64| {
        let mixed = (seed * 1000 + k).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        ((mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let bodies = vec![cuboid("a", [0.4, 0.1]), cuboid("b", [0.3, 0.2]), disk("c", 0.25), cuboid("d", [0.2, 0.2]), disk("e", 0.1)];
    let place = |k: usize| if k % 3 == 2 { 3.0 * number(k as u64) } else { spread * number(k as u64) };
    let q = DVector::from_fn(3 * bodies.len(), |k, _| place(k));
    let v = DVector::from_fn(3 * bodies.len(), |k, _| number(100 + k as u64));
    (PlanarBodies::new("scattered", bodies, [0.0, -9.81], level(0.5)).expect("valid"), q, v)
}

#[test]
fn only_candidates_within_reach_are_listed_and_none_of_them_is_missing() {
    let mut listed = 0;
    for seed in 0..300 {
        let (mechanism, q, _) = scattered(seed, 1.0 + 0.01 * seed as f64);
        let all = mechanism.contacts(&q);
        assert_eq!(Some(all.len()), mechanism.most_candidates());
        for reach in [-0.1, 0.0, 0.05, 0.3] {
            let expected: Vec<Contact> = all.iter().filter(|contact| contact.gap <= reach).cloned().collect();
            assert_eq!(mechanism.contacts_within(&q, reach), expected, "{seed} at {reach}");
            assert_eq!(mechanism.count_within(&q, reach), expected.len());
            listed += expected.len();
        }
        for (first, second) in [(0, None), (2, None), (0, Some(1)), (1, Some(2)), (2, Some(4))] {
            let expected: Vec<Contact> =
                all.iter().filter(|one| one.place.is_some_and(|place| place.bodies == (first, second))).cloned().collect();
            assert_eq!(mechanism.contacts_between(&q, (first, second)), expected);
        }
    }
    assert!(listed > 5000, "{listed}");
}

#[test]
fn a_contact_beyond_the_reach_does_not_close_in_the_step() {
    let mut beyond = 0;
    for seed in 0..500 {
        let (mechanism, q, v) = scattered(seed, 1.5);
        for h in [0.03, 0.1, 0.3] {
            let reach = mechanism.reach(&v, h);
            for contact in mechanism.contacts(&q).iter().filter(|contact| contact.gap > reach) {
                let u = &contact.jacobian * &v;
                assert!(h * (u[0].abs() + 0.5 * u[1].abs()) < contact.gap, "{}", contact.label());
                beyond += 1;
            }
        }
    }
    let (mechanism, ..) = scattered(0, 1.0);
    assert!(beyond > 1000 && mechanism.reach(&DVector::from_element(15, 1e3), 1.0) == f64::INFINITY, "{beyond}");
}

#[test]
fn a_gap_is_at_least_the_distance_of_two_bodies_over_the_root_of_two() {
    let (mut compared, mut least) = (0, f64::INFINITY);
    for seed in 0..2000 {
        let (mechanism, q, _) = scattered(seed, 1.5);
        let distance = |first: usize, second: usize| {
            let radius = [0.4f64.hypot(0.1), 0.3f64.hypot(0.2), 0.25, 0.2f64.hypot(0.2), 0.1];
            (q[3 * first] - q[3 * second]).hypot(q[3 * first + 1] - q[3 * second + 1]) - radius[first] - radius[second]
        };
        for contact in mechanism.contacts(&q) {
            let (first, Some(second)) = contact.place.expect("bodies").bodies else { continue };
            let apart = distance(first, second);
            if apart > 0.0 {
                assert!(contact.gap >= apart / 2f64.sqrt() - rounding(64, 3.0), "{} {apart} at {seed}", contact.gap);
                (compared, least) = (compared + 1, least.min(contact.gap / apart));
            }
        }
    }
    assert!(compared > 3000 && least < 1.0, "{compared} compared, and the bound is needed: {least}");
}
