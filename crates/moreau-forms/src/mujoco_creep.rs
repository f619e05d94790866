//! Creep of a body that several contacts of MuJoCo hold on a slope where Coulomb would let it stick; independent of the step.
//!
//! ```text
//!     elliptic    b v = R_t,i f_t,i                               v = F_t/(b Σ 1/R_t,i) ,
//!     pyramidal   R_i f_i± = (k d_i δ_i ± μ b v)₊                  Σ μ (f_i⁺ − f_i⁻) = F_t determines v ,
//!     depth δ_i   from the normal force f_n,i                      elliptic: R_n f_n = k d δ ,   pyramidal: f_n = f⁺ + f⁻ + 2 k d δ/R .
//! ```
//! The slope's direction is one of the pyramid's axes; its other two edges carry k d δ/R each. The contacts have one speed v, and
//! F_t is what they hold together. The elliptic formula holds while every f_t,i stays below μ f_n,i.

use super::mujoco_contact::ContactParameters;
use moreau_exact::Result;

/// Contacts that hold a body together.
///
/// # Source
/// MuJoCo documentation, *Computation: constraint model*; the equations of the header.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldBody {
    /// `solref`, `solimp`, `impratio`.
    pub parameters: ContactParameters,
    /// h \[s\]; it enters only through t_c ≥ 2h.
    pub time_step: f64,
    /// Â of a normal row \[1/kg\], 1/m for one free body.
    pub diagonal: f64,
    /// μ.
    pub friction: f64,
}

impl HeldBody {
    /// v \[m/s\] with elliptic cones at the given depths \[m\], under F_t = `load` \[N\].
    pub fn elliptic_creep(&self, depths: &[f64], load: f64) -> f64 {
        let (_, damping) = self.stiffness_and_damping();
        let softness = |depth: &f64| self.parameters.normal_regularisation(*depth, self.diagonal) / self.parameters.impedance_ratio;
        load / (damping * depths.iter().map(|depth| 1.0 / softness(depth)).sum::<f64>())
    }

    /// v \[m/s\] with pyramids of four edges at the given depths \[m\], under F_t = `load` \[N\].
    pub fn pyramidal_creep(&self, depths: &[f64], load: f64) -> f64 {
        root(|speed| depths.iter().map(|&depth| self.pyramid(depth, speed)[1]).sum::<f64>() - load)
    }

    /// v \[m/s\] with elliptic cones under the normal forces \[N\], whose depths are the rest depths.
    ///
    /// # Errors
    /// Those of [`ContactParameters::rest_depth`].
    pub fn elliptic_creep_under(&self, normal_forces: &[f64], load: f64) -> Result<f64> {
        let depth = |force: &f64| self.parameters.rest_depth(self.time_step, self.diagonal, *force);
        let depths = normal_forces.iter().map(depth).collect::<Result<Vec<_>>>()?;
        Ok(self.elliptic_creep(&depths, load))
    }

    /// v \[m/s\] with pyramids under the positive normal forces \[N\]: depth and creep depend on each other.
    pub fn pyramidal_creep_under(&self, normal_forces: &[f64], load: f64) -> f64 {
        root(|speed| {
            let held = |force: &f64| {
                let depth = root(|depth| self.pyramid(depth, speed)[0] - force);
                self.pyramid(depth, speed)[1]
            };
            normal_forces.iter().map(held).sum::<f64>() - load
        })
    }

    /// (f_n, f_t) \[N\] of one pyramid at a depth \[m\] that creeps with `speed` \[m/s\] along one of its axes.
    fn pyramid(&self, depth: f64, speed: f64) -> [f64; 2] {
        let (stiffness, damping) = self.stiffness_and_damping();
        let edge = self.parameters.pyramid_diagonal(self.diagonal, self.friction);
        let softness = self.parameters.normal_regularisation(depth, edge);
        let spring = stiffness * self.parameters.impedance_at(depth) * depth;
        let push = |sign: f64| (spring + sign * self.friction * damping * speed).max(0.0) / softness;
        [push(1.0) + push(-1.0) + 2.0 * spring / softness, self.friction * (push(1.0) - push(-1.0))]
    }

    fn stiffness_and_damping(&self) -> (f64, f64) {
        self.parameters.stiffness_and_damping(self.time_step)
    }
}

/// The zero x ≥ 0 of a function that does not decrease, 0 if it is not negative there: doubling, then bisection down to neighbouring
/// floats.
fn root(excess: impl Fn(f64) -> f64) -> f64 {
    if excess(0.0) >= 0.0 {
        return 0.0;
    }
    let mut high = f64::MIN_POSITIVE.sqrt();
    while excess(high) < 0.0 && high.is_finite() {
        high *= 2.0;
    }
    let mut low = 0.0;
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if excess(middle) < 0.0 { low = middle } else { high = middle }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::PRINTED_DIGITS;

    fn body(friction: f64) -> HeldBody {
        HeldBody { parameters: ContactParameters::default(), time_step: 1e-3, diagonal: 1.0, friction }
    }

    #[test]
    fn one_elliptic_contact_creeps_as_the_single_contact_formula_says() {
        let several = body(0.5).elliptic_creep_under(&[9.2], 3.4).expect("positive");
        let single = ContactParameters::default().creep_speed(1e-3, 1.0, 9.2, 3.4).expect("positive");
        assert!((several - single).abs() <= PRINTED_DIGITS * single);
    }

    #[test]
    fn a_lightly_loaded_pyramid_has_four_equal_edges_and_creeps_linearly() {
        // f_n = 4 k d δ/R and f_t = 2 μ² b v/R: v = f_t R/(2 μ² b).
        let body = body(0.5);
        let creep = body.pyramidal_creep_under(&[9.2], 0.1);
        assert!((body.pyramidal_creep_under(&[9.2], 0.2) / creep - 2.0).abs() <= PRINTED_DIGITS);
        let (stiffness, damping) = body.stiffness_and_damping();
        let depth = root(|depth| body.pyramid(depth, 0.0)[0] - 9.2);
        let d = body.parameters.impedance_at(depth);
        let softness = 9.2_f64.recip() * 4.0 * stiffness * d * depth;
        assert!((0.1 * softness / (2.0 * 0.25 * damping) - creep).abs() <= PRINTED_DIGITS * creep);
    }

    #[test]
    fn the_depths_under_given_forces_give_the_creep_at_given_depths() {
        let body = body(0.5);
        let speed = body.pyramidal_creep_under(&[2.0, 3.0], 1.7);
        let depths = [2.0, 3.0].map(|force| root(|depth| body.pyramid(depth, speed)[0] - force));
        assert!((body.pyramidal_creep(&depths, 1.7) - speed).abs() <= PRINTED_DIGITS * speed);
    }

    #[test]
    fn without_load_nothing_creeps() {
        assert_eq!(body(0.5).pyramidal_creep_under(&[2.0], 0.0), 0.0);
        assert_eq!(body(0.5).elliptic_creep_under(&[2.0], 0.0).expect("positive"), 0.0);
    }
}
