//! Contact problems, solvers and a certificate that knows none of them.
//!
//! For the impulses `r` \[N·s\] and the contact velocities `u` \[m/s\] of one step,
//! ```text
//!     u = W r + u_free ,    y = u + shift + R r ,    (r, y) in the contact law .
//! ```
//! A [`ContactProblem`] is posed, a [`solvers::ContactSolver`] proposes a [`Solution`], and [`certificate`] says whether it is one, contact
//! by contact. Symbols, units, signs and component order: [`conventions`].
//!
//! A block of 1 kg arrives at 1 m/s, slides at 2 m/s, μ = ½:
//! ```
//! use moreau_contact::nalgebra::{self, DMatrix, dvector}; // the macro writes `nalgebra::`
//! use moreau_contact::prelude::*;
//!
//! let problem = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0])
//!     .name("block")
//!     .law(Law::Coulomb)
//!     .rows_per_contact(2)
//!     .friction(vec![0.5])
//!     .build()?;
//! let answer = Auto.solve(&problem, None)?;
//! assert!(residuals(&problem, &answer)?.is_solution(1e-8)); // r = (1, −½) N·s, u = (0, 3/2) m/s
//! # Ok::<(), moreau_contact::Error>(())
//! ```

#[cfg(feature = "files")]
pub mod answered;
pub mod augmented_mass;
pub mod certificate;
pub mod cones;
pub mod contact;
pub mod conventions;
pub mod equations;
#[cfg(feature = "files")]
pub mod files;
mod fronts;
pub mod memory;
pub mod operator;
pub mod prelude;
pub mod problem;
pub mod solvers;
pub mod tolerance;
pub mod watch;

pub use moreau_exact::{Error, Result, scalar};
/// The linear algebra of the problems, in the version they are written with.
pub use nalgebra;
pub use problem::{ContactProblem, Law, Solution};

/// The README's example, compiled and run as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct ReadmeExample;
