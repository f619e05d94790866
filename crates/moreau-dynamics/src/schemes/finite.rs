//! A motion of numbers: a step that leaves them is an error, with its time and the body.

use crate::mechanics::{BodyState, Mechanism, State};
use moreau_exact::number::{are_finite, significant};
use moreau_exact::{Error, Result};

/// Refuses the state after step k if a position, a velocity or the energy is no finite number; k = 0 is the start.
///
/// # Errors
/// [`Error::Solver`] in the name of the scheme.
pub(super) fn finite(scheme: &str, mechanism: &dyn Mechanism, step: usize, state: &State) -> Result<()> {
    let when = || if step == 0 { "at the start".to_string() } else { format!("after step {step}, t = {} s,", significant(state.time)) };
    let refuse = |what: String| {
        Err(Error::breakdown(scheme, format!("{} {what} not finite; use a smaller step, or smaller numbers in the scene", when())))
    };
    let lost = |body: &&BodyState| {
        let rates = body.linear_velocity.iter().chain(&body.angular_velocity);
        !body.position.iter().chain(&body.orientation).chain(rates).all(|x| x.is_finite())
    };
    if !(are_finite(state.position.as_slice()) && are_finite(state.velocity.as_slice())) {
        let bodies = mechanism.bodies(&state.position, &state.velocity);
        let name = bodies.iter().find(lost).map_or_else(|| mechanism.name().to_string(), |body| format!("body `{}`", body.name));
        return refuse(format!("the motion of {name} is"));
    }
    if !mechanism.energy(state).is_finite() { refuse(format!("the energy of {} is", mechanism.name())) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use crate::mechanics::{PointMass, State};
    use crate::schemes::{MoreauJean, simulate};
    use moreau_contact::solvers::Auto;
    use nalgebra::dvector;

    fn message(velocity: f64, gravity: f64, steps: usize) -> String {
        let ball = PointMass::ball_on_floor(2.0, gravity, 0.5);
        let start = State { time: 0.0, position: dvector![1.0], velocity: dvector![velocity] };
        simulate(&MoreauJean::default(), &Auto, &ball, start, 0.5, steps)
            .map(|_| ())
            .map_err(|error| error.to_string())
            .err()
            .unwrap_or_default()
    }

    #[test]
    fn an_energy_that_is_not_finite_is_an_error_with_its_step_and_one_that_is_passes() {
        // m v² = 1.6·10³⁰⁸ is a number, 2·10³¹⁰ is none, though v is
        assert_eq!(message(9e153, 0.0, 3), "");
        assert!(message(1e155, 0.0, 3).contains("at the start the energy"), "{}", message(1e155, 0.0, 3));
        let falls = message(0.0, -1e154, 40);
        assert!(falls.contains("after step 2, t = 1 s,") || falls.contains("after step 3, t = 1.5 s,"), "{falls}");
    }

    #[test]
    fn a_position_that_is_not_a_number_is_an_error_that_names_the_body() {
        assert!(message(f64::NAN, 10.0, 1).contains("body `ball`") || message(f64::NAN, 10.0, 1).contains("not finite"));
    }
}
