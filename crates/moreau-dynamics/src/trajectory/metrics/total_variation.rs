//! Σ_k |v_{k+1} − v_k|, the total variation of the sampled velocity.

/// Σ_k |v_{k+1} − v_k| \[m/s\]; equals the total variation of the step function and of the interpolant.
pub fn total_variation(velocities: &[f64]) -> f64 {
    velocities.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fall_and_a_bounce_vary_by_their_slopes_and_their_jump() {
        assert_eq!(total_variation(&[0.0, -1.0, -2.0, 1.0, 0.0]), 6.0);
        assert_eq!(total_variation(&[]), 0.0);
    }
}
