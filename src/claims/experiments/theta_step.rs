//! The θ step of a linear system without contact, in exact rationals, independent of the schemes.
//!
//! ```text
//!     M (v⁺ − v) = h F_θ ,   F_θ = f − K q_θ ,   q_θ = θ q⁺ + (1−θ) q ,   q⁺ = q + h (θ v⁺ + (1−θ) v)
//!     (M + h²θ²K)(v⁺ − v) = h (f − K q − hθ K v)
//! ```

use crate::elimination::solve;
use crate::scalar::{Rational, ratio};
use nalgebra::{DMatrix, DVector};

/// M v̇ = f − K q.
pub struct LinearSystem {
    /// M.
    pub mass: DMatrix<Rational>,
    /// K.
    pub stiffness: DMatrix<Rational>,
    /// f.
    pub constant: DVector<Rational>,
}

/// (q, v).
#[derive(Clone, Debug, PartialEq)]
pub struct Phase {
    pub position: DVector<Rational>,
    pub velocity: DVector<Rational>,
}

impl LinearSystem {
    /// A mass m under a constant force and a spring.
    pub fn scalar(mass: Rational, stiffness: Rational, constant: Rational) -> Self {
        LinearSystem {
            mass: DMatrix::from_element(1, 1, mass),
            stiffness: DMatrix::from_element(1, 1, stiffness),
            constant: DVector::from_element(1, constant),
        }
    }

    /// The state after a step, and F_θ.
    pub fn step(&self, now: &Phase, theta: &Rational, h: &Rational) -> (Phase, DVector<Rational>) {
        let implicit = &self.mass + &self.stiffness * (theta * theta * h * h);
        let reached = &now.position + &now.velocity * (theta * h);
        let push = (&self.constant - &self.stiffness * reached) * h.clone();
        let change = solve(&implicit, &push).expect("M + h²θ²K is positive definite");
        let velocity = &now.velocity + &change;
        let mean = &now.velocity + change * theta.clone();
        let position = &now.position + &mean * h.clone();
        let force = &self.constant - &self.stiffness * (&now.position + mean * (theta * h));
        (Phase { position, velocity }, force)
    }

    /// ½ vᵀM v.
    pub fn kinetic_energy(&self, now: &Phase) -> Rational {
        now.velocity.dot(&(&self.mass * &now.velocity)) * ratio(1, 2)
    }

    /// ½ vᵀM v + ½ qᵀK q − f·q.
    pub fn energy(&self, now: &Phase) -> Rational {
        let spring = now.position.dot(&(&self.stiffness * &now.position)) * ratio(1, 2);
        self.kinetic_energy(now) + spring - self.constant.dot(&now.position)
    }

    /// xᵀM⁻¹x.
    pub fn inverse_mass_norm(&self, x: &DVector<Rational>) -> Rational {
        x.dot(&solve(&self.mass, x).expect("M is positive definite"))
    }
}

/// A phase point of one velocity.
pub fn phase(position: Rational, velocity: Rational) -> Phase {
    Phase { position: DVector::from_element(1, position), velocity: DVector::from_element(1, velocity) }
}

/// A coupled pair of masses on springs under a constant force, with a phase point.
pub fn coupled_pair() -> (LinearSystem, Phase) {
    let r = |x: i64| ratio(x, 1);
    let square = |entries: [i64; 4]| DMatrix::from_row_slice(2, 2, &entries.map(r));
    let system = LinearSystem {
        mass: square([2, 1, 1, 3]),
        stiffness: square([5, -2, -2, 4]),
        constant: DVector::from_vec(vec![r(1), ratio(-981, 100)]),
    };
    let start = Phase { position: DVector::from_vec(vec![r(1), ratio(-1, 3)]), velocity: DVector::from_vec(vec![ratio(1, 2), r(-2)]) };
    (system, start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_step_satisfies_its_own_definition() {
        let (system, start) = coupled_pair();
        let h = ratio(1, 7);
        for theta in [ratio(0, 1), ratio(1, 2), ratio(1, 1)] {
            let (next, force) = system.step(&start, &theta, &h);
            let between = |a: &DVector<Rational>, b: &DVector<Rational>| b * theta.clone() + a * (ratio(1, 1) - &theta);
            assert_eq!(&system.mass * (&next.velocity - &start.velocity), &force * h.clone());
            assert_eq!(force, &system.constant - &system.stiffness * between(&start.position, &next.position));
            assert_eq!(next.position, &start.position + between(&start.velocity, &next.velocity) * h.clone());
        }
    }
}
