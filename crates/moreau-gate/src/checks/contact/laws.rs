//! Cone, complementarity, maximal dissipation and work.

use crate::checks::contact::feet::Feet;
use crate::checks::contact::thrown::{ALONG, DOWN, FRICTION, RADIUS, RESPONSE, Thrown, motion, thrown_sphere};
use crate::checks::scenery::{GRAVITY, cuboid, over_floor, worst};
use crate::description::Friction;
use crate::model::regularised::{Foot, Regularised};
use crate::model::{Model, convex};
use crate::tolerance::contact as tolerance;
use crate::{Bench, Expectation, Kind, Measurement, Reply};
use moreau_contact::cones::polyhedral;
use nalgebra::{Vector2, Vector3};

/// Half extents of the tumbling box \[m\].
const HALF_EXTENTS: [f64; 3] = [0.1, 0.08, 0.06];

pub(super) fn cone(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let mut block = cuboid("block", 1.0, HALF_EXTENTS, [0.0, 0.0, 0.16]);
    block.orientation = [0.8, 0.36, 0.48, 0.0];
    block.linear_velocity = [1.5, 1.0, -1.0];
    block.angular_velocity = [2.0, -3.0, 1.0];
    let tumbling = motion(bench, &over_floor("tumbling box", vec![block], FRICTION), h, 0.2)?;
    let sphere = thrown_sphere(bench, h)?;
    let mut measurements = Vec::new();
    let feet = [Feet::of_sphere(sphere.mass, RADIUS), Feet::of_box(bench, tumbling.mass, HALF_EXTENTS)];
    for ((shape, thrown), feet) in [("sphere", &sphere), ("box", &tumbling)].into_iter().zip(feet) {
        let (mut outside, mut pulling, mut tilted) = (0.0, 0.0, 0.0);
        for record in thrown.records.iter().flatten() {
            let impulse = Vector3::from(record.impulse);
            outside = worst((impulse.xy().norm() - FRICTION * impulse.z) / thrown.largest, outside);
            pulling = worst(-impulse.z / thrown.largest, pulling);
            tilted = worst((Vector3::from(record.normal) - Vector3::z()).norm(), tilted);
        }
        let solved = tolerance::impulse();
        measurements.extend([
            Measurement::new(
                format!("impulse outside the cone over the largest normal impulse ({shape})"),
                "1",
                outside,
                Expectation::at_most(0.0, solved, "‖p_t‖ ≤ μ p_n"),
            )
            .predicted(wider_cone(bench, thrown, &feet, h)),
            Measurement::new(
                format!("pulling impulse over the largest normal impulse ({shape})"),
                "1",
                pulling,
                Expectation::at_most(0.0, solved, "p_n ≥ 0"),
            ),
            Measurement::new(
                format!("reported normal beside the floor's ({shape})"),
                "1",
                tilted,
                Expectation::at_most(0.0, bench.epsilon().sqrt(), "n = z"),
            ),
        ]);
    }
    Ok(measurements)
}

/// How far a declared law may leave the cone.
fn wider_cone(bench: &Bench, thrown: &Thrown, feet: &Feet, h: f64) -> Option<Expectation> {
    let solved = tolerance::impulse();
    match Model::of(bench.description()) {
        Model::DrakeRegularised { .. } => {
            let law = Regularised::of(bench.description(), FRICTION, h).filter(|law| law.lagged)?;
            let value = lagged_outside(&law, thrown, feet);
            Some(Expectation::equal(value, solved, "lagged friction: the explicit normal force of the state before the step"))
        }
        Model::Mujoco(_) | Model::StewartTrinkle { .. } => None,
        _ if bench.description().friction == Friction::Pyramid => {
            Some(Expectation::at_most((2f64.sqrt() - 1.0) * FRICTION, solved, "a pyramid around the cone"))
        }
        _ => None,
    }
}

/// The largest ‖p_t‖ − μ p_n over the largest p_n, with the friction of the lagged law at the measured states.
fn lagged_outside(law: &Regularised, thrown: &Thrown, feet: &Feet) -> f64 {
    let outside = |k: usize| {
        let touching = feet.between(&thrown.states[k - 1], &thrown.states[k]);
        let friction: Vector2<f64> = touching.iter().map(|foot| law.impulse(foot, 0.0)).sum();
        (friction.norm() - FRICTION * thrown.impulse(k).z) / thrown.largest
    };
    (1..thrown.states.len()).map(outside).fold(0.0, worst)
}

pub(super) fn complementarity(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let thrown = thrown_sphere(bench, h)?;
    let model = Model::of(bench.description());
    let mut beyond = f64::NEG_INFINITY;
    let mut approach = f64::INFINITY;
    let mut before = false;
    for k in 1..thrown.states.len() {
        let touching = thrown.touching().any(|j| j == k);
        if touching {
            let reach = h * (thrown.states[k - 1].velocity.z.abs() + GRAVITY * h);
            beyond = worst(thrown.gap(k - 1).min(thrown.gap(k)) - reach, beyond);
            if before && thrown.gap(k - 1) <= tolerance::touching(GRAVITY, h) {
                approach = approach.min(thrown.contact_velocity(k).z);
            }
        }
        before = touching;
    }
    let margin = match model {
        Model::Coulomb(limits) => limits.contact_margin,
        _ => 0.0,
    };
    let rounding = tolerance::gap(bench.epsilon(), RADIUS);
    let law = convex(&model) && bench.description().contact_model.kind == Kind::Rigid;
    let law = law.then(|| Expectation::at_most(FRICTION * h * ALONG, rounding, "the relaxation acts at φ ≤ h|v_n| + μ h‖u_t‖"));
    let quantity = "gap beyond one step's motion at which an impulse acts";
    let ideal = Expectation::at_most(margin, rounding, "p_n > 0 only in contact");
    let mut measurements = vec![Measurement::new(quantity, "m", beyond, ideal).predicted(law)];
    if bench.description().contact_model.kind == Kind::Rigid && approach.is_finite() {
        let ideal = Expectation::at_least(0.0, tolerance::approach(GRAVITY, h, DOWN), "a contact stops the approach");
        measurements.push(Measurement::new("normal velocity after two steps in contact", "m/s", approach, ideal));
    }
    Ok(measurements)
}

pub(super) fn dissipation(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let thrown = thrown_sphere(bench, h)?;
    let least = tolerance::full_slip(RESPONSE * FRICTION * GRAVITY, h, ALONG);
    let model = Model::of(bench.description());
    let regularised = Regularised::of(bench.description(), FRICTION, h);
    let feet = Feet::of_sphere(thrown.mass, RADIUS);
    let (mut deviation, mut lawful, mut turned) = (0.0, 0.0, 0.0);
    let (sprung, mut returned) = (matches!(model, Model::SpringDamper { .. }), false);
    for k in thrown.touching() {
        let [before, after] = [k - 1, k].map(|k| thrown.contact_velocity(k).xy());
        let normal = thrown.impulse(k).z;
        // A spring along the surface that has stopped the slip throws the sphere back, and is not friction any more.
        returned |= sprung && before.dot(&after) < 0.0;
        if returned || before.norm() < least || after.norm() < least || normal < tolerance::light(thrown.mass * GRAVITY, h) {
            continue;
        }
        let off = |friction: Vector2<f64>| (friction / (FRICTION * normal) + after.normalize()).norm();
        deviation = worst(off(thrown.impulse(k).xy()), deviation);
        turned = worst(thrown.slip_turned(k), turned);
        if let Some(law) = &regularised {
            let touching: Vec<Foot> = feet.between(&thrown.states[k - 1], &thrown.states[k]);
            lawful = worst(off(touching.iter().map(|foot| law.impulse(foot, normal)).sum()), lawful);
        }
    }
    let solved = tolerance::friction(FRICTION);
    let law = match model {
        Model::StewartTrinkle { directions } => Some((polyhedral::force_error(directions), "d directions")),
        Model::DrakeRegularised { .. } => regularised.map(|_| (lawful, "the regularised law at the measured states")),
        Model::Mujoco(_) if bench.description().friction == Friction::Pyramid => {
            Some((polyhedral::force_error(4), "a pyramid with four edges"))
        }
        _ if bench.description().friction == Friction::Pyramid => Some((tolerance::pyramid(turned), "every tangent bounded by itself")),
        _ => None,
    };
    let law = law.map(|(bound, why)| Expectation::at_most(bound, solved, why));
    let ideal = Expectation::at_most(0.0, solved, "p_t = −μ p_n u_t/‖u_t‖");
    Ok(vec![Measurement::new("‖p_t/(μ p_n) + u_t/‖u_t‖‖ while sliding", "1", deviation, ideal).predicted(law)])
}

pub(super) fn increment(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let thrown = thrown_sphere(bench, h)?;
    let works: Vec<f64> = (1..thrown.states.len()).map(|k| work(&thrown, k)).collect();
    let kinetic = 0.5 * thrown.mass * (ALONG * ALONG + DOWN * DOWN);
    let solved = tolerance::work(thrown.mass, GRAVITY, h, kinetic);
    let model = Model::of(bench.description());
    let measurement = match bench.description().contact_model.kind {
        Kind::Rigid => {
            let most = works.iter().copied().fold(f64::NEG_INFINITY, |most, work| worst(work, most));
            let ideal = Expectation::at_most(0.0, solved, "½ pᵀ(u⁻ + u⁺) ≤ 0");
            let step = 1 + works.iter().position(|work| *work == most).unwrap_or(0);
            let law = pushed_out(&model, &thrown, step, h)
                .map(|work| Expectation::at_most(work, solved, "declared error reduction pushes the sphere out of its measured depth"));
            Measurement::new("largest work of the contact in a step", "J", most, ideal).predicted(law)
        }
        Kind::Compliant => {
            let mut sum = 0.0;
            let most = works.iter().fold(0.0, |most, work| {
                sum += work;
                worst(sum, most)
            });
            Measurement::new(
                "largest work of the contact since the start",
                "J",
                most,
                Expectation::at_most(0.0, solved, "a passive contact"),
            )
        }
    };
    let mut rubbing: Vec<f64> = (1..thrown.states.len()).map(|k| friction_work(&thrown, k)).collect();
    let mut quantity = "largest work of friction in a step";
    if matches!(model, Model::SpringDamper { .. }) {
        // A spring along the surface gives back what it has stored.
        quantity = "largest work of friction since the start";
        let mut sum = 0.0;
        rubbing.iter_mut().for_each(|work| {
            sum += *work;
            *work = sum;
        });
    }
    let rubbed = rubbing.into_iter().fold(f64::NEG_INFINITY, |most, work| worst(work, most));
    let speed = ALONG.hypot(DOWN);
    let ideal = Expectation::at_most(0.0, tolerance::friction_work(thrown.largest, speed), "friction opposes the slip after the step");
    Ok(vec![measurement, Measurement::new(quantity, "J", rubbed, ideal)])
}

/// The most work \[J\] that declared error reduction may do in step k, at the measured depth.
fn pushed_out(model: &Model, thrown: &Thrown, k: usize, h: f64) -> Option<f64> {
    let Model::Coulomb(limits) = model else { return None };
    let depth = (-thrown.gap(k - 1)).max(-thrown.gap(k)).max(0.0);
    let push = limits.push(depth, h);
    (push > 0.0).then(|| tolerance::pushing(thrown.mass, GRAVITY, h, thrown.contact_velocity(k - 1).z, push))
}

/// ½ p_tᵀ(u_t⁻ + u_t⁺) \[J\] of interval k.
fn friction_work(thrown: &Thrown, k: usize) -> f64 {
    0.5 * thrown.impulse(k).xy().dot(&(thrown.contact_velocity(k - 1) + thrown.contact_velocity(k)).xy())
}

/// ½ pᵀ(u⁻ + u⁺) \[J\] of interval k.
fn work(thrown: &Thrown, k: usize) -> f64 {
    0.5 * thrown.impulse(k).dot(&(thrown.contact_velocity(k - 1) + thrown.contact_velocity(k)))
}
