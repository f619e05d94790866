//! Torque-free rotation over one step, J dΩ/dt = −Ω × JΩ in the body frame, by the implicit midpoint rule:
//!
//! ```text
//!     J (Ω⁺ − Ω) = −h Ω_m × J Ω_m ,   Ω_m = ½(Ω + Ω⁺) .
//! ```
//! **Invariants.** Multiplying by Ω_m gives ½Ω⁺ᵀJΩ⁺ = ½ΩᵀJΩ, and by J Ω_m gives ‖JΩ⁺‖ = ‖JΩ‖: kinetic energy and the size of the
//! angular momentum are kept for every h, where the explicit step would gain ½h²Ω̇ᵀJΩ̇ in each step. The *direction* of the angular
//! momentum in space also depends on the rotation R⁺ = R exp(h Ω̄): with Ω̄ = Ω_m (a scheme with θ = ½) it is off by O(h³) per step,
//! O(h²) over a fixed time; with Ω̄ = Ω⁺ by O(h).
//!
//! **Solution.** In components Ω_m,i = Ω_i + ½h a_i Ω_m,j Ω_m,k with a_1 = (J_2 − J_3)/J_1 and so on. A body's moments satisfy
//! the triangle inequality, so |a_i| ≤ 1 and the right side has the Lipschitz constant √½·h·s on ‖Ω_m‖ ≤ s. The step is divided until
//! h s ≤ ½ with s = √(ΩᵀJΩ/min J), which no state of the same energy exceeds: a contraction, on which Newton's method
//! converges from Ω. The work grows with the spin; [`is_too_fast`] tells where it is too much. With J the same about every axis the answer
//! is Ω⁺ = Ω, at no cost.

use crate::tolerance::limits::PRECESSION_PARTS;
use crate::tolerance::mechanics::NEWTON_STEPS;
use nalgebra::{Matrix3, Vector3};

/// Ω after a time h of torque-free rotation \[rad/s\], body frame.
pub(super) fn free_spin(moments: &Vector3<f64>, spin: &Vector3<f64>, h: f64) -> Vector3<f64> {
    if is_round(moments) {
        return *spin;
    }
    let parts = parts(moments, spin, h).clamp(1.0, PRECESSION_PARTS as f64);
    let mut spin = *spin;
    for _ in 0..parts as usize {
        spin = midpoint(moments, &spin, h / parts);
    }
    spin
}

/// Whether J is the same about every axis: there is no gyroscopic torque then, and Ω stays.
fn is_round(moments: &Vector3<f64>) -> bool {
    moments[0] == moments[1] && moments[1] == moments[2]
}

/// Into how many parts a step of size h is divided.
fn parts(moments: &Vector3<f64>, spin: &Vector3<f64>, h: f64) -> f64 {
    let fastest = (spin.dot(&moments.component_mul(spin)) / moments.min()).sqrt();
    (2.0 * h.abs() * fastest).ceil()
}

/// Whether a step of size h would be divided into more than [`PRECESSION_PARTS`].
pub(super) fn is_too_fast(moments: &Vector3<f64>, spin: &Vector3<f64>, h: f64) -> bool {
    !is_round(moments) && parts(moments, spin, h) > PRECESSION_PARTS as f64
}

/// One implicit midpoint step.
fn midpoint(moments: &Vector3<f64>, spin: &Vector3<f64>, h: f64) -> Vector3<f64> {
    let [a, b, c] = [(1, 2, 0), (2, 0, 1), (0, 1, 2)].map(|(j, k, i)| 0.5 * h * (moments[j] - moments[k]) / moments[i]);
    let mut mean = *spin;
    for _ in 0..NEWTON_STEPS {
        let [x, y, z] = [mean[0], mean[1], mean[2]];
        let residual = mean - spin - Vector3::new(a * y * z, b * z * x, c * x * y);
        let slope = Matrix3::new(1.0, -a * z, -a * y, -b * z, 1.0, -b * x, -c * y, -c * x, 1.0);
        let Some(correction) = slope.lu().solve(&residual) else { break };
        mean -= correction;
    }
    mean * 2.0 - spin
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    const MOMENTS: Vector3<f64> = Vector3::new(0.4, 0.7, 1.0);
    const SPIN: Vector3<f64> = Vector3::new(3.0, -2.0, 0.5);

    #[test]
    fn energy_and_size_of_the_momentum_are_kept_for_every_step() {
        for h in [1e-4, 1e-2, 0.3, 2.0, -0.1] {
            let mut spin = SPIN;
            for _ in 0..100 {
                spin = free_spin(&MOMENTS, &spin, h);
            }
            let energy = |spin: &Vector3<f64>| spin.dot(&MOMENTS.component_mul(spin));
            let momentum = |spin: &Vector3<f64>| MOMENTS.component_mul(spin).norm_squared();
            // Each step rounds every component a few times; both squares have condition number two.
            let bound = |value: f64| rounding(100 * 32 * (1.0 + 2.0 * f64::abs(h) * 5.0) as usize, value);
            assert!((energy(&spin) - energy(&SPIN)).abs() <= bound(energy(&SPIN)), "h = {h}");
            assert!((momentum(&spin) - momentum(&SPIN)).abs() <= bound(momentum(&SPIN)), "h = {h}");
        }
    }

    #[test]
    fn the_midpoint_equation_holds() {
        let h = 0.05;
        let after = midpoint(&MOMENTS, &SPIN, h);
        let mean = (after + SPIN) * 0.5;
        let residual = MOMENTS.component_mul(&(after - SPIN)) + mean.cross(&MOMENTS.component_mul(&mean)) * h;
        assert!(residual.norm() <= rounding(32, 10.0), "{residual}");
        let explicit = SPIN - SPIN.cross(&MOMENTS.component_mul(&SPIN)).component_div(&MOMENTS) * h;
        assert!((explicit - after).norm() > 1e3 * rounding(32, 10.0), "the explicit step is another one");
    }

    #[test]
    fn a_symmetric_top_precesses_at_its_rate() {
        // J = (A, A, C): Ω_3 stays and (Ω_1, Ω_2) turns at (C − A)/A·Ω_3; the midpoint rule turns by 2 atan(½ h rate) per step.
        let (moments, spin, h) = (Vector3::new(0.5, 0.5, 0.8), Vector3::new(1.0, 0.0, 4.0), 0.02);
        let rate = (0.8 - 0.5) / 0.5 * 4.0;
        let after = free_spin(&moments, &spin, h);
        let turned = after[1].atan2(after[0]);
        assert!((turned - 2.0 * (0.5 * h * rate).atan()).abs() <= rounding(32, 1.0), "{turned}");
        assert!((after[2] - 4.0).abs() <= rounding(16, 4.0));
    }

    #[test]
    fn a_round_body_keeps_its_spin_at_any_rate_and_a_box_is_told_to_be_too_fast_beyond_the_limit() {
        let (round, spin) = (Vector3::repeat(0.3), Vector3::new(1e9, -2e9, 1e-9));
        assert_eq!(free_spin(&round, &spin, 0.01), spin);
        assert!(!is_too_fast(&round, &spin, 0.01));
        // about the axis of the largest moment, s = Ω √(J_3/J_1): 2 h s is the number of parts
        let (h, ratio) = (0.25, (1.0f64 / 0.4).sqrt());
        let about = |parts: f64| Vector3::new(0.0, 0.0, parts / (2.0 * h * ratio));
        assert!(!is_too_fast(&MOMENTS, &about(PRECESSION_PARTS as f64 - 0.5), h));
        assert!(is_too_fast(&MOMENTS, &about(PRECESSION_PARTS as f64 + 0.5), h));
    }

    #[test]
    fn numbers_that_are_not_finite_come_out_as_such_and_in_finite_time() {
        assert!(free_spin(&MOMENTS, &Vector3::new(f64::NAN, 0.0, 0.0), 0.1).x.is_nan());
        assert!(!free_spin(&MOMENTS, &Vector3::new(f64::INFINITY, 0.0, 1.0), 0.1).x.is_finite());
        free_spin(&MOMENTS, &Vector3::new(1e200, 1e200, 1.0), 0.1);
    }
}
