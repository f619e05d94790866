//! The step of Project Chrono's nonsmooth contacts (NSC): Anitescu's, with a bound on how fast a penetration is undone, and with rebounds.
//!
//! ```text
//!     M (v⁺ − v) = h F(q, v) + Hᵀ r ,     K_μ ∋ r ⟂ u⁺ + s n ∈ K_μ* ,     q⁺ = q + h v⁺ ,
//!     s = e u_n        where the contact rebounds: e u_n < −v_b and φ + h e u_n < 0 ,
//!     s = max(φ/h, −v_r)   elsewhere .
//! ```
//! u_n is the velocity at the start of the step. v_r is the maximal recovery speed: a resting body of depth d comes out at v_r, whatever
//! its load, so that its depth is d − k h v_r after k steps as long as that is positive; it leaves the ground with that speed and hops
//! v_r²/2g. v_b is the speed below which nothing rebounds. Without penetration and restitution the step is
//! [`moreau_dynamics::schemes::anitescu`]'s, bit for bit, with the same gap φ = μ h ‖u_t‖ of a slide.
//!
//! Chrono lists `PSOR`, `BARZILAIBORWEIN`, `APGD` and `ADMM` as solvers of this problem, here `psor`, `bb`, `apgd` and `admm`.
//!
//! # Energy
//! ```text
//!     T(v⁺) ≤ T(v_free) − Σ r_n s − ½ rᵀW r ,      ΔẼ ≤ −Σ r_n s + h²FᵀM⁻¹F/8 ,   Ẽ = E + ½ h F·v
//! ```
//! A depth gives back at most v_r r_n, a rebound e |u_n| r_n ([`crate::energy_balance`]).

use moreau_contact::contact::Components;
use moreau_contact::problem::Law;
use moreau_dynamics::schemes::assembly::{Candidate, Rules, normal_only};
use moreau_dynamics::schemes::{Scheme, StepContext, StepProblem, Waist, assembly, passes_the_waist};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Chrono's cone complementarity step with its position stabilisation.
///
/// # Source
/// Project Chrono, commit 7689fbc: `ChContactNSC::ContIntLoadConstraint_C`, `ChTimestepperEulerImplicitLinearized`; chapter §5 and §10.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chrono {
    /// v_r \[m/s\], the largest speed at which a penetration is undone.
    pub recovery_speed: f64,
    /// v_b \[m/s\], the rebound speed below which an impact is plastic.
    pub bounce_speed: f64,
}

impl Default for Chrono {
    /// v_r = 0.6 m/s as Chrono sets it, and v_b = 0.15 m/s; Chrono's container leaves v_b to the user.
    fn default() -> Self {
        Chrono { recovery_speed: 0.6, bounce_speed: 0.15 }
    }
}

impl Chrono {
    /// Refuses speeds that are not positive numbers or, for the bound, infinite.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the field.
    pub fn validate(&self) -> Result<()> {
        for (field, value) in [("recovery_speed", self.recovery_speed), ("bounce_speed", self.bounce_speed)] {
            if value.is_nan() || value < 0.0 {
                return Err(Error::invalid(field, format!("is {value}"), "use a speed ≥ 0 in m/s"));
            }
        }
        Ok(())
    }
}

impl Rules for Chrono {
    fn shift(&self, candidate: &Candidate, h: f64) -> Components {
        let gap = candidate.contact.gap;
        let reversed = candidate.contact.restitution * candidate.velocity[0];
        let rebounds = reversed < -self.bounce_speed && gap + h * reversed < 0.0;
        normal_only(if rebounds { reversed } else { (gap / h).max(-self.recovery_speed) }, candidate.velocity.len())
    }

    fn law(&self, rows_per_contact: usize) -> Law {
        if rows_per_contact == 1 { Law::Frictionless } else { Law::Associated }
    }
}

impl Scheme for Chrono {
    fn name(&self) -> String {
        format!("chrono recovery={} bounce={}", self.recovery_speed, self.bounce_speed)
    }

    passes_the_waist!();
}

impl Waist for Chrono {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        self.validate()?;
        assembly::assemble("chrono", self, at)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        at.mechanism().integrate(&at.state().position, velocity_post, at.h())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_contact::solvers;
    use moreau_contact::solvers::{ContactSolver, ProjectedGaussSeidel};
    use moreau_contact::tolerance::solvers as tolerance;
    use moreau_dynamics::mechanics::{Mechanism, PointMass, State};
    use moreau_dynamics::schemes::{Anitescu, step};
    use moreau_exact::tolerance::rounding;
    use nalgebra::dvector;

    const SLOPE: f64 = 20.0;

    fn incline(friction: f64) -> PointMass {
        PointMass::block_on_incline(1.0, 9.81, SLOPE.to_radians(), friction, 0.0)
    }

    fn run(scheme: &dyn Scheme, solver: &dyn ContactSolver, mechanism: &dyn Mechanism, mut state: State, h: f64, steps: usize) -> State {
        for _ in 0..steps {
            state = step(scheme, solver, mechanism, &state, h).expect("one contact").state;
        }
        state
    }

    #[test]
    fn a_penetration_is_undone_at_the_recovery_speed_and_no_faster() {
        let (depth, h) = (0.1, 1.0 / 64.0);
        let ball = PointMass::ball_on_floor(1.0, 9.81, 0.0);
        let start = State { time: 0.0, position: dvector![-depth], velocity: dvector![0.0] };
        // 0.1 m are 10.67 steps of 0.6 m/s: the last one is free and keeps its speed but for gravity
        for steps in 1..=11 {
            let now = run(&Chrono::default(), &ProjectedGaussSeidel::default(), &ball, start.clone(), h, steps);
            let fallen = if steps > 10 { 9.81 * h } else { 0.0 };
            let expected = -depth + steps as f64 * h * 0.6 - h * fallen;
            assert!((now.position[0] - expected).abs() <= rounding(16 * steps, depth), "step {steps}: {}", now.position[0]);
            assert!((now.velocity[0] - (0.6 - fallen)).abs() <= rounding(16, 1.0), "step {steps}: {}", now.velocity[0]);
        }
        // Anitescu's step undoes it at once, with 6.4 m/s
        let at_once = run(&Anitescu, &ProjectedGaussSeidel::default(), &ball, start, h, 1);
        assert!((at_once.velocity[0] - depth / h).abs() <= rounding(16, 10.0));
    }

    #[test]
    fn every_solver_of_chrono_slides_with_the_gap_mu_h_v_and_sticks_without_creep() {
        let h = 0.005;
        for name in ["psor", "bb", "apgd", "admm"] {
            let solver = solvers::Solvers::own().by_name(name).expect("a listed name");
            let rest = || State { time: 0.0, position: dvector![0.0, 0.0], velocity: dvector![0.0, 0.0] };
            let sliding = run(&Chrono::default(), solver.as_ref(), &incline(0.2), rest(), h, 40);
            let gap = 0.2 * h * sliding.velocity[0].abs();
            assert!(gap > 0.0 && (sliding.position[1] - gap).abs() <= 40.0 * tolerance::STOP * gap, "{name}: {}", sliding.position[1]);
            let stuck = run(&Chrono::default(), solver.as_ref(), &incline(0.5), rest(), h, 40);
            // each step leaves at most STOP of its data, h g
            assert!(stuck.velocity.amax() <= 2.0 * tolerance::STOP * h * 9.81, "{name}: {}", stuck.velocity);
            assert!(stuck.position.amax() <= 80.0 * tolerance::STOP * h * h * 9.81, "{name}: {}", stuck.position);
        }
    }

    #[test]
    fn without_restitution_and_penetration_it_is_anitescu_s_step_bit_for_bit() {
        let solver = ProjectedGaussSeidel::default();
        let start = State { time: 0.0, position: dvector![0.0, 0.25], velocity: dvector![1.0, -1.0] };
        for steps in [1, 10, 40, 80] {
            let ours = run(&Chrono::default(), &solver, &incline(0.2), start.clone(), 0.01, steps);
            assert_eq!(ours, run(&Anitescu, &solver, &incline(0.2), start.clone(), 0.01, steps));
        }
    }

    #[test]
    fn a_fast_impact_rebounds_with_e_times_the_speed_before_it_and_a_slow_one_does_not() {
        let ball = PointMass::ball_on_floor(1.0, 9.81, 0.5);
        let after = |speed: f64| {
            let state = State { time: 0.0, position: dvector![0.0], velocity: dvector![-speed] };
            step(&Chrono::default(), &ProjectedGaussSeidel::default(), &ball, &state, 0.01).expect("one contact").state.velocity[0]
        };
        assert!((after(1.0) - 0.5).abs() <= rounding(8, 1.0));
        // e u_n = −0.15 is not beyond v_b
        assert!(after(0.3).abs() <= rounding(8, 1.0));
        assert!((after(0.301) - 0.1505).abs() <= rounding(8, 1.0));
    }

    #[test]
    fn negative_speeds_are_refused() {
        for scheme in [Chrono { recovery_speed: -1.0, ..Chrono::default() }, Chrono { bounce_speed: f64::NAN, ..Chrono::default() }] {
            assert!(scheme.validate().expect_err("refused").to_string().contains("_speed"));
        }
    }
}
