//! The checks on motions in closed form, right and wrong.

use super::scene::{GAP, PATIENCE, RESTITUTION, SPEED};
use super::*;
use crate::exact::{RigidState, judge};
use crate::tolerance::bounce as tolerance;
use crate::{Measurement, Verdict};
use moreau_dynamics::scenes::{Body, Scene};
use nalgebra::{Matrix3, Rotation3, Vector3};
use spinning::{Contact, RADIUS, SPINS};

/// Every step a sweep may have \[s\].
const STEPS: [f64; 6] = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 240.0, 1.0 / 1000.0, 1.0 / 5000.0, 1.0 / 10_000.0];

/// What an exact engine may have wrong.
#[derive(Clone, Copy)]
struct Law {
    restitution: fn(f64) -> f64,
    friction: f64,
    /// Factor of the moments of inertia.
    inertia: f64,
    /// Part of e that acts on the tangential velocity.
    tangential: f64,
    /// Velocity of a contact that opens, pressed with 0.1 g h, in g h, and the one of others over the one they had.
    pressed: f64,
    left: f64,
}

const RIGHT: Law = Law { restitution: |_| RESTITUTION, friction: 0.3, inertia: 1.0, tangential: 0.0, pressed: 0.0, left: 1.0 };

/// (v, ω) after the impact of a box at one corner: the impulse at which the corner's velocity is −e of what it was, found from the
/// velocities of that point under no impulse and under 1 N·s.
fn cornered(body: &Body, law: &Law) -> ([f64; 3], [f64; 3]) {
    let half_extents = body.cuboid.expect("a box").half_extents;
    let rotation = landing::oriented(body.orientation);
    let lever = rotation * -Vector3::from(half_extents);
    let moments = landing::moments(half_extents) * law.inertia;
    let after = |impulse: f64| {
        let moment = rotation.inverse() * lever.cross(&(Vector3::z() * impulse));
        let spin = rotation * (Matrix3::from_diagonal(&moments.map(f64::recip)) * moment);
        (Vector3::from(body.linear_velocity) + Vector3::z() * impulse / body.mass, spin)
    };
    let point = |(velocity, spin): (Vector3<f64>, Vector3<f64>)| (velocity + spin.cross(&lever)).z;
    let (before, unit) = (point(after(0.0)), point(after(1.0)));
    let (velocity, spin) = after(-before * (1.0 + (law.restitution)(SPEED)) / (unit - before));
    (velocity.into(), spin.into())
}

fn spun(body: &Body, law: &Law) -> ([f64; 3], [f64; 3]) {
    let spin = body.angular_velocity[1];
    let e = (law.restitution)(SPEED);
    let [along, up, turned] = Contact { restitution: e, friction: law.friction, lever: RADIUS, tangential: 0.0 }.after(spin);
    let more = if spin > 0.0 { law.tangential * e } else { 0.0 };
    let start = body.linear_velocity[0];
    ([start + (along - start) * (1.0 + more), 0.0, up], [0.0, spin + (turned - spin) * (1.0 + more), 0.0])
}

/// The velocities of a body in the scenes of this family at the time t: before and after its impact.
fn velocities(scene: &Scene, body: &Body, law: &Law, h: f64, t: f64) -> ([f64; 3], [f64; 3]) {
    let start = (body.linear_velocity, body.angular_velocity);
    let up = start.0[2];
    if t == 0.0 {
        return start;
    }
    if scene.gravity[2] != 0.0 {
        return ([0.0, 0.0, law.pressed * crate::checks::scenery::GRAVITY * h], [0.0; 3]);
    }
    if up >= 0.0 {
        return ([0.0, 0.0, law.left * up], [0.0; 3]);
    }
    if body.cuboid.is_some() && body.orientation[0] != 1.0 {
        return cornered(body, law);
    }
    if scene.material.friction > 0.0 { spun(body, law) } else { ([0.0, 0.0, -up * (law.restitution)(-up)], [0.0; 3]) }
}

fn verdict(check: &str, h: f64, law: &Law) -> Verdict {
    let law = *law;
    let motion = move |scene: &Scene, index: usize, h: f64, t: f64| -> RigidState {
        let body = &scene.bodies[index];
        if scene.bodies.iter().any(|body| body.name == "bar") {
            return turning::tests::motion(scene, index, t, ((law.restitution)(SPEED), law.inertia));
        }
        let (velocity, spin) = velocities(scene, body, &law, h, t);
        (body.position, body.orientation, velocity, spin)
    };
    judge(check, h, motion).iter().map(Measurement::verdict).max().expect("measurements")
}

#[test]
fn the_closed_forms_pass_at_every_step() {
    for h in STEPS {
        for check in CHECKS {
            assert_eq!(verdict(check.name, h, &RIGHT), Verdict::Pass, "{} at {h}", check.name);
        }
    }
}

#[test]
fn one_wrong_number_fails_at_every_step() {
    let wrong: [(&str, Law); 13] = [
        ("bounce/flat-box", Law { restitution: |_| RESTITUTION + tolerance::WRONG_IN_SUM, ..RIGHT }),
        ("bounce/corner", Law { restitution: |_| RESTITUTION + tolerance::WRONG, ..RIGHT }),
        ("bounce/corner", Law { inertia: 1.01, ..RIGHT }),
        ("bounce/slow", Law { restitution: |speed| if speed < 0.03 { 0.499 } else { RESTITUTION }, ..RIGHT }),
        ("bounce/slow", Law { restitution: |speed| if speed > 1.0 { 0.0 } else { RESTITUTION }, ..RIGHT }),
        ("bounce/every-step", Law { restitution: |_| RESTITUTION + tolerance::WRONG, ..RIGHT }),
        ("bounce/spinning-ball", Law { friction: 0.302, ..RIGHT }),
        ("bounce/spinning-ball", Law { tangential: 1.0, ..RIGHT }),
        ("bounce/separating", Law { pressed: 0.9 * RESTITUTION, ..RIGHT }),
        ("bounce/separating", Law { pressed: -0.9 * RESTITUTION, ..RIGHT }),
        ("bounce/separating", Law { left: -RESTITUTION, ..RIGHT }),
        ("bounce/turning-bar", Law { restitution: |_| RESTITUTION - tolerance::wrong_while_turning(STEPS[0]), ..RIGHT }),
        ("bounce/turning-bar", Law { inertia: 1.02, ..RIGHT }),
    ];
    for h in STEPS {
        for (check, law) in &wrong {
            assert_eq!(verdict(check, h, law), Verdict::Fail, "{check} at {h}");
        }
    }
}

#[test]
fn no_impact_happens_after_a_whole_number_of_steps() {
    let of = |gap: f64, speed: f64, h: f64| (gap / (speed * h)).rem_euclid(1.0);
    for h in STEPS.into_iter().chain(crate::runner::SWEEP) {
        let slow = slow::SPEEDS.map(|speed| of(slow::GAP, speed, h));
        for rest in slow.into_iter().chain([of(GAP, SPEED, h)]) {
            assert!(rest > 0.01 && rest < 0.99, "{rest} at {h}");
        }
    }
}

#[test]
fn a_box_on_its_corner_touches_with_nothing_else_before_the_last_sample() {
    for (words, half_extents) in landing::CORNERED {
        let body = landing::on_corner(half_extents);
        let rotation = landing::oriented(body.orientation);
        let (velocity, spin) = cornered(&body, &RIGHT);
        let time = (PATIENCE + 1) as f64 / 30.0;
        let turned = Rotation3::from_scaled_axis(Vector3::from(spin) * time) * rotation;
        for signs in 1..8 {
            let corner = |k: usize| if signs >> k & 1 == 1 { half_extents[k] } else { -half_extents[k] };
            let corner = Vector3::new(corner(0), corner(1), corner(2));
            let height = velocity[2] * time + body.position[2] - GAP + (turned * corner).z;
            assert!(height > 0.1, "{words}: {height}");
        }
    }
}

#[test]
fn the_ball_slips_at_one_spin_and_sticks_at_the_other() {
    let [slipping, sticking] = SPINS.map(|(_, spin)| {
        let [along, _, turned] = Contact { restitution: RESTITUTION, friction: RIGHT.friction, lever: RADIUS, tangential: 0.0 }.after(spin);
        along - turned * RADIUS
    });
    assert!(slipping > 1.0 && sticking.abs() <= moreau_exact::tolerance::rounding(16, 3.0), "{slipping} {sticking}");
}
