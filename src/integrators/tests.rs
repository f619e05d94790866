//! Every method against its definition, its amplification matrix and the bound of its step.

use super::stability::{Powers, invariants, powers};
use super::*;
use crate::closed_forms::spring_damper as bound;
use crate::scalar::{Dual, Rational, exact, ratio};
use crate::tolerance::{claims::integrators::BESIDE, mechanics};

const EXPLICIT: SemiImplicitEuler = SemiImplicitEuler { damping: Damping::Explicit };
const IMPLICIT: SemiImplicitEuler = SemiImplicitEuler { damping: Damping::Implicit };

fn theta(numerator: i64, denominator: i64) -> Theta {
    Theta { theta: ratio(numerator, denominator) }
}

/// D of a step with s on a spring with the damping ratio ζ.
fn matrix(method: &impl Method, damping_ratio: &Rational, s: &Rational) -> DMatrix<Rational> {
    method.jacobian(&SpringDamper::of_ratio(damping_ratio.clone()), &Phase::of_one(ratio(3, 7), ratio(-2, 5)), s)
}

/// q̈ = −q − q³ − ½ v, by hand.
struct Hardening;

impl System for Hardening {
    fn acceleration<T: Scalar>(&self, position: &DVector<T>, velocity: &DVector<T>) -> DVector<T> {
        position.map(|q| -(q.clone() + q.clone() * q.clone() * q)) - velocity * T::ratio(1, 2)
    }
}

#[test]
fn trace_and_determinant_are_those_of_the_derivations() {
    let (zeta, s) = (ratio(3, 10), ratio(7, 5));
    let one = ratio(1, 1);
    let (drag, square) = (ratio(2, 1) * &zeta * &s, &s * &s);
    let of = |method: &dyn Fn() -> DMatrix<Rational>| invariants(&method());
    let explicit = of(&|| matrix(&ExplicitEuler, &zeta, &s));
    assert_eq!(explicit, [ratio(2, 1) - &drag, &one - &drag + &square]);
    let semi = of(&|| matrix(&EXPLICIT, &zeta, &s));
    assert_eq!(semi, [ratio(2, 1) - &square - &drag, &one - &drag]);
    let damped = &one + &drag;
    let implicit = of(&|| matrix(&IMPLICIT, &zeta, &s));
    assert_eq!(implicit, [(&one + &damped - &square) / &damped, &one / &damped]);
    let backward = of(&|| matrix(&theta(1, 1), &zeta, &s));
    let whole = &one + &drag + &square;
    assert_eq!(backward, [(ratio(2, 1) + &drag) / &whole, &one / &whole]);
    assert_eq!(matrix(&theta(0, 1), &zeta, &s), matrix(&ExplicitEuler, &zeta, &s));
}

#[test]
fn runge_kutta_is_its_stability_polynomial() {
    let s = ratio(7, 5);
    let a = DMatrix::from_row_slice(2, 2, &[ratio(0, 1), ratio(1, 1), ratio(-1, 1), ratio(-3, 5)]) * s.clone();
    let identity = DMatrix::identity(2, 2);
    let horner = [4, 3, 2, 1].iter().fold(identity.clone(), |sum: DMatrix<Rational>, k| &identity + &a * sum * ratio(1, *k));
    assert_eq!(matrix(&RungeKutta, &ratio(3, 10), &s), horner);
}

#[test]
fn implicit_damping_solves_its_own_equation() {
    let (h, now) = (ratio(1, 3), Phase::of_one(ratio(1, 2), ratio(-3, 1)));
    let next = IMPLICIT.step(&Hardening, &now, &h);
    let force = Hardening.acceleration(&now.position, &next.velocity);
    assert_eq!(&next.velocity - &now.velocity, force * h.clone());
    assert_eq!(&next.position - &now.position, &next.velocity * h);
}

/// On both sides of its bound the step matrix must be stable and unstable, decided in rationals.
#[track_caller]
fn changes_at(method: &impl Method, damping_ratio: f64, bound: f64, below: Powers) {
    let zeta = exact(damping_ratio);
    let at = |factor: f64| powers(&matrix(method, &zeta, &exact(bound * factor)));
    assert_eq!(at(1.0 - BESIDE), below, "ζ = {damping_ratio}, below {bound}");
    assert_eq!(at(1.0 + BESIDE), Powers::GrowExponentially, "ζ = {damping_ratio}, above {bound}");
}

#[test]
fn every_bound_has_its_two_sides() {
    for zeta in [0.05, 0.1, 0.5, 1.0, 1.25, 2.0] {
        changes_at(&ExplicitEuler, zeta, bound::theta(0.0, zeta), Powers::Decay);
        changes_at(&theta(2, 5), zeta, bound::theta(0.4, zeta), Powers::Decay);
        changes_at(&EXPLICIT, zeta, bound::semi_implicit(zeta), Powers::Decay);
        changes_at(&IMPLICIT, zeta, bound::semi_implicit_with_implicit_damping(zeta), Powers::Decay);
    }
    changes_at(&EXPLICIT, 0.0, 2.0, Powers::Bounded);
    changes_at(&IMPLICIT, 0.0, 2.0, Powers::Bounded);
    changes_at(&RungeKutta, 0.0, bound::runge_kutta_undamped(), Powers::Decay);
    changes_at(&RungeKutta, 1.0, bound::runge_kutta_critical(), Powers::Decay);
}

#[test]
fn theta_from_one_half_on_has_no_bound() {
    for (n, d) in [(1, 2), (3, 4), (1, 1)] {
        for zeta in [ratio(1, 1000), ratio(1, 1), ratio(50, 1)] {
            for s in [ratio(1, 1000), ratio(1, 1), ratio(1_000_000, 1)] {
                assert_eq!(powers(&matrix(&theta(n, d), &zeta, &s)), Powers::Decay);
            }
        }
    }
}

#[test]
fn the_jacobian_of_a_nonlinear_step_is_that_of_central_differences() {
    let (now, h) = (Phase::of_one(0.7, -1.1), 0.2);
    let d = mechanics::DIFFERENCE_STEP;
    let compare = |jacobian: DMatrix<f64>, step: &dyn Fn(&Phase<f64>) -> Phase<f64>| {
        for j in 0..2 {
            let shifted = |by: f64| {
                let mut x = now.stacked();
                x[j] += by;
                step(&Phase::from_stacked(&x)).stacked()
            };
            let difference = (shifted(d) - shifted(-d)) / (2.0 * d);
            assert!((difference - jacobian.column(j)).amax() <= mechanics::central_difference(1.0, 4.0));
        }
    };
    compare(EXPLICIT.jacobian(&Hardening, &now, &h), &|x| EXPLICIT.step(&Hardening, x, &h));
    compare(IMPLICIT.jacobian(&Hardening, &now, &h), &|x| IMPLICIT.step(&Hardening, x, &h));
    compare(RungeKutta.jacobian(&Hardening, &now, &h), &|x| RungeKutta.step(&Hardening, x, &h));
    compare(theta(1, 1).jacobian(&Hardening, &now, &h), &|x| theta(1, 1).step(&Hardening, x, &h));
}

#[test]
fn constants_have_no_slope_through_a_step() {
    let constant = |x: i64| Dual::constant(ratio(x, 2));
    let next = EXPLICIT.step(&Hardening, &Phase::of_one(constant(1), constant(-3)), &constant(1));
    assert!(next.stacked().iter().all(|entry| entry.slope == ratio(0, 1)));
}
