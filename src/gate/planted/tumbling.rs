//! Mistakes of solvers that show in the motion of thrown boxes: answers that nobody looked at before they were used.

use super::Planted;
use super::parts::{Answers, answer, with_solver};
use crate::Result;
use crate::problem::{ContactProblem, Solution};
use crate::solvers::{ContactSolver, ProjectedGaussSeidel, Reference};
use nalgebra::{DMatrix, DVector};

/// The mistakes of this family.
pub const PLANTED: &[Planted] = &[
    Planted {
        name: "tumbling/extrapolated-sweeps",
        mistake: "extrapolates sweeps by Anderson's rule, takes no step back however much worse it is, and answers its last iterate at the limit",
        engine: || with_solver(|_| Ok(Box::new(Answers(extrapolated)))),
        caught_by: &["tumbling/passive"],
    },
    Planted {
        name: "tumbling/two-sweeps",
        mistake: "stops at a limit of two sweeps from zero and answers what it has",
        engine: || with_solver(|_| Ok(Box::new(Answers(two_sweeps)))),
        caught_by: &["tumbling/rest"],
    },
    Planted {
        name: "tumbling/stale-impulses",
        mistake: "answers the impulses of the step before, as they are, where the contacts are the same",
        engine: || with_solver(|_| Ok(Box::new(Answers(stale)))),
        caught_by: &["tumbling/passive"],
    },
];

/// Iterations of the extrapolation.
const LIMIT: usize = 60;

/// Sweeps that are remembered.
const MEMORY: usize = 6;

/// x⁺ = G(x) − ΔG γ with γ = argmin ‖f − ΔF γ‖, f = G(x) − x, G one sweep; the differences are those of the last steps.
fn extrapolated(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let sweep = |x: &DVector<f64>| Ok::<_, crate::Error>(ProjectedGaussSeidel { sweeps: 1, ..Default::default() }.solve(problem, Some(x))?.impulse);
    let (mut x, mut last): (_, Option<[DVector<f64>; 2]>) = (start.clone(), None);
    let (mut moved, mut changes): (Vec<DVector<f64>>, Vec<DVector<f64>>) = (Vec::new(), Vec::new());
    for _ in 0..LIMIT {
        let image = sweep(&x)?;
        let residual = &image - &x;
        if residual.norm() <= f64::EPSILON * image.norm() {
            return Ok(answer(problem, image, LIMIT));
        }
        if let Some([image_before, residual_before]) = last {
            moved.insert(0, &image - image_before);
            changes.insert(0, &residual - residual_before);
            moved.truncate(MEMORY);
            changes.truncate(MEMORY);
        }
        x = image.clone();
        if !changes.is_empty() {
            // Columns that are dependent to half the digits are left out.
            let least = f64::EPSILON.sqrt() * changes.iter().map(DVector::norm).fold(0.0, f64::max);
            let factors = DMatrix::from_columns(&changes).svd(true, true).solve(&residual, least);
            if let Ok(factors) = factors {
                x -= DMatrix::from_columns(&moved) * factors;
            }
        }
        last = Some([image, residual]);
    }
    Ok(answer(problem, x, LIMIT))
}

fn two_sweeps(problem: &ContactProblem, _start: &DVector<f64>) -> Result<Solution> {
    ProjectedGaussSeidel { sweeps: 2, ..Default::default() }.solve(problem, None)
}

fn stale(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let known = start.as_slice().chunks(problem.rows_per_contact).all(|impulse| impulse[0] > 0.0);
    if known { Ok(answer(problem, start.clone(), 0)) } else { Reference.solve(problem, Some(start)) }
}
