//! The plastic ball, e = 0: where a scheme stops it decides the order of the graph distance.
//!
//! With s and p as in [`crate::tolerance::convergence`] the ball stops at q = −V p. Below the floor (p ≥ 0) it stays: O(h).
//! Above it (p < 0) it falls again and reaches the speed √(2 g V |p|): the graphs are √(2|p|h/t₁) apart, O(√h).
//! Stewart–Trinkle and Anitescu land on q = 0 exactly: the error is the ½Vh of the fall.

use super::ball::metric;
use super::errors::{GRAVITY, HEIGHT, study};
use crate::finding::Finding;
use crate::tolerance::convergence::Bounds;
use moreau_dynamics::schemes::Scheme;
use moreau_exact::Result;
use moreau_forms::BouncingBall;

/// How a scheme brings the plastic ball to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// Moreau–Jean that stops at or below the floor: 1−λ−θ ≥ 0.
    Below {
        /// θ.
        theta: f64,
        /// λ of the activation rule.
        forecast: f64,
    },
    /// Moreau–Jean that may stop above the floor: 1−λ−θ < 0.
    Above {
        /// θ.
        theta: f64,
        /// λ of the activation rule.
        forecast: f64,
    },
    /// On the floor, because the constraint holds at the end of the step.
    On,
}

const INTERVALS: [usize; 3] = [128, 512, 2048];
const SHIFTS: usize = 6;

/// Orders of a scheme on the plastic ball, to twice the time of the fall.
///
/// # Errors
/// Those of the scheme, and an error that is zero or not finite.
pub fn plastic_ball(subject: &dyn Scheme, stop: Stop) -> Result<Vec<Finding>> {
    let found = study(subject, 0.0, 2.0, &INTERVALS, SHIFTS)?;
    let fall = BouncingBall::new(GRAVITY, HEIGHT, 0.0)?.first_impact_time();
    let speed = GRAVITY * fall;
    let (position, l1) = constants(stop);
    let at = |bounds: Bounds, remainder: f64| {
        move |h: f64| Bounds { lower: bounds.lower - remainder * h / fall, upper: bounds.upper + remainder * h / fall }
    };
    let mut findings = metric("sup|q|", &found.position, 1.0, |h| speed * h, at(position, SECOND_ORDER));
    let sup = Bounds { lower: 1.0, upper: 1.0 };
    let sup = if stop == Stop::On { Bounds { lower: 0.5, ..sup } } else { sup };
    findings.extend(metric("sup|v|", &found.velocity_sup, 0.0, |_| speed, at(sup, SECOND_ORDER)));
    match stop {
        Stop::Above { theta, forecast } => {
            let (low, high) = (largest_above(theta, forecast, true), largest_above(theta, forecast, false));
            let bounds = |h: f64| Bounds {
                lower: (2.0 * low).sqrt() - SECOND_FALL * (h / fall).sqrt(),
                upper: (2.0 * high).sqrt() + SECOND_FALL * (h / fall).sqrt(),
            };
            findings.extend(metric("graph distance", &found.graph, 0.5, |h| (h / fall).sqrt(), bounds));
        }
        Stop::Below { .. } | Stop::On => {
            findings.extend(metric("∫|v|", &found.velocity_l1, 1.0, |h| speed * h, at(l1, SECOND_ORDER)));
            let graph = Bounds { lower: std::f64::consts::FRAC_1_SQRT_2, upper: 2.5 };
            findings.extend(metric("graph distance", &found.graph, 1.0, |h| h / fall, at(graph, SECOND_ORDER)));
        }
    }
    Ok(findings)
}

/// Second-order terms in g h²: ½s² ≤ ½, h|v_k − V| ≤ 2, ½x² ≤ 3.2, as in [`crate::tolerance::convergence`].
const SECOND_ORDER: f64 = 6.0;

/// The second fall is stopped within 2 steps of its landing, 2 g h, and starts within 2 h of t₁, from whose vertical
/// segment its fastest point is as far as from the axis: 4 g h against √(2 g V |p| h).
const SECOND_FALL: f64 = 4.0;

/// Position sup and velocity L¹ in V h: |p| against the fall's |θ−½|, and ½ from the steps plus |s − (θ−½)| from the jump.
fn constants(stop: Stop) -> (Bounds, Bounds) {
    let (theta, forecast) = match stop {
        // q error ½ before the impact; ∫|v| is ½ and at most 1/8 more from the step that lands.
        Stop::On => return (Bounds { lower: 0.5, upper: 0.5 }, Bounds { lower: 1.0, upper: 1.125 }),
        Stop::Below { theta, forecast } | Stop::Above { theta, forecast } => (theta, forecast),
    };
    let low = 1.0 - forecast - theta;
    let margin = 0.5 / SHIFTS as f64;
    let before = (theta - 0.5).abs();
    let largest = |a: f64, b: f64| a.abs().max(b.abs());
    let position = Bounds { lower: largest(low + margin, low + 1.0 - margin).max(before), upper: largest(low, low + 1.0).max(before) };
    // s − (θ−½) = p − (1−θ) − (θ−½) = p − ½.
    let l1 = Bounds { lower: 0.5 + largest(low + margin - 0.5, low + 0.5 - margin), upper: 0.5 + largest(low - 0.5, low + 0.5) };
    (position, l1)
}

/// The largest −p: the one the shifted steps reach for sure, or the supremum.
fn largest_above(theta: f64, forecast: f64, reached: bool) -> f64 {
    let margin = if reached { 0.5 / SHIFTS as f64 } else { 0.0 };
    theta + forecast - 1.0 - margin
}
