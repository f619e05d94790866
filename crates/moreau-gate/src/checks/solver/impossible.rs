//! Problems without a solution.

use crate::checks::scenery::worst;
use crate::checks::solver::asked::{discrepancy, laws};
use crate::checks::solver::problems::point;
use crate::tolerance::solver as tolerance;
use crate::{Bench, Expectation, Measurement, Refusal, Reply};
use moreau_contact::contact::delassus::delassus;
use moreau_contact::problem::{ContactProblem, Law};
use nalgebra::DVector;

/// A unit mass between walls with normals ±x that both ask for an approach speed of at most −s: u₁ = v_x, u₂ = −v_x, y = u − s.
fn squeezed(law: Law, spatial: bool, squeeze: f64) -> moreau_exact::Result<ContactProblem> {
    let (mass, jacobian) = point(1.0, &[[1.0, 0.0], [-1.0, 0.0]], spatial);
    let rows = jacobian.nrows() / 2;
    let mut shift = DVector::zeros(2 * rows);
    (0..2).for_each(|wall| shift[wall * rows] = -squeeze);
    let velocity = DVector::from_fn(mass.nrows(), |k, _| if k + 1 == mass.nrows() { -0.5 } else { 0.0 });
    ContactProblem::new(delassus(&mass, &jacobian)?, &jacobian * velocity)
        .name(format!("squeezed between walls, {}", law.name()))
        .law(law)
        .rows_per_contact(rows)
        .friction(vec![0.5; 2])
        .shift(shift)
        .build()
}

pub(super) fn run(bench: &mut Bench) -> Reply<Vec<Measurement>> {
    let mut largest: f64 = 0.0;
    let listed = laws(bench)?;
    for (law, spatial) in listed.into_iter().flat_map(|law| [(law, false), (law, true)]) {
        let problem = squeezed(law, spatial, 0.5).map_err(Refusal::errored)?;
        match bench.solve(&problem) {
            Ok(solution) => {
                let row = problem.dense().row_iter().map(|row| row.lp_norm(1)).fold(0.0, worst);
                let rounding = tolerance::product(bench.epsilon(), problem.rows(), row, solution.impulse.amax());
                let scale = (problem.free_velocity() + problem.shift()).norm();
                largest = worst(largest, (discrepancy(&problem, &solution) - rounding).max(0.0) / scale);
            }
            Err(Refusal::Errored(_) | Refusal::Unsupported(_)) => {}
        }
    }
    let ideal = Expectation::at_most(0.0, tolerance::residual(bench.epsilon()), "the velocity belongs to the impulses");
    Ok(vec![Measurement::new(
        "largest u − (W r + u_free) beyond rounding over the velocity scale, where nothing solves the problem",
        "1",
        largest,
        ideal,
    )])
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_contact::certificate::existence::hypothesis;
    use moreau_contact::certificate::feasibility::{Feasibility, nonnegative_solution};
    use moreau_exact::scalar::{Scalar, ratio};
    use nalgebra::{DMatrix, dvector};

    #[test]
    fn two_opposite_walls_that_both_push_leave_no_velocity() {
        // W_nn λ + q ≥ 0 with W = [[1, −1], [−1, 1]], q = (−½, −½): exactly infeasible.
        let matrix = DMatrix::from_row_slice(2, 4, &[1, -1, -1, 0, -1, 1, 0, -1].map(|x| ratio(x, 1)));
        let right_side = dvector![ratio(1, 2), ratio(1, 2)];
        assert!(matches!(nonnegative_solution(&matrix, &right_side), Feasibility::Farkas(_)));
        let problem = squeezed(Law::Coulomb, false, 0.5).expect("definite");
        assert_eq!([problem.entry(0, 0), problem.entry(0, 2), problem.shift()[0] + problem.free_velocity()[0]], [1.0, -1.0, -0.5]);
    }

    #[test]
    fn the_existence_theorem_does_not_apply_to_it_and_does_without_the_squeeze() {
        let problem = squeezed(Law::Coulomb, false, 0.5).expect("definite");
        // Columns λ₁, λ₂, then ±tangent of each wall.
        let columns = [(0, 1), (2, 1), (1, 1), (1, -1), (3, 1), (3, -1)];
        let reduced = DMatrix::from_fn(6, 6, |i, j| {
            let ((a, s), (b, t)) = (columns[i], columns[j]);
            ratio((problem.entry(a, b) as i64) * s * t, 1)
        });
        let friction = [ratio(1, 2), ratio(1, 2)];
        let added = [problem.shift()[0], problem.shift()[2]].map(|s| ratio((2.0 * s) as i64, 2));
        assert!(added.iter().all(|b| Scalar::to_f64(b) == -0.5));
        assert!(!hypothesis(&reduced, &friction, &added).holds());
        assert!(hypothesis(&reduced, &friction, &[ratio(0, 1), ratio(0, 1)]).holds());
    }
}
