//! Orders of the θ scheme: two and one where the motion is smooth, one through impacts.

use crate::claims::experiments::pendulum::Swing;
use crate::claims::experiments::theta_energy::energy_change_under;
use crate::claims::experiments::theta_step::{LinearSystem, phase};
use crate::claims::prelude::*;
use crate::closed_forms::bouncing_ball::BouncingBall;
use crate::mechanics::{OscillatorWithStop, PointMass, State};
use crate::schemes::{Activation, MoreauJean, RestitutionRule, simulate};
use crate::solvers::LemkePivoting;
use crate::tolerance::claims::theta_scheme::{METHOD_CONSTANTS, central_difference_of_step, sampled_peak};
use crate::trajectory::order::{OrderEstimate, Refinement, fit_order};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S3.theta-order",
        statement: r"As rules for ordinary differential equations, $\theta = 1/2$ is the second-order trapezoidal rule and $\theta = 1$ is
            backward Euler.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: r"As stated: orders 2 and 1 while the motion is smooth. Through an impact every $\theta$ has order 1 in the
            position (S3.table-2nd-order).",
        argument: r"$\ddot q = -q$ to $t = 2$: the one-step factor is $R = (1 + (1 - \theta)z)/(1 - \theta z) = 1 + z + \theta z^2 +$ …,
            $z = \pm ih$, so the order is 2 iff $\theta = 1/2$. The fitted slopes are those of $C\,h^p(1 + O(h))$ on these steps.",
        controls: &[
            r"The same oscillator with an elastic stop at $q = 0$, hit at $t = \pi/2$, for $\theta = 1/2$.",
            "The trapezoidal rule in place of backward Euler.",
        ],
        sources: &["chapter §3, history and step 2", "Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I"],
        check: check!(smooth_orders),
    },
    Claim {
        id: "S3.table-2nd-order",
        statement: r"Table, overall behaviour of $\theta = 1/2$: second order and energy neutral; for elastic collisions and long
            conservative motions.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Certified,
        correct_statement: r"$\theta = 1/2$ is energy neutral for constant and linear forces; its order is 2 on smooth pieces and 1
            through impacts, like that of every $\theta$.",
        argument: r"Elastic ball, activation $\varphi \le 0$, $\theta = 1/2$: a step that starts $\delta \in [0, h)$ after the true impact
            turns $v$ into $-v$ without moving, so the ball goes on exactly, but late by $h + 2\delta$. With $v^* = \sqrt{2\,g\,q_0}$ the
            position error is at least $v$*$h - (3/2)\,g\,h^2$ and at most $3\,v$*$h + g\,h^2$. For $g = 9.81$ m/s², $q_0 = 1$ m and 64,
            256 and 1024 steps the fitted order is one within the interval that these bounds leave, which two lies outside of. Gravity and
            springs: the energy is exactly neutral.",
        controls: &["The oscillator of S3.theta-order, without a stop.", r"$\theta = 1$ under gravity and springs."],
        sources: &["chapter §3, table of θ"],
        check: check!(order_through_an_impact),
    },
    Claim {
        id: "S3.symplectic-like",
        statement: r"$\theta = 1/2$ behaves like a symplectic integrator: no long-term drift of the energy.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated, for smooth motions: on linear systems the $\theta = 1/2$ step preserves area; on nonlinear ones it
            does not, but it is conjugate to the midpoint rule, which does, and so behaves like it.",
        argument: r"The step is $(I - hf/2)^{-1} \circ (I + hf/2)$, so its Jacobian determinant is
            ($1 + h^2V$''(q)/4)/($1 + h^2V$''($q^+$)/4) for $\ddot q = -V$'(q): exactly 1 for the oscillator, 1.00016 for the pendulum at
            $(1.3, 0.7)$, $h = 0.1$. Conjugating with half a step swaps the factors and gives the midpoint rule, of determinant 1.
            Pendulum, $h = 0.1$, 200 times 100 steps: the largest $|E - E_0|$ of the last 100 is that of the first 100, which take it to
            and fro.",
        controls: &[r"$\theta = 1$."],
        sources: &["chapter §3, essential insight on θ", "Hairer, Lubich, Wanner, Geometric Numerical Integration, VI.8"],
        check: check!(area),
    },
];

/// Errors at t = 2 of q̈ = −q from (1, 0), with an elastic stop at `stop`, for h = 2/N.
fn oscillator_order(theta: f64, stop: f64) -> Result<OrderEstimate> {
    let oscillator = OscillatorWithStop::new(1.0, 1.0, 0.0, stop, 1.0)?;
    let scheme = MoreauJean { theta, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
    let level = |steps: usize| -> Result<Refinement> {
        let (h, start) = (2.0 / steps as f64, State { time: 0.0, position: dvector![1.0], velocity: dvector![0.0] });
        let end = simulate(&scheme, &LemkePivoting, &oscillator, start, h, steps)?.last().clone();
        let sign = if stop < 0.0 { 1.0 } else { -1.0 };
        let error = (end.position[0] - sign * 2f64.cos()).hypot(end.velocity[0] + sign * 2f64.sin());
        Ok(Refinement { time_step: h, error })
    };
    fit_order([64, 128, 256, 512].map(level).into_iter().collect::<Result<Vec<_>>>()?)
}

fn smooth_orders(reading: Reading) -> Result<Vec<Finding>> {
    let half = oscillator_order(0.5, reading.only(0).pick(-10.0, 0.0))?;
    let one = oscillator_order(reading.only(1).pick(1.0, 0.5), -10.0)?;
    let width = half.slope_interval(METHOD_CONSTANTS);
    Ok(vec![
        Finding::equal("order of θ = 1/2", half.slope, 2.0, width, "1").experiment(),
        Finding::equal("order of θ = 1", one.slope, 1.0, width, "1").experiment(),
    ])
}

fn order_through_an_impact(reading: Reading) -> Result<Vec<Finding>> {
    let order = match reading.only(0) {
        Reading::Recorded => ball_order()?,
        Reading::Control(_) => oscillator_order(0.5, -10.0)?,
    };
    let neutral = energy_change_under(&reading.only(1).pick(ratio(1, 2), ratio(1, 1)));
    let (coarsest, speed) = (order.levels[0].time_step, (2.0 * GRAVITY * HEIGHT).sqrt());
    let (lower, upper) = (speed - 1.5 * GRAVITY * coarsest, 3.0 * speed + GRAVITY * coarsest);
    let width = order.slope_interval(upper / lower);
    Ok(vec![
        Finding::equal("order of the largest position error through an impact", order.slope, 1.0, width, "1").says(2.0),
        Finding::exact("energy change under gravity and springs", &neutral, &ratio(0, 1), "J"),
    ])
}

const GRAVITY: f64 = 9.81;
const HEIGHT: f64 = 1.0;

/// Largest position errors of an elastic ball under θ = 1/2 up to twice the time of its first impact.
fn ball_order() -> Result<OrderEstimate> {
    let reference = BouncingBall::new(GRAVITY, HEIGHT, 1.0)?;
    let until = 2.0 * reference.first_impact_time();
    let scheme = MoreauJean { theta: 0.5, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
    let ball = PointMass::ball_on_floor(1.0, GRAVITY, 1.0);
    let level = |steps: usize| -> Result<Refinement> {
        let h = until / steps as f64;
        let start = State { time: 0.0, position: dvector![HEIGHT], velocity: dvector![0.0] };
        let recording = simulate(&scheme, &LemkePivoting, &ball, start, h, steps)?;
        let errors = recording.samples.iter().map(|state| (state.position[0] - reference.state(state.time).0).abs());
        Ok(Refinement { time_step: h, error: errors.fold(0.0, f64::max) })
    };
    fit_order([64, 256, 1024].map(level).into_iter().collect::<Result<Vec<_>>>()?)
}

fn area(reading: Reading) -> Result<Vec<Finding>> {
    let (h, theta, exact) = (0.1, reading.pick(0.5, 1.0), reading.pick(ratio(1, 2), ratio(1, 1)));
    let swing = Swing { angle: 1.3, rate: 0.7 };
    let next = swing.step(h);
    let predicted = (1.0 + h * h * swing.angle.cos() / 4.0) / (1.0 + h * h * next.angle.cos() / 4.0);
    let bound = central_difference_of_step();
    // the midpoint rule is half an explicit step after half an implicit one
    let midpoint = |now: Swing| now.theta_step(theta * h, 1.0).theta_step((1.0 - theta) * h, 0.0);
    Ok(vec![
        Finding::at_most("largest |E − E₀| of the last swing over that of the first", energy_growth(theta, h), 1.0 + sampled_peak(h), "1"),
        Finding::exact("determinant of the oscillator's step", &oscillator_determinant(&exact), &ratio(1, 1), "1"),
        Finding::equal("determinant of the pendulum's conjugate step", determinant(swing, midpoint), 1.0, bound, "1"),
        Finding::equal("determinant of the pendulum's step", determinant(swing, |now| now.step(h)), predicted, bound, "1").context(),
    ])
}

/// Largest |E − E₀| of a pendulum from (1.3, 0.7) over the last 100 of 20 000 steps, over that of the first 100, more than a swing.
fn energy_growth(theta: f64, h: f64) -> f64 {
    let mut now = Swing { angle: 1.3, rate: 0.7 };
    let start = now.energy();
    let mut largest = || {
        (0..100).fold(0.0f64, |largest, _| {
            now = now.theta_step(h, theta);
            largest.max((now.energy() - start).abs())
        })
    };
    let swings: Vec<f64> = (0..200).map(|_| largest()).collect();
    swings[199] / swings[0]
}

/// det ∂(q⁺, v⁺)/∂(q, v) of a linear step without constant force: its images of the unit vectors.
fn oscillator_determinant(theta: &Rational) -> Rational {
    let oscillator = LinearSystem::scalar(ratio(2, 1), ratio(7, 1), ratio(0, 1));
    let image = |q: i64, v: i64| oscillator.step(&phase(ratio(q, 1), ratio(v, 1)), theta, &ratio(1, 10)).0;
    let (first, second) = (image(1, 0), image(0, 1));
    &first.position[0] * &second.velocity[0] - &second.position[0] * &first.velocity[0]
}

fn determinant(swing: Swing, step: impl Fn(Swing) -> Swing) -> f64 {
    let d = crate::tolerance::mechanics::DIFFERENCE_STEP;
    let difference = |angle: f64, rate: f64| {
        let plus = step(Swing { angle: swing.angle + angle, rate: swing.rate + rate });
        let minus = step(Swing { angle: swing.angle - angle, rate: swing.rate - rate });
        [(plus.angle - minus.angle) / (2.0 * d), (plus.rate - minus.rate) / (2.0 * d)]
    };
    let (along_angle, along_rate) = (difference(d, 0.0), difference(0.0, d));
    along_angle[0] * along_rate[1] - along_rate[0] * along_angle[1]
}
