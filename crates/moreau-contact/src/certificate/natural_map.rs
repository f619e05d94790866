//! The natural map of one contact, r − P_K(r − ρ ŷ), with ŷ = y + μ‖y_t‖n for Coulomb's law and ŷ = y otherwise.
//!
//! It vanishes exactly at solutions, for every ρ > 0 \[kg\]. With ρ = 3/tr(W_kk + R_kk), or the number of rows instead of 3,
//! it is an impulse: a change of units scales it as it scales r, and a rotation of the tangents leaves its norm alone.

use crate::cones::{de_saxce, second_order};
use crate::problem::{ContactProblem, Law};
use nalgebra::DVector;

/// Replaces y by ŷ: y + μ‖y_t‖n for Coulomb's law, y for the others.
pub fn correct(law: Law, friction: f64, y: &mut [f64]) {
    if law == Law::Coulomb {
        de_saxce::correct(y, friction);
    }
}

/// ‖r − P_K(r − ρ ŷ)‖ \[N·s\] of one contact with impulse r \[N·s\] and law velocity y \[m/s\], both (n, t₁, t₂) as long as the contact has
/// rows; the law is frictionless, Coulomb or associated.
pub fn natural_map(law: Law, friction: f64, impulse: &[f64], law_velocity: &[f64], rho: f64) -> f64 {
    let rows = impulse.len();
    let mut corrected = [0.0; 3];
    corrected[..rows].copy_from_slice(law_velocity);
    correct(law, friction, &mut corrected[..rows]);
    let mut projected = [0.0; 3];
    for k in 0..rows {
        projected[k] = impulse[k] - rho * corrected[k];
    }
    second_order::project(&mut projected[..rows], law.cone_friction(friction));
    (0..rows).map(|k| (impulse[k] - projected[k]).powi(2)).sum::<f64>().sqrt()
}

/// ‖r − P_K(r − ŷ)‖/‖q‖ over all contacts, with ρ = 1 kg: the number that other collections compare. It changes with the units of the
/// problem. None for polyhedral laws and where q is zero.
pub fn of_unit_mass(problem: &ContactProblem, impulse: &DVector<f64>) -> Option<f64> {
    let size = (problem.free_velocity() + problem.shift()).norm();
    if problem.law().directions().is_some() || size == 0.0 {
        return None;
    }
    let (rows, velocity) = (problem.rows_per_contact(), problem.law_velocity(impulse));
    let contacts = impulse.as_slice().chunks_exact(rows).zip(velocity.as_slice().chunks_exact(rows)).zip(problem.friction());
    let squares = contacts.map(|((r, y), mu)| natural_map(problem.law(), *mu, r, y, 1.0).powi(2));
    Some(squares.sum::<f64>().sqrt() / size)
}

/// ρ \[kg\] of every contact: rows/tr(W_kk + R_kk). A contact whose block has no positive trace takes the mean of the others, and 1 kg
/// if there is none: the zeros of the natural map do not depend on it.
pub fn scales(problem: &ContactProblem) -> Vec<f64> {
    let rows = problem.rows_per_contact();
    let trace =
        |contact: usize| -> f64 { (contact * rows..(contact + 1) * rows).map(|k| problem.entry(k, k) + problem.row_compliance(k)).sum() };
    let traces: Vec<f64> = (0..problem.contacts()).map(trace).collect();
    let positive: Vec<f64> = traces.iter().copied().filter(|&t| t > 0.0).collect();
    let fallback = if positive.is_empty() { rows as f64 } else { positive.iter().sum::<f64>() / positive.len() as f64 };
    traces.into_iter().map(|t| rows as f64 / if t > 0.0 { t } else { fallback }).collect()
}
