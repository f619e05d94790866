//! A problem in another guise: contacts in another order, tangents turned, other units, a contact twice, W by blocks.

use moreau::{ContactProblem, Law};
use moreau_contact::operator::{BlockSparse, Sparse};
use nalgebra::{DMatrix, DVector};

/// W and q = u_free, shift and R of a problem after u ↦ T u, r ↦ T⁻ᵀ r, with T orthogonal or a selection of rows: T W Tᵀ and T q.
fn mapped(problem: &ContactProblem, t: &DMatrix<f64>, contacts: &[usize]) -> ContactProblem {
    let pick = |k: &usize| problem.friction()[*k];
    let bodies = problem.bodies().map(|bodies| contacts.iter().map(|k| bodies[*k]).collect::<Vec<_>>());
    let built = ContactProblem::new(t * problem.dense() * t.transpose(), t * problem.free_velocity())
        .name(problem.name())
        .law(problem.law())
        .rows_per_contact(problem.rows_per_contact())
        .friction(contacts.iter().map(pick).collect())
        .shift(t * problem.shift())
        .bodies(bodies);
    built.build().expect("a valid problem")
}

/// The rows of these contacts, in this order, as a matrix.
fn selection(problem: &ContactProblem, contacts: &[usize]) -> DMatrix<f64> {
    let rows = problem.rows_per_contact();
    DMatrix::from_fn(rows * contacts.len(), problem.rows(), |i, j| f64::from(u8::from(j == rows * contacts[i / rows] + i % rows)))
}

/// These contacts in this order; one may stand twice.
pub fn selected(problem: &ContactProblem, contacts: &[usize]) -> ContactProblem {
    mapped(problem, &selection(problem, contacts), contacts)
}

/// The velocity of the selected contacts.
pub fn select(problem: &ContactProblem, contacts: &[usize], velocity: &DVector<f64>) -> DVector<f64> {
    selection(problem, contacts) * velocity
}

/// A turn of every contact's tangents by an angle of this cosine and sine; in the plane the other sense of the tangent.
pub fn turn(problem: &ContactProblem, [cos, sin]: [f64; 2]) -> DMatrix<f64> {
    let mut t = DMatrix::identity(problem.rows(), problem.rows());
    for k in (0..problem.rows()).step_by(problem.rows_per_contact()) {
        match problem.rows_per_contact() {
            2 => t[(k + 1, k + 1)] = -1.0,
            3 => {
                (t[(k + 1, k + 1)], t[(k + 1, k + 2)]) = (cos, sin);
                (t[(k + 2, k + 1)], t[(k + 2, k + 2)]) = (-sin, cos);
            }
            _ => {}
        }
    }
    t
}

/// The problem with its tangents turned.
pub fn turned(problem: &ContactProblem, t: &DMatrix<f64>) -> ContactProblem {
    mapped(problem, t, &(0..problem.contacts()).collect::<Vec<_>>())
}

/// The angle by which tangents may be turned under a law: any one under round cones, 2π/d under polyhedral ones.
pub fn angle(law: Law) -> [f64; 2] {
    match law.directions() {
        None => [0.6, 0.8],
        Some(4) => [0.0, 1.0],
        Some(d) => {
            let (sin, cos) = (std::f64::consts::TAU / d as f64).sin_cos();
            [cos, sin]
        }
    }
}

/// The problem in units in which a velocity reads `speed` times as much and a mass `mass` times.
pub fn in_units(problem: &ContactProblem, speed: f64, mass: f64) -> ContactProblem {
    let builder = problem.clone().into_builder().dynamics(None).delassus(problem.dense() / mass);
    builder.free_velocity(problem.free_velocity() * speed).shift(problem.shift() * speed).build().expect("a valid problem")
}

/// The problem with W by blocks.
pub fn by_blocks(problem: &ContactProblem) -> ContactProblem {
    let dense = problem.dense();
    let places = (0..dense.ncols()).flat_map(|j| (0..dense.nrows()).map(move |i| (i, j)));
    let entries = places.map(|(i, j)| (i, j, dense[(i, j)])).filter(|(.., w)| *w != 0.0).collect();
    let sparse = Sparse { shape: [dense.nrows(), dense.ncols()], entries };
    let blocks = BlockSparse::from_sparse(&sparse, problem.rows_per_contact()).expect("whole contacts");
    problem.clone().into_builder().dynamics(None).delassus(blocks).build().expect("a valid problem")
}
