//! A contact: gap, rows of H, friction, restitution; and the Delassus operator of several.

use nalgebra::DMatrix;

pub mod delassus;
pub mod frame;

/// One contact candidate of a mechanism at a configuration q.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// φ(q) \[m\], positive when separated.
    pub gap: f64,
    /// H of this contact, rows (n), (n, t₁) or (n, t₁, t₂), times the number of velocities.
    pub jacobian: DMatrix<f64>,
    /// μ ≥ 0.
    pub friction: f64,
    /// e ∈ \[0, 1\].
    pub restitution: f64,
    /// Which pair touches, e.g. `box1-corner0/ground`.
    pub label: String,
}

/// The impulse of one contact over one step.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactImpulse {
    /// Index into [`crate::mechanics::Mechanism::contacts`].
    pub contact: usize,
    /// (r_n, r_t₁, r_t₂) \[N·s\], as many as the contact has rows.
    pub impulse: Vec<f64>,
}
