//! Mistakes of friction, of the lever it acts at, and of what is reported about it.

mod reports;
mod solver;
mod world;

use crate::Engine;
use crate::own::{OwnEngine, OwnScheme, by_name};
use crate::planted::Planted;
use crate::planted::parts::with_solver;
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;
use reports::Reporting;
use solver::RowByRow;

/// The mistakes of these families.
pub const PLANTED: &[Planted] = &[
    Planted {
        name: "incline/friction-not-opposed",
        mistake: "keeps sliding friction on the cone, but turned from the slip towards the diagonals of the tangents",
        engine: || with_solver(|| Box::new(RowByRow(solver::turned_to_diagonals))),
        caught_by: &["incline/slide", "isotropy/deceleration", "contact/dissipation"],
    },
    Planted {
        name: "isotropy/boxed-friction",
        mistake: "bounds each tangent's friction by μ r_n for itself, and declares a cone",
        engine: || with_solver(|| Box::new(RowByRow(solver::boxed))),
        caught_by: &["isotropy/straight", "isotropy/deceleration", "contact/cone"],
    },
    Planted {
        name: "contact/lagged-normal",
        mistake: "bounds friction by the normal impulse of the step before",
        engine: || with_solver(|| Box::new(RowByRow(solver::lagged))),
        caught_by: &["contact/cone", "contact/dissipation"],
    },
    Planted {
        name: "incline/kinetic-friction",
        mistake: "uses 0.8 μ as soon as a contact slides",
        engine: || with_solver(|| Box::new(RowByRow(solver::kinetic))),
        caught_by: &["incline/slide", "contact/dissipation"],
    },
    Planted {
        name: "incline/regularised-friction",
        mistake: "smooths friction over slips of 1 cm/s and does not declare it",
        engine: || with_solver(|| Box::new(RowByRow(solver::regularised))),
        caught_by: &["incline/stick", "incline/stick-threshold"],
    },
    Planted {
        name: "contact/friction-along-slip",
        mistake: "has the sign of sliding friction wrong in one tangent",
        engine: || with_solver(|| Box::new(RowByRow(solver::along_slip))),
        caught_by: &["contact/increment", "contact/dissipation", "isotropy/deceleration"],
    },
    Planted {
        name: "incline/undeclared-relaxation",
        mistake: "solves the convex relaxation and declares Coulomb's law",
        engine: || Box::new(OwnEngine { law: OwnScheme::Coulomb, ..own("anitescu") }),
        caught_by: &["incline/hop", "incline/gap", "contact/complementarity"],
    },
    Planted {
        name: "incline/friction-squared",
        mistake: "multiplies the friction of both surfaces although the scene gives that of the pair: μ²",
        engine: || misread(|scene| scene.material.friction *= scene.material.friction),
        caught_by: &["incline/slide", "incline/stick-threshold", "isotropy/deceleration"],
    },
    Planted {
        name: "incline/friction-root-two",
        mistake: "takes a pyramid around the cone along its diagonals: √2 μ",
        engine: || misread(|scene| scene.material.friction *= std::f64::consts::SQRT_2),
        caught_by: &["incline/stick-threshold", "contact/cone", "isotropy/deceleration"],
    },
    Planted {
        name: "rolling/hollow-sphere",
        mistake: "gives a solid sphere the inertia of a hollow one, ⅔ m r²",
        engine: || misread(world::hollow_spheres),
        caught_by: &["rolling/five-sevenths", "rolling/incline", "contact/momentum"],
    },
    Planted {
        name: "contact/inertia-of-full-extents",
        mistake: "computes a box's inertia from its edges instead of half of them, four times too much",
        engine: || misread(world::full_extents),
        caught_by: &["contact/momentum"],
    },
    Planted {
        name: "rolling/resistance",
        mistake: "damps the spin with 1/s and does not declare it",
        engine: || Box::new(OwnEngine { mechanism: world::damped_spin, ..own("moreau-jean") }),
        caught_by: &["rolling/five-sevenths", "rolling/incline"],
    },
    Planted {
        name: "rolling/friction-at-centre",
        mistake: "lets friction act at the centre of mass: no torque",
        engine: || Box::new(OwnEngine { mechanism: world::friction_at_centre, ..own("moreau-jean") }),
        caught_by: &["rolling/five-sevenths", "contact/momentum"],
    },
    Planted {
        name: "energy/baumgarte",
        mistake: "pushes bodies out of the floor within one step, with a velocity that stays",
        engine: || Box::new(OwnEngine { scheme: |_| Ok(Box::new(world::Baumgarte)), ..own("moreau-jean") }),
        caught_by: &["energy/passive"],
    },
    Planted {
        name: "contact/early",
        mistake: "activates contacts 3 cm above the floor",
        engine: || Box::new(OwnEngine { mechanism: world::thick_floor, ..own("moreau-jean") }),
        caught_by: &["contact/complementarity"],
    },
    Planted {
        name: "contact/left-handed-frame",
        mistake: "reports friction in a left-handed frame: one tangent is reversed",
        engine: || reported(|trajectory| trajectory.contacts.iter_mut().for_each(|contact| contact.impulse[1] *= -1.0)),
        caught_by: &["contact/momentum", "contact/dissipation"],
    },
    Planted {
        name: "contact/force-as-impulse",
        mistake: "reports forces where impulses are asked for",
        engine: || reported(reports::forces),
        caught_by: &["contact/momentum"],
    },
    Planted {
        name: "contact/late",
        mistake: "reports every impulse one sample late",
        engine: || reported(reports::late),
        caught_by: &["contact/momentum", "tumbling/momentum"],
    },
    Planted {
        name: "contact/normal-reversed",
        mistake: "reports normals from the first body to the second",
        engine: || reported(|trajectory| trajectory.contacts.iter_mut().for_each(|contact| contact.normal = contact.normal.map(|n| -n))),
        caught_by: &["contact/cone"],
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
