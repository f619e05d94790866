//! Fischer and Burmeister's equations of all contacts, and the systems with their Jacobian:
//!
//! ```text
//!     ŷ = y + l μ‖y_t‖ n ,  l = 1 for Coulomb, 0 otherwise ;   x = (μ r_n, r_t)/√m ,   z = √m (ŷ_n/μ, ŷ_t) ,   m = μ √(ρ_n ρ_t)    [√J]
//!     φ_τ(x, z) = 0 at every contact (`fischer_burmeister_map.rs`);     where μ = 0:  x = r_n/√ρ_n ,  z = √ρ_n y_n ,  r_t = 0
//!     J = B (W + R + η/ρ) + A ,     A = ∂φ/∂x ∂x/∂r ,     B = ∂φ/∂z ∂z/∂y
//! ```

use super::block_elimination::Slopes;
use super::contact_systems::ContactSystems;
use super::fischer_burmeister_map::{FischerBurmeisterMap, value};
use crate::certificate::Judge;
use crate::cones::second_order;
use crate::operator::{BlockSparse, Sparse};
use crate::problem::{ContactProblem, Law};
use moreau_exact::Result;
use nalgebra::{DVector, Matrix3, Vector3};
use std::borrow::Cow;

/// φ and J of a problem.
pub(super) struct ConeEquations<'a> {
    pub(super) problem: &'a ContactProblem,
    operator: Cow<'a, BlockSparse>,
    systems: ContactSystems,
    /// ρ_n, ρ_t per contact \[kg\].
    weights: &'a [[f64; 2]],
}

impl<'a> ConeEquations<'a> {
    /// Of this problem.
    pub(super) fn new(problem: &'a ContactProblem) -> Result<Self> {
        let operator = match problem.delassus().blocks() {
            Some(blocks) => Cow::Borrowed(blocks),
            None => Cow::Owned(BlockSparse::from_sparse(&Sparse::of(problem.afforded_dense()?), problem.rows_per_contact())?),
        };
        let systems = ContactSystems::new(problem, &operator);
        Ok(ConeEquations { problem, operator, systems, weights: Judge::weights(problem) })
    }

    /// The d with J d = b.
    pub(super) fn direction(&mut self, slopes: &[Slopes], right_side: &DVector<f64>) -> Option<DVector<f64>> {
        self.systems.factor(&self.operator, slopes, false).then(|| self.systems.solve(&self.operator, right_side)).flatten()
    }

    /// ‖φ_τ‖/√contacts \[√J\].
    pub(super) fn mean(&self, impulse: &DVector<f64>, law_velocity: &DVector<f64>, smoothing: f64) -> f64 {
        self.residual(impulse, law_velocity, smoothing).norm() / (self.problem.contacts().max(1) as f64).sqrt()
    }

    /// φ_τ \[√J\].
    pub(super) fn residual(&self, impulse: &DVector<f64>, law_velocity: &DVector<f64>, smoothing: f64) -> DVector<f64> {
        let rows = self.problem.rows_per_contact();
        let mut residual = DVector::zeros(self.problem.rows());
        for k in 0..self.problem.contacts() {
            let pair = self.pair(k, [impulse, law_velocity]);
            let found = match pair.is_line {
                true => FischerBurmeisterMap::half_line(pair.x[0], pair.z[0], smoothing).value + Vector3::new(0.0, pair.x[1], pair.x[2]),
                false => value(&pair.x, &pair.z, smoothing),
            };
            (0..rows).for_each(|row| residual[k * rows + row] = found[row]);
        }
        residual
    }

    /// The impulses with x = P(x − z), the projection on the cone: as near as r itself, and exactly zero where a contact is open.
    pub(super) fn projected(&self, impulse: &DVector<f64>, law_velocity: &DVector<f64>) -> DVector<f64> {
        let rows = self.problem.rows_per_contact();
        let mut projected = DVector::zeros(self.problem.rows());
        for k in 0..self.problem.contacts() {
            let pair = self.pair(k, [impulse, law_velocity]);
            let mut x = pair.x - pair.z;
            let friction = if pair.is_line { 0.0 } else { 1.0 };
            second_order::project(&mut x.as_mut_slice()[..rows], friction);
            (0..rows).for_each(|row| projected[k * rows + row] = x[row] / pair.from_impulse[(row, row)]);
        }
        projected
    }

    /// x and z of contact k, padded, with ∂x/∂r and ∂z/∂y.
    fn pair(&self, k: usize, [impulse, law_velocity]: [&DVector<f64>; 2]) -> Pair {
        let (rows, mu) = (self.problem.rows_per_contact(), super::cone_friction(self.problem, k));
        let [r, y] = [impulse, law_velocity].map(|of| Vector3::from_fn(|row, _| if row < rows { of[k * rows + row] } else { 0.0 }));
        let [rho_n, rho_t] = self.weights[k];
        let is_line = rows == 1 || mu == 0.0;
        let root = if is_line { rho_n.sqrt() } else { (mu * (rho_n * rho_t).sqrt()).sqrt() };
        let mut from_impulse = Matrix3::identity() / root;
        let mut from_velocity = Matrix3::zeros();
        if is_line {
            from_velocity[(0, 0)] = root;
        } else {
            from_impulse[(0, 0)] = mu / root;
            from_velocity = Matrix3::identity() * root;
            from_velocity[(0, 0)] = root / mu;
        }
        let mut z = from_velocity * y;
        let slip = y[1].hypot(y[2]);
        if !is_line && self.problem.law() == Law::Coulomb {
            z[0] += root * slip;
            if slip > 0.0 {
                [1, 2].into_iter().for_each(|row| from_velocity[(0, row)] = root * y[row] / slip);
            }
        }
        Pair { is_line, x: from_impulse * r, z, from_impulse, from_velocity }
    }

    /// A_k and B_k: what φ_τ of contact k asks of its own impulse, and of its velocity y; τ \[√J\] and η are given.
    pub(super) fn slopes(&self, k: usize, at: [&DVector<f64>; 2], [smoothing, softness]: [f64; 2]) -> Slopes {
        let rows = self.problem.rows_per_contact();
        let pair = self.pair(k, at);
        let map = match pair.is_line {
            true => FischerBurmeisterMap::half_line(pair.x[0], pair.z[0], smoothing),
            false => FischerBurmeisterMap::at(&pair.x, &pair.z, smoothing),
        };
        let (mut own, through) = (map.along_x * pair.from_impulse, map.along_z * pair.from_velocity);
        let [rho_n, rho_t] = self.weights[k];
        for column in 0..rows {
            let softness = self.problem.row_compliance(k * rows + column) + softness / if column == 0 { rho_n } else { rho_t };
            (0..rows).for_each(|i| own[(i, column)] += through[(i, column)] * softness);
        }
        if pair.is_line {
            [1, 2].into_iter().for_each(|row| own[(row, row)] = pair.from_impulse[(row, row)]);
        }
        Slopes { own, through, inverse: None }
    }
}

/// The pair of a contact.
struct Pair {
    /// Whether it is one of the half line.
    is_line: bool,
    /// x \[√J\].
    x: Vector3<f64>,
    /// z \[√J\].
    z: Vector3<f64>,
    /// ∂x/∂r.
    from_impulse: Matrix3<f64>,
    /// ∂z/∂y.
    from_velocity: Matrix3<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solvers::test_problems::four_corners;
    use crate::tolerance::cones::{DIFFERENCE_STEP, difference_error};
    use nalgebra::DMatrix;

    const LAWS: [Law; 3] = [Law::Frictionless, Law::Coulomb, Law::Associated];
    const SMOOTHING: f64 = 0.5;

    /// The largest difference of J from the differences of φ_τ with another lift, and what rounding and curvature leave.
    fn difference(problem: &ContactProblem, values_of: &ContactProblem) -> [f64; 2] {
        let (equations, values) = (ConeEquations::new(problem).unwrap(), ConeEquations::new(values_of).unwrap());
        // one contact presses and sticks or slides, one is open
        let impulse = DVector::from_vec(vec![0.4, -0.05, 0.02, 0.3, -0.1, -0.1, -0.8, 0.0, 0.0, 0.1, 0.3, 0.2]);
        let velocity = problem.law_velocity(&impulse);
        let mut jacobian = DMatrix::zeros(12, 12);
        for k in 0..4 {
            let Slopes { own, through, .. } = equations.slopes(k, [&impulse, &velocity], [SMOOTHING, 0.0]);
            let block = through * problem.dense().fixed_rows::<3>(3 * k);
            jacobian.fixed_rows_mut::<3>(3 * k).copy_from(&block);
            let mut diagonal = jacobian.fixed_view_mut::<3, 3>(3 * k, 3 * k);
            diagonal += own;
        }
        let column = |column: usize| {
            let shifted = |by: f64| {
                let mut moved = impulse.clone();
                moved[column] += by;
                values.residual(&moved, &problem.law_velocity(&moved), SMOOTHING)
            };
            (jacobian.column(column) - (shifted(DIFFERENCE_STEP) - shifted(-DIFFERENCE_STEP)) / (2.0 * DIFFERENCE_STEP)).amax()
        };
        // ‖y_t‖ and s are above 0.3, the entries of x, z and J below 16
        [(0..12).map(column).fold(0.0, f64::max), difference_error(0.3, 16.0)]
    }

    #[test]
    fn the_jacobian_is_the_derivative_of_its_own_equations_alone() {
        for law in LAWS {
            for values_of in LAWS {
                let [one, other] = [law, values_of].map(|law| four_corners(law, 0.7, 0.9));
                let [found, bound] = difference(&one, &other);
                assert_eq!(found <= bound, law == values_of, "{law:?} {values_of:?}: {found:e} and {bound:e}");
            }
        }
    }
}
