//! Mistakes of contact solvers. They show in scenes as well as in problems.

use super::Planted;
use super::parts::{Answers, answer, row_by_row, with_solver};
use crate::Result;
use crate::problem::{ContactProblem, Law, Solution};
use crate::solvers::{ContactSolver, ProjectedGaussSeidel, Reference};
use nalgebra::DVector;

/// The mistakes of this family.
pub const PLANTED: &[Planted] = &[
    Planted {
        name: "solver/three-sweeps",
        mistake: "Gauss–Seidel stops after three sweeps and forgets the impulses of the step before",
        engine: || with_solver(|_| Ok(Box::new(Answers(three_sweeps)))),
        caught_by: &["solver/redundant", "solver/conditioning", "stack/five", "stack/ten", "stack/mass-ratio", "metamorphic/body-order"],
    },
    Planted {
        name: "solver/no-impulse",
        mistake: "answers zero impulses to every problem",
        engine: || with_solver(|_| Ok(Box::new(Answers(|problem, _| Ok(answer(problem, DVector::zeros(problem.rows()), 0)))))),
        caught_by: &["solver/certificate", "solver/redundant", "solver/jamming", "stack/five"],
    },
    Planted {
        name: "solver/normal-impulses-clipped",
        mistake: "keeps normal impulses from pulling and lets friction be as large as sticking needs",
        engine: || with_solver(|_| Ok(Box::new(Answers(normals_clipped)))),
        caught_by: &["solver/certificate", "solver/jamming"],
    },
    Planted {
        name: "solver/shift-ignored",
        mistake: "leaves out what the scheme adds to the velocity: restitution, φ/h",
        engine: || with_solver(|_| Ok(Box::new(Answers(shift_ignored)))),
        caught_by: &["solver/certificate", "solver/redundant"],
    },
    Planted {
        name: "solver/convex-relaxation",
        mistake: "declares Coulomb's law and solves the associated one, which lifts what slides",
        engine: || with_solver(|_| Ok(Box::new(Answers(convex_relaxation)))),
        caught_by: &["solver/certificate", "solver/friction-range"],
    },
    Planted {
        name: "solver/velocity-as-wished",
        mistake: "reports the velocity the law asks for instead of the one its impulses give",
        engine: || with_solver(|_| Ok(Box::new(Answers(velocity_as_wished)))),
        caught_by: &["solver/infeasible"],
    },
];

fn three_sweeps(problem: &ContactProblem, _start: &DVector<f64>) -> Result<Solution> {
    ProjectedGaussSeidel { sweeps: 3, ..Default::default() }.solve(problem, None)
}

fn normals_clipped(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let sweeps = 200;
    Ok(answer(problem, row_by_row(problem, start, sweeps, |impulse, _| impulse[0] = impulse[0].max(0.0)), sweeps))
}

fn shift_ignored(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let mut plain = problem.clone();
    plain.shift.fill(0.0);
    Reference.solve(&plain, Some(start))
}

fn convex_relaxation(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let mut convex = problem.clone();
    if convex.law == Law::Coulomb {
        convex.law = Law::Associated;
    }
    Reference.solve(&convex, Some(start))
}

fn velocity_as_wished(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let mut solution = Reference.solve(problem, Some(start))?;
    for normal in (0..problem.rows()).step_by(problem.rows_per_contact) {
        solution.velocity[normal] = solution.velocity[normal].max(-problem.shift[normal]);
    }
    Ok(solution)
}
