//! The integrators: from the accelerations that Gauss's principle gives to the next state.
//!
//! ```text
//!     F_c(q, v) = F + Hᵀf ,      C damping of joints ,      G = ∂F/∂v of the gyroscopic torques of free bodies
//!     Euler           v⁺ = v + h (M + hC)⁻¹ F_c ,              q⁺ = q ⊕ h v⁺
//!     implicitfast    v⁺ = v + h (M + hC − hG)⁻¹ F_c ,         q⁺ = q ⊕ h v⁺
//!     RK4             v⁺ = v + h/6 (a₁ + 2a₂ + 2a₃ + a₄) ,     q⁺ = q ⊕ h/6 (v₁ + 2v₂ + 2v₃ + v₄) ,    a_i = M⁻¹F_c(q_i, v_i)
//! ```
//! Contact forces have no derivative in any of them. implicitfast leaves out the derivative of centripetal and Coriolis forces, but since
//! MuJoCo 3.11 not that of the gyroscopic torque of a body that moves freely by itself, of which G consists; a linkage has none. Each stage
//! of RK4 finds its contacts anew and poses its own problem.

use crate::mujoco::{Integrator, Mujoco, Rotational};
use moreau_contact::certificate::StepResidual;
use moreau_contact::contact::{ContactImpulse, Mass};
use moreau_contact::solvers::ContactSolver;
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::schemes::assembly::stack;
use moreau_dynamics::schemes::{Inertia, Start, Step, StepContext, StepProblem};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// F + Hᵀf at a state with the contacts' h f.
pub(super) struct Pushed {
    pub force: DVector<f64>,
    pub impulses: Vec<ContactImpulse>,
    /// How well Gauss's program was solved where no solver of the waist did it.
    pub residual: Option<StepResidual>,
}

impl Mujoco {
    /// One step of any integrator, with or without friction against rotation.
    pub(super) fn integrate(&self, solver: &dyn ContactSolver, start: &Start) -> Result<Step> {
        let Start { mechanism, state, h, .. } = *start;
        StepContext::new(mechanism, state, h)?;
        if self.integrator == Integrator::RungeKutta {
            return self.runge_kutta(solver, mechanism, state, h);
        }
        let pushed = self.pushed(solver, mechanism, state, h)?;
        let singular = || Error::Unsupported(format!("{}: M − h ∂F/∂v is singular", mechanism.name()));
        let acceleration = solved(&self.effective_mass(mechanism, state, h), &pushed.force).ok_or_else(singular)?;
        let velocity = &state.velocity + acceleration * h;
        let position = mechanism.integrate(&state.position, &velocity, h);
        made(mechanism, State { time: state.time + h, position, velocity }, pushed.impulses, pushed.residual)
    }

    /// M + hC, with implicitfast M + hC − hG, by what couples its velocities.
    pub(super) fn effective_mass(&self, mechanism: &dyn Mechanism, state: &State, h: f64) -> Mass {
        let mass = mechanism.mass(&state.position);
        let slopes =
            if self.integrator == Integrator::ImplicitFast { mechanism.gyroscopic_slope(&state.position, &state.velocity) } else { None };
        let effective = match slopes {
            Some(slopes) => less(&mass, slopes, h),
            None => mass,
        };
        match mechanism.linear_force() {
            Some(linear) => Mass::Dense(effective.to_dense() + linear.damping * h),
            None => effective,
        }
    }

    /// F + Hᵀf at a state: through the waist, or with the rows of rotation by our own Newton.
    fn pushed(&self, solver: &dyn ContactSolver, mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<Pushed> {
        let force = mechanism.force(&state.position, &state.velocity);
        if self.rotational != Rotational::NONE {
            return self.pushed_with_rotation(mechanism, state, &force, h);
        }
        let StepProblem { problem, active, places, jacobian, .. } = self.posed(&StepContext::new(mechanism, state, h)?)?;
        let Some(problem) = problem else { return Ok(Pushed { force, impulses: Vec::new(), residual: None }) };
        let impulse = solver.solve(&problem, None)?.impulse;
        let parts = impulse.as_slice().chunks(problem.rows_per_contact());
        let impulses = active.iter().zip(places).zip(parts);
        let impulses = impulses.map(|((&contact, place), part)| ContactImpulse { contact, impulse: part.into(), place }).collect();
        Ok(Pushed { force: force + jacobian.tr_mul(&impulse) / h, impulses, residual: None })
    }

    fn runge_kutta(&self, solver: &dyn ContactSolver, mechanism: &dyn Mechanism, state: &State, h: f64) -> Result<Step> {
        let (mut mean_velocity, mut mean_acceleration) = (DVector::zeros(state.velocity.len()), DVector::zeros(state.velocity.len()));
        let mut impulses: Vec<ContactImpulse> = Vec::new();
        let (mut stage, mut residual) = (state.clone(), None);
        for (share, ahead) in [(1.0 / 6.0, 0.5), (1.0 / 3.0, 0.5), (1.0 / 3.0, 1.0), (1.0 / 6.0, 0.0)] {
            let pushed = self.pushed(solver, mechanism, &stage, h)?;
            let acceleration = Inertia::of(mechanism.mass(&stage.position))?.solve(&pushed.force);
            mean_velocity += &stage.velocity * share;
            mean_acceleration += &acceleration * share;
            residual = StepResidual::worse_of(residual, pushed.residual);
            pushed.impulses.into_iter().for_each(|impulse| add(&mut impulses, impulse, share));
            let position = mechanism.integrate(&state.position, &stage.velocity, ahead * h);
            stage = State { time: state.time + ahead * h, position, velocity: &state.velocity + acceleration * (ahead * h) };
        }
        let velocity = &state.velocity + mean_acceleration * h;
        let position = mechanism.integrate(&state.position, &mean_velocity, h);
        made(mechanism, State { time: state.time + h, position, velocity }, impulses, residual)
    }
}

/// M − h G of free bodies, whose masses couple no two bodies, body by body.
fn less(mass: &Mass, slopes: Vec<DMatrix<f64>>, h: f64) -> Mass {
    let mut first = 0;
    let body = |slope: DMatrix<f64>| {
        let (begin, size) = (first, slope.nrows());
        first += size;
        block(mass, begin, size) - slope * h
    };
    Mass::Blocks(slopes.into_iter().map(body).collect())
}

/// The block of M of so many velocities from one on.
fn block(mass: &Mass, first: usize, size: usize) -> DMatrix<f64> {
    match mass {
        Mass::Diagonal(diagonal) => DMatrix::from_diagonal(&diagonal.rows(first, size)),
        Mass::Dense(dense) => dense.view((first, first), (size, size)).into_owned(),
        Mass::Blocks(blocks) => {
            let (mut found, mut begin) = (DMatrix::zeros(size, size), 0);
            for block in blocks {
                if begin >= first && begin + block.nrows() <= first + size {
                    found.view_mut((begin - first, begin - first), block.shape()).copy_from(block);
                }
                begin += block.nrows();
            }
            found
        }
    }
}

/// A⁻¹ f, block by block, of an A that need not be symmetric; none where it is singular.
fn solved(matrix: &Mass, force: &DVector<f64>) -> Option<DVector<f64>> {
    match matrix {
        Mass::Diagonal(diagonal) => diagonal.iter().all(|mass| *mass != 0.0).then(|| force.component_div(diagonal)),
        Mass::Dense(dense) => dense.clone().lu().solve(force),
        Mass::Blocks(blocks) => {
            let (mut found, mut first) = (force.clone(), 0);
            for block in blocks {
                let mut own = found.rows_mut(first, block.nrows());
                block.clone().lu().solve_mut(&mut own).then_some(())?;
                first += block.nrows();
            }
            Some(found)
        }
    }
}

/// Adds a share of a stage's impulse to the step's at the same contact.
fn add(impulses: &mut Vec<ContactImpulse>, stage: ContactImpulse, share: f64) {
    let scaled = stage.impulse.iter().map(|part| part * share);
    match impulses.iter_mut().find(|known| known.acts_at(stage.contact, stage.place.as_ref())) {
        Some(known) => known.impulse.iter_mut().zip(scaled).for_each(|(sum, part)| *sum += part),
        None => impulses.push(ContactImpulse { impulse: scaled.collect(), ..stage }),
    }
}

fn made(mechanism: &dyn Mechanism, state: State, impulses: Vec<ContactImpulse>, residual: Option<StepResidual>) -> Result<Step> {
    let assembled = StepProblem {
        problem: None,
        residual: None,
        rejected: None,
        active: impulses.iter().map(|one| one.contact).collect(),
        places: impulses.iter().map(|one| one.place).collect(),
        jacobian: stack([].into_iter(), mechanism.rows_per_contact(), state.velocity.len()),
        free_velocity: state.velocity.clone(),
        effective_mass: Arc::new(Inertia::of(mechanism.mass(&state.position))?),
    };
    Ok(Step { state, impulses, assembled, solution: None, residual, rejected: None, impacts: None })
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_contact::solvers::GaussNewton;
    use moreau_dynamics::integrators::{Method, Phase, RungeKutta, SpringDamper};
    use moreau_dynamics::mechanics::{OscillatorWithStop, PointMass};
    use moreau_dynamics::schemes::{Scheme, assembled, step};
    use moreau_exact::scalar::exact;
    use moreau_exact::tolerance::rounding;
    use nalgebra::dvector;

    fn with(integrator: Integrator) -> Mujoco {
        Mujoco { integrator, ..Mujoco::default() }
    }

    fn moved(integrator: Integrator, mechanism: &dyn Mechanism, at: [f64; 2], h: f64) -> State {
        let state = State { time: 0.0, position: dvector![at[0]], velocity: dvector![at[1]] };
        step(&with(integrator), &GaussNewton::default(), mechanism, &state, h).expect("valid").state
    }

    #[test]
    fn a_damper_is_implicit_in_implicitfast_and_explicit_in_every_stage_of_rk4() {
        let (mass, stiffness, damping, h) = (2.0, 30.0, 0.5, 0.125);
        let body = OscillatorWithStop::new(mass, stiffness, damping, -10.0, 0.0).expect("valid");
        let [euler, fast] = [Integrator::Euler, Integrator::ImplicitFast].map(|integrator| moved(integrator, &body, [0.5, -2.0], h));
        assert!((euler.velocity - fast.velocity).amax() <= rounding(8, 4.0));
        let spring = SpringDamper { stiffness_per_mass: exact(stiffness / mass), damping_per_mass: exact(damping / mass) };
        let expected = RungeKutta.step(&spring, &Phase::of_one(0.5, -2.0), &h);
        let taken = moved(Integrator::RungeKutta, &body, [0.5, -2.0], h);
        assert!((taken.velocity - expected.velocity).amax() <= rounding(64, 8.0));
        assert!((taken.position - expected.position).amax() <= rounding(64, 1.0));
    }

    #[test]
    fn every_stage_of_rk4_finds_its_own_contacts_and_their_impulses_change_the_momentum() {
        // it starts above the floor and arrives within the step: only later stages touch
        let ball = PointMass::ball_on_floor(2.0, 10.0, 0.0);
        let state = State { time: 0.0, position: dvector![1e-4], velocity: dvector![-0.5] };
        let made = step(&with(Integrator::RungeKutta), &GaussNewton::default(), &ball, &state, 0.001).expect("valid");
        let impulse = made.impulses.first().expect("it touches").impulse[0];
        assert!(impulse > 0.0 && made.state.time == 0.001);
        let change = 2.0 * (made.state.velocity[0] + 0.5) + 2.0 * 10.0 * 0.001;
        assert!((change - impulse).abs() <= rounding(32, 1.0), "{change} {impulse}");
        let euler = step(&with(Integrator::Euler), &GaussNewton::default(), &ball, &state, 0.001).expect("valid");
        assert!(euler.impulses.is_empty());
    }

    #[test]
    fn names_and_refusals() {
        assert_eq!(Integrator::by_name("rk4").expect("known"), Integrator::RungeKutta);
        assert!(Integrator::by_name("RK").expect_err("unknown").to_string().contains("implicitfast"));
        let ball = PointMass::ball_on_floor(1.0, 9.81, 0.0);
        let state = State { time: 0.0, position: dvector![1.0], velocity: dvector![0.0] };
        let scheme = with(Integrator::ImplicitFast);
        assert_eq!(scheme.name(), "mujoco implicitfast");
        assert!(scheme.waist().is_none() && with(Integrator::Euler).waist().is_some());
        assert!(assembled(&scheme, &ball, &state, 0.01).is_err() && assembled(&with(Integrator::Euler), &ball, &state, 0.01).is_ok());
        assert!(step(&scheme, &GaussNewton::default(), &ball, &state, -0.01).is_err());
    }
}
