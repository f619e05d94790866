//! Mistakes of friction, of the lever it acts at, and of what is reported about it.

mod reports;
pub(super) mod world;

use crate::Engine;
use crate::own::{OwnEngine, OwnScheme, by_name};
use crate::planted::{Faulty, Kind, Planted};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;
use reports::Reporting;

/// The mistakes of these families.
pub const PLANTED: &[Planted<Faulty>] = &[
    solver!(TURNED_TO_DIAGONALS, &["incline/slide", "isotropy/deceleration", "contact/dissipation"]),
    solver!(BOXED, &["isotropy/straight", "isotropy/deceleration", "contact/cone"]),
    solver!(LAGGED, &["contact/cone", "contact/dissipation"]),
    solver!(KINETIC, &["incline/slide", "contact/dissipation"]),
    solver!(REGULARISED, &["incline/stick", "incline/stick-threshold"]),
    solver!(ALONG_SLIP, &["contact/increment", "contact/dissipation", "isotropy/deceleration"]),
    Planted {
        name: "incline/undeclared-relaxation",
        mistake: "solves the convex relaxation and declares Coulomb's law",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(OwnEngine { law: OwnScheme::Coulomb, ..own("anitescu") }),
            caught_by: &["incline/hop", "incline/gap", "contact/complementarity"],
        },
    },
    Planted {
        name: "incline/friction-squared",
        mistake: "multiplies the friction of both surfaces although the scene gives that of the pair: μ²",
        kind: Kind::Reader,
        subject: Faulty {
            engine: || misread(|scene| scene.material.friction *= scene.material.friction),
            caught_by: &["incline/slide", "incline/stick-threshold", "isotropy/deceleration"],
        },
    },
    Planted {
        name: "incline/friction-root-two",
        mistake: "takes a pyramid around the cone along its diagonals: √2 μ",
        kind: Kind::Reader,
        subject: Faulty {
            engine: || misread(|scene| scene.material.friction *= std::f64::consts::SQRT_2),
            caught_by: &["incline/stick-threshold", "contact/cone", "isotropy/deceleration"],
        },
    },
    Planted {
        name: "rolling/hollow-sphere",
        mistake: "gives a solid sphere the inertia of a hollow one, ⅔ m r²",
        kind: Kind::Reader,
        subject: Faulty {
            engine: || misread(world::hollow_spheres),
            caught_by: &["rolling/five-sevenths", "rolling/incline", "contact/momentum"],
        },
    },
    Planted {
        name: "contact/inertia-of-full-extents",
        mistake: "computes a box's inertia from its edges instead of half of them, four times too much",
        kind: Kind::Reader,
        subject: Faulty { engine: || misread(world::full_extents), caught_by: &["contact/momentum"] },
    },
    Planted {
        name: "rolling/resistance",
        mistake: "damps the spin with 1/s and does not declare it",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(OwnEngine { mechanism: world::damped_spin, ..own("moreau-jean") }),
            caught_by: &["rolling/five-sevenths", "rolling/incline"],
        },
    },
    Planted {
        name: "rolling/friction-at-centre",
        mistake: "lets friction act at the centre of mass: no torque",
        kind: Kind::Assembly,
        subject: Faulty {
            engine: || Box::new(OwnEngine { mechanism: world::friction_at_centre, ..own("moreau-jean") }),
            caught_by: &["rolling/five-sevenths", "contact/momentum"],
        },
    },
    scheme!(BAUMGARTE, &["energy/passive"]),
    Planted {
        name: "contact/early",
        mistake: "activates contacts 3 cm above the floor",
        kind: Kind::Scheme,
        subject: Faulty {
            engine: || Box::new(OwnEngine { mechanism: world::thick_floor, ..own("moreau-jean") }),
            caught_by: &["contact/complementarity"],
        },
    },
    Planted {
        name: "contact/left-handed-frame",
        mistake: "reports friction in a left-handed frame: one tangent is reversed",
        kind: Kind::Report,
        subject: Faulty {
            engine: || reported(|trajectory| trajectory.contacts.iter_mut().for_each(|contact| contact.impulse[1] *= -1.0)),
            caught_by: &["contact/momentum", "contact/dissipation"],
        },
    },
    Planted {
        name: "contact/force-as-impulse",
        mistake: "reports forces where impulses are asked for",
        kind: Kind::Report,
        subject: Faulty { engine: || reported(reports::forces), caught_by: &["contact/momentum"] },
    },
    Planted {
        name: "contact/late",
        mistake: "reports every impulse one sample late",
        kind: Kind::Report,
        subject: Faulty { engine: || reported(reports::late), caught_by: &["contact/momentum", "tumbling/momentum"] },
    },
    Planted {
        name: "contact/normal-reversed",
        mistake: "reports normals from the first body to the second",
        kind: Kind::Report,
        subject: Faulty {
            engine: || {
                reported(|trajectory| trajectory.contacts.iter_mut().for_each(|contact| contact.normal = contact.normal.map(|n| -n)))
            },
            caught_by: &["contact/cone"],
        },
    },
];

fn own(name: &str) -> OwnEngine {
    OwnEngine { certified: false, ..by_name(name).expect("a listed name") }
}

/// Moreau–Jean that simulates another scene than it was given.
fn misread(change: fn(&mut Scene)) -> Box<dyn Engine> {
    Box::new(Reporting { engine: own("moreau-jean"), scene: change, trajectory: |_| {} })
}

/// Moreau–Jean that reports another trajectory than it computed.
fn reported(change: fn(&mut Trajectory)) -> Box<dyn Engine> {
    Box::new(Reporting { engine: own("moreau-jean"), scene: |_| {}, trajectory: change })
}
