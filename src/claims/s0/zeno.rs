//! §0, the Zeno phenomenon: event-driven methods before T∞, time-stepping through it.

use crate::checks::zeno::{DroppedBall, absorption};
use crate::claims::prelude::*;
use crate::closed_forms::bouncing_ball::BouncingBall;
use crate::defects::zeno::{Altered, Mistake, RULE_C, sinking};
use crate::schemes::{Activation, Anitescu, MoreauJean, RestitutionRule, Scheme};
use crate::tolerance::rounding;

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S0.event-stuck",
        statement: r"An event-driven method must detect and process every bounce; near $T_\infty$ the intervals tend to zero, the root
            finding never stops and the simulation is stuck before $T_\infty$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated, without a rule of continuation. In exact arithmetic every landing advances the clock and none
            reaches $T_\infty$; in floating point the clock stands still, at $T_\infty$ to rounding, once a flight is shorter than half
            the spacing of floats there. A minimum interval ends the loop after $\lceil\ln(\delta/2t_1)/\ln e\rceil$ landings, and the infinitely
            many bounces can also be summed in closed form.",
        argument: r"With $t_1 = 1$ the $k$-th flight lasts $2e^k$ and $T_\infty = (1 + e)/(1 - e)$. For $e = 4/5$, rationals: after 400
            flights $T_\infty - t = 10\cdot(4/5)^{401} > 0$ and every landing advanced the clock. Floats: $2\cdot0.8^k$ falls below half
            the spacing $2^{-49}$ of the floats near 9 at $k = 159$, and the clock stops.",
        controls: &["An elastic ball, whose flights do not shrink.", "A plastic ball, which has one landing."],
        sources: &["chapter §0, Zeno phenomenon"],
        check: check!(event_loop),
    },
    Claim {
        id: "S0.adhoc",
        statement: "In practice one patches the event-driven method (“slower than a threshold counts as at rest”), which is ad hoc \
                    and destroys physical consistency.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Opinion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: r"Whether a patch is ad hoc is a judgement. Its error is bounded and vanishes with the threshold: stopping at
            take-off speeds below $v_\text{thr}$ skips less than $2\,v_\text{thr}/(g(1 - e))$ of time, $v_\text{thr}^2/(2g)$ of height and
            $\tfrac12\,m\,v_\text{thr}^2$ of energy.",
        argument: r"The flights left from take-off speed $u < v_\text{thr}$ last $2u/g \cdot (1 + e + e^2 + \ldots) = 2u/(g(1 - e))$, and
            none rises above $u^2/(2g)$. Checked in rationals for $e = 4/5$ and thresholds of 1/10, 1/100 and 1/1000 of the impact
            speed.",
        controls: &[r"A patch that stops the ball at $V/2$ whatever threshold it was given: its error does not vanish with the threshold."],
        sources: &["chapter §0, Zeno phenomenon"],
        check: check!(threshold),
    },
    Claim {
        id: "S0.zeno-absorb",
        statement: r"Time-stepping does not detect events: when the steps pass $T_\infty$ the ball has long been at rest, the
            micro-bounces are absorbed automatically, without any special treatment.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"True of Moreau–Jean with the activation rules $\varphi \le 0$, $\varphi + \tfrac12hv \le 0$ and
            $\varphi + h\,v_\text{free} \le 0$ ($0 < e < 1$, $\theta \in \{\tfrac12, 1\}$): the ball is absorbed at a time that differs
            from $T_\infty$ by $O(h \log 1/h)$, early or late, rests within $O(g\,h^2)$ of the floor and keeps $|v| \to 0$ geometrically.
            Under $\varphi + hv \le 0$ with $v \le 0$ it is not: the ball sinks through the floor at $g\,h\,(1 - e)/(2(1 + e))$.",
        argument: r"Two consecutive active states with $|v| \le g\,h/(1 + e)$ contract by $e$ for ever; the discrete energy decides when
            they must occur (proof at the bounds in the source). For $e = 0.8$, $q_0 = 1$ m, $h = 0.01$ s the six variants are absorbed
            between 27 steps before $T_\infty$ ($\varphi \le 0$, $\theta = \tfrac12$) and 43 steps after it
            ($\varphi + h\,v_\text{free} \le 0$, $\theta = 1$). To first order an impact shifts all later landings by $h - p(1 + e)/e$, on
            the average with $p = (3/2 - \lambda - \theta)h$, where the rule looks $\lambda$ of a step ahead: early if
            $\lambda + \theta < 3/2 - e/(1 + e)$, else late. The rule with $v \le 0$ alternates between $v = -g\,h/(1 + e)$ and
            $v = e\,g\,h/(1 + e)$ and loses $(1 - e)\,g\,h^2/(1 + e)$ of height every two steps: 0.01635 m/s for $e = \tfrac12$,
            $h = 0.01$, $g = 9.81$.",
        controls: &[
            r"The unconditional reading: the rule $\varphi + hv \le 0$ with $v \le 0$ put through the same check.",
            r"The rule $\varphi + \tfrac12hv \le 0$ in the place of that with $v \le 0$: the ball does not sink.",
            "Anitescu's scheme, which knows no restitution: the ball rests from its first impact on.",
        ],
        sources: &["chapter §0, Zeno phenomenon; chapter §12 for the rule with v_free"],
        check: check!(absorbs),
    },
    Claim {
        id: "S0.ex1",
        statement: r"Exercise: derive $t_k$, show $t_k \to T_\infty < \infty$, compute $T_\infty$ for $e = 0.8$, $q_0 = 1$ m, $g = 9.81$
            m/s²; near which time does an event-driven method with step $10^{-3}$ s get stuck?",
        verdict: ClaimVerdict::True,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"$T_\infty = 9\,\sqrt{2/9.81}\,s = 4.0637$ s; a method that cannot resolve flights shorter than $10^{-3}$ s
            makes 31 landings and stops $4.47\cdot10^{-3}$ s before $T_\infty$.",
        argument: r"$t_k = t_1(1 + 2(e + \ldots + e^{k - 1}))$, $t_1 = \sqrt{2q_0/g}$. The last flight $2\,t_1\,e^k \ge \delta$ ends with
            landing 31; $\delta\,e/(1 - e) \le T_\infty - t < \delta/(1 - e)$ since the next flight lasts between $e\delta$ and
            $\delta$.",
        controls: &[r"Flights of $t_1\,e^k$, which forgets that the ball goes up and comes down."],
        sources: &["chapter §0, exercise 1"],
        check: check!(accumulation_time),
    },
];

/// The landings of t ← t + 2eᵏ, t = 1 at first, until the clock no longer advances; and the clock.
fn landings<T: Scalar>(restitution: &T, budget: usize) -> (Option<usize>, T) {
    let (mut time, mut flight) = (T::one(), T::ratio(2, 1));
    for count in 1..=budget {
        flight *= restitution.clone();
        let landing = time.clone() + flight.clone();
        if landing <= time {
            return (Some(count), time);
        }
        time = landing;
    }
    (None, time)
}

fn event_loop(reading: Reading) -> Result<Vec<Finding>> {
    const BUDGET: usize = 400;
    let (rounded, exact) = match reading {
        Reading::Recorded => (0.8, ratio(4, 5)),
        Reading::Control(0) => (1.0, ratio(1, 1)),
        Reading::Control(_) => (0.0, ratio(0, 1)),
    };
    let (in_floats, stopped) = landings(&rounded, BUDGET);
    let (in_rationals, reached) = landings(&exact, BUDGET);
    // 2eᵏ at most half the spacing of floats at T∞ = 9; one landing more for the rounding of eᵏ.
    let spacing = 9f64.next_up() - 9.0;
    let longest = ((spacing / 4.0).ln() / 0.8f64.ln()).ceil() + 1.0;
    let remaining = ratio(9, 1) - reached;
    let expected = (0..=BUDGET).fold(ratio(10, 1), |product, _| product * ratio(4, 5));
    Ok(vec![
        Finding::at_most("landings until the clock stands still, of at most 400", in_floats.unwrap_or(BUDGET) as f64, longest, "1"),
        Finding::at_most("clock short of T∞ (in t₁)", (9.0 - stopped).abs(), rounding(2 * BUDGET, 9.0), "1"),
        Finding::decision("the exact loop has not ended after 400 flights", in_rationals.is_none(), true),
        Finding::decision("the exact clock is still before T∞", remaining > ratio(0, 1), true),
        Finding::exact("(T∞ − t)/(10·(4/5)^401) in t₁", &(remaining / expected), &ratio(1, 1), "1"),
    ])
}

fn threshold(reading: Reading) -> Result<Vec<Finding>> {
    // Units V = g = 1.
    let e = ratio(4, 5);
    let flights = ratio(1, 1) / (ratio(1, 1) - e.clone());
    let mut findings = Vec::new();
    for inverse in [10, 100, 1000] {
        let limit = ratio(1, inverse);
        let mut speed = e.clone();
        let mut skipped_before = ratio(0, 1);
        let stopped_below = reading.pick(limit.clone(), ratio(1, 2));
        while speed >= stopped_below {
            skipped_before += ratio(2, 1) * speed.clone();
            speed *= e.clone();
        }
        let total = ratio(2, 1) * e.clone() / (ratio(1, 1) - e.clone());
        let time = total - skipped_before;
        let bound = ratio(2, 1) * limit.clone() * flights.clone();
        let point = "what is ad hoc and destroys consistency";
        let name = format!("time skipped, v_thr = V/{inverse}");
        findings.push(Finding::at_most(name, Scalar::to_f64(&time), Scalar::to_f64(&bound), "V/g").opinion(point));
        let height = speed.clone() * speed / ratio(2, 1);
        let bound: Rational = limit.clone() * limit / ratio(2, 1);
        let name = format!("height skipped, v_thr = V/{inverse}");
        findings.push(Finding::at_most(name, Scalar::to_f64(&height), Scalar::to_f64(&bound), "V²/g").opinion(point));
    }
    Ok(findings)
}

fn absorbs(reading: Reading) -> Result<Vec<Finding>> {
    let ball = DroppedBall { mass: 1.0, gravity: 9.81, height: 1.0, restitution: 0.8 };
    let scheme = |activation, theta| MoreauJean { theta, activation, restitution: RestitutionRule::NormalOnly };
    let low = DroppedBall { height: 0.1, restitution: 0.5, ..ball };
    let half_step = scheme(Activation::HalfStepForecast, 1.0);
    let rule: &dyn Scheme = reading.only(1).pick(&RULE_C, &half_step);
    let mut findings = vec![sinking(rule, &low, 0.01)?.says(0.0).violating("active wherever the forecast is, whatever the sign of v")];
    for activation in Activation::ALL {
        for theta in [0.5, 1.0] {
            let proved = scheme(activation, theta);
            let unconditional = Altered { base: proved, mistake: Mistake::ApproachingOnly };
            let subject: &dyn Scheme = match reading {
                Reading::Control(0) => &unconditional,
                Reading::Control(2) => &Anitescu,
                _ => &proved,
            };
            let late = activation.forecast() + theta >= 1.5 - ball.restitution / (1.0 + ball.restitution);
            for mut finding in absorption(subject, &proved, &ball, 0.01, 50)? {
                finding.name = format!("{}, {}, θ = {theta}", finding.name, activation.name());
                let settles = finding.name.starts_with("settling time after");
                let finding = if settles { finding.says_at_most(0.0) } else { finding };
                findings.push(if settles && late { finding.violating("λ + θ < 3/2 − e/(1+e)") } else { finding });
            }
        }
    }
    Ok(findings)
}

fn accumulation_time(reading: Reading) -> Result<Vec<Finding>> {
    let (e, shortest) = (0.8, 0.001);
    let ball = BouncingBall::new(9.81, 1.0, e)?;
    let first = ball.first_impact_time();
    let mut flight = reading.pick(2.0, 1.0) * first * e;
    let (mut time, mut landings) = (first, 1usize);
    let mut stuck = None;
    while time + flight > time {
        if flight < shortest && stuck.is_none() {
            stuck = Some((landings, time));
        }
        time += flight;
        flight *= e;
        landings += 1;
    }
    let (count, clock) = stuck.unwrap_or((landings, time));
    let remaining = ball.accumulation_time() - clock;
    Ok(vec![
        Finding::equal(
            "T∞ in closed form less the sum of flights",
            ball.accumulation_time() - time,
            0.0,
            rounding(2 * landings, time),
            "s",
        ),
        Finding::equal("the sum of flights over t₁", time / first, 9.0, rounding(2 * landings, 9.0), "1"),
        Finding::count("landings before flights become shorter than 10⁻³ s", count, 31),
        // between δ e/(1−e) and δ/(1−e)
        Finding::equal("time left then", remaining, 0.5 * shortest * (1.0 + e) / (1.0 - e), 0.5 * shortest, "s"),
    ])
}
