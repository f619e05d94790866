//! The first impact of a ball without restitution: nothing for a rigid law, a rebound for a compliant one.

use crate::checks::ball::bounce::{Samples, pushed};
use crate::checks::ball::scene::{RADIUS, dropped};
use crate::checks::scenery::{GRAVITY, between, schedule};
use crate::model::Model;
use crate::model::normal::Normal;
use crate::tolerance::ball as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};

/// Height of the drop \[m\]; no fraction of it is a whole number of steps' falls.
const HEIGHT: f64 = 1.0;

/// Samples until a while after the impact, and the declared law's replays of them.
fn impact(bench: &mut Bench, h: f64) -> Reply<(Samples, Option<Vec<Samples>>)> {
    let duration = (2.0 * HEIGHT / GRAVITY).sqrt() + tolerance::LONGEST_CONTACT;
    let (steps, every) = schedule(duration, (duration / tolerance::SETTLING_SAMPLE).ceil() as usize, h);
    let scene = dropped(HEIGHT, 0.0);
    let samples = Samples::of(&bench.simulate(&scene, h, steps, every)?, every as f64 * h);
    let ball = Normal::spheres(&[(scene.bodies[0].mass, RADIUS)], GRAVITY, 0.0, bench.description().friction, h);
    let replayed = ball.replays(&Model::of(bench.description()), HEIGHT, 0.0, steps);
    let thinned = |states: Vec<(f64, f64)>| Samples { states: states.into_iter().step_by(every).collect(), spacing: every as f64 * h };
    Ok((samples, replayed.map(|all| all.into_iter().map(thinned).collect())))
}

/// Greatest upward speed after the greatest downward one, over it.
fn rebound(samples: &Samples) -> f64 {
    let fastest = (0..samples.states.len()).min_by(|i, j| samples.states[*i].1.total_cmp(&samples.states[*j].1)).unwrap_or(0);
    let upward = samples.states[fastest..].iter().fold(0.0f64, |most, (_, v)| if v.is_nan() { f64::NAN } else { most.max(*v) });
    upward / -samples.states[fastest].1
}

fn deepest(samples: &Samples) -> f64 {
    samples.states.iter().fold(0.0f64, |most, (gap, _)| if gap.is_nan() { f64::NAN } else { most.max(-gap) })
}

fn speed() -> f64 {
    (2.0 * GRAVITY * HEIGHT).sqrt()
}

/// `ball/effective-restitution`.
pub(super) fn effective_restitution(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let (samples, replayed) = impact(bench, h)?;
    let allowed = tolerance::plastic(speed(), GRAVITY, h, samples.spacing);
    let ideal = Expectation::equal(0.0, allowed, "e = 0, up to the gravity of the steps around the impact");
    let error = tolerance::replay(samples.states.len(), bench.epsilon());
    let replay = replayed.map(|all| between(all.iter().map(rebound), error, "replay of the declared law's discrete map"));
    // a depth of at most v h, of which the declared part is taken back by a velocity that the ball keeps
    let push = || pushed(bench, h, speed()).map(|push| between([0.0, push], allowed, "the declared error reduction"));
    let model = replay.or_else(push);
    Ok(vec![Measurement::new("rebound speed over impact speed", "1", rebound(&samples), ideal).predicted(model)])
}

/// `ball/penetration` of a compliant engine.
pub(super) fn greatest_depth(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let (samples, replayed) = impact(bench, h)?;
    let ideal = Expectation::at_most(0.0, tolerance::depth(speed(), GRAVITY, h), "3/2 (v + g h) h");
    let error = tolerance::replay(samples.states.len(), bench.epsilon()) * speed() * tolerance::LONGEST_CONTACT;
    let model = replayed.map(|all| between(all.iter().map(deepest), error, "replay of the declared law's discrete map"));
    Ok(vec![Measurement::new("greatest depth", "m", deepest(&samples), ideal).predicted(model)])
}
