//! Methods on the spring and damper: what becomes of the powers of a step matrix, decided in rationals.

use crate::checks::Finding;
use crate::integrators::stability::{Powers, powers};
use crate::integrators::variational::Verlet;
use crate::integrators::{Damping, ExplicitEuler, Method, Phase, SemiImplicitEuler, SmoothSystem, SpringDamper, Theta};
use crate::scalar::{Rational, Scalar, exact, ratio};
use crate::tolerance::claims::integrators::BESIDE;
use nalgebra::DMatrix;

/// Semi-implicit Euler, all forces at the old velocity.
pub const SEMI_IMPLICIT: SemiImplicitEuler = SemiImplicitEuler { damping: Damping::Explicit };

/// The methods that §8 compares, as values.
#[derive(Clone, Debug)]
pub enum OneStep {
    /// Explicit Euler.
    Explicit,
    /// Semi-implicit Euler, all forces at the old velocity.
    SemiImplicit,
    /// Semi-implicit Euler with the damping at the new velocity.
    ImplicitDamping,
    /// Velocity Verlet.
    Verlet,
    /// The θ method.
    Theta(Theta),
}

impl Method for OneStep {
    fn step<T: Scalar>(&self, system: &impl SmoothSystem, now: &Phase<T>, h: &T) -> Phase<T> {
        match self {
            OneStep::Explicit => ExplicitEuler.step(system, now, h),
            OneStep::SemiImplicit => SEMI_IMPLICIT.step(system, now, h),
            OneStep::ImplicitDamping => SemiImplicitEuler { damping: Damping::Implicit }.step(system, now, h),
            OneStep::Verlet => Verlet.step(system, now, h),
            OneStep::Theta(theta) => theta.step(system, now, h),
        }
    }
}

/// The θ method.
pub fn theta(numerator: i64, denominator: i64) -> OneStep {
    OneStep::Theta(Theta { theta: ratio(numerator, denominator) })
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
        Finding::decision(format!("{name}, ζ = {damping_ratio}: stable just below the end of the stable steps"), at(1.0 - BESIDE), true),
        Finding::decision(format!("{name}, ζ = {damping_ratio}: unstable just above it"), !at(1.0 + BESIDE), true),
    ]
}

/// Whether the stable steps end at s = `bound`: stable just below it, unstable just above; decided exactly.
pub fn ends_at(method: &impl Method, damping_ratio: &Rational, bound: f64) -> bool {
    let stable = |factor: f64| is_stable(method, damping_ratio, &exact(bound * factor));
    stable(1.0 - BESIDE) && !stable(1.0 + BESIDE)
}

/// Where the stable steps end, as s = hω, by 40 bisections of (0, 16) in rationals.
pub fn end_of_stable_steps(method: &impl Method, damping_ratio: &Rational) -> f64 {
    let (mut low, mut high) = (ratio(0, 1), ratio(16, 1));
    for _ in 0..40 {
        let middle = (&low + &high) / ratio(2, 1);
        if is_stable(method, damping_ratio, &middle) { low = middle } else { high = middle }
    }
    Scalar::to_f64(&low)
}

/// E of a phase point with unit mass: ½ v² + ½ ω² q².
pub fn energy(spring: &SpringDamper, at: &Phase<Rational>) -> Rational {
    let (q, v) = (&at.position[0], &at.velocity[0]);
    (v * v + &spring.stiffness_per_mass * q * q) / ratio(2, 1)
}

/// E⁺/E of a step h.
pub fn energy_ratio(method: &impl Method, (spring, start): &(SpringDamper, Phase<Rational>), h: &Rational) -> Rational {
    energy(spring, &method.step(spring, start, h)) / energy(spring, start)
}

/// ω = 2/s without damping, q = 1 m, v = 1/3 m/s: a spring on which ω and the units of q and v can be told apart.
pub fn undamped() -> (SpringDamper, Phase<Rational>) {
    (SpringDamper { stiffness_per_mass: ratio(4, 1), damping_per_mass: ratio(0, 1) }, Phase::of_one(ratio(1, 1), ratio(1, 3)))
}

/// A body that crosses the top of a hill at 1 m/s, q̈ = q: the potential −½q² is concave.
pub fn hill() -> (SpringDamper, Phase<Rational>) {
    (SpringDamper { stiffness_per_mass: ratio(-1, 1), damping_per_mass: ratio(0, 1) }, Phase::of_one(ratio(0, 1), ratio(1, 1)))
}
