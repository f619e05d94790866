//! The exact solution of an LCP on the basis that an answer points to.
//!
//! ```text
//!     α = {i : zᵢ > wᵢ/mᵢᵢ} :     M_αα z_α = −q_α ,  z elsewhere 0 ,   then  z ≥ 0 ,  w = M z + q ≥ 0 ,  w_α = 0     in rationals
//! ```
//! Where columns of M_αα depend on others, their z keep the values that the answer gave them. If a sign is wrong, its row changes sides, a
//! few times: rounding hides on which side a row with z and w near zero is.

use super::planted::{Plant, planted};
use crate::problem::Lcp;
use crate::tolerance::complementarity::EXCHANGES;
use moreau_exact::lifting::{independent, solve, whole_rows};
use moreau_exact::scalar::{Rational, exact};
use nalgebra::{DMatrix, DVector};

/// z and w = M z + q with 0 ≤ z ⟂ w ≥ 0, exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct ExactSolution {
    /// z.
    pub z: DVector<Rational>,
    /// w.
    pub w: DVector<Rational>,
}

/// A row whose sign is wrong, with the number.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct WrongSign {
    pub row: usize,
    /// Whether it is z of the row; w otherwise.
    pub is_z: bool,
    pub value: Rational,
}

/// An exact solution on a basis near z, or the sign that is wrong on the first one.
///
/// # Panics
/// If z has another size or is not finite.
pub(super) fn exact_near(lcp: &Lcp<Rational>, z: &DVector<f64>, mut support: Vec<bool>) -> Result<ExactSolution, WrongSign> {
    let mut first = None;
    for _ in 0..=EXCHANGES {
        let wrong = match on_support(lcp, z, &support) {
            Ok(solution) => return Ok(solution),
            Err(wrong) => wrong,
        };
        support[wrong.row] = !wrong.is_z;
        let repeated = first.get_or_insert_with(|| wrong.clone());
        if wrong.is_z == support[wrong.row] {
            return Err(repeated.clone());
        }
    }
    Err(first.expect("the first basis failed"))
}

/// The rows that an answer presses: zᵢ > wᵢ/mᵢᵢ, with the unit where mᵢᵢ is not positive.
pub(super) fn support(lcp: &Lcp<f64>, z: &DVector<f64>) -> Vec<bool> {
    let w = lcp.slack(z);
    let presses = |i: usize| {
        let diagonal = lcp.matrix[(i, i)];
        z[i] > 0.0 && (if diagonal > 0.0 { z[i] * diagonal } else { z[i] }) > w[i]
    };
    (0..lcp.size()).map(presses).collect()
}

/// z on a support, checked in every row; the worst wrong sign otherwise.
fn on_support(lcp: &Lcp<Rational>, given: &DVector<f64>, support: &[bool]) -> Result<ExactSolution, WrongSign> {
    let members: Vec<usize> = (0..lcp.size()).filter(|&i| support[i]).collect();
    let z = values(lcp, given, &members);
    let wrong_z = worst(&z, |_, z| *z < Rational::ZERO).map(|row| WrongSign { row, is_z: true, value: z[row].clone() });
    if let Some(wrong) = wrong_z {
        return Err(wrong);
    }
    let w = lcp.slack(&z);
    match worst(&w, |i, w| *w < Rational::ZERO || (support[i] && !w.is_zero())) {
        None => Ok(ExactSolution { z, w }),
        Some(row) => Err(WrongSign { row, is_z: false, value: w[row].clone() }),
    }
}

/// The row with the smallest number among those that are wrong.
fn worst(numbers: &DVector<Rational>, is_wrong: impl Fn(usize, &Rational) -> bool) -> Option<usize> {
    let rows = (0..numbers.len()).filter(|_| !planted(Plant::Decided));
    rows.filter(|&i| is_wrong(i, &numbers[i])).min_by(|&i, &k| numbers[i].cmp(&numbers[k]))
}

/// z with w = 0 in as many rows of the support as are independent.
fn values(lcp: &Lcp<Rational>, given: &DVector<f64>, members: &[usize]) -> DVector<Rational> {
    let block = DMatrix::from_fn(members.len(), members.len(), |i, j| lcp.matrix[(members[i], members[j])].clone());
    let right = DVector::from_fn(members.len(), |i, _| -lcp.vector[members[i]].clone());
    let (whole, _) = whole_rows(&block, &right);
    let (rows, columns) = independent(&whole);
    let kept: Vec<usize> = (0..members.len()).filter(|j| columns.binary_search(j).is_err()).collect();
    let mut z = DVector::from_element(lcp.size(), Rational::ZERO);
    kept.iter().for_each(|&j| z[members[j]] = exact(given[members[j]]));
    let system = DMatrix::from_fn(rows.len(), columns.len(), |i, j| block[(rows[i], columns[j])].clone());
    let rest = DVector::from_fn(rows.len(), |i, _| {
        kept.iter().fold(right[rows[i]].clone(), |sum, &j| sum - &block[(rows[i], j)] * &z[members[j]])
    });
    let (whole, rest) = whole_rows(&system, &rest);
    if let Some(found) = solve(&whole, &rest) {
        columns.iter().zip(found.rationals().iter()).for_each(|(&j, value)| z[members[j]] = value.clone());
    }
    z
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::lcp::residuals;
    use moreau_exact::scalar::ratio;
    use nalgebra::{dmatrix, dvector};

    fn rationals(lcp: &Lcp<f64>) -> Lcp<Rational> {
        Lcp::new(lcp.matrix.map(exact), lcp.vector.map(exact))
    }

    fn near(lcp: &Lcp<f64>, z: &DVector<f64>) -> Result<ExactSolution, WrongSign> {
        exact_near(&rationals(lcp), z, support(lcp, z))
    }

    #[test]
    fn thirds_are_found_from_floating_point_numbers() {
        let lcp = Lcp::new(dmatrix![2.0, 1.0; 1.0, 2.0], dvector![-1.0, -1.0]);
        let found = near(&lcp, &dvector![0.3333, 0.3334]).expect("regular");
        assert_eq!(found.z, dvector![ratio(1, 3), ratio(1, 3)]);
        assert!(residuals(&rationals(&lcp), &found.z).vanish());
    }

    #[test]
    fn dependent_columns_keep_what_the_answer_gave_them() {
        let lcp = Lcp::new(dmatrix![1.0, 1.0; 1.0, 1.0], dvector![-1.0, -1.0]);
        let found = near(&lcp, &dvector![0.31, 0.7]).expect("z₁ + z₂ = 1");
        assert_eq!(found.z, dvector![Rational::ONE - exact(0.7), exact(0.7)]);
    }

    #[test]
    fn a_row_on_the_wrong_side_changes_it_and_a_problem_without_solution_names_a_row() {
        let lcp = Lcp::new(dmatrix![2.0, 1.0; 1.0, 1.0], dvector![-2.0, -1.0]); // z = (1, 0), w = 0
        let exact = near(&lcp, &dvector![1.0, -1e-17]).expect("degenerate");
        assert_eq!(exact.z, dvector![ratio(1, 1), ratio(0, 1)]);
        assert_eq!(near(&lcp, &dvector![0.0, 5.0]).expect("found from far").z, exact.z);
        let none = Lcp::new(dmatrix![0.0, 0.0; 0.0, 1.0], dvector![-1.0, -1.0]);
        let wrong = near(&none, &dvector![0.0, 1.0]).expect_err("w₁ = −1 for all z");
        assert_eq!((wrong.row, wrong.is_z, wrong.value), (0, false, ratio(-1, 1)));
    }
}
