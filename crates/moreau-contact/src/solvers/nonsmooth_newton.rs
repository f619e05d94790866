//! Nonsmooth Newton on Alart and Curnier's equations, which are the certificate's natural map in two parts, or on Jean and Moreau's, which
//! have another radius R (`friction_equations.rs`):
//!
//! ```text
//!     a = r_n − ρ_n w ,   z = r_t − ρ_t y_t ,   R = μ max(a, 0) ,   y = A r + q ,   A = W + compliance
//!     F_n = r_n − max(a, 0) ,      F_t = r_t − P_R(z) ,      J d = −F ,   r ← r + s d
//!     w = y_n ,   or y_n − μ max { s·(−y_t) : s ∈ S } for the associated laws
//! ```
//! with P_R the projection on R·S, S the disk or the polygon of the law (`friction_set.rs`). With a polygon F is piecewise linear, and the
//! right piece ends it.
//!
//! Where contacts do not change between open, sticking and sliding the error squares in every step; far from a solution nothing is
//! promised. So it goes on from what sweeps have found, and ends problems on which they creep: a box on four corners, whose W has rank six
//! of twelve.
//!
//! **Rank.** Several impulses give one velocity, and J is singular along them. η on the diagonal of the rows that ask for a velocity makes
//! it regular, holds back the step along the null space, and leaves the zeros of F alone. A large η keeps contacts from changing their
//! state for nothing, a small one squares the error at the end; they are tried in turn, each with steps s = 1, ½, ¼, …, until ‖F‖ is
//! halved; else the least ‖F‖ is taken, even a larger one: a cycle is left by a jump. Which cycle an iteration ends in depends on η: other
//! ones start again. The best iterate, by the certificate's residual, is returned.
//!
//! # Source
//! Alart and Curnier, *A mixed formulation for frictional contact problems prone to Newton like solution methods*, Comput. Methods Appl.
//! Mech. Eng. 92 (1991).

use super::ContactSolver;
use super::block_elimination::Slopes;
use super::contact_systems::ContactSystems;
use super::elimination;
use super::friction_equations::FrictionEquations;
use super::friction_set::{FrictionSet, Piece};
use super::stopping::Stopping;
use super::workspace;
use crate::certificate::Judge;
use crate::memory::spare::{self, Lent, Spare};
use crate::problem::{ContactProblem, Coordinates, Law, Solution};
use crate::tolerance::solvers as tolerance;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector, Matrix3};

/// Nonsmooth Newton for every law, compliance on edges excepted; W may be asymmetric and rank deficient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NonsmoothNewton {
    /// Step limit of each start.
    pub steps: usize,
    /// Relative residual at which it stops.
    pub tolerance: f64,
    /// How many of the starts with different η it may make.
    pub starts: usize,
    /// Which radius friction has.
    pub equations: FrictionEquations,
}

impl Default for NonsmoothNewton {
    fn default() -> Self {
        NonsmoothNewton {
            steps: tolerance::NONSMOOTH_STEPS,
            tolerance: tolerance::STOP,
            starts: tolerance::NONSMOOTH_PROXIMALS.len(),
            equations: FrictionEquations::AlartCurnier,
        }
    }
}

impl ContactSolver for NonsmoothNewton {
    fn name(&self) -> &'static str {
        match self.equations {
            FrictionEquations::AlartCurnier => "nonsmooth-newton",
            FrictionEquations::JeanMoreau => "jean-moreau",
        }
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        Some(Box::new(Self { tolerance: relative, ..*self }))
    }

    fn iteration_limit(&self) -> Option<usize> {
        Some(self.steps)
    }

    fn takes(&self, _law: Law, _rows: usize, _symmetric: bool) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        if !NonsmoothNewton::fits(problem) {
            return Err(Error::refused(self.name(), "does not solve a compliance on edges, of which the impulse is not a function"));
        }
        let mut memory = workspace::borrow(problem);
        let systems = problem.delassus().blocks().map(|w| {
            memory.systems.prepare(problem, w);
            &mut memory.systems
        });
        self.solve_with(problem, warm_start, systems)
    }
}

impl NonsmoothNewton {
    /// With Jean and Moreau's equations.
    pub fn jean_moreau() -> Self {
        NonsmoothNewton { equations: FrictionEquations::JeanMoreau, ..Default::default() }
    }

    /// Whether the law of this problem is a function of impulse and velocity.
    pub fn fits(problem: &ContactProblem) -> bool {
        problem.compliance().is_none_or(|compliance| compliance.coordinates == Coordinates::Contact)
    }

    /// What solves with J where W is stored by blocks; it serves for every problem with this W.
    pub(super) fn systems(problem: &ContactProblem) -> Option<ContactSystems> {
        problem.delassus().blocks().map(|w| ContactSystems::new(problem, w))
    }

    /// As [`ContactSolver::solve`] on a problem that [`fits`](Self::fits), with the systems of its W.
    pub(super) fn solve_with(
        &self,
        problem: &ContactProblem,
        warm_start: Option<&DVector<f64>>,
        systems: Option<&mut ContactSystems>,
    ) -> Result<Solution> {
        let mut equations = Equations::new(problem, self.equations, systems)?;
        let mut stopping = Stopping::new(problem, self.tolerance);
        let start = Lent::from(super::start(problem, warm_start)?);
        let (mut best, mut law_velocity) = ((f64::INFINITY, start.clone()), Lent::from(spare::zeros(start.len())));
        let mut steps = 0;
        for proximals in tolerance::NONSMOOTH_PROXIMALS.into_iter().take(self.starts) {
            let (mut impulse, mut least, mut mark, mut since) = (start.clone(), f64::INFINITY, f64::INFINITY, 0);
            for taken in 0..=self.steps {
                problem.write_law_velocity(impulse.as_slice(), law_velocity.as_mut_slice());
                let relative = stopping.relative(&impulse, &law_velocity);
                since += 1;
                least = least.min(relative);
                if least < 0.5 * mark {
                    (mark, since) = (least, 0);
                }
                if relative < best.0 {
                    best.0 = relative;
                    best.1.copy_from(&impulse);
                }
                let patience = if least <= tolerance::ACCEPTABLE { tolerance::NONSMOOTH_ENDED } else { tolerance::NONSMOOTH_STALLED };
                if relative <= self.tolerance || since >= patience || taken == self.steps || super::watch::is_over() {
                    break;
                }
                let Some(next) = equations.step(&impulse, &law_velocity, proximals) else { break };
                impulse = next;
                steps += 1;
            }
            if best.0 <= self.tolerance.max(tolerance::ACCEPTABLE) || super::watch::is_over() {
                break;
            }
        }
        let impulse = best.1.into_inner();
        let velocity = problem.velocity(&impulse);
        super::finite(Solution::new(spare::text(self.name()), impulse, velocity, steps))
    }
}

/// F and J of a problem.
struct Equations<'a> {
    problem: &'a ContactProblem,
    /// R of every contact.
    radius: FrictionEquations,
    /// S of every contact.
    set: FrictionSet,
    /// W + R where it is stored densely; blocks are taken as they are.
    operator: Option<DMatrix<f64>>,
    /// What solves with J where W is stored by blocks.
    systems: Option<&'a mut ContactSystems>,
    /// ρ_n, ρ_t per contact \[kg\].
    weights: &'a [[f64; 2]],
}

impl<'a> Equations<'a> {
    fn new(problem: &'a ContactProblem, radius: FrictionEquations, systems: Option<&'a mut ContactSystems>) -> Result<Self> {
        let set = match problem.law().directions() {
            Some(directions) if problem.rows_per_contact() == 3 => FrictionSet::Polygon { directions },
            _ => FrictionSet::Disk,
        };
        let operator = problem.delassus().blocks().is_none().then(|| problem.law_delassus()).transpose()?;
        Ok(Equations { problem, radius, set, operator, systems, weights: Judge::weights(problem) })
    }

    /// r + s d with the first η and s that halve ‖F‖, or else those with the least; none where every d is not a number.
    fn step(&mut self, from: &DVector<f64>, law_velocity: &DVector<f64>, proximals: &[f64]) -> Option<Lent<DVector<f64>>> {
        let mut best: Option<(f64, Lent<DVector<f64>>)> = None;
        for &proximal in proximals {
            let (mut residual, slopes) = self.linearise(from, law_velocity, proximal);
            let enough = 0.5 * residual.norm();
            residual.neg_mut();
            let Some(direction) = self.direction(&slopes, &residual).map(Lent::from).filter(|d| d.iter().all(|x| x.is_finite())) else {
                continue;
            };
            let mut moved = Lent::from(spare::zeros(from.len()));
            for halvings in 0..tolerance::NONSMOOTH_HALVINGS {
                let part = 0.5f64.powi(halvings);
                let mut tried = Lent::from(from.copied());
                tried.zip_apply(&*direction, |tried, direction| *tried += direction * part);
                self.problem.write_law_velocity(tried.as_slice(), moved.as_mut_slice());
                self.write_residual(&tried, &moved, &mut residual);
                let norm = residual.norm();
                if best.as_ref().is_none_or(|(least, _)| norm < *least) {
                    best = Some((norm, tried));
                }
                if norm <= enough {
                    return best.map(|(_, impulse)| impulse);
                }
            }
        }
        best.map(|(_, impulse)| impulse)
    }

    /// Overwrites `residual` with F(r).
    fn write_residual(&self, impulse: &DVector<f64>, law_velocity: &DVector<f64>, residual: &mut DVector<f64>) {
        (0..self.problem.contacts()).for_each(|k| self.contact(k, [impulse, law_velocity], residual, None));
    }

    /// F(r), and A_k and B_k of J(r) with η for every contact; y = A r + q is given.
    fn linearise(&self, impulse: &DVector<f64>, law_velocity: &DVector<f64>, proximal: f64) -> (Lent<DVector<f64>>, Lent<Vec<Slopes>>) {
        let mut residual = Lent::from(spare::zeros(self.problem.rows()));
        let mut slopes = Lent::from(spare::vector(self.problem.contacts()));
        for k in 0..self.problem.contacts() {
            self.contact(k, [impulse, law_velocity], &mut residual, Some((&mut slopes, proximal)));
        }
        (residual, slopes)
    }

    /// The d with J d = b.
    fn direction(&mut self, slopes: &[Slopes], right_side: &DVector<f64>) -> Option<DVector<f64>> {
        match (&mut self.systems, self.problem.delassus().blocks()) {
            (Some(systems), Some(w)) => systems.factor(w, slopes, false).then(|| systems.solve(w, right_side)).flatten(),
            _ => elimination::solve(&self.jacobian(self.operator.as_ref()?, slopes), right_side),
        }
    }

    /// J, row by row: B times the rows of A, and A_k of the contact itself.
    fn jacobian(&self, operator: &DMatrix<f64>, slopes: &[Slopes]) -> DMatrix<f64> {
        let (rows, mut jacobian) = (self.problem.rows_per_contact(), DMatrix::zeros(self.problem.rows(), self.problem.rows()));
        for (k, Slopes { own, through, .. }) in slopes.iter().enumerate() {
            for i in 0..rows {
                let mut changed = jacobian.row_mut(k * rows + i);
                // tangential columns first
                for column in (1..rows).chain([0]) {
                    if through[(i, column)] != 0.0 {
                        changed += operator.row(k * rows + column) * through[(i, column)];
                    }
                    changed[k * rows + column] += own[(i, column)];
                }
            }
        }
        jacobian
    }

    /// The rows of contact k of F and, if asked for, of J with its η.
    fn contact(
        &self,
        k: usize,
        [impulse, law_velocity]: [&DVector<f64>; 2],
        residual: &mut DVector<f64>,
        slopes: Option<(&mut Vec<Slopes>, f64)>,
    ) {
        let (rows, [rho_n, rho_t]) = (self.problem.rows_per_contact(), self.weights[k]);
        let (normal, mu) = (k * rows, super::cone_friction(self.problem, k));
        let tangent = |vector: &DVector<f64>, i: usize| if i + 1 < rows { vector[normal + 1 + i] } else { 0.0 };
        let [r_t, y_t] = [impulse, law_velocity].map(|vector| [tangent(vector, 0), tangent(vector, 1)]);
        let associated = matches!(self.problem.law(), Law::Associated | Law::PolyhedralAssociated { .. });
        let lifted = if associated { self.set.against(y_t).map(|share| mu * share) } else { [0.0; 2] };
        let w = law_velocity[normal] + lifted[0] * y_t[0] + lifted[1] * y_t[1];
        let a = impulse[normal] - rho_n * w;
        let presses = a > 0.0;
        residual[normal] = if presses { rho_n * w } else { impulse[normal] };
        let radius = self.radius.radius(mu, [impulse[normal], a]);
        let piece = self.set.piece(radius, [r_t[0] - rho_t * y_t[0], r_t[1] - rho_t * y_t[1]]);
        // F_t = (I − A) r_t + A ρ_t y_t − g R, without the difference of two numbers as large as r_t where the contact sticks
        for i in 0..rows - 1 {
            let moved = |j: usize| piece.stays(i, j) * r_t[j] + piece.along[i][j] * rho_t * y_t[j];
            residual[normal + 1 + i] = (0..rows - 1).map(moved).sum::<f64>() - piece.growth[i] * radius;
        }
        if let Some((slopes, proximal)) = slopes {
            slopes.push(self.slopes(k, presses, lifted, &piece, proximal));
        }
    }

    /// A_k and B_k: what the rows of contact k ask of its own impulse, and of its velocity y.
    fn slopes(&self, k: usize, presses: bool, lifted: [f64; 2], piece: &Piece, proximal: f64) -> Slopes {
        let (rows, [rho_n, rho_t]) = (self.problem.rows_per_contact(), self.weights[k]);
        let mu = super::cone_friction(self.problem, k);
        let (mut own, mut through) = (Matrix3::identity(), Matrix3::zeros());
        // ∂w/∂y
        let slope = [1.0, lifted[0], lifted[1]];
        own[(0, 0)] = if presses { proximal } else { 1.0 };
        if presses {
            (0..rows).for_each(|column| through[(0, column)] = rho_n * slope[column]);
        }
        for i in 0..rows - 1 {
            for j in 0..rows - 1 {
                let moves = piece.along[i][j];
                through[(1 + i, 1 + j)] = moves * rho_t;
                own[(1 + i, 1 + j)] = piece.stays(i, j) + moves * proximal;
            }
            if piece.growth[i] != 0.0 {
                // −g ∂R/∂r
                let falls = piece.growth[i] * self.radius.falls(mu) * rho_n;
                (0..rows).for_each(|column| through[(1 + i, column)] += slope[column] * falls);
                own[(1 + i, 0)] = -piece.growth[i] * mu;
            }
        }
        if self.operator.is_none() {
            // B R, which a dense operator holds already
            for column in 0..rows {
                let softness = self.problem.row_compliance(k * rows + column);
                (0..rows).for_each(|i| own[(i, column)] += through[(i, column)] * softness);
            }
        }
        Slopes { own, through, inverse: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::problem::Compliance;
    use crate::solvers::test_problems::{by_blocks, four_corners};
    use crate::solvers::{AlternatingDirections, LemkePivoting, ProjectedGaussSeidel};
    use crate::tolerance::certificate::CERTIFY;

    #[test]
    fn it_finishes_what_sweeps_began_where_the_impulses_are_not_unique() {
        for law in [Law::Frictionless, Law::Coulomb, Law::Associated, Law::PolyhedralCoulomb { directions: 6 }] {
            for (sideways, turning) in [(0.1, 0.0), (2.0, 0.0), (0.5, 1.0), (0.3, -3.0)] {
                let problem = four_corners(law, sideways, turning);
                let begun = ProjectedGaussSeidel { sweeps: 20, ..Default::default() }.solve(&problem, None).unwrap();
                let solution = NonsmoothNewton::default().solve(&problem, Some(&begun.impulse)).unwrap();
                assert!(residuals(&problem, &solution).unwrap().is_solution(tolerance::ENOUGH), "{law:?} {sideways} {turning}");
                if matches!(law, Law::Frictionless | Law::Associated) {
                    // several impulses, one velocity; Coulomb's law may have several of these too
                    let other = AlternatingDirections::default().solve(&problem, None).unwrap();
                    assert!((&other.velocity - &solution.velocity).amax() <= CERTIFY, "{law:?} {sideways} {turning}");
                }
            }
        }
    }

    const BOTH: [FrictionEquations; 2] = [FrictionEquations::AlartCurnier, FrictionEquations::JeanMoreau];

    #[test]
    fn blocks_and_a_square_matrix_give_the_same_step() {
        let impulse = DVector::from_vec(vec![0.4, -0.05, 0.02, 0.3, -0.1, -0.1, -0.8, 0.0, 0.0, 0.1, 0.3, 0.2]);
        for law in [Law::Frictionless, Law::Coulomb, Law::Associated, Law::PolyhedralCoulomb { directions: 5 }] {
            let soft = Compliance { coordinates: Coordinates::Contact, diagonal: DVector::from_fn(12, |i, _| i as f64 / 8.0) };
            for compliance in [None, Some(soft)] {
                let problem = four_corners(law, 0.7, 0.9).into_builder().compliance(compliance).build().unwrap();
                let stored = by_blocks(&problem);
                let velocity = problem.law_velocity(&impulse);
                let [dense, blocks] = [&problem, &stored].map(|problem| {
                    let mut systems = NonsmoothNewton::systems(problem);
                    let mut equations = Equations::new(problem, FrictionEquations::AlartCurnier, systems.as_mut()).unwrap();
                    let (residual, slopes) = equations.linearise(&impulse, &velocity, 1e-3);
                    equations.direction(&slopes, &-&*residual).unwrap()
                });
                // condition of J up to 1/η times the norm of W
                let rounding = moreau_exact::tolerance::rounding(12, 1e3 * problem.dense().norm()) * dense.amax();
                assert!((&dense - &blocks).amax() <= rounding, "{law:?}");
            }
        }
    }

    /// The largest difference of the Jacobian of one from the differences of F of the other, and what rounding and curvature leave.
    fn difference(problem: &ContactProblem, slopes_of: FrictionEquations, values_of: FrictionEquations) -> [f64; 2] {
        let (step, eta) = (crate::tolerance::cones::DIFFERENCE_STEP, tolerance::NONSMOOTH_PROXIMALS[0][1]);
        let [slopes_of, values_of] = [slopes_of, values_of].map(|radius| Equations::new(problem, radius, None).unwrap());
        // one contact presses and sticks or slides, one is open
        let impulse = DVector::from_vec(vec![0.4, -0.05, 0.02, 0.3, -0.1, -0.1, -0.8, 0.0, 0.0, 0.1, 0.3, 0.2]);
        let slopes = slopes_of.linearise(&impulse, &problem.law_velocity(&impulse), eta).1;
        let jacobian = slopes_of.jacobian(slopes_of.operator.as_ref().expect("stored densely"), &slopes);
        let column = |column: usize| {
            let shifted = |by: f64| {
                let mut moved = impulse.clone();
                moved[column] += by;
                let mut residual = DVector::zeros(12);
                values_of.write_residual(&moved, &problem.law_velocity(&moved), &mut residual);
                residual
            };
            (jacobian.column(column) - (shifted(step) - shifted(-step)) / (2.0 * step)).amax()
        };
        [(0..12).map(column).fold(0.0, f64::max), eta + crate::tolerance::cones::difference_error(0.05, 4.0)]
    }

    #[test]
    fn the_jacobian_is_the_derivative_of_its_own_equations_alone() {
        let polygons = [Law::PolyhedralCoulomb { directions: 5 }, Law::PolyhedralAssociated { directions: 8 }];
        for law in [Law::Frictionless, Law::Coulomb, Law::Associated].into_iter().chain(polygons) {
            let problem = four_corners(law, 0.7, 0.9);
            for (slopes_of, values_of) in BOTH.into_iter().flat_map(|one| BOTH.map(|other| (one, other))) {
                let [found, bound] = difference(&problem, slopes_of, values_of);
                let same = slopes_of == values_of || law == Law::Frictionless;
                assert_eq!(found <= bound, same, "{law:?} {slopes_of:?} {values_of:?}: {found:e}");
            }
        }
    }

    #[test]
    fn polyhedral_laws_end_where_lemke_ends() {
        for law in [Law::PolyhedralCoulomb { directions: 8 }, Law::PolyhedralAssociated { directions: 4 }] {
            for (sideways, turning) in [(0.1, 0.0), (2.0, 0.0), (0.5, 1.0), (0.3, -3.0)] {
                let problem = four_corners(law, sideways, turning);
                let round = if matches!(law, Law::PolyhedralCoulomb { .. }) { Law::Coulomb } else { Law::Associated };
                let begun = ProjectedGaussSeidel { sweeps: 20, ..Default::default() };
                let begun = begun.solve(&problem.clone().into_builder().law(round).build().unwrap(), None).unwrap();
                let solution = NonsmoothNewton::default().solve(&problem, Some(&begun.impulse)).unwrap();
                assert!(residuals(&problem, &solution).unwrap().is_solution(tolerance::ENOUGH), "{law:?} {sideways} {turning}");
                let lemke = LemkePivoting.solve(&problem, None).unwrap();
                if law == (Law::PolyhedralAssociated { directions: 4 }) {
                    assert!((&lemke.velocity - &solution.velocity).amax() <= CERTIFY, "{law:?} {sideways} {turning}");
                }
            }
        }
    }

    #[test]
    fn compliance_on_edges_is_refused_by_name() {
        let compliance = Compliance { coordinates: Coordinates::Edge, diagonal: DVector::from_element(16, 1.0) };
        let hard = four_corners(Law::PolyhedralAssociated { directions: 4 }, 0.1, 0.0);
        let problem = hard.into_builder().compliance(compliance).build().unwrap();
        assert!(NonsmoothNewton::default().solve(&problem, None).unwrap_err().to_string().contains("compliance on edges"));
    }
}
