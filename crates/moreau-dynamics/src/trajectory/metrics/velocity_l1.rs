//! ∫ |v_h − v| dt, the velocity error in L¹.

use crate::trajectory::Graph;

/// ∫ |a(t) − b(t)| dt over the common span \[m\], exact for piecewise linear functions.
pub fn velocity_l1(a: &Graph, b: &Graph) -> f64 {
    a.common_pieces(b).iter().map(|piece| piece.length * mean_magnitude(piece.difference)).sum()
}

/// ∫₀¹ |x + (y − x)s| ds: |x + y|/2 without a change of sign, (x² + y²)/(2(|x| + |y|)) with one.
fn mean_magnitude([x, y]: [f64; 2]) -> f64 {
    if x * y >= 0.0 { 0.5 * (x + y).abs() } else { 0.5 * (x * x + y * y) / (x.abs() + y.abs()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shifted_jump_costs_its_height_times_the_shift() {
        let jump = |t: f64| Graph::linear(&[0.0, t, t, 4.0], &[-1.0, -1.0, 2.0, 2.0]).expect("ordered");
        assert_eq!(velocity_l1(&jump(1.0), &jump(1.5)), 1.5);
        assert_eq!(velocity_l1(&jump(1.0), &jump(1.0)), 0.0);
    }

    #[test]
    fn a_difference_that_changes_sign_does_not_cancel() {
        let line = Graph::linear(&[0.0, 2.0], &[-1.0, 1.0]).expect("ordered");
        let zero = Graph::linear(&[0.0, 2.0], &[0.0, 0.0]).expect("ordered");
        assert_eq!(velocity_l1(&line, &zero), 1.0);
    }
}
