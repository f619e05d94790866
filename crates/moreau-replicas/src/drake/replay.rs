//! Drake's stored motions made again, step by step, by our scheme of the same law.
//!
//! The mechanism is the one Drake was given: spheres, and boxes with a sphere in each corner, in Drake's coordinates. What is left is the
//! stopping rule: ours ends at rounding, Drake's within δ of it in the kinetic norm ([`sap_velocity`](references::sap_velocity), for TAMSI
//! [`tamsi_velocity`](references::tamsi_velocity)), in every step with contact.
//! ```text
//!     intervals       from every stored sample to the next:  e_v ← e_v + e_q/(h + τ) + δ ,  e_q ← e_q + h e_v
//!     whole motion    ‖v − v'‖_M ≤ 8 Σ δ ,      |x − x'| ≤ 8 t Σ δ/√m
//! ```
//! *Intervals.* A step is a proximal map, which does not spread velocities apart in the kinetic norm, and a depth enters it divided by h +
//! τ (τ = 0 but for SAP).
//! *Whole motion.* While the same contacts stay closed a step is the implicit Euler step of monotone forces, of a spring in the gap and of
//! friction in the velocity: two motions do not move apart in the norm ‖e_v‖²_M + Σ k e_φ², and every step adds its own δ. The factor is
//! for contacts that open in one of the two only. An impact may amplify more: those motions are held by their intervals; where every step
//! is stored, an interval is one step and its bound δ alone, through impacts too.

use crate::drake::Material;
use crate::drake::SemiAnalyticPrimal;
use crate::tolerance::references;
use moreau_checks::Finding;
use moreau_dynamics::mechanics::{Mechanism, SphereBodies, State};
use moreau_dynamics::schemes::{Scheme, run};
use moreau_dynamics::trajectory::Trajectory;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};
use serde_json::Value;

/// A stored motion with the scheme and the mechanism that should make it again.
pub struct Replay<'a> {
    stored: &'a Trajectory,
    scheme: Box<dyn Scheme>,
    mechanism: Box<dyn Mechanism>,
    material: Material,
    steps: usize,
    every: usize,
}

/// Our motion: the states at the samples, and δ of every step \[kg^½·m/s\].
struct Rerun {
    samples: Vec<State>,
    errors: Vec<f64>,
}

impl<'a> Replay<'a> {
    /// The scheme of the file's configuration on the file's scene.
    ///
    /// # Errors
    /// If the file is no motion of Drake's, or does not say how it was made.
    pub fn new(stored: &'a Trajectory) -> Result<Self> {
        let config = provenance(stored, "config").and_then(Value::as_str).ok_or_else(|| missing("provenance.config"))?;
        let scheme = format!("drake-{config}");
        Self::by(stored, |material| crate::drake::by_name(&scheme, material))
    }

    /// A replay of the file by another scheme, which is made from the file's material.
    ///
    /// # Errors
    /// As [`Replay::new`].
    pub fn by(stored: &'a Trajectory, scheme: impl FnOnce(Material) -> Result<Box<dyn Scheme>>) -> Result<Self> {
        let material = Self::material(stored)?;
        let (mechanism, _) = stored.scene.corner_sphere_mechanism(option(stored, "corner_radius")?)?;
        let count = |key: &str| {
            let value = provenance(stored, key).and_then(Value::as_u64).and_then(|count| usize::try_from(count).ok());
            value.ok_or_else(|| missing(&format!("provenance.{key}")))
        };
        Ok(Replay { stored, scheme: scheme(material)?, mechanism, material, steps: count("steps")?, every: count("sample_every")? })
    }

    /// The material the engine was given.
    ///
    /// # Errors
    /// If the file does not tell it.
    pub fn material(stored: &Trajectory) -> Result<Material> {
        Ok(Material {
            stiffness: option(stored, "stiffness")?,
            relaxation_time: option(stored, "relaxation_time")?,
            dissipation: option(stored, "dissipation")?,
            stiction_tolerance: option(stored, "stiction_tolerance")?,
        })
    }

    /// The whole motion from its first sample: velocity and place at the sample that comes closest to what is allowed.
    ///
    /// # Errors
    /// Those of the scheme.
    pub fn whole(&self) -> Result<[Finding; 2]> {
        let ours = self.rerun(self.sample(0), self.steps)?;
        let mut worst = [Worst::default(), Worst::default()];
        for (sample, state) in ours.samples.iter().enumerate().skip(1) {
            let stored = self.sample(sample);
            let injected = references::replayed(ours.errors[..sample * self.every].iter().sum());
            let rounding = references::sample_rounding(sample * self.every, self.size(&stored));
            let mass = self.mechanism.mass_matrix(&stored.position);
            let apart = &state.position - &stored.position;
            let away = (0..apart.len() / 7).map(|body| apart.rows(7 * body, 3).norm()).fold(0.0, f64::max);
            let time = self.stored.times[sample];
            worst[0].see(self.kinetic(&(&state.velocity - &stored.velocity), &stored), injected + rounding);
            worst[1].see(away, time * (injected / lightest(&mass).sqrt() + rounding));
        }
        let name = |what: &str| format!("{what} of the whole motion by our {}", self.scheme.name());
        let [velocity, place] = worst;
        Ok([velocity.finding(name("velocity"), "kg^½·m/s"), place.finding(name("place"), "m")])
    }

    /// From every stored sample to the next, the velocity there: the interval that comes closest to what is allowed.
    ///
    /// # Errors
    /// Those of the scheme.
    pub fn intervals(&self) -> Result<Finding> {
        let tau = if self.scheme.name() == "drake-sap" { self.material.relaxation_time } else { 0.0 };
        let h = self.stored.time_step;
        let mut worst = Worst::default();
        for sample in 1..self.stored.times.len() {
            let stored = self.sample(sample);
            let ours = self.rerun(self.sample(sample - 1), self.every)?;
            let (mut velocity, mut position) = (references::sample_rounding(self.every, self.size(&stored)), 0.0);
            for error in ours.errors {
                velocity += position / (h + tau) + error;
                position += h * velocity;
            }
            worst.see(self.kinetic(&(&ours.samples[1].velocity - &stored.velocity), &stored), velocity);
        }
        let name = format!("velocity after {} steps from each sample by our {}", self.every, self.scheme.name());
        Ok(worst.finding(name, "kg^½·m/s"))
    }

    fn rerun(&self, start: State, steps: usize) -> Result<Rerun> {
        let h = self.stored.time_step;
        let tamsi = self.scheme.name() == "drake-tamsi";
        let mut rerun = Rerun { samples: vec![start.clone()], errors: Vec::new() };
        let mut before = start.clone();
        run(self.scheme.as_ref(), &SemiAnalyticPrimal, self.mechanism.as_ref(), start, h, steps, |step| {
            let (state, impulses) = (&step.state, &step.impulses[..]);
            let mass = self.mechanism.mass_matrix(&before.position);
            let received = &mass * (&state.velocity - &before.velocity) - self.mechanism.force(&before.position, &before.velocity) * h;
            rerun.errors.push(match impulses {
                [] => 0.0,
                _ if tamsi => references::tamsi_velocity(&mass, self.material.stiction_tolerance),
                _ => references::sap_velocity(&mass, &(&mass * &state.velocity), &received),
            });
            before = state.clone();
            if rerun.errors.len().is_multiple_of(self.every) {
                rerun.samples.push(state.clone());
            }
        })?;
        Ok(rerun)
    }

    /// ‖v‖_M at a state \[kg^½·m/s\].
    fn kinetic(&self, velocity: &DVector<f64>, state: &State) -> f64 {
        velocity.dot(&(self.mechanism.mass_matrix(&state.position) * velocity)).sqrt()
    }

    /// Velocities that a step rounds, positions divided by h among them \[m/s\].
    fn size(&self, state: &State) -> f64 {
        state.velocity.norm() + state.position.norm() / self.stored.time_step
    }

    fn sample(&self, sample: usize) -> State {
        let tracks = self.stored.bodies.iter();
        SphereBodies::state(tracks.map(|track| {
            (track.position[sample], track.orientation[sample], track.linear_velocity[sample], track.angular_velocity[sample])
        }))
    }
}

/// The smallest mass of a body, whose six rows begin with it \[kg\].
fn lightest(mass: &DMatrix<f64>) -> f64 {
    (0..mass.nrows() / 6).map(|body| mass[(6 * body, 6 * body)]).fold(f64::INFINITY, f64::min)
}

/// The comparison with the largest share of what is allowed.
#[derive(Clone, Copy, Default)]
struct Worst {
    distance: f64,
    allowed: f64,
}

impl Worst {
    fn see(&mut self, distance: f64, allowed: f64) {
        // also the first, and one that is not a number
        let below = distance * self.allowed < self.distance * allowed;
        if !below && !self.distance.is_nan() {
            *self = Worst { distance, allowed };
        }
    }

    fn finding(self, name: String, unit: &'static str) -> Finding {
        Finding::at_most(name, self.distance, self.allowed, unit)
    }
}

fn provenance<'a>(stored: &'a Trajectory, key: &str) -> Option<&'a Value> {
    stored.provenance.as_ref()?.get(key)
}

fn option(stored: &Trajectory, key: &str) -> Result<f64> {
    stored.engine.options.get(key).and_then(Value::as_f64).ok_or_else(|| missing(&format!("engine.options.{key}")))
}

fn missing(field: &str) -> Error {
    Error::invalid(field, "is missing", "give a motion that scripts/generate_references.py made with Drake")
}
