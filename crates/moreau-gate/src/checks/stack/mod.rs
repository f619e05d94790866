//! Boxes that are set down on each other and must stand.
//!
//! ```text
//!     gaps of δ between neighbours: level k lands with at most √(2 g k δ);   then the load Σ m g of each level is carried, nothing moves
//! ```
//! What an engine adds is its own: a solver that stops early lets the stack sink, lean and tremble; a declared rest depth lets it sink by
//! a known amount. No contact begins touching: a gap of 0 is open or closed by rounding. The standing lasts a fixed number of steps, so
//! that errors per step show at every h.

mod pile;
mod rest;
#[cfg(test)]
mod tests;

use crate::check::{Control, Run};
use crate::checks::motion::does_not_hop;
use crate::{Bench, Check, Level, Measurement, Refusal, Reply};
use pile::{HALF, Pile};
use rest::{EVERY, Rest, landed, landings};

const RESTING: &str = "After landing nothing moves. A solver that leaves a part s of its impulses leaves velocities of s Σm g h/m_min, \
    which add up over the steps. A landing at v is found up to a step late, and the next step acts on it; the n-th box falls n steps \
    longer than the gaps take, so that it is 3/2 h (v + n g h) deep. The engine may correct this depth later, which lifts the boxes; it \
    sinks no more. Where a box may be that deep that it is in the next one whole, or declared springs carry it half a box deep, the pile \
    is not asked. Boxes are narrower towards the top by as much as their corners may be let in. \
    A compliant or slack contact sinks by at most twice its declared rest depth \
    under the whole load, level by level, at up to √(2 g · sink). Springs may give the energy of the falls to one box, which lifts all \
    boxes above it. If an engine declares that a step takes back a part of each depth, the levels rise by what is left of the landings' \
    depths; and where a corner has no depth left it opens, falls for a step and is found 9/4 g h² deep, so that its box tips on the one \
    below, and tips of all levels add up. A part of more than a third lets corners fly for longer, and boxes hop: that is not asked. \
    Boxes on declared springs of a frequency start at the depth of each level, N/(m_p (2πf)²) at its corners, and stay there.";

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "stack/five",
        level: Level::Simulate,
        question: "Do five boxes of 1 kg, set down on each other, stay where they are?",
        derivation: RESTING,
        source: "chapter §9 (stacks); the solution r ≥ 0 with u = 0 exists, as r_k = Σ m g h above",
        run: Run::EachStep(|bench, h| standing(bench, h, &[1.0; 5], 200)),
        control: Control { passes: "moreau-jean", fails: "solver/three-sweeps" },
    },
    Check {
        name: "stack/ten",
        level: Level::Simulate,
        question: "Do ten boxes of 1 kg, set down on each other, stay where they are?",
        derivation: RESTING,
        source: "as for five; a sweep over contacts carries the load one level further, so early stops show more",
        run: Run::EachStep(|bench, h| standing(bench, h, &[1.0; 10], 100)),
        control: Control { passes: "moreau-jean", fails: "solver/three-sweeps" },
    },
    Check {
        name: "stack/mass-ratio",
        level: Level::Simulate,
        question: "Does a box of 1 kg carry one of 1000 kg, and the ground both?",
        derivation: RESTING,
        source: "Gauss–Seidel contracts by 1/(1 + m/M) per sweep here; the ground's impulse is Σ m g t, from momentum",
        run: Run::EachStep(mass_ratio),
        control: Control { passes: "moreau-jean", fails: "stack/mass-ratio-clamped" },
    },
];

/// The boxes at the step h \[s\].
///
/// # Errors
/// `unsupported` where boxes are pushed to hop, where a sound engine may find one as deep in another as it is high, and where declared
/// springs carry the load half a box deep: no bound on what is seen then could fail.
fn pile<'a>(bench: &Bench, masses: &'a [f64], h: f64) -> Reply<Pile<'a>> {
    does_not_hop(bench)?;
    let pile = Pile::of(bench, masses, h);
    if landings(&pile, h)[1] >= 2.0 * HALF {
        return Err(Refusal::unsupported("at this step a box may be found as deep in another as it is high: the pile falls for too long"));
    }
    if pile.is_swallowed_by_springs(bench, h) {
        return Err(Refusal::unsupported("the declared springs carry the load where boxes are half a box deep in each other"));
    }
    Ok(pile)
}

fn standing(bench: &mut Bench, h: f64, masses: &[f64], steps: usize) -> Reply<Vec<Measurement>> {
    let pile = pile(bench, masses, h)?;
    let trajectory = bench.simulate(&pile.scene(), h, landed(h) * EVERY + steps, EVERY)?;
    Ok(Rest::new(bench, h, &pile, steps).measured(&trajectory))
}

fn mass_ratio(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let (masses, steps) = ([1.0, 1000.0], 50);
    let pile = pile(bench, &masses, h)?;
    let trajectory = bench.simulate(&pile.scene(), h, landed(h) * EVERY + steps, EVERY)?;
    let rest = Rest::new(bench, h, &pile, steps);
    let mut measurements = rest.measured(&trajectory);
    if bench.description().reports_contacts {
        measurements.push(rest.carried(&trajectory, masses.iter().sum()));
    }
    Ok(measurements)
}
