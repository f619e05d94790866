//! What each scheme adds to u for its law, written down a second time from the mechanism's gaps and coefficients.
//!
//! ```text
//!     Newton             s = e u⁻ n  (full vector: e u⁻)             gap               s = φ/h n
//!     of the free step   s = e min(u_free,n, 0) n                    Schatzman–Paoli   s = ((1+e) φ/h − e u_n⁻) n
//!     Chrono, Bullet, MuJoCo: as in their files                      relaxed           s = φ/(h+τ) n
//! ```
//! The shift that a scheme posed is not looked at: a restitution applied twice or a wrong sign differs from what stands here.

use crate::bullet::{Bodies, Bullet};
use crate::chrono::Chrono;
use crate::energy_balance::Taken;
use crate::energy_balance::exchange::Exchange;
use crate::mujoco::Softness;
use moreau_contact::contact::{Contact, Place};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// The shift of a scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shift {
    /// e u⁻ of the rows that the step assembled, the normal one or all.
    Newton { full: bool },
    /// e u_n⁻ of the rows at the start of the step, where the contact was already a candidate.
    NewtonAtStart,
    /// e min(u_free,n, 0).
    NewtonOfFree,
    /// φ/(h + τ).
    Gap { relaxation: f64 },
    /// (1+e) φ/h − e u_n⁻.
    SchatzmanPaoli,
    /// e u_n⁻ or max(φ/h, −v_r).
    Chrono(Chrono),
    /// A target of Baumgarte's or a rebound.
    Bullet(Bullet),
    /// −u⁻ − h a_ref.
    Mujoco(Softness),
}

/// The candidate in a list that a contact of the step is: by its features, the nearest normal first; by its index where bodies have no
/// place.
fn candidate<'a>(list: &'a [Contact], index: usize, place: Option<&Place>, normal: &DVector<f64>) -> Option<&'a Contact> {
    let Some(place) = place else { return list.get(index) };
    let same = list.iter().filter(|one| one.place.as_ref().is_some_and(|other| other.is_same(place)));
    let off = |one: &Contact| (one.jacobian.row(0).transpose() - normal).norm();
    same.min_by(|a, b| off(a).total_cmp(&off(b)))
}

/// Any candidate between the same two bodies, whose material is the same.
fn same_bodies<'a>(list: &'a [Contact], place: Option<&Place>) -> Option<&'a Contact> {
    let place = place?;
    list.iter().find(|one| one.place.as_ref().is_some_and(|other| other.bodies == place.bodies))
}

/// The candidates at the start and at the end of a step.
struct Candidates {
    start: Vec<Contact>,
    end: Vec<Contact>,
}

impl Shift {
    /// Whether the shift is e u⁻, the law under which the total energy has a bound of its own.
    pub fn is_newton(self) -> bool {
        matches!(self, Shift::Newton { .. })
    }

    /// Whether the step's contacts may be none of the start.
    fn is_material_enough(self) -> bool {
        matches!(self, Shift::Newton { .. } | Shift::NewtonAtStart | Shift::NewtonOfFree)
    }

    /// s \[m/s\] of every contact row of the step, and e of every contact.
    pub fn declared(self, taken: &Taken, exchange: &Exchange) -> Result<(DVector<f64>, Vec<f64>)> {
        let assembled = &taken.step.assembled;
        let mut shift = DVector::zeros(exchange.impulse.len());
        let mut restitutions = Vec::new();
        if assembled.active.is_empty() {
            return Ok((shift, restitutions));
        }
        let rows = shift.len() / assembled.active.len();
        let lists = Candidates {
            start: taken.mechanism.contacts(&taken.before.position),
            end: if self.is_material_enough() { taken.mechanism.contacts(&taken.step.state.position) } else { Vec::new() },
        };
        for (k, (&index, place)) in assembled.active.iter().zip(&assembled.places).enumerate() {
            let first = k * rows;
            let normal = assembled.jacobian.contacts()[k].row(0).transpose();
            let at_start = candidate(&lists.start, index, place.as_ref(), &normal);
            let known = at_start
                .or_else(|| candidate(&lists.end, index, place.as_ref(), &normal))
                .or_else(|| same_bodies(&lists.start, place.as_ref()))
                .or_else(|| same_bodies(&lists.end, place.as_ref()))
                .ok_or_else(|| Error::Unsupported(format!("contact {index} of the step is not a candidate of the mechanism")))?;
            if at_start.is_none() && !self.is_material_enough() {
                return Err(Error::Unsupported(format!("contact {index} of the step is not a candidate at the start of the step")));
            }
            let mut at = At { taken, contact: known, before: exchange.before.rows(first, rows).into_owned(), free: exchange.free[first] };
            if let (Shift::NewtonAtStart, Some(contact)) = (self, at_start) {
                at.before = &contact.jacobian * &taken.before.velocity;
            }
            shift.rows_mut(first, rows).copy_from(&self.of(&at));
            restitutions.push(known.restitution);
        }
        Ok((shift, restitutions))
    }

    /// s of one contact.
    fn of(self, at: &At) -> DVector<f64> {
        let (e, gap, h, arriving) = (at.contact.restitution, at.contact.gap, at.taken.h, at.before[0]);
        let normal = match self {
            Shift::Newton { full: true } => return &at.before * e,
            Shift::Newton { full: false } | Shift::NewtonAtStart => e * arriving,
            Shift::NewtonOfFree => e * at.free.min(0.0),
            Shift::Gap { relaxation } => gap / (h + relaxation),
            Shift::SchatzmanPaoli => (1.0 + e) * gap / h - e * arriving,
            Shift::Chrono(chrono) => {
                let rebounds = e * arriving < -chrono.bounce_speed && gap + h * e * arriving < 0.0;
                if rebounds { e * arriving } else { (gap / h).max(-chrono.recovery_speed) }
            }
            Shift::Bullet(bullet) => {
                let arriving = if bullet.bodies == Bodies::Multi { at.free } else { arriving };
                let rebound = if arriving <= -bullet.restitution_threshold { e * arriving } else { 0.0 };
                let distance = gap + bullet.slop;
                let split = bullet.bodies == Bodies::Rigid && distance <= crate::bullet::SPLIT_DEPTH;
                let share = if distance > 0.0 { 1.0 } else { bullet.error_reduction };
                rebound + if split { 0.0 } else { share * distance / h }
            }
            Shift::Mujoco(softness) => {
                let reference = softness.reference_acceleration(h, gap, at.before.as_slice());
                return DVector::from_iterator(at.before.len(), at.before.iter().zip(reference).map(|(u, a)| -u - h * a));
            }
        };
        let mut shift = DVector::zeros(at.before.len());
        shift[0] = normal;
        shift
    }
}

/// One contact of a step.
struct At<'a> {
    taken: &'a Taken<'a>,
    contact: &'a Contact,
    /// H v \[m/s\].
    before: DVector<f64>,
    /// (H v_free)_n \[m/s\].
    free: f64,
}
