//! Contact solvers: those of `moreau-contact` and the engines', by name.

use moreau_replicas::solvers::ENGINES;
use std::sync::LazyLock;

pub use moreau_contact::solvers::*;
pub use moreau_replicas::bullet::SequentialImpulses;
pub use moreau_replicas::drake::{SemiAnalyticPrimal, primal_newton};
pub use moreau_replicas::mujoco::{Direction, GaussConjugateGradient, GaussSweeps};

/// Every solver by name.
pub static ALL: LazyLock<Solvers> =
    LazyLock::new(|| Solvers::own().with(ENGINES).expect("a test of both crates shows that no name stands twice"));
