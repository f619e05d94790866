//! A rectangular block that rocks on its edges without sliding (Housner).
//!
//! ```text
//!     width 2b, height 2c,  R² = b² + c²,  sin α = b/R,  I_edge = 4/3 m R²,  p² = m g R/I_edge = 3 g/(4 R)
//!     tilt θ on one edge      θ̈ = −p² sin(α − θ) ,    ½ θ̇² + p² cos(α − θ) constant
//!     landing                 ω⁺/ω⁻ = 1 − 3/2 sin²α    angular momentum about the edge that is hit
//! ```
//! The landing's ratio: the spin about the centre and the centre's motion about the new edge, I_c ω⁻ + m (c² − b²) ω⁻ = I_edge ω⁺ with
//! I_c = m R²/3. It is exact for every block that leaves the old edge, sin²α < 2/3, on a floor that holds the new one,
//! μ ≥ c (1 − r)/(b (1 + r)), r = ω⁺/ω⁻. On a smooth floor the plastic impact leaves ω⁺/ω⁻ = (c² − 2b²)/(c² + 4b²): [`landing`].

use moreau_exact::{Error, Result};

/// A block of half width b, half height c under gravity g.
///
/// # Source
/// Housner, *The behavior of inverted pendulum structures during earthquakes* (1963).
///
/// ```
/// use moreau_forms::RockingBlock;
///
/// let block = RockingBlock::new(0.5, 1.0, 9.81)?; // half width, half height, g
/// assert!((block.landing_ratio() - 0.7).abs() < 1e-12); // 1 − 3/2 · 1/5
/// assert!(RockingBlock::new(1.0, 0.5, 9.81).is_err()); // too flat: it lands on its whole base
/// # Ok::<(), moreau_exact::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RockingBlock {
    half_width: f64,
    half_height: f64,
    gravity: f64,
}

impl RockingBlock {
    /// Half width b \[m\], half height c \[m\], gravity g \[m/s²\].
    ///
    /// # Errors
    /// [`Error::Invalid`] if one is not positive, or b²/(b² + c²) ≥ 2/3: then the block stops on its whole base.
    pub fn new(half_width: f64, half_height: f64, gravity: f64) -> Result<Self> {
        for (field, value) in [("half_width", half_width), ("half_height", half_height), ("gravity", gravity)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::invalid(field, format!("is {value}"), "use a positive number"));
            }
        }
        let block = RockingBlock { half_width, half_height, gravity };
        if block.landing_ratio() <= 0.0 {
            return Err(Error::invalid("half_width", "makes the block land on its whole base", "use a slenderer block, b² < 2 c²"));
        }
        Ok(block)
    }

    /// R \[m\], from an edge to the centre.
    pub fn radius(&self) -> f64 {
        self.half_width.hypot(self.half_height)
    }

    /// α \[rad\], the tilt at which the centre is above the edge.
    pub fn slenderness(&self) -> f64 {
        self.half_width.atan2(self.half_height)
    }

    /// p² = 3 g/(4 R) \[1/s²\].
    pub fn frequency_squared(&self) -> f64 {
        0.75 * self.gravity / self.radius()
    }

    /// ω⁺/ω⁻ = 1 − 3/2 sin²α at a landing.
    pub fn landing_ratio(&self) -> f64 {
        let sine = self.half_width / self.radius();
        1.0 - 1.5 * sine * sine
    }

    /// The height the centre gains by a tilt θ, over R: cos(α − θ) − cos α.
    pub fn lift(&self, tilt: f64) -> f64 {
        // cos x − cos y = 2 sin((x + y)/2) sin((y − x)/2) does not cancel for small tilts.
        2.0 * (self.slenderness() - 0.5 * tilt).sin() * (0.5 * tilt).sin()
    }

    /// Angular speed \[rad/s\] at the landing of a block released at a tilt with this speed towards the ground: ω² = ω₀² + 2 p² lift.
    pub fn landing_speed(&self, tilt: f64, speed: f64) -> f64 {
        (speed * speed + 2.0 * self.frequency_squared() * self.lift(tilt)).sqrt()
    }

    /// Time \[s\] from rest at a tilt θ₀ < α to the landing, ∫ dθ/√(2p²(lift θ₀ − lift θ)).
    ///
    /// With θ = θ₀ (1 − s²) the integrand is smooth; Simpson's rule on `NODES` intervals.
    pub fn fall_time(&self, tilt: f64) -> f64 {
        /// Even; the fourth-order error at 1/1024 is below 1e-12 for tilts up to 0.9 α.
        const NODES: usize = 1024;
        let rate = (2.0 * self.frequency_squared()).sqrt();
        let lost = |s: f64| {
            // lift θ₀ − lift θ = cos(α − θ₀) − cos(α − θ), over s².
            let fallen = tilt * s * s;
            let angle = self.slenderness() - tilt + 0.5 * fallen;
            let half = 0.5 * fallen;
            let sine = if half > 0.0 { half.sin() / half } else { 1.0 };
            angle.sin() * tilt * sine
        };
        let integrand = |s: f64| 2.0 * tilt / (rate * lost(s).sqrt());
        let step = 1.0 / NODES as f64;
        let weight = |k: usize| {
            if k == 0 || k == NODES {
                1.0
            } else if k % 2 == 1 {
                4.0
            } else {
                2.0
            }
        };
        (0..=NODES).map(|k| weight(k) * integrand(k as f64 * step)).sum::<f64>() * step / 3.0
    }
}

/// Landings of a block with half width b and half height c, e = 0, in any ordered field.
pub mod landing {
    use moreau_exact::scalar::Scalar;

    /// ω⁺/ω⁻ if the new edge neither slips nor rebounds, 1 − 3/2 b²/(b² + c²).
    pub fn pivoting<T: Scalar>(b: &T, c: &T) -> T {
        let [b, c] = [b.clone() * b.clone(), c.clone() * c.clone()];
        T::one() - T::ratio(3, 2) * b.clone() / (b + c)
    }

    /// The least μ with which the new edge does not slip, |P_t|/P_n = c (1 − r)/(b (1 + r)): the impulses m c (1 − r)|ω⁻| and m b (1 +
    /// r)|ω⁻| turn the velocity of the centre from that about the old edge to that about the new one.
    pub fn least_friction<T: Scalar>(b: &T, c: &T) -> T {
        let ratio = pivoting(b, c);
        c.clone() * (T::one() - ratio.clone()) / (b.clone() * (T::one() + ratio))
    }

    /// ω⁺/ω⁻ on a smooth floor, (c² − 2b²)/(c² + 4b²), which is W_AB/W_BB; the old edge leaves the floor if it is positive.
    pub fn smooth<T: Scalar>(b: &T, c: &T) -> T {
        let [b, c] = [b.clone() * b.clone(), c.clone() * c.clone()];
        (c.clone() - T::ratio(2, 1) * b.clone()) / (c + T::ratio(4, 1) * b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    /// sin α = 3/5, R = 5 m.
    fn block() -> RockingBlock {
        RockingBlock::new(3.0, 4.0, 9.81).expect("slender")
    }

    #[test]
    fn the_landing_keeps_the_angular_momentum_about_the_new_edge() {
        // Centre at (−b, c) from the new edge with velocity ω (c, −b): L = I_c ω + m ω (c² − b²), I_c = R²/3, I_edge = 4 R²/3.
        let (b, c) = (3.0f64, 4.0f64);
        let before = (b * b + c * c) / 3.0 + c * c - b * b;
        let ratio = before / (4.0 * (b * b + c * c) / 3.0);
        assert!((block().landing_ratio() - ratio).abs() <= rounding(8, 1.0));
        assert!((block().landing_ratio() - 0.46).abs() <= rounding(8, 1.0));
    }

    #[test]
    fn a_block_too_wide_to_rock_is_refused_on_its_side_of_the_boundary() {
        let wide = 2f64.sqrt();
        assert!(RockingBlock::new(wide * 1.001, 1.0, 9.81).is_err() && RockingBlock::new(wide * 0.999, 1.0, 9.81).is_ok());
    }

    #[test]
    fn small_tilts_fall_in_the_time_of_the_linear_equation() {
        // Slender and θ ≪ α: θ̈ = −p² (α − θ) gives cosh p t = α/(α − θ₀); sin x differs from x by x³/6.
        let block = RockingBlock::new(0.01, 1.0, 9.81).expect("slender");
        let (alpha, p) = (block.slenderness(), block.frequency_squared().sqrt());
        for part in [0.1, 0.5, 0.9] {
            let linear = f64::acosh(1.0 / (1.0 - part)) / p;
            let time = block.fall_time(part * alpha);
            assert!((time / linear - 1.0).abs() <= alpha * alpha, "{time} against {linear}");
        }
    }

    #[test]
    fn the_fall_time_is_that_of_the_differential_equation() {
        let (block, tilt, h) = (block(), 0.3, 1.0 / 4096.0);
        let (mut theta, mut omega, mut time) = (tilt, 0.0, 0.0);
        let acceleration = |theta: f64| -block.frequency_squared() * (block.slenderness() - theta).sin();
        while theta > 0.0 {
            // Störmer–Verlet, second order: error h²/24 · p² t relative.
            let half = omega + 0.5 * h * acceleration(theta);
            theta += h * half;
            omega = half + 0.5 * h * acceleration(theta);
            time += h;
        }
        time += theta / omega.abs();
        assert!((time - block.fall_time(tilt)).abs() <= h * h, "{time} against {}", block.fall_time(tilt));
        assert!((omega.abs() - block.landing_speed(tilt, 0.0)).abs() <= h);
    }
}
