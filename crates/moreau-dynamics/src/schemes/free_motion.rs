//! The motion of a step without contact: M̂ and v_free.

use crate::mechanics::{Mechanism, State};
use moreau_contact::contact::delassus::MassFactor;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// M̂ and v_free of the module's equation.
pub(super) fn free_motion(theta: f64, mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<(DMatrix<f64>, DVector<f64>)> {
    let mut mass = mechanism.mass_matrix(&state.position);
    let mut force = mechanism.mean_force(&state.position, &state.velocity, h);
    if let Some(linear) = mechanism.linear_force() {
        mass += &linear.damping * (h * theta) + &linear.stiffness * (h * h * theta * theta);
        force -= &linear.stiffness * &state.velocity * (h * theta);
    }
    let velocity = &state.velocity + MassFactor::new(&mass)?.solve(&force) * h;
    if velocity.iter().any(|x| !x.is_finite()) {
        return Err(Error::invalid("force", "is not finite", "every force and velocity must be a finite number"));
    }
    Ok((mass, velocity))
}

/// v + h M⁻¹F, the velocity without contact and with all forces explicit \[m/s\].
///
/// # Errors
/// If h is not positive, the state does not fit the mechanism or M is not positive definite.
pub fn forecast(mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<DVector<f64>> {
    check_input(mechanism, state, h)?;
    Ok(free_motion(0.0, mechanism, state, h)?.1)
}

/// Refuses a step, masses or a state that cannot be meant.
///
/// # Errors
/// [`Error::Invalid`] names the field.
pub fn check_input(mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<()> {
    if !(h.is_finite() && h > 0.0) {
        return Err(Error::invalid("time_step", format!("is {h}"), "use a positive number of seconds"));
    }
    if state.velocity.len() != mechanism.degrees_of_freedom() {
        let problem = format!("has {} entries", state.velocity.len());
        return Err(Error::invalid("velocity", problem, format!("{} has {}", mechanism.name(), mechanism.degrees_of_freedom())));
    }
    mechanism.check_speed(&state.velocity, h)
}
