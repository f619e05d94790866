//! Whether all solutions of a problem have the same velocities, with the reason that proves it.
//!
//! Let r, r′ be solutions, e = r − r′, y, y′ their law velocities, f = y − y′ = A e with A = W + R, and ŷ as in the law. Each impulse lies
//! in K and each ŷ in K*, and r·ŷ = r′·ŷ′ = 0, so
//!
//! ```text
//!     (1)     e·(ŷ − ŷ′) = −r·ŷ′ − r′·ŷ ≤ 0 .
//! ```
//! **Without friction, and associated:** ŷ = y, hence e·A e ≤ 0. If W is symmetric and positive semidefinite, R ≥ 0, then W e = 0: all
//! solutions have the same u = W r + u_free. If the symmetric part of A is definite, e = 0.
//!
//! **Coulomb:** ŷ = y + μ‖y_t‖ n, and | ‖y_t‖ − ‖y_t′‖ | ≤ ‖f_t‖, so for all α_k > 0
//!
//! ```text
//!     (2)     e·A e ≤ Σ_k μ_k |e_nk| ‖f_tk‖ ≤ ½ Σ_k μ_k (α_k e_nk² + ‖f_tk‖²/α_k) = ½ e·(N + AᵀT A) e ,
//!             N = diag(μ_k α_k) at the normal rows,   T = diag(μ_k/α_k) at the tangential ones.
//! ```
//! If ½(A + Aᵀ) − ½(N + AᵀT A) is positive definite for some α, then e = 0: **the solution is unique**. For a symmetric W ≻ 0 and
//! α = √(λ_min λ_max) the right side of (2) is at most max μ · √cond(W) · e·A e, so that max μ · √cond(W) < 1 is a special case; the matrix
//! sees beyond it how little the normal and the tangential rows are coupled. Near μ = W_nn/|W_nt|, where one contact in the plane gets a
//! second solution, the condition must fail; the tests hold it against such problems.
//!
//! All this is said of W as the problem stores it, and of the exact H M̂⁻¹ Hᵀ where that is named. Rows that never have an impulse –
//! tangents without friction – are left out of A.

use super::definite::surely_definite;
use super::definiteness::{Definiteness, definiteness};
use super::forward::{times, uncertainty};
use crate::problem::{ContactProblem, Coordinates, Law};
use crate::tolerance::proof::{EXACT_ROWS, ROWS, WEIGHTS, enlarged, product};
use moreau_exact::scalar::{Rational, exact};
use nalgebra::DMatrix;

/// What is known about the number of solutions.
#[derive(Clone, Debug, PartialEq)]
pub enum Uniqueness {
    /// There is at most one solution.
    Solution(&'static str),
    /// All solutions have the same velocities; their impulses may differ.
    Velocity(&'static str),
    /// Neither was proved, for this reason.
    Unknown(String),
}

/// Decides what can be decided about the number of solutions, whether there is one or not.
/// ```
/// use moreau_contact::certificate::uniqueness::{Uniqueness, uniqueness};
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::{ContactProblem, Law};
///
/// let block = |mu: f64| {
///     let w = DMatrix::from_row_slice(2, 2, &[1.0, 0.5, 0.5, 1.0]); // a normal impulse also moves it along: second solutions from μ = 2
///     ContactProblem::new(w, dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![mu]).build()
/// };
/// assert!(matches!(uniqueness(&block(0.5)?), Uniqueness::Solution(_)));
/// assert!(matches!(uniqueness(&block(2.5)?), Uniqueness::Unknown(_)));
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn uniqueness(problem: &ContactProblem) -> Uniqueness {
    if problem.rows() > ROWS {
        return Uniqueness::Unknown(format!("more than {ROWS} rows; proofs are dense"));
    }
    if problem.knows_rows() && problem.dynamics().is_none() {
        // what is proved of the stored W would not be proved of the one that mass and Jacobian make
        return Uniqueness::Unknown("a mass is infinite, or there are too many velocities to write mass and Jacobian out".into());
    }
    let edges = problem.compliance().is_some_and(|soft| soft.coordinates == Coordinates::Edge);
    match problem.law() {
        Law::PolyhedralCoulomb { .. } => {
            Uniqueness::Unknown("under polyhedral friction solutions are enumerated: `polyhedral_solutions`".into())
        }
        Law::Coulomb if has_friction(problem) => coulomb(problem),
        _ if edges => Uniqueness::Unknown("the compliance acts on edges".into()),
        Law::PolyhedralAssociated { .. } => semidefinite(problem),
        _ => convex(problem),
    }
}

fn has_friction(problem: &ContactProblem) -> bool {
    problem.rows_per_contact() > 1 && problem.friction().iter().any(|mu| *mu > 0.0)
}

/// A at the rows that may have an impulse.
fn pressing(problem: &ContactProblem) -> (Vec<usize>, DMatrix<f64>) {
    let d = problem.rows_per_contact();
    let may = |row: &usize| row.is_multiple_of(d) || problem.law().cone_friction(problem.friction()[row / d]) > 0.0;
    let rows: Vec<usize> = (0..problem.rows()).filter(may).collect();
    let entry = |i: usize, j: usize| problem.entry(rows[i], rows[j]) + if i == j { problem.row_compliance(rows[i]) } else { 0.0 };
    let matrix = DMatrix::from_fn(rows.len(), rows.len(), entry);
    (rows, matrix)
}

/// How far the W of mass and Jacobian may be from the stored one, at the rows that may have an impulse; none where W is the problem.
struct Apart(Option<DMatrix<f64>>);

fn apart(problem: &ContactProblem, rows: &[usize]) -> Apart {
    Apart(uncertainty(problem).map(|all| DMatrix::from_fn(rows.len(), rows.len(), |i, j| all[(rows[i], rows[j])])))
}

impl Apart {
    /// E v, where |E| bounds the difference; zeros where there is none.
    fn times(&self, v: &[f64]) -> Vec<f64> {
        self.0.as_ref().map_or_else(|| vec![0.0; v.len()], |e| times(e, v))
    }

    /// (E + Eᵀ) v.
    fn both(&self, v: &[f64]) -> Vec<f64> {
        self.times(v).into_iter().zip(self.transposed(v)).map(|(one, other)| enlarged(one + other, 1)).collect()
    }

    /// Eᵀ v.
    fn transposed(&self, v: &[f64]) -> Vec<f64> {
        self.0.as_ref().map_or_else(|| vec![0.0; v.len()], |e| times(&e.transpose(), v))
    }
}

fn convex(problem: &ContactProblem) -> Uniqueness {
    let (rows, matrix) = pressing(problem);
    // ½(A + Aᵀ) with a rounding each at the diagonal, the sum and the half
    let symmetric = (&matrix + matrix.transpose()) * 0.5;
    let apart = apart(problem, &rows);
    let unsure = |v: &[f64]| -> Vec<f64> {
        let rounded = times(&symmetric, v).into_iter().map(|size| enlarged(product(4) * size, 1));
        rounded.zip(apart.both(v)).map(|(size, apart)| enlarged(size + apart, 2)).collect()
    };
    if surely_definite(&symmetric, unsure) {
        return Uniqueness::Solution("the law is convex and W + R is positive definite");
    }
    semidefinite(problem)
}

/// W e = 0 of two solutions, where W is symmetric and semidefinite.
fn semidefinite(problem: &ContactProblem) -> Uniqueness {
    if problem.dynamics().is_some_and(|dynamics| dynamics.mass == dynamics.mass.transpose()) {
        return Uniqueness::Velocity("the law is convex and W = H M̂⁻¹ Hᵀ is positive semidefinite");
    }
    if problem.knows_rows() {
        return Uniqueness::Unknown("the mass is not symmetric".into());
    }
    if problem.rows() > EXACT_ROWS {
        return Uniqueness::Unknown(format!("whether W is positive semidefinite is decided in fractions to {EXACT_ROWS} rows"));
    }
    if *problem.dense() != problem.dense().transpose() {
        return Uniqueness::Unknown("W is not symmetric".into());
    }
    let exactly: DMatrix<Rational> = problem.dense().map(exact);
    match definiteness(&exactly) {
        Definiteness::Indefinite { .. } => Uniqueness::Unknown("W is not positive semidefinite, if only by rounding".into()),
        _ => Uniqueness::Velocity("the law is convex and W is positive semidefinite, decided in fractions"),
    }
}

fn coulomb(problem: &ContactProblem) -> Uniqueness {
    let (rows, matrix) = pressing(problem);
    let d = problem.rows_per_contact();
    let mu = |row: usize| problem.friction()[row / d];
    let size = |k: usize| {
        let diagonal = |row: usize| problem.entry(row, row) + problem.row_compliance(row);
        let tangential = (k * d + 1..(k + 1) * d).map(diagonal).fold(0.0, f64::max);
        (diagonal(k * d) * tangential).sqrt()
    };
    let sizes: Vec<f64> = (0..problem.contacts()).map(size).collect();
    let apart = apart(problem, &rows);
    for weight in WEIGHTS {
        let alpha = |row: usize| weight * sizes[row / d];
        let normal: Vec<f64> = rows.iter().map(|row| if row.is_multiple_of(d) { mu(*row) * alpha(*row) } else { 0.0 }).collect();
        let tangential: Vec<f64> = rows.iter().map(|row| if row.is_multiple_of(d) { 0.0 } else { mu(*row) / alpha(*row) }).collect();
        if !normal.iter().chain(&tangential).all(|x| x.is_finite()) {
            continue;
        }
        let scaled = DMatrix::from_fn(rows.len(), rows.len(), |i, j| tangential[i] * matrix[(i, j)]);
        let products = matrix.transpose() * &scaled;
        let mut form = (&matrix + matrix.transpose() - &products) * 0.5;
        form = (&form + form.transpose()) * 0.5;
        (0..rows.len()).for_each(|i| form[(i, i)] -= 0.5 * normal[i]);
        // sums and products of the three parts, each of its own size
        let transposed = matrix.transpose();
        let unsure = |v: &[f64]| -> Vec<f64> {
            let along = times(&matrix, v);
            let weighted: Vec<f64> = along.iter().zip(&tangential).map(|(x, t)| enlarged(x * t, 1)).collect();
            let parts = [along.clone(), times(&transposed, v), times(&transposed, &weighted)];
            let sum = |i: usize| parts.iter().map(|part| part[i]).sum::<f64>() + normal[i] * v[i];
            // with A + E in place of A:  E + Eᵀ + |A|ᵀ T E + Eᵀ T (|A| + E)
            let moved = apart.times(v);
            let weigh = |of: &[f64]| of.iter().zip(&tangential).map(|(x, t)| enlarged(x * t, 1)).collect::<Vec<f64>>();
            let whole: Vec<f64> = along.iter().zip(&moved).map(|(one, other)| enlarged(one + other, 1)).collect();
            let more = [apart.both(v), times(&transposed, &weigh(&moved)), apart.transposed(&weigh(&whole))];
            let apart = |i: usize| enlarged(more.iter().map(|part| part[i]).sum::<f64>(), 3);
            (0..v.len()).map(|i| enlarged(product(rows.len() + 8) * sum(i) + apart(i), 5)).collect()
        };
        if surely_definite(&form, unsure) {
            return Uniqueness::Solution("friction is small beside how W couples normal and tangential rows");
        }
    }
    Uniqueness::Unknown("friction is not small enough for the sufficient condition".into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Inertia, Jacobian, Mass};
    use nalgebra::{DVector, dvector};
    use std::sync::Arc;

    fn planar(w: [f64; 4], mu: f64) -> ContactProblem {
        let w = DMatrix::from_row_slice(2, 2, &w);
        ContactProblem::new(w, dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![mu]).build().unwrap()
    }

    fn is_unique(problem: &ContactProblem) -> bool {
        matches!(uniqueness(problem), Uniqueness::Solution(_))
    }

    #[test]
    fn the_condition_never_holds_where_one_contact_in_the_plane_has_a_second_solution() {
        // with u_free = (−1, …) sliding against the coupling pushes the block in from μ = W_nn/|W_nt| on
        let mut proved = 0;
        for beside in [-0.9, -0.5, -0.1, 0.1, 0.5, 0.9, 2.0] {
            for tangential in [1.0, 4.5, 9.0, 64.0] {
                if beside * beside >= tangential {
                    continue;
                }
                for step in 1..80 {
                    let mu = f64::from(step) * 0.125;
                    let several = mu * f64::abs(beside) >= 1.0;
                    let unique = is_unique(&planar([1.0, beside, beside, tangential], mu));
                    assert!(!(several && unique), "{beside} {tangential} {mu}");
                    proved += usize::from(unique);
                }
            }
        }
        assert!(proved > 100, "{proved}: the condition is of some use");
    }

    #[test]
    fn of_a_mass_that_is_not_written_out_nothing_is_proved_by_the_stored_w() {
        let mass = |second: f64| Arc::new(Inertia::of(Mass::Diagonal(dvector![3.0, second])).unwrap());
        let rows = Arc::new(Jacobian::from_dense(&DMatrix::from_row_slice(1, 2, &[1.0, -1.0]), 1));
        let problem = |second: f64| {
            let made = ContactProblem::from_inertia(&mass(second), &rows, &dvector![-1.0, 0.0]).rows_per_contact(1);
            made.law(Law::Frictionless).friction(vec![0.0]).build().unwrap()
        };
        assert!(is_unique(&problem(7.0)));
        assert!(matches!(uniqueness(&problem(f64::INFINITY)), Uniqueness::Unknown(reason) if reason.contains("infinite")));
    }

    #[test]
    fn it_is_weaker_than_friction_times_the_root_of_the_condition_below_one() {
        // κ = 4: μ < ½ must be proved
        for mu in [0.01, 0.25, 0.4375] {
            let w = DMatrix::from_diagonal(&dvector![1.0, 4.0, 4.0, 4.0, 1.0, 1.0]);
            let problem = ContactProblem::new(w, DVector::from_element(6, -1.0)).friction(vec![mu; 2]).build().unwrap();
            assert!(is_unique(&problem), "{mu}");
        }
    }

    #[test]
    fn convex_laws_are_unique_in_velocity_where_w_is_semidefinite_and_not_where_it_is_indefinite() {
        let problem = |w: [f64; 4], law: Law| {
            let problem = ContactProblem::new(DMatrix::from_row_slice(2, 2, &w), dvector![-1.0, -1.0]);
            problem.rows_per_contact(1).law(law).build().unwrap()
        };
        assert!(matches!(uniqueness(&problem([1.0, 0.0, 0.0, 2.0], Law::Frictionless)), Uniqueness::Solution(_)));
        assert!(matches!(uniqueness(&problem([1.0, 1.0, 1.0, 1.0], Law::Frictionless)), Uniqueness::Velocity(_)));
        assert!(matches!(uniqueness(&problem([1.0, 2.0, 2.0, 1.0], Law::Frictionless)), Uniqueness::Unknown(_)));
        assert!(matches!(uniqueness(&problem([1.0, 1.0, 0.5, 0.5], Law::Frictionless)), Uniqueness::Unknown(_)), "not symmetric");
        // symmetric part definite: one solution, though W is not symmetric
        assert!(matches!(uniqueness(&problem([1.0, 0.5, -0.5, 1.0], Law::Frictionless)), Uniqueness::Solution(_)));
        let cone = planar([1.0, 1.0, 1.0, 1.0], 2.0).into_builder().law(Law::Associated).build().unwrap();
        assert!(matches!(uniqueness(&cone), Uniqueness::Velocity(_)), "convex, whatever the friction");
        let none = planar([1.0, 1.0, 1.0, 1.0], 0.0);
        assert!(matches!(uniqueness(&none), Uniqueness::Solution(_)), "no friction: the normal row alone presses");
        let dynamics = ContactProblem::from_dynamics(DMatrix::identity(1, 1), DMatrix::from_element(3, 1, 0.1), &dvector![-1.0]);
        let dynamics = dynamics.rows_per_contact(1).law(Law::Frictionless).build().unwrap();
        assert!(matches!(uniqueness(&dynamics), Uniqueness::Velocity(_)), "by construction, rounding or not");
    }
}
