//! What the velocity of a joint is held against, and how far an impulse of a contact that counts as none moves one.
//!
//! ```text
//!     scale       max( ‖q_k‖ ,  ‖(W r_u)_k‖ up to 10³ V ,  ‖W_kk r_k‖ up to V )                        [m/s]
//!     floor       ‖γ (Σ_j |W_kj||r_j| + |u_free| + |shift| + R|r|)_k‖                                  [m/s]
//!     moved       ‖(W d)_k‖                                                                            [m/s]
//! ```
//! with q and r_u of [`joints`](super::joints), V the largest entry of q at the joints and closed contacts, r_n > ρ_n w, that W joins
//! with the joint, of all that it joins where these have none: what it never meets, and what leaves, excuses nothing,
//! and d the impulse of a contact that counts as none, as in [`reach`](super::reach): where
//! the W of all rows is not shown to be one of bodies, it may move no joint by more than τ of its scale.

use super::closing::closing;
use super::part::Part;
use super::semidefinite::indefiniteness;
use crate::operator::{ContactOperator, Operator};
use crate::problem::{ConstraintKind, JointedProblem, Law, Made};
use crate::tolerance::certificate::{HIDDEN, JAMMED, OFF_BY_FORMING, row_rounding};
use moreau_exact::doubled::DoubledResiduals;
use moreau_exact::tolerance::EPSILON;
use nalgebra::DVector;
use std::cell::OnceCell;

/// What the velocities of the joints are held against.
#[derive(Debug)]
pub(super) struct Joints<'a> {
    problem: &'a JointedProblem,
    impulse: &'a DVector<f64>,
    /// The contacts and limits.
    pushing: Vec<usize>,
    /// The rounding of y and of u, row by row \[m/s\].
    floors: DVector<f64>,
    /// The part of it that q = u_free + shift, one sum, does not round \[m/s\].
    unrounded: DVector<f64>,
    /// γ of every row.
    gammas: DVector<f64>,
    /// Whether rounding hides more than it may of some row.
    is_doubtful: bool,
    /// What W was made of, if it was.
    made: Option<Made>,
    /// How far the W of all rows is from one of bodies; found when it is asked.
    strangeness: OnceCell<f64>,
    /// y with twice the digits, and its rounding; computed when it is asked.
    sharp: OnceCell<[DVector<f64>; 2]>,
    /// q.
    data: DVector<f64>,
    /// W r_u.
    pushed: DVector<f64>,
    /// V of every constraint.
    fastest: Vec<f64>,
}

/// The largest entry of q among the joints and closed contacts that W joins with each constraint, over others, too; among all that it
/// joins, where these have none \[m/s\].
fn fastest(problem: &JointedProblem, impulse: &DVector<f64>, data: &DVector<f64>) -> Vec<f64> {
    let (w, count) = (problem.delassus(), problem.kinds().len());
    let y = w * impulse + data + problem.softnesses().component_mul(impulse);
    let is_closed = |k: usize| {
        let (kind, rows) = (problem.kinds()[k], problem.rows_of(k));
        let law = if kind == ConstraintKind::Contact { problem.contact_law() } else { Law::Frictionless };
        let moved = impulse[rows.start] * (w[(rows.start, rows.start)] + problem.softnesses()[rows.start]);
        matches!(kind, ConstraintKind::Bilateral { .. }) || moved > closing(law, problem.friction()[k], &y.as_slice()[rows])
    };
    let of_row: Vec<usize> = (0..count).flat_map(|k| problem.rows_of(k).map(move |_| k)).collect();
    let (mut found, mut is_met) = (vec![0.0; count], vec![false; count]);
    for first in 0..count {
        let (mut part, mut seen) = (if is_met[first] { Vec::new() } else { vec![first] }, 0);
        is_met[first] = true;
        while let Some(k) = part.get(seen).copied() {
            seen += 1;
            for row in problem.rows_of(k) {
                for (other, of) in of_row.iter().enumerate() {
                    if !is_met[*of] && (w[(other, row)] != 0.0 || w[(row, other)] != 0.0) {
                        is_met[*of] = true;
                        part.push(*of);
                    }
                }
            }
        }
        let larger = |most: f64, row: usize| most.max(data[row].abs());
        let largest_of = |part: &[usize]| part.iter().flat_map(|k| problem.rows_of(*k)).fold(0.0, larger);
        let closed: Vec<usize> = part.iter().copied().filter(|k| is_closed(*k)).collect();
        let largest = [largest_of(&closed), largest_of(&part)].into_iter().find(|velocity| *velocity > 0.0);
        part.iter().for_each(|k| found[*k] = largest.unwrap_or(0.0));
    }
    found
}

/// γ of every row of y: the entries of W that are zero round nothing.
fn gammas(problem: &JointedProblem, made: Option<&Made>) -> DVector<f64> {
    let mut terms: Vec<usize> = match made {
        Some(made) if made.loses_digits => vec![usize::MAX; problem.rows()],
        _ => problem.delassus().row_iter().map(|row| row.iter().filter(|w| **w != 0.0).count()).collect(),
    };
    if let Some(free) = made.filter(|made| made.loses_digits).and_then(|made| made.unformed.as_ref()) {
        free.write_terms(&mut terms);
    }
    DVector::from_iterator(terms.len(), terms.into_iter().map(row_rounding))
}

impl<'a> Joints<'a> {
    /// At an answer.
    pub fn new(problem: &'a JointedProblem, impulse: &'a DVector<f64>) -> Self {
        let data = problem.free_velocity() + problem.shifts();
        let (pushing, mut pushes) = (problem.pushing(), DVector::zeros(problem.rows()));
        pushing.iter().flat_map(|k| problem.rows_of(*k)).for_each(|row| pushes[row] = impulse[row]);
        let (pushed, fastest) = (problem.delassus() * pushes, fastest(problem, impulse, &data));
        let made = problem.dynamics().map(Made::of);
        let gammas = gammas(problem, made.as_ref());
        let given = problem.free_velocity().abs() + problem.shifts().abs();
        let mut moved = problem.softnesses().component_mul(&impulse.abs());
        match made.as_ref().filter(|made| made.loses_digits).and_then(|made| made.unformed.as_ref()) {
            Some(free) => free.add_magnitudes(impulse.as_slice(), moved.as_mut_slice()),
            None => moved += problem.delassus().abs() * impulse.abs(),
        }
        let (floors, unrounded) = ((moved + &given).component_mul(&gammas), (given - data.abs()).component_mul(&gammas));
        let (strangeness, sharp) = (OnceCell::new(), OnceCell::new());
        let mut joints = Joints {
            problem,
            impulse,
            pushing,
            floors,
            unrounded,
            gammas,
            is_doubtful: false,
            made,
            strangeness,
            sharp,
            data,
            pushed,
            fastest,
        };
        joints.is_doubtful = joints.is_made_doubtful() || (0..problem.kinds().len()).any(|k| joints.hides_too_much(k));
        joints
    }

    /// The joint that an impulse of contact `i` of the [`pushing`](JointedProblem::pushing) ones moves most, by what it is judged by.
    pub fn moved(&self, i: usize, taken: &[f64]) -> Part {
        let (w, rows) = (self.problem.delassus(), self.problem.rows_of(self.pushing[i]));
        let mut farthest = Part::default();
        for k in self.problem.bilateral() {
            let along = |row: usize| rows.clone().zip(taken).map(|(column, d)| w[(row, column)] * d).sum::<f64>();
            let moved = self.problem.rows_of(k).map(along).fold(0.0, f64::hypot);
            if moved != 0.0 {
                farthest = farthest.worse(self.part(k, moved));
            }
        }
        farthest
    }

    /// 0 where W was made of mass and Jacobian; else as of contacts alone.
    pub fn strangeness(&self) -> f64 {
        let of_any = || {
            let w = Operator::Dense(self.problem.delassus().clone());
            if w.overreaches(1) { 1.0 } else { indefiniteness(&w, 1).unwrap_or(0.0) }
        };
        *self.strangeness.get_or_init(|| if self.problem.dynamics().is_some() { 0.0 } else { of_any() })
    }

    fn scale(&self, k: usize) -> f64 {
        debug_assert!(matches!(self.problem.kinds()[k], ConstraintKind::Bilateral { .. }));
        let rows = self.problem.rows_of(k);
        let of = |vector: &DVector<f64>| vector.rows(rows.start, rows.len()).norm();
        let own = self.problem.delassus().view((rows.start, rows.start), (rows.len(), rows.len()));
        let own = (own * self.impulse.rows(rows.start, rows.len())).norm();
        of(&self.data).max(of(&self.pushed).min(JAMMED * self.fastest[k])).max(own.min(self.fastest[k]))
    }

    /// The rounding of W r_b at given impulses of the joints, and of the velocities `given` beside it \[m/s\]; all that rounds, where
    /// forming W lost digits.
    pub fn rounding(&self, held: &DVector<f64>, given: DVector<f64>) -> DVector<f64> {
        if self.made.as_ref().is_some_and(|made| made.loses_digits) {
            return self.floors.clone();
        }
        (self.problem.delassus().abs() * held.abs() + given).component_mul(&self.gammas)
    }

    /// y of all rows with twice the digits, and its rounding ε|y| + γ² of its terms \[m/s\]: of W as it was given, or of the mass and
    /// Jacobian that it was made of. Where there is no room for them the entries of W are rounded themselves, by γ of the terms.
    fn sharp(&self) -> &[DVector<f64>; 2] {
        self.sharp.get_or_init(|| {
            let (problem, softnesses) = (self.problem, self.problem.softnesses().as_slice());
            let mut sums = DoubledResiduals::new(problem.free_velocity().as_slice());
            for (row, (shift, r)) in problem.shifts().iter().zip(self.impulse).enumerate() {
                sums.subtract_unit(row, &-shift);
                sums.subtract_from(row, &softnesses[row..=row], &-r);
            }
            let (r, gammas) = (self.impulse.as_slice(), &self.gammas);
            let given = problem.free_velocity().abs() + problem.shifts().abs() + problem.softnesses().component_mul(&self.impulse.abs());
            let by_bodies = |made: &Made| made.unformed.as_ref().and_then(|free| free.add_doubled(r, &mut sums));
            let of_terms = match self.made.as_ref().map(by_bodies) {
                Some(Some(off)) => DVector::from_vec(off) + given * row_rounding(1).powi(2),
                not_by_bodies => {
                    problem.delassus().column_iter().zip(r).for_each(|(w, r)| sums.subtract(w.clone_owned().as_slice(), &-r));
                    if not_by_bodies.is_some() { self.floors.sup(&self.made_rounding()) } else { self.floors.component_mul(gammas) }
                }
            };
            let y = DVector::from_vec(sums.values());
            let floors = y.abs() * EPSILON + of_terms;
            [y, floors]
        })
    }

    /// The same of contacts and limits.
    pub fn sharp_of_contacts(&self) -> [Vec<f64>; 2] {
        self.sharp().each_ref().map(|all| self.problem.spread(all).as_slice().to_vec())
    }

    /// V of constraint k \[m/s\].
    pub fn fastest(&self, k: usize) -> f64 {
        self.fastest[k]
    }

    /// What rounding may hide at constraint k \[m/s\].
    fn hidden(&self, k: usize) -> f64 {
        if self.fastest[k] > 0.0 { self.fastest[k] * HIDDEN } else { f64::INFINITY }
    }

    /// Whether so much rounding hides more than it may at constraint k; what is no number does, too.
    fn hides(&self, k: usize, floor: f64) -> bool {
        floor.is_nan() || floor > self.hidden(k)
    }

    /// Whether rounding hides more than it may of some row: then all are judged with twice the digits.
    pub fn is_anything_doubtful(&self) -> bool {
        self.is_doubtful
    }

    /// As of contacts: rows that are nearly orthogonal in M⁻¹ are off by γ_i √W_ii Σ_j √W_jj |r_j|, which no floor has among its terms.
    fn is_made_doubtful(&self) -> bool {
        let moved = self.made.as_ref().map(|_| self.made_rounding());
        let is_off = |moved: &DVector<f64>, k: usize| {
            let mut rows = self.problem.rows_of(k);
            rows.any(|row| self.hides(k, moved[row] * HIDDEN / OFF_BY_FORMING))
        };
        moved.is_some_and(|moved| (0..self.problem.kinds().len()).any(|k| is_off(&moved, k)))
    }

    /// γ_i √W_ii Σ_j √W_jj |r_j|.
    fn made_rounding(&self) -> DVector<f64> {
        let roots = self.problem.delassus().diagonal().map(|w| w.abs().sqrt());
        let reach = roots.dot(&self.impulse.abs());
        self.gammas.component_mul(&roots) * reach
    }

    /// Whether rounding hides more than it may of y at joint k.
    fn hides_too_much(&self, k: usize) -> bool {
        let rows = self.problem.rows_of(k);
        let [floors, unrounded] = [&self.floors, &self.unrounded].map(|all| all.rows(rows.start, rows.len()));
        self.hides(k, (floors - unrounded).norm())
    }

    /// The velocity of joint k, of this y or with twice the digits.
    pub fn velocity(&self, k: usize, law_velocity: &DVector<f64>) -> Part {
        let y = if self.is_doubtful { &self.sharp()[0] } else { law_velocity };
        self.part(k, self.norm(k, y))
    }

    /// How far the stored velocity u of joint k is from what its impulses make it, `found` or with twice the digits; where those are needed
    /// it may be off by what rounding may hide.
    pub fn stored(&self, k: usize, [stored, found]: [&DVector<f64>; 2]) -> Part {
        if !self.is_doubtful {
            return self.part(k, self.norm(k, &(stored - found)));
        }
        let sharp = &self.sharp()[0] - self.problem.shifts() - self.problem.softnesses().component_mul(self.impulse);
        Part { value: self.norm(k, &(stored - sharp)), scale: self.scale(k), floor: self.hidden(k) }
    }

    /// y of twice the digits, where rounding hides too much of some row of it.
    pub fn sharp_velocity(&self) -> Option<&DVector<f64>> {
        self.is_doubtful.then(|| &self.sharp()[0])
    }

    fn norm(&self, k: usize, all: &DVector<f64>) -> f64 {
        let rows = self.problem.rows_of(k);
        all.rows(rows.start, rows.len()).norm()
    }

    /// A velocity of joint k with its scale and its floor; a floor that even with twice the digits hides more of V than it may is a
    /// residual itself.
    fn part(&self, k: usize, value: f64) -> Part {
        let own = if self.hides_too_much(k) { 0.0 } else { self.norm(k, &self.floors) };
        let floor = if self.is_doubtful { moreau_exact::number::larger(own, self.norm(k, &self.sharp()[1])) } else { own };
        let value = if self.is_doubtful && self.hides(k, floor) { moreau_exact::number::larger(value, floor) } else { value };
        Part { value, scale: self.scale(k), floor: floor.min(self.hidden(k)) }
    }
}
