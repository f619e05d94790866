//! One soft planar contact whose rows are not coupled, in any ordered field: h_n = A_n + R_n, h_t = A_t + R_t \[1/kg\], load b = a_u −
//! a_ref \[m/s²\].
//!
//! ```text
//!     min ½ (h_n f_n² + h_t f_t²) + b·f   over |f_t| ≤ μ f_n :
//!     open   b_n ≥ μ|b_t|                 f = 0
//!     stick  |b_t|/h_t ≤ −μ b_n/h_n       f = −(b_n/h_n, b_t/h_t)
//!     slip   otherwise                    f = f_n (1, sμ) ,   f_n = −(b_n + sμ b_t)/(h_n + μ²h_t) ,   s = −sign b_t
//! ```

use moreau_exact::minimum::{Minimum, diagonal, planar_cone};
use moreau_exact::scalar::Scalar;
use moreau_exact::witness::decided;

/// The contact.
///
/// # Source
/// MuJoCo documentation, *Computation: constraint model*, elliptic cones (3.17); conditions of optimality of the header.
#[derive(Clone, Debug, PartialEq)]
pub struct SoftPlanarContact<T> {
    /// (h_n, h_t) \[1/kg\], positive.
    pub softness: [T; 2],
    /// μ.
    pub friction: T,
}

impl<T: Scalar> SoftPlanarContact<T> {
    /// (f_n, f_t) \[N\] under the load b \[m/s²\].
    pub fn force(&self, load: &[T; 2]) -> [T; 2] {
        let least = || Minimum { matrix: diagonal(self.softness.clone()), vector: load.clone(), rows: planar_cone(&self.friction) };
        decided(|| self.case_by_case(load), |found| least().witness(found))
    }

    fn case_by_case(&self, load: &[T; 2]) -> [T; 2] {
        let ([normal, tangent], [h_n, h_t], mu) = (load.clone(), self.softness.clone(), self.friction.clone());
        if normal >= mu.clone() * tangent.magnitude() {
            return [T::zero(), T::zero()];
        }
        let stick = [-normal.clone() / h_n.clone(), -tangent.clone() / h_t.clone()];
        if stick[1].magnitude() <= mu.clone() * stick[0].clone() {
            return stick;
        }
        let slope = if stick[1] > T::zero() { mu } else { -mu };
        let push = -(normal + slope.clone() * tangent) / (h_n + slope.clone() * slope.clone() * h_t);
        [push.clone(), slope * push]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, ratio};

    #[test]
    fn no_admissible_force_of_a_grid_does_better() {
        let contact = SoftPlanarContact { softness: [ratio(2, 1), ratio(3, 1)], friction: ratio(1, 2) };
        let cost = |f: &[Rational; 2], b: &[Rational; 2]| {
            (ratio(2, 1) * &f[0] * &f[0] + ratio(3, 1) * &f[1] * &f[1]) * ratio(1, 2) + &f[0] * &b[0] + &f[1] * &b[1]
        };
        for (normal, tangent) in [(-4, 1), (-4, 9), (-1, -7), (1, 5), (3, 2), (0, 0)] {
            let load = [ratio(normal, 1), ratio(tangent, 1)];
            let best = cost(&contact.force(&load), &load);
            let grid = (0..24).flat_map(|n| (-4..5).map(move |t| [ratio(n, 4), ratio(n * t, 32)]));
            assert!(grid.into_iter().all(|f| cost(&f, &load) >= best), "({normal}, {tangent})");
        }
    }
}
