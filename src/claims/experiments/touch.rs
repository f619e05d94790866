//! How MuJoCo's step depends on the depth of a ball: smoothly inside a contact, with a jump at touch.

use super::soft::default_contact;
use super::soft_stack::STEP;
use crate::claims::prelude::*;
use crate::closed_forms::mujoco_contact::ContactParameters;
use crate::tolerance::claims::soft::{AT_TOUCH, TOUCH, inside_contact};

/// By how much v⁺ \[m/s\] of a ball at this depth \[m\] changes as the depth passes through it, from 10⁻¹² m less to as much more.
fn change_of_step(depth: f64, velocity: f64, gravity: f64) -> f64 {
    let contact = default_contact(STEP);
    let [near, _] = TOUCH;
    contact.impulse(depth + near, velocity, -gravity) - contact.impulse(depth - near, velocity, -gravity)
}

/// Whether the step has a derivative, where the chapter says so: inside a contact it has, and at touch v⁺ jumps. The first control is a
/// ball without weight that rests at touch, the second one at touch in the place of the one inside.
pub fn differentiable(reading: Reading) -> Vec<Finding> {
    let (velocity, gravity) = reading.only(0).pick((-1.0, 9.81), (0.0, 0.0));
    let inside = reading.only(1).pick(0.001, 0.0);
    let (stiffness, damping) = ContactParameters::default().stiffness_and_damping(STEP);
    let jump = 0.9 * STEP * (9.81 + damping);
    vec![
        Finding::equal(
            "change of v⁺ over 2·10⁻¹² m of depth, 1 mm deep",
            change_of_step(inside, -1.0, 9.81),
            0.0,
            inside_contact(STEP, stiffness, damping),
            "m/s",
        ),
        Finding::equal(
            "change of v⁺ over 2·10⁻¹² m of depth, at touch",
            change_of_step(0.0, velocity, gravity),
            jump,
            AT_TOUCH * jump,
            "m/s",
        )
        .says(0.0)
        .violating("no contact touches or lets go within the step"),
    ]
}
