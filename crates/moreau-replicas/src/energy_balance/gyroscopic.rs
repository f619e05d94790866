//! The gyroscopic part of a step: v_g, the velocity that torque-free rotation alone would leave.
//!
//! ```text
//!     v_g = v + h M⁻¹F_g ,    F_g = F̄(q, v, h) − F(q, 0) ,
//!     mean over the step:  T(v_g) = T(v) ;        at its start:  T(v_g) = T(v) + ½ ‖v_g − v‖²_M ,
//!     ‖v_g − v‖_M ≤ h ( Σ_bodies (2 T_rot √J_max / J_min)² )^½ .
//! ```
//! The implicit midpoint rule keeps T_rot ([`moreau_dynamics::mechanics::spatial`]). Explicitly F_g·v = 0, so that only the square is left.
//! **The bound.** ‖Ω × JΩ‖_{J⁻¹} ≤ |Ω| |JΩ| / √J_min with |Ω| ≤ √(2T_rot/J_min) and |JΩ| ≤ √(2T_rot J_max). The midpoint Ω_m of two spins
//! of one energy has no more of it, and the parts of a step add up.

use crate::energy_balance::constant::Constant;
use crate::energy_balance::exchange::{kinetic, norm};
use crate::energy_balance::{GYROSCOPIC, GYROSCOPIC_ENERGY, Taken};
use crate::tolerance::energy_balance::{energy, midpoint_spin};
use moreau_checks::Finding;
use moreau_contact::contact::delassus::MassFactor;
use moreau_exact::Result;
use nalgebra::DVector;

/// v_g, the kinetic energy that it gains, and its distance from v with a bound.
pub(super) struct Turned {
    /// v_g.
    pub velocity: DVector<f64>,
    /// T(v_g) − T(v) \[J\].
    pub gain: f64,
    /// ‖v_g − v‖_M \[√J\].
    change: f64,
    /// Its bound; `None` if the mechanism has no free bodies in space.
    bound: Option<f64>,
    explicit: bool,
}

impl Turned {
    /// v_g of a step with F_g explicit or as the mechanism's mean.
    pub fn of(taken: &Taken, constant: &Constant, explicit: bool) -> Result<Self> {
        let (mechanism, state) = (taken.mechanism, taken.before);
        let force = match explicit {
            true => mechanism.force(&state.position, &state.velocity),
            false => mechanism.mean_force(&state.position, &state.velocity, taken.h),
        };
        let change = MassFactor::new(&constant.mass)?.solve(&(force - &constant.force)) * taken.h;
        let velocity = &state.velocity + &change;
        Ok(Turned {
            gain: kinetic(&constant.mass, &velocity) - kinetic(&constant.mass, &state.velocity),
            change: (2.0 * kinetic(&constant.mass, &change)).max(0.0).sqrt(),
            bound: mechanism.gyroscopic_slope(&state.position, &state.velocity).map(|_| bound(taken, constant)),
            velocity,
            explicit,
        })
    }

    /// Rounding of T(v_g), of v_g and of its bound \[J\].
    pub fn rounding(&self, taken: &Taken) -> f64 {
        let size = 2.0 * taken.mechanism.kinetic_energy(taken.before) + self.change * self.change;
        let rate = taken.before.velocity.amax() * largest_ratio(taken);
        midpoint_spin(taken.h, rate, size) + energy(0, taken.before.velocity.len(), size)
    }

    /// T(v_g) is as it should be, and v_g not too far from v.
    pub fn findings(&self, taken: &Taken) -> Vec<Finding> {
        let Some(bound) = self.bound else { return Vec::new() };
        let rounding = self.rounding(taken);
        let expected = if self.explicit { 0.5 * self.change * self.change } else { 0.0 };
        vec![
            Finding::equal(GYROSCOPIC_ENERGY, self.gain, expected, rounding, "J"),
            Finding::at_most_within(GYROSCOPIC, self.change * self.change, bound * bound, rounding, "J"),
        ]
    }

    /// N(v_g), which sizes its rounding.
    pub fn norm(&self, constant: &Constant) -> f64 {
        norm(&constant.mass, &self.velocity)
    }
}

/// √(J_max/J_min) over all bodies: no spin of the same energy is faster than the present one by more than this factor, √3 for three axes
/// aside.
fn largest_ratio(taken: &Taken) -> f64 {
    let mass = taken.mechanism.mass_matrix(&taken.before.position);
    let ratio = |k: usize| {
        let moments = [3, 4, 5].map(|i| mass[(6 * k + i, 6 * k + i)]);
        let (low, high) = extremes(moments);
        (3.0 * high / low).sqrt()
    };
    (0..mass.nrows() / 6).map(ratio).fold(1.0, f64::max)
}

fn extremes(moments: [f64; 3]) -> (f64, f64) {
    (moments.iter().copied().fold(f64::INFINITY, f64::min), moments.iter().copied().fold(0.0, f64::max))
}

/// The module's bound; free bodies in space have six velocities each, the last three about their principal axes.
fn bound(taken: &Taken, constant: &Constant) -> f64 {
    let (mass, velocity) = (&constant.mass, &taken.before.velocity);
    let of = |k: usize| {
        let moments = [3, 4, 5].map(|i| mass[(6 * k + i, 6 * k + i)]);
        let twice: f64 = (0..3).map(|i| moments[i] * velocity[6 * k + 3 + i].powi(2)).sum();
        let (low, high) = extremes(moments);
        (twice * high.sqrt() / low).powi(2)
    };
    taken.h * (0..velocity.len() / 6).map(of).sum::<f64>().sqrt()
}
