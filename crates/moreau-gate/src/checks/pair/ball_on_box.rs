//! A ball and a box: a spinning ball meets a free box, a ball rests on a box, and one is thrown along a box.
//!
//! ```text
//!     1/m̄ = 1/m + 1/M ,    W_t = 1/m + R²/J_ball + 1/M + a²/J_box       at the middle of the face, a from the box's centre
//!     rest:   the ball's lowest point is at the top of the box
//!     thrown: v = 5/7 v₀ when it rolls, the floor holding the heavy box
//! ```

use crate::checks::motion::{CLEARANCE, Sample, start_gap, yields};
use crate::checks::pair::meeting::{DURATION, GAP, Meeting, SPEED, in_space, moments_of, opening, undamped};
use crate::checks::pair::rough::Rough;
use crate::checks::pair::view::View;
use crate::checks::scenery::{GRAVITY, cuboid, over_floor, sphere, worst};
use crate::model::compression::LoadedPoint;
use crate::model::sliding::SPHERE;
use crate::model::springs::swinging;
use crate::model::{Model, sink};
use crate::tolerance::{pair as tolerance, rolling};
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use nalgebra::Vector3;

pub(super) const BALL: f64 = 1.0;
pub(super) const BOX: f64 = 9.0;
/// Of the ball that meets a free box \[m\], large against the motion of a step.
pub(super) const RADIUS: f64 = 4.0;
/// Of the free box \[m\]; its moments about y and z are equal.
pub(super) const HALF: [f64; 3] = [3.0, 6.0, 6.0];
/// Slip by the ball's spin \[m/s\], and where it lasts to the end or does not.
const SLIP: f64 = 4.0;
const SMOOTH: f64 = 0.2;
const ROUGH: f64 = 1.0;

pub(super) fn ball_on_box(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let mut measured = Vec::new();
    let views = [("", View::plain()), (", turned, box listed first", View::turned(true))];
    for ((slips, mu), (seen, view)) in [("slip", SMOOTH), ("stick", ROUGH)].into_iter().flat_map(|case| views.map(|view| (case, view))) {
        measured.extend(meet(bench, h, (&format!(", {slips}, e = 0{seen}"), mu, 0.0), &view)?);
        if bench.description().restitution {
            measured.extend(meet(bench, h, (&format!(", {slips}, e = ½{seen}"), mu, 0.5), &view)?);
        }
    }
    for (order, view) in [("", View::plain()), (", box listed first", View { reversed: true, ..View::plain() })] {
        measured.push(rest(bench, h, order, &view)?);
        measured.push(thrown(bench, h, order, &view)?);
    }
    Ok(measured)
}

/// A spinning ball that flies at the middle of a face.
fn free(mu: f64, restitution: f64) -> Scene {
    let ball = Body {
        linear_velocity: [SPEED, 0.0, 0.0],
        angular_velocity: [0.0, 0.0, SLIP / RADIUS],
        ..sphere("ball", BALL, RADIUS, [-(RADIUS + HALF[0] + GAP), 0.0, 0.0])
    };
    in_space("ball and free box", vec![ball, cuboid("box", BOX, HALF, [0.0; 3])], mu, restitution)
}

fn meet(bench: &mut Bench, h: f64, (words, mu, e): (&str, f64, f64), view: &View) -> Reply<Vec<Measurement>> {
    let scene = free(mu, e);
    let moments = [0, 1].map(|k| moments_of(&scene.bodies[k]).z);
    let approach = SPEED + opening(bench, mu * SLIP);
    let meeting = Meeting::viewed(bench, &scene, view, (Vector3::x(), approach), (DURATION, h))?;
    let rough = Rough {
        words,
        mu,
        e,
        slip: SLIP,
        slips: mu == SMOOTH,
        masses: [BALL, BOX],
        levers: [RADIUS, HALF[0]],
        moments,
        drift: 0.0,
        cornered: false,
        size: HALF[0],
    };
    Ok(rough.measured(bench, h, &meeting))
}

/// Of the ball on a box on the floor \[m\].
const SMALL: f64 = 0.5;
const BLOCK: [f64; 3] = [4.0, 1.0, 0.2];
/// Much heavier than the ball \[kg\].
const HEAVY: f64 = 100.0;
const FRICTION: f64 = 0.3;
/// How long it lies or runs \[s\]; twice the time until it rolls.
const RUN: f64 = 0.5;
const THROW: f64 = 2.0;

/// A ball on the middle of a heavy box on the floor, with a speed along it; both as deep as they lie, by declaration.
fn laid(bench: &Bench, h: f64, speed: f64) -> Scene {
    let floor = BLOCK[2] + start_gap(bench, h, (BALL + HEAVY, 4.0), GRAVITY, FRICTION, 0.0);
    let above = floor + BLOCK[2] + SMALL + start_gap(bench, h, (BALL, 1.0), GRAVITY, FRICTION, speed);
    let ball = Body { linear_velocity: [speed, 0.0, 0.0], ..sphere("ball", BALL, SMALL, [0.0, 0.0, above]) };
    over_floor("ball on a box", vec![ball, cuboid("box", HEAVY, BLOCK, [0.0, 0.0, floor])], FRICTION)
}

/// Ball and box at every step.
fn run(bench: &mut Bench, h: f64, speed: f64, view: &View) -> Reply<Vec<[Sample; 2]>> {
    let steps = (RUN / h).round() as usize;
    let motion = bench.simulate(&view.of(&laid(bench, h, speed)), h, steps, 1)?;
    Ok((0..=steps).map(|k| view.pair().map(|body| Sample::of(&motion.bodies[body], k))).collect())
}

/// Height of the ball's lowest point over the top of the box \[m\].
fn height([ball, block]: &[Sample; 2]) -> f64 {
    ball.position.z - SMALL - block.position.z - BLOCK[2]
}

fn rest(bench: &mut Bench, h: f64, order: &str, view: &View) -> Reply<Measurement> {
    let motion = run(bench, h, 0.0, view)?;
    let model = Model::of(bench.description());
    let levels = [
        LoadedPoint { load: (BALL + HEAVY) * GRAVITY, inverse_mass: 1.0 / HEAVY, on_ground: true },
        LoadedPoint { load: BALL * GRAVITY, inverse_mass: 1.0 / BALL + 1.0 / HEAVY, on_ground: false },
    ];
    let allowed = tolerance::set_down(GRAVITY, h) + 2.0 * CLEARANCE;
    let sunk = |depth: f64| Expectation::equal(0.0, depth + allowed, "twice the declared rest depth under the whole load");
    let gap = Measurement::new(
        format!("height of a resting ball over the box{order}"),
        "m",
        motion.last().map_or(f64::NAN, height),
        Expectation::equal(0.0, allowed, "it lies on the box, found late by some steps"),
    );
    Ok(gap.predicted(sink::sink(&model, &levels, h).map(sunk)))
}

fn thrown(bench: &mut Bench, h: f64, order: &str, view: &View) -> Reply<Measurement> {
    let motion = run(bench, h, THROW, view)?;
    let exact = 5.0 / 7.0 * THROW;
    let deepest = motion.iter().map(|states| -height(states)).fold(0.0, worst);
    let lever = if yields(bench) { deepest } else { tolerance::set_down(GRAVITY, h) };
    // W_t of ball and box; it rolls after half of the run.
    let response = SPHERE / BALL + 1.0 / HEAVY;
    let swing = swinging(&Model::of(bench.description()), FRICTION * BALL * GRAVITY, response, 0.5 * RUN) / (SPHERE * BALL);
    let allowed = rolling::speed(THROW) + tolerance::lever(THROW, lever, SMALL) + swing;
    let ideal = Expectation::equal(exact, allowed, "5/7 v₀, whatever the friction was");
    let speed = motion.last().map_or(f64::NAN, |[ball, _]| ball.velocity.x);
    Ok(Measurement::new(format!("speed of a ball that rolls on the box{order}"), "m/s", speed, ideal))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{RigidState, judge};
    use crate::runner::SWEEP;

    /// The exact motion with parts of friction, of the box's lever and of restitution; a ball that rests or rolls from the start.
    fn motion(scene: &Scene, index: usize, t: f64, [part, lever, returned]: [f64; 3]) -> RigidState {
        let body = &scene.bodies[index];
        if scene.ground.is_some() {
            let rolling = Vector3::from(body.linear_velocity) * (1.0 - 2.0 / 7.0 * part);
            return ((Vector3::from(body.position) + rolling * t).into(), body.orientation, rolling.into(), [0.0; 3]);
        }
        let striker = scene.bodies.iter().position(|body| body.sphere.is_some()).expect("a ball");
        let role = usize::from(index != striker);
        let ball = &scene.bodies[striker];
        let [normal, axis] = [ball.linear_velocity, ball.angular_velocity].map(|vector| Vector3::from(vector).normalize());
        // J of the ball is 6.4 kg·m², of the box 135 kg·m².
        let (mean, across_mass) = (0.9, 1.0 + 16.0 / 6.4 + 1.0 / 9.0 + 9.0 / 135.0);
        let pressed = (1.0 + scene.material.restitution * returned) * mean * SPEED;
        let across = (scene.material.friction * pressed).min(SLIP / across_mass) * part;
        let impulse = (normal * pressed + axis.cross(&normal) * across) * [-1.0, 1.0][role];
        let arm = normal * [RADIUS, -HALF[0] * lever][role];
        let contact = GAP / SPEED;
        let [before, spin] = [body.linear_velocity, body.angular_velocity].map(Vector3::from);
        let after = before + impulse / [BALL, BOX][role];
        let turned = spin + arm.cross(&impulse) / [6.4, 135.0][role];
        let place = Vector3::from(body.position) + before * t.min(contact) + after * (t - contact).max(0.0);
        let [velocity, spin] = if t < contact { [before, spin] } else { [after, turned] };
        (place.into(), body.orientation, velocity.into(), spin.into())
    }

    fn verdict(h: f64, parts: [f64; 3]) -> Verdict {
        let measured = judge("pair/ball-on-box", h, |scene, index, _, t| motion(scene, index, t, parts));
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn the_closed_form_passes_and_other_friction_levers_or_restitution_fail_at_every_step() {
        for h in SWEEP {
            assert_eq!(verdict(h, [1.0; 3]), Verdict::Pass, "{h}");
            for wrong in [[0.0, 1.0, 1.0], [0.9, 1.0, 1.0], [1.1, 1.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 0.9]] {
                assert_eq!(verdict(h, wrong), Verdict::Fail, "{wrong:?} at {h}");
            }
        }
    }
}
