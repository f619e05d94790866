//! Two solid spheres meet with slip: by their spins along the line of centres, and obliquely.
//!
//! ```text
//!     W_n = 1/m̄ ,   W_t = 1/m₁ + 1/m₂ + R₁²/J₁ + R₂²/J₂ = 7/2 · 1/m̄ ,   J = ⅖ m R² :
//!     p_t = min(μ p_n, 2/7 m̄ ‖u_t‖)  against the slip,   J_i Δω_i = l_i × p_i
//! ```
//! In the first scene the spheres fly along their line of centres, which does not turn, so that n is exact whenever they meet.

use crate::checks::pair::friction;
use crate::checks::pair::meeting::{GAP, Meeting, SPEED, in_space, lasting, opening, undamped};
use crate::checks::scenery::sphere;
use crate::model::sliding::hops;
use crate::tolerance::{impact, pair as tolerance};
use crate::{Bench, Kind, Measurement, Reply};
use moreau_dynamics::scenes::Body;
use nalgebra::Vector3;

/// \[m\], large against the motion of a step.
pub(super) const RADII: [f64; 2] = [4.0, 6.0];
pub(super) const MASSES: [f64; 2] = [1.0, 3.0];
/// Slip at the place of contact by the spins \[m/s\].
const SLIP: f64 = 4.0;
/// Where the spheres slip to the end, and where they do not.
const SMOOTH: f64 = 0.2;
const ROUGH: f64 = 1.0;
/// m̄ W_t.
const STICKING: f64 = 3.5;
/// Distance of the line of flight from the other centre \[m\] in the oblique scene: n = (0.6, 0.8).
const OFFSET: f64 = 8.0;

/// m̄ \[kg\].
pub(super) fn reduced_mass() -> f64 {
    MASSES[0] * MASSES[1] / (MASSES[0] + MASSES[1])
}

/// Two spheres at this height \[m\] that meet along x and slip along y, half of it by the spin of each.
fn spinning(names: [&str; 2], height: f64, slip: f64) -> [Body; 2] {
    let places = [-(RADII[0] + RADII[1] + GAP), 0.0];
    let body = |k: usize| Body {
        angular_velocity: [0.0, 0.0, 0.5 * slip / RADII[k]],
        ..sphere(names[k], MASSES[k], RADII[k], [places[k], 0.0, height])
    };
    [Body { linear_velocity: [SPEED, 0.0, 0.0], ..body(0) }, body(1)]
}

/// A sphere that flies along x at another at rest.
fn oblique() -> Vec<Body> {
    let reach = RADII[0] + RADII[1];
    let along = (reach * reach - OFFSET * OFFSET).sqrt() + GAP;
    let first = Body { linear_velocity: [SPEED, 0.0, 0.0], ..sphere("first", MASSES[0], RADII[0], [-along, 0.0, 0.0]) };
    vec![first, sphere("second", MASSES[1], RADII[1], [0.0, OFFSET, 0.0])]
}

pub(super) fn oblique_spheres(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let mut measured = Vec::new();
    for (words, mu) in [("slip", SMOOTH), ("stick", ROUGH)] {
        measured.extend(by_spin(bench, h, (&format!(", {words} by spin, e = 0"), mu, 0.0))?);
        if bench.description().restitution {
            measured.extend(by_spin(bench, h, (&format!(", {words} by spin, e = ½"), mu, 0.5))?);
        }
        measured.extend(by_flight(bench, h, &format!(", {words} by flight"), mu)?);
    }
    Ok(measured)
}

fn by_spin(bench: &mut Bench, h: f64, (words, mu, restitution): (&str, f64, f64)) -> Reply<Vec<Measurement>> {
    let scene = in_space("spinning spheres", spinning(["first", "second"], 0.0, SLIP).into(), mu, restitution);
    let meeting = Meeting::of(bench, &scene, Vector3::x(), SPEED + opening(bench, mu * SLIP), h)?;
    let pushed = meeting.gains[1].impulse;
    let across = pushed.yz().norm();
    let levers = [Vector3::x() * RADII[0], Vector3::x() * -RADII[1]];
    let slack = meeting.apart * across;
    let mut measured: Vec<Measurement> = meeting.momenta(words, slack).into();
    let turned = across / reduced_mass() * meeting.lasted / (RADII[0] + RADII[1]);
    measured.extend(meeting.moments(words, levers, slack + tolerance::turned_lever(RADII[1], turned, pushed.x)));
    let (ideal, law) = friction::opposed(bench);
    let angle = pushed.z.abs().atan2(pushed.y);
    measured.push(Measurement::new(format!("angle of friction to the slip{words}"), "rad", angle, ideal).predicted(law));
    measured.extend(amount(bench, h, (words, mu), [pushed.x, across], meeting.apart / RADII[0]));
    Ok(measured)
}

/// How much friction there was: the impulse over the normal one under slip, over what stops the slip otherwise.
fn amount(bench: &Bench, h: f64, (words, mu): (&str, f64), impulse: [f64; 2], lever: f64) -> Option<Measurement> {
    if mu == SMOOTH {
        return slipping(bench, h, (words, mu, SLIP), impulse, lever);
    }
    let still = SLIP / STICKING;
    // the part that is pressed in a second step acts along a line of centres that has turned
    let turned = tolerance::turned_impulse(turn(bench, h, still), 2.0 * SPEED, still);
    let (ideal, law) = friction::sticking(bench, lever, turned);
    let replayed = friction::spheres_replayed(bench, h, [reduced_mass(), RADII[0]], mu, SLIP);
    let law = replayed.map(|[_, across]| friction::of_the_replay(across / still, lever, turned, bench)).or(law);
    let measured = || Measurement::new(format!("friction over 2/7 m̄ u_t{words}"), "1", impulse[1] / (reduced_mass() * still), ideal);
    (law.is_some() || friction::sticks(bench)).then(|| measured().predicted(law))
}

/// Angle \[rad\] by which the line of centres turns while the spheres touch, when they move past each other with `speed` \[m/s\].
fn turn(bench: &Bench, h: f64, speed: f64) -> f64 {
    speed * lasting(bench, h) / (RADII[0] + RADII[1])
}

/// Speed \[m/s\] at which slipping spheres move past each other after an elastic impact.
pub(super) fn past(bench: &Bench, mu: f64, slip: f64) -> f64 {
    mu * (2.0 * SPEED + opening(bench, mu * slip))
}

/// Friction over the normal impulse of spheres that slip to the end.
fn slipping(bench: &Bench, h: f64, (words, mu, slip): (&str, f64, f64), impulse: [f64; 2], lever: f64) -> Option<Measurement> {
    let turned = tolerance::turned_ratio(turn(bench, h, past(bench, mu, slip)), mu);
    let (ideal, law) = friction::slipping(bench, mu, turned);
    let replayed = friction::spheres_replayed(bench, h, [reduced_mass(), RADII[0]], mu, slip);
    let law = replayed.map(|impulses| friction::of_the_replay(friction::ratio(impulses), lever, turned, bench)).or(law);
    let measured = || Measurement::new(format!("friction over normal impulse{words}"), "1", friction::ratio(impulse), ideal);
    friction::on_the_cone(bench).then(|| measured().predicted(law))
}

fn by_flight(bench: &mut Bench, h: f64, words: &str, mu: f64) -> Reply<Vec<Measurement>> {
    let scene = in_space("oblique spheres", oblique(), mu, 0.0);
    let reach = RADII[0] + RADII[1];
    let normal = Vector3::new((reach * reach - OFFSET * OFFSET).sqrt(), OFFSET, 0.0) / reach;
    let along = Vector3::new(normal.y, -normal.x, 0.0);
    let meeting = Meeting::of(bench, &scene, normal, SPEED, h)?;
    let pushed = meeting.gains[1].impulse;
    let mut measured: Vec<Measurement> = meeting.momenta(words, meeting.apart * pushed.norm()).into();
    if bench.description().contact_model.kind == Kind::Compliant || hops(bench.description()) {
        // the line of centres turns while such a contact lasts
        return Ok(measured);
    }
    let [pressed, across] = [pushed.dot(&normal), pushed.dot(&along)];
    // an elastic impact that sticks has the largest impulse
    let [hit, still] = [SPEED * normal.x, SPEED * along.x / STICKING].map(|speed| reduced_mass() * speed);
    let turn = impact::turned(OFFSET, reach, SPEED, h);
    let turned = |component: f64| tolerance::turned_impulse(turn, 2.0 * hit + still, component);
    let (value, what, (ideal, law)) = if mu == SMOOTH {
        (friction::ratio([pressed, across]), "friction over normal impulse", friction::slipping(bench, mu, turned(mu * hit)))
    } else {
        let lever = meeting.apart / RADII[0];
        (across / still, "friction over 2/7 m̄ u_t", friction::sticking(bench, lever, turned(still)))
    };
    measured.push(Measurement::new(format!("{what}{words}"), "1", value, ideal).predicted(law));
    Ok(measured)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{RigidState, judge};
    use crate::runner::SWEEP;
    use moreau_dynamics::scenes::Scene;

    /// The exact motion, but with parts of friction, of the lever of the second sphere, and of the impulse on it.
    fn motion(scene: &Scene, index: usize, t: f64, [part, lever, reaction]: [f64; 3]) -> RigidState {
        let by_spin = scene.bodies[1].angular_velocity[2] > 0.0;
        let normal = if by_spin { Vector3::x() } else { Vector3::new(0.6, 0.8, 0.0) };
        let along = if by_spin { Vector3::y() } else { Vector3::new(0.8, -0.6, 0.0) };
        let [approach, slip, flight] = if by_spin { [SPEED, SLIP, GAP] } else { [0.6 * SPEED, 0.8 * SPEED, GAP] };
        let pressed = (1.0 + scene.material.restitution) * reduced_mass() * approach;
        let across = (scene.material.friction * pressed).min(reduced_mass() * slip / STICKING) * part;
        let impulse = (normal * pressed + along * across) * [-1.0, reaction][index];
        let arm = normal * [RADII[0], -RADII[1] * lever][index];
        let body = &scene.bodies[index];
        let contact = flight / SPEED;
        let [before, spin] = [body.linear_velocity, body.angular_velocity].map(Vector3::from);
        let after = before + impulse / MASSES[index];
        let turned = spin + arm.cross(&impulse) / (0.4 * MASSES[index] * RADII[index] * RADII[index]);
        let place = Vector3::from(body.position) + before * t.min(contact) + after * (t - contact).max(0.0);
        let [velocity, spin] = if t < contact { [before, spin] } else { [after, turned] };
        (place.into(), [1.0, 0.0, 0.0, 0.0], velocity.into(), spin.into())
    }

    fn verdict(h: f64, parts: [f64; 3]) -> Verdict {
        let measured = judge("pair/oblique-spheres", h, |scene, index, _, t| motion(scene, index, t, parts));
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn the_closed_form_passes_and_other_friction_levers_or_reactions_fail_at_every_step() {
        for h in SWEEP {
            assert_eq!(verdict(h, [1.0; 3]), Verdict::Pass, "{h}");
            for wrong in [[0.0, 1.0, 1.0], [0.9, 1.0, 1.0], [1.1, 1.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.9, 1.0], [1.0, 1.0, 0.99]] {
                assert_eq!(verdict(h, wrong), Verdict::Fail, "{wrong:?} at {h}");
            }
        }
    }
}
