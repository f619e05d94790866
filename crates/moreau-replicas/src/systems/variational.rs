//! The variational, hence symplectic integrator with elastic impacts: discrete Euler–Lagrange equations.
//!
//! ```text
//!     D = ∂(q⁺, p⁺)/∂(q, p) :   DᵀJD = J ,  det D = 1                              also through an impact
//!     ball, impact after τ:     w⁺² = w² + ¼ g² h (h − 2τ)                         w, w⁺: speeds at the floor before and after
//! ```

use super::planted::{Kind, mistake};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System, on_a_spring};
use crate::tolerance::systems::{variational_speed, variational_state};
use moreau_contact::solvers::Auto;
use moreau_dynamics::integrators::Method;
use moreau_dynamics::integrators::Phase;
use moreau_dynamics::integrators::jacobian::jacobian;
use moreau_dynamics::integrators::symplectic::{defect, volume};
use moreau_dynamics::integrators::variational::{Guess, InPotential, ScalarField, Variational as Equations, Verlet};
use moreau_dynamics::mechanics::{OscillatorWithStop, PointMass, State};
use moreau_dynamics::schemes::{Euler, MoreauJean, Scheme, Variational, simulate, step};
use moreau_exact::Result;
use moreau_exact::scalar::{Dual, Rational, Scalar, ratio};
use nalgebra::{DMatrix, DVector, dvector};

pub static SYSTEM: System = System {
    name: "symplectic, variational",
    level: ConstraintLevel::Position,
    cone: Cone::None,
    law: ContactLaw::None,
    algorithm: "discrete Euler–Lagrange equations, with the time of the impact as an unknown",
    restitution: "e = 1 only: the discrete energy is kept",
    position_update: "q + h(v + ½h a)",
    schemes: &["variational"],
    held_against: &[
        Agreement {
            against: "exact rationals",
            quantity: "state after each step of a spring, relative",
            unit: "1",
            measure: |_| on_a_spring::steps(&Variational, &Verlet),
            planted: &[mistake(Kind::Scheme, "systems/semi-implicit-in-its-place", "semi-implicit Euler in its place", |_| {
                on_a_spring::steps(&Euler::SemiImplicit, &Verlet)
            })],
        },
        Agreement {
            against: "closed form",
            quantity: "speed of a ball after each of its elastic impacts",
            unit: "m/s",
            measure: |_| speeds_of_a_ball(&Variational),
            planted: &[mistake(Kind::Scheme, "systems/moreau-jean-in-its-place", "Moreau–Jean with θ = ½ in its place", |_| {
                speeds_of_a_ball(&midpoint())
            })],
        },
        Agreement {
            against: "Newton's method on dual numbers",
            quantity: "state after a step in which a spring hits its stop, relative",
            unit: "1",
            measure: |_| spring_at_its_stop(&Variational),
            planted: &[mistake(Kind::Scheme, "systems/moreau-jean-in-its-place", "Moreau–Jean with θ = ½ in its place", |_| {
                spring_at_its_stop(&midpoint())
            })],
        },
        Agreement {
            against: "exact rationals",
            quantity: "DᵀJD − J of a step with an impact, forward-mode differentiation",
            unit: "1",
            measure: |_| largest(|jacobian| defect(jacobian, &DMatrix::identity(1, 1)), |velocity| velocity),
            planted: &[mistake(Kind::Scheme, "systems/impact-loses-speed", "one fifth of the velocity lost in the impact", |_| {
                largest(|jacobian| defect(jacobian, &DMatrix::identity(1, 1)), slowed)
            })],
        },
        Agreement {
            against: "exact rationals",
            quantity: "det D − 1 of the same step",
            unit: "1",
            measure: |_| largest(|jacobian| DMatrix::from_element(1, 1, volume(jacobian) - ratio(1, 1)), |velocity| velocity),
            planted: &[mistake(Kind::Scheme, "systems/impact-loses-speed", "one fifth of the velocity lost in the impact", |_| {
                largest(|jacobian| DMatrix::from_element(1, 1, volume(jacobian) - ratio(1, 1)), slowed)
            })],
        },
    ],
};

const GRAVITY: f64 = 9.81;
const TIME_STEP: f64 = 0.02;

/// |w⁺ − √(w² + ¼ g² h(h − 2τ))| \[m/s\], τ from the parabola that leads to the impact.
fn speeds_of_a_ball(scheme: &dyn Scheme) -> Result<Measured> {
    let ball = PointMass::ball_on_floor(0.7, GRAVITY, 1.0);
    let start = State { time: 0.0, position: dvector![0.8], velocity: dvector![0.1] };
    let run = simulate(scheme, &Auto, &ball, start, TIME_STEP, 2000)?;
    let at_the_floor = |state: &State| (state.velocity[0].powi(2) + 2.0 * GRAVITY * state.position[0]).sqrt();
    let comparisons = run.samples.windows(2).zip(&run.impulses).filter(|(_, impulses)| !impulses.is_empty()).map(|(pair, _)| {
        let speed = at_the_floor(&pair[0]);
        let time = (pair[0].velocity[0] + speed) / GRAVITY;
        let expected = (speed * speed + 0.25 * GRAVITY * GRAVITY * TIME_STEP * (TIME_STEP - 2.0 * time)).sqrt();
        Measured::within((at_the_floor(&pair[1]) - expected).abs(), variational_speed(speed, GRAVITY * TIME_STEP))
    });
    Ok(Measured::worst(comparisons).unwrap_or(Measured::within(f64::NAN, 0.0)))
}

/// V = ½ k q² with unit mass, φ = q − stop.
#[derive(Clone, Copy)]
struct Spring {
    stiffness: (i64, i64),
}

#[derive(Clone, Copy)]
struct Stop {
    at: (i64, i64),
}

impl ScalarField for Spring {
    fn value<T: Scalar>(&self, position: &DVector<T>) -> T {
        let (over, under) = self.stiffness;
        position[0].clone() * position[0].clone() * T::ratio(over, 2 * under)
    }
}

impl ScalarField for Stop {
    fn value<T: Scalar>(&self, position: &DVector<T>) -> T {
        position[0].clone() - T::ratio(self.at.0, self.at.1)
    }
}

const EQUATIONS: Equations<Spring, Stop> = Equations { potential: Spring { stiffness: (12, 1) }, gap: Stop { at: (-1, 8) } };

/// The scheme's step against the equations' own, with a bracketed root against Newton's method.
fn spring_at_its_stop(scheme: &dyn Scheme) -> Result<Measured> {
    let spring = OscillatorWithStop::new(1.0, 12.0, 0.0, -0.125, 1.0)?;
    let (position, velocity, h) = (0.07, -1.3, 0.25);
    let state = State { time: 0.0, position: dvector![position], velocity: dvector![velocity] };
    let found = step(scheme, &Auto, &spring, &state, h)?.state;
    let guess = Guess { time: 0.15, jump: 2.0 * 1.3, newton_steps: 8 };
    let wanted = EQUATIONS.step_with_impact(&Phase::of_one(position, velocity), &h, &guess);
    let difference = (found.position[0] - wanted.position[0]).abs().max((found.velocity[0] - wanted.velocity[0]).abs());
    Ok(Measured::within(difference / velocity.abs(), variational_state()))
}

/// The largest entry of a matrix that should vanish, made of the Jacobian of a step that hits the stop at 2 m/s in its middle.
///
/// Verlet's step is its own inverse, so that the start is found by going back, and the impact reverses the velocity.
fn largest(made: impl Fn(&DMatrix<Rational>) -> DMatrix<Rational>, after: impl Fn(Dual<Rational>) -> Dual<Rational>) -> Result<Measured> {
    let (h, time) = (ratio(1, 4), ratio(1, 8));
    let leaving = Phase::of_one(ratio(-1, 8), ratio(2, 1));
    let away = Verlet.step(&InPotential(EQUATIONS.potential), &leaving, &time);
    let guess = Guess { time: Dual::constant(time), jump: Dual::constant(ratio(4, 1)), newton_steps: 1 };
    let step = |x: &DVector<Dual<Rational>>| {
        let reached = EQUATIONS.step_with_impact(&Phase::from_stacked(x), &Dual::constant(h.clone()), &guess);
        Phase { velocity: reached.velocity.map(&after), ..reached }.stacked()
    };
    let start = Phase { velocity: -away.velocity, ..away };
    let entries = made(&jacobian(&start.stacked(), step));
    let difference = entries.iter().map(|entry| Scalar::to_f64(&entry.magnitude())).fold(0.0, f64::max);
    Ok(Measured::within(difference, 0.0))
}

fn midpoint() -> MoreauJean {
    MoreauJean { theta: 0.5, ..MoreauJean::default() }
}

fn slowed(velocity: Dual<Rational>) -> Dual<Rational> {
    velocity * Dual::constant(ratio(4, 5))
}
