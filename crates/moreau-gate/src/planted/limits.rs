//! Limits that nobody declared.

use crate::planted::parts::{Answers, with_solver};
use crate::planted::wrapped::{EachStep, Moment};
use crate::planted::{Faulty, Kind, Planted};
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_contact::solvers::{Auto, ContactSolver};
use moreau_dynamics::scenes::Scene;
use moreau_exact::Result;
use nalgebra::{DVector, Vector3};

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    Planted {
        name: "limits/speed-at-most-100",
        mistake: "lets no body move faster than 100 m/s, and does not declare it",
        kind: Kind::Scheme,
        subject: Faulty { engine: || Box::new(EachStep { after: slowed, ..EachStep::NOTHING }), caught_by: &["limits/fast"] },
    },
    Planted {
        name: "limits/spin-at-most-50",
        mistake: "lets no body spin faster than 50 rad/s, and does not declare it",
        kind: Kind::Scheme,
        subject: Faulty { engine: || Box::new(EachStep { after: spun_down, ..EachStep::NOTHING }), caught_by: &["limits/fast"] },
    },
    Planted {
        name: "limits/static-friction",
        mistake: "lets contacts stick up to 1.05 μ and slide with μ, and does not declare it",
        kind: Kind::Solver,
        subject: Faulty { engine: || with_solver(|| Box::new(Answers(sticking_longer))), caught_by: &["limits/stick"] },
    },
    Planted {
        name: "limits/sticks-up-to-0.97",
        mistake: "lets a contact slide with μ that needs more than 0.97 μ to stick: one of four corners always sticks, a single point \
            does not",
        kind: Kind::Solver,
        subject: Faulty {
            engine: || with_solver(|| Box::new(Answers(moreau_checks::defects::solvers::sticking_up_to_0_97))),
            caught_by: &["limits/stick"],
        },
    },
];

fn slowed(scene: &mut Scene, _: &Moment) {
    scene.bodies.iter_mut().for_each(|body| body.linear_velocity = Vector3::from(body.linear_velocity).cap_magnitude(100.0).into());
}

fn spun_down(scene: &mut Scene, _: &Moment) {
    scene.bodies.iter_mut().for_each(|body| body.angular_velocity = Vector3::from(body.angular_velocity).cap_magnitude(50.0).into());
}

/// The answer with 1.05 μ if no contact slides in it, beyond what solvers leave; that with μ otherwise.
fn sticking_longer(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let friction: Vec<f64> = problem.friction().iter().map(|mu| 1.05 * mu).collect();
    let held = Auto.solve(&problem.clone().into_builder().friction(friction).build()?, Some(start))?;
    let rows = problem.rows_per_contact();
    let slip = |contact: usize| held.velocity.rows(contact * rows + 1, rows - 1).norm();
    let sticks = (0..problem.contacts()).all(|contact| slip(contact) <= crate::tolerance::SOLVED * problem.free_velocity().norm());
    if sticks { Ok(held) } else { Auto.solve(problem, Some(start)) }
}
