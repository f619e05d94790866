//! Near misses: one contact of an exact answer is changed by δ, with δ chosen so that its residual lies just above or below its limit.

use crate::exact::Exact;
use crate::family::{Member, answer};
use crate::rule::{Answer, CERTIFY, Limits, Ratio, judge};
use crate::tally::{Tally, Verdict};
use moreau::certificate::residuals;
use moreau::scalar::{Rational, exact};
use nalgebra::DVector;

/// How one contact's impulse is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// r (1 + δ).
    Heavier,
    /// r (1 − δ).
    Lighter,
    /// r_n (1 + δ), friction as it was.
    NormalOnly,
    /// r_n = δ at a contact that carries nothing.
    Push,
    /// r_n = −δ there.
    Pull,
    /// r_t turned by δ.
    Turn,
    /// r_t (1 − δ).
    Weaken,
    /// r_t (1 + δ).
    Strengthen,
    /// δ of the normal impulse added along a tangent.
    Nudge,
    /// r_t = 0 at the lightest contact.
    Drop,
    /// −r_t.
    Flip,
    /// r = 0.
    Forget,
}

pub const GRADED: [Kind; 9] =
    [Kind::Heavier, Kind::Lighter, Kind::NormalOnly, Kind::Push, Kind::Pull, Kind::Turn, Kind::Weaken, Kind::Strengthen, Kind::Nudge];
pub const WHOLE: [Kind; 3] = [Kind::Drop, Kind::Flip, Kind::Forget];

/// A member as f64 sees it: the rounded data and answer, taken as rationals again.
pub struct Seen<'a> {
    pub member: &'a Member,
    exact: Exact,
    impulse: DVector<f64>,
    rational: Vec<Rational>,
    net: Vec<Rational>,
}

impl<'a> Seen<'a> {
    pub fn new(member: &'a Member) -> Self {
        let exact_problem = Exact::of(&member.problem);
        let impulse = member.solution().impulse;
        let rational: Vec<Rational> = impulse.iter().map(|&r| exact(r)).collect();
        let net = exact_problem.net(&rational);
        Seen { member, exact: exact_problem, impulse, rational, net }
    }

    /// The data have not been rounded at all.
    pub fn is_digit_for_digit(&self) -> bool {
        let before = &self.member.exact;
        self.exact.delassus == before.delassus
            && self.exact.free == before.free
            && self.exact.shift == before.shift
            && self.exact.friction == before.friction
            && self.rational == self.member.impulse
    }

    /// The worst ratio of an impulse that differs from the answer at contact k only.
    fn ratio(&self, k: usize, impulse: &DVector<f64>) -> Ratio {
        self.ratio_by(&self.member.groups, CERTIFY, k, impulse)
    }

    fn ratio_by(&self, groups: &[Vec<usize>], limits: Limits, k: usize, impulse: &DVector<f64>) -> Ratio {
        let columns = k * self.exact.rows..(k + 1) * self.exact.rows;
        let mut rational = self.rational.clone();
        let mut change = Vec::new();
        for i in columns.clone() {
            rational[i] = exact(impulse[i]);
            change.push(&rational[i] - &self.rational[i]);
        }
        let mut net = self.net.clone();
        self.exact.add_net(&mut net, columns, &change);
        worst(&judge(&self.exact, groups, &Answer { impulse: &rational, net: &net }, limits))
    }

    /// The ratio of the rounded answer itself.
    pub fn own_ratio(&self, limits: Limits) -> Ratio {
        self.ratio_by(&self.member.groups, limits, 0, &self.impulse)
    }

    fn changed(&self, kind: Kind, k: usize, delta: f64) -> DVector<f64> {
        let rows = self.exact.rows;
        let n = k * rows;
        let mut r = self.impulse.clone();
        match kind {
            Kind::Heavier => (n..n + rows).for_each(|i| r[i] *= 1.0 + delta),
            Kind::Lighter => (n..n + rows).for_each(|i| r[i] *= 1.0 - delta),
            Kind::NormalOnly => r[n] *= 1.0 + delta,
            Kind::Push => r[n] = delta * self.push_scale(k),
            Kind::Pull => r[n] = -delta * self.push_scale(k),
            Kind::Turn => {
                let (sine, cosine) = delta.sin_cos();
                (r[n + 1], r[n + 2]) = (cosine * r[n + 1] - sine * r[n + 2], sine * r[n + 1] + cosine * r[n + 2]);
            }
            Kind::Weaken => (n + 1..n + rows).for_each(|i| r[i] *= 1.0 - delta),
            Kind::Strengthen => (n + 1..n + rows).for_each(|i| r[i] *= 1.0 + delta),
            Kind::Nudge => r[n + 1] += delta * r[n],
            Kind::Drop => (n + 1..n + rows).for_each(|i| r[i] = 0.0),
            Kind::Flip => (n + 1..n + rows).for_each(|i| r[i] = -r[i]),
            Kind::Forget => (n..n + rows).for_each(|i| r[i] = 0.0),
        }
        r
    }

    /// What would stop the contact's free velocity [N·s].
    fn push_scale(&self, k: usize) -> f64 {
        let (n, problem) = (k * self.exact.rows, &self.member.problem);
        (problem.free_velocity()[n] + problem.shift()[n]).abs() / problem.entry(n, n)
    }

    fn applies(&self, kind: Kind, k: usize) -> bool {
        let (rows, n) = (self.exact.rows, k * self.exact.rows);
        let rubs = (1..rows).any(|i| self.impulse[n + i] != 0.0);
        match kind {
            Kind::Heavier | Kind::Lighter | Kind::NormalOnly | Kind::Forget => self.impulse[n] > 0.0,
            Kind::Push | Kind::Pull => self.impulse[n] == 0.0 && self.push_scale(k) > 0.0,
            Kind::Turn => rubs && rows == 3,
            Kind::Weaken | Kind::Strengthen | Kind::Flip => rubs,
            Kind::Drop => rubs && k == self.lightest(),
            Kind::Nudge => rows > 1 && self.impulse[n] > 0.0,
        }
    }

    /// Of the contacts with friction the one that gives way most.
    fn lightest(&self) -> usize {
        let (rows, w) = (self.exact.rows, self.member.problem.dense());
        let rubbing = (0..self.exact.contacts()).filter(|k| (1..rows).any(|i| self.impulse[k * rows + i] != 0.0));
        rubbing.max_by(|a, b| w[(a * rows, a * rows)].total_cmp(&w[(b * rows, b * rows)])).unwrap_or(0)
    }

    /// Tries the near misses of one contact, graded and whole.
    pub fn near_misses(&self, tally: &mut Tally) {
        let turn = self.member.spec.index;
        for (place, &kind) in GRADED.iter().enumerate() {
            // the contact changes from kind to kind
            let contacts: Vec<usize> = (0..self.exact.contacts()).filter(|&k| self.applies(kind, k)).collect();
            if !contacts.is_empty() {
                self.graded(kind, contacts[(turn + place) % contacts.len()], tally);
            }
        }
        for kind in WHOLE {
            let contacts: Vec<usize> = (0..self.exact.contacts()).filter(|&k| self.applies(kind, k)).collect();
            if !contacts.is_empty() {
                let k = contacts[turn % contacts.len()];
                self.check(kind, "whole", k, &self.changed(kind, k, 1.0), tally);
            }
        }
    }

    /// Three sizes of one change: far off, just above twice the limit, just below half of it.
    fn graded(&self, kind: Kind, k: usize, tally: &mut Tally) {
        self.check(kind, "far", k, &self.changed(kind, k, 2f64.powi(-10)), tally);
        for (place, aim, range) in [("just above", 3.0, 2.0..4.5), ("just below", 0.35, 0.1..0.5)] {
            let mut delta = CERTIFY.tolerance;
            let mut found = None;
            for _ in 0..4 {
                let ratio = self.ratio(k, &self.changed(kind, k, delta));
                if ratio.least > range.start && ratio.most < range.end {
                    found = Some(delta);
                    break;
                }
                delta *= aim / ratio.most.clamp(1e-6, 1e6);
                if delta.is_nan() || delta > 0.5 {
                    break;
                }
            }
            match found {
                Some(delta) => self.check(kind, place, k, &self.changed(kind, k, delta), tally),
                None => tally.add(self.member, &format!("{kind:?}"), place, Verdict::OutOfReach),
            }
        }
    }

    /// Asks the certificate, and holds it against the rule.
    fn check(&self, kind: Kind, place: &str, k: usize, impulse: &DVector<f64>, tally: &mut Tally) {
        let ratio = self.ratio(k, impulse);
        let solution = answer(&self.member.problem, impulse.clone());
        let accepted = residuals(&self.member.problem, &solution).expect("sizes fit").is_solution(CERTIFY.tolerance);
        if ratio.least > 2.0 && place == "just above" {
            self.plant(k, impulse, tally);
        }
        let verdict = match (ratio.least > 2.0, ratio.most < 0.5, accepted) {
            (true, _, false) => Verdict::Refused,
            (_, true, true) => Verdict::Accepted,
            (true, _, true) => Verdict::WronglyAccepted,
            (_, true, false) => Verdict::WronglyRefused,
            _ => Verdict::Between,
        };
        if matches!(verdict, Verdict::WronglyAccepted | Verdict::WronglyRefused) {
            let status = self.member.statuses[k];
            tally.mistake(format!("{verdict:?}: {}, contact {k} ({status:?}), {kind:?} {place}, ratio {ratio:?}", self.member.name));
        }
        tally.add(self.member, &format!("{kind:?}"), place, verdict);
    }
}

impl Seen<'_> {
    /// What two rules of which this family must convict would say to a near miss.
    fn plant(&self, k: usize, impulse: &DVector<f64>, tally: &mut Tally) {
        let contacts = self.exact.contacts();
        let global = vec![(0..contacts).collect::<Vec<_>>(); contacts];
        let fooled = |groups: &[Vec<usize>], limits: Limits| self.ratio_by(groups, limits, k, impulse).most < 1.0;
        for (name, accepts) in [
            ("one scale for all contacts", fooled(&global, CERTIFY)),
            ("fast sliding widens", fooled(&self.member.groups, Limits { slip_widens: true, ..CERTIFY })),
        ] {
            tally.plant(name, accepts);
        }
    }
}

pub fn worst(ratios: &[Ratio]) -> Ratio {
    let largest = |of: fn(&Ratio) -> f64| ratios.iter().map(of).fold(0.0, f64::max);
    Ratio { least: largest(|r| r.least), most: largest(|r| r.most) }
}
