//! The judgement of an answer, contact by contact: each residual with its scale, and the contact where it is worst.
//!
//! ```text
//!     normal        min(r_n, ρ_n w)                                                                  [N·s]
//!     tangential    ‖r_t − P_disk(μ r_n)(r_t − ρ_t y_t)‖                                              [N·s]
//!     w = y_n  (frictionless, Coulomb) ,      w = y_n − μ‖y_t‖  (associated)                          [m/s]
//! ```
//! Both vanish at a contact exactly if its law holds there: r_n ⟂ w is Signorini's condition, and the disk gives Coulomb's friction for the
//! normal impulse r_n; with w = y_n − μ‖y_t‖ they say K ∋ r ⟂ y ∈ K*. Unlike r − P_K(r − ρŷ) they do not take the difference of two numbers
//! as large as the slip speed, and they tell a wrong normal impulse from a wrong direction of friction. Polyhedral laws are judged by their
//! pairs.
//!
//! An impulse that counts as none is held against what it moves at other contacts, too, where W may carry it far:
//! see [`reach`](super::reach).
//!
//! Inside of the disk the friction of an associated law holds where y_t is within its limit; that excuses no y_n = μ‖y_t‖, which has a
//! scale of its own: there y_n is within it, or r_t is at the edge of the disk, or r counts as none.
//!
//! The scale of a product is that of one member times the size of the other: an impulse that is larger than its scale times a velocity that
//! is within its own says no more than this velocity. Where a contact slides, the scale of friction is μ s_r, for μ > 1 at most the larger
//! of s_r and s_t. The rounding of its velocity counts as an angle, relative to the slip.

use super::at_contact::{AtContact, Here, in_space, worst};
use super::joint_scales::Joints;
use super::judged::Judged;
use super::part::{Part, pair};
use super::polyhedral::{self, Pairs};
use super::reach::Reach;
use super::remembered;
use super::scales::{self, Held, Scales, Unheld, at_least};
use crate::cones::second_order::{distance_of, length, tangential_norm};
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::certificate::PROJECTED;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Judges answers; its memory is used again, so that judging step after step does not allocate.
#[derive(Clone, Debug, Default)]
pub struct Judge {
    scales: Scales,
    law_velocity: Vec<f64>,
    pairs: Pairs,
    /// Whether it is asked if W is one of bodies as a whole, or by its entries alone.
    thoroughly: bool,
    /// Whether rounding hides too much of y at some contact that was judged last.
    is_doubtful: bool,
}

impl Judge {
    /// The judgement of `solution`, whose sizes fit the problem; W and |W| are multiplied once by r.
    ///
    /// # Errors
    /// [`Error::Invalid`] if an edge compliance makes the answer depend on edge impulses that it does not give.
    /// ```
    /// use moreau_contact::certificate::Judge;
    /// use moreau_contact::nalgebra::{DMatrix, dvector};
    /// use moreau_contact::prelude::*;
    ///
    /// let ball = ContactProblem::new(DMatrix::identity(1, 1), dvector![-1.0]).rows_per_contact(1).build()?;
    /// let judged = Judge::default().judge(&ball, &Solution::new("too little", dvector![0.5], dvector![-0.5], 0))?;
    /// assert!(!judged.accepts(1e-8));
    /// let (name, worst) = judged.worst();
    /// assert_eq!((name, worst.contact), ("dual", 0)); // it goes on at 0.5 m/s into the floor
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn judge(&mut self, problem: &ContactProblem, solution: &Solution) -> Result<Judged> {
        self.scales.prepare(problem);
        self.thoroughly(|judge| judge.judge_prepared(problem, solution))
    }

    /// [`Judge::judge`] of an answer on the way: that W is one of bodies is asked of its entries alone, where it is not known.
    pub(crate) fn look(&mut self, problem: &ContactProblem, solution: &Solution) -> Result<Judged> {
        self.scales.prepare(problem);
        self.judge_prepared(problem, solution)
    }

    /// Puts u = W r + u_free with twice the digits in place of that of an answer, where rounding hides too much of a sum in a double;
    /// whether it does.
    ///
    /// # Errors
    /// As [`Judge::judge`].
    pub fn sharpen(&mut self, problem: &ContactProblem, solution: &mut Solution) -> Result<bool> {
        self.judge(problem, solution)?;
        let is_sharp = self.scales.is_sharp();
        if is_sharp {
            let u = self.velocities(problem, solution);
            solution.velocity = DVector::from_iterator(u.len(), u);
        }
        Ok(is_sharp)
    }

    /// [`Judge::judge`], which does not judge again what was judged last in this thread: the same problem, the same r and the same u.
    ///
    /// # Errors
    /// As [`Judge::judge`].
    pub fn judge_once(&mut self, problem: &ContactProblem, solution: &Solution) -> Result<Judged> {
        remembered::recall(problem, solution).map_or_else(|| self.judge(problem, solution), Ok)
    }

    /// [`Judge::look`] at another answer to the problem that was prepared last.
    pub(crate) fn judge_prepared(&mut self, problem: &ContactProblem, solution: &Solution) -> Result<Judged> {
        let judged = self.judge_unheld(problem, solution, Unheld::default())?;
        if self.thoroughly || problem.known_overreach().is_some() {
            remembered::remember(problem, solution, judged);
        }
        Ok(judged)
    }

    /// [`Judge::judge`] of contacts whose given velocities are what joints leave of others.
    pub(super) fn judge_held(&mut self, problem: &ContactProblem, solution: &Solution, unheld: Unheld) -> Result<Judged> {
        self.scales.prepare(problem);
        self.thoroughly(|judge| judge.judge_unheld(problem, solution, unheld))
    }

    /// [`Judge::judge`], which shows every residual: its contact, its place in [`Judged::entries`], and the residual. A contact that is
    /// plainly open has none.
    pub(super) fn judge_seen(
        &mut self,
        problem: &ContactProblem,
        solution: &Solution,
        mut see: impl FnMut(usize, usize, Part),
    ) -> Result<Judged> {
        self.scales.prepare(problem);
        let judged = self.thoroughly(|judge| {
            judge.judge_unheld(problem, solution, Unheld::default())?;
            judge.judge_again(problem, solution, None, &mut see)
        })?;
        self.each_stored(problem, solution, |contact, at, value, floor| {
            see(contact, 5, Part { value, scale: self.scales.velocities(contact)[at.min(1)], floor });
        });
        Ok(judged)
    }

    fn thoroughly(&mut self, judge: impl FnOnce(&mut Self) -> Result<Judged>) -> Result<Judged> {
        self.thoroughly = true;
        let judged = judge(self);
        self.thoroughly = false;
        judged
    }

    fn judge_unheld(&mut self, problem: &ContactProblem, solution: &Solution, unheld: Unheld) -> Result<Judged> {
        let impulse = solution.impulse.as_slice();
        self.scales.set_floors(problem, impulse);
        self.scales.set_unheld(unheld);
        self.set_law_velocity(problem, impulse);
        self.is_doubtful = false;
        let mut judged = self.judge_again(problem, solution, unheld.joints, &mut |_, _, _| {})?;
        self.is_doubtful |= unheld.joints.map_or_else(|| self.scales.is_made_doubtful(problem), Joints::is_anything_doubtful);
        if self.is_doubtful {
            self.scales.sharpen(problem, impulse, unheld.joints, &mut self.law_velocity);
            judged = self.judge_again(problem, solution, unheld.joints, &mut |_, _, _| {})?;
        }
        self.each_stored(problem, solution, |contact, at, value, floor| {
            if !judged.velocity.ignores(value, floor) {
                judged.velocity.take(contact, Part { value, scale: self.scales.velocities(contact)[at.min(1)], floor });
            }
        });
        Ok(judged)
    }

    /// The contacts at y and floors as they are, without the stored u; shows their residuals.
    fn judge_again(
        &mut self,
        problem: &ContactProblem,
        solution: &Solution,
        joints: Option<&Joints>,
        see: &mut impl FnMut(usize, usize, Part),
    ) -> Result<Judged> {
        let law_velocity = std::mem::take(&mut self.law_velocity);
        let judged = self.contacts(problem, solution, &law_velocity, joints, see);
        self.law_velocity = law_velocity;
        judged
    }

    /// ρ_n and ρ_t of every contact \[kg\].
    pub(crate) fn weights(problem: &ContactProblem) -> &[[f64; 2]] {
        &problem.weights(scales::weigh).weights
    }

    /// Weights and groups of a problem that is then measured at many answers.
    pub(crate) fn prepare(&mut self, problem: &ContactProblem) {
        self.scales.prepare(problem);
    }

    /// The floors for [`Judge::measure`]: the rounding of y at these impulses.
    pub(crate) fn set_floors(&mut self, problem: &ContactProblem, impulse: &[f64]) {
        self.scales.set_floors(problem, impulse);
    }

    /// The largest relative size over the contacts at r and y, without the stored velocity; β and σ are recovered from r and y.
    pub(crate) fn measure(&mut self, problem: &ContactProblem, solution: &Solution, law_velocity: &[f64]) -> Result<f64> {
        Ok(self.contacts(problem, solution, law_velocity, None, &mut |_, _, _| {})?.relative())
    }

    fn set_law_velocity(&mut self, problem: &ContactProblem, impulse: &[f64]) {
        let y = &mut self.law_velocity;
        y.clear();
        y.extend(problem.free_velocity().as_slice().iter().zip(problem.shift().as_slice()).map(|(free, shift)| free + shift));
        problem.delassus().of_contacts().add_product(impulse, y);
        let softness = problem.row_compliances();
        let soft = |row: usize| softness.map_or(0.0, |softness| softness[row]);
        y.iter_mut().zip(impulse).enumerate().for_each(|(row, (y, r))| *y += soft(row) * r);
    }

    fn contacts(
        &mut self,
        problem: &ContactProblem,
        solution: &Solution,
        law_velocity: &[f64],
        joints: Option<&Joints>,
        see: &mut impl FnMut(usize, usize, Part),
    ) -> Result<Judged> {
        match problem.rows_per_contact() {
            1 => self.contacts_of::<1>(problem, solution, law_velocity, joints, see),
            2 => self.contacts_of::<2>(problem, solution, law_velocity, joints, see),
            _ => self.contacts_of::<3>(problem, solution, law_velocity, joints, see),
        }
    }

    /// [`Judge::contacts`] of this many rows each.
    fn contacts_of<const ROWS: usize>(
        &mut self,
        problem: &ContactProblem,
        solution: &Solution,
        law_velocity: &[f64],
        joints: Option<&Joints>,
        see: &mut impl FnMut(usize, usize, Part),
    ) -> Result<Judged> {
        let (law, impulse) = (problem.law(), solution.impulse.as_slice());
        self.scales.set_sizes(problem, impulse, law_velocity);
        let mut judged = Judged { loaded: self.scales.loaded(impulse), ..Default::default() };
        let reach = Reach::new(problem, &self.scales, [impulse, law_velocity], joints, self.thoroughly);
        let [impulses, velocities, floors] = [impulse, law_velocity, &self.scales.floors[..]].map(|numbers| numbers.as_chunks::<ROWS>().0);
        let answer = impulses.iter().zip(velocities).zip(floors).zip(problem.friction());
        let has_parts = solution.beta.is_some() || solution.sigma.is_some();
        // nearly all contacts have one μ
        let mut cone = (f64::NAN, f64::NAN);
        for (k, (((r, y), floors), friction)) in answer.enumerate() {
            let is_open = matches!(law, Law::Frictionless | Law::Coulomb) && !has_parts && opens(r, y);
            if k > 0 && is_open && self.scales.is_certain(k, floors) {
                continue;
            }
            let is_plainly_open = is_open && y[0] >= floors[0] && floors.iter().all(|floor| floor.is_finite());
            let Held { weights, sizes, most, impulse, floors, uncertain } = self.scales.held(k, floors);
            self.is_doubtful |= uncertain.is_some();
            // whatever is rounded of its velocity, it is no less than zero
            let uncertain = uncertain.filter(|_| !is_plainly_open);
            if cone.0 != *friction {
                cone = (*friction, 1.0 / length(law.cone_friction(*friction), 1.0));
            }
            let (contact, friction, steepness) = (k, *friction, cone.1);
            let here = Here { contact, friction, steepness, r, y, weights, sizes, impulse, floors, most, reach: reach.as_ref() };
            let at = match law {
                Law::PolyhedralCoulomb { directions } => polyhedral::stewart_trinkle(&mut self.pairs, solution, directions, &here),
                Law::PolyhedralAssociated { directions } => polyhedral::edges(&mut self.pairs, problem, solution, directions, &here)?,
                law if has_parts => second_order(law, [r, y], &here).worse(parts_in_plane(&mut self.pairs, problem, solution, &here)?),
                law => second_order(law, [r, y], &here),
            };
            judged.missed = worst(judged.missed, self.scales.missed(k, [&at.dual, &at.normal, &at.tangential]));
            judged.take(k, AtContact { dual: uncertain.map_or(at.dual, |part| at.dual.worse(part)), ..at }, see);
        }
        Ok(judged)
    }

    /// Shows what is left of the stored u, |u − (W r + u_free)|, with its rounding: contact, row of the contact, residual, rounding.
    fn each_stored(&self, problem: &ContactProblem, solution: &Solution, mut show: impl FnMut(usize, usize, f64, f64)) {
        let rows = problem.rows_per_contact();
        let answer = solution.velocity.as_slice().iter().zip(self.velocities(problem, solution)).zip(self.scales.of_stored());
        let (mut contact, mut at) = (0, 0);
        for ((stored, found), floor) in answer {
            show(contact, at, (stored - found).abs(), *floor);
            (contact, at) = if at + 1 == rows { (contact + 1, 0) } else { (contact, at + 1) };
        }
    }

    /// u = y − shift − R r of what was judged last.
    fn velocities<'a>(&'a self, problem: &'a ContactProblem, solution: &'a Solution) -> impl ExactSizeIterator<Item = f64> + 'a {
        let softness = problem.row_compliances();
        let soft = move |row: usize| softness.map_or(0.0, |softness| softness[row]);
        let answer = self.law_velocity.iter().zip(problem.shift().as_slice()).zip(solution.impulse.as_slice());
        answer.enumerate().map(move |(row, ((y, shift), r))| y - shift - soft(row) * r)
    }
}

/// Whether a contact without an impulse opens. Where its rounding is known, and small or less than its velocity, all its residuals are 0;
/// those of the first contact are taken in any case, for their limits.
fn opens<const ROWS: usize>(r: &[f64; ROWS], y: &[f64; ROWS]) -> bool {
    r.iter().all(|r| *r == 0.0) && y[0] >= 0.0 && y.iter().all(|y| y.is_finite())
}

/// The residuals of β and σ, or of edge impulses, that an answer under a law with a second-order cone gives: in the plane each is a
/// polyhedral law with two directions.
fn parts_in_plane(pairs: &mut Pairs, problem: &ContactProblem, solution: &Solution, here: &Here) -> Result<AtContact> {
    match problem.law() {
        Law::Associated => polyhedral::edges(pairs, problem, solution, 2, here),
        _ => Ok(polyhedral::stewart_trinkle_beside(pairs, solution, 2, here, true)),
    }
}

/// The residuals of one contact at r and y under a law with a second-order cone.
fn second_order<const ROWS: usize>(law: Law, [r, y]: [&[f64; ROWS]; 2], here: &Here) -> AtContact {
    let mu = law.cone_friction(here.friction);
    let ([rho, _], [s_n, _, _], [floor_n, floor_t]) = (here.weights, here.sizes, here.floors);
    let (slip, pushed) = (tangential_norm(y), tangential_norm(r));
    let (radius, scaled) = (mu * at_least(0.0, r[0]), here.friction_scale(mu));
    let (w, floor) = if law == Law::Associated { (y[0] - mu * slip, floor_n + mu * floor_t) } else { (y[0], floor_n) };
    let velocity = Part { value: w.abs(), scale: s_n / rho, floor };
    let [s_i, rounding] = here.impulse;
    let (scale, rounded) = if r[0] < 0.0 { (s_i, rounding) } else { (scaled, PROJECTED * radius) };
    let outside = Part { value: distance_of([r[0], pushed], mu), scale, floor: rounded };
    let loss = radius * slip + r[1..].iter().zip(&y[1..]).map(|(r, y)| r * y).sum::<f64>();
    let rubbing = (scaled * slip).max(scaled.max(radius) * here.sizes[2] / here.weights[1]);
    let sliding = Part { value: loss.abs(), scale: rubbing, floor: 0.0 };
    let rounded = Part { floor: (radius + pushed) * floor_t + PROJECTED * radius * slip, ..sliding };
    let penetrating = Part { value: at_least(0.0, -w), ..velocity };
    let pressing = (s_n * w.abs()).max(s_n.max(r[0].abs()) * s_n / rho);
    let product = Part { value: (r[0] * w).abs(), scale: pressing, floor: r[0].abs() * floor };
    let pushing = Part { value: r[0].abs(), scale: s_i, floor: rounding };
    let counts_as_none = r[0] < 0.0 || (w > floor && velocity.times(rho).exceeds(&pushing));
    let reach = if counts_as_none { here.reach(|| in_space(r), true) } else { Part::default() };
    AtContact {
        primal: outside,
        dual: nan_kept(penetrating, w).times(here.steepness),
        complementarity: product.worse(if law == Law::Frictionless { Part::default() } else { rounded }),
        normal: pair([r[0], w], pushing.worse(reach), velocity.times(rho)),
        tangential: friction(mu, [r, y], here).worse(if law == Law::Associated { lifted(mu, [r, y], here) } else { Part::default() }),
    }
}

/// What lets y_n = μ‖y_t‖ be where r_t − ρ_t y_t is inside of the disk: the least of y_n, the way of r_t to the edge, and r.
fn lifted<const ROWS: usize>(mu: f64, [r, y]: [&[f64; ROWS]; 2], here: &Here) -> Part {
    let ([rho_n, rho_t], [floor_n, _]) = (here.weights, here.floors);
    let (pushed, radius) = (tangential_norm(r), mu * at_least(0.0, r[0]));
    let left: [f64; ROWS] = std::array::from_fn(|row| r[row] - rho_t * y[row]);
    if mu == 0.0 || tangential_norm(&left) > radius {
        return Part::default();
    }
    let lift = Part { value: rho_n * at_least(0.0, y[0]), scale: here.sizes[0], floor: rho_n * floor_n };
    let to_edge = Part { value: radius - pushed, scale: here.friction_scale(mu), floor: PROJECTED * radius };
    let none = Part { value: length(pushed, r[0]), scale: here.impulse[0], floor: here.impulse[1] };
    lift.better(to_edge).better(none.worse(here.reach(|| in_space(r), true)))
}

/// max(−x, 0) hides a NaN; this brings it back.
fn nan_kept(part: Part, from: f64) -> Part {
    if from.is_nan() { Part { value: f64::NAN, ..part } } else { part }
}

/// ‖r_t − P_disk(r_t − ρ_t y_t)‖ with its scale and its rounding.
fn friction<const ROWS: usize>(mu: f64, [r, y]: [&[f64; ROWS]; 2], here: &Here) -> Part {
    let rho = here.weights[1];
    let radius = mu * at_least(0.0, r[0]);
    let mut z = [0.0; 2];
    z.iter_mut().zip(r[1..].iter().zip(&y[1..])).for_each(|(z, (r, y))| *z = r - rho * y);
    let reach = length(z[0], z[1]);
    let floor = rho * here.floors[1];
    let left = |factor: f64, k: usize| r.get(k + 1).map_or(0.0, |r| r - factor * z[k]);
    let off = |factor: f64| length(left(factor, 0), left(factor, 1));
    if reach <= radius && mu > 0.0 {
        return Part { value: off(1.0), scale: here.sizes[2], floor }.worse(outside(radius, r, here));
    }
    let angle = if radius > 0.0 { (2.0 * radius / reach).min(1.0) } else { 0.0 };
    let (scale, factor) = (here.friction_scale(mu), if radius > 0.0 { radius / reach } else { 0.0 });
    let part = Part { value: off(factor), scale, floor: floor * angle + PROJECTED * radius };
    // where only rounding tells the direction of the slip, friction along it is none that is missing
    let is_told = part.value > part.floor;
    part.worse(if is_told { here.reach(|| [0.0, left(factor, 0), left(factor, 1)], false) } else { outside(radius, r, here) })
}

/// How far that reaches what is outside of the disk of this radius.
fn outside<const ROWS: usize>(radius: f64, r: &[f64; ROWS], here: &Here) -> Part {
    let pushed = if here.reach.is_some() { tangential_norm(r) } else { 0.0 };
    let beyond = if pushed > radius { (pushed - radius) / pushed } else { 0.0 };
    let [_, first, second] = in_space(r);
    if beyond > 0.0 { here.reach(|| [0.0, beyond * first, beyond * second], false) } else { Part::default() }
}

/// The sizes of an answer against those of its problem, and whether its law has what it gives.
///
/// # Errors
/// [`Error::Invalid`] names the field that does not fit.
pub(super) fn check_sizes(problem: &ContactProblem, solution: &Solution) -> Result<()> {
    problem.require_size("impulse", solution.impulse.len())?;
    problem.require_size("velocity", solution.velocity.len())?;
    // in the plane every cone is polyhedral, with the two senses of tangent₁ as directions
    let is_planar = problem.rows_per_contact() == 2;
    let (d, has_slip) = match problem.law() {
        Law::PolyhedralCoulomb { directions } => (directions, true),
        Law::PolyhedralAssociated { directions } => (directions, false),
        Law::Coulomb if is_planar => (2, true),
        Law::Associated if is_planar => (2, false),
        _ => (0, false),
    };
    let (contacts, law) = (problem.contacts(), problem.law().name());
    let given = [
        ("beta", solution.beta.as_ref().map(|beta| beta.len()), d),
        ("sigma", solution.sigma.as_ref().map(|sigma| sigma.len()), usize::from(has_slip)),
    ];
    for (field, size, each) in given {
        match size {
            Some(_) if each == 0 => {
                let what = format!("is given, and the law `{law}` of contacts of {} has none", counted(problem.rows_per_contact(), "row"));
                return Err(Error::invalid(field, what, "leave it out"));
            }
            Some(size) if size != each * contacts => {
                let cure = format!("give size {}, for {}", each * contacts, counted(contacts, "contact"));
                return Err(Error::invalid(field, format!("has size {size}"), cure));
            }
            _ => {}
        }
    }
    Ok(())
}

#[cfg(test)]
#[path = "rounding_tests.rs"]
mod rounding_tests;
