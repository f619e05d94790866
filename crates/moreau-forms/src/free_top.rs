//! A rigid body that turns freely: J Ω̇ = −Ω × J Ω in the body frame, Ṙ = R \[Ω\]×.
//!
//! ```text
//!     constants    ½ Ωᵀ J Ω ,     R J Ω  (angular momentum, world) ;
//!     about the middle axis a small disturbance grows like e^{λt} ,  λ = |Ω₂| √( (J₃−J₂)(J₂−J₁)/(J₁J₃) ) .
//! ```
//! Integrated by the classical Runge–Kutta method on the unit quaternion and Ω together; its error per step is (s‖Ω‖)⁵/120, far below
//! the first order errors it is compared with.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// The principal moments J \[kg·m²\] of a free body, in the order of its axes.
///
/// # Source
/// Landau and Lifshitz, *Mechanics*, §36 and §37.
///
/// ```
/// use moreau_forms::free_top::FreeTop;
/// use nalgebra::Vector3;
///
/// let top = FreeTop { moments: Vector3::new(1.0, 2.0, 3.0) };
/// assert_eq!(top.body_acceleration(&Vector3::y()), Vector3::zeros()); // a principal axis: it goes on turning
/// assert_eq!(top.body_acceleration(&Vector3::new(1.0, 1.0, 0.0)).z, -1.0 / 3.0); // (J₁ − J₂) Ω₁Ω₂/J₃
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeTop {
    /// J.
    pub moments: Vector3<f64>,
}

/// Orientation and spin at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spin {
    /// R, body to world.
    pub orientation: UnitQuaternion<f64>,
    /// Ω \[rad/s\], body frame.
    pub body_rate: Vector3<f64>,
}

impl Spin {
    /// ω = R Ω \[rad/s\], world frame.
    pub fn angular_velocity(&self) -> Vector3<f64> {
        self.orientation * self.body_rate
    }
}

impl FreeTop {
    /// Ω̇ = J⁻¹(J Ω × Ω) \[rad/s²\], body frame.
    pub fn body_acceleration(&self, rate: &Vector3<f64>) -> Vector3<f64> {
        self.moments.component_mul(rate).cross(rate).component_div(&self.moments)
    }

    /// ½ Ωᵀ J Ω \[J\].
    pub fn energy(&self, spin: &Spin) -> f64 {
        0.5 * spin.body_rate.dot(&self.moments.component_mul(&spin.body_rate))
    }

    /// R J Ω \[kg·m²/s\], world frame.
    pub fn momentum(&self, spin: &Spin) -> Vector3<f64> {
        spin.orientation * self.moments.component_mul(&spin.body_rate)
    }

    /// The motion over `time` \[s\] in `parts` equal steps, both ends included.
    pub fn path(&self, start: Spin, time: f64, parts: usize) -> Vec<Spin> {
        let step = time / parts as f64;
        let mut path = vec![start];
        for k in 0..parts {
            path.push(self.runge_kutta(&path[k], step));
        }
        path
    }

    fn runge_kutta(&self, spin: &Spin, step: f64) -> Spin {
        let slope = |q: Quaternion<f64>, rate: Vector3<f64>| (q * Quaternion::from_imag(rate) * 0.5, self.body_acceleration(&rate));
        let (q, rate) = (spin.orientation.into_inner(), spin.body_rate);
        let (q1, r1) = slope(q, rate);
        let (q2, r2) = slope(q + q1 * (0.5 * step), rate + r1 * (0.5 * step));
        let (q3, r3) = slope(q + q2 * (0.5 * step), rate + r2 * (0.5 * step));
        let (q4, r4) = slope(q + q3 * step, rate + r3 * step);
        Spin {
            orientation: UnitQuaternion::from_quaternion(q + (q1 + (q2 + q3) * 2.0 + q4) * (step / 6.0)),
            body_rate: rate + (r1 + (r2 + r3) * 2.0 + r4) * (step / 6.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::{TOP_STEPS, top_reference};

    const TOP: FreeTop = FreeTop { moments: Vector3::new(0.13 / 3.0, 0.1 / 3.0, 0.05 / 3.0) };

    fn start(rate: [f64; 3]) -> Spin {
        Spin { orientation: UnitQuaternion::from_euler_angles(0.3, -0.2, 0.9), body_rate: Vector3::from(rate) }
    }

    #[test]
    fn energy_and_angular_momentum_in_space_are_constants() {
        let start = start([1.0, 3.0, 1.0]);
        let path = TOP.path(start, 0.4, TOP_STEPS);
        let bound = top_reference(0.4, 4.0);
        for spin in &path {
            assert!((TOP.energy(spin) / TOP.energy(&start) - 1.0).abs() <= 2.0 * bound);
            assert!((TOP.momentum(spin) - TOP.momentum(&start)).norm() <= 2.0 * bound * TOP.momentum(&start).norm());
        }
    }

    #[test]
    fn the_period_about_the_middle_axis_is_jacobis() {
        // Released with 2E J₂ > ‖L‖² or below, Ω₂ = a₂ sn(p t + K): a quarter period K(k)/p by the arithmetic–geometric mean.
        let moments = TOP.moments;
        let start = Spin { orientation: UnitQuaternion::identity(), body_rate: Vector3::new(1.0, 0.0, 2.0) };
        let (twice, square) = (2.0 * TOP.energy(&start), TOP.momentum(&start).norm_squared());
        let [largest, middle, smallest] = [moments[0], moments[1], moments[2]];
        assert!(square < twice * middle, "around the axis of the smallest moment");
        let rate = ((largest * twice - square) * (middle - smallest) / (largest * middle * smallest)).sqrt();
        let modulus = ((largest - middle) * (square - smallest * twice) / ((largest * twice - square) * (middle - smallest))).sqrt();
        let quarter = std::f64::consts::FRAC_PI_2 / mean(1.0, (1.0 - modulus * modulus).sqrt()) / rate;
        let end = *TOP.path(start, 4.0 * quarter, 8 * TOP_STEPS).last().expect("a path has an end");
        assert!((end.body_rate - start.body_rate).norm() <= 8.0 * top_reference(4.0 * quarter, 2.5));
        let half = *TOP.path(start, 2.0 * quarter, 8 * TOP_STEPS).last().expect("a path has an end");
        assert!((half.body_rate - Vector3::new(-1.0, 0.0, 2.0)).norm() <= 8.0 * top_reference(4.0 * quarter, 2.5));
    }

    fn mean(a: f64, b: f64) -> f64 {
        if (a - b).abs() <= 1e-15 * a { a } else { mean(0.5 * (a + b), (a * b).sqrt()) }
    }

    #[test]
    fn a_disturbance_about_the_middle_axis_grows_at_its_rate() {
        let [j1, j2, j3] = [TOP.moments[0], TOP.moments[1], TOP.moments[2]];
        let growth = 3.0 * ((j1 - j2) * (j2 - j3) / (j1 * j3)).sqrt();
        // On the unstable direction Ω₁ : Ω₃ = √((J₂−J₃)J₃) : √((J₁−J₂)J₁) the disturbance is a pure exponential, sign by Euler's equations.
        let ratio = [((j2 - j3) * j3).sqrt(), -((j1 - j2) * j1).sqrt()];
        let tiny = 1e-6;
        let along = |sign: f64| start([tiny * ratio[0], 3.0, sign * tiny * ratio[1]]);
        let grown = [1.0, -1.0].map(|sign| {
            let end = *TOP.path(along(sign), 1.0, TOP_STEPS).last().expect("a path has an end");
            end.body_rate[0] / (tiny * ratio[0])
        });
        let closest = grown.iter().map(|ratio| (ratio / growth.exp() - 1.0).abs()).fold(f64::INFINITY, f64::min);
        assert!(closest <= 1e-6, "{grown:?} against {}", growth.exp());
    }
}
