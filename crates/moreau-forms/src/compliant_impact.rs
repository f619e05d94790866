//! The impact of a mass on a linear spring and damper: m ẍ + c ẋ + k x = 0 from x = 0, ẋ = −v.
//!
//! ```text
//!     ζ = c/(2√(km)) ,   ω = √(k/m)
//!     with adhesion     contact ends where x = 0        e = exp(−πζ/√(1−ζ²)) ,  ζ < 1;  it does not end for ζ ≥ 1 (e = 0)
//!     cut               contact ends where the force is e = exp(−ζ/√(1−ζ²) · arccos(2ζ²−1)) ,  and its continuation beyond ζ = 1
//! ```
//! The cut is what an engine does whose contact may not pull: a larger e, above e⁻² up to critical damping.

use super::mujoco_normal::spring_damper_restitution;
use moreau_exact::{Error, Result};
use std::f64::consts::PI;

/// A mass, a spring and a damper that meet it.
///
/// # Source
/// Schwager and Pöschel, *Coefficient of restitution and linear–dashpot model revisited* (2007).
///
/// ```
/// use moreau_forms::CompliantImpact;
///
/// let impact = CompliantImpact::new(1.0, 1e4, 100.0)?; // m, k, c
/// assert_eq!(impact.damping_ratio(), 0.5);
/// assert!((impact.restitution_with_adhesion() - 0.163).abs() < 1e-3); // exp(−π/√3)
/// assert!(impact.restitution_cut() > impact.restitution_with_adhesion()); // contact that may not pull keeps more speed
/// # Ok::<(), moreau_exact::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompliantImpact {
    /// m \[kg\].
    pub mass: f64,
    /// k \[N/m\].
    pub stiffness: f64,
    /// c \[N·s/m\].
    pub damping: f64,
}

impl CompliantImpact {
    /// m, k and c.
    ///
    /// # Errors
    /// If m or k is not positive or c is negative.
    pub fn new(mass: f64, stiffness: f64, damping: f64) -> Result<Self> {
        let usable = mass > 0.0 && stiffness > 0.0 && damping >= 0.0 && (mass + stiffness + damping).is_finite();
        if !usable {
            return Err(Error::invalid("impact", "has a mass, stiffness or damping that is out of range", "use m > 0, k > 0 and c ≥ 0"));
        }
        Ok(CompliantImpact { mass, stiffness, damping })
    }

    /// ζ.
    pub fn damping_ratio(&self) -> f64 {
        0.5 * self.damping / (self.stiffness * self.mass).sqrt()
    }

    /// e where the damper may pull until the gap opens.
    pub fn restitution_with_adhesion(&self) -> f64 {
        let zeta = self.damping_ratio();
        if zeta >= 1.0 { 0.0 } else { (-PI * zeta / (1.0 - zeta * zeta).sqrt()).exp() }
    }

    /// e where contact ends with the force.
    pub fn restitution_cut(&self) -> f64 {
        spring_damper_restitution(self.damping_ratio())
    }

    /// The stiffness that lasts for a contact of this duration \[s\] with adhesion, at the damping ratio ζ < 1: ω_d = π/T.
    pub fn stiffness_of_duration(mass: f64, damping_ratio: f64, duration: f64) -> f64 {
        mass * (PI / duration).powi(2) / (1.0 - damping_ratio * damping_ratio)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn cutting_the_pull_leaves_more_speed() {
        for zeta in [0.05, 0.2, 0.5, 0.9, 0.999] {
            let impact = CompliantImpact::new(2.0, 800.0, 2.0 * zeta * 40.0).expect("valid");
            assert!((impact.damping_ratio() - zeta).abs() <= rounding(8, 1.0));
            assert!(impact.restitution_with_adhesion() < impact.restitution_cut() && impact.restitution_cut() >= (-2.0f64).exp());
        }
        let heavy = CompliantImpact::new(2.0, 800.0, 160.0).expect("valid");
        assert!(heavy.restitution_with_adhesion() == 0.0 && heavy.restitution_cut() > 0.0, "overdamped");
    }

    #[test]
    fn a_contact_of_given_duration_ends_when_it_should() {
        let (zeta, duration) = (0.3, 0.02);
        let stiffness = CompliantImpact::stiffness_of_duration(1.5, zeta, duration);
        let damped = (stiffness / 1.5).sqrt() * (1.0f64 - zeta * zeta).sqrt();
        assert!((damped * duration - PI).abs() <= rounding(16, 4.0));
        assert!(CompliantImpact::new(0.0, 1.0, 1.0).is_err());
    }
}
