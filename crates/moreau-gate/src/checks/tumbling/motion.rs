//! A thrown motion, step by step, as mechanics.

use crate::checks::motion::{Sample, samples};
use crate::checks::scenery::{GRAVITY, worst};
use crate::checks::tumbling::overlap::{Placed, overlap};
use crate::checks::tumbling::scenes::Throw;
use crate::model::Model;
use crate::model::solid::box_moments;
use crate::{Bench, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::ContactRecord;
use nalgebra::Vector3;

/// A body of the scene.
#[derive(Clone, Copy, Debug)]
pub(in crate::checks) struct Solid {
    /// m \[kg\].
    pub mass: f64,
    /// Principal moments \[kg·m²\].
    pub moments: Vector3<f64>,
    /// Half extents \[m\].
    pub half: [f64; 3],
}

impl Solid {
    fn new(mass: f64, half: [f64; 3]) -> Self {
        Solid { mass, moments: box_moments(mass, half.into()), half }
    }

    /// Half the diagonal \[m\].
    pub fn radius(&self) -> f64 {
        Vector3::from(self.half).norm()
    }

    /// The largest principal moment less the smallest \[kg·m²\]: 0 for a cube, up to rounding.
    pub fn spread(&self) -> f64 {
        self.moments.max() - self.moments.min()
    }

    /// ½ m‖v‖² + ½ ωᵀJω \[J\].
    pub fn kinetic(&self, state: &Sample) -> f64 {
        let spin = state.rotation.inverse() * state.spin;
        0.5 * self.mass * state.velocity.norm_squared() + 0.5 * spin.dot(&self.moments.component_mul(&spin))
    }

    /// A bound \[m/s\] on the speed of every point of it.
    pub fn fastest(&self, state: &Sample) -> f64 {
        state.velocity.norm() + self.radius() * state.spin.norm()
    }
}

/// The states of all bodies after 0, 1, … steps.
pub(in crate::checks) struct Tumble {
    /// The bodies, from below.
    pub bodies: Vec<Solid>,
    /// States by step, then by body.
    pub states: Vec<Vec<Sample>>,
    /// What was reported, with the sample it belongs to.
    pub contacts: Vec<ContactRecord>,
    /// Names in the order of the bodies.
    pub names: Vec<String>,
    /// h \[s\].
    pub h: f64,
    /// Declared damping rate of the velocities \[1/s\].
    pub damping: f64,
}

impl Tumble {
    /// The motion of a throw over about `duration` \[s\], every step of it.
    pub(super) fn of(bench: &mut Bench, throw: &Throw, friction: f64, h: f64, duration: f64) -> Reply<Self> {
        Tumble::of_scene(bench, throw.scene(friction), h, duration)
    }

    /// The motion of one or two boxes over about `duration` \[s\], every step of it.
    pub fn of_scene(bench: &mut Bench, scene: Scene, h: f64, duration: f64) -> Reply<Self> {
        let steps = (duration / h).round() as usize;
        let motion = bench.simulate(&scene, h, steps, 1)?;
        let tracks: Vec<Vec<Sample>> = scene.bodies.iter().filter_map(|body| motion.body(&body.name)).map(samples).collect();
        Ok(Tumble {
            bodies: scene.bodies.iter().filter_map(|body| Some(Solid::new(body.mass, body.cuboid?.half_extents))).collect(),
            states: (0..=steps).map(|k| tracks.iter().map(|track| track[k]).collect()).collect(),
            contacts: motion.contacts,
            names: scene.bodies.into_iter().map(|body| body.name).collect(),
            h,
            damping: Model::of(bench.description()).damping().map_or(0.0, |(linear, _)| linear),
        })
    }

    /// Kinetic energy \[J\] after k steps.
    pub fn kinetic(&self, k: usize) -> f64 {
        self.each(k).map(|(body, state)| body.kinetic(state)).sum()
    }

    /// Energy \[J\] after k steps: kinetic and m g z.
    pub fn energy(&self, k: usize) -> f64 {
        self.kinetic(k) + self.each(k).map(|(body, state)| body.mass * GRAVITY * state.position.z).sum::<f64>()
    }

    /// Σ m v_z \[N·s\] after k steps.
    pub fn upward(&self, k: usize) -> f64 {
        self.each(k).map(|(body, state)| body.mass * state.velocity.z).sum()
    }

    /// The impulse \[N·s\] of all contacts on a body in step k, counted from 1: m Δv − m g h + c m Δx, with the declared damping c \[1/s\].
    pub fn impulse(&self, body: usize, k: usize) -> Vector3<f64> {
        let [before, after] = [k - 1, k].map(|k| &self.states[k][body]);
        let damped = (after.position - before.position) * self.damping;
        (after.velocity - before.velocity + damped + Vector3::new(0.0, 0.0, GRAVITY * self.h)) * self.bodies[body].mass
    }

    /// Bodies with their states after k steps.
    pub fn each(&self, k: usize) -> impl Iterator<Item = (&Solid, &Sample)> {
        self.bodies.iter().zip(&self.states[k])
    }

    /// The bodies where they are after k steps.
    pub(super) fn placed(&self, k: usize) -> Vec<Placed> {
        self.each(k).map(|(body, state)| Placed { state: *state, half: body.half }).collect()
    }

    /// The deepest overlap \[m\] after k steps, of a body with the floor or of two bodies; 0 without any.
    pub fn depth(&self, k: usize) -> f64 {
        let placed = self.placed(k);
        let floor = placed.iter().map(|body| -body.lowest()).fold(0.0, worst);
        match placed.as_slice() {
            [one, other] => worst(overlap(one, other), floor),
            _ => floor,
        }
    }

    /// A bound \[m/s\] on the relative speed of any two points that may touch, after k steps.
    pub fn fastest(&self, k: usize) -> f64 {
        self.each(k).map(|(body, state)| body.fastest(state)).sum()
    }
}
