//! The price s of violating one soft contact, with the impulse and the curvature that follow from it.
//!
//! ```text
//!     one-sided   s = ½ y²/R                        while y < 0 , else 0
//!     cone        t = ‖(μ₁y₁, μ₂y₂, …)‖ ,   ρ = R_j μ_j² ,   f = (t − y₀)₊/(R₀ + ρ) :
//!                 s = 0                             y₀ ≥ t                  open
//!                 s = ½ (y₀²/R₀ + t²/ρ)             R₀ t ≤ −ρ y₀            stick:  r = −R⁻¹y
//!                 s = ½ (R₀ + ρ) f²                 otherwise               slip:   r = f (1, −μ_j² y_j/t)
//! ```
//! s(y) = max over r in {Σ(r_j/μ_j)² ≤ r₀², r₀ ≥ 0} of −rᵀy − ½ rᵀR r, convex and once continuously differentiable. All R_j μ_j² of a
//! contact are equal: that is what makes the projection in the norm of R elementary.

use nalgebra::{DMatrix, DVector};

/// One soft contact: the rows it takes and what violating them costs.
///
/// # Source
/// MuJoCo documentation, *Computation: constraint model* (3.17); conditions of optimality of the header.
#[derive(Clone, Debug, PartialEq)]
pub enum SoftPiece {
    /// One row that only pushes.
    OneSided {
        /// R \[1/kg\].
        softness: f64,
    },
    /// A normal row and one row per friction coefficient.
    Cone {
        /// R₀ \[1/kg\].
        normal: f64,
        /// ρ = R_j μ_j² \[1/kg\], the same for every j.
        tangential: f64,
        /// μ_j > 0; lengths in m for rows that are rotations.
        friction: Vec<f64>,
    },
}

/// Which formula of the header holds.
enum Zone {
    Open,
    Stick,
    Slip { size: f64, push: f64 },
}

impl SoftPiece {
    /// How many rows it takes.
    pub fn rows(&self) -> usize {
        match self {
            SoftPiece::OneSided { .. } => 1,
            SoftPiece::Cone { friction, .. } => 1 + friction.len(),
        }
    }

    /// The diagonal of R \[1/kg\], one entry per row.
    pub fn softness(&self) -> Vec<f64> {
        match self {
            SoftPiece::OneSided { softness } => vec![*softness],
            SoftPiece::Cone { normal, tangential, friction } => {
                std::iter::once(*normal).chain(friction.iter().map(|mu| tangential / (mu * mu))).collect()
            }
        }
    }

    fn zone(&self, y: &[f64]) -> Zone {
        match self {
            SoftPiece::OneSided { .. } if y[0] >= 0.0 => Zone::Open,
            SoftPiece::OneSided { .. } => Zone::Stick,
            SoftPiece::Cone { normal, tangential, friction } => {
                let size = friction.iter().zip(&y[1..]).map(|(mu, y)| (mu * y).powi(2)).sum::<f64>().sqrt();
                if y[0] >= size {
                    Zone::Open
                } else if normal * size <= -tangential * y[0] {
                    Zone::Stick
                } else {
                    Zone::Slip { size, push: (size - y[0]) / (normal + tangential) }
                }
            }
        }
    }

    /// s(y) \[J\].
    pub fn cost(&self, y: &[f64]) -> f64 {
        match (self.zone(y), self) {
            (Zone::Open, _) => 0.0,
            (Zone::Slip { push, .. }, SoftPiece::Cone { normal, tangential, .. }) => 0.5 * (normal + tangential) * push * push,
            _ => 0.5 * y.iter().zip(self.softness()).map(|(y, softness)| y * y / softness).sum::<f64>(),
        }
    }

    /// r = −∇s(y) \[N·s\].
    pub fn impulse(&self, y: &[f64]) -> Vec<f64> {
        match (self.zone(y), self) {
            (Zone::Open, _) => vec![0.0; self.rows()],
            (Zone::Slip { size, push }, SoftPiece::Cone { friction, .. }) => {
                let tangential = friction.iter().zip(&y[1..]).map(|(mu, y)| -push * mu * mu * y / size);
                std::iter::once(push).chain(tangential).collect()
            }
            _ => y.iter().zip(self.softness()).map(|(y, softness)| -y / softness).collect(),
        }
    }

    /// ∇²s(y) \[kg\]; where a zone ends, that of the zone that the header names first.
    pub fn curvature(&self, y: &[f64]) -> DMatrix<f64> {
        let n = self.rows();
        match (self.zone(y), self) {
            (Zone::Open, _) => DMatrix::zeros(n, n),
            (Zone::Slip { size, push }, SoftPiece::Cone { normal, tangential, friction }) => {
                let slope = std::iter::once(-1.0).chain(friction.iter().zip(&y[1..]).map(|(mu, y)| mu * mu * y / size));
                let slope = DVector::from_iterator(n, slope);
                let mut curvature = &slope * slope.transpose() / (normal + tangential);
                for j in 1..n {
                    curvature[(j, j)] += push * friction[j - 1].powi(2) / size;
                    for k in 1..n {
                        curvature[(j, k)] -= push * slope[j] * slope[k] / size;
                    }
                }
                curvature
            }
            _ => DMatrix::from_diagonal(&DVector::from_vec(self.softness().into_iter().map(|softness| 1.0 / softness).collect())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::cones::{DIFFERENCE_STEP, difference_error};
    use moreau_exact::tolerance::rounding;

    #[test]
    fn impulse_and_curvature_are_the_derivatives_of_the_cost() {
        let piece = SoftPiece::Cone { normal: 0.5, tangential: 0.2, friction: vec![0.6, 0.6, 0.1] };
        for y in [[-1.0, 0.3, -0.2, 0.5], [-0.1, 1.0, 0.7, -2.0], [0.4, -1.1, 0.9, 0.3], [3.0, 0.1, 0.1, 0.1]] {
            let (impulse, curvature) = (piece.impulse(&y), piece.curvature(&y));
            for j in 0..4 {
                let moved = |sign: f64| {
                    let mut moved = y;
                    moved[j] += sign * DIFFERENCE_STEP;
                    moved
                };
                let (ahead, behind) = (moved(1.0), moved(-1.0));
                // s and ∇s are smooth within a zone, with third derivatives as in the cones' own test, over R ≥ 0.2
                let allowed = difference_error(0.2, 3.0) / 0.2;
                let slope = (piece.cost(&ahead) - piece.cost(&behind)) / (2.0 * DIFFERENCE_STEP);
                assert!((slope + impulse[j]).abs() <= allowed, "{y:?} {j}: {slope} {}", impulse[j]);
                for (k, (ahead, behind)) in piece.impulse(&ahead).iter().zip(piece.impulse(&behind)).enumerate() {
                    let slope = (behind - ahead) / (2.0 * DIFFERENCE_STEP);
                    assert!((slope - curvature[(k, j)]).abs() <= allowed, "{y:?} ({k}, {j}): {slope} {}", curvature[(k, j)]);
                }
            }
        }
    }

    #[test]
    fn every_impulse_lies_in_its_cone() {
        let piece = SoftPiece::Cone { normal: 0.5, tangential: 0.2, friction: vec![0.6, 0.6, 0.1] };
        for y in [[-1.0, 0.3, -0.2, 0.5], [-0.1, 1.0, 0.7, -2.0], [0.4, -1.1, 0.9, 0.3]] {
            let r = piece.impulse(&y);
            let size = [0.6, 0.6, 0.1].iter().zip(&r[1..]).map(|(mu, r)| (r / mu).powi(2)).sum::<f64>().sqrt();
            assert!(size <= r[0] + rounding(8, r[0]), "{y:?}: {r:?}");
        }
    }
}
