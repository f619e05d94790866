//! Position-based dynamics, PBD and XPBD: positions are predicted, pushed out contact by contact, and velocities read off them.
//!
//! ```text
//!     q̃ = q + h v_free ,   v_free = v + h M⁻¹F
//!     k sweeps over the contacts:   ΔΛ_n = max(−Λ_n, −(φ + α̃ Λ_n)/(w_n + α̃)) ,   Λ_t projected on |Λ_t| ≤ μΛ_n ,   q ← q + M⁻¹Hᵀ ΔΛ
//!     α̃ = α/h² (XPBD);   PBD: α = 0 and the share s of ΔΛ
//!     v = (q⁺ − q)/h ,   then at contacts with Λ_n > 0:   u_n ← max(−e ũ_n, 0) ,  ũ = H v_free ,  e = 0 below |ũ_n| = 2h|H M⁻¹F|_n
//! ```
//! In impulses r = Λ/h the position problem is the one of [`PositionBased::position_problem`]: u = W r + u_free, y = u + φ/h + R r with
//! R = α/h² on normals and a friction cone in tangential displacement. A sweep of XPBD is a sweep of Gauss–Seidel on it, with gaps taken
//! anew at each contact. Which candidates there are may change while the bodies are pushed: see `position_based/sweeps.rs`.
//!
//! # Energy
//! ```text
//!     no theorem:   v = (q⁺ − q)/h   takes every correction of a position for a velocity
//! ```
//! Sweeps project onto gaps that are taken anew, one contact at a time, and end after a declared number: neither T(v⁺) nor E has a bound
//! (`moreau::checks::energy_balance`).

use super::assembly::stack;
use super::{Certified, Scheme, Start, Step, StepContext, StepProblem};
use crate::mechanics::State;
use crate::tolerance::limits::SWEEPS;
use moreau_contact::contact::{ContactImpulse, pairs};
use moreau_contact::problem::{Compliance, ContactProblem, Coordinates, Law};
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use sweeps::{Held, Positions};

mod sweeps;

/// The search for candidates reaches this many times the distance that the free motion can close in a step. It reaches farther if the
/// pushes of a sweep come near that distance.
const SPARE: f64 = 4.0;

/// What makes a contact soft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Softness {
    /// α \[m/N\] of XPBD.
    Compliance(f64),
    /// s ∈ (0, 1\] of PBD.
    Share(f64),
}

/// Position-based dynamics.
///
/// # Source
/// Müller et al. (2007); Macklin, Müller and Chentanez (2016); Müller et al. (2020). Friction is projected with the positions, static and
/// dynamic alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionBased {
    /// What makes a contact soft.
    pub softness: Softness,
    /// k.
    pub sweeps: usize,
}

impl PositionBased {
    /// XPBD with hard contacts and twenty sweeps.
    pub const XPBD: PositionBased = PositionBased { softness: Softness::Compliance(0.0), sweeps: 20 };
    /// PBD with the share ½ and ten sweeps.
    pub const PBD: PositionBased = PositionBased { softness: Softness::Share(0.5), sweeps: 10 };

    /// Checks that α ≥ 0, s ∈ (0, 1\] and 1 ≤ k ≤ [`SWEEPS`].
    ///
    /// # Errors
    /// [`Error::Invalid`] otherwise.
    pub fn validate(&self) -> Result<()> {
        match self.softness {
            Softness::Compliance(alpha) if !(alpha.is_finite() && alpha >= 0.0) => {
                Err(Error::invalid("compliance", format!("is {alpha}"), "use a finite α ≥ 0"))
            }
            Softness::Share(share) if !(share > 0.0 && share <= 1.0) => {
                Err(Error::invalid("share", format!("is {share}"), "use s above 0 and at most 1"))
            }
            _ if !(1..=SWEEPS).contains(&self.sweeps) => {
                Err(Error::invalid("sweeps", format!("is {}", self.sweeps), format!("use a whole number from 1 to {SWEEPS}")))
            }
            _ => Ok(()),
        }
    }

    /// α̃ and the share of each correction.
    fn weights(&self, h: f64) -> [f64; 2] {
        match self.softness {
            Softness::Compliance(alpha) => [alpha / (h * h), 1.0],
            Softness::Share(share) => [0.0, share],
        }
    }
}

impl Scheme for PositionBased {
    fn name(&self) -> String {
        match self.softness {
            Softness::Compliance(alpha) => format!("xpbd α={alpha} sweeps={}", self.sweeps),
            Softness::Share(share) => format!("pbd s={share} sweeps={}", self.sweeps),
        }
    }

    fn is_truncated(&self) -> bool {
        true
    }

    fn step(&self, _solver: &Certified, start: &Start) -> Result<Step> {
        self.swept(&StepContext::new(start.mechanism, start.state, start.h)?)
    }
}

impl PositionBased {
    /// The position problem with the gaps linearised at q, as impulses: what the sweeps of XPBD tend to.
    ///
    /// # Errors
    /// If M is not positive definite.
    pub fn position_problem(&self, at: &StepContext) -> Result<Option<ContactProblem>> {
        let (mechanism, state, h) = (at.mechanism(), at.state(), at.h());
        let (free_velocity, inertia, contacts) = (at.forecast()?, at.inertia()?, at.contacts());
        let rows = mechanism.rows_per_contact();
        let jacobian = stack(contacts.iter(), rows, state.velocity.len());
        let mut shift = DVector::zeros(rows * contacts.len());
        for (k, contact) in contacts.iter().enumerate() {
            shift[k * rows] = contact.gap / h;
        }
        let [scaled, _] = self.weights(h);
        let diagonal = DVector::from_fn(rows * contacts.len(), |row, _| if row % rows == 0 { scaled } else { 0.0 });
        let places: Vec<_> = contacts.iter().map(|contact| contact.place).collect();
        let problem = ContactProblem::from_inertia(&inertia, &jacobian, free_velocity)
            .name(format!("{} {} t={}", mechanism.name(), self.name(), state.time))
            .law(if rows == 1 { Law::Frictionless } else { Law::Coulomb })
            .rows_per_contact(rows)
            .friction(contacts.iter().map(|contact| contact.friction).collect())
            .shift(shift)
            .compliance((scaled > 0.0).then_some(Compliance { coordinates: Coordinates::Contact, diagonal }))
            .bodies(pairs(&places))
            .build()?;
        Ok((!contacts.is_empty()).then_some(problem))
    }

    fn swept(&self, at: &StepContext) -> Result<Step> {
        let (mechanism, state, h) = (at.mechanism(), at.state(), at.h());
        let (free, inertia) = (at.forecast()?, at.inertia()?);
        let pull = inertia.solve(&mechanism.force(&state.position, &state.velocity));
        let predicted = mechanism.integrate(&state.position, free, h);
        let start = Positions::new(mechanism, inertia.factor(), predicted, free * h);
        let done = start.swept(self.sweeps, self.weights(h), SPARE * mechanism.reach(free, h))?;
        let residual = done.residual(self.weights(h)[0], SPARE * mechanism.reach(free, h));
        let mut velocity = &done.motion / h;
        let impulses = bounce(&done, free, &pull, h, &mut velocity);
        let assembled = StepProblem {
            problem: None,
            residual: None,
            rejected: None,
            active: impulses.iter().map(|one| one.contact).collect(),
            places: impulses.iter().map(|one| one.place).collect(),
            effective_mass: inertia.clone(),
            free_velocity: free.clone(),
            jacobian: stack([].into_iter(), mechanism.rows_per_contact(), velocity.len()),
        };
        let state = State { time: state.time + h, position: done.position, velocity };
        Ok(Step { state, impulses, assembled, solution: None, residual, rejected: None, impacts: None })
    }
}

/// The velocity pass, and the impulses of the contacts that carried one: of those that are candidates still in their order, then of those
/// that are none any more.
fn bounce(done: &Positions, free: &DVector<f64>, pull: &DVector<f64>, h: f64, velocity: &mut DVector<f64>) -> Vec<ContactImpulse> {
    let (present, gone) = done.carrying();
    let of = |held: &Held| ContactImpulse {
        contact: held.identity.index,
        impulse: (&held.multiplier / h).as_slice().into(),
        place: held.identity.place,
    };
    let mut impulses = Vec::new();
    for (contact, held) in &present {
        let direction = contact.jacobian.row(0).transpose();
        let (arriving, speed) = (direction.dot(free), direction.dot(velocity));
        let slow = 2.0 * h * direction.dot(pull).abs();
        let target = if arriving.abs() <= slow { 0.0 } else { (-contact.restitution * arriving).max(0.0) };
        let impulse = (target - speed) / done.weight(contact, 0);
        let mut total = of(held);
        total.impulse[0] += impulse;
        impulses.push(total);
        *velocity += done.factor.solve(&(direction * impulse));
    }
    impulses.extend(gone.iter().map(of));
    impulses
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{BallChain, PointMass};
    use crate::scenes::Scene;
    use crate::schemes::{simulate, step};
    use moreau_contact::solvers::{Auto, ContactSolver, ProjectedGaussSeidel};
    use moreau_exact::tolerance::rounding;
    use moreau_forms::PositionBasedContact;
    use nalgebra::dvector;

    fn at(position: f64, velocity: f64) -> State {
        State { time: 0.0, position: dvector![position], velocity: dvector![velocity] }
    }

    fn xpbd(compliance: f64) -> PositionBased {
        PositionBased { softness: Softness::Compliance(compliance), sweeps: 20 }
    }

    fn settle(scheme: PositionBased, h: f64) -> f64 {
        let ball = PointMass::ball_on_floor(2.0, 9.81, 0.0);
        simulate(&scheme, &Auto, &ball, at(0.0, 0.0), h, 4000).expect("valid").last().position[0]
    }

    #[test]
    fn the_rest_depth_of_xpbd_is_that_of_its_compliance_at_every_step_and_pbds_is_not() {
        for h in [0.01, 0.0025] {
            let exact = PositionBasedContact { mass: 2.0, gravity: 9.81, time_step: h };
            let depth = exact.rest_depth_of_compliance(1e-4);
            assert!((settle(xpbd(1e-4), h) + depth).abs() <= rounding(512, depth), "h = {h}");
            for sweeps in [1, 3] {
                let depth = exact.rest_depth_of_share(0.5, sweeps);
                let found = settle(PositionBased { softness: Softness::Share(0.5), sweeps: sweeps as usize }, h);
                assert!((found + depth).abs() <= rounding(512, depth), "h = {h}, {sweeps} sweeps: {found} {depth}");
            }
        }
    }

    #[test]
    fn a_landing_and_a_rebound_are_those_of_the_closed_form() {
        let (h, e) = (0.0625, 0.5);
        let exact = PositionBasedContact { mass: 2.0, gravity: 10.0, time_step: h };
        let ball = PointMass::ball_on_floor(2.0, 10.0, e);
        for (gap, speed) in [(0.05, -2.0), (0.02, -0.5), (-0.01, -1.0)] {
            for compliance in [0.0, 1e-3] {
                let after = step(&xpbd(compliance), &Auto, &ball, &at(gap, speed), h).expect("valid").state;
                assert!((after.position[0] - exact.landing(compliance, gap, speed).0).abs() <= rounding(64, 1.0));
                assert!((after.velocity[0] - exact.rebound(e, speed)).abs() <= rounding(64, 4.0), "{gap} {speed}: {after:?}");
            }
        }
    }

    #[test]
    fn the_sweeps_tend_to_the_solution_of_the_assembled_problem() {
        let chain = BallChain::new(vec![1.0, 2.0, 0.5], vec![0.1; 3], 0.0).expect("valid");
        let start = State { time: 0.0, position: dvector![0.0, 0.21, 0.42], velocity: dvector![3.0, 0.0, -1.0] };
        let (scheme, h) = (PositionBased { sweeps: 400, ..xpbd(1e-4) }, 0.0625);
        let problem = scheme.position_problem(&StepContext::new(&chain, &start, h).expect("valid")).expect("valid").expect("contacts");
        let solved = ProjectedGaussSeidel::default().solve(&problem, None).expect("solvable").impulse;
        let taken = step(&scheme, &Auto, &chain, &start, h).expect("valid");
        // positions first: the impulses of the velocity pass are taken out again
        let moved = (&taken.state.position - &start.position) / h;
        let jacobian = &problem.dynamics().expect("given").jacobian;
        let expected = problem.free_velocity() + problem.dense() * &solved;
        assert!((jacobian * moved - expected).amax() <= 1e-10);
    }

    #[test]
    fn a_block_sticks_or_slides_down_its_slope() {
        let angle = 0.35f64;
        for (friction, expected) in [(0.5, 0.0), (0.3, 9.81 * (angle.sin() - 0.3 * angle.cos()))] {
            let block = PointMass::block_on_incline(2.0, 9.81, angle, friction, 0.0);
            let start = State { time: 0.0, position: dvector![0.0, 0.0], velocity: dvector![0.0, 0.0] };
            let end = simulate(&PositionBased::XPBD, &Auto, &block, start, 0.01, 100).expect("valid");
            assert!((end.last().velocity[0] - expected).abs() <= rounding(100 * 64, 10.0), "μ = {friction}: {}", end.last().velocity[0]);
        }
    }

    /// A unit box of side 0.2 m that has come to lie flat, and one above it that lands on an edge and rolls over it: `twobox_edge`.
    const LANDING_ON_AN_EDGE: &str = r#"{"schema": "scene/1", "name": "landing-on-an-edge", "gravity": [0, 0, -9.81], "duration": 0.25,
        "bodies": [
            {"name": "a", "mass": 1, "position": [0, 0, 0.1], "box": {"half_extents": [0.1, 0.1, 0.1]}, "linear_velocity": [0, 0, 0],
             "angular_velocity": [0, 0, 0]},
            {"name": "b", "mass": 1, "position": [0, 0, 0.45], "box": {"half_extents": [0.1, 0.1, 0.1]}, "linear_velocity": [0, 0, 0],
             "angular_velocity": [0, 0, 0], "orientation": [0.9238795325112867, 0.3826834323650898, 0, 0]}],
        "material": {"friction": 0.5, "restitution": 0.0}, "ground": {"normal": [0, 0, 1], "offset": 0.0}}"#;

    #[test]
    fn the_candidates_of_a_box_that_lands_on_an_edge_change_within_a_sweep() {
        let (mechanism, start) = Scene::from_json(LANDING_ON_AN_EDGE).and_then(|scene| scene.spatial_mechanism()).expect("two boxes");
        for scheme in [PositionBased::XPBD, PositionBased::PBD] {
            let end = simulate(&scheme, &Auto, mechanism.as_ref(), start.clone(), 0.005, 50).expect("no panic").last().clone();
            assert!(mechanism.energy(&end) <= mechanism.energy(&start), "{}: {end:?}", scheme.name());
            // neither box has fallen through the other or through the floor, up to what a step of 5 ms penetrates
            assert!(end.position[2] > 0.09 && end.position[9] > 0.28, "{}: {end:?}", scheme.name());
        }
    }

    #[test]
    fn parameters_that_cannot_be_meant_are_refused() {
        assert!(PositionBased { sweeps: SWEEPS, ..PositionBased::PBD }.validate().is_ok());
        let message = PositionBased { sweeps: SWEEPS + 1, ..PositionBased::PBD }.validate().expect_err("too many").to_string();
        assert!(message.contains("from 1 to 10000"), "{message}");
        assert!(xpbd(-1.0).validate().is_err() && PositionBased { sweeps: 0, ..PositionBased::PBD }.validate().is_err());
        assert!(PositionBased::XPBD.validate().is_ok() && PositionBased { softness: Softness::Share(1.5), sweeps: 1 }.validate().is_err());
    }
}
