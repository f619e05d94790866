//! An engine for `moreau gate`: one ball over a plane, without friction. It gets verdicts as it stands; `moreau new engine --language rust`
//! writes this file. In a project of its own, with the folder of a checkout of moreau:
//!
//! ```sh
//! cargo add --path ../moreau && cargo build --release
//! moreau protocol-check -- target/release/my-engine      # what is wrong with the adapter
//! moreau gate --quick -- target/release/my-engine        # every check; what it cannot do is `unsupported`
//! ```
//! Put your engine where YOURS is written. The messages, moreau-engine/1, are specified by `docs/protocol.md`; `serve` speaks them.
//!
//! ```text
//!     x_m = x + h/2 v,    v⁺ = v + h g + p n,    x⁺ = x_m + h/2 v⁺,
//! ```
//! where p is the least impulse over the mass, p ≥ 0, with n·v⁺ ≥ −e n·v; it acts if the ball touches at x_m.

use moreau::gate::description::{BodyKind, Friction, Precision, ShapeKind};
use moreau::gate::{ContactModel, Kind, Level, serve::serve};
use moreau::nalgebra::Vector3;
use moreau::prelude::*;
use moreau::scenes::Scene;
use moreau::trajectory::{BodyTrack, ContactRecord, Producer, Trajectory};
use std::io::{BufReader, stdin, stdout};

/// YOURS: the engine.
#[derive(Default)]
pub struct MyEngine;

/// YOURS: the scene in your engine.
struct World<'a> {
    scene: &'a Scene,
    radius: f64,
    x: Vector3<f64>,
    v: Vector3<f64>,
}

impl<'a> World<'a> {
    fn new(scene: &'a Scene) -> Reply<Self> {
        let (ball, material) = (&scene.bodies[0], &scene.material);
        let turns = ball.angular_velocity.iter().any(|rate| *rate != 0.0);
        let radius = ball.sphere.map(|sphere| sphere.radius).filter(|_| scene.bodies.len() == 1 && !turns);
        let radius = radius.ok_or_else(|| Refusal::unsupported("one ball that does not turn is all there is"))?;
        if material.friction > 0.0 || !material.pairs.is_empty() {
            return Err(Refusal::unsupported("there is no friction, and no values of pairs"));
        }
        Ok(World { scene, radius, x: ball.position.into(), v: ball.linear_velocity.into() })
    }

    /// One time step h; the impulse \[N·s\] of the ground on the ball.
    fn step(&mut self, h: f64) -> Vector3<f64> {
        let before = self.v;
        let mut impulse = Vector3::zeros();
        self.x += before * (h / 2.0);
        self.v += Vector3::from(self.scene.gravity) * h;
        if let Some(ground) = self.scene.ground {
            let n = Vector3::from(ground.normal);
            if n.dot(&self.x) - ground.offset <= self.radius {
                let p = (-n.dot(&self.v) - self.scene.material.restitution * n.dot(&before)).max(0.0);
                self.v += n * p;
                impulse = n * (p * self.scene.bodies[0].mass);
            }
        }
        self.x += self.v * (h / 2.0);
        impulse
    }

    /// Adds the state of every body, in the order of the scene.
    fn record(&self, tracks: &mut [BodyTrack]) {
        tracks[0].position.push(self.x.into());
        tracks[0].orientation.push(self.scene.bodies[0].orientation);
        tracks[0].linear_velocity.push(self.v.into());
        tracks[0].angular_velocity.push([0.0; 3]);
    }
}

impl Engine for MyEngine {
    /// YOURS: who the engine is, and the contact law that it documents. The gate predicts from it what is to be expected.
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        if !options.is_empty() {
            return Err(Refusal::errored("this engine has no options"));
        }
        Ok(Description {
            name: "my-engine".into(),
            version: "0.1.0".into(),
            precision: Precision::Double,
            contact_model: ContactModel { kind: Kind::Rigid, law: Some("coulomb".into()), parameters: Default::default() },
            restitution: true,
            friction: Friction::None,
            reports_contacts: true,
            levels: vec![Level::Simulate],
            laws: vec![],
            shapes: vec![ShapeKind::Sphere],
            bodies: vec![BodyKind::Free],
            sleeping: None,
            options: Options::new(),
        })
    }

    /// A sample every `sample_every` steps; impulses are summed over the time between samples.
    fn simulate(&mut self, scene: &Scene, h: f64, sample_every: usize, options: &Options) -> Reply<Trajectory> {
        let Description { name, version, .. } = self.describe(options)?;
        let mut world = World::new(scene)?;
        let steps = (scene.duration / h).round() as usize;
        if (steps as f64 * h - scene.duration).abs() > 1e-9 * scene.duration {
            return Err(Refusal::errored(format!("the time step {h} s does not divide the duration {} s", scene.duration)));
        }
        let track = |name: &str| BodyTrack {
            name: name.into(),
            position: vec![],
            orientation: vec![],
            linear_velocity: vec![],
            angular_velocity: vec![],
        };
        let mut bodies: Vec<BodyTrack> = scene.bodies.iter().map(|body| track(&body.name)).collect();
        let (mut times, mut contacts, mut impulse) = (Vec::new(), Vec::new(), Vector3::zeros());
        for step in 0..=steps {
            if step > 0 {
                impulse += world.step(h);
            }
            if step % sample_every == 0 {
                if let Some(ground) = scene.ground.filter(|_| impulse != Vector3::zeros()) {
                    let pair = [scene.bodies[0].name.clone(), "ground".into()];
                    contacts.push(ContactRecord { sample: times.len(), bodies: pair, normal: ground.normal, impulse: impulse.into() });
                }
                impulse = Vector3::zeros();
                times.push(step as f64 * h);
                world.record(&mut bodies);
            }
        }
        let engine = Producer { name, version, options: Options::new() };
        let schema = "trajectory/1".into();
        Ok(Trajectory { schema, scene: scene.clone(), engine, time_step: h, times, bodies, contacts, steps: None, provenance: None })
    }
}

/// Answers requests until `bye` or the end of standard input; a line has at most 256 MiB.
pub fn main() -> std::io::Result<()> {
    serve(&mut MyEngine, BufReader::new(stdin().lock()), stdout().lock(), 256 << 20)
}
