//! The engines' own iterations, for a table of solvers.

use crate::{bullet, drake, mujoco};
use moreau_contact::solvers::SolverEntry;

/// MuJoCo's conjugate gradients and sweeps, Drake's SAP, Bullet's sequential impulses; a new one is one more line.
pub const ENGINES: &[SolverEntry] =
    &[mujoco::CONJUGATE_GRADIENT, mujoco::GAUSS_SWEEPS, drake::semi_analytic_primal::SOLVER, bullet::sequential_impulses::SOLVER];

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_contact::solvers::Solvers;

    #[test]
    fn every_listed_name_is_a_solver_of_that_name_beside_those_of_moreau_contact() {
        let all = Solvers::own().with(ENGINES).expect("names of their own");
        for entry in ENGINES {
            assert_eq!(all.by_name(entry.name).expect("listed").name(), entry.name);
        }
    }

    #[test]
    fn a_limit_of_iterations_is_taken_by_those_that_have_one() {
        let all = Solvers::of(ENGINES);
        let taken: Vec<_> = all.names().filter(|name| all.with_iterations(name, Some(3)).is_ok()).collect();
        assert_eq!(taken, ["cg", "gauss-pgs", "sequential-impulses"]);
    }
}
