//! Constraints on positions and on velocities: activation, drift, penetration.

use super::half_space::{Plane, TangentCone, grid};
use super::soft_contact::{End, impact, runge_kutta};
use crate::claims::prelude::*;
use crate::closed_forms::bouncing_ball::BouncingBall;
use crate::exact_particle::{Ball, BallState};
use crate::mechanics::{BeadInCircle, Mechanism, PointMass, State};
use crate::schemes::mujoco::Softness;
use crate::schemes::{Activation, MoreauJean, Mujoco, Scheme, StewartTrinkle, simulate};
use crate::solvers::Auto;
use crate::tolerance::claims::{SOFT_STEP, soft_restitution};
use crate::tolerance::rounding;

/// Claims on the two levels.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S2.NTC-robust",
        statement: r"$N_C(q)$ of the position level switches abruptly at $\varphi = 0$ and is hard to discretise. Replacing it by the
            velocity-level $N_{T_C(q)}(v^+)$ makes time-stepping naturally robust to changes of activation: one need not know exactly when
            $\varphi$ reaches zero, only impose the velocity constraint at the contacts with $\varphi \le 0$ (or about to be, after
            linearisation).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: no event time is needed, and the result depends on the activation rule by $O(h)$ only. The switch
            itself remains: at $v^+ = 0$ the cone $N_{T_C(q)}(v^+)$ jumps from $\{0\}$ to a half-line at $\varphi = 0$ just as $N_C$
            does.",
        argument: r"A plastic ball dropped from 1/10 m with $h = 1/64$ s comes to rest under the rules A ($\varphi \le 0$), B (half a step
            ahead) and D (free forecast) within $h\cdot|v|$ of the floor, without any event detected; under A it rests below the floor and
            under D on or above it. $\nabla\varphi\cdot v^+ > 0$: of all $g$ on a grid only 0 is in the cone, at $\varphi > 0$ and at
            $\varphi = 0$. $\nabla\varphi\cdot v^+ = 0$: at $\varphi = 0$ the half-line $-\lambda\nabla\varphi$ joins it.",
        controls: &[r"The constraint imposed only where $\varphi = 0$ exactly, which no step meets."],
        sources: &["chapter §2, from N_C to N_{T_C}"],
        check: check!(activation),
    },
    Claim {
        id: "S2.pos-vel-equiv",
        statement: r"Position and velocity level are equivalent in persistent contact ($\varphi \equiv 0$); they differ when contact is
            about to be made.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated, in continuous time; for a linear gap it holds step by step.",
        argument: r"$\varphi \equiv 0$ on an interval gives $\dot\varphi = 0$; conversely $\nabla\varphi\cdot v^+ \ge 0$ with
            complementarity from $\varphi = 0$ keeps $\varphi \ge 0$. For linear $\varphi = 0$ Stewart–Trinkle's condition
            $\varphi/h + u_n \ge 0$ is Moreau–Jean's $u_n \ge 0$: twenty steps of a block on an incline, sliding ($\mu = 0.3$) and
            sticking ($\mu = 0.8$), agree to rounding and leave $\varphi = 0$.",
        controls: &["The same block started 1/64 m above the incline, about to make contact."],
        sources: &["chapter §2, table of levels", "chapter §4"],
        check: check!(equivalence),
    },
    Claim {
        id: "S2.pos-strict",
        statement: r"Table: the position level guarantees strict non-penetration, at the price of expanding a nonlinear gap (§4:
            approximately after linearisation; §9: a residual of $O(h^2)$).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated: exact for linear $\varphi$. With $\varphi$ linearised in each step there remains
            $-\tfrac12h^2\,v\cdot\nabla^2\varphi\,v$, which does not accumulate.",
        argument: r"A bead of unit speed on the inside of a unit circle: the linearised condition puts $q^+$ on the tangent line,
            $|q^+|^2 = 1 + h^2w^2$ with the tangential speed $w \le 1$, whatever the gap before. So $\varphi = 1 - \sqrt{1 + h^2}$ after
            the first step and never below $-h^2/2$: $-\text{5.0e-5}$ and $-\text{5.0e-7}$ m for $h = \text{1e-2}$ and 1e-3 s over two
            seconds. A block that lands on a plane from 1/64 m at 1 m/s is never below it.",
        controls: &[r"The velocity level (Moreau–Jean, activation $\varphi \le 0$)."],
        sources: &["chapter §2, table of levels; §4, comparison of the two schemes; §9, what goes wrong"],
        check: check!(position_level),
    },
    Claim {
        id: "S2.vel-drift",
        statement: "The velocity level makes velocities admissible, but positions may drift.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated: positions drift on curved constraints, to a depth like $h\,v^2\,T/(2R)$. For linear $\varphi$ in
            persistent contact they do not.",
        argument: r"The bead on the unit circle moves along the tangent, so $|q^+|^2 = |q|^2 + h^2w^2$, and $|q|\,w$ is conserved:
            $|q|^2 \le 1 + hT$. The depth after $T$ lies in $[hT/((1 + hT)(1 + \sqrt{1 + hT})), \sqrt{1 + hT} - 1]$; it is 9.85e-3 and
            9.99e-4 m for $h = \text{1e-2}$ and 1e-3 s at $T = 2$ s, and in every step $\nabla\varphi\cdot v^+ \ge 0$ at the gradient of
            its start. A block sliding on a plane keeps $\varphi = 0$ exactly: they may drift, as the chapter says, and need not.",
        controls: &["The position level (Stewart–Trinkle).", "MuJoCo's contact with a time constant of 0.2 s, which brakes by and by."],
        sources: &["chapter §2, table of levels", "chapter §3, pitfall on drift"],
        check: check!(velocity_level),
    },
    Claim {
        id: "S2.penetration-zero",
        statement: "In the sweeping process penetration is strictly zero (or corrected as drift), in the penalty method it is intended.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"The continuous motion satisfies $\varphi \ge 0$ at all times by definition; discrete ones need the drift
            corrected.",
        argument: r"$q(t) \in C$ is part of the problem. The exact bouncing ball ($e = 1/2$) is not below the floor at any of 4000
            instants up to twice its last impact; its discretisation with the activation $\varphi \le 0$ is, by up to $h|v|$. A unit mass
            that lands at 1 m/s on an undamped spring $k$ goes $1/\sqrt{k}$ below the floor: there the penetration is the force.",
        controls: &[r"The discrete motion of Moreau–Jean, activation $\varphi \le 0$, without correction, and a critically damped spring."],
        sources: &["chapter §2, sweeping process and penalty compared"],
        check: check!(penetration),
    },
];

/// One step of the ball under a rule.
type BallRule = fn(&Ball<Rational>, &BallState<Rational>, Activation, &Rational) -> BallState<Rational>;

fn moreau_jean(ball: &Ball<Rational>, now: &BallState<Rational>, rule: Activation, h: &Rational) -> BallState<Rational> {
    ball.moreau_jean(now, &ratio(1, 1), rule, h).motion
}

/// The floor is seen at φ = 0 exactly, and the ball falls freely elsewhere.
fn only_at_zero(ball: &Ball<Rational>, now: &BallState<Rational>, rule: Activation, h: &Rational) -> BallState<Rational> {
    if now.position == ratio(0, 1) {
        return moreau_jean(ball, now, rule, h);
    }
    let velocity = &now.velocity - &ball.gravity * h;
    BallState { position: &now.position + &velocity * h, velocity }
}

/// The rest of a plastic ball after 128 steps of 1/64 s from 1/10 m, and its largest speed.
fn rest(step: BallRule, rule: Activation) -> (BallState<Rational>, Rational) {
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(10, 1), restitution: ratio(0, 1) };
    let mut motion = BallState { position: ratio(1, 10), velocity: ratio(0, 1) };
    let mut fastest = ratio(0, 1);
    for _ in 0..128 {
        motion = step(&ball, &motion, rule, &ratio(1, 64));
        fastest = fastest.max(-motion.velocity.clone());
    }
    (motion, fastest)
}

fn activation(reading: Reading) -> Result<Vec<Finding>> {
    let members = |after: &Plane, active: bool| {
        let cone = TangentCone::new([0, 1], active);
        grid(2).into_iter().filter(|g| cone.normal_cone_contains(after, g)).collect::<Vec<_>>()
    };
    let switches = |after: &Plane| members(after, true) != members(after, false);
    let (along, leaving) = ([ratio(1, 1), ratio(0, 1)], [ratio(1, 1), ratio(1, 1)]);
    let step: BallRule = reading.pick(moreau_jean, only_at_zero);
    let mut findings = Vec::new();
    for rule in Activation::ALL {
        let (motion, fastest) = rest(step, rule);
        let slack = motion.position.magnitude();
        findings.push(Finding::decision(format!("within h|v| of the floor, rule {}", rule.name()), slack <= fastest * ratio(1, 64), true));
        findings.push(Finding::exact(format!("velocity in the end, rule {}", rule.name()), &motion.velocity, &ratio(0, 1), "m/s"));
    }
    let switch_along = switches(&along) && !switches(&leaving);
    findings.push(Finding::decision("the cone switches at φ = 0 along the contact, not for v⁺ that leaves", switch_along, true).context());
    Ok(findings)
}

const VELOCITY_LEVEL: MoreauJean =
    MoreauJean { theta: 1.0, activation: Activation::Gap, restitution: crate::schemes::RestitutionRule::NormalOnly };
const POSITION_LEVEL: StewartTrinkle = StewartTrinkle { directions: 8 };

fn equivalence(reading: Reading) -> Result<Vec<Finding>> {
    const STEPS: usize = 20;
    let mut findings = Vec::new();
    for friction in [0.3, 0.8] {
        let block = PointMass::block_on_incline(1.0, 10.0, 0.5, friction, 0.0);
        let initial =
            State { time: 0.0, position: dvector![0.0, reading.pick(0.0, 1.0 / 64.0)], velocity: dvector![1.0, reading.pick(0.0, -1.0)] };
        let run = |scheme: &dyn Scheme| simulate(scheme, &Auto, &block, initial.clone(), 1.0 / 32.0, STEPS);
        let (position_level, velocity_level) = (run(&POSITION_LEVEL)?, run(&VELOCITY_LEVEL)?);
        let pairs = || position_level.samples.iter().zip(&velocity_level.samples);
        let size = pairs().map(|(state, _)| state.position.amax() + state.velocity.amax()).fold(1.0, f64::max);
        let apart = |difference: fn(&State, &State) -> f64| pairs().map(|(a, b)| difference(a, b)).fold(0.0, f64::max);
        let bound = rounding(32 * STEPS, size);
        let velocity = apart(|a, b| (&a.velocity - &b.velocity).amax());
        let position = apart(|a, b| (&a.position - &b.position).amax());
        findings.push(Finding::at_most(format!("velocities of the two levels differ, μ = {friction}"), velocity, bound, "m/s"));
        findings.push(Finding::at_most(format!("positions of the two levels differ, μ = {friction}"), position, bound, "m"));
    }
    Ok(findings)
}

const DURATION: f64 = 2.0;

/// A unit-speed bead on the inside of the unit circle over two seconds.
fn bead(scheme: &dyn Scheme, h: f64) -> Result<(BeadInCircle, Vec<State>)> {
    let bead = BeadInCircle::new(1.0, 1.0, 0.0, 0.0, 0.0)?;
    let initial = State { time: 0.0, position: dvector![0.0, -1.0], velocity: dvector![1.0, 0.0] };
    let recording = simulate(scheme, &Auto, &bead, initial, h, (DURATION / h).round() as usize)?;
    Ok((bead, recording.samples))
}

/// Gaps of a block that slides down a plane after each of 32 steps, from a height above it and with a speed towards it.
fn gaps_on_a_plane(scheme: &dyn Scheme, height: f64, approach: f64) -> Result<Vec<f64>> {
    let block = PointMass::block_on_incline(1.0, 10.0, 0.5, 0.3, 0.0);
    let initial = State { time: 0.0, position: dvector![0.0, height], velocity: dvector![1.0, -approach] };
    let recording = simulate(scheme, &Auto, &block, initial, 1.0 / 32.0, 32)?;
    Ok(depths(&block, &recording.samples).into_iter().map(|depth| -depth).collect())
}

/// Depths −φ after each step.
fn depths(mechanism: &dyn Mechanism, samples: &[State]) -> Vec<f64> {
    samples.iter().skip(1).map(|state| -mechanism.contacts(&state.position)[0].gap).collect()
}

/// Smallest ∇φ·v⁺ of all steps, with the gradient at the start of the step.
fn slowest_separation(mechanism: &dyn Mechanism, samples: &[State]) -> f64 {
    let rate = |pair: &[State]| (&mechanism.contacts(&pair[0].position)[0].jacobian * &pair[1].velocity)[0];
    samples.windows(2).map(rate).fold(f64::INFINITY, f64::min)
}

fn position_level(reading: Reading) -> Result<Vec<Finding>> {
    let scheme: &dyn Scheme = reading.pick(&POSITION_LEVEL, &VELOCITY_LEVEL);
    let bound = rounding(64, 1.0);
    let lowest = gaps_on_a_plane(scheme, 1.0 / 64.0, 1.0)?.into_iter().fold(f64::INFINITY, f64::min);
    let mut findings = vec![Finding::at_least("lowest gap of a block that lands on a plane", lowest, -bound, "m")];
    for h in [1.0 / 100.0, 1.0 / 1000.0] {
        let (bead, samples) = bead(scheme, h)?;
        let depths = depths(&bead, &samples);
        let deepest = depths.iter().copied().fold(0.0, f64::max);
        findings.push(Finding::at_most_within(format!("deepest point in 2 s, h = {h}"), deepest, 0.5 * h * h, bound, "m"));
        let first = Finding::equal(format!("depth after one step, h = {h}"), depths[0], h.hypot(1.0) - 1.0, bound, "m");
        findings.push(first.context());
    }
    Ok(findings)
}

fn velocity_level(reading: Reading) -> Result<Vec<Finding>> {
    let softness = Softness { reference: [0.2, 1.0], ..Softness::STANDARD };
    let soft = Mujoco { softness, ..Mujoco::default() };
    let hard: &dyn Scheme = reading.only(0).pick(&VELOCITY_LEVEL, &POSITION_LEVEL);
    let scheme = reading.only(1).pick(hard, &soft);
    let mut findings = Vec::new();
    for h in [1.0 / 100.0, 1.0 / 1000.0] {
        let (bead, samples) = bead(scheme, h)?;
        let depths = depths(&bead, &samples);
        let last = depths[depths.len() - 1];
        let (square, roundoff) = (1.0 + h * DURATION, rounding(16 * depths.len(), 1.0));
        let least = h * DURATION / (square * (1.0 + square.sqrt()));
        let recursion = depths.iter().fold(1.0f64, |radius_squared, _| radius_squared + h * h / radius_squared);
        findings.push(Finding::at_least(format!("depth after 2 s, h = {h}"), last, least - roundoff, "m"));
        findings.push(Finding::equal(format!("depth by |q⁺|² = |q|² + h²/|q|², h = {h}"), last, recursion.sqrt() - 1.0, roundoff, "m"));
        let slowest = slowest_separation(&bead, &samples);
        findings.push(Finding::at_least(format!("smallest ∇φ·v⁺ of a step, h = {h}"), slowest, -rounding(64, 1.0), "m/s"));
    }
    let largest = gaps_on_a_plane(scheme, 0.0, 0.0)?.into_iter().map(f64::abs).fold(0.0, f64::max);
    findings.push(Finding::at_most("largest |φ| of a block on a plane", largest, rounding(32, 1.0), "m").context());
    Ok(findings)
}

fn penetration(reading: Reading) -> Result<Vec<Finding>> {
    const SAMPLES: usize = 4000;
    let (gravity, height, restitution) = (10.0, 1.0, 0.5);
    let exact = BouncingBall::new(gravity, height, restitution)?;
    let step = 2.0 * exact.accumulation_time() / SAMPLES as f64;
    let lowest = match reading {
        Reading::Recorded => (0..=SAMPLES).map(|k| exact.state(k as f64 * step).0).fold(f64::INFINITY, f64::min),
        Reading::Control(_) => {
            let ball = Ball { mass: 1.0, gravity, restitution };
            let mut motion = BallState { position: height, velocity: 0.0 };
            (0..SAMPLES).fold(height, |lowest, _| {
                motion = ball.moreau_jean(&motion, &1.0, Activation::Gap, &step).motion;
                lowest.min(motion.position)
            })
        }
    };
    let (_, depth) = impact(runge_kutta, 1e4, reading.pick(0.0, 2.0 * 1e4f64.sqrt()), End::Force);
    // the depth is a maximum of 1/√k over steps of SOFT_STEP, so it is missed by a cosine of half a step
    let least = (0.5 * SOFT_STEP).cos() - soft_restitution();
    Ok(vec![
        Finding::at_least("lowest position", lowest, -rounding(32, height), "m"),
        Finding::at_least("depth × √k of a landing on a spring", depth * 1e4f64.sqrt(), least, "m/s"),
    ])
}
