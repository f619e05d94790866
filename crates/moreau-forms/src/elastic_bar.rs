//! A linearly elastic bar, moving at −V along its axis, hits a rigid wall: ρ ü = E u″, stress σ = E u′.
//!
//! ```text
//!     c = √(E/ρ) ,   x = 0 the striking end, x = L the free one
//!     0 < t < L/c      behind the front, x < c t:      u̇ = 0 ,   σ = −ρ c V ;     ahead:  u̇ = −V ,  σ = 0
//!     L/c < t < 2L/c   the release wave, x > 2L − c t: u̇ = +V ,  σ = 0 ;          ahead:  u̇ = 0 ,   σ = −ρ c V
//!     t > 2L/c         u̇ = +V everywhere, σ = 0 :  contact ends, no vibration is left, e = 1
//!     contact force    ρ c A V while 0 < t < 2L/c ;   impulse 2 ρ A L V
//! ```
//! The force is constant and jumps at both ends: a finite force over a finite time, where the rigid body has an impulse.

use moreau_exact::{Error, Result};

/// A bar and its speed towards the wall.
///
/// # Source
/// Saint-Venant (1867); Doyen, Ern and Piperno, *Time-integration schemes for the finite element dynamic Signorini problem* (2011), §4.
///
/// ```
/// use moreau_forms::ElasticBar;
///
/// let bar = ElasticBar::new(1.0, 1000.0, 1e9, 0.01, 2.0)?; // L, ρ, E, A, V
/// assert_eq!((bar.wave_speed(), bar.contact_time()), (1000.0, 0.002));
/// let (impulse, momentum) = (bar.contact_force() * bar.contact_time(), bar.mass() * bar.speed);
/// assert!((impulse - 2.0 * momentum).abs() < 1e-9); // it leaves as fast as it came
/// # Ok::<(), moreau_exact::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticBar {
    /// L \[m\].
    pub length: f64,
    /// ρ \[kg/m³\].
    pub density: f64,
    /// E \[Pa\].
    pub modulus: f64,
    /// A \[m²\].
    pub area: f64,
    /// V > 0 \[m/s\], towards the wall.
    pub speed: f64,
}

impl ElasticBar {
    /// L, ρ, E, A and V.
    ///
    /// # Errors
    /// If one of them is not positive and finite.
    pub fn new(length: f64, density: f64, modulus: f64, area: f64, speed: f64) -> Result<Self> {
        for (field, value) in [("length", length), ("density", density), ("modulus", modulus), ("area", area), ("speed", speed)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::invalid(field, format!("is {value}"), "use a positive number"));
            }
        }
        Ok(ElasticBar { length, density, modulus, area, speed })
    }

    /// c \[m/s\].
    pub fn wave_speed(&self) -> f64 {
        (self.modulus / self.density).sqrt()
    }

    /// 2L/c \[s\].
    pub fn contact_time(&self) -> f64 {
        2.0 * self.length / self.wave_speed()
    }

    /// ρ c A V \[N\] during contact.
    pub fn contact_force(&self) -> f64 {
        self.density * self.wave_speed() * self.area * self.speed
    }

    /// ρ A L \[kg\].
    pub fn mass(&self) -> f64 {
        self.density * self.area * self.length
    }

    /// Force of the wall at a time t after the bar touched \[N\].
    pub fn force(&self, time: f64) -> f64 {
        if 0.0 < time && time < self.contact_time() { self.contact_force() } else { 0.0 }
    }

    /// Displacement \[m\] of the point x at a time t after the bar touched: d'Alembert's.
    pub fn displacement(&self, place: f64, time: f64) -> f64 {
        let c = self.wave_speed();
        // a point moves at −V until the front arrives at x/c, rests until the release at (2L − x)/c, then moves at +V
        let (front, release) = (place / c, (2.0 * self.length - place) / c);
        self.speed * (-time.min(front) + (time - release).max(0.0))
    }

    /// Velocity \[m/s\] and stress \[Pa\] of the point x at a time t after the bar touched.
    pub fn state(&self, place: f64, time: f64) -> (f64, f64) {
        let c = self.wave_speed();
        if time < place / c {
            (-self.speed, 0.0)
        } else if time < (2.0 * self.length - place) / c {
            (0.0, -self.density * c * self.speed)
        } else {
            (self.speed, 0.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    fn bar() -> ElasticBar {
        ElasticBar::new(2.0, 3.0, 48.0, 0.5, 0.25).expect("valid")
    }

    #[test]
    fn the_impulse_turns_the_momentum_round() {
        let bar = bar();
        let impulse = bar.contact_force() * bar.contact_time();
        assert!((impulse - 2.0 * bar.mass() * bar.speed).abs() <= rounding(16, impulse));
    }

    #[test]
    fn energy_is_half_kinetic_and_half_elastic_when_the_front_is_half_way_and_all_kinetic_at_the_end() {
        let bar = bar();
        let cells = 4000;
        let energy = |time: f64| -> f64 {
            let width = bar.length / f64::from(cells);
            let of = |k: i32| {
                let (v, stress) = bar.state((f64::from(k) + 0.5) * width, time);
                0.5 * bar.area * width * (bar.density * v * v + stress * stress / bar.modulus)
            };
            (0..cells).map(of).sum()
        };
        let total = 0.5 * bar.mass() * bar.speed * bar.speed;
        for part in [0.1, 0.5, 0.9, 1.1] {
            assert!((energy(part * bar.contact_time()) - total).abs() <= rounding(2 * cells as usize, total));
        }
    }

    #[test]
    fn the_displacement_is_continuous_and_its_slopes_are_velocity_and_strain() {
        let bar = bar();
        let step = 1.0 / 1024.0;
        for (place, time) in [(0.5, 0.05), (0.5, 0.3), (1.5, 0.7), (1.0, 0.9), (0.5, 1.2)] {
            let (velocity, stress) = bar.state(place, time);
            let rate = (bar.displacement(place, time + step) - bar.displacement(place, time - step)) / (2.0 * step);
            let strain = (bar.displacement(place + step, time) - bar.displacement(place - step, time)) / (2.0 * step);
            assert!((rate - velocity).abs() <= rounding(16, 1.0) / step, "{place} {time}");
            assert!((bar.modulus * strain - stress).abs() <= rounding(16, 48.0) / step, "{place} {time}");
        }
        for time in [0.1, 0.6, 0.9] {
            assert_eq!(bar.displacement(0.0, time), 0.0, "the end stays on the wall");
        }
        assert!(bar.displacement(0.0, 1.25) > 0.0 && bar.force(0.5) == bar.contact_force() && bar.force(1.25) == 0.0);
    }
}
