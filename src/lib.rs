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
//! One step of every scheme solves, for the impulses `r` \[N·s\] and the contact velocities `u` \[m/s\],
//! ```text
//!     u = W r + u_free ,    y = u + shift + R r ,    (r, y) in the contact law .
//! ```
//! Symbols, units, signs and component order: [`conventions`].

pub mod certificate;
pub mod checks;
pub mod claims;
pub mod cli;
pub mod closed_forms;
pub mod cones;
pub mod contact;
pub mod conventions;
pub mod defects;
pub mod elimination;
pub mod error;
pub mod files;
pub mod mechanics;
pub mod problem;
pub mod report;
pub mod scalar;
pub mod scenes;
pub mod schemes;
pub mod solvers;
pub mod tolerance;
pub mod trajectory;

pub use error::{Error, Result};
pub use problem::{ContactProblem, Law, Solution};

/// The README's example, compiled and run as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct ReadmeExample;
