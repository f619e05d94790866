//! Mistakes about capsules and cylinders.

use crate::planted::friction::world;
use crate::planted::pair::{pair, touching};
use crate::planted::parts::with_mechanism;
use crate::planted::wrapped::Misread;
use crate::planted::{Faulty, Kind, Planted};
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::scenes::{Body, Scene};
use moreau_exact::Result;

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    Planted {
        name: "round/hollow",
        mistake: "gives solid capsules and cylinders the inertia of a tube about their axis, m r²",
        kind: Kind::Reader,
        subject: Faulty {
            engine: || Box::new(Misread(|scene, _| rods(scene, |[x, y, _], mass, [r, _]| [x, y, mass * r * r]))),
            caught_by: &["round/cylinder-incline", "round/capsule-incline"],
        },
    },
    Planted {
        name: "round/height-for-half",
        mistake: "reads half the height of capsules and cylinders as the height where it computes their inertia",
        kind: Kind::Reader,
        subject: Faulty {
            engine: || {
                Box::new(Misread(|scene, _| rods(scene, |[x, y, z], mass, [_, l]| [x - 0.25 * mass * l * l, y - 0.25 * mass * l * l, z])))
            },
            caught_by: &["round/struck"],
        },
    },
    Planted {
        name: "round/one-point",
        mistake: "has one contact of a cylinder with the ground, though it may stand on its face",
        kind: Kind::Assembly,
        subject: Faulty { engine: || with_mechanism(world::first_touches), caught_by: &["round/standing"] },
    },
    Planted {
        name: "round/sides-pass-through",
        mistake: "has no contact between two capsules",
        kind: Kind::Assembly,
        subject: Faulty { engine: || with_mechanism(|scene| pass(scene, |body| body.capsule.is_some())), caught_by: &["round/crossed"] },
    },
    Planted {
        name: "round/cylinders-pass-through",
        mistake: "has no contact between two cylinders, and does not say so",
        kind: Kind::Assembly,
        subject: Faulty { engine: || with_mechanism(|scene| pass(scene, |body| body.cylinder.is_some())), caught_by: &["round/crossed"] },
    },
];

/// Where all bodies are of this shape, they touch the ground only.
fn pass(scene: &Scene, is: fn(&Body) -> bool) -> Result<(Box<dyn Mechanism>, State)> {
    if scene.bodies.iter().all(is) {
        touching(scene, |contacts, _, _| contacts.retain(|one| pair(one).is_none()))
    } else {
        scene.spatial_mechanism()
    }
}

/// Changes the moments of capsules and cylinders, given their mass and their radius and half height.
fn rods(scene: &mut Scene, change: fn([f64; 3], f64, [f64; 2]) -> [f64; 3]) {
    for body in &mut scene.bodies {
        let capsule = body.capsule.map(|one| [one.radius, one.half_height]);
        let sizes = capsule.or(body.cylinder.map(|one| [one.radius, one.half_height]));
        if let (Some(sizes), Ok(shape)) = (sizes, body.shape()) {
            body.inertia = Some(change(shape.solid_moments(body.mass), body.mass, sizes));
        }
    }
}
