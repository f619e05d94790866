//! Declared damping of free bodies: v̇ = g − c v, ω̇ = −c ω.
//!
//! ```text
//!     v(t) = e^{−ct} v₀ + (1 − e^{−ct})/c · g ,     x(t) − x₀ = (1 − e^{−ct})/c · v₀ + (t − (1 − e^{−ct})/c)/c · g .
//! ```

use crate::model::Model;
use nalgebra::Vector3;

impl Model {
    /// Declared (linear, angular) damping \[1/s\], where it is not zero.
    pub fn damping(&self) -> Option<(f64, f64)> {
        match self {
            Model::Coulomb(limits) if limits.linear_damping > 0.0 || limits.angular_damping > 0.0 => {
                Some((limits.linear_damping, limits.angular_damping))
            }
            _ => None,
        }
    }
}

/// Displacement \[m\] and velocity \[m/s\] after a time t \[s\] from v₀ under g and the damping c \[1/s\]; c = 0 is free flight.
pub fn flight(damping: f64, gravity: &Vector3<f64>, velocity: &Vector3<f64>, time: f64) -> (Vector3<f64>, Vector3<f64>) {
    if damping == 0.0 {
        return (velocity * time + gravity * (0.5 * time * time), velocity + gravity * time);
    }
    let effective = -(-damping * time).exp_m1() / damping;
    (velocity * effective + gravity * ((time - effective) / damping), velocity * (-damping * time).exp() + gravity * effective)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_damping_tends_to_free_flight_and_large_time_to_the_terminal_velocity() {
        let (gravity, velocity) = (Vector3::new(0.0, 0.0, -9.81), Vector3::new(3.0, 0.0, 4.0));
        let [free, damped] = [0.0, 1e-6].map(|damping| flight(damping, &gravity, &velocity, 0.6));
        // v̇ differs by at most c(|v₀| + g t).
        assert!((free.1 - damped.1).norm() <= 1e-6 * 0.6 * 11.0 && (free.0 - damped.0).norm() <= 1e-6 * 0.36 * 11.0);
        let (_, terminal) = flight(2.0, &gravity, &velocity, 100.0);
        assert!((terminal - gravity / 2.0).norm() <= moreau_exact::tolerance::rounding(16, 10.0));
    }
}
