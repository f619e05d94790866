//! Event-driven simulation: smooth motion by a method of high order, events located to rounding, and a problem of its own at each of them.
//!
//! ```text
//!     smooth      ẋ = f(x), Dormand–Prince 5(4)                                   [`flight`], [`contact_phase`]
//!     events      a gap closes, a slip stops, a contact force or its slack vanishes
//!     at them     impact law  [`impact`],  contact forces from the accelerations  [`forces`]
//!     beyond      infinitely many impacts: the Zeno rule of [`impact`];  sliding modes: [`filippov`]
//! ```
//! The opposite of the time-stepping schemes: between events it is of order five, and it needs every event. It is not defined where no
//! contact force exists (Painlevé), and says so; beyond an accumulation of impacts it is defined by the declared rule only. Mechanisms on a
//! line and in the plane whose coordinates form a vector space.
//!
//! # Source
//! Chapter §1; Pfeiffer and Glocker, *Multibody Dynamics with Unilateral Contacts* (1996); Acary and Brogliato (2008), chapter 8.

use crate::least_squares::least_squares;
use crate::mechanics::{Mechanism, State, afford};
use crate::tolerance::event_driven::{EVENT_LIMIT, FLIGHT, LOOK_AHEAD, TOLERANCE, TOUCHING, stalled_events};
use contact_phase::ContactPhase;
use flight::{Control, Location, Phase, fly};
use forces::{Closed, Tangent};
use impact::Impact;
use moreau_contact::contact::delassus::MassFactor;
use moreau_contact::contact::{Contact, ContactImpulse};
use moreau_contact::solvers::ContactSolver;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

pub mod contact_phase;
pub mod filippov;
pub mod flight;
pub mod forces;
pub mod impact;
pub(crate) mod root;

/// The method and its declared rules.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventDriven {
    /// How steps are chosen between events.
    pub control: Control,
    /// Whether events are located.
    pub location: Location,
    /// τ \[s\]: an impact that would start a shorter flight is plastic; 0 without the rule.
    pub shortest_flight: f64,
}

impl Default for EventDriven {
    fn default() -> Self {
        EventDriven { control: Control::Tolerance(TOLERANCE), location: Location::Root, shortest_flight: FLIGHT }
    }
}

/// A motion over some time.
#[derive(Clone, Debug)]
pub struct Passage {
    /// Where it ends.
    pub state: State,
    /// The impulses of each contact that carried one, forces and impacts together.
    pub impulses: Vec<ContactImpulse>,
    /// How many events there were.
    pub events: usize,
    /// The impacts, in order.
    pub impacts: Vec<Collision>,
}

/// An impact within a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Collision {
    /// When, from the start of the motion \[s\].
    pub elapsed: f64,
    /// v after it.
    pub velocity: DVector<f64>,
    /// u_n of every candidate before and after it \[m/s\].
    pub normal_velocities: Vec<[f64; 2]>,
}

/// Events in a row without an impact and without time between them.
#[derive(Default)]
struct Stall {
    events: usize,
}

impl Stall {
    /// Counts an event that `moved` something on or did not; whether there are more in a row than so many contact rows can take.
    fn ends(&mut self, moved: bool, rows: usize) -> bool {
        self.events = if moved { 0 } else { self.events + 1 };
        self.events > stalled_events(rows)
    }
}

impl EventDriven {
    /// The motion over `duration` \[s\].
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a mechanism in space or with curved coordinates; [`Error::Solver`] where no contact forces exist or the
    /// events do not end; those of `solver`.
    ///
    /// ```
    /// use moreau_contact::solvers::Auto;
    /// use moreau_dynamics::event_driven::EventDriven;
    /// use moreau_dynamics::mechanics::{PointMass, State};
    /// use nalgebra::dvector;
    ///
    /// let ball = PointMass::ball_on_floor(1.0, 10.0, 1.0); // elastic: one period of a fall from 5 m is 2 s
    /// let start = State { time: 0.0, position: dvector![5.0], velocity: dvector![0.0] };
    /// let after = EventDriven::default().advance(&Auto, &ball, &start, 2.0)?;
    /// assert!((after.state.position[0] - 5.0).abs() < 1e-9 && after.impacts.len() == 1);
    /// # Ok::<(), moreau_exact::Error>(())
    /// ```
    pub fn advance(&self, solver: &dyn ContactSolver, mechanism: &dyn Mechanism, state: &State, duration: f64) -> Result<Passage> {
        self.check(mechanism, state, duration)?;
        afford(mechanism, &state.position, f64::INFINITY)?;
        let (mut position, mut velocity) = (state.position.clone(), state.velocity.clone());
        let mut tally = Tally::new(mechanism.rows_per_contact());
        let (mut left, mut step) = (duration, duration / 8.0);
        let mut ahead: Option<[DVector<f64>; 2]> = None;
        let mut impacts = Vec::new();
        let mut stall = Stall::default();
        for events in 0..EVENT_LIMIT {
            let contacts = mechanism.contacts(&position);
            let arriving = velocity.clone();
            let closed = self.resolve(solver, mechanism, &contacts, &position, &mut velocity, &mut tally)?;
            let struck = velocity != arriving;
            if struck {
                let normal = |contact: &Contact| [&arriving, &velocity].map(|v| (contact.jacobian.row(0) * v)[0]);
                let normal_velocities = contacts.iter().map(normal).collect();
                impacts.push(Collision { elapsed: duration - left, velocity: velocity.clone(), normal_velocities });
            }
            let decide = ahead.take().unwrap_or_else(|| [position.clone(), velocity.clone()]);
            let phase = ContactPhase::new(mechanism, closed, contacts.len(), [&decide[0], &decide[1]])?;
            let start = phase.joined(&position, &velocity);
            let arrival = fly(&phase, &start, left, self.control, self.location, &mut step)?;
            [position, velocity] = phase.split(&arrival.state);
            tally.add_forces(&phase.closed, &arrival.state, &mechanism.contacts(&position));
            left -= arrival.elapsed;
            let Some(event) = arrival.event.filter(|_| left > 0.0) else {
                project(mechanism, &phase.closed, &mut position, &mut velocity)?;
                let state = State { time: state.time + duration, position, velocity };
                return Ok(Passage { state, impulses: tally.impulses(), events, impacts });
            };
            if stall.ends(struck || arrival.elapsed > LOOK_AHEAD * duration, mechanism.rows_per_contact() * contacts.len()) {
                let reason = format!("events follow each other without any time passing, at t = {} s", state.time + duration - left);
                return Err(Error::limit("event-driven", reason));
            }
            let later = &arrival.state + phase.rate(&arrival.state)? * (LOOK_AHEAD * step.min(left));
            ahead = (!phase.is_gap(event)).then(|| phase.split(&later));
        }
        Err(Error::limit("event-driven", format!("met more than {EVENT_LIMIT} events before t = {} s", state.time + duration)))
    }

    /// Checks the step or tolerance and τ.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the parameter that is not valid.
    pub fn validate(&self) -> Result<()> {
        let (Control::Fixed(size) | Control::Tolerance(size)) = self.control;
        if !(size.is_finite() && size > 0.0) {
            return Err(Error::invalid("control", format!("is {:?}", self.control), "use a positive step or tolerance"));
        }
        if !(self.shortest_flight.is_finite() && self.shortest_flight >= 0.0) {
            return Err(Error::invalid("shortest_flight", format!("is {}", self.shortest_flight), "use a number of seconds, 0 or more"));
        }
        Ok(())
    }

    fn check(&self, mechanism: &dyn Mechanism, state: &State, duration: f64) -> Result<()> {
        if !(duration.is_finite() && duration > 0.0) {
            return Err(Error::invalid("time_step", format!("is {duration}"), "use a positive number of seconds"));
        }
        self.validate()?;
        let rows = mechanism.rows_per_contact();
        if rows > 2 || state.position.len() != mechanism.degrees_of_freedom() || state.velocity.len() != state.position.len() {
            let scope = "event-driven moves mechanisms on a line or in the plane, not in space";
            return Err(Error::Unsupported(format!("{}: {scope}", mechanism.name())));
        }
        Ok(())
    }

    /// The impact of what touches, if something arrives, and the contacts that stay closed.
    fn resolve(
        &self,
        solver: &dyn ContactSolver,
        mechanism: &dyn Mechanism,
        contacts: &[Contact],
        position: &DVector<f64>,
        velocity: &mut DVector<f64>,
        tally: &mut Tally,
    ) -> Result<Vec<Closed>> {
        let size = TOUCHING * (1.0 + position.amax());
        let touching: Vec<usize> = (0..contacts.len()).filter(|&k| contacts[k].gap <= size).collect();
        let slow = TOUCHING * (1.0 + velocity.amax());
        let impact = Impact { mechanism, solver, contacts, touching: &touching, position, shortest_flight: self.shortest_flight };
        if let Some((after, impulse)) = impact.resolve(velocity, slow)? {
            *velocity = after;
            tally.add(&touching, impulse.as_slice(), contacts);
        }
        let held = touching.into_iter().filter_map(|contact| {
            let speed = &contacts[contact].jacobian * &*velocity;
            let tangent = match speed.get(1) {
                Some(_) if contacts[contact].friction == 0.0 => Tangent::Free,
                None => Tangent::Free,
                Some(slip) if slip.abs() <= slow => Tangent::Sticking,
                Some(slip) => Tangent::Slipping(slip.signum()),
            };
            (speed[0] <= slow).then_some(Closed { contact, tangent })
        });
        Ok(held.collect())
    }
}

/// Takes what the closed contacts have drifted out of φ = 0 and u_n = 0, in the metric of M.
fn project(mechanism: &dyn Mechanism, closed: &[Closed], position: &mut DVector<f64>, velocity: &mut DVector<f64>) -> Result<()> {
    let contacts = mechanism.contacts(position);
    let slow = TOUCHING * (1.0 + velocity.amax());
    let far = TOUCHING * (1.0 + position.amax());
    // a contact whose force has vanished may have parted: it is not pulled back
    let held: Vec<&Contact> = closed.iter().map(|one| &contacts[one.contact]).collect();
    let held: Vec<&Contact> = held.into_iter().filter(|at| at.gap <= far && (at.jacobian.row(0) * &*velocity)[0].abs() <= slow).collect();
    if held.is_empty() {
        return Ok(());
    }
    let normals = DMatrix::from_fn(held.len(), velocity.len(), |i, j| held[i].jacobian[(0, j)]);
    let factor = MassFactor::new(&mechanism.mass_matrix(position))?;
    let mut answer = normals.transpose();
    for mut column in answer.column_iter_mut() {
        let solved = factor.solve(&column.clone_owned());
        column.copy_from(&solved);
    }
    let gaps = DVector::from_fn(held.len(), |i, _| held[i].gap);
    let least = |right: &DVector<f64>| least_squares("event-driven", &normals * &answer, right, |_| TOUCHING);
    *position -= &answer * least(&gaps)?;
    let speeds = &normals * &*velocity;
    *velocity -= &answer * least(&speeds)?;
    Ok(())
}

/// Impulses contact by contact.
struct Tally {
    rows: usize,
    entries: Vec<ContactImpulse>,
}

impl Tally {
    fn new(rows: usize) -> Self {
        Tally { rows, entries: Vec::new() }
    }

    fn add(&mut self, indices: &[usize], impulses: &[f64], contacts: &[Contact]) {
        for (&contact, part) in indices.iter().zip(impulses.chunks(self.rows)) {
            match self.entries.iter_mut().find(|known| known.contact == contact) {
                Some(known) => known.impulse.iter_mut().zip(part).for_each(|(sum, r)| *sum += r),
                None => self.entries.push(ContactImpulse { contact, impulse: part.into(), place: contacts[contact].place }),
            }
        }
    }

    /// The last entries of a state x of a phase.
    fn add_forces(&mut self, closed: &[Closed], x: &DVector<f64>, contacts: &[Contact]) {
        let indices: Vec<usize> = closed.iter().map(|one| one.contact).collect();
        let count = self.rows * closed.len();
        self.add(&indices, &x.as_slice()[x.len() - count..], contacts);
    }

    fn impulses(self) -> Vec<ContactImpulse> {
        self.entries
    }
}

#[cfg(test)]
mod tests;
