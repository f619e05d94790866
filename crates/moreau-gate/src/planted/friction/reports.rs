//! An engine that misreads its scene or misreports its trajectory.

use crate::own::OwnEngine;
use crate::{Description, Engine, Options, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;

/// One of our engines between two changes; the reply names the scene that was asked for.
pub(super) struct Reporting {
    pub engine: OwnEngine,
    pub scene: fn(&mut Scene),
    pub trajectory: fn(&mut Trajectory),
}

impl Engine for Reporting {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        self.engine.describe(options)
    }

    fn simulate(&mut self, scene: &Scene, time_step: f64, sample_every: usize, options: &Options) -> Reply<Trajectory> {
        let mut read = scene.clone();
        (self.scene)(&mut read);
        let mut trajectory = self.engine.simulate(&read, time_step, sample_every, options)?;
        trajectory.scene = scene.clone();
        (self.trajectory)(&mut trajectory);
        Ok(trajectory)
    }
}

/// p/Δt, with Δt between samples.
pub(super) fn forces(trajectory: &mut Trajectory) {
    let interval = trajectory.times.get(1).copied().unwrap_or(1.0);
    trajectory.contacts.iter_mut().for_each(|contact| contact.impulse = contact.impulse.map(|p| p / interval));
}

/// Every contact one sample later; those of the last are lost.
pub(super) fn late(trajectory: &mut Trajectory) {
    trajectory.contacts.iter_mut().for_each(|contact| contact.sample += 1);
    let samples = trajectory.times.len();
    trajectory.contacts.retain(|contact| contact.sample < samples);
}
