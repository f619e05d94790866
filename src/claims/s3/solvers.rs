//! Claims of §3 on solving the step: Gauss–Seidel, the Moreau envelope, proximal terms.

use crate::claims::prelude::*;
use crate::problem::{ContactProblem, Law};
use crate::solvers::{ContactSolver, LemkePivoting, ProjectedGaussSeidel};
use crate::tolerance;
use moreau_exact::minimum::{Minimum, diagonal};
use moreau_exact::witness::decided;
use nalgebra::Matrix2;

/// The claims of this file.
pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "S3.pgs-ok",
        statement: "The LCP of a positive semidefinite matrix, if feasible, has a solution (and can be solved by Lemke's algorithm or \
            PGS).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Projected Gauss–Seidel needs $W_{ii} > 0$. For singular $W$ it converges to a solution that depends on the
            start; $WP$ is the same for all of them.",
        argument: r"A table on four legs, $H = (1, \pm1, \pm1)$, unit masses, $u_\text{free} = -1$: from $P = 0$ and from
            $P = (1/4, 0, 0, 1/4)$ it ends at impulses further apart than its accuracy, while $W\,P = (1, 1, 1, 1)$ from both, to the
            accuracy that the two residuals imply for a convex problem. With a fifth contact that moves nothing, $W_{ii} = 0$ and
            $u_i = 0$, the problem is semidefinite and solvable: Lemke’s method solves it, projected Gauss–Seidel, which divides by
            $W_{ii}$, refuses it.",
        controls: &[
            "The table without the fifth contact.",
            "A single sweep of Gauss–Seidel.",
            "A fifth contact that approaches at 1 m/s, which no impulse prevents.",
        ],
        sources: &["chapter §3, solvability of the normal LCP", "the agreement bound is derived with the tolerance"],
        check: check!(four_legs),
    },
    Claim {
        id: "S3.moreau-env",
        statement: "The Moreau envelope smooths the non-differentiable indicator of the feasible cone with a smooth quadratic lower bound \
            whose minimiser is the projection.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"$e_\lambda(x)$ = min over $y \in C$ of $\|x - y\|^2/(2\lambda) = \operatorname{dist}(x, C)^2/(2\lambda) \le
            \iota_C(x)$; it is $C^1$ with gradient $(x - P_C(x))/\lambda$, piecewise quadratic, and the minimising $y$ is $P_C(x)$.",
        argument: r"For $C = [0, \infty)$: $e_\lambda(x) = \min(x, 0)^2/(2\lambda)$. At rational points with $\lambda = 1/3$: no $y$ of a
            grid on $C$ is nearer than $P(x) = \max(x, 0)$, $e_\lambda = 0$ on $C$, where the indicator is 0, and the derivative is
            $\min(x, 0)/\lambda$, continuous through 0. It is quadratic on either side of 0, not globally: $x^2/(2\lambda)$ would exceed
            the indicator on $C$.",
        controls: &[r"The global quadratic $x^2/(2\lambda)$ in place of the envelope.", "The apex of the cone in place of the projection."],
        sources: &["chapter §3, LCP as projection", "Moreau (1965)"],
        check: check!(envelope),
    },
    Claim {
        id: "S3.prox-cond",
        statement: r"The proximal term $\tfrac12\rho\|P - P^k\|^2$ adds $\rho I$ to $W$ and so improves the condition number of an
            ill-conditioned Delassus operator.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"$\operatorname{cond}(W + \rho I) = (\lambda_\text{max} + \rho)/(\lambda_\text{min} + \rho)$, which decreases with
            $\rho \ge 0$ (strictly unless all eigenvalues are equal).",
        argument: r"The derivative in $\rho$ is $(\lambda_\text{min} - \lambda_\text{max})/(\lambda_\text{min} + \rho)^2 \le 0$. Two
            nearly parallel contacts, $W = (1, 0.999; 0.999, 1)$ with eigenvalues 1.999 and 0.001: the condition number is 1999, 183, 20.8
            and 3.0 for $\rho = 0$, 0.01, 0.1 and 1.",
        controls: &[r"A scaling $(1 + \rho)W$ in place of the shift, which leaves the condition number as it is."],
        sources: &["chapter §3, proximal view of ADMM"],
        check: check!(conditioning),
    },
    Claim {
        id: "S3.R-is-MY",
        statement: r"MuJoCo’s regularisation $R$ is in essence a Moreau–Yosida smoothing of fixed strength.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: $R$ replaces the constraint $u \ge 0$ by its Moreau envelope of strength $R$, $\min(u, 0)^2/(2R)$,
            for good. A proximal term has the same strength and is centred at the previous iterate: it vanishes at the fixed point, which
            is the unregularised answer.",
        argument: r"One contact, $W = 1/1000$, $u_\text{free} = -1$, $R = 1$: with $R$ the impulse is $1/(W + R)$. The velocity $u$ that
            it leaves minimises $(u - u_\text{free})^2/(2W) + \min(u, 0)^2/(2R)$ against the points of a grid, and the impulse is minus
            the slope of the envelope there; so for three values of $R$. The proximal iteration $P \leftarrow (1 + \rho P)/(W + \rho)$,
            $\rho = 1$, has the fixed point 1000.",
        controls: &[r"The hard contact, $R = 0$, held against the envelope."],
        sources: &["chapter §3, closing insight", "elementary"],
        check: check!(two_centres),
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
    let swept = ProjectedGaussSeidel { sweeps: reading.only(1).pick(solver.sweeps, 1), ..ProjectedGaussSeidel::default() };
    let cold = swept.solve(&problem, None)?.impulse;
    let warm = swept.solve(&problem, Some(&DVector::from_vec(vec![0.25, 0.0, 0.0, 0.25])))?.impulse;
    let apart = (&cold - &warm).norm();
    // natural maps at most STOP·max(‖r‖, ρ‖q‖) ≤ STOP per contact, four contacts, two answers; ‖W‖ = 4, ρ = 1/3
    let residual = 2.0 * 4.0 * tolerance::solvers::STOP;
    let bound = tolerance::solvers::agreement(4.0, residual, apart + residual, 1.0 / 3.0);
    let difference = (problem.dense() * (&cold - &warm)).norm();
    let from_one = (problem.dense() * &cold - DVector::from_element(4, 1.0)).amax();
    let (rows, idle) = (reading.only(0).pick(5, 4), reading.only(2).pick(0.0, -1.0));
    let padded = |i: usize, j: usize| if i < 4 && j < 4 { problem.dense()[(i, j)] } else { 0.0 };
    let free = DVector::from_fn(rows, |i, _| if i < 4 { -1.0 } else { idle });
    let with_idle = ContactProblem::new(DMatrix::from_fn(rows, rows, padded), free)
        .name("table on four legs and an idle contact")
        .law(Law::Frictionless)
        .rows_per_contact(1)
        .build()?;
    Ok(vec![
        Finding::at_most("difference of WP between two starts", difference, bound, "m/s"),
        Finding::equal("largest |WP − 1|", from_one, 0.0, bound, "m/s"),
        Finding::decision("W_ii = 0: solved by Lemke's method", LemkePivoting.solve(&with_idle, None).is_ok(), true),
        Finding::decision("W_ii = 0: solved by projected Gauss–Seidel", solver.solve(&with_idle, None).is_ok(), false)
            .says(true)
            .violating("W_ii > 0"),
        Finding::at_least("difference of P between two starts", apart, bound, "N·s").context(),
    ])
}

fn envelope(reading: Reading) -> Result<Vec<Finding>> {
    let lambda = ratio(1, 3);
    let zero = || ratio(0, 1);
    let square = |x: Rational| x.clone() * x;
    let nearest = |x: &Rational| if *x > zero() { reading.only(1).pick(x.clone(), zero()) } else { zero() };
    let on_the_half_line = |x: &Rational| Minimum::projection([ratio(1, 1)], std::array::from_ref(x), vec![[ratio(1, 1)]]);
    let projection = |x: &Rational| decided(|| nearest(x), |found| on_the_half_line(x).witness(std::array::from_ref(found)));
    let value = |x: &Rational| {
        let distance = reading.only(0).pick(x.clone() - projection(x), x.clone());
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
    let (mut last, mut falls) = (0.0, 0);
    for rho in [1.0, 0.1, 0.01, 0.0].into_iter().rev() {
        let matrix = reading.pick(w + Matrix2::identity() * rho, w * (1.0 + rho));
        let eigenvalues = matrix.symmetric_eigenvalues();
        let condition = eigenvalues.max() / eigenvalues.min();
        let expected = (1.999 + rho) / (0.001 + rho);
        // both eigenvalues to 8 roundings of ‖W‖ ≤ 4, relative to the smallest
        let bound = expected * tolerance::rounding(8, 4.0) / (0.001 + rho);
        let found = Finding::equal(format!("condition number at ρ = {rho}"), condition, expected, bound, "1");
        findings.push(if rho == 0.0 { found.context() } else { found });
        falls += usize::from(condition + bound < last);
        last = condition;
    }
    findings.push(Finding::count("ρ at which it is smaller than before", falls, 3));
    findings.reverse();
    Ok(findings)
}

/// (u − u_free)²/(2W) + min(u, 0)²/(2R) over u, as a program in u and the depth s that it leaves, s + u ≥ 0.
fn smoothed(w: &Rational, free: &Rational, strength: &Rational) -> Minimum<Rational, 2> {
    let (zero, one) = (ratio(0, 1), ratio(1, 1));
    Minimum { matrix: diagonal([&one / w, &one / strength]), vector: [-(free / w), zero], rows: vec![[one.clone(), one]] }
}

fn two_centres(reading: Reading) -> Result<Vec<Finding>> {
    let (w, free) = (ratio(1, 1000), ratio(-1, 1));
    let zero = ratio(0, 1);
    let mut findings = Vec::new();
    for strength in [ratio(1, 1), ratio(1, 10), ratio(1, 1000)] {
        let softness = reading.pick(strength.clone(), ratio(0, 1));
        let impulse = -free.clone() / (&w + &softness);
        let below = |u: &Rational| if *u < zero { u.clone() } else { ratio(0, 1) };
        let after = || &free + &w * &impulse;
        let reached = decided(after, |u| smoothed(&w, &free, &strength).witness(&[u.clone(), -below(u)]));
        let cost = |u: &Rational| (u - &free) * (u - &free) / (ratio(2, 1) * &w) + below(u) * below(u) / (ratio(2, 1) * &strength);
        let better = (-2000..=2000).filter(|k| cost(&ratio(*k, 1000)) < cost(&reached)).count();
        findings.push(Finding::count(format!("points of a grid with a smaller envelope cost than with R = {strength}"), better, 0));
        let slope = below(&reached) / &strength;
        findings.push(Finding::exact(format!("impulse plus slope of the envelope, R = {strength}"), &(impulse + slope), &zero, "N·s"));
    }
    let proximal = |centre: &Rational| (ratio(1, 1) + centre) / (&w + ratio(1, 1));
    findings.push(Finding::exact("proximal step at the exact impulse", &proximal(&ratio(1000, 1)), &ratio(1000, 1), "N·s").context());
    Ok(findings)
}
