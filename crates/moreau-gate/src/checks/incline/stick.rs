//! Creep where Coulomb sticks, and both sides of tan α = μ.

use crate::checks::incline::scenes::{angle, box_gap, held, slope, slope_box};
use crate::checks::motion::{Sample, Slope, yields};
use crate::model::Model;
use crate::model::creep::{HeldBox, creep};
use crate::model::sliding::hops;
use crate::tolerance::incline as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_contact::cones::polyhedral;
use moreau_dynamics::scenes::Scene;

/// Half the duration \[s\]: time for a soft contact to settle, and then to be measured; a rigid one has nothing to settle.
fn half_time(bench: &Bench) -> f64 {
    if yields(bench) { 0.5 } else { 0.125 }
}

/// Distance of μ from tan α, relative.
const MARGIN: f64 = 1.0 / 16.0;

/// So flat that the loads of its corners differ by less than [`MARGIN`], lest some slip alone.
const PLATE: [f64; 3] = [0.2, 0.15, 0.02];

pub(super) fn stick(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let scene = slope_box("stick", [0.1, 0.1, 0.05], box_gap(bench, h, 0.5, 0.0), 0.5);
    Ok(vec![creep_of(bench, h, &scene, "creep speed")?])
}

pub(super) fn threshold(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let tangent = angle().tan();
    let [above, below] = [1.0 + MARGIN, 1.0 - MARGIN].map(|factor| factor * tangent);
    let scene = slope_box("stick below", PLATE, box_gap(bench, h, above, 0.0), above);
    let stuck = creep_of(bench, h, &scene, "creep speed with μ above tan α")?;
    let scene = slope_box("slide above", PLATE, box_gap(bench, h, below, 0.0), below);
    let slope = slope(&scene)?;
    let steps = (2.0 * half_time(bench) / h).round() as usize;
    let motion = bench.simulate(&scene, h, steps, steps)?;
    let (end, time) = (Sample::of(&motion.bodies[0], 1), steps as f64 * h);
    let mu = scene.material.friction;
    let acceleration = slope.pull - mu * slope.press;
    let measured = (end.velocity.dot(&slope.down) + mu * end.velocity.dot(&slope.normal)) / time;
    let ideal = Expectation::equal(acceleration, tolerance::momentum(slope.press), "g (sin α − μ cos α)");
    let model = from_rest(bench, &held(&scene, &slope, h), acceleration, time);
    Ok(vec![stuck, Measurement::new("(v_t + μ v_n)/T with μ below tan α", "m/s^2", measured, ideal).predicted(model)])
}

/// The displacement down the slope over the second half, per time.
fn creep_of(bench: &mut Bench, h: f64, scene: &Scene, quantity: &str) -> Reply<Measurement> {
    let slope = slope(scene)?;
    let half = (half_time(bench) / h).round() as usize;
    let motion = bench.simulate(scene, h, 2 * half, half)?;
    let [middle, end] = [1, 2].map(|k| Sample::of(&motion.bodies[0], k));
    let time = half as f64 * h;
    let measured = (end.position - middle.position).dot(&slope.down) / time;
    let size = end.position.norm();
    let ideal = tolerance::creep(slope.pull, h, bench.epsilon(), size, time);
    let held = held(scene, &slope, h);
    let model = creep(bench.description(), &held).map(|speed| {
        let geometry = tolerance::creep_geometry(depth(&slope, &held, &end), held.half_extents[2]);
        Expectation::equal(speed, ideal + geometry * speed, "the declared law holds the load at this slip")
    });
    Ok(Measurement::new(quantity, "m/s", measured, Expectation::equal(0.0, ideal, "tan α < μ: rest")).predicted(model))
}

/// The largest depth \[m\] of a corner: the mean depth, and as much again by tilting.
fn depth(slope: &Slope, held: &HeldBox, end: &Sample) -> f64 {
    2.0 * (held.half_extents[2] - slope.height(&end.position)).max(0.0)
}

/// (v_t + μ v_n)/T from rest under a law whose friction saturates late, or is weaker along some directions; `None` for Coulomb's.
fn from_rest(bench: &Bench, held: &HeldBox, acceleration: f64, time: f64) -> Option<Expectation> {
    let full = held.friction * held.press;
    if hops(bench.description()) {
        let why = "friction up to μ p_n: a landing from a hop may stop the slip with less";
        return Some(Expectation::at_least(acceleration, tolerance::momentum(held.press), why));
    }
    let most = match Model::of(bench.description()) {
        Model::StewartTrinkle { directions } => full * polyhedral::strength_error(directions),
        Model::DrakeRegularised { stiction_tolerance, .. } => {
            // A lagged law takes friction from the previous step's normal force: one step's is missing.
            full * held.time_step / time + tolerance::unsaturated(full, stiction_tolerance, acceleration, time)
        }
        _ => return None,
    };
    let allowed = 0.5 * most + tolerance::momentum(held.press);
    Some(Expectation::equal(acceleration + 0.5 * most, allowed, "friction saturates at most this much too late or is this much weaker"))
}
