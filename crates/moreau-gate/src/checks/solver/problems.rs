//! Contact problems with a known solution: first the motion after the step and the impulses are chosen, then the velocity without impulse.
//!
//! ```text
//!     y = H v⁺ + s ,   (r, y) in the law contact by contact ,   shift = s ,   u_free = H v⁺ − W r ,   W = H M⁻¹ Hᵀ
//! ```
//! So every problem has a solution, whichever the law, the friction and the rank of W: the chosen r is the certificate of existence. It
//! need not be the only one; what an engine answers is judged by its residuals.

use moreau_contact::contact::delassus::delassus;
use moreau_contact::problem::{ContactProblem, Law};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// A problem with one of its solutions.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The problem.
    pub problem: ContactProblem,
    /// Impulses r \[N·s\] that solve it.
    pub witness: DVector<f64>,
}

/// What a contact does in the chosen solution.
#[derive(Clone, Copy, Debug)]
pub enum Does {
    /// Pushes with r_n \[N·s\] and a friction of `part` · μ r_n against tangent₁, and does not move.
    Stick {
        /// r_n.
        push: f64,
        /// From −1 to 1.
        part: f64,
    },
    /// Pushes with r_n \[N·s\] and slides along tangent₁ at a speed \[m/s\].
    Slide {
        /// r_n.
        push: f64,
        /// ‖y_t‖ > 0.
        speed: f64,
    },
    /// Separates at y_n \[m/s\] in excess of what the law needs, sliding along tangent₁.
    Open {
        /// y_n.
        apart: f64,
        /// ‖y_t‖.
        speed: f64,
    },
}

/// The laws that are posed.
pub const LAWS: [Law; 3] = [Law::Frictionless, Law::Coulomb, Law::Associated];

impl Does {
    /// (r, y) under a law, `rows` entries each; the remaining tangential entries are 0.
    fn answer(self, law: Law, mu: f64, rows: usize) -> (Vec<f64>, Vec<f64>) {
        let lift = |speed: f64| if law == Law::Associated { mu * speed } else { 0.0 };
        let friction = |value: f64| if law == Law::Frictionless { 0.0 } else { value };
        let (normal, tangential) = match self {
            Does::Stick { push, part } => ([push, 0.0], [friction(-part * mu * push), 0.0]),
            Does::Slide { push, speed } => ([push, lift(speed)], [friction(-mu * push), speed]),
            Does::Open { apart, speed } => ([0.0, apart + lift(speed)], [0.0, speed]),
        };
        let entries = |k: usize| {
            let mut vector = vec![0.0; rows];
            vector[0] = normal[k];
            if rows > 1 {
                vector[1] = tangential[k];
            }
            vector
        };
        (entries(0), entries(1))
    }
}

/// The problem of a mechanism (M, H with `rows` rows per contact) whose contacts do what is said; `shift` along the normals \[m/s\].
///
/// # Errors
/// If M is not positive definite or the sizes do not fit.
pub fn solved(
    name: &str,
    law: Law,
    mechanism: (&DMatrix<f64>, &DMatrix<f64>),
    friction: f64,
    contacts: &[Does],
    shift: f64,
) -> Result<Solved> {
    let (mass, jacobian) = mechanism;
    let rows = jacobian.nrows() / contacts.len();
    let answers: Vec<_> = contacts.iter().map(|does| does.answer(law, friction, rows)).collect();
    let witness = DVector::from_iterator(jacobian.nrows(), answers.iter().flat_map(|(r, _)| r.iter().copied()));
    let law_velocity = DVector::from_iterator(jacobian.nrows(), answers.iter().flat_map(|(_, y)| y.iter().copied()));
    let mut added = DVector::zeros(jacobian.nrows());
    (0..contacts.len()).for_each(|k| added[k * rows] = shift);
    let delassus = delassus(mass, jacobian)?;
    let free_velocity = &law_velocity - &added - &delassus * &witness;
    let problem = ContactProblem::new(delassus, free_velocity)
        .name(format!("{name}, {}", law.name()))
        .law(law)
        .rows_per_contact(rows)
        .friction(vec![friction; contacts.len()])
        .shift(added)
        .build()
        .map_err(|error| Error::invalid("problem", error.to_string(), "a manufactured problem is valid"))?;
    Ok(Solved { problem, witness })
}

/// A point mass against planes with these unit normals, which lie in the x–z plane; tangents as for a floor, turned along.
pub fn point(mass: f64, normals: &[[f64; 2]], spatial: bool) -> (DMatrix<f64>, DMatrix<f64>) {
    let (velocities, rows) = if spatial { (3, 3) } else { (2, 2) };
    let jacobian = DMatrix::from_fn(rows * normals.len(), velocities, |i, j| {
        let [x, z] = normals[i / rows];
        let axes = if spatial { [[x, 0.0, z], [z, 0.0, -x], [0.0, 1.0, 0.0]] } else { [[x, z, 0.0], [z, -x, 0.0], [0.0; 3]] };
        axes[i % rows][j]
    });
    (DMatrix::identity(velocities, velocities) * mass, jacobian)
}

/// A flat plate of mass 1 kg and half extents (a, b, c) \[m\] on contacts at (x, y, −c) of its lower face: v = (v, ω), u = v + ω × ρ.
pub fn plate([a, b, c]: [f64; 3], at: &[[f64; 2]]) -> (DMatrix<f64>, DMatrix<f64>) {
    let inertia = [(b * b + c * c) / 3.0, (a * a + c * c) / 3.0, (a * a + b * b) / 3.0];
    let mass = DMatrix::from_fn(6, 6, |i, j| {
        if i != j {
            0.0
        } else if i < 3 {
            1.0
        } else {
            inertia[i - 3]
        }
    });
    let jacobian = DMatrix::from_fn(3 * at.len(), 6, |i, j| {
        let [x, y] = at[i / 3];
        // Rows along n = z, t₁ = x, t₂ = y: d·(ω × ρ) = (ρ × d)·ω with ρ = (x, y, −c).
        let rows = [[0.0, 0.0, 1.0, y, -x, 0.0], [1.0, 0.0, 0.0, 0.0, -c, -y], [0.0, 1.0, 0.0, c, 0.0, x]];
        rows[i % 3][j]
    });
    (mass, jacobian)
}

/// The corners of a plate's lower face.
pub fn corners(a: f64, b: f64) -> [[f64; 2]; 4] {
    [[a, b], [a, -b], [-a, -b], [-a, b]]
}

/// A planar bar of mass 1 kg and half extents (a, c) \[m\] on contacts at (x, −c): v = (v_x, v_z, ω).
pub fn bar([a, c]: [f64; 2], at: &[f64]) -> (DMatrix<f64>, DMatrix<f64>) {
    let mass = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 1.0, (a * a + c * c) / 3.0]));
    let jacobian = DMatrix::from_fn(2 * at.len(), 3, |i, j| if i % 2 == 0 { [0.0, 1.0, at[i / 2]][j] } else { [1.0, 0.0, c][j] });
    (mass, jacobian)
}

/// Point masses on top of each other, the first on the floor: contact k is between masses k and k − 1.
pub fn tower(masses: &[f64]) -> (DMatrix<f64>, DMatrix<f64>) {
    let mass = DMatrix::from_diagonal(&DVector::from_iterator(3 * masses.len(), masses.iter().flat_map(|m| [*m; 3])));
    let jacobian = DMatrix::from_fn(3 * masses.len(), 3 * masses.len(), |i, j| {
        // Rows n, t₁, t₂ are the axes z, x, y.
        let along = [2, 0, 1][i % 3] == j % 3;
        match (along, i / 3, j / 3) {
            (true, contact, body) if contact == body => 1.0,
            (true, contact, body) if contact == body + 1 => -1.0,
            _ => 0.0,
        }
    });
    (mass, jacobian)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::solver as tolerance;
    use moreau_contact::certificate::residuals::residuals;
    use moreau_contact::problem::Solution;

    #[test]
    fn every_problem_of_the_checks_is_solved_by_its_witness() {
        for posed in crate::checks::solver::every_problem() {
            let velocity = posed.problem.velocity(&posed.witness);
            let solution = Solution::new("witness", posed.witness.clone(), velocity, 0);
            let found = residuals(&posed.problem, &solution).expect("sizes fit");
            assert!(found.is_solution(tolerance::residual(f64::EPSILON)), "{}: {found:?}", posed.problem.name());
        }
    }

    #[test]
    fn four_corners_make_a_delassus_operator_of_rank_six() {
        let (mass, jacobian) = plate([0.5, 0.25, 0.125], &corners(0.5, 0.25));
        let delassus = delassus(&mass, &jacobian).expect("definite");
        assert_eq!(delassus.rank(1e-9), 6);
        // A unit impulse along z at the corner (½, ¼): 1/m + y²/I_x + x²/I_y.
        let expected = 1.0 + 0.0625 / (0.078125 / 3.0) + 0.25 / (0.265625 / 3.0);
        assert!((delassus[(0, 0)] - expected).abs() <= moreau_exact::tolerance::rounding(8, expected));
    }

    #[test]
    fn a_tower_couples_neighbours_by_the_mass_between_them() {
        let (mass, jacobian) = tower(&[0.5, 4.0]);
        let delassus = delassus(&mass, &jacobian).expect("definite");
        assert_eq!((delassus[(0, 0)], delassus[(0, 3)], delassus[(3, 3)]), (2.0, -2.0, 2.25));
    }
}
