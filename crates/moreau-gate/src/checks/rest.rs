//! Bodies at rest on the floor: 0 = m g + Σ r_n/h, nothing moves.
//!
//! ```text
//!     Signorini    gap = 0 ,  v = 0 ;      a compliant law    gap = −δ  with  f(δ) = m g/n_c  on each of n_c equal contacts .
//! ```
//! The bodies are set down at the depth that the declared law predicts, so that nothing has to settle; where the depth of a rigid law is
//! asked for, they start at the surface.

use crate::check::{Control, Run};
use crate::checks::scenery::{GRAVITY, cuboid, over_floor, sphere, worst};
use crate::model::compression::LoadedPoint;
use crate::model::normal::{Arms, Normal};
use crate::model::{Model, RigidLimits};
use crate::tolerance::rest as tolerance;
use crate::tolerance::stack::sway;
use crate::{Bench, Check, Description, Expectation, Level, Measurement, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::{BodyTrack, Trajectory};
use moreau_forms::soft_rigid_contact::inverse_mass_at;
use nalgebra::{Matrix3, Vector3};

const CARRIED: &str = "A body at rest stays at rest, so that the velocity after each step is 0 up to rounding and to the solver. The \
    solver may leave a part √2⁻²³ of the impulse m g h of each step, as everywhere in the gate. Where a step takes back a part of each \
    depth by declaration, contacts open when nothing is left of it, fall for a step and are pushed out by no more than they fell: at 3/2 \
    g h at most; a box tips by that depth over its width each time.";

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "rest/drift",
        level: Level::Simulate,
        question: "Where are a sphere and a box after 1000 steps at rest?",
        derivation: CARRIED,
        source: "equilibrium of Coulomb–Signorini contact",
        run: Run::EachStep(drift),
        control: Control { passes: "moreau-jean", fails: "rest/floor-slightly-tilted" },
    },
    Check {
        name: "rest/jitter",
        level: Level::Simulate,
        question: "How fast do a sphere and a box at rest move, on average over the last 500 of 1000 steps?",
        derivation: CARRIED,
        source: "equilibrium of Coulomb–Signorini contact",
        run: Run::EachStep(jitter),
        control: Control { passes: "moreau-jean", fails: "ball/restitution-of-the-free-velocity" },
    },
    Check {
        name: "rest/depth",
        level: Level::Simulate,
        question: "How deep do a sphere and a box rest in the floor?",
        derivation: "By Signorini the depth is 0. Event capturing may leave the fall of a step, g h². A compliant law rests where its \
            force carries the weight: MuJoCo at k d² δ = (1−d) Â m g/n_c, SAP at δ = (h+τ) R_n h m g/n_c, springs at δ = m g/(n_c k), \
            with n_c = 4 for the box.",
        source: "the engines' documented force laws",
        run: Run::EachStep(depth),
        control: Control { passes: "moreau-jean", fails: "rest/undeclared-slop" },
    },
];

/// Steps, and samples: an odd number of steps apart, so that no two-cycle hides.
const STEPS: usize = 1001;
const EVERY: usize = 7;
const RADIUS: f64 = 0.1;
const HALF: [f64; 3] = [0.1, 0.15, 0.05];
const MASSES: [f64; 2] = [1.0, 2.0];
/// Smallest lever \[m\] that turns the velocity an impulse causes at its contact into an angular velocity: I/(m ℓ), 0.4 R for the sphere;
/// for the box (0.1² + 0.05²)/(3·0.1) = 0.042 about y, and more about x and z.
const TURN: f64 = 0.04;
const FRICTION: f64 = 0.5;

/// The bodies, `depths` \[m\] in the floor.
fn resting(description: &Description, depths: [f64; 2]) -> Scene {
    let ball = sphere("sphere", MASSES[0], RADIUS, [0.0, 0.0, RADIUS - depths[0]]);
    let block = cuboid("box", MASSES[1], HALF, [2.0, 0.0, HALF[2] - depths[1]]);
    let mut scene = over_floor("at rest", vec![ball, block], FRICTION);
    // What rests does not bounce, whatever e.
    scene.material.restitution = if description.restitution { 0.5 } else { 0.0 };
    scene
}

/// Least and greatest depth \[m\] of sphere and box that the declared law predicts at rest, if it predicts any.
fn predicted(description: &Description, h: f64) -> Option<[[f64; 2]; 2]> {
    let model = Model::of(description);
    let [ball, corner] = [MASSES[0], MASSES[1] / 4.0].map(|mass| mass * GRAVITY);
    if let Model::Coulomb(RigidLimits { penetration_allowance, contact_margin, .. }) = model {
        return match sprung(&model) {
            Some(depths) => Some(depths.map(|depth| [depth - penetration_allowance, depth])),
            _ if penetration_allowance > 0.0 || contact_margin > 0.0 => Some([[-contact_margin, penetration_allowance]; 2]),
            _ => None,
        };
    }
    let point = Normal::spheres(&[(MASSES[0], RADIUS)], GRAVITY, FRICTION, description.friction, h);
    let ball = point.rest_depth(&model, ball)?;
    let box_depth = |insets: [f64; 2]| {
        // The lever ends in the middle of the overlap: a contraction by δ/r ≪ 1, as in `rest_depth`.
        (0..53).try_fold(0.0, |depth, _| {
            let corner_point =
                Normal { mass: MASSES[1], inverse_masses: 1.0 / MASSES[1], arms: Arms::Fixed(corner_diagonal(insets, depth)), ..point };
            corner_point.rest_depth(&model, corner)
        })
    };
    if let Some(radius) = description.contact_model.number("corner_radius") {
        return Some([[ball; 2], [box_depth([radius; 2])?; 2]]);
    }
    // Engines that give a box feet without saying where, at most a quarter of its edges in size, load it a little inside its corners.
    let [outer, inner] = [box_depth([0.0; 2])?, box_depth([0.25 * HALF[0], 0.25 * HALF[1]])?];
    Some([[ball; 2], [inner.min(outer), inner.max(outer)]])
}

/// Depth \[m\] of sphere and box on declared springs, if there are any: where each carries its weight, a quarter of the box's at a corner.
fn sprung(model: &Model) -> Option<[f64; 2]> {
    let arm = Vector3::new(HALF[0], HALF[1], -HALF[2]);
    let at_corner = inverse_mass_at(MASSES[1], &inverse_inertia(), &arm, &Vector3::z());
    let points = [(MASSES[0], 1.0 / MASSES[0]), (MASSES[1] / 4.0, at_corner)];
    let depths =
        points.map(|(mass, inverse_mass)| model.sprung_depth(&LoadedPoint { load: mass * GRAVITY, inverse_mass, on_ground: true }));
    depths[0].zip(depths[1]).map(|(ball, block)| [ball, block])
}

/// ‖W_ii‖_F/3 \[1/kg\] of a contact under the box, so far inside its edges \[m\] and at this depth \[m\]: W = 1/m + Σ_k (a_k × r)(a_k ×
/// r)ᵀ/J_k.
fn corner_diagonal([x, y]: [f64; 2], depth: f64) -> f64 {
    let cross = Vector3::new(HALF[0] - x, HALF[1] - y, 0.5 * depth - HALF[2]).cross_matrix();
    let block = Matrix3::identity() / MASSES[1] + cross * inverse_inertia() * cross.transpose();
    block.norm() / 3.0
}

/// J⁻¹ of the solid box \[1/(kg·m²)\].
fn inverse_inertia() -> Matrix3<f64> {
    let square = Vector3::from(HALF).map(|half| half * half);
    let moments = Vector3::new(square.y + square.z, square.z + square.x, square.x + square.y) * (MASSES[1] / 3.0);
    Matrix3::from_diagonal(&moments.map(|moment| 1.0 / moment))
}

/// The motion of bodies that start where the declared law carries them (`settled`), or, if it is a rigid one, in the surface: what springs
/// it declares must then show where they settle. `surface` may put something else in the place of the floor.
fn rest(bench: &mut Bench, h: f64, settled: bool, surface: fn(Scene) -> Scene) -> Reply<Trajectory> {
    let declared = predicted(bench.description(), h).map_or([0.0; 2], |depths| depths.map(|[low, high]| 0.5 * (low + high)));
    let compliant = bench.description().contact_model.kind == crate::Kind::Compliant;
    // A rigid body starts inside the surface by as much as rounding may move it: of a gap above 0 event capturing knows nothing,
    // and a corner that opens by rounding would fall for a step, g h², and tip the box.
    let inside = tolerance::settled(STEPS, RADIUS, GRAVITY, h, bench.epsilon());
    let rigid = if settled { sprung(&Model::of(bench.description())) } else { None }.unwrap_or([inside; 2]);
    let scene = surface(resting(bench.description(), if compliant { declared } else { rigid }));
    bench.simulate(&scene, h, STEPS, EVERY)
}

fn drift(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let trajectory = rest(bench, h, true, |scene| scene)?;
    Ok(drifted(bench, &trajectory, h))
}

fn jitter(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let trajectory = rest(bench, h, true, |scene| scene)?;
    Ok(moving(bench, &trajectory, h))
}

/// Drift and jitter of the bodies where `surface` puts something else in the place of the floor.
pub(super) fn over(bench: &mut Bench, h: f64, surface: fn(Scene) -> Scene) -> Reply<Vec<Measurement>> {
    let trajectory = rest(bench, h, true, surface)?;
    Ok(drifted(bench, &trajectory, h).into_iter().chain(moving(bench, &trajectory, h)).collect())
}

fn drifted(bench: &Bench, trajectory: &Trajectory, h: f64) -> Vec<Measurement> {
    let allowed = tolerance::drift(STEPS, 2.0, GRAVITY, h, bench.epsilon());
    let taken = taken_back(bench);
    let one = |track: &BodyTrack| {
        let [start, end] = [track.position[0], track.position[track.position.len() - 1]];
        let moved = (end[0] - start[0]).hypot(end[1] - start[1]);
        // A sphere has one contact and does not tip.
        let swayed = taken.filter(|_| track.name == "box").map(|part| {
            let most = sway(part, 2.0 * HALF[2], 2.0 * HALF[0], GRAVITY, h, STEPS);
            Expectation::at_most(most, allowed, "corners whose depth is taken back open and fall")
        });
        Measurement::new(format!("drift of the {}", track.name), "m", moved, Expectation::at_most(0.0, allowed, "at rest"))
            .predicted(swayed)
    };
    trajectory.bodies.iter().map(one).collect()
}

/// The part of a depth that a step takes back by declaration, if any.
pub(super) fn taken_back(bench: &Bench) -> Option<f64> {
    match Model::of(bench.description()) {
        Model::Coulomb(limits) => Some(limits.taken_back()).filter(|part| *part > 0.0),
        _ => None,
    }
}

fn moving(bench: &Bench, trajectory: &Trajectory, h: f64) -> Vec<Measurement> {
    let allowed = tolerance::velocity(GRAVITY, h);
    let pushed = taken_back(bench).map(|_| {
        let why = "contacts whose depth is taken back open, fall and are pushed out again";
        Expectation::at_most(tolerance::pushed_velocity(GRAVITY, h), allowed, why)
    });
    let one = |track: &BodyTrack| {
        let square = |k: usize| {
            Vector3::from(track.linear_velocity[k]).norm_squared() + (Vector3::from(track.angular_velocity[k]) * TURN).norm_squared()
        };
        let late = late_half(track);
        let mean = late.clone().map(square).sum::<f64>() / late.len() as f64;
        let ideal = Expectation::at_most(0.0, allowed, "at rest");
        Measurement::new(format!("mean speed of the {}", track.name), "m/s", mean.sqrt(), ideal).predicted(pushed.clone())
    };
    trajectory.bodies.iter().map(one).collect()
}

fn late_half(track: &BodyTrack) -> std::ops::Range<usize> {
    track.position.len() / 2..track.position.len()
}

fn depth(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let trajectory = rest(bench, h, false, |scene| scene)?;
    let ideal = tolerance::gap(GRAVITY, h) + tolerance::drift(STEPS, RADIUS, GRAVITY, h, bench.epsilon());
    let model = predicted(bench.description(), h);
    let rigid = bench.description().contact_model.kind == crate::Kind::Rigid;
    let one = |(k, track): (usize, &BodyTrack)| {
        let late = late_half(track);
        let height = late.clone().map(|sample| track.position[sample][2]).sum::<f64>() / late.len() as f64;
        let found = [RADIUS, HALF[2]][k] - height;
        let law = model.map(|depths| {
            let [low, high] = depths[k];
            let accuracy = if rigid { ideal } else { tolerance::rest_depth(worst(low.abs(), high.abs()), bench.epsilon()) };
            Expectation::equal(0.5 * (low + high), 0.5 * (high - low) + accuracy, "the declared law carries the weight")
        });
        Measurement::new(format!("depth of the {}", track.name), "m", found, Expectation::equal(0.0, ideal, "g h²")).predicted(law)
    };
    Ok(trajectory.bodies.iter().enumerate().map(one).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::judge;
    use crate::runner::SWEEP;

    fn still(scene: &Scene, index: usize, moved: [f64; 3], speed: f64) -> crate::exact::RigidState {
        let place: Vec<f64> = (0..3).map(|k| scene.bodies[index].position[k] + moved[k]).collect();
        ([place[0], place[1], place[2]], [1.0, 0.0, 0.0, 0.0], [0.0, speed, 0.0], [0.0; 3])
    }

    #[test]
    fn stillness_passes_and_the_least_motion_or_depth_fails() {
        for h in SWEEP {
            let verdict = |check: &str, at_end: [f64; 3], speed: f64| {
                let measured = judge(check, h, move |scene, index, h, t| {
                    let late = if t > 100.0 * h { 1.0 } else { 0.0 };
                    still(scene, index, at_end.map(|x| late * x), late * speed)
                });
                measured.iter().map(Measurement::verdict).max().expect("measurements")
            };
            for check in CHECKS {
                assert_eq!(verdict(check.name, [0.0; 3], 0.0), Verdict::Pass, "{}", check.name);
            }
            assert_eq!(verdict("rest/drift", [0.0, 1e-3 * STEPS as f64 * GRAVITY * h * h, 0.0], 0.0), Verdict::Fail, "{h}");
            assert_eq!(verdict("rest/drift", [0.0, 1e-4 * STEPS as f64 * GRAVITY * h * h, 0.0], 0.0), Verdict::Pass, "{h}");
            assert_eq!(verdict("rest/jitter", [0.0; 3], 1e-3 * GRAVITY * h), Verdict::Fail, "{h}");
            assert_eq!(verdict("rest/jitter", [0.0; 3], 1e-4 * GRAVITY * h), Verdict::Pass, "{h}");
            assert_eq!(verdict("rest/depth", [0.0, 0.0, -1.5 * GRAVITY * h * h], 0.0), Verdict::Fail, "{h}");
        }
    }
}
