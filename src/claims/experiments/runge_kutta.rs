//! The classical Runge–Kutta method on q̈ = a(q) with impacts at q = 0: located, flipped at the end of a step, or ignored; and the
//! semi-implicit Euler rule on the same motion.
//!
//! The ball hangs on a spring, a(q) = −g − ω² q, so that the method is not exact in flight and the solution has a closed
//! form: with c = g/ω², q + c = R cos(ωs − δ) between impacts, which lie where R cos = c.

use crate::Result;
use crate::trajectory::{OrderEstimate, estimate_order};

/// g \[m/s²\], ω \[1/s\], drop height \[m\] and e of every run.
const GRAVITY: f64 = 9.81;
const FREQUENCY: f64 = 2.0;
const HEIGHT: f64 = 1.0;
const RESTITUTION: f64 = 0.8;

/// What the integrator does about an impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Impacts {
    /// Bisects for the time of the impact, applies v⁺ = −e v⁻ there, and goes on.
    Located,
    /// Finds the ball below the floor at the end of a step and applies v⁺ = −e v⁻ there.
    Flipped,
    /// Sees no floor.
    Ignored,
}

/// One step of the classical method for q̈ = a(q).
pub(crate) fn step(acceleration: &impl Fn(f64) -> f64, [q, v]: [f64; 2], h: f64) -> [f64; 2] {
    let slope = |[q, v]: [f64; 2]| [v, acceleration(q)];
    let ahead = |k: [f64; 2], share: f64| [q + share * h * k[0], v + share * h * k[1]];
    let first = slope([q, v]);
    let second = slope(ahead(first, 0.5));
    let third = slope(ahead(second, 0.5));
    let fourth = slope(ahead(third, 1.0));
    let mean = |i: usize| (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]) / 6.0;
    [q + h * mean(0), v + h * mean(1)]
}

/// One step of a method for the ball on its spring.
type Method = fn([f64; 2], f64) -> [f64; 2];

fn runge_kutta(state: [f64; 2], h: f64) -> [f64; 2] {
    step(&spring, state, h)
}

fn semi_implicit_euler([q, v]: [f64; 2], h: f64) -> [f64; 2] {
    let velocity = v + h * spring(q);
    [q + h * velocity, velocity]
}

fn spring(q: f64) -> f64 {
    -GRAVITY - FREQUENCY * FREQUENCY * q
}

/// Time of the first impact of the ball on its spring.
fn first_impact_time() -> f64 {
    let centre = GRAVITY / (FREQUENCY * FREQUENCY);
    (centre / (HEIGHT + centre)).acos() / FREQUENCY
}

/// (q, v) at a time, in closed form.
fn exact(time: f64) -> [f64; 2] {
    let centre = GRAVITY / (FREQUENCY * FREQUENCY);
    let (mut start, mut radius, mut phase, mut landing) = (0.0, HEIGHT + centre, 0.0, first_impact_time());
    while time >= landing {
        let speed = FREQUENCY * (radius * radius - centre * centre).sqrt();
        let launch = RESTITUTION * speed / FREQUENCY;
        (start, radius, phase) = (landing, centre.hypot(launch), launch.atan2(centre));
        landing = start + 2.0 * phase / FREQUENCY;
    }
    let angle = FREQUENCY * (time - start) - phase;
    [radius * angle.cos() - centre, -FREQUENCY * radius * angle.sin()]
}

/// (q, v) at `end` with steps h, and the largest velocity error where the motion on either side of a node may be compared.
fn integrate(method: Method, impacts: Impacts, h: f64, end: f64) -> ([f64; 2], f64) {
    let (mut state, mut time, mut worst) = ([HEIGHT, 0.0], 0.0, 0.0f64);
    while time < end {
        let (before, length) = (time, h.min(end - time));
        let mut next = method(state, length);
        time = if length < h { end } else { time + h };
        if impacts == Impacts::Located && next[0] < 0.0 {
            let (mut low, mut high) = (0.0, length);
            loop {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    break;
                }
                if method(state, middle)[0] < 0.0 { high = middle } else { low = middle }
            }
            let [_, speed] = method(state, low);
            next = method([0.0, -RESTITUTION * speed], length - low);
        } else if impacts == Impacts::Flipped && next[0] < 0.0 && next[1] < 0.0 {
            next[1] *= -RESTITUTION;
        }
        // The step function takes the new velocity from the start of the step on.
        worst = worst.max((next[1] - exact(before)[1]).abs());
        state = next;
    }
    (state, worst)
}

/// Which error is fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Norm {
    /// |q_N − q(T)| after `impacts` impacts.
    EndPosition,
    /// sup |v_h − v|, v_h the step function.
    VelocitySup,
}

/// The order of the method in a norm, up to a quarter of the flight after the given number of impacts, or half the first fall.
///
/// Not to its apex: there v = 0 and an error of time, the method's leading one on a spring, does not show in q.
pub(crate) fn order(impacts: Impacts, norm: Norm, count: usize) -> Result<OrderEstimate> {
    order_of(runge_kutta, impacts, norm, count, 1)
}

/// The largest error of q of the Runge–Kutta method after one flip over that of the semi-implicit Euler rule, level by level; the Euler
/// rule takes `finer` steps to each of the Runge–Kutta method's.
pub(crate) fn errors_over_those_of_first_order(finer: usize) -> Result<Vec<f64>> {
    let errors = |method: Method, finer: usize| order_of(method, Impacts::Flipped, Norm::EndPosition, 1, finer);
    let (fourth, first) = (errors(runge_kutta, 1)?, errors(semi_implicit_euler, finer)?);
    Ok(fourth.levels.iter().zip(&first.levels).map(|(a, b)| a.error / b.error).collect())
}

fn order_of(method: Method, impacts: Impacts, norm: Norm, count: usize, finer: usize) -> Result<OrderEstimate> {
    let fall = first_impact_time();
    let mut end = if count == 0 { 0.5 * fall } else { fall };
    for k in 1..=count {
        let flight = flight_time(k);
        end += if k == count { 0.25 * flight } else { flight };
    }
    estimate_order(fall, &[32, 64, 128, 256].map(|steps| finer * steps), 4, |h| {
        let (state, worst) = integrate(method, impacts, h, end);
        Ok(match norm {
            Norm::EndPosition => (state[0] - exact(end)[0]).abs(),
            Norm::VelocitySup => worst,
        })
    })
}

/// Duration of the flight after impact k.
fn flight_time(impact: usize) -> f64 {
    let centre = GRAVITY / (FREQUENCY * FREQUENCY);
    let mut radius = HEIGHT + centre;
    let mut flight = 0.0;
    for _ in 0..impact {
        let launch = RESTITUTION * (radius * radius - centre * centre).sqrt();
        radius = centre.hypot(launch);
        flight = 2.0 * launch.atan2(centre) / FREQUENCY;
    }
    flight
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::closed_forms::BALL_ROUNDING;

    fn energy([q, v]: [f64; 2]) -> f64 {
        0.5 * v * v + GRAVITY * q + 0.5 * FREQUENCY * FREQUENCY * q * q
    }

    #[test]
    fn the_closed_form_keeps_its_energy_in_flight_and_e_squared_of_it_at_an_impact() {
        let fall = first_impact_time();
        let drop = energy([HEIGHT, 0.0]);
        for k in 0..10 {
            assert!((energy(exact(0.1 * k as f64 * fall)) - drop).abs() <= BALL_ROUNDING * drop);
            let flight = exact(fall + (0.05 + 0.09 * k as f64) * flight_time(1));
            let kept = RESTITUTION * RESTITUTION * drop;
            assert!((energy(flight) - kept).abs() <= BALL_ROUNDING * drop);
        }
    }

    #[test]
    fn the_closed_form_lands_where_a_flight_ends() {
        let mut time = first_impact_time();
        for impact in 1..5 {
            assert!(exact(time)[0].abs() <= BALL_ROUNDING);
            time += flight_time(impact);
        }
    }
}
