//! ess sup |v_h − v|, the largest velocity error; it does not vanish with h where impacts are shifted in time.

use crate::trajectory::Graph;

/// ess sup |a(t) − b(t)| over the common span \[m/s\], exact for piecewise linear functions.
pub fn velocity_sup(a: &Graph, b: &Graph) -> f64 {
    a.common_pieces(b).iter().flat_map(|piece| piece.difference).map(f64::abs).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shifted_jump_costs_its_full_height_however_small_the_shift() {
        let jump = |t: f64| Graph::linear(&[0.0, t, t, 4.0], &[-1.0, -1.0, 2.0, 2.0]).expect("ordered");
        assert_eq!(velocity_sup(&jump(1.0), &jump(1.0 + 1e-12)), 3.0);
        assert_eq!(velocity_sup(&jump(1.0), &jump(1.0)), 0.0);
    }
    #[test]
    fn the_largest_difference_may_lie_at_either_end_of_a_piece() {
        let line = |from: f64, to: f64| Graph::linear(&[0.0, 1.0], &[from, to]).expect("ordered");
        assert_eq!(velocity_sup(&line(0.0, -2.0), &line(0.0, 1.0)), 3.0);
        assert_eq!(velocity_sup(&line(-2.0, 0.0), &line(1.0, 0.0)), 3.0);
    }
}
