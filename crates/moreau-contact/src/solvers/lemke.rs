//! Lemke's method: follow the path of I w − M z − d z₀ = q, w, z, z₀ ≥ 0, wᵀz = 0 from z₀ = ∞ down to z₀ = 0.
//!
//! Ties in the ratio test are broken lexicographically on the rows of (q, B⁻¹), so in exact arithmetic no basis is
//! visited twice and the path ends: at a solution of 0 ≤ z ⟂ M z + q ≥ 0, or on a secondary ray.
//!
//! With rounded numbers redundant contacts make bases that are singular up to rounding, and an updated tableau soon pivots on
//! noise. There the tableau B⁻¹(I, −M, −d, q) is computed afresh from the data after every pivot, and entries below its
//! error are zero. The problem should be scaled so that M and q have entries of order one.

use crate::problem::{ImpulseLcp, Lcp};
use crate::tolerance::solvers::{cancellation, lemke_pivot_limit, smallest_pivot, tableau_zero};
use moreau_exact::scalar::{Rational, Scalar};
use moreau_exact::witness::{Part, Witness, decided, rational};
use moreau_exact::{Error, Result, elimination};
use nalgebra::{DMatrix, DVector};
use std::cmp::Ordering;

/// How the path of Lemke's method ended.
#[derive(Clone, Debug, PartialEq)]
pub enum LemkeOutcome<T: Scalar> {
    /// 0 ≤ z ⟂ M z + q ≥ 0.
    Solution {
        /// z.
        z: DVector<T>,
        /// Number of pivots.
        pivots: usize,
    },
    /// A secondary ray: (z, z₀) + t (ẑ, ẑ₀) stays on the path for all t ≥ 0. For a matrix without suitable structure
    /// this says nothing about solvability.
    Ray {
        /// z at the start of the ray.
        point: DVector<T>,
        /// z₀ at the start of the ray, positive.
        artificial: T,
        /// ẑ ≥ 0.
        direction: DVector<T>,
        /// ẑ₀ ≥ 0.
        artificial_direction: T,
        /// Number of pivots.
        pivots: usize,
    },
}

/// Runs lexicographic Lemke on 0 ≤ z ⟂ M z + q ≥ 0 with the covering vector d > 0.
///
/// # Errors
/// [`Error::Invalid`] if d has the wrong size or an entry that is not positive, or if M or q is not finite;
/// [`Error::Solver`] if rounding makes the path cycle or a basis singular (never over exact rationals).
///
/// # Source
/// Cottle, Pang, Stone, *The Linear Complementarity Problem*, chapter 4 (Lemke's method, lexicographic degeneracy resolution).
/// ```
/// use moreau_contact::nalgebra::{dmatrix, dvector};
/// use moreau_contact::problem::Lcp;
/// use moreau_contact::scalar::ratio;
/// use moreau_contact::solvers::lemke::{LemkeOutcome, lemke};
///
/// let lcp = Lcp::new(dmatrix![ratio(2, 1)], dvector![ratio(-1, 1)]);
/// let LemkeOutcome::Solution { z, .. } = lemke(&lcp, &dvector![ratio(1, 1)])? else { panic!("2 z = 1") };
/// assert_eq!(z, dvector![ratio(1, 2)]); // exact
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn lemke<T: Scalar>(lcp: &Lcp<T>, covering: &DVector<T>) -> Result<LemkeOutcome<T>> {
    check(lcp, covering)?;
    decided(|| follow(lcp, covering), |found| witness(lcp, covering, found.as_ref().ok()?))
}

fn follow<T: Scalar>(lcp: &Lcp<T>, covering: &DVector<T>) -> Result<LemkeOutcome<T>> {
    let size = lcp.size();
    if lcp.vector.iter().all(|q| *q >= T::zero()) {
        return Ok(LemkeOutcome::Solution { z: DVector::from_element(size, T::zero()), pivots: 0 });
    }
    let mut tableau = Tableau::new(lcp, covering);
    let mut row = tableau.first_row(covering);
    let mut entering = tableau.artificial();
    for pivots in 1..=lemke_pivot_limit::<T>(size) {
        let leaving = tableau.pivot(row, entering)?;
        if tableau.artificial_is_zero() {
            return Ok(LemkeOutcome::Solution { z: tableau.solution()?, pivots });
        }
        entering = tableau.complement(leaving);
        match tableau.ratio_test(entering) {
            Some(next) => row = next,
            None => return Ok(tableau.ray(entering, pivots)),
        }
    }
    let limit = lemke_pivot_limit::<T>(size);
    Err(Error::limit(
        "lemke",
        format!("made {limit} pivots: rounding cycles, or the path is long; scale the problem or use exact rationals"),
    ))
}

/// The witness of an outcome in rationals.
fn witness<T: Scalar>(lcp: &Lcp<T>, covering: &DVector<T>, outcome: &LemkeOutcome<T>) -> Option<Witness> {
    let (lcp, covering): (&Lcp<Rational>, &DVector<Rational>) = (rational(lcp)?, rational(covering)?);
    let mut parts = vec![("matrix", Part::from(&lcp.matrix)), ("vector", Part::from(&lcp.vector))];
    let kind = match rational::<_, LemkeOutcome<Rational>>(outcome)? {
        LemkeOutcome::Solution { z, .. } => {
            parts.push(("z", z.into()));
            "lcp-solution"
        }
        LemkeOutcome::Ray { point, artificial, direction, artificial_direction, .. } => {
            parts.extend([("covering", covering.into()), ("point", point.into()), ("direction", direction.into())]);
            parts.push(("artificial", Part::Vector(vec![artificial.clone(), artificial_direction.clone()])));
            "lcp-ray"
        }
    };
    Some(Witness { kind, parts })
}

/// The solution that Lemke's method reaches with the covering vector of ones. The problem is taken as it is: one in floating point should
/// have entries of order one.
///
/// # Errors
/// As [`lemke`]; [`Error::Solver`] if the path ends on a ray.
pub fn solution<T: Scalar>(lcp: &Lcp<T>) -> Result<DVector<T>> {
    match lemke(lcp, &DVector::from_element(lcp.size(), T::one()))? {
        LemkeOutcome::Solution { z, .. } => Ok(z),
        LemkeOutcome::Ray { .. } => Err(Error::ray("lemke", "ended on a ray")),
    }
}

impl<T: Scalar> ImpulseLcp<T> {
    /// r of the solution that Lemke's method reaches.
    ///
    /// # Errors
    /// As [`solution`].
    pub fn solve(&self) -> Result<DVector<T>> {
        Ok(self.impulse(&solution(&self.lcp)?))
    }
}

fn check<T: Scalar>(lcp: &Lcp<T>, covering: &DVector<T>) -> Result<()> {
    if covering.len() != lcp.size() || covering.iter().any(|d| !(*d > T::zero() && is_finite(d))) {
        let problem = format!("is not a positive finite vector of size {}", lcp.size());
        return Err(Error::invalid("covering", problem, "use the vector of ones"));
    }
    if !lcp.matrix.iter().chain(lcp.vector.iter()).all(is_finite) {
        return Err(Error::invalid("lcp", "holds a number that is not finite", "use finite numbers"));
    }
    Ok(())
}

/// x − x = 0 fails for NaN and for infinities.
fn is_finite<T: Scalar>(x: &T) -> bool {
    (x.clone() - x.clone()).is_zero()
}

/// B⁻¹ (I, −M, −d, q) with the names of its basic variables: w is 0..n, z is n..2n, z₀ is 2n.
struct Tableau<T: Scalar> {
    data: DMatrix<T>,
    entries: DMatrix<T>,
    basis: Vec<usize>,
}

impl<T: Scalar> Tableau<T> {
    fn new(lcp: &Lcp<T>, covering: &DVector<T>) -> Self {
        let size = lcp.size();
        let data = DMatrix::from_fn(size, 2 * size + 2, |i, j| match j {
            j if j < size => T::ratio(i64::from(i == j), 1),
            j if j < 2 * size => -lcp.matrix[(i, j - size)].clone(),
            j if j == 2 * size => -covering[i].clone(),
            _ => lcp.vector[i].clone(),
        });
        Tableau { entries: data.clone(), data, basis: (0..size).collect() }
    }

    fn size(&self) -> usize {
        self.basis.len()
    }

    fn artificial(&self) -> usize {
        2 * self.size()
    }

    fn complement(&self, variable: usize) -> usize {
        if variable < self.size() { variable + self.size() } else { variable - self.size() }
    }

    fn right_side(&self, row: usize) -> &T {
        &self.entries[(row, 2 * self.size() + 1)]
    }

    /// The row whose w leaves when z₀ enters: lexicographic minimum of (q, I)ᵢ / dᵢ, after which every row is positive.
    fn first_row(&self, covering: &DVector<T>) -> usize {
        let rows = 0..self.size();
        rows.min_by(|&i, &k| self.compare(i, &covering[i], k, &covering[k])).expect("a problem with a negative q has a row")
    }

    /// Row of the lexicographically smallest ratio (q, B⁻¹)ᵢ / aᵢ over the positive entries a of a column.
    fn ratio_test(&self, column: usize) -> Option<usize> {
        let scale =
            self.entries.column(column).iter().fold(T::one(), |largest, x| if x.magnitude() > largest { x.magnitude() } else { largest });
        let floor = smallest_pivot::<T>() * scale;
        let rows = (0..self.size()).filter(|&i| self.entries[(i, column)] > floor);
        rows.min_by(|&i, &k| self.compare(i, &self.entries[(i, column)], k, &self.entries[(k, column)]))
    }

    /// Lexicographic order of (q, B⁻¹)ᵢ / aᵢ and (q, B⁻¹)ₖ / aₖ for positive aᵢ, aₖ.
    fn compare(&self, i: usize, a_i: &T, k: usize, a_k: &T) -> Ordering {
        let columns = std::iter::once(2 * self.size() + 1).chain(0..self.size());
        for j in columns {
            let (left, right) = (self.entries[(i, j)].clone() * a_k.clone(), self.entries[(k, j)].clone() * a_i.clone());
            match difference(left, right, self.size()).partial_cmp(&T::zero()) {
                Some(Ordering::Equal) | None => {}
                Some(order) => return order,
            }
        }
        Ordering::Equal
    }

    /// Brings a variable into the basis in place of the one in this row, and names the one that left.
    fn pivot(&mut self, row: usize, entering: usize) -> Result<usize> {
        let leaving = std::mem::replace(&mut self.basis[row], entering);
        if T::spacing().is_zero() {
            self.update(row, entering)
        } else {
            self.recompute()?
        }
        Ok(leaving)
    }

    /// One step of Gauss–Jordan elimination, for exact numbers.
    fn update(&mut self, row: usize, entering: usize) {
        let pivot = self.entries[(row, entering)].clone();
        for j in 0..self.entries.ncols() {
            self.entries[(row, j)] /= pivot.clone();
        }
        for i in (0..self.size()).filter(|&i| i != row) {
            let factor = self.entries[(i, entering)].clone();
            if factor.is_zero() {
                continue;
            }
            for j in 0..self.entries.ncols() {
                let change = factor.clone() * self.entries[(row, j)].clone();
                self.entries[(i, j)] -= change;
            }
        }
    }

    /// B⁻¹ times the data, entries within its error set to zero, for rounded numbers.
    fn recompute(&mut self) -> Result<()> {
        let fresh = elimination::solve_columns(&self.basis_columns(), &self.data).ok_or_else(singular)?;
        let zero = tableau_zero::<T>();
        self.entries = fresh.map(|x| if x.magnitude() <= zero { T::zero() } else { x });
        Ok(())
    }

    /// Whether z₀ = 0: it left the basis, or sits in it at zero.
    fn artificial_is_zero(&self) -> bool {
        self.basis.iter().position(|&variable| variable == self.artificial()).is_none_or(|row| *self.right_side(row) <= T::zero())
    }

    /// z of the last basis, B x = q; data of order one leave a basic variable that is zero within 2nε of it, on either side.
    fn solution(&self) -> Result<DVector<T>> {
        let right_side = self.data.column(2 * self.size() + 1).into_owned();
        let basic = elimination::solve(&self.basis_columns(), &right_side).ok_or_else(singular)?;
        let rounding = cancellation(self.size(), T::one());
        Ok(self.values(|row| basic[row].clone()).map(|value| if value <= rounding { T::zero() } else { value }))
    }

    fn basis_columns(&self) -> DMatrix<T> {
        DMatrix::from_fn(self.size(), self.size(), |i, j| self.data[(i, self.basis[j])].clone())
    }

    fn ray(&self, entering: usize, pivots: usize) -> LemkeOutcome<T> {
        let mut direction = self.values(|row| -self.entries[(row, entering)].clone());
        if entering >= self.size() {
            direction[entering - self.size()] = T::one();
        }
        let row = self.basis.iter().position(|&variable| variable == self.artificial()).expect("z₀ is basic until the path ends");
        LemkeOutcome::Ray {
            point: self.values(|row| self.right_side(row).clone()),
            artificial: self.right_side(row).clone(),
            direction,
            artificial_direction: -self.entries[(row, entering)].clone(),
            pivots,
        }
    }

    /// A vector over z with the given value where zⱼ is basic and zero elsewhere.
    fn values(&self, value: impl Fn(usize) -> T) -> DVector<T> {
        let size = self.size();
        let mut z = DVector::from_element(size, T::zero());
        for (row, &variable) in self.basis.iter().enumerate() {
            if (size..2 * size).contains(&variable) {
                z[variable - size] = value(row);
            }
        }
        z
    }
}

fn singular() -> Error {
    Error::breakdown("lemke", "a basis is singular in rounded arithmetic; use exact rationals")
}

/// a − b, read as zero where only rounding is left.
fn difference<T: Scalar>(a: T, b: T, rows: usize) -> T {
    let rounding = cancellation(rows, a.magnitude() + b.magnitude());
    let result = a - b;
    if result.magnitude() <= rounding { T::zero() } else { result }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};

    fn ones<T: Scalar>(size: usize) -> DVector<T> {
        DVector::from_element(size, T::one())
    }

    fn rationals(size: usize, matrix: &[i64], vector: &[i64]) -> Lcp<Rational> {
        let numbers = |slice: &[i64]| slice.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>();
        Lcp::new(DMatrix::from_row_slice(size, size, &numbers(matrix)), DVector::from_vec(numbers(vector)))
    }

    #[test]
    fn a_diagonal_problem_is_solved_component_by_component() {
        let lcp = rationals(3, &[2, 0, 0, 0, 1, 0, 0, 0, 5], &[-4, 3, -1]);
        match lemke(&lcp, &ones(3)).unwrap() {
            LemkeOutcome::Solution { z, .. } => assert_eq!(z, DVector::from_vec(vec![ratio(2, 1), ratio(0, 1), ratio(1, 5)])),
            ray => panic!("{ray:?}"),
        }
    }

    #[test]
    fn an_asymmetric_problem_agrees_in_floats_and_rationals() {
        let exact = rationals(3, &[4, -1, 2, 3, 5, -1, -2, 1, 6], &[-3, -7, 2]);
        let rounded = Lcp::new(exact.matrix.map(|x| Scalar::to_f64(&x)), exact.vector.map(|x| Scalar::to_f64(&x)));
        let (LemkeOutcome::Solution { z, .. }, LemkeOutcome::Solution { z: approximate, .. }) =
            (lemke(&exact, &ones(3)).unwrap(), lemke(&rounded, &ones(3)).unwrap())
        else {
            panic!("both solve")
        };
        let difference = (z.map(|x| Scalar::to_f64(&x)) - approximate).amax();
        assert!(difference <= moreau_exact::tolerance::rounding(9, 10.0), "{difference}");
        assert!(exact.slack(&z).iter().all(|w| *w >= ratio(0, 1)));
        assert!(z.iter().zip(exact.slack(&z).iter()).all(|(z, w)| (z * w) == ratio(0, 1)));
    }

    #[test]
    fn degenerate_ties_do_not_cycle() {
        // M = identity with equal negative q: every ratio ties in the first step.
        let size = 6;
        let lcp = Lcp::new(DMatrix::<Rational>::identity(size, size), DVector::from_element(size, ratio(-1, 1)));
        match lemke(&lcp, &ones(size)).unwrap() {
            LemkeOutcome::Solution { z, .. } => assert_eq!(z, ones(size)),
            ray => panic!("{ray:?}"),
        }
    }

    #[test]
    fn an_infeasible_problem_ends_on_a_ray_whose_direction_satisfies_its_equations() {
        let lcp = rationals(2, &[0, 0, 0, 0], &[-1, -2]);
        let LemkeOutcome::Ray { artificial, direction, artificial_direction, .. } = lemke(&lcp, &ones(2)).unwrap() else {
            panic!("w = q < 0 has no solution")
        };
        assert!(artificial > ratio(0, 1));
        let slack = &lcp.matrix * &direction + ones::<Rational>(2) * artificial_direction;
        assert!(slack.iter().all(|w| *w >= ratio(0, 1)));
        assert_eq!(direction.dot(&slack), ratio(0, 1));
        assert!(direction.iter().any(|z| *z > ratio(0, 1)));
    }

    /// Whether z(t) = point + t·direction with z₀(t) ≥ 0 satisfies 0 ≤ z ⟂ Mz + q + d z₀ ≥ 0 for t = 0, 1, 5.
    fn is_a_ray_of(lcp: &Lcp<Rational>, covering: &DVector<Rational>, outcome: LemkeOutcome<Rational>) -> bool {
        let LemkeOutcome::Ray { point, artificial, direction, artificial_direction, .. } = outcome else { return false };
        let moves = direction.iter().any(|z| *z > ratio(0, 1)) || artificial_direction > ratio(0, 1);
        moves
            && [0, 1, 5].map(|t| ratio(t, 1)).iter().all(|t| {
                let z = &point + &direction * t.clone();
                let z0 = &artificial + &artificial_direction * t;
                let w = lcp.slack(&z) + covering * z0.clone();
                z0 >= ratio(0, 1) && z.iter().chain(w.iter()).all(|x| *x >= ratio(0, 1)) && z.dot(&w) == ratio(0, 1)
            })
    }

    #[test]
    fn rays_are_unbounded_paths_of_the_augmented_problem() {
        // The jamming contact ends on a ray along which several basic variables change, w = −z − 1 on one along which z₀ grows.
        let jamming = rationals(4, &[9, 12, -12, 0, 12, 16, -16, 25, -12, -16, 16, 25, 25, -25, -25, 0], &[-25, 0, 0, 0]);
        let growing = rationals(1, &[-1], &[-1]);
        for (lcp, covering) in
            [(jamming.clone(), ones(4)), (jamming, DVector::from_fn(4, |i, _| ratio(4 - i as i64, 1))), (growing, ones(1))]
        {
            assert!(is_a_ray_of(&lcp, &covering, lemke(&lcp, &covering).unwrap()), "{covering}");
        }
    }

    #[test]
    fn kostrevas_problem_on_which_lemke_cycles_without_a_rule_for_ties_is_solved() {
        let lcp = rationals(3, &[1, 2, 0, 0, 1, 2, 2, 0, 1], &[-1, -1, -1]);
        let rounded = Lcp::new(lcp.matrix.map(|x| Scalar::to_f64(&x)), lcp.vector.map(|x| Scalar::to_f64(&x)));
        let LemkeOutcome::Solution { z, .. } = lemke(&rounded, &ones(3)).expect("no cycle") else { panic!("a P-matrix has a solution") };
        assert!(z.iter().all(|z| (z - 1.0 / 3.0).abs() <= moreau_exact::tolerance::rounding(9, 1.0)), "{z}");
        let LemkeOutcome::Solution { z, .. } = lemke(&lcp, &ones(3)).unwrap() else { panic!("a P-matrix has a solution") };
        assert_eq!(z, DVector::from_element(3, ratio(1, 3)));
    }

    #[test]
    fn every_covering_vector_leads_to_the_solution_of_a_p_matrix() {
        for vector in [[-3, -7, 2], [-1, -2, -3], [5, -4, -1]] {
            let lcp = rationals(3, &[4, -1, 2, 3, 5, -1, -2, 1, 6], &vector);
            let unique = crate::solvers::enumeration::all_solutions(&lcp).unwrap().points[0].clone();
            for covering in [[1, 1, 1], [1, 10, 1], [1, 1, 100], [50, 7, 1]] {
                let covering = DVector::from_row_slice(&covering.map(|x| ratio(x, 1)));
                let LemkeOutcome::Solution { z, .. } = lemke(&lcp, &covering).unwrap() else { panic!("a P-matrix has a solution") };
                assert_eq!(z, unique, "q = {vector:?}, d = {covering}");
            }
        }
    }

    #[test]
    fn nan_and_a_zero_covering_vector_are_refused() {
        let nan = Lcp::new(DMatrix::from_element(1, 1, f64::NAN), DVector::from_element(1, -1.0));
        assert!(lemke(&nan, &ones(1)).is_err());
        let fine = Lcp::new(DMatrix::from_element(1, 1, 1.0), DVector::from_element(1, -1.0));
        assert!(lemke(&fine, &DVector::from_element(1, 0.0)).is_err());
        assert!(lemke(&fine, &ones(2)).is_err());
    }
}
