//! Mistakes of restitution: where it is lost, and where it does not belong.

use crate::planted::friction::world::first_bounces;
use crate::planted::parts::with_mechanism;
use crate::planted::wrapped::{EachStep, Misread, Moment};
use crate::planted::{Faulty, Kind, Planted};
use moreau_dynamics::scenes::{Body, Scene};
use nalgebra::Vector3;

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    Planted {
        name: "bounce/plastic-boxes",
        mistake: "lets boxes land as if e were 0",
        kind: Kind::Scheme,
        subject: Faulty { engine: || Box::new(Misread(plastic_boxes)), caught_by: &["bounce/flat-box", "bounce/corner"] },
    },
    Planted {
        name: "bounce/first-contact-only",
        mistake: "uses e at the first of the deepest contacts, and 0 at the others",
        kind: Kind::Assembly,
        subject: Faulty { engine: || with_mechanism(first_bounces), caught_by: &["bounce/flat-box"] },
    },
    Planted {
        name: "bounce/mean-inertia",
        mistake: "gives a box the mean of its three moments of inertia about every axis",
        kind: Kind::Reader,
        subject: Faulty { engine: || Box::new(Misread(mean_inertia)), caught_by: &["bounce/corner"] },
    },
    Planted {
        name: "bounce/silent-threshold",
        mistake: "has no restitution below 0.1 m/s, and does not declare it",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { before: |scene, _| plastic_below(scene, 0.1), ..EachStep::NOTHING }),
            caught_by: &["bounce/slow"],
        },
    },
    Planted {
        name: "bounce/plastic-at-small-steps",
        mistake: "loses restitution at steps below 0.5 ms, in which a body moves less than a threshold of lengths",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || {
                Box::new(Misread(|scene, h| {
                    if h < 5e-4 {
                        scene.material.restitution = 0.0
                    }
                }))
            },
            caught_by: &["bounce/every-step"],
        },
    },
    Planted {
        name: "bounce/tangential-restitution",
        mistake: "reverses the tangential velocity of a contact by e, too, as far as friction can",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { after: tangential_restitution, ..EachStep::NOTHING }),
            caught_by: &["bounce/spinning-ball"],
        },
    },
    Planted {
        name: "bounce/opening-contact-bounces",
        mistake: "asks of a contact that opens for e times the speed with which it does",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { after: opening_bounces, ..EachStep::NOTHING }),
            caught_by: &["bounce/separating"],
        },
    },
    Planted {
        name: "bounce/approach-of-centres",
        mistake: "returns e of the speed at which centres approach: what only turns does not bounce",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { before: |scene, _| plastic_unless_centres_approach(scene), ..EachStep::NOTHING }),
            caught_by: &["bounce/turning-bar"],
        },
    },
    Planted {
        name: "bounce/approach-of-centres-of-boxes",
        mistake: "between two boxes returns e of the speed at which their centres approach",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { before: |scene, _| plastic_boxes_unless_centres_approach(scene), ..EachStep::NOTHING }),
            caught_by: &["bounce/turning-bar"],
        },
    },
];

fn plastic_boxes(scene: &mut Scene, _: f64) {
    if scene.bodies.iter().any(|body| body.cuboid.is_some()) {
        scene.material.restitution = 0.0;
    }
}

fn mean_inertia(scene: &mut Scene, _: f64) {
    for body in &mut scene.bodies {
        if let (Some(cuboid), None) = (body.cuboid, body.inertia) {
            let square: f64 = cuboid.half_extents.iter().map(|half| half * half).sum();
            body.inertia = Some([body.mass * square * 2.0 / 9.0; 3]);
        }
    }
}

fn plastic_below(scene: &mut Scene, threshold: f64) {
    if scene.bodies.iter().all(|body| Vector3::from(body.linear_velocity).norm() < threshold) {
        scene.material.restitution = 0.0;
    }
}

fn plastic_boxes_unless_centres_approach(scene: &mut Scene) {
    if scene.bodies.len() > 1 && scene.bodies.iter().all(|body| body.cuboid.is_some()) {
        plastic_unless_centres_approach(scene);
    }
}

fn plastic_unless_centres_approach(scene: &mut Scene) {
    let approach = |first: &Body, second: &Body| {
        let [apart, rate] = [(first.position, second.position), (first.linear_velocity, second.linear_velocity)]
            .map(|(first, second)| Vector3::from(second) - Vector3::from(first));
        apart.dot(&rate) < 0.0
    };
    let falls =
        |body: &Body| scene.ground.is_some_and(|ground| Vector3::from(ground.normal).dot(&Vector3::from(body.linear_velocity)) < 0.0);
    let meets = |k: usize| scene.bodies[..k].iter().any(|other| approach(other, &scene.bodies[k]));
    if !(0..scene.bodies.len()).any(|k| falls(&scene.bodies[k]) || meets(k)) {
        scene.material.restitution = 0.0;
    }
}

/// Velocity along the floor of the lowest point of a ball \[m/s\], and its lever \[m\].
fn slip(body: &Body, radius: f64) -> (Vector3<f64>, Vector3<f64>) {
    let lever = Vector3::new(0.0, 0.0, -radius);
    let mut velocity = Vector3::from(body.linear_velocity) + Vector3::from(body.angular_velocity).cross(&lever);
    velocity.z = 0.0;
    (velocity, lever)
}

fn tangential_restitution(scene: &mut Scene, moment: &Moment) {
    let (friction, restitution) = (scene.material.friction, scene.material.restitution);
    for (body, before) in scene.bodies.iter_mut().zip(&moment.start.bodies) {
        let (Some(sphere), Some(contact)) = (body.sphere, moment.contacts.iter().find(|contact| contact.bodies[0] == body.name)) else {
            continue;
        };
        let stopping = 2.0 / 7.0 * body.mass;
        let (arriving, lever) = slip(before, sphere.radius);
        let made = Vector3::from(contact.impulse);
        let left = (friction * made.z - made.xy().norm()).max(0.0);
        let more = -arriving * restitution * stopping;
        let more = more * (left / more.norm()).min(1.0);
        let turned = lever.cross(&more) / (0.4 * body.mass * sphere.radius * sphere.radius);
        body.linear_velocity = (Vector3::from(body.linear_velocity) + more / body.mass).into();
        body.angular_velocity = (Vector3::from(body.angular_velocity) + turned).into();
    }
}

fn opening_bounces(scene: &mut Scene, moment: &Moment) {
    let restitution = scene.material.restitution;
    for (body, before) in scene.bodies.iter_mut().zip(&moment.start.bodies) {
        let closed = before.sphere.is_some_and(|sphere| scene.ground.is_some() && before.position[2] < sphere.radius);
        if closed && before.linear_velocity[2] > 0.0 {
            body.linear_velocity[2] = body.linear_velocity[2].max(restitution * before.linear_velocity[2]);
        }
    }
}
