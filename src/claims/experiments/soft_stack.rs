//! One step of MuJoCo's model for a stack of boxes, each a little narrower than the one below, everything 0.1 mm deep, sliding and turning
//! to and fro.

use crate::mechanics::spatial::{Shape, SpatialBody};
use crate::mechanics::{Plane, SpatialBodies, State};
use crate::problem::ContactProblem;
use crate::schemes::mujoco::{Cone, Mujoco};
use crate::schemes::{StepProblem, assembled};
use crate::solvers::GaussNewton;
use crate::solvers::gauss::GaussProgram;
use crate::{Error, Result};
use nalgebra::{DVector, dvector};

/// h of the step \[s\], MuJoCo's default.
pub const STEP: f64 = 0.002;

/// The mechanism and its state: n ≤ 15 boxes, box k of mass ratioᵏ kg.
///
/// # Errors
/// Those of [`SpatialBodies::new`].
pub fn stack(boxes: usize, ratio: f64) -> Result<(SpatialBodies, State)> {
    let body = |k: usize| {
        let half = 0.1 - 0.005 * k as f64;
        SpatialBody::solid(format!("box{k}"), Shape::Box { half_extents: [half, half, 0.1] }, ratio.powi(k as i32))
    };
    let bodies = (0..boxes).map(body).collect::<Result<Vec<_>>>()?;
    let ground = Plane::new(dvector![0.0, 0.0, 1.0], 0.0, 0.5, 0.0)?;
    let mechanism = SpatialBodies::new("stack", bodies, [0.0, 0.0, -9.81], ground)?;
    let place = |k: usize| [0.0, 0.0, 0.1 + 0.2 * k as f64 - 0.0001 * (k + 1) as f64, 1.0, 0.0, 0.0, 0.0];
    let position = DVector::from_iterator(7 * boxes, (0..boxes).flat_map(place));
    let rate = |k: usize| {
        let side = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        [0.3 * side, 0.1, -0.02, 0.4 * side, -0.3, 0.2 * side]
    };
    let velocity = DVector::from_iterator(6 * boxes, (0..boxes).flat_map(rate));
    Ok((mechanism, State { time: 0.0, position, velocity }))
}

/// The step's contact problem.
///
/// # Errors
/// Those of [`stack`] and of the assembly.
pub fn problem(boxes: usize, ratio: f64, cone: Cone) -> Result<ContactProblem> {
    let (mechanism, state) = stack(boxes, ratio)?;
    assemble(&mechanism, &state, cone)
}

/// The step's contact problem of one ball of 1 kg, 0.1 mm deep.
///
/// # Errors
/// Those of [`problem`].
pub fn ball(cone: Cone) -> Result<ContactProblem> {
    let body = SpatialBody::solid("ball", Shape::Sphere { radius: 0.1 }, 1.0)?;
    let ground = Plane::new(dvector![0.0, 0.0, 1.0], 0.0, 0.5, 0.0)?;
    let mechanism = SpatialBodies::new("ball", vec![body], [0.0, 0.0, -9.81], ground)?;
    let position = dvector![0.0, 0.0, 0.1 - 0.0001, 1.0, 0.0, 0.0, 0.0];
    assemble(&mechanism, &State { time: 0.0, position, velocity: DVector::zeros(6) }, cone)
}

fn assemble(mechanism: &SpatialBodies, state: &State, cone: Cone) -> Result<ContactProblem> {
    let StepProblem { problem, .. } = assembled(&Mujoco::standard(cone), mechanism, state, STEP)?;
    problem.ok_or_else(|| Error::Unsupported("the boxes overlap and touch".into()))
}

/// How far a change of velocity of a stack of three is from the one that is found again from its push, relative; the push counts so much
/// of the contact forces.
///
/// # Errors
/// Those of the solver.
pub fn found_again(share_of_forces: f64) -> Result<f64> {
    let problem = problem(3, 1.0, Cone::Elliptic)?;
    let program = GaussProgram::of_problem("newton", &problem)?;
    let wanted = DVector::from_fn(program.velocities(), |k, _| 0.01 * ((7 * k + 3) % 11) as f64 - 0.05);
    let forces = program.impulse(&program.violation(&wanted)) * share_of_forces;
    let push = program.gradient(&wanted, &forces);
    // with the push, free motion is faster by M⁻¹p: offsets by HM⁻¹p, and the change is counted from there
    let free = program.accelerate(&push);
    let offset = program.offset() + program.motion(&free);
    let found = GaussNewton::default().minimise(&program.with_offset(offset), DVector::zeros(free.len()))?.change + free;
    Ok((&found - &wanted).norm() / wanted.norm())
}
