//! The point of a cone that is nearest to a vector, in rounded numbers: it proposes what is proved elsewhere.
//!
//! ```text
//!     min ‖A x − b‖ ,  x ≥ 0 ;      the residual s = b − A x has  Aᵀs ≤ 0  and  b·s = ‖s‖²
//! ```
//! The active-set method of Lawson and Hanson (*Solving Least Squares Problems*, 1974, ch. 23).

use crate::tolerance::proof::SMALLEST_GAIN;
use nalgebra::{DMatrix, DVector};

/// x and b − A x after so many steps at most; each brings in a column.
pub(super) fn nonnegative(matrix: &DMatrix<f64>, right: &DVector<f64>, steps: usize) -> (DVector<f64>, DVector<f64>) {
    let n = matrix.ncols();
    let (mut x, mut passive) = (DVector::zeros(n), vec![false; n]);
    let sizes: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
    let mut residual = right.clone();
    for _ in 0..steps {
        let gain = |j: usize| matrix.column(j).dot(&residual) / (sizes[j] * right.norm());
        let free = (0..n).filter(|j| !passive[*j] && sizes[*j] > 0.0);
        let Some(entering) = free.max_by(|i, j| gain(*i).total_cmp(&gain(*j))) else { break };
        if gain(entering).is_nan() || gain(entering) <= SMALLEST_GAIN {
            break;
        }
        passive[entering] = true;
        while let Some(wanted) = restricted(matrix, right, &passive) {
            let limits = (0..n).filter(|j| passive[*j] && wanted[*j] <= 0.0).map(|j| x[j] / (x[j] - wanted[j]));
            let Some(step) = limits.min_by(f64::total_cmp) else {
                x = wanted;
                break;
            };
            x += (wanted - &x) * step.clamp(0.0, 1.0);
            let least = (0..n).filter(|j| passive[*j]).min_by(|i, j| x[*i].total_cmp(&x[*j]));
            for j in 0..n {
                if x[j] <= 0.0 || Some(j) == least {
                    (passive[j], x[j]) = (false, 0.0);
                }
            }
        }
        residual = right - matrix * &x;
    }
    (x, residual)
}

/// The least squares on the passive columns; none without any.
fn restricted(matrix: &DMatrix<f64>, right: &DVector<f64>, passive: &[bool]) -> Option<DVector<f64>> {
    let columns: Vec<usize> = (0..matrix.ncols()).filter(|j| passive[*j]).collect();
    if columns.is_empty() || columns.len() > matrix.nrows() {
        return None;
    }
    let qr = matrix.select_columns(&columns).qr();
    let solved = qr.r().solve_upper_triangular(&(qr.q().transpose() * right))?;
    let mut x = DVector::zeros(matrix.ncols());
    columns.iter().zip(solved.iter()).for_each(|(j, value)| x[*j] = *value);
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dvector;

    #[test]
    fn the_residual_separates_where_the_vector_is_outside_of_the_cone_and_vanishes_inside() {
        let cone = DMatrix::from_row_slice(3, 4, &[1.0, 1.0, 1.0, 1.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0, -1.0]);
        let (x, residual) = nonnegative(&cone, &dvector![2.0, 0.5, -0.25], 9);
        assert!(residual.norm() < 1e-14 && x.iter().all(|x| *x >= 0.0));
        let (_, residual) = nonnegative(&cone, &dvector![0.5, 2.0, 1.0], 9);
        assert!((cone.transpose() * &residual).max() < 1e-14 && residual.dot(&dvector![0.5, 2.0, 1.0]) > 1.0);
        let (x, residual) = nonnegative(&cone, &dvector![-1.0, 0.0, 0.0], 9);
        assert_eq!((x.amax(), residual[0]), (0.0, -1.0), "the apex");
    }
}
