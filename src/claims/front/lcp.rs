//! Existence, uniqueness and PGS for the LCPs of a step, in the tables and the project.

use crate::certificate::copositivity::copositive_plus;
use crate::certificate::definiteness::positive_semidefinite;
use crate::claims::experiments::painleve::answers;
use crate::claims::prelude::*;
use crate::contact::delassus::delassus;
use crate::problem::{ContactProblem, Law, Lcp, PlanarProblem};
use crate::solvers::enumeration::all_solutions;
use crate::solvers::lemke::{LemkeOutcome, lemke};
use crate::solvers::{ContactSolver, ProjectedGaussSeidel};
use crate::tolerance::claims::lcp::SWEEP_VELOCITY;

/// Claims of the preface and the project.
pub const PREFACE: &[Claim] = &[Claim {
    id: "P.pgs",
    statement: r"Module A of the project: PGS solves the Delassus LCP $0 \le U = WP + U_\text{free} \perp P \ge 0$ of every step.",
    verdict: ClaimVerdict::True,
    kind: Kind::Exercise,
    severity: None,
    evidence: Evidence::Certified,
    correct_statement: r"As stated, since $W \succeq 0$ with a positive diagonal, as the contacts of free bodies have it (S3.pgs-ok speaks
        of any semidefinite $W$); with redundant contacts the impulses depend on the start, and only the velocity $U$ is unique.",
    argument: r"Block on four frictionless corners $(1, \pm1, \pm1)$, $W$ of rank 3, $U_\text{free} = -1$: from $P = 0$ and from
        $P = (1, 0, 0, 1)$ PGS reaches a solution, $\min(P, U) = 0$ entry by entry, with the same velocity $U = 0$ and different
        impulses.",
    controls: &["A single sweep."],
    sources: &["chapter, cumulative project, module A"],
    check: check!(gauss_seidel),
}];

/// Claims of the table of misconceptions.
pub const MISCONCEPTIONS: &[Claim] = &[Claim {
    id: "M.lcp-nonunique",
    statement: "Misconception “solvable means uniquely solvable”: copositive-plus guarantees existence only; where several bodies collide \
        at once the LCP may have several solutions, and changing the solver changes the result.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Exact,
    correct_statement: "Copositive-plus and feasible gives existence, not uniqueness. Without friction several solutions have different \
        impulses and one velocity; the motion changes with the solver only where friction acts (S4.nonunique). (The Stewart–Trinkle \
        matrix itself is not copositive-plus with friction, see S4.copos-plus.)",
    argument: r"Unit mass on two equal contacts: $W = \begin{bmatrix}1 & 1 \\ 1 & 1\end{bmatrix}$ is semidefinite, hence copositive-plus;
        with $q = (-1, -1)$ every $z \ge 0$ with $z_1 + z_2 = 1$ is a solution, and all have $v^+ = -1 + z_1 + z_2 = 0$. With friction:
        Painlevé's rod, $\mu = 2$, tip separating at 1/10 m/s, has 3 solutions with 3 different normal impulses.",
    controls: &[
        r"Three balls in a row, $W = \begin{bmatrix}2 & -1 \\ -1 & 2\end{bmatrix}$, where the solution is unique.",
        "Two opposite contacts that both close: no solution.",
        r"The Stewart–Trinkle matrix of one contact with $\mu = \tfrac12$ in the place of $W$.",
        r"$\mu = 1$ on the rod: one solution.",
    ],
    sources: &["chapter, table of misconceptions"],
    check: check!(existence_only),
}];

/// Claims of the tables of theorems.
pub const TABLES: &[Claim] = &[Claim {
    id: "T.delassus-psd",
    statement: r"$W = HM^{-1}H^T \succeq 0$ because $M \succ 0$, hence the normal LCP is solvable.",
    verdict: ClaimVerdict::True,
    kind: Kind::Assertion,
    severity: None,
    evidence: Evidence::Exact,
    correct_statement: r"True for the LCP of a step with one restitution coefficient, $q = H(v_\text{free} + e\,v)$: it is always
        feasible, and feasible with $W \succeq 0$ is solvable.",
    argument: r"If no $z \ge 0$ had $Wz + q \ge 0$, Farkas would give $y \ge 0$ with $Wy \le 0$ and $q^Ty < 0$; then $y^TWy \le 0$, so
        $H^Ty = 0$ and $q^Ty = (v_\text{free} + ev)^TH^Ty = 0$. Eight contacts of a block with three velocities, all velocities from
        $\{-2, \ldots, 2\}^3$ and $e = 1/2$: $W \succeq 0$, and the LCP of each velocity is solved exactly. (With different coefficients
        it may fail, see S3.normal-solvable.)",
    controls: &[
        r"Data $q$ that is not of the form $Hv$: two opposite contacts that both close at 1.",
        r"A mass matrix that is not definite, $\operatorname{diag}(1, 1, -1)$.",
    ],
    sources: &["chapter, table of theorems", "Cottle, Pang, Stone, The Linear Complementarity Problem, §3.1"],
    check: check!(normal_lcp),
}];

fn existence_only(reading: Reading) -> Result<Vec<Finding>> {
    let integers = |rows, columns, entries: &[i64]| DMatrix::from_row_iterator(rows, columns, entries.iter().map(|&x| ratio(x, 1)));
    let jacobian = match reading {
        Reading::Control(0) => integers(2, 3, &[-1, 1, 0, 0, -1, 1]),
        Reading::Control(1) => integers(2, 1, &[1, -1]),
        _ => integers(2, 1, &[1, 1]),
    };
    let matrix = &jacobian * jacobian.transpose();
    let frictional = PlanarProblem::new(DMatrix::identity(2, 2), DVector::from_element(2, ratio(-1, 1))).coulomb(&[ratio(1, 2)])?;
    let plus = copositive_plus(reading.only(2).pick(&matrix, &frictional.lcp.matrix))?.holds();
    let rod = answers(&reading.only(3).pick(ratio(2, 1), ratio(1, 1)), &ratio(1, 10))?;
    let set = all_solutions(&Lcp::new(matrix, DVector::from_element(2, ratio(-1, 1))))?;
    let mut changes: Vec<DVector<Rational>> = Vec::new();
    for impulse in &set.points {
        let change = jacobian.transpose() * impulse;
        if !changes.contains(&change) {
            changes.push(change);
        }
    }
    Ok(vec![
        Finding::decision("the solution is unique", set.is_unique(), false),
        Finding::decision("the matrix is copositive-plus", plus, true),
        Finding::decision("a solution exists", !set.is_empty(), true),
        Finding::count("different velocities among the solutions", changes.len(), 1)
            .says_at_least(2usize)
            .violating("friction acts at the contacts"),
        Finding::count("different normal impulses of the rod, with friction", rod.len(), 3).says_at_least(2usize),
    ])
}

/// Normal rows (1, x, y) of eight points of a block; more than it has velocities.
fn eight_contacts() -> DMatrix<Rational> {
    let points = [[1, 1], [1, -1], [-1, 1], [-1, -1], [2, 0], [0, 2], [-2, 0], [0, 0]];
    DMatrix::from_fn(8, 3, |i, j| ratio(if j == 0 { 1 } else { points[i][j - 1] }, 1))
}

fn normal_lcp(reading: Reading) -> Result<Vec<Finding>> {
    let restitution = ratio(1, 2);
    let problems: Vec<Lcp<Rational>> = match reading {
        Reading::Control(0) => {
            let matrix = DMatrix::from_row_slice(2, 2, &[1, -1, -1, 1].map(|x| ratio(x, 1)));
            vec![Lcp::new(matrix, DVector::from_element(2, ratio(-1, 1)))]
        }
        _ => {
            let (jacobian, third) = (eight_contacts(), reading.only(1).pick(1, -1));
            let inverse_mass = DMatrix::from_diagonal(&DVector::from_row_slice(&[1, 1, third].map(|x| ratio(x, 1))));
            let matrix = &jacobian * inverse_mass * jacobian.transpose();
            let grid = (0..125i64).map(|k| DVector::from_row_slice(&[k % 5 - 2, k / 5 % 5 - 2, k / 25 - 2].map(|x| ratio(x, 1))));
            // v_free = v: q = H(v + e v).
            grid.map(|v| Lcp::new(matrix.clone(), &jacobian * v * (ratio(1, 1) + &restitution))).collect()
        }
    };
    let mut unsolved = 0;
    for lcp in &problems {
        let outcome = lemke(lcp, &DVector::from_element(lcp.size(), ratio(1, 1)))?;
        unsolved += usize::from(matches!(outcome, LemkeOutcome::Ray { .. }));
    }
    Ok(vec![
        Finding::count("normal LCPs without a solution", unsolved, 0),
        Finding::decision("W ⪰ 0", positive_semidefinite(&problems[0].matrix).holds(), true),
    ])
}

fn gauss_seidel(reading: Reading) -> Result<Vec<Finding>> {
    let jacobian = DMatrix::from_row_slice(4, 3, &[1.0, 1.0, 1.0, 1.0, 1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0, -1.0]);
    let problem = ContactProblem::new(delassus(&DMatrix::identity(3, 3), &jacobian)?, DVector::from_element(4, -1.0))
        .name("block on four corners")
        .law(Law::Frictionless)
        .rows_per_contact(1)
        .build()?;
    let converged = ProjectedGaussSeidel::default();
    let solver = reading.pick(converged, ProjectedGaussSeidel { sweeps: 1, ..converged });
    let mut findings = Vec::new();
    let mut impulses = Vec::new();
    for (name, start) in [("P = 0", DVector::zeros(4)), ("P = (1, 0, 0, 1)", dvector![1.0, 0.0, 0.0, 1.0])] {
        let answer = solver.solve(&problem, Some(&start))?;
        // 0 ≤ U ⟂ P ≥ 0 is min(P, U) = 0; one unit of each is taken as equal
        let residual = answer.impulse.zip_map(&answer.velocity, f64::min).amax();
        findings.push(Finding::equal(format!("largest |min(P, U)| from {name}"), residual, 0.0, SWEEP_VELOCITY, "N·s or m/s"));
        findings.push(Finding::equal(format!("largest |U| from {name}"), answer.velocity.amax(), 0.0, SWEEP_VELOCITY, "m/s"));
        impulses.push(answer.impulse);
    }
    let apart = (&impulses[0] - &impulses[1]).amax();
    findings.push(Finding::decision("the impulses differ", apart > SWEEP_VELOCITY, true).context());
    Ok(findings)
}
