//! Complementarity, normal cone and proximal operator as the preface recalls them; the cone's errors in the misconception table.

use crate::Result;
use crate::certificate::lcp::residuals;
use crate::checks::Finding;
use crate::claims::s4::polyhedral::order_findings;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::cones::polyhedral::strength_error;
use crate::problem::{Lcp, PlanarProblem};
use crate::scalar::{Rational, ratio};
use crate::solvers::enumeration::all_solutions;
use crate::solvers::lemke::{LemkeOutcome, lemke};
use crate::tolerance::rounding;
use nalgebra::{DMatrix, DVector};

/// Claims of the preface.
pub const PREFACE: &[Claim] = &[Claim {
    id: "P.lcp-slack",
    statement: "A solution of 0 ≤ z ⟂ w = Mz + q ≥ 0 has z_i = 0 or w_i = 0 for each i; N_C(x) = {g : ⟨g, y − x⟩ ≤ 0 for all y in C}; \
        prox_f(v) = argmin f(x) + ½‖x − v‖².",
    verdict: ClaimVerdict::True,
    kind: Kind::Assertion,
    severity: None,
    evidence: Evidence::Exact,
    correct_statement: "As stated, for C closed and convex and x in C; the prox of an indicator is the projection, and v − prox(v) lies in \
        the normal cone.",
    argument: "Σ zᵢwᵢ = 0 with every term ≥ 0 makes every term 0. All solutions of three rational LCPs, found by enumerating complementary \
        supports, satisfy it entry by entry. \
        For C = [0, 2] and v = −1, 1/3, 2, 5 the minimiser of ½(x − v)² on a fine grid is the clamped v, and v − x is in N_C(x).",
    control: "A feasible point of each LCP, shifted off the complementary face.",
    sources: &["chapter, recollections before §0", "Cottle, Pang and Stone, The Linear Complementarity Problem (1992), §1.1"],
    check: complementary_slackness,
}];

/// Claims of the table of misconceptions.
pub const MISCONCEPTIONS: &[Claim] = &[Claim {
    id: "M.cone-error",
    statement: "The polyhedral cone changes the cone's shape: an error O(1/d), its LCP exact.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Certified,
    correct_statement: "O(1/d) is the order of the direction (π/d) and of the force vector; the radius is short by 1 − cos(π/d) = O(1/d²): \
        0.2929, 0.0761, 0.0192, 0.0048 for d = 4, 8, 16, 32. The LCP of that cone is solved exactly.",
    argument: "d²(1 − cos(π/d)) lies in [π²/2 − π⁴/(24 d²), π²/2] and d·(π/d) = π. Lemke's method in rational arithmetic solves the LCP of \
        a sliding contact with four directions with all residuals zero; \
        its friction has half the squared strength of the circular cone's along the bisector, which is the error of the shape.",
    control: "First order as the order of the radius.",
    sources: &["chapter, table of misconceptions, polyhedral cone and convex relaxation"],
    check: cone_error,
}];

fn number(entry: &i64) -> Rational {
    ratio(*entry, 1)
}

fn problem(matrix: &[i64], vector: &[i64]) -> Lcp<Rational> {
    let size = vector.len();
    Lcp::new(
        DMatrix::from_iterator(size, size, matrix.iter().map(number)).transpose(),
        DVector::from_iterator(size, vector.iter().map(number)),
    )
}

fn complementary_slackness(reading: Reading) -> Result<Vec<Finding>> {
    let zero = ratio(0, 1);
    let problems =
        [problem(&[2, 1, 1, 2], &[-1, -1]), problem(&[0, 1, 1, 0], &[-1, -1]), problem(&[3, -1, 0, -1, 2, 1, 0, 1, 4], &[-2, 1, -5])];
    let mut findings = Vec::new();
    for (index, lcp) in problems.iter().enumerate() {
        let solutions = all_solutions(lcp)?.points;
        let shift = DVector::from_element(lcp.size(), reading.pick(ratio(0, 1), ratio(1, 1)));
        let both_positive = |point: &DVector<Rational>| {
            let z = point + &shift;
            let slack = lcp.slack(&z);
            z.iter().zip(slack.iter()).filter(|(z, w)| **z > zero && **w > zero).count()
        };
        findings.push(Finding::count(
            format!("entries with z_i > 0 and w_i > 0, LCP {}", index + 1),
            solutions.iter().map(both_positive).sum(),
            0,
        ));
        findings.push(Finding::decision(format!("LCP {} has a solution", index + 1), !solutions.is_empty(), true));
    }
    findings.extend([[-1, 1], [1, 3], [2, 1], [5, 1]].map(|[a, b]| proximal_point_is_normal(&ratio(a, b))));
    Ok(findings)
}

/// Whether the minimiser of ½(x − v)² over the grid of C = \[0, 2\] satisfies `(v − x)(y − x) ≤ 0` for every y of the grid.
fn proximal_point_is_normal(v: &Rational) -> Finding {
    let grid: Vec<Rational> = (0..=24).map(|k| ratio(k, 12)).collect();
    let cost = |x: &Rational| (x.clone() - v.clone()) * (x.clone() - v.clone());
    let nearest = grid.iter().fold(&grid[0], |best, x| if cost(x) < cost(best) { x } else { best });
    let g = v.clone() - nearest.clone();
    let normal = grid.iter().all(|y| g.clone() * (y.clone() - nearest.clone()) <= ratio(0, 1));
    Finding::decision(format!("v − prox(v) is normal to C at prox(v), v = {v}"), normal, true)
}

fn cone_error(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings: Vec<Finding> = [8, 16, 32].into_iter().flat_map(|d| order_findings(reading.pick(2, 1), d)).collect();
    // cos(π/4) = 1/√2 and the half-angle formula, twice
    let half_angle = |cosine: f64| ((1.0 + cosine) / 2.0).sqrt();
    let quarter = 0.5f64.sqrt();
    let eighth = half_angle(quarter);
    for (d, cosine) in [(4, quarter), (8, eighth), (16, half_angle(eighth)), (32, half_angle(half_angle(eighth)))] {
        findings.push(Finding::equal(format!("missing strength, d = {d}"), strength_error(d), 1.0 - cosine, rounding(8, 1.0), "1"));
    }
    let directions = [[1, 0], [0, 1], [-1, 0], [0, -1]].map(|axis| axis.map(|entry| ratio(entry, 1)));
    let free = DVector::from_iterator(3, [-1, 1, 1].iter().map(number));
    let lcp = PlanarProblem::new(DMatrix::identity(3, 3), free).polyhedral(&[ratio(1, 2)], &directions)?.lcp;
    let exact = match lemke(&lcp, &DVector::from_element(lcp.size(), ratio(1, 1)))? {
        LemkeOutcome::Solution { z, .. } => residuals(&lcp, &z).vanish(),
        LemkeOutcome::Ray { .. } => false,
    };
    findings.push(Finding::decision("all residuals of the polyhedral LCP are exactly zero", exact, true));
    Ok(findings)
}
