//! A cube that stands on a corner meets the floor or the face of a box with slip and restitution.
//!
//! ```text
//!     J = ⅔ m a² ,  l = √3 a :    W_t = 11/2 · 1/m  on the floor,   + 1/M + b²/J'  on a box
//! ```
//! The corner is below the centre and J is that of a sphere, so that normal and tangents are uncoupled in any direction of slip.

use crate::checks::motion::{Sample, samples, yields};
use crate::checks::pair::compliant::corner_radius;
use crate::checks::pair::meeting::{DURATION, GAP, Meeting, SPEED, gained, in_space, moments_of, opening, steps, undamped};
use crate::checks::pair::rough::Rough;
use crate::checks::pair::view::View;
use crate::checks::scenery::cuboid;
use crate::{Bench, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Ground, Scene};
use moreau_dynamics::trajectory::Trajectory;
use nalgebra::{UnitQuaternion, Vector3};
use std::f64::consts::FRAC_PI_2;

/// Half the edge of the cube and half extents of the box \[m\], large against the motion of a step.
const CUBE: f64 = 4.0;
const HALF: [f64; 3] = [3.0, 6.0, 6.0];
/// Of the cube and of the box \[kg\].
const MASSES: [f64; 2] = [1.0, 90.0];
/// \[m/s\], and where it lasts to the end or does not.
const SLIP: f64 = 4.0;
const SMOOTH: f64 = 0.1;
const ROUGH: f64 = 1.0;
const RESTITUTION: f64 = 0.5;

/// From the centre of the cube to its corner \[m\].
fn lever() -> f64 {
    3.0f64.sqrt() * CUBE
}

/// The cube flies along x, one corner ahead.
fn cube(velocity: [f64; 3], offset: f64) -> Body {
    let turn = UnitQuaternion::rotation_between(&Vector3::repeat(1.0), &Vector3::x()).unwrap_or_default();
    let orientation = [turn.w, turn.i, turn.j, turn.k];
    let place = [-(lever() + offset), 0.0, 0.0];
    Body { orientation, linear_velocity: velocity, ..cuboid("cube", MASSES[0], [CUBE; 3], place) }
}

pub(super) fn corner(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let e = if bench.description().restitution { RESTITUTION } else { 0.0 };
    let mut measured = Vec::new();
    for (slips, mu) in [("slip", SMOOTH), ("stick", ROUGH)] {
        measured.extend(on_the_floor(bench, h, (&format!(", on the floor, {slips}"), mu, e))?);
        measured.extend(on_a_box(bench, h, (&format!(", on a box, {slips}"), mu, e))?);
    }
    Ok(measured)
}

/// n = x seen as −z.
fn on_the_floor(bench: &mut Bench, h: f64, (words, mu, e): (&str, f64, f64)) -> Reply<Vec<Measurement>> {
    let view = View { turn: UnitQuaternion::from_scaled_axis(Vector3::y() * FRAC_PI_2), reversed: false };
    let ground = Some(Ground { normal: [0.0, 0.0, 1.0], offset: 0.0 });
    let flying = in_space("cube on its corner", vec![cube([SPEED, SLIP, 0.0], GAP)], mu, e);
    let scene = Scene { ground, ..view.of(&flying) };
    let motion = bench.simulate(&scene, h, steps(h), 1)?;
    let gain = gained(&scene, &motion, 0);
    let approach = SPEED + opening(bench, mu * SLIP);
    let mut meeting = Meeting::on_the_floor(bench, gain, (MASSES[0] * (SPEED + SLIP), lever()), approach, h).turned_back(&view);
    meeting.apart += 2.0 * corner_radius(bench);
    meeting.lasted = lasted(bench, &motion, h);
    let rough = rough((words, mu, e), [f64::INFINITY, f64::INFINITY], [lever(), 0.0], 0.0);
    Ok(rough.measured(bench, h, &meeting))
}

/// Time \[s\] for which the corner of a body that yields was below the floor, up to the next samples; 0 where nothing yields.
fn lasted(bench: &Bench, motion: &Trajectory, h: f64) -> f64 {
    let corner = |state: &Sample| (state.position + state.rotation * Vector3::repeat(CUBE)).z;
    let below = samples(&motion.bodies[0]).iter().filter(|state| corner(state) < 0.0).count();
    if yields(bench) { (below + 1) as f64 * h } else { 0.0 }
}

/// The box moves across, so that its middle is where the corner arrives.
fn on_a_box(bench: &mut Bench, h: f64, (words, mu, e): (&str, f64, f64)) -> Reply<Vec<Measurement>> {
    let place = [0.0, SLIP * GAP / SPEED, 0.0];
    let block = Body { linear_velocity: [0.0, -SLIP, 0.0], ..cuboid("box", MASSES[1], HALF, place) };
    let scene = in_space("cube on a box", vec![cube([SPEED, 0.0, 0.0], HALF[0] + GAP), block], mu, e);
    let approach = SPEED + opening(bench, mu * SLIP);
    let mut meeting = Meeting::viewed(bench, &scene, &View::turned(true), (Vector3::x(), approach), (DURATION, h))?;
    meeting.apart += 2.0 * corner_radius(bench);
    let moment = moments_of(&scene.bodies[1]).z;
    let rough = rough((words, mu, e), [MASSES[1], moment], [lever(), HALF[0]], SLIP);
    Ok(rough.measured(bench, h, &meeting))
}

fn rough<'a>((words, mu, e): (&'a str, f64, f64), [mass, moment]: [f64; 2], levers: [f64; 2], drift: f64) -> Rough<'a> {
    Rough {
        words,
        mu,
        e,
        slip: SLIP,
        slips: mu == SMOOTH,
        masses: [MASSES[0], mass],
        levers,
        moments: [2.0 / 3.0 * MASSES[0] * CUBE * CUBE, moment],
        drift,
        cornered: true,
        size: if levers[1] > 0.0 { levers[1] } else { CUBE },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{RigidState, judge};
    use crate::runner::SWEEP;

    /// The exact motion with parts of friction, of the cube's lever and of restitution.
    fn motion(scene: &Scene, index: usize, t: f64, [part, arm, returned]: [f64; 3]) -> RigidState {
        let body = &scene.bodies[index];
        let floor = scene.ground.is_some();
        let (normal, slip, role) = directions(scene, index);
        // J of the cube is 32/3 kg·m², of the box 90/3 (9 + 36) kg·m²
        let (mean, across_mass) = if floor { (1.0, 5.5) } else { (90.0 / 91.0, 5.5 + 1.0 / 90.0 + 9.0 / 1350.0) };
        let pressed = (1.0 + scene.material.restitution * returned) * mean * SPEED;
        let across = (scene.material.friction * pressed).min(SLIP / across_mass) * part;
        let impulse = (normal * pressed + slip * across) * [-1.0, 1.0][role];
        let lever = normal * [lever() * arm, -HALF[0]][role];
        let contact = GAP / SPEED;
        let before = Vector3::from(body.linear_velocity);
        let after = before + impulse / MASSES[role];
        let place = Vector3::from(body.position) + before * t.min(contact) + after * (t - contact).max(0.0);
        let turned = lever.cross(&impulse) / [32.0 / 3.0, 1350.0][role];
        let [velocity, spin] = if t < contact { [before, Vector3::zeros()] } else { [after, turned] };
        (place.into(), body.orientation, velocity.into(), spin.into())
    }

    /// Normal from the cube, direction of friction on what it meets, and whether this body is the cube.
    fn directions(scene: &Scene, index: usize) -> (Vector3<f64>, Vector3<f64>, usize) {
        if scene.ground.is_some() {
            return (-Vector3::z(), Vector3::y(), 0);
        }
        let cube = scene.bodies.iter().position(|body| body.name == "cube").expect("a cube");
        let [flight, across] = [cube, 1 - cube].map(|k| Vector3::from(scene.bodies[k].linear_velocity).normalize());
        (flight, -across, usize::from(index != cube))
    }

    fn verdict(h: f64, parts: [f64; 3]) -> Verdict {
        let measured = judge("pair/rough-corner", h, |scene, index, _, t| motion(scene, index, t, parts));
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn the_closed_form_passes_and_other_friction_levers_or_restitution_fail_at_every_step() {
        for h in SWEEP {
            assert_eq!(verdict(h, [1.0; 3]), Verdict::Pass, "{h}");
            for wrong in [[0.0, 1.0, 1.0], [0.9, 1.0, 1.0], [1.1, 1.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 0.9], [1.0, 1.0, 0.0]] {
                assert_eq!(verdict(h, wrong), Verdict::Fail, "{wrong:?} at {h}");
            }
        }
    }
}
