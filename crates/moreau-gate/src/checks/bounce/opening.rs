//! Contacts that open: left alone, and pressed by gravity.

use crate::checks::bounce::declared::Declared;
use crate::checks::bounce::scene::{PATIENCE, RESTITUTION, SPEED, weightless};
use crate::checks::scenery::{GRAVITY, between, sphere};
use crate::model::Model;
use crate::tolerance::bounce as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};

/// \[m\]
const RADIUS: f64 = 0.5;
/// Depth at the start, in ways of a step: the contact is closed at the middle of the step, where a midpoint rule looks, open at its end.
const DEPTH: f64 = 0.6;
/// Speed of the ball that gravity presses, in g h.
pub(super) const RISE: f64 = 0.9;

/// A ball that overlaps the floor and leaves it.
pub(super) fn rising(speed: f64, h: f64) -> Body {
    Body { linear_velocity: [0.0, 0.0, speed], ..sphere("ball", 1.0, RADIUS, [0.0, 0.0, RADIUS - DEPTH * speed * h]) }
}

pub(super) fn separating(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let alone = left_alone(bench, "from the floor", weightless("rising ball", rising(SPEED, h), 0.0), h)?;
    let other = sphere("other", 1.0, RADIUS, [0.0, 0.0, 4.0 * RADIUS]);
    let upper = Body { position: [0.0, 0.0, 6.0 * RADIUS - DEPTH * SPEED * h], ..rising(SPEED, h) };
    let mut pair = weightless("parting balls", upper, 0.0);
    pair.bodies.push(other);
    pair.ground = None;
    Ok(vec![alone, left_alone(bench, "from another ball", pair, h)?, pressed(bench, h)?])
}

/// The first body's speed over the one it had, which nothing changes.
fn left_alone(bench: &mut Bench, words: &str, scene: Scene, h: f64) -> Reply<Measurement> {
    let motion = bench.simulate(&scene, h, PATIENCE, PATIENCE)?;
    let ideal = Expectation::equal(1.0, tolerance::velocity(bench.epsilon()), "no impulse at a contact that opens");
    let damped = Declared::of(bench, SPEED, PATIENCE as f64 * h, h).and_then(|law| law.damped(&ideal, 1.0));
    let speed = motion.bodies[0].linear_velocity[1][2] / SPEED;
    Ok(Measurement::new(format!("speed after over before {words}"), "1", speed, ideal).predicted(damped))
}

/// The velocity after one step under gravity, in g h.
fn pressed(bench: &mut Bench, h: f64) -> Reply<Measurement> {
    let mut scene = weightless("pressed ball", rising(RISE * GRAVITY * h, h), 0.0);
    scene.gravity = [0.0, 0.0, -GRAVITY];
    let motion = bench.simulate(&scene, h, 1, 1)?;
    let velocity = motion.bodies[0].linear_velocity[1][2] / (GRAVITY * h);
    let allowed = tolerance::pressed(bench.epsilon());
    let free = RISE - 1.0;
    let range = [free, -RESTITUTION * free];
    let ideal = between(range, allowed, "between free fall and the rebound of free fall");
    let model = match Model::of(bench.description()) {
        Model::Coulomb(limits) => {
            let push = limits.push(DEPTH * RISE * GRAVITY * h * h, h) / (GRAVITY * h);
            let drag = (limits.linear_damping * h).min(1.0);
            let law = between([free - drag, range[1] + push], allowed, "the same with the declared error reduction and damping");
            (push + drag > 0.0).then_some(law)
        }
        _ => None,
    };
    Ok(Measurement::new("velocity of a pressed contact that opened, over g h", "1", velocity, ideal).predicted(model))
}
