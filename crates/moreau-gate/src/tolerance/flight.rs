//! Free flight: what a sound first order step may be off.
//!
//! *Position.* With v exact at every step (v_n = v₀ + n h g, true of every one-step method under constant force), x_n − x(t_n) is the
//! error of a quadrature of v: x⁺ = x + h(θ v⁺ + (1−θ) v) has (θ − ½) g h per unit of time, so ½|g| h t for 0 ≤ θ ≤ 1, attained by the
//! semi-implicit (θ = 1) and explicit (θ = 0) Euler rules.
//!
//! *Rounding.* n additions to a number of size S are off by at most ½ n ε S.

use nalgebra::{Matrix3, Vector3};

pub use moreau_forms::tolerance::{TOP_STEPS, top_reference};

/// ½|g| h t \[m\].
/// Derived.
pub fn position(gravity: f64, h: f64, time: f64) -> f64 {
    0.5 * gravity * h * time
}

/// n additions to a number of at most `size`, each of a product of two rounded factors no larger: 2 n ε S. An engine that declares a
/// `substep` makes so many of them in a step.
/// Derived.
pub fn rounding(steps: usize, size: f64, epsilon: f64) -> f64 {
    2.0 * (steps + 1) as f64 * epsilon * size
}

/// Relative error of the momentum of a body that turns about a principal axis: J and L are formed from R, whose unit length and
/// orthogonality each step restores up to 16 roundings; 2·16 ε per step, both for R and Rᵀ.
/// Derived.
pub fn turning(steps: usize, epsilon: f64) -> f64 {
    64.0 * (steps + 1) as f64 * epsilon
}

/// Declared damping: a step multiplies v by 1 − c h, by 1/(1 + c h) or by e^{−ch}, before or after gravity. Against ẋ = v, v̇ = g − c v
/// the factors are off by ½(c h)² of v per step and the order of the two by c h · g h.
/// Derived.
pub fn damped_velocity(damping: f64, gravity: f64, speed: f64, time: f64, h: f64) -> f64 {
    damping * h * time * (0.5 * damping * speed + gravity)
}

/// The error of the velocity summed over the flight, and that of the quadrature as without damping.
/// Derived.
pub fn damped_position(damping: f64, gravity: f64, speed: f64, time: f64, h: f64) -> f64 {
    time * damped_velocity(damping, gravity, speed, time, h) + 0.5 * (gravity + damping * speed) * h * time
}

/// How far first order steps of a tumbling body may be off at the end of a path, per unit of h.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tumbling {
    /// Error of Ω in the body frame, divided by h \[rad/s²\].
    pub body_rate: f64,
    /// Error of R as an angle, divided by h \[rad/s\].
    pub angle: f64,
}

/// Integrates the error bound beside the path Ω(t), given in equal parts of length `part` \[s\].
///
/// The Euler rules, explicit and implicit, in the body frame or with R J Ω held fixed in space, have local errors of at most
/// ½h²(‖J⁻¹(JΩ̇×Ω)‖ + ‖J⁻¹(JΩ×Ω̇)‖) in Ω (the two terms are Ω̈; the second alone is what a wrong R does to Ω at fixed momentum) and
/// ½h²‖Ω̇‖ in R. An error of Ω grows at most with the logarithmic norm m of Euler's equations, an error of R not at all:
/// ```text
///     e_Ω' = m e_Ω + ½h ‖Ω̈‖ ,      e_R' = e_Ω + ½h ‖Ω̇‖ .
/// ```
/// Derived.
pub fn tumbling(moments: &Vector3<f64>, path: &[Vector3<f64>], part: f64) -> Tumbling {
    let mut bound = Tumbling::default();
    for rate in path {
        let momentum = moments.component_mul(rate);
        let acceleration = momentum.cross(rate).component_div(moments);
        let turned = [moments.component_mul(&acceleration).cross(rate), momentum.cross(&acceleration)];
        let local: f64 = turned.iter().map(|torque| 0.5 * torque.component_div(moments).norm()).sum();
        bound.angle += part * (bound.body_rate + 0.5 * acceleration.norm());
        bound.body_rate += part * (logarithmic_norm(moments, rate) * bound.body_rate + local);
    }
    bound
}

/// Largest eigenvalue of the symmetric part of ∂Ω̇/∂Ω: its trace is zero, so √⅔ of its Frobenius norm is a bound.
fn logarithmic_norm(moments: &Vector3<f64>, rate: &Vector3<f64>) -> f64 {
    let [a, b, c] = [(1, 2, 0), (2, 0, 1), (0, 1, 2)].map(|(j, k, i)| (moments[j] - moments[k]) / moments[i]);
    let [x, y, z] = [rate[0], rate[1], rate[2]];
    let slope = Matrix3::new(0.0, a * z, a * y, b * z, 0.0, b * x, c * y, c * x, 0.0);
    (2.0f64 / 3.0).sqrt() * (0.5 * (slope + slope.transpose())).norm()
}
