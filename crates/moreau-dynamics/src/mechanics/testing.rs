//! What every mechanism must satisfy, as one assertion for the unit tests.

use super::Mechanism;
use crate::tolerance::mechanics;
use moreau_exact::tolerance::rounding;
use nalgebra::{DMatrix, DVector};

/// Asserts that M is symmetric positive definite, that H has the right shape and dφ/dt = H_n v, that contact power is
/// λ·(Hv) = (Hᵀλ)·v, and that the conservative part of the force is −∇V along v.
pub fn assert_consistent(mechanism: &dyn Mechanism, position: &DVector<f64>, velocity: &DVector<f64>) {
    let mass = mechanism.mass_matrix(position);
    assert_eq!(mass, mass.transpose(), "M is symmetric");
    assert!(mass.cholesky().is_some(), "M is positive definite");
    let h = mechanics::DIFFERENCE_STEP;
    let (forward, backward) = (mechanism.integrate(position, velocity, h), mechanism.integrate(position, velocity, -h));
    let (after, before) = (mechanism.contacts(&forward), mechanism.contacts(&backward));
    let contacts = mechanism.contacts(position);
    assert_eq!((contacts.len(), contacts.len()), (after.len(), before.len()), "the list of candidates never changes");
    for ((contact, after), before) in contacts.iter().zip(&after).zip(&before) {
        assert_eq!(contact.jacobian.shape(), (mechanism.rows_per_contact(), mechanism.degrees_of_freedom()));
        let rates = &contact.jacobian * velocity;
        let measured = (after.gap - before.gap) / (2.0 * h);
        let bound = mechanics::central_difference(velocity.norm(), position.norm() + 1.0);
        assert!((measured - rates[0]).abs() <= bound, "{}: dφ/dt = {measured}, H_n v = {}", contact.label(), rates[0]);
        let reaction = DVector::from_fn(rates.len(), |i, _| 1.0 - 0.3 * i as f64);
        let (power, work) = (reaction.dot(&rates), (contact.jacobian.to_dense().transpose() * &reaction).dot(velocity));
        let size = contact.jacobian.to_dense().amax() * reaction.amax() * velocity.amax() * (rates.len() * velocity.len()) as f64;
        assert!((power - work).abs() <= rounding(rates.len() + velocity.len(), size), "{}: power identity", contact.label());
    }
    let rest = DVector::zeros(velocity.len());
    let force = mechanism.force(position, &rest);
    let slope = (mechanism.potential_energy(&forward) - mechanism.potential_energy(&backward)) / (2.0 * h);
    let size = (force.norm() + 1.0) * (position.norm() + 1.0);
    let bound = mechanics::central_difference(velocity.norm(), size);
    assert!((force.dot(velocity) + slope).abs() <= bound, "F·v = {}, −dV/dt = {}", force.dot(velocity), -slope);
}

/// Asserts that the velocity-dependent part of F is that of Lagrange's equations, F(q, 0) − F(q, v) = Ṁ v − ½ ∂(vᵀMv)/∂q, by central
/// differences of M; then vᵀ of it is ½ vᵀṀv, and the motion without contact keeps T + V.
pub fn assert_lagrangian(mechanism: &dyn Mechanism, position: &DVector<f64>, velocity: &DVector<f64>) {
    let h = mechanics::DIFFERENCE_STEP;
    let slope = |direction: &DVector<f64>| {
        (mechanism.mass_matrix(&(position + direction * h)) - mechanism.mass_matrix(&(position - direction * h))) / (2.0 * h)
    };
    let n = velocity.len();
    let turning = slope(velocity) * velocity;
    let gradient = DVector::from_fn(n, |j, _| {
        let unit = DVector::from_fn(n, |k, _| if j == k { 1.0 } else { 0.0 });
        velocity.dot(&(slope(&unit) * velocity))
    });
    let still = mechanism.force(position, &DVector::zeros(n));
    let difference = still - mechanism.force(position, velocity) - (turning - gradient * 0.5);
    let size = mechanism.mass_matrix(position).amax() * n as f64 * (velocity.norm() + velocity.norm_squared());
    // angles enter as differences, which change at up to twice the speed
    let bound = mechanics::central_difference(2.0 * velocity.norm() + 1.0, size);
    assert!(difference.amax() <= bound, "off by {difference}, bound {bound:e}");
}

/// Asserts that the rows of contact k give the velocity of its point in its frame, by central differences of the points.
pub fn assert_tangents(
    mechanism: &dyn Mechanism,
    position: &DVector<f64>,
    velocity: &DVector<f64>,
    points: impl Fn(&DVector<f64>) -> Vec<DVector<f64>>,
    frame: impl Fn(usize) -> DMatrix<f64>,
) {
    let h = mechanics::DIFFERENCE_STEP;
    let (after, before) = (points(&(position + velocity * h)), points(&(position - velocity * h)));
    let bound = mechanics::central_difference(velocity.norm(), position.norm() + 1.0);
    for (k, contact) in mechanism.contacts(position).iter().enumerate() {
        let measured = frame(k) * (&after[k] - &before[k]) / (2.0 * h);
        let difference = &contact.jacobian * velocity - measured;
        assert!(difference.amax() <= bound, "{}: off by {difference}", contact.label());
    }
}
