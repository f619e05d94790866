//! Mistakes of solvers that show in the motion of thrown boxes: answers that are used without being checked.

use crate::Engine;
use crate::planted::Planted;
use crate::planted::parts::{Answers, answer, with_mechanism, with_solver};
use crate::planted::wrapped::{Misdeclare, declare_springs};
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_contact::solvers::{Auto, ContactSolver, ProjectedGaussSeidel};
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::scenes::Scene;
use moreau_exact::Result;
use nalgebra::DVector;
use std::collections::VecDeque;

/// The mistakes of this family.
pub const PLANTED: &[Planted] = &[
    Planted {
        name: "tumbling/extrapolated-sweeps",
        mistake: "extrapolates sweeps by Anderson's rule, takes no step back however much worse it is, and answers its last iterate at the \
            limit",
        engine: || with_solver(|| Box::new(Answers(extrapolated))),
        caught_by: &["tumbling/rough"],
    },
    Planted {
        name: "tumbling/two-sweeps",
        mistake: "starts from zero impulses, stops after two sweeps and answers the impulses of that moment",
        engine: || with_solver(|| Box::new(Answers(two_sweeps))),
        caught_by: &["tumbling/passive"],
    },
    Planted {
        name: "tumbling/stale-impulses",
        mistake: "answers the impulses of the step before, as they are, where the contacts are the same",
        engine: || with_solver(|| Box::new(Answers(stale))),
        caught_by: &["tumbling/passive", "tumbling/bouncing", "tumbling/rough", "tumbling/rest"],
    },
    Planted {
        name: "tumbling/springs-and-extrapolated-sweeps",
        mistake: "declares contact springs of 60 Hz, and extrapolates sweeps without looking at what comes out",
        engine: || sprung(|| with_solver(|| Box::new(Answers(extrapolated)))),
        caught_by: &["tumbling/rough"],
    },
    Planted {
        name: "tumbling/springs-and-two-sweeps",
        mistake: "declares contact springs of 60 Hz, and stops at a limit of two sweeps",
        engine: || sprung(|| with_solver(|| Box::new(Answers(two_sweeps)))),
        caught_by: &["tumbling/passive"],
    },
    Planted {
        name: "tumbling/deeper-than-its-springs",
        mistake: "declares contact springs of 60 Hz, which carry a body at 0.07 mm, and lets it lie 2 cm deep",
        engine: || sprung(|| with_mechanism(sunk)),
        caught_by: &["tumbling/rest"],
    },
];

/// An engine that declares springs of 60 Hz. The allowance for these springs must not hide another mistake.
fn sprung(engine: fn() -> Box<dyn Engine>) -> Box<dyn Engine> {
    Box::new(Misdeclare { engine, declare: |description| declare_springs(description, 60.0) })
}

fn sunk(scene: &Scene) -> Result<(Box<dyn Mechanism>, State)> {
    let mut scene = scene.clone();
    if let Some(ground) = &mut scene.ground {
        ground.offset -= 0.02;
    }
    scene.spatial_mechanism()
}

/// Sweeps of the extrapolation.
const LIMIT: usize = 60;

/// Sweeps that are remembered.
const MEMORY: usize = 5;

/// x⁺ = G(x) − ΔG γ with γ = argmin ‖f − ΔF γ‖, f = G(x) − x, G one sweep; the differences are those of the last steps.
fn extrapolated(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
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

fn two_sweeps(problem: &ContactProblem, _start: &DVector<f64>) -> Result<Solution> {
    ProjectedGaussSeidel { sweeps: 2, ..Default::default() }.solve(problem, None)
}

fn stale(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let known = start.as_slice().chunks(problem.rows_per_contact()).all(|impulse| impulse[0] > 0.0);
    if known { Ok(answer(problem, start.clone(), 0)) } else { Auto.solve(problem, Some(start)) }
}
