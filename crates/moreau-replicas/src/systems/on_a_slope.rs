//! A block of 1 kg on a slope of 20°, μ = 0.3 or 0.5: it slides with a = g (sin α − μ cos α), or it sticks.

use super::Measured;
use moreau_checks::tolerance::convergence::slide_rounding;
use moreau_contact::solvers::Auto;
use moreau_dynamics::mechanics::{PointMass, State};
use moreau_dynamics::schemes::{Scheme, simulate};
use moreau_dynamics::trajectory::Recording;
use moreau_exact::{Error, Result};
use moreau_forms::InclineBlock;
use nalgebra::dvector;

const GRAVITY: f64 = 9.81;
const ANGLE: f64 = std::f64::consts::PI / 9.0;
const SLIDING: f64 = 0.3;
const STICKING: f64 = 0.5;
const STEPS: usize = 256;
const TIME_STEP: f64 = 1.0 / 256.0;

fn run(scheme: &dyn Scheme, friction: f64, gap: f64, speed: f64) -> Result<Recording> {
    let block = PointMass::block_on_incline(1.0, GRAVITY, ANGLE, friction, 0.0);
    let start = State { time: 0.0, position: dvector![0.0, gap], velocity: dvector![speed, 0.0] };
    simulate(scheme, &Auto, &block, start, TIME_STEP, STEPS)
}

fn worst(recording: &Recording, difference: impl Fn(&State) -> f64) -> Result<Measured> {
    let tolerance = slide_rounding(STEPS);
    let comparisons = recording.samples.iter().map(|state| Measured::within(difference(state).abs(), tolerance));
    Measured::worst(comparisons).ok_or_else(|| Error::Unsupported("no step was taken".into()))
}

/// Speed of a sliding block at every step against v = a t: a velocity with constant force and friction is exact at the steps \[m/s\].
///
/// # Errors
/// Those of the scheme.
pub fn sliding_speed(scheme: &dyn Scheme) -> Result<Measured> {
    let acceleration = InclineBlock::new(GRAVITY, ANGLE, SLIDING, 0.0)?.acceleration(1.0);
    worst(&run(scheme, SLIDING, 0.0, 0.0)?, |state| state.velocity[0] - acceleration * state.time)
}

/// Speed of a block that Coulomb's law holds \[m/s\].
///
/// # Errors
/// Those of the scheme.
pub fn creep(scheme: &dyn Scheme) -> Result<Measured> {
    worst(&run(scheme, STICKING, 0.0, 0.0)?, |state| state.velocity[0])
}

/// Gap of a sliding block at every step against φ = μ h v_t, what the dual cone φ/h + u_n⁺ ≥ μ‖u_t⁺‖ asks of it \[m\].
///
/// # Errors
/// Those of the scheme.
pub fn sliding_gap(scheme: &dyn Scheme) -> Result<Measured> {
    let kept = |speed: f64| SLIDING * TIME_STEP * speed.abs();
    worst(&run(scheme, SLIDING, kept(1.0), 1.0)?, |state| state.position[1] - kept(state.velocity[0]))
}
