//! A sphere and a cube that fly fast and spin fast.

use crate::checks::scenery::{cuboid, over_floor, schedule, sphere};
use crate::model::Model;
use crate::tolerance::flight as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use nalgebra::Vector3;

/// Duration \[s\]: in three steps of the longest h a limit has acted.
const DURATION: f64 = 0.1;
/// 300 m/s.
const VELOCITY: [f64; 3] = [200.0, 200.0, 100.0];
/// 200 rad/s: more than a turn by π in a step of 1/60 s, so that nothing is asked of the orientation.
const SPIN: [f64; 3] = [120.0, -160.0, 0.0];

/// Each body alone: one that could meet another within a step is a question to the solver, which may leave a part of it.
fn thrown() -> [Scene; 2] {
    let bodies = [sphere("sphere", 1.0, 0.1, [0.0; 3]), cuboid("cube", 1.0, [0.1; 3], [0.0; 3])];
    bodies.map(|body| {
        let fast = Body { linear_velocity: VELOCITY, angular_velocity: SPIN, ..body };
        Scene { ground: None, gravity: [0.0; 3], ..over_floor("a fast body", vec![fast], 0.0) }
    })
}

pub(super) fn fast(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let (steps, _) = schedule(DURATION, 1, h);
    let time = steps as f64 * h;
    let damping = Model::of(bench.description()).damping();
    let mut measured = Vec::new();
    for scene in thrown() {
        let motion = bench.simulate(&scene, h, steps, steps)?;
        let (body, track) = (&scene.bodies[0], &motion.bodies[0]);
        let off = |start: [f64; 3], end: [f64; 3]| (Vector3::from(end) - Vector3::from(start)).norm() / Vector3::from(start).norm();
        let velocity = ("velocity", off(body.linear_velocity, track.linear_velocity[1]), damping.map(|(linear, _)| linear));
        let spin = ("angular velocity", off(body.angular_velocity, track.angular_velocity[1]), damping.map(|(_, angular)| angular));
        for (quantity, value, rate) in [velocity, spin] {
            let allowed = tolerance::turning(steps, bench.epsilon());
            let model = rate.filter(|rate| *rate > 0.0).map(|rate| {
                let allowed = allowed + tolerance::damped_velocity(rate, 0.0, 1.0, time, h);
                Expectation::equal(-(-rate * time).exp_m1(), allowed, "the declared damping")
            });
            let ideal = Expectation::at_most(0.0, allowed, "no force and no torque");
            measured
                .push(Measurement::new(format!("change of {quantity} over itself ({})", body.name), "1", value, ideal).predicted(model));
        }
    }
    Ok(measured)
}

#[cfg(test)]
mod tests {
    use crate::Verdict;
    use crate::exact::judge;
    use crate::runner::SWEEP;

    #[test]
    fn constant_velocities_pass_and_a_part_in_a_million_less_fails() {
        for h in SWEEP {
            for (kept, expected) in [(1.0, Verdict::Pass), (1.0 - 1e-6, Verdict::Fail)] {
                let measured = judge("limits/fast", h, |scene, index, _, t| {
                    let body = &scene.bodies[index];
                    let factor = if t > 0.0 { kept } else { 1.0 };
                    let scaled = |vector: [f64; 3]| vector.map(|x| factor * x);
                    (body.position, [1.0, 0.0, 0.0, 0.0], scaled(body.linear_velocity), scaled(body.angular_velocity))
                });
                assert_eq!(measured.len(), 4);
                assert!(measured.iter().all(|one| one.verdict() == expected), "{h}: {measured:?}");
            }
        }
    }
}
