//! q̈ = −ω²q by one-step methods with s = hω, in rationals.
//!
//! ```text
//!     θ method   E⁺/E = (1 + (1−θ)²s²)/(1 + θ²s²) :   1 + s² at θ = 0 (explicit), 1 at ½, 1/(1 + s²) at 1
//!     semi-implicit Euler   v⁺ = v − h ω²q , q⁺ = q + h v⁺   conserves  v² + ω²q² − h ω² q v
//! ```

use super::theta_step::{LinearSystem, phase};
use crate::scalar::{Rational, ratio};

/// E/E₀ after a number of θ steps with s = 1/10, from q = 1, v = 1/3, ω = 1.
pub fn energy_ratio(theta: &Rational, steps: usize) -> Rational {
    let spring = LinearSystem::scalar(ratio(1, 1), ratio(1, 1), ratio(0, 1));
    let start = phase(ratio(1, 1), ratio(1, 3));
    let end = (0..steps).fold(start.clone(), |now, _| spring.step(&now, theta, &ratio(1, 10)).0);
    spring.energy(&end) / spring.energy(&start)
}

/// Largest E/E₀ over a number of explicit Euler steps with s = 1/10, from q = 1, v = 0.
pub fn explicit_peak(steps: usize) -> f64 {
    let (h, mut q, mut v) = (0.1, 1.0f64, 0.0f64);
    let mut peak = 1.0f64;
    for _ in 0..steps {
        (q, v) = (q + h * v, v - h * q);
        peak = peak.max(v * v + q * q);
    }
    peak
}

/// Largest E/E₀ over a number of semi-implicit Euler steps with s = 1/10, from q = 1, v = 0.
pub fn semi_implicit_peak(steps: usize) -> f64 {
    let (h, mut q, mut v) = (0.1, 1.0f64, 0.0f64);
    let mut peak = 1.0f64;
    for _ in 0..steps {
        v -= h * q;
        q += h * v;
        peak = peak.max(v * v + q * q);
    }
    peak
}
