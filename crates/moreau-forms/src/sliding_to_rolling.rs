//! A disk or sphere from sliding to rolling, on a level floor or a slope.
//!
//! ```text
//!     κ = m R²/I  (disk 2, solid sphere 5/2, hoop 1) ,   w = ω R (speed of the surface) ,   slip u = v − w
//!     sliding   v̇ = g sin α − μ g cos α sign u ,   ẇ = κ μ g cos α sign u
//!     level     rolls from  t = |v₀ − w₀|/((1 + κ) μ g)  on, at  v = w = (κ v₀ + w₀)/(1 + κ)
//!     rolling   v̇ = ẇ = κ/(1 + κ) g sin α ,   possible iff  tan α ≤ (1 + κ) μ
//! ```
//! On a level floor the final speed does not depend on μ: friction acts at the floor, about whose points the angular momentum is kept.

use moreau_exact::scalar::Scalar;
use moreau_exact::{Error, Result};

/// κ v₀ + w₀ over 1 + κ, the speed at which a body rolls on a level floor, in any ordered field.
///
/// ```
/// use moreau_exact::scalar::ratio;
/// use moreau_forms::sliding_to_rolling::rolling_speed;
///
/// // a solid sphere that slides at 7 m/s without spin ends at five sevenths of it, whatever μ is
/// assert_eq!(rolling_speed(&ratio(5, 2), &ratio(7, 1), &ratio(0, 1)), ratio(5, 1));
/// ```
pub fn rolling_speed<T: Scalar>(turning: &T, speed: &T, surface: &T) -> T {
    (turning.clone() * speed.clone() + surface.clone()) / (T::one() + turning.clone())
}

/// A round body on a plane.
///
/// # Source
/// Coriolis (1835); the equations of the header.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingToRolling {
    /// κ = m R²/I.
    pub turning: f64,
    /// μ.
    pub friction: f64,
    /// g cos α \[m/s²\].
    pub press: f64,
    /// g sin α \[m/s²\], along +v.
    pub pull: f64,
    /// v₀ \[m/s\].
    pub speed: f64,
    /// w₀ = ω₀ R \[m/s\].
    pub surface: f64,
}

/// Distance, speed and surface speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingState {
    /// Distance travelled \[m\].
    pub distance: f64,
    /// v \[m/s\].
    pub speed: f64,
    /// w = ω R \[m/s\].
    pub surface: f64,
}

impl SlidingToRolling {
    /// A body on a slope of angle α \[rad\] under gravity g.
    ///
    /// # Errors
    /// If κ, μ or g is not positive, or α is outside (−π/2, π/2).
    pub fn new(turning: f64, friction: f64, gravity: f64, angle: f64, speed: f64, surface: f64) -> Result<Self> {
        for (field, value) in [("turning", turning), ("friction", friction), ("gravity", gravity)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::invalid(field, format!("is {value}"), "use a positive number"));
            }
        }
        if angle.is_nan() || angle.abs() >= std::f64::consts::FRAC_PI_2 || !(speed + surface).is_finite() {
            return Err(Error::invalid("angle", format!("is {angle} rad"), "use an angle in (−π/2, π/2) and finite speeds"));
        }
        Ok(SlidingToRolling { turning, friction, press: gravity * angle.cos(), pull: gravity * angle.sin(), speed, surface })
    }

    /// Whether the slope lets the body roll: tan |α| ≤ (1 + κ) μ.
    pub fn can_roll(&self) -> bool {
        self.pull.abs() <= (1.0 + self.turning) * self.friction * self.press
    }

    /// The direction of the slip, +1 or −1; of the slip that the slope starts, if there is none and it does not roll.
    fn direction(&self) -> f64 {
        let slip = self.speed - self.surface;
        if slip == 0.0 { self.pull.signum() } else { slip.signum() }
    }

    /// When the slip ends \[s\]; infinite if the slope keeps it up.
    pub fn rolling_time(&self) -> f64 {
        let slip = self.speed - self.surface;
        if slip == 0.0 && self.can_roll() {
            return 0.0;
        }
        let decay = (1.0 + self.turning) * self.friction * self.press - self.direction() * self.pull;
        if decay > 0.0 { slip.abs() / decay } else { f64::INFINITY }
    }

    /// The state at a time t ≥ 0 of a body that rolls where it can; after the slip of a body that cannot roll reverses, not covered.
    pub fn state(&self, time: f64) -> RollingState {
        let brake = self.direction() * self.friction * self.press;
        let slide = self.rolling_time().min(time);
        let [acceleration, spin] = [self.pull - brake, self.turning * brake];
        let distance = slide * (self.speed + 0.5 * acceleration * slide);
        let (speed, surface) = (self.speed + acceleration * slide, self.surface + spin * slide);
        let (rest, down) = (time - slide, self.turning / (1.0 + self.turning) * self.pull);
        RollingState { distance: distance + rest * (speed + 0.5 * down * rest), speed: speed + down * rest, surface: surface + down * rest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::ratio;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn a_sphere_keeps_five_sevenths_and_a_disk_two_thirds() {
        assert_eq!(rolling_speed(&ratio(5, 2), &ratio(1, 1), &ratio(0, 1)), ratio(5, 7));
        assert_eq!(rolling_speed(&ratio(2, 1), &ratio(1, 1), &ratio(0, 1)), ratio(2, 3));
        assert_eq!(rolling_speed(&ratio(1, 1), &ratio(1, 1), &ratio(-1, 1)), ratio(0, 1), "a hoop with backspin comes to rest");
        for turning in [1.0, 2.0, 2.5] {
            for (speed, surface) in [(4.0, 0.0), (0.0, 3.0), (1.0, -2.0)] {
                let body = SlidingToRolling::new(turning, 0.3, 9.81, 0.0, speed, surface).expect("valid");
                let end = body.state(body.rolling_time() + 1.0);
                let expected = rolling_speed(&turning, &speed, &surface);
                assert!((end.speed - expected).abs() <= rounding(32, 8.0) && (end.surface - expected).abs() <= rounding(32, 8.0));
            }
        }
    }

    #[test]
    fn angular_momentum_about_the_floor_is_kept() {
        let body = SlidingToRolling::new(2.5, 0.3, 9.81, 0.0, 4.0, -1.0).expect("valid");
        for k in 0..20 {
            let RollingState { speed, surface, .. } = body.state(0.05 * k as f64);
            assert!((speed + surface / 2.5 - (4.0 - 1.0 / 2.5)).abs() <= rounding(32, 8.0));
        }
    }

    #[test]
    fn on_a_slope_a_body_rolls_down_or_slips_for_ever() {
        let rolls = SlidingToRolling::new(2.5, 0.3, 9.81, 0.5, 0.0, 0.0).expect("valid");
        assert!(rolls.can_roll() && rolls.rolling_time() == 0.0);
        assert!((rolls.state(1.0).speed - 5.0 / 7.0 * 9.81 * 0.5f64.sin()).abs() <= rounding(32, 8.0));
        let slips = SlidingToRolling::new(2.5, 0.1, 9.81, 0.5, 0.0, 0.0).expect("valid");
        assert!(!slips.can_roll() && slips.rolling_time().is_infinite());
        assert!((slips.state(1.0).speed - 9.81 * (0.5f64.sin() - 0.1 * 0.5f64.cos())).abs() <= rounding(32, 8.0));
    }
}
