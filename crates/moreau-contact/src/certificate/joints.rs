//! How good an answer with joints is: the residuals of its contacts and limits, and how fast its bilateral constraints move.
//!
//! ```text
//!     bilateral   ‖y_k‖ ,   y = W r + u_free + shift + R r                                            [m/s]
//!     scale       max( ‖q_k‖ ,  ‖(W r_u)_k‖ up to 10³ V ,  ‖W_kk r_k‖ up to V )                        [m/s]
//!     floor       ‖γ (Σ_j |W_kj||r_j| + |u_free| + |shift| + R|r|)_k‖                                  [m/s]
//! ```
//! q = u_free + shift, V is its largest entry at the joints and closed contacts that W joins with the constraint, and r_u are the
//! impulses of contacts and limits: the size of a joint's velocity is what it would have without it, what contacts make of it, and what
//! its own impulse does, the last up to V: impulses of joints that push against each other and move nothing excuse no velocity.
//!
//! Contacts and limits are judged as in a problem without joints, in which the impulses of the joints are given: u_free + W r_b in place of
//! u_free, and the rounding of that product in the floors. Their scales have q, too, what they would do without the joints: a contact that
//! joints hold fast has no other velocity. Nothing here is eliminated: the answer is held against W as it was given.
//!
//! Where the W of all rows is not shown to be one of bodies, an impulse of a contact that counts as none may move no joint either.

use super::joint_scales::Joints;
use super::judged::{Judged, Worst};
use super::residuals::{Residuals, of_held};
use super::scales::Unheld;
use crate::problem::{JointedProblem, Solution};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// The residuals of an answer to a problem with joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointedResiduals {
    /// Those of contacts and limits, and the stored velocity of all rows; their numbers are those of the problem's `kinds`.
    pub contacts: Residuals,
    /// The bilateral constraint that moves most, relative to its scale \[m/s\]; none where there is no such constraint.
    pub bilateral: Option<Worst>,
}

impl JointedResiduals {
    /// Whether every residual is at most max(`tolerance` · scale, rounding) at every constraint.
    pub fn is_solution(&self, tolerance: f64) -> bool {
        self.contacts.is_solution(tolerance) && self.bilateral.is_none_or(|worst| worst.part.relative() <= tolerance)
    }

    /// The largest relative size; not a number if one is not.
    pub fn relative(&self) -> f64 {
        let joints = self.bilateral.map_or(0.0, |worst| worst.part.relative());
        moreau_exact::number::larger(self.contacts.judged.relative(), joints)
    }
}

/// The residuals of `solution`, impulses and velocities of all rows, as an answer to `problem`.
///
/// # Errors
/// [`Error::Invalid`] if the solution has another size than the problem, or gives numbers of a polyhedral law, which are not judged here,
/// or if its impulses or W r are no finite numbers.
pub fn jointed_residuals(problem: &JointedProblem, solution: &Solution) -> Result<JointedResiduals> {
    problem.require_rows("impulse", solution.impulse.len())?;
    problem.require_rows("velocity", solution.velocity.len())?;
    if solution.beta.is_some() || solution.sigma.is_some() {
        let field = if solution.beta.is_some() { "beta" } else { "sigma" };
        return Err(Error::invalid(field, "is given with an answer of a problem with `kinds`", "leave `beta` and `sigma` out"));
    }
    let impulse = &solution.impulse;
    if let Some(row) = problem.velocity(impulse).iter().position(|u| !u.is_finite()) {
        let found = format!("makes the velocity of row {row} too large for a number, or is none itself");
        return Err(Error::invalid("impulse", found, "give finite impulses, in units of their size"));
    }
    let joints = Joints::new(problem, impulse);
    let mut contacts = of_contacts(problem, solution, &joints)?;
    let (law_velocity, stored) = (law_velocity(problem, impulse), &solution.velocity);
    let found = problem.velocity(impulse);
    let mut bilateral: Option<Worst> = None;
    for k in problem.bilateral() {
        let part = joints.velocity(k, &law_velocity);
        bilateral.get_or_insert(Worst { part, contact: k, largest: part.value }).take(k, part);
        contacts.judged.velocity.take(k, joints.stored(k, [stored, &found]));
    }
    contacts.velocity = contacts.judged.velocity.largest;
    Ok(JointedResiduals { contacts, bilateral })
}

/// Puts u = W r + u_free with twice the digits in place of that of an answer, where rounding hides too much of a sum in a double; whether
/// it does.
///
/// # Errors
/// [`Error::Invalid`] if the answer has another size than the problem.
pub fn sharpen(problem: &JointedProblem, solution: &mut Solution) -> Result<bool> {
    problem.require_rows("impulse", solution.impulse.len())?;
    let joints = Joints::new(problem, &solution.impulse);
    let soft = problem.softnesses().component_mul(&solution.impulse);
    let sharp = joints.sharp_velocity().map(|y| y - problem.shifts() - soft);
    let is_sharp = sharp.is_some();
    sharp.into_iter().for_each(|u| solution.velocity = u);
    Ok(is_sharp)
}

/// Contacts and limits with the impulses of the joints given.
fn of_contacts(problem: &JointedProblem, solution: &Solution, joints: &Joints) -> Result<Residuals> {
    let mut held = DVector::zeros(problem.rows());
    problem.bilateral().into_iter().flat_map(|k| problem.rows_of(k)).for_each(|row| held[row] = solution.impulse[row]);
    let moved = problem.delassus() * &held;
    // nothing is added to u_free, and nothing rounds, where the joints move nothing
    let given = problem.free_velocity().zip_map(&moved, |free, moved| if moved == 0.0 { 0.0 } else { free.abs() });
    let rounding = joints.rounding(&held, given);
    let given = problem.unilateral(problem.delassus(), &(problem.free_velocity() + moved))?;
    let data = problem.free_velocity() + problem.shifts();
    let [impulse, velocity] = [&solution.impulse, &solution.velocity].map(|all| problem.spread(all));
    let pushing = problem.pushing();
    let fastest: Vec<f64> = pushing.iter().map(|k| joints.fastest(*k)).collect();
    let (rounding, unheld) = (problem.spread(&rounding), problem.spread(&data));
    let unheld = Unheld { rounding: rounding.as_slice(), data: unheld.as_slice(), fastest: &fastest, joints: Some(joints) };
    let mut residuals = of_held(&given, &Solution { impulse, velocity, ..solution.clone() }, unheld)?;
    // what the joints hold is no velocity that was given
    let asked = |(k, fastest): (&usize, &f64)| {
        let row = problem.rows_of(*k).start;
        if *fastest > 0.0 { solution.impulse[row].abs() * problem.delassus()[(row, row)] / fastest } else { 0.0 }
    };
    residuals.judged.loaded = pushing.iter().zip(&fastest).map(asked).fold(residuals.judged.loaded, f64::max);
    let Judged { primal, dual, complementarity, normal, tangential, velocity, .. } = &mut residuals.judged;
    for worst in [primal, dual, complementarity, normal, tangential, velocity] {
        worst.contact = pushing.get(worst.contact).copied().unwrap_or(0);
    }
    Ok(residuals)
}

fn law_velocity(problem: &JointedProblem, impulse: &DVector<f64>) -> DVector<f64> {
    // q first: what u_free and shift lose in each other is lost exactly
    problem.delassus() * impulse + (problem.free_velocity() + problem.shifts()) + problem.softnesses().component_mul(impulse)
}

#[cfg(test)]
#[path = "joints_tests.rs"]
mod tests;
