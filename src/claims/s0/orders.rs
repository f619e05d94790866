//! §0, orders of convergence on solutions of bounded variation.

use crate::checks::convergence::{Horizon, Stop, bouncing_ball, plastic_ball, study};
use crate::claims::experiments::corner::{floor_before_wall, leaning, upright};
use crate::claims::experiments::envelopes::in_short;
use crate::claims::experiments::runge_kutta::{Impacts, Norm, errors_over_those_of_first_order, order, step};
use crate::claims::prelude::*;
use crate::closed_forms::BouncingBall;
use crate::defects::convergence::{Altered, Mistake};
use crate::defects::schemes::RESTITUTION_FORGOTTEN;
use crate::schemes::{Activation, MoreauJean, RestitutionRule, Scheme, StewartTrinkle};
use crate::tolerance::claims::ORDER_GAP;
use crate::trajectory::estimate_order;

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S0.all-Oh",
        statement: r"At an impact the solution is of bounded variation, so all integrators degrade to at most $O(h)$; high-order methods
            have no advantage there, they are even worse because their stages straddle the jump.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: r"True of integrators that step over the impact: they degrade to $O(h)$, and at equal work the high order is a
            loss. One that locates the impact keeps its order up to any time before the accumulation point: RK4 with root finding is of
            order 4 through impacts. (The chapter treats event detection before, and its §1 calls event-driven methods the more accurate
            ones for a single impact.) M.high-order says the same.",
        argument: r"A ball on a spring, $\ddot q = -g - 4q$, $e = 0.8$, closed form by arcs of cosines, over three impacts. RK4 with the
            impact bisected to neighbouring floats: the error of $q$ at the end falls like $h^4$. Between impacts the method is of order
            4; at a transversal impact the located time and state depend smoothly on the data, so each impact only multiplies the error by
            a constant. The same RK4 with the velocity flipped at the end of the step is of order 1. Its error is then 0.97 of that of the
            semi-implicit Euler rule with the same step, and more than three times that of the Euler rule with a quarter of it, which
            costs the same.",
        controls: &[
            "RK4 with the velocity flipped after penetration and the one that locates impacts, exchanged, and equal work and equal steps.",
        ],
        sources: &["chapter §0, the trap of judging contact integrators by their order"],
        check: check!(located),
    },
    Claim {
        id: "S0.order-meaningless",
        statement: "On solutions of bounded variation the notion of an order of accuracy loses its meaning.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Measured,
        correct_statement: r"Only the maximum norm of the velocity has no positive order. $\sup|q|$, $\int|v|$ and the distance of
            filled-in graphs have order 1 through isolated impacts, the last only order ½ where a plastic ball is stopped above the floor
            (S0.orders). (The same section itself calls the error $O(h)$.)",
        argument: r"Moreau–Jean, activation $\varphi \le 0$, $\theta = \tfrac12$, $e = 0.8$, 1 m drop to the apex after the impact. To
            leading order the errors are $\sup|q| = V(1 + e)(s + \tfrac12h)$, $s$ the lag of the step that bounces behind the impact, and
            likewise in $\int|v|$ and in the graphs: constants times $h$ once $s/h$ is fixed. $\sup|v| = (1 + e)V - O(h)$ for every $h$:
            on the lag the velocities lie on different sides of the jump.",
        controls: &[
            "The same scheme with the restitution left out: its motion does not tend to the exact one, and no norm has a positive \
            order.",
            r"$\theta = 1$ in a run that ends before the impact, where $\sup|v|$ has order 1 as well.",
        ],
        sources: &["chapter §0, on solutions of bounded variation", "Moreau's filled-in graphs"],
        check: check!(weaker_norms),
    },
    Claim {
        id: "S0.orders",
        statement: "(§0: time-stepping detects no events; §1, table, accuracy at impacts:) it is robust, it converges weakly* to the \
            solution of the measure differential inclusion.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Where contacts are reached one after the other, or meet at right angles (S1.weakstar says the same). Through
            isolated impacts $\sup|q|$ and $\int|v|$ are $O(h)$ for Moreau–Jean with the activation rules A, B, D (A: $\varphi \le 0$, B:
            $\varphi + \tfrac12hu \le 0$, D: $\varphi + h\,u_\text{free} \le 0$) and, for $e = 0$, for Stewart–Trinkle and Anitescu; the
            graph distance is $O(h)$, $O(h \ln 1/h)$ through a Zeno sequence, and $O(\sqrt{h})$ for $e = 0$ where the rule may stop the
            ball above the floor (D, and B with $\theta = 1$), because it falls once more from a height $O(h)$.",
        argument: r"Each impact shifts the discrete flight by $(1 + e)/e\cdot p$ in time and changes its speed by $O(gh)$, with $p$
            between $(1 - \lambda - \theta)h$ and $(2 - \lambda - \theta)h$; sums over impacts give constants for every metric, and the
            envelopes lie between them. A plastic ball stopped at height $V|p|$ reaches the speed $\sqrt{2gV|p|}$: graphs
            $\sqrt{2|p|h/t_1}$ apart. A mass that meets two walls at once where they lean towards each other slides up one of them if the
            step sees the other first (T.moreau-convergence).",
        controls: &[
            "Walls at right angles in the corner.",
            "Stewart–Trinkle with a trapezoidal position update, which throws the plastic ball out at every step size.",
            r"Contacts that are active at $\varphi \le 1$ cm in the place of Moreau–Jean's rule.",
        ],
        sources: &["chapter §0, Zeno phenomenon and the trap of judging by the order; §1, table; §4"],
        check: check!(time_stepping),
    },
    Claim {
        id: "S0.soft-smooth",
        statement: r"(Thought experiment.) Suppose contact forces were always finite smooth functions, every contact a stiff spring
            $\lambda = -k\varphi$.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: r"$\lambda = -k\varphi$ is smooth but also pulls. The force of a contact that only pushes,
            $\max(0, -k\varphi)$, is Lipschitz with a kink at $\varphi = 0$: RK4 across the moment of contact is of order 2, not 4.",
        argument: r"Ball of 1 kg, $k = 10000$ N/m, dropped from 1 m, error of $q$ at 0.008 s after touching, against the parabola followed
            by the oscillation. $\lambda$ grows like $kV(t - t^*)$ after touching, and a rule of any order integrates a kink inside a step
            with error $O(kV\,h^2)$ in $v$. The same spring acting on both sides: order 4.",
        controls: &["The smooth force takes the place of the one-sided one.", "The one-sided force takes the place of the smooth one."],
        sources: &["chapter §0, exercise 3"],
        check: check!(soft_contact),
    },
];

fn located(reading: Reading) -> Result<Vec<Finding>> {
    let (located, flipped) = reading.pick((Impacts::Located, Impacts::Flipped), (Impacts::Flipped, Impacts::Located));
    let (judged, blind) = (order(located, Norm::EndPosition, 3)?, order(flipped, Norm::EndPosition, 1)?);
    let mut findings = vec![
        Finding::equal("order of RK4 in q through three impacts, impacts located", judged.slope, 4.0, ORDER_GAP, "1")
            .experiment()
            .says_at_most(1.0)
            .violating("the impact is stepped over"),
        Finding::equal("order of RK4 in q through one impact, flipped after penetration", blind.slope, 1.0, ORDER_GAP, "1")
            .experiment()
            .says_at_most(1.0),
    ];
    let compare = |finer: usize| errors_over_those_of_first_order(finer).map(|ratios| ratios[0]);
    let (steps, work) = reading.pick((1, 4), (4, 1));
    let name = |what: &str| format!("error of q after one flip, RK4 over semi-implicit Euler, equal {what}");
    findings.push(
        Finding::at_most(name("steps"), compare(steps)?, 1.0, "1")
            .experiment()
            .says_at_least(1.0)
            .violating("methods are compared at equal work"),
    );
    findings.push(Finding::at_least(name("work"), compare(work)?, 1.0, "1").experiment());
    Ok(findings)
}

fn weaker_norms(reading: Reading) -> Result<Vec<Finding>> {
    // θ = 1/2 is exact in free fall, where the error would be rounding
    let theta = reading.only(1).pick(0.5, 1.0);
    let scheme = MoreauJean { theta, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
    let forgetful = RESTITUTION_FORGOTTEN.subject.of(scheme);
    let subject: &dyn Scheme = reading.only(0).pick(&scheme, &forgetful);
    let found = study(subject, 0.8, reading.only(1).pick(1.8, 0.9), &[32, 128, 512], 4)?;
    let order = |name: &str, slope: f64, expected: f64| {
        Finding::equal(format!("order in {name}"), slope, expected, ORDER_GAP, "1").experiment().says_at_most(0.0)
    };
    Ok(vec![
        order("the distance of filled-in graphs", found.graph.slope, 1.0),
        order("sup|q|", found.position.slope, 1.0),
        order("∫|v|", found.velocity_l1.slope, 1.0),
        order("sup|v|", found.velocity_sup.slope, 0.0),
    ])
}

fn time_stepping(reading: Reading) -> Result<Vec<Finding>> {
    let (reference, wrong) = (StewartTrinkle::default(), Altered(Mistake::TrapezoidalPosition));
    let on_the_floor: &dyn Scheme = reading.only(1).pick(&reference, &wrong);
    let proved = MoreauJean { theta: 1.0, activation: Activation::FreeVelocityForecast, restitution: RestitutionRule::NormalOnly };
    let early = Altered(Mistake::FixedMargin);
    let above: &dyn Scheme = reading.only(2).pick(&proved, &early);
    let mut findings = vec![floor_before_wall(&reading.only(0).pick(leaning(), upright()))?];
    findings.extend(in_short("Stewart–Trinkle, e = 0", plastic_ball(on_the_floor, Stop::On)?));
    findings.extend(in_short("Moreau–Jean, e = 0", plastic_ball(above, Stop::Above { theta: 1.0, forecast: 1.0 })?));
    findings.extend(in_short("Moreau–Jean, e = 0.8", bouncing_ball(above, &proved, 0.8, Horizon::OneImpact)?));
    Ok(findings)
}

/// Order of RK4 in q at 8 ms after touching a spring of 10⁴ N/m per kg, which pulls (two-sided) or only pushes.
fn spring_order(two_sided: bool) -> Result<f64> {
    let (gravity, stiffness, height) = (9.81, 10_000.0f64, 1.0);
    let ball = BouncingBall::new(gravity, height, 0.0)?;
    let (touch, speed) = (ball.first_impact_time(), ball.impact_speed(1));
    let end = touch + 0.008;
    let frequency = stiffness.sqrt();
    let centre = -gravity / stiffness;
    // q − centre = A cos ωs + B sin ωs from the start (two-sided) or from the touch.
    let exact = if two_sided {
        centre + (height - centre) * (frequency * end).cos()
    } else {
        let angle = frequency * (end - touch);
        centre - centre * angle.cos() - speed / frequency * angle.sin()
    };
    let acceleration = |q: f64| if two_sided || q < 0.0 { -gravity - stiffness * q } else { -gravity };
    let estimate = estimate_order(touch, &[512, 1024, 2048, 4096], 4, |h| {
        let (mut state, mut time) = ([height, 0.0], 0.0);
        while time + h < end {
            state = step(&acceleration, state, h);
            time += h;
        }
        Ok((step(&acceleration, state, end - time)[0] - exact).abs())
    })?;
    Ok(estimate.slope)
}

fn soft_contact(reading: Reading) -> Result<Vec<Finding>> {
    let pushing = spring_order(reading.only(0).pick(false, true))?;
    let pulling = spring_order(reading.only(1).pick(true, false))?;
    Ok(vec![
        Finding::equal("order of RK4 with the force max(0, −kφ)", pushing, 2.0, ORDER_GAP, "1")
            .experiment()
            .says(4.0)
            .reading("a contact that only pushes"),
        Finding::equal("order of RK4 with the force −kφ", pulling, 4.0, ORDER_GAP, "1").experiment().reading("a spring that pulls as well"),
    ])
}
