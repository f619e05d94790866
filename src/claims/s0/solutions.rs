//! §0, the exact solution of the bouncing ball and the regularity of velocities and contact measures.

use crate::claims::experiments::cantor::Rise;
use crate::claims::experiments::motion_step::flight;
use crate::claims::prelude::*;
use crate::closed_forms::BouncingBall;
use crate::closed_forms::bouncing_ball::{accumulation_time_ratio, impact_time_ratio};
use crate::defects::energy::RESTITUTION_ON_THE_WRONG_SIDE;
use crate::defects::zeno::{Altered, Mistake};
use crate::exact_particle::BallState;
use crate::mechanics::{PointMass, State};
use crate::schemes::{Activation, MoreauJean, RestitutionRule, Scheme, simulate};
use crate::solvers::Auto;
use crate::tolerance::claims::{PRINTED_TIME, position_slope, variation};
use crate::trajectory::metrics::total_variation;

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S0.height-e2",
        statement: r"For $e < 1$ the bouncing ball's heights shrink by $e^2$ and its flight times by $e$ per bounce.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated.",
        argument: r"A launch at $w$ lands after $2w/g$, at the speed $w$, with apex $w^2/(2g)$ at $w/g$; the next launch is $e\,w$. In
            rationals, for $e = 16/25$: heights 256/625, times 16/25.",
        controls: &[r"A law that keeps the fraction $e$ of the energy instead of the speed: the speed ratio is $\sqrt{e} = 4/5$."],
        sources: &["chapter §0, bouncing ball"],
        check: check!(shrinking),
    },
    Claim {
        id: "S0.tinf",
        statement: r"With $t_0$ the duration of the first flight after the first impact, the flights last $e\,t_0$, $e^2\,t_0$, … and the
            total time $T_\infty$ is finite.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"$T_\infty = t_1 + t_0/(1 - e)$ with $t_0 = 2e\,t_1$, that is $t_1(1 + e)/(1 - e)$; 4.063712768872 s for
            $e = 0.8$, $q_0 = 1$ m, $g = 9.81$.",
        argument: r"$t_k/t_1 = 1 + 2(e + \ldots + e^{k - 1})$; the remainder $T_\infty - t_k = 2\,t_1\,e^k/(1 - e)$ holds exactly for
            $k = 1$ … 60 and falls below every bound. For $e = 4/5$, $T_\infty = 9\,t_1$.",
        controls: &[r"$t_0 = 2\,t_1$, the first flight without its loss: $T_\infty = 11\,t_1$."],
        sources: &["chapter §0, bouncing ball and exercise 1"],
        check: check!(total_time),
    },
    Claim {
        id: "S0.bv-regularity",
        statement: "With contact the velocity is only of bounded variation and the position only Lipschitz.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated; the bouncing ball's velocity has total variation $2\,g\,t_1\,(1 + e)/(1 - e)$ over
            $[0, T_\infty]$, 79.730 m/s for $e = 0.8$ and 1 m, and its position the Lipschitz constant $g\,t_1$.",
        argument: r"Flights contribute $g\,T_\infty$ and impacts $\sum(1 + e)\,g\,t_1\,e^{k - 1}$, both $g\,t_1(1 + e)/(1 - e)$. The
            discrete velocities of Moreau–Jean to $1.5\,T_\infty$ have the same variation up to $O(h \ln 1/h)$, so it is bounded uniformly
            in $h$, and their positions the same slope up to $O(h)$.",
        controls: &[
            r"Activation $\varphi + hv \le 0$ with $v \le 0$, under which the resting ball changes its velocity by $g\,h$ in every step:
                the variation grows by $g$ per second.",
            r"The shift $e\,v^-$ of the impact law four times too large: the ball leaves faster than it comes.",
        ],
        sources: &["chapter §0, table and item (a)"],
        check: check!(bounded_variation),
    },
    Claim {
        id: "S0.measure-split",
        statement: r"The contact measure $dR$ splits into a Lebesgue-continuous part (lasting contact, $\lambda\,dt$) plus atoms (impacts,
            $\sum P_i\,\delta$).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "It splits into a density, atoms and a singular continuous part; the last is absent if the velocity is a \
            special \
                            function of bounded variation (no Cantor part), which is a hypothesis.",
        argument: r"A mass $m$ resting on a floor that rises at the velocity $c(t)$, $c$ the Cantor function: $c$ does not decrease, so
            contact lasts, $v = c$, and $dR = m\,g\,dt + m\,dc$. At level $n$ the whole rise 1 of $c$ lies on $2^n$ intervals of total
            length $(2/3)^n$, with $2^{-n}$ on each: $dc$ has no density (its support has length 0) and no atom (each is below $2^{-n}$),
            yet mass 1. On the same intervals a floor of constant acceleration rises by $(2/3)^n$, and one whose velocity jumps rises in
            one piece.",
        controls: &[
            "The floor whose velocity jumps by 1 once in the place of Cantor's: its rise is one piece, an atom.",
            "Cantor's floor in the place of the uniform one, and the uniform one in the place of the jump.",
        ],
        sources: &["chapter §0, item (b), and §2, base measure dμ = dt + Σδ", "Lebesgue's decomposition of a measure"],
        check: check!(cantor_floor),
    },
];

fn shrinking(reading: Reading) -> Result<Vec<Finding>> {
    let (gravity, e) = (ratio(981, 100), ratio(16, 25));
    let speed_ratio = reading.pick(e.clone(), ratio(4, 5));
    let floor = ratio(0, 1);
    let launched = |velocity: &Rational| BallState { position: floor.clone(), velocity: velocity.clone() };
    let flown = |launch: &Rational, time: &Rational| flight(&launched(launch), &gravity, time);
    // the time after which a launch is back on the floor
    let lands = |launch: &Rational| {
        let time = ratio(2, 1) * launch / &gravity;
        let back = flown(launch, &time).position == floor;
        back.then_some(time).ok_or_else(|| Error::Unsupported("the flight does not end on the floor".into()))
    };
    let mut launch = ratio(7, 2);
    let mut findings = Vec::new();
    for bounce in 1..=3 {
        let next = &speed_ratio * &launch;
        let (time, next_time) = (lands(&launch)?, lands(&next)?);
        let [apex, next_apex] = [(&launch, &time), (&next, &next_time)].map(|(w, s)| flown(w, &(s * ratio(1, 2))).position);
        findings.push(Finding::exact(format!("ratio of heights at bounce {bounce}"), &(next_apex / apex), &(&e * &e), "1"));
        findings.push(Finding::exact(format!("ratio of flight times at bounce {bounce}"), &(&next_time / &time), &e, "1"));
        launch = next;
    }
    Ok(findings)
}

fn total_time(reading: Reading) -> Result<Vec<Finding>> {
    let (e, one) = (ratio(4, 5), ratio(1, 1));
    let first_flight = reading.pick(ratio(2, 1) * &e, ratio(2, 1));
    let total = &one + &first_flight / (&one - &e);
    let mut findings = vec![Finding::exact("T∞/t₁ for e = 4/5", &total, &accumulation_time_ratio(&e), "1")];
    let mut power = one.clone();
    for impact in 1..=60 {
        power *= &e;
        let remainder = &total - impact_time_ratio(&e, impact);
        if impact % 20 == 0 {
            let expected = ratio(2, 1) * &power / (&one - &e);
            findings.push(Finding::exact(format!("(T∞ − t_{impact})/t₁"), &remainder, &expected, "1"));
        }
    }
    let seconds = total.to_f64().value() * BouncingBall::new(9.81, 1.0, 0.8)?.first_impact_time();
    findings.push(Finding::equal("T∞ for q₀ = 1 m, g = 9.81 m/s²", seconds, 4.063712768872, PRINTED_TIME, "s"));
    Ok(findings)
}

fn bounded_variation(reading: Reading) -> Result<Vec<Finding>> {
    let (gravity, height, e) = (9.81, 1.0, 0.8);
    let ball = BouncingBall::new(gravity, height, e)?;
    let base = MoreauJean { theta: 0.5, activation: Activation::FreeVelocityForecast, restitution: RestitutionRule::NormalOnly };
    let sinking = Altered { base, mistake: Mistake::ApproachingOnly };
    let gaining = RESTITUTION_ON_THE_WRONG_SIDE.of(base);
    let subject: &dyn Scheme = match reading {
        Reading::Recorded => &base,
        Reading::Control(0) => &sinking,
        Reading::Control(_) => &gaining,
    };
    let (fall, limit) = (ball.first_impact_time(), ball.velocity_variation(2.0 * ball.accumulation_time()));
    let mut findings = Vec::new();
    for intervals in [256, 1024] {
        let h = fall / (intervals as f64 + 0.5);
        let initial = State { time: 0.0, position: dvector![height], velocity: dvector![0.0] };
        let steps = (1.5 * ball.accumulation_time() / h) as usize;
        let recording = simulate(subject, &Auto, &PointMass::ball_on_floor(1.0, gravity, e), initial, h, steps)?;
        let velocities: Vec<f64> = recording.samples.iter().map(|sample| sample.velocity[0]).collect();
        let slopes = recording.samples.windows(2).map(|pair| (pair[1].position[0] - pair[0].position[0]).abs() / h);
        let title = format!("total variation of v_h at h = {h:.2e}");
        findings.push(Finding::equal(title, total_variation(&velocities), limit, variation(gravity, e, fall, h), "m/s"));
        let steepest = slopes.fold(0.0, f64::max);
        let bound = position_slope(gravity, fall, h);
        findings.push(Finding::at_most(format!("steepest position at h = {h:.2e}"), steepest, bound, "m/s"));
    }
    Ok(findings)
}

/// What is compared of a velocity on Cantor's set.
const RISE: &str = "rise on the intervals of level 10 without the largest piece, less half of that of level 5";

fn cantor_floor(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    let floors = reading.only(1).pick([Rise::Uniform, Rise::Jump], [Rise::Cantor, Rise::Uniform]);
    for (name, velocity) in ["uniform", "a jump"].into_iter().zip(floors) {
        let ([early, _], [late, largest]) = (velocity.on_cantors_set(5), velocity.on_cantors_set(10));
        let uniform = |level: u32| cantor_length(level) - ratio(1, 3i64.pow(level));
        let expected = if name == "uniform" { uniform(10) - uniform(5) / ratio(2, 1) } else { ratio(0, 1) };
        // a density leaves what the length leaves, (2/3)⁵ of level 5; less than half
        let more = late - early / ratio(2, 1);
        findings.push(Finding::exact(format!("{RISE}, {name}"), &more, &expected, "m/s").says_at_most(ratio(0, 1)));
        let atom = if name == "uniform" { ratio(1, 3i64.pow(10)) } else { ratio(1, 1) };
        findings.push(Finding::exact(format!("largest piece, {name}"), &largest, &atom, "m/s"));
    }
    let subject = reading.only(0).pick(Rise::Cantor, Rise::Jump);
    let ([early, _], [late, largest]) = (subject.on_cantors_set(5), subject.on_cantors_set(10));
    let smallest = ratio(1, 2i64.pow(10));
    let expected = ratio(1, 2) - &smallest + ratio(1, 2i64.pow(6));
    findings.push(
        Finding::exact(format!("{RISE}, Cantor"), &(late - early / ratio(2, 1)), &expected, "m/s")
            .says_at_most(ratio(0, 1))
            .violating("the velocity has no Cantor part"),
    );
    findings.push(Finding::exact("largest piece, Cantor", &largest, &smallest, "m/s").context());
    Ok(findings)
}

/// Total length (2/3)ⁿ of the 2ⁿ intervals of level n of Cantor's set.
fn cantor_length(level: u32) -> Rational {
    ratio(2i64.pow(level), 3i64.pow(level))
}
