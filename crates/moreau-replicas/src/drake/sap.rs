//! Drake's SAP: the convex step of the associated law, softened until it is strictly convex.
//!
//! ```text
//!     K_μ ∋ r ⟂ u⁺ + φ/(h + τ) n + R r ∈ K_μ* ,
//!     R_n = max( w/4π² , 1/(h k (h + τ)) ) ,     R_t = σ w ,     σ = 1e-3
//! ```
//! A spring k with relaxation time τ, treated implicitly, is R_n = 1/(h k (h + τ)): r_n = h k (−φ⁺ − τ u_n⁺). Where the step cannot resolve
//! the spring, the contact is *near rigid*: w/4π² lets its period be h, and the depth no longer depends on k. R_t makes friction a dashpot
//! inside the cone: a block that should stick creeps at σ w r_t, which is O(h). As the cone law is associated, a sliding contact is lifted
//! by (h + τ) μ‖u_t‖, and leaves the ground where that exceeds the depth.
//!
//! # Energy
//! ```text
//!     T(v⁺) ≤ T(v_free) − Σ r_n φ/(h+τ) − rᵀR r − ½ rᵀW r ,      ΔẼ ≤ −Σ r_n φ/(h+τ) − rᵀR r + h²FᵀM⁻¹F/8 ,   Ẽ = E + ½ h F·v
//! ```
//! A spring that the step resolves gives back at most k φ²/4 of a depth in one step, half of its energy ([`crate::energy_balance`]).
//!
//! # Source
//! Castro, Permenter and Han, *An unconstrained convex formulation of compliant contact* (2022), §V.

use crate::drake::touching::response;
use crate::drake::{Material, SIGMA};
use moreau_contact::contact::{Components, Rows};
use moreau_contact::problem::{Compliance, Coordinates, Law};
use moreau_dynamics::schemes::assembly::{Candidate, Rules, normal_only};
use moreau_dynamics::schemes::{Scheme, StepContext, StepProblem, Waist, assembly, passes_the_waist};
use moreau_exact::Result;
use nalgebra::DVector;
use std::f64::consts::PI;

/// Drake's `kSap`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DrakeSap {
    /// k and τ.
    pub material: Material,
}

impl DrakeSap {
    /// (R_n, R_t, …) \[1/kg\] of the contact with these rows of H, of the diagonal of M.
    fn regularisation(&self, diagonal: &DVector<f64>, rows: &Rows, h: f64) -> Vec<f64> {
        let response = response(diagonal, rows);
        let Material { stiffness, relaxation_time, .. } = self.material;
        let spring = 1.0 / (h * stiffness * (h + relaxation_time));
        let normal = (response / (4.0 * PI * PI)).max(spring);
        (0..rows.nrows()).map(|row| if row == 0 { normal } else { SIGMA * response }).collect()
    }
}

impl Rules for DrakeSap {
    fn is_active(&self, candidate: &Candidate, _h: f64) -> bool {
        candidate.contact.gap < 0.0
    }

    fn shift(&self, candidate: &Candidate, h: f64) -> Components {
        normal_only(candidate.contact.gap / (h + self.material.relaxation_time), candidate.velocity.len())
    }

    fn law(&self, rows_per_contact: usize) -> Law {
        if rows_per_contact == 1 { Law::Frictionless } else { Law::Associated }
    }
}

impl Scheme for DrakeSap {
    fn name(&self) -> String {
        "drake-sap".into()
    }

    fn has_restitution(&self) -> bool {
        false
    }

    passes_the_waist!();
}

impl Waist for DrakeSap {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        let mut step = assembly::assemble("drake-sap", self, at)?;
        if let Some(problem) = step.problem.take() {
            let mass = step.effective_mass.mass().diagonal();
            let parts = step.jacobian.contacts().iter().flat_map(|rows| self.regularisation(&mass, rows, at.h()));
            let diagonal = DVector::from_iterator(problem.rows(), parts);
            let compliance = Compliance { coordinates: Coordinates::Contact, diagonal };
            step.problem = Some(problem.into_builder().compliance(compliance).build()?);
        }
        Ok(step)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        at.mechanism().integrate(&at.state().position, velocity_post, at.h())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drake::SemiAnalyticPrimal;
    use moreau_contact::solvers::{ContactSolver, ProjectedGaussSeidel};
    use moreau_contact::tolerance::solvers;
    use moreau_dynamics::mechanics::{PointMass, State};
    use moreau_dynamics::schemes::simulate;
    use moreau_dynamics::trajectory::Recording;
    use moreau_exact::tolerance::rounding;
    use moreau_forms::drake_sap::SapContact;
    use nalgebra::dvector;

    const H: f64 = 0.005;
    const G: f64 = 9.81;

    fn scheme(stiffness: f64, relaxation_time: f64) -> DrakeSap {
        DrakeSap { material: Material { stiffness, relaxation_time, ..Material::default() } }
    }

    /// A block of 1 kg on a slope in the plane: w = ‖diag(1, 1)‖_F/3.
    fn on_slope(scheme: &DrakeSap, solver: &dyn ContactSolver, degrees: f64, start: [f64; 4], steps: usize) -> (Recording, SapContact) {
        let mechanism = PointMass::block_on_incline(1.0, G, degrees.to_radians(), 0.3, 0.0);
        let [along, above, speed, rising] = start;
        let state = State { time: 0.0, position: dvector![along, above], velocity: dvector![speed, rising] };
        let contact = SapContact {
            time_step: H,
            stiffness: scheme.material.stiffness,
            relaxation_time: scheme.material.relaxation_time,
            diagonal_mean: 2f64.sqrt() / 3.0,
            tangential_ratio: SIGMA,
            friction: 0.3,
        };
        (simulate(scheme, solver, &mechanism, state, H, steps).expect("one contact"), contact)
    }

    #[test]
    fn the_rest_depth_is_that_of_the_spring_or_of_the_near_rigid_bound() {
        for stiffness in [1e3, 1e9] {
            let scheme = scheme(stiffness, 0.02);
            let (_, contact) = on_slope(&scheme, &SemiAnalyticPrimal, 0.0, [0.0; 4], 1);
            let depth = contact.rest_gap(G);
            let (run, _) = on_slope(&scheme, &SemiAnalyticPrimal, 0.0, [0.0, depth, 0.0, 0.0], 200);
            // every step ends within STOP of the impulse h g
            let allowed = 200.0 * H * solvers::STOP * G * H;
            assert!((run.last().position[1] - depth).abs() <= allowed, "k = {stiffness}");
        }
    }

    #[test]
    fn a_block_that_should_stick_creeps_by_sigma_w_h_f() {
        // 10° with μ = 0.3 sticks; the depth is that of rest under g cos α, so that the motion is steady from the second step on.
        let scheme = scheme(1e4, 0.01);
        let (_, contact) = on_slope(&scheme, &SemiAnalyticPrimal, 10.0, [0.0; 4], 1);
        let (press, pull) = (G * 10f64.to_radians().cos(), G * 10f64.to_radians().sin());
        let start = [0.0, contact.rest_gap(press), 0.0, 0.0];
        for solver in [&SemiAnalyticPrimal as &dyn ContactSolver, &ProjectedGaussSeidel::default()] {
            let (run, _) = on_slope(&scheme, solver, 10.0, start, 100);
            let creep = run.last().velocity[0].abs();
            // v⁺ = (v + h g sin α) R_t/(1 + R_t): the transient falls by R_t ≈ 5e-4 a step
            let steady = contact.creep_speed(pull);
            assert!((creep / steady - 1.0).abs() <= 1e2 * solvers::STOP / (SIGMA * contact.diagonal_mean), "{creep:e} {steady:e}");
        }
    }

    #[test]
    fn a_sliding_block_is_lifted_as_the_associated_cone_says_until_it_leaves_the_ground() {
        // 30° with μ = 0.3 slides; k = 500 N/m carries it 17 mm deep, (h + τ) μ v reaches that at v = 2.3 m/s.
        let scheme = scheme(500.0, 0.02);
        let angle = 30f64.to_radians();
        let (_, contact) = on_slope(&scheme, &SemiAnalyticPrimal, 30.0, [0.0; 4], 1);
        let start = [0.0, contact.sliding_gap(0.0, G * angle.cos()), 0.0, 0.0];
        let (run, _) = on_slope(&scheme, &SemiAnalyticPrimal, 30.0, start, 200);
        let mut slides = 0;
        for (before, after) in run.samples.iter().zip(&run.samples[1..]).skip(20) {
            let force = (after.velocity[1] - before.velocity[1]) / H + G * angle.cos();
            if before.position[1] >= 0.0 {
                assert!(force.abs() <= rounding(64, G / H), "no force without depth");
                continue;
            }
            // the formula for the gap at the start of the step, with −(h + τ)u_n for what still moves
            let predicted = contact.sliding_gap(after.velocity[0].abs(), force) - (H + 0.02) * after.velocity[1];
            let terms = 0.3 * after.velocity[0].abs() + contact.normal_regularisation() * H * force + 1.0;
            assert!((predicted - before.position[1]).abs() <= 1e2 * solvers::STOP * terms, "{predicted} {}", before.position[1]);
            slides += 1;
        }
        assert!(slides > 20 && run.samples.iter().any(|state| state.position[1] > 0.0), "it slides, then hops");
    }

    #[test]
    fn what_can_be_no_material_is_refused() {
        assert!(Material::default().validate().is_ok());
        let wrong = |change: fn(&mut Material)| {
            let mut material = Material::default();
            change(&mut material);
            material.validate().is_err()
        };
        assert!(wrong(|material| material.stiffness = 0.0) && wrong(|material| material.stiction_tolerance = f64::NAN));
        assert!(wrong(|material| material.dissipation = -1.0) && wrong(|material| material.relaxation_time = f64::INFINITY));
    }
}
