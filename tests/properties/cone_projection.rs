//! Property family 3: projection on the friction cone.

use crate::cases;
use moreau::checks::Finding;
use moreau::checks::cone_projection::*;
use moreau::cones::second_order::project;
use moreau::scalar::ratio;
use proptest::prelude::*;

fn assert_holds(findings: Vec<Finding>) {
    assert!(!findings.is_empty());
    for finding in findings {
        assert!(finding.holds(), "{finding}");
    }
}

/// Coefficients of friction: none, ordinary, steep.
fn friction() -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 4 => 0.0..2.0f64, 1 => 2.0..100.0f64]
}

/// Vectors of one to three entries, of unit size, with zeros among them.
fn vector() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(prop_oneof![1 => Just(0.0), 8 => -2.0..2.0f64], 1..=3)
}

/// Two vectors of equal length.
fn pair() -> impl Strategy<Value = (Vec<f64>, Vec<f64>)> {
    (1..=3usize).prop_flat_map(|size| (prop::collection::vec(-2.0..2.0f64, size), prop::collection::vec(-2.0..2.0f64, size)))
}

/// A power of two as a scale, from 2⁻⁶⁰ to 2⁶⁰.
fn scale() -> impl Strategy<Value = f64> {
    (-60..60i32).prop_map(|exponent| f64::from(exponent).exp2())
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn moreau_decomposition_holds(z in vector(), size in scale(), mu in friction()) {
        let z: Vec<f64> = z.iter().map(|entry| size * entry).collect();
        assert_holds(moreau_decomposition(project, &z, mu));
    }

    #[test]
    fn variational_inequality_holds_against_random_cone_points(
        (z, mut point) in pair(), reach in 0.0..=1.0f64, mu in friction(),
    ) {
        // A random point of the cone: any normal entry ≥ 0, and a tangent of length reach·μ·z_n along the random one.
        point[0] = point[0].abs();
        let length = point[1..].iter().fold(0.0f64, |length, entry| length.hypot(*entry));
        let factor = if length > 0.0 { reach * mu * point[0] / length } else { 0.0 };
        point[1..].iter_mut().for_each(|entry| *entry *= factor);
        assert_holds(variational_inequality(project, &z, mu, &point));
    }

    #[test]
    fn projecting_twice_changes_nothing(z in vector(), mu in friction()) {
        assert_holds(idempotent(project, &z, mu));
    }

    #[test]
    fn projection_is_non_expansive((z, w) in pair(), nearness in scale(), mu in friction()) {
        assert_holds(non_expansive(project, &z, &w, mu));
        let near: Vec<f64> = z.iter().zip(&w).map(|(a, b)| a + nearness.min(1.0) * b).collect();
        assert_holds(non_expansive(project, &z, &near, mu));
    }

    #[test]
    fn projection_is_positively_homogeneous(z in vector(), factor in 0.001..1000.0f64, mu in friction()) {
        assert_holds(homogeneous(project, &z, factor, mu));
    }

    #[test]
    fn projection_commutes_with_rotations_about_the_normal(z in vector(), angle in 0.0..6.3f64, mu in friction()) {
        assert_holds(equivariant(project, &z, angle, mu));
    }

    #[test]
    fn projection_equals_the_interior_point_solution(z in vector(), mu in prop_oneof![Just(0.0), 0.0625..4.0f64]) {
        assert_holds(equals_clarabel(project, &z, mu).expect("Clarabel solves three unknowns"));
    }

    #[test]
    fn rational_points_are_decided_and_projected_exactly(
        normal in -300..300i64, radius in 0..300i64, slope in -30..30i64, mu in (0..60i64, 1..20i64), side in -1..=1i64, kind in 0..3usize,
    ) {
        let (radius, mu) = (ratio(radius, 97), ratio(mu.0, mu.1));
        // On the polar boundary, on the cone's boundary, or anywhere; a hair to either side or exactly there.
        let normal = match kind {
            0 => -(mu.clone() * radius.clone()),
            1 if mu > ratio(0, 1) => radius.clone() / mu.clone(),
            _ => ratio(normal, 89),
        } + ratio(side, 1 << 50);
        assert_holds(decided_exactly(project, &RationalPoint { normal, radius, slope: ratio(slope, 7), mu }));
    }
}
