//! MuJoCo: soft contact, one strictly convex problem per step for accelerations, semi-implicit Euler.
//!
//! ```text
//!     a = argmin ½ (a − a₀)ᵀM(a − a₀) + s(H a − a_ref) ,     a₀ = M⁻¹F(q, v) ,     f = −∇s ;     v⁺ = v + h a ,   q⁺ = q ⊕ h v⁺ .
//! ```
//! On the waist, with r = h f and u = H v⁺: u_free = H(v + h a₀), shift = −H v − h a_ref, compliance R; the law is the associated one over
//! the round cone (elliptic) or over the pyramid n ± μ t_j of four edges, whose R acts on edge impulses. R and a_ref:
//! [`softness`](Softness).
//!
//! Active are the contacts with φ < margin at the start of the step. H is taken halfway between the two points that touch and does not
//! account for Ḣv, as MuJoCo does for contacts. Â is the sum of the bodies' inverse masses, and the normal entry of H M⁻¹Hᵀ where a
//! mechanism does not consist of free bodies. Damping −C v of joints enters the velocity implicitly, after the contact problem:
//! ```text
//!     v⁺ = v + h (M + hC)⁻¹ (F + Hᵀf) .
//! ```
//!
//! That is the integrator Euler; implicitfast and RK4 are in [`Integrator`]. Torsional and rolling friction ([`Rotational`]) add rows that
//! the waist does not have: then the program of Gauss's principle is built and solved here. What a given acceleration asks for is in
//! [`InverseDynamics`].
//!
//! DIFFERENCE. In the plane both cones are the same two edges; the elliptic rows are used, and a planar box has two corners where MuJoCo's
//! box has four, so that each carries more and rests deeper.
//!
//! # Energy
//! ```text
//!     T(v⁺) ≤ T(v_free) + r·(u⁻ + h a_ref) − fᵀR f − ½ rᵀW r ,
//!     ΔẼ ≤ ½‖v_g − v‖²_M + r·(u⁻ + h a_ref) − fᵀR f + h²FᵀM⁻¹F/8 ,   Ẽ = E + ½ h F·v
//! ```
//! f are the impulses that R acts on, edges or rows; v_g − v = h M⁻¹F_g is the explicit gyroscopic torque, whose gain grows without bound
//! in free flight at h‖Ω‖ ≈ 1. implicitfast, RK4 and friction against rotation have no theorem ([`crate::energy_balance`]).

mod conjugate_gradient;
mod gauss_sweeps;
mod integrator;
mod inverse;
mod parameters;
mod rows;
mod softness;

pub use conjugate_gradient::{CONJUGATE_GRADIENT, Direction, GaussConjugateGradient};
pub use gauss_sweeps::{GAUSS_SWEEPS, GaussSweeps};
pub use inverse::{ContactForce, InverseDynamics};
pub use parameters::{Cone, Integrator, Mujoco, Rotational};
pub use softness::Softness;

use moreau_contact::contact::delassus::MassFactor;
use moreau_contact::contact::{Contact, pairs};
use moreau_contact::problem::{Compliance, ContactProblem, Coordinates, Law};
use moreau_dynamics::mechanics::Mechanism;
use moreau_dynamics::schemes::assembly::stack;
use moreau_dynamics::schemes::{Certified, Inertia, Scheme, Start, Step, StepContext, StepProblem, Waist, waist};
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use parameters::Soft;
use std::sync::Arc;

impl Mujoco {
    /// MuJoCo's defaults with this cone.
    pub const fn standard(cone: Cone) -> Self {
        Mujoco { cone, softness: Softness::STANDARD, rotational: Rotational::NONE, integrator: Integrator::Euler }
    }

    /// Checks softness and lengths.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] names the number that is not valid.
    pub fn validate(&self) -> Result<()> {
        self.softness.validate()?;
        self.rotational.validate()
    }

    /// Whether a step is that of the waist: one problem in three rows a contact, and Euler's update.
    fn is_plain(&self) -> bool {
        self.integrator == Integrator::Euler && self.rotational == Rotational::NONE
    }

    fn active(&self, mechanism: &dyn Mechanism, position: &DVector<f64>, factor: &MassFactor<f64>) -> Vec<Soft> {
        let candidates = mechanism.contacts_halfway(position, self.softness.margin).into_iter().enumerate();
        let close = candidates.filter(|(_, contact)| contact.gap < self.softness.margin);
        let soft = |(index, contact): (usize, Contact)| {
            let row = contact.jacobian.row(0).transpose();
            let inverse_mass = mechanism.inverse_mass(&contact).unwrap_or_else(|| row.dot(&factor.solve(&row)));
            Soft { index, contact, inverse_mass }
        };
        close.map(soft).collect()
    }

    /// The law, and R in its coordinates.
    fn law(&self, rows: usize, contacts: &[Soft]) -> (Law, Compliance) {
        let (law, coordinates) = match (rows, self.cone) {
            (1, _) => (Law::Frictionless, Coordinates::Contact),
            (3, Cone::Pyramidal) => (Law::PolyhedralAssociated { directions: 4 }, Coordinates::Edge),
            _ => (Law::Associated, Coordinates::Contact),
        };
        (law, self.compliance(coordinates, rows, contacts))
    }

    fn compliance(&self, coordinates: Coordinates, rows: usize, contacts: &[Soft]) -> Compliance {
        let of = |Soft { contact, inverse_mass, .. }: &Soft| -> Vec<f64> {
            let (gap, mu) = (contact.gap, contact.friction);
            // Without friction the four edges are one normal, and four in parallel have a quarter of an edge's R; a cone is a half-line,
            // whose tangential entries nothing reads.
            let normal = || self.softness.elliptic(gap, *inverse_mass, &[])[0];
            match coordinates {
                Coordinates::Edge if mu > 0.0 => vec![self.softness.pyramidal(gap, *inverse_mass, mu); 4],
                Coordinates::Edge => vec![4.0 * normal(); 4],
                Coordinates::Contact if mu > 0.0 => self.softness.elliptic(gap, *inverse_mass, &vec![mu; rows - 1]),
                Coordinates::Contact => vec![normal(); rows],
            }
        };
        Compliance { coordinates, diagonal: DVector::from_vec(contacts.iter().flat_map(of).collect()) }
    }

    /// −H v − h a_ref, one contact below the other \[m/s\].
    fn shift(&self, contacts: &[Soft], velocity: &DVector<f64>, h: f64) -> DVector<f64> {
        let of = |Soft { contact, .. }: &Soft| {
            let u = &contact.jacobian * velocity;
            let reference = self.softness.reference_acceleration(h, contact.gap, u.as_slice());
            u.iter().zip(reference).map(|(u, reference)| -u - h * reference).collect::<Vec<f64>>()
        };
        DVector::from_vec(contacts.iter().flat_map(of).collect())
    }

    /// The contact problem of a state in three rows a contact, and Euler's update.
    fn posed(&self, at: &StepContext) -> Result<StepProblem> {
        let (mechanism, state, h) = (at.mechanism(), at.state(), at.h());
        let inertia = at.inertia()?;
        let force = mechanism.force(&state.position, &state.velocity);
        let unconstrained = &state.velocity + inertia.solve(&force) * h;
        let damped = match mechanism.linear_force() {
            Some(linear) => Arc::new(Inertia::new(inertia.matrix() + linear.damping * h)?),
            None => inertia.clone(),
        };
        let free_velocity = &state.velocity + damped.solve(&force) * h;
        let contacts = self.active(mechanism, &state.position, inertia.factor());
        let rows = mechanism.rows_per_contact();
        let places: Vec<_> = contacts.iter().map(|soft| soft.contact.place).collect();
        let jacobian = stack(contacts.iter().map(|soft| &soft.contact), rows, mechanism.degrees_of_freedom());
        let problem = if contacts.is_empty() {
            None
        } else {
            let (law, compliance) = self.law(rows, &contacts);
            Some(
                ContactProblem::from_inertia(&inertia, &jacobian, &unconstrained)
                    .name(format!("{} {} t={}", mechanism.name(), self.name(), state.time))
                    .law(law)
                    .rows_per_contact(rows)
                    .friction(contacts.iter().map(|soft| soft.contact.friction).collect())
                    .shift(self.shift(&contacts, &state.velocity, h))
                    .compliance(compliance)
                    .bodies(pairs(&places))
                    .build()?,
            )
        };
        let active = contacts.iter().map(|soft| soft.index).collect();
        Ok(StepProblem { problem, active, places, effective_mass: damped, free_velocity, jacobian, residual: None, rejected: None })
    }
}

impl Scheme for Mujoco {
    fn name(&self) -> String {
        let cone = if self.cone == Cone::Elliptic { " elliptic" } else { "" };
        format!("mujoco{cone}{}{}", self.rotational.suffix(), self.integrator.suffix())
    }

    fn has_restitution(&self) -> bool {
        false
    }

    /// Euler's step without friction against rotation passes the waist; the others are not one problem of three rows a contact.
    fn step(&self, solver: &Certified, start: &Start) -> Result<Step> {
        match self.waist() {
            Some(waist) => waist::step(waist, solver, start),
            None => self.integrate(solver, start),
        }
    }

    fn waist(&self) -> Option<&dyn Waist> {
        self.is_plain().then_some(self as &dyn Waist)
    }
}

impl Waist for Mujoco {
    /// Euler's problem; of the configurations that do not pass it would be another step's, so that they are refused.
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        if self.is_plain() {
            return self.posed(at);
        }
        Err(Error::Unsupported(format!("{}: a step is not one contact problem of three rows a contact", self.name())))
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        at.mechanism().integrate(&at.state().position, velocity_post, at.h())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_contact::certificate::residuals;
    use moreau_contact::problem::Solution;
    use moreau_contact::solvers::{ContactSolver, GaussNewton};
    use moreau_contact::tolerance::certificate::CERTIFY;
    use moreau_dynamics::mechanics::{OscillatorWithStop, PointMass, State};
    use moreau_dynamics::scenes::named;
    use moreau_dynamics::schemes::{run, step};
    use moreau_exact::tolerance::rounding;
    use moreau_forms::mujoco_contact::ContactParameters;
    use moreau_forms::mujoco_normal::NormalContact;
    use nalgebra::dvector;

    /// Newton, every answer certified.
    struct Certified;

    impl ContactSolver for Certified {
        fn name(&self) -> &'static str {
            "certified"
        }

        fn takes(&self, _law: Law, _rows: usize, _symmetric: bool) -> bool {
            true
        }

        fn solve(&self, problem: &ContactProblem, start: Option<&DVector<f64>>) -> Result<Solution> {
            let solution = GaussNewton::default().solve(problem, start)?;
            assert!(residuals(problem, &solution)?.is_solution(CERTIFY), "{}", problem.name());
            Ok(solution)
        }
    }

    #[test]
    fn every_step_of_a_stack_that_settles_is_solved_by_newton_with_both_cones() {
        for cone in [Cone::Pyramidal, Cone::Elliptic] {
            let (mechanism, start) = named("box-stack").and_then(|scene| scene.spatial_mechanism()).expect("built in");
            let scheme = Mujoco { cone, ..Mujoco::default() };
            run(&scheme, &Certified, mechanism.as_ref(), start, 0.005, 40, |_| ()).expect("certified");
        }
    }

    #[test]
    fn a_ball_moves_as_the_closed_form_of_one_normal_contact() {
        let ball = PointMass::ball_on_floor(2.0, 9.81, 0.0);
        let contact = NormalContact::elliptic(ContactParameters::default(), 0.001, 2.0);
        let mut state = State { time: 0.0, position: dvector![1e-3], velocity: dvector![-0.5] };
        for _ in 0..200 {
            let impulse = contact.impulse(-state.position[0], state.velocity[0], -9.81);
            let expected = state.velocity[0] - 0.001 * 9.81 + impulse / 2.0;
            state = step(&Mujoco::default(), &GaussNewton::default(), &ball, &state, 0.001).expect("one contact").state;
            assert!((state.velocity[0] - expected).abs() <= rounding(64, 1.0), "{} {expected}", state.velocity[0]);
        }
    }

    #[test]
    fn a_damper_is_implicit_and_a_spring_is_not() {
        let oscillator = OscillatorWithStop::new(2.0, 3.0, 5.0, 0.0, 0.0).expect("valid");
        let state = State { time: 0.0, position: dvector![0.7], velocity: dvector![-0.4] };
        let next = step(&Mujoco::default(), &GaussNewton::default(), &oscillator, &state, 0.1).expect("no contact").state;
        let expected = -0.4 + 0.1 * (-3.0 * 0.7 + 5.0 * 0.4) / (2.0 + 0.1 * 5.0);
        assert!((next.velocity[0] - expected).abs() <= rounding(16, 1.0), "{} {expected}", next.velocity[0]);
        assert!((next.position[0] - 0.7 - 0.1 * next.velocity[0]).abs() <= rounding(4, 1.0));
    }

    #[test]
    fn a_margin_holds_a_ball_above_the_floor() {
        let ball = PointMass::ball_on_floor(1.0, 9.81, 0.0);
        let scheme = Mujoco { softness: Softness { margin: 0.01, ..Softness::default() }, ..Mujoco::default() };
        let start = State { time: 0.0, position: dvector![0.02], velocity: dvector![0.0] };
        let end = run(&scheme, &GaussNewton::default(), &ball, start, 0.001, 2000, |_| ()).expect("one contact");
        let depth = ContactParameters::default().rest_depth(0.001, 1.0, 9.81).expect("positive");
        assert!((end.position[0] - 0.01 + depth).abs() <= rounding(1024, 0.01), "{}", end.position[0]);
    }
}
