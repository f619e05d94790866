//! Whether a monotone LCP has a second solution: M + Mᵀ ⪰ 0, so that its solutions are a polyhedron.
//!
//! Let z be a solution, w = M z + q, and z + d another. Then dᵀM d = −zᵀw′ − z′ᵀw ≤ 0, hence
//!
//! ```text
//!     (M + Mᵀ) d = 0 ,   q·d = 0 ,   d_i = 0 where w_i > 0 ,   (M d)_i = 0 where z_i > 0 ,
//!     d_i ≥ 0  and  (M d)_i ≥ 0      where z_i = w_i = 0 ;
//! ```
//! and every d ≠ 0 with this leads to others: (z + t d)ᵀ(w + t M d) = t (d·(M + Mᵀ)z + d·q) + t² dᵀM d = 0 for all t. So there is one
//! solution iff no such d is, which the kernel of the equations and a linear program decide in fractions.
//!
//! Source: R. W. Cottle, J.-S. Pang, R. E. Stone, *The Linear Complementarity Problem*, Academic Press (1992), theorem 3.1.7.

use super::feasibility::nonnegative_solution;
use crate::problem::Lcp;
use moreau_exact::elimination::rank;
use moreau_exact::lifting::{independent, solve, whole_rows};
use moreau_exact::scalar::{Rational, ratio};
use nalgebra::{DMatrix, DVector};

/// A direction from z to other solutions, or `Some(None)` if there is none: z is the only one. `None` if it is not decided.
///
/// M + Mᵀ must be positive semidefinite and z a solution.
pub(super) fn direction(lcp: &Lcp<Rational>, z: &DVector<Rational>) -> Option<Option<DVector<Rational>>> {
    let (size, w) = (lcp.size(), lcp.slack(z));
    let moving: Vec<usize> = (0..size).filter(|i| w[*i].is_zero()).collect();
    let sum = |i: usize, j: usize| &lcp.matrix[(i, j)] + &lcp.matrix[(j, i)];
    let pressed: Vec<usize> = moving.iter().copied().filter(|i| !z[*i].is_zero()).collect();
    let equation = |row: usize, j: usize| match row {
        row if row < size => sum(row, j),
        row if row == size => lcp.vector[j].clone(),
        row => lcp.matrix[(pressed[row - size - 1], j)].clone(),
    };
    let kernel = kernel(&DMatrix::from_fn(size + 1 + pressed.len(), moving.len(), |i, j| equation(i, moving[j])))?;
    let full = |c: &DVector<Rational>| {
        let mut d = DVector::from_element(size, Rational::ZERO);
        moving.iter().zip((&kernel * c).iter()).for_each(|(i, entry)| d[*i] = entry.clone());
        d
    };
    let dimension = kernel.ncols();
    if dimension == 0 {
        return Some(None);
    }
    // signs of d and M d at the rows where z = w = 0, as rows that act on c
    let columns: Vec<DVector<Rational>> = (0..dimension).map(|k| full(&unit(dimension, k))).collect();
    let moved: Vec<DVector<Rational>> = columns.iter().map(|d| &lcp.matrix * d).collect();
    let degenerate: Vec<usize> = moving.iter().copied().filter(|i| z[*i].is_zero()).collect();
    let count = degenerate.len();
    let signs = DMatrix::from_fn(2 * count, dimension, |i, k| if i < count { &columns } else { &moved }[k][degenerate[i % count]].clone());
    if rank(&signs) < dimension {
        // a line without any sign to keep
        return kernel_vector(&signs).map(|c| Some(full(&c)));
    }
    // signs c = s ≥ 0 with Σ s = 1
    let entry = |i: usize, j: usize| match (i < 2 * count, j) {
        (true, j) if j < dimension => signs[(i, j)].clone(),
        (true, j) if j < 2 * dimension => -signs[(i, j - dimension)].clone(),
        (true, j) => ratio(-i64::from(j - 2 * dimension == i), 1),
        (false, j) => ratio(i64::from(j >= 2 * dimension), 1),
    };
    let system = DMatrix::from_fn(2 * count + 1, 2 * dimension + 2 * count, entry);
    let found = nonnegative_solution(&system, &unit(2 * count + 1, 2 * count)).point();
    Some(found.map(|x| full(&DVector::from_fn(dimension, |k, _| &x[k] - &x[dimension + k]))))
}

fn unit(size: usize, place: usize) -> DVector<Rational> {
    DVector::from_fn(size, |i, _| ratio(i64::from(i == place), 1))
}

fn kernel_vector(matrix: &DMatrix<Rational>) -> Option<DVector<Rational>> {
    kernel(matrix).filter(|kernel| kernel.ncols() > 0).map(|kernel| kernel.column(0).into_owned())
}

/// A basis of {x : A x = 0}, column by column: one of each column of A that depends on others. `None` if A is none but of a rank that a
/// prime hides.
fn kernel(matrix: &DMatrix<Rational>) -> Option<DMatrix<Rational>> {
    let (whole, _) = whole_rows(matrix, &DVector::from_element(matrix.nrows(), Rational::ZERO));
    let (rows, columns) = independent(&whole);
    let regular = DMatrix::from_fn(rows.len(), columns.len(), |i, j| whole[(rows[i], columns[j])].clone());
    let mut found = Vec::new();
    for free in (0..matrix.ncols()).filter(|j| columns.binary_search(j).is_err()) {
        let through = solve(&regular, &DVector::from_fn(rows.len(), |i, _| -&whole[(rows[i], free)]))?.rationals();
        let mut x = unit(matrix.ncols(), free);
        columns.iter().zip(through.iter()).for_each(|(j, value)| x[*j] = value.clone());
        if (matrix * &x).iter().any(|entry| !entry.is_zero()) {
            return None;
        }
        found.push(x);
    }
    Some(DMatrix::from_fn(matrix.ncols(), found.len(), |i, k| found[k][i].clone()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::complementary_cones::all_solutions;
    use crate::certificate::definiteness::positive_semidefinite;
    use crate::certificate::lcp::residuals;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn one_solution_is_what_enumeration_finds_and_every_direction_leads_to_another(
            entries in proptest::collection::vec(-2i64..3, 50), size in 1usize..6, rank in 0usize..5, skew in 0i64..2, solvable in 0i64..3,
        ) {
            let b = |i: usize, k: usize| if k < rank { ratio(entries[5 * i + k], 1) } else { Rational::ZERO };
            let gram = |i: usize, j: usize| (0..5).fold(Rational::ZERO, |sum, k| sum + b(i, k) * b(j, k));
            let turned = |i: usize, j: usize| ratio(skew * entries[25 + 5 * i.min(j) + i.max(j)] * if i < j { 1 } else { -1 }, 1);
            let matrix = DMatrix::from_fn(size, size, |i, j| if i == j { gram(i, j) } else { gram(i, j) + turned(i, j) });
            prop_assert!(positive_semidefinite(&matrix).holds());
            let zero_or = |x: i64| ratio(x.max(0), 1);
            // q so that z and w with z ⟂ w are a solution, degenerate ones too, or any q
            let z = DVector::from_fn(size, |i, _| if i % 2 == 0 { zero_or(entries[40 + i]) } else { Rational::ZERO });
            let w = DVector::from_fn(size, |i, _| if i % 2 == 1 { zero_or(entries[44 + i]) } else { Rational::ZERO });
            let vector = if solvable > 0 { &w - &matrix * &z } else { DVector::from_fn(size, |i, _| ratio(entries[40 + i], 1)) };
            let lcp = Lcp::new(matrix, vector);
            let set = all_solutions(&lcp).unwrap();
            for z in &set.points {
                match direction(&lcp, z).expect("decided") {
                    None => prop_assert!(set.is_unique(), "{:?}", set),
                    Some(d) => {
                        prop_assert!(!set.is_unique() && d.iter().any(|d| !d.is_zero()));
                        let step = (0..60).map(|power| ratio(1, 1 << power)).find(|t| residuals(&lcp, &(z + &d * t.clone())).vanish());
                        prop_assert!(step.is_some(), "{d}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_square_has_its_one_solution_and_a_strip_has_many() {
        let lcp = |q: [i64; 2]| Lcp::new(DMatrix::from_element(2, 2, Rational::ONE), DVector::from_row_slice(&q.map(|x| ratio(x, 1))));
        // z₁ + z₂ = 1 with both free to change; with q = (−1, 0) the second has w = 1
        assert!(direction(&lcp([-1, -1]), &DVector::from_row_slice(&[ratio(1, 2), ratio(1, 2)])).unwrap().is_some());
        assert_eq!(direction(&lcp([-1, 0]), &DVector::from_row_slice(&[ratio(1, 1), ratio(0, 1)])), Some(None));
    }
}
