//! Motions of bodies in space against closed forms, conservation laws and the planar mechanisms.

use super::*;
use crate::mechanics::State;
use crate::scenes::{Scene, named};
use crate::schemes::{Anitescu, MoreauJean, Scheme, StepContext, StewartTrinkle, carry_over, run, simulate};
use moreau_contact::certificate::residuals;
use moreau_contact::contact::ContactImpulse;
use moreau_contact::solvers::{Auto, ContactSolver};
use moreau_contact::tolerance::solvers::STOP;
use moreau_exact::tolerance::rounding;
use nalgebra::{Rotation3, dvector};

const TOP: Vector3<f64> = Vector3::new(0.5, 0.5, 0.8);

fn spinning(moments: Vector3<f64>, spin: Vector3<f64>) -> (SpatialBodies, State) {
    let body = SpatialBody::new("top", Shape::Sphere { radius: 0.1 }, 1.0, moments.into()).expect("valid");
    let free = SpatialBodies::without_ground("top", vec![body], [0.0; 3], Materials::new(0.0, 0.0).expect("valid")).expect("valid");
    let position = dvector![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    (free, State { time: 0.0, position, velocity: dvector![0.0, 0.0, 0.0, spin[0], spin[1], spin[2]] })
}

fn theta(theta: f64) -> MoreauJean {
    MoreauJean { theta, ..MoreauJean::default() }
}

fn turned(moments: Vector3<f64>, spin: Vector3<f64>, scheme: &dyn Scheme, h: f64, steps: usize) -> (State, Vector3<f64>, f64) {
    let (body, start) = spinning(moments, spin);
    let state = run(scheme, &Auto, &body, start, h, steps, |_| ()).expect("free flight");
    let pose = Pose::of(0, &state.position);
    let momentum = pose.rotation * moments.component_mul(&super::spin(0, &state.velocity));
    let energy = body.kinetic_energy(&state);
    (state, momentum, energy)
}

/// log₂ of the ratio of the errors at h and h/2.
fn observed_order(error: impl Fn(f64, usize) -> f64, h: f64, steps: usize) -> f64 {
    (error(h, steps) / error(0.5 * h, 2 * steps)).log2()
}

#[test]
fn a_symmetric_top_turns_about_its_momentum_at_its_rate_with_second_order() {
    // R(t) = exp(t L/A) exp(−t λ e₃), λ = (C − A)/A Ω₃, with L fixed in space and R(0) = 1.
    let spin = Vector3::new(1.0, 0.0, 3.0);
    let momentum = TOP.component_mul(&spin);
    let error = |h: f64, steps: usize| {
        let time = h * steps as f64;
        let rate = (TOP[2] - TOP[0]) / TOP[0] * spin[2];
        let exact = Rotation3::from_scaled_axis(momentum * (time / TOP[0])) * Rotation3::from_scaled_axis(Vector3::z() * (-time * rate));
        let (state, _, _) = turned(TOP, spin, &theta(0.5), h, steps);
        (Pose::of(0, &state.position).rotation - exact.matrix()).norm()
    };
    assert!(error(1.0 / 256.0, 256) < 1e-3);
    let order = observed_order(error, 1.0 / 256.0, 256);
    // The next term of the error is smaller by h² rate² < 1e-3.
    assert!((order - 2.0).abs() < 0.05, "order {order}");
}

#[test]
fn a_spinning_box_keeps_energy_and_size_of_momentum_and_turns_its_direction_by_the_order_of_the_scheme() {
    let (moments, spin) = (Vector3::new(0.4, 0.7, 1.0), Vector3::new(0.1, 3.0, 0.2));
    let initial = moments.component_mul(&spin);
    let steps = 256;
    for (value, expected) in [(0.5, 2.0), (1.0, 1.0)] {
        let error = |h: f64, steps: usize| (turned(moments, spin, &theta(value), h, steps).1 - initial).norm();
        let order = observed_order(error, 1.0 / 256.0, steps);
        assert!((order - expected).abs() < 0.1, "θ = {value}: order {order}");
        let (_, momentum, energy) = turned(moments, spin, &theta(value), 1.0 / 256.0, steps);
        let bound = |size: f64| rounding(64 * steps, size);
        assert!((energy - 0.5 * spin.dot(&initial)).abs() <= bound(energy));
        assert!((momentum.norm() - initial.norm()).abs() <= bound(initial.norm()));
    }
}

#[test]
fn the_explicit_gyroscopic_step_gains_the_energy_that_the_midpoint_keeps() {
    // ½ h² Ω̇ᵀJΩ̇ per step, up to O(h³): the control of the test above.
    let (moments, spin, h) = (Vector3::new(0.4, 0.7, 1.0), Vector3::new(0.1, 3.0, 0.2), 1e-3);
    let (body, start) = spinning(moments, spin);
    let rate = body.force(&start.position, &start.velocity).rows(3, 3).component_div(&moments);
    let after = spin + rate * h;
    let gain = 0.5 * (after.dot(&moments.component_mul(&after)) - spin.dot(&moments.component_mul(&spin)));
    let predicted = 0.5 * h * h * rate.dot(&rate.component_mul(&moments));
    assert!(predicted > 1e-8 && (gain - predicted).abs() <= rounding(64, 10.0));
}

/// A ball of radius 1/8 on level ground under gravity tilted by the angle α towards +x, started at rest.
fn rolling(friction: f64, angle: f64, scheme: &dyn Scheme, solver: &dyn ContactSolver, h: f64, steps: usize) -> State {
    let ball = SpatialBody::solid("ball", Shape::Sphere { radius: 0.125 }, 2.0).expect("valid");
    let gravity = [9.81 * angle.sin(), 0.0, -9.81 * angle.cos()];
    let ground = Plane::new(dvector![0.0, 0.0, 1.0], 0.0, friction, 0.0).expect("valid");
    let body = SpatialBodies::new("rolling", vec![ball], gravity, ground).expect("valid");
    let position = dvector![0.0, 0.0, 0.125, 1.0, 0.0, 0.0, 0.0];
    let start = State { time: 0.0, position, velocity: DVector::zeros(6) };
    run(scheme, solver, &body, start, h, steps, |_| ()).expect("one contact")
}

#[test]
fn a_ball_rolls_down_with_five_sevenths_of_the_pull_and_slides_beyond_the_friction_limit() {
    // Rolling needs μ ≥ 2/7 tan α: a = 5/7 g sin α, Ω̇ = a/r. Beyond: a = g (sin α − μ cos α), Ω̇ = 5/2 μ g cos α/r.
    let (angle, h, steps) = (0.35f64, 1.0 / 128.0, 64);
    let limit = 2.0 / 7.0 * angle.tan();
    for (friction, rolls) in [(1.01 * limit, true), (0.99 * limit, false)] {
        let pull = 9.81 * if rolls { 5.0 / 7.0 * angle.sin() } else { angle.sin() - friction * angle.cos() };
        let turn = if rolls { pull / 0.125 } else { 2.5 * friction * 9.81 * angle.cos() / 0.125 };
        let state = rolling(friction, angle, &MoreauJean::default(), &Auto, h, steps);
        let time = h * steps as f64;
        let world = Pose::of(0, &state.position).rotation * super::spin(0, &state.velocity);
        // Each step is solved to STOP; impulses add up.
        let bound = |size: f64| 4.0 * steps as f64 * STOP * size;
        assert!((state.velocity[0] - pull * time).abs() <= bound(pull * time), "{} against {}", state.velocity[0], pull * time);
        assert!((world - Vector3::y() * turn * time).norm() <= bound(turn * time), "{world} against {}", turn * time);
        assert!((state.position[0] - 0.5 * pull * time * time).abs() <= bound(pull * time * time), "the midpoint rule is exact here");
    }
}

/// The places (x, z) and velocities of the bodies after each of `steps` steps.
fn track(mechanism: &dyn Mechanism, start: State, scheme: &dyn Scheme, h: f64, steps: usize) -> Vec<Vec<BodyState>> {
    let mut track = Vec::new();
    run(scheme, &Auto, mechanism, start, h, steps, |step| track.push(mechanism.bodies(&step.state.position, &step.state.velocity)))
        .expect("solved");
    track
}

#[test]
fn planar_scenes_move_in_space_as_they_do_in_the_plane() {
    let moreau_jean = MoreauJean::default();
    let stewart_trinkle = StewartTrinkle { directions: 4 };
    let cases: [(&str, &dyn Scheme); 9] = [
        ("ball-drop", &moreau_jean),
        ("bouncing-ball", &moreau_jean),
        ("elastic-ball", &moreau_jean),
        ("two-ball-impact", &moreau_jean),
        ("incline-slide", &Anitescu),
        ("incline-stick", &Anitescu),
        ("incline-slide", &stewart_trinkle),
        ("incline-stick", &stewart_trinkle),
        ("box-stack", &Anitescu),
    ];
    for (name, scheme) in cases {
        let scene = named(name).expect("built in");
        let (h, steps) = (scene.duration / 64.0, 64);
        let of = |(mechanism, start): (Box<dyn Mechanism>, State)| track(mechanism.as_ref(), start, scheme, h, steps);
        let (planar, spatial) = (of(scene.mechanism().expect("planar")), of(scene.spatial_mechanism().expect("any scene")));
        // Per step the velocities are off by STOP times the step's velocities, which are below 10 m/s here, in each of the two.
        let bound = 2.0 * 10.0 * (steps * scene.bodies.len()) as f64 * STOP * 8.0;
        for (planar, spatial) in planar.iter().flatten().zip(spatial.iter().flatten()) {
            for axis in 0..3 {
                let position = (planar.position[axis] - spatial.position[axis]).abs();
                let velocity = (planar.linear_velocity[axis] - spatial.linear_velocity[axis]).abs();
                assert!(position <= bound && velocity <= bound, "{name}, {}: {planar:?} against {spatial:?}", scheme.name());
            }
        }
    }
}

/// A box, a cube and a ball that fall on a slope and on each other.
fn tumble() -> Scene {
    let text = r#"{"schema": "scene/1", "name": "tumble", "gravity": [0.5, -0.3, -9.81],
        "ground": {"normal": [0.0, 0.6, 0.8], "offset": 0},
        "bodies": [
          {"name": "slab", "box": {"half_extents": [0.2, 0.3, 0.05]}, "mass": 1.5, "position": [0, 0, 0.3],
           "angular_velocity": [1, 2, -3], "linear_velocity": [0, 0.5, -1]},
          {"name": "cube", "box": {"half_extents": [0.1, 0.1, 0.1]}, "mass": 0.5, "position": [0.05, -0.1, 0.7],
           "angular_velocity": [-4, 1, 2], "linear_velocity": [0, 0, -2]},
          {"name": "ball", "sphere": {"radius": 0.1}, "mass": 1, "position": [0.0, 0.1, 1.1], "linear_velocity": [0, 0, -3]}],
        "material": {"friction": 0.4, "restitution": 0.3}, "duration": 1}"#;
    Scene::from_json(text).expect("valid")
}

fn plastic(scene: Scene) -> Scene {
    let material = crate::scenes::Material { restitution: 0.0, ..scene.material.clone() };
    Scene { material, ..scene }
}

/// The largest component of Δp_k − m_k g h − Σ impulses on body k, over bodies and steps.
fn momentum_defect(
    mechanism: &dyn Mechanism,
    masses: &[f64],
    gravity: [f64; 3],
    states: &[State],
    impulses: &[Vec<ContactImpulse>],
    h: f64,
) -> f64 {
    let mut worst: f64 = 0.0;
    for (pair, impulses) in states.windows(2).zip(impulses) {
        for (body, mass) in masses.iter().enumerate() {
            let mut defect = (pair[1].velocity.rows(6 * body, 3) - pair[0].velocity.rows(6 * body, 3)) * *mass;
            for contact in impulses {
                let place = contact.place.expect("bodies have places");
                let impulse = place.world_impulse(&contact.impulse);
                let sign = f64::from(u8::from(place.bodies.0 == body)) - f64::from(u8::from(place.bodies.1 == Some(body)));
                (0..3).for_each(|axis| defect[axis] -= sign * impulse[axis]);
            }
            (0..3).for_each(|axis| defect[axis] -= mass * gravity[axis] * h);
            worst = worst.max(defect.amax());
        }
    }
    assert_eq!(mechanism.degrees_of_freedom(), 6 * masses.len());
    worst
}

#[test]
fn momentum_changes_by_weight_and_contact_impulses_alone_and_a_lost_impulse_shows() {
    let scene = plastic(tumble());
    let masses: Vec<f64> = scene.bodies.iter().map(|body| body.mass).collect();
    for scheme in [&MoreauJean::default() as &dyn Scheme, &StewartTrinkle::default(), &Anitescu] {
        let (mechanism, start) = scene.spatial_mechanism().expect("valid");
        let h = 1.0 / 128.0;
        let recording = simulate(scheme, &Auto, mechanism.as_ref(), start, h, 64).expect("solved");
        let contacts: usize = recording.impulses.iter().map(Vec::len).sum();
        assert!(contacts > 100, "{}: only {contacts} contacts", scheme.name());
        let defect =
            |impulses: &[Vec<ContactImpulse>]| momentum_defect(mechanism.as_ref(), &masses, scene.gravity, &recording.samples, impulses, h);
        let largest = recording
            .impulses
            .iter()
            .flatten()
            .flat_map(|contact| contact.impulse.iter())
            .fold(0.0, |most: f64, part| most.max(part.abs()));
        let bound = rounding(128, largest + 10.0);
        assert!(defect(&recording.impulses) <= bound, "{}: {}", scheme.name(), defect(&recording.impulses));
        let mut lost = recording.impulses.clone();
        lost.iter_mut().for_each(|step| step.truncate(step.len().saturating_sub(1)));
        assert!(defect(&lost) > 1e6 * bound, "{}", scheme.name());
    }
}

/// Hides that candidates out of reach may be left out.
struct Everything(Box<dyn Mechanism>);

impl Mechanism for Everything {
    fn name(&self) -> &str {
        self.0.name()
    }
    fn degrees_of_freedom(&self) -> usize {
        self.0.degrees_of_freedom()
    }
    fn rows_per_contact(&self) -> usize {
        self.0.rows_per_contact()
    }
    fn mass_matrix(&self, position: &DVector<f64>) -> DMatrix<f64> {
        self.0.mass_matrix(position)
    }
    fn force(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64> {
        self.0.force(position, velocity)
    }
    fn mean_force(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64> {
        self.0.mean_force(position, velocity, h)
    }
    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        self.0.contacts(position)
    }
    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        self.0.potential_energy(position)
    }
    fn integrate(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64> {
        self.0.integrate(position, velocity, h)
    }
    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        self.0.bodies(position, velocity)
    }
}

#[test]
fn an_answer_without_distant_candidates_is_an_answer_with_them() {
    for scheme in [&MoreauJean::default() as &dyn Scheme, &StewartTrinkle::default(), &Anitescu] {
        let scene = plastic(tumble());
        let (near, start) = scene.spatial_mechanism().expect("valid");
        let all = Everything(scene.spatial_mechanism().expect("valid").0);
        let h = 1.0 / 64.0;
        let (mut state, mut fewer) = (start, 0);
        for _ in 0..24 {
            let step = crate::schemes::step(scheme, &Auto, near.as_ref(), &state, h).expect("solved");
            let complete =
                scheme.waist().expect("one problem").assemble(&StepContext::new(&all, &state, h).expect("valid")).expect("valid");
            fewer += usize::from(step.assembled.active.len() < complete.active.len());
            if let (Some(problem), Some(few)) = (&complete.problem, &step.assembled.problem) {
                let solution = step.solution.as_ref().expect("there is a problem");
                let impulse = carry_over(&step.impulses, &complete.active, &complete.places, 3);
                let mut extended = solution.clone();
                (extended.velocity, extended.impulse) = (problem.velocity(&impulse), impulse);
                let of = |problem, solution| residuals(problem, solution).expect("valid").natural_map;
                let (natural_map, own) = (of(problem, &extended), of(few, solution));
                let size = problem.dense().amax() * solution.impulse.norm() + problem.free_velocity().amax() + problem.shift().amax();
                assert!(natural_map <= own + rounding(problem.rows(), size), "{}: {natural_map:e} with, {own:e} without", scheme.name());
            }
            state = step.state;
        }
        let chooses = scheme.name().starts_with("moreau-jean");
        assert!(chooses || fewer > 12, "{}: the test leaves out nothing", scheme.name());
    }
}

#[test]
fn a_turned_world_moves_as_the_world_does() {
    // A ball with spin bounces and slides: one contact, solved to rounding, and activation at times that no rounding decides.
    let turn = Rotation3::from_scaled_axis(Vector3::new(0.3, -1.1, 0.7));
    let motion = |turn: &Rotation3<f64>| {
        let ball = SpatialBody::solid("ball", Shape::Sphere { radius: 0.1 }, 1.0).expect("valid");
        let normal = turn * Vector3::new(0.1, 0.2, 1.0).normalize();
        let ground = Plane::new(DVector::from_column_slice(normal.normalize().as_slice()), 0.0, 0.3, 0.5).expect("valid");
        let gravity = turn * Vector3::new(0.0, 0.0, -9.81);
        let body = SpatialBodies::new("ball", vec![ball], gravity.into(), ground).expect("valid");
        let (place, speed) = (turn * Vector3::new(0.1, 0.2, 0.7), turn * Vector3::new(1.0, -0.5, 0.3));
        let quaternion = UnitQuaternion::from_rotation_matrix(turn);
        let position = dvector![place[0], place[1], place[2], quaternion.w, quaternion.i, quaternion.j, quaternion.k];
        let start = State { time: 0.0, position, velocity: dvector![speed[0], speed[1], speed[2], 5.0, -20.0, 10.0] };
        let last = run(&MoreauJean::default(), &Auto, &body, start, 1.0 / 256.0, 400, |_| ()).expect("one contact");
        body.bodies(&last.position, &last.velocity).remove(0)
    };
    let (plain, turned) = (motion(&Rotation3::identity()), motion(&turn));
    let bound = 400.0 * STOP * 20.0;
    for (one, other) in [
        (plain.position, turned.position),
        (plain.linear_velocity, turned.linear_velocity),
        (plain.angular_velocity, turned.angular_velocity),
    ] {
        assert!((turn * Vector3::from(one) - Vector3::from(other)).norm() <= bound, "{one:?} turned is not {other:?}");
    }
    assert!((Vector3::from(plain.position) - Vector3::from(turned.position)).norm() > 0.1, "the turn is no trifle");
}
