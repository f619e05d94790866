//! Painlevé's rod: mass 1 and half-length 1 (I = 1/3) at the angle with cos = 3/5, sin = 4/5, its lower end on the floor and sliding
//! with v_t = −1: W_nn = 52/25, W_nt = −36/25, W_tt = 73/25, det W = 4.

use crate::Result;
use crate::checks::stewart_trinkle::{RationalStep, rational_directions, reference};
use crate::contact::delassus::delassus;
use crate::problem::Lcp;
use crate::scalar::{Rational, ratio};
use crate::solvers::enumeration::all_solutions;
use nalgebra::{DMatrix, DVector};

/// The rod sliding with v_t = −1, with this friction and normal free velocity, φ = 0.
pub fn rod(friction: Rational, normal_velocity: Rational) -> RationalStep {
    leaning([ratio(3, 5), ratio(4, 5)], friction, normal_velocity)
}

/// The same at another angle, (cos, sin).
pub fn leaning([cosine, sine]: [Rational; 2], friction: Rational, normal_velocity: Rational) -> RationalStep {
    let zero = || ratio(0, 1);
    RationalStep {
        mass: DVector::from_vec(vec![ratio(1, 1), ratio(1, 1), ratio(1, 3)]),
        jacobian: DMatrix::from_row_slice(2, 3, &[zero(), ratio(1, 1), -cosine, ratio(1, 1), zero(), sine]),
        rows_per_contact: 2,
        directions: rational_directions(2),
        friction: vec![friction],
        gap: vec![zero()],
        step: ratio(1, 1),
        free_velocity: DVector::from_vec(vec![ratio(-1, 1), normal_velocity, zero()]),
    }
}

/// Normal impulses \[N·s\] of the step's answers for u_n of the free motion \[m/s\], smallest first.
pub fn answers(friction: &Rational, normal_velocity: &Rational) -> Result<Vec<Rational>> {
    let set = all_solutions(&reference(&rod(friction.clone(), normal_velocity.clone()))?)?;
    let mut impulses: Vec<Rational> = set.points.iter().map(|z| z[0].clone()).collect();
    impulses.sort();
    impulses.dedup();
    Ok(impulses)
}

/// How many forces λ_n ≥ 0 ⟂ (W_nn + μ W_nt) λ_n + b ≥ 0 a slide to the left allows, b in m/s².
pub fn sliding_forces(friction: &Rational, b: i64) -> Result<usize> {
    Ok(forces(&rod_delassus()?, friction, b)?.len())
}

/// These forces, in contact coordinates W.
pub fn forces(block: &DMatrix<Rational>, friction: &Rational, b: i64) -> Result<Vec<Rational>> {
    let slope = &block[(0, 0)] + friction * &block[(0, 1)];
    let set = all_solutions(&Lcp::new(DMatrix::from_element(1, 1, slope), DVector::from_element(1, ratio(b, 1))))?;
    Ok(set.points.iter().map(|z| z[0].clone()).collect())
}

pub fn rod_delassus() -> Result<DMatrix<Rational>> {
    leaning_delassus([ratio(3, 5), ratio(4, 5)])
}

pub fn leaning_delassus(angle: [Rational; 2]) -> Result<DMatrix<Rational>> {
    let system = leaning(angle, ratio(0, 1), ratio(0, 1));
    delassus(&DMatrix::from_diagonal(&system.mass), &system.jacobian)
}
