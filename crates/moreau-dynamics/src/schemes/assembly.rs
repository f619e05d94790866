//! The assembly every scheme shares: M̂, v_free, H of the active contacts and the problem W, u_free, shift.
//!
//! ```text
//!     M̂ = M(q) + h θ C + h² θ² K ,      v_free = v + h M̂⁻¹ (F(q, v) − h θ K v) .
//! ```
//! Why F is explicit and its linear part is not: [`super::moreau_jean`].

use super::{StepContext, StepProblem};
use moreau_contact::contact::{Components, Contact, Jacobian, pairs};
use moreau_contact::memory::spare::{self, Lent};
use moreau_contact::problem::{ContactProblem, Law};
use moreau_exact::Result;
use std::fmt::Write;
use std::sync::Arc;

/// Characters of a time of a simulation, with what stands around it.
const LENGTH_OF_TIME: usize = 32;

/// One contact candidate with the velocities a scheme may decide by.
pub struct Candidate<'a> {
    /// φ, H, μ and e at the start of the step.
    pub contact: &'a Contact,
    /// u = H v at the start of the step \[m/s\].
    pub velocity: Components,
    /// H v_free \[m/s\].
    pub free_velocity: Components,
}

/// What distinguishes one scheme from another in the assembly.
pub trait Rules {
    /// θ of the linear forces; explicit unless told otherwise.
    fn theta(&self) -> f64 {
        0.0
    }
    /// Whether the step holds this contact; every one unless told otherwise.
    fn is_active(&self, candidate: &Candidate, h: f64) -> bool {
        let _ = (candidate, h);
        true
    }
    /// What the law adds to u, one entry per row \[m/s\].
    fn shift(&self, candidate: &Candidate, h: f64) -> Components;
    /// The contact law for contacts with this many rows.
    fn law(&self, rows_per_contact: usize) -> Law;
}

/// Assembles a step by the rules of a scheme.
///
/// # Errors
/// If M̂ is not positive definite.
pub fn assemble(name: &str, rules: &dyn Rules, at: &StepContext) -> Result<StepProblem> {
    let (held, velocities) = chosen(at, rules.theta(), |candidate| rules.is_active(candidate, at.h()))?;
    if held.active.is_empty() {
        return Ok(held);
    }
    let rows = at.mechanism().rows_per_contact();
    let mut shift = spare::zeros(rows * held.active.len());
    for (candidate, part) in candidates(at, &held.active, &velocities).zip(shift.as_mut_slice().chunks_exact_mut(rows)) {
        part.copy_from_slice(&rules.shift(&candidate, at.h()));
    }
    let friction = held.active.iter().map(|k| at.contacts()[*k].friction);
    // H v_free is known, contact by contact
    let mut free_velocity = spare::vector(rows * held.active.len());
    velocities.iter().for_each(|[_, free]| free_velocity.extend_from_slice(free));
    let problem = ContactProblem::from_free_velocity(&held.effective_mass, &held.jacobian, free_velocity.into())
        .name(problem_name(at, name))
        .law(rules.law(rows))
        .rows_per_contact(rows)
        .friction(spare::collected(held.active.len(), friction))
        .shift(shift)
        .bodies(pairs(&held.places))
        .build()?;
    Ok(StepProblem { problem: Some(problem), ..held })
}

/// What messages call the problem of a step, in memory that is large enough from the start.
fn problem_name(at: &StepContext, scheme: &str) -> String {
    let mechanism = at.mechanism().name();
    let mut name = spare::empty_text(mechanism.len() + scheme.len() + LENGTH_OF_TIME);
    // a string takes whatever is written
    let _ = write!(name, "{mechanism} {scheme} t={}", at.state().time);
    name
}

/// M̂, v_free and H of the contacts that a step holds, without a problem; and these contacts.
///
/// # Errors
/// If M̂ is not positive definite.
pub fn held<'a>(at: &'a StepContext, theta: f64, is_active: impl Fn(&Candidate) -> bool) -> Result<(StepProblem, Vec<Candidate<'a>>)> {
    let (held, velocities) = chosen(at, theta, is_active)?;
    let candidates = candidates(at, &held.active, &velocities).collect();
    Ok((held, candidates))
}

/// The velocities of a candidate, as in [`Candidate`].
type Velocities = [Components; 2];

/// The contacts with these indices.
fn candidates<'a>(at: &'a StepContext, active: &[usize], velocities: &[Velocities]) -> impl Iterator<Item = Candidate<'a>> {
    let one = |(k, [velocity, free_velocity]): (&usize, &Velocities)| Candidate {
        contact: &at.contacts()[*k],
        velocity: *velocity,
        free_velocity: *free_velocity,
    };
    active.iter().zip(velocities).map(one)
}

/// [`held`], with the velocities of the contacts in place of candidates.
fn chosen(at: &StepContext, theta: f64, is_active: impl Fn(&Candidate) -> bool) -> Result<(StepProblem, Lent<Vec<Velocities>>)> {
    let (effective_mass, free_velocity) = at.free_motion(theta)?;
    let (rows, columns) = (at.mechanism().rows_per_contact(), at.mechanism().degrees_of_freedom());
    let all = at.contacts().len();
    let (mut active, mut velocities) = (spare::vector(all), Lent::from(spare::vector(all)));
    for (index, contact) in at.contacts().iter().enumerate() {
        let [mut velocity, mut free] = [Components::zeros(rows); 2];
        contact.jacobian.add_products([at.state().velocity.as_slice(), free_velocity.as_slice()], [&mut velocity, &mut free]);
        let candidate = Candidate { contact, velocity, free_velocity: free };
        if is_active(&candidate) {
            active.push(index);
            velocities.push([velocity, free]);
        }
    }
    let jacobian = stack(active.iter().map(|k| &at.contacts()[*k]), rows, columns);
    let places = spare::collected(active.len(), active.iter().map(|k| at.contacts()[*k].place));
    Ok((StepProblem { problem: None, active, places, effective_mass, free_velocity, jacobian, residual: None, rejected: None }, velocities))
}

/// H of these contacts, one below the other.
pub fn stack<'a>(contacts: impl Iterator<Item = &'a Contact>, rows: usize, columns: usize) -> Arc<Jacobian> {
    let count = contacts.size_hint().0;
    spare::shared(Jacobian::new(rows, columns, spare::collected(count, contacts.map(|contact| contact.jacobian.clone()))))
}

/// The given normal entry, and zero in the tangential rows.
pub fn normal_only(normal: f64, rows: usize) -> Components {
    let mut components = Components::zeros(rows);
    components[0] = normal;
    components
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{OscillatorWithStop, Plane, PointMass, State};
    use crate::schemes::{Activation, MoreauJean, RestitutionRule, Waist};
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
        let step = scheme.assemble(&StepContext::new(&corner, &state, 0.1).expect("valid")).expect("valid");
        let problem = step.problem.expect("one contact");
        assert_eq!((step.active, problem.friction()), (vec![1], &[0.7][..]));
        assert_eq!(problem.shift(), &dvector![0.5 * -2.0, 0.0]);
        assert_eq!(problem.free_velocity(), &dvector![-3.0, 0.0]);
    }

    #[test]
    fn the_delassus_operator_is_that_of_the_effective_mass() {
        // M̂ = m + θ h c + θ² h² k = 2 + 0.05 + 0.125 with θ = ½, h = ½, c = 0.2, k = 2.
        let stop = OscillatorWithStop::new(2.0, 2.0, 0.2, 0.0, 0.0).expect("valid");
        let state = State { time: 0.0, position: dvector![-0.1], velocity: dvector![-1.0] };
        let scheme = MoreauJean { theta: 0.5, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
        let step = scheme.assemble(&StepContext::new(&stop, &state, 0.5).expect("valid")).expect("valid");
        let problem = step.problem.expect("the stop is penetrated");
        assert!((step.effective_mass.matrix()[(0, 0)] - 2.175).abs() <= rounding(4, 2.0));
        assert!((problem.entry(0, 0) - 1.0 / 2.175).abs() <= rounding(4, 1.0));
    }
}
