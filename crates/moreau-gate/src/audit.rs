//! What can be said of any stored trajectory, whatever its scene: it begins where the scene does, its momentum is accounted for, friction
//! stays in its cone, nothing overlaps by more than a step's motion, and no energy comes from nowhere.
//!
//! ```text
//!     m (v_{k+1} − v_k) = m g Δt + Σ I                 I the reported impulses of (t_k, t_{k+1}]
//!     ‖I_t‖ ≤ μ I_n                                    of every pair of a body with the ground
//!     gap ≥ −h (max‖u‖ + G Δt)                         rigid: a contact is seen one step late at worst, G the difference of what falls
//!     T + V ≤ (T + V)_0 + Σ m ‖g‖ (½ h max‖v‖ + d)     semi-implicit steps swing by ½ h m g·v; d is the depth at the start
//! ```
//! A body that nothing moves has no momentum that changes: its velocity is the prescribed one. One that is driven does work on what it
//! touches, and then the energy says nothing.

use crate::accounted::{Balance, balances};
use crate::description::Friction;
use crate::moved::beginning;
use crate::tolerance::audit_rounding;
use crate::tolerance::conveyor::belt_speed;
use crate::{CheckOutcome, Description, Expectation, Kind, Measurement, Refusal, Reply, StepOutcome};
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::trajectory::Trajectory;
use moreau_exact::number::{significant, with_unit};
use nalgebra::{DVector, Quaternion, UnitQuaternion, Vector3};

/// What the names of audits begin with in a report; the name of the file follows.
pub const AUDITS: &str = "trajectory/";

/// The audit of one trajectory under a name.
pub fn audit(name: &str, trajectory: &Trajectory, description: &Description) -> CheckOutcome {
    let found = measurements(&trajectory.clone().with_ground_second(), description);
    CheckOutcome::new(name, vec![StepOutcome::new(Some(trajectory.time_step), found)])
}

fn measurements(trajectory: &Trajectory, description: &Description) -> Reply<Vec<Measurement>> {
    require_steps(trajectory, description.precision.epsilon())?;
    let (mechanism, _) = trajectory.scene.spatial_mechanism().map_err(Refusal::errored)?;
    let states: Vec<State> = (0..trajectory.times.len()).map(|k| state(trajectory, k)).collect();
    let epsilon = description.precision.epsilon();
    let mut found = beginning(&trajectory.scene, trajectory, epsilon).to_vec();
    found.extend(unmoved(trajectory, epsilon));
    if description.reports_contacts {
        found.push(momentum(trajectory, epsilon));
        found.extend(cone(trajectory, description, epsilon));
    }
    if description.contact_model.kind == Kind::Rigid {
        found.extend(overlap(mechanism.as_ref(), trajectory, &states, epsilon));
    }
    if trajectory.scene.bodies.iter().all(|body| body.is_free() || body.velocities() == [[0.0; 3]; 2]) {
        found.push(energy(trajectory, mechanism.as_ref(), &states, epsilon));
    }
    Ok(found)
}

/// Refuses samples that lie closer together than the time step, by which depths and swings are excused.
fn require_steps(trajectory: &Trajectory, epsilon: f64) -> Reply<()> {
    let (times, h) = (&trajectory.times, trajectory.time_step);
    // the last step of all may be a part of one
    let whole = &times[..times.len().saturating_sub(1).max(2).min(times.len())];
    let closest = whole.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    if closest >= h - audit_rounding(epsilon, times[times.len() - 1]) {
        return Ok(());
    }
    let [closest, h] = [closest, h].map(|number| with_unit(&significant(number), "s"));
    Err(Refusal::errored(format!("`times` has samples {closest} apart, but `time_step` is {h}: give the step that made the motion")))
}

/// Bodies that nothing moves keep the velocities that are prescribed, 0 if they are static; a report may be a difference of places.
fn unmoved(trajectory: &Trajectory, epsilon: f64) -> Option<Measurement> {
    let (mut worst, mut allowed) = (None, 0.0f64);
    for (track, body) in trajectory.bodies.iter().zip(&trajectory.scene.bodies).filter(|(_, body)| !body.is_free()) {
        let given = body.velocities().map(Vector3::from);
        for k in 0..trajectory.times.len() {
            let found = [track.linear_velocity[k], track.angular_velocity[k]].map(Vector3::from);
            let off = (found[0] - given[0]).norm().max((found[1] - given[1]).norm());
            worst = Some(off.max(worst.unwrap_or(0.0)));
            let size = Vector3::from(track.position[k]).norm() + 1.0;
            allowed = allowed.max(belt_speed(epsilon, given[0].norm().max(given[1].norm()), size, trajectory.time_step));
        }
    }
    let ideal = Expectation::equal(0.0, allowed, "what nothing moves has the velocities that are prescribed");
    worst.map(|off| Measurement::new("velocity of a body that nothing moves, off the prescribed one", "m/s", off, ideal))
}

/// Sample k as a state of the spatial mechanism, whose angular velocities are those of the body axes.
fn state(trajectory: &Trajectory, k: usize) -> State {
    let mut position = Vec::new();
    let mut velocity = Vec::new();
    for track in &trajectory.bodies {
        let [w, x, y, z] = track.orientation[k];
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        let angular = rotation.inverse_transform_vector(&Vector3::from(track.angular_velocity[k]));
        position.extend(track.position[k]);
        position.extend([rotation.w, rotation.i, rotation.j, rotation.k]);
        velocity.extend(track.linear_velocity[k]);
        velocity.extend(angular.iter());
    }
    State { time: trajectory.times[k], position: DVector::from_vec(position), velocity: DVector::from_vec(velocity) }
}

fn momentum(trajectory: &Trajectory, epsilon: f64) -> Measurement {
    let balances = balances(&trajectory.scene, trajectory);
    let largest = |of: fn(&Balance) -> f64| balances.iter().map(of).fold(0.0, f64::max);
    let allowed = audit_rounding(epsilon, largest(|one| one.rounded));
    let why = "gravity and the reported impulses make the whole change of momentum";
    Measurement::new("momentum not accounted for", "N*s", largest(|one| one.off), Expectation::equal(0.0, allowed, why))
}

/// The friction of pairs with the ground: their points share one normal, so that the sum of impulses lies in the cone if each does.
fn cone(trajectory: &Trajectory, description: &Description, epsilon: f64) -> Option<Measurement> {
    let ground = trajectory.contacts.iter().filter(|contact| contact.bodies[1] == "ground");
    let mut worst: Option<(f64, f64)> = None;
    for contact in ground {
        let overridden = trajectory.scene.material.pairs.iter().find(|pair| pair.bodies.iter().all(|name| contact.bodies.contains(name)));
        let friction = overridden.and_then(|pair| pair.friction).unwrap_or(trajectory.scene.material.friction);
        let (impulse, normal) = (Vector3::from(contact.impulse), Vector3::from(contact.normal));
        let pressed = impulse.dot(&normal);
        let outside = (impulse - pressed * normal).norm() - friction * pressed;
        let (old, size) = worst.unwrap_or((f64::NEG_INFINITY, 0.0));
        worst = Some((old.max(outside), size.max(impulse.norm())));
    }
    let (outside, size) = worst?;
    let allowed = audit_rounding(epsilon, size);
    let ideal = Expectation::at_most(0.0, allowed, "‖I_t‖ ≤ μ I_n");
    // a pyramid around the cone reaches √2 μ at its edges
    let around = Expectation::at_most(
        (std::f64::consts::SQRT_2 - 1.0) * trajectory.scene.material.friction * size,
        allowed,
        "a pyramid around the cone",
    );
    let model = (description.friction == Friction::Pyramid).then_some(around);
    Some(Measurement::new("friction outside the cone", "N*s", outside, ideal).predicted(model))
}

/// Samples tell speeds at their own times alone: between two of them gravity adds at most ‖J a‖ Δt to the speed u = J v of a contact,
/// a the acceleration of free fall, and contacts take speed away.
fn overlap(mechanism: &dyn Mechanism, trajectory: &Trajectory, states: &[State], epsilon: f64) -> Option<Measurement> {
    let between = trajectory.times.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    let falling = falling(trajectory);
    let (mut deepest, mut fastest) = (f64::INFINITY, 0.0f64);
    for state in states {
        for contact in mechanism.contacts(&state.position) {
            deepest = deepest.min(contact.gap);
            fastest = fastest.max((&contact.jacobian * &state.velocity).norm() + between * (&contact.jacobian * &falling).norm());
        }
    }
    let size = states[0].position.amax();
    let allowed = trajectory.time_step * fastest;
    let ideal = || Expectation::at_least(-allowed, audit_rounding(epsilon, size), "a contact is seen one step late at worst");
    deepest.is_finite().then(|| Measurement::new("smallest gap", "m", deepest, ideal()))
}

/// The acceleration of free fall [m/s², rad/s²] of every body, 0 of those that nothing moves.
fn falling(trajectory: &Trajectory) -> DVector<f64> {
    let [x, y, z] = trajectory.scene.gravity;
    let of = |free: bool| if free { [x, y, z, 0.0, 0.0, 0.0] } else { [0.0; 6] };
    DVector::from_vec(trajectory.scene.bodies.iter().flat_map(|body| of(body.is_free())).collect())
}

fn energy(trajectory: &Trajectory, mechanism: &dyn Mechanism, states: &[State], epsilon: f64) -> Measurement {
    let begin = mechanism.energy(&states[0]);
    let highest = states.iter().map(|state| mechanism.energy(state)).fold(f64::NEG_INFINITY, f64::max);
    let gravity = Vector3::from(trajectory.scene.gravity).norm();
    let fastest =
        |track: &moreau_dynamics::trajectory::BodyTrack| track.linear_velocity.iter().map(|v| Vector3::from(*v).norm()).fold(0.0, f64::max);
    let bodies = trajectory.scene.bodies.iter().zip(&trajectory.bodies).filter(|(body, _)| body.is_free());
    let swing: f64 = bodies.map(|(body, track)| 0.5 * trajectory.time_step * body.mass * gravity * fastest(track)).sum();
    let deepest = mechanism.contacts(&states[0].position).iter().map(|contact| -contact.gap).fold(0.0, f64::max);
    let lifted: f64 = trajectory.scene.bodies.iter().filter(|body| body.is_free()).map(|body| body.mass * gravity * deepest).sum();
    let size =
        states.iter().map(|state| mechanism.kinetic_energy(state) + mechanism.potential_energy(&state.position).abs()).fold(0.0, f64::max);
    // every step rounds, whether it is a sample or not
    let steps = (trajectory.times[states.len() - 1] / trajectory.time_step).max(1.0);
    let allowed = swing + lifted + audit_rounding(epsilon, size * steps);
    let ideal = Expectation::at_most(0.0, allowed, "contacts take energy; ½ h m g·v is the swing of a semi-implicit step");
    Measurement::new("energy above the start", "J", highest - begin, ideal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Engine, Options, Verdict, own};
    use moreau_dynamics::scenes::{Body, PairOverride, Scene, named};

    fn ours(scene: &str) -> (Trajectory, Description) {
        let mut engine = own::by_name("moreau-jean").expect("built in");
        let mut scene = named(scene).expect("built in");
        scene.duration = 0.5;
        let trajectory = engine.simulate(&scene, 0.01, 1, &Options::new()).expect("simulates");
        (trajectory, engine.describe(&Options::new()).expect("describes itself"))
    }

    fn bad(trajectory: &Trajectory, description: &Description) -> Vec<String> {
        let outcome = audit("x", trajectory, description);
        let bad = outcome.steps[0].measurements.iter().filter(|one| one.verdict() != Verdict::Pass);
        bad.map(|one| format!("{}: {} (allowed {:e})", one.quantity, one.value, one.ideal.tolerance)).collect()
    }

    #[test]
    fn our_own_motions_are_sound() {
        for scene in ["bouncing-ball", "incline-slide", "box-stack", "two-ball-impact"] {
            let (trajectory, description) = ours(scene);
            assert_eq!(bad(&trajectory, &description), [""; 0], "{scene}");
        }
    }

    /// The speed of the ball at its first impact is in no sample: it reached the ground between two of them.
    #[test]
    fn our_own_motions_are_sound_however_rarely_they_are_sampled() {
        for (scene, every) in [("bouncing-ball", 2), ("bouncing-ball", 5), ("bouncing-ball", 25), ("box-stack", 5)] {
            let mut engine = own::by_name("moreau-jean").expect("built in");
            let scene = named(scene).expect("built in");
            let description = engine.describe(&Options::new()).expect("describes itself");
            let mut trajectory = engine.simulate(&scene, 0.01, every, &Options::new()).expect("simulates");
            assert_eq!(bad(&trajectory, &description), [""; 0], "{}, every {every}", scene.name);
            // more than the motion of any step
            trajectory.bodies[0].position.iter_mut().skip(1).for_each(|place| place[2] -= 0.5);
            assert!(bad(&trajectory, &description).iter().any(|text| text.starts_with("smallest gap")), "{}", scene.name);
        }
    }

    #[test]
    fn samples_that_are_closer_than_a_step_are_refused() {
        let (trajectory, description) = ours("bouncing-ball");
        let with = |time_step: f64| audit("x", &Trajectory { time_step, ..trajectory.clone() }, &description).verdict;
        assert_eq!([0.005, 0.01, 0.0101, 0.02].map(with), [Verdict::Pass, Verdict::Pass, Verdict::Errored, Verdict::Errored]);
    }

    /// A ball that begins 10⁻⁸ m in the floor may be lifted out of it, by a law that keeps gap/h, and no higher.
    #[test]
    fn what_begins_in_depth_may_be_lifted_out_of_it_and_no_higher() {
        let depth = 1e-8;
        let mut scene = named("ball-drop").expect("built in");
        let radius = scene.bodies[0].sphere.expect("a ball").radius;
        (scene.bodies[0].position, scene.duration) = ([0.0, 0.0, radius - depth], 0.1);
        let mut engine = own::by_name("anitescu").expect("built in");
        let description = engine.describe(&Options::new()).expect("describes itself");
        let mut trajectory = engine.simulate(&scene, 0.001, 1, &Options::new()).expect("simulates");
        let gains = |trajectory: &Trajectory| bad(trajectory, &description).iter().any(|text| text.starts_with("energy above the start"));
        assert!(trajectory.bodies[0].position.last().expect("samples")[2] > radius - 0.5 * depth && !gains(&trajectory));
        trajectory.bodies[0].position.iter_mut().skip(1).for_each(|place| place[2] += 3.0 * depth);
        assert!(gains(&trajectory), "four times the depth");
    }

    #[test]
    fn the_ground_may_be_named_first() {
        let (mut trajectory, description) = ours("incline-slide");
        trajectory.contacts.iter_mut().for_each(|contact| {
            contact.bodies.reverse();
            (contact.normal, contact.impulse) = (contact.normal.map(|x| -x), contact.impulse.map(|x| -x));
        });
        assert_eq!(bad(&trajectory, &description), [""; 0]);
        trajectory.scene.material.friction *= 0.5;
        assert!(bad(&trajectory, &description).iter().any(|text| text.starts_with("friction outside the cone")));
    }

    #[test]
    fn what_may_round_is_that_of_all_steps_however_rarely_they_are_sampled() {
        let allowed = |every: usize| {
            let mut engine = own::by_name("moreau-jean").expect("built in");
            let scene = Scene { gravity: [0.0; 3], ..named("two-ball-impact").expect("built in") };
            let trajectory = engine.simulate(&scene, 0.01, every, &Options::new()).expect("simulates");
            let outcome = audit("x", &trajectory, &engine.describe(&Options::new()).expect("describes itself"));
            let energy = outcome.steps[0].measurements.iter().find(|one| one.quantity == "energy above the start");
            energy.expect("measured").ideal.tolerance
        };
        // the energy is largest at the start, which is a sample of both
        assert_eq!(allowed(1), allowed(5));
    }

    /// A box on a belt that runs, or on a slab that stays, beside a box on the floor.
    fn carried(runs: bool) -> (Trajectory, Description) {
        let mut engine = own::by_name("moreau-jean").expect("built in");
        let load = Body::cuboid("load", 2.0, [0.2, 0.2, 0.05], [0.0, 0.0, 0.15]);
        let other = Body::cuboid("other", 1.0, [0.1; 3], [9.0, 0.0, 0.1]);
        let belt = Body::cuboid("belt", 1.0, [4.0, 1.0, 0.05], [0.0, 0.0, 0.05]);
        let belt = if runs { belt.driven([0.5, 0.0, 0.0]) } else { belt.fixed() };
        let scene = Scene { bodies: vec![load, belt, other], duration: 0.5, ..named("box-stack").expect("built in") };
        let trajectory = engine.simulate(&scene, 0.01, 1, &Options::new()).expect("simulates");
        (trajectory, engine.describe(&Options::new()).expect("describes itself"))
    }

    #[test]
    fn bodies_that_nothing_moves_raise_no_alarm_and_hide_none() {
        type Change = fn(&mut Trajectory);
        for runs in [false, true] {
            let (trajectory, description) = carried(runs);
            assert_eq!(bad(&trajectory, &description), [""; 0], "runs: {runs}");
            let mistakes: [(&str, Change); 4] = [
                ("velocity of a body that nothing moves", |t| t.bodies[1].linear_velocity[3][1] += 0.125),
                ("velocity of a body that nothing moves", |t| t.bodies[1].angular_velocity[50][2] += 0.125),
                ("momentum not accounted for", |t| t.bodies[2].linear_velocity[3][1] += 1.0),
                ("energy above the start", |t| t.bodies[2].linear_velocity[3][2] += 100.0),
            ];
            for (name, mistake) in mistakes {
                let (mut trajectory, description) = (trajectory.clone(), description.clone());
                mistake(&mut trajectory);
                let found = bad(&trajectory, &description);
                // a belt may give energy, and is not held to give none
                let expected = !(runs && name.starts_with("energy"));
                assert_eq!(found.iter().any(|text| text.starts_with(name)), expected, "{name}: {found:?}");
            }
        }
    }

    #[test]
    fn every_contact_and_every_report_is_looked_at() {
        // the ball beside the pile comes last: its contact with the floor is the last candidate of all
        let (mut trajectory, description) = ours("box-stack");
        let last = trajectory.bodies.len() - 1;
        for track in &mut trajectory.bodies {
            track.position.iter_mut().for_each(|place| place[2] += 0.001);
        }
        trajectory.bodies[last].position.iter_mut().for_each(|place| place[2] -= 0.5);
        assert!(bad(&trajectory, &description).iter().any(|text| text.starts_with("smallest gap")));
        for place in [0, trajectory.contacts.len() - 1] {
            let (mut trajectory, description) = ours("incline-slide");
            let place = place.min(trajectory.contacts.len() - 1);
            trajectory.contacts[place].impulse[0] -= 100.0;
            assert!(bad(&trajectory, &description).iter().any(|text| text.starts_with("friction outside the cone")), "{place}");
        }
    }

    #[test]
    fn the_second_body_is_looked_at_as_the_first() {
        type Change = fn(&mut Trajectory);
        let mistakes: [(&str, Change); 4] = [
            ("distance of sample 0", |t| t.bodies[1].position[0][1] += 1.0),
            ("momentum not accounted for", |t| t.bodies[1].linear_velocity[3][1] += 1.0),
            ("smallest gap", |t| t.bodies[1].position = t.bodies[0].position.clone()),
            ("energy above the start", |t| t.bodies[1].linear_velocity[3][1] += 100.0),
        ];
        for (name, mistake) in mistakes {
            let (mut trajectory, description) = ours("two-ball-impact");
            mistake(&mut trajectory);
            let found = bad(&trajectory, &description);
            assert!(found.iter().any(|text| text.starts_with(name)), "{name}: {found:?}");
        }
    }

    #[test]
    fn friction_is_that_of_the_pair_where_it_has_its_own() {
        let (mut trajectory, description) = ours("incline-slide");
        let body = trajectory.scene.bodies[0].name.clone();
        let own = |friction: f64| PairOverride { bodies: ["ground".into(), body.clone()], friction: Some(friction), restitution: None };
        // the motion has the common friction, which is more than the pair's own, or less
        let common = trajectory.scene.material.friction;
        trajectory.scene.material.pairs = vec![own(0.5 * common)];
        assert!(bad(&trajectory, &description).iter().any(|text| text.starts_with("friction outside the cone")));
        trajectory.scene.material.friction = 0.5 * common;
        trajectory.scene.material.pairs = vec![own(common)];
        assert_eq!(bad(&trajectory, &description), [""; 0]);
    }

    #[test]
    fn every_planted_mistake_is_named() {
        type Change = fn(&mut Trajectory);
        let mistakes: [(&str, Change); 5] = [
            ("distance of sample 0", |t| t.bodies[0].position[0][2] += 1.0),
            ("momentum not accounted for", |t| t.contacts[0].impulse[2] *= 2.0),
            ("friction outside the cone", |t| t.contacts[0].impulse[0] -= 100.0),
            ("smallest gap", |t| t.bodies[0].position.iter_mut().for_each(|x| x[2] -= 0.5)),
            ("energy above the start", |t| t.bodies[0].linear_velocity[3][2] += 100.0),
        ];
        for (name, mistake) in mistakes {
            let (mut trajectory, description) = ours("incline-slide");
            mistake(&mut trajectory);
            let found = bad(&trajectory, &description);
            assert!(found.iter().any(|text| text.starts_with(name)), "{name}: {found:?}");
        }
    }
}
