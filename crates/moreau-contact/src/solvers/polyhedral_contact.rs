//! One contact with d friction directions, solved by going through its cases: y = A r + q with
//!
//! ```text
//!     0 ≤ r_n ⟂ y_n ≥ 0 ,   r_t = Σ Dⱼβⱼ ,   0 ≤ βⱼ ⟂ Dⱼ·y_t + σ ≥ 0 ,   0 ≤ μ r_n − Σβⱼ ⟂ σ ≥ 0 .
//! ```
//! - open: q_n ≥ 0, r = 0;
//! - stick: r = −A⁻¹q with r_t in the polygon μ r_n conv(Dⱼ);
//! - slide at a vertex: r = r_n (1, μ Dⱼ) with y_n = 0, and −Dⱼ·y_t = σ ≥ 0 the largest;
//! - slide along a side: r = a (1, μ Dⱼ) + b (1, μ Dⱼ₊₁) with y_n = 0 and Dⱼ·y_t = Dⱼ₊₁·y_t = −σ, a, b ≥ 0.
//!
//! A solution exists for positive definite A; rounding at the border of two cases is met by taking the case that is violated least.

use crate::cones::polyhedral::{edge, neighbours};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

/// The contact, prepared once and solved for many q.
#[derive(Clone, Debug)]
pub(super) struct PolyhedralContact {
    inverse: Matrix3<f64>,
    mu: f64,
    /// (1, μ Dⱼ).
    edges: Vec<Vector3<f64>>,
}

/// An impulse and by how much it violates its case, relative to q.
struct Candidate {
    impulse: Vector3<f64>,
    violation: f64,
}

impl PolyhedralContact {
    /// A must be invertible, μ > 0 and d ≥ 3.
    pub(super) fn new(block: &Matrix3<f64>, mu: f64, directions: usize) -> Option<Self> {
        let edges = (0..directions).map(|j| edge(j, directions, mu).into()).collect();
        Some(PolyhedralContact { inverse: block.try_inverse()?, mu, edges })
    }

    /// The impulse r for the velocity q without it.
    pub(super) fn solve(&self, block: &Matrix3<f64>, q: &Vector3<f64>) -> Vector3<f64> {
        if q[0] >= 0.0 {
            return Vector3::zeros();
        }
        let stick = -(self.inverse * q);
        let (_, parts) = neighbours([stick[1], stick[2]], self.edges.len());
        if parts[0] + parts[1] <= self.mu * stick[0] {
            return stick;
        }
        let mut best = Candidate { impulse: Vector3::zeros(), violation: f64::INFINITY };
        for j in 0..self.edges.len() {
            for candidate in [self.vertex(block, q, j), self.side(block, q, j)].into_iter().flatten() {
                if candidate.violation < best.violation {
                    best = candidate;
                }
            }
            if best.violation <= 0.0 {
                break;
            }
        }
        best.impulse
    }

    /// Sliding with the impulse along edge j.
    fn vertex(&self, block: &Matrix3<f64>, q: &Vector3<f64>, j: usize) -> Option<Candidate> {
        let edge = &self.edges[j];
        let resistance = (block.row(0) * edge)[0];
        if resistance <= 0.0 {
            return None;
        }
        let impulse = edge * (-q[0] / resistance);
        let violation = self.slip_violation(block, q, &impulse, j);
        Some(Candidate { impulse, violation })
    }

    /// Sliding with the impulse between the edges j and j + 1.
    fn side(&self, block: &Matrix3<f64>, q: &Vector3<f64>, j: usize) -> Option<Candidate> {
        let (first, second) = (&self.edges[j], &self.edges[(j + 1) % self.edges.len()]);
        let across = first - second;
        let (own, other) = (block * first, block * second);
        let system = Matrix2::new(own[0], other[0], across.dot(&own), across.dot(&other));
        let parts = system.lu().solve(&Vector2::new(-q[0], -across.dot(q)))?;
        let impulse = first * parts[0] + second * parts[1];
        let negative = -parts.min() * block[(0, 0)] / -q[0];
        Some(Candidate { impulse, violation: self.slip_violation(block, q, &impulse, j).max(negative) })
    }

    /// The violation of the condition that σ = −Dⱼ·y_t is at least 0 and at least every other −D_k·y_t, relative to q.
    fn slip_violation(&self, block: &Matrix3<f64>, q: &Vector3<f64>, impulse: &Vector3<f64>, j: usize) -> f64 {
        let y = block * impulse + q;
        let against = |edge: &Vector3<f64>| (edge[1] * y[1] + edge[2] * y[2]) / self.mu;
        let slip = -against(&self.edges[j]);
        let worst = self.edges.iter().map(|edge| -against(edge)).fold(0.0, f64::max);
        (worst - slip) / q.norm()
    }
}
