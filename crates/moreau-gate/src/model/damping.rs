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

/// Velocity \[m/s\] after a time t \[s\] from v₀ under a constant acceleration \[m/s²\] and the damping c \[1/s\], along a line.
pub fn driven(damping: f64, acceleration: f64, velocity: f64, time: f64) -> f64 {
    flight(damping, &Vector3::new(acceleration, 0.0, 0.0), &Vector3::new(velocity, 0.0, 0.0), time).1.x
}

/// Apex \[m\] of a ball that was dropped from a height H \[m\] and left the floor with e times its speed: with c > 0 the fall lasts t,
/// where H = g (t − (1 − e^{−ct})/c)/c, and the rise from v reaches (v − g/c · ln(1 + c v/g))/c.
pub fn apex(damping: f64, gravity: f64, height: f64, restitution: f64) -> f64 {
    if damping == 0.0 {
        return restitution * restitution * height;
    }
    let down = Vector3::new(-gravity, 0.0, 0.0);
    let fallen = |time: f64| -flight(damping, &down, &Vector3::zeros(), time).0.x;
    // Damping makes the fall longer, but a body at its terminal speed g/c falls H within H c/g.
    let (mut early, mut late) = (0.0, (2.0 * height / gravity).sqrt() + height * damping / gravity + 1.0 / damping);
    while late - early > f64::EPSILON * late {
        let middle = 0.5 * (early + late);
        if middle <= early || middle >= late {
            break;
        }
        if fallen(middle) < height { early = middle } else { late = middle }
    }
    let leaving = -restitution * driven(damping, -gravity, 0.0, late);
    (leaving - gravity / damping * (damping * leaving / gravity).ln_1p()) / damping
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_apex_tends_to_that_without_damping_and_is_where_the_flight_ends() {
        let none = apex(0.0, 9.81, 5.0, 0.5);
        assert_eq!(none, 1.25);
        // The first order of the loss: ¾ of c t per flight of t = 1 s, at most.
        assert!((apex(1e-6, 9.81, 5.0, 0.5) - none).abs() <= 1e-5);
        let damped = apex(0.5, 9.81, 5.0, 1.0);
        let (down, mut time, mut state) = (Vector3::new(-9.81, 0.0, 0.0), 0.0, (5.0, 0.0));
        // A flight in small steps of the same formula, which reverses at the floor.
        let mut highest: f64 = 0.0;
        while time < 2.2 {
            let (moved, velocity) = flight(0.5, &down, &Vector3::new(state.1, 0.0, 0.0), 1e-4);
            state = (state.0 + moved.x, velocity.x);
            if state.0 < 0.0 && state.1 < 0.0 {
                state.1 = -state.1;
                highest = 0.0;
            }
            highest = highest.max(state.0);
            time += 1e-4;
        }
        assert!((damped - highest).abs() <= 2e-3, "{damped} {highest}");
    }

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
