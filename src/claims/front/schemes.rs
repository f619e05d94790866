//! Front matter and tables on schemes: misconceptions, the convergence theorem's entry, symbols, the Zeno question, the
//! comparison with engines.

use crate::checks::convergence::study;
use crate::checks::energy::{first_impact, worked_ball, worked_step};
use crate::checks::zeno::{DroppedBall, settle};
use crate::claims::experiments::corner::{self, floor_before_wall, quartered};
use crate::claims::prelude::*;
use crate::closed_forms::bouncing_ball::{BouncingBall, impact_time_ratio};
use crate::closed_forms::mujoco_normal::spring_damper_restitution;
use crate::contact::delassus::delassus;
use crate::defects::schemes::RESTITUTION_FORGOTTEN;
use crate::defects::zeno::{Altered, Mistake};
use crate::elimination::solve;
use crate::exact_particle::{Ball, BallState};
use crate::schemes::{Activation, MoreauJean, RestitutionRule, Scheme};
use crate::tolerance::convergence::{Bounds, Impacts};
use crate::tolerance::schemes::{self as tolerance, ball_velocity};

/// Claims of the preface and the project.
pub const PREFACE: &[Claim] = &[
    Claim {
        id: "P.zeno-quiz",
        statement: r"A ball bouncing with $e = 0.8$: infinitely many bounces in a finite total time (Zeno).",
        verdict: ClaimVerdict::True,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated; the total time is 9 times that of the first fall.",
        argument: r"$t_k/t_1 = 1 + 2(e + \ldots + e^{k - 1})$ increases strictly and stays below $(1 + e)/(1 - e) = 9$: $t_{60}$ and
            $t_{240}$ in rationals. ($e = 0$ has one impact, $e = 1$ an infinite total time.)",
        controls: &[r"$e = 1$, for which impact 60 comes at $119\,t_1$.", r"$e = 0$: one impact, no more."],
        sources: &["chapter, self-test question 5"],
        check: check!(zeno_question),
    },
    Claim {
        id: "P.compare",
        statement: "Comparison: run the same three scenes in MuJoCo or PyBullet and compare penetration, energy curves and gliding with \
            one's own implementation, to understand that another format gives another result (§10).",
        verdict: ClaimVerdict::True,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated. A good part of the difference is not of the schemes: a spring–damper contact that can only push
            has the restitution of its damping ratio, $e^{-2} = 0.135$ if critically damped, whatever $e$ the rigid model was given. It
            vanishes once the damping ratio is matched to $e$.",
        argument: r"$\ddot x = -2\zeta\dot x - x$ from $x = 0$, $\dot x = -1$ (time in $1/\omega$), released when the force
            $2\zeta\dot x + x$ changes sign. $\zeta = 1$: $x = -t\,e^{-t}$, $\ddot x = (2 - t)e^{-t}$, release at $t = 2$ with
            $\dot x = e^{-2}$, so a bounce keeps $e^{-4}$ of its energy; the rigid step with $e = 0.8$ keeps $e^2$. The damping ratio
            whose closed form is $e = 0.8$, found by bisection, does rebound with 0.8. The motion is integrated numerically and held
            against the closed forms. Engines themselves are not run here.",
        controls: &[
            "The contact with the matched damping ratio in the place of the critically damped one.",
            r"The damping ratio of a spring that may pull, $-\ln e/\sqrt{\pi^2 + \ln^2 e}$, as if it were the matched one.",
            "A plastic rigid ball.",
        ],
        sources: &["chapter, cumulative project, comparison experiment"],
        check: check!(damped_restitution),
    },
];

/// Claims of the table of misconceptions.
pub const MISCONCEPTIONS: &[Claim] = &[
    Claim {
        id: "M.simultaneous",
        statement: "Contact simulation is not a smooth ODE with collision detection patched on: contact and dynamics are solved \
                    simultaneously.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated of time-stepping: one $(v^+, P)$ satisfies the balance of momentum and the contact law together.",
        argument: r"The worked step of §12: $m(v^+ - v) + m\,g\,h - P = 0$ and $P\cdot(v^+ + e\,v) = 0$ with $P = 317/200$, $v^+$ and $P$
            those of the step. A patch satisfies one or the other: $v_\text{free}$ reversed the balance but not the law, $v$ reversed with
            the impulse of an impact the law but not the balance.",
        controls: &[
            r"The patch: integrate freely, then replace $v_\text{free}$ by $-e\,v_\text{free}$.",
            r"The other patch: reverse $v$ with the impulse $(1 + e)\,m\,|v|$ of an impact, which leaves out gravity's.",
        ],
        sources: &["chapter, table of misconceptions, row 1"],
        check: check!(simultaneous),
    },
    Claim {
        id: "M.zeno",
        statement: "Time-stepping is robust against Zeno: many micro-bounces are absorbed by one step.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"It never stalls and needs a bounded number of steps, but not one: after the last real bounce the velocity
            decays by the factor $e$ per step. One step suffices if $e = 0$.",
        argument: r"$v^+ = -e\,v$ in every step once $|v| \le g\,h/(1 + e)$ at an active contact, so $n$ steps leave $e^n$ of the speed
            and it takes 40 steps to divide it by $2^{40}$ if $e = \tfrac12$. The ball of §12 in rationals ($h = 1/100$) and in floats
            ($h = 10^{-2}$, $10^{-3}$) under $\varphi + \tfrac12hv \le 0$; the plastic ball has $v = 0$ after its impact.",
        controls: &[
            r"$e = 0$ and $e = \tfrac12$ exchanged: the ball with $e = 0$ stands still at once.",
            r"The rule $\varphi + hv \le 0$ with $v \le 0$, under which the ball is never absorbed.",
        ],
        sources: &["chapter §1, comparison table; chapter, cumulative project, scene (a)"],
        check: check!(micro_bounces),
    },
];

/// Claims of the tables of theorems and symbols.
pub const TABLES: &[Claim] = &[
    Claim {
        id: "T.moreau-convergence",
        statement: r"Moreau–Jean converges weakly for prox-regular constraints and $\theta \in [\tfrac12, 1]$: $q_h \to q$ uniformly,
            $v_h$ ⇀* $v$ (attributed to Moreau and Jean, CMAME 177, 1999).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"For one contact, or contacts that meet at right angles (in the metric of $M$). Otherwise a motion that
            reaches two of them at once may have several limits, since a step may see one before the other. The hypotheses on impact law,
            friction and activation rule are missing as well, and the attribution has not been verified here.",
        argument: r"Bouncing ball, $e = 0.8$, $\theta = \tfrac12$ and 1, activation $\varphi \le 0$, to the apex after the impact:
            $\sup|q_h - q|$ and $\int|v_h - v|$ are within the constants times $V\,h$ that follow from the shift of the impact. Corner:
            plastic unit mass with $v^- = (-1, -1)\,m/s$ into the wedge $y \ge 0$, $4x + 3y \ge 0$, $g = 10$ m/s²; both walls are reached
            at 1/10 s, $-v^-$ lies in the cone of the normals, so it stops. $\theta = 1$, activation $\varphi \le 0$: with $h = 2/(20N)$ s
            both walls close in one step and the error falls with $h$; with $h = 2/(20N + 5)$ s the floor closes first, the mass slides
            into the wall and climbs it, for every $N$.",
        controls: &[
            r"Walls at right angles, $x \ge 0$ in the place of $4x + 3y \ge 0$.",
            "Steps that close the floor first in the place of those that close both walls at once.",
            "The restitution left out of the scheme.",
        ],
        sources: &["chapter, table of theorems", "chapter §3"],
        check: check!(converges_on_the_ball),
    },
    Claim {
        id: "T.symbols",
        statement: r"The table of symbols gives $D = [d_1, \ldots, d_d]$ the tangential directions, $N = D^TM^{-1}D$ the Hessian of
            Anitescu's QP (equal to the Delassus operator), $N_K(x)$ the normal cone, $E$ the coupling vector, $e$ the restitution.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Definition,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"Consistent if $D$ is read as the tangential directions in §4 and as the generators of all contact directions,
            normals included, in §5, $N$ as a matrix there but as a cone in §2, and $E$ as a vector in §4 but as an energy in §3: with the
            $D$ of the table, $D^TM^{-1}D$ is not the Delassus operator. (§5 itself says that its $D$ stacks normals and tangents.)",
        argument: r"Planar contact of a mass of 2 kg: the $D$ of §4 is $[t, -t]$, so
            $D^TM^{-1}D = \tfrac12\,\begin{bmatrix}1 & -1 \\ -1 & 1\end{bmatrix}$ is singular; the velocities that unit impulses along $n$
            and $t$ give, the Delassus operator, are half the identity. With $D = [n, t]$ both agree.",
        controls: &[r"$D$ read as $[n, t]$ in both places, for which the two matrices agree.", r"$D$ read as $[t, -t]$ in both places."],
        sources: &["chapter, table of symbols; chapter §4 and §5"],
        check: check!(two_meanings_of_d),
    },
];

fn zeno_question(reading: Reading) -> Result<Vec<Finding>> {
    let e = match reading {
        Reading::Control(0) => ratio(1, 1),
        Reading::Control(_) => ratio(0, 1),
        Reading::Recorded => ratio(4, 5),
    };
    let times = [60, 61, 240].map(|impact| impact_time_ratio(&e, impact));
    let mut findings = vec![Finding::decision("impact 240 comes before 9 t₁", times[2] < ratio(9, 1), true)];
    findings.push(Finding::decision("impact 61 comes after impact 60", times[0] < times[1], true));
    let remaining = ratio(9, 1) - times[0].clone();
    let expected = (0..60).fold(ratio(10, 1), |product, _| product * ratio(4, 5));
    findings.push(Finding::exact("(T∞ − t_60)/(10 (4/5)^60) in t₁", &(remaining / expected), &ratio(1, 1), "1"));
    Ok(findings)
}

/// Runge–Kutta steps of (x, ẋ)˙ = (ẋ, −2ζẋ − x) from (0, −1) until the force on the body changes sign; ẋ then.
fn released_speed(damping_ratio: f64, h: f64) -> f64 {
    let slope = |[x, v]: [f64; 2]| [v, -2.0 * damping_ratio * v - x];
    let ahead = |[x, v]: [f64; 2], [dx, dv]: [f64; 2], h: f64| [x + h * dx, v + h * dv];
    let mut state = [0.0, -1.0];
    let mut steps = 0;
    // A force that pushes acts in +x; every such oscillator releases within half a period, π/√(1−ζ²), or 2 if ζ = 1.
    while (slope(state)[1] > 0.0 || steps == 0) && f64::from(steps) * h < 4.0 {
        let first = slope(state);
        let second = slope(ahead(state, first, h / 2.0));
        let third = slope(ahead(state, second, h / 2.0));
        let fourth = slope(ahead(state, third, h));
        let mean = [0, 1].map(|k| (first[k] + 2.0 * second[k] + 2.0 * third[k] + fourth[k]) / 6.0);
        state = ahead(state, mean, h);
        steps += 1;
    }
    state[1]
}

/// The damping ratio of the contact with this restitution: the closed form falls with ζ.
fn damping_of(restitution: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if spring_damper_restitution(middle) > restitution { low = middle } else { high = middle }
    }
    low
}

fn damped_restitution(reading: Reading) -> Result<Vec<Finding>> {
    let h = 1.0 / 1024.0;
    let (rigid, matched) = (0.8f64, damping_of(0.8));
    let pulling = -rigid.ln() / std::f64::consts::PI.hypot(rigid.ln());
    let soft = released_speed(reading.only(0).pick(1.0, matched), h);
    let fitted = released_speed(reading.only(1).pick(matched, pulling), h);
    let predicted = (-2f64).exp();
    let tolerance = tolerance::released_speed(h);
    let ball = DroppedBall { mass: 1.0, gravity: 9.81, height: 1.0, restitution: reading.only(2).pick(rigid, 0.0) };
    let [before, after] = first_impact(&MoreauJean::default(), &ball, h)?.map(|state| state.velocity[0]);
    let kept = (after / before).powi(2);
    let rounded = 2.0 * ball_velocity(before.abs(), ball.gravity * h) / before.abs();
    Ok(vec![
        // |m² − p²| ≤ 2|m − p| for speeds of at most 1
        Finding::at_least("energy ratio of the rigid step less that of the soft contact", kept - soft * soft, 2.0 * tolerance, "1"),
        Finding::equal("energy ratio of the critically damped contact", soft * soft, predicted * predicted, 2.0 * tolerance, "1"),
        Finding::equal("energy ratio of the rigid step with e = 0.8", kept, rigid * rigid, rounded, "1"),
        Finding::equal("restitution of a contact matched to e = 0.8", fitted, rigid, tolerance, "1"),
    ])
}

fn simultaneous(reading: Reading) -> Result<Vec<Finding>> {
    let (ball, h, before) = (worked_ball(), ratio(1, 100), ratio(-99, 100));
    let solved = worked_step(&ball, &ratio(1, 1));
    let patched = -ball.restitution.clone() * &solved.free_velocity;
    let (velocity, impulse) = match reading {
        Reading::Recorded => (solved.motion.velocity.clone(), solved.impulse.clone()),
        Reading::Control(0) => (patched.clone(), &ball.mass * (patched - &solved.free_velocity)),
        Reading::Control(_) => (-&ball.restitution * &before, -(ratio(1, 1) + &ball.restitution) * &ball.mass * &before),
    };
    let law_velocity = velocity.clone() + ball.restitution.clone() * &before;
    let momentum: Rational = ball.mass.clone() * (velocity - before + ball.gravity.clone() * h) - &impulse;
    Ok(vec![
        Finding::exact("P·(v⁺ + e v)", &(impulse.clone() * &law_velocity), &ratio(0, 1), "J"),
        Finding::exact("m(v⁺ − v) + m g h − P", &momentum, &ratio(0, 1), "N·s"),
        Finding::exact("P", &impulse, &ratio(317, 200), "N·s"),
    ])
}

/// Speeds of the ball of §12 when it is absorbed and 20 steps later, in rationals, h = 1/100, φ + ½hv ≤ 0.
fn speeds_after_absorption(restitution: Rational) -> [Rational; 2] {
    let ball = Ball { restitution: restitution.clone(), ..worked_ball() };
    let h = ratio(1, 100);
    let slow = ball.gravity.clone() * &h / (ratio(1, 1) + restitution);
    let step = |now: &BallState<Rational>| ball.moreau_jean(now, &ratio(1, 1), Activation::HalfStepForecast, &h);
    let mut now = BallState { position: ratio(1, 20), velocity: ratio(0, 1) };
    let mut consecutive = 0;
    while consecutive < 2 {
        let outcome = step(&now);
        let absorbing = outcome.active && now.velocity.magnitude() <= slow;
        consecutive = if absorbing { consecutive + 1 } else { 0 };
        now = outcome.motion;
    }
    let later = (0..20).fold(now.clone(), |now, _| step(&now).motion);
    [now.velocity.magnitude(), later.velocity.magnitude()]
}

fn micro_bounces(reading: Reading) -> Result<Vec<Finding>> {
    const FURTHER: usize = 40;
    let (bouncing, plastic) = reading.only(0).pick((ratio(1, 2), ratio(0, 1)), (ratio(0, 1), ratio(1, 2)));
    let [absorbed, later] = speeds_after_absorption(bouncing);
    let plastic = speeds_after_absorption(plastic);
    let decay = (0..20).fold(absorbed, |speed, _| speed / ratio(2, 1));
    let mut findings = vec![
        Finding::decision("the ball still moves 20 steps after its last bounce", later > ratio(0, 1), true).says(false).violating("e = 0"),
        Finding::exact("its speed minus e^20 times the speed then", &(later - decay), &ratio(0, 1), "m/s").context(),
        Finding::exact("the same with e = 0", &plastic[1], &ratio(0, 1), "m/s"),
    ];
    let scheme = MoreauJean { theta: 1.0, activation: Activation::HalfStepForecast, restitution: RestitutionRule::NormalOnly };
    let never = Altered { base: scheme, mistake: Mistake::ApproachingOnly };
    let subject: &dyn Scheme = reading.only(1).pick(&scheme, &never);
    let ball = DroppedBall { mass: 1.0, gravity: 10.0, height: 0.05, restitution: 0.5 };
    for h in [0.01, 0.001] {
        let drop = ball.drop(&scheme, h);
        let limit = (drop.accumulation() + drop.bounds().late).ceil() as usize;
        let settling = settle(subject, &ball, h, limit, FURTHER)?;
        // not absorbed: more than all steps taken
        let absorbed = settling.absorbed.unwrap_or(limit + FURTHER);
        findings.push(Finding::at_most(format!("steps to absorption, h = {h}"), absorbed as f64, limit as f64, "1"));
        let speed = drop.remaining_speed(FURTHER);
        findings.push(Finding::at_most(format!("speed {FURTHER} steps later, h = {h}"), settling.speed, speed, "g h"));
    }
    Ok(findings)
}

/// sup|q_h − q| and ∫|v_h − v| of a scheme to the apex after the impact of a ball with e = 0.8, in units of V h, against what is derived
/// for Moreau–Jean with activation φ ≤ 0: the largest of six phases of the impact, with 64 and 256 steps to it.
fn errors_of_one_impact(subject: &dyn Scheme, theta: f64) -> Result<Vec<Finding>> {
    const SHIFTS: usize = 6;
    let (restitution, horizon) = (0.8, 1.8);
    let derived = Impacts { theta, forecast: 0.0, restitution, shifts: SHIFTS, impacts: Some(1), horizon };
    let found = study(subject, restitution, horizon, &[64, 256], SHIFTS)?;
    // of the study's ball, dropped from 1 m
    let exact = BouncingBall::new(9.81, 1.0, restitution)?;
    let (fall, speed) = (exact.first_impact_time(), exact.impact_speed(1));
    let mut findings = Vec::new();
    for (metric, estimate, bounds) in [
        ("sup|q_h − q|", &found.position, Impacts::position as fn(&Impacts, f64) -> Bounds),
        ("∫|v_h − v|", &found.velocity_l1, Impacts::velocity_l1),
    ] {
        for (level, steps) in estimate.levels.iter().zip([64, 256]) {
            let Bounds { lower, upper } = bounds(&derived, fall / level.time_step);
            let name = format!("{metric}, θ = {theta}, {steps} steps to the impact");
            let constant = level.error / (speed * level.time_step);
            findings.push(Finding::equal(name, constant, 0.5 * (lower + upper), 0.5 * (upper - lower), "V h"));
        }
    }
    Ok(findings)
}

fn converges_on_the_ball(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for theta in [0.5, 1.0] {
        let scheme = MoreauJean { theta, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
        let forgetful = RESTITUTION_FORGOTTEN.subject.of(scheme);
        let subject: &dyn Scheme = reading.only(2).pick(&scheme, &forgetful);
        findings.extend(errors_of_one_impact(subject, theta)?);
    }
    let together = quartered(&corner::leaning(), reading.only(1).pick(0, 5))?;
    findings.push(Finding::exact("sup |q_h − q| with h/4 over that with h, walls closed in one step", &together, &ratio(1, 4), "1"));
    findings.push(floor_before_wall(&reading.only(0).pick(corner::leaning(), corner::upright()))?);
    Ok(findings)
}

fn two_meanings_of_d(reading: Reading) -> Result<Vec<Finding>> {
    let integers = |rows, columns, entries: &[i64]| DMatrix::from_row_iterator(rows, columns, entries.iter().map(|&entry| ratio(entry, 1)));
    // Rows are directions in (n, t) coordinates: Dᵀ of §4 holds t and −t, the contact Jacobian n and t.
    let (tangents, stacked) = (integers(2, 2, &[0, 1, 0, -1]), integers(2, 2, &[1, 0, 0, 1]));
    let mass = integers(2, 2, &[2, 0, 0, 2]);
    let (of_table, of_section) =
        (delassus(&mass, reading.only(0).pick(&tangents, &stacked))?, delassus(&mass, reading.only(1).pick(&stacked, &tangents))?);
    // by its meaning: the velocity (n, t) that unit impulses along n and t give
    let unit_impulse =
        |k: usize| solve(&mass, &stacked.row(k).transpose()).ok_or_else(|| Error::invalid("mass", "is singular", "give masses"));
    let operator = DMatrix::from_columns(&[unit_impulse(0)?, unit_impulse(1)?]);
    let determinant = |w: &DMatrix<Rational>| w[(0, 0)].clone() * &w[(1, 1)] - w[(0, 1)].clone() * &w[(1, 0)];
    Ok(vec![
        Finding::decision("DᵀM⁻¹D is the Delassus operator, D of §5", of_section == operator, true),
        Finding::decision("DᵀM⁻¹D is the Delassus operator, D of §4", of_table == operator, false)
            .says(true)
            .violating("D stacks normals and tangents"),
        Finding::exact("det DᵀM⁻¹D, D of §4", &determinant(&of_table), &ratio(0, 1), "1/kg²")
            .says(determinant(&operator))
            .violating("D stacks normals and tangents"),
    ])
}
