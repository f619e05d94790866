//! The solution of a large LCP on the basis that an answer points to, enclosed, and every sign decided.
//!
//! ```text
//!     A = M_αα ,  b = −q_α ,  C ≈ A⁻¹ ,  r = b − A x̃      β = max_i ρ_i < 1 ,  ρ_i ≥ Σ_j |1 − C A|_ij
//!     |x − x̃|_i ≤ |C r|_i + ρ_i ‖C r‖_∞/(1 − β)
//! ```
//! (S. M. Rump, *Verification methods*, Acta Numerica 19 (2010), §10). All bounds are sums of numbers that are not negative, enlarged by
//! what rounding can take from them; residuals are evaluated with twice the digits. A is then regular, and the solution with that basis is
//! one: if z_α − e ≥ 0 and every other w, with its error, is not negative.

use super::planted::{Plant, planted};
use crate::problem::Lcp;
use crate::tolerance::certificate::gamma;
use moreau_exact::doubled::residual;
use moreau_exact::tolerance::EPSILON;
use nalgebra::{DMatrix, DVector};

/// z and w = M z + q of a solution, within these distances.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Enclosure {
    /// Middle and radius of every zᵢ.
    pub z: Vec<[f64; 2]>,
    /// Middle and radius of every wᵢ.
    pub w: Vec<[f64; 2]>,
}

/// Why no solution was enclosed.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Undecided {
    /// The basis is singular or nearly so: β is this.
    Basis(f64),
    /// The sign of z (or w) of this row is not decided, or wrong.
    Sign {
        row: usize,
        is_z: bool,
        /// Middle and radius.
        within: [f64; 2],
    },
}

/// What a sum of so many numbers that are not negative may be, given what it was rounded to.
fn above(sum: f64, terms: usize) -> f64 {
    sum * (1.0 + 2.0 * gamma(terms + 4)) + f64::MIN_POSITIVE * (terms + 4) as f64
}

/// b − Σ aᵢxᵢ with a bound of its error (Ogita, Rump, Oishi: ε|r| + γ²(|b| + Σ|aᵢxᵢ|)).
fn bounded_residual(b: f64, row: &[f64], x: &[f64]) -> [f64; 2] {
    let terms = || row.iter().zip(x).filter(|(a, x)| **a != 0.0 && **x != 0.0);
    let (count, magnitude) = terms().fold((1usize, b.abs()), |(count, sum), (a, x)| (count + 1, sum + (a * x).abs()));
    if count == 1 {
        return [b, 0.0];
    }
    let value = residual(&b, terms());
    let part = gamma(2 * count);
    [value, above(EPSILON * value.abs() + part * part * magnitude, count) + count as f64 * f64::MIN_POSITIVE / EPSILON]
}

/// Encloses the solution with this support.
pub(super) fn enclose(lcp: &Lcp<f64>, support: &[bool]) -> Result<Enclosure, Undecided> {
    let members: Vec<usize> = (0..lcp.size()).filter(|&i| support[i]).collect();
    let (middle, radius) = regular_solution(lcp, &members)?;
    let mut z = vec![[0.0; 2]; lcp.size()];
    for (j, &i) in members.iter().enumerate() {
        z[i] = [middle[j], radius[j]];
        if is_open(z[i]) {
            return Err(Undecided::Sign { row: i, is_z: true, within: z[i] });
        }
    }
    let mut w = vec![[0.0; 2]; lcp.size()];
    for i in (0..lcp.size()).filter(|&i| !support[i]) {
        let row: Vec<f64> = members.iter().map(|&j| -lcp.matrix[(i, j)]).collect();
        let [value, error] = bounded_residual(lcp.vector[i], &row, &middle);
        let spread = row.iter().zip(&radius).filter(|(a, _)| **a != 0.0).fold([0.0, 0.0], |[sum, n], (a, e)| [sum + a.abs() * e, n + 1.0]);
        let spread = if spread[1] == 0.0 { 0.0 } else { above(spread[0], members.len()) };
        w[i] = [value, if error == 0.0 && spread == 0.0 { 0.0 } else { above(error + spread, 1) }];
        if is_open(w[i]) {
            return Err(Undecided::Sign { row: i, is_z: false, within: w[i] });
        }
    }
    Ok(Enclosure { z, w })
}

/// Whether a number of this middle and radius may be negative.
fn is_open([middle, radius]: [f64; 2]) -> bool {
    (middle < radius || middle.is_nan() || radius.is_nan()) && !planted(Plant::Decided)
}

/// x̃ and a bound of |x − x̃| for M_αα x = −q_α.
fn regular_solution(lcp: &Lcp<f64>, members: &[usize]) -> Result<(Vec<f64>, Vec<f64>), Undecided> {
    let size = members.len();
    if size == 0 {
        return Ok((Vec::new(), Vec::new()));
    }
    let matrix = DMatrix::from_fn(size, size, |i, j| lcp.matrix[(members[i], members[j])]);
    let right = DVector::from_fn(size, |i, _| -lcp.vector[members[i]]);
    let inverse = matrix.clone().try_inverse().ok_or(Undecided::Basis(f64::INFINITY))?;
    let away = distance_from_identity(&matrix, &inverse);
    let worst = away.iter().copied().fold(0.0, |worst: f64, row| if row > worst || row.is_nan() { row } else { worst });
    if worst >= 0.5 || worst.is_nan() {
        return Err(Undecided::Basis(worst));
    }
    let rows = matrix.transpose();
    let residuals = |x: &DVector<f64>| -> Vec<[f64; 2]> {
        (0..size).map(|i| bounded_residual(right[i], rows.column(i).as_slice(), x.as_slice())).collect()
    };
    let middle_of = |bounded: &[[f64; 2]]| DVector::from_fn(size, |i, _| bounded[i][0]);
    let mut x = &inverse * &right;
    x += &inverse * middle_of(&residuals(&x));
    let left = residuals(&x);
    let correction = &inverse * middle_of(&left);
    // |C r| ≤ |fl(C r̃)| + |C| (error of r + γ |r̃|)
    let doubt = DVector::from_fn(size, |i, _| above(left[i][1] + gamma(size + 2) * left[i][0].abs(), size));
    let spread = inverse.map(f64::abs) * doubt;
    let first: Vec<f64> = (0..size).map(|i| above(correction[i].abs() + spread[i], size)).collect();
    let largest = first.iter().copied().fold(0.0, f64::max);
    let rest = above(largest / (1.0 - worst), 4);
    let radius = first.iter().zip(&away).map(|(first, away)| above(first + away * rest, 4)).collect();
    Ok((x.as_slice().to_vec(), radius))
}

/// At least Σ_j |1 − C A|_ij for every row i.
fn distance_from_identity(matrix: &DMatrix<f64>, inverse: &DMatrix<f64>) -> Vec<f64> {
    let size = matrix.nrows();
    let product = inverse * matrix;
    let row_sums = DVector::from_fn(size, |i, _| above(matrix.row(i).iter().map(|a| a.abs()).sum(), size));
    let magnitude = inverse.map(f64::abs) * row_sums;
    let off = |i: usize| product.row(i).iter().enumerate().map(|(j, p)| (if i == j { p - 1.0 } else { *p }).abs()).sum::<f64>();
    (0..size).map(|i| above(off(i) + gamma(size + 2) * above(magnitude[i], size), size)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::lcp_exact::{exact_near, support};
    use moreau_exact::scalar::{Rational, exact};

    fn random(size: usize, seed: u64) -> Lcp<f64> {
        let mut state = seed;
        let mut next = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / (1u64 << 30) as f64 - 1.0
        };
        let factor = DMatrix::from_fn(size, size, |_, _| next());
        let skew = DMatrix::from_fn(size, size, |_, _| next());
        let matrix = factor.tr_mul(&factor) + &skew - skew.transpose() + DMatrix::identity(size, size) * 1e-3;
        Lcp::new(matrix, DVector::from_fn(size, |_, _| next()))
    }

    #[test]
    fn the_exact_solution_lies_within_and_a_wrong_basis_is_not_enclosed() {
        for seed in 0..20 {
            let lcp = random(3 + seed as usize % 6, seed);
            let whole = Lcp::new(lcp.matrix.map(exact), lcp.vector.map(exact));
            let start = DVector::from_element(lcp.size(), 0.0);
            let solution = crate::certificate::complementary_cones::all_solutions(&whole).unwrap().points[0].clone();
            let z = solution.map(|z| moreau_exact::scalar::Scalar::to_f64(&z));
            let basis = support(&lcp, &z);
            assert_eq!(exact_near(&whole, &start, basis.clone()).expect("its own basis").z, solution);
            let found = enclose(&lcp, &basis).expect("strict");
            let inside = |x: &Rational, [middle, radius]: [f64; 2]| {
                let distance = exact(middle) - x;
                distance <= exact(radius) && -distance <= exact(radius)
            };
            let w = whole.slack(&solution);
            assert!((0..lcp.size()).all(|i| inside(&solution[i], found.z[i]) && inside(&w[i], found.w[i])), "{seed}");
            assert!(found.z.iter().all(|[middle, radius]| *radius <= 1e-9 * middle.abs().max(1e-3)), "{:?}", found.z);
            for i in 0..lcp.size() {
                let mut other = basis.clone();
                other[i] = !other[i];
                assert!(enclose(&lcp, &other).is_err(), "seed {seed}, row {i}: M is a P-matrix, with one solution");
            }
        }
    }

    #[test]
    fn a_radius_of_nothing_would_not_hold_the_solution() {
        // x = 1/3 is no floating-point number
        let lcp = Lcp::new(DMatrix::from_element(1, 1, 3.0), DVector::from_element(1, -1.0));
        let found = enclose(&lcp, &[true]).unwrap();
        let [middle, radius] = found.z[0];
        let distance = exact(middle) * exact(3.0) - Rational::ONE;
        assert!(!distance.is_zero() && radius > 0.0);
    }

    #[test]
    fn a_singular_basis_is_not_enclosed() {
        let lcp = Lcp::new(DMatrix::from_element(2, 2, 1.0), DVector::from_element(2, -1.0));
        assert!(matches!(enclose(&lcp, &[true, true]), Err(Undecided::Basis(_))));
        let on_one = enclose(&lcp, &[true, false]);
        assert!(matches!(on_one, Err(Undecided::Sign { row: 1, is_z: false, .. })), "w₂ = 0 is not decided: {on_one:?}");
    }
}
