//! The step of Bullet: velocities after the forces, contact targets with Baumgarte's term and Newton's restitution, Coulomb friction.
//!
//! ```text
//!     M (v⁺ − v) = h F(q, v) + Hᵀ r ,     K_μ ∋ r ⟂ u⁺ + s n + μ‖u_t⁺‖n ∈ K_μ* ,     q⁺ = q + h (v⁺ + w) ,
//!     −s = ē |u_n| − d/h        while d = φ + slop > 0 ,
//!     −s = ē |u_n| − ERP d/h    afterwards ,          ē = e if u_n ≤ −v_t, and 0 below that threshold .
//! ```
//! Contacts take part up to the gap `margin`. Bullet solves the problem by at most 50 sweeps of [`SequentialImpulses`]. With that solver
//! the scheme takes Bullet's steps; with another solver it takes the steps of the law. A fixed point of the sweeps solves the law, with two
//! exceptions: D_t is not a multiple of the identity, or a boxed contact keeps friction after its normal impulse has come back to zero.
//!
//! **Two families of bodies**, and they step differently ([`Bodies`]). Multibodies, PyBullet's default: u_n = H v_free, the velocity after
//! the forces, so that an elastic ball gains g h in every impact; w = 0, whatever `useSplitImpulse` says. Rigid bodies: u_n = H v, before
//! the forces; and a contact deeper than d ≤ −4 cm is undone by *split impulses*, ERP left out of s and
//! ```text
//!     w = M⁻¹Hᵀp ,     0 ≤ p_n ⟂ (H w)_n + ERP d/h ≥ 0     at the deep contacts:
//! ```
//! the body moves without being given a velocity. Either way the depth shrinks by the factor 1 − ERP in every step.
//!
//! **Friction** ([`Friction`]) of multibodies is the round cone unless told otherwise, of rigid bodies always boxed: |r_t₁| ≤ μ r_n and
//! |r_t₂| ≤ μ r_n, each against its own slip. A box is the polyhedral law with four directions in tangents turned by 45° and with
//! √2 μ; which tangents, says `tangents.rs`. In the plane box and cone are one.
//!
//! # Energy
//! ```text
//!     T(v⁺) ≤ T(v_free) − Σ r_n s − ½ rᵀW r ,      multibodies: ΔẼ ≤ −Σ r_n s + h²FᵀM⁻¹F/8 ,   Ẽ = E + ½ h F·v
//! ```
//! For the law; the declared number of sweeps leaves a residual whose work comes on top. e on v_free gains g h in every elastic impact, and
//! split impulses move rigid bodies in V without a law ([`crate::energy_balance`]).

use moreau_contact::contact::{Components, Contact, Jacobian, pairs};
use moreau_contact::problem::{ContactProblem, Law};
use moreau_contact::solvers::{ContactSolver, ProjectedGaussSeidel};
use moreau_dynamics::schemes::assembly::{Candidate, Rules, normal_only};
use moreau_dynamics::schemes::{Scheme, StepContext, StepProblem, Waist, assembly, passes_the_waist};
use moreau_exact::{Error, Result};
use nalgebra::DVector;
use std::sync::Arc;

pub mod sequential_impulses;
pub mod steps;
mod tangents;

pub use sequential_impulses::SequentialImpulses;
pub use tangents::Bodies;

/// How friction of multibodies is bounded (`enableConeFriction`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Friction {
    /// ‖r_t‖ ≤ μ r_n.
    #[default]
    Cone,
    /// |r_t₁|, |r_t₂| ≤ μ r_n. Along the diagonals this allows √2 times as much friction.
    Pyramid,
}

/// Bullet's step with the parameters that PyBullet sets.
///
/// # Source
/// Bullet 3.25 and PyBullet 3.2.7, `btMultiBodyConstraintSolver::setupMultiBodyContactConstraint`,
/// `btSequentialImpulseConstraintSolver::setupContactConstraint`; chapter §10.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bullet {
    /// Multibodies or rigid bodies.
    pub bodies: Bodies,
    /// The cone of multibodies.
    pub friction: Friction,
    /// ERP of contacts (`contactERP`), the share of a depth that a step undoes.
    pub error_reduction: f64,
    /// `contactSlop` \[m\]: gaps are counted from this depth on.
    pub slop: f64,
    /// v_t \[m/s\]: slower contacts do not rebound.
    pub restitution_threshold: f64,
    /// Gap \[m\] up to which contacts take part: contact points of a sphere of radius R begin at 2 % of √3 R, half the diagonal of the cube
    /// around it, those between boxes where they overlap.
    pub margin: f64,
}

/// Share of half the diagonal of the box around a body (`contactBreakingThreshold`): from there on contact points begin, and once a point
/// has slid as far, it is dropped.
pub const BREAKING_THRESHOLD: f64 = 0.02;

/// d \[m\] at and below which rigid bodies are moved by split impulses.
pub const SPLIT_DEPTH: f64 = -0.04;

/// Gap \[m\] at which contact points of a sphere with this radius begin.
///
/// ```
/// use moreau_replicas::bullet::{Bullet, sphere_margin};
///
/// assert_eq!(Bullet::default().margin, sphere_margin(0.1));
/// assert!((sphere_margin(0.1) - 0.00346).abs() < 1e-5); // m: contacts begin 3.5 mm before they close
/// ```
pub fn sphere_margin(radius: f64) -> f64 {
    BREAKING_THRESHOLD * 3f64.sqrt() * radius
}

impl Default for Bullet {
    /// PyBullet's values, and the margin of a sphere of 0.1 m, 3.5 mm.
    fn default() -> Self {
        Bullet {
            bodies: Bodies::Multi,
            friction: Friction::Cone,
            error_reduction: 0.08,
            slop: 0.000_01,
            restitution_threshold: 0.2,
            margin: sphere_margin(0.1),
        }
    }
}

impl Bullet {
    /// Refuses negative parameters and an ERP above 1.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the field.
    pub fn validate(&self) -> Result<()> {
        let fields = [("slop", self.slop), ("restitution_threshold", self.restitution_threshold), ("margin", self.margin)];
        for (field, value) in fields {
            if !(value.is_finite() && value >= 0.0) {
                return Err(Error::invalid(field, format!("is {value}"), "use a number ≥ 0"));
            }
        }
        if !(0.0..=1.0).contains(&self.error_reduction) {
            return Err(Error::invalid("error_reduction", format!("is {}", self.error_reduction), "use a number from 0 to 1"));
        }
        Ok(())
    }

    /// Whether split impulses undo this contact's depth.
    fn is_split(&self, contact: &Contact) -> bool {
        self.bodies == Bodies::Rigid && contact.gap + self.slop <= SPLIT_DEPTH
    }

    /// Whether friction is bounded row by row.
    fn is_boxed(&self) -> bool {
        self.bodies == Bodies::Rigid || self.friction == Friction::Pyramid
    }

    /// w of the module's equations; zero without deep contacts \[m/s\].
    fn push(&self, at: &StepContext) -> Result<DVector<f64>> {
        let (mechanism, state) = (at.mechanism(), at.state());
        let deep: Vec<&Contact> = at.contacts().iter().filter(|contact| self.is_split(contact)).collect();
        let freedoms = mechanism.degrees_of_freedom();
        if deep.is_empty() {
            return Ok(DVector::zeros(freedoms));
        }
        let inertia = at.inertia()?;
        let normal = &[1.0, 0.0, 0.0][..mechanism.rows_per_contact()];
        let normals = Arc::new(Jacobian::new(1, freedoms, deep.iter().map(|contact| contact.jacobian.combined(&[normal])).collect()));
        let depths = deep.iter().map(|contact| self.error_reduction * (contact.gap + self.slop) / at.h());
        let problem = ContactProblem::from_free_velocity(&inertia, &normals, DVector::zeros(deep.len()))
            .name(format!("{} split impulse t={}", mechanism.name(), state.time))
            .law(Law::Frictionless)
            .rows_per_contact(1)
            .shift(DVector::from_iterator(deep.len(), depths))
            .bodies(pairs(&deep.iter().map(|contact| contact.place).collect::<Vec<_>>()))
            .build()?;
        let impulse = ProjectedGaussSeidel::accelerated().solve(&problem, None)?.impulse;
        Ok(inertia.solve(&normals.tr_mul(&impulse)))
    }
}

impl Rules for Bullet {
    fn is_active(&self, candidate: &Candidate, _h: f64) -> bool {
        candidate.contact.gap <= self.margin
    }

    fn shift(&self, candidate: &Candidate, h: f64) -> Components {
        let arriving = match self.bodies {
            Bodies::Multi => candidate.free_velocity[0],
            Bodies::Rigid => candidate.velocity[0],
        };
        let rebound = if arriving <= -self.restitution_threshold { -candidate.contact.restitution * arriving } else { 0.0 };
        let distance = candidate.contact.gap + self.slop;
        let positional = match () {
            () if distance > 0.0 => distance / h,
            () if self.is_split(candidate.contact) => 0.0,
            () => self.error_reduction * distance / h,
        };
        normal_only(positional - rebound, candidate.velocity.len())
    }

    fn law(&self, rows_per_contact: usize) -> Law {
        match rows_per_contact {
            1 => Law::Frictionless,
            3 if self.is_boxed() => Law::PolyhedralCoulomb { directions: 4 },
            _ => Law::Coulomb,
        }
    }
}

impl Scheme for Bullet {
    fn name(&self) -> String {
        let bodies = if self.bodies == Bodies::Multi { "multi" } else { "rigid" };
        let friction = if self.is_boxed() { "pyramid" } else { "cone" };
        format!("bullet bodies={bodies} friction={friction} erp={} slop={} margin={}", self.error_reduction, self.slop, self.margin)
    }

    fn is_truncated(&self) -> bool {
        true
    }

    passes_the_waist!();
}

impl Waist for Bullet {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        self.validate()?;
        let mut assembled = assembly::assemble("bullet", self, at)?;
        tangents::turn(&mut assembled, self.bodies, self.is_boxed())?;
        // here an error can be told, in `advance` it cannot
        self.push(at)?;
        Ok(assembled)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        let moved = match self.push(at) {
            Ok(push) => velocity_post + push,
            Err(_) => velocity_post.clone(), // `assemble` has refused the step
        };
        at.mechanism().integrate(&at.state().position, &moved, at.h())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_contact::tolerance::solvers;
    use moreau_dynamics::mechanics::{Mechanism, PointMass, State};
    use moreau_dynamics::schemes::step;
    use moreau_exact::tolerance::rounding;
    use nalgebra::dvector;

    fn run(scheme: &Bullet, mechanism: &dyn Mechanism, position: DVector<f64>, velocity: DVector<f64>, h: f64, steps: usize) -> Vec<State> {
        let mut states = vec![State { time: 0.0, position, velocity }];
        for k in 0..steps {
            states.push(step(scheme, &ProjectedGaussSeidel::default(), mechanism, &states[k], h).expect("one contact").state);
        }
        states
    }

    fn ball(restitution: f64) -> PointMass {
        PointMass::ball_on_floor(1.0, 9.81, restitution)
    }

    #[test]
    fn a_depth_shrinks_by_one_minus_erp_in_every_step_as_long_as_that_outruns_gravity() {
        let (scheme, h) = (Bullet::default(), 1.0 / 64.0);
        let states = run(&scheme, &ball(0.0), dvector![-0.01], dvector![0.0], h, 20);
        for (k, state) in states.iter().enumerate() {
            let expected = -scheme.slop + (scheme.slop - 0.01) * (1.0 - 0.08_f64).powi(k as i32);
            assert!((state.position[0] - expected).abs() <= rounding(16 * (k + 1), 0.02), "step {k}: {}", state.position[0]);
        }
        // the ball keeps the velocity that pushed it: ERP d/h
        assert!((states[1].velocity[0] - 0.08 * (0.01 - scheme.slop) / h).abs() <= rounding(16, 0.1));
    }

    #[test]
    fn split_impulses_move_a_deep_rigid_body_without_a_velocity_and_multibodies_have_none() {
        let h = 1.0 / 240.0;
        let rigid = Bullet { bodies: Bodies::Rigid, ..Bullet::default() };
        let states = run(&rigid, &ball(0.0), dvector![-0.06], dvector![0.0], h, 5);
        for (k, state) in states.iter().enumerate() {
            let expected = -rigid.slop + (rigid.slop - 0.06) * (1.0 - 0.08_f64).powi(k as i32);
            assert!((state.position[0] - expected).abs() <= rounding(32 * (k + 1), 0.06), "step {k}: {}", state.position[0]);
            // the sweeps stop at STOP of the impulse m g h
            assert!(state.velocity[0].abs() <= 2.0 * solvers::STOP * 9.81 * h, "step {k}: {}", state.velocity[0]);
        }
        let multi = run(&Bullet::default(), &ball(0.0), dvector![-0.06], dvector![0.0], h, 1);
        assert!((multi[1].velocity[0] - 0.08 * (0.06 - rigid.slop) / h).abs() <= rounding(16, 2.0));
    }

    #[test]
    fn restitution_looks_at_the_velocity_after_or_before_the_forces_and_a_gap_is_taken_off() {
        let (h, slop) = (1.0 / 64.0, Bullet::default().slop);
        let rebound = |bodies, gap: f64, speed: f64| {
            let scheme = Bullet { bodies, ..Bullet::default() };
            run(&scheme, &ball(0.5), dvector![gap], dvector![-speed], h, 1)[1].velocity[0]
        };
        let close = |value: f64, expected: f64| assert!((value - expected).abs() <= rounding(32, 4.0), "{value} against {expected}");
        close(rebound(Bodies::Multi, 0.001, 4.0), 0.5 * (4.0 + 9.81 * h) - (0.001 + slop) / h);
        close(rebound(Bodies::Rigid, 0.001, 4.0), 0.5 * 4.0 - (0.001 + slop) / h);
        close(rebound(Bodies::Multi, -0.001, 4.0), 0.5 * (4.0 + 9.81 * h) + 0.08 * (0.001 - slop) / h);
        // below the threshold nothing rebounds, beyond the margin nothing acts
        close(rebound(Bodies::Rigid, -slop, 0.199), 0.0);
        close(rebound(Bodies::Rigid, -slop, 0.2), 0.1);
        close(rebound(Bodies::Multi, 0.0035, 0.01), -0.01 - 9.81 * h);
    }

    /// What one step takes off the speed of a block that slides on the level in this direction.
    fn braked(scheme: &Bullet, slip: [f64; 2]) -> [f64; 2] {
        let floor = moreau_dynamics::mechanics::Plane::new(dvector![0.0, 0.0, 1.0], 0.0, 0.25, 0.0).expect("a unit normal");
        let point = PointMass::new("block", 1.0, dvector![0.0, 0.0, -9.81], vec![floor]).expect("valid");
        let state = run(scheme, &point, dvector![0.0, 0.0, -scheme.slop], dvector![slip[0], slip[1], 0.0], 1.0 / 64.0, 1).swap_remove(1);
        [slip[0] - state.velocity[0], slip[1] - state.velocity[1]]
    }

    #[test]
    fn under_the_pyramid_a_block_is_braked_by_mu_g_along_an_axis_and_by_sqrt_2_mu_g_along_a_diagonal() {
        let (speed, brake) = (3.0, 0.25 * 9.81 / 64.0);
        let cone = Bullet::default();
        let pyramid = Bullet { friction: Friction::Pyramid, ..cone };
        let rigid = Bullet { bodies: Bodies::Rigid, ..cone };
        let close = |found: [f64; 2], expected: [f64; 2]| {
            assert!((0..2).all(|i| (found[i] - expected[i]).abs() <= rounding(256, speed)), "{found:?} against {expected:?}");
        };
        for scheme in [cone, pyramid, rigid] {
            close(braked(&scheme, [speed, 0.0]), [brake, 0.0]);
        }
        close(braked(&pyramid, [0.6 * speed, 0.8 * speed]), [brake, brake]);
        // rigid bodies lay their box along the slip, and then it is Coulomb's cone
        for scheme in [cone, rigid] {
            close(braked(&scheme, [0.6 * speed, 0.8 * speed]), [0.6 * brake, 0.8 * brake]);
        }
    }

    #[test]
    fn parameters_that_cannot_be_meant_are_refused() {
        for scheme in [Bullet { error_reduction: 1.5, ..Bullet::default() }, Bullet { slop: -1.0, ..Bullet::default() }] {
            assert!(scheme.validate().is_err());
        }
    }
}
