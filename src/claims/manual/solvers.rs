//! Row 8: a contact solver that does not converge.
//!
//! ```text
//!     two bodies, m₁ below m₂:   W = (1, −1; −1, 1 + m₁/m₂)/m₁ ,   a sweep leaves u₁ = −g h qᵏ ,  q = W₁₂²/(W₁₁W₂₂) = m₂/(m₁ + m₂)
//!     one contact as two edges n ± μt, W = 1:   (1 + μ², 1 − μ²; 1 − μ², 1 + μ²) ,   cond = max(μ², 1/μ²) ,  q = ((1 − μ²)/(1 + μ²))²
//! ```
//! The sweep that ends below the stopping rule ρ|u| ≤ STOP·max(‖r‖, ρ|u_free|) follows from q.

use crate::claims::prelude::*;
use crate::problem::{ContactProblem, Law};
use crate::solvers::{ContactSolver, LemkePivoting, ProjectedGaussSeidel};
use crate::tolerance::claims::pathology as tolerance;
use crate::tolerance::solvers::STOP;

pub(super) const CLAIMS: &[Claim] = &[Claim {
    id: "R8",
    statement: "The contact solver reports no convergence: (a) Drake's TAMSI fails on its non-convex problem, (b) ill-conditioned Delassus \
        operator, (c) friction so large that it makes the problem ill-conditioned. Use a convex solver (SAP, ADMM) for global convergence; \
        ADMM with a proximal term against ill-conditioning; check mass matrix and contacts.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Advice,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Certified,
    correct_statement: "For Gauss–Seidel the sweeps follow the coupling q = W₁₂²/(W₁₁W₂₂), not cond(W): a heavy body on a light one needs \
        20 to 26 m₂/m₁ sweeps, a light one on a heavy one a dozen at most, with condition numbers of the same order. Pivoting is \
        indifferent to both. Large μ makes pyramidal (edge) formulations ill-conditioned, cond = μ², and so does small μ; a contact solved \
        as a cone needs one sweep at every μ. (TAMSI was removed from Drake in 1.57.)",
    argument: "Two bodies under gravity, m₂/m₁ = 1, 10, 100, 1000: sweeps as predicted by q = m₂/(m₁+m₂), 39, 263, 2289 and 20 482; Lemke: \
        3 pivots each time. Exchanged masses: 39, 12, 7, 5. cond(W) at 1000: 4002, exchanged 1002. One contact in edges: cond = μ², and \
        about 600 sweeps for μ = 10 as for 1/10; as a cone under Coulomb's and the associated law: one sweep for μ = 1 … √1000.",
    controls: &["The heavy body on the light one in the place of the light on the heavy, and the edges in the place of the cone."],
    sources: &["chapter, troubleshooting manual, row 8", "Drake, pull request 24831, for the removal of TAMSI"],
    check: conditioning,
}];

/// Two bodies on the floor falling by u_free = −1 m/s.
fn two_bodies(below: f64, above: f64) -> ContactProblem {
    let (a, b) = (1.0 / below, 1.0 / above);
    problem(Law::Frictionless, 1, DMatrix::from_row_slice(2, 2, &[a, -a, -a, a + b]), vec![-1.0, 0.0], vec![0.0; 2])
}

/// One contact with W = 1, pressed at 1 m/s: as two frictionless edges n ± μt.
fn edges(mu: f64) -> ContactProblem {
    let (a, c) = (1.0 + mu * mu, 1.0 - mu * mu);
    problem(Law::Frictionless, 1, DMatrix::from_row_slice(2, 2, &[a, c, c, a]), vec![-1.0, -1.0], vec![0.0; 2])
}

/// The same contact as a cone.
fn cone(law: Law, mu: f64) -> ContactProblem {
    problem(law, 2, DMatrix::identity(2, 2), vec![-1.0, 0.0], vec![mu])
}

fn problem(law: Law, rows: usize, delassus: DMatrix<f64>, free: Vec<f64>, friction: Vec<f64>) -> ContactProblem {
    ContactProblem::new(delassus, DVector::from_vec(free))
        .name("conditioning")
        .law(law)
        .rows_per_contact(rows)
        .friction(friction)
        .build()
        .expect("a small problem of finite numbers")
}

/// λ_max/λ_min of W.
fn condition_number(problem: &ContactProblem) -> f64 {
    let eigenvalues = problem.dense().symmetric_eigenvalues();
    eigenvalues.max() / eigenvalues.min()
}

fn sweeps(problem: &ContactProblem) -> Result<f64> {
    Ok(ProjectedGaussSeidel::default().solve(problem, None)?.iterations as f64)
}

/// Sweeps until |u₁| = qᵏ meets ρ₁|u₁| ≤ STOP·r₁ with ρ₁ = m₁ and r₁ = m₁ + m₂: each contact is of two bodies of its own.
fn predicted_for_bodies(below: f64, above: f64) -> f64 {
    let q = above / (below + above);
    ((STOP * (below + above) / below).ln() / q.ln()).ceil()
}

/// Sweeps until |u₁| = |c/a|²ᵏ⁻¹ (1 − c/a) meets |u₁|/a ≤ STOP·max(½, 1/a), a = 1 + μ², c = 1 − μ², r = (½, ½).
fn predicted_for_edges(mu: f64) -> f64 {
    let (a, ratio) = (1.0 + mu * mu, ((1.0 - mu * mu) / (1.0 + mu * mu)).abs());
    let coupled = (1.0 - mu * mu) / a;
    let goal = STOP * (0.5 * a).max(1.0) / (1.0 - coupled);
    (0.5 * (goal.ln() / ratio.ln() + 1.0)).ceil()
}

fn conditioning(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for heavy in [1000.0, 1.0, 10.0, 100.0] {
        let predicted = predicted_for_bodies(1.0, heavy);
        let name = format!("sweeps with {heavy} kg on 1 kg");
        findings.push(Finding::equal(name, sweeps(&two_bodies(1.0, heavy))?, predicted, tolerance::SWEEP_COUNT, "1"));
        if heavy > 1.0 {
            let (below, above) = reading.pick((heavy, 1.0), (1.0, heavy));
            let (name, exchanged) = (format!("sweeps with 1 kg on {heavy} kg"), sweeps(&two_bodies(below, above))?);
            let predicted = predicted_for_bodies(heavy, 1.0);
            // better conditioned are a tenth of the mass on 1 kg; they need so many
            findings.push(
                Finding::equal(name, exchanged, predicted, tolerance::SWEEP_COUNT, "1")
                    .says_at_least(predicted_for_bodies(1.0, 0.1 * heavy))
                    .violating("the heavy body lies on the light one"),
            );
        }
        for (below, above) in [(1.0, heavy), (heavy, 1.0)] {
            // κ + 1/κ + 2 = (tr W)²/det W = (2 + ϱ)²/ϱ, ϱ = m₁/m₂
            let share = below / above;
            let kappa = condition_number(&two_bodies(below, above));
            let expected = (2.0 + share).powi(2) / share;
            let name = format!("κ + 1/κ + 2 of W with {above} kg on {below} kg");
            findings.push(Finding::equal(name, kappa + 1.0 / kappa + 2.0, expected, tolerance::condition(expected), "1"));
        }
        let pivots = LemkePivoting.solve(&two_bodies(1.0, heavy), None)?.iterations;
        findings.push(Finding::count(format!("pivots with {heavy} kg on 1 kg"), pivots, 3));
        let mu = heavy.sqrt();
        let spread = condition_number(&edges(mu));
        findings.push(Finding::equal(format!("cond of the edge matrix, μ = {mu:.3}"), spread, heavy, tolerance::condition(heavy), "1"));
        for law in [Law::Coulomb, Law::Associated] {
            let one = reading.pick(cone(law, mu), edges(mu));
            let finding = Finding::equal(format!("sweeps on one cone, {}, μ = {mu:.3}", law.name()), sweeps(&one)?, 1.0, 0.0, "1");
            // an ill-conditioned problem needs more than one sweep
            findings.push(if mu > 1.0 { finding.says_at_least(2.0).violating("the cone is replaced by its edges") } else { finding });
        }
    }
    for mu in [10.0, 0.1] {
        findings.push(Finding::equal(
            format!("sweeps on edges, μ = {mu}"),
            sweeps(&edges(mu))?,
            predicted_for_edges(mu),
            tolerance::SWEEP_COUNT,
            "1",
        ));
    }
    Ok(findings)
}
