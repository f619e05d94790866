//! Mistakes that single out a direction, a place, a unit, a frame or a time step.

use crate::planted::Planted;
use crate::planted::parts::{Altered, Answers, answer, moreau_jean, row_by_row, with_solver};
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::{Auto, ContactSolver};
use moreau_exact::Result;
use nalgebra::DVector;
use std::f64::consts::PI;

/// The mistakes of this family.
pub const PLANTED: &[Planted] = &[
    Planted {
        name: "metamorphic/friction-along-axes",
        mistake: "bounds friction along two tangents taken from the world's axes by μ r_n each, and declares a cone",
        engine: || with_solver(|| Box::new(Answers(friction_along_axes))),
        caught_by: &["metamorphic/rotation", "metamorphic/tilt"],
    },
    Planted {
        name: "metamorphic/direction-rounded-down",
        mistake: "turns sliding friction to the next lower of sixteen directions instead of the nearest",
        engine: || with_solver(|| Box::new(Answers(direction_rounded_down))),
        caught_by: &["metamorphic/mirror", "metamorphic/rotation"],
    },
    Planted {
        name: "metamorphic/single-precision-positions",
        mistake: "stores positions with 24 bits and declares double precision",
        engine: || moreau_jean(|engine| engine.scheme = |_| Ok(Box::new(SINGLE))),
        caught_by: &["metamorphic/translation"],
    },
    Planted {
        name: "metamorphic/absolute-speed-limit",
        mistake: "limits every speed to 100 of whatever unit the scene has",
        engine: || moreau_jean(|engine| engine.scheme = |_| Ok(Box::new(LIMITED))),
        caught_by: &["metamorphic/units"],
    },
    Planted {
        name: "metamorphic/damping-in-the-world",
        mistake: "takes 4 % a second from every velocity and does not declare it",
        engine: || moreau_jean(|engine| engine.scheme = |_| Ok(Box::new(DAMPED))),
        caught_by: &["metamorphic/galilean"],
    },
    Planted {
        name: "metamorphic/damping-per-step",
        mistake: "takes 1 % from every velocity in every step, however long the step is",
        engine: || moreau_jean(|engine| engine.scheme = |_| Ok(Box::new(DAMPED_PER_STEP))),
        caught_by: &["metamorphic/halving", "metamorphic/galilean"],
    },
];

const SINGLE: Altered = Altered { position: |position| position.iter_mut().for_each(|x| *x = f64::from(*x as f32)), ..Altered::NOTHING };

const LIMITED: Altered =
    Altered { moving_velocity: |velocity| velocity.iter_mut().for_each(|v| *v = v.clamp(-100.0, 100.0)), ..Altered::NOTHING };

const DAMPED: Altered = Altered { free_velocity: |velocity, h| *velocity *= 1.0 - 0.04 * h, ..Altered::NOTHING };

const DAMPED_PER_STEP: Altered = Altered { free_velocity: |velocity, _| *velocity *= 0.99, ..Altered::NOTHING };

fn friction_along_axes(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    if problem.law() != Law::Coulomb {
        return Auto.solve(problem, Some(start));
    }
    let sweeps = 100;
    let limit = |impulse: &mut [f64], mu: f64| {
        impulse[0] = impulse[0].max(0.0);
        let bound = mu * impulse[0];
        impulse[1..].iter_mut().for_each(|r| *r = r.clamp(-bound, bound));
    };
    Ok(answer(problem, row_by_row(problem, start, sweeps, limit), sweeps))
}

fn direction_rounded_down(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let mut solution = Auto.solve(problem, Some(start))?;
    if problem.rows_per_contact() != 3 {
        return Ok(solution);
    }
    for (contact, r) in solution.impulse.as_mut_slice().chunks_mut(3).enumerate() {
        let friction = r[1].hypot(r[2]);
        let sliding = 0.999 * problem.friction()[contact] * r[0];
        if friction > 0.0 && friction >= sliding {
            let facet = PI / 8.0;
            let (sine, cosine) = ((r[2].atan2(r[1]) / facet).floor() * facet).sin_cos();
            (r[1], r[2]) = (friction * cosine, friction * sine);
        }
    }
    Ok(answer(problem, solution.impulse, solution.iterations))
}
