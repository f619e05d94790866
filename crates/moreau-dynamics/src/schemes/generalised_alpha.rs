//! Nonsmooth generalised-α: the smooth part of the motion by the generalised-α method, impulses beside it as jumps of the velocity.
//!
//! ```text
//!     (1−α_m) a⁺ + α_m a = (1−α_f) M⁻¹F(q⁺, v⁺) + α_f M⁻¹F(q, v)                       a: the method's own acceleration, remembered
//!     v⁺ = v + h (1−γ) a + h γ a⁺ + w ,     q⁺ = q + h v + h² (½−β) a + h² β a⁺ + ½ h w ,     M w = Hᵀ r
//!     K_μ ∋ r ⟂ y + μ‖y_t‖ n ∈ K_μ* ,   y = H v⁺ + e u_n n      at contacts with φ ≤ 0 after the step without impulse, H there
//!
//!     α_m = (2ρ−1)/(ρ+1) ,   α_f = ρ/(ρ+1) ,   γ = ½ + α_f − α_m ,   β = ¼ (1 + α_f − α_m)²
//! ```
//! Without contact the method is of second order, and an infinitely stiff spring loses all but ρ of its motion per step: ρ = 1 is the
//! trapezoidal rule and keeps the energy of a spring, ρ = 0 forgets. Through impacts the order is one, as for every fixed step.
//!
//! Linear forces −K q − C v are implicit, others are taken at the start of the step. With c = (1−α_m)/(1−α_f) and S = c M + h² β K + h γ C
//! the impulse acts through M̂ = M A⁻¹ S, A = c M + h² (β − γ/2) K, which is symmetric if the damping is proportional.
//!
//! [`Waist::assemble`] alone makes a first step, from a = M⁻¹F(q, v); [`super::run`] carries a from step to step.
//!
//! # Energy
//! ```text
//!     T̂(v⁺) ≤ T̂(v_free) − Σ e r_n u_n⁻ − ½ rᵀŴ r ,      ΔE ≤ (1−e)/(1+e) · h²FᵀM⁻¹F/8
//! ```
//! The second for a constant force, one e, and no friction or e = 0. T(v_free) of a body with three unequal axes has no theorem: the scheme
//! remembers its accelerations, and a spin of h‖Ω‖ ≈ 1 grows without contact (`moreau::checks::energy_balance`).

use super::assembly::{self, normal_only};
use super::{Inertia, Scheme, Step, StepContext, StepProblem, Waist, passes_the_waist};
use crate::mechanics::{LinearForce, Mechanism, State};
use crate::tolerance::schemes::asymmetry;
use moreau_contact::contact::delassus::MassFactor;
use moreau_contact::contact::{Components, pairs};
use moreau_contact::problem::{ContactProblem, Law};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// The nonsmooth generalised-α scheme.
///
/// # Source
/// Chapter §9, higher order; Chen, Acary, Virlez and Brüls, Int. J. Numer. Meth. Eng. 96 (2013) 487; Chung and Hulbert, J. Appl. Mech. 60
/// (1993) 371.
#[derive(Clone, Debug, PartialEq)]
pub struct GeneralisedAlpha {
    spectral_radius: f64,
    memory: Option<Memory>,
}

/// a and M⁻¹F at the end of the step before.
#[derive(Clone, Debug, PartialEq)]
struct Memory {
    acceleration: DVector<f64>,
    rate: DVector<f64>,
}

impl Default for GeneralisedAlpha {
    fn default() -> Self {
        GeneralisedAlpha { spectral_radius: 0.8, memory: None }
    }
}

/// α_m, α_f, γ, β.
struct Weights {
    mass: f64,
    force: f64,
    gamma: f64,
    beta: f64,
}

/// A step without impulse, and how it answers one.
struct Smooth {
    weights: Weights,
    memory: Memory,
    /// Springs and dampers, if there are any.
    springs: Option<Springs>,
    /// M̂.
    effective_mass: Arc<Inertia>,
    /// M.
    mass: Arc<Inertia>,
    /// a⁺ with w = 0.
    acceleration: DVector<f64>,
    /// v⁺ with w = 0.
    velocity: DVector<f64>,
}

/// What springs and dampers add to a step; without them S = c M and M̂ = M.
struct Springs {
    /// S.
    stiff_mass: MassFactor<f64>,
    /// ½ h K + C: a⁺ falls by S⁻¹ of it times w.
    reaction: DMatrix<f64>,
    /// M̂.
    effective_mass: Arc<Inertia>,
    /// What they add to the load: −K (q⁺ − q with a⁺ = 0) − C h (1−γ) a.
    load: DVector<f64>,
}

impl Springs {
    fn new(
        LinearForce { stiffness, damping }: LinearForce,
        weights: &Weights,
        inertia: &DMatrix<f64>,
        h: f64,
        memory: &Memory,
        velocity: &DVector<f64>,
    ) -> Result<Self> {
        let share = weights.share();
        let stiff = inertia * share + &stiffness * (h * h * weights.beta) + &damping * (h * weights.gamma);
        let inner = inertia * share + &stiffness * (h * h * (weights.beta - 0.5 * weights.gamma));
        let inner = MassFactor::new(&inner)?;
        let columns: Vec<DVector<f64>> = stiff.column_iter().map(|column| inner.solve(&column.into_owned())).collect();
        let effective_mass = inertia * DMatrix::from_columns(&columns);
        if (&effective_mass - effective_mass.transpose()).amax() > asymmetry(effective_mass.amax(), velocity.len()) {
            return Err(Error::Unsupported("generalised-alpha needs damping that is proportional to mass or stiffness".into()));
        }
        let effective_mass = Arc::new(Inertia::new((&effective_mass + effective_mass.transpose()) * 0.5)?);
        let drift = velocity * h + &memory.acceleration * (h * h * (0.5 - weights.beta));
        let load = -(&stiffness * &drift) - &damping * &memory.acceleration * (h * (1.0 - weights.gamma));
        Ok(Springs { stiff_mass: MassFactor::new(&stiff)?, reaction: stiffness * (0.5 * h) + damping, effective_mass, load })
    }
}

impl Weights {
    /// c.
    fn share(&self) -> f64 {
        (1.0 - self.mass) / (1.0 - self.force)
    }
}

impl GeneralisedAlpha {
    /// The scheme with ρ, the share of an infinitely stiff motion that a step keeps.
    ///
    /// # Errors
    /// If ρ is not in \[0, 1\].
    pub fn new(spectral_radius: f64) -> Result<Self> {
        if (0.0..=1.0).contains(&spectral_radius) {
            return Ok(GeneralisedAlpha { spectral_radius, memory: None });
        }
        Err(Error::invalid("spectral_radius", format!("is {spectral_radius}"), "use a number from 0 to 1"))
    }

    /// ρ.
    pub fn spectral_radius(&self) -> f64 {
        self.spectral_radius
    }

    fn weights(&self) -> Weights {
        let rho = self.spectral_radius;
        let (mass, force) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        Weights { mass, force, gamma: 0.5 + force - mass, beta: 0.25 * (1.0 + force - mass).powi(2) }
    }

    fn smooth(&self, at: &StepContext) -> Result<Smooth> {
        let (mechanism, state, h) = (at.mechanism(), at.state(), at.h());
        let (weights, State { position, velocity, .. }) = (self.weights(), state);
        let (mass, force) = (at.inertia()?, mechanism.mean_force(position, velocity, h));
        let start = || Memory { acceleration: mass.solve(&force), rate: mass.solve(&force) };
        let memory = self.memory.clone().unwrap_or_else(start);
        let linear = mechanism.linear_force();
        let springs = linear.map(|linear| Springs::new(linear, &weights, mass.finite_matrix()?, h, &memory, velocity)).transpose()?;
        let kept = (&memory.acceleration * weights.mass - &memory.rate * weights.force) / (1.0 - weights.force);
        let acceleration = match &springs {
            Some(springs) => springs.stiff_mass.solve(&(force + &springs.load - mass.mass().times(&kept))),
            None => (mass.solve(&force) - kept) / weights.share(),
        };
        let effective_mass = springs.as_ref().map_or_else(|| mass.clone(), |springs| springs.effective_mass.clone());
        let velocity = velocity + &memory.acceleration * (h * (1.0 - weights.gamma)) + &acceleration * (h * weights.gamma);
        Ok(Smooth { weights, memory, springs, effective_mass, mass, acceleration, velocity })
    }
}

impl Smooth {
    /// a⁺ with the jump w.
    fn acceleration_after(&self, jump: &DVector<f64>) -> DVector<f64> {
        let falls = self.springs.as_ref().map(|Springs { stiff_mass, reaction, .. }| stiff_mass.solve(&(reaction * jump)));
        falls.map_or_else(|| self.acceleration.clone(), |falls| &self.acceleration - falls)
    }

    /// w from v⁺: M w = Hᵀr = M̂ (v⁺ − v_free), without springs the change of velocity itself.
    fn jump(&self, velocity_post: &DVector<f64>) -> DVector<f64> {
        let change = velocity_post - &self.velocity;
        if self.springs.is_none() { change } else { self.mass.solve(&self.effective_mass.mass().times(&change)) }
    }

    /// (q⁺ − q)/h.
    fn mean_velocity(&self, state: &State, jump: &DVector<f64>, h: f64) -> DVector<f64> {
        let Weights { beta, .. } = self.weights;
        &state.velocity + &self.memory.acceleration * (h * (0.5 - beta)) + self.acceleration_after(jump) * (h * beta) + jump * 0.5
    }
}

impl Scheme for GeneralisedAlpha {
    fn name(&self) -> String {
        format!("generalised-alpha spectral-radius={}", self.spectral_radius)
    }

    fn successor(&self, mechanism: &dyn Mechanism, before: &State, step: &Step, h: f64) -> Result<Option<Box<dyn Scheme>>> {
        let smooth = self.smooth(&StepContext::new(mechanism, before, h)?)?;
        let acceleration = smooth.acceleration_after(&smooth.jump(&step.state.velocity));
        let State { position, velocity, .. } = &step.state;
        let rate = Inertia::of(mechanism.mass(position))?.solve(&mechanism.force(position, velocity));
        Ok(Some(Box::new(GeneralisedAlpha { memory: Some(Memory { acceleration, rate }), ..*self })))
    }

    passes_the_waist!();
}

impl Waist for GeneralisedAlpha {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        let (mechanism, state, h) = (at.mechanism(), at.state(), at.h());
        let smooth = self.smooth(at)?;
        let none = DVector::zeros(state.velocity.len());
        let reached = at.mechanism().integrate(&at.state().position, &smooth.mean_velocity(state, &none, h), h);
        let contacts = mechanism.contacts(&reached);
        let active: Vec<usize> = (0..contacts.len()).filter(|&k| contacts[k].gap <= 0.0).collect();
        let rows = mechanism.rows_per_contact();
        let own = || active.iter().map(|&k| &contacts[k]);
        let jacobian = assembly::stack(own(), rows, mechanism.degrees_of_freedom());
        let shifts: Vec<Components> =
            own().map(|contact| normal_only(contact.restitution * (&contact.jacobian * &state.velocity)[0], rows)).collect();
        let places: Vec<_> = own().map(|contact| contact.place).collect();
        let problem = ContactProblem::from_inertia(&smooth.effective_mass, &jacobian, &smooth.velocity)
            .name(format!("{} generalised-alpha t={}", mechanism.name(), state.time))
            .law(if rows == 1 { Law::Frictionless } else { Law::Coulomb })
            .rows_per_contact(rows)
            .friction(own().map(|contact| contact.friction).collect())
            .shift(DVector::from_iterator(rows * active.len(), shifts.iter().flat_map(|shift| shift.iter().copied())))
            .bodies(pairs(&places))
            .build()?;
        let problem = (!active.is_empty()).then_some(problem);
        Ok(StepProblem {
            problem,
            active,
            places,
            effective_mass: smooth.effective_mass,
            free_velocity: smooth.velocity,
            jacobian,
            residual: None,
            rejected: None,
        })
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        let (state, h) = (at.state(), at.h());
        let smooth = self.smooth(at).expect("assemble has made the same matrices of the same state");
        let mean = smooth.mean_velocity(state, &smooth.jump(velocity_post), h);
        at.mechanism().integrate(&at.state().position, &mean, h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{OscillatorWithStop, PointMass};
    use crate::schemes::simulate;
    use moreau_contact::solvers::LemkePivoting;
    use moreau_exact::tolerance::rounding;
    use nalgebra::dvector;

    fn at(position: f64, velocity: f64) -> State {
        State { time: 0.0, position: dvector![position], velocity: dvector![velocity] }
    }

    fn last(radius: f64, mechanism: &dyn Mechanism, start: State, h: f64, steps: usize) -> State {
        let scheme = GeneralisedAlpha::new(radius).expect("in range");
        simulate(&scheme, &LemkePivoting, mechanism, start, h, steps).expect("steps").last().clone()
    }

    #[test]
    fn between_contacts_the_order_is_two_for_every_spectral_radius() {
        // q̈ = −26 q − 2 q̇ from q = 1, q̇ = −1: q = e⁻ᵗ cos 5t
        let spring = OscillatorWithStop::new(2.0, 52.0, 4.0, -10.0, 0.0).expect("valid");
        for radius in [0.0, 0.5, 0.8, 1.0] {
            let error = |parts: usize| {
                let end = last(radius, &spring, at(1.0, -1.0), 1.0 / parts as f64, parts);
                (end.position[0] - (-1.0f64).exp() * 5.0f64.cos()).abs()
            };
            let order = (error(256) / error(512)).log2();
            assert!((order - 2.0).abs() <= 0.1, "ρ = {radius}: order {order}");
        }
    }

    #[test]
    fn the_trapezoidal_rule_keeps_a_spring_s_energy_and_smaller_radii_take_it() {
        let spring = OscillatorWithStop::new(1.0, 1.0, 0.0, -10.0, 0.0).expect("valid");
        let left = |radius| spring.energy(&last(radius, &spring, at(1.0, 0.3), 0.5, 200)) / spring.energy(&at(1.0, 0.3));
        assert!((left(1.0) - 1.0).abs() <= rounding(200 * 64, 1.0));
        assert!(left(0.8) < 0.99 && left(0.0) < left(0.8));
    }

    #[test]
    fn a_stiff_spring_is_forgotten_at_rho_per_step() {
        // hω = 10⁶; velocity and a have −ρ twice as eigenvalue: (c + n) ρⁿ, from n = 30 to 60 by 2 ρ³⁰ if c ≥ 0, and 4 ρ³⁰ if c ≥ −20
        let spring = OscillatorWithStop::new(1.0, 1e12, 0.0, -1e9, 0.0).expect("valid");
        let size = |steps| last(0.5, &spring, at(0.0, 1.0), 1.0, steps).velocity[0].abs();
        assert!(size(60) <= 4.0 * 0.5f64.powi(30) * size(30) && size(30) > 0.0, "{} {}", size(60), size(30));
        assert!(last(0.0, &spring, at(0.0, 1.0), 1.0, 5).velocity[0].abs() <= 1e-5);
    }

    #[test]
    fn a_ball_leaves_with_e_times_its_velocity_and_a_resting_one_stays() {
        let ball = PointMass::ball_on_floor(2.0, 10.0, 0.5);
        let hit = last(0.8, &ball, at(0.005, -1.0), 0.01, 1);
        assert!((hit.velocity[0] - 0.5).abs() <= rounding(16, 1.0));
        // q + ½h(v + v⁺): the impulse acts half a step on the position
        assert!((hit.position[0] - (0.005 - 0.0025)).abs() <= rounding(16, 1.0));
        let rest = last(0.8, &ball, at(0.0, 0.0), 0.01, 500);
        assert!(rest.position[0].abs() <= rounding(500 * 16, 0.1) && rest.velocity[0].abs() <= rounding(16, 0.1));
    }

    #[test]
    fn an_oscillator_rests_against_its_stop_without_drift() {
        let pressed = OscillatorWithStop::new(1.0, 100.0, 0.0, 0.1, 0.0).expect("valid");
        let end = last(0.8, &pressed, at(0.1, 0.0), 0.01, 200);
        assert!((end.position[0] - 0.1).abs() <= rounding(200 * 64, 1.0), "{}", end.position[0]);
    }

    #[test]
    fn a_spectral_radius_outside_the_unit_interval_is_refused() {
        for radius in [-0.1, 1.1, f64::NAN] {
            assert!(GeneralisedAlpha::new(radius).expect_err("refused").to_string().contains("spectral_radius"));
        }
    }
}
