//! The largest step that the spring and damper q̈ = −ω²q − 2ζω q̇ bears under each method, as s = hω.
//!
//! ```text
//!     θ method, θ < ½ (explicit Euler: θ = 0)      (1−2θ) s < 2ζ   for ζ ≤ 1 ,    (1−2θ) s < 2/(ζ + √(ζ²−1))   for ζ ≥ 1
//!     θ method, θ ≥ ½                              every s
//!     semi-implicit Euler, damping explicit        s < 2/(√(1+ζ²) + ζ) = 2(√(1+ζ²) − ζ)
//!     semi-implicit Euler, damping implicit        s < 2(√(1+ζ²) + ζ)
//!     classical Runge–Kutta                        s ≤ 2√2   for ζ = 0 ,    s³ − 4s² + 12s < 24   for ζ = 1
//! ```
//! *Derivation.* With z = s(−ζ ± i√(1−ζ²)), |z| = s, the θ method has R = (1+(1−θ)z)/(1−θz), and |R| < 1 is (1−2θ)|z|² + 2 Re z < 0.
//! Semi-implicit Euler has trace 2 − s² − 2ζs and determinant 1 − 2ζs, with implicit damping, d = 1 + 2ζs, (1 + d − s²)/d and 1/d: Jury's
//! condition 1 + T + D > 0 is 4 − 4ζs − s² > 0 and 4 + 4ζs − s² > 0. Runge–Kutta has |R(is)|² = 1 − s⁶/72 + s⁸/576, and R(−s) < 1 is the
//! cubic.

/// Bound of the θ method, infinite for θ ≥ ½; zero where ζ = 0.
///
/// ```
/// use moreau_forms::spring_damper::{runge_kutta_undamped, semi_implicit, theta};
///
/// assert_eq!(theta(0.0, 0.0), 0.0); // explicit Euler without damping is never stable
/// assert_eq!(theta(0.5, 0.0), f64::INFINITY); // the midpoint rule always is
/// assert_eq!(semi_implicit(0.0), 2.0); // semi-implicit Euler up to hω = 2
/// assert!(runge_kutta_undamped() > semi_implicit(0.0));
/// ```
pub fn theta(theta: f64, damping_ratio: f64) -> f64 {
    let explicit =
        if damping_ratio <= 1.0 { 2.0 * damping_ratio } else { 2.0 / (damping_ratio + (damping_ratio * damping_ratio - 1.0).sqrt()) };
    if theta < 0.5 { explicit / (1.0 - 2.0 * theta) } else { f64::INFINITY }
}

/// Bound of semi-implicit Euler with explicit damping.
pub fn semi_implicit(damping_ratio: f64) -> f64 {
    2.0 / (damping_ratio.hypot(1.0) + damping_ratio)
}

/// Bound of semi-implicit Euler with implicit damping.
pub fn semi_implicit_with_implicit_damping(damping_ratio: f64) -> f64 {
    2.0 * (damping_ratio.hypot(1.0) + damping_ratio)
}

/// Bound of the classical Runge–Kutta method without damping, 2√2.
pub fn runge_kutta_undamped() -> f64 {
    8f64.sqrt()
}

/// Bound of the classical Runge–Kutta method at critical damping, the real root of s³ − 4s² + 12s = 24 (Cardano, s = 4/3 + x with
/// x³ + 20x/3 = 344/27).
pub fn runge_kutta_critical() -> f64 {
    let (half, third) = (172.0 / 27.0, 20.0 / 9.0);
    let root = f64::sqrt(half * half + third * third * third);
    4.0 / 3.0 + f64::cbrt(root + half) - f64::cbrt(root - half)
}

/// E⁺/E of the θ method without damping.
pub fn theta_energy_ratio(theta: f64, s: f64) -> f64 {
    (1.0 + (1.0 - theta).powi(2) * s * s) / (1.0 + theta * theta * s * s)
}

/// Largest over smallest energy of semi-implicit Euler without damping, from its invariant v² + ω²q² − hω²qv; s < 2.
pub fn semi_implicit_energy_swing(s: f64) -> f64 {
    (1.0 + 0.5 * s) / (1.0 - 0.5 * s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn the_bounds_where_they_are_rational() {
        assert_eq!([theta(0.0, 0.3), theta(0.0, 1.0), theta(0.0, 1.25), theta(0.25, 1.25)], [0.6, 2.0, 1.0, 2.0]);
        assert_eq!([semi_implicit(0.0), semi_implicit(0.75)], [2.0, 1.0]);
        assert_eq!([semi_implicit_with_implicit_damping(0.0), semi_implicit_with_implicit_damping(0.75)], [2.0, 4.0]);
        assert_eq!(theta(0.5, 0.1), f64::INFINITY);
    }

    #[test]
    fn the_critical_bound_of_runge_kutta_is_the_root_of_its_cubic() {
        let s = runge_kutta_critical();
        assert!((((s - 4.0) * s + 12.0) * s - 24.0).abs() <= rounding(16, 24.0));
    }

    #[test]
    fn explicit_and_semi_implicit_euler_bear_the_same_step_at_one_over_root_three() {
        let crossing = 1.0 / 3f64.sqrt();
        assert!((theta(0.0, crossing) - semi_implicit(crossing)).abs() <= rounding(8, 2.0));
    }
}
