//! Tolerances of [`crate::delassus`].

use moreau_exact::tolerance::rounding;

/// How far below zero xᵀWx/xᵀx may be for the rounded W of n velocities and trace tr W: 2(n + 2)ε·tr W.
///
/// The computed Y and D of W = YᵀD⁻¹Y make an exactly semidefinite matrix G whatever their own errors; only the
/// last sum of n terms, each a product and a quotient, adds E with |E_ij| ≤ γ_{n+2}·√(G_ii G_jj), and
/// ‖E‖₂ ≤ γ_{n+2}·tr G. Since tr W ≤ rows·‖W‖₂ this is the bound c·rows·ε·‖W‖ with c = 2(n + 2).
/// Derived.
pub fn gram_matrix(velocities: usize, trace: f64) -> f64 {
    rounding(velocities + 2, trace)
}

/// Steps per row after which an iteration for eigenvalues has not converged. Wilkinson's shift usually needs fewer than three;
/// nothing but the time until another way is taken depends on the number.
/// Set.
pub const EIGENVALUE_STEPS: usize = 100;

/// How far H(M⁻¹Hᵀe_j) may be from W_ij for a *diagonal* M of n velocities, where `magnitude` is √(W_ii W_jj).
/// Both are sums of n products of three rounded factors each. By Cauchy–Schwarz Σ|H_ik H_jk|/m_k ≤ √(W_ii W_jj).
/// Derived.
pub fn column(velocities: usize, magnitude: f64) -> f64 {
    2.0 * rounding(velocities + 2, magnitude)
}
