//! A ball on the ground in Rapier's substeps, dt = h/N, and what its springs say of a body at rest and of a sliding one.
//!
//! ```text
//!     N times:   v ← v − g dt + p/m ;      with the push-out   p ← s (p − m(v + b))₊ ,
//!                                                             b = φ/dt and s = 1 if φ > 0, else b = max(ε φ, −v_max)
//!                φ ← φ + dt v ;            and without it      p ← (p − m(v + (φ)₊/dt))₊
//!     once:      p ← (p − m(v + e v₀))₊ ,  v₀ the velocity before the step, where an impulse acted and none did in the step before
//!     ε = ω/(dt ω + 2ζ) ,    1/s = 1 + k²/(4ζ²(1 + k)) ,    k = 1/(ε dt) − 1 ,    ω = 2π f
//! ```
//! v takes every change of p as Δp/m. At rest v = 0 between the substeps and p = m g dt, whence (1 − s) g dt = s ε δ and δ = g/ω², whatever
//! dt and ζ: a point that carries N rests W N/ω² deep. A point that is not closed is rigid and carries a load without depth, so that a body
//! may also rest tilted.
//!
//! Friction of each point for itself (`Coulomb`) shortens the impulse K⁻¹u that stops its slip u to the cone: it acts along K⁻¹u and not
//! along u.
//!
//! # Source
//! rapier3d-f64 0.36.1: `contact_constraint_element.rs`, `contact_with_twist_friction.rs`, `integration_parameters.rs`.

use nalgebra::{Matrix2, Vector2};
use std::f64::consts::TAU;

/// A ball's contact and its step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RapierContact {
    /// h \[s\].
    pub time_step: f64,
    /// N.
    pub substeps: usize,
    /// f \[1/s\].
    pub frequency: f64,
    /// ζ.
    pub damping_ratio: f64,
    /// v_max \[m/s\].
    pub largest_push: f64,
    /// Gap \[m\] below which the contact is considered.
    pub prediction: f64,
    /// Radius of the ball \[m\].
    pub radius: f64,
    /// e.
    pub restitution: f64,
    /// g \[m/s²\].
    pub gravity: f64,
    /// m \[kg\].
    pub mass: f64,
}

/// The ball, with what the engine keeps for its next step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RapierBall {
    /// φ + radius \[m\]: a gap closed without push-out ends at zero to rounding, which then decides between rigid and soft, so it is formed
    /// as the engine forms it.
    pub height: f64,
    /// v \[m/s\].
    pub velocity: f64,
    /// p \[N·s\], the last substep's.
    pub impulse: f64,
    /// Whether an impulse acted in the last step.
    pub pressed: bool,
}

impl RapierContact {
    /// One step of size h.
    pub fn step(&self, ball: &mut RapierBall) {
        let dt = self.time_step / self.substeps as f64;
        if self.gap(ball) > self.prediction {
            for _ in 0..self.substeps {
                ball.velocity -= self.gravity * dt;
                ball.height += dt * ball.velocity;
            }
            (ball.impulse, ball.pressed) = (0.0, false);
            return;
        }
        let bounces = self.restitution >= 1.0 || (self.restitution > 0.0 && !ball.pressed);
        let rebound = if bounces { self.restitution * ball.velocity } else { 0.0 };
        let mut total = 0.0;
        for _ in 0..self.substeps {
            self.substep(ball, dt);
            total += ball.impulse;
        }
        if rebound < 0.0 && total > 0.0 {
            self.sweep(ball, rebound, 1.0);
        }
        ball.pressed = total > 0.0;
    }

    fn substep(&self, ball: &mut RapierBall, dt: f64) {
        let (push, softness) = self.spring(dt);
        ball.velocity += ball.impulse / self.mass - self.gravity * dt;
        let gap = self.gap(ball);
        if gap > 0.0 {
            self.sweep(ball, gap / dt, 1.0);
        } else {
            self.sweep(ball, (push * gap).max(-self.largest_push), softness);
        }
        ball.height += dt * ball.velocity;
        self.sweep(ball, self.gap(ball).max(0.0) / dt, 1.0);
    }

    fn gap(&self, ball: &RapierBall) -> f64 {
        ball.height - self.radius
    }

    fn sweep(&self, ball: &mut RapierBall, bias: f64, softness: f64) {
        let impulse = softness * (ball.impulse - self.mass * (ball.velocity + bias)).max(0.0);
        ball.velocity += (impulse - ball.impulse) / self.mass;
        ball.impulse = impulse;
    }

    /// ε \[1/s\] and s.
    fn spring(&self, dt: f64) -> (f64, f64) {
        let push = TAU * self.frequency / (dt * TAU * self.frequency + 2.0 * self.damping_ratio);
        let left = 1.0 / (push * dt) - 1.0;
        (push, 1.0 / (1.0 + left * left / ((1.0 + left) * 4.0 * self.damping_ratio * self.damping_ratio)))
    }
}

/// W N/ω² \[m\]: the depth at which a point of response W \[1/kg\] carries the load N \[N\].
pub fn rest_depth(frequency: f64, response: f64, load: f64) -> f64 {
    load * response / (TAU * frequency).powi(2)
}

/// The part of a point's friction that opposes a slip along the first direction, e₁·K⁻¹e₁/‖K⁻¹e₁‖; K \[1/kg\] is the point's tangential
/// response.
pub fn opposing_share(response: Matrix2<f64>) -> f64 {
    let impulse = Vector2::new(response[(1, 1)], -response[(1, 0)]);
    impulse[0] / impulse.norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    fn contact(time_step: f64, substeps: usize) -> RapierContact {
        RapierContact {
            time_step,
            substeps,
            frequency: 60.0,
            damping_ratio: 10.0,
            largest_push: 3.0,
            prediction: 0.02,
            radius: 0.25,
            restitution: 0.5,
            gravity: 10.0,
            mass: 2.0,
        }
    }

    #[test]
    fn a_ball_rests_at_g_over_omega_squared_whatever_the_step() {
        let depth = rest_depth(60.0, 0.5, 20.0);
        assert!((depth - 10.0 / (TAU * 60.0).powi(2)).abs() <= rounding(8, depth));
        for (h, substeps) in [(1.0 / 64.0, 1), (1.0 / 64.0, 4), (1.0 / 1024.0, 4)] {
            let contact = contact(h, substeps);
            let mut ball = RapierBall { height: 0.25 - depth, velocity: 0.0, impulse: 20.0 * h / substeps as f64, pressed: true };
            for _ in 0..16 {
                contact.step(&mut ball);
            }
            assert!((0.25 - ball.height - depth).abs() <= rounding(64 * 16 * substeps, 0.25 + h), "{h} {substeps}: {}", ball.height);
            assert!(ball.velocity.abs() <= rounding(64, 10.0 * h));
        }
    }

    #[test]
    fn it_falls_by_the_semi_implicit_method_of_its_substeps_and_rebounds_with_e_times_the_speed_before_the_step() {
        let contact = contact(1.0 / 64.0, 4);
        let mut ball = RapierBall { height: 0.75, ..RapierBall::default() };
        let dt = 1.0 / 256.0;
        for step in 1..=16 {
            contact.step(&mut ball);
            let n = f64::from(4 * step);
            assert!((ball.height - (0.75 - 10.0 * dt * dt * n * (n + 1.0) / 2.0)).abs() <= rounding(256, 1.0));
        }
        let mut ball = RapierBall { height: 0.251, velocity: -3.0, ..RapierBall::default() };
        contact.step(&mut ball);
        assert!((ball.velocity - 1.5).abs() <= rounding(64, 4.0), "{}", ball.velocity);
        // what was pressed in the step before does not rebound again
        let mut ball = RapierBall { height: 0.249, velocity: -3.0, impulse: 0.0, pressed: true };
        contact.step(&mut ball);
        assert!(ball.velocity.abs() <= rounding(64, 4.0), "{}", ball.velocity);
    }

    #[test]
    fn friction_along_the_stopping_impulse_opposes_the_slip_in_part_only() {
        assert_eq!(opposing_share(Matrix2::new(2.0, 0.0, 0.0, 3.0)), 1.0);
        assert_eq!(opposing_share(Matrix2::new(5.0, 3.0, 3.0, 4.0)), 0.8);
    }
}
