//! The closed form of every impact, and wrong ones.

use super::*;
use crate::Verdict;
use crate::exact::{RigidState, judge};
use crate::runner::SWEEP;
use moreau_exact::tolerance::rounding;
use nalgebra::Vector3;

/// (v, ω) of both bodies.
type Velocities = [(Vector3<f64>, Vector3<f64>); 2];

/// After the impact, from the law and not from powers: the impulse at which the contact's velocity is −e of what it was, found from those
/// under no impulse and under 1 N·s along the normal. With friction the impulse is μ p beside the slip, which goes on.
fn after(target: Target, restitution: f64, inertia: f64) -> Velocities {
    let (sine, cosine) = ANGLE.sin_cos();
    let [spin, fall] = target.speeds();
    let turned =
        |[along, across]: [f64; 2], up: f64| Vector3::new(along * cosine - up * across * sine, 0.0, up * along * sine + across * cosine);
    let (up, normal) = if target.is_floor() { (-1.0, Vector3::z()) } else { (1.0, Vector3::new(sine, 0.0, -cosine)) };
    let friction = if target == Target::RoughFloor { Vector3::x() * FRICTION } else { Vector3::zeros() };
    let first = turned(target.place(), up);
    let second = match target {
        Target::Ball => normal * RADIUS,
        _ => Vector3::new(-TILT.cos(), 0.0, TILT.sin()) * STRUCK + normal * HALF[2],
    };
    let struck = |impulse: f64| {
        let pushed = (normal + friction) * impulse;
        let one =
            (pushed / MASSES[0] - Vector3::z() * fall, first.cross(&pushed) / (moment(MASSES[0]) * inertia) - Vector3::y() * (up * spin));
        let other = match target {
            Target::Ball => (-pushed / MASSES[1], Vector3::zeros()),
            Target::Bar => (-pushed / MASSES[1], second.cross(&-pushed) / (moment(MASSES[1]) * inertia) - Vector3::y() * spin),
            _ => (Vector3::zeros(), Vector3::zeros()),
        };
        [one, other]
    };
    let rate = |[(v, w), (other_v, other_w)]: Velocities| (v + w.cross(&first) - other_v - other_w.cross(&second)).dot(&normal);
    let (before, unit) = (rate(struck(0.0)), rate(struck(1.0)));
    struck(-before * (1.0 + restitution) / (unit - before))
}

/// Which impact a scene of this check is.
fn target_of(scene: &Scene) -> Target {
    match (&scene.ground, scene.bodies.iter().any(|body| body.sphere.is_some())) {
        (None, true) => Target::Ball,
        (None, false) => Target::Bar,
        (Some(_), _) if scene.material.friction > 0.0 => Target::RoughFloor,
        (Some(_), _) if scene.bodies[0].linear_velocity[2] < 0.0 => Target::FloorFalling,
        _ => Target::Floor,
    }
}

/// The motion as seen by either view; bodies are where they were.
pub(in crate::checks::bounce) fn motion(scene: &Scene, index: usize, t: f64, (restitution, inertia): (f64, f64)) -> RigidState {
    let body = &scene.bodies[index];
    if t == 0.0 {
        return (body.position, body.orientation, body.linear_velocity, body.angular_velocity);
    }
    let view = if scene.bodies[0].name == "bar" { View::plain() } else { View::turned(true) };
    let [bar, other] = after(target_of(scene), restitution, inertia);
    let (velocity, spin) = if body.name == "bar" { bar } else { other };
    (body.position, body.orientation, (view.turn * velocity).into(), (view.turn * spin).into())
}

fn verdicts(h: f64, law: (f64, f64)) -> Vec<(String, Verdict)> {
    let measured = judge("bounce/turning-bar", h, |scene, index, _, t| motion(scene, index, t, law));
    assert_eq!(measured.len(), 10);
    measured.into_iter().map(|one| (one.quantity.clone(), one.verdict())).collect()
}

#[test]
fn the_closed_form_passes_and_another_restitution_or_moment_of_inertia_fails_at_every_step() {
    for h in SWEEP {
        assert!(verdicts(h, (RESTITUTION, 1.0)).iter().all(|(_, verdict)| *verdict == Verdict::Pass), "{h}");
        let wrong = tolerance::wrong_while_turning(h);
        for wrong in [0.0, RESTITUTION + wrong, RESTITUTION - wrong] {
            for (quantity, verdict) in verdicts(h, (wrong, 1.0)) {
                assert_eq!(verdict, Verdict::Fail, "{quantity} at e = {wrong}, {h}");
            }
        }
        assert!(verdicts(h, (RESTITUTION, 1.02)).iter().any(|(_, verdict)| *verdict == Verdict::Fail), "{h}");
    }
}

#[test]
fn a_contact_closes_at_the_angle_and_the_speed_that_are_said_and_no_step_ends_there() {
    for (target, words) in Target::ALL {
        let [spin, fall] = target.speeds();
        let [(velocity, turned), (_, other)] = after(target, -1.0, 1.0);
        assert!((turned.norm() - spin).abs() <= rounding(64, SPEED) && (velocity.norm() - fall).abs() <= rounding(64, SPEED), "{words}");
        assert!(target != Target::Bar || (other.norm() - spin).abs() <= rounding(64, SPEED));
        for h in SWEEP {
            let rest = (ANGLE / (spin * h)).rem_euclid(1.0);
            assert!(rest > 0.01 && rest < 0.99, "{words}: {rest} at {h}");
        }
    }
}

#[test]
fn nothing_touches_at_the_start_and_nothing_else_before_the_last_sample() {
    use crate::own;
    use crate::{Engine, Options};
    for (target, words) in Target::ALL {
        let scene = Scene { duration: 1.0, ..target.scene() };
        let (mechanism, start) = scene.spatial_mechanism().expect("a valid scene");
        let gap = mechanism.contacts(&start.position).iter().map(|contact| contact.gap).fold(f64::INFINITY, f64::min);
        assert!(gap > 0.19, "{words}: {gap}");
        let (h, mut engine) = (1.0 / 30.0, own::by_name("moreau-jean").expect("listed"));
        let steps = (ANGLE / target.speeds()[0] / h).ceil() as usize + PATIENCE;
        let scene = Scene { duration: steps as f64 * h, ..scene };
        let motion = engine.simulate(&scene, h, 1, &Options::new()).expect("simulates");
        let struck: Vec<usize> =
            motion.contacts.iter().filter(|contact| contact.impulse.iter().any(|x| *x != 0.0)).map(|one| one.sample).collect();
        assert!(!struck.is_empty() && struck.iter().all(|sample| *sample == struck[0]), "{words}: {struck:?}");
    }
}
