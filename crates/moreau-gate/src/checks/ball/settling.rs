//! When and where the ball comes to rest, and how deep it gets.

use crate::checks::ball::bounce::{HEIGHT, Samples};
use crate::checks::ball::compliant;
use crate::checks::ball::scene::dropped;
use crate::checks::scenery::{GRAVITY, between, schedule};
use crate::model::Model;
use crate::model::compression::LoadedPoint;
use crate::tolerance::ball as tolerance;
use crate::{Bench, Expectation, Kind, Measurement, Refusal, Reply};
use moreau_forms::BouncingBall;

const RESTITUTION: f64 = 0.5;

/// The motion until it must have come to rest.
fn settle(bench: &mut Bench, restitution: f64, h: f64) -> Reply<Samples> {
    let (ball, bounds) = expected(h)?;
    let duration = ball.accumulation_time() + bounds[1] + 10.0 * h;
    let (steps, every) = schedule(duration, (duration / tolerance::SETTLING_SAMPLE).ceil() as usize, h);
    let trajectory = bench.simulate(&dropped(HEIGHT, restitution), h, steps, every)?;
    Ok(Samples::of(&trajectory, every as f64 * h))
}

/// The exact ball, and by how much it may be early and late \[s\].
fn expected(h: f64) -> Reply<(BouncingBall, [f64; 2])> {
    let ball = BouncingBall::new(GRAVITY, HEIGHT, RESTITUTION).map_err(Refusal::errored)?;
    let bounds = tolerance::absorption(RESTITUTION, ball.impact_speed(1) / (GRAVITY * h));
    Ok((ball, bounds.map(|steps| steps * h)))
}

/// `ball/zeno`.
pub(super) fn zeno(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    bench.without_damping()?;
    let samples = settle(bench, RESTITUTION, h)?;
    let (ball, [early, late]) = expected(h)?;
    let slow = tolerance::settled_speed(GRAVITY, h);
    // Not `v > slow`: a NaN is not at rest.
    let resting = samples.states.iter().rev().take_while(|(_, v)| v.abs() <= slow).count();
    let found = (samples.states.len() - resting) as f64 * samples.spacing;
    let exact = ball.accumulation_time();
    // Where every step is a sample, the ball shows how often it bounced.
    let every_step = samples.spacing <= h * (1.0 + f64::EPSILON);
    let seen = every_step.then(|| tolerance::late_after(RESTITUTION, samples.impacts().len()) * h);
    let late = seen.map_or(late, |seen| seen.min(late));
    let [early, late] = [early + samples.spacing, late + samples.spacing];
    let words = "T∞, with the bounds of absorption proved for event capturing and the bounces that were seen";
    // The middle of the interval with half its width: late and early differ.
    let interval = |early: f64| Expectation::equal(exact + 0.5 * (late - early), 0.5 * (late + early), words);
    let model = match Model::of(bench.description()) {
        Model::Coulomb(limits) if limits.slowest_bounce(RESTITUTION) > 0.0 => {
            // What is left of the flights once impacts are slower than the threshold v*: 2 e v*/(g (1 − e)).
            let left = 2.0 * RESTITUTION * limits.slowest_bounce(RESTITUTION) / (GRAVITY * (1.0 - RESTITUTION));
            Some(Expectation { why: "the declared restitution threshold ends the bounces".into(), ..interval(early + left) })
        }
        Model::Coulomb(limits) if limits.error_reduction > 0.0 => {
            // Each impact returns at most e and the declared part: T∞ with that, or never.
            let returned = RESTITUTION + limits.error_reduction;
            let why = "a declared part of a depth of up to v h is taken back at every impact";
            let longest = ball.first_impact_time() * (1.0 + returned) / (1.0 - returned);
            Some(if returned < 1.0 { between([exact - early, longest + late], 0.0, why) } else { Expectation::at_least(exact, early, why) })
        }
        _ => None,
    };
    Ok(vec![Measurement::new("time until the ball rests", "s", found, interval(early)).predicted(model)])
}

/// Why a ball of an engine without restitution may rest in depth.
const STAYS: &str = "without restitution it stays where its impact was found";

/// `ball/penetration`.
pub(super) fn penetration(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    if bench.description().contact_model.kind == Kind::Compliant {
        return compliant::greatest_depth(bench, h);
    }
    let restitution = if bench.description().restitution { RESTITUTION } else { 0.0 };
    let samples = settle(bench, restitution, h)?;
    let (ball, _) = expected(h)?;
    let deepest = samples.states.iter().fold(0.0f64, |most, (gap, _)| if gap.is_nan() { f64::NAN } else { most.max(-gap) });
    let place = samples.states[samples.states.len() - 1].0;
    let size = HEIGHT;
    let late = tolerance::depth(ball.impact_speed(1), GRAVITY, h) + tolerance::place(samples.states.len(), size, bench.epsilon());
    let near = tolerance::resting_gap(GRAVITY, h) + tolerance::place(samples.states.len(), size, bench.epsilon());
    let landed = if bench.description().restitution { 0.0 } else { tolerance::depth(ball.impact_speed(1), GRAVITY, h) };
    let [depth, gap] = match Model::of(bench.description()) {
        Model::Coulomb(limits) => {
            let mass = dropped(HEIGHT, 0.0).bodies[0].mass;
            let point = LoadedPoint { load: mass * GRAVITY, inverse_mass: 1.0 / mass, on_ground: true };
            let (low, high) = (-limits.penetration_allowance - limits.compression(&point), limits.contact_margin);
            // A spring may still be on its way: anywhere between.
            let why = "the declared allowance, spring, margin or threshold";
            // A last impact below the threshold ends where it is found, however deep or early, and nothing moves the ball from there.
            let last = limits.slowest_bounce(restitution);
            let found = if last > 0.0 { tolerance::depth(last, GRAVITY, h) } else { 0.0 };
            let deep = found.max(landed);
            let place = between([low - deep, high + found], near, if low < high || found > 0.0 { why } else { STAYS });
            [(low < high).then(|| Expectation::at_most(-low, late, why)), (low < high || deep > 0.0).then_some(place)]
        }
        _ => [None, (landed > 0.0).then(|| between([-landed, 0.0], near, STAYS))],
    };
    let mut measured =
        vec![Measurement::new("greatest depth", "m", deepest, Expectation::at_most(0.0, late, "3/2 (v + g h) h")).predicted(depth)];
    // A ball that comes back with more than e need not be at rest by then: ball/zeno says when.
    if !matches!(Model::of(bench.description()), Model::Coulomb(limits) if limits.error_reduction > 0.0) {
        measured.push(Measurement::new("gap at rest", "m", place, Expectation::equal(0.0, near, "3 g h²")).predicted(gap));
    }
    Ok(measured)
}
