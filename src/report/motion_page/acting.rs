//! What acted on the bodies over some steps: the impulses of every contact, added up, and the point where it acted last.

use super::super::motion::MotionReport;
use crate::contact::Place;
use crate::mechanics::contact_point;
use std::collections::BTreeMap;
use std::ops::Range;

/// Bodies and features of a contact: the same in every step.
type Key = ((usize, Option<usize>), [u32; 2]);

/// The impulses of one contact over some steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Acting {
    /// The first and the second body; `None` is the ground.
    pub bodies: (usize, Option<usize>),
    /// Where it acted last \[m\]: at the end of that step, or at its start where the two have parted by its end. The centre of the first
    /// body where neither configuration has the contact.
    pub point: [f64; 3],
    /// Σ r on the first body, in the world \[N·s\].
    pub impulse: [f64; 3],
    /// Σ r_n n \[N·s\].
    along: [f64; 3],
    /// Σ r_n \[N·s\].
    normal: f64,
}

impl Acting {
    /// Σ r_n and ‖Σ r_t‖ \[N·s\].
    pub fn sizes(&self) -> [f64; 2] {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|axis| self.impulse[axis] - self.along[axis]);
        [self.normal, x.hypot(y).hypot(z)]
    }

    fn add(&mut self, place: &Place, impulse: &[f64]) {
        let total = place.world_impulse(impulse);
        self.normal += impulse[0];
        for (axis, part) in total.into_iter().enumerate() {
            self.impulse[axis] += part;
            self.along[axis] += impulse[0] * place.frame[0][axis];
        }
    }
}

/// The contacts that acted in these steps, by bodies and features. What has no place is not known to a page.
pub fn acting(motion: &MotionReport, steps: Range<usize>) -> Vec<Acting> {
    let mut found: BTreeMap<Key, (Acting, usize)> = BTreeMap::new();
    for step in steps {
        for one in &motion.recording.impulses[step] {
            let Some(place) = one.place.filter(|_| one.impulse.iter().any(|part| *part != 0.0)) else { continue };
            let none = Acting { bodies: place.bodies, point: [0.0; 3], impulse: [0.0; 3], along: [0.0; 3], normal: 0.0 };
            let (acting, last) = found.entry((place.bodies, place.features)).or_insert((none, step));
            acting.add(&place, &one.impulse);
            *last = step;
        }
    }
    let mut at: BTreeMap<usize, BTreeMap<Key, [f64; 3]>> = BTreeMap::new();
    let mut acting = Vec::with_capacity(found.len());
    for (key, (mut one, last)) in found {
        let mut point = |sample: usize| at.entry(sample).or_insert_with(|| points(motion, sample)).get(&key).copied();
        one.point = point(last + 1).or_else(|| point(last)).unwrap_or_else(|| centre(motion, last + 1, key.0.0));
        acting.push(one);
    }
    acting
}

/// The points of the contacts of a sample that may touch.
fn points(motion: &MotionReport, sample: usize) -> BTreeMap<Key, [f64; 3]> {
    let (mechanism, state) = (motion.mechanism, &motion.recording.samples[sample]);
    let bodies = mechanism.bodies(&state.position, &state.velocity);
    let reach = mechanism.reach(&state.velocity, motion.recording.time_step);
    let point = |contact: &crate::contact::Contact| {
        let place = contact.place?;
        Some(((place.bodies, place.features), contact_point(contact, &bodies)?))
    };
    mechanism.contacts_within(&state.position, reach).iter().filter_map(point).collect()
}

fn centre(motion: &MotionReport, sample: usize, body: usize) -> [f64; 3] {
    let state = &motion.recording.samples[sample];
    motion.mechanism.bodies(&state.position, &state.velocity).get(body).map_or([0.0; 3], |body| body.position)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::named;
    use crate::schemes::{MoreauJean, simulate};
    use crate::solvers::Auto;
    use crate::tolerance::rounding;

    #[test]
    fn a_sliding_block_is_carried_at_its_lower_corners_and_braked_by_friction() {
        let scene = named("incline-slide").expect("built in");
        let (mechanism, start) = scene.spatial_mechanism().expect("a block in space");
        let recording = simulate(&MoreauJean::default(), &Auto, mechanism.as_ref(), start, 0.01, 20).expect("a solvable scene");
        let motion = MotionReport { mechanism: mechanism.as_ref(), recording: &recording, exact: None, gravity: 9.81 };
        let acting = acting(&motion, 10..20);
        let total = |part: fn(&Acting) -> f64| acting.iter().map(part).sum::<f64>();
        let (normal, tangential) = (total(|one| one.sizes()[0]), total(|one| one.sizes()[1]));
        // m g cos α over a tenth of a second, and μ = 0.3 of it
        let weight = 9.81 * 20f64.to_radians().cos() * 0.1;
        let off = [normal - weight, tangential - 0.3 * weight];
        assert!(off.iter().all(|off| off.abs() <= 1e-8 * weight), "{off:?}");
        let gaps: Vec<f64> = mechanism.contacts(&recording.last().position).iter().map(|contact| contact.gap).collect();
        let [sine, cosine] = [20f64.to_radians().sin(), 20f64.to_radians().cos()];
        for one in &acting {
            let height = one.point[0] * sine + one.point[2] * cosine;
            // as deep as the mechanism says that a corner is
            let near = gaps.iter().any(|gap| (gap - height).abs() <= rounding(1000, 1.0));
            assert!(near && one.point[1].abs() > 0.09, "{one:?} at {height}, {gaps:?}");
        }
    }

    #[test]
    fn a_ball_in_flight_is_touched_by_nothing_and_one_that_bounces_at_its_lowest_point() {
        let scene = named("bouncing-ball").expect("built in");
        let (mechanism, start) = scene.mechanism().expect("planar");
        let recording = simulate(&MoreauJean::default(), &Auto, mechanism.as_ref(), start, 0.01, 60).expect("a solvable scene");
        let motion = MotionReport { mechanism: mechanism.as_ref(), recording: &recording, exact: None, gravity: 9.81 };
        assert_eq!(acting(&motion, 0..20), []);
        let bounce = acting(&motion, 20..60);
        assert_eq!(bounce.len(), 1);
        let [before, after] = [20, 60].map(|sample| recording.samples[sample].velocity[1]);
        let change = after - before + 9.81 * 0.4;
        assert!((bounce[0].sizes()[0] - change).abs() <= rounding(1000, 10.0), "{bounce:?}");
        let step = recording.impulses.iter().rposition(|all| all.iter().any(|one| one.impulse[0] != 0.0)).expect("it bounces");
        assert!((bounce[0].point[2] - (recording.samples[step + 1].position[1] - 0.1)).abs() <= rounding(16, 1.0), "{bounce:?}");
    }
}
