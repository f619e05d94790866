//! Contact solvers: those of `moreau-contact` and the engines', by name.

use moreau_replicas::solvers::ENGINES;
use std::sync::LazyLock;

pub use moreau_contact::solvers::*;
pub use moreau_replicas::bullet::SequentialImpulses;
pub use moreau_replicas::drake::{SemiAnalyticPrimal, primal_newton};
pub use moreau_replicas::mujoco::{Direction, GaussConjugateGradient, GaussSweeps};

/// Every solver by name.
///
/// ```
/// use moreau::solvers::ALL;
///
/// let problem = moreau::problems::named("single-slide")?.problem()?;
/// let answers = ["auto", "pgs", "admm"].map(|name| ALL.by_name(name).and_then(|solver| solver.solve(&problem, None)));
/// let [first, second, third] = answers.map(|answer| answer.map(|answer| answer.velocity));
/// assert!((first? - second?).amax() < 1e-6 && third.is_ok() && ALL.by_name("no-such-solver").is_err());
/// # Ok::<(), moreau::Error>(())
/// ```
pub static ALL: LazyLock<Solvers> =
    LazyLock::new(|| Solvers::own().with(ENGINES).expect("a test of both crates shows that no name stands twice"));
