//! Impacts and apexes of a sampled ball.

use crate::checks::ball::scene::{RADIUS, dropped};
use crate::checks::scenery::{GRAVITY, between, schedule};
use crate::model::Model;
use crate::model::damping::apex;
use crate::tolerance::ball as tolerance;
use crate::tolerance::flight::damped_position;
use crate::{Bench, Expectation, Measurement, Refusal, Reply};
use moreau_dynamics::trajectory::Trajectory;
use moreau_forms::BouncingBall;

/// Height of the drop \[m\]: high enough that g h ≪ v at the first impacts for h = 1/60 s.
pub(super) const HEIGHT: f64 = 5.0;

/// Samples per second, where the steps are that small.
const SAMPLES: f64 = 1000.0;

/// Gap \[m\] and normal velocity \[m/s\] at samples s \[s\] apart.
pub(super) struct Samples {
    pub states: Vec<(f64, f64)>,
    pub spacing: f64,
}

impl Samples {
    /// The samples of the first body of a trajectory, which is a ball over the floor z = 0.
    pub(super) fn of(trajectory: &Trajectory, spacing: f64) -> Self {
        let track = &trajectory.bodies[0];
        let states = track.position.iter().zip(&track.linear_velocity).map(|(x, v)| (x[2] - RADIUS, v[2])).collect();
        Samples { states, spacing }
    }

    /// (last sample before, first sample after) of every impact: a run of samples in which a falling ball's velocity rises.
    pub(super) fn impacts(&self) -> Vec<(usize, usize)> {
        let velocity = |k: usize| self.states[k].1;
        let rises = |k: usize| k + 1 < self.states.len() && velocity(k + 1) > velocity(k);
        let mut found = Vec::new();
        let mut k = 0;
        while k + 1 < self.states.len() {
            let before = k;
            while rises(k) {
                k += 1;
            }
            if k == before {
                k += 1;
            } else if velocity(before) < 0.0 {
                found.push((before, k));
            }
        }
        found
    }

    /// The speed at the floor of a ball in flight at sample k, within one sample of it: min(|v| + g s, √(v² + 2 g gap)).
    fn speed_at_floor(&self, k: usize) -> f64 {
        let (gap, velocity) = self.states[k];
        let fallen = (velocity * velocity + 2.0 * GRAVITY * gap.max(0.0)).sqrt();
        fallen.min(velocity.abs() + GRAVITY * self.spacing)
    }

    /// (speed before, v⁺/v⁻) of the first `count` impacts; an impact that is missing returned nothing.
    fn restitutions(&self, count: usize) -> Vec<(f64, f64)> {
        let impacts = self.impacts();
        let one = |k: usize| match impacts.get(k) {
            // A ball that does not leave the floor is not in flight: nothing is carried anywhere.
            Some(&(before, after)) if self.states[after].1 > 0.0 => {
                let speed = self.speed_at_floor(before);
                (speed, self.speed_at_floor(after) / speed)
            }
            Some(&(before, _)) => (self.speed_at_floor(before), 0.0),
            None => (0.0, 0.0),
        };
        (0..count).map(one).collect()
    }

    /// Height of the apex, gap + v²/2g \[m\], of the drop and of the flights after the first `count` impacts; 0 for a flight that is
    /// missing.
    fn apexes(&self, count: usize) -> Vec<f64> {
        let impacts = self.impacts();
        let flight = |k: usize| {
            let start = if k == 0 { Some(0) } else { impacts.get(k - 1).map(|impact| impact.1) };
            let end = impacts.get(k).map_or(self.states.len() - 1, |impact| impact.0);
            let slowest = (start?..=end).min_by(|i, j| self.states[*i].1.abs().total_cmp(&self.states[*j].1.abs()))?;
            let (gap, velocity) = self.states[slowest];
            Some(gap + velocity * velocity / (2.0 * GRAVITY))
        };
        (0..=count).map(|k| flight(k).unwrap_or(0.0)).collect()
    }
}

/// A second height \[m\]: whether an engine finds a contact in the step that closes it depends on where the ball comes from. Rapier
/// 0.35.0-beta.0 lost the restitution of contacts that it found before (rapier#974 reports it from here).
const LOWER: f64 = 2.0;

/// Drops the ball and samples it for `duration` first falls t₁.
fn drop(bench: &mut Bench, height: f64, restitution: f64, falls: f64, h: f64) -> Reply<(Samples, BouncingBall)> {
    let ball = BouncingBall::new(GRAVITY, height, restitution).map_err(Refusal::errored)?;
    let duration = falls * ball.first_impact_time();
    let (steps, every) = schedule(duration, (duration * SAMPLES) as usize, h);
    let trajectory = bench.simulate(&dropped(height, restitution), h, steps, every)?;
    Ok((Samples::of(&trajectory, every as f64 * h), ball))
}

/// `ball/restitution`: (height, e, impacts, duration in first falls); t_k/t₁ = 1 + 2(e + … + e^{k−1}).
pub(super) fn restitution(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let mut measured = Vec::new();
    for (height, restitution, impacts, falls) in [(HEIGHT, 0.5, 3, 2.7), (HEIGHT, 0.9, 1, 2.0), (HEIGHT, 1.0, 2, 4.0), (LOWER, 0.5, 1, 1.9)]
    {
        let (samples, ball) = drop(bench, height, restitution, falls, h)?;
        for (k, (_, found)) in samples.restitutions(impacts).into_iter().enumerate() {
            let allowed = tolerance::restitution(restitution, ball.impact_speed(k + 1), GRAVITY, h, samples.spacing);
            let quantity = format!("e = {restitution} from {height} m, impact {}: v+/v-", k + 1);
            let ideal = Expectation::equal(restitution, allowed, "g (s + 2h) of each velocity");
            let law = pushed(bench, h, ball.impact_speed(k + 1)).map(|push| {
                let returned = restitution + push;
                // A ball that comes back faster than e bounces later; it may be in the air at the end.
                let time = 1.0 + 2.0 * (1..=k).map(|bounce| returned.powi(bounce as i32)).sum::<f64>();
                let least = if time < falls { restitution } else { 0.0 };
                between([least, returned], allowed, "a declared part of a depth of up to v h is taken back")
            });
            measured.push(Measurement::new(quantity, "1", found, ideal).predicted(law));
        }
    }
    Ok(measured)
}

/// What a declared error reduction adds at most to v⁺/v⁻ of an impact at this speed \[m/s\], which is found at a depth of up to v h.
pub(super) fn pushed(bench: &Bench, h: f64, speed: f64) -> Option<f64> {
    match Model::of(bench.description()) {
        Model::Coulomb(limits) if limits.error_reduction > 0.0 => Some(limits.push(speed * h, h) / speed),
        _ => None,
    }
}

/// How far \[m\] a declared correction of the position lifts a ball that arrives at this speed \[m/s\].
fn raised(bench: &Bench, speed: f64, h: f64) -> f64 {
    match Model::of(bench.description()) {
        Model::Coulomb(limits) => limits.position_correction * tolerance::depth(speed, GRAVITY, h),
        _ => 0.0,
    }
}

/// `ball/energy`.
pub(super) fn energy(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let (damped, ball) = drop(bench, HEIGHT, 0.5, 1.9, h)?;
    let speed = ball.impact_speed(1);
    let kept = damped.apexes(1)[1] / HEIGHT;
    let (elastic, _) = drop(bench, HEIGHT, 1.0, 5.0, h)?;
    let apexes = elastic.apexes(2);
    let highest = apexes.iter().skip(1).fold(0.0f64, |most, apex| if apex.is_nan() { f64::NAN } else { most.max(*apex) }) / HEIGHT;
    let spacing = elastic.spacing;
    let loss = |e: f64| tolerance::apex(e, speed, HEIGHT, GRAVITY, h, spacing);
    let damping = Model::of(bench.description()).damping().map_or(0.0, |(linear, _)| linear);
    let push = pushed(bench, h, speed).unwrap_or(0.0);
    let law = |e: f64| {
        // A drop and a rise, of a first fall each. The error of an apex grows with what comes back.
        let time = 2.0 * ball.first_impact_time();
        let returned = if e < 1.0 { e + push } else { e };
        let off = loss(returned) + damped_position(damping, GRAVITY, speed, time, h) / HEIGHT;
        let apexes = [e, returned].map(|e| apex(damping, GRAVITY, HEIGHT, e) / HEIGHT);
        let why = "the declared damping of drop and rise, and the declared part of a depth of up to v h that is taken back";
        (damping + push > 0.0).then(|| between(apexes, off, why))
    };
    let raised = raised(bench, speed, h) / HEIGHT;
    let none = tolerance::apex_gain(HEIGHT, GRAVITY, h, spacing, elastic.states.len(), bench.epsilon());
    let spent = "g (s + 2h) of the velocity and 3/2 (v + g h) h of the height";
    Ok(vec![
        Measurement::new("e = 0.5: apex over height of the drop", "1", kept, Expectation::equal(0.25, loss(0.5), spent))
            .predicted(law(0.5)),
        Measurement::new("e = 1: apex over height of the drop", "1", apexes[1] / HEIGHT, Expectation::at_least(1.0, loss(1.0), spent))
            .predicted(law(1.0)),
        Measurement::new("e = 1: highest of two apexes over height", "1", highest, Expectation::at_most(1.0, none, "no energy to gain"))
            .predicted((raised > 0.0).then(|| {
                Expectation::at_most(1.0, 2.0 * raised + none, "the declared part of two depths is taken back in the position alone")
            })),
    ])
}
