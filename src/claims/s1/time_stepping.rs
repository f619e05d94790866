//! Time-stepping: what its limit is, how it takes an impact, and its order between impacts.

use crate::checks::convergence::study;
use crate::claims::experiments::corner::{floor_before_wall, leaning, upright};
use crate::claims::experiments::painleve::answers;
use crate::claims::experiments::wall::{Stepping, approach, mass_apart, weakly};
use crate::claims::prelude::*;
use crate::defects::convergence::{Altered, Mistake};
use crate::exact_particle::{Ball, BallState};
use crate::mechanics::{OscillatorWithStop, State};
use crate::schemes::{Activation, MoreauJean, RestitutionRule, RungeKuttaFlip, Scheme, StewartTrinkle, simulate};
use crate::solvers::Auto;
use crate::tolerance::claims::ORDER_GAP;
use crate::trajectory::{Refinement, fit_order};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S1.ts-unique",
        statement: "In Zeno and Painlevé situations, where event-driven methods are undefined, time-stepping gives the unique correct \
            limit.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"A limit of a subsequence. For the ball that falls under gravity the limit is unique; where two sliding forces
            exist a step itself has three answers at every $h$, which tend to two different motions, and the solver's pivoting decides
            between them. The chapter's §4 says so: existence is not uniqueness.",
        argument: r"Rod with $\mu = 3/2 > \mu_P$, upward normal free acceleration $b = 5$ m/s²: $P_n = 0$, $125h/2$ or $9/25 - 73h/20$ for
            $h = 10^{-3}$ … $10^{-6}$, exactly three answers. The first two vanish with $h$, the third tends to the impact $P_n = 9/25$,
            so the answers do not come together.",
        controls: &[r"$\mu = 1 < \mu_P$: one answer."],
        sources: &["chapter §1, history; the pitfall in the same section; §4, existence and uniqueness"],
        check: check!(several_limits),
    },
    Claim {
        id: "S1.stewart98",
        statement: r"Stewart (1998) proves that the limit $h \to 0$ of time-stepping is a solution of the measure differential inclusion
            (§4, abridged: a subsequence converges weakly*, if $M \succ 0$ is Lipschitz, $F$ continuous and $\mu$ bounded).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Citation,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: r"As stated of plastic impacts ($e = 0$), and under conditions on the friction cone that the chapter does not
            name. The paper was not read; what it concludes is checked on one motion, and why a subsequence is needed is shown.",
        argument: r"Stewart–Trinkle on a plastic ball: $\sup|q|$, $\int|v|$ and the graphs converge with order 1 (S0.orders has the
            constants). A ball with $e = 0.8$ it stops as well, whatever $h$: $\sup|q|$ has order 0. On Painlevé's rod with two sliding
            forces, $\mu = 3/2$, the step has the answers $P_n = 0$ and $9/25 - 73h/20$, each with its limit: one kind of answer is a
            subsequence that converges, the two in turn are not.",
        controls: &[
            r"Moreau–Jean in the place of Stewart–Trinkle on the ball with $e = 0.8$.",
            "A trapezoidal position update, which throws the plastic ball out at every step size.",
            "The smallest and the largest answer on the rod in turn: the whole sequence.",
        ],
        sources: &[
            "chapter §1, pitfalls; §4",
            "Stewart, Convergence of a time-stepping scheme for rigid-body dynamics and resolution of Painlevé's problem (1998), not read",
        ],
        check: check!(convergence),
    },
    Claim {
        id: "S1.weakstar",
        statement: "At impacts time-stepping is accurate in a robust sense: it converges weakly* to the solution of the measure \
            differential inclusion (§4: for a subsequence).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"For subsequences, and where contacts are reached one after the other or meet at right angles. Otherwise the
            limit need not solve the inclusion (T.moreau-convergence). Weakly* is said of the impulses; velocities converge in the mean
            and, away from the impacts, pointwise. Neither converges in a stronger sense: not the mass of the difference, not the largest
            error of $v$.",
        argument: r"Moreau–Jean, $e = \tfrac12$, on a wall hit at ⅓ s, $h = 2^{-4}$ … $2^{-8}$ in rationals:
            $\int g\,dP_h \to (3/2)\,g(\tfrac13)$ for three functions with errors $\le 6h$; the mass of $P_h - (3/2)\,\delta_{\tfrac13}$
            is 3 and $v_h(\tfrac13 + h/3) = -1$, not ½, at every $h$. A plastic mass that reaches the corner of $y \ge 0$ and
            $4x + 3y \ge 0$ is stopped by the inclusion; with steps that see the floor before the wall it climbs the wall, however small
            $h$: no subsequence of those tends to the solution.",
        controls: &[
            "Walls at right angles in the corner.",
            "Stewart–Trinkle's plastic impulses on the wall, which tend to another measure.",
        ],
        sources: &["chapter §1, table"],
        check: check!(robust),
    },
    Claim {
        id: "S1.implicit-impact",
        statement: "Not detecting events does not mean ignoring impacts: the impact is the atom in the impulse of a step's complementarity \
            problem, with no event detection.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated. $P = m(1 + e)|v| + m\,g\,h$ in the step of the impact, $m\,g\,h$ in a step at rest, 0 in flight:
            the first stays as $h \to 0$, the second is the weight times $h$.",
        argument: r"Moreau–Jean on a ball of 3/2 kg, $e = 1/2$, $v = -2$ m/s at the floor, $h = 10^{-1}$ … $10^{-4}$ in rationals:
            $P - m\,g\,h = 9/2$ N·s at every $h$.",
        controls: &[
            "A ball that touches the floor at rest.",
            "A ball thrown up in the place of the one at rest, and one at the floor in the place of the one in flight.",
        ],
        sources: &["chapter §1, pitfalls"],
        check: check!(atom),
    },
    Claim {
        id: "S1.order12",
        statement: r"Between impacts time-stepping is of order 1 to 2 ($\theta$ method, semi-implicit Euler).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Measured,
        correct_statement: r"As stated: order 2 for $\theta = \tfrac12$ and linear forces, 1 for other $\theta$ and for Stewart–Trinkle.",
        argument: r"$\ddot q = -4q$, stop out of reach, error of $q$ at 2 s for $h = 2^{-6}$ … $2^{-9}$ s.",
        controls: &["The classical Runge–Kutta method in the place of each."],
        sources: &["chapter §1, table"],
        check: check!(order),
    },
];

fn several_limits(reading: Reading) -> Result<Vec<Finding>> {
    let friction = reading.pick(ratio(3, 2), ratio(1, 1));
    let mut findings = Vec::new();
    for exponent in [3, 4, 5, 6] {
        let h = ratio(1, 10i64.pow(exponent));
        let found = answers(&friction, &(ratio(5, 1) * &h))?;
        findings.push(Finding::count(format!("different answers of the step at h = 1e-{exponent} s"), found.len(), 3).says(1usize));
        let (last, middle) = (&found[found.len() - 1], &found[found.len() / 2]);
        let apart = last - &found[0];
        let expected = ratio(9, 25) - ratio(73, 20) * &h;
        findings.push(
            Finding::exact(format!("largest P_n less the smallest, h = 1e-{exponent} s"), &apart, &expected, "N·s").says(ratio(0, 1)),
        );
        if exponent == 6 {
            findings.push(Finding::exact("the P_n between them, h = 1e-6 s", middle, &(ratio(125, 2) * &h), "N·s").context());
        }
    }
    Ok(findings)
}

/// Steps to the first impact.
const LEVELS: &[usize] = &[32, 128, 512];

fn convergence(reading: Reading) -> Result<Vec<Finding>> {
    let (plastic, thrown) = (StewartTrinkle::default(), Altered(Mistake::TrapezoidalPosition));
    let subject: &dyn Scheme = reading.only(1).pick(&plastic, &thrown);
    let found = study(subject, 0.0, 2.0, LEVELS, 4)?;
    let metrics = [("sup|q|", found.position.slope), ("∫|v|", found.velocity_l1.slope), ("graph distance", found.graph.slope)];
    let mut findings: Vec<Finding> =
        metrics.map(|(metric, slope)| Finding::equal(format!("e = 0, {metric}: order"), slope, 1.0, ORDER_GAP, "1").experiment()).into();
    let bouncing = MoreauJean { theta: 0.5, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
    let subject: &dyn Scheme = reading.only(0).pick(&plastic, &bouncing);
    let slope = study(subject, 0.8, 1.8, LEVELS, 4)?.position.slope;
    findings.push(
        Finding::equal("e = 0.8, sup|q|: order", slope, 0.0, ORDER_GAP, "1").experiment().says(1.0).violating("impacts are plastic, e = 0"),
    );
    findings.push(answers_of_one_kind(reading.only(2))?);
    Ok(findings)
}

/// How far the answers at h = 10⁻⁵ and 10⁻⁶ are apart on Painlevé's rod: the smallest both times, or the smallest and then the largest.
fn answers_of_one_kind(reading: Reading) -> Result<Finding> {
    let at = |exponent: u32| answers(&ratio(3, 2), &ratio(5, 10i64.pow(exponent)));
    let (first, second) = (at(5)?, at(6)?);
    let next = &second[reading.pick(0, second.len() - 1)];
    // of a sequence that converges like its answers do, 73h/20 each
    let together = ratio(73, 20) * (ratio(1, 100_000) + ratio(1, 1_000_000));
    let name = "P_n of an answer at h = 1e-6 s less that at h = 1e-5 s, along a subsequence";
    Ok(Finding::exact(name, &(next - &first[0]), &ratio(0, 1), "N·s").says_at_most(together))
}

fn robust(reading: Reading) -> Result<Vec<Finding>> {
    let mass = ratio(3, 2);
    let stepping = reading.only(1).pick(Stepping::MoreauJean, Stepping::StewartTrinkle);
    let errors =
        (4..=8u32).flat_map(|k| weakly(&approach(stepping, k), &mass, "").into_iter().map(move |of| of.measured * 2f64.powi(k as i32)));
    let name = "largest |∫g dP_h − (3/2) g(1/3)|/h of three functions g, h = 2^-4 … 2^-8";
    // 4 m (1+e)|v|
    let mut findings = vec![Finding::at_most(name, errors.fold(0.0, f64::max), 6.0, "N")];
    findings.push(floor_before_wall(&reading.only(0).pick(leaning(), upright()))?);
    let motion = approach(stepping, 8);
    findings.push(Finding::exact("mass of P_h − (3/2) δ, h = 2^-8", &mass_apart(&motion, &mass), &ratio(3, 1), "N·s").context());
    let late = motion.velocity_at(&(ratio(1, 3) + &motion.step * ratio(1, 3)));
    findings.push(Finding::exact("v_h(1/3 + h/3), h = 2^-8", &late, &ratio(-1, 1), "m/s").context());
    Ok(findings)
}

fn atom(reading: Reading) -> Result<Vec<Finding>> {
    let ball = Ball { mass: ratio(3, 2), gravity: ratio(981, 100), restitution: ratio(1, 2) };
    let half = ratio(1, 2);
    let mut findings = Vec::new();
    for exponent in 1..=4u32 {
        let h = ratio(1, 10i64.pow(exponent));
        let weight = &ball.mass * &ball.gravity * &h;
        let step = |position: Rational, velocity: Rational| {
            ball.moreau_jean(&BallState { position, velocity }, &half, Activation::Gap, &h).impulse
        };
        let arriving = reading.only(0).pick(ratio(-2, 1), ratio(0, 1));
        let (resting, flying) = reading.only(1).pick((ratio(0, 1), ratio(1, 1)), (ratio(1, 1), ratio(0, 1)));
        let impact = step(ratio(0, 1), arriving) - &weight;
        findings.push(Finding::exact(format!("P − m g h of the impact, h = 1e-{exponent} s"), &impact, &ratio(9, 2), "N·s"));
        findings.push(Finding::exact(format!("P at rest, h = 1e-{exponent} s"), &step(ratio(0, 1), resting), &weight, "N·s"));
        findings.push(Finding::exact(format!("P in flight, h = 1e-{exponent} s"), &step(flying, ratio(-2, 1)), &ratio(0, 1), "N·s"));
    }
    Ok(findings)
}

/// Order of a scheme in q at 2 s on q̈ = −4q.
fn smooth_order(scheme: &dyn Scheme) -> Result<f64> {
    let spring = OscillatorWithStop::new(1.0, 4.0, 0.0, -100.0, 0.0)?;
    let level = |exponent: i32| -> Result<Refinement> {
        let steps = 1usize << (exponent + 1);
        let time_step = 2.0 / steps as f64;
        let start = State { time: 0.0, position: dvector![1.0], velocity: dvector![0.0] };
        let end = simulate(scheme, &Auto, &spring, start, time_step, steps)?.last().position[0];
        Ok(Refinement { time_step, error: (end - 4f64.cos()).abs() })
    };
    Ok(fit_order((6..=9).map(level).collect::<Result<_>>()?)?.slope)
}

fn order(reading: Reading) -> Result<Vec<Finding>> {
    let theta = |theta| MoreauJean { theta, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
    let (midpoint, implicit, fourth) = (theta(0.5), theta(1.0), RungeKuttaFlip);
    let cases: [(&str, &dyn Scheme, f64); 3] = [
        ("Moreau–Jean, θ = ½", &midpoint, 2.0),
        ("Moreau–Jean, θ = 1", &implicit, 1.0),
        ("Stewart–Trinkle", &StewartTrinkle::default(), 1.0),
    ];
    let finding = |(name, scheme, expected): (&str, &dyn Scheme, f64)| -> Result<Finding> {
        let subject: &dyn Scheme = reading.pick(scheme, &fourth);
        Ok(Finding::equal(format!("order of {name}"), smooth_order(subject)?, expected, ORDER_GAP, "1").experiment())
    };
    cases.into_iter().map(finding).collect()
}
