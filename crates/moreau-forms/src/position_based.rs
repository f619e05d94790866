//! One contact under position-based dynamics: a mass m at rest or landing, h the step, k sweeps.
//!
//! ```text
//!     predicted     φ̃ = φ + h v − g h²
//!     PBD, share s  each sweep leaves (1−s) φ:     φ⁺ = (1−s)^k φ̃ ;   rest depth g h² (1−s)^k/(1−(1−s)^k) ,
//!                   effective stiffness (m/h²)(1−(1−s)^k)/(1−s)^k
//!     XPBD, α       one sweep solves it:           φ⁺ = φ̃ α̃/(1/m + α̃) , α̃ = α/h² ;   rest depth α m g ,  stiffness 1/α
//!     velocity      (φ⁺ − φ)/h  after the positions;  max(−e ṽ, 0)  after the velocities, ṽ = v − g h
//! ```
//! PBD's contact is a spring whose stiffness grows with the sweeps and with 1/h²; XPBD's is α's own at every h.

/// A mass on one contact.
///
/// # Source
/// Müller et al., *Position Based Dynamics* (2007); Macklin, Müller and Chentanez, *XPBD* (2016); Müller et al., *Detailed Rigid Body
/// Simulation with Extended Position Based Dynamics* (2020), §3.6 for restitution.
///
/// ```
/// use moreau_forms::PositionBasedContact;
///
/// let body = |time_step| PositionBasedContact { mass: 1.0, gravity: 10.0, time_step };
/// let (coarse, fine) = (body(0.01), body(0.005));
/// assert_eq!(coarse.rest_depth_of_compliance(1e-4), fine.rest_depth_of_compliance(1e-4)); // XPBD: α m g
/// let ratio = fine.stiffness_of_share(0.5, 10) / coarse.stiffness_of_share(0.5, 10);
/// assert!((ratio - 4.0).abs() < 1e-12); // PBD: half the step is four times as stiff
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionBasedContact {
    /// m \[kg\].
    pub mass: f64,
    /// g \[m/s²\].
    pub gravity: f64,
    /// h \[s\].
    pub time_step: f64,
}

impl PositionBasedContact {
    /// Depth at rest \[m\] of PBD with the share s ∈ (0, 1\] and k sweeps.
    pub fn rest_depth_of_share(&self, share: f64, sweeps: i32) -> f64 {
        let left = (1.0 - share).powi(sweeps);
        self.gravity * self.time_step * self.time_step * left / (1.0 - left)
    }

    /// m g over that depth \[N/m\].
    pub fn stiffness_of_share(&self, share: f64, sweeps: i32) -> f64 {
        self.mass * self.gravity / self.rest_depth_of_share(share, sweeps)
    }

    /// Depth at rest \[m\] of XPBD with the compliance α \[m/N\].
    pub fn rest_depth_of_compliance(&self, compliance: f64) -> f64 {
        compliance * self.mass * self.gravity
    }

    /// Gap and velocity after the position pass of a step of XPBD. The step begins at gap φ with velocity v and ends in contact.
    pub fn landing(&self, compliance: f64, gap: f64, velocity: f64) -> (f64, f64) {
        let h = self.time_step;
        let scaled = compliance / (h * h);
        let predicted = gap + h * (velocity - self.gravity * h);
        let after = predicted * scaled / (1.0 / self.mass + scaled);
        (after, (after - gap) / h)
    }

    /// Velocity after the velocity pass of a step that began with velocity v: e|v − g h|, zero below 2 g h.
    pub fn rebound(&self, restitution: f64, velocity: f64) -> f64 {
        let arriving = velocity - self.gravity * self.time_step;
        if arriving.abs() <= 2.0 * self.gravity * self.time_step { 0.0 } else { (-restitution * arriving).max(0.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn the_rest_depth_is_where_a_step_changes_nothing() {
        for (h, share, sweeps) in [(0.01, 0.5, 1), (0.01, 0.5, 10), (0.001, 0.1, 4)] {
            let contact = PositionBasedContact { mass: 2.0, gravity: 9.81, time_step: h };
            let depth = contact.rest_depth_of_share(share, sweeps);
            let predicted = -depth - 9.81 * h * h;
            assert!((predicted * (1.0f64 - share).powi(sweeps) + depth).abs() <= rounding(32, depth));
        }
        let contact = PositionBasedContact { mass: 2.0, gravity: 9.81, time_step: 0.01 };
        let depth = contact.rest_depth_of_compliance(1e-4);
        let (gap, velocity) = contact.landing(1e-4, -depth, 0.0);
        assert!((gap + depth).abs() <= rounding(32, depth) && velocity.abs() <= rounding(32, 1.0));
    }

    #[test]
    fn a_finer_step_or_another_sweep_stiffens_pbd_only() {
        let at = |h: f64| PositionBasedContact { mass: 2.0, gravity: 9.81, time_step: h };
        assert!((at(0.01).stiffness_of_share(0.5, 1) - 2.0 / 1e-4).abs() <= rounding(32, 2e4), "m/h² at s = ½");
        assert!((at(0.005).stiffness_of_share(0.5, 3) / at(0.01).stiffness_of_share(0.5, 3) - 4.0).abs() <= rounding(64, 4.0));
        assert!((at(0.01).stiffness_of_share(0.5, 3) / at(0.01).stiffness_of_share(0.5, 1) - 7.0).abs() <= rounding(64, 7.0));
    }

    #[test]
    fn a_rebound_gains_the_fall_of_a_step_and_ends_below_twice_that() {
        let contact = PositionBasedContact { mass: 2.0, gravity: 10.0, time_step: 0.0625 };
        assert_eq!(contact.rebound(0.5, -2.0), 0.5 * 2.625);
        assert_eq!(contact.rebound(0.5, -0.5), 0.0);
        assert_eq!(contact.rebound(0.5, 3.0), 0.0);
    }
}
