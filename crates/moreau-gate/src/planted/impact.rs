//! Mistakes at impacts and at rest.

use crate::Engine;
use crate::own::OwnParameters;
use crate::planted::wrapped::{EachStep, Misdeclare, Misread, Moment, declare_springs, moreau_jean};
use crate::planted::{Faulty, Kind, Planted};
use moreau_checks::defects::zeno::{Altered, Mistake};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::schemes::{MoreauJean, Scheme};
use moreau_exact::Result;

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    Planted {
        name: "ball/restitution-lost-at-large-steps",
        mistake: "takes an impact for resting contact when a step is longer than 2 ms, and returns nothing: what rapier 0.35.0-beta.0 \
            shows from some heights",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || {
                Box::new(Misread(|scene, h| {
                    if h > 0.002 {
                        scene.material.restitution = 0.0
                    }
                }))
            },
            caught_by: &["ball/restitution", "ball/energy"],
        },
    },
    Planted {
        name: "ball/restitution-multiplied",
        mistake: "multiplies the restitution of both bodies of a pair, where the pair's is given",
        kind: Kind::Reader,
        subject: Faulty {
            engine: || Box::new(Misread(|scene, _| scene.material.restitution *= scene.material.restitution)),
            caught_by: &["ball/restitution", "ball/energy", "impact/two-spheres"],
        },
    },
    scheme!(RESTITUTION_OF_FREE, &["ball/energy", "rest/jitter"]),
    Planted {
        name: "ball/asleep-at-the-apex",
        mistake: "puts a body to sleep when it is slower than 0.2 m/s in one step, where rest takes contact",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { after: asleep, ..EachStep::NOTHING }),
            caught_by: &["ball/zeno", "ball/penetration"],
        },
    },
    Planted {
        name: "ball/contacts-every-fourth-step",
        mistake: "looks for contacts in every fourth step only",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || {
                Box::new(EachStep {
                    before: |scene, step| {
                        if step % 4 != 0 {
                            scene.ground = None
                        }
                    },
                    ..EachStep::NOTHING
                })
            },
            caught_by: &["ball/penetration", "rest/jitter", "tumbling/depth"],
        },
    },
    Planted {
        name: "ball/baumgarte-velocity-kept",
        mistake: "corrects a fifth of the depth per step by a velocity that the body keeps",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { after: baumgarte, ..EachStep::NOTHING }),
            caught_by: &["ball/effective-restitution"],
        },
    },
    Planted {
        name: "impact/one-sided-impulse",
        mistake: "applies the impulse between two bodies to the first of them only",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { after: one_sided, ..EachStep::NOTHING }),
            caught_by: &["impact/two-spheres", "impact/cradle", "impact/plastic"],
        },
    },
    Planted {
        name: "impact/averaged-mass",
        mistake: "gives every body of an island their mean mass",
        kind: Kind::Reader,
        subject: Faulty { engine: || Box::new(Misread(averaged_mass)), caught_by: &["impact/two-spheres", "impact/plastic"] },
    },
    Planted {
        name: "rest/rule-c",
        mistake: "activates a contact when φ + h v ≤ 0 and v ≤ 0: at rest every second step is free and the body sinks",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || altered(|_| Ok(Box::new(Altered { base: MoreauJean::default(), mistake: Mistake::ApproachingOnly }))),
            caught_by: &["rest/depth", "rest/jitter"],
        },
    },
    Planted {
        name: "rest/undeclared-slop",
        mistake: "leaves 5 mm of depth uncorrected, and declares nothing",
        kind: Kind::Scheme,
        subject: Faulty { engine: || Box::new(Misread(|scene, _| lower_the_floor(scene, 0.005))), caught_by: &["rest/depth"] },
    },
    Planted {
        name: "rest/springs-that-are-not-there",
        mistake: "declares contact springs of 5 Hz, and lies on the floor",
        kind: Kind::Report,
        subject: Faulty {
            engine: || Box::new(Misdeclare { engine: moreau_jean, declare: |description| declare_springs(description, 5.0) }),
            caught_by: &["rest/depth"],
        },
    },
    Planted {
        name: "rest/floor-slightly-tilted",
        mistake: "keeps the floor's normal with an error of 0.002 and moves bodies along it out of the floor",
        kind: Kind::Scheme,
        subject: Faulty { engine: || Box::new(EachStep { after: pushed_out, ..EachStep::NOTHING }), caught_by: &["rest/drift"] },
    },
];

/// Moreau–Jean with another scheme.
fn altered(scheme: fn(&OwnParameters) -> Result<Box<dyn Scheme>>) -> Box<dyn Engine> {
    let mut engine = crate::own::by_name("moreau-jean").expect("a listed name");
    engine.certified = false;
    engine.scheme = scheme;
    Box::new(engine)
}

fn asleep(scene: &mut Scene, moment: &Moment) {
    for (body, before) in scene.bodies.iter_mut().zip(&moment.start.bodies) {
        if body.linear_velocity.iter().map(|v| v * v).sum::<f64>() < 0.2 * 0.2 {
            body.position = before.position;
            body.linear_velocity = [0.0; 3];
            body.angular_velocity = [0.0; 3];
        }
    }
}

/// Depth of a sphere in the floor z = 0 \[m\].
fn depth(body: &moreau_dynamics::scenes::Body) -> f64 {
    body.sphere.map_or(0.0, |sphere| sphere.radius - body.position[2])
}

fn baumgarte(scene: &mut Scene, moment: &Moment) {
    for body in &mut scene.bodies {
        let touches = moment.contacts.iter().any(|contact| contact.bodies.contains(&body.name));
        if touches && depth(body) > 0.0 {
            body.linear_velocity[2] = body.linear_velocity[2].max(0.2 * depth(body) / moment.h);
        }
    }
}

fn one_sided(scene: &mut Scene, moment: &Moment) {
    for contact in moment.contacts.iter().filter(|contact| contact.bodies[1] != "ground") {
        for (body, before) in scene.bodies.iter_mut().zip(&moment.start.bodies) {
            if body.name == contact.bodies[1] {
                body.linear_velocity = before.linear_velocity;
            }
        }
    }
}

fn averaged_mass(scene: &mut Scene, _: f64) {
    let mean = scene.bodies.iter().map(|body| body.mass).sum::<f64>() / scene.bodies.len() as f64;
    scene.bodies.iter_mut().for_each(|body| body.mass = mean);
}

fn lower_the_floor(scene: &mut Scene, slop: f64) {
    if let Some(ground) = &mut scene.ground {
        ground.offset -= slop;
    }
}

fn pushed_out(scene: &mut Scene, moment: &Moment) {
    for body in &mut scene.bodies {
        // A position correction of a step's fall along a normal that leans by 0.002, and gravity puts the body back.
        if moment.contacts.iter().any(|contact| contact.bodies.contains(&body.name)) {
            body.position[0] += 0.002 * 9.81 * moment.h * moment.h;
        }
    }
}
