//! Contact frames: (n, t₁, t₂) orthonormal and right-handed, a fixed function of the normal alone.
//!
//! ```text
//!     planar:   t  = (n₂, −n₁)                       (n₁, n₂) rotated by −90°; the floor's tangent is +x
//!     spatial:  t₁ = ŷ × n / ‖ŷ × n‖,  t₂ = n × t₁   or, for normals near ±ŷ, t₁ = n × ẑ / ‖n × ẑ‖
//! ```
//! For a normal in the x–z plane the spatial t₁ is the planar tangent, so a planar scene has the same friction rows in both.

/// The tangent of a unit normal in the plane, t = (n₂, −n₁).
pub fn planar_tangent(normal: [f64; 2]) -> [f64; 2] {
    [normal[1], -normal[0]]
}

/// Two tangents (t₁, t₂) completing a unit normal to a right-handed orthonormal frame.
///
/// The axis it is crossed with is at least 45° away from the normal, so no digit is lost however steep the normal.
pub fn spatial_tangents(normal: [f64; 3]) -> [[f64; 3]; 2] {
    let [x, y, z] = normal;
    let sideways = x.hypot(z);
    let first = if sideways >= y.abs() {
        [z / sideways, 0.0, -x / sideways]
    } else {
        let sideways = x.hypot(y);
        [y / sideways, -x / sideways, 0.0]
    };
    [first, cross(normal, first)]
}

/// a × b.
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }

    #[test]
    fn the_floor_has_tangents_x_and_y() {
        assert_eq!(spatial_tangents([0.0, 0.0, 1.0]), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        assert_eq!(planar_tangent([0.0, 1.0]), [1.0, 0.0]);
    }

    #[test]
    fn frames_are_orthonormal_and_right_handed_for_every_steepness() {
        for k in 0..64 {
            for j in 0..=32 {
                let (a, b) = (f64::from(k) * std::f64::consts::TAU / 64.0, f64::from(j) * std::f64::consts::PI / 32.0);
                let n = [b.sin() * a.cos(), b.sin() * a.sin(), b.cos()];
                let [t1, t2] = spatial_tangents(n);
                let bound = rounding(6, 1.0);
                for (product, expected) in
                    [(dot(n, t1), 0.0), (dot(n, t2), 0.0), (dot(t1, t2), 0.0), (dot(t1, t1), 1.0), (dot(t2, t2), 1.0)]
                {
                    assert!((product - expected).abs() <= bound, "normal {n:?}: {product}");
                }
                assert!(dot(n, cross(t1, t2)) > 0.5, "right-handed");
            }
        }
    }

    #[test]
    fn planar_normals_have_the_planar_tangent() {
        for angle in [-2.0f64, -0.3, 0.0, 0.7, 1.5, 3.0] {
            let (x, z) = (angle.sin(), angle.cos());
            let ([t1, _], [tx, tz]) = (spatial_tangents([x, 0.0, z]), planar_tangent([x, z]));
            assert!((t1[0] - tx).abs() + (t1[2] - tz).abs() <= rounding(4, 1.0));
        }
    }
}
