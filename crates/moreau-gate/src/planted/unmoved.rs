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
    Planted {
        name: "conveyor/friction-along-x-only",
        mistake: "has nine tenths of the friction on a conveyor that does not run along x",
        kind: Kind::Scheme,
        subject: Faulty { engine: || Box::new(Misread(weaker_beside_x)), caught_by: &["conveyor/box", "conveyor/sphere"] },
    },
    Planted {
        name: "conveyor/stands-still",
        mistake: "reads a body with a prescribed velocity as one that nothing moves, and leaves it where it is",
        kind: Kind::Reader,
        subject: Faulty { engine: || Box::new(Misread(still)), caught_by: &["conveyor/box", "conveyor/sphere"] },
    },
];

fn still(scene: &mut Scene, _: f64) {
    for body in scene.bodies.iter_mut().filter(|body| body.prescribed.is_some()) {
        (body.prescribed, body.is_static) = (None, true);
    }
}

fn heavy(scene: &mut Scene, _: f64) {
    for body in scene.bodies.iter_mut().filter(|body| body.is_static) {
        (body.is_static, body.mass) = (false, 1e3);
    }
}

fn weaker_beside_x(scene: &mut Scene, _: f64) {
    let beside = |[x, y, z]: [f64; 3]| y.hypot(z) > 0.1 * x.abs();
    if scene.bodies.iter().filter_map(|body| body.prescribed).any(|belt| beside(belt.velocity)) {
        scene.material.friction *= 0.9;
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
