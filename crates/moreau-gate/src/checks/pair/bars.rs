//! Two crossed bars on edge: an edge of the one meets an edge of the other in one point, without friction or slipping.
//!
//! ```text
//!     1/m₁ + a²/J₁ + 1/m₂ + b²/J₂ = W_n ,    J = ⅓ m (L² + c²) ,    W_n p = (1 + e) |u_n|
//! ```
//! The edges are horizontal, so that n = z, and they cross a beside the middle of the upper bar and b beside that of the lower one, at
//! whatever distance they meet. With friction they cross at their middles, a = b = 0, where W_nt = 0, and the upper one slips along itself.

use crate::checks::pair::compliant::{self, Approach, restitution};
use crate::checks::pair::friction;
use crate::checks::pair::meeting::{DURATION, GAP, Meeting, SPEED, in_space, lasting, opening, undamped};
use crate::checks::pair::view::View;
use crate::checks::scenery::cuboid;
use crate::description::{Friction, Kind};
use crate::tolerance::pair as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_8, SQRT_2};

/// Half the length L and half the thickness c of both bars \[m\], large against the motion of a step.
const HALF_LENGTH: f64 = 5.0;
const HALF_THICKNESS: f64 = 1.0;
/// Of the upper and the lower bar \[kg\].
const MASSES: [f64; 2] = [1.0, 2.0];
/// From the middle of the upper and of the lower bar to where they cross \[m\].
const ARMS: [f64; 2] = [1.5, 1.0];

/// J of a bar about a horizontal axis across it \[kg·m²\].
fn moment(mass: f64) -> f64 {
    mass * (HALF_LENGTH * HALF_LENGTH + HALF_THICKNESS * HALF_THICKNESS) / 3.0
}

/// W_n \[1/kg\].
fn inverse_mass() -> f64 {
    (0..2).map(|k| 1.0 / MASSES[k] + ARMS[k] * ARMS[k] / moment(MASSES[k])).sum()
}

/// The upper bar along x comes down on the lower one along y; they cross at these arms \[m\].
fn scene(arms: [f64; 2], friction: f64, restitution: f64) -> Scene {
    let (thin, long) = (HALF_THICKNESS, HALF_LENGTH);
    let (cosine, sine) = (FRAC_PI_8.cos(), FRAC_PI_8.sin());
    let height = 2.0 * SQRT_2 * HALF_THICKNESS + GAP;
    let upper = Body {
        orientation: [cosine, sine, 0.0, 0.0],
        linear_velocity: [0.0, 0.0, -SPEED],
        ..cuboid("upper", MASSES[0], [long, thin, thin], [arms[0], arms[1], height])
    };
    let lower = Body { orientation: [cosine, 0.0, sine, 0.0], ..cuboid("lower", MASSES[1], [thin, long, thin], [0.0; 3]) };
    in_space("crossed bars", vec![upper, lower], friction, restitution)
}

pub(super) fn crossed_bars(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let mut measured = Vec::new();
    for (seen, view) in [("", View::plain()), (", turned, lower bar listed first", View::turned(true))] {
        measured.extend(meet(bench, h, (&format!(", e = 0{seen}"), 0.0), &view)?);
        if bench.description().restitution {
            measured.extend(meet(bench, h, (&format!(", e = ½{seen}"), 0.5), &view)?);
        }
    }
    if bench.description().friction != Friction::None {
        measured.extend(rub(bench, h)?);
    }
    Ok(measured)
}

/// μ and slip \[m/s\] of the upper bar, which moves along its edge and slips all the time.
const FRICTION: f64 = 0.3;
const SLIP: f64 = 12.0;

/// Friction at the middle of both edges, plastic.
fn rub(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let mut scene = scene([0.0; 2], FRICTION, 0.0);
    // the edges cross in the middle when they meet
    scene.bodies[0].position[0] -= SLIP * GAP / SPEED;
    scene.bodies[0].linear_velocity[0] = SLIP;
    let meeting = Meeting::of(bench, &scene, -Vector3::z(), SPEED + opening(bench, FRICTION * SLIP), h)?;
    let pushed = meeting.gains[1].impulse;
    // friction turns the lower bar about itself, and the upper one across; the place of contact moves along with the slip
    let mean = MASSES[0] * MASSES[1] / (MASSES[0] + MASSES[1]);
    let turning = SQRT_2 * HALF_THICKNESS * FRICTION * mean * (2.0 * SPEED + opening(bench, FRICTION * SLIP)) / moment(MASSES[0]);
    let turn = turning * (lasting(bench, h) + h);
    let slack = meeting.apart * pushed.x.abs() + SLIP * (lasting(bench, h) + h) * pushed.z.abs();
    let mut measured: Vec<Measurement> = meeting.momenta(", slipping", slack).into();
    let (ideal, law) = friction::opposed(bench);
    let angle = pushed.y.abs().atan2(pushed.x);
    measured.push(Measurement::new("angle of friction to the slip", "rad", angle, ideal).predicted(law));
    if friction::on_the_cone(bench) {
        let (ideal, law) = friction::slipping(bench, FRICTION, tolerance::turned_ratio(turn, FRICTION));
        let value = friction::ratio([-pushed.z, pushed.xy().norm()]);
        measured.push(Measurement::new("friction over normal impulse, slipping", "1", value, ideal).predicted(law));
    }
    Ok(measured)
}

fn meet(bench: &mut Bench, h: f64, (words, e): (&str, f64), view: &View) -> Reply<Vec<Measurement>> {
    let meeting = Meeting::viewed(bench, &scene(ARMS, 0.0, e), view, (-Vector3::z(), SPEED), (DURATION, h))?;
    let lifted = meeting.gains[0].impulse;
    // the largest impulse turns the bars by these speeds, and their edges roll on each other while they stay in touch
    let most = 2.0 * SPEED / inverse_mass();
    let spins = [0, 1].map(|k| most * ARMS[k] / moment(MASSES[k]));
    let turn = spins[0].max(spins[1]) * DURATION;
    let closing = SQRT_2 * HALF_THICKNESS * spins.iter().map(|spin| spin * spin).sum::<f64>();
    let later = tolerance::later(closing, DURATION, SPEED);
    let lasting = if bench.description().contact_model.kind == Kind::Compliant { 1.0 } else { later };
    let slack = most * turn * (meeting.apart + lasting * SQRT_2 * HALF_THICKNESS);
    let levers = [Vector3::new(-ARMS[0], 0.0, -SQRT_2 * HALF_THICKNESS), Vector3::new(0.0, ARMS[1], SQRT_2 * HALF_THICKNESS)];
    let off = Expectation::at_most(0.0, turn + tolerance::direction(bench.epsilon()), "the edges' common normal, turned as the bars are");
    let mut measured: Vec<Measurement> = meeting.momenta(words, slack).into_iter().chain(meeting.moments(words, levers, slack)).collect();
    let edges = compliant::one_point(bench, inverse_mass(), &MASSES, h);
    measured.extend(restitution(bench, h, (words, e), lifted.z * inverse_mass() / SPEED - 1.0, later, 0.0, (&edges, Approach::usual(h))));
    measured.push(Measurement::new(format!("angle of the impulse to the normal{words}"), "rad", lifted.xy().norm().atan2(lifted.z), off));
    Ok(measured)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::checks::pair::meeting::moments_of;
    use crate::exact::{RigidState, judge};
    use crate::runner::SWEEP;

    /// The bars with parts of the right impulse, lever and friction; nothing turns visibly.
    fn motion(scene: &Scene, index: usize, t: f64, [part, lever, rubbed]: [f64; 3]) -> RigidState {
        let body = &scene.bodies[index];
        let role = usize::from(body.name == "lower");
        // impulse and levers of the plain scene, turned as the scene is
        let turn = if scene.bodies[0].name == "lower" { View::turned(true).turn } else { View::plain().turn };
        let contact = GAP / SPEED;
        let before = Vector3::from(body.linear_velocity);
        let mu = scene.material.friction;
        let response = if mu > 0.0 { 1.0 / MASSES[0] + 1.0 / MASSES[1] } else { inverse_mass() };
        let direction = Vector3::z() - Vector3::x() * (mu * rubbed);
        let impulse = direction * (1.0 + scene.material.restitution) * SPEED / response * part * [1.0, -1.0][role];
        let after = before + turn * impulse / MASSES[role];
        let down = Vector3::z() * SQRT_2 * HALF_THICKNESS;
        let arm = if mu > 0.0 { [-down, down] } else { [Vector3::new(-ARMS[0], 0.0, 0.0), Vector3::new(0.0, ARMS[1], 0.0)] };
        // the lower bar turns about itself
        let moments = if mu > 0.0 { [moment(MASSES[0]), moments_of(body).y] } else { MASSES.map(moment) };
        let spin = turn * arm[role].cross(&impulse) * lever / moments[role];
        let place = Vector3::from(body.position) + before * t.min(contact) + after * (t - contact).max(0.0);
        let hit = t >= contact;
        (place.into(), body.orientation, if hit { after } else { before }.into(), if hit { spin } else { Vector3::zeros() }.into())
    }

    fn verdict(h: f64, parts: [f64; 3]) -> Verdict {
        let measured = judge("pair/crossed-bars", h, |scene, index, _, t| motion(scene, index, t, parts));
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn the_closed_form_passes_and_another_impulse_lever_or_friction_fails_at_every_step() {
        for h in SWEEP {
            assert_eq!(verdict(h, [1.0; 3]), Verdict::Pass, "{h}");
            for wrong in [[0.0, 1.0, 1.0], [0.95, 1.0, 1.0], [1.05, 1.0, 1.0], [1.0, 0.7, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 0.8]] {
                assert_eq!(verdict(h, wrong), Verdict::Fail, "{wrong:?} at {h}");
            }
        }
    }
}
