//! The four errors of one run against the closed form of the bouncing ball.

use moreau_contact::solvers::Auto;
use moreau_dynamics::mechanics::{PointMass, State};
use moreau_dynamics::schemes::{Scheme, simulate};
use moreau_dynamics::trajectory::metrics::{Normalisation, graph_distance, position_sup, velocity_l1, velocity_sup};
use moreau_dynamics::trajectory::{Graph, OrderEstimate, Refinement, fit_order, shifted_steps};
use moreau_exact::Result;
use moreau_forms::BouncingBall;
use nalgebra::dvector;

/// Gravity of every case \[m/s²\].
pub(super) const GRAVITY: f64 = 9.81;
/// Height of every drop \[m\].
pub(super) const HEIGHT: f64 = 1.0;

/// Errors of one run, in units of the ball: V = g t₁.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallErrors {
    /// max_k |q_k − q(t_k)| \[m\].
    pub position: f64,
    /// ∫|v_h − v| dt \[m\], v_h the step function of the scheme.
    pub velocity_l1: f64,
    /// ess sup |v_h − v| \[m/s\].
    pub velocity_sup: f64,
    /// Hausdorff distance of the filled-in graphs in (t/t₁, v/V).
    pub graph: f64,
}

/// The errors of a ball dropped from 1 m with restitution e, over `horizon` · t₁ with step h.
///
/// # Errors
/// Those of the scheme.
pub fn ball_errors(scheme: &dyn Scheme, restitution: f64, horizon: f64, h: f64) -> Result<BallErrors> {
    let ball = BouncingBall::new(GRAVITY, HEIGHT, restitution)?;
    let mechanism = PointMass::ball_on_floor(1.0, GRAVITY, restitution);
    let initial = State { time: 0.0, position: dvector![HEIGHT], velocity: dvector![0.0] };
    let steps = (horizon * ball.first_impact_time() / h) as usize;
    let recording = simulate(scheme, &Auto, &mechanism, initial, h, steps)?;
    let times: Vec<f64> = recording.samples.iter().map(|sample| sample.time).collect();
    let positions: Vec<f64> = recording.samples.iter().map(|sample| sample.position[0]).collect();
    let velocities: Vec<f64> = recording.samples.iter().map(|sample| sample.velocity[0]).collect();
    let exact = Graph::new(ball.velocity_corners(times[times.len() - 1]))?;
    let discrete = Graph::steps(&times, &velocities)?;
    let distance = graph_distance(&discrete, &exact, Normalisation::of_fall(GRAVITY, HEIGHT))?;
    Ok(BallErrors {
        position: position_sup(&times, &positions, |t| ball.state(t).0),
        velocity_l1: velocity_l1(&discrete, &exact),
        velocity_sup: velocity_sup(&discrete, &exact),
        graph: distance.upper,
    })
}

/// Envelopes of the four errors over the shifted steps of each level, and their slopes.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// The estimate for [`BallErrors::position`].
    pub position: OrderEstimate,
    /// The estimate for [`BallErrors::velocity_l1`].
    pub velocity_l1: OrderEstimate,
    /// The estimate for [`BallErrors::velocity_sup`].
    pub velocity_sup: OrderEstimate,
    /// The estimate for [`BallErrors::graph`].
    pub graph: OrderEstimate,
}

/// The study of one ball: every metric's envelope over `shifts` steps per level, from one run per step.
///
/// # Errors
/// Those of the scheme, and an error that is zero or not finite.
pub fn study(scheme: &dyn Scheme, restitution: f64, horizon: f64, intervals: &[usize], shifts: usize) -> Result<Study> {
    let first_impact = BouncingBall::new(GRAVITY, HEIGHT, restitution)?.first_impact_time();
    let mut levels: [Vec<Refinement>; 4] = Default::default();
    for &count in intervals {
        let runs = shifted_steps(first_impact, count, shifts).into_iter().map(|h| {
            let errors = ball_errors(scheme, restitution, horizon, h)?;
            Ok((h, [errors.position, errors.velocity_l1, errors.velocity_sup, errors.graph]))
        });
        let runs = runs.collect::<Result<Vec<_>>>()?;
        for (metric, levels) in levels.iter_mut().enumerate() {
            let worst = runs.iter().map(|(h, errors)| Refinement { time_step: *h, error: errors[metric] });
            levels.extend(worst.max_by(|a, b| a.error.total_cmp(&b.error)));
        }
    }
    let [position, velocity_l1, velocity_sup, graph] = levels;
    Ok(Study {
        position: fit_order(position)?,
        velocity_l1: fit_order(velocity_l1)?,
        velocity_sup: fit_order(velocity_sup)?,
        graph: fit_order(graph)?,
    })
}
