//! A few contacts without friction: 0 ≤ z ⟂ w = M z + q ≥ 0 by the support α of z.
//!
//! ```text
//!     M_αα z_α = −q_α ,  z = 0 elsewhere ,      α is the right one  ⟺  z_α ≥ 0 ,  w ≥ 0 elsewhere
//! ```
//! All rows with a negative number change sides at once (Newton-min); where that comes back to a support it has seen, or to a singular
//! block, Lemke's path leads to one.
//!
//! Where q is u_free and M is W – no shift and no compliance that may cancel –, an answer whose every w on α is rounding, and which is
//! negative nowhere, has the relative residual 0 of the certificate:
//! ```text
//!     |w_i| ≤ ½ γ S_i ,   S_i = |q_i| + Σ |M_ij| z_j ,   γ = mε/(1 − mε) ,   m = 2n + 8 ,      γ S_i ≤ ½ 10⁻⁵ max |q_j|,  j meets i
//! ```
//! with n the contacts j ≠ i of M_ij ≠ 0 and i itself. w rounds by at most (n + 2)ε/2 S here and by (n + 3)ε/2 S there, together less
//! than the other half of γ S. So it is not asked.

use super::elimination::eliminate;
use super::parts::{MOST, answer, relative};
use super::path;
use super::rows::{Rows, Support, bit};
use crate::memory::spare;
use crate::problem::{ContactProblem, Solution};
use crate::tolerance::certificate::{HIDDEN, row_rounding};
use crate::tolerance::solvers::direct_steps;
use nalgebra::DVector;

/// What a support leads to.
struct Point {
    z: [f64; MOST],
    /// The rows whose basic number is negative: z in the support, w elsewhere.
    negative: Support,
    /// Whether all of w on the support is rounding, and rounding hides nothing.
    is_exact: bool,
}

/// The answer by a support.
pub(super) fn solve(problem: &ContactProblem, start: Option<&DVector<f64>>, enough: f64) -> Option<Solution> {
    let (normals, rows) = (Rows::of(problem)?, problem.rows_per_contact());
    let pressed = |k: &usize| start.is_some_and(|start| start[k * rows] > 0.0);
    let guess = (0..normals.size).filter(pressed).fold(0, |support, k| support | bit(k));
    let (name, (point, steps)) = match normals.newton_min(guess) {
        Some(found) => ("newton-min", found),
        None => ("lemke", normals.by_path()?),
    };
    let mut impulse = spare::zeros(problem.rows());
    (0..normals.size).for_each(|k| impulse[k * rows] = point.z[k]);
    let solution = answer(problem, name, impulse, steps);
    // the rounding of tangential rows is the certificate's affair
    let is_good = (rows == 1 && normals.is_plain && point.is_exact) || relative(problem, &solution) <= enough;
    is_good.then_some(solution)
}

impl Rows {
    /// Newton-min from a support, until it comes to one that it has seen.
    fn newton_min(&self, mut support: Support) -> Option<(Point, usize)> {
        let mut seen = [0; direct_steps(MOST) + 1];
        for steps in 0..=direct_steps(self.size) {
            if seen[..steps].contains(&support) {
                return None;
            }
            seen[steps] = support;
            let point = self.on_support(support)?;
            if point.negative == 0 {
                return Some((point, steps));
            }
            support ^= point.negative;
        }
        None
    }

    /// The support at the end of Lemke's path, if it is one.
    fn by_path(&self) -> Option<(Point, usize)> {
        let (support, pivots) = path::follow(self)?;
        let point = self.on_support(support)?;
        (point.negative == 0).then_some((point, pivots))
    }

    /// z and the sign of w on a support, once refined where w is more than rounding; `None` if its block has a pivot of zero.
    fn on_support(&self, support: Support) -> Option<Point> {
        let mut z = [0.0; MOST];
        if support != 0 {
            self.add_solution(support, &self.vector, &mut z)?;
        }
        let (w, mut point) = self.judged(support, z);
        if support != 0 && !point.is_exact && point.negative == 0 {
            self.add_solution(support, &w, &mut z)?;
            point = self.judged(support, z).1;
        }
        Some(point)
    }

    /// w at z, and what it says.
    fn judged(&self, support: Support, z: [f64; MOST]) -> ([f64; MOST], Point) {
        let n = self.size;
        let (mut w, mut negative, mut is_exact) = ([0.0; MOST], 0, true);
        for i in 0..n {
            let (mut sum, mut size, mut given) = (self.vector[i], self.vector[i].abs(), self.vector[i].abs());
            let mut terms = usize::from(self.matrix[i][i] == 0.0);
            for j in (0..n).filter(|j| self.matrix[i][*j] != 0.0) {
                let product = self.matrix[i][j] * z[j];
                sum += product;
                size += product.abs();
                given = given.max(self.vector[j].abs());
                terms += 1;
            }
            let floor = row_rounding(terms) * size;
            let inside = support & bit(i) != 0;
            // what is not a number is neither exact nor negative, and goes no further
            is_exact &= (sum.abs() <= 0.5 * floor || (!inside && sum >= 0.0)) && floor <= 0.5 * HIDDEN * given;
            if if inside { z[i] < 0.0 } else { sum < -0.5 * floor } {
                negative |= bit(i);
            }
            w[i] = sum;
        }
        (w, Point { z, negative, is_exact })
    }

    /// Adds the d with M_αα d_α = −b_α to z.
    fn add_solution(&self, support: Support, right_side: &[f64; MOST], z: &mut [f64; MOST]) -> Option<()> {
        let (mut members, mut count) = ([0; MOST], 0);
        for row in (0..self.size).filter(|row| support & bit(*row) != 0) {
            members[count] = row;
            count += 1;
        }
        let members = &members[..count];
        let (mut block, mut x) = ([[0.0; MOST]; MOST], [0.0; MOST]);
        for (i, row) in members.iter().enumerate() {
            members.iter().enumerate().for_each(|(j, column)| block[i][j] = self.matrix[*row][*column]);
            x[i] = -right_side[*row];
        }
        eliminate(&mut block, &mut x, count)?;
        members.iter().zip(x).for_each(|(row, x)| z[*row] += x);
        Some(())
    }
}
