//! Mistakes that make an answer depend on more than the question.

use crate::planted::parts::{Answers, with_solver};
use crate::planted::{Faulty, Kind, Planted};
use moreau_checks::defects::solvers::answer;
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_contact::solvers::{ContactSolver, ProjectedGaussSeidel};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    Planted {
        name: "determinism/random-order",
        mistake: "sweeps over the contacts in an order drawn from a global state that is not reset, and stops early",
        kind: Kind::Solver,
        subject: Faulty {
            engine: || with_solver(|| Box::new(Answers(random_order))),
            caught_by: &["determinism/repeat", "determinism/company"],
        },
    },
    Planted {
        name: "determinism/impulses-kept",
        mistake: "starts new contacts from a buffer of impulses that is not cleared between requests, and stops early",
        kind: Kind::Solver,
        subject: Faulty { engine: || with_solver(|| Box::new(Answers(impulses_kept))), caught_by: &["determinism/company"] },
    },
    Planted {
        name: "determinism/memory-not-written",
        mistake: "the last digits of the impulses come from memory that holds what was there before",
        kind: Kind::Solver,
        subject: Faulty {
            engine: || with_solver(|| Box::new(Answers(memory_not_written))),
            caught_by: &["determinism/repeat", "determinism/company"],
        },
    },
];

/// How often any of these engines has been asked for anything.
static CALLS: AtomicUsize = AtomicUsize::new(0);

/// Impulses left by whatever was solved before.
static LEFT: Mutex<Vec<f64>> = Mutex::new(Vec::new());

const EARLY: ProjectedGaussSeidel = ProjectedGaussSeidel { sweeps: 4, tolerance: 0.0, memory: 0 };

/// Contact k of the swept problem is contact (k + turn) mod n of the given one.
fn random_order(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let (rows, contacts) = (problem.rows_per_contact(), problem.contacts());
    let turn = CALLS.fetch_add(1, Ordering::Relaxed) % contacts;
    let from = |i: usize| (i / rows + turn) % contacts * rows + i % rows;
    let permuted = |vector: &DVector<f64>| DVector::from_fn(vector.len(), |i, _| vector[from(i)]);
    let turned = problem.clone().into_builder().friction((0..contacts).map(|k| problem.friction()[(k + turn) % contacts]).collect());
    let turned = turned.free_velocity(permuted(problem.free_velocity())).shift(permuted(problem.shift())).dynamics(None);
    let delassus = DMatrix::from_fn(problem.rows(), problem.rows(), |i, j| problem.entry(from(i), from(j)));
    let turned = turned.delassus(delassus).build()?;
    let solution = EARLY.solve(&turned, Some(&permuted(start)))?;
    let mut impulse = DVector::zeros(problem.rows());
    (0..problem.rows()).for_each(|i| impulse[from(i)] = solution.impulse[i]);
    Ok(answer(problem, impulse, solution.iterations))
}

fn impulses_kept(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let mut left = LEFT.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let kept = DVector::from_fn(start.len(), |i, _| if start[i] == 0.0 { left.get(i).copied().unwrap_or(0.0) } else { start[i] });
    let solution = EARLY.solve(problem, Some(&kept))?;
    if left.len() < problem.rows() {
        left.resize(problem.rows(), 0.0);
    }
    left[..problem.rows()].copy_from_slice(solution.impulse.as_slice());
    Ok(solution)
}

fn memory_not_written(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let solution = ProjectedGaussSeidel::default().solve(problem, Some(start))?;
    let digits = 1.0 + (CALLS.fetch_add(1, Ordering::Relaxed) % 7) as f64 * f64::EPSILON;
    Ok(answer(problem, solution.impulse * digits, solution.iterations))
}
