//! Fischer and Burmeister's function of the self-dual second-order cone ‖x_t‖ ≤ x_n, smoothed by τ, with its derivatives:
//!
//! ```text
//!     φ_τ(x, z) = x + z − s ,     s ∘ s = x ∘ x + z ∘ z + 2τ² e ,     s in the cone ;        φ_0 = 0  ⇔  x, z in the cone, x·z = 0
//!     s = s₁ e₁ + s₂ e₂ ,     s₁² = ‖x_t − x_n û‖² + ‖z_t − z_n û‖² + 2τ² ,     s₂² = ‖x_t + x_n û‖² + ‖z_t + z_n û‖² + 2τ²
//!     L_s ds = L_x dx + L_z dz ,     L_s⁻¹ = c₁c₁ᵀ/s₁ + c₂c₂ᵀ/s₂ + 2 ttᵀ/(s₁ + s₂) ,     L_s⁻¹L_x = Σ cᵢ (x ∘ cᵢ)ᵀ/sᵢ + …
//! ```
//! with L_x d = x ∘ d, û the direction of x_n x_t + z_n z_t, t ⟂ û, c₁,₂ = (1, ∓û)/√2 and e₁,₂ = (1, ∓û)/2. The squares are sums of
//! squares, so that s₁ keeps its digits where x and z lie near the boundary of the cone.
//!
//! **On the boundary.** ‖x ∘ cᵢ‖ ≤ sᵢ: the derivatives are bounded. Where sᵢ = 0 there are several; what is taken is the limit along
//! x + ε cᵢ, z + ε cᵢ, which gives both the same share, cᵢcᵢᵀ/√2.
//!
//! # Source
//! Fukushima, Luo and Tseng, *Smoothing functions for second-order-cone complementarity problems*, SIAM J. Optim. 12 (2002).

use crate::cones::self_dual::product;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::FRAC_1_SQRT_2;

/// φ and its derivatives at one pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct FischerBurmeisterMap {
    /// φ.
    pub value: Vector3<f64>,
    /// ∂φ/∂x.
    pub along_x: Matrix3<f64>,
    /// ∂φ/∂z.
    pub along_z: Matrix3<f64>,
}

/// û, s₁ and s₂.
fn root(x: &Vector3<f64>, z: &Vector3<f64>, smoothing: f64) -> ([f64; 2], [f64; 2]) {
    let tangential = [1, 2].map(|i| x[0] * x[i] + z[0] * z[i]);
    let length = tangential[0].hypot(tangential[1]);
    let u = if length > 0.0 { tangential.map(|part| part / length) } else { [1.0, 0.0] };
    let side = |sign: f64| {
        let parts = [x, z].map(|p| (p[1] + sign * p[0] * u[0]).hypot(p[2] + sign * p[0] * u[1]));
        parts[0].hypot(parts[1]).hypot(2.0_f64.sqrt() * smoothing)
    };
    (u, [side(-1.0), side(1.0)])
}

/// φ_τ(x, z).
pub(super) fn value(x: &Vector3<f64>, z: &Vector3<f64>, smoothing: f64) -> Vector3<f64> {
    let (u, [s1, s2]) = root(x, z, smoothing);
    let along = 0.5 * (s2 - s1);
    x + z - Vector3::new(0.5 * (s1 + s2), along * u[0], along * u[1])
}

impl FischerBurmeisterMap {
    /// At x and z, τ ≥ 0.
    pub(super) fn at(x: &Vector3<f64>, z: &Vector3<f64>, smoothing: f64) -> Self {
        let (u, [s1, s2]) = root(x, z, smoothing);
        let sides = [
            (Vector3::new(1.0, -u[0], -u[1]) * FRAC_1_SQRT_2, s1),
            (Vector3::new(1.0, u[0], u[1]) * FRAC_1_SQRT_2, s2),
            (Vector3::new(0.0, -u[1], u[0]), 0.5 * (s1 + s2)),
        ];
        let slope = |of: &Vector3<f64>| {
            sides.iter().fold(Matrix3::identity(), |left, (c, s)| {
                let share = if *s > 0.0 { product(of, c) / *s } else { c * FRAC_1_SQRT_2 };
                left - c * share.transpose()
            })
        };
        FischerBurmeisterMap { value: value(x, z, smoothing), along_x: slope(x), along_z: slope(z) }
    }

    /// Of the half line x ≥ 0, z ≥ 0, xz = 0.
    pub(super) fn half_line(x: f64, z: f64, smoothing: f64) -> Self {
        let root = x.hypot(z).hypot(2.0_f64.sqrt() * smoothing);
        let share = |of: f64| if root > 0.0 { of / root } else { FRAC_1_SQRT_2 };
        let first = |entry: f64| Matrix3::from_diagonal(&Vector3::new(entry, 0.0, 0.0));
        FischerBurmeisterMap { value: Vector3::new(x + z - root, 0.0, 0.0), along_x: first(1.0 - share(x)), along_z: first(1.0 - share(z)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::cones::{DIFFERENCE_STEP, difference_error};
    use moreau_exact::tolerance::rounding;
    use proptest::prelude::*;

    fn points() -> impl Strategy<Value = (Vector3<f64>, Vector3<f64>)> {
        proptest::array::uniform6(-2.0..2.0f64).prop_map(|p| (Vector3::new(p[0], p[1], p[2]), Vector3::new(p[3], p[4], p[5])))
    }

    proptest! {
        #[test]
        fn the_root_squared_is_the_sum_of_squares((x, z) in points(), tau in 0.0..1.0f64) {
            let s = x + z - value(&x, &z, tau);
            let left = product(&s, &s) - product(&x, &x) - product(&z, &z) - Vector3::new(2.0 * tau * tau, 0.0, 0.0);
            prop_assert!(left.amax() <= rounding(64, 40.0), "{left}");
            prop_assert!(s[0] >= s[1].hypot(s[2]) - rounding(8, s[0]));
        }

        #[test]
        fn the_derivatives_are_those_of_the_function((x, z) in points(), tau in 0.5..1.0f64) {
            let here = FischerBurmeisterMap::at(&x, &z, tau);
            for i in 0..3 {
                let shift = Vector3::from_fn(|j, _| if i == j { DIFFERENCE_STEP } else { 0.0 });
                let slope = |moved: &dyn Fn(f64) -> Vector3<f64>| (moved(1.0) - moved(-1.0)) / (2.0 * DIFFERENCE_STEP);
                let along_x = slope(&|sign| value(&(x + shift * sign), &z, tau));
                let along_z = slope(&|sign| value(&x, &(z + shift * sign), tau));
                // s₁ ≥ √2 τ bounds the third derivatives as a norm does that of the projection
                let bound = difference_error(tau, 8.0);
                prop_assert!((along_x - here.along_x.column(i)).amax() <= bound && (along_z - here.along_z.column(i)).amax() <= bound);
                // the derivative of the other argument is another one
                prop_assume!((here.along_x - here.along_z).column(i).amax() > 4.0 * bound);
                prop_assert!((along_x - here.along_z.column(i)).amax() > bound);
            }
        }
    }

    #[test]
    fn it_is_zero_at_complementary_pairs_alone() {
        let zero = Vector3::zeros();
        let pairs = [
            (Vector3::new(2.0, 0.5, 1.0), zero),
            (zero, Vector3::new(1.0, 0.6, -0.8)),
            (Vector3::new(3.0, 3.0, 0.0), Vector3::new(0.25, -0.25, 0.0)),
            (zero, zero),
        ];
        for (x, z) in pairs {
            assert!(value(&x, &z, 0.0).amax() <= rounding(16, 4.0));
            let slopes = FischerBurmeisterMap::at(&x, &z, 0.0);
            assert!(slopes.along_x.iter().chain(&slopes.along_z).all(|entry| entry.is_finite() && entry.abs() <= 2.0));
        }
        for (x, z) in [(Vector3::x(), Vector3::x()), (Vector3::y(), zero), (-Vector3::x(), zero)] {
            assert!(value(&x, &z, 0.0).amax() > 0.1);
        }
    }

    #[test]
    fn a_pair_of_one_row_is_that_of_the_half_line() {
        for (x, z) in [(2.0, 0.0), (-1.0, 3.0), (0.0, 0.0), (0.5, 0.25)] {
            let (line, cone) =
                (FischerBurmeisterMap::half_line(x, z, 0.0), FischerBurmeisterMap::at(&(Vector3::x() * x), &(Vector3::x() * z), 0.0));
            assert!((line.value - cone.value).amax() <= rounding(8, 6.0));
            let entry = |of: Matrix3<f64>| of[(0, 0)];
            assert!((entry(line.along_x) - entry(cone.along_x)).abs() <= rounding(16, 2.0));
            assert!((entry(line.along_z) - entry(cone.along_z)).abs() <= rounding(16, 2.0));
        }
    }

    /// Near the boundary s₁ is 2⁻³⁰, and its square as a difference of squares would be lost.
    #[test]
    fn the_small_root_keeps_its_digits() {
        let tiny = 1.0 / f64::from(1 << 30);
        let (_, [small, _]) = root(&Vector3::new(1.0, 1.0 + tiny, 0.0), &Vector3::zeros(), 0.0);
        assert_eq!(small, tiny);
    }
}
