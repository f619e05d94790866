//! The self-dual second-order cone ‖x_t‖ ≤ x_n in one, two or three rows: its product, and the scaling of Nesterov and Todd.
//!
//! ```text
//!     x ∘ z = (x·z, x_n z_t + z_n x_t) ,   e = (1, 0, 0) ,   det x = x_n² − ‖x_t‖²
//!     P = β (2 v vᵀ − J) ,   P z = P⁻¹ x = λ ,   P⁻² = β⁻² (2 (Jw)(Jw)ᵀ − J) ,   J = diag(1, −1, −1)
//!     w = (x̄ + J z̄)/(2γ) ,  γ² = (1 + x̄·z̄)/2 ,  v = (w + e)/√(2 (w_n + 1)) ,  β⁴ = det x/det z ,   x̄ = x/√det x
//! ```

use crate::tolerance::solvers::MIDDLE;
use nalgebra::{Matrix3, Vector3};

/// P of a pair (x, z) inside of the cone.
#[derive(Clone, Debug)]
pub(crate) struct Scaling {
    /// P⁻¹.
    inverse: Matrix3<f64>,
    /// P.
    matrix: Matrix3<f64>,
    /// P⁻².
    square: Matrix3<f64>,
    /// λ.
    middle: Vector3<f64>,
}

fn flipped(x: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(x[0], -x[1], -x[2])
}

/// det x, without cancellation of squares.
fn determinant(x: &Vector3<f64>) -> f64 {
    let tangential = x[1].hypot(x[2]);
    (x[0] - tangential) * (x[0] + tangential)
}

/// x ∘ z.
pub(crate) fn product(x: &Vector3<f64>, z: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(x.dot(z), x[0] * z[1] + z[0] * x[1], x[0] * z[2] + z[0] * x[2])
}

/// The y with λ ∘ y = x, for λ inside of the cone.
pub(crate) fn quotient(lambda: &Vector3<f64>, x: &Vector3<f64>) -> Vector3<f64> {
    let first = flipped(lambda).dot(x) / determinant(lambda);
    Vector3::new(first, (x[1] - first * lambda[1]) / lambda[0], (x[2] - first * lambda[2]) / lambda[0])
}

/// The largest α with x + α dx in the cone, infinite if there is none, for x inside of it.
pub(crate) fn to_boundary(x: &Vector3<f64>, dx: &Vector3<f64>) -> f64 {
    // det(x + α dx) = c + 2 b α + a α²
    let (a, c) = (determinant(dx), determinant(x));
    let b = x[0] * dx[0] - x[1] * dx[1] - x[2] * dx[2];
    let discriminant = b * b - a * c;
    if a >= 0.0 && (b >= 0.0 || discriminant < 0.0) {
        return f64::INFINITY;
    }
    let root = discriminant.max(0.0).sqrt();
    // the smallest positive root
    if a < 0.0 || b < 0.0 { c / (-b + root) } else { f64::INFINITY }
}

impl Scaling {
    /// Of a pair in the half line, the cone of one row.
    pub(crate) fn half_line(x: f64, z: f64) -> Option<Self> {
        let (root, lambda) = ((x / z).sqrt(), (x * z).sqrt());
        let diagonal = |first: f64| Matrix3::from_diagonal(&Vector3::new(first, 0.0, 0.0));
        let middle = Vector3::new(lambda, 0.0, 0.0);
        let scaling = Scaling { inverse: diagonal(1.0 / root), matrix: diagonal(root), square: diagonal(z / x), middle };
        (x > 0.0 && z > 0.0 && lambda.is_finite() && root.is_finite() && root > 0.0).then_some(scaling)
    }

    /// Of a pair inside of the cone of so many rows; the rows beyond are zero in both.
    pub(crate) fn round(x: &Vector3<f64>, z: &Vector3<f64>, rows: usize) -> Option<Self> {
        if rows == 1 {
            return Scaling::half_line(x[0], z[0]);
        }
        let (det_x, det_z) = (determinant(x), determinant(z));
        if !(det_x > 0.0 && det_z > 0.0 && x[0] > 0.0 && z[0] > 0.0) {
            return None;
        }
        let (unit_x, unit_z) = (x / det_x.sqrt(), z / det_z.sqrt());
        let gamma = (0.5 * (1.0 + unit_x.dot(&unit_z))).sqrt();
        let mut w = (unit_x + flipped(&unit_z)) / (2.0 * gamma);
        // det w = 1 to the last digit, so that P² and P⁻² stay inverse to each other near the boundary
        w[0] = (1.0 + w[1] * w[1] + w[2] * w[2]).sqrt();
        let v = (w + Vector3::x()) / (2.0 * (w[0] + 1.0)).sqrt();
        let beta = (det_x / det_z).sqrt().sqrt();
        let j = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
        let matrix = (v * v.transpose() * 2.0 - j) * beta;
        let inverse = (flipped(&v) * flipped(&v).transpose() * 2.0 - j) / beta;
        let square = (flipped(&w) * flipped(&w).transpose() * 2.0 - j) / (beta * beta);
        let middle = matrix * z;
        square.iter().all(|entry| entry.is_finite()).then_some(Scaling { inverse, matrix, square, middle })
    }

    /// λ.
    pub(crate) fn middle(&self) -> Vector3<f64> {
        self.middle
    }

    /// P⁻².
    pub(crate) fn inverse_square(&self) -> Matrix3<f64> {
        self.square
    }

    /// P²; zero in rows that a half line has not.
    pub(crate) fn square(&self) -> Matrix3<f64> {
        self.matrix * self.matrix
    }

    /// P⁻¹ c.
    pub(crate) fn unscaled(&self, c: &Vector3<f64>) -> Vector3<f64> {
        self.inverse * c
    }

    /// The c with λ ∘ c = g e − λ∘λ − (P⁻¹dx)∘(P dz).
    pub(crate) fn corrector(&self, gap: f64, dx: &Vector3<f64>, dz: &Vector3<f64>) -> Vector3<f64> {
        let crossed = product(&(self.inverse * dx), &(self.matrix * dz));
        quotient(&self.middle, &(Vector3::new(gap, 0.0, 0.0) - crossed)) - self.middle
    }

    /// What is added to c so that the two roots of P⁻¹x ∘ P z, w_n ± ‖w_t‖, come back to between a part of the gap and as many times it: a
    /// root that is too large by no more than the latter.
    pub(crate) fn recentring(&self, gap: f64, x: &Vector3<f64>, z: &Vector3<f64>) -> Vector3<f64> {
        let w = product(&(self.inverse * x), &(self.matrix * z));
        let (least, most) = (MIDDLE * gap, gap / MIDDLE);
        let back = |root: f64| (root.clamp(least, most) - root).max(-most);
        let tangential = w[1].hypot(w[2]);
        let [large, small] = [back(w[0] + tangential), back(w[0] - tangential)];
        let along = if tangential > 0.0 { 0.5 * (large - small) / tangential } else { 0.0 };
        quotient(&self.middle, &Vector3::new(0.5 * (large + small), along * w[1], along * w[2]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn the_scaling_takes_both_points_to_one() {
        for (x, z) in [
            (Vector3::new(1.0, 0.3, -0.5), Vector3::new(2.0, -1.5, 0.4)),
            (Vector3::new(5.0, 4.9, 0.0), Vector3::new(0.3, 0.1, 0.28)),
            (Vector3::new(1e-6, 0.0, 0.0), Vector3::new(3.0, 2.0, 1.0)),
        ] {
            let scaling = Scaling::round(&x, &z, 3).expect("inside");
            let size = rounding(64, (scaling.matrix * z).amax() * scaling.matrix.amax() * scaling.inverse.amax());
            assert!((scaling.matrix * z - scaling.inverse * x).amax() <= size);
            assert!((scaling.inverse * scaling.inverse - scaling.square).amax() <= rounding(64, scaling.square.amax() * 8.0));
            assert!(
                (scaling.matrix * scaling.inverse - Matrix3::identity()).amax()
                    <= rounding(64, scaling.matrix.amax() * scaling.inverse.amax())
            );
        }
        assert!(Scaling::round(&Vector3::new(1.0, 1.0, 0.0), &Vector3::x(), 3).is_none(), "on the boundary");
    }

    #[test]
    fn what_is_in_the_middle_is_left_there_and_what_is_not_comes_back() {
        let (x, z) = (Vector3::new(1.0, 0.3, -0.5), Vector3::new(2.0, -1.5, 0.4));
        let scaling = Scaling::round(&x, &z, 3).expect("inside");
        let products = product(&scaling.middle, &scaling.middle);
        let roots = |w: &Vector3<f64>| [w[0] + w[1].hypot(w[2]), w[0] - w[1].hypot(w[2])];
        let [large, small] = roots(&products);
        // both roots may stay: nothing is added; a gap for which the small one is too small and one for which the large one is too large
        let added = |gap: f64| product(&scaling.middle, &scaling.recentring(gap, &x, &z));
        let close = |a: f64, b: f64| (a - b).abs() <= rounding(256, large / small);
        assert_eq!(added((large * small).sqrt()), Vector3::zeros());
        let [raised, cut] = [20.0 * small, 0.08 * large].map(|gap| roots(&(products + added(gap))));
        assert!(close(raised[0], large) && close(raised[1], MIDDLE * 20.0 * small), "{raised:?}");
        assert!(close(cut[0], 0.08 * large / MIDDLE) && close(cut[1], small.max(MIDDLE * 0.08 * large)), "{cut:?}");
        // one that is far too large comes back by as much as may stay
        let far = roots(&(products + added(0.01 * large)));
        assert!(close(far[0], large - 0.01 * large / MIDDLE), "{far:?}");
    }

    #[test]
    fn quotient_undoes_the_product_and_steps_end_on_the_boundary() {
        let (x, z) = (Vector3::new(1.0, 0.3, -0.5), Vector3::new(-2.0, 1.5, 0.4));
        assert!((quotient(&x, &product(&x, &z)) - z).amax() <= rounding(32, 8.0));
        for dx in [Vector3::new(-1.0, 0.0, 0.0), Vector3::new(0.0, 3.0, 1.0), Vector3::new(1.0, -4.0, 0.0), Vector3::new(-2.0, 0.1, 0.1)] {
            let alpha = to_boundary(&x, &dx);
            assert!(alpha > 0.0 && determinant(&(x + dx * alpha)).abs() <= rounding(64, 8.0 * (1.0 + alpha) * (1.0 + alpha)), "{dx}");
        }
        assert_eq!(to_boundary(&x, &Vector3::new(1.0, 0.5, 0.5)), f64::INFINITY);
    }
}
