//! The work that a contact law allows its impulses.
//!
//! ```text
//!     Σ_k max(0, r_k·y_k) = w ,      y = u + shift + R r ,      r·u ≤ −r·shift − rᵀR r + w .
//! ```
//! Every law has r_k·y_k ≤ 0 at each contact of a solution, so that w is the residual's work alone:
//! - Coulomb: r·ŷ = 0 with ŷ = y + μ‖y_t‖n, hence r·y = −μ‖y_t‖ r_n, the dissipation of friction; without friction it is zero;
//! - associated: r·y = 0;
//! - polyhedral Coulomb: r_n y_n = 0 and β·(σ + Dᵀy_t) = 0, hence r·y = −σ Σβ = −μ σ r_n;
//! - polyhedral associated: f·y_edge = 0 with edge impulses f; where R acts on them, r·(u + shift) = −fᵀR f.

use crate::tolerance::energy_balance::RESIDUAL_WORK;
use moreau_contact::problem::{Compliance, ContactProblem, Coordinates, Solution};
use nalgebra::DVector;

/// The work of the residual and of the compliance.
pub(super) struct Work {
    /// w \[J\].
    pub residual: f64,
    /// Largest w of an accepted step \[J\].
    pub limit: f64,
    /// rᵀR r or fᵀR f \[J\].
    pub softened: f64,
    /// Sum of the absolute values of what w is made of \[J\].
    pub size: f64,
}

/// R r per row, and fᵀRf per contact of a compliance on edges.
fn softness(problem: &ContactProblem, solution: &Solution, impulse: &DVector<f64>) -> (DVector<f64>, Vec<f64>) {
    let mut rows = DVector::zeros(problem.rows());
    let mut edges = vec![0.0; problem.contacts()];
    match (problem.compliance(), &solution.beta) {
        (Some(Compliance { coordinates: Coordinates::Contact, diagonal }), _) => rows = diagonal.component_mul(impulse),
        (Some(Compliance { coordinates: Coordinates::Edge, diagonal }), Some(beta)) => {
            let directions = beta.len() / problem.contacts();
            let work = beta.component_mul(beta).component_mul(diagonal);
            edges = work.as_slice().chunks(directions).map(|part| part.iter().sum()).collect();
        }
        _ => (),
    }
    (rows, edges)
}

/// The work of a solution's residual; y from the problem's own W, u_free and shift.
pub(super) fn work(problem: &ContactProblem, solution: &Solution, impulse: &DVector<f64>) -> Work {
    let (soft, edges) = softness(problem, solution, impulse);
    let pushed = problem.dense() * impulse;
    let data = problem.free_velocity() + problem.shift();
    let law_velocity = &pushed + &data + &soft;
    let reach = |row: usize| problem.entry(row, row).max(0.0).sqrt();
    let spread: f64 = impulse.iter().enumerate().map(|(row, r)| r.abs() * reach(row)).sum();
    let mut total = Work { residual: 0.0, limit: 0.0, softened: impulse.dot(&soft) + edges.iter().sum::<f64>(), size: spread * spread };
    let rows = problem.rows_per_contact();
    // a polyhedral law has d + 2 complementary pairs per contact, and the tolerance applies to each pair
    let pairs = problem.law().directions().map_or(1.0, |d| (d + 2) as f64);
    // the certificate's own scale: the largest impulse, or what the data of a contact alone ask of it
    let size = |(k, r): (usize, &[f64])| {
        let own = problem.entry(k * rows, k * rows);
        let asked = if own > 0.0 { data[k * rows].abs() / own } else { 0.0 };
        r.iter().fold(asked, |norm: f64, r| norm.hypot(*r))
    };
    let largest = impulse.as_slice().chunks(rows).enumerate().map(size).fold(0.0, f64::max);
    for (k, edge) in edges.iter().enumerate() {
        let part = |vector: &DVector<f64>| vector.rows(k * rows, rows).into_owned();
        let r = part(impulse);
        total.residual += (r.dot(&part(&law_velocity)) + edge).max(0.0);
        let own = (k * rows..(k + 1) * rows).map(|row| largest * problem.entry(row, row).max(0.0)).fold(0.0, f64::max);
        let velocity = own + part(&data).norm() + part(&pushed).norm() + part(&soft).norm();
        total.limit += RESIDUAL_WORK * (pairs * largest * velocity + edge);
        let terms = part(problem.free_velocity()).abs() + part(problem.shift()).abs() + part(&soft).abs();
        total.size += r.abs().dot(&terms) + edge;
    }
    total
}
