//! The simulators of the chapter, one file per system: where each stands on the four axes, and what it was compared with.
//!
//! ```text
//!     u = W r + u_free ,   y = u + shift + R r ,   (r, y) in the contact law
//!
//!     level        what stands in y: u⁺ alone, u⁺ + φ/h, or (u⁺ − u)/h − a_ref
//!     cone         the set of impulses: round, or with d edges
//!     law          how r and y exclude each other: Coulomb, its convex relaxation, or either with R > 0
//!     algorithm    what solves it
//! ```
//! An [`Agreement`] is measured when asked: nothing here quotes a number.

mod anitescu;
mod bullet;
mod chrono;
mod drake;
mod event_driven;
mod explicit_euler;
mod generalised_alpha;
mod measured;
mod moreau_jean;
mod mujoco;
pub(crate) mod on_a_ball;
pub(crate) mod on_a_slope;
mod on_a_spring;
mod pinocchio;
mod planted;
mod position_based;
pub mod replay;
mod report;
mod runge_kutta_flip;
mod semi_implicit_euler;
mod siconos;
mod stewart_trinkle;
mod system;
mod theta;
mod variational;

pub use measured::Measured;
pub use planted::Measure;
pub use report::{AgreementReport, Report, SystemReport};
pub use system::{Agreement, Cone, ConstraintLevel, ContactLaw, System};

/// Every system, in the order of the chapter; a new one is one more line.
pub static ALL: &[&System] = &[
    &moreau_jean::SYSTEM,
    &stewart_trinkle::SYSTEM,
    &anitescu::SYSTEM,
    &chrono::SYSTEM,
    &bullet::SYSTEM,
    &pinocchio::SYSTEM,
    &mujoco::SYSTEM,
    &drake::SAP,
    &drake::SIMILAR,
    &drake::LAGGED,
    &drake::TAMSI,
    &explicit_euler::SYSTEM,
    &semi_implicit_euler::SYSTEM,
    &theta::SYSTEM,
    &runge_kutta_flip::SYSTEM,
    &siconos::SYSTEM,
    &generalised_alpha::SYSTEM,
    &position_based::SYSTEM,
    &event_driven::SYSTEM,
    &variational::SYSTEM,
];
