//! A random scene with everything needed to run it again.

use crate::numbers::Numbers;
use moreau::mechanics::{Mechanism, OscillatorWithStop, State};
use moreau::scenes::{Body, Cuboid, Ground, Material, PairOverride, Scene, Sphere};
use moreau::schemes::mujoco::Cone;
use moreau::schemes::{Activation, Bodies, RestitutionRule, SchemeParameters};
use nalgebra::dvector;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// What moves.
pub enum Subject {
    /// Bodies in space.
    Space(Scene),
    /// Bodies in the x–z plane.
    Plane(Scene),
    /// A mass on a spring with a stop: m, k, c, stop, e, and where it starts.
    Oscillator([f64; 7]),
}

/// A scene, a step size, how many steps, and the parameters of the schemes.
pub struct Scenario {
    pub seed: u64,
    pub h: f64,
    pub steps: usize,
    pub parameters: SchemeParameters,
    pub subject: Subject,
}

/// What a scheme moves.
pub struct Staged {
    pub mechanism: Box<dyn Mechanism>,
    pub start: State,
    /// m of every body [kg].
    pub masses: Vec<f64>,
}

/// How long the scenes of a run are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Length {
    /// Fewer steps for more bodies, whose contacts grow with their square.
    Short,
    /// Up to [`STEPS`] for all.
    Full,
}

/// Most steps of a scene.
pub const STEPS: f64 = 200.0;

impl Scenario {
    /// The scene of a seed, with the steps of this length of run.
    pub fn new(seed: u64, length: Length) -> Self {
        let mut numbers = Numbers::new(seed);
        let n = &mut numbers;
        let h = n.scale(1e-4, 1.0 / 30.0);
        let steps = n.scale(4.0, STEPS + 1.0);
        let parameters = parameters(n);
        let subject = match n.share() {
            x if x < 0.7 => Subject::Space(scene(n, seed, false)),
            x if x < 0.92 => Subject::Plane(scene(n, seed, true)),
            _ => Subject::Oscillator(oscillator(n)),
        };
        let bodies = match &subject {
            Subject::Space(scene) | Subject::Plane(scene) => scene.bodies.len() as f64,
            Subject::Oscillator(_) => 1.0,
        };
        let steps = match length {
            Length::Full => steps,
            Length::Short => (steps / bodies.powf(1.5)).max(3.0),
        };
        Scenario { seed, h, steps: steps as usize, parameters, subject }
    }

    /// The mechanism and its start.
    pub fn staged(&self) -> Staged {
        match &self.subject {
            Subject::Oscillator([mass, stiffness, damping, stop, restitution, position, velocity]) => Staged {
                mechanism: Box::new(OscillatorWithStop::new(*mass, *stiffness, *damping, *stop, *restitution).expect("valid numbers")),
                start: State { time: 0.0, position: dvector![*position], velocity: dvector![*velocity] },
                masses: vec![*mass],
            },
            Subject::Space(scene) | Subject::Plane(scene) => {
                let planar = matches!(self.subject, Subject::Plane(_));
                let staged = if planar { scene.mechanism() } else { scene.spatial_mechanism() };
                let (mechanism, start) = staged.unwrap_or_else(|error| panic!("seed {}: {error}", self.seed));
                Staged { mechanism, start, masses: scene.bodies.iter().map(|body| body.mass).collect() }
            }
        }
    }

    /// Everything needed to run it again.
    pub fn json(&self, scheme: &str) -> Value {
        let subject = match &self.subject {
            Subject::Space(scene) => json!({ "space": scene }),
            Subject::Plane(scene) => json!({ "plane": scene }),
            Subject::Oscillator(numbers) => json!({ "oscillator": numbers }),
        };
        let parameters = format!("{:?}", self.parameters);
        json!({ "seed": self.seed, "scheme": scheme, "h": self.h, "steps": self.steps, "parameters": parameters, "scene": subject })
    }
}

fn parameters(n: &mut Numbers) -> SchemeParameters {
    let mut parameters = SchemeParameters { theta: if n.chance(0.6) { 0.5 } else { n.share() }, ..SchemeParameters::default() };
    parameters.activation = n.one_of(&Activation::ALL);
    parameters.restitution = n.one_of(&RestitutionRule::ALL);
    parameters.bullet.bodies = n.one_of(&[Bodies::Multi, Bodies::Rigid]);
    parameters.mujoco.cone = n.one_of(&[Cone::Pyramidal, Cone::Elliptic]);
    parameters.drake.dissipation = if n.chance(0.5) { 0.0 } else { n.between(0.0, 2.0) };
    parameters.drake.relaxation_time = if n.chance(0.5) { 0.0 } else { n.between(0.0, 0.1) };
    parameters
}

/// e and μ: the corners 0 and 1 often, the plane's e = 1 without friction for the variational scheme.
fn material(n: &mut Numbers, planar: bool, names: &[String]) -> Material {
    if planar && n.chance(0.3) {
        return Material { friction: 0.0, restitution: 1.0, pairs: Vec::new() };
    }
    let mut restitution = || match n.share() {
        x if x < 0.4 => 0.0,
        x if x < 0.5 => 1.0,
        _ => n.share(),
    };
    let (common, other) = (restitution(), restitution());
    let friction = if n.chance(0.25) { 0.0 } else { n.between(0.0, 1.2) };
    let pairs = match n.chance(0.2) {
        true => vec![PairOverride { bodies: ["ground".into(), n.one_of(names)], friction: None, restitution: Some(other) }],
        false => Vec::new(),
    };
    Material { friction, restitution: common, pairs }
}

/// Masses around one size, or anything between 1 and 10⁵ times the smallest.
fn masses(n: &mut Numbers, count: usize) -> Vec<f64> {
    let least = n.scale(0.01, 10.0);
    let ratio = if n.chance(0.4) { 1e5 } else { 10.0 };
    (0..count).map(|_| least * n.scale(1.0, ratio)).collect()
}

/// How the bodies start.
#[derive(Clone, Copy, PartialEq)]
enum Start {
    /// One upon the other, at rest, touching.
    Stacked,
    /// Just above the ground, side by side, spinning.
    Low,
    /// One above the other, spinning.
    Falling,
}

fn scene(n: &mut Numbers, seed: u64, planar: bool) -> Scene {
    let count = n.one_of(&[1, 1, 2, 2, 3, 4]);
    let start = n.one_of(&[Start::Stacked, Start::Low, Start::Falling]);
    let grounded = start == Start::Stacked || n.chance(0.85);
    let sloped = grounded && start != Start::Stacked && n.chance(0.2);
    let masses = masses(n, count);
    let mut above = 0.0;
    let mut bodies: Vec<Body> = Vec::new();
    for (k, mass) in masses.into_iter().enumerate() {
        let (body, height) = body(n, k, mass, planar, start, above);
        above = height;
        bodies.push(body);
    }
    let names: Vec<String> = bodies.iter().map(|body| body.name.clone()).collect();
    let tilt: f64 = if sloped { n.between(-0.7, 0.7) } else { 0.0 };
    Scene {
        schema: moreau::scenes::SCHEMA.into(),
        name: format!("random {seed}"),
        description: String::new(),
        gravity: if n.chance(0.1) { [0.0; 3] } else { [0.0, 0.0, -9.81] },
        ground: grounded.then(|| Ground { normal: [tilt.sin(), 0.0, tilt.cos()], offset: if sloped { -2.0 } else { 0.0 } }),
        material: material(n, planar, &names),
        bodies,
        duration: 1.0,
        engines: BTreeMap::new(),
    }
}

/// A body of the start's kind, the lowest point of what comes above it at `above`, and the same for the next.
fn body(n: &mut Numbers, k: usize, mass: f64, planar: bool, start: Start, above: f64) -> (Body, f64) {
    let sphere = n.chance(0.4).then(|| Sphere { radius: n.scale(0.05, 0.5) });
    let cuboid = sphere.is_none().then(|| Cuboid { half_extents: [0; 3].map(|_| n.scale(0.05, 0.5)) });
    let half = cuboid.map_or([sphere.map_or(0.0, |s| s.radius); 3], |cuboid| cuboid.half_extents);
    let radius = if sphere.is_some() { half[0] } else { half.iter().map(|x| x * x).sum::<f64>().sqrt() };
    let turned = |n: &mut Numbers| if planar { planar_turn(n.between(-3.0, 3.0)) } else { n.unit() };
    let flat = |mut vector: [f64; 3]| {
        if planar {
            vector[1] = 0.0;
        }
        vector
    };
    let spin = |n: &mut Numbers| {
        let size = if n.chance(0.2) { 60.0 } else { 8.0 };
        let [x, y, z] = n.vector(size);
        if planar { [0.0, y, 0.0] } else { [x, y, z] }
    };
    let (position, orientation, linear, angular, next) = match start {
        Start::Stacked => {
            let yaw = n.between(-0.5, 0.5);
            let orientation = if planar || n.chance(0.5) { [1.0, 0.0, 0.0, 0.0] } else { [(0.5 * yaw).cos(), 0.0, 0.0, (0.5 * yaw).sin()] };
            ([0.0, 0.0, above + half[2]], orientation, [0.0; 3], [0.0; 3], above + 2.0 * half[2])
        }
        Start::Low => {
            let [x, y, z] = [above + radius, 0.0, radius + n.between(0.0, 0.05)];
            ([x, y, z], turned(n), flat(n.vector(2.0)), spin(n), x + radius + n.between(0.0, 0.05))
        }
        Start::Falling => {
            let gap = n.between(0.0, 0.3);
            let [x, y, _] = flat(n.vector(0.1));
            ([x, y, above + gap + radius], turned(n), flat(n.vector(3.0)), spin(n), above + gap + 2.0 * radius)
        }
    };
    let body = Body {
        sphere,
        cuboid,
        orientation,
        linear_velocity: linear,
        angular_velocity: angular,
        ..Body::sphere(format!("b{k}"), mass, radius, position)
    };
    (body, next)
}

/// The quaternion of a rotation about y.
fn planar_turn(angle: f64) -> [f64; 4] {
    [(0.5 * angle).cos(), 0.0, (0.5 * angle).sin(), 0.0]
}

/// hω between 10⁻³ and 3, undamped every other time; what the stop takes away is any e.
fn oscillator(n: &mut Numbers) -> [f64; 7] {
    let (mass, stiffness) = (n.scale(0.1, 10.0), n.scale(1.0, 1e4));
    let damping = if n.chance(0.5) { 0.0 } else { n.scale(0.01, 10.0) };
    [mass, stiffness, damping, n.between(-0.2, 0.05), n.one_of(&[0.0, 0.5, 1.0, 0.9]), n.between(0.06, 0.3), n.between(-3.0, 3.0)]
}
