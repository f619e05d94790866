//! A sphere that slides on one contact under a convex law, step by step: each step has a closed form, because W and R are diagonal in (n,
//! t).
//!
//! ```text
//!     K ∋ r ⟂ A r + b ∈ K* ,   A = diag(a_n, a_t):
//!         b_n ≥ μ|b_t|                  r = 0
//!         |b_t|/a_t ≤ −μ b_n/a_n        r = −(b_n/a_n, b_t/a_t)                                  (sticks)
//!         otherwise                     r_n = (μ|b_t| − b_n)/(a_n + μ² a_t) ,  r_t = −μ r_n sign b_t   (slides)
//!     v_n⁺ = v_n − h g_n + r_n/m ,   v⁺ = v + h g_t + r_t/m ,   w⁺ = w − κ λ r_t/m ,   φ⁺ = φ + h v_n⁺ ,
//!     u_t = v − λ w ,   λ = 1 + min(φ, 0)/2R ,   c = m W_t = 1 + κ λ² .
//! ```
//! w = ω R is the speed of the surface, κ = m R²/I = 5/2 for a solid sphere; soft contacts act in the middle of the depth. The laws differ
//! in b and R:
//! ```text
//!     Anitescu            b = u_free + φ/h n                                   always
//!     Drake SAP           b = u_free + φ/(h + τ) n ,  R = (R_n, R_t)           while φ < 0
//!     MuJoCo, elliptic    b = a_free + (b v_n + k d φ, b u_t) ,  r = h f       while φ < 0
//!     MuJoCo, pyramidal   the same on four edges n ± μ t                       while φ < 0
//! ```

use super::drake_sap::SapContact;
use super::mujoco_contact::ContactParameters;

/// The law of one contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SlidingLaw {
    /// The hard cone complementarity step.
    Anitescu,
    /// Drake's SAP.
    DrakeSap(SapContact),
    /// MuJoCo with elliptic cones.
    MujocoElliptic(ContactParameters),
    /// MuJoCo with pyramids, one axis along the slip.
    MujocoPyramidal(ContactParameters),
}

/// A solid sphere on one contact that moves in a plane.
///
/// # Source
/// The equations of the header; the laws as in [`super::drake_sap`] and [`super::mujoco_contact`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingContact {
    /// The law.
    pub law: SlidingLaw,
    /// h \[s\].
    pub time_step: f64,
    /// m \[kg\].
    pub mass: f64,
    /// R \[m\].
    pub radius: f64,
    /// μ.
    pub friction: f64,
    /// g_n, g cos α \[m/s²\].
    pub press: f64,
    /// g_t, g sin α \[m/s²\].
    pub pull: f64,
}

/// Gap and velocities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingState {
    /// φ \[m\].
    pub gap: f64,
    /// v_n \[m/s\].
    pub normal_velocity: f64,
    /// v \[m/s\], along the plane.
    pub velocity: f64,
    /// w = ω R \[m/s\].
    pub surface: f64,
}

/// κ = m R²/I of a solid sphere.
const TURNING: f64 = 2.5;

impl SlidingContact {
    /// One step.
    pub fn step(&self, state: SlidingState) -> SlidingState {
        let h = self.time_step;
        let [normal, tangential] = self.impulse(&state).map(|impulse| impulse / self.mass);
        let normal_velocity = state.normal_velocity - h * self.press + normal;
        SlidingState {
            gap: state.gap + h * normal_velocity,
            normal_velocity,
            velocity: state.velocity + h * self.pull + tangential,
            surface: state.surface - TURNING * self.lever(&state) * tangential,
        }
    }

    /// The states after 0, 1, …, `steps` steps.
    pub fn motion(&self, start: SlidingState, steps: usize) -> Vec<SlidingState> {
        let mut states = vec![start];
        for k in 0..steps {
            states.push(self.step(states[k]));
        }
        states
    }

    /// λ, the lever of the contact over R.
    fn lever(&self, state: &SlidingState) -> f64 {
        1.0 + 0.5 * state.gap.min(0.0) / self.radius
    }

    /// u_t \[m/s\].
    fn slip(&self, state: &SlidingState) -> f64 {
        state.velocity - self.lever(state) * state.surface
    }

    /// c/m = W_t \[1/kg\].
    fn tangential_response(&self, state: &SlidingState) -> f64 {
        let lever = self.lever(state);
        (1.0 + TURNING * lever * lever) / self.mass
    }

    /// (r_n, r_t) \[N·s\].
    fn impulse(&self, state: &SlidingState) -> [f64; 2] {
        let h = self.time_step;
        let inverse = 1.0 / self.mass;
        let across = self.tangential_response(state);
        let free = [state.normal_velocity - h * self.press, self.slip(state) + h * self.pull];
        match self.law {
            SlidingLaw::Anitescu => associated([inverse, across], [free[0] + state.gap / h, free[1]], self.friction),
            _ if state.gap >= 0.0 => [0.0; 2],
            SlidingLaw::DrakeSap(contact) => {
                let soft = [contact.normal_regularisation(), contact.tangential_regularisation()];
                let shift = state.gap / (h + contact.relaxation_time);
                associated([inverse + soft[0], across + soft[1]], [free[0] + shift, free[1]], self.friction)
            }
            SlidingLaw::MujocoElliptic(parameters) => {
                let softness = parameters.normal_regularisation(-state.gap, inverse);
                let [normal, tangential] = self.mujoco_bias(&parameters, state);
                let response = [inverse + softness, across + softness / parameters.impedance_ratio];
                associated(response, [normal, tangential], self.friction).map(|force| h * force)
            }
            SlidingLaw::MujocoPyramidal(parameters) => self.pyramid(&parameters, state).map(|force| h * force),
        }
    }

    /// a_free − a_ref \[m/s²\] of the normal and the tangent.
    fn mujoco_bias(&self, parameters: &ContactParameters, state: &SlidingState) -> [f64; 2] {
        let (stiffness, damping) = parameters.stiffness_and_damping(self.time_step);
        let spring = stiffness * parameters.impedance_at(-state.gap) * state.gap;
        [-self.press + damping * state.normal_velocity + spring, self.pull + damping * self.slip(state)]
    }

    /// (f_n, f_t) \[N\] of four edges n ± μ t, n ± μ t₂: non-negative forces by Gauss–Seidel, which converges because R > 0.
    fn pyramid(&self, parameters: &ContactParameters, state: &SlidingState) -> [f64; 2] {
        let inverse = 1.0 / self.mass;
        let edge = parameters.pyramid_diagonal(inverse, self.friction);
        let softness = parameters.normal_regularisation(-state.gap, edge);
        let [normal, tangential] = self.mujoco_bias(parameters, state);
        // The edges' slopes along the slip: two across it have none, and one of them stands for both.
        let slopes = [self.friction, -self.friction, 0.0];
        let count = [1.0, 1.0, 2.0];
        let across = self.tangential_response(state);
        let mut forces = [0.0f64; 3];
        for _ in 0..SWEEPS {
            let before = forces;
            for k in 0..3 {
                let total: f64 = (0..3).map(|j| count[j] * forces[j]).sum();
                let along: f64 = (0..3).map(|j| slopes[j] * forces[j]).sum();
                let rate = normal + slopes[k] * tangential + inverse * total + across * slopes[k] * along + softness * forces[k];
                // At least ∂y_k/∂f_k: the two edges across move together, and their forces along t₂ cancel.
                let diagonal = inverse * count[k] + self.friction * self.friction * across + softness;
                forces[k] = (forces[k] - rate / diagonal).max(0.0);
            }
            if forces == before {
                break;
            }
        }
        let total: f64 = (0..3).map(|j| count[j] * forces[j]).sum();
        [total, (0..3).map(|j| slopes[j] * forces[j]).sum()]
    }
}

/// Most sweeps over a pyramid. The error shrinks by 1 − R/(W + R) or faster each sweep; with R/W ≥ 1/500 this many take it below any float.
const SWEEPS: usize = 20_000;

/// The associated law's answer for diagonal A.
fn associated(diagonal: [f64; 2], free: [f64; 2], friction: f64) -> [f64; 2] {
    let [normal, tangential] = free;
    if normal >= friction * tangential.abs() {
        return [0.0; 2];
    }
    let sticking = [-normal / diagonal[0], -tangential / diagonal[1]];
    if sticking[1].abs() <= friction * sticking[0] {
        return sticking;
    }
    let pressed = (friction * tangential.abs() - normal) / (diagonal[0] + friction * friction * diagonal[1]);
    [pressed, -friction * pressed * tangential.signum()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drake_sap::TANGENTIAL_RATIO;
    use crate::tolerance::PRINTED_DIGITS;
    use moreau_exact::tolerance::rounding;

    fn contact(law: SlidingLaw) -> SlidingContact {
        SlidingContact { law, time_step: 0.004, mass: 2.0, radius: 0.1, friction: 0.3, press: 9.0, pull: 4.0 }
    }

    fn thrown(gap: f64, velocity: f64) -> SlidingState {
        SlidingState { gap, normal_velocity: 0.0, velocity, surface: 0.0 }
    }

    #[test]
    fn the_answer_lies_in_the_cone_its_velocity_in_the_dual_and_they_are_orthogonal() {
        for (normal, tangential) in [(1.0, 0.5), (-1.0, 0.2), (-1.0, 3.0), (0.5, -4.0), (-2.0, -0.1)] {
            let (diagonal, mu) = ([0.5, 1.75], 0.3);
            let [rn, rt] = associated(diagonal, [normal, tangential], mu);
            let [yn, yt]: [f64; 2] = [diagonal[0] * rn + normal, diagonal[1] * rt + tangential];
            let slack = rounding(16, 5.0);
            assert!(rt.abs() <= mu * rn + slack && yn >= mu * yt.abs() - slack && (rn * yn + rt * yt).abs() <= slack);
        }
    }

    #[test]
    fn anitescu_slides_at_the_gap_mu_h_slip_and_hops_if_started_below_it() {
        let body = contact(SlidingLaw::Anitescu);
        let hop = body.step(thrown(0.0, 1.0));
        assert!((hop.normal_velocity - 0.3 * body.slip(&hop)).abs() <= rounding(16, 1.0));
        let last = body.motion(thrown(0.3 * 0.004, 1.0), 20)[20];
        assert!((last.gap - 0.3 * 0.004 * body.slip(&last)).abs() <= rounding(16 * 20, 1.0));
    }

    #[test]
    fn friction_takes_mu_times_the_normal_impulse_through_every_hop() {
        // The slip falls by 5.45 m/s² and lasts beyond the 0.4 s.
        let start = thrown(1e-8, 4.0);
        let mean = 3.5f64.hypot(3.5).hypot(1.0) / 6.0;
        let sap = SapContact {
            time_step: 0.004,
            stiffness: 1e5,
            relaxation_time: 0.01,
            diagonal_mean: mean,
            tangential_ratio: TANGENTIAL_RATIO,
            friction: 0.3,
        };
        let defaults = ContactParameters::default();
        let soft = [SlidingLaw::DrakeSap(sap), SlidingLaw::MujocoElliptic(defaults), SlidingLaw::MujocoPyramidal(defaults)];
        for law in soft.into_iter().chain([SlidingLaw::Anitescu]) {
            let body = contact(law);
            let motion = body.motion(start, 100);
            assert!(motion.iter().map(|state| state.gap).fold(0.0, f64::max) > 1e-3, "{law:?} hops");
            let last = motion[100];
            let balance = last.velocity + 0.3 * last.normal_velocity - 4.0 - 0.4 * (4.0 - 0.3 * 9.0);
            assert!(balance.abs() <= PRINTED_DIGITS, "{law:?}: {balance:e}");
        }
    }

    #[test]
    fn without_slip_mujoco_settles_at_the_rest_depth_of_its_law() {
        let parameters = ContactParameters::default();
        let body = SlidingContact { pull: 0.0, ..contact(SlidingLaw::MujocoElliptic(parameters)) };
        let start = thrown(0.0, 0.0);
        let depth = parameters.rest_depth(0.004, 0.5, 18.0).expect("positive");
        assert!((body.motion(start, 1000)[1000].gap + depth).abs() <= PRINTED_DIGITS * depth);
        let pyramid = SlidingContact { law: SlidingLaw::MujocoPyramidal(parameters), ..body };
        let settled = pyramid.motion(start, 1000)[1000];
        assert!(settled.gap < 0.0 && settled.normal_velocity.abs() <= PRINTED_DIGITS && settled.velocity.abs() <= PRINTED_DIGITS);
    }
}
