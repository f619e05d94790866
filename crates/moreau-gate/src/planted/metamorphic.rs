//! Mistakes that single out a direction, a place, a unit, a frame or a time step.

use crate::planted::parts::{Altered, Answers, moreau_jean, with_solver};
use crate::planted::{Faulty, Kind, Planted};
use moreau_checks::defects::solvers;

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    solver!(ALONG_AXES, &["metamorphic/rotation", "metamorphic/tilt"]),
    solver!(ROUNDED_DOWN, &["metamorphic/mirror", "metamorphic/rotation"]),
    Planted {
        name: "metamorphic/single-precision-positions",
        mistake: "stores positions with 24 bits and declares double precision",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || moreau_jean(|engine| engine.scheme = |_| Ok(Box::new(SINGLE))),
            caught_by: &["metamorphic/translation"],
        },
    },
    Planted {
        name: "metamorphic/absolute-speed-limit",
        mistake: "limits every speed to 100 of whatever unit the scene has",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || moreau_jean(|engine| engine.scheme = |_| Ok(Box::new(LIMITED))),
            caught_by: &["metamorphic/units"],
        },
    },
    Planted {
        name: "metamorphic/damping-in-the-world",
        mistake: "takes 4 % a second from every velocity and does not declare it",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || moreau_jean(|engine| engine.scheme = |_| Ok(Box::new(DAMPED))),
            caught_by: &["metamorphic/galilean"],
        },
    },
    Planted {
        name: "metamorphic/damping-per-step",
        mistake: "takes 1 % from every velocity in every step, however long the step is",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || moreau_jean(|engine| engine.scheme = |_| Ok(Box::new(DAMPED_PER_STEP))),
            caught_by: &["metamorphic/halving", "metamorphic/galilean"],
        },
    },
];

const SINGLE: Altered = Altered { position: |position| position.iter_mut().for_each(|x| *x = f64::from(*x as f32)), ..Altered::NOTHING };

const LIMITED: Altered =
    Altered { moving_velocity: |velocity| velocity.iter_mut().for_each(|v| *v = v.clamp(-100.0, 100.0)), ..Altered::NOTHING };

const DAMPED: Altered = Altered { free_velocity: |velocity, h| *velocity *= 1.0 - 0.04 * h, ..Altered::NOTHING };

const DAMPED_PER_STEP: Altered = Altered { free_velocity: |velocity, _| *velocity *= 0.99, ..Altered::NOTHING };
