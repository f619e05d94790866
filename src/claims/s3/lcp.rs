//! The normal LCP of a step: semidefinite, feasible, a quadratic program, a projection.

use crate::certificate::copositivity::copositive_plus;
use crate::certificate::feasibility::nonnegative_solution;
use crate::certificate::lcp::residuals;
use crate::checks::stewart_trinkle::{chapter_example, reference, wedge};
use crate::claims::prelude::*;
use crate::contact::delassus::delassus;
use crate::problem::Lcp;
use crate::solvers::lemke::{LemkeOutcome, lemke};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S3.psd-lcp",
        statement: "The LCP of a positive semidefinite matrix has a solution if it is feasible (and can be solved by Lemke's algorithm or \
            PGS).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "True, for symmetric and asymmetric semidefinite matrices; Lemke's method ends on a ray exactly when the LCP is \
            infeasible. On Gauss–Seidel see S3.pgs-ok.",
        argument: r"$z^T(Mz + q)$ is a convex quadratic bounded below on the feasible set, so it attains its minimum, and the optimality
            conditions make the minimum 0. Here: three semidefinite matrices (singular, singular with a skew part, skew) and all $q$ from
            $\{-3, \ldots, 3\}^2$: every feasible one solved, every infeasible one a ray.",
        controls: &[
            r"The indefinite matrix $\begin{bmatrix}-1 & 1 \\ 0 & 1\end{bmatrix}$, for which $q = (-1, 0)$ is feasible and unsolvable.",
        ],
        sources: &["chapter §3, step 5", "Cottle, Pang, Stone, The Linear Complementarity Problem, §3.1"],
        check: check!(semidefinite),
    },
    Claim {
        id: "S3.normal-solvable",
        statement: r"$W \succeq 0$ guarantees that the normal LCP of every Moreau–Jean step is solvable.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, with one coefficient $e$ for all contacts, as the chapter writes it: semidefinite is half of it,
            feasibility the other half, and with one $e$ the LCP is feasible with any redundancy. With different $e_i$ it need not be.",
        argument: r"Infeasible iff some $y \ge 0$ has $H^Ty = 0$ and $y^T \operatorname{diag}(e)\,H\,v < 0$ (Farkas). With one $e$ the
            second is $e(H^Ty)^Tv = 0$. Unit point between two walls moving at 1 into the first:
            $W = \begin{bmatrix}1 & -1 \\ -1 & 1\end{bmatrix}$, $U^- = (-1, 1)$, $e = (1, 0)$: $q = (-2, 1)$, and the rows add up to
            $0 \ge 1$. With $e = (1/2, 1/2)$ it is feasible and solvable.",
        controls: &[r"The same step with $e = (1, 0)$."],
        sources: &["chapter §3, step 5"],
        check: check!(normal_lcp),
    },
    Claim {
        id: "S3.friction-block",
        statement: "With friction the block structure is more complicated; solvability then needs the copositive-plus argument of §4.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongReason),
        evidence: Evidence::Exact,
        correct_statement: r"With friction the matrix is not copositive-plus; solvability follows from copositivity together with
            $b^T\lambda \ge 0$ on the homogeneous solutions (see S4.copos-plus, on which this depends).",
        argument: r"Neither the chapter's contact with $\mu = 1/2$ (witness $x = (0, 0, 0, 1)$) nor the wedge of two contacts with
            $\mu = 1$ is copositive-plus; yet Lemke solves both with gaps 0.",
        controls: &["Both without friction: their matrices are copositive-plus.", r"The friction row with the sign of $\mu$ wrong."],
        sources: &["chapter §3, step 5, parenthesis", "chapter §4, theorem on M_LCP"],
        check: check!(friction_block),
    },
    Claim {
        id: "S3.qp-equiv",
        statement: r"The LCP $0 \le P \perp WP + U_\text{free} \ge 0$ is the optimality condition of min
            $\tfrac12P^TWP + U_\text{free}^TP$, $P \ge 0$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"True because $W$ is symmetric and positive semidefinite.",
        argument: r"The gradient of the objective is $\tfrac12(W + W^T)P + U_\text{free}$, which is $WP + U_\text{free}$ only for
            symmetric $W$. For $W = \begin{bmatrix}2 & 1 \\ 1 & 2\end{bmatrix}$ and $U_\text{free} = (-3, -1)$ the LCP gives
            $P = (3/2, 0)$ and the conditions of the program hold there. For the asymmetric $\begin{bmatrix}2 & 1 \\ -1 & 2\end{bmatrix}$
            the LCP gives $(1, 1)$, where the gradient is $(-1, 1)$.",
        controls: &[r"The asymmetric matrix $\begin{bmatrix}2 & 1 \\ -1 & 2\end{bmatrix}$."],
        sources: &["chapter §3, the LCP as a quadratic program"],
        check: check!(quadratic_program),
    },
    Claim {
        id: "S3.projection",
        statement: r"The LCP is equivalent to a projection: $P$ projects the “unconstrained solution” of the free velocity onto the
            feasible cone; more precisely, it is the solution of the convex QP below.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: the quadratic program is the projection in the metric of $W$, where $W \succ 0$ (otherwise there
            may be no unconstrained solution, and the program remains). The Euclidean projection is wrong as soon as $W$ couples
            contacts.",
        argument: r"$W = \begin{bmatrix}2 & 1 \\ 1 & 2\end{bmatrix}$, unconstrained $P_0 = (1, -1)$, so $U_\text{free} = (-1, 1)$.
            Minimising $(P - P_0)^TW(P - P_0)$ over $P \ge 0$ gives $(1/2, 0)$, the solution of the LCP; clipping gives $(1, 0)$, where
            $WP + U_\text{free} = (1, 2)$ is not complementary.",
        controls: &[r"The Euclidean projection in place of that in the metric of $W$."],
        sources: &["chapter §3, the LCP as a quadratic program"],
        check: check!(projection),
    },
];

fn square(entries: [i64; 4]) -> DMatrix<Rational> {
    DMatrix::from_row_slice(2, 2, &entries.map(|x| ratio(x, 1)))
}

fn vector(entries: [i64; 2]) -> DVector<Rational> {
    DVector::from_row_slice(&entries.map(|x| ratio(x, 1)))
}

/// Lemke's answer with the covering vector of ones, `None` on a ray.
fn solve(lcp: &Lcp<Rational>) -> Result<Option<DVector<Rational>>> {
    Ok(match lemke(lcp, &DVector::from_element(lcp.size(), ratio(1, 1)))? {
        LemkeOutcome::Solution { z, .. } => Some(z),
        LemkeOutcome::Ray { .. } => None,
    })
}

/// Whether z ≥ 0 with Mz + q ≥ 0 exists.
fn is_feasible(lcp: &Lcp<Rational>) -> bool {
    let size = lcp.size();
    let slack = DMatrix::<Rational>::identity(size, size);
    let system = DMatrix::from_fn(size, 2 * size, |i, j| if j < size { lcp.matrix[(i, j)].clone() } else { -&slack[(i, j - size)] });
    nonnegative_solution(&system, &-&lcp.vector).point().is_some()
}

fn semidefinite(reading: Reading) -> Result<Vec<Finding>> {
    let matrices = match reading {
        Reading::Recorded => vec![square([1, -1, -1, 1]), square([1, 1, -3, 1]), square([0, 2, -2, 0])],
        Reading::Control(_) => vec![square([-1, 1, 0, 1])],
    };
    let (mut differ, mut feasible) = (0, 0);
    for matrix in &matrices {
        for q in (-3..=3).flat_map(|a| (-3..=3).map(move |b| [a, b])) {
            let lcp = Lcp::new(matrix.clone(), vector(q));
            let solution = solve(&lcp)?.filter(|z| residuals(&lcp, z).vanish());
            feasible += usize::from(is_feasible(&lcp));
            differ += usize::from(is_feasible(&lcp) != solution.is_some());
        }
    }
    Ok(vec![
        Finding::count("problems that are feasible and not solved by Lemke, or solved and not feasible", differ, 0),
        Finding::decision("both kinds occur", feasible > 0 && feasible < 49 * matrices.len(), true).context(),
    ])
}

fn normal_lcp(reading: Reading) -> Result<Vec<Finding>> {
    let jacobian = DMatrix::from_row_slice(2, 1, &[ratio(1, 1), ratio(-1, 1)]);
    let matrix = delassus(&DMatrix::identity(1, 1), &jacobian)?;
    let before = jacobian * DVector::from_element(1, ratio(-1, 1));
    let step = |restitution: [Rational; 2]| {
        let vector = &before + before.component_mul(&DVector::from_row_slice(&restitution));
        Lcp::new(matrix.clone(), vector)
    };
    let restitution = reading.pick([ratio(1, 2), ratio(1, 2)], [ratio(1, 1), ratio(0, 1)]);
    Ok(vec![
        Finding::decision("the normal LCP between two walls is feasible", is_feasible(&step(restitution.clone())), true),
        Finding::decision("Lemke's method solves it", solve(&step(restitution))?.is_some(), true),
    ])
}

fn friction_block(reading: Reading) -> Result<Vec<Finding>> {
    let mut contact = chapter_example(ratio(0, 1), [ratio(2, 1), ratio(-1, 1)]);
    let friction = |mu: Rational| reading.only(1).pick(reading.only(0).pick(mu.clone(), ratio(0, 1)), -mu);
    contact.friction = vec![friction(ratio(1, 2))];
    let mut jammed = wedge(friction(ratio(1, 1)));
    jammed.gap = vec![ratio(0, 1), ratio(0, 1)];
    jammed.free_velocity = vector([1, -2]);
    let mut findings = Vec::new();
    for (name, system) in [("one contact", &contact), ("a wedge", &jammed)] {
        let lcp = reference(system)?;
        findings
            .push(Finding::decision(format!("M_LCP is copositive-plus: {name}"), copositive_plus(&lcp.matrix)?.holds(), false).says(true));
        findings.push(Finding::decision(format!("solved by Lemke: {name}"), solve(&lcp)?.is_some(), true));
    }
    Ok(findings)
}

fn quadratic_program(reading: Reading) -> Result<Vec<Finding>> {
    let matrix = reading.pick(square([2, 1, 1, 2]), square([2, 1, -1, 2]));
    let free = vector([-3, -1]);
    let Some(impulse) = solve(&Lcp::new(matrix.clone(), free.clone()))? else {
        return Ok(vec![Finding::decision("the LCP is solved", false, true)]);
    };
    let gradient = (&matrix + matrix.transpose()) * &impulse / ratio(2, 1) + free;
    let program = |k: usize| if impulse[k].is_zero() { gradient[k].clone().min(ratio(0, 1)) } else { gradient[k].clone() };
    Ok(vec![
        Finding::exact("violated part of the gradient, entry 1", &program(0), &ratio(0, 1), "m/s"),
        Finding::exact("violated part of the gradient, entry 2", &program(1), &ratio(0, 1), "m/s"),
        Finding::exact("P₁ of the LCP", &impulse[0], &ratio(3, 2), "N·s"),
    ])
}

fn projection(reading: Reading) -> Result<Vec<Finding>> {
    let matrix = square([2, 1, 1, 2]);
    let unconstrained = vector([1, -1]);
    let lcp = Lcp::new(matrix.clone(), -(&matrix * &unconstrained));
    let solved = solve(&lcp)?.ok_or_else(|| crate::Error::breakdown("lemke", "a positive definite problem has a solution"))?;
    // Along the face P₂ = 0 the W-distance (P − P₀)ᵀW(P − P₀) has its minimum where the first row of W(P − P₀) vanishes.
    let face = &unconstrained[0] + &matrix[(0, 1)] * &unconstrained[1] / &matrix[(0, 0)];
    let metric = DVector::from_vec(vec![face, ratio(0, 1)]);
    let euclidean = unconstrained.map(|x| x.max(ratio(0, 1)));
    let projected = reading.pick(metric, euclidean);
    let by_law = residuals(&lcp, &projected);
    let apart = &projected - &solved;
    Ok(vec![
        Finding::exact("squared distance of the projection from the solution", &apart.dot(&apart), &ratio(0, 1), "N²·s²"),
        Finding::exact("complementarity of the projection", &by_law.complementarity, &ratio(0, 1), "J"),
        Finding::exact("P₁ of the solution", &solved[0], &ratio(1, 2), "N·s").context(),
    ])
}
