//! Joints and what keeps them together: Baumgarte's oscillator, Gear–Gupta–Leimkuhler, projection – on a pendulum, in closed form.

use crate::claims::prelude::*;
use crate::closed_forms::baumgarte_decay::time_constant;
use crate::closed_forms::stabilised_circle::{biased_energy, biased_offset, projected_energy};
use crate::integrators::{Method, Phase, RungeKutta, SpringDamper};
use crate::mechanics::State;
use crate::scalar::exact;
use crate::stabilisation::{
    Baumgarte, Constrained, CoordinateProjection, GearGuptaLeimkuhler, Pendulum, PositionProjection, Stabilisation, VelocityLevel,
    ViolationStep, run,
};
use crate::tolerance::claims::pathology::FOUR_DIGITS;
use crate::tolerance::claims::stabilisation::{DECAY_STEP, decayed, enveloped, swing_run};
use crate::tolerance::stabilisation::{circle_run, on_constraint};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S9.baumgarte-eq",
        statement: r"Baumgarte stabilisation $\ddot\varphi + 2\alpha\dot\varphi + \beta^2\varphi = 0$ forces the violation $\varphi$ to
            decay to zero as a damped oscillation.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated of the equation with damping and a restoring term, $\alpha > 0$ and $\beta > 0$; it swings if
            $\alpha < \beta$, and exercise 2 tells the overdamped case apart. The semi-implicit step of it decays if and only if, besides,
            $4\alpha h + \beta^2h^2 < 4$: above that the violation grows.",
        argument: r"Roots $-\alpha \pm \sqrt{\alpha^2 - \beta^2}$. From $\dot\varphi = 0$ and $\beta = 5/s$, $\varphi$ crosses zero nine
            times in 10 s for $\alpha = 4/s$ and never in 2 s for $\alpha = 6/s$, and stays below its envelope. The step has determinant
            $1 - 2\alpha h$ and trace $2 - 2\alpha h - \beta^2h^2$: for $2\alpha h = 1$, $\beta^2h^2 = 2 - 10^{-6}$ decays
            and 2 does not.",
        controls: &[r"The equation without damping, $\alpha = 0$, in place of $\alpha = 4/s$.", "The sign of the damping wrong."],
        sources: &["chapter §9, constraint drift, (1)", "Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1"],
        check: check!(equation),
    },
    Claim {
        id: "S9.baumgarte-tuning",
        statement: r"Critical damping $\alpha = \beta$ is hard to hit exactly in practice, and that is why Baumgarte is hard to tune.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Exercise,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Both numbers are chosen, and $\varphi$ obeys the equation whatever the masses are, so $\alpha = \beta$ can be
            hit exactly. But it is not critical for the step: $\alpha = \beta(1 - \beta h/2)$ is, and $2\alpha h = \beta h = 1$ ends any
            violation in two steps. Near $\alpha = \beta$ the rate is sensitive on one side only: overdamping by 5 % costs 27 % of it,
            underdamping by 5 % costs 5 %.",
        argument: r"Slow rate over $\beta$, integrated, for $\alpha/\beta = 0.95$, 1.01, 1.05, 1.1: 0.95, 0.8682, 0.7298, 0.6417. At
            $\beta h = 1/5$ the step with $\alpha = \beta$ has $\operatorname{trace}^2 - 4$ det $= 21/625 > 0$, overdamped, and with
            $2\alpha h = 9/25$ exactly 0.",
        controls: &[r"$\alpha = \beta$ and $\alpha = \beta(1 - \beta h/2)$ exchanged.", r"$\beta/\alpha$ in place of $\alpha/\beta$."],
        sources: &["chapter §9, constraint drift, (1), and exercise 2"],
        check: check!(tuning),
    },
    Claim {
        id: "S9.erp-sim2real",
        statement: r"Bullet's $\mathrm{ERP}$ of 0.2 “artificially flattens” the oscillations of a robot's joints, which leads to a gap
            between simulation and reality (joints softer than real ones).",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "Of the violation of a joint it is so: the bias lets it decay by 4/5 a step without oscillation. The motion \
            that the joint allows is not flattened: on a circle it keeps the angular momentum exactly, and settles with more energy than \
            projection leaves. How large a gap to a real robot is cannot be decided here.",
        argument: r"Point on a circle, $hv/R = 1/100$, 10000 steps: bias $-0.2\,\varphi/h$ keeps the angular momentum and $E/E_0 = 0.9995$
            and stays $h^2v^2/(2\cdot0.2\,R)$ outside; coordinate projection keeps $1/(1 + n\,h^2v^2/R^2) = 1/2$ of the energy. On a
            linear constraint the bias leaves $(4/5)^5$ of the violation after five steps, and never changes its sign.",
        controls: &["Projection in place of the bias and the bias in place of projection.", "A bias without damping."],
        sources: &["chapter §9, constraint drift, (1)", "S9.bullet-erp for the value and its decay"],
        check: check!(joint_oscillation),
    },
    Claim {
        id: "S9.ggl",
        statement: "GGL stabilisation imposes position and velocity constraint at the same time; no damping to tune, but a larger system.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated: two multipliers per constraint in place of one. It is not free of numerical damping: with the
            implicit Euler rule a point on a circle keeps $1/(1 + n\,h^2v^2/R^2)$ of its energy, exactly what coordinate projection
            leaves.",
        argument: r"Circle, $hv/R = 1/100$: after 1000 steps $\varphi$ and $Gv$ are at rounding and $E/E_0 = 1/1.1$. The bias has
            $\varphi = \text{2.5e-4}\,R$ instead, and no stabilisation $|q| = 1.047\,R$.",
        controls: &[r"The bias with $\mathrm{ERP} = 0.2$."],
        sources: &["chapter §9, constraint drift, (2) and table", "Gear, Leimkuhler and Gupta, J. Comput. Appl. Math. 12–13 (1985) 77"],
        check: check!(index_two),
    },
    Claim {
        id: "S9.poststab-def",
        statement: "Post-stabilisation projects only the position after each step, coordinate projection position and velocity together.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Definition,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: r"Usage differs: Ascher and Petzold's post-stabilisation corrects position and velocity as well. And for a step
            that imposes $G\,v^+ = 0$ at its start the two make the same motion: the positions agree, and the velocities differ by the
            projection which the next step makes anyway.",
        argument: r"Pendulum of 1 m from 1.5 rad, $h = 1/100$ s, 1000 steps: positions agree to rounding, velocities differ by $|v|$ sin
            $\Delta$ with tan $\Delta = h|v|/\ell$, up to 0.18 m/s. Reason: $v^+ = P\,v + h\,P\,M^{-1}F$ and $P\,P\,v = P\,v$, for forces
            that depend on $q$.",
        controls: &["No stabilisation in place of coordinate projection."],
        sources: &[
            "chapter §9, constraint drift, (3)",
            "Ascher, Chin and Reich, Numer. Math. 67 (1994) 131; Eich, SIAM J. Numer. Anal. 30 (1993) 1467 (abstracts only)",
        ],
        check: check!(two_projections),
    },
    Claim {
        id: "S9.ex2",
        statement: r"Exercise 2: find the time constant of $\ddot\varphi + 2\alpha\dot\varphi + \beta^2\varphi = 0$; how does the
            violation evolve for $\alpha < \beta$ and for $\alpha > \beta$?",
        verdict: ClaimVerdict::True,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"$\alpha \le \beta$: $\tau = 1/\alpha$, for $\alpha < \beta$ oscillating at $\sqrt{\beta^2 - \alpha^2}$.
            $\alpha > \beta$: two decays without oscillation, the slower with $\tau = 1/(\alpha - \sqrt{\alpha^2 - \beta^2}) \approx
            2\alpha/\beta^2$: beyond critical, more damping is slower.",
        argument: r"$\beta = 5/s$, $\alpha = 1$, 5, 10, 50/$s$: $\tau = 1$, 0.2, 0.74641, 3.98997 s. Integrated from a start on the slow
            solution, each decays by $e^{-1}$ in $\tau$.",
        controls: &[r"$\tau = 1/\alpha$ for $\alpha > \beta$.", r"The equation with half the $\beta$ of the formula."],
        sources: &["chapter §9, exercise 2"],
        check: check!(exercise),
    },
];

/// φ at t = 0, h, 2h, … up to the duration, from (φ, φ̇).
fn integrated([damping, frequency]: [f64; 2], start: [f64; 2], duration: f64) -> Vec<f64> {
    let oscillator = SpringDamper { stiffness_per_mass: exact(frequency * frequency), damping_per_mass: exact(2.0 * damping) };
    let steps = (duration / DECAY_STEP).ceil() as usize;
    let h = duration / steps as f64;
    let mut now = Phase::of_one(start[0], start[1]);
    let mut violations = vec![start[0]];
    for _ in 0..steps {
        now = RungeKutta.step(&oscillator, &now, &h);
        violations.push(now.position[0]);
    }
    violations
}

fn sign_changes(values: &[f64]) -> usize {
    values.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count()
}

/// What |φ| from (1, 0) stays below: β/√(β² − α²) e^{−αt} for α < β, and s₂/(s₂ − s₁) e^{−s₁t} with the roots −s₁ > −s₂ for α > β.
fn envelope([damping, frequency]: [f64; 2], duration: f64) -> f64 {
    let apart = ((damping - frequency) * (damping + frequency)).abs().sqrt();
    let (amplitude, rate) = if damping < frequency {
        (frequency / apart, damping)
    } else {
        (0.5 * (damping + apart) / apart, 1.0 / time_constant(damping, frequency))
    };
    amplitude * (-rate * duration).exp()
}

fn equation(reading: Reading) -> Result<Vec<Finding>> {
    let step = |damping: Rational, stiffness: Rational| ViolationStep { damping, stiffness }.decays();
    let (swinging, overdamped) = ([4.0, 5.0], [6.0, 5.0]);
    let phi = |constants, duration| integrated(constants, [1.0, 0.0], duration);
    let end = |run: &[f64]| run.last().copied().unwrap_or(f64::NAN).abs();
    let bound = |constants, duration| envelope(constants, duration) * (1.0 + enveloped(duration));
    let sense = reading.only(1).pick(1, -1);
    let damped = |[damping, frequency]: [f64; 2], duration| phi([f64::from(sense) * damping, frequency], duration);
    let (swung, crept) = (damped(reading.only(0).pick(swinging, [0.0, 5.0]), 10.0), damped(overdamped, 2.0));
    let small = ratio(1, 100);
    let step = |damping: Rational, stiffness: Rational| step(ratio(i64::from(sense), 1) * damping, stiffness);
    let limit = ratio(1_999_999, 1_000_000);
    Ok(vec![
        Finding::at_most("|φ| after 10 s, α = 4/s, β = 5/s", end(&swung), bound(swinging, 10.0), "m"),
        Finding::count("zeros of φ in 10 s", sign_changes(&swung), 9),
        Finding::count("zeros of φ in 2 s, α = 6/s", sign_changes(&crept), 0).context(),
        Finding::at_most("|φ| after 2 s, α = 6/s", end(&crept), bound(overdamped, 2.0), "m"),
        Finding::decision("the step with 2αh = β²h² = 1/100 decays", step(small.clone(), small), true),
        Finding::decision("the step with 2αh = 1, β²h² = 2 − 10⁻⁶ decays", step(ratio(1, 1), limit), true),
        Finding::decision("the step with 2αh = 1, β²h² = 2 decays", step(ratio(1, 1), ratio(2, 1)), false).context(),
    ])
}

/// trace² − 4 det of the step at βh = 1/5: negative oscillates, 0 is critical, positive is overdamped.
fn discriminant(damping: Rational) -> Rational {
    let [determinant, trace] = ViolationStep { damping, stiffness: ratio(1, 25) }.invariants();
    &trace * &trace - ratio(4, 1) * determinant
}

fn tuning(reading: Reading) -> Result<Vec<Finding>> {
    let equal = ratio(2, 5);
    let [critical, equal] = reading.only(0).pick([ratio(9, 25), equal.clone()], [equal, ratio(9, 25)]);
    let hit = discriminant(critical) == ratio(0, 1);
    let mut findings = vec![
        Finding::decision("2αh = 2βh − β²h² hits the critical damping of the step exactly", hit, true)
            .says(false)
            .violating("constants chosen without regard to the step"),
        // α = β misses it
        Finding::exact("trace² − 4 det, α = β", &discriminant(equal), &ratio(21, 625), "1"),
    ];
    for (share, rate) in [(0.95_f64, 0.95), (1.01, 0.8682), (1.05, 0.7298), (1.1, 0.6417)] {
        let found = slow_rate(reading.only(1).pick(share, share.recip()));
        findings.push(Finding::equal(format!("slow rate over β, α = {share} β"), found, rate, FOUR_DIGITS, "1"));
    }
    let ends = ViolationStep { damping: ratio(1, 1), stiffness: ratio(1, 1) };
    let [left, _] = ends.advance(&ends.advance(&[ratio(1, 1), ratio(1, 3)]));
    findings.push(Finding::exact("φ after two steps with 2αh = βh = 1", &left, &ratio(0, 1), "m").context());
    Ok(findings)
}

/// The rate −ln|φ(T)/φ(0)|/(βT) of φ̈ + 2αφ̇ + β²φ = 0 for this α/β and β = 8/s, integrated from a start on the slow solution:
/// over T = τ for α > β, over half a swing, after which φ = −e^{−αT}, for α < β.
fn slow_rate(share: f64) -> f64 {
    let frequency = 8.0;
    let tau = time_constant(share * frequency, frequency);
    let duration = if share < 1.0 { std::f64::consts::PI / (frequency * (1.0 - share * share).sqrt()) } else { tau };
    let run = integrated([share * frequency, frequency], [1.0, -1.0 / tau], duration);
    -run.last().copied().unwrap_or(f64::NAN).abs().ln() / (frequency * duration)
}

const STEP: f64 = 0.01;

/// A point on the unit circle at 1 m/s without load, after n steps of 1/100 s; and the share of its energy that is left.
fn circled(method: &dyn Stabilisation, steps: usize) -> Result<(State, f64)> {
    let circle = Pendulum::new(1.0, 1.0, 0.0)?;
    let start = circle.at(0.0, 1.0);
    let end = run(method, &circle, &start, STEP, steps)?;
    let left = circle.energy(&end) / circle.energy(&start);
    Ok((end, left))
}

fn joint_oscillation(reading: Reading) -> Result<Vec<Finding>> {
    const POINT: &str = "how large the gap to a real robot is";
    let (steps, share) = (10_000, 0.2);
    let bias = Baumgarte::error_reduction(share, STEP)?;
    let methods: [&dyn Stabilisation; 2] = [&bias, &CoordinateProjection];
    let [biased, projecting] = reading.only(0).pick(methods, [methods[1], methods[0]]);
    let ((end, kept), (_, projected)) = (circled(biased, steps)?, circled(projecting, steps)?);
    let momentum = end.position[0] * end.velocity[1] - end.position[1] * end.velocity[0];
    let decay = ViolationStep { damping: reading.only(1).pick(ratio(1, 1), ratio(0, 1)), stiffness: ratio(1, 5) };
    let mut violation = [ratio(1, 1), ratio(0, 1)];
    let mut turns = false;
    for _ in 0..5 {
        violation = decay.advance(&violation);
        turns |= violation[0] < ratio(0, 1);
    }
    let bound = circle_run(steps);
    let (of_violation, of_motion) = ("oscillations of the joint's violation", "oscillations that the joint allows");
    Ok(vec![
        Finding::decision("the bias takes angular momentum from the motion", momentum < 1.0 - bound, false).says(true).reading(of_motion),
        Finding::exact("violation left after five steps on a linear constraint", &violation[0], &ratio(4, 5).pow(5), "m")
            .reading(of_violation),
        Finding::decision("the violation changes its sign", turns, false).reading(of_violation),
        Finding::equal("E/E₀ after 16 turns, ERP = 0.2", kept, biased_energy(STEP, share), bound, "1").opinion(POINT),
        Finding::equal("offset of the bias", end.position.norm() - 1.0, biased_offset(STEP, share), bound, "m").opinion(POINT),
        Finding::equal("E/E₀ after 16 turns, coordinate projection", projected, projected_energy(STEP, steps), bound, "1").opinion(POINT),
    ])
}

fn index_two(reading: Reading) -> Result<Vec<Finding>> {
    let (steps, share) = (1000, 0.2);
    let bias = Baumgarte::error_reduction(share, STEP)?;
    let (subject, left) = match reading {
        Reading::Recorded => circled(&GearGuptaLeimkuhler, steps)?,
        Reading::Control(_) => circled(&bias, steps)?,
    };
    let circle = Pendulum::new(1.0, 1.0, 0.0)?;
    let rate = (circle.jacobian(&subject.position) * &subject.velocity)[0];
    let bound = circle_run(steps);
    let radius = (0..steps).fold(1.0, |squared: f64, _| squared + STEP * STEP / squared).sqrt();
    Ok(vec![
        Finding::at_most("|φ| after 1000 steps", circle.violation(&subject.position)[0].abs(), on_constraint(1.0), "m"),
        Finding::at_most("|Gv|", rate.abs(), on_constraint(1.0), "m/s"),
        Finding::equal("E/E₀", left, projected_energy(STEP, steps), bound, "1"),
        Finding::equal("φ of the bias", circled(&bias, steps)?.0.position.norm() - 1.0, biased_offset(STEP, share), bound, "m").context(),
        Finding::equal("|q|/R of no stabilisation", circled(&VelocityLevel, steps)?.0.position.norm(), radius, bound, "1").context(),
    ])
}

fn two_projections(reading: Reading) -> Result<Vec<Finding>> {
    const POINT: &str = "what the two words mean: elsewhere post-stabilisation corrects the velocity too";
    let pendulum = Pendulum::new(1.0, 1.0, 9.81)?;
    let mut pair = [pendulum.at(1.5, 0.0), pendulum.at(1.5, 0.0)];
    let other: &dyn Stabilisation = reading.pick(&CoordinateProjection, &VelocityLevel);
    let [mut positions, mut velocities, mut taken] = [0.0f64; 3];
    for _ in 0..1000 {
        pair = [PositionProjection.step(&pendulum, &pair[0], STEP)?, other.step(&pendulum, &pair[1], STEP)?];
        positions = positions.max((&pair[0].position - &pair[1].position).norm());
        velocities = velocities.max((&pair[0].velocity - &pair[1].velocity).norm());
        // the projection takes |v| sin Δ with tan Δ = h|v|/ℓ
        let speed = pair[0].velocity.norm();
        taken = taken.max(speed * (STEP * speed).atan().sin());
    }
    Ok(vec![
        Finding::at_most("largest distance of the positions", positions, circle_run(1000), "m").opinion(POINT),
        Finding::equal("largest difference of the velocities shown", velocities, taken, swing_run(1000), "m/s").opinion(POINT),
    ])
}

fn exercise(reading: Reading) -> Result<Vec<Finding>> {
    let frequency = 5.0;
    let acting = reading.only(1).pick(frequency, 0.5 * frequency);
    let mut findings = Vec::new();
    for (damping, printed) in [(10.0, 0.746_41), (50.0, 3.989_97), (5.0, 0.2)] {
        let tau = reading.only(0).pick(time_constant(damping, frequency), 1.0 / damping);
        let run = integrated([damping, acting], [1.0, -1.0 / tau], tau);
        let left = run.last().copied().unwrap_or(f64::NAN);
        findings.push(Finding::equal(format!("φ(τ)/φ(0), α = {damping}/s"), left, (-1.0f64).exp(), decayed(damping, frequency, tau), "1"));
        let found = Finding::equal(format!("τ, α = {damping}/s"), tau, printed, FOUR_DIGITS * printed, "s");
        findings.push(if damping > frequency { found } else { found.context() });
    }
    let half = std::f64::consts::PI / 24.0f64.sqrt();
    let swing = integrated([1.0, acting], [1.0, 0.0], half);
    let left = swing.last().copied().unwrap_or(f64::NAN);
    findings.push(Finding::equal("φ after half a swing, α = 1/s", left, -(-half).exp(), decayed(1.0, frequency, half), "1"));
    Ok(findings)
}
