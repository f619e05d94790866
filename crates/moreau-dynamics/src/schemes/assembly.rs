//! The assembly every scheme shares: M̂, v_free, H of the active contacts and the problem W, u_free, shift.
//!
//! ```text
//!     M̂ = M(q) + h θ C + h² θ² K ,      v_free = v + h M̂⁻¹ (F(q, v) − h θ K v) .
//! ```
//! Why F is explicit and its linear part is not: [`super::moreau_jean`].

use super::StepProblem;
pub(super) use super::free_motion::free_motion;
pub use super::free_motion::{check_input, forecast};
use crate::mechanics::{Mechanism, State};
use moreau_contact::contact::delassus::delassus;
use moreau_contact::contact::{Contact, pairs};
use moreau_contact::problem::{ContactProblem, Dynamics, Law};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// One contact candidate with the velocities a scheme may decide by.
pub struct Candidate<'a> {
    /// φ, H, μ and e at the start of the step.
    pub contact: &'a Contact,
    /// u = H v at the start of the step \[m/s\].
    pub velocity: DVector<f64>,
    /// H v_free \[m/s\].
    pub free_velocity: DVector<f64>,
}

/// What distinguishes one scheme from another in the assembly.
pub trait Rules {
    /// θ of the linear forces.
    fn theta(&self) -> f64;
    /// Whether the step holds this contact.
    fn is_active(&self, candidate: &Candidate, h: f64) -> bool;
    /// What the law adds to u, one entry per row \[m/s\].
    fn shift(&self, candidate: &Candidate, h: f64) -> DVector<f64>;
    /// The contact law for contacts with this many rows.
    fn law(&self, rows_per_contact: usize) -> Law;
}

/// Assembles the step of size h from a state by the rules of a scheme.
///
/// # Errors
/// If h is not positive, the state does not fit the mechanism or M̂ is not positive definite.
pub fn assemble(name: &str, rules: &dyn Rules, mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<StepProblem> {
    check_input(mechanism, state, h)?;
    let (effective_mass, free_velocity) = free_motion(rules.theta(), mechanism, state, h)?;
    let contacts = mechanism.contacts(&state.position);
    let candidates = contacts.iter().map(|contact| Candidate {
        contact,
        velocity: &contact.jacobian * &state.velocity,
        free_velocity: &contact.jacobian * &free_velocity,
    });
    let active: Vec<(usize, Candidate)> = candidates.enumerate().filter(|(_, candidate)| rules.is_active(candidate, h)).collect();
    let rows = mechanism.rows_per_contact();
    let jacobian = stack(active.iter().map(|(_, candidate)| &candidate.contact.jacobian), rows, mechanism.degrees_of_freedom());
    let places: Vec<_> = active.iter().map(|(_, candidate)| candidate.contact.place).collect();
    let problem = if active.is_empty() {
        None
    } else {
        let shifts: Vec<DVector<f64>> = active.iter().map(|(_, candidate)| rules.shift(candidate, h)).collect();
        Some(ContactProblem {
            name: format!("{} {name} t={}", mechanism.name(), state.time),
            rows_per_contact: rows,
            law: rules.law(rows),
            friction: active.iter().map(|(_, candidate)| candidate.contact.friction).collect(),
            free_velocity: &jacobian * &free_velocity,
            shift: DVector::from_iterator(rows * active.len(), shifts.iter().flat_map(|shift| shift.iter().copied())),
            delassus: delassus(&effective_mass, &jacobian)?,
            compliance: None,
            dynamics: Some(Dynamics { mass: effective_mass.clone(), jacobian: jacobian.clone() }),
            bodies: pairs(&places),
        })
    };
    let active = active.iter().map(|(index, _)| *index).collect();
    Ok(StepProblem { problem, active, places, effective_mass, free_velocity, jacobian, residual: None })
}

/// The rows of all contacts, one contact below the other.
pub(super) fn stack<'a>(blocks: impl ExactSizeIterator<Item = &'a DMatrix<f64>>, rows: usize, columns: usize) -> DMatrix<f64> {
    let mut stacked = DMatrix::zeros(rows * blocks.len(), columns);
    for (k, block) in blocks.enumerate() {
        stacked.rows_mut(k * rows, rows).copy_from(block);
    }
    stacked
}

/// A vector with the given normal entry and zero tangential entries.
pub fn normal_only(normal: f64, rows: usize) -> DVector<f64> {
    let mut vector = DVector::zeros(rows);
    vector[0] = normal;
    vector
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{OscillatorWithStop, Plane, PointMass};
    use crate::schemes::{Activation, MoreauJean, RestitutionRule, Scheme};
    use moreau_exact::tolerance::rounding;
    use nalgebra::dvector;

    #[test]
    fn an_active_contact_keeps_its_own_row_friction_and_restitution() {
        let plane = |normal, friction, restitution| Plane::new(normal, 0.0, friction, restitution).expect("a unit normal");
        let planes = vec![plane(dvector![1.0, 0.0], 0.2, 0.25), plane(dvector![0.0, 1.0], 0.7, 0.5)];
        let corner = PointMass::new("corner", 1.0, dvector![0.0, -10.0], planes).expect("valid");
        // At (1, 0) the point touches the second plane only.
        let state = State { time: 0.0, position: dvector![1.0, 0.0], velocity: dvector![0.0, -2.0] };
        let scheme = MoreauJean { theta: 0.5, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
        let step = scheme.assemble(&corner, &state, 0.1).expect("valid");
        let problem = step.problem.expect("one contact");
        assert_eq!((step.active, problem.friction.clone()), (vec![1], vec![0.7]));
        assert_eq!(problem.shift, dvector![0.5 * -2.0, 0.0]);
        assert_eq!(problem.free_velocity, dvector![-3.0, 0.0]);
    }

    #[test]
    fn the_delassus_operator_is_that_of_the_effective_mass() {
        // M̂ = m + θ h c + θ² h² k = 2 + 0.05 + 0.125 with θ = ½, h = ½, c = 0.2, k = 2.
        let stop = OscillatorWithStop::new(2.0, 2.0, 0.2, 0.0, 0.0).expect("valid");
        let state = State { time: 0.0, position: dvector![-0.1], velocity: dvector![-1.0] };
        let scheme = MoreauJean { theta: 0.5, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
        let step = scheme.assemble(&stop, &state, 0.5).expect("valid");
        let problem = step.problem.expect("the stop is penetrated");
        assert!((step.effective_mass[(0, 0)] - 2.175).abs() <= rounding(4, 2.0));
        assert!((problem.delassus[(0, 0)] - 1.0 / 2.175).abs() <= rounding(4, 1.0));
    }
}
