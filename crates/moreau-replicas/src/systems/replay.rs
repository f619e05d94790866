//! A stored motion of an engine, replayed by a scheme from the scene's first state and compared at every sample.

use super::Measured;
use crate::tolerance::references as tolerance;
use moreau_contact::solvers::ProjectedGaussSeidel;
use moreau_dynamics::mechanics::BodyState;
use moreau_dynamics::schemes::{self, Scheme};
use moreau_dynamics::trajectory::Trajectory;
use moreau_exact::{Error, Result};
use serde_json::Value;

/// Largest differences from a stored motion, with their tolerances.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// Largest difference of a position \[m\].
    pub position: Measured,
    /// Largest difference of a velocity \[m/s\].
    pub velocity: Measured,
}

/// Runs the scheme over the stored motion's scene with its step, and compares `samples` samples after the first.
///
/// # Errors
/// Those of the scheme. A motion without provenance is an error too, because its accuracy is unknown.
pub fn replay(stored: &Trajectory, scheme: &dyn Scheme, samples: usize) -> Result<Replay> {
    let (mechanism, start) = stored.scene.spatial_mechanism()?;
    let h = stored.time_step;
    let every = (stored.times[1] / h).round() as usize;
    let (mut step, mut position, mut velocity) = (0, 0.0f64, 0.0f64);
    let steps = every * samples;
    schemes::run(scheme, &ProjectedGaussSeidel::accelerated(), mechanism.as_ref(), start, h, steps, |made| {
        let state = &made.state;
        step += 1;
        if step % every == 0 {
            let ours = mechanism.bodies(&state.position, &state.velocity);
            let [x, v] = differences(stored, step / every, &ours);
            (position, velocity) = (position.max(x), velocity.max(v));
        }
    })?;
    // a share of NaN is lost in max: what is not a number is infinitely far
    let finite = |difference: f64| if difference.is_finite() { difference } else { f64::INFINITY };
    let [allowed_position, allowed_velocity] = allowed(stored)?;
    Ok(Replay {
        position: Measured::within(finite(position), allowed_position),
        velocity: Measured::within(finite(velocity), allowed_velocity),
    })
}

/// Largest difference of any body's position \[m\] and velocity \[m/s\] from a sample.
fn differences(stored: &Trajectory, sample: usize, ours: &[BodyState]) -> [f64; 2] {
    let largest = |one: &[f64; 3], other: &[f64; 3]| {
        let apart = (0..3).map(|k| (one[k] - other[k]).abs());
        apart.fold(0.0, |worst: f64, one| if one.is_nan() { f64::INFINITY } else { worst.max(one) })
    };
    let mut worst = [0.0f64; 2];
    for (body, track) in ours.iter().zip(&stored.bodies) {
        worst[0] = worst[0].max(largest(&body.position, &track.position[sample]));
        worst[1] = worst[1].max(largest(&body.linear_velocity, &track.linear_velocity[sample]));
    }
    worst
}

/// What the engine determines of its own motion, as measured when the file was made, and what our steps add \[m, m/s\].
fn allowed(stored: &Trajectory) -> Result<[f64; 2]> {
    let provenance = stored.provenance.as_ref().ok_or_else(|| Error::Unsupported("the motion has no provenance".into()))?;
    let speeds = stored.bodies.iter().flat_map(|body| &body.linear_velocity).flatten();
    let speed = speeds.fold(0.0, |largest: f64, v| largest.max(v.abs()));
    let duration = stored.times.last().copied().unwrap_or(0.0);
    let steps = duration / stored.time_step;
    let stop = provenance["options"]["residual_threshold"].as_f64();
    let ours = match stop {
        Some(0.0) => steps * tolerance::replayed_step(speed),
        _ => tolerance::bullet_sweeps(tolerance::BULLET_RESIDUAL),
    };
    let engine = |kind: &str, size: f64| {
        let stored = &provenance["sensitivity"][kind];
        let [amplification, stopping] = [0, 1].map(|k: usize| stored[k].as_f64().unwrap_or(f64::NAN));
        tolerance::stored_number(amplification, stopping, steps, size)
    };
    Ok([engine("bodies/position", speed * duration) + ours * duration, engine("bodies/linear_velocity", speed) + ours])
}

/// The option of a stored engine, a number.
///
/// # Errors
/// If the file does not name it.
pub fn option(stored: &Trajectory, key: &str) -> Result<f64> {
    let value = stored.engine.options.get(key).and_then(Value::as_f64);
    value.ok_or_else(|| Error::Unsupported(format!("the stored motion has no option `{key}`")))
}
