//! The program of Gauss's principle: M, H, b and the pieces that share out its rows.
//!
//! A contact problem with compliance becomes one:
//! ```text
//!     associated              rows (n, t₁, t₂), a cone with R₀ = R_n, ρ = μ²R_t ;   only n where μ = 0
//!     polyhedral-associated   one row n + μ D_j·t per edge, each one-sided with the edge's R
//!     frictionless            n, one-sided
//! ```

use super::SoftPiece;
use crate::augmented_mass::AugmentedMass;
use crate::cones::polyhedral::edge;
use crate::contact::{Inertia, Mass, Rows};
use crate::problem::{Compliance, ContactProblem, Coordinates, Law};
use moreau_exact::tolerance::rounding;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// min over Δ of ½ΔᵀMΔ + Σ s_k(HΔ + b).
#[derive(Clone, Debug)]
pub struct GaussProgram {
    inertia: Inertia,
    /// H, piece by piece.
    rows: Vec<Rows>,
    offset: DVector<f64>,
    pieces: Vec<SoftPiece>,
}

impl GaussProgram {
    /// The program with dense mass M, rows H and offsets b.
    ///
    /// # Errors
    /// As [`GaussProgram::of_rows`].
    pub fn new(mass: DMatrix<f64>, jacobian: DMatrix<f64>, offset: DVector<f64>, pieces: Vec<SoftPiece>) -> Result<Self> {
        let (rows, size) = (pieces.iter().map(SoftPiece::rows).sum(), mass.ncols());
        if jacobian.nrows() != rows {
            return Err(misshapen([jacobian.nrows(), jacobian.ncols()], [rows, size]));
        }
        let cut = pieces.iter().scan(0, |next, piece| {
            let first = *next;
            *next += piece.rows();
            Some(jacobian.rows(first, piece.rows()).into_owned().into())
        });
        GaussProgram::of_rows(Mass::Dense(mass), cut.collect(), offset, pieces)
    }

    /// The program with mass M by what couples its velocities, the rows of every piece by bodies, and offsets b.
    ///
    /// # Errors
    /// If M is not positive definite, the sizes do not fit or some R or μ is not positive.
    pub fn of_rows(mass: Mass, jacobian: Vec<Rows>, offset: DVector<f64>, pieces: Vec<SoftPiece>) -> Result<Self> {
        let (rows, size): (usize, usize) = (pieces.iter().map(SoftPiece::rows).sum(), mass.size());
        let fits = |(own, piece): (&Rows, &SoftPiece)| own.shape() == (piece.rows(), size);
        if jacobian.len() != pieces.len() || offset.len() != rows || !jacobian.iter().zip(&pieces).all(fits) {
            let given = jacobian.iter().map(Rows::nrows).sum();
            return Err(misshapen([given, jacobian.first().map_or(size, Rows::ncols)], [rows, size]));
        }
        let inertia = Inertia::of(mass)?;
        inertia.finite_mass()?;
        let positive = |piece: &SoftPiece| piece.softness().iter().all(|softness| *softness > 0.0 && softness.is_finite());
        if !pieces.iter().all(positive) {
            return Err(Error::invalid("compliance", "is not positive everywhere", "give R > 0 in every row"));
        }
        Ok(GaussProgram { inertia, rows: jacobian, offset, pieces })
    }

    /// The program of a convex contact problem with compliance, mass and Jacobian.
    ///
    /// # Errors
    /// [`Error::Solver`] in the name of `solver` if the law is not convex, a row is hard or mass and Jacobian are not known.
    pub fn of_problem(solver: &str, problem: &ContactProblem) -> Result<Self> {
        if !problem.law().is_convex() {
            return Err(super::super::not_convex(solver, problem.law()));
        }
        super::super::require_symmetry(solver, problem)?;
        let needs = if problem.knows_rows() {
            "takes mass and jacobian as matrices, which these are too large for"
        } else {
            "needs mass and jacobian, not only W"
        };
        let dynamics = problem.dynamics().ok_or_else(|| Error::refused(solver, needs))?;
        let map = rows_of(problem);
        let pieces = pieces(solver, problem)?;
        let offset = &map * (problem.free_velocity() + problem.shift());
        GaussProgram::new(dynamics.mass.clone(), map * &dynamics.jacobian, offset, pieces)
            .map_err(|error| Error::breakdown(solver, error.to_string()))
    }

    /// The program with other offsets b.
    ///
    /// # Panics
    /// If there is not one for each row.
    #[must_use]
    pub fn with_offset(self, offset: DVector<f64>) -> Self {
        assert_eq!(offset.len(), self.rows(), "one offset for each row");
        GaussProgram { offset, ..self }
    }

    /// nv.
    pub fn velocities(&self) -> usize {
        self.inertia.size()
    }

    /// Number of rows of H.
    pub fn rows(&self) -> usize {
        self.offset.len()
    }

    /// M.
    pub fn mass(&self) -> &Mass {
        self.inertia.mass()
    }

    /// H x.
    pub fn motion(&self, x: &DVector<f64>) -> DVector<f64> {
        let mut motion = DVector::zeros(self.rows());
        for (rows, (first, piece)) in self.rows.iter().zip(self.pieces()) {
            rows.add_product(x.as_slice(), &mut motion.as_mut_slice()[first..first + piece.rows()]);
        }
        motion
    }

    /// Hᵀ r.
    pub fn push(&self, impulse: &DVector<f64>) -> DVector<f64> {
        let mut push = DVector::zeros(self.velocities());
        for (rows, (first, piece)) in self.rows.iter().zip(self.pieces()) {
            rows.add_transposed(&impulse.as_slice()[first..first + piece.rows()], push.as_mut_slice());
        }
        push
    }

    /// b \[m/s\].
    pub fn offset(&self) -> &DVector<f64> {
        &self.offset
    }

    /// The pieces with the first row of each.
    pub fn pieces(&self) -> impl Iterator<Item = (usize, &SoftPiece)> {
        self.pieces.iter().scan(0, |next, piece| {
            let first = *next;
            *next += piece.rows();
            Some((first, piece))
        })
    }

    /// M⁻¹ x.
    pub fn accelerate(&self, x: &DVector<f64>) -> DVector<f64> {
        self.inertia.solve(x)
    }

    /// y = H Δ + b \[m/s\].
    pub fn violation(&self, change: &DVector<f64>) -> DVector<f64> {
        self.motion(change) + &self.offset
    }

    /// r = −∇s(y) \[N·s\].
    pub fn impulse(&self, violation: &DVector<f64>) -> DVector<f64> {
        let y = violation.as_slice();
        DVector::from_vec(self.pieces().flat_map(|(first, piece)| piece.impulse(&y[first..first + piece.rows()])).collect())
    }

    /// ½ΔᵀMΔ + s \[J\].
    pub fn cost(&self, change: &DVector<f64>) -> f64 {
        let violation = self.violation(change);
        let y = violation.as_slice();
        let price: f64 = self.pieces().map(|(first, piece)| piece.cost(&y[first..first + piece.rows()])).sum();
        0.5 * change.dot(&self.mass().times(change)) + price
    }

    /// ∇²s(y) \[kg\], piece by piece.
    pub fn curvatures(&self, violation: &DVector<f64>) -> Vec<DMatrix<f64>> {
        self.pieces().map(|(first, piece)| piece.curvature(&violation.as_slice()[first..first + piece.rows()])).collect()
    }

    /// M + Hᵀ ∇²s H over the bodies that pieces join, for any y.
    ///
    /// # Errors
    /// None of a program that was made: its M is finite, and its sizes fit.
    pub fn hessian(&self) -> Result<AugmentedMass<'_>> {
        AugmentedMass::new(&self.inertia, &self.rows)
    }

    /// MΔ − Hᵀr \[N·s\].
    pub fn gradient(&self, change: &DVector<f64>, impulse: &DVector<f64>) -> DVector<f64> {
        self.mass().times(change) - self.push(impulse)
    }

    /// ‖MΔ − Hᵀr‖ over ‖MΔ‖ + ‖Hᵀr‖, in the norm of M⁻¹, in which every velocity counts by its energy; 0 where both vanish.
    pub fn relative_gradient(&self, change: &DVector<f64>, impulse: &DVector<f64>) -> f64 {
        let size = |x: &DVector<f64>| x.dot(&self.accelerate(x)).max(0.0).sqrt();
        let (inertia, push) = (self.mass().times(change), self.push(impulse));
        let scale = size(&inertia) + size(&push);
        if scale == 0.0 { 0.0 } else { size(&(inertia - push)) / scale }
    }
}

/// H of another shape than the pieces and M ask for.
fn misshapen([rows, columns]: [usize; 2], [wanted, size]: [usize; 2]) -> Error {
    let cure = format!("use the shape {wanted}×{size}, which fits the contacts and the mass");
    Error::invalid("jacobian", format!("is {rows}×{columns}"), cure)
}

/// The matrix from the problem's rows to the program's.
fn rows_of(problem: &ContactProblem) -> DMatrix<f64> {
    let n = problem.rows_per_contact();
    let mut rows: Vec<(usize, Vec<f64>)> = Vec::new();
    for (contact, &mu) in problem.friction().iter().enumerate() {
        let unit = |k: usize| (0..n).map(|j| if j == k { 1.0 } else { 0.0 }).collect();
        match problem.law() {
            Law::PolyhedralAssociated { directions } => {
                rows.extend((0..directions).map(|j| (contact, edge(j, directions, mu)[..n].to_vec())));
            }
            Law::Associated if mu > 0.0 => rows.extend((0..n).map(|k| (contact, unit(k)))),
            _ => rows.push((contact, unit(0))),
        }
    }
    let mut map = DMatrix::zeros(rows.len(), problem.rows());
    for (row, (contact, entries)) in rows.iter().enumerate() {
        entries.iter().enumerate().for_each(|(k, entry)| map[(row, contact * n + k)] = *entry);
    }
    map
}

fn pieces(solver: &str, problem: &ContactProblem) -> Result<Vec<SoftPiece>> {
    let hard = || Error::refused(solver, "needs a compliance R > 0 in every row");
    let Compliance { coordinates, diagonal } = problem.compliance().ok_or_else(hard)?;
    let one_sided = |softness: &f64| SoftPiece::OneSided { softness: *softness };
    match (problem.law(), coordinates) {
        (Law::PolyhedralAssociated { .. }, Coordinates::Edge) => Ok(diagonal.iter().map(one_sided).collect()),
        (Law::Associated | Law::Frictionless, Coordinates::Contact) => {
            let blocks = diagonal.as_slice().chunks(problem.rows_per_contact()).zip(problem.friction());
            blocks.map(|(softness, &mu)| cone(solver, softness, if problem.law() == Law::Associated { mu } else { 0.0 })).collect()
        }
        (Law::PolyhedralAssociated { .. }, _) => Err(Error::refused(solver, "needs the compliance of each edge")),
        (law, _) => Err(super::super::not_convex(solver, law)),
    }
}

fn cone(solver: &str, softness: &[f64], mu: f64) -> Result<SoftPiece> {
    let [normal, tangential @ ..] = softness else { return Err(Error::refused(solver, "needs a normal row")) };
    match tangential {
        [first, rest @ ..] if mu > 0.0 => {
            if rest.iter().any(|other| (other - first).abs() > rounding(8, *first)) {
                return Err(Error::refused(solver, "needs one tangential compliance per contact"));
            }
            Ok(SoftPiece::Cone { normal: *normal, tangential: first * mu * mu, friction: vec![mu; tangential.len()] })
        }
        _ => Ok(SoftPiece::OneSided { softness: *normal }),
    }
}

/// The program's impulses as impulses (n, t₁, t₂), and the edge impulses of a polyhedral law.
pub(super) fn in_contacts(problem: &ContactProblem, impulse: &DVector<f64>) -> (DVector<f64>, Option<DVector<f64>>) {
    let edges = problem.law().directions().map(|_| impulse.clone());
    (rows_of(problem).tr_mul(impulse), edges)
}
