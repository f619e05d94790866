//! What the poses of every answer must keep, whatever a check looks at.
//!
//! ```text
//!     x_0 = the scene's own, q_0 = ± the scene's own                                                of every body
//!     ‖Σ d_k‖ ≤ ½ Σ h max‖v‖ + ‖g‖ h t + 2 h V + depth₀         d_k the least of x_k − x_{k−1} − h v, v between v_{k−1} and v_k
//! ```
//! along every axis, and the same of turns about all together, log(q_k q_{k−1}⁻¹) beside h ω, with the last terms over the body's smallest
//! half width. Whatever the scheme, an impact within a step leaves the motion of that step between those of its two velocities; what moves
//! bodies without a velocity takes back depths, of which a step makes ‖g‖ h² and an impact 2 h V, V the speed that no point of any body
//! exceeds. How exactly bodies move the checks ask, in their own scenes; a velocity of another body or frame, with another sign or unit
//! shows here, in any scene where it lasts. Asked of free bodies, where every step is a sample and bodies keep no declared margin apart;
//! of turns in steps of at most two radians.

use crate::accounted::is_wrong;
use crate::tolerance::{FOLLOWED, UNMOVED, audit_rounding};
use crate::{Description, Expectation, Measurement};
use moreau_dynamics::mechanics::spatial::Shape;
use moreau_dynamics::scenes::{Body, Scene};
use moreau_dynamics::trajectory::{BodyTrack, Trajectory};
use moreau_exact::Result;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// Sample 0 is elsewhere.
pub const STARTS_ELSEWHERE: &str = "distance of sample 0 from the scene";

/// Sample 0 is turned.
pub const STARTS_TURNED: &str = "turn of sample 0 from the scene";

/// Bodies move otherwise than their velocities say.
pub const MOVED: &str = "motion that the reported velocities do not make";

/// Bodies turn otherwise than their angular velocities say.
pub const TURNED: &str = "turn that the reported angular velocities do not make";

/// How far sample 0 is from the scene's own places \[m\] and orientations \[rad\].
pub fn beginning(scene: &Scene, trajectory: &Trajectory, epsilon: f64) -> [Measurement; 2] {
    let bodies = || trajectory.bodies.iter().zip(&scene.bodies);
    let apart = bodies().map(|(track, body)| (Vector3::from(track.position[0]) - Vector3::from(body.position)).norm()).fold(0.0, f64::max);
    let turned = bodies().map(|(track, body)| turn(body.orientation, track.orientation[0]).norm()).fold(0.0, f64::max);
    let size = scene.bodies.iter().flat_map(|body| body.position).fold(0.0, |most: f64, x| most.max(x.abs()));
    let same = |size: f64| Expectation::equal(0.0, audit_rounding(epsilon, size), "sample 0 is the scene's own state");
    [Measurement::new(STARTS_ELSEWHERE, "m", apart, same(size)), Measurement::new(STARTS_TURNED, "rad", turned, same(1.0))]
}

/// What is wrong with the poses of an answer.
///
/// # Errors
/// Those of [`Scene::spatial_mechanism`].
pub fn wrong(scene: &Scene, trajectory: &Trajectory, description: &Description) -> Result<Vec<Measurement>> {
    let epsilon = description.precision.epsilon();
    let keeps_apart = description.contact_model.number("contact_margin").is_some_and(|margin| margin > 0.0);
    let mut found = beginning(scene, trajectory, epsilon).to_vec();
    let h = trajectory.time_step;
    let sampled = trajectory.times.windows(2).all(|pair| pair[1] - pair[0] < 1.5 * h);
    if sampled && trajectory.times.len() > 1 && !keeps_apart {
        let deepest = deepest(scene)? + 2.0 * h * fastest(scene, trajectory);
        let free = || trajectory.bodies.iter().zip(&scene.bodies).filter(|(_, body)| body.is_free());
        found.extend(free().map(|(track, _)| of_places(scene, trajectory, track, deepest, epsilon)));
        found.extend(free().filter_map(|(track, body)| of_turns(scene, trajectory, (track, body), deepest, epsilon)));
    }
    Ok(found.into_iter().filter(|one| is_wrong(one.value, one.ideal.tolerance)).collect())
}

/// The depth \[m\] at which a scene begins.
fn deepest(scene: &Scene) -> Result<f64> {
    let (mechanism, start) = scene.spatial_mechanism()?;
    Ok(mechanism.contacts(&start.position).iter().map(|contact| -contact.gap).fold(0.0, f64::max))
}

/// V \[m/s\]: ‖v‖ + ‖ω‖ R at most, R the radius of a body.
fn fastest(scene: &Scene, trajectory: &Trajectory) -> f64 {
    let of = |(track, body): (&BodyTrack, &Body)| {
        let radius = body.shape().map_or(0.0, |shape| shape.radius());
        let speeds = track.linear_velocity.iter().zip(&track.angular_velocity);
        speeds.map(|(v, spin)| length(&(*v).into()) + radius * length(&(*spin).into())).fold(0.0, f64::max)
    };
    trajectory.bodies.iter().zip(&scene.bodies).map(of).fold(0.0, f64::max)
}

/// The turn from one orientation to another \[rad\], about axes of the world.
fn turn(from: [f64; 4], to: [f64; 4]) -> Vector3<f64> {
    let [one, other] = [from, to].map(|[w, x, y, z]| UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)));
    (other * one.inverse()).scaled_axis()
}

fn of_places(scene: &Scene, trajectory: &Trajectory, track: &BodyTrack, deepest: f64, epsilon: f64) -> Measurement {
    // along every axis of its own: a fall hides no sideways motion
    let along = |axis: usize| {
        let only = |of: &[f64; 3]| Vector3::ith(axis, of[axis]);
        let velocities = track.linear_velocity.iter().map(only).collect();
        let moves = track.position.windows(2).map(|pair| only(&pair[1]) - only(&pair[0])).collect();
        most(
            &Path { moves, velocities, size: Vector3::from(track.position[0]).norm(), is_turn: false, unit: 1.0, deepest },
            scene,
            trajectory,
            epsilon,
        )
    };
    let [x, y, z] = [0, 1, 2].map(along);
    let (off, allowed) = [x, y, z].into_iter().max_by(|one, other| (one.0 - one.1).total_cmp(&(other.0 - other.1))).unwrap_or(x);
    Measurement::new(MOVED, "m", off, Expectation::equal(0.0, allowed, "bodies move as their velocities say"))
}

fn of_turns(scene: &Scene, trajectory: &Trajectory, (track, body): (&BodyTrack, &Body), deepest: f64, epsilon: f64) -> Option<Measurement> {
    let velocities: Vec<_> = track.angular_velocity.iter().copied().map(Vector3::from).collect();
    let moves: Vec<_> = track.orientation.windows(2).map(|pair| turn(pair[0], pair[1])).collect();
    let unit = smallest_half(&body.shape().ok()?);
    let (off, allowed) = most(&Path { moves, velocities, size: 1.0, is_turn: true, unit, deepest }, scene, trajectory, epsilon);
    let ideal = Expectation::equal(0.0, allowed, "bodies turn as their angular velocities say");
    Some(Measurement::new(TURNED, "rad", off, ideal))
}

/// The smallest half width \[m\].
fn smallest_half(shape: &Shape) -> f64 {
    match *shape {
        Shape::Sphere { radius } | Shape::Capsule { radius, .. } => radius,
        Shape::Box { half_extents } => half_extents.into_iter().fold(f64::INFINITY, f64::min),
        Shape::Cylinder { radius, half_height } => radius.min(half_height),
    }
}

/// What a body does from sample to sample, in metres or radians.
struct Path {
    moves: Vec<Vector3<f64>>,
    velocities: Vec<Vector3<f64>>,
    /// What the first pose rounds by, over ε.
    size: f64,
    /// Whether it turns.
    is_turn: bool,
    /// Metres in a unit.
    unit: f64,
    /// What taking back the depths of the start and of an impact may move \[m\].
    deepest: f64,
}

/// The sum that is furthest from what is allowed, and this.
fn most(path: &Path, scene: &Scene, trajectory: &Trajectory, epsilon: f64) -> (f64, f64) {
    let (h, gravity) = (trajectory.time_step, Vector3::from(scene.gravity).norm());
    let (mut sum, mut way) = (Vector3::zeros(), 0.0);
    let mut worst = (0.0, 0.0);
    for (k, (moved, pair)) in path.moves.iter().zip(path.velocities.windows(2)).enumerate() {
        let speed = length(&pair[0]).max(length(&pair[1]));
        if path.is_turn && h * speed > FOLLOWED {
            continue;
        }
        sum += least(moved, &(h * pair[0]), &(h * pair[1]));
        way += h * speed;
        let steps = (k + 1) as f64;
        let taken_back = (gravity * h * h * steps + path.deepest) / path.unit;
        let allowed = UNMOVED * way + taken_back + audit_rounding(epsilon, steps * (path.size + way));
        if !allowed.is_finite() {
            return (f64::INFINITY, allowed);
        }
        if length(&sum) - allowed > worst.0 - worst.1 || k == 0 {
            worst = (length(&sum), allowed);
        }
    }
    worst
}

/// ‖a‖, of any finite a.
fn length(a: &Vector3<f64>) -> f64 {
    a.amax() * (a / a.amax().max(f64::MIN_POSITIVE)).norm()
}

/// The least difference of a from what lies between b and c.
fn least(a: &Vector3<f64>, b: &Vector3<f64>, c: &Vector3<f64>) -> Vector3<f64> {
    let along = c - b;
    let part = (a - b).dot(&along) / along.norm_squared();
    let part = if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.0 };
    a - (b + part * along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Engine, Options, own};
    use moreau_dynamics::scenes::named;

    fn ours(scheme: &str, scene: &str, h: f64) -> Trajectory {
        let mut engine = own::by_name(scheme).expect("built in");
        engine.simulate(&named(scene).expect("built in"), h, 1, &Options::new()).expect("simulates")
    }

    fn wrong(trajectory: &Trajectory) -> Vec<String> {
        let description = own::by_name("moreau-jean").expect("built in").describe(&Options::new()).expect("describes itself");
        let found = super::wrong(&trajectory.scene, trajectory, &description).expect("a scene");
        found.into_iter().map(|one| one.quantity).collect()
    }

    type Change = fn(&mut Trajectory);

    fn mistakes(scene: &str, h: f64, mistakes: &[(&str, Change)]) {
        for (number, (expected, mistake)) in mistakes.iter().enumerate() {
            let mut trajectory = ours("moreau-jean", scene, h);
            assert_eq!(wrong(&trajectory), [""; 0], "{scene}");
            mistake(&mut trajectory);
            assert!(wrong(&trajectory).iter().any(|one| one == expected), "{scene}, {number}: {:?}", wrong(&trajectory));
        }
    }

    fn turned(q: [f64; 4]) -> [f64; 4] {
        let [w, x, y, z] = q;
        let turned = UnitQuaternion::from_scaled_axis(Vector3::x()) * UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        [turned.w, turned.i, turned.j, turned.k]
    }

    fn every(trajectory: &mut Trajectory, change: fn(&mut BodyTrack)) {
        trajectory.bodies.iter_mut().for_each(change);
    }

    #[test]
    fn places_that_velocities_do_not_lead_to_show_in_a_ball_that_bounces_and_a_stack_that_rests() {
        let both: [(&str, Change); 4] = [
            (STARTS_ELSEWHERE, |t| every(t, |body| body.position.iter_mut().for_each(|x| x[0] += 0.1))),
            (MOVED, |t| every(t, |body| body.position[5] = [1e300, 0.0, 0.0])),
            (MOVED, |t| every(t, |body| body.linear_velocity[1..].fill([1e308; 3]))),
            (MOVED, |t| every(t, |body| body.linear_velocity.iter_mut().for_each(|v| v[0] += 1.0))),
        ];
        mistakes("box-stack", 0.001, &both);
        mistakes("bouncing-ball", 0.01, &both);
        mistakes(
            "bouncing-ball",
            0.01,
            &[
                (MOVED, |t| every(t, |body| body.linear_velocity.iter_mut().for_each(|v| *v = v.map(|v| -v)))),
                (MOVED, |t| every(t, |body| body.linear_velocity.iter_mut().for_each(|v| *v = v.map(|v| 4.0 * v)))),
                (MOVED, |t| every(t, |body| body.position.iter_mut().for_each(|x| x[2] = 2.0))),
            ],
        );
    }

    #[test]
    fn turns_that_angular_velocities_do_not_make_show_in_a_stack_that_rests_and_a_box_that_tumbles() {
        let both: [(&str, Change); 3] = [
            (STARTS_TURNED, |t| every(t, |body| body.orientation.iter_mut().for_each(|q| *q = turned(*q)))),
            (TURNED, |t| every(t, |body| body.orientation[2..].iter_mut().for_each(|q| *q = turned(*q)))),
            (TURNED, |t| every(t, |body| body.angular_velocity.iter_mut().for_each(|spin| spin[1] += 0.3))),
        ];
        mistakes("box-stack", 0.001, &both);
        mistakes(
            "rolling-sphere",
            0.01,
            &[(TURNED, |t| every(t, |body| body.angular_velocity.iter_mut().for_each(|spin| spin.swap(0, 1))))],
        );
    }

    #[test]
    fn what_our_schemes_do_is_what_their_velocities_say() {
        let plastic = ["incline-stick", "incline-slide", "box-stack", "rolling-sphere"];
        let all = own::NAMES.iter().flat_map(|scheme| plastic.map(|scene| (*scheme, scene)));
        let bouncing = ["moreau-jean", "moreau-jean-theta-1"]
            .into_iter()
            .flat_map(|scheme| ["bouncing-ball", "two-ball-impact"].map(|scene| (scheme, scene)));
        for (scheme, scene) in all.chain(bouncing) {
            for h in [0.01, 0.1] {
                assert_eq!(wrong(&ours(scheme, scene, h)), [""; 0], "{scheme}, {scene}, {h}");
            }
        }
    }

    #[test]
    fn the_second_body_is_looked_at_as_the_first() {
        for body in [0, 1] {
            let mut trajectory = ours("moreau-jean", "two-ball-impact", 0.01);
            trajectory.bodies[body].linear_velocity.iter_mut().for_each(|v| v[1] += 1.0);
            assert_eq!(wrong(&trajectory), [MOVED], "{body}");
            trajectory.bodies[body].position[0][1] += 1.0;
            assert!(wrong(&trajectory).contains(&STARTS_ELSEWHERE.to_string()), "{body}");
        }
    }
}
