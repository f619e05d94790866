//! Where a step starts, and what is computed once for it: M(q) with its factor, and the contact candidates at q.

use crate::mechanics::{Mechanism, State};
use moreau_contact::contact::{Contact, Inertia};
use moreau_contact::memory::spare::{self, Lent, Spare};
use moreau_exact::number::{are_finite, counted};
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use std::cell::OnceCell;
use std::sync::Arc;

/// A state, the step to take from it, and what several parts of the step ask of it.
pub struct StepContext<'a> {
    mechanism: &'a dyn Mechanism,
    state: &'a State,
    h: f64,
    inertia: OnceCell<Arc<Inertia>>,
    contacts: OnceCell<Lent<Vec<Contact>>>,
    /// v + h M⁻¹F̄.
    explicit: OnceCell<Lent<DVector<f64>>>,
}

impl<'a> StepContext<'a> {
    /// A step of size h from a state.
    ///
    /// # Errors
    /// [`Error::Invalid`] if h is not positive, or the state does not fit the mechanism.
    pub fn new(mechanism: &'a dyn Mechanism, state: &'a State, h: f64) -> Result<Self> {
        check_input(mechanism, state, h)?;
        Ok(StepContext { mechanism, state, h, inertia: OnceCell::new(), contacts: OnceCell::new(), explicit: OnceCell::new() })
    }

    /// What moves.
    pub fn mechanism(&self) -> &'a dyn Mechanism {
        self.mechanism
    }

    /// The state before the step.
    pub fn state(&self) -> &'a State {
        self.state
    }

    /// The size of the step \[s\].
    pub fn h(&self) -> f64 {
        self.h
    }

    /// This step with another view of the same mechanism, for example one with fewer candidates. M(q) and F are not computed again.
    pub(super) fn of<'b>(&self, mechanism: &'b dyn Mechanism) -> StepContext<'b>
    where
        'a: 'b,
    {
        StepContext {
            mechanism,
            state: self.state,
            h: self.h,
            inertia: self.inertia.clone(),
            contacts: OnceCell::new(),
            explicit: self.explicit.clone(),
        }
    }

    /// M(q), factored.
    ///
    /// # Errors
    /// [`Error::Invalid`] if it is not positive definite.
    pub fn inertia(&self) -> Result<Arc<Inertia>> {
        if let Some(known) = self.inertia.get() {
            return Ok(known.clone());
        }
        let factored = spare::shared(Inertia::of(self.mechanism.mass(&self.state.position))?);
        Ok(self.inertia.get_or_init(|| factored).clone())
    }

    /// The contact candidates at q.
    pub fn contacts(&self) -> &[Contact] {
        self.contacts.get_or_init(|| self.mechanism.contacts(&self.state.position).into())
    }

    /// M̂ = M(q) + h θ C + h² θ² K, factored, and v_free = v + h M̂⁻¹ (F(q, v) − h θ K v).
    ///
    /// # Errors
    /// [`Error::Invalid`] if M̂ is not positive definite or v_free is not finite.
    pub fn free_motion(&self, theta: f64) -> Result<(Arc<Inertia>, DVector<f64>)> {
        let Some(linear) = self.mechanism.linear_force().filter(|_| theta != 0.0) else {
            return Ok((self.inertia()?, self.forecast()?.copied()));
        };
        let StepContext { mechanism, state, h, .. } = *self;
        let mut mass = mechanism.mass_matrix(&state.position);
        mass += &linear.damping * (h * theta) + &linear.stiffness * (h * h * theta * theta);
        let inertia = Arc::new(Inertia::new(mass)?);
        let force = mechanism.mean_force(&state.position, &state.velocity, h) - &linear.stiffness * &state.velocity * (h * theta);
        let velocity = moved(&state.velocity, inertia.solved(force), h)?;
        Ok((inertia, velocity))
    }

    /// v + h M⁻¹F, the velocity without contact and with all forces explicit \[m/s\].
    ///
    /// # Errors
    /// Those of [`StepContext::free_motion`].
    pub fn forecast(&self) -> Result<&DVector<f64>> {
        if let Some(known) = self.explicit.get() {
            return Ok(known);
        }
        let StepContext { mechanism, state, h, .. } = *self;
        let pull = self.inertia()?.solved(mechanism.mean_force(&state.position, &state.velocity, h));
        let velocity = moved(&state.velocity, pull, h)?;
        Ok(self.explicit.get_or_init(|| velocity.into()))
    }
}

/// v + h a, if it is made of numbers.
fn moved(velocity: &DVector<f64>, acceleration: DVector<f64>, h: f64) -> Result<DVector<f64>> {
    let mut moved = acceleration;
    moved.as_mut_slice().iter_mut().zip(velocity.as_slice()).for_each(|(a, v)| *a = *a * h + v);
    if !are_finite(moved.as_slice()) {
        return Err(Error::invalid("force", "is not finite", "every force and velocity must be a finite number"));
    }
    Ok(moved)
}

/// Refuses a step size that is not positive, and velocities that the mechanism cannot have.
fn check_input(mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<()> {
    if !(h.is_finite() && h > 0.0) {
        return Err(Error::invalid("time_step", format!("is {h}"), "use a positive number of seconds"));
    }
    if state.velocity.len() != mechanism.degrees_of_freedom() {
        let problem = format!("has {}", counted(state.velocity.len(), "entry"));
        return Err(Error::invalid("velocity", problem, format!("{} has {}", mechanism.name(), mechanism.degrees_of_freedom())));
    }
    mechanism.check_speed(&state.velocity, h)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::PointMass;
    use nalgebra::dvector;

    #[test]
    fn the_mass_is_factored_once_and_the_candidates_are_looked_for_once() {
        let ball = PointMass::ball_on_floor(2.0, 10.0, 0.5);
        let state = State { time: 0.0, position: dvector![1.0], velocity: dvector![0.0] };
        let at = StepContext::new(&ball, &state, 0.5).expect("valid");
        assert!(Arc::ptr_eq(&at.inertia().expect("positive"), &at.free_motion(1.0).expect("finite").0), "no linear force, one M");
        assert!(Arc::ptr_eq(&at.inertia().expect("positive"), &at.of(&ball).inertia().expect("positive")));
        assert!(std::ptr::eq(at.contacts(), at.contacts()));
        assert_eq!(at.forecast().expect("finite"), &dvector![-5.0]);
        assert!(StepContext::new(&ball, &state, 0.0).is_err());
    }
}
