//! **moreau** – proofs-as-tests for contact time-stepping.
//!
//! Contact dynamics is a measure differential inclusion,
//!
//! ```text
//!     −M(q) dv + F(t, q, v) dt ∈ N_{T_C(q)}(v⁺) dμ ,
//! ```
//!
//! and every simulator discretises it somehow. This crate makes the statements of the theory executable:
//! claims of a textbook chapter get a verdict with evidence ([`claims`]), contact problems get solutions from
//! several algorithms ([`solvers`]) and a certificate that knows none of them ([`certificate`]), and every check is
//! shown to catch the mistake it exists for ([`defects`]).
//!
//! # The narrow waist
//! ```text
//! Mechanism ──► Scheme ──► ContactProblem ──► Solver ──► Solution + Certificate ──► Recording ──► Check ──► Verdict
//! M, F, φ, H    one step    W, u_free, μ, law   impulses r      residuals with units    metrics
//! ```
//! One step of most schemes (`docs/waist.md` names the others) solves, for the impulses `r` \[N·s\] and the contact velocities `u` \[m/s\],
//! ```text
//!     u = W r + u_free ,    y = u + shift + R r ,    (r, y) in the contact law .
//! ```
//! Symbols, units, signs and component order: [`conventions`].
//!
//! # Crates
//! This crate is the top of a workspace and re-exports what is below it: [`moreau_contact`] poses, solves and certifies contact problems
//! ([`solvers`], [`certificate`]), [`moreau_dynamics`] has mechanisms, scenes and the schemes of the literature, [`moreau_replicas`] the
//! engines', [`moreau_gate`] judges engines from outside, [`moreau_checks`] has the families of checks, [`moreau_forms`] the closed forms
//! ([`closed_forms`]), [`moreau_exact`] the numbers.
//!
//! # Three ways in
//! Solve a contact problem and certify the answer: a block of 1 kg arrives at 1 m/s, slides at 2 m/s, μ = ½.
//! ```
//! use moreau::nalgebra::{self, DMatrix, dvector}; // the macro writes `nalgebra::`
//! use moreau::prelude::*;
//!
//! let problem = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0])
//!     .name("block")
//!     .law(Law::Coulomb)
//!     .rows_per_contact(2)
//!     .friction(vec![0.5])
//!     .build()?;
//! let answer = Auto.solve(&problem, None)?;
//! assert!(residuals(&problem, &answer)?.is_solution(1e-8)); // r = (1, −½) N·s, u = (0, 3/2) m/s
//! # Ok::<(), moreau::Error>(())
//! ```
//! Simulate a scene, here the ball that has come to rest after infinitely many bounces:
//! ```
//! use moreau::{scenes, schemes, solvers};
//!
//! let (mechanism, start) = scenes::named("bouncing-ball")?.mechanism()?;
//! let scheme = schemes::MoreauJean::default();
//! let run = schemes::simulate(&scheme, &solvers::Auto, mechanism.as_ref(), start, 1e-3, 2000)?;
//! assert!(run.last().velocity.amax() < 1e-9);
//! # Ok::<(), moreau::Error>(())
//! ```
//! Run a claim with its control:
//! ```
//! use moreau::claims::{self, Status, ClaimVerdict};
//!
//! let claim = claims::find("S4.copos-plus").expect("registered");
//! let outcome = claims::judge(claim);
//! assert_eq!((claim.verdict, outcome.status), (ClaimVerdict::False, Status::Supported));
//! println!("{}: {}", outcome.findings[0].name, claim.correct_statement());
//! ```

pub mod board;
pub mod checks;
pub mod claims;
pub mod cli;
pub mod defects;
pub mod gate;
pub mod matrix;
pub mod prelude;
pub mod problems;
pub mod report;
pub mod schemes;
pub mod solvers;
pub mod stored;
pub mod tolerance;

pub use moreau_contact::{ContactProblem, Law, Solution, certificate, cones, contact, conventions, files, memory, problem};
pub use moreau_dynamics::{
    elastic_bar, event_driven, exact_particle, impact_laws, integrators, mechanics, scenes, stabilisation, trajectory,
};
pub use moreau_exact::{Error, Result, elimination, error, number, scalar};
pub use moreau_forms as closed_forms;
pub use moreau_gate::{gate_tests, rust_engine};
pub use moreau_replicas::systems;
/// The linear algebra of all crates, in the version they are written with.
pub use nalgebra;

/// The examples of the README, compiled and run as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct ReadmeExample;

/// Those of the page on what is inside.
#[cfg(doctest)]
#[doc = include_str!("../docs/inside.md")]
pub struct InsideExample;

/// Those of the gate's manual.
#[cfg(doctest)]
#[doc = include_str!("../docs/gate.md")]
pub struct GateExample;
