//! Does θ = 1 bring everything to rest? Pendulum, satellite, elastic collisions.

use crate::claims::experiments::theta_energy::{chain_energies, distinct, oscillator_under};
use crate::claims::prelude::*;
use crate::exact_particle::{Ball, BallState};
use crate::schemes::Activation;
use crate::tolerance::claims::theta_scheme::{elastic_energy_swing, fewest_bounces};
use crate::tolerance::rounding;
use std::collections::BTreeSet;

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S3.energy-runs-down",
    statement: r"$\theta = 1$ draws energy off artificially; where long-term conservation matters (satellite, pendulum, chains of elastic
        collisions) the simulation runs ever slower until it stands still.",
    verdict: ClaimVerdict::False,
    kind: Kind::Assertion,
    severity: Some(Severity::WrongStatement),
    evidence: Evidence::Certified,
    correct_statement: r"True for the pendulum and other oscillators. Elastic collisions do not run down: without forces $\theta$ has no
        effect on the energy, and under gravity $E - (\theta - \tfrac12)\,m\,g\,h\,v$ is conserved exactly across flights and impacts, so
        $E$ only oscillates by $O(h)$. A satellite loses energy, but by falling to a lower and faster orbit.",
    argument: r"Elastic ball, $\theta = 1$, dropped from 1/2 m, 500 steps of $h = 1/100$ s and eight bounces in rationals: the invariant
        takes one value, for the activation rules A, B and D (A: $\varphi \le 0$, B: $\varphi + \tfrac12hu \le 0$, D:
        $\varphi + h\,u_\text{free} \le 0$). Three equal balls with $e = 1$: one value of the kinetic energy through two collisions.
        Satellite from a circular orbit of radius 1, speed 1, 250 steps of $h = 1/50$ by backward Euler: energy falls by 0.173, the radius
        shrinks to 0.74 and the speed grows to 1.17. Oscillator with $\omega = 1$: $E$ falls by the factor $(1 + h^2)^{-N}$.",
    controls: &[
        r"$e = 1/2$ for the ball and the chain, and a spring in place of the satellite's gravity: these run down.",
        r"Forward Euler, $\theta = 0$, for the oscillator and the satellite.",
    ],
    sources: &["chapter §3, common pitfalls (“the larger θ the better”)"],
    check: check!(runs_down),
}];

/// A ball under θ = 1: number of distinct values of the invariant, bounces, and E(end)/E(0).
fn elastic_ball(activation: Activation, steps: usize, restitution: Rational) -> (usize, usize, Rational) {
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(981, 100), restitution };
    let (theta, h) = (ratio(1, 1), ratio(1, 100));
    let mut now = BallState { position: ratio(1, 2), velocity: ratio(0, 1) };
    let start = ball.energy(&now);
    let mut values = BTreeSet::from([ball.scheme_energy(&now, &theta, &h)]);
    let mut bounces = 0;
    for _ in 0..steps {
        let outcome = ball.moreau_jean(&now, &theta, activation, &h);
        bounces += usize::from(outcome.impulse > ratio(0, 1));
        now = outcome.motion;
        values.insert(ball.scheme_energy(&now, &theta, &h));
    }
    (values.len(), bounces, ball.energy(&now) / start)
}

/// What draws the satellite to the centre with 1 m/s² at 1 m.
#[derive(Clone, Copy, PartialEq)]
enum Pull {
    /// q/|q|³ .
    Gravity,
    /// q .
    Spring,
}

impl Pull {
    fn at(self, q: &DVector<f64>) -> DVector<f64> {
        if self == Pull::Gravity { q / q.norm().powi(3) } else { q.clone() }
    }

    fn potential(self, q: &DVector<f64>) -> f64 {
        if self == Pull::Gravity { -1.0 / q.norm() } else { 0.5 * q.norm_squared() }
    }

    /// (energy lost, radius, speed) of a satellite from a circular orbit of radius and speed 1.
    fn orbit_end(self, q: &DVector<f64>, v: &DVector<f64>) -> [f64; 3] {
        let start = 0.5 + self.potential(&dvector![1.0, 0.0]);
        [start - 0.5 * v.norm_squared() - self.potential(q), q.norm(), v.norm()]
    }
}

/// The satellite after forward Euler steps.
fn explicit_satellite(steps: usize, h: f64) -> [f64; 3] {
    let (mut q, mut v): (DVector<f64>, DVector<f64>) = (dvector![1.0, 0.0], dvector![0.0, 1.0]);
    for _ in 0..steps {
        let pull = Pull::Gravity.at(&q);
        q += &v * h;
        v -= pull * h;
    }
    Pull::Gravity.orbit_end(&q, &v)
}

/// The satellite after backward Euler steps.
fn satellite(pull: Pull, steps: usize, h: f64) -> [f64; 3] {
    let (mut q, mut v) = (dvector![1.0, 0.0], dvector![0.0, 1.0]);
    for _ in 0..steps {
        let mut next = &q + &v * h;
        loop {
            let velocity = &v - pull.at(&next) * h;
            let improved = &q + &velocity * h;
            let moved = (&improved - &next).norm();
            next = improved;
            if moved <= rounding(2, 1.0) {
                (q, v) = (next, velocity);
                break;
            }
        }
    }
    pull.orbit_end(&q, &v)
}

fn runs_down(reading: Reading) -> Result<Vec<Finding>> {
    const STEPS: usize = 500;
    let (gravity, height, h) = (9.81, 0.5, 0.01);
    let kept = 1.0 - elastic_energy_swing(gravity, height, h);
    let oscillator = oscillator_under(&reading.only(1).pick(ratio(1, 1), ratio(0, 1)), STEPS);
    let mut findings = vec![Finding::at_most("E(end)/E(start) of an oscillator, θ = 1, 500 steps", oscillator, kept, "1")];
    let e = reading.only(0).pick(ratio(1, 1), ratio(1, 2));
    for activation in Activation::ALL {
        let ratio = Scalar::to_f64(&elastic_ball(activation, STEPS, e.clone()).2);
        let name = format!("the energy of a bouncing ball falls by more than its swing, rule {}", activation.name());
        findings.push(Finding::decision(name, ratio < kept, false).says(true));
    }
    let energies = chain_energies(1.0, Scalar::to_f64(&e))?;
    findings.push(Finding::decision("the kinetic energy of three colliding balls changes", distinct(&energies) > 1, false).says(true));
    let [lost, radius, speed] = match reading {
        Reading::Recorded => satellite(Pull::Gravity, 250, 0.02),
        Reading::Control(0) => satellite(Pull::Spring, 250, 0.02),
        Reading::Control(_) => explicit_satellite(250, 0.02),
    };
    findings.push(Finding::at_least("energy that the satellite loses", lost, 0.0, "J/kg"));
    findings.push(Finding::at_least("its speed, 1 at the start", speed, 1.0, "m/s").says_at_most(1.0));
    findings.push(Finding::at_most("radius of its orbit, 1 at the start", radius, 1.0, "m").context());
    let values = Activation::ALL.map(|activation| elastic_ball(activation, STEPS, ratio(1, 1)));
    let fewest = values.iter().map(|(_, bounces, _)| *bounces).min().unwrap_or(0);
    let least = fewest_bounces(gravity, height, h, STEPS as f64 * h);
    findings.push(Finding::at_least("bounces of the elastic ball, fewest of three rules", fewest as f64, least, "1").context());
    let most = values.iter().map(|(values, ..)| *values).max().unwrap_or(0);
    findings.push(Finding::count("distinct values of E − (θ−½) m g h v of the elastic ball, most of three rules", most, 1).context());
    Ok(findings)
}
