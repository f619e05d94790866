//! Copositive, and copositive-plus only without friction.

use super::matrices::{chapter_matrix, integers, jamming_matrix, reversed};
use crate::certificate::copositivity::{copositive, copositive_plus};
use crate::certificate::definiteness::{Definiteness, definiteness, quadratic_form};
use crate::certificate::feasibility::nonnegative_solution;
use crate::checks::stewart_trinkle::{RationalStep, chapter_example, reference, wedge};
use crate::claims::prelude::*;
use crate::problem::Lcp;
use crate::solvers::enumeration::all_solutions;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S4.cp-def",
        statement: r"$N$ is copositive-plus if (i) $x \ge 0$ implies $x^TNx \ge 0$ and (ii) $x \ge 0$ with $x^TNx = 0$ implies
            $(N + N^T)x = 0$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Definition,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "This is the standard definition.",
        argument: r"$\begin{bmatrix}0 & 1 \\ 0 & 0\end{bmatrix}$ is copositive (form $x_1x_2$) but $x = (1, 0)$ has form 0 and
            $(N + N^T)x = (0, 1)$: part (ii) excludes it. $\begin{bmatrix}1 & -1 \\ -1 & 1\end{bmatrix}$ and
            $\begin{bmatrix}0 & 1 \\ -1 & 0\end{bmatrix}$ satisfy both parts.",
        controls: &["Part (i) alone.", "Positive definite in place of copositive-plus.", r"A look at the axes alone, a diagonal $\ge 0$."],
        sources: &["chapter §4, definition before the theorem on M_LCP", "Cottle, Pang, Stone, The Linear Complementarity Problem, §3.8"],
        check: check!(definition),
    },
    Claim {
        id: "S4.copos",
        statement: r"$M_\text{LCP}$ is copositive (part (i) of the theorem).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"$M_\text{LCP}$ is copositive for every $\mu \ge 0$, any number of contacts and any redundancy.",
        argument: r"$x^TM\,x = x_1^T\tilde Wx_1 + \sum\mu_i\lambda_i\sigma_i$ is a sum of two terms that are $\ge 0$ for $x \ge 0$
            ($x_1 = (\lambda, \beta)$). Decided exactly here for the chapter's contact, a wedge of two contacts and the jamming $4\times4$
            matrix; on a thousand random systems in the property family.",
        controls: &[r"The last row with reversed sign, $(-\mu, E^T)$."],
        sources: &["chapter §4, theorem on M_LCP, part (i)"],
        check: check!(copositivity),
    },
    Claim {
        id: "S4.copos-plus",
        statement: r"Theorem (the chapter attributes it to Anitescu and Potra 1997): the Stewart–Trinkle matrix $M_\text{LCP}$ is
            copositive-plus.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::BrokenTheorem),
        evidence: Evidence::Exact,
        correct_statement: r"$M_\text{LCP}$ is copositive; it is copositive-plus if and only if every $\mu$ is 0. Solvability rests on
            something else: with $q = (n^Tv + b, D^Tv, 0)$, $v$ the free velocity and $b = \varphi/h$, if $b^T\lambda \ge 0$ for all
            $\lambda$, $\beta \ge 0$ with $n\lambda + D\beta = 0$ and $E^T\beta \le \mu\lambda$ – true if all gaps are $\ge 0$, or if the
            friction cone is pointed – the LCP has a solution and lexicographic Lemke with any covering vector $d > 0$ finds one.",
        argument: r"Witness in the chapter's own $4\times4$ example ($\mu = 1/2$): $x = (0, 0, 0, 1) \ge 0$ has $x^TMx = 0$ but
            $(M + M^T)x = (1/2, 0, 0, 0) \ne 0$. In general $x = (0, 0, \sigma)$ gives $(M + M^T)x = (\mu\sigma, 0, 0)$. No scaling or
            sign convention removes it. If every $\mu$ is 0 then $x^TMx = x_1^T\tilde Wx_1$ with $\tilde W \succeq 0$, and $M$ is
            copositive-plus. Proof of the corrected theorem: on a secondary ray the direction $\hat x = (\lambda, \beta, \sigma)$
            satisfies $\hat x^TM\hat x = 0$ and $M\hat x \ge 0$, hence $n\lambda + D\beta = 0$, and $\hat x^Tq < 0$; but
            $\hat x^Tq = v^T(n\lambda + D\beta) + b^T\lambda = b^T\lambda \ge 0$. This refutes the chapter's theorem, not the paper, which
            was not read.",
        controls: &[
            r"The matrix whose quadratic form is the one the chapter's proof computes ($\mu$ missing from the last row): it is
                copositive-plus.",
            r"The last row with reversed sign, $(-\mu, E^T)$.",
        ],
        sources: &["chapter §4, theorem on M_LCP", "proof: module certificate::existence"],
        check: check!(not_plus),
    },
    Claim {
        id: "S4.quadratic-general",
        statement: r"Proof and exercise 2: $x^TM_\text{LCP}\,x = x_1^T\tilde Wx_1$, because the friction row and the tangential column
            cancel; and $x^TMx = 0$ implies $(M + M^T)x = 0$.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"$x^TM_\text{LCP}\,x = x_1^T\tilde Wx_1 + \sum\mu_i\lambda_i\sigma_i$: only $+E$ against $-E^T$ cancels, $\mu$
            has no partner. Copositivity follows all the same; the second implication does not, and falls with S4.copos-plus.",
        argument: r"In the wedge of two contacts with $\mu = 1/2$ and $x = (1, \ldots, 1)$ the form exceeds $x_1^T\tilde Wx_1$ by
            $\mu_1 + \mu_2 = 1$. At $x = (0, 0, \sigma)$ it vanishes with $(M + M^T)x = (\mu\sigma, 0, 0)$.",
        controls: &[r"The matrices without $\mu$ in their last rows, for which the printed identity and its consequence hold."],
        sources: &["chapter §4, exercise 2, and the proof of the theorem on M_LCP (whose display is not legible in the source)"],
        check: check!(general_form),
    },
    Claim {
        id: "S4.cps-thm",
        statement: "By a theorem of Cottle, Pang and Stone, an LCP with a copositive-plus matrix that is feasible has a solution.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "True; but it does not apply to the Stewart–Trinkle LCP with friction, whose matrix is not copositive-plus.",
        argument: r"A secondary ray of Lemke's method would give $x \ge 0$ with $x^TMx = 0$, $Mx \ge 0$ and $x^Tq < 0$; (ii) turns
            $Mx \ge 0$ into $M^Tx \le 0$, so $x^T(Mz + q) < 0$ for every $z \ge 0$, against feasibility. Here: three copositive-plus
            matrices with all $q$ from $\{-2, \ldots, 2\}^2$, every feasible one solved. The merely copositive $4\times4$ matrix of a
            jammed contact has a feasible $q$ without solution.",
        controls: &[r"The merely copositive $4\times4$ matrix with $q = (-1, 0, 0, 0)$."],
        sources: &["chapter §4, corollary “every step is solvable”", "Cottle, Pang, Stone, The Linear Complementarity Problem, §3.8"],
        check: check!(feasible_is_solvable),
    },
];

fn square(entries: [i64; 4]) -> DMatrix<Rational> {
    DMatrix::from_row_slice(2, 2, &entries.map(|x| ratio(x, 1)))
}

fn definition(reading: Reading) -> Result<Vec<Finding>> {
    let accepts = |matrix: DMatrix<Rational>| -> Result<bool> {
        Ok(match reading {
            Reading::Recorded => copositive_plus(&matrix)?.holds(),
            Reading::Control(0) => copositive(&matrix)?.holds(),
            Reading::Control(1) => definiteness(&matrix) == Definiteness::Definite,
            Reading::Control(_) => matrix.diagonal().iter().all(|entry| *entry >= ratio(0, 1)),
        })
    };
    Ok(vec![
        Finding::decision("[[0, 1], [0, 0]] is accepted", accepts(square([0, 1, 0, 0]))?, false),
        Finding::decision("[[1, −1], [−1, 1]] is accepted", accepts(square([1, -1, -1, 1]))?, true),
        Finding::decision("[[0, 1], [−1, 0]] is accepted", accepts(square([0, 1, -1, 0]))?, true),
        Finding::decision("[[1, −2], [−2, 1]] is accepted", accepts(square([1, -2, -2, 1]))?, false),
    ])
}

fn copositivity(reading: Reading) -> Result<Vec<Finding>> {
    let matrices = [
        ("one contact", chapter_matrix()?, 1),
        ("a wedge", reference(&wedge(ratio(1, 2)))?.matrix, 2),
        ("a jamming contact", jamming_matrix(), 1),
    ];
    let mut findings = Vec::new();
    for (name, matrix, contacts) in matrices {
        let matrix = reading.pick(matrix.clone(), reversed(matrix, contacts));
        findings.push(Finding::decision(format!("copositive: {name}"), copositive(&matrix)?.holds(), true));
    }
    Ok(findings)
}

fn not_plus(reading: Reading) -> Result<Vec<Finding>> {
    let with_friction = reading.only(1).pick(chapter_matrix()?, reversed(chapter_matrix()?, 1));
    let mut without_friction = with_friction.clone();
    without_friction[(3, 0)] = ratio(0, 1);
    let matrix = reading.only(0).pick(with_friction, without_friction.clone());
    let witness = integers(&[0, 0, 0, 1]);
    let image = (&matrix + matrix.transpose()) * &witness;
    Ok(vec![
        Finding::exact("first entry of (M + Mᵀ)x at x = (0, 0, 0, 1)", &image[0], &ratio(1, 2), "1").says(ratio(0, 1)),
        Finding::exact("xᵀMx there", &quadratic_form(&matrix, &witness), &ratio(0, 1), "J").context(),
        Finding::decision("copositive-plus, μ = 1/2", copositive_plus(&matrix)?.holds(), false).says(true),
        Finding::decision("copositive, μ = 1/2", copositive(&matrix)?.holds(), true),
        Finding::decision("copositive-plus, μ = 0", copositive_plus(&without_friction)?.holds(), true),
    ])
}

fn general_form(reading: Reading) -> Result<Vec<Finding>> {
    let systems: [RationalStep; 2] = [wedge(ratio(1, 2)), chapter_example(ratio(0, 1), [ratio(0, 1), ratio(0, 1)])];
    let mut findings = Vec::new();
    for (system, place) in systems.iter().zip(["wedge", "one contact"]) {
        let mut matrix = reference(system)?.matrix;
        let impulses = system.sigma(0);
        if reading.is_control() {
            (0..system.contacts()).for_each(|i| matrix[(system.sigma(i), system.lambda(i))] = ratio(0, 1));
        }
        let block = matrix.view((0, 0), (impulses, impulses)).into_owned();
        let ones = DVector::from_element(system.unknowns(), ratio(1, 1));
        let rising = DVector::from_fn(system.unknowns(), |i, _| ratio(i as i64 + 1, 2));
        for (x, name) in [(ones, "(1, …, 1)"), (rising, "(1, 2, 3, …)/2")] {
            let cross = (0..system.contacts()).fold(ratio(0, 1), |sum, i| sum + &system.friction[i] * &x[i] * &x[system.sigma(i)]);
            let rest = quadratic_form(&matrix, &x) - quadratic_form(&block, &x.rows(0, impulses).into_owned());
            findings.push(Finding::exact(format!("xᵀMx − x₁ᵀW̃x₁, {place}, x = {name}"), &rest, &cross, "J").says(ratio(0, 1)));
        }
        let slip = DVector::from_fn(system.unknowns(), |i, _| ratio(i64::from(i == impulses), 1));
        let image = (&matrix + matrix.transpose()) * &slip;
        findings
            .push(Finding::exact(format!("xᵀMx at x = (0, 0, σ), {place}"), &quadratic_form(&matrix, &slip), &ratio(0, 1), "J").context());
        findings.push(
            Finding::exact(format!("first entry of (M + Mᵀ)x there, {place}"), &image[0], &system.friction[0], "1").says(ratio(0, 1)),
        );
    }
    Ok(findings)
}

fn feasible_is_solvable(reading: Reading) -> Result<Vec<Finding>> {
    let problems: Vec<Lcp<Rational>> = match reading {
        Reading::Recorded => {
            let matrices = [[1, -1, -1, 1], [0, 1, -1, 0], [1, 4, 0, 1]].map(square);
            let vectors = (-2..=2).flat_map(|a| (-2..=2).map(move |b| integers(&[a, b])));
            let pairs = vectors.flat_map(|q| matrices.clone().map(|matrix| (matrix, q.clone())));
            pairs.map(|(matrix, vector)| Lcp::new(matrix, vector)).collect()
        }
        Reading::Control(_) => vec![Lcp::new(jamming_matrix(), integers(&[-1, 0, 0, 0]))],
    };
    let (mut feasible, mut unsolved) = (0, 0);
    for lcp in &problems {
        if is_feasible(lcp) {
            feasible += 1;
            unsolved += usize::from(all_solutions(lcp)?.is_empty());
        }
    }
    Ok(vec![
        Finding::count("feasible problems without a solution", unsolved, 0),
        Finding::decision("there are feasible problems among them", feasible > 0, true).context(),
    ])
}

/// Whether z ≥ 0 with M z + q ≥ 0 exists.
pub(super) fn is_feasible(lcp: &Lcp<Rational>) -> bool {
    let size = lcp.size();
    // M z − w = −q with z, w ≥ 0.
    let system =
        DMatrix::from_fn(size, 2 * size, |i, j| if j < size { lcp.matrix[(i, j)].clone() } else { ratio(-i64::from(i == j - size), 1) });
    nonnegative_solution(&system, &-&lcp.vector).point().is_some()
}
