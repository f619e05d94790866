//! The three cases of the projection, decided and solved in rational arithmetic.
//!
//! A tangential part `ρ (1−k², 2k)/(1+k²)` has the rational norm ρ, so that the projection itself is rational:
//! ```text
//!     r_n = (z_n + μρ)/(1 + μ²) ,   ‖r_t‖ = μ r_n .
//! ```
//! Moreau's decomposition is then verified with tolerance zero, which proves `r` without trusting this formula.

use super::{Finding, Projection, apply, norm};
use crate::tolerance::cone_projection as tolerance;
use moreau_contact::cones::{Case, decide};
use moreau_exact::scalar::{Rational, Scalar, ratio};

/// A point with rational entries and rational tangential norm.
#[derive(Clone, Debug)]
pub struct RationalPoint {
    /// Normal entry z_n.
    pub normal: Rational,
    /// Norm of the tangential part, ρ ≥ 0.
    pub radius: Rational,
    /// Half-angle tangent k of the tangential direction.
    pub slope: Rational,
    /// Coefficient of friction μ ≥ 0.
    pub mu: Rational,
}

impl RationalPoint {
    /// Points on both boundaries, a hair beside them on either side, and at the apex, for μ = 0, 1/3, 1, 5/2.
    pub fn around_the_boundaries() -> Vec<RationalPoint> {
        let hair = ratio(1, 1 << 40);
        let mut points = Vec::new();
        for mu in [ratio(0, 1), ratio(1, 3), ratio(1, 1), ratio(5, 2)] {
            for radius in [ratio(0, 1), ratio(7, 5)] {
                let polar = -(mu.clone() * radius.clone());
                let cone = if mu == ratio(0, 1) { radius.clone() } else { radius.clone() / mu.clone() };
                for boundary in [polar, cone] {
                    for offset in [ratio(0, 1), hair.clone(), -hair.clone()] {
                        let (radius, mu) = (radius.clone(), mu.clone());
                        points.push(RationalPoint { normal: boundary.clone() + offset, radius, slope: ratio(1, 2), mu });
                    }
                }
            }
        }
        points
    }

    /// The entries (z_n, z_t1, z_t2).
    pub fn entries(&self) -> [Rational; 3] {
        self.with(self.normal.clone(), self.radius.clone())
    }

    /// The point of the same tangential direction with these normal entry and tangential norm.
    fn with(&self, normal: Rational, radius: Rational) -> [Rational; 3] {
        let square = self.slope.clone() * self.slope.clone();
        let length = ratio(1, 1) + square.clone();
        let first = radius.clone() * (ratio(1, 1) - square) / length.clone();
        [normal, first, radius * ratio(2, 1) * self.slope.clone() / length]
    }

    /// The case by comparing ρ itself, without squares.
    pub fn case(&self) -> Case {
        let (normal, radius, mu) = (&self.normal, &self.radius, &self.mu);
        if *normal >= ratio(0, 1) && *radius <= mu.clone() * normal.clone() {
            Case::Stays
        } else if mu.clone() * radius.clone() <= -normal.clone() {
            Case::Apex
        } else {
            Case::Boundary
        }
    }

    /// The entries of the nearest point of the cone.
    pub fn nearest(&self) -> [Rational; 3] {
        let (normal, radius) = self.projection();
        self.with(normal, radius)
    }

    /// The projection as a rational (normal entry, tangential norm).
    fn projection(&self) -> (Rational, Rational) {
        match self.case() {
            Case::Stays => (self.normal.clone(), self.radius.clone()),
            Case::Apex => (ratio(0, 1), ratio(0, 1)),
            Case::Boundary => {
                let along = self.normal.clone() + self.mu.clone() * self.radius.clone();
                let normal = along / (ratio(1, 1) + self.mu.clone() * self.mu.clone());
                (normal.clone(), self.mu.clone() * normal)
            }
        }
    }
}

/// The decision by squares agrees with the one by norms; the rational projection satisfies Moreau's decomposition
/// exactly; the subject reproduces it up to rounding.
pub fn decided_exactly(subject: Projection, point: &RationalPoint) -> Vec<Finding> {
    let z = point.entries();
    let (normal, radius) = point.projection();
    let exact = point.with(normal.clone(), radius.clone());
    // z − r has the direction of z_t, with the signed tangential part ρ − ‖r_t‖ ≥ 0.
    let (rest_normal, rest_radius) = (point.normal.clone() - normal.clone(), point.radius.clone() - radius.clone());
    let zero = ratio(0, 1);
    let in_cone = normal >= zero && radius <= point.mu.clone() * normal.clone();
    let in_polar = rest_radius >= zero && point.mu.clone() * rest_radius.clone() <= -rest_normal.clone();

    let floats: Vec<f64> = z.iter().map(Scalar::to_f64).collect();
    let image = apply(subject, &floats, Scalar::to_f64(&point.mu));
    let error: Vec<f64> = image.iter().zip(&exact).map(|(value, reference)| value - Scalar::to_f64(reference)).collect();
    vec![
        Finding::decision("case by squares equals case by norms", decide(&z, &point.mu) == point.case(), true),
        Finding::decision("exact projection lies in the cone", in_cone, true),
        Finding::decision("exact remainder lies in the polar cone", in_polar, true),
        Finding::exact("exact projection orthogonal to remainder", &(normal * rest_normal + radius * rest_radius), &zero, "N²·s²"),
        Finding::at_most("distance from the exact projection", norm(&error), tolerance::position(norm(&floats)), "N·s"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_battery_holds_all_three_cases_with_and_without_friction() {
        for mu in [ratio(0, 1), ratio(5, 2)] {
            for case in [Case::Stays, Case::Apex, Case::Boundary] {
                let found = RationalPoint::around_the_boundaries().iter().any(|point| point.mu == mu && point.case() == case);
                assert!(found, "μ = {mu}: no point in case {case:?}");
            }
        }
    }

    #[test]
    fn the_tangential_norm_is_rational() {
        let point = &RationalPoint::around_the_boundaries()[7];
        let [_, first, second] = point.entries();
        assert_eq!(first.clone() * first + second.clone() * second, point.radius.clone() * point.radius.clone());
    }
}
