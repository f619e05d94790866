//! How far bodies can have come on the energy that the balances allow them.
//!
//! ```text
//!     w⁺ ≤ √((w + h f)² + 2 g) ,      w = ‖v‖_M ,  f = ‖F‖_{M⁻¹} ,  g: what the step's balance lets T gain beyond the work of F
//!     w⁺ ≤ ½hf + √(¼h²f² + 2 (X + f D)) ,      X = T₀ + |(θ−½) h F·v₀| + Σ rise ,  D = Σ h max(w, w⁺) ,
//!     √m_i ‖x_i − x_i(0)‖ ≤ D .
//! ```
//! The first line is T̂(v_free) ≤ ½(w + hf)² with what contact adds. The second is V ≥ V₀ − f D for a constant force and T = Ẽ − V −
//! (θ−½)hF·v, whose last term is at most ½ h f w. The third: a body moves by h times a mean of its velocities before and after, and Σ m_i
//! ‖Δx_i‖² ≤ (h max w)². The mean stays within both bounds, so that the smaller one holds.

use crate::energy_balance::{Judged, Taken};
use crate::tolerance::energy_balance as tolerance;
use moreau_checks::Finding;
use moreau_contact::contact::delassus::MassFactor;
use moreau_exact::Result;
use moreau_exact::number::larger;
use nalgebra::DVector;

/// The reach of a motion from its start.
#[derive(Clone, Debug)]
pub struct Reach {
    /// Positions of the bodies at the start \[m\].
    start: Vec<[f64; 3]>,
    /// w \[√J\].
    speed: f64,
    /// X \[J\]; `None` once a step had no bound.
    energy: Option<f64>,
    /// D \[√kg m\]; `None` once a step had no theorem.
    distance: Option<f64>,
    /// Steps taken.
    steps: usize,
}

/// Name of the finding on a body's distance.
pub const REACH: &str = "distance from the start";

impl Reach {
    /// At the start of a motion.
    ///
    /// # Errors
    /// If the mass matrix is not positive definite.
    pub fn new(taken: &Taken) -> Result<Self> {
        let (mechanism, state) = (taken.mechanism, taken.before);
        let energy = mechanism.kinetic_energy(state);
        let force = mechanism.force(&state.position, &state.velocity.map(|_| 0.0));
        let start = mechanism.bodies(&state.position, &state.velocity).iter().map(|body| body.position).collect();
        let speed = (2.0 * energy).max(0.0).sqrt();
        let energy = Some(energy + 0.5 * taken.h * force.dot(&state.velocity).abs());
        Ok(Reach { start, speed, energy, distance: Some(0.0), steps: 0 })
    }

    /// Takes a step's balance into account and holds every body's distance against D; `masses` \[kg\] of the bodies. No finding without a
    /// theorem.
    ///
    /// # Errors
    /// If the mass matrix is not positive definite.
    pub fn after(&mut self, taken: &Taken, judged: &Judged, masses: &[f64]) -> Result<Option<Finding>> {
        let (mechanism, h) = (taken.mechanism, taken.h);
        let mass = mechanism.mass_matrix(&taken.before.position);
        let force = mechanism.force(&taken.before.position, &DVector::zeros(mass.nrows()));
        let fall = force.dot(&MassFactor::new(&mass)?.solve(&force)).max(0.0).sqrt();
        self.steps += 1;
        let (Some(distance), Some(gain)) = (self.distance, judged.gain) else {
            self.distance = None;
            return Ok(None);
        };
        let mut reached = ((self.speed + h * fall).powi(2) + 2.0 * gain).sqrt();
        let distance = distance + h * self.speed.max(reached);
        self.energy = self.energy.zip(judged.rise).map(|(energy, rise)| energy + rise);
        if let Some(energy) = self.energy {
            let half = 0.5 * h * fall;
            reached = reached.min(half + (half * half + 2.0 * (energy + fall * distance)).sqrt());
        }
        (self.speed, self.distance) = (reached, Some(distance));
        let bodies = mechanism.bodies(&taken.step.state.position, &taken.step.state.velocity);
        let gone = bodies.iter().zip(&self.start).zip(masses).map(|((body, start), mass)| {
            let squares = body.position.iter().zip(start).map(|(x, y)| (x - y).powi(2));
            squares.sum::<f64>().sqrt() * mass.sqrt()
        });
        let farthest = gone.fold(0.0, |farthest, gone| larger(gone, farthest));
        let size = distance + masses.iter().fold(0.0f64, |most, mass| most.max(*mass)).sqrt() * taken.before.position.amax();
        let tolerance = (tolerance::reach(self.steps) - 1.0) * size;
        Ok(Some(Finding::at_most_within(REACH, farthest, distance, tolerance, "√kg m")))
    }
}
