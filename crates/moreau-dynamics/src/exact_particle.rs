//! The steps of a ball above a floor, in any ordered field – with rationals, exactly.
//!
//! ```text
//!     m (v⁺ − v) = −m g h + r ,   0 ≤ r ⟂ v⁺ + s ≥ 0   hence   r = max(0, −m (v_free + s)) ,   v_free = v − g h .
//! ```
//! Moreau–Jean has s = e v at an active contact, Stewart–Trinkle s = q/h. The problem has one contact and one
//! velocity, so its solution is written down here instead of being asked of a solver: these steps share no code with
//! the schemes they are the reference of.

use crate::schemes::Activation;
use moreau_exact::scalar::{Rational, Scalar};
use moreau_exact::witness::{Part, Witness, decided, rational};

/// A ball of mass m under gravity g above the floor q ≥ 0.
///
/// ```
/// use moreau_dynamics::exact_particle::{Ball, BallState};
/// use moreau_dynamics::schemes::Activation;
/// use moreau_exact::scalar::ratio;
///
/// let ball = Ball { mass: ratio(1, 1), gravity: ratio(10, 1), restitution: ratio(1, 2) };
/// let now = BallState { position: ratio(0, 1), velocity: ratio(-3, 1) };
/// let step = ball.moreau_jean(&now, &ratio(1, 2), Activation::Gap, &ratio(1, 100));
/// assert_eq!(step.motion.velocity, ratio(3, 2)); // −e v, exactly
/// assert_eq!(step.impulse, ratio(23, 5)); // 4.5 N·s of the impact and m g h
/// ```
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
pub struct BallState<T> {
    /// q \[m\].
    pub position: T,
    /// v \[m/s\].
    pub velocity: T,
}

/// The result of one step, with its intermediate quantities.
#[derive(Clone, Debug, PartialEq)]
pub struct BallStep<T> {
    /// q⁺ and v⁺.
    pub motion: BallState<T>,
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
    pub fn moreau_jean(&self, now: &BallState<T>, theta: &T, activation: Activation, h: &T) -> BallStep<T> {
        let free_velocity = now.velocity.clone() - self.gravity.clone() * h.clone();
        let forecast_speed = match activation {
            Activation::Gap => T::zero(),
            Activation::HalfStepForecast => now.velocity.clone() * T::ratio(1, 2),
            Activation::FreeVelocityForecast => free_velocity.clone(),
        };
        let active = now.position.clone() + h.clone() * forecast_speed <= T::zero();
        let reversed = self.restitution.clone() * now.velocity.clone();
        let scheme = match activation {
            Activation::Gap => "moreau-jean A",
            Activation::HalfStepForecast => "moreau-jean B",
            Activation::FreeVelocityForecast => "moreau-jean D",
        };
        self.step(scheme, now, theta, h, active.then_some(reversed))
    }

    /// One step of Stewart–Trinkle: 0 ≤ r ⟂ q + h v⁺ ≥ 0, position update q + h v⁺, no restitution.
    pub fn stewart_trinkle(&self, now: &BallState<T>, h: &T) -> BallStep<T> {
        self.step("stewart-trinkle", now, &T::one(), h, Some(now.position.clone() / h.clone()))
    }

    /// One step of nonsmooth generalised-α, which under a constant force is the same for every spectral radius: active if the free step
    /// ends at or below the floor, position update q + ½h (v + v⁺).
    pub fn generalised_alpha(&self, now: &BallState<T>, h: &T) -> BallStep<T> {
        let free_velocity = now.velocity.clone() - self.gravity.clone() * h.clone();
        let half = T::ratio(1, 2);
        let reached = now.position.clone() + h.clone() * half.clone() * (now.velocity.clone() + free_velocity.clone());
        let active = reached <= T::zero();
        self.step("generalised-alpha", now, &half, h, active.then(|| self.restitution.clone() * now.velocity.clone()))
    }

    /// One step of Schatzman–Paoli: 0 ≤ r ⟂ v⁺ − e v + (1+e) q/h ≥ 0, position update q + h v⁺.
    pub fn schatzman_paoli(&self, now: &BallState<T>, h: &T) -> BallStep<T> {
        let ahead = (T::one() + self.restitution.clone()) * now.position.clone() / h.clone();
        let shift = ahead - self.restitution.clone() * now.velocity.clone();
        self.step("schatzman-paoli", now, &T::one(), h, Some(shift))
    }

    /// E − (θ−½) m g h v with E = ½ m v² + m g q \[J\]: free flight conserves it exactly for every θ, and so does the
    /// bounce v → −v of an elastic ball (e = 1).
    ///
    /// Free step: Δ(½v²) = −g h v + ½g²h², g Δq = g h v − θ g²h² and −(θ−½) g h Δv = (θ−½) g²h²; the sum is zero.
    /// Elastic bounce: Δ(½v²) = 0, g Δq = g h (1−2θ) v and −(θ−½) g h Δv = (2θ−1) g h v; the sum is zero.
    pub fn scheme_energy(&self, motion: &BallState<T>, theta: &T, h: &T) -> T {
        let half = T::ratio(1, 2);
        let kinetic = half.clone() * motion.velocity.clone() * motion.velocity.clone();
        let potential = self.gravity.clone() * motion.position.clone();
        let correction = (theta.clone() - half) * self.gravity.clone() * h.clone() * motion.velocity.clone();
        self.mass.clone() * (kinetic + potential - correction)
    }

    /// E = ½ m v² + m g q \[J\].
    pub fn energy(&self, motion: &BallState<T>) -> T {
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

    /// The step with the shift s of an active contact.
    fn step(&self, scheme: &'static str, now: &BallState<T>, theta: &T, h: &T, shift: Option<T>) -> BallStep<T> {
        let decide = || {
            let free_velocity = now.velocity.clone() - self.gravity.clone() * h.clone();
            let impulse = shift.as_ref().map_or_else(T::zero, |shift| self.impulse(&free_velocity, shift.clone()));
            let velocity = free_velocity.clone() + impulse.clone() / self.mass.clone();
            let mean = theta.clone() * velocity.clone() + (T::one() - theta.clone()) * now.velocity.clone();
            let position = now.position.clone() + h.clone() * mean;
            let forecast = now.position.clone() + h.clone() * free_velocity.clone();
            BallStep { motion: BallState { position, velocity }, impulse, free_velocity, forecast, active: shift.is_some() }
        };
        let data = [&self.mass, &self.gravity, &self.restitution, &now.position, &now.velocity, theta, h];
        decided(decide, |found| {
            let data = data.iter().map(|number| rational::<T, Rational>(number).cloned()).collect::<Option<Vec<_>>>()?;
            let answer = [&found.impulse, &found.motion.position, &found.motion.velocity];
            let answer = answer.iter().map(|number| rational::<T, Rational>(number).cloned()).collect::<Option<Vec<_>>>()?;
            let parts = vec![("scheme", Part::Word(scheme)), ("data", Part::Vector(data)), ("answer", Part::Vector(answer))];
            Some(Witness { kind: "ball-step", parts })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{PointMass, State};
    use crate::schemes::{GeneralisedAlpha, MoreauJean, RestitutionRule, SchatzmanPaoli, Scheme, StewartTrinkle, step};
    use crate::tolerance::schemes::{ball_position, ball_velocity};
    use moreau_contact::solvers::ProjectedGaussSeidel;
    use moreau_exact::scalar::{Rational, exact};
    use nalgebra::dvector;

    const MASS: f64 = 0.7;
    const GRAVITY: f64 = 9.81;
    const RESTITUTION: f64 = 0.6;

    /// Steps the f64 scheme and, from each of its states, the exact ball; both must agree within one step's rounding.
    fn agree(scheme: &dyn Scheme, reference: impl Fn(&Ball<Rational>, &BallState<Rational>, &Rational) -> BallStep<Rational>) {
        let h = 0.013;
        let mechanism = PointMass::ball_on_floor(MASS, GRAVITY, RESTITUTION);
        let ball = Ball { mass: exact(MASS), gravity: exact(GRAVITY), restitution: exact(RESTITUTION) };
        let mut state = State { time: 0.0, position: dvector![0.8], velocity: dvector![0.1] };
        for _ in 0..150 {
            let (q, v) = (state.position[0], state.velocity[0]);
            let next = step(scheme, &ProjectedGaussSeidel::default(), &mechanism, &state, h).expect("a ball can be stepped");
            let outcome = reference(&ball, &BallState { position: exact(q), velocity: exact(v) }, &exact(h));
            assert_eq!(outcome.active, !next.assembled.active.is_empty(), "{} at q = {q}, v = {v}", scheme.name());
            let fall = GRAVITY * h;
            // Stewart–Trinkle forms φ/h, whose size is that of a speed, and Schatzman–Paoli up to twice that.
            let speed = v.abs() + if outcome.active { 2.0 * q.abs() / h } else { 0.0 };
            let velocity_error = next.state.velocity[0] - outcome.motion.velocity.to_f64().value();
            let position_error = next.state.position[0] - outcome.motion.position.to_f64().value();
            assert!(velocity_error.abs() <= ball_velocity(speed, fall), "{}: v off by {velocity_error}", scheme.name());
            assert!(position_error.abs() <= ball_position(q.abs(), speed, fall, h), "{}: q off by {position_error}", scheme.name());
            state = next.state;
        }
    }

    #[test]
    fn moreau_jean_in_floats_agrees_with_the_exact_step() {
        for activation in Activation::ALL {
            for theta in [0.0, 0.3, 0.5, 1.0] {
                let scheme = MoreauJean { theta, activation, restitution: RestitutionRule::NormalOnly };
                agree(&scheme, |ball, now, h| ball.moreau_jean(now, &exact(theta), activation, h));
            }
        }
    }

    #[test]
    fn stewart_trinkle_in_floats_agrees_with_the_exact_step() {
        agree(&StewartTrinkle::default(), |ball, now, h| ball.stewart_trinkle(now, h));
    }

    #[test]
    fn schatzman_paoli_in_floats_agrees_with_the_exact_step() {
        agree(&SchatzmanPaoli, |ball, now, h| ball.schatzman_paoli(now, h));
    }

    #[test]
    fn generalised_alpha_in_floats_agrees_with_the_exact_step() {
        agree(&GeneralisedAlpha::default(), |ball, now, h| ball.generalised_alpha(now, h));
    }

    #[test]
    fn stewart_trinkle_lands_exactly_on_the_floor() {
        let ball = Ball { mass: Rational::ratio(1, 1), gravity: Rational::ratio(10, 1), restitution: Rational::ratio(1, 2) };
        let start = BallState { position: Rational::ratio(1, 20), velocity: Rational::ratio(0, 1) };
        let landed = ball.stewart_trinkle(&start, &Rational::ratio(1, 10));
        assert_eq!(landed.motion, BallState { position: Rational::ratio(0, 1), velocity: Rational::ratio(-1, 2) });
    }
}
