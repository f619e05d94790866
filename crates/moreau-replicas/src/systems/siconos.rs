//! Siconos: Coulomb's law as it is, at velocity level, in event-capturing steps.
//!
//! ```text
//!     MoreauJeanOSI                      active: φ + ½h u_n ≤ 0 ;   K_μ ∋ r ⟂ y + μ‖y_t‖ n ∈ K_μ* ,   y = u⁺ + e u_n n
//!     MoreauJeanCombinedProjectionOSI    active: φ(q⁺) ≤ 0 ;        the same law, then q⁺ onto φ = 0
//!     SchatzmanPaoliOSI                  0 ≤ r_n ⟂ φ(q⁺) + e φ(q⁻) ≥ 0 ,    u_n = (φ − φ(q⁻))/h  hence  u_n⁺ − e u_n + (1 + e) φ/h
//!     EventDriven, LsodarOSI             impacts where φ has a root, forces where 0 ≤ λ ⟂ φ̈ ≥ 0
//! ```

use super::event_driven::{late, siconos};
use super::planted::{Kind, heavy, mistake};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System, on_a_ball};
use crate::siconos::steps::SiconosSteps;
use crate::stored::{StoredRuns, read_by};
use moreau_checks::defects::schemes::{AHEAD, HEAVY, Mistaken};
use moreau_dynamics::event_driven::EventDriven;
use moreau_dynamics::schemes::{MoreauJean, MoreauJeanProjection, SchatzmanPaoli, Scheme, StewartTrinkle};
use moreau_exact::{Error, Result};

pub static SYSTEM: System = System {
    name: "Siconos",
    level: ConstraintLevel::Velocity,
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
            measure: |runs| steps(runs, MOREAU_JEAN, 1, |run| run.scheme(0.0)),
            planted: &[heavy(|runs| steps(runs, MOREAU_JEAN, 1, heavy_moreau_jean))],
        },
        Agreement {
            against: "Siconos 4.4.0",
            quantity: "impulse in every step, Moreau–Jean",
            unit: "N·s",
            measure: |runs| steps(runs, MOREAU_JEAN, 2, |run| run.scheme(0.0)),
            planted: &[heavy(|runs| steps(runs, MOREAU_JEAN, 2, heavy_moreau_jean))],
        },
        Agreement {
            against: "Siconos 4.4.0",
            quantity: "position after every step, combined projection",
            unit: "m",
            measure: |runs| steps(runs, PROJECTION, 0, |run| run.scheme(0.0)),
            planted: &[mistake(
                Kind::Scheme,
                "systems/first-run-ahead",
                "the first run: positions moved on by half the change of velocity as well",
                |runs| steps(runs, &PROJECTION[..1], 0, |_| Ok(Box::new(AHEAD.subject.of(MoreauJeanProjection { theta: 0.5 })))),
            )],
        },
        Agreement {
            against: "Siconos 4.4.0",
            quantity: "velocity after every step of balls, balls in a row and an oscillator with a stop, Schatzman–Paoli",
            unit: "m/s",
            measure: |runs| steps(runs, SCHATZMAN_PAOLI, 1, |run| run.scheme(0.0)),
            planted: &[
                heavy(|runs| steps(runs, SCHATZMAN_PAOLI, 1, |_| Ok(Box::new(heavy_schatzman_paoli())))),
                mistake(Kind::Scheme, "systems/stewart-trinkle-in-its-place", "Stewart–Trinkle in its place", |runs| {
                    steps(runs, SCHATZMAN_PAOLI, 1, |_| Ok(Box::new(StewartTrinkle::default())))
                }),
            ],
        },
        Agreement {
            against: "Siconos 4.4.0",
            quantity: "instant of every impact of balls and oscillators with a stop, times the speed, event-driven",
            unit: "m",
            measure: |runs| siconos(runs, &EventDriven::default()),
            planted: &[mistake(Kind::Scheme, "systems/events-noticed-late", "events noticed at the end of a step of 13 ms", |runs| {
                siconos(runs, &late())
            })],
        },
        Agreement {
            against: "exact rationals",
            quantity: "velocity after each step of a bouncing ball, Schatzman–Paoli",
            unit: "m/s",
            measure: |_| on_a_ball::velocities(&SchatzmanPaoli, |ball, now, h| ball.schatzman_paoli(now, h).motion),
            planted: &[heavy(|_| on_a_ball::velocities(&heavy_schatzman_paoli(), |ball, now, h| ball.schatzman_paoli(now, h).motion))],
        },
    ],
};

const MOREAU_JEAN: &[&str] = &[
    "siconos/ball__moreau-jean__h0.01.json",
    "siconos/ball__moreau-jean__h0.005.json",
    "siconos/ball__moreau-jean__h0.001.json",
    "siconos/block_slide__moreau-jean__h0.01.json",
    "siconos/block_slide__moreau-jean__h0.005.json",
    "siconos/block_slide__moreau-jean__h0.001.json",
    "siconos/block_stick__moreau-jean__h0.01.json",
    "siconos/block_stick__moreau-jean__h0.005.json",
    "siconos/block_stick__moreau-jean__h0.001.json",
    "siconos/cradle__moreau-jean__h0.01.json",
    "siconos/cradle__moreau-jean__h0.005.json",
    "siconos/cradle__moreau-jean__h0.001.json",
    "siconos/bead__moreau-jean__h0.01.json",
    "siconos/bead__moreau-jean__h0.005.json",
    "siconos/bead__moreau-jean__h0.001.json",
    "siconos/puck_slide__moreau-jean__h0.01.json",
    "siconos/puck_slide__moreau-jean__h0.005.json",
    "siconos/puck_slide__moreau-jean__h0.001.json",
    "siconos/puck_stick__moreau-jean__h0.01.json",
    "siconos/puck_stick__moreau-jean__h0.005.json",
    "siconos/puck_stick__moreau-jean__h0.001.json",
    "siconos/ball_elastic__moreau-jean__h0.01.json",
    "siconos/chain__moreau-jean__h0.01.json",
];

const SCHATZMAN_PAOLI: &[&str] = &[
    "siconos/ball__schatzman-paoli__h0.01.json",
    "siconos/ball_lively__schatzman-paoli__h0.001.json",
    "siconos/stop__schatzman-paoli__h0.01.json",
    "siconos/chain__schatzman-paoli__h0.01.json",
];

const PROJECTION: &[&str] = &[
    "siconos/ball__projection__h0.01.json",
    "siconos/ball_elastic__projection__h0.01.json",
    "siconos/chain__projection__h0.01.json",
    "siconos/bead__projection__h0.01.json",
];

/// The largest deviation of a step in position, velocity or impulse (0, 1, 2) over the runs.
fn steps(
    runs: &dyn StoredRuns,
    paths: &[&str],
    which: usize,
    scheme: impl Fn(&SiconosSteps) -> Result<Box<dyn Scheme>>,
) -> Result<Measured> {
    let comparisons = paths.iter().map(|path| {
        let run = read_by(runs, path, SiconosSteps::from_json)?;
        Ok(Measured::within(run.deviations(scheme(&run)?.as_ref())?[which], run.tolerances()[which]))
    });
    let comparisons = comparisons.collect::<Result<Vec<_>>>()?;
    Measured::worst(comparisons).ok_or_else(|| Error::Unsupported("no run is stored".into()))
}

fn heavy_moreau_jean(_: &SiconosSteps) -> Result<Box<dyn Scheme>> {
    Ok(Box::new(HEAVY.subject.of(MoreauJean::default())))
}

fn heavy_schatzman_paoli() -> Mistaken<SchatzmanPaoli> {
    HEAVY.subject.of(SchatzmanPaoli)
}
