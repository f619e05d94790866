//! Where capsules and cylinders touch.
//!
//! ```text
//!     capsule     points within r of the segment x ± l a                      a = R ẑ
//!     cylinder    |a·(y − x)| ≤ l ,  ‖(1 − a aᵀ)(y − x)‖ ≤ r
//!
//!     plane       capsule:  φ = n·(x ± l a) − c − r
//!                 cylinder: φ = n·(x ± l a) − c − r ‖(1 − a aᵀ) n‖            the lowest point of either rim
//!     sphere      φ = distance of its centre from the segment, or from the cylinder, less the radii
//!     box         see `capsule_box`
//!     capsules    the ends of each as spheres at the other, and the inner points where the segments pass each other
//! ```
//! Cylinders at boxes, capsules and each other are in `cylinders`, what a pair with a box or a cylinder touches with in `manifold`.
//!
//! Every gap is a distance between features of the two bodies, extremal where a feature is curved or an edge: its derivative is
//! n · (v_first − v_second) at the two points. And every one is at least as large as the distance of the bodies: several
//! of one pair ask for nothing that the nearest does not.
//!
//! A cylinder that stands has no lowest point. It touches the plane in four points of each rim that turn with it, as long as its axis leans
//! by less than [`STANDING`]; one that leans more rolls on its lowest point, and a point of the rim that comes down beside it must not
//! brake it.

use super::shape::Pose;
use super::touch::{Touch, direction};
use crate::mechanics::Plane;
use crate::tolerance::mechanics::{PARALLEL, STANDING};
use nalgebra::Vector3;

/// A capsule, or a cylinder, with its pose.
#[derive(Clone, Copy)]
pub(super) struct Rod<'a> {
    /// r \[m\].
    pub radius: f64,
    /// l \[m\].
    pub half_height: f64,
    /// Where it is.
    pub pose: &'a Pose,
}

impl Rod<'_> {
    /// a.
    pub fn axis(&self) -> Vector3<f64> {
        self.pose.rotation.column(2).into()
    }

    /// x − l a and x + l a.
    pub fn ends(&self) -> [Vector3<f64>; 2] {
        [-1.0, 1.0].map(|side| self.pose.centre + self.axis() * (side * self.half_height))
    }

    /// The point of the segment nearest to a point, and whether it is between the ends.
    pub fn nearest(&self, point: &Vector3<f64>) -> (Vector3<f64>, bool) {
        let along = self.axis().dot(&(point - self.pose.centre));
        let within = along.clamp(-self.half_height, self.half_height);
        (self.pose.centre + self.axis() * within, along.abs() < self.half_height)
    }
}

/// A ball of each body: around the points a and b of two bodies with these radii.
fn balls([a, b]: [Vector3<f64>; 2], radii: [f64; 2], features: [u32; 2]) -> Touch {
    let (distance, normal) = direction(b, a);
    Touch::new(distance - radii[0] - radii[1], normal, [a - normal * radii[0], b + normal * radii[1]], features)
}

/// Both ends of a capsule over a plane.
pub(super) fn capsule_ground(capsule: Rod, ground: &Plane, touches: &mut Vec<Touch>) {
    let normal = Vector3::new(ground.normal[0], ground.normal[1], ground.normal[2]);
    for (side, end) in (0..).zip(capsule.ends()) {
        let point = end - normal * capsule.radius;
        touches.push(Touch::new(normal.dot(&point) - ground.offset, normal, [point, point], [side, 0]));
    }
}

/// The lowest points of both rims of a cylinder over a plane, and four points of each that turn with it where it stands.
pub(super) fn cylinder_ground(cylinder: Rod, ground: &Plane, touches: &mut Vec<Touch>) {
    let normal = Vector3::new(ground.normal[0], ground.normal[1], ground.normal[2]);
    let axis = cylinder.axis();
    let across = normal - axis * normal.dot(&axis);
    let leaning = across.norm();
    let mut push = |point: Vector3<f64>, feature: u32| {
        touches.push(Touch::new(normal.dot(&point) - ground.offset, normal, [point, point], [feature, 0]));
    };
    for (side, middle) in (0..).zip(cylinder.ends()) {
        if leaning > PARALLEL {
            push(middle - across * (cylinder.radius / leaning), side);
        }
        if leaning < STANDING {
            let [x, y] = [0, 1].map(|column| Vector3::from(cylinder.pose.rotation.column(column)) * cylinder.radius);
            (2..).zip([x, y, -x, -y]).for_each(|(k, out)| push(middle + out, 2 * k + side));
        }
    }
}

/// A sphere at a capsule.
pub(super) fn sphere_capsule(radius: f64, sphere: &Vector3<f64>, capsule: Rod) -> Touch {
    balls([*sphere, capsule.nearest(sphere).0], [radius, capsule.radius], [0, 0])
}

/// A sphere at a cylinder: outside, the nearest point counts; inside, that of the nearest face or of the side.
pub(super) fn sphere_cylinder(radius: f64, sphere: &Vector3<f64>, cylinder: Rod) -> Touch {
    let Rod { radius: r, half_height: l, pose } = cylinder;
    let centre = pose.body(*sphere);
    let out = centre.x.hypot(centre.y);
    let outward = if out > 0.0 { Vector3::new(centre.x / out, centre.y / out, 0.0) } else { Vector3::x() };
    let nearest = Vector3::new(outward.x * out.min(r), outward.y * out.min(r), centre.z.clamp(-l, l));
    let inside = out <= r && centre.z.abs() <= l;
    let (distance, normal, on_cylinder) = if !inside {
        let (distance, normal) = direction(pose.world(nearest), *sphere);
        (distance, normal, nearest)
    } else if r - out < l - centre.z.abs() {
        (out - r, pose.rotation * outward, Vector3::new(outward.x * r, outward.y * r, centre.z))
    } else {
        let up = if centre.z < 0.0 { -1.0 } else { 1.0 };
        (centre.z.abs() - l, pose.rotation.column(2) * up, Vector3::new(centre.x, centre.y, up * l))
    };
    Touch::new(distance - radius, normal, [sphere - normal * radius, pose.world(on_cylinder)], [0, 0])
}

/// Two capsules.
pub(super) fn capsules(first: Rod, second: Rod, touches: &mut Vec<Touch>) {
    let radii = [first.radius, second.radius];
    for (side, end) in (0..).zip(first.ends()) {
        touches.push(balls([end, second.nearest(&end).0], radii, [side, 2]));
    }
    for (side, end) in (0..).zip(second.ends()) {
        let (middle, inner) = first.nearest(&end);
        // at an end of the first one it is found already
        if inner {
            touches.push(balls([middle, end], radii, [2, side]));
        }
    }
    if let Some([a, b]) = crossing(first.ends(), second.ends()) {
        touches.push(balls([a, b], radii, [2, 2]));
    }
}

/// The nearest points of two segments, if both are between the ends and the segments are not parallel.
pub(super) fn crossing([a, b]: [Vector3<f64>; 2], [c, d]: [Vector3<f64>; 2]) -> Option<[Vector3<f64>; 2]> {
    let (u, w, line) = (b - a, d - c, a - c);
    let (uu, uw, ww) = (u.norm_squared(), u.dot(&w), w.norm_squared());
    let sine = uu * ww - uw * uw;
    if sine <= PARALLEL * PARALLEL * uu * ww {
        return None;
    }
    let s = (uw * w.dot(&line) - ww * u.dot(&line)) / sine;
    let t = (uu * w.dot(&line) - uw * u.dot(&line)) / sine;
    let within = |x: f64| x > 0.0 && x < 1.0;
    (within(s) && within(t)).then(|| [a + u * s, c + w * t])
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Numbers, between, configuration, cuboid};
    use super::super::{Shape, SpatialBodies, SpatialBody};
    use crate::mechanics::{Mechanism, Plane};
    use crate::tolerance::mechanics::{DIFFERENCE_STEP, central_difference};
    use moreau_contact::contact::Contact;
    use moreau_exact::tolerance::rounding;
    use nalgebra::{DVector, dvector};

    fn capsule(name: &str, radius: f64, half_height: f64) -> SpatialBody {
        SpatialBody::solid(name, Shape::Capsule { radius, half_height }, 2.0).expect("valid")
    }

    fn cylinder(name: &str) -> SpatialBody {
        SpatialBody::solid(name, Shape::Cylinder { radius: 0.3, half_height: 0.5 }, 2.0).expect("valid")
    }

    fn ball(radius: f64) -> SpatialBody {
        SpatialBody::solid("ball", Shape::Sphere { radius }, 1.0).expect("valid")
    }

    fn over_floor(bodies: Vec<SpatialBody>) -> SpatialBodies {
        let floor = Plane::new(dvector![0.0, 0.0, 1.0], 0.0, 0.5, 0.0).expect("a unit normal");
        SpatialBodies::new("round", bodies, [0.0, 0.0, -9.81], floor).expect("valid")
    }

    fn least(contacts: &[Contact]) -> f64 {
        contacts.iter().map(|contact| contact.gap).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn gaps_change_as_the_rows_say_for_every_pair_and_on_the_ground() {
        let pairs = [
            over_floor(vec![capsule("a", 0.2, 0.5), capsule("b", 0.3, 0.4)]),
            over_floor(vec![capsule("a", 0.2, 0.5), cuboid("b", [0.4, 0.3, 0.5])]),
            over_floor(vec![cuboid("a", [0.4, 0.3, 0.5]), capsule("b", 0.2, 0.5)]),
            over_floor(vec![ball(0.2), capsule("b", 0.2, 0.5)]),
            over_floor(vec![ball(0.2), cylinder("b")]),
            over_floor(vec![cylinder("a"), ball(0.2)]),
        ];
        let (mut numbers, h) = (Numbers(7), DIFFERENCE_STEP);
        for mechanism in &pairs {
            let mut compared = 0;
            for _ in 0..300 {
                let mut place = |height: f64| {
                    [numbers.next(), numbers.next(), height + 0.3 * numbers.next(), numbers.next() * 3.0, numbers.next(), 0.4]
                };
                let q = configuration(&[place(1.2), place(0.0)]);
                let v = DVector::from_fn(12, |_, _| numbers.next());
                let [after, before] = [h, -h].map(|h| mechanism.contacts(&mechanism.integrate(&q, &v, h)));
                for contact in mechanism.contacts(&q).into_iter().filter(|contact| contact.gap > 0.0) {
                    let place = contact.place.expect("bodies have places");
                    let same = |list: &[Contact]| {
                        list.iter().find(|other| other.place.is_some_and(|other| other.is_same(&place))).map(|found| found.gap)
                    };
                    let (Some(after), Some(before)) = (same(&after), same(&before)) else { continue };
                    let (measured, rate) = ((after - before) / (2.0 * h), (&contact.jacobian * &v)[0]);
                    // distances from 0.2 m on; where a nearest feature is left between the two, a gap has a kink
                    let curvature = 1.0 / (contact.gap.abs() + 0.2).powi(3);
                    // and where the nearest point passes from a side to an end the curvature, 1/0.2 m at most, jumps
                    let jump = 8.0 * h * v.norm_squared() / 0.2;
                    let bound = jump + 16.0 * curvature * central_difference(v.norm(), 2.0);
                    compared += usize::from((measured - rate).abs() <= bound);
                    assert!(
                        (measured - rate).abs() <= bound || (measured - rate).abs() <= v.norm() && kinked(mechanism, &q, &v, &contact),
                        "{}: {measured} against {rate} ± {bound}, gap {}",
                        contact.label(),
                        contact.gap
                    );
                }
            }
            assert!(compared > 300, "only {compared} candidates kept their features");
        }
    }

    /// Whether a gap has another rate before and after: a kink, where a nearest feature changes.
    fn kinked(mechanism: &SpatialBodies, q: &DVector<f64>, v: &DVector<f64>, contact: &Contact) -> bool {
        let h = DIFFERENCE_STEP;
        let rate = |sign: f64| {
            let there = mechanism.contacts(&mechanism.integrate(q, v, sign * h));
            let place = contact.place.expect("bodies have places");
            let found = there.iter().find(|other| other.place.is_some_and(|other| other.is_same(&place)));
            found.map_or(f64::NAN, |found| (&found.jacobian * v)[0])
        };
        (rate(1.0) - rate(-1.0)).abs() > 64.0 * h
    }

    #[test]
    fn a_lying_rod_touches_along_a_line_and_a_standing_cylinder_on_its_face() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let lying = [0.0, 0.0, 0.3, 0.0, quarter, 0.0];
        for body in [capsule("rod", 0.3, 0.5), cylinder("rod")] {
            let bodies = over_floor(vec![body]);
            let touching: Vec<_> =
                bodies.contacts(&configuration(&[lying])).into_iter().filter(|one| one.gap.abs() <= rounding(16, 1.0)).collect();
            assert_eq!(touching.len(), 2, "both ends of the line");
            // spin about the own axis z moves neither point up: rolling is free
            let spin = dvector![0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
            assert!(touching.iter().all(|one| (&one.jacobian * &spin)[0].abs() <= rounding(16, 1.0)));
        }
        let standing = over_floor(vec![cylinder("rod")]).contacts(&configuration(&[[0.0, 0.0, 0.5, 0.0, 0.0, 0.3]]));
        assert_eq!(standing.iter().filter(|one| one.gap.abs() <= rounding(16, 1.0)).count(), 4, "four points of the lower rim");
        let leaning = over_floor(vec![cylinder("rod")]).contacts(&configuration(&[[0.0, 0.0, 0.6, 0.3, 0.0, 0.0]]));
        assert!((least(&leaning) - (0.6 - 0.5 * 0.3f64.cos() - 0.3 * 0.3f64.sin())).abs() <= rounding(16, 1.0));
        assert_eq!(leaning.len(), 2, "the lowest point of either rim");
    }

    #[test]
    fn gaps_of_pairs_are_the_distances_that_one_sees() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let at = |places: &[[f64; 6]], bodies: Vec<SpatialBody>| between(&over_floor(bodies), &configuration(places));
        // crossed at right angles, 1 m between the axes
        let crossed = at(
            &[[0.0, 0.0, 3.0, 0.0, quarter, 0.0], [0.0, 0.0, 2.0, quarter, 0.0, 0.0]],
            vec![capsule("a", 0.2, 0.5), capsule("b", 0.3, 0.5)],
        );
        assert!((least(&crossed) - 0.5).abs() <= rounding(16, 3.0));
        // parallel on top of each other: two points, at the ends of the shorter one
        let lying = [0.0, quarter, 0.0];
        let place = |height: f64| [0.0, 0.0, height, lying[0], lying[1], lying[2]];
        let parallel = at(&[place(3.0), place(2.5)], vec![capsule("a", 0.2, 0.3), capsule("b", 0.3, 0.5)]);
        assert_eq!(parallel.iter().filter(|one| one.gap.abs() <= rounding(16, 3.0)).count(), 2);
        // a capsule across a box that is narrower than the capsule is long rests on the two upper edges
        let across = at(&[place(2.7), [0.0, 0.0, 2.0, 0.0, 0.0, 0.0]], vec![capsule("a", 0.2, 0.6), cuboid("b", [0.3, 0.3, 0.5])]);
        assert_eq!(across.iter().filter(|one| one.gap.abs() <= rounding(64, 3.0)).count(), 2, "{across:?}");
        // a ball beside, above and in a cylinder
        for (place, gap) in [([0.6, 0.0, 2.0], 0.2), ([0.0, 0.1, 2.7], 0.1), ([0.25, 0.0, 2.0], -0.15), ([0.0, 0.0, 2.45], -0.15)] {
            let [x, y, z] = place;
            let found = at(&[[x, y, z, 0.0, 0.0, 0.0], [0.0, 0.0, 2.0, 0.0, 0.0, 0.0]], vec![ball(0.1), cylinder("b")]);
            assert!((found[0].gap - gap).abs() <= rounding(16, 3.0), "{place:?}: {}", found[0].gap);
        }
    }

    #[test]
    fn moments_of_the_solids_are_those_of_thin_slices() {
        // ∫ over slices at the height z: dm (ρ²/2 about z, ρ²/4 + z² across)
        for shape in [Shape::Capsule { radius: 0.3, half_height: 0.5 }, Shape::Cylinder { radius: 0.3, half_height: 0.5 }] {
            let (slices, top) = (100_000, if matches!(shape, Shape::Capsule { .. }) { 0.8 } else { 0.5 });
            let (mut mass, mut about, mut across) = (0.0, 0.0, 0.0);
            for k in 0..slices {
                let z = top * (f64::from(k) + 0.5) / f64::from(slices);
                let square = if z <= 0.5 { 0.09 } else { 0.09 - (z - 0.5) * (z - 0.5) };
                mass += square;
                about += square * square / 2.0;
                across += square * (square / 4.0 + z * z);
            }
            let [x, y, z] = shape.solid_moments(2.0);
            let slack = 1.0 / f64::from(slices);
            assert!((z - 2.0 * about / mass).abs() <= slack && (x - 2.0 * across / mass).abs() <= slack && x == y, "{shape:?}");
        }
    }
}
