//! What is proved of an answer under polyhedral Coulomb friction, through its linear complementarity problem.
//!
//! ```text
//!     z = (λ, β, σ) :   r_n = λ ,   r_t = Σ D_j β_j ,   σ_k = max_j (−D_j·y_t)⁺        0 ≤ z ⟂ M z + q ≥ 0
//! ```
//! Parts that an answer does not give are taken along the two directions beside r_t. M and q are those of
//! [`ContactProblem::stewart_trinkle_lcp`], number by number.

use super::lcp_proof::{Answer, prove};
use crate::cones::polyhedral::{along_neighbours, direction};
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::complementarity::OPEN_ROWS;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Whether a solution (λ, β, σ) is near an answer.
///
/// # Errors
/// [`Error::Unsupported`] for other laws; [`Error::Invalid`] if the answer has another size or a number that is not finite.
/// ```
/// use moreau_contact::certificate::lcp_proof::Answer;
/// use moreau_contact::certificate::polyhedral_proof::prove_polyhedral;
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::{ContactProblem, Law, Solution};
///
/// let block = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).friction(vec![0.5]);
/// let block = block.law(Law::PolyhedralCoulomb { directions: 4 }).build()?;
/// let answer = |r_t: f64| Solution::new("by hand", dvector![1.0, r_t, 0.0], dvector![0.0, 2.0 + r_t, 0.0], 0);
/// assert!(matches!(prove_polyhedral(&block, &answer(-0.5))?, Answer::Near(near) if near.distance == 0.0));
/// assert!(matches!(prove_polyhedral(&block, &answer(-0.25))?, Answer::Near(near) if near.distance == 0.25));
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn prove_polyhedral(problem: &ContactProblem, answer: &Solution) -> Result<Answer> {
    let Law::PolyhedralCoulomb { directions } = problem.law() else {
        return Err(Error::Unsupported(format!("not proved: the law `{}` has no proof of a solution near", problem.law().name())));
    };
    if answer.impulse.len() != problem.rows() || answer.impulse.iter().any(|r| !r.is_finite()) {
        return Err(Error::invalid("impulse", format!("is not {} finite numbers", problem.rows()), "give one number per row"));
    }
    let unknowns = problem.contacts() * (2 + directions);
    if unknowns > OPEN_ROWS {
        let reason =
            format!("{unknowns} λ, β, σ; signs are decided in fractions up to {OPEN_ROWS}", unknowns = counted(unknowns, "unknown"));
        return Ok(Answer::NotProved { row: None, reason });
    }
    prove(&problem.stewart_trinkle_lcp()?, &pairs(problem, answer, directions))
}

/// (λ, β, σ) of an answer.
fn pairs(problem: &ContactProblem, answer: &Solution, directions: usize) -> DVector<f64> {
    let (rows, contacts) = (problem.rows_per_contact(), problem.contacts());
    let tangent =
        |of: &DVector<f64>, k: usize| -> [f64; 2] { std::array::from_fn(|i| if i + 1 < rows { of[k * rows + 1 + i] } else { 0.0 }) };
    let normal = (0..contacts).map(|k| answer.impulse[k * rows]);
    let recovered = |k: usize| {
        let mut parts = Vec::with_capacity(directions);
        along_neighbours(tangent(&answer.impulse, k), directions, &mut parts);
        parts
    };
    let beta = answer.beta.as_ref().filter(|beta| beta.len() == contacts * directions);
    let beta: Vec<f64> = beta.map_or_else(|| (0..contacts).flat_map(recovered).collect(), |beta| beta.as_slice().to_vec());
    let y = problem.law_velocity(&answer.impulse);
    let slip = |k: usize| {
        let against = |j: usize| -direction(j, directions).iter().zip(tangent(&y, k)).map(|(d, y)| d * y).sum::<f64>();
        (0..directions).map(against).fold(0.0, f64::max)
    };
    let sigma = answer.sigma.as_ref().filter(|sigma| sigma.len() == contacts);
    let sigma = sigma.map_or_else(|| (0..contacts).map(slip).collect(), |sigma| sigma.as_slice().to_vec());
    DVector::from_iterator(contacts * (2 + directions), normal.chain(beta).chain(sigma))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, dvector};

    fn block(free: [f64; 3], directions: usize) -> ContactProblem {
        let problem = ContactProblem::new(DMatrix::identity(3, 3), DVector::from_row_slice(&free)).friction(vec![0.5]);
        problem.law(Law::PolyhedralCoulomb { directions }).build().unwrap()
    }

    fn answer(problem: &ContactProblem, impulse: [f64; 3]) -> Solution {
        let impulse = DVector::from_row_slice(&impulse);
        Solution::new("", impulse.clone(), problem.velocity(&impulse), 0)
    }

    #[test]
    fn blocks_that_slide_stick_and_fly_are_proved_and_a_moved_answer_is_as_far_as_it_was_moved() {
        for (free, impulse) in
            [([-1.0, 2.0, 0.0], [1.0, -0.5, 0.0]), ([-1.0, 0.25, 0.125], [1.0, -0.25, -0.125]), ([1.0, 2.0, 0.0], [0.0; 3])]
        {
            let problem = block(free, 4);
            let Answer::Near(near) = prove_polyhedral(&problem, &answer(&problem, impulse)).unwrap() else { panic!("{free:?}") };
            assert!(near.exact && near.distance == 0.0, "{near:?}");
            let moved = answer(&problem, [impulse[0] + 0.0625, impulse[1], impulse[2]]);
            match prove_polyhedral(&problem, &moved).unwrap() {
                Answer::Near(near) => assert!(near.distance >= 0.0625, "{free:?}: {near:?}"),
                Answer::NotProved { reason, .. } => assert!(!reason.is_empty()),
            }
        }
    }

    #[test]
    fn two_contacts_keep_their_parts_apart() {
        let free = dvector![-1.0, 2.0, 0.0, -1.0, 0.25, 0.125];
        let problem = ContactProblem::new(DMatrix::identity(6, 6), free).friction(vec![0.5; 2]);
        let problem = problem.law(Law::PolyhedralCoulomb { directions: 4 }).build().unwrap();
        let impulse = dvector![1.0, -0.5, 0.0, 1.0, -0.25, -0.125];
        let exact = Solution::new("", impulse.clone(), problem.velocity(&impulse), 0);
        assert!(matches!(prove_polyhedral(&problem, &exact).unwrap(), Answer::Near(near) if near.distance == 0.0));
        let moved = impulse + dvector![0.0, 0.0, 0.0, 0.0, 0.0625, 0.0];
        let moved = Solution::new("", moved.clone(), problem.velocity(&moved), 0);
        assert!(matches!(prove_polyhedral(&problem, &moved).unwrap(), Answer::Near(near) if near.distance == 0.0625));
    }

    #[test]
    fn parts_that_are_given_count_and_other_laws_and_sizes_are_refused() {
        let problem = block([-1.0, 2.0, 0.0], 4);
        let mut given = answer(&problem, [1.0, -0.5, 0.0]);
        given.beta = Some(dvector![0.0, 0.0, 0.5, 0.0]);
        given.sigma = Some(dvector![1.5]);
        assert!(matches!(prove_polyhedral(&problem, &given).unwrap(), Answer::Near(near) if near.distance == 0.0));
        given.sigma = Some(dvector![1.0]);
        assert!(matches!(prove_polyhedral(&problem, &given).unwrap(), Answer::Near(near) if near.distance == 0.5));
        let cone = block([-1.0, 2.0, 0.0], 4).into_builder().law(Law::Coulomb).build().unwrap();
        assert!(prove_polyhedral(&cone, &given).is_err());
        given.impulse = dvector![1.0];
        assert!(prove_polyhedral(&problem, &given).is_err());
    }
}
