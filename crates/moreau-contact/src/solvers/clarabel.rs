//! The convex laws through the interior-point solver Clarabel, polished and judged.
//!
//! ```text
//!     min ½ rᵀ(W + R)r + (u_free + shift)ᵀr     over (μ r_n, r_t) in the second-order cone of each contact .
//! ```
//! An interior-point answer is inside the cones by its tolerance, which a relative stopping test leaves at 1e-9 to 1e-5 of
//! the natural map; projected Gauss–Seidel from there identifies stick, slip and separation exactly. Neither is
//! believed: both are judged by the certificate, the better one is returned, and a polishing that did not help is named
//! in the answer. Of a W that is asymmetric by a little Clarabel is given (W + Wᵀ)/2; the polishing and the certificate take W itself.

use super::{ContactSolver, ProjectedGaussSeidel, watch};
use crate::certificate::{Residuals, residuals};
use crate::cones::polyhedral::edge;
use crate::problem::{Compliance, ContactProblem, Coordinates, Law, Solution};
use crate::tolerance::solvers as tolerance;
use ::clarabel::algebra::CscMatrix;
use ::clarabel::solver::SupportedConeT::{self, NonnegativeConeT, SecondOrderConeT, ZeroConeT};
use ::clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver};
use moreau_exact::error::Failure;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Clarabel followed by projected Gauss–Seidel, for the frictionless, associated and polyhedral associated laws; W must be symmetric, or
/// nearly so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ClarabelPolished;

/// An interior-point answer before and after polishing.
#[derive(Clone, Debug)]
pub struct Polished {
    /// The better of the two answers.
    pub solution: Solution,
    /// Residuals of Clarabel's answer.
    pub before: Residuals,
    /// Residuals of the polished answer.
    pub after: Residuals,
}

impl Polished {
    /// Whether polishing made the natural map smaller, or left it at zero.
    pub fn improved(&self) -> bool {
        self.after.natural_map < self.before.natural_map || self.after.natural_map == 0.0
    }
}

const NAME: &str = "clarabel";

impl ContactSolver for ClarabelPolished {
    fn name(&self) -> &'static str {
        NAME
    }

    fn takes_start(&self) -> bool {
        false
    }

    fn takes(&self, law: Law, _rows: usize, symmetric: bool) -> bool {
        symmetric && law.is_convex()
    }

    /// The warm start is not used: the interior-point method has none.
    fn solve(&self, problem: &ContactProblem, _warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        self.solve_judged(problem).map(|polished| polished.solution)
    }
}

impl ClarabelPolished {
    /// The answer with the residuals before and after polishing.
    ///
    /// # Errors
    /// [`Error::Solver`] for another law, an asymmetric W, or if Clarabel ends without numbers (an unbounded problem has no solution).
    pub fn solve_judged(&self, problem: &ContactProblem) -> Result<Polished> {
        super::parts::require_near_symmetry(NAME, problem)?;
        match problem.law() {
            Law::Frictionless | Law::Associated => {}
            Law::PolyhedralAssociated { directions } => return through_edges(problem, directions),
            law => return Err(super::not_convex(NAME, law)),
        }
        let (impulse, iterations) = interior_point(problem)?;
        let answer = |impulse: DVector<f64>, solver: &str, iterations| {
            let velocity = problem.velocity(&impulse);
            Solution::new(solver, impulse, velocity, iterations)
        };
        let raw = answer(impulse, "clarabel, where polishing did not help", iterations);
        let before = residuals(problem, &raw)?;
        let polish = ProjectedGaussSeidel { sweeps: tolerance::POLISHING_SWEEPS, ..ProjectedGaussSeidel::default() };
        let smooth = polish.solve(problem, Some(&raw.impulse))?;
        let after = residuals(problem, &smooth)?;
        let mut polished = Polished { solution: answer(smooth.impulse, NAME, iterations + smooth.iterations), before, after };
        if !polished.improved() {
            polished.solution = raw;
        }
        Ok(polished)
    }
}

/// Clarabel's r and its iterations, on data scaled to size one.
fn interior_point(problem: &ContactProblem) -> Result<(DVector<f64>, usize)> {
    let data = problem.free_velocity() + problem.shift();
    let (stiffness, speed) = (largest_entry(problem), data.amax());
    let none = || Ok((DVector::zeros(problem.rows()), 0));
    if speed == 0.0 || watch::was_over() {
        return none();
    }
    if stiffness == 0.0 {
        return Err(Error::breakdown(NAME, "W + R is zero, so no impulse changes any velocity"));
    }
    let n = problem.rows();
    let Some(quadratic) = upper_triangle(problem, stiffness) else { return none() };
    let linear: Vec<f64> = data.iter().map(|q| q / speed).collect();
    let (constraint, cones) = cones(problem);
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .max_threads(1)
        .tol_gap_abs(tolerance::CLARABEL)
        .tol_gap_rel(tolerance::CLARABEL)
        .tol_feas(tolerance::CLARABEL)
        .build()
        .map_err(|error| Error::breakdown(NAME, error.to_string()))?;
    let mut solver = DefaultSolver::new(&quadratic, &linear, &constraint, &vec![0.0; n], &cones, settings)
        .map_err(|error| Error::breakdown(NAME, error.to_string()))?;
    solver.set_termination_callback(|_| watch::is_over());
    solver.solve();
    let solution = &solver.solution;
    let impulse = DVector::from_iterator(n, solution.x.iter().map(|r| r * speed / stiffness));
    let infeasible = format!("{:?}", solution.status).contains("Infeasible");
    if infeasible || impulse.iter().any(|r| !r.is_finite()) {
        let failure = if infeasible { Failure::Ray } else { Failure::Breakdown };
        return Err(Error::solver(NAME, failure, format!("ended with status {:?}", solution.status)));
    }
    Ok((impulse, solution.iterations as usize))
}

/// s = −constraint · r in the product of `cones`: (μ r_n, r_t) second order, or r_n ≥ 0 and r_t = 0 without friction.
fn cones(problem: &ContactProblem) -> (CscMatrix<f64>, Vec<SupportedConeT<f64>>) {
    let (n, rows) = (problem.rows(), problem.rows_per_contact());
    let mut diagonal = vec![-1.0; n];
    let mut cones = Vec::new();
    for (k, &mu) in problem.friction().iter().enumerate() {
        if problem.law() == Law::Frictionless || mu == 0.0 {
            cones.push(NonnegativeConeT(1));
            if rows > 1 {
                cones.push(ZeroConeT(rows - 1));
            }
        } else {
            // scaling the cone's vector changes nothing; its largest coefficient is 1 either way
            let scale = mu.max(1.0);
            diagonal[k * rows] = -mu / scale;
            (1..rows).for_each(|row| diagonal[k * rows + row] = -1.0 / scale);
            cones.push(SecondOrderConeT(rows));
        }
    }
    (CscMatrix::new(n, n, (0..=n).collect(), (0..n).collect(), diagonal), cones)
}

/// The largest entry of W or R \[1/kg\], of those that were looked at where the caller ends it.
fn largest_entry(problem: &ContactProblem) -> f64 {
    let mut largest = 0.0_f64;
    for column in (0..problem.rows()).take_while(|_| !watch::is_over()) {
        largest = largest.max(super::compliance(problem, column));
        problem.delassus().for_each_in_column(column, |_, w| largest = largest.max(w.abs()));
    }
    largest
}

/// The upper triangle of ((W + Wᵀ)/2 + R)/unit, entries that are zero left out; none where the caller ends it.
fn upper_triangle(problem: &ContactProblem, unit: f64) -> Option<CscMatrix<f64>> {
    let n = problem.rows();
    let mut starts = vec![0];
    let (mut rows, mut values): (Vec<usize>, Vec<f64>) = (Vec::new(), Vec::new());
    for column in 0..n {
        if watch::is_over() {
            return None;
        }
        problem.delassus().for_each_in_column(column, |row, w| {
            if row < column {
                rows.push(row);
                values.push(0.5 * (w + problem.entry(column, row)) / unit);
            }
        });
        rows.push(column);
        values.push((problem.entry(column, column) + super::compliance(problem, column)) / unit);
        starts.push(rows.len());
    }
    Some(CscMatrix::new(n, n, starts, rows, values))
}

/// The polyhedral associated law is frictionless contact along the edges: f ≥ 0, r = G f, W_edge = GᵀWG.
fn through_edges(problem: &ContactProblem, directions: usize) -> Result<Polished> {
    let edges = edge_problem(problem, directions)?;
    let generators = edge_generators(problem, directions);
    let mut polished = ClarabelPolished.solve_judged(&edges)?;
    let impulse = &generators * &polished.solution.impulse;
    let velocity = problem.velocity(&impulse);
    let beta = Some(polished.solution.impulse);
    polished.solution = Solution { impulse, velocity, beta, ..polished.solution };
    Ok(polished)
}

/// G, whose columns are the edges n + μDⱼ of every contact.
fn edge_generators(problem: &ContactProblem, directions: usize) -> DMatrix<f64> {
    let rows = problem.rows_per_contact();
    DMatrix::from_fn(problem.rows(), directions * problem.contacts(), |row, column| {
        let (contact, j) = (column / directions, column % directions);
        if row / rows == contact { edge(j, directions, problem.friction()[contact])[row % rows] } else { 0.0 }
    })
}

fn edge_problem(problem: &ContactProblem, directions: usize) -> Result<ContactProblem> {
    let generators = edge_generators(problem, directions);
    let compliance = problem.compliance().filter(|compliance| compliance.coordinates == Coordinates::Edge);
    // a contact compliance is part of the edge operator, so that the edge problem itself is hard
    let operator = if compliance.is_some() { problem.dense().clone() } else { problem.law_delassus()? };
    let delassus = generators.tr_mul(&(operator * &generators));
    ContactProblem::new((&delassus + delassus.transpose()) * 0.5, generators.tr_mul(problem.free_velocity()))
        .name(format!("{}, along its edges", problem.name()))
        .law(Law::Frictionless)
        .rows_per_contact(1)
        .shift(generators.tr_mul(problem.shift()))
        .compliance(
            compliance.map(|Compliance { diagonal, .. }| Compliance { coordinates: Coordinates::Contact, diagonal: diagonal.clone() }),
        )
        .build()
}
