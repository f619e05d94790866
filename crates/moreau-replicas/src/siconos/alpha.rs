//! Stored motion of Siconos's `NewMarkAlphaOSI`. Between events it is generalised-α, as our scheme is between contacts. The module also
//! holds its behaviour at an impact.
//!
//! ```text
//!     flight     (1−α_m) a⁺ + α_m a = (1−α_f) q̈⁺ + α_f q̈ ,   v⁺, q⁺ by Newmark's rules: a first step of `generalised-alpha`, w = 0
//!     impact     v⁺ = v⁻ (1 − (1−α_m)/((1−α_f) γ) · h'/h²) ,      h' the part of the step before it
//! ```
//! 4.4.0 sets a = q̈ at the start of every step, where the method would go on with its own a. Every step is then a first step, and for ρ <
//! 1 the velocity has the weight γ (1−α_f)/(1−α_m) ≠ ½ on q̈⁺: order one in place of two.
//!
//! The class belongs to Siconos's event-driven strategy: it is not the nonsmooth generalised-α of Chen, Acary, Virlez and Brüls, whose
//! impulses act within steps. Its impact, as 4.4.0 has it, is the velocity constraint of a smooth step: h'/γ' u + (H Ŵ⁻¹Hᵀ) λ = 0 with γ' =
//! γ/β and Ŵ = (1−α_m)/((1−α_f) β h²) M, and λ is then taken for an impulse. e does not occur in it, and the factor has the unit 1/s.

use crate::siconos::steps::Provenance;
use crate::tolerance::references::{siconos_alpha_step, siconos_step};
use moreau_contact::solvers::LemkePivoting;
use moreau_dynamics::mechanics::{Mechanism, OscillatorWithStop, PointMass, State};
use moreau_dynamics::schemes::{GeneralisedAlpha, Scheme, simulate, step};
use moreau_exact::number::counted;
use moreau_exact::tolerance::rounding;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use serde::Deserialize;

/// A run of Siconos, format `siconos-events/1`, that ends with its first impact.
#[derive(Clone, Debug, Deserialize)]
pub struct SiconosAlpha {
    system: Spring,
    scheme: SchemeParameters,
    /// h \[s\].
    pub time_step: f64,
    times: Vec<f64>,
    impacts: Vec<bool>,
    positions: Vec<Vec<f64>>,
    velocities: Vec<Vec<f64>>,
    impulses: Vec<Vec<f64>>,
    provenance: Provenance,
}

#[derive(Clone, Debug, Deserialize)]
struct Spring {
    mass: f64,
    stiffness: f64,
    damping: f64,
    gravity: f64,
    stop: f64,
    restitution: f64,
}

#[derive(Clone, Debug, Deserialize)]
struct SchemeParameters {
    spectral_radius: f64,
    newton_tolerance: f64,
}

/// Siconos's first impact.
#[derive(Clone, Copy, Debug)]
pub struct FirstImpact {
    /// v⁻ = v⁺ − r/m \[m/s\].
    pub arriving: f64,
    /// v⁺ \[m/s\].
    pub leaving: f64,
    /// v⁺ by the formula above \[m/s\].
    pub predicted: f64,
    /// v⁺ by Newton's law, −e v⁻ \[m/s\].
    pub newton: f64,
    /// What the rounding of t makes of h' in `predicted` \[m/s\].
    pub rounding: f64,
}

impl SiconosAlpha {
    /// Reads a stored run.
    ///
    /// # Errors
    /// If the text is not such a run, or its lists differ in length.
    pub fn from_json(text: &str) -> Result<Self> {
        let run: SiconosAlpha = serde_json::from_str(text)?;
        let rows = [run.impacts.len(), run.positions.len(), run.velocities.len(), run.impulses.len() + 1];
        if run.times.len() < 3 || rows.iter().any(|count| *count != run.times.len()) {
            return Err(Error::invalid(
                "times",
                format!("has {}, but the other lists need {rows:?}", counted(run.times.len(), "entry")),
                "store the start and one row per event",
            ));
        }
        Ok(run)
    }

    /// The version of Siconos that made the run.
    pub fn version(&self) -> &str {
        &self.provenance.version
    }

    /// Our scheme with the spectral radius of the run.
    ///
    /// # Errors
    /// If that is none.
    pub fn scheme(&self) -> Result<GeneralisedAlpha> {
        GeneralisedAlpha::new(self.scheme.spectral_radius)
    }

    /// The mechanism; weight and spring together are not needed.
    fn mechanism(&self) -> Result<Box<dyn Mechanism>> {
        let Spring { mass, stiffness, damping, gravity, stop, restitution } = self.system;
        if gravity == 0.0 {
            return Ok(Box::new(OscillatorWithStop::new(mass, stiffness, damping, stop, restitution)?));
        }
        if stiffness != 0.0 || damping != 0.0 || stop != 0.0 {
            return Err(Error::Unsupported("a spring under gravity".into()));
        }
        Ok(Box::new(PointMass::ball_on_floor(mass, gravity, restitution)))
    }

    /// How many steps there are before the first impact.
    pub fn flight(&self) -> usize {
        self.impacts.iter().position(|impact| *impact).unwrap_or(self.impacts.len()) - 1
    }

    fn state(&self, k: usize) -> State {
        let [position, velocity] = [&self.positions[k], &self.velocities[k]].map(|row| DVector::from_column_slice(row));
        State { time: self.times[k], position, velocity }
    }

    /// The largest |Δq| \[m\] and |Δv| \[m/s\] of all single steps of the flight, each from Siconos's own state.
    ///
    /// # Errors
    /// Those of the scheme.
    pub fn deviations(&self, scheme: &dyn Scheme) -> Result<[f64; 2]> {
        let (mechanism, mut worst) = (self.mechanism()?, [0.0f64; 2]);
        for k in 0..self.flight() {
            let (reached, wanted) =
                (step(scheme, &LemkePivoting, mechanism.as_ref(), &self.state(k), self.time_step)?.state, self.state(k + 1));
            let apart = [(reached.position - wanted.position).amax(), (reached.velocity - wanted.velocity).amax()];
            worst.iter_mut().zip(apart).for_each(|(largest, one)| *largest = largest.max(one));
        }
        Ok(worst)
    }

    /// The largest |Δv| \[m/s\] of the whole flight of a scheme that keeps its own memory from step to step.
    ///
    /// # Errors
    /// Those of the scheme.
    pub fn whole_flight(&self, scheme: &dyn Scheme) -> Result<f64> {
        let ours = simulate(scheme, &LemkePivoting, self.mechanism()?.as_ref(), self.state(0), self.time_step, self.flight())?;
        let each = ours.samples.iter().enumerate().map(|(k, state)| (&state.velocity - self.state(k).velocity).amax());
        Ok(each.fold(0.0, f64::max))
    }

    /// How far position and velocity may be apart after one step.
    pub fn tolerances(&self) -> [f64; 2] {
        let largest = |rows: &[Vec<f64>]| rows.iter().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
        let (q, v, h) = (largest(&self.positions), largest(&self.velocities), self.time_step);
        let Spring { mass, stiffness, damping, gravity, .. } = self.system;
        let gain = h * ((stiffness * q + damping * v) / mass + gravity);
        let velocity = siconos_alpha_step(v.max(gain), self.scheme.newton_tolerance * h / mass);
        [siconos_step(q) + h * velocity, velocity]
    }

    /// The impact that ends the run, if one does.
    pub fn first_impact(&self) -> Option<FirstImpact> {
        let last = self.impacts.iter().position(|impact| *impact)?;
        let (leaving, rho, h) = (self.velocities[last][0], self.scheme.spectral_radius, self.time_step);
        let arriving = leaving - self.impulses[last - 1][0] / self.system.mass;
        let (mass, force) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let gamma = 0.5 + force - mass;
        let part = self.times[last] - self.times[last - 1];
        let factor = (1.0 - mass) / ((1.0 - force) * gamma) * part / (h * h);
        let rounding = rounding(64, arriving.abs() * (1.0 + factor * self.times[last] / part));
        Some(FirstImpact { arriving, leaving, predicted: arriving * (1.0 - factor), newton: -self.system.restitution * arriving, rounding })
    }
}
