//! §12, the contact step from q = 0.005 m, v = −0.99 m/s.

use super::motion::before_contact;
use crate::Result;
use crate::checks::Finding;
use crate::checks::energy::{worked_ball, worked_step};
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::defects::zeno::{Altered, Mistake};
use crate::exact_particle::{Ball, BallState};
use crate::mechanics::{PointMass, State};
use crate::problem::Lcp;
use crate::scalar::{Rational, ratio};
use crate::schemes::{self, Activation, MoreauJean, RestitutionRule, Scheme};
use crate::solvers::ProjectedGaussSeidel;
use crate::solvers::lemke::solution;
use crate::tolerance::schemes::ball_velocity;
use nalgebra::{DMatrix, DVector, dvector};

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S12.step",
        statement: "From q = 0.005, v = −0.99 with h = 0.01: v_free = −1.09, forecast −0.0059 < 0, U = P − 1.585, hence \
                    P = 1.585 N·s and v⁺ = 0.495 m/s.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated.",
        argument: "v_free = −99/100 − 1/10 = −109/100; forecast 1/200 − 109/10000 = −59/10000; U = v_free + P + ½v = \
                   P − 317/200; P = 317/200, v⁺ = 99/200. The f64 scheme with its solver gives the same within its rounding.",
        control: "The same step with e times v_free instead of e times v in the argument: P = 1.635 N·s.",
        sources: &["chapter §12, contact step"],
        check: contact_step,
    },
    Claim {
        id: "S12.vplus",
        statement: "The step satisfies the impact law: v⁺ = −e v⁻ = −0.5 · (−0.99) = 0.495 m/s.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated, with v⁻ the velocity v_ℓ at the start of the step (not v_free, the velocity just before \
                            the discrete impact).",
        argument: "v⁺ + e v_ℓ = 99/200 − 99/200 = 0; with v_free in place of v_ℓ it is 99/200 − 109/200 = −1/20.",
        control: "v⁻ read as v_free.",
        sources: &["chapter §12, check of the impact law"],
        check: impact_law,
    },
    Claim {
        id: "S12.impulse-split",
        statement: "The impulse splits as P = 1.585 = 1.09 + 0.495: first it cancels m|v_free|, then it produces m v⁺.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated; it holds for every mass, P = m|v_free| + m v⁺.",
        argument: "m(v⁺ − v_free) = P with v_free < 0 < v⁺: 109/100 + 99/200 = 317/200 for m = 1 and three times each for m = 3.",
        control: "The momentum m|v_ℓ| = 0.99 as the part that is cancelled, which forgets gravity's m g h = 0.1 N·s.",
        sources: &["chapter §12, splitting of the impulse"],
        check: impulse_split,
    },
    Claim {
        id: "S12.qplus",
        statement: "The new position is q⁺ = 0.005 + 0.01 · 0.495 = 0.005 + 0.00495 = 0.0099 m > 0.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: "q⁺ = 0.00995 m (199/20000); the summands are right, their sum was truncated.",
        argument: "1/200 + 99/20000 = 199/20000 = 0.00995. The conclusion drawn from it, that the ball has left the floor, stands.",
        control: "The printed 0.0099 m as the new position: it is not q + h v⁺.",
        sources: &["chapter §12, new position"],
        check: new_position,
    },
    Claim {
        id: "S12.unified",
        statement: "One and the same LCP cancels the incoming velocity and produces the rebound; lasting contact and impact are unified.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated.",
        argument: "0 ≤ W P + v_free + e v ⟂ P ≥ 0, solved by Lemke's method in rationals: the impact of the example gives \
                   P = 317/200; a ball lying on the floor (v = 0) gets P = m g h = 1/10 and stays; a ball leaving it with \
                   v = 1 gets P = 0.",
        control: "The LCP without e v in its argument: it cancels the incoming velocity but produces no rebound.",
        sources: &["chapter §12, central insight"],
        check: one_problem_for_all,
    },
];

fn contact_step(reading: Reading) -> Result<Vec<Finding>> {
    let right = MoreauJean { theta: 1.0, activation: Activation::FreeVelocityForecast, restitution: RestitutionRule::NormalOnly };
    let wrong = Altered { base: right, mistake: Mistake::FreeVelocity };
    let scheme: &dyn Scheme = reading.pick(&right, &wrong);
    let ball = PointMass::ball_on_floor(1.0, 10.0, 0.5);
    let (h, v) = (0.01, -0.99);
    let state = State { time: 0.0, position: dvector![0.005], velocity: dvector![v] };
    let step = schemes::step(scheme, &ProjectedGaussSeidel::default(), &ball, &state, h)?;
    let impulse = step.impulses.first().map_or(0.0, |contact| contact.impulse[0]);
    let rounding = ball_velocity(v.abs(), 10.0 * h);
    let exact = worked_step(&worked_ball(), &ratio(1, 1));
    Ok(vec![
        Finding::equal("P of the scheme", impulse, 1.585, rounding, "N·s"),
        Finding::equal("v⁺ of the scheme", step.state.velocity[0], 0.495, rounding, "m/s"),
        Finding::exact("v_free", &exact.free_velocity, &ratio(-109, 100), "m/s"),
        Finding::exact("forecast", &exact.forecast, &ratio(-59, 10000), "m"),
        Finding::exact("P", &exact.impulse, &ratio(317, 200), "N·s"),
        Finding::exact("v⁺", &exact.motion.velocity, &ratio(99, 200), "m/s"),
    ])
}

fn impact_law(reading: Reading) -> Result<Vec<Finding>> {
    let outcome = worked_step(&worked_ball(), &ratio(1, 1));
    let incoming = reading.pick(before_contact().velocity, outcome.free_velocity);
    let residual = outcome.motion.velocity + ratio(1, 2) * incoming;
    Ok(vec![Finding::exact("v⁺ + e v⁻", &residual, &ratio(0, 1), "m/s")])
}

fn impulse_split(reading: Reading) -> Result<Vec<Finding>> {
    let split = |mass: i64| {
        let ball = Ball { mass: ratio(mass, 1), ..worked_ball() };
        let outcome = worked_step(&ball, &ratio(1, 1));
        let cancelled = reading.pick(-outcome.free_velocity, -before_contact().velocity);
        let parts = ball.mass * (cancelled + outcome.motion.velocity);
        Finding::exact(format!("P = m|v_free| + m v⁺, m = {mass}"), &parts, &outcome.impulse, "N·s")
    };
    Ok(vec![split(1), split(3)])
}

fn new_position(reading: Reading) -> Result<Vec<Finding>> {
    let outcome = worked_step(&worked_ball(), &ratio(1, 1));
    let position = reading.pick(outcome.motion.position, ratio(99, 10000));
    let mean_velocity = (position.clone() - ratio(1, 200)) / ratio(1, 100);
    Ok(vec![
        Finding::exact("q⁺", &position, &ratio(199, 20000), "m"),
        Finding::exact("(q⁺ − q)/h − v⁺", &(mean_velocity - outcome.motion.velocity), &ratio(0, 1), "m/s"),
        Finding::decision("the ball has left the floor", position > ratio(0, 1), true),
    ])
}

/// The impulse of 0 ≤ W P + v_free + e v ⟂ P ≥ 0 with W = 1, g h = 1/10, by Lemke's method.
fn impulse(velocity: Rational, restitution: &Rational) -> Result<Rational> {
    let vector = velocity.clone() - ratio(1, 10) + restitution.clone() * velocity;
    let lcp = Lcp::new(DMatrix::from_element(1, 1, ratio(1, 1)), DVector::from_element(1, vector));
    Ok(solution(&lcp)?[0].clone())
}

fn one_problem_for_all(reading: Reading) -> Result<Vec<Finding>> {
    let restitution = reading.pick(ratio(1, 2), ratio(0, 1));
    let at_floor = |velocity: Rational| BallState { position: ratio(0, 1), velocity };
    let exact = |now: BallState<Rational>| {
        let ball = Ball { restitution: restitution.clone(), ..worked_ball() };
        ball.moreau_jean(&now, &ratio(1, 1), Activation::FreeVelocityForecast, &ratio(1, 100)).impulse
    };
    let mut findings = Vec::new();
    for (name, velocity, expected) in
        [("impact", ratio(-99, 100), ratio(317, 200)), ("rest", ratio(0, 1), ratio(1, 10)), ("separation", ratio(1, 1), ratio(0, 1))]
    {
        findings.push(Finding::exact(format!("P, {name}, Lemke"), &impulse(velocity.clone(), &restitution)?, &expected, "N·s"));
        findings.push(Finding::exact(format!("P, {name}, step"), &exact(at_floor(velocity)), &expected, "N·s"));
    }
    Ok(findings)
}
