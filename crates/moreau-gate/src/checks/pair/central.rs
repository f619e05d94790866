//! Central impacts of balls and boxes without friction: every pair of shapes, light and heavy bodies, fast and slow, elastic or not.
//!
//! ```text
//!     m v + M V stays ,    v⁺ − V⁺ = −e (v − V) ,    nobody turns
//! ```
//! A light ball on a heavy box on the floor returns with e v, up to (1 + e) m/M, whether the floor's impact is solved with the ball's or
//! after it.

use crate::checks::pair::compliant::{self, Approach, balls};
use crate::checks::pair::meeting::{DURATION, GAP, SPEED, gained, in_space, returned, undamped};
use crate::checks::pair::strike::Strike;
use crate::checks::pair::view::View;
use crate::checks::scenery::{cuboid, schedule, sphere};
use crate::description::Kind;
use crate::model::Model;
use crate::model::normal::Normal;
use crate::{Bench, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Ground, Scene};
use nalgebra::Vector3;

/// Masses of 10 g and of 400 kg, and others \[kg\].
const LIGHT: f64 = 0.01;
const HEAVY: f64 = 400.0;
const OTHERS: [f64; 2] = [1.0, 3.0];
/// \[m\]; small: a step carries its centre into the box.
const SMALL: f64 = 0.008;
/// Large against the motion of a step \[m\]. The faces of boxes that meet differ in size.
const RADII: [f64; 2] = [0.4, 0.6];
const HALVES: [[f64; 3]; 2] = [[0.5, 0.6, 0.7], [0.8, 1.2, 1.1]];
/// \[m/s\], where a threshold would end an impact.
const SLOW: f64 = 0.125;
/// (speed, e) of every pair of shapes.
const IMPACTS: [(f64, f64); 3] = [(SPEED, 0.3), (SPEED, 1.0), (SLOW, 1.0)];

/// Striker and target of every pair of shapes, at the origin.
fn pairs() -> [(&'static str, [Body; 2]); 4] {
    let ball = |name: &str, mass: f64, radius: f64| sphere(name, mass, radius, [0.0; 3]);
    let block = |name: &str, mass: f64, half: [f64; 3]| cuboid(name, mass, half, [0.0; 3]);
    [
        ("ball on ball", [ball("ball", LIGHT, RADII[0]), ball("target", HEAVY, RADII[1])]),
        ("ball on box", [ball("ball", LIGHT, SMALL), block("target", HEAVY, HALVES[1])]),
        ("box on ball", [block("box", OTHERS[0], HALVES[0]), ball("target", OTHERS[1], RADII[1])]),
        ("box on box", [block("box", LIGHT, HALVES[0]), block("target", HEAVY, HALVES[1])]),
    ]
}

/// Half the extent of a body along x \[m\].
fn reach(body: &Body) -> f64 {
    body.sphere.map_or(0.0, |ball| ball.radius) + body.cuboid.as_ref().map_or(0.0, |block| block.half_extents[0])
}

/// The striker flies along x at the target.
fn flying([mut striker, target]: [Body; 2], speed: f64, restitution: f64) -> Scene {
    striker.position[0] = -(reach(&striker) + reach(&target) + GAP);
    striker.linear_velocity[0] = speed;
    in_space("central impact", vec![striker, target], 0.0, restitution)
}

pub(super) fn central(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let mut measured = Vec::new();
    let bounces = bench.description().restitution;
    for (speed, e) in if bounces { IMPACTS.as_slice() } else { &[(SPEED, 0.0), (SLOW, 0.0)] } {
        for (shapes, bodies) in pairs() {
            if bears(bench, &bodies, h) {
                let words = format!(", {shapes}, {speed} m/s, e = {e}");
                measured.extend(meet(bench, h, &words, flying(bodies, *speed, *e))?);
            }
        }
    }
    if bounces {
        measured.extend(on_the_floor(bench, h)?);
    }
    Ok(measured)
}

/// Whether a declared spring and damper at each of n points bears such light bodies in its own steps, n τ c/m̄ < 1 and n τ² k/m̄ < 1.
fn bears(bench: &Bench, bodies: &[Body; 2], h: f64) -> bool {
    let Model::SpringDamper { stiffness, damping, substep } = Model::of(bench.description()) else { return true };
    let tau = substep.unwrap_or(h);
    let faces = bodies.iter().all(|body| body.cuboid.is_some());
    let points = if faces { compliant::most_points_of_faces() } else { 1.0 };
    let response = points * bodies.iter().map(|body| 1.0 / body.mass).sum::<f64>();
    tau * damping * response < 1.0 && tau * tau * stiffness * response < 1.0
}

fn meet(bench: &mut Bench, h: f64, words: &str, scene: Scene) -> Reply<Vec<Measurement>> {
    let faces = scene.bodies.iter().all(|body| body.cuboid.is_some());
    let strike = Strike {
        words,
        normal: Vector3::x(),
        levers: [Vector3::zeros(); 2],
        speed: scene.bodies[0].linear_velocity[0],
        spread: if faces { Vector3::from(HALVES[0]).norm() } else { 0.0 },
        springs: springs(bench, &scene, h),
        scene,
    };
    strike.measured(bench, h, &View::turned(false))
}

/// The contact that a declared law replays: of two balls, of one point, or of two faces.
fn springs(bench: &Bench, scene: &Scene, h: f64) -> Vec<Normal> {
    let [striker, target] = [&scene.bodies[0], &scene.bodies[1]];
    let masses = [striker.mass, target.mass];
    let response = masses.iter().map(|mass| 1.0 / mass).sum();
    match (striker.sphere, target.sphere) {
        (Some(first), Some(second)) => balls(bench, [(masses[0], first.radius), (masses[1], second.radius)], h),
        (None, None) => compliant::faces(bench, response, &masses, h),
        _ => compliant::one_point(bench, response, &masses, h),
    }
}

/// A light ball falls on a heavy box that lies on the floor: two pairs touch at once.
fn on_the_floor(bench: &mut Bench, h: f64) -> Reply<Option<Measurement>> {
    let e = IMPACTS[0].1;
    let half = HALVES[1];
    let block = cuboid("box", HEAVY, half, [0.0, 0.0, half[2] + crate::checks::motion::CLEARANCE]);
    let height = 2.0 * half[2] + RADII[0] + GAP;
    let ball = Body { linear_velocity: [0.0, 0.0, -SPEED], ..sphere("ball", LIGHT, RADII[0], [0.0, 0.0, height]) };
    let ground = Some(Ground { normal: [0.0, 0.0, 1.0], offset: 0.0 });
    let scene = Scene { ground, ..in_space("ball on a box on the floor", vec![block, ball], 0.0, e) };
    let motion = bench.simulate(&scene, h, schedule(GAP / SPEED + DURATION, 1, h).0, 1)?;
    let value = gained(&scene, &motion, 1).impulse.z / (LIGHT * SPEED) - 1.0;
    let (later, steps) = (2.0 * LIGHT / HEAVY, schedule(GAP / SPEED + DURATION, 1, h).0);
    let masses = [LIGHT, HEAVY];
    let contacts = compliant::one_point(bench, 1.0 / LIGHT + 1.0 / HEAVY, &masses, h);
    let law = compliant::rebound(bench, &contacts, Approach { gap: GAP, speed: SPEED, steps }, later);
    let asked = law.is_some() || bench.description().contact_model.kind == Kind::Rigid;
    Ok(asked.then(|| returned(bench, h, (", ball on a box on the floor", e), (value, SPEED), later, law)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{RigidState, judge};
    use crate::runner::SWEEP;
    use moreau_forms::two_body_impact::TwoBodyImpact;

    /// The exact motion with e and the heavier mass multiplied; the box on the floor does not move.
    fn motion(scene: &Scene, index: usize, t: f64, [e, heavier]: [f64; 2]) -> RigidState {
        let body = &scene.bodies[index];
        let striker = scene.bodies.iter().position(|body| body.linear_velocity != [0.0; 3]).expect("one flies");
        let flight = Vector3::from(scene.bodies[striker].linear_velocity);
        let target = &scene.bodies[1 - striker];
        let masses = [scene.bodies[striker].mass, if scene.ground.is_some() { 1e12 } else { target.mass * heavier }];
        let restitution = e * scene.material.restitution;
        let post = TwoBodyImpact { masses, velocities: [flight.norm(), 0.0], restitution }.velocities_post();
        let before = Vector3::from(body.linear_velocity);
        let after = flight.normalize() * post[usize::from(index != striker)];
        let contact = GAP / flight.norm();
        let place = Vector3::from(body.position) + before * t.min(contact) + after * (t - contact).max(0.0);
        (place.into(), body.orientation, if t < contact { before } else { after }.into(), [0.0; 3])
    }

    fn verdict(h: f64, parts: [f64; 2]) -> Verdict {
        let measured = judge("pair/central", h, |scene, index, _, t| motion(scene, index, t, parts));
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn the_closed_form_passes_and_another_restitution_or_mass_fails_at_every_step() {
        for h in SWEEP {
            assert_eq!(verdict(h, [1.0; 2]), Verdict::Pass, "{h}");
            for wrong in [[0.99, 1.0], [1.01, 1.0], [0.0, 1.0], [1.0, 0.9], [1.0, 1.1]] {
                assert_eq!(verdict(h, wrong), Verdict::Fail, "{wrong:?} at {h}");
            }
        }
    }
}
