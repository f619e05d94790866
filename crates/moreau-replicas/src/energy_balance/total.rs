//! The total energy of a step under a constant force and a constant mass matrix.
//!
//! ```text
//!     M (v⁺ − v_g) = h F + Hᵀr ,     q⁺ = q + h (θ v⁺ + (1−θ) v) ,     Ẽ = T + V + (θ−½) h F·v :
//!     ΔẼ = T(v_g) − T(v) + ½ r·(u⁺ + u_g) ,      u_g = H v_g ,
//!     ΔẼ ≤ T(v_g) − T(v) − r·shift − rᵀR r + w + h²FᵀM⁻¹F/8                                       every scheme through the waist
//!     ΔẼ ≤ T(v_g) − T(v) + (1−e)/(1+e) h²FᵀM⁻¹F/8 + e/(1+e) r·(u_g − u⁻) + w/(1+e)                s = e u⁻, one e, see below
//! ```
//! **The identity.** F is constant, so that ΔV = −F·Δq = −h F·(v + v⁺)/2 − (θ−½) h F·(v⁺ − v); the last term is what Ẽ adds. Free bodies
//! have F ⟂ M⁻¹F_g, hence F·v = F·v_g, and T⁺ − T(v_g) = ½ (v⁺ + v_g)·(h F + Hᵀr).
//!
//! **The bounds.** With B = r·u⁺, A = r·u_g and Q = B − A = rᵀW r + h r·H M⁻¹F the identity is A + ½ Q = B − ½ Q. Completing the square,
//! Q = ‖x + ½ h M⁻¹F‖²_M − ¼ h²FᵀM⁻¹F with x = M⁻¹Hᵀr, so that Q ≥ −h²FᵀM⁻¹F/4: the first bound, with B ≤ −r·shift − rᵀR r + w.
//! Where r·y = B + e (A − r·(u_g − u⁻)) ≤ w, that is B ≤ −e A + …, B = A + Q gives (1+e) A ≤ −Q + e r·(u_g − u⁻) + w and
//! ΔẼ = A + ½ Q + … ≤ −Q (1−e)/(2(1+e)) + (e r·(u_g − u⁻) + w)/(1+e): the second.
//! r·(shift − e u⁻) = 0 needs one e for all contacts that push, and r_t·u_t⁻ in the shift (full vector) or e = 0 or no friction. Without
//! that there is no bound: `an_impact_with_two_restitutions_gains` in the tests has a frictionless one that gains.
//!
//! With e = 1 nothing is gained; with e = 0 and θ = ½ at most h²FᵀM⁻¹F/8, m g²h²/8 for a ball, when the impulse is half of what rest needs.
//! Where the positions do not follow the velocities of the step (`Flight`), the free flight keeps E and only the kinetic bound is left.

use crate::energy_balance::constant::Constant;
use crate::energy_balance::gyroscopic::Turned;
use crate::energy_balance::position::Position;
use crate::energy_balance::waist::{Posed, WaistLaw, effort};
use crate::energy_balance::{TOTAL, TOTAL_IDENTITY, Taken};
use crate::tolerance::energy_balance as tolerance;
use moreau_checks::Finding;

/// The findings on the total energy, and by how much Ẽ may rise.
pub(super) struct Total {
    pub findings: Vec<Finding>,
    pub rise: Option<f64>,
}

/// Rounding of the energies of both states and of the work between them \[J\].
fn rounding(taken: &Taken, posed: &Posed, constant: &Constant, turned: &Turned) -> f64 {
    let (before, after) = (taken.before, &taken.step.state);
    let heights = constant.force.abs().sum() * (before.position.amax() + after.position.amax());
    let moved = effort(&constant.force, &before.velocity, taken.h) + effort(&constant.force, &after.velocity, taken.h);
    let size = posed.exchange.size + turned.norm(constant).powi(2) + heights + moved;
    posed.rounding + turned.rounding(taken) + tolerance::energy(posed.exchange.impulse.len(), before.velocity.len(), size)
}

/// The findings of the module's equations.
pub(super) fn judge(waist: &WaistLaw, taken: &Taken, posed: &Posed, constant: &Constant, turned: &Turned) -> Total {
    let none = Total { findings: Vec::new(), rise: None };
    let (mechanism, before, after) = (taken.mechanism, taken.before, &taken.step.state);
    let tolerance = rounding(taken, posed, constant, turned);
    let changed = mechanism.energy(after) - mechanism.energy(before);
    let (exchange, residual) = (&posed.exchange, posed.work.residual);
    let theta = match waist.position {
        Position::Corrected => return none,
        Position::Flight => {
            let expected = exchange.impulse.dot(&exchange.after) - 0.5 * exchange.square;
            let bound = posed.given - 0.5 * exchange.square + residual;
            let findings = vec![
                Finding::equal(TOTAL_IDENTITY, changed, expected, tolerance, "J"),
                Finding::at_most_within(TOTAL, changed, bound, tolerance, "J"),
            ];
            return Total { findings, rise: Some(bound.max(0.0) + tolerance) };
        }
        Position::Remembering => 0.5,
        Position::Theta(theta) => theta,
    };
    let Some(fall) = constant.fall(taken.h) else { return none };
    let kept = (theta - 0.5) * taken.h * constant.force.dot(&(&after.velocity - &before.velocity));
    let turning = &*taken.step.assembled.jacobian * &turned.velocity;
    let identity = turned.gain + 0.5 * exchange.impulse.dot(&(&exchange.after + &turning));
    let bound = match waist.one_restitution(posed) {
        Some(e) => {
            let gyroscopic = e * exchange.impulse.dot(&(turning - &exchange.before));
            ((1.0 - e) * fall / 8.0 + gyroscopic + residual) / (1.0 + e)
        }
        None => posed.given + residual + fall / 8.0,
    };
    let bound = turned.gain + bound;
    let findings = vec![
        Finding::equal(TOTAL_IDENTITY, changed + kept, identity, tolerance, "J"),
        Finding::at_most_within(TOTAL, changed + kept, bound, tolerance, "J"),
    ];
    Total { findings, rise: Some(bound.max(0.0) + tolerance) }
}
