//! Whether anything moves on a polyhedron.
//!
//! ```text
//!     {x ≥ 0 : A x = b} ∋ v :      A d = 0 ,   d_j ≥ 0 where v_j = 0 ,   g·d = 1
//! ```
//! By convexity g·x is the same on the polyhedron iff neither g nor −g has such a direction d from any one of its points v.

use super::feasibility::nonnegative_solution;
use dashu_ratio::RBig;
use moreau_exact::scalar::{Rational, ratio};
use nalgebra::{DMatrix, DVector};

/// d with `system` d = 0, d_j ≥ 0 where the point has a zero, and gain·d = 1; none if there is none. What `gain` does not name has none.
pub(super) fn moving(system: &DMatrix<Rational>, point: &DVector<Rational>, gain: &[Rational]) -> Option<DVector<Rational>> {
    let size = point.len();
    let free: Vec<usize> = (0..size).filter(|j| !point[*j].is_zero()).collect();
    let entry = |i: usize, j: usize| {
        if i < system.nrows() { system[(i, j)].clone() } else { gain.get(j).cloned().unwrap_or(RBig::ZERO) }
    };
    let split =
        DMatrix::from_fn(system.nrows() + 1, size + free.len(), |i, j| if j < size { entry(i, j) } else { -entry(i, free[j - size]) });
    let right = DVector::from_fn(system.nrows() + 1, |i, _| ratio(i64::from(i == system.nrows()), 1));
    let found = nonnegative_solution(&split, &right).point()?;
    let mut direction = found.rows(0, size).into_owned();
    free.iter().enumerate().for_each(|(place, j)| direction[*j] -= found[size + place].clone());
    Some(direction)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coordinate_moves_up_from_one_end_and_down_from_the_other_and_a_sum_that_is_given_does_not() {
        // x₁ + x₂ = 1: the segment from (0, 1) to (1, 0)
        let numbers = |numbers: &[i64]| numbers.iter().map(|x| ratio(*x, 1)).collect::<Vec<_>>();
        let system = DMatrix::from_row_slice(1, 2, &numbers(&[1, 1]));
        let from = |point: [i64; 2], gain: &[i64]| moving(&system, &DVector::from_vec(numbers(&point)), &numbers(gain));
        assert_eq!(from([0, 1], &[1]).expect("up").as_slice(), numbers(&[1, -1]));
        assert_eq!((from([0, 1], &[-1]), from([1, 0], &[1])), (None, None));
        assert_eq!(from([1, 0], &[-1]).expect("down").as_slice(), numbers(&[-1, 1]));
        assert!([[1, 1], [-1, -1]].iter().all(|gain| from([0, 1], gain).is_none()));
    }
}
