//! Impact of a uniform rod at 45° (1 kg, 2 m) on its end with μ = 1: W = (5, −3; −3, 5)/2, u⁻ = (−1, 3/5), T⁻ = 1/5 J.
//!
//! Coordinates in which its mass matrix is the identity: W = H Hᵀ with H = (3/2, 1/2; −1/2, −3/2) and v⁻ = (−3/5, −1/5).

use super::planar_step::PlanarStep;
use crate::Result;
use crate::problem::Law;
use crate::scalar::{Rational, ratio};
use crate::schemes::RestitutionRule;
use nalgebra::{DMatrix, DVector};

/// Kinetic energy gained in the impact \[J\] under Coulomb's law, with e on the normal component or on the whole velocity.
pub fn energy_gained(restitution: &Rational, rule: RestitutionRule) -> Result<Rational> {
    let before = DVector::from_vec(vec![ratio(-3, 5), ratio(-1, 5)]);
    let jacobian = DMatrix::from_row_slice(2, 2, &[ratio(3, 2), ratio(1, 2), ratio(-1, 2), ratio(-3, 2)]);
    let reversed = &jacobian * &before * restitution.clone();
    let shift = match rule {
        RestitutionRule::NormalOnly => DVector::from_vec(vec![reversed[0].clone(), ratio(0, 1)]),
        RestitutionRule::FullVector => reversed,
    };
    let impact = PlanarStep {
        mass: vec![ratio(1, 1); 2],
        jacobian,
        free_velocity: before.clone(),
        shift,
        friction: vec![ratio(1, 1)],
        softness: DVector::from_element(2, ratio(0, 1)),
    };
    let after = impact.solve(Law::Coulomb)?.velocity;
    Ok((after.dot(&after) - before.dot(&before)) * ratio(1, 2))
}
