//! Problems that the tests of several solvers share: a point whose answers are known, and a cube whose contacts are redundant.

use crate::operator::{BlockSparse, Sparse};
use crate::problem::{ContactProblem, Law};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

/// Why building them cannot fail.
const SOUND: &str = "sizes that fit, finite numbers, μ ≥ 0 and masses > 0";

/// A point of 1 kg on a plane.
pub(super) fn point(law: Law, friction: f64, free: DVector<f64>) -> ContactProblem {
    ContactProblem::new(DMatrix::identity(3, 3), free).law(law).friction(vec![friction]).build().expect(SOUND)
}

/// Free velocities of the point with μ = ½, and its impulses: open, sticking, at rest, at the apex, sliding.
///
/// With W = I the associated impulse is the projection of −u_free on the cone ‖r_t‖ ≤ r_n/2, zero where u_n ≥ ‖u_t‖/2; Coulomb's is
/// r_n = −u_n, r_t = −r_n/2 · u_t/‖u_t‖ where ‖u_t‖ > −u_n/2.
pub(super) fn of_a_point(law: Law) -> Vec<(DVector<f64>, DVector<f64>)> {
    let slides = if law == Law::Coulomb {
        dvector![1.0, -0.3, 0.4]
    } else {
        // (r·c) c with c = (2, −0.6, 0.8)/√5 and r = (1, −1.8, 2.4): r·c = 5/√5
        dvector![2.0, -0.6, 0.8]
    };
    vec![
        (dvector![2.0, 3.0, -2.0], DVector::zeros(3)),
        (dvector![-1.0, 0.3, 0.2], dvector![1.0, -0.3, -0.2]),
        (dvector![-1.0, 0.0, 0.0], dvector![1.0, 0.0, 0.0]),
        (DVector::zeros(3), DVector::zeros(3)),
        (dvector![-1.0, 1.8, -2.4], slides),
    ]
}

/// A cube of 1 kg and edge 2 m on four corners, pushed sideways and turned about the vertical, μ = ½: rank six of twelve.
pub(super) fn four_corners(law: Law, sideways: f64, turning: f64) -> ContactProblem {
    let mut jacobian = DMatrix::zeros(12, 6);
    for (k, [x, y]) in [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]].into_iter().enumerate() {
        let rows = dmatrix![
            0.0, 0.0, 1.0, y, -x, 0.0;
            1.0, 0.0, 0.0, 0.0, -1.0, -y;
            0.0, 1.0, 0.0, 1.0, 0.0, x
        ];
        jacobian.rows_mut(3 * k, 3).copy_from(&rows);
    }
    let mass = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 1.0, 1.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0]));
    let free = DVector::from_vec(vec![sideways, 0.0, -1.0, 0.0, 0.0, turning]);
    ContactProblem::from_dynamics(mass, jacobian, &free)
        .name("four corners")
        .law(law)
        .friction(vec![0.5; 4])
        .bodies(vec![[Some(0), None]; 4])
        .build()
        .expect(SOUND)
}

/// So many cubes of 1 kg and edge 2 m on each other, which fall for a hundredth of a second while every second one is pushed sideways, μ =
/// ½: four contacts between each two, 12 rows for each six velocities, with W as a square matrix.
pub(super) fn tower(cubes: usize, law: Law, push: f64) -> ContactProblem {
    let (mut jacobian, mut bodies) = (DMatrix::zeros(12 * cubes, 6 * cubes), Vec::new());
    for cube in 0..cubes {
        for (corner, [x, y]) in [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]].into_iter().enumerate() {
            let rows = |z: f64| dmatrix![0.0, 0.0, 1.0, y, -x, 0.0; 1.0, 0.0, 0.0, 0.0, z, -y; 0.0, 1.0, 0.0, -z, 0.0, x];
            let row = 12 * cube + 3 * corner;
            jacobian.view_mut((row, 6 * cube), (3, 6)).copy_from(&rows(-1.0));
            if cube > 0 {
                jacobian.view_mut((row, 6 * cube - 6), (3, 6)).copy_from(&-rows(1.0));
            }
            bodies.push([Some(cube), cube.checked_sub(1)]);
        }
    }
    let inertia = [1.0, 1.0, 1.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];
    let mass = DMatrix::from_fn(6 * cubes, 6 * cubes, |i, j| if i == j { inertia[i % 6] } else { 0.0 });
    let free = DVector::from_fn(6 * cubes, |i, _| match i % 6 {
        0 => push * (i / 6 % 2) as f64,
        2 => -0.0981,
        _ => 0.0,
    });
    let problem = ContactProblem::from_dynamics(mass, jacobian, &free).name("tower").law(law).friction(vec![0.5; 4 * cubes]);
    problem.bodies(bodies).build().expect(SOUND)
}

/// The same problem with W by blocks.
pub(super) fn by_blocks(problem: &ContactProblem) -> ContactProblem {
    let blocks = BlockSparse::from_sparse(&Sparse::of(problem.dense()), problem.rows_per_contact()).expect(SOUND);
    problem.clone().into_builder().delassus(blocks).build().expect(SOUND)
}
