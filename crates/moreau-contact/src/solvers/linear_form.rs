//! Which linear complementarity problem a contact problem is, and which impulses its solutions stand for.
//!
//! ```text
//!     0 ≤ z ⟂ M z + q ≥ 0 ,   r = G z  (G z without σ)
//!     normal rows       frictionless               M = W_nn + R_nn
//!     Stewart–Trinkle   polyhedral Coulomb         z = (λ, β, σ); Coulomb in the plane with d = 2
//!     edges             polyhedral associated      M = Gᵀ(W + R)G + R_edge, columns n + μ Dⱼ; associated in the plane
//! ```

use super::balanced::balanced;
use super::watch;
use crate::certificate::polyhedral_solutions::{friction_lcp, friction_lcp_of};
use crate::certificate::true_operator::operator;
use crate::cones::polyhedral;
use crate::memory;
use crate::problem::{Compliance, ContactProblem, Coordinates, Law, Lcp, Solution};
use moreau_exact::doubled::residual;
use moreau_exact::scalar::{Rational, exact};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Which LCP a contact problem is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Form {
    Normals,
    StewartTrinkle { directions: usize },
    Edges { directions: usize },
}

/// Square matrices of the unknowns that a method of pivots holds: M, M scaled, and a tableau twice as wide as it is high with its copy.
const TABLEAUS: u128 = 6;

impl Form {
    /// The LCP of a problem.
    ///
    /// # Errors
    /// [`Error::Solver`] in the name of a solver if its law is not linear.
    pub(super) fn of(problem: &ContactProblem, solver: &str) -> Result<Form> {
        if problem.is_frictionless() {
            return Ok(Form::Normals);
        }
        match (problem.law(), problem.rows_per_contact()) {
            (Law::PolyhedralCoulomb { directions }, _) => Ok(Form::StewartTrinkle { directions }),
            (Law::Coulomb, 2) => Ok(Form::StewartTrinkle { directions: 2 }),
            (Law::PolyhedralAssociated { directions }, _) => Ok(Form::Edges { directions }),
            (Law::Associated, 2) => Ok(Form::Edges { directions: 2 }),
            (law, _) => {
                let reason = format!("is for linear complementarity problems, and the law `{}` in three dimensions is none", law.name());
                Err(Error::refused(solver, reason))
            }
        }
    }

    /// The LCP of a problem without friction.
    ///
    /// # Errors
    /// [`Error::Solver`] in the name of a solver for such problems alone.
    pub(super) fn frictionless(problem: &ContactProblem, solver: &str) -> Result<Form> {
        if problem.is_frictionless() {
            return Ok(Form::Normals);
        }
        Err(Error::refused(solver, format!("is for the law `frictionless`, this is `{}` with friction", problem.law().name())))
    }

    /// G: unknown impulses ↦ r.
    fn generators(self, problem: &ContactProblem) -> DMatrix<f64> {
        let (contacts, rows) = (problem.contacts(), problem.rows_per_contact());
        match self {
            Form::Normals => DMatrix::from_fn(contacts * rows, contacts, |i, j| if i == rows * j { 1.0 } else { 0.0 }),
            Form::StewartTrinkle { directions } => problem.stewart_trinkle_generators(directions),
            Form::Edges { directions } => DMatrix::from_fn(contacts * rows, contacts * directions, |i, j| {
                let contact = j / directions;
                let edge = polyhedral::edge(j % directions, directions, problem.friction()[contact]);
                if i / rows == contact { edge[i % rows] } else { 0.0 }
            }),
        }
    }

    /// The number of unknowns z.
    pub(super) fn unknowns(self, problem: &ContactProblem) -> usize {
        let each = match self {
            Form::Normals => 1,
            Form::StewartTrinkle { directions } => 2 + directions,
            Form::Edges { directions } => directions,
        };
        each * problem.contacts()
    }

    /// M and q, in the name of this solver.
    ///
    /// # Errors
    /// Where they take more memory than is allowed, and where the time is over before they are made.
    pub(super) fn lcp(self, problem: &ContactProblem, solver: &str) -> Result<Lcp<f64>> {
        let (rows, unknowns) = (problem.rows(), self.unknowns(problem));
        // beside the unknowns' own matrices: W twice, and what is multiplied by it; the normals' are made entry by entry
        let beside = if self == Form::Normals { 0 } else { 2 };
        let matrices = [(beside, rows, rows), (beside, rows, unknowns), (TABLEAUS, unknowns, unknowns)];
        let bytes = matrices.map(|(times, n, m)| memory::matrix(n, m).saturating_mul(times)).into_iter().fold(0, u128::saturating_add);
        memory::require("this problem as a linear complementarity problem", bytes)?;
        if watch::is_over() {
            return Err(Error::limit(solver, "was ended before its matrix was made"));
        }
        match self {
            Form::StewartTrinkle { .. } => problem.stewart_trinkle_lcp(),
            Form::Normals => Ok(of_normals(problem)),
            Form::Edges { .. } => self.of_edges(problem),
        }
    }

    fn of_edges(self, problem: &ContactProblem) -> Result<Lcp<f64>> {
        let generators = self.generators(problem);
        let mut matrix = generators.tr_mul(&(problem.law_delassus()? * &generators));
        if let Some(Compliance { coordinates: Coordinates::Edge, diagonal }) = problem.compliance() {
            matrix += DMatrix::from_diagonal(diagonal);
        }
        Ok(Lcp::new(matrix, generators.tr_mul(&(problem.free_velocity() + problem.shift()))))
    }

    /// M and q in fractions, of W as mass and Jacobian make it where they are known: nothing in them is rounded.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where that W is not known in fractions.
    pub(super) fn exact_lcp(self, problem: &ContactProblem) -> Result<Lcp<Rational>> {
        if let Form::StewartTrinkle { directions } = self {
            return friction_lcp(problem, directions);
        }
        let given = problem.free_velocity().map(exact) + problem.shift().map(exact);
        Ok(self.exact_lcp_of(problem, operator(problem)?, &given))
    }

    /// The same of this W and these u_free + shift in place of the problem's own.
    pub(super) fn exact_lcp_of(self, problem: &ContactProblem, mut w: DMatrix<Rational>, given: &DVector<Rational>) -> Lcp<Rational> {
        if let Form::StewartTrinkle { directions } = self {
            return friction_lcp_of(problem, w, given, directions);
        }
        (0..problem.rows()).for_each(|row| w[(row, row)] += exact(problem.row_compliance(row)));
        let g = self.exact_generators(problem);
        let transposed = g.transpose();
        let mut matrix = &transposed * w * &g;
        if let Some(Compliance { coordinates: Coordinates::Edge, diagonal }) = problem.compliance() {
            diagonal.iter().enumerate().for_each(|(edge, soft)| matrix[(edge, edge)] += exact(*soft));
        }
        Lcp::new(matrix, transposed * given)
    }

    /// G of normals or edges n + μ Dⱼ in fractions.
    fn exact_generators(self, problem: &ContactProblem) -> DMatrix<Rational> {
        let Form::Edges { directions } = self else { return self.generators(problem).map(exact) };
        let rows = problem.rows_per_contact();
        DMatrix::from_fn(problem.rows(), problem.contacts() * directions, |i, j| {
            let mu = exact(problem.friction()[j / directions]);
            match i % rows {
                _ if i / rows != j / directions => Rational::ZERO,
                0 => Rational::ONE,
                tangent => mu * exact(polyhedral::direction(j % directions, directions)[tangent - 1]),
            }
        })
    }

    /// S with z = S z′: per contact s = (mean diagonal of W)^(−½) for impulses and 1/s for slip speeds, which makes
    /// S M S dimensionless with entries of order one and leaves the blocks E and −Eᵀ alone.
    pub(super) fn scale(self, problem: &ContactProblem) -> DVector<f64> {
        let rows = problem.rows_per_contact();
        let contact_scale = |contact: usize| {
            let mean = (rows * contact..rows * (contact + 1)).map(|i| problem.entry(i, i)).sum::<f64>() / rows as f64;
            if mean > 0.0 { 1.0 / mean.sqrt() } else { 1.0 }
        };
        let scales: Vec<f64> = (0..problem.contacts()).map(contact_scale).collect();
        let repeated = |times: usize| scales.iter().flat_map(move |&s| std::iter::repeat_n(s, times));
        let list: Vec<f64> = match self {
            Form::Normals => scales.clone(),
            Form::StewartTrinkle { directions } => {
                repeated(1).chain(repeated(directions)).chain(scales.iter().map(|s| s.recip())).collect()
            }
            Form::Edges { directions } => repeated(directions).collect(),
        };
        DVector::from_vec(list)
    }

    /// β or f, and σ, of an answer's impulses: the parts with the smallest sum and the least σ ≥ 0 with Dⱼ·y_t + σ ≥ 0.
    pub(super) fn parts(self, problem: &ContactProblem, answer: &Solution) -> (Option<DVector<f64>>, Option<DVector<f64>>) {
        let rows = problem.rows_per_contact();
        let contacts = answer.impulse.as_slice().chunks_exact(rows).zip(problem.friction());
        let tangent = |z: &[f64]| [z[1], z.get(2).copied().unwrap_or(0.0)];
        match self {
            Form::Normals => (None, None),
            Form::Edges { directions } => {
                let edges = contacts.flat_map(|(r, mu)| {
                    let mut edges = Vec::with_capacity(directions);
                    polyhedral::along_edges(r, *mu, directions, &mut edges);
                    edges
                });
                (Some(DVector::from_vec(edges.collect())), None)
            }
            Form::StewartTrinkle { directions } => {
                let slip = |y: &[f64]| {
                    let against = |j: usize| -polyhedral::direction(j, directions).iter().zip(tangent(y)).map(|(d, y)| d * y).sum::<f64>();
                    (0..directions).map(against).fold(0.0, f64::max)
                };
                let law_velocity = problem.law_velocity(&answer.impulse);
                let sigma = DVector::from_iterator(problem.contacts(), law_velocity.as_slice().chunks_exact(rows).map(slip));
                let beta = contacts.flat_map(|(r, _)| {
                    let mut beta = Vec::with_capacity(directions);
                    polyhedral::along_neighbours(tangent(r), directions, &mut beta);
                    beta
                });
                (Some(DVector::from_vec(beta.collect())), Some(sigma))
            }
        }
    }

    /// The answer that z is, proposed by a solver after so many steps.
    pub(super) fn solution(self, problem: &ContactProblem, z: &DVector<f64>, solver: &str, steps: usize) -> Solution {
        let generators = self.generators(problem);
        let impulse = &generators * z.rows(0, generators.ncols());
        let contacts = problem.contacts();
        let (beta, sigma) = match self {
            Form::Normals => (None, None),
            // μ times a rounded σ may be more than what rounds of y: in the plane both follow from r and y
            Form::StewartTrinkle { .. } if problem.law() == Law::Coulomb => {
                self.parts(problem, &Solution::new(solver, impulse.clone(), problem.velocity(&impulse), steps))
            }
            Form::StewartTrinkle { directions } => (
                Some(z.rows(contacts, contacts * directions).into_owned()),
                Some(z.rows(contacts * (1 + directions), contacts).into_owned()),
            ),
            Form::Edges { .. } => (Some(z.clone()), None),
        };
        Solution { beta, sigma, ..Solution::new(solver, impulse.clone(), problem.velocity(&impulse), steps) }
    }

    /// The problem in units of its own, of the same supports.
    pub(super) fn scaled(self, problem: &ContactProblem, lcp: &Lcp<f64>) -> Scaled {
        Scaled::new(lcp, self.scale(problem))
    }
}

/// 0 ≤ z′ ⟂ S M S z′ + S q/κ ≥ 0 with κ = max |S q|; z = κ S z′. Where rows or columns of S M S are of several sizes, R S M S C and R S q
/// stand in its place, with powers of two R and C, and S C in place of S in z (`balanced.rs`).
pub(super) struct Scaled {
    pub(super) lcp: Lcp<f64>,
    pub(super) scale: DVector<f64>,
    pub(super) size: f64,
    is_balanced: bool,
}

impl Scaled {
    pub(super) fn new(lcp: &Lcp<f64>, scale: DVector<f64>) -> Scaled {
        let matrix = DMatrix::from_fn(lcp.size(), lcp.size(), |i, j| scale[i] * lcp.matrix[(i, j)] * scale[j]);
        let own = Lcp::new(matrix, lcp.vector.component_mul(&scale));
        let (Lcp { matrix, vector }, scale, is_balanced) = match balanced(&own) {
            Some((balanced, columns)) => (balanced, scale.component_mul(&columns), true),
            None => (own, scale, false),
        };
        let size = vector.iter().fold(0.0, |largest: f64, q| largest.max(q.abs()));
        let size = if size > 0.0 { size } else { 1.0 };
        Scaled { lcp: Lcp::new(matrix, vector / size), scale, size, is_balanced }
    }

    /// The same with another matrix.
    pub(super) fn with_matrix(&self, matrix: DMatrix<f64>) -> Scaled {
        Scaled { lcp: Lcp::new(matrix, self.lcp.vector.clone()), scale: self.scale.clone(), ..*self }
    }

    /// z of a z′.
    pub(super) fn unscaled(&self, z: &DVector<f64>) -> DVector<f64> {
        z.component_mul(&self.scale) * self.size
    }

    /// z of a support, from the problem itself unless its rows or columns are of several sizes; `None` if a pivot is zero.
    pub(super) fn on_support(&self, lcp: &Lcp<f64>, support: &[bool]) -> Option<DVector<f64>> {
        if self.is_balanced { on_support(&self.lcp, support).map(|z| self.unscaled(&z)) } else { on_support(lcp, support) }
    }
}

/// z with M_αα z_α = −q_α on a support α and zero elsewhere, once refined; `None` if a pivot is zero.
pub(super) fn on_support(lcp: &Lcp<f64>, support: &[bool]) -> Option<DVector<f64>> {
    let members: Vec<usize> = (0..lcp.size()).filter(|&i| support[i]).collect();
    if members.is_empty() {
        return Some(DVector::zeros(lcp.size()));
    }
    let block = DMatrix::from_fn(members.len(), members.len(), |i, j| lcp.matrix[(members[i], members[j])]);
    let right = DVector::from_fn(members.len(), |i, _| -lcp.vector[members[i]]);
    let factor = block.clone().lu();
    let mut values = factor.solve(&right)?;
    let rows = block.transpose();
    let left = DVector::from_fn(members.len(), |i, _| residual(&right[i], rows.column(i).iter().zip(values.iter())));
    values += factor.solve(&left)?;
    let mut z = DVector::zeros(lcp.size());
    members.iter().zip(values.iter()).for_each(|(&i, value)| z[i] = *value);
    Some(z)
}

/// M and q of the normal rows, entry by entry: no product of whole matrices.
fn of_normals(problem: &ContactProblem) -> Lcp<f64> {
    let (rows, contacts) = (problem.rows_per_contact(), problem.contacts());
    let mut matrix = DMatrix::zeros(contacts, contacts);
    let mut column = vec![0.0; problem.rows()];
    for j in 0..contacts {
        column.fill(0.0);
        problem.add_column(j * rows, 1.0, &mut column);
        matrix.column_mut(j).iter_mut().zip(column.iter().step_by(rows)).for_each(|(entry, w)| *entry = *w);
        matrix[(j, j)] += problem.row_compliance(j * rows);
    }
    let given = |j: usize| problem.free_velocity()[j * rows] + problem.shift()[j * rows];
    Lcp::new(matrix, DVector::from_fn(contacts, |j, _| given(j)))
}
