//! The positions of one step, pushed out contact by contact.
//!
//! ```text
//!     one sweep:   for each candidate of the list at its start:
//!                  ΔΛ_n = max(−Λ_n, −(φ + α̃ Λ_n)/(w_n + α̃)) ,   q ← q + M⁻¹Hᵀ ΔΛ ,   φ and H at q as it is
//! ```
//! The pushes move the bodies, and with them the list: a corner leaves a face, another one comes over it. So a candidate is known by its
//! bodies and features, and its Λ stays with it.
//! - A candidate that appears within a sweep starts with Λ = 0 in the next one.
//! - A candidate that is none any more is left alone. Its Λ stays: what it has pushed has moved the bodies.
//!
//! **Candidates left out.** One with φ > 0 and Λ = 0 pushes nothing, because ΔΛ_n = max(0, −φ/w) = 0 and friction has the limit 0. A
//! candidate farther away than `reach` stays one of these as long as the pushes of the sweep bring no two points nearer than `reach` in
//! all, of which [`Mechanism::reach`] gives a bound. Where the bound is exceeded the step begins again with a larger reach. So the answer
//! is that of all candidates.

use crate::mechanics::{Mechanism, afford};
use moreau_contact::certificate::StepResidual;
use moreau_contact::contact::delassus::MassFactor;
use moreau_contact::contact::{Contact, Identity};
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_exact::Result;
use nalgebra::DVector;

/// A contact that the sweeps have met, with its multipliers.
#[derive(Clone, Debug)]
pub(super) struct Held {
    /// Which one.
    pub identity: Identity,
    /// Λ, one entry per row \[N·s²\].
    pub multiplier: DVector<f64>,
}

/// A step in the making.
#[derive(Clone)]
pub(super) struct Positions<'a> {
    pub mechanism: &'a dyn Mechanism,
    pub factor: &'a MassFactor<f64>,
    /// q now.
    pub position: DVector<f64>,
    /// The motion since the start of the step, h v \[m\].
    pub motion: DVector<f64>,
    held: Vec<Held>,
    /// A bound of how far the pushes of this sweep have brought any two points together \[m\].
    nearer: f64,
}

impl<'a> Positions<'a> {
    /// Positions that no contact has pushed yet.
    pub fn new(mechanism: &'a dyn Mechanism, factor: &'a MassFactor<f64>, position: DVector<f64>, motion: DVector<f64>) -> Self {
        Positions { mechanism, factor, position, motion, held: Vec::new(), nearer: 0.0 }
    }

    /// These positions after some sweeps; `reach` \[m\] is where the search for candidates begins.
    ///
    /// # Errors
    /// Those of [`afford`].
    pub fn swept(&self, sweeps: usize, weights: [f64; 2], mut reach: f64) -> Result<Self> {
        loop {
            afford(self.mechanism, &self.position, reach)?;
            let mut tried = self.clone();
            let needed = (0..sweeps).map(|_| tried.sweep(weights, reach)).find(|nearer| *nearer > reach);
            match needed {
                Some(nearer) => reach = 2.0 * nearer,
                None => return Ok(tried),
            }
        }
    }

    /// One sweep over the candidates within `reach`, and the reach it needed: how far its pushes may have brought two points together, or
    /// how far away a contact is that has pushed and can pull back.
    fn sweep(&mut self, weights: [f64; 2], reach: f64) -> f64 {
        self.nearer = 0.0;
        let near = self.near(reach);
        let carries = |held: &&Held| held.multiplier[0] > 0.0 && !near.iter().any(|one| one.is_same(&held.identity));
        let away = self.held.iter().filter(carries).filter_map(|held| self.anew(&held.identity)).map(|contact| contact.gap);
        let farthest = away.fold(0.0, f64::max);
        if farthest > reach {
            return farthest;
        }
        for identity in near {
            if let Some(contact) = self.anew(&identity) {
                self.project(&contact, identity, weights);
            }
        }
        self.nearer
    }

    /// The candidates within `reach`.
    fn near(&self, reach: f64) -> Vec<Identity> {
        let listed = self.mechanism.contacts_within(&self.position, reach);
        listed.iter().enumerate().map(|(index, contact)| Identity::of(index, contact)).collect()
    }

    /// A candidate at q, if it is one.
    fn anew(&self, identity: &Identity) -> Option<Contact> {
        match identity.place {
            None => self.mechanism.contacts(&self.position).into_iter().nth(identity.index),
            Some(place) => {
                let found = self.mechanism.contacts_between(&self.position, place.bodies).into_iter();
                found.into_iter().find(|contact| contact.place.is_some_and(|own| own.is_same(&place)))
            }
        }
    }

    /// Where the multiplier of a candidate is kept, from now on if it has none.
    fn place_of(&mut self, identity: Identity, rows: usize) -> usize {
        if let Some(known) = self.held.iter().position(|held| held.identity.is_same(&identity)) {
            return known;
        }
        self.held.push(Held { identity, multiplier: DVector::zeros(rows) });
        self.held.len() - 1
    }

    /// One contact of one sweep.
    fn project(&mut self, contact: &Contact, identity: Identity, [scaled, share]: [f64; 2]) {
        let rows = contact.jacobian.nrows();
        let at = self.place_of(identity, rows);
        let known = self.held[at].multiplier[0];
        let weight = self.weight(contact, 0);
        let wanted = -share * (contact.gap + scaled * known) / (weight + scaled);
        self.push(contact, 0, wanted.max(-known), at);
        let limit = contact.friction * self.held[at].multiplier[0];
        let before: Vec<f64> = (1..rows).map(|row| self.held[at].multiplier[row]).collect();
        let slide = &contact.jacobian * &self.motion;
        let after: Vec<f64> = (1..rows).map(|row| before[row - 1] - share * slide[row] / self.weight(contact, row)).collect();
        let size = after.iter().map(|part| part * part).sum::<f64>().sqrt();
        let kept = if size > limit { limit / size } else { 1.0 };
        for row in 1..rows {
            self.push(contact, row, after[row - 1] * kept - before[row - 1], at);
        }
    }

    /// H M⁻¹Hᵀ of one row.
    pub fn weight(&self, contact: &Contact, row: usize) -> f64 {
        let direction = contact.jacobian.row(row).transpose();
        direction.dot(&self.factor.solve(&direction))
    }

    fn push(&mut self, contact: &Contact, row: usize, change: f64, at: usize) {
        if change != 0.0 {
            let moved = self.factor.solve(&(contact.jacobian.row(row).transpose() * change));
            self.position = self.mechanism.integrate(&self.position, &moved, 1.0);
            self.nearer += self.mechanism.reach(&moved, 1.0);
            self.motion += moved;
            self.held[at].multiplier[row] += change;
        }
    }

    /// What the sweeps leave of the position problem, relative to the largest Λ_n: min(Λ_n, (φ + α̃Λ_n)/(w_n + α̃)) and ‖Λ_t −
    /// P_disk(μΛ_n)(Λ_t − s_t/w_t)‖/μ, s_t the slide since the start of the step. None without a contact that pushes or should.
    pub fn residual(&self, scaled: f64, reach: f64) -> Option<StepResidual> {
        let (mut left, mut largest) = (0.0f64, 0.0f64);
        let mut pair = None;
        for (index, contact) in self.mechanism.contacts_within(&self.position, reach).into_iter().enumerate() {
            let identity = Identity::of(index, &contact);
            let known = self.held.iter().find(|held| held.identity.is_same(&identity));
            let none = DVector::zeros(contact.jacobian.nrows());
            let multiplier = known.map_or(&none, |held| &held.multiplier);
            let weight = self.weight(&contact, 0);
            let normal = multiplier[0].min((contact.gap + scaled * multiplier[0]) / (weight + scaled)).abs();
            let here = normal.max(self.friction_left(&contact, multiplier));
            largest = largest.max(multiplier[0]).max(normal);
            if here > left {
                left = here;
                pair = contact.place.map(|place| [Some(place.bodies.0), place.bodies.1]);
            }
        }
        let relative = left / largest;
        let residual = StepResidual { rule: "position problem", residual: "natural map", relative, limit: CERTIFY, contact: None, pair };
        (largest > 0.0).then_some(residual)
    }

    fn friction_left(&self, contact: &Contact, multiplier: &DVector<f64>) -> f64 {
        let (rows, limit) = (multiplier.len(), contact.friction * multiplier[0]);
        if limit <= 0.0 {
            return 0.0;
        }
        let slide = &contact.jacobian * &self.motion;
        let wanted = DVector::from_fn(rows - 1, |k, _| multiplier[k + 1] - slide[k + 1] / self.weight(contact, k + 1));
        let size = wanted.norm();
        let kept = if size > limit { wanted * (limit / size) } else { wanted };
        (multiplier.rows(1, rows - 1) - kept).norm() / contact.friction
    }

    /// The contacts with Λ_n > 0: the candidates at q among them in the order of the list, and those that are none any more.
    pub fn carrying(&self) -> (Vec<(Contact, Held)>, Vec<Held>) {
        let carrying: Vec<&Held> = self.held.iter().filter(|held| held.multiplier[0] > 0.0).collect();
        let farthest = carrying.iter().filter_map(|held| self.anew(&held.identity)).map(|contact| contact.gap).fold(0.0, f64::max);
        let listed = if carrying.is_empty() { Vec::new() } else { self.mechanism.contacts_within(&self.position, farthest) };
        let (mut present, mut found) = (Vec::new(), vec![false; carrying.len()]);
        for (index, contact) in listed.into_iter().enumerate() {
            let identity = Identity::of(index, &contact);
            if let Some(at) = carrying.iter().position(|held| held.identity.is_same(&identity)) {
                found[at] = true;
                present.push((contact, Held { identity, multiplier: carrying[at].multiplier.clone() }));
            }
        }
        let gone = carrying.into_iter().zip(found).filter(|(_, found)| !found).map(|(held, _)| held.clone());
        (present, gone.collect())
    }
}
