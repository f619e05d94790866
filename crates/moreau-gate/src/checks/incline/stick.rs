//! Creep where Coulomb sticks, and both sides of tan α = μ.

use crate::checks::incline::scenes::{angle, box_gap, held, slope, slope_box};
use crate::checks::motion::{Sample, Slope, yields};
use crate::checks::scenery::{GRAVITY, between};
use crate::model::addition::Addition;
use crate::model::creep::{HeldBox, creep};
use crate::model::damping::driven;
use crate::model::sliding::hops;
use crate::model::springs::swinging;
use crate::model::{Model, RigidLimits};
use crate::tolerance::flight::damped_velocity;
use crate::tolerance::incline as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_contact::cones::polyhedral;
use moreau_dynamics::scenes::Scene;

/// Half the duration \[s\]: time for a soft contact to settle, and then to be measured; a rigid one has nothing to settle.
pub(in crate::checks) fn half_time(bench: &Bench) -> f64 {
    if yields(bench) { 0.5 } else { 0.125 }
}

/// Distance of μ from tan α, relative.
const MARGIN: f64 = 1.0 / 16.0;

/// So flat that the loads of its corners differ by less than [`MARGIN`], lest some slip alone.
const PLATE: [f64; 3] = [0.2, 0.15, 0.02];

pub(super) fn stick(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    bench.predicts(&[Addition::StaticFriction, Addition::TorsionalFriction]);
    let scene = slope_box("stick", [0.1, 0.1, 0.05], box_gap(bench, h, 0.5, 0.0), 0.5);
    Ok(vec![creep_of(bench, h, &scene, "creep speed")?])
}

pub(super) fn threshold(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    either_side(bench, h, MARGIN, PLATE)
}

/// A plate with μ above and below tan α by a part `margin`, which is more than the part by which the loads of its corners differ.
pub(in crate::checks) fn either_side(bench: &mut Bench, h: f64, margin: f64, plate: [f64; 3]) -> Reply<Vec<Measurement>> {
    bench.predicts(&[Addition::StaticFriction, Addition::TorsionalFriction]);
    let held_by_more = Addition::StaticFriction.declared(bench.description());
    let tangent = angle().tan();
    let [above, below] = [1.0 + margin, 1.0 - margin].map(|factor| factor * tangent);
    let scene = slope_box("stick below", plate, box_gap(bench, h, above, 0.0), above);
    let stuck = creep_of(bench, h, &scene, "creep speed with μ above tan α")?;
    let scene = slope_box("slide above", plate, box_gap(bench, h, below, 0.0), below);
    let slope = slope(&scene)?;
    let steps = (2.0 * half_time(bench) / h).round() as usize;
    let motion = bench.simulate(&scene, h, steps, steps)?;
    let (end, time) = (Sample::of(&motion.bodies[0], 1), steps as f64 * h);
    let mu = scene.material.friction;
    let acceleration = slope.pull - mu * slope.press;
    let measured = (end.velocity.dot(&slope.down) + mu * end.velocity.dot(&slope.normal)) / time;
    let ideal = Expectation::equal(acceleration, tolerance::momentum(slope.press), "g (sin α − μ cos α)");
    let at_rest = (held_by_more * mu > tangent)
        .then(|| Expectation::equal(0.0, tolerance::momentum(slope.press), "tan α is below the declared static friction: rest"));
    let model = at_rest.or_else(|| from_rest(bench, &held(&scene, &slope, h), acceleration, time));
    Ok(vec![stuck, Measurement::new("(v_t + μ v_n)/T with μ below tan α", "m/s^2", measured, ideal).predicted(model)])
}

/// The displacement down the slope over the second half, per time.
pub(in crate::checks) fn creep_of(bench: &mut Bench, h: f64, scene: &Scene, quantity: &str) -> Reply<Measurement> {
    let slope = slope(scene)?;
    let half = (half_time(bench) / h).round() as usize;
    let motion = bench.simulate(scene, h, 2 * half, half)?;
    let [middle, end] = [1, 2].map(|k| Sample::of(&motion.bodies[0], k));
    let time = half as f64 * h;
    let measured = (end.position - middle.position).dot(&slope.down) / time;
    let size = end.position.norm();
    let ideal = tolerance::creep(slope.pull, h, bench.epsilon(), size, time);
    let held = held(scene, &slope, h);
    let law = creep(bench.description(), &held).map(|speed| {
        let geometry = tolerance::creep_geometry(depth(&slope, &held, &end), held.half_extents[2]);
        Expectation::equal(speed, ideal + geometry * speed, "the declared law holds the load at this slip")
    });
    let law = law.or_else(|| swung(&Model::of(bench.description()), &held, time, ideal));
    let model = law.or_else(|| pushed(bench, &held, ideal));
    Ok(Measurement::new(quantity, "m/s", measured, Expectation::equal(0.0, ideal, "tan α < μ: rest")).predicted(model))
}

/// The creep \[m/s\] that springs along the slope make of their swing, by up to twice its amplitude between two samples a time T \[s\]
/// apart: the box starts with them unloaded, and they carry g sin α at ξ = g sin α/ω², ω² = 4 k/m.
fn swung(model: &Model, held: &HeldBox, time: f64, allowed: f64) -> Option<Expectation> {
    let Model::SpringDamper { stiffness, .. } = *model else { return None };
    let response = 4.0 / held.mass;
    let amplitude = swinging(model, held.pull / response, response, time) / (response * stiffness).sqrt();
    let most = 2.0 * amplitude / time;
    Some(between([-most, most], allowed, "the declared springs along the slope swing"))
}

/// The creep \[m/s\] of a box that a rigid engine pushes off the slope by what it takes back of its depth.
fn pushed(bench: &Bench, held: &HeldBox, allowed: f64) -> Option<Expectation> {
    let Model::Coulomb(limits) = Model::of(bench.description()) else { return None };
    let taken = limits.taken_back();
    let most = tolerance::pushed_creep(taken, held.friction * held.press, held.time_step);
    (taken > 0.0).then(|| between([0.0, most], allowed, "the fall of some steps after each declared correction of a depth"))
}

/// The largest depth \[m\] of a corner: the mean depth, and as much again by tilting.
fn depth(slope: &Slope, held: &HeldBox, end: &Sample) -> f64 {
    2.0 * (held.half_extents[2] - slope.height(&end.position)).max(0.0)
}

/// (v_t + μ v_n)/T from rest of a rigid engine that declares damping, v̇ = a − c v, or that it takes back a part of its depth. A push out
/// of the slope is a normal impulse, whose friction may be more than what is left of the slip, and stops it with less: see
/// [`tolerance::pushed_friction`].
fn damped_and_pushed(limits: &RigidLimits, held: &HeldBox, acceleration: f64, time: f64) -> Expectation {
    let (damping, h) = (limits.linear_damping, held.time_step);
    let slowed = driven(damping, acceleration, 0.0, time) / time;
    let error = damped_velocity(damping, GRAVITY, GRAVITY * time, time, h) / time;
    let most = tolerance::pushed_friction(held.friction, limits.error_reduction, held.press, h) / time;
    let allowed = 0.5 * most + error + tolerance::momentum(held.press);
    Expectation::equal(slowed + 0.5 * most, allowed, "g (sin α − μ cos α) under the declared damping and error reduction")
}

/// (v_t + μ v_n)/T from rest under a law whose friction saturates late, or is weaker along some directions; `None` for Coulomb's.
fn from_rest(bench: &Bench, held: &HeldBox, acceleration: f64, time: f64) -> Option<Expectation> {
    let full = held.friction * held.press;
    if hops(bench.description()) {
        let why = "friction up to μ p_n: a landing from a hop may stop the slip with less";
        return Some(Expectation::at_least(acceleration, tolerance::momentum(held.press), why));
    }
    let most = match Model::of(bench.description()) {
        Model::Coulomb(limits) if limits.linear_damping + limits.error_reduction > 0.0 => {
            return Some(damped_and_pushed(&limits, held, acceleration, time));
        }
        Model::StewartTrinkle { directions } => full * polyhedral::strength_error(directions),
        Model::DrakeRegularised { stiction_tolerance, .. } => {
            // A lagged law takes friction from the previous step's normal force: one step's is missing.
            full * held.time_step / time + tolerance::unsaturated(full, stiction_tolerance, acceleration, time)
        }
        // Four corners with a spring along the slope, as stiff as that across it.
        Model::SpringDamper { stiffness, .. } => tolerance::loading(held.pull, 4.0 * stiffness / held.mass, time),
        _ => return None,
    };
    let allowed = 0.5 * most + tolerance::momentum(held.press);
    Some(Expectation::equal(acceleration + 0.5 * most, allowed, "friction saturates at most this much too late or is this much weaker"))
}
