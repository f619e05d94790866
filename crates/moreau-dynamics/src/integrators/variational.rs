//! The variational integrator of L = ½|v|² − V(q) (unit masses) with an elastic impact on φ(q) ≥ 0.
//!
//! ```text
//!     L_d(a, b, τ) = τ (½ |(b−a)/τ|² − ½ V(a) − ½ V(b)) ,      discrete Euler–Lagrange:  D₂L_d(q₀, q₁, h) + D₁L_d(q₁, q₂, h) = 0 ;
//!     with v = −D₁L_d(q, q⁺, h) and v⁺ = D₂L_d(q, q⁺, h):      q⁺ = q + h (v + ½h a(q)) ,   v⁺ = v + ½h (a(q) + a(q⁺))      (Verlet)
//! ```
//! A step in which the body hits φ = 0 consists of two parts, to the point q̃ of impact after τ and from there to q⁺ in h − τ:
//! ```text
//!     φ(q̃) = 0 ,     ṽ⁺ = ṽ⁻ + λ ∇φ(q̃) ,     E_d(q, q̃, τ) = E_d(q̃, q⁺, h − τ) ,     E_d(a, b, τ) = ½ |(b−a)/τ|² + ½ V(a) + ½ V(b) .
//! ```
//! All of it makes the action stationary in q̃ and τ, so that the map (q, v) ↦ (q⁺, v⁺) is symplectic through the impact.
//!
//! # Source
//! Fetecau, Marsden, Ortiz and West, *Nonsmooth Lagrangian mechanics and variational collision integrators*, SIAM J. Appl. Dyn.
//! Syst. 2 (2003) 381.

use super::jacobian::jacobian;
use super::root::root;
use super::{Method, Phase, SmoothSystem, ahead};
use moreau_exact::scalar::{Dual, Scalar};
use nalgebra::DVector;

/// A scalar function of the configuration: a potential or a gap.
pub trait ScalarField {
    /// Its value at q.
    fn value<T: Scalar>(&self, position: &DVector<T>) -> T;

    /// Its gradient at q.
    fn gradient<T: Scalar>(&self, position: &DVector<T>) -> DVector<T>
    where
        Self: Sized,
    {
        jacobian(position, |at| DVector::from_element(1, self.value(at))).row(0).transpose()
    }
}

/// Unit masses in a potential V: a = −∇V.
#[derive(Clone, Copy, Debug)]
pub struct InPotential<V>(pub V);

impl<V: ScalarField> SmoothSystem for InPotential<V> {
    fn acceleration<T: Scalar>(&self, position: &DVector<T>, _velocity: &DVector<T>) -> DVector<T> {
        -self.0.gradient(position)
    }
}

/// Velocity Verlet, the variational integrator without impact.
#[derive(Clone, Copy, Debug)]
pub struct Verlet;

impl Method for Verlet {
    fn step<T: Scalar>(&self, system: &impl SmoothSystem, now: &Phase<T>, h: &T) -> Phase<T> {
        let half = h.clone() * T::ratio(1, 2);
        let before = ahead(&now.velocity, &half, &system.acceleration(&now.position, &now.velocity));
        let position = ahead(&now.position, h, &before);
        let velocity = ahead(&before, &half, &system.acceleration(&position, &before));
        Phase { position, velocity }
    }
}

/// The two unknowns of a step with an impact, where Newton's method starts.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess<T> {
    /// τ, from the start of the step to the impact \[s\].
    pub time: T,
    /// λ, the jump of the velocity along ∇φ.
    pub jump: T,
    /// Newton steps for each. One is enough for the derivatives if the guess is the solution.
    pub newton_steps: usize,
}

/// The variational integrator with one elastic impact.
#[derive(Clone, Copy, Debug)]
pub struct Variational<V, W> {
    /// V.
    pub potential: V,
    /// φ, positive where the body may be.
    pub gap: W,
}

impl<V: ScalarField + Copy, W: ScalarField> Variational<V, W> {
    /// E_d(a, b, τ), the energy that belongs to the discrete Lagrangian \[J\].
    pub fn discrete_energy<T: Scalar>(&self, from: &DVector<T>, to: &DVector<T>, time: &T) -> T {
        let mean = (to - from) / time.clone();
        (mean.dot(&mean) + self.potential.value(from) + self.potential.value(to)) * T::ratio(1, 2)
    }

    /// A step h with one impact in it.
    pub fn step_with_impact<T: Scalar>(&self, now: &Phase<T>, h: &T, guess: &Guess<T>) -> Phase<T> {
        let system = InPotential(self.potential);
        let reached = |time: &Dual<T>| self.gap.value(&Verlet.step(&system, &lifted(now), time).position);
        let time = root(reached, &guess.time, guess.newton_steps);
        let touching = Verlet.step(&system, now, &time);
        let rest = h.clone() - time.clone();
        let normal = self.gap.gradient(&touching.position);
        let energy = self.discrete_energy(&now.position, &touching.position, &time);
        let surplus = |jump: &Dual<T>| {
            let (start, rest) = (lifted(&touching), Dual::constant(rest.clone()));
            let thrown = Phase { velocity: ahead(&start.velocity, jump, &normal.map(Dual::constant)), ..start.clone() };
            let end = Verlet.step(&system, &thrown, &rest);
            self.discrete_energy(&start.position, &end.position, &rest) - Dual::constant(energy.clone())
        };
        let jump = root(surplus, &guess.jump, guess.newton_steps);
        let thrown = Phase { velocity: ahead(&touching.velocity, &jump, &normal), ..touching };
        Verlet.step(&system, &thrown, &rest)
    }
}

/// A point whose derivatives are zero.
fn lifted<T: Scalar>(phase: &Phase<T>) -> Phase<Dual<T>> {
    Phase { position: phase.position.map(Dual::constant), velocity: phase.velocity.map(Dual::constant) }
}
