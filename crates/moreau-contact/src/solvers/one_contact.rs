//! One contact, solved to rounding: y = A r + q with (r, y) in the law, A = W_kk + R_kk positive definite.
//!
//! **Coulomb.** If q_n ≥ 0 the contact opens, r = 0. Otherwise friction acts like a damper of unknown strength κ ≥ 0:
//! ```text
//!     A_nn r_n + A_nt r_t + q_n = 0 ,   (A_tt + κ I) r_t + A_tn r_n + q_t = 0 ,   ‖r_t‖ ≤ μ r_n ⟂ κ ≥ 0 .
//! ```
//! Without friction (κ → ∞) r_n = −q_n/A_nn > 0 and r_t = 0, so ‖r_t‖ − μ r_n < 0; if the sticking answer (κ = 0)
//! is outside the cone, the intermediate value theorem gives a κ with ‖r_t‖ = μ r_n: a sliding contact always exists.
//!
//! **Associated.** min ½ rᵀA r + qᵀr over K_μ. With A = L Lᵀ and L⁻¹ diag(μ², −1, −1) L⁻ᵀ = Q diag(a, −b, −c) Qᵀ the
//! answer on the boundary is x = QᵀLᵀr, x_i = p_i / (1 − ν j_i), p = −QᵀL⁻¹q, with a multiplier ν ≥ 0 found from one
//! scalar equation that has exactly one root.

use super::polyhedral_contact::PolyhedralContact;
use crate::tolerance::solvers as tolerance;
use nalgebra::{Cholesky, Matrix2, Matrix3, Vector2, Vector3};

/// The contact problem of a single contact, prepared once and solved for many q.
#[derive(Clone, Debug)]
pub(super) struct OneContact {
    /// A, padded to 3 × 3; what the solution is exact for.
    pub(super) block: Matrix3<f64>,
    mu: f64,
    law: Prepared,
}

#[derive(Clone, Debug)]
enum Prepared {
    Frictionless,
    Coulomb { schur: Matrix2<f64> },
    Associated { basis: Matrix3<f64>, cone: Vector3<f64> },
    Polyhedral(PolyhedralContact),
}

impl OneContact {
    /// 0 ≤ r_n ⟂ A_nn r_n + q_n ≥ 0 and r_t = 0; needs A_nn > 0.
    pub(super) fn frictionless(block: Matrix3<f64>) -> Option<Self> {
        (block[(0, 0)] > 0.0).then_some(OneContact { block, mu: 0.0, law: Prepared::Frictionless })
    }

    /// Coulomb's law; the symmetric part of A must be positive definite.
    pub(super) fn coulomb(block: Matrix3<f64>, mu: f64) -> Option<Self> {
        Cholesky::new((block + block.transpose()) * 0.5)?;
        let coupling = block.fixed_view::<2, 1>(1, 0) * block.fixed_view::<1, 2>(0, 1) / block[(0, 0)];
        let schur = block.fixed_view::<2, 2>(1, 1) - coupling;
        Some(OneContact { block, mu, law: Prepared::Coulomb { schur } })
    }

    /// Coulomb's law along d ≥ 3 directions; A must be positive definite and μ > 0.
    pub(super) fn polyhedral(block: Matrix3<f64>, mu: f64, directions: usize) -> Option<Self> {
        Cholesky::new((block + block.transpose()) * 0.5)?;
        let law = Prepared::Polyhedral(PolyhedralContact::new(&block, mu, directions)?);
        Some(OneContact { block, mu, law })
    }

    /// The associated law; A must be symmetric positive definite and μ > 0.
    pub(super) fn associated(block: Matrix3<f64>, mu: f64) -> Option<Self> {
        let lower = Cholesky::new(block)?.l();
        let inverse = lower.try_inverse()?;
        let quadratic = Matrix3::from_diagonal(&Vector3::new(mu * mu, -1.0, -1.0));
        let eigen = (inverse * quadratic * inverse.transpose()).symmetric_eigen();
        let mut basis = inverse.transpose() * eigen.eigenvectors;
        let mut cone = eigen.eigenvalues;
        let positive = cone.imax();
        basis.swap_columns(0, positive);
        cone.swap_rows(0, positive);
        if basis[(0, 0)] < 0.0 {
            basis.column_mut(0).neg_mut();
        }
        (cone[0] > 0.0 && cone[1] < 0.0 && cone[2] < 0.0).then_some(OneContact { block, mu, law: Prepared::Associated { basis, cone } })
    }

    /// The impulse r for the velocity q without it.
    pub(super) fn solve(&self, q: &Vector3<f64>) -> Vector3<f64> {
        match &self.law {
            Prepared::Frictionless => Vector3::new((-q[0] / self.block[(0, 0)]).max(0.0), 0.0, 0.0),
            Prepared::Coulomb { schur } => self.solve_coulomb(schur, q),
            Prepared::Associated { basis, cone } => self.solve_associated(basis, cone, q),
            Prepared::Polyhedral(contact) => contact.solve(&self.block, q),
        }
    }

    fn solve_coulomb(&self, schur: &Matrix2<f64>, q: &Vector3<f64>) -> Vector3<f64> {
        let (a, mu) = (&self.block, self.mu);
        if q[0] >= 0.0 {
            return Vector3::zeros();
        }
        let rest = Vector2::new(q[1] - a[(1, 0)] * q[0] / a[(0, 0)], q[2] - a[(2, 0)] * q[0] / a[(0, 0)]);
        let damper = schur.trace();
        // κ = damper · s / (1 − s), s from 0 (stick) to 1 (no friction)
        let tangential = |s: f64| {
            let m = schur * (1.0 - s) + Matrix2::identity() * (damper * s);
            let det = m[(0, 0)] * m[(1, 1)] - m[(0, 1)] * m[(1, 0)];
            Vector2::new(m[(0, 1)] * rest[1] - m[(1, 1)] * rest[0], m[(1, 0)] * rest[0] - m[(0, 0)] * rest[1]) * ((1.0 - s) / det)
        };
        let normal = |t: &Vector2<f64>| -(q[0] + a[(0, 1)] * t[0] + a[(0, 2)] * t[1]) / a[(0, 0)];
        let inside = |s: f64| {
            let t = tangential(s);
            mu * normal(&t) - t.norm()
        };
        if inside(0.0) >= 0.0 {
            let t = tangential(0.0);
            return Vector3::new(normal(&t), t[0], t[1]);
        }
        let t = tangential(increasing_root(inside));
        let size = t.norm();
        if mu == 0.0 || size == 0.0 {
            return Vector3::new(-q[0] / a[(0, 0)], 0.0, 0.0);
        }
        let d = t / size;
        let r = -q[0] / (a[(0, 0)] + mu * (a[(0, 1)] * d[0] + a[(0, 2)] * d[1]));
        Vector3::new(r, mu * r * d[0], mu * r * d[1])
    }

    fn solve_associated(&self, basis: &Matrix3<f64>, cone: &Vector3<f64>, q: &Vector3<f64>) -> Vector3<f64> {
        let mu = self.mu;
        if q[0] >= mu * q[1].hypot(q[2]) {
            return Vector3::zeros();
        }
        let p = -basis.tr_mul(q);
        let stick = basis * p;
        if mu * stick[0] >= stick[1].hypot(stick[2]) {
            return stick;
        }
        // ν = s / (1 − s) / a: the pole ν = 1/a sits at s = ½
        let (root_a, b, c) = (cone[0].sqrt(), -cone[1], -cone[2]);
        let weights = |s: f64| ((1.0 - s) + s * b / cone[0], (1.0 - s) + s * c / cone[0]);
        let boundary = |s: f64| {
            let (second, third) = weights(s);
            root_a * p[0] - (1.0 - 2.0 * s) * (b.sqrt() * p[1] / second).hypot(c.sqrt() * p[2] / third)
        };
        let s = increasing_root(boundary);
        let (second, third) = weights(s);
        let (x1, x2) = (p[1] * (1.0 - s) / second, p[2] * (1.0 - s) / third);
        let x0 = (b.sqrt() * x1).hypot(c.sqrt() * x2) / root_a;
        let guess = basis * Vector3::new(x0, x1, x2);
        let size = guess[1].hypot(guess[2]);
        if size == 0.0 {
            return Vector3::zeros();
        }
        let edge = Vector3::new(1.0, mu * guess[1] / size, mu * guess[2] / size);
        edge * (-q.dot(&edge) / edge.dot(&(self.block * edge))).max(0.0)
    }
}

/// The s in \[0, 1\] where `f` changes from negative to non-negative, to rounding: the Illinois rule with a bisection every third step,
/// so that three steps at least halve the bracket.
fn increasing_root(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    let (mut f_low, mut f_high) = (f(low), f(high));
    if f_low >= 0.0 || f_high < 0.0 {
        return if f_low >= 0.0 { low } else { high };
    }
    let mut last_moved_low = None;
    for step in 1..=tolerance::ROOT_STEPS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        let secant = low - f_low * (high - low) / (f_high - f_low);
        let x = if step % 3 != 0 && secant > low && secant < high { secant } else { middle };
        let value = f(x);
        if value == 0.0 {
            return x;
        }
        let moved_low = value < 0.0;
        let repeated = last_moved_low == Some(moved_low);
        last_moved_low = Some(moved_low);
        if moved_low {
            (low, f_low) = (x, value);
            f_high *= if repeated { 0.5 } else { 1.0 };
        } else {
            (high, f_high) = (x, value);
            f_low *= if repeated { 0.5 } else { 1.0 };
        }
    }
    if f(high).abs() < f(low).abs() { high } else { low }
}
