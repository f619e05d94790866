//! Solve a contact problem and certify the answer: `cargo run --example solve_and_certify`.
//!
//! A cube of 1 kg and edge 2 m comes down on its four lower corners while it slides and turns, μ = ½. Its twelve rows have rank six: there
//! are many impulses and one motion. The certificate judges every answer alike and knows no solver.

use moreau::nalgebra::{self, DMatrix, DVector, dmatrix, dvector};
use moreau::prelude::*;
use moreau::report::certificate::Certificate;
use moreau::solvers::ALL;

/// H: normal, x and y rows of the corners (±1, ±1, −1) of v = (v, ω).
fn corners() -> DMatrix<f64> {
    let mut jacobian = DMatrix::zeros(12, 6);
    for (k, [x, y]) in [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]].into_iter().enumerate() {
        let rows = dmatrix![
            0.0, 0.0, 1.0, y, -x, 0.0;
            1.0, 0.0, 0.0, 0.0, -1.0, -y;
            0.0, 1.0, 0.0, 1.0, 0.0, x
        ];
        jacobian.rows_mut(3 * k, 3).copy_from(&rows);
    }
    jacobian
}

/// Solves the problem in several ways and ends with an error unless the certificate accepts each.
pub fn main() -> moreau::Result<()> {
    let mass = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 1.0, 1.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0]));
    let falling = dvector![2.0, 0.0, -1.0, 0.0, 0.0, 0.5]; // m/s and rad/s, as it would go on without contact
    let cube = ContactProblem::from_dynamics(mass, corners(), &falling).name("cube").law(Law::Coulomb).friction(vec![0.5; 4]).build()?;
    for name in ["auto", "pgs", "psor", "admm", "nonsmooth-newton"] {
        let answer = ALL.by_name(name)?.solve(&cube, None)?;
        let residuals = residuals(&cube, &answer)?;
        println!("{}", Certificate::new(&cube, &answer, &residuals, 1e-8).text());
        assert!(residuals.is_solution(1e-8), "{name}: the certificate rejects its answer");
    }
    Ok(())
}
