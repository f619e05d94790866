//! Projected Gauss–Seidel on the dual of Gauss's principle, with MuJoCo's two steps at a cone: along the ray, then on the disc.
//!
//! ```text
//!     A = H M⁻¹ Hᵀ + R ,   residual ε = A r + b :
//!     one-sided row   r ← (r − ε/A_ii)₊
//!     cone, r₀ = 0    r₀ ← (−ε₀/A₀₀)₊
//!     cone, r₀ > 0    r ← r (1 − rᵀε/rᵀA r)₊                                                  along the ray
//!     then            r_t ← argmin ½ r_tᵀA_tt r_t + cᵀr_t   over Σ (r_j/μ_j)² ≤ r₀²            on the disc, r₀ fixed
//! ```
//! Both steps of a cone are exact minimisations over convex sets that hold the current impulse, so that no sweep increases the dual cost.

use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::gauss::{GaussProgram, Minimiser, SoftPiece, through_program};
use moreau_contact::solvers::watch::is_over;
use moreau_contact::solvers::{ContactSolver, SolverEntry};
use moreau_contact::tolerance::solvers::{ROOT_STEPS, STOP, SWEEPS};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Sweeps of rows, rays and discs.
///
/// # Source
/// Chapter §6, table of solvers; MuJoCo documentation, *Computation: solver algorithms* (3.17). MuJoCo ≥ 3.12 adds momentum between the
/// sweeps and visits the contacts in random order; here they come in their own order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussSweeps {
    /// Most sweeps.
    pub sweeps: usize,
    /// Change of Hᵀr in one sweep, relative to it, at which it stops.
    pub tolerance: f64,
}

/// Its line in a table of solvers.
pub const GAUSS_SWEEPS: SolverEntry = SolverEntry {
    name: "gauss-pgs",
    default: || Box::new(GaussSweeps::default()),
    limited: Some(|limit| Box::new(GaussSweeps { sweeps: limit, ..Default::default() })),
};

impl Default for GaussSweeps {
    fn default() -> Self {
        GaussSweeps { sweeps: SWEEPS, tolerance: STOP }
    }
}

impl GaussSweeps {
    /// The impulses after the sweeps, from r = 0.
    ///
    /// # Errors
    /// [`Error::Solver`] if A is not positive definite, which only overflow can bring about.
    pub fn minimise(&self, program: &GaussProgram) -> Result<Minimiser> {
        let operator = operator(program);
        let mut impulse = DVector::zeros(program.rows());
        let mut iterations = 0;
        while iterations < self.sweeps && !is_over() {
            let before = impulse.clone();
            for (first, piece) in program.pieces().take_while(|_| !is_over()) {
                let n = piece.rows();
                let residual = operator.rows(first, n) * &impulse + program.offset().rows(first, n);
                let block = operator.view((first, first), (n, n)).into_owned();
                let updated = update(piece, &block, &residual, impulse.rows(first, n).into_owned())?;
                impulse.rows_mut(first, n).copy_from(&updated);
            }
            iterations += 1;
            if (&impulse - before).norm() <= self.tolerance * impulse.norm() {
                break;
            }
        }
        let change = program.accelerate(&program.push(&impulse));
        let relative_gradient = program.relative_gradient(&change, &impulse);
        Ok(Minimiser { change, impulse, iterations, relative_gradient })
    }
}

/// A = H M⁻¹ Hᵀ + R \[1/kg\].
fn operator(program: &GaussProgram) -> DMatrix<f64> {
    let rows = program.rows();
    let mut operator = DMatrix::zeros(rows, rows);
    for row in 0..rows {
        let unit = DVector::from_fn(rows, |other, _| f64::from(u8::from(other == row)));
        operator.set_column(row, &program.motion(&program.accelerate(&program.push(&unit))));
    }
    for (first, piece) in program.pieces() {
        piece.softness().iter().enumerate().for_each(|(k, softness)| operator[(first + k, first + k)] += softness);
    }
    operator
}

fn update(piece: &SoftPiece, block: &DMatrix<f64>, residual: &DVector<f64>, old: DVector<f64>) -> Result<DVector<f64>> {
    let mut r = old.clone();
    let SoftPiece::Cone { friction, .. } = piece else {
        r[0] = (r[0] - residual[0] / block[(0, 0)]).max(0.0);
        return Ok(r);
    };
    if r[0] > 0.0 {
        r *= (1.0 - r.dot(residual) / r.dot(&(block * &r))).max(0.0);
    } else {
        r.fill(0.0);
        r[0] = (-residual[0] / block[(0, 0)]).max(0.0);
    }
    let n = r.len();
    let tangential = block.view((1, 1), (n - 1, n - 1)).into_owned();
    // ε_t + A_t₀ (r₀ − old₀) − A_tt old_t: the residual without what friction itself adds
    let linear = residual.rows(1, n - 1) + block.view((1, 0), (n - 1, 1)) * (r[0] - old[0]) - &tangential * old.rows(1, n - 1);
    let disc = on_disc(&tangential, &linear.column(0).into_owned(), friction, r[0])?;
    r.rows_mut(1, n - 1).copy_from(&disc);
    Ok(r)
}

/// argmin ½ xᵀA x + cᵀx over Σ (x_j/μ_j)² ≤ radius²: x(λ) = −(A + λ diag(1/μ²))⁻¹ c with the smallest λ ≥ 0 that is admissible, whose
/// size decreases in λ; λ is bracketed by doubling and found by bisection.
fn on_disc(matrix: &DMatrix<f64>, linear: &DVector<f64>, friction: &[f64], radius: f64) -> Result<DVector<f64>> {
    let weights = DVector::from_iterator(friction.len(), friction.iter().map(|mu| 1.0 / (mu * mu)));
    let at = |multiplier: f64| {
        let matrix = matrix + DMatrix::from_diagonal(&(&weights * multiplier));
        let factor = matrix.cholesky().ok_or_else(|| Error::breakdown("gauss-pgs", "a contact's block is not positive definite"))?;
        Ok::<_, Error>(-factor.solve(linear))
    };
    let size = |x: &DVector<f64>| x.iter().zip(&weights).map(|(x, weight)| x * x * weight).sum::<f64>().sqrt();
    let free = at(0.0)?;
    if size(&free) <= radius {
        return Ok(free);
    }
    if radius == 0.0 {
        return Ok(DVector::zeros(friction.len()));
    }
    let (mut low, mut high) = (0.0, matrix.trace());
    while size(&at(high)?) > radius {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..ROOT_STEPS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if size(&at(middle)?) > radius { low = middle } else { high = middle }
    }
    at(high)
}

impl ContactSolver for GaussSweeps {
    fn name(&self) -> &'static str {
        "gauss-pgs"
    }

    fn is_truncated(&self) -> bool {
        true
    }

    fn takes_start(&self) -> bool {
        false
    }

    fn takes(&self, law: Law, _rows: usize, symmetric: bool) -> bool {
        symmetric && law.is_convex()
    }

    /// Always from r = 0.
    fn solve(&self, problem: &ContactProblem, _warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        through_program(self.name(), problem, |program| self.minimise(program))
    }
}
