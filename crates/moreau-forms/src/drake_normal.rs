//! One step of one normal contact of Drake, its tangential rows unloaded: depth δ > 0 at the start, velocity v_free without contact, mass
//! m̄.
//!
//! ```text
//!     SAP            r = max(0, −(v_free − δ/(h + τ))/(1/m̄ + R_n)) ,
//!     Hunt–Crossley  r = h k (δ − h v⁺)₊ (1 − d v⁺)₊ ,      v⁺ = v_free + r/m̄ .
//! ```
//! The second is implicit; its left side rises and its right side falls with v⁺, so the root is unique.

use super::drake_sap::SapContact;

impl SapContact {
    /// r \[N·s\] on a reduced mass m̄ \[kg\].
    pub fn normal_impulse(&self, mass: f64, depth: f64, free_velocity: f64) -> f64 {
        if depth <= 0.0 {
            return 0.0;
        }
        let approach = free_velocity - depth / (self.time_step + self.relaxation_time);
        (-approach / (1.0 / mass + self.normal_regularisation())).max(0.0)
    }
}

/// Hunt and Crossley's force as TAMSI, Similar and Lagged take it.
///
/// # Source
/// Castro et al., *Irrotational contact fields* (2023), §IV; Drake's `SapHuntCrossleyConstraint`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HuntCrossley {
    /// h \[s\].
    pub time_step: f64,
    /// k \[N/m\].
    pub stiffness: f64,
    /// d \[s/m\].
    pub dissipation: f64,
}

impl HuntCrossley {
    /// The normal impulse r \[N·s\] on a reduced mass m̄ \[kg\], found by bisection down to neighbouring floats.
    pub fn normal_impulse(&self, mass: f64, depth: f64, free_velocity: f64) -> f64 {
        if depth <= 0.0 {
            return 0.0;
        }
        let h = self.time_step;
        let impulse = |after: f64| h * self.stiffness * (depth - h * after).max(0.0) * (1.0 - self.dissipation * after).max(0.0);
        // v_free ≤ v⁺ ≤ the velocity at which the force ends, if that is larger.
        let (mut low, mut high) = (free_velocity, free_velocity.max(depth / h));
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return impulse(middle);
            }
            if mass * (middle - free_velocity) > impulse(middle) { high = middle } else { low = middle }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::drake_sap::TANGENTIAL_RATIO;
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn without_dissipation_the_step_is_the_implicit_euler_spring() {
        let contact = HuntCrossley { time_step: 1e-3, stiffness: 1e5, dissipation: 0.0 };
        let (mass, depth, free) = (2.0, 1e-3, -1.5);
        let after = (free + 1e-3 * 1e5 * depth / mass) / (1.0 + 1e-6 * 1e5 / mass);
        let impulse = contact.normal_impulse(mass, depth, free);
        assert!((impulse - mass * (after - free)).abs() <= rounding(64, mass * 3.0), "{impulse}");
    }

    #[test]
    fn dissipation_satisfies_its_own_equation_and_resists_approach() {
        let (mass, depth, free) = (2.0, 1e-3, -1.5);
        let impulse = |dissipation| HuntCrossley { time_step: 1e-3, stiffness: 1e5, dissipation }.normal_impulse(mass, depth, free);
        let after = free + impulse(0.3) / mass;
        let law = 1e-3 * 1e5 * (depth - 1e-3 * after) * (1.0 - 0.3 * after);
        assert!((impulse(0.3) - law).abs() <= rounding(1024, 10.0) && impulse(0.3) > impulse(0.0));
        assert_eq!(HuntCrossley { time_step: 1e-3, stiffness: 1e5, dissipation: 0.3 }.normal_impulse(mass, -1e-9, free), 0.0);
    }

    #[test]
    fn a_separating_contact_of_sap_is_not_pulled() {
        let contact = SapContact {
            time_step: 1e-3,
            stiffness: 1e5,
            relaxation_time: 0.01,
            diagonal_mean: 1.0,
            tangential_ratio: TANGENTIAL_RATIO,
            friction: 0.0,
        };
        assert_eq!(contact.normal_impulse(1.0, 1e-3, 1.0), 0.0);
        let impulse = contact.normal_impulse(1.0, 1e-3, -1.0);
        // The law itself: y = v⁺ − δ/(h + τ) + R r = 0.
        let residual = -1.0 + impulse - 1e-3 / 0.011 + contact.normal_regularisation() * impulse;
        assert!(residual.abs() <= rounding(16, 2.0));
    }
}
