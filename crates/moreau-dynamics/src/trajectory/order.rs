//! Measured orders of convergence: error ≈ C(ρ) hᵖ with ρ the phase of the event in its step.
//!
//! Through an impact the error is a sawtooth in h: it depends on where in its step the impact falls. A fit through
//! single step sizes measures the sawtooth. Here each level N tries the steps
//!
//! ```text
//!     h_j = t* / (N + (j + ½)/m) ,   j = 0 … m−1 ,
//! ```
//!
//! so that the event at t* falls at m evenly spread phases of its step, and keeps the largest error with its own h.
//! If every kept error lies in \[C₁ hᵖ, C₂ hᵖ\], the fitted slope lies within [`slope_interval`] of p.

use moreau_exact::{Error, Result};

/// One level of a convergence study: the worst of the shifted steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refinement {
    /// The step at which the error was largest \[s\].
    pub time_step: f64,
    /// The largest error over the shifted steps.
    pub error: f64,
}

/// A slope fitted to the envelope, and how far it can be trusted.
#[derive(Clone, Debug, PartialEq)]
pub struct OrderEstimate {
    /// Least-squares slope of ln(error) against ln(h).
    pub slope: f64,
    /// Largest minus smallest slope between neighbouring levels.
    pub spread: f64,
    /// The envelope, level by level.
    pub levels: Vec<Refinement>,
}

/// The steps h_j = t*/(N + (j + ½)/m) that put the event at t* at m evenly spread phases of its step.
pub fn shifted_steps(event_time: f64, intervals: usize, shifts: usize) -> Vec<f64> {
    (0..shifts).map(|j| event_time / (intervals as f64 + (j as f64 + 0.5) / shifts as f64)).collect()
}

/// Fits the order of `error(h)` over the levels N in `intervals`, with `shifts` steps each.
///
/// # Errors
/// Those of `error`, and [`Error::Unsupported`] if an envelope value is not positive and finite: an error that is
/// zero has no order.
pub fn estimate_order(
    event_time: f64,
    intervals: &[usize],
    shifts: usize,
    mut error: impl FnMut(f64) -> Result<f64>,
) -> Result<OrderEstimate> {
    let mut levels = Vec::with_capacity(intervals.len());
    for &count in intervals {
        let mut worst = Refinement { time_step: f64::NAN, error: f64::NEG_INFINITY };
        for time_step in shifted_steps(event_time, count, shifts) {
            let value = error(time_step)?;
            if value.is_nan() || value > worst.error {
                worst = Refinement { time_step, error: value };
            }
            if value.is_nan() {
                break;
            }
        }
        levels.push(worst);
    }
    fit_order(levels)
}

/// Least-squares slope of ln(error) against ln(h) over given levels.
///
/// # Errors
/// [`Error::Unsupported`] with fewer than two levels, equal steps, or an error that is not positive and finite.
///
/// ```
/// use moreau_dynamics::trajectory::{Refinement, fit_order};
///
/// let levels = [0.1, 0.05, 0.025].map(|time_step: f64| Refinement { time_step, error: 3.0 * time_step * time_step });
/// let order = fit_order(levels.to_vec())?;
/// assert!((order.slope - 2.0).abs() < 1e-9 && order.spread < 1e-9);
/// # Ok::<(), moreau_exact::Error>(())
/// ```
pub fn fit_order(levels: Vec<Refinement>) -> Result<OrderEstimate> {
    if levels.len() < 2 || levels.iter().any(|level| !(level.error.is_finite() && level.error > 0.0 && level.time_step > 0.0)) {
        return Err(Error::Unsupported("an order needs at least two levels with positive finite errors".into()));
    }
    let points: Vec<(f64, f64)> = levels.iter().map(|level| (level.time_step.ln(), level.error.ln())).collect();
    let locals: Vec<f64> = points.windows(2).map(|pair| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0)).collect();
    if locals.iter().any(|slope| !slope.is_finite()) {
        return Err(Error::Unsupported("an order needs different steps at neighbouring levels".into()));
    }
    let (mean_x, mean_y) = (mean(points.iter().map(|p| p.0)), mean(points.iter().map(|p| p.1)));
    let covariance: f64 = points.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = points.iter().map(|(x, _)| (x - mean_x) * (x - mean_x)).sum();
    let largest = locals.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let smallest = locals.iter().copied().fold(f64::INFINITY, f64::min);
    Ok(OrderEstimate { slope: covariance / variance, spread: largest - smallest, levels })
}

impl OrderEstimate {
    /// How far the fitted slope may lie from p if every envelope value is in \[C₁ hᵖ, C₂ hᵖ\] with C₂/C₁ = `ratio`.
    pub fn slope_interval(&self, ratio: f64) -> f64 {
        let steps: Vec<f64> = self.levels.iter().map(|level| level.time_step).collect();
        slope_interval(&steps, ratio)
    }

    /// How far the fitted slope may lie from p if the error at level i is in \[lower_i, upper_i\]·hᵖ.
    ///
    /// The slope is Σ w_i ln(error_i) with w_i = (x_i − x̄)/Σ(x − x̄)², and Σ w_i x_i = 1: each ln(constant_i) pushes it by
    /// its own weight, upwards or downwards.
    pub fn slope_deviation(&self, bounds: &[[f64; 2]]) -> f64 {
        let logs: Vec<f64> = self.levels.iter().map(|level| level.time_step.ln()).collect();
        let centre = mean(logs.iter().copied());
        let variance: f64 = logs.iter().map(|x| (x - centre) * (x - centre)).sum();
        let push = |up: bool| -> f64 {
            let terms = logs.iter().zip(bounds).map(|(x, [lower, upper])| {
                let weight = (x - centre) / variance;
                weight * if (weight > 0.0) == up { upper.ln() } else { lower.ln() }
            });
            terms.sum()
        };
        push(true).abs().max(push(false).abs())
    }

    /// How large the spread may be under the same condition: each local slope is off by at most ln(ratio)/ln(h_i/h_{i+1}).
    pub fn spread_deviation(&self, bounds: &[[f64; 2]]) -> f64 {
        let local = self.levels.windows(2).zip(bounds.windows(2)).map(|(pair, bounds)| {
            let width = (pair[0].time_step / pair[1].time_step).ln().abs();
            (bounds[0][1] / bounds[1][0]).ln().abs().max((bounds[1][1] / bounds[0][0]).ln().abs()) / width
        });
        2.0 * local.fold(0.0, f64::max)
    }

    /// max error/hᵖ over the levels: the smallest constant C with error ≤ C hᵖ at every level.
    pub fn largest_constant(&self, order: f64) -> f64 {
        self.levels.iter().map(|level| level.error / level.time_step.powf(order)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// min error/hᵖ over the levels.
    pub fn smallest_constant(&self, order: f64) -> f64 {
        self.levels.iter().map(|level| level.error / level.time_step.powf(order)).fold(f64::INFINITY, f64::min)
    }
}

/// Half-width of the interval of slopes that data in \[C₁ hᵖ, C₂ hᵖ\] can produce around p.
///
/// With x = ln h, ln error = ln√(C₁C₂) + p x + η and |η| ≤ ½ ln(C₂/C₁), the least-squares slope is
/// p + Σ(x − x̄)η/Σ(x − x̄)², so it differs from p by at most ½ ln(C₂/C₁) Σ|x − x̄|/Σ(x − x̄)².
pub fn slope_interval(steps: &[f64], ratio: f64) -> f64 {
    let logs: Vec<f64> = steps.iter().map(|h| h.ln()).collect();
    let centre = mean(logs.iter().copied());
    let spread: f64 = logs.iter().map(|x| (x - centre).abs()).sum();
    let variance: f64 = logs.iter().map(|x| (x - centre) * (x - centre)).sum();
    0.5 * ratio.ln() * spread / variance
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::trajectory::ORDER_ROUNDING;

    #[test]
    fn a_power_of_h_has_its_exponent_as_order_and_no_spread() {
        for exponent in [0.0, 0.5, 1.0, 4.0] {
            let estimate = estimate_order(1.0, &[10, 40, 160, 640], 4, |h| Ok(3.0 * h.powf(exponent))).expect("positive");
            assert!((estimate.slope - exponent).abs() <= ORDER_ROUNDING);
            assert!(estimate.spread <= ORDER_ROUNDING);
            assert!((estimate.largest_constant(exponent) - 3.0).abs() <= 3.0 * ORDER_ROUNDING);
        }
    }

    #[test]
    fn shifted_steps_spread_the_phase_of_the_event() {
        for (j, h) in shifted_steps(0.7, 32, 4).into_iter().enumerate() {
            let phase = (0.7 / h).fract();
            assert!((phase - (j as f64 + 0.5) / 4.0).abs() <= ORDER_ROUNDING);
        }
    }

    #[test]
    fn the_envelope_sees_through_a_sawtooth_that_single_steps_do_not() {
        // error = h·(0.05 + phase): a sawtooth of ratio 21. Steps chosen without shifts land on any phase.
        let event = 0.7310585786;
        let sawtooth = |h: f64| Ok(h * (0.05 + (event / h).fract()));
        let levels = [20, 40, 80, 160];
        let estimate = estimate_order(event, &levels, 8, sawtooth).expect("positive");
        // The kept phase is at least 1 − 1/16 at every level, and at most 1.
        let bound = estimate.slope_interval(1.05 / (0.05 + 1.0 - 1.0 / 16.0));
        assert!((estimate.slope - 1.0).abs() <= bound, "{} against {bound}", estimate.slope);
        let single: Vec<Refinement> = [0.04f64, 0.0199, 0.0101, 0.005]
            .iter()
            .map(|&time_step| Refinement { time_step, error: sawtooth(time_step).expect("positive") })
            .collect();
        assert!((fit_order(single).expect("positive").slope - 1.0).abs() > bound);
    }

    #[test]
    fn data_at_both_ends_of_the_band_reach_the_slope_interval() {
        let steps = [1e-1, 1e-2, 1e-3, 1e-4];
        let ratio: f64 = 3.0;
        let extreme: Vec<Refinement> = steps
            .iter()
            .enumerate()
            .map(|(k, &time_step)| Refinement { time_step, error: time_step * if k < 2 { ratio.sqrt() } else { 1.0 / ratio.sqrt() } })
            .collect();
        let slope = fit_order(extreme).expect("positive").slope;
        assert!((slope - 1.0 - slope_interval(&steps, ratio)).abs() <= ORDER_ROUNDING);
    }

    #[test]
    fn level_by_level_bounds_reach_the_slope_deviation() {
        let bounds = [[1.0, 3.0], [1.0, 1.5], [1.0, 1.25]];
        let levels: Vec<Refinement> =
            [(1e-1, 3.0), (1e-2, 1.0), (1e-3, 1.0)].map(|(h, c)| Refinement { time_step: h, error: c * h }).to_vec();
        let estimate = fit_order(levels).expect("positive");
        // The middle level has no weight, the outer ones pull in opposite senses.
        assert!((estimate.slope - 1.0 - estimate.slope_deviation(&bounds)).abs() <= ORDER_ROUNDING);
        assert!(estimate.spread <= estimate.spread_deviation(&bounds));
        let falling: Vec<Refinement> =
            [(1e-1, 1.0), (1e-2, 1.0), (1e-3, 3.0)].map(|(h, c)| Refinement { time_step: h, error: c * h }).to_vec();
        let estimate = fit_order(falling).expect("positive");
        let bounds = [[1.0, 1.25], [1.0, 1.5], [1.0, 3.0]];
        assert!((1.0 - estimate.slope - estimate.slope_deviation(&bounds)).abs() <= ORDER_ROUNDING, "downwards it is reached as well");
    }

    #[test]
    fn constants_that_alternate_reach_the_spread_deviation() {
        let levels: Vec<Refinement> =
            [(1e-1, 3.0), (1e-2, 1.0), (1e-3, 3.0)].map(|(h, c)| Refinement { time_step: h, error: c * h }).to_vec();
        let estimate = fit_order(levels).expect("positive");
        assert!((estimate.spread - estimate.spread_deviation(&[[1.0, 3.0]; 3])).abs() <= ORDER_ROUNDING);
    }

    #[test]
    fn an_error_that_is_zero_nan_or_infinite_has_no_order() {
        for bad in [0.0, f64::NAN, f64::INFINITY, -1.0] {
            let mut calls = 0;
            let outcome = estimate_order(1.0, &[10, 20], 3, |h| {
                calls += 1;
                Ok(if calls == 5 || bad == 0.0 || bad < 0.0 { bad } else { h })
            });
            assert!(outcome.is_err(), "{bad}");
        }
    }
}
