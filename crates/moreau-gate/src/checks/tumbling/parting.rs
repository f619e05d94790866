//! How fast touching bodies part before a step.
//!
//! ```text
//!     floor    max of v_z over the corners that are nearer to the floor than a free step takes them
//!     boxes    max of ‖v₁(x) − v₂(x)‖ over the points x of both; it is affine in x, so that a corner has the largest
//! ```

use crate::checks::scenery::{GRAVITY, worst};
use crate::checks::tumbling::motion::Tumble;
use crate::checks::tumbling::overlap::{Placed, overlap};
use crate::tolerance::tumbling as tolerance;

/// Bounds \[m/s\] on the speeds at which contacts with the floor and between the bodies part, after k steps; 0 where nothing touches.
pub(super) fn fastest(tumble: &Tumble, k: usize) -> [f64; 2] {
    let placed = tumble.placed(k);
    let near = |body: usize| tolerance::near(placed[body].state.spin.norm(), tumble.bodies[body].radius(), GRAVITY, tumble.h);
    let floor = (0..placed.len()).map(|body| off_floor(&placed[body], near(body))).fold(0.0, worst);
    let pair = match placed.as_slice() {
        [one, other] if overlap(one, other) >= -(near(0) + near(1)) => relative(one, other).min(relative(other, one)),
        _ => 0.0,
    };
    [floor, pair]
}

/// The fastest rising corner \[m/s\] within `near` \[m\] of the floor.
fn off_floor(body: &Placed, near: f64) -> f64 {
    let touching = body.corners().filter(|corner| body.state.position.z + corner.z <= near);
    touching.map(|corner| body.state.velocity_at(corner).z).fold(0.0, worst)
}

/// The largest speed \[m/s\] of a corner relative to the points of the other body where it is.
fn relative(body: &Placed, other: &Placed) -> f64 {
    let at = |corner| {
        let lever = body.state.position + corner - other.state.position;
        (body.state.velocity_at(corner) - other.state.velocity_at(lever)).norm()
    };
    body.corners().map(at).fold(0.0, worst)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::motion::Sample;
    use crate::checks::tumbling::motion::Solid;
    use moreau_exact::tolerance::rounding;
    use nalgebra::{UnitQuaternion, Vector3};

    fn cube(height: f64, rising: f64, spin: f64) -> (Solid, Sample) {
        let state = Sample {
            position: Vector3::new(0.0, 0.0, height),
            rotation: UnitQuaternion::identity(),
            velocity: Vector3::new(0.0, 0.0, rising),
            spin: Vector3::new(0.0, spin, 0.0),
        };
        (Solid { mass: 1.0, moments: Vector3::repeat(1.0), half: [1.0; 3] }, state)
    }

    fn tumble(bodies: &[(Solid, Sample)]) -> Tumble {
        let states = vec![bodies.iter().map(|(_, state)| *state).collect()];
        Tumble { bodies: bodies.iter().map(|(solid, _)| *solid).collect(), states, contacts: vec![], names: vec![], h: 0.01, damping: 0.0 }
    }

    #[test]
    fn a_touching_corner_parts_with_its_own_velocity_and_one_above_the_floor_with_none() {
        // v_z of the corners x = ±1: rising ∓ spin.
        let [floor, pair] = fastest(&tumble(&[cube(1.0, 0.5, 0.25)]), 0);
        assert!((floor - 0.75).abs() <= rounding(8, 1.0) && pair == 0.0, "{floor}");
        assert_eq!(fastest(&tumble(&[cube(1.0, -0.5, 0.25)]), 0), [0.0; 2]);
        assert_eq!(fastest(&tumble(&[cube(1.0 + 2.0 * GRAVITY * 1e-4, 0.5, 0.0)]), 0), [0.0; 2]);
    }

    #[test]
    fn boxes_part_only_where_they_touch() {
        let touching = fastest(&tumble(&[cube(1.5, 0.0, 0.0), cube(3.5, 0.25, 0.0)]), 0);
        assert!(touching[0] == 0.0 && (touching[1] - 0.25).abs() <= rounding(8, 1.0), "{touching:?}");
        assert_eq!(fastest(&tumble(&[cube(1.5, 0.0, 0.0), cube(3.6, 0.25, 0.0)]), 0), [0.0; 2]);
    }
}
