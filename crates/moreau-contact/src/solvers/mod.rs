//! Contact solvers, one per file. None of them judges itself: [`crate::certificate`] does.
//!
//! Each by its type, on a block of 1 kg that arrives at 1 m/s and slides at 2 m/s under a law it takes, μ = ½ where there is friction:
//! ```
//! use moreau_contact::nalgebra::{DMatrix, DVector, dvector};
//! use moreau_contact::prelude::*;
//! use moreau_contact::problem::{Compliance, Coordinates};
//! use moreau_contact::solvers::*;
//!
//! let solvers: [(&dyn ContactSolver, Law); 9] = [
//!     (&Auto, Law::Coulomb),
//!     (&ProjectedGaussSeidel::accelerated(), Law::Coulomb),
//!     (&ProjectedOverRelaxation::default(), Law::Coulomb),
//!     (&NonsmoothNewton::default(), Law::PolyhedralCoulomb { directions: 8 }),
//!     (&AlternatingDirections::default(), Law::Coulomb),
//!     (&LemkePivoting, Law::PolyhedralCoulomb { directions: 8 }),
//!     (&AcceleratedProjectedGradient::default(), Law::Associated),
//!     (&BarzilaiBorwein::default(), Law::Associated),
//!     (&GaussNewton::default(), Law::Associated),
//! ];
//! for (solver, law) in solvers {
//!     // Newton on Gauss's principle is for soft contacts and needs the mass
//!     let soft = Compliance { coordinates: Coordinates::Contact, diagonal: DVector::from_element(3, 0.25) };
//!     let problem = ContactProblem::from_dynamics(DMatrix::identity(3, 3), DMatrix::identity(3, 3), &dvector![-1.0, 2.0, 0.0])
//!         .law(law)
//!         .friction(vec![0.5])
//!         .compliance((solver.name() == "newton").then_some(soft))
//!         .build()?;
//!     let answer = solver.solve(&problem, None)?;
//!     assert!(residuals(&problem, &answer)?.is_solution(1e-8), "{}", solver.name());
//! }
//! # Ok::<(), moreau_contact::Error>(())
//! ```

use crate::problem::{ContactProblem, Law, Solution};
use moreau_exact::Result;
use nalgebra::DVector;

mod accelerated_projected_gradient;
mod alternating_directions;
mod anderson;
mod auto;
mod balanced;
mod barzilai_borwein;
mod block_elimination;
mod block_sweep;
#[cfg(feature = "clarabel")]
mod clarabel;
mod colours;
mod contact_systems;
mod convex_subproblems;
mod creep;
mod crew;
mod definite;
mod elimination;
pub mod enumeration;
mod few;
mod fischer_burmeister;
mod fischer_burmeister_equations;
mod fischer_burmeister_map;
mod friction_equations;
mod friction_set;
pub mod gauss;
mod interior_point;
mod joints;
mod joints_exactly;
mod least_norm;
pub mod lemke;
mod lemke_outcome;
mod lemke_pivoting;
mod lemke_tableau;
mod line_root;
mod linear_form;
mod newton_min;
mod nonsmooth_equations;
mod nonsmooth_newton;
mod one_contact;
pub mod parts;
mod polyhedral_contact;
mod principal_pivoting;
mod principal_tableau;
mod projected_gauss_seidel;
mod projected_over_relaxation;
mod proximal_newton;
mod shifted_operator;
mod stopping;
mod swept;
mod swept_bodies;
mod table;
pub mod threads;
mod velocity_elimination;
mod workspace;

pub use crate::watch;
pub use accelerated_projected_gradient::{AcceleratedProjectedGradient, Momentum, largest_eigenvalue_bound, objective};
pub use alternating_directions::AlternatingDirections;
pub use auto::{Auto, AutoWithin};
pub use barzilai_borwein::BarzilaiBorwein;
#[cfg(feature = "clarabel")]
pub use clarabel::{ClarabelPolished, Polished};
pub use convex_subproblems::ConvexSubproblems;
pub use enumeration::Enumeration;
pub use fischer_burmeister::FischerBurmeister;
pub use friction_equations::FrictionEquations;
pub use gauss::GaussNewton;
pub use interior_point::InteriorPoint;
pub use joints::{WithoutJoints, solve_jointed};
pub use least_norm::least_norm;
pub use lemke_pivoting::LemkePivoting;
pub use line_root::LineRoot;
pub use newton_min::NewtonMin;
pub use nonsmooth_newton::NonsmoothNewton;
pub use principal_pivoting::{Murty, ParametricPivoting, PrincipalOutcome};
pub use projected_gauss_seidel::ProjectedGaussSeidel;
pub use projected_over_relaxation::ProjectedOverRelaxation;
pub use proximal_newton::ProximalNewton;
pub use table::{SolverEntry, Solvers};

use linear_form::on_support;
use parts::{compliance, cone_friction, finite, not_convex, project, require_symmetry, start, start_of_use};

/// An algorithm that proposes a solution of a contact problem.
pub trait ContactSolver: Send + Sync {
    /// The name used on the command line and in files.
    fn name(&self) -> &'static str;
    /// Whether the algorithm is a declared number of sweeps and promises no solution: what its certificate rejects counts as unconverged.
    fn is_truncated(&self) -> bool {
        false
    }
    /// The same algorithm with another relative residual at which it stops; `None` where it has no such number.
    fn with_tolerance(&self, _relative: f64) -> Option<Box<dyn ContactSolver>> {
        None
    }
    /// Its own limit of iterations, if it has one.
    fn iteration_limit(&self) -> Option<usize> {
        None
    }
    /// Whether it starts from impulses that are given; a method that begins at a start of its own checks them and leaves them.
    fn takes_start(&self) -> bool {
        true
    }
    /// Whether the algorithm is made for this law, at contacts of `rows` rows each, with a W that is symmetric or not. What else a problem
    /// may lack (a compliance, the mass, a definite block) is told by [`solve`](ContactSolver::solve), which refuses it.
    fn takes(&self, law: Law, rows: usize, symmetric: bool) -> bool;
    /// Proposes a solution, starting from `warm_start` impulses if given.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Solver`] if the law, the size or an asymmetric W is outside the algorithm's scope, or if it
    /// ends without an answer (a ray, a breakdown). An answer that is merely not converged is returned and left to
    /// the certificate.
    /// ```
    /// use moreau_contact::nalgebra::{DMatrix, dvector};
    /// use moreau_contact::prelude::*;
    /// use moreau_contact::solvers::ProjectedGaussSeidel;
    ///
    /// let block = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build()?;
    /// let answer = ProjectedGaussSeidel::default().solve(&block, None)?;
    /// assert_eq!(answer.impulse, dvector![1.0, -0.5]);
    /// let again = ProjectedGaussSeidel::default().solve(&block, Some(&answer.impulse))?;
    /// assert_eq!(again.iterations, 0);
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution>;
}

#[cfg(test)]
mod agreement_tests;
#[cfg(test)]
mod crew_tests;
#[cfg(test)]
mod lcp_tests;
#[cfg(test)]
mod test_problems;
