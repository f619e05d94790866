//! All solutions of a small LCP, by enumeration of its complementary cones in exact arithmetic.
//!
//! 0 ≤ z ⟂ w = M z + q ≥ 0 has a solution with support in α iff q lies in the cone of α,
//!
//! ```text
//!     C_α y = q ,  y ≥ 0 ,   column j of C_α:  −M eⱼ if j ∈ α (yⱼ = zⱼ),  eⱼ otherwise (yⱼ = wⱼ) .
//! ```
//! If M_αα is nonsingular there is one candidate; otherwise a linear feasibility problem decides, whose negative answers
//! carry Farkas certificates. So an empty result is a proof that there is no solution.

use crate::certificate::feasibility::nonnegative_solution;
use crate::problem::Lcp;
use dashu_ratio::RBig;
use moreau_exact::elimination::{principal, solve};
use moreau_exact::scalar::{Rational, ratio};
use moreau_exact::witness::{Part, Witness, decided};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Largest problem enumerated: 2¹² cones.
pub const LARGEST: usize = 12;

/// The solution set of an LCP: a finite union of polyhedra, one per complementary cone that contains q.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SolutionSet {
    /// A vertex of every such polyhedron, without repetition; all solutions, unless there are families.
    pub points: Vec<DVector<Rational>>,
    /// A direction of every polyhedron that is more than a point.
    pub families: Vec<Family>,
}

/// Solutions point + t·direction for small t ≥ 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Family {
    /// One of [`SolutionSet::points`].
    pub point: DVector<Rational>,
    /// A direction in z, not zero.
    pub direction: DVector<Rational>,
}

impl SolutionSet {
    /// Whether there is exactly one solution.
    pub fn is_unique(&self) -> bool {
        self.points.len() == 1 && self.families.is_empty()
    }

    /// Whether there is no solution.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }
}

/// The solution set of an LCP with at most [`LARGEST`] unknowns.
///
/// # Errors
/// [`Error::Unsupported`] for a larger problem.
/// ```
/// use moreau_contact::nalgebra::{dmatrix, dvector};
/// use moreau_contact::problem::Lcp;
/// use moreau_contact::scalar::ratio;
/// use moreau_contact::solvers::enumeration::all_solutions;
///
/// // −z + 1 ≥ 0 ⟂ z ≥ 0: z = 0 and z = 1, as when friction may jam
/// let two = all_solutions(&Lcp::new(dmatrix![ratio(-1, 1)], dvector![ratio(1, 1)]))?;
/// assert_eq!(two.points.len(), 2);
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn all_solutions(lcp: &Lcp<Rational>) -> Result<SolutionSet> {
    let size = lcp.size();
    if size > LARGEST {
        return Err(Error::Unsupported(format!("all solutions are enumerated up to size {LARGEST}, this LCP has {size}")));
    }
    let list =
        |vectors: &mut dyn Iterator<Item = &DVector<Rational>>| Part::Vectors(vectors.map(|z| z.iter().cloned().collect()).collect());
    Ok(decided(
        || enumerate(lcp),
        |set| {
            let data = [("matrix", Part::from(&lcp.matrix)), ("vector", Part::from(&lcp.vector))];
            let families = [
                ("family_points", list(&mut set.families.iter().map(|family| &family.point))),
                ("family_directions", list(&mut set.families.iter().map(|family| &family.direction))),
            ];
            let parts = data.into_iter().chain([("points", list(&mut set.points.iter()))]).chain(families).collect();
            Some(Witness { kind: "all-solutions", parts })
        },
    ))
}

fn enumerate(lcp: &Lcp<Rational>) -> SolutionSet {
    let size = lcp.size();
    let mut set = SolutionSet { points: Vec::new(), families: Vec::new() };
    for mask in 0..1usize << size {
        let support: Vec<usize> = (0..size).filter(|j| mask >> j & 1 == 1).collect();
        let right_side = DVector::from_fn(support.len(), |i, _| -lcp.vector[support[i]].clone());
        match solve(&principal(&lcp.matrix, &support), &right_side) {
            Some(values) => set.add(candidate(lcp, &support, &values)),
            None => set.add_piece(lcp, &support),
        }
    }
    set
}

/// z with these values on its support, if it is a solution.
fn candidate(lcp: &Lcp<Rational>, support: &[usize], values: &DVector<Rational>) -> Option<DVector<Rational>> {
    if values.iter().any(|z| *z < RBig::ZERO) {
        return None;
    }
    let mut z = DVector::from_element(lcp.size(), RBig::ZERO);
    for (&j, value) in support.iter().zip(values.iter()) {
        z[j] = value.clone();
    }
    lcp.slack(&z).iter().all(|w| *w >= RBig::ZERO).then_some(z)
}

impl SolutionSet {
    fn add(&mut self, z: Option<DVector<Rational>>) {
        self.points.extend(z.filter(|z| !self.points.contains(z)));
    }

    /// The polyhedron of a singular M_αα.
    fn add_piece(&mut self, lcp: &Lcp<Rational>, support: &[usize]) {
        let cone = complementary_matrix(lcp, support);
        let Some(vertex) = nonnegative_solution(&cone, &lcp.vector).point() else { return };
        let point = restrict(lcp.size(), support, &vertex);
        self.add(Some(point.clone()));
        if let Some(change) = leaving_direction(&cone, &vertex) {
            let direction = restrict(lcp.size(), support, &change);
            let family = Family { point, direction };
            if !self.families.contains(&family) {
                self.families.push(family);
            }
        }
    }
}

/// C_α.
fn complementary_matrix(lcp: &Lcp<Rational>, support: &[usize]) -> DMatrix<Rational> {
    DMatrix::from_fn(
        lcp.size(),
        lcp.size(),
        |i, j| {
            if support.contains(&j) { -lcp.matrix[(i, j)].clone() } else { ratio(i64::from(i == j), 1) }
        },
    )
}

/// The z-part of y.
fn restrict(size: usize, support: &[usize], y: &DVector<Rational>) -> DVector<Rational> {
    DVector::from_fn(size, |j, _| if support.contains(&j) { y[j].clone() } else { RBig::ZERO })
}

/// A direction from the vertex y into {C y = q, y ≥ 0}, if that is more than the vertex.
///
/// The columns with yⱼ > 0 are independent, so a direction raises some yⱼ = 0; scaled, the raises sum to 1.
fn leaving_direction(cone: &DMatrix<Rational>, vertex: &DVector<Rational>) -> Option<DVector<Rational>> {
    let size = vertex.len();
    let free: Vec<usize> = (0..size).filter(|&j| vertex[j] > RBig::ZERO).collect();
    // Unknowns: the direction, free entries as the difference of the first and an additional variable.
    let system = DMatrix::from_fn(size + 1, size + free.len(), |i, j| match (i < size, j < size) {
        (true, true) => cone[(i, j)].clone(),
        (true, false) => -cone[(i, free[j - size])].clone(),
        (false, true) if vertex[j].is_zero() => RBig::ONE,
        _ => RBig::ZERO,
    });
    let right_side = DVector::from_fn(size + 1, |i, _| ratio(i64::from(i == size), 1));
    let split = nonnegative_solution(&system, &right_side).point()?;
    let mut direction = split.rows(0, size).into_owned();
    for (k, &j) in free.iter().enumerate() {
        direction[j] -= &split[size + k];
    }
    Some(direction)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::lcp::residuals;

    fn lcp(size: usize, matrix: &[i64], vector: &[i64]) -> Lcp<Rational> {
        let numbers = |slice: &[i64]| slice.iter().map(|&x| ratio(x, 1)).collect::<Vec<_>>();
        Lcp::new(DMatrix::from_row_slice(size, size, &numbers(matrix)), DVector::from_vec(numbers(vector)))
    }

    #[test]
    fn a_p_matrix_has_one_solution_for_every_q() {
        for q in [[-1, -1], [1, -1], [-1, 1], [1, 1], [0, -3]] {
            let problem = lcp(2, &[2, -1, 1, 1], &q);
            let set = all_solutions(&problem).unwrap();
            assert!(set.is_unique(), "{q:?}: {set:?}");
            assert!(residuals(&problem, &set.points[0]).vanish());
        }
    }

    #[test]
    fn three_solutions_are_all_found() {
        // M = [[1, 2], [2, 1]], q = (−1, −1): supports {1}, {2} and both.
        let set = all_solutions(&lcp(2, &[1, 2, 2, 1], &[-1, -1])).unwrap();
        assert_eq!(set.points.len(), 3);
        assert!(set.families.is_empty());
    }

    #[test]
    fn a_singular_basis_yields_its_whole_family() {
        // 0 ≤ z ⟂ z₁ + z₂ − 1 ≥ 0 twice: the segment z₁ + z₂ = 1.
        let problem = lcp(2, &[1, 1, 1, 1], &[-1, -1]);
        let set = all_solutions(&problem).unwrap();
        let family = set.families.first().expect("the segment");
        let inside = &family.point + &family.direction * ratio(1, 100);
        assert!(residuals(&problem, &inside).vanish() && inside != family.point);
    }

    #[test]
    fn a_solution_hidden_in_a_singular_basis_is_not_missed() {
        // M = 0, q = 0: every z ≥ 0; M = [[0, 0], [1, 0]], q = (0, −1): z₁ ≥ 1 with z₂ = 0, or z₁ = 1.
        let set = all_solutions(&lcp(2, &[0, 0, 1, 0], &[0, -1])).unwrap();
        assert!(!set.is_empty() && !set.families.is_empty());
    }

    #[test]
    fn no_solution_is_proved() {
        assert!(all_solutions(&lcp(2, &[0, 0, 0, 0], &[-1, 0])).unwrap().is_empty());
        assert!(all_solutions(&lcp(2, &[1, -1, -1, 1], &[-2, 1])).unwrap().is_empty());
    }

    #[test]
    fn thirteen_unknowns_are_refused() {
        assert!(all_solutions(&Lcp::new(DMatrix::identity(13, 13), DVector::from_element(13, ratio(1, 1)))).is_err());
    }
}
