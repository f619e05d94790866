//! The friction cone `K_μ = {z : ‖z_t‖ ≤ μ z_n}`, its dual `K_μ* = {u : u_n ≥ μ‖u_t‖}` and its polar `K_μ° = −K_μ*`.
//!
//! With the half-angle written as `c = 1/√(1+μ²)`, `s = μ/√(1+μ²)`, the generator towards `z` is `(c, s z_t/‖z_t‖)`, and
//! ```text
//!     along  =  c z_n + s ‖z_t‖      coordinate along that generator,
//!     across =  c ‖z_t‖ − s z_n      signed distance beyond it.
//! ```
//! The Euclidean projection has three cases:
//! ```text
//!     ‖z_t‖ ≤ μ z_n         r = z
//!     μ‖z_t‖ ≤ −z_n         r = 0
//!     otherwise             r = along · (c, s z_t/‖z_t‖),   i.e. r_n = (z_n + μ‖z_t‖)/(1 + μ²), ‖r_t‖ = μ r_n .
//! ```
//! `z_n < 0` alone does not give `r = 0`: the second case is the polar cone, whose slope is 1/μ.
//!
//! One entry means a contact without friction rows, `K = {z_n ≥ 0}` whatever μ; `μ = 0` is the ray along the normal.
//! Coefficients μ are finite and non-negative; NaN in the data comes out as NaN or as "not contained", never as a number.

/// Norm of the tangential part, ‖z_t‖, without overflow or underflow of the squares.
#[inline]
pub fn tangential_norm(z: &[f64]) -> f64 {
    match z[1..] {
        [] => 0.0,
        [one] => one.abs(),
        [one, other] => length(one, other),
        ref more => more.iter().fold(0.0, |norm: f64, &entry| norm.hypot(entry)),
    }
}

/// √(a² + b²), by `hypot` only where a square overflows, or where one that underflows could be seen: it costs as much as ten square roots.
#[inline]
pub(crate) fn length(a: f64, b: f64) -> f64 {
    let square = a * a + b * b;
    if square > f64::MIN_POSITIVE / f64::EPSILON && square.is_finite() {
        square.sqrt()
    } else if a == 0.0 {
        b.abs()
    } else {
        a.hypot(b)
    }
}

/// Cosine and sine of the half-angle of K_μ, `(1, μ)/√(1 + μ²)`.
pub(super) fn half_angle(mu: f64) -> (f64, f64) {
    let length = length(mu, 1.0);
    (1.0 / length, mu / length)
}

/// Whether `z ∈ K_μ`, that is `‖z_t‖ ≤ μ z_n` and `z_n ≥ 0`.
///
/// The second condition matters for μ = 0 only, where `0 ≤ 0·z_n` holds for every z_n.
pub fn contains(z: &[f64], mu: f64) -> bool {
    z[0] >= 0.0 && tangential_norm(z) <= mu * z[0]
}

/// Whether `u ∈ K_μ*`, that is `u_n ≥ μ‖u_t‖`.
pub fn dual_contains(u: &[f64], mu: f64) -> bool {
    u[0] >= mu * tangential_norm(u)
}

/// Whether `z ∈ K_μ° = −K_μ*`, that is `μ‖z_t‖ ≤ −z_n`; exactly these points are projected to the apex.
pub fn polar_contains(z: &[f64], mu: f64) -> bool {
    mu * tangential_norm(z) <= -z[0]
}

/// Replaces `z` by the nearest point of K_μ, `argmin_{r ∈ K_μ} ‖r − z‖`.
///
/// # Source
/// Chapter §5, projection on the Coulomb cone, with the polar condition corrected as in the header.
/// ```
/// use moreau_contact::cones::second_order::{contains, project};
///
/// let mut impulse = [1.0, 3.0, 0.0]; // r_n, r_t [N·s]; sliding friction may be 1
/// project(&mut impulse, 1.0);
/// assert!((impulse[0] - 2.0).abs() < 1e-15 && (impulse[1] - 2.0).abs() < 1e-15);
/// assert!(contains(&impulse, 1.0));
/// ```
pub fn project(z: &mut [f64], mu: f64) {
    if contains(z, mu) {
        return;
    }
    if polar_contains(z, mu) {
        z.fill(0.0);
        return;
    }
    let (c, s) = half_angle(mu);
    let norm = tangential_norm(z);
    let along = c * z[0] + s * norm;
    z[0] = c * along;
    // s·along ≤ ‖z_t‖ in this case, so the factor is at most 1. For ‖z_t‖ = 0 the case cannot arise.
    let factor = s * along / norm;
    z[1..].iter_mut().for_each(|entry| *entry *= factor);
}

/// Replaces `u` by the nearest point of K_μ*, by Moreau's decomposition `P_{K*}(u) = u + P_K(−u)`.
pub fn project_dual(u: &mut [f64], mu: f64) {
    let mut part: Vec<f64> = u.iter().map(|entry| -entry).collect();
    project(&mut part, mu);
    u.iter_mut().zip(&part).for_each(|(entry, addend)| *entry += addend);
}

/// Euclidean distance from `z` to K_μ.
pub fn distance(z: &[f64], mu: f64) -> f64 {
    distance_of([z[0], tangential_norm(z)], mu)
}

/// [`distance`] of a point z from its parts z_n and ‖z_t‖.
#[inline]
pub(crate) fn distance_of([normal, norm]: [f64; 2], mu: f64) -> f64 {
    if normal >= 0.0 && norm <= mu * normal {
        0.0
    } else if mu * norm <= -normal {
        length(norm, normal)
    } else {
        let (c, s) = half_angle(mu);
        c * norm - s * normal
    }
}

/// Euclidean distance from `u` to K_μ*, which is `‖P_K(−u)‖`.
pub fn dual_distance(u: &[f64], mu: f64) -> f64 {
    let norm = tangential_norm(u);
    if dual_contains(u, mu) {
        0.0
    } else if -u[0] >= 0.0 && norm <= -mu * u[0] {
        length(norm, u[0])
    } else {
        let (c, s) = half_angle(mu);
        s * norm - c * u[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn projected(z: &[f64], mu: f64) -> Vec<f64> {
        let mut r = z.to_vec();
        project(&mut r, mu);
        r
    }

    #[test]
    fn a_point_below_the_plane_but_outside_the_polar_cone_is_not_sent_to_the_apex() {
        // μ = 3/4: c = 4/5, s = 3/5, along = 4/5·(−1) + 3/5·10 = 26/5.
        let r = projected(&[-1.0, 6.0, 8.0], 0.75);
        let expected = [104.0 / 25.0, 46.8 / 25.0, 62.4 / 25.0];
        for (value, reference) in r.iter().zip(expected) {
            assert!((value - reference).abs() <= moreau_exact::tolerance::rounding(8, 10.0));
        }
    }

    #[test]
    fn both_boundaries_belong_to_the_closed_cases() {
        // ‖z_t‖ = 5 and μ = 2: K at z_n = 5/2, polar at z_n = −10.
        assert_eq!(projected(&[2.5, 3.0, 4.0], 2.0), [2.5, 3.0, 4.0]);
        assert!(projected(&[2.5 - 1e-12, 3.0, 4.0], 2.0)[1] < 3.0);
        assert_eq!(projected(&[-10.0, 3.0, 4.0], 2.0), [0.0; 3]);
        assert!(projected(&[-10.0 + 1e-12, 3.0, 4.0], 2.0)[0] > 0.0);
    }

    #[test]
    fn without_friction_the_cone_is_the_normal_ray() {
        assert_eq!(projected(&[2.0, 3.0, 4.0], 0.0), [2.0, 0.0, 0.0]);
        assert_eq!(projected(&[-2.0, 0.0, 0.0], 0.0), [0.0; 3]);
        assert!(!contains(&[-2.0, 0.0], 0.0), "0 ≤ 0·z_n must not admit a pulling impulse");
        assert_eq!(distance(&[-2.0, 0.0], 0.0), 2.0);
        assert_eq!(dual_distance(&[-2.0, 7.0], 0.0), 2.0);
        assert_eq!(dual_distance(&[2.0, 7.0], 0.0), 0.0);
    }

    #[test]
    fn one_row_is_the_half_line_whatever_mu() {
        assert_eq!(projected(&[-3.0], 0.7), [0.0]);
        assert_eq!(projected(&[3.0], 0.7), [3.0]);
        assert_eq!(distance(&[-3.0], 0.7), 3.0);
        assert_eq!(dual_distance(&[-3.0], 0.7), 3.0);
        assert!(dual_contains(&[0.0], 0.7));
    }

    #[test]
    fn the_apex_is_fixed() {
        for mu in [0.0, 0.5, 3.0] {
            assert_eq!(projected(&[0.0; 3], mu), [0.0; 3]);
            assert!(contains(&[0.0; 3], mu) && dual_contains(&[0.0; 3], mu) && polar_contains(&[0.0; 3], mu));
        }
    }

    #[test]
    fn magnitudes_whose_squares_overflow_or_vanish_are_projected() {
        for scale in [1e-300, 1e300] {
            let r = projected(&[-scale, 6.0 * scale, 8.0 * scale], 0.75);
            assert!((r[0] / scale - 4.16).abs() <= moreau_exact::tolerance::rounding(8, 10.0), "{r:?}");
        }
        let r = projected(&[0.0, 1.0], 1e200);
        assert_eq!(r[1], 1.0);
    }

    #[test]
    fn nan_stays_nan() {
        assert!(projected(&[f64::NAN, 1.0, 0.0], 0.5)[0].is_nan());
        assert!(projected(&[-1.0, f64::NAN, 0.0], 0.5)[0].is_nan());
        assert!(distance(&[f64::NAN, 1.0], 0.5).is_nan() && dual_distance(&[1.0, f64::NAN], 0.5).is_nan());
        assert!(!contains(&[f64::NAN], 0.5));
    }

    #[test]
    fn distances_are_those_to_the_projections() {
        for z in [[1.0, 2.0, -2.0], [-1.0, 2.0, -2.0], [-9.0, 1.0, 0.0], [5.0, 0.1, 0.2], [0.0, 1.0, 0.0]] {
            for mu in [0.0, 0.3, 1.0, 4.0] {
                let gap = |nearest: &[f64]| z.iter().zip(nearest).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
                assert!((distance(&z, mu) - gap(&projected(&z, mu))).abs() <= moreau_exact::tolerance::rounding(12, 10.0));
                let mut dual = z;
                project_dual(&mut dual, mu);
                assert!((dual_distance(&z, mu) - gap(&dual)).abs() <= moreau_exact::tolerance::rounding(12, 10.0));
            }
        }
    }
}
