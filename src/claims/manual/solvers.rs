//! Row 8: a contact solver that does not converge.
//!
//! ```text
//!     two bodies, m₁ below m₂:   W = (1, −1; −1, 1 + m₁/m₂)/m₁ ,   a sweep leaves u₁ = −g h qᵏ ,  q = W₁₂²/(W₁₁W₂₂) = m₂/(m₁ + m₂)
//!     one contact as two edges n ± μt, W = 1:   (1 + μ², 1 − μ²; 1 − μ², 1 + μ²) ,   cond = max(μ², 1/μ²) ,  q = ((1 − μ²)/(1 + μ²))²
//! ```
//! The sweep that ends below the stopping rule ρ|u| ≤ STOP·max(‖r‖, ρ|u_free|) follows from q.

use crate::certificate::residuals;
use crate::claims::prelude::*;
use crate::problem::{ContactProblem, Law};
use crate::solvers::{AlternatingDirections, ContactSolver, LemkePivoting, ProjectedGaussSeidel};
use crate::tolerance::certificate::JAMMED;
use crate::tolerance::claims::pathology as tolerance;
use crate::tolerance::cli::CERTIFY;
use crate::tolerance::solvers::STOP;

pub(super) const CLAIMS: &[Claim] = &[Claim {
    id: "R8",
    statement: "The contact solver reports no convergence: possible causes (a) Drake's TAMSI fails on its non-convex problem, (b) \
        ill-conditioned Delassus operator, (c) friction so large that it makes the problem ill-conditioned. Use a convex solver (SAP, \
        ADMM) for global convergence; Pinocchio's ADMM with its proximal term against ill-conditioning; check mass matrix and contacts.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Advice,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Certified,
    correct_statement: r"For Gauss–Seidel the sweeps follow the coupling $q = W_{12}^2/(W_{11}W_{22})$, not cond($W$): a heavy body on a
        light one needs 20 to $26\,m_2/m_1$ sweeps, a light one on a heavy one a dozen at most, with condition numbers of the same order.
        Pivoting is indifferent to both, and ADMM solves them. Large $\mu$ makes pyramidal (edge) formulations ill-conditioned, cond
        $= \mu^2$, and so does small $\mu$; a contact solved as a cone needs one sweep at every $\mu$. (TAMSI was removed from Drake in
        1.57.)",
    argument: r"Two bodies under gravity, $m_2/m_1 = 10$, 100, 1000: sweeps as predicted by $q = m_2/(m_1 + m_2)$, 266, 2323 and 20829;
        Lemke: 3 pivots each time; ADMM solves all to the certificate. Exchanged masses: 12, 7, 5. cond($W$) at 1000: 4002, exchanged 1002.
        One contact in edges: cond $= \mu^2$, and 613 sweeps for $\mu = 10$ as 596 for 1/10; as a cone under Coulomb's and the associated
        law: one sweep for $\mu = \sqrt{10}\,\ldots\,\sqrt{1000}$. SAP and TAMSI were not run.",
    controls: &[
        "The masses exchanged, and the edges and the cone.",
        "A hundred sweeps of Gauss–Seidel in place of Lemke's method and of ADMM.",
    ],
    sources: &["chapter, troubleshooting manual, row 8", "Drake, pull request 24831, for the removal of TAMSI"],
    check: check!(conditioning),
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

/// Sweeps until |u₁| = qᵏ meets ρ₁|u₁| ≤ STOP·s₁ with ρ₁ = m₁ and s₁ = r₁ = m₁ + m₂, at most 10³ ρ₁|u_free|: each contact is of two bodies
/// of its own.
fn predicted_for_bodies(below: f64, above: f64) -> f64 {
    let q = above / (below + above);
    ((STOP * ((below + above) / below).min(JAMMED)).ln() / q.ln()).ceil()
}

/// Sweeps until |u₁| = |c/a|²ᵏ⁻¹ (1 − c/a) meets |u₁|/a ≤ STOP·max(½, 1/a), a = 1 + μ², c = 1 − μ², r = (½, ½).
fn predicted_for_edges(mu: f64) -> f64 {
    let (a, ratio) = (1.0 + mu * mu, ((1.0 - mu * mu) / (1.0 + mu * mu)).abs());
    let coupled = (1.0 - mu * mu) / a;
    let goal = STOP * (0.5 * a).max(1.0) / (1.0 - coupled);
    (0.5 * (goal.ln() / ratio.ln() + 1.0)).ceil()
}

/// How many of these problems a solver answers to the certificate.
fn certified(solver: &dyn ContactSolver, problems: &[ContactProblem]) -> usize {
    let answered = |problem: &&ContactProblem| {
        let answer = solver.solve(problem, None);
        answer.is_ok_and(|answer| residuals(problem, &answer).is_ok_and(|judged| judged.is_solution(CERTIFY)))
    };
    problems.iter().filter(answered).count()
}

fn conditioning(reading: Reading) -> Result<Vec<Finding>> {
    const HEAVY: [f64; 3] = [10.0, 100.0, 1000.0];
    let exchanged = reading.only(0).pick(false, true);
    let pair = |below: f64, above: f64| if exchanged { two_bodies(above, below) } else { two_bodies(below, above) };
    let mut findings = Vec::new();
    for heavy in HEAVY {
        let name = format!("sweeps with {heavy} kg on 1 kg");
        let predicted = predicted_for_bodies(1.0, heavy);
        findings.push(Finding::equal(name, sweeps(&pair(1.0, heavy))?, predicted, tolerance::SWEEP_COUNT, "1"));
        let name = format!("sweeps with 1 kg on {heavy} kg");
        // better conditioned are a tenth of the mass on 1 kg; they need so many
        findings.push(
            Finding::equal(name, sweeps(&pair(heavy, 1.0))?, predicted_for_bodies(heavy, 1.0), tolerance::SWEEP_COUNT, "1")
                .says_at_least(predicted_for_bodies(1.0, 0.1 * heavy))
                .violating("the heavy body lies on the light one"),
        );
    }
    let stacks = HEAVY.map(|heavy| two_bodies(1.0, heavy));
    let few = ProjectedGaussSeidel { sweeps: 100, ..ProjectedGaussSeidel::default() };
    let pivoting: &dyn ContactSolver = reading.only(1).pick(&LemkePivoting, &few);
    let directions = AlternatingDirections::default();
    let alternating: &dyn ContactSolver = reading.only(1).pick(&directions, &few);
    let mut pivots = 0;
    for stack in &stacks {
        pivots = pivots.max(pivoting.solve(stack, None)?.iterations);
    }
    let condition = |below: f64, above: f64| condition_number(&two_bodies(below, above));
    // κ + 1/κ + 2 = (tr W)²/det W = (2 + ϱ)²/ϱ, ϱ = m₁/m₂
    let from_trace = |share: f64| {
        let sum = (2.0 + share).powi(2) / share - 2.0;
        0.5 * (sum + (sum * sum - 4.0).sqrt())
    };
    let bound = tolerance::condition(4002.0);
    findings.extend([
        Finding::count("most pivots of Lemke's method on the heavy ones", pivots, 3),
        Finding::count("of these three, those that ADMM solves to the certificate", certified(alternating, &stacks), 3),
        Finding::equal("cond(W) of 1000 kg on 1 kg", condition(1.0, 1000.0), from_trace(0.001), bound, "1").context(),
        Finding::equal("cond(W) of 1 kg on 1000 kg", condition(1000.0, 1.0), from_trace(1000.0), bound, "1").context(),
    ]);
    for law in [Law::Coulomb, Law::Associated] {
        let mut most = 0.0f64;
        for mu in HEAVY.map(f64::sqrt) {
            most = most.max(sweeps(&if exchanged { edges(mu) } else { cone(law, mu) })?);
        }
        findings.push(
            // an ill-conditioned problem needs more than one sweep
            Finding::equal(format!("most sweeps on one cone, {}, μ = √10 … √1000", law.name()), most, 1.0, 0.0, "1")
                .says_at_least(2.0)
                .violating("the cone is replaced by its edges"),
        );
    }
    for mu in [10.0, 0.1] {
        let subject = if exchanged { cone(Law::Coulomb, mu) } else { edges(mu) };
        let name = format!("sweeps on edges, μ = {mu}");
        findings.push(Finding::equal(name, sweeps(&subject)?, predicted_for_edges(mu), tolerance::SWEEP_COUNT, "1"));
    }
    Ok(findings)
}
