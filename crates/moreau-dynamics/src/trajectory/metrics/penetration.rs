//! Deepest penetration max(0, −min φ) and largest gap max φ of a sampled gap.

use moreau_exact::number::larger;

/// max_k max(0, −φ_k) \[m\]; NaN if a gap is NaN.
pub fn penetration(gaps: &[f64]) -> f64 {
    gaps.iter().fold(0.0, |worst, gap| larger(-gap, worst))
}

/// max_k φ_k \[m\], how far a body that should stay in contact hops; NaN if a gap is NaN, −∞ without samples.
pub fn largest_gap(gaps: &[f64]) -> f64 {
    gaps.iter().fold(f64::NEG_INFINITY, |worst, &gap| larger(gap, worst))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_separated_body_penetrates_by_zero() {
        assert_eq!(penetration(&[1.0, 0.5]), 0.0);
        assert_eq!(penetration(&[1.0, -0.5, -0.25]), 0.5);
        assert_eq!(largest_gap(&[-1.0, -0.5]), -0.5);
    }

    #[test]
    fn nan_is_not_lost() {
        assert!(penetration(&[0.0, f64::NAN, -1.0]).is_nan());
        assert!(largest_gap(&[0.0, f64::NAN, 1.0]).is_nan());
    }
}
