//! All solutions of a problem under polyhedral Coulomb friction, told apart by their velocities, in fractions.
//!
//! ```text
//!     0 ≤ z ⟂ M z + q ≥ 0 ,   z = (λ, β, σ) ,   r = G (λ, β) ,   u = W r + u_free
//!     C_α y = q ,  y ≥ 0           every complementary cone α that holds q, a polyhedron of solutions each
//!     u is the same on it    ⇔     W G d = 0 for every direction d that leads into it from one of its points
//! ```
//! Parts β of one friction impulse may differ, and σ of an open contact is any number above the slip: what counts is u. Where it moves on a
//! polyhedron, the velocities are a continuum, between two ends of which every mean is a solution. R, μ, D_j, u_free and the shift are the
//! numbers that they are stored as, W is that of [`true_operator`](super::true_operator), and M is made of them without rounding.

use super::complementary_cones::{Family, LARGEST, Until, complementary_matrix, looked};
use super::moving::moving;
use super::patterns::Exact;
use super::planted::{Plant, planted};
use super::true_operator::operator;
use crate::cones::polyhedral::direction;
use crate::problem::stewart_trinkle::{generators, lcp};
use crate::problem::{ContactProblem, Law, Lcp};
use crate::tolerance::complementarity::WIDE_CONES;
use moreau_exact::number::counted;
use moreau_exact::scalar::{Rational, exact};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// What is known of all solutions.
#[derive(Clone, Debug, PartialEq)]
pub struct PolyhedralSolutions {
    /// One solution of every velocity that is met at a vertex of a cone.
    pub found: Vec<Exact>,
    /// The ends of a continuum of velocities; every mean of both impulses is a solution.
    pub continuum: Option<[Exact; 2]>,
    /// Whether all of them have the same impulses r too.
    pub same_impulse: bool,
    /// λ, β and σ of all contacts: so many have 2^unknowns complementary cones.
    pub unknowns: usize,
    /// Sets of cones that were looked at.
    pub sets: usize,
    /// Why there may be others than these; none if they are all.
    pub stopped: Option<String>,
}

/// All solutions of a problem with polyhedral Coulomb friction and at most [`LARGEST`] unknowns λ, β, σ.
///
/// # Errors
/// [`Error::Unsupported`] for more unknowns and for other laws.
/// ```
/// use moreau_contact::certificate::polyhedral_solutions::polyhedral_solutions;
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::{ContactProblem, Law};
///
/// let block = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 0.25, 0.0]).friction(vec![0.5]);
/// let block = block.law(Law::PolyhedralCoulomb { directions: 4 }).build()?;
/// let all = polyhedral_solutions(&block)?; // it sticks, in one way, however its friction is divided among the directions
/// assert!(all.found.len() == 1 && all.same_impulse && all.continuum.is_none() && all.stopped.is_none());
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn polyhedral_solutions(problem: &ContactProblem) -> Result<PolyhedralSolutions> {
    let Law::PolyhedralCoulomb { directions } = problem.law() else {
        return Err(Error::Unsupported(format!("the law `{}` is not that of polyhedral friction", problem.law().name())));
    };
    let unknowns = problem.contacts() * (2 + directions);
    if unknowns > LARGEST {
        let text = format!(
            "complementary cones of {unknowns} λ, β, σ; all of them are looked at up to {LARGEST}",
            unknowns = counted(unknowns, "unknown")
        );
        return Err(Error::Unsupported(text));
    }
    Ok(Data::new(problem, operator(problem)?, directions).all())
}

/// The complementarity problem of friction along these directions, in fractions: nothing in it is rounded.
///
/// # Errors
/// [`Error::Unsupported`] where W is not known in fractions.
pub(crate) fn friction_lcp(problem: &ContactProblem, directions: usize) -> Result<Lcp<Rational>> {
    Ok(Data::new(problem, operator(problem)?, directions).lcp)
}

/// The same of this W and these velocities without impulses in place of the problem's own.
pub(crate) fn friction_lcp_of(
    problem: &ContactProblem,
    w: DMatrix<Rational>,
    given: &DVector<Rational>,
    directions: usize,
) -> Lcp<Rational> {
    Data::of(problem, w, given, directions).lcp
}

/// The problem in fractions.
struct Data {
    lcp: Lcp<Rational>,
    /// r = G z; nothing of σ.
    generators: DMatrix<Rational>,
    /// W G.
    moved: DMatrix<Rational>,
    free: DVector<Rational>,
}

impl Data {
    fn new(problem: &ContactProblem, w: DMatrix<Rational>, directions: usize) -> Self {
        let given = problem.free_velocity().map(exact) + problem.shift().map(exact);
        Data::of(problem, w, &given, directions)
    }

    /// Of this W and these u_free + shift.
    fn of(problem: &ContactProblem, w: DMatrix<Rational>, given: &DVector<Rational>, directions: usize) -> Self {
        let (contacts, rows) = (problem.contacts(), problem.rows());
        let free = problem.free_velocity().map(exact);
        if contacts == 0 {
            let none = DMatrix::from_element(0, 0, Rational::ZERO);
            return Data { lcp: Lcp::new(none.clone(), free.clone()), generators: none.clone(), moved: none, free };
        }
        let sides: Vec<[Rational; 2]> = (0..directions).map(|j| direction(j, directions).map(exact)).collect();
        let g = generators(contacts, problem.rows_per_contact(), &sides);
        let mut soft = w.clone();
        (0..rows).for_each(|row| soft[(row, row)] += exact(problem.row_compliance(row)));
        let friction: Vec<Rational> = problem.friction().iter().map(|mu| exact(*mu)).collect();
        let transposed = g.transpose();
        let velocity = &transposed * given;
        let lcp = lcp(&(&transposed * soft * &g), &friction, &velocity);
        let moved = w * &g;
        Data { lcp, generators: g, moved, free }
    }

    fn all(&self) -> PolyhedralSolutions {
        let looked = looked(&self.lcp, Until::Cover);
        let mut stopped = looked.stopped.then(|| looked.stop());
        let mut found: Vec<Exact> = Vec::new();
        let mut same_impulse = true;
        for point in &looked.set.points {
            let made = self.exact(point);
            same_impulse &= found.first().is_none_or(|first| first.impulse == made.impulse);
            if found.iter().all(|known| known.velocity != made.velocity) {
                found.push(made);
            }
        }
        if looked.wide.len() > WIDE_CONES {
            stopped = stopped.or_else(|| Some(format!("more than {WIDE_CONES} complementary cones hold more than one z each")));
        }
        let mut continuum = None;
        for (support, family) in looked.wide.iter().take(WIDE_CONES).filter(|_| !planted(Plant::Still)) {
            if let Some(direction) = self.moves(&self.moved, support, family) {
                let end = Family { point: family.point.clone(), direction }.other_end(&self.lcp);
                continuum = Some([self.exact(&family.point), self.exact(&end)]);
                break;
            }
            same_impulse = same_impulse && self.moves(&self.generators, support, family).is_none();
        }
        same_impulse &= continuum.is_none();
        PolyhedralSolutions { found, continuum, same_impulse, unknowns: self.lcp.size(), sets: looked.cones, stopped }
    }

    fn exact(&self, z: &DVector<Rational>) -> Exact {
        let parts = z.rows(0, self.generators.ncols()).into_owned();
        Exact { impulse: &self.generators * &parts, velocity: &self.free + &self.moved * &parts }
    }

    /// A direction in z, into the polyhedron of a support, along which `image` z moves.
    fn moves(&self, image: &DMatrix<Rational>, support: &[bool], family: &Family) -> Option<DVector<Rational>> {
        let (size, parts) = (support.len(), image.ncols());
        if !(image * family.direction.rows(0, parts)).iter().all(Rational::is_zero) {
            return Some(family.direction.clone());
        }
        let cone = complementary_matrix(&self.lcp, support);
        let w = self.lcp.slack(&family.point);
        let point = DVector::from_fn(size, |j, _| if support[j] { family.point[j].clone() } else { w[j].clone() });
        let gain = |i: usize, j: usize| if j < parts && support[j] { image[(i, j)].clone() } else { Rational::ZERO };
        let gains = (0..image.nrows()).map(|i| (0..size).map(|j| gain(i, j)).collect());
        let change = moving(&cone, &point, gains)?;
        Some(DVector::from_fn(size, |j, _| if support[j] { change[j].clone() } else { Rational::ZERO }))
    }
}

#[cfg(test)]
#[path = "polyhedral_solutions_tests.rs"]
mod tests;
