//! Claims on Drake.

use super::super::{rounding, solvers::STOP};

/// Time \[s\] in which the block of `experiments::drake` settles.
/// Set.
pub const SETTLING_TIME: f64 = 4.0;

/// What is left of a start δ \[m\] from the settled gap: the contact of 1 kg is a damped spring of at least kτ = 10 N·s/m (SAP), which
/// decays by e^{−5t}; the implicit step damps more than the continuous motion. Without τ it damps by ln(1 + h²k)/(2h) alone, which is
/// 7.5 s⁻¹ for k = 2000 N/m and h = 8 ms. Twice that, for two slides, and the rounding of the steps.
/// Derived.
pub fn settled(start: f64, steps: usize) -> f64 {
    2.0 * start * (-5.0 * SETTLING_TIME).exp() + rounding(64 * steps, start)
}

/// Depth \[m\] of a ball on k = 1e5 N/m that rests under its weight \[N\]: SAP leaves 1e-6 of the impulses unbalanced in each step.
/// Derived.
pub fn rest(weight: f64) -> f64 {
    crate::tolerance::references::SAP_RELATIVE * weight / 1e5
}

/// r_n \[N·s\] of a step of SAP against its spring and damper: r follows from u by the law, and the u that is returned differs from
/// that one by what Newton's method leaves, STOP of an impulse of at most 1 N·s; h k (h + τ) < 1 for the contact of
/// `experiments::drake`.
/// Derived.
pub fn spring_balance() -> f64 {
    STOP + rounding(64, 1.0)
}

/// How far the change of the derivative of the projection on K_½ may differ from that at the boundary between stick and slip, for points
/// `apart` of each other: while the contact slips the derivative changes by s c/‖z_t‖ = 2/5 per unit of z_n.
/// Derived.
pub fn mode_change(apart: f64) -> f64 {
    apart
}

/// Error of c(x) for ‖r_t‖/(μ r_n) of TAMSI at the slip x v_s: its root √(x² + 0.01²) in place of x makes the direction shorter by at most
/// ½(0.01/x)², and c = x(2 − x) larger by at most 2 (√(x² + 0.01²) − x) ≤ 0.01²/x as long as x < 1.
/// Derived.
pub fn regularised(slip: f64) -> f64 {
    (0.01 / slip).powi(2) * (0.5 + if slip < 1.0 { slip } else { 0.0 })
}
