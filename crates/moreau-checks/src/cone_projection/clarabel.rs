//! The projection as an optimisation problem, solved by the interior-point method Clarabel and believed by its certificate.
//!
//! ```text
//!     minimise ½‖x − z‖²   subject to   (μ x_n, x_t) in the second-order cone;      for μ = 0: x_n ≥ 0, x_t = 0 .
//! ```
//! Clarabel's slack and multiplier lie in their cones whatever its stopping test says, so they give a point x ∈ K_μ and a
//! p in the dual cone, and the gap between the two objectives,
//! ```text
//!     ½‖x − z‖² + z·p + ½‖p‖² = ½‖x − z − p‖² + x·p ,
//! ```
//! bounds the distance from the minimiser x* by strong convexity: `‖x − x*‖ ≤ √(‖x − z − p‖² + 2 x·p)`. One draw in ten
//! thousand ends as `AlmostSolved`: it is judged by the same inequality, with the radius that its own answer proves.

use super::{Finding, Projection, apply, cone_excess, difference, dot, norm, polar_excess};
use crate::tolerance::cone_projection as tolerance;
use ::clarabel::algebra::CscMatrix;
use ::clarabel::solver::SupportedConeT::{NonnegativeConeT, SecondOrderConeT, ZeroConeT};
use ::clarabel::solver::{DefaultSettings, DefaultSettingsBuilder, DefaultSolver, IPSolver};
use moreau_exact::{Error, Result};

/// A point of the cone and how far it is from the projection at most.
#[derive(Clone, Debug)]
pub struct Certified {
    /// x ∈ K_μ \[N·s\].
    pub point: Vec<f64>,
    /// The radius `√(‖x − z − p‖² + 2 x·p)` that the multiplier proves \[N·s\].
    pub radius: f64,
}

/// The diagonal of the map from x to the cones' vector: (μ x_n, x_t), or x itself for μ = 0.
fn row_scale(row: usize, mu: f64) -> f64 {
    if row == 0 && mu > 0.0 { mu } else { 1.0 }
}

fn settings() -> Result<DefaultSettings<f64>> {
    DefaultSettingsBuilder::default()
        .verbose(false)
        .tol_gap_abs(tolerance::CLARABEL_STOPPING)
        .tol_gap_rel(tolerance::CLARABEL_STOPPING)
        .tol_feas(tolerance::CLARABEL_STOPPING)
        .build()
        .map_err(|error| Error::breakdown("clarabel", error.to_string()))
}

/// Clarabel's minimiser of `½‖x − z‖²` over K_μ with the radius of its certificate.
///
/// # Errors
/// If Clarabel refuses the problem, its points are not in their cones, or the radius is too large to say anything.
pub fn minimiser(z: &[f64], mu: f64) -> Result<Certified> {
    let size = z.len();
    let cones = if mu > 0.0 { vec![SecondOrderConeT(size)] } else { vec![NonnegativeConeT(1), ZeroConeT(size - 1)] };
    let linear: Vec<f64> = z.iter().map(|entry| -entry).collect();
    let diagonal: Vec<f64> = (0..size).map(|row| -row_scale(row, mu)).collect();
    let matrix = CscMatrix::new(size, size, (0..=size).collect(), (0..size).collect(), diagonal);
    let mut solver = DefaultSolver::new(&CscMatrix::identity(size), &linear, &matrix, &vec![0.0; size], &cones, settings()?)
        .map_err(|error| Error::breakdown("clarabel", error.to_string()))?;
    solver.solve();
    let answer = &solver.solution;
    let point: Vec<f64> = answer.s.iter().enumerate().map(|(row, s)| s / row_scale(row, mu)).collect();
    let multiplier: Vec<f64> = answer.z.iter().enumerate().map(|(row, y)| y * row_scale(row, mu)).collect();
    certified(z, mu, point, &multiplier)
        .map_err(|reason| Error::breakdown("clarabel", format!("projection of {z:?} for μ = {mu} ended as {}: {reason}", answer.status)))
}

/// The point with its radius, after a check that the point and the multiplier lie in their cones.
fn certified(z: &[f64], mu: f64, point: Vec<f64>, multiplier: &[f64]) -> std::result::Result<Certified, String> {
    let minus: Vec<f64> = multiplier.iter().map(|entry| -entry).collect();
    let size = norm(&point).max(norm(multiplier));
    let outside = cone_excess(&point, mu).max(polar_excess(&minus, mu));
    if outside.is_nan() || outside > tolerance::position(size) {
        return Err(format!("the point or the multiplier lies {outside:e} outside its cone"));
    }
    let mismatch = norm(&difference(&difference(&point, z), multiplier));
    let radius = (mismatch * mismatch + 2.0 * dot(&point, multiplier).max(0.0)).sqrt();
    if radius.is_nan() || radius > tolerance::clarabel_radius(norm(z)) {
        return Err(format!("its certificate gives the radius {radius:e}, which is too large to judge a projection"));
    }
    Ok(Certified { point, radius })
}

/// The subject's projection lies within the radius of Clarabel's certificate.
///
/// # Errors
/// As [`minimiser`].
pub fn equals_clarabel(subject: Projection, z: &[f64], mu: f64) -> Result<Vec<Finding>> {
    let reference = minimiser(z, mu)?;
    let distance = norm(&difference(&apply(subject, z, mu), &reference.point));
    let bound = reference.radius + tolerance::clarabel_rounding(norm(z), norm(&reference.point));
    Ok(vec![Finding::at_most("distance from Clarabel's projection", distance, bound, "N·s")])
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_contact::cones::second_order::project;

    /// The draw that Clarabel ends as `AlmostSolved`, found by CI.
    const HARD: ([f64; 2], f64) = ([0.6378278104428724, 1.82267243469381], 2.857102059847257);

    #[test]
    fn an_almost_solved_problem_is_judged_by_its_certificate() {
        let (z, mu) = HARD;
        assert!(equals_clarabel(project, &z, mu).unwrap().iter().all(Finding::holds));
        let wrong: Projection = |z, _| z[0] += 1e-3;
        assert!(!equals_clarabel(wrong, &z, mu).unwrap().iter().all(Finding::holds));
    }

    #[test]
    fn a_false_certificate_is_refused() {
        // z = (−1, 2), μ = 1: x* = (1/2, 1/2), p* = (3/2, −3/2)
        let z = [-1.0, 2.0];
        assert_eq!(certified(&z, 1.0, vec![0.5, 0.5], &[1.5, -1.5]).unwrap().radius, 0.0);
        assert!(certified(&z, 1.0, vec![0.5, 0.6], &[1.5, -1.5]).unwrap_err().contains("outside its cone"));
        assert!(certified(&z, 1.0, vec![0.5, 0.5], &[1.5, -1.6]).unwrap_err().contains("outside its cone"));
        assert!(certified(&z, 1.0, vec![0.6, 0.5], &[1.5, -1.5]).unwrap_err().contains("radius"));
        assert!(certified(&z, 1.0, vec![f64::NAN, 0.5], &[1.5, -1.5]).is_err());
        let loose = certified(&z, 1.0, vec![0.5 + 1e-6, 0.5 - 1e-6], &[1.5, -1.5]).unwrap();
        assert!(loose.radius >= f64::hypot(1e-6, 1e-6), "{}", loose.radius);
    }
}
