//! Sweeps that are extrapolated without a look at what comes out.

use super::answer::answer;
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_contact::solvers::{ContactSolver, ProjectedGaussSeidel};
use moreau_exact::Result;
use nalgebra::DVector;
use std::collections::VecDeque;

/// Sweeps of the extrapolation.
const LIMIT: usize = 60;

/// Sweeps that are remembered.
const MEMORY: usize = 5;

/// x⁺ = G(x) − ΔG γ with γ = argmin ‖f − ΔF γ‖, f = G(x) − x, G one sweep; the differences are those of the last steps.
pub(super) fn extrapolated(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let sweep = ProjectedGaussSeidel { sweeps: 1, ..Default::default() };
    let mut impulse = start.clone();
    let mut last: Option<[DVector<f64>; 2]> = None;
    let mut differences: VecDeque<[DVector<f64>; 2]> = VecDeque::new();
    for count in 1..=LIMIT {
        let image = sweep.solve(problem, Some(&impulse))?.impulse;
        let residual = &image - &impulse;
        if residual.norm() <= f64::EPSILON * image.norm() {
            return Ok(answer(problem, image, count));
        }
        if let Some([residual_before, image_before]) = last.take() {
            differences.push_front([&residual - residual_before, &image - image_before]);
            differences.truncate(MEMORY);
        }
        impulse = extrapolate(&residual, &image, &differences);
        last = Some([residual, image]);
    }
    Ok(answer(problem, impulse, LIMIT))
}

/// G(x) less the part of f that the differences ΔF span, newest first, carried over to ΔG; what is dependent to half the digits is left
/// out.
fn extrapolate(residual: &DVector<f64>, image: &DVector<f64>, differences: &VecDeque<[DVector<f64>; 2]>) -> DVector<f64> {
    let mut next = image.clone();
    let mut basis: Vec<[DVector<f64>; 2]> = Vec::new();
    for [change, moved] in differences {
        let (mut change, mut moved) = (change.clone(), moved.clone());
        let size = change.norm();
        for [known, known_moved] in &basis {
            let part = known.dot(&change);
            change.axpy(-part, known, 1.0);
            moved.axpy(-part, known_moved, 1.0);
        }
        let left = change.norm();
        if left > f64::EPSILON.sqrt() * size {
            next.axpy(-change.dot(residual) / (left * left), &moved, 1.0);
            basis.push([change / left, moved / left]);
        }
    }
    next
}
