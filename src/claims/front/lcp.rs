//! Existence, uniqueness and PGS for the LCPs of a step, in the tables and the project.

use crate::Result;
use crate::certificate::copositivity::copositive_plus;
use crate::certificate::definiteness::positive_semidefinite;
use crate::checks::Finding;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::contact::delassus::delassus;
use crate::problem::{ContactProblem, Law, Lcp};
use crate::scalar::{Rational, ratio};
use crate::solvers::enumeration::all_solutions;
use crate::solvers::lemke::{LemkeOutcome, lemke};
use crate::solvers::{ContactSolver, ProjectedGaussSeidel};
use crate::tolerance::claims::lcp::SWEEP_VELOCITY;
use nalgebra::{DMatrix, DVector, dvector};

/// Claims of the preface and the project.
pub const PREFACE: &[Claim] = &[Claim {
    id: "P.pgs",
    statement: "Module A of the project: PGS solves the Delassus LCP 0 ≤ U = WP + U_free ⟂ P ≥ 0 of every step.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Certified,
    correct_statement: "PGS converges for W ⪰ 0 with positive diagonal; with redundant contacts the impulses depend on the start and only \
        the velocity U is unique.",
    argument: "Block on four frictionless corners (1, ±1, ±1), W of rank 3, U_free = −1: from P = 0 and from P = (1, 0, 0, 1) PGS reaches \
        the same velocity U = 0 with different impulses.",
    control: "Impulses compared in place of velocities.",
    sources: &["chapter, cumulative project, module A"],
    check: gauss_seidel,
}];

/// Claims of the table of misconceptions.
pub const MISCONCEPTIONS: &[Claim] = &[Claim {
    id: "M.lcp-nonunique",
    statement: "Misconception “solvable means uniquely solvable”: copositive-plus guarantees existence only; where several bodies collide \
        at once the LCP may have several solutions, and changing the solver changes the result.",
    verdict: ClaimVerdict::True,
    kind: Kind::Assertion,
    severity: None,
    evidence: Evidence::Exact,
    correct_statement: "Copositive-plus and feasible gives existence, not uniqueness. (The Stewart–Trinkle matrix itself is not \
        copositive-plus with friction, see S4.copos-plus.)",
    argument: "W = [[1, 1], [1, 1]] is semidefinite, hence copositive-plus; with q = (−1, −1) every z ≥ 0 with z₁ + z₂ = 1 is a solution.",
    control: "The definite matrix [[2, −1], [−1, 2]], whose solution is unique.",
    sources: &["chapter, table of misconceptions"],
    check: existence_only,
}];

/// Claims of the tables of theorems.
pub const TABLES: &[Claim] = &[Claim {
    id: "T.delassus-psd",
    statement: "W = HM⁻¹Hᵀ ⪰ 0 because M ≻ 0, hence the normal LCP is solvable.",
    verdict: ClaimVerdict::True,
    kind: Kind::Assertion,
    severity: None,
    evidence: Evidence::Exact,
    correct_statement: "True for the LCP of a step with one restitution coefficient, q = H(v_free + e v): it is always feasible, and \
        feasible with W ⪰ 0 is solvable.",
    argument: "If no z ≥ 0 had Wz + q ≥ 0, Farkas would give y ≥ 0 with Wy ≤ 0 and qᵀy < 0; then yᵀWy ≤ 0, so Hᵀy = 0 and qᵀy = (v_free + \
        ev)ᵀHᵀy = 0. Eight contacts of a block with three velocities, all velocities from {−2, …, 2}³ and e = 1/2: W ⪰ 0 of rank 3, each \
        of the 125 LCPs solved exactly. (With different coefficients it may fail, see S3.normal-solvable.)",
    control: "Data q that is not of the form Hv: two opposite contacts that both close at 1.",
    sources: &["chapter, table of theorems", "Cottle, Pang, Stone, The Linear Complementarity Problem, §3.1"],
    check: normal_lcp,
}];

fn existence_only(reading: Reading) -> Result<Vec<Finding>> {
    let entries = reading.pick([1, 1, 1, 1], [2, -1, -1, 2]);
    let matrix = DMatrix::from_row_slice(2, 2, &entries.map(|x| ratio(x, 1)));
    let plus = copositive_plus(&matrix)?.holds();
    let set = all_solutions(&Lcp::new(matrix, DVector::from_element(2, ratio(-1, 1))))?;
    Ok(vec![
        Finding::decision("the solution is unique", set.is_unique(), false),
        Finding::decision("the matrix is copositive-plus", plus, true),
        Finding::decision("a solution exists", !set.is_empty(), true),
    ])
}

/// Normal rows (1, x, y) of eight points of a block; more than it has velocities.
fn eight_contacts() -> DMatrix<Rational> {
    let points = [[1, 1], [1, -1], [-1, 1], [-1, -1], [2, 0], [0, 2], [-2, 0], [0, 0]];
    DMatrix::from_fn(8, 3, |i, j| ratio(if j == 0 { 1 } else { points[i][j - 1] }, 1))
}

fn normal_lcp(reading: Reading) -> Result<Vec<Finding>> {
    let problems: Vec<Lcp<Rational>> = match reading {
        Reading::Recorded => {
            let jacobian = eight_contacts();
            let matrix = delassus(&DMatrix::identity(3, 3), &jacobian)?;
            let grid = (0..125i64).map(|k| DVector::from_row_slice(&[k % 5 - 2, k / 5 % 5 - 2, k / 25 - 2].map(|x| ratio(x, 1))));
            // v_free = v: q = H(v + v/2).
            grid.map(|v| Lcp::new(matrix.clone(), &jacobian * v * ratio(3, 2))).collect()
        }
        Reading::Control => {
            let matrix = DMatrix::from_row_slice(2, 2, &[1, -1, -1, 1].map(|x| ratio(x, 1)));
            vec![Lcp::new(matrix, DVector::from_element(2, ratio(-1, 1)))]
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
    let solve = |start: DVector<f64>| ProjectedGaussSeidel::default().solve(&problem, Some(&start));
    let (zero, diagonal) = (solve(DVector::zeros(4))?, solve(dvector![1.0, 0.0, 0.0, 1.0])?);
    let velocities = (&zero.velocity - &diagonal.velocity).amax();
    let impulses = (&zero.impulse - &diagonal.impulse).amax();
    let compared = reading.pick(velocities, impulses);
    Ok(vec![
        Finding::equal("difference of the answers from two starts", compared, 0.0, SWEEP_VELOCITY, "m/s"),
        Finding::equal("largest |U|, all corners pressed", zero.velocity.amax(), 0.0, SWEEP_VELOCITY, "m/s"),
        Finding::decision("the impulses differ", impulses > SWEEP_VELOCITY, true),
    ])
}
