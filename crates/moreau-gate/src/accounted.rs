//! What the reported impulses of every answer must keep, whatever a check looks at.
//!
//! ```text
//!     p·n ≥ 0                                     p on a body from the ground, whose normal n is the same at every time
//!     ‖m Δv − m g Δt − Σ p‖ ≤ ½ (m ‖Δv‖ + m ‖g‖ Δt + Σ ‖p‖)      of every free body and interval
//! ```
//! An interval's impulses are a sum, and so is its momentum: samples may be as rare as they like. How exactly momentum is accounted for
//! the checks of contacts ask, in their own scenes; a sign, a record that is missing or one of another body show here, in any scene.
//! Asked of rigid engines that report contacts and declare no damping; a measurement is only there where something is wrong.

use crate::model::Model;
use crate::tolerance::{SOLVED, UNACCOUNTED, audit_rounding};
use crate::{Description, Expectation, Kind, Measurement};
use moreau_dynamics::scenes::Body;
use moreau_dynamics::trajectory::{BodyTrack, ContactRecord, Trajectory};
use nalgebra::Vector3;

/// The ground pulls.
const PULLS: &str = "reported impulse with which the ground pulls";

/// Momentum comes from nowhere.
const UNACCOUNTED_FOR: &str = "momentum that the reported impulses do not account for";

/// Whether it is one of these measurements, which no check asked for.
#[cfg(test)]
pub fn is_of_any_answer(measurement: &Measurement) -> bool {
    [PULLS, UNACCOUNTED_FOR].contains(&measurement.quantity.as_str())
}

/// What is wrong with the impulses of the answers so far.
#[derive(Default)]
pub struct Accounted {
    pulling: Option<Measurement>,
    unaccounted: Option<Measurement>,
}

/// Whether impulses are asked for at all.
fn is_asked(description: &Description) -> bool {
    description.reports_contacts && description.contact_model.kind == Kind::Rigid && Model::of(description).damping().is_none()
}

impl Accounted {
    /// Looks at one more answer; what is worst stays.
    pub fn look_at(&mut self, trajectory: &Trajectory, description: &Description) {
        if is_asked(description) {
            let epsilon = description.precision.epsilon();
            worse(&mut self.pulling, pulling(trajectory, epsilon));
            worse(&mut self.unaccounted, unaccounted(trajectory, epsilon));
        }
    }

    /// The measurements of what is wrong.
    pub fn wrong(self) -> impl Iterator<Item = Measurement> {
        self.pulling.into_iter().chain(self.unaccounted)
    }
}

/// Keeps the measurement whose value is larger.
fn worse(kept: &mut Option<Measurement>, found: Option<Measurement>) {
    if let Some(found) = found
        && kept.as_ref().is_none_or(|kept| kept.value < found.value)
    {
        *kept = Some(found);
    }
}

fn pulling(trajectory: &Trajectory, epsilon: f64) -> Option<Measurement> {
    let normal = Vector3::from(trajectory.scene.ground.as_ref()?.normal);
    let size = trajectory.contacts.iter().map(|contact| Vector3::from(contact.impulse).norm()).fold(0.0, f64::max);
    let from_ground = trajectory.contacts.iter().filter(|contact| contact.bodies[1] == "ground");
    let most = from_ground.map(|contact| -Vector3::from(contact.impulse).dot(&normal)).fold(0.0, f64::max);
    let allowed = SOLVED * size + audit_rounding(epsilon, size);
    let ideal = Expectation::at_most(0.0, allowed, "the ground pushes, p·n ≥ 0");
    (most > allowed).then(|| Measurement::new(PULLS, "N*s", most, ideal))
}

fn unaccounted(trajectory: &Trajectory, epsilon: f64) -> Option<Measurement> {
    let bodies = trajectory.bodies.iter().zip(&trajectory.scene.bodies).filter(|(_, body)| body.is_free());
    let mut worst: Option<(f64, f64)> = None;
    for (track, body) in bodies {
        let own: Vec<(usize, Vector3<f64>)> = trajectory.contacts.iter().filter_map(|contact| acting(contact, body)).collect();
        for k in 1..trajectory.times.len() {
            let here = own.iter().filter(|(sample, _)| *sample == k).map(|(_, impulse)| *impulse);
            let (off, allowed) = balance(trajectory, track, body, k, here, epsilon);
            if off > allowed && worst.is_none_or(|(most, _)| off > most) {
                worst = Some((off, allowed));
            }
        }
    }
    let (off, allowed) = worst?;
    let ideal = Expectation::at_most(0.0, allowed, "gravity and the reported impulses change momentum");
    Some(Measurement::new(UNACCOUNTED_FOR, "N*s", off, ideal))
}

/// The sample of a record and its impulse on a body, if it acts on it.
fn acting(contact: &ContactRecord, body: &Body) -> Option<(usize, Vector3<f64>)> {
    let sign = match contact.bodies.iter().position(|name| *name == body.name)? {
        0 => 1.0,
        _ => -1.0,
    };
    Some((contact.sample, sign * Vector3::from(contact.impulse)))
}

/// Momentum of the interval before sample k that is not accounted for, and what of it is allowed.
fn balance(
    trajectory: &Trajectory,
    track: &BodyTrack,
    body: &Body,
    k: usize,
    impulses: impl Iterator<Item = Vector3<f64>>,
    epsilon: f64,
) -> (f64, f64) {
    let duration = trajectory.times[k] - trajectory.times[k - 1];
    let [before, after] = [k - 1, k].map(|k| body.mass * Vector3::from(track.linear_velocity[k]));
    let fallen = body.mass * duration * Vector3::from(trajectory.scene.gravity);
    let (sum, size) = impulses.fold((Vector3::zeros(), 0.0), |(sum, size), one| (sum + one, size + one.norm()));
    let terms = (after - before).norm() + fallen.norm() + size;
    let steps = (duration / trajectory.time_step).max(1.0);
    let rounding = audit_rounding(epsilon, steps * (terms + before.norm() + after.norm()));
    ((after - before - fallen - sum).norm(), UNACCOUNTED * terms + rounding)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Engine, Options, own};
    use moreau_dynamics::scenes::named;

    fn ours(scene: &str, every: usize) -> (Trajectory, Description) {
        let mut engine = own::by_name("moreau-jean").expect("built in");
        let trajectory = engine.simulate(&named(scene).expect("built in"), 0.01, every, &Options::new()).expect("simulates");
        (trajectory, engine.describe(&Options::new()).expect("describes itself"))
    }

    fn wrong(trajectory: &Trajectory, description: &Description) -> Vec<String> {
        let mut accounted = Accounted::default();
        accounted.look_at(trajectory, description);
        accounted.wrong().map(|one| one.quantity).collect()
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

    #[test]
    fn a_sign_a_missing_record_and_another_body_show_in_any_scene() {
        type Change = fn(&mut Trajectory);
        let [pulls, lost] = [PULLS, UNACCOUNTED_FOR];
        let between = |contact: &ContactRecord| contact.bodies[1] != "ground";
        assert!(ours("box-stack", 5).0.contacts.iter().any(between), "boxes touch each other");
        let mistakes: [(&[&str], Change); 4] = [
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
