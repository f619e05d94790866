//! The total energy of a θ step with linear forces, M̂ ≠ M.
//!
//! ```text
//!     F_θ = F₀ − K q_θ − C v_θ ,    q_θ = q + h θ v_θ ,    v_θ = θ v⁺ + (1−θ) v ,    M̂ = M + h θ C + h²θ² K :
//!     ΔE = r·u_θ − (θ−½) (‖v⁺ − v‖²_M + ‖q⁺ − q‖²_K) − h ‖v_θ‖²_C ,      u_θ = H v_θ ,
//!     r·u_θ ≤ κ ‖v_free − v‖²_M̂/4 + w/(1+e) ,   κ = 1/(1+e) − θ ≥ 0          one e as for a constant force
//!     r·u_θ ≤ −r·shift + w + (1−θ) ‖v_free − v‖²_M̂/4                          otherwise
//! ```
//! **The identity** is the equation of motion times v_θ: v_θ·M(v⁺ − v) = ΔT + (θ−½)‖v⁺ − v‖²_M, and with Δq = h v_θ, q_θ = (1−θ) q + θ q⁺
//! the force's part is −ΔV − (θ−½)‖Δq‖²_K − h‖v_θ‖²_C.
//! **The bounds.** A = r·u⁻, B = r·u⁺ = A + Q̂, Q̂ = rᵀŴr + r·H(v_free − v) ≥ −‖v_free − v‖²_M̂/4 and r·u_θ = A + θQ̂ = B − (1−θ)Q̂; with
//! (1+e) A ≤ −Q̂ + w it is at most −κ Q̂ + w/(1+e). For θ = ½, κ = (1−e)/(2(1+e)): the bound of a constant force with h F in place of
//! M̂(v_free − v).

use crate::energy_balance::exchange::{kinetic, norm};
use crate::energy_balance::position::Position;
use crate::energy_balance::waist::{Posed, WaistLaw};
use crate::energy_balance::{TOTAL, TOTAL_IDENTITY, Taken};
use crate::tolerance::energy_balance as tolerance;
use moreau_checks::Finding;

/// The findings of the module's equations; none for a scheme whose linear forces are not those of the θ step.
pub(super) fn judge(waist: &WaistLaw, taken: &Taken, posed: &Posed) -> Vec<Finding> {
    let (mechanism, h, assembled) = (taken.mechanism, taken.h, &taken.step.assembled);
    let (Position::Theta(theta), Some(linear), true) = (waist.position, mechanism.linear_force(), waist.implicit) else {
        return Vec::new();
    };
    let (before, after) = (taken.before, &taken.step.state);
    let mass = mechanism.mass_matrix(&before.position);
    let (jump, moved) = (&after.velocity - &before.velocity, &after.position - &before.position);
    let mean = &after.velocity * theta + &before.velocity * (1.0 - theta);
    let taken_away =
        (2.0 * theta - 1.0) * (kinetic(&mass, &jump) + kinetic(&linear.stiffness, &moved)) + 2.0 * h * kinetic(&linear.damping, &mean);
    let (exchange, residual) = (&posed.exchange, posed.work.residual);
    let work = exchange.impulse.dot(&(&exchange.after * theta + &exchange.before * (1.0 - theta)));
    let free = 0.5 * kinetic(assembled.effective_mass.matrix(), &(&assembled.free_velocity - &before.velocity));
    let e = waist.one_restitution(posed).filter(|e| 1.0 / (1.0 + e) >= theta);
    let bound = match e {
        Some(e) => (1.0 / (1.0 + e) - theta) * free + residual / (1.0 + e),
        None => posed.given + residual + (1.0 - theta) * free,
    };
    let changed = mechanism.energy(after) - mechanism.energy(before);
    let stretched = norm(&linear.stiffness, &before.position) + norm(&linear.stiffness, &after.position);
    let size = exchange.size + stretched * stretched + norm(assembled.effective_mass.matrix(), &mean).powi(2);
    let tolerance = posed.rounding + tolerance::energy(exchange.impulse.len(), before.velocity.len(), size);
    vec![
        Finding::equal(TOTAL_IDENTITY, changed, work - taken_away, tolerance, "J"),
        Finding::at_most_within(TOTAL, changed, bound - taken_away, tolerance, "J"),
    ]
}
