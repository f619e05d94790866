//! Principal pivoting: bases of 0 ≤ z ⟂ w = M z + q ≥ 0 with one of each pair, exchanged until no number is negative.
//!
//! ```text
//!     Murty         the row of least index with a negative number changes sides                        M a P-matrix
//!     parametric    0 ≤ z ⟂ M z + q + t d ≥ 0 is kept, d > 0, from large t to t = 0: where a number reaches
//!                   zero its row changes sides, or it and a second row do              M positive semidefinite, or a P-matrix
//! ```
//! A P-matrix has positive diagonals in all its principal transforms, a positive semidefinite one none that is negative. What shows
//! otherwise is refused, with the row: nothing is said of it. If M is positive semidefinite, the second method ends at a solution or shows
//! that no z ≥ 0 has w ≥ 0.

use super::ContactSolver;
use super::linear_form::Form;
use super::principal_tableau::PrincipalTableau;
use crate::problem::{ContactProblem, Law, Lcp, Solution};
use crate::tolerance::complementarity::{COVERING_MODULUS, PIVOTS_AT_ONE_PARAMETER, PRINCIPAL_PIVOTS, negligible};
use moreau_exact::number::counted;
use moreau_exact::scalar::Scalar;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Murty's least-index method, for P-matrices.
///
/// # Source
/// K. G. Murty, *Note on a Bard-type scheme for solving the complementarity problem*, Opsearch 11 (1974).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Murty {
    /// Most pivots: on some problems there are 2ⁿ.
    pub pivots: usize,
}

impl Default for Murty {
    fn default() -> Self {
        Murty { pivots: PRINCIPAL_PIVOTS }
    }
}

/// The symmetric parametric principal pivoting method, for positive semidefinite and for P-matrices.
///
/// # Source
/// R. W. Cottle, J.-S. Pang, R. E. Stone, *The Linear Complementarity Problem*, §4.5 (after R. W. Cottle, 1972, and R. L. Graves, 1967).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParametricPivoting {
    /// Most pivots.
    pub pivots: usize,
}

impl Default for ParametricPivoting {
    fn default() -> Self {
        ParametricPivoting { pivots: PRINCIPAL_PIVOTS }
    }
}

/// How principal pivoting ends.
#[derive(Clone, Debug, PartialEq)]
pub enum PrincipalOutcome {
    /// The rows with z in the basis of a solution, after so many pivots.
    Basis(Vec<bool>, usize),
    /// The number of this row is negative for all z ≥ 0 that keep the others, if M is positive semidefinite.
    Infeasible(usize),
}

impl Murty {
    /// The basis of the solution.
    ///
    /// # Errors
    /// [`Error::Solver`] that refuses a matrix that is no P-matrix, with the row that shows it, or after the limit of pivots.
    /// ```
    /// use moreau_contact::nalgebra::{dmatrix, dvector};
    /// use moreau_contact::problem::Lcp;
    /// use moreau_contact::scalar::ratio;
    /// use moreau_contact::solvers::{Murty, PrincipalOutcome};
    ///
    /// let lcp = Lcp::new(dmatrix![ratio(1, 1), ratio(0, 1); ratio(2, 1), ratio(1, 1)], dvector![ratio(-1, 1), ratio(-1, 1)]);
    /// assert_eq!(Murty::default().basis(&lcp)?, PrincipalOutcome::Basis(vec![true, false], 1));
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn basis<T: Scalar>(&self, lcp: &Lcp<T>) -> Result<PrincipalOutcome> {
        let mut tableau = PrincipalTableau::new(lcp, &[]);
        for pivots in 0..=self.pivots {
            if super::watch::is_over() {
                return Err(Error::limit(MURTY, format!("was ended after {}", counted(pivots, "pivot"))));
            }
            // in every place stand the two variables of its row
            let Some(place) = (0..lcp.size()).find(|&i| tableau.constants[(i, 0)] < -negligible::<T>(lcp.size())) else {
                return Ok(PrincipalOutcome::Basis(tableau.support(), pivots));
            };
            if tableau.matrix[(place, place)] <= negligible(lcp.size()) {
                return Err(refused(MURTY, place, "a P-matrix"));
            }
            tableau.exchange(place, place);
        }
        Err(Error::limit(MURTY, format!("made {}; use `parametric-pivoting` or `lemke`", counted(self.pivots, "pivot"))))
    }
}

impl ParametricPivoting {
    /// The basis of a solution, or the row that none satisfies.
    ///
    /// # Errors
    /// [`Error::Solver`] that refuses a matrix that is neither positive semidefinite nor a P-matrix, with the row that shows it, or after
    /// the limit of pivots.
    pub fn basis<T: Scalar>(&self, lcp: &Lcp<T>) -> Result<PrincipalOutcome> {
        let size = lcp.size();
        let (mut tableau, mut tried) = (PrincipalTableau::new(lcp, &[covering(size, 0)]), 0);
        let (mut least, mut since): (Option<T>, usize) = (None, 0);
        for pivots in 0..=self.pivots {
            let Some((s, parameter)) = next(&tableau) else { return Ok(PrincipalOutcome::Basis(tableau.support(), pivots)) };
            if super::watch::is_over() {
                return Err(Error::limit(PARAMETRIC, format!("was ended after {}", counted(pivots, "pivot"))));
            }
            let falls = least.as_ref().is_none_or(|least| parameter < *least);
            (least, since) = if falls { (Some(parameter.clone()), 0) } else { (least, since + 1) };
            if since > PIVOTS_AT_ONE_PARAMETER * size {
                tried += 1;
                tableau = PrincipalTableau::new(lcp, &[covering(size, tried)]);
                (least, since) = (None, 0);
                continue;
            }
            let (row, diagonal) = (tableau.basic[s] % size, tableau.matrix[(s, s)].clone());
            let not_of_class = || refused(PARAMETRIC, row, "positive semidefinite, nor a P-matrix");
            if diagonal < -negligible::<T>(size) {
                return Err(not_of_class());
            }
            if diagonal > negligible(size) {
                tableau.exchange(s, s);
                continue;
            }
            let Some(i) = blocking(&tableau, s, parameter) else { return Ok(PrincipalOutcome::Infeasible(row)) };
            if tableau.matrix[(s, i)] <= negligible(size) {
                return Err(not_of_class());
            }
            tableau.exchange(s, i);
            tableau.exchange(i, s);
        }
        Err(Error::limit(PARAMETRIC, format!("made {}; use `lemke`", counted(self.pivots, "pivot"))))
    }
}

/// The vector d that t is multiplied with: of ones, or of numbers between 1 and 2 that have no pattern. Where several numbers vanish at
/// once pivots may go round in a circle, at the same t; with other numbers others vanish at once.
fn covering<T: Scalar>(size: usize, tried: i64) -> DVector<T> {
    let number = |i: i64| T::ratio(i * i % COVERING_MODULUS * tried % COVERING_MODULUS, COVERING_MODULUS);
    DVector::from_fn(size, |i, _| T::one() + number(i as i64 + 2))
}

const MURTY: &str = "murty";
const PARAMETRIC: &str = "parametric-pivoting";

fn refused(solver: &str, row: usize, class: &str) -> Error {
    Error::refused(solver, format!("a pivot of row {row} has, to its rounding, a sign that shows that M is not {class}"))
}

/// The place whose number C₀ + t C₁ is the first to vanish as t falls to zero, with that t; the least index of several.
fn next<T: Scalar>(tableau: &PrincipalTableau<T>) -> Option<(usize, T)> {
    let size = tableau.basic.len();
    let falls = |&i: &usize| tableau.constants[(i, 1)] > negligible(size) && tableau.constants[(i, 0)] < -negligible::<T>(size);
    let when = |i: usize| (i, -tableau.constants[(i, 0)].clone() / tableau.constants[(i, 1)].clone());
    (0..size).filter(falls).map(when).reduce(|first, other| if other.1 > first.1 { other } else { first })
}

/// The place whose number vanishes first as y of column s rises, at this t; the least index of several.
fn blocking<T: Scalar>(tableau: &PrincipalTableau<T>, s: usize, parameter: T) -> Option<usize> {
    let size = tableau.basic.len();
    let falls = |&i: &usize| i != s && tableau.matrix[(i, s)] < -negligible::<T>(size);
    let way = |i: usize| {
        let value = tableau.constants[(i, 0)].clone() + parameter.clone() * tableau.constants[(i, 1)].clone();
        (i, (if value < T::zero() { T::zero() } else { value }) / -tableau.matrix[(i, s)].clone())
    };
    (0..size).filter(falls).map(way).reduce(|first, other| if other.1 < first.1 { other } else { first }).map(|(i, _)| i)
}

impl ContactSolver for Murty {
    fn name(&self) -> &'static str {
        MURTY
    }

    fn takes_start(&self) -> bool {
        false
    }

    fn takes(&self, law: Law, _rows: usize, _symmetric: bool) -> bool {
        law == Law::Frictionless
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        through(problem, warm_start, MURTY, |lcp| self.basis(lcp))
    }
}

impl ContactSolver for ParametricPivoting {
    fn name(&self) -> &'static str {
        PARAMETRIC
    }

    fn takes_start(&self) -> bool {
        false
    }

    fn takes(&self, law: Law, _rows: usize, _symmetric: bool) -> bool {
        law == Law::Frictionless
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        through(problem, warm_start, PARAMETRIC, |lcp| self.basis(lcp))
    }
}

/// The answer of a basis that is found on the problem in units of its own.
fn through(
    problem: &ContactProblem,
    warm_start: Option<&DVector<f64>>,
    name: &str,
    basis: impl FnOnce(&Lcp<f64>) -> Result<PrincipalOutcome>,
) -> Result<Solution> {
    let form = Form::frictionless(problem, name)?;
    super::start_of_use(problem, warm_start)?;
    let lcp = form.lcp(problem, name)?;
    let scaled = form.scaled(problem, &lcp);
    match basis(&scaled.lcp)? {
        PrincipalOutcome::Basis(support, pivots) => {
            let z = scaled.on_support(&lcp, &support).ok_or_else(|| Error::breakdown(name, "ended on a singular basis; use `lemke`"))?;
            super::finite(form.solution(problem, &z, name, pivots))
        }
        PrincipalOutcome::Infeasible(row) => {
            let reason = format!(
                "row {row} stays negative whatever impulses keep the others, to the rounding of the pivots; \
                 where W is positive semidefinite that tells of no solution, and proves nothing"
            );
            Err(Error::ray(name, reason))
        }
    }
}

#[cfg(test)]
#[path = "principal_pivoting_tests.rs"]
mod tests;
