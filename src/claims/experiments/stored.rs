//! Stored runs of engines that several claims read.
//!
//! In free fall q⁺ − q − h v⁺ tells how positions are updated: 0 with the new velocity, g h² with the old one, ½ g h² with θ = ½.

use crate::gate::scoreboard::Standing;
use crate::stored::{RUNS, read, read_by};
use crate::trajectory::Trajectory;
use crate::{Error, Result};

/// MuJoCo 3.17.0, Euler integrator, a ball dropped from 1 m, h = 1/100 s.
const MUJOCO_BALL: &str = "mujoco/ball_drop__newton-elliptic__h0.01.json";
/// Drake 1.51.1, SAP, the same.
const DRAKE_BALL: &str = "drake/ball_drop__sap__h0.01.json";
const SICONOS: &str = "scoreboard/siconos.json";
const BULLET: &str = "scoreboard/bullet.json";

/// An engine whose fall is stored step by step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Faller {
    /// MuJoCo 3.17.0 with its Euler integrator.
    MuJoCo,
    /// Drake 1.51.1 with SAP.
    Drake,
}

/// An engine whose thrown body the scoreboard holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Thrower {
    /// Siconos 4.4.0.
    Siconos,
    /// PyBullet 3.2.7.
    Bullet,
}

/// The largest |q⁺ − q − h v⁺| and |q⁺ − q − h v| in the first 0.3 s of the fall \[m\].
///
/// # Errors
/// If the stored file is not what it should be.
pub fn update_residuals(engine: Faller) -> Result<[f64; 2]> {
    let path = match engine {
        Faller::MuJoCo => MUJOCO_BALL,
        Faller::Drake => DRAKE_BALL,
    };
    let run = read_by(&RUNS, path, Trajectory::from_json)?;
    let ball = &run.bodies[0];
    let steps = run.times.iter().take_while(|time| **time < 0.3).count();
    let mut largest = [0.0f64; 2];
    for k in 1..steps {
        let moved = ball.position[k][2] - ball.position[k - 1][2];
        for (worst, velocity) in largest.iter_mut().zip([ball.linear_velocity[k][2], ball.linear_velocity[k - 1][2]]) {
            *worst = worst.max((moved - run.time_step * velocity).abs());
        }
    }
    Ok(largest)
}

/// How far the engine's thrown body is from its parabola at the end of `flight/projectile` at h = 1/60 s \[m\].
///
/// # Errors
/// If the stored file is not what it should be.
pub fn projectile_error(engine: Thrower) -> Result<f64> {
    let path = match engine {
        Thrower::Siconos => SICONOS,
        Thrower::Bullet => BULLET,
    };
    standing(path, "flight/projectile", 1.0 / 60.0, "position error")
}

/// What the scoreboard's file has for a check, a time step \[s\] and a quantity.
///
/// # Errors
/// If the stored file is not what it should be.
pub fn standing(path: &str, check: &str, time_step: f64, quantity: &str) -> Result<f64> {
    let standing: Standing = read(&RUNS, path)?;
    let missing = || Error::invalid("references/scoreboard", format!("holds no {check}"), "run `moreau scoreboard`");
    let report = standing.report.ok_or_else(missing)?;
    let check = report.checks.iter().find(|one| one.check == check).ok_or_else(missing)?;
    let step = check.steps.iter().find(|step| step.time_step == Some(time_step)).ok_or_else(missing)?;
    Ok(step.measurements.iter().find(|one| one.quantity == quantity).ok_or_else(missing)?.value)
}
