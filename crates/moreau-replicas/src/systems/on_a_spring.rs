//! The undamped spring, ω = 1/s, at s = hω = 1/8, far from its stop: each step against the same step in exact rationals, and the energy
//! after n steps against the modulus of the method's amplification factor.
//!
//! ```text
//!     explicit Euler        |R|² = 1 + s²
//!     θ method              |R|² = (1 + (1−θ)² s²)/(1 + θ² s²)
//!     Runge–Kutta           |R|² = 1 − s⁶/72 + s⁸/576
//!     semi-implicit Euler   q² + v² − s q v  is constant
//! ```

use super::Measured;
use crate::tolerance::systems::{spring_energy, spring_step};
use moreau_contact::solvers::Auto;
use moreau_dynamics::integrators::{Method, Phase, SpringDamper};
use moreau_dynamics::mechanics::{OscillatorWithStop, State};
use moreau_dynamics::schemes::{Scheme, simulate};
use moreau_dynamics::trajectory::Recording;
use moreau_exact::scalar::{Rational, Scalar, exact, ratio};
use moreau_exact::{Error, Result};
use nalgebra::dvector;

/// s = h ω = h / 1 s.
pub const STEP: f64 = 0.125;
const STEPS: usize = 128;

fn run(scheme: &dyn Scheme) -> Result<Recording> {
    let spring = OscillatorWithStop::new(1.0, 1.0, 0.0, -100.0, 0.0)?;
    let start = State { time: 0.0, position: dvector![1.0], velocity: dvector![0.3] };
    simulate(scheme, &Auto, &spring, start, STEP, STEPS)
}

/// The largest difference of a coordinate or velocity after each step from the same step in rationals, relative to the size of the state.
///
/// # Errors
/// Those of the scheme.
pub fn steps(scheme: &dyn Scheme, method: &impl Method) -> Result<Measured> {
    let system = SpringDamper { stiffness_per_mass: ratio(1, 1), damping_per_mass: ratio(0, 1) };
    let recording = run(scheme)?;
    let comparisons = recording.samples.windows(2).map(|pair| {
        let phase = |state: &State| Phase::of_one(exact(state.position[0]), exact(state.velocity[0]));
        let wanted: Phase<Rational> = method.step(&system, &phase(&pair[0]), &exact(STEP));
        let off = |found: f64, wanted: &Rational| (found - Scalar::to_f64(wanted)).abs();
        let difference = off(pair[1].position[0], &wanted.position[0]).max(off(pair[1].velocity[0], &wanted.velocity[0]));
        Measured::within(difference / size(&pair[0]).sqrt(), spring_step())
    });
    Measured::worst(comparisons).ok_or_else(|| Error::Unsupported("no step was taken".into()))
}

/// q² + v², twice the energy per mass.
fn size(state: &State) -> f64 {
    let (q, v) = (state.position[0], state.velocity[0]);
    q * q + v * v
}

/// q² + v² + c q v after n steps, relative to its first value times `factor`ⁿ.
///
/// # Errors
/// Those of the scheme.
pub fn energy(scheme: &dyn Scheme, factor: f64, cross: f64) -> Result<Measured> {
    let recording = run(scheme)?;
    let quantity = |state: &State| size(state) + cross * state.position[0] * state.velocity[0];
    let ratio = quantity(recording.last()) / quantity(&recording.samples[0]) / factor.powi(STEPS as i32);
    Ok(Measured::within((ratio - 1.0).abs(), spring_energy(STEPS)))
}
