//! Stored event-driven motion of Siconos, taken up by ours after each of its events.
//!
//! ```text
//!     (q, v) after an event ──► our flight ──► t, v⁺ of the next impact    or    q, v at the next sample
//!     t |v⁻| [m]                    a gap that is δ off closes δ/|v⁻| earlier or later
//!     v⁺ / (1 + |a|/|v⁻|) [m/s]     and at another speed by |a| δ/|v⁻| , a the acceleration of the flight
//! ```
//! Siconos integrates with LSODAR, whose estimated error of every step is below its tolerances; ours with Dormand–Prince. Siconos has no
//! rule for infinitely many impacts but what floating-point numbers and its event tolerance make of them. Impacts that arrive so slowly
//! that the error of the gap decides when they happen are left out; those that follow are still longer than the flights our rule leaves
//! out.

use crate::siconos::steps::{Provenance, Stored};
use crate::tolerance::references::siconos_flight;
use moreau_contact::contact::delassus::MassFactor;
use moreau_contact::solvers::LemkePivoting;
use moreau_dynamics::event_driven::{EventDriven, Passage};
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use serde::Deserialize;

/// A run of Siconos, format `siconos-events/1`.
#[derive(Clone, Debug, Deserialize)]
pub struct SiconosEvents {
    system: Stored,
    relative_tolerance: f64,
    absolute_tolerance: f64,
    /// The gap \[m\] and the normal velocity \[m/s\] that Siconos takes for zero.
    pub event_tolerance: f64,
    /// The start and every event \[s\].
    pub times: Vec<f64>,
    /// Whether it is an impact; the others are samples.
    pub impacts: Vec<bool>,
    /// q then.
    pub positions: Vec<Vec<f64>>,
    /// v after it.
    pub velocities: Vec<Vec<f64>>,
    impulses: Vec<Vec<f64>>,
    integrator_steps: Vec<usize>,
    provenance: Provenance,
}

/// How far our motion is from the stored one, at worst.
#[derive(Clone, Copy, Debug, Default)]
pub struct Apart {
    /// Instants of impacts, times the speed \[m\]; infinite if one is missed.
    pub instant: f64,
    /// Velocities after impacts, over what the instant adds to them \[m/s\].
    pub velocity_after: f64,
    /// q at samples \[m\].
    pub position: f64,
    /// v at samples \[m/s\].
    pub velocity: f64,
    /// How many impacts were compared.
    pub impacts: usize,
}

impl SiconosEvents {
    /// Reads a stored run.
    ///
    /// # Errors
    /// If the text is not such a run, or its lists differ in length.
    pub fn from_json(text: &str) -> Result<Self> {
        let run: SiconosEvents = serde_json::from_str(text)?;
        let rows = [run.impacts.len(), run.positions.len(), run.velocities.len(), run.impulses.len() + 1, run.integrator_steps.len() + 1];
        if run.times.len() < 2 || rows.iter().any(|count| *count != run.times.len()) {
            let problem = format!("has {}, but the other lists need {rows:?}", counted(run.times.len(), "entry"));
            return Err(Error::invalid("times", problem, "store the start and one row per event"));
        }
        Ok(run)
    }

    /// The version of Siconos that made the run.
    pub fn version(&self) -> &str {
        &self.provenance.version
    }

    /// The mechanism itself.
    ///
    /// # Errors
    /// If a stored parameter is not valid.
    pub fn mechanism(&self) -> Result<Box<dyn Mechanism>> {
        self.system.mechanism()
    }

    /// The stored state after event k.
    pub fn state(&self, k: usize) -> State {
        let [position, velocity] = [&self.positions, &self.velocities].map(|rows| DVector::from_column_slice(&rows[k]));
        State { time: self.times[k], position, velocity }
    }

    /// Compares a method with every event.
    ///
    /// # Errors
    /// Those of the method.
    pub fn apart(&self, method: &EventDriven) -> Result<Apart> {
        let mechanism = self.mechanism()?;
        let mut apart = Apart::default();
        for k in 1..self.times.len() {
            if !self.impacts[k] {
                let reached = self.motion(method, mechanism.as_ref(), k - 1, k)?.state;
                let wanted = self.state(k);
                apart.position = apart.position.max((reached.position - wanted.position).amax());
                apart.velocity = apart.velocity.max((reached.velocity - wanted.velocity).amax());
            } else if k + 1 < self.times.len() {
                self.compare_impact(method, mechanism.as_ref(), k, &mut apart)?;
            }
        }
        Ok(apart)
    }

    fn compare_impact(&self, method: &EventDriven, mechanism: &dyn Mechanism, k: usize, apart: &mut Apart) -> Result<()> {
        let wanted = self.state(k);
        let mass = MassFactor::new(&mechanism.mass_matrix(&wanted.position))?;
        let speed = (&wanted.velocity - mass.solve(&DVector::from_column_slice(&self.impulses[k - 1]))).amax();
        let acceleration = mass.solve(&mechanism.force(&wanted.position, &wanted.velocity)).amax();
        // beyond it the flight is a parabola whose ends the error moves by less than a hundredth
        if speed * speed <= 200.0 * acceleration * self.tolerance() {
            return Ok(());
        }
        let motion = self.motion(method, mechanism, k - 1, k + 1)?;
        let Some(impact) = motion.impacts.first() else {
            apart.instant = f64::INFINITY;
            return Ok(());
        };
        let late = self.times[k - 1] + impact.elapsed - wanted.time;
        apart.instant = apart.instant.max(late.abs() * speed);
        apart.velocity_after = apart.velocity_after.max((&impact.velocity - wanted.velocity).amax() / (1.0 + acceleration / speed));
        apart.impacts += 1;
        Ok(())
    }

    fn motion(&self, method: &EventDriven, mechanism: &dyn Mechanism, from: usize, to: usize) -> Result<Passage> {
        method.advance(&LemkePivoting, mechanism, &self.state(from), self.times[to] - self.times[from])
    }

    /// The largest |Δq| \[m\] at samples of a whole motion from the stored start.
    ///
    /// # Errors
    /// Those of the method.
    pub fn whole_run(&self, method: &EventDriven) -> Result<f64> {
        let mechanism = self.mechanism()?;
        let (mut state, mut worst) = (self.state(0), 0.0f64);
        for k in (1..self.times.len()).filter(|k| !self.impacts[*k]) {
            state = method.advance(&LemkePivoting, mechanism.as_ref(), &state, self.times[k] - state.time)?.state;
            worst = worst.max((&state.position - self.state(k).position).amax());
        }
        Ok(worst)
    }

    /// What any of the differences may be, in its unit.
    pub fn tolerance(&self) -> f64 {
        let size = [&self.positions, &self.velocities].into_iter().flatten().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
        let longest = self.times.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        let steps = self.integrator_steps.iter().copied().max().unwrap_or(0);
        siconos_flight(steps, self.relative_tolerance, self.absolute_tolerance, size, longest)
    }
}
