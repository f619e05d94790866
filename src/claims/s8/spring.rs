//! Methods on the spring and damper: what becomes of the powers of a step matrix, decided in rationals.

use crate::checks::Finding;
use crate::integrators::stability::{Powers, powers};
use crate::integrators::{Damping, Method, Phase, SemiImplicitEuler, SpringDamper, Theta};
use crate::scalar::{Rational, exact, ratio};
use crate::tolerance::claims::integrators::BESIDE;
use nalgebra::DMatrix;

/// Semi-implicit Euler, all forces at the old velocity.
pub const SEMI_IMPLICIT: SemiImplicitEuler = SemiImplicitEuler { damping: Damping::Explicit };

/// The θ method.
pub fn theta(numerator: i64, denominator: i64) -> Theta {
    Theta { theta: ratio(numerator, denominator) }
}

/// The matrix of a step h.
pub fn matrix(method: &impl Method, spring: &SpringDamper, h: &Rational) -> DMatrix<Rational> {
    method.jacobian(spring, &Phase::of_one(ratio(1, 1), ratio(0, 1)), h)
}

/// What becomes of the powers of the step matrix at the damping ratio ζ and s = hω.
pub fn powers_at(method: &impl Method, damping_ratio: &Rational, s: &Rational) -> Powers {
    powers(&matrix(method, &SpringDamper::of_ratio(damping_ratio.clone()), s))
}

/// Whether the step matrix at ζ and s has bounded powers.
pub fn is_stable(method: &impl Method, damping_ratio: &Rational, s: &Rational) -> bool {
    matches!(powers_at(method, damping_ratio, s), Powers::Decay | Powers::Bounded)
}

/// Stable just below s = `bound`, unstable just above it; two exact decisions.
pub fn both_sides(name: &str, method: &impl Method, damping_ratio: f64, bound: f64) -> [Finding; 2] {
    let at = |factor: f64| is_stable(method, &exact(damping_ratio), &exact(bound * factor));
    [
        Finding::decision(format!("{name}, ζ = {damping_ratio}: stable just below s = {bound:.6}"), at(1.0 - BESIDE), true),
        Finding::decision(format!("{name}, ζ = {damping_ratio}: stable just above"), at(1.0 + BESIDE), false),
    ]
}

/// [`both_sides`] against the printed bound, s ≤ 2 whatever the damping.
pub fn against_two(name: &str, method: &impl Method, damping_ratio: f64, bound: f64) -> [Finding; 2] {
    let [below, above] = both_sides(name, method, damping_ratio, bound);
    [below.says(bound * (1.0 - BESIDE) <= 2.0), above.says(bound * (1.0 + BESIDE) <= 2.0)]
}

/// E of a phase point with unit mass: ½ v² + ½ ω² q².
pub fn energy(spring: &SpringDamper, at: &Phase<Rational>) -> Rational {
    let (q, v) = (&at.position[0], &at.velocity[0]);
    (v * v + &spring.stiffness_per_mass * q * q) / ratio(2, 1)
}

/// ω = 2/s without damping, q = 1 m, v = 1/3 m/s: a spring on which ω and the units of q and v can be told apart.
pub fn undamped() -> (SpringDamper, Phase<Rational>) {
    (SpringDamper { stiffness_per_mass: ratio(4, 1), damping_per_mass: ratio(0, 1) }, Phase::of_one(ratio(1, 1), ratio(1, 3)))
}
