//! The Delassus operator W = H M⁻¹ Hᵀ.
//!
//! Column j of W is the change of the contact velocities u = H v caused by a unit impulse at row j. With M = L D Lᵀ
//! and L Y = Hᵀ it is W = Yᵀ D⁻¹ Y: symmetric and positive semidefinite by construction, and free of square roots, so
//! the same code serves `f64` and exact rationals.

use moreau_exact::number::counted;
use moreau_exact::scalar::{Rational, Scalar};
use moreau_exact::witness::{Witness, decided, rational};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// W = H M⁻¹ Hᵀ \[1/kg\], exactly symmetric: one triangle is computed, the other is its mirror image.
///
/// `mass` is M, nv × nv, symmetric positive definite; `jacobian` is H, rows × nv.
///
/// # Errors
/// [`Error::Invalid`] if the shapes do not fit, a number is not finite, or M is not symmetric positive definite.
///
/// # Source
/// Chapter §3 (the Delassus operator); Golub and Van Loan, *Matrix Computations*, §4.1 (LDLᵀ).
/// ```
/// use moreau_contact::contact::delassus::delassus;
/// use moreau_contact::nalgebra::dmatrix;
///
/// // a mass of 2 kg on the floor and one of 4 kg on top of it
/// let w = delassus(&dmatrix![2.0, 0.0; 0.0, 4.0], &dmatrix![1.0, 0.0; -1.0, 1.0])?;
/// assert_eq!(w, dmatrix![0.5, -0.5; -0.5, 0.75]);
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn delassus<T: Scalar>(mass: &DMatrix<T>, jacobian: &DMatrix<T>) -> Result<DMatrix<T>> {
    let decide = || delassus_factored(&MassFactor::new(mass)?, jacobian);
    decided(decide, |found| {
        let [mass, jacobian, found]: [&DMatrix<Rational>; 3] = [rational(mass)?, rational(jacobian)?, rational(found.as_ref().ok()?)?];
        Some(Witness::new("delassus", vec![("mass", mass.into()), ("jacobian", jacobian.into()), ("delassus", found.into())]))
    })
}

/// W = H M⁻¹ Hᵀ \[1/kg\] of a mass matrix that is factored already.
///
/// # Errors
/// [`Error::Invalid`] if H has another number of columns than M, or a number that is not finite.
pub fn delassus_factored<T: Scalar>(factor: &MassFactor<T>, jacobian: &DMatrix<T>) -> Result<DMatrix<T>> {
    if jacobian.ncols() != factor.pivots.len() {
        let problem = format!("has {}", counted(jacobian.ncols(), "column"));
        return Err(Error::invalid(
            "jacobian",
            problem,
            format!("give {}, one per row of the mass matrix", counted(factor.pivots.len(), "column")),
        ));
    }
    finite("jacobian", jacobian)?;
    let mut half = jacobian.transpose();
    for mut column in half.column_iter_mut() {
        factor.forward(column.as_mut_slice());
    }
    let rows = jacobian.nrows();
    let mut delassus = DMatrix::zeros(rows, rows);
    for i in 0..rows {
        // A contact row touches the velocities of two bodies only: most entries are zero.
        let column = half.column(i);
        let nonzero = column.iter().zip(&factor.pivots).enumerate().filter(|(_, (y, _))| !y.is_zero());
        let weighted: Vec<(usize, T)> = nonzero.map(|(k, (y, d))| (k, y.clone() / d.clone())).collect();
        for j in 0..=i {
            let entry = weighted.iter().fold(T::zero(), |sum, (k, y)| sum + y.clone() * half[(*k, j)].clone());
            delassus[(i, j)] = entry.clone();
            delassus[(j, i)] = entry;
        }
    }
    Ok(delassus)
}

/// The factorisation M = L D Lᵀ of a mass matrix, L unit lower triangular, D diagonal and positive.
#[derive(Clone, Debug)]
pub struct MassFactor<T: Scalar> {
    /// Row i of L below the diagonal: (k, L_ik) for k < i where it is not zero. No row at all, if the matrix is diagonal.
    lower: Vec<Vec<(usize, T)>>,
    pivots: Vec<T>,
}

impl<T: Scalar> MassFactor<T> {
    /// Factors M.
    ///
    /// # Errors
    /// [`Error::Invalid`] if M is not square, not finite, not symmetric or not positive definite – for `f64` beyond
    /// rounding, for rationals exactly.
    pub fn new(mass: &DMatrix<T>) -> Result<Self> {
        if !mass.is_square() {
            return Err(Error::invalid("mass", format!("has shape {}×{}", mass.nrows(), mass.ncols()), "give a square mass matrix"));
        }
        let n = mass.nrows();
        if is_diagonal(mass) {
            let pivots = (0..n).map(|j| definite(j, mass[(j, j)].clone(), &mass[(j, j)], n)).collect::<Result<_>>()?;
            return Ok(MassFactor::from_pivots(pivots));
        }
        finite("mass", mass)?;
        symmetric(mass)?;
        let mut lower: Vec<Vec<(usize, T)>> = vec![Vec::new(); n];
        let mut pivots: Vec<T> = Vec::with_capacity(n);
        for j in 0..n {
            let pivot = definite(j, mass[(j, j)].clone() - product(&lower[j], &lower[j], &pivots), &mass[(j, j)], n)?;
            for i in j + 1..n {
                let entry = mass[(i, j)].clone() - product(&lower[i], &lower[j], &pivots);
                if !entry.is_zero() {
                    lower[i].push((j, entry / pivot.clone()));
                }
            }
            pivots.push(pivot);
        }
        Ok(MassFactor { lower, pivots })
    }

    /// The factor of a matrix with blocks on its diagonal, one after the other.
    ///
    /// # Errors
    /// Those of [`MassFactor::new`] at one of the blocks.
    pub fn of_blocks(blocks: &[DMatrix<T>]) -> Result<Self> {
        let (mut lower, mut pivots) = (Vec::new(), Vec::new());
        for block in blocks {
            let (first, factor) = (pivots.len(), MassFactor::new(block)?);
            lower.extend(factor.lower.into_iter().map(|row| row.into_iter().map(|(k, entry)| (first + k, entry)).collect::<Vec<_>>()));
            pivots.extend(factor.pivots);
            lower.resize(pivots.len(), Vec::new());
        }
        Ok(MassFactor { lower, pivots })
    }

    /// The factor of a diagonal matrix, whose entries are positive.
    pub(super) fn from_pivots(pivots: Vec<T>) -> Self {
        MassFactor { lower: Vec::new(), pivots }
    }

    /// M⁻¹ p: the velocity change caused by the generalised impulse p.
    ///
    /// # Panics
    /// If p has another size than M.
    /// ```
    /// use moreau_contact::contact::delassus::MassFactor;
    /// use moreau_contact::nalgebra::{dmatrix, dvector};
    ///
    /// let factor = MassFactor::new(&dmatrix![2.0, 0.0; 0.0, 4.0])?;
    /// assert_eq!(factor.solve(&dvector![1.0, 1.0]), dvector![0.5, 0.25]);
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn solve(&self, impulse: &DVector<T>) -> DVector<T> {
        let mut x = impulse.clone();
        self.solve_in_place(&mut x);
        x
    }

    /// Overwrites the generalised impulse x by the velocity change M⁻¹x.
    pub(super) fn solve_in_place(&self, x: &mut DVector<T>) {
        assert_eq!(x.len(), self.pivots.len(), "a generalised impulse has one entry per velocity");
        self.forward(x.as_mut_slice());
        for (k, d) in self.pivots.iter().enumerate() {
            x[k] /= d.clone();
        }
        for (i, row) in self.lower.iter().enumerate().rev() {
            for (k, entry) in row {
                let known = entry.clone() * x[i].clone();
                x[*k] -= known;
            }
        }
    }

    /// D, which is left empty.
    pub(super) fn take_pivots(&mut self) -> Vec<T> {
        std::mem::take(&mut self.pivots)
    }

    /// Whether L is the identity because M is known to be diagonal.
    pub(crate) fn is_diagonal(&self) -> bool {
        self.lower.is_empty()
    }

    /// D.
    pub(crate) fn pivots(&self) -> &[T] {
        &self.pivots
    }

    /// Overwrites the part x of a vector, which begins at `first` and is zero elsewhere, by that of L⁻¹x; M couples it with nothing else.
    pub(crate) fn forward_within(&self, first: usize, x: &mut [T]) {
        for i in 0..x.len() {
            for (k, entry) in self.lower.get(first + i).into_iter().flatten() {
                let known = entry.clone() * x[*k - first].clone();
                x[i] -= known;
            }
        }
    }

    /// Overwrites x by L⁻¹x.
    pub(crate) fn forward(&self, x: &mut [T]) {
        for (i, row) in self.lower.iter().enumerate() {
            for (k, entry) in row {
                let known = entry.clone() * x[*k].clone();
                x[i] -= known;
            }
        }
    }
}

/// Σ_k L_ik L_jk d_k of two rows, each in increasing order of k.
fn product<T: Scalar>(row: &[(usize, T)], other: &[(usize, T)], pivots: &[T]) -> T {
    let mut rest = other.iter().peekable();
    let mut sum = T::zero();
    for (k, entry) in row {
        while rest.next_if(|(index, _)| index < k).is_some() {}
        if let Some((_, opposite)) = rest.next_if(|(index, _)| index == k) {
            sum += entry.clone() * opposite.clone() * pivots[*k].clone();
        }
    }
    sum
}

/// The relative rounding error of a pivot: (n + 1) terms, each with a product and a sum; 0 for rationals.
fn rounding<T: Scalar>(n: usize) -> T {
    T::ratio(2 * (n as i64 + 1), 1) * T::spacing()
}

/// The pivot, if it is positive beyond the rounding of the entry it came from.
fn definite<T: Scalar>(j: usize, pivot: T, entry: &T, n: usize) -> Result<T> {
    if pivot > rounding::<T>(n) * entry.magnitude() {
        return Ok(pivot);
    }
    let problem = format!("is not positive definite (pivot {j} is {})", pivot.to_f64());
    Err(Error::invalid("mass", problem, "give every velocity a positive inertia"))
}

/// Whether M has finite numbers on its diagonal and zeros beside it, as that of free bodies in principal axes: most of it need not be
/// looked at again.
fn is_diagonal<T: Scalar>(mass: &DMatrix<T>) -> bool {
    let is_finite = |x: &T| (x.clone() - x.clone()).is_zero();
    let beside = |(j, column): (usize, &[T])| column.iter().enumerate().all(|(i, x)| if i == j { is_finite(x) } else { x.is_zero() });
    mass.as_slice().chunks_exact(mass.nrows().max(1)).enumerate().all(beside)
}

fn finite<T: Scalar>(field: &str, matrix: &DMatrix<T>) -> Result<()> {
    let Some(x) = matrix.iter().find(|x| !((*x).clone() - (*x).clone()).is_zero()) else { return Ok(()) };
    let unmoved = field == "mass" && x.to_f64() == f64::INFINITY;
    let cure = if unmoved { UNMOVED } else { "use finite numbers" };
    Err(Error::invalid(field, format!("holds {}", x.to_f64()), cure))
}

/// What to do about the mass of a body that nothing moves, where M has to be a matrix.
pub(super) const UNMOVED: &str =
    "use finite numbers; static bodies and prescribed velocities need a scheme that takes M body by body, such as `moreau-jean`";

fn symmetric<T: Scalar>(mass: &DMatrix<T>) -> Result<()> {
    match asymmetric_entry(mass) {
        None => Ok(()),
        Some((i, j)) => Err(Error::invalid("mass", format!("is not symmetric at ({i}, {j})"), SYMMETRIC)),
    }
}

/// What to do about an M that is not symmetric.
pub(crate) const SYMMETRIC: &str = "give a symmetric mass matrix";

/// The first entry of a square M that differs from its mirrored one by more than their rounding.
pub(crate) fn asymmetric_entry<T: Scalar>(mass: &DMatrix<T>) -> Option<(usize, usize)> {
    let n = mass.nrows();
    let differ = |i: usize, j: usize| {
        let difference = (mass[(i, j)].clone() - mass[(j, i)].clone()).magnitude();
        difference > rounding::<T>(n) * (mass[(i, i)].magnitude() + mass[(j, j)].magnitude())
    };
    (0..n).flat_map(|i| (0..i).map(move |j| (i, j))).find(|&(i, j)| differ(i, j))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};
    use nalgebra::dmatrix;

    fn two_by_two() -> (DMatrix<Rational>, DMatrix<Rational>) {
        let r = |x: i64| ratio(x, 1);
        (dmatrix![r(2), r(1); r(1), r(3)], dmatrix![r(1), r(0); r(1), r(1); r(2), r(-1)])
    }

    #[test]
    fn equals_the_hand_computed_inverse_formula() {
        let (mass, jacobian) = two_by_two();
        let inverse = dmatrix![ratio(3, 5), ratio(-1, 5); ratio(-1, 5), ratio(2, 5)];
        let expected = &jacobian * inverse * jacobian.transpose();
        assert_eq!(delassus(&mass, &jacobian).expect("M is SPD"), expected);
    }

    #[test]
    fn column_j_is_the_velocity_change_of_a_unit_impulse_at_row_j() {
        let (mass, jacobian) = two_by_two();
        let w = delassus(&mass, &jacobian).expect("M is SPD");
        let factor = MassFactor::new(&mass).expect("M is SPD");
        for j in 0..jacobian.nrows() {
            let velocity_change = factor.solve(&jacobian.row(j).transpose());
            assert_eq!(&mass * &velocity_change, jacobian.row(j).transpose(), "M Δv = Hᵀ e_j");
            assert_eq!(w.column(j).clone_owned(), &jacobian * velocity_change);
        }
    }

    #[test]
    fn floating_point_result_is_symmetric_to_the_last_bit() {
        let mass = dmatrix![2.0, 0.3; 0.3, 0.7];
        let jacobian = dmatrix![0.1, 0.2; 0.3, 1.1; -0.7, 0.9];
        let w = delassus(&mass, &jacobian).expect("M is SPD");
        assert_eq!(w, w.transpose());
    }

    #[test]
    fn refuses_a_mass_that_is_singular_indefinite_asymmetric_or_not_a_number() {
        let jacobian = dmatrix![1.0, 0.0];
        for mass in [
            dmatrix![1.0, 1.0; 1.0, 1.0],
            dmatrix![1.0, 2.0; 2.0, 1.0],
            dmatrix![1.0, 0.5; 0.25, 1.0],
            dmatrix![f64::NAN, 0.0; 0.0, 1.0],
            dmatrix![f64::INFINITY, 0.0; 0.0, 1.0],
        ] {
            let message = delassus(&mass, &jacobian).expect_err("not SPD").to_string();
            assert!(message.contains("`mass`"), "{message}");
        }
        assert!(delassus(&dmatrix![1.0], &jacobian).is_err(), "sizes must fit");
        assert!(delassus(&dmatrix![1.0], &dmatrix![f64::NAN]).is_err());
    }

    #[test]
    fn a_diagonal_mass_is_factored_as_any_other() {
        let diagonal = dmatrix![2.0, 0.0; 0.0, 0.3];
        let almost = dmatrix![2.0, f64::MIN_POSITIVE; f64::MIN_POSITIVE, 0.3];
        let impulse = DVector::from_vec(vec![0.7, -1.1]);
        assert!(is_diagonal(&diagonal) && !is_diagonal(&almost));
        let [one, other] = [diagonal, almost].map(|mass| MassFactor::new(&mass).expect("M is SPD").solve(&impulse));
        assert_eq!(one, other);
        for bad in [dmatrix![1.0, 0.0; 0.0, 0.0], dmatrix![1.0, 0.0; 0.0, -1.0], dmatrix![f64::NAN, 0.0; 0.0, 1.0]] {
            assert!(MassFactor::new(&bad).expect_err("not SPD").to_string().contains("`mass`"));
        }
    }

    #[test]
    fn both_sides_of_definiteness_are_decided_exactly_for_rationals() {
        let tiny = ratio(1, i64::MAX);
        let near = |shift: Rational| dmatrix![ratio(1, 1), ratio(1, 1); ratio(1, 1), ratio(1, 1) + shift];
        assert!(MassFactor::new(&near(tiny.clone())).is_ok());
        assert!(MassFactor::new(&near(-tiny)).is_err());
    }
}
