//! A ball of 1 kg dropped from 1 m onto a floor, in rationals: what θ does to its energy, and to what an impact keeps of it.
//!
//! ```text
//!     hard   Moreau–Jean with Newton's v⁺ = −e v: the only force that depends on no state is gravity, the floor's is an impulse
//!     soft   a spring and a damper while q ≤ 0, which push and do not pull:  F = −g − k q_θ − c v_θ ,  v_θ = v + θ Δ ,  q_θ = q + h θ v_θ
//!            (1 + h θ c + h²θ² k) Δ = h (−g − k q − (c + h θ k) v) ,   v⁺ = v + Δ ,   q⁺ = q + h v_θ
//! ```

use super::push_out::ball;
use crate::exact_particle::{Ball, BallState};
use crate::scalar::{Rational, ratio};
use crate::schemes::Activation;

/// What the ball falls on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Floor {
    /// Newton's law.
    Hard,
    /// A spring of 400 N/m under 1 kg, hω = 1/5.
    Soft,
}

/// The contact of a ball with its floor.
struct Contact {
    ball: Ball<Rational>,
    /// Stiffness \[N/m\] and damping \[N·s/m\] of a soft floor.
    spring: Option<[Rational; 2]>,
}

impl Floor {
    fn contact(self, restitution: Rational, damping: Rational) -> Contact {
        let spring = (self == Floor::Soft).then(|| [ratio(400, 1), damping]);
        Contact { ball: ball(restitution), spring }
    }

    /// e = 1, or a spring alone.
    fn elastic(self) -> Contact {
        self.contact(ratio(1, 1), ratio(0, 1))
    }

    /// e = 1/2, or the spring with the damping ratio 1/4, which without load and in continuous time has e = 0.51.
    fn damped(self) -> Contact {
        self.contact(ratio(1, 2), ratio(10, 1))
    }
}

impl Contact {
    /// The state after a step, and whether the floor pushed in it.
    fn step(&self, now: &BallState<Rational>, theta: &Rational, h: &Rational) -> (BallState<Rational>, bool) {
        let zero = ratio(0, 1);
        let Some([stiffness, damping]) = &self.spring else {
            let outcome = self.ball.moreau_jean(now, theta, Activation::Gap, h);
            return (outcome.motion, outcome.impulse > zero);
        };
        let under = |stiffness: &Rational, damping: &Rational| {
            let slowed = damping + h * theta * stiffness;
            let pull = &self.ball.gravity + stiffness * &now.position + slowed * &now.velocity;
            -(h * pull) / (ratio(1, 1) + h * theta * damping + h * h * theta * theta * stiffness)
        };
        let (flying, touching) = (under(&zero, &zero), under(stiffness, damping));
        let pushed = now.position <= zero && touching > flying;
        let change = if pushed { touching } else { flying };
        let position = &now.position + h * (&now.velocity + theta * &change);
        (BallState { position, velocity: &now.velocity + change }, pushed)
    }

    /// E − (θ−½) m g h v, the energy of the spring included.
    fn scheme_energy(&self, now: &BallState<Rational>, theta: &Rational, h: &Rational) -> Rational {
        let stiffness = self.spring.as_ref().filter(|_| now.position < ratio(0, 1)).map_or_else(|| ratio(0, 1), |[k, _]| k.clone());
        self.ball.scheme_energy(now, theta, h) + ratio(1, 2) * stiffness * &now.position * &now.position
    }
}

fn dropped() -> (BallState<Rational>, Rational) {
    (BallState { position: ratio(1, 1), velocity: ratio(0, 1) }, ratio(1, 100))
}

/// (E − ½ m g h v)/E₀ of the elastic ball after 2000 steps with θ = 1 and h = 1/100 s.
pub fn elastic_invariant(floor: Floor) -> Rational {
    let (contact, theta, (start, h)) = (floor.elastic(), ratio(1, 1), dropped());
    let end = (0..2000).fold(start.clone(), |now, _| contact.step(&now, &theta, &h).0);
    contact.scheme_energy(&end, &theta, &h) / contact.ball.energy(&start)
}

/// Kinetic energy after the first impact over that before it, e = 1/2, h = 1/100 s. An impact lasts as long as the floor pushes.
pub fn first_impact(floor: Floor, theta: &Rational) -> Rational {
    let (contact, (mut now, h)) = (floor.damped(), dropped());
    let mut arriving = None;
    loop {
        let (next, pushed) = contact.step(&now, theta, &h);
        match (&arriving, pushed) {
            (None, true) => arriving = Some(now.velocity.clone()),
            (Some(before), false) => return contact.ball.kinetic_energy(&now.velocity) / contact.ball.kinetic_energy(before),
            _ => {}
        }
        now = next;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_soft_floor_bounces_the_ball_about_as_high_as_the_hard_one_does() {
        let kept = |floor| first_impact(floor, &ratio(1, 2));
        assert_eq!(kept(Floor::Hard), ratio(1, 4));
        assert!(kept(Floor::Soft) > ratio(1, 5) && kept(Floor::Soft) < ratio(3, 10), "{}", kept(Floor::Soft));
    }

    #[test]
    fn in_flight_both_floors_leave_the_ball_alone() {
        let ((start, h), theta) = (dropped(), ratio(1, 3));
        let [hard, soft] = [Floor::Hard, Floor::Soft].map(|floor| floor.elastic().step(&start, &theta, &h));
        assert_eq!(hard, soft);
    }
}
