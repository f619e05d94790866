//! What the bodies of a recorded motion do at its samples, each of which is looked at once.

use crate::mechanics::{Mechanism, State};
use crate::number::larger;
use crate::trajectory::Recording;

/// The samples of a motion, one after another.
pub struct Sampled {
    /// t \[s\].
    pub times: Vec<f64>,
    /// The largest speed of a centre of mass \[m/s\].
    pub speeds: Vec<f64>,
    /// The smallest gap \[m\], infinite where nothing touches.
    pub gaps: Vec<f64>,
    /// Kinetic and potential energy \[J\].
    pub energies: Vec<f64>,
    /// The largest sum of kinetic and potential energy, each without its sign \[J\].
    pub largest_energy: f64,
    /// The centres of mass of all bodies, sample by sample \[m\].
    places: Vec<[f64; 3]>,
    /// How many bodies there are.
    pub bodies: usize,
}

/// ‖x‖, of components that may be as large as numbers are.
pub fn length([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}

impl Sampled {
    /// Those of a recording.
    pub fn of(recording: &Recording, mechanism: &dyn Mechanism) -> Self {
        let times = recording.samples.iter().map(|state| state.time).collect();
        let mut sampled = Sampled {
            times,
            speeds: Vec::new(),
            gaps: Vec::new(),
            energies: Vec::new(),
            largest_energy: 0.0,
            places: Vec::new(),
            bodies: 0,
        };
        recording.samples.iter().for_each(|state| sampled.add(state, mechanism));
        sampled
    }

    fn add(&mut self, state: &State, mechanism: &dyn Mechanism) {
        let bodies = mechanism.bodies(&state.position, &state.velocity);
        self.bodies = bodies.len();
        self.places.extend(bodies.iter().map(|body| body.position));
        self.speeds.push(bodies.iter().fold(0.0, |fastest, body| larger(length(body.linear_velocity), fastest)));
        // a penetration is a gap below zero: candidates that are apart are not looked at
        let mut least = f64::INFINITY;
        mechanism.gaps_within(&state.position, 0.0, &mut |gap, _| least = least.min(gap));
        self.gaps.push(least);
        let (kinetic, potential) = (mechanism.kinetic_energy(state), mechanism.potential_energy(&state.position));
        self.energies.push(kinetic + potential);
        self.largest_energy = larger(kinetic.abs() + potential.abs(), self.largest_energy);
    }

    /// Where every body is at a sample \[m\].
    pub fn places(&self, sample: usize) -> &[[f64; 3]] {
        &self.places[sample * self.bodies..][..self.bodies]
    }

    /// One coordinate of a body at every sample \[m\].
    pub fn coordinate(&self, body: usize, axis: usize) -> Vec<f64> {
        (0..self.times.len()).map(|sample| self.places(sample)[body][axis]).collect()
    }

    /// The largest coordinate without its sign \[m\].
    pub fn farthest(&self) -> f64 {
        self.places.iter().flatten().fold(0.0, |farthest, x| larger(x.abs(), farthest))
    }
}
