//! Every method against its definition, its amplification matrix and the bound of its step.

use super::impact_flow::{ImpactFlow, Tangent};
use super::stability::{Powers, invariants, powers};
use super::symplectic::defect;
use super::variational::{Guess, InPotential, ScalarField, Variational, Verlet};
use super::*;
use crate::tolerance::integrators::{BESIDE, VARIATIONAL_STEP};
use crate::tolerance::mechanics;
use moreau_exact::scalar::{Dual, Rational, exact, ratio};
use moreau_forms::spring_damper as bound;

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

impl SmoothSystem for Hardening {
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

/// V = 3y + ½x² + x y², φ = y + x²/4.
#[derive(Clone, Copy)]
enum Scene {
    Potential,
    Floor,
}

impl ScalarField for Scene {
    fn value<T: Scalar>(&self, position: &DVector<T>) -> T {
        let (x, y) = (position[0].clone(), position[1].clone());
        match self {
            Scene::Potential => T::ratio(3, 1) * y.clone() + T::ratio(1, 2) * x.clone() * x.clone() + x * y.clone() * y,
            Scene::Floor => y + T::ratio(1, 4) * x.clone() * x,
        }
    }
}

#[test]
fn verlet_is_symplectic_and_reversible_in_rationals() {
    let (h, now) = (
        ratio(1, 5),
        Phase { position: DVector::from_vec(vec![ratio(1, 2), ratio(1, 3)]), velocity: DVector::from_vec(vec![ratio(-1, 1), ratio(2, 1)]) },
    );
    let system = InPotential(Scene::Potential);
    let next = Verlet.step(&system, &now, &h);
    let back = Verlet.step(&system, &Phase { velocity: -&next.velocity, ..next }, &h);
    assert_eq!(Phase { velocity: -back.velocity, ..back }, now);
    let left = defect(&Verlet.jacobian(&system, &now, &h), &DMatrix::identity(2, 2));
    assert!(left.iter().all(|entry| *entry == ratio(0, 1)));
}

#[test]
fn a_variational_impact_that_newton_finds_is_symplectic_to_rounding() {
    let integrator = Variational { potential: Scene::Potential, gap: Scene::Floor };
    let start = [0.3, 0.2, 0.7, -1.5];
    let at = |x: &DVector<Dual<f64>>| {
        let guess = Guess { time: Dual::constant(0.12), jump: Dual::constant(3.0), newton_steps: 8 };
        integrator.step_with_impact(&Phase::from_stacked(x), &Dual::constant(0.3), &guess).stacked()
    };
    let d = jacobian::jacobian(&DVector::from_row_slice(&start), at);
    assert!(defect(&d, &DMatrix::identity(2, 2)).amax() <= VARIATIONAL_STEP);
    let now = Phase::from_stacked(&DVector::from_row_slice(&start));
    let after = integrator.step_with_impact(&now, &0.3, &Guess { time: 0.12, jump: 3.0, newton_steps: 8 });
    assert!(Scene::Floor.value(&after.position) > 0.0 && after.velocity[1] > 0.0);
}

#[test]
fn the_flow_across_an_impact_is_that_of_a_dropped_ball() {
    // from 5 m with g = 10 m/s² in 1 s at 10 m/s; with e = ½ after another half second 5/4 m high and at rest
    let one = |n: i64| DVector::from_element(1, ratio(n, 1));
    let ball =
        ImpactFlow { gap: Height, acceleration: one(-10), restitution: ratio(1, 2), tangent: Tangent::Frictionless, friction: ratio(0, 1) };
    let start = Phase { position: one(5), velocity: one(0) };
    assert_eq!(ball.gap_at(&start, &ratio(1, 1)), ratio(0, 1));
    assert_eq!(ball.map(&start, &ratio(1, 1), &ratio(3, 2)), Phase::of_one(ratio(5, 4), ratio(0, 1)));
}

/// φ = q.
struct Height;

impl ScalarField for Height {
    fn value<T: Scalar>(&self, position: &DVector<T>) -> T {
        position[0].clone()
    }
}

#[test]
fn friction_opposes_the_slip_whatever_its_direction() {
    for slip in [2, -2] {
        let flow = ImpactFlow {
            gap: Scene::Floor,
            acceleration: DVector::from_vec(vec![ratio(0, 1), ratio(0, 1)]),
            restitution: ratio(0, 1),
            tangent: Tangent::Sliding,
            friction: ratio(1, 2),
        };
        let start = Phase {
            position: DVector::from_vec(vec![ratio(-slip, 1), ratio(1, 1)]),
            velocity: DVector::from_vec(vec![ratio(slip, 1), ratio(-1, 1)]),
        };
        let after = flow.map(&start, &ratio(1, 1), &ratio(1, 1));
        assert_eq!(after.velocity, DVector::from_vec(vec![ratio(slip, 1) * ratio(3, 4), ratio(0, 1)]));
    }
}
