//! Exact steps and free flights of one coordinate whose acceleration is a polynomial, told as witnesses.

use super::spring_damper::{OneStep, matrix};
use crate::exact_particle::BallState;
use crate::integrators::{Method, Phase, SmoothSystem, SpringDamper};
use crate::scalar::{Rational, ratio};
use moreau_exact::witness::{Part, Witness, decided};
use nalgebra::DMatrix;

/// A motion of one coordinate with an acceleration Σ c qᵃ vᵇ.
pub trait Polynomial: SmoothSystem {
    /// Rows (c, a, b).
    fn terms(&self) -> Vec<[Rational; 3]>;
}

impl Polynomial for SpringDamper {
    fn terms(&self) -> Vec<[Rational; 3]> {
        let [zero, one] = [0, 1].map(|power| ratio(power, 1));
        vec![[-self.stiffness_per_mass.clone(), one.clone(), zero.clone()], [-self.damping_per_mass.clone(), zero, one]]
    }
}

/// A state (q, v) and the one after the step.
type Pair = [[Rational; 2]; 2];

/// The witness of steps by a method, or of exact flights.
pub fn told(method: &'static str, terms: &[[Rational; 3]], h: &Rational, pairs: &[Pair]) -> Witness {
    let states = |place: usize| Part::Matrix(pairs.iter().map(|pair| pair[place].to_vec()).collect());
    let terms = Part::Matrix(terms.iter().map(|term| term.to_vec()).collect());
    let data = [("method", Part::Word(method)), ("terms", terms), ("step", h.into())];
    Witness::new("motion-step", data.into_iter().chain([("before", states(0)), ("after", states(1))]).collect())
}

fn word(method: &OneStep) -> Option<&'static str> {
    match method {
        OneStep::Explicit => Some("explicit-euler"),
        OneStep::SemiImplicit => Some("semi-implicit-euler"),
        OneStep::Verlet => Some("verlet"),
        OneStep::ImplicitDamping | OneStep::Theta(_) => None,
    }
}

/// A step of h.
pub fn step(method: &OneStep, system: &impl Polynomial, now: &Phase<Rational>, h: &Rational) -> Phase<Rational> {
    let state = |at: &Phase<Rational>| [at.position[0].clone(), at.velocity[0].clone()];
    decided(|| method.step(system, now, h), |after| Some(told(word(method)?, &system.terms(), h, &[[state(now), state(after)]])))
}

/// The matrix of a step h on a spring: its columns are what becomes of (1, 0) and (0, 1).
pub fn step_matrix(method: &OneStep, spring: &SpringDamper, h: &Rational) -> DMatrix<Rational> {
    let column = |found: &DMatrix<Rational>, j: usize| {
        let unit = [0, 1].map(|i| ratio(i64::from(i == j), 1));
        [unit, [found[(0, j)].clone(), found[(1, j)].clone()]]
    };
    let pairs = |found: &DMatrix<Rational>| [column(found, 0), column(found, 1)];
    decided(|| matrix(method, spring, h), |found| Some(told(word(method)?, &spring.terms(), h, &pairs(found))))
}

/// Free flight under gravity for a time t.
pub fn flight(now: &BallState<Rational>, gravity: &Rational, time: &Rational) -> BallState<Rational> {
    let fly = || {
        let fall = gravity.clone() * time;
        let mean = now.velocity.clone() - fall.clone() / ratio(2, 1);
        BallState { position: now.position.clone() + time * mean, velocity: now.velocity.clone() - fall }
    };
    decided(fly, |after| Some(under_gravity("flight", gravity, time, now, after)))
}

/// The witness of a step or a flight under gravity.
pub fn under_gravity(
    method: &'static str,
    gravity: &Rational,
    time: &Rational,
    now: &BallState<Rational>,
    after: &BallState<Rational>,
) -> Witness {
    let state = |at: &BallState<Rational>| [at.position.clone(), at.velocity.clone()];
    told(method, &[[-gravity.clone(), ratio(0, 1), ratio(0, 1)]], time, &[[state(now), state(after)]])
}
