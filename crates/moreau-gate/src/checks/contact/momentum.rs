//! Whether the reported impulses are those that moved the body.

use crate::checks::contact::thrown::{ALONG, DOWN, FRICTION, RADIUS, Thrown, motion, thrown_sphere};
use crate::checks::motion::Sample;
use crate::checks::scenery::{GRAVITY, cuboid, over_floor, worst};
use crate::model::Model;
use crate::tolerance::contact as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use nalgebra::Vector3;

const HALF_EXTENTS: [f64; 3] = [0.12, 0.1, 0.08];

pub(super) fn momentum(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let sphere = thrown_sphere(bench, h)?;
    let inertia = 0.4 * RADIUS * RADIUS;
    let (mut linear, mut angular, mut offset) = (0.0, 0.0, 0.0);
    let rates = Model::of(bench.description()).damping().unwrap_or_default();
    for k in 1..sphere.states.len() {
        let impulse = sphere.impulse(k);
        linear = worst(unaccounted(&sphere, k, h, rates.0), linear);
        let size = RADIUS * scale(&sphere, k, h);
        let [before, after] = [k - 1, k].map(|k| sphere.states[k].spin);
        let change = (after - before + (after + before) * (0.5 * rates.1 * h)) * (inertia * sphere.mass);
        let torque = Vector3::new(0.0, 0.0, -RADIUS).cross(&impulse);
        angular = worst((change - torque).norm() / size, angular);
        offset = worst(impulse.xy().norm() * sphere.gap(k - 1).abs().max(sphere.gap(k).abs()) / size, offset);
    }
    let solved = tolerance::impulse() + damped(rates, h);
    let lever = Expectation::at_most(0.0, solved + offset, "J Δω = ℓ × p with the lever R + φ, φ the gap at either end of the step");
    let mut measurements = vec![
        Measurement::new("unaccounted momentum over impulse (sphere)", "1", linear, Expectation::at_most(0.0, solved, "m Δv = m g Δt + p")),
        Measurement::new("unaccounted angular momentum over R times impulse (sphere)", "1", angular, lever),
    ];
    measurements.extend(edge(bench, h)?);
    Ok(measurements)
}

/// A box that lands on an edge along y: both ends of the edge are loaded alike, so the pair's impulse acts at its middle.
fn edge(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let (half_sine, half_cosine) = 15f64.to_radians().sin_cos();
    let mut block = cuboid("block", 1.0, HALF_EXTENTS, [0.0; 3]);
    block.orientation = [half_cosine, 0.0, half_sine, 0.0];
    block.linear_velocity = [0.0, 0.0, -1.0];
    let start = Sample {
        position: Vector3::zeros(),
        rotation: nalgebra::UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 30f64.to_radians()),
        velocity: Vector3::zeros(),
        spin: Vector3::zeros(),
    };
    block.position[2] = 0.002 - lever(&start).z;
    // The box turns with about 5 rad/s after the impact: it does not lie down before 0.05 s.
    let landed = motion(bench, &over_floor("box on its edge", vec![block], FRICTION), h, 0.05)?;
    let [a, _, c] = HALF_EXTENTS;
    let inertia = landed.mass * (a * a + c * c) / 3.0;
    let (mut linear, mut angular, mut turned) = (0.0, 0.0, 0.0);
    let arm = a.hypot(c);
    let rates = Model::of(bench.description()).damping().unwrap_or_default();
    for k in 1..landed.states.len() {
        linear = worst(unaccounted(&landed, k, h, rates.0), linear);
        let [before, after] = [&landed.states[k - 1], &landed.states[k]];
        let torque = lever(before).cross(&landed.impulse(k)).y;
        let change = after.spin.y - before.spin.y + (after.spin.y + before.spin.y) * (0.5 * rates.1 * h);
        angular = worst((change * inertia - torque).abs() / (arm * scale(&landed, k, h)), angular);
        let depth = [before, after].map(|state| -(state.position + lever(state)).z).into_iter().fold(0.0, f64::max);
        turned = worst(((lever(after) - lever(before)).norm() + depth) / arm, turned);
    }
    let solved = tolerance::impulse() + damped(rates, h);
    // Declared corner spheres touch beside the edge, by at most their radius.
    let corners = bench.description().contact_model.number("corner_radius");
    let law = corners.map(|radius| Expectation::at_most(0.0, solved + turned + radius / arm, "corner spheres"));
    let known = Expectation::at_most(0.0, solved + turned, "J Δω = ℓ × p, ℓ known up to its turn in the step and its depth");
    Ok(vec![
        Measurement::new("unaccounted momentum over impulse (box)", "1", linear, Expectation::at_most(0.0, solved, "m Δv = m g Δt + p")),
        Measurement::new("unaccounted angular momentum over arm times impulse (box)", "1", angular, known).predicted(law),
    ])
}

/// From the centre of the box to the middle of its lowest edge along y \[m\].
fn lever(state: &Sample) -> Vector3<f64> {
    let [a, _, c] = HALF_EXTENTS;
    let candidates = [[a, c], [a, -c], [-a, c], [-a, -c]].map(|[x, z]| state.rotation * Vector3::new(x, 0.0, z));
    candidates.into_iter().fold(candidates[0], |lowest, one| if one.z < lowest.z { one } else { lowest })
}

/// What declared damping may leave unaccounted; no speed here is larger than that of the thrown sphere, with the fall.
fn damped((linear, angular): (f64, f64), h: f64) -> f64 {
    tolerance::damped(linear.max(angular), ALONG + DOWN, GRAVITY, h)
}

/// ‖m Δv + m c Δx − m g h − p‖ of interval k over [`scale`], with the declared damping c.
fn unaccounted(thrown: &Thrown, k: usize, h: f64, damping: f64) -> f64 {
    let [before, after] = [k - 1, k].map(|k| &thrown.states[k]);
    let change = (after.velocity - before.velocity + (after.position - before.position) * damping) * thrown.mass;
    let weight = Vector3::new(0.0, 0.0, -thrown.mass * GRAVITY * h);
    (change - weight - thrown.impulse(k)).norm() / scale(thrown, k, h)
}

/// ‖p‖ + m g h \[N·s\].
fn scale(thrown: &Thrown, k: usize, h: f64) -> f64 {
    thrown.impulse(k).norm() + thrown.mass * GRAVITY * h
}

#[cfg(test)]
mod tests {
    use crate::exact::{Reporting, measure};
    use crate::{Measurement, Verdict};
    use moreau_dynamics::trajectory::Trajectory;

    #[test]
    fn spins_that_are_not_those_of_the_reported_impulses_fail_for_sphere_and_box() {
        for (part, expected) in [(1.0, Verdict::Pass), (0.0, Verdict::Fail), (2.0, Verdict::Fail)] {
            let mut engine = Reporting(|motion: &mut Trajectory| {
                let spins = motion.bodies.iter_mut().flat_map(|track| &mut track.angular_velocity).flatten();
                spins.for_each(|spin| *spin *= part);
            });
            let measured = measure("contact/momentum", 0.004, &mut engine);
            let angular: Vec<Verdict> = measured.iter().filter(|one| one.quantity.contains("angular")).map(Measurement::verdict).collect();
            assert_eq!(angular, [expected; 2], "{part}");
        }
    }
}
