//! The steps of a ball above a floor, in any ordered field – with rationals, exactly.
//!
//! ```text
//!     m (v⁺ − v) = −m g h + r ,   0 ≤ r ⟂ v⁺ + s ≥ 0   hence   r = max(0, −m (v_free + s)) ,   v_free = v − g h .
//! ```
//! Moreau–Jean has s = e v at an active contact, Stewart–Trinkle s = q/h. The problem has one contact and one
//! velocity, so its solution is written down here instead of being asked of a solver: these steps share no code with
//! the schemes they are the reference of.

use super::Activation;
use crate::scalar::Scalar;

/// A ball of mass m under gravity g above the floor q ≥ 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Ball<T> {
    /// m \[kg\].
    pub mass: T,
    /// g \[m/s²\], downwards.
    pub gravity: T,
    /// e.
    pub restitution: T,
}

/// Height and velocity of the ball, upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion<T> {
    /// q \[m\].
    pub position: T,
    /// v \[m/s\].
    pub velocity: T,
}

/// One step and what it was made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome<T> {
    /// q⁺ and v⁺.
    pub motion: Motion<T>,
    /// r \[N·s\].
    pub impulse: T,
    /// v_free = v − g h \[m/s\].
    pub free_velocity: T,
    /// q + h v_free, the forecast of rule D \[m\].
    pub forecast: T,
    /// Whether the contact took part.
    pub active: bool,
}

impl<T: Scalar> Ball<T> {
    /// One step of Moreau–Jean with the position update q + h(θ v⁺ + (1−θ) v).
    pub fn moreau_jean(&self, now: &Motion<T>, theta: &T, activation: Activation, h: &T) -> Outcome<T> {
        let free_velocity = now.velocity.clone() - self.gravity.clone() * h.clone();
        let forecast_speed = match activation {
            Activation::Gap => T::zero(),
            Activation::HalfStepForecast => now.velocity.clone() * T::ratio(1, 2),
            Activation::FreeVelocityForecast => free_velocity.clone(),
        };
        let active = now.position.clone() + h.clone() * forecast_speed <= T::zero();
        let reversed = self.restitution.clone() * now.velocity.clone();
        let impulse = if active { self.impulse(&free_velocity, reversed) } else { T::zero() };
        self.outcome(now, theta, h, free_velocity, impulse, active)
    }

    /// One step of Stewart–Trinkle: 0 ≤ r ⟂ q + h v⁺ ≥ 0, position update q + h v⁺, no restitution.
    pub fn stewart_trinkle(&self, now: &Motion<T>, h: &T) -> Outcome<T> {
        let free_velocity = now.velocity.clone() - self.gravity.clone() * h.clone();
        let impulse = self.impulse(&free_velocity, now.position.clone() / h.clone());
        self.outcome(now, &T::one(), h, free_velocity, impulse, true)
    }

    /// E − (θ−½) m g h v with E = ½ m v² + m g q \[J\]: free flight conserves it exactly for every θ, and so does the
    /// bounce v → −v of an elastic ball (e = 1).
    ///
    /// Free step: Δ(½v²) = −g h v + ½g²h², g Δq = g h v − θ g²h² and −(θ−½) g h Δv = (θ−½) g²h²; the sum is zero.
    /// Elastic bounce: Δ(½v²) = 0, g Δq = g h (1−2θ) v and −(θ−½) g h Δv = (2θ−1) g h v; the sum is zero.
    pub fn scheme_energy(&self, motion: &Motion<T>, theta: &T, h: &T) -> T {
        let half = T::ratio(1, 2);
        let kinetic = half.clone() * motion.velocity.clone() * motion.velocity.clone();
        let potential = self.gravity.clone() * motion.position.clone();
        let correction = (theta.clone() - half) * self.gravity.clone() * h.clone() * motion.velocity.clone();
        self.mass.clone() * (kinetic + potential - correction)
    }

    /// E = ½ m v² + m g q \[J\].
    pub fn energy(&self, motion: &Motion<T>) -> T {
        self.scheme_energy(motion, &T::ratio(1, 2), &T::zero())
    }

    /// ½ m v² \[J\].
    pub fn kinetic_energy(&self, velocity: &T) -> T {
        T::ratio(1, 2) * self.mass.clone() * velocity.clone() * velocity.clone()
    }

    /// r = max(0, −m (v_free + s)).
    fn impulse(&self, free_velocity: &T, shift: T) -> T {
        let wanted = -(self.mass.clone() * (free_velocity.clone() + shift));
        if wanted > T::zero() { wanted } else { T::zero() }
    }

    fn outcome(&self, now: &Motion<T>, theta: &T, h: &T, free_velocity: T, impulse: T, active: bool) -> Outcome<T> {
        let velocity = free_velocity.clone() + impulse.clone() / self.mass.clone();
        let mean = theta.clone() * velocity.clone() + (T::one() - theta.clone()) * now.velocity.clone();
        let position = now.position.clone() + h.clone() * mean;
        let forecast = now.position.clone() + h.clone() * free_velocity.clone();
        Outcome { motion: Motion { position, velocity }, impulse, free_velocity, forecast, active }
    }
}
