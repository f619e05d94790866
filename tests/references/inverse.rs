//! mj_inverse at a block that slides, by `Mujoco::inverse`: the forces of every contact and the force that an acceleration asks for, with
//! three and six directions per contact; and the same numbers read as (v⁺ − v)/h of implicitfast.

use crate::top::facts;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::mechanics::State;
use moreau::scenes::Scene;
use moreau::schemes::Mujoco;
use moreau::schemes::mujoco::{Cone, ContactForce, Integrator, Rotational};
use moreau::tolerance::references::ENGINE_ROUNDING;
use nalgebra::DVector;
use serde_json::Value;
use std::path::Path;

/// The step of the stored experiment \[s\].
const TIME_STEP: f64 = 0.002;

/// Findings about the experiment of this name, for instance `elliptic 6`.
pub fn check(root: &Path, name: &str) -> Result<Vec<Finding>, Failed> {
    let facts = facts(root)?;
    let stored = &facts["computed"]["inverse"][name];
    let list = |value: &Value| -> Option<DVector<f64>> {
        let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(Value::as_f64).collect();
        Some(DVector::from_vec(numbers?))
    };
    let numbers = |key: &str| list(&stored[key]).ok_or_else(|| format!("{name}: no numbers `{key}`"));
    let (cone, directions) = name.split_once(' ').ok_or("a cone and a number of directions")?;
    let rotational = if directions == "6" { Rotational { torsional: 0.02, rolling: 0.001 } } else { Rotational::NONE };
    let scheme = Mujoco { rotational, integrator: Integrator::ImplicitFast, ..Mujoco::standard(Cone::by_name(cone)?) };
    let (mechanism, _) = Scene::read(&root.join("scenes/block_slide.json"))?.spatial_mechanism()?;
    let state = State { time: 0.0, position: numbers("qpos")?, velocity: numbers("qvel")? };
    let (acceleration, applied, discrete) = (numbers("qacc")?, numbers("qfrc_inverse")?, numbers("discrete")?);
    let ours = scheme.inverse(mechanism.as_ref(), &state, &acceleration, TIME_STEP)?;
    let forces: Option<Vec<DVector<f64>>> = stored["forces"].as_array().and_then(|all| all.iter().map(list).collect());
    let forces = forces.ok_or("no forces")?;
    let size = forces.iter().map(DVector::amax).fold(applied.amax(), f64::max);
    let of_contact = |theirs: &DVector<f64>| {
        let far = |one: &ContactForce| (world(one) - theirs).amax();
        ours.contacts.iter().map(far).fold(f64::INFINITY, f64::min)
    };
    let worst = forces.iter().map(of_contact).fold(0.0, f64::max);
    let after = &state.velocity + &acceleration * TIME_STEP;
    let continuous = scheme.acceleration_of_step(mechanism.as_ref(), &state, &after, TIME_STEP)?;
    let read_as_step = scheme.inverse(mechanism.as_ref(), &state, &continuous, TIME_STEP)?;
    let round_or_not = Mujoco { rotational, ..Mujoco::standard(if cone == "elliptic" { Cone::Pyramidal } else { Cone::Elliptic }) };
    let other = round_or_not.inverse(mechanism.as_ref(), &state, &acceleration, TIME_STEP)?;
    Ok(vec![
        Finding::equal("contacts", ours.contacts.len() as f64, forces.len() as f64, 0.0, "1"),
        Finding::at_least("largest stored force", forces.iter().map(DVector::amax).fold(0.0, f64::max), 1.0, "N"),
        Finding::at_most("forces of the contacts, relative", worst / size, ENGINE_ROUNDING, "1"),
        Finding::at_most("qfrc_inverse, relative", (&ours.applied - &applied).amax() / size, ENGINE_ROUNDING, "1"),
        Finding::at_most("qfrc_inverse of a step of implicitfast", (&read_as_step.applied - &discrete).amax() / size, ENGINE_ROUNDING, "1"),
        Finding::at_least(
            "control: the step's differs from the acceleration's",
            (&discrete - &applied).amax() / size,
            ENGINE_ROUNDING,
            "1",
        ),
        Finding::at_least("control: the other cone's", (&other.applied - &applied).amax() / size, ENGINE_ROUNDING, "1"),
    ])
}

/// Force and torque of a contact in the world; without rows of rotation the torque is zero.
fn world(contact: &ContactForce) -> DVector<f64> {
    let mut parts = contact.force.as_slice().to_vec();
    parts.resize(6, 0.0);
    let place = contact.place.as_ref().expect("bodies have places");
    DVector::from_iterator(6, [&parts[..3], &parts[3..]].into_iter().flat_map(|part| place.world_impulse(part)))
}
