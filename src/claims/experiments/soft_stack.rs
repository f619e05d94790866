//! One step of MuJoCo's model for a stack of boxes, each a little narrower than the one below, everything 0.1 mm deep, sliding and turning
//! to and fro.

use crate::mechanics::spatial::{Shape, SpatialBody};
use crate::mechanics::{Plane, SpatialBodies, State};
use crate::problem::ContactProblem;
use crate::schemes::mujoco::{Cone, Mujoco};
use crate::schemes::{StepProblem, assembled};
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
