//! A ball of 1 kg on one elliptic contact of MuJoCo, replayed step by step; t_c is the time constant of `solref`, ζ its damping ratio.
//!
//! ```text
//!     d constant, in contact:   (δ, v) ↦ λ² − (2 − 2s − s²/ζ²) λ + (1 − 2s) = 0 ,   s = h/t_c :
//!     stable for ζ = 1 iff s < 2√2 − 2 = 0.828 .
//! ```
//! *Derivation.* v⁺ = v − h(b d v − k d²·δ) with d b = 2/t_c, d² k = 1/(t_c ζ)² at d = d_w, δ⁺ = δ − h v⁺; Jury's criterion 1 + T + D > 0
//! is 4 − 4s − s²/ζ² > 0.

use crate::closed_forms::mujoco_contact::ContactParameters;
use crate::closed_forms::mujoco_normal::NormalContact;

/// g \[m/s²\].
pub const GRAVITY: f64 = 9.81;

/// MuJoCo's default contact at a step h.
pub fn default_contact(h: f64) -> NormalContact {
    NormalContact::elliptic(ContactParameters::default(), h, 1.0)
}

/// The stiffest critically damped contact that MuJoCo allows at a step h, t_c = 2h, with default impedance.
pub fn stiffest_contact(h: f64) -> NormalContact {
    NormalContact::elliptic(ContactParameters { reference: [2.0 * h, 1.0], ..ContactParameters::default() }, h, 1.0)
}

/// The contact with time constant t_c, ζ = 1 and constant impedance, where t_c may be below MuJoCo's limit 2h: the limit (`refsafe`) does
/// not apply to the direct form `solref` = (−1/t_c², −2/t_c), which means the same otherwise.
pub fn unlimited_contact(h: f64, time_constant: f64) -> NormalContact {
    let reference = [-1.0 / (time_constant * time_constant), -2.0 / time_constant];
    constant_impedance(h, reference)
}

/// The contact with `solref` = (t_c, 1), which MuJoCo limits to t_c ≥ 2h, and constant impedance.
pub fn limited_contact(h: f64, time_constant: f64) -> NormalContact {
    constant_impedance(h, [time_constant, 1.0])
}

fn constant_impedance(h: f64, reference: [f64; 2]) -> NormalContact {
    let parameters = ContactParameters { reference, impedance: [0.95, 0.95, 0.001, 0.5, 2.0], impedance_ratio: 1.0 };
    NormalContact::elliptic(parameters, h, 1.0)
}

/// What a drop led to.
#[derive(Clone, Copy, Debug)]
pub struct Landing {
    /// Depth at the end \[m\].
    pub depth: f64,
    /// Largest speed in the second half \[m/s\].
    pub speed: f64,
    /// Largest height in the second half \[m\].
    pub height: f64,
}

/// A ball released at rest at a height \[m\] above the floor, after a number of steps.
pub fn land(contact: &NormalContact, height: f64, steps: usize) -> Landing {
    let (mut place, mut velocity) = (height, 0.0);
    let mut landing = Landing { depth: 0.0, speed: 0.0, height: f64::NEG_INFINITY };
    for step in 0..steps {
        velocity += contact.impulse(-place, velocity, -GRAVITY) / contact.mass - contact.time_step * GRAVITY;
        place += contact.time_step * velocity;
        if 2 * step >= steps {
            landing.speed = f64::max(landing.speed, velocity.abs());
            landing.height = landing.height.max(place);
        }
    }
    Landing { depth: -place, ..landing }
}

/// Rebound speed of an impact at 1 m/s without load, in steps of `part` of 1/ω, ω = 1/(t_c ζ), constant impedance.
pub fn rebound(damping_ratio: f64, part: f64) -> f64 {
    let time_constant = 0.02;
    let contact = constant_impedance(part * time_constant * damping_ratio, [time_constant, damping_ratio]);
    let (mut depth, mut velocity) = (0.0f64.next_up(), -1.0);
    while depth > 0.0 {
        let push = contact.impulse(depth, velocity, 0.0);
        if push == 0.0 {
            break;
        }
        velocity += push / contact.mass;
        depth -= contact.time_step * velocity;
    }
    velocity
}
