//! How far an impulse reaches that counts as none: what it moves at other contacts.
//!
//! ```text
//!     d          what an exact answer would not have: the impulse of a contact that opens, or what is outside of its disk    [N·s]
//!     v_k        s_k/ρ_k, and at a contact without an impulse, which may move as it likes while it opens, w_k where it is larger  [m/s]
//!     ‖d‖        is held against   ‖d‖ v_k/(ε |(W d)_k|) ,   the smallest over the rows k of the other contacts              [N·s]
//! ```
//! Without d the answer is another one, and velocities differ by W d. Where every part that is taken away moves no row k by more than
//! τ v_k, and every row whose impulse stays has a velocity within τ s_k/ρ_k, what is left solves *exactly* a problem whose given velocities
//! differ by no more than the sum of these. An impulse that is small by its own size alone says nothing of the kind.
//!
//! with ε = 1. A linear complementarity problem may have any matrix, and it is always asked there; so it is of contacts where an entry is
//! larger than those of bodies, |W_ij|² ≤ W_ii W_jj. Of others ε tells how far W is from a positive semidefinite one, as W + ε diag W is:
//! see [`semidefinite`](super::semidefinite). Of a W that is made of mass and Jacobian it is never asked. There it
//! moves another contact by no more than τ √(W_jj/W_ii) of its own scale, which is much where a light contact stands beside a heavy one:
//! then the answer is one for given velocities that differ by as much, and `certify --prove` says by how much.
//!
//! What holds contacts, [`joints`](super::joints), is among the rows k: through a joint an impulse reaches as far as through W. There ε is
//! told of the W of all rows.

use super::joint_scales::Joints;
use super::part::Part;
use super::scales::Scales;
use super::semidefinite::indefiniteness;
use crate::cones::second_order::{length, tangential_norm};
use crate::problem::{ContactProblem, Law};
use crate::tolerance::certificate::LEVELS;
use std::cell::RefCell;

/// An answer whose impulses are asked how far they reach.
pub(super) struct Reach<'a> {
    pub problem: &'a ContactProblem,
    /// At this answer.
    pub scales: &'a Scales,
    pub impulse: &'a [f64],
    /// y \[m/s\].
    pub law_velocity: &'a [f64],
    /// What holds the contacts, if anything does.
    joints: Option<&'a Joints<'a>>,
    /// Whether W is looked at as a whole, or by its entries alone.
    thoroughly: bool,
    /// W d \[m/s\].
    moved: RefCell<Vec<f64>>,
}

/// How far W is from one of bodies: 1 where an entry is too large for them; else how far it is from a semidefinite one, which bodies in
/// its blocks may tell. What is too large to tell is taken for one of bodies.
fn strangeness(problem: &ContactProblem) -> f64 {
    if problem.overreaches() {
        return 1.0;
    }
    problem.indefiniteness(|problem| {
        let by_bodies = problem.delassus().stored_blocks().zip(problem.velocity_factor()).map(|(w, factor)| factor.deviation(w));
        let near = by_bodies.filter(|deviation| *deviation <= LEVELS[1]);
        near.or_else(|| indefiniteness(problem.delassus(), problem.rows_per_contact())).unwrap_or(0.0)
    })
}

impl<'a> Reach<'a> {
    /// Nothing where W is known to be one of bodies; not `thoroughly`, where it has their entries.
    pub fn new(
        problem: &'a ContactProblem,
        scales: &'a Scales,
        [impulse, law_velocity]: [&'a [f64]; 2],
        joints: Option<&'a Joints<'a>>,
        thoroughly: bool,
    ) -> Option<Self> {
        let reach = || Reach { problem, scales, impulse, law_velocity, joints, thoroughly, moved: RefCell::default() };
        (joints.is_some() || problem.known_overreach() != Some(false)).then(reach)
    }

    /// The part d of the impulse of a contact, as an impulse \[N·s\]; 0 where it moves nothing above rounding. What it moves at the contact
    /// itself is asked of the normal row, but where a push is taken away as a whole, `is_whole`, by which a contact that opens does so all
    /// the more or by less than its own scale.
    pub fn of(&self, contact: usize, taken: &[f64], is_whole: bool) -> Part {
        let strangeness = if taken.iter().all(|d| *d == 0.0) { 0.0 } else { self.strangeness() };
        if strangeness == 0.0 {
            return Part::default();
        }
        let mut moved = self.moved.borrow_mut();
        moved.resize(self.problem.rows(), 0.0);
        self.problem.delassus().of_contacts().add_contact(contact, taken, &mut moved);
        let (mut farthest, rows) = (Part::default(), taken.len());
        let stored = self.problem.delassus().stored_blocks().map(|blocks| blocks.met(contact));
        let all = if stored.is_none() { 0..self.problem.contacts() } else { 0..0 };
        for k in stored.unwrap_or_default().iter().copied().chain(all) {
            let moved = &mut moved[k * rows..(k + 1) * rows];
            if moved.iter().all(|u| *u == 0.0) {
                continue;
            }
            let [normal, tangential] = self.at(k, moved);
            moved.fill(0.0);
            if k != contact {
                farthest = farthest.worse(normal).worse(tangential);
            } else if !is_whole || taken[0] < 0.0 {
                farthest = farthest.worse(normal);
            }
        }
        let farthest = self.joints.map_or(farthest, |joints| farthest.worse(joints.moved(contact, taken)));
        if farthest.relative() == 0.0 {
            return Part::default();
        }
        let (value, share) = (length(taken[0], tangential_norm(taken)), strangeness * farthest.value);
        Part { value, scale: value * (farthest.scale / share), floor: value * (farthest.floor / share) }
    }

    fn strangeness(&self) -> f64 {
        if let Some(joints) = self.joints {
            return joints.strangeness();
        }
        if self.thoroughly { strangeness(self.problem) } else { f64::from(u8::from(self.problem.overreaches())) }
    }

    /// What the velocity W d of contact k is held against, along its normal and along its tangents.
    fn at(&self, k: usize, moved: &[f64]) -> [Part; 2] {
        let (law, rows) = (self.problem.law(), k * moved.len()..(k + 1) * moved.len());
        let [r, y, floors] = [self.impulse, self.law_velocity, &self.scales.floors].map(|all| &all[rows.clone()]);
        let ([v_n, v_t], hidden) = (self.scales.velocities(k), self.scales.hidden(k));
        let ([m_n, m_t], [f_n, f_t]) = [moved, floors].map(|all| [all[0].abs(), tangential_norm(all)]).into();
        let normal = Part { value: m_n, scale: v_n, floor: f_n.min(hidden) };
        let mu = law.cone_friction(self.problem.friction()[k]);
        if r.iter().all(|r| *r == 0.0) {
            let lift = if matches!(law, Law::Associated | Law::PolyhedralAssociated { .. }) { mu } else { 0.0 };
            let scale = v_n.max(y[0] - lift * tangential_norm(y));
            return [Part { value: m_n + lift * m_t, scale, floor: (f_n + lift * f_t).min(hidden) }, Part::default()];
        }
        let rubbing = Part { value: m_t, scale: v_t, floor: f_t.min(hidden) };
        [normal, if mu > 0.0 { rubbing } else { Part::default() }]
    }
}

#[cfg(test)]
#[path = "reach_tests.rs"]
mod tests;
