//! Claims on MuJoCo's soft contact (§6).

use super::super::solvers::STOP;

/// Error of the forces \[N\] of the two contacts of `S6.dual` and `S6.same-optimum`, given ‖f‖ and the largest |a_u| + |a_ref|, when each contact's
/// natural map fᵢ − (fᵢ − ρᵢgᵢ)₊ is at most [`STOP`] times max(‖f‖, ‖ρ(a_u − a_ref)‖).
///
/// Strong monotony of H = A + R gives ‖f − f*‖ ≤ (1/ρ + ‖H‖)/λ_min(H) times the natural map. Here H = (4/5, 2/5; 2/5, 8/5 + 1/19): trace below 5/2,
/// determinant above 1.16, so that λ_min > 2/5, and 1/ρᵢ = Hᵢᵢ between 4/5 and 5/3; (5/3 + 5/2)·5/2 < 11, and ‖ρ(a_u − a_ref)‖ ≤ √2·5/4 < 2 times
/// its largest entry.
pub fn two_contacts(force: f64, acceleration: f64) -> f64 {
    11.0 * STOP * force.max(2.0 * acceleration)
}
