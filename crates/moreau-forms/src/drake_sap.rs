//! Steady contact under Drake's SAP: K ∋ r ⟂ y ∈ K*, y = u + (φ/(h + τ)) n + R r, with R > 0.
//!
//! ```text
//!     R_n = max( w/(4π²), 1/(h k (h + τ)) ) ,   R_t = σ w ,   w = ‖J_i diag(M)⁻¹ J_iᵀ‖_F/3 ,
//!     at rest     φ   = −(h + τ) R_n r_n ,
//!     sticking    v_t = R_t r_t = σ w h f_t/n_c ,
//!     sliding     φ   = (h + τ) [ μ |v_t| − (R_n + μ² R_t) r_n ]     while φ < 0 .
//! ```
//! *Derivation.* r inside the cone gives y = 0: the normal row with u_n = 0 is the rest depth, the tangential row
//! v_t = −R_t r_t the creep. On the cone's boundary y_n = μ‖y_t‖ with r_t = −μ r_n t: y_t = v_t − μ R_t r_n t and
//! y_n = φ/(h + τ) + R_n r_n, hence the gap. A contact with φ ≥ 0 is not reported to the solver: the formula ends there.

use nalgebra::{Matrix3, Vector3};

/// One of n_c equal point contacts that carry a body.
///
/// # Source
/// Castro, Permenter, Han, *An unconstrained convex formulation of compliant contact* (SAP), and Drake's `sap` documentation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SapContact {
    /// h \[s\].
    pub time_step: f64,
    /// k \[N/m\], point stiffness.
    pub stiffness: f64,
    /// τ \[s\], relaxation time of the dissipation.
    pub relaxation_time: f64,
    /// w = ‖J_i diag(M)⁻¹ J_iᵀ‖_F/3 \[1/kg\] of the contact's three rows. Drake takes the diagonal of M, so w is that of the Delassus block
    /// only if M is diagonal. The stored steps of a tilted block in `tests/references` show the difference.
    pub diagonal_mean: f64,
    /// σ, ratio of R_t to w (1e-3 in Drake).
    pub tangential_ratio: f64,
    /// μ.
    pub friction: f64,
}

/// σ in Drake.
pub const TANGENTIAL_RATIO: f64 = 0.001;

/// w = ‖J_i diag(M)⁻¹ J_iᵀ‖_F/3 \[1/kg\] of a contact at `lever` \[m\] from the centre of mass of a free body, in world axes.
///
/// J_i = \[1, −\[lever\]×\]; M has the mass and `inertia_diagonal` \[kg·m²\], the diagonal of the body's inertia in world axes.
pub fn diagonal_mean(mass: f64, inertia_diagonal: Vector3<f64>, lever: Vector3<f64>) -> f64 {
    let turning = -lever.cross_matrix();
    let weighted = turning * Matrix3::from_diagonal(&inertia_diagonal.map(|moment| 1.0 / moment)) * turning.transpose();
    (weighted + Matrix3::identity() / mass).norm() / 3.0
}

/// Creep σ h F_t/Σ 1/w_i \[m/s\] of a body that contacts with the given w_i \[1/kg\] hold together under F_t = `load` \[N\]: one
/// speed for all, v = σ w_i r_t,i, and Σ r_t,i = h F_t.
///
/// ```
/// use moreau_forms::drake_sap::{TANGENTIAL_RATIO, shared_creep};
///
/// let one = shared_creep(0.01, &[2.0], 3.0); // h, w of the contact, load
/// assert!((one - TANGENTIAL_RATIO * 0.01 * 2.0 * 3.0).abs() < 1e-15);
/// assert!((shared_creep(0.01, &[2.0, 2.0], 3.0) - one / 2.0).abs() < 1e-15); // two contacts creep half as fast
/// assert!((shared_creep(0.005, &[2.0], 3.0) - one / 2.0).abs() < 1e-15); // and so does half the step
/// ```
pub fn shared_creep(time_step: f64, diagonal_means: &[f64], load: f64) -> f64 {
    TANGENTIAL_RATIO * time_step * load / diagonal_means.iter().map(|mean| 1.0 / mean).sum::<f64>()
}

impl SapContact {
    /// R_n = max(w/4π², 1/(h k (h + τ))) \[1/kg\]: a contact is never stiffer than its step resolves.
    pub fn normal_regularisation(&self) -> f64 {
        let near_rigid = self.diagonal_mean / (4.0 * std::f64::consts::PI.powi(2));
        near_rigid.max(1.0 / (self.time_step * self.stiffness * (self.time_step + self.relaxation_time)))
    }

    /// R_t = σ w \[1/kg\].
    pub fn tangential_regularisation(&self) -> f64 {
        self.tangential_ratio * self.diagonal_mean
    }

    /// Gap at rest, −(h + τ) R_n h f_n \[m\], under a normal force f_n \[N\] on this contact.
    pub fn rest_gap(&self, normal_force: f64) -> f64 {
        -(self.time_step + self.relaxation_time) * self.normal_regularisation() * self.time_step * normal_force
    }

    /// Creep σ w h f_t \[m/s\] under a tangential force f_t \[N\] on this contact (m g sin α/n_c on an incline).
    pub fn creep_speed(&self, tangential_force: f64) -> f64 {
        self.tangential_regularisation() * self.time_step * tangential_force
    }

    /// Gap of a steady slide \[m\] at speed |v_t| \[m/s\] under f_n \[N\]; meaningful while it is negative.
    pub fn sliding_gap(&self, speed: f64, normal_force: f64) -> f64 {
        let impulse = self.time_step * normal_force;
        let mu = self.friction;
        let softness = self.normal_regularisation() + mu * mu * self.tangential_regularisation();
        (self.time_step + self.relaxation_time) * (mu * speed - softness * impulse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::PRINTED_DIGITS;

    fn contact(time_step: f64, stiffness: f64) -> SapContact {
        let diagonal_mean = 2.0f64.sqrt() / 3.0;
        SapContact { time_step, stiffness, relaxation_time: 0.1, diagonal_mean, tangential_ratio: TANGENTIAL_RATIO, friction: 0.3 }
    }

    #[test]
    fn creep_of_a_block_with_two_translations_is_the_measured_number() {
        // x and z joints only, m = 1 kg: W_ii = diag(1, 0, 1), w = √2/3; slope with g sin α = 0.6·9.81.
        let creep = contact(0.01, 1e6).creep_speed(9.81 * 0.6);
        assert!((creep - 2.774687e-5).abs() <= PRINTED_DIGITS * 2.774687e-5, "{creep:e}");
        assert!((contact(0.001, 1e6).creep_speed(9.81 * 0.6) - 0.1 * creep).abs() <= PRINTED_DIGITS * creep);
    }

    #[test]
    fn equal_contacts_share_the_load_of_the_single_formula() {
        let single = contact(0.01, 1e6).creep_speed(9.81 * 0.6 / 4.0);
        let shared = shared_creep(0.01, &[2.0f64.sqrt() / 3.0; 4], 9.81 * 0.6);
        assert!((shared - single).abs() <= PRINTED_DIGITS * single);
    }

    #[test]
    fn a_contact_below_the_centre_of_a_sphere_is_softer_sideways() {
        // W = diag(1/m + R²/I, 1/m + R²/I, 1/m) with I = ⅖ m R²: diag(3.5, 3.5, 1)/m.
        let mean = diagonal_mean(2.0, Vector3::repeat(0.4 * 2.0 * 0.01), Vector3::new(0.0, 0.0, -0.1));
        let expected = (2.0 * 3.5f64 * 3.5 + 1.0).sqrt() / 6.0;
        assert!((mean - expected).abs() <= PRINTED_DIGITS * expected);
    }

    #[test]
    fn a_resolved_contact_sinks_by_weight_over_stiffness() {
        let soft = contact(0.01, 1e3);
        assert!((soft.rest_gap(9.81) + 9.81 / 1e3).abs() <= PRINTED_DIGITS * 9.81 / 1e3);
        // Too stiff for the step: the near-rigid bound takes over and the depth no longer depends on k.
        assert_eq!(contact(0.01, 1e9).rest_gap(9.81), contact(0.01, 1e10).rest_gap(9.81));
    }

    #[test]
    fn the_sliding_answer_lies_on_the_boundary_of_both_cones_and_is_orthogonal() {
        // The law, checked row by row with r and y written out: r_t = −μ r_n, y_n = μ|y_t|, r·y = 0.
        let contact = contact(0.005, 1e4);
        let (speed, force) = (0.02, 8.0);
        let normal = contact.time_step * force;
        let impulse = [normal, -contact.friction * normal];
        let gap = contact.sliding_gap(speed, force);
        let y = [
            gap / (contact.time_step + contact.relaxation_time) + contact.normal_regularisation() * impulse[0],
            speed + contact.tangential_regularisation() * impulse[1],
        ];
        assert!((y[0] - contact.friction * y[1].abs()).abs() <= PRINTED_DIGITS * y[0].abs());
        assert!((impulse[0] * y[0] + impulse[1] * y[1]).abs() <= PRINTED_DIGITS * impulse[0] * y[0].abs());
        assert!(gap < 0.0);
    }

    #[test]
    fn a_slide_without_speed_hangs_at_the_rest_gap_plus_the_tangential_softness() {
        let contact = contact(0.005, 1e4);
        assert!(contact.sliding_gap(0.0, 8.0) < contact.rest_gap(8.0));
        let frictionless = SapContact { friction: 0.0, ..contact };
        assert_eq!(frictionless.sliding_gap(1.0, 8.0), frictionless.rest_gap(8.0));
    }
}
