//! Where thrown boxes come to rest.

use crate::checks::motion::opens_within;
use crate::checks::scenery::{GRAVITY, worst};
use crate::checks::tumbling::depth;
use crate::checks::tumbling::motion::Tumble;
use crate::checks::tumbling::scenes::{FRICTION, Throw, Thrown};
use crate::model::Model;
use crate::tolerance::rest::pushed_velocity;
use crate::tolerance::tumbling as tolerance;
use crate::{Bench, Expectation, Measurement, Refusal, Reply};

/// Duration of the motion \[s\].
const DURATION: f64 = 2.5;
/// The last part of it \[s\], in which they lie.
const LYING: f64 = 0.25;

const THROWS: [Throw; 3] = [
    Throw { thrown: Thrown::Cube, seed: 15, restitution: 0.0 },
    Throw { thrown: Thrown::Box, seed: 16, restitution: 0.0 },
    Throw { thrown: Thrown::Pair, seed: 17, restitution: 0.0 },
];

/// `tumbling/rest`.
pub(super) fn rest(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    if matches!(Model::of(bench.description()), Model::SpringDamper { damping: 0.0, .. }) {
        return Err(Refusal::unsupported("the engine declares springs without a damper, on which nothing comes to rest"));
    }
    let mut measurements = Vec::new();
    for throw in &THROWS {
        let tumble = Tumble::of(bench, throw, FRICTION, h, DURATION)?;
        let last = tumble.states.len() - 1;
        let from = last - ((LYING / h).round() as usize).clamp(1, last);
        let square = |k: usize| tumble.each(k).map(|(body, state)| body.fastest(state).powi(2)).fold(0.0, worst);
        let speed = ((from..=last).map(square).sum::<f64>() / (last - from + 1) as f64).sqrt();
        let still = Expectation::at_most(0.0, tolerance::settled_speed(GRAVITY, h), "what lies is slower than a step of gravity");
        let levels = tumble.each(last).count() as f64;
        let pushed = opens_within(bench, last - from).map(|_| {
            let why = "contacts whose depth is taken back open, fall and are pushed out again, level by level";
            Expectation::at_most(levels * pushed_velocity(GRAVITY, h), still.tolerance, why)
        });
        let quantity = format!("RMS speed of the fastest corner at the end: {}", throw.words());
        measurements.push(Measurement::new(quantity, "m/s", speed, still).predicted(pushed));
        let hover = tumble.placed(last).iter().map(crate::checks::tumbling::overlap::Placed::lowest).fold(f64::INFINITY, f64::min);
        let near = tolerance::hover(GRAVITY, h) + tolerance::place(last, bench.epsilon());
        let on = Expectation::at_most(0.0, near, "a body lies on the floor");
        measurements.push(Measurement::new(format!("gap under the lowest corner at the end: {}", throw.words()), "m", hover, on));
        let inside = Expectation::at_most(0.0, depth::allowed(&tumble, bench.epsilon()), "no body is in another, nor in the floor");
        let declared = depth::lying(bench, &tumble);
        let sprung = declared.map(|depth| Expectation::at_most(depth, inside.tolerance, "the declared spring carries it there"));
        measurements
            .push(Measurement::new(format!("depth at the end: {}", throw.words()), "m", tumble.depth(last), inside).predicted(sprung));
    }
    Ok(measurements)
}
