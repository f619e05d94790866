//! Family 5: what an impact leaves of velocity and energy.
//!
//! ```text
//!     v⁺ = −e v⁻ ,    |v⁺²/V² − e²| ≤ e² (2η + η²) , η = δ₀ g h/V ,    ΔẼ = −½ m (1−e) |v⁻| ((1+e)|v⁻| + g h) ,
//! ```
//! with V = √(2 g q₀) the exact impact speed and Ẽ = E − (θ−½) m g h v, which free flight conserves.
//! The second follows from |v⁻| = V(1 ± η), where δ₀ bounds the error of the first impact speed in units of g h
//! ([`crate::tolerance::zeno`], 3); the third is the bounce step inserted into Ẽ. A ratio taken over one step is
//! exactly e² whatever the scheme does between impacts; taken against the fall it is e² only up to O(h).

use super::zeno::DroppedBall;
use crate::finding::Finding;
use moreau_contact::solvers::ProjectedGaussSeidel;
use moreau_dynamics::exact_particle::{Ball, BallState, BallStep};
use moreau_dynamics::mechanics::State;
use moreau_dynamics::schemes::{Activation, MoreauJean, Scheme, step};
use moreau_dynamics::tolerance::schemes;
use moreau_exact::scalar::{Rational, ratio};
use moreau_exact::tolerance::rounding;
use moreau_exact::{Error, Result};

/// Steps a ball through its first impact: the states before and after it.
///
/// # Errors
/// Those of the scheme and the solver, or if no impulse acts within twice the time of the fall.
pub fn first_impact(subject: &dyn Scheme, ball: &DroppedBall, h: f64) -> Result<[State; 2]> {
    let (mechanism, mut state) = ball.at_rest();
    let solver = ProjectedGaussSeidel::default();
    let fall = ball.impact_speed() / (ball.gravity * h);
    for _ in 0..(2.0 * fall).ceil() as usize + 2 {
        let next = step(subject, &solver, &mechanism, &state, h)?;
        if next.impulses.iter().any(|contact| contact.impulse[0] > 0.0) {
            return Ok([state, next.state]);
        }
        state = next.state;
    }
    Err(Error::Unsupported(format!("{}: no impact within twice the time of the fall", subject.name())))
}

/// Name of the finding that compares the energy after the first impact with that of the fall.
pub const ENERGY_OF_BOUNCE: &str = "energy of the bounce over energy of the fall";

/// Velocity, kinetic energy and scheme energy over the first impact of a dropped ball, held against what is proved for
/// Moreau–Jean with the parameters `proved`.
///
/// # Errors
/// Those of [`first_impact`].
pub fn impact(subject: &dyn Scheme, proved: &MoreauJean, ball: &DroppedBall, h: f64) -> Result<Vec<Finding>> {
    let [before, after] = first_impact(subject, ball, h)?;
    let (v, w) = (before.velocity[0], after.velocity[0]);
    let (e, fall) = (ball.restitution, ball.gravity * h);
    let rounded = schemes::ball_velocity(v.abs(), fall);
    let exact_speed = ball.impact_speed();
    let deviation = ball.drop(proved, h).first_impact() * fall / exact_speed;
    let bound = e * e * (2.0 * deviation + deviation * deviation);
    let lost = scheme_energy(ball, proved, &before, h) - scheme_energy(ball, proved, &after, h);
    let expected = 0.5 * ball.mass * (1.0 - e) * v.abs() * ((1.0 + e) * v.abs() + fall);
    let energy_rounding = energy_rounding(ball, &before, h);
    Ok(vec![
        Finding::equal("velocity ratio of the impact", -w / v, e, rounded / v.abs(), "1"),
        Finding::equal(ENERGY_OF_BOUNCE, (w / exact_speed).powi(2), e * e, bound + rounding(8, 1.0), "1"),
        Finding::equal("scheme energy lost", lost, expected, energy_rounding, "J"),
    ])
}

/// Ẽ = ½ m v² + m g q − (θ−½) m g h v \[J\].
fn scheme_energy(ball: &DroppedBall, scheme: &MoreauJean, state: &State, h: f64) -> f64 {
    let (q, v) = (state.position[0], state.velocity[0]);
    ball.mass * (0.5 * v * v + ball.gravity * q - (scheme.theta - 0.5) * ball.gravity * h * v)
}

/// Rounding of the difference of two Ẽ: the states carry the rounding of one step, multiplied by |∂Ẽ/∂v| ≤ m(|v| + g h)
/// and |∂Ẽ/∂q| = m g; evaluating costs twelve operations on numbers of the size of Ẽ's terms.
fn energy_rounding(ball: &DroppedBall, before: &State, h: f64) -> f64 {
    let (q, v, fall) = (before.position[0].abs(), before.velocity[0].abs(), ball.gravity * h);
    let size = v * v + ball.gravity * q + fall * v + fall * fall;
    let of_states = (v + fall) * schemes::ball_velocity(v, fall) + ball.gravity * schemes::ball_position(q, v, fall, h);
    ball.mass * (rounding(12, 4.0 * size) + 2.0 * of_states)
}

/// Ẽ of an elastic ball (e = 1) after every one of `steps` steps equals its initial value, exactly and for every θ.
pub fn elastic_invariant(
    ball: &Ball<Rational>,
    start: &BallState<Rational>,
    theta: &Rational,
    activation: Activation,
    h: &Rational,
    steps: usize,
) -> Vec<Finding> {
    let initial = ball.scheme_energy(start, theta, h);
    let mut motion = start.clone();
    let mut farthest = initial.clone();
    let mut bounces = 0usize;
    for _ in 0..steps {
        let outcome = ball.moreau_jean(&motion, theta, activation, h);
        bounces += usize::from(outcome.impulse > Rational::ZERO);
        motion = outcome.motion;
        let energy = ball.scheme_energy(&motion, theta, h);
        if energy != initial {
            farthest = energy;
        }
    }
    let mut findings = vec![Finding::exact("scheme energy of the elastic ball", &farthest, &initial, "J")];
    if steps > 0 {
        findings.push(Finding::at_least("impulses on the way", bounces as f64, 1.0, "1"));
    }
    findings
}

/// The ball of the chapter's worked example: m = 1 kg, g = 10 m/s², e = ½.
pub fn worked_ball() -> Ball<Rational> {
    Ball { mass: ratio(1, 1), gravity: ratio(10, 1), restitution: ratio(1, 2) }
}

/// The contact step of the chapter's worked example: q = 0.005 m, v = −0.99 m/s, h = 0.01 s, rule D.
///
/// ```
/// use moreau_checks::energy::{worked_ball, worked_step};
/// use moreau_exact::scalar::ratio;
///
/// let step = worked_step(&worked_ball(), &ratio(1, 1));
/// assert_eq!((step.impulse, step.motion.velocity), (ratio(317, 200), ratio(99, 200))); // as the chapter prints them
/// ```
pub fn worked_step(ball: &Ball<Rational>, theta: &Rational) -> BallStep<Rational> {
    let before = BallState { position: ratio(5, 1000), velocity: ratio(-99, 100) };
    ball.moreau_jean(&before, theta, Activation::FreeVelocityForecast, &ratio(1, 100))
}

/// Impulse, velocity, height and kinetic energy ratio of the worked contact step, for θ = 1 and θ = ½.
pub fn worked_example(ball: &Ball<Rational>) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (theta, height) in [(ratio(1, 1), ratio(199, 20000)), (ratio(1, 2), ratio(101, 40000))] {
        let outcome = worked_step(ball, &theta);
        let energy = ball.kinetic_energy(&outcome.motion.velocity) / ball.kinetic_energy(&ratio(-99, 100));
        findings.push(Finding::exact(format!("impulse, θ = {theta}"), &outcome.impulse, &ratio(317, 200), "N·s"));
        findings.push(Finding::exact(format!("velocity after, θ = {theta}"), &outcome.motion.velocity, &ratio(99, 200), "m/s"));
        findings.push(Finding::exact(format!("height after, θ = {theta}"), &outcome.motion.position, &height, "m"));
        findings.push(Finding::exact(format!("kinetic energy ratio, θ = {theta}"), &energy, &ratio(1, 4), "1"));
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worked_contact_step_is_exact() {
        for finding in worked_example(&worked_ball()) {
            assert!(finding.holds(), "{finding}");
        }
    }

    #[test]
    fn another_restitution_fails_the_worked_step() {
        let ball = Ball { restitution: ratio(51, 100), ..worked_ball() };
        assert!(worked_example(&ball).iter().any(|finding| !finding.holds()));
    }

    #[test]
    fn the_invariant_belongs_to_its_own_theta() {
        let ball = Ball { restitution: ratio(1, 1), ..worked_ball() };
        let start = BallState { position: ratio(1, 20), velocity: ratio(0, 1) };
        let h = ratio(1, 100);
        let end = (0..20).fold(start.clone(), |now, _| ball.moreau_jean(&now, &ratio(1, 1), Activation::Gap, &h).motion);
        assert_eq!(ball.scheme_energy(&end, &ratio(1, 1), &h), ball.energy(&start));
        assert_ne!(ball.energy(&end), ball.energy(&start));
    }
}
