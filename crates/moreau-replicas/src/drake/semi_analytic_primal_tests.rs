//! The projection against its three printed cases, the solver against others and against what it must refuse.

use super::*;
use moreau_contact::certificate::residuals;
use moreau_contact::solvers::{ClarabelPolished, ProjectedGaussSeidel, largest_eigenvalue_bound};
use moreau_contact::tolerance::solvers as tolerance;
use nalgebra::dvector;

/// `contacts` contacts on five velocities with R = (r_n, r_t, r_t); the velocities come from a fixed list of numbers.
fn compliant(contacts: usize, compliance: [f64; 2], friction: f64, seed: u64) -> ContactProblem {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / 2f64.powi(52) - 1.0
    };
    let jacobian = DMatrix::from_fn(3 * contacts, 5, |_, _| next());
    let mass = DMatrix::from_diagonal(&DVector::from_fn(5, |_, _| 1.5 + next()));
    let [normal, tangential] = compliance;
    ContactProblem::new(
        moreau_contact::contact::delassus::delassus(&mass, &jacobian).unwrap(),
        DVector::from_fn(3 * contacts, |_, _| next()),
    )
    .name(format!("compliant {seed}"))
    .law(Law::Associated)
    .friction(vec![friction; contacts])
    .shift(DVector::from_fn(3 * contacts, |row, _| if row % 3 == 0 { next() - 0.5 } else { 0.0 }))
    .compliance(Compliance {
        coordinates: Coordinates::Contact,
        diagonal: DVector::from_fn(3 * contacts, |row, _| if row % 3 == 0 { normal } else { tangential }),
    })
    .dynamics(Dynamics { mass, jacobian })
    .build()
    .unwrap()
}

#[test]
fn the_projection_has_the_three_printed_cases() {
    let problem = compliant(1, [0.25, 0.0625], 0.5, 1).into_builder().shift(dvector![0.0, 0.0, 0.0]).build().unwrap();
    let projection = Projection::of(&problem).unwrap();
    let [soft, hat] = [0.5f64.powi(2) * 0.25, 0.5 * 0.25]; // μ̃² = μ² R_t/R_n, μ̂ = μ R_t/R_n
    let check = |target: [f64; 3], expected: [f64; 3]| {
        let velocity = [-0.25 * target[0], -0.0625 * target[1], -0.0625 * target[2]];
        let found = projection.impulse(0, &velocity);
        assert!((found - DVector::from_row_slice(&expected)).amax() <= rounding(16, 8.0), "ŷ = {target:?}");
    };
    check([4.0, 1.2, -1.6], [4.0, 1.2, -1.6]);
    check([-1.0, 1.2, -1.6], [0.0; 3]);
    let normal = (1.0 + hat * 5.0) / (1.0 + soft);
    check([1.0, 3.0, -4.0], [normal, 0.5 * normal * 0.6, -0.5 * normal * 0.8]);
    // the Euclidean projection would give another r_n: (1 + 0.5·5)/1.25
    assert!((normal - 3.5 / 1.25).abs() > 1.0);
}

#[test]
fn sweeps_the_interior_point_and_newton_agree_on_velocities_and_impulses() {
    for seed in 0..40 {
        for compliance in [[1.0, 1.0], [1e-2, 1e-3], [1e-4, 0.3]] {
            let problem = compliant(1 + seed as usize % 4, compliance, [0.0, 0.3, 1.0][seed as usize % 3], seed);
            let newton = SemiAnalyticPrimal.solve(&problem, None).unwrap();
            let own = residuals(&problem, &newton).unwrap();
            assert!(own.is_solution(1e-9), "{}: {own:?} after {}", problem.name(), newton.iterations);
            let sweeps = ProjectedGaussSeidel::default().solve(&problem, None).unwrap();
            for other in [sweeps, ClarabelPolished.solve(&problem, None).unwrap()] {
                let residual = own.natural_map + residuals(&problem, &other).unwrap().natural_map;
                let impulses = (&newton.impulse - &other.impulse).norm() + residual;
                let rho = moreau_contact::certificate::natural_map::scales(&problem).into_iter().fold(f64::INFINITY, f64::min);
                let norm = largest_eigenvalue_bound(&problem.law_delassus().unwrap());
                let bound = tolerance::agreement(norm, residual, impulses, rho) + rounding(problem.rows(), norm * newton.impulse.norm());
                let difference = (problem.law_velocity(&newton.impulse) - problem.law_velocity(&other.impulse)).norm();
                assert!(difference <= bound, "{} on {}: {difference:e} > {bound:e}", other.solver, problem.name());
            }
        }
    }
}

#[test]
fn newton_needs_few_steps_where_the_gradient_is_far_from_linear() {
    let steps = |seed| SemiAnalyticPrimal.solve(&compliant(4, [1e-4, 1e-5], 0.7, seed), None).unwrap().iterations;
    assert!((0..20).all(|seed| steps(seed) <= 40));
}

#[test]
fn without_mass_and_jacobian_the_answer_is_the_same() {
    for seed in 0..10 {
        let known = compliant(2, [0.1, 0.01], 0.5, seed);
        let bare = known.clone().into_builder().dynamics(None).build().unwrap();
        let [one, other] = [&known, &bare].map(|problem| SemiAnalyticPrimal.solve(problem, None).unwrap());
        // both gradients end below STOP·‖impulse‖; R ≥ 1/100 bounds what a velocity error does to an impulse
        let bound = 100.0 * 4.0 * tolerance::STOP * (1.0 + one.impulse.norm()) * (1.0 + known.dense().norm());
        assert!((one.impulse - other.impulse).norm() <= bound);
    }
}

#[test]
fn what_is_outside_its_scope_is_refused_by_name() {
    let soft = compliant(1, [0.1, 0.01], 0.5, 3);
    let hard = soft.clone().into_builder().compliance(None).build().unwrap();
    let coulomb = soft.clone().into_builder().law(Law::Coulomb).build().unwrap();
    let softened = |row: usize, entry: f64| {
        let mut compliance = soft.compliance().unwrap().clone();
        compliance.diagonal[row] = entry;
        soft.clone().into_builder().compliance(compliance).build().unwrap()
    };
    let (uneven, zero) = (softened(2, 0.02), softened(1, 0.0));
    for problem in [hard, coulomb, uneven, zero] {
        assert!(SemiAnalyticPrimal.solve(&problem, None).unwrap_err().to_string().contains("sap"));
    }
    assert!(SemiAnalyticPrimal.solve(&soft, None).is_ok());
}
