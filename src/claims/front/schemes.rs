//! Front matter and tables on schemes: misconceptions, the convergence theorem's entry, symbols, the Zeno question, the
//! comparison with engines.

use crate::checks::energy::{worked_ball, worked_step};
use crate::checks::zeno::{DroppedBall, settle};
use crate::claims::prelude::*;
use crate::closed_forms::bouncing_ball::{BouncingBall, impact_time_ratio};
use crate::closed_forms::mujoco_normal::spring_damper_restitution;
use crate::contact::delassus::delassus;
use crate::exact_particle::{Ball, BallState};
use crate::problem::Lcp;
use crate::schemes::{Activation, MoreauJean, RestitutionRule, simulate};
use crate::solvers::ProjectedGaussSeidel;
use crate::solvers::lemke::solution;
use crate::tolerance::claims::thresholds::NOT_FIRST_ORDER;
use crate::tolerance::{schemes as tolerance, zeno};

/// Claims of the preface and the project.
pub const PREFACE: &[Claim] = &[
    Claim {
        id: "P.zeno-quiz",
        statement: "A ball bouncing with e = 0.8: infinitely many bounces in a finite total time (Zeno).",
        verdict: ClaimVerdict::True,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated; the total time is 9 times that of the first fall.",
        argument: "t_k/t₁ = 1 + 2(e + … + e^{k−1}) increases strictly and stays below (1+e)/(1−e) = 9: t_60 and t_240 in rationals. \
                   (e = 0 has one impact, e = 1 an infinite total time.)",
        controls: &["e = 1, for which impact 60 comes at 119 t₁."],
        sources: &["chapter, self-test question 5"],
        check: zeno_question,
    },
    Claim {
        id: "P.compare",
        statement: "Project: run the same three scenes in MuJoCo or PyBullet and compare penetration, energy curves and gliding with \
                    one's own implementation.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Exercise,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "Meaningful once the restitution is matched: a spring–damper contact that can only push has the \
                            restitution of its damping ratio, e^{-2} = 0.135 if critically damped, whatever e the rigid \
                            model was given. Only then do differences of the energy curves speak about the schemes.",
        argument: "ẍ = −2ζẋ − x from x = 0, ẋ = −1 (time in 1/ω), released when the force 2ζẋ + x changes sign. ζ = 1: x = −t e^{−t}, ẍ \
            = (2−t)e^{−t}, release at t = 2 with ẋ = e^{−2}. So a bounce keeps e^{−4} = 0.018 of its energy, against 0.64 for e = 0.8. \
            The damping ratio whose closed form is e = 0.8, found by bisection, does rebound with 0.8. The motion is integrated \
            numerically and held against the closed forms. Engines themselves are not run here.",
        controls: &["The contact with the matched damping ratio in the place of the critically damped one."],
        sources: &["chapter, cumulative project, comparison experiment"],
        check: damped_restitution,
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
        correct_statement: "As stated of time-stepping: one (v⁺, P) satisfies the balance of momentum and the contact law together.",
        argument: "The worked step of §12: m(v⁺ − v) + m g h − P = 0 and P·(v⁺ + e v) = 0 with P = 317/200. Predicting v_free and then \
                   reversing it gives v⁺ = 109/200, P = 327/200 and P·(v⁺ + e v) = 327/4000 J: the patch satisfies the \
                   balance but not the law.",
        controls: &["The patch: integrate freely, then replace v_free by −e v_free."],
        sources: &["chapter, table of misconceptions, row 1"],
        check: simultaneous,
    },
    Claim {
        id: "M.zeno",
        statement: "Time-stepping is robust against Zeno: many micro-bounces are absorbed by one step.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "It never stalls and needs a bounded number of steps, but not one: after the last real bounce the \
                            velocity decays by the factor e per step. One step suffices if e = 0.",
        argument: "v⁺ = −e v in every step once |v| ≤ g h/(1+e) at an active contact, so n steps leave eⁿ of the speed and it takes \
                   40 steps to divide it by 2⁴⁰ if e = ½. The ball of §12 in rationals (h = 1/100) and in floats (h = 10⁻², 10⁻³) \
                   under φ + ½hv ≤ 0; the plastic ball has v = 0 after its impact.",
        controls: &["e = 0 in the place of e = ½: the ball stands still at once."],
        sources: &["chapter §1, comparison table; chapter, cumulative project, scene (a)"],
        check: micro_bounces,
    },
];

/// Claims of the tables of theorems and symbols.
pub const TABLES: &[Claim] = &[
    Claim {
        id: "T.moreau-convergence",
        statement: "Moreau–Jean converges weakly for prox-regular constraints and θ ∈ [½, 1]: q_h → q uniformly, v_h ⇀* v \
                    (attributed to Moreau and Jean, CMAME 177, 1999).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "For one contact, or contacts that meet at right angles (in the metric of M). Otherwise a motion that \
            reaches two of them at once may have several limits, since a step may see one before the other. The hypotheses on impact \
            law, friction and activation rule are missing as well, and the attribution has not been verified here.",
        argument: "Bouncing ball: the error of v_h is at most (1+e)δ₀ + 2 units of g h away from the impact and of the order of V \
            during δ₀ + 1 steps around it; summed, |q_h − q| ≤ C h V with an explicit C (derived in the source). Run with h = 10⁻², \
            10⁻³, 10⁻⁴ for θ = ½ and 1. Corner: plastic unit mass with v⁻ = (−1, −1) m/s into the wedge y ≥ 0, 4x + 3y ≥ 0, g = 10 \
            m/s²; both walls are reached at 1/10 s, −v⁻ lies in the cone of the normals, so it stops. θ = 1, activation φ ≤ 0: with h = \
            1/(10N) s both walls close in one step and the error is h/2; with h = 1/(10N + 5/2) s the floor closes first, the mass \
            slides into the wall and climbs it at 3/5 m/s, for every N.",
        controls: &["Walls at right angles, x ≥ 0 in the place of 4x + 3y ≥ 0."],
        sources: &["chapter, table of theorems", "chapter §3"],
        check: converges_on_the_ball,
    },
    Claim {
        id: "T.symbols",
        statement: "The table of symbols gives D = [d₁, …, d_d] the tangential directions, N = DᵀM⁻¹D the Hessian of \
                    Anitescu's QP (equal to the Delassus operator), N_K(x) the normal cone, E the coupling vector, e the restitution.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Definition,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "Consistent if D is read as the tangential directions in §4 and as the generators of all contact directions, \
                            normals included, in §5, N as a matrix there but as a cone in §2, and E as a vector in §4 but as an energy in \
                            §3: with the D of the table, \
                            DᵀM⁻¹D is not the Delassus operator. (§5 itself says that its D stacks normals and tangents.)",
        argument: "Planar contact of a unit mass: the D of §4 is [t, −t], so DᵀM⁻¹D = [[1, −1], [−1, 1]], singular; the Delassus operator \
            of \
                   (n, t) is the identity. With D = [n, t] both agree.",
        controls: &["D read as [n, t] in both places, for which the two matrices agree."],
        sources: &["chapter, table of symbols; chapter §4 and §5"],
        check: two_meanings_of_d,
    },
];

fn zeno_question(reading: Reading) -> Result<Vec<Finding>> {
    let e = reading.pick(ratio(4, 5), ratio(1, 1));
    let times = [60, 61, 240].map(|impact| impact_time_ratio(&e, impact));
    let mut findings = vec![Finding::decision("impact 240 comes before 9 t₁", times[2] < ratio(9, 1), true)];
    findings.push(Finding::decision("impact 61 comes after impact 60", times[0] < times[1], true));
    let remaining = ratio(9, 1) - times[0].clone();
    let expected = (0..60).fold(ratio(10, 1), |product, _| product * &e);
    findings.push(Finding::exact("(T∞ − t_60)/(10 e^60) in t₁", &(remaining / expected), &ratio(1, 1), "1"));
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
    let (rigid, matched) = (0.8, damping_of(0.8));
    let measured = released_speed(reading.pick(1.0, matched), h);
    let predicted = (-2f64).exp();
    let tolerance = tolerance::released_speed(h);
    let same_scene = "the engine's contact has the restitution of the rigid model";
    Ok(vec![
        Finding::equal("restitution of a contact matched to e = 0.8", released_speed(matched, h), rigid, tolerance, "1"),
        Finding::equal("restitution of a critically damped contact", measured, predicted, tolerance, "1").says(rigid).violating(same_scene),
        // |m² − p²| ≤ 2|m − p| for speeds of at most 1
        Finding::equal("its energy ratio", measured * measured, predicted * predicted, 2.0 * tolerance, "1")
            .says(rigid * rigid)
            .violating(same_scene),
    ])
}

fn simultaneous(reading: Reading) -> Result<Vec<Finding>> {
    let (ball, h, before) = (worked_ball(), ratio(1, 100), ratio(-99, 100));
    let solved = worked_step(&ball, &ratio(1, 1));
    let patched = -ball.restitution.clone() * &solved.free_velocity;
    let velocity = reading.pick(solved.motion.velocity.clone(), patched);
    let impulse = ball.mass.clone() * (velocity.clone() - &solved.free_velocity);
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
    let [absorbed, later] = speeds_after_absorption(reading.pick(ratio(1, 2), ratio(0, 1)));
    let plastic = speeds_after_absorption(ratio(0, 1));
    let decay = (0..20).fold(absorbed, |speed, _| speed / ratio(2, 1));
    let mut findings = vec![
        Finding::decision("the ball still moves 20 steps after its last bounce", later > ratio(0, 1), true).says(false).violating("e = 0"),
        Finding::exact("its speed minus e^20 times the speed then", &(later - decay), &ratio(0, 1), "m/s").context(),
        Finding::exact("the same with e = 0", &plastic[1], &ratio(0, 1), "m/s"),
    ];
    let scheme = MoreauJean { theta: 1.0, activation: Activation::HalfStepForecast, restitution: RestitutionRule::NormalOnly };
    let ball = DroppedBall { mass: 1.0, gravity: 10.0, height: 0.05, restitution: 0.5 };
    for h in [0.01, 0.001] {
        let drop = ball.drop(&scheme, h);
        let limit = (drop.accumulation() + drop.bounds().late).ceil() as usize;
        let settling = settle(&scheme, &ball, h, limit, FURTHER)?;
        let absorbed = settling.absorbed.map_or(f64::INFINITY, |steps| steps as f64);
        findings.push(Finding::at_most(format!("steps to absorption, h = {h}"), absorbed, limit as f64, "1"));
        let speed = drop.remaining_speed(FURTHER);
        findings.push(Finding::at_most(format!("speed {FURTHER} steps later, h = {h}"), settling.speed, speed, "g h"));
    }
    Ok(findings)
}

fn converges_on_the_ball(reading: Reading) -> Result<Vec<Finding>> {
    let ball = DroppedBall { mass: 1.0, gravity: 10.0, height: 0.05, restitution: 0.5 };
    let exact = BouncingBall::new(ball.gravity, ball.height, ball.restitution)?;
    let second_apex = exact.first_impact_time() * (1.0 + ball.restitution);
    let mut findings = Vec::new();
    for theta in [0.5, 1.0] {
        let scheme = MoreauJean { theta, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
        for h in [0.0001, 0.001, 0.01] {
            let (mechanism, initial) = ball.at_rest();
            let steps = (second_apex / h) as usize;
            let recording = simulate(&scheme, &ProjectedGaussSeidel::default(), &mechanism, initial, h, steps)?;
            let error = |k: usize| (recording.samples[k].position[0] - exact.state(k as f64 * h).0).abs();
            let largest = (0..=steps).map(error).fold(0.0, f64::max);
            let drop: zeno::Drop = ball.drop(&scheme, h);
            let bound = drop.position_error() * ball.gravity * h * h;
            findings.push(Finding::at_most(format!("sup |q_h − q|, θ = {theta}, h = {h}"), largest, bound, "m"));
        }
    }
    let wall = reading.pick([ratio(4, 5), ratio(3, 5)], [ratio(1, 1), ratio(0, 1)]);
    let fall = |denominator: i64| error_in_corner(&wall, &ratio(2, denominator));
    let together = fall(20 * 256)? / fall(20 * 64)?;
    let apart = fall(20 * 256 + 5)? / fall(20 * 64 + 5)?;
    findings.push(Finding::exact("sup |q_h − q| with h/4 over that with h, walls closed in one step", &together, &ratio(1, 4), "1"));
    findings.push(
        Finding::at_least(
            "sup |q_h − q| with h/4 over that with h, floor closed before the wall",
            apart.to_f64().value(),
            NOT_FIRST_ORDER,
            "1",
        )
        .says_at_most(NOT_FIRST_ORDER)
        .violating("one contact, or contacts that meet at right angles"),
    );
    Ok(findings)
}

/// max |q_h − q| up to 1/5 s of a plastic unit mass, g = 10 m/s², that reaches the floor y ≥ 0 and a wall, given by its normal, both at
/// 1/10 s with v = (−1, −1) m/s, and stays in the corner. Moreau–Jean with θ = 1 and activation φ ≤ 0.
fn error_in_corner(wall: &[Rational; 2], h: &Rational) -> Result<Rational> {
    let normals = [[ratio(0, 1), ratio(1, 1)], wall.clone()];
    let (mut place, mut velocity) =
        (DVector::from_vec(vec![ratio(1, 10), ratio(1, 20)]), DVector::from_vec(vec![ratio(-1, 1), ratio(0, 1)]));
    let (mut time, mut worst) = (ratio(0, 1), ratio(0, 1));
    while time < ratio(1, 5) {
        let free = &velocity - DVector::from_vec(vec![ratio(0, 1), ratio(10, 1) * h]);
        let closed: Vec<&[Rational; 2]> = normals.iter().filter(|n| &n[0] * &place[0] + &n[1] * &place[1] <= ratio(0, 1)).collect();
        let jacobian = DMatrix::from_fn(closed.len(), 2, |i, j| closed[i][j].clone());
        velocity = if closed.is_empty() {
            free
        } else {
            let step = Lcp::new(&jacobian * jacobian.transpose(), &jacobian * &free);
            free + jacobian.transpose() * solution(&step)?
        };
        place += &velocity * h.clone();
        time += h;
        let left = (ratio(1, 10) - &time).max(ratio(0, 1));
        let height = if left > ratio(0, 1) { ratio(1, 20) - ratio(5, 1) * &time * &time } else { ratio(0, 1) };
        worst = worst.max((&place[0] - left).magnitude()).max((&place[1] - height).magnitude());
    }
    Ok(worst)
}

fn two_meanings_of_d(reading: Reading) -> Result<Vec<Finding>> {
    let integers = |rows, columns, entries: &[i64]| DMatrix::from_row_iterator(rows, columns, entries.iter().map(|&entry| ratio(entry, 1)));
    // Rows are directions in (n, t) coordinates: Dᵀ of §4 holds t and −t, the contact Jacobian n and t.
    let jacobian = integers(2, 2, &[1, 0, 0, 1]);
    let directions = reading.pick(integers(2, 2, &[0, 1, 0, -1]), jacobian.clone());
    let mass = integers(2, 2, &[1, 0, 0, 1]);
    let (of_table, of_contact) = (delassus(&mass, &directions)?, delassus(&mass, &jacobian)?);
    let determinant = |w: &DMatrix<Rational>| w[(0, 0)].clone() * &w[(1, 1)] - w[(0, 1)].clone() * &w[(1, 0)];
    Ok(vec![
        Finding::decision("DᵀM⁻¹D is the Delassus operator, D of §5", delassus(&mass, &jacobian)? == of_contact, true),
        Finding::decision("DᵀM⁻¹D is the Delassus operator, D of §4", of_table == of_contact, false)
            .says(true)
            .violating("D stacks normals and tangents"),
        Finding::exact("det DᵀM⁻¹D, D of §4", &determinant(&of_table), &ratio(0, 1), "1/kg²")
            .says(determinant(&of_contact))
            .violating("D stacks normals and tangents"),
    ])
}
