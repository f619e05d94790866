//! Painlevé's regime: a long box that slides on its lower edge towards the side the edge lies on, with more friction than μ_P.
//!
//! ```text
//!     W_nn + μ W_nt < 0 :   no sliding force can carry the edge;   the slide ends at once by P = W⁻¹ (w, v), whatever h
//! ```
//! A force law divides by W_nn + μ W_nt and blows up or sinks; a law of impulses stops the edge. The two corners of the edge share P.

use crate::check::{Control, Run};
use crate::checks::scenery::{GRAVITY, between, cuboid, over_floor, worst};
use crate::model::Model;
use crate::tolerance::painleve as tolerance;
use crate::tolerance::rocking::returned;
use crate::{Bench, Check, Expectation, Kind, Level, Measurement, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;
use moreau_forms::SlidingEdge;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// Half extents \[m\] of the rod: long, so that a step of 1/60 s turns it by little.
const HALF: [f64; 3] = [4.0, 0.5, 0.1];
/// sin and cos of the angle to the floor.
const TILT: [f64; 2] = [0.8, 0.6];
/// μ > μ_P = 1.42.
const FRICTION: f64 = 2.0;
/// Speed of the slide \[m/s\].
const SLIDE: f64 = 8.0;
/// Speed of the fall at the start \[m/s\].
const FALL: f64 = 0.5;
/// Steps until the edge is judged: it touches from the start, and an engine that takes a gap of zero for open acts a step later.
const STEPS: usize = 2;

/// The check of the family.
pub const CHECKS: &[Check] = &[Check {
    name: "painleve/rod",
    level: Level::Simulate,
    question: "Is the slide of a steep rod, beyond Painlevé's critical friction, ended by a finite impulse that does not depend on h?",
    derivation: "The edge touches the floor at the start and approaches it, so that no scheme can act earlier. u⁺ = 0 gives P = W⁻¹ (w, \
        v), which is inside the cone because μ > μ_P. The change of velocity is measured after two steps, because an engine may see the \
        contact a step late. In these steps the reaction m (g + ω²ℓ) acts, and the approach speed is off by g h. For a compliant engine \
        the event lasts as long as its contact. Such an engine must stay finite and gain no energy.",
    source: "Painlevé 1895; chapter §4, impact without collision",
    run: Run::EachStep(rod),
    control: Control { passes: "moreau-jean", fails: "painleve/slip-fixed-in-advance" },
}];

/// How far the lower edge is behind and below the centre \[m\].
fn arm() -> [f64; 2] {
    let ([l, _, t], [s, c]) = (HALF, TILT);
    [l * c - t * s, l * s + t * c]
}

/// Principal moments \[kg·m²\]: that of the solid box about its width, and large ones about the other axes, as of outriggers to both sides.
/// A bare rod could also land on one corner and spin about its length, another solution of the same problem.
fn inertia() -> [f64; 3] {
    let about_width = (HALF[0] * HALF[0] + HALF[2] * HALF[2]) / 3.0;
    [1000.0, about_width, 1000.0]
}

fn edge() -> SlidingEdge {
    SlidingEdge { mass: 1.0, inertia: inertia()[1], arm: arm() }
}

fn falling_rod() -> Scene {
    let [s, c] = TILT;
    let turned = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -s.atan2(c));
    let mut rod = cuboid("rod", edge().mass, HALF, [0.0, 0.0, arm()[1]]);
    rod.orientation = [turned.w, turned.i, turned.j, turned.k];
    rod.inertia = Some(inertia());
    rod.linear_velocity = [-SLIDE, 0.0, -FALL];
    over_floor("Painlevé's rod", vec![rod], FRICTION)
}

fn rod(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let trajectory = bench.simulate(&falling_rod(), h, STEPS.max((0.1 / h) as usize), 1)?;
    let mut measurements = vec![energy(&trajectory, h)];
    if bench.description().contact_model.kind == Kind::Rigid {
        let reduction = match Model::of(bench.description()) {
            Model::Coulomb(limits) => limits.error_reduction,
            _ => 0.0,
        };
        measurements.extend(atom(&trajectory, h, reduction));
    }
    Ok(measurements)
}

/// The largest energy over the energy at the start, both above that of the rod at rest on the floor's level.
fn energy(trajectory: &Trajectory, h: f64) -> Measurement {
    let track = &trajectory.bodies[0];
    let mass = edge().mass;
    let at = |k: usize| {
        let [w, x, y, z] = track.orientation[k];
        let turned = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        let spin = turned.inverse() * Vector3::from(track.angular_velocity[k]);
        let turning: f64 = inertia().iter().zip(&spin).map(|(moment, rate)| moment * rate * rate).sum();
        0.5 * (mass * Vector3::from(track.linear_velocity[k]).norm_squared() + turning) + mass * GRAVITY * track.position[k][2]
    };
    let largest = (0..trajectory.times.len()).map(at).fold(0.0, worst);
    let allowed = tolerance::energy(GRAVITY, SLIDE + FALL, h, at(0) / mass);
    let ideal = Expectation::at_most(1.0, allowed, "friction and plastic impacts take energy");
    Measurement::new("largest energy over the energy at the start", "1", largest / at(0), ideal)
}

/// The impulse of the event from the change of velocity, and the slip after it. An edge that is pushed out of a part of its depth leaves
/// with up to that part of its approach.
fn atom(trajectory: &Trajectory, h: f64, reduction: f64) -> [Measurement; 3] {
    let track = &trajectory.bodies[0];
    let edge = edge();
    let [normal, tangential] = edge.stopping_impulse(FALL, SLIDE);
    let pushed = edge.stopping_impulse(FALL * (1.0 + returned(reduction)), SLIDE);
    let [x, z] = edge.arm;
    let length = x.hypot(z);
    let spin = (z * tangential - x * normal).abs() / edge.inertia;
    let gain = edge.stopping_impulse(1.0, 0.0).into_iter().fold(0.0, worst) / edge.mass;
    let allowed = edge.mass * tolerance::velocity_change(GRAVITY, spin, length, gain, STEPS, h);
    let (start, end) = (track.linear_velocity[0], track.linear_velocity[STEPS]);
    let upwards = edge.mass * (end[2] - start[2] + GRAVITY * trajectory.times[STEPS]);
    let forwards = edge.mass * (end[0] - start[0]);
    // The angular velocity about y turns z towards x: the edge at (−X, −Z) moves with −ω Z along x.
    let slip = end[0] - track.angular_velocity[STEPS][1] * z;
    let equal = |value: f64, allowed: f64, why: &str| Expectation::equal(value, allowed, why);
    let law = |ends: [f64; 2]| (reduction > 0.0).then(|| between(ends, allowed, "W⁻¹ (w, v) with the declared push out of the depth"));
    [
        Measurement::new("normal impulse of the event", "N*s", upwards, equal(normal, allowed, "W⁻¹ (w, v), whatever h"))
            .predicted(law([normal, pushed[0]])),
        Measurement::new("friction impulse of the event", "N*s", forwards, equal(tangential, allowed, "W⁻¹ (w, v), whatever h"))
            .predicted(law([tangential, pushed[1]])),
        Measurement::new(
            "slip of the edge after the event",
            "m/s",
            slip,
            equal(0.0, tolerance::slip(GRAVITY, spin, length, STEPS, h), "the edge is stopped"),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rod_is_in_painleve_s_regime_and_its_impulse_inside_the_cone() {
        assert!(edge().critical_friction() < 0.75 * FRICTION, "{}", edge().critical_friction());
        for approach in [0.0, FALL, 1.0] {
            let [normal, tangential] = edge().stopping_impulse(approach, SLIDE);
            assert!(normal > 0.0 && tangential < 0.75 * FRICTION * normal);
        }
    }
}
