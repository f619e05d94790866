//! A bar that only turns, its centre at rest, strikes the floor with a corner, or a ball with a face.
//!
//! ```text
//!     u_n = ω ℓ ,    p = (1 + e) |u_n|/W_nn ,    W_nn = 1/m + 1/M + ℓ²/J
//!     e = −Σ (p·v⁺ + L·ω⁺)/Σ (p·v⁻ + L·ω⁻) ,    p, L what each body gained: the impulse's power after over before, at any lever
//! ```
//! ℓ is the distance of the contact from the bar's centre, across the normal, and M the mass of the ball. An engine whose restitution goes
//! by the velocity of centres returns nothing here. ℓ changes while the bar turns, so that the impulse is known as well as the place at
//! which the contact is found, and the approach may be that of an older place; the powers are known whatever the place of the impulse.
//! The bar is square: every axis across it is principal, and over the floor it is rolled onto an edge, of which the corner touches alone.

use crate::checks::bounce::declared::Declared;
use crate::checks::bounce::scene::{RESTITUTION, SPEED, steps_to_turn, weightless};
use crate::checks::motion::Sample;
use crate::checks::pair::meeting::{Gain, gained};
use crate::checks::pair::view::View;
use crate::checks::scenery::{between, cuboid, sphere};
use crate::tolerance::bounce as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use std::f64::consts::{FRAC_PI_4, SQRT_2};

/// \[kg\]
const MASS: f64 = 1.0;
/// Half extents of the bar \[m\]: long, so that it turns slowly.
const HALF: [f64; 3] = [8.0, 1.0, 1.0];
/// Of the ball \[kg\] and \[m\].
const BALL: (f64, f64) = (2.0, 2.0);
/// Where along the bar the ball is struck \[m\].
const STRUCK: f64 = 7.5;
/// Angle \[rad\] by which the bar turns before it strikes: farther from everything than a contact margin that grows with the body, and
/// no step of a sweep ends there.
const ANGLE: f64 = 0.02944;

/// J about the axis of the turn \[kg·m²\].
const MOMENT: f64 = MASS * (HALF[0] * HALF[0] + HALF[2] * HALF[2]) / 3.0;

/// What the bar strikes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Target {
    Floor,
    Ball,
}

impl Target {
    /// ℓ \[m\] when the bar has turned by this angle \[rad\].
    pub fn lever(self, angle: f64) -> f64 {
        let more = angle - ANGLE;
        match self {
            Target::Floor => HALF[0] * angle.cos() - SQRT_2 * HALF[2] * angle.sin(),
            Target::Ball => STRUCK * more.cos() + (HALF[2] + BALL.1) * more.sin(),
        }
    }

    /// W_nn \[1/kg\] at the lever ℓ \[m\].
    pub fn response(self, lever: f64) -> f64 {
        let other = if self == Target::Ball { 1.0 / BALL.0 } else { 0.0 };
        1.0 / MASS + other + lever * lever / MOMENT
    }

    /// ω \[rad/s\] with which the contact closes at [`SPEED`].
    pub fn spin(self) -> f64 {
        SPEED / self.lever(ANGLE)
    }

    /// The bar level and turning: its end along x goes down to the floor, or up to the ball.
    pub fn scene(self) -> Scene {
        let (sine, cosine) = ANGLE.sin_cos();
        let bar = |height: f64, roll: f64, spin: f64| Body {
            orientation: [(0.5 * roll).cos(), (0.5 * roll).sin(), 0.0, 0.0],
            angular_velocity: [0.0, spin, 0.0],
            ..cuboid("bar", MASS, HALF, [0.0, 0.0, height])
        };
        match self {
            Target::Floor => weightless("turning bar", bar(HALF[0] * sine + SQRT_2 * HALF[2] * cosine, FRAC_PI_4, self.spin()), 0.0),
            Target::Ball => {
                let away = HALF[2] + BALL.1;
                let place = [STRUCK * cosine - away * sine, 0.0, STRUCK * sine + away * cosine];
                let mut scene = weightless("turning bar and ball", bar(0.0, 0.0, -self.spin()), 0.0);
                scene.bodies.push(sphere("ball", BALL.0, BALL.1, place));
                scene.ground = None;
                scene
            }
        }
    }
}

pub(super) fn turning(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let mut measured = Vec::new();
    let views = [
        (Target::Floor, "floor", View::plain()),
        (Target::Ball, "ball", View::plain()),
        (Target::Ball, "ball, turned, ball listed first", View::turned(true)),
    ];
    for (target, words, view) in views {
        measured.extend(struck(bench, h, (target, words), &view)?);
    }
    Ok(measured)
}

fn struck(bench: &mut Bench, h: f64, (target, words): (Target, &str), view: &View) -> Reply<[Measurement; 2]> {
    let steps = steps_to_turn(bench, ANGLE, target.spin(), h)?;
    let scene = view.of(&target.scene());
    let motion = bench.simulate(&scene, h, steps, steps)?;
    let gains: Vec<Gain> = (0..scene.bodies.len()).map(|index| gained(&scene, &motion, index)).collect();
    let power = |sample: usize| -> f64 {
        let states = motion.bodies.iter().map(|track| Sample::of(track, sample));
        gains.iter().zip(states).map(|(gain, state)| gain.impulse.dot(&state.velocity) + gain.moment.dot(&state.spin)).sum()
    };
    let impulse = gains.iter().map(|gain| gain.impulse.norm()).sum::<f64>() / gains.len() as f64;
    let restitution = impulse * at(target, ANGLE) - 1.0;

    let away = tolerance::away(target.spin(), h);
    let allowed = 2.0 * tolerance::solved(bench.epsilon());
    let declared = Declared::of(bench, SPEED, steps as f64 * h, h);
    let [ends, levers] =
        [at as fn(Target, f64) -> f64, Target::lever].map(|of| [-away, away].map(|turn| of(target, ANGLE + turn) / of(target, ANGLE)));
    let older = RESTITUTION * levers.map(|part| (part - 1.0).abs()).into_iter().fold(0.0, f64::max);
    let newton =
        Expectation::equal(RESTITUTION, allowed + older, "the impulse's power is −e times what it was, perhaps with an older lever");
    let placed = |[low, high]: [f64; 2]| {
        let [least, most] = [1.0 / ends[0].max(ends[1]), 1.0 / ends[0].min(ends[1])];
        [(1.0 + low) * least - 1.0, (1.0 + high) * most - 1.0]
    };
    let lever = between(placed([RESTITUTION; 2]), allowed + older, "p = (1 + e) ω ℓ/W_nn at the lever the contact may have");
    let drag = declared.as_ref().map_or(0.0, |law| 2.0 * law.drag);
    let law = declared.as_ref().map(|law| {
        let words = "the same with the declared thresholds, force mixing, error reduction and damping";
        between(placed(law.restitution), allowed + older + drag, words)
    });
    Ok([
        Measurement::new(format!("restitution by the powers, {words}"), "1", -power(1) / power(0), newton)
            .predicted(declared.map(|law| law.rebound(allowed + older + drag))),
        Measurement::new(format!("restitution by the impulse, {words}"), "1", restitution, lever).predicted(law),
    ])
}

/// W_nn/u_n \[s/(kg·m)\] when the bar has turned by this angle \[rad\]: 1 + e over the impulse.
fn at(target: Target, angle: f64) -> f64 {
    let lever = target.lever(angle);
    target.response(lever) / (target.spin() * lever)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{RigidState, judge};
    use crate::runner::SWEEP;
    use nalgebra::Vector3;

    /// Velocities (v, ω) of bar and ball after the impact, in the scene as it is, from the law and not from powers: the impulse at which the
    /// contact's velocity is −e of what it was, found from those under no impulse and under 1 N·s.
    fn after(target: Target, restitution: f64, inertia: f64) -> [(Vector3<f64>, Vector3<f64>); 2] {
        let (sine, cosine) = ANGLE.sin_cos();
        // downwards the bar has turned about y, and upwards about −y
        let (normal, arm, spin) = match target {
            Target::Floor => {
                let arm = Vector3::new(cosine, 0.0, -sine) * HALF[0] + Vector3::new(sine, 0.0, cosine) * (-SQRT_2 * HALF[2]);
                (Vector3::z(), arm, target.spin())
            }
            Target::Ball => {
                let along = Vector3::new(cosine, 0.0, sine);
                let normal = Vector3::new(sine, 0.0, -cosine);
                (normal, along * STRUCK - normal * HALF[2], -target.spin())
            }
        };
        let struck = |impulse: f64| {
            let bar = (normal * impulse / MASS, Vector3::y() * spin + arm.cross(&(normal * impulse)) / (MOMENT * inertia));
            let ball = if target == Target::Ball { normal * (-impulse / BALL.0) } else { Vector3::zeros() };
            [bar, (ball, Vector3::zeros())]
        };
        let gap_rate = |[(velocity, spin), (ball, _)]: [(Vector3<f64>, Vector3<f64>); 2]| (velocity + spin.cross(&arm) - ball).dot(&normal);
        let (before, unit) = (gap_rate(struck(0.0)), gap_rate(struck(1.0)));
        struck(-before * (1.0 + restitution) / (unit - before))
    }

    /// The motion in a scene of this check as seen by either view; bodies are where they were.
    pub(in crate::checks::bounce) fn motion(scene: &Scene, index: usize, t: f64, (restitution, inertia): (f64, f64)) -> RigidState {
        let body = &scene.bodies[index];
        if t == 0.0 {
            return (body.position, body.orientation, body.linear_velocity, body.angular_velocity);
        }
        let target = if scene.ground.is_some() { Target::Floor } else { Target::Ball };
        let turned = scene.bodies[0].name == "ball";
        let view = if turned { View::turned(true) } else { View::plain() };
        let [bar, ball] = after(target, restitution, inertia);
        let (velocity, spin) = if body.name == "bar" { bar } else { ball };
        (body.position, body.orientation, (view.turn * velocity).into(), (view.turn * spin).into())
    }

    fn verdict(h: f64, law: (f64, f64)) -> Verdict {
        let measured = judge("bounce/turning-bar", h, |scene, index, _, t| motion(scene, index, t, law));
        assert_eq!(measured.len(), 6);
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn the_closed_form_passes_and_another_restitution_or_moment_of_inertia_fails_at_every_step() {
        for h in SWEEP {
            assert_eq!(verdict(h, (RESTITUTION, 1.0)), Verdict::Pass, "{h}");
            // the lever is an older one by up to two steps
            let wrong = tolerance::WRONG_IN_SUM + 0.2 * h;
            for wrong in [(0.0, 1.0), (RESTITUTION + wrong, 1.0), (RESTITUTION - wrong, 1.0), (RESTITUTION, 1.02)] {
                assert_eq!(verdict(h, wrong), Verdict::Fail, "{wrong:?} at {h}");
            }
        }
    }

    #[test]
    fn the_contact_closes_at_the_angle_and_the_speed_that_are_said_and_no_step_ends_there() {
        for target in [Target::Floor, Target::Ball] {
            let before = after(target, -1.0, 1.0);
            assert_eq!(before[0].1.norm(), target.spin());
            for h in SWEEP {
                let rest = (ANGLE / (target.spin() * h)).rem_euclid(1.0);
                assert!(rest > 0.01 && rest < 0.99, "{target:?}: {rest} at {h}");
            }
        }
    }

    #[test]
    fn nothing_else_touches_before_the_last_sample() {
        use crate::checks::bounce::scene::PATIENCE;
        let time = (PATIENCE + 1) as f64 / 30.0;
        let [(velocity, spin), _] = after(Target::Floor, RESTITUTION, 1.0);
        let start = Target::Floor.scene().bodies[0].position[2];
        let angle = ANGLE + spin.y * time;
        let edge = SQRT_2 * HALF[2];
        for [x, z] in [[-HALF[0], -edge], [-HALF[0], edge], [HALF[0], edge], [HALF[0], 0.0], [HALF[0], -edge]] {
            let height = start + velocity.z * time - x * angle.sin() + z * angle.cos();
            assert!(height > 0.1, "{height}");
        }
    }
}
