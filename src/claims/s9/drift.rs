//! What a step guarantees about velocity and position, and what accumulates.

use crate::claims::experiments::curve::{Side, drift, slide};
use crate::claims::experiments::tower::{Sweeps, Tower};
use crate::claims::prelude::*;
use crate::exact_particle::{Ball, BallState};
use crate::schemes::{Activation, MoreauJean, RestitutionRule, StewartTrinkle};
use crate::solvers::{ContactSolver, ProjectedGaussSeidel};
use crate::tolerance::claims::{lcp::circle_residual, pathology as tolerance};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S9.velocity-legal",
        statement: "The velocity constraint ∇φᵀv⁺ ≥ 0 only guarantees that the velocity of this step is admissible; the position \
            constraint drifts.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "Moreau–Jean constrains v⁺ + e v, so its new velocity is admissible, ∇φᵀv⁺ ≥ 0, if e = 0; with e > 0 a body \
            that is moving away may \
                            leave the step with an approach velocity down to −e∇φᵀv.",
        argument: "m = 1, φ = 0, v = 1 m/s, a load that takes 13/10 m/s in the step: v_free = −3/10. With e = 1/2 the law velocity v_free \
            + e v = 1/5 is \
                   positive, so P = 0 and v⁺ = −3/10 < 0. With e = 0, v⁺ = max(0, v_free) ≥ 0 whatever v is: checked for 41 velocities \
                   from −2 to 2 m/s. That the position drifts all the same: the bead of S9.velocity-drift.",
        controls: &["e = 0 in place of e = 1/2."],
        sources: &["chapter §9, why stabilisation is needed", "chapter §3, the scheme"],
        check: admissible_velocity,
    },
    Claim {
        id: "S9.velocity-drift",
        statement: "Velocity-level schemes (Moreau–Jean): each step only keeps the velocity from penetrating, but numerical error lets the \
            position leave the \
                    constraint slowly – the body gradually sinks into the ground.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "On a flat floor with a converged solver a resting body does not move at all. It drifts along curved \
            constraints, by h v²κ/2 per second, and if the \
                            solver is stopped early, by a constant speed proportional to h.",
        argument: "Ball at rest, 1000 steps: displacement exactly 0 for θ = 1/2 and 1. Bead in a circle of radius 1 m at 1 m/s: |q_n|⁴ \
            lies between 1 + 2nh² and 1 + 2nh² + nh⁴, so \
                   after 1 s with h = 1/100 it is 4.963e-3 m outside (√(1 + hT) − 1 = 4.988e-3 would neglect that the speed falls as \
                   1/|q|). Tower of five equal bodies, h = 1/100, 10 cold sweeps \
                   of projected Gauss–Seidel per step: the top sinks 5.9 cm in 1 s, as the linear recursion u⁺ = G¹⁰(u + u_g) predicts; \
                   converged: 1e-12 m, what the solver leaves.",
        controls: &["The tower with 10 sweeps a step in place of the converged one."],
        sources: &["chapter §9, why stabilisation is needed", "S3.drift for the activation rules"],
        check: velocity_drift,
    },
    Claim {
        id: "S9.ST-residual",
        statement: "Even Stewart–Trinkle's linearised position constraint φ + h∇φᵀv⁺ ≥ 0 holds only up to the linearisation: a residual \
            penetration of O(h²).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "A residual of at most ½h²v²/R where φ is concave along the motion (inside a circle), without accumulation; \
            none where φ is convex (outside one) or linear.",
        argument: "Inside the unit circle |q| + h q̂·v⁺ ≤ 1 gives |q⁺| ≤ √(1 + h²v²) whatever happened before: the deepest penetration \
            over 100 steps is √(1 + h²) − 1 = 1.9998e-4, \
                   5.0000e-5, 1.2500e-5 m for h = 1/50, 1/100, 1/200. For convex φ: φ(q⁺) ≥ φ(q) + ∇φᵀ(q⁺ − q) ≥ 0.",
        controls: &["The inside of the circle in place of its outside."],
        sources: &["chapter §9, why stabilisation is needed"],
        check: linearisation_residual,
    },
];

fn admissible_velocity(reading: Reading) -> Result<Vec<Finding>> {
    // free velocity v − 13/10
    let step = |restitution: Rational, velocity: Rational| {
        let ball = Ball { mass: ratio(1, 1), gravity: ratio(13, 1), restitution };
        ball.moreau_jean(&BallState { position: ratio(0, 1), velocity }, &ratio(1, 2), Activation::Gap, &ratio(1, 10))
    };
    let slowest = |restitution: Rational| {
        (-20..=20)
            .map(|k| step(restitution.clone(), ratio(k, 10)).motion.velocity)
            .fold(ratio(2, 1), |least, v| if v < least { v } else { least })
    };
    let leaving = step(reading.pick(ratio(1, 2), ratio(0, 1)), ratio(1, 1));
    let [expected, width] = drift(0.01, 100);
    let drifted = slide(&moreau_jean(), Side::Inside, 0.01, 100)?.last;
    Ok(vec![
        Finding::exact("least v⁺ over 41 velocities, e = 0", &slowest(ratio(0, 1)), &ratio(0, 1), "m/s"),
        Finding::exact("v⁺ from v = 1 m/s, e = 1/2", &leaving.motion.velocity, &ratio(-3, 10), "m/s")
            .says_at_least(ratio(0, 1))
            .violating("e = 0"),
        Finding::equal("penetration of a bead in a circle after 1 s, h = 0.01", drifted, expected, width, "m"),
    ])
}

/// Moreau–Jean with θ = 1 and activation φ ≤ 0.
fn moreau_jean() -> MoreauJean {
    MoreauJean { theta: 1.0, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly }
}

fn velocity_drift(reading: Reading) -> Result<Vec<Finding>> {
    let (bodies, h, steps, sweeps) = (5, 0.01, 100, 10);
    let tower = Tower { bodies, gravity: 9.81 };
    let (converged, truncated) = (ProjectedGaussSeidel::default(), Sweeps::cold(sweeps));
    let solver: &dyn ContactSolver = reading.pick(&converged, &truncated);
    let stands = tower.sinking(&tower.simulate(solver, 0.5, h, steps)?, steps);
    // the solver leaves some 1e-12 m; a ball alone does not move at all
    let mut rests = stands <= tolerance::solved_tower(bodies, h, steps);
    for theta in [ratio(1, 2), ratio(1, 1)] {
        let ball = Ball { mass: ratio(1, 1), gravity: ratio(981, 100), restitution: ratio(1, 2) };
        let start = BallState { position: ratio(0, 1), velocity: ratio(0, 1) };
        let end = (0..1000).fold(start, |now, _| ball.moreau_jean(&now, &theta, Activation::Gap, &ratio(1, 100)).motion);
        rests &= end.position == ratio(0, 1);
    }
    let sinks = tower.sinking(&tower.simulate(&truncated, 0.5, h, steps)?, steps);
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
        let last = slide(&moreau_jean(), Side::Inside, h, steps)?.last;
        findings.push(Finding::equal(format!("penetration of a bead in a circle after 1 s, h = {h}"), last, expected, width, "m"));
    }
    Ok(findings)
}

fn linearisation_residual(reading: Reading) -> Result<Vec<Finding>> {
    let scheme = StewartTrinkle::default();
    let convex = reading.pick(Side::Outside, Side::Inside);
    let mut findings = Vec::new();
    for steps in [100, 50, 200] {
        let h = 1.0 / f64::from(steps);
        let inside = slide(&scheme, Side::Inside, h, 100)?.deepest;
        findings.push(Finding::equal(
            format!("deepest penetration inside a circle over h², h = {h}"),
            inside / (h * h),
            0.5,
            circle_residual(h),
            "1/m",
        ));
        let outside = slide(&scheme, convex, h, 40)?.deepest;
        findings.push(
            Finding::at_most(format!("deepest penetration outside a circle, h = {h}"), outside, tolerance::bead_rounding(40), "m")
                .says_at_least(h * h * (0.5 - circle_residual(h)))
                .violating("a gap that is concave along the motion"),
        );
    }
    Ok(findings)
}
