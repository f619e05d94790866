//! Sequential impulses, Bullet's iteration: one row after the other, the normals of all contacts first, then their friction, a given number
//! of times.
//!
//! ```text
//!     r_n ← max(0, r_n − y_n / D_nn) ,     y = u_free + shift + (W + R) r ,   D = diag(W + R) ,
//!     cone:  r_t ← P(r_t − D_t⁻¹ y_t)               both rows at once, P scales into the disc ‖r_t‖ ≤ μ r_n
//!     box:   r_e ← min(max(r_e − y_e / D_ee, −b), b)    for one axis e after the other, b = μ r_n, left alone while r_n = 0
//! ```
//! with the r_n of the moment. At the start r_n is a share of the previous step's impulse and r_t = 0. A sweep in which no row's velocity
//! changed by more than the residual is the last; the two rows of a cone count by the sum of their changes, which may cancel.
//!
//! The box is the polyhedral law with four directions: |r·d₁| + |r·d₂| ≤ μ r_n is, along the axes turned by 45°, |r_e| ≤ μ r_n/√2. In the
//! plane box and cone are one row.
//!
//! A fixed point of the cone's sweeps solves Coulomb's law, P being the projection that the law is written with as long as D_t is a
//! multiple of the identity. A fixed point of the box's sweeps need not solve its law: a contact whose normal impulse comes back to zero
//! keeps the friction it had.

use super::ContactSolver;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::solvers::BULLET_RESIDUAL;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Sequential impulses for the frictionless and Coulomb's law and, with four directions, the polyhedral one; W may be asymmetric and rank
/// deficient.
///
/// # Source
/// Bullet 3.25, `btSequentialImpulseConstraintSolver::solveSingleIteration` and `btMultiBodyConstraintSolver::solveSingleIteration`; E.
/// Catto, Iterative dynamics with temporal coherence, 2005.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SequentialImpulses {
    /// Most sweeps (`numSolverIterations`).
    pub sweeps: usize,
    /// Share of the normal impulses given that the first sweep starts from (`warmStartingFactor`).
    pub warm_start: f64,
    /// Ends the sweeps \[m²/s²\] (`solverResidualThreshold`).
    pub residual: f64,
}

impl Default for SequentialImpulses {
    /// PyBullet's values for its multibodies, which start from zero; its rigid bodies start from 0.1. Bullet's own are 10 sweeps, 0.85
    /// and 0.
    fn default() -> Self {
        SequentialImpulses { sweeps: 50, warm_start: 0.0, residual: BULLET_RESIDUAL }
    }
}

const NAME: &str = "sequential-impulses";

/// The two axes along which a box bounds friction, in the contact's tangents: those of the square with corners at ±t₁, ±t₂.
const TURNED: [[f64; 2]; 2] = [
    [std::f64::consts::FRAC_1_SQRT_2, -std::f64::consts::FRAC_1_SQRT_2],
    [std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::FRAC_1_SQRT_2],
];

impl ContactSolver for SequentialImpulses {
    fn name(&self) -> &'static str {
        NAME
    }

    fn is_truncated(&self) -> bool {
        true
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        problem.validate()?;
        let boxed = is_boxed(problem)?;
        let mut impulse = super::start(problem, warm_start)?;
        for (row, r) in impulse.iter_mut().enumerate() {
            *r *= if row % problem.rows_per_contact == 0 { self.warm_start } else { 0.0 };
        }
        let law_velocity = problem.law_velocity(&impulse);
        let mut sweep = Sweep { problem, boxed, impulse, law_velocity };
        let mut iterations = 0;
        while iterations < self.sweeps {
            iterations += 1;
            let change = sweep.run();
            if change * change <= self.residual {
                break;
            }
        }
        let velocity = problem.velocity(&sweep.impulse);
        super::finite(Solution { impulse: sweep.impulse, velocity, beta: None, sigma: None, solver: NAME.into(), iterations })
    }
}

/// Whether friction is bounded axis by axis.
fn is_boxed(problem: &ContactProblem) -> Result<bool> {
    match (problem.law, problem.rows_per_contact) {
        (Law::Frictionless | Law::Coulomb, _) => Ok(false),
        (Law::PolyhedralCoulomb { .. }, 2) => Ok(false),
        (Law::PolyhedralCoulomb { directions: 4 }, 3) => Ok(true),
        (Law::PolyhedralCoulomb { directions }, _) => {
            Err(Error::solver(NAME, format!("bounds friction by a square, and this problem has {directions} directions; use `lemke`")))
        }
        (law, _) => Err(super::not_convex(NAME, law)),
    }
}

/// What a sweep works on.
struct Sweep<'a> {
    problem: &'a ContactProblem,
    boxed: bool,
    /// r \[N·s\].
    impulse: DVector<f64>,
    /// y \[m/s\], updated column by column.
    law_velocity: DVector<f64>,
}

impl Sweep<'_> {
    /// One sweep; the largest change of a row's velocity \[m/s\].
    fn run(&mut self) -> f64 {
        let rows = self.problem.rows_per_contact;
        let mut largest = 0.0f64;
        for row in (0..self.impulse.len()).step_by(rows) {
            let (wanted, diagonal) = self.alone(row, &[1.0]);
            largest = largest.max((self.add(row, wanted.max(-self.impulse[row])) * diagonal).abs());
        }
        for k in 0..self.problem.contacts() {
            let normal = self.impulse[k * rows];
            let bound = super::cone_friction(self.problem, k) * normal;
            let change = match rows {
                _ if self.boxed && normal > 0.0 => self.box_friction(k * rows + 1, bound * std::f64::consts::FRAC_1_SQRT_2),
                2 => self.one_friction(k * rows + 1, bound),
                3 if !self.boxed => self.cone_friction(k * rows + 1, bound),
                _ => 0.0,
            };
            largest = largest.max(change);
        }
        largest
    }

    /// What the row Σ axis_i · row_{first+i} would add to its impulse if it were alone and without bound \[N·s\], and its D \[1/kg\];
    /// nothing where D is zero.
    fn alone(&self, first: usize, axis: &[f64]) -> (f64, f64) {
        let (mut velocity, mut diagonal) = (0.0, 0.0);
        for (i, a) in axis.iter().enumerate() {
            velocity += a * self.law_velocity[first + i];
            diagonal += a * a * super::compliance(self.problem, first + i);
            diagonal += axis.iter().enumerate().map(|(j, b)| a * b * self.problem.delassus[(first + i, first + j)]).sum::<f64>();
        }
        if diagonal > f64::EPSILON { (-velocity / diagonal, diagonal) } else { (0.0, 0.0) }
    }

    /// Adds to the impulse of a row and carries y along; returns what was added.
    fn add(&mut self, row: usize, change: f64) -> f64 {
        if change != 0.0 {
            self.law_velocity.axpy(change, &self.problem.delassus.column(row), 1.0);
            self.law_velocity[row] += super::compliance(self.problem, row) * change;
            self.impulse[row] += change;
        }
        change
    }

    /// The one friction row of a contact in the plane.
    fn one_friction(&mut self, row: usize, bound: f64) -> f64 {
        let (wanted, diagonal) = self.alone(row, &[1.0]);
        let reached = (self.impulse[row] + wanted).clamp(-bound, bound);
        (self.add(row, reached - self.impulse[row]) * diagonal).abs()
    }

    /// Both friction rows from the same y, scaled into the disc.
    fn cone_friction(&mut self, first: usize, bound: f64) -> f64 {
        let [(one, own), (other, across)] = [self.alone(first, &[1.0]), self.alone(first + 1, &[1.0])];
        let sum = [self.impulse[first] + one, self.impulse[first + 1] + other];
        let size = sum[0].hypot(sum[1]);
        let share = if size > bound { bound / size } else { 1.0 };
        let changes = [0, 1].map(|i: usize| sum[i] * share - self.impulse[first + i]);
        (self.add(first, changes[0]) * own + self.add(first + 1, changes[1]) * across).abs()
    }

    /// One axis of the square after the other.
    fn box_friction(&mut self, first: usize, bound: f64) -> f64 {
        let mut largest = 0.0f64;
        for axis in TURNED {
            let (wanted, diagonal) = self.alone(first, &axis);
            let now = axis[0] * self.impulse[first] + axis[1] * self.impulse[first + 1];
            let change = (now + wanted).clamp(-bound, bound) - now;
            self.add(first, axis[0] * change);
            self.add(first + 1, axis[1] * change);
            largest = largest.max((change * diagonal).abs());
        }
        largest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::solvers::LemkePivoting;
    use moreau_exact::tolerance::rounding;
    use nalgebra::{DMatrix, dvector};

    fn problem(law: Law, rows: usize, friction: f64, delassus: DMatrix<f64>, free: DVector<f64>) -> ContactProblem {
        ContactProblem {
            name: "sweeps".into(),
            rows_per_contact: rows,
            law,
            friction: vec![if law == Law::Frictionless { 0.0 } else { friction }; free.len() / rows],
            shift: DVector::zeros(free.len()),
            free_velocity: free,
            delassus,
            compliance: None,
            dynamics: None,
            bodies: None,
        }
    }

    /// So many sweeps from zero, whatever the residual.
    fn swept(problem: &ContactProblem, sweeps: usize) -> DVector<f64> {
        let solver = SequentialImpulses { sweeps, warm_start: 0.0, residual: -1.0 };
        solver.solve(problem, None).expect("a law it takes").impulse
    }

    /// n equal masses pressed against each other and a wall: W = tridiag(−1, 2, −1), contact k between k and k + 1.
    fn chain(contacts: usize) -> ContactProblem {
        let delassus = DMatrix::from_fn(contacts, contacts, |i, j| match i.abs_diff(j) {
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        });
        problem(Law::Frictionless, 1, 0.0, delassus, DVector::from_element(contacts, -1.0))
    }

    #[test]
    fn a_sweep_takes_all_normals_in_order_and_then_friction_bounded_by_them() {
        // D = 2; first r_n = 1/2 and (3 − 1/2)/2 = 5/4, then y_t = 4 + 1/2 + 5/4 asks for −23/8 ≤ −μ/2
        let delassus = DMatrix::from_row_slice(4, 4, &[2.0, 1.0, 1.0, 0.0, 1.0, 2.0, 1.0, 0.0, 1.0, 1.0, 2.0, 1.0, 0.0, 0.0, 1.0, 2.0]);
        let planar = problem(Law::Coulomb, 2, 0.5, delassus, dvector![-1.0, 4.0, -3.0, 0.0]);
        // the last row's y_t = r_n₂ = 5/4 asks for −5/8, its bound
        assert_eq!(swept(&planar, 1), dvector![0.5, -0.25, 1.25, -0.625]);
    }

    #[test]
    fn the_box_brakes_both_axes_by_mu_and_the_cone_brakes_along_the_slip() {
        let mu = 0.25;
        let of = |law, tangents: [f64; 2]| {
            let free = dvector![-1.0, tangents[0], tangents[1]];
            let r = swept(&problem(law, 3, if law == Law::Coulomb { mu } else { mu * 2f64.sqrt() }, DMatrix::identity(3, 3), free), 1);
            [r[1], r[2]]
        };
        let square = Law::PolyhedralCoulomb { directions: 4 };
        let close = |found: [f64; 2], expected: [f64; 2]| {
            assert!((0..2).all(|i| (found[i] - expected[i]).abs() <= rounding(16, 1.0)), "{found:?} against {expected:?}");
        };
        // the box's own axes lie at ±45°: slip along t₁ is at its corner, slip along an axis in the middle of its side
        close(of(square, [3.0, 0.0]), [-mu * 2f64.sqrt(), 0.0]);
        close(of(square, [3.0, 3.0]), [-mu / 2f64.sqrt(), -mu / 2f64.sqrt()]);
        close(of(Law::Coulomb, [3.0, 0.0]), [-mu, 0.0]);
        close(of(Law::Coulomb, [3.0, 4.0]), [-mu * 0.6, -mu * 0.8]);
    }

    #[test]
    fn the_error_of_a_chain_shrinks_by_cos_squared_pi_over_n_plus_1_per_sweep() {
        let (n, chain) = (5, chain(5));
        // every contact is pressed: W r = 1, r_k = k (n + 1 − k)/2
        let exact = DVector::from_fn(n, |k, _| 0.5 * ((k + 1) * (n - k)) as f64);
        let errors: Vec<f64> = (0..40).map(|sweeps| (swept(&chain, sweeps) - &exact).norm()).collect();
        assert!(errors.windows(2).all(|pair| pair[1] < pair[0]), "{errors:?}");
        let rate = (std::f64::consts::PI / (n + 1) as f64).cos().powi(2);
        // the second rate is cos²(2π/6) = 1/4 against 3/4: thirty sweeps on it is (1/3)³⁰ of the first
        assert!(
            (errors[39] / errors[38] - rate).abs() <= 3f64.powi(-30) + rounding(64 * 40, 1.0) / errors[39],
            "{} {rate}",
            errors[39] / errors[38]
        );
    }

    #[test]
    fn a_warm_start_takes_its_share_of_the_normals_and_stays_at_the_solution() {
        let chain = chain(4);
        let solution = swept(&chain, 500);
        let from = |warm_start, sweeps| {
            let solver = SequentialImpulses { sweeps, warm_start, residual: -1.0 };
            solver.solve(&chain, Some(&solution)).expect("a law it takes").impulse
        };
        assert_eq!(from(0.85, 0), &solution * 0.85);
        assert!((from(1.0, 1) - &solution).amax() <= rounding(16, 4.0));
        assert!((from(0.85, 3) - &solution).norm() < 0.2 * (from(0.0, 3) - &solution).norm());
        let planar = problem(Law::Coulomb, 2, 0.5, DMatrix::identity(2, 2), dvector![-1.0, 9.0]);
        let solver = SequentialImpulses { sweeps: 0, warm_start: 0.85, residual: 0.0 };
        assert_eq!(solver.solve(&planar, Some(&dvector![2.0, -1.0])).expect("a law it takes").impulse, dvector![1.7, 0.0]);
    }

    #[test]
    fn the_residual_ends_the_sweeps() {
        let solver = SequentialImpulses { sweeps: 1000, warm_start: 0.0, residual: BULLET_RESIDUAL };
        let iterations = solver.solve(&chain(4), None).expect("a law it takes").iterations;
        let change = |sweeps| 2.0 * (swept(&chain(4), sweeps) - swept(&chain(4), sweeps - 1)).amax();
        assert!(change(iterations).powi(2) <= BULLET_RESIDUAL && change(iterations - 1).powi(2) > BULLET_RESIDUAL, "{iterations}");
    }

    #[test]
    fn the_box_of_a_contact_that_was_pressed_for_one_sweep_keeps_its_friction_and_the_cone_does_not() {
        // the second contact lifts the first: r_n = (1, 19/2) after one sweep, (0, 10) in the end
        let mut delassus = DMatrix::identity(6, 6);
        (delassus[(0, 3)], delassus[(3, 0)]) = (0.5, 0.5);
        let free = dvector![-1.0, 3.0, 0.0, -10.0, 0.0, 0.0];
        let cone = problem(Law::Coulomb, 3, 0.5, delassus.clone(), free.clone());
        assert_eq!(swept(&cone, 50), dvector![0.0, 0.0, 0.0, 10.0, 0.0, 0.0]);
        let square = problem(Law::PolyhedralCoulomb { directions: 4 }, 3, 0.5, delassus, free);
        let solver = SequentialImpulses { sweeps: 50, warm_start: 0.0, residual: 0.0 };
        let kept = solver.solve(&square, None).expect("a law it takes");
        assert!(kept.impulse[0] == 0.0 && (kept.impulse[1] + 0.5).abs() <= rounding(16, 1.0), "{}", kept.impulse);
        assert!(!residuals(&square, &kept).expect("finite").is_solution(crate::tolerance::certificate::CERTIFY));
        let right = LemkePivoting.solve(&square, None).expect("solvable");
        assert!((right.impulse - dvector![0.0, 0.0, 0.0, 10.0, 0.0, 0.0]).amax() <= rounding(64, 10.0));
    }

    #[test]
    fn the_cone_is_scaled_along_the_diagonal_s_slip_which_is_coulomb_s_where_the_diagonal_is_isotropic() {
        let (mu, free) = (0.1, dvector![-1.0, 3.0, 4.0]);
        let answer = |own: f64| {
            let one = problem(Law::Coulomb, 3, mu, DMatrix::from_diagonal(&dvector![1.0, own, 1.0]), free.clone());
            let solver = SequentialImpulses { sweeps: 200, warm_start: 0.0, residual: 0.0 };
            let solution = solver.solve(&one, None).expect("a law it takes");
            (
                solution.impulse.clone(),
                residuals(&one, &solution).expect("finite").is_solution(crate::tolerance::certificate::CERTIFY),
                solution.velocity,
            )
        };
        let (_, solved, _) = answer(1.0);
        assert!(solved);
        // with D = (4, 1) friction opposes D⁻¹u: r₁/r₂ = u₁/(4 u₂)
        let (r, solved, u) = answer(4.0);
        assert!(!solved && (r[1] * 4.0 * u[2] - r[2] * u[1]).abs() <= rounding(64, 4.0), "{r}{u}");
    }

    #[test]
    fn other_laws_are_refused_by_name() {
        for (law, word) in [(Law::Associated, "associated"), (Law::PolyhedralCoulomb { directions: 8 }, "square")] {
            let other = problem(law, 3, 0.5, DMatrix::identity(3, 3), dvector![-1.0, 0.0, 0.0]);
            let message = SequentialImpulses::default().solve(&other, None).expect_err("refused").to_string();
            assert!(message.contains("sequential-impulses") && message.contains(word), "{message}");
        }
    }
}
