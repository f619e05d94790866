//! What a program that poses, solves and certifies contact problems names: `use moreau_contact::prelude::*;`.

pub use crate::certificate::{Residuals, residuals};
pub use crate::problem::{ContactProblem, Law, Solution};
pub use crate::solvers::{Auto, ContactSolver, Solvers};
