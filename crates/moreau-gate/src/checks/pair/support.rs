//! Balls that rest on a box, which is hit and slides away under them: they fall.
//!
//! ```text
//!     no friction:   the balls stay where they are until the rear edge of the box passes below them, at t₀ ,
//!                    then the edge is at a distance V (t − t₀), and R − √(R² − V² τ²) ≥ ½ V² τ²/R > ½ g τ²  for V² > g R :
//!                    nothing holds them,   v_z = −g (t − t₀)
//! ```
//! V and t₀ are read from the box's own motion, so that the restitution of the hit does not matter.

use crate::checks::motion::{Sample, start_gap};
use crate::checks::pair::meeting::{GAP, undamped};
use crate::checks::scenery::{GRAVITY, cuboid, over_floor, schedule, sphere, worst};
use crate::model::Model;
use crate::tolerance::{incline, pair as tolerance};
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use moreau_dynamics::trajectory::Trajectory;

/// How long the balls rest before the box is hit \[s\]: engines put to sleep what was slow for 0.5 to 2 s.
const REST: f64 = 2.1;
/// The same of an engine that lets no body sleep, because it declares the option that would \[s\].
const AWAKE: f64 = 0.3;
/// From the hit to the end \[s\]: the box is away after half of it, and the balls do not reach the floor.
const AFTER: f64 = 0.45;
/// Half extents of the box \[m\]: so wide that who hits its middle passes between the balls.
const BOX: [f64; 3] = [0.4, 2.0, 0.5];
/// Of the box and of who hits it, and of each ball \[kg\].
const HEAVY: f64 = 4.0;
const LIGHT: f64 = 0.25;
/// Of who hits the box at the height of its middle, and of the balls \[m\].
const RADII: [f64; 2] = [0.5, 0.1];
/// From the middle of the box to either ball, across \[m\].
const ASIDE: f64 = 1.5;
/// \[m/s\]; half of it is faster than √(g R) = 0.99 m/s.
const SPEED: f64 = 4.0;

/// All as deep as they lie, by declaration.
fn scene(bench: &Bench, rest: f64, h: f64) -> Scene {
    let lying = |mass: f64, points: f64| start_gap(bench, h, (mass, points), GRAVITY, 0.0, 0.0);
    let floor = BOX[2] + lying(HEAVY + 2.0 * LIGHT, 4.0);
    let above = floor + BOX[2] + RADII[1] + lying(LIGHT, 1.0);
    let far = BOX[0] + RADII[0] + GAP + SPEED * rest;
    let visitor = sphere("visitor", HEAVY, RADII[0], [-far, 0.0, RADII[0] + lying(HEAVY, 1.0)]);
    let ball = |name: &str, side: f64| sphere(name, LIGHT, RADII[1], [0.0, side * ASIDE, above]);
    let visitor = Body { linear_velocity: [SPEED, 0.0, 0.0], ..visitor };
    over_floor(
        "support that leaves",
        vec![ball("left", 1.0), ball("right", -1.0), cuboid("box", HEAVY, BOX, [0.0, 0.0, floor]), visitor],
        0.0,
    )
}

pub(super) fn support_leaves(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let asked = |rest: f64| schedule(rest + GAP / SPEED + AFTER, 1, h);
    let ends = |motion: &Trajectory| [0, 1, 2].map(|body| Sample::of(&motion.bodies[body], 1));
    let rest = if bench.description().sleeping.is_some() { AWAKE } else { REST };
    let (steps, every) = asked(rest);
    let awake = bench.simulate(&scene(bench, rest, h), h, steps, every)?;
    let mut measured = fallen(bench, h, "", &ends(&awake));
    let (steps, every) = asked(REST);
    let asleep = bench.simulate_sleeping(&scene(bench, REST, h), h, steps, every)?;
    measured.extend(asleep.map(|motion| fallen(bench, h, ", asleep", &ends(&motion))).into_iter().flatten());
    Ok(measured)
}

/// How much slower the slower ball falls than one that has fallen since the edge passed, and where the box is.
fn fallen(bench: &Bench, h: f64, words: &str, [left, right, block]: &[Sample; 3]) -> Vec<Measurement> {
    let speed = block.velocity.x;
    let time = (block.position.x - BOX[0]) / speed;
    let declared = start_gap(bench, h, (LIGHT, 1.0), GRAVITY, 0.0, 0.0).abs();
    let allowance = match Model::of(bench.description()) {
        Model::Coulomb(limits) => limits.penetration_allowance,
        _ => 0.0,
    };
    let depth = declared.max(allowance) + tolerance::set_down(GRAVITY, h);
    let allowed = tolerance::left_behind(depth, RADII[1], speed, GRAVITY, h);
    let off = [left, right].map(|one| (one.velocity.z + GRAVITY * time).abs()).into_iter().fold(0.0, worst);
    let moved = [left, right].map(|one| one.position.x.abs()).into_iter().fold(0.0, worst);
    let solved = tolerance::ratio(bench.epsilon()) * SPEED + incline::momentum(GRAVITY) * (REST + AFTER);
    vec![
        Measurement::new(
            format!("speed of the box that was hit{words}"),
            "m/s",
            speed,
            Expectation::at_least(0.5 * SPEED, solved, "m v/(m + M), or more of it"),
        ),
        Measurement::new(
            format!("fall of the balls it leaves, beside g t{words}"),
            "m/s",
            off,
            Expectation::at_most(0.0, allowed, "nothing holds them since its edge has passed"),
        ),
        Measurement::new(
            format!("way of the balls along the floor{words}"),
            "m",
            moved,
            Expectation::at_most(0.0, allowed * AFTER, "there is no friction"),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Exact, RigidState, judge_declaring};
    use crate::runner::SWEEP;
    use crate::{Description, Engine, Options, Verdict};

    /// When the box of a scene is hit \[s\].
    fn hit(scene: &Scene) -> f64 {
        -(scene.bodies[3].position[0] + BOX[0] + RADII[0]) / SPEED
    }

    fn motion(scene: &Scene, index: usize, t: f64, [falling, carried, later]: [f64; 3]) -> RigidState {
        let body = &scene.bodies[index];
        let ([x, y, z], hit) = (body.position, hit(scene));
        let (since, together) = ((t - hit).max(0.0), 0.5 * SPEED);
        let fall = (since - BOX[0] / together - later).max(0.0) * falling;
        let [before, after] = match index {
            2 => [0.0, together],
            3 => [SPEED, together],
            _ => [0.0, together * carried],
        };
        let down = if index < 2 { GRAVITY * fall } else { 0.0 };
        let place = [x + before * t.min(hit) + after * since, y, z - 0.5 * down * fall];
        (place, body.orientation, [if t < hit { before } else { after }, 0.0, -down], [0.0; 3])
    }

    #[test]
    fn an_engine_that_declares_sleep_is_asked_awake_after_a_short_rest_and_asleep_after_a_long_one() {
        let falls_after_short_rests = |scene: &Scene, index: usize, _: f64, t: f64| {
            let falling = if hit(scene) < 0.5 { 1.0 } else { 0.0 };
            motion(scene, index, t, [falling, 0.0, 0.0])
        };
        let mut engine = Exact { motion: falls_after_short_rests };
        let options = Options::new();
        let described = engine.describe(&options).expect("describes itself");
        let description = Description { sleeping: Some("sleep".into()), ..described };
        let measured = support_leaves(&mut Bench::new(&mut engine, &description, &options), 1e-3).expect("answers");
        let verdicts: Vec<Verdict> = measured.iter().map(Measurement::verdict).collect();
        use Verdict::{Fail, Pass};
        assert_eq!(verdicts, [Pass, Pass, Pass, Pass, Fail, Pass]);
    }

    /// Box and visitor go on together; the balls fall with a part of gravity, and move with a part of the box's speed after the hit.
    fn verdict(h: f64, falling: f64, carried: f64) -> Verdict {
        late(h, falling, carried, 0.0, &[])
    }

    /// The same of balls that are free so much later, for an engine that declares these numbers.
    fn late(h: f64, falling: f64, carried: f64, later: f64, declared: &[(&str, f64, &str)]) -> Verdict {
        let measured =
            judge_declaring("pair/support-leaves", h, declared, |scene, index, _, t| motion(scene, index, t, [falling, carried, later]));
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn balls_that_lie_as_deep_as_an_engine_declares_are_free_later() {
        // √(2 R δ)/V for δ = 5 mm, R = 0.1 m, V = 2 m/s, which is 3/20 m/s of fall
        let later = 0.001f64.sqrt() / 2.0;
        assert_eq!(late(1e-4, 1.0, 0.0, later, &[("penetration_allowance", 0.005, "m")]), Verdict::Pass);
        assert_eq!(late(1e-4, 1.0, 0.0, later, &[]), Verdict::Fail);
    }

    #[test]
    fn balls_that_fall_pass_and_balls_that_hang_in_the_air_or_go_with_the_box_fail() {
        for h in SWEEP {
            assert_eq!(verdict(h, 1.0, 0.0), Verdict::Pass, "{h}");
            for (falling, carried) in [(0.0, 0.0), (1.0, 1.0)] {
                assert_eq!(verdict(h, falling, carried), Verdict::Fail, "{falling}, {carried} at {h}");
            }
        }
        assert_eq!(verdict(1e-3, 0.9, 0.0), Verdict::Fail, "a tenth less at a small step");
    }
}
