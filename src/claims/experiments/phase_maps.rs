//! Systems with rational steps on which symplecticity and impacts are decided exactly.

use super::spring_damper::SEMI_IMPLICIT;
use crate::checks::Finding;
use crate::integrators::impact_flow::{ImpactFlow, Tangent};
use crate::integrators::jacobian::jacobian;
use crate::integrators::variational::{Guess, InPotential, ScalarField, Variational, Verlet};
use crate::integrators::{Method, Phase, SmoothSystem};
use crate::scalar::{Dual, Rational, Scalar, ratio};
use nalgebra::{DMatrix, DVector};

/// A vector of ratios.
pub fn entries(ratios: &[(i64, i64)]) -> DVector<Rational> {
    DVector::from_iterator(ratios.len(), ratios.iter().map(|(n, d)| ratio(*n, *d)))
}

/// The mass matrix of n unit masses.
pub fn identity(n: usize) -> DMatrix<Rational> {
    DMatrix::identity(n, n)
}

/// M = (2, 1; 1, 3) in V = ½x² + x y² + 3y.
#[derive(Clone, Copy)]
pub struct Coupled;

impl Coupled {
    /// M.
    pub fn mass() -> DMatrix<Rational> {
        DMatrix::from_row_slice(2, 2, &[2, 1, 1, 3].map(|x| ratio(x, 1)))
    }
}

impl SmoothSystem for Coupled {
    fn acceleration<T: Scalar>(&self, position: &DVector<T>, _velocity: &DVector<T>) -> DVector<T> {
        let (x, y) = (position[0].clone(), position[1].clone());
        let force = [-(x.clone() + y.clone() * y.clone()), -(T::ratio(2, 1) * x * y + T::ratio(3, 1))];
        // M⁻¹ = (3, −1; −1, 2)/5
        let fifth = |a: i64, b: i64| T::ratio(a, 5) * force[0].clone() + T::ratio(b, 5) * force[1].clone();
        DVector::from_vec(vec![fifth(3, -1), fifth(-1, 2)])
    }
}

/// M = q² and no potential: q q̈ = −q̇².
pub struct MassOfPlace;

impl SmoothSystem for MassOfPlace {
    fn acceleration<T: Scalar>(&self, position: &DVector<T>, velocity: &DVector<T>) -> DVector<T> {
        let v = velocity[0].clone();
        DVector::from_element(1, -(v.clone() * v / position[0].clone()))
    }
}

/// A mass on a spring about the origin, k/m = 1, in polar coordinates: r̈ = r ω² − r, r ω̇ = −2 ṙ ω.
pub struct SpringInPolar;

impl SmoothSystem for SpringInPolar {
    fn acceleration<T: Scalar>(&self, position: &DVector<T>, velocity: &DVector<T>) -> DVector<T> {
        let (r, rate, turn) = (position[0].clone(), velocity[0].clone(), velocity[1].clone());
        let outwards = r.clone() * turn.clone() * turn.clone() - r.clone();
        DVector::from_vec(vec![outwards, -(T::ratio(2, 1) * rate * turn / r)])
    }
}

/// A step of semi-implicit Euler; if it ends below y = 0, its mirror image in the wall, in the metric of M.
///
/// Q = I − 2 M⁻¹n nᵀ/(nᵀM⁻¹n) with n = (0, 1): Q = (1, 1; 0, −1), and QᵀMQ = M.
pub fn mirror_step<T: Scalar>(now: &Phase<T>, h: &T) -> Phase<T> {
    let free = SEMI_IMPLICIT.step(&Coupled, now, h);
    if free.position[1] >= T::zero() {
        return free;
    }
    let mirror = |x: &DVector<T>| DVector::from_vec(vec![x[0].clone() + x[1].clone(), -x[1].clone()]);
    Phase { position: mirror(&free.position), velocity: mirror(&free.velocity) }
}

/// A step of semi-implicit Euler; if it ends below y = 0, it is put back on the wall.
pub fn projected_step<T: Scalar>(now: &Phase<T>, h: &T) -> Phase<T> {
    let mut free = SEMI_IMPLICIT.step(&Coupled, now, h);
    if free.position[1] < T::zero() {
        free.position[1] = T::zero();
    }
    free
}

/// V = 3y + ½x² + x y².
#[derive(Clone, Copy)]
pub struct Bowl;

/// φ = y + x²/4.
#[derive(Clone, Copy)]
pub struct CurvedFloor;

impl Bowl {
    /// The floor that goes with it.
    pub fn wall() -> CurvedFloor {
        CurvedFloor
    }
}

impl ScalarField for Bowl {
    fn value<T: Scalar>(&self, position: &DVector<T>) -> T {
        let (x, y) = (position[0].clone(), position[1].clone());
        T::ratio(3, 1) * y.clone() + T::ratio(1, 2) * x.clone() * x.clone() + x * y.clone() * y
    }
}

impl ScalarField for CurvedFloor {
    fn value<T: Scalar>(&self, position: &DVector<T>) -> T {
        let x = position[0].clone();
        position[1].clone() + T::ratio(1, 4) * x.clone() * x
    }
}

/// A start that hits the wall at q̃ = (2/3, −1/9) after τ with ṽ⁻ = −2n, and the jump λ = 4 of its impact. The steps are reversible, so the
/// body leaves with ṽ⁺ = 2n the way it came, with the same discrete energy.
pub fn variational_start(integrator: &Variational<Bowl, CurvedFloor>, time: &Rational) -> (Phase<Rational>, Rational) {
    let position = entries(&[(2, 3), (-1, 9)]);
    let leaving = integrator.gap.gradient(&position) * ratio(2, 1);
    let away = Verlet.step(&InPotential(integrator.potential), &Phase { position, velocity: leaving }, time);
    (Phase { velocity: -away.velocity, ..away }, ratio(4, 1))
}

/// φ = ½(|q|² − 1): outside the unit disk or sphere.
#[derive(Clone, Copy)]
pub struct Disk;

impl ScalarField for Disk {
    fn value<T: Scalar>(&self, position: &DVector<T>) -> T {
        (position.dot(position) - T::one()) * T::ratio(1, 2)
    }
}

/// φ = the last coordinate.
#[derive(Clone, Copy)]
pub struct Floor;

impl ScalarField for Floor {
    fn value<T: Scalar>(&self, position: &DVector<T>) -> T {
        position[position.len() - 1].clone()
    }
}

/// One finding for the entries of a matrix that should vanish.
pub fn vanishes(name: &str, matrix: &DMatrix<Rational>) -> Finding {
    let largest = matrix.iter().map(Scalar::magnitude).fold(ratio(0, 1), |a, b| if a > b { a } else { b });
    Finding::exact(format!("largest entry of {name}"), &largest, &ratio(0, 1), "1")
}

/// The variational integrator, a start whose step of ½ hits the wall, and the impact's unknowns.
pub fn hitting() -> (Variational<Bowl, CurvedFloor>, Phase<Rational>, Guess<Rational>) {
    let integrator = Variational { potential: Bowl, gap: Bowl::wall() };
    let time = ratio(1, 4);
    let (start, jump) = variational_start(&integrator, &time);
    (integrator, start, Guess { time, jump, newton_steps: 1 })
}

/// D of that step with its velocity at the end multiplied by `kept`.
pub fn kept_step(kept: &Rational) -> DMatrix<Rational> {
    let (integrator, start, guess) = hitting();
    let constant = Guess { time: Dual::constant(guess.time), jump: Dual::constant(guess.jump), newton_steps: 1 };
    jacobian(&start.stacked(), |x| {
        let after = integrator.step_with_impact(&Phase::from_stacked(x), &Dual::constant(ratio(1, 2)), &constant);
        Phase { velocity: after.velocity * Dual::constant(kept.clone()), ..after }.stacked()
    })
}

/// Two coupled masses, a step of 1/20 s above the wall that they penetrate in it.
pub fn about_to_penetrate() -> Phase<Rational> {
    Phase { position: entries(&[(1, 2), (1, 100)]), velocity: entries(&[(2, 1), (-3, 1)]) }
}

/// A flow without friction across the disk, under the acceleration (1/2, −3).
pub fn loaded(restitution: Rational) -> DMatrix<Rational> {
    disk_flow(restitution, Tangent::Frictionless, ratio(0, 1), &[(1, 2), (-3, 1)])
}

/// The flow of a ball across its impact at a speed, g = 10 m/s², from `speed`/1000 s before it to as long after.
pub fn ball_flow(restitution: &Rational, speed: &Rational) -> DMatrix<Rational> {
    let flow = ImpactFlow {
        gap: Floor,
        acceleration: entries(&[(-10, 1)]),
        restitution: restitution.clone(),
        tangent: Tangent::Frictionless,
        friction: ratio(0, 1),
    };
    let time = speed / ratio(1000, 1);
    across(&flow, &entries(&[(0, 1)]), &DVector::from_element(1, -speed.clone()), &time, &(&time * ratio(2, 1)))
}

/// The flow across an impact on the disk at (3/5, 4/5), arriving there with a velocity after 1/3 s, to t = 1/2 s.
pub fn disk_flow(restitution: Rational, tangent: Tangent, friction: Rational, acceleration: &[(i64, i64)]) -> DMatrix<Rational> {
    let flow = ImpactFlow { gap: Disk, acceleration: entries(acceleration), restitution, tangent, friction };
    across(&flow, &entries(&[(3, 5), (4, 5)]), &entries(&[(1, 1), (-2, 1)]), &ratio(1, 3), &ratio(1, 2))
}

/// The Jacobian of a flow whose impact is at `touching` with the velocity `arriving` at t₁.
pub fn across<W: ScalarField>(
    flow: &ImpactFlow<W>,
    touching: &DVector<Rational>,
    arriving: &DVector<Rational>,
    impact: &Rational,
    end: &Rational,
) -> DMatrix<Rational> {
    let gained = &flow.acceleration * impact.clone();
    let velocity = arriving - &gained;
    let position = touching - (&velocity + gained * ratio(1, 2)) * impact.clone();
    let start = Phase { position, velocity };
    assert_eq!(flow.gap_at(&start, impact), ratio(0, 1), "the start arrives at the wall at the time of impact");
    jacobian(&start.stacked(), |x| flow.map(&Phase::from_stacked(x), impact, end).stacked())
}
