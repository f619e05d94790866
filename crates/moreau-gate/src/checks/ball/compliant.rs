//! The first impact of a ball without restitution: nothing for a rigid law, a rebound for a compliant one.

use crate::checks::ball::bounce::Samples;
use crate::checks::ball::scene::{RADIUS, dropped};
use crate::checks::scenery::{GRAVITY, schedule};
use crate::model::Model;
use crate::model::normal::Normal;
use crate::tolerance::ball as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};

/// Height of the drop \[m\]; no fraction of it is a whole number of steps' falls.
const HEIGHT: f64 = 1.0;

/// Samples until a while after the impact, and the declared law's replay of them.
fn impact(bench: &mut Bench, h: f64) -> Reply<(Samples, Option<Samples>)> {
    let duration = (2.0 * HEIGHT / GRAVITY).sqrt() + tolerance::LONGEST_CONTACT;
    let (steps, every) = schedule(duration, (duration / tolerance::SETTLING_SAMPLE).ceil() as usize, h);
    let scene = dropped(HEIGHT, 0.0);
    let samples = Samples::of(&bench.simulate(&scene, h, steps, every)?, every as f64 * h);
    let ball = Normal::spheres(&[(scene.bodies[0].mass, RADIUS)], GRAVITY, 0.0, bench.description().friction, h);
    let replayed = ball.replay(&Model::of(bench.description()), HEIGHT, 0.0, steps);
    let thinned = replayed.map(|states| Samples { states: states.into_iter().step_by(every).collect(), spacing: every as f64 * h });
    Ok((samples, thinned))
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
    let model = replayed.map(|states| Expectation::equal(rebound(&states), error, "replay of the declared law's discrete map"));
    Ok(vec![Measurement::new("rebound speed over impact speed", "1", rebound(&samples), ideal).predicted(model)])
}

/// `ball/penetration` of a compliant engine.
pub(super) fn greatest_depth(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let (samples, replayed) = impact(bench, h)?;
    let ideal = Expectation::at_most(0.0, tolerance::depth(speed(), GRAVITY, h), "3/2 (v + g h) h");
    let error = tolerance::replay(samples.states.len(), bench.epsilon()) * speed() * tolerance::LONGEST_CONTACT;
    let model = replayed.map(|states| Expectation::equal(deepest(&states), error, "replay of the declared law's discrete map"));
    Ok(vec![Measurement::new("greatest depth", "m", deepest(&samples), ideal).predicted(model)])
}
