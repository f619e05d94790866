//! max_k |q_k − q(t_k)|, the largest position error at the sample times.

use moreau_exact::number::larger;

/// max_k |q_k − q(t_k)| \[m\] of samples q_k at times t_k against a reference motion; NaN if any error is NaN.
pub fn position_sup(times: &[f64], positions: &[f64], reference: impl Fn(f64) -> f64) -> f64 {
    let errors = times.iter().zip(positions).map(|(&t, q)| (q - reference(t)).abs());
    errors.fold(0.0, |worst, error| larger(error, worst))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_error_counts_and_nan_is_not_lost() {
        let times = [0.0, 1.0, 2.0];
        assert_eq!(position_sup(&times, &[0.0, 1.5, 2.25], |t| t), 0.5);
        assert!(position_sup(&times, &[f64::NAN, 1.5, 2.25], |t| t).is_nan());
        assert!(position_sup(&times, &[0.0, f64::NAN, 9.0], |t| t).is_nan());
    }
}
