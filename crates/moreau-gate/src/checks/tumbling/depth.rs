//! How deep thrown boxes get, with restitution and friction: Newton's e with friction has no energy theorem, but bodies stay outside each
//! other.

use crate::checks::scenery::{GRAVITY, worst};
use crate::checks::tumbling::motion::Tumble;
use crate::checks::tumbling::scenes::{FRICTION, Throw, Thrown};
use crate::model::compression::LoadedPoint;
use crate::model::normal::Normal;
use crate::model::{Model, RigidLimits};
use crate::tolerance::tumbling as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};

/// Duration of the motion \[s\].
const DURATION: f64 = 0.8;

/// `tumbling/depth`.
pub(super) fn depth(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let restitution = |e: f64| if bench.description().restitution { e } else { 0.0 };
    let throws = [(Thrown::Box, 9, 0.2), (Thrown::Pair, 10, 0.2), (Thrown::Heavy, 11, 0.5)].map(|(thrown, seed, e)| Throw {
        thrown,
        seed,
        restitution: restitution(e),
    });
    throws.iter().map(|throw| deepest(bench, throw, h)).collect()
}

fn deepest(bench: &mut Bench, throw: &Throw, h: f64) -> Reply<Measurement> {
    let tumble = Tumble::of(bench, throw, FRICTION, h, DURATION)?;
    let found = (0..tumble.states.len()).map(|k| tumble.depth(k)).fold(0.0, worst);
    let ideal = Expectation::at_most(0.0, allowed(&tumble, bench.epsilon()), "3/2 h (u + g h) at the fastest arrival");
    let model = declared(bench, &tumble, h).map(|depth| Expectation::at_most(depth, ideal.tolerance, "the declared law stops it there"));
    Ok(Measurement::new(format!("greatest depth: {}", throw.words()), "m", found, ideal).predicted(model))
}

/// What the fastest arrival allows \[m\].
pub(super) fn allowed(tumble: &Tumble, epsilon: f64) -> f64 {
    let arriving = (1..tumble.states.len()).filter(|k| tumble.depth(*k) > 0.0).map(|k| arrival(tumble, k - 1)).fold(0.0, worst);
    tolerance::depth(arriving, GRAVITY, tumble.h) + tolerance::place(tumble.states.len(), epsilon)
}

/// The fastest corner relative to the floor or to the other body \[m/s\] after k steps.
fn arrival(tumble: &Tumble, k: usize) -> f64 {
    let placed = tumble.placed(k);
    let mut fastest: f64 = 0.0;
    for (index, body) in placed.iter().enumerate() {
        for corner in body.corners() {
            let velocity = body.state.velocity_at(corner);
            fastest = worst(-velocity.z, fastest);
            if let Some(other) = placed.get(1 - index.min(1)).filter(|_| placed.len() == 2) {
                let lever = body.state.position + corner - other.state.position;
                fastest = worst((velocity - other.state.velocity_at(lever)).norm(), fastest);
            }
        }
    }
    fastest
}

/// The depth \[m\] at which the declared law stops a body that puts the whole energy of the motion into one contact, if the law gives it.
/// More contacts or a lighter corner stop the body sooner.
fn declared(bench: &Bench, tumble: &Tumble, h: f64) -> Option<f64> {
    let model = Model::of(bench.description());
    let (lightest, total) = weights(tumble);
    let speed = (2.0 * tumble.energy(0) / lightest).sqrt();
    if let Model::Coulomb(limits) = model {
        // f from g/(2πf)²: a spring of this frequency stops v within v/(2πf), besides its depth at rest.
        let stopping = |on_ground: bool| speed * (static_depth(&limits, on_ground) / GRAVITY).sqrt();
        let depth = carried(&limits, tumble) + stopping(true).max(stopping(false));
        return (depth > 0.0).then_some(depth);
    }
    let steps = (crate::tolerance::ball::LONGEST_CONTACT / h).ceil() as usize;
    let heaviest = Normal::spheres(&[(total, tumble.bodies[0].radius())], GRAVITY, FRICTION, bench.description().friction, h);
    let replays = heaviest.replays(&model, 0.0, -speed, steps)?;
    Some(replays.iter().flatten().map(|(gap, _)| -gap).fold(0.0, worst))
}

/// The depth \[m\] at which a declared spring carries the lying bodies, if a spring is declared.
pub(super) fn lying(bench: &Bench, tumble: &Tumble) -> Option<f64> {
    match Model::of(bench.description()) {
        Model::Coulomb(limits) => Some(carried(&limits, tumble)).filter(|depth| *depth > 0.0),
        _ => None,
    }
}

/// Depth \[m\] of a lying body by the declared allowance and twice its springs' depth under all the weight: a corner carries no more.
fn carried(limits: &RigidLimits, tumble: &Tumble) -> f64 {
    let (lightest, total) = weights(tumble);
    limits.penetration_allowance + 2.0 * static_depth(limits, true).max(static_depth(limits, false)) * total / lightest
}

/// Whether a spring is declared.
pub(super) fn is_sprung(limits: &RigidLimits) -> bool {
    static_depth(limits, true).max(static_depth(limits, false)) > 0.0
}

/// g/(2πf)² \[m\], 0 without a spring.
fn static_depth(limits: &RigidLimits, on_ground: bool) -> f64 {
    limits.compression(&LoadedPoint { load: GRAVITY, inverse_mass: 1.0, on_ground })
}

/// The lightest body's mass and that of all \[kg\].
fn weights(tumble: &Tumble) -> (f64, f64) {
    tumble.bodies.iter().fold((f64::INFINITY, 0.0), |(least, sum), body| (body.mass.min(least), sum + body.mass))
}
