//! The basis of Lemke's path: the numbers x = B⁻¹a of its columns, what is known of their errors, and the choice of pivots.
//!
//! ```text
//!     residual      r = a − B x̂ , in doubled precision
//!     error         |x − x̂| ≤ 2 |B⁻¹r| + (n + 1) ε |B⁻¹| |r|
//!     uncertainty   (n + 1) ε |B⁻¹| (|B| |x̂| + |a|) , the most that rounding of the data changes; ε/4 in place of (n + 1) ε in the mean
//! ```
//!
//! Two ratios tie up to the error and the mean change: numbers that tie but for rounding must tie at every basis, and numbers that do
//! not tie must not, since the wrong row makes a basic variable negative. A pivot is certain, above the largest change. All are zero for
//! exact rationals.
//!
//! B⁻¹ of a small basis is computed from the data at every pivot. That of a larger one is updated, B⁻¹ ← E B⁻¹, and now and then computed
//! anew: the residual is that of the data in any case, and so is what is said of the error.

use super::lemke_outcome::LemkeOutcome;
use crate::problem::Lcp;
use crate::tolerance::solvers::{KNOWN_PIVOT, SMALL_BASIS, cancellation, mean_of_data, smallest_pivot, sum_of_data, updates};
use moreau_exact::doubled::DoubledResiduals;
use moreau_exact::scalar::Scalar;
use moreau_exact::{Error, Result, elimination};
use nalgebra::{DMatrix, DVector};

/// B⁻¹a for a column a of the data.
pub(super) struct Column<T: Scalar> {
    values: DVector<T>,
    /// How far the values may be from each other and tie.
    errors: DVector<T>,
    /// How far they may be from those of data that differ by rounding.
    uncertainty: DVector<T>,
}

/// B⁻¹ with the names of the basic variables: w is 0..n, z is n..2n, z₀ is 2n. The data are (I, −M, −d, q).
pub(super) struct Tableau<T: Scalar> {
    data: DMatrix<T>,
    inverse: DMatrix<T>,
    basis: Vec<usize>,
    /// The row of every w that is basic.
    places: Vec<Option<usize>>,
    /// Pivots since B⁻¹ was computed from the data; of rounded numbers.
    updates: usize,
}

impl<T: Scalar> Tableau<T> {
    pub(super) fn new(lcp: &Lcp<T>, covering: &DVector<T>) -> Self {
        let size = lcp.size();
        let data = DMatrix::from_fn(size, 2 * size + 2, |i, j| match j {
            j if j < size => T::ratio(i64::from(i == j), 1),
            j if j < 2 * size => -lcp.matrix[(i, j - size)].clone(),
            j if j == 2 * size => -covering[i].clone(),
            _ => lcp.vector[i].clone(),
        });
        Tableau {
            data,
            inverse: DMatrix::identity(size, size),
            basis: (0..size).collect(),
            places: (0..size).map(Some).collect(),
            updates: 0,
        }
    }

    fn size(&self) -> usize {
        self.basis.len()
    }

    /// The name of z₀.
    pub(super) fn artificial(&self) -> usize {
        2 * self.size()
    }

    pub(super) fn complement(&self, variable: usize) -> usize {
        if variable < self.size() { variable + self.size() } else { variable - self.size() }
    }

    /// B⁻¹a for the data a of a variable, for rounded numbers with one step of refinement.
    pub(super) fn column(&self, variable: usize) -> Column<T> {
        let data = self.data.column(variable).into_owned();
        let mut values = self.apply_inverse(&data, |entry| entry);
        if T::spacing().is_zero() {
            let zero = values.map(|_| T::zero());
            return Column { values, errors: zero.clone(), uncertainty: zero };
        }
        values += self.apply_inverse(&self.residual(&values, &data), |entry| entry);
        let left = self.residual(&values, &data);
        let factor = T::ratio(self.size() as i64 + 1, 1) * T::spacing();
        let (correction, rounding) = (self.apply_inverse(&left, |entry| entry), self.times_inverse(&left.map(|r| r.magnitude())));
        let mut errors = correction.zip_map(&rounding, |c, r| T::ratio(2, 1) * c.magnitude() + factor.clone() * r);
        let uncertainty = self.uncertainty(&values, &data);
        errors.zip_apply(&uncertainty, |error, largest| *error += mean_of_data(self.size(), largest));
        Column { uncertainty, values, errors }
    }

    /// B⁻¹q, the values of the basic variables.
    pub(super) fn right_side(&self) -> Column<T> {
        self.column(2 * self.size() + 1)
    }

    /// Column j of B⁻¹, no better known than its data; refined where B⁻¹ was only updated.
    fn of_inverse(&self, j: usize) -> Column<T> {
        if self.updates > 0 {
            return self.column(j);
        }
        let values = self.inverse.column(j).into_owned();
        let uncertainty =
            if T::spacing().is_zero() { values.map(|_| T::zero()) } else { self.uncertainty(&values, &self.data.column(j).into_owned()) };
        Column { values, errors: uncertainty.clone(), uncertainty }
    }

    /// a − B x in doubled precision.
    fn residual(&self, x: &DVector<T>, data: &DVector<T>) -> DVector<T> {
        let mut residuals = DoubledResiduals::new(data.as_slice());
        for (&variable, factor) in self.basis.iter().zip(x.iter()).filter(|(_, factor)| !factor.is_zero()) {
            if variable < self.size() {
                residuals.subtract_unit(variable, factor);
            } else {
                residuals.subtract(self.data.column(variable).as_slice(), factor);
            }
        }
        DVector::from_vec(residuals.values())
    }

    /// (n + 1) ε |B⁻¹| (|B||x| + |a|).
    fn uncertainty(&self, x: &DVector<T>, data: &DVector<T>) -> DVector<T> {
        let magnitude = self.times_basis(x, |x| x.magnitude()) + data.map(|a| a.magnitude());
        self.times_inverse(&magnitude.map(|sum| sum_of_data(self.size(), sum)))
    }

    /// |B⁻¹| x.
    fn times_inverse(&self, x: &DVector<T>) -> DVector<T> {
        self.apply_inverse(x, |entry| entry.magnitude())
    }

    /// B⁻¹x, by the function that is applied to every entry of B⁻¹; the columns of basic w are unit vectors.
    fn apply_inverse(&self, x: &DVector<T>, apply: impl Fn(T) -> T) -> DVector<T> {
        let mut image = DVector::from_element(self.size(), T::zero());
        for (j, factor) in x.iter().enumerate().filter(|(_, factor)| !factor.is_zero()) {
            match self.places[j] {
                Some(row) => image[row] += factor.clone(),
                None => image.zip_apply(&self.inverse.column(j), |sum, entry| *sum += apply(entry) * factor.clone()),
            }
        }
        image
    }

    /// B x, or |B||x|, by the function that is applied to every number.
    fn times_basis(&self, x: &DVector<T>, apply: impl Fn(T) -> T) -> DVector<T> {
        let mut image = DVector::from_element(self.size(), T::zero());
        for (&variable, factor) in self.basis.iter().zip(x.iter()) {
            let factor = apply(factor.clone());
            if factor.is_zero() {
                continue;
            }
            if variable < self.size() {
                image[variable] += factor;
            } else {
                image.zip_apply(&self.data.column(variable), |sum, entry| *sum += apply(entry) * factor.clone());
            }
        }
        image
    }

    /// The row whose w leaves when z₀ enters: lexicographic minimum of (q, I)ᵢ / dᵢ, after which every row is positive.
    pub(super) fn first_row(&self, covering: &DVector<T>) -> usize {
        let exact = |values: DVector<T>| Column { errors: values.map(|_| T::zero()), uncertainty: values.map(|_| T::zero()), values };
        self.smallest_ratio(
            (0..self.size()).collect(),
            &exact(self.data.column(2 * self.size() + 1).into_owned()),
            &exact(covering.clone()),
        )
    }

    /// Row of the lexicographically smallest ratio (q, B⁻¹)ᵢ / aᵢ over the entries a of a column that may be pivots: those whose sign
    /// and first digits no rounding of the data changes.
    pub(super) fn ratio_test(&self, right_side: &Column<T>, column: &Column<T>) -> Option<usize> {
        let known = T::ratio(KNOWN_PIVOT, 1);
        let is_pivot = |i: &usize| column.values[*i] > column.uncertainty[*i].clone() * known.clone();
        let rows: Vec<usize> = (0..self.size()).filter(is_pivot).collect();
        (!rows.is_empty()).then(|| self.smallest_ratio(rows, right_side, column))
    }

    /// The one of these rows in which (q, B⁻¹)ᵢ / aᵢ is smallest in the lexicographic order, aᵢ > 0. Rows that rounding makes
    /// indistinguishable throughout are equally small; the largest aᵢ of them is the best pivot.
    fn smallest_ratio(&self, mut rows: Vec<usize>, right_side: &Column<T>, column: &Column<T>) -> usize {
        keep_smallest(&mut rows, right_side, column);
        for j in 0..self.size() {
            if rows.len() == 1 {
                break;
            }
            keep_smallest(&mut rows, &self.of_inverse(j), column);
        }
        let larger = |best: usize, row: usize| if column.values[row] > column.values[best] { row } else { best };
        rows.into_iter().reduce(larger).expect("one row is smallest")
    }

    /// Brings a variable with this column into the basis in place of the one in this row, and names the one that left.
    pub(super) fn pivot(&mut self, row: usize, entering: usize, column: &Column<T>) -> Result<usize> {
        let leaving = std::mem::replace(&mut self.basis[row], entering);
        if let Some(place) = self.places.get_mut(leaving) {
            *place = None;
        }
        if let Some(place) = self.places.get_mut(entering) {
            *place = Some(row);
        }
        if T::spacing().is_zero() {
            self.update(row, &column.values)
        } else if self.size() > SMALL_BASIS && self.updates < updates(self.size()) {
            self.update(row, &column.values);
            self.updates += 1;
        } else {
            self.updates = 0;
            self.inverse =
                elimination::solve_columns(&self.basis_columns(), &DMatrix::identity(self.size(), self.size())).ok_or_else(singular)?;
        }
        if entering < self.size() {
            // B e_row = e_w
            let mut unit = self.inverse.column_mut(entering);
            unit.fill(T::zero());
            unit[row] = T::one();
        }
        Ok(leaving)
    }

    /// One step of Gauss–Jordan elimination on B⁻¹, exact for exact numbers.
    fn update(&mut self, row: usize, column: &DVector<T>) {
        for mut entries in self.inverse.column_iter_mut() {
            if entries[row].is_zero() {
                continue;
            }
            let quotient = entries[row].clone() / column[row].clone();
            for (entry, factor) in entries.iter_mut().zip(column.iter()).filter(|(_, factor)| !factor.is_zero()) {
                *entry -= factor.clone() * quotient.clone();
            }
            entries[row] = quotient;
        }
    }

    /// Whether z₀ = 0: it left the basis, or sits in it at zero.
    pub(super) fn artificial_is_zero(&self, right_side: &Column<T>) -> bool {
        let rounding = cancellation(self.size(), T::one());
        let zero = |row: usize| {
            let value = &right_side.values[row];
            *value <= right_side.uncertainty[row].clone() + rounding.clone() && *value <= smallest_pivot()
        };
        self.row_of_artificial().is_none_or(zero)
    }

    fn row_of_artificial(&self) -> Option<usize> {
        self.basis.iter().position(|&variable| variable == self.artificial())
    }

    /// z of the last basis; data of order one leave a basic variable that is zero within 2nε of it, on either side.
    pub(super) fn solution(&self, right_side: &Column<T>) -> DVector<T> {
        let rounding = cancellation(self.size(), T::one());
        self.values(&right_side.values.map(|value| if value <= rounding { T::zero() } else { value }))
    }

    fn basis_columns(&self) -> DMatrix<T> {
        DMatrix::from_fn(self.size(), self.size(), |i, j| self.data[(i, self.basis[j])].clone())
    }

    /// The ray along which the entering variable grows without bound, if it is one to the rounding of the data: basic variables x ≥ 0
    /// with B x = q and changes δ ≥ 0 with B δ + a = 0.
    pub(super) fn ray(&self, right_side: &Column<T>, entering: usize, column: &Column<T>, pivots: usize) -> Result<LemkeOutcome<T>> {
        let row = self.row_of_artificial().expect("z₀ is basic until the path ends");
        let (point, change) = (certain(&right_side.values, &right_side.uncertainty), certain(&-&column.values, &column.uncertainty));
        let last = 2 * self.size() + 1;
        if !(self.is_image(&point, |i| self.data[(i, last)].clone()) && self.is_image(&change, |i| -self.data[(i, entering)].clone())) {
            return Err(Error::breakdown("lemke", "what ends the path may be a ray or rounding; use exact rationals"));
        }
        let mut direction = self.values(&change);
        if entering >= self.size() {
            direction[entering - self.size()] = T::one();
        }
        let (artificial, artificial_direction) = (point[row].clone(), change[row].clone());
        Ok(LemkeOutcome::Ray { point: self.values(&point), artificial, direction, artificial_direction, pivots })
    }

    /// Whether B x = a to the rounding of the sums.
    fn is_image(&self, x: &DVector<T>, a: impl Fn(usize) -> T) -> bool {
        let (image, magnitude) = (self.times_basis(x, |x| x), self.times_basis(x, |x| x.magnitude()));
        (0..self.size())
            .all(|i| (image[i].clone() - a(i)).magnitude() <= cancellation(self.size() + 1, magnitude[i].clone() + a(i).magnitude()))
    }

    /// A vector over z with the given values where zⱼ is basic and zero elsewhere.
    fn values(&self, basic: &DVector<T>) -> DVector<T> {
        let size = self.size();
        let mut z = DVector::from_element(size, T::zero());
        for (row, &variable) in self.basis.iter().enumerate() {
            if (size..2 * size).contains(&variable) {
                z[variable - size] = basic[row].clone();
            }
        }
        z
    }
}

/// The values that are certainly positive, and zero for the others.
fn certain<T: Scalar>(values: &DVector<T>, uncertainty: &DVector<T>) -> DVector<T> {
    values.zip_map(uncertainty, |value, error| if value > error { value } else { T::zero() })
}

/// Keeps the rows whose ratio xᵢ / aᵢ, aᵢ > 0, is smallest or cannot be told from the smallest one.
fn keep_smallest<T: Scalar>(rows: &mut Vec<usize>, x: &Column<T>, a: &Column<T>) {
    let product = |i: usize, k: usize| x.values[i].clone() * a.values[k].clone();
    let smaller = |best: usize, row: usize| if product(row, best) < product(best, row) { row } else { best };
    let Some(best) = rows.iter().copied().reduce(smaller) else { return };
    let error = |i: usize, k: usize| {
        let (value, factor) = (x.values[i].magnitude(), a.values[k].magnitude());
        let factor_with_error = factor.clone() + a.errors[k].clone();
        x.errors[i].clone() * factor_with_error + value.clone() * a.errors[k].clone() + cancellation(1, value * factor)
    };
    rows.retain(|&row| row == best || product(row, best) - product(best, row) <= error(row, best) + error(best, row));
}

fn singular() -> Error {
    Error::breakdown("lemke", "a basis is singular in rounded arithmetic; use exact rationals")
}
