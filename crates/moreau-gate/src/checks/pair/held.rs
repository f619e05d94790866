//! A box that lies on a heavy box on a slope, with more friction than both need: it sticks.
//!
//! ```text
//!     tan α < μ :    x_upper − x_lower  stays,   and n·x_upper = c + 2 C  with the half heights c, C
//! ```

use crate::checks::incline::scenes::{angle, held, inclined, slope};
use crate::checks::incline::stick::half_time;
use crate::checks::motion::{Sample, opens_within, start_gap};
use crate::checks::scenery::{GRAVITY, between, cuboid, over_floor};
use crate::model::creep::creep;
use crate::tolerance::{incline as tolerance, pair};
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};

const FRICTION: f64 = 0.5;
/// Upper and lower \[kg\].
const MASSES: [f64; 2] = [1.0, 100.0];
/// Of both boxes \[m\].
const HALF: [[f64; 3]; 2] = [[0.2, 0.15, 0.02], [0.5, 0.4, 0.05]];

/// Both as deep as they lie, by declaration.
fn scene(bench: &Bench, h: f64) -> Scene {
    let press = GRAVITY * angle().cos();
    let [upper, lower] = HALF.map(|half| half[2]);
    let floor = lower + start_gap(bench, h, (MASSES[0] + MASSES[1], 4.0), press, FRICTION, 0.0);
    let above = floor + lower + upper + start_gap(bench, h, (MASSES[0], 4.0), press, FRICTION, 0.0);
    let (sine, cosine) = angle().sin_cos();
    let (half_sine, half_cosine) = (0.5 * angle()).sin_cos();
    let lying = |name: &str, k: usize, height: f64| Body {
        orientation: [half_cosine, 0.0, half_sine, 0.0],
        ..cuboid(name, MASSES[k], HALF[k], [height * sine, 0.0, height * cosine])
    };
    inclined(over_floor("box on a box on a slope", vec![lying("upper", 0, above), lying("lower", 1, floor)], FRICTION), angle())
}

pub(super) fn held_by_a_box(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let scene = scene(bench, h);
    let slope = slope(&scene)?;
    let half = (half_time(bench) / h).round() as usize;
    let motion = bench.simulate(&scene, h, 2 * half, half)?;
    let apart = |k: usize| Sample::of(&motion.bodies[0], k).position - Sample::of(&motion.bodies[1], k).position;
    let time = half as f64 * h;
    let measured = (apart(2) - apart(1)).dot(&slope.down) / time;
    let sizes: f64 = motion.bodies.iter().map(|track| Sample::of(track, 2).position.norm()).sum();
    let carried = pair::carried_creep(slope.pull, h, [MASSES[0], MASSES[0] + MASSES[1]]);
    let ideal = tolerance::creep(slope.pull, h, bench.epsilon(), sizes, time) + carried;
    let crept = |speed: f64| Expectation::equal(speed, ideal + speed, "up to twice the slip at which the declared law holds the load");
    let pushed = opens_within(bench, 2 * half).map(|part| {
        let most = tolerance::pushed_creep(part, FRICTION * slope.press, h) * MASSES.len() as f64;
        between([-most, most], ideal, "the fall of some steps after each declared correction of a depth, of either box")
    });
    let model = creep(bench.description(), &held(&scene, &slope, h)).map(crept).or(pushed);
    let rest = Expectation::equal(0.0, ideal, "tan α < μ: rest");
    // creep alone would take two boxes that fall side by side for boxes at rest
    let height = slope.normal.dot(&Sample::of(&motion.bodies[0], 2).position);
    let [upper, lower] = HALF.map(|half| half[2]);
    let late = pair::set_down(slope.press, h);
    let lying = Expectation::at_least(upper + 2.0 * lower, upper + late, "it lies on the lower box, which lies on the slope");
    Ok(vec![
        Measurement::new("creep speed of a box on a box", "m/s", measured, rest).predicted(model),
        Measurement::new("height of the upper box", "m", height, lying),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::judge;
    use crate::runner::SWEEP;
    use nalgebra::Vector3;

    #[test]
    fn what_rests_passes_and_what_creeps_by_a_centimetre_a_second_fails() {
        for h in SWEEP {
            for (creep, expected) in [(0.0, Verdict::Pass), (1e-2, Verdict::Fail)] {
                let measured = judge("pair/held", h, |scene, index, _, t| {
                    let body = &scene.bodies[index];
                    let down = Vector3::new(angle().cos(), 0.0, -angle().sin()) * if index == 0 { creep } else { 0.0 };
                    ((Vector3::from(body.position) + down * t).into(), body.orientation, down.into(), [0.0; 3])
                });
                assert_eq!(measured[0].verdict(), expected, "{h}: {measured:?}");
                assert_eq!(measured[1].verdict(), Verdict::Pass, "{h}: {measured:?}");
            }
        }
    }

    #[test]
    fn boxes_that_fall_beside_each_other_fail() {
        for h in SWEEP {
            let measured = judge("pair/held", h, |scene, index, _, t| {
                let body = &scene.bodies[index];
                let gravity = Vector3::from(scene.gravity);
                let place = Vector3::from(body.position) + gravity * (0.5 * t * t);
                (place.into(), body.orientation, (gravity * t).into(), [0.0; 3])
            });
            assert_eq!(measured.iter().map(Measurement::verdict).collect::<Vec<_>>(), [Verdict::Pass, Verdict::Fail], "{h}: {measured:?}");
        }
    }
}
