//! All solutions of a small LCP: its complementary cones, those cut off together that no point reaches.
//!
//! 0 ≤ z ⟂ w = M z + q ≥ 0 has a solution with support in α iff q lies in the cone of α,
//!
//! ```text
//!     C_α y = q ,  y ≥ 0 ,   column j of C_α:  −M eⱼ if j ∈ α (yⱼ = zⱼ),  eⱼ otherwise (yⱼ = wⱼ) .
//! ```
//! One index after the other is decided, wⱼ = 0 or zⱼ = 0, on {z ≥ 0, w ≥ 0}. Where the linear program of what is decided has no point,
//! none of the cones that share it holds q; what is left in the end is every cone that does. All in whole numbers, so that an empty result
//! is a proof that there is no solution.

use super::dictionary::{Dictionary, First};
use super::feasibility::nonnegative_solution;
use super::planted::{Plant, planted};
use crate::problem::Lcp;
use crate::tolerance::complementarity::{CONE_SOLUTIONS, CONE_WORK};
use crate::watch;
use moreau_exact::scalar::{Rational, ratio};
use moreau_exact::witness::{Part, Witness, decided};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeSet;

/// Largest problem all of whose solutions are asked for: 2²⁰ cones.
pub const LARGEST: usize = 20;

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

impl Family {
    /// The last solution point + t·direction, t as large as it may be, or t = 1 if all t ≥ 0 are solutions.
    ///
    /// # Panics
    /// If the problem has another size.
    pub fn other_end(&self, lcp: &Lcp<Rational>) -> DVector<Rational> {
        let (w, change) = (lcp.slack(&self.point), &lcp.matrix * &self.direction);
        let both = self.point.iter().zip(self.direction.iter()).chain(w.iter().zip(change.iter()));
        let farthest = both.filter(|(_, change)| **change < Rational::ZERO).map(|(x, change)| -(x / change)).min();
        &self.point + &self.direction * farthest.unwrap_or(Rational::ONE)
    }
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
/// [`Error::Unsupported`] for a larger problem; [`Error::Solver`] with the failure `limit` after [`CONE_WORK`] or [`CONE_SOLUTIONS`].
/// ```
/// use moreau_contact::certificate::complementary_cones::all_solutions;
/// use moreau_contact::nalgebra::{dmatrix, dvector};
/// use moreau_contact::problem::Lcp;
/// use moreau_contact::scalar::ratio;
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
    decided(
        || looked(lcp, Until::End).everywhere(),
        |set| {
            let set = set.as_ref().ok()?;
            let data = [("matrix", Part::from(&lcp.matrix)), ("vector", Part::from(&lcp.vector))];
            let families = [
                ("family_points", list(&mut set.families.iter().map(|family| &family.point))),
                ("family_directions", list(&mut set.families.iter().map(|family| &family.direction))),
            ];
            let parts = data.into_iter().chain([("points", list(&mut set.points.iter()))]).chain(families).collect();
            Some(Witness { kind: "all-solutions", parts })
        },
    )
}

/// A solution, or the proof that there is none: every complementary cone was looked at, most of them together.
///
/// # Errors
/// [`Error::Solver`] with the failure `limit` after [`CONE_WORK`] without either.
pub fn some_solution(lcp: &Lcp<Rational>) -> Result<Option<DVector<Rational>>> {
    let found = looked(lcp, Until::Solution);
    match found.set.points.first() {
        Some(point) => Ok(Some(point.clone())),
        None => found.everywhere().map(|_| None),
    }
}

/// How far a search goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Until {
    /// All solutions.
    End,
    /// The first one.
    Solution,
    /// All solutions, or a direction in which there are infinitely many.
    Family,
    /// Polyhedra that hold all solutions: a cone is passed over where the polyhedron of another one is seen to hold its own.
    Cover,
}

/// What a search found.
pub(super) struct Looked {
    /// Solutions; all of them if nothing stopped the search.
    pub set: SolutionSet,
    /// The supports of all polyhedra that are more than a point.
    pub wide: Vec<(Vec<bool>, Family)>,
    /// Sets of cones that were looked at.
    pub cones: usize,
    /// Whether [`CONE_WORK`] or [`CONE_SOLUTIONS`] stopped it.
    pub stopped: bool,
}

impl Looked {
    /// What was found, if that is all.
    fn everywhere(self) -> Result<SolutionSet> {
        match self.stopped {
            true => Err(Error::limit("enumeration", format!("{}; the problem is too large for all of them", self.stop()))),
            false => Ok(self.set),
        }
    }

    /// Where it stopped, in words.
    pub fn stop(&self) -> String {
        format!("complete enumeration stopped at {} sets of complementary cones", self.cones)
    }
}

/// Solutions among complementary cones, cone by cone, until that is enough or the limits are reached.
pub(super) fn looked(lcp: &Lcp<Rational>, until: Until) -> Looked {
    looked_for(lcp, until, CONE_WORK, CONE_SOLUTIONS)
}

/// As [`looked`], with other limits of work and solutions.
fn looked_for(lcp: &Lcp<Rational>, until: Until, work: u64, most: usize) -> Looked {
    Search { lcp, until, work, most, cones: 0, stopped: false, pieces: Vec::new() }.run()
}

/// Σ Mᵀy ≤ 0 …: y ≥ 0 with Mᵀy ≤ 0 and qᵀy < 0, so that no z ≥ 0 has M z + q ≥ 0; `None` if some z has.
pub fn infeasible(lcp: &Lcp<Rational>) -> Option<DVector<Rational>> {
    match Dictionary::first(lcp) {
        First::Vertex(_) => None,
        First::Empty(y) => Some(y),
    }
}

/// Whether y ≥ 0, Mᵀy ≤ 0 and qᵀy < 0: a proof that no z ≥ 0 has M z + q ≥ 0, for 0 > qᵀy ≥ yᵀ(M z + q) ≥ 0 cannot be.
pub fn is_infeasible_by(lcp: &Lcp<Rational>, y: &DVector<Rational>) -> bool {
    y.len() == lcp.size()
        && y.iter().all(|y| *y >= Rational::ZERO)
        && lcp.matrix.tr_mul(y).iter().all(|x| *x <= Rational::ZERO)
        && lcp.vector.dot(y) < Rational::ZERO
}

/// A support, a vertex of its solutions, and a direction if there is more.
type Piece = (Vec<bool>, DVector<Rational>, Option<DVector<Rational>>);

/// The search among the cones.
struct Search<'a> {
    lcp: &'a Lcp<Rational>,
    until: Until,
    /// Work left to do.
    work: u64,
    /// Solutions that are kept.
    most: usize,
    /// Sets of cones looked at.
    cones: usize,
    stopped: bool,
    /// Supports α with a vertex, and a direction if there is more.
    pieces: Vec<Piece>,
}

impl Search<'_> {
    fn run(mut self) -> Looked {
        if let First::Vertex(start) = Dictionary::first(self.lcp) {
            self.explore(start, &mut vec![None; self.lcp.size()]);
        }
        // the order of the supports as binary numbers, the first index last
        self.pieces.sort_by(|(one, ..), (other, ..)| one.iter().rev().cmp(other.iter().rev()));
        let mut set = SolutionSet { points: Vec::new(), families: Vec::new() };
        let (mut known, mut wide) = (BTreeSet::new(), Vec::new());
        for (support, point, direction) in self.pieces {
            if let Some(direction) = direction {
                let family = Family { point: point.clone(), direction };
                if !set.families.contains(&family) {
                    set.families.push(family.clone());
                }
                wide.push((support, family));
            }
            if known.insert(point.as_slice().to_vec()) {
                set.points.push(point);
            }
        }
        Looked { set, wide, cones: self.cones, stopped: self.stopped }
    }

    fn is_enough(&self) -> bool {
        match self.until {
            Until::End | Until::Cover => false,
            Until::Solution => !self.pieces.is_empty(),
            Until::Family => self.pieces.last().is_some_and(|(.., direction)| direction.is_some()),
        }
    }

    /// Takes work off what is left of it.
    fn spend(&mut self, work: u64) {
        // who ends a solver is told the same as where the work is done
        self.stopped |= work > self.work || watch::is_over();
        self.work = self.work.saturating_sub(work);
    }

    /// Looks at all cones that agree with what is decided, `true` for wⱼ = 0, from a point of the linear program of that.
    fn explore(&mut self, at: Dictionary, support: &mut Vec<Option<bool>>) {
        self.cones += 1;
        let size = support.len();
        let open = |j: &usize| support[*j].is_none();
        let violated = || (0..size).filter(open).find(|&j| at.is_positive(j) && at.is_positive(size + j));
        let next = match self.until {
            // slip speeds come last among the unknowns and decide most: where one is zero, the velocities along all directions are
            Until::Cover => (0..size).rev().find(open),
            _ => violated().or_else(|| (0..size).find(open)),
        };
        let Some(j) = next else { return self.keep(&at, support) };
        // first what the point satisfies already
        let first = at.is_positive(size + j);
        // where one of the conditions holds everywhere, its branch has all that the other one has
        let everywhere =
            [true, false].into_iter().find(|w| self.until == Until::Cover && self.vanishes(&at, if *w { j } else { size + j }));
        for in_support in [first, !first] {
            if self.stopped || self.is_enough() {
                break;
            }
            if everywhere.is_some_and(|only| only != in_support) {
                continue;
            }
            let mut next = at.clone();
            let holds = next.fix(if in_support { j } else { size + j });
            self.spend(next.work() - at.work());
            if holds && !self.stopped {
                support[j] = Some(in_support);
                self.explore(next, support);
            }
        }
        support[j] = None;
    }

    /// Whether a variable is zero on all of a polyhedron.
    fn vanishes(&mut self, at: &Dictionary, variable: usize) -> bool {
        if planted(Plant::Pruned) {
            return !at.is_positive(variable);
        }
        let mut raised = at.clone();
        let vanishes = !raised.raise(variable);
        self.spend(raised.work() - at.work());
        vanishes
    }

    /// The polyhedron of a support.
    fn keep(&mut self, at: &Dictionary, support: &[Option<bool>]) {
        let size = support.len();
        if self.pieces.len() == self.most {
            self.stopped = true;
            return;
        }
        let inside: Vec<bool> = support.iter().map(|decided| *decided == Some(true)).collect();
        let point = DVector::from_fn(size, |j, _| at.value(size + j));
        let direction = at.has_free().then(|| self.direction(&inside, &point)).flatten();
        if at.has_free() {
            self.spend(at.work_of_pivots(size));
        }
        self.pieces.push((inside, point, direction));
    }

    /// A direction in z from a vertex into the polyhedron of a support, if that is more than the vertex.
    fn direction(&self, support: &[bool], point: &DVector<Rational>) -> Option<DVector<Rational>> {
        let (w, cone) = (self.lcp.slack(point), complementary_matrix(self.lcp, support));
        let vertex = DVector::from_fn(support.len(), |j, _| if support[j] { point[j].clone() } else { w[j].clone() });
        let change = leaving_direction(&cone, &vertex)?;
        Some(DVector::from_fn(support.len(), |j, _| if support[j] { change[j].clone() } else { Rational::ZERO }))
    }
}

/// C_α.
pub(super) fn complementary_matrix(lcp: &Lcp<Rational>, support: &[bool]) -> DMatrix<Rational> {
    DMatrix::from_fn(lcp.size(), lcp.size(), |i, j| if support[j] { -lcp.matrix[(i, j)].clone() } else { ratio(i64::from(i == j), 1) })
}

/// A direction from the vertex y into {C y = q, y ≥ 0}, if that is more than the vertex.
///
/// The columns with yⱼ > 0 are independent, so a direction raises some yⱼ = 0; scaled, the raises sum to 1.
fn leaving_direction(cone: &DMatrix<Rational>, vertex: &DVector<Rational>) -> Option<DVector<Rational>> {
    let size = vertex.len();
    let free: Vec<usize> = (0..size).filter(|&j| vertex[j] > Rational::ZERO).collect();
    // Unknowns: the direction, free entries as the difference of the first and an additional variable.
    let system = DMatrix::from_fn(size + 1, size + free.len(), |i, j| match (i < size, j < size) {
        (true, true) => cone[(i, j)].clone(),
        (true, false) => -cone[(i, free[j - size])].clone(),
        (false, true) if vertex[j].is_zero() => Rational::ONE,
        _ => Rational::ZERO,
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
#[path = "complementary_cones_tests.rs"]
mod tests;
