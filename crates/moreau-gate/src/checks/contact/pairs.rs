//! Whether the impulses reported between two bodies are those that moved both, over one step and over several.
//!
//! ```text
//!     m_b Δv_b = m_b g Δt + Σ p      p on the body named first, −p on the other, summed over all steps of the interval
//!     p·n ≥ 0                        n to the body named first
//! ```

use crate::checks::motion::CLEARANCE;
use crate::checks::scenery::{GRAVITY, cuboid, over_floor, sphere, worst};
use crate::model::Model;
use crate::tolerance::{audit_rounding, contact as tolerance};
use crate::{Bench, Expectation, Measurement, Refusal, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use moreau_dynamics::trajectory::{ContactRecord, Trajectory};
use nalgebra::Vector3;

/// Steps of every motion, a multiple of both intervals.
const STEPS: usize = 42;
/// Steps between samples.
const INTERVALS: [usize; 2] = [1, 7];
const FRICTION: f64 = 0.3;
const RADIUS: f64 = 0.1;
/// Speed \[m/s\] with which bodies meet, at least.
const APPROACH: f64 = 0.5;
/// The bodies of each pair, by their place in the scene.
const PAIRS: [(&str, [usize; 2]); 2] = [("ball on a plate", [0, 1]), ("two spheres", [2, 3])];

/// A ball that lands and slides on a plate that lies on the floor, and two spheres that meet obliquely high above; the first touch comes
/// with the first steps, whatever h, and the ball stays on its plate.
fn meeting() -> Scene {
    let plate = cuboid("plate", 2.0, [1.0, 1.0, 0.1], [0.0, 0.0, 0.1 + CLEARANCE]);
    let ball = sphere("ball", 1.0, RADIUS, [0.0, 0.0, 0.2 + RADIUS + 2.0 * CLEARANCE]);
    let ball = Body { linear_velocity: [0.5, 0.25, -0.5], ..ball };
    let second = sphere("second", 3.0, RADIUS, [5.0, 0.0, 20.0]);
    let first = sphere("first", 1.0, RADIUS, [5.0 - 2.0 * RADIUS - CLEARANCE, 0.0, 20.0]);
    let first = Body { linear_velocity: [2.0, 1.0, 0.5], ..first };
    over_floor("pairs that meet", vec![ball, plate, first, second], FRICTION)
}

pub(super) fn pairs(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    if !bench.description().reports_contacts {
        return Err(Refusal::unsupported("the engine does not report contact impulses"));
    }
    let scene = meeting();
    let mut measured = Vec::new();
    for every in INTERVALS {
        let motion = bench.simulate(&scene, h, STEPS, every)?;
        let interval = every as f64 * h;
        for (words, pair) in PAIRS {
            let account = Account { scene: &scene, motion: &motion, interval, pair, words, every };
            measured.push(unaccounted(bench, &account)?);
            if every == 1 {
                measured.push(account.pulled());
            }
        }
    }
    Ok(measured)
}

/// What a pair of bodies did in one motion.
struct Account<'a> {
    scene: &'a Scene,
    motion: &'a Trajectory,
    /// Δt \[s\].
    interval: f64,
    pair: [usize; 2],
    words: &'a str,
    every: usize,
}

impl Account<'_> {
    /// Σ p and Σ‖p‖ \[N·s\] of a body in the interval that ends at a sample.
    fn reported(&self, body: usize, sample: usize) -> (Vector3<f64>, f64) {
        let name = &self.scene.bodies[body].name;
        let mut sums = (Vector3::zeros(), 0.0);
        for record in self.motion.contacts.iter().filter(|record| record.sample == sample) {
            for (_, sign) in record.bodies.iter().zip([1.0, -1.0]).filter(|(named, _)| *named == name) {
                let impulse = Vector3::from(record.impulse);
                sums = (sums.0 + impulse * sign, sums.1 + impulse.norm());
            }
        }
        sums
    }

    /// m Δv − m g Δt \[N·s\] of a body in that interval.
    fn moved(&self, body: usize, sample: usize) -> Vector3<f64> {
        let [before, after] = [sample - 1, sample].map(|k| self.velocity(body, k));
        (after - before + Vector3::z() * (GRAVITY * self.interval)) * self.scene.bodies[body].mass
    }

    /// Largest −p·n of a record over the largest ‖p‖ between both bodies.
    fn pulled(&self) -> Measurement {
        let names = self.pair.map(|body| &self.scene.bodies[body].name);
        let between: Vec<_> = self.motion.contacts.iter().filter(|one| one.bodies.iter().all(|name| names.contains(&name))).collect();
        let impulse = |record: &ContactRecord| Vector3::from(record.impulse);
        let most = between.iter().map(|record| impulse(record).norm()).fold(0.0, worst);
        let pulled = between.iter().map(|record| -impulse(record).dot(&Vector3::from(record.normal))).fold(0.0, worst);
        let ideal =
            Expectation::at_most(0.0, tolerance::impulse(), "contacts push along the reported normal, which points to the first body");
        let value = if most > 0.0 { pulled / most } else { 0.0 };
        Measurement::new(format!("impulse against the reported normal over the largest impulse ({})", self.words), "1", value, ideal)
    }

    fn velocity(&self, body: usize, sample: usize) -> Vector3<f64> {
        self.motion.bodies[body].linear_velocity[sample].into()
    }
}

fn unaccounted(bench: &Bench, account: &Account) -> Reply<Measurement> {
    let (linear, _) = Model::of(bench.description()).damping().unwrap_or_default();
    let (mut largest, mut rounded, mut damped, mut met) = (0.0, 0.0, 0.0, false);
    for body in account.pair {
        let mass = account.scene.bodies[body].mass;
        let weight = mass * GRAVITY * account.interval;
        for sample in 1..account.motion.times.len() {
            let moved = account.moved(body, sample);
            let (sum, size) = account.reported(body, sample);
            let scale = size + moved.norm() + weight;
            let speed = [sample - 1, sample].map(|k| account.velocity(body, k).norm()).into_iter().fold(0.0, f64::max);
            largest = worst((moved - sum).norm() / scale, largest);
            rounded = worst(audit_rounding(bench.epsilon(), mass * speed) / scale, rounded);
            // damping acts on what is faster in the interval than at its ends by the fall in it at most
            damped = worst(linear * account.interval * (mass * speed + weight) / scale, damped);
            met |= body == account.pair[0] && moved.norm() > 0.5 * weight.min(mass * APPROACH);
        }
    }
    if !met {
        return Err(Refusal::errored(format!("{}: the bodies met, and neither was moved", account.words)));
    }
    let allowed = tolerance::impulse() + rounded;
    let ideal = Expectation::at_most(0.0, allowed, "m Δv = m g Δt + Σ p for both bodies, with opposite p");
    let model = (linear > 0.0).then(|| Expectation::at_most(damped, allowed, "the declared damping of the bodies' speeds"));
    let quantity = format!("unaccounted momentum over impulse ({}, samples every {} steps)", account.words, account.every);
    Ok(Measurement::new(quantity, "1", largest, ideal).predicted(model))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{Reporting, measure};

    #[test]
    fn one_wrong_report_is_seen_wherever_it_stands() {
        for (sample, expected) in [(0, Verdict::Pass), (1, Verdict::Fail), (3, Verdict::Fail), (STEPS, Verdict::Fail)] {
            let mut engine = Reporting(|motion: &mut Trajectory| {
                let here = motion.contacts.iter_mut().filter(|one| one.sample == sample && one.bodies[1] != "ground");
                here.for_each(|one| one.impulse = one.impulse.map(|part| 2.0 * part));
            });
            let measured = measure("contact/pairs", 0.004, &mut engine);
            assert_eq!(measured.iter().map(Measurement::verdict).max(), Some(expected), "at sample {sample}");
        }
    }
}
