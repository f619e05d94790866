//! Claims of §3 on solving the step: Gauss–Seidel, the Moreau envelope, proximal terms.

use crate::Result;
use crate::checks::Finding;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::problem::{ContactProblem, Law};
use crate::scalar::{Rational, ratio};
use crate::solvers::{ContactSolver, ProjectedGaussSeidel};
use crate::tolerance;
use nalgebra::{DMatrix, DVector, Matrix2};

/// The claims of this file.
pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "S3.pgs-ok",
        statement: "The normal LCP with positive semidefinite W is solved by Lemke's method or by projected Gauss–Seidel.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "Projected Gauss–Seidel needs W_ii > 0. For singular W it converges to a solution that depends on the start; WP \
            is the same for all of them.",
        argument: "A table on four legs, H = (1, ±1, ±1), unit masses, u_free = −1: from P = 0 and from P = (1/4, 0, 0, 1/4) it ends at \
            impulses more than 0.1 N·s apart, while W P = (1, 1, 1, 1) from both, \
                   to the accuracy that the two residuals imply for a convex problem. A row with W_ii = 0 is refused.",
        control: "The impulses P in place of WP.",
        sources: &["chapter §3, solvability of the normal LCP", "the agreement bound is derived with the tolerance"],
        check: four_legs,
    },
    Claim {
        id: "S3.moreau-env",
        statement: "The Moreau envelope smooths the non-differentiable indicator of the feasible cone with a smooth quadratic lower bound \
            whose minimiser is the projection.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "e_λ(x) = min over y ∈ C of ‖x − y‖²/(2λ) = dist(x, C)²/(2λ) ≤ ι_C(x); it is C¹ with gradient (x − P_C(x))/λ, \
            piecewise quadratic, and the minimising y is P_C(x).",
        argument: "For C = [0, ∞): e_λ(x) = min(x, 0)²/(2λ). At 41 rational points with λ = 1/3: no y of a grid on C is nearer than P(x) = \
            max(x, 0), e_λ = 0 on C, where the indicator is 0, and the derivative is min(x, 0)/λ, continuous through 0. \
                   It is quadratic on either side of 0, not globally: x²/(2λ) would exceed the indicator on C.",
        control: "The global quadratic x²/(2λ) in place of the envelope.",
        sources: &["chapter §3, LCP as projection", "Moreau (1965)"],
        check: envelope,
    },
    Claim {
        id: "S3.prox-cond",
        statement: "The proximal term ½ρ‖P − Pᵏ‖² adds ρI to W and so improves the condition number of an ill-conditioned Delassus \
            operator.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "cond(W + ρI) = (λ_max + ρ)/(λ_min + ρ), which decreases with ρ ≥ 0 (strictly unless all eigenvalues are \
            equal).",
        argument: "The derivative in ρ is (λ_min − λ_max)/(λ_min + ρ)² ≤ 0. Two nearly parallel contacts, W = (1, 0.999; 0.999, 1) with \
            eigenvalues 1.999 and 0.001: the condition number is 1999, 183, 20.8 and 3.0 for ρ = 0, 0.01, 0.1 and 1.",
        control: "A scaling (1 + ρ)W in place of the shift, which leaves the condition number as it is.",
        sources: &["chapter §3, proximal view of ADMM"],
        check: conditioning,
    },
    Claim {
        id: "S3.R-is-MY",
        statement: "MuJoCo's regularisation R is in essence a Moreau–Yosida smoothing of fixed strength, as the proximal term of ADMM is.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "R is a quadratic term centred at zero (Tikhonov): it changes the answer for good. A proximal term is centred \
            at the previous iterate: it vanishes at the fixed point, which is the unregularised answer. Both are Moreau–Yosida smoothings \
            of the same strength, of different problems.",
        argument: "One contact, W = 1/1000, u_free = −1, ρ = R = 1: the exact impulse is 1000; with R it is 1/(W + R) = 1000/1001 ≈ 0.999; \
            the proximal iteration P ← (1 + ρP)/(W + ρ) has the fixed point 1000 and reduces the error by 1000/1001 per step \
                   (200 exact steps).",
        control: "The iteration centred at zero: it stays at 1000/1001.",
        sources: &["chapter §3, closing insight", "elementary"],
        check: two_centres,
    },
];

fn four_legs(reading: Reading) -> Result<Vec<Finding>> {
    let jacobian = DMatrix::from_row_slice(4, 3, &[1., 1., 1., 1., 1., -1., 1., -1., 1., 1., -1., -1.]);
    let problem = ContactProblem::new(&jacobian * jacobian.transpose(), DVector::from_element(4, -1.0))
        .name("table on four legs")
        .law(Law::Frictionless)
        .rows_per_contact(1)
        .build()?;
    let solver = ProjectedGaussSeidel::default();
    let cold = solver.solve(&problem, None)?.impulse;
    let warm = solver.solve(&problem, Some(&DVector::from_vec(vec![0.25, 0.0, 0.0, 0.25])))?.impulse;
    let apart = (&cold - &warm).norm();
    // natural maps at most STOP·max(‖r‖, ρ‖q‖) ≤ STOP per contact, four contacts, two answers; ‖W‖ = 4, ρ = 1/3
    let residual = 2.0 * 4.0 * tolerance::solvers::STOP;
    let bound = tolerance::solvers::agreement(4.0, residual, apart + residual, 1.0 / 3.0);
    let compared = reading.pick((problem.dense() * (&cold - &warm)).norm(), apart);
    let from_one = (problem.dense() * &cold - DVector::from_element(4, 1.0)).amax();
    let mut massless = problem.dense().clone();
    massless.row_mut(0).fill(0.0);
    massless.column_mut(0).fill(0.0);
    let problem = problem.into_builder().delassus(massless).build()?;
    Ok(vec![
        Finding::at_most("difference of WP between two starts", compared, bound, "m/s"),
        Finding::at_least("difference of P between two starts", apart, 0.1, "N·s"),
        Finding::equal("largest |WP − 1|", from_one, 0.0, bound, "m/s"),
        Finding::decision("W_ii = 0 is refused", solver.solve(&problem, None).is_err(), true),
    ])
}

fn envelope(reading: Reading) -> Result<Vec<Finding>> {
    let lambda = ratio(1, 3);
    let zero = || ratio(0, 1);
    let square = |x: Rational| x.clone() * x;
    let projection = |x: &Rational| if *x > zero() { x.clone() } else { zero() };
    let value = |x: &Rational| {
        let distance = reading.pick(x.clone() - projection(x), x.clone());
        square(distance) / (ratio(2, 1) * lambda.clone())
    };
    let (mut nearer, mut above, mut slopes) = (0, 0, 0);
    for k in -20..=20 {
        let x = ratio(k, 7);
        let grid = (0..=60).map(|j| ratio(j, 15));
        nearer += grid.filter(|y| square(x.clone() - y.clone()) < square(x.clone() - projection(&x))).count();
        above += usize::from(x >= zero() && value(&x) > zero());
        // the central difference of a quadratic is its derivative; 0 is the only point with two pieces beside it
        let step = ratio(1, 1000);
        let difference = (value(&(x.clone() + step.clone())) - value(&(x.clone() - step.clone()))) / (ratio(2, 1) * step.clone());
        let gradient = (x.clone() - projection(&x)) / lambda.clone();
        slopes += usize::from(k != 0 && difference != gradient);
    }
    Ok(vec![
        Finding::count("points where the envelope exceeds the indicator", above, 0),
        Finding::count("points where the derivative is not (x − P(x))/λ", slopes, 0),
        Finding::count("points of C nearer than the projection", nearer, 0),
    ])
}

fn conditioning(reading: Reading) -> Result<Vec<Finding>> {
    let w = Matrix2::new(1.0, 0.999, 0.999, 1.0);
    let mut findings = Vec::new();
    let mut last = f64::INFINITY;
    for rho in [1.0, 0.1, 0.01, 0.0].into_iter().rev() {
        let matrix = reading.pick(w + Matrix2::identity() * rho, w * (1.0 + rho));
        let eigenvalues = matrix.symmetric_eigenvalues();
        let condition = eigenvalues.max() / eigenvalues.min();
        let expected = (1.999 + rho) / (0.001 + rho);
        // both eigenvalues to 8 roundings of ‖W‖ ≤ 4, relative to the smallest
        let bound = expected * tolerance::rounding(8, 4.0) / (0.001 + rho);
        findings.push(Finding::decision(format!("smaller than before, ρ = {rho}"), condition < last, true));
        findings.push(Finding::equal(format!("condition number at ρ = {rho}"), condition, expected, bound, "1"));
        last = condition;
    }
    findings.reverse();
    Ok(findings)
}

fn two_centres(reading: Reading) -> Result<Vec<Finding>> {
    let (w, rho) = (ratio(1, 1000), ratio(1, 1));
    let step = |centre: &Rational| (ratio(1, 1) + rho.clone() * centre.clone()) / (w.clone() + rho.clone());
    let exact = ratio(1000, 1);
    let mut impulse = ratio(0, 1);
    let mut factor = ratio(1, 1);
    for _ in 0..200 {
        let centre = reading.pick(impulse.clone(), ratio(0, 1));
        impulse = step(&centre);
        factor *= ratio(1000, 1001);
    }
    Ok(vec![
        Finding::exact("impulse with R", &step(&ratio(0, 1)), &ratio(1000, 1001), "N·s"),
        Finding::exact("proximal step at the exact impulse", &step(&exact), &exact, "N·s"),
        Finding::exact(
            "error after 200 proximal steps over (1000/1001)²⁰⁰",
            &((exact.clone() - impulse) / (exact * factor)),
            &ratio(1, 1),
            "1",
        ),
    ])
}
