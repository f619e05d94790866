//! A ball strikes a turned box off its centre, without friction: on a face, on an edge, on a corner.
//!
//! ```text
//!     W_n = 1/m + 1/M + (l × n)·J⁻¹(l × n) ,    W_n p = (1 + e) |u_n| ,    L = l × p n
//! ```
//! The ball flies along n at a place of the box, so that this place is the nearest to its centre whenever they meet. J is given with the
//! box and is not that of a solid one.

use crate::checks::pair::compliant;
use crate::checks::pair::meeting::{GAP, SPEED, in_space, undamped};
use crate::checks::pair::strike::Strike;
use crate::checks::pair::view::View;
use crate::checks::scenery::{cuboid, sphere};
use crate::{Bench, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use nalgebra::Vector3;

/// Of ball and box \[kg\].
const MASSES: [f64; 2] = [1.0, 9.0];
/// \[m\], large against the motion of a step.
const RADIUS: f64 = 4.0;
const HALF: [f64; 3] = [3.0, 5.0, 6.0];
/// \[kg·m²\]; a solid box would have 183, 135, 102.
const INERTIA: [f64; 3] = [90.0, 150.0, 120.0];
const RESTITUTION: f64 = 0.5;
/// Place on the box \[m\] and outward normal there.
const PLACES: [(&str, [f64; 3], [f64; 3]); 3] = [
    ("face", [3.0, 2.0, -2.5], [1.0, 0.0, 0.0]),
    ("edge", [3.0, 5.0, 2.5], [0.8, 0.6, 0.0]),
    ("corner", [3.0, 5.0, 6.0], [2.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0]),
];

/// The ball flies at a place of the box.
fn scene(place: Vector3<f64>, outward: Vector3<f64>, restitution: f64) -> Scene {
    let start = place + outward * (RADIUS + GAP);
    let ball = Body { linear_velocity: (-outward * SPEED).into(), ..sphere("ball", MASSES[0], RADIUS, start.into()) };
    let block = Body { inertia: Some(INERTIA), ..cuboid("box", MASSES[1], HALF, [0.0; 3]) };
    in_space("ball beside the centre of a box", vec![ball, block], 0.0, restitution)
}

pub(super) fn off_centre(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let restitution = if bench.description().restitution { RESTITUTION } else { 0.0 };
    let mut measured = Vec::new();
    for (name, place, outward) in PLACES {
        let [place, outward] = [place, outward].map(Vector3::from);
        for (order, reversed) in [("", false), (", box listed first", true)] {
            let words = format!(", {name}{order}");
            let scene = scene(place, outward, restitution);
            let levers = [-outward * RADIUS, place];
            let mut strike = Strike { words: &words, scene, normal: -outward, levers, speed: SPEED, spread: 0.0, springs: Vec::new() };
            strike.springs = compliant::one_point(bench, strike.inverse_mass(), &MASSES, h);
            measured.extend(strike.measured(bench, h, &View::turned(reversed))?);
        }
    }
    Ok(measured)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::checks::pair::view::oriented;
    use crate::exact::{RigidState, judge};
    use crate::runner::SWEEP;

    /// The exact motion with parts of the impulse and of the box's lever; nothing turns visibly. A lean of the impulse \[rad\].
    fn motion(scene: &Scene, index: usize, t: f64, [part, lever, lean]: [f64; 3]) -> RigidState {
        let striker = scene.bodies.iter().position(|body| body.sphere.is_some()).expect("a ball");
        let [ball, block] = [&scene.bodies[striker], &scene.bodies[1 - striker]];
        let normal = Vector3::from(ball.linear_velocity).normalize();
        let turn = oriented(block);
        let arm = Vector3::from(ball.position) + normal * (RADIUS + GAP) - Vector3::from(block.position);
        let turned = |moment: Vector3<f64>| turn * (turn.inverse() * moment).component_div(&Vector3::from(INERTIA));
        let response = 10.0 / 9.0 + arm.cross(&normal).dot(&turned(arm.cross(&normal)));
        let size = (1.0 + scene.material.restitution) * SPEED / response * part;
        let impulse = (normal + turn * Vector3::new(-lean, lean, 0.0)) * size;
        let contact = GAP / SPEED;
        let body = &scene.bodies[index];
        let before = Vector3::from(body.linear_velocity);
        let [after, spin] = if index == striker {
            [before - impulse / MASSES[0], Vector3::zeros()]
        } else {
            [before + impulse / MASSES[1], turned(arm.cross(&impulse)) * lever]
        };
        let place = Vector3::from(body.position) + before * t.min(contact) + after * (t - contact).max(0.0);
        let [velocity, spin] = if t < contact { [before, Vector3::zeros()] } else { [after, spin] };
        (place.into(), body.orientation, velocity.into(), spin.into())
    }

    fn verdict(h: f64, parts: [f64; 3]) -> Verdict {
        let measured = judge("pair/off-centre", h, |scene, index, _, t| motion(scene, index, t, parts));
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn the_closed_form_passes_and_another_impulse_lever_or_direction_fails_at_every_step() {
        for h in SWEEP {
            assert_eq!(verdict(h, [1.0, 1.0, 0.0]), Verdict::Pass, "{h}");
            for wrong in [[0.0, 1.0, 0.0], [0.99, 1.0, 0.0], [1.01, 1.0, 0.0], [1.0, 0.9, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.1]] {
                assert_eq!(verdict(h, wrong), Verdict::Fail, "{wrong:?} at {h}");
            }
        }
    }
}
