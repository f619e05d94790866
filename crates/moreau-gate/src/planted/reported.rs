//! Mistakes in what is reported of the impulses between two bodies, and of several steps.

use crate::planted::wrapped::moreau_jean;
use crate::planted::{Faulty, Kind, Planted};
use crate::{Description, Engine, Options, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::{ContactRecord, Trajectory};

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    Planted {
        name: "contact/last-step-reported",
        mistake: "reports the impulses of the last step where samples are several steps apart",
        kind: Kind::Report,
        subject: Faulty { engine: || Box::new(LastStep), caught_by: &["contact/pairs"] },
    },
    Planted {
        name: "contact/pair-impulses-reversed",
        mistake: "reports the impulse between two bodies as it acts on the second",
        kind: Kind::Report,
        subject: Faulty {
            engine: || Box::new(OtherPairs(|contacts| reversed(contacts))),
            caught_by: &["contact/pairs", "tumbling/momentum"],
        },
    },
    Planted {
        name: "contact/pair-impulses-unreported",
        mistake: "reports contacts with the ground only",
        kind: Kind::Report,
        subject: Faulty {
            engine: || Box::new(OtherPairs(|contacts| contacts.retain(|contact| !between_bodies(contact)))),
            caught_by: &["contact/pairs", "tumbling/momentum"],
        },
    },
    Planted {
        name: "contact/pair-normals-reversed",
        mistake: "reports the normal between two bodies as it points to the second",
        kind: Kind::Report,
        subject: Faulty { engine: || Box::new(OtherPairs(|contacts| turned_round(contacts))), caught_by: &["contact/pairs"] },
    },
];

fn between_bodies(contact: &ContactRecord) -> bool {
    contact.bodies.iter().all(|name| name != "ground")
}

/// Reports of each interval the impulses of its last step.
struct LastStep;

impl Engine for LastStep {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        moreau_jean().describe(options)
    }

    fn simulate(&mut self, scene: &Scene, h: f64, every: usize, options: &Options) -> Reply<Trajectory> {
        let contacts = moreau_jean().simulate(scene, h, 1, options)?.contacts;
        let last = contacts.into_iter().filter(|contact| contact.sample % every == 0);
        let contacts = last.map(|contact| ContactRecord { sample: contact.sample / every, ..contact }).collect();
        Ok(Trajectory { contacts, ..moreau_jean().simulate(scene, h, every, options)? })
    }
}

/// Reports other contacts between bodies than acted.
struct OtherPairs(fn(&mut Vec<ContactRecord>));

impl Engine for OtherPairs {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        moreau_jean().describe(options)
    }

    fn simulate(&mut self, scene: &Scene, h: f64, every: usize, options: &Options) -> Reply<Trajectory> {
        let mut trajectory = moreau_jean().simulate(scene, h, every, options)?;
        (self.0)(&mut trajectory.contacts);
        Ok(trajectory)
    }
}

fn reversed(contacts: &mut [ContactRecord]) {
    for contact in contacts.iter_mut().filter(|contact| between_bodies(contact)) {
        contact.impulse = contact.impulse.map(|p| -p);
    }
}

fn turned_round(contacts: &mut [ContactRecord]) {
    for contact in contacts.iter_mut().filter(|contact| between_bodies(contact)) {
        contact.normal = contact.normal.map(|n| -n);
    }
}
