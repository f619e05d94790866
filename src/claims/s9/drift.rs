//! What a step guarantees about velocity and position, and what accumulates.

use crate::claims::experiments::curve::{Side, drift, slide};
use crate::claims::experiments::tower::{Sweeps, Tower};
use crate::claims::prelude::*;
use crate::exact_particle::{Ball, BallState};
use crate::schemes::{Activation, MoreauJean, RestitutionRule, Scheme, StewartTrinkle};
use crate::solvers::{ContactSolver, ProjectedGaussSeidel};
use crate::tolerance::claims::{lcp::circle_residual, pathology as tolerance};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S9.velocity-legal",
        statement: r"The velocity constraint $\nabla\varphi^Tv^+ \ge 0$ only guarantees that the velocity of this step is admissible; the
            position constraint $\varphi \ge 0$ drifts as discretisation errors accumulate.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated of $\nabla\varphi^Tv^+ \ge 0$. Moreau–Jean constrains $v^+ + e\,v$ instead: with $e > 0$ a body
            that is moving away may leave the step with an approach velocity down to $-e\nabla\varphi^Tv$.",
        argument: r"$m = 1$, $\varphi = 0$, a load that takes 13 m/s² for 1/10 s. With $e = 0$, $v^+ = \max(0, v_\text{free}) \ge 0$
            whatever $v$ is, from −2 to 2 m/s. With $e = 1/2$ and $v = 1$ m/s, $v_\text{free} = -3/10$ and $v_\text{free} + e\,v$ is
            positive, so $P = 0$ and $v^+ = -3/10 < 0$. That the position drifts all the same: a bead in a circle of radius 1 m at 1 m/s
            is 4.963e-3 m outside after 1 s with $h = 1/100$ s.",
        controls: &[r"The constraint $v^+ + e\,v \ge 0$ with $e = 1/2$.", "The position level (Stewart–Trinkle) for the bead."],
        sources: &["chapter §9, why stabilisation is needed", "chapter §3, the scheme"],
        check: check!(admissible_velocity),
    },
    Claim {
        id: "S9.velocity-drift",
        statement: "Velocity-level schemes (Moreau–Jean): each step only keeps the velocity from penetrating, but numerical error lets the \
            position leave the constraint slowly – the body gradually sinks into the ground.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"On a flat floor with a converged solver a resting body does not move at all. It drifts along curved
            constraints, by $h\,v^2\kappa/2$ per second, and if the solver is stopped early, by a constant speed proportional to $h$.",
        argument: r"Ball at rest, 1000 steps: displacement exactly 0 for $\theta = 1/2$ and 1. Bead in a circle of radius 1 m at 1 m/s:
            $|q_n|^4$ lies between $1 + 2nh^2$ and $1 + 2nh^2 + nh^4$, so after 1 s with $h = 1/100$ it is 4.963e-3 m outside. Tower of
            five equal bodies, $h = 1/100$, 10 cold sweeps of projected Gauss–Seidel per step: the top sinks 0.059 m in 1 s, as the linear
            recursion $u^+ = G^{10}(u + u_g)$ predicts; converged it moves by no more than the solver leaves.",
        controls: &[
            "The tower with 10 sweeps a step in place of the converged one.",
            "A converged solver in place of 10 sweeps, and the position level (Stewart–Trinkle) for the bead.",
        ],
        sources: &["chapter §9, why stabilisation is needed", "S3.drift for the activation rules"],
        check: check!(velocity_drift),
    },
    Claim {
        id: "S9.ST-residual",
        statement: r"Even Stewart–Trinkle's linearised position constraint $\varphi + h\nabla\varphi^Tv^+ \ge 0$ holds only up to the
            linearisation: a residual penetration of $O(h^2)$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated: a residual of at most $\tfrac12h^2v^2/R$ where $\varphi$ is concave along the motion (inside a
            circle), without accumulation; none where $\varphi$ is convex (outside one) or linear.",
        argument: r"Inside the unit circle $|q| + h\,\hat q\cdot v^+ \le 1$ gives $|q^+| \le \sqrt{1 + h^2v^2}$ whatever happened before:
            the deepest penetration over 100 steps is $\sqrt{1 + h^2} - 1$, that is $\tfrac12h^2$, for $h = 0.02$, 0.01 and 0.005 s. For
            convex $\varphi$: $\varphi(q^+) \ge \varphi(q) + \nabla\varphi^T(q^+ - q) \ge 0$.",
        controls: &["Moreau–Jean, whose penetration accumulates."],
        sources: &["chapter §9, why stabilisation is needed"],
        check: check!(linearisation_residual),
    },
];

fn admissible_velocity(reading: Reading) -> Result<Vec<Finding>> {
    // free velocity v − 13/10
    let step = |restitution: Rational, velocity: Rational| {
        let ball = Ball { mass: ratio(1, 1), gravity: ratio(13, 1), restitution };
        ball.moreau_jean(&BallState { position: ratio(0, 1), velocity }, &ratio(1, 2), Activation::Gap, &ratio(1, 10))
    };
    let constraint = reading.only(0).pick(ratio(0, 1), ratio(1, 2));
    let slowest = (-20..=20).map(|k| step(constraint.clone(), ratio(k, 10)).motion.velocity).fold(ratio(2, 1), Ord::min);
    let leaving = step(ratio(1, 2), ratio(1, 1)).motion.velocity;
    let [expected, width] = drift(0.01, 100);
    let drifted = slide(bead_scheme(reading), Side::Inside, 0.01, 100)?.last;
    Ok(vec![
        Finding::exact("least v⁺ over velocities from −2 to 2 m/s", &slowest, &ratio(0, 1), "m/s"),
        Finding::equal("penetration of a bead in a circle after 1 s, h = 0.01", drifted, expected, width, "m"),
        Finding::exact("v⁺ of Moreau–Jean from v = 1 m/s, e = 1/2", &leaving, &ratio(-3, 10), "m/s").context(),
    ])
}

/// Moreau–Jean with θ = 1 and activation φ ≤ 0.
const MOREAU_JEAN: MoreauJean = MoreauJean { theta: 1.0, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
const STEWART_TRINKLE: StewartTrinkle = StewartTrinkle { directions: 8 };

/// Moreau–Jean, or Stewart–Trinkle for the second control.
fn bead_scheme(reading: Reading) -> &'static dyn Scheme {
    reading.only(1).pick(&MOREAU_JEAN, &STEWART_TRINKLE)
}

fn velocity_drift(reading: Reading) -> Result<Vec<Finding>> {
    const STEPS: usize = 1000;
    let (bodies, h, steps, sweeps) = (5, 0.01, 100, 10);
    let tower = Tower { bodies, gravity: 9.81, stiffness: 0.0 };
    let (converged, truncated) = (ProjectedGaussSeidel::default(), Sweeps::cold(sweeps));
    let solvers: [&dyn ContactSolver; 2] = [&converged, &truncated];
    let [solver, stopped] = [reading.only(0).pick(solvers[0], solvers[1]), reading.only(1).pick(solvers[1], solvers[0])];
    let stands = tower.sinking(&tower.simulate(solver, 0.5, h, steps)?, steps);
    // the solver leaves some 1e-12 m; a ball alone does not move at all
    let mut rests = stands <= tolerance::solved_tower(bodies, h, steps);
    for theta in [ratio(1, 2), ratio(1, 1)] {
        let ball = Ball { mass: ratio(1, 1), gravity: ratio(981, 100), restitution: ratio(1, 2) };
        let start = BallState { position: ratio(0, 1), velocity: ratio(0, 1) };
        let end = (0..STEPS).fold(start, |now, _| ball.moreau_jean(&now, &theta, Activation::Gap, &ratio(1, 100)).motion);
        rests &= end.position == ratio(0, 1);
    }
    let sinks = tower.sinking(&tower.simulate(stopped, 0.5, h, steps)?, steps);
    let mut findings = vec![
        Finding::decision("a ball and a solved tower on a flat floor sink", !rests, false)
            .says(true)
            .violating("a curved constraint, or a solver stopped early"),
        Finding::equal(
            "the same with 10 cold sweeps a step, against a linear recursion",
            sinks,
            tower.predicted_sinking(sweeps, 0.5, h, steps)[0],
            tolerance::tower_rounding(bodies, sweeps, steps),
            "m",
        ),
    ];
    for steps in [100, 200] {
        let h = 1.0 / steps as f64;
        let [expected, width] = drift(h, steps);
        let last = slide(bead_scheme(reading), Side::Inside, h, steps)?.last;
        findings.push(Finding::equal(format!("penetration of a bead in a circle after 1 s, h = {h}"), last, expected, width, "m"));
    }
    Ok(findings)
}

fn linearisation_residual(reading: Reading) -> Result<Vec<Finding>> {
    let schemes: [&dyn Scheme; 2] = [&STEWART_TRINKLE, &MOREAU_JEAN];
    let scheme = reading.pick(schemes[0], schemes[1]);
    let mut findings = Vec::new();
    for h in [0.02, 0.01, 0.005] {
        let inside = slide(scheme, Side::Inside, h, 100)?.deepest;
        let name = format!("deepest penetration inside a circle over h², h = {h}");
        findings.push(Finding::equal(name, inside / (h * h), 0.5, circle_residual(h), "1/m"));
    }
    let outside = slide(&STEWART_TRINKLE, Side::Outside, 0.01, 40)?.deepest;
    findings.push(Finding::at_most("deepest outside a circle, h = 0.01", outside, tolerance::bead_rounding(40), "m").context());
    Ok(findings)
}
