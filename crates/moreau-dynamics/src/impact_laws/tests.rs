//! The laws against closed forms, exactly, and against each other.

use super::*;
use moreau_contact::contact::delassus::delassus;
use moreau_contact::problem::{PlanarProblem, Response};
use moreau_exact::scalar::{Rational, Scalar, ratio};
use moreau_forms::double_pendulum_impact::DoublePendulum;
use moreau_forms::newtons_cradle;
use moreau_forms::rough_impact::{Regime, RoughImpact};
use nalgebra::{DMatrix, DVector};

fn numbers(entries: &[i64]) -> Vec<Rational> {
    entries.iter().map(|&x| ratio(x, 1)).collect()
}

fn impact(delassus: &[i64], before: &[i64]) -> PlanarProblem<Rational> {
    let size = before.len();
    PlanarProblem::new(DMatrix::from_row_slice(size, size, &numbers(delassus)), DVector::from_vec(numbers(before)))
}

fn planar(data: &RoughImpact<Rational>) -> PlanarProblem<Rational> {
    let [nn, nt, tt] = data.delassus.clone();
    let before = DVector::from_vec(vec![-data.approach.clone(), data.slide.clone()]);
    PlanarProblem::new(DMatrix::from_row_slice(2, 2, &[nn, nt.clone(), nt, tt]), before)
}

/// All planar impacts of a small grid of positive definite W, velocities and coefficients.
fn grid() -> Vec<RoughImpact<Rational>> {
    let mut all = Vec::new();
    for [nn, nt, tt] in [[2, 0, 3], [5, -3, 5], [5, 3, 5], [2, 4, 9], [2, -4, 9], [9, 4, 2], [9, -4, 2], [30, 11, 5]] {
        for [approach, slide] in [[1, 1], [1, -1], [5, 3], [1, 20], [20, -1]] {
            for mu in [0, 1, 2, 3, 7, 20] {
                let delassus = [nn, nt, tt].map(|x| ratio(x, 2));
                all.push(RoughImpact { delassus, approach: ratio(approach, 1), slide: ratio(slide, 1), friction: ratio(mu, 4) });
            }
        }
    }
    all
}

fn path(data: &RoughImpact<Rational>) -> Path<Rational> {
    Path::new(planar(data), &data.friction).expect("approaches")
}

use super::routh::Path;

#[test]
fn newton_and_poisson_end_on_the_path_where_the_closed_forms_say() {
    for data in grid() {
        let path = path(&data);
        for e in [ratio(0, 1), ratio(1, 3), ratio(1, 1)] {
            let ends = [newton::along(&path, &e), poisson::along(&path, &e)].map(|end| end.expect("e in [0, 1]"));
            for (end, expected) in ends.iter().zip([data.newton(&e), data.poisson(&e)]) {
                assert_eq!(end.impulse.as_slice(), expected, "{data:?}, e = {e}");
                assert_eq!(path.impact().energy_change(end), data.energy_change(&expected));
            }
            assert_eq!(ends[0].after[0], &e * &data.approach);
        }
    }
}

#[test]
fn every_regime_occurs_in_the_grid() {
    for regime in [Regime::Slides, Regime::Sticks, Regime::Reverses] {
        assert!(grid().iter().any(|data| data.regime() == regime));
    }
}

#[test]
fn stronge_ends_at_the_squared_speed_of_the_closed_form_and_at_the_work_it_prescribes() {
    let mut compared = 0;
    for data in grid() {
        let path = path(&data);
        for e in [ratio(0, 1), ratio(1, 3), ratio(1, 1)] {
            let end = stronge::end(&path, &e).expect("e in [0, 1]");
            if let Some(expected) = data.stronge_speed_squared(&e) {
                assert_eq!(end.speed_squared, expected, "{data:?}");
                compared += 1;
            }
        }
    }
    assert!(compared > 100);
}

#[test]
fn poisson_and_stronge_never_gain_energy_and_newton_does() {
    let mut gains = 0;
    for data in grid() {
        let path = path(&data);
        for e in [ratio(1, 2), ratio(1, 1)] {
            let change = |end: moreau_exact::Result<Response<Rational>>| path.impact().energy_change(&end.expect("e in [0, 1]"));
            assert!(change(poisson::along(&path, &e)) <= ratio(0, 1), "{data:?}");
            gains += usize::from(change(newton::along(&path, &e)) > ratio(0, 1));
            let work = &e * &e * stronge::compression_work(&path);
            assert!(stronge::compression_work(&path) <= work);
            assert!(path.friction_work(&ratio(0, 1), &ratio(100, 1)) <= ratio(0, 1));
        }
    }
    assert!(gains > 0);
}

#[test]
fn work_along_the_path_is_the_change_of_energy() {
    for data in grid() {
        let (path, zero) = (path(&data), ratio(0, 1));
        for p in [ratio(1, 7), ratio(3, 1), ratio(40, 1)] {
            let outcome = path.outcome(&p);
            let work = path.normal_work(&zero, &p) + path.friction_work(&zero, &p);
            assert_eq!(work, path.impact().energy_change(&outcome));
            let state = path.state(&p);
            assert_eq!(outcome.after.as_slice(), [state.normal, state.tangential]);
            assert!(state.friction_impulse.magnitude() <= &data.friction * &p);
        }
    }
}

/// U after `steps` increments of p, each of which obeys Coulomb's law at its end: q changes so that U_t vanishes, within ±μ dp.
fn increments(data: &RoughImpact<Rational>, p: &Rational, steps: i64) -> DVector<Rational> {
    let (impact, dp) = (planar(data), p / ratio(steps, 1));
    let bound = &data.friction * &dp;
    let mut impulse = DVector::from_element(2, ratio(0, 1));
    for _ in 0..steps {
        impulse[0] += &dp;
        let free = impact.response(impulse.clone()).after[1].clone();
        let wanted = -free / &data.delassus[2];
        impulse[1] += wanted.clamp(-bound.clone(), bound.clone());
    }
    impact.response(impulse).after
}

#[test]
fn increments_of_the_impulse_follow_the_path_to_first_order() {
    let steps = 40;
    for data in grid() {
        let (path, p) = (path(&data), data.newton(&ratio(1, 1))[0].clone());
        let end = path.outcome(&p).after;
        let difference = increments(&data, &p, steps) - end;
        // only the increment that contains the stop is not exact: it misplaces at most 2 μ dp of friction impulse
        let misplaced = ratio(2, steps) * &data.friction * &p;
        assert!(difference[0].magnitude() <= &misplaced * data.delassus[1].magnitude(), "{data:?}");
        assert!(difference[1].magnitude() <= &misplaced * &data.delassus[2], "{data:?}");
    }
}

#[test]
fn normal_only_moreau_is_newton_on_the_path_unless_the_slip_turns_round() {
    let mut different = 0;
    for data in grid() {
        let impact = planar(&data);
        for e in [ratio(0, 1), ratio(1, 1)] {
            let along = newton::along(&path(&data), &e).expect("e in [0, 1]");
            let step = moreau::normal_only(&impact, std::slice::from_ref(&data.friction), &e).expect("solvable");
            if data.regime() == Regime::Reverses && data.stop().expect("reverses") < along.impulse[0] {
                different += usize::from(step != along);
            } else {
                assert_eq!(step, along, "{data:?}, e = {e}");
            }
        }
    }
    assert!(different > 0);
}

#[test]
fn full_vector_moreau_and_fremond_never_gain_energy() {
    for data in grid() {
        let (impact, mu) = (planar(&data), std::slice::from_ref(&data.friction));
        for e in [ratio(0, 1), ratio(1, 2), ratio(1, 1)] {
            let full = moreau::full_vector(&impact, mu, &e).expect("solvable");
            assert!(impact.energy_change(&full) <= ratio(0, 1), "{data:?}");
            let fremond = fremond::planar(&impact, mu, &e).expect("solvable");
            let mean = (&fremond.after[1] + &impact.velocity[1]) * ratio(1, 2);
            let normal = ratio(1, 2) * (&e - ratio(1, 1)) * &fremond.impulse[0] * &data.approach;
            let friction = -(&data.friction * &fremond.impulse[0] * mean.magnitude());
            assert_eq!(impact.energy_change(&fremond), normal + friction, "{data:?}");
        }
    }
}

#[test]
fn two_problems_and_the_path_agree_for_poisson_unless_the_slip_stops_to_turn_round() {
    let mut different = 0;
    for data in grid() {
        let e = ratio(1, 2);
        let (mu, pair) = (std::slice::from_ref(&data.friction), std::slice::from_ref(&e));
        let phases = poisson::two_frictional_problems(&planar(&data), mu, pair).expect("solvable");
        let along = poisson::along(&path(&data), &e).expect("e in [0, 1]");
        if data.regime() == Regime::Reverses {
            different += usize::from(phases.end != along);
        } else {
            assert_eq!(phases.end, along, "{data:?}");
        }
    }
    assert!(different > 0);
}

#[test]
fn the_cradle_s_simultaneous_and_sequential_outcomes_are_the_closed_forms() {
    // equal balls of 1 kg, U = (v₂ − v₁, v₃ − v₂)
    let cradle = impact(&[2, -1, -1, 2], &[-1, 0]);
    let relative = |v: [Rational; 3]| vec![&v[1] - &v[0], &v[2] - &v[1]];
    for e in [ratio(0, 1), ratio(1, 2), ratio(1, 1)] {
        let pair = [e.clone(), e.clone()];
        let expected = relative(newtons_cradle::at_once(&e));
        let laws = [moreau::frictionless(&cradle, &pair), poisson::two_problems(&cradle, &pair).map(|phases| phases.end)];
        for outcome in laws {
            assert_eq!(outcome.expect("solvable").after.as_slice(), expected);
        }
    }
    let elastic = sequential::sequential(&cradle, &ratio(1, 1), &[0, 1]).expect("ends");
    assert_eq!(elastic.after.as_slice(), relative(newtons_cradle::after_two_impacts(&ratio(1, 1))));
    let half = sequential::sequential(&cradle, &ratio(1, 2), &[0, 1]).expect("ends");
    assert_eq!(half.after.as_slice(), relative([ratio(13, 64), ratio(15, 64), ratio(36, 64)]));
}

#[test]
fn frictionless_poisson_never_gains_energy_with_any_coefficients() {
    for delassus in [[2, -1, -1, 2], [2, 1, 1, 2], [1, 3, 3, 10], [5, -2, -2, 1]] {
        for before in [[-1, -1], [-1, 1], [-2, 1], [-1, 0], [1, -4]] {
            for [e1, e2] in [[0, 4], [4, 0], [4, 4], [1, 3]] {
                let (impact, pair) = (impact(&delassus, &before), [ratio(e1, 4), ratio(e2, 4)]);
                let phases = poisson::two_problems(&impact, &pair).expect("solvable");
                assert!(impact.energy_change(&phases.end) <= ratio(0, 1));
                let end = &phases.end;
                let surplus = &end.impulse - phases.compression.impulse.map_with_location(|i, _, p| p * (ratio(1, 1) + &pair[i]));
                assert!(end.after.iter().chain(surplus.iter()).all(|x| *x >= ratio(0, 1)));
                assert_eq!(end.after.dot(&surplus), ratio(0, 1));
            }
        }
    }
}

#[test]
fn the_projection_is_on_the_boundary_it_must_be_on_and_satisfies_its_variational_inequality() {
    for (delassus, before) in [([2, -1, -1, 2], [-2, 1]), ([2, 1, 1, 2], [-2, -1]), ([1, 3, 3, 10], [-1, -2])] {
        let impact = impact(&delassus, &before);
        let candidate = newton::together(&impact, &[ratio(1, 1), ratio(0, 1)]).expect("W is nonsingular").after;
        let projection = energy_projection::project(&impact, &candidate).expect("W is nonsingular");
        let energy = |u: &DVector<Rational>| energy_projection::energy(&impact, u).expect("W is nonsingular");
        let kept = energy(&projection.direction) * &projection.factor_squared;
        assert!(projection.factor_squared < ratio(1, 1) && kept == energy(&impact.velocity));
        assert!(projection.direction.iter().all(|u| *u >= ratio(0, 1)));
        // (U* − U_K)ᵀW⁻¹(V − U_K) ≤ 0 for all V ≥ 0: U_K is the projection on the cone
        let pull = moreau_exact::elimination::solve(&impact.delassus, &(&projection.direction - &candidate)).expect("nonsingular");
        assert!(pull.iter().all(|x| *x >= ratio(0, 1)) && pull.dot(&projection.direction) == ratio(0, 1));
    }
}

#[test]
fn the_double_pendulum_s_delassus_operator_is_that_of_its_mass_matrix() {
    let pendulum =
        DoublePendulum { mass: ratio(2, 1), length: ratio(3, 1), angles: [[ratio(3, 5), ratio(4, 5)], [ratio(5, 13), ratio(12, 13)]] };
    let coupling = ratio(18, 2) * ratio(63, 65);
    let mass = DMatrix::from_row_slice(2, 2, &[ratio(24, 1), coupling.clone(), coupling, ratio(6, 1)]);
    let jacobian = DMatrix::from_row_slice(2, 2, &pendulum.jacobian().concat());
    let w = delassus(&mass, &jacobian).expect("positive definite");
    assert_eq!(pendulum.delassus(), [w[(0, 0)].clone(), w[(0, 1)].clone(), w[(1, 1)].clone()]);
}

#[test]
fn nonsense_is_refused() {
    let one = impact(&[1, 0, 0, 1], &[-1, 1]);
    assert!(moreau::frictionless(&one, &[ratio(2, 1), ratio(0, 1)]).is_err());
    assert!(newton::together(&one, &[ratio(1, 1)]).is_err());
    assert!(newton::together(&impact(&[1, 1, 1, 1], &[-1, -1]), &[ratio(1, 1), ratio(0, 1)]).is_err());
    assert!(Path::new(impact(&[1, 0, 0, 1], &[1, 1]), &ratio(1, 2)).is_err());
    assert!(Path::new(impact(&[1, 1, 1, 1], &[-1, 1]), &ratio(1, 2)).is_err());
    assert!(Path::new(one.clone(), &ratio(-1, 2)).is_err());
    assert!(moreau::normal_only(&one, &[ratio(1, 1), ratio(1, 1)], &ratio(1, 1)).is_err());
    assert!(sequential::sequential(&one, &ratio(1, 1), &[2]).is_err());
}
