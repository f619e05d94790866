//! A body thrown onto the floor, with the impulses it reports.

use crate::checks::motion::{Sample, samples};
use crate::checks::scenery::{over_floor, sphere};
use crate::{Bench, Refusal, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::ContactRecord;
use nalgebra::Vector3;

pub(super) const RADIUS: f64 = 0.1;
pub(super) const FRICTION: f64 = 0.3;
/// m W_t of a solid sphere.
pub(super) const RESPONSE: f64 = crate::model::sliding::SPHERE;
/// Speeds of the thrown sphere \[m/s\]: along the floor at 36.9° to x, and down.
pub(super) const ALONG: f64 = 4.0;
pub(super) const DOWN: f64 = 2.0;

/// Steps of a motion in which every rule of activation has a contact: one that looks for it where the step begins has none in the step
/// in which bodies meet, and that may be the second.
const SURE: usize = 3;

/// A motion, sampled at every step.
pub(super) struct Thrown {
    /// The states after 0, 1, … steps.
    pub states: Vec<Sample>,
    /// Records of each interval, the first (which ends at t = 0) empty.
    pub records: Vec<Vec<ContactRecord>>,
    /// The largest normal impulse \[N·s\].
    pub largest: f64,
    /// m \[kg\].
    pub mass: f64,
}

impl Thrown {
    /// The sum of an interval's impulses \[N·s\].
    pub fn impulse(&self, k: usize) -> Vector3<f64> {
        self.records[k].iter().map(|record| Vector3::from(record.impulse)).sum()
    }

    /// Velocity \[m/s\] of a sphere's lowest point.
    pub fn contact_velocity(&self, k: usize) -> Vector3<f64> {
        self.states[k].velocity_at(Vector3::new(0.0, 0.0, -RADIUS))
    }

    /// The largest angle \[rad\] between the slip of the sphere's lowest point and that of a point where the impulse of step k may act: on
    /// the floor, at the gap or depth before the step or after it, or anywhere between.
    pub fn slip_turned(&self, k: usize) -> f64 {
        let slip = |lever: f64| self.states[k].velocity_at(Vector3::new(0.0, 0.0, -lever)).xy();
        let own = slip(RADIUS);
        let angle = |gap: f64| own.perp(&slip(RADIUS + gap)).abs().atan2(own.dot(&slip(RADIUS + gap)));
        angle(self.gap(k - 1)).max(angle(self.gap(k)))
    }

    /// Gap \[m\] of a sphere.
    pub fn gap(&self, k: usize) -> f64 {
        self.states[k].position.z - RADIUS
    }

    /// Intervals in which a normal impulse above the solver's accuracy acted.
    pub fn touching(&self) -> impl Iterator<Item = usize> {
        let least = crate::tolerance::SOLVED * self.largest;
        (1..self.states.len()).filter(move |&k| self.impulse(k).z > least)
    }
}

/// A sphere that lands on the floor and slides: it slips until the end, 0.1 s.
pub(super) fn thrown_sphere(bench: &mut Bench, h: f64) -> Reply<Thrown> {
    let mut ball = sphere("ball", 1.0, RADIUS, [0.0, 0.0, RADIUS + 0.02]);
    ball.linear_velocity = [0.8 * ALONG, 0.6 * ALONG, -DOWN];
    motion(bench, &over_floor("thrown sphere", vec![ball], FRICTION), h, 0.1)
}

/// The motion of a scene's only body over about `duration` \[s\].
pub(super) fn motion(bench: &mut Bench, scene: &Scene, h: f64, duration: f64) -> Reply<Thrown> {
    if !bench.description().reports_contacts {
        return Err(Refusal::unsupported("the engine does not report contact impulses"));
    }
    let steps = (duration / h).round() as usize;
    let trajectory = bench.simulate(scene, h, steps, 1)?;
    let mut records = vec![Vec::new(); steps + 1];
    for record in trajectory.contacts {
        records[record.sample].push(record);
    }
    let mut thrown = Thrown { states: samples(&trajectory.bodies[0]), records, largest: 0.0, mass: scene.bodies[0].mass };
    thrown.largest = (1..=steps).map(|k| thrown.impulse(k).z).fold(0.0, f64::max);
    if thrown.largest > 0.0 {
        Ok(thrown)
    } else if steps < SURE {
        let reason = "the motion is over in two steps of this length, and a contact may act from the third on; take shorter ones";
        Err(Refusal::unsupported(reason))
    } else {
        Err(Refusal::errored("the body fell on the floor and no impulse was reported"))
    }
}
