//! Everything that is planted, with the checks that it is put to.

use super::judges::JUDGES;
use crate::checks::forms;
use crate::checks::planted::{Catch, Family, Trial};
use crate::defects::{self, beside};
use crate::gate::planted::{self, Faulty, Planted};
use crate::gate::{Check, planted::judge};
use crate::stored::RUNS;
use crate::systems;
use moreau_replicas::altered;
use std::collections::BTreeSet;

/// Checks of one kind, and the mistakes that they are run on.
pub struct Source {
    /// The names of the checks.
    pub checks: Vec<String>,
    /// The mistakes under them.
    pub trials: Vec<Trial<'static>>,
}

/// Every source: engines under these checks of the gate, systems under their agreements, and all families.
pub fn sources(checks: &[&'static Check]) -> Vec<Source> {
    let mut sources = vec![engines(checks), agreements(), properties()];
    sources.extend([family(&altered::SCHEMES), family(&defects::solvers::SOLVERS), family(&defects::certificates::CERTIFICATES)]);
    sources.extend([family(&JUDGES), family(&defects::decisions::LCP)]);
    sources.extend([
        family(&defects::decisions::SEMIDEFINITE),
        family(&defects::decisions::COPOSITIVE),
        family(&defects::decisions::COPOSITIVE_PLUS),
        family(&defects::decisions::P_MATRIX),
    ]);
    sources.extend([family(&forms::impacts::TWO_BODIES), family(&forms::impacts::CRADLE), family(&forms::impacts::ROUGH)]);
    sources.extend([
        family(&forms::motions::BALL),
        family(&forms::motions::SLOPE),
        family(&forms::motions::ROLLING),
        family(&forms::motions::TURNING_POINTS),
        family(&forms::motions::DECAY),
    ]);
    sources.extend([
        family(&forms::bodies::LANDING),
        family(&forms::bodies::TOP),
        family(&forms::bodies::BAR),
        family(&forms::bodies::EDGE),
    ]);
    sources.extend([
        family(&forms::soft::IMPEDANCE),
        family(&forms::soft::REFERENCE),
        family(&forms::soft::HUBER),
        family(&forms::soft::HUNT_CROSSLEY),
    ]);
    sources.extend([family(&defects::readers::PROBLEMS), family(&defects::readers::SOLUTIONS), family(&defects::readers::SCENES)]);
    sources
}

fn engines(checks: &[&'static Check]) -> Source {
    let trial = |planted: &'static Planted<Faulty>| {
        let checks = checks.to_vec();
        planted.trial(move |_| {
            let report = judge(planted, &checks)?;
            let bad = report.checks.into_iter().filter(|outcome| outcome.verdict.is_bad());
            Ok(bad.map(|outcome| Catch { check: outcome.check, time_steps: outcome.fails_at }).collect())
        })
    };
    Source { checks: checks.iter().map(|check| check.name.into()).collect(), trials: planted::all().map(trial).collect() }
}

/// Every agreement with the mistakes that are planted for it.
fn agreements() -> Source {
    let mut source = Source { checks: Vec::new(), trials: Vec::new() };
    for system in systems::ALL {
        for agreement in system.held_against {
            let check = agreement.check(system);
            source.trials.extend(agreement.planted.iter().map(|planted| {
                let check = check.clone();
                planted.trial(move |measure| Ok(Vec::from_iter((!measure(&RUNS)?.holds()).then(|| Catch::from(check.as_str())))))
            }));
            source.checks.push(check);
        }
    }
    source
}

fn properties() -> Source {
    let checks: BTreeSet<&str> = beside().map(|planted| planted.subject.check).collect();
    Source { checks: checks.into_iter().map(String::from).collect(), trials: beside().map(Planted::beside).collect() }
}

fn family<S: Sync>(family: &'static Family<S>) -> Source {
    Source { checks: family.checks.iter().map(|(name, _)| (*name).to_string()).collect(), trials: family.trials().collect() }
}
