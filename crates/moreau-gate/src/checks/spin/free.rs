//! The orientation of a ball and of a box that spin freely about a principal axis.

use crate::checks::scenery::{angle_between, cuboid, over_floor, schedule, sphere, worst};
use crate::model::{Model, damping};
use crate::tolerance::{flight, spin as tolerance};
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use moreau_dynamics::trajectory::Trajectory;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// Duration \[s\].
const DURATION: f64 = 0.6;
const SAMPLES: usize = 4;
/// An orientation that is not the unit rotation, so that it shows on which side the rotation acts.
const LYING: [f64; 4] = [0.8, 0.36, 0.48, 0.0];

/// A ball with 7 rad/s about an axis beside all others, and a box with as much about its axis of largest inertia.
fn spinning() -> Scene {
    let ball = Body { orientation: LYING, angular_velocity: [2.0, 3.0, -6.0], ..sphere("ball", 1.0, 0.1, [0.0; 3]) };
    let block = Body { angular_velocity: [7.0, 0.0, 0.0], ..cuboid("box", 1.0, [0.1, 0.2, 0.3], [3.0, 0.0, 0.0]) };
    Scene { ground: None, gravity: [0.0; 3], ..over_floor("free spinning bodies", vec![ball, block], 0.0) }
}

pub(super) fn sphere_and_box(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let scene = spinning();
    let (steps, every) = schedule(DURATION, SAMPLES, h);
    let motion = bench.simulate(&scene, h, steps, every)?;
    let time = steps as f64 * h;
    let damped = Model::of(bench.description()).damping().filter(|(_, angular)| *angular > 0.0);
    let measured = scene.bodies.iter().enumerate().map(|(index, body)| {
        let speed = Vector3::from(body.angular_velocity).norm();
        let allowed = tolerance::turn(speed, time, h) + flight::turning(steps, bench.epsilon());
        let ideal = Expectation::at_most(0.0, allowed, "R(t) = exp(t ω) R₀");
        let model = damped.map(|(_, rate)| {
            let (turned, _) = damping::flight(rate, &Vector3::zeros(), &Vector3::new(speed, 0.0, 0.0), time);
            let allowed = allowed + flight::damped_position(rate, 0.0, speed, time, h);
            Expectation::equal(speed * time - turned.x, allowed, "the declared damping")
        });
        let quantity = format!("orientation beside that of a steady spin ({})", body.name);
        Measurement::new(quantity, "rad", beside(body, index, &motion), ideal).predicted(model)
    });
    Ok(measured.collect())
}

/// The largest angle \[rad\] between the orientation of a sample and exp(t ω) R₀.
fn beside(body: &Body, index: usize, motion: &Trajectory) -> f64 {
    let track = &motion.bodies[index];
    let angles = motion.times.iter().zip(&track.orientation).map(|(time, orientation)| angle_between(steady(body, *time), *orientation));
    angles.fold(0.0, worst)
}

/// exp(t ω) R₀.
fn steady(body: &Body, time: f64) -> [f64; 4] {
    let [w, x, y, z] = body.orientation;
    let start = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    let turned = UnitQuaternion::from_scaled_axis(Vector3::from(body.angular_velocity) * time) * start;
    [turned.w, turned.i, turned.j, turned.k]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{RigidState, judge};
    use crate::runner::SWEEP;

    /// The bodies as they are after a steady spin of this time.
    fn turned(scene: &Scene, index: usize, time: f64) -> RigidState {
        let body = &scene.bodies[index];
        (body.position, steady(body, time), [0.0; 3], body.angular_velocity)
    }

    fn verdicts(h: f64, clock: impl Fn(f64, f64) -> f64 + Send + Sync) -> Vec<Verdict> {
        let measured = judge("spin/free-sphere", h, |scene, index, h, t| turned(scene, index, clock(h, t)));
        measured.iter().map(Measurement::verdict).collect()
    }

    #[test]
    fn the_exact_turn_passes_and_so_do_the_maps_of_second_order_but_no_other_rate() {
        for h in SWEEP {
            let maps: [fn(f64) -> f64; 3] = [|x| x, |x| 2.0 * (0.5 * x).atan(), f64::atan];
            for map in maps {
                assert_eq!(verdicts(h, move |h, t| map(7.0 * h) / (7.0 * h) * t), [Verdict::Pass; 2], "{h}");
            }
            for rate in [0.0, 0.9, 1.1, -1.0, 2.0] {
                assert_eq!(verdicts(h, move |_, t| rate * t), [Verdict::Fail; 2], "{rate} at {h}");
            }
        }
    }

    #[test]
    fn a_spin_about_the_axes_of_the_body_is_another_motion_of_the_ball() {
        for h in SWEEP {
            let measured = judge("spin/free-sphere", h, |scene, index, _, t| {
                let body = &scene.bodies[index];
                let [w, x, y, z] = body.orientation;
                let start = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
                let turned = start * UnitQuaternion::from_scaled_axis(Vector3::from(body.angular_velocity) * t);
                (body.position, [turned.w, turned.i, turned.j, turned.k], [0.0; 3], body.angular_velocity)
            });
            assert_eq!(measured[0].verdict(), Verdict::Fail, "{h}");
        }
    }
}
