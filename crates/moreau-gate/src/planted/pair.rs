//! Mistakes between two bodies.

use crate::planted::parts::with_mechanism;
use crate::planted::wrapped::{EachStep, Misread, Moment};
use crate::planted::{Faulty, Kind, Planted};
use delegate::delegate;
use moreau_contact::contact::Contact;
use moreau_dynamics::mechanics::{BodyState, Mechanism, State};
use moreau_dynamics::scenes::{Body, PairOverride, Scene};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector, Quaternion, UnitQuaternion, Vector3};

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    Planted {
        name: "pair/friction-turns-the-first-only",
        mistake: "lets friction between two bodies act at the centre of the second one: it is not turned",
        kind: Kind::Assembly,
        subject: Faulty {
            engine: || with_mechanism(|scene| touching(scene, |contacts, _, _| contacts.iter_mut().for_each(unlever_the_second))),
            caught_by: &["pair/oblique-spheres", "pair/ball-on-box"],
        },
    },
    Planted {
        name: "pair/friction-with-the-ground-only",
        mistake: "has friction with the ground, and none between bodies",
        kind: Kind::Reader,
        subject: Faulty {
            engine: || Box::new(Misread(|scene, _| smooth_pairs(scene))),
            caught_by: &["pair/oblique-spheres", "pair/ball-on-box", "pair/plank-on-plank"],
        },
    },
    Planted {
        name: "pair/no-edge-on-edge",
        mistake: "looks for corners in faces only: two edges that cross do not touch",
        kind: Kind::Scheme,
        subject: Faulty { engine: || with_mechanism(|scene| touching(scene, without_edges)), caught_by: &["pair/crossed-bars"] },
    },
    Planted {
        name: "pair/sphere-through-box",
        mistake: "has no contact between a sphere and a box",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || {
                with_mechanism(|scene| {
                    touching(scene, |contacts, spheres, _| contacts.retain(|one| pair(one).is_none_or(|[a, b]| spheres[a] == spheres[b])))
                })
            },
            caught_by: &["pair/ball-on-box"],
        },
    },
    Planted {
        name: "pair/material-pairs-ignored",
        mistake: "takes the common friction and restitution for every pair",
        kind: Kind::Reader,
        subject: Faulty { engine: || Box::new(Misread(|scene, _| scene.material.pairs.clear())), caught_by: &["pair/material-pairs"] },
    },
    Planted {
        name: "pair/restitution-of-the-first-contact",
        mistake: "takes restitution of the first contact of a step only",
        kind: Kind::Assembly,
        subject: Faulty {
            engine: || {
                with_mechanism(|scene| touching(scene, |contacts, _, _| contacts.iter_mut().skip(1).for_each(|one| one.restitution = 0.0)))
            },
            caught_by: &["pair/material-pairs"],
        },
    },
    Planted {
        name: "pair/pairs-named-before-the-ground-ignored",
        mistake: "ignores values of a pair that names the ground second",
        kind: Kind::Reader,
        subject: Faulty {
            engine: || Box::new(Misread(|scene, _| scene.material.pairs.retain(|pair| pair.bodies[1] != "ground"))),
            caught_by: &["pair/material-pairs"],
        },
    },
    Planted {
        name: "pair/friction-of-boxes-at-their-centres",
        mistake: "lets friction between two boxes act at both centres: it turns neither",
        kind: Kind::Assembly,
        subject: Faulty {
            engine: || {
                with_mechanism(|scene| {
                    touching(scene, |contacts, spheres, _| contacts.iter_mut().filter(|one| boxes(one, spheres)).for_each(unlever_both))
                })
            },
            caught_by: &["pair/any-direction"],
        },
    },
    Planted {
        name: "pair/box-before-ball-without-friction",
        mistake: "has no friction between a box and a ball that the scene lists after it",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || {
                with_mechanism(|scene| {
                    touching(scene, |contacts, spheres, _| {
                        let reversed = |one: &&mut Contact| pair(one).is_some_and(|[first, second]| !spheres[first] && spheres[second]);
                        contacts.iter_mut().filter(reversed).for_each(|one| one.friction = 0.0);
                    })
                })
            },
            caught_by: &["pair/any-direction", "pair/material-pairs"],
        },
    },
    Planted {
        name: "pair/edges-without-friction",
        mistake: "has no friction where two edges cross",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || {
                with_mechanism(|scene| {
                    touching(scene, |contacts, spheres, position| {
                        contacts.iter_mut().filter(|one| crossing(one, spheres, position)).for_each(|one| one.friction = 0.0);
                    })
                })
            },
            caught_by: &["pair/crossed-bars"],
        },
    },
    Planted {
        name: "pair/asleep-for-good",
        mistake: "puts a body to sleep that has been slower than 20 mm/s for half a second, and never wakes it",
        kind: Kind::Scheme,
        subject: Faulty { engine: || Box::new(EachStep { after: asleep, ..EachStep::NOTHING }), caught_by: &["pair/woken"] },
    },
    Planted {
        name: "pair/boxes-never-stick",
        mistake: "lets friction between boxes grow with their slip up to 0.1 m/s, and does not declare it",
        kind: Kind::Scheme,
        subject: Faulty { engine: || Box::new(EachStep { before: viscous, ..EachStep::NOTHING }), caught_by: &["pair/held"] },
    },
    Planted {
        name: "pair/no-mass-above-100-kg",
        mistake: "takes masses above 100 kg for 100 kg, to spare its solver",
        kind: Kind::Reader,
        subject: Faulty { engine: || Box::new(Misread(|scene, _| at_most(scene, 100.0))), caught_by: &["pair/central"] },
    },
    Planted {
        name: "pair/box-before-ball-lost",
        mistake: "looks for a contact of ball and box only if the ball is listed first",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || {
                with_mechanism(|scene| {
                    touching(scene, |contacts, spheres, _| contacts.retain(|one| pair(one).is_none_or(|[a, b]| spheres[a] || !spheres[b])))
                })
            },
            caught_by: &["pair/central", "pair/off-centre", "pair/ball-on-box"],
        },
    },
    Planted {
        name: "pair/box-has-faces-only-for-balls",
        mistake: "lets a ball touch the faces of a box, not its edges and corners",
        kind: Kind::Scheme,
        subject: Faulty { engine: || with_mechanism(|scene| touching(scene, faces_for_balls)), caught_by: &["pair/off-centre"] },
    },
    Planted {
        name: "pair/given-inertia-ignored",
        mistake: "computes the inertia of a box from its mass and edges where the scene gives another one",
        kind: Kind::Reader,
        subject: Faulty {
            engine: || Box::new(Misread(|scene, _| scene.bodies.iter_mut().for_each(|body| body.inertia = None))),
            caught_by: &["pair/off-centre"],
        },
    },
    Planted {
        name: "pair/no-restitution-below-half-a-metre-per-second",
        mistake: "has no restitution between two bodies that approach with less than ½ m/s, and declares no threshold",
        kind: Kind::Scheme,
        subject: Faulty { engine: || Box::new(Misread(slow_pairs)), caught_by: &["pair/central"] },
    },
    Planted {
        name: "pair/rough-boxes-are-plastic",
        mistake: "has no restitution at the contacts of boxes that have friction",
        kind: Kind::Assembly,
        subject: Faulty {
            engine: || {
                with_mechanism(|scene| {
                    touching(scene, |contacts, spheres, _| {
                        of_boxes(contacts, spheres).filter(|one| one.friction > 0.0).for_each(|one| one.restitution = 0.0)
                    })
                })
            },
            caught_by: &["pair/rough-corner"],
        },
    },
    Planted {
        name: "pair/bouncing-boxes-are-smooth",
        mistake: "has no friction at the contacts of boxes that have restitution",
        kind: Kind::Assembly,
        subject: Faulty {
            engine: || {
                with_mechanism(|scene| {
                    touching(scene, |contacts, spheres, _| {
                        of_boxes(contacts, spheres).filter(|one| one.restitution > 0.0).for_each(|one| one.friction = 0.0)
                    })
                })
            },
            caught_by: &["pair/rough-corner"],
        },
    },
];

/// Changes contacts, given which bodies are spheres and where all of them are.
pub(super) type Change = fn(&mut Vec<Contact>, &[bool], &DVector<f64>);

/// A mechanism whose contacts are changed.
struct Touching {
    inner: Box<dyn Mechanism>,
    spheres: Vec<bool>,
    change: Change,
}

impl Mechanism for Touching {
    delegate! {
        to self.inner {
            fn name(&self) -> &str;
            fn degrees_of_freedom(&self) -> usize;
            fn rows_per_contact(&self) -> usize;
            fn mass_matrix(&self, position: &DVector<f64>) -> DMatrix<f64>;
            fn force(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64>;
            fn mean_force(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64>;
            fn potential_energy(&self, position: &DVector<f64>) -> f64;
            fn integrate(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64>;
            fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState>;
        }
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let mut contacts = self.inner.contacts(position);
        (self.change)(&mut contacts, &self.spheres, position);
        contacts
    }
}

pub(super) fn touching(scene: &Scene, change: Change) -> Result<(Box<dyn Mechanism>, State)> {
    let (inner, start) = scene.spatial_mechanism()?;
    let spheres = scene.bodies.iter().map(|body| body.sphere.is_some()).collect();
    Ok((Box::new(Touching { inner, spheres, change }), start))
}

/// Both bodies of a contact that is not on the ground.
pub(super) fn pair(contact: &Contact) -> Option<[usize; 2]> {
    let (first, second) = contact.place?.bodies;
    Some([first, second?])
}

/// Tangential rows without the second body's spin.
fn unlever_the_second(contact: &mut Contact) {
    let Some([_, second]) = pair(contact) else { return };
    let mut rows = contact.jacobian.to_dense();
    rows.view_mut((1, 6 * second + 3), (rows.nrows() - 1, 3)).fill(0.0);
    contact.jacobian = rows.into();
}

/// Tangential rows without any spin.
fn unlever_both(contact: &mut Contact) {
    let Some(bodies) = pair(contact) else { return };
    let mut rows = contact.jacobian.to_dense();
    for body in bodies {
        rows.view_mut((1, 6 * body + 3), (rows.nrows() - 1, 3)).fill(0.0);
    }
    contact.jacobian = rows.into();
}

pub(super) fn boxes(contact: &Contact, spheres: &[bool]) -> bool {
    pair(contact).is_some_and(|bodies| bodies.iter().all(|body| !spheres[*body]))
}

/// Whether two boxes meet along none of their axes.
fn crossing(contact: &Contact, spheres: &[bool], position: &DVector<f64>) -> bool {
    let (Some(bodies), Some(place)) = (pair(contact), contact.place) else { return false };
    let normal = Vector3::from(place.frame[0]);
    boxes(contact, spheres) && bodies.iter().all(|body| axes_along(&normal, position, *body) <= 0.99)
}

fn without_edges(contacts: &mut Vec<Contact>, spheres: &[bool], position: &DVector<f64>) {
    contacts.retain(|one| !crossing(one, spheres, position));
}

/// How long a body has been slow \[s\] is kept beside the scene.
fn asleep(scene: &mut Scene, moment: &Moment) {
    for body in &mut scene.bodies {
        let slow = [body.linear_velocity, body.angular_velocity].iter().all(|velocity| Vector3::from(*velocity).norm() < 0.02);
        let rested = scene.engines.get(&body.name).and_then(serde_json::Value::as_f64).unwrap_or(0.0);
        let rested = if slow || rested > 0.5 { rested + moment.h } else { 0.0 };
        scene.engines.insert(body.name.clone(), rested.into());
        if rested > 0.5 {
            [body.linear_velocity, body.angular_velocity] = [[0.0; 3]; 2];
        }
    }
}

/// The common friction by the largest difference of velocities of boxes. The floor keeps its own.
fn viscous(scene: &mut Scene, _: usize) {
    let boxes: Vec<&Body> = scene.bodies.iter().filter(|body| body.cuboid.is_some()).collect();
    let velocity = |body: &Body| Vector3::from(body.linear_velocity);
    let mut own = Vec::new();
    for (k, first) in boxes.iter().enumerate() {
        for second in &boxes[k + 1..] {
            let slip = (velocity(first) - velocity(second)).norm();
            let friction = Some(scene.material.friction * (slip / 0.1).min(1.0));
            own.push(PairOverride { bodies: [first.name.clone(), second.name.clone()], friction, restitution: None });
        }
    }
    scene.material.pairs = own;
}

/// Drops what a ball and a box have along none of the box's axes: an edge or a corner.
fn faces_for_balls(contacts: &mut Vec<Contact>, spheres: &[bool], position: &DVector<f64>) {
    contacts.retain(|one| match (pair(one), one.place) {
        (Some([first, second]), Some(place)) if spheres[first] != spheres[second] => {
            let block = if spheres[first] { second } else { first };
            axes_along(&Vector3::from(place.frame[0]), position, block) > 0.99
        }
        _ => true,
    });
}

/// The contacts of boxes, with each other, with spheres and with the ground.
fn of_boxes<'a>(contacts: &'a mut [Contact], spheres: &[bool]) -> impl Iterator<Item = &'a mut Contact> {
    contacts.iter_mut().filter(|one| of_a_box(one, spheres))
}

/// Whether the first body of a contact is a box, or the second.
fn of_a_box(contact: &Contact, spheres: &[bool]) -> bool {
    contact.place.is_some_and(|place| !spheres[place.bodies.0] || place.bodies.1.is_some_and(|second| !spheres[second]))
}

/// Largest component of a direction along an axis of a body.
fn axes_along(direction: &Vector3<f64>, position: &DVector<f64>, body: usize) -> f64 {
    let turn: Vec<f64> = position.rows(7 * body + 3, 4).iter().copied().collect();
    let rotation = UnitQuaternion::new_normalize(Quaternion::new(turn[0], turn[1], turn[2], turn[3]));
    rotation.inverse_transform_vector(direction).amax()
}

fn at_most(scene: &mut Scene, mass: f64) {
    for body in &mut scene.bodies {
        body.mass = body.mass.min(mass);
    }
}

fn slow_pairs(scene: &mut Scene, _: f64) {
    let speeds = scene.bodies.iter().map(|body| Vector3::from(body.linear_velocity).norm());
    if scene.bodies.len() == 2 && speeds.fold(0.0, f64::max) < 0.5 {
        scene.material.restitution = 0.0;
    }
}

fn smooth_pairs(scene: &mut Scene) {
    let names: Vec<String> = scene.bodies.iter().map(|body| body.name.clone()).collect();
    for (k, first) in names.iter().enumerate() {
        let smooth = |second: &String| PairOverride { bodies: [first.clone(), second.clone()], friction: Some(0.0), restitution: None };
        scene.material.pairs.extend(names[k + 1..].iter().map(smooth));
    }
}
