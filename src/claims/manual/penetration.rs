//! Rows 1 and 2: bodies that pass through each other, and a simulation that stalls.

use crate::checks::zeno::{DroppedBall, absorption, events_predicted, events_until};
use crate::claims::experiments::curve::{Side, drift, slide};
use crate::claims::experiments::soft::{default_contact, land, stiffest_contact};
use crate::claims::prelude::*;
use crate::closed_forms::bouncing_ball::impact_time_ratio;
use crate::closed_forms::mujoco_normal::NormalContact;
use crate::exact_particle::{Ball, BallState};
use crate::schemes::{Activation, Anitescu, MoreauJean, RestitutionRule, Scheme, StewartTrinkle};
use crate::tolerance::claims::{lcp::circle_residual, pathology as tolerance};

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "R1",
        statement: r"Bodies pass through the floor or into each other: possible causes (a) the step is too large, (b) a velocity-level
            scheme drifts, (c) soft contact penetrates by nature, (d) a collision is missed. Reduce $h$: if the penetration shrinks
            linearly it is discretisation error; is the simulator soft (penetration is normal) or rigid (project)? project the position in
            velocity-level schemes; check the collision margin.",
        verdict: ClaimVerdict::True,
        kind: Kind::Advice,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated: a linear decrease means discretisation error. The converse does not hold: the exponent $p$ of
            penetration $\propto h^p$ is 0 for the depth of a soft law, 1 for the drift of a velocity-level scheme along a curve or the
            overshoot of an impact, 2 for the linearised gap of Stewart–Trinkle, which is discretisation error too.",
        argument: r"$h$ against $h/2$. MuJoCo's ball at rest, steps of a hundredth of a second and of half of that: ratio 1. Bead in a
            circle under Moreau–Jean for 1 s, $h = 1/100$: 2 up to the enclosure $|q|^4 \in 1 + 2nh^2 + [0, nh^4]$. The same under
            Stewart–Trinkle: $4\,(\tfrac12h^2)$. Plastic ball that crosses the floor in the middle of a step at 1 m/s: exactly
            $2\,(h/2)$.",
        controls: &[
            "Stewart–Trinkle in place of Moreau–Jean in the test for linear decrease.",
            r"A soft contact as stiff as its step allows, $t_c = 2h$, and a ball that starts at the same height for both steps.",
        ],
        sources: &["chapter, troubleshooting manual, row 1"],
        check: check!(exponents),
    },
    Claim {
        id: "R2",
        statement: "The simulation gets stuck, its step shrinks to machine precision: possible cause event-driven simulation of a Zeno \
            scene (a ball coming to rest). Confirm whether events are detected; if so, change to time stepping (fixed step, no events), \
            which absorbs the many small bounces.",
        verdict: ClaimVerdict::True,
        kind: Kind::Advice,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated, with an activation rule that absorbs (S0.zeno-absorb).",
        argument: r"$q_0 = 1/20$ m, $g = 10$ m/s², $e = 1/2$: $t_1 = 1/10$ s, $T_\infty = 3/10$ s. Event 200 still lies before $T_\infty$,
            in rationals; in double precision the events stop advancing time after about 53. Moreau–Jean with $h = 1/1000$ s is at rest
            within the bound proved for $T_\infty$, in a fixed number of steps.",
        controls: &[
            r"An elastic ball, $e = 1$, whose event 200 comes long after $T_\infty$.",
            "Single precision, and Anitescu's plastic step in place of Moreau–Jean's.",
        ],
        sources: &["chapter, troubleshooting manual, row 2", "chapter §0 and §1"],
        check: check!(stall),
    },
];

/// Ratio of two numbers with absolute errors, and its error.
fn quotient(numerator: f64, denominator: f64, errors: [f64; 2]) -> f64 {
    let relative = errors[0] / numerator + errors[1] / denominator;
    numerator / denominator * relative / (1.0 - errors[1] / denominator)
}

/// Depth after the step in which a plastic ball at 1 m/s crosses the floor from a height.
fn overshoot(h: &Rational, height: Rational) -> Rational {
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(0, 1), restitution: ratio(0, 1) };
    let before = BallState { position: height, velocity: ratio(-1, 1) };
    let landed = ball.moreau_jean(&before, &ratio(1, 2), Activation::Gap, h).motion;
    -ball.moreau_jean(&landed, &ratio(1, 1), Activation::Gap, h).motion.position
}

fn exponents(reading: Reading) -> Result<Vec<Finding>> {
    let velocity_level = MoreauJean { theta: 1.0, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
    let position_level = StewartTrinkle::default();
    let after_one_second =
        |scheme: &dyn Scheme, steps: usize| slide(scheme, Side::Inside, 1.0 / steps as f64, steps).map(|track| track.last);
    let drifting: &dyn Scheme = reading.only(0).pick(&velocity_level, &position_level);
    let [[coarse, coarse_error], [fine, fine_error]] = [drift(0.01, 100), drift(0.005, 200)];
    let measured = after_one_second(drifting, 100)? / after_one_second(drifting, 200)?;
    let deepest = |steps: usize| slide(&position_level, Side::Inside, 1.0 / steps as f64, steps).map(|track| track.deepest);
    let [residual_coarse, residual_fine] = [0.01, 0.005].map(|h| circle_residual(h) * h * h);
    let four = quotient(0.5 * 0.01 * 0.01, 0.5 * 0.005 * 0.005, [residual_coarse, residual_fine]);
    let contact = reading.only(1).pick(default_contact as fn(f64) -> NormalContact, stiffest_contact);
    let soft = |steps: usize| land(&contact(3.0 / steps as f64), 0.0, steps).depth;
    // half of the step above the floor, or as high for both steps
    let crossing = |h: Rational| overshoot(&h, reading.only(1).pick(&h / ratio(2, 1), ratio(1, 400)));
    Ok(vec![
        Finding::equal(
            "drift along a circle at h = 1/100 over that at 1/200",
            measured,
            coarse / fine,
            quotient(coarse, fine, [coarse_error, fine_error]),
            "1",
        ),
        Finding::equal("depth of MuJoCo's ball at 10 ms over that at 5 ms", soft(300) / soft(600), 1.0, tolerance::AT_REST, "1"),
        Finding::equal("residual of Stewart–Trinkle at 1/100 over that at 1/200", deepest(100)? / deepest(200)?, 4.0, four, "1").context(),
        Finding::exact(
            "overshoot of an impact at 1/100 over that at 1/200",
            &(crossing(ratio(1, 100)) / crossing(ratio(1, 200))),
            &ratio(2, 1),
            "1",
        ),
    ])
}

fn stall(reading: Reading) -> Result<Vec<Finding>> {
    let restitution = reading.only(0).pick(ratio(1, 2), ratio(1, 1));
    let event = impact_time_ratio(&restitution, 200) * ratio(1, 10);
    let ball = DroppedBall { mass: 1.0, gravity: 10.0, height: 0.05, restitution: 0.5 };
    let remaining = f64::EPSILON * ball.accumulation_time();
    let told = reading.only(1).pick(remaining, f64::from(f32::EPSILON) * ball.accumulation_time());
    let proved = MoreauJean { theta: 1.0, activation: Activation::HalfStepForecast, restitution: RestitutionRule::NormalOnly };
    let scheme: &dyn Scheme = reading.only(1).pick(&proved, &Anitescu);
    let settled = absorption(scheme, &proved, &ball, 0.001, 40)?;
    let kept = settled.iter().filter(|finding| finding.holds()).count();
    Ok(vec![
        Finding::decision("event 200 lies before T∞ = 3/10 s", event < ratio(3, 10), true),
        Finding::equal(
            "events in double precision until time stops advancing",
            events_until(&ball, told) as f64,
            events_predicted(&ball, remaining),
            tolerance::LAST_EVENTS,
            "1",
        ),
        Finding::count("bounds proved of the time stepping that hold: absorbed, when, how deep, where, how fast", kept, 6),
    ])
}
