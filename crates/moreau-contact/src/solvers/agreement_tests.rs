//! Independent algorithms agree on u and W r, never necessarily on r, and every answer passes the certificate.

use super::*;
use crate::certificate::residuals;
use crate::contact::delassus::delassus;
use crate::problem::{Compliance, Coordinates, Law};
use crate::tolerance::solvers as tolerance;
use nalgebra::DMatrix;

/// Uniform numbers in \[−1, 1) from a fixed seed (SplitMix64).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) as f64 / 2f64.powi(63) - 1.0
    }
}

/// `contacts` random contacts on `velocities` velocities with masses between 1 and `ratio`; more rows than velocities make W singular.
/// A velocity that all contacts agree on, u = H v with u_n > 0, is added so that the problem is feasible.
fn random(law: Law, rows: usize, contacts: usize, velocities: usize, ratio: f64, friction: f64, seed: u64) -> ContactProblem {
    let mut numbers = Numbers(seed);
    let mut jacobian = DMatrix::from_fn(rows * contacts, velocities, |_, _| numbers.next());
    for k in 0..contacts {
        // normals share a component, so that one velocity opens every contact
        jacobian[(k * rows, 0)] = 1.0;
        (1..rows).for_each(|t| jacobian[(k * rows + t, 0)] = 0.0);
    }
    let mass = DMatrix::from_fn(velocities, velocities, |i, j| if i == j { ratio.powf(0.5 * (numbers.next() + 1.0)) } else { 0.0 });
    let mut free = DVector::from_fn(velocities, |_, _| numbers.next());
    free[0] = -1.0;
    ContactProblem::new(delassus(&mass, &jacobian).unwrap(), &jacobian * free)
        .name(format!("random {seed}"))
        .law(law)
        .rows_per_contact(rows)
        .friction(vec![if law == Law::Frictionless { 0.0 } else { friction }; contacts])
        .build()
        .unwrap()
}

fn with(problem: ContactProblem, delassus: DMatrix<f64>, free_velocity: DVector<f64>) -> ContactProblem {
    problem.into_builder().delassus(delassus).free_velocity(free_velocity).build().unwrap()
}

fn softened(problem: ContactProblem) -> ContactProblem {
    let compliance = Compliance { coordinates: Coordinates::Contact, diagonal: DVector::from_element(problem.rows(), 0.1) };
    problem.into_builder().compliance(compliance).build().unwrap()
}

fn certified(problem: &ContactProblem, solver: &dyn ContactSolver) -> Solution {
    let solution = solver.solve(problem, None).unwrap();
    let found = residuals(problem, &solution).unwrap();
    assert!(found.is_solution(1e-8), "{} on {}: {found:?} after {}", solver.name(), problem.name(), solution.iterations);
    solution
}

fn agree(problem: &ContactProblem, one: &Solution, other: &Solution) {
    let of = |solution: &Solution| residuals(problem, solution).unwrap().natural_map;
    let residual = of(one) + of(other);
    let impulses = (&one.impulse - &other.impulse).norm() + residual;
    let rho = crate::certificate::natural_map::scales(problem).into_iter().fold(f64::INFINITY, f64::min);
    let rounding = moreau_exact::tolerance::rounding(problem.rows(), problem.dense().norm() * one.impulse.norm());
    let bound = tolerance::agreement(largest_eigenvalue_bound(&problem.law_delassus().unwrap()), residual, impulses, rho) + rounding;
    let difference = (&one.velocity - &other.velocity).norm();
    assert!(difference <= bound, "{} and {} on {}: {difference:e} > {bound:e}", one.solver, other.solver, problem.name());
}

#[cfg(feature = "clarabel")]
#[test]
fn three_algorithms_agree_on_the_velocities_of_the_convex_laws() {
    for seed in 0..40 {
        for (law, rows) in [(Law::Frictionless, 3), (Law::Associated, 2), (Law::Associated, 3)] {
            // redundant: up to 12 rows on 4 velocities
            let problem = random(law, rows, 1 + seed as usize % 4, 4, 10.0, 0.6, seed);
            let sweeps = certified(&problem, &ProjectedGaussSeidel::default());
            let gradient = certified(&problem, &AcceleratedProjectedGradient::default());
            let interior = certified(&problem, &ClarabelPolished);
            agree(&problem, &sweeps, &gradient);
            agree(&problem, &sweeps, &interior);
        }
    }
}

#[test]
fn the_solvers_of_chrono_and_pinocchio_agree_with_the_others_on_the_convex_laws() {
    for seed in 0..20 {
        for (law, rows) in [(Law::Frictionless, 3), (Law::Associated, 2), (Law::Associated, 3)] {
            let problem = random(law, rows, 1 + seed as usize % 4, 4, 10.0, 0.6, seed);
            let sweeps = certified(&problem, &ProjectedGaussSeidel::default());
            for solver in
                [&BarzilaiBorwein::default() as &dyn ContactSolver, &AlternatingDirections::default(), &ProjectedOverRelaxation::default()]
            {
                agree(&problem, &sweeps, &certified(&problem, solver));
            }
        }
    }
}

#[test]
fn sweeps_and_alternating_directions_solve_coulomb_with_and_without_compliance() {
    for seed in 0..20 {
        for friction in [0.0, 0.3, 1.0] {
            let problem = random(Law::Coulomb, 3, 1 + seed as usize % 4, 6, 10.0, friction, seed);
            certified(&problem, &AlternatingDirections::default());
            certified(&problem, &ProjectedOverRelaxation::default());
            certified(&softened(problem), &AlternatingDirections::default());
        }
    }
}

#[test]
fn coulomb_answers_pass_the_certificate_with_redundant_contacts_and_extreme_friction() {
    for seed in 0..40 {
        for friction in [0.0, 0.3, 1.0] {
            let problem = random(Law::Coulomb, 3, 1 + seed as usize % 4, 6, 10.0, friction, seed);
            certified(&problem, &ProjectedGaussSeidel::default());
        }
    }
}

#[test]
fn sweeps_solve_stewart_trinkle_at_spatial_contacts_as_the_certificate_demands() {
    for seed in 0..40 {
        for (friction, directions) in [(0.0, 8), (0.3, 3), (0.3, 8), (1.0, 4)] {
            let problem = random(Law::PolyhedralCoulomb { directions }, 3, 1 + seed as usize % 4, 6, 10.0, friction, seed);
            let sweeps = certified(&problem, &ProjectedGaussSeidel::default());
            if problem.contacts() == 1 {
                // one contact with μ ‖A_nt‖ < A_nn has one answer
                agree(&problem, &sweeps, &certified(&problem, &LemkePivoting));
            }
        }
    }
}

#[test]
fn one_contact_is_solved_to_rounding_whatever_the_friction_and_the_masses() {
    for seed in 0..100 {
        for (law, rows) in [
            (Law::Coulomb, 2),
            (Law::Coulomb, 3),
            (Law::PolyhedralCoulomb { directions: 8 }, 3),
            (Law::Associated, 2),
            (Law::Associated, 3),
        ] {
            for friction in [1e-6, 0.5, 1.0, 100.0] {
                // μ r_n − Σβ is judged against the size of r, but carries the rounding of μ r_n
                if law.directions().is_some() && friction > 1.0 {
                    continue;
                }
                for ratio in [1.0, 1e3] {
                    let problem = random(law, rows, 1, 6, ratio, friction, seed);
                    let solution = ProjectedGaussSeidel::default().solve(&problem, None).unwrap();
                    // the second sweep takes the rounding of y out, the third that of friction where μ is a millionth
                    // where μ is a millionth the direction of friction is known to ε/μ only, which no sweep improves
                    assert!(friction < 0.5 || solution.iterations <= 3, "{} took {} sweeps", problem.name(), solution.iterations);
                    let found = residuals(&problem, &solution).unwrap();
                    assert!(found.is_solution(crate::tolerance::certificate::CERTIFY), "{law:?} {friction} {ratio} {seed}: {found:?}");
                }
            }
        }
    }
}

#[cfg(feature = "clarabel")]
#[test]
fn mass_ratios_and_large_friction_are_solved_by_sweeps_and_by_the_interior_point() {
    for seed in 0..10 {
        for (ratio, friction) in [(1e6, 0.5), (1.0, 20.0), (1e4, 5.0)] {
            let problem = random(Law::Associated, 3, 2, 8, ratio, friction, seed);
            let sweeps = certified(&problem, &ProjectedGaussSeidel::default());
            let interior = certified(&problem, &ClarabelPolished);
            agree(&problem, &sweeps, &interior);
        }
    }
}

#[cfg(feature = "clarabel")]
#[test]
fn polishing_is_judged_and_carries_interior_point_answers_to_the_rounding_floor() {
    let mut improved = 0;
    for seed in 0..20 {
        let problem = random(Law::Associated, 3, 2, 8, 10.0, 0.5, seed);
        let polished = ClarabelPolished.solve_judged(&problem).unwrap();
        let relative = |found: &crate::certificate::Residuals| found.natural_map / found.natural_map_scale.max(f64::MIN_POSITIVE);
        assert!(relative(&polished.after) <= 2.0 * tolerance::STOP, "{polished:?}");
        improved += usize::from(polished.improved() && relative(&polished.before) > tolerance::STOP);
        let returned = residuals(&problem, &polished.solution).unwrap().natural_map;
        assert_eq!(returned, polished.before.natural_map.min(polished.after.natural_map));
    }
    assert!(improved > 0, "the raw answers are above the floor, or there is nothing to polish");
}

#[cfg(feature = "clarabel")]
#[test]
fn an_unbounded_program_has_no_answer_and_says_so() {
    // nothing resists the impulse along its own direction: W = 0 on that row
    let problem = random(Law::Frictionless, 1, 2, 3, 1.0, 0.0, 1);
    let problem = with(problem, DMatrix::from_row_slice(2, 2, &[0.0, 0.0, 0.0, 1.0]), DVector::from_vec(vec![-1.0, -1.0]));
    for solver in [&ClarabelPolished as &dyn ContactSolver, &ProjectedGaussSeidel::default()] {
        assert!(solver.solve(&problem, None).unwrap_err().to_string().contains(solver.name()));
    }
}

#[test]
fn four_legs_carry_a_table_in_more_ways_than_one_but_move_it_in_one() {
    // normals only, unit mass table: the rows are dependent, W has rank 3
    let jacobian = DMatrix::from_row_slice(4, 3, &[1., 1., 1., 1., 1., -1., 1., -1., 1., 1., -1., -1.]);
    let problem = random(Law::Frictionless, 1, 4, 3, 1.0, 0.0, 0);
    let problem = with(problem, &jacobian * jacobian.transpose(), DVector::from_element(4, -1.0));
    let cold = certified(&problem, &ProjectedGaussSeidel::default());
    let start = DVector::from_vec(vec![0.25, 0.0, 0.0, 0.25]);
    let warm = ProjectedGaussSeidel::default().solve(&problem, Some(&start)).unwrap();
    assert!((&cold.impulse - &warm.impulse).norm() > 0.1);
    agree(&problem, &cold, &warm);
}

#[cfg(feature = "clarabel")]
#[test]
fn edges_of_a_polyhedral_cone_are_frictionless_contacts() {
    for directions in [4, 8] {
        let problem = random(Law::PolyhedralAssociated { directions }, 3, 2, 6, 1.0, 0.5, 7);
        let interior = certified(&problem, &ClarabelPolished);
        let pivoted = certified(&problem, &LemkePivoting);
        agree(&problem, &interior, &pivoted);
    }
}

#[cfg(feature = "clarabel")]
#[test]
fn a_slightly_asymmetric_delassus_operator_is_solved_as_given_and_a_clearly_asymmetric_one_refused_by_name() {
    let symmetric = random(Law::Associated, 3, 2, 6, 1.0, 0.5, 3);
    let asymmetric = |change: f64| {
        let mut delassus = symmetric.dense().clone();
        delassus[(0, 3)] += change;
        symmetric.clone().into_builder().delassus(delassus).build().unwrap()
    };
    let solvers = [&AcceleratedProjectedGradient::default() as &dyn ContactSolver, &ClarabelPolished, &BarzilaiBorwein::default()];
    for solver in solvers {
        certified(&asymmetric(1e-4), solver);
        let message = solver.solve(&asymmetric(0.5), None).unwrap_err().to_string();
        assert!(message.contains(solver.name()) && message.contains("symmetric"), "{message}");
    }
    for change in [1e-4, 0.5] {
        certified(&asymmetric(change), &AlternatingDirections::default());
        certified(&asymmetric(change), &ProjectedGaussSeidel::default());
    }
}

#[cfg(feature = "clarabel")]
#[test]
fn laws_outside_the_scope_are_refused_by_name() {
    let coulomb = random(Law::Coulomb, 3, 2, 6, 1.0, 0.5, 3);
    assert!(AcceleratedProjectedGradient::default().solve(&coulomb, None).is_err());
    assert!(ClarabelPolished.solve(&coulomb, None).is_err());
    assert!(BarzilaiBorwein::default().solve(&coulomb, None).unwrap_err().to_string().contains("`coulomb`"));
    let polyhedral = random(Law::PolyhedralAssociated { directions: 4 }, 3, 2, 6, 1.0, 0.5, 3);
    for solver in
        [&ProjectedGaussSeidel::default() as &dyn ContactSolver, &ProjectedOverRelaxation::default(), &AlternatingDirections::default()]
    {
        assert!(solver.solve(&polyhedral, None).unwrap_err().to_string().contains("`polyhedral-associated`"));
    }
    certified(&polyhedral, &Auto);
    certified(&coulomb, &Auto);
}

#[test]
fn compliance_softens_a_singular_problem_into_one_with_a_single_answer() {
    let problem = softened(random(Law::Associated, 3, 4, 4, 1.0, 0.5, 11));
    let sweeps = certified(&problem, &ProjectedGaussSeidel::default());
    let gradient = certified(&problem, &AcceleratedProjectedGradient::default());
    // W + R ≥ 0.1: the impulses themselves agree
    let rho = crate::certificate::natural_map::scales(&problem).into_iter().fold(f64::INFINITY, f64::min);
    let error = 2.0 * tolerance::STOP * 12.0 * sweeps.impulse.norm().max(problem.free_velocity().norm());
    assert!((&sweeps.impulse - &gradient.impulse).norm() <= error / (0.1 * rho.min(1.0)) * (1.0 + problem.dense().norm()));
}

#[test]
fn the_proven_rates_hold_at_every_iteration() {
    // masses in a row, each pressed against the next: an ill-conditioned convex problem
    let n = 40;
    let delassus = DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    });
    let free_velocity = DVector::from_fn(n, |k, _| if k == 0 { -1.0 } else { 0.0 });
    let problem = with(random(Law::Frictionless, 1, n, 1, 1.0, 0.0, 0), delassus, free_velocity);
    let exact = LemkePivoting.solve(&problem, None).unwrap().impulse;
    let (best, radius) = (objective(&problem, &exact), exact.norm());
    let bound_l = largest_eigenvalue_bound(problem.dense());
    for (momentum, bound) in [
        (Momentum::Plain, (|l, r, k| l * r * r / (2.0 * k)) as fn(f64, f64, f64) -> f64),
        (Momentum::Nesterov, |l, r, k| 2.0 * l * r * r / (k + 1.0).powi(2)),
    ] {
        let solver = AcceleratedProjectedGradient { momentum, iterations: 300, ..Default::default() };
        let mut largest: f64 = 0.0;
        let rounding = moreau_exact::tolerance::rounding(n, exact.norm() * 4.0 * exact.norm());
        solver
            .solve_observed(&problem, None, |k, impulse| {
                let gap = objective(&problem, impulse) - best;
                largest = largest.max((gap - rounding) / bound(bound_l, radius, k as f64));
            })
            .unwrap();
        assert!(largest <= 1.0, "{momentum:?}: {largest}");
        assert!(largest > 0.0, "{momentum:?} starts away from the optimum");
    }
}

#[test]
fn an_asymmetric_delassus_operator_is_solved_as_given_by_sweeps() {
    // A skew part on the diagonal blocks and between them; xᵀWx stays that of the identity.
    for seed in 0..20 {
        let mut numbers = Numbers(100 + seed);
        let skew = DMatrix::from_fn(6, 6, |_, _| 0.4 * numbers.next());
        let free_velocity = DVector::from_fn(6, |k, _| if k % 3 == 0 { -1.0 } else { numbers.next() });
        let delassus = DMatrix::identity(6, 6) + &skew - skew.transpose();
        let problem = with(random(Law::Coulomb, 3, 2, 6, 1.0, 0.5, seed), delassus, free_velocity);
        certified(&problem, &ProjectedGaussSeidel::default());
    }
}

#[test]
fn the_plain_method_is_the_projected_gradient_and_restarts_beat_it_where_the_problem_is_ill_conditioned() {
    let problem = random(Law::Frictionless, 1, 2, 2, 1.0, 0.0, 0);
    let problem = with(problem, DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, 1.0 / 1024.0]), DVector::from_element(2, -1.0));
    // L = 1: the first entry is found at once, the error of the second shrinks by 1 − 1/1024 in every step, its value is (1 −
    // (1023/1024)ᵏ)·1024.
    let plain = AcceleratedProjectedGradient { momentum: Momentum::Plain, ..Default::default() };
    let mut iterates = Vec::new();
    let steps = plain.solve_observed(&problem, None, |_, impulse| iterates.push(impulse.clone())).unwrap().iterations;
    let scale = largest_eigenvalue_bound(problem.dense());
    for (k, impulse) in iterates.iter().take(10).enumerate() {
        let expected = 1024.0 * (1.0 - (1.0 - 1.0 / (1024.0 * scale)).powi(k as i32 + 1));
        assert!((impulse[1] - expected).abs() <= moreau_exact::tolerance::rounding(4 * (k + 1), 16.0), "step {k}: {impulse}");
    }
    // κ = 1024: momentum needs of the order of √κ = 32 times fewer steps; a quarter of that is asked for.
    let restarted = AcceleratedProjectedGradient::default().solve(&problem, None).unwrap().iterations;
    assert!(8 * restarted <= steps, "{restarted} against {steps}");
}

#[test]
fn an_answer_that_leaves_the_numbers_is_no_answer() {
    // a mass of 1e320 kg arriving at 1 m/s needs the impulse 1e320 N·s
    let problem = random(Law::Frictionless, 1, 1, 1, 1.0, 0.0, 1);
    let problem = problem.into_builder().delassus(DMatrix::from_element(1, 1, 1e-320)).build().unwrap();
    let solvers: [&dyn ContactSolver; 2] = [&ProjectedGaussSeidel::default(), &LemkePivoting];
    for solver in solvers {
        let message = solver.solve(&problem, None).unwrap_err().to_string();
        assert!(message.contains(solver.name()), "{message}");
    }
}

#[test]
fn a_limit_of_iterations_is_kept() {
    let problem = random(Law::Coulomb, 3, 4, 6, 10.0, 0.5, 3);
    for name in ["pgs", "psor", "admm"] {
        let once = Solvers::own().with_iterations(name, Some(1)).unwrap().solve(&problem, None).unwrap();
        assert_eq!(once.iterations, 1, "{name}");
    }
}
