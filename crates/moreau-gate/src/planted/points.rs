//! Mistakes about the points at which bodies touch, and about bodies that are left without any.

use crate::planted::pair::{boxes, touching};
use crate::planted::parts::with_mechanism;
use crate::planted::wrapped::{EachStep, Moment};
use crate::planted::{Faulty, Kind, Planted};
use moreau_contact::contact::{Contact, Rows};
use moreau_dynamics::scenes::Scene;
use nalgebra::{DVector, Vector3};

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    Planted {
        name: "pair/faces-bounce-in-the-middle",
        mistake: "lets one point in the middle stand for all points of two boxes that have restitution",
        kind: Kind::Assembly,
        subject: Faulty {
            engine: || with_mechanism(|scene| touching(scene, |contacts, spheres, _| meet_in_the_middle(contacts, spheres))),
            caught_by: &["pair/faces"],
        },
    },
    Planted {
        name: "limits/points-nearer-than-5-cm-merged",
        mistake: "takes contact points of two bodies that are nearer than 5 cm for one",
        kind: Kind::Assembly,
        subject: Faulty { engine: || with_mechanism(|scene| touching(scene, merged)), caught_by: &["limits/small"] },
    },
    Planted {
        name: "pair/wakes-only-what-is-hit",
        mistake: "lets a body sleep that has been slower than 1 mm/s for half a second, until something pushes it along the floor",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { after: asleep_until_hit, ..EachStep::NOTHING }),
            caught_by: &["pair/support-leaves"],
        },
    },
];

/// The normal rows of the points of two bouncing boxes become their mean.
fn meet_in_the_middle(contacts: &mut [Contact], spheres: &[bool]) {
    let chosen: Vec<usize> = (0..contacts.len()).filter(|k| contacts[*k].restitution > 0.0 && boxes(&contacts[*k], spheres)).collect();
    for &k in &chosen {
        let bodies = |k: usize| contacts[k].place.map(|place| place.bodies);
        let same: Vec<usize> = chosen.iter().copied().filter(|other| bodies(*other) == bodies(k)).collect();
        let rows = same.iter().map(|other| contacts[*other].jacobian.to_dense());
        let mean = rows.reduce(|sum, one| sum + one).map(|sum| sum / same.len() as f64);
        let mut own = contacts[k].jacobian.to_dense();
        if let Some(mean) = mean {
            own.set_row(0, &mean.row(0));
        }
        contacts[k].jacobian = Rows::from(own);
    }
}

/// Later points go that are near an earlier one: l × n of two points with one normal are as far apart as the points are.
fn merged(contacts: &mut Vec<Contact>, _: &[bool], _: &DVector<f64>) {
    let arm = |one: &Contact| {
        let body = one.place.map_or(0, |place| place.bodies.0);
        let rows = one.jacobian.to_dense();
        Vector3::from_fn(|axis, _| rows[(0, 6 * body + 3 + axis)])
    };
    let mut kept: Vec<Contact> = Vec::new();
    for one in contacts.drain(..) {
        let same = |other: &Contact| other.place.map(|place| place.bodies) == one.place.map(|place| place.bodies);
        if !kept.iter().any(|other| same(other) && (arm(other) - arm(&one)).norm() < 0.05) {
            kept.push(one);
        }
    }
    *contacts = kept;
}

/// How long a body has been at rest \[s\] is kept beside the scene.
fn asleep_until_hit(scene: &mut Scene, moment: &Moment) {
    for (body, before) in scene.bodies.iter_mut().zip(&moment.start.bodies) {
        let slow = [body.linear_velocity, body.angular_velocity].iter().all(|velocity| Vector3::from(*velocity).norm() < 1e-3);
        let pushed = (Vector3::from(body.linear_velocity) - Vector3::from(before.linear_velocity)).xy().norm() > 1e-3;
        let rested = scene.engines.get(&body.name).and_then(serde_json::Value::as_f64).unwrap_or(0.0);
        let rested = if (slow || rested > 0.5) && !pushed { rested + moment.h } else { 0.0 };
        scene.engines.insert(body.name.clone(), rested.into());
        if rested > 0.5 {
            [body.position, body.linear_velocity, body.angular_velocity] = [before.position, [0.0; 3], [0.0; 3]];
        }
    }
}
