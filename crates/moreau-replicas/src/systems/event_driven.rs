//! The event-driven method: smooth motion, located events, a problem of its own at each.
//!
//! ```text
//!     ẋ = f(x) between events ,   impacts  y = H v⁺ + e min(u_n⁻, 0) n ,   forces  0 ≤ λ ⟂ H v̇ + Ḣ v ≥ 0
//! ```

use super::planted::{Kind, mistake};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System};
use crate::siconos::events::SiconosEvents;
use crate::stored::{StoredRuns, read_by};
use moreau_contact::solvers::Auto;
use moreau_dynamics::event_driven::EventDriven;
use moreau_dynamics::event_driven::filippov::{DryFriction, advance};
use moreau_dynamics::event_driven::flight::{Control, Location};
use moreau_dynamics::mechanics::{Mechanism, OscillatorWithStop, PointMass, State};
use moreau_dynamics::tolerance::event_driven::{ACCURACY, SWITCHING};
use moreau_exact::Result;
use moreau_forms::{BeltOscillator, BouncingBall, InclineBlock, StopOscillator};
use nalgebra::{DVector, dvector};

pub static SYSTEM: System = System {
    name: "Event-driven",
    level: ConstraintLevel::Acceleration,
    cone: Cone::SecondOrder,
    law: ContactLaw::Coulomb,
    algorithm: "Lemke on accelerations; block projected Gauss–Seidel at impacts",
    restitution: "Newton's e, plastic where the next flight would last less than 2⁻²⁰ s",
    position_update: "Dormand–Prince 5(4), events located to rounding",
    schemes: &["event-driven"],
    held_against: &[
        Agreement {
            against: "closed form",
            quantity: "position of a ball through all its impacts to rest",
            unit: "m",
            measure: |_| ball(&EventDriven::default()),
            planted: &[mistake(Kind::Scheme, "systems/events-noticed-late", "events noticed at the end of a step of 13 ms", |_| {
                ball(&late())
            })],
        },
        Agreement {
            against: "closed form",
            quantity: "position of oscillators with a stop whose impacts end, go on or accumulate",
            unit: "m",
            measure: |_| stops(&EventDriven::default()),
            planted: &[mistake(Kind::Scheme, "systems/events-noticed-late", "events noticed at the end of a step of 13 ms", |_| {
                stops(&late())
            })],
        },
        Agreement {
            against: "Siconos 4.4.0",
            quantity: "instant of every impact of balls and oscillators with a stop, times the speed",
            unit: "m",
            measure: |runs| siconos(runs, &EventDriven::default()),
            planted: &[mistake(Kind::Scheme, "systems/events-noticed-late", "events noticed at the end of a step of 13 ms", |runs| {
                siconos(runs, &late())
            })],
        },
        Agreement {
            against: "closed form",
            quantity: "speed of a block that friction stops on a slope and that slides back or stays",
            unit: "m/s",
            measure: |_| block(&EventDriven::default()),
            planted: &[mistake(Kind::Scheme, "systems/events-noticed-late", "events noticed at the end of a step of 13 ms", |_| {
                block(&late())
            })],
        },
        Agreement {
            against: "closed form",
            quantity: "position of a mass that sticks and slips on a belt, through Filippov's sliding mode",
            unit: "m",
            measure: |_| belt(&EventDriven::default()),
            planted: &[mistake(Kind::Scheme, "systems/events-noticed-late", "events noticed at the end of a step of 13 ms", |_| {
                belt(&late())
            })],
        },
    ],
};

/// The entry of q or v with this index after each of eight parts of a motion, against an exact one.
fn follow(
    method: &EventDriven,
    mechanism: &dyn Mechanism,
    start: State,
    duration: f64,
    error: impl Fn(&State) -> f64,
) -> Result<Vec<Measured>> {
    let mut state = start;
    let mut found = Vec::new();
    for _ in 0..8 {
        state = method.advance(&Auto, mechanism, &state, duration / 8.0)?.state;
        found.push(Measured::within(error(&state), ACCURACY));
    }
    Ok(found)
}

fn at_rest(position: DVector<f64>) -> State {
    State { time: 0.0, velocity: DVector::zeros(position.len()), position }
}

fn worst(found: Vec<Measured>) -> Measured {
    Measured::worst(found).expect("there are comparisons")
}

fn ball(method: &EventDriven) -> Result<Measured> {
    let exact = BouncingBall::new(9.81, 1.0, 0.8)?;
    let mechanism = PointMass::ball_on_floor(0.7, 9.81, 0.8);
    let error = |state: &State| (state.position[0] - exact.state(state.time).0).abs();
    follow(method, &mechanism, at_rest(dvector![1.0]), 1.1 * exact.accumulation_time(), error).map(worst)
}

fn stops(method: &EventDriven) -> Result<Measured> {
    let mut found = Vec::new();
    for stop in [-0.5, 0.0, 0.5] {
        let exact = StopOscillator::new(2.0, stop, 1.0, 0.6)?;
        let mechanism = OscillatorWithStop::new(1.5, 6.0, 0.0, stop, 0.6)?;
        let error = |state: &State| (state.position[0] - exact.state(state.time).0).abs();
        found.extend(follow(method, &mechanism, at_rest(dvector![1.0]), 9.7, error)?);
    }
    Ok(worst(found))
}

const SICONOS: &[&str] = &[
    "siconos/ball__event-driven__h0.1.json",
    "siconos/ball_lively__event-driven__h0.25.json",
    "siconos/stop_below__event-driven__h0.25.json",
    "siconos/stop_above__event-driven__h0.25.json",
];

/// |Δt| |v⁻| of every stored impact of Siconos, from its own state after the event before.
pub(super) fn siconos(runs: &dyn StoredRuns, method: &EventDriven) -> Result<Measured> {
    let found = SICONOS.iter().map(|path| {
        let run = read_by(runs, path, SiconosEvents::from_json)?;
        Ok(Measured::within(run.apart(method)?.instant, run.tolerance()))
    });
    found.collect::<Result<Vec<_>>>().map(worst)
}

fn block(method: &EventDriven) -> Result<Measured> {
    let angle = 0.35f64;
    let mut found = Vec::new();
    for friction in [0.5, 0.2] {
        let exact = InclineBlock::new(9.81, angle, friction, -1.0)?;
        let mechanism = PointMass::block_on_incline(0.7, 9.81, angle, friction, 0.0);
        let start = State { velocity: dvector![-1.0, 0.0], ..at_rest(dvector![0.0, 0.0]) };
        let error = |state: &State| (state.velocity[0] - exact.state(state.time).1).abs();
        found.extend(follow(method, &mechanism, start, 1.0, error)?);
    }
    Ok(worst(found))
}

fn belt(method: &EventDriven) -> Result<Measured> {
    let exact = BeltOscillator::new(3.0, 0.2, 0.7, 0.5)?;
    let system = DryFriction { frequency: 3.0, belt: 0.2, sticking: 0.7, slipping: 0.5 };
    let (end, _) = advance(method, &system, &dvector![0.0, 0.2], 10.0)?;
    Ok(Measured::within((end[0] - exact.carried_from_zero(10.0).0).abs(), SWITCHING))
}

/// Steps of 13 ms, and an event belongs to the end of its step.
pub(super) fn late() -> EventDriven {
    EventDriven { control: Control::Fixed(0.013), location: Location::EndOfStep, ..EventDriven::default() }
}
