//! Planted engines: our own engine with one realistic mistake each, and the checks that must catch it.

/// A solver of [`moreau_checks::defects::solvers`] behind the engine's door.
macro_rules! solver {
    ($mistake:ident, $caught_by:expr) => {
        Planted {
            name: moreau_checks::defects::solvers::$mistake.name,
            mistake: moreau_checks::defects::solvers::$mistake.mistake,
            kind: moreau_checks::defects::solvers::$mistake.kind,
            subject: Faulty {
                engine: || {
                    $crate::planted::parts::with_solver(|| {
                        Box::new($crate::planted::parts::Answers(moreau_checks::defects::solvers::$mistake.subject))
                    })
                },
                caught_by: $caught_by,
            },
        }
    };
}

/// A scheme of [`moreau_checks::defects::schemes`] behind the engine's door.
macro_rules! scheme {
    ($mistake:ident, $caught_by:expr) => {
        Planted {
            name: moreau_checks::defects::schemes::$mistake.name,
            mistake: moreau_checks::defects::schemes::$mistake.mistake,
            kind: moreau_checks::defects::schemes::$mistake.kind,
            subject: Faulty {
                engine: || {
                    $crate::planted::parts::moreau_jean(|engine| {
                        engine.scheme = |_| {
                            let right = moreau_dynamics::schemes::MoreauJean::default();
                            Ok(Box::new(moreau_checks::defects::schemes::$mistake.subject.of(right)))
                        }
                    })
                },
                caught_by: $caught_by,
            },
        }
    };
}

mod bounce;
mod determinism;
mod flight;
mod friction;
mod impact;
mod limits;
mod metamorphic;
mod mistake;
mod pair;
mod parts;
mod points;
mod projection;
mod reported;
mod rocking;
mod round;
mod scheme;
mod solver;
mod spin;
mod stack;
mod tumbling;
mod unmoved;
mod wrapped;

pub use mistake::Faulty;
pub use moreau_checks::planted::{Kind, Planted};

use crate::runner::{self, Plan, QUICK};
use crate::{Check, Options, Report};
use moreau_exact::{Error, Result};

/// Every planted engine.
pub fn all() -> impl Iterator<Item = &'static Planted<Faulty>> {
    [
        flight::PLANTED,
        impact::PLANTED,
        friction::PLANTED,
        determinism::PLANTED,
        metamorphic::PLANTED,
        stack::PLANTED,
        rocking::PLANTED,
        solver::PLANTED,
        scheme::PLANTED,
        projection::PLANTED,
        tumbling::PLANTED,
        spin::PLANTED,
        reported::PLANTED,
        limits::PLANTED,
        bounce::PLANTED,
        pair::PLANTED,
        unmoved::PLANTED,
        round::PLANTED,
        points::PLANTED,
    ]
    .into_iter()
    .flatten()
}

/// The planted engine with this name.
pub fn find(name: &str) -> Option<&'static Planted<Faulty>> {
    all().find(|planted| planted.name == name)
}

/// The time steps \[s\] at which a planted engine is asked: the quick sweep, and one more where that shows nothing.
fn time_steps(planted: &Planted<Faulty>) -> Vec<f64> {
    let more = spin::SHOW_AT.iter().filter(|(name, _)| *name == planted.name).map(|(_, h)| *h);
    QUICK.into_iter().chain(more).collect()
}

/// The report of some checks on a planted engine, over the quick sweep and, where that shows nothing of the mistake, at a step that does.
///
/// # Errors
/// If the engine does not describe itself.
pub fn judge(planted: &Planted<Faulty>, checks: &[&'static Check]) -> Result<Report> {
    let plan = Plan { checks: checks.to_vec(), sweep: time_steps(planted), options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
    runner::run(&planted.subject.engine, &plan).map_err(|refusal| Error::Unsupported(format!("{}: {refusal}", planted.name)))
}
