//! Does a body sink into the table under a velocity-level scheme?

use crate::claims::prelude::*;
use crate::exact_particle::{Ball, BallState};
use crate::mechanics::{BeadInCircle, Mechanism, State};
use crate::schemes::{Activation, MoreauJean, RestitutionRule, Scheme, StewartTrinkle, simulate};
use crate::solvers::LemkePivoting;
use crate::tolerance::claims::theta_scheme::bead_sagitta;

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S3.drift",
    statement: r"The velocity constraint keeps the velocity from penetrating only; $\varphi$ may slowly become negative by discretisation
        errors (drift), and the body sinks gradually into the ground. Without projection, pure Moreau–Jean lets a body sink slowly into
        the table over long runs.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Certified,
    correct_statement: r"A body on a plane does not drift under the activation rules A, B or D (A: $\varphi \le 0$, B:
        $\varphi + \tfrac12hu \le 0$, D: $\varphi + h\,u_\text{free} \le 0$): only the offset of the landing remains. It sinks under rule
        C ($\varphi + h\,u \le 0$ and $u \le 0$) with $0 < e < 1$, at $g\,h\,(1 - e)/(2(1 + e))$; along curved constraints, at
        $h\,v^2\kappa/2$; and with unconverged solvers.",
    argument: r"Ball dropped from 1/10 m, $e = 1/2$, $h = 1/100$ s, 1000 steps: under A, B and D the height over the last 500 steps does
        not change by a bit, and a ball placed on the floor stays there exactly, in rationals; under rule C the dropped ball sinks at
        0.01635 m/s. A bead sliding on a circle of radius 1 m at 1 m/s, $h = 1/1024$ s: angular momentum $r\,v$ is conserved and $r^2$
        grows by $h^2v^2$ per step, so it leaves at $h\,v^2/(2R) = \text{4.9e-4}$ m/s.",
    controls: &["Activation rule C for the dropped ball in place of A, B and D.", "The position level (Stewart–Trinkle) for the bead."],
    sources: &["chapter §3, common pitfalls (drift)", "chapter §3, exercise 3 (block at rest for 1000 steps)"],
    check: check!(sinking),
}];

/// Mean velocity over the last 500 of 1000 steps of a ball dropped from 1/10 m with e = 1/2.
fn settled_velocity(step: impl Fn(&Ball<f64>, &BallState<f64>) -> BallState<f64>) -> f64 {
    let ball = Ball { mass: 1.0, gravity: 9.81, restitution: 0.5 };
    let mut now = BallState { position: 0.1, velocity: 0.0 };
    let mut halfway = 0.0;
    for count in 0..1000 {
        if count == 500 {
            halfway = now.position;
        }
        now = step(&ball, &now);
    }
    (now.position - halfway) / (500.0 * STEP)
}

const STEP: f64 = 0.01;
const VELOCITY_LEVEL: MoreauJean = MoreauJean { theta: 1.0, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };

/// Rule C: the contact takes part if q + h v ≤ 0 and v ≤ 0.
fn rule_c(ball: &Ball<f64>, now: &BallState<f64>) -> BallState<f64> {
    let free = now.velocity - ball.gravity * STEP;
    let active = now.position + STEP * now.velocity <= 0.0 && now.velocity <= 0.0;
    let velocity = if active { free.max(-ball.restitution * now.velocity) } else { free };
    BallState { position: now.position + STEP * 0.5 * (velocity + now.velocity), velocity }
}

fn sinking(reading: Reading) -> Result<Vec<Finding>> {
    let settled = |activation: Activation| match reading {
        Reading::Control(0) => settled_velocity(rule_c),
        Reading::Recorded | Reading::Control(_) => settled_velocity(|ball, now| ball.moreau_jean(now, &0.5, activation, &STEP).motion),
    };
    let position_level = StewartTrinkle::default();
    let scheme: &dyn Scheme = reading.only(1).pick(&VELOCITY_LEVEL, &position_level);
    let mut findings = vec![bead(scheme, 100)?];
    for activation in Activation::ALL {
        let sinks = settled(activation) < -f64::EPSILON;
        let found = Finding::decision(format!("sinks long after landing on a plane, rule {}", activation.name()), sinks, false);
        findings.push(found.says(true).violating("a curved constraint, rule C, or a solver stopped early"));
    }
    let predicted = -9.81 * STEP * 0.5 / (2.0 * 1.5);
    // over a finite window the sink differs from its mean by at most one cycle of two steps of free fall
    let cycle = 4.0 * 9.81 * STEP * STEP / (500.0 * STEP);
    findings.push(Finding::equal("velocity after landing, rule C", settled_velocity(rule_c), predicted, cycle, "m/s").context());
    let moved = Activation::ALL.into_iter().any(|activation| resting_drift(activation) != ratio(0, 1));
    findings.push(Finding::decision("a ball placed on the floor moves in 1000 steps under A, B or D", moved, false).context());
    Ok(findings)
}

fn resting_drift(activation: Activation) -> Rational {
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(981, 100), restitution: ratio(1, 2) };
    let mut now = BallState { position: ratio(0, 1), velocity: ratio(0, 1) };
    for _ in 0..1000 {
        now = ball.moreau_jean(&now, &ratio(1, 2), activation, &ratio(1, 100)).motion;
    }
    now.position.magnitude()
}

/// Mean velocity of the gap of a bead over `steps` steps along a circle, against −h v²/(2R).
fn bead(scheme: &dyn Scheme, steps: usize) -> Result<Finding> {
    let (radius, speed, h) = (1.0, 1.0, 1.0 / 1024.0);
    let circle = BeadInCircle::new(1.0, radius, 0.0, 0.0, 0.0)?;
    let start = State { time: 0.0, position: dvector![radius, 0.0], velocity: dvector![0.0, speed] };
    let recording = simulate(scheme, &LemkePivoting, &circle, start, h, steps)?;
    let gap = circle.contacts(&recording.last().position)[0].gap;
    let (growth, time) = (steps as f64 * h * h * speed * speed / (radius * radius), steps as f64 * h);
    let predicted = -0.5 * h * speed * speed / radius;
    Ok(Finding::equal("velocity of a bead out of a circle", gap / time, predicted, radius * bead_sagitta(growth) / time, "m/s"))
}
