//! When the Stewart–Trinkle LCP has a solution: the theorem that holds in place of “M is copositive-plus”.
//!
//! Let M = \[\[W̃, (0; E)\], \[(μ, −Eᵀ), 0\]\] with W̃ = CᵀM⁻¹C, C = (n D), μ ≥ 0, and q = (nᵀv + b, Dᵀv, 0): b is what
//! the scheme adds along the normals, φ/h for Stewart–Trinkle. With x = (λ, β, σ) and x₁ = (λ, β),
//!
//! ```text
//!     xᵀM x = x₁ᵀW̃ x₁ + Σ μᵢ λᵢ σᵢ .
//! ```
//!
//! 1. M is copositive. It is copositive-plus iff every μ is 0: x = (0, 0, σ) has xᵀM x = 0 and (M + Mᵀ) x = (μσ, 0, 0).
//!    It is not positive semidefinite if a μ > 0, and never a P-matrix, because the diagonal is 0 at σ.
//! 2. The homogeneous solutions {x ≥ 0, M x ≥ 0, xᵀM x = 0} are {C x₁ = 0, Eᵀβ ≤ μλ, μᵢλᵢσᵢ = 0}.
//! 3. **If bᵀλ ≥ 0 for all λ, β ≥ 0 with C(λ, β) = 0 and Eᵀβ ≤ μλ, the LCP has a solution, and lexicographic Lemke with
//!    any covering vector d > 0 finds one.** On a secondary ray (z + tẑ, z₀ + tẑ₀) with z₀ > 0, ẑᵀM ẑ + ẑ₀ dᵀẑ = 0 with
//!    both terms ≥ 0; so ẑ₀ = 0 (ẑ = 0 belongs to the primary ray alone) and ẑ is a homogeneous solution. Along the ray
//!    ẑᵀq = −z₀ dᵀẑ − ẑᵀM z, where ẑᵀM z ≥ 0 because zᵀM ẑ = 0 and M is copositive; so ẑᵀq < 0. But on homogeneous
//!    solutions xᵀq = vᵀC x₁ + bᵀλ = bᵀλ ≥ 0, a contradiction.
//! 4. So it is always solvable if every gap is ≥ 0 (any μ, redundant contacts, jamming), and for any gap if the friction
//!    cone is pointed: C x₁ = 0, Eᵀβ ≤ μλ, x₁ ≥ 0 only for λ = 0. Without either it may be feasible and unsolvable.

use super::Decision;
use super::feasibility::nonnegative_solution;
use dashu_ratio::RBig;
use moreau_exact::scalar::{Rational, ratio};
use nalgebra::{DMatrix, DVector};

/// Whether bᵀλ ≥ 0 for all λ, β ≥ 0 with W̃(λ, β) = 0 and Eᵀβ ≤ μλ, hypothesis 3; the witness is (λ, β) with bᵀλ = −1.
///
/// # Panics
/// If W̃ does not have k(1 + d) rows for k coefficients, or b not k entries.
pub fn hypothesis(reduced: &DMatrix<Rational>, friction: &[Rational], added: &[Rational]) -> Decision<DVector<Rational>> {
    let (contacts, impulses) = (friction.len(), reduced.nrows());
    let d = impulses / contacts - 1;
    assert!(impulses == contacts * (1 + d) && added.len() == contacts, "W̃ has k(1 + d) rows, b has k entries");
    // Rows: W̃ (λ, β) = 0;  Eᵀβ − μλ + s = 0 per contact;  bᵀλ = −1. Columns: λ, β, s.
    let system = DMatrix::from_fn(impulses + contacts + 1, impulses + contacts, |i, j| {
        let owner = if j < contacts { j } else { (j - contacts) / d.max(1) };
        match (i, j) {
            (i, j) if i < impulses && j < impulses => reduced[(i, j)].clone(),
            (i, _) if i < impulses => RBig::ZERO,
            (i, j) if i < impulses + contacts => cone_row(i - impulses, j, owner, friction, impulses),
            (_, j) if j < contacts => added[j].clone(),
            _ => RBig::ZERO,
        }
    });
    let right_side = DVector::from_fn(system.nrows(), |i, _| ratio(-i64::from(i == impulses + contacts), 1));
    match nonnegative_solution(&system, &right_side).point() {
        None => Decision::Holds,
        Some(x) => Decision::Fails(x.rows(0, impulses).into_owned()),
    }
}

/// Entry j of the row Eᵀβ − μλ + s of one contact.
fn cone_row(contact: usize, j: usize, owner: usize, friction: &[Rational], impulses: usize) -> Rational {
    if j >= impulses {
        ratio(i64::from(j - impulses == contact), 1)
    } else if owner != contact {
        RBig::ZERO
    } else if j < friction.len() {
        -friction[contact].clone()
    } else {
        RBig::ONE
    }
}

/// Whether the friction cone is pointed; the witness is (λ, β) with λ ≠ 0 that pushes without moving anything.
///
/// # Panics
/// If W̃ does not have k(1 + d) rows for k coefficients.
pub fn pointed(reduced: &DMatrix<Rational>, friction: &[Rational]) -> Decision<DVector<Rational>> {
    hypothesis(reduced, friction, &vec![-RBig::ONE; friction.len()])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::stewart_trinkle::generators;

    /// A point between two walls with normals (0, 1) and (0, −1), directions ±x.
    fn between_walls() -> DMatrix<Rational> {
        let jacobian = DMatrix::from_row_slice(4, 2, &[0, 1, 1, 0, 0, -1, 1, 0].map(|x| ratio(x, 1)));
        let columns = jacobian.transpose() * generators(2, 2, &[[ratio(1, 1), ratio(0, 1)], [ratio(-1, 1), ratio(0, 1)]]);
        columns.transpose() * columns
    }

    #[test]
    fn opposite_walls_jam_and_only_negative_gaps_break_the_hypothesis() {
        let friction = [ratio(1, 2), ratio(1, 2)];
        let witness = pointed(&between_walls(), &friction).witness().expect("both walls can push at once");
        assert_eq!(between_walls() * &witness, DVector::from_element(6, RBig::ZERO));
        assert!(hypothesis(&between_walls(), &friction, &[ratio(0, 1), ratio(3, 1)]).holds());
        assert!(hypothesis(&between_walls(), &friction, &[ratio(-1, 1), ratio(1, 1)]).holds());
        assert!(!hypothesis(&between_walls(), &friction, &[ratio(-1, 1), ratio(0, 1)]).holds());
    }

    #[test]
    fn one_contact_on_a_point_is_pointed() {
        let reduced = between_walls();
        let one = moreau_exact::elimination::principal(&reduced, &[0, 2, 3]);
        assert!(pointed(&one, &[ratio(5, 1)]).holds());
    }
}
