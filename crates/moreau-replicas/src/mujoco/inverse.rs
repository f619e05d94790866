//! Inverse dynamics at the level of accelerations: which force τ makes a mechanism accelerate as wanted, contacts included, without a
//! solver.
//!
//! ```text
//!     f = −∇s(H a − a_ref) ,   each contact by itself ,        τ = M a − F(q, v) − Hᵀf .
//! ```
//! Gauss's principle is unconstrained and smooth in a, so that its condition M a = F + τ + Hᵀf(a) can be read backwards: given a, every
//! contact's f follows from its own rows. The forward problem couples them through M; here nothing is solved.
//!
//! **Discrete time.** a is the acceleration at the state, M⁻¹(F + Hᵀf + τ). It is (v⁺ − v)/h only where the integrator adds nothing: Euler
//! without damping. With damping C or implicitfast (v⁺ − v)/h = (M + hC − hG)⁻¹M a, which [`Mujoco::acceleration_of_step`] undoes; no such
//! map exists for RK4.

use crate::mujoco::{Integrator, Mujoco};
use moreau_contact::contact::{Inertia, Place};
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::schemes::StepContext;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// The force of one active contact.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactForce {
    /// Index into [`Mechanism::contacts`].
    pub contact: usize,
    /// (f_n, f_t₁, f_t₂) \[N\], then torques about n, t₁, t₂ \[N·m\] as far as there is such friction.
    pub force: DVector<f64>,
    /// Where it acts.
    pub place: Option<Place>,
}

/// What a wanted acceleration asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct InverseDynamics {
    /// τ, the generalised force to be applied beside those of the mechanism \[N, N·m\].
    pub applied: DVector<f64>,
    /// f of every active contact.
    pub contacts: Vec<ContactForce>,
}

impl Mujoco {
    /// τ and f for an acceleration a at a state; `h` is needed where `refsafe` bounds the time constant by two steps.
    ///
    /// # Errors
    /// If h is not positive, a state or acceleration does not fit the mechanism or the mechanism has no rows for the friction asked for.
    ///
    /// # Source
    /// MuJoCo documentation, *Computation: inverse dynamics* (3.17); Todorov (2014).
    pub fn inverse(&self, mechanism: &dyn Mechanism, state: &State, acceleration: &DVector<f64>, h: f64) -> Result<InverseDynamics> {
        StepContext::new(mechanism, state, h)?;
        if acceleration.len() != state.velocity.len() {
            let problem = format!("has {}", counted(acceleration.len(), "entry"));
            return Err(Error::invalid("acceleration", problem, format!("{} has {}", mechanism.name(), state.velocity.len())));
        }
        let mut applied = mechanism.mass(&state.position).times(acceleration) - mechanism.force(&state.position, &state.velocity);
        let mut contacts = Vec::new();
        for rows in self.soft_rows(mechanism, &state.position, &state.velocity, h)? {
            let violation = &rows.edges * (&rows.jacobian * acceleration) - &rows.reference;
            let mut first = 0;
            let pushes = rows.pieces.iter().flat_map(|piece| {
                let own = piece.impulse(&violation.as_slice()[first..first + piece.rows()]);
                first += piece.rows();
                own
            });
            let pushes = DVector::from_vec(pushes.collect());
            let force = rows.edges.tr_mul(&pushes);
            rows.jacobian.add_transposed((-&force).as_slice(), applied.as_mut_slice());
            contacts.push(ContactForce { contact: rows.index, force, place: rows.place });
        }
        Ok(InverseDynamics { applied, contacts })
    }

    /// a = M⁻¹(M + hC − hG)(v⁺ − v)/h, the acceleration at the state behind a step of Euler or implicitfast.
    ///
    /// # Errors
    /// With RK4, whose step has four accelerations; if M is not positive definite.
    pub fn acceleration_of_step(
        &self,
        mechanism: &dyn Mechanism,
        state: &State,
        velocity_post: &DVector<f64>,
        h: f64,
    ) -> Result<DVector<f64>> {
        StepContext::new(mechanism, state, h)?;
        if self.integrator == Integrator::RungeKutta {
            return Err(Error::Unsupported("a step of RK4 has four accelerations, one in each stage".into()));
        }
        let change = (velocity_post - &state.velocity) / h;
        let force = self.effective_mass(mechanism, state, h).times(&change);
        Ok(Inertia::of(mechanism.mass(&state.position))?.solve(&force))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mujoco::{Cone, Rotational};
    use moreau_contact::solvers::GaussNewton;
    use moreau_contact::tolerance::solvers::STOP;
    use moreau_dynamics::scenes::named;
    use moreau_dynamics::schemes::step;
    use nalgebra::DVector;

    const ROLLING: Rotational = Rotational { torsional: 0.02, rolling: 0.001 };

    /// A block in contact that slides down a slope.
    fn sliding(scheme: &Mujoco) -> (Box<dyn Mechanism>, State) {
        let (mechanism, mut state) = named("incline-slide").and_then(|scene| scene.spatial_mechanism()).expect("built in");
        for _ in 0..60 {
            state = step(scheme, &GaussNewton::default(), mechanism.as_ref(), &state, 0.002).expect("valid").state;
        }
        (mechanism, state)
    }

    #[test]
    fn the_forward_solution_asks_for_no_force_and_another_acceleration_for_one_that_brings_it_about() {
        for cone in [Cone::Elliptic, Cone::Pyramidal] {
            for rotational in [Rotational::NONE, ROLLING] {
                let scheme = Mujoco { rotational, ..Mujoco::standard(cone) };
                let (mechanism, state) = sliding(&scheme);
                let mass = mechanism.mass_matrix(&state.position);
                let force = mechanism.force(&state.position, &state.velocity);
                let solved = |applied: &DVector<f64>| {
                    let total = &force + applied;
                    let pushed = scheme.pushed_with_rotation(mechanism.as_ref(), &state, &total, 0.002).expect("valid");
                    (mass.clone().cholesky().expect("positive").solve(&pushed.force), pushed.impulses)
                };
                let (free, contacts) = solved(&DVector::zeros(6));
                let back = scheme.inverse(mechanism.as_ref(), &state, &free, 0.002).expect("valid");
                // forces are −∇s, whose slope 1/R multiplies what the solver left of the accelerations, some 10 m/s²
                let allowed = 10.0 * STOP * 1e3;
                assert!(back.applied.amax() <= allowed, "{cone:?}: {}", back.applied);
                for (forward, contact) in contacts.iter().zip(&back.contacts) {
                    let force = DVector::from_column_slice(&forward.impulse) / 0.002;
                    assert!((&force - &contact.force).amax() <= allowed, "{force} {}", contact.force);
                }
                let wanted = free + DVector::from_vec(vec![0.3, -0.2, -3.0, 1.0, -2.0, 0.5]);
                let asked = scheme.inverse(mechanism.as_ref(), &state, &wanted, 0.002).expect("valid");
                assert!(asked.applied.norm() > 0.1, "another acceleration needs a force");
                let (reached, _) = solved(&asked.applied);
                assert!((reached - wanted).amax() <= allowed, "{cone:?}");
            }
        }
    }

    #[test]
    fn a_step_of_implicitfast_is_undone_by_its_own_acceleration_and_not_by_the_quotient() {
        let scheme = Mujoco { integrator: Integrator::ImplicitFast, ..Mujoco::standard(Cone::Elliptic) };
        let (mechanism, mut state) = sliding(&scheme);
        state.velocity[3] += 8.0;
        state.velocity[4] -= 5.0;
        let after = step(&scheme, &GaussNewton::default(), mechanism.as_ref(), &state, 0.002).expect("valid").state.velocity;
        let acceleration = scheme.acceleration_of_step(mechanism.as_ref(), &state, &after, 0.002).expect("no stages");
        let left = |a: &DVector<f64>| scheme.inverse(mechanism.as_ref(), &state, a, 0.002).expect("valid").applied.amax();
        // velocities of 1 m/s and 10 rad/s over h are accelerations known to STOP/h, forces by 1/R
        let allowed = 1e3 * STOP / 0.002;
        assert!(left(&acceleration) <= allowed, "{}", left(&acceleration));
        assert!(left(&((after - &state.velocity) / 0.002)) > 1e3 * allowed);
        let stages = Mujoco { integrator: Integrator::RungeKutta, ..scheme };
        assert!(stages.acceleration_of_step(mechanism.as_ref(), &state, &state.velocity, 0.002).is_err());
        assert!(scheme.inverse(mechanism.as_ref(), &state, &DVector::zeros(3), 0.002).is_err());
    }
}
