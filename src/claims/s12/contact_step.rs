//! §12, the contact step from q = 0.005 m, v = −0.99 m/s.

use super::motion::before_contact;
use crate::checks::energy::{worked_ball, worked_step};
use crate::claims::prelude::*;
use crate::defects::zeno::{Altered, Mistake};
use crate::exact_particle::{Ball, BallState};
use crate::mechanics::{PointMass, State};
use crate::problem::Lcp;
use crate::schemes::{self, Activation, MoreauJean, RestitutionRule, Scheme};
use crate::solvers::ProjectedGaussSeidel;
use crate::solvers::lemke::solution;
use crate::tolerance::schemes::ball_velocity;

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S12.step",
        statement: r"From $q = 0.005$, $v = -0.99$ with $h = 0.01$: $v_\text{free} = -1.09$, forecast $-0.0059 < 0$, $U = P - 1.585$,
            hence $P = 1.585$ N·s and $v^+ = 0.495$ m/s.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated.",
        argument: r"$v_\text{free} = -99/100 - 1/10 = -109/100$; forecast $1/200 + v_\text{free}/100 = -59/10000$;
            $U = v_\text{free} + P + \tfrac12v = P - 317/200$; $P = 317/200$, $v^+ = 99/200$. The f64 scheme with its solver gives the
            same within its rounding.",
        controls: &[
            r"The same step with $e$ times $v_\text{free}$ instead of $e$ times $v$ in the argument: $P = 1.635$ N·s.",
            "The step from −0.9 m/s, which free fall has there (S12.state).",
        ],
        sources: &["chapter §12, contact step"],
        check: check!(contact_step),
    },
    Claim {
        id: "S12.vplus",
        statement: r"The step satisfies the impact law: $v^+ = -e\,v^- = -0.5 \cdot (-0.99) = 0.495$ m/s.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, with $v^-$ the velocity $v_\ell$ at the start of the step (not $v_\text{free}$, the velocity just
            before the discrete impact).",
        argument: r"$v^+ + e\,v_\ell = 99/200 - 99/200 = 0$; with $v_\text{free}$ in place of $v_\ell$ it is −1/20.",
        controls: &["A ball that falls with the same velocity 0.05 m above the floor: the contact takes no part in the step."],
        sources: &["chapter §12, check of the impact law"],
        check: check!(impact_law),
    },
    Claim {
        id: "S12.impulse-split",
        statement: r"The impulse splits as $P = 1.585 = 1.09 + 0.495$: first it cancels $m|v_\text{free}|$, then it produces $m\,v^+$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated; it holds for every mass, $P = m|v_\text{free}| + m\,v^+$. Against $m|v_\ell| = 0.99$ N·s the first
            part holds gravity’s $m\,g\,h = 0.1$ N·s as well.",
        argument: r"The LCP of the same step with $e = 0$ just stops the ball: its impulse is 109/100, and what the step with
            $e = \tfrac12$ adds to it is $99/200 = m\,v^+$, three times each for $m = 3$. Both LCPs are solved by Lemke’s method, $v^+$ is
            that of the scheme.",
        controls: &[
            "The ball without gravity: 0.99 N·s stop it.",
            r"$m|v_\ell|$ in the place of $m|v_\text{free}|$ as the part that stops the ball.",
        ],
        sources: &["chapter §12, splitting of the impulse"],
        check: check!(impulse_split),
    },
    Claim {
        id: "S12.qplus",
        statement: r"The new position is $q^+ = 0.005 + 0.01 \cdot 0.495 = 0.005 + 0.00495 = 0.0099\,\mathrm{m} > 0$.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::Misprint),
        evidence: Evidence::Exact,
        correct_statement: r"$q^+ = 0.00995$ m (199/20000); the summands are right, their sum was truncated.",
        argument: r"$1/200 + 99/20000 = 199/20000 = 0.00995$. The conclusion drawn from it, that the ball has left the floor, stands.",
        controls: &[
            r"The step from $v = -0.98$ m/s, whose new position is 0.0099 m.",
            "The step from 0.01 m below the floor, which it does not leave.",
        ],
        sources: &["chapter §12, new position"],
        check: check!(new_position),
    },
    Claim {
        id: "S12.unified",
        statement: "One and the same LCP cancels the incoming velocity and produces the rebound; lasting contact and impact are unified.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated.",
        argument: r"$0 \le W\,P + v_\text{free} + e\,v \perp P \ge 0$, solved by Lemke's method in rationals: the impact of the example
            gives $P = 317/200$; a ball lying on the floor ($v = 0$) gets $P = m\,g\,h = 1/10$ and stays; a ball leaving it with $v = 1$
            gets $P = 0$.",
        controls: &[
            r"The LCP without $e\,v$ in its argument: it cancels the incoming velocity but produces no rebound.",
            "The ball without gravity.",
            r"An equation in the place of the complementarity, $W\,P + v_\text{free} + e\,v = 0$: the contact holds the ball that
                leaves.",
        ],
        sources: &["chapter §12, central insight"],
        check: check!(one_problem_for_all),
    },
];

fn contact_step(reading: Reading) -> Result<Vec<Finding>> {
    let right = MoreauJean { theta: 1.0, activation: Activation::FreeVelocityForecast, restitution: RestitutionRule::NormalOnly };
    let wrong = Altered { base: right, mistake: Mistake::FreeVelocity };
    let scheme: &dyn Scheme = reading.only(0).pick(&right, &wrong);
    let ball = PointMass::ball_on_floor(1.0, 10.0, 0.5);
    let (h, v) = (0.01, -0.99);
    let state = State { time: 0.0, position: dvector![0.005], velocity: dvector![v] };
    let step = schemes::step(scheme, &ProjectedGaussSeidel::default(), &ball, &state, h)?;
    let impulse = step.impulses.first().map_or(0.0, |contact| contact.impulse[0]);
    let rounding = ball_velocity(v.abs(), 10.0 * h);
    let before = BallState { velocity: reading.only(1).pick(ratio(-99, 100), ratio(-9, 10)), ..before_contact() };
    let exact = worked_ball().moreau_jean(&before, &ratio(1, 1), Activation::FreeVelocityForecast, &ratio(1, 100));
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
    let height = reading.pick(ratio(1, 200), ratio(1, 20));
    let before = BallState { position: height, ..before_contact() };
    let outcome = worked_ball().moreau_jean(&before, &ratio(1, 1), Activation::FreeVelocityForecast, &ratio(1, 100));
    let residual = &outcome.motion.velocity + ratio(1, 2) * before.velocity;
    Ok(vec![
        Finding::exact("v⁺ + e v⁻", &residual, &ratio(0, 1), "m/s"),
        Finding::exact("v⁺ + e v_free", &(&outcome.motion.velocity + ratio(1, 2) * &outcome.free_velocity), &ratio(-1, 20), "m/s")
            .context(),
        Finding::exact("v⁺", &outcome.motion.velocity, &ratio(99, 200), "m/s"),
    ])
}

fn impulse_split(reading: Reading) -> Result<Vec<Finding>> {
    let gravity = reading.only(0).pick(ratio(10, 1), ratio(0, 1));
    let velocity = before_contact().velocity;
    let mut findings = Vec::new();
    for mass in [1, 3] {
        let ball = Ball { mass: ratio(mass, 1), gravity: gravity.clone(), ..worked_ball() };
        let stopped = Ball { gravity: reading.only(1).pick(gravity.clone(), ratio(0, 1)), ..ball.clone() };
        let (stopping, whole) = (impulse(&stopped, &velocity, &ratio(0, 1))?, impulse(&ball, &velocity, &ratio(1, 2))?);
        let outcome = worked_step(&ball, &ratio(1, 1));
        let rest = &whole - &stopping;
        findings.push(Finding::exact(format!("P, m = {mass}"), &whole, &ratio(317 * mass, 200), "N·s"));
        findings.push(Finding::exact(format!("impulse that just stops the ball, m = {mass}"), &stopping, &ratio(109 * mass, 100), "N·s"));
        let momentum = ball.mass * outcome.motion.velocity;
        findings.push(Finding::exact(format!("rest of P over m v⁺ of the scheme, m = {mass}"), &(rest / momentum), &ratio(1, 1), "1"));
    }
    Ok(findings)
}

fn new_position(reading: Reading) -> Result<Vec<Finding>> {
    let velocity = reading.only(0).pick(ratio(-99, 100), ratio(-98, 100));
    let before = BallState { velocity, position: reading.only(1).pick(ratio(1, 200), ratio(-1, 100)) };
    let outcome = worked_ball().moreau_jean(&before, &ratio(1, 1), Activation::FreeVelocityForecast, &ratio(1, 100));
    let position = outcome.motion.position;
    Ok(vec![
        Finding::exact("q⁺", &position, &ratio(199, 20000), "m").says(ratio(99, 10000)),
        Finding::decision("the ball has left the floor", position > ratio(0, 1), true),
    ])
}

/// 0 ≤ W P + v_free + e v ⟂ P ≥ 0 with W = 1/m and h = 1/100.
fn problem(ball: &Ball<Rational>, velocity: &Rational, restitution: &Rational) -> Lcp<Rational> {
    let vector = velocity - &ball.gravity * ratio(1, 100) + restitution * velocity;
    Lcp::new(DMatrix::from_element(1, 1, ratio(1, 1) / &ball.mass), DVector::from_element(1, vector))
}

/// The impulse of that problem by Lemke's method.
fn impulse(ball: &Ball<Rational>, velocity: &Rational, restitution: &Rational) -> Result<Rational> {
    Ok(solution(&problem(ball, velocity, restitution))?[0].clone())
}

/// The impulse of W P + v_free + e v = 0.
fn impulse_of_equation(ball: &Ball<Rational>, velocity: &Rational, restitution: &Rational) -> Result<Rational> {
    let Lcp { matrix, vector, .. } = problem(ball, velocity, restitution);
    Ok(-&vector[0] / &matrix[(0, 0)])
}

fn one_problem_for_all(reading: Reading) -> Result<Vec<Finding>> {
    let restitution = reading.only(0).pick(ratio(1, 2), ratio(0, 1));
    let ball = Ball { gravity: reading.only(1).pick(ratio(10, 1), ratio(0, 1)), ..worked_ball() };
    let solve = reading.only(2).pick(impulse as fn(&Ball<Rational>, &Rational, &Rational) -> Result<Rational>, impulse_of_equation);
    let (mut findings, mut apart) = (Vec::new(), ratio(0, 1));
    for (name, velocity, expected) in
        [("impact", ratio(-99, 100), ratio(317, 200)), ("rest", ratio(0, 1), ratio(1, 10)), ("separation", ratio(1, 1), ratio(0, 1))]
    {
        let solved = solve(&ball, &velocity, &restitution)?;
        let now = BallState { position: ratio(0, 1), velocity };
        let stepped = Ball { restitution: restitution.clone(), ..ball.clone() };
        let taken = stepped.moreau_jean(&now, &ratio(1, 1), Activation::FreeVelocityForecast, &ratio(1, 100)).impulse;
        apart = apart.max((&taken - &solved).magnitude());
        findings.push(Finding::exact(format!("P, {name}"), &solved, &expected, "N·s"));
    }
    findings.push(Finding::exact("largest difference between Lemke's P and that of the step", &apart, &ratio(0, 1), "N·s"));
    Ok(findings)
}
