//! What is proved of an answer to an LCP, and of the problem: a solution near it, how many there are, or that there is none.
//!
//! ```text
//!     0 ≤ z* ⟂ w* = M z* + q ≥ 0 ,    max |z* − z| ≤ distance ,    max |w* − (M z + q)| ≤ slack distance
//! ```
//! The numbers of the data are taken as they are stored. Up to [`EXACT_ROWS`] rows z* is a vector of fractions and every sign is decided in
//! whole numbers; above, z* is enclosed, and every sign is that of an interval, or again in fractions where one is left open, up to
//! [`OPEN_ROWS`] rows.

use super::Decision;
use super::complementary_cones::{self, Family, SolutionSet, Until, infeasible, looked};
use super::definiteness::positive_semidefinite;
use super::lcp_enclosure::{Undecided, enclose};
use super::lcp_exact::{ExactSolution, WrongSign, exact_near, support};
use super::monotone;
use super::p_matrix::p_matrix;
use super::p_structure::surely_p;
use super::true_operator::is_stored_exactly;
use super::verified_cholesky::is_positive_definite;
use crate::problem::{ContactProblem, Lcp};
use crate::tolerance::complementarity::{EXACT_ROWS, FEASIBLE_ROWS, OPEN_ROWS};
use moreau_exact::number::{counted, significant, two_digits};
use moreau_exact::scalar::{Rational, Scalar, exact};
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// A solution near an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Near {
    /// Whether it is known in fractions; enclosed otherwise.
    pub exact: bool,
    /// max |z* − z|, rounded up.
    pub distance: f64,
    /// max |w* − (M z + q)|, rounded up.
    pub slack_distance: f64,
    /// The rows with z* > 0.
    pub support: Vec<usize>,
    /// The rows with z* = w* = 0; the solution is strictly complementary if there is none.
    pub degenerate: Vec<usize>,
}

/// What is proved of an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// A solution is near.
    Near(Near),
    /// No solution was found near; this is not a proof that there is none.
    NotProved {
        /// The row that is to blame, if one is.
        row: Option<usize>,
        /// Why.
        reason: String,
    },
}

/// How many solutions there are.
#[derive(Clone, Debug, PartialEq)]
pub enum Count {
    /// One, for the reason given in words.
    One(&'static str),
    /// These, two or more, and no others.
    Exactly(Vec<DVector<Rational>>),
    /// At least so many, and why it is not known whether there are more.
    AtLeast(usize, String),
    /// Infinitely many: all on the way between these two.
    Continuum([DVector<Rational>; 2]),
    /// None: y ≥ 0 with Mᵀy ≤ 0 and qᵀy < 0.
    Infeasible(DVector<Rational>),
    /// None, although z ≥ 0 with M z + q ≥ 0 exist: no complementary cone holds q.
    NoCone,
    /// It is not known, for the reason given in words.
    Unknown(String),
}

impl Count {
    /// Whether there is a solution, if that is known.
    pub fn is_solvable(&self) -> Option<bool> {
        match self {
            Count::One(_) | Count::Exactly(_) | Count::Continuum(_) | Count::AtLeast(..) => Some(true),
            Count::Infeasible(_) | Count::NoCone => Some(false),
            Count::Unknown(_) => None,
        }
    }
}

/// The LCP that a problem is, number by number: one row per contact, without friction under any round law, compliance and shift. None where
/// mass and Jacobian make a W that is not the stored one to the last bit.
pub fn lcp_of(problem: &ContactProblem) -> Option<Lcp<f64>> {
    let plain = problem.is_frictionless() && problem.rows_per_contact() == 1 && problem.compliance().is_none();
    let is_lcp = plain && problem.shift().iter().all(|shift| *shift == 0.0);
    (is_lcp && is_stored_exactly(problem)).then(|| Lcp::new(problem.dense().clone(), problem.free_velocity().clone()))
}

fn whole(lcp: &Lcp<f64>) -> Lcp<Rational> {
    Lcp::new(lcp.matrix.map(exact), lcp.vector.map(exact))
}

/// Proves that a solution is near z.
///
/// # Errors
/// [`Error::Invalid`] if z has another size than the problem, or if a number is not finite.
/// ```
/// use moreau_contact::certificate::lcp_proof::{Answer, prove};
/// use moreau_contact::nalgebra::{dmatrix, dvector};
/// use moreau_contact::problem::Lcp;
///
/// let lcp = Lcp::new(dmatrix![2.0, 1.0; 1.0, 2.0], dvector![-1.0, -1.0]); // z* = (⅓, ⅓)
/// let Answer::Near(near) = prove(&lcp, &dvector![0.3333, 0.3333])? else { panic!("regular") };
/// assert!(near.exact && near.distance > 1.0 / 30_001.0 && near.distance < 1.0 / 29_999.0);
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn prove(lcp: &Lcp<f64>, z: &DVector<f64>) -> Result<Answer> {
    check(lcp)?;
    if z.len() != lcp.size() || z.iter().any(|z| !z.is_finite()) {
        return Err(Error::invalid("impulse", format!("is not {} finite numbers", lcp.size()), "give one number per row"));
    }
    let support = support(lcp, z);
    if lcp.size() > EXACT_ROWS {
        let enclosed = enclosed(lcp, z, &support);
        // a row with z = w = 0 has a sign that no interval decides
        if matches!(enclosed, Answer::Near(_)) || lcp.size() > OPEN_ROWS {
            return Ok(enclosed);
        }
    }
    let whole = whole(lcp);
    Ok(match exact_near(&whole, z, support) {
        Ok(solution) => Answer::Near(near_exact(&whole, z, &solution)),
        Err(WrongSign { row, is_z, value }) => {
            let name = if is_z { "z" } else { "w" };
            Answer::NotProved {
                row: Some(row),
                reason: format!("on the basis of the answer {name} of the row is {}", significant(value.to_f64().value())),
            }
        }
    })
}

fn check(lcp: &Lcp<f64>) -> Result<()> {
    if lcp.matrix.iter().chain(lcp.vector.iter()).all(|number| number.is_finite()) {
        return Ok(());
    }
    Err(Error::invalid("lcp", "holds a number that is not finite", "use finite numbers"))
}

fn near_exact(lcp: &Lcp<Rational>, z: &DVector<f64>, solution: &ExactSolution) -> Near {
    let given = z.map(exact);
    let slack = lcp.slack(&given);
    let farthest = |one: &DVector<Rational>, other: &DVector<Rational>| {
        at_most(one.iter().zip(other.iter()).map(|(a, b)| (a - b).magnitude()).max().unwrap_or(Rational::ZERO))
    };
    let rows = |holds: &dyn Fn(usize) -> bool| (0..z.len()).filter(|&i| holds(i)).collect();
    Near {
        exact: true,
        distance: farthest(&solution.z, &given),
        slack_distance: farthest(&solution.w, &slack),
        support: rows(&|i| solution.z[i] > Rational::ZERO),
        degenerate: rows(&|i| solution.z[i].is_zero() && solution.w[i].is_zero()),
    }
}

/// The least number of 64 bits that is not below a fraction.
fn at_most(number: Rational) -> f64 {
    let nearest = number.to_f64().value();
    if nearest.is_finite() && exact(nearest) < number { nearest.next_up() } else { nearest }
}

fn enclosed(lcp: &Lcp<f64>, z: &DVector<f64>, support: &[bool]) -> Answer {
    let found = match enclose(lcp, support) {
        Ok(found) => found,
        Err(Undecided::Basis(size)) => {
            let reason = format!(
                "the basis of the answer, {}, is singular or nearly so ({size:.1e})",
                counted(support.iter().filter(|s| **s).count(), "row")
            );
            return Answer::NotProved { row: None, reason };
        }
        Err(Undecided::Sign { row, is_z, within: [middle, radius] }) => {
            let name = if is_z { "z" } else { "w" };
            let reason = format!("on the basis of the answer {name} of the row is {} ± {}", significant(middle), two_digits(radius));
            return Answer::NotProved { row: Some(row), reason };
        }
    };
    // |z* − z| per row, and |w* − (M z + q)| ≤ |M| |z* − z|, sums enlarged by their rounding
    let terms = crate::tolerance::certificate::gamma(lcp.size() + 8);
    let enlarged = |x: f64| if x == 0.0 { 0.0 } else { x * (1.0 + 2.0 * terms) + f64::MIN_POSITIVE };
    let apart: Vec<f64> = found.z.iter().zip(z.iter()).map(|([middle, radius], z)| enlarged((middle - z).abs() + radius)).collect();
    let slack = |i: usize| enlarged(apart.iter().enumerate().map(|(j, d)| lcp.matrix[(i, j)].abs() * d).sum());
    let rows = |holds: &dyn Fn(usize) -> bool| (0..z.len()).filter(|&i| holds(i)).collect();
    Answer::Near(Near {
        exact: false,
        distance: apart.iter().copied().fold(0.0, f64::max),
        slack_distance: (0..z.len()).map(slack).fold(0.0, f64::max),
        support: rows(&|i| found.z[i][0] > 0.0),
        degenerate: rows(&|i| found.z[i][0] == 0.0 && found.w[i] == [0.0, 0.0]),
    })
}

/// How many solutions an LCP has.
///
/// One, whatever q is, if M + Mᵀ is positive definite or M is a P-matrix, by its structure or – up to [`complementary_cones::LARGEST`] rows
/// – by all of its minors. Otherwise, up to [`FEASIBLE_ROWS`] rows: none, if no z ≥ 0 has M z + q ≥ 0; where M + Mᵀ is positive
/// semidefinite, one or infinitely many; and else as many as complementary cones hold q, if the search among them comes to its end.
///
/// # Errors
/// [`Error::Invalid`] if a number is not finite.
/// ```
/// use moreau_contact::certificate::lcp_proof::{Count, count};
/// use moreau_contact::nalgebra::{dmatrix, dvector};
/// use moreau_contact::problem::Lcp;
///
/// let of = |m: f64, q: f64| count(&Lcp::new(dmatrix![m], dvector![q]));
/// assert!(matches!(of(1.0, -1.0)?, Count::One(_)));
/// assert!(matches!(of(-1.0, 1.0)?, Count::Exactly(z) if z.len() == 2)); // 0 and 1
/// assert!(matches!(of(0.0, 0.0)?, Count::Continuum(_)));
/// assert!(matches!(of(0.0, -1.0)?, Count::Infeasible(_)));
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn count(lcp: &Lcp<f64>) -> Result<Count> {
    count_with(lcp, Vec::new)
}

/// As [`count`], with answers that are proposed where it is not known otherwise how many there are: solutions near them are told apart.
///
/// # Errors
/// As [`prove`].
/// ```
/// use moreau_contact::certificate::lcp_proof::{Count, count_with};
/// use moreau_contact::nalgebra::{DMatrix, DVector};
/// use moreau_contact::problem::Lcp;
///
/// let lcp = Lcp::new(-DMatrix::identity(61, 61), DVector::from_element(61, 1.0)); // z_i is 0 or 1: 2⁶¹ solutions
/// let [zero, one] = [0.0, 1.0].map(|z| DVector::from_element(61, z));
/// assert!(matches!(count_with(&lcp, || vec![zero, one])?, Count::AtLeast(2, _)));
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn count_with(lcp: &Lcp<f64>, proposed: impl FnOnce() -> Vec<DVector<f64>>) -> Result<Count> {
    check(lcp)?;
    if is_positive_definite(&lcp.matrix) {
        return Ok(Count::One("M + Mᵀ is positive definite"));
    }
    if let Some(why) = surely_p(&lcp.matrix) {
        return Ok(Count::One(why));
    }
    let size = lcp.size();
    if size > FEASIBLE_ROWS {
        let why = format!("M is not shown to be a P-matrix, and {} are too many for the rest", counted(size, "row"));
        return at_least(lcp, 0, why, &if size <= EXACT_ROWS { proposed() } else { Vec::new() });
    }
    let whole = whole(lcp);
    if size <= complementary_cones::LARGEST && p_matrix(&whole.matrix).is_ok_and(|decision| decision == Decision::Holds) {
        return Ok(Count::One("all principal minors of M are positive"));
    }
    if let Some(y) = infeasible(&whole) {
        return Ok(Count::Infeasible(y));
    }
    if positive_semidefinite(&whole.matrix).holds() {
        return Ok(of_monotone(lcp, &whole, &proposed()));
    }
    let found = looked(&whole, Until::Family);
    match found.stopped && found.set.families.is_empty() {
        true => at_least(lcp, found.set.points.len(), format!("not decided: {}", found.stop()), &proposed()),
        false => Ok(of_set(&whole, found.set)),
    }
}

/// At least `known` solutions, or as many as these answers have near that lie apart.
fn at_least(lcp: &Lcp<f64>, known: usize, why: String, answers: &[DVector<f64>]) -> Result<Count> {
    let found = different(lcp, answers)?;
    let said = if found == 1 { "an answer has a solution near" } else { "so many answers have solutions near that lie apart" };
    Ok(match found.max(known) {
        0 => Count::Unknown(why),
        most if most > known => Count::AtLeast(most, format!("{said}; {why}")),
        _ => Count::AtLeast(known, why),
    })
}

/// One or infinitely many, where M + Mᵀ is positive semidefinite and some z ≥ 0 has M z + q ≥ 0, so that there is a solution.
fn of_monotone(lcp: &Lcp<f64>, whole: &Lcp<Rational>, answers: &[DVector<f64>]) -> Count {
    const WHY: &str = "M + Mᵀ is positive semidefinite";
    let near = answers.iter().filter(|z| z.iter().all(|z| z.is_finite()));
    let proposed = near.filter_map(|z| exact_near(whole, z, support(lcp, z)).ok()).next().map(|solution| solution.z);
    let found = || looked(whole, Until::Solution).set.points.into_iter().next();
    let Some(point) = proposed.or_else(found) else {
        return Count::AtLeast(1, format!("{WHY}, and feasible problems of that kind have one; it was not found"));
    };
    match monotone::direction(whole, &point) {
        None => Count::AtLeast(1, WHY.into()),
        Some(None) => Count::One("M + Mᵀ is positive semidefinite, and nothing leads from the solution to another"),
        Some(Some(direction)) => {
            let end = Family { point: point.clone(), direction }.other_end(whole);
            Count::Continuum([point, end])
        }
    }
}

/// How many of these answers have solutions near that are different from each other, as far as their distances tell.
///
/// # Errors
/// As [`prove`].
/// ```
/// use moreau_contact::certificate::lcp_proof::different;
/// use moreau_contact::nalgebra::{dmatrix, dvector};
/// use moreau_contact::problem::Lcp;
///
/// let lcp = Lcp::new(dmatrix![1.0, 2.0; 2.0, 1.0], dvector![-1.0, -1.0]); // (1, 0), (0, 1) and (⅓, ⅓)
/// assert_eq!(different(&lcp, &[dvector![1.0, 0.0], dvector![1.0, 0.0], dvector![0.0, 1.0], dvector![0.0, 0.0]])?, 2);
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn different(lcp: &Lcp<f64>, answers: &[DVector<f64>]) -> Result<usize> {
    let mut apart: Vec<(&DVector<f64>, f64)> = Vec::new();
    for z in answers {
        let Answer::Near(Near { distance, .. }) = prove(lcp, z)? else { continue };
        // the difference is rounded once, far below the half of it
        let differs = |(other, its): &(&DVector<f64>, f64)| 0.5 * (z - *other).amax() > distance + its;
        if apart.iter().all(differs) {
            apart.push((z, distance));
        }
    }
    Ok(apart.len())
}

fn of_set(lcp: &Lcp<Rational>, set: SolutionSet) -> Count {
    if let Some(family) = set.families.first() {
        return Count::Continuum([family.point.clone(), family.other_end(lcp)]);
    }
    match set.points.len() {
        0 => Count::NoCone,
        1 => Count::One("no other complementary cone holds q"),
        _ => Count::Exactly(set.points),
    }
}

#[cfg(test)]
#[path = "lcp_proof_tests.rs"]
mod tests;
