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
/// PyBullet 3.2.7, a ball dropped from 0.3 m, h = 1/100 s.
const BULLET_BALL: &str = "bullet/ball_bounce__rigid__h0.01.json";
const SICONOS: &str = "scoreboard/siconos.json";
const BULLET: &str = "scoreboard/bullet.json";

/// An engine whose fall is stored step by step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Faller {
    /// MuJoCo 3.17.0 with its Euler integrator.
    MuJoCo,
    /// Drake 1.51.1 with SAP.
    Drake,
    /// PyBullet 3.2.7.
    Bullet,
}

/// An engine whose thrown body the scoreboard holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Thrower {
    /// Siconos 4.4.0.
    Siconos,
    /// PyBullet 3.2.7.
    Bullet,
}

/// Heights and vertical velocities of a body in free fall, sample by sample.
pub struct Fall {
    time_step: f64,
    positions: Vec<f64>,
    velocities: Vec<f64>,
}

impl Fall {
    /// The fall of this engine's stored ball.
    ///
    /// # Errors
    /// If the stored file is not what it should be.
    pub fn stored(engine: Faller) -> Result<Self> {
        let (path, until) = match engine {
            Faller::MuJoCo => (MUJOCO_BALL, 0.3),
            Faller::Drake => (DRAKE_BALL, 0.3),
            Faller::Bullet => (BULLET_BALL, 0.15),
        };
        let run = read_by(&RUNS, path, Trajectory::from_json)?;
        let (ball, samples) = (&run.bodies[0], run.times.iter().take_while(|time| **time < until).count());
        let heights = |vectors: &[[f64; 3]]| vectors[..samples].iter().map(|vector| vector[2]).collect();
        Ok(Fall { time_step: run.time_step, positions: heights(&ball.position), velocities: heights(&ball.linear_velocity) })
    }

    /// 0.3 s of a fall from 1 m under explicit Euler, h = 1/100 s: the position moves with the old velocity.
    pub fn explicit() -> Self {
        let (h, gravity) = (0.01, 9.81);
        let mut fall = Fall { time_step: h, positions: vec![1.0], velocities: vec![0.0] };
        for k in 0..30 {
            fall.positions.push(fall.positions[k] + h * fall.velocities[k]);
            fall.velocities.push(fall.velocities[k] - h * gravity);
        }
        fall
    }

    /// The largest |q⁺ − q − h v⁺| and |q⁺ − q − h v| \[m\].
    pub fn residuals(&self) -> [f64; 2] {
        let mut largest = [0.0f64; 2];
        for (places, speeds) in self.positions.windows(2).zip(self.velocities.windows(2)) {
            for (worst, velocity) in largest.iter_mut().zip([speeds[1], speeds[0]]) {
                *worst = worst.max((places[1] - places[0] - self.time_step * velocity).abs());
            }
        }
        largest
    }
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
