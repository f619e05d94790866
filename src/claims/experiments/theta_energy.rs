//! What θ does to an energy: of springs and free falls, of a pendulum, of collisions, of a tower.

use super::pendulum::Swing;
use super::soft::GRAVITY;
use super::theta_step::{LinearSystem, coupled_pair, phase};
use super::tower::{Sweeps, Tower};
use crate::Result;
use crate::mechanics::{BallChain, Mechanism, State};
use crate::scalar::{Rational, Scalar, ratio};
use crate::schemes::{Activation, MoreauJean, RestitutionRule, simulate};
use crate::solvers::LemkePivoting;
use nalgebra::dvector;
use std::collections::BTreeSet;

/// E(end)/E(0) of q̈ = −q, h = 1/100.
pub fn oscillator_under(theta: &Rational, steps: usize) -> f64 {
    let oscillator = LinearSystem::scalar(ratio(1, 1), ratio(1, 1), ratio(0, 1));
    let start = phase(ratio(1, 1), ratio(0, 1));
    let next = oscillator.step(&start, theta, &ratio(1, 100)).0;
    let factor = Scalar::to_f64(&(oscillator.energy(&next) / oscillator.energy(&start)));
    factor.powi(steps as i32)
}

/// Kinetic energies, sample by sample, of three equal balls in line, the first at 1 m/s.
pub fn chain_energies(theta: f64, restitution: f64) -> Result<Vec<f64>> {
    let chain = BallChain::new(vec![1.0; 3], vec![0.125; 3], restitution)?;
    let scheme = MoreauJean { theta, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
    let start = State { time: 0.0, position: dvector![0.0, 0.5, 1.0], velocity: dvector![1.0, 0.0, 0.0] };
    let recording = simulate(&scheme, &LemkePivoting, &chain, start, 0.03125, 64)?;
    let moved = recording.last().velocity[2] > 0.0;
    let energies = recording.samples.iter().map(|state| chain.kinetic_energy(state)).collect();
    if moved { Ok(energies) } else { Err(crate::Error::Unsupported("the last ball should carry motion away".into())) }
}

/// How many different numbers there are in a list.
pub fn distinct(values: &[f64]) -> usize {
    values.iter().map(|value| value.to_bits()).collect::<BTreeSet<u64>>().len()
}

/// Size of the change of energy of two coupled masses over 3 steps, and of a fall over 100.
pub fn energy_change_under(theta: &Rational) -> Rational {
    let (system, start) = coupled_pair();
    let mut now = start.clone();
    for _ in 0..3 {
        now = system.step(&now, theta, &ratio(1, 10)).0;
    }
    let gravity_only = LinearSystem::scalar(ratio(1, 1), ratio(0, 1), ratio(-981, 100));
    let mut falling = phase(ratio(1, 1), ratio(0, 1));
    let before = gravity_only.energy(&falling);
    for _ in 0..100 {
        falling = gravity_only.step(&falling, theta, &ratio(1, 100)).0;
    }
    let springs = system.energy(&now) - system.energy(&start);
    let fall = gravity_only.energy(&falling) - before;
    springs.magnitude() + fall.magnitude()
}

/// Change of energy of the pendulum over one step from (1.3, 0.7).
pub fn pendulum_energy_change(h: f64) -> f64 {
    let swing = Swing { angle: 1.3, rate: 0.7 };
    swing.step(h).energy() - swing.energy()
}

/// Stiffness of springs that a tower hangs on \[N/m\].
pub const SPRING: f64 = 100.0;

/// Largest difference of the velocities of a tower, 10 cold sweeps a step, between θ = ½ and θ = 1 over 100 steps \[m/s\]; the bodies hang
/// on springs as well, if their stiffness \[N/m\] is not 0.
pub fn effect_of_theta_on_a_tower(stiffness: f64) -> Result<f64> {
    let tower = Tower { bodies: 5, gravity: GRAVITY, stiffness };
    let run = |theta: f64| tower.simulate(&Sweeps::cold(10), theta, 0.01, 100);
    let (half, one) = (run(0.5)?, run(1.0)?);
    let pairs = half.samples.iter().zip(&one.samples);
    Ok(pairs.map(|(a, b)| (&a.velocity - &b.velocity).amax()).fold(0.0, f64::max))
}
