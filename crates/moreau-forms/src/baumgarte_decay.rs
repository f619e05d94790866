//! φ̈ + 2α φ̇ + β² φ = 0: its slow root.
//!
//! ```text
//!     s = −α ± √(α² − β²) :      α ≤ β   τ = 1/α ,  oscillating at √(β² − α²) if α < β ;      α > β   τ = 1/(α − √(α² − β²)) ≈ 2α/β² .
//! ```

/// τ \[s\], the time constant of the slowest decay; α and β \[1/s\] positive.
///
/// For α > β the root is taken as (α + √(α²−β²))/β², which cancels nothing.
///
/// ```
/// use moreau_forms::baumgarte_decay::time_constant;
///
/// assert_eq!(time_constant(5.0, 5.0), 0.2); // critical damping: 1/α
/// assert_eq!(time_constant(13.0, 5.0), 1.0); // overdamped: (13 + 12)/25 s, slower than 1/13 s
/// ```
pub fn time_constant(damping: f64, frequency: f64) -> f64 {
    if damping <= frequency {
        return 1.0 / damping;
    }
    (damping + ((damping - frequency) * (damping + frequency)).sqrt()) / (frequency * frequency)
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn the_slow_root_satisfies_the_characteristic_equation() {
        for (damping, frequency) in [(6.0, 5.0), (5.0, 5.0), (50.0, 5.0)] {
            let s = -1.0 / time_constant(damping, frequency);
            let terms = s * s - 2.0 * damping * s + frequency * frequency;
            assert!((s * s + 2.0 * damping * s + frequency * frequency).abs() <= rounding(16, terms));
        }
    }
}
