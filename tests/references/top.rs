//! A free body that spins without torque for a second: its energy under MuJoCo's integrators against ours.

use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::mechanics::spatial::{Shape, SpatialBody};
use moreau::mechanics::{Materials, Mechanism, SpatialBodies, State};
use moreau::schemes::Mujoco;
use moreau::schemes::mujoco::Integrator;
use moreau::schemes::run;
use moreau::solvers::GaussNewton;
use moreau::stored::{Folder, read};
use moreau::tolerance::references::ENGINE_ROUNDING;
use nalgebra::dvector;
use serde_json::Value;
use std::path::Path;

/// What MuJoCo says of itself, and its small experiments.
pub fn facts(root: &Path) -> Result<Value, Failed> {
    Ok(read(&Folder(root.into()), "facts/mujoco.json")?)
}

/// The share of its energy that the top of the stored experiment keeps; and that Euler keeps another one.
pub fn check(root: &Path, name: &str) -> Result<Vec<Finding>, Failed> {
    let stored = |name: &str| -> Result<f64, Failed> {
        let energies = &facts(root)?["computed"]["energy_of_a_top"];
        energies[format!("{name} free")].as_f64().ok_or_else(|| format!("no energy under {name}").into())
    };
    let integrator = Integrator::by_name(&name.to_lowercase())?;
    let body = SpatialBody::new("top", Shape::Sphere { radius: 0.1 }, 1.0, [0.02, 0.03, 0.04])?;
    let top = SpatialBodies::without_ground("top", vec![body], [0.0; 3], Materials::new(0.0, 0.0)?)?;
    let start =
        State { time: 0.0, position: dvector![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], velocity: dvector![0.0, 0.0, 0.0, 3.0, 4.0, 1.0] };
    let before = top.kinetic_energy(&start);
    let scheme = Mujoco { integrator, ..Mujoco::default() };
    let end = run(&scheme, &GaussNewton::default(), &top, start, 0.01, 100, |_| ())?;
    let ours = top.kinetic_energy(&end) / before;
    let other = if name == "Euler" { stored("RK4")? } else { stored("Euler")? };
    Ok(vec![
        Finding::equal("energy after 1 s over its start", ours, stored(name)?, ENGINE_ROUNDING, "1"),
        Finding::at_least("control: another integrator's", (ours - other).abs(), 1e6 * ENGINE_ROUNDING, "1"),
    ])
}
