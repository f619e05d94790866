//! How many solutions a step has, what σ is, and where solutions have kinks.

use super::matrices::{chapter_matrix, integers};
use super::painleve::velocities;
use crate::certificate::p_matrix::p_matrix;
use crate::checks::stewart_trinkle::{chapter_example, reference};
use crate::claims::experiments::painleve::rod;
use crate::claims::prelude::*;
use crate::contact::delassus::delassus;
use crate::problem::{Lcp, PlanarProblem};
use crate::solvers::enumeration::{SolutionSet, all_solutions};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S4.sigma",
        statement: r"$\sigma$ is the slip rate: $\sigma = 0$ when sticking (inside the friction cone), $\sigma > 0$ when sliding (on its
            boundary, friction at its maximum).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"$\sigma = \max(-d_j\cdot v^+)$: the slip rate in the plane and along a direction of the polyhedron, less
            between two, down to $\cos(\pi/d)$ of it. Sticking has $\sigma = 0$ also on the boundary of the cone. At an open contact,
            which neither sticks nor slides, every $\sigma \ge \max(-d_j\cdot v^+)$ is a solution, and $\sigma$ says nothing.",
        argument: r"Unit point mass, $\mu = 1/2$, all solutions enumerated. Free velocity $(2, -1)$ at $\varphi = 0$: one solution,
            $\sigma = 3/2 = |v_t^+|$. $(1/4, -1)$: sticks, $\sigma = 0$ in every solution. $(1/2, -1)$: sticks on the boundary,
            $\sigma = 0$. Open ($\varphi/h = 10$, free velocity $(2, 0)$): $\lambda = \beta = 0$ and the family $\sigma \ge 2$. In space,
            friction along the axes, free velocity $(2, 2)$ and −1 along the normal: one solution, $\sigma = 7/4$, and $\sigma^2$ is half
            of $|v_t^+|^2$.",
        controls: &[
            "The open contact in place of the one that slides.",
            "A slide at 2 m/s in place of what sticks.",
            "A slip along a direction in place of one between two.",
        ],
        sources: &["chapter §4, reading of the complementarity μλ_n − Eᵀβ ≥ 0 ⟂ σ ≥ 0"],
        check: check!(slip_speed),
    },
    Claim {
        id: "S4.nonunique",
        statement: "Existence is not uniqueness: in simultaneous contacts (three balls at once, the four corners of a block) the LCP may \
            have several solutions, and solvers may differ.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"Several solutions arise with friction or redundant contacts: $\sigma$ at an open contact, $\beta$ when
            sticking, impulses (not velocities) of a block on four frictionless corners, and even velocities for Painlevé's rod. The
            frictionless three-ball chain has exactly one solution; its ambiguity lies in the impact law.",
        argument: r"Painlevé's rod (cos $= 3/5$, $\mu = 2$, free normal velocity 1/10) has 3 solutions with 3 different velocities after
            the step. Four corners $(1, \pm1, \pm1)$: $W$ has rank 3, the impulses form a family, $W\cdot P$ is the same for all. Three
            equal balls in a row: $W = \begin{bmatrix}2 & -1 \\ -1 & 2\end{bmatrix}$ has minors 2, 2, $3 > 0$, so one solution for every
            $q$.",
        controls: &[
            r"The four corners in place of the three-ball row: not a $P$-matrix.",
            r"$\mu = 1$ in place of 2 for the rod, and one corner of the block fewer.",
        ],
        sources: &["chapter §4, pitfall “solvable means unique”"],
        check: check!(several_solutions),
    },
    Claim {
        id: "S4.pmatrix",
        statement: r"Uniqueness needs a stronger condition, for instance that $M_\text{LCP}$ is a $P$-matrix.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, for any LCP. A Stewart–Trinkle matrix is never a $P$-matrix: its diagonal entry at $\sigma$ is
            0.",
        argument: r"Principal minor $\{\sigma\} = 0$, whatever $\mu$ and $\tilde W$. Uniqueness can only be had for velocities or in the
            absence of friction.",
        controls: &[r"The matrix $(1, 2; 2, 1)$, which is no $P$-matrix, in place of that of three balls."],
        sources: &["chapter §4, pitfall “solvable means unique”", "Cottle, Pang, Stone, The Linear Complementarity Problem, §3.3"],
        check: check!(never_p),
    },
    Claim {
        id: "S4.lcp-kink",
        statement: "LCP solutions are not differentiable where the active set changes.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As a function of $q$ the solution is piecewise linear; its one-sided derivatives differ where the active set
            changes.",
        argument: r"$W = 1$: $\lambda(q) = \max(0, -q)$. At $q = 0$ the left slope is −1, the right slope 0; at $q = -1$, inside one
            active set, both are −1.",
        controls: &[r"A point inside one active set, $q = -1$.", r"A point inside the other, $q = 1$."],
        sources: &["chapter §4, summary"],
        check: check!(kink),
    },
];

fn slip_speed(reading: Reading) -> Result<Vec<Finding>> {
    // all solutions and the sliding speed after the step
    let step = |gap: Rational, velocity: [Rational; 2]| -> Result<(SolutionSet, Rational)> {
        let system = chapter_example(gap, velocity);
        let set = all_solutions(&reference(&system)?)?;
        let after = velocities(&system, &set).remove(0);
        Ok((set, after[0].clone()))
    };
    let closing = |speed: Rational| step(ratio(0, 1), [speed, ratio(-1, 1)]);
    let (open, speed) = step(ratio(10, 1), [ratio(2, 1), ratio(0, 1)])?;
    let (sliding, slip) = reading.only(0).pick(closing(ratio(2, 1))?, (open.clone(), speed));
    let slower = |speed: Rational| closing(reading.only(1).pick(speed, ratio(2, 1)));
    let (sticking, _) = slower(ratio(1, 4))?;
    let (boundary, _) = slower(ratio(1, 2))?;
    let [sigma, share] = sigma_in_space(reading.only(2).pick([2, 2], [2, 0]))?;
    Ok(vec![
        Finding::exact("σ of a slide that 2 m/s less μ times 1 m/s leave", &least_sigma(&sliding), &ratio(3, 2), "m/s"),
        Finding::exact("its speed", &slip, &ratio(3, 2), "m/s"),
        Finding::decision("its σ varies", moves(&sliding, 3), false),
        Finding::decision("σ = 0 in every solution when sticking", vanishes(&sticking, 3), true),
        Finding::decision("σ = 0 when sticking on the boundary", vanishes(&boundary, 3), true),
        Finding::exact("σ² over |v_t⁺|², slip between two directions", &share, &ratio(1, 2), "1")
            .says(ratio(1, 1))
            .violating("a slip along a direction of the polyhedron"),
        Finding::exact("σ there", &sigma, &ratio(7, 4), "m/s").context(),
        Finding::decision("σ varies at an open contact", moves(&open, 3), true).context(),
    ])
}

/// σ, and σ² over |v_t⁺|², of a unit point mass on a floor, μ = 1/2, that arrives at 1 m/s with this slip, friction along the axes.
fn sigma_in_space([x, y]: [i64; 2]) -> Result<[Rational; 2]> {
    let axes = [[1, 0], [0, 1], [-1, 0], [0, -1]].map(|[x, y]| [ratio(x, 1), ratio(y, 1)]);
    let unit = DMatrix::from_fn(3, 3, |i, j| ratio(i64::from(i == j), 1));
    let free = integers(&[-1, x, y]);
    let problem = PlanarProblem::new(unit, free.clone()).polyhedral(&[ratio(1, 2)], &axes)?;
    let set = all_solutions(&problem.lcp)?;
    let [z] = &set.points[..] else { return Err(Error::Unsupported(format!("{} solutions", set.points.len()))) };
    let after = problem.impulse(z) + free;
    let sigma = z[5].clone();
    let speed = &after[1] * &after[1] + &after[2] * &after[2];
    Ok([sigma.clone(), &sigma * &sigma / speed])
}

fn least_sigma(set: &SolutionSet) -> Rational {
    let all = set.points.iter().map(|z| z[3].clone());
    all.reduce(|least, sigma| if sigma < least { sigma } else { least }).unwrap_or_else(|| ratio(-1, 1))
}

/// Whether a component varies within a family of solutions.
fn moves(set: &SolutionSet, component: usize) -> bool {
    set.families.iter().any(|family| !family.direction[component].is_zero())
}

fn vanishes(set: &SolutionSet, component: usize) -> bool {
    !set.is_empty() && !moves(set, component) && set.points.iter().all(|z| z[component].is_zero())
}

/// W of three equal balls in a row, two contacts.
fn three_balls() -> Result<DMatrix<Rational>> {
    delassus(&DMatrix::identity(3, 3), &DMatrix::from_row_slice(2, 3, &[-1, 1, 0, 0, -1, 1].map(|x| ratio(x, 1))))
}

/// W of the four corners (1, ±1, ±1) of a block, unit mass and inertia, no friction.
fn four_corners() -> Result<DMatrix<Rational>> {
    delassus(&DMatrix::identity(3, 3), &DMatrix::from_row_slice(4, 3, &[1, 1, 1, 1, 1, -1, 1, -1, 1, 1, -1, -1].map(|x| ratio(x, 1))))
}

fn several_solutions(reading: Reading) -> Result<Vec<Finding>> {
    let system = rod(reading.only(1).pick(ratio(2, 1), ratio(1, 1)), ratio(1, 10));
    let velocities = velocities(&system, &all_solutions(&reference(&system)?)?);
    let corners = reading.only(1).pick(4, 3);
    let redundant = four_corners()?.view((0, 0), (corners, corners)).into_owned();
    let row = reading.only(0).pick(three_balls()?, redundant.clone());
    let closing = DVector::from_element(redundant.nrows(), ratio(-1, 1));
    let set = all_solutions(&Lcp::new(redundant.clone(), closing))?;
    let same = set.points.windows(2).all(|pair| &redundant * &pair[0] == &redundant * &pair[1]);
    Ok(vec![
        Finding::count("different velocities of Painlevé's rod after the step", velocities.len(), 3),
        Finding::decision("impulses of a block on four corners form a family", !set.families.is_empty(), true),
        Finding::decision("their velocity W P is the same", same, true).context(),
        Finding::decision("three balls in a row: P-matrix, so unique for every q", p_matrix(&row)?.holds(), true)
            .says(false)
            .violating("friction, or redundant contacts"),
    ])
}

fn never_p(reading: Reading) -> Result<Vec<Finding>> {
    let matrix = chapter_matrix()?;
    let minor = p_matrix(&matrix)?.witness();
    let at_sigma = &matrix[(matrix.nrows() - 1, matrix.nrows() - 1)];
    let row = reading.pick(three_balls()?, DMatrix::from_row_slice(2, 2, &[1, 2, 2, 1].map(|x| ratio(x, 1))));
    let mut not_unique = 0;
    for q in (-2..=2).flat_map(|a| (-2..=2).map(move |b| integers(&[a, b]))) {
        not_unique += usize::from(!all_solutions(&Lcp::new(row.clone(), q))?.is_unique());
    }
    Ok(vec![
        Finding::decision("M_LCP is a P-matrix", minor.is_none(), false).context(),
        Finding::exact("diagonal entry at σ", at_sigma, &ratio(0, 1), "1").context(),
        Finding::decision("the matrix of three balls in a row, without friction, is a P-matrix", p_matrix(&row)?.holds(), true),
        Finding::count("vectors q, of 25, for which it has not exactly one solution", not_unique, 0),
    ])
}

fn kink(reading: Reading) -> Result<Vec<Finding>> {
    let center = reading.only(1).pick(reading.only(0).pick(ratio(0, 1), ratio(-1, 1)), ratio(1, 1));
    let offset = ratio(1, 1000);
    let solution = |q: Rational| -> Result<Rational> {
        let set = all_solutions(&Lcp::new(DMatrix::from_element(1, 1, ratio(1, 1)), DVector::from_element(1, q)))?;
        Ok(set.points[0][0].clone())
    };
    let at = solution(center.clone())?;
    let right = (solution(&center + &offset)? - &at) / &offset;
    let left = (at - solution(&center - &offset)?) / &offset;
    Ok(vec![
        Finding::exact("slope to the left of the change", &left, &ratio(-1, 1), "1"),
        Finding::exact("slope to the right of the change", &right, &integers(&[0])[0], "1"),
    ])
}
