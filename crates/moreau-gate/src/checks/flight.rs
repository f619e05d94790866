//! Free flight: no contact, so every engine owes the mechanics of a rigid body, whatever its contact model.
//!
//! ```text
//!     p(t) = p₀ + m g t ,     x(t) = x₀ + v₀ t + ½ g t² ,     L = R J Rᵀ ω  constant ,     J Ω̇ + Ω × J Ω = 0 .
//! ```

use crate::check::{Control, Run};
use crate::checks::scenery::{GRAVITY, cuboid, over_floor, schedule, sphere};
use crate::model::solid::box_moments;
use crate::model::{Model, damping, springs};
use crate::tolerance::flight as tolerance;
use crate::{Bench, Check, Expectation, Level, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use moreau_dynamics::trajectory::{BodyTrack, Trajectory};
use moreau_forms::free_top::{FreeTop, Spin};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "flight/projectile",
        level: Level::Simulate,
        question: "Does a thrown body follow its parabola?",
        derivation: "v(t) = v₀ + g t is exact for every one-step method. A position update with θ v⁺ + (1−θ) v is off by (θ − ½) g h t: \
            by ½ g h t for the Euler rules, and by 0 for the trapezoidal rule. Across gravity no update is off.",
        source: "elementary ballistics",
        run: Run::EachStep(projectile),
        control: Control { passes: "moreau-jean", fails: "flight/half-g-h-squared-twice" },
    },
    Check {
        name: "flight/momentum",
        level: Level::Simulate,
        question: "Do free bodies keep their momentum and, about their principal axes, their angular momentum?",
        derivation: "Without forces p = Σ m v and L = Σ (m x × v + R J Rᵀ ω) are constant; a spin about a principal axis is steady, so \
            only \
                     rounding remains. Under gravity p(t) = p₀ + m g t.",
        source: "Newton's second law, summed over the bodies",
        run: Run::EachStep(momentum),
        control: Control { passes: "moreau-jean", fails: "flight/undeclared-damping" },
    },
    Check {
        name: "flight/spinning-box",
        level: Level::Simulate,
        question: "Does a box spun about its middle axis tumble as Euler's equations say?",
        derivation: "The motion is integrated to high order, together with a bound of the error of first-order steps: e' = m e + ½h‖Ω̈‖ \
            with the logarithmic norm m of Euler's equations. It bounds the errors of ω, of R J Rᵀ ω and of ½ ωᵀ R J Rᵀ ω.",
        source: "Landau and Lifshitz, Mechanics, §36–37; Dahlquist's bound by the logarithmic norm",
        run: Run::EachStep(spinning_box),
        control: Control { passes: "moreau-jean", fails: "flight/no-gyroscopic-term" },
    },
];

/// Time of flight \[s\].
const FLIGHT: f64 = 0.6;

/// A scene without ground.
fn in_space(name: &str, bodies: Vec<Body>, gravity: f64) -> Scene {
    Scene { ground: None, gravity: [0.0, 0.0, -gravity], ..over_floor(name, bodies, 0.0) }
}

fn thrown() -> Scene {
    let ball = sphere("ball", 2.0, 0.1, [0.0, 0.0, 10.0]);
    in_space("projectile", vec![Body { linear_velocity: [3.0, -2.0, 4.0], ..ball }], GRAVITY)
}

fn projectile(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let scene = thrown();
    let (steps, every) = schedule(FLIGHT, 4, h);
    let end = End::of(&bench.simulate(&scene, h, steps, every)?.bodies[0]);
    let body = &scene.bodies[0];
    let [start, velocity, gravity] = [body.position, body.linear_velocity, scene.gravity].map(Vector3::from);
    let time = steps as f64 * h;
    let (path, exact) = damping::flight(0.0, &gravity, &velocity, time);
    let (off, epsilon) = (end.position - start - path, bench.epsilon());
    let (size, speed) = (start.norm() + velocity.norm() * time, velocity.norm() + GRAVITY * time);
    let parts = steps * springs::substeps(&bench.description().contact_model, h);
    let [rounded, rounded_speed] = [size, speed].map(|size| tolerance::rounding(parts, size, epsilon));
    let position = Expectation::at_most(0.0, tolerance::position(GRAVITY, h, time) + rounded, "½ g h t of a first order update");
    let across = Expectation::at_most(0.0, rounded + time * rounded_speed, "no force across gravity");
    let falling = Expectation::at_most(0.0, rounded_speed, "constant force: every step is exact");
    let mut measured = vec![
        Measurement::new("position error", "m", off.norm(), position),
        Measurement::new("position error across gravity", "m", off.xy().norm(), across),
        Measurement::new("velocity error", "m/s", (end.velocity - exact).norm(), falling),
    ];
    if let Some((linear, _)) = Model::of(bench.description()).damping() {
        let (damped, slowed) = damping::flight(linear, &gravity, &velocity, time);
        let moved = tolerance::damped_position(linear, GRAVITY, speed, time, h) + rounded;
        let slower = tolerance::damped_velocity(linear, GRAVITY, speed, time, h) + rounded_speed;
        let predictions = [((damped - path).norm(), moved), ((damped - path).xy().norm(), moved), ((slowed - exact).norm(), slower)];
        for (measurement, (value, allowed)) in measured.iter_mut().zip(predictions) {
            measurement.model = Some(Expectation::equal(value, allowed, DAMPED));
        }
    }
    Ok(measured)
}

const DAMPED: &str = "the declared damping";

fn two_bodies(gravity: f64) -> Scene {
    let ball = sphere("ball", 2.0, 0.1, [0.0, 0.0, 10.0]);
    let block = cuboid("box", 1.0, [0.1, 0.2, 0.3], [3.0, 0.0, 10.0]);
    let ball = Body { linear_velocity: [3.0, -2.0, 4.0], angular_velocity: [2.0, 5.0, -1.0], ..ball };
    let block = Body { linear_velocity: [1.0, 2.0, 0.0], angular_velocity: [4.0, 0.0, 0.0], ..block };
    in_space("two free bodies", vec![ball, block], gravity)
}

fn momentum(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let (steps, every) = schedule(FLIGHT, 4, h);
    let time = steps as f64 * h;
    let [free, falling] = [0.0, GRAVITY].map(|gravity| {
        let scene = two_bodies(gravity);
        bench.simulate(&scene, h, steps, every).map(|trajectory| Momenta::of(&scene, &trajectory))
    });
    let (free, falling) = (free?, falling?);
    let weight = Vector3::new(0.0, 0.0, -GRAVITY * free.mass * time);
    let [drift, turned, pulled] = [free.linear, free.angular, falling.linear].map(|[before, after]| after - before);
    let epsilon = bench.epsilon();
    let parts = steps * springs::substeps(&bench.description().contact_model, h);
    let rounded = tolerance::rounding(parts, free.size[0] + weight.norm(), epsilon);
    let turning = tolerance::turning(parts, epsilon) * free.size[1];
    let mut measured = vec![
        Measurement::new("change of momentum", "kg*m/s", drift.norm(), Expectation::at_most(0.0, rounded, "no force")),
        Measurement::new("change of angular momentum", "kg*m^2/s", turned.norm(), Expectation::at_most(0.0, turning, "no torque")),
        Measurement::new("momentum less p0 + m g t", "kg*m/s", (pulled - weight).norm(), Expectation::at_most(0.0, rounded, "p' = m g")),
    ];
    if let Some(rates) = Model::of(bench.description()).damping() {
        for (measurement, (value, error)) in measured.iter_mut().zip(free.damped(rates, &weight, time, h)) {
            let allowed = error + measurement.ideal.tolerance;
            measurement.model = Some(Expectation::equal(value, allowed, DAMPED));
        }
    }
    Ok(measured)
}

/// Momenta at the first and last sample.
struct Momenta {
    mass: f64,
    linear: [Vector3<f64>; 2],
    angular: [Vector3<f64>; 2],
    /// Orbital and spin part of the angular momentum at the start.
    parts: [Vector3<f64>; 2],
    /// Σ m|v| and Σ (m|x||v| + |J||ω|), the largest of both samples: what rounding is relative to.
    size: [f64; 2],
}

impl Momenta {
    fn of(scene: &Scene, trajectory: &Trajectory) -> Self {
        let mut found = Momenta {
            mass: 0.0,
            linear: [Vector3::zeros(); 2],
            angular: [Vector3::zeros(); 2],
            parts: [Vector3::zeros(); 2],
            size: [0.0; 2],
        };
        for (body, track) in scene.bodies.iter().zip(&trajectory.bodies) {
            let moments = solid_moments(body);
            found.mass += body.mass;
            let states = [End::at(track, 0), End::of(track)];
            for (k, state) in states.iter().enumerate() {
                let spin = state.orientation * moments.component_mul(&(state.orientation.inverse() * state.angular_velocity));
                let orbital = state.position.cross(&state.velocity) * body.mass;
                found.linear[k] += state.velocity * body.mass;
                found.angular[k] += spin + orbital;
                if k == 0 {
                    found.parts[0] += orbital;
                    found.parts[1] += spin;
                }
            }
            let most = |of: fn(&End) -> f64| of(&states[0]).max(of(&states[1]));
            let (speed, reach) = (most(|state| state.velocity.norm()), most(|state| state.position.norm()));
            found.size[0] += body.mass * speed;
            found.size[1] += body.mass * speed * reach + moments.max() * most(|state| state.angular_velocity.norm());
        }
        found
    }

    /// (value, error of first order) of the three measurements under damping of (linear, angular) rates: the orbital and the spin part of
    /// the angular momentum decay at their own rates, since a path that is straight stays so.
    fn damped(&self, (linear, angular): (f64, f64), weight: &Vector3<f64>, time: f64, h: f64) -> [(f64, f64); 3] {
        let lost = |rate: f64| -(-rate * time).exp_m1();
        let (_, slowed) = damping::flight(linear, &(weight / time), &self.linear[0], time);
        let angular_loss = self.parts[0] * lost(linear) + self.parts[1] * lost(angular);
        let error = |size: f64| tolerance::damped_velocity(linear.max(angular), weight.norm() / time, size, time, h);
        let turning = tolerance::damped_velocity(linear.max(angular), 0.0, self.size[1], time, h);
        [
            (self.linear[0].norm() * lost(linear), error(self.size[0])),
            (angular_loss.norm(), turning),
            ((slowed - self.linear[0] - weight).norm(), error(self.size[0] + weight.norm())),
        ]
    }
}

/// Duration of the tumbling \[s\]: long enough for the axis to leave its place, short enough for the bound to tell.
const TUMBLING: f64 = 0.4;

fn spun() -> Scene {
    let block = cuboid("box", 1.0, [0.1, 0.2, 0.3], [0.0, 0.0, 10.0]);
    in_space("spinning box", vec![Body { angular_velocity: [1.0, 3.0, 1.0], ..block }], 0.0)
}

fn spinning_box(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let scene = spun();
    let body = &scene.bodies[0];
    let (steps, _) = schedule(TUMBLING, 1, h);
    let end = End::of(&bench.simulate(&scene, h, steps, steps)?.bodies[0]);
    let top = FreeTop { moments: solid_moments(body) };
    let start = Spin { orientation: UnitQuaternion::identity(), body_rate: Vector3::from(body.angular_velocity) };
    let time = steps as f64 * h;
    let path = top.path(start, time, tolerance::TOP_STEPS);
    let rates: Vec<_> = path.iter().map(|spin| spin.body_rate).collect();
    let bound = tolerance::tumbling(&top.moments, &rates, time / tolerance::TOP_STEPS as f64);
    let exact = path[path.len() - 1].angular_velocity();
    let reached = Spin { orientation: end.orientation, body_rate: end.orientation.inverse() * end.angular_velocity };
    let (momentum, energy, speed) = (top.momentum(&start), top.energy(&start), exact.norm());
    let parts = steps * springs::substeps(&bench.description().contact_model, h);
    let noise = tolerance::top_reference(time, speed) + tolerance::turning(parts, bench.epsilon());
    let [rate, angle] = [bound.body_rate * h + noise * speed, bound.angle * h + noise];
    // Errors of L = R J Ω and of the energy, to second order in e_Ω.
    let turned = top.moments.max() * rate + momentum.norm() * angle;
    let work = momentum.norm() * rate + 0.5 * top.moments.max() * rate * rate;
    let ideal = |value: f64, allowed: f64| Expectation::equal(value, allowed, "first order in h, integrated along the motion");
    let mut measured = vec![
        Measurement::new("error of the angular velocity", "rad/s", (end.angular_velocity - exact).norm(), ideal(0.0, rate + speed * angle)),
        Measurement::new("change of angular momentum", "kg*m^2/s", (top.momentum(&reached) - momentum).norm(), ideal(0.0, turned)),
        Measurement::new("change of kinetic energy", "J", top.energy(&reached) - energy, ideal(0.0, work)),
    ];
    if let Some((_, damping)) = Model::of(bench.description()).damping().filter(|(_, angular)| *angular > 0.0) {
        // Ω(t) = e^{−ct} Ω̃(s) with the undamped motion Ω̃ and s = (1 − e^{−ct})/c solves J Ω̇ = J Ω × Ω − c J Ω, on the same path R.
        let (left, clock) = ((-damping * time).exp(), -(-damping * time).exp_m1() / damping);
        let path = top.path(start, clock, tolerance::TOP_STEPS);
        let slowed = path[path.len() - 1].angular_velocity() * left;
        let slower = tolerance::damped_velocity(damping, 0.0, 1.0, time, h);
        let values = [(slowed - exact).norm(), (1.0 - left) * momentum.norm(), (left * left - 1.0) * energy];
        let sizes = [speed, momentum.norm(), 2.0 * energy];
        for (measurement, (value, size)) in measured.iter_mut().zip(values.into_iter().zip(sizes)) {
            let allowed = measurement.ideal.tolerance + slower * size;
            measurement.model = Some(Expectation::equal(value, allowed, DAMPED));
        }
    }
    Ok(measured)
}

/// State of a body at a sample.
struct End {
    position: Vector3<f64>,
    velocity: Vector3<f64>,
    orientation: UnitQuaternion<f64>,
    angular_velocity: Vector3<f64>,
}

impl End {
    fn of(track: &BodyTrack) -> Self {
        End::at(track, track.position.len() - 1)
    }

    fn at(track: &BodyTrack, k: usize) -> Self {
        let [w, x, y, z] = track.orientation[k];
        End {
            position: track.position[k].into(),
            velocity: track.linear_velocity[k].into(),
            orientation: UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)),
            angular_velocity: track.angular_velocity[k].into(),
        }
    }
}

/// J of the solid: ⅖ m r² of a sphere, ⅓ m (b² + c²) of a box with half extents a, b, c \[kg·m²\].
fn solid_moments(body: &Body) -> Vector3<f64> {
    match (&body.sphere, &body.cuboid) {
        (Some(sphere), _) => Vector3::repeat(0.4 * body.mass * sphere.radius * sphere.radius),
        (_, Some(cuboid)) => box_moments(body.mass, cuboid.half_extents.into()),
        _ => Vector3::zeros(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{RigidState, judge};
    use crate::runner::SWEEP;

    fn exact(scene: &Scene, index: usize, theta: f64, h: f64, t: f64) -> RigidState {
        let body = &scene.bodies[index];
        let [start, velocity, gravity, rate] =
            [body.position, body.linear_velocity, scene.gravity, body.angular_velocity].map(Vector3::from);
        let (path, velocity) = damping::flight(0.0, &gravity, &velocity, t);
        let top = FreeTop { moments: solid_moments(body) };
        let spin = Spin { orientation: UnitQuaternion::identity(), body_rate: rate };
        let end = *top.path(spin, t, tolerance::TOP_STEPS).last().expect("a path has an end");
        let q = end.orientation;
        let position = start + path + gravity * ((theta - 0.5) * h * t);
        (position.into(), [q.w, q.i, q.j, q.k], velocity.into(), end.angular_velocity().into())
    }

    fn verdicts(check: &str, motion: impl Fn(&Scene, usize, f64, f64) -> RigidState + Send + Copy) -> Vec<Verdict> {
        let worst = |h: &f64| judge(check, *h, motion).iter().map(Measurement::verdict).max().expect("measurements");
        SWEEP.iter().map(worst).collect()
    }

    #[test]
    fn exact_motion_and_both_euler_rules_pass_at_every_step() {
        for check in CHECKS {
            for theta in [0.0, 0.5, 1.0] {
                let found = verdicts(check.name, |scene, index, h, t| exact(scene, index, theta, h, t));
                assert!(found.iter().all(|verdict| *verdict == Verdict::Pass), "{} θ = {theta}: {found:?}", check.name);
            }
        }
    }

    #[test]
    fn an_update_worse_than_the_euler_rules_fails_at_every_step() {
        for theta in [-0.1, 1.1] {
            let found = verdicts("flight/projectile", |scene, index, h, t| exact(scene, index, theta, h, t));
            assert!(found.iter().all(|verdict| *verdict == Verdict::Fail), "{found:?}");
        }
    }

    #[test]
    fn a_constant_angular_velocity_is_no_tumbling_at_any_step() {
        let steady = |scene: &Scene, index: usize, h: f64, t: f64| {
            let rate = Vector3::from(scene.bodies[index].angular_velocity);
            let q = UnitQuaternion::from_scaled_axis(rate * t);
            let (position, _, velocity, _) = exact(scene, index, 0.5, h, t);
            (position, [q.w, q.i, q.j, q.k], velocity, rate.into())
        };
        assert!(verdicts("flight/spinning-box", steady).iter().all(|verdict| *verdict == Verdict::Fail));
    }

    #[test]
    fn the_bound_is_kept_by_euler_steps_and_is_of_their_size() {
        let top = FreeTop { moments: solid_moments(&spun().bodies[0]) };
        let start = Spin { orientation: UnitQuaternion::identity(), body_rate: Vector3::new(1.0, 3.0, 1.0) };
        for h in [1.0 / 60.0, 1e-3] {
            let steps = schedule(TUMBLING, 1, h).0;
            let time = steps as f64 * h;
            let path = top.path(start, time, tolerance::TOP_STEPS);
            let rates: Vec<_> = path.iter().map(|spin| spin.body_rate).collect();
            let bound = h * tolerance::tumbling(&top.moments, &rates, time / tolerance::TOP_STEPS as f64).body_rate;
            let explicit = (0..steps).fold(start.body_rate, |rate, _| rate + top.body_acceleration(&rate) * h);
            let error = (explicit - rates[rates.len() - 1]).norm();
            assert!(error <= bound && bound <= 32.0 * error, "h = {h}: {error} against {bound}");
        }
    }
}
