//! A block on an incline with Coulomb friction: ẍ = g sin α − μ g cos α · sign(ẋ), x down the slope.
//!
//! ```text
//!     sliding down  a = g (sin α − μ cos α) ,   sliding up  a = g (sin α + μ cos α) ,
//!     at rest it stays at rest iff tan α ≤ μ .
//! ```

use moreau_exact::{Error, Result};

/// A block that starts at x = 0 with a velocity along the slope.
///
/// # Source
/// Coulomb's law; chapter §5 for the sticking and the sliding block.
///
/// ```
/// use moreau_forms::InclineBlock;
///
/// let slope = 20f64.to_radians();
/// let slides = InclineBlock::new(9.81, slope, 0.3, 0.0)?; // g, α, μ, v₀
/// assert!(!slides.sticks() && (slides.acceleration(1.0) - 0.5897).abs() < 1e-4);
/// assert!(InclineBlock::new(9.81, slope, 0.5, 0.0)?.sticks()); // tan 20° = 0.364 ≤ μ
/// # Ok::<(), moreau_exact::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InclineBlock {
    gravity: f64,
    angle: f64,
    friction: f64,
    initial_velocity: f64,
}

impl InclineBlock {
    /// A block under gravity g \[m/s²\] on a slope of `angle` α \[rad\] with friction μ, started with velocity v₀
    /// \[m/s\], positive down the slope.
    ///
    /// # Errors
    /// If g is not positive, α is outside \[0, π/2), μ is negative or a number is not finite.
    pub fn new(gravity: f64, angle: f64, friction: f64, initial_velocity: f64) -> Result<Self> {
        if !(gravity.is_finite() && gravity > 0.0) {
            return Err(Error::invalid("gravity", format!("is {gravity}"), "use a positive number"));
        }
        if !(0.0..std::f64::consts::FRAC_PI_2).contains(&angle) {
            return Err(Error::invalid("angle", format!("is {angle} rad"), "use an angle in [0, π/2)"));
        }
        if !(friction.is_finite() && friction >= 0.0) {
            return Err(Error::invalid("friction", format!("is {friction}"), "use a number ≥ 0"));
        }
        if !initial_velocity.is_finite() {
            return Err(Error::invalid("initial_velocity", format!("is {initial_velocity}"), "use a finite number"));
        }
        Ok(InclineBlock { gravity, angle, friction, initial_velocity })
    }

    /// Whether a block at rest stays at rest: tan α ≤ μ, as sin α ≤ μ cos α.
    pub fn sticks(&self) -> bool {
        self.angle.sin() <= self.friction * self.angle.cos()
    }

    /// g (sin α − μ cos α · sign) \[m/s²\] for sliding down (sign = +1) or up (sign = −1).
    pub fn acceleration(&self, sign: f64) -> f64 {
        self.gravity * (self.angle.sin() - self.friction * self.angle.cos() * sign)
    }

    /// When the initial slide ends, 0 for a block at rest, infinite for one that never stops.
    pub fn stopping_time(&self) -> f64 {
        let v = self.initial_velocity;
        if v == 0.0 {
            return 0.0;
        }
        let acceleration = self.acceleration(v.signum());
        if acceleration * v < 0.0 { -v / acceleration } else { f64::INFINITY }
    }

    /// Distance down the slope and velocity (x, v) at a time t ≥ 0.
    pub fn state(&self, time: f64) -> (f64, f64) {
        let (v, stop) = (self.initial_velocity, self.stopping_time());
        let slide = self.acceleration(if v == 0.0 { 1.0 } else { v.signum() });
        if time < stop {
            return (time * (v + 0.5 * slide * time), v + slide * time);
        }
        let reached = 0.5 * v * stop;
        if self.sticks() {
            return (reached, 0.0);
        }
        let (down, elapsed) = (self.acceleration(1.0), time - stop);
        (reached + 0.5 * down * elapsed * elapsed, down * elapsed)
    }

    /// The corner points (t, v) of the velocity on \[0, `until`\]: it is continuous and piecewise linear.
    pub fn velocity_corners(&self, until: f64) -> Vec<[f64; 2]> {
        let stop = self.stopping_time();
        let mut times = vec![0.0];
        times.extend((0.0 < stop && stop < until).then_some(stop));
        times.push(until);
        times.into_iter().map(|time| [time, self.state(time).1]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::SLOPE_ROUNDING;

    const G: f64 = 9.81;

    fn blocks() -> Vec<InclineBlock> {
        let mut blocks = Vec::new();
        for angle in [0.0, 0.1, 0.349] {
            for friction in [0.0, 0.2, 0.5] {
                for velocity in [-2.0, 0.0, 1.5] {
                    blocks.push(InclineBlock::new(G, angle, friction, velocity).expect("valid"));
                }
            }
        }
        blocks
    }

    #[test]
    fn the_friction_force_obeys_coulombs_law_at_every_time() {
        // Force balance from differences of the velocity, not from the acceleration the formula uses.
        let delta = 1.0 / 1024.0;
        for block in blocks() {
            for k in 1..2000 {
                let time = k as f64 / 512.0;
                if (time - delta..=time + delta).contains(&block.stopping_time()) {
                    continue;
                }
                let acceleration = (block.state(time + delta).1 - block.state(time - delta).1) / (2.0 * delta);
                let friction = acceleration - G * block.angle.sin();
                let bound = block.friction * G * block.angle.cos();
                let slack = SLOPE_ROUNDING / delta;
                let velocity = block.state(time).1;
                assert!(friction.abs() <= bound + slack, "{block:?}");
                if velocity != 0.0 {
                    assert!((friction + bound * velocity.signum()).abs() <= slack, "{block:?} at {time}");
                }
            }
        }
    }

    #[test]
    fn velocity_is_the_derivative_of_position() {
        let delta = 1.0 / 1024.0;
        for block in blocks() {
            for k in 1..500 {
                let time = k as f64 / 128.0;
                if !(time - delta..=time + delta).contains(&block.stopping_time()) {
                    let slope = (block.state(time + delta).0 - block.state(time - delta).0) / (2.0 * delta);
                    assert!((slope - block.state(time).1).abs() <= SLOPE_ROUNDING / delta, "{block:?}");
                }
            }
        }
    }

    #[test]
    fn friction_takes_mu_n_times_the_path_from_the_energy() {
        for block in blocks() {
            for time in [0.3, 1.0, 3.0] {
                let (position, velocity) = block.state(time);
                let turn = block.state(block.stopping_time().min(time)).0;
                let path = turn.abs() + (position - turn).abs();
                let lost = 0.5 * (block.initial_velocity.powi(2) - velocity.powi(2)) + G * block.angle.sin() * position;
                assert!((lost - block.friction * G * block.angle.cos() * path).abs() <= SLOPE_ROUNDING, "{block:?}");
            }
        }
    }

    #[test]
    fn a_block_pushed_up_comes_back_only_if_the_slope_is_steeper_than_friction() {
        let returns = InclineBlock::new(G, 0.4, 0.2, -1.0).expect("valid");
        assert!(returns.state(10.0).1 > 0.0);
        let stays = InclineBlock::new(G, 0.2, 0.4, -1.0).expect("valid");
        assert_eq!(stays.state(10.0).1, 0.0);
        assert!(stays.state(10.0).0 < 0.0);
    }

    #[test]
    fn corners_of_the_velocity_are_where_the_slide_ends() {
        let block = InclineBlock::new(G, 0.0, 0.5, G).expect("valid");
        assert_eq!(block.velocity_corners(4.0), [[0.0, G], [2.0, 0.0], [4.0, 0.0]]);
        assert_eq!(block.velocity_corners(1.0).len(), 2);
    }

    #[test]
    fn numbers_that_cannot_be_meant_are_refused() {
        for (g, angle, mu, v) in
            [(0.0, 0.1, 0.1, 0.0), (G, -0.1, 0.1, 0.0), (G, 1.6, 0.1, 0.0), (G, 0.1, -0.1, 0.0), (G, 0.1, 0.1, f64::NAN)]
        {
            assert!(InclineBlock::new(g, angle, mu, v).is_err());
        }
    }
}
