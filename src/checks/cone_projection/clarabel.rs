//! The projection as an optimisation problem, solved by the interior-point method Clarabel.
//!
//! ```text
//!     minimise ½‖x − z‖²   subject to   (μ x_n, x_t) in the second-order cone, x_n ≥ 0 .
//! ```
//! For μ = 0 the cone has no interior; its constraint is then the equation `x_t = 0`.

use super::{Finding, Projection, apply, difference, norm};
use crate::tolerance::checks::cone_projection as tolerance;
use crate::{Error, Result};
use ::clarabel::algebra::CscMatrix;
use ::clarabel::solver::SupportedConeT::{NonnegativeConeT, SecondOrderConeT, ZeroConeT};
use ::clarabel::solver::{DefaultSettings, DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus};

/// Constraint matrix with `b − A x = −A x` in the cones: row 0 is x_n ≥ 0, then (μ x_n, x_t), or x_t alone for μ = 0.
fn constraints(size: usize, mu: f64) -> CscMatrix<f64> {
    let tangent_row = if mu > 0.0 { 1 } else { 0 };
    let rows = size + tangent_row;
    let mut dense = vec![vec![0.0; size]; rows];
    dense[0][0] = -1.0;
    if mu > 0.0 {
        dense[1][0] = -mu;
    }
    for tangent in 1..size {
        dense[tangent + tangent_row][tangent] = -1.0;
    }
    let (mut starts, mut indices, mut values) = (vec![0], Vec::new(), Vec::new());
    for column in 0..size {
        for (row, entries) in dense.iter().enumerate().filter(|(_, entries)| entries[column] != 0.0) {
            indices.push(row);
            values.push(entries[column]);
        }
        starts.push(indices.len());
    }
    CscMatrix::new(rows, size, starts, indices, values)
}

fn settings() -> Result<DefaultSettings<f64>> {
    DefaultSettingsBuilder::default()
        .verbose(false)
        .tol_gap_abs(tolerance::CLARABEL_STOPPING)
        .tol_gap_rel(tolerance::CLARABEL_STOPPING)
        .tol_feas(tolerance::CLARABEL_STOPPING)
        .build()
        .map_err(|error| Error::solver("clarabel", error.to_string()))
}

/// Clarabel's minimiser of `½‖x − z‖²` over K_μ.
///
/// # Errors
/// If Clarabel refuses the problem or stops without reaching its tolerances.
pub fn minimiser(z: &[f64], mu: f64) -> Result<Vec<f64>> {
    let size = z.len();
    let cones = if mu > 0.0 { vec![NonnegativeConeT(1), SecondOrderConeT(size)] } else { vec![NonnegativeConeT(1), ZeroConeT(size - 1)] };
    let linear: Vec<f64> = z.iter().map(|entry| -entry).collect();
    let matrix = constraints(size, mu);
    let right_hand_side = vec![0.0; matrix.m];
    let mut solver = DefaultSolver::new(&CscMatrix::identity(size), &linear, &matrix, &right_hand_side, &cones, settings()?)
        .map_err(|error| Error::solver("clarabel", error.to_string()))?;
    solver.solve();
    match solver.solution.status {
        SolverStatus::Solved => Ok(solver.solution.x.clone()),
        status => Err(Error::solver("clarabel", format!("projection of {z:?} for μ = {mu} ended as {status}"))),
    }
}

/// The subject's projection equals Clarabel's, within Clarabel's stopping tolerance carried through the strong convexity.
///
/// # Errors
/// As [`minimiser`].
pub fn equals_clarabel(subject: Projection, z: &[f64], mu: f64) -> Result<Vec<Finding>> {
    let distance = norm(&difference(&apply(subject, z, mu), &minimiser(z, mu)?));
    Ok(vec![Finding::at_most("distance from Clarabel's projection", distance, tolerance::clarabel(norm(z), mu), "N·s")])
}
