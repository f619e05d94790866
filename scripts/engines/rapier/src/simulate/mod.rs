//! A scene in Rapier, step by step.
//!
//! One call of the engine's pipeline goes from t_k to t_k + h: it finds the contacts at t_k, solves them and moves the bodies.
//! The impulses read after the call act in (t_k, t_k + h] and are recorded with the sample that ends it.

use crate::options::{Settings, of_request};
use crate::protocol::{Outcome, Refusal};
use crate::recorder::{BodyState, Recorder};
use crate::scene::{Body, GROUND, Ground, Scene, Shape};
use crate::version::rapier::parry::mass_properties::MassProperties;
use crate::version::rapier::prelude::*;
use crate::version::{self, Real, World};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// `{scene, time_step, sample_every, options}` → `trajectory/1`.
pub fn simulate(request: &Map<String, Value>) -> Outcome<Value> {
    let text = request.get("scene").ok_or_else(|| Refusal::error("missing field `scene`"))?;
    let scene = Scene::read(text)?;
    let settings = Settings::read(scene.engines.get("rapier").into_iter().chain([&of_request(request)?]))?;
    let (time_step, steps) = steps(request, &scene)?;
    let sample_every = sample_every(request)?;

    let mut run = Run::new(&scene, &settings, time_step)?;
    let mut recorder = Recorder::new(scene.bodies.iter().map(|body| body.name.clone()).collect(), time_step);
    recorder.sample(0, run.states())?;
    for step in 1..=steps {
        run.step(&settings, &mut recorder);
        if run.world.lost_a_body() {
            return Err(Refusal::error(format!("the engine took a body with a state that is not finite out of step {step}")));
        }
        if step % sample_every == 0 {
            run.check_on_ground()?;
            recorder.sample(step, run.states())?;
        }
    }
    let engine = json!({"name": "rapier", "version": version::VERSION, "options": settings.to_json()});
    Ok(recorder.finish(text, engine))
}

/// The step h and the number n of steps, n h = duration to 1e-9.
fn steps(request: &Map<String, Value>, scene: &Scene) -> Outcome<(f64, u64)> {
    let time_step = request.get("time_step").and_then(Value::as_f64).ok_or_else(|| Refusal::error("time_step must be a number"))?;
    let ratio = scene.duration / time_step;
    if !(time_step > 0.0 && version::representable(time_step) && scene.duration > 0.0 && ratio < 1e12) {
        return Err(Refusal::error(format!("time_step {time_step} or duration {} is out of range", scene.duration)));
    }
    if (ratio.round() * time_step - scene.duration).abs() > 1e-9 * scene.duration {
        return Err(Refusal::error(format!("time_step {time_step} does not divide the duration {}", scene.duration)));
    }
    Ok((time_step, ratio.round() as u64))
}

fn sample_every(request: &Map<String, Value>) -> Outcome<u64> {
    match request.get("sample_every").and_then(Value::as_u64) {
        Some(count) if count > 0 => Ok(count),
        _ => Err(Refusal::error("sample_every must be a whole number from 1")),
    }
}

/// Thickness of a ground box, relative to its width.
const GROUND_THICKNESS: f64 = 0.1;

/// Friction and restitution of the pairs that have their own, by the numbers of their bodies (0 is the ground).
#[derive(Default)]
pub struct PairTable(BTreeMap<(u128, u128), (Real, Real)>);

impl PairTable {
    /// The coefficients of a pair, if it has its own.
    pub fn get(&self, a: u128, b: u128) -> Option<(Real, Real)> {
        self.0.get(&(a.min(b), a.max(b))).copied()
    }
}

/// The engine with the scene's bodies in it.
struct Run<'a> {
    scene: &'a Scene,
    world: World,
    handles: Vec<RigidBodyHandle>,
    /// Half the width of the ground, if it ends somewhere.
    ground_box: Option<f64>,
}

impl<'a> Run<'a> {
    fn new(scene: &'a Scene, settings: &Settings, time_step: f64) -> Outcome<Self> {
        let mut world = World::new(version::parameters(settings, time_step), version::vector(scene.gravity), pair_table(scene));
        if let Some(ground) = &scene.ground {
            let (body, shape) = ground_of(scene, ground, settings);
            world.insert(body, collider((shape, Pose::IDENTITY), scene, GROUND, 0));
        }
        let handles = scene.bodies.iter().enumerate().map(|(index, body)| {
            let collider = collider(shape(body), scene, &body.name, index as u128 + 1);
            world.insert(rigid_body(body, settings), collider)
        });
        let handles = handles.collect();
        Ok(Run { scene, world, handles, ground_box: settings.ground_box() })
    }

    fn step(&mut self, settings: &Settings, recorder: &mut Recorder) {
        let name = |number: u128| if number == 0 { GROUND } else { self.scene.bodies[number as usize - 1].name.as_str() };
        self.world.step();
        if version::reports_contacts(settings) {
            self.world.contacts(|a, b, point| recorder.contact(name(a), name(b), &point));
        }
    }

    /// Refuses what a half-space would carry and the ground box does not.
    fn check_on_ground(&self) -> Outcome<()> {
        let (Some(extent), Some(ground)) = (self.ground_box, &self.scene.ground) else { return Ok(()) };
        let middle = below_first_body(self.scene, ground);
        let distance = |x: [f64; 3]| middle.iter().zip(x).map(|(m, x)| (m - x) * (m - x)).sum::<f64>().sqrt();
        if self.states().any(|body| distance(body.position) > extent) {
            return Err(Refusal::unsupported("a body leaves the ground box; use ground_shape halfspace"));
        }
        Ok(())
    }

    fn states(&self) -> impl Iterator<Item = BodyState> {
        self.handles.iter().map(|handle| {
            let body = &self.world.bodies[*handle];
            let q = body.rotation();
            let orientation = [q.w, q.x, q.y, q.z].map(f64::from);
            let length = orientation.iter().map(|x| x * x).sum::<f64>().sqrt();
            BodyState {
                position: version::array(body.translation()),
                orientation: orientation.map(|x| x / length),
                linear_velocity: version::array(body.linvel()),
                angular_velocity: version::array(body.angvel()),
            }
        })
    }
}

/// The point of the ground plane below the first body.
fn below_first_body(scene: &Scene, ground: &Ground) -> [f64; 3] {
    let (normal, x) = (ground.normal, scene.bodies[0].position);
    let height = normal.iter().zip(x).map(|(n, x)| n * x).sum::<f64>() - ground.offset;
    std::array::from_fn(|i| x[i] - height * normal[i])
}

/// The ground: a half-space, or a flat box with its upper face in the plane and its middle below the first body.
fn ground_of(scene: &Scene, ground: &Ground, settings: &Settings) -> (RigidBody, SharedShape) {
    let normal = version::unit_vector(ground.normal);
    let Some(extent) = settings.ground_box() else {
        let body = RigidBodyBuilder::fixed().translation(version::vector(ground.normal.map(|n| n * ground.offset)));
        return (body.build(), SharedShape::halfspace(normal));
    };
    let (depth, middle) = (extent * GROUND_THICKNESS, below_first_body(scene, ground));
    let centre = std::array::from_fn(|i| middle[i] - depth * ground.normal[i]);
    let pose = Pose::from_parts(version::vector(centre), Rotation::from_rotation_arc(Vector::Z, normal));
    let [width, depth] = [extent, depth].map(|length| length as Real);
    (RigidBodyBuilder::fixed().pose(pose).build(), SharedShape::cuboid(width, width, depth))
}

fn pair_table(scene: &Scene) -> PairTable {
    let number = |name: &String| scene.bodies.iter().position(|body| body.name == *name).map_or(0, |index| index as u128 + 1);
    let entry = |[a, b]: &[String; 2]| {
        let (friction, restitution) = scene.pair_coefficients(a, b);
        let (a, b) = (number(a), number(b));
        ((a.min(b), a.max(b)), (friction as Real, restitution as Real))
    };
    PairTable(scene.material.pairs.iter().map(|pair| entry(&pair.bodies)).collect())
}

/// Both colliders of a pair have the same coefficients, so that the larger of the two is the pair's.
fn collider((shape, place): (SharedShape, Pose), scene: &Scene, name: &str, number: u128) -> Collider {
    let has_own_pairs = scene.material.pairs.iter().any(|pair| pair.bodies.iter().any(|body| body == name));
    let hooks = if has_own_pairs { ActiveHooks::MODIFY_SOLVER_CONTACTS } else { ActiveHooks::empty() };
    ColliderBuilder::new(shape)
        .position(place)
        .density(0.0)
        .friction(scene.material.friction as Real)
        .friction_combine_rule(CoefficientCombineRule::Max)
        .restitution(scene.material.restitution as Real)
        .restitution_combine_rule(CoefficientCombineRule::Max)
        .active_hooks(hooks)
        .user_data(number)
        .build()
}

/// The shape, and how it lies in the body: Rapier's cylinders are along y.
fn shape(body: &Body) -> (SharedShape, Pose) {
    let upright = Pose::from_parts(version::vector([0.0; 3]), Rotation::from_rotation_arc(Vector::Y, Vector::Z));
    match body.shape("a body").unwrap_or_else(|_| unreachable!("the scene was checked")) {
        Shape::Sphere(sphere) => (SharedShape::ball(sphere.radius as Real), Pose::IDENTITY),
        Shape::Cuboid(cuboid) => {
            let [a, b, c] = cuboid.half_extents.map(|x| x as Real);
            (SharedShape::cuboid(a, b, c), Pose::IDENTITY)
        }
        Shape::Capsule(rod) => (SharedShape::capsule_z(rod.half_height as Real, rod.radius as Real), Pose::IDENTITY),
        Shape::Cylinder(rod) => (SharedShape::cylinder(rod.half_height as Real, rod.radius as Real), upright),
    }
}

fn rigid_body(body: &Body, settings: &Settings) -> RigidBody {
    let [w, x, y, z] = body.orientation.map(|x| x as Real);
    let pose = Pose::from_parts(version::vector(body.position), Rotation::from_xyzw(x, y, z, w).normalize());
    if body.is_static {
        return RigidBodyBuilder::fixed().pose(pose).build();
    }
    if let Some(prescribed) = &body.prescribed {
        let moved = RigidBodyBuilder::kinematic_velocity_based().pose(pose);
        return moved.linvel(version::vector(prescribed.velocity)).angvel(version::vector(prescribed.angular_velocity)).build();
    }
    let mass = body.mass.expect("the scene was checked");
    let inertia = MassProperties::new(version::vector([0.0; 3]), mass as Real, version::vector(body.principal_moments(mass)));
    RigidBodyBuilder::dynamic()
        .pose(pose)
        .linvel(version::vector(body.linear_velocity))
        .angvel(version::vector(body.angular_velocity))
        .additional_mass_properties(inertia)
        .linear_damping(0.0)
        .angular_damping(0.0)
        .can_sleep(false)
        .ccd_enabled(false)
        .gyroscopic_forces_enabled(settings.switch("gyroscopic_forces"))
        .build()
}

#[cfg(test)]
mod tests;
