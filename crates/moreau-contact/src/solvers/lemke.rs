//! Lemke's method: follow the path of I w − M z − d z₀ = q, w, z, z₀ ≥ 0, wᵀz = 0 from z₀ = ∞ down to z₀ = 0.
//!
//! Ties in the ratio test are broken lexicographically on the rows of (q, B⁻¹), so in exact arithmetic no basis is
//! visited twice and the path ends: at a solution of 0 ≤ z ⟂ M z + q ≥ 0, or on a secondary ray.
//!
//! With rounded numbers the order of ties is lost where two rows that tie differ by rounding: the path then takes another row each time
//! it comes by, and cycles. So every number that a choice rests on carries a bound of its error, computed afresh from the data at every
//! basis, and rows tie that these bounds cannot tell apart. A ray is reported only if it satisfies its equations to the rounding of its
//! own data. The problem should be scaled so that M and q have entries of order one.

pub use super::lemke_outcome::LemkeOutcome;
use super::lemke_tableau::Tableau;
use crate::problem::{ImpulseLcp, Lcp};
use crate::tolerance::solvers::lemke_pivot_limit;
use moreau_exact::number::counted;
use moreau_exact::scalar::{Rational, Scalar};
use moreau_exact::witness::{Part, Witness, decided, rational};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Runs lexicographic Lemke on 0 ≤ z ⟂ M z + q ≥ 0 with the covering vector d > 0.
///
/// # Errors
/// [`Error::Invalid`] if d has the wrong size or an entry that is not positive, or if M or q is not finite;
/// [`Error::Solver`] if rounding makes the path cycle, a basis singular or a ray doubtful (never over exact rationals).
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
    let mut entering = tableau.artificial();
    let mut column = tableau.column(entering);
    let mut row = tableau.first_row(covering);
    for pivots in 1..=lemke_pivot_limit::<T>(size) {
        if super::watch::is_over() {
            return Err(Error::limit("lemke", format!("was ended after {}", counted(pivots - 1, "pivot"))));
        }
        let leaving = tableau.pivot(row, entering, &column)?;
        let right_side = tableau.right_side();
        if tableau.artificial_is_zero(&right_side) {
            return Ok(LemkeOutcome::Solution { z: tableau.solution(&right_side), pivots });
        }
        entering = tableau.complement(leaving);
        column = tableau.column(entering);
        match tableau.ratio_test(&right_side, &column) {
            Some(next) => row = next,
            None => return tableau.ray(&right_side, entering, &column, pivots),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::solvers::SMALL_BASIS;
    use moreau_exact::scalar::{Rational, ratio};
    use nalgebra::DMatrix;

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

    /// Planted solutions of which every other entry is zero, with an asymmetric M of a positive definite symmetric part: z is unique.
    #[test]
    fn large_bases_are_updated_without_losing_digits() {
        for size in [SMALL_BASIS, SMALL_BASIS + 1, 4 * SMALL_BASIS] {
            let matrix = DMatrix::from_fn(size, size, |i, j| match (i, j) {
                (i, j) if i == j => 4.0,
                (i, j) if i + 1 == j => -1.5,
                (i, j) if i == j + 1 => 0.5,
                (i, j) => {
                    if (i * 7 + j * 3) % 11 == 0 {
                        1.0 / (2.0 * size as f64)
                    } else {
                        0.0
                    }
                }
            });
            let planted = DVector::from_fn(size, |i, _| if i % 2 == 0 { 1.0 + (i % 5) as f64 } else { 0.0 });
            let slack = DVector::from_fn(size, |i, _| if i % 2 == 0 { 0.0 } else { 0.25 + (i % 3) as f64 });
            let lcp = Lcp::new(matrix.clone(), slack - &matrix * &planted);
            let LemkeOutcome::Solution { z, pivots } = lemke(&lcp, &DVector::from_element(size, 1.0)).unwrap() else {
                panic!("a solution")
            };
            assert!(pivots > size / 4, "{pivots} pivots of {size} rows update the basis");
            let condition = 4.0; // of the symmetric part, at most 6/2
            assert!((z - planted).amax() <= condition * moreau_exact::tolerance::rounding(2 * size, 64.0), "{size} rows");
        }
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
