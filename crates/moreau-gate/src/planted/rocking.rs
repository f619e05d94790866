//! Mistakes at impacts that turn a body: rocking blocks and Painlevé's rod.

use crate::planted::Planted;
use crate::planted::parts::{Answers, answer, row_by_row, with_mechanism, with_solver};
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::scenes::Scene;
use moreau_exact::Result;
use nalgebra::DVector;

/// The mistakes of this family.
pub const PLANTED: &[Planted] = &[
    Planted {
        name: "rocking/contacts-glued",
        mistake: "solves the active contacts as equations, so that an impact also holds the edge that should lift",
        engine: || with_solver(|| Box::new(Answers(contacts_glued))),
        caught_by: &["rocking/impact", "solver/certificate"],
    },
    Planted {
        name: "rocking/full-edges",
        mistake: "takes half edges for edges in the box's moments of inertia, which become a quarter of the right ones",
        engine: || with_mechanism(full_edges),
        caught_by: &["rocking/fall-time"],
    },
    Planted {
        name: "painleve/slip-fixed-in-advance",
        mistake: "sweeps over normal impulses with friction −μ r_n t tied to them, t the slip before the step",
        engine: || with_solver(|| Box::new(Answers(slip_fixed_in_advance))),
        caught_by: &["painleve/rod", "solver/certificate"],
    },
];

fn contacts_glued(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let sweeps = 400;
    Ok(answer(problem, row_by_row(problem, start, sweeps, |_, _| {}), sweeps))
}

fn full_edges(scene: &Scene) -> Result<(Box<dyn Mechanism>, State)> {
    let mut scene = scene.clone();
    for body in &mut scene.bodies {
        if let (Some(cuboid), None) = (body.cuboid, body.inertia) {
            let [a, b, c] = cuboid.half_extents.map(|half| half * half);
            body.inertia = Some([b + c, a + c, a + b].map(|squares| body.mass * squares / 12.0));
        }
    }
    scene.spatial_mechanism()
}

/// Gauss–Seidel over the contacts with one unknown each, r = r_n (1, −μ t), t the direction of the slip without impulses: where
/// W_nn + μ W_nt < 0 every sweep adds to the impulse.
fn slip_fixed_in_advance(problem: &ContactProblem, start: &DVector<f64>) -> Result<Solution> {
    let (rows, sweeps) = (problem.rows_per_contact(), 8);
    let mut impulse = DVector::zeros(start.len());
    for _ in 0..sweeps {
        for contact in 0..problem.contacts() {
            let first = contact * rows;
            let slip = problem.free_velocity().rows(first + 1, rows - 1);
            let norm = slip.norm();
            let direction = DVector::from_fn(rows, |k, _| match k {
                0 => 1.0,
                _ if norm > 0.0 => -problem.friction()[contact] * slip[k - 1] / norm,
                _ => 0.0,
            });
            let row = problem.dense().row(first);
            let y = row.tr_dot(&impulse) + problem.free_velocity()[first] + problem.shift()[first];
            let known = impulse[first];
            let normal = (known - y / row[first]).max(0.0);
            impulse.rows_mut(first, rows).copy_from(&(direction * normal));
        }
    }
    Ok(answer(problem, impulse, sweeps))
}
