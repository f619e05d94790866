//! Metamorphic checks: no exact motion is needed, only that a transformed scene moves in the transformed way.
//!
//! ```text
//!     simulate(T scene) = T simulate(scene)      T: rotation, mirror image, translation, change of units, order of the bodies, boost
//! ```
//! A scheme is covariant when every number it decides by is: no world axis, no absolute threshold, no order of a list.

mod allowance;
mod compare;
mod halving;
mod opened;
mod scenes;
mod transform;
mod units;

use crate::check::{Control, Expected, Run};
use crate::checks::scenery::{GRAVITY, schedule};
use crate::description::Friction;
use crate::model::Model;
use crate::tolerance::metamorphic as tolerance;
use crate::{Bench, Check, Expectation, Level, Measurement, Reply, Verdict};
use allowance::{SAMPLES, allowance};
use compare::{Differences, difference};
use moreau_dynamics::scenes::Scene;
use opened::{opened, opening};
use scenes::{ARM, DURATION, FRICTION, SPEED};
use transform::Transform;

/// Where the allowances come from, for every check of the family.
const SOLVED: &str = "The exact motions correspond. A covariant scheme repeats the same arithmetic up to rounding. Its solver leaves at \
    most a part √2⁻²³ of every change of velocity, and these changes add up to 2 (speed + g T). The errors do not grow from step to \
    step. A contact whose depth is taken back by declaration opens in one motion and not in the other when less than that is left of the \
    depth: both move at up to 3/2 g h then, level by level.";

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "metamorphic/rotation",
        level: Level::Simulate,
        question: "Does a scene turned about the vertical move as the original does, turned?",
        derivation: SOLVED,
        source: "isotropy of Coulomb's law about the normal; with d friction directions the forces differ by at most 2 sin(π/d) μ r_n",
        run: Run::EachStep(|bench, h| covariant(bench, h, Transform::rotation([0.0, 0.0, 1.0], 0.5))),
        control: Control { passes: "moreau-jean", fails: "metamorphic/friction-along-axes" },
    },
    Check {
        name: "metamorphic/tilt",
        level: Level::Simulate,
        question: "Does a scene turned with its gravity and ground about a slanting axis move as the original does, turned?",
        derivation: SOLVED,
        source: "isotropy of space",
        run: Run::EachStep(|bench, h| covariant(bench, h, Transform::rotation([1.0, 2.0, -1.0], 0.7))),
        control: Control { passes: "moreau-jean", fails: "metamorphic/friction-along-axes" },
    },
    Check {
        name: "metamorphic/mirror",
        level: Level::Simulate,
        question: "Does the mirror image of a scene move as the mirror image of its motion?",
        derivation: SOLVED,
        source: "rigid bodies in contact know no right or left: ω is axial, friction is symmetric",
        run: Run::EachStep(|bench, h| covariant(bench, h, Transform::mirror())),
        control: Control { passes: "moreau-jean", fails: "metamorphic/direction-rounded-down" },
    },
    Check {
        name: "metamorphic/translation",
        level: Level::Simulate,
        question: "Does a scene moved by metres, and by a kilometre, move as the original does?",
        derivation: "As for a rotation; at a distance L positions are spaced ε L apart, which adds ε L in each of T/h steps, and ε L/h \
                     to a velocity that is made from gaps.",
        source: "homogeneity of space",
        run: Run::EachStep(translation),
        control: Control { passes: "moreau-jean", fails: "metamorphic/single-precision-positions" },
    },
    Check {
        name: "metamorphic/units",
        level: Level::Simulate,
        question: "Does a scene move as the original does when it is written in millimetres and grams, and also in milliseconds?",
        derivation: "Every number of the scene, the step and the engine's declared parameters are converted by their units. The \
            allowance is that of a rotation. A threshold that is not declared as a physical number is not converted, and the difference \
            shows it.",
        source: "dimensional homogeneity",
        run: Run::EachStep(units::run),
        control: Control { passes: "moreau-jean", fails: "metamorphic/absolute-speed-limit" },
    },
    Check {
        name: "metamorphic/body-order",
        level: Level::Simulate,
        question: "Does a pile of boxes move in the same way when its bodies are listed in reverse?",
        derivation: SOLVED,
        source: "the problem of a step has no order; a sweep over contacts that stops early has one",
        run: Run::EachStep(body_order),
        control: Control { passes: "moreau-jean", fails: "solver/three-sweeps" },
    },
    Check {
        name: "metamorphic/galilean",
        level: Level::Simulate,
        question: "Do two spheres collide in the same way in a frame that moves uniformly?",
        derivation: "As for a rotation. A declared linear damping c acts in the world frame: the frame is left behind by V (1 − e^(−cT)) \
                     in velocity and V (T − (1 − e^(−cT))/c) in position.",
        source: "Galilean invariance",
        run: Run::EachStep(galilean),
        control: Control { passes: "moreau-jean", fails: "metamorphic/damping-in-the-world" },
    },
    Check {
        name: "metamorphic/halving",
        level: Level::Simulate,
        question: "Does half the time step change the motion of landing and sliding bodies by no more than C h?",
        derivation: "Friction takes μ times the normal impulse whatever the step, and the normal impulse stops the body: the horizontal \
                     velocity may differ by 3/2 μ g h. Each position is off by at most 2 h v from the landing at v and h times the \
                     variation of the velocity; the difference of h and h/2 is at most 3/2 of that. Anitescu's relaxation hovers at \
                     μ h ‖v_t‖, which is of that size; a compliant floor lets the landing body \
                     rebound, or hop at up to μ‖v_t‖, which friction takes as normal impulse.",
        source: "first order of event capturing",
        run: Run::EachStep(halving::run),
        control: Control { passes: "moreau-jean", fails: "metamorphic/damping-per-step" },
    },
];

const FACETS: &str = "d friction directions: forces in two frames differ by up to 2 sin(π/d) μ r_n; d = 8, with the slide of one frame \
    nearer to \
                      a direction than that of the other";

/// The derived verdicts that are not `pass`.
pub const EXPECTED: &[Expected] = &[
    Expected { scheme: "stewart-trinkle", check: "metamorphic/rotation", verdict: Verdict::Difference, why: FACETS },
    Expected { scheme: "stewart-trinkle", check: "metamorphic/tilt", verdict: Verdict::Difference, why: FACETS },
];

/// Runs a scene.
fn motion(bench: &mut Bench, scene: &Scene, h: f64) -> Reply<moreau_dynamics::trajectory::Trajectory> {
    let (steps, every) = schedule(DURATION, SAMPLES, h);
    bench.simulate(scene, h, steps, every)
}

/// The differences between a scene and its image, as measurements.
fn covariant(bench: &mut Bench, h: f64, transform: Transform) -> Reply<Vec<Measurement>> {
    let original = motion(bench, &scenes::slide(), h)?;
    let image = motion(bench, &transform.scene(&scenes::slide()), h)?;
    let differences = difference(&original, &transform.undo(&image));
    Ok(differences.measured("", allowance(), law(bench, h, 1)))
}

/// How far two motions may be apart by declaration: where friction has preferred directions, and where a step takes back depths of up to so
/// many `levels`.
fn law(bench: &Bench, h: f64, levels: usize) -> Option<Differences> {
    let velocity = anisotropy(bench).unwrap_or(0.0) + opening(bench, h, levels).unwrap_or(0.0);
    (velocity > 0.0).then(|| Differences::of_velocity(velocity, DURATION, ARM))
}

/// The velocity \[m/s\] by which declared friction without symmetry about the normal may tell two directions apart. The normal impulse per
/// mass is that of the fall, with one hop at up to μ times the speed.
fn anisotropy(bench: &Bench) -> Option<f64> {
    let directions = match Model::of(bench.description()) {
        Model::StewartTrinkle { directions } => Some(directions),
        _ if bench.description().friction == Friction::Pyramid => None,
        _ => return None,
    };
    let normal_impulse = SPEED + GRAVITY * DURATION + FRICTION * SPEED;
    Some(tolerance::anisotropy(directions, FRICTION, normal_impulse))
}

fn translation(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let original = motion(bench, &scenes::slide(), h)?;
    let mut measurements = Vec::new();
    for (words, offset) in [(", moved by metres", [3.7, -2.1, 0.8]), (", moved by a kilometre", [600.0, -800.0, 3.0])] {
        let transform = Transform::translation(offset);
        let image = motion(bench, &transform.scene(&scenes::slide()), h)?;
        let near = allowance();
        let (far, epsilon) = (transform.offset.norm(), bench.epsilon());
        let velocity = near.velocity + tolerance::far_velocity(epsilon, far, DURATION, h);
        let position = near.position + tolerance::far_position(epsilon, far, DURATION, h);
        let allowed = Differences { position, ..Differences::of_velocity(velocity, DURATION, ARM) };
        measurements.extend(difference(&original, &transform.undo(&image)).measured(words, allowed, opened(bench, h)));
    }
    Ok(measurements)
}

fn body_order(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let original = motion(bench, &scenes::pile(), h)?;
    let mut reversed = scenes::pile();
    reversed.bodies.reverse();
    let image = motion(bench, &reversed, h)?;
    let levels = scenes::pile().bodies.len();
    Ok(difference(&original, &image).measured("", allowance(), law(bench, h, levels)))
}

/// Velocity \[m/s\] of the moving frame.
const BOOST: [f64; 3] = [3.0, -2.0, 1.0];

fn galilean(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let original = motion(bench, &scenes::collision(), h)?;
    let transform = Transform::boost(BOOST);
    let image = motion(bench, &transform.scene(&scenes::collision()), h)?;
    let speed = transform.boost.norm();
    let velocity = tolerance::velocity(SPEED + speed, 0.0, DURATION);
    let allowed = Differences::of_velocity(velocity, DURATION, ARM);
    let mut measurements = difference(&original, &transform.undo(&image)).measured("", allowed, None);
    if let Model::Coulomb(limits) = Model::of(bench.description())
        && limits.linear_damping > 0.0
    {
        let last = original.times.last().copied().unwrap_or(DURATION);
        let [velocity, position] = tolerance::damped_frame(speed, limits.linear_damping, last, h);
        let predictions = [(position, allowed.position), (velocity, allowed.velocity)];
        for (measurement, ((value, error), solved)) in measurements.iter_mut().zip(predictions) {
            measurement.model = Some(Expectation::equal(value, error + solved, "the declared linear damping acts in the world frame"));
        }
    }
    Ok(measurements)
}
