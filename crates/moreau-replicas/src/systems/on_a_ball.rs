//! Steps of a ball on a floor: each against the same step in exact rationals, and the whole drop against its closed form.

use super::Measured;
use moreau_checks::convergence::ball_errors;
use moreau_checks::tolerance::convergence::Impacts;
use moreau_contact::solvers::Auto;
use moreau_dynamics::exact_particle::{Ball, BallState};
use moreau_dynamics::mechanics::{PointMass, State};
use moreau_dynamics::schemes::{MoreauJean, Scheme, step};
use moreau_dynamics::tolerance::schemes::{ball_position, ball_velocity};
use moreau_exact::scalar::{Rational, exact};
use moreau_exact::{Error, Result};
use moreau_forms::BouncingBall;
use nalgebra::dvector;

/// m \[kg\], g \[m/s²\], e, h \[s\]: fractions that are not binary, so that every operation rounds.
const MASS: f64 = 0.7;
const GRAVITY: f64 = 9.81;
const RESTITUTION: f64 = 0.6;
const TIME_STEP: f64 = 0.013;
/// Falls 0.8 m within 31 steps, then bounces or rests.
const STEPS: usize = 150;

/// Velocities after each step, from the scheme's own states, against the exact step \[m/s\].
///
/// # Errors
/// Those of the scheme.
pub fn velocities(
    scheme: &dyn Scheme,
    next: impl Fn(&Ball<Rational>, &BallState<Rational>, &Rational) -> BallState<Rational>,
) -> Result<Measured> {
    compare(scheme, next, |state, exact, speed| {
        let difference = (state.velocity[0] - exact.velocity.to_f64().value()).abs();
        Measured::within(difference, ball_velocity(speed, GRAVITY * TIME_STEP))
    })
}

/// Positions after each step, likewise \[m\].
///
/// # Errors
/// Those of the scheme.
pub fn positions(
    scheme: &dyn Scheme,
    next: impl Fn(&Ball<Rational>, &BallState<Rational>, &Rational) -> BallState<Rational>,
) -> Result<Measured> {
    compare(scheme, next, |state, exact, speed| {
        let difference = (state.position[0] - exact.position.to_f64().value()).abs();
        // the step before is one fall above or below
        let height = state.position[0].abs() + TIME_STEP * (speed + GRAVITY * TIME_STEP);
        Measured::within(difference, ball_position(height, speed, GRAVITY * TIME_STEP, TIME_STEP))
    })
}

fn compare(
    scheme: &dyn Scheme,
    next: impl Fn(&Ball<Rational>, &BallState<Rational>, &Rational) -> BallState<Rational>,
    difference: impl Fn(&State, &BallState<Rational>, f64) -> Measured,
) -> Result<Measured> {
    let mechanism = PointMass::ball_on_floor(MASS, GRAVITY, RESTITUTION);
    let ball = Ball { mass: exact(MASS), gravity: exact(GRAVITY), restitution: exact(RESTITUTION) };
    let mut state = State { time: 0.0, position: dvector![0.8], velocity: dvector![0.1] };
    let mut comparisons = Vec::with_capacity(STEPS);
    for _ in 0..STEPS {
        let (q, v) = (state.position[0], state.velocity[0]);
        let reached = step(scheme, &Auto, &mechanism, &state, TIME_STEP)?.state;
        let wanted = next(&ball, &BallState { position: exact(q), velocity: exact(v) }, &exact(TIME_STEP));
        // a law on the gap forms φ/h, which is the size of a speed where it acts
        let speed = v.abs() + (q.abs() / TIME_STEP).min(2.0 * v.abs() + GRAVITY * TIME_STEP);
        comparisons.push(difference(&reached, &wanted, speed));
        state = reached;
    }
    Measured::worst(comparisons).ok_or_else(|| Error::Unsupported("no step was taken".into()))
}

/// The largest |q_k − q(t_k)| of a ball that drops 1 m with e = ½ until it rests, through all its impacts, at h = 1/1024 s \[m\], for a
/// scheme that should behave as `expected` does.
///
/// # Errors
/// Those of the scheme.
pub fn drop_to_rest(scheme: &dyn Scheme, expected: &MoreauJean) -> Result<Measured> {
    let (restitution, h) = (0.5, 1.0 / 1024.0);
    let horizon = 1.1 * (1.0 + restitution) / (1.0 - restitution);
    let forecast = expected.activation.forecast();
    let leading = Impacts { theta: expected.theta, forecast, restitution, shifts: 1, impacts: None, horizon };
    let fall = BouncingBall::new(GRAVITY, 1.0, restitution)?.first_impact_time();
    let tolerance = leading.position(fall / h).upper * GRAVITY * fall * h;
    Ok(Measured::within(ball_errors(scheme, restitution, horizon, h)?.position, tolerance))
}
