//! W r as if computed with twice the digits: where what cancels in it is more than a double can hide.
//!
//! ```text
//!     W stored       Σ_j W_ij r_j                                                              with error ε|·| + γ² Σ|W||r|
//!     by bodies      p = Hᵀr ,   M_b w_b = p_b ,   H w        of M and H as they were given, w by refinement to twice the digits
//! ```
//! T. Ogita, S. M. Rump, S. Oishi, *Accurate sum and dot product*, SIAM J. Sci. Comput. 26 (2005). By bodies the error of w is bounded with
//! X ≈ M_b⁻¹, ‖1 − X M_b‖ ≤ ½: |M_b⁻¹ ρ| ≤ 2 max |X||ρ| for what is left, ρ = p_b − M_b w_b, and its rounding.

use super::{MatrixFree, Operator};
use crate::tolerance::certificate::{gamma, row_rounding};
use moreau_exact::doubled::DoubledResiduals;
use nalgebra::{DMatrix, DVector};

/// Parts of w: each gains the digits that M_b leaves, four are twice the digits of a double up to ‖M_b‖‖M_b⁻¹‖ = 10⁸, eight up to 10¹².
const PARTS: usize = 8;

impl Operator {
    /// Adds W r to sums of doubled precision, and returns a bound of what that is off by beside ε of the sums, row by row, γ² of its terms
    /// where W is stored; `None` where none is known.
    pub(crate) fn add_doubled(&self, impulse: &[f64], sums: &mut DoubledResiduals<f64>) -> Option<Vec<f64>> {
        let rows = match self {
            Operator::Dense(dense) => {
                let columns = dense.as_slice().chunks_exact(dense.nrows().max(1)).zip(impulse).filter(|(_, r)| **r != 0.0);
                columns.for_each(|(column, r)| sums.subtract(column, &-r));
                1
            }
            Operator::Blocks(stored) => {
                let d = stored.blocks.rows_per_contact();
                for (k, r) in impulse.chunks_exact(d).enumerate().filter(|(_, r)| r.iter().any(|r| *r != 0.0)) {
                    for (j, block) in stored.blocks.column(k) {
                        block.chunks_exact(d).zip(r).for_each(|(column, r)| sums.subtract_from(j * d, column, &-r));
                    }
                }
                d
            }
            Operator::Bodies(bodies) => return bodies.free.add_doubled(impulse, sums),
        };
        let (stored, mut off, mut terms) = (self.of_contacts(), vec![0.0; impulse.len()], vec![0; impulse.len() / rows]);
        stored.write_terms(&mut terms);
        stored.add_magnitudes(impulse, &mut off);
        off.iter_mut().enumerate().for_each(|(row, off)| *off *= row_rounding(terms[row / rows]).powi(2));
        Some(off)
    }
}

impl MatrixFree {
    /// [`Operator::add_doubled`] of bodies.
    pub(crate) fn add_doubled(&self, impulse: &[f64], sums: &mut DoubledResiduals<f64>) -> Option<Vec<f64>> {
        let (jacobian, d) = (self.jacobian(), self.rows_per_contact());
        let size = jacobian.velocity_count();
        let (mut pushed, mut terms) = (DoubledResiduals::new(&vec![0.0; size]), vec![0.0; size]);
        for (k, r) in impulse.chunks_exact(d).enumerate() {
            for (body, block) in jacobian.contact(k) {
                let range = jacobian.velocities(body);
                for (row, r) in block.chunks_exact(range.len().max(1)).zip(r) {
                    pushed.subtract_from(range.start, row, &-r);
                    terms[range.clone()].iter_mut().zip(row).for_each(|(sum, h)| *sum += (h * r).abs());
                }
            }
        }
        let (high, low) = pushed.parts();
        // a row sums as many products as the parts of its velocities are
        let velocities = |k: usize| jacobian.bodies(k).iter().map(|body| jacobian.velocities(*body as usize).len()).sum::<usize>();
        let most = (0..jacobian.contacts()).map(velocities).max().unwrap_or(0);
        let part = self.most_rounding().max(gamma(PARTS * most + 8)).powi(2);
        let (mut velocity, mut doubt) = (vec![[0.0; PARTS]; size], vec![0.0; size]);
        for body in 0..jacobian.body_count() {
            let range = jacobian.velocities(body);
            let own = [&high[range.clone()], &low[range.clone()], &terms[range.clone()]];
            let (found, left) = solved(&self.mass(body).into_owned(), own, part)?;
            velocity[range.clone()].copy_from_slice(&found);
            doubt[range].copy_from_slice(left.as_slice());
        }
        let mut off = vec![0.0; impulse.len()];
        for (k, off) in off.chunks_exact_mut(d).enumerate() {
            for (body, block) in jacobian.contact(k) {
                let range = jacobian.velocities(body);
                for (at, row) in block.chunks_exact(range.len().max(1)).enumerate() {
                    for (h, v) in row.iter().zip(range.clone()) {
                        velocity[v].iter().for_each(|w| sums.subtract_from(k * d + at, &[*h], &-w));
                        off[at] += h.abs() * (doubt[v] + part * velocity[v][0].abs());
                    }
                }
            }
        }
        Some(off)
    }
}

/// w as a sum of [`PARTS`] numbers, and a bound of its error, of M w = high + low, whose products sum to `terms` without their signs.
fn solved(mass: &DMatrix<f64>, [high, low, terms]: [&[f64]; 3], part: f64) -> Option<(Vec<[f64; PARTS]>, DVector<f64>)> {
    let size = high.len();
    let inverse = mass.clone().try_inverse()?;
    let off = (DMatrix::identity(size, size) - &inverse * mass).abs() + inverse.abs() * mass.abs() * gamma(size + 2);
    if !off.row_iter().all(|row| row.sum() <= 0.5) {
        return None;
    }
    let mut found = vec![[0.0; PARTS]; size];
    let mut left = DVector::from_column_slice(high);
    for place in 0..PARTS {
        (&inverse * &left).iter().zip(&mut found).for_each(|(w, found)| found[place] = *w);
        let mut sums = DoubledResiduals::new(high);
        low.iter().enumerate().for_each(|(row, low)| sums.subtract_unit(row, &-low));
        for (v, parts) in found.iter().enumerate() {
            parts[..=place].iter().for_each(|w| sums.subtract(mass.column(v).as_slice(), w));
        }
        left = DVector::from_vec(sums.values());
    }
    let moved = mass.abs() * DVector::from_iterator(size, found.iter().map(|w| w[0].abs()));
    let rounded = (DVector::from_column_slice(terms) + moved) * part;
    let doubt = inverse.abs() * (left.abs() + rounded);
    Some((found, DVector::from_element(size, 2.0 * doubt.amax())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operator::BlockRows;
    use moreau_exact::scalar::{Rational, Scalar, exact};
    use nalgebra::dmatrix;

    /// Two bodies with masses that are no powers of two, three contacts, and impulses that nearly cancel.
    #[test]
    fn what_cancels_in_twice_the_digits_is_found_however_w_is_stored() {
        let masses = [dmatrix![3.0, 0.7; 0.7, 1.1], dmatrix![7e9, 3.0; 3.0, 0.3]];
        let mut rows = BlockRows::new(1, [2, 2]).unwrap();
        rows.push(&[(0, &[0.3, 1.0])]).unwrap();
        rows.push(&[(0, &[-0.1, -1.0]), (1, &[1.0, 0.2])]).unwrap();
        rows.push(&[(1, &[-1.0, 0.7])]).unwrap();
        let free = MatrixFree::new(&masses, rows).unwrap();
        let impulse = [1.0 / 3.0, 1e9 / 7.0, 1e9 / 7.0 * (1.0 + 1e-15)];
        let [mass, jacobian] = free.triplets().map(|of| of.to_dense().map(exact));
        let identity = DMatrix::identity(4, 4).map(|x: f64| exact(x));
        let inverse = moreau_exact::elimination::solve_columns(&mass, &identity).unwrap();
        let blocks = free.delassus().unwrap();
        let dense = blocks.to_dense();
        let stored = dense.map(exact);
        let made = &jacobian * inverse * jacobian.transpose();
        for (operator, w) in [(Operator::from(dense), &stored), (blocks.into(), &stored), (free.into(), &made)] {
            let r = DVector::from_iterator(3, impulse.iter().map(|r| exact(*r)));
            let whole = w * r;
            let given: Vec<f64> = whole.iter().map(|u| -Scalar::to_f64(u)).collect();
            let mut sums = DoubledResiduals::new(&given);
            let gamma = crate::tolerance::certificate::row_rounding(3);
            let off = operator.add_doubled(&impulse, &mut sums).unwrap();
            for (row, found) in sums.values().into_iter().enumerate() {
                let expected: f64 = Scalar::to_f64(&(whole[row].clone() + exact(given[row])));
                let terms: Rational =
                    (0..3).fold(Rational::ZERO, |sum, j| sum + Scalar::magnitude(&(w[(row, j)].clone() * exact(impulse[j]))));
                let bound = f64::EPSILON * expected.abs() + gamma * gamma * given[row].abs() + off[row];
                assert!((found - expected).abs() <= bound, "{row}: {found} {expected} {bound}");
                assert!(bound < 1e-3 * f64::EPSILON * Scalar::to_f64(&terms), "{row}: {bound} tells nothing");
            }
        }
    }
}
