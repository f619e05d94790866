//! Whether sliding lifts a sphere off: the hop of a sudden slip, and the gap of a steady slide.

use crate::checks::incline::scenes::{RADIUS, slope, slope_sphere};
use crate::checks::motion::{CLEARANCE, Slope, samples, yields};
use crate::checks::scenery::worst;
use crate::model::Model;
use crate::model::compression::LoadedPoint;
use crate::model::normal::Normal;
use crate::model::sliding::{hops, replayed};
use crate::tolerance::incline as tolerance;
use crate::tolerance::rest::drift;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_forms::sliding_contact::{SlidingContact, SlidingState};

pub(super) fn hop(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let (speed, duration) = (2.0, 0.1);
    let mut scene = slope_sphere("hop", 0.0, 0.3);
    scene.bodies[0].linear_velocity = [speed, 0.0, 0.0];
    measure(bench, h, &scene, duration, speed, ("highest gap", |gaps| gaps.iter().copied().fold(f64::NEG_INFINITY, worst)))
}

pub(super) fn gap(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let scene = slope_sphere("gap", 40f64.to_radians(), 0.2);
    measure(bench, h, &scene, 0.5, 0.0, ("gap at the end", |gaps| gaps.last().copied().unwrap_or(f64::NAN)))
}

/// What is read from the gaps of all steps.
type Pick = fn(&[f64]) -> f64;

/// How far the sphere is lifted, by what is picked, and how deep it falls.
fn measure(bench: &mut Bench, h: f64, scene: &Scene, duration: f64, slip: f64, (quantity, pick): (&str, Pick)) -> Reply<Vec<Measurement>> {
    let slope = slope(scene)?;
    let steps = (duration / h).round() as usize;
    let motion = bench.simulate(scene, h, steps, 1)?;
    let gaps: Vec<f64> = samples(&motion.bodies[0]).iter().map(|sample| slope.height(&sample.position) - RADIUS).collect();
    let start = SlidingState { gap: CLEARANCE, normal_velocity: 0.0, velocity: slip, surface: 0.0 };
    let one = |quantity: &str, pick: Pick, ideal: Expectation| {
        let replay = contact(bench, scene, &slope, h).map(|contact| predicted(&contact, start, steps, slip, pick));
        let model = replay.or_else(|| bounds(bench, scene, &slope, h, slip + slope.pull * duration));
        Measurement::new(quantity, "m", pick(&gaps), ideal).predicted(model)
    };
    let above = Expectation::at_most(0.0, CLEARANCE + risen(&gaps, &slope, h, bench.epsilon()), "friction does not lift");
    let below = Expectation::at_least(0.0, CLEARANCE + depth(&slope, h), "the floor carries");
    let lowest: Pick = |gaps| -gaps.iter().map(|gap| -gap).fold(f64::NEG_INFINITY, worst);
    Ok(vec![one(quantity, pick, above), one("lowest gap", lowest, below)])
}

/// Depth \[m\] at which a sound step may find the contact.
fn depth(slope: &Slope, h: f64) -> f64 {
    tolerance::found(slope.press, h)
}

/// How high \[m\] the sphere may rise by being pushed out of the depth that it was seen to reach; no depth, no rise.
fn risen(gaps: &[f64], slope: &Slope, h: f64, epsilon: f64) -> f64 {
    let seen = gaps.iter().map(|gap| -gap).fold(0.0, worst).min(depth(slope, h));
    tolerance::risen(seen, slope.press, h) + drift(gaps.len(), RADIUS, slope.press, h, epsilon)
}

/// The value of the replayed motion; its allowance grows as two replays from neighbouring starts do.
fn predicted(contact: &SlidingContact, start: SlidingState, steps: usize, speed: f64, pick: Pick) -> Expectation {
    let value = |start: SlidingState| {
        let gaps: Vec<f64> = contact.motion(start, steps).iter().map(|state| state.gap).collect();
        pick(&gaps)
    };
    let time = steps as f64 * contact.time_step;
    let near = tolerance::neighbouring();
    let offset = near * (speed + contact.press * time);
    let beside = [1.0, -1.0].map(|sign| value(SlidingState { velocity: start.velocity + sign * offset, ..start }));
    let here = value(start);
    let amplification = beside.iter().map(|other| (other - here).abs() / (offset * time)).fold(0.0, f64::max);
    let change = 2.0 * (speed + contact.press * time);
    Expectation::equal(here, tolerance::replay(change, time, amplification), "the declared law, replayed step by step")
}

/// The sphere's contact under the declared law, where that is convex.
fn contact(bench: &Bench, scene: &Scene, slope: &Slope, h: f64) -> Option<SlidingContact> {
    let ball = &scene.bodies[0];
    replayed(bench.description(), h, [ball.mass, RADIUS], scene.material.friction, [slope.press, slope.pull])
}

/// Where the sphere may be under laws that are not replayed: between twice its rest depth (an undamped spring) and its surface, up to the
/// top of a hop at μ times the largest slip, or between a rigid engine's penetration allowance and contact margin.
fn bounds(bench: &Bench, scene: &Scene, slope: &Slope, h: f64, speed: f64) -> Option<Expectation> {
    let (description, model) = (bench.description(), Model::of(bench.description()));
    let friction = scene.material.friction;
    let normal = Normal::spheres(&[(scene.bodies[0].mass, RADIUS)], slope.press, friction, description.friction, h);
    let ball = &scene.bodies[0];
    let (low, high) = match &model {
        Model::Coulomb(limits) if yields(bench) || limits.contact_margin > 0.0 => {
            let point = LoadedPoint { load: ball.mass * slope.press, inverse_mass: 1.0 / ball.mass, on_ground: true };
            (-limits.penetration_allowance - 2.0 * limits.compression(&point), limits.contact_margin)
        }
        Model::Coulomb(_) => return None,
        _ => (-2.0 * normal.rest_depth(&model, scene.bodies[0].mass * slope.press)?, 0.0),
    };
    // a hop leaves the floor at μ times the slip, and is found where it falls in at that speed a step later
    let hop = friction * speed;
    let (low, high) = if hops(description) { (low - hop * h, hop * hop / (2.0 * slope.press) + hop * h) } else { (low, high) };
    let allowed = 0.5 * (high - low) + CLEARANCE + depth(slope, h);
    Some(Expectation::equal(0.5 * (low + high), allowed, "between the declared depth and the top of a hop at μ‖u_t‖"))
}
