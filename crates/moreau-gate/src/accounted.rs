//! What the reported impulses of every answer must keep, whatever a check looks at.
//!
//! ```text
//!     p·n ≥ 0                                     p on a body from the ground, whose normal n is the same at every time
//!     ‖m Δv − m g Δt − Σ p‖ ≤ ½ (m ‖Δv‖ + m ‖g‖ Δt + Σ ‖p‖) + s max‖p‖      of every free body and interval
//! ```
//! s is the part of the largest impulse that a solver may leave at any body.
//! An interval's impulses are a sum, and so is its momentum: samples may be as rare as they like. How exactly momentum is accounted for
//! the checks of contacts ask, in their own scenes; a sign, a record that is missing or one of another body show here, in any scene.
//! Asked of rigid engines that report contacts and declare no damping; a measurement is only there where something is wrong.

use crate::model::Model;
use crate::tolerance::{SOLVED, UNACCOUNTED, audit_rounding};
use crate::{Description, Expectation, Kind, Measurement};
use moreau_dynamics::scenes::{Body, Scene};
use moreau_dynamics::trajectory::{BodyTrack, Trajectory};
use nalgebra::Vector3;
use std::collections::HashMap;

/// The ground pulls.
pub const PULLS: &str = "reported impulse with which the ground pulls";

/// Momentum comes from nowhere.
pub const UNACCOUNTED_FOR: &str = "momentum that the reported impulses do not account for";

/// Whether impulses are asked for at all.
fn is_asked(description: &Description) -> bool {
    description.reports_contacts && description.contact_model.kind == Kind::Rigid && Model::of(description).damping().is_none()
}

/// What is wrong with the impulses of an answer.
pub fn wrong(scene: &Scene, trajectory: &Trajectory, description: &Description) -> Vec<Measurement> {
    if !is_asked(description) {
        return Vec::new();
    }
    let epsilon = description.precision.epsilon();
    pulling(scene, trajectory, epsilon).into_iter().chain(unaccounted(scene, trajectory, epsilon)).collect()
}

fn pulling(scene: &Scene, trajectory: &Trajectory, epsilon: f64) -> Option<Measurement> {
    let normal = Vector3::from(scene.ground.as_ref()?.normal);
    let size = largest(trajectory);
    let from_ground = trajectory.contacts.iter().filter(|contact| contact.bodies[1] == "ground");
    let most = from_ground.map(|contact| -Vector3::from(contact.impulse).dot(&normal)).fold(0.0, f64::max);
    let allowed = SOLVED * size + audit_rounding(epsilon, size);
    let ideal = Expectation::at_most(0.0, allowed, "the ground pushes, p·n ≥ 0");
    is_wrong(most, allowed).then(|| Measurement::new(PULLS, "N*s", most, ideal))
}

/// Whether a value is more than allowed; one that overflows excuses nothing.
pub fn is_wrong(value: f64, allowed: f64) -> bool {
    value > allowed || !value.is_finite() || !allowed.is_finite()
}

/// The largest impulse \[N·s\] that is reported.
fn largest(trajectory: &Trajectory) -> f64 {
    trajectory.contacts.iter().map(|contact| Vector3::from(contact.impulse).norm()).fold(0.0, f64::max)
}

fn unaccounted(scene: &Scene, trajectory: &Trajectory, epsilon: f64) -> Option<Measurement> {
    // what a solver leaves of the largest impulse it may leave at any body
    let left = SOLVED * largest(trajectory);
    let allowed = |one: &Balance| UNACCOUNTED * one.terms + left + audit_rounding(epsilon, one.rounded);
    let judged = balances(scene, trajectory).into_iter().map(|one| (one.off, allowed(&one)));
    let (off, allowed) = judged.filter(|(off, allowed)| is_wrong(*off, *allowed)).max_by(|one, other| one.0.total_cmp(&other.0))?;
    let ideal = Expectation::at_most(0.0, allowed, "gravity and the reported impulses change momentum");
    Some(Measurement::new(UNACCOUNTED_FOR, "N*s", off, ideal))
}

/// The momentum \[N·s\] of one free body over one interval.
pub struct Balance {
    /// ‖m Δv − m g Δt − Σ p‖.
    pub off: f64,
    /// m ‖Δv‖ + m ‖g‖ Δt + Σ ‖p‖.
    pub terms: f64,
    /// What rounds: these and the momenta before and after in every step, and m ‖g‖ t, for Δt is a difference of times.
    pub rounded: f64,
}

/// The balances of every free body of a scene over every interval of a motion.
pub fn balances(scene: &Scene, trajectory: &Trajectory) -> Vec<Balance> {
    let (times, gravity) = (&trajectory.times, Vector3::from(scene.gravity));
    let free: Vec<_> = trajectory.bodies.iter().zip(&scene.bodies).filter(|(_, body)| body.is_free()).collect();
    let place: HashMap<&str, usize> = free.iter().enumerate().map(|(k, (_, body))| (body.name.as_str(), k)).collect();
    // Σ p and Σ ‖p‖ of every body and sample, in one pass
    let mut pushes = vec![(Vector3::zeros(), 0.0); free.len() * times.len()];
    for contact in &trajectory.contacts {
        for (name, sign) in contact.bodies.iter().zip([1.0, -1.0]) {
            if let Some(body) = place.get(name.as_str()) {
                let (sum, size) = &mut pushes[body * times.len() + contact.sample];
                let impulse = Vector3::from(contact.impulse);
                (*sum, *size) = (*sum + sign * impulse, *size + impulse.norm());
            }
        }
    }
    let of = |(number, (track, body)): (usize, &(&BodyTrack, &Body))| {
        let momentum = |k: usize| body.mass * Vector3::from(track.linear_velocity[k]);
        let (own, mass) = (&pushes[number * times.len()..][..times.len()], body.mass);
        let over = |k: usize| {
            let (before, after, duration, (sum, size)) = (momentum(k - 1), momentum(k), times[k] - times[k - 1], own[k]);
            let (change, fallen) = (after - before, mass * duration * gravity);
            let (terms, steps) = (change.norm() + fallen.norm() + size, (duration / trajectory.time_step).max(1.0));
            let rounded = steps * (terms + before.norm() + after.norm()) + mass * times[k] * gravity.norm();
            Balance { off: (change - fallen - sum).norm(), terms, rounded }
        };
        (1..times.len()).map(over).collect::<Vec<_>>()
    };
    free.iter().enumerate().flat_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::{PULLS, SOLVED, UNACCOUNTED_FOR};
    use crate::{Description, Engine, Kind, Options, own};
    use moreau_dynamics::scenes::named;
    use moreau_dynamics::trajectory::{ContactRecord, Trajectory};

    fn ours(scene: &str, every: usize) -> (Trajectory, Description) {
        let mut engine = own::by_name("moreau-jean").expect("built in");
        let trajectory = engine.simulate(&named(scene).expect("built in"), 0.01, every, &Options::new()).expect("simulates");
        (trajectory, engine.describe(&Options::new()).expect("describes itself"))
    }

    fn wrong(trajectory: &Trajectory, description: &Description) -> Vec<String> {
        super::wrong(&trajectory.scene, trajectory, description).into_iter().map(|one| one.quantity).collect()
    }

    #[test]
    fn what_is_reported_as_it_acted_is_accounted_for_however_rarely() {
        for scene in ["bouncing-ball", "incline-stick", "incline-slide", "box-stack", "two-ball-impact", "rolling-sphere"] {
            for every in [1, 5] {
                let (trajectory, description) = ours(scene, every);
                assert_eq!(wrong(&trajectory, &description), [""; 0], "{scene}, every {every}");
            }
        }
    }

    /// DART's balls that nothing touches yet move by 3e-13 N·s where 1 N·s acts later.
    #[test]
    fn what_a_solver_leaves_is_no_momentum_from_nowhere_and_more_is() {
        let (trajectory, description) = ours("two-ball-impact", 1);
        let (impulse, mass) = (super::largest(&trajectory), trajectory.scene.bodies[0].mass);
        let last = trajectory.times.len() - 1;
        assert!(trajectory.contacts.iter().all(|contact| contact.sample < last));
        for (part, expected) in [(0.9, &[][..]), (3.0, &[UNACCOUNTED_FOR][..])] {
            let mut trajectory = trajectory.clone();
            trajectory.bodies[0].linear_velocity[last][1] += part * SOLVED * impulse / mass;
            assert_eq!(wrong(&trajectory, &description), expected, "{part}");
        }
    }

    #[test]
    fn a_sign_a_missing_record_and_another_body_show_in_any_scene() {
        type Change = fn(&mut Trajectory);
        let [pulls, lost] = [PULLS, UNACCOUNTED_FOR];
        let between = |contact: &ContactRecord| contact.bodies[1] != "ground";
        assert!(ours("box-stack", 5).0.contacts.iter().any(between), "boxes touch each other");
        let mistakes: [(&[&str], Change); 6] = [
            (&[pulls, lost], |t| t.contacts.iter_mut().for_each(|one| one.impulse = [1e155; 3])),
            (&[pulls, lost], |t| t.contacts.iter_mut().for_each(|one| one.impulse = [f64::MAX; 3])),
            (&[pulls, lost], |t| t.contacts.iter_mut().for_each(|one| one.impulse = one.impulse.map(|p| -3.0 * p))),
            (&[lost], |t| t.contacts.retain(|one| one.bodies[1] == "ground")),
            (&[lost], |t| t.contacts.iter_mut().filter(|one| one.bodies[1] != "ground").for_each(|one| one.bodies.reverse())),
            (&[lost], |t| t.contacts.iter_mut().last().expect("contacts").impulse = [1e6, 0.0, 0.0]),
        ];
        for (expected, mistake) in mistakes {
            let (mut trajectory, mut description) = ours("box-stack", 5);
            mistake(&mut trajectory);
            assert_eq!(wrong(&trajectory, &description), expected);
            // contacts that yield may pull, and their law says how exactly they are reported
            description.contact_model.kind = Kind::Compliant;
            assert_eq!(wrong(&trajectory, &description), [""; 0]);
        }
    }
}
