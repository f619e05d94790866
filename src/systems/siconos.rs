//! Siconos: Coulomb's law as it is, at velocity level, in event-capturing steps.
//!
//! ```text
//!     MoreauJeanOSI                      active: φ + ½h u_n ≤ 0 ;   K_μ ∋ r ⟂ y + μ‖y_t‖ n ∈ K_μ* ,   y = u⁺ + e u_n n
//!     MoreauJeanCombinedProjectionOSI    active: φ(q⁺) ≤ 0 ;        the same law, then q⁺ onto φ = 0
//!     SchatzmanPaoliOSI                  0 ≤ r_n ⟂ φ(q⁺) + e φ(q⁻) ≥ 0 ,    u_n = (φ − φ(q⁻))/h  hence  u_n⁺ − e u_n + (1 + e) φ/h
//!     EventDriven, LsodarOSI             impacts where φ has a root, forces where 0 ≤ λ ⟂ φ̈ ≥ 0
//! ```

use super::event_driven::siconos;
use super::{Agreement, Cone, ContactLaw, Level, Measured, System, on_a_ball};
use crate::checks::siconos_steps::SiconosSteps;
use crate::event_driven::EventDriven;
use crate::schemes::{SchatzmanPaoli, Scheme};
use crate::{Error, Result};

pub static SYSTEM: System = System {
    name: "Siconos",
    level: Level::Velocity,
    cone: Cone::SecondOrder,
    law: ContactLaw::Coulomb,
    algorithm: "direct here: lexicographic Lemke; there NSGS, nonsmooth Newton and others",
    restitution: "Newton's e",
    position_update: "q + h(θ v⁺ + (1−θ) v), with projection onto φ = 0 if asked",
    schemes: &["moreau-jean", "moreau-jean-projection", "schatzman-paoli", "event-driven"],
    held_against: &[
        Agreement {
            against: "Siconos 4.4.0",
            quantity: "velocity after every step of 1 to 10 ms of a ball, blocks in plane and space, balls in a row and a bead, \
                Moreau–Jean",
            unit: "m/s",
            measure: || steps(MOREAU_JEAN, 1, |run| run.scheme(0.0)),
        },
        Agreement {
            against: "Siconos 4.4.0",
            quantity: "impulse in every step, Moreau–Jean",
            unit: "N·s",
            measure: || steps(MOREAU_JEAN, 2, |run| run.scheme(0.0)),
        },
        Agreement {
            against: "Siconos 4.4.0",
            quantity: "position after every step, combined projection",
            unit: "m",
            measure: || steps(PROJECTION, 0, |run| run.scheme(0.0)),
        },
        Agreement {
            against: "Siconos 4.4.0",
            quantity: "velocity after every step of balls, balls in a row and an oscillator with a stop, Schatzman–Paoli",
            unit: "m/s",
            measure: || steps(SCHATZMAN_PAOLI, 1, |run| run.scheme(0.0)),
        },
        Agreement {
            against: "Siconos 4.4.0",
            quantity: "instant of every impact of balls and oscillators with a stop, times the speed, event-driven",
            unit: "m",
            measure: || siconos(&EventDriven::default()),
        },
        Agreement {
            against: "exact rationals",
            quantity: "velocity after each step of a bouncing ball, Schatzman–Paoli",
            unit: "m/s",
            measure: || on_a_ball::velocities(&SchatzmanPaoli, |ball, now, h| ball.schatzman_paoli(now, h).motion),
        },
    ],
};

const MOREAU_JEAN: &[&str] = &[
    include_str!("../../references/siconos/ball__moreau-jean__h0.01.json"),
    include_str!("../../references/siconos/ball__moreau-jean__h0.005.json"),
    include_str!("../../references/siconos/ball__moreau-jean__h0.001.json"),
    include_str!("../../references/siconos/block_slide__moreau-jean__h0.01.json"),
    include_str!("../../references/siconos/block_slide__moreau-jean__h0.005.json"),
    include_str!("../../references/siconos/block_slide__moreau-jean__h0.001.json"),
    include_str!("../../references/siconos/block_stick__moreau-jean__h0.01.json"),
    include_str!("../../references/siconos/block_stick__moreau-jean__h0.005.json"),
    include_str!("../../references/siconos/block_stick__moreau-jean__h0.001.json"),
    include_str!("../../references/siconos/cradle__moreau-jean__h0.01.json"),
    include_str!("../../references/siconos/cradle__moreau-jean__h0.005.json"),
    include_str!("../../references/siconos/cradle__moreau-jean__h0.001.json"),
    include_str!("../../references/siconos/bead__moreau-jean__h0.01.json"),
    include_str!("../../references/siconos/bead__moreau-jean__h0.005.json"),
    include_str!("../../references/siconos/bead__moreau-jean__h0.001.json"),
    include_str!("../../references/siconos/puck_slide__moreau-jean__h0.01.json"),
    include_str!("../../references/siconos/puck_slide__moreau-jean__h0.005.json"),
    include_str!("../../references/siconos/puck_slide__moreau-jean__h0.001.json"),
    include_str!("../../references/siconos/puck_stick__moreau-jean__h0.01.json"),
    include_str!("../../references/siconos/puck_stick__moreau-jean__h0.005.json"),
    include_str!("../../references/siconos/puck_stick__moreau-jean__h0.001.json"),
    include_str!("../../references/siconos/ball_elastic__moreau-jean__h0.01.json"),
    include_str!("../../references/siconos/chain__moreau-jean__h0.01.json"),
];

const SCHATZMAN_PAOLI: &[&str] = &[
    include_str!("../../references/siconos/ball__schatzman-paoli__h0.01.json"),
    include_str!("../../references/siconos/ball_lively__schatzman-paoli__h0.001.json"),
    include_str!("../../references/siconos/stop__schatzman-paoli__h0.01.json"),
    include_str!("../../references/siconos/chain__schatzman-paoli__h0.01.json"),
];

const PROJECTION: &[&str] = &[
    include_str!("../../references/siconos/ball__projection__h0.01.json"),
    include_str!("../../references/siconos/ball_elastic__projection__h0.01.json"),
    include_str!("../../references/siconos/chain__projection__h0.01.json"),
    include_str!("../../references/siconos/bead__projection__h0.01.json"),
];

/// The largest deviation of a step in position, velocity or impulse (0, 1, 2) over the runs.
fn steps(runs: &[&str], which: usize, scheme: impl Fn(&SiconosSteps) -> Result<Box<dyn Scheme>>) -> Result<Measured> {
    let comparisons = runs.iter().map(|text| {
        let run = SiconosSteps::from_json(text)?;
        Ok(Measured { difference: run.deviations(scheme(&run)?.as_ref())?[which], tolerance: run.tolerances()[which] })
    });
    let comparisons = comparisons.collect::<Result<Vec<_>>>()?;
    Measured::worst(comparisons).ok_or_else(|| Error::Unsupported("no run is stored".into()))
}

#[cfg(test)]
mod tests {
    use super::super::planted::{Mistake, caught, planted};
    use super::*;
    use crate::schemes::{MoreauJean, MoreauJeanProjection, StewartTrinkle};

    #[test]
    fn a_mistake_puts_every_agreement_out_of_its_tolerance() {
        let heavy = |_: &SiconosSteps| -> Result<Box<dyn Scheme>> { Ok(Box::new(planted(MoreauJean::default(), Mistake::Heavy))) };
        caught(steps(MOREAU_JEAN, 1, heavy));
        caught(steps(MOREAU_JEAN, 2, heavy));
        caught(steps(SCHATZMAN_PAOLI, 1, |_| Ok(Box::new(planted(SchatzmanPaoli, Mistake::Heavy)))));
        caught(steps(SCHATZMAN_PAOLI, 1, |_| Ok(Box::new(StewartTrinkle::default()))));
        let ahead = planted(MoreauJeanProjection { theta: 0.5 }, Mistake::Ahead);
        caught(
            SiconosSteps::from_json(PROJECTION[0])
                .and_then(|run| Ok(Measured { difference: run.deviations(&ahead)?[0], tolerance: run.tolerance() })),
        );
        let wrong = planted(SchatzmanPaoli, Mistake::Heavy);
        caught(on_a_ball::velocities(&wrong, |ball, now, h| ball.schatzman_paoli(now, h).motion));
    }
}
