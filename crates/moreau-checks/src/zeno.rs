//! Family 4: a fixed number of steps carries the bouncing ball past its Zeno point.
//!
//! ```text
//!     T∞ = V/g · (1+e)/(1−e) ,     absorbed: two consecutive active states with |v| ≤ g h/(1+e) .
//! ```
//! Every bound is proved in [`crate::tolerance::zeno`]. The event-driven integrator at the end is the contrast: it
//! needs one event per bounce and never reaches T∞.

use crate::finding::Finding;
use crate::tolerance::zeno;
use moreau_contact::solvers::ProjectedGaussSeidel;
use moreau_dynamics::mechanics::{PointMass, State};
use moreau_dynamics::schemes::{Activation, MoreauJean, Scheme, step};
use moreau_exact::Result;
use nalgebra::dvector;

/// A ball dropped from rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DroppedBall {
    /// m \[kg\].
    pub mass: f64,
    /// g \[m/s²\].
    pub gravity: f64,
    /// q₀ \[m\].
    pub height: f64,
    /// e ∈ (0, 1).
    pub restitution: f64,
}

impl DroppedBall {
    /// V = √(2 g q₀) \[m/s\].
    pub fn impact_speed(&self) -> f64 {
        (2.0 * self.gravity * self.height).sqrt()
    }

    /// T∞ = V/g (1+e)/(1−e) \[s\].
    pub fn accumulation_time(&self) -> f64 {
        self.impact_speed() / self.gravity * (1.0 + self.restitution) / (1.0 - self.restitution)
    }

    /// The ball on its floor, and its state at the start.
    pub fn at_rest(&self) -> (PointMass, State) {
        let initial = State { time: 0.0, position: dvector![self.height], velocity: dvector![0.0] };
        (PointMass::ball_on_floor(self.mass, self.gravity, self.restitution), initial)
    }

    /// The numbers of the proof for this ball under a scheme.
    pub fn drop(&self, scheme: &MoreauJean, h: f64) -> zeno::Drop {
        let (forecast, offset) = match scheme.activation {
            Activation::Gap => (0.0, 0.0),
            Activation::HalfStepForecast => (0.5, 0.0),
            Activation::FreeVelocityForecast => (1.0, 1.0),
        };
        let impact_speed = self.impact_speed() / (self.gravity * h);
        zeno::Drop { forecast, offset, theta: scheme.theta, restitution: self.restitution, impact_speed }
    }
}

/// How a scheme brought the ball to rest; lengths in g h², speeds in g h, times in steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settling {
    /// The first of two consecutive absorbing states, if there was one within the steps allowed.
    pub absorbed: Option<usize>,
    /// Largest penetration on the way.
    pub depth: f64,
    /// Height at the end.
    pub height: f64,
    /// |v| at the end.
    pub speed: f64,
}

/// Steps the ball until it is absorbed (at most `limit` steps) and `further` steps more.
///
/// # Errors
/// Those of the scheme and the solver.
pub fn settle(subject: &dyn Scheme, ball: &DroppedBall, h: f64, limit: usize, further: usize) -> Result<Settling> {
    let (mechanism, mut state) = ball.at_rest();
    let solver = ProjectedGaussSeidel::default();
    let (speed_unit, length_unit) = (ball.gravity * h, ball.gravity * h * h);
    let slow = speed_unit / (1.0 + ball.restitution);
    let (mut absorbed, mut depth, mut previous, mut taken) = (None, 0.0f64, false, 0);
    while taken < absorbed.unwrap_or(limit) + further {
        let next = step(subject, &solver, &mechanism, &state, h)?;
        let absorbing = !next.assembled.active.is_empty() && state.velocity[0].abs() <= slow;
        if absorbing && previous && absorbed.is_none() && taken <= limit {
            absorbed = Some(taken - 1);
        }
        previous = absorbing;
        state = next.state;
        depth = depth.max(-state.position[0]);
        taken += 1;
    }
    Ok(Settling {
        absorbed,
        depth: depth / length_unit,
        height: state.position[0] / length_unit,
        speed: state.velocity[0].abs() / speed_unit,
    })
}

/// Holds a scheme against what is proved for Moreau–Jean with the parameters `proved`: absorbed, when, how deep, where
/// it rests and how fast it still is `further` steps later.
///
/// # Errors
/// Those of the scheme and the solver.
pub fn absorption(subject: &dyn Scheme, proved: &MoreauJean, ball: &DroppedBall, h: f64, further: usize) -> Result<Vec<Finding>> {
    let drop = ball.drop(proved, h);
    let bounds = drop.bounds();
    let limit = (drop.accumulation() + bounds.late).ceil() as usize;
    let settling = settle(subject, ball, h, limit, further)?;
    let rounding = drop.place_rounding(limit + further);
    let mut findings = vec![Finding::decision(format!("absorbed within {limit} steps"), settling.absorbed.is_some(), true)];
    // not absorbed: later than all steps taken
    let error = settling.absorbed.unwrap_or(limit + further) as f64 - drop.accumulation();
    findings.push(Finding::at_most("settling time after T∞", error, bounds.late, "steps"));
    findings.push(Finding::at_most("settling time before T∞", -error, bounds.early, "steps"));
    findings.push(Finding::at_most("penetration on the way", settling.depth, bounds.depth + rounding, "g h²"));
    let [lowest, highest] = bounds.rest;
    let half = 0.5 * (highest - lowest) + rounding;
    findings.push(Finding::equal("height at rest", settling.height, 0.5 * (lowest + highest), half, "g h²"));
    findings.push(Finding::at_most("speed at rest", settling.speed, drop.remaining_speed(further), "g h"));
    Ok(findings)
}

/// Number of impacts an event-driven integrator computes until less than `remaining` seconds are left to T∞, landing
/// by landing from the speed of the last one: t ← t + 2 e v/g, v ← e v.
///
/// ```
/// use moreau_checks::zeno::{DroppedBall, events_until};
///
/// let ball = DroppedBall { mass: 1.0, gravity: 10.0, height: 5.0, restitution: 0.5 };
/// let events = |distance: f64| events_until(&ball, distance);
/// assert_eq!(events(ball.accumulation_time() / 2.0), 2);
/// assert_eq!(events(ball.accumulation_time() / 4.0), 3); // each halving costs one event more at e = ½
/// ```
pub fn events_until(ball: &DroppedBall, remaining: f64) -> usize {
    let mut speed = ball.impact_speed();
    let mut time = speed / ball.gravity;
    let mut events = 1;
    while ball.accumulation_time() - time >= remaining {
        speed *= ball.restitution;
        let landing = time + 2.0 * speed / ball.gravity;
        if landing <= time {
            break;
        }
        time = landing;
        events += 1;
    }
    events
}

/// The least number of landings after which less than `remaining` seconds are left, in closed form.
///
/// After n landings T∞ − t = 2 V eⁿ/(g (1−e)), so n is the least with eⁿ < `remaining` g (1−e)/(2 V).
pub fn events_predicted(ball: &DroppedBall, remaining: f64) -> f64 {
    let share = remaining * ball.gravity * (1.0 - ball.restitution) / (2.0 * ball.impact_speed());
    (share.ln() / ball.restitution.ln()).max(1.0)
}

/// Each halving of the distance to T∞ costs an event-driven integrator ln 2/ln(1/e) more events: the counts, held
/// against the closed form to one event.
pub fn events_grow(ball: &DroppedBall, halvings: u32) -> Vec<Finding> {
    let start = ball.accumulation_time();
    let distance = |k: u32| start / f64::from(1u32 << k);
    (1..=halvings)
        .map(|k| {
            let name = format!("events until T∞·2^-{k} is left");
            let events = events_until(ball, distance(k)) as f64;
            Finding::equal(name, events, events_predicted(ball, distance(k)), 1.0, "1")
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_dynamics::schemes::RestitutionRule;

    const BALL: DroppedBall = DroppedBall { mass: 1.0, gravity: 9.81, height: 1.0, restitution: 0.8 };

    fn scheme(activation: Activation, theta: f64) -> MoreauJean {
        MoreauJean { theta, activation, restitution: RestitutionRule::NormalOnly }
    }

    #[test]
    fn a_step_1024_times_smaller_costs_31_or_32_more_bounces_of_error() {
        for activation in Activation::ALL {
            let [coarse, fine] = [0.01, 0.01 / 1024.0].map(|h| BALL.drop(&scheme(activation, 0.5), h).bounds());
            // ln 1024/ln 1.25 = 31.06; the bounds `early` and `late` are affine in the number of bounces.
            assert!((31..=32).contains(&(fine.bounces - coarse.bounces)), "{activation:?}");
        }
    }

    #[test]
    fn an_event_driven_integrator_has_a_landing_left_whatever_its_budget() {
        let counts: Vec<usize> = (1..30).map(|k| events_until(&BALL, BALL.accumulation_time() / f64::from(1u32 << k))).collect();
        assert!(counts.windows(2).all(|pair| pair[1] > pair[0]), "{counts:?}");
    }
}
