//! §12, the setting, the first step with h = 0.1 and h = 0.01, and the state before the contact step.

use super::motion::{before_contact, start};
use crate::checks::energy::worked_ball;
use crate::claims::prelude::*;
use crate::contact::delassus::delassus;
use crate::exact_particle::{BallState, BallStep};
use crate::mechanics::{Plane, PointMass, State};
use crate::schemes::{Activation, MoreauJean, RestitutionRule, assembled};

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S12.setup",
        statement: r"A point mass $m = 1$ kg under $g = 10$ m/s² above the floor $q = 0$ with gap $\varphi(q) = q$ has
            $H = \nabla\varphi = 1$ and the Delassus operator $W = H\,M^{-1}\,H^T = 1$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated; $W$ has the unit 1/kg.",
        argument: r"$H$ is the derivative of $q$ by $q$, 1, and $W = 1 \cdot (1/1\,\mathrm{kg}) \cdot 1 = 1$/kg: once in rationals, once
            as the problem that the scheme assembles.",
        controls: &[r"The same ball with $m = 2$ kg, for which $W = 1/2$.", r"A ceiling in the place of the floor, $\varphi(q) = -q$."],
        sources: &["chapter §12, setting"],
        check: check!(setup),
    },
    Claim {
        id: "S12.h01",
        statement: r"With $h = 0.1$ the first step forecasts $q_0 + h\,v_\text{free} = -0.05 < 0$, so the contact is active and $P_1 = 1$
            N·s, $v_1 = 0$, although the ball is still at 0.05 m; the chapter itself calls this a degenerate case.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated; moreover the state repeats: the ball hovers at 0.05 m with $P = 1$ N·s in every step.",
        argument: r"$v_\text{free} = 0 - 10 \cdot 1/10 = -1$, forecast $1/20 - 1/10 = -1/20 < 0$, $U = P - 1 + \tfrac12 \cdot 0 = 0$ gives
            $P = 1$ and $v_1 = 0$, $q_1 = 1/20$. The state after the step equals the state before it, hence so do all that follow.",
        controls: &[
            r"The rule $\varphi + \tfrac12\,h\,v \le 0$ of the Siconos code instead of the forecast with $v_\text{free}$: not active, the
                ball falls.",
            r"$h = 1/100$ in the place of 1/10, the chapter's own remedy.",
        ],
        sources: &["chapter §12, step 1"],
        check: check!(coarse_first_step),
    },
    Claim {
        id: "S12.cause",
        statement: r"The early activation exposes a problem of purely velocity-level schemes with a large step: they judge by extrapolated
            penetration; use a smaller $h$, or the position level (Stewart–Trinkle's $\varphi/h$ judges better).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"The cause is the forecast $\varphi + h\,v_\text{free}$ of the activation rule, not the velocity level: under
            $\varphi + \tfrac12\,h\,v \le 0$ the same velocity-level step does not activate. A smaller $h$ does not remove the effect but
            scales it: with the forecast by $v_\text{free}$ the ball comes to rest within $g\,h^2$ of the floor, in general above it.
            Stewart–Trinkle lands exactly.",
        argument: r"$h = 1/10$, $q = 1/20$, $v = 0$: $\varphi + h\,v_\text{free} = -1/20 \le 0$ is active,
            $\varphi + \tfrac12\,h\,v = 1/20$ is not. Stewart–Trinkle: $\varphi/h + v^+ \ge 0$ gives $v^+ = -1/2$ and $q^+ = 0$. With 100,
            200 and 400 steps a second the ball has come to rest after the steps to $T_\infty$ and as many again, at heights in
            $[0, g\,h^2]$.",
        controls: &[
            "The half-step forecast as the rule of the scheme: it does not activate.",
            "A ball that comes at 1 m/s in the place of the one at rest: both rules see it.",
            "The velocity-level step in the place of Stewart–Trinkle's.",
        ],
        sources: &["chapter §12, step 1 and the lesson after it"],
        check: check!(cause),
    },
    Claim {
        id: "S12.h001",
        statement: r"With $h = 0.01$ the forecast is $0.049 > 0$, the contact is not active, $P_1 = 0$, $v_1 = -0.1$ m/s, $q_1 = 0.049$
            m.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated.",
        argument: r"$v_\text{free} = -1/10$, forecast $1/20 + v_\text{free}/100 = 49/1000 > 0$, hence $P_1 = 0$, $v_1 = -1/10$,
            $q_1 = 49/1000$.",
        controls: &[
            r"$\theta = \tfrac12$ instead of 1, which moves the ball by 1/2000 m only.",
            r"$h = 1/10$, with which the contact is active.",
        ],
        sources: &["chapter §12, step 1 repeated with h = 0.01"],
        check: check!(fine_first_step),
    },
    Claim {
        id: "S12.state",
        statement: r"Jump to some step at which the body is about to land: let $q = 0.005$ m, $v = -0.99$ m/s (the velocity accumulated in
            free fall), $h = 0.01$.",
        verdict: ClaimVerdict::Inconsistent,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"Free fall from 0.05 m reaches 0.005 m with $v = -0.9$ m/s after nine such steps (−0.9487 m/s in continuous
            time). The contact step from there has $P = 1.45$ N·s, $v^+ = 0.45$ m/s, $q^+ = 0.0095$ m.",
        argument: r"Free steps with $\theta = 1$ conserve $\tilde E = \tfrac12v^2 + g\,q - \tfrac12\,g\,h\,v$ per unit mass: 1/2 at the
            start, but 11791/20000 at $(0.005, -0.99)$. The bracket ties the state to free fall, from which it is not reachable in this
            example; as an assumed state it serves the computation.",
        controls: &[r"The state $(0.005, -0.9)$, which is reachable.", "A fall from 0.083 m."],
        sources: &["chapter §12, contact step"],
        check: check!(state_before_contact),
    },
];

fn setup(reading: Reading) -> Result<Vec<Finding>> {
    let mass = reading.only(0).pick(1, 2);
    let one = DMatrix::from_element(1, 1, ratio(1, 1));
    let exact = delassus(&DMatrix::from_element(1, 1, ratio(mass, 1)), &one)?;
    // the normal of the plane, and a velocity towards it
    let (normal, velocity) = reading.only(1).pick((1.0, -1.0), (-1.0, 3.0));
    let plane = Plane::new(dvector![normal], 0.0, 0.0, 0.5)?;
    let ball = PointMass::new("ball", mass as f64, dvector![-10.0], vec![plane])?;
    let scheme = MoreauJean { theta: 1.0, activation: Activation::FreeVelocityForecast, restitution: RestitutionRule::NormalOnly };
    let at_floor = State { time: 0.0, position: dvector![0.0], velocity: dvector![velocity] };
    let posed = assembled(&scheme, &ball, &at_floor, 0.1)?;
    let of_scheme = posed.problem.map_or(f64::NAN, |problem| problem.entry(0, 0));
    Ok(vec![
        Finding::exact("W", &exact[(0, 0)], &ratio(1, 1), "1/kg"),
        Finding::equal("W assembled by the scheme", of_scheme, 1.0, 0.0, "1/kg"),
        Finding::equal("H", posed.jacobian.contacts()[0][(0, 0)], 1.0, 0.0, "1"),
    ])
}

/// A step of the example with θ = 1.
fn step(now: &BallState<Rational>, activation: Activation, h: &Rational) -> BallStep<Rational> {
    worked_ball().moreau_jean(now, &ratio(1, 1), activation, h)
}

fn coarse_first_step(reading: Reading) -> Result<Vec<Finding>> {
    let activation = reading.only(0).pick(Activation::FreeVelocityForecast, Activation::HalfStepForecast);
    let h = reading.only(1).pick(ratio(1, 10), ratio(1, 100));
    let first = step(&start(), activation, &h);
    let later = (0..50).fold(first.motion.clone(), |now, _| step(&now, activation, &h).motion);
    Ok(vec![
        Finding::exact("P₁", &first.impulse, &ratio(1, 1), "N·s"),
        Finding::exact("v_free", &first.free_velocity, &ratio(-1, 1), "m/s"),
        Finding::exact("forecast", &first.forecast, &ratio(-1, 20), "m"),
        Finding::exact("v₁", &first.motion.velocity, &ratio(0, 1), "m/s"),
        Finding::exact("q after 51 steps", &later.position, &ratio(1, 20), "m"),
    ])
}

fn cause(reading: Reading) -> Result<Vec<Finding>> {
    let h = ratio(1, 10);
    let blamed = reading.only(0).pick(Activation::FreeVelocityForecast, Activation::HalfStepForecast);
    let coming = BallState { velocity: reading.only(1).pick(ratio(0, 1), ratio(-1, 1)), ..start() };
    let landed = match reading {
        Reading::Control(2) => step(&start(), blamed, &h),
        _ => worked_ball().stewart_trinkle(&start(), &h),
    };
    let mut findings = vec![
        Finding::decision("the blamed rule activates at 0.05 m with h = 0.1", step(&start(), blamed, &h).active, true),
        Finding::decision("the half-step forecast activates", step(&coming, Activation::HalfStepForecast, &h).active, false)
            .says(true)
            .violating("activation by the forecast φ + h v_free"),
        Finding::exact("Stewart–Trinkle: v₁", &landed.motion.velocity, &ratio(-1, 2), "m/s"),
        Finding::exact("Stewart–Trinkle: q₁", &landed.motion.position, &ratio(0, 1), "m"),
    ];
    for inverse in [100, 200, 400] {
        let h = ratio(1, inverse);
        // V = 1 m/s, so T∞ = 0.3 s is 3·inverse/10 steps.
        let rest = (0..6 * inverse / 10).fold(start(), |now, _| step(&now, blamed, &h).motion);
        let height = rest.position / (ratio(10, 1) * &h * &h);
        // between 0 and 1
        findings.push(Finding::equal(format!("height at rest, h = 1/{inverse}"), height.to_f64().value(), 0.5, 0.5, "g h²"));
    }
    Ok(findings)
}

fn fine_first_step(reading: Reading) -> Result<Vec<Finding>> {
    let (theta, h) = (reading.only(0).pick(ratio(1, 1), ratio(1, 2)), reading.only(1).pick(ratio(1, 100), ratio(1, 10)));
    let first = worked_ball().moreau_jean(&start(), &theta, Activation::FreeVelocityForecast, &h);
    Ok(vec![
        Finding::exact("q₁", &first.motion.position, &ratio(49, 1000), "m"),
        Finding::exact("v₁", &first.motion.velocity, &ratio(-1, 10), "m/s"),
        Finding::exact("P₁", &first.impulse, &ratio(0, 1), "N·s"),
        Finding::exact("forecast", &first.forecast, &ratio(49, 1000), "m"),
    ])
}

fn state_before_contact(reading: Reading) -> Result<Vec<Finding>> {
    let (h, ball) = (ratio(1, 100), worked_ball());
    let claimed = BallState { velocity: reading.only(0).pick(ratio(-99, 100), ratio(-9, 10)), ..before_contact() };
    let mut now = BallState { position: reading.only(1).pick(ratio(1, 20), ratio(83, 1000)), ..start() };
    let mut steps = 0usize;
    while now.position > claimed.position {
        now = step(&now, Activation::FreeVelocityForecast, &h).motion;
        steps += 1;
    }
    let contact = step(&now, Activation::FreeVelocityForecast, &h);
    let energy = |motion: &BallState<Rational>| ball.scheme_energy(motion, &ratio(1, 1), &h);
    Ok(vec![
        Finding::decision("the state is reached by free fall from the start", now == claimed, false).says(true),
        Finding::exact("Ẽ where free fall passes 0.005 m", &energy(&now), &ratio(1, 2), "J/kg")
            .says(energy(&start()))
            .passage("the setting"),
        Finding::exact("Ẽ where free fall passes 0.005 m", &energy(&now), &ratio(1, 2), "J/kg").says(energy(&claimed)).passage("the jump"),
        Finding::exact("Ẽ of the state of the jump", &energy(&claimed), &ratio(11791, 20_000), "J/kg").context(),
        Finding::count("steps of free fall to 0.005 m", steps, 9),
        Finding::exact("v there", &now.velocity, &ratio(-9, 10), "m/s"),
        Finding::exact("P of the contact step from there", &contact.impulse, &ratio(29, 20), "N·s"),
        Finding::exact("v⁺ from there", &contact.motion.velocity, &ratio(9, 20), "m/s"),
        Finding::exact("q⁺ from there", &contact.motion.position, &ratio(19, 2000), "m"),
    ])
}
