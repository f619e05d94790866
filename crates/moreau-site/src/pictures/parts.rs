//! What several pictures need: points of functions, and motions of the bodies of the chapter.

use moreau_contact::solvers::Auto;
use moreau_dynamics::mechanics::{Mechanism, PointMass, State};
use moreau_dynamics::schemes::{Scheme, simulate};
use moreau_dynamics::trajectory::Recording;
use moreau_exact::Result;
use nalgebra::{DVector, dvector};

/// g \[m/s²\].
pub(super) const GRAVITY: f64 = 9.81;

/// n + 1 numbers from `low` to `high`, evenly.
pub(super) fn evenly(low: f64, high: f64, n: usize) -> impl Iterator<Item = f64> {
    (0..=n).map(move |k| low + (high - low) * k as f64 / n as f64)
}

/// n + 1 numbers from `low` to `high`, evenly in their logarithms.
pub(super) fn by_ratio(low: f64, high: f64, n: usize) -> impl Iterator<Item = f64> {
    evenly(low.ln(), high.ln(), n).map(f64::exp)
}

/// The points (x, f(x)).
pub(super) fn curve(places: impl Iterator<Item = f64>, function: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    places.map(|x| [x, function(x)]).collect()
}

/// A motion under a scheme, its contact problems solved by the solver that fits.
pub(super) fn motion(scheme: &dyn Scheme, mechanism: &dyn Mechanism, start: [DVector<f64>; 2], h: f64, steps: usize) -> Result<Recording> {
    let [position, velocity] = start;
    simulate(scheme, &Auto, mechanism, State { time: 0.0, position, velocity }, h, steps)
}

/// A ball of 1 kg dropped from 1 m.
pub(super) fn drop(scheme: &dyn Scheme, restitution: f64, h: f64, steps: usize) -> Result<Recording> {
    let ball = PointMass::ball_on_floor(1.0, GRAVITY, restitution);
    motion(scheme, &ball, [dvector![1.0], dvector![0.0]], h, steps)
}

/// (time, what is asked of the state) of every sample.
pub(super) fn samples(recording: &Recording, value: impl Fn(&State) -> f64) -> Vec<[f64; 2]> {
    recording.samples.iter().map(|state| [state.time, value(state)]).collect()
}

/// The number as it stands in a legend.
pub(super) fn short(number: f64) -> String {
    moreau_exact::number::significant(number)
}
