//! Mistakes of solvers that show in the motion of thrown boxes: answers that are used without being checked.

use crate::Engine;
use crate::planted::parts::{Answers, with_mechanism, with_solver};
use crate::planted::wrapped::{Misdeclare, declare_springs};
use crate::planted::{Faulty, Kind, Planted};
use moreau_checks::defects::solvers;
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::scenes::Scene;
use moreau_exact::Result;

/// The mistakes of this family.
pub const PLANTED: &[Planted<Faulty>] = &[
    solver!(EXTRAPOLATED, &["tumbling/rough"]),
    solver!(TWO_SWEEPS, &["tumbling/passive"]),
    solver!(STALE, &["tumbling/passive", "tumbling/bouncing", "tumbling/rough", "tumbling/rest"]),
    Planted {
        name: "tumbling/springs-and-extrapolated-sweeps",
        mistake: "declares contact springs of 60 Hz, and extrapolates sweeps without looking at what comes out",
        kind: Kind::Solver,
        subject: Faulty {
            engine: || sprung(|| with_solver(|| Box::new(Answers(solvers::EXTRAPOLATED.subject)))),
            caught_by: &["tumbling/rough"],
        },
    },
    Planted {
        name: "tumbling/springs-and-two-sweeps",
        mistake: "declares contact springs of 60 Hz, and stops at a limit of two sweeps",
        kind: Kind::Solver,
        subject: Faulty {
            engine: || sprung(|| with_solver(|| Box::new(Answers(solvers::TWO_SWEEPS.subject)))),
            caught_by: &["tumbling/passive"],
        },
    },
    Planted {
        name: "tumbling/deeper-than-its-springs",
        mistake: "declares contact springs of 60 Hz, which carry a body at 0.07 mm, and lets it lie 2 cm deep",
        kind: Kind::Report,
        subject: Faulty { engine: || sprung(|| with_mechanism(sunk)), caught_by: &["tumbling/rest"] },
    },
];

/// An engine that declares springs of 60 Hz. The allowance for these springs must not hide another mistake.
fn sprung(engine: fn() -> Box<dyn Engine>) -> Box<dyn Engine> {
    Box::new(Misdeclare { engine, declare: |description| declare_springs(description, 60.0) })
}

fn sunk(scene: &Scene) -> Result<(Box<dyn Mechanism>, State)> {
    let mut scene = scene.clone();
    if let Some(ground) = &mut scene.ground {
        ground.offset -= 0.02;
    }
    scene.spatial_mechanism()
}
