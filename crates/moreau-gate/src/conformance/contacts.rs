//! Probes of contact impulses, on a ball that lands.
//!
//! ```text
//! m (v_k − v_{k−1})  =  m g Δt + Σ r    over (t_{k−1}, t_k],  r on the ball
//! ```
//! A force for an impulse, another interval, another sign or one step of several break the balance by a whole term.

use crate::Description;
use crate::conformance::scenes::{EVERY, LANDING, MASS, landing_ball};
use crate::conformance::{Probe, ProbeOutcome, Seen, demand, probe, problem, skipped};
use crate::tolerance::conformance::{MOMENTUM, STEP};
use moreau_dynamics::trajectory::{ContactRecord, Trajectory};
use nalgebra::Vector3;

/// Δt \[s\].
const INTERVAL: f64 = EVERY as f64 * STEP;

/// How many samples there are, with the initial state.
const SAMPLES: usize = LANDING / EVERY + 1;

/// A trajectory's contacts and their sum, interval by interval.
struct Balance {
    /// m Δv − m g Δt \[N·s\]: what the impulses must add up to.
    needed: Vec<Vector3<f64>>,
    /// Σ r on the ball \[N·s\].
    reported: Vec<Vector3<f64>>,
    /// m g Δt \[N·s\].
    weight: f64,
}

pub(super) fn probe_all(landed: Result<Trajectory, ProbeOutcome>, description: &Description, probes: &mut Vec<Probe>) {
    let with_contacts = landed.and_then(|trajectory| match () {
        () if !description.reports_contacts => Err(skipped("the engine does not report contacts")),
        () if trajectory.times.len() != SAMPLES => Err(skipped("the samples are not those that were asked for")),
        () => Ok(trajectory),
    });
    let on = |test: fn(&Trajectory) -> Seen| with_contacts.as_ref().map_err(Clone::clone).and_then(test);
    probes.push(probe("contacts/normal", "the normal of bodies [a, b] points from b to a, and the impulse pushes a along it", on(normals)));
    probes.push(probe(
        "contacts/impulse",
        "impulses, summed over the interval that ends at the sample, balance the momentum",
        on(momentum),
    ));
}

fn normals(trajectory: &Trajectory) -> Seen {
    let touched = !trajectory.contacts.is_empty();
    let cure = "report contacts of the interval before the sample, or set `reports_contacts` to false";
    demand(touched, || "the ball has landed, but `contacts` is empty".into(), cure)?;
    for (k, contact) in trajectory.contacts.iter().enumerate() {
        let up = sign(contact);
        let why = || format!("contacts[{k}] of {:?} has the normal {:?}", contact.bodies, contact.normal);
        demand(
            up * contact.normal[2] > 0.5,
            why,
            "turn the normal round, or exchange the bodies; a normal points from the second body to the first",
        )?;
        let along = Vector3::from(contact.impulse).dot(&Vector3::from(contact.normal));
        let why = || format!("contacts[{k}] has the impulse {:?}, which pulls {} along its normal", contact.impulse, contact.bodies[0]);
        demand(along >= 0.0, why, "report the impulse that acts on the first body")?;
    }
    Ok(())
}

/// 1 if the impulse acts on the ball, −1 if on the ground.
fn sign(contact: &ContactRecord) -> f64 {
    if contact.bodies[0] == "ground" { -1.0 } else { 1.0 }
}

fn momentum(trajectory: &Trajectory) -> Seen {
    let balance = Balance::of(trajectory);
    let (worst, off) = balance.worst(1.0, 0);
    if off <= MOMENTUM {
        return Ok(());
    }
    let why = format!(
        "in the interval that ends at sample {worst} the momentum balance needs {:.4} N·s, but {:.4} N·s are reported",
        balance.needed[worst - 1][2],
        balance.reported[worst - 1][2],
    );
    Err(problem(why, balance.cure()))
}

impl Balance {
    fn of(trajectory: &Trajectory) -> Balance {
        let scene = landing_ball();
        let gravity = Vector3::from(scene.gravity);
        let intervals = trajectory.times.len().saturating_sub(1);
        let velocity = &trajectory.bodies[0].linear_velocity;
        let needed = (0..intervals).map(|k| MASS * (Vector3::from(velocity[k + 1]) - Vector3::from(velocity[k]) - gravity * INTERVAL));
        let mut reported = vec![Vector3::zeros(); intervals];
        for contact in &trajectory.contacts {
            reported[contact.sample - 1] += sign(contact) * Vector3::from(contact.impulse);
        }
        Balance { needed: needed.collect(), reported, weight: MASS * gravity.norm() * INTERVAL }
    }

    /// The sample at which the balance is worst, and by which part of its largest term, if the reports are `factor` times too small and
    /// `late` samples late.
    fn worst(&self, factor: f64, late: isize) -> (usize, f64) {
        let intervals = self.needed.len() as isize;
        // at the ends a shifted report is out of sight
        let visible = (0..intervals).filter(|k| (0..intervals).contains(&(k + late)));
        let off = visible.map(|k| {
            let (needed, reported) = (self.needed[k as usize], factor * self.reported[(k + late) as usize]);
            let scale = self.weight.max(needed.norm()).max(reported.norm());
            (k as usize + 1, (reported - needed).norm() / scale)
        });
        off.fold((1, 0.0), |worst, other| if other.1 > worst.1 { other } else { worst })
    }

    /// The explanation that repairs the balance.
    fn cure(&self) -> &'static str {
        let explains = |factor: f64, late: isize| self.worst(factor, late).1 <= MOMENTUM;
        if explains(STEP, 0) {
            "the reported numbers are forces; multiply the force of each step by time_step and add the products up"
        } else if explains(-1.0, 0) {
            "the reported impulses act on the other body; change their sign, or exchange the bodies"
        } else if explains(INTERVAL, 0) {
            "the reported numbers are mean forces of the interval; multiply them by its length"
        } else if explains(1.0, 1) {
            "the impulses come one sample late; report an impulse with the sample that ends its interval"
        } else if explains(1.0, -1) {
            "the impulses come one sample early; if the engine evaluates contacts before its step, report them one sample later"
        } else {
            "add up the impulses of all steps and all points since the last sample; the impulse of a step is force times time_step"
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Engine, Options, own};

    /// What the probes of contacts tell of a ball that landed, changed like this: the words of the problem and of the cure.
    fn told(change: impl Fn(&mut Trajectory)) -> [Option<String>; 2] {
        let mut engine = own::by_name("moreau-jean").expect("listed");
        let description = engine.describe(&Options::new()).expect("describes itself");
        let mut landed = engine.simulate(&landing_ball(), STEP, EVERY, &Options::new()).expect("it lands");
        change(&mut landed);
        let mut probes = Vec::new();
        probe_all(Ok(landed), &description, &mut probes);
        let words = |probe: &Probe| match &probe.outcome {
            ProbeOutcome::Problem { why, cure } => Some(format!("{why}; {cure}")),
            ProbeOutcome::Ok | ProbeOutcome::Skipped { .. } => None,
        };
        [words(&probes[0]), words(&probes[1])]
    }

    fn scaled(motion: &mut Trajectory, factor: f64) {
        motion.contacts.iter_mut().for_each(|contact| contact.impulse = contact.impulse.map(|part| part * factor));
    }

    #[test]
    fn each_wrong_report_of_impulses_is_told_with_its_own_cure() {
        assert_eq!(told(|_| ()), [None, None]);
        let shifted = |by: isize| {
            move |motion: &mut Trajectory| {
                motion.contacts.iter_mut().for_each(|contact| contact.sample = contact.sample.saturating_add_signed(by));
                motion.contacts.retain(|contact| (1..SAMPLES).contains(&contact.sample));
            }
        };
        type Change = Box<dyn Fn(&mut Trajectory)>;
        let cases: [(Change, &str); 6] = [
            (Box::new(|motion| scaled(motion, 1.0 / STEP)), "multiply the force of each step"),
            (Box::new(|motion| scaled(motion, -1.0)), "act on the other body"),
            (Box::new(|motion| scaled(motion, 1.0 / INTERVAL)), "mean forces of the interval"),
            (Box::new(shifted(1)), "one sample late"),
            (Box::new(shifted(-1)), "one sample early"),
            (Box::new(|motion| scaled(motion, 1.5)), "add up the impulses of all steps"),
        ];
        for (change, cure) in cases {
            let [_, found] = told(change);
            assert!(found.as_ref().is_some_and(|words| words.contains(cure)), "{cure}: {found:?}");
        }
    }

    #[test]
    fn an_impulse_that_pulls_by_little_and_a_normal_that_points_down_are_told_wherever_they_stand() {
        for last in [false, true] {
            let place = move |motion: &Trajectory| if last { motion.contacts.len() - 1 } else { 0 };
            let [pulls, _] = told(|motion| {
                let place = place(motion);
                motion.contacts[place].impulse = motion.contacts[place].normal.map(|part| -part / 1024.0);
            });
            assert!(pulls.is_some_and(|words| words.contains("pulls")), "{last}");
            let [down, _] = told(|motion| {
                let place = place(motion);
                motion.contacts[place].normal = motion.contacts[place].normal.map(|part| -part);
            });
            assert!(down.is_some_and(|words| words.contains("has the normal")), "{last}");
        }
        let [nothing, _] = told(|motion| motion.contacts.clear());
        assert!(nothing.is_some_and(|words| words.contains("is empty")));
    }
}
