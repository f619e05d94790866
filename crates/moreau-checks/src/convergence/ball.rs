//! Moreau–Jean on the bouncing ball with e > 0: one impact, the Zeno sequence, the elastic ball.

use super::errors::{GRAVITY, HEIGHT, study};
use crate::finding::Finding;
use crate::tolerance::convergence::{Bounds, Impacts};
use moreau_dynamics::schemes::{MoreauJean, Scheme};
use moreau_dynamics::trajectory::OrderEstimate;
use moreau_exact::Result;
use moreau_forms::BouncingBall;

/// How long the ball is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Horizon {
    /// To the apex after the first impact.
    OneImpact,
    /// To 1.1 T∞, e < 1.
    Zeno,
    /// Over four impacts, e = 1.
    Elastic,
}

/// Steps to the first impact at each level, and steps per level.
const INTERVALS: [usize; 3] = [128, 512, 2048];
const SHIFTS: usize = 6;

/// Orders and constants of a scheme that should behave as `expected` does.
///
/// Bounds of each metric at each level, and where the bounds are narrow enough to exclude a neighbouring half order, the
/// slope and its spread.
///
/// # Errors
/// Those of the scheme, and an error that is zero or not finite.
pub fn bouncing_ball(subject: &dyn Scheme, expected: &MoreauJean, restitution: f64, horizon: Horizon) -> Result<Vec<Finding>> {
    let (length, impacts) = match horizon {
        Horizon::OneImpact => (1.0 + restitution, Some(1)),
        Horizon::Zeno => (1.1 * (1.0 + restitution) / (1.0 - restitution), None),
        Horizon::Elastic => (8.0, Some(4)),
    };
    let forecast = expected.activation.forecast();
    let leading = Impacts { theta: expected.theta, forecast, restitution, shifts: SHIFTS, impacts, horizon: length };
    let found = study(subject, restitution, length, &INTERVALS, SHIFTS)?;
    let fall = BouncingBall::new(GRAVITY, HEIGHT, restitution)?.first_impact_time();
    let speed = GRAVITY * fall;
    let bounds_at = |bounds: fn(&Impacts, f64) -> Bounds| move |h: f64| bounds(&leading, fall / h);
    let mut findings = metric("sup|q|", &found.position, 1.0, |h| speed * h, bounds_at(Impacts::position));
    findings.extend(metric("∫|v|", &found.velocity_l1, 1.0, |h| speed * h, bounds_at(Impacts::velocity_l1)));
    findings.extend(metric("sup|v|", &found.velocity_sup, 0.0, |_| speed, bounds_at(Impacts::velocity_sup)));
    findings.extend(metric("graph distance", &found.graph, 1.0, |h| h / fall, bounds_at(Impacts::graph)));
    Ok(findings)
}

/// Slope, spread and constants of one metric whose error is in [lower, upper]·unit(h), unit ~ h^order.
pub(super) fn metric(
    name: &str,
    estimate: &OrderEstimate,
    order: f64,
    unit: impl Fn(f64) -> f64,
    bounds: impl Fn(f64) -> Bounds,
) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut constants = Vec::new();
    for level in &estimate.levels {
        let (h, constant) = (level.time_step, level.error / unit(level.time_step));
        let Bounds { lower, upper } = bounds(h);
        constants.push([lower, upper]);
        let [centre, half] = [0.5 * (upper + lower), 0.5 * (upper - lower)];
        findings.push(Finding::equal(format!("{name}: constant at h = {h:.3e}"), constant, centre, half, "1"));
    }
    let deviation = estimate.slope_deviation(&constants);
    if deviation < 0.5 {
        let spread = estimate.spread_deviation(&constants);
        findings.insert(0, Finding::equal(format!("{name}: order"), estimate.slope, order, deviation, "1"));
        findings.insert(1, Finding::at_most(format!("{name}: spread of local orders"), estimate.spread, spread, "1"));
    }
    findings
}
