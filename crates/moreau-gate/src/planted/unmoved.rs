//! Mistakes about bodies that nothing moves.

use crate::planted::wrapped::{EachStep, Misread, Moment};
use crate::planted::{Faulty, Kind, Planted};
use moreau_dynamics::scenes::{Prescribed, Scene};

/// The mistakes of these families.
pub const PLANTED: &[Planted<Faulty>] = &[
    Planted {
        name: "fixed/heavy",
        mistake: "gives a static body a mass of 1 t in place of an infinite one",
        kind: Kind::Reader,
        subject: Faulty { engine: || Box::new(Misread(heavy)), caught_by: &["fixed/bounce", "fixed/rest"] },
    },
    Planted {
        name: "conveyor/contacts-see-no-motion",
        mistake: "moves a body with a prescribed velocity from step to step, but its contacts see it at rest",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(EachStep { before: stopped, after: carried }),
            caught_by: &["conveyor/box", "conveyor/sphere"],
        },
    },
];

fn heavy(scene: &mut Scene, _: f64) {
    for body in scene.bodies.iter_mut().filter(|body| body.is_static) {
        (body.is_static, body.mass) = (false, 1e3);
    }
}

fn stopped(scene: &mut Scene, _: usize) {
    for body in scene.bodies.iter_mut().filter(|body| body.prescribed.is_some()) {
        body.prescribed = Some(Prescribed { velocity: [0.0; 3], angular_velocity: [0.0; 3] });
    }
}

fn carried(scene: &mut Scene, moment: &Moment) {
    for body in &mut scene.bodies {
        if let Some(prescribed) = body.prescribed {
            (0..3).for_each(|axis| body.position[axis] += moment.h * prescribed.velocity[axis]);
        }
    }
}
