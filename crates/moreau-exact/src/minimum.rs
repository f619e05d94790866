//! The witness of a minimum of a convex quadratic over a polyhedral cone, and of how it moves.
//!
//! ```text
//!     x minimises ½xᵀA x + b·x   over {x : G x ≥ 0} ,   A symmetric and positive definite, G of full row rank
//! ```
//! Without a row of G everything is admissible. Over dual numbers A and b move along a direction, and x has a slope to that side.

use crate::scalar::{Dual, Rational, Scalar};
use crate::witness::{Part, Witness, rational};

/// A convex quadratic and its cone.
pub struct Minimum<T, const N: usize> {
    /// A.
    pub matrix: [[T; N]; N],
    /// b.
    pub vector: [T; N],
    /// The rows of G, which do not move.
    pub rows: Vec<[T; N]>,
}

impl<T: Scalar, const N: usize> Minimum<T, N> {
    /// The nearest point of the cone, with weights for the squares of the components.
    pub fn projection(weights: [T; N], point: &[T; N], rows: Vec<[T; N]>) -> Self {
        let vector = std::array::from_fn(|i| -(weights[i].clone() * point[i].clone()));
        Minimum { matrix: diagonal(weights), vector, rows }
    }

    /// The witness that x is the minimiser; `None` for numbers that are neither rational nor dual over rationals.
    pub fn witness(&self, x: &[T; N]) -> Option<Witness> {
        let matrix: Vec<_> = self.matrix.iter().map(|row| told(row)).collect::<Option<_>>()?;
        let rows: Vec<_> = self.rows.iter().map(|row| told(row)).collect::<Option<_>>()?;
        let (vector, at) = (told(&self.vector)?, told(x)?);
        let of = |rows: &[Told], part: fn(&Told) -> &Vec<Rational>| Part::Matrix(rows.iter().map(|row| part(row).clone()).collect());
        let mut parts = vec![
            ("matrix", of(&matrix, |row| &row.0)),
            ("vector", Part::Vector(vector.0)),
            ("rows", of(&rows, |row| &row.0)),
            ("x", Part::Vector(at.0)),
        ];
        if rational::<T, Dual<Rational>>(&x[0]).is_some() {
            let still = rows.iter().flat_map(|row| &row.1).all(Rational::is_zero);
            let slopes = [("matrix_slope", of(&matrix, |row| &row.1)), ("vector_slope", Part::Vector(vector.1))];
            parts.extend(still.then_some(slopes)?);
            parts.push(("x_slope", Part::Vector(at.1)));
        }
        Some(Witness::new("cone-minimum", parts))
    }
}

/// The matrix with these entries on its diagonal.
pub fn diagonal<T: Scalar, const N: usize>(entries: [T; N]) -> [[T; N]; N] {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { entries[i].clone() } else { T::zero() }))
}

/// The edges μ n ± t ≥ 0 of a planar friction cone, components (n, t).
pub fn planar_cone<T: Scalar>(friction: &T) -> Vec<[T; 2]> {
    vec![[friction.clone(), T::one()], [friction.clone(), -T::one()]]
}

/// Values and slopes.
type Told = (Vec<Rational>, Vec<Rational>);

fn told<T: Scalar>(numbers: &[T]) -> Option<Told> {
    let one = |number: &T| {
        let dual = || rational::<T, Dual<Rational>>(number).map(|dual| (dual.value.clone(), dual.slope.clone()));
        rational::<T, Rational>(number).map(|value| (value.clone(), Rational::ZERO)).or_else(dual)
    };
    Some(numbers.iter().map(one).collect::<Option<Vec<_>>>()?.into_iter().unzip())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::ratio;

    #[test]
    fn numbers_that_are_not_exact_have_no_witness_and_dual_ones_have_slopes() {
        let line = |one: f64| Minimum::projection([one], &[-2.0], vec![[one]]).witness(&[0.0]);
        assert!(line(1.0).is_none());
        let names = |witness: Option<Witness>| witness.expect("it is exact").parts.iter().map(|(name, _)| *name).collect::<Vec<_>>();
        let exact = Minimum::projection([ratio(1, 1)], &[ratio(-2, 1)], vec![[ratio(1, 1)]]).witness(&[ratio(0, 1)]);
        assert_eq!(names(exact), ["matrix", "vector", "rows", "x"]);
        let [zero, one] = [0, 1].map(|x| Dual::constant(ratio(x, 1)));
        let moving = Dual { value: ratio(3, 1), slope: ratio(1, 1) };
        let dual =
            Minimum::projection([one.clone()], std::array::from_ref(&moving), vec![[one.clone()]]).witness(std::array::from_ref(&moving));
        assert_eq!(names(dual), ["matrix", "vector", "rows", "x", "matrix_slope", "vector_slope", "x_slope"]);
        assert!(Minimum { matrix: [[one]], vector: [zero.clone()], rows: vec![[moving]] }.witness(&[zero]).is_none());
    }
}
