//! Two free bodies, before and after they meet: what each of them gained beside what gravity gave.
//!
//! ```text
//!     p_i = m_i (v_i⁺ − v_i⁻ − g T) ,    L_i = J_i⁺ω_i⁺ − J_i⁻ω_i⁻ :
//!     p₁ + p₂ = 0 ,    L_i = l_i × p_i ,    Σ (x_i − X) × m_i (v_i − V) + J_i ω_i = constant
//! ```
//! X and V are those of the common centre of mass, about which gravity has no moment.

use crate::checks::impact::declared;
use crate::checks::motion::{Sample, yields};
use crate::checks::pair::view::View;
use crate::checks::scenery::{over_floor, schedule};
use crate::model::Model;
use crate::model::sliding::hops;
use crate::model::solid::{box_moments, capsule_moments, cylinder_moments};
use crate::tolerance::pair as tolerance;
use crate::{Bench, Expectation, Measurement, Refusal, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use moreau_dynamics::trajectory::Trajectory;
use nalgebra::Vector3;

/// Time \[s\] in which bodies meet and come apart, compliant contacts included.
pub(in crate::checks) const DURATION: f64 = 0.2;

/// Speed of approach \[m/s\]; no engine's threshold of restitution.
pub(in crate::checks) const SPEED: f64 = 2.5;

/// Gap at the start \[m\]. It is larger than the contact margin of any engine, and not closed in a whole number of steps.
pub(in crate::checks) const GAP: f64 = 0.0473;

/// Steps of h \[s\] in which bodies meet and come apart.
pub(in crate::checks) fn steps(h: f64) -> usize {
    schedule(DURATION, 1, h).0
}

/// Bodies without gravity and ground.
pub(in crate::checks) fn in_space(name: &str, bodies: Vec<Body>, friction: f64, restitution: f64) -> Scene {
    let mut scene = Scene { ground: None, gravity: [0.0; 3], ..over_floor(name, bodies, friction) };
    scene.material.restitution = restitution;
    scene
}

/// Refuses an engine that declares damping: it changes momenta all the time, not only when bodies meet.
///
/// # Errors
/// `unsupported` with that reason.
pub(in crate::checks) fn undamped(bench: &Bench) -> Reply<()> {
    match Model::of(bench.description()).damping() {
        Some(_) => Err(Refusal::unsupported("the engine declares damping, which changes momenta before and after the bodies meet, too")),
        None => Ok(()),
    }
}

/// What one body gained.
#[derive(Clone, Copy, Debug)]
pub(in crate::checks) struct Gain {
    /// p \[N·s\].
    pub impulse: Vector3<f64>,
    /// L \[kg·m²/s\], about the body's centre.
    pub moment: Vector3<f64>,
}

/// The first two bodies of a scene before and after.
pub(in crate::checks) struct Meeting {
    pub gains: [Gain; 2],
    /// Change of the total angular momentum about the common centre of mass \[kg·m²/s\].
    turned: f64,
    /// Σ m‖v‖ \[kg·m/s\] and Σ ‖x − X‖ m‖v − V‖ + ‖J ω‖ \[kg·m²/s\] at the larger of both ends.
    sizes: [f64; 2],
    /// Distance of the surfaces \[m\] at which the contact may have acted: that of a step, and the depth of a contact that yields.
    pub apart: f64,
    /// Time \[s\] for which surfaces that yield overlapped, up to the next samples; 0 where none does.
    pub lasted: f64,
    epsilon: f64,
}

impl Meeting {
    /// Simulates bodies of which the second is [`GAP`] from the first along the unit normal n, from the first to the second, and is
    /// approached with `speed` \[m/s\] along it.
    pub fn of(bench: &mut Bench, scene: &Scene, normal: Vector3<f64>, speed: f64, h: f64) -> Reply<Self> {
        let motion = bench.simulate(scene, h, steps(h), 1)?;
        Ok(Meeting::between(bench, scene, &motion, [0, 1], normal, speed))
    }

    /// [`Meeting::of`] for a time \[s\] as seen by a view; gains are turned back, the normal is that of the scene.
    pub fn viewed(
        bench: &mut Bench,
        scene: &Scene,
        view: &View,
        (normal, speed): (Vector3<f64>, f64),
        (time, h): (f64, f64),
    ) -> Reply<Self> {
        let seen = view.of(scene);
        let motion = bench.simulate(&seen, h, schedule(time, 1, h).0, 1)?;
        Ok(Meeting::between(bench, &seen, &motion, view.pair(), view.turn * normal, speed).turned_back(view))
    }

    /// One body and the floor that it meets with `speed` \[m/s\]; its momentum and lever are of the sizes \[kg·m/s, m\].
    pub fn on_the_floor(bench: &Bench, gain: Gain, (momentum, lever): (f64, f64), speed: f64, h: f64) -> Self {
        Meeting {
            gains: [gain, Gain { impulse: -gain.impulse, moment: Vector3::zeros() }],
            turned: 0.0,
            sizes: [momentum, momentum * lever],
            apart: tolerance::apart(speed, h),
            lasted: 0.0,
            epsilon: bench.epsilon(),
        }
    }

    /// The same with gains in the frame of the scene that was seen like this.
    pub fn turned_back(mut self, view: &View) -> Self {
        let back = view.turn.inverse();
        for gain in &mut self.gains {
            *gain = Gain { impulse: back * gain.impulse, moment: back * gain.moment };
        }
        self
    }

    /// The meeting of two bodies of a motion.
    pub fn between(bench: &Bench, scene: &Scene, motion: &Trajectory, pair: [usize; 2], normal: Vector3<f64>, speed: f64) -> Self {
        let last = motion.times.len() - 1;
        let states = pair.map(|index| ends(motion, index));
        let common = [0, 1].map(|end| common_motion(pair.map(|index| scene.bodies[index].mass), [states[0][end], states[1][end]]));
        let fall = Vector3::from(scene.gravity) * motion.times[last];
        let parts = [0, 1].map(|k| Part::of(&scene.bodies[pair[k]], states[k], common, fall));
        let distance = |k: usize| {
            let [first, second] = pair.map(|index| Vector3::from(motion.bodies[index].position[k]));
            normal.dot(&(second - first))
        };
        let depths: Vec<f64> = (0..=last).map(|k| distance(0) - GAP - distance(k)).collect();
        let yielding = if yields(bench) { depths.iter().copied().fold(0.0, f64::max) } else { 0.0 };
        let overlapped = if yields(bench) { depths.iter().filter(|depth| **depth > 0.0).count() + 1 } else { 0 };
        let size = |part: usize| parts.iter().map(|one| one.sizes[part]).sum();
        Meeting {
            gains: parts.each_ref().map(|part| part.gain),
            turned: parts.iter().map(|part| part.turned).sum::<Vector3<f64>>().norm(),
            sizes: [size(0), size(1)],
            apart: tolerance::apart(speed, motion.time_step) + yielding,
            lasted: overlapped as f64 * motion.time_step,
            epsilon: bench.epsilon(),
        }
    }

    /// Both momenta; angular ones are uncertain by `slack` \[kg·m²/s\] here and below.
    pub fn momenta(&self, words: &str, slack: f64) -> [Measurement; 2] {
        let change = (self.gains[0].impulse + self.gains[1].impulse).norm();
        let linear = tolerance::momentum(self.gains[1].impulse.norm(), self.sizes[0], self.epsilon);
        let angular = tolerance::angular(slack, self.sizes[1], self.epsilon);
        [
            Measurement::new(
                format!("change of momentum{words}"),
                "kg*m/s",
                change,
                Expectation::at_most(0.0, linear, "impulses are opposite"),
            ),
            Measurement::new(
                format!("change of angular momentum{words}"),
                "kg*m^2/s",
                self.turned,
                Expectation::at_most(0.0, angular, "impulses are opposite and act at one point"),
            ),
        ]
    }

    /// ‖L_i − l_i × p_i‖ of both bodies, with their levers l_i \[m\].
    pub fn moments(&self, words: &str, levers: [Vector3<f64>; 2], slack: f64) -> [Measurement; 2] {
        let allowed = tolerance::angular(slack, self.sizes[1], self.epsilon);
        [0, 1].map(|k| {
            let Gain { impulse, moment } = self.gains[k];
            Measurement::new(
                format!("turn of the {} body without its impulse times lever{words}", ["first", "second"][k]),
                "kg*m^2/s",
                (moment - levers[k].cross(&impulse)).norm(),
                Expectation::at_most(0.0, allowed, "L = l × p"),
            )
        })
    }
}

/// Speed \[m/s\] by which a contact may open by its slip, given μ times that \[m/s\]: under an associated law, or one that is like it.
pub(in crate::checks) fn opening(bench: &Bench, slip: f64) -> f64 {
    if hops(bench.description()) { slip } else { 0.0 }
}

/// Time \[s\] for which two bodies may touch while they meet: a step and the one before, or as long as a contact that yields lasts.
pub(in crate::checks) fn lasting(bench: &Bench, h: f64) -> f64 {
    if yields(bench) { DURATION } else { h }
}

/// e of an impact at this speed \[m/s\], from its impulse, under what a compliant law returns or a rigid one declares.
pub(in crate::checks) fn returned(
    bench: &Bench,
    h: f64,
    (words, e): (&str, f64),
    (value, speed): (f64, f64),
    later: f64,
    compliant: Option<Expectation>,
) -> Measurement {
    let allowed = tolerance::ratio(bench.epsilon()) + later;
    let law = compliant.or_else(|| declared(bench, e, speed, allowed, h));
    let ideal = Expectation::equal(e, allowed, "W_n p = (1 + e) |u_n|");
    Measurement::new(format!("restitution{words}"), "1", value, ideal).predicted(law)
}

/// What a body gained from the first to the last sample of a motion.
pub(in crate::checks) fn gained(scene: &Scene, motion: &Trajectory, index: usize) -> Gain {
    let time = motion.times.last().copied().unwrap_or(0.0);
    // the gain does not depend on what the angular momentum is about
    Part::of(&scene.bodies[index], ends(motion, index), [[Vector3::zeros(); 2]; 2], Vector3::from(scene.gravity) * time).gain
}

fn ends(motion: &Trajectory, index: usize) -> [Sample; 2] {
    [0, motion.times.len() - 1].map(|k| Sample::of(&motion.bodies[index], k))
}

/// One body of a meeting.
struct Part {
    gain: Gain,
    /// Change of its angular momentum about the common centre of mass.
    turned: Vector3<f64>,
    sizes: [f64; 2],
}

impl Part {
    /// Given position and velocity of the common centre of mass at both ends, and what gravity adds to every velocity between them.
    fn of(body: &Body, ends: [Sample; 2], common: [[Vector3<f64>; 2]; 2], fall: Vector3<f64>) -> Self {
        let moments = moments_of(body);
        let own = ends.map(|end| end.rotation * (end.rotation.inverse() * end.spin).component_mul(&moments));
        let [arms, speeds] = [[0, 1].map(|k| ends[k].position - common[k][0]), [0, 1].map(|k| ends[k].velocity - common[k][1])];
        let about = |k: usize| arms[k].cross(&(speeds[k] * body.mass)) + own[k];
        let size = |k: usize| [body.mass * ends[k].velocity.norm(), arms[k].norm() * body.mass * speeds[k].norm() + own[k].norm()];
        let impulse = (ends[1].velocity - ends[0].velocity - fall) * body.mass;
        Part {
            gain: Gain { impulse, moment: own[1] - own[0] },
            turned: about(1) - about(0),
            sizes: [0, 1].map(|part| size(0)[part].max(size(1)[part])),
        }
    }
}

/// X \[m\] and V \[m/s\] of two bodies.
fn common_motion(masses: [f64; 2], states: [Sample; 2]) -> [Vector3<f64>; 2] {
    let mean = |parts: [Vector3<f64>; 2]| (parts[0] * masses[0] + parts[1] * masses[1]) / (masses[0] + masses[1]);
    [mean(states.map(|state| state.position)), mean(states.map(|state| state.velocity))]
}

/// Principal moments of a body \[kg·m²\]: the given ones, or those of the solid.
pub(in crate::checks) fn moments_of(body: &Body) -> Vector3<f64> {
    if let Some(given) = body.inertia {
        return given.into();
    }
    match (&body.sphere, &body.cuboid, &body.capsule, &body.cylinder) {
        (_, Some(cuboid), ..) => box_moments(body.mass, cuboid.half_extents.into()),
        (_, _, Some(capsule), _) => capsule_moments(body.mass, [capsule.radius, capsule.half_height]),
        (_, _, _, Some(cylinder)) => cylinder_moments(body.mass, [cylinder.radius, cylinder.half_height]),
        (sphere, ..) => Vector3::repeat(sphere.map_or(0.0, |sphere| 0.4 * body.mass * sphere.radius * sphere.radius)),
    }
}
